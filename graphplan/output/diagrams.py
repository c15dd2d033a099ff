"""Diagrams by matplotlib: their one style, pages of panels whose sizes are mm of paper, words beside marks, and files.

Capitals are 2.5 mm high. Colours are those of Okabe and Ito, which the colour-blind tell apart; curves differ in their
dashes or marks as well, so that they are told apart in grey. The same diagram is the same bytes in each file.
"""

from __future__ import annotations

import io
import math
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import wraps
from typing import Any, NamedTuple, ParamSpec, TypeVar

import matplotlib.style
import numpy as np
from matplotlib.axes import Axes as Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator
from matplotlib.transforms import Bbox

from graphplan.phrases import SUPERSCRIPTS

P = ParamSpec("P")
T = TypeVar("T")

INCH = 25.4  # mm
MM = 72 / INCH  # points in a mm, which matplotlib measures lines and letters in
LETTER_MM = 2.5 / 0.729  # mm: the size of letters whose capitals are 2.5 mm high
TITLE_MM = 3.5 / 0.729  # mm: of a page's title
CHARACTER = 0.56  # of the size of letters: how wide one is on average
LEADING = 1.45  # of the size of letters: from one line of words to the next

BLACK, GREY, PALE = "#000000", "#6e6e6e", "#d4d4d4"
BLUE, VERMILION, GREEN, ORANGE = "#0072b2", "#d55e00", "#009e73", "#e69f00"
SKY, PURPLE, BROWN = "#56b4e9", "#cc79a7", "#6b4a1f"
COLOURS = BLACK, BLUE, VERMILION, GREEN, PURPLE, ORANGE, BROWN, SKY  # of curves, one after the other
DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (2, 1.2)), (0, (6, 1.5, 1, 1.5)), (0, (10, 2)), (0, (1, 1)),
                           (0, (4, 1, 1, 1, 1, 1)), (0, (8, 1.5, 2, 1.5)))
MARKERS = "o", "s", "^", "D", "v", "P", "X", "*"

STYLE: dict[str, Any] = {
    "font.family": ["DejaVu Sans"], "font.size": LETTER_MM * MM, "mathtext.fontset": "dejavusans",
    "figure.titlesize": TITLE_MM * MM, "axes.titlesize": LETTER_MM * MM, "axes.labelsize": LETTER_MM * MM,
    "xtick.labelsize": LETTER_MM * MM, "ytick.labelsize": LETTER_MM * MM, "legend.fontsize": LETTER_MM * MM,
    "lines.linewidth": 0.35 * MM, "lines.markersize": 2.0 * MM, "axes.linewidth": 0.18 * MM,
    "xtick.major.width": 0.18 * MM, "ytick.major.width": 0.18 * MM, "xtick.minor.size": 0, "ytick.minor.size": 0,
    "axes.grid": True, "grid.color": PALE, "grid.linewidth": 0.13 * MM, "axes.axisbelow": True,
    "legend.frameon": False, "legend.handlelength": 2.6, "svg.fonttype": "none", "svg.hashsalt": "graphplan",
    "pdf.fonttype": 42, "path.simplify": False, "savefig.dpi": 150,
}
METADATA: dict[str, dict[str, Any]] = {
    "svg": {"Date": None, "Creator": "graphplan"}, "png": {"Software": "graphplan"},
    "pdf": {"CreationDate": None, "Creator": "graphplan", "Producer": "graphplan"},
}
FORMATS = tuple(f".{ending}" for ending in METADATA)


def in_style(make: Callable[P, T]) -> Callable[P, T]:
    """Return a function that draws in the style of diagrams, whatever the reader's own settings are."""
    @wraps(make)
    def make_in_style(*arguments: P.args, **keywords: P.kwargs) -> T:
        with matplotlib.style.context(STYLE, after_reset=True):
            return make(*arguments, **keywords)

    return make_in_style


@in_style
def file_of(figure: Figure, ending: str = ".svg") -> bytes:
    """Return the file of a figure by its ending, one of `FORMATS`."""
    written, format = io.BytesIO(), ending.removeprefix(".")
    title = {"Title": figure.get_label()} if figure.get_label() else {}
    figure.savefig(written, format=format, metadata={**title, **METADATA[format]})
    return written.getvalue()


# ---- pages ----------------------------------------------------------------------------------------------------------


class Margins(NamedTuple):
    """Free room about each panel, in mm, and under all of them for the legend; `above` is added to its heading."""

    left: float = 22.0
    right: float = 8.0
    above: float = 3.0
    below: float = 15.0
    foot: float = 0.0


