"""Paper: where the plans, the text columns and the title block lie on a sheet.

Words stand in columns beside or under the plans where plans keep most of the page, else on pages of their own. Plans
share their part of the page by cuts across it, so that every panel has the shape of its plan. The panels are the leaves
of a slicing tree, in drawing order from the left and from above; the title block may be the last. Of each run of
neighbours the shapes in which it just has room are kept that are smaller than others one way or the other
(L. Stockmeyer, Information and Control 57, 1983). Scales are round, so plans are drawn at the largest common size that
has room, and then one by one at the next round scale, the most crowded first.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from operator import itemgetter
from typing import NamedTuple, TypeVar

from graphplan.errors import Refused
from graphplan.mechanism.model import Number
from graphplan.mechanism.papers import SIZES
from graphplan.sheet.frames.frame import SheetFrame
from graphplan.sheet.frames.title import TitleBlock
from graphplan.sheet.layout.facts_block import Corner, FactPlace, FactRows, corners, divide_into_columns, facts_above
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.lettering.lettering import LetterSizes, letter_sizes
from graphplan.sheet.plates.display import Item, Rect
from graphplan.sheet.tolerances import EDGE_TOL
from graphplan.sheet.words.rows import Placed, TextRow, fill, row_items, tighten

CAPTION, MARGIN = 11.0, 9.0  # mm: a panel's caption strip, and what is kept free for letters around its figure
PANEL_EDGE, CAPTION_SIDE = 0.5, 2.5  # mm of a panel on each side of its room, and of its caption
MAX_SHAPES = 8  # shapes of a run that are kept
FINER_STEPS = 1.25, 1.6, 2.0, 2.5, 4.0, 5.0, 10.0  # how much finer a scale may be than the next coarser one
SIZE_STEP = 0.7  # by which the common size falls from try to try
MAX_TRIES = 24


@dataclass(frozen=True)
class Demand:
    """What a plan wants of its panel: room for a figure so wide and high, in lengths, with so many marks, at a scale
    that is round for quantities so many `lengths` long, if none is `given`; and in mm for its `caption`."""

    width: float
    height: float
    marks: int
    lengths: Sequence[Number]
    caption: float
    given: float | None = None

    @property
    def area(self) -> float:
        """The area of its figure; a slim figure counts as one half as wide as it is long."""
        return max(self.width * self.height, (self.width**2 + self.height**2) / 4)

    def scale(self, size: float) -> Fraction:
        """The scale, in lengths per mm, at which its figure has about so many mm^2 for a mark."""
        least = math.sqrt(self.area / (size * self.marks))
        return Fraction(self.given) if self.given else round_up(least, self.lengths)

    def crowding(self, scale: Fraction) -> float:
        """The mm^2 of its figure per mark; infinite for a figure without area."""
        return self.area / float(scale) ** 2 / self.marks or math.inf

    def finer(self, scale: Fraction) -> Fraction | None:
        """The next larger scale; none where it is given."""
        scales = (round_up(float(scale) / times, self.lengths) for times in FINER_STEPS)
        return None if self.given or not self.area else next((finer for finer in scales if finer < scale), None)

    def panel(self, scale: Fraction) -> tuple[float, float]:
        """How wide and high its panel is at least."""
        margins = 2 * (PANEL_EDGE + MARGIN)
        wide, high = self.width / float(scale) + margins, self.height / float(scale) + margins - PANEL_EDGE + CAPTION
        return max(wide, self.caption), high


class Shape(NamedTuple):
    """How wide and high a run of panels is at least, and its two parts, side by side or one under the other."""

    wide: float
    high: float
    parts: tuple[Shape, Shape] | None = None
    beside: bool = False
    name: str = ""


Joined = tuple[float, float, tuple[Shape, Shape], bool]  # a shape of two parts, before it is one


def divide_among_plans(region: Rect, block: Rect | None, demands: Mapping[str, Demand],
                       twins: Mapping[str, str]) -> dict[str, Rect] | None:
    """The panels of plans in a region, with the title block in its lower right corner where one is given; none where
    they have no room however small they are drawn. Twins have one scale."""
    corner = (Shape(min(block.width + EDGE_TOL, region.width), block.height + EDGE_TOL),) if block else ()
    groups: dict[str, list[str]] = {}
    for panel in demands:
        groups.setdefault(twins[panel], []).append(panel)
    size = region.area / sum(demand.marks for demand in demands.values())
    for _ in range(MAX_TRIES):
        scales = {group: max(demands[panel].scale(size) for panel in panels) for group, panels in groups.items()}
        if best := _best(region, demands, twins, scales, corner):
            break
        size *= SIZE_STEP
    else:
        return None
    waiting = set(groups)
    while waiting:
        group = min(sorted(waiting), key=lambda group: min(demands[panel].crowding(scales[group])
                                                           for panel in groups[group]))
        finer = max((finer for panel in groups[group] if (finer := demands[panel].finer(scales[group]))), default=None)
        larger = finer and _best(region, demands, twins, {**scales, group: finer}, corner)
        if finer and larger:
            best, scales = larger, {**scales, group: finer}
        else:
            waiting.discard(group)
    return _places(best, region)


def _best(region: Rect, demands: Mapping[str, Demand], twins: Mapping[str, str], scales: Mapping[str, Fraction],
          corner: tuple[Shape, ...]) -> Shape | None:
    """The shape of all panels at some scales that leaves most of the region over; none where they have no room."""
    leaves = [*(Shape(*demand.panel(scales[twins[panel]]), name=panel) for panel, demand in demands.items()), *corner]
    if sum(leaf.wide * leaf.high for leaf in leaves) > region.area:
        return None
    runs = {(i, i + 1): [leaf] for i, leaf in enumerate(leaves)}
    for count in range(2, len(leaves) + 1):
        for start in range(len(leaves) - count + 1):
            end = start + count
            runs[start, end] = _minimal_shapes([joined for middle in range(start + 1, end) for joined in _join_shapes(
                runs[start, middle], runs[middle, end], region.width, region.height)])
    whole = [shape for shape in runs[0, len(leaves)] if shape.wide <= region.width and shape.high <= region.height]
    return max(whole, key=lambda shape: min(region.width / shape.wide, region.height / shape.high), default=None)


def _join_shapes(ones: Iterable[Shape], twos: Iterable[Shape], widest: float, highest: float) -> Iterator[Joined]:
    """Pairs of runs side by side, and one under the other, if they are no larger than this."""
    for one, two in product(ones, twos):
        wide, high = one.wide + two.wide, max(one.high, two.high)
        if wide <= widest and high <= highest:
            yield wide, high, (one, two), True
        wide, high = max(one.wide, two.wide), one.high + two.high
        if wide <= widest and high <= highest:
            yield wide, high, (one, two), False


def _minimal_shapes(shapes: Sequence[Joined]) -> list[Shape]:
    """The shapes that no other shape undercuts in both width and height; at most `MAX_SHAPES` of them."""
    minimal: list[Joined] = []
    for shape in sorted(shapes, key=itemgetter(0, 1)):
        if not minimal or shape[1] < minimal[-1][1]:
            minimal.append(shape)
    last = len(minimal) - 1
    if last >= MAX_SHAPES:
        minimal = [minimal[round(i * last / (MAX_SHAPES - 1))] for i in range(MAX_SHAPES)]
    return [Shape(*shape) for shape in minimal]


def _places(shape: Shape, rect: Rect) -> dict[str, Rect]:
    """Place the panels of a run in a rectangle; they share spare room by their sizes, the title block takes none."""
    if shape.parts is None:
        return {shape.name: rect} if shape.name else {}
    first, two = shape.parts
    last = two.parts is None and not two.name
    if shape.beside:
        share = 1.0 if last else first.wide / (first.wide + two.wide)
        edge = rect.left + first.wide + share * (rect.width - first.wide - two.wide)
        return _places(first, Rect(rect.left, rect.bottom, edge, rect.top)) | _places(
            two, Rect(edge, rect.bottom, rect.right, rect.top))
    share = 1.0 if last else first.high / (first.high + two.high)
    edge = rect.top - first.high - share * (rect.height - first.high - two.high)
    return _places(first, Rect(rect.left, edge, rect.right, rect.top)) | _places(
        two, Rect(rect.left, rect.bottom, rect.right, edge))


GUTTER, COLUMN = 5.0, 96.0

T = TypeVar("T")
Measure = Callable[[float], T]  # what something becomes for a width


@dataclass(frozen=True)
class Arrangement:
    """A division of a sheet: its panels by name, its text columns with their rows, its title block, and what is given
    and found beside that.

    Where the words are on pages of their own it has no columns.
    """

    paper: str
    width: float
    height: float
    frame: Rect
    panels: dict[str, Rect]
    columns: tuple[Rect, ...]
    title: Rect
    rows: tuple[TextRow, ...] = ()
    facts: tuple[FactPlace, ...] = ()
    fact_items: tuple[Item, ...] = ()

    @property
    def further_columns(self) -> tuple[Rect, ...]:
        """The columns of a page of words, those over the title block ending above it: as wide as on the first page."""
        wide = self.columns[0].width if self.columns else self.letters.times * COLUMN
        count = max(1, int((self.frame.width + EDGE_TOL) // (wide + GUTTER)))
        return _columns(self.frame, count, self.title, wide if self.columns else None)

    @property
    def letters(self) -> LetterSizes:
        """How large its letters are."""
        return letter_sizes(self.paper)

    def set(self, words: Measure[Sequence[TextRow]]) -> tuple[TextRow, ...]:
        """Words set for its columns, in its letters."""
        return enlarge_words(words, self.letters.times)(self.further_columns[0].width)

    def with_facts(self, facts: FactRows) -> Arrangement:
        """The arrangement with these facts where they stand, in its letters."""
        items = (item for rows in self._fact_rows(facts) for item in row_items(rows or []))
        return replace(self, fact_items=tuple(items))

    def holds(self, facts: FactRows) -> bool:
        """Whether these facts have room where facts stand."""
        return None not in self._fact_rows(facts)

    def _fact_rows(self, facts: FactRows) -> list[list[Placed] | None]:
        """The rows of facts in each of their places; none where there is no room."""
        return [fill(place.rows(facts.enlarge(place.larger * self.letters.times)), place.columns)
                for place in self.facts]

    @property
    def share(self) -> float:
        """The part of the page that plans take."""
        return sum(panel.area for panel in self.panels.values()) / (self.width * self.height)


def enlarge_words(words: Measure[Sequence[TextRow]], times: float) -> Measure[tuple[TextRow, ...]]:
    """Words in letters so many times as large."""
    return lambda wide: tuple(row.enlarge(times) for row in words(wide / times))


def room(panel: Rect) -> Rect:
    """Where a panel's figure may lie: below the caption."""
    return panel.inset(PANEL_EDGE, PANEL_EDGE, PANEL_EDGE, CAPTION)


