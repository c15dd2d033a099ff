"""The rule of any step as arithmetic over the coordinates of what it reads, written in the language of a target.

The rule runs once on symbols (kernel/tape). Coordinates come and go in mm of paper; in between stand the
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
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.kernel.tape.record import Symbols
from graphplan.kernel.tape.written import Language, Writer
from graphplan.sheet.plates.drawn_step import DrawnStep
from graphplan.sheet.plates.view import View

SHAPELESS = frozenset({"side", "way", "turn"})  # parameters that stay what they are when everything grows


@dataclass(frozen=True)
class Formula:
    """A rule written out: terms that are used more than once, by name, each after those it reads; then the results."""

    terms: tuple[tuple[str, str], ...]
    results: tuple[str, ...]


def formula(drawn: DrawnStep, coordinates: Sequence[Sequence[str]], language: Language, term: str = "",
            deepest: float = math.inf, given: Mapping[str, tuple[str, float]] | None = None) -> Formula:
    """The coordinates of a mark, in mm, from those of its operands; `given` are parameters that something else tells:
    what, and how many times it.

    A term that is used more than once, or holds as many operations within each other as are `deepest`, gets the name
    `term` with a number; without a `term` it stands where it is used.
    """
    domain, similar = Symbols(), _similar(drawn)
    read = [_local(domain, arg.kind, _window(arg, similar), texts)
            for arg, texts in zip(drawn.args, coordinates, strict=True)]  # fmt: skip
    loads = {name: domain.tape.input(text) * times for name, (text, times) in (given or {}).items()}
    value = drawn.step.op.rule(domain, *read, **{**drawn.step.params, **loads})
    places = [domain.tape.place(part) for part in _answer_on_paper(domain, drawn.kind, _window(drawn, similar), value)]
    writer = Writer(domain.tape, language, prefix=term, deepest=deepest)
    return Formula(tuple(writer.terms(places)), tuple(writer.text[place] for place in places))


def _similar(drawn: DrawnStep) -> bool:
    """Whether the rule may be taken in mm as it is: on one plan, with no length given."""
    return all(arg.view is drawn.view for arg in drawn.args) and SHAPELESS.issuperset(drawn.step.op.params)


def _window(drawn: DrawnStep, similar: bool) -> View:
    """How lengths of a plan become mm."""
    return replace(drawn.view, scale=1.0, origin=(0.0, 0.0)) if similar else drawn.view


def _local(d: Symbols, kind: str, window: View, texts: Sequence[str]) -> tuple[Any, ...]:
    """The value that a rule reads, from coordinates in mm."""
    numbers: list[Any] = [d.tape.input(text) for text in texts]
    if kind == OPENING:
        return (_square(numbers[0] / window.scale),)
    x, y = window.to_plan((numbers[0], numbers[1]))
    if kind == CIRCLE:
        return x, y, _square(numbers[2] / window.scale)
    return (-numbers[3], numbers[2], numbers[3] * x - numbers[2] * y) if kind == LINE else (x, y)


def _square(part: Any) -> Any:
    return part * part


def _answer_on_paper(d: Symbols, kind: str, window: View, value: Any) -> list[Any]:
    """A rule's answer in mm; of a line the point that is next to the middle of its window, and its way."""
    if kind == LINE:
        (x, y), (a, b, c) = window.to_plan(window.rect.centre), value
        off = (a * x + b * y + c) / (a * a + b * b)
        return [*window((x - a * off, y - b * off)), b, -a]
    at = () if kind == OPENING else window((value[0], value[1]))
    if kind == POINT:
        return [*at]
    return [*at, window.scale * d.sqrt(value[-1], "not-rational", "a length is never imaginary")]
