"""Fuzz the target ``host_receive``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("host_receive")
