"""The construction in pictures on pages: the film strip, and the pages by stages, which follow the sheet.

What is new in a picture is in ink, what it uses of before is in grey, and its steps stand below in words. Pictures run
down the columns of a page. Pages by stages have larger ones, each with the equation and the law of its stage.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphplan.errors import Refused
from graphplan.phrases import Said, arrange, said
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.frames.title import CONSTRUCTION, STRIP, Page, TitleBlock
from graphplan.sheet.layout.composition import Composition, with_results_alone
from graphplan.sheet.layout.layout import pages
from graphplan.sheet.layout.measures import COLUMN_MM
from graphplan.sheet.layout.paper import lower_right, sheet_size
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import SIZE, letter_sizes, sentence_runs, wrap
from graphplan.sheet.pictures import MARK, STAGE, STEP, Part, Picture, pictures
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Outline, Rect, Sheet, Spot, move_item
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.protocol import Protocol
from graphplan.sheet.words.rows import LEADING, Cell, TextRow, row_items
from graphplan.sheet.words.texts import SheetWords

COLUMN_WIDTHS = {MARK: 84.0, STEP: 84.0, STAGE: 176.0}  # mm: about how wide columns are
PICTURE_SHARE = 0.58  # of a column has a picture that has its words beside it
MAX_HEIGHT = {MARK: 0.7, STEP: 0.7, STAGE: 0.63}  # of its width: no picture is higher
GAP, WORDS_GAP, PICTURE_GAP = 4.0, 1.2, 5.0  # mm: beside pictures, above words and below them
USUAL_PAPER = "A3"  # paper
NO_SCALE = "—"  # of a sheet with pictures in scales of their own


def strip(composition: Composition, paper: str | None = None, *, cut: str = MARK) -> list[Sheet]:
    """The film strip of a composed construction, page by page, with a picture for every lettered `mark`, or `step`.

    It is on the paper named, or that of the scene's sheet, else A3; its pictures have scales of their own. Fails
    with `Refused` where a picture with its words is larger than the paper.
    """
    return Strip.from_composition(composition, cut, paper).sheets


def by_stages(composition: Composition, paper: str | None = None) -> tuple[list[Sheet], list[Sheet]]:
    """The pages of a composed construction that is told by stages: sheet and results, then the stages.

    Every stage has its equation, its law, and its steps beside an enlarged picture, on the paper named, or that of the
    scene's sheet, else A3. It is for what is drawn on one sheet, but cannot be read there. Fails as :func:`strip` does.
    """
    film = Strip.from_composition(composition, STAGE, paper)
    whole = with_results_alone(composition)
    before = pages(replace(whole, further=len(film.pages)))
    return before, film.sheets_after(len(before))


@dataclass(frozen=True)
class Strip:
    """The pictures of one construction on sheets of one paper."""

    protocol: Protocol
    cut: str
    paper: str

    @classmethod
    def from_composition(cls, composition: Composition, cut: str, paper: str | None = None) -> Strip:
        """The strip of a composed construction, in its pose alone.

        By stages an A4 stands upright, as words are beside the pictures, and lengths are told: those of the sheet.
        """
        plans = replace(composition.plans, motion=None, unfolded=True)
        named = paper or plans.drawing.scene.sheet.paper or USUAL_PAPER
        named = f"{named} portrait" if cut == STAGE and named == "A4" else named
        scales = composition.scales if cut == STAGE else None
        return cls(Protocol(plans, scales), cut, frame_of(plans.drawing.scene).paper(named))

    @property
    def plans(self) -> Plans:
        return self.protocol.plans

    @property
    def paper_size(self) -> tuple[float, float]:
        """Width and height of a sheet."""
        return sheet_size(self.paper)

    @property
    def times(self) -> float:
        """Enlargement of pictures and words on this paper."""
        return letter_sizes(self.paper).times

    @property
    def title(self) -> TitleBlock:
        """The title block in the letters of this paper."""
        scene = self.plans.drawing.scene
        return frame_of(scene).block(scene, self.plans.tongue).on_paper(self.paper)

    @property
    def frame(self) -> Rect:
        return frame_of(self.plans.drawing.scene).space(*self.paper_size)

    @property
    def block(self) -> Rect:
        """Place of the title block."""
        return lower_right(self.frame, self.times * COLUMN_MM, self.title)

    @cached_property
    def columns(self) -> list[Rect]:
        """The columns of a page as they are set, those over the title block ending above it."""
        frame, block = self.frame.times(1 / self.times), self.block.times(1 / self.times)
        count = max(1, round((frame.width - GAP) / (COLUMN_WIDTHS[self.cut] + GAP)))
        pitch = (frame.width - GAP) / count
        lefts = [frame.left + GAP + i * pitch for i in range(count)]
        feet = [block.top if left + pitch - GAP > block.left else frame.bottom for left in lefts]
        return [Rect(left, foot + 2.0, left + pitch - GAP, frame.top - 2.0)
                for left, foot in zip(lefts, feet, strict=True)]

    @cached_property
    def pictures(self) -> list[Picture]:
        tallest = max(column.height for column in self.columns)
        cut_pictures = pictures(self.protocol, self.cut, (self.wide, MAX_HEIGHT[self.cut] * self.wide),
                                lambda one: self._height(one) <= tallest)
        if max(map(self._height, cut_pictures), default=0.0) > tallest:
            raise Refused("film strip", "a picture with its words is larger than the sheet", "a larger --paper")
        return cut_pictures

    @property
    def wide(self) -> float:
        """Width of a picture: a column, or the part of it that the words beside it leave."""
        return self.columns[0].width * (PICTURE_SHARE if self.cut == STAGE else 1.0)

    @property
    def words_wide(self) -> float:
        """Width of the words."""
        return self.columns[0].width - self.wide - GAP if self.cut == STAGE else self.wide

    @cached_property
    def pages(self) -> list[list[tuple[int, Spot]]]:
        """For each page its pictures by number, and where each has its upper left corner."""
        return list(self._pages())

    @property
    def sheets(self) -> list[Sheet]:
        """All pages."""
        return self.sheets_after(0)

    def sheets_after(self, others: int) -> list[Sheet]:
        """The pages, where so many others come before them."""
        of = others + len(self.pages)
        return [self._sheet(page, number, of) for number, page in enumerate(self.pages, others + 1)]

    def _pages(self) -> Iterator[list[tuple[int, Spot]]]:
        page, places = list[tuple[int, Spot]](), list[Rect]()
        place, y = Rect(0.0, 0.0, 0.0, 0.0), 0.0
        for number, picture in enumerate(self.pictures):
            high = self._height(picture)
            while y - high < place.bottom:
                if not places and page:
                    yield page
                    page = []
                places = places or [*self.columns]
                place = places.pop(0)
                y = place.top
            page.append((number, (place.left, y)))
            y -= high + PICTURE_GAP
        yield page

    def _sheet(self, page: list[tuple[int, Spot]], number: int, of: int) -> Sheet:
        drawing, say = self.plans.drawing, self.plans.tongue
        scene, style = drawing.scene, frame_of(drawing.scene)
        document = CONSTRUCTION if self.cut == STAGE else STRIP
        title = self.title.items(self.block, Page(document, self.paper, NO_SCALE, number, of))
        items = [*style.items(self.paper, self.frame, say), *title]
        items += [move_item(item, 0.0, 0.0, self.times) for place, corner in page for item in self._cell(place, corner)]
        description = said("Film strip of a graphical construction: {0} steps in {1} pictures.",
                           len(drawing.drawn) - drawing.drawn.givens, len(self.pictures))
        return Sheet(*self.paper_size, self.frame, {}, tuple(items), scene.title, say(description),
                     tuple(self.plans.sentences),
                     Scales(1.0, drawing.kappa, scene.units.length, {}), say.code, scene.text, drawing.drawn.givens)

    def _cell(self, number: int, corner: Spot) -> Iterator[Item]:
        """A picture with its heading above and its words below."""
        picture, (x, y) = self.pictures[number], corner
        rect = picture.excerpt.view.rect
        heads, words = self._rows(picture, number)
        y -= sum(row.height for row in heads)
        yield from _stack_rows(heads, x, corner[1])
        yield Outline(pens.BORDER, "paper", None, tuple((u + x, v + y - rect.height) for u, v in rect.corners),
                      picture.excerpt.panel)
        for item in picture.items:
            yield move_item(item, x, y - rect.height)
        below = (0.0, rect.height + WORDS_GAP) if self.cut != STAGE else (rect.width + GAP, 0.0)
        yield from _stack_rows(words, x + below[0], y - below[1])

    def _height(self, one: Picture) -> float:
        """Height of a picture with its words."""
        (heads, words_rows), high = self._rows(one), one.excerpt.view.rect.height
        words = sum(row.height + row.gap for row in words_rows)
        return sum(row.height for row in heads) + (max(high, words) if self.cut == STAGE else high + WORDS_GAP + words)

    def _rows(self, one: Picture, number: int = 99) -> tuple[list[TextRow], list[TextRow]]:
        """The rows above a picture and below it."""
        heading = self._title(arrange("{0}. {1}", number + 1, one.heading), self.columns[0].width)
        return [*heading], [row for part in one.parts for row in self._part_rows(part, len(one.parts) > 1)]

    def _part_rows(self, part: Part, titled: bool) -> Iterator[TextRow]:
        """The rows of a part; a compound that is spread over several pictures is written out by movements."""
        words, wide, stage, first = self.words, self.words_wide, part.passage.stage, part.steps[0].index
        if titled:
            yield from self._title(part.title, wide)
        if stage and self.cut == STAGE and part.begins and not part.passage.again:
            for equation in stage.equations:
                yield from words.equation(equation, wide - words.indent, first)
            yield from words.paragraph(arrange("{0:capital}.", stage.law), wide, first)
        for entry, movements in part.entries:
            if len(movements) == len(entry.movements) and self.cut != STEP:
                yield from words.entry(entry, wide)
                continue
            if words.unfolded:
                yield from words.paragraph(entry.text, wide, movements[0].index)
            for movement in movements:
                yield from words.paragraph(movement.sentence, wide, movement.index, str(movement.number))

    def _title(self, text: Said, wide: float) -> Iterator[TextRow]:
        """The title of a picture or a part, wrapped."""
        for runs in wrap(sentence_runs(self.plans.tongue(text), self.words.names), SIZE, wide, bold=True):
            yield TextRow((Cell(0.0, runs, bold=True),))

    @cached_property
    def words(self) -> SheetWords:
        return (_StageWords if self.cut == STAGE else _PictureWords)(self.plans)


class _PictureWords(SheetWords):
    """Words of a picture: entries indented behind the numbers of their first and last movement."""

    indent = 12.5


class _StageWords(SheetWords):
    """Words of a stage: entries with their movements, indented behind their numbers."""

    indent, unfolded = 8.5, True


def _stack_rows(rows: Sequence[TextRow], x: float, y: float) -> Iterator[Item]:
    """Stack rows below each other."""
    for row in rows:
        y -= row.height + row.gap
        yield from row_items([(row, x, y + row.size * (LEADING - 1))])
