"""Fuzz the target ``registers``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("registers")
