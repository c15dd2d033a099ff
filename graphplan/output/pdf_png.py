"""The display list in ink: PDF pages of true size, and PNG pictures.

matplotlib brings the renderers, and DejaVu Sans, the font by whose advances lettering is measured. Its renderers are
driven item by item, from back to front, so that what covers what is as on the sheet. Letters stay text, embedded with
what of the font they need. Nothing depends on time or memory: the same sheets are the same bytes.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path as File
from typing import Any, NamedTuple

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.backends.backend_pdf import Name, Op, PdfFile, RendererPdf
from matplotlib.colors import to_rgb
from matplotlib.font_manager import FontProperties
from matplotlib.ft2font import FT2Font
from matplotlib.image import imsave
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from graphplan.errors import Refused
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.lettering.lettering import ANCHORS, DROP, script_size
from graphplan.sheet.plates.display import (
    Arc,
    Arrow,
    Circle,
    Item,
    Photograph,
    Polygon,
    Polyline,
    Rect,
    Sheet,
    Spot,
    Text,
)
from graphplan.sheet.plates.pens import PAPER, Pen
from graphplan.sheet.words.texts import RESULTS
from graphplan.words.tongue import tongue

INCH = 25.4
POINTS = 72 / INCH  # typographic points in a mm
EM = 1000  # advances are read off at this size
WORD = re.compile(r" *[^ ]+ *|^ +$")  # with the spaces about it, so that words stay apart for those who search
PAPERS, ARTIFACT = "paper", "Artifact"
AROUND = {PAPERS, "border", "ruling", "corner marks"}  # layers that are no contents
WORDS = {"text", RESULTS, *FACTS, "blanks"}  # layers of words
SETTINGS: Any = {  # whatever the reader's own settings are
    "pdf.fonttype": 42, "pdf.compression": 6, "pdf.use14corefonts": False, "pdf.inheritcolor": False,
    "text.hinting": "no_hinting", "text.antialiased": True,
}  # fmt: skip


def pdf(sheets: Sequence[Sheet], *, title: str = "", language: str = "") -> bytes:
    """The sheets as one PDF document, a page each, in true size; title and language are the first sheet's unless told.

    It is tagged: words are paragraphs and heads, in the order in which they are drawn, each plan's ink a figure with
    the sheet's description. Fails with `Refused` where a sheet has letters that the font does not.
    """
    written, first = io.BytesIO(), sheets[0]
    heard = language or first.language
    panels = dict.fromkeys(getattr(panel, "words", panel) for sheet in sheets for panel in sheet.panels)
    about = {"Title": title or first.title, "Subject": first.description or None, "Creator": "graphplan",
             "Keywords": ", ".join(map(tongue(heard), panels)) or None, "Producer": "graphplan", "CreationDate": None}
    make: Any = _PdfFile
    with matplotlib.rc_context(SETTINGS):
        file = make(written, metadata={key: value for key, value in about.items() if value or key == "CreationDate"})
        for sheet in sheets:
            wide, high = sheet.width / INCH, sheet.height / INCH
            file.newPage(wide, high)
            renderer = RendererPdf(file, 72, high, wide)
            _Painter(renderer).sheet(sheet, file.tag)
            file.untag()
            renderer.finalize()
        file.catalogue({"Lang": heard, "ViewerPreferences": {"DisplayDocTitle": True}})
        file.finalize()
        file.close()
    return written.getvalue()


def png(sheet: Sheet, dpi: float = 150) -> bytes:
    """The sheet as a picture of so many dots per inch.

    Fails with `Refused` where the sheet has letters that the font does not.
    """
    written, about = io.BytesIO(), {"Title": sheet.title, "Software": "graphplan"}
    with matplotlib.rc_context(SETTINGS):
        renderer = RendererAgg(int(sheet.width / INCH * dpi), int(sheet.height / INCH * dpi), dpi)
        _Painter(renderer).sheet(sheet)
        imsave(written, np.asarray(renderer.buffer_rgba()), format="png", dpi=dpi, metadata=about)
    return written.getvalue()


class _PdfFile(PdfFile):
    """A tagged document; its pictures are photographs, each as the JPEG that it is."""

    def __init__(self, written: Any, metadata: Any):
        self.file: Any = self  # it has no types
        self.tags: list[tuple[Tag, Any, list[Any]]] = []  # what is tagged, where it is told of, and its parts by page
        self.owners: list[list[Any]] = []  # by page, what each of its parts is of
        self.open: Tag | None = None
        super().__init__(written, metadata=metadata)  # type: ignore[no-untyped-call]

    def writeObject(self, object: Any, contents: Any) -> None:
        """Write an object; a page says where its tags are told of."""
        if isinstance(contents, dict) and contents.get("Type") == Name("Page"):
            contents |= {"StructParents": len(self.owners), "Tabs": Name("S")}
            self.owners.append([])
            self.page = object
        super().writeObject(object, contents)  # type: ignore[no-untyped-call]

    def tag(self, item: Item, sheet: Sheet) -> None:
        """Say what the next item is a part of: what follows on the same goes on with it."""
        tag = _tag(item, sheet)
        if self.open == tag:
            return
        self.untag()
        if tag.kind == ARTIFACT:
            self.file.write(b"/Artifact BMC\n")
        else:
            if not (self.tags and self.tags[-1][0] == tag):
                self.tags.append((tag, self.file.reserveObject("tag"), []))
            _, children, page_parts = self.tags[-1]
            page_parts.append((self.page, len(self.owners[-1])))
            self.file.write(f"/{tag.kind} <</MCID {len(self.owners[-1])}>> BDC\n".encode())
            self.owners[-1].append(children)
        self.open = tag

    def untag(self) -> None:
        """End what is tagged."""
        if self.open:
            self.file.write(b"EMC\n")
        self.open = None

    def catalogue(self, more: Mapping[str, Any]) -> None:
        """End the pages and write the catalogue: what the document is, and the tree of its tags."""
        file = self.file
        file.endStream()
        root, whole, parents = (file.reserveObject(name) for name in ("tags", "document", "parents"))
        for tag, told, parts in self.tags:
            marked = [{"Type": Name("MCR"), "Pg": page, "MCID": number} for page, number in parts]
            alternative = {"Alt": tag.said} if tag.said else {}
            file.writeObject(told,
                             {"Type": Name("StructElem"), "S": Name(tag.kind), "P": whole, "K": marked, **alternative})
        file.writeObject(whole, {"Type": Name("StructElem"), "S": Name("Document"), "P": root,
                                 "K": [told for _, told, _ in self.tags]})
        file.writeObject(parents, {"Nums": [part for page in enumerate(self.owners) for part in page]})
        file.writeObject(root, {"Type": Name("StructTreeRoot"), "K": whole, "ParentTree": parents,
                                "ParentTreeNextKey": len(self.owners)})
        file.writeObject(file.rootObject, {
            "Type": Name("Catalog"), "Pages": file.pagesObject, "MarkInfo": {"Marked": True}, "StructTreeRoot": root,
            **more})

    def writeImages(self) -> None:
        """Write what stands behind the names of pictures."""
        file: Any = self
        for photograph, _, place in file._images.values():
            wide, high = photograph.pixels
            head = {"Type": Name("XObject"), "Subtype": Name("Image"), "Width": wide, "Height": high,
                    "ColorSpace": Name("DeviceGray"), "BitsPerComponent": 8, "Filter": Name("DCTDecode")}
            with matplotlib.rc_context({"pdf.compression": 0}):  # it is compressed already
                file.outputStream(place, photograph.jpeg, extra=head)


class Tag(NamedTuple):
    """What items are a part of: its kind, which of these it is, and what is said of it to who cannot see it."""

    kind: str
    which: Any
    said: str = ""


def _tag(item: Item, sheet: Sheet) -> Tag:
    """What an item is a part of: words of a step are one paragraph."""
    if item.layer in AROUND or (item.layer in WORDS and not isinstance(item, Text)):
        return Tag(ARTIFACT, sheet)
    if item.layer in WORDS:
        whole = isinstance(item, Text) and item.bold
        return Tag("H1" if whole else "P", item if whole or item.step is None else item.step)
    return Tag("Figure", sheet, sheet.description)


class _Painter:
    """Draws items with a renderer of matplotlib: `mm` of its units are a millimetre."""

    def __init__(self, renderer: Any):
        self.renderer, self.mm = renderer, renderer.points_to_pixels(POINTS)
        self.height = renderer.get_canvas_width_height()[1]
        self.pens: dict[Pen, Any] = {}

    def sheet(self, sheet: Sheet, told: Callable[[Item, Sheet], None] = lambda item, sheet: None) -> None:
        """Draw a sheet on its paper, from back to front; each item is told of before it is drawn."""
        letters = {char for item in sheet.items if isinstance(item, Text) for run in item.runs for char in run.text}
        if missing := lacking(letters):
            raise Refused(f"{sheet.title}: lettering", f"DejaVu Sans has no {' '.join(missing)}",
                          "draw it as SVG, whose viewer brings other fonts")
        paper = Rect(0.0, 0.0, sheet.width, sheet.height).corners
        told(Polygon(Pen(0.0), PAPERS, None, paper), sheet)
        self._stroke(Pen(0.0), Path([*paper, paper[0]], closed=True), PAPER)
        for item in sheet.items:
            told(item, sheet)
            self.draw(item)

    def draw(self, item: Item) -> None:
        match item:
            case Polyline():
                self._stroke(item.pen, Path(item.spots))
            case Polygon():
                self._stroke(item.pen, Path([*item.spots, item.spots[0]], closed=True), item.pen.fill)
            case Circle():
                self._stroke(item.pen, _round(Path.unit_circle(), item.centre, item.radius), item.pen.fill)
            case Arc():
                self._stroke(item.pen, _round(Path.arc(item.start, item.end), item.centre, item.radius))
            case Arrow():
                self._arrow(item)
            case Text():
                self._text(item)
            case Photograph() if isinstance(self.renderer, RendererPdf):
                self._photograph(item)
            case _:
                raise TypeError(f"no ink for {type(item).__name__}")

    def _arrow(self, arrow: Arrow) -> None:
        """The shaft ends in the head, so that the tip is sharp."""
        for shaft in arrow.shaft:
            self._stroke(arrow.pen, Path(shaft))
        for spots, fill in arrow.figures:
            self._stroke(Pen(0.0), Path([*spots, spots[0]], closed=True), fill)

    def _photograph(self, item: Photograph) -> None:
        """A picture by its name in the file, which has it once."""
        file, rect = self.renderer.file, item.rect
        place = (side * self.mm for side in (rect.width, 0, 0, rect.height, rect.left, rect.bottom))
        file.output(Op.gsave, *place, Op.concat_matrix, file.imageObject(item), Op.use_xobject, Op.grestore)

    def _stroke(self, pen: Pen, path: Path, fill: str = "none") -> None:
        """A path in mm, drawn with a pen and filled."""
        face = None if fill == "none" else to_rgb(fill)
        self.renderer.draw_path(self._pen(pen), path, Affine2D().scale(self.mm), face)

    def _text(self, text: Text) -> None:
        gc = self._pen(Pen(0.0, text.pen.colour))
        for words, (x, y), size in _pieces(text):
            level = self.height - y * self.mm if self.renderer.flipy() else y * self.mm
            self.renderer.draw_text(gc, x * self.mm, level, words, _font(text.bold, size), 0)

    def _pen(self, pen: Pen) -> Any:
        """The renderer's own record of a pen."""
        if pen not in self.pens:
            gc = self.renderer.new_gc()
            gc.set_foreground(pen.colour)
            gc.set_linewidth(pen.width * POINTS)
            gc.set_dashes(0, [stretch * POINTS for stretch in pen.dash] or None)
            gc.set_capstyle("round")
            gc.set_joinstyle("round")
            gc.set_snap(False)
            self.pens[pen] = gc
        return self.pens[pen]


