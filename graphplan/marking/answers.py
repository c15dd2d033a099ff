"""Answers: single numbers of a task that has no construction of a mechanism, judged by the true ones and by how far a
drawing of them may be off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from graphplan.marking.files.quantities import unit_factor
from graphplan.marking.files.tables import TableAnswer
from graphplan.mechanism.units import Dimension, Units
from graphplan.phrases import Said, arrange, digits, said, unit

RIGHT, WRONG, MISSING = "right", "wrong", "missing"
TOLERANCE_FACTOR = 1.5  # times the two standard deviations by which a drawing may be off: three
SI_UNITS = Units("m", "N", "kg")
TURN_DEGREES = 360.0
UNIT_POWERS = tuple(10.0**power for power in (-6, -3, -2, -1, 1, 2, 3, 6))  # that a unit may be mistaken by


@dataclass(frozen=True)
class TrueNumber:
    """A true number: what it is, and of what; its value in SI or in degrees, where it has no dimension; two standard
    deviations of what is drawn; how its unit is written, and what one of that is in SI."""

    quantity: str
    of: str
    value: float
    off: float
    written: str
    unit_size: float = 1.0
    dimension: Dimension | None = None

    def matches(self, answer: TableAnswer) -> bool:
        """Whether an answer is to this."""
        return (answer.quantity, answer.of.casefold()) == (self.quantity, self.of.casefold())

    def read(self, answer: TableAnswer) -> float:
        """The number of an answer in SI or degrees; fails with `ValueError` where its unit is of something else."""
        if self.dimension is None:
            if answer.unit not in ("", "°", "deg"):
                raise ValueError(f"{answer.unit!r} is not a unit of angle")
            return answer.value
        return answer.value * (unit_factor(answer.unit, self.dimension, SI_UNITS) if answer.unit else self.unit_size)

    def gap(self, value: float) -> float:
        """How far a number is from this."""
        if self.dimension is not None:
            return abs(value - self.value)
        return abs((value - self.value + TURN_DEGREES / 2) % TURN_DEGREES - TURN_DEGREES / 2)

    def number_text(self, value: float) -> Said:
        """A number in its unit."""
        pattern = "{0} {1}" if self.dimension else "{0}{1}"
        return arrange(pattern, digits(value / self.unit_size), unit(self.written))


@dataclass(frozen=True)
class AnswerVerdict:
    """A true number and what was answered, in SI or degrees, if anything was; whether that is right, and if it is not,
    what may have gone wrong."""

    expected: TrueNumber
    answered: float | None
    state: str
    hint: str = ""

    @property
    def text(self) -> Said:
        """The verdict in words."""
        name = " ".join(filter(None, (self.expected.quantity, self.expected.of)))
        if self.answered is None:
            return said("{0}: missing", name)
        answered = self.expected.number_text(self.answered)
        if self.state == RIGHT:
            return said("{0}: {1}, right", name, answered)
        true = self.expected.number_text(self.expected.value)
        if self.hint:
            return said("{0}: {1}, wrong, it is {2}: {3}", name, answered, true, self.hint)
        return said("{0}: {1}, wrong, it is {2}", name, answered, true)

    @property
    def record(self) -> dict[str, Any]:
        """As data."""
        unit_size = self.expected.unit_size
        return {"quantity": self.expected.quantity, "of": self.expected.of, "unit": self.expected.written,
                "answered": None if self.answered is None else self.answered / unit_size,
                "true": self.expected.value / unit_size, "state": self.state, "hint": str(self.hint)}


def judge_answers(expected: Sequence[TrueNumber], answers: Sequence[TableAnswer]) -> list[AnswerVerdict]:
    """The verdict on each number that is expected; fails with `ValueError` where an answer has a wrong unit."""
    return [_judge_answer(number, expected, next((answer for answer in answers if number.matches(answer)), None))
            for number in expected]


def _judge_answer(one: TrueNumber, expected: Sequence[TrueNumber], answer: TableAnswer | None) -> AnswerVerdict:
    """The verdict on one number, as far as a pencil and rounding allow."""
    if answer is None:
        return AnswerVerdict(one, None, MISSING)
    value = one.read(answer)
    scale = abs(value / answer.value) if answer.value else one.unit_size
    if one.gap(value) <= TOLERANCE_FACTOR * one.off + 2 * answer.rounding * scale:
        return AnswerVerdict(one, value, RIGHT)
    return AnswerVerdict(one, value, WRONG, _hint(one, expected, value))


def _hint(one: TrueNumber, expected: Sequence[TrueNumber], value: float) -> str:
    """What may have gone wrong: a unit, a sense, or another's number."""
    def is_near(rival: TrueNumber, number: float) -> bool:
        least = 0.01 * abs(rival.value) if rival.dimension else 0.5
        return rival.gap(number) <= TOLERANCE_FACTOR * max(rival.off, least)

    alike = next((rival for rival in expected if rival is not one and rival.written == one.written
                  and is_near(rival, value)), None)
    if alike is not None:
        return said("this is that of {0}", " ".join(filter(None, (alike.quantity, alike.of))))
    if one.dimension is None:
        return said("it is opposite") if is_near(one, value + TURN_DEGREES / 2) else said(
            "counted clockwise") if is_near(one, -value) else ""
    power = next((power for power in UNIT_POWERS if is_near(one, value / power)), None)
    if power is not None:
        return said("{0} times as large: a unit is mistaken", digits(power))
    return said("negative") if is_near(one, -value) else ""


def count_right(verdicts: Sequence[AnswerVerdict]) -> int:
    """How many answers are right."""
    return sum(verdict.state == RIGHT for verdict in verdicts)
