"""Frames: the places of a construction's plans on the student's sheet, whatever their unit, origin,
direction and scale.

The mechanism is laid on its given points. Any other plan begins where its beginning is, and is taken to run and to be
scaled as on the task's sheet, unless so many of its steps would then be wrong that another frame explains them better.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, combinations, permutations
from statistics import median
from typing import Any

import numpy as np

from graphplan.accuracy.expected import point_deviations
from graphplan.design.hand import Pencil, hand
from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE, POINT, Movement
from graphplan.marking.judge import measures
from graphplan.marking.judge.lettering import Letters, is_sure
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.student_sheet import Fit, plain_value
from graphplan.marking.traces import PlanFrame, Spot, Submission
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said, digits, said
from graphplan.phrases import unit as unit_of
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.plates.plans import Plans

# ---- how a drawing is read ------------------------------------------------------------------------------------------

# How a drawing is read: by which construction, on what sheet, how its marks are to be taken, and in which unit it was
# drawn. Programs of geometry know no units, and what CAD files state is not always meant. The mechanism's points tell
# how many units of the file one unit of the scene is; as what unit the scale of the paper is that of the task, or at
# least a round one, that is meant. Where none is, a drawing that may be one in mm is, at a scale of its own; another is
# taken to be as large as the task's.


@dataclass(frozen=True)
class SheetReading:
    """One way to read a drawing: the `submission` as its traces are taken, and the construction that it is judged by.

    `remarks` say what differs from the task, `scaled` the plan whose k_v is told with that; `departs` is how many of
    the scale and the sense of velocities are others than the task's. `task` is the task's sheet; `asked` are the steps
    whose marks a drawing is to have, if not all; `numbered` are the traces, by their places, whose numbers are left
    out: each point is to be a mark of the construction.
    """

    drawing: Construction
    task: Composition
    submission: Submission
    remarks: tuple[Said, ...] = ()
    scaled: str = ""
    departs: int = 0
    asked: frozenset[int] | None = None
    numbered: frozenset[int] = frozenset()

    @cached_property
    def on_task(self) -> Composition | None:
        """The sheet of the task with this construction on it; None where that has other plans."""
        if self.drawing is self.task.plans.drawing:
            return self.task
        plans = replace(self.task.plans, drawing=self.drawing)
        if plans.panels != self.task.plans.panels:
            return None
        return replace(self.task, plans=plans, scales=replace(self.task.scales, kappa=self.drawing.kappa))

    def has_printed_scale(self, mechanism: PlanFrame) -> bool:
        """Whether the mechanism is drawn at the scale that is printed on the task's sheet."""
        views = self.task.views
        return MECHANISM in views and frame_stretch(Fit(mechanism), complex(views[MECHANISM].scale)) == 1.0

    @cached_property
    def composition(self) -> Composition:
        """Sheet of the drawing: that of the task, if it has the same plans."""
        return self.on_task or compose(self.drawing, tongue=self.task.plans.tongue)


# ---- units ----------------------------------------------------------------------------------------------------------


def to_mm(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil
          ) -> tuple[Submission, tuple[Said, ...]]:
    """A drawing in mm of paper, and the text about its unit if that is another."""
    if submission.frames or math.isinf(submission.millimetres) or MECHANISM not in composition.views:
        return submission, ()
    spots = [spot for trace in submission.traces for spot in trace.spots]
    extent = max((_extent(coordinates) for coordinates in zip(*spots, strict=True)), default=0.0)
    least, sheet = sorted((composition.arrangement.width, composition.arrangement.height))
    # as marks and letters are seen
    rough = 1.0 if not extent or sheet / measures.SIZE_RATIO < extent < sheet * measures.SIZE_RATIO else sheet / extent
    frame = Letters(drawing, composition, scale_submission(submission, rough), pencil,
                    rough * extent / measures.FRAME_TOL_PARTS).mechanism if (
        extent) else None
    if frame is None:
        return submission, ()
    task, scale = composition.views[MECHANISM].scale, abs(frame.unit) / rough
    unit = _meant_unit(scale, task, submission.millimetres)
    if unit == "mm":
        return submission, ()
    if unit:
        mm = measures.DRAWING_UNITS[unit][0]
        return scale_submission(submission, mm), (said("drawn in {0} (1 unit = {1} mm)", unit_of(unit), digits(mm, 3)),)
    mm = min(task / scale, rough * least / sheet)  # no larger than the task: its errors are those of a pencil
    return (replace(scale_submission(submission, mm), millimetres=-math.inf),
            (said("drawn in a unit of its own (1 unit = {0} mm)", digits(mm, 3)),))


