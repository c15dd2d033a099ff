"""The composition of a sheet: which plans, facts and words stand where, and whether all of it can be read."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from itertools import chain
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.program import Panel
from graphplan.mechanism.sections import BESIDE_PLANS, PROTOCOLS
from graphplan.mechanism.units import iso_size
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import digits
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.frames.title import TitleBlock
from graphplan.sheet.layout.facts_block import FactRows
from graphplan.sheet.layout.free_room import (
    free_places,
    lower_plans,
    raise_plan,
    reads_on,
    share_without_room,
    smaller_plan,
)
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
from graphplan.sheet.lettering.letters import LetteredPlate, letter_plates, wishes_inside, wishes_on
from graphplan.sheet.plates.display import Rect, Spot
from graphplan.sheet.plates.machine import wheel_reach
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.traced_motion import TracedMotion
from graphplan.sheet.plates.view import View, fit_scale, whole_plan_scale
from graphplan.sheet.tolerances import AREA_TOL, MIN_VECTOR, SCALE_TOL
from graphplan.sheet.words.facts import drawing_facts, drawing_remarks
from graphplan.sheet.words.rows import Deviations, Placed, TextRow, need_same_room
from graphplan.sheet.words.texts import RESULTS, SheetWords
from graphplan.words.tongue import Tongue
from graphplan.words.tongue import tongue as tongue_of

MIN_LINK_MM = 4.5  # mm: a link shorter than this has no room for letters
MIN_ENLARGED_LINK_MM = 1.2  # mm: the same on paper that is usual, where a detail shows it enlarged
MIN_AREA_PER_MARK = 85.0  # mm^2 of a plan for each of its marks: with less, the letters hide the lines
MIN_AREA_ON_USUAL = 60.0  # mm^2: the same of the mechanism on paper that is usual; a small plan gets a detail
MIN_AREA_ON_LARGE_SHEETS = {"A2": 60.0, "A1": 0.0, "A0": 0.0}  # the same where the next sheet is not taken readily
MAX_POOR_SHARE = {"A4": 0.08, "A3": 0.1, "A2": 0.13, "A1": 1.0, "A0": 1.0}  # of all letters may find no good place
MAX_POOR_SHARE_ON_NAMED = 0.7  # of them, on paper that is named, or that is usual
MAX_POOR_SHARE_ON_A4 = 0.25  # the same on A4 where that is usual
USUAL_PAPERS = (  # up to so many moving links and plans
    ("A4", 3, 5), ("A3", 7, 8), ("A2", math.inf, 12), ("A1", math.inf, math.inf))
LARGER_FOR_ACCURACY = ("A4", 3), ("A3", 7), ("A2", math.inf)  # up to so many moving links
NEAR_MM = 5.0  # mm: from another letter
MAX_NEIGHBOURS = 1.5  # so near: with more letters can hardly be read
MIN_VECTOR_MM = 5.0  # mm: the shortest vector that can be measured
SHORT_VECTOR_PRICE = 0.2  # by so much smaller, as a logarithm, a plan may be for a vector that can be measured


class PlansOnPaper:
    """Plans in their windows at their scales, as far as these are judged."""

    plans: Plans
    views: dict[str, View]
    scales: Scales

    @property
    def score(self) -> float:
        """How large the plans are: the mechanism counts most, each other plan one half or, of more than two, as many of
        their marks as it has. What cannot be measured counts against it."""
        first = self.plans.panels[0]
        marks = {panel: count for panel, count in self.plans.point_counts.items() if panel != first}
        weights = {panel: count / sum(marks.values()) if len(marks) > 2 else 0.5 for panel, count in marks.items()}
        weights[first] = 1.0
        large = sum(weight * math.log(self._scale(panel)) for panel, weight in weights.items())
        return round(large - SHORT_VECTOR_PRICE * len(self.short), 9)

    @property
    def short(self) -> list[float]:
        """The mm of vectors that are too short for a ruler, without what is next to nothing beside its kind."""
        vectors = [(kind, length * self.views[panel].scale) for kind, panel, length in self.plans.lengths]
        largest = dict(sorted(vectors))
        return [length for kind, length in vectors if MIN_VECTOR * largest[kind] <= length < MIN_VECTOR_MM]

    @property
    def oversize_factors(self) -> dict[str, float]:
        """The plans that do not fit their panels at a given scale, and by how much they are too large."""
        much = {panel: fit_scale(self.plans.extents[panel].core, room_for_marks(window.rect)) * window.scale
                for panel, window in self.views.items()}
        return {panel: times for panel, times in much.items() if times > 1 + SCALE_TOL}

    def _scale(self, panel: str) -> float:
        """How large a plan is; one of which marks are cut off counts no larger than all of it would be."""
        view = self.views[panel]
        whole = whole_plan_scale(self.plans.extents[panel], room_for_marks(view.rect))
        return view.scale if panel == self.plans.panels[0] else min(view.scale, whole)


def is_legible(plans: Plans, views: Mapping[str, View], paper: str, share: float = 1.0) -> bool:
    """Whether the links are long enough for letters, and no plan is crowded; large sheets are soon good enough.

    With a `share` each mark needs only so much of its area.
    """
    first, grows = plans.panels[0], may_be_larger(plans, paper)
    for panel, window in views.items():
        spots = [spot for spot in (window(plans.spot(i)) for i in plans.points(panel)) if window.rect.holds(spot)]
        area = MIN_AREA_PER_MARK if grows else MIN_AREA_ON_USUAL if panel == first else 0.0
        each = share * MIN_AREA_ON_LARGE_SHEETS.get(paper, area)
        if _area_of_marks(spots, each) < each * len(spots):
            return False
    least = MIN_LINK_MM if grows else MIN_ENLARGED_LINK_MM
    return paper in MIN_AREA_ON_LARGE_SHEETS or shortest_link(plans) * views[first].scale >= least


def _area_of_marks(spots: Sequence[Spot], each: float) -> float:
    """The area of some marks, a slim figure as one half as wide as it is long, with the margin around it that is theirs
    where each mark is in the middle of its own area; that of as many where they all coincide and are nowhere apart."""
    box, margin = bounding_box(spots or [(0.0, 0.0)]), math.sqrt(each)
    size = max(box.area, (box.width**2 + box.height**2) / 4)
    whole = size + margin * (box.width + box.height) + each
    return whole if size > AREA_TOL else each * len(spots)


def shortest_link(plans: Plans) -> float:
    """The shortest distance of two joints of a link."""
    links = plans.drawing.scene.links.values()
    apart = (math.dist(plans.place(p), plans.place(q)) for names in links for p in names for q in names)
    return min((distance for distance in apart if distance > 0), default=math.inf)


def max_poor_share(plans: Plans, paper: str, is_given: bool) -> float:
    """The part of the letters that may find no good place on paper that is given, or not."""
    size, moving, count = iso_size(paper), len(plans.drawing.scene.moving), len(plans.panels)
    usual = next(size for size, most, most_plans in USUAL_PAPERS if moving <= most and count <= most_plans)
    if is_given:
        return MAX_POOR_SHARE_ON_NAMED
    on_usual = MAX_POOR_SHARE_ON_A4 if size == "A4" else MAX_POOR_SHARE_ON_NAMED
    return max(MAX_POOR_SHARE[size], on_usual if size <= usual else 0.0)


def may_be_larger(plans: Plans, paper: str) -> bool:
    """Whether paper is smaller than it may be for so many links where results would be too far off."""
    moving = len(plans.drawing.scene.moving)
    return iso_size(paper) > next(size for size, most in LARGER_FOR_ACCURACY if moving <= most)


def crowding(plates: Plates) -> float:
    """How many other letters a letter has near it, before they have places."""
    neighbours, count = 0, 0
    for plate in plates:
        wishes = wishes_inside(wishes_on(plate), plate.view.rect)
        spots = np.array([wish.spots[0] for wish in wishes]).reshape(-1, 2)
        apart = np.hypot(*(spots[:, None] - spots).transpose(2, 0, 1))
        neighbours, count = neighbours + int((apart < NEAR_MM).sum()) - len(spots), count + len(spots)
    return neighbours / max(1, count)


def too_large_refusal(tried: PlansOnPaper, paper: str) -> Refused:
    """The refusal of given scales at which plans do not fit a paper, with the largest that do."""
    scales, oversized, first = tried.scales, tried.oversize_factors, tried.plans.panels[0]
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


USUAL_PANEL = 200.0, 150.0  # mm: a panel as there are many
MAX_ERROR = 0.1  # of the largest value of its kind: where a result is worse, the paper is as large as may be
MAX_SCALE_LOSS = 1.25  # times as small as without them plans may be for facts that stand in one place
MAX_ROUNDS = 4  # words measure, so their room hangs on the scales, and these on their room: so often it is tried


@dataclass(frozen=True)
class Composition(PlansOnPaper):
    """An arrangement with the scale and the window of each panel, and what they show; `protocol` are the pages of the
    words where they stand apart."""

    arrangement: Arrangement
    scales: Scales
    views: dict[str, View]
    plans: Plans
    protocol: tuple[Protocol, ...] = ()
    further: int = 0  # pages that follow

    @property
    def page_count(self) -> int:
        """How many pages there are."""
        return 1 + len(self.protocol) + self.further

    @cached_property
    def plates(self) -> Plates:
        """What is drawn, where it lies on the page: in the same windows the same, whatever words stand beside it."""
        windows = Plates, *self.views.values(), self.arrangement.letters
        if windows not in self.plans.drawn:
            self.plans.drawn[windows] = Plates(self.plans, self.views, self.arrangement.letters)
        plates: Plates = self.plans.drawn[windows]
        return plates

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
        """Whether it is large enough to be read, as is asked of a sheet that is chosen."""
        paper = self.arrangement.paper
        return is_legible(self.plans, self.views, paper) and self.poor <= MAX_POOR_SHARE[iso_size(paper)]

    def clearly_crowds(self, is_given: bool) -> bool:
        """Whether letters have no places, as far as is known before they are placed."""
        most = max_poor_share(self.plans, self.arrangement.paper, is_given)
        return most < MAX_POOR_SHARE_ON_A4 and crowding(self.plates) > MAX_NEIGHBOURS

    def stays_below(self, most: float) -> bool:
        """Whether no larger part of the letters can hardly be read, or none once they make room for each other, where
        vectors can be measured on paper that is usual."""
        if self.poor <= most or self.poor > MAX_POOR_SHARE_ON_NAMED:
            return self.poor <= most
        return not (may_be_larger(self.plans, self.arrangement.paper) or self.short or any(
            picture.letters.hidden for picture in self.pictures.values()))


WorstError = Callable[[Scales], float]  # of all results, relative to the largest value of its kind
Protocol = tuple[Arrangement, list[Placed]]  # a page of words, and what stands on it


def best_composition(plans: Plans, title: TitleBlock, paper: str | None, words: Measure[Sequence[TextRow]] | None,
                     lettered: bool = True, *, facts: FactRows, worst_error: WorstError,
                     earlier: Composition | None = None) -> Composition:
    """The best arrangement on the paper named, or on the smallest that shows everything at a good size.

    `words` are those that stand beside the plans. Facts stand in the room that plans leave free, else on a part of the
    page that is theirs; on paper that is named, or the largest, they stand with the words where it has no room for
    them. Where it is not to be `lettered`, no letters are placed; about how many have no room is known. With no fewer
    words than an `earlier` one it is on no smaller paper. For results that would be too far off the paper is as large
    as usual for so many links. Fails with `Refused` where the words, or the scales that are given, do not fit the paper
    named.
    """
    search = _PaperSearch(plans, title, lettered, given_scales(plans), worst_error)
    papers, is_given = [search.frame.paper(paper)] if paper else search.frame.papers, bool(search.scales[0] or paper)
    for name in papers[papers.index(earlier.arrangement.paper) if earlier else 0:]:
        is_last = name == search.frame.papers[-1]
        tried = _TriedPaper(search, name, words, facts, is_given, need_facts=not (is_given or is_last))
        if (best := tried.plain) and not lettered:
            return best
        if best and ((placed := tried.with_facts()) or not tried.need_facts):
            return placed or best
    if any(composition.oversize_factors for composition in search.tried):
        nearest = min(search.tried, key=lambda composition: max(composition.oversize_factors.values()))
        raise too_large_refusal(nearest, nearest.arrangement.paper)
    larger = "other scales"
    if paper:
        best = best_composition(plans, title, None, words, facts=facts, worst_error=worst_error)
        larger = best.arrangement.paper
    raise Refused(f"paper {paper or 'A0'}", "words and plans do not fit on it legibly", f"{larger}, or no name")


def with_facts_in_free_room(composition: Composition, facts: FactRows) -> Composition | None:
    """The composition with facts in places among what is drawn; none where there is no room."""
    if not facts:
        return composition
    items = (picture.first_items for picture in composition.pictures.values())
    places = free_places(facts, composition.arrangement, chain.from_iterable(items))
    return replace(composition, arrangement=replace(composition.arrangement, facts=places)) if places else None


def with_smaller_plan(composition: Composition) -> Composition | None:
    """The composition with the plan of fewest marks smaller, at the head of its panel, as long as vectors can be
    measured on it; none where they cannot, or it has many marks."""
    if not (changed := smaller_plan(composition.plans, composition.scales)):
        return None
    panel, scales = changed
    smaller = composition_of(composition.arrangement, composition.plans, scales)
    views = {**smaller.views, panel: raise_plan(smaller.views[panel], panel, composition.plans)}
    return replace(smaller, views=views) if len(smaller.short) <= len(composition.short) else None


class _PaperSearch:
    """The search for an arrangement of some plans; `tried` are the last ones, at `scales` as the scene gives them."""

    def __init__(self, plans: Plans, title: TitleBlock, lettered: bool, scales: GivenScales, worst_error: WorstError):
        self.plans, self.title, self.lettered, self.scales = plans, title, lettered, scales
        self.worst_error = worst_error
        self.frame, self.tried = frame_of(plans.drawing.scene), list[Composition]()

    def best(self, paper: str, words: Measure[Sequence[TextRow]] | None, facts: FactRows | None,
             is_given: bool) -> Composition | None:
        """The best arrangement on some paper, if it is large enough: where paper or scales are given less is asked."""
        wants = [panel_demands(self.plans, scales, paper)
                 for scales in ((self.scales, NO_GIVEN_SCALES) if self.scales[0] else (NO_GIVEN_SCALES,))]
        divide = partial(divide_region, wants, self.plans, paper)
        candidates = list(arrangements(paper, divide, words, self.frame, self.title, facts))
        candidates = [arrangement for arrangement in candidates if arrangement.facts or not facts]
        self.tried = [composition_of(arrangement, self.plans, self.scales) for arrangement in candidates] or self.tried
        fitting = [composition for composition in self.tried if not composition.oversize_factors]
        if not (candidates and fitting):
            return None
        best = max(fitting, key=lambda composition: composition.score)
        is_too_small = may_be_larger(self.plans, paper) and self.worst_error(best.scales) > MAX_ERROR
        legible = is_given or (is_legible(self.plans, best.views, paper) and not is_too_small)
        return best if legible and not (self.lettered and best.clearly_crowds(is_given)) else None

    def reads_well(self, composition: Composition, is_given: bool) -> bool:
        """Whether few enough of the letters can hardly be read."""
        most = max_poor_share(self.plans, composition.arrangement.paper, is_given)
        return composition.stays_below(most) if self.lettered else share_without_room(composition.plates) <= most


@dataclass
class _TriedPaper:
    """What a search finds on one paper: the best arrangement, and the best with a part of the page for facts, if it can
    do without them."""

    search: _PaperSearch
    paper: str
    words: Measure[Sequence[TextRow]] | None
    facts: FactRows
    is_given: bool
    need_facts: bool

    @cached_property
    def plain(self) -> Composition | None:
        """The best arrangement, where it reads well."""
        best = self.search.best(self.paper, self.words, None, self.is_given)
        return best if best and self.search.reads_well(best, self.is_given) else None

    @cached_property
    def _facts_apart(self) -> Composition | None:
        """The best arrangement with a part of the page for facts, before it is known how its letters read."""
        return self.search.best(self.paper, self.words, self.facts, self.is_given)

    def with_facts(self) -> Composition | None:
        """The best arrangement with its facts: in free room, else on a part of the page; none where there is no room.
        Where they would be read in the wrong order in free room they have a part of the page that costs the plans
        little, or room at the heads of panels, as far as they are not there."""
        best, facts = self.plain, self.facts
        if best is None:
            return None
        placed = with_facts_in_free_room(best, facts)
        if placed and reads_on(placed.arrangement.facts):
            return placed
        divided = self._facts_apart
        if divided and not self.search.reads_well(divided, self.is_given):
            divided = None
        if divided and divided.scales.keeps(best.scales, MAX_SCALE_LOSS):
            return divided
        if placed:
            low = with_facts_in_free_room(replace(best, views=lower_plans(best.views, self.search.plans)), facts)
            return low if low and reads_on(low.arrangement.facts) else placed
        smaller = with_smaller_plan(best)
        return (with_facts_in_free_room(smaller, facts) if smaller else None) or divided


def composition_of(arrangement: Arrangement, plans: Plans, given: GivenScales) -> Composition:
    """The composition of one arrangement: with scales, round if they are not given, and windows."""
    rooms = {panel: room(rect) for panel, rect in arrangement.panels.items()}
    scales, views = windows(rooms, plans, given)
    return Composition(arrangement, scales, views, plans)


def compose(drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
            tongue: Tongue | None = None, protocol: str = PROTOCOLS[0],
            motion: TracedMotion | None = None) -> Composition:
    """Arrange a construction on the paper named here or by the scene, or on the smallest good one.

    Without a tongue it speaks that of the scene's sheet; `protocol` says where the words stand, `motion` what is
    shown of it (cycle/traced.py).

    Fails with `Refused` where the words do not fit the paper named.
    """
    return Composer(drawing, paper, check, tongue, protocol, motion).compose()


class Composer:
    """Composes a construction on its paper, as often as its drawing errors change; see :func:`compose`.

    How words are laid out hangs on how high their rows are, so what differs in nothing else is composed once.
    """

    def __init__(self, drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
                 tongue: Tongue | None = None, protocol: str = PROTOCOLS[0],
                 motion: TracedMotion | None = None, lettered: bool = True):
        self.worst_error: WorstError = lambda scales: 0.0
        scene = drawing.scene
        say = tongue or tongue_of(scene.sheet.language or "en")
        self.plans = Plans(drawing, say, motion=motion, swept={MECHANISM: wheel_reach(scene)})
        self.protocol = protocol
        self.paper, self.lettered = paper or scene.sheet.paper or None, lettered
        self.frame, self.title = frame_of(scene), frame_of(scene).block(scene, say)
        self.words = SheetWords(self.plans, check or {})
        self._composed: tuple[Composition, FactRows, dict[float, list[TextRow]]] | None = None

    @property
    def usual(self) -> Scales:
        """The scales on panels of a usual size."""
        rooms: dict[str, Rect] = dict.fromkeys(self.plans.panels, room_for_marks(room(Rect(0.0, 0.0, *USUAL_PANEL))))
        return choose_scales(rooms, self.plans, given_scales(self.plans))

    def compose(self, pencil: Deviations | None = None, worded: bool = True) -> Composition:
        """The composition with these drawing errors told on it, or without any words where these are not `worded` yet;
        what its words measure is so at its scales."""
        pencil = pencil or Deviations()
        scales, facts = self._composed[0].scales if self._composed else self.usual, self._facts(pencil)
        for _ in range(MAX_ROUNDS if self.protocol == BESIDE_PLANS else 1):
            composition = self._compose_at(scales, pencil, facts)
            if composition.scales == scales:
                break
            scales = composition.scales
        rows = self._rows(composition.scales, pencil)
        return self._with_words(composition, rows, facts) if worded else composition

    def _rows(self, scales: Scales, pencil: Deviations) -> Measure[list[TextRow]]:
        """The words at some scales, for columns of any width; those of one width differ by rounding."""
        set_rows = cache(lambda wide: self.words.rows(wide, scales, pencil))
        return lambda wide: set_rows(round(wide, 9))

    def _compose_at(self, scales: Scales, pencil: Deviations, facts: FactRows) -> Composition:
        """The sheet with what its words are at some scales, where they stand beside the plans: composed anew where
        these or the facts need other room."""
        rows_by_width = dict[float, list[TextRow]]()
        rows = self._rows(scales, pencil)

        def beside(wide: float) -> list[TextRow]:
            return rows_by_width.setdefault(wide, rows(wide))

        composition, was_facts, was = self._composed or (None, facts, {})
        if not (composition and composition.arrangement.have_same_room(facts, was_facts)
                and all(need_same_room(was[wide], rows(wide)) for wide in was)):
            composition = best_composition(
                self.plans, self.title, self.paper, beside if self.protocol == BESIDE_PLANS else None, self.lettered,
                facts=facts, worst_error=self.worst_error, earlier=composition)
            self._composed = composition, facts, rows_by_width
        return composition

    def _facts(self, pencil: Deviations) -> FactRows:
        """What is given, and what was found with these drawing errors."""
        drawing = self.plans.drawing
        return FactRows(self.plans.tongue, *drawing_facts(drawing, self.words.values, pencil),
                        tuple(drawing_remarks(drawing, pencil)), tuple(drawing.scene.points))

    def _with_words(self, composition: Composition, rows: Measure[Sequence[TextRow]], facts: FactRows) -> Composition:
        """The composition with its facts and its words, which stand beside the plans or on pages of their own."""
        arrangement = composition.arrangement.with_facts(facts)
        composition = replace(composition, arrangement=arrangement)
        words = rows if self.protocol != "none" else None
        if facts and not arrangement.facts:  # no room for them on the first page
            words = facts if words is None else lambda wide: [*facts(wide), *rows(wide)]
        if arrangement.columns and words:
            return replace(composition, arrangement=replace(arrangement, rows=arrangement.set(words)))
        pages = protocol_pages(arrangement.paper, words, self.frame, self.title) if words else ()
        return replace(composition, protocol=pages)


def with_results_alone(composition: Composition) -> Composition:
    """The composition whose pages of words have no steps, which are told elsewhere."""
    rows = [row for _, placed_rows in composition.protocol for row, _, _ in placed_rows if row.layer == RESULTS]
    pages = ((page, placed_rows) for page, _ in composition.protocol[:1] for placed_rows in paginate(rows, page))
    return replace(composition, protocol=tuple(pages))
