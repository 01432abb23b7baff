"""Fuzz the target ``device_step``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("device_step")
