"""Conformance: what is required of a module, a driver or a codec, and whether it does it."""
