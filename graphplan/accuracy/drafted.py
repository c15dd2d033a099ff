"""A construction on its sheet: at the scales and on the paper that it is drawn, what it costs and how far off it is."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphplan.accuracy.expected import Result, control_errors, first_order, worst_error
from graphplan.design.hand import Hand, Pencil, hand
from graphplan.kernel.drawn import crossing
from graphplan.kernel.kinds import DIVIDERS, POINT, SET_SQUARES
from graphplan.kernel.lemoine import Counts, counts
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import LENGTH, PLACE
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ResultKind
from graphplan.methods.panels import MECHANISM
from graphplan.methods.recorded import components
from graphplan.phrases import Said, arrange, digits, join, said
from graphplan.sheet.layout.composition import Composer, Composition, shortest_link
from graphplan.sheet.plates.traced_motion import TracedMotion
from graphplan.sheet.words.rows import Deviation, Deviations, zero_rounding
from graphplan.words.tongue import ENGLISH, Tongue

# What the points of a pose alone do to a result near a singular pose: they put it further off, beside the largest value
# of its kind, and by so many times what they put off the length of the shortest link [2 to 10 times in other poses].
POSE_ERROR, POSE_MAGNIFIES = 0.1, 10.0


@dataclass(frozen=True)
class Crossing:
    """Crossing of two curves: the step that marks it, and the sine of the angle between them."""

    number: int
    mark: str
    sine: float

    @property
    def degrees(self) -> float:
        """The angle between the curves."""
        return math.degrees(math.asin(min(1.0, self.sine)))


@dataclass(frozen=True)
class Cost:
    """The counts of a drawing, its steps, its crossings, and the steps whose marks lie outside the paper of their
    plans."""

    counts: Counts
    steps: int
    crossings: tuple[Crossing, ...]
    off_sheet: tuple[int, ...]

    @property
    def flattest(self) -> Crossing | None:
        """The crossing with the smallest angle."""
        return min(self.crossings, key=lambda crossing: crossing.sine, default=None)

    @property
    def data(self) -> dict[str, Any]:
        """All of it, as data; simplicity and exactitude, which know no set squares, of a strict drawing alone."""
        counts = self.counts
        return {
            "said": counts.text, "steps": self.steps, "operations": counts.operations, "lines": counts.R2,
            "arcs": counts.C3, "scale": counts.scale, "set squares": counts.others.get(SET_SQUARES, 0),
            "dividers": counts.others.get(DIVIDERS, 0), "instrument changes": counts.changes,
            "simplicity": counts.simplicity if counts.strict else None,
            "exactitude": counts.exactitude if counts.strict else None,
            "crossings": [{"step": c.number, "mark": c.mark, "degrees": c.degrees} for c in self.crossings],
            "off the sheet": list(self.off_sheet),
        }

    def lines(self) -> list[Said]:
        """The cost in words, a line each."""
        lines = [said("Changes of instrument: {0}.", self.counts.changes)]
        if self.flattest:
            angle = f"{self.flattest.degrees:.0f}"
            lines.append(said("Flattest crossing: {0}°, step {1}.", angle, self.flattest.number))
        if self.off_sheet:
            lines.append(said("Outside the paper of their plans: steps {0}.", ", ".join(map(str, self.off_sheet))))
        return lines


def cost(drawing: Construction, composition: Composition) -> Cost:
    """Cost of drawing a construction on its sheet."""
    program = drawing.drawn
    crossings = [Crossing(program.number(step.index), program.text(step.index), crossing(step, drawing.values))
                 for step in program.steps if step.op.crossing]
    points = (plate for plate in composition.plates.steps if plate.kind == POINT)
    off_sheet = tuple(point.number for point in points if not point.view.rect.holds(point.spot))
    return Cost(counts(program), len(program) - program.givens, tuple(crossings), off_sheet)


@dataclass(frozen=True)
class Errors:
    """The expected error of every result of a construction, drawn with a pencil at some scales."""

    drawing: Construction
    pencil: Pencil
    results: tuple[Result, ...]
    near_singular: bool

    @property
    def worst(self) -> Result | None:
        """The result whose error is largest relative to the largest value of its kind; None without results."""
        with_size = [result for result in self.results if result.relative is not None]
        return max(with_size, key=lambda result: result.relative or 0.0, default=None)

    @property
    def error(self) -> float:
        """The worst result's error relative to the largest value of its kind."""
        return (self.worst.relative or 0.0) if self.worst else 0.0

    @property
    def of_pose(self) -> tuple[Result, float] | None:
        """In a pose near a singular one: the result with the largest error from the points of the pose alone, relative
        to the largest value of its kind, and this error in mm of paper; None if no result has a bound and a length on
        paper."""
        if not self.near_singular:
            return None
        givens = self.drawing.drawn.givens
        on_paper = [result for result in self.results if result.deviation.mm and result.relative_part(givens)]
        furthest = max(on_paper, key=lambda result: result.relative_part(givens), default=None)
        return (furthest, (furthest.deviation.mm or 0.0) * furthest.part_of(givens)) if furthest else None

    @property
    def too_short(self) -> list[Result]:
        """The results that are drawn shorter than the pencil's error, except for zero ones: their relative error is
        meaningless."""
        drawing = self.drawing
        values = zero_rounding(drawing.computed, drawing.scene.extent, drawing.kappa)
        lengths = [(result, _length_mm(result, values.get(result.kind, {}).get(result.of))) for result in self.results]
        return [result for result, length in lengths if 0.0 < length < self.pencil.point]

    @property
    def remark(self) -> Said | None:
        """Remark on a pose near a singular one, with the growth of its points' errors, and on results that are too
        short for a pencil."""
        told = list[Said]()
        if self.of_pose:
            result, mm = self.of_pose
            told.append(said("The pose is near a singular one: ±{0} mm at its points alone become ±{1} mm ({2}).",
                             digits(self.pencil.point), Deviation(mm).text, result.label))
        if self.too_short:
            told.append(said("Shorter on paper than the pencil's ±{0} mm: {1}.", digits(self.pencil.point),
                             join([result.label for result in self.too_short])))
        return join(told, " ") if told else None

    def step_name(self, index: int) -> Said:
        """A step by its number, a point of the pose by its name."""
        program = self.drawing.drawn
        if index >= program.givens:
            return said("step {0}", program.number(index))
        return said("the given point {0}", program.text(index))

    @property
    def deviations(self) -> Deviations:
        """The errors as the sheet tells them."""
        results: dict[str, dict[str, Deviation]] = {}
        for result in self.results:
            results.setdefault(result.kind, {})[result.of] = result.deviation
        return Deviations(results, self.description, self.remark)

    @property
    def description(self) -> Said:
        """The drawing model and the worst step, in a sentence or two."""
        model = said("± is the standard deviation of a drawing with {0}; in brackets mm of paper.",
                     self.pencil.description)
        if self.worst is None or not self.error:
            return model
        remark = [self.remark] if self.remark else []
        if math.isinf(self.error):
            flat = said("No error is given where curves cross at too small an angle (–), the smallest at {0}.",
                        self.step_name(self.worst.worst_step))
            return join((model, flat, *remark), " ")
        worst = said("Largest error: {0}, {1} of the largest value; largest source: {2}.", self.worst.label,
                     percent(self.error), self.step_name(self.worst.worst_step))
        return join((model, worst, *remark), " ")


