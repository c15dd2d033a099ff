"""A sheet as PDF in true size: its file, and what is drawn on its pages.

It is written without a renderer, of which none tags what it draws. Letters stay text, and the document has what of
DejaVu Sans they need. It is tagged: words are paragraphs and heads, in the order in which they are drawn, each plan's
ink a figure with the sheet's description; layers and steps are marked, by which a drawing that is handed in is read.
Nothing depends on time or memory: the same sheets are the same bytes.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple
from zlib import compress, crc32

from graphplan.output.typeface import place_runs, refuse_lacking, typeface
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.plates.display import (
    ENLARGED,
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

HEAD = b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n"  # the second line says that there are bytes beyond ASCII
LEVEL = 6  # of compression
EM = 1000  # in which a PDF tells what it does of fonts
AT_ONCE = 100  # letters that may be told in one list
SYMBOLIC = 4  # the flag of a font that has letters beyond the standard ones of Latin
CAPITALS, STEM = 729, 80  # thousandths of an em: how high capitals are, and how wide upright strokes
TO_UNICODE = """/CIDInit /ProcSet findresource begin
12 dict begin
begincmap
/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def
/CMapName /Adobe-Identity-UCS def
/CMapType 2 def
1 begincodespacerange
<0000> <FFFF>
endcodespacerange
{}
endcmap
CMapName currentdict /CMap defineresource pop
end
end"""


class Name(NamedTuple):
    """A name of the format."""

    text: str


class Reference(NamedTuple):
    """An object by its number."""

    number: int


class PdfFile:
    """Objects as they are written, one after the other."""

    def __init__(self) -> None:
        self.written = bytearray(HEAD)
        self.places: list[int] = []  # where each object begins, by its number less one

    def reserve(self) -> Reference:
        """The number of an object that is written later."""
        self.places.append(0)
        return Reference(len(self.places))

    def write(self, value: object, reference: Reference | None = None) -> Reference:
        """Write an object, with the number that is reserved for it if one is."""
        return self._write(spell(value).encode("latin-1"), reference)

    def write_stream(self, contents: bytes, about: Mapping[str, object] | None = None,
                     reference: Reference | None = None) -> Reference:
        """Write bytes with what is said about them; they are compressed where that does not say how they are."""
        about = {**(about or {})}
        if "Filter" not in about:
            contents, about = compress(contents, LEVEL), about | {"Filter": Name("FlateDecode")}
        head = spell(about | {"Length": len(contents)}).encode("latin-1")
        return self._write(head + b"\nstream\n" + contents + b"\nendstream", reference)

    def _write(self, contents: bytes, reference: Reference | None) -> Reference:
        reference = reference or self.reserve()
        self.places[reference.number - 1] = len(self.written)
        self.written += f"{reference.number} 0 obj\n".encode() + contents + b"\nendobj\n"
        return reference

    def end(self, catalogue: Mapping[str, object], about: Mapping[str, str]) -> bytes:
        """The whole file, with its catalogue and what is said about it."""
        trailer = {"Root": self.write(catalogue), "Info": self.write(about), "Size": len(self.places) + 1}
        start = len(self.written)
        table = "".join(f"{place:010} 00000 n \n" for place in self.places)
        self.written += (f"xref\n0 {len(self.places) + 1}\n0000000000 65535 f \n{table}"
                         f"trailer\n{spell(trailer)}\nstartxref\n{start}\n%%EOF\n").encode()
        return bytes(self.written)


def spell(value: Any) -> str:
    """A value as the format spells it; text in ASCII as it is, else in UTF-16."""
    match value:
        case Name():
            return f"/{value.text}"
        case Reference():
            return f"{value.number} 0 R"
        case Mapping():
            return f"<< {' '.join(f'/{key} {spell(entry)}' for key, entry in value.items())} >>"
        case bool():
            return "true" if value else "false"
        case int():
            return str(value)
        case float():
            return number(value)
        case str() if value.isascii():
            return "(" + value.translate({40: "\\(", 41: "\\)", 92: "\\\\", 10: "\\n", 13: "\\r"}) + ")"
        case str():
            return f"<FEFF{value.encode('utf-16-be').hex().upper()}>"
        case Iterable():
            return f"[{' '.join(map(spell, value))}]"
    raise TypeError(f"no {type(value).__name__} in a PDF")


def number(value: float) -> str:
    """A number to the thousandth, as short as it can be."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


