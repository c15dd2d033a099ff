"""A PDF file as ISO 32000-1 has it: objects by their numbers, streams, the fonts that its words are set in, and the
table at the end that tells where each object is.

Nothing in it depends on time or memory: the same objects are the same bytes.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple
from zlib import compress, crc32

from graphplan.output.typeface import Typeface, typeface

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
    """What of a weight of the font a file has: the glyphs of the letters that it is asked for, as they come."""

    def __init__(self, file: PdfFile, bold: bool):
        self.face, self.reference = typeface(bold), file.reserve()
        self.number: dict[str, int] = {}

    def codes(self, text: str) -> str:
        """A text by the numbers of its glyphs."""
        return "".join([f"{self.number.setdefault(char, len(self.number) + 1):04X}" for char in text])

    def write(self, file: PdfFile) -> None:
        """Write what was asked for: its outlines, its widths, and which letters they are."""
        glyphs = [0, *map(self.face.glyph, self.number)]
        name, face = Name(f"{_mark(self.number)}+{self.face.name}"), self.face
        outlines = face.subset(glyphs)
        embedded = file.write_stream(outlines, {"Length1": len(outlines)})
        ascent, descent = _in_ems(face, (face.ascent, face.descent))
        descriptor = file.write({
            "Type": Name("FontDescriptor"), "FontName": name, "Flags": SYMBOLIC, "FontBBox": _in_ems(face, face.box),
            "ItalicAngle": 0, "Ascent": ascent, "Descent": descent, "CapHeight": CAPITALS, "StemV": STEM,
            "FontFile2": embedded})
        descendant = file.write({
            "Type": Name("Font"), "Subtype": Name("CIDFontType2"), "BaseFont": name,
            "CIDSystemInfo": {"Registry": "Adobe", "Ordering": "Identity", "Supplement": 0},
            "FontDescriptor": descriptor, "CIDToGIDMap": Name("Identity"),
            "W": [0, [EM * face.advance(glyph) for glyph in glyphs]]})
        pairs = [f"<{code:04X}> <{char.encode('utf-16-be').hex().upper()}>" for char, code in self.number.items()]
        lists = [pairs[k:k + AT_ONCE] for k in range(0, len(pairs), AT_ONCE)]
        meanings = "\n".join("\n".join([f"{len(told)} beginbfchar", *told, "endbfchar"]) for told in lists)
        file.write({"Type": Name("Font"), "Subtype": Name("Type0"), "BaseFont": name, "Encoding": Name("Identity-H"),
                    "DescendantFonts": [descendant],
                    "ToUnicode": file.write_stream(TO_UNICODE.format(meanings).encode())}, self.reference)


def _in_ems(face: Typeface, units: Iterable[int]) -> list[int]:
    """Lengths of a font in thousandths of an em."""
    return [round(EM * length / face.em) for length in units]


def _mark(letters: Iterable[str]) -> str:
    """Six capitals by which a part of a font is told from other parts."""
    mark = crc32("".join(letters).encode())
    return "".join(chr(ord("A") + mark // 26**k % 26) for k in range(6))