MARGINS = Margins()
PAGE_EDGE = 8.0  # mm: about a page


class Heading(NamedTuple):
    """Words over a panel: its title, and what there is to say of it."""

    title: str
    words: str = ""


@in_style
def page(title: str, remarks: str, headings: Sequence[Heading], panel_mm: tuple[float, float], columns: int,
         margins: Margins = MARGINS, projection: str | None = None) -> tuple[Figure, list[Axes]]:
    """Return a figure of panels of one size in mm under a title and remarks, and the axes of each panel."""
    wide, high = panel_mm
    columns = max(1, min(columns, len(headings)))
    rows, line = math.ceil(len(headings) / columns), LEADING * LETTER_MM
    breadth = 2 * PAGE_EDGE + columns * (margins.left + wide + margins.right)
    remark_lines = _lines(remarks, breadth - 2 * PAGE_EDGE)
    title_lines = _lines(title, breadth - 2 * PAGE_EDGE, TITLE_MM)
    over = [[heading.title, *_lines(heading.words, wide + margins.right)] for heading in headings]
    above = margins.above + line * max((len(words) for words in over if any(words)), default=0)
    head = PAGE_EDGE + LEADING * TITLE_MM * len(title_lines) + line * len(remark_lines) + 3.0 * bool(remark_lines)
    height = head + rows * (above + high + margins.below) + margins.foot + PAGE_EDGE
    figure = Figure(figsize=(breadth / INCH, height / INCH), label=title)
    FigureCanvasAgg(figure)
    text_at(figure, PAGE_EDGE, height - PAGE_EDGE, "\n".join(title_lines), fontsize=TITLE_MM * MM)
    text_at(figure, PAGE_EDGE, height - PAGE_EDGE - LEADING * TITLE_MM * len(title_lines), "\n".join(remark_lines))
    panels = list[Axes]()
    for k, words in enumerate(over):
        row, column = divmod(k, columns)
        left = PAGE_EDGE + column * (margins.left + wide + margins.right) + margins.left
        top = height - head - row * (above + high + margins.below) - above
        place = left / breadth, (top - high) / height, wide / breadth, high / height
        panels.append(figure.add_axes(place, projection=projection))
        text_at(figure, left, top + above - 1.5, words[0], weight="bold" if words[1:] else "normal")
        text_at(figure, left, top + above - 1.5 - line, "\n".join(words[1:]))
    return figure, panels


def text_at(figure: Figure, x: float, y: float, words: str, **look: Any) -> None:
    """Write words whose upper left corner lies at a place of the page, in mm from its lower left corner."""
    if words:
        width, height = figure.get_size_inches() * INCH
        figure.text(x / width, y / height, words, va="top", linespacing=LEADING / 1.2, **look)


def _lines(words: str, width: float, size: float = LETTER_MM) -> list[str]:
    """Return words in lines of a width in mm."""
    return textwrap.wrap(words, max(10, int(width / (CHARACTER * size))))


def look(label: str, linestyle: Any = "none", **style: Any) -> Line2D:
    """Return a look of curves or marks, as a legend shows it."""
    return Line2D([], [], label=label, linestyle=linestyle, **style)


def swatch(label: str, colour: str) -> Line2D:
    """Return a patch of a colour, as a legend shows it."""
    return look(label, "-", color=colour, linewidth=2.0 * MM)


def foot_legend(figure: Figure, handles: Sequence[Any], columns: int) -> None:
    """Write what each look means at the foot of the page."""
    figure.legend(handles=handles, loc="lower left", ncols=columns, bbox_to_anchor=(0.01, 0.005), borderaxespad=0.2,
                  columnspacing=1.6, handletextpad=0.6)


# ---- axes -----------------------------------------------------------------------------------------------------------


AXIS_ROOM = 0.06  # of a logarithmic axis: free at both ends
MIN_RATIO = 2.0  # of an axis' ends: where its numbers are fewer times each other its room is as if they were


def power(number: float) -> str:
    """Return a number as it stands at a logarithmic axis: plain where it is short, else as a power of ten."""
    exponent = round(math.log10(number))
    return f"{number:g}" if -3 < exponent < 4 else f"10{str(exponent).translate(SUPERSCRIPTS)}"


