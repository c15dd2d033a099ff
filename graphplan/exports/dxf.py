"""The sheet as DXF: the mechanism 1:1 in model space, the sheet on layouts, and each step on a layer of its own.

A layer has the colour, weight and line type of the pen that draws most of it; what another pen draws says so itself.

Texts are whole: a line of letters is one entity, with subscripts and superscripts as stacked text.

Symbols, letters and the lines of dimensions are as large as on a print in the scale of the sheet.

Model space is in the units of the scene. In it are the mechanism in its own size, where the scene has it, and beside it
the pages of the sheet, as large as they are on paper; each has a layout of its own, with a viewport that shows it 1:1.
So programs without layouts show the sheet too, and what is changed in the one is changed in the other: LibreCAD would
lay what is drawn on layouts over model space. The same sheets are the same bytes.
"""

from __future__ import annotations

import cmath
import io
import math
import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any

import ezdxf
from ezdxf import units
from ezdxf.enums import MTextEntityAlignment, TextEntityAlignment
from ezdxf.layouts import Modelspace
from ezdxf.lldxf.const import VALID_DXF_LINEWEIGHTS

from graphplan.mechanism.model import FRAME
from graphplan.mechanism.units import ISO_SIZES, METRES, SIZES
from graphplan.phrases import said
from graphplan.sheet.lettering.lettering import CAPS, SMALL_SHEET, TextRun, plain, script_size, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.annotations import FIRST_LEVEL_MM, LinkDimension, dimensions
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Sheet, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import HATCH, INK, LINK, PAPER, Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.symbols import GUIDE, LONG, NEAR, offset
from graphplan.sheet.plates.traced_motion import outline
from graphplan.sheet.plates.view import View
from graphplan.sheet.words.protocol import Protocol
from graphplan.words.tongue import tongue

NAME = "GRAPHPLAN"  # whose extended data these are
SHEET, FULL_SIZE, GIVEN, VIEWPORTS = "SHEET", "MECHANISM 1-1", "STAGE 00", "VIEWPORTS"
MAX_TITLE_LETTERS = 120  # letters of a stage's title in the name of a layer
FORBIDDEN = str.maketrans(dict.fromkeys('<>/\\";?*|=`', "-") | {":": " -"})  # in names
FOREGROUND = 7  # the colour that is black on white and white on black
LINE_TYPES = {  # by how many dashes and gaps they have: names by which programs know their own
    2: ("DASHED", "DASHED2", "HIDDEN", "HIDDEN2"), 4: ("DASHDOT", "DASHDOT2"), 6: ("DIVIDE", "DIVIDE2"),
}  # fmt: skip


def stage_layers(plates: Plates) -> Layers:
    """The layers of a construction: one a step, by the stages."""
    program, tongue = plates.plans.drawing.drawn, plates.plans.tongue
    stages, of = Protocol(plates.plans).stages
    layers = []
    for index in range(len(program)):
        place = of.get(index)
        if index < program.givens:
            layers.append(f"{GIVEN} given")
        else:
            title = "" if place is None else f" {tongue(stages[place].title)[:MAX_TITLE_LETTERS].translate(FORBIDDEN)}"
            stage = len(stages) if place is None else place
            layers.append(f"STAGE {stage + 1:02}{title} - STEP {program.number(index):03}")
    sentences = plates.plans.sentences
    return Layers(layers, {layers[index]: sentences[index] for index in range(program.givens, len(program))})


def step_layers(sheet: Sheet) -> Layers:
    """The layers of a sheet of which no more is known: one a step."""
    names = [f"STEP {index + 1 - sheet.givens:03}" if index >= sheet.givens else f"{GIVEN} given"
             for index in range(len(sheet.sentences))]
    return Layers(names, dict(list(zip(names, sheet.sentences, strict=True))[sheet.givens :]))


