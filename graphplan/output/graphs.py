"""Diagrams in mm of paper: axes with round divisions, curves, diagrams under each other over one abscissa, polar ones.

    upper, lower = stacked(room, (0.0, 360.0), [(-20.0, 55.0), (0.0, 80.0)])
    paper = Figures(letters, tongue)
    yield from paper.axes(lower, "φ, °", scale_words("E", lower.y.unit, "J"), turns=True)
    yield from lower.curve(travel, energy, CURVES[1])
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from graphplan.cycle.diagrams import AxisScale, Frame
from graphplan.output.tolerances import STEP_TOL
from graphplan.phrases import Said, arrange, digits, unit
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.lettering.lettering import CAPS, DEPTH, LetterSizes, Runs, name_runs, sentence_runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.view import clip_item
from graphplan.words.tongue import Tongue

AXIS, DIVISION, CLEAR = Pen(0.18), Pen(0.13, "#c4c4c4"), Pen(0.0, pens.PAPER, fill=pens.PAPER)
CURVES = Pen(0.35), Pen(0.35, pens.BLUE), Pen(0.35, pens.RED), Pen(0.35, pens.VIOLET), Pen(0.35, pens.GREEN)
HEAD, ON, TICK = 2.2, 5.0, 1.0  # mm: heads of axes, how far an axis goes on beyond its diagram, marks on it
DIVISION_PITCH_MM = 9.0  # mm that divisions with numbers are apart at least
HEADED = 5.5  # mm over a diagram, for its letter and scale
LEFT, FOOT = 12.0, 7.0  # mm beside diagrams and under them, for numbers
STROKES = 16  # of a smooth line from spot to spot

Span = tuple[float, float]


def scale_words(letter: str, k: float, measure: str, convention: str = "real") -> Said:
    """A scale as it stands beside a diagram, such as k_M = 10 N m/mm, or where so it is the convention in mm a unit."""
    if convention == "drawn":
        return arrange("mu_{0} = {1} {2}", letter, digits(1 / k), unit(f"mm/({measure})" if " " in measure else
                                                                       f"mm/{measure}"))
    apart = "k_{0} = {1}{2}" if measure == "°" else "k_{0} = {1} {2}"
    return arrange(apart, letter, digits(k), unit(f"{measure}/mm"))


def divisions(low: float, high: float, most: float, turns: bool = False) -> list[float]:
    """Round numbers from `low` to `high`, evenly apart, so many at most; of a quantity that `turns` parts of a turn in
    degrees."""
    step = (high - low) / max(most, 1.0)
    if not step > 0:
        return [low]
    power = 10.0 ** math.floor(math.log10(step))
    steps = [power * times for times in (1, 2, 5, 10)]
    step = next(candidate
                for candidate in ([15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0, *steps] if turns and 5 < step <= 360
                                  else steps) if candidate >= step * (1 - STEP_TOL))
    first, last = math.ceil(low / step - STEP_TOL), math.floor(high / step + STEP_TOL)
    return [k * step for k in range(first, last + 1)]


class Graph(Frame):
    """A diagram's frame in mm of the sheet, which draws."""

    @classmethod
    def fit_rect(cls, rect: Rect, x: Span, y: Span, k_y: float = 0.0) -> Graph:
        """The diagram that fills a rectangle from left to right, its ordinates in a round scale or one that is given.
        """
        k_x = (x[1] - x[0]) / rect.width
        k_y = k_y or float(round_up((y[1] - y[0]) / rect.height))
        zero = left, low = rect.left - x[0] / k_x, rect.bottom - y[0] / k_y
        return cls(zero, AxisScale(k_x), AxisScale(k_y), (rect.left - left, rect.right - left),
                   (rect.bottom - low, rect.top - low))

    @classmethod
    def from_frame(cls, frame: Frame, window: Callable[[Spot], Spot]) -> Graph:
        """The diagram of a frame that a construction has, through a window that leaves it as large."""
        return cls(window(frame.origin), *frame[1:])

    @property
    def rect(self) -> Rect:
        """The window."""
        (x, y), (left, right), (low, high) = self.origin, self.level, self.upright
        return Rect(x + left, y + low, x + right, y + high)

    def spot(self, x: float, y: float) -> Spot:
        """Where a value lies on paper."""
        across, up = self.position(x, y)
        return float(across), float(up)

    def spots(self, xs: Iterable[Any], ys: Iterable[Any]) -> list[Spot]:
        """Where values lie."""
        return [*map(self.spot, xs, ys)]

    def line(self, spots: Sequence[Spot], pen: Pen, layer: str = "links") -> Iterator[Item]:
        """A line through spots, as far as it lies in the window."""
        yield from clip_item(Polyline(pen, layer, None, tuple(spots)), self.rect)

    def curve(self, xs: Iterable[Any], ys: Iterable[Any], pen: Pen = CURVES[0]) -> Iterator[Item]:
        """The curve through values, broken off where they are nan."""
        for stretch in _unbroken(self.spots(xs, ys)):
            yield from self.line(stretch, pen)

    def smooth(self, xs: Iterable[Any], ys: Iterable[Any], pen: Pen = CURVES[0]) -> Iterator[Item]:
        """A smooth curve through few points (Catmull and Rom)."""
        for stretch in _unbroken(self.spots(xs, ys)):
            yield from self.line(smooth_line(stretch), pen)

    def points(self, xs: Iterable[Any], ys: Iterable[Any], pen: Pen = pens.DOT, radius: float = 0.5) -> Iterator[Item]:
        """A mark at each value."""
        for spot in self.spots(xs, ys):
            if self.rect.holds(spot):
                yield Circle(pen, "links", None, spot, radius)

    def uprights(self, xs: Iterable[Any], pen: Pen = DIVISION) -> Iterator[Item]:
        """Thin lines through the whole diagram."""
        for x in xs:
            at = self.spot(float(x), 0.0)[0]
            yield Polyline(pen, "ruling", None, ((at, self.rect.bottom), (at, self.rect.top)))


