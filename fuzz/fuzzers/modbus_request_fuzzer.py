"""Fuzz the target ``modbus_request``."""

from fuzz.engine import main

if __name__ == "__main__":
    main("modbus_request")
