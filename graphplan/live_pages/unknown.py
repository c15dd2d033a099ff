"""Numbers of a pose that is not known yet: what the words compute with them is recorded on a tape, to be done later.

A text that is told of them has places for its numbers, and where its words hang on them it has both, each for the poses
in which it is right. In a text stand, in characters of private use,

    PLACE output : figures END          a number, in so many significant figures, or with 0 of them in tenths
    PLACE output : kind level END       a number of a sum, by its kind, at the level that this other output is
    EITHER output THEN one ELSE other END   the one where that output of the tape is above zero, else the other
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from typing import Any

from graphplan.kernel.numbers import Floats
from graphplan.kernel.tape.record import JAVASCRIPT, Symbol, Tape, Writer
from graphplan.phrases import Said, UndecidedText, Unknown, arrange, figures, in_any_case
from graphplan.sheet.words.lengths import FORMS

PLACE, EITHER, THEN, ELSE, END = map(chr, range(0xE000, 0xE005))
LEVEL, RESULT = "level ", "result "  # before the kinds of the numbers of which these are worked out


class _Written(dict[str, str]):
    """Notation of operations, those of sums by the kinds of their numbers."""

    def __missing__(self, operation: str) -> str:
        name, kinds = operation.split(" ")
        return f'{name}("{kinds}", {", ".join("{}" for _ in kinds.lstrip(FORMS))}{", {}" * (name == RESULT[:-1])})'


LIVE = JAVASCRIPT._replace(written=_Written(
    {**JAVASCRIPT.written, "tenths": "tenths({})", "hypot": "hypot({}, {})"}))


@dataclass
class Later:
    """The tape of unknown numbers, those of it that are told or asked (by place, in order), and what is assumed."""

    tape: Tape = field(default_factory=Tape)
    outputs: dict[int, int] = field(default_factory=dict)
    assumed: dict[int, bool] = field(default_factory=dict)
    answers: dict[Hashable, Any] = field(default_factory=dict, repr=False)

    def input(self, name: str) -> UnknownNumber:
        """A number that JavaScript calls so."""
        return UnknownNumber(self, self.tape.input(name))

    def output(self, number: Any) -> int:
        """Index of a number among the tape's outputs."""
        return self.outputs.setdefault(self.tape.place(number), len(self.outputs))

    def positive(self, number: Any) -> bool:
        """Whether a number is above zero: what is assumed, if anything is."""
        if isinstance(number, UnknownNumber):
            number = number.symbol
        place = self.tape.place(number)
        if self.tape.is_constant(place):
            return bool(self.tape.entries[place][1] > 0)
        if place not in self.assumed:
            raise Asked(self, place)
        return self.assumed[place]

    def assuming(self, place: int, answer: bool, tell: Callable[[], Said]) -> Said:
        """Text for the case that a number is above zero, or is not."""
        self.assumed[place] = answer
        try:
            return in_any_case(tell)
        finally:
            del self.assumed[place]

    def remember(self, question: Hashable, answer: Callable[[], Any]) -> Any:
        """An answer that hangs on what is assumed alone, worked out once; or what it asks, raised again."""
        key = question, frozenset(self.assumed.items())
        if key not in self.answers:
            try:
                self.answers[key] = answer()
            except Asked as asked:
                self.answers[key] = asked
        if isinstance(self.answers[key], Asked):
            raise self.answers[key].with_traceback(None)
        return self.answers[key]

    def javascript(self) -> str:
        """A function to the outputs, of the marks' values v, of s, by which plans have larger scales, and of what is
        no arithmetic."""
        writer = Writer(self.tape, LIVE)
        body = writer.statements([*self.outputs])
        outputs = ",".join(writer.text[place] for place in self.outputs)
        return "\n".join(["function (v, s, {tenths, hypot, level, result}) {", *body, f"return [{outputs}];", "}"])


class Asked(UndecidedText):
    """Whether a number is above zero hangs on the pose."""

    def __init__(self, later: Later, place: int):
        self.later, self.place = later, place

    def say_both(self, tell: Callable[[], Said]) -> Said:
        output = self.later.output(Symbol(self.later.tape, self.place))
        if_so, if_not = (self.later.assuming(self.place, answer, tell) for answer in (True, False))
        return if_so if if_so == if_not else arrange(f"{EITHER}{output}{THEN}{{0}}{ELSE}{{1}}{END}", if_so, if_not)


