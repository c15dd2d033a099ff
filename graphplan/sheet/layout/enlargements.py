"""Enlargements: what of a plan is too small to be read is drawn once more, larger; details of friction among it.

A detail shows the journal's centre, its friction circle and the force that touches it, as the last round has it.

A ring with a capital letter shows on the plan of what there is a detail; what lies in the ring has its letters in the
detail alone, but for the mechanism's points, which one looks for on its plan. A detail is the same plan in another
window, so nothing is constructed for it (ISO 128-3: details).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, combinations, filterfalse
from operator import itemgetter
from typing import ClassVar

import numpy as np

from graphplan.kernel.kinds import Sizing
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import said
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.free_room import FreeRoom
from graphplan.sheet.layout.measures import MIN_LINK_MM
from graphplan.sheet.lettering.label_candidates import Array, Wish
from graphplan.sheet.lettering.lettering import CAPS, TIE, Runs, TextRun, name_runs, sentence_runs, width
from graphplan.sheet.lettering.letters import HIDDEN, LED, ON_LINES, LetteredPlate, letter_plate
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import ENLARGED, Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.plate import LAYER, DrawnStep, Plate, Plates, Stroke
from graphplan.sheet.plates.symbols import RADIUS
from graphplan.sheet.plates.view import View, clip_item, clip_segment, interpolate

DETAILS = "details"
ENLARGEMENTS = 2, 5, 10, 20, 50, 100, 200, 500, 1000
LEAST_RADIUS, HIGH, HALF_FORCE = 4.0, 26.0, 9.0  # mm: of an enlarged circle; of a detail; of a force, each way
GAP, PADDING = 1.5, 2.0  # mm between a mark and its letter, and about a caption


def friction_circles(composition: Composition, items: Sequence[Item]) -> Iterator[Item]:
    """The friction circles of a sheet on which these items lie, those without room for their detail left out."""
    touching = {mark.args[0]: mark for mark in composition.plates.steps if mark.step.op.sizing is Sizing.FRICTION}
    rooms = [room_on_page(composition, space, items) for space in (
        composition.arrangement.panels[MECHANISM], composition.arrangement.frame)] if touching else []
    for centre, mark in touching.items():
        radius = math.dist(centre.spot, mark.spot)
        if radius >= RADIUS:
            yield Circle(pens.ARC, DETAILS, None, centre.spot, radius)
        times = next((times for times in ENLARGEMENTS if times * radius >= LEAST_RADIUS), 0)
        if radius < RADIUS and times:
            text = sentence_runs(composition.plans.tongue(said("friction circle at {0}, {1} times as large",
                                                               centre.name, times)), (centre.name,))
            size = composition.arrangement.letters.text
            windows = (room.window(width(text, size) + 2 * PADDING, HIGH, is_first=True) for room in rooms)
            if window := next(filter(None, windows), None):
                rooms = [room.without(window) for room in rooms]
                yield Text(pens.LETTERS, DETAILS, None, (window.left + PADDING, window.bottom + PADDING), text, size)
                yield from _detail(centre, mark, times * radius, window, size)


def _detail(centre: DrawnStep, mark: DrawnStep, radius: float, window: Rect, size: float) -> Iterator[Item]:
    """A friction circle in its window, with the force that touches it."""
    middle = window.centre[0], window.centre[1] + size
    way = math.dist(centre.spot, mark.spot)
    ux, uy = ((end - start) / way for start, end in zip(centre.spot, mark.spot, strict=True))
    (x, y), (u, v) = mark.args[3].spot, mark.args[4].spot
    side = math.copysign(HALF_FORCE, (v - y) * ux - (u - x) * uy)
    touch = middle[0] + radius * ux, middle[1] + radius * uy
    start, end = ((touch[0] - k * side * uy, touch[1] + k * side * ux) for k in (-1, 1))
    yield Circle(pens.NORMAL, DETAILS, None, middle, radius)
    yield Arrow(pens.VECTORS["reaction"], DETAILS, None, start, end, pens.HEADS["reaction"])
    for named, at, aside in ((centre, middle, -1), (mark, touch, 1)):
        yield Circle(pens.DOT, DETAILS, None, at, 0.5)
        yield Text(pens.LETTERS, DETAILS, None, _base_line_start(at, (aside * ux, aside * uy), size),
                   name_runs(named.name), size, "middle")


def _base_line_start(spot: Spot, way: Spot, size: float) -> Spot:
    """Start of the base line of a letter on this side of a mark."""
    return spot[0] + (GAP + size / 2) * way[0], spot[1] + (GAP + size / 2) * way[1] - size / 3


FACTORS = 2, 5, 10, 20, 50  # of enlargement, as ISO 5455 has them
SIDES_MM = 90.0, 75.0, 62.0, 52.0, 44.0  # of A4: a window is looked for up to so large
MIN_RING_MM, RIM_MM = 2.5, 7.0  # the radius of a ring; from it, enlarged, to the sides of its window, for letters
FRAME_MM, CAPTION_MM = 1.0, 3.6  # from a window to its frame, for the ends of wide lines; over it, of A4
SAME_MM, NEAR_MM, CLEAR_MM = 0.05, 1.0, 3.0  # marks nearer are one; cannot be told apart; may have room for letters
PITCH_MM = 6.0  # from mark to mark, on average, at which letters find room
DOUBT_WEIGHTS, MERGED_WEIGHT = {LED: 0.1, ON_LINES: 0.2, HIDDEN: 1.0}, 0.3  # of letters, and of marks too near
SHORT_LINK_WEIGHT = 1.0  # at each end of a link
MIN_GAIN = 1.6  # how many hidden letters a detail must make legible
SURE_GAINS = 2.0  # times that is hidden on a draft, from which on a detail is looked for without asking for room
MAX_DETAILS, MAX_ON_SHEET, MAX_TRIES = 2, 4, 3  # of a plan, of a sheet; rings that are tried for a detail
MAX_LETTERS = 120  # of a plan: among more no detail helps
RING_PLACES = 16  # on a ring, beside which its letter may stand
LETTERS = "ZYXWVUTSRNMLKJHGFEDCBA"  # of details, as no point is called


@dataclass(frozen=True)
class DetailRing:
    """A circle about marks that crowd, in mm of the page, its letter, and how many times its detail enlarges it."""

    centre: Spot
    radius: float
    factor: int = 1
    letter: str = ""

    def side(self, times: float) -> float:
        """The side of the window that its detail needs where letters are so many times as large as on A4."""
        return 2 * (self.radius * self.factor + times * RIM_MM)

    def holds(self, spot: Spot) -> bool:
        """Whether a spot lies within."""
        return math.dist(spot, self.centre) <= self.radius

    def left_outside(self, marks: Array, weights: Array) -> float:
        """Illegible weight of marks outside the ring."""
        return float(weights[[not self.holds(mark) for mark in marks]].sum())

    @property
    def wish(self) -> Wish:
        """The ring's letter, at a distance from others: close to a point's letter it would read as one."""
        turns = (2 * math.pi * k / RING_PLACES for k in range(RING_PLACES))
        (x, y), r = self.centre, self.radius
        spots = tuple((x + r * math.cos(turn), y + r * math.sin(turn)) for turn in turns)
        return Wish((TextRun(f"{TIE}{self.letter}{TIE}"),), spots, 0.0, bold=True, label=f"detail {self.letter}",
                    free=True, layer=ENLARGED)

    def letters_beside(self, wishes: Iterable[Wish], clear: Collection[Spot],
                       lasting: Collection[str]) -> Iterator[Wish]:
        """The letters that stand beside marks outside, or beside one within that is clear, and those that last."""
        for wish in wishes:
            if wish.label in lasting:
                yield wish
            elif spots := tuple(spot for spot in wish.spots
                                if not self.holds(spot) or (spot in clear and not wish.free)):
                yield wish._replace(spots=spots)

    def within(self, wishes: Iterable[Wish]) -> set[tuple[int | None, str]]:
        """The letters that have no place outside, by their steps and what they are called."""
        return {(wish.step, wish.label) for wish in wishes if all(map(self.holds, wish.spots))}


@dataclass(frozen=True)
class DetailPlate(Plate):
    """A part of a plan in a window of its own, of which lines run out; arms of forces stand on the plan alone."""

    whole: ClassVar[bool] = False
    ring: DetailRing

    def is_on_panel(self, mark: DrawnStep) -> bool:
        """Whether a point lies in the ring: in the corners of the window lines alone are drawn."""
        return super().is_on_panel(mark) and self.ring.holds(mark.spot)

    def breaks(self, drawn: DrawnStep) -> Iterator[tuple[Stroke, DrawnStep]]:
        """None: most lines leave the window."""
        yield from ()

    def items(self) -> Iterator[Item]:
        """The strokes, those of vectors as far as they lie in the window; there vectors have no names."""
        rect = self.view.rect
        for item in super().items():
            yield from clipped_arrow(item, rect) if isinstance(item, Arrow) else clip_item(item, rect)


def clipped_arrow(arrow: Arrow, rect: Rect) -> Iterator[Item]:
    """Parts of a vector in a window: with its head if that is inside."""
    if inside := clip_segment(rect, arrow.start, arrow.end):
        start, end = (interpolate(arrow.start, arrow.end, t) for t in inside)
        if rect.holds(arrow.end):
            yield replace(arrow, start=start, label="")
        else:
            yield Polyline(arrow.pen.with_fill("none"), arrow.layer, arrow.step, (start, end))


@dataclass(frozen=True)
class Detail:
    """A detail of a plan: its ring, its window with the caption, the plan as it shows it, and the number of the first
    step that draws in it."""

    ring: DetailRing
    window: Rect
    picture: LetteredPlate
    first: int | None

    def items(self, size: float, caption: Runs) -> Iterator[Item]:
        """Items of the detail: its frame, its caption in letters of a size, and its picture."""
        rect = self.picture.plate.view.rect
        frame = rect.inset(-FRAME_MM, -FRAME_MM, -FRAME_MM, -FRAME_MM)
        spot = frame.left + size / 2, frame.top + (self.window.top - frame.top - CAPS * size) / 2
        yield Polygon(pens.RING, ENLARGED, self.first, frame.corners)
        yield Text(pens.LETTERS, ENLARGED, self.first, spot, caption, size, bold=True)
        yield from (replace(item, layer=ENLARGED) for item in self.picture.items_off_letters)


@dataclass(frozen=True)
class EnlargedPlan:
    """A plan with its letters, of which those in rings stand in details."""

    plain: LetteredPlate
    details: tuple[Detail, ...] = ()

    @cached_property
    def picture(self) -> LetteredPlate:
        """The plan with its rings."""
        if not self.details:
            return self.plain
        wishes, rings = iter(self.plain.letters.wishes), [detail.ring for detail in self.details]
        marks, weights = illegible(self.plain.in_haste)
        clear = {(x, y) for x, y in marks[weights == 0].tolist()}
        plate = self.plain.plate
        lasting = plate.plates.scene.points if plate.panel == MECHANISM else ()
        for ring in rings:
            wishes = ring.letters_beside(wishes, clear, lasting)
        circles = [Circle(pens.RING, ENLARGED, detail.first, detail.ring.centre, detail.ring.radius)
                   for detail in self.details]
        taken = [*self.plain.letters.taken, *(detail.window for detail in self.details)]
        return self.plain.with_letters([*wishes, *(ring.wish for ring in rings)], circles).keep_off(taken)

    def keep_off(self, windows: Sequence[Rect]) -> LetteredPlate:
        """The plan with its rings, its letters off the windows of details of other plans as well."""
        taken = self.picture.letters.taken
        others = [window for window in windows if window not in taken and window.meets(self.plain.plate.view.rect)]
        return self.picture.keep_off([*taken, *others]) if others else self.picture

    @property
    def draft(self) -> LetteredPlate:
        """The plan as details are looked for on it: until it has one letters make no room for others, as most of those
        that crowd go into it."""
        return self.picture if self.details else self.plain.in_haste

    @cached_property
    def crowd(self) -> tuple[Array, Array]:
        """The marks outside the rings, and how much is illegible at each: of the draft, where that is much."""
        crowd = self._outside(self.draft)
        return crowd if crowd[1].sum() >= SURE_GAINS * MIN_GAIN else self._outside(self.picture)

    def _outside(self, picture: LetteredPlate) -> tuple[Array, Array]:
        """The marks outside the rings, and how much is illegible at each in a picture of the plan."""
        marks, weights = illegible(picture)
        outside = [not any(detail.ring.holds(mark) for detail in self.details) for mark in marks]
        return marks[outside], weights[outside]

    @property
    def is_crowded(self) -> bool:
        """Whether so much is illegible that a further detail may help."""
        return bool(self.crowd[1].sum() >= MIN_GAIN and len(self.details) < MAX_DETAILS
                    and len(self.plain.letters.wishes) <= MAX_LETTERS)

    @property
    def illegible(self) -> float:
        """Illegible weight on the plan and in its details."""
        return float(self.crowd[1].sum() + sum(illegible(detail.picture)[1].sum() for detail in self.details))

    def left_of(self, marks: Array, weights: Array) -> float:
        """Estimate of the illegible weight that the last detail leaves, without a new placing of letters."""
        detail = self.details[-1]
        return detail.ring.left_outside(marks, weights) + float(illegible(detail.picture)[1].sum())

    def with_detail(self, ring: DetailRing, window: Rect) -> EnlargedPlan:
        """The plan with a further detail in its window."""
        plate = self.plain.plate
        rect = Rect(window.left, window.bottom, window.right, window.bottom + window.width)
        rect = rect.inset(FRAME_MM, FRAME_MM, FRAME_MM, FRAME_MM)
        (x, y), (u, v), (w, z), factor = plate.view.origin, ring.centre, rect.centre, ring.factor
        view = View(rect, factor * plate.view.scale, (w + factor * (x - u), z + factor * (y - v)))
        plates = Plates(plate.plans, {**plate.plates.views, plate.panel: view}, plate.plates.letters)
        enlarged, within = DetailRing(rect.centre, factor * ring.radius), ring.within(self.plain.letters.wishes)
        picture = letter_plate(DetailPlate(plates, plate.panel, enlarged), lambda wishes: (
            wish for wish in wishes
            if (wish.step, wish.label) in within or (not wish.free and enlarged.holds(wish.spots[0]))))
        marks = (mark.index for mark in plate.steps if plate.is_on_panel(mark) and ring.holds(mark.spot))
        return replace(self, details=(*self.details, Detail(ring, window, picture, min(marks, default=None))))


def breaks_off(item: Item) -> bool:
    """Whether an item is a thin straight line or arc, which breaks off at letters."""
    return item.layer == LAYER and isinstance(item, Polyline | Arc)


def enlarge_crowds(composition: Composition, others: Sequence[Item]) -> tuple[list[Item], list[Item]]:
    """Items of the plans, with rings about crowds, and the enlarged details of these, if the page has room.

    `others` are items that stand on the page beside what is drawn on the plans.
    """
    names = {mark.name for mark in composition.plates.steps} | set(composition.plates.scene.points)
    letters = iter([letter for letter in LETTERS if letter not in names][:MAX_ON_SHEET])
    size, tongue = composition.arrangement.letters.text, composition.plans.tongue
    plans = {panel: EnlargedPlan(picture) for panel, picture in composition.pictures.items()}
    details, waiting = list[Item](), [*plans]
    while waiting and (letter := next(letters, "")):
        panel = max(waiting, key=lambda panel: plans[panel].crowd[1].sum())
        plan = None
        if plans[panel].is_crowded:
            drawn = [*others, *details, *(item for plan in plans.values() for item in plan.draft.items)]
            plan = _enlarge(composition, plans[panel], letter, drawn)
        if plan:
            plans[panel], ring = plan, plan.details[-1].ring
            caption = tongue(said("Detail {0}, {1} : 1", letter, ring.factor))
            details += plan.details[-1].items(size, sentence_runs(caption, (letter,)))
        else:
            letters = chain([letter], letters)
            waiting.remove(panel)
    windows = [detail.window for plan in plans.values() for detail in plan.details]
    return [item for plan in plans.values() for item in plan.keep_off(windows).items_off_letters], details


def _enlarge(composition: Composition, plan: EnlargedPlan, letter: str, drawn: Sequence[Item]) -> EnlargedPlan | None:
    """The plan with a detail of its worst crowd; None if no detail makes enough of it legible, or the page has no
    room."""
    (marks, weights), times = plan.crowd, composition.arrangement.letters.times
    middle, tried = tuple(np.average(marks, axis=0, weights=weights)), set[DetailRing]()
    for space in (composition.arrangement.panels[plan.plain.plate.panel], composition.arrangement.frame):
        room = room_on_page(composition, space, drawn)
        sides = (times * side for side in SIDES_MM)
        side = next((side for side in sides if _window(room, side, times, middle)), None)
        rings = [ring for ring in best_rings(marks, weights, side, times) if ring not in tried] if side else []
        tried.update(rings)
        windows = [_window(room, ring.side(times), times, ring.centre) for ring in rings]
        pairs = zip(rings, windows, strict=True)
        best = _best_detail(plan, {replace(ring, letter=letter): window for ring, window in pairs if window}, marks,
                            weights)
        if best and best.illegible <= plan.illegible - MIN_GAIN:
            return best
    return None


def _best_detail(plan: EnlargedPlan, windows: Mapping[DetailRing, Rect], marks: Array, weights: Array
                 ) -> EnlargedPlan | None:
    """The plan with the detail that leaves least illegible, of equals the first; those that leave more outside their
    rings than others in all are not drawn."""
    best: tuple[float, int, EnlargedPlan | None] = math.inf, 0, None
    outside = {ring: ring.left_outside(marks, weights) for ring in windows}
    for place, ring in sorted(enumerate(windows), key=lambda pair: outside[pair[1]]):
        if outside[ring] <= best[0]:
            larger = plan.with_detail(ring, windows[ring])
            best = min(best, (larger.left_of(marks, weights), place, larger), key=itemgetter(0, 1))
    return best[2]


def illegible(picture: LetteredPlate) -> tuple[Array, Array]:
    """The marks of a plan, and how much is illegible at each: its letter, that it is apart from another, or that a link
    ends there that its pins cover."""
    marks = np.array(picture.marks, dtype=float).reshape(-1, 2)
    apart = _distances(marks)
    weights = np.array(MERGED_WEIGHT * ((apart > SAME_MM) & (apart < NEAR_MM)).any(axis=1))
    for spot, doubt in picture.letters.doubts([*filterfalse(breaks_off, picture.strokes)]) if len(marks) else ():
        weights[np.hypot(*(marks - spot).T).argmin()] += DOUBT_WEIGHTS[doubt]
    for spot in _ends_of_short_links(picture.plate):
        weights[np.hypot(*(marks - spot).T).argmin()] += SHORT_LINK_WEIGHT
    return marks, weights


def _ends_of_short_links(plate: Plate) -> set[Spot]:
    """Ends of links on a plan that are so short that their pins cover them."""
    if plate.panel != MECHANISM:
        return set()
    scene, places = plate.plates.scene, plate.drawn_mechanism.visible_points
    pairs = (pair for link in scene.moving for pair in combinations(scene.links[link], 2) if places.keys() >= {*pair})
    return {places[name] for p, q in pairs if SAME_MM < math.dist(places[p], places[q]) < MIN_LINK_MM
            for name in (p, q)}


def _distances(marks: Array) -> Array:
    """Distances between all pairs of marks."""
    return np.asarray(np.hypot(*(marks[:, None] - marks).transpose(2, 0, 1)))


def best_rings(marks: Array, weights: Array, side: float, times: float) -> list[DetailRing]:
    """The rings that may make most legible of what is not, the best first, in windows no larger than so where all marks
    have room."""
    apart = _distances(marks)
    nearest = np.where(apart > SAME_MM, apart, np.inf).min(axis=1)
    rings = dict[DetailRing, float]()
    for factor in FACTORS:
        radius = (side / 2 - times * RIM_MM) / factor - NEAR_MM
        gains = (apart <= radius) @ (weights * np.minimum(1.0, nearest * factor / (times * CLEAR_MM)))
        if gains.max() >= MIN_GAIN:
            ring = _ring_about(marks[(apart[gains.argmax()] <= radius) & (weights > 0)])
            fitting = [factor for factor in FACTORS if ring.radius * factor + times * RIM_MM <= side / 2]
            count = sum(ring.holds(mark) for mark in marks)
            if fitting and count * (times * PITCH_MM) ** 2 <= (2 * ring.radius * fitting[-1]) ** 2:
                rings.setdefault(replace(ring, factor=fitting[-1]), float(gains.max()))
    return sorted(rings, key=lambda ring: -rings[ring])[:MAX_TRIES]


def _ring_about(members: Array) -> DetailRing:
    """The ring about some marks."""
    x, y = (members.min(axis=0) + members.max(axis=0)) / 2
    reach = np.hypot(*(members - (x, y)).T).max() + NEAR_MM
    return DetailRing((float(x), float(y)), max(MIN_RING_MM, float(reach)))


def _window(room: FreeRoom, side: float, times: float, spot: Spot) -> Rect | None:
    """Room for a window, its frame and its caption, as near to a spot as there is."""
    return room.nearest(side + 2 * FRAME_MM, side + 2 * FRAME_MM + times * CAPTION_MM, spot)


def room_on_page(composition: Composition, space: Rect, drawn: Iterable[Item]) -> FreeRoom:
    """A part of the page on which the plans, their panels, facts and words stand."""
    arrangement = composition.arrangement
    facts = (column for place in arrangement.facts for column in place.columns)
    edges = (Polyline(pens.BORDER, "paper", None, (*panel.corners, panel.corners[0]))
             for panel in arrangement.panels.values())
    blocks = (Polygon(pens.BORDER, "paper", None, rect.corners)
              for rect in (*arrangement.columns, arrangement.title, *facts))
    return FreeRoom(space, [*drawn, *edges, *blocks])
