"""Fuzz the target ``log_find``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("log_find")
