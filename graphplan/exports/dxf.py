"""The sheet for CAD programs, as DXF R2010: the mechanism 1:1 in model space, and the sheet on a layout that prints it.

Model space is in the units of the scene. In it are the mechanism in its own size, where the scene has it, and beside it
the pages of the sheet, as large as they are on paper; each has a layout of its own, with a viewport that shows it 1:1.
So programs without layouts show the sheet too, and what is changed in the one is changed in the other: LibreCAD would
lay what is drawn on layouts over model space. The same sheets are the same bytes.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import accumulate

import ezdxf
from ezdxf import units

from graphplan.exports.cad.entities import FONTS, Ink
from graphplan.exports.cad.layers import NAME, VIEWPORTS, stage_layers, step_layers
from graphplan.exports.cad.mechanism import DIMENSIONED, POINTS, FullSize
from graphplan.mechanism.units import ISO_SIZES, METRES, SIZES
from graphplan.phrases import said
from graphplan.sheet.plates.display import Rect, Sheet, Spot
from graphplan.sheet.plates.pens import HATCH, LINK
from graphplan.sheet.plates.plate import Plates
from graphplan.words.tongue import tongue

UNITS = {"mm": units.MM, "cm": units.CM, "m": units.M, "in": units.IN, "ft": units.FT}
METRIC = {"mm", "cm", "m"}
END = "  0\nEOF\n"  # with the comments before it, so that a file begins as all do
GAP = 30.0  # mm between the mechanism and the sheet, and from page to page
LOCKED, SHEET = 0x4000, said("Sheet")  # a viewport of which the scale stays; what a layout is


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
        self.mm, self.told = float(METRES["mm"] / METRES[length]), tongue(sheets[0].language)(SHEET)
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
        """What a page takes up."""
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
        """What is seen at first: all of it; the limits of the drawing are those of the first page."""
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
    """What printers call a paper of this size, before its measures."""
    name = next((name for name, size_mm in SIZES.items() if sorted(size_mm) == sorted(size)), "")
    return f"ISO_full_bleed_{name}" if name in ISO_SIZES else f"ANSI_full_bleed_{name}" if name else "User"
