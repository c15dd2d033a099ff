"""A construction in any pose, as functions of JavaScript: the marks of its drawn steps, its results by the rules."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple, cast

from graphplan.check.forces import Forces
from graphplan.check.json_results import result_data as as_solved
from graphplan.check.report import Reasons, Report
from graphplan.errors import Refused, Undrawable
from graphplan.kernel.kinds import POINT
from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Program, Step, error_at, evaluate
from graphplan.kernel.tape.record import JAVASCRIPT, Symbol, Symbols, Tape, Writer, asked_of
from graphplan.mechanism.loads import EDGES_OF_A_POSE
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.replaced import guides
from graphplan.methods.construction import Construction
from graphplan.methods.forces.loading import changing_steps, drawn_components
from graphplan.methods.replay import coincidence_fault, guiding_steps

SOLVED = ("check", "bounds", "arithmetic", "method", "steps")
"""What of the solver's report is another in each pose."""

Data = dict[str, Any]


def arrow(parameters: str, body: Iterable[str]) -> str:
    return "\n".join([f"{parameters} => {{", *body, "}"])


def _literal(value: Any, text: Mapping[int, str]) -> str:
    """Nested values, symbols among them, as JavaScript."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)}: {_literal(part, text)}" for key, part in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_literal(item, text) for item in value) + "]"
    return text[value.place] if isinstance(value, Symbol) else json.dumps(value)


def _symbols(value: Any) -> Iterator[int]:
    """The places of all symbols in nested values."""
    if isinstance(value, dict | list | tuple):
        for item in value.values() if isinstance(value, dict) else value:
            yield from _symbols(item)
    elif isinstance(value, Symbol):
        yield value.place


class _Asking(Symbols):
    """Symbols that keep why a question was asked, by the step that asked it."""

    def __init__(self) -> None:
        super().__init__()
        self.reasons: list[tuple[str, str]] = []

    def sqrt(self, value: Any, code: str, why: str) -> Any:
        return self._note_question(super().sqrt(value, code, why), code, why)

    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        return self._note_question(super().nonzero(value, scale, code, why), code, why)

    def _note_question(self, found: Any, code: str, why: str) -> Any:
        self.reasons += [(code, why)] * (len(self.tape.questions) - len(self.reasons))
        return found


class _Answering(Writer):
    """Writes questions that give the number of the one that fails; or, as `far` as the drawing goes, leave unknown
    what hangs on it."""

    def __init__(self, tape: Tape, inputs: Mapping[int, str]):
        nonzero, root = (text.replace("return null;", "{{ if (!far) return {name}; {0} = NaN; }}")
                         for text in (JAVASCRIPT.nonzero, JAVASCRIPT.root))
        super().__init__(tape, JAVASCRIPT._replace(nonzero=nonzero, root=root, statement="let {0} = {1};"), inputs)
        self.numbers = {asked_of(question): k for k, question in enumerate(tape.questions)}

    def _question(self, places: tuple[int, ...], name: str) -> str:
        return super()._question(places, str(self.numbers[places]))


class _Told(NamedTuple):
    """A program on a tape: the domain, the value of each step, and which step asked each question."""

    domain: _Asking
    values: list[Any]
    asked: list[Step]


class PosedTapes:
    """One construction in any pose: two functions of what moves, and what is to be known of them.

    Both read an array, and whether they go as far as they can where something cannot be drawn: what hangs on that is no
    number then. Else they give the number of a question that fails, or: `drawn` the values of all marks, `rules` the
    wanted points and the results. Of other forms of a program the rules are those of the `first`.
    """

    def __init__(self, drawing: Construction, missing: Reasons, first: PosedTapes | None = None):
        self.drawing, self.missing, scene = drawing, missing, drawing.scene
        if scene.loads and scene.loads.pressed is not None and scene.loads.bear_on_lengths:
            raise Refused("live", EDGES_OF_A_POSE, "[[friction]] without length")
        given_names = {step.name for program in (drawing.drawn, drawing.program)
                       for step in program.steps[:program.givens]}
        self.points = [name for name in scene.points if name in given_names]
        self.guides = {name: guide for name, guide in guides(scene).items()
                       if guide.through is None and guide.along != FRAME}
        self.loads = {name: drawn_components(scene, drawing.phi, name) for name in changing_loads(scene.loads)}
        self.wanted = [(i, j) for i, j in zip(drawing.drawn.wanted, drawing.program.wanted, strict=True)
                       if drawing.drawn.steps[i].op.gives == POINT]
        drawn_tape = self._record_program(drawing.drawn)
        self.drawn = self._function(drawn_tape, tuple(drawn_tape.values))
        self.by_rules: tuple[str, list[str]] = (first.by_rules if first and self._has_rules_of(first)
                                                else self._record_rules())
        steps = len(drawing.drawn) - drawing.drawn.givens
        self.data = {
            "points": self.points, "guides": [*self.guides], "loads": [*self.loads],
            "wanted": [i for i, _ in self.wanted],
            "asked": {"drawn": self._reasons(drawing.drawn, drawn_tape), "rules": self.by_rules[1]},
            "relied": [[point, twin, coincidence_fault(point, twin)] for point, twin in drawing.relied],
            "title": scene.title, "method": drawing.method, "steps": steps,
        }  # fmt: skip

    @property
    def rules(self) -> str:
        """The function by the rules."""
        return self.by_rules[0]

    def _has_rules_of(self, first: PosedTapes) -> bool:
        """Whether the program is that of another construction, but for where its points lie, of the same readings."""
        steps, first_steps = self.drawing.program.steps, first.drawing.program.steps
        return (self.drawing.readings is first.drawing.readings and not self.guides and not self.loads
                and [j for _, j in self.wanted] == [j for _, j in first.wanted] and len(steps) == len(first_steps)
                and all(step.op is earlier.op and step.args == earlier.args and (
                    step.params == earlier.params or step.name in self.points) for step, earlier in zip(
                        steps, first_steps, strict=True)))

    def _record_rules(self) -> tuple[str, list[str]]:
        """The function by the rules, and why each of its questions' steps cannot be drawn."""
        rules = self._record_program(self.drawing.program)
        points = tuple(rules.values[j] for _, j in self.wanted)
        text = self._function(rules, {"points": points, "results": self._results(rules)})
        return text, self._reasons(self.drawing.program, rules)

    def _record_program(self, program: Program) -> _Told:
        """A program on a tape of its own."""
        domain, asked_steps = _Asking(), list[Step]()
        number = domain.tape.input
        inputs: dict[Any, Any] = {name: {coordinate: number(f"{name}.{coordinate}") for coordinate in "xy"}
                                  for name in self.points}
        for name, guide in self.guides.items():
            direction = {part: number(f"{name}.{part}") for part in ("dx", "dy")}
            inputs |= dict.fromkeys(guiding_steps(program, guide), direction)
        for step, name in changing_steps(program).items():
            inputs[step] = {part: number(f"{name}.{part}") * times for part, times in self.loads[name].items()}
        values = evaluate(program, domain, inputs,
                          lambda step: asked_steps.extend([step] * (len(domain.tape.questions) - len(asked_steps))))
        return _Told(domain, values, asked_steps)

    def _reasons(self, program: Program, told: _Told) -> list[str]:
        """Why each question's step cannot be drawn where its answer is no."""
        reasons = zip(told.asked, told.domain.reasons, strict=False)
        return [error_at(program, step, Undrawable(*reason)).why for step, reason in reasons]

    def _results(self, told: _Told) -> Data:
        """Results of `solve`, in symbols."""
        domain, program = told.domain, self.drawing.program
        results = self.drawing.results_from_marks([told.values[index] for index in program.wanted], domain)
        at = {name: (domain.tape.input(f"{name}.x"), domain.tape.input(f"{name}.y")) for name in self.points}
        scene = self.drawing.scene.with_pose({**self.drawing.scene.points, **at}, lambda one: one.direction)
        forces = _Forces(scene, results, cast("Any", None), rounds=self.drawing.rounds, bounded=True)
        results_data = as_solved(_TapeReport(self.drawing, cast("Any", None), results, False, forces if scene.loads
                                             else None,
                                             missing=self.missing, posed=scene))
        return {key: item for key, item in results_data.items() if key not in SOLVED}

    def _function(self, told: _Told, wanted: Any) -> str:
        """A function of the points' coordinates and the guides' directions to what is wanted."""
        names = [f"{name}.{coordinate}" for name in self.points for coordinate in "xy"]
        names += [f"{name}.{part}" for name in self.guides for part in ("dx", "dy")]
        names += [f"{name}.{part}" for name, components in self.loads.items() for part in components]
        return _function_of(told.domain.tape, names, wanted)


