"""The composition of a sheet, in one pass: which paper, where plans, facts and words stand, and at which scales.

The results at usual scales give the size of the block of facts, in which any error has room. Of the papers, from the
smallest on, the first is taken on which plans have room, results are near enough, letters find places and the facts
have a place; the errors at the scales there are then told in the places that were kept for them. Words stand on pages
of their own; where they are asked for beside the plans, they have the room that they need at usual scales.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from itertools import chain
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.program import Panel
from graphplan.mechanism.sections import BESIDE_PLANS, NO_WORDS, PROTOCOLS
from graphplan.mechanism.units import iso_size
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import digits
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.layout import measures
from graphplan.sheet.layout.division import Packing
from graphplan.sheet.layout.facts_block import FactRows
from graphplan.sheet.layout.free_room import free_places, is_in_reading_order
from graphplan.sheet.layout.paper import (
    NO_GIVEN_SCALES,
    Arrangement,
    GivenScales,
    Measure,
    arrangements,
    choose_scales,
    divide_region,
    given_scales,
    paginate,
    panel_demands,
    protocol_pages,
    room,
    room_for_marks,
    unit_lengths,
    windows,
)
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.letter_room import share_without_room
from graphplan.sheet.lettering.letters import LetteredPlate, letter_plates
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.machine import wheel_reach
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.traced_motion import TracedMotion
from graphplan.sheet.plates.view import View, fit_scale, whole_plan_scale
from graphplan.sheet.tolerances import MIN_VECTOR, SCALE_TOL
from graphplan.sheet.words.facts import drawing_facts, drawing_remarks
from graphplan.sheet.words.rows import Deviations, Placed, TextRow, fill, tighten
from graphplan.sheet.words.texts import RESULTS, SheetWords
from graphplan.words.tongue import Tongue
from graphplan.words.tongue import tongue as tongue_of

Protocol = tuple[Arrangement, list[Placed]]  # a page of words, and what stands on it
WorstError = Callable[[Scales], float]  # of all results, relative to the largest value of its kind
Words = Measure[list[TextRow]] | None  # that stand beside the plans


@dataclass(frozen=True)
class Composition:
    """An arrangement with the scale and the window of each panel, and the plans in them; `protocol` are the pages of
    the words where they stand apart, `earlier` and `further` the numbers of pages before and after it."""

    arrangement: Arrangement
    scales: Scales
    views: dict[str, View]
    plans: Plans
    protocol: tuple[Protocol, ...] = ()
    earlier: int = 0
    further: int = 0

    @property
    def page_count(self) -> int:
        """Number of pages."""
        return self.earlier + 1 + len(self.protocol) + self.further

    @cached_property
    def plates(self) -> Plates:
        """Plans at their places on the page."""
        return Plates(self.plans, self.views, self.arrangement.letters)

    @cached_property
    def pictures(self) -> dict[Panel, LetteredPlate]:
        """The plans with their letters, which keep off given and found."""
        return letter_plates(self.plates, [column for place in self.arrangement.facts for column in place.columns])

    @property
    def poor(self) -> float:
        """The part of the letters that can hardly be read."""
        labels = [picture.letters for picture in self.pictures.values()]
        return sum(plan.poor for plan in labels) / max(1, sum(len(plan.wishes) for plan in labels))

    @property
    def legible(self) -> bool:
        """Whether no link is too short for letters, and few letters can hardly be read."""
        shortest_mm = shortest_link(self.plans) * self.views[self.plans.panels[0]].scale
        return shortest_mm >= measures.MIN_LINK_MM and self.poor <= measures.MAX_POOR_SHARE

    @property
    def plan_size(self) -> float:
        """Size of the plans: the mechanism counts most, each other plan one half or, of more than two, by its share of
        their marks. A vector that cannot be measured counts against it."""
        first = self.plans.panels[0]
        marks = {panel: count for panel, count in self.plans.point_counts.items() if panel != first}
        weights = {panel: count / sum(marks.values()) if len(marks) > 2 else 0.5 for panel, count in marks.items()}
        weights[first] = 1.0
        large = sum(weight * math.log(self._scale(panel)) for panel, weight in weights.items())
        return round(large - measures.SHORT_VECTOR_PRICE * len(self.short), 9)

    def _scale(self, panel: str) -> float:
        """Scale of a plan; if marks are cut off, no larger than that of the whole plan."""
        view = self.views[panel]
        whole = whole_plan_scale(self.plans.extents[panel], room_for_marks(view.rect))
        return view.scale if panel == self.plans.panels[0] else min(view.scale, whole)

    @property
    def short(self) -> list[float]:
        """Lengths in mm of vectors that are too short for a ruler, without negligible ones of their kind."""
        vectors = [(kind, length * self.views[panel].scale) for kind, panel, length in self.plans.lengths]
        largest = dict(sorted(vectors))
        return [length for kind, length in vectors if MIN_VECTOR * largest[kind] <= length < measures.MIN_VECTOR_MM]

    @property
    def oversize_factors(self) -> dict[str, float]:
        """The plans that do not fit their panels at a given scale, and by how much they are too large."""
        much = {panel: fit_scale(self.plans.extents[panel].core, room_for_marks(window.rect)) * window.scale
                for panel, window in self.views.items()}
        return {panel: times for panel, times in much.items() if times > 1 + SCALE_TOL}

    def with_facts_in_free_room(self, facts: FactRows) -> Composition | None:
        """The composition with facts in places among what is drawn; None where there is no room."""
        items = (picture.first_items for picture in self.pictures.values())
        places = free_places(facts, self.arrangement, chain.from_iterable(items))
        return replace(self, arrangement=replace(self.arrangement, facts=places)) if places else None


def composition_of(arrangement: Arrangement, plans: Plans, given: GivenScales) -> Composition:
    """The composition of one arrangement: with scales, round if they are not given, and windows."""
    rooms = {panel: room(rect) for panel, rect in arrangement.panels.items()}
    scales, views = windows(rooms, plans, given)
    return Composition(arrangement, scales, views, plans)


def shortest_link(plans: Plans) -> float:
    """The shortest distance of two joints of a link."""
    links = plans.drawing.scene.links.values()
    apart = (math.dist(plans.place(p), plans.place(q)) for names in links for p in names for q in names)
    return min((distance for distance in apart if distance > 0), default=math.inf)


def usual_paper(plans: Plans) -> str:
    """The paper that is usual for so many moving links and plans."""
    moving, count = len(plans.drawing.scene.moving), len(plans.panels)
    return next(size for size, links, panels in measures.USUAL_PAPERS if moving <= links and count <= panels)


def compose(drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
            tongue: Tongue | None = None, protocol: str = PROTOCOLS[0],
            motion: TracedMotion | None = None) -> Composition:
    """Arrange a construction on the paper named here or by the scene, or on the smallest good one, without errors.

    Without a tongue it speaks that of the scene's sheet; `protocol` says where the words stand, `motion` what is
    shown of it (cycle/traced.py).

    Fails with `Refused` where the words do not fit the paper named.
    """
    composer = Composer(drawing, paper, check, tongue, protocol, motion)
    return composer.with_texts(composer.choose(Deviations()), Deviations())


class Composer:
    """Items on the sheet of a construction, and their arrangement; see :func:`compose`."""

    def __init__(self, drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
                 tongue: Tongue | None = None, protocol: str = PROTOCOLS[0],
                 motion: TracedMotion | None = None, lettered: bool = True):
        scene = drawing.scene
        say = tongue or tongue_of(scene.sheet.language or "en")
        self.plans = Plans(drawing, say, motion=motion, swept={MECHANISM: wheel_reach(scene)})
        self.protocol, self.lettered = protocol, lettered
        self.paper = paper or scene.sheet.paper or None
        self.frame, self.title = frame_of(scene), frame_of(scene).block(scene, say)
        self.words, self.given = SheetWords(self.plans, check or {}), given_scales(self.plans)
        self.packings: dict[tuple[str, Rect], Packing] = {}

    @cached_property
    def usual(self) -> Scales:
        """The scales on panels of a usual size."""
        rooms: dict[str, Rect] = dict.fromkeys(
            self.plans.panels, room_for_marks(room(Rect(0.0, 0.0, *measures.USUAL_PANEL_MM))))
        return choose_scales(rooms, self.plans, self.given)

    def choose(self, pencil: Deviations, worst_error: WorstError = lambda scales: 0.0) -> Composition:
        """The plans on the paper named, or on the smallest that shows everything well, with places for the facts and
        for words beside the plans, as these are at usual scales with the errors of a `pencil`.

        Results that would be too far off have paper as large as is usual for so many links. Fails with `Refused` where
        the words, or the scales that are given, do not fit the paper named.
        """
        facts = self._facts(pencil)
        words = cache(self._rows(self.usual, pencil)) if self.protocol == BESIDE_PLANS else None
        papers = [self.frame.paper(self.paper)] if self.paper else self.frame.papers
        for paper in papers:
            if composition := self._on_paper(paper, facts, words, worst_error):
                return composition
        last = self._compositions(papers[-1], words)
        if any(composition.oversize_factors for composition in last):
            raise too_large_refusal(min(last, key=lambda one: max(one.oversize_factors.values())))
        larger = "other scales"
        if self.paper:
            elsewhere = copy(self)
            elsewhere.paper = None
            larger = elsewhere.choose(pencil, worst_error).arrangement.paper
        raise Refused(f"paper {papers[-1]}", "words and plans do not fit on it legibly", f"{larger}, or no name")

    def _on_paper(self, paper: str, facts: FactRows, words: Words, worst_error: WorstError) -> Composition | None:
        """The best arrangement on a paper with its facts: in free room, else on a part of the page, so that what was
        found is read after what is given; None where it cannot be read.

        On paper that is named, or the largest, facts stand with the words where there is no room for them.
        """
        best = self._best(paper, words, worst_error)
        if best is None or not (facts and self.lettered):
            return best
        placed = best.with_facts_in_free_room(facts)
        if placed and is_in_reading_order(placed.arrangement.facts):
            return placed
        least = placed.plan_size - measures.READING_ORDER_PRICE if placed else -math.inf
        if apart := self._best(paper, words, worst_error, facts, least):
            return apart
        may_lack_facts = self._is_fixed or paper == self.frame.papers[-1]
        return placed or (best if may_lack_facts else None)

    def _best(self, paper: str, words: Words, worst_error: WorstError, facts: FactRows | None = None,
              least: float = -math.inf) -> Composition | None:
        """The arrangement on a paper with the largest plans, with a part of the page for `facts`; None where plans are
        smaller than the `least`, it cannot be read, or results are too far off on paper smaller than usual."""
        fitting = [one for one in self._compositions(paper, words, facts) if not one.oversize_factors]
        best = max(fitting, key=lambda one: one.plan_size, default=None)
        if best is None or best.plan_size < least:
            return None
        if not self._is_fixed and iso_size(paper) > usual_paper(self.plans) \
                and worst_error(best.scales) > measures.MAX_ERROR_SHARE:
            return None
        poor = best.poor if self.lettered else share_without_room(best.plates)
        return best if poor <= self._max_poor_share(paper) else None

    def _max_poor_share(self, paper: str) -> float:
        """The part of the letters that may find no good place on a paper."""
        size = iso_size(paper)
        if not self._is_fixed and size > usual_paper(self.plans):
            return measures.MAX_POOR_SHARE
        if not self._is_fixed and size == "A4":
            return measures.MAX_POOR_SHARE_ON_A4
        return 1.0 if size in measures.LARGEST_PAPERS else measures.MAX_POOR_SHARE_ON_USUAL

    @property
    def _is_fixed(self) -> bool:
        """Whether the paper or the scales are given."""
        return bool(self.paper or self.given[0])

    def _compositions(self, paper: str, words: Words, facts: FactRows | None = None) -> list[Composition]:
        """The ways to arrange a paper, with a part of the page for `facts`, at the given scales if there are any."""
        wants = [panel_demands(self.plans, given, paper)
                 for given in ([self.given, NO_GIVEN_SCALES] if self.given[0] else [NO_GIVEN_SCALES])]
        divide = partial(divide_region, self.packings, paper, wants, self.plans)
        return [composition_of(arrangement, self.plans, self.given)
                for arrangement in arrangements(paper, divide, words, self.frame, self.title, facts)]

    def with_texts(self, composition: Composition, pencil: Deviations) -> Composition:
        """The composition with its facts, and its words beside the plans or on pages of their own, as they are at its
        scales with the errors of a `pencil`."""
        facts, rows = self._facts(pencil), self._rows(composition.scales, pencil)
        arrangement = composition.arrangement
        fact_items = arrangement.set_facts(facts)
        if fact_items is None:  # a remark on the pose is longer than at usual scales: the words have it
            fact_items = arrangement.set_facts(self._facts(replace(pencil, remark=None)))
        arrangement = replace(arrangement, fact_items=fact_items or ())
        words = rows if self.protocol != NO_WORDS else None
        if facts and not arrangement.facts:  # no room for them on the first page
            words = facts if words is None else lambda wide: [*facts(wide), *rows(wide)]
        if words and arrangement.columns:
            loose = arrangement.set(words)
            for set_rows in (loose, tuple(map(tighten, loose))):
                if fill(set_rows, arrangement.columns) is not None:
                    return replace(composition, arrangement=replace(arrangement, rows=set_rows))
            arrangement = replace(arrangement, columns=())
        pages = protocol_pages(arrangement.paper, words, self.frame, self.title) if words else ()
        return replace(composition, arrangement=arrangement, protocol=pages)

    def _rows(self, scales: Scales, pencil: Deviations) -> Measure[list[TextRow]]:
        """The words at some scales, for columns of any width."""
        return lambda wide: self.words.rows(round(wide, 9), scales, pencil)  # columns of one width differ by rounding

    def _facts(self, pencil: Deviations) -> FactRows:
        """Given facts, and results with these drawing errors."""
        drawing = self.plans.drawing
        return FactRows(self.plans.tongue, *drawing_facts(drawing, self.words.values, pencil),
                        tuple(drawing_remarks(drawing, pencil)), tuple(drawing.scene.points))


def too_large_refusal(tried: Composition) -> Refused:
    """The refusal of given scales at which plans do not fit a paper, with the largest that do."""
    paper, scales, oversized = tried.arrangement.paper, tried.scales, tried.oversize_factors
    first = tried.plans.panels[0]
    if first in oversized:
        k_s = float(round_up(scales.k_s * oversized[first], unit_lengths(tried.plans, first)[:1]))
        most = f"{ratio(k_s, scales.length)} (k_s = {digits(k_s)}) or smaller"
        return Refused(f"sheet: the scale {ratio(scales.k_s, scales.length)}", f"the mechanism does not fit on {paper}",
                       f"{most}, or a larger sheet")  # fmt: skip
    panel, times = max(oversized.items(), key=lambda item: item[1])
    multiple = scales.multiples[panel]
    most = f"×{1 / float(round_up(times / float(multiple))):g} or less in [sheet.multiples]"
    return Refused(f"sheet: the {panel} ×{multiple}", f"it does not fit on {paper}",
                   f"{most}, or a larger sheet")  # fmt: skip


def with_results_alone(composition: Composition) -> Composition:
    """The composition whose pages of words have no steps, which are told elsewhere."""
    rows = [row for _, placed_rows in composition.protocol for row, _, _ in placed_rows if row.layer == RESULTS]
    pages = ((page, placed_rows) for page, _ in composition.protocol[:1] for placed_rows in paginate(rows, page))
    return replace(composition, protocol=tuple(pages))