def _meant_unit(scale: float, task: float, millimetres: float) -> str | None:
    """The unit that a drawing is in, by the scale of its mechanism, in units of the drawing for one of the scene, and
    by how much speaks for mm; None if it is in one of its own."""
    against = {name: against + measures.RESIZED_COST * abs(math.log(scale * mm / task))
               + (0.0 if _is_round_scale(scale * mm, task) else measures.ODD_SCALE_COST)
               + (millimetres if name != "mm" else 0.0)
               for name, (mm, against) in measures.DRAWING_UNITS.items()}
    best = min(against, key=against.__getitem__)
    is_round = _is_round_scale(scale * measures.DRAWING_UNITS[best][0], task)  # which is no chance
    if against[best] <= measures.OWN_UNIT_COST + millimetres + measures.ODD_SCALE_COST * is_round:
        return best
    return "mm" if abs(math.log(scale / task)) <= math.log(measures.SIZE_RATIO) else None


def _extent(coordinates: Sequence[float]) -> float:
    """The width of a drawing by the coordinates of its spots, whatever lies far astray."""
    low, high = np.percentile(coordinates, measures.EXTENT_PERCENTILES)
    return float(high - low) * 100 / (measures.EXTENT_PERCENTILES[1] - measures.EXTENT_PERCENTILES[0])


def _is_round_scale(scale: float, task: float) -> bool:
    """Whether a scale, in mm for a unit of the scene, is the task's or a round one."""
    mantissa = scale / 10.0 ** math.floor(math.log10(scale))
    return any(abs(ratio - 1) < measures.ROUND_SCALE_TOL
               for ratio in (scale / task, *(mantissa / number for number in measures.ROUND_SCALES)))


def mirror_submission(submission: Submission) -> Submission:
    """A drawing seen from the other side of the paper."""
    def at(spot: Spot) -> Spot:
        return spot[0], -spot[1]

    traces = tuple(replace(trace, spots=tuple(map(at, trace.spots))) for trace in submission.traces)
    letters = tuple(replace(word, at=(word.at[0], -word.at[1] - word.size),
                            leads=at(word.leads) if word.leads else None) for word in submission.letters)
    return replace(submission, traces=traces, letters=letters, frames={}, tips=tuple(map(at, submission.tips)))


def scale_submission(submission: Submission, mm: float) -> Submission:
    """A drawing with every length so many times as large."""
    def at(spot: Spot) -> Spot:
        return spot[0] * mm, spot[1] * mm

    traces = tuple(replace(trace, spots=tuple(map(at, trace.spots)), blur=trace.blur * mm)
                   for trace in submission.traces)
    letters = tuple(replace(word, at=at(word.at), size=word.size * mm, long=word.long * mm,
                            leads=at(word.leads) if word.leads else None) for word in submission.letters)
    return replace(submission, traces=traces, letters=letters, tips=tuple(map(at, submission.tips)))


# ---- frames ---------------------------------------------------------------------------------------------------------

Pair = tuple[complex, complex]  # where a mark is on its plan, and where on the sheet


