"""The error of a line whose port fails."""

from i7000.errors import I7000Error

__all__ = ["LinkError"]


class LinkError(I7000Error, OSError):
    """A port that cannot be opened, that disappeared, or that is closed; the text names it and the reason."""