class EmbeddedFont:
    """What of a weight of the font a file has: the glyphs of the letters that it is asked for."""

    def __init__(self, file: PdfFile, bold: bool):
        self.face, self.reference = typeface(bold), file.reserve()
        self.number: dict[str, int] = {}

    def codes(self, text: str) -> str:
        """A text by the numbers of its glyphs."""
        return "".join([f"{self.number.setdefault(char, self.face.glyph(char)):04X}" for char in text])

    def write(self, file: PdfFile) -> None:
        """Write what was asked for: its outlines, its widths, and which letters they are."""
        head, lines = self.face.font["head"], self.face.font["hhea"]
        name, em = Name(f"{_mark(self.number)}+{self.face.file.stem}"), EM / self.face.em
        outlines = self.face.subset(self.number.values())
        embedded = file.write_stream(outlines, {"Length1": len(outlines)})
        descriptor = file.write({
            "Type": Name("FontDescriptor"), "FontName": name, "Flags": SYMBOLIC,
            "FontBBox": [round(em * length) for length in (head.xMin, head.yMin, head.xMax, head.yMax)],
            "ItalicAngle": 0, "Ascent": round(em * lines.ascent), "Descent": round(em * lines.descent),
            "CapHeight": CAPITALS, "StemV": STEM, "FontFile2": embedded})
        descendant = file.write({
            "Type": Name("Font"), "Subtype": Name("CIDFontType2"), "BaseFont": name,
            "CIDSystemInfo": {"Registry": "Adobe", "Ordering": "Identity", "Supplement": 0},
            "FontDescriptor": descriptor, "CIDToGIDMap": Name("Identity"),
            "W": [part for char, glyph in self.number.items() for part in (glyph, [EM * self.face.advance(char)])]})
        pairs = [f"<{code:04X}> <{char.encode('utf-16-be').hex().upper()}>" for char, code in self.number.items()]
        lists = [pairs[k:k + AT_ONCE] for k in range(0, len(pairs), AT_ONCE)]
        meanings = "\n".join("\n".join([f"{len(told)} beginbfchar", *told, "endbfchar"]) for told in lists)
        file.write({"Type": Name("Font"), "Subtype": Name("Type0"), "BaseFont": name, "Encoding": Name("Identity-H"),
                    "DescendantFonts": [descendant],
                    "ToUnicode": file.write_stream(TO_UNICODE.format(meanings).encode())}, self.reference)


