"""The pages of a report on a machine over its cycle, beside those of its construction.

A plate says problem and answer; diagrams over the drive's travel, the polar diagram of the most loaded bearing and a
table of positions follow the construction sheet. Quantities bear the letters that they have there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from graphplan.check.cycle import Cycle
from graphplan.cycle.swings import pivot_or_guide, swings, transmissions
from graphplan.kernel.passes import Drawing
from graphplan.kernel.program import Panel, Program
from graphplan.mechanism.model import FRAME, Scene
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import WORDS, kind_of
from graphplan.methods.panels import MECHANISM
from graphplan.methods.results import forces, pair_forces
from graphplan.output.tables import FULL_TURN, Largest, TableColumn, printed_travel, quantity_table
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.diagrams import CURVES, FOOT, LEFT, ON, Diagram, DrawnCurve, Frame, QuantityAxis, stroke_curve
from graphplan.sheet.layout.scales import ratio, scale_words
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import CAPS, sentence_runs
from graphplan.sheet.lettering.letters import mechanism_wishes
from graphplan.sheet.panels import COLUMN_MM, PanelFigure, PanelPage, PanelSheet, Words, column, fit_view
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.annotations import GivenArrows
from graphplan.sheet.plates.display import Circle, Item, Polyline, Rect, Sheet, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.traced_motion import TracedMotion
from graphplan.sheet.plates.view import View
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.sheet.words.facts import drawing_remarks, found_facts, given_facts, machine_facts, topic_texts
from graphplan.sheet.words.rows import Deviations, is_narrow

PAPER = "A3"
REPORT = said("Report")
DIAGRAMS = Panel("diagrams", *2 * [said("Diagrams over the travel of the drive")])
BEARING = Panel("bearing", *2 * [said("Polar diagram of the most loaded bearing")])
DASH = 3.0, 1.2  # mm
PENS = *CURVES, *(replace(pen, dash=DASH) for pen in CURVES)  # of the curves of a diagram
DIAGRAMS_A_PAGE, LEAST_ROWS = 4, 2  # at most, and as if there were so many at least
SAMPLE_MM, LINE_MM = 6.0, 5.0  # of a legend: a curve's sample, which entries are apart as well, and from line to line
MARGIN_MM, TABLE_GAP_MM = 12.0, 6.0  # about the mechanism and a polar diagram, and over a table of positions
DOT_MM, MIN_NUMBER_GAP_MM = 0.8, 5.0  # of marks on a curve: the radius, and between their numbers
ROOM_OVER, MAX_RATIO = 0.06, 10.0  # of a diagram's height: free over its curves; times most values: what is shown
EFFICIENCY_ENDS = -1.05, 1.05  # a machine near to locking itself has far lower ones
NO_STEPS = Drawing(Program((), ())).mark_values()


class CycleQuantity(NamedTuple):
    """A quantity over the poses of a cycle: its letter, what it is, its unit, and its values, of vectors their sizes.
    """

    symbol: Said | str
    words: Said | str
    unit: str
    values: Any


@dataclass(frozen=True)
class CycleReport:
    """A report: the cycle in the positions of its table and in `between` poses from each to the next, and the
    construction in the given pose."""

    cycle: Cycle
    drawing: Construction
    between: int

    def pages(self, construction: Callable[[int, int], Sequence[Sheet]], count: int) -> list[Sheet]:
        """All pages, among them so many of the construction, which are asked for with the numbers of pages before them
        and after."""
        sections = self._plate, self._diagrams, self._bearing, self._positions
        counts = [len(section(1, 0)) for section in sections]
        of, first = sum(counts) + count, counts[0] + count + 1
        pages = [*self._plate(1, of), *construction(counts[0], of - counts[0] - count)]
        for section in sections[1:]:
            pages += section(first, of)
            first = len(pages) + 1
        return pages

    # ---- quantities ------------------------------------------------------------------------------------------------

    @property
    def scene(self) -> Scene:
        return self.drawing.scene

    @cached_property
    def quantities(self) -> list[CycleQuantity]:
        """The quantities that the scene asks for, in the order of the sheet, without those that are zero to rounding in
        all poses; of a machine with friction the efficiency, too."""
        quantities, sizes = [*self._motion_and_forces()], dict[str, float]()
        for _, _, unit_text, values in quantities:
            sizes[unit_text] = max(sizes.get(unit_text, 0.0), float(np.nanmax(np.abs(values), initial=0.0)))
        rounded = (quantity._replace(values=np.where(np.abs(quantity.values) <= ZERO_TOL * sizes[quantity.unit], 0.0,
                                                     quantity.values)) for quantity in quantities)
        efficiency = [] if self.cycle.efficiency is None else [
            CycleQuantity(said("efficiency"), said("efficiency"), "", self.cycle.efficiency)]
        return [*(quantity for quantity in rounded if np.nanmax(np.abs(quantity.values), initial=0.0)), *efficiency]

    def _motion_and_forces(self) -> Iterator[CycleQuantity]:
        """The results that the sheet states, over the cycle."""
        for fact in found_facts(self.drawing, self.drawing.computed):
            values, kind = self.cycle.results.get(fact.kind, {}).get(fact.of), kind_of(fact.kind)
            if values is not None:
                sizes = np.abs(values) if np.iscomplexobj(values) else values
                yield CycleQuantity(fact.symbol, kind.words, kind.dimension.sheet_unit(self.scene.units), sizes)

    @cached_property
    def travel(self) -> tuple[str, Any]:
        """The unit of the drive's travel as sheets write it, and its travels."""
        measure, travel = printed_travel(self.cycle.scene, self.cycle.turn.travel)
        return "°" if measure == "deg" else measure, travel

    def _close_turn(self, values: Any, end: float | None = None) -> Any:
        """Values over a turn that closes with the first once more, or a given `end`; others as they are."""
        closes = self.cycle.turn.closed and not self.cycle.faults and self.travel[0] == "°"
        return np.append(values, values[0] if end is None else end) if closes else values

    # ---- pages -----------------------------------------------------------------------------------------------------

    def _sheet(self, panel: Panel, first: int, of: int, make: Callable[[PanelPage], PanelFigure],
               found: Sequence[Words] = (), scale: Said | None = None) -> PanelSheet:
        """A page with one panel, and what is found beside it."""
        page = PanelPage(PAPER, self.scene, column((1.0, panel)))
        return PanelSheet(page, REPORT, said("A report on a machine over its cycle."), NO_STEPS,
                          scale or said("as stated"), {panel: make(page)}, found=found, steps="", first=first, of=of)

    def _plate(self, first: int, of: int) -> list[Sheet]:
        """The plate: the mechanism in its positions, what is given, and what is found over the cycle."""
        machine = machine_facts(self.cycle.scene)
        topics = {fact.topic for fact in machine}
        dimensions = [fact for fact in given_facts(self.drawing.mechanism) if fact.topic not in topics]
        remarks = drawing_remarks(self.drawing, Deviations())
        window = self._window(PanelPage(PAPER, self.scene, column((1.0, MECHANISM))).room(MECHANISM))
        sheet = self._sheet(MECHANISM, first, of, partial(self._mechanism, window), [*self._cycle_words()],
                            ratio(1 / window.scale, self.scene.units.length))
        return replace(sheet, given=[*topic_texts((*dimensions, *machine)), *remarks],
                       tables=[self._extremes(self.quantities)]).pages() or []

    def _diagrams(self, first: int, of: int) -> list[Sheet]:
        """The diagrams over the travel, some on each page, with the extremes of what they show."""
        groups = [group for _, members in groupby(sorted(self.quantities, key=self._group), self._group)
                  for group in _chunks([*members], len(PENS))]
        sheets = list[Sheet]()
        for page_groups in _chunks(groups, DIAGRAMS_A_PAGE):
            table = self._extremes([quantity for group in page_groups for quantity in group])
            sheets += self._sheet(DIAGRAMS, first + len(sheets), of, partial(self._curves, page_groups),
                                  [table] if table[1:] else []).pages() or []
        return sheets

    def _group(self, quantity: CycleQuantity) -> int:
        """The place of a quantity's unit among all units."""
        return [*dict.fromkeys(each.unit for each in self.quantities)].index(quantity.unit)

    def _bearing(self, first: int, of: int) -> list[Sheet]:
        """The polar diagram of the bearing with the largest force; no page where there are no forces in bearings."""
        bearings = {pair.name for pair in pair_forces(self.scene) if pair.sort == "at"}
        symbols = {fact.of: fact.symbol for fact in found_facts(self.drawing, self.drawing.computed)
                   if fact.of in bearings}
        loads = {name: force for name, force in forces(self.scene, self.cycle.results).items()
                 if name in symbols and np.nanmax(np.abs(force), initial=0.0)}
        if not loads:
            return []
        name, force = max(loads.items(), key=lambda load: float(np.nanmax(np.abs(load[1]))))
        symbol = symbols[name]
        quantity = next(quantity for quantity in self.quantities if quantity.symbol == symbol)
        note = said("Directions are those in the plane of the frame; the numbers are those of the table of positions.")
        return self._sheet(BEARING, first, of, partial(self._polar, force, symbol),
                           [self._extremes([quantity]), note]).pages() or []

    def _positions(self, first: int, of: int) -> list[Sheet]:
        """The table of positions, as many columns beside each other as have room, on pages of words."""
        measure, travel = self.travel
        columns = [TableColumn("", quantity.symbol, quantity.unit, quantity.values[::self.between])
                   for quantity in self.quantities]
        head = TableColumn("", said("drive"), measure, travel[::self.between])
        sheet = self._sheet(DIAGRAMS, first, of, lambda page: PanelFigure(page.room(DIAGRAMS)))
        rows, abreast = [sheet.heading(said("Positions"))], list[TableColumn]()
        for value_column, following in zip(columns, [*columns[1:], None], strict=True):
            abreast.append(value_column)
            if following is None or not is_narrow(self._typeset([head, *abreast, following], sheet), COLUMN_MM):
                table = [*sheet.rows_of(quantity_table([head, *abreast]))]
                rows += [replace(table[0], gap=TABLE_GAP_MM, keep=len(table) - 1), *table[1:]]
                abreast = []
        return sheet.pages_of_words(rows)

    def _typeset(self, columns: Sequence[TableColumn], sheet: PanelSheet) -> Any:
        """A table as it is set, by which it is measured."""
        return [[sentence_runs(sheet.tongue(cell)) for cell in row] for row in quantity_table(columns)]

    # ---- figures ---------------------------------------------------------------------------------------------------

    def _window(self, room: Rect) -> View:
        """The mechanism at a round scale, with all that it reaches."""
        points = [z[np.isfinite(z)] for z in self.cycle.turn.points.values()]
        points.append(np.array([complex(*map(float, at)) for at in self.scene.points.values()]))
        corners = [(z.real, z.imag) for z in np.concatenate(points).tolist()]
        return fit_view(bounding_box(corners), room, MARGIN_MM)

    def _mechanism(self, window: View, page: PanelPage) -> PanelFigure:
        """The mechanism with its loads in the given pose, in its positions, and the paths of points that are asked
        for."""
        turn, mechanism = self.cycle.turn, DrawnMechanism(self.scene, window)
        reached = [k for k in range(0, len(turn.travel), self.between) if k not in turn.faults]
        positions = tuple({name: (z[k].real, z[k].imag) for name, z in turn.points.items()} for k in reached)
        paths = [item for z in self.cycle.requested_points.values() for item in stroke_curve(
            [window.spot(place) for place in self._close_turn(z)], window.rect, pens.PATH)]
        arrows, driven = [*GivenArrows(mechanism, page.tongue)], self.scene.drives[0].link
        pins = [name for name in self.scene.links[driven] if FRAME not in self.scene.links_of[name]]
        numbers = _numbers(map(window.spot, turn.points[pins[0]][:: self.between]), window.rect) if pins else []
        return PanelFigure(
            window.rect, strokes=[*TracedMotion((), positions).faint(self.scene, window), *paths, *mechanism.items(),
                                  *(item for items, _ in arrows for item in items)],
            wishes=[*mechanism_wishes(mechanism), *(value for _, value in arrows), *numbers])

    def _usual(self, values: Any) -> Any:
        """The values for which a diagram must have room: between limits, where rates and forces grow beyond all bounds,
        those that are not many times as large as most."""
        finite = values[np.isfinite(values)]
        bound = MAX_RATIO * np.median(np.abs(finite)) if finite.size and not self.cycle.turn.closed else 0.0
        return finite[np.abs(finite) <= bound] if bound else finite

    def _curves(self, groups: Sequence[Sequence[CycleQuantity]], page: PanelPage) -> PanelFigure:
        """Diagrams under each other, each with its legend."""
        room, (measure, travel) = page.room(DIAGRAMS).inset(LEFT, 0.0, 2 * ON, 0.0), self.travel
        xs, high = self._close_turn(travel, travel[0] + FULL_TURN), room.height / max(len(groups), LEAST_ROWS)
        diagrams, strokes = list[Diagram](), list[Item]()
        for k, group in enumerate(groups):
            top = room.top - k * high
            legend = [*_legend(group, page, room, top - LINE_MM)]
            lines = 1 + len({item.at[1] for item in legend if isinstance(item, Text)})
            rect = Rect(room.left, top - high + FOOT + LINE_MM, room.right, top - lines * LINE_MM)
            ordinates = _span([self._usual(quantity.values) for quantity in group], group[0].unit)
            frame = Frame.fit_rect(rect, (float(xs[0]), float(xs[-1])), ordinates)
            curves = [DrawnCurve(xs, self._close_turn(quantity.values), pen)
                      for quantity, pen in zip(group, PENS, strict=False)]
            words = [*dict.fromkeys(quantity.words for quantity in group)]
            label = join((*words, *([unit(group[0].unit)] if group[0].unit else [])))
            letter = "" if k < len(groups) - 1 else "φ" if measure == "°" else "s"
            diagrams.append(Diagram(
                frame, QuantityAxis(letter, measure, turns=measure == "°", scaled=False),
                QuantityAxis(str(words[0]), label=label, shift=(0.0, (lines - 1) * LINE_MM)), curves))
            strokes += [*legend, *self._largest_marks(frame, group)]
        return PanelFigure(page.room(DIAGRAMS), diagrams, strokes=strokes)

    def _largest_marks(self, frame: Frame, group: Sequence[CycleQuantity]) -> Iterator[Item]:
        """A dot at the largest value of each curve."""
        for quantity, pen in zip(group, PENS, strict=False):
            if quantity.unit and (largest := Largest.over(quantity.values, self.travel[1])):
                spot = frame.spot(largest.travel, largest.value)
                if frame.rect.holds(spot):
                    yield Circle(pen.with_fill(pen.colour), "links", None, spot, DOT_MM)

    def _polar(self, force: Any, symbol: Said | str, page: PanelPage) -> PanelFigure:
        """The ends of a force from one pole, with the numbers of the positions."""
        rect, force_unit = page.room(BEARING), self.scene.units.force
        ends = [(0.0, 0.0), *((z.real, z.imag) for z in self._usual(force).tolist())]
        window = fit_view(bounding_box(ends), rect, MARGIN_MM)
        spots = [window.spot(z) for z in self._close_turn(force)]
        curve = [*stroke_curve(spots, rect, CURVES[0])]
        marked = spots[: len(force) : self.between]
        curve += [Circle(CURVES[0].with_fill(CURVES[0].colour), "links", None, spot, DOT_MM) for spot in marked
                  if np.isfinite(spot).all()]
        return PanelFigure(rect, strokes=[*page.text.rings(window, force_unit), *curve], wishes=_numbers(marked, rect),
                           heading=arrange("{0}: {1}", BEARING.heading, symbol),
                           scales=scale_words("F", 1 / window.scale, force_unit, self.scene.sheet.convention))

    # ---- words -----------------------------------------------------------------------------------------------------

    def _cycle_words(self) -> Iterator[Words]:
        """Strokes with their time ratios, least transmission angles, the efficiency, and the check."""
        scene = self.cycle.scene
        for swing in swings(scene):
            measure = "°" if isinstance(pivot_or_guide(scene, swing.link), str) else f" {scene.units.length}"
            ratio_words = [] if swing.time_ratio is None else [arrange("K = {0}", digits(swing.time_ratio))]
            yield join((said("link {0}: stroke {1}{2}, between {3}° and {4}°", swing.link, digits(swing.stroke),
                             measure, digits(swing.inner), digits(swing.outer)), *ratio_words))
        for angle in transmissions(scene):
            yield said("least transmission angle of the links {0} and {1}: {2}° at {3}°", angle.coupler, angle.link,
                       digits(angle.least), digits(angle.travel))
        efficiency = self.cycle.efficiency
        if efficiency is not None and (efficiency < 0).any():
            yield said("The efficiency is negative where the loads drive, but do not overcome the friction.")
        if faults := self.cycle.faults:
            yield said("no results in {0} of {1} poses, first {2}", len(faults), len(self.travel[1]),
                       next(iter(faults.values())))
        yield said("Independent checks differ by: {0}",
                   join([join((WORDS[kind], digits(gap, 2)), " ") for kind, gap in self.cycle.check.items()]))

    def _extremes(self, quantities: Iterable[CycleQuantity]) -> Sequence[Sequence[Said | str]]:
        """The largest of each quantity but an efficiency, with its place, and the root mean square, as a table."""
        measure, travel = self.travel
        rows: list[list[Said | str]] = [["", said("largest"), join((said("drive"), unit(measure))), said("rms")]]
        for quantity in quantities:
            if quantity.unit and (largest := Largest.over(quantity.values, travel)):
                name = join((quantity.symbol, unit(quantity.unit)))
                rows.append([name, *map(digits, (largest.value, largest.travel, largest.rms))])
        return rows


