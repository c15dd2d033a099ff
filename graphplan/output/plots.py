"""Kinematic diagrams as SVG text: displacement, velocity and acceleration one under the other, over one abscissa.

Everything is drawn in mm of paper on one sheet, as a draughtsman would. The same diagrams are the same text.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import chain, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from graphplan.output.svg import CIRCLE, CROSSED, LAYER, LINE, MARGIN, TITLE, Canvas
from graphplan.phrases import digits, join, phrase, said, unit
from graphplan.sheet.diagrams import AXIS, DIVISION
from graphplan.sheet.lettering.lettering import SIZE, Runs, TextRun, sentence_runs, width, wrap
from graphplan.sheet.plates.display import Arrow, Rect
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, INK, PAPER, RED, VIOLET, Pen
from graphplan.words.tongue import ENGLISH, Tongue

if TYPE_CHECKING:
    from graphplan.cycle.diagrams import KinematicDiagram, Ray, Spot

HEADING, GAP = 3.5, 10.0  # mm: the letters of a quantity's name; between columns and rows
LEFT, RIGHT, ABOVE, BELOW = 10.0, 26.0, 13.0, 5.0  # free room left of a pole, for readings, over and under a diagram
HEAD, FOOT = 6.0, 50.0  # a column's heading; its numbers, table and key
NARROWEST = 150.0  # a column: the table and the key stand side by side
COLUMNS, SMOOTH = 4, 360  # columns in a row; points of a smooth curve
HIGHEST, BEYOND = 75.0, 12.0  # the highest ordinate in mm, and how far beyond those at the divisions a curve is drawn
SHOWN, PRODUCED = 3, 8.0  # chords that are picked out, and by how many mm they are produced

RAY, STEP = Pen(0.13, GREY), Pen(0.18, GREY)
CHORD, LEVEL, BACK = Pen(0.25, GREEN), Pen(0.18, GREEN, (1.6, 0.8)), Pen(0.35, VIOLET, (2.0, 1.0))
DOT, CROSS, POLE = Pen(0.2, fill=PAPER), Pen(0.25), Pen(0.2, fill=INK)
PLANS = {"s": Pen(0.35), "v": Pen(0.35, BLUE), "a": Pen(0.35, RED)}
NEXT = dict(pairwise(PLANS))  # the rate that each diagram's chords give
METHODS = {  # what a way to find a curve is called, what its points are, and how they are drawn
    "by chords": (phrase("by chords"), phrase("by chords, in the middle of each"), CIRCLE, 1.2, DOT),
    "by tangents": (phrase("by tangents"), phrase("by tangents, at the division"), CROSSED, 1.3, CROSS),
    "integrated": (phrase("integrated"), phrase("integrated, from a by v to s"), "", 0.0, BACK),
}  # fmt: skip


def diagrams(drawn: Sequence[KinematicDiagram], title: str, tongue: Tongue = ENGLISH) -> str:
    """The sheet of these diagrams as SVG text: a column each, and after four columns a new row."""
    rows = [[_Column(diagram, tongue) for diagram in drawn[i : i + COLUMNS]] for i in range(0, len(drawn), COLUMNS)]
    breadth = max(sum(column.width + GAP for column in row) for row in rows) - GAP + 2 * MARGIN
    heights = [HEAD + FOOT + sum(depth + ABOVE + BELOW for depth in _depths(row).values()) for row in rows]
    heads = wrap(sentence_runs(title), TITLE, breadth - 2 * MARGIN)
    height = sum(heights) + GAP * len(rows) + 1.4 * TITLE * len(heads) + 2 * MARGIN
    canvas, top = Canvas(), height - MARGIN - 1.4 * TITLE * len(heads) - GAP
    for k, head in enumerate(heads):
        canvas.text((MARGIN, height - MARGIN - TITLE - 1.4 * TITLE * k), head, TITLE)
    for row, depth in zip(rows, heights, strict=True):
        _draw_row(canvas, row, top)
        top -= depth + GAP
    return canvas.svg(breadth, height, title)


def _depths(row: list[_Column]) -> dict[str, float]:
    """Heights of the diagrams of each kind in a row."""
    return {quantity: max(high - low for low, high in (column.extents[quantity] for column in row))
            for quantity in PLANS}


def _draw_row(canvas: Canvas, row: list[_Column], top: float) -> None:
    """The columns of a row; each kind of diagram begins at one height in all of them."""
    tops, level = dict[str, float](), top - HEAD
    for quantity, depth in _depths(row).items():
        tops[quantity] = level - ABOVE
        level -= ABOVE + BELOW + depth
    left = MARGIN
    for column in row:
        column.draw(canvas, left, top, tops, level)
        left += column.width + GAP


@dataclass(frozen=True, eq=False)
class _Column:
    """The three diagrams of one quantity, its numbers, table of errors and key."""

    diagram: KinematicDiagram
    say: Tongue

    @property
    def length(self) -> float:
        """Length of the abscissa."""
        return float(self.diagram.scales.time.mm(self.diagram.curve.time[-1]))

    @property
    def axis(self) -> float:
        """Distance of the ordinate axis from the left end of the column."""
        return LEFT + float(max(self.diagram.scales.poles.values()))

    @property
    def width(self) -> float:
        return max(self.axis + self.length + RIGHT, NARROWEST)

    @property
    def extents(self) -> dict[str, tuple[float, float]]:
        """The lowest and highest ordinate of each diagram, in mm."""
        return {quantity: self._extent(quantity) for quantity in PLANS}

    def _extent(self, quantity: str) -> tuple[float, float]:
        """Range of a diagram: results and the plans at the divisions; between these the plans' curve is followed a
        little further, then it is cut off."""
        spots = [spot for trace in self.diagram.traces if trace.quantity == quantity
                 for spots_found in self.diagram.points(trace) for spot in spots_found]
        plans = self._plans(quantity)
        ordinates = np.array([0.0, *(y for _, y in spots), *plans[self.diagram.places]])
        low, high = max(np.nanmin(ordinates), -HIGHEST), min(np.nanmax(ordinates), HIGHEST)
        return max(low - BEYOND, min(low, np.nanmin(plans))), min(high + BEYOND, max(high, np.nanmax(plans)))

    def _plans(self, quantity: str) -> Any:
        """The ordinates of the plans at all positions."""
        return self.diagram.scales.ordinates[quantity].mm(self.diagram.curve.values(quantity))

    def _typeset(self, words: str) -> Runs:
        """Words with the letters of quantities, scales and poles set."""
        letters = self.diagram.curve.letters.values()
        names = *letters, *(f"{prefix}_{letter}" for prefix in ("mu", "O", "H") for letter in letters), "mu_t"
        return sentence_runs(words, names)

    def draw(self, canvas: Canvas, left: float, top: float, tops: dict[str, float], bottom: float) -> None:
        """Draw the column from its upper left corner; `tops` are the heights at which the diagrams begin."""
        canvas.text((left, top - HEADING), sentence_runs(self.say(self.diagram.curve.name)), HEADING)
        for quantity in PLANS:
            low, high = self.extents[quantity]
            x, y = left + self.axis, tops[quantity] - high
            room = Rect(left, y + low - BELOW, x + self.length + RIGHT, y + high + BELOW)
            axes = _Axes(canvas, (x, y), room)
            canvas.text((left, tops[quantity] + 7.5), self._heading(quantity))
            self._frame(axes, quantity)
            self._curves(axes, quantity)
            self._rays(axes, quantity)
            for trace in self.diagram.traces:
                for trace_spots in self.diagram.points(trace) if trace.quantity == quantity else ():
                    axes.draw_curve(trace.method, trace_spots)
        self._numbers(canvas, left + self.axis, bottom)
        self._errors(canvas, left, bottom - 16)
        self._key(canvas, left + 88, bottom - 16)

    def _frame(self, axes: _Axes, quantity: str) -> None:
        """Draw both axes with arrowheads, the divisions of the abscissa, and the numbers at its far end."""
        (low, high), end = self.extents[quantity], self.length + 9
        for x in self.diagram.scales.time.mm(self.diagram.curve.time[self.diagram.places]):
            axes.line([(x, low), (x, high)], DIVISION)
        axes.arrow((self.length + 6, 0))
        axes.arrow((0, high + 5), (0, low))
        axes.text(self.length + 4.5, 1.2, "t")
        axes.line([(end, low), (end, high)], AXIS)
        step = 10 if high - low > 25 else 5
        for y in range(step * int(np.ceil(low / step)), int(np.floor(high)) + 1, step):
            axes.line([(end, y), (end + 1, y)], AXIS)
            axes.text(end + 2, y - 0.36 * SIZE, self.say(digits(y * self.diagram.scales.ordinates[quantity].unit)))

    def _heading(self, quantity: str) -> Runs:
        """Caption of a diagram: its quantity, scale, and the distance of its pole."""
        curve, scales = self.diagram.curve, self.diagram.scales
        scale = scales.ordinates[quantity]
        letter, measure, datum = curve.letters[quantity], unit(curve.units[quantity]), scale.datum
        words = [self.say(said("{0} in {1}", letter, measure)),
                 self.say(said("{0} = {1} {2} per mm", f"mu_{letter}", digits(scale.unit), measure))]
        if quantity == "s":
            less = f" {'+' if datum < 0 else '−'} {self.say(digits(abs(datum)))} {self.say(measure)}" if datum else ""
            words[0] = f"{letter} = {self.say(curve.name)}{less}"
        else:
            reach = join((digits(float(scales.poles[quantity])), unit("mm")), " ")
            words.append(f"O_{letter}H_{letter} = {self.say(reach)}")
        plans, (low, high) = self._plans(quantity), self.extents[quantity]
        if np.nanmin(plans) < low or np.nanmax(plans) > high:
            words.append(self.say(said("cut off where it grows without bounds")))
        return self._typeset(",   ".join(words))

    def _by_chords(self, rate: str) -> list[list[Ray[Spot]]]:
        """The rays that gave a rate by chords, stretch by stretch."""
        return [stretch for trace, stretches in self.diagram.traces.items() if trace == (rate, "by chords")
                for stretch in stretches]

    def _rays(self, axes: _Axes, quantity: str) -> None:
        """The pole with the rays that gave this diagram, and chords that give the next, some of them picked out."""
        for ray in _pick_rays(self._by_chords(NEXT.get(quantity, ""))):
            axes.line(_produce_chord(ray.start, ray.end), CHORD)
        if quantity not in self.diagram.scales.poles:
            return
        pole, stretches = (-float(self.diagram.scales.poles[quantity]), 0.0), self._by_chords(quantity)
        for ray in chain(*stretches):
            axes.line([pole, ray.cut], RAY)
        for ray in _pick_rays(stretches):
            axes.line([pole, ray.cut], CHORD)
            axes.line([ray.cut, ray.ordinate], LEVEL)
        axes.mark(CIRCLE, pole, 1.0, POLE)
        axes.text(pole[0] - 1.5, -0.36 * SIZE, self._typeset(f"H_{self.diagram.curve.letters[quantity]}"), "end")

    def _curves(self, axes: _Axes, quantity: str) -> None:
        """The steps of the chords' rates, each cut off at the end of the period, and over them the curve of the plans,
        each stretch by itself."""
        for stretch in self._by_chords(quantity):
            ends = [((max(ray.start[0], 0.0), min(ray.end[0], self.length)), ray.ordinate[1]) for ray in stretch]
            axes.line([(x, y) for strip, y in ends for x in strip], STEP)
        curve, scales = self.diagram.curve, self.diagram.scales
        for times in self._smooth():
            ordinates = scales.ordinates[quantity].mm(curve.values_at(quantity, times))
            axes.line(zip(scales.time.mm(times), ordinates, strict=True), PLANS[quantity])

    def _smooth(self) -> Iterable[Any]:
        """The times of each stretch of positions, close enough for a smooth curve."""
        time = self.diagram.curve.time
        between = -(-SMOOTH // len(time))
        for stretch in self.diagram.curve.stretches(np.arange(len(time))):
            yield np.interp(np.arange(between * (len(stretch) - 1) + 1) / between, stretch - stretch[0], time[stretch])

    def _numbers(self, canvas: Canvas, axis: float, level: float) -> None:
        """The numbers of the divisions and the drive's travel at them, as many as have room; the scale of time."""
        curve, scales, places = self.diagram.curve, self.diagram.scales, self.diagram.places
        xs, angle = scales.time.mm(curve.time[places]), curve.travel_unit == "rad"
        travel = np.degrees(curve.travel[places]) if angle else curve.travel[places]
        drive = said("drive") if angle else join((said("drive"), unit(curve.travel_unit)))
        rows = {said("position"): [str(k) for k in range(len(xs))],
                drive: [self.say(digits(value)) + ("°" if angle else "") for value in travel]}
        for y, (heading, words) in zip((level - 3, level - 3 - LINE), rows.items(), strict=True):
            canvas.text((axis - 8, y), sentence_runs(self.say(heading)), anchor="end")
            room = max(width((TextRun(word),), SIZE) for word in words) + 0.7 * SIZE
            for x, word in list(zip(xs, words, strict=True))[:: int(np.ceil(room * (len(xs) - 1) / self.length))]:
                canvas.text((axis + x, y), (TextRun(word),), anchor="middle")
        whole = digits(float(curve.time[-1] - curve.time[0]))
        scale = said("{0} = {1} {2} per mm", "mu_t", digits(scales.time.unit), unit("s"))
        length = join((digits(self.length), unit("mm")), " "), join((whole, unit("s")), " ")
        canvas.text((axis, level - 3 - 2 * LINE), self._typeset(self.say(join((scale, said("{0} are {1}", *length))))))

    def _errors(self, canvas: Canvas, left: float, level: float) -> None:
        """Draw the table of errors against the plans, in parts of the largest ordinate."""
        table = [[self.say(head) for head in (said("errors in %"), said("largest"), said("rms"), said("order"))]]
        for error in self.diagram.errors:
            letter, name = self.diagram.curve.letters[error.curve.quantity], METHODS[error.curve.method][0]
            order = "–" if error.order is None else self.say(digits(round(error.order, 2)))
            sizes = [self.say(digits(100 * size, 2)) for size in (error.largest, error.rms)]
            table.append([f"{letter} {self.say(name())}", *sizes, order])
        table.append([self.say(said("of the plans' largest ordinate at the same abscissas"))])
        for k, row in enumerate(table, 1):
            for stop, word in zip((0.0, 46.0, 60.0, 74.0), row, strict=False):
                canvas.text((left + stop, level - k * LINE), self._typeset(word), anchor="end" if stop else "start")
        canvas.line([(left, level - LINE - 1.2), (left + 74.0, level - LINE - 1.2)], AXIS)

    def _key(self, canvas: Canvas, left: float, level: float) -> None:
        """Draw the key of lines and marks in use."""
        methods_drawn = {trace.method for trace in self.diagram.traces}
        methods = {method: meaning() for method, (_, meaning, *_) in METHODS.items() if method in methods_drawn}
        meanings = {"": said("from the plans"), **methods, "chord": said("a chord, and the ray parallel to it")}
        for k, (method, meaning) in enumerate(meanings.items(), 1):
            axes = _Axes(canvas, (left, level - k * LINE + 0.36 * SIZE), Rect(left, 0.0, left + 10, level))
            ends = [(0.0, 0.0), (8.0, 0.0)]
            if method in methods:
                axes.draw_curve(method, ends if method == "integrated" else [(4.0, 0.0)])
            else:
                axes.line(ends, CHORD if method else PLANS["s"])
            canvas.text((left + 10, level - k * LINE), sentence_runs(self.say(meaning)))