class FrameFinder:
    """The frames of a sheet: given ones, those of labelled marks, or those that unlabelled marks agree on."""

    def __init__(self, reading: SheetReading, pencil: Pencil, labels: Mapping[int, int]):
        self.reading, self.drawing, self.submission = reading, reading.drawing, reading.submission
        self.pencil = pencil
        plans = Plans(self.drawing)
        self.plan_of_step: Sequence[str] = plans.plan_of_step
        self.panels: Sequence[str] = plans.panels
        self.labels, self.taken = labels, set(labels.values())
        self.values: tuple[Sequence[Any], ...] = (self.drawing.values,)

    def mechanism(self) -> Fit:
        """Frame of the mechanism; refused if its points are not found."""
        if MECHANISM in self.submission.frames:
            return Fit(self.submission.frames[MECHANISM])
        steps = self.drawing.drawn.steps
        given_pairs = [pair for index, pair in self._labelled_pairs(MECHANISM) if index < self.drawing.drawn.givens]
        sigma = self._label_deviation
        marks, all_pairs = zip(*labelled, strict=True) if (labelled := self._labelled_pairs(MECHANISM)) else ((), ())
        fit = best_fit(given_pairs, sigma, self._task_scale) or best_fit(all_pairs, sigma)
        if self.reading.asked is not None and fit and len(given_pairs) < measures.MIN_WITNESSES:
            # one of few may be wrong, and marks that lie together fit in frames of any size; one mark may be far astray
            scale = median(abs(two[1] - one[1]) / apart for one, two in combinations(all_pairs, 2)
                           if (apart := abs(two[0] - one[0])))
            slips = point_deviations(hand(self.drawing, lambda _: 1 / scale, self.pencil), marks)
            fit = best_fit(all_pairs, sigma, scale, 2, [slip * scale for slip in slips])
        fit = fit or self._search_mechanism([complex(*self.drawing.values[step.index]) for step in steps[:len(
            self.drawing.scene.points)] if step.op.movement is Movement.GIVEN])
        if fit is None:
            names = ", ".join(list(self.drawing.scene.points)[:4])
            raise Refused(f"{self.submission.name}: mechanism",
                          "fewer than two of its points are drawn, so its position is unknown",
                          f"label them, as {names}")
        return fit

    @property
    def _task_scale(self) -> float:
        """The scale of the mechanism on the task's sheet."""
        views = self.reading.task.views
        return views[MECHANISM].scale if MECHANISM in views else 0.0

    @property
    def _label_deviation(self) -> float:
        """Deviation of a labelled point: larger for oblique crossings of strokes without dots."""
        traces = (self.submission.traces[place] for place in self.labels.values())
        blurs = [trace.blur for trace in traces if trace.crossed and trace.blur < measures.MAX_FRAME_BLUR_MM]
        return math.hypot(self.pencil.point, *(blur / math.sqrt(len(blurs)) for blur in blurs))

    def expect_after(self, matching: Matching) -> None:
        """Expect on the other plans what follows from the marks on the mechanism, and there no marks of it."""
        self.taken |= matching.used
        self.values = self.drawing.values, [plain_value(value) for value in matching.own]

    def expected_fits(self, panel: str, mechanism: Fit) -> list[Fit]:
        """The frame of another plan as the task's sheet has it, laid on its beginning or else on any mark of it; where
        no mark is labelled, the frames that unlabelled marks agree on."""
        if panel in self.submission.frames:
            return [Fit(self.submission.frames[panel])]
        unit = mechanism.frame.unit * float(self.reading.composition.scales.multiples.get(panel, 1))
        if anchor := self._plan_anchor(panel, unit):
            return [self._tied_fit(anchor[1] - unit * anchor[0], unit)]
        return [replace(self._tied_fit(origin, unit), shift=2 * self.pencil.point)
                for origin in self._voted_origins(panel, unit)]

    def rival_fits(self, panel: str, matching: Matching) -> Iterator[tuple[Fit, float]]:
        """Other frames of a plan, laid on its beginning, and what it weighs that they are not the expected one: those
        in which some of its vectors are as they should be, be it that they were carried over to it or end there.

        Reads a way through the drawing in the expected frame: what is carried over does not rest on that.
        """
        expected = matching.sheet.fits[panel]
        plan, sheet = self._plan_anchor(panel, expected.frame.unit) or (0j, 0j)
        carried_units = list(self._carried_units(panel, matching))  # surer, as what goes before is known
        anchored_units = list(self._anchored_units(panel, plan, sheet))
        for _, unit, sigma in chain(agreed_units(carried_units), agreed_units(anchored_units)):
            fit = Fit(PlanFrame(sheet - unit * plan, unit), sigma, 0.0, plan)
            if turn := frame_turn(fit, expected.frame.unit):
                yield fit, measures.REDIRECTED_STEPS
            if abs(math.log(abs(unit / expected.frame.unit))) > 3 * sigma:  # the mechanism tells its direction
                surest = min(carried_units, key=lambda carried: carried[1], default=(unit, 0.0))
                is_surest = not turn and abs(surest[0] / unit - 1) < 3 * surest[1]
                unit = expected.frame.unit * abs(unit / expected.frame.unit)
                yield (replace(fit, frame=PlanFrame(sheet - unit * plan, unit), aligned=MECHANISM),
                       measures.SUREST_VECTOR_STEPS if is_surest else measures.RESCALED_STEPS)

    def printed_panels(self, fits: Mapping[str, Fit]) -> frozenset[str]:
        """Plans of the task's sheet on which this drawing lies as printed, by these expected frames: the mechanism at
        its printed scale, and a plan at its printed place, or most marks of another one at the printed scale; none
        where the mechanism alone tells the unit of the drawing."""
        views, mechanism = self.reading.task.views, fits[MECHANISM].frame
        is_sized = self.submission.millimetres > -math.inf
        if not (is_sized and self.reading.on_task and self.reading.has_printed_scale(mechanism)):
            return frozenset()
        panels = [panel for panel in self.panels[1:] if panel in views and panel not in self.submission.frames]
        if any(self._is_at_printed_place(panel, fits) for panel in panels):
            return frozenset((MECHANISM, *panels))
        witnesses = {panel for panel in panels if not self.reading.departs and self._has_printed_marks(panel, fits)}
        return frozenset(panel for panel in (MECHANISM, *panels) if witnesses - {panel})

    def _is_at_printed_place(self, panel: str, fits: Mapping[str, Fit]) -> bool:
        """Whether a plan, of which a mark is labelled, lies to the mechanism as it is printed."""
        views, mechanism = self.reading.task.views, fits[MECHANISM]
        offset = complex(*views[panel].origin) - complex(*views[MECHANISM].origin)
        origin = mechanism.frame.origin + offset * mechanism.frame.unit / abs(mechanism.frame.unit)
        tolerance = measures.SURE_SIGMAS * math.hypot(2.0 * self._label_deviation, mechanism.turn * abs(offset))
        return bool(self._labelled_pairs(panel)) and abs(fits[panel].frame.origin - origin) < tolerance

    def _has_printed_marks(self, panel: str, fits: Mapping[str, Fit]) -> bool:
        """Whether most marks lie to their plan's beginning as they do at the printed scale."""
        unit = fits[panel].frame.unit
        plan, sheet = self._plan_anchor(panel, unit) or (0j, 0j)
        agreements = [abs(own / unit - 1) < measures.SAME_FRAME_SHARE + 3 * sigma
                      for own, sigma in self._anchored_units(panel, plan, sheet)]
        return 2 * sum(agreements) > len(agreements)

    def _plan_anchor(self, panel: str, unit: complex) -> Pair | None:
        """Labelled beginning of a plan; if its label may be another's or is missing, the mark with which most others
        agree on the plan's beginning."""
        steps, pairs = self.drawing.drawn.steps, self._labelled_pairs(panel)
        pairs.sort(key=lambda pair: steps[pair[0]].op.movement is not Movement.BEGUN)
        origins = np.array([sheet - unit * plan for _, (plan, sheet) in pairs])
        within = measures.SURE_SIGMAS * 2.0 * self._label_deviation
        agreeing = (np.abs(origins[:, None] - origins[None, :]) < within).sum(axis=1)
        most = int(agreeing.argmax()) if pairs else 0
        for index, pair in pairs:
            if steps[index].op.movement is Movement.BEGUN and is_sure(self.submission.traces[self.labels[index]]):
                return pair
        return pairs[most][1] if pairs else None

    def _carried_units(self, panel: str, matching: Matching) -> Iterator[tuple[complex, float]]:
        """Yield the unit of the plan by each vector on it that was brought from another plan, with its deviation."""
        spots, mark_sigma = dict(self._labelled_pairs(panel)), math.sqrt(2) * self._label_deviation
        for index, (_, end) in spots.items():
            start = matching.steps[index].root
            if start in spots and abs(seen := end - spots[start][1]) > measures.MIN_VECTOR_MM:
                vector = matching.sheet.laid_off(matching.steps[index], start, matching.own)
                if vector is not None and vector[0]:  # nothing has no scale
                    yield seen / vector[0], math.hypot(vector[1] / abs(vector[0]), mark_sigma / abs(seen))

    def _anchored_units(self, panel: str, start: complex, begun: complex) -> Iterator[tuple[complex, float]]:
        """Yield the unit of the plan by each of its marks, seen from its beginning, with its deviation."""
        for _, (plan, sheet) in self._labelled_pairs(panel):
            if plan != start and abs(sheet - begun) > measures.MIN_VECTOR_MM:
                yield (sheet - begun) / (plan - start), math.sqrt(2) * self._label_deviation / abs(sheet - begun)

    def _tied_fit(self, origin: complex, unit: complex) -> Fit:
        return Fit(PlanFrame(origin, unit), 0.0, 0.0, 0j, MECHANISM)

    def _labelled_pairs(self, panel: str) -> list[tuple[int, Pair]]:
        """The labelled points of a plan, by step: where each truly is, and where on the sheet."""
        return [(index, (complex(*self.drawing.values[index][:2]), complex(*self.submission.traces[place].spots[0])))
                for index, place in sorted(self.labels.items())
                if self.plan_of_step[index] == panel and (trace := self.submission.traces[place]).kind == POINT
                and not (trace.crossed and trace.blur > measures.MAX_FRAME_BLUR_MM)]

    # ---- unlabelled sheets -----------------------------------------------------------------------------------------

    def _unlabelled_spots(self) -> list[complex]:
        """Distinct spots that may be marks: unlabelled points, and the ends of lines."""
        taken = set(self.labels.values())
        spots = [complex(*spot) for place, trace in enumerate(self.submission.traces)
                 if place not in taken and trace.kind in (POINT, LINE) for spot in trace.spots[:2]]
        return list({(round(z.real, 2), round(z.imag, 2)): z for z in spots}.values())[:measures.MAX_ANCHORS]

    def _unlabelled_points(self) -> list[complex]:
        """The unlabelled points of a sheet that are not yet known."""
        return [complex(*trace.spots[0]) for place, trace in enumerate(self.submission.traces)
                if place not in self.taken and trace.kind == POINT]

    def _points_or_crossings(self) -> list[complex]:
        """Unlabelled points of a sheet, or without any the crossings of its lines."""
        if points := self._unlabelled_points():
            return points
        unlabelled = [trace for place, trace in enumerate(self.submission.traces) if place not in self.taken]
        lines = [tuple(complex(*spot) for spot in trace.spots[:2]) for trace in unlabelled if trace.kind == LINE]
        return [z for first, second in combinations(lines, 2) if (z := _line_crossing(first, second)) is not None]

    def _search_mechanism(self, given: Sequence[complex]) -> Fit | None:
        """The frame in which most of the given points have an unlabelled spot."""
        unlabelled, points = np.array(self._unlabelled_spots()), np.array(list(dict.fromkeys(given)))
        if len(unlabelled) < 2 or len(points) < 2:
            return None
        best_score, held_pairs, sigma = (min(3, len(points)) - 1, math.inf), list[Pair](), 4 * self.pencil.point
        for i, j in sorted(combinations(range(len(points)), 2), key=lambda ij: -abs(points[ij[0]] - points[ij[1]]))[
                :measures.CANDIDATES]:
            apart = points[j] - points[i]
            units = (unlabelled[None, :] - unlabelled[:, None]) / apart
            for k, l in permutations(range(len(unlabelled)), 2):
                off = np.abs((unlabelled[k] + units[k, l] * (points - points[i]))[:, None] - unlabelled[None, :])
                near, nearest = off.min(axis=1), unlabelled[off.argmin(axis=1)]
                score = int(np.sum(near < sigma)), -float(near[near < sigma].sum())
                if units[k, l] and score > best_score:
                    best_score = score
                    held_pairs = list(zip(points[near < sigma].tolist(), nearest[near < sigma].tolist(), strict=True))
        chance = measures.CANDIDATES * len(unlabelled) ** 2 * _sheet_share(unlabelled, sigma) ** (best_score[0] - 2)
        return best_fit(held_pairs, self.pencil.point) if held_pairs and chance < measures.CHANCE_MECHANISMS else None

    def _voted_origins(self, panel: str, unit: complex) -> list[complex]:
        """The origins of a plan for which most of its marks are where unlabelled ones are; one must be where the
        plan begins."""
        steps = [step for step, home in zip(self.drawing.drawn.steps, self.plan_of_step, strict=True)
                 if home == panel and step.op.gives == POINT]
        unlabelled = np.array(self._points_or_crossings())
        if not len(unlabelled):
            return [0j]
        begin = next((step for step in steps if step.op.movement is Movement.BEGUN), None)
        marks = [np.array([complex(*values[step.index][:2]) for step in steps]) for values in self.values]
        if begin is None or not self._unlabelled_points():
            return self._heaped_origins((unlabelled[:, None] - unit * np.concatenate(marks)[None, :]).ravel())
        origins = unlabelled - unit * complex(*self.drawing.values[begin.index][:2])

        def meets_unlabelled(spots: Any) -> Any:
            """Whether each spot has an unlabelled one near."""
            nearest = np.abs(spots[:, None] - unlabelled[None, :]).min(axis=1)
            return nearest < 2 * measures.AGREED_SIGMAS * self.pencil.point

        votes = np.max([sum(meets_unlabelled(origins + unit * mark) for mark in plan) for plan in marks], axis=0)
        return [complex(origins[k]) for k in np.argsort(-votes, kind="stable")[:measures.CANDIDATES]]

    def _heaped_origins(self, origins: Any) -> list[complex]:
        """The origins that most marks vote for."""
        cell = measures.AGREED_SIGMAS * self.pencil.point
        heaps = sorted((heap for wide in (cell, 3 * cell) for heap in _vote_heaps(origins, wide)), reverse=True)
        origins_kept: list[complex] = []
        for _, x, y in heaps:
            if all(abs(complex(x, y) - origin) > 4 * cell for origin in origins_kept):
                origins_kept.append(complex(x, y))
        return origins_kept[:measures.CANDIDATES]

    def find_origins(self, fits: Mapping[str, Fit]) -> dict[int, int]:
        """The unlabelled points that are the beginnings of plans, by step."""
        origin_places = {}
        points = [(place, complex(*trace.spots[0])) for place, trace in enumerate(self.submission.traces)
                  if trace.kind == POINT and place not in self.labels.values()]
        for step in self.drawing.drawn.steps:
            if step.op.movement is Movement.BEGUN and step.index not in self.labels and points:
                frame = fits[self.plan_of_step[step.index]].frame
                expected_spot = frame.to_sheet(complex(*self.drawing.values[step.index][:2]))
                place, spot = min(points, key=lambda point: abs(point[1] - expected_spot))
                if abs(spot - expected_spot) < measures.AGREED_SIGMAS * self.pencil.point:
                    origin_places[step.index] = place
        return origin_places