def _chunks(items: Sequence[Any], size: int) -> list[Sequence[Any]]:
    """Items in parts of so many at most."""
    return [items[k : k + size] for k in range(0, len(items), size)]


def _numbers(spots: Iterable[Spot], rect: Rect) -> list[Wish]:
    """The numbers of positions at their spots in a rectangle; of such as lie close together the first alone."""
    wishes = list[Wish]()
    for number, spot in enumerate(spots):
        if rect.holds(spot) and all(math.dist(spot, wish.spots[0]) > MIN_NUMBER_GAP_MM for wish in wishes):
            wishes.append(Wish(sentence_runs(str(number)), (spot,), 0.8, True, pens.FAINT))
    return wishes


def _span(curves: Sequence[Any], measure: str) -> tuple[float, float]:
    """The ordinates of a diagram: zero and all values, and a little more; of efficiencies no more than is of use."""
    low, high = (float(end(np.concatenate([[0.0], *curves]))) for end in (np.min, np.max))
    if not measure:
        low, high = max(low, EFFICIENCY_ENDS[0]), min(max(high, 1.0), EFFICIENCY_ENDS[1])
    room = ROOM_OVER * (high - low)
    return (low - room * (low < 0), high + room) if high > low else (-1.0, 1.0)


def _legend(group: Sequence[CycleQuantity], page: PanelPage, room: Rect, y: float) -> Iterator[Polyline | Text]:
    """A sample of each curve with its letter, in lines from the left to the right of a room."""
    x = room.left
    for quantity, pen in zip(group, PENS, strict=False):
        text = page.text.text((x + SAMPLE_MM + 1.5, y), sentence_runs(page.tongue(quantity.symbol)))
        if text.box.right > room.right and x > room.left:
            x, y = room.left, y - LINE_MM
            text = replace(text, at=(x + SAMPLE_MM + 1.5, y))
        level = y + CAPS * text.size / 2
        yield Polyline(pen, "letters", None, ((x, level), (x + SAMPLE_MM, level)))
        yield text
        x = text.box.right + SAMPLE_MM
