"""What is required of a module, a driver or a codec, as checks and verdicts without I/O."""
