"""Answers: single numbers of a task that has no construction of a mechanism, judged by the true ones and by how far a
drawing of them may be off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from graphplan.marking.tables.reader import Answer
from graphplan.marking.tables.results import factor
from graphplan.mechanism.units import Dimension, Units
from graphplan.phrases import Said, arrange, digits, said, unit

RIGHT, WRONG, MISSING = "right", "wrong", "missing"
SURE = 1.5  # times the two standard deviations by which a drawing may be off: three
SI = Units("m", "N", "kg")
TURN = 360.0
POWERS = tuple(10.0**power for power in (-6, -3, -2, -1, 1, 2, 3, 6))  # that a unit may be mistaken by


@dataclass(frozen=True)
class Expected:
    """A true number: what it is, and of what; its value in SI or in degrees, where it has no dimension; two standard
    deviations of what is drawn; how its unit is written, and what one of that is in SI."""

    quantity: str
    of: str
    value: float
    off: float
    written: str
    one: float = 1.0
    dimension: Dimension | None = None

    def matches(self, answer: Answer) -> bool:
        """Whether an answer is to this."""
        return (answer.quantity, answer.of.casefold()) == (self.quantity, self.of.casefold())

    def read(self, answer: Answer) -> float:
        """The number of an answer in SI or degrees; fails with `ValueError` where its unit is of something else."""
        if self.dimension is None:
            if answer.unit not in ("", "°", "deg"):
                raise ValueError(f"{answer.unit!r} is not a unit of angle")
            return answer.value
        return answer.value * (factor(answer.unit, self.dimension, SI) if answer.unit else self.one)

    def gap(self, value: float) -> float:
        """How far a number is from this."""
        if self.dimension is not None:
            return abs(value - self.value)
        return abs((value - self.value + TURN / 2) % TURN - TURN / 2)

    def told(self, value: float) -> Said:
        """A number in its unit."""
        pattern = "{0} {1}" if self.dimension else "{0}{1}"
        return arrange(pattern, digits(value / self.one), unit(self.written))


@dataclass(frozen=True)
class AnswerVerdict:
    """A true number and what was answered, in SI or degrees, if anything was; whether that is right, and if it is not,
    what may have gone wrong."""

    expected: Expected
    answered: float | None
    state: str
    hint: str = ""

    @property
    def told(self) -> Said:
        """The verdict in words."""
        name = " ".join(filter(None, (self.expected.quantity, self.expected.of)))
        if self.answered is None:
            return said("{0}: missing", name)
        told = self.expected.told(self.answered)
        if self.state == RIGHT:
            return said("{0}: {1}, right", name, told)
        true = self.expected.told(self.expected.value)
        if self.hint:
            return said("{0}: {1}, wrong, it is {2}: {3}", name, told, true, self.hint)
        return said("{0}: {1}, wrong, it is {2}", name, told, true)

    @property
    def record(self) -> dict[str, Any]:
        """As data."""
        one = self.expected.one
        return {"quantity": self.expected.quantity, "of": self.expected.of, "unit": self.expected.written,
                "answered": None if self.answered is None else self.answered / one,
                "true": self.expected.value / one, "state": self.state, "hint": str(self.hint)}


def judged(expected: Sequence[Expected], answers: Sequence[Answer]) -> list[AnswerVerdict]:
    """The verdict on each number that is expected; fails with `ValueError` where an answer has a wrong unit."""
    return [_verdict(one, expected, next((answer for answer in answers if one.matches(answer)), None))
            for one in expected]


def _verdict(one: Expected, expected: Sequence[Expected], answer: Answer | None) -> AnswerVerdict:
    """The verdict on one number, as far as a pencil and rounding allow."""
    if answer is None:
        return AnswerVerdict(one, None, MISSING)
    value = one.read(answer)
    scale = abs(value / answer.value) if answer.value else one.one
    if one.gap(value) <= SURE * one.off + 2 * answer.rounding * scale:
        return AnswerVerdict(one, value, RIGHT)
    return AnswerVerdict(one, value, WRONG, _hint(one, expected, value))


def _hint(one: Expected, expected: Sequence[Expected], value: float) -> str:
    """What may have gone wrong: a unit, a sense, or another's number."""
    def near(other: Expected, number: float) -> bool:
        return other.gap(number) <= SURE * max(other.off, 0.01 * abs(other.value) if other.dimension else 0.5)

    alike = next((other for other in expected if other is not one and other.written == one.written
                  and near(other, value)), None)
    if alike is not None:
        return said("this is that of {0}", " ".join(filter(None, (alike.quantity, alike.of))))
    if one.dimension is None:
        return said("it is opposite") if near(one, value + TURN / 2) else said(
            "counted clockwise") if near(one, -value) else ""
    power = next((power for power in POWERS if near(one, value / power)), None)
    if power is not None:
        return said("{0} times as large: a unit is mistaken", digits(power))
    return said("negative") if near(one, -value) else ""


def right(verdicts: Sequence[AnswerVerdict]) -> int:
    """How many answers are right."""
    return sum(one.state == RIGHT for one in verdicts)
