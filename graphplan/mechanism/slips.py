"""Slips of the pen: a decimal comma, a unit with the number, the fixed link by another name; and what to write instead.

Read only where a number or a name is wanted and none is found, in a string or in text that is no TOML.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from graphplan.mechanism.pairs.pair import FRAME
from graphplan.mechanism.units import BY_QUANTITY

NUMBER = r"[-+]?\d+(?:[.,]\d+)?"
DEGREES, TURNS, RADIANS = ("°", "deg", "degree", "degrees"), ("rpm", "min-1", "1/min"), ("rad",)
ATOMS = (*(unit for units in BY_QUANTITY.values() for unit in units), *DEGREES, *TURNS, *RADIANS, "s", "Nm")
UNIT = "(?:{0})(?:[²2]|\\^2)?(?:\\s*[/*·]\\s*(?:{0})(?:[²2]|\\^2)?)*".format(
    "|".join(sorted(map(re.escape, ATOMS), key=len, reverse=True)))
WRITTEN = re.compile(rf"\s*(?P<number>{NUMBER})\s*(?P<unit>{UNIT})?\s*")
IN_TEXT = re.compile(rf"(?:=\s*(?P<comma>[-+]?\d+,\d+)|[=\[,]\s*(?P<beside>{NUMBER}\s*(?:{UNIT})))\s*(?=[,\]}}#]|$)")
UNQUOTED = re.compile(r"\s*([\w-]+)\s*=\s*([^\W\d]\w*(?:\s+\w+)*)\s*(?:#.*)?")
VECTOR = re.compile(rf"\[\s*({NUMBER}),\s+({NUMBER})\s*\]")
TEXTS = re.compile(r"\"[^\"]*\"|'[^']*'|#.*")


def slip(text: str, key: str = "") -> tuple[str, str] | None:
    """The fault in a text that should be a number, and the remedy for this key; None if no known slip is in it."""
    written = WRITTEN.fullmatch(text)
    if written is None:
        return None
    number, unit = written["number"].replace(",", "."), written["unit"]
    wrong = [*(["a decimal comma"] if "," in written["number"] else []), *(["a unit in it"] if unit else [])]
    if not wrong:
        return None
    problem = f'"{text.strip()}" has {" and ".join(wrong)}'
    return problem, _remedy(number, unit, key) if unit else number


def slip_in_line(line: str) -> tuple[str, str] | None:
    """The fault in the first number with a slip in a line that is not TOML, and its remedy; None if there is no such
    number."""
    bare = TEXTS.sub(lambda text: " " * len(text[0]) if text[0][0] == "#" else "_" * len(text[0]), line)
    match = IN_TEXT.search(bare)
    if match is None:
        return None
    key = re.search(r"([\w-]+)\s*$", bare[: match.start()])
    return slip(match["comma"] or match["beside"], key[1] if key else "")


def bare_name(line: str, column: int) -> tuple[str, str] | None:
    """The fault in a name at this column that needs quotes for its letters, and its remedy; None if there is no such
    name."""
    for name in re.finditer(r"[\w'′-]+", line):
        if name.start() < column <= name.end() and not line[column - 1].isascii():
            return f"the name {name[0]} has letters other than A to Z, so it is quoted", f'"{name[0]}"'
    return None


def quote_slip(line: str) -> tuple[str, str] | None:
    """Return what is wrong with a line whose text has no quotes, and the line with them; None for any other line."""
    words = UNQUOTED.fullmatch(line)
    return (f"{words[2]} has no quotes", f'{words[1]} = "{words[2]}"') if words else None


def names_in(text: str, known: Collection[str]) -> list[str]:
    """Split a text without blanks into known names, in their order, the longest first; empty if it cannot be split."""
    for name in sorted(known, key=len, reverse=True):
        if text == name:
            return [name]
        if name and text.startswith(name) and (rest := names_in(text[len(name):], known)):
            return [name, *rest]
    return []


def slips_in_vectors(text: str) -> Iterator[tuple[str, str, str]]:
    """The place of each vector such as [12,5, 30], which TOML reads as three numbers, what is wrong, what is right."""
    for count, line in enumerate(text.splitlines(), 1):
        for vector in VECTOR.finditer(line):
            if "," in vector[1] + vector[2]:
                right = f"[{vector[1].replace(',', '.')}, {vector[2].replace(',', '.')}]"
                yield f"line {count}", f"{vector[0]} has a decimal comma", right


def _remedy(number: str, unit: str, key: str) -> str:
    """The number alone, and how a scene gives its unit."""
    if unit in DEGREES:
        return f"{number}, as angles are in degrees"
    if unit in RADIANS:
        return "the angle in degrees"
    if unit in TURNS and key != "rpm":
        return f"rpm = {number} instead of omega"
    for quantity, table in BY_QUANTITY.items():
        name = next((name for name in table if re.match(rf"{name}(?![A-Za-z])", unit)), "")
        if name and key != "gravity":
            return f'{number}, with {quantity} = "{name}" in [units]'
    return f"{number} alone"


# --- the fixed link by other names -----------------------------------------------------------------------------------


SYNONYMS = frozenset((
    "0", "frame", "ground", "base", "fixed", "fixed link", "chassis", "bed",  # English
    "gestell", "rahmen", "grund", "boden", "statnis", "balsts", "rāmis", "pamatne",  # German, Latvian
    "alus", "kere", "kinnislüli", "raam",  # Estonian
    "стойка", "станина", "основание", "рама", "стояк", "основа",  # Russian, Ukrainian
    "bâti", "bati", "bâtis", "telaio", "bastidor", "rám", "podstawa", "ostoja",
))
"""In small letters."""


def is_frame_synonym(name: str) -> bool:
    """Whether a name is one that the fixed link often has, and not frame itself."""
    return name != FRAME and name.strip().lower() in SYNONYMS


def with_frame(text: str, known: Collection[str]) -> str:
    """Replace each unknown synonym of frame by `frame` in a link, or several such as `3 along ground`; empty if the
    scene does not know the result either."""
    words = [FRAME if is_frame_synonym(word) and word not in known else word for word in text.split()]
    corrected = " ".join(words)
    return corrected if corrected != text and corrected in known else ""
