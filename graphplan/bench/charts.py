"""Charts as SVG text: small pictures of one size in rows, a key below them, everything in mm of paper, on a canvas of
lines, marks and letters that lie wherever they are wanted.

The data come as pictures that know what stands where and how it looks; here they meet the paper. The same picture is
the same text.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

from graphplan.output.svg import LINE, MARGIN, TITLE, Canvas
from graphplan.phrases import digits
from graphplan.sheet.diagrams import DIVISION
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.lettering.lettering import SIZE, Runs, TextRun, width, wrap
from graphplan.sheet.plates.display import Rect, Spot
from graphplan.sheet.plates.pens import GREY, PAPER, Pen

if TYPE_CHECKING:
    from graphplan.bench.picture import Axis, Chart, ChartSeries, Look, Place, SubChart

SMALL, LABEL = 2.2, 2.8  # letters at the axes, and at series, in mm
LEFT, RIGHT, ABOVE, BELOW = 16.0, 8.0, 10.0, 13.0  # around a picture: readings and labels
RAIL, BESIDE = 2.6, 1.8  # mm from rail to rail, and from the numbers to the first
ROOM = 0.06  # of the numbers' range, left free at both ends
KEY, SAMPLE = 5.0, 9.0  # from line to line of the key; the length of its samples
SIDES = (*((h, 0) for h in (1, -1)),
         *((h, v * line) for line in (1, 2.4, 3.8, 5.2, 6.6) for v in (1, -1) for h in (0, 0.9, -0.9)))
PIECES = 12  # in which a line is looked at
LEADER_LINES = 2  # words so many lines away are led to their mark
ON_WORDS, ON_A_MARK, ON_A_LINE, AWAY = 20.0, 10.0, 1.0, 0.6  # what is amiss with a place for words; AWAY for each line
LEAST_PLAIN, MOST_PLAIN = 0.005, 5000  # on an axis of decades: numbers beyond are powers of ten
READINGS = 8, 5  # at most, along the first and the second axis
FRAME, EDGE = Pen(0.18), Pen(0.18, GREY)


def draw_chart(chart: Chart) -> str:
    """The chart as SVG text: title and remarks at the top, the key at the foot, and the pictures between them."""
    canvas, (wide, high), columns = Canvas(), chart.panel_mm, min(chart.columns, len(chart.panels) or 1)
    rows, breadth = math.ceil(len(chart.panels) / columns), 2 * MARGIN + columns * (LEFT + wide + RIGHT)
    remarks = wrap(_raise_powers(chart.remarks), SIZE, breadth - 2 * MARGIN)
    head = MARGIN + TITLE + 3 + LINE * len(remarks)
    keys = list(_key_rows(chart, breadth - MARGIN))
    height = head + rows * (ABOVE + high + BELOW) + 4 + KEY * len(keys) + MARGIN
    canvas.text((MARGIN, height - MARGIN - TITLE), _raise_powers(chart.title), TITLE)
    for k, line in enumerate(remarks, 1):
        canvas.text((MARGIN, height - MARGIN - TITLE - 1.5 - k * LINE), line)
    for k, panel in enumerate(chart.panels):
        row, column = divmod(k, columns)
        left = MARGIN + column * (LEFT + wide + RIGHT) + LEFT
        top = height - head - row * (ABOVE + high + BELOW) - ABOVE
        _draw(canvas, panel, Rect(left, top - high, left + wide, top))
    for k, entries in enumerate(keys, 1):
        for at, words, look in entries:
            _sample(canvas, (at, MARGIN + (len(keys) - k) * KEY), _raise_powers(words), look)
    return canvas.svg(breadth, height, chart.title, chart.remarks)


def _raise_powers(words: str) -> Runs:
    """Words with powers raised, such as 10^-3."""
    pieces = re.split(r"\^(-?[\d.]*\d)", words)
    return tuple(TextRun(text.replace("-", "−") if k % 2 else text, k % 2) for k, text in enumerate(pieces) if text)


def _key_rows(chart: Chart, end: float) -> Iterable[list[tuple[float, str, Look]]]:
    """The key in rows, each entry with its place in the row."""
    row: list[tuple[float, str, Look]] = []
    at = MARGIN
    for words, look in chart.key:
        wide = SAMPLE + 2 + width(_raise_powers(words), SIZE) + 6
        if row and at + wide > end:
            yield row
            row, at = [], MARGIN
        row.append((at, words, look))
        at += wide
    if row:
        yield row


def _sample(canvas: Canvas, at: Spot, words: Runs, look: Look) -> None:
    """A look with what it means."""
    middle = at[1] + 0.36 * SIZE
    if look.area:
        canvas.fill(Rect(at[0], middle - 1.3, at[0] + SAMPLE, middle + 1.3).corners, _filling(look))
    elif look.width:
        canvas.line([(at[0], middle), (at[0] + SAMPLE, middle)], Pen(look.width, look.colour, look.dash))
    _mark(canvas, (at[0] + SAMPLE / 2, middle), look)
    canvas.text((at[0] + SAMPLE + 2, at[1]), words)


def _filling(look: Look) -> Pen:
    return Pen(0.25, look.colour, fill=PAPER if look.hollow else look.colour)


def _mark(canvas: Canvas, spot: Spot, look: Look) -> None:
    if look.marker:
        canvas.mark(look.marker, spot, look.marker_mm, _filling(look))


class _Scale:
    """Where the places of an axis are on paper, between two ends: numbers first, rails beside them."""

    def __init__(self, axis: Axis, places: Iterable[Place], start: float, end: float, readings: int):
        self.axis, self.readings = axis, readings
        shown = *places, *axis.shows, *self._references
        numbers = [self._plain(place) for place in shown if not isinstance(place, str)]
        low, high = min(numbers, default=0.0), max(numbers, default=0.0)
        room = ROOM * (high - low) or (0.1 if numbers else 0.0)  # one number alone stands in the middle
        self.low, self.high = low - room, high + room
        count, pitch = len(axis.before) + len(axis.after), axis.pitch or RAIL
        self.pitch = pitch if numbers or not count else (end - start) / count  # rails alone share the whole length
        before, after = (BESIDE + pitch * len(rails) if rails and numbers else 0.0
                         for rails in (axis.before, axis.after))
        self.start = start + before
        self.mm = (end - after - self.start) / (self.high - self.low or 1.0)
        self.rails = {name: start + self.pitch * (k + 0.5) for k, (name, _) in enumerate(axis.before)}
        self.rails |= {name: end - self.pitch * (k + 0.5) for k, (name, _) in enumerate(axis.after)}
        self.edges = [edge for edge, room in ((self.start, before), (end - after, after)) if room]

    def __call__(self, place: Place) -> float:
        return self.rails[place] if isinstance(place, str) else self.start + (self._plain(place) - self.low) * self.mm

    @property
    def _references(self) -> tuple[float, ...]:
        """The number to which the others are relative, if there is one."""
        return () if self.axis.reference is None else (self.axis.reference,)

    def _plain(self, number: float) -> float:
        value = math.log10(number) if self.axis.log else number
        return -value if self.axis.falling else value

    def ticks(self) -> list[tuple[float, Runs]]:
        """Readings along the axis: the reference, and decades or round numbers; rails by their labels. Those that
        would run into one before are left out."""
        ticks = [(self.rails[name], _raise_powers(label)) for name, label in (*self.axis.before, *self.axis.after)
                 if label]
        if self.high == self.low:
            return ticks
        low, high = sorted(-end if self.axis.falling else end for end in (self.low, self.high))
        decades = self.axis.log and high - low >= 2
        read: list[float] = []
        for number in (*self._references, *self._round_numbers(low, high)):
            plain = not decades or LEAST_PLAIN < number < MOST_PLAIN
            words, at = _raise_powers(digits(number) if plain else f"10^{math.log10(number):.0f}"), self(number)
            if all(abs(at - other) > width(words, SMALL) + 1.5 for other in read):
                ticks.append((at, words))
                read.append(at)
        return ticks

    def _round_numbers(self, low: float, high: float) -> list[float]:
        """Powers of ten, where there are few of them 1, 2 and 5 times these, or round numbers an equal step apart."""
        if self.axis.log and high - low >= 1:
            step, times = math.ceil((high - low) / self.readings), (1,) if high - low >= 2 else (1, 2, 5)
            powers = range(math.floor(low / step), math.floor(high / step) + 1)
            return [number for k in powers for number in (one * 10.0 ** (k * step) for one in times)
                    if low <= math.log10(number) <= high]
        if self.axis.log:
            low, high = 10**low, 10**high
        pitch = float(round_up((high - low) / self.readings))  # 2.5 and 4 too, as small pictures have few readings
        return [k * pitch for k in range(math.ceil(low / pitch), math.floor(high / pitch) + 1)]


def _draw(canvas: Canvas, panel: SubChart, rect: Rect) -> None:
    """One picture: frame and divisions, areas and lines, then marks over them."""
    spots = [spot for series in panel.series for spot in (*series.spots, *(end for pair in series.spreads
                                                                           for end in pair))]
    x = _Scale(panel.x, [a for a, _ in spots], rect.left, rect.right, READINGS[0])
    y = _Scale(panel.y, [b for _, b in spots], rect.bottom, rect.top, READINGS[1])
    _frame(canvas, panel, rect, x, y)
    for series in panel.series:
        _line(canvas, series, x, y)
    for series in panel.series:
        for a, b in series.spots:
            _mark(canvas, (x(a), y(b)), series.look)
    _labels(canvas, panel, rect, x, y)


def _frame(canvas: Canvas, panel: SubChart, rect: Rect, x: _Scale, y: _Scale) -> None:
    """The axes with their readings; thin divisions, and a line where numbers end and rails begin."""
    for at, words in x.ticks():
        canvas.line([(at, rect.bottom), (at, rect.top)], DIVISION)
        canvas.text((at, rect.bottom - 1.2 - SMALL), words, SMALL, "middle")
    for at, words in y.ticks():
        canvas.line([(rect.left, at), (rect.right, at)], DIVISION)
        canvas.text((rect.left - 1.2, at - 0.36 * SMALL), words, SMALL, "end")
    for place, reading in panel.y.beside:
        canvas.text((rect.right + 1.2, y(place) - 0.36 * SMALL), _raise_powers(reading), SMALL)
    for at in x.edges:
        canvas.line([(at, rect.bottom), (at, rect.top)], EDGE)
    for at in y.edges:
        canvas.line([(rect.left, at), (rect.right, at)], EDGE)
    canvas.fill(rect.corners, FRAME)
    canvas.text((rect.left, rect.top + 5.0), _raise_powers(panel.title))
    canvas.text((rect.left, rect.top + 1.2), _raise_powers(panel.y.label), SMALL)
    canvas.text((rect.centre[0], rect.bottom - 2.6 - 2 * SMALL), _raise_powers(panel.x.label), SMALL, "middle")


def _line(canvas: Canvas, series: ChartSeries, x: _Scale, y: _Scale) -> None:
    """The line of a series, broken where it goes over a rail, or its stretch of a rail; the spreads of its spots."""
    look = series.look
    for (a, b), ((left, low), (right, high)) in zip(series.spots, series.spreads, strict=bool(series.spreads)):
        for ends in ((left, b), (right, b)), ((a, low), (a, high)):
            canvas.line([(x(x_place), y(y_place)) for x_place, y_place in ends], Pen(0.18, look.colour))
    if look.area:
        (start, rail), (end, _) = series.spots
        half = 0.4 * y.pitch
        canvas.fill(Rect(x(start), y(rail) - half, x(end), y(rail) + half).corners, _filling(look))
        words, room = _raise_powers(series.label), x(end) - x(start) - 0.6
        if series.label and width(words, SMALL) <= room:
            canvas.text(((x(start) + x(end)) / 2, y(rail) - 0.36 * SMALL), words, SMALL, "middle")
    for railed, spots in groupby(series.spots, key=lambda spot: not series.through and str in map(type, spot)):
        if look.width and not railed:
            canvas.line([(x(a), y(b)) for a, b in spots], Pen(look.width, look.colour, look.dash))


def _labels(canvas: Canvas, panel: SubChart, rect: Rect, x: _Scale, y: _Scale) -> None:
    """The words of each series at its last spot, where least is amiss with them; from afar a line leads to them."""
    taken = [covered for series in panel.series for covered in _covered_boxes(series, x, y)]
    for series in panel.series:
        if not series.label or not series.spots or series.look.area:
            continue
        words, spot = _raise_powers(series.label), (x(series.spots[-1][0]), y(series.spots[-1][1]))
        wide, off = width(words, LABEL), series.look.marker_mm / 2 + 1.0
        boxes = {_box((spot[0] + h * (off + wide / 2), spot[1] + v * (off + LABEL / 2)), wide, LABEL): abs(v)
                 for h, v in SIDES}
        best = min([box for box in boxes if all(map(rect.holds, box.corners))] or boxes, key=lambda box: (
            AWAY * boxes[box] + sum(amiss for box_taken, amiss in taken if box.meets(box_taken))))
        taken.append((best, ON_WORDS))
        if boxes[best] > LEADER_LINES:
            near = min(max(spot[0], best.left), best.right), min(max(spot[1], best.bottom), best.top)
            canvas.line([spot, near], EDGE)
        canvas.text((best.left, best.bottom + 0.14 * LABEL), words, LABEL, pen=Pen(0.0, series.look.colour))


def _covered_boxes(series: ChartSeries, x: _Scale, y: _Scale) -> Iterable[tuple[Rect, float]]:
    """What a series covers, and how bad words are there: its marks, its line, and the spreads of its spots."""
    spots = [(x(a), y(b)) for a, b in series.spots]
    if series.look.marker:
        yield from ((_box(spot, series.look.marker_mm, series.look.marker_mm), ON_A_MARK) for spot in spots)
    lines = list(pairwise(spots)) if series.look.width else []
    for (across, up), corners in zip(spots, series.spreads, strict=False):
        (left, low), (right, high) = ((x(a), y(b)) for a, b in corners)
        lines += [((left, up), (right, up)), ((across, low), (across, high))]
    for (left, low), (right, high) in lines:
        wide, tall = (right - left) / PIECES, (high - low) / PIECES
        for k in range(PIECES):
            middle = left + (k + 0.5) * wide, low + (k + 0.5) * tall
            yield _box(middle, abs(wide) + 0.2, abs(tall) + 0.2), ON_A_LINE


def _box(centre: Spot, wide: float, high: float) -> Rect:
    """A rectangle by its centre and its size."""
    return Rect(centre[0] - wide / 2, centre[1] - high / 2, centre[0] + wide / 2, centre[1] + high / 2)
