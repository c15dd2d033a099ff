"""From compounds to single movements: each compound is drawn in the form that suits the pose.

A form is tried on the board itself, so that it may use what is drawn already; it counts only if it can be drawn and
gives the value of the compound's rule. Of those, one on the sheet beats one off it, crossings above 15 degrees beat
flatter ones, and then the fewest movements win. What no form can draw in this pose stays one step.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import LINE, POINT, TABLE, Primitive
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Board, Mark, Program, Step

SHARP = math.sin(math.radians(15))
AGREE = 1e-6  # beside the drawing's size: flat crossings lose digits, a wrong branch misses by far more
FLOATS = Floats()

# What counts as one movement: with set squares and dividers, and with compasses and straightedge alone.
BY_SET_SQUARE = frozenset({
    "given", "begin", "guide", "line", "parallel", "perpendicular", "meet", "opening", "circle", "line_meets_circle",
    "circles_meet", "step_off", "step_across", "lay_along", "lay_off", "pick", "midpoint", "foot", "transfer",
    "quarter", "bisector",
})
STRICT = BY_SET_SQUARE - {"parallel", "perpendicular", "midpoint", "foot", "transfer", "quarter", "bisector"}


@dataclass(frozen=True)
class Window:
    """What counts as on the sheet of a panel: a circle, in plan units."""

    centre: tuple[float, float]
    radius: float

    def holds(self, point: tuple[float, float]) -> bool:
        return math.dist(point, self.centre) <= self.radius


EVERYWHERE = Window((0.0, 0.0), math.inf)


@dataclass(frozen=True)
class Trial:
    """How well one form draws in this pose."""

    form: str
    movements: int
    on_sheet: bool
    sharpest: float

    @property
    def rank(self) -> tuple[bool, bool, int]:
        return not self.on_sheet, self.sharpest < SHARP, self.movements

    def __str__(self) -> str:
        angle = math.degrees(math.asin(min(1.0, self.sharpest)))
        place = "on the sheet" if self.on_sheet else "off the sheet"
        return f"{self.form} ({self.movements} steps, {place}, flattest crossing {angle:.0f} degrees)"


@dataclass
class Expander:
    """Copies a program step by step, drawing its compounds out; knows the float value of every step it has drawn.

    Reads a program, its values in the drawn pose, the operations that stay single steps, the panels' windows, and
    the forms wanted by name (`prefer`: such a form wins wherever it can be drawn at all).
    """

    program: Program
    truth: list[Any]
    keep: frozenset[str] = BY_SET_SQUARE
    windows: Mapping[str, Window] = field(default_factory=dict)
    prefer: str = ""

    def __post_init__(self) -> None:
        self.board = Board()
        self.values: list[Any] = []

    def run(self) -> Program:
        """The expanded program."""
        place: list[Mark] = []
        for step in self.program.steps:
            self.panel = step.panel
            with self.board.on(step.panel, step.links):
                args = tuple(place[arg] for arg in step.args)
                mark = self.draw(step.op, args, step.params, self.truth[step.index], step.why, step.names)
                place.append(self.board.named(mark, step.name) if step.name else mark)
        return Program(tuple(self.board.steps), tuple(place[index].step.index for index in self.program.wanted))

    def draw(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], truth: Any,
             why: str = "", names: Mapping[str, str] | None = None) -> Mark:
        """Draw one operation: as one step if it is one, else in its best form."""
        trials = [] if op.name in self.keep else [self._try(op, args, params, truth, name) for name in op.forms]
        ranked = sorted((trial for trial in trials if trial), key=self._rank)
        if not ranked:
            return self._record(op, args, params, why)
        before = len(self.board.steps)
        out: Mark = op.forms[ranked[0].form](Pencil(self, dict(names or {})), *args, **params)
        self._explain(op, before, ranked, why, out)
        return out

    def _rank(self, trial: Trial) -> tuple[Any, ...]:
        return not (self.prefer and trial.form.startswith(self.prefer)), *trial.rank

    def _record(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], why: str = "",
                name: str = "") -> Mark:
        """Record one step and give it its value."""
        mark = self.board.draw(op, args, why=why, name=name, **params)
        if mark.step.index == len(self.values):
            values = [self.values[arg.step.index] for arg in args]
            self.values.append(op.rule(FLOATS, *values, **params))
        return mark

    def _try(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], truth: Any,
             form: str) -> Trial | None:
        """Draw a form without letters, look at it, take it back."""
        before = len(self.board.steps)
        try:
            out: Mark = op.forms[form](Pencil(self, None), *args, **params)
            return self._judge(form, before) if self._agrees(op, self.values[out.step.index], truth) else None
        except (Undrawable, ZeroDivisionError):
            return None
        finally:
            self.board.rewind(before)
            del self.values[before:]

    def _agrees(self, op: Primitive, value: Any, truth: Any) -> bool:
        window = self.windows.get(self.panel, EVERYWHERE)
        size = window.radius if math.isfinite(window.radius) else 1.0 + max(abs(number) for number in truth)
        if op.gives == LINE:
            return _line_gap(truth, value, window.centre, size) <= AGREE * size
        return all(abs(p - q) <= AGREE * size for p, q in zip(value, truth, strict=True))

    def _judge(self, form: str, before: int) -> Trial | None:
        steps = self.board.steps[before:]
        if any(self._crosses_plans(step) for step in steps):
            return None
        on_sheet = all(self.windows.get(step.panel, EVERYWHERE).holds(self.values[step.index])
                       for step in steps if step.op.gives == POINT)
        crossings = [self._crossing(*step.args) for step in steps if step.op.name == "meet"]
        return Trial(form, len(steps), on_sheet, min(crossings, default=1.0))

    def _crosses_plans(self, step: Step) -> bool:
        """Whether a step joins points of two plans, which stand apart, each at its own scale.

        Compasses and straightedge alone cannot carry a direction over but in one plane: there the plans lie as one.
        """
        plans = {self.board.steps[arg].panel for arg in step.args}
        return "parallel" in self.keep and step.op.name in ("line", "opening") and len(plans) > 1

    def _crossing(self, k: int, l: int) -> float:
        """The sine of the angle between two lines."""
        (a, b, _), (c, e, _) = self.values[k], self.values[l]
        return float(abs(a * e - b * c) / math.hypot(a, b) / math.hypot(c, e))

    def _explain(self, op: Primitive, before: int, ranked: list[Trial], why: str, out: Mark) -> None:
        """Tell at the first step of a form which it is and why; at its last what it is good for."""
        if out.step.index < before or len(self.board.steps) == before:
            return
        if why:
            self.board.annotate(out.step.index, why=why)
        if len(op.forms) > 1:
            others = ", ".join(str(trial) for trial in ranked[1:])
            reason = str(ranked[0]) + (f" rather than {others}" if others else ", the only form that can be drawn here")
            self.board.annotate(before, form=f"{op.name}: {ranked[0].form}", reason=reason)


class Pencil:
    """The board as a form sees it: the same verbs, and compounds inside are drawn out in turn.

    `names` are the letters for the marks inside; a form that is only tried has none.
    """

    def __init__(self, expander: Expander, names: dict[str, str] | None):
        self._expander, self._names = expander, names

    def __getattr__(self, verb: str) -> Callable[..., Mark]:
        if verb not in TABLE:
            raise AttributeError(verb)
        return lambda *args, name="", **params: self._draw(TABLE[verb], args, name, params)

    def side(self, P: Mark, Q: Mark) -> Mark:
        """The line through two points, whichever way it runs: drawn once for both orders."""
        one, two = sorted((P, Q), key=lambda mark: mark.step.index)
        return self._draw(TABLE["line"], (one, two), "", {})

    def _draw(self, op: Primitive, args: tuple[Mark, ...], name: str, params: dict[str, Any]) -> Mark:
        expander, letter = self._expander, (self._names or {}).get(name, "")
        truth = op.rule(FLOATS, *[expander.values[arg.step.index] for arg in args], **params)
        mark = expander.draw(op, args, params, truth)
        return expander.board.named(mark, letter) if letter else mark

    def made_by(self, mark: Mark) -> tuple[str, tuple[Mark, ...]]:
        """How a mark was drawn: the operation, and what it read."""
        return mark.step.op.name, tuple(self._expander.board.marks[arg] for arg in mark.step.args)


def _line_gap(one: Any, two: Any, centre: tuple[float, float], size: float) -> float:
    """How far apart two lines run within `size` of a centre."""
    n, m = math.hypot(one[0], one[1]), math.hypot(two[0], two[1])
    p = (one[0] * centre[0] + one[1] * centre[1] + one[2]) / n
    foot = centre[0] - one[0] / n * p, centre[1] - one[1] / n * p
    gap = abs(two[0] * foot[0] + two[1] * foot[1] + two[2]) / m
    return float(gap + size * abs(one[0] * two[1] - one[1] * two[0]) / n / m)
