"""Where the letters of a drawing stand from their marks: programs, and tidy hands, set all of them alike, so that where
marks lie close together each letter's own is told by that."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from statistics import median

from graphplan.kernel.kinds import POINT
from graphplan.marking.judge import measures
from graphplan.marking.traces import Lettering, Trace

Wish = Mapping[int, float]  # what letters may name, and what that costs
REFERENCES: tuple[Callable[[Lettering], complex], ...] = (  # by which letters are set: the beginning or the middle
    lambda word: complex(*word.at), lambda word: complex(*word.at) + word.long / 2)


@dataclass(frozen=True)
class LetterPlace:
    """Where letters stand from their marks, in mm, by a point of theirs, and how far off that most do."""

    reference: Callable[[Lettering], complex]
    offset: complex
    spread: float

    def departure(self, word: Lettering, mark: complex) -> float:
        """How far from there letters would stand as those of a mark, in mm."""
        return abs(self.reference(word) - mark - self.offset)

    def cost(self, word: Lettering, mark: complex) -> float:
        """What speaks against letters' being those of a mark: more, the further from there they stand."""
        ratio = self.departure(word, mark) / (measures.LETTER_PLACE_SIZES * word.size)
        return measures.STRAY_LETTER_COST * ratio**2 / (1 + ratio**2)


def usual_place(words: Sequence[tuple[Lettering, Wish]], traces: Sequence[Trace]) -> LetterPlace | None:
    """The place in which nearly all letters stand that have but one mark near; None where they stand in none, or are
    too few."""
    own_marks = [(word, mark) for word, wish in words if not word.leads
                 and (mark := _only_mark(wish, traces)) is not None]
    if len(own_marks) < measures.MIN_PLACED_LETTERS:
        return None
    places = []
    for reference in REFERENCES:
        offsets = [reference(word) - mark for word, mark in own_marks]
        middle = complex(median(z.real for z in offsets), median(z.imag for z in offsets))
        gaps = sorted(abs(z - middle) / word.size for z, (word, _) in zip(offsets, own_marks, strict=True))
        places.append(LetterPlace(reference, middle, gaps[int(measures.PLACED_SHARE * (len(gaps) - 1))]))
    best = min(places, key=lambda place: place.spread)
    return best if best.spread < measures.LETTER_PLACE_SIZES / 2 else None


def _only_mark(wish: Wish, traces: Sequence[Trace]) -> complex | None:
    """Where the mark is that is clearly nearest to letters."""
    costs = sorted((cost, place) for place, cost in wish.items() if traces[place].kind == POINT)
    if not costs or (len(costs) > 1 and costs[1][0] - costs[0][0] < measures.CLEAR_COST):
        return None
    return complex(*traces[costs[0][1]].spots[0])
