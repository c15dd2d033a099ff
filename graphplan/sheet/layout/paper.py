"""The paper of a sheet: the smallest that has room for all plans in round scales.

Given scales hold whatever room there is, or are refused.

Words stand on pages of their own or, where that is asked for, in columns beside or under the plans. How plans share
their part of the page is division.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TypeVar

from graphplan.errors import Refused
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Number
from graphplan.mechanism.units import SIZES, millimetre
from graphplan.methods.construction import Construction
from graphplan.methods.panels import SHEET_EXTENTS, ForcePlan
from graphplan.sheet.frames.frame import SheetFrame
from graphplan.sheet.frames.title import TitleBlock
from graphplan.sheet.layout.division import FACTS, Demand, Packing, divide_among_plans
from graphplan.sheet.layout.facts_block import Corner, FactPlace, FactRows, corners, divide_into_columns, facts_above
from graphplan.sheet.layout.measures import (
    CAPTION_MM,
    CAPTION_SIDE_MM,
    COLUMN_MM,
    GUTTER_MM,
    MARGIN_MM,
    MIN_PLANS_SHARE,
    PANEL_EDGE_MM,
)
from graphplan.sheet.layout.scales import ACCELERATIONS, VELOCITIES, Scales, is_round, lengths_of, round_up
from graphplan.sheet.lettering.lettering import LetterSizes, letter_sizes, sentence_runs, two_line_width
from graphplan.sheet.plates.display import Item, Rect
from graphplan.sheet.plates.pens import FORCES
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.view import COARSER, MUCH_COARSER, View, plan_box, plan_scale, view, wanted_box
from graphplan.sheet.tolerances import EDGE_TOL, SCALE_TOL
from graphplan.sheet.words.lengths import MAX_ENLARGEMENT
from graphplan.sheet.words.rows import Placed, TextRow, fill, fill_up, row_items, tighten

GivenScales = tuple[float | None, dict[str, Fraction]]
NO_GIVEN_SCALES: GivenScales = (None, {})


def given_scales(plans: Plans) -> GivenScales:
    """The mechanism plan's scale in lengths per mm, where it is given, and the multiples of the plans that have one.

    All plans are constructed in lengths of the mechanism plan, so one scale of any kind fixes that of the mechanism
    plan, and its kind of plan has no multiple but a given one. Fails with `Refused` where scales do not go together.
    """
    k_s = _mechanism_scale(plans.drawing)
    multiples = {panel: _multiple(plans, panel) for panel in plans.panels[1:]}
    _check_force_plans(plans)
    return k_s, {panel: multiple for panel, multiple in multiples.items() if multiple is not None}


def _mechanism_scale(drawing: Construction) -> float | None:
    """The scale of the mechanism plan that follows from the given scales; None if no scale is given."""
    first: float | None = None
    for name, scale, lengths in _scales_of_scene(drawing):
        if first is not None and not math.isclose(scale * lengths, first, rel_tol=SCALE_TOL):
            raise Refused(f"sheet.{name} = {scale:g}", "the other scales of the scene's sheet do not go with it",
                          f"{name} = {first / lengths:.6g}, or leave one of them out")  # fmt: skip
        first = first or scale * lengths
    return first


def _scales_of_scene(drawing: Construction) -> Iterator[tuple[str, float, float]]:
    """The given scales: name, value, and how many lengths long a unit of the quantity is drawn."""
    sheet = drawing.scene.sheet
    if sheet.k_F and drawing.scene.loads is None:
        raise Refused("sheet.k_F", "the scene has no forces to draw", "leave it out")
    kinds = (("k_s", sheet.k_s, 1.0), ("k_v", sheet.k_v, drawing.kappa), ("k_a", sheet.k_a, drawing.kappa**2),
             ("k_F", sheet.k_F, float(drawing.phi)))  # fmt: skip
    yield from ((name, float(scale), lengths) for name, scale, lengths in kinds if scale is not None)


def _multiple(plans: Plans, panel: Panel) -> Fraction | None:
    """The multiple given for a plan, or 1 where a scale of its vectors is given."""
    sheet, kinds = plans.drawing.scene.sheet, plans.kinds(panel)
    plan = panel.whole
    multiple = sheet.multiples.get(plan, sheet.multiples.get(plan.twin))
    scaled = ((sheet.k_v, VELOCITIES), (sheet.k_a, ACCELERATIONS), (sheet.k_F, FORCES))
    return multiple or (Fraction(1) if any(scale and kinds & of for scale, of in scaled) else None)


def _check_force_plans(plans: Plans) -> None:
    """Refuse a multiple for a force plan that is not drawn, unless no force plan is drawn."""
    force_plans = [panel for panel in plans.panels if isinstance(panel, ForcePlan)]
    for plan in plans.drawing.scene.sheet.multiples:
        if force_plans and ForcePlan.names(plan) and plan not in force_plans:
            raise Refused(f"sheet.multiples.{plan}", "unknown plan", f"choose one of {', '.join(force_plans)}")


def windows(rooms: Mapping[str, Rect], plans: Plans,
            given: GivenScales = NO_GIVEN_SCALES) -> tuple[Scales, dict[str, View]]:
    """The scales, round if they are not given, and the windows of plans in their rooms."""
    scales = choose_scales({panel: room_for_marks(rect) for panel, rect in rooms.items()}, plans, given)
    boxes = {panel: plan_box(extent, room_for_marks(rooms[panel]), scales.lengths_per_mm(panel))
             for panel, extent in plans.extents.items()}
    return scales, {panel: view(box, rooms[panel], scales.lengths_per_mm(panel)) for panel, box in boxes.items()}


def choose_scales(rooms: Mapping[str, Rect], plans: Plans, given: GivenScales) -> Scales:
    """The scales, round if they are not given, for so much room for the marks of each plan; twins have one."""
    drawing, names, (k_s, given_multiples) = plans.drawing, plans.drawing.scene.units, given
    box = bounding_box([corner for rect in rooms.values() for corner in rect.corners])
    side, first = max(box.width, box.height), plans.panels[0]
    lengths = unit_lengths(plans, first)
    mechanism_scale = Fraction(k_s or plan_scale(plans.extents[first], rooms[first], COARSER, lengths))
    times = plans.extents[first].longest / side / float(mechanism_scale)
    if not k_s and 1 < times <= SHEET_EXTENTS:
        mechanism_scale = max(mechanism_scale, round_up(times * float(mechanism_scale), lengths))
    most: dict[str, Fraction] = {}
    for panel in plans.panels[1:]:
        twin, lengths = plans.twins[panel], unit_lengths(plans, panel)
        scale = plan_scale(plans.extents[panel], rooms[panel], MUCH_COARSER, lengths)
        if (least := plans.extents[panel].longest / side) > scale:
            scale = round_up(least, lengths)
        most[twin] = max(scale, most.get(twin, scale))
    for source, panel in plans.carry_overs:
        if panel != first:
            twin, taken = plans.twins[panel], most.get(plans.twins[source], mechanism_scale)
            most[twin] = max(most[twin], round_up(float(taken) / MAX_ENLARGEMENT, unit_lengths(plans, panel)))
    multiples: dict[str, Fraction] = {panel: mechanism_scale / most[plans.twins[panel]] for panel in plans.panels[1:]}
    return Scales(float(mechanism_scale), drawing.kappa, names.length, multiples | given_multiples, float(drawing.phi),
                  names.force, drawing.scene.sheet.convention)


def unit_lengths(plans: Plans, panel: Panel) -> Sequence[Number]:
    """Lengths per unit of each quantity that has a scale on a plan or on its twin; empty if no scale is printed. Those
    of motion are in mm if the scene gives a scale that is not round in its own unit, such as 1 : 10 in inches: then the
    others are a simple multiple."""
    if not plans.scales_told:
        return ()
    drawing, kinds = plans.drawing, plans.kinds(panel) | plans.kinds(plans.twins[panel])
    moving, forces = (lengths_of(of, drawing.tempo.kappa, drawing.phi) for of in (kinds - FORCES, kinds & FORCES))
    sheet = drawing.scene.sheet
    if panel == plans.panels[0] or sheet.by_crank or not (moving or forces):
        moving = [1, *moving]  # of a crank's own scale the others are a simple number of times as large
    unit = millimetre(drawing.scene.units) if sheet.k_s and not is_round(sheet.k_s) else Fraction(1)
    return [*(unit * Fraction(length) for length in moving), *forces]


def panel_demands(plans: Plans, given: GivenScales, paper: str) -> dict[str, Demand]:
    """Room that each plan needs on a paper."""
    demands, (k_s, multiples), size = dict[str, Demand](), given, letter_sizes(paper).text
    first = plans.panels[0]
    for panel in plans.panels:
        head = sentence_runs(plans.tongue(panel.caption(plans.kinds(panel))))
        box = wanted_box(plans.extents[panel], COARSER if panel == first else MUCH_COARSER)
        scale = k_s if panel == first else k_s / float(multiples[panel]) if k_s and panel in multiples else None
        demands[panel] = Demand(box.width, box.height, max(1, plans.point_counts[panel]), unit_lengths(plans, panel),
                                two_line_width(head, size) + 2 * CAPTION_SIDE_MM, scale)
    return demands


def divide_region(packings: dict[tuple[str, Rect], Packing], paper: str, wants: Sequence[Mapping[str, Demand]],
                  plans: Plans, region: Rect, block: Rect | None,
                  facts: Sequence[tuple[float, float]] = ()) -> dict[str, Rect] | None:
    """Divide a region of a paper by the first demands for which there is room; `packings` are those of all regions."""
    packing = packings.setdefault((paper, region), Packing(region))
    divisions = (divide_among_plans(packing, block, demands, plans.twins, facts) for demands in wants)
    return next(filter(None, divisions), None)


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
        wide = self.columns[0].width if self.columns else self.letters.times * COLUMN_MM
        count = max(1, int((self.frame.width + EDGE_TOL) // (wide + GUTTER_MM)))
        return _columns(self.frame, count, self.title, wide if self.columns else None)

    @property
    def letters(self) -> LetterSizes:
        """Sizes of its letters."""
        return letter_sizes(self.paper)

    def set(self, words: Measure[Sequence[TextRow]]) -> tuple[TextRow, ...]:
        """Words set for its columns, in its letters."""
        return enlarge_words(words, self.letters.times)(self.further_columns[0].width)

    def set_facts(self, facts: FactRows) -> tuple[Item, ...] | None:
        """Set facts in the blocks that are reserved for them; None if they do not fit."""
        placed_rows = [fill(rows, place.columns)
                       for rows, place in zip(self._fact_rows(facts), self.facts, strict=True)]
        if any(placed is None for placed in placed_rows):
            return None
        return tuple([item for placed in placed_rows for item in row_items(placed or [])])

    def _fact_rows(self, facts: FactRows) -> list[list[TextRow]]:
        """The rows of facts in each of their places."""
        return [place.rows(facts.enlarge(place.larger * self.letters.times)) for place in self.facts]

    @property
    def share(self) -> float:
        """The part of the page that plans take."""
        return sum(panel.area for panel in self.panels.values()) / (self.width * self.height)


def enlarge_words(words: Measure[Sequence[TextRow]], times: float) -> Measure[tuple[TextRow, ...]]:
    """Words in letters so many times as large."""
    return lambda wide: tuple([row.enlarge(times) for row in words(wide / times)])


def room(panel: Rect) -> Rect:
    """Room for a panel's figure: below the caption."""
    return panel.inset(PANEL_EDGE_MM, PANEL_EDGE_MM, PANEL_EDGE_MM, CAPTION_MM)