def room_for_marks(room: Rect) -> Rect:
    """Where the figure's own marks may lie: there is room for letters around them."""
    return room.inset(MARGIN, MARGIN, MARGIN, MARGIN)


def sheet_size(paper: str) -> tuple[float, float]:
    """Width and height of a sheet such as `A3` or `A4 portrait`."""
    name, _, orientation = paper.partition(" ")
    if name.capitalize() not in SIZES or orientation not in ("", "landscape", "portrait"):
        raise Refused(f"paper {paper!r}", "unknown sheet", f"choose one of {', '.join(SIZES)}, or 'A4 portrait'")
    wide, high = SIZES[name.capitalize()]
    return (high, wide) if orientation == "portrait" else (wide, high)


MIN_PLANS_SHARE = 0.6  # what plans take of a page on which words stand


def arrangements(paper: str, divide: Divide, rows: Measure[Sequence[TextRow]] | None, frame: SheetFrame,
                 title: TitleBlock, facts: FactRows | None) -> Iterator[Arrangement]:
    """The ways to divide one sheet: with columns that hold all the words, or without any where there are no `rows`.

    `divide` gives the panels in a region, of which the title block and the facts may take a corner; without `facts`
    the block alone does.
    """
    wide, high = sheet_size(paper)
    space, title, times = frame.space(wide, high), title.on_paper(paper), letter_sizes(paper).times
    words, facts = rows and enlarge_words(rows, times), facts and facts.enlarge(times)
    divisions = (*_words_beside(space, words, title, times * COLUMN, facts),
                 *_words_below(space, words, title, times * COLUMN, facts)) if words \
        else _plans_alone(space, title, times * COLUMN, facts)
    for plans, columns, corner in divisions:
        if panels := divide(plans, None if columns else corner.rect):
            yield Arrangement(paper, wide, high, space, panels, columns, corner.title,
                              words(columns[0].width) if words else (), corner.facts)


