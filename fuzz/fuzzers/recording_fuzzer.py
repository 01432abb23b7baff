"""Fuzz the target ``recording``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("recording")
