"""Fuzz the target ``dcon_split``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("dcon_split")
