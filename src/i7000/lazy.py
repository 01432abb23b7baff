"""Packages whose public names are imported when they are first used, because their modules take time to import."""

import sys
from collections.abc import Callable, Mapping
from importlib import import_module

__all__ = ["imported_at_use"]


def imported_at_use(package: str, places: Mapping[str, tuple[str, ...]]) -> Callable[[str], object]:
    """Return the ``__getattr__`` of a package; `places` has the public names of each of its modules.

    Errors: the function raises `AttributeError` for any other name.
    """
    modules = {name: module for module, names in places.items() for name in names}

    def of_package(name: str) -> object:
        """Import a public name when it is first used."""
        if name not in modules:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(f"{package}.{modules[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    return of_package