def _vote_heaps(spots: Any, cell: float) -> Iterator[tuple[int, float, float]]:
    """The cells of a grid with some spots in them: how many, and where their middle is."""
    for shift in (0, 0.5 + 0.5j, 0.5, 0.5j):  # a heap may lie across the cells of one grid
        cells = np.floor(spots.real / cell + shift.real) + 1j * np.floor(spots.imag / cell + shift.imag)
        _, cell_of_spot, counts = np.unique(cells, return_inverse=True, return_counts=True)
        for heap in np.argsort(counts)[-measures.MANY_CANDIDATES:]:
            heap_spots = spots[cell_of_spot == heap]
            yield int(counts[heap]), float(np.median(heap_spots.real)), float(np.median(heap_spots.imag))


def _sheet_share(spots: Any, sigma: float) -> float:
    """The part of the sheet on which a spot would be taken for one of these."""
    wide, high = np.ptp(spots.real) + sigma, np.ptp(spots.imag) + sigma
    return float(min(1.0, len(spots) * math.pi * sigma**2 / (wide * high)))


def _line_crossing(one: Sequence[complex], two: Sequence[complex]) -> complex | None:
    """Intersection of two lines; None if they are almost parallel."""
    u, v = one[1] - one[0], two[1] - two[0]
    sine = (u.conjugate() * v).imag
    if abs(sine) < measures.MIN_CROSSING_SINE * abs(u) * abs(v):
        return None
    return one[0] + ((two[0] - one[0]).conjugate() * v).imag / sine * u


