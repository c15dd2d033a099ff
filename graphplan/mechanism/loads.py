"""Loads: masses, forces, moments, balances and friction; of those that change over the cycle their tables.

A table is straight between its rows. It is over the travel of the first drive from the given pose (degrees, or lengths
where it slides), over the position of a slide, once around, the outward stroke's rows first, or over a speed. Two rows
at one place are a jump. At a jump, and at the end of a stroke, the load is that into which the motion goes on.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from graphplan.mechanism.fields import Written
from graphplan.mechanism.numbers import Number, Pair
from graphplan.mechanism.pairs.pair import FRAME, Along, GivenPose, Statement, Turning
from graphplan.mechanism.tolerances import TABLE_END_TOL
from graphplan.phrases import said

EDGES_OF_A_POSE = said("of a slide that bears on a length it is known in one pose alone whether both edges press")
TRAVEL, SPEED, SPEED_OF, STROKE_OF = "travel", "speed", "speed of ", "stroke of "
FORWARD, RETURN, BOTH = "forward", "return", "both"
HOLD, ZERO = "hold", "zero"

Rows = tuple[tuple[Number, Number], ...]


@dataclass(frozen=True)
class LoadTable:
    """A load by its place: `over` is "travel", a slide such as "3 along frame", "speed" or "speed of 3 along frame".

    `rows` are places and values; over a speed v there may be `powers` c_0, c_1, c_2 in their stead: the load is
    c_0 + c_1 v + c_2 v |v|. A table over travel repeats after its `period`, if it has one: whole turns of the drive.
    Travel and speed of the drive count in the sense in which it moves, those of a slide along its guide's direction.
    `where` is where the scene has it.
    Of a spring the place is the distance of the two points of its `span`. Outside its rows the load is that of the
    nearest end, or where `beyond` is "zero" none. A table over a stroke, such as "stroke of 3 along frame", acts
    `during` one of its ways or both; it is laid out over the slide's position in its two `ways`, and `written` is
    what it was over and its rows.
    Places are in the scene's lengths and degrees, speeds in rad/s and lengths/s.
    """

    over: str
    rows: Rows = ()
    powers: tuple[Number, ...] = ()
    period: Number = 0
    where: str = field(default="", compare=False)
    span: tuple[str, str] | None = None
    beyond: str = HOLD
    during: str = ""
    ways: tuple[Rows, ...] = ()
    written: tuple[str, Rows] | None = None

    @property
    def slide(self) -> str:
        """Name of the slide whose position or speed the table is over; empty for the drive's."""
        name = self.over.removeprefix(SPEED_OF).removeprefix(STROKE_OF)
        return "" if name in (TRAVEL, SPEED) or self.span else name

    @property
    def over_speed(self) -> bool:
        """Whether it is over a speed."""
        return self.over == SPEED or self.over.startswith(SPEED_OF)

    @property
    def over_position(self) -> bool:
        """Whether it is over a slide's position, so that its two strokes differ."""
        return bool(self.slide) and not self.over_speed and not self.over.startswith(STROKE_OF)

    @property
    def strokes(self) -> dict[int, Rows]:
        """The rows by the sense in which the place changes, 1 or -1, each in the order of the motion; with a jump to
        zero at both ends if the load is zero beyond."""
        return {sense: ((rows[0][0], Fraction(0)), *rows, (rows[-1][0], Fraction(0))) if self.beyond == ZERO else rows
                for sense, rows in self._given_strokes.items()}

    def lay_out(self, low: Number, high: Number) -> LoadTable:
        """A table over a stroke between these end positions as one over the slide's position: forward, and back."""
        rows = tuple((low + share * (high - low), value) for share, value in self.rows)
        idle = (rows[0][0], Fraction(0)), (rows[-1][0], Fraction(0))
        forth, back = idle if self.during == RETURN else rows, idle if self.during == FORWARD else rows
        return replace(self, over=self.slide, rows=rows, ways=(forth, back[::-1]), written=(self.over, self.rows))

    @property
    def _given_strokes(self) -> dict[int, Rows]:
        if self.ways:
            return dict(zip((1, -1), self.ways, strict=True))
        if not self.over_position:
            return {1: self.rows, -1: self.rows[::-1]}
        places = [place for place, _ in self.rows]
        sense = 1 if next(p for p in places if p != places[0]) > places[0] else -1
        turn = max(range(len(places)), key=lambda i: (sense * places[i], -i))
        back = next(i for i in reversed(range(len(places))) if places[i] == places[turn])
        return {sense: self.rows[: turn + 1], -sense: self.rows[back:]}

    @property
    def corners(self) -> tuple[Number, ...]:
        """The places between which it is straight."""
        return tuple(dict.fromkeys(place for place, _ in self.rows))

    @property
    def numbers(self) -> tuple[Number, ...]:
        """All numbers of its rows, or its powers."""
        return self.powers or tuple(number for row in self.rows for number in row)

    @property
    def length(self) -> Number:
        """From its lowest place to its highest."""
        return max(self.corners) - min(self.corners)

    @property
    def _floats(self) -> dict[int, Any]:
        """The rows by the sense as arrays of floats, shape (k, 2)."""
        import numpy as np

        return {sense: np.array(rows, float) for sense, rows in self.strokes.items()}

    def times(self, factor: Number) -> LoadTable:
        """Return the table with its loads multiplied by a factor."""
        rows, *ways = (tuple((place, value * factor) for place, value in rows) for rows in (self.rows, *self.ways))
        return replace(self, rows=rows, ways=tuple(ways), powers=tuple(power * factor for power in self.powers))

    def value(self, place: Number, sense: int = 1, after: bool = True) -> Number:
        """The load at a place that changes in this sense, 1 or -1; at a jump that after it, or before it."""
        if self.powers:
            square = place * place if place > 0 else -place * place
            return sum((c * v for c, v in zip(self.powers, (Fraction(1), place, square), strict=False)), Fraction(0))
        place, rows = self._wrap_to_period(place, after), self.strokes[sense]
        places, slack = [sense * p for p, _ in rows], self.length * TABLE_END_TOL
        at = sense * place
        index = bisect_right(places, at + slack) if after else bisect_left(places, at - slack)
        if index in (0, len(rows)):
            return rows[min(index, len(rows) - 1)][1]
        (p, lower), (q, upper) = rows[index - 1 : index + 1]
        share = min(max((place - p) / (q - p), 0 * place), 0 * place + 1)
        return lower + share * (upper - lower)

    def level(self, place: Number, sense: int) -> bool:
        """Whether the load is the same all about a place, so that rounding of the place does not change it."""
        near = 1000 * self.length * TABLE_END_TOL
        ends = (min(max(place + k * near, min(self.corners)), max(self.corners)) for k in (-1, 1))
        return len({self.value(end, sense) for end in (*ends, place)}) == 1

    def values_at(self, places: Any, senses: Any = 1, after: bool = True) -> Any:
        """Loads at many places, an array of shape (n,) of floats; `senses` is 1 or -1, or an array of them.

        Places that are nan have no load.
        """
        import numpy as np

        places = np.asarray(places, float)
        if self.powers:
            terms = 1.0 + 0 * places, places, places * np.abs(places)
            return sum(float(c) * v for c, v in zip(self.powers, terms, strict=False))
        home, senses = self._wrap_to_period(places, after), np.broadcast_to(np.asarray(senses, float), places.shape)
        values = np.full(places.shape, np.nan)
        for sense in self.strokes:
            on_stroke = (senses * sense > 0) & np.isfinite(home)
            values[on_stroke] = self._values_of_stroke(home[on_stroke], sense, after)
        return values

    def _values_of_stroke(self, places: Any, sense: int, after: bool) -> Any:
        """The loads at places that change in one sense."""
        import numpy as np

        rows = self._floats[sense]
        marks, at, slack = sense * rows[:, 0], sense * places, float(self.length * TABLE_END_TOL)
        index = np.searchsorted(marks, at + slack, "right") if after else np.searchsorted(marks, at - slack, "left")
        lower, upper = np.clip(index - 1, 0, len(rows) - 1), np.clip(index, 0, len(rows) - 1)
        apart = marks[upper] - marks[lower]
        share = np.clip((at - marks[lower]) / np.where(apart > 0, apart, 1.0), 0.0, 1.0)
        value = rows[lower, 1] + share * (rows[upper, 1] - rows[lower, 1])
        return np.where(index == 0, rows[0, 1], np.where(index == len(rows), rows[-1, 1], value))

    def _wrap_to_period(self, places: Any, after: bool) -> Any:
        """Move places into the first period of a table of whole turns: its end counts as its beginning; for the load
        before a jump (`after` false) its beginning counts as its end."""
        if not self.period:
            return places
        (first, _), period = self.rows[0], self.period
        if not isinstance(places, Fraction):
            first, period = float(first), float(period)
        slack = period * (TABLE_END_TOL if isinstance(places, Fraction) else float(TABLE_END_TOL))
        turns = (places - first + slack) // period if after else -((first - places + slack) // period) - 1
        return places - turns * period


