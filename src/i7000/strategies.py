"""Hypothesis strategies for the public classes."""


def register() -> None:
    """Tell Hypothesis of them."""
