"""From a construction to its sheet: paper, windows, strokes, letters and words, put together as one display list."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from graphplan.methods.panels import MECHANISM, spoken
from graphplan.phrases import joined, said
from graphplan.sheet import clip, pens
from graphplan.sheet.captions import captions
from graphplan.sheet.compose import compose
from graphplan.sheet.composition import Composition
from graphplan.sheet.display import Item, Polygon, Sheet, Spot
from graphplan.sheet.labels import placed
from graphplan.sheet.letters import Letters
from graphplan.sheet.linkage import Linkage
from graphplan.sheet.paper import Arrangement
from graphplan.sheet.places import Wish
from graphplan.sheet.planes import Drawing, Planes
from graphplan.sheet.rows import fill, lettered
from graphplan.sheet.strokes import Strokes
from graphplan.sheet.symbols import RADIUS
from graphplan.sheet.title import TitleBlock, ratio
from graphplan.sheet.view import View
from graphplan.words.tongue import ENGLISH, Tongue

BACK, FRONT = ("paper", "plates", "ground", "links"), ("blocks", "drive", "pairs", "letters", "text")


def layout(drawing: Drawing, paper: str | None = None, check: Mapping[str, Any] | None = None,
           composition: Composition | None = None, tongue: Tongue = ENGLISH) -> Sheet:
    """The sheet of a construction, composed already; else `paper` names its size, or the smallest good one is taken.

    Fails with `Refused` where the words do not fit the paper named.
    """
    composition = composition or compose(drawing, paper, check, tongue=tongue)
    planes = composition.planes
    block = TitleBlock(drawing.scene.title, drawing.scene.source, planes.tongue)
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
        drawing.scene.title, _description(composition, planes), tuple(map(planes.tongue, drawing.sentences())), scales,
        planes.tongue.code,
    )  # fmt: skip


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
    told = [joined((spoken(panel), joined(composition.scales.said(panel, planes.kinds(panel)))), ": ")
            for panel in composition.views]
    return planes.tongue(said("Graphical construction in {0} steps. Scales: {1}.", steps, joined(told, "; ")))
