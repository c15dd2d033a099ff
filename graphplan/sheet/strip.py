"""The film strip: picture by picture how the construction grows, each with the steps that were just drawn.

A picture shows one plan. What was drawn before is grey, what is new is in ink, and its steps stand below in words. A
picture takes the steps up to the next mark that gets a letter, a dozen at most, or one step alone. Every mark bears the
number of its step.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from graphplan.errors import Refused
from graphplan.kernel.program import Panel, Step
from graphplan.methods.construction import Construction
from graphplan.phrases import arranged, said
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.frames.title import STRIP, Page
from graphplan.sheet.layout.layout import stacked
from graphplan.sheet.layout.paper import COLUMN, inside, lower_right, sheet_size
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import SIZE, sentence_runs
from graphplan.sheet.lettering.letters import picture
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Polygon, Rect, Sheet, Spot, Text, moved
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.selection import inked
from graphplan.sheet.plates.view import View, least, plan_box, plan_scale, view
from graphplan.sheet.words.rows import LEADING, TextRow, lettered
from graphplan.sheet.words.texts import Words
from graphplan.words.tongue import Tongue
from graphplan.words.tongue import tongue as tongue_of

WIDTHS = 92.0, 125.0, 170.0  # mm: of a picture; the wider where the letters of a plan need more room
ASPECT, GAP, INDENT, CAPTION = 0.72, 4.0, 7.0, 5.0
MOST = 12  # steps in a picture
NO_SCALE = "—"  # of a sheet with pictures in scales of their own


def strip(drawing: Construction, paper: str | None = None, *, single: bool = False,
          tongue: Tongue | None = None) -> list[Sheet]:
    """The film strip of a construction, page by page; `single` has a picture for every step.

    Paper and tongue are those of the scene's sheet if none are named, and else A3 and English. Fails with `Refused`
    where a picture with its words is larger than the paper.
    """
    wished = drawing.scene.sheet
    say = tongue or tongue_of(wished.language or "en")
    return Strip(Plans(drawing, say, numbered=True), single).sheets(paper or wished.paper or "A3")


@dataclass(frozen=True)
class Strip:
    """The pictures of one construction."""

    plans: Plans
    single: bool

    @cached_property
    def groups(self) -> list[list[Step]]:
        """The steps of each picture: on one plan, up to the next lettered mark, if it is not too far."""
        drawn, groups = self.plans.drawing.drawn, list[list[Step]]()
        for step in drawn.steps[drawn.givens :]:
            last = groups[-1] if groups else []
            full = not last or last[-1].name or self.single or len(last) == MOST
            if full or self._home(step) != self._home(last[-1]):
                groups.append([])
            groups[-1].append(step)
        return groups

    def _home(self, step: Step) -> Panel:
        return self.plans.plan_of_step[step.index]

    @cached_property
    def pictured(self) -> tuple[Rect, dict[str, list[Item]]]:
        """The frame of all pictures, and each plan in it: the narrowest in which no letters stand on each other."""
        for wide in WIDTHS:
            frame = Rect(0.0, 0.0, wide, ASPECT * wide)
            plates = Plates(self.plans, {panel: self._window(panel, frame) for panel in self.plans.panels})
            found: dict[str, list[Item]] = {plate.panel: stacked(picture(plate)) for plate in plates}
            if not any(map(crowded, found.values())):
                break
        return frame, found

    def _window(self, panel: str, frame: Rect) -> View:
        extent, room = self.plans.extent(panel), inside(frame)
        box = plan_box(extent, room, plan_scale(extent, room))
        return view(box, frame, least(box, room) or 1.0)

    def sheets(self, paper: str) -> list[Sheet]:
        """The strip on sheets of this paper."""
        scene, say = self.plans.drawing.scene, self.plans.tongue
        style = frame_of(scene)
        paper = style.paper(paper)
        wide, high = sheet_size(paper)
        frame, title = style.space(wide, high), style.block(scene, say)
        block = lower_right(frame, COLUMN, title)
        pages = list(self._pages(frame, block))
        sheets = []
        for number, cells in enumerate(pages, 1):
            page = Page(STRIP, paper, NO_SCALE, number, len(pages))
            items = [*style.items(paper, frame, say), *title.items(block, page)]
            items += [item for place, spot in cells for item in self._cell(place, spot)]
            sheets.append(self._sheet(wide, high, frame, tuple(items)))
        return sheets

    def _sheet(self, wide: float, high: float, frame: Rect, items: tuple[Item, ...]) -> Sheet:
        drawing, say = self.plans.drawing, self.plans.tongue
        steps, scene = len(drawing.drawn) - drawing.drawn.givens, drawing.scene
        told = said("Film strip of a graphical construction: {0} steps in {1} pictures.", steps, len(self.groups))
        return Sheet(wide, high, frame, {}, items, scene.title, say(told), tuple(map(say, drawing.sentences())),
                     Scales(1.0, drawing.kappa, scene.units.length, {}), say.code, scene.text,
                     drawing.drawn.givens)  # fmt: skip

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of all pictures."""
        return self.pictured[0].width, self.pictured[0].height

    def _pages(self, frame: Rect, block: Rect) -> Iterator[list[tuple[int, Spot]]]:
        """For each page its pictures by number, and where each has its upper left corner; clear of the title block."""
        wide, _ = self.size
        lefts = [frame.left + GAP + i * (wide + GAP) for i in range(int((frame.width - GAP) // (wide + GAP)))]
        page, place, y = list[tuple[int, Spot]](), 0, frame.top - GAP
        while place < len(self.groups):
            row = list(zip(range(place, len(self.groups)), lefts, strict=False))
            low = y - max((self._depth(k) for k, _ in row), default=0.0)
            feet = [block.top if left + wide > block.left else frame.bottom for _, left in row]
            clear = [(k, (left, y)) for (k, left), foot in zip(row, feet, strict=True) if low >= foot]
            if not clear and not page:
                raise Refused("film strip", "a picture with its words is larger than the sheet", "a larger --paper")
            if not clear:
                yield page
            page, y = (page + clear, low - GAP) if clear else ([], frame.top - GAP)
            place += len(clear)
        yield page

    def _depth(self, place: int) -> float:
        """How far down a picture reaches with its words."""
        return self.size[1] + CAPTION + len(self._lines(self.groups[place])) * SIZE * LEADING + GAP

    def _cell(self, place: int, corner: Spot) -> Iterator[Item]:
        """One picture with its heading above and its steps below."""
        (wide, high), group = self.size, self.groups[place]
        first, last = group[0].index, group[-1].index
        x, y = corner[0], corner[1] - CAPTION
        head = arranged("{0}. {1:capital}", place + 1, self._home(group[-1]).words)
        yield Text(pens.LETTERS, "text", None, (x, y + 1.5), sentence_runs(self.plans.tongue(head)), SIZE, bold=True)
        yield Polygon(pens.BORDER, "paper", None, Rect(x, y - high, x + wide, y).corners)
        for item in self.pictured[1][self._home(group[-1])]:
            if item.step is None or item.step <= last:
                yield moved(inked(item, first), x, y - high)
        level = y - high - 1.2
        for row in self._lines(group):
            level -= row.height
            yield from lettered([(row, x, level + row.size * (LEADING - 1))])

    @cached_property
    def words(self) -> Words:
        return _StepWords(self.plans)

    def _lines(self, group: list[Step]) -> list[TextRow]:
        """The steps of a picture in words."""
        drawn, wide = self.plans.drawing.drawn, self.size[0]
        return [row for step in group for row in self.words.paragraph(
            drawn.sentence(step.index), wide, step.index, str(drawn.number(step.index)))]


class _StepWords(Words):
    """Paragraphs that hang nearer to their numbers."""

    indent = INDENT


def crowded(items: Iterable[Item]) -> bool:
    """Whether letters stand on each other."""
    boxes = [item.box for item in items if isinstance(item, Text)]
    return any(one.meets(other) for one, other in combinations(boxes, 2))