def room_for_marks(room: Rect) -> Rect:
    """Room for the figure's own marks, which leaves room for letters around them."""
    return room.inset(MARGIN_MM, MARGIN_MM, MARGIN_MM, MARGIN_MM)


def sheet_size(paper: str) -> tuple[float, float]:
    """Width and height of a sheet such as `A3` or `A4 portrait`."""
    name, _, orientation = paper.partition(" ")
    if name.capitalize() not in SIZES or orientation not in ("", "landscape", "portrait"):
        raise Refused(f"paper {paper!r}", "unknown sheet", f"choose one of {', '.join(SIZES)}, or 'A4 portrait'")
    wide, high = SIZES[name.capitalize()]
    return (high, wide) if orientation == "portrait" else (wide, high)


def arrangements(paper: str, divide: Divide, rows: Measure[Sequence[TextRow]] | None, frame: SheetFrame,
                 title: TitleBlock, facts: FactRows | None) -> Iterator[Arrangement]:
    """The ways to divide one sheet: with columns that hold all the words, or without any where there are no `rows`.

    `divide` gives the panels in a region, of which the title block and the facts may take a corner; without `facts`
    the block alone does.
    """
    wide, high = sheet_size(paper)
    space, title, times = frame.space(wide, high), title.on_paper(paper), letter_sizes(paper).times
    words, facts = rows and enlarge_words(rows, times), facts and facts.enlarge(times)
    divisions = (*_words_beside(space, words, title, times * COLUMN_MM, facts),
                 *_words_below(space, words, title, times * COLUMN_MM, facts)) if words \
        else _plans_alone(space, title, times * COLUMN_MM, facts)
    for plans, columns, corner in divisions:
        if panels := divide(plans, None if columns else corner.rect):
            yield Arrangement(paper, wide, high, space, panels, columns, corner.title,
                              words(columns[0].width) if words else (), corner.facts)
    if facts and not words:
        block = lower_right(space, times * COLUMN_MM + GUTTER_MM, title)
        yield from _with_facts_apart(paper, divide, space, block, facts)


