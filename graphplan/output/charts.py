"""Charts as SVG text: small pictures of one size side by side, a key below them, everything in mm of paper.

The data come as pictures that know what stands where and how it looks; here they meet the paper. The same picture is
the same text.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from graphplan.output.plots import DIVISION, LINE, MARGIN, POINTS, SETTINGS, SIZE, TITLE
from graphplan.sheet.layout.scales import digits
from graphplan.sheet.lettering.lettering import Run, plain, width, wrap
from graphplan.sheet.plates.pens import GREY, INK, PAPER

if TYPE_CHECKING:
    from graphplan.accuracy.survey.picture import Axis, Chart, Look, Panel, Place, Rail, Series

SMALL = 2.2  # letters at the axes, in mm
LEFT, RIGHT, ABOVE, BELOW = 19.0, 5.0, 8.0, 13.0  # around a picture: readings and labels
RAIL, BESIDE = 2.6, 1.8  # mm from rail to rail, and from the numbers to the first
ROOM = 0.06  # of the numbers' range, left free at both ends
KEY, SAMPLE = 5.0, 9.0  # from line to line of the key; the length of its samples
READINGS = (8, 5)  # at most, along the first and the second axis


def drawn(chart: Chart) -> str:
    """The chart as SVG text."""
    with matplotlib.rc_context(SETTINGS):
        sheet = _Sheet(chart)
        for k, panel in enumerate(chart.panels):
            _draw(sheet, panel, *sheet.corner(k))
        return sheet.svg()


class _Sheet:
    """The paper: title and remarks at the top, the key at the foot, and room for every picture between them."""

    def __init__(self, chart: Chart):
        self.chart, (self.wide, self.high) = chart, chart.size
        rows = math.ceil(len(chart.panels) / chart.columns)
        self.width = 2 * MARGIN + chart.columns * (LEFT + self.wide + RIGHT)
        remarks = [plain(line) for line in wrap((Run(chart.remarks),), SIZE, self.width - 2 * MARGIN)]
        keys = list(self._rows(chart.key))
        self.head = MARGIN + TITLE + 3 + LINE * len(remarks)
        foot = 4 + KEY * len(keys) + MARGIN
        self.height = self.head + rows * (ABOVE + self.high + BELOW) + foot
        self.figure = Figure(figsize=(self.width / 25.4, self.height / 25.4))
        FigureCanvasSVG(self.figure)
        self.paper: Any = self.figure.add_axes((0, 0, 1, 1))
        self.paper.set(xlim=(0, self.width), ylim=(0, self.height))
        self.paper.axis("off")
        self.text(MARGIN, self.height - MARGIN - TITLE, chart.title, TITLE)
        for k, line in enumerate(remarks, 1):
            self.text(MARGIN, self.height - MARGIN - TITLE - 1.5 - k * LINE, line)
        for k, row in enumerate(keys):
            self._key(row, foot - 4 - k * KEY)

    def corner(self, k: int) -> tuple[float, float]:
        """The lower left corner of a picture's axes."""
        row, column = divmod(k, self.chart.columns)
        top = self.height - self.head - row * (ABOVE + self.high + BELOW)
        return MARGIN + column * (LEFT + self.wide + RIGHT) + LEFT, top - ABOVE - self.high

    def axes(self, left: float, bottom: float) -> Any:
        """A picture's axes."""
        box = left / self.width, bottom / self.height, self.wide / self.width, self.high / self.height
        return self.figure.add_axes(box)

    def text(self, x: float, y: float, words: str, size: float = SIZE, align: str = "left") -> None:
        """Lettering on a base line."""
        self.paper.text(x, y, words, fontsize=size * POINTS, ha=align, va="baseline", color=INK)

    def _rows(self, key: Iterable[tuple[str, Look]]) -> Iterator[list[tuple[float, str, Look]]]:
        """The key in rows, each entry with its place in the row."""
        row: list[tuple[float, str, Look]] = []
        at = MARGIN
        for words, look in key:
            wide = SAMPLE + 2 + width((Run(words),), SIZE) + 6
            if row and at + wide > self.width - MARGIN:
                yield row
                row, at = [], MARGIN
            row.append((at, words, look))
            at += wide
        if row:
            yield row

    def _key(self, row: list[tuple[float, str, Look]], level: float) -> None:
        for at, words, look in row:
            middle = level + 0.36 * SIZE
            if look.area:
                _fill(self.paper, (at, middle - 1.3), SAMPLE, 2.6, look)
            else:
                if look.width:
                    _stroke(self.paper, [at, at + SAMPLE], [middle] * 2, look)
                _mark(self.paper, [at + SAMPLE / 2], [middle], look)
            self.text(at + SAMPLE + 2, level, words)

    def svg(self) -> str:
        """The sheet as SVG text, the same whenever it is written."""
        text = io.StringIO()
        about = {"Date": None, "Creator": "graphplan", "Title": self.chart.title}
        self.figure.savefig(text, format="svg", metadata=about)
        return text.getvalue()


