"""From a construction to its sheet: paper, windows, strokes, letters and words, put together as one display list."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

from graphplan.errors import Refused
from graphplan.sheet import clip, pens
from graphplan.sheet.display import Item, Polygon, Sheet, Spot, Text
from graphplan.sheet.labels import Wish, placed
from graphplan.sheet.lettering import SIZE, sentence_runs, wrap
from graphplan.sheet.letters import Letters
from graphplan.sheet.linkage import Linkage
from graphplan.sheet.paper import CAPTION, MARGIN, SIZES, Arrangement, Measure, arrangements, room
from graphplan.sheet.planes import MECHANISM, Drawing, Figure, Planes, around
from graphplan.sheet.rows import Row, fill, lettered
from graphplan.sheet.scales import Scales, times
from graphplan.sheet.strokes import Strokes
from graphplan.sheet.symbols import RADIUS
from graphplan.sheet.texts import Words
from graphplan.sheet.title import TitleBlock, ratio
from graphplan.sheet.view import View, plan_multiple, plan_scale, view

SMALLEST = (115.0, 90.0), (85.0, 75.0)  # the mechanism's panel and any other
SHORTEST = 4.5  # mm: a link shorter than this has no room for letters
CROWDED = 90.0  # mm^2 of a plan for each of its marks: with less, the letters hide the lines
BACK, FRONT = ("paper", "plates", "ground", "links"), ("blocks", "drive", "pairs", "letters", "text")


@dataclass(frozen=True)
class Composition:
    """An arrangement with the scale and the window of each panel."""

    arrangement: Arrangement
    scales: Scales
    views: dict[str, View]

    @property
    def score(self) -> float:
        """How large the plans are: the mechanism counts most."""
        others = sum(math.log(self.views[p].scale) for p in self.views if p != MECHANISM)
        return math.log(self.views[MECHANISM].scale) + 0.5 * others

    @property
    def roomy(self) -> bool:
        """Whether every panel has its least size."""
        sizes = ((SMALLEST[p != MECHANISM], rect) for p, rect in self.arrangement.panels.items())
        return all(rect.width >= wide and rect.height >= high for (wide, high), rect in sizes)


def layout(drawing: Drawing, paper: str | None = None, check: Mapping[str, Any] | None = None) -> Sheet:
    """The sheet of a construction; `paper` names its size, else the smallest good one is taken.

    Fails with `Refused` where the words do not fit the paper named.
    """
    planes = Planes(drawing)
    block = TitleBlock(drawing.scene.title, drawing.scene.source)
    composition = _composed(planes, cache(Words(planes, check or {}).rows), block.height, paper)
    arrangement, scales = composition.arrangement, composition.scales
    items = list(_frame(arrangement))
    for panel, window in composition.views.items():
        items += captions(arrangement.panels[panel], panel, planes, scales)
        items += _panel(planes, panel, window)
    rows = fill(arrangement.rows, arrangement.columns)
    items += lettered(rows or [])
    items += block.items(arrangement.title, arrangement.paper.split()[0], ratio(scales.k_s, scales.length))
    return Sheet(
        arrangement.width, arrangement.height, arrangement.frame, arrangement.panels, tuple(_stacked(items)),
        drawing.scene.title, _description(composition, planes), tuple(drawing.sentences()), scales,
    )  # fmt: skip


# ---- the choice of paper ------------------------------------------------------------------------------------------


def _composed(planes: Planes, rows: Measure[Sequence[Row]], title: Measure[float], paper: str | None) -> Composition:
    """The best arrangement on the paper named, or on the smallest that shows everything at a good size."""
    figures = {panel: planes.figure(panel) for panel in planes.panels}
    papers = [paper] if paper else ["A4", "A4 portrait", *list(SIZES)[1:]]
    best: Composition | None = None
    for name in papers:
        found = [_windows(a, figures, planes) for a in arrangements(name, planes.panels, rows, title)]
        good = [c for c in found if c.roomy] or (found if paper else [])
        if good:
            best = max(good, key=lambda c: c.score)
            if name == "A2" or _legible(planes, best.views):
                return best
    if best is None:
        raise Refused(f"paper {paper}", "the words do not fit on it in legible letters", "a larger sheet, or no name")
    return best


def _windows(arrangement: Arrangement, figures: Mapping[str, Figure], planes: Planes) -> Composition:
    """The round scales and the windows for one arrangement."""
    rooms = {panel: room(rect) for panel, rect in arrangement.panels.items()}
    inner = {panel: rect.inset(MARGIN, MARGIN, MARGIN, MARGIN) for panel, rect in rooms.items()}
    k_s, box = plan_scale(figures[MECHANISM], inner[MECHANISM])
    views = {MECHANISM: view(box, rooms[MECHANISM], k_s)}
    multiples: dict[str, Fraction] = {}
    for panel in planes.panels[1:]:
        multiples[panel], box = plan_multiple(figures[panel], inner[panel], k_s)
        views[panel] = view(box, rooms[panel], k_s / float(multiples[panel]))
    drawing, units = planes.drawing, planes.drawing.scene.units
    scales = Scales(k_s, drawing.kappa, units.length, multiples, float(drawing.phi), units.force)
    return Composition(arrangement, scales, views)


def _legible(planes: Planes, views: Mapping[str, View]) -> bool:
    """Whether the links are long enough for letters, and no plan is crowded."""
    for panel, window in views.items():
        spots = [spot for spot in (window(planes.spot(i)) for i in planes.points(panel)) if window.rect.holds(spot)]
        if spots and around(spots).area < CROWDED * len(spots):
            return False
    return _shortest(planes) * views[MECHANISM].scale >= SHORTEST


def _shortest(planes: Planes) -> float:
    """The shortest distance of two joints of a link."""
    links = planes.drawing.scene.links.values()
    apart = (math.dist(planes.place(p), planes.place(q)) for names in links for p in names for q in names)
    return min((distance for distance in apart if distance > 0), default=math.inf)


# ---- what lies on the sheet ----------------------------------------------------------------------------------------


def _frame(arrangement: Arrangement) -> Iterator[Item]:
    for rect, pen in ((arrangement.frame, pens.FRAME), *((rect, pens.BORDER) for rect in arrangement.panels.values())):
        corners = (rect.left, rect.bottom), (rect.right, rect.bottom), (rect.right, rect.top), (rect.left, rect.top)
        yield Polygon(pen, "paper", None, corners)


def _panel(planes: Planes, panel: str, window: View) -> list[Item]:
    """One plan: the mechanism if it is its plan, the strokes, and the letters that avoid both."""
    strokes = Strokes(planes, panel, window)
    items, wishes = list(strokes.items()), list(Letters(strokes).wishes())
    marks: list[Spot] = [spot for i, spot in strokes.spots.items() if strokes.shown(i)]
    if panel == MECHANISM:
        linkage = Linkage(planes.drawing.scene, window)
        items += [cut for item in linkage.items() for cut in clip.clipped(item, window.rect)]
        letters = [Wish(runs, (spot,), RADIUS + 0.3, label=label) for spot, (runs, label) in linkage.letters().items()]
        wishes = [*letters, *linkage.wishes(), *wishes]
        marks += list(linkage.spots.values())
    return items + placed(wishes, items, marks, window.rect)


def _stacked(items: Iterable[Item]) -> list[Item]:
    """From back to front: paper, mechanism, each step with its letters and its sentence, pairs, the other letters."""
    rank = {layer: i for i, layer in enumerate(BACK)} | {layer: 10**7 + i for i, layer in enumerate(FRONT)}
    return sorted(items, key=lambda item: 10**6 + item.step if item.step is not None else rank[item.layer])


def _description(composition: Composition, planes: Planes) -> str:
    """What a reader who cannot see the sheet is told."""
    steps = len(planes.drawing.drawn) - planes.drawing.drawn.givens
    said = [f"{panel}: {', '.join(composition.scales.said(panel, planes.kinds(panel)))}" for panel in composition.views]
    return f"Graphical construction in {steps} steps. Scales: {'; '.join(said)}."
