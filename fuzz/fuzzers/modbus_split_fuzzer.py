"""Fuzz the target ``modbus_split``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("modbus_split")
