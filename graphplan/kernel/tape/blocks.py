"""A tape as numpy calls on blocks of poses: blocks stay in the cache, and every number is written into a used place.

A question is first asked of a whole block, by bounds: the least size of the value and the largest of what the scale is
made from. Only where the bounds leave it open is it asked of each pose of the block; the poses for which the answer is
no are handed back, and the others are done.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from graphplan.kernel.tape.record import Question, Tape, operands
from graphplan.kernel.tape.written import PYTHON, asked_of, compile_python
from graphplan.kernel.tolerances import NORM_MARGIN, ROUNDOFF_TOL, UNDERFLOW

NOWHERE = np.empty(0, np.intp)
BLOCK = 4096  # poses at most: with more the calls of numpy become no cheaper
MIN_BLOCK_POSES = 1024  # poses: with fewer the calls take longer than the arithmetic
CACHE = 1 << 22  # bytes that the registers of a block may take
CALLS = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide", "neg": "negative", "abs": "absolute",
         "sqrt": "sqrt", "sign": "sign"}
BOUNDED = ("+", "-", "*", "neg", "abs")  # what is no larger than its operands' sizes make it
HEAD = ("from numpy import absolute, add, divide, minimum, multiply, negative, sqrt, subtract",
        "from graphplan.kernel.tape.blocks import largest, least_size, refused_poses, sign")


class Blocks:
    """The replay of a tape over arrays: made once, then `run` over any number of poses, `length` of them at a time."""

    def __init__(self, tape: Tape, inputs: Sequence[int], outputs: Sequence[int]):
        writer = BlockWriter(tape, inputs, outputs)
        self._registers, self._block = writer.registers, compile_python(writer.text(), "block")
        self.length = max(MIN_BLOCK_POSES, min(BLOCK, CACHE // (8 * max(1, self._registers))))

    def run(self, inputs: Sequence[Any], outputs: Sequence[Any]) -> Any:
        """Fill the outputs for n poses; the places of those in which a rule fails, whose outputs say nothing.

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


def largest(numbers: Any) -> float:
    """A bound of the sizes in a block: the root of the sum of squares is one call, and it need not be tight."""
    return NORM_MARGIN * math.sqrt(float(numbers.dot(numbers)) + UNDERFLOW)


def least_size(numbers: Any) -> float:
    """The least size in a block; nan where any is."""
    low = float(np.minimum.reduce(numbers))
    if low >= 0.0:
        return low
    high = float(np.maximum.reduce(numbers))
    return -high if high <= 0.0 else float(np.minimum.reduce(np.absolute(numbers)))


def sign(value: Any, scale: Any, told: Any) -> None:
    """Tell 1, -1, or 0 where a value is nothing beside its scale."""
    told[:] = np.where(np.absolute(value) <= ROUNDOFF_TOL * scale, 0.0, np.sign(value))


