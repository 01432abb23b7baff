"""Fuzz the target ``log_pieces``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("log_pieces")