def _with_facts_apart(paper: str, divide: Divide, space: Rect, title: Rect, facts: FactRows) -> Iterator[Arrangement]:
    """Yield the division with a part of the sheet for facts alone, at its best place among the plans; empty if the
    plans have too little of the page then."""
    panels = divide(space, title, facts.block_sizes) or {}
    block = panels.pop(FACTS, None)
    if block and (place := facts.place(block)):
        apart = Arrangement(paper, *sheet_size(paper), space, panels, (), title, facts=(place,))
        yield from [apart] if apart.share >= MIN_PLANS_SHARE else ()


def words_page(paper: str, frame: SheetFrame, title: TitleBlock, *, in_columns: bool = True) -> Arrangement:
    """A page of words alone, in columns or across the page."""
    wide, high = sheet_size(paper)
    space, column = frame.space(wide, high), letter_sizes(paper).times * COLUMN_MM
    page = Arrangement(paper, wide, high, space, {}, (), lower_right(space, column + GUTTER_MM, title.on_paper(paper)))
    return replace(page, columns=page.further_columns if in_columns else _columns(space, 1, page.title))


Division = tuple[Rect, tuple[Rect, ...], Corner]
Divide = Callable[..., dict[str, Rect] | None]


def _plans_alone(space: Rect, title: TitleBlock, column: float, facts: FactRows | None
                 ) -> Iterator[Division]:
    """Plans alone, with a title block as wide as a column, or as wide as it can be."""
    for block in dict.fromkeys(lower_right(space, pitch, title) for pitch in (column + GUTTER_MM, space.width)):
        yield from ((space, (), corner) for corner in corners(space, block, facts))


