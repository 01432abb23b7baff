"""The decorator `frozen`: `attrs.frozen`, but applied at the first use of the class.

Processing a hundred classes with attrs takes longer than the rest of an import, so an import only adds slots. The first
call of the constructor, or the first use of `attrs` functions on the class, makes the rest.

Laws: after its first use, a class is the same as one from `attrs.frozen`. Several threads can be the first: each
processes its own copy, with the same result. `__init_subclass__` is called for every copy, so it must be repeatable.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, get_origin

import attrs

__all__ = ["frozen"]

_AWAITED = ("__init__", "__setattr__", "__delattr__", "__setstate__", "__attrs_attrs__", "__match_args__")
"""The attributes of a class that can be used before the first instance exists."""


class _Awaited:
    """An attribute of a class that attrs has not processed yet."""

    def __init__(self, plain: dict[str, Any], options: dict[str, Any]) -> None:
        self._plain = plain
        self._options = options

    def __set_name__(self, kind: type, name: str) -> None:
        self._kind = kind
        self._name = name

    def __get__(self, instance: object, kind: type) -> Any:  # noqa: ANN401 - whatever attrs makes
        plain = type(self._kind)(self._kind.__name__, self._kind.__bases__, dict(self._plain))
        made, own = vars(attrs.frozen(plain, **self._options)), vars(self._kind)
        for name in sorted(made, key=_AWAITED.__contains__):  # what other threads may be waiting for comes last
            if name not in own or isinstance(own[name], _Awaited):
                setattr(self._kind, name, made[name])
        found = own[self._name]
        return found.__get__(instance, kind) if hasattr(found, "__get__") else found


if TYPE_CHECKING:
    from attrs import frozen
else:

    def frozen(kind: type | None = None, **options: bool) -> type | Callable[[type], type]:
        """Make a frozen class with slots from a class with annotated fields, as `attrs.frozen` does.

        Shape: `options` are ``eq``, ``repr``, ``init`` and ``kw_only`` of attrs. The result is a new class, so that
            `super()` in its methods must name it: ``super(Command, cls)``.
        """
        if kind is None:
            return lambda kind: frozen(kind, **options)
        plain = {**vars(kind), "__qualname__": kind.__qualname__}
        fields = [name for name, annotation in kind.__annotations__.items() if get_origin(annotation) is not ClassVar]
        slots = [*fields, "__weakref__"] if "__weakref__" in plain else fields
        for name in ("__weakref__", "__dict__"):
            plain.pop(name, None)
        namespace = {name: value for name, value in plain.items() if name not in fields}
        left = {*namespace, *(() if options.get("init", True) else ("__init__",))}
        awaited = {name: _Awaited(plain, options) for name in _AWAITED if name not in left}
        namespace |= {"__slots__": tuple(slots), **awaited}
        return type(kind)(kind.__name__, kind.__bases__, namespace)
