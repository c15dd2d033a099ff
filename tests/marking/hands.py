"""Hand drawings for tests: a construction redrawn with a shaking hand, and where it is asked for with a mistake."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.accuracy.hand import Pencil
from graphplan.accuracy.hand import hand as hand_of
from graphplan.errors import Undrawable
from graphplan.kernel.kinds import LINE, OPENING, POINT
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Step
from graphplan.marking.judge.mistaken_step import Mistake
from graphplan.marking.judge.mistakes import possible_mistakes
from graphplan.marking.judge.similar_figures import SimilarFigures
from graphplan.marking.traces import PlanFrame, Submission, Trace
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Polyline, Rect
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.view import clip_item


@dataclass(frozen=True)
class Drawn:
    """A construction as a hand drew it: the value of every step, nan where it could not be drawn."""

    drawing: Construction
    values: list[Any]
    frames: Mapping[str, PlanFrame]


def frames(drawing: Construction, composition: Composition, seed: int | None = None) -> dict[str, PlanFrame]:
    """Where the plans lie: as on the sheet, or with a seed, each moved and scaled at will, and turned as the sheet."""
    if seed is None:
        return {panel: PlanFrame(complex(*view.origin), view.scale) for panel, view in composition.views.items()}
    rng = np.random.default_rng(seed)
    found, turn = {}, cmath.rect(1.0, rng.uniform(0, 2 * math.pi))
    for panel, view in composition.views.items():
        unit = view.scale * turn * rng.uniform(0.8, 1.6)
        found[panel] = PlanFrame(complex(*rng.uniform(-300, 300, 2)), unit)
    return found


def draw(drawing: Construction, where: Mapping[str, PlanFrame], pencil: Pencil, seed: int,
         wrong: Mapping[int, Mistake] | None = None) -> Drawn:
    """The construction drawn by a hand; `wrong` says what some steps become, of the values drawn before."""
    rng = np.random.default_rng(seed)
    hand = hand_of(drawing, lambda panel: 1 / abs(where[panel].unit), pencil)
    drawn: list[Any] = []
    for step in drawing.drawn.steps:
        try:
            made = hand.draw_step(step, Floats(), drawn, lambda index: list(rng.normal(0.0, hand.slips[index])))
            if wrong and step.index in wrong:
                made = hand.add_slips(step, wrong[step.index].value(Floats(), drawn),
                                      list(rng.normal(0.0, hand.slips[step.index])))
        except (Undrawable, TypeError):
            made = None
        drawn.append(made)
    return Drawn(drawing, drawn, where)


def slipped(drawing: Construction, index: int) -> list[Mistake]:
    """The mistakes that can be made at a step: nobody marks where lines cross that are one, or never meet."""
    found, plan_of_step = [], Plans(drawing).plan_of_step
    for mistake in possible_mistakes(drawing.drawn, drawing.drawn.steps[index], plan_of_step,
                                     SimilarFigures(drawing, plan_of_step).link_points):
        with suppress(Undrawable):
            mistake.value(Floats(), drawing.values)
            found.append(mistake)
    return found


def points(drawn: Drawn, name: str = "drawing.csv", digits: int | None = 2) -> Submission:
    """The drawing as measured points, by their letters or the numbers of their steps."""
    traces = [trace for trace in traced(drawn, digits) if trace.kind == POINT]
    return Submission(name, tuple(traces), shows=frozenset({POINT}))


def traced(drawn: Drawn, digits: int | None = None) -> list[Trace]:
    """Every mark of the drawing on the sheet, labelled; lines and circles as long as what lies on them."""
    program, plan_of_step = drawn.drawing.drawn, Plans(drawn.drawing).plan_of_step
    found = []
    for step, value in zip(program.steps, drawn.values, strict=True):
        if value is None or step.op.gives == OPENING:
            continue
        frame = drawn.frames[plan_of_step[step.index]]
        spots = [frame.to_sheet(z) for z in _spots(drawn, step, value)]
        rounded = tuple((z.real, z.imag) if digits is None else (round(z.real, digits), round(z.imag, digits))
                        for z in spots)
        label = step.name or str(program.number(step.index))
        found.append(Trace(step.op.gives, rounded, label, plan_of_step[step.index]))
    return found


def _spots(drawn: Drawn, step: Step, value: Any) -> list[complex]:
    """Where a thing was drawn: a line between the outermost of its marks, and a little beyond."""
    on = [complex(*drawn.values[mark][:2]) for mark in Plans(drawn.drawing).marks_on.get(step.index, ())
          if drawn.values[mark] is not None]
    size = max(abs(complex(*v[:2])) for v in drawn.values if v is not None and len(v) == 2) * 0.05
    return extent(step, value, on, size)


def extent(step: Step, value: Any, on: Sequence[complex], beyond: float) -> list[complex]:
    """Spots of a mark, in plan units: a line from the first to the last mark on it, of an arc a little each way."""
    if step.op.gives == POINT:
        return [complex(*value[:2])]
    if step.op.gives == LINE:
        a, b, c = value
        way = complex(b, -a) / math.hypot(a, b)
        foot = -complex(a, b) * c / (a * a + b * b)
        along = [((z - foot) * way.conjugate()).real for z in on] or [0.0]
        return [foot + way * (min(along) - beyond), foot + way * (max(along) + beyond)]
    centre, radius = complex(value[0], value[1]), math.sqrt(max(value[2], 0.0))
    turn = cmath.phase(on[0] - centre) if on else 0.0
    return [centre + cmath.rect(radius, turn + part) for part in (-0.2, 0.0, 0.2)]


def wrong_by(drawn: Drawn, step: Step) -> float:
    """How far a step is from what its own marks ask for, in mm: of a line or an arc where it was drawn."""
    drawing, value = drawn.drawing, drawn.values[step.index]
    frame = drawn.frames[Plans(drawing).plan_of_step[step.index]]
    try:
        right = step.op.rule(Floats(), *[drawn.values[arg] for arg in step.args], **step.params)
    except Undrawable:
        right = drawing.values[step.index]
    spots = _spots(drawn, step, value)
    if step.op.gives == POINT:
        off = abs(spots[0] - complex(*right[:2]))
    elif step.op.gives == LINE:
        off = max(abs(right[0] * z.real + right[1] * z.imag + right[2]) for z in spots) / math.hypot(*right[:2])
    else:
        off = max(abs(abs(z - complex(*right[:2])) - math.sqrt(right[2])) for z in spots)
    return float(off * abs(frame.unit))


def off_paper(drawn: Drawn) -> bool:
    """Whether a mark lies a quarter of a metre from where it should be: nobody's sheet is so large."""
    plan_of_step, steps = Plans(drawn.drawing).plan_of_step, drawn.drawing.drawn.steps
    return any(abs(complex(*value[:2]) - complex(*true[:2])) * abs(drawn.frames[plan_of_step[step.index]].unit) > 250
               for step, value, true in zip(steps, drawn.values, drawn.drawing.values, strict=True)
               if value is not None and step.op.gives == POINT)