@dataclass
class Layers:
    """Layer of each item, and its style there; drawn items are entered first.

    `steps` are the layers of drawing steps, `sentences` their descriptions, by layer.
    """

    steps: Sequence[str]
    sentences: Mapping[str, str]
    counted: dict[str, Counter[Pen]] = field(default_factory=lambda: defaultdict(Counter))

    def count(self, items: Iterable[Item]) -> None:
        """Tell what will be drawn."""
        for item in items:
            self.counted[self.layer_of(item)][item.pen] += 1

    def layer_of(self, item: Item) -> str:
        """The layer of an item."""
        if item.step is None:
            return item.layer if item.layer.startswith(FULL_SIZE) else f"{SHEET} {item.layer}"
        return self.steps[item.step]

    @cached_property
    def pens(self) -> dict[str, Pen]:
        """The layers in the order of their names, each with the pen that draws most of it."""
        return {name: self.counted[name].most_common(1)[0][0] for name in sorted(self.counted)}

    @property
    def line_types(self) -> dict[tuple[float, ...], str]:
        """The names of line types by their dashes, mm; the longest of each kind has the plain name."""
        line_types: dict[tuple[float, ...], str] = {(): "Continuous"}
        dashes = {pen.dash for pens in self.counted.values() for pen in pens if pen.dash}
        names = {count: iter(pattern) for count, pattern in LINE_TYPES.items()}
        for dash in sorted(dashes, key=lambda dash: (-sum(dash), dash)):
            line_types[dash] = next(names.get(len(dash), iter(())),
                                    "-".join(["DASH", *(f"{stretch:g}" for stretch in dash)]))
        return line_types

    def look(self, item: Item) -> dict[str, Any]:
        """The layer of an item, and what its pen has other than the layer."""
        name = self.layer_of(item)
        pen, usual = item.pen, self.pens[name]
        look: dict[str, Any] = {"layer": name}
        if pen.colour != usual.colour:
            look |= colour(pen.colour)
        if pen.width != usual.width:
            look["lineweight"] = weight(pen.width)
        if pen.dash != usual.dash:
            look["linetype"] = self.line_types[pen.dash]
        return look

    def enter(self, document: Any) -> None:
        """The layers and line types, entered into a document."""
        for dash, name in self.line_types.items():
            if dash:
                pattern = [-stretch if i % 2 else stretch for i, stretch in enumerate(dash)]
                document.linetypes.add(name, [sum(dash), *pattern], description=f"{dash} mm")
        for name, pen in self.pens.items():
            layer = document.layers.add(name, **colour(pen.colour), lineweight=weight(pen.width),
                                        linetype=self.line_types[pen.dash])
            if name in self.sentences:
                layer.description = self.sentences[name]
        document.layers.add(VIEWPORTS, plot=False)


def colour(colour: str) -> dict[str, int]:
    """A colour as attributes; black ink is whatever stands out from the background."""
    return {"color": FOREGROUND} if colour == INK else {"color": FOREGROUND, "true_color": int(colour[1:], 16)}


def weight(width: float) -> int:
    """The line weight next to a width in mm, in hundredths of a mm."""
    return int(min(VALID_DXF_LINEWEIGHTS, key=lambda weight: abs(weight - 100 * width)))


# LibreCAD letters in its own font of the style's name, other programs in the style's file; both have Greek, Cyrillic
# and true minus signs. The GOST letters of LibreCAD lack some of Latvian, which another of its fonts has.
STYLE, BOLD, LATVIAN = "lc_opengost-br", "lc_opengost-ar", "amiri-regular"
FONTS = {STYLE: "arial.ttf", BOLD: "arialbd.ttf", LATVIAN: "arial.ttf"}
LACKING = re.compile("[āēģīķļņūŗĀĒĢĪĶĻŅŪŖ]")
ANCHORS = {"start": TextEntityAlignment.LEFT, "middle": TextEntityAlignment.CENTER, "end": TextEntityAlignment.RIGHT}
HANGING = {"start": MTextEntityAlignment.TOP_LEFT, "middle": MTextEntityAlignment.TOP_CENTER,
           "end": MTextEntityAlignment.TOP_RIGHT}
