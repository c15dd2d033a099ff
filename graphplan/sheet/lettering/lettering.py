"""Lettering: names as a textbook sets them, measured before they are drawn.

`v_c` is v with a subscript c, `alpha` is the Greek letter, `A'` has a prime. Widths are the advances of DejaVu Sans in
thousandths of an em, in Latin, Greek and Cyrillic; it is wider than Arial or Helvetica, so what fits here fits with
any font of the stack.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain, groupby
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

from graphplan.mechanism.units import iso_size

FONTS = "'DejaVu Sans', Verdana, Arial, Helvetica, sans-serif"
SIZE = 2.5  # mm: in which words are set; the cap height is 0.729 of it, so 1.8 mm
HEADING = 4.82  # mm: capitals of 3.5 mm
CAPS, DEPTH = 0.729, 0.2
SUBSCRIPT, DROP = 0.72, 0.22
INDEX_DEPTH = DROP + 0.15  # how far letters with indices reach below the base line
TAILLESS = frozenset("ABCDEFGHIKLMNOPRSTUVWXYZabcdefhiklmnorstuvwxz0123456789αδεθικλνοπστυωΔΛΠΣΦΩ′″ ")
ANCHORS = {"start": 0.0, "middle": 0.5, "end": 1.0}  # how much of lettering stands left of its place

TIE = "\u00a0"  # a space at which no line is broken
_INSIDE_ITEM = re.compile(r"(?<![,:]) | (?=[^()]*\))")
_BY_SHORT_WORD = re.compile(r"(?<=\d) (?=[^\W\d])|(?<=[^\W\d]\.) (?=\d)|(?<==) | (?==|\S{1,4}$)")
_IN_EQUATION = re.compile(r"(?<==) | (?==)|(?<=\d) (?=mm\b)")
_LETTERS = tomllib.loads(Path(__file__).with_name("letters.toml").read_text(encoding="utf-8"))
GREEK: dict[str, str] = _LETTERS["greek"]
ADVANCE = {char: int(width) / 1000 for width, chars in _LETTERS["advances"].items() for char in chars}
_BOLD = 1.25  # DejaVu Sans Bold is wider than the book weight by at most this

CAPITALS = frozenset(map(str.capitalize, GREEK))  # Xi is the letter, XI the eleventh corner


@dataclass(frozen=True)
class LetterSizes:
    """The sizes of the letters on a sheet, mm: of marks, and of words and step numbers (ISO 3098).

    Capitals are 2.5 and 1.8 mm high on A4 and A3, 3.5 and 2.5 mm on larger sheets; those of headings 3.5 mm on all.
    """

    mark: float
    text: float

    @property
    def times(self) -> float:
        """The size of words, beside the size in which they are set."""
        return self.text / SIZE


SMALL_SHEET, LARGE_SHEET = LetterSizes(3.45, SIZE), LetterSizes(HEADING, 3.45)


def letter_sizes(paper: str) -> LetterSizes:
    """The sizes of the letters on a sheet such as `A3` or `A4 portrait`."""
    return SMALL_SHEET if iso_size(paper) in ("A4", "A3") else LARGE_SHEET


class TextRun(NamedTuple):
    """A stretch of text on one level: 0 on the base line, -1 subscript, 1 superscript."""

    text: str
    level: int = 0


Runs = tuple[TextRun, ...]
SPACE: Runs = (TextRun(" "),)


@lru_cache(maxsize=4096)  # a name stands in many sentences
def name_runs(name: str) -> Runs:
    """A name as runs: primes, Greek letters, one superscript and one subscript, whatever they are made of."""
    bare = name.rstrip("'")
    primes = {0: "", 1: "′", 2: "″"}.get(len(name) - len(bare), "′" * (len(name) - len(bare)))
    head, _, index = bare.partition("_")
    stem, _, above = head.partition("^")
    index = re.sub(r"(?<=\d)_(?=\d)", ",", index).replace("_", "")
    return _merge_runs((TextRun(_greek(stem) + primes), TextRun(above, 1), TextRun(_greek_words(index), -1)))


def _greek(name: str) -> str:
    """A name in Greek where it is that of a letter, the link behind it as it is."""
    stem, bracket, link = name.partition("(")
    letter = GREEK[stem.lower()] if stem in (*GREEK, *CAPITALS) else stem
    return (letter.upper() if stem in CAPITALS else letter) + bracket + link


_PLAIN = re.compile(r"\b(?:[A-Za-zα-ω]|" + "|".join(GREEK) + r")_[^\W_]+(?:,[^\W_]+)?\b(?:'+(?!\w))?"
                    r"|\b(?:omega|alpha|mu)\b")


@lru_cache(maxsize=4096)  # the words of a sheet are set for every width of column that is tried
def sentence_runs(sentence: str, names: tuple[str, ...] = ()) -> Runs:
    """A sentence as runs; `names` are marks whose names may stand in it, even run together as in `v_qC`."""
    return _set_names(sentence, _pattern(names) if names else _PLAIN)


@lru_cache(maxsize=8)
def _pattern(names: tuple[str, ...]) -> re.Pattern[str]:
    """A pattern of what is set with subscripts or in Greek: the names, longest first, and what always is."""
    special = [n for n in names if "_" in n or n.endswith("'") or n.lower() in GREEK]
    ranked = sorted(special, key=lambda n: (-len(n), n))
    patterns = [rf"(?<![a-z]){n}(?![a-z_])" if n.isalpha() else re.escape(n) + r"(?!\d)" * n[-1].isdigit()
                for n in ranked]
    letters = "|".join(n for n in ranked if n.lower() in GREEK)
    pairs = [rf"(?<![a-z])(?:{letters}){{2}}(?![a-z_])"] if letters else []  # as ends of a side
    return re.compile("|".join([*pairs, *patterns, _PLAIN.pattern]))


def _set_names(sentence: str, pattern: re.Pattern[str]) -> Runs:
    runs: list[TextRun] = []
    done = 0
    for match in pattern.finditer(sentence):
        names = chain.from_iterable(map(name_runs, _ends(match.group())))
        runs += [TextRun(sentence[done : match.start()]), *names]
        done = match.end()
    return _merge_runs((*runs, TextRun(sentence[done:])))


def _ends(name: str) -> list[str]:
    """The Greek names of two ends that stand together, or the name alone."""
    pairs = ([name[:k], name[k:]] for k in range(2, len(name)))
    return next((pair for pair in pairs if all(end.lower() in GREEK for end in pair)), [name])


_WORD, _COMMA_BETWEEN = re.compile(r"[A-Za-z]{2,}"), re.compile(r"(?<=[Α-ω]),(?=[Α-ω])")


def _greek_words(text: str) -> str:
    """A text with Greek letters for their names, those of two ends without a comma between."""
    return _COMMA_BETWEEN.sub("", _WORD.sub(lambda word: "".join(map(_greek, _ends(word.group()))), text))


_SYMBOLS = re.compile(r"\^([A-Za-z]+)|_([A-Za-z0-9,']+(?:\([A-Za-z0-9]+\))?)")


@lru_cache(maxsize=4096)
def equation_runs(text: str) -> Runs:
    """An equation as runs: a^n_BA is a with n above and BA below; the prime of P_2' stands on its letter."""
    runs, done = list[TextRun](), 0
    for match in _SYMBOLS.finditer(text):
        above, below = match.groups()
        index = below.rstrip("'") if below and below[0].isdigit() else below
        primes = below[len(index):].replace("''", "″").replace("'", "′") if below else ""
        runs += [TextRun(_greek_words(text[done : match.start()]) + primes),
                 TextRun(above, 1) if above else TextRun(_greek_words(index), -1)]
        done = match.end()
    return _merge_runs((*runs, TextRun(_greek_words(text[done:]))))


