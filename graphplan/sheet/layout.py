"""From a construction to its sheet: paper, windows, strokes, letters and words, put together as one display list."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from graphplan.methods.panels import spoken
from graphplan.phrases import joined, said
from graphplan.sheet import pens
from graphplan.sheet.captions import captions
from graphplan.sheet.compose import compose
from graphplan.sheet.composition import Composition
from graphplan.sheet.display import Item, Polygon, Sheet
from graphplan.sheet.paper import Arrangement
from graphplan.sheet.picture import picture
from graphplan.sheet.planes import Drawing, Planes
from graphplan.sheet.rows import fill, lettered
from graphplan.sheet.texts import RESULTS
from graphplan.sheet.title import TitleBlock, ratio
from graphplan.words.tongue import ENGLISH, Tongue

BACK, FRONT = ("paper", "plates", "ground", "links"), ("blocks", "drive", "pairs", "letters", "text", RESULTS)


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
        items += picture(planes, panel, window)
    rows = fill(arrangement.rows, arrangement.columns)
    items += lettered(rows or [])
    items += block.items(arrangement.title, arrangement.paper.split()[0], ratio(scales.k_s, scales.length))
    return Sheet(
        arrangement.width, arrangement.height, arrangement.frame, arrangement.panels, tuple(stacked(items)),
        drawing.scene.title, _description(composition, planes), tuple(map(planes.tongue, drawing.sentences())), scales,
        planes.tongue.code, drawing.scene.text,
    )  # fmt: skip


def _frame(arrangement: Arrangement) -> Iterator[Item]:
    for rect, pen in ((arrangement.frame, pens.FRAME), *((rect, pens.BORDER) for rect in arrangement.panels.values())):
        corners = (rect.left, rect.bottom), (rect.right, rect.bottom), (rect.right, rect.top), (rect.left, rect.top)
        yield Polygon(pen, "paper", None, corners)


def stacked(items: Iterable[Item]) -> list[Item]:
    """From back to front: paper, mechanism, each step with its letters and its sentence, pairs, the other letters."""
    rank = {layer: i for i, layer in enumerate(BACK)} | {layer: 10**7 + i for i, layer in enumerate(FRONT)}
    return sorted(items, key=lambda item: 10**6 + item.step if item.step is not None else rank[item.layer])


def _description(composition: Composition, planes: Planes) -> str:
    """What a reader who cannot see the sheet is told."""
    steps = len(planes.drawing.drawn) - planes.drawing.drawn.givens
    told = [joined((spoken(panel), joined(composition.scales.said(panel, planes.kinds(panel)))), ": ")
            for panel in composition.views]
    return planes.tongue(said("Graphical construction in {0} steps. Scales: {1}.", steps, joined(told, "; ")))