@dataclass(frozen=True)
class Drafted(Errors):
    """A construction drawn with a pencil: its composition on paper, and what follows from its scales."""

    composition: Composition

    @cached_property
    def hand(self) -> Hand:
        """The hand that draws it."""
        return hand(self.drawing, self.composition.scales.lengths_per_mm, self.pencil)

    @cached_property
    def cost(self) -> Cost:
        """Cost of drawing it."""
        return cost(self.drawing, self.composition)

    @property
    def operations(self) -> int:
        """Number of operations."""
        return self.cost.counts.operations

    @property
    def paper(self) -> str:
        """The sheet it stands on."""
        return self.composition.arrangement.paper

    def lines(self) -> list[Said]:
        """Cost and errors in words, a line each."""
        off: dict[ResultKind, list[Said]] = {}
        for result in self.results:
            off.setdefault(result.kind, []).append(join((result.subject, arrange("±{0}", result.deviation.text)), " "))
        lines = [join((kind.words, join(deviations)), ": ") for kind, deviations in off.items()]
        controls = control_errors(self.drawing, self.hand, self.composition.scales)
        lines += [said("control of link {0}: ±{1} mm", control.link, Deviation(mm).text) for control, mm in controls]
        return [*self.cost.lines(), said("Drawing errors on {0}: {1}", self.paper, self.description), *lines]

    @property
    def data(self) -> dict[str, Any]:
        """Model, errors and worst step, as data."""
        results: dict[str, dict[str, Any]] = {}
        for result in self.results:
            results.setdefault(result.kind, {})[result.of] = {
                "mm": _finite_or_none(result.deviation.mm), "value": _finite_or_none(result.deviation.value),
                "relative": _finite_or_none(result.relative), "worst step": self._step(result.worst_step),
            }
        step = self._step(self.worst.worst_step) if self.worst else None
        return {"model": self.pencil.model, "paper": self.paper, "results": results,
                "worst result": self._worst_result_data(self.worst) if self.worst else None, "worst step": step,
                "near singular": self._pose_data}

    @property
    def _pose_data(self) -> dict[str, Any] | None:
        """Of a pose near a singular one, how far the slips of its points alone put which result off, in mm of paper."""
        if self.of_pose is None:
            return None
        result, mm = self.of_pose
        return {"kind": result.kind, "of": result.of, "mm": mm}

    def _worst_result_data(self, worst: Result) -> dict[str, Any]:
        """The worst result, and what each step has contributed to its variance, the most first."""
        whole = sum(worst.shares) or 1.0
        order = sorted(range(len(worst.shares)), key=lambda index: -worst.shares[index])
        shares = [{**self._step(index), "share": worst.shares[index] / whole} for index in order if worst.shares[index]]
        return {"kind": worst.kind, "of": worst.of, "relative": _finite_or_none(worst.relative), "shares": shares}

    def _step(self, index: int) -> dict[str, Any]:
        program, say = self.drawing.drawn, self.composition.plans.tongue
        number = program.number(index) if index >= program.givens else 0
        return {"number": number, "makes": say(program.text(index)), "sentence": say(program.sentence(index))}