SPECK = 0.5  # mm: a shorter stroke is none
Stroke = tuple[tuple[tuple[float, float], ...], float, float]  # spots in mm, the width and the darkness of the lead


def strokes(drawn: Drawn, sheet: Composition, seed: int) -> list[Stroke]:
    """The drawing as strokes of a pencil on the printed page: what leaves a plan's panel is not drawn."""
    rng, found = np.random.default_rng(seed), list[Stroke]()
    width, dark = rng.uniform(0.2, 0.35), rng.uniform(0.45, 0.65)
    given = set(drawn.drawing.scene.points)
    for trace in traced(drawn):
        if trace.label in given:
            continue
        rect = _room(sheet, trace.panel)
        if trace.kind == POINT:
            if rect.holds(trace.spots[0]):
                found.append((trace.spots, 2.2 * width, min(1.0, 1.4 * dark)))
            continue
        line = Polyline(pens.THIN, "", None, _rim(trace.spots) if trace.kind != LINE else trace.spots)
        found += [(tuple(piece.spots), width, dark) for piece in clip_item(line, rect)
                  if isinstance(piece, Polyline) and math.dist(piece.spots[0], piece.spots[-1]) > SPECK]
    return found


def _room(sheet: Composition, panel: str) -> Rect:
    """Where a hand draws on a plan's panel: not on its very edge."""
    return sheet.arrangement.panels[panel].inset(1.0, 1.0, 1.0, 1.0)


def _rim(spots: Sequence[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    """An arc through three spots as a chain of many."""
    P, Q, R = (complex(*spot) for spot in spots)
    u, v = Q - P, R - P
    cross = 2 * (u.conjugate() * v).imag
    if not cross:
        return tuple(spots)
    centre = P + 1j * (abs(v) ** 2 * u - abs(u) ** 2 * v) / cross
    turn = cmath.phase((R - centre) / (P - centre))
    chain = [centre + (P - centre) * cmath.rect(1.0, turn * k / 40) for k in range(41)]
    return tuple((z.real, z.imag) for z in chain)


def in_panel(drawn: Drawn, sheet: Composition) -> bool:
    """Whether every point lies where it is drawn on its plan's panel, or where it should be if that is off it too."""
    plan_of_step = Plans(drawn.drawing).plan_of_step
    for step, value, true in zip(drawn.drawing.drawn.steps, drawn.values, drawn.drawing.values, strict=True):
        if step.op.gives == POINT and value is not None:
            home = plan_of_step[step.index]
            rect, frame = _room(sheet, home), drawn.frames[home]
            spots = [frame.to_sheet(complex(*spot[:2])) for spot in (value, true)]
            if rect.holds((spots[1].real, spots[1].imag)) and not rect.holds((spots[0].real, spots[0].imag)):
                return False
    return True


def apart(drawn: Drawn, step: Step) -> bool:
    """Whether what a step made can be told from all else on the paper: no other mark or line lies upon it."""
    traces = {trace.label: trace for trace in traced(drawn)}
    label = step.name or str(drawn.drawing.drawn.number(step.index))
    one = traces.pop(label)
    return not any(_upon(one, other) for other in traces.values() if (other.kind, other.panel) == (one.kind, one.panel))


def _upon(one: Trace, other: Trace) -> bool:
    """Whether a mark or a line lies upon another of its kind."""
    if one.kind == POINT:
        return math.dist(one.spots[0], other.spots[0]) < 1.0
    if one.kind != LINE:
        return False
    start, end = (complex(*spot) for spot in other.spots)
    way = (end - start) / abs(end - start)
    return all(abs(((complex(*spot) - start) * way.conjugate()).imag) < 0.5 for spot in one.spots)
