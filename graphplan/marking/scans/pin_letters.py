"""Letters beside the points of a mechanism that is drawn where nothing is printed: which of its dots they name.

Each dot that letters stand beside may be the point of that name; of all pairs that one is taken whose letters look most
like their names, and whose other points have dots where the task has them. Where lines meet, a dot may not be seen.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations

import cv2
import numpy as np
from numpy.typing import NDArray

from graphplan.kernel.kinds import LINE, POINT
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Spots
from graphplan.marking.scans.pencil_pixels import PencilInk, Ridges
from graphplan.marking.traces import Trace

Points = Mapping[str, complex]


@dataclass(frozen=True)
class LetterPiece:
    """Strokes that may be letters: spots along them, in mm."""

    spots: Spots

    @property
    def longer_side(self) -> float:
        return float(np.ptp(self.spots, axis=0).max())

    @property
    def places(self) -> NDArray[np.complex128]:
        """The same spots as complex numbers."""
        return self.spots[:, 0] + 1j * self.spots[:, 1]

    def turn_by(self, turn: complex) -> LetterPiece:
        """The same strokes turned about the origin."""
        at = self.places * turn
        return LetterPiece(np.column_stack([at.real, at.imag]))


def letter_pieces(ink: PencilInk, ridges: Ridges, strokes: Sequence[Trace]) -> list[LetterPiece]:
    """What may be letters of what is drawn apart from all else, and of what is left without strokes longer than a
    letter's."""
    pencil = np.zeros(ink.dark.shape, np.uint8)
    pencil[ink.cells(ridges.spots)] = 1
    pencil = np.asarray(cv2.dilate(pencil, np.ones((measures.PIECE_CLOSE_PX, measures.PIECE_CLOSE_PX), np.uint8)))
    beside = pencil.copy()
    for trace in strokes:
        if trace.figure.length > measures.LETTER_SIZES_MM[1] or (
                trace.kind == LINE and trace.figure.length > measures.MAX_LETTER_STROKE_MM):
            spots = np.rint(ink.pixels(np.array(trace.spots))).astype(np.int32)
            cv2.polylines(beside, [spots], False, 0, max(1, round(measures.STROKE_WIDTH_MM * ink.scale)))
    pieces = (*_pieces(pencil, ink, ridges), *_pieces(beside, ink, ridges))
    return [piece for piece in pieces if measures.LETTER_SIZES_MM[0] < piece.longer_side < measures.LETTER_SIZES_MM[1]]


def _pieces(drawn: NDArray[np.uint8], ink: PencilInk, ridges: Ridges) -> Iterator[LetterPiece]:
    """The pieces of what is drawn."""
    count, which = cv2.connectedComponents(drawn, connectivity=measures.PIXEL_NEIGHBOURS)
    piece_of_spot = which[ink.cells(ridges.spots)]
    order = np.argsort(piece_of_spot, kind="stable")
    for group in np.split(order, np.searchsorted(piece_of_spot[order], np.arange(1, count)))[1:]:
        if len(group) > measures.MIN_CRESTS:
            yield LetterPiece(ridges.spots[group])


def letter_likeness(piece: LetterPiece, name: str) -> float:
    """How much strokes look like a name, 0 to 1: by how far they are from the letters' strokes, and those from them,
    both as large as each other; upright or leaning."""
    templates = _templates(name.replace("_", ""))
    best = 0.0
    for lean in measures.LETTER_LEANS:
        spots = piece.spots[:: math.ceil(len(piece.spots) / measures.LETTER_SPOTS)].copy()
        spots[:, 0] -= lean * spots[:, 1]
        spots, aspect = _unit_box(spots)
        for template, own_aspect in templates:
            far = np.hypot(*np.moveaxis(spots[:, None] - template[None], -1, 0))
            off = (far.min(axis=1).mean() + far.min(axis=0).mean()) / 2 / measures.LETTER_OFF_SHARE
            odd = math.log(aspect / own_aspect) / measures.LETTER_ASPECT_LOG
            best = max(best, math.exp(-(off**2 + odd**2) / 2))
    return best


@cache
def _templates(name: str) -> list[tuple[Spots, float]]:
    """The strokes of a name as several alphabets of lettering have it, each in a box of size 1, and its aspect."""
    templates = []
    for font in (cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_HERSHEY_PLAIN):
        (wide, high), base = cv2.getTextSize(name, font, measures.ALPHABET_SIZE, 1)
        canvas = np.zeros((high + 2 * base, wide), np.uint8)
        cv2.putText(canvas, name, (0, high), font, measures.ALPHABET_SIZE, 1)
        row, column = np.nonzero(canvas)
        if len(row):
            spots = np.column_stack([column, -row]).astype(float)
            templates.append(_unit_box(spots[:: math.ceil(len(spots) / measures.LETTER_SPOTS)]))
    return templates


def _unit_box(spots: Spots) -> tuple[Spots, float]:
    """Spots moved and stretched into a box of size 1, and how many times as wide as high they were."""
    low, sides = spots.min(axis=0), np.ptp(spots, axis=0)
    box_sides = np.maximum(sides, measures.MIN_LETTER_SIDE * sides.max())
    return (spots - low) / box_sides, float(box_sides[0] / box_sides[1])


