"""Diagrams as data, in mm of paper: axes with round divisions, curves, areas, chords, ordinates, labels, and scales.

    upper, lower = stack_frames(room, (0.0, 360.0), [(-20.0, 55.0), (0.0, 80.0)])
    axes = QuantityAxis("phi", "°", turns=True), QuantityAxis("E", "J")
    energy = Diagram(lower, *axes, [DrawnCurve(travel, energy, CURVES[1])])
    yield from SheetText(letters, tongue).diagram(energy)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from graphplan.phrases import Said, arrange, digits, join, unit
from graphplan.sheet.layout.scales import round_up, scale_words
from graphplan.sheet.lettering.lettering import CAPS, DEPTH, LetterSizes, Runs, name_runs, sentence_runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.view import View, clip_item
from graphplan.sheet.tolerances import STEP_TOL
from graphplan.words.tongue import Tongue

AXIS, DIVISION, CLEAR = Pen(0.18), Pen(0.13, "#c4c4c4"), Pen(0.0, pens.PAPER, fill=pens.PAPER)
CURVES = Pen(0.35), Pen(0.35, pens.BLUE), Pen(0.35, pens.RED), Pen(0.35, pens.VIOLET), Pen(0.35, pens.GREEN)
HEAD, ON, TICK = 2.2, 5.0, 1.0  # mm: heads of axes, how far an axis goes on beyond its diagram, marks on it
DIVISION_PITCH_MM = 9.0  # mm that divisions with numbers are apart at least
HEADED = 5.5  # mm over a diagram, for its letter and scale
LEFT, FOOT = 12.0, 7.0  # mm beside diagrams and under them, for numbers
STROKES = 16  # of a smooth line from spot to spot

Span = tuple[float, float]


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


# ---- data -----------------------------------------------------------------------------------------------------------


class AxisScale(NamedTuple):
    """The value of one mm of an axis, and the value in its origin."""

    unit: float
    datum: float = 0.0

    def mm(self, value: Any) -> Any:
        """Return the distances of values from the origin, in mm."""
        return (np.asarray(value, dtype=float) - self.datum) / self.unit

    def value(self, mm: Any) -> Any:
        """Return the values at distances from the origin in mm."""
        return self.datum + np.asarray(mm, dtype=float) * self.unit

    def span(self, ends: Span) -> Span:
        """The values at both ends of a stretch of mm."""
        return self.datum + ends[0] * self.unit, self.datum + ends[1] * self.unit

    def in_units(self, size: float) -> AxisScale:
        """Return the scale in units of another size."""
        return AxisScale(self.unit / size, self.datum / size)


class Frame(NamedTuple):
    """The window of a diagram: its origin, the scales of what lies level and of what stands upright, and how far both
    go from the origin, to the left and right and down and up, in mm."""

    origin: Spot
    x: AxisScale
    y: AxisScale
    level: Span
    upright: Span

    @classmethod
    def fit_rect(cls, rect: Rect, x: Span, y: Span, k_y: float = 0.0) -> Frame:
        """The frame that fills a rectangle from left to right, its ordinates in a round scale or one that is given."""
        k_x = (x[1] - x[0]) / rect.width
        k_y = k_y or float(round_up((y[1] - y[0]) / rect.height))
        zero = left, low = rect.left - x[0] / k_x, rect.bottom - y[0] / k_y
        return cls(zero, AxisScale(k_x), AxisScale(k_y), (rect.left - left, rect.right - left),
                   (rect.bottom - low, rect.top - low))

    def seen_through(self, window: Callable[[Spot], Spot]) -> Frame:
        """The frame of a construction on its sheet, through a window that leaves it as large."""
        return self._replace(origin=window(self.origin))

    @property
    def rect(self) -> Rect:
        """The window as a rectangle."""
        (x, y), (left, right), (low, high) = self.origin, self.level, self.upright
        return Rect(x + left, y + low, x + right, y + high)

    def position(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return the coordinates of values of both axes, in mm."""
        return self.origin[0] + self.x.mm(x), self.origin[1] + self.y.mm(y)

    def spot(self, x: float, y: float) -> Spot:
        """Return the spot of a value on paper."""
        across, up = self.position(x, y)
        return float(across), float(up)

    def spots(self, xs: Any, ys: Any) -> list[Spot]:
        """Return the spots of arrays of values."""
        return [*zip(*(mm.tolist() for mm in self.position(xs, ys)), strict=True)]


