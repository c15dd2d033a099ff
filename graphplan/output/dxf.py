"""The display list as a DXF drawing for CAD programs: R2010, in true millimetres of paper.

Layers are those of the sheet, its vectors by kind and its construction lines by purpose; each has the colour, weight
and line type of the pen that draws most of it, and what another pen draws says so itself. All that belongs to one
drawing step is one group, which bears the step's sentence. The same sheet is the same bytes.
"""

from __future__ import annotations

import io
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import ezdxf
from ezdxf.enums import TextEntityAlignment
from ezdxf.lldxf.const import VALID_DXF_LINEWEIGHTS
from ezdxf.units import MM

from graphplan.sheet.lettering.lettering import CAPS, DROP, lowered, width
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text
from graphplan.sheet.plates.pens import INK, LOCUS, NORMAL, PAPER, PRODUCED, Pen

NAME = "GRAPHPLAN"  # whose extended data these are
FOREGROUND = 7  # the colour that is black on white and white on black
PURPOSES = {LOCUS: "loci", PRODUCED: "produced", NORMAL: "brought"}
FONTS = {"book": "DejaVuSans.ttf", "bold": "DejaVuSans-Bold.ttf"}
ANCHORS = {"start": TextEntityAlignment.LEFT, "middle": TextEntityAlignment.CENTER, "end": TextEntityAlignment.RIGHT}
WIDEST = 1.0  # mm: what is wider than this is no line but a bar
APART = 10.0  # degrees between the corners of what covers a disc


def dxf(sheet: Sheet) -> bytes:
    """The sheet as a DXF document."""
    with _undated():
        text = io.StringIO()
        document = _Model(sheet).document
        for kind in sorted(document.entitydb.dxf_types_in_use()):  # else declared in the order of a set
            document.classes.add_class(kind)
        text.write("".join(f"999\nscene: {line}\n" for line in sheet.scene.splitlines()))  # `import` reads these
        document.write(text)
        return bytes(document.encode(text.getvalue()))


