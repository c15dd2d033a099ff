"""From a construction to its sheet: paper, windows, strokes, letters and words, put together as one display list.

Of a finished sheet a part can be shown: as it stands after a step, or some steps over what was drawn before in grey.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from graphplan.errors import Refused
from graphplan.kernel.program import Panel, Program
from graphplan.phrases import Said, join, said
from graphplan.sheet.frames.frame import BORDER, frame_of
from graphplan.sheet.frames.title import CONSTRUCTION, Page
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.enlargements import DETAILS, enlarge_crowds, friction_circles
from graphplan.sheet.layout.facts_block import FOUND, GIVEN
from graphplan.sheet.layout.measures import CAPTION_SIDE_MM
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import (
    CAPS,
    HEADING,
    SPACE,
    LetterSizes,
    Runs,
    TextRun,
    depth,
    sentence_runs,
    width,
    wrap,
)
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import ENLARGED, Item, Outline, Rect, Sheet, Text
from graphplan.sheet.plates.lever_arms import LAYER as ARMS
from graphplan.sheet.plates.machine import LAYER as MACHINE
from graphplan.sheet.plates.pens import pale
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.traced_motion import LAYER as MOTION
from graphplan.sheet.words.protocol import protocol_of
from graphplan.sheet.words.rows import fill, row_items
from graphplan.sheet.words.texts import RESULTS

BACK_LAYERS = "paper", BORDER, "ruling", MACHINE, "plates", MOTION, "ground", "wheels", "links"
FRONT_LAYERS = ("blocks", "drive", "pairs", DETAILS, ENLARGED, ARMS, "dimensions", "letters", "blanks", GIVEN, FOUND,
                "text", RESULTS)


def layout(composition: Composition, document: Said = CONSTRUCTION) -> Sheet:
    """The sheet of a composed construction; `document` is what its title block calls it."""
    items: list[Item] = [*captions(composition)]
    drawn, enlarged = enlarge_crowds(composition, items)
    items += [*drawn, *enlarged]
    details = friction_circles(composition, [*items, *composition.arrangement.fact_items])
    return sheet(composition, [*frame_items(composition), *items, *details], document)


def sheet(composition: Composition, items: Iterable[Item], document: Said) -> Sheet:
    """The first sheet of a composition: these items, the words for which there is room, and the title block."""
    arrangement = composition.arrangement
    return sheet_of_items(composition, [*items, *row_items(fill(arrangement.rows, arrangement.columns) or []),
                                        *arrangement.fact_items,
                                        *title_items(composition, document, composition.earlier + 1,
                                                     composition.page_count)])


def plans_sheet(composition: Composition, items: Iterable[Item] = ()) -> Sheet:
    """The plans with their captions and these items, without frame, title block and words."""
    outlines = (Outline(pens.BORDER, "paper", None, rect.corners, panel)
                for panel, rect in composition.arrangement.panels.items())
    return sheet_of_items(composition, [*outlines, *captions(composition), *items])


def sheet_of_items(composition: Composition, items: Iterable[Item]) -> Sheet:
    """A sheet that shows these items, from back to front, with what is told of its steps."""
    arrangement, plans = composition.arrangement, composition.plans
    drawing, scales = plans.drawing, composition.scales
    sentences = tuple(map(plans.tongue, protocol_of(plans, scales).sentences))
    return Sheet(
        arrangement.width, arrangement.height, arrangement.frame, arrangement.panels, tuple(back_to_front(items)),
        drawing.scene.title, _description(composition, plans), sentences, scales,
        plans.tongue.code, drawing.scene.text, drawing.drawn.givens,
    )  # fmt: skip


def pages(composition: Composition, document: Said = CONSTRUCTION) -> list[Sheet]:
    """The sheet of a composed construction, and the pages of its words where they stand apart."""
    first = layout(composition, document)
    return [first, *words_pages(first, composition, document)]


def words_pages(first: Sheet, composition: Composition, document: Said) -> Iterator[Sheet]:
    """The pages of words that follow a first sheet."""
    for number, (page, placed_rows) in enumerate(composition.protocol, composition.earlier + 2):
        apart = replace(composition, arrangement=page)
        items = back_to_front([*frame_items(apart), *row_items(placed_rows),
                               *title_items(apart, document, number, composition.page_count)])
        yield replace(first, width=page.width, height=page.height, frame=page.frame, panels={}, items=tuple(items))


def frame_items(composition: Composition) -> Iterator[Item]:
    """The frame with its border, and the panels."""
    arrangement, plans = composition.arrangement, composition.plans
    yield from frame_of(plans.drawing.scene).items(arrangement.paper, arrangement.frame, plans.tongue)
    for panel, rect in arrangement.panels.items():
        yield Outline(pens.BORDER, "paper", None, rect.corners, panel)


def title_items(composition: Composition, document: Said, number: int = 1, of: int = 1) -> Iterator[Item]:
    """The title block of a page."""
    arrangement, scene = composition.arrangement, composition.plans.drawing.scene
    page = Page(document, arrangement.paper, composition.scales.ratio, number, of)
    return frame_of(scene).block(scene, composition.plans.tongue).on_paper(arrangement.paper).items(arrangement.title,
                                                                                                    page)


def back_to_front(items: Iterable[Item]) -> list[Item]:
    """From back to front: paper, mechanism, each step with its letters and its sentence, pairs, the other letters."""
    rank = {layer: i for i, layer in enumerate(BACK_LAYERS)} | {layer: 10**7 + i
                                                                for i, layer in enumerate(FRONT_LAYERS)}
    return sorted(items, key=lambda item: rank[item.layer] if item.step is None or item.layer == ENLARGED
                  else 10**6 + item.step)


def _description(composition: Composition, plans: Plans) -> str:
    """Description of the sheet for readers who cannot see it."""
    steps = len(plans.drawing.drawn) - plans.drawing.drawn.givens
    scales = [join((panel.words, join(composition.scales.scale_texts(panel, plans.kinds(panel)))), ": ")
              for panel in composition.plans.panels]
    return plans.tongue(said("Graphical construction in {0} steps. Scales: {1}.", steps, join(scales, "; ")))


CAPTION_MARGIN, LINE_GAP = 1.3, 1.2  # mm over a caption, and between its lines at least
CaptionHead = tuple[Runs, float]  # what a plan is called, and how large the letters are


def captions(composition: Composition) -> Iterator[Text]:
    """The captions of all plans, as large as there is room for, each with the scales of its plan, in letters no larger.
    """
    for panel, head in caption_heads(composition).items():
        yield from caption(composition, panel, head, composition.scales)


def caption_heads(composition: Composition) -> dict[Panel, CaptionHead]:
    """Caption of each plan, in the largest letters that fit."""
    plans, letters, panels = composition.plans, composition.arrangement.letters, composition.arrangement.panels
    heads = {panel: sentence_runs(plans.tongue(panel.caption(plans.kinds(panel)))) for panel in plans.panels}
    fitting = {size: {panel for panel, head in heads.items()
                      if width(head, size, bold=True) <= panels[panel].width - 2 * CAPTION_SIDE_MM}
               for size in (HEADING, letters.mark)}
    large = HEADING if len(fitting[HEADING]) == len(heads) else letters.mark
    return {panel: (head, large if panel in fitting[large] else letters.text) for panel, head in heads.items()}


def caption(composition: Composition, panel: Panel, head: CaptionHead, scales: Scales) -> Iterator[Text]:
    """The caption of a plan that is drawn at these scales, under its head."""
    plans, arrangement = composition.plans, composition.arrangement
    texts = [sentence_runs(plans.tongue(scale)) for scale in scales.scale_texts(panel, plans.kinds(panel))]
    return caption_texts(arrangement.panels[panel], head, texts, arrangement.letters)


def caption_texts(rect: Rect, head: CaptionHead, scales: Sequence[Runs], letters: LetterSizes) -> Iterator[Text]:
    """The caption of a panel, in two lines at most, and under it the scales."""
    (called, size), room = head, rect.width - 2 * CAPTION_SIDE_MM
    lines = [(line, size, True) for line in wrap(called, size, room, bold=True)[:2]]
    fine = min(size, letters.mark) if len(lines) == 1 else letters.text
    lines += [(line, fine, False) for line in _scales(scales, fine, room)]
    y = rect.top - CAPTION_MARGIN
    for runs, high, bold in lines:
        y -= CAPS * high
        yield Text(pens.LETTERS, "text", None, (rect.left + CAPTION_SIDE_MM, y), runs, high, bold=bold)
        y -= max(LINE_GAP, depth(runs) * high)


def _scales(told: Sequence[Runs], size: float, room: float) -> list[Runs]:
    """Set scales in lines; a scale that fits on one line is not broken."""
    lines: list[Runs] = []
    for number, scale in enumerate(told, 1):
        part = (*scale, TextRun(",")) if number < len(told) else scale
        longer = (*lines[-1], *SPACE, *part) if lines else ()
        if longer and len(wrap(longer, size, room)) == 1:
            lines[-1] = longer
        else:
            lines.append(part)
    return [line for runs in lines for line in wrap(runs, size, room)]


# ---- a part of what is drawn -----------------------------------------------------------------------------------------


def step_range(drawn: Program, text: str) -> tuple[int, int]:
    """The first and the last step, by index, of a text such as `12` or `5-12`; fails with `Refused`."""
    first, _, last = text.partition("-")
    most = len(drawn) - drawn.givens
    if not (first.isdecimal() and (last or first).isdecimal() and 1 <= int(first) <= int(last or first) <= most):
        raise Refused(f"steps {text}", "out of range", f"numbers from 1 to {most}, such as 1-{most}")
    return int(first) - 1 + drawn.givens, int(last or first) - 1 + drawn.givens


def sheet_at_step(sheet: Sheet, last: int, first: int = 0) -> Sheet:
    """The sheet as it stands after the step of index `last`, with the steps before `first` in grey.

    The words end there too; results are read when all is drawn.
    """
    complete = last == len(sheet.sentences) - 1
    items = [item for item in sheet.items
             if (complete or item.layer not in (RESULTS, FOUND, ARMS) if item.step is None else item.step <= last)]
    return replace(sheet, items=tuple([ink_or_grey(item, first) for item in items]))


def with_numbers(composition: Composition) -> Composition:
    """The composition with every mark numbered by its step, lettered marks too."""
    return replace(composition, plans=replace(composition.plans, numbered=True))


def ink_or_grey(item: Item, first: int) -> Item:
    """The item as it is, or in grey if a step before `first` made it."""
    return item if item.step is None or item.step >= first else replace(item, pen=pale(item.pen))