def stack_frames(room: Rect, x: Span, ordinates: Sequence[Span], shares: Sequence[float] = ()) -> list[Frame]:
    """Frames under each other over the same abscissae, as high as their shares; room for numbers is left about them."""
    shares = shares or [1.0] * len(ordinates)
    inner = room.inset(LEFT, FOOT, ON, 0.0)
    free, top, frames = inner.height - len(ordinates) * HEADED, inner.top, list[Frame]()
    for span, share in zip(ordinates, shares, strict=True):
        low = top - HEADED - free * share / sum(shares)
        frames.append(Frame.fit_rect(Rect(inner.left, low, inner.right, top - HEADED), x, span))
        top = low
    return frames


class QuantityAxis(NamedTuple):
    """An axis as data: letter and unit of its quantity, and the letter of its scale where that is another.

    Round values, or `values`, have `numbers`, those of a quantity that `turns` parts of a turn, on the right where
    these are to be `far`; the axis may have a `head`. Another `label` may stand instead of letter, unit and scale,
    of which the scale is left out where it is not `scaled`; it begins at the left (`start`) or ends at the right
    (`end`) of the diagram, moved by a `shift` in mm.
    """

    letter: str = ""
    measure: str = ""
    scale: str = ""
    numbers: bool = True
    turns: bool = False
    far: bool = False
    head: bool = True
    scaled: bool = True
    label: Said | None = None  # instead of letter, unit and scale
    values: Sequence[float] = ()
    anchor: str = ""
    shift: Spot = (0.0, 0.0)


class DrawnCurve(NamedTuple):
    """A curve through values, broken off where they are nan; `smooth` where they are few (Catmull and Rom); as `dots` a
    mark at each, of so large a radius."""

    xs: Any
    ys: Any
    pen: Pen = CURVES[0]
    smooth: bool = False
    dots: float = 0.0


class Label(NamedTuple):
    """Words at values of a diagram, so many mm off; `backed` they break the lines under them."""

    x: float
    y: float
    words: str | Runs
    off: Spot = (0.0, 0.0)
    anchor: str = "start"
    backed: bool = False


@dataclass(frozen=True)
class Diagram:
    """A diagram: `areas` lie between a curve and a level; `uprights` and `levels` are thin lines at values through all
    of it, the former so many mm down beyond it; curves may go `over` its edges by so many mm. Its abscissa lies at the
    ordinate `crossing`."""

    frame: Frame
    x: QuantityAxis
    y: QuantityAxis
    curves: Sequence[DrawnCurve] = ()
    labels: Sequence[Label] = ()
    areas: Sequence[tuple[Any, Any, float]] = ()
    uprights: Sequence[float] = ()
    uprights_down: float = 0.0
    levels: Sequence[float] = ()
    over: float = 0.0
    crossing: float = 0.0
    pen: Pen = DIVISION

    def items(self) -> Iterator[Item]:
        """Strokes and areas of the curves, without axes and words."""
        frame, rect = self.frame, self.frame.rect
        for xs, ys, level in self.areas:
            ends = [(xs[-1], level), (xs[0], level)]
            yield Polygon(Pen(0.0, fill=pens.TINT), "paper", None,
                          (*frame.spots(xs, ys), *(frame.spot(*end) for end in ends)))
        for x in self.uprights:
            at = frame.spot(float(x), 0.0)[0]
            yield Polyline(self.pen, "ruling", None, ((at, rect.bottom - self.uprights_down), (at, rect.top)))
        for y in self.levels:
            at = frame.spot(0.0, float(y))[1]
            yield Polyline(self.pen, "ruling", None, ((rect.left, at), (rect.right, at)))
        window = rect.inset(*[-self.over] * 4)
        for curve in self.curves:
            spots = frame.spots(curve.xs, curve.ys)
            if curve.dots:
                yield from (Circle(curve.pen, "links", None, spot, curve.dots) for spot in spots if rect.holds(spot))
            else:
                yield from stroke_curve(spots, window, curve.pen, curve.smooth)


def stroke_curve(spots: Iterable[Spot], rect: Rect, pen: Pen, smooth: bool = False, closed: bool = False
                 ) -> Iterator[Item]:
    """A curve through spots, broken off where they are nan, as far as it lies in a window."""
    for stretch in unbroken(spots):
        line = smooth_line(stretch, closed) if smooth else stretch
        yield from clip_item(Polyline(pen, "links", None, tuple(line)), rect)


