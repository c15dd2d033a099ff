"""The tape (Wengert 1964): every sum, product and root of a program, each once, with the questions that were asked.

Symbols pass through the rules in the place of numbers. The same operation is done once, and signs move outwards, by
identities that hold in rounded arithmetic too: so a tape gives the same numbers as the rules, to the last bit (only a
zero may change its sign).

The questions become comparisons; where one fails the pose is handed back, to be asked of the rules, which know what to
say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from graphplan.kernel.numbers import Domain, Floats

Entry = tuple[Any, ...]  # ("in", name), ("constant", value), or an operation and the places of its operands

FLOATS = Floats()
LEAVES = ("in", "constant")


@dataclass(frozen=True)
class Question:
    """Asked where a rule may fail: is the number at `value` nonzero beside `scale`? Without scale: not negative?"""

    value: int
    scale: int | None


@dataclass
class Tape:
    """What was recorded: `entries` in order, and the questions asked on the way, each once, in order."""

    entries: list[Entry] = field(default_factory=list)
    questions: dict[Question, None] = field(default_factory=dict)
    _places: dict[Entry, int] = field(default_factory=dict)

    def input(self, name: str) -> Symbol:
        """A number that is told at the replay."""
        return self._symbol_for("in", name)

    def place(self, number: Any) -> int:
        """Where a number stands on the tape: a symbol, or a constant."""
        if isinstance(number, Symbol):
            return number.place
        return self._symbol_for("constant", float(number)).place

    def _symbol_for(self, *entry: Any) -> Symbol:
        place = self._places.setdefault(entry, len(self.entries))
        if place == len(self.entries):
            self.entries.append(entry)
        return Symbol(self, place)

    def is_constant(self, a: int, *values: float) -> bool:
        """Whether a place holds a constant, one of `values` if there are any."""
        entry = self.entries[a]
        return entry[0] == "constant" and (not values or entry[1] in values)

    # ---- arithmetic, by places --------------------------------------------------------------------------------

    def add(self, a: int, b: int) -> Symbol:
        if self.is_constant(b, 0.0):
            return Symbol(self, a)
        if (c := self._negative_of(b)) is not None:
            return self.sub(a, c)
        if (c := self._negative_of(a)) is not None:
            return self.sub(b, c)
        return self._symbol_for("+", *sorted((a, b)))

    def sub(self, a: int, b: int) -> Symbol:
        if self.is_constant(b, 0.0):
            return Symbol(self, a)
        if self.is_constant(a, 0.0):
            return self.neg(b)
        if (c := self._negative_of(b)) is not None:
            return self.add(a, c)
        if (c := self._negative_of(a)) is not None:
            return -self.add(c, b)
        mirrored = self._places.get(("-", b, a))
        return self._symbol_for("-", a, b) if mirrored is None else self.neg(mirrored)

    def mul(self, a: int, b: int) -> Symbol:
        for factor, cofactor in (a, b), (b, a):
            if self.is_constant(factor, 1.0):
                return Symbol(self, cofactor)
            if self.is_constant(factor, -1.0):
                return self.neg(cofactor)
            if (c := self._negative_of(factor)) is not None:
                return -self.mul(c, cofactor)
        return self._symbol_for("*", *sorted((a, b)))

    def div(self, a: int, b: int) -> Symbol:
        if self.is_constant(b, 1.0):
            return Symbol(self, a)
        if (c := self._negative_of(a)) is not None:
            return -self.div(c, b)
        if (c := self._negative_of(b)) is not None:
            return -self.div(a, c)
        return self._symbol_for("/", a, b)

    def neg(self, a: int) -> Symbol:
        c = self._negative_of(a)
        return self._symbol_for("neg", a) if c is None else Symbol(self, c)

    def abs(self, a: int) -> Symbol:
        c = self._negative_of(a)
        return self._symbol_for("abs", a if c is None else c)

    def sqrt(self, a: int) -> Symbol:
        self.questions[Question(a, None)] = None
        return self._symbol_for("sqrt", a)

    def root(self, a: int) -> Symbol:
        """The square root of what is never negative: nothing is asked."""
        return self._symbol_for("sqrt", a)

    def worded_operation(self, operation: str, *operands: int) -> Symbol:
        """What no rule does, but the words that tell of a drawing; its language must have a word for it."""
        return self._symbol_for(operation, *operands)

    def sign(self, a: int, scale: int) -> Symbol:
        return self._symbol_for("sign", a, scale)

    def nonzero(self, a: int, scale: int) -> Symbol:
        self.questions[Question(a, scale)] = None
        return Symbol(self, a)

    def _negative_of(self, a: int) -> int | None:
        """What an entry is the negative of."""
        entry = self.entries[a]
        return entry[1] if entry[0] == "neg" else None

    # ---- reading ----------------------------------------------------------------------------------------------

    def needed_places(self, wanted: Iterable[int]) -> list[int]:
        """The places on which the wanted ones rest, each after its operands and not long before it is used.

        What the first of them rests on comes first: few numbers are then waiting to be used at any time.
        """
        needed: dict[int, None] = {}
        for root in wanted:
            waiting = [root]
            while waiting:
                place = waiting[-1]
                unvisited = [a for a in operands(self.entries[place]) if a not in needed]
                if unvisited:
                    waiting.append(unvisited[0])
                else:
                    needed[waiting.pop()] = None
        return list(needed)


def operands(entry: Entry) -> tuple[int, ...]:
    """The places that an entry reads."""
    return () if entry[0] in LEAVES else entry[1:]


def _record_arithmetic(operation: Callable[[Tape, int, int], Symbol], swapped: bool = False) -> Callable[[Symbol, Any],
                                                                                                         Symbol]:
    """Arithmetic of a symbol with another number; `swapped`, that number comes first."""

    def record(symbol: Symbol, other: Any) -> Symbol:
        one, two = symbol.place, symbol.tape.place(other)
        return operation(symbol.tape, two, one) if swapped else operation(symbol.tape, one, two)

    return record


class Symbol:
    """A number that is not known yet; arithmetic with it is recorded."""

    __slots__ = ("place", "tape")

    def __init__(self, tape: Tape, place: int):
        self.tape, self.place = tape, place

    __add__ = __radd__ = _record_arithmetic(Tape.add)
    __sub__, __rsub__ = _record_arithmetic(Tape.sub), _record_arithmetic(Tape.sub, swapped=True)
    __mul__ = __rmul__ = _record_arithmetic(Tape.mul)
    __truediv__, __rtruediv__ = _record_arithmetic(Tape.div), _record_arithmetic(Tape.div, swapped=True)

    def __neg__(self) -> Symbol:
        return self.tape.neg(self.place)

    def __abs__(self) -> Symbol:
        return self.tape.abs(self.place)

    def root(self) -> Symbol:
        """The square root, of a sum of squares."""
        return self.tape.root(self.place)

    def __bool__(self) -> bool:
        raise TypeError("a rule may not branch on a number: ask the domain")


class Symbols(Domain):
    """The domain of symbols. What is told by constants alone is reckoned in floats at once, and fails at once."""

    def __init__(self) -> None:
        self.tape = Tape()

    def lift(self, value: Any) -> Any:
        return value if isinstance(value, Symbol) else float(value)

    def sqrt(self, value: Any, code: str, why: str) -> Any:
        return self.tape.sqrt(value.place) if isinstance(value, Symbol) else FLOATS.sqrt(value, code, why)

    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        if isinstance(value, Symbol) or isinstance(scale, Symbol):
            return self.tape.nonzero(self.tape.place(value), self.tape.place(scale))
        return FLOATS.nonzero(value, scale, code, why)

    def sign(self, value: Any, scale: Any) -> Any:
        if isinstance(value, Symbol) or isinstance(scale, Symbol):
            return self.tape.sign(self.tape.place(value), self.tape.place(scale))
        return FLOATS.sign(value, scale)