@dataclass(frozen=True)
class Mass:
    """A link's mass, its inertia about the centre of mass (mass * m^2), and that centre, a point of the link."""

    mass: Number
    inertia: Number
    centre: str


@dataclass(frozen=True)
class Force:
    """A given force on a link, at a point of it: `value` in this pose.

    One that changes over the cycle has a `table` of its values along `direction`, of any length, which is fixed in the
    plane, or turns with the two points that it goes `through`.
    """

    on: str
    at: str
    value: Pair
    table: LoadTable | None = None
    direction: Pair | None = None
    through: tuple[str, str] | None = None


@dataclass(frozen=True)
class Moment:
    """A given couple on a link, in force * m, counter-clockwise positive: `value` in this pose, and the `table` of one
    that changes over the cycle."""

    on: str
    value: Number
    table: LoadTable | None = None


@dataclass(frozen=True)
class Balance:
    """The unknown that keeps the prescribed motion: a moment on `link`, or a force at its point `at` along `direction`.

    The direction has any length, and is written as a slide's is; only where there is none it is a moment. It acts from
    the frame, or from the link `on`, which has its counterpart.
    """

    link: str
    at: str = ""
    direction: Pair | None = None
    written: Written = field(default=None, compare=False)
    on: str = FRAME

    def __hash__(self) -> int:
        return hash((self.link, self.at, self.on))  # fractions take long

    @property
    def links(self) -> tuple[str, str]:
        """The link on which it acts, and the one from which it does."""
        return self.link, self.on

    @property
    def spellings(self) -> tuple[str, str, str]:
        """Names of a balance, each longer than the one before: by its link, by a force's point, and by its direction,
        too."""
        if self.direction is None:
            return self.link, self.link, self.link
        dx, dy = map(float, self.direction)
        return self.link, f"{self.link} at {self.at}", f"{self.link} at {self.at} along ({dx:g}, {dy:g})"

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """Yield the motion that would be zero if the balance were a support: a turning, or a motion along its
        direction."""
        if self.direction is None:
            yield Turning(self.link, self.on)
        else:
            yield Along(self.link, self.on, self.at, self.direction, "held")