MEANT = re.compile(r"[\\{}]")  # what means something else in texts of several levels
STACKED = re.compile(r"[\\{}^/#;]")  # and in what is stacked
STROKE = 10  # of the height of capitals: the pen of letters that are lines, as ISO 3098 has them
MAX_LINE_WIDTH_MM = 1.0  # mm: what is wider than this is no line but a bar
DISC_STEP_DEG = 10.0  # degrees between the corners of what covers a disc
DRAWING = "construction", "vectors"  # layers of the sheet with what steps draw


@dataclass(frozen=True)
class Ink:
    """Draws items in a space, a mm of which is so many of its units, from where the items' own origin is."""

    space: Any
    layers: Layers
    unit: float = 1.0
    origin: Spot = (0.0, 0.0)

    def item(self, item: Item) -> None:
        """Draw an item; what of a step is no drawing bears its layer of the sheet."""
        look = self.layers.look(item)
        if item.pen.dash and self.unit != 1.0:
            look["ltscale"] = self.unit
        entities = list(self._draw_item(item, look))
        if item.step is not None and item.layer not in DRAWING:
            for entity in entities:
                entity.set_xdata(NAME, [(1000, item.layer)])

    def _draw_item(self, item: Item, look: dict[str, Any]) -> Iterator[Any]:
        match item:
            case Polyline():
                yield self._line(item, look)
            case Polygon():
                yield from self._fill_figure(item.spots, item.pen, look)
                if item.pen.width:
                    yield self.space.add_lwpolyline(self._spots(item.spots), close=True, dxfattribs=look)
            case Circle():
                disc = Arc(item.pen, item.layer, item.step, item.centre, item.radius, 0.0, 360.0)
                yield from self._fill_figure(disc.spots(DISC_STEP_DEG)[:-1], item.pen, look)
                if item.pen.width:
                    yield self.space.add_circle(self.place_spot(item.centre), self.unit * item.radius, dxfattribs=look)
            case Arc():
                yield self.space.add_arc(self.place_spot(item.centre), self.unit * item.radius, item.start, item.end,
                                         dxfattribs=look)  # fmt: skip
            case Arrow():
                yield from self._arrow(item, look)
            case Text():
                yield self._text(item, look)
            case _:
                raise TypeError(f"no DXF for {type(item).__name__}")

    def _line(self, line: Polyline, look: dict[str, Any]) -> Any:
        """A bar has its width in the drawing itself, as many programs show no line weights."""
        spots = self._spots(line.spots)
        if line.pen.width > MAX_LINE_WIDTH_MM:
            return self.space.add_lwpolyline(spots, dxfattribs=look | {"const_width": self.unit * line.pen.width})
        if len(spots) == 2:
            return self.space.add_line(*spots, dxfattribs=look)
        return self.space.add_lwpolyline(spots, dxfattribs=look)

    def _fill_figure(self, spots: tuple[Spot, ...], pen: Pen, look: dict[str, Any]) -> Iterator[Any]:
        """Fill a figure: with a tint, or with the paper itself, which covers the items behind."""
        if pen.fill == PAPER:
            yield self.space.add_wipeout(self._spots(spots), dxfattribs={"layer": look["layer"]})
        elif pen.fill != "none":
            hatch = self.space.add_hatch(dxfattribs={"layer": look["layer"], **colour(pen.fill)})
            hatch.paths.add_polyline_path(self._spots(spots), is_closed=True)
            yield hatch

    def _arrow(self, arrow: Arrow, look: dict[str, Any]) -> Iterator[Any]:
        """The shaft ends in the head, so that the tip is sharp; the extended data keep the true ends."""
        strokes: list[Any] = []
        for spots, fill in arrow.figures:
            corners = self._spots((*spots[:2], *reversed(spots[2:])))  # the last two of a solid cross
            strokes += (self._fill_figure(spots, arrow.pen.with_fill(fill), look) if fill == PAPER
                        else [self.space.add_solid(corners, dxfattribs=look)])
        strokes += [self.space.add_line(*self._spots(shaft), dxfattribs=look) for shaft in arrow.shaft]
        start, end = self._spots((arrow.start, arrow.end))
        for stroke in strokes:
            stroke.set_xdata(NAME, [(1000, arrow.label), (1011, (*start, 0.0)), (1011, (*end, 0.0))])
            yield stroke

    def _text(self, text: Text, look: dict[str, Any]) -> Any:
        """A line of letters, anchored by whoever letters it."""
        high, (x, y) = CAPS * text.size, text.at
        lacking = LACKING.search(plain(text.runs))
        look |= {"style": LATVIAN if lacking else BOLD if text.bold else STYLE, "lineweight": weight(high / STROKE)}
        if len(text.runs) == 1 and text.runs[0].level == 0:
            written = text.runs[0].text.replace("^", "^ ")
            letters = self.space.add_text(written, height=self.unit * high, dxfattribs=look)
            if lacking:  # that font is wide
                ends = self._spots(((text.box.left, y), (text.box.right, y)))
                return letters.set_placement(*ends, align=TextEntityAlignment.FIT)
            return letters.set_placement(self.place_spot((x, y)), align=ANCHORS[text.anchor])
        small = script_size(text.size) / text.size
        written = "".join(_stacked_text(run, small) for run in text.runs)
        letters = self.space.add_mtext(written, dxfattribs=look | {"char_height": self.unit * high})
        return letters.set_location(self.place_spot((x, y + high)), attachment_point=HANGING[text.anchor])

    def place_spot(self, spot: Spot) -> Spot:
        """Place of a spot in mm in the space."""
        return self.origin[0] + self.unit * spot[0], self.origin[1] + self.unit * spot[1]

    def _spots(self, spots: tuple[Spot, ...]) -> list[Spot]:
        return [self.place_spot(spot) for spot in spots]