def agreed_units(units: Sequence[tuple[complex, float]]) -> Iterator[tuple[int, complex, float]]:
    """Yield groups of units that agree: their number, their mean and its deviation, weighted by certainty; the largest
    group first."""
    groups = []
    for unit, sigma in units:
        group = [(u, s) for u, s in units if abs(u - unit) < measures.SURE_SIGMAS * math.hypot(sigma, s) * abs(unit)]
        weights = [1 / s**2 for _, s in group]
        mean = sum(w * u for w, (u, _) in zip(weights, group, strict=True)) / sum(weights)
        groups.append((len(group), mean, sum(weights) ** -0.5))
    groups.sort(key=lambda group: -group[0])
    units_yielded: list[complex] = []
    for count, unit, sigma in groups:
        if all(abs(unit - earlier) > sigma * abs(unit)
               for earlier in units_yielded) and len(units_yielded) < measures.MAX_RIVAL_FRAMES:
            units_yielded.append(unit)
            yield count, unit, sigma


def best_fit(pairs: Sequence[Pair], sigma: float, usual: float = 0.0, ratio: float = math.inf,
             slips: Sequence[float] = ()) -> Fit | None:
    """The frame on which most marks agree, each `sigma` mm off in x and in y; None where no two lie apart.

    Every two marks propose one; of those that hold equally many the one that misses them least is taken, of those that
    hold no more than two the one that is nearest to the `usual` scale, and fitted to all that it holds; none differs
    from that by more than a `ratio`. The marks that a frame was laid through shake it, the more the further off a mark
    is; they hold it the less, the further their own construction may have led them astray, by `slips` in mm.
    """
    most, least, held_places = 1, math.inf, list[int]()
    for first, second in combinations(pairs, 2):
        if first[0] != second[0] and first[1] != second[1]:
            unit = (second[1] - first[1]) / (second[0] - first[0])
            if usual and not 1 / ratio <= abs(unit) / usual <= ratio:
                continue
            off = [abs(sheet - first[1] - unit * (plan - first[0])) for plan, sheet in pairs]
            kept_places = [place for place, far in enumerate(off) if far <= measures.SURE_SIGMAS * 2.0 * sigma]
            missed = sum(off[place] ** 2 for place in kept_places)
            if len(kept_places) == 2 and usual:
                missed = abs(math.log(abs(unit) / usual))
            if len(kept_places) > most or (
                    len(kept_places) == most > 1 and missed < least and math.isinf(ratio)):
                most, least, held_places = len(kept_places), missed, kept_places
    held_slips = [slips[place] if slips else 0.0 for place in held_places]
    return fit_frame([pairs[place] for place in held_places], sigma, held_slips) if held_places else None