def decades(low: float, high: float, readings: int = 8) -> dict[float, str]:
    """Return the powers of ten between two numbers, no more than so many, with how they are written."""
    first, last = math.ceil(round(math.log10(low), 6)), math.floor(round(math.log10(high), 6))
    step = max(1, math.ceil((last - first + 1) / readings))
    return {10.0 ** k: power(10.0 ** k) for k in range(step * math.ceil(first / step), last + 1, step)}


def logarithmic(axis: Any, low: float, high: float, names: Mapping[float, str] | None = None,
                readings: int = 8) -> None:
    """Make an axis logarithmic between two numbers: powers of ten on the way, and places that have names."""
    every = [low, high, *(names or {})]
    room = (max(every) / min(every)) ** AXIS_ROOM
    _scale(axis, min(every) / room, max(every) * room, {**decades(low, high, readings), **(names or {})})


MANTISSAS = (1,), (1, 2, 5), (1, 1.5, 2, 3, 5, 7)  # of the readings of a logarithmic axis


def ratio_axis(axis: Any, low: float, high: float, readings: int = 7) -> None:
    """Make an axis logarithmic between two numbers that are few times each other, with three readings at least."""
    room = max(high / low, MIN_RATIO) ** AXIS_ROOM
    low, high = low / room, high * room
    powers = [10.0 ** k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)]
    step = _round_step((high - low) / 4)
    equal_steps = [step * k for k in range(math.ceil(low / step), math.floor(high / step) + 1)]
    several = [[m * unit for unit in powers for m in mantissas if low <= m * unit <= high] for mantissas in MANTISSAS]
    ticks = next((ticks for ticks in several if 3 <= len(ticks) <= readings), equal_steps)
    _scale(axis, low, high, {tick: f"{tick:.10g}" for tick in ticks})


def _scale(axis: Any, low: float, high: float, ticks: Mapping[float, str]) -> None:
    """Make an axis logarithmic between two numbers, with these readings alone."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log", f"{axis.axis_name}lim": (low, high)})
    set_readings(axis, ticks)


def set_readings(axis: Any, readings: Mapping[float, str]) -> None:
    """Set the readings of an axis, and no others between them."""
    axis.set_minor_locator(NullLocator())
    axis.set_ticks([*readings], labels=[*readings.values()])


def _round_step(size: float) -> float:
    """Return 1, 2 or 5 times a power of ten that is no smaller than a size."""
    unit = 10.0 ** math.floor(math.log10(size))
    return next((m * unit for m in (1, 2, 5) if m * unit >= size), 10 * unit)


def stretch(axes: Axes, ends: tuple[float, float], across: tuple[float, float], words: str, **look: Any) -> None:
    """Draw a bar between two places along an axes, and write on it what fits of words that are given longest first,
    parted by |."""
    (left, right), (low, high) = ends, across
    axes.fill([left, right, right, left], [low, low, high, high], **look)
    renderer = axes.figure.canvas.get_renderer()  # type: ignore[attr-defined]
    axes.get_xlim(), axes.get_ylim()  # which settles the scales
    corners = axes.transData.transform([(left, low), (right, high)])
    x, y = map(float, axes.transData.inverted().transform(corners.mean(axis=0)))
    for choice in words.split("|"):
        text = axes.annotate(choice, (x, y), ha="center", va="center", annotation_clip=False)
        if text.get_window_extent(renderer).width < abs(corners[1][0] - corners[0][0]):
            return
        text.remove()


# ---- words beside marks ---------------------------------------------------------------------------------------------


class SeriesLabel(NamedTuple):
    """Words that stand beside a place in an axes' numbers."""

    x: float
    y: float
    words: str
    colour: str = BLACK


# costs beside that of one spot of a curve: of other words, of leaving the panel, of a line's distance, of a mark
ON_WORDS, OFF_THE_PANEL, AWAY, ON_MARK = 30.0, 200.0, 0.8, 8
SPOTS = 24  # into which each piece of a curve is cut, to see what words would cover
LEADER_LINES = 2.0  # lines of words: further away words are led to their mark