def words_page(paper: str, frame: SheetFrame, title: TitleBlock) -> Arrangement:
    """A page of words alone."""
    wide, high = sheet_size(paper)
    space, column = frame.space(wide, high), letter_sizes(paper).times * COLUMN
    page = Arrangement(paper, wide, high, space, {}, (), lower_right(space, column + GUTTER, title.on_paper(paper)))
    return replace(page, columns=page.further_columns)


Division = tuple[Rect, tuple[Rect, ...], Corner]
Divide = Callable[[Rect, Rect | None], dict[str, Rect] | None]


def _plans_alone(space: Rect, title: TitleBlock, column: float, facts: FactRows | None
                 ) -> Iterator[Division]:
    """Plans alone, with a title block as wide as a column, or as wide as it can be."""
    for block in dict.fromkeys(lower_right(space, pitch, title) for pitch in (column + GUTTER, space.width)):
        yield from ((space, (), corner) for corner in corners(space, block, facts))


def _words_beside(space: Rect, rows: Measure[tuple[TextRow, ...]], title: TitleBlock,
                  column: float, facts: FactRows | None) -> Iterator[Division]:
    """Text in as few columns as hold it, to the right of the plans, which end above a title block that is wider."""
    text = rows(column)
    pitch = column + GUTTER
    corner = facts_above(space, lower_right(space, pitch, title), facts)
    block = corner.rect
    for count in range(1, int(space.width // pitch) + 1):
        left = space.right - count * pitch
        columns = _columns(Rect(left, space.bottom, space.right, space.top), count, block)
        if fill(text, columns) is not None:
            foot = block.top if block.left < left else space.bottom
            yield Rect(space.left, foot, left, space.top), columns, corner
            return


def _words_below(space: Rect, rows: Measure[tuple[TextRow, ...]], title: TitleBlock,
                 column: float, facts: FactRows | None) -> Iterator[Division]:
    """Text in a strip under the plans, as low as it can be."""
    count = int((space.width + GUTTER) // (column + GUTTER))
    pitch = space.width / count
    text, corner = rows(pitch - GUTTER), facts_above(space, lower_right(space, pitch, title), facts)
    block = corner.rect
    strip, needed = max(block.height, 20.0), sum(row.height for row in text)
    covered = math.ceil(block.width / pitch - EDGE_TOL) * block.height
    while count * strip - covered < needed:  # whatever the columns, they cannot hold it
        strip += 4.0
    while strip < 0.75 * space.height:
        top = space.bottom + strip
        columns = _columns(Rect(space.left, space.bottom, space.right, top), count, block)
        if fill(text, columns) is not None:
            yield Rect(space.left, top, space.right, space.top), columns, corner
            return
        strip += 4.0


def lower_right(space: Rect, pitch: float, title: TitleBlock) -> Rect:
    """Where the title block lies: in the lower right corner."""
    wide = title.width(space, pitch)
    return Rect(space.right - wide, space.bottom, space.right, space.bottom + title.height(wide))


def _columns(region: Rect, count: int, block: Rect, wide: float | None = None) -> tuple[Rect, ...]:
    """Columns that share a region equally, `wide` where that is told; those over the title block end above it."""
    spare = region.width / count - GUTTER - wide if wide else 0.0
    return tuple(column.inset(0.0, 0.0, spare, 0.0)
                 for column in divide_into_columns(region, count, block, GUTTER / 2))


# ---- words that run from one page to the next -----------------------------------------------------------------------


def paginate(rows: Sequence[TextRow], arrangement: Arrangement) -> Iterator[list[Placed]]:
    """The rows page by page: the columns of the arrangement, if it has any, then as many pages of columns as it takes.

    Fails with `Refused` where what must stand together is higher than a page.
    """
    columns, further = arrangement.columns, arrangement.further_columns
    while rows:
        count = _fitting(rows, columns)
        if not count and columns is further:
            raise Refused(f"paper {arrangement.paper}", "a table does not fit on a page of it", "a larger sheet")
        yield fill(rows[:count], columns) or []
        rows, columns = rows[count:], further


def paginate_tightly(rows: Sequence[TextRow], arrangement: Arrangement) -> list[list[Placed]]:
    """The rows page by page, closer to each other where that saves a page; fails as :func:`paginate` does."""
    loose, tight = (list(paginate(kind, arrangement)) for kind in (rows, [tighten(row) for row in rows]))
    return tight if len(tight) < len(loose) else loose


def _fitting(rows: Sequence[TextRow], columns: Sequence[Rect]) -> int:
    """How many of the rows the columns hold, not parted where rows keep together."""
    breaks, last_kept = [0], 0
    for i, row in enumerate(rows):
        last_kept = min(max(last_kept, i + row.keep), len(rows) - 1)
        if last_kept == i:
            breaks.append(i + 1)
    full = bisect_right(breaks, False, key=lambda count: fill(rows[:count], columns) is None)
    return breaks[full - 1]


def protocol_pages(paper: str, rows: Measure[Sequence[TextRow]], frame: SheetFrame,
                   title: TitleBlock) -> tuple[tuple[Arrangement, list[Placed]], ...]:
    """The words on pages of their own: one of the smallest paper that holds them all, else several like the sheet's."""
    for name in frame.papers:
        page = words_page(name, frame, title)
        filled_pages = paginate_tightly(page.set(rows), page)
        if len(filled_pages) == 1 or math.prod(sheet_size(name)) >= math.prod(sheet_size(paper)):
            break
    return tuple((page, placed_rows) for placed_rows in filled_pages)