def fit_frame(pairs: Sequence[Pair], sigma: float, slips: Sequence[float]) -> Fit | None:
    """The frame of least squares, each mark weighed by how sure it is."""
    weights = [sigma**2 / (sigma**2 + slip**2) for slip in slips]
    marks, spots = zip(*pairs, strict=True)
    frame = PlanFrame.least_squares(marks, spots, weights)
    if not frame.unit or not cmath.isfinite(frame.unit):
        return None
    centre = complex(np.average(marks, weights=weights))
    turn = sigma / abs(frame.unit) / math.sqrt(sum(abs(mark - centre) ** 2 for mark in marks))
    return Fit(frame, turn, sigma / math.sqrt(len(pairs)), centre)


def frame_turn(fit: Fit, unit: complex) -> float:
    """Turn of a plan from its right direction, in radians; 0 if it may be right."""
    ratio = fit.frame.unit / unit
    sine = 3 * fit.turn + measures.SAME_FRAME_SHARE
    return 0.0 if ratio.real > 0 and abs(ratio.imag) < sine * abs(ratio) else cmath.phase(ratio)


def quarter_turns(ratio: complex, within: float) -> int | None:
    """The number of right angles, 0 to 3, by which a ratio of vectors is turned, within an angle in radians; None if it
    is turned by another angle."""
    quarters = round(cmath.phase(ratio) / (math.pi / 2))
    return quarters % 4 if abs(cmath.phase(ratio * 1j**-quarters)) < within else None


def departures(own: Collection[Fit], others: int = 0, *, is_printed: bool) -> float:
    """Count of mistakes for plans in frames of their own, and for `others`, the scale and sense of velocities: plans of
    one scale count once, and the first, where its scale is printed, more than a wrong vector."""
    scales, redirected = list[Fit](), sum(not fit.aligned for fit in own)
    for fit in own:
        if fit.aligned and all(frame_stretch(fit, known.frame.unit) != 1.0 for known in scales):
            scales.append(fit)
    rescaled = len(scales) + others
    first = measures.REDIRECTED_STEPS - measures.RESCALED_STEPS if is_printed and rescaled else 0.0
    return measures.REDIRECTED_STEPS * redirected + measures.RESCALED_STEPS * rescaled + first


def frame_stretch(fit: Fit, unit: complex) -> float:
    """Scale of a plan relative to the right one; 1 if it may be right."""
    ratio = abs(fit.frame.unit / unit)
    return 1.0 if abs(math.log(ratio)) < 3 * fit.turn + measures.SAME_FRAME_SHARE else ratio