def _merge_runs(runs: Iterable[TextRun]) -> Runs:
    """Drop empty runs, and merge neighbours on one level."""
    levels = groupby([run for run in runs if run.text], attrgetter("level"))
    return tuple([TextRun("".join([run.text for run in group]), level) for level, group in levels])


def list_runs(names: Iterable[str]) -> Runs:
    """Names in a row."""
    runs = [run for name in names for run in (TextRun(", "), *name_runs(name))]
    return _merge_runs(runs[1:])


def depth(runs: Runs) -> float:
    """Depth of letters below the base line, relative to their size: deeper with indices."""
    return INDEX_DEPTH if any(run.level < 0 for run in runs) else DEPTH


def inked_depth(runs: Runs, size: float) -> float:
    """Depth of the ink of letters, relative to their size: by their descenders, and by the drop of indices."""
    small = script_size(size) / size
    return max((DROP * (run.level < 0) + DEPTH * (small if run.level else 1.0) * (not TAILLESS.issuperset(run.text))
                for run in runs if run.level <= 0), default=0.0)


def width(runs: Runs, size: float, bold: bool = False) -> float:
    """Length of the lettering, in mm."""
    return _ems(runs, script_size(size) / size) * size * (_BOLD if bold else 1.0)


def script_size(size: float) -> float:
    """The size of subscripts and superscripts: smaller than the letters, but no smaller than words are."""
    return max(SUBSCRIPT * size, min(size, SIZE))