def _stacked_text(run: TextRun, small: float) -> str:
    """Letters in the language of stacked text: `small` is the size of those that hang or are raised."""
    if run.level == 0:
        return MEANT.sub(r"\\\g<0>", run.text)
    written = STACKED.sub(r"\\\g<0>", run.text)
    return rf"{{\H{small:.3g}x;\S{written}^ ;}}" if run.level > 0 else rf"{{\H{small:.3g}x;\S^ {written};}}"


SYMBOLS = {"ground", "wheels", "blocks", "drive", "pairs"}  # layers of the sheet that are drawn as they are there
DIMENSIONED, POINTS = f"{FULL_SIZE} dimensions", f"{FULL_SIZE} points"
CLEAR = 2.2  # mm from a point to its letters
DIGITS = 4  # of the longest dimension
ROOM = 3 * FIRST_LEVEL_MM  # mm about the points for symbols, letters and dimensions
DIMENSION_STYLE = {  # mm on paper, as ISO 129 has them
    "dimtxt": 2.5, "dimasz": 2.5, "dimexo": 1.0, "dimexe": 1.5, "dimgap": 0.8, "dimtad": 1, "dimtih": 0, "dimtoh": 0,
    "dimtix": 1, "dimtofl": 1, "dimzin": 8, "dimlwd": 18, "dimlwe": 18, "dimlfac": 1.0, "dimtxsty": STYLE,
}  # fmt: skip


