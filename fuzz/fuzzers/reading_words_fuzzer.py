"""Fuzz the target ``reading_words``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("reading_words")