def stack_graphs(room: Rect, x: Span, ordinates: Sequence[Span], shares: Sequence[float] = ()) -> list[Graph]:
    """Diagrams under each other over the same abscissae, as high as their shares; room for numbers is left about them.
    """
    shares = shares or [1.0] * len(ordinates)
    inner = room.inset(LEFT, FOOT, ON, 0.0)
    free, top, graphs = inner.height - len(ordinates) * HEADED, inner.top, list[Graph]()
    for span, share in zip(ordinates, shares, strict=True):
        low = top - HEADED - free * share / sum(shares)
        graphs.append(Graph.fit_rect(Rect(inner.left, low, inner.right, top - HEADED), x, span))
        top = low
    return graphs


def lines_through(graphs: Sequence[Graph], xs: Iterable[Any]) -> Iterator[Item]:
    """Thin lines through diagrams that stand under each other, from the lowest to the highest."""
    for x in xs:
        at = graphs[0].spot(float(x), 0.0)[0]
        yield Polyline(DIVISION, "ruling", None, ((at, graphs[-1].rect.bottom), (at, graphs[0].rect.top)))


@dataclass(frozen=True)
class PolarGraph:
    """A diagram of vectors from one middle: where that is, and what a mm stands for."""

    rect: Rect
    centre: Spot
    k: float

    @classmethod
    def fit_vectors(cls, rect: Rect, xs: Sequence[float], ys: Sequence[float]) -> PolarGraph:
        """The diagram that has room for vectors with these components and for its middle, in a round scale."""
        (low, high), (foot, top) = ((min(0.0, *components), max(0.0, *components)) for components in (xs, ys))
        k = float(round_up(max((high - low) / rect.width, (top - foot) / rect.height)))
        (x, y) = rect.centre
        return cls(rect, (x - (low + high) / 2 / k, y - (foot + top) / 2 / k), k)

    def end_of(self, x: float, y: float) -> Spot:
        """Where a vector ends."""
        return self.centre[0] + x / self.k, self.centre[1] + y / self.k

    def curve(self, xs: Iterable[Any], ys: Iterable[Any], pen: Pen = CURVES[0]) -> Iterator[Item]:
        """The curve of the ends of vectors."""
        spots = [self.end_of(float(x), float(y)) for x, y in zip(xs, ys, strict=True)]
        yield from clip_item(Polyline(pen, "links", None, tuple(spots)), self.rect)


