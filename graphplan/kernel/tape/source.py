"""A tape as straight-line Python for one pose: what numbers stand where, written out once and compiled.

A number that is used once stands where it is used. The questions become comparisons; where one fails the pose is
handed back, to be asked of the rules, which know what to say.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import Any

from graphplan.kernel.numbers.floats import ZERO
from graphplan.kernel.tape.record import Question, Tape, operands

DEEPEST = 12  # brackets within brackets that a written number may have
WRITTEN = {"+": "({} + {})", "-": "({} - {})", "*": "({} * {})", "/": "({} / {})", "neg": "(-{})", "abs": "abs({})",
           "sqrt": "sqrt({})", "sign": f"(0.0 if abs({{0}}) <= {ZERO!r} * {{1}} else copysign(1.0, {{0}}))"}
TWICE = "sign"  # names its operands twice: they must be names


def spoken(tape: Tape, place: int) -> str:
    """How a finished number is called: by its name, or as the constant that it is."""
    return repr(tape.entries[place][1]) if tape.is_constant(place) else f"v{place}"


class StatementWriter:
    """`lines`: the statements that make each needed number; `hand_back` is what is done where a question fails.

    Inputs and outputs are told by :func:`spoken`.
    """

    def __init__(self, tape: Tape, outputs: Sequence[int], hand_back: str):
        self.tape, self.hand_back = tape, hand_back
        roots = [*outputs, *(place for q in tape.questions for place in _places(q))]
        needed = tape.needed(roots)
        self.uses = Counter(place for entry in needed for place in operands(tape.entries[entry]))
        self.uses.update(2 * roots)  # what is asked or told has a name of its own
        self.uses.update(place for entry in needed if tape.entries[entry][0] == TWICE
                         for place in operands(tape.entries[entry]))
        self.text: dict[int, str] = {}
        self.depth: dict[int, int] = {}
        self.lines: list[str] = []
        waiting = sorted(tape.questions, key=lambda q: max(_places(q)), reverse=True)
        for place in needed:
            self._enter(place)
            while waiting and max(_places(waiting[-1])) == place:
                self._ask(waiting.pop())

    def _enter(self, place: int) -> None:
        op, *args = self.tape.entries[place]
        self.depth[place] = 0
        if op == "constant":
            self.text[place] = spoken(self.tape, place)
        elif op == "in":
            self.text[place] = f"v{place}"
        else:
            expression = WRITTEN[op].format(*(self.text[a] for a in args))
            depth = 1 + max(self.depth[a] for a in args)
            if self.uses[place] > 1 or depth > DEEPEST:
                self.lines.append(f"v{place} = {expression}")
                self.text[place] = f"v{place}"
            else:
                self.text[place], self.depth[place] = expression, depth

    def _ask(self, question: Question) -> None:
        value = self.text[question.value]
        if question.scale is None:
            self.lines.append(f"if {value} < 0.0: {self.hand_back}")
        else:
            self.lines.append(f"if not {ZERO!r} * {self.text[question.scale]} < abs({value}) < inf: {self.hand_back}")


def _places(question: Question) -> tuple[int, ...]:
    return (question.value,) if question.scale is None else (question.value, question.scale)


def function(tape: Tape, inputs: Sequence[int], told: Any) -> Callable[..., Any]:
    """A Python function from the inputs (places of the tape) to what is told, or to None where a question fails.

    `told` is a place, or tuples and dictionaries of such; the function gives floats in the same shape. It may raise
    ZeroDivisionError or OverflowError where the rules would.
    """
    head = f"def replay({', '.join(f'v{place}' for place in inputs)}):"
    body = [*StatementWriter(tape, list(places(told)), "return None").lines, f"return {_shaped(tape, told)}"]
    return compiled("\n    ".join([head, *body]), "replay")


def places(told: Any) -> Iterator[int]:
    """The places in a shape, in order."""
    if isinstance(told, int):
        yield told
    else:
        for part in told.values() if isinstance(told, dict) else told:
            yield from places(part)


def _shaped(tape: Tape, told: Any) -> str:
    """The expression for what is told."""
    if isinstance(told, dict):
        return "{" + ", ".join(f"{name!r}: {_shaped(tape, part)}" for name, part in told.items()) + "}"
    if isinstance(told, tuple):
        return "(" + "".join(f"{_shaped(tape, part)}, " for part in told) + ")"
    return spoken(tape, told)


@lru_cache(maxsize=64)
def compiled(text: str, name: str) -> Callable[..., Any]:
    """The function of this name in a written text; the same text is compiled once."""
    space: dict[str, Any] = {"sqrt": math.sqrt, "copysign": math.copysign, "inf": math.inf}
    exec(compile(text, "<graphplan tape>", "exec"), space)
    made: Callable[..., Any] = space[name]
    return made
