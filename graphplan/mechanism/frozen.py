"""Mappings that nobody changes: what a scene and its results consist of, by name."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, NoReturn, TypeVar, cast

K = TypeVar("K")
V = TypeVar("V")


class Frozen(dict[K, V]):
    """A dictionary that cannot be changed; `|` and `{**...}` make new ones."""

    def _refuse(self, *args: object, **named: object) -> NoReturn:
        raise TypeError(f"{type(self).__name__} cannot be changed: make another, such as by scene.replace(path, value)")

    __setitem__ = __delitem__ = _refuse
    __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self),)


class NamedValues(Frozen[str, V]):
    """What was asked for, by name; what stands still is not asked for and has the value of the `fixed`.

    Any other name is a `KeyError` that says which were asked for.
    """

    def __init__(self, asked: dict[str, V], what: str = "result", fixed: Collection[str] = (), zero: V | None = None):
        super().__init__(asked)
        self.what, self.fixed, self.zero = what, frozenset(fixed), zero

    def __missing__(self, name: str) -> V:
        if name in self.fixed:
            return cast(V, self.zero)
        raise KeyError(f"the {self.what} of {name} was not asked for, but of {', '.join(self) or 'nothing'}")

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self), self.what, self.fixed, self.zero)