def _mark(letters: Iterable[str]) -> str:
    """Six capitals by which a part of a font is told from other parts."""
    mark = crc32("".join(letters).encode())
    return "".join(chr(ord("A") + mark // 26**k % 26) for k in range(6))


POINTS = 72 / 25.4  # typographic points in a mm
SCENE = "scene.toml"  # what the attached scene is called
PIECE = math.radians(45)  # of an arc at the most that one curve is: a millionth of the radius from the circle
PAPERS, ARTIFACT, STEP = "paper", "Artifact", "step"
AROUND = {PAPERS, "border", "ruling", "corner marks"}  # layers that are no contents
WORDS = {"text", RESULTS, *FACTS, "blanks"}  # layers of words
WEIGHTS = {False: "F1", True: "F2"}  # what pages call the font's weights


def pdf(sheets: Sequence[Sheet], *, title: str = "", language: str = "") -> bytes:
    """The sheets as one PDF document, a page each, in true size; title and language are the first sheet's unless told.

    Fails with `Refused` where a sheet has letters that the font does not.
    """
    first, document = sheets[0], _TaggedPages()
    heard = language or first.language
    for sheet in sheets:
        document.add_page(sheet)
    panels = dict.fromkeys(getattr(panel, "words", panel) for sheet in sheets for panel in sheet.panels)
    about = {"Title": title or first.title, "Subject": first.description, "Creator": "graphplan",
             "Keywords": ", ".join(map(tongue(heard), panels)), "Producer": "graphplan"}
    document.attach_scene({sheet.scene for sheet in sheets} - {""})
    return document.end(heard, {key: value for key, value in about.items() if value})


class Tag(NamedTuple):
    """Structure element of items: its kind, its identity, and its alternative text."""

    kind: str
    which: Any
    said: str = ""


class _TaggedPages:
    """The pages of a tagged document; it has each photograph once, as the JPEG that it is."""

    def __init__(self) -> None:
        self.file = PdfFile()
        self.tree, self.fonts = self.file.reserve(), {bold: EmbeddedFont(self.file, bold) for bold in WEIGHTS}
        self.pages: list[Reference] = []
        self.tags: list[tuple[Tag, Reference, list[tuple[Reference, int]]]] = []  # with the parts that each has by page
        self.owners: list[list[Reference]] = []  # by page, what each of its parts is of
        self.photographs: dict[int, tuple[Photograph, Reference]] = {}
        self.attached: list[object] = []  # names of files with what holds them

    def add_page(self, sheet: Sheet) -> None:
        """Draw a sheet on its paper, from back to front, as the next page."""
        refuse_lacking(sheet)
        page, ink = self.file.reserve(), _Ink(self.fonts)
        self.owners.append([])
        paper = Polygon(Pen(0.0, fill=PAPER), PAPERS, None, Rect(0.0, 0.0, sheet.width, sheet.height).corners)
        opened: tuple[Tag, str] | None = None
        pictures: dict[str, Reference] = {}
        for item in (paper, *sheet.items):
            if (now := (_tag(item, sheet), _layer(item))) != opened:
                same_tag = opened is not None and opened[0] == now[0]
                ink.say("EMC" if opened else "", *(() if same_tag else ("EMC" if opened else "",
                                                                        self._begin(now[0], page))), f"/{now[1]} BMC")
                opened = now
            if isinstance(item, Photograph):
                _, reference = self.photographs.setdefault(id(item), (item, self.file.reserve()))
                pictures[f"P{reference.number}"] = reference
                ink.photograph(item, f"P{reference.number}")
            else:
                ink.draw(item)
        ink.say("EMC", "EMC")
        fonts = {WEIGHTS[bold]: font.reference for bold, font in self.fonts.items()}
        self.file.write({
            "Type": Name("Page"), "Parent": self.tree, "Contents": self.file.write_stream(ink.contents()),
            "MediaBox": [0, 0, sheet.width * POINTS, sheet.height * POINTS],
            "Resources": {"Font": fonts, "XObject": pictures}, "StructParents": len(self.pages), "Tabs": Name("S"),
        }, page)
        self.pages.append(page)

    def attach_scene(self, scenes: Collection[str]) -> None:
        """Attach the scene of the sheets as it is, if it is the same of all."""
        if len(scenes) == 1:
            text, = scenes
            stream = self.file.write_stream(text.encode(), {
                "Type": Name("EmbeddedFile"), "Subtype": Name("text#2Fplain"), "Filter": []})
            self.attached += SCENE, self.file.write({"Type": Name("Filespec"), "F": SCENE, "UF": SCENE,
                                                     "EF": {"F": stream}})

    def _begin(self, tag: Tag, page: Reference) -> str:
        """Say what follows is a part of; what follows on the same tag goes on with it."""
        if tag.kind == ARTIFACT:
            return "/Artifact BMC"
        if not (self.tags and self.tags[-1][0] == tag):
            self.tags.append((tag, self.file.reserve(), []))
        _, element, numbers = self.tags[-1]
        content = len(self.owners[-1])
        numbers.append((page, content))
        self.owners[-1].append(element)
        return f"/{tag.kind} <</MCID {content}>> BDC"

    def end(self, language: str, about: dict[str, str]) -> bytes:
        """The whole file: its fonts and pictures, what its tags are, and what is said about it."""
        file = self.file
        for font in self.fonts.values():
            font.write(file)
        for picture, reference in self.photographs.values():
            wide, high = picture.pixels
            file.write_stream(picture.jpeg, {
                "Type": Name("XObject"), "Subtype": Name("Image"), "Width": wide, "Height": high, "BitsPerComponent": 8,
                "ColorSpace": Name("DeviceGray"), "Filter": Name("DCTDecode")}, reference)
        file.write({"Type": Name("Pages"), "Kids": self.pages, "Count": len(self.pages)}, self.tree)
        root, whole = file.reserve(), file.reserve()
        for tag, element, numbers in self.tags:
            marked = [{"Type": Name("MCR"), "Pg": page, "MCID": content} for page, content in numbers]
            file.write({"Type": Name("StructElem"), "S": Name(tag.kind), "P": whole, "K": marked,
                        **({"Alt": tag.said} if tag.said else {})}, element)
        file.write({"Type": Name("StructElem"), "S": Name("Document"), "P": root,
                    "K": [element for _, element, _ in self.tags]}, whole)
        parents = file.write({"Nums": [part for page in enumerate(self.owners) for part in page]})
        file.write({"Type": Name("StructTreeRoot"), "K": whole, "ParentTree": parents,
                    "ParentTreeNextKey": len(self.owners)}, root)
        return file.end({"Type": Name("Catalog"), "Pages": self.tree, "MarkInfo": {"Marked": True},
                         "StructTreeRoot": root, "Lang": language, "ViewerPreferences": {"DisplayDocTitle": True},
                         **({"Names": {"EmbeddedFiles": {"Names": self.attached}}} if self.attached else {})},
                        about)


def _tag(item: Item, sheet: Sheet) -> Tag:
    """Structure element of an item: words of a step are one paragraph."""
    if item.layer in AROUND or (item.layer in WORDS and not isinstance(item, Text)):
        return Tag(ARTIFACT, sheet)
    if item.layer in WORDS:
        whole = isinstance(item, Text) and item.bold
        return Tag("H1" if whole else "P", item if whole or item.step is None else item.step)
    return Tag("Figure", sheet, sheet.description)


def _layer(item: Item) -> str:
    """Mark of an item within its structure element: its layer, as a name, or the step."""
    return STEP if item.step is not None and item.layer != ENLARGED else item.layer.replace(" ", "#20")


class _Ink:
    """Writer of a page's operators, in millimetres, with pens and fills where they change."""

    def __init__(self, fonts: dict[bool, EmbeddedFont]):
        self.fonts, self.operators = fonts, [f"{POINTS:.6f} 0 0 {POINTS:.6f} 0 0 cm 1 J 1 j"]
        self.pens: dict[str, str] = {}

    def contents(self) -> bytes:
        """All that was said, as a page has it."""
        return "\n".join(self.operators).encode()

    def say(self, *operators: str) -> None:
        """Say these, but for empty ones."""
        self.operators += filter(None, operators)

    def _set_colour(self, operator: str, values: str) -> None:
        """Tell a pen or a fill, where it is another one than before."""
        if self.pens.get(operator) != values:
            self.pens[operator] = values
            self.operators.append(f"{values} {operator}")

    def draw(self, item: Item) -> None:
        """Draw an item."""
        match item:
            case Polyline():
                self._stroke(item.pen, _chain(item.spots))
            case Polygon():
                self._stroke(item.pen, f"{_chain(item.spots)} h", item.pen.fill)
            case Circle():
                self._stroke(item.pen, f"{_curve(item.centre, item.radius, 0.0, 360.0)} h", item.pen.fill)
            case Arc():
                self._stroke(item.pen, _curve(item.centre, item.radius, item.start, item.end))
            case Arrow():  # the shaft ends in the head, so that the tip is sharp
                for shaft in item.shaft:
                    self._stroke(item.pen, _chain(shaft))
                for spots, fill in item.figures:
                    self._stroke(Pen(0.0), f"{_chain(spots)} h", fill)
            case Text():
                self._text(item)
            case _:
                raise TypeError(f"no ink for {type(item).__name__}")

    def photograph(self, item: Photograph, name: str) -> None:
        """Draw a picture by its name."""
        rect = item.rect
        self.say(f"q {_numbers(rect.width, 0, 0, rect.height, rect.left, rect.bottom)} cm /{name} Do Q")

    def _stroke(self, pen: Pen, path: str, fill: str = "none") -> None:
        """A path, drawn with a pen and filled."""
        if pen.width:
            self._set_colour("w", number(pen.width))
            self._set_colour("d", f"[{_numbers(*pen.dash)}] 0")
            self._set_colour("RG", _colour(pen.colour))
        if fill != "none":
            self._set_colour("rg", _colour(fill))
        if pen.width or fill != "none":
            self.operators.append(f"{path} {'S' if fill == 'none' else 'B' if pen.width else 'f'}")

    def _text(self, text: Text) -> None:
        """Lettering run by run."""
        font, name = self.fonts[text.bold], WEIGHTS[text.bold]
        self._set_colour("rg", _colour(text.pen.colour))
        for run, spot, size in place_runs(text):
            self.operators.append(f"BT /{name} {number(size)} Tf {_numbers(*spot)} Td <{font.codes(run.text)}> Tj ET")


def _numbers(*values: float) -> str:
    return " ".join(map(number, values))


def _chain(spots: Iterable[Spot]) -> str:
    """A path along some spots."""
    return f"{' l '.join(_numbers(*spot) for spot in spots)} l".replace(" l ", " m ", 1)


def _curve(centre: Spot, radius: float, start: float, end: float) -> str:
    """A path along a circle, counter-clockwise, by curves of the third degree."""
    first, turn = math.radians(start), math.radians(end - start)
    count = max(1, math.ceil(turn / PIECE))
    reach = 4 / 3 * math.tan(turn / count / 4)
    ends = [(math.cos(angle), math.sin(angle)) for angle in (first + turn * k / count for k in range(count + 1))]

    def spot(x: float, y: float) -> str:
        return _numbers(centre[0] + radius * x, centre[1] + radius * y)

    curves = (f"{spot(x - reach * y, y + reach * x)} {spot(u + reach * v, v - reach * u)} {spot(u, v)} c"
              for (x, y), (u, v) in pairwise(ends))
    return f"{spot(*ends[0])} m {' '.join(curves)}"


def _colour(colour: str) -> str:
    """A colour such as #4a2c0a by its parts of red, green and blue."""
    return _numbers(*(int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)))
