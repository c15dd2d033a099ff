"""The table [sheet]: the paper, the frame and the title block that a scene wishes, and its scales."""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from graphplan.mechanism.faults import perhaps
from graphplan.mechanism.items import Item, described
from graphplan.mechanism.model import Presentation, Units
from graphplan.mechanism.numerals import shown
from graphplan.mechanism.units import METRES

PAPERS = tuple(f"A{size}{way}" for size in (4, 3, 2, 1, 0) for way in ("", " portrait"))
FRAMES, CONVENTIONS = ("iso", "gost"), ("real", "drawn")
CODES = ("en", "de", "lv", "et", "ru", "uk")
TEXTS = ("owner", "number", "date", "drawn_by", "approved_by")
WORDS = {"paper": PAPERS, "frame": FRAMES, "language": CODES, "convention": CONVENTIONS}
PLANS = ("N-plan", "velocity plan", "acceleration plan", "lever")  # and force plans, by their links
SCALES = ("k_s", "k_v", "k_a", "k_F")
LENGTH = r"(?=[0.]*[1-9])(\d{1,9}(?:\.\d{1,9})?)"  # above zero
RATIO = rf"\s*{LENGTH}\s*:\s*{LENGTH}\s*"
KEYS = (*WORDS, *TEXTS, "scale", *SCALES, "multiples")


def read_presentation(item: Item, units: Units) -> Presentation:
    """How the scene wishes its sheet; what it leaves out, or gets wrong, is as it is without the table."""
    fields = item.fields(KEYS, {}) or {}
    found: dict[str, Any] = {key: fields[key].choice(words) for key, words in WORDS.items() if key in fields}
    found |= {key: _line(fields[key]) for key in TEXTS if key in fields}
    found |= {key: _positive(fields[key], "scale") for key in SCALES if key in fields}
    if "scale" in fields:
        found["k_s"] = _ratio(fields["scale"], units, "k_s" in fields)
    if "multiples" in fields:
        found["multiples"] = _multiples(fields["multiples"])
    _check_accelerations(fields, found)
    return Presentation(**{key: value for key, value in found.items() if value})


def _line(item: Item) -> str | None:
    """A text on one line."""
    text = item.text("a text", "a text in quotes")
    if text is not None and not text.replace("\N{NO-BREAK SPACE}", " ").isprintable():
        item.fault("a text with line breaks or characters that cannot be printed", "a text on one line")
        return None
    return text


def _positive(item: Item, what: str) -> Fraction | None:
    """A number above zero."""
    number = item.number()
    if number is not None and number <= 0:
        item.fault(f"the {what} {shown(number)} is not positive", f"a {what} above 0")
        return None
    return number


def _ratio(item: Item, units: Units, told: bool) -> Fraction | None:
    """The scene's lengths in a millimetre of paper, from a ratio such as 1:2, unless they are told already."""
    ratio = re.fullmatch(RATIO, item.value) if isinstance(item.value, str) else None
    if told:
        item.fault("k_s tells the scale already", "scale or k_s, not both")
    elif ratio is None:
        item.fault(f"{described(item.value)} is no ratio", 'a length on paper to a length of the scene, such as "1:2"')
    else:
        return Fraction(ratio[2]) / Fraction(ratio[1]) / 1000 / METRES[units.length]
    return None


def _multiples(item: Item) -> dict[str, Fraction]:
    """By how much other plans are larger than the mechanism's; which force plans there are only the drawing tells."""
    multiples: dict[str, Fraction] = {}
    for plan, entry in (item.table() or {}).items():
        if plan not in PLANS and not plan.startswith(("force plan ", "lever ")):
            entry.fault("there is no such plan", perhaps(plan, (*PLANS, "force plan 2, 3"), "plan"))
        multiple = _positive(entry, "multiple")
        if multiple is not None:
            multiples[plan] = multiple
    return multiples


def _check_accelerations(fields: Mapping[str, Item], found: Mapping[str, Fraction | None]) -> None:
    """All plans are drawn in lengths of the mechanism plan, so k_a is k_v^2/k_s."""
    k_s, k_v, k_a = (found.get(key) for key in ("k_s", "k_v", "k_a"))
    if k_s and k_v and k_a and shown(k_a) != shown(k_v**2 / k_s):
        fields["k_a"].fault(f"{shown(k_a)} does not fit k_s and k_v", f"k_v^2/k_s, which is {shown(k_v**2 / k_s)}")