class _Scale:
    """Where the places of an axis are, in the units of its drawing; numbers first, rails beside them."""

    def __init__(self, axis: Axis, places: Iterable[Place], length: float, readings: int):
        self.axis, self.readings = axis, readings
        numbers = [self._plain(place) for place in places if not isinstance(place, str)]
        low, high = min(numbers, default=0.0), max(numbers, default=0.0)
        room = ROOM * (high - low) or (0.1 if numbers else 0.0)  # one number alone stands in the middle
        self.low, self.high = low - room, high + room
        beside = [(BESIDE if numbers else 0.0) + RAIL * len(rails) if rails else 0.0
                  for rails in (axis.before, axis.after)]
        self.mm = (self.high - self.low) / (length - sum(beside)) or 1.0 / RAIL
        self.limits = self.low - beside[0] * self.mm, self.high + beside[1] * self.mm
        self.step = RAIL * self.mm
        self.rails = {rail.name: self.limits[0] + self.step * (k + 0.5) for k, rail in enumerate(axis.before)}
        self.rails |= {rail.name: self.limits[1] - self.step * (k + 0.5) for k, rail in enumerate(axis.after)}
        self.edges = [edge for edge, rails in ((self.low, axis.before), (self.high, axis.after)) if rails and numbers]

    def __call__(self, place: Place) -> float:
        return self.rails[place] if isinstance(place, str) else self._plain(place)

    def _plain(self, number: float) -> float:
        value = math.log10(number) if self.axis.log else number
        return -value if self.axis.falling else value

    def ticks(self) -> list[tuple[float, str]]:
        """Readings along the axis, rails by their labels."""
        rails: tuple[Rail, ...] = (*self.axis.before, *self.axis.after)
        return [*self._numbers(), *((self.rails[rail.name], rail.label) for rail in rails if rail.label)]

    def _numbers(self) -> list[tuple[float, str]]:
        """Readings between the ends: decades, or steps that are told, or round numbers as far as there is room."""
        if self.high == self.low:
            return []
        low, high = sorted(-end if self.axis.falling else end for end in (self.low, self.high))
        if self.axis.log and high - low >= 2:
            exponents = range(math.ceil(low), math.floor(high) + 1)
            every = math.ceil(len(exponents) / self.readings)
            return [(-k if self.axis.falling else k, _power(k)) for k in exponents if k % every == 0]
        if self.axis.step:
            steps = range(math.ceil(low / self.axis.step), math.floor(high / self.axis.step) + 1)
            return [(self._plain(k * self.axis.step), digits(k * self.axis.step)) for k in steps]
        return self._round(*(10**low, 10**high) if self.axis.log else (low, high))

    def _round(self, low: float, high: float) -> list[tuple[float, str]]:
        """Round numbers, without those whose readings would run into the one before."""
        kept: list[tuple[float, str]] = []
        for number in MaxNLocator(self.readings, steps=[1, 2, 5, 10]).tick_values(low, high):
            if low <= number <= high:
                place, label = self._plain(float(number)), digits(float(number))
                if not kept or abs(place - kept[-1][0]) > (width((Run(label),), SMALL) + 1.5) * self.mm:
                    kept.append((place, label))
        return kept


def _power(k: int) -> str:
    return digits(10.0**k) if -2 <= k <= 3 else f"$10^{{{k}}}$"