def _record_operation(operation: Callable[[Any, Any], Any]) -> Callable[[UnknownNumber, Any], UnknownNumber]:
    """Arithmetic with another number."""

    def record(number: UnknownNumber, other: Any) -> UnknownNumber:
        return UnknownNumber(number.later,
                             operation(number.symbol, other.symbol if isinstance(other, UnknownNumber) else other))

    return record


def _swap_operands(operation: Callable[[Any, Any], Any]) -> Callable[[UnknownNumber, Any], UnknownNumber]:
    return _record_operation(lambda symbol, other: operation(other, symbol))


class UnknownNumber(Unknown):
    """A number of a pose; it can be computed with, compared and told, and is no float."""

    __slots__ = ("later", "symbol")

    def __init__(self, later: Later, symbol: Any):
        self.later, self.symbol = later, symbol

    __add__, __radd__ = _record_operation(operator.add), _swap_operands(operator.add)
    __sub__, __rsub__ = _record_operation(operator.sub), _swap_operands(operator.sub)
    __mul__, __rmul__ = _record_operation(operator.mul), _swap_operands(operator.mul)
    __truediv__, __rtruediv__ = _record_operation(operator.truediv), _swap_operands(operator.truediv)

    def __neg__(self) -> UnknownNumber:
        return UnknownNumber(self.later, -self.symbol)

    def __abs__(self) -> UnknownNumber:
        return UnknownNumber(self.later, abs(self.symbol))

    def __pow__(self, power: float) -> UnknownNumber:
        if power != 0.5:  # noqa: PLR2004
            raise TypeError("only square roots are recorded")
        return UnknownNumber(self.later, self.symbol.root())

    def __round__(self, places: int) -> UnknownNumber:
        if places != 1:
            raise TypeError("only rounding to tenths is recorded")
        return UnknownNumber(self.later, self.later.tape.worded_operation("tenths", self.symbol.place))

    def __lt__(self, other: Any) -> bool:
        return self.later.positive(other - self)

    def __gt__(self, other: Any) -> bool:
        return self.later.positive(self - other)

    def __le__(self, other: Any) -> bool:
        return not self.later.positive(self - other)

    def __ge__(self, other: Any) -> bool:
        return not self.later.positive(other - self)

    def __bool__(self) -> bool:
        return self.later.positive(abs(self))

    def level(self, kinds: str, numbers: Sequence[Any]) -> UnknownNumber:
        return self._of_sum(LEVEL + kinds, numbers)

    def result(self, kinds: str, numbers: Sequence[Any]) -> UnknownNumber:
        return self._of_sum(RESULT + kinds, (*numbers, self))

    def _of_sum(self, operation: str, numbers: Sequence[Any]) -> UnknownNumber:
        """Result of an operation on the numbers of a sum."""
        tape = self.later.tape
        places = (tape.place(getattr(number, "symbol", number)) for number in numbers)
        return UnknownNumber(self.later, tape.worded_operation(operation, *places))

    def printed_number(self, number: Any, kind: str) -> Said:
        symbol = getattr(number, "symbol", number)
        return figures(f"{PLACE}{self.later.output(symbol)}:{kind}{self.later.output(self.symbol)}{END}")

    def hypot(self, operand: Any) -> UnknownNumber:
        tape = self.later.tape
        operand = operand.symbol if isinstance(operand, UnknownNumber) else operand
        return UnknownNumber(self.later, tape.worded_operation("hypot", self.symbol.place, tape.place(operand)))

    def place(self, count: int) -> str:
        return f"{PLACE}{self.later.output(self.symbol)}:{count}{END}"


class Laters(Floats):
    """The domain of such numbers, for the readings of marks."""

    def sqrt(self, value: Any, code: str, why: str) -> Any:
        return value**0.5

    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        return value

    def sign(self, value: Any, scale: Any) -> Any:
        tape = value.later.tape
        return UnknownNumber(value.later,
                             tape.sign(*(tape.place(getattr(number, "symbol", number)) for number in (value, scale))))


def unknown(later: Later, values: Sequence[Any]) -> list[tuple[UnknownNumber, ...]]:
    """The values of marks, each number unknown."""
    return [tuple(later.input(f"v[{mark}][{k}]") for k in range(len(value))) for mark, value in enumerate(values)]