@lru_cache(maxsize=4096)
def _ems(runs: Runs, small: float) -> float:
    """The length of the lettering in ems, with subscripts so much smaller."""
    return sum(sum([ADVANCE.get(char, 0.7) for char in run.text]) * (small if run.level else 1.0) for run in runs)


def wrap(runs: Runs, size: float, room: float, bold: bool = False) -> list[Runs]:
    """The lettering in lines no longer than `room`, broken at spaces, at those that tie only where there is no other,
    and a longer word anywhere."""
    lines: list[Runs] = []
    line: list[TextRun] = []
    long, space = 0.0, width(SPACE, size, bold)
    for word, ems in _words(runs, script_size(size) / size):
        wide = ems * size * (_BOLD if bold else 1.0)
        if line and long + space + wide <= room:
            line += (*SPACE, *word)
            long += space + wide
            continue
        if line:
            lines.append(_merge_runs(line))
        line, long = [*word], wide
        while long > room and len(_flat(line)) > 1:
            head, tail = _break_line(line, size, room, bold)
            lines.append(head)
            line, long = [*tail], width(tail, size, bold)
    lines += [_merge_runs(line)] if line else []
    return [tuple(TextRun(run.text.replace(TIE, " "), run.level) for run in line) for line in lines]


def tie_words(text: str) -> str:
    """A list whose items are not broken at their ends of lines, such as lengths with their letters and units."""
    return _INSIDE_ITEM.sub(TIE, text)


def tie_short_words(text: str) -> str:
    """A sentence in which no line ends between a number and its unit, or an abbreviation and its number, or beside an
    equals sign, and no short word is left for the last."""
    return _BY_SHORT_WORD.sub(TIE, text)


def tie_equations(text: str) -> str:
    """A sentence in which no line ends beside an equals sign, or between a number and its mm."""
    return _IN_EQUATION.sub(TIE, text)


def two_line_width(runs: Runs, size: float) -> float:
    """The least width in which bold lettering fits on two lines."""
    long = width(runs, size, bold=True)
    return next((share * long for share in (0.55, 0.65, 0.8) if len(wrap(runs, size, share * long, bold=True)) <= 2),
                long)


def plain(runs: Runs) -> str:
    """The lettering without levels."""
    return "".join(run.text for run in runs)


@lru_cache(maxsize=4096)
def _words(runs: Runs, small: float) -> list[tuple[Runs, float]]:
    """The words, each with its length beside the size of the letters, and with subscripts so much smaller."""
    words: list[list[TextRun]] = [[]]
    for run in runs:
        for i, piece in enumerate(run.text.split(" ")):
            if i:
                words.append([])
            if piece:
                words[-1].append(TextRun(piece, run.level))
    return [(tuple(word), _ems(tuple(word), small)) for word in words if word]


def _flat(runs: Iterable[TextRun]) -> Runs:
    """Split runs into one run a character."""
    return tuple(TextRun(char, run.level) for run in runs for char in run.text)


def _break_line(runs: Iterable[TextRun], size: float, room: float, bold: bool) -> tuple[Runs, Runs]:
    """The longest beginning that fits, to a space that ties if it has one, and the rest."""
    chars = _flat(runs)
    count = max(1, next((i for i in range(1, len(chars)) if width(chars[: i + 1], size, bold) > room), len(chars)))
    ties = [i for i in range(1, min(count + 1, len(chars))) if chars[i].text == TIE]
    end, start = (ties[-1], ties[-1] + 1) if ties else (count, count)
    return _merge_runs(chars[:end]), _merge_runs(chars[start:])
