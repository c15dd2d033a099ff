"""A tape as numpy calls on blocks of poses: blocks stay in the cache, and every number is written into a used place.

The poses in which a question fails are handed back, and the others are done.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from graphplan.kernel.tape.record import Question, Tape, operands
from graphplan.kernel.tape.written import asked_of, compile_python
from graphplan.kernel.tolerances import ROUNDOFF_TOL

NOWHERE = np.empty(0, np.intp)
BLOCK = 4096  # poses at most: with more the calls of numpy become no cheaper
MIN_BLOCK_POSES = 1024  # poses: with fewer the calls take longer than the arithmetic
CACHE = 1 << 22  # bytes that the registers of a block may take
CALLS = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide", "neg": "negative", "abs": "absolute",
         "sqrt": "sqrt", "sign": "sign"}
HEAD = ("from numpy import absolute, add, divide, multiply, negative, sqrt, subtract",
        "from graphplan.kernel.tape.blocks import refused_poses, sign")


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


def sign(value: Any, scale: Any, told: Any) -> None:
    """Tell 1, -1, or 0 where a value is nothing beside its scale."""
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
        """What makes the function `block(inputs, outputs, registers)`: a mask of the poses in which a question fails.

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
