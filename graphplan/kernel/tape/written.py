"""A tape as statements of a language: one writer, and for each language a table of how it writes its operations.

A number that is used once stands where it is used; the others have names. All languages that compute in doubles, each
operation rounded once, give the very numbers of the rules.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import count
from typing import Any, NamedTuple

from graphplan.kernel.tape.record import Question, Tape, operands
from graphplan.kernel.tolerances import ROUNDOFF_TOL

MAX_NESTING = 13  # operations within each other that one statement may hold
TWICE = "sign"  # names its operands twice: they must be names


class Language(NamedTuple):
    """How a language writes numbers, operations, statements and questions.

    Operations are those of the tape by sign, with {0}, {1} for what they work on; `sign` has a third place, for the
    part of {1} beside which {0} is nothing. `{name}` is how the result is called, where it must be known. A statement
    gives {1} the name {0}. A question is asked of {0}: nonzero beside {2} times {1}, or not negative; what follows from
    a no stands there too. Where it `loads`, an input has a statement of its own.
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
        """The same as statements of the language."""
        return [self.language.statement.format(name, text) if name else text
                for name, text in self.terms(wanted, questions)]

    def _count(self, wanted: Iterable[int], needed: Sequence[int], asked: Iterable[tuple[int, ...]]) -> None:
        """How often each number is mentioned: by who wants it, by others, and by questions, which mention theirs twice.
        """
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


# ---- as Python, for one pose or for arrays ---------------------------------------------------------------------------


def function(tape: Tape, inputs: Sequence[int], told: Any) -> Callable[..., Any]:
    """A Python function from the inputs (places of the tape) to what is told, or to None where a question fails.

    `told` is a place, or tuples and dictionaries of such; the function gives floats in the same shape. It may raise
    ZeroDivisionError or OverflowError where the rules would.
    """
    return _python_function(tape, PYTHON, inputs, told, "def replay({}):", "return {}")


def array_function(tape: Tape, inputs: Sequence[int], told: Any) -> Callable[..., Any]:
    """The same over arrays of any library that speaks the array API, in doubles.

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
