"""Letters of marks: which mark bears which, and in which order they are placed.

Each letter may stand in any of many places around its mark. A place costs what it covers: strokes by length and width,
other marks, distance from its own mark. Letters take their cheapest places one by one, the most constrained first;
those that cannot be read get many more places, and second thoughts. All of it is deterministic.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.kernel.kinds import CIRCLE
from graphplan.kernel.program import Panel, Program
from graphplan.methods.panels import MECHANISM, LeverPlan
from graphplan.phrases import said
from graphplan.sheet.lettering.label_candidates import FINE_RINGS, OUTWARDS, Array, LabelCandidates, Wish, candidates
from graphplan.sheet.lettering.lettering import SMALL_SHEET, LetterSizes, list_runs, name_runs, sentence_runs
from graphplan.sheet.lettering.prices import CLASH, FAULT, Lines, Marks, Prices, Surfaces, overlap, touches
from graphplan.sheet.lettering.relabelling import Relabelling
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import ENLARGED, Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.lever_arms import LAYER as ARMS
from graphplan.sheet.plates.lever_arms import LeverArm, lever_arms
from graphplan.sheet.plates.plans import bounding_box, corner
from graphplan.sheet.plates.plate import DrawnStep, Plate, Plates, Stroke
from graphplan.sheet.plates.symbols import RADIUS
from graphplan.sheet.plates.traced_motion import LAYER as MOTION
from graphplan.sheet.plates.view import LetterGaps, interpolate

FINE_DIRECTIONS = 24  # from a mark to the places for second thoughts
LED, ON_LINES, HIDDEN = "led", "lines", "hidden"
POOR_PRICE = 2.0  # the price of what a letter covers, from which on it can hardly be read


def place_letters(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
                  letters: LetterSizes = SMALL_SHEET) -> list[Item]:
    """Place letters; those far from their marks get leaders."""
    return lettering(wishes, items, marks, rect, letters).items


@dataclass(frozen=True)
class PlacedLetters:
    """Letters in places that were found quickly, how many of them stand badly there, and where they stand in the end:
    off what is `taken` by others."""

    wishes: Sequence[Wish] = ()
    rect: Rect | None = None
    prices: Any = None
    choice: Any = ()
    taken: tuple[Rect, ...] = ()
    in_haste: bool = False  # whether second thoughts leave other letters where they are

    @property
    def poor(self) -> int:
        """Number of letters without a good place: hardly legible, or with a leader."""
        if not self.wishes:
            return 0
        return int((self.prices.found.led[self.choice] | (self.prices.faults(self.choice) > POOR_PRICE)).sum())

    @property
    def first_items(self) -> list[Item]:
        """The letters in the places that were found quickly."""
        if self.prices is None or self.choice is None:
            return []
        return [item for wish, place in zip(self.wishes, self.choice, strict=True)
                for item in wish.items(self.prices.found[place])]

    @property
    def items(self) -> list[Item]:
        """The letters in their last places."""
        return [item for wish, place in self.places for item in wish.items(place)]

    @cached_property
    def places(self) -> list[tuple[Wish, LabelCandidates]]:
        """The last place of each letter; where it is nearer to another mark a leader tells whose it is."""
        if not self.wishes:
            return []
        prices = self._relabelling.prices
        places = prices.found[self._relabelling.choice]
        ink = places.boxes - OUTWARDS * [wish.slack for wish in self.wishes]
        places = replace(places, led=places.led | prices.marks.mistaken(replace(places, boxes=ink)))
        return [(wish, places[letter]) for letter, wish in enumerate(self.wishes)]

    @property
    def hidden(self) -> int:
        """Number of letters that are hardly legible in their final places."""
        return len(self._hidden)

    @cached_property
    def _hidden(self) -> list[int]:
        """Indices of the letters that are hardly legible in their final places."""
        return self._relabelling.faulty if self.wishes else []

    @property
    def hidden_items(self) -> list[Item]:
        """Items of the hardly legible letters in their final places."""
        return [item for letter in self._hidden for item in self.places[letter][0].items(self.places[letter][1])]

    def doubts(self, fixed: Sequence[Item]) -> Iterator[tuple[Spot, str]]:
        """Yield the doubtful letters, by the spots of their marks: those that are `led`, that stand on `lines`, or
        `hidden`; lines that are not `fixed` break off at letters."""
        if not self.wishes:
            return
        prices, choice = self._relabelling.prices, self._relabelling.choice
        hidden, led = self._hidden, prices.found.led[choice]
        faults = np.zeros(len(hidden))
        for part in (Lines(fixed), prices.marks, prices.surfaces) if hidden else ():
            faults += part.price(prices.found[choice[hidden]])
        kinds = {letter: HIDDEN if fault >= FAULT else ON_LINES for letter, fault in zip(hidden, faults, strict=True)}
        for letter in range(len(self.wishes)):
            if kind := kinds.get(letter, LED if led[letter] else ""):
                x, y = prices.found.spots[choice[letter]].tolist()
                yield (x, y), kind

    @cached_property
    def _relabelling(self) -> Relabelling:
        """The letters in their last places, after illegible and far ones were placed again."""
        settled = Relabelling(self.prices.away_from(self.taken), self.choice)
        if self.rect and (misplaced := sorted(settled.misplaced_letters)):
            more = candidates([self.wishes[letter] for letter in misplaced], self.rect, FINE_RINGS,
                              FINE_DIRECTIONS).for_letters(misplaced)
            prices, new_index = settled.prices.with_more_places(more[~more.meeting(self.taken)])
            settled = Relabelling(prices, new_index[self.choice])
            settled.relabel(makes_room=not self.in_haste)
        return settled


def lettering(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
              letters: LetterSizes = SMALL_SHEET) -> PlacedLetters:
    """Place letters, and judge how well they stand."""
    if not wishes:
        return PlacedLetters()
    wishes = [wish._replace(letters=letters) for wish in wishes]
    prices = Prices(candidates(wishes, rect), Lines(items), Marks(marks), Surfaces(items))
    return PlacedLetters(wishes, rect, prices, _choose_places(prices, len(wishes)))


def _choose_places(prices: Prices, count: int) -> Array:
    """One place for every letter: greedily, the fewest good places first."""
    spans = prices.spans(count)
    choices, least = prices.choices(np.array([span.start for span in spans]))
    choice = np.full(count, -1)
    taken = np.full((count, 4), np.nan)  # the boxes of the letters that stand; nothing meets nan
    for letter in np.lexsort((-least, choices)):
        choice[letter] = _free_place(prices, spans[letter], taken)
        taken[letter] = prices.found.boxes[choice[letter]]
    return choice


def _free_place(prices: Prices, letter: slice, taken: Array) -> int:
    """The cheapest place of a letter clear of the letters placed before; the cheapest of all, if it meets no letter."""
    boxes, best = prices.found.boxes, prices.cheapest(letter)
    if not touches(boxes[best], taken):
        return best
    return prices.cheapest(letter, CLASH * overlap(boxes[letter], taken))


ALONG = 0.97, 0.03, 0.9, 0.1, 0.8, 0.2, 0.65, 0.35, 0.5  # where along a line its letter may stand
MIDDLE, NEAR_HEAD = (0.5, 0.4, 0.6, 0.3, 0.7), (0.7, 0.65, 0.75, 0.6, 0.8)  # the same along a vector
SAME_PLACE_MM = 0.25
SAME_BREAK = 1.0  # mm: where strokes break off nearer to each other on the way to one mark it is named once
NUMBER_FRACTIONS = 0.5, 0.4, 0.6, 0.3, 0.7  # the same of the number of a line that ends at its marks
PATH_PLACES = 24  # along a path, where its letters may stand
ARC_FRACTIONS = 1.0, 0.0, 0.85, 0.15, 0.7, 0.3, 0.5  # the same along an arc
ARM_LETTERS = pens.Pen(0.0, pens.GREEN, fill=pens.GREEN)

Span = tuple[Spot, Spot]


def plate_items(plate: Plate) -> list[Item]:
    """The items of a plan, with the mechanism if it is its plan, and the letters that avoid them; in no order."""
    return letter_plate(plate).items


def letter_plates(plates: Plates, taken: Sequence[Rect] = ()) -> dict[Panel, LetteredPlate]:
    """The plans with their letters, which keep off what is `taken`; those of the same windows are drawn once."""
    windows, lettered = (*plates.views.values(), plates.letters, *taken), plates.plans.drawn
    if windows not in lettered:
        lettered[windows] = {panel: picture.keep_off(taken) for panel, picture in letter_plates(plates).items()} \
            if taken else {plate.panel: letter_plate(plate) for plate in plates}
    plans: dict[Panel, LetteredPlate] = lettered[windows]
    return plans


@dataclass(frozen=True)
class LetteredPlate:
    """A plan and its letters."""

    plate: Plate
    strokes: list[Item]
    letters: PlacedLetters

    @cached_property
    def items(self) -> list[Item]:
        """Everything that is drawn, in no order."""
        letters = self.letters.items
        return [*self.strokes, *letters, *self.plate.positions(letters), *self.plate.machine(letters)]

    @property
    def items_off_letters(self) -> list[Item]:
        """Items of the plan, with lines and vectors broken off at letters without a place beside them."""
        return [*lines_off_letters(self.items, self.plate.view.rect, self.letters)]

    @property
    def first_items(self) -> list[Item]:
        """Items of the plan without tints, with the letters in their first places."""
        letters = self.letters.first_items
        machine = (item for item in self.plate.machine(letters) if isinstance(item, Polyline))
        return [*self.strokes, *letters, *self.plate.positions(letters), *machine]

    @property
    def marks(self) -> list[Spot]:
        """The marks and the points of the mechanism that the plan shows."""
        return marks_on(self.plate)

    def with_letters(self, wishes: Iterable[Wish], more: Sequence[Item] = ()) -> LetteredPlate:
        """The plan with these letters, and with more items."""
        strokes = [*self.strokes, *more]
        return replace(self, strokes=strokes, letters=lettering([*wishes], strokes, self.marks, self.plate.view.rect,
                                                                self.plate.plates.letters))

    @cached_property
    def in_haste(self) -> LetteredPlate:
        """The plan with its letters as they stand after a first look at those that cannot be read."""
        return replace(self, letters=replace(self.letters, in_haste=True))

    def keep_off(self, taken: Sequence[Rect]) -> LetteredPlate:
        """The plan with letters that keep off some rectangles."""
        rects = tuple(rect for rect in taken if rect.meets(self.plate.view.rect))
        return replace(self, letters=replace(self.letters, taken=rects)) if rects else self


def letter_plate(plate: Plate, choose: Callable[[Iterable[Wish]], Iterable[Wish]] = iter) -> LetteredPlate:
    """A plan with those of its letters that are chosen, and how well they stand."""
    items, wishes = [*plate.items(), *plate.mechanism], wishes_on(plate)
    for arm in _arms(plate):
        items += arm.items
        wishes.append(Wish(name_runs(arm.letter), tuple(interpolate(*arm.ends, t) for t in MIDDLE), pen=ARM_LETTERS,
                           free=True, layer=ARMS))
    return LetteredPlate(plate, items, PlacedLetters()).with_letters(choose(wishes_inside(wishes, plate.view.rect)))


def marks_on(plate: Plate) -> list[Spot]:
    """The marks and the points of the mechanism that a plan shows."""
    marks = [mark.spot for mark in plate.steps if plate.is_on_panel(mark)]
    if plate.panel == MECHANISM:
        marks += list(plate.drawn_mechanism.visible_points.values())
    return marks


def wishes_on(plate: Plate) -> list[Wish]:
    """The letters of a plan, on its panel or beyond."""
    wishes = list(PlateLetters(plate).wishes())
    if plate.panel != MECHANISM:
        return wishes
    return [*mechanism_wishes(plate.drawn_mechanism), *wishes, *_path_letters(plate)]


def wishes_inside(wishes: Iterable[Wish], rect: Rect) -> Iterator[Wish]:
    """The letters whose marks are on the panel."""
    for wish in wishes:
        if spots := tuple(filter(rect.holds, wish.spots)):
            yield wish if spots == wish.spots else wish._replace(spots=spots)


def mechanism_wishes(mechanism: DrawnMechanism) -> Iterator[Wish]:
    """The letters of the joints, then the numbers of the links."""
    for spot, (runs, label) in mechanism.letters().items():
        yield Wish(runs, (spot,), RADIUS + 0.3, label=label)
    yield from mechanism.wishes()


def _arms(plate: Plate) -> Iterator[LeverArm]:
    """The arms of the forces on a lever."""
    if plate.whole and isinstance(plate.panel, LeverPlan) and plate.beginnings:
        forces = [vector for vector in plate.vectors if vector.kind in pens.FORCES]
        yield from lever_arms(plate.beginnings[0].spot, forces, plate.view.rect)


def _path_letters(plate: Plate) -> Iterator[Wish]:
    """The names of paths and centrodes, anywhere along the curve."""
    motion = plate.plans.motion
    if not motion:
        return
    curves = [(said("path of {0}", path.point), path.point, path.spots, f"path {path.point}") for path in motion.paths]
    curves += [(centrode.words, "", sum(centrode.branches, ()),
                f"{'moving' if centrode.moving else 'fixed'} centrode {centrode.links}")
               for centrode in motion.centrodes if centrode.branches]
    for words, name, spots, label in curves:
        candidate_spots = tuple(map(plate.view, spots[:: len(spots) // PATH_PLACES + 1]))
        runs = sentence_runs(plate.plans.tongue(words), (name,))
        yield Wish(runs, candidate_spots, 0.6, True, pens.FAINT, label=label, free=True, layer=MOTION)


def items_with_names(plate: Plate, others: Sequence[Item] = (), wishes: Iterable[Wish] = (),
                     is_named: Callable[[DrawnStep], bool] = lambda mark: True) -> list[Item]:
    """The ink of a plan and what else is drawn there, with the names of its marks, which avoid both and each other.

    Other letters may be wished for; of the marks those have letters that are to be named. Letters may stand on tints.
    """
    ink, rect = [*plate.items(), *others], plate.view.rect
    texts = [Polygon(item.pen, item.layer, None, item.box.corners) for item in others if isinstance(item, Text)]
    marks = [mark for mark in plate.steps if plate.is_on_panel(mark)]
    names = [Wish(name_runs(mark.name), (mark.spot,), plate.dot_radius(mark) + 0.3, step=mark.index, label=mark.name)
             for mark in marks if mark.name and is_named(mark)]
    names += [wish for mark in plate.steps if mark.name and mark.index in plate.stretches and is_named(mark)
              for wish in PlateLetters(plate).line_letters(mark, plate.stretches[mark.index])]
    obstacles = [item for item in ink if item.layer != "paper"]
    letters = lettering([*names, *wishes], [*obstacles, *texts], [mark.spot for mark in marks], rect,
                        plate.plates.letters)
    return [*lines_off_letters(ink, rect, letters), *letters.items]


def lines_off_letters(items: Iterable[Item], rect: Rect, letters: PlacedLetters) -> Iterator[Item]:
    """The items of a plan; its lines, vectors and rings break off at letters that find no place beside them."""
    hidden = letters.hidden_items
    gaps = LetterGaps(hidden, rect)
    for item in items:
        is_line = isinstance(item, Polyline | Arc | Arrow) or (isinstance(item, Circle) and item.layer == ENLARGED)
        if hidden and item.layer != "paper" and is_line:
            yield from gaps.clip(item)
        else:
            yield item


@dataclass(frozen=True)
class PlateLetters:
    """The letters and numbers of one plan."""

    plate: Plate

    @property
    def program(self) -> Program:
        return self.plate.plans.drawing.drawn

    def wishes(self) -> Iterator[Wish]:
        """The letters of the plan: marks, loci, vectors, and the numbers of marks that are spoken of by them."""
        yield from self._point_letters()
        told = list[tuple[int, Spot]]()
        for mark in self.plate.steps:
            if mark.index in self.plate.stretches:
                yield from self.line_letters(mark, self.plate.stretches[mark.index])
            elif mark.kind == CIRCLE and self.plate.numbers(mark):
                yield from self._arc_number(mark)
            yield from self._break_words(mark, told)
        spans = self._spans()
        answers = _coinciding_spots([(end, start) for start, end in spans], [*spans])
        for vectors, row in zip(spans.values(), answers, strict=True):
            yield from self._vector_letter(vectors, bool(row.any()))

    def _point_letters(self) -> Iterator[Wish]:
        """The letters, and apart from them the numbers, of each place: marks that coincide stand together."""
        for spot, marks in self._places().items():
            clear = RADIUS + 0.4 if self.plate.panel == MECHANISM and self._at_joint(spot) else 0.6
            lettered = [mark for mark in marks if mark.name and not self._of_pose(mark)]
            if lettered:
                names, bold = [mark.name for mark in lettered], all(corner(mark.step) for mark in lettered)
                yield Wish(list_runs(names), (lettered[0].spot,), clear, step=lettered[0].index,
                           label=",".join(names), bold=bold, raised=self._raised_numbers(*lettered))
            numbered = [mark for mark in marks if mark not in lettered]
            if numbered:
                numbers = _numbers(*numbered)
                yield Wish(sentence_runs(numbers), (numbered[0].spot,), clear, True, pens.FAINT, numbered[0].index,
                           f"point {numbers}")

    def _raised_numbers(self, *marks: DrawnStep) -> str:
        """The numbers that letters bear, where they do."""
        return _numbers(*filter(self.plate.numbers, marks))

    def _places(self) -> dict[Spot, list[DrawnStep]]:
        """The marks that need a letter or number, by where they lie; the mechanism letters its own, which bear numbers
        where they are constructed."""
        marks = [mark for mark in self.plate.steps if (not self._of_pose(mark) or (
            mark.number and self.plate.numbers(mark))) and self.plate.is_on_panel(mark) and self.is_mentioned(mark)]
        spots = [mark.spot for mark in marks]
        places: dict[Spot, list[DrawnStep]] = {}
        for mark, first in zip(marks, _first_near(spots), strict=True):
            places.setdefault(spots[first], []).append(mark)
        return places

    def _of_pose(self, mark: DrawnStep) -> bool:
        """Whether a mark is a point of the scene, which the mechanism letters."""
        return mark.name in self.plate.plans.drawing.scene.points

    def _at_joint(self, spot: Spot) -> bool:
        return any(math.dist(point.spot, spot) < 1.0 for point in self.plate.plates.pose.values())

    def is_mentioned(self, drawn: DrawnStep) -> bool:
        """Whether a mark has a letter, or is spoken of by its number in a later step, or bears it in any case."""
        return bool(drawn.name) or self.plate.numbers(drawn) or drawn.index in self.plate.plans.read_by_number

    def line_letters(self, line: DrawnStep, stretch: Stroke) -> Iterator[Wish]:
        """A locus' letter or a line's number, near an end."""
        spots = tuple(interpolate(*stretch.ends, t) for t in self._label_fractions(line, stretch))
        if line.name:
            yield Wish(name_runs(line.name), spots, 0.5, step=line.index, label=line.name, free=True,
                       raised=self._raised_numbers(line))
        elif self.is_mentioned(line):
            number = _numbers(line)
            yield Wish(sentence_runs(number), spots, 0.5, True, pens.FAINT, line.index, f"line {number}", free=True)

    def _break_words(self, drawn: DrawnStep, told: list[tuple[int, Spot]]) -> Iterator[Wish]:
        """To which marks that goes which breaks off, but for what is `told` of a stroke along the same line."""
        for arrow, mark in self.plate.breaks(drawn):
            near = interpolate(*arrow.ends, 0.5)
            if all(index != mark.index or math.dist(near, spot) >= SAME_BREAK for index, spot in told):
                told.append((mark.index, near))
                name = self.program.text(mark.index)
                runs = sentence_runs(self.plate.plans.tongue(said("to {0}", name)), (name,))
                yield Wish(runs, (near,), 0.6, True, pens.FAINT, drawn.index, f"to {name} {drawn.index}")

    def _label_fractions(self, line: DrawnStep, stretch: Stroke) -> Sequence[float]:
        """Places along a line for its letter, as fractions; numbers stand at its ends, the outer end of the figure
        first."""
        if not self.plate.numbers(line):
            return ALONG
        if self.plate.directs(line):
            return NUMBER_FRACTIONS
        start, end = stretch.ends
        out = math.dist(end, self._middle) >= math.dist(start, self._middle)
        return (1.0, 0.0, *ALONG) if out else (0.0, 1.0, *(1.0 - t for t in ALONG))

    @property
    def _middle(self) -> Spot:
        """The middle of the plan's marks."""
        return bounding_box([mark.spot for mark in self.plate.steps if self.plate.is_on_panel(mark)]).centre

    def _arc_number(self, circle: DrawnStep) -> Iterator[Wish]:
        """An arc's number, near an end of it."""
        arcs = [arc.item for arc in self.plate.arcs(circle)]
        spots = [arc.spot_at(arc.start + (arc.end - arc.start) * t) for t in ARC_FRACTIONS for arc in arcs]
        if inside := tuple(filter(self.plate.view.rect.holds, spots)):
            number = _numbers(circle)
            yield Wish(sentence_runs(number), inside, 0.5, True, pens.FAINT, circle.index, f"arc {number}", free=True)

    def _spans(self) -> dict[Span, list[Stroke]]:
        """The vectors by where they begin and end: some lie on each other."""
        ends = [vector.ends for vector in self.plate.vectors]
        spans: dict[Span, list[Stroke]] = {}
        for vector, first in zip(self.plate.vectors, _first_near(ends), strict=True):
            spans.setdefault(ends[first], []).append(vector)
        return spans

    def _vector_letter(self, vectors: list[Stroke], answered: bool) -> Iterator[Wish]:
        """The own letters of vectors that lie on each other, at their middle, unless their end bears them.

        Where others run the opposite way the letters stand nearer to their heads.
        """
        names = tuple(dict.fromkeys(v.letter for v in vectors if v.letter))
        if names:
            first = next(v for v in vectors if v.letter)
            spots = tuple(interpolate(*first.ends, t) for t in (NEAR_HEAD if answered else MIDDLE))
            yield Wish(list_runs(names), spots, 0.7, pen=replace(first.pen, width=0.0), step=first.of.index,
                       label=" ".join(names), free=True)


def _numbers(*marks: DrawnStep) -> str:
    return ", ".join(str(mark.number) for mark in marks)


def _first_near(spots: Sequence[Any]) -> list[int]:
    """Index of the first spot, or span, with which each coincides on paper."""
    firsts, places = list[int](), list[int]()
    for k, row in enumerate(_coinciding_spots(spots, spots)):
        hits = np.flatnonzero(row[firsts])
        if not len(hits):
            firsts.append(k)
        places.append(firsts[hits[0]] if len(hits) else k)
    return places


def _coinciding_spots(some: Sequence[Any], others: Sequence[Any]) -> Array:
    """Whether each of some spots, or spans (rows), coincides on paper with each of others (columns)."""
    rows, columns = (np.array(spots, dtype=float).reshape(len(spots), -1 if spots else 1, 2)
                     for spots in (some, others))
    apart = rows[:, None] - columns
    return np.asarray((np.hypot(apart[..., 0], apart[..., 1]) < SAME_PLACE_MM).all(axis=2))