def _round(path: Path, centre: Spot, radius: float) -> Path:
    """A path about the origin, of radius one, about this centre and with this radius."""
    return Path(np.asarray(path.vertices) * radius + centre, path.codes)


def _pieces(text: Text) -> Iterator[tuple[str, Spot, float]]:
    """What is lettered in one go, where, and in which size: single words, as renderers push letters together and the
    next level is to stand close by; the last run whole."""
    sizes = [script_size(text.size) if run.level else text.size for run in text.runs]
    long = sum(_width(run.text, text.bold) * size for run, size in zip(text.runs, sizes, strict=True))
    x = text.at[0] - ANCHORS[text.anchor] * long
    for k, (run, size) in enumerate(zip(text.runs, sizes, strict=True), 1):
        for words in WORD.findall(run.text) if k < len(text.runs) else [run.text]:
            yield words, (x, text.at[1] + run.level * DROP * text.size), size
            x += _width(words, text.bold) * size


@lru_cache(maxsize=64)
def _font(bold: bool, size: float) -> FontProperties:
    return FontProperties(fname=str(_file(bold)), size=size * POINTS)


def _file(bold: bool) -> File:
    """The font's file, which comes with matplotlib."""
    return File(matplotlib.get_data_path(), "fonts", "ttf", f"DejaVuSans{'-Bold' if bold else ''}.ttf")


@lru_cache(maxsize=2)
def _face(bold: bool) -> FT2Font:
    """The font at the size at which it is measured."""
    face = FT2Font(str(_file(bold)))
    face.set_size(EM, 72)
    return face


def lacking(letters: Iterable[str]) -> list[str]:
    """The letters that the font does not have."""
    return sorted({char for char in letters if not _has(char)})


@lru_cache(maxsize=1024)
def _has(char: str) -> bool:
    """Whether the font can letter this, in both weights."""
    return all(_face(bold).get_char_index(ord(char)) for bold in (False, True))


@lru_cache(maxsize=4096)
def _width(words: str, bold: bool) -> float:
    """How long words are, beside the size of their letters."""
    face = _face(bold)
    return sum(float(face.load_char(ord(char)).linearHoriAdvance / 65536 / EM) for char in words)