def place_labels(axes: Axes, labels: Iterable[SeriesLabel]) -> None:
    """Write words beside their places, each where it covers least of the curves and of the words before it."""
    renderer = axes.figure.canvas.get_renderer()  # type: ignore[attr-defined]
    unit = LETTER_MM * renderer.points_to_pixels(MM)
    axes.get_xlim(), axes.get_ylim()  # which settles the scales
    inside, spots = axes.get_window_extent(renderer), _spots_of_curves(axes)
    taken = [item.get_window_extent(renderer) for item in (*axes.texts, *axes.patches)]
    for label in labels:
        text = axes.annotate(label.words, (label.x, label.y), color=label.colour, annotation_clip=False)
        box = text.get_window_extent(renderer)
        at = axes.transData.transform((label.x, label.y))
        best = min(_boxes(at, box.width, box.height, unit), key=lambda place: _cost(place, spots, taken, inside))
        taken.append(best[0])
        text.remove()
        x, y = map(float, axes.transData.inverted().transform((best[0].x0, best[0].y0 + 0.22 * unit)))
        arrow = {"arrowstyle": "-", "lw": 0.13 * MM, "color": GREY, "shrinkA": 0, "shrinkB": 2}
        axes.annotate(label.words, (label.x, label.y), (x, y), color=label.colour, annotation_clip=False,
                      arrowprops=arrow if best[1] >= LEADER_LINES else None)


def end_labels(axes: Axes, labels: Sequence[SeriesLabel]) -> None:
    """Write words in the margin on the right, in the order of the places that they belong to, each led to its own."""
    renderer = axes.figure.canvas.get_renderer()  # type: ignore[attr-defined]
    line = LEADING * LETTER_MM * renderer.points_to_pixels(MM)
    gap = line * max((1 + label.words.count("\n") for label in labels), default=1)
    axes.get_xlim(), axes.get_ylim()  # which settles the scales
    inside = axes.get_window_extent(renderer)
    spots = axes.transData.transform([(label.x, label.y) for label in labels])
    heights = np.clip(spots[:, 1], inside.y0, inside.y1) if labels else np.array([])
    order = np.argsort(heights, kind="stable")
    spread = np.maximum.accumulate(heights[order] - gap * np.arange(len(labels))) + gap * np.arange(len(labels))
    spread -= max(0.0, *(spread - inside.y1)) if labels else 0.0
    arrow = {"arrowstyle": "-", "lw": 0.13 * MM, "color": GREY, "shrinkA": 0, "shrinkB": 2,
             "relpos": (0.0, 0.5)}
    for k, y in zip(order, spread, strict=True):
        place = axes.transAxes.inverted().transform((inside.x1 + line, y))
        axes.annotate(labels[k].words, (labels[k].x, labels[k].y), (float(place[0]), float(place[1])),
                      textcoords="axes fraction", va="center", color=labels[k].colour, annotation_clip=False,
                      arrowprops=arrow)


def _boxes(at: Any, width: float, height: float, unit: float) -> Iterable[tuple[Bbox, float]]:
    """Yield boxes of words about a place in pixels, each with how many lines it is away."""
    off = 0.75 * unit
    for side in (1, -1):
        x = at[0] + off if side > 0 else at[0] - off - width
        yield Bbox.from_bounds(x, at[1] - height / 2, width, height), 0.0
    for lines in (0.9, 2.1, 3.3, 4.5, 6.0, 8.0):
        for up in (1, -1):
            for x in (at[0] - width / 2, at[0] + off, at[0] - off - width):
                yield Bbox.from_bounds(x, at[1] + up * lines * unit - height / 2, width, height), lines


def _cost(place: tuple[Bbox, float], spots: Any, taken: Sequence[Bbox], inside: Bbox) -> float:
    """Return what is amiss with a box for words."""
    box, lines = place
    x, y = spots.T
    covered = np.count_nonzero((x > box.x0) & (x < box.x1) & (y > box.y0) & (y < box.y1))
    outside = box.x0 < inside.x0 or box.x1 > inside.x1 or box.y0 < inside.y0 or box.y1 > inside.y1
    return float(covered + ON_WORDS * sum(box.overlaps(other) for other in taken) + OFF_THE_PANEL * outside
                 + AWAY * lines)


def _spots_of_curves(axes: Axes) -> Any:
    """Return spots along the curves of an axes, in pixels."""
    pieces = [np.empty((0, 2))]
    for line in axes.lines:
        ends = line.get_transform().transform(line.get_xydata())
        ends = ends[np.isfinite(ends).all(axis=1)]
        between = np.linspace(0, 1, SPOTS)[:, None, None]
        pieces += [ends] * (ON_MARK if line.get_marker() != "None" else 1)
        if len(ends) > 1 and line.get_linestyle() != "None":
            pieces.append((ends[:-1] + between * (ends[1:] - ends[:-1])).reshape(-1, 2))
    return np.concatenate(pieces)
