"""Fuzz the target ``reading_text``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("reading_text")
