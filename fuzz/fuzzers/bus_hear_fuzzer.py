"""Fuzz the target ``bus_hear``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("bus_hear")