@dataclass(frozen=True)
class FullSize:
    """A mechanism in its own units; `scale` of them are a mm of a print in the scale of the sheet."""

    plates: Plates
    scale: float

    @cached_property
    def drawn_mechanism(self) -> DrawnMechanism:
        """The mechanism on a print."""
        everywhere = Rect(-math.inf, -math.inf, math.inf, math.inf)
        return DrawnMechanism(self.plates.scene, View(everywhere, 1 / self.scale, (0.0, 0.0)))

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """All but points and dimensions, in mm of the print, each on its layer."""
        symbols = [replace(item, layer=f"{FULL_SIZE} {item.layer}") for item in self.drawn_mechanism.items()
                   if item.layer in SYMBOLS and item.pen != pens.PRODUCED]
        return (*self._guides(), *self._links(), *symbols, *self._letters())

    def _links(self) -> Iterator[Item]:
        """A line through the points of each link, or around them."""
        for link in self.plates.scene.moving:
            for chain in outline([self.drawn_mechanism.spots[name] for name in self.plates.scene.links[link]]):
                yield Polyline(pens.LINK, f"{FULL_SIZE} link {link}", None, chain)

    def _guides(self) -> Iterator[Item]:
        """The line along which each block slides."""
        for slide in self.plates.scene.slides:
            seat, along = self.drawn_mechanism.seat(slide), self.drawn_mechanism.direction(slide)
            ends = offset(seat, along, -GUIDE), offset(seat, along, GUIDE)
            yield Polyline(pens.PRODUCED, f"{FULL_SIZE} guides", None, ends)

    def _letters(self) -> Iterator[Text]:
        """The names of points, each where the links at it leave most room."""
        size, seats = SMALL_SHEET.mark, [self.drawn_mechanism.seat(slide) for slide in self.plates.scene.slides]
        for (x, y), (runs, _) in self.drawn_mechanism.letters().items():
            direction = self._free((x, y))
            half = width(runs, size) / 2, CAPS * size / 2
            clear = CLEAR + (LONG if any(math.dist(seat, (x, y)) < NEAR for seat in seats) else 0.0)
            far = min(clear + half_size / abs(side)
                      for half_size, side in zip(half, (direction.real, direction.imag), strict=True) if side)
            at = x + far * direction.real, y + far * direction.imag - half[1]
            yield Text(pens.LETTERS, f"{FULL_SIZE} names", None, at, runs, size, "middle")

    def _free(self, spot: Spot) -> complex:
        """The middle of the widest angle between what leaves a spot: links, and the ground below."""
        joints = [name for name, at in self.drawn_mechanism.spots.items() if math.dist(at, spot) < NEAR]
        directions = [complex(*neighbour) - complex(*spot) for name in joints
                      for neighbour in self.drawn_mechanism.neighbours(name)]
        directions += [-1j for name in joints if FRAME in self.plates.scene.links_of[name]]
        turns = sorted(cmath.phase(direction) for direction in directions) or [-math.pi / 2]
        gaps = [(end - start, start) for start, end in pairwise([*turns, turns[0] + math.tau])]
        gap, start = max(gaps, key=lambda one: (round(one[0], 6), one[1]))
        return cmath.rect(1.0, start + gap / 2)

    @cached_property
    def dimensions(self) -> list[LinkDimension]:
        """The dimensions of its links."""
        return dimensions(self.plates.scene, self.drawn_mechanism.spots, self.items)

    @property
    def box(self) -> Rect:
        """Box of the drawing, in units of the scene."""
        sides = [abs(dimension.aside) for dimension in self.dimensions]
        box, margin = bounding_box(list(self.drawn_mechanism.spots.values())), max([ROOM, *sides]) + FIRST_LEVEL_MM
        return box.inset(-margin, -margin, -margin, -margin).times(self.scale)

    def draw(self, space: Any, layers: Layers, decimal: str) -> None:
        """Draw it in a space; of numbers that are not whole the decimals follow this sign."""
        ink, scene = Ink(space, layers, self.scale), self.plates.scene
        for item in self.items:
            ink.item(item)
        places = {name: (float(x), float(y)) for name, (x, y) in scene.points.items()}
        for place in dict.fromkeys(places.values()):
            space.add_point(place, dxfattribs={"layer": POINTS})
        style = self._style(space.doc, places, decimal)
        for dimension in self.dimensions:
            space.add_aligned_dim(places[dimension.start], places[dimension.end], self.scale * dimension.aside,
                                  dimstyle=style,
                                  dxfattribs={"layer": DIMENSIONED}).render()  # fmt: skip

    def _style(self, document: Any, places: Mapping[str, Spot], decimal: str) -> str:
        """The style of dimensions, entered also as the document's own, by which some programs draw all of them."""
        longest = max((math.dist(places[dimension.start], places[dimension.end]) for dimension in self.dimensions),
                      default=1.0)
        places_after = max(0, DIGITS - 1 - math.floor(math.log10(longest)))
        settings = DIMENSION_STYLE | {"dimscale": self.scale, "dimdec": places_after, "dimdsep": ord(decimal)}
        style = document.dimstyles.add("GRAPHPLAN", dxfattribs=settings)
        style.copy_to_header(document)
        return "GRAPHPLAN"


