"""Fuzz the target ``dcon_command``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("dcon_command")
