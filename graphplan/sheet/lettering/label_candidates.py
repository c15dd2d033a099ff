"""Where a letter may stand: many boxes in rings around its mark, each with the price of its distance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from graphplan.sheet.lettering.lettering import CAPS, SMALL_SHEET, LetterSizes, Runs, TextRun, depth, inked_depth, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import Pen

TASTE = 0.02  # among equals up and to the right, then on counter-clockwise: what a sixteenth of a turn costs
RINGS = np.array([(0.7, 0.0), (1.6, 0.8), (2.8, 2.0), (4.5, 4.0), (7.0, 7.0), (10.0, 11.0), (14.0, 16.0), (20.0, 24.0)])
FINE_DISTANCES = np.array([0.7, 1.3, 2.0, 2.8, 3.6, 4.8, 6.2, 7.2, 10.5, 13.5, 17.0, 21.0, 26.0])  # mm
FINE_RINGS = np.stack([FINE_DISTANCES, np.interp(FINE_DISTANCES, *RINGS.T)], axis=1)  # for second thoughts
MAX_LEADER_MM, LONG_LEADER = 8.0, 100.0  # a longer one costs more than two faults, but less than letters on others
LED, LEADER = 3.4, 30.0  # mm from which a thin leader ties a letter to its mark; its price where there are other spots
EDGE = 5.0  # the price of standing at the panel's edge, where no ring fits
SMALL_LETTERS, X_HEIGHT = frozenset("acegmnopqrsuvwxyz"), 0.547  # letters without ascenders, and their height
BEARING = 0.08  # of the size: how far inside their advance letters begin
AIR = 0.3  # mm free around a letter
BALLOON = 0.84  # the radius of a circle about a number, beside the size of the number
NUMBER_GAP = 0.3  # mm between a letter and a raised number

Array = np.ndarray[Any, Any]
OUTWARDS = np.array([-1.0, -1.0, 1.0, 1.0])  # each side of a box


class Wish(NamedTuple):
    """A letter that wants a place: near one of its spots, at least `clear` away from it.

    `minor` ones are as large as words, others as letters of marks; `balloon` puts it in a circle, as link numbers are;
    `free` says that it may stand anywhere along a line; `raised` are the numbers of steps that follow it as small
    raised figures.
    """

    runs: Runs
    spots: tuple[Spot, ...]
    clear: float = 0.6
    minor: bool = False
    pen: Pen = pens.LETTERS
    step: int | None = None
    label: str = ""
    bold: bool = False
    balloon: bool = False
    free: bool = False
    raised: str = ""
    layer: str = "letters"
    letters: LetterSizes = SMALL_SHEET

    @property
    def letter_size(self) -> float:
        """The size of the letters, mm."""
        return self.letters.text if self.minor or self.balloon else self.letters.mark

    @property
    def extent(self) -> tuple[float, float]:
        if self.balloon:
            return 2 * BALLOON * self.letter_size, 2 * BALLOON * self.letter_size
        small = self.letters.text
        return self.tail + width(self.figures, small), self.lift + small * CAPS + self.letter_size * self.depth

    @property
    def figures(self) -> Runs:
        return (TextRun(self.raised),) if self.raised else ()

    @property
    def tail(self) -> float:
        """Start of the raised figures, beside the letters."""
        return width(self.runs, self.letter_size, self.bold) + (NUMBER_GAP if self.raised else 0.0)

    @property
    def lift(self) -> float:
        """Height of the figures above the base line: half a capital; without figures, the difference of capitals."""
        return self.letter_size * CAPS / 2 if self.raised else (self.letter_size - self.letters.text) * CAPS

    @property
    def depth(self) -> float:
        """Depth of the letters below the base line, in ems."""
        return depth(self.runs)

    @property
    def slack(self) -> tuple[float, float, float, float]:
        """Distances of the ink from the left, bottom, right and top of its box: small letters end below the top, and
        few letters reach below the base line."""
        if self.balloon:
            return 0.0, 0.0, 0.0, 0.0
        is_small = not self.raised and all(SMALL_LETTERS.issuperset(run.text) for run in self.runs if run.level == 0)
        side, top = BEARING * self.letter_size, (CAPS - X_HEIGHT) * self.letter_size if is_small else 0.0
        return side, self.letter_size * (self.depth - inked_depth(self.runs, self.letter_size)), side, top

    def items(self, place: LabelCandidates) -> Iterator[Item]:
        """The letter at its place."""
        left, low, right, top = map(float, place.boxes)
        x, y = map(float, place.spots)
        middle = (left + right) / 2, (low + top) / 2
        if place.led:
            end_x, end_y = map(float, place.ends)
            yield Polyline(pens.LEADER, self.layer, self.step, ((x, y), (end_x, end_y)))
        if self.balloon:
            yield Circle(pens.BALLOON, self.layer, self.step, middle, BALLOON * self.letter_size)
            base = middle[0], middle[1] - self.letter_size * CAPS / 2
            yield Text(self.pen, self.layer, self.step, base, self.runs, self.letter_size, "middle", label=self.label)
        else:
            x, y = left, low + self.letter_size * self.depth
            yield Text(self.pen, self.layer, self.step, (x, y), self.runs, self.letter_size, bold=self.bold,
                       label=self.label)
            if self.raised:
                at = x + self.tail, y + self.lift
                yield Text(pens.FAINT, self.layer, self.step, at, self.figures, self.letters.text,
                           label=f"step {self.raised}")


@dataclass(frozen=True)
class LabelCandidates:
    """Candidates, letter by letter: boxes, the spots they stand for, what their distance costs, which need a leader.

    Boxes are rows of left, bottom, right, top.
    """

    letters: Array
    boxes: Array
    spots: Array
    cost: Array
    led: Array

    @property
    def cells(self) -> Array:
        """The boxes with the air around them."""
        return self.boxes + AIR * OUTWARDS

    @property
    def ends(self) -> Array:
        """Ends of leaders: on each box the spot that is nearest to its own."""
        return np.clip(self.spots, self.boxes[..., :2], self.boxes[..., 2:])

    @property
    def distances(self) -> Array:
        """Distances of boxes from their spots: the lengths of leaders."""
        return np.asarray(np.hypot(*(self.ends - self.spots).T))

    @property
    def is_far(self) -> Array:
        """Whether the leader to each box is too long for the eye to follow."""
        return np.asarray(self.led & (self.distances > MAX_LEADER_MM))

    def meeting(self, rects: Sequence[Rect]) -> Array:
        """Whether each box shares more than an edge with any of some rectangles."""
        sides = np.array([(rect.left, rect.bottom, rect.right, rect.top) for rect in rects]).reshape(-1, 4)
        shared = (self.boxes[:, None, :2] < sides[:, 2:]) & (self.boxes[:, None, 2:] > sides[:, :2])
        return np.asarray(np.any(np.all(shared, axis=2), axis=1))

    def for_letters(self, letters: Sequence[int]) -> LabelCandidates:
        """Candidates renumbered for a longer list of letters."""
        return LabelCandidates(np.array(letters)[self.letters], *list(vars(self).values())[1:])

    def append(self, more: LabelCandidates) -> LabelCandidates:
        """Concatenate candidates; letters are no longer in order."""
        pairs = zip(vars(self).values(), vars(more).values(), strict=True)
        return LabelCandidates(*map(np.concatenate, pairs))

    def __getitem__(self, chosen: Any) -> LabelCandidates:
        return LabelCandidates(self.letters[chosen], self.boxes[chosen], self.spots[chosen], self.cost[chosen],
                               self.led[chosen])


def candidates(wishes: Sequence[Wish], rect: Rect, rings: Array = RINGS, ways: int = 16) -> LabelCandidates:
    """All the places for letters inside the panel, so many ways: spot by spot, from the nearest ring outwards."""
    counts = [len(wish.spots) for wish in wishes]
    spots = np.array([spot for wish in wishes for spot in wish.spots])
    number = np.concatenate([np.arange(count) for count in counts])
    letter = np.repeat(np.arange(len(wishes)), counts)
    free, clear = np.array([(wish.free, wish.clear) for wish in wishes])[letter].T
    at, ring = np.divmod(np.arange(len(spots) * len(rings)), len(rings))
    half = np.array([wish.extent for wish in wishes])[letter[at]][:, None] / 2
    gaps, costs = rings[ring].T
    turns = np.arange(ways) / ways
    directions = np.stack([np.cos(2 * np.pi * turns), np.sin(2 * np.pi * turns)], axis=1)
    sides = directions / abs(directions).max(axis=1, keepdims=True)  # to the edge of a square
    centres = spots[at][:, None] + (clear[at] + gaps)[:, None, None] * directions + sides * half
    boxes = np.concatenate([centres - half, centres + half], axis=-1)
    led = gaps > LED
    cost = (costs + (0.05 * number[at] + LEADER * led) * free[at])[:, None] + TASTE * ((16 * turns - 2) % 16)
    left, low, right, top = np.moveaxis(boxes, -1, 0)
    inside = ((left - AIR >= rect.left) & (low - AIR >= rect.bottom)
              & (right + AIR <= rect.right) & (top + AIR <= rect.top))
    row, _ = np.nonzero(inside)
    places = LabelCandidates(letter[at][row], boxes[inside], spots[at][row], cost[inside], led[row])
    places.cost[places.is_far] += LONG_LEADER
    return _with_outsiders(places, wishes, rect)


def _with_outsiders(found: LabelCandidates, wishes: Sequence[Wish], rect: Rect) -> LabelCandidates:
    """The places, and for each letter whose mark is at the edge one that is as near as the panel allows."""
    outside = np.flatnonzero(np.bincount(found.letters, minlength=len(wishes)) == 0).tolist()
    if not outside:
        return found
    boxes = [_pushed_in(wishes[letter], rect) for letter in outside]
    spots = [wishes[letter].spots[0] for letter in outside]
    more: tuple[Any, ...] = outside, boxes, spots, np.full(len(outside), EDGE), np.zeros(len(outside), dtype=bool)
    every = LabelCandidates(*(np.concatenate(pair) for pair in zip(vars(found).values(), more, strict=True)))
    return every[every.letters.argsort(kind="stable")]


def _pushed_in(wish: Wish, rect: Rect) -> tuple[float, float, float, float]:
    """The box of a letter as near to its first spot as the panel allows."""
    (wide, high), (x, y) = wish.extent, wish.spots[0]
    left = min(max(x, rect.left), rect.right - wide)
    low = min(max(y, rect.bottom), rect.top - high)
    return left, low, left + wide, low + high
