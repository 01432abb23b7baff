"""Fuzz the target ``dcon_response``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("dcon_response")
