"""Records: dataclasses, of which frozen ones compile what makes them, and what compares them when they are compared.

The standard library writes six methods of each as text and compiles them: that is a fifth of a short command, in
which most records are never compared. These behave as the standard ones, whose `field`, `fields` and `replace` serve
them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import MISSING, Field, FrozenInstanceError, asdict, field, fields, is_dataclass, replace
from reprlib import recursive_repr
from typing import TYPE_CHECKING, Any

__all__ = ["asdict", "dataclass", "field", "fields", "is_dataclass", "replace"]

POST_INIT = "__post_init__"
HERE = frozenset({"frozen", "eq", "repr", "kw_only"})  # the options of records that are made here
Method = Callable[..., Any]


class _ByFactory:
    """The default of a field that a factory makes, as the standard library prints it."""

    def __repr__(self) -> str:
        return "<factory>"


BY_FACTORY = _ByFactory()

if TYPE_CHECKING:
    from dataclasses import dataclass
else:
    import dataclasses

    def dataclass(cls: type | None = None, /, **options: bool) -> Any:
        """A dataclass with the options of the standard ones; one that is frozen and has no order is made here."""
        if cls is None:
            return lambda cls: dataclass(cls, **options)
        if not options.get("frozen") or options.keys() - HERE:
            return dataclasses.dataclass(cls, **options)
        return _frozen(cls, **options)

    def _frozen(cls: type, frozen: bool, eq: bool = True, repr: bool = True, kw_only: bool = False) -> type:
        """A class with the methods of a frozen record; what it defines itself stays."""
        defined = {name for name, value in vars(cls).items() if value is not None or name != "__hash__"}
        dataclasses.dataclass(cls, init=False, eq=False, repr=False, kw_only=kw_only)
        members = fields(cls)
        methods = {"__init__": _maker(members, hasattr(cls, POST_INIT)),
                   **_guards(cls, {member.name for member in members})}
        if repr:
            methods["__repr__"] = _printer([member.name for member in members if member.repr])
        if eq:
            methods["__eq__"] = _compiled_at_first(cls, "__eq__", _comparison, members)
            methods["__hash__"] = _compiled_at_first(cls, "__hash__", _hashing, members)
        for name in methods.keys() - defined:
            methods[name].__qualname__ = f"{cls.__qualname__}.{name}"
            setattr(cls, name, methods[name])
        return cls


def _compile(name: str, parameters: Sequence[str], body: Sequence[str], scope: dict[str, Any]) -> Method:
    """A method of these lines."""
    exec(f"def {name}({', '.join(['self', *parameters])}):\n " + "\n ".join(body), scope)
    method: Method = scope[name]
    return method


def _maker(members: Sequence[Field[Any]], checked: bool) -> Method:
    """`__init__`, with the fields as its parameters; of records that are `checked` when they are made it ends so."""
    scope: dict[str, Any] = {"__set__": object.__setattr__, "__by_factory__": BY_FACTORY}
    first, named, body = list[str](), list[str](), list[str]()
    for member in members:
        name, value, default = member.name, member.name, ""
        if member.default_factory is not MISSING:
            scope[f"__make_{name}"], default, value = member.default_factory, "=__by_factory__", f"__make_{name}()"
            value = f"{value} if {name} is __by_factory__ else {name}" if member.init else value
        elif member.default is not MISSING:
            scope[f"__default_{name}"], default = member.default, f"=__default_{name}"
        if member.init:
            (named if member.kw_only else first).append(name + default)
        if member.init or member.default_factory is not MISSING:
            body.append(f"__set__(self, {name!r}, {value})")
    body.append(f"self.{POST_INIT}()" if checked else "return")
    maker = _compile("__init__", [*first, *(["*", *named] if named else [])], body, scope)
    maker.__annotations__ = {member.name: member.type for member in members if member.init} | {"return": None}
    return maker


def _comparison(members: Sequence[Field[Any]]) -> Method:
    left, right = (_values(record, [member for member in members if member.compare]) for record in ("self", "other"))
    return _compile("__eq__", ["other"], [f"return {left} == {right} if other.__class__ is self.__class__ else "
                                          "NotImplemented"], {})


def _hashing(members: Sequence[Field[Any]]) -> Method:
    hashed = [member for member in members if (member.compare if member.hash is None else member.hash)]
    return _compile("__hash__", [], [f"return hash({_values('self', hashed)})"], {})


def _values(record: str, members: Sequence[Field[Any]]) -> str:
    """These fields of a record as a tuple, in Python."""
    return f"({''.join(f'{record}.{member.name}, ' for member in members)})"


def _compiled_at_first(cls: type, name: str, write: Callable[[Sequence[Field[Any]]], Method],
                       members: Sequence[Field[Any]]) -> Method:
    """A method that is compiled when it is called, and from then on stands in its defined place."""

    def method(self: Any, *args: Any) -> Any:
        compiled = write(members)
        compiled.__qualname__ = method.__qualname__
        setattr(cls, name, compiled)
        return compiled(self, *args)

    return method


def _printer(names: Sequence[str]) -> Method:
    @recursive_repr()
    def __repr__(self: Any) -> str:
        return f"{self.__class__.__qualname__}({', '.join(f'{name}={getattr(self, name)!r}' for name in names)})"

    return __repr__


def _guards(cls: Any, names: set[str]) -> dict[str, Method]:
    """The methods that refuse to change a field, and anything of a record of this very class."""

    def __setattr__(self: Any, name: str, value: Any) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self: Any, name: str) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return {"__setattr__": __setattr__, "__delattr__": __delattr__}
