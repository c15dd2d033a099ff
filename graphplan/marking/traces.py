"""What is seen on a student's sheet: points, lines and circles in its own millimetres, and numbers in a table; and
names of marks, spelled as programs have them, whichever way a student or his drawing program writes them.

Nothing here knows mechanics. A sheet may lie, be turned and be scaled as it likes; where a plan of it is known to lie,
as on a printed handout, its frame says so. In names `v_b` is v with a subscript, Greek letters have their names, primes
stand at the end.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from shapely import LineString, Point, Polygon

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.sheet.lettering.lettering import CAPS, GREEK

Spot = tuple[float, float]
MIN_SPOTS = {POINT: 1, LINE: 2, CIRCLE: 3}  # how many spots at least say where a thing lies


@dataclass(frozen=True)
class Trace:
    """One thing on the sheet, in mm, x to the right and y up.

    A point has one spot, a line two of its own (the ends that were drawn), a circle three or more of its rim, as far
    as it was drawn. `label` is what it is called, `panel` the plan it is said to lie on, both empty where nobody says;
    `blur` is the standard deviation, in mm, with which it was read. A label that only stands `beside` it may be that of
    its neighbour; `crossed` is one where strokes only cross, without a dot.
    """

    kind: str
    spots: tuple[Spot, ...]
    label: str = ""
    panel: str = ""
    blur: float = 0.0
    beside: bool = False
    crossed: bool = False

    def __post_init__(self) -> None:
        if len(self.spots) < MIN_SPOTS[self.kind]:
            raise ValueError(
                f"a {self.kind} needs {MIN_SPOTS[self.kind]} spots, {self.label or 'one'} has {self.spots}")

    @property
    def figure(self) -> Point | LineString:
        """Figure on the sheet, of an arc its chords."""
        return Point(*self.spots[0]) if self.kind == POINT else LineString(self.spots)


@dataclass(frozen=True)
class Lettering:
    """Letters on the sheet: where their base line begins and how long it is, the size of the letters, and where their
    leader ends if they have one; all in mm."""

    text: str
    at: Spot
    size: float
    long: float = 0.0
    leads: Spot | None = None

    @property
    def names(self) -> list[str]:
        """Named marks: several at one spot stand with commas; empty for other words."""
        whole = mark_name(self.text)
        names = [whole] if whole else [mark_name(piece) for piece in self.text.split(",")]
        return names if all(names) else []

    @property
    def box(self) -> Polygon:
        """The box of the letters."""
        (x, y), high = self.at, CAPS * self.size
        return shapely.box(x, y, x + self.long, y + high)


@dataclass(frozen=True)
class PlanFrame:
    """Frame of a plan on the sheet: its origin in mm, and the vector in mm of one unit along x."""

    origin: complex
    unit: complex

    @classmethod
    def least_squares(cls, marks: ArrayLike, spots: ArrayLike, weights: Any = None) -> PlanFrame:
        """The frame in which marks of a plan lie nearest to spots of the sheet, by the sum of the squares of how far
        they are apart, each of its weight; with a unit of 0 where all marks are one."""
        plan, sheet = np.array(marks), np.array(spots)
        centre, middle = (np.average(at, weights=weights) for at in (plan, sheet))
        spread, product = (complex(np.average((plan - centre).conjugate() * at, weights=weights))
                           for at in (plan - centre, sheet - middle))
        unit = product / spread if spread else 0j
        return cls(complex(middle - unit * centre), unit)

    def to_sheet(self, spot: complex) -> complex:
        """From the plan to the sheet."""
        return self.origin + self.unit * spot

    def to_plan(self, spot: complex) -> complex:
        """From the sheet to the plan."""
        return (spot - self.origin) / self.unit


Frames = Mapping[str, PlanFrame]


def as_spot(z: complex) -> Spot:
    """A complex number as a spot."""
    return z.real, z.imag


def first_spots(traces: Iterable[Trace]) -> NDArray[np.complex128]:
    """Places of points, as complex numbers; of other traces, their starts."""
    return np.array([complex(*trace.spots[0]) for trace in traces], np.complex128)


@dataclass(frozen=True)
class StudentNumber:
    """One entry of a result table: a vector's components or a single number, the unit that was written, and the
    standard deviation with which it was rounded, in that unit."""

    kind: str
    of: str
    value: tuple[float, ...]
    unit: str = ""
    rounding: float = field(default=0.0, compare=False)


class SearchableImage(Protocol):
    """A picture of a sheet that can be asked for what is expected on it; all in mm of the sheet."""

    def find_line(self, one: Spot, two: Spot, within: float) -> Trace | None:
        """The line about the expected one between two spots."""

    def find_arc(self, centre: Spot, radius: float, spots: Sequence[Spot], within: float) -> Trace | None:
        """The arc about the expected one, near some spots of it."""

    def find_dot(self, spot: Spot, within: float) -> Trace | None:
        """The point about the expected one."""

    def visible_share(self, kind: str, spots: Sequence[Spot], within: float) -> float | None:
        """The share of some spots that have a stroke, or a point, so near; None where most could not be seen."""


@dataclass(frozen=True)
class Submission:
    """A drawing as it was handed in; `shows` are the kinds of thing it could show, `frames` those that are known.

    A file of measured points shows no lines, so that none is missing there. A picture's faint lines are found where
    they are expected: its `page` is asked for them. `tips` are where heads of arrows end, filled or open ones.
    `letters` stand beside marks; which of them each names, the whole drawing tells.
    `millimetres` is what speaks for lengths being in mm, as a logarithm of odds: minus infinity where the unit is the
    drawing's own.
    `measured` says that its marks were measured and written down, `stated` how precisely in the student's own words:
    else their blur is the least that it may be. `left_out` is what it has that is too small to be seen on paper.
    """

    name: str
    traces: tuple[Trace, ...] = ()
    numbers: tuple[StudentNumber, ...] = ()
    shows: frozenset[str] = frozenset()
    frames: Frames = field(default_factory=dict)
    page: SearchableImage | None = None
    tips: tuple[Spot, ...] = ()
    letters: tuple[Lettering, ...] = ()
    measured: bool = False
    stated: bool = False
    left_out: tuple[str, ...] = ()
    millimetres: float = math.inf


# ---- spelling -------------------------------------------------------------------------------------------------------


NAMES = {letter: name for name, letter in GREEK.items()} | {"ϵ": "epsilon", "ϕ": "phi", "ϑ": "theta"}
SPELLED_LETTERS = {letter.upper(): name.capitalize() for letter, name in NAMES.items()} | NAMES
SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉ₐₑₕₖₗₘₙₒₚₛₜₓ", "0123456789aehklmnopstx")
PRIMES = str.maketrans({"′": "'", "’": "'", "`": "'", "″": "''", "”": "''", '"': "''", "‴": "'''"})
NAME_STEM = "|".join([*sorted(GREEK, key=len, reverse=True), "[A-Z]?[a-z][0-9]{0,2}", "[IVX]{3,6}", "[0-9]{1,3}"])
MARK_NAME = re.compile(rf"(?:{NAME_STEM})(?:_[A-Z0-9,]{{1,6}})?(?:\([A-Z0-9]{{1,3}}\))?'*", re.IGNORECASE)


def spell(name: str) -> str:
    """A name as it is compared: v_{b}, A₁′, α and P_25_1 become v_b, A_1', alpha and P_25,1."""
    text = re.sub(r"[{}$\\]", "", name.strip()).translate(PRIMES)
    if low := re.search(r"[₀-₉ₐ-ₜ]+", text):
        text = f"{text[: low.start()]}_{low[0].translate(SUBSCRIPTS)}{text[low.end() :]}"
    text = "".join([SPELLED_LETTERS.get(char, char) for char in text])
    stem, _, index = text.replace("'", "").partition("_")
    index = re.sub(r"(?<=\d)_(?=\d)", ",", index).replace("_", "")
    return stem + (f"_{index}" if index else "") + "'" * text.count("'")


def bare_name(name: str) -> str:
    """A name without what spellings differ in: A_3, a3 and "link A3" are one."""
    return re.sub(r"^(link|point)\s+|[\s_]", "", spell(name).casefold())


def mark_name(name: str) -> str:
    """The name as spelled, if it reads as that of a mark; else empty."""
    name_spelled = spell(name)
    return name_spelled if MARK_NAME.fullmatch(name_spelled) else ""


def is_greek(name: str) -> bool:
    """Whether the name is a Greek letter's, as those of lines are."""
    return name.rstrip("'").partition("_")[0].lower() in GREEK


def can_name_line(name: str) -> bool:
    """Whether a name may stand beside a line: a Greek letter's or a number."""
    return is_greek(name) or name.isdigit()
