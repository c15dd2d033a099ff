"""The numbers as code in C99 and JavaScript, which compute what the scene asks for in poses as they come.

The rule runs once on symbols (kernel/tape). Coordinates come and go in mm of paper; in between stand the
units of each operand's own plan, so that a step may read from plans of any scale. In mm

| kind    | has the coordinates                                                          |
|---------|------------------------------------------------------------------------------|
| point   | x, y                                                                         |
| line    | x, y, dx, dy: a point of it, and a vector the way it runs, of whatever length |
| opening | r                                                                            |
| circle  | x, y, r                                                                      |

Both are readings of the tape, as the replay in Python is, and give its numbers to the last bit. What moves is read: the
points that are on no frame, and the directions of guides that ride on links; all that the scene asks for is given. Code
speaks English, whatever the paper speaks.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.kernel.tape.record import JAVASCRIPT, C, Language, Symbols, Writer, shape_expression
from graphplan.mechanism.order import changing_loads
from graphplan.methods.construction import Construction
from graphplan.methods.replay import Replay, moving_parts
from graphplan.methods.results import facts
from graphplan.sheet.plates.plate import DrawnStep
from graphplan.sheet.plates.view import View

SHAPELESS = frozenset({"side", "way", "turn"})  # parameters that stay what they are when everything grows


@dataclass(frozen=True)
class Formula:
    """A rule written out: terms that are used more than once, by name, each after those it reads; then the results."""

    terms: tuple[tuple[str, str], ...]
    results: tuple[str, ...]


def formula(drawn: DrawnStep, coordinates: Sequence[Sequence[str]], language: Language, term: str = "",
            deepest: float = math.inf, given: Mapping[str, tuple[str, float]] | None = None) -> Formula:
    """The coordinates of a mark, in mm, from those of its operands; `given` are parameters that something else tells:
    what, and how many times it.

    A term that is used more than once, or holds as many operations within each other as are `deepest`, gets the name
    `term` with a number; without a `term` it stands where it is used.
    """
    domain, similar = Symbols(), _similar(drawn)
    read = [_local(domain, arg.kind, _window(arg, similar), texts)
            for arg, texts in zip(drawn.args, coordinates, strict=True)]  # fmt: skip
    loads = {name: domain.tape.input(text) * times for name, (text, times) in (given or {}).items()}
    value = drawn.step.op.rule(domain, *read, **{**drawn.step.params, **loads})
    places = [domain.tape.place(part) for part in _answer_on_paper(domain, drawn.kind, _window(drawn, similar), value)]
    writer = Writer(domain.tape, language, prefix=term, deepest=deepest)
    return Formula(tuple(writer.terms(places)), tuple(writer.text[place] for place in places))


def _similar(drawn: DrawnStep) -> bool:
    """Whether the rule may be taken in mm as it is: on one plan, with no length given."""
    return all(arg.view is drawn.view for arg in drawn.args) and SHAPELESS.issuperset(drawn.step.op.params)


def _window(drawn: DrawnStep, similar: bool) -> View:
    """View that turns lengths of a plan into mm."""
    return replace(drawn.view, scale=1.0, origin=(0.0, 0.0)) if similar else drawn.view


def _local(d: Symbols, kind: str, window: View, texts: Sequence[str]) -> tuple[Any, ...]:
    """The value that a rule reads, from coordinates in mm."""
    numbers: list[Any] = [d.tape.input(text) for text in texts]
    if kind == OPENING:
        return (_square(numbers[0] / window.scale),)
    x, y = window.to_plan((numbers[0], numbers[1]))
    if kind == CIRCLE:
        return x, y, _square(numbers[2] / window.scale)
    return (-numbers[3], numbers[2], numbers[3] * x - numbers[2] * y) if kind == LINE else (x, y)


def _square(part: Any) -> Any:
    return part * part


def _answer_on_paper(d: Symbols, kind: str, window: View, value: Any) -> list[Any]:
    """A rule's answer in mm; of a line the point that is next to the middle of its window, and its way."""
    if kind == LINE:
        (x, y), (a, b, c) = window.to_plan(window.rect.centre), value
        off = (a * x + b * y + c) / (a * a + b * b)
        return [*window((x - a * off, y - b * off)), b, -a]
    at = () if kind == OPENING else window((value[0], value[1]))
    if kind == POINT:
        return [*at]
    return [*at, window.scale * d.sqrt(value[-1], "not-rational", "a length is never imaginary")]


C_FILE = """\
{head}
// size_t graphplan_poses(size_t n, const double *const in[], double *const out[])
//
// reads and writes n poses, each of in[] and out[] being an array of n numbers, and gives the number of poses that
// cannot be drawn; in these all outputs are nan. No array may overlap another.
//
//   cc -O3 -march=native -ffp-contract=off -fno-math-errno -c FILE.c
//
// Without -ffast-math, and with no products contracted into sums, the numbers are those of graphplan to the last bit.
//
{table}

#include <math.h>
#include <stddef.h>

enum {{ GRAPHPLAN_INPUTS = {inputs}, GRAPHPLAN_OUTPUTS = {outputs} }};

static inline size_t poses(size_t n{parameters}) {{
    size_t undrawn = 0;
    for (size_t k = 0; k < n; k++) {{
        double bad = 0.0;  // or nan
        {body}
        undrawn += bad != bad;
    }}
    return undrawn;
}}

size_t graphplan_poses(size_t n, const double *const in[], double *const out[]) {{
    return poses(n{arguments});
}}
"""