def percent(part: float) -> Said:
    """A part of a whole, in at most two digits; a dash where it has no bound."""
    return arrange("{0} %", Deviation(100 * part).text)


def _length_mm(result: Result, value: Any) -> float:
    """Length of the vector from which a rate or a force is read; infinite if it is not read off a vector."""
    off, mm = result.deviation.value, result.deviation.mm
    if value is None or not mm or not math.isfinite(mm) or result.kind.dimension in (LENGTH, PLACE):
        return math.inf
    return math.hypot(*map(float, components(value))) * mm / off


def _finite_or_none(error: float | None) -> float | None:
    """An error as data; None where it has no bound."""
    return None if error is None or math.isinf(error) else error


def draft(drawing: Construction, pencil: Pencil, paper: str | None = None,
          check: Mapping[str, Any] | None = None, tongue: Tongue = ENGLISH, protocol: str = "auto",
          lettered: bool = True, motion: TracedMotion | None = None) -> Drafted:
    """A construction on the sheet that it gets with its errors told on it; `protocol` says where the words stand.

    Where it is not to be `lettered`, as where it is weighed alone, no letters and facts are placed; about how many
    letters have no room is known. What is shown of the `motion` is followed, where it is not known yet.

    Facts and words have room for the errors at usual scales; those at the scales of the sheet are told. Fails with
    `Refused` where plans or words do not fit the paper named.
    """
    composer = Composer(drawing, paper, check, tongue, protocol, motion or shown_motion(drawing.scene), lettered)
    usual = first_order(drawing, hand(drawing, composer.usual.lengths_per_mm, pencil), composer.usual)
    shortest_mm = shortest_link(composer.plans) / composer.usual.lengths_per_mm(MECHANISM)
    expected = Errors(drawing, pencil, usual, near_singular(drawing, usual, pencil.point / shortest_mm))
    composition = composer.choose(expected.deviations, worst_error(usual, composer.plans.plan_of_step, composer.usual))
    scales = composition.scales
    results = first_order(drawing, hand(drawing, scales.lengths_per_mm, pencil), scales)
    composition = composer.with_texts(composition, replace(expected, results=results).deviations)
    return Drafted(drawing, pencil, results, expected.near_singular, composition)


def near_singular(drawing: Construction, usual: Sequence[Result], slip: float) -> bool:
    """Whether slips of the points of the pose alone, however well all else is drawn on usual panels, put a result off
    by more than a tenth of the largest value of its kind: not where a link is drawn so short that a point's slip,
    relative to its length, is as much already."""
    furthest = max((result.relative_part(drawing.drawn.givens) for result in usual), default=0.0)
    return furthest > max(POSE_ERROR, POSE_MAGNIFIES * slip)


def shown_motion(scene: Scene) -> TracedMotion | None:
    """Motion shown on the sheet; its modules are imported only if it is asked for."""
    if not scene.sheet.shows_motion:
        return None
    from graphplan.cycle.motion_curves import traced_motion

    return traced_motion(scene)
