"""A sheet of captioned panels and, in a column beside them, what is given, found and drawn, step by step.

A subject gives records; paper, frame, captions, letters, title block, and where words run on are the same for all:

    page = PanelPage(paper, scene, column((1.3, MECHANISM), (1.0, row((1.0, FORCE), (1.25, CYCLE)))))
    figures = {FORCE: PanelFigure(page.room(FORCE), diagrams=[Diagram(...)]), ...}
    sheet = PanelSheet(page, said("Balancing sheet"), description, values, scale, figures, given=..., found=...)

    svg(pages(lambda paper: ..., "A3")[0])
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, groupby, pairwise
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel, Step
from graphplan.mechanism.model import Scene
from graphplan.phrases import Phrase, Said, arrange, digits, join, phrase, said
from graphplan.sheet.diagrams import Diagram, SheetText
from graphplan.sheet.frames.frame import SheetFrame, frame_of
from graphplan.sheet.frames.title import Page, TitleBlock
from graphplan.sheet.layout.facts_block import FOUND, GIVEN
from graphplan.sheet.layout.layout import back_to_front, caption_texts
from graphplan.sheet.layout.measures import CAPTION_SIDE_MM
from graphplan.sheet.layout.paper import lower_right, paginate_tightly, sheet_size, words_page
from graphplan.sheet.layout.scales import Scales, round_up
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import HEADING, SIZE, LetterSizes, letter_sizes, sentence_runs, width
from graphplan.sheet.lettering.letters import items_with_names, place_letters
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Outline, Rect, Sheet
from graphplan.sheet.plates.plate import DrawnStep, Plate
from graphplan.sheet.plates.view import View, clip_item, fit_scale, view
from graphplan.sheet.words.lengths import Lengths, PaperDistance
from graphplan.sheet.words.rows import (
    TICKED_INDENT,
    Cell,
    Placed,
    TextRow,
    answer_rows,
    fill,
    paragraph_rows,
    row_items,
    table_rows,
    with_tick_box,
)
from graphplan.words.tongue import Tongue, tongue

PAPERS = ("A3", "A2", "A1")
COLUMN_MM, GAP_MM = 96.0, 4.0  # the width of the words, and what is free beside them
CAPTION_MM, SCALES_MM = 7.0, 3.5  # the height of a caption, and of the scales under it
PANEL_MARGIN_MM = 3.0  # about what is drawn on a panel
MAX_STEPS_LEFT = 2  # steps that are told rather than counted
INDENT_MM, HEADING_GAP_MM = 8.0, 3.0  # of what hangs from a step's number, and over a heading

CHECKED = {  # what is computed once more by other means, by its name in JSON
    "path": said("path"), "velocity": said("velocity"), "acceleration": said("acceleration"),
    "shaking force": said("shaking force"), "shaking moment": said("shaking moment"),
    "counterweights": said("counterweights"), "orders": said("orders"), "points": said("points"),
    "lever": said("lever"), "energy": said("energy"), "motion": said("motion"), "curvature": said("curvature"),
    "law": said("law"), "friction": said("friction"), "load": said("load"),
    "corrections": said("corrections"), "residual_force": said("force left"), "residual_moment": said("moment left"),
    "trials": said("trials"), "replaced masses": said("replaced masses")}


class Blank(list[Sequence[Said | str]]):
    """The rows of a table to be filled in by hand: where there are numbers, or any words, there are empty boxes."""


Words = Said | str | Sequence[Sequence[Said | str]]  # a paragraph; or the rows of a table, its head first


def check_words(check: Mapping[str, float]) -> Said:
    """Return the relative differences of the independent checks in words."""
    return said("Independent checks differ by: {0}",
                join([join((CHECKED[name], digits(size, 2)), " ") for name, size in check.items()]))


class PaperLengths(Lengths):
    """The lengths of what is drawn in mm of paper: they are told as they are."""

    def _given_quantity(self, quantity: Quantity, laid: PaperDistance, where: int) -> Said:
        return arrange("{0}: {1}", quantity.written, laid.text) if quantity.written else laid.text


# ---- panels ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Division:
    """Parts beside each other, or one under the other, in shares: panels, or divisions of their own."""

    parts: tuple[tuple[float, Panel | Division], ...]
    across: bool

    def rects(self, rect: Rect) -> dict[Panel, Rect]:
        """The panels in a rectangle."""
        whole, found = sum(share for share, _ in self.parts), dict[Panel, Rect]()
        edges = pairwise(accumulate((share / whole for share, _ in self.parts), initial=0.0))
        for (start, end), (_, part) in zip(edges, self.parts, strict=True):
            inner = rect._replace(left=rect.left + start * rect.width, right=rect.left + end * rect.width) if \
                self.across else rect._replace(top=rect.top - start * rect.height, bottom=rect.top - end * rect.height)
            found |= part.rects(inner) if isinstance(part, Division) else {part: inner}
        return found


def row(*parts: tuple[float, Panel | Division]) -> Division:
    """A rectangle divided from left to right."""
    return Division(parts, True)


def column(*parts: tuple[float, Panel | Division]) -> Division:
    """A rectangle divided from the top down."""
    return Division(parts, False)


def fit_view(box: Rect, room: Rect, margin: float = 0.0, beside: float | None = None) -> View:
    """A view with a box in the middle of a room, at the largest round scale at which it has so wide a margin."""
    beside = margin if beside is None else beside
    return view(box, room, float(round_up(fit_scale(box, room.inset(beside, margin, beside, margin)) or 1.0)))


@dataclass(frozen=True)
class PanelFigure:
    """The content of a panel: diagrams, the plate of a construction, other strokes as far as they lie on the panel, and
    letters that avoid them all: those wished for, and the names of the marks that are `is_named`.

    Over it stand a heading, the panel's own where there is no other, and scales; a figure of strokes alone has letters
    beside `marks`.
    """

    rect: Rect
    diagrams: Sequence[Diagram] = ()
    plate: Plate | None = None
    strokes: Iterable[Item] = ()
    wishes: Sequence[Wish] = ()
    is_named: Callable[[DrawnStep], bool] = lambda mark: True
    heading: Said | None = None
    scales: Said | None = None
    given: bool = False  # whether only steps that are given are shown, as on a task

    def items(self, text: SheetText) -> list[Item]:
        """All of it."""
        items = [item for stroke in self.strokes for item in clip_item(stroke, self.rect)]
        items += [item for diagram in self.diagrams for item in text.diagram(diagram)]
        if self.plate:
            shown = items_with_names(self.plate, items, self.wishes, self.is_named)
            if self.given:
                steps = self.plate.steps
                numbered = {mark.index for mark in steps if mark.number}
                return [item for item in shown if item.step not in numbered]
            return shown
        marks = [wish.spots[0] for wish in self.wishes if not wish.free]
        return [*items, *place_letters(self.wishes, items, marks, self.rect, text.letters)]


@dataclass(frozen=True)
class PanelPage:
    """The first page of a sheet on a paper: inside the frame a column of words over the title block, and left of it the
    panels in a division. The scene has title, frame, language and the convention of scales."""

    paper: str
    scene: Scene
    division: Division
    scales_told: bool = False  # under captions

    @property
    def tongue(self) -> Tongue:
        return tongue(self.scene.sheet.language)

    @property
    def letters(self) -> LetterSizes:
        return letter_sizes(self.paper)

    @property
    def text(self) -> SheetText:
        """The lettering of the page."""
        return SheetText(self.letters, self.tongue, self.scene.sheet.convention)

    @property
    def frame(self) -> tuple[SheetFrame, TitleBlock]:
        """The frame and the title block."""
        frame = frame_of(self.scene)
        return frame, frame.block(self.scene, self.tongue)

    @cached_property
    def space(self) -> Rect:
        """The paper inside the frame."""
        return self.frame[0].space(*sheet_size(self.paper))

    @property
    def _pitch(self) -> float:
        """The width of the column of words with what is free beside it."""
        return self.letters.times * COLUMN_MM + 2 * GAP_MM

    @cached_property
    def title(self) -> Rect:
        """The title block, under the words."""
        return lower_right(self.space, self._pitch, self.frame[1].on_paper(self.paper))

    @cached_property
    def panels(self) -> Mapping[Panel, Rect]:
        """The panels; they end above a title block that is wider than the words."""
        room = self.space._replace(right=self.space.right - self._pitch)
        wider = self.title.left < room.right - 0.1
        return self.division.rects(room._replace(bottom=self.title.top) if wider else room)

    @property
    def column(self) -> Rect:
        """The column of words."""
        right = self.space.right - GAP_MM
        return Rect(right - self.letters.times * COLUMN_MM, self.title.top + GAP_MM, right, self.space.top - GAP_MM)

    def room(self, panel: Panel) -> Rect:
        """The room of a panel under its caption."""
        caption, margin = CAPTION_MM + (SCALES_MM if self.scales_told else 0.0), PANEL_MARGIN_MM
        return self.panels[panel].inset(margin, margin, margin, margin + self.letters.times * caption)


# ---- the sheet ------------------------------------------------------------------------------------------------------


IN_MM = Scales(1.0, 1.0, "mm", {})  # of what is drawn in mm of paper
FOUND_HEADING, SAME_FOR_OTHERS = said("Found"), phrase("Steps {0} to {1}: the same for the others.")
SAME_AT_DIVISIONS = phrase("Steps {0} to {1}: the same at the other divisions.")


@dataclass(frozen=True)
class PanelSheet:
    """A sheet as data: its page, what the title block calls it, a description for those who cannot see it, a drawing
    with the values of its marks, the scale in the title block, and the figures of its panels.

    Words are given, found, and `tables`, which stand under that or where they have no room there before the steps. On
    the panels that are `told_once` one figure tells what is done again and again. Steps are `told` (on pages of their
    own where `steps_apart`), have boxes to be `ticked`, or are left out.
    """

    page: PanelPage
    document: Said
    description: Said
    values: Values
    scale: Said
    figures: Mapping[Panel, PanelFigure]
    scales: Scales = IN_MM
    given: Sequence[Words] = ()
    found: Sequence[Words] = ()
    tables: Sequence[Words] = ()
    found_heading: Said = FOUND_HEADING
    names: tuple[str, ...] = ()  # of quantities, such as omega_max, beside those of marks
    told_once: Collection[Panel] | None = None  # all where none are named
    repetition_note: Phrase = SAME_FOR_OTHERS
    steps: str = "told"
    steps_apart: bool = False
    lengths: Lengths | None = None
    first: int = 1
    of: int = 0

    @property
    def scene(self) -> Scene:
        return self.page.scene

    @property
    def tongue(self) -> Tongue:
        return self.page.tongue

    # ---- pages -----------------------------------------------------------------------------------------------------

    def pages(self) -> list[Sheet] | None:
        """The sheet, its steps beside the panels where they have room there, else on pages of their own, and so its
        tables; None where what is given and found has no room."""
        summary, tables = self.summary_rows, [row for words in self.tables for row in self.rows_of(words)]
        steps = self.step_rows
        ways: list[tuple[list[TextRow], list[TextRow]]] = [] if self.steps_apart else [(summary + tables + steps, [])]
        for rows, later in (*ways, (summary + tables, steps), (summary, tables + steps)):
            if (placed := self._place_words(rows)) is not None:
                further = self.pages_of_words(later, 1) if later else []
                return [self._sheet(self.page.panels, [*self._frame_items(self.page.title, 0, 1 + len(further)),
                                                       *self._panel_items(), *row_items(placed)]), *further]
        return None

    def _place_words(self, rows: Sequence[TextRow]) -> list[Placed] | None:
        """Words in their column; None where they do not fit."""
        return fill([row.enlarge(self.page.letters.times) for row in rows], [self.page.column])

    def pages_of_words(self, rows: Iterable[TextRow], earlier: int = 0) -> list[Sheet]:
        """Pages of words alone, after so many earlier ones."""
        paper, (frame, block) = self.page.paper, self.page.frame
        page = words_page(paper, frame, block)
        filled = paginate_tightly([row.enlarge(self.page.letters.times) for row in rows], page)
        return [self._sheet({}, [*self._frame_items(page.title, number, earlier + len(filled)), *row_items(placed)])
                for number, placed in enumerate(filled, earlier)]

    def _sheet(self, panels: Mapping[Panel, Rect], items: Iterable[Item]) -> Sheet:
        """A page with what is on it as one display list."""
        wide, high = sheet_size(self.page.paper)
        program = self.values.drawing.program
        sentences = tuple(self.tongue(program.sentence_with_reason(step.index)) for step in program.steps)
        return Sheet(wide, high, self.page.space, {str(panel): rect for panel, rect in panels.items()},
                     tuple(back_to_front(items)), self.scene.title, self.tongue(self.description), sentences,
                     self.scales, self.tongue.code, self.scene.text, program.givens)

    def _frame_items(self, title: Rect, earlier: int, of: int) -> Iterator[Item]:
        """The frame and the title block of the page after so many earlier ones of the sheet's own."""
        (frame, block), paper = self.page.frame, self.page.paper
        yield from frame.items(paper, self.page.space, self.tongue)
        page = Page(self.document, paper, self.tongue(self.scale), self.first + earlier, self.of or of)
        yield from block.on_paper(paper).items(title, page)

    def _panel_items(self) -> Iterator[Item]:
        """The panels with their captions and figures."""
        letters, text = self.page.letters, self.page.text
        for panel, rect in self.page.panels.items():
            figure = self.figures[panel]
            yield Outline(pens.BORDER, "paper", None, rect.corners, str(panel))
            head = sentence_runs(self.tongue(figure.heading or panel.heading))
            fits = width(head, letters.mark, bold=True) <= rect.width - 2 * CAPTION_SIDE_MM
            scales = [sentence_runs(self.tongue(figure.scales))] if figure.scales else []
            yield from caption_texts(rect, (head, letters.mark if fits else letters.text), scales, letters)
            yield from figure.items(text)

    # ---- words -----------------------------------------------------------------------------------------------------

    @property
    def summary_rows(self) -> list[TextRow]:
        """Rows with what is given and found."""
        sections = (said("Given"), self.given, GIVEN), (self.found_heading, self.found, FOUND)
        return [replace(row, layer=layer) for heading, contents, layer in sections if contents
                for row in (self.heading(heading), *(row for words in contents for row in self.rows_of(words)))]

    def heading(self, words: Said, size: float = HEADING, gap: float = HEADING_GAP_MM) -> TextRow:
        """A row with a heading."""
        heading = Cell(0.0, sentence_runs(self.tongue(words)), bold=True)
        return TextRow((heading,), size=size, gap=gap, keep=2)

    def rows_of(self, words: Words, number: str = "", step: int | None = None) -> Iterator[TextRow]:
        """A table, or words in lines that hang from a number."""
        if isinstance(words, str):
            runs = sentence_runs(self.tongue(words), self._names)
            yield from paragraph_rows(runs, COLUMN_MM, TICKED_INDENT if self.steps == "ticked" else INDENT_MM, number,
                                      step)
        else:
            table = [[sentence_runs(self.tongue(cell), self._names) for cell in row] for row in words]
            yield from answer_rows(table, COLUMN_MM) if isinstance(words, Blank) else table_rows(table)

    @cached_property
    def _names(self) -> tuple[str, ...]:
        """The names that words are set with."""
        return (*(step.name for step in self.values.drawing.program.steps if step.name), *self.names)

    @property
    def step_rows(self) -> list[TextRow]:
        """The construction in words."""
        if not self.steps:
            return []
        rows = [self.heading(said("Construction")), *self._steps()]
        return [with_tick_box(row) if self.steps == "ticked" and len(row.cells) > 1 else row for row in rows]

    def _steps(self) -> Iterator[TextRow]:
        """Stage by stage what is done in it, each kind of step once, and which steps are the same elsewhere."""
        program = self.values.drawing.program
        for stage, steps in program.stages:
            yield self.heading(stage.title, SIZE, HEADING_GAP_MM / 2)
            yield from self.rows_of(arrange("{0:capital}.", stage.law))
            told_once = self.told_once is None or steps[0].panel in self.told_once
            for spoken, repeated in without_repetitions(steps) if told_once else [(steps, ())]:
                for step in spoken:
                    number = str(program.number(step.index))
                    yield from self.rows_of(self.sentence_with_lengths(step), number, step.index)
                if repeated:
                    first, last = (program.number(step.index) for step in (repeated[0], repeated[-1]))
                    yield from self.rows_of(self.repetition_note(first, last))

    def measure(self, panel: Panel) -> Lengths:
        """Return the lengths on paper of what is drawn on a panel."""
        return self.lengths or self._lengths[self.values.drawing.on_paper(panel)]

    @cached_property
    def _lengths(self) -> tuple[Lengths, Lengths]:
        """Lengths on paper of what is drawn in lengths, and of what is drawn in mm."""
        program = self.values.drawing.program
        read = program, self.values.numbers, lambda index: program.steps[index].panel, self.scales
        return Lengths(*read), PaperLengths(*read)

    def sentence_with_lengths(self, step: Step) -> Said:
        """A step in words, with its length on paper."""
        sentence, lengths = self.values.drawing.program.sentence_with_reason(step.index), self.measure(step.panel)
        return join((sentence, *(arrange("{0}.", length.text) for length in lengths.for_step(step))), " ")


