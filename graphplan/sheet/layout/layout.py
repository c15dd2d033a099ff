"""From a construction to its sheet: paper, windows, strokes, letters and words, put together as one display list."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from graphplan.kernel.program import Panel
from graphplan.methods.construction import Construction
from graphplan.phrases import Said, joined, said
from graphplan.sheet.frames.frame import BORDER, frame_of
from graphplan.sheet.frames.title import CONSTRUCTION, Page
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import SIZE, Runs, sentence_runs, wrap
from graphplan.sheet.lettering.letters import picture
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Outline, Rect, Sheet, Text
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.rows import fill, lettered
from graphplan.sheet.words.texts import RESULTS
from graphplan.words.tongue import Tongue

BACK, FRONT = ("paper", BORDER, "plates", "ground", "links"), ("blocks", "drive", "pairs", "letters", "text", RESULTS)


def layout(drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
           composition: Composition | None = None, tongue: Tongue | None = None,
           document: Said = CONSTRUCTION) -> Sheet:
    """The sheet of a construction, composed already; else `paper` names its size, or the smallest good one is taken.

    `document` is what its title block calls it. Fails with `Refused` where the words do not fit the paper named.
    """
    composition = composition or compose(drawing, paper, check, tongue=tongue)
    plans = composition.plans
    arrangement, scales = composition.arrangement, composition.scales
    items = list(_framed(composition))
    for plate in composition.plates:
        items += captions(arrangement.panels[plate.panel], plate.panel, plans, scales)
        items += picture(plate)
    items += lettered(fill(arrangement.rows, arrangement.columns) or [])
    items += titled(composition, document, 1, composition.page_count)
    return Sheet(
        arrangement.width, arrangement.height, arrangement.frame, arrangement.panels, tuple(stacked(items)),
        drawing.scene.title, _description(composition, plans), tuple(map(plans.tongue, drawing.sentences())), scales,
        plans.tongue.code, drawing.scene.text, drawing.drawn.givens,
    )  # fmt: skip


def pages(composition: Composition, document: Said = CONSTRUCTION) -> list[Sheet]:
    """The sheet of a composed construction, and the pages of its words where they stand apart."""
    first = layout(composition.plans.drawing, composition=composition, document=document)
    return [first, *(_words_page(first, composition, number, document) for number in range(len(composition.protocol)))]


def _words_page(first: Sheet, composition: Composition, number: int, document: Said) -> Sheet:
    """A page of words, by its number from 0."""
    page, placed = composition.protocol[number]
    apart = replace(composition, arrangement=page)
    words = lettered(placed), titled(apart, document, 2 + number, composition.page_count)
    items = stacked([*_framed(apart), *words[0], *words[1]])
    return replace(first, width=page.width, height=page.height, frame=page.frame, panels={}, items=tuple(items))


def _framed(composition: Composition) -> Iterator[Item]:
    """The frame with its border, and the panels."""
    arrangement, plans = composition.arrangement, composition.plans
    yield from frame_of(plans.drawing.scene).items(arrangement.paper, arrangement.frame, plans.tongue)
    for panel, rect in arrangement.panels.items():
        yield Outline(pens.BORDER, "paper", None, rect.corners, panel)


def titled(composition: Composition, document: Said, number: int = 1, of: int = 1) -> Iterator[Item]:
    """The title block of a page."""
    arrangement, scene = composition.arrangement, composition.plans.drawing.scene
    page = Page(document, arrangement.paper, composition.scales.ratio, number, of)
    return frame_of(scene).block(scene, composition.plans.tongue).items(arrangement.title, page)


def stacked(items: Iterable[Item]) -> list[Item]:
    """From back to front: paper, mechanism, each step with its letters and its sentence, pairs, the other letters."""
    rank = {layer: i for i, layer in enumerate(BACK)} | {layer: 10**7 + i for i, layer in enumerate(FRONT)}
    return sorted(items, key=lambda item: 10**6 + item.step if item.step is not None else rank[item.layer])


def _description(composition: Composition, plans: Plans) -> str:
    """What a reader who cannot see the sheet is told."""
    steps = len(plans.drawing.drawn) - plans.drawing.drawn.givens
    told = [joined((panel.words, joined(composition.scales.said(panel, plans.kinds(panel)))), ": ")
            for panel in composition.plans.panels]
    return plans.tongue(said("Graphical construction in {0} steps. Scales: {1}.", steps, joined(told, "; ")))


HEADS = 3.0, 2.5  # mm: the sizes of a plan's name, the smaller where it is long
LINES = {2: (4.6, 3.7), 3: (3.4, 3.6)}  # mm: of so many lines the first base line, and from base line to base line


def captions(rect: Rect, panel: Panel, plans: Plans, scales: Scales) -> Iterator[Text]:
    """Over a plan what it is, and its scales."""
    kinds, room = plans.kinds(panel), rect.width - 5
    head = sentence_runs(plans.tongue(panel.caption(kinds)))
    size, heads = min(((size, wrap(head, size, room, bold=True)) for size in HEADS), key=lambda one: len(one[1]) > 2)
    told = plans.tongue(joined(scales.said(panel, kinds), ",  "))
    lines: list[Runs] = [*heads[:2], *wrap(sentence_runs(told), SIZE, room)]
    first, pitch = LINES[min(max(len(lines), 2), 3)]
    for i, runs in enumerate(lines[:3]):
        bold = i < len(heads[:2])
        yield Text(pens.LETTERS, "text", None, (rect.left + 2.5, rect.top - first - pitch * i), runs,
                   size if bold else SIZE, bold=bold)  # fmt: skip