def possible_points(dots: Sequence[Trace], strokes: Sequence[Trace]) -> list[Trace]:
    """The dots, and where there is none, where straight strokes meet or end."""
    lines = [trace for trace in strokes if trace.kind == LINE]
    figures = [trace.figure for trace in lines]
    ends = [(spot, measures.END_BLUR_MM) for trace in lines for spot in trace.spots]
    crossings = [((crossing.x, crossing.y), measures.CROSSING_BLUR_MM) for first, second in combinations(figures, 2)
                 if (crossing := first.intersection(second)).geom_type == "Point" and not crossing.is_empty]
    spots = [Trace(POINT, (spot,), blur=blur) for spot, blur in (*crossings, *ends)]
    points = list(dots)
    for spot in spots:
        if all(math.dist(spot.spots[0], point.spots[0]) > measures.SAME_DOT_MM for point in points):
            points.append(spot)
    return points


def find_pins(dots: NDArray[np.complex128], pieces: Sequence[LetterPiece], points: Points, unit: float
              ) -> dict[str, int]:
    """The dots that two letters name, by name, and those that are where further points should be, whichever side of the
    paper is up; `points` are where the task has its points, in its own lengths, of which one is usually so many mm.
    Nothing where no two are found, or others may be meant as well."""
    weighed = list[tuple[float, dict[str, int]]]()
    for turn in (1, 1j, -1, -1j):
        weighed += _possible_pins(dots * turn, [piece.turn_by(turn) for piece in pieces], points, unit)
        if pins := _clear_pins(dots, weighed):
            return pins
    return {}


def _clear_pins(dots: NDArray[np.complex128], weighed: Sequence[tuple[float, dict[str, int]]]) -> dict[str, int]:
    """The pins for which most speaks, unless about as much speaks for others."""
    best, pins = max(weighed, key=lambda one: one[0], default=(0.0, dict[str, int]()))

    def is_other(rival: dict[str, int]) -> bool:
        """Whether most of its points lie elsewhere."""
        same = [name for name, place in rival.items() if name in pins
                and abs(dots[place] - dots[pins[name]]) < measures.PIN_NEAR_MM]
        return 2 * len(same) <= len(rival)

    most = max((odds for odds, rival in weighed if is_other(rival)), default=0.0)
    return pins if best > measures.MIN_PIN_ODDS and best - most > measures.CLEAR_PIN_ODDS else {}


def _possible_pins(dots: NDArray[np.complex128], pieces: Sequence[LetterPiece], points: Points, unit: float
                   ) -> Iterator[tuple[float, dict[str, int]]]:
    """Dots that may be those of points, two of which have their letters, and what speaks for them: the letters, and
    how many points have a dot where they should be."""
    likeness: dict[tuple[str, int], float] = {}
    for name, dot, like in _lettered_dots(dots, pieces, points):
        likeness[name, dot] = max(like, likeness.get((name, dot), like))
    names, places = list(points), np.array(list(points.values()))
    for name, dot in likeness:
        for other in {z for z in points.values() if z != points[name]}:
            units = (dots - dots[dot]) / (other - points[name])
            ratios = np.abs(units) / unit
            units = units[(ratios > 1 / measures.MAX_SCALE_RATIO) & (ratios < measures.MAX_SCALE_RATIO)]
            off = np.abs((dots[dot] + units[:, None] * (places - points[name]))[:, :, None] - dots)
            near = np.clip(1 - off.min(axis=2) / measures.PIN_NEAR_MM, 0, None)
            odds = ((2 * near.sum(axis=1) - len(points) - 2) * measures.POINT_ODDS
                    - np.abs(np.angle(units)) / measures.USUAL_TURN_RAD)
            for k in np.argsort(-odds)[:measures.PINS_WEIGHED]:
                pins = {key: int(off[k, i].argmin()) for i, key in enumerate(names) if near[k, i]} | {name: dot}
                letters = [likeness[pin] for pin in pins.items() if pin in likeness]
                if len(letters) > 1:
                    yield float(odds[k]) + sum(letters), pins


def _lettered_dots(dots: NDArray[np.complex128], pieces: Sequence[LetterPiece], points: Points
                   ) -> Iterator[tuple[str, int, float]]:
    """Names, dots that may be theirs, and what their letters speak for that."""
    for piece in pieces:
        far = np.abs(dots[:, None] - piece.places).min(axis=1)
        beside = np.abs(dots - piece.places.mean()) > piece.longer_side / 2
        near = np.flatnonzero((far < measures.LETTER_NEAR_MM) & beside)
        if not len(near):
            continue
        for name in points:
            if (like := letter_likeness(piece, name)) > measures.MIN_LETTER_LIKENESS:
                for dot in near[np.argsort(far[near])][:measures.DOTS_NEAR_LETTER]:
                    yield name, int(dot), like - float(far[dot]) / measures.LETTER_NEAR_MM / 4