class _Forces(Forces):
    """Forces of symbols; their efficiency is left to the page, which knows the powers."""

    efficiency = None


@dataclass(frozen=True)
class _TapeReport(Report):
    """A report in another pose."""

    posed: Scene | None = None

    @property
    def scene(self) -> Scene:
        return self.posed or self.drawing.scene


# ---- a program whose given numbers are others -----------------------------------------------------------------------


def marks_function(program: Program) -> tuple[str, list[tuple[str, float]]]:
    """A function of JavaScript from the numbers that steps are given to the values of all marks, as far as they go.

    Gives it, and the numbers as it reads them, each called by its step and parameter, of an angle x and y.
    """
    domain, changed, numbers = _Asking(), dict[int, dict[str, Any]](), list[tuple[str, float]]()

    def unknown(name: str, value: Any) -> Symbol:
        numbers.append((name, float(value)))
        return domain.tape.input(name)

    for step in program.steps:
        for name, value in step.params.items():
            key, params = f"{step.index}.{name}", changed.setdefault(step.index, {})
            if isinstance(value, Angle):
                params[name] = Angle(value.words, unknown(f"{key}.x", value.x), unknown(f"{key}.y", value.y))
            elif isinstance(value, int | float | Fraction):
                params[name] = unknown(key, value)
    values = evaluate(program, domain, changed)
    return _function_of(domain.tape, [name for name, _ in numbers], values), numbers


def _function_of(tape: Tape, names: Iterable[str], wanted: Any) -> str:
    """The function of the inputs of these names to what is wanted."""
    writer = _Answering(tape, {tape.input(name).place: f"x[{k}]" for k, name in enumerate(names)})
    body = writer.statements([*_symbols(wanted)], tape.questions)
    return arrow("(x, far)", [*body, f"return {_literal(wanted, writer.text)};"])