@contextmanager
def _undated() -> Iterator[None]:
    """Without the date and a chance identity; what others asked of ezdxf stays as it was."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


class _Model:
    """A sheet as the model space of a document; y runs up in both."""

    def __init__(self, sheet: Sheet):
        self.document = ezdxf.new("R2010", units=MM)
        self.space = self.document.modelspace()
        self.pens = _layers(sheet)
        self._settings(sheet)
        steps: dict[int, list[Any]] = defaultdict(list)
        for item in sheet.items:
            drawn = list(self._drawn(item))
            if item.step is not None:
                steps[item.step] += drawn
        for name, step in _numbered(sheet):
            self.document.groups.new(name, sheet.sentences[step]).extend(steps[step])

    def _settings(self, sheet: Sheet) -> None:
        """Paper, title, layers, line types and lettering."""
        document, size = self.document, (sheet.width, sheet.height)
        document.set_modelspace_vport(sheet.height, (sheet.width / 2, sheet.height / 2))
        self.space.reset_limits((0, 0), size)
        self.space.reset_extents((0, 0, 0), (*size, 0))  # written also below, as ezdxf takes the origin for none
        document.header["$EXTMIN"], document.header["$EXTMAX"] = (0, 0, 0), (*size, 0)
        document.header["$LWDISPLAY"] = 1
        document.header.custom_vars.append("Title", sheet.title)
        document.header.custom_vars.append("Description", sheet.description)
        document.appids.new(NAME)
        document.set_wipeout_variables(frame=0)
        for dash in sorted({item.pen.dash for item in sheet.items if item.pen.dash}):
            parts = [-part if i % 2 else part for i, part in enumerate(dash)]
            document.linetypes.add(_linetype(dash), [sum(dash), *parts], description=f"{dash} mm")
        for name, pen in self.pens.items():
            document.layers.add(name, **_colour(pen.colour), lineweight=_weight(pen), linetype=_linetype(pen.dash))
        for name, font in FONTS.items():
            document.styles.add(name, font=font)

    def _drawn(self, item: Item) -> Iterator[Any]:
        look = self._look(item)
        match item:
            case Polyline():
                yield self._line(item, look)
            case Polygon():
                yield from self._filled(item.spots, item.pen, look)
                if item.pen.width:
                    yield self.space.add_lwpolyline(item.spots, close=True, dxfattribs=look)
            case Circle():
                disc = Arc(item.pen, item.layer, item.step, item.centre, item.radius, 0.0, 360.0)
                yield from self._filled(disc.spots(APART)[:-1], item.pen, look)
                if item.pen.width:
                    yield self.space.add_circle(item.centre, item.radius, dxfattribs=look)
            case Arc():
                yield self.space.add_arc(item.centre, item.radius, item.start, item.end, dxfattribs=look)
            case Arrow():
                yield from self._arrow(item, look)
            case Text():
                yield from self._text(item, look)
            case _:
                raise TypeError(f"no DXF for {type(item).__name__}")

    def _line(self, line: Polyline, look: dict[str, Any]) -> Any:
        """A bar has its width in the drawing itself, as many programs show no line weights."""
        if line.pen.width > WIDEST:
            return self.space.add_lwpolyline(line.spots, dxfattribs=look | {"const_width": line.pen.width})
        if len(line.spots) == 2:
            return self.space.add_line(*line.spots, dxfattribs=look)
        return self.space.add_lwpolyline(line.spots, dxfattribs=look)

    def _filled(self, spots: tuple[Spot, ...], pen: Pen, look: dict[str, Any]) -> Iterator[Any]:
        """What fills a figure: a tint, or the paper itself, which covers what lies behind."""
        if pen.fill == PAPER:
            yield self.space.add_wipeout(spots, dxfattribs={"layer": look["layer"]})
        elif pen.fill != "none":
            hatch = self.space.add_hatch(dxfattribs={"layer": look["layer"], **_colour(pen.fill)})
            hatch.paths.add_polyline_path(spots, is_closed=True)
            yield hatch

    def _arrow(self, arrow: Arrow, look: dict[str, Any]) -> Iterator[Any]:
        """The shaft ends in the head, so that the tip is sharp; the extended data keep the true ends."""
        strokes: list[Any] = []
        for spots, fill in arrow.figures:
            corners = (*spots[:2], *reversed(spots[2:]))  # of a solid the last two come the other way round
            strokes += (self._filled(spots, arrow.pen.filled(fill), look) if fill == PAPER
                        else [self.space.add_solid(corners, dxfattribs=look)])
        strokes += [self.space.add_line(*shaft, dxfattribs=look) for shaft in arrow.shaft]
        for stroke in strokes:
            stroke.set_xdata(NAME, [(1000, arrow.label), (1011, (*arrow.start, 0.0)), (1011, (*arrow.end, 0.0))])
            yield stroke

    def _text(self, text: Text, look: dict[str, Any]) -> Iterator[Any]:
        """A single run is anchored by whoever letters it; several stand side by side, as they are measured."""
        style, anchor, (x, y) = "bold" if text.bold else "book", ANCHORS[text.anchor], text.at
        if len(text.runs) > 1:
            x, anchor = text.box.left, TextEntityAlignment.LEFT
        for run in text.runs:
            high = CAPS * (lowered(text.size) if run.level else text.size)
            letters = self.space.add_text(run.text, height=high, dxfattribs=look | {"style": style})
            yield letters.set_placement((x, y + run.level * DROP * text.size), align=anchor)
            x += width((run,), text.size, text.bold)

    def _look(self, item: Item) -> dict[str, Any]:
        """The layer of an item, and what its pen has other than the layer."""
        name = _layer(item)
        pen, usual = item.pen, self.pens[name]
        look: dict[str, Any] = {"layer": name}
        if pen.colour != usual.colour:
            look |= _colour(pen.colour)
        if pen.width != usual.width:
            look["lineweight"] = _weight(pen)
        if pen.dash != usual.dash:
            look["linetype"] = _linetype(pen.dash)
        return look


def _layer(item: Item) -> str:
    """The layer of an item: vectors by kind, lines of the construction by purpose."""
    if isinstance(item, Arrow) and item.label:
        return f"{item.layer}-{item.label.partition(' ')[0]}"
    purpose = PURPOSES.get(item.pen) if item.layer == "construction" else None
    return f"{item.layer}-{purpose}" if purpose else item.layer


def _layers(sheet: Sheet) -> dict[str, Pen]:
    """The layers, each with the pen that draws most of it."""
    counted: dict[str, Counter[Pen]] = defaultdict(Counter)
    for item in sheet.items:
        counted[_layer(item)][item.pen] += 1
    return {name: pens.most_common(1)[0][0] for name, pens in counted.items()}


def _numbered(sheet: Sheet) -> Iterator[tuple[str, int]]:
    """The names of the groups: what is given, and steps by their numbers; those without ink have none."""
    drawn = sorted({item.step for item in sheet.items if item.step is not None})
    given = [step for step in drawn if step < sheet.givens]
    yield from ((f"GIVEN_{number}", step) for number, step in enumerate(given, 1))
    yield from ((f"STEP_{step + 1 - sheet.givens}", step) for step in drawn[len(given) :])


def _colour(colour: str) -> dict[str, int]:
    """A colour as attributes; black ink is whatever stands out from the background."""
    return {"color": FOREGROUND} if colour == INK else {"color": FOREGROUND, "true_color": int(colour[1:], 16)}


def _weight(pen: Pen) -> int:
    """The line weight next to a pen's width, in hundredths of a mm."""
    return int(min(VALID_DXF_LINEWEIGHTS, key=lambda weight: abs(weight - 100 * pen.width)))


def _linetype(dash: tuple[float, ...]) -> str:
    """The name of the line type with these dashes, such as DASH-2.4-1."""
    return "-".join(["DASH", *(f"{part:g}" for part in dash)]) if dash else "Continuous"
