"""The kinds of mark, and what a record of the table holds.

| kind    | value                                                                                     |
|---------|-------------------------------------------------------------------------------------------|
| point   | (x, y)                                                                                    |
| line    | (a, b, c), the points with a x + b y + c = 0; it runs along (b, -a)                       |
| opening | (r2,), the square of a distance between the compasses' points                             |
| circle  | (x, y, r2), centre and squared radius: so that everything but a compass meeting is rational |
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from graphplan.phrases import Said, said

POINT, LINE, OPENING, CIRCLE = "point", "line", "opening", "circle"

SCALE, STRAIGHTEDGE, SET_SQUARES, COMPASSES, DIVIDERS, PENCIL = (
    "scale", "straightedge", "set squares", "compasses", "dividers", "pencil",
)

Claim = tuple[Any, ...]


@dataclass(frozen=True)
class Primitive:
    """One operation of the drawing board: everything that graphplan knows of it.

    `reads` and `gives` are kinds; `rule(domain, *values, **params)` gives the value; `sentence` is spoken with the
    names of what it reads as {0}, {1}, ... and of what it makes as {out}; `claims` are what the drawn thing must
    satisfy; `fails` are the failure codes with what each means and what to do; `forms` are the ways to draw a
    compound from earlier primitives, by name. `where` is the operand on whose plan it is drawn (-1: the last). Where
    it is `symmetric` the order of its operands does not matter.
    """

    name: str
    reads: tuple[str, ...]
    gives: str
    instrument: str
    sentence: str
    rule: Callable[..., Any] = field(repr=False)
    claims: tuple[Claim, ...] = ()
    fails: tuple[str, ...] = ()
    params: tuple[str, ...] = ()
    source: str = ""
    where: int = -1
    symmetric: bool = False
    forms: dict[str, Callable[..., Any]] = field(default_factory=dict, repr=False)

    def __reduce__(self) -> tuple[Callable[[str], Primitive], tuple[str]]:
        """Copied and sent elsewhere by name: there is one table."""
        return named, (self.name,)

    @property
    def compound(self) -> bool:
        """Whether it can be drawn from other primitives."""
        return bool(self.forms)

    @property
    def doc(self) -> str:
        """What it gives, in one line."""
        return (self.rule.__doc__ or "").strip().splitlines()[0]


TABLE: dict[str, Primitive] = {}


def named(name: str) -> Primitive:
    """The operation of this name."""
    return TABLE[name]


FAILURES: dict[str, tuple[Said, str]] = {
    "points-coincide": (said("two points that should give a direction coincide"), "move one of them, or ask for less"),
    "lines-parallel": (said("two lines that should meet are parallel"), "--method trial, or let the form be chosen"),
    "no-direction": (said("a given direction has no length"), "give another direction"),
    "circles-miss": (said("two circles do not meet"), "check the lengths"),
    "circles-concentric": (said("two circles have the same centre"), "check the centres"),
    "line-misses-circle": (said("the line passes the circle by"), "check the lengths"),
    "locus-undetermined": (
        said("the link's pole lies in the point, so its loci say nothing of it"), "another pose: this one is singular",
    ),
    "couple-alone": (
        said("a force is nothing, so that it cannot take up a couple"), "leave the couple beside it (--inertia couple)",
    ),
    "trials-agree": (said("both trial figures miss by the same amount"), "another pose: this one is singular"),
    "not-rational": (said("a root is irrational"), "leave out --exact"),
}


def primitive(
    reads: tuple[str, ...],
    gives: str,
    instrument: str,
    sentence: str,
    *,
    claims: tuple[Claim, ...] = (),
    fails: tuple[str, ...] = (),
    params: tuple[str, ...] = (),
    source: str = "",
    where: int = -1,
    symmetric: bool = False,
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Enter the decorated rule in the table under its own name."""

    def enter(rule: Callable[..., Any]) -> Callable[..., Any]:
        name = rule.__name__
        if name in TABLE:
            raise ValueError(f"the table already has {name}")
        TABLE[name] = Primitive(name, reads, gives, instrument, sentence, rule, claims, fails, params, source, where,
                                symmetric)
        return rule

    return enter


def form(of: str, name: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Enter the decorated expansion as one form of the compound `of`."""

    def enter(expansion: Callable[..., Any]) -> Callable[..., Any]:
        TABLE[of] = replace(TABLE[of], forms={**TABLE[of].forms, name: expansion})
        return expansion

    return enter
