"""Kinematic diagrams as SVG text: displacement, velocity and acceleration one under the other, over one abscissa.

Everything is drawn in mm of paper on a single pair of axes that covers the sheet, as a draughtsman would: matplotlib
gives lines and lettering, and is imported here and nowhere else. The same diagrams are the same text.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from graphplan.phrases import joined, phrase, said, unit
from graphplan.sheet.layout.scales import digits
from graphplan.sheet.lettering.lettering import FONTS, Run, Runs, name_runs, sentence_runs, width
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, INK, PAPER, RED, VIOLET, Pen
from graphplan.words.tongue import ENGLISH, Tongue

if TYPE_CHECKING:
    from graphplan.cycle.chords import Ray
    from graphplan.cycle.diagram_program import Spot
    from graphplan.cycle.diagrams import Diagram

POINTS = 72 / 25.4  # typographic points in a mm
SIZE, HEADING, TITLE = 2.5, 3.5, 5.0  # letters, in mm
LINE = 4.2  # from one line of lettering to the next
MARGIN, GAP = 10.0, 10.0  # around the sheet, between columns and rows
LEFT, RIGHT, ABOVE, BELOW = 10.0, 26.0, 13.0, 5.0  # free room left of a pole, for readings, over and under a diagram
HEAD, FOOT = 6.0, 50.0  # a column's heading; its numbers, table and key
NARROWEST = 150.0  # a column: the table and the key stand side by side
COLUMNS, SMOOTH = 4, 360  # columns in a row; points of a smooth curve
HIGHEST, BEYOND = 75.0, 12.0  # the highest ordinate in mm, and how far beyond those at the divisions a curve is drawn
SHOWN, PRODUCED = 3, 8.0  # chords that are picked out, and by how many mm they are produced

AXIS, DIVISION, RAY, STEP = Pen(0.18), Pen(0.13, "#c4c4c4"), Pen(0.13, GREY), Pen(0.18, GREY)
CHORD, LEVEL, BACK = Pen(0.25, GREEN), Pen(0.18, GREEN, (1.6, 0.8)), Pen(0.35, VIOLET, (2.0, 1.0))
DOT, CROSS, POLE = Pen(0.2, fill=PAPER), Pen(0.25), Pen(0.2, fill=INK)
PLANS = {"s": Pen(0.35), "v": Pen(0.35, BLUE), "a": Pen(0.35, RED)}
NEXT = dict(pairwise(PLANS))  # the rate that each diagram's chords give
SETTINGS: Any = {"svg.hashsalt": "graphplan", "svg.fonttype": "none", "mathtext.fontset": "dejavusans",
                 "font.family": "sans-serif", "font.sans-serif": [font.strip(" '") for font in FONTS.split(",")]}


def diagrams(drawn: Sequence[Diagram], title: str, tongue: Tongue = ENGLISH) -> str:
    """The sheet of these diagrams as SVG text: a column each, and after four columns a new row."""
    rows = [[_Column(one, tongue) for one in drawn[i : i + COLUMNS]] for i in range(0, len(drawn), COLUMNS)]
    breadth = max(sum(column.width + GAP for column in row) for row in rows) - GAP + 2 * MARGIN
    heights = [_row_height(row) for row in rows]
    height = sum(heights) + GAP * len(rows) + TITLE + 2 * MARGIN
    with matplotlib.rc_context(SETTINGS):
        ink = _Ink(breadth, height)
        ink.text(MARGIN, height - MARGIN - TITLE, _set(sentence_runs(title)), TITLE)
        top = height - MARGIN - TITLE - GAP
        for row, depth in zip(rows, heights, strict=True):
            _draw_row(ink, row, top)
            top -= depth + GAP
        return ink.svg(title)


def _row_height(row: list[_Column]) -> float:
    return HEAD + FOOT + sum(max(column.depth(q) for column in row) + ABOVE + BELOW for q in PLANS)


def _draw_row(ink: _Ink, row: list[_Column], top: float) -> None:
    """The columns side by side; each kind of diagram begins at one height in all of them."""
    tops, level = dict[str, float](), top - HEAD
    for quantity in PLANS:
        tops[quantity] = level - ABOVE
        level -= ABOVE + BELOW + max(column.depth(quantity) for column in row)
    left = MARGIN
    for column in row:
        column.draw(ink, left, top, tops, level)
        left += column.width + GAP


class _Column:
    """The three diagrams of one quantity, its numbers, table of errors and key."""

    def __init__(self, diagram: Diagram, tongue: Tongue):
        self.diagram, self.curve, self.scales, self.say = diagram, diagram.curve, diagram.scales, tongue
        self.name = tongue(self.curve.name)
        self.length = float(self.scales.x(self.curve.time[-1]))
        self.axis = LEFT + float(max(self.scales.poles.values()))  # where the ordinates begin
        self.width = max(self.axis + self.length + RIGHT, NARROWEST)
        self.extents = {quantity: self._extent(quantity) for quantity in PLANS}

    def _extent(self, quantity: str) -> tuple[float, float]:
        """The lowest and highest ordinate of a diagram, in mm: what was found and the plans at the divisions count;
        between these the plans' curve is followed a little further, then it is cut off."""
        spots = [spot for found in self.diagram.traces if found.quantity == quantity
                 for part in self.diagram.points(found) for spot in part]
        plans = self.scales.y(quantity, self.curve.values(quantity))
        held = np.array([0.0, *(y for _, y in spots), *plans[self.diagram.places]])
        low, high = max(np.nanmin(held), -HIGHEST), min(np.nanmax(held), HIGHEST)
        return max(low - BEYOND, min(low, np.nanmin(plans))), min(high + BEYOND, max(high, np.nanmax(plans)))

    def _cut_off(self, quantity: str) -> bool:
        plans, (low, high) = self.scales.y(quantity, self.curve.values(quantity)), self.extents[quantity]
        return bool(np.nanmin(plans) < low or np.nanmax(plans) > high)

    def depth(self, quantity: str) -> float:
        """How high a diagram is."""
        low, high = self.extents[quantity]
        return high - low

    def draw(self, ink: _Ink, left: float, top: float, tops: dict[str, float], bottom: float) -> None:
        """Draw the column from its upper left corner; `tops` are the heights at which the diagrams begin."""
        ink.text(left, top - HEADING, _set(sentence_runs(self.name)), HEADING)
        origins = {q: (left + self.axis, tops[q] - self.extents[q][1]) for q in PLANS}
        for quantity, origin in origins.items():
            self._axes(ink, quantity, origin)
            self._heading(ink, quantity, left, tops[quantity] + 7.5)
        for quantity, origin in origins.items():
            with ink.within(origin, self._room(quantity)):
                self._curves(ink, quantity, origin)
                self._rays(ink, quantity, origin)
                self._marks(ink, quantity, origin)
        self._numbers(ink, left + self.axis, bottom)
        self._errors(ink, left, bottom - 16)
        _key(ink, left + 88, bottom - 16, {found.method for found in self.diagram.traces}, self.say)

    def _axes(self, ink: _Ink, quantity: str, origin: Spot) -> None:
        """Both axes with arrowheads, the divisions of the abscissa, and the readings at its far end."""
        (low, high), end = self.extents[quantity], self.length + 9
        for x in self.scales.x(self.curve.time[self.diagram.places]):
            ink.line(origin, [(x, low), (x, high)], DIVISION)
        ink.arrow(origin, (0, 0), (self.length + 6, 0))
        ink.arrow(origin, (0, low), (0, high + 5))
        ink.text(origin[0] + self.length + 4.5, origin[1] + 1.2, "$t$", SIZE)
        ink.line(origin, [(end, low), (end, high)], AXIS)
        step = 10 if high - low > 25 else 5
        for y in range(step * int(np.ceil(low / step)), int(np.floor(high)) + 1, step):
            ink.line(origin, [(end, y), (end + 1, y)], AXIS)
            reading = digits(y * float(self.scales.mu[quantity]))
            ink.text(origin[0] + end + 2, origin[1] + y - 0.36 * SIZE, reading, SIZE)

    def _heading(self, ink: _Ink, quantity: str, left: float, level: float) -> None:
        """What a diagram shows, its scale, and the distance of its pole."""
        letter, measure = _name(self.curve.letters[quantity]), unit(self.curve.units[quantity])
        scale = _name(f"mu_{self.curve.letters[quantity]}"), digits(float(self.scales.mu[quantity]))
        words = [self.say(said("{0} in {1}", letter, measure)), self.say(said("{0} = {1} {2} per mm", *scale, measure))]
        if quantity == "s":
            datum = self.scales.datum
            less = f" {'+' if datum < 0 else '−'} {digits(abs(datum))} {self.say(measure)}" if datum else ""
            words[0] = f"{letter} = {_set(sentence_runs(self.name))}{less}"
        else:
            pole = "".join(_name(f"{point}_{self.curve.letters[quantity]}") for point in "OH")
            reach = joined((digits(float(self.scales.poles[quantity])), unit("mm")), " ")
            words.append(f"{pole} = {self.say(reach)}")
        if self._cut_off(quantity):
            words.append(self.say(said("cut off where it grows without bounds")))
        ink.text(left, level, ",   ".join(words), SIZE)

    def _room(self, quantity: str) -> tuple[Spot, Spot]:
        """The corners of a diagram, beyond which its lines are cut off."""
        low, high = self.extents[quantity]
        return (-self.axis, low - BELOW), (self.length + BELOW, high + BELOW)

    def _by_chords(self, rate: str) -> list[Ray[Spot]]:
        return [ray for found, parts in self.diagram.traces.items() if found == (rate, "by chords")
                for part in parts for ray in part]

    def _rays(self, ink: _Ink, quantity: str, origin: Spot) -> None:
        """The pole with the rays that gave this diagram, and chords that give the next, some of them picked out."""
        for ray in _picked(self._by_chords(NEXT.get(quantity, ""))):
            ink.line(origin, _produced(ray.start, ray.end), CHORD)
        if quantity not in self.scales.poles:
            return
        pole, rays = (-float(self.scales.poles[quantity]), 0.0), self._by_chords(quantity)
        for ray in rays:
            ink.line(origin, [pole, ray.cut], RAY)
        for ray in _picked(rays):
            ink.line(origin, [pole, ray.cut], CHORD)
            ink.line(origin, [ray.cut, ray.ordinate], LEVEL)
        ink.marks(origin, [pole], "o", POLE, 1.0)
        letter = _name(f"H_{self.curve.letters[quantity]}")
        ink.text(origin[0] + pole[0] - 1.5, origin[1] - 0.36 * SIZE, letter, SIZE, "right")

    def _curves(self, ink: _Ink, quantity: str, origin: Spot) -> None:
        """The steps of the chords' rates and over them the curve of the plans, each stretch by itself."""
        for parts in (parts for found, parts in self.diagram.traces.items() if found == (quantity, "by chords")):
            for part in parts:
                steps = [(x, ray.ordinate[1]) for ray in part for x in self._strip(ray.start, ray.end)]
                ink.line(origin, steps, STEP)
        for times in self._smooth():
            values = self.curve.at(quantity, times)
            ink.line(origin, zip(self.scales.x(times), self.scales.y(quantity, values), strict=True), PLANS[quantity])

    def _marks(self, ink: _Ink, quantity: str, origin: Spot) -> None:
        """The points that were found, over all lines."""
        for found in self.diagram.traces:
            for part in self.diagram.points(found) if found.quantity == quantity else ():
                _FOUND[found.method](ink, origin, part)

    def _strip(self, start: Spot, end: Spot) -> tuple[float, float]:
        """From where to where a chord holds; one over the end of the period is cut off there."""
        return max(start[0], 0.0), min(end[0], self.length)

    def _smooth(self) -> Iterable[Any]:
        """The times of each stretch of positions, close enough for a smooth curve."""
        positions = np.arange(len(self.curve.time))
        between = -(-SMOOTH // len(positions))
        for part in self.curve.stretches(positions):
            yield np.interp(np.arange(between * (len(part) - 1) + 1) / between, part - part[0], self.curve.time[part])

    def _numbers(self, ink: _Ink, axis: float, level: float) -> None:
        """The numbers of the divisions and the drive's travel at them, as many as have room; the scale of time."""
        places = self.diagram.places
        xs = axis + self.scales.x(self.curve.time[places])
        angle = self.curve.travel_unit == "rad"
        travel = np.degrees(self.curve.travel[places]) if angle else self.curve.travel[places]
        readings = [digits(value) + ("°" if angle else "") for value in travel]
        for words, line in (([str(k) for k in range(len(xs))], 0.0), (readings, LINE)):
            room = max(width((Run(word),), SIZE) for word in words) + 0.7 * SIZE
            for x, word in list(zip(xs, words, strict=True))[:: int(np.ceil(room * (len(xs) - 1) / self.length))]:
                ink.text(x, level - 3 - line, word, SIZE, "center")
        drive = said("drive") if angle else joined((said("drive"), unit(self.curve.travel_unit)))
        ink.text(axis - 8, level - 3, self.say(said("position")), SIZE, "right")
        ink.text(axis - 8, level - 3 - LINE, self.say(drive), SIZE, "right")
        whole = digits(float(self.curve.time[-1] - self.curve.time[0]))
        scale = said("{0} = {1} {2} per mm", _name("mu_t"), digits(float(self.scales.mu_t)), unit("s"))
        length = joined((digits(self.length), unit("mm")), " "), joined((whole, unit("s")), " ")
        ink.text(axis, level - 3 - 2 * LINE, self.say(joined((scale, said("{0} are {1}", *length)))), SIZE)

    def _errors(self, ink: _Ink, left: float, level: float) -> None:
        """How far what was found is from the plans, in parts of the largest ordinate."""
        stops = (0.0, 46.0, 60.0, 74.0)
        heads = said("errors in %"), said("largest"), said("rms"), said("order")
        rows = [tuple(map(self.say, heads))]
        for error in self.diagram.errors:
            what = f"{_name(self.curve.letters[error.found.quantity])} {self.say(METHODS[error.found.method]())}"
            order = "–" if error.order is None else digits(round(error.order, 2))
            rows.append((what, digits(100 * error.largest, 2), digits(100 * error.rms, 2), order))
        for k, row in enumerate(rows):
            for stop, word in zip(stops, row, strict=True):
                ink.text(left + stop, level - (k + 1) * LINE, word, SIZE, "right" if stop else "left")
        ink.line((left, level - LINE - 1.2), [(0, 0), (stops[-1], 0)], AXIS)
        told = self.say(said("of the plans' largest ordinate at the same abscissas"))
        ink.text(left, level - (len(rows) + 1.2) * LINE, told, SIZE)


def _picked(rays: list[Ray[Spot]]) -> list[Ray[Spot]]:
    """Some rays, far from each other."""
    return rays[1 :: max(1, len(rays) // SHOWN)][:SHOWN]


def _produced(start: Spot, end: Spot) -> list[Spot]:
    """A chord, produced at both ends so that it can be told from its curve."""
    x, y = np.subtract(end, start) * PRODUCED / np.hypot(*np.subtract(end, start))
    return [(start[0] - x, start[1] - y), (end[0] + x, end[1] + y)]


def _dots(ink: _Ink, origin: Spot, part: list[Spot]) -> None:
    ink.marks(origin, part, "o", DOT, 1.2)


def _crosses(ink: _Ink, origin: Spot, part: list[Spot]) -> None:
    ink.marks(origin, part, "x", CROSS, 1.3)


def _dashes(ink: _Ink, origin: Spot, part: list[Spot]) -> None:
    ink.line(origin, part, BACK)


METHODS = {"by chords": phrase("by chords"), "by tangents": phrase("by tangents"), "integrated": phrase("integrated")}
MEANINGS = {
    "by chords": phrase("by chords, in the middle of each"), "by tangents": phrase("by tangents, at the division"),
    "integrated": phrase("integrated, from a by v to s"),
}  # fmt: skip
_FOUND = {"by chords": _dots, "by tangents": _crosses, "integrated": _dashes}


def _key(ink: _Ink, left: float, level: float, methods: set[str], say: Tongue) -> None:
    """What each kind of line and mark says, of those that are drawn."""
    spot, words = (left, level - LINE + 0.36 * SIZE), [said("from the plans")]
    ink.line(spot, [(0, 0), (8, 0)], PLANS["s"])
    for method, meaning in MEANINGS.items():
        if method in methods:
            mark = [(0.0, 0.0), (8.0, 0.0)] if method == "integrated" else [(4.0, 0.0)]
            _FOUND[method](ink, (left, spot[1] - len(words) * LINE), mark)
            words.append(meaning())
    ink.line((left, spot[1] - len(words) * LINE), [(0, 0), (8, 0)], CHORD)
    for k, told in enumerate([*words, said("a chord, and the ray parallel to it")], 1):
        ink.text(left + 10, level - k * LINE, say(told), SIZE)


class _Ink:
    """A sheet in mm: lines, marks, arrows and lettering with the pens' widths."""

    def __init__(self, width: float, height: float):
        self.figure = Figure(figsize=(width / 25.4, height / 25.4))
        FigureCanvasSVG(self.figure)
        self.axes = self.figure.add_axes((0, 0, 1, 1))
        self.axes.set(xlim=(0, width), ylim=(0, height))
        self.axes.axis("off")
        self.edge = self.axes.patch

    @contextmanager
    def within(self, origin: Spot, corners: tuple[Spot, Spot]) -> Iterator[None]:
        """Cut lines and marks off at the edges of a rectangle, its corners counted from an origin."""
        (left, bottom), (right, top) = corners
        self.edge = Rectangle((origin[0] + left, origin[1] + bottom), right - left, top - bottom,
                              transform=self.axes.transData)
        yield
        self.edge = self.axes.patch

    def line(self, origin: Spot, spots: Iterable[Spot], pen: Pen) -> None:
        """A line through spots counted from an origin."""
        dashes = {"dashes": [part / pen.width for part in pen.dash]} if pen.dash else {}
        self._plot(origin, spots, color=pen.colour, linewidth=pen.width * POINTS, solid_capstyle="round",
                   solid_joinstyle="round", **dashes)

    def marks(self, origin: Spot, spots: Iterable[Spot], marker: str, pen: Pen, size: float) -> None:
        """Marks of a size in mm at spots counted from an origin."""
        self._plot(origin, spots, marker=marker, linestyle="", markersize=size * POINTS, markeredgecolor=pen.colour,
                   markerfacecolor=pen.fill, markeredgewidth=pen.width * POINTS)

    def _plot(self, origin: Spot, spots: Iterable[Spot], **look: Any) -> None:
        xs, ys = np.array(list(spots), dtype=float).T
        for line in self.axes.plot(xs + origin[0], ys + origin[1], **look):
            line.set_clip_path(self.edge)

    def arrow(self, origin: Spot, start: Spot, end: Spot) -> None:
        """An axis with its arrowhead."""
        (x, y), (u, v) = start, end
        size = float(np.hypot(u - x, v - y))
        along, across = ((u - x) / size, (v - y) / size), (-(v - y) / size, (u - x) / size)
        head = [(u - 2.6 * along[0] + side * across[0], v - 2.6 * along[1] + side * across[1]) for side in (0.5, -0.5)]
        self.line(origin, [start, (u - 2.6 * along[0], v - 2.6 * along[1])], AXIS)
        xs, ys = np.array([end, *head]).T
        self.axes.fill(xs + origin[0], ys + origin[1], color=AXIS.colour, linewidth=0)

    def text(self, x: float, y: float, words: str, size: float, align: str = "left") -> None:
        """Lettering on a base line."""
        self.axes.text(x, y, words, fontsize=size * POINTS, ha=align, va="baseline", color=INK)

    def svg(self, title: str) -> str:
        """The sheet as SVG text, the same whenever it is written."""
        text = io.StringIO()
        self.figure.savefig(text, format="svg", metadata={"Date": None, "Creator": "graphplan", "Title": title})
        return text.getvalue()


def _name(name: str) -> str:
    return _set(name_runs(name))


def _set(runs: Runs) -> str:
    """Lettering as matplotlib sets it."""
    texts = [run.text.replace("$", r"\$") for run in runs]
    return "".join(f"$_{{\\mathrm{{{text}}}}}$" if run.level else text for run, text in zip(runs, texts, strict=True))