class BlockWriter:
    """Writes the function for one block; numbers are kept in registers, each taken again when its number is done with.

    Measured are, as soon as they are there, the largest sizes of the inputs, quotients and roots that scales are made
    from, and the least sizes of what the values are made from that are asked: the bounds are sums of products of these.
    """

    def __init__(self, tape: Tape, inputs: Sequence[int], outputs: Sequence[int]):
        self.tape, self.counts = tape, (len(inputs), len(outputs))
        self.inputs = {place: k for k, place in enumerate(inputs)}
        self.outputs: dict[int, list[int]] = {}
        for k, place in enumerate(outputs):
            self.outputs.setdefault(place, []).append(k)
        self.names: dict[int, str] = {}
        self.marks = set(tape.needed_places(outputs))
        self.high = self._sources((q.scale for q in tape.questions if q.scale is not None), self._is_bounded_by_sums)
        self.low = self._sources((q.value for q in tape.questions), self._grows)
        needed = tape.needed_places([*outputs, *self.low, *self.high])
        self.marks.update(needed)
        self.registers, self.free = 0, list[str]()
        self.lines: list[str] = []
        self._bounded: dict[int, str] = {}
        self._write(needed)

    def text(self) -> str:
        """What makes the function `block(inputs, outputs, registers)`: a mask of the poses in which a question fails.

        None stands for no pose.
        """
        counts = dict(zip("ior", (*self.counts, self.registers), strict=True))
        unpack = [f"{', '.join(f'{letter}{k}' for k in range(count))}, = {letter.upper()}"
                  for letter, count in counts.items() if count]
        body = [*unpack, "bad = None", *self.lines, "return bad"]
        return "\n".join([*HEAD, "\n    ".join(["def block(I, O, R):", *body])])

    def _is_bounded_by_sums(self, place: int) -> bool:
        """Whether a number is no larger than sums of products of its operands' sizes."""
        return self.tape.entries[place][0] in BOUNDED

    def _grows(self, place: int) -> bool:
        """Whether a number, made for a question alone, is no smaller than what its operands' least sizes make."""
        return place not in self.marks and self.tape.entries[place][0] in BOUNDED and self._never_negative(place)

    def _sources(self, wanted: Iterable[int], made: Callable[[int], bool]) -> set[int]:
        """The numbers from which these are made, as far as their sizes tell theirs."""
        sources, waiting, seen = set[int](), [*wanted], set[int]()
        while waiting:
            place = waiting.pop()
            if place not in seen and not self.tape.is_constant(place):
                seen.add(place)
                if made(place):
                    waiting.extend(operands(self.tape.entries[place]))
                else:
                    sources.add(place)
        return sources

    def _write(self, needed: Sequence[int]) -> None:
        """Each number, then the questions that can be asked with it, then its operands are let go if done with."""
        order = {place: k for k, place in enumerate(needed)}
        asked = dict[int, list[Question]]()
        for question in self.tape.questions:
            asked.setdefault(max(self._read(question), key=order.__getitem__), []).append(question)
        last = {place: place for place in needed}
        last.update((a, place) for place in needed for a in operands(self.tape.entries[place]))
        for place, questions in asked.items():
            for question in questions:
                last.update((a, max(place, last[a], key=order.__getitem__)) for a in self._read(question))
        ends: dict[int, list[int]] = {}
        for place, end in last.items():
            ends.setdefault(end, []).append(place)
        for place in needed:
            over = [] if place in asked else ends.get(place, [])
            self._make(place, [a for a in over if a in operands(self.tape.entries[place])])
            self.lines.extend(f"o{k}[:] = {self._name(place)}" for k in self.outputs.get(place, ()))
            if place in self.high:
                self.lines.append(f"m{place} = largest({self._name(place)})")
            if place in self.low:
                least = "minimum.reduce" if self._never_negative(place) else "least_size"
                self.lines.append(f"l{place} = {least}({self._name(place)})")
            for question in asked.get(place, []):
                self._ask(question)
            for done in ends.get(place, []):
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

    # ---- questions --------------------------------------------------------------------------------------------

    def _ask(self, question: Question) -> None:
        """The question by its bounds; where they leave it open, pose by pose."""
        value = self._pointwise_expression(question.value)
        if question.scale is None:
            self.lines.append(f"if not minimum.reduce({value}) >= 0.0: bad = refused_poses(bad, {value})")
            return
        lower_bound = self._lower_bound_expression(question.value)
        self.lines.append(f"if not {lower_bound} > {ROUNDOFF_TOL!r} * {self._largest(question.scale)}: "
                          f"bad = refused_poses(bad, {value}, {self._pointwise_expression(question.scale)})")

    def _pointwise_expression(self, place: int) -> str:
        """An expression for a number pose by pose."""
        op, *args = self.tape.entries[place]
        if op == "constant" or place in self.marks:
            return self._name(place)
        return PYTHON.written[op].format(*map(self._pointwise_expression, args))

    def _read(self, question: Question) -> Iterator[int]:
        """The numbers that a question reads pose by pose."""
        waiting = list(asked_of(question))
        while waiting:
            place = waiting.pop()
            if place in self.marks and not self.tape.is_constant(place):
                yield place
            else:
                waiting.extend(operands(self.tape.entries[place]))

    def _largest(self, place: int) -> str:
        """How a bound of a number's sizes in the block is called; what it is made of stands before."""
        op, *args = self.tape.entries[place]
        if op == "constant":
            return repr(abs(args[0]))
        if place in self.high:
            return f"m{place}"
        if place not in self._bounded:
            self._bounded[place] = self._largest(args[0]) if len(args) == 1 else f"m{place}"
            if len(args) == 2:
                one, two = map(self._largest, args)
                self.lines.append(f"m{place} = {one} {'*' if op == '*' else '+'} {two}")
        return self._bounded[place]

    def _lower_bound_expression(self, place: int) -> str:
        """An expression for a bound of a number's sizes from below."""
        op, *args = self.tape.entries[place]
        if op == "constant":
            return repr(abs(args[0]))
        if place in self.low:
            return f"l{place}"
        return PYTHON.written[op].format(*map(self._lower_bound_expression, args)).replace("abs", "")

    def _never_negative(self, place: int) -> bool:
        op, *args = self.tape.entries[place]
        return op in ("abs", "sqrt") or (op == "*" and args[0] == args[1]) or (
            op in ("+", "*", "/") and all(self._never_negative(a) for a in args))
