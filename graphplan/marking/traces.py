"""What is seen on a student's sheet: points, lines and circles in its own millimetres, and numbers in a table.

Nothing here knows mechanics. A sheet may lie, be turned and be scaled as it likes; where a plan of it is known to
lie, as on a printed handout, its frame says so.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import shapely
from shapely import LineString, Point, Polygon

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.spelling import mark
from graphplan.sheet.lettering.lettering import CAPS

Spot = tuple[float, float]
SPOTS = {POINT: 1, LINE: 2, CIRCLE: 3}  # how many spots at least say where a thing lies


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
        if len(self.spots) < SPOTS[self.kind]:
            raise ValueError(f"a {self.kind} needs {SPOTS[self.kind]} spots, {self.label or 'one'} has {self.spots}")

    @property
    def figure(self) -> Point | LineString:
        """It as a figure on the sheet, of an arc its chords."""
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
        """The marks that are named: several that share a spot stand with commas; other words name none."""
        whole = mark(self.text)
        found = [whole] if whole else [mark(part) for part in self.text.split(",")]
        return found if all(found) else []

    @property
    def box(self) -> Polygon:
        """The box of the letters."""
        (x, y), high = self.at, CAPS * self.size
        return shapely.box(x, y, x + self.long, y + high)


@dataclass(frozen=True)
class PlanFrame:
    """Where a plan lies on the sheet: its origin in mm, and what one unit of it along x is there, as a vector in mm.
    """

    origin: complex
    unit: complex

    def onto(self, spot: complex) -> complex:
        """From the plan to the sheet."""
        return self.origin + self.unit * spot

    def back(self, spot: complex) -> complex:
        """From the sheet to the plan."""
        return (spot - self.origin) / self.unit


Frames = Mapping[str, PlanFrame]


@dataclass(frozen=True)
class Number:
    """One entry of a result table: a vector's components or a single number, the unit that was written, and the
    standard deviation with which it was rounded, in that unit."""

    kind: str
    of: str
    value: tuple[float, ...]
    unit: str = ""
    rounding: float = field(default=0.0, compare=False)


class Searched(Protocol):
    """A picture of a sheet that can be asked for what is expected on it; all in mm of the sheet."""

    def near(self, one: Spot, two: Spot, within: float) -> Trace | None:
        """The line about the expected one between two spots."""

    def rim(self, centre: Spot, radius: float, spots: Sequence[Spot], within: float) -> Trace | None:
        """The arc about the expected one, near some spots of it."""

    def dot(self, spot: Spot, within: float) -> Trace | None:
        """The point about the expected one."""

    def share(self, kind: str, spots: Sequence[Spot], within: float) -> float | None:
        """The share of some spots that have a stroke, or a point, so near; None where most could not be seen."""


@dataclass(frozen=True)
class Submission:
    """A drawing as it was handed in; `shows` are the kinds of thing it could show, `frames` those that are known.

    A file of measured points shows no lines, so that none is missing there. A picture's faint lines are found where
    they are expected: its `page` is asked for them. `tips` are the sharp ends of what is filled, as heads of arrows.
    `letters` stand beside marks; which of them each names, the whole drawing tells.
    `millimetres` is what speaks for lengths being in mm, as a logarithm of odds.
    `measured` says that its marks were measured and written down, `stated` how precisely in the student's own words:
    else their blur is the least that it may be. `left_out` is what it has that is too small to be seen on paper.
    """

    name: str
    traces: tuple[Trace, ...] = ()
    numbers: tuple[Number, ...] = ()
    shows: frozenset[str] = frozenset()
    frames: Frames = field(default_factory=dict)
    page: Searched | None = None
    tips: tuple[Spot, ...] = ()
    letters: tuple[Lettering, ...] = ()
    measured: bool = False
    stated: bool = False
    left_out: tuple[str, ...] = ()
    millimetres: float = math.inf