UNITS = {"mm": units.MM, "cm": units.CM, "m": units.M, "in": units.IN, "ft": units.FT}
METRIC = {"mm", "cm", "m"}
END = "  0\nEOF\n"  # with the comments before it, so that a file begins as all do
GAP = 30.0  # mm between the mechanism and the sheet, and from page to page
LOCKED, SHEET_LAYER = 0x4000, said("Sheet")  # a viewport of which the scale stays; what a layout is


def dxf(sheets: Sequence[Sheet], plates: Plates | None = None) -> bytes:
    """The pages of a sheet, and the mechanism that is drawn on them if it is told, as a DXF document."""
    with without_date():
        text = io.StringIO()
        document = _Drawing(sheets, plates).document
        declare_classes(document)
        document.write(text)
        scene = "".join(f"999\nscene: {line}\n" for line in sheets[0].scene.splitlines())  # `import` reads these
        return bytes(document.encode(text.getvalue().removesuffix(END) + scene + END))


def declare_classes(document: ezdxf.document.Drawing) -> None:
    """Declare the classes of all entities by name: ezdxf does so in the order of a set."""
    for kind in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(kind)


@contextmanager
def without_date() -> Iterator[None]:
    """Without the date and a chance identity; what others asked of ezdxf stays as it was."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


class _Drawing:
    """The document while it is drawn; `mm` is a millimetre of paper in the units of the scene."""

    def __init__(self, sheets: Sequence[Sheet], plates: Plates | None):
        length = plates.scene.units.length if plates else "mm"
        self.mm, self.told = float(METRES["mm"] / METRES[length]), tongue(sheets[0].language)(SHEET_LAYER)
        self.document = ezdxf.new("R2010", units=UNITS[length])
        self.space = self.document.modelspace()
        self.layers = stage_layers(plates) if plates else step_layers(sheets[0])
        mechanism = FullSize(plates, sheets[0].scales.k_s) if plates else None
        for items in (mechanism.items if mechanism else (), *(sheet.items for sheet in sheets)):
            self.layers.count(items)
        if mechanism:
            self.layers.counted[POINTS][LINK] = self.layers.counted[DIMENSIONED][HATCH] = 1
        self._settings(sheets[0], length in METRIC)
        if mechanism and plates:
            mechanism.draw(self.space, self.layers, ".".translate(plates.plans.tongue.signs))
        box = mechanism.box if mechanism else Rect(0.0, 0.0, 0.0, 0.0)
        places = self._places(sheets, box)
        for place, sheet in zip(places, sheets, strict=True):
            ink = Ink(self.space, self.layers, self.mm, place)
            for item in sheet.items:
                ink.item(item)
        self._layouts(sheets, places)
        self._views([box, *(self._box(place, sheet) for place, sheet in zip(places, sheets, strict=True))])

    def _places(self, sheets: Sequence[Sheet], box: Rect) -> list[Spot]:
        """The lower left corners of the pages, side by side and beside the mechanism."""
        lefts = accumulate((self.mm * (sheet.width + GAP) for sheet in sheets), initial=box.right + self.mm * GAP)
        return [(left, box.bottom) for left, _ in zip(lefts, sheets, strict=False)]

    def _box(self, place: Spot, sheet: Sheet) -> Rect:
        """Box of a page."""
        return Rect(*place, place[0] + self.mm * sheet.width, place[1] + self.mm * sheet.height)

    def _settings(self, sheet: Sheet, metric: bool) -> None:
        """Title, layers, line types and lettering."""
        document, header = self.document, self.document.header
        header["$MEASUREMENT"], header["$LWDISPLAY"] = int(metric), 1
        header["$PSLTSCALE"] = 0  # dashes are as long on layouts as in model space
        header.custom_vars.append("Title", sheet.title)
        header.custom_vars.append("Description", sheet.description)
        document.appids.new(NAME)
        document.set_wipeout_variables(frame=0)
        for name, font in FONTS.items():
            document.styles.add(name, font=font)
        self.layers.enter(document)

    def _layouts(self, sheets: Sequence[Sheet], places: Sequence[Spot]) -> None:
        """A layout for each page, of the size of its paper, on which model space is seen 1:1 where the page is."""
        document, sheet_name = self.document, self.told
        document.layouts.rename("Layout1", f"{sheet_name} 1")
        for number, (sheet, place) in enumerate(zip(sheets, places, strict=True), 1):
            name, size = f"{sheet_name} {number}", (sheet.width, sheet.height)
            layout = document.layouts.get(name) if number == 1 else document.layouts.new(name)
            layout.page_setup(size, (0, 0, 0, 0), "mm", name=_paper(size))
            middle, box = (sheet.width / 2, sheet.height / 2), self._box(place, sheet)
            layout.add_viewport(middle, size, box.centre, box.height, dxfattribs={"layer": VIEWPORTS, "flags": LOCKED})

    def _views(self, boxes: Sequence[Rect]) -> None:
        """Set the first view: all of it; the limits of the drawing are those of the first page."""
        page = boxes[1]
        low = min(box.left for box in boxes), min(box.bottom for box in boxes)
        high = max(box.right for box in boxes), max(box.top for box in boxes)
        self.document.set_modelspace_vport(1.05 * (high[1] - low[1]), ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2))
        self.space.reset_limits((page.left, page.bottom), (page.right, page.top))
        self.space.reset_extents((*low, 0), (*high, 0))
        header = self.document.header
        header["$EXTMIN"], header["$EXTMAX"] = (*low, 0), (*high, 0)
        for layout in self.document.layouts:
            if layout.is_any_paperspace:  # LibreCAD takes them for the size of paper, in units of model space
                layout.reset_limits((0, 0), (page.width, page.height))


def _paper(size: tuple[float, float]) -> str:
    """Printers' name of a paper of this size, before its measures."""
    name = next((name for name, size_mm in SIZES.items() if sorted(size_mm) == sorted(size)), "")
    return f"ISO_full_bleed_{name}" if name in ISO_SIZES else f"ANSI_full_bleed_{name}" if name else "User"


