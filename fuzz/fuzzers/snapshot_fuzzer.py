"""Fuzz the target ``snapshot``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("snapshot")
