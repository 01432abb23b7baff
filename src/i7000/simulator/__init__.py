"""A simulated bus ..."""