@dataclass(frozen=True)
class Figures:
    """What all figures of a sheet are lettered by."""

    letters: LetterSizes
    tongue: Tongue

    def text(self, at: Spot, words: str | Runs, anchor: str = "start", size: float = 0.0, pen: Pen = pens.LETTERS,
             names: tuple[str, ...] = ()) -> Text:
        """Lettering on its base line."""
        runs = sentence_runs(self.tongue(words), names) if isinstance(words, str) else words
        return Text(pen, "letters", None, at, runs, size or self.letters.text, anchor)

    def quantity(self, at: Spot, letter: str, measure: str, k: float, convention: str = "real", anchor: str = "start",
                 scale: str = "") -> Text:
        """What a diagram shows, its unit and its scale; the scale is called by another letter where that is told."""
        name = scale or letter
        heading = self.tongue(arrange("{0}, {1};  ", letter, unit(measure)))
        k_told = self.tongue(scale_words(name, abs(k), measure, convention))
        return self.text(at, (*sentence_runs(heading, (letter,)), *sentence_runs(k_told, (f"k_{name}", f"mu_{name}"))),
                         anchor)

    def draw_point(self, at: Spot, words: str, off: Spot = (1.2, 0.8)) -> Iterator[Item]:
        """A point with its letter."""
        yield Circle(pens.DOT, "plates", None, at, 0.6)
        yield self.text((at[0] + off[0], at[1] + off[1]), words, "start" if off[0] > 0 else "end", self.letters.mark)

    def backed_text(self, at: Spot, words: str | Runs, size: float = 0.0, middle: bool = False) -> Iterator[Item]:
        """Lettering that breaks the lines under it, from its base line up, or in the middle of a spot."""
        size = size or self.letters.text
        if isinstance(words, str):
            words = name_runs(words) if "_" in words else sentence_runs(self.tongue(words))
        wide, high = width(words, size), CAPS * size
        if middle:
            at = at[0] - wide / 2, at[1] - high / 2
        low = DEPTH * size if any(run.level < 0 for run in words) else 0.0
        yield Polygon(CLEAR, "letters", None, Rect(at[0], at[1] - low, at[0] + wide, at[1] + high).corners)
        yield Text(pens.LETTERS, "letters", None, at, words, size)

    # ---- axes ------------------------------------------------------------------------------------------------------

    def abscissa(self, graph: Graph, words: str = "", level: float = 0.0) -> Iterator[Item]:
        """The axis to the right at an ordinate, or at the edge beyond which it lies, with its quantity at its head."""
        rect, end = graph.rect, graph.rect.right + ON
        y = min(max(graph.spot(0.0, level)[1], rect.bottom), rect.top)
        yield Arrow(AXIS, "ruling", None, (graph.rect.left, y), (end, y), HEAD)
        if words:
            yield self.text((end, y + 1.2), words, "end")

    def ordinate(self, graph: Graph, head: bool = False, at: float = 0.0) -> Iterator[Item]:
        """The axis upwards, over the whole diagram."""
        x = graph.rect.left + at
        foot, top = (x, graph.rect.bottom), (x, graph.rect.top + (0.5 * ON if head else 0.0))
        yield Arrow(AXIS, "ruling", None, foot, top, HEAD) if head else Polyline(AXIS, "ruling", None, (foot, top))

    def heading(self, graph: Graph, words: str | Runs, names: tuple[str, ...] = (), off: float = 0.0) -> Item:
        """What a diagram shows, and its scale, over its left end."""
        return self.text((graph.rect.left + off, graph.rect.top + 1.6), words, names=names)

    def numbered_x(self, graph: Graph, turns: bool = False) -> Iterator[Item]:
        """Round abscissae, with their numbers under the diagram."""
        y, size, ends = graph.rect.bottom, self.letters.text, graph.x.span(graph.level)
        values = divisions(*ends, graph.rect.width / DIVISION_PITCH_MM, turns)
        widest = max(width(sentence_runs(digits(value)), size) for value in values)
        for x in divisions(*ends, graph.rect.width / max(DIVISION_PITCH_MM, 1.6 * widest), turns):
            at = graph.spot(x, 0.0)[0]
            yield Polyline(AXIS, "ruling", None, ((at, y), (at, y - TICK)))
            yield self.text((at, y - TICK - 0.6 - CAPS * size), digits(x), "middle")

    def numbered_y(self, graph: Graph, right: bool = False, turns: bool = False,
                   level: float = 0.0) -> Iterator[Item]:
        """Round ordinates, with their numbers left of the diagram, or right of it but for where the head of the
        abscissa and its last number stand."""
        size, x, outwards = self.letters.text, graph.rect.right if right else graph.rect.left, 1.0 if right else -1.0
        for value in divisions(*graph.y.span(graph.upright), graph.rect.height / (0.8 * DIVISION_PITCH_MM), turns):
            y = graph.spot(0.0, value)[1]
            if right and min(abs(y - graph.spot(0.0, level)[1]), y - graph.rect.bottom) < size:
                continue
            yield Polyline(AXIS, "ruling", None, ((x + outwards * TICK, y), (x, y)))
            at = x + outwards * (TICK + 0.8), y - CAPS * size / 2
            yield from self.backed_text(at, digits(value)) if right else (self.text(at, digits(value), "end"),)

    def axes(self, graph: Graph, x_words: str, y_words: str, *, numbers: bool = True, turns: bool = False
             ) -> Iterator[Item]:
        """Both axes with arrowheads and round divisions, what they stand for, and if so the numbers of abscissae, which
        are parts of a turn where they are degrees that it `turns`."""
        yield from self.ordinate(graph, head=True)
        yield from self.abscissa(graph, x_words)
        yield from self.numbered_y(graph)
        if numbers:
            yield from self.numbered_x(graph, turns=turns)
        yield self.heading(graph, y_words, off=2.0)

    def rings(self, polar: PolarGraph, measure: str) -> Iterator[Item]:
        """The round divisions of a polar diagram, with their numbers, and its axes."""
        (x, y), rect = polar.centre, polar.rect
        for ends in (((rect.left, y), (rect.right, y)), ((x, rect.bottom), (x, rect.top))):
            yield Polyline(AXIS, "ruling", None, ends)
        reach = max(x - rect.left, rect.right - x, y - rect.bottom, rect.top - y) * polar.k
        radii = divisions(0.0, reach, reach / polar.k / (2 * DIVISION_PITCH_MM))[1:]
        for radius in radii:
            mm = radius / polar.k
            around = [(x + mm * math.cos(t), y + mm * math.sin(t)) for k in range(91) for t in (math.radians(4 * k),)]
            yield from clip_item(Polyline(DIVISION, "ruling", None, tuple(around)), rect)
            if x + mm < rect.right - 2.0:
                text = arrange("{0} {1}", digits(radius), unit(measure)) if radius == radii[0] else digits(radius)
                yield from self.backed_text((x + mm, y + 0.8), text)


def smooth_line(spots: Sequence[Spot]) -> list[Spot]:
    """A smooth line through spots."""
    if len(spots) < 3:
        return list(spots)
    ends = [_mirror_spot(spots[0], spots[1]), *spots, _mirror_spot(spots[-1], spots[-2])]
    curve = [spots[0]]
    for P, Q, R, S in zip(ends, ends[1:], ends[2:], ends[3:], strict=False):
        for k in range(1, STROKES + 1):
            t = k / STROKES
            curve.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t**2  # type: ignore[arg-type]
                                      + (3 * q - p - 3 * r + s) * t**3) for p, q, r, s in zip(P, Q, R, S, strict=True)))
    return curve


def _mirror_spot(end: Spot, inner: Spot) -> Spot:
    return 2 * end[0] - inner[0], 2 * end[1] - inner[1]


def _unbroken(spots: Iterable[Spot]) -> Iterator[list[Spot]]:
    """The stretches without nan of two spots or more."""
    stretch: list[Spot] = []
    for spot in (*spots, (math.nan, math.nan)):
        if all(map(math.isfinite, spot)):
            stretch.append(spot)
            continue
        if len(stretch) > 1:
            yield stretch
        stretch = []
