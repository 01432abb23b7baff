"""Fuzz the target ``modbus_response``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("modbus_response")
