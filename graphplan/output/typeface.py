"""DejaVu Sans, by whose advances lettering is measured: which letters it has, how wide they are, and what of it a
document embeds.

Its two files come with matplotlib, as does fontTools, which reads them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path

from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont

from graphplan.errors import Refused
from graphplan.sheet.lettering.lettering import ANCHORS, DROP, TextRun, script_size
from graphplan.sheet.plates.display import Sheet, Spot, Text

EMBEDDED_TABLES = {"head", "hhea", "maxp", "hmtx", "loca", "glyf", "cvt ", "fpgm", "prep"}  # what a PDF needs


class Typeface:
    """One weight of the font."""

    def __init__(self, file: Path):
        self.file, self.font = file, TTFont(file, lazy=True)
        self.letters: dict[int, str] = self.font.getBestCmap()  # names of glyphs, by the codes of letters
        self.em: int = self.font["head"].unitsPerEm

    def glyph(self, char: str) -> int:
        """The number of a letter's glyph; 0 where the font has none."""
        return int(self.font.getGlyphID(self.letters.get(ord(char), ".notdef")))

    def advance(self, char: str) -> float:
        """The distance from the beginning of a letter to that of the next, in ems."""
        return float(self.font["hmtx"][self.letters.get(ord(char), ".notdef")][0] / self.em)

    def subset(self, glyphs: Iterable[int]) -> bytes:
        """A font of these glyphs, numbered as in the whole font, and of those that they are put together from."""
        font, written = TTFont(self.file, lazy=True, recalcTimestamp=False), BytesIO()
        subsetter = Subsetter(Options(retain_gids=True, drop_tables={*font.keys()} - EMBEDDED_TABLES))
        subsetter.populate(gids=glyphs)
        subsetter.subset(font)
        font.save(written)
        return written.getvalue()


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
    """The length of words, in ems."""
    return sum(map(typeface(bold).advance, words))


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
    return sorted({char for char in letters if not all(ord(char) in typeface(bold).letters for bold in (False, True))})