def unbroken(spots: Iterable[Spot]) -> Iterator[list[Spot]]:
    """The stretches without nan of two spots or more."""
    rows = np.array([*spots], dtype=float).reshape(-1, 2)
    known = np.isfinite(rows).all(axis=1)
    for stretch in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(known)) + 1):
        if len(stretch) > 1 and known[stretch[0]]:
            yield [(float(x), float(y)) for x, y in rows[stretch]]


def smooth_line(spots: Sequence[Spot], closed: bool = False) -> list[Spot]:
    """A smooth line through spots (Catmull and Rom), back to the first where it is `closed`."""
    if len(spots) < 3:
        return list(spots)
    inner = np.array(spots)
    ends = np.concatenate([inner[-1:], inner, inner[:2]] if closed else
                          [2 * inner[:1] - inner[1:2], inner, 2 * inner[-1:] - inner[-2:-1]])
    P, Q, R, S = ends[:-3], ends[1:-2], ends[2:-1], ends[3:]
    t = (np.arange(1, STROKES + 1) / STROKES)[:, None, None]
    pieces = 0.5 * (2 * Q + (R - P) * t + (2 * P - 5 * Q + 4 * R - S) * t**2 + (3 * Q - P - 3 * R + S) * t**3)
    return [spots[0], *((float(x), float(y)) for x, y in pieces.transpose(1, 0, 2).reshape(-1, 2))]