def _pick_rays(stretches: list[list[Ray[Spot]]]) -> list[Ray[Spot]]:
    """Pick a few rays to show, evenly spread."""
    rays = list(chain(*stretches))
    return rays[1 :: max(1, len(rays) // SHOWN)][:SHOWN]


def _produce_chord(start: Spot, end: Spot) -> list[Spot]:
    """A chord, produced at both ends so that it can be told from its curve."""
    x, y = np.subtract(end, start) * PRODUCED / np.hypot(*np.subtract(end, start))
    return [(start[0] - x, start[1] - y), (end[0] + x, end[1] + y)]


@dataclass(frozen=True)
class _Axes:
    """The place of a diagram: all is counted from its origin, and cut off at the edges of its room."""

    canvas: Canvas
    origin: Spot
    room: Rect

    def _spot_on_paper(self, spot: Spot) -> Spot:
        return self.origin[0] + spot[0], self.origin[1] + spot[1]

    def line(self, spots: Iterable[Spot], pen: Pen) -> None:
        self.canvas.line(map(self._spot_on_paper, spots), pen, self.room)

    def mark(self, mark: str, spot: Spot, size: float, pen: Pen) -> None:
        if self.room.holds(self._spot_on_paper(spot)):
            self.canvas.mark(mark, self._spot_on_paper(spot), size, pen)

    def arrow(self, end: Spot, start: Spot = (0.0, 0.0)) -> None:
        self.canvas.items.append(Arrow(AXIS, LAYER, None, self._spot_on_paper(start), self._spot_on_paper(end), 2.6))

    def text(self, x: float, y: float, words: str | Runs, anchor: str = "start") -> None:
        self.canvas.text(self._spot_on_paper((x, y)), (TextRun(words),) if isinstance(words, str) else words,
                         anchor=anchor)

    def draw_curve(self, method: str, spots: Iterable[Spot]) -> None:
        """The points that a method found, or the line through them."""
        *_, mark, size, pen = METHODS[method]
        if not mark:
            self.line(spots, pen)
        for spot in spots if mark else ():
            self.mark(mark, spot, size, pen)