LINES = {"outline": ("CONTINUOUS", 50), "pitch": ("DASHDOT", 18), "base": ("DASHED", 18), "points": ("CONTINUOUS", 35)}
DASHES = {"DASHED": (6.0, 5.0, -1.0), "DASHDOT": (6.0, 4.0, -0.9, 0.2, -0.9)}


def full_size(properties: dict[str, str], unit: str, names: tuple[str, str],
               draw: Callable[[Modelspace, dict[str, dict[str, str]]], None]) -> bytes:
    """A drawing true to size: `names` are what its outlines and pitch curves are called."""
    layers = dict(zip(LINES, (*names, "base circle", "points"), strict=True))
    with without_date():
        document, text = ezdxf.new("R2010", units=UNITS[unit]), io.StringIO()
        for name, (whole, *dashes) in DASHES.items():
            document.linetypes.add(name, [whole, *dashes])
        for name, (line, weight) in LINES.items():
            document.layers.add(f"{FULL_SIZE} {layers[name]}", linetype=line, lineweight=weight)
        draw(document.modelspace(), {name: {"layer": f"{FULL_SIZE} {layer}"} for name, layer in layers.items()})
        for name, value in properties.items():
            document.header.custom_vars.append(name, value)
        declare_classes(document)
        document.write(text)
        return bytes(document.encode(text.getvalue()))
