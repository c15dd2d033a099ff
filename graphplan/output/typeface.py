"""DejaVu Sans, by whose advances lettering is measured: which letters it has, how wide they are, and what of it a
document embeds.

Its two files come with matplotlib, and are read as OpenType 1.9 has them: far sooner than a library of fonts is loaded.
"""

from __future__ import annotations

import struct
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from importlib.util import find_spec
from operator import itemgetter
from pathlib import Path

from graphplan.errors import Refused
from graphplan.sheet.lettering.lettering import ANCHORS, DROP, TextRun, script_size
from graphplan.sheet.plates.display import Sheet, Spot, Text

WHOLE_TABLES = "cvt ", "fpgm", "prep"  # by which outlines are fitted to pixels: kept as they are
WORDS, SCALE, MORE, SCALES, SQUARE = 0x0001, 0x0008, 0x0020, 0x0040, 0x0080  # what is said of a part of a glyph
SEGMENTED = 12  # the form in which letters are told by stretches
LONG = 1  # how the places of glyphs are told: as they are, not by halves


class Typeface:
    """One weight of the font: its tables by their names."""

    def __init__(self, file: Path):
        self.data, self.name = file.read_bytes(), file.stem
        records = struct.iter_unpack(">4s3I", self.data[12:12 + 16 * struct.unpack_from(">H", self.data, 4)[0]])
        self.tables = {name.decode(): self.data[start:start + long] for name, _, start, long in records}
        self.em: int = struct.unpack_from(">H", self.tables["head"], 18)[0]
        self.box: tuple[int, ...] = struct.unpack_from(">4h", self.tables["head"], 36)
        self.ascent, self.descent = struct.unpack_from(">2h", self.tables["hhea"], 4)
        self.wide_count: int = struct.unpack_from(">H", self.tables["hhea"], 34)[0]

    @cached_property
    def groups(self) -> list[tuple[int, int, int]]:
        """The stretches of the letters it has: from which to which, and the glyph of the first."""
        table = self.tables["cmap"]
        records = struct.iter_unpack(">2HI", table[4:4 + 8 * struct.unpack_from(">H", table, 2)[0]])
        place = next(place for *_, place in records if struct.unpack_from(">H", table, place)[0] == SEGMENTED)
        count = struct.unpack_from(">I", table, place + 12)[0]
        return [*struct.iter_unpack(">3I", table[place + 16:place + 16 + 12 * count])]

    def glyph(self, char: str) -> int:
        """The glyph of a letter; 0 where the font has none."""
        first, last, glyph = self.groups[max(0, bisect_right(self.groups, ord(char), key=itemgetter(0)) - 1)]
        return glyph + ord(char) - first if first <= ord(char) <= last else 0

    def advance(self, glyph: int) -> float:
        """How far the next letter stands from the beginning of one, in ems."""
        place = 4 * min(glyph, self.wide_count - 1)
        units: int = struct.unpack_from(">H", self.tables["hmtx"], place)[0]
        return units / self.em

    def _bearing(self, glyph: int) -> bytes:
        """How far a glyph begins from where it stands."""
        last = self.wide_count
        place = 4 * glyph + 2 if glyph < last else 4 * last + 2 * (glyph - last)
        return self.tables["hmtx"][place:place + 2]

    def _outline(self, glyph: int) -> bytes:
        """What is told of the outline of a glyph."""
        long = struct.unpack_from(">H", self.tables["head"], 50)[0] == LONG
        start, end = struct.unpack_from(">2I" if long else ">2H", self.tables["loca"], (4 if long else 2) * glyph)
        times = 1 if long else 2
        return self.tables["glyf"][times * start:times * end]

    def subset(self, glyphs: Sequence[int]) -> bytes:
        """A font of these glyphs, numbered as they are told, and of those that they are put together from."""
        number = {glyph: k for k, glyph in enumerate(glyphs)}
        outlines, waiting = list[bytes](), [*glyphs]
        for glyph in waiting:  # it grows by what they are put together from
            outline = bytearray(self._outline(glyph))
            for place in _places_of_parts(outline):
                part = struct.unpack_from(">H", outline, place)[0]
                if part not in number:
                    number[part] = len(waiting)
                    waiting.append(part)
                struct.pack_into(">H", outline, place, number[part])
            outlines.append(_pad(bytes(outline)))
        places = [0]
        for padded in outlines:
            places.append(places[-1] + len(padded))
        head, hhea, maxp = (bytearray(self.tables[name]) for name in ("head", "hhea", "maxp"))
        struct.pack_into(">I", head, 8, 0)
        struct.pack_into(">H", head, 50, LONG)
        struct.pack_into(">H", hhea, 34, len(waiting))
        struct.pack_into(">H", maxp, 4, len(waiting))
        widths = b"".join(struct.pack(">H", round(self.advance(glyph) * self.em)) + self._bearing(glyph)
                          for glyph in waiting)
        return _font_file({
            "head": bytes(head), "hhea": bytes(hhea), "maxp": bytes(maxp), "hmtx": widths,
            "loca": struct.pack(f">{len(places)}I", *places), "glyf": b"".join(outlines),
            **{name: self.tables[name] for name in WHOLE_TABLES}})