def _draw(sheet: _Sheet, panel: Panel, left: float, bottom: float) -> None:
    """One picture: frame and divisions, bands, lines, then marks over them."""
    axes = sheet.axes(left, bottom)
    spots = [spot for series in panel.series for spot in (*series.spots, *(end for pair in series.spreads
                                                                          for end in pair))]
    x = _Scale(panel.x, [*(a for a, _ in spots), *(end for b in panel.bands for end in (b.start, b.end))],
               sheet.wide, READINGS[0])
    y = _Scale(panel.y, [b for _, b in spots], sheet.high, READINGS[1])
    _frame(axes, panel, x, y)
    sheet.text(left, bottom + sheet.high + 2.0, panel.title)
    for band in panel.bands:
        _fill(axes, (x(band.start), y(band.rail) - 0.4 * y.step), x(band.end) - x(band.start), 0.8 * y.step, band.look)
    for series in panel.series:
        _line(axes, series, x, y)
    for series in panel.series:
        _mark(axes, [x(a) for a, _ in series.spots], [y(b) for _, b in series.spots], series.look)


def _frame(axes: Any, panel: Panel, x: _Scale, y: _Scale) -> None:
    """The axes with their readings; thin divisions, and a line where numbers end and rails begin."""
    axes.set(xlim=x.limits, ylim=y.limits)
    for scale, axis in ((x, axes.xaxis), (y, axes.yaxis)):
        places, labels = zip(*scale.ticks(), strict=True)
        axis.set_ticks(places, labels=labels)
        axis.set_tick_params(length=0.8 * POINTS, width=0.18 * POINTS, labelsize=SMALL * POINTS, pad=0.8 * POINTS)
        axis.grid(True, linewidth=DIVISION.width * POINTS, color=DIVISION.colour)
        axis.set_label_text(scale.axis.label, fontsize=SMALL * POINTS)
        axis.labelpad = 1.0 * POINTS
    for spine in axes.spines.values():
        spine.set(linewidth=0.18 * POINTS, color=INK)
    for edge in x.edges:
        axes.axvline(edge, linewidth=0.18 * POINTS, color=GREY)
    for edge in y.edges:
        axes.axhline(edge, linewidth=0.18 * POINTS, color=GREY)
    axes.set_axisbelow(True)


def _line(axes: Any, series: Series, x: _Scale, y: _Scale) -> None:
    """The line of a series, broken where it goes over a rail, and the spreads of its spots."""
    look = series.look
    for (a, b), ((left, low), (right, high)) in zip(series.spots, series.spreads, strict=bool(series.spreads)):
        for xs, ys in (((left, right), (b, b)), ((a, a), (low, high))):
            axes.plot([x(one) for one in xs], [y(one) for one in ys], color=look.colour, linewidth=0.18 * POINTS)
    if not look.width:
        return
    part: list[tuple[float, float]] = []
    for a, b in (*series.spots, ("", "")):
        if isinstance(a, str) or isinstance(b, str):
            if len(part) > 1:
                _stroke(axes, [a for a, _ in part], [b for _, b in part], look)
            part = []
        else:
            part.append((x(a), y(b)))


def _stroke(axes: Any, xs: Any, ys: Any, look: Look) -> None:
    dashes = {"dashes": [part / look.width for part in look.dash]} if look.dash else {}
    axes.plot(xs, ys, color=look.colour, linewidth=look.width * POINTS, solid_capstyle="round",
              drawstyle="steps-post" if look.steps else "default", **dashes)


def _mark(axes: Any, xs: Any, ys: Any, look: Look) -> None:
    if look.marker:
        axes.plot(xs, ys, linestyle="", marker=look.marker, markersize=look.size * POINTS, clip_on=False, zorder=3,
                  markeredgewidth=0.25 * POINTS, markeredgecolor=look.colour,
                  markerfacecolor=PAPER if look.hollow else look.colour)


def _fill(axes: Any, corner: tuple[float, float], wide: float, high: float, look: Look) -> None:
    face = PAPER if look.hatch else look.colour
    axes.add_patch(Rectangle(corner, wide, high, facecolor=face, edgecolor=look.colour if look.hatch else "none",
                             linewidth=0.0, hatch=look.hatch or None))