def _words_beside(space: Rect, rows: Measure[tuple[TextRow, ...]], title: TitleBlock,
                  column: float, facts: FactRows | None) -> Iterator[Division]:
    """Text in as few columns as hold it, to the right of the plans, which end above a title block that is wider."""
    text = rows(column)
    pitch = column + GUTTER_MM
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
    count = int((space.width + GUTTER_MM) // (column + GUTTER_MM))
    pitch = space.width / count
    text, corner = rows(pitch - GUTTER_MM), facts_above(space, lower_right(space, pitch, title), facts)
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
    """Place of the title block in the lower right corner."""
    wide = title.width(space, pitch)
    return Rect(space.right - wide, space.bottom, space.right, space.bottom + title.height(wide))


def _columns(region: Rect, count: int, block: Rect, wide: float | None = None) -> tuple[Rect, ...]:
    """Columns that share a region equally, `wide` where that is told; those over the title block end above it."""
    spare = region.width / count - GUTTER_MM - wide if wide else 0.0
    return tuple(column.inset(0.0, 0.0, spare, 0.0)
                 for column in divide_into_columns(region, count, block, GUTTER_MM / 2))


def paginate(rows: Sequence[TextRow], arrangement: Arrangement) -> Iterator[list[Placed]]:
    """The rows page by page: the columns of the arrangement, if it has any, then as many pages of columns as it takes.

    Fails with `Refused` where what must stand together is higher than a page.
    """
    columns, further = arrangement.columns, arrangement.further_columns
    while rows:
        placed_rows = fill_up(rows, columns)
        count = _unparted_rows(rows, len(placed_rows))
        if not count and columns is further:
            raise Refused(f"paper {arrangement.paper}", "a table does not fit on a page of it", "a larger sheet")
        yield placed_rows[:count]
        rows, columns = rows[count:], further


def paginate_tightly(rows: Sequence[TextRow], arrangement: Arrangement) -> list[list[Placed]]:
    """The rows page by page, closer to each other where that saves a page; fails as :func:`paginate` does."""
    loose = list(paginate(rows, arrangement))
    if len(loose) <= 1:
        return loose
    tight = list(paginate([tighten(row) for row in rows], arrangement))
    return tight if len(tight) < len(loose) else loose


def _unparted_rows(rows: Sequence[TextRow], count: int) -> int:
    """Number of the first rows, at most `count`, that do not separate rows that keep together."""
    whole, last_kept = 0, 0
    for i, row in enumerate(rows[:count]):
        last_kept = min(max(last_kept, i + row.keep), len(rows) - 1)
        whole = i + 1 if last_kept == i else whole
    return whole


def protocol_pages(paper: str, rows: Measure[Sequence[TextRow]], frame: SheetFrame,
                   title: TitleBlock) -> tuple[tuple[Arrangement, list[Placed]], ...]:
    """The words, on pages of their own: one of the smallest paper that holds them all, else several like the sheet's.
    """
    for name in frame.papers:
        page, is_last = words_page(name, frame, title), math.prod(sheet_size(name)) >= math.prod(sheet_size(paper))
        set_rows = page.set(rows)
        if is_last or _fit_on_page(set_rows, page.columns):
            break
    return tuple((page, placed_rows) for placed_rows in paginate_tightly(set_rows, page))


def _fit_on_page(rows: Sequence[TextRow], columns: Sequence[Rect]) -> bool:
    """Whether columns hold all the rows, if need be closer to each other."""
    return fill(rows, columns) is not None or fill([tighten(row) for row in rows], columns) is not None
