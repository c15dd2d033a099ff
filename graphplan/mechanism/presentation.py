"""The table [sheet]: the paper, the frame and the title block that a scene wishes, and its scales."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from itertools import permutations

from graphplan.mechanism.fields import Field, Kind, Named, Names, Row, Table
from graphplan.mechanism.items import Item, described, perhaps
from graphplan.mechanism.model import Presentation
from graphplan.mechanism.numerals import shown
from graphplan.mechanism.pairs.pair import FRAME
from graphplan.mechanism.units import METRES
from graphplan.mechanism.values import DISTANCE, LINK, POINT, TEXT, asked, choice
from graphplan.words import LANGUAGES

SIZES = {"A4": (297.0, 210.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0), "A0": (1189.0, 841.0)}
PAPERS = tuple(f"{size}{way}" for size in SIZES for way in ("", " portrait"))
FRAMES = ("iso", "gost")
ASIDE = "aside"
PROTOCOLS = ("auto", ASIDE, "pages", "none")  # where the words stand: beside the plans, or on pages of their own
PLANS = ("N-plan", "velocity plan", "acceleration plan", "lever")  # and force plans, by their links
MOST_POSITIONS = 72  # positions that are drawn
LENGTH = r"(?=[0.]*[1-9])(\d{1,9}(?:\.\d{1,9})?)"  # above zero
RATIO = rf"\s*{LENGTH}\s*:\s*{LENGTH}\s*"


def _line(item: Item, names: Names) -> str | None:
    text = item.text("a text", "a text in quotes")
    if text is not None and not text.replace("\N{NO-BREAK SPACE}", " ").isprintable():
        item.fault("a text with line breaks or characters that cannot be printed", "a text on one line")
    return text


def _ratio(item: Item, names: Names) -> Fraction | None:
    """The scene's lengths in a millimetre of paper, from a ratio such as 1:2."""
    ratio = re.fullmatch(RATIO, item.value) if isinstance(item.value, str) else None
    if ratio is None:
        return item.fault(f"{described(item.value)} is no ratio",
                          'a length on paper to a length of the scene, such as "1:2"')
    return Fraction(ratio[2]) / Fraction(ratio[1]) / 1000 / METRES[names.units.length]


def _plan(name: str, item: Item, names: Names) -> None:
    """A fault where there is no such plan; which force plans there are only the drawing tells."""
    if name not in PLANS and not name.startswith(("force plan ", "lever ")):
        item.fault("there is no such plan", perhaps(name, (*PLANS, "force plan 2, 3"), "plan"))


def _stands_still(point: object, item: Item, names: Names) -> bool:
    """Whether a point whose path is asked for has none; that is a fault."""
    still = point in names.points and point not in names.movable
    if still:
        item.fault(f"{point} does not move", "a point of moving links only")
    return still


def _on_another(names: Names) -> Iterator[str]:
    """Each link with each other one, by name."""
    return (f"{link} {on}" for link, on in permutations((FRAME, *names.moving), 2))


def _count(item: Item, names: Names) -> int | None:
    number = item.number()
    if number is None:
        return None
    if number.denominator != 1 or not 1 <= number <= MOST_POSITIONS:
        return item.fault(f"{shown(number)} is no number of positions", f"a whole number from 1 to {MOST_POSITIONS}")
    return int(number)


def _presentation(row: Row) -> Presentation | None:
    """How the scene wishes its sheet; all plans are drawn in lengths of the mechanism plan, so k_a is k_v^2/k_s."""
    values = {key: row[key] for key in row.items}
    if "scale" in values:
        if "k_s" in values:
            row.items["scale"].fault("k_s tells the scale already", "scale or k_s, not both")
        values["k_s"] = values.pop("scale")
    k_s, k_v, k_a = (values.get(key) for key in ("k_s", "k_v", "k_a"))
    if k_s and k_v and k_a and shown(k_a) != shown(k_v**2 / k_s):
        what = f"{shown(k_a)} does not fit k_s and k_v"
        row.items["k_a"].fault(what, f"k_v^2/k_s, which is {shown(k_v**2 / k_s)}")
    return Presentation(**{key: value for key, value in values.items() if value})


def _above_0(what: str) -> Kind:
    return Kind(DISTANCE.says, lambda item, names: item.positive(what), DISTANCE.schema)


_TEXT, _SCALE = Kind("text", _line, TEXT.schema), _above_0("scale")
SHEET = Table("the sheet", (
    Field("paper", "the sheet; without it the smallest that will do", choice(*PAPERS)),
    Field("frame", "frame and title block after ISO 5457 and ISO 7200, or after GOST 2.301 and GOST 2.104",
          choice(*FRAMES), default="iso"),
    Field("language", "the language of all words on the sheet", choice(*LANGUAGES), default="en"),
    Field("convention", "scales as real per drawn (k_v, mm/s per mm) or drawn per real (mu_v, mm per mm/s)",
          choice("real", "drawn"), default="real"),
    Field("owner", "the legal owner, for the title block", _TEXT),
    Field("number", "the identification number", _TEXT),
    Field("date", "the date of issue", _TEXT),
    Field("drawn_by", "who drew it", _TEXT, default="graphplan"),
    Field("approved_by", "who approved it", _TEXT),
    Field("scale", "the scale of the mechanism plan, a ratio of paper to scene",
          Kind("ratio", _ratio, {"type": "string", "pattern": f"^{RATIO}$"})),
    Field("k_s", "the same as lengths of the scene for a mm of paper", _SCALE),
    Field("k_v", "the speed, in length/s, for a mm of paper", _SCALE),
    Field("k_a", "the acceleration, in length/s^2, for a mm of paper", _SCALE),
    Field("k_F", "the force for a mm of paper", _SCALE),
    Field("multiples", "how many times as large as by these scales other plans are drawn, by their names",
          Named(_above_0("multiple"), TEXT, _plan)),
    Field("curves", 'the points whose paths over the motion are drawn on the mechanism plan, or "all"',
          asked("point", '["M"]', lambda names: names.points, lambda names: names.movable, after=("points", "links"),
                entry=POINT, wrong=_stands_still)),
    Field("centrodes", "of which links, each with the link that it moves on, the fixed and the moving centrodes are "
          'drawn there; or "all", those of all links on the frame',
          asked("pair of links", '["2 frame"]', lambda names: [*_on_another(names)],
                lambda names: tuple(f"{link} {FRAME}" for link in names.moving), many="pairs of links",
                after=("links",))),
    Field("cubics", "the links of which the points that keep the curvature of their paths are drawn there and their "
          'centres: the cubic of stationary curvature of this pose; or "all"',
          asked("link", '["2"]', lambda names: names.moving, after=("links",), entry=LINK)),
    Field("positions", "how many positions of the mechanism are drawn there in faint lines, at equal travels",
          Kind("whole number", _count, {"type": "integer", "minimum": 1, "maximum": MOST_POSITIONS})),
), _presentation)