@dataclass(frozen=True)
class Wedge:
    """A guide in the form of a V of so many degrees, with the `coefficient` of its flanks."""

    degrees: Number
    coefficient: Number


@dataclass(frozen=True)
class Friction:
    """Friction in a pair, with its coefficient: a journal `at` a joint, with its radius, a slide (link, along), or a
    contact of two links. That of a slide in a `wedge` is the reduced one (Ozols 1974, (12.11)); that of a `gear` is
    the share of the power that its teeth lose, and that of a contact that is `rolling` the arm of the normal force. A
    slide that bears on a `length` about its point is pressed at both edges where its reaction lies beyond these."""

    at: str
    slide: tuple[str, str] | None
    radius: Number
    coefficient: Number
    contact: tuple[str, str] | None = None
    wedge: Wedge | None = None
    gear: tuple[str, str] | None = None
    rolling: bool = False
    length: Number = 0

    @property
    def links(self) -> tuple[str, ...]:
        """The links of a slide, a contact or a gear."""
        return self.slide or self.contact or self.gear or ()


@dataclass(frozen=True)
class Screw:
    """A screw in a slide that moves the first link along the second: the lead of a turn, the mean radius of its thread
    and the friction there; for an angular thread the reduced friction (Ozols 1974, (12.28))."""

    links: tuple[str, str]
    lead: Number
    radius: Number
    coefficient: Number
    thread: Wedge | None = None

    @property
    def slope(self) -> Fraction:
        """The tangent of the lead angle, as a float has it."""
        return Fraction(float(self.lead) / (2 * math.pi * float(self.radius)))

    def circumferential(self, sense: int) -> Number:
        """The force around the axis by that along it: tan(alpha + phi) where it drives (1), tan(alpha - phi) where the
        load does (-1), and without friction (0) tan alpha (Ozols 1974, (12.25) and (12.26))."""
        f = sense * self.coefficient
        return (self.slope + f) / (1 - self.slope * f)


@dataclass(frozen=True)
class Loads:
    """Forces, moments, masses and losses that act on the links: gravity in m/s^2, all else in the scene's units.

    `resting` are the names of the pairs that are known to stand still: nothing rubs in them. `pressed` are the slides,
    by name, that are known to be pressed at both edges, with 1 where the friction angles there meet on the left of the
    guide, or -1; None where that is not known.
    """

    gravity: Pair
    masses: dict[str, Mass]
    forces: tuple[Force, ...]
    moments: tuple[Moment, ...]
    balances: tuple[Balance, ...]
    frictions: tuple[Friction, ...] = ()
    resting: frozenset[str] = frozenset()
    screws: tuple[Screw, ...] = ()
    pressed: Mapping[str, int] | None = None

    @property
    def bear_on_lengths(self) -> bool:
        """Whether it hangs on the pose at which edges some slide is pressed."""
        return any(friction.length and friction.coefficient for friction in self.frictions)

    def screw_of(self, balance: Balance) -> Screw | None:
        """The screw through which a balance acts, if it does so through one."""
        return next((screw for screw in self.screws if balance.at and {*screw.links} == {*balance.links}), None)

    @property
    def named_balances(self) -> dict[str, Balance]:
        """The balances by name: that of the link, where several act on it with the point and the direction."""
        counts = Counter(name for balance in self.balances for name in dict.fromkeys(balance.spellings))
        return {next((name for name in balance.spellings if counts[name] == 1), balance.spellings[-1]): balance
                for balance in self.balances}
