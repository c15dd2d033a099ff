"""A tape: the arithmetic of a rule recorded once, written as Python text, and run over blocks of poses.

Symbols pass through the rules instead of numbers. The same operation is done once, and signs move outwards, by
identities that hold in rounded arithmetic too: so a tape gives the same numbers as the rules, to the last bit (only a
zero may change its sign).

The questions become comparisons; where one fails the pose is handed back, to be asked of the rules, which know what to
say.

A number that is used once stands where it is used; the others have names. All languages that compute in doubles, each
operation rounded once, give the very numbers of the rules.

The poses in which a question fails are handed back, and the others are done.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import count
from typing import Any, NamedTuple

import numpy as np

from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.tolerances import ROUNDOFF_TOL

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
    """A recorded computation: `entries` in order, and its questions, each once, in order."""

    entries: list[Entry] = field(default_factory=list)
    questions: dict[Question, None] = field(default_factory=dict)
    _places: dict[Entry, int] = field(default_factory=dict)

    def input(self, name: str) -> Symbol:
        """A number that is told at the replay."""
        return self._symbol_for("in", name)

    def place(self, number: Any) -> int:
        """Place of a number on the tape: a symbol, or a constant."""
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
        """The square root of a number that is never negative: no question is asked."""
        return self._symbol_for("sqrt", a)

    def worded_operation(self, operation: str, *operands: int) -> Symbol:
        """An operation that no rule has, for the words of a drawing; its language must have a word for it."""
        return self._symbol_for(operation, *operands)

    def sign(self, a: int, scale: int) -> Symbol:
        return self._symbol_for("sign", a, scale)

    def nonzero(self, a: int, scale: int) -> Symbol:
        self.questions[Question(a, scale)] = None
        return Symbol(self, a)

    def _negative_of(self, a: int) -> int | None:
        """The entry of which an entry is the negative."""
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


MAX_NESTING = 13  # operations within each other that one statement may hold
TWICE = "sign"  # names its operands twice: they must be names


class Language(NamedTuple):
    """Notation of a language for numbers, operations, statements and questions.

    Operations are those of the tape by sign, with {0}, {1} for their operands; `sign` has a third place, for the part
    of {1} below which {0} counts as zero. `{name}` is the name of the result, where it must be known. A statement gives
    {1} the name {0}. A question is asked of {0}: nonzero relative to {2} times {1}, or not negative; what follows from
    a no stands there too. If it `loads`, an input has a statement of its own.
    """

    number: Callable[[float], str]
    written: Mapping[str, str]
    statement: str = ""
    nonzero: str = ""
    root: str = ""
    loads: bool = False


def operations(sqrt: str, absolute: str, sign: str) -> dict[str, str]:
    """The operations as nearly every language writes them."""
    return {"+": "({} + {})", "-": "({} - {})", "*": "({} * {})", "/": "({} / {})", "neg": "(-{})",
            "sqrt": sqrt, "abs": absolute, "sign": sign}


PYTHON = Language(
    repr, operations("sqrt({})", "abs({})", "(0.0 if abs({0}) <= {2} * {1} else copysign(1.0, {0}))"),
    "{0} = {1}", "if not {2} * {1} < abs({0}) < inf: return None", "if {0} < 0.0: return None")
JAVASCRIPT = Language(
    repr, operations("Math.sqrt({})", "Math.abs({})", "(Math.abs({0}) <= {2} * {1} ? 0 : Math.sign({0}))"),
    "const {0} = {1};", "if (!({2} * {1} < Math.abs({0}) && Math.abs({0}) < Infinity)) return null;",
    "if ({0} < 0) return null;")
C = Language(
    repr, operations(
        "sqrt({})", "fabs({})", "(fabs({0}) <= {2} * {1} ? 0.0 : {0} > 0.0 ? 1.0 : {0} < 0.0 ? -1.0 : {0})"),
    "const double {0} = {1};", "bad = ({2} * {1} < fabs({0})) & (fabs({0}) < INFINITY) ? bad : NAN;",
    "bad = {0} < 0.0 ? NAN : bad;", loads=True)

ARRAYS = Language(
    repr, operations("xp.sqrt({})", "xp.abs({})",
                     "xp.where(xp.abs({0}) <= {2} * {1}, xp.zeros_like({0}), xp.sign({0}))"),
    "{0} = {1}", "bad = bad | ~(({2} * {1} < xp.abs({0})) & (xp.abs({0}) < inf))", "bad = bad | ({0} < 0.0)")


class Writer:
    """Writes numbers of a tape in a language: `text` says how each is called or, where it is used once, made.

    Inputs are called, or loaded, as `inputs` says, by place, else by their own names; other names are `prefix` and a
    number, and without a prefix there are none.
    """

    def __init__(self, tape: Tape, language: Language, inputs: Mapping[int, str] | None = None, prefix: str = "v",
                 deepest: float = MAX_NESTING):
        self.tape, self.language, self.prefix, self.deepest = tape, language, prefix, deepest
        self.inputs = inputs or {}
        self.text: dict[int, str] = {}
        self._depth: dict[int, int] = {}
        self._uses: Counter[int] = Counter()

    def terms(self, wanted: Sequence[int], questions: Iterable[Question] = ()) -> Iterator[tuple[str, str]]:
        """Name and text of each number that has a name; of a question, once it can be asked, the text and no name."""
        asked = [asked_of(question) for question in questions]
        needed = self.tape.needed_places([*wanted, *(place for places in asked for place in places)])
        self._count(wanted, needed, asked)
        after = dict(zip(needed, range(len(needed)), strict=True))
        waiting: dict[int, list[tuple[int, ...]]] = {}
        for places in asked:
            waiting.setdefault(max(places, key=after.__getitem__), []).append(places)
        names, answers = (map(f"{self.prefix}{letter}{{}}".format, count(1)) for letter in ("", "q"))
        name = next(names)
        for place in needed:
            if self._is_named(place, name):
                text, self.text[place] = self.text[place], name
                yield name, text
                name = next(names)
            for places in waiting.get(place, ()):
                yield "", self._question(places, next(answers))

    def statements(self, wanted: Sequence[int], questions: Iterable[Question] = ()) -> list[str]:
        """The terms as statements of the language."""
        return [self.language.statement.format(name, text) if name else text
                for name, text in self.terms(wanted, questions)]

    def _count(self, wanted: Iterable[int], needed: Sequence[int], asked: Iterable[tuple[int, ...]]) -> None:
        """Count the uses of each number: by wanted results, by other entries, and by questions, which use theirs
        twice."""
        entries = self.tape.entries
        self._uses.update(wanted)
        self._uses.update(place for entry in needed for place in operands(entries[entry]))
        self._uses.update(place for entry in needed if entries[entry][0] == TWICE for place in operands(entries[entry]))
        self._uses.update(2 * [place for places in asked for place in places])

    def _is_named(self, place: int, name: str) -> bool:
        """Whether a number, whose text is written, is to bear this name."""
        op, *args = self.tape.entries[place]
        self._depth[place] = 0
        if op == "constant":
            self.text[place] = self.language.number(args[0])
            return False
        if op == "in":
            self.text[place] = self.inputs.get(place, args[0])
            if self.language.loads:
                self.text[place] = self.text[place].format(name=name)
            return self.language.loads
        texts = [self.text[a] for a in args]
        self.text[place] = self.language.written[op].format(*texts, self.language.number(ROUNDOFF_TOL), name=name)
        depth = 1 + max(self._depth[a] for a in args)
        if self.prefix and (self._uses[place] > 1 or depth >= self.deepest):
            return True
        self._depth[place] = depth
        return False

    def _question(self, places: tuple[int, ...], name: str) -> str:
        template = self.language.root if len(places) == 1 else self.language.nonzero
        return template.format(*(self.text[place] for place in places), self.language.number(ROUNDOFF_TOL), name=name)


def asked_of(question: Question) -> tuple[int, ...]:
    """The places that a question reads."""
    return (question.value,) if question.scale is None else (question.value, question.scale)


def function(tape: Tape, inputs: Sequence[int], told: Any) -> Callable[..., Any]:
    """A Python function from the inputs (places of the tape) to what is told, or to None where a question fails.

    `told` is a place, or tuples and dictionaries of such; the function gives floats in the same shape. It may raise
    ZeroDivisionError or OverflowError where the rules would.
    """
    return _python_function(tape, PYTHON, inputs, told, "def replay({}):", "return {}")


def array_function(tape: Tape, inputs: Sequence[int], told: Any) -> Callable[..., Any]:
    """The tape as a function over arrays of any library that has the array API, in doubles.

    The function reads the library's module and an array for each input. It gives what is told, in the same shape, and
    a mask of the poses in which a question fails: what is told of these says nothing. It branches on no number, so that
    libraries that trace functions, to differentiate or compile them, take it as it is.
    """
    return _python_function(tape, ARRAYS, inputs, told, "def replay(xp, {0}):\n    bad = x0 != x0", "return {}, bad")


def _python_function(tape: Tape, language: Language, inputs: Sequence[int], told: Any, head: str,
                     end: str) -> Callable[..., Any]:
    names = {place: f"x{k}" for k, place in enumerate(inputs)}
    writer = Writer(tape, language, names)
    body = [*writer.statements(list(places(told)), tape.questions), end.format(shape_expression(told, writer.text))]
    return compile_python("\n    ".join([head.format(", ".join(names.values())), *body]), "replay")


def places(told: Any) -> Iterator[int]:
    """The places in a shape, in order."""
    if isinstance(told, int):
        yield told
    else:
        for part in told.values() if isinstance(told, dict) else told:
            yield from places(part)


def shape_expression(told: Any, text: Mapping[int, str], brackets: str = "()") -> str:
    """The expression for what is told; tuples in these brackets."""
    if isinstance(told, dict):
        return "{" + ", ".join(f"{name!r}: {shape_expression(part, text, brackets)}"
                               for name, part in told.items()) + "}"
    if isinstance(told, tuple):
        return brackets[0] + "".join(f"{shape_expression(part, text, brackets)}, " for part in told) + brackets[1]
    return text[told]


@lru_cache(maxsize=64)
def compile_python(text: str, name: str) -> Callable[..., Any]:
    """The function of this name in a written text; the same text is compiled once."""
    space: dict[str, Any] = {"sqrt": math.sqrt, "copysign": math.copysign, "inf": math.inf}
    exec(compile(text, "<graphplan tape>", "exec"), space)
    made: Callable[..., Any] = space[name]
    return made


NOWHERE = np.empty(0, np.intp)
BLOCK = 4096  # poses at most: with more the calls of numpy become no cheaper
MIN_BLOCK_POSES = 1024  # poses: with fewer the calls take longer than the arithmetic
CACHE = 1 << 22  # bytes that the registers of a block may take
CALLS = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide", "neg": "negative", "abs": "absolute",
         "sqrt": "sqrt", "sign": "sign"}
HEAD = ("from numpy import absolute, add, divide, multiply, negative, sqrt, subtract",
        "from graphplan.kernel.tape.record import refused_poses, sign")


class Blocks:
    """The replay of a tape over arrays: made once, then `run` over any number of poses, `length` of them at a time."""

    def __init__(self, tape: Tape, inputs: Sequence[int], outputs: Sequence[int]):
        writer = BlockWriter(tape, inputs, outputs)
        self._registers, self._block = writer.registers, compile_python(writer.text(), "block")
        self.length = max(MIN_BLOCK_POSES, min(BLOCK, CACHE // (8 * max(1, self._registers))))

    def run(self, inputs: Sequence[Any], outputs: Sequence[Any]) -> Any:
        """Fill the outputs for n poses; return the places of those in which a rule fails, whose outputs are undefined.

        Reads arrays of shape (n,), one for each input, and writes into those for each output; they may stand among
        other numbers, as the real parts of complex ones do. The places are an array of whole numbers, mostly an empty
        one: each is a pose to be asked of the rules, and no other is.
        """
        n, left = len(inputs[0]), [NOWHERE]
        registers = [np.empty(min(n, self.length)) for _ in range(self._registers)]
        with np.errstate(all="ignore"):
            for start in range(0, n, self.length):
                part = slice(start, start + self.length)
                if n - start < self.length:
                    registers = [register[: n - start] for register in registers]
                refused = self._block([array[part] for array in inputs], [array[part] for array in outputs], registers)
                if refused is not None:
                    left.append(start + np.flatnonzero(refused))
        return np.concatenate(left)


def refused_poses(before: Any, value: Any, scale: Any = None) -> Any:
    """The poses in which a question fails, or one before it did: nonzero beside the scale? Without one: not negative?
    """
    size = np.absolute(value)
    fails = value < 0.0 if scale is None else ~((ROUNDOFF_TOL * scale < size) & (size < np.inf))
    return fails if before is None else before | fails


def sign(value: Any, scale: Any, told: Any) -> None:
    """Write the sign of a value, 1 or -1, or 0 if it is negligible relative to its scale."""
    told[:] = np.where(np.absolute(value) <= ROUNDOFF_TOL * scale, 0.0, np.sign(value))


class BlockWriter:
    """Writes the function for one block; numbers are kept in registers, each used again when its number is not needed
    any more."""

    def __init__(self, tape: Tape, inputs: Sequence[int], outputs: Sequence[int]):
        self.tape, self.counts = tape, (len(inputs), len(outputs))
        self.inputs = {place: k for k, place in enumerate(inputs)}
        self.outputs: dict[int, list[int]] = {}
        for k, place in enumerate(outputs):
            self.outputs.setdefault(place, []).append(k)
        self.names: dict[int, str] = {}
        self.registers, self.free = 0, list[str]()
        self.lines: list[str] = []
        self._write(tape.needed_places([*outputs, *(a for question in tape.questions for a in asked_of(question))]))

    def text(self) -> str:
        """Source of the function `block(inputs, outputs, registers)`, which returns a mask of the poses in which a
        question fails.

        None stands for no pose.
        """
        counts = dict(zip("ior", (*self.counts, self.registers), strict=True))
        unpack = [f"{', '.join(f'{letter}{k}' for k in range(count))}, = {letter.upper()}"
                  for letter, count in counts.items() if count]
        body = [*unpack, "bad = None", *self.lines, "return bad"]
        return "\n".join([*HEAD, "\n    ".join(["def block(I, O, R):", *body])])

    def _write(self, needed: Sequence[int]) -> None:
        """Each number, then the questions that can be asked with it, then its operands are let go if done with."""
        order = {place: k for k, place in enumerate(needed)}
        questions: dict[int, list[Question]] = {}
        last = {place: place for place in needed}
        last.update((a, place) for place in needed for a in operands(self.tape.entries[place]))
        for question in self.tape.questions:
            place = max(asked_of(question), key=order.__getitem__)
            questions.setdefault(place, []).append(question)
            last.update((a, max(place, last[a], key=order.__getitem__)) for a in asked_of(question))
        ends: dict[int, list[int]] = {}
        for place, end in last.items():
            ends.setdefault(end, []).append(place)
        for place in needed:
            over = [] if place in questions else ends.get(place, [])
            self._make(place, [a for a in over if a in operands(self.tape.entries[place])])
            self.lines.extend(f"o{k}[:] = {self._name(place)}" for k in self.outputs.get(place, ()))
            self.lines.extend(f"bad = refused_poses(bad, {', '.join(map(self._name, asked_of(question)))})"
                              for question in questions.get(place, ()))
            for done in ends.get(place, ()):
                self._release(done)

    def _make(self, place: int, ending: Sequence[int]) -> None:
        """A number into a register; one of an operand that is done with may take it."""
        op, *args = self.tape.entries[place]
        if op == "constant":
            return
        called = [] if op == "in" else list(map(self._name, args))
        for done in ending:
            self._release(done)
        if not self.free:
            self.free.append(f"r{self.registers}")
            self.registers += 1
        self.names[place] = target = self.free.pop()
        self.lines.append(f"{target}[:] = i{self.inputs[place]}" if op == "in" else
                          f"{CALLS[op]}({', '.join([*called, target])})")

    def _release(self, place: int) -> None:
        if place in self.names:
            self.free.append(self.names.pop(place))

    def _name(self, place: int) -> str:
        return repr(self.tape.entries[place][1]) if self.tape.is_constant(place) else self.names[place]