def _places_of_parts(outline: bytearray) -> Iterator[int]:
    """Where the numbers of glyphs stand that a glyph is put together from, if it is."""
    if not outline or struct.unpack_from(">h", outline)[0] >= 0:
        return
    place, flags = 10, MORE
    while flags & MORE:
        flags = struct.unpack_from(">H", outline, place)[0]
        yield place + 2
        place += 4 + (4 if flags & WORDS else 2)
        place += 2 if flags & SCALE else 4 if flags & SCALES else 8 if flags & SQUARE else 0


def _font_file(tables: Mapping[str, bytes]) -> bytes:
    """Tables as one file, with their sums."""
    names = sorted(tables)
    power = len(names).bit_length() - 1
    head = struct.pack(">I4H", 0x00010000, len(names), 16 << power, power, 16 * (len(names) - (1 << power)))
    place, records, contents = 12 + 16 * len(names), b"", b""
    for name in names:
        padded = _pad(tables[name])
        records += struct.pack(">4s3I", name.encode(), _sum(padded), place + len(contents), len(tables[name]))
        contents += padded
    whole = bytearray(head + records + contents)
    adjusted = place + sum(len(_pad(tables[name])) for name in names[:names.index("head")]) + 8
    struct.pack_into(">I", whole, adjusted, 0xB1B0AFBA - _sum(whole) & 0xFFFFFFFF)
    return bytes(whole)


def _pad(table: bytes) -> bytes:
    """A table up to the next multiple of four bytes."""
    return table + bytes(-len(table) % 4)


def _sum(table: bytes | bytearray) -> int:
    """The sum of a table, four bytes at a time."""
    words: tuple[int, ...] = struct.unpack(f">{len(table) // 4}I", table)
    return sum(words) & 0xFFFFFFFF


def font_file(bold: bool) -> Path:
    """The file of a weight, which comes with matplotlib; that need not be loaded for it."""
    found = find_spec("matplotlib")
    folder = Path(found.submodule_search_locations[0]) if found and found.submodule_search_locations else Path()
    return folder / "mpl-data" / "fonts" / "ttf" / f"DejaVuSans{'-Bold' if bold else ''}.ttf"


@lru_cache(maxsize=2)
def typeface(bold: bool) -> Typeface:
    """A weight of the font."""
    return Typeface(font_file(bold))


@lru_cache(maxsize=4096)
def advance(words: str, bold: bool) -> float:
    """How long words are, in ems."""
    face = typeface(bold)
    return sum(face.advance(face.glyph(char)) for char in words)


def place_runs(text: Text) -> Iterator[tuple[TextRun, Spot, float]]:
    """The runs of lettering, each with where it begins and how large it is: where those before it end."""
    sizes = [script_size(text.size) if run.level else text.size for run in text.runs]
    widths = [advance(run.text, text.bold) * size for run, size in zip(text.runs, sizes, strict=True)]
    x = text.at[0] - ANCHORS[text.anchor] * sum(widths)
    for run, size, wide in zip(text.runs, sizes, widths, strict=True):
        yield run, (x, text.at[1] + run.level * DROP * text.size), size
        x += wide


def refuse_lacking(sheet: Sheet) -> None:
    """Fails with `Refused` where a sheet has letters that the font does not."""
    letters = {char for item in sheet.items if isinstance(item, Text) for run in item.runs for char in run.text}
    if missing := lacking(letters):
        raise Refused(f"{sheet.title}: lettering", f"DejaVu Sans has no {' '.join(missing)}",
                      "draw it as SVG, whose viewer brings other fonts")


def lacking(letters: Iterable[str]) -> list[str]:
    """The letters that the font does not have in both weights."""
    return sorted({char for char in letters if not all(typeface(bold).glyph(char) for bold in (False, True))})