JAVASCRIPT_FILE = """\
{head}
// pose(points, guides)  the results in one pose, by kind and name, or null where it cannot be drawn: points and guides
//                       are objects of pairs [x, y] by name; what is left out is as the scene has it
// poses(n, x, y)        reads and writes n poses, each of x and y being an array of n numbers, and gives the number of
//                       poses that cannot be drawn; in these all of y are NaN
//
// The numbers are those of graphplan to the last bit.
//
{table}

export const inputs = {inputs};
export const outputs = {outputs};

function numbers({parameters}y) {{
  {body}
  return y;
}}

export function pose(points = {{}}, guides = {{}}) {{
  {given}
  const y = numbers({parameters}new Float64Array({count}));
  return y && {results};
}}

export function poses(n, x, y) {{
  const one = new Float64Array({count});
  let undrawn = 0;
  for (let k = 0; k < n; k++) {{
    const drawn = numbers({arguments}one) !== null;
    if (!drawn) undrawn++;
    for (let j = 0; j < {count}; j++) y[j][k] = drawn ? one[j] : NaN;
  }}
  return undrawn;
}}
"""


class Number(NamedTuple):
    """A number that is read or given: what it is, in what unit, and where it stands on the tape."""

    name: str
    unit: str
    places: tuple[int, ...]


class Code:
    """The replay of a construction, with what it reads and what it gives, in order."""

    def __init__(self, construction: Construction):
        self.scene, self.moving = construction.scene, moving_parts(construction)
        free = tuple(key for item in self.moving for part in item.parts for key in part)
        self.replay = Replay(construction, free, construction.kinds)
        at = dict(zip(free, self.replay.inputs, strict=True))
        self.inputs = [Number(f"{item.kind} {item.name} {letter}",
                              self.scene.units.length if item.kind == "point" else "of whatever length",
                              tuple(at[key] for key in part))
                       for item in self.moving for letter, part in zip("xy", item.parts, strict=True)]
        self.outputs = list(self._outputs())

    def _outputs(self) -> Iterator[Number]:
        for fact in facts(self.replay.places_of_results):
            yield from (Number(f"{fact.name} {axis}".strip(), fact.unit(self.scene.units), (place,))
                        for axis, place in fact.axes.items())

    def head(self) -> str:
        """The first lines: the scene, and of its loads those that stay as they are in its pose."""
        changing = ", ".join(changing_loads(self.scene.loads))
        remark = f"Loads that change over the cycle have the values of the given pose here: {changing}."
        texts = (self.scene.title, self.scene.source, *[remark] * bool(changing), "")
        return "\n".join(f"// {' '.join(text.split())}".rstrip(" \\") for text in texts)

    def table(self, read: str, given: str) -> str:
        """All inputs and outputs, in comments."""
        return "\n".join(f"//   {array}[{k}]  {' '.join(number.name.split())}, {number.unit}"
                         for array, numbers in ((read, self.inputs), (given, self.outputs))
                         for k, number in enumerate(numbers))

    def statements_in(self, language: Language, read: str) -> tuple[list[str], list[str]]:
        """The statements of the language, inputs being called as `read` says, and the text of each output."""
        names = {place: read.format(k) for k, number in enumerate(self.inputs) for place in number.places}
        writer = Writer(self.replay.tape, language, names)
        statements = writer.statements(self.replay.outputs, self.replay.tape.questions)
        return statements, [writer.text[place] for number in self.outputs for place in number.places]


def c(construction: Construction) -> str:
    """The construction as C99: one function over arrays of poses, which compilers turn into vector instructions."""
    code = Code(construction)
    statements, outputs = code.statements_in(C, "in{}[k]")
    statements += [f"out{k}[k] = {text} + bad;" for k, text in enumerate(outputs)]
    arrays = [f"in{k}" for k in range(len(code.inputs))], [f"out{k}" for k in range(len(outputs))]
    parameters = [f"const double *restrict {name}" for name in arrays[0]] + [f"double *restrict {name}"
                                                                             for name in arrays[1]]
    arguments = [f"{array}[{k}]" for array, names in zip(("in", "out"), arrays, strict=True) for k in range(len(names))]
    return C_FILE.format(head=code.head(), table=code.table("in", "out"), inputs=len(code.inputs), outputs=len(outputs),
                         parameters="".join(f",\n        {text}" for text in parameters),
                         body="\n        ".join(statements), arguments="".join(f", {text}" for text in arguments))


def javascript(construction: Construction) -> str:
    """The construction as a module of JavaScript: a function for one pose, and one over arrays of poses."""
    code = Code(construction)
    statements, outputs = code.statements_in(JAVASCRIPT, "x{}")
    statements += [f"y[{k}] = {text};" for k, text in enumerate(outputs)]
    count = len(code.inputs)
    inputs = [f"const [x{2 * k}, x{2 * k + 1}] = {item.kind}s[{json.dumps(item.name)}] ?? {[*map(float, item.at)]};"
              for k, item in enumerate(code.moving)]
    places = iter(range(len(outputs)))
    results = {kind: {name: tuple(next(places) for _ in told) if isinstance(told, tuple) else next(places)
                      for name, told in named.items()} for kind, named in code.replay.places_of_results.items()}
    return JAVASCRIPT_FILE.format(
        head=code.head(), table=code.table("x", "y"), inputs=_names(code.inputs), outputs=_names(code.outputs),
        parameters="".join(f"x{k}, " for k in range(count)), arguments="".join(f"x[{k}][k], " for k in range(count)),
        body="\n  ".join(statements), given="\n  ".join(inputs), count=len(outputs),
        results=shape_expression(results, {k: f"y[{k}]" for k in range(len(outputs))}, "[]"))


def _names(numbers: Sequence[Number]) -> str:
    return json.dumps([number.name for number in numbers])
