"""A sheet of captioned panels and, in a column beside them, what is given, found and drawn, step by step.

A kind of sheet says what it shows; paper, frame, captions, title block, and where words run on are the same for all:

    class Balance(Panelled):
        document = said("Balancing sheet")
        def panels_in(self, room): return dict(zip((FORCES, MOMENTS), divide_across(room, 1, 1)))
        def figure(self, panel, rect): return items_with_names(self.plate(panel, rect))

    svg(pages(Balance, paper)[0])
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, groupby, pairwise
from typing import Any, ClassVar

from graphplan.errors import Refused
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel, Step
from graphplan.mechanism.model import Scene
from graphplan.phrases import Phrase, Said, arrange, digits, join, phrase, said
from graphplan.sheet.frames.frame import SheetFrame, frame_of
from graphplan.sheet.frames.title import Page, TitleBlock
from graphplan.sheet.layout.facts_block import FOUND, GIVEN
from graphplan.sheet.layout.layout import back_to_front
from graphplan.sheet.layout.paper import lower_right, paginate_tightly, sheet_size, words_page
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import HEADING, SIZE, LetterSizes, letter_sizes, sentence_runs, width, wrap
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Outline, Rect, Sheet, Text
from graphplan.sheet.words.lengths import Lengths, PaperDistance
from graphplan.sheet.words.rows import Cell, Placed, TextRow, answer_rows, fill, paragraph_rows, row_items
from graphplan.sheet.words.rows import table_rows as table_rows
from graphplan.words.tongue import Tongue, tongue

PAPERS = ("A3", "A2", "A1")
COLUMN_MM, GAP_MM = 96.0, 4.0  # the width of the words, and what is free beside them
CAPTION_MM, SCALES_MM = 7.0, 3.5  # the height of a caption, and of the scales under it
PANEL_MARGIN_MM, CAPTION_INDENT_MM = 3.0, 2.5  # about what is drawn on a panel, and left of its caption
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
    """How far the independent checks of a subject are from it."""
    return said("Independent checks differ by: {0}",
                join([join((CHECKED[name], digits(size, 2)), " ") for name, size in check.items()]))


class PaperLengths(Lengths):
    """The lengths of what is drawn in mm of paper: they are told as they are."""

    def _given_quantity(self, quantity: Quantity, laid: PaperDistance, where: int) -> Said:
        return arrange("{0}: {1}", quantity.written, laid.text) if quantity.written else laid.text


@dataclass(frozen=True)
class Panelled(ABC):
    """One kind of sheet on one paper."""

    paper: str
    told_scales: ClassVar[bool] = False  # under captions
    steps_apart: ClassVar[bool] = False  # the steps stand on pages of their own, whatever room there is
    repetition_note: ClassVar[Phrase] = phrase("Steps {0} to {1}: the same for the others.")
    indent: ClassVar[float] = INDENT_MM
    letters_of: ClassVar[tuple[str, ...]] = ()  # quantities, such as omega_max, beside the marks of the construction

    # ---- what a kind of sheet says ---------------------------------------------------------------------------------

    @property
    @abstractmethod
    def document(self) -> Said:
        """What the title block calls it."""

    @property
    @abstractmethod
    def scene(self) -> Scene:
        """What title, frame, language and the convention of scales are read from, and what is kept in the file."""

    @property
    @abstractmethod
    def description(self) -> Said:
        """What a reader who cannot see the sheet is told."""

    @property
    @abstractmethod
    def values(self) -> Values:
        """The drawing, with the values of its marks."""

    @property
    def scales(self) -> Scales:
        """How many lengths a mm of paper is on its plans."""
        return Scales(1.0, 1.0, "mm", {})

    @property
    @abstractmethod
    def scale(self) -> Said:
        """The scale of which the title block speaks."""

    @abstractmethod
    def panels_in(self, room: Rect) -> Mapping[Panel, Rect]:
        """The panels in what the words leave of the paper."""

    @abstractmethod
    def figure(self, panel: Panel, rect: Rect) -> Iterable[Item]:
        """What is drawn on a panel, in the room under its caption."""

    def heading(self, panel: Panel) -> tuple[Said, Said | None]:
        """What stands over a panel, and under that its scales where these are told there."""
        return panel.heading, None

    @property
    def results_heading(self) -> Said:
        """What stands over the results."""
        return said("Found")

    def repeats(self, panel: Panel) -> bool:
        """Whether the stages that begin on a panel do the same again and again, so that one figure tells it all."""
        return True

    def given_words(self) -> Iterable[Words]:
        """What is given."""
        return ()

    def result_words(self) -> Iterable[Words]:
        """What is found."""
        return ()

    def tables(self) -> Iterable[Words]:
        """What stands under that, or where it has no room there before the steps."""
        return ()

    # ---- paper -----------------------------------------------------------------------------------------------------

    @property
    def tongue(self) -> Tongue:
        return tongue(self.scene.sheet.language)

    @property
    def letters(self) -> LetterSizes:
        return letter_sizes(self.paper)

    @property
    def _frame(self) -> tuple[SheetFrame, TitleBlock]:
        """The frame and the title block."""
        frame = frame_of(self.scene)
        return frame, frame.block(self.scene, self.tongue)

    @property
    def space(self) -> Rect:
        """The paper inside the frame."""
        return self._frame[0].space(*sheet_size(self.paper))

    @property
    def _pitch(self) -> float:
        """How wide the column of words is with what is free beside it."""
        return self.letters.times * COLUMN_MM + 2 * GAP_MM

    @cached_property
    def title(self) -> Rect:
        """Where the title block stands: under the words."""
        return lower_right(self.space, self._pitch, self._frame[1].on_paper(self.paper))

    @property
    def panels(self) -> Mapping[Panel, Rect]:
        """The panels; they end above a title block that is wider than the words."""
        room = replace(self.space, right=self.space.right - self._pitch)
        wider = self.title.left < room.right - 0.1
        return self.panels_in(replace(room, bottom=self.title.top) if wider else room)

    def room(self, panel: Panel) -> Rect:
        """The room of a panel under its caption."""
        caption, margin = CAPTION_MM + (SCALES_MM if self.told_scales else 0.0), PANEL_MARGIN_MM
        return self.panels[panel].inset(margin, margin, margin, margin + self.letters.times * caption)

    # ---- pages -----------------------------------------------------------------------------------------------------

    def place_words(self, rows: Sequence[TextRow]) -> list[Placed] | None:
        """Words in their column; nothing where they do not fit."""
        right, times = self.space.right - GAP_MM, self.letters.times
        column = Rect(right - times * COLUMN_MM, self.title.top + GAP_MM, right, self.space.top - GAP_MM)
        return fill([row.enlarge(times) for row in rows], [column])

    @cached_property
    def summary_rows(self) -> list[TextRow]:
        """What is given and found."""
        sections = {GIVEN: self._section(said("Given"), self.given_words()),
                    FOUND: self._section(self.results_heading, self.result_words())}
        return [replace(row, layer=layer) for layer, rows in sections.items() for row in rows]

    @property
    def rows_of_tables(self) -> list[TextRow]:
        """Its tables."""
        return [row for words in self.tables() for row in self.words_rows(words)]

    @cached_property
    def step_rows(self) -> list[TextRow]:
        """The construction in words."""
        return [self._heading(said("Construction")), *self._steps()]

    def sheet_with_all_words(self) -> list[Sheet]:
        """The sheet with all words on it."""
        return [self._page([*self.summary_rows, *self.rows_of_tables, *self.step_rows], 1)]

    def sheet_with_steps_apart(self, beside: bool = True) -> list[Sheet]:
        """The sheet with what is given and found, and the pages that follow it: of its steps, and of its tables where
        they do not stand `beside` the panels."""
        tables = self.rows_of_tables
        first, rows = [*self.summary_rows, *(tables if beside else ())], [*(() if beside else tables), *self.step_rows]
        later = self.pages_of_words(rows, 1)
        return [self._page(first, 1 + len(later)), *later]

    def pages_of_words(self, rows: Iterable[TextRow], earlier: int = 0) -> list[Sheet]:
        """Pages of words alone, after so many earlier ones."""
        page = words_page(self.paper, *self._frame)
        filled = paginate_tightly([row.enlarge(self.letters.times) for row in rows], page)
        return [self._sheet({}, [*self._frame_items(page.title, {}, number, earlier + len(filled)),
                                 *row_items(rows_on_page)]) for number, rows_on_page in enumerate(filled, earlier + 1)]

    def _page(self, rows: Sequence[TextRow], count: int) -> Sheet:
        """The first of so many pages, with these words."""
        items = [*self._frame_items(self.title, self.panels, 1, count)]
        for panel in self.panels:
            items += self.figure(panel, self.room(panel))
        return self._sheet(self.panels, [*items, *row_items(self.place_words(rows) or [])])

    def _sheet(self, panels: Mapping[Panel, Rect], items: Iterable[Item]) -> Sheet:
        """A page with what is on it as one display list."""
        wide, high = sheet_size(self.paper)
        program = self.values.drawing.program
        sentences = tuple(self.tongue(program.sentence_with_reason(step.index)) for step in program.steps)
        return Sheet(wide, high, self.space, {str(panel): rect for panel, rect in panels.items()},
                     tuple(back_to_front(items)), self.scene.title, self.tongue(self.description), sentences,
                     self.scales, self.tongue.code, self.scene.text, program.givens)

    def _frame_items(self, title: Rect, panels: Mapping[Panel, Rect], number: int, of: int) -> Iterator[Item]:
        """Frame, panels with their captions, and the title block, of one page of so many."""
        frame, block = self._frame
        yield from frame.items(self.paper, self.space, self.tongue)
        for panel, rect in panels.items():
            yield Outline(pens.BORDER, "paper", None, rect.corners, str(panel))
            yield from self._caption(panel, rect)
        page = Page(self.document, self.paper, self.tongue(self.scale), number, of)
        yield from block.on_paper(self.paper).items(title, page)

    def _caption(self, panel: Panel, rect: Rect) -> Iterator[Item]:
        """What a panel is, in letters of marks where that has room on a line, else in small ones; under it its scales.
        """
        large, small, room = self.letters.mark, self.letters.text, rect.width - 2 * CAPTION_INDENT_MM
        heading, scales = self.heading(panel)
        runs, y = sentence_runs(self.tongue(heading)), rect.top - 1.6 * large
        letter_size = large if width(runs, large, bold=True) <= room else small
        lines = [(line, letter_size, True) for line in wrap(runs, letter_size, room, bold=True)[:2]]
        scale_runs = sentence_runs(self.tongue(scales)) if scales else ()
        for line, high, bold in [*lines, *((line, small, False) for line in wrap(scale_runs, small, room)[:1])]:
            yield Text(pens.LETTERS, "text", None, (rect.left + CAPTION_INDENT_MM, y), line, high, bold=bold)
            y -= 1.5 * small

    # ---- words -----------------------------------------------------------------------------------------------------

    def _section(self, heading: Said, contents: Iterable[Words]) -> Iterator[TextRow]:
        """A heading with what is under it, if anything is."""
        rows = [row for words in contents for row in self.words_rows(words)]
        if rows:
            yield self._heading(heading)
            yield from rows

    def _heading(self, words: Said, size: float = HEADING) -> TextRow:
        heading = Cell(0.0, sentence_runs(self.tongue(words)), bold=True)
        return TextRow((heading,), size=size, gap=HEADING_GAP_MM, keep=2)

    def words_rows(self, words: Words, number: str = "", step: int | None = None) -> Iterator[TextRow]:
        """A table, or words in lines that hang from a number."""
        if isinstance(words, str):
            runs = sentence_runs(self.tongue(words), self._names)
            yield from paragraph_rows(runs, COLUMN_MM, self.indent, number, step)
        else:
            table = [[sentence_runs(self.tongue(cell), self._names) for cell in row] for row in words]
            yield from answer_rows(table, COLUMN_MM) if isinstance(words, Blank) else table_rows(table)

    @cached_property
    def _names(self) -> tuple[str, ...]:
        """The names that words are set with."""
        return (*(step.name for step in self.values.drawing.program.steps if step.name), *self.letters_of)

    def _steps(self) -> Iterator[TextRow]:
        """Stage by stage what is done in it, each kind of step once, and which steps are the same elsewhere."""
        program = self.values.drawing.program
        for stage, steps in program.stages:
            yield replace(self._heading(stage.title, SIZE), gap=HEADING_GAP_MM / 2)
            yield from self.words_rows(arrange("{0:capital}.", stage.law))
            runs = without_repetitions(steps) if self.repeats(steps[0].panel) else [(steps, ())]
            for spoken, repeated in runs:
                for step in spoken:
                    number = str(program.number(step.index))
                    yield from self.words_rows(self.sentence_with_lengths(step), number, step.index)
                if repeated:
                    first, last = (program.number(step.index) for step in (repeated[0], repeated[-1]))
                    yield from self.words_rows(self.repetition_note(first, last))

    def measure(self, panel: Panel) -> Lengths:
        """How long on paper what is drawn on a panel is."""
        return self._lengths[self.values.drawing.on_paper(panel)]

    @cached_property
    def _lengths(self) -> tuple[Lengths, Lengths]:
        """How long on paper what is drawn in lengths is, and what is drawn in mm."""
        program = self.values.drawing.program
        read = program, self.values.numbers, lambda index: program.steps[index].panel, self.scales
        return Lengths(*read), PaperLengths(*read)

    def sentence_with_lengths(self, step: Step) -> Said:
        """A step in words, with its length on paper."""
        sentence, lengths = self.values.drawing.program.sentence_with_reason(step.index), self.measure(step.panel)
        return join((sentence, *(arrange("{0}.", length.text) for length in lengths.for_step(step))), " ")


def pages(kind: Callable[[str], Panelled], paper: str | None = None, papers: Sequence[str] = PAPERS) -> list[Sheet]:
    """A sheet on the paper named, or on the smallest of some on which what is given and found has room.

    Where the steps have none beside it, and the tables, they stand on pages of their own. Fails with `Refused` where
    what is given and found has none either.
    """
    sheets = [kind(name) for name in ([paper] if paper else papers)]
    for sheet in sheets:
        summary, tables = sheet.summary_rows, sheet.rows_of_tables
        if not sheet.steps_apart and sheet.place_words([*summary, *tables, *sheet.step_rows]) is not None:
            return sheet.sheet_with_all_words()
        for beside in (True, False):
            if sheet.place_words([*summary, *(tables if beside else ())]) is not None:
                return sheet.sheet_with_steps_apart(beside)
    raise Refused(f"paper {sheets[-1].paper}", "what is given and found does not fit on it", "a larger one, or no name")


def without_repetitions(steps: Sequence[Step]) -> Iterator[tuple[Sequence[Step], Sequence[Step]]]:
    """The steps of a stage that are told, each time with those after them that do the same again.

    Told are the first, until all that is done in the stage has been done once, but of many alike one after the other
    the first alone.
    """
    first, repeated = first_figure(steps)
    alike = [list(run) for _, run in groupby(first, kind_of)]
    spoken: list[Step] = []
    for run in alike:
        if len(run) > MAX_STEPS_LEFT + 1:
            yield [*spoken, run[0]], run[1:]
            spoken = []
        else:
            spoken += run
    yield spoken, repeated


def kind_of(step: Step) -> tuple[Any, str]:
    """What a step does, and why, whatever is put into that."""
    return step.op, getattr(step.why, "key", step.why)


def first_figure(steps: Sequence[Step]) -> tuple[Sequence[Step], Sequence[Step]]:
    """The first steps of a stage, until all that is done in it has been done once, and the others."""
    kinds = [kind_of(step) for step in steps]
    again = next((kind for k, kind in enumerate(kinds) if kind in kinds[:k]), None)
    end = max(kinds.index(kind) for kind in kinds) + 1
    while again is not None and end < len(kinds) and kinds[end] != again:
        end += 1
    return (steps[:end], steps[end:]) if len(steps) - end > MAX_STEPS_LEFT else (steps, ())


def divide_across(rect: Rect, *shares: float) -> list[Rect]:
    """A rectangle divided from left to right in these shares."""
    edges = [rect.left + rect.width * share / sum(shares) for share in accumulate(shares, initial=0.0)]
    return [replace(rect, left=start, right=right) for start, right in pairwise(edges)]


def divide_down(rect: Rect, *shares: float) -> list[Rect]:
    """A rectangle divided from the top down in these shares."""
    edges = [rect.top - rect.height * share / sum(shares) for share in accumulate(shares, initial=0.0)]
    return [replace(rect, top=top, bottom=low) for top, low in pairwise(edges)]
