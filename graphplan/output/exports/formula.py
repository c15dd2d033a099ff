"""The rule of any step as arithmetic over the coordinates of what it reads, written in the language of a target.

The rule runs once on symbols (kernel/tape/record.py). Coordinates come and go in mm of paper; in between stand the
units of each operand's own plan, so that a step may read from plans of any scale. In mm

| kind    | has the coordinates                                                          |
|---------|------------------------------------------------------------------------------|
| point   | x, y                                                                         |
| line    | x, y, dx, dy: a point of it, and a vector the way it runs, of whatever length |
| opening | r                                                                            |
| circle  | x, y, r                                                                      |
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING
from graphplan.kernel.numbers.floats import ZERO
from graphplan.kernel.tape.record import LEAVES, Symbols, Tape, operands
from graphplan.sheet.plates.drawn_step import DrawnStep
from graphplan.sheet.plates.view import View

SHAPELESS = frozenset({"side", "way", "turn"})  # parameters that stay what they are when everything grows


class Language(NamedTuple):
    """How a target writes numbers and operations: those of the tape by sign, with {0}, {1} for what they work on.

    `sign` has a third place, for the part of {1} beside which {0} is nothing.
    """

    number: Callable[[float], str]
    written: Mapping[str, str]


@dataclass(frozen=True)
class Formula:
    """A rule written out: terms that are used more than once, by name, each after those it reads; then the results."""

    terms: tuple[tuple[str, str], ...]
    results: tuple[str, ...]


def formula(drawn: DrawnStep, coordinates: Sequence[Sequence[str]], language: Language, term: str = "",
            deepest: float = math.inf) -> Formula:
    """The coordinates of a mark, in mm, from those of its operands.

    A term that is used more than once, or holds as many operations within each other as are `deepest`, gets the name
    `term` with a number; without a `term` it stands where it is used.
    """
    domain, similar = Symbols(), _similar(drawn)
    read = [_local(domain, arg, texts, similar) for arg, texts in zip(drawn.args, coordinates, strict=True)]
    value = drawn.step.op.rule(domain, *read, **drawn.step.params)
    told = [domain.tape.place(part) for part in _told(domain, drawn, value, similar)]
    return _TapeText(domain.tape, told, language, term, deepest).formula()


def _similar(drawn: DrawnStep) -> bool:
    """Whether the rule may be taken in mm as it is: on one plan, with no length given."""
    return all(arg.view is drawn.view for arg in drawn.args) and SHAPELESS.issuperset(drawn.step.op.params)


def _local(d: Symbols, arg: DrawnStep, texts: Sequence[str], similar: bool) -> tuple[Any, ...]:
    """The value that a rule reads, from coordinates in mm."""
    parts = [d.tape.input(text) for text in texts]
    if arg.kind == OPENING:
        return (_square(_divided(parts[0], arg.view, similar)),)
    x, y = _at(parts, arg.view, similar)
    if arg.kind == CIRCLE:
        return x, y, _square(_divided(parts[2], arg.view, similar))
    return _through(x, y, *parts[2:]) if arg.kind == LINE else (x, y)


def _at(parts: Sequence[Any], plan: View, similar: bool) -> tuple[Any, Any]:
    """A place on the plan."""
    if similar:
        return parts[0], parts[1]
    return (parts[0] - plan.origin[0]) / plan.scale, (parts[1] - plan.origin[1]) / plan.scale


def _divided(part: Any, plan: View, similar: bool) -> Any:
    return part if similar else part / plan.scale


def _square(part: Any) -> Any:
    return part * part


def _through(x: Any, y: Any, dx: Any, dy: Any) -> tuple[Any, Any, Any]:
    return -dy, dx, dy * x - dx * y


def _told(d: Symbols, drawn: DrawnStep, value: Any, similar: bool) -> list[Any]:
    """A rule's answer in mm."""
    plan, scale = drawn.view, 1.0 if similar else drawn.view.scale
    if drawn.kind == OPENING:
        return [scale * _root(d, value[0])]
    if drawn.kind == LINE:
        return [*_placed(_foot(plan, value, similar), plan, similar), value[1], -value[0]]
    centre = _placed(value, plan, similar)
    return [*centre, scale * _root(d, value[2])] if drawn.kind == CIRCLE else centre


def _placed(spot: Sequence[Any], plan: View, similar: bool) -> list[Any]:
    return list(spot[:2]) if similar else [plan.origin[i] + plan.scale * spot[i] for i in (0, 1)]


def _root(d: Symbols, square: Any) -> Any:
    return d.sqrt(square, "not-rational", "a length is never imaginary")


def _foot(plan: View, line: Any, similar: bool) -> tuple[Any, Any]:
    """The point of a line that is next to the middle of its window."""
    x, y = plan.rect.centre if similar else _at(plan.rect.centre, plan, similar)
    a, b, c = line
    off = (a * x + b * y + c) / (a * a + b * b)
    return x - a * off, y - b * off


class _TapeText:
    """Writes what stands on a tape."""

    def __init__(self, tape: Tape, told: Sequence[int], language: Language, term: str, deepest: float):
        self.tape, self.told, self.language, self.term, self.deepest = tape, told, language, term, deepest
        self.needed = tape.needed(told)
        self.uses = Counter(place for entry in self.needed for place in operands(tape.entries[entry]))
        self.texts: dict[int, str] = {}
        self.depth: dict[int, int] = {}
        self.terms: list[tuple[str, str]] = []

    def formula(self) -> Formula:
        for place in self.needed:
            self.texts[place] = self._text(place)
        return Formula(tuple(self.terms), tuple(self.texts[place] for place in self.told))

    def _text(self, place: int) -> str:
        op, *rest = self.tape.entries[place]
        self.depth[place] = 0
        if op in LEAVES:
            return self.language.number(rest[0]) if op == "constant" else str(rest[0])
        said = self.language.written[op].format(*(self.texts[arg] for arg in rest), self.language.number(ZERO))
        deep = 1 + max(self.depth[arg] for arg in rest)
        if not self.term or (self.uses[place] < 2 and deep < self.deepest):
            self.depth[place] = deep
            return said
        self.terms.append((f"{self.term}{len(self.terms) + 1}", said))
        return self.terms[-1][0]


def operations(sqrt: str, absolute: str, sign: str) -> dict[str, str]:
    """The operations as nearly every language writes them."""
    return {"+": "({} + {})", "-": "({} - {})", "*": "({} * {})", "/": "({} / {})", "neg": "(-{})",
            "sqrt": sqrt, "abs": absolute, "sign": sign}
