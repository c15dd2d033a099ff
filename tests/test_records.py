"""Records behave as the dataclasses of the standard library."""

from __future__ import annotations

import copy
import dataclasses
import inspect
import pickle
from collections.abc import Callable
from typing import Any, ClassVar

import pytest

from graphplan import records
from graphplan.mechanism.units import Units


def classes(dataclass: Callable[..., Any]) -> tuple[Any, ...]:
    """A record with all kinds of fields, one that adds to it, and one that is compared as it says itself."""

    @dataclass(frozen=True)
    class Base:
        a: int
        b: list[int] = dataclasses.field(default_factory=list, compare=False)
        c: int = dataclasses.field(default=3, repr=False)
        d: list[int] = dataclasses.field(default_factory=list, init=False, compare=False)
        e: int = dataclasses.field(default=5, hash=False, kw_only=True)
        size: ClassVar[int] = 7

    @dataclass(frozen=True)
    class Derived(Base):
        f: str = "f"

        def __post_init__(self) -> None:
            if self.a < 0:
                raise ValueError("below zero")

    @dataclass(frozen=True, repr=False)
    class Own:
        a: int = 1

        def __eq__(self, other: object) -> bool:
            return True

        def __hash__(self) -> int:
            return 9

    @dataclass(frozen=True, eq=False)
    class Apart:
        a: int = 1

    return Base, Derived, Own, Apart


def outcome(act: Callable[[], Any]) -> Any:
    """What comes of an act, or how it fails."""
    try:
        return act()
    except (AttributeError, TypeError, ValueError) as fault:
        return type(fault), str(fault)


ACTS: dict[str, Callable[..., Any]] = {
    "made": lambda Base, Derived, Own, Apart: [vars(Base(1, e=2)), vars(Derived(1, [2], 3, "g")), vars(Own())],
    "printed": lambda Base, Derived, Own, Apart: [repr(Base(1, [2])), repr(Derived(1, e=8))],
    "compared": lambda Base, Derived, Own, Apart: [
        Base(1) == Base(1, [2]), Base(1) == Base(1, e=6), Base(1) == Derived(1), Base(1) == 1, Own(1) == Own(2),
        Apart() == Apart()],
    "hashed": lambda Base, Derived, Own, Apart: [hash(Base(1)) == hash(Base(1, [2], e=6)), hash(Derived(1)),
                                                 hash(Own())],
    "checked": lambda Base, Derived, Own, Apart: Derived(-1),
    "short of a field": lambda Base, Derived, Own, Apart: Base(),
    "one too many": lambda Base, Derived, Own, Apart: Base(1, x=2),
    "assigned": lambda Base, Derived, Own, Apart: setattr(Base(1), "a", 2),
    "added": lambda Base, Derived, Own, Apart: setattr(Derived(1), "new", 2),
    "deleted": lambda Base, Derived, Own, Apart: delattr(Base(1), "a"),
    "extended": lambda Base, Derived, Own, Apart: vars(plain(Base)(1)),
    "replaced": lambda Base, Derived, Own, Apart: [vars(dataclasses.replace(Derived(1), a=4, e=6)),
                                                   dataclasses.astuple(copy.copy(Base(1)))],
    "listed": lambda Base, Derived, Own, Apart: [field.name for field in dataclasses.fields(Derived)],
    "described": lambda Base, Derived, Own, Apart: [str(inspect.signature(Derived)), Base.__init__.__qualname__],
}


def plain(base: Any) -> Any:
    """A class that is no record itself, and has a part of its own."""

    class Plain(base):
        def __init__(self, a: int):
            super().__init__(a)
            self.more = 2

    return Plain


@pytest.mark.parametrize("act", ACTS)
def test_records_are_dataclasses(act: str) -> None:
    """What is done with a record comes to the same as with a dataclass of the standard library, at any time."""
    ours, standard = classes(records.dataclass), classes(dataclasses.dataclass)
    assert [outcome(lambda: ACTS[act](*ours)) for _ in "12"] == [outcome(lambda: ACTS[act](*standard))] * 2


def test_records_are_sent_elsewhere() -> None:
    """A record is the same when it is pickled and read again."""
    units = Units(length="cm")
    assert pickle.loads(pickle.dumps(units)) == units
