"""Fuzz the target ``capture``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("capture")