def pages(sheet_on: Callable[[str], PanelSheet], paper: str | None = None,
          papers: Sequence[str] = PAPERS) -> list[Sheet]:
    """A sheet on the paper named, or on the smallest of some on which what is given and found has room; fails with
    `Refused` where it has none."""
    for name in [paper] if paper else papers:
        if sheets := sheet_on(name).pages():
            return sheets
    raise Refused(f"paper {paper or papers[-1]}", "what is given and found does not fit on it",
                  "a larger one, or no name")


def without_repetitions(steps: Sequence[Step]) -> Iterator[tuple[Sequence[Step], Sequence[Step]]]:
    """The steps of a stage that are told, each time with those after them that do the same again.

    Told are the first, until all that is done in the stage has been done once, but of many alike one after the other
    the first alone.
    """
    first, repeated = first_figure(steps)
    spoken: list[Step] = []
    for run in (list(run) for _, run in groupby(first, kind_of)):
        if len(run) > MAX_STEPS_LEFT + 1:
            yield [*spoken, run[0]], run[1:]
            spoken = []
        else:
            spoken += run
    yield spoken, repeated


def kind_of(step: Step) -> tuple[Any, str]:
    """Return the operation of a step and the pattern of its reason."""
    return step.op, getattr(step.why, "key", step.why)


def first_figure(steps: Sequence[Step]) -> tuple[Sequence[Step], Sequence[Step]]:
    """The first steps of a stage, until all that is done in it has been done once, and the others."""
    kinds = [kind_of(step) for step in steps]
    again = next((kind for k, kind in enumerate(kinds) if kind in kinds[:k]), None)
    end = max(kinds.index(kind) for kind in kinds) + 1
    while again is not None and end < len(kinds) and kinds[end] != again:
        end += 1
    return (steps[:end], steps[end:]) if len(steps) - end > MAX_STEPS_LEFT else (steps, ())
