"""A tape as numpy calls on blocks of poses: blocks stay in the cache, and every number is written into a used place.

A question is first asked of a whole block, by bounds: the least size of the value and the largest of what the scale is
made from. Only where the bounds leave it open is it asked of each pose of the block; the poses for which the answer is
no are handed back, and the others are done.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.numbers.floats import ZERO
from graphplan.kernel.tape.record import LEAVES, WRITTEN, Question, StatementWriter, Tape, compiled, operands, spoken

NOWHERE = np.empty(0, np.intp)
BLOCK = 4096  # poses: the numbers of some tens of marks then fit into the cache
CALLS = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide", "neg": "negative", "abs": "absolute",
         "sqrt": "sqrt", "sign": "sign"}
BOUNDED = ("+", "-", "*", "neg", "abs")  # what is no larger than its operands' sizes make it
HEAD = ("from numpy import absolute, add, divide, minimum, multiply, negative, sqrt, subtract",
        "from graphplan.kernel.tape.blocks import largest, least, refused, sign")


class Blocks:
    """The replay of a tape over arrays: made once, then `run` over any number of poses.

    With `machine` a block is one loop in machine code, by numba, else a list of numpy calls.
    """

    def __init__(self, tape: Tape, inputs: Sequence[int], outputs: Sequence[int], machine: bool = False):
        writer = None if machine else BlockWriter(tape, inputs, outputs)
        self._registers = writer.registers if writer else 0
        self._block = compiled(writer.text(), "block") if writer else loop(tape, inputs, outputs)

    def run(self, inputs: Sequence[Any], outputs: Sequence[Any]) -> Any:
        """Fill the outputs for n poses; the places of those in which a rule fails, whose outputs say nothing.

        Reads arrays of shape (n,), one for each input, and writes into those for each output. The places are an array
        of whole numbers, mostly an empty one: each is a pose to be asked of the rules, and no other is.
        """
        n, left = len(inputs[0]), [NOWHERE]
        size = min(n, BLOCK)
        read, registers, told = ([np.empty(size) for _ in range(count)]
                                 for count in (len(inputs), self._registers, len(outputs)))
        with np.errstate(all="ignore"):
            for start in range(0, n, BLOCK):
                part = slice(start, min(start + BLOCK, n))
                if part.stop - start < size:
                    read, registers, told = ([array[: part.stop - start] for array in arrays]
                                             for arrays in (read, registers, told))
                for numbers, array in zip(read, inputs, strict=True):  # they may stand among others, as real parts do
                    numbers[:] = array[part]
                refused = self._block(read, told, registers)
                for output, numbers in zip(outputs, told, strict=True):
                    output[part] = numbers
                if refused is not None:
                    left.append(start + np.flatnonzero(refused))
        return np.concatenate(left)


def refused(before: Any, value: Any, scale: Any = None) -> Any:
    """The poses in which a question fails, or one before it did: nonzero beside the scale? Without one: not negative?
    """
    size = np.absolute(value)
    fails = value < 0.0 if scale is None else ~((ZERO * scale < size) & (size < np.inf))
    return fails if before is None else before | fails


def largest(numbers: Any) -> float:
    """The largest size in a block; nan where any is."""
    high, low = float(np.maximum.reduce(numbers)), float(np.minimum.reduce(numbers))
    return high if high >= -low else -low  # nan in one is nan in both


def least(numbers: Any) -> float:
    """The least size in a block; nan where any is."""
    low = float(np.minimum.reduce(numbers))
    if low >= 0.0:
        return low
    high = float(np.maximum.reduce(numbers))
    return -high if high <= 0.0 else float(np.minimum.reduce(np.absolute(numbers)))


def sign(value: Any, scale: Any, told: Any) -> None:
    """Tell 1, -1, or 0 where a value is nothing beside its scale."""
    told[:] = np.where(np.absolute(value) <= ZERO * scale, 0.0, np.sign(value))


def loop(tape: Tape, inputs: Sequence[int], outputs: Sequence[int]) -> Callable[..., Any]:
    """A machine-code `block(inputs, outputs, registers)`, for numba: worth its compiling for millions of poses."""
    try:
        from numba import njit
    except ImportError:
        raise Refused("compiled", "numba is not installed", "pip install 'graphplan[numba]', or leave it out") from None
    reads = [f"v{place} = I[{k}][k]" for k, place in enumerate(inputs)]
    tells = [f"O[{k}][k] = {spoken(tape, place)}" for k, place in enumerate(outputs)]
    body = "\n        ".join([*reads, "bad = False", *StatementWriter(tape, outputs, "bad = True").lines, *tells,
                              "B[k] = bad"])
    text = f"def block(I, O, B):\n    for k in range(B.size):\n        {body}"
    made = njit(error_model="numpy")(compiled(text, "block"))

    def block(I: Sequence[Any], O: Sequence[Any], R: Sequence[Any]) -> Any:
        bad = np.empty(len((*I, *O)[0]), bool)
        made(tuple(I), tuple(O), bad)
        return bad

    return block


class BlockWriter:
    """Writes the function for one block; numbers are kept in registers, each taken again when its number is done with.
    """

    def __init__(self, tape: Tape, inputs: Sequence[int], outputs: Sequence[int]):
        self.tape, self.inputs, self.outputs = tape, len(inputs), len(outputs)
        self.names = {place: f"i{k}" for k, place in enumerate(inputs)}
        self.told: dict[int, int] = {}
        for k, place in enumerate(outputs):
            self.told.setdefault(place, k)
        self.copies = [(k, place) for k, place in enumerate(outputs) if self.told[place] != k or self._leaf(place)]
        self.marks = set(tape.needed([*outputs, *(q.value for q in tape.questions)]))
        self.marks.update(tape.needed(a for q in tape.questions for a in self._leaves(q.scale)))
        self.registers, self.free = 0, list[str]()
        self.lines: list[str] = []
        self.sizes: dict[int, str] = {}
        self._write(sorted(self.marks))

    def text(self) -> str:
        """What makes the function `block(inputs, outputs, registers)`: a mask of the poses in which a question fails.

        None stands for no pose.
        """
        counts = {"i": self.inputs, "o": self.outputs, "r": self.registers}
        unpack = [f"{', '.join(f'{letter}{k}' for k in range(count))}, = {letter.upper()}"
                  for letter, count in counts.items() if count]
        copies = [f"o{k}[:] = {self._name(place)}" for k, place in self.copies]
        body = [*unpack, "bad = None", *self.lines, *copies, "return bad"]
        return "\n".join([*HEAD, "\n    ".join(["def block(I, O, R):", *body])])

    def _leaf(self, place: int) -> bool:
        return self.tape.entries[place][0] in LEAVES

    def _write(self, needed: Sequence[int]) -> None:
        """Each number, then the questions that can be asked with it, then its operands are let go if done with."""
        asked = self._asked()
        last = {a: place for place in needed for a in operands(self.tape.entries[place])}
        for place, questions in asked.items():
            for question in questions:
                last.update((a, max(place, last.get(a, 0))) for a in (question.value, *self._leaves(question.scale)))
        ends: dict[int, list[int]] = {}
        for place, end in last.items():
            ends.setdefault(end, []).append(place)
        for place in needed:
            if not self._leaf(place):
                self._make(place, [a for a in ends.get(place, []) if a in operands(self.tape.entries[place])
                                   and place not in asked])
            for question in asked.get(place, []):
                self._ask(question)
            for done in ends.get(place, []):
                self._release(done)

    def _asked(self) -> dict[int, list[Question]]:
        """The questions, by the place after which all that they need is there."""
        found: dict[int, list[Question]] = {}
        for question in self.tape.questions:
            found.setdefault(max([question.value, *self._leaves(question.scale)]), []).append(question)
        return found

    def _make(self, place: int, ending: Sequence[int]) -> None:
        op, *args = self.tape.entries[place]
        called = ", ".join(map(self._name, args))
        for done in ending:  # its own place may take the result
            self._release(done)
        target = f"o{self.told[place]}" if place in self.told else self._taken()
        self.names[place] = target
        self.lines.append(f"{CALLS[op]}({called}, {target})")

    def _taken(self) -> str:
        if self.free:
            return self.free.pop()
        self.registers += 1
        return f"r{self.registers - 1}"

    def _release(self, place: int) -> None:
        if self.names.get(place, "").startswith("r"):
            self.free.append(self.names.pop(place))

    def _name(self, place: int) -> str:
        return repr(self.tape.entries[place][1]) if self.tape.is_constant(place) else self.names[place]

    # ---- questions --------------------------------------------------------------------------------------------

    def _ask(self, question: Question) -> None:
        """The question by its bounds; where they leave it open, pose by pose."""
        value = self._name(question.value)
        if question.scale is None:
            self.lines.append(f"if not minimum.reduce({value}) >= 0.0: bad = refused(bad, {value})")
            return
        least = f"minimum.reduce({value})" if self._never_negative(question.value) else f"least({value})"
        if self.tape.is_constant(question.value):
            least = repr(abs(self.tape.entries[question.value][1]))
        self.lines.append(f"if not {least} > {ZERO!r} * {self._bound(question.scale)}: "
                          f"bad = refused(bad, {value}, {self._each(question.scale)})")

    def _each(self, place: int) -> str:
        """An expression for a scale pose by pose."""
        op, *args = self.tape.entries[place]
        if op == "constant" or place in self.marks or op not in BOUNDED:
            return self._name(place)
        return WRITTEN[op].format(*map(self._each, args))

    def _leaves(self, place: int | None) -> Iterator[int]:
        """The numbers of the tape from which the size of a scale is bounded."""
        if place is None or self.tape.is_constant(place):
            return
        entry = self.tape.entries[place]
        if place in self.marks or entry[0] not in BOUNDED:
            yield place
        else:
            for a in operands(entry):
                yield from self._leaves(a)

    def _bound(self, place: int) -> str:
        """An expression for the largest size that a number has in the block."""
        entry = self.tape.entries[place]
        if entry[0] == "constant":
            return repr(abs(entry[1]))
        if place in self.marks or entry[0] not in BOUNDED:
            return self._size(place)
        parts = [self._bound(a) for a in operands(entry)]
        return parts[0] if len(parts) == 1 else f"({parts[0]} {'*' if entry[0] == '*' else '+'} {parts[1]})"

    def _size(self, place: int) -> str:
        if place not in self.sizes:
            self.sizes[place] = f"m{place}"
            self.lines.append(f"m{place} = largest({self._name(place)})")
        return self.sizes[place]

    def _never_negative(self, place: int) -> bool:
        op, *args = self.tape.entries[place]
        return op in ("abs", "sqrt") or (op == "*" and args[0] == args[1]) or (
            op in ("+", "*", "/") and all(self._never_negative(a) for a in args))
