"""Fuzz the target ``stream_hear``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("stream_hear")