# ---- drawing --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SheetText:
    """The lettering of a sheet: sizes, tongue, and the convention of its scales; diagrams are lettered by it."""

    letters: LetterSizes
    tongue: Tongue
    convention: str = "real"

    def text(self, at: Spot, words: str | Runs, anchor: str = "start", size: float = 0.0, pen: Pen = pens.LETTERS,
             names: tuple[str, ...] = ()) -> Text:
        """Lettering on its base line."""
        runs = sentence_runs(self.tongue(words), names) if isinstance(words, str) else words
        return Text(pen, "letters", None, at, runs, size or self.letters.text, anchor)

    def backed_text(self, at: Spot, words: str | Runs, size: float = 0.0, middle: bool = False) -> Iterator[Item]:
        """Lettering that breaks the lines under it, from its base line up, or in the middle of a spot."""
        size = size or self.letters.text
        if isinstance(words, str):
            words = name_runs(words) if "_" in words else sentence_runs(self.tongue(words))
        wide, high = width(words, size), CAPS * size
        x, y = (at[0] - wide / 2, at[1] - high / 2) if middle else at
        back = Rect(x, y, x + wide, y + high).inset(-0.4, -DEPTH * size / 2 - 0.2, -0.4, -0.4)
        yield Polygon(CLEAR, "letters", None, back.corners)
        yield Text(pens.LETTERS, "letters", None, (x, y), words, size)

    def draw_point(self, at: Spot, words: str, off: Spot = (1.2, 0.8)) -> Iterator[Item]:
        """A point with its letter."""
        yield Circle(pens.DOT, "plates", None, at, 0.6)
        yield self.text((at[0] + off[0], at[1] + off[1]), words, "start" if off[0] > 0 else "end", self.letters.mark)

    def legend(self, rect: Rect, curves: Iterable[tuple[Said, Pen]]) -> Iterator[Item]:
        """A sample of each curve with its name, in the upper left corner."""
        x, y, size = rect.left + 2.0, rect.top - 2.0, self.letters.text
        for words, pen in curves:
            yield Polyline(pen, "letters", None, ((x, y), (x + 6.0, y)))
            text = self.text((x + 7.5, y - 0.35 * size), words)
            yield text
            x = text.box.right + 6.0

    # ---- diagrams --------------------------------------------------------------------------------------------------

    def diagram(self, diagram: Diagram) -> Iterator[Item]:
        """A diagram with its axes, numbers and words."""
        yield from diagram.items()
        yield from self._abscissa(diagram)
        yield from self._ordinate(diagram)
        for x, y, words, off, anchor, backed in diagram.labels:
            across, up = diagram.frame.spot(x, y)
            at = across + off[0], up + off[1]
            yield from self.backed_text(at, words) if backed else (self.text(at, words, anchor),)

    def _label(self, axis: QuantityAxis, at: Spot, k: float, anchor: str) -> Text:
        """The quantity of an axis with its unit and its scale."""
        name = axis.scale or axis.letter
        words = axis.label or join((axis.letter, unit(axis.measure)))
        if axis.label is None and axis.scaled:
            words = arrange("{0};  {1}", words, scale_words(name, abs(k), axis.measure, self.convention))
        return self.text((at[0] + axis.shift[0], at[1] + axis.shift[1]), words, axis.anchor or anchor,
                         names=(axis.letter, f"k_{name}", f"mu_{name}"))

    def _abscissa(self, diagram: Diagram) -> Iterator[Item]:
        """The axis to the right at its crossing, or at the edge beyond which that lies; what it shows and round values
        stand under the diagram, of an axis at its top over it."""
        frame, rect, axis = diagram.frame, diagram.frame.rect, diagram.x
        y, end = min(max(frame.spot(0.0, diagram.crossing)[1], rect.bottom), rect.top), rect.right + ON
        yield Arrow(AXIS, "ruling", None, (rect.left, y), (end, y), HEAD)
        if axis.letter:
            x = rect.left if axis.anchor == "start" else rect.right
            low = rect.bottom - (2.4 + CAPS) * self.letters.text if y < rect.top else rect.top + HEADED / 2
            at = (x, low) if axis.scaled else (end, y + 1.2)
            yield self._label(axis, at, frame.x.unit, "end")
        if axis.numbers:
            yield from self._numbers_under(frame, axis)

    def _numbers_under(self, frame: Frame, axis: QuantityAxis) -> Iterator[Item]:
        rect, size, ends = frame.rect, self.letters.text, frame.x.span(frame.level)
        values = axis.values or divisions(*ends, rect.width / DIVISION_PITCH_MM, axis.turns)
        if not axis.values:
            widest = max(width(sentence_runs(digits(value)), size) for value in values)
            values = divisions(*ends, rect.width / max(DIVISION_PITCH_MM, 1.6 * widest), axis.turns)
        shown = list[Text]()
        for value in values:
            x, y = frame.spot(float(value), 0.0)[0], rect.bottom
            yield Polyline(AXIS, "ruling", None, ((x, y), (x, y - TICK)))
            number = self.text((x, y - TICK - 0.6 - CAPS * size), digits(float(value)), "middle")
            if not any(number.box.inset(-0.5, 0.0, -0.5, 0.0).meets(other.box) for other in shown):
                shown.append(number)
        yield from shown

    def _ordinate(self, diagram: Diagram) -> Iterator[Item]:
        """The axis upwards over the whole diagram, with its quantity over it, and round values beside it, but for where
        the head of the abscissa stands."""
        frame, rect, axis, size = diagram.frame, diagram.frame.rect, diagram.y, self.letters.text
        foot, top = (rect.left, rect.bottom), (rect.left, rect.top + (0.5 * ON if axis.head else 0.0))
        yield Arrow(AXIS, "ruling", None, foot, top, HEAD) if axis.head else Polyline(AXIS, "ruling", None, (foot, top))
        if axis.letter or axis.label is not None:
            at = rect.right if axis.anchor == "end" else rect.left + 2.0, rect.top + HEADED / 2
            yield self._label(axis, at, frame.y.unit, "start")
        if not axis.numbers:
            return
        x, outwards = (rect.right, 1.0) if axis.far else (rect.left, -1.0)
        level = frame.spot(0.0, diagram.crossing)[1]
        for value in divisions(*frame.y.span(frame.upright), rect.height / (0.8 * DIVISION_PITCH_MM), axis.turns):
            y = frame.spot(0.0, value)[1]
            if axis.far and min(abs(y - level), y - rect.bottom) < size:
                continue
            yield Polyline(AXIS, "ruling", None, ((x + outwards * TICK, y), (x, y)))
            at = x + outwards * (TICK + 0.8), y - CAPS * size / 2
            yield from self.backed_text(at, digits(value)) if axis.far else (self.text(at, digits(value), "end"),)

    def rings(self, window: View, measure: str) -> Iterator[Item]:
        """The round divisions of a polar diagram, with their numbers, and its axes."""
        (x, y), rect = window.origin, window.rect
        for ends in (((rect.left, y), (rect.right, y)), ((x, rect.bottom), (x, rect.top))):
            yield Polyline(AXIS, "ruling", None, ends)
        reach = max(x - rect.left, rect.right - x, y - rect.bottom, rect.top - y)
        radii = divisions(0.0, reach / window.scale, reach / (2 * DIVISION_PITCH_MM))[1:]
        for radius in radii:
            mm = radius * window.scale
            yield from clip_item(Circle(DIVISION, "ruling", None, (x, y), mm), rect)
            if x + mm < rect.right - 2.0:
                text = arrange("{0} {1}", digits(radius), unit(measure)) if radius == radii[0] else digits(radius)
                yield from self.backed_text((x + mm, y + 0.8), text)
