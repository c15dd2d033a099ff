"""Gears, friction wheels, racks, belts and chains: two links roll on each other without slipping, held apart by others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, ClassVar

from graphplan.mechanism.fields import (
    AMOUNT,
    CENTRES,
    DISTANCE,
    FLAG,
    GUIDE,
    RADII,
    TEETH,
    TWO_LINKS,
    Either,
    Field,
    Kind,
    Rows,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    Written,
    centres_on,
    choice,
)
from graphplan.mechanism.loads import Friction
from graphplan.mechanism.numbers import (
    FLOAT_RECKONING,
    Number,
    Pair,
    distinct_texts,
    dot,
    exactly,
    is_exact,
    minus,
    number_text,
    plus,
    quarter_turn,
    root,
    square_root,
    times,
)
from graphplan.mechanism.pairs.pair import ROLLING, GivenPose, KinematicPair, OnRack, Rolling, Statement
from graphplan.mechanism.tolerances import LENGTH_TOL, PLACE_TOL
from graphplan.phrases import phrase

LOADS = ("forces", "moments", "springs", "friction", "masses", "balance")
"""The tables that load a scene: pressure angles matter only with them."""


@dataclass(frozen=True)
class Grip:
    """Friction of a belt on its pulleys: it slips first on an arc of contact in radians, with tensions as S_1/S_2 =
    e^(f' alpha) (Ozols 1974, (12.4)).

    `spread` is the sine of the angle at which the strands come nearer to the line of centres, of the length `distance`,
    on the way from the first pulley to the second. A strand leaves that pulley so far from its centre, beside the way
    to the pole: `foot` along it, `aside` perpendicular to it.
    """

    friction: Friction
    arc: float
    ratio: float
    spread: float
    distance: float
    foot: float
    aside: float

    @property
    def total(self) -> float:
        """(S_1 + S_2) / (S_1 - S_2)."""
        return (self.ratio + 1) / (self.ratio - 1)

    @property
    def along(self) -> float:
        """The part of each strand's pull that runs along the line of centres."""
        return math.sqrt(1 - self.spread**2)


@dataclass(frozen=True)
class Gear(KinematicPair):
    """Two links that roll on each other: k_1 (omega_1 - omega_a) + k_2 (omega_2 - omega_a) = 0.

    omega_a is the turning of the line of `centres`, each a point of its link; `factors` are k_1 and k_2. Of outer
    gears, friction wheels and a crossed `belt` they are the numbers of teeth or the radii; a ring, which is the second,
    and the second pulley of an open belt have theirs negative. `teeth` and `radii` are as written, where they are.

    `tangent` is that of the pressure angle, by which the force between flanks leans from the circumferential one; that
    of a belt with a `grip` leans as the pull of both strands does, towards the mate.

    On a rack there is one centre: a wheel of this `radius` rolls on the pitch line along `direction`, which is fixed to
    the second link; the wheel is on the left of it. It is `alone` where its links have no other gear or contact.
    """

    letter, binds = "RR", 1
    symbol: ClassVar[str] = "gear"
    sentence = phrase("Gears: {0}.")
    wheels: tuple[str, str]
    centres: tuple[str, ...]
    factors: Pair = (1, 1)
    teeth: tuple[Fraction, ...] | None = None
    radii: tuple[Fraction, ...] | None = None
    internal: bool = False
    belt: str = ""
    radius: Number = 0
    direction: Pair | None = None
    through: tuple[str, str] | None = None
    written: Written = field(default=None, compare=False)
    alone: bool = True
    tangent: Number = 0
    grip: Grip | None = None

    @property
    def links(self) -> tuple[str, str]:
        """The two links that roll on each other."""
        return self.wheels

    @property
    def name(self) -> str:
        """The pair's name in results, such as `2 3`, or where it is not alone `2 3 at B C`."""
        return " ".join((*self.wheels, *(() if self.alone else ("at", *self.centres))))

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """State that one link rolls on the other without slipping."""
        if self.direction is not None:
            yield OnRack(*self.wheels, self.centres[0], self.direction, ROLLING, name=self.name, radius=self.radius)
        else:
            (first, second), line = self.centres, self.line(scene.points)
            yield Rolling(*self.wheels, first, second, line, self.factors, self.name)

    def line(self, points: Mapping[str, Any]) -> Any:
        """The vector from the first centre to the second."""
        return minus(points[self.centres[1]], points[self.centres[0]])

    def pitch_radii(self, points: Mapping[str, Any]) -> tuple[float, ...] | None:
        """The radii of the pitch circles; None of sprockets given by their teeth alone."""
        if self.direction is not None:
            return (float(self.radius),)
        if self.radii is not None:
            return tuple(map(float, self.radii))
        if self.belt:
            return None
        line, (k1, k2) = [*map(float, self.line(points))], map(float, self.factors)
        distance = dot((line[0], line[1]), (line[0], line[1])) ** 0.5
        return abs(distance * k1 / (k1 + k2)), abs(distance * k2 / (k1 + k2))

    def pitch_point(self, points: Mapping[str, Any]) -> Any:
        """The relative pole: on the line of centres, of a rack the foot of the centre on its pitch line.

        None of equal pulleys of an open belt, which turn alike.
        """
        centre: Any = points[self.centres[0]]
        if self.direction is not None:
            share = self.radius / square_root(dot(self.direction, self.direction))
            return plus(centre, times(-share, quarter_turn(self.direction)))
        whole = self.factors[0] + self.factors[1]
        return plus(centre, times(self.factors[0] / whole, self.line(points))) if whole else None

    def crossing(self, efficiency: Number, drives: int) -> Number:
        """The point where the line of the tooth force crosses the line of centres, as a multiple of the arm of the
        pitch point.

        The arm is from the first centre. The first wheel `drives` (1), or the second (-1); where neither does (0), it
        is midway. So the moments of one force on the two wheels make this efficiency of their turning on the arm.
        """
        if not drives:
            return (self.crossing(efficiency, 1) + self.crossing(efficiency, -1)) / 2
        if self.direction is not None:
            return 1 / efficiency if drives > 0 else efficiency
        k1, k2 = self.factors
        driven = (k1 + k2) / (k1 + efficiency * k2)
        return driven if drives > 0 else efficiency * (k1 + k2) / (efficiency * k1 + k2)

    @property
    def arm_sense(self) -> int:
        """The sense in which the first wheel turns on the arm where it turns positively on the second."""
        return 1 if self.direction is not None or self.factors[1] * (self.factors[0] + self.factors[1]) > 0 else -1

    def radial(self, held: Pair, lever: Any, line: Any) -> Pair:
        """The radial force on the first wheel that goes with a circumferential one, of this arm about its centre.

        That of flanks is off the mate, that of a belt with a grip towards it along the `line` of centres.
        """
        across = quarter_turn(held)
        if self.grip is None:
            return times(self.tangent, across)
        if self.tangent:
            along: Any = self.tangent * dot(across, line)
            towards = 2 * ((along if getattr(along, "shape", ()) else float(along)) > 0) - 1  # in many poses an array
            return times(towards * self.tangent, across)
        distance = self.grip.distance
        return times(abs(lever) * (self.grip.total / float(self.radii[0] if self.radii else 1) / distance), line)

    @property
    def strands(self) -> tuple[str, ...]:
        """The names of what the two strands of a belt pull, on the left of the line of centres and on the right.

        None where they are parallel, so that their pull does not tell the two apart.
        """
        return (f"{self.name} left", f"{self.name} right") if self.grip and self.grip.spread else ()

    def tensions(self, pull: Pair, points: Mapping[str, Any]) -> dict[str, Pair]:
        """Force in each strand for a given force on the first link, by the strand's name."""
        if not (self.grip and self.strands):
            return {}
        line = self.line(points)
        side, square = quarter_turn(line), dot(line, line)
        ahead, aside = 1 - self.grip.foot, self.grip.aside
        whole, across = (dot(pull, way) / square / 2 / share for way, share in ((line, ahead), (side, aside)))
        return {name: times(whole + sign * across, plus(times(ahead, line), times(sign * aside, side)))
                for name, sign in zip(self.strands, (-1, 1), strict=True)}

    def gripping(self, friction: Friction, places: Mapping[str, Any]) -> Gear:
        """The belt with its grip by friction; its force leans as the strands pull."""
        (r1, r2), crossed = map(float, self.radii or (0, 0)), self.belt == "crossed"
        distance = math.hypot(*map(float, self.line(places)))
        spread = (r1 + r2 if crossed else r1 - r2) / distance
        arc = math.pi + 2 * (math.asin(spread) if crossed else -math.asin(abs(spread)))
        grip = Grip(friction, arc, math.exp(float(friction.coefficient) * arc), spread, distance,
                    spread * spread, spread * math.sqrt(1 - spread * spread))
        return replace(self, grip=grip, tangent=-grip.total * grip.along / spread if spread else 0)

    def with_lengths(self, length: Callable[[Any], Any]) -> Gear:
        """Return the gear with its factors and radius in other numbers."""
        return replace(self, factors=tuple(map(length, self.factors)), radius=length(self.radius))


def _read_wheels(row: TableRow) -> Gear | None:
    """Two wheels that touch, or a ring with a wheel in it, or two pulleys."""
    row.values |= {key: row.values.get(key) for key in ("teeth", "radii")}
    belt, internal = row.values.get("belt", ""), row.values.get("internal", False)
    if not (_check_centres(row, 2) and _check_ratio(row) and _check_fit(row, belt, internal)):
        return None
    first, second = row["teeth"] or row["radii"]
    factors = (first, -second if internal or belt == "open" else second)
    return Gear(row["links"], row["centres"], factors, row["teeth"], row["radii"], internal, belt,
                tangent=row.values.get("pressure_angle", 0))


def _read_rack(row: TableRow) -> Gear | None:
    """A gear on a rack; the direction's length stays as written."""
    if not _check_centres(row, 1):
        return None
    direction, through, written = row["direction"]
    x, y = exactly(direction)
    if is_exact(direction) and not root(x * x + y * y)[1]:
        row.names.irrational.append(f"{row.item.where}: a rack along a direction of irrational length")
    return Gear(row["links"], row["centres"], radius=row["radius"], direction=direction, through=through,
                written=written, tangent=row["pressure_angle"])


def _check_centres(row: TableRow, count: int) -> bool:
    """Whether the centres are points of two different links."""
    links, centres = row["links"], row["centres"]
    if links[0] == links[1]:
        row.item.fault(f"link {links[0]} is geared with itself", "two different links")
    elif len(centres) != count:
        instead = "the centre of each link's pitch circle" if count == 2 else "the gear's centre alone: a rack has none"
        row.items["centres"].fault(f"{len(centres)} centre{'s' * (len(centres) != 1)}", instead)
    else:
        return centres_on(row, *zip(centres, links, strict=False))
    return False


def _check_ratio(row: TableRow) -> bool:
    """Whether teeth and radii, where both are given, have one ratio."""
    teeth, radii = row["teeth"], row["radii"]
    if teeth is None and radii is None:
        row.item.fault("neither teeth nor radii", "teeth = [24, 36], or radii = [48, 72]")
        return False
    if teeth and radii and abs(teeth[0] * radii[1] - teeth[1] * radii[0]) > LENGTH_TOL * teeth[0] * radii[1]:
        row.items["radii"].fault("the radii {} and {} are not as the teeth {} and {}".format(
            *map(number_text, (*radii, *teeth))), "radii in the ratio of the teeth, or teeth alone")
        return False
    return True


def _check_fit(row: TableRow, belt: str, internal: bool) -> bool:
    """Whether wheels of these sizes fit between their centres."""
    if any(point not in row.names.places for point in row["centres"]):
        return True  # the point has its own fault
    misfit = _misfit(row, belt, internal)
    if misfit is not None:
        key, *fault = misfit
        row.items[key].fault(*fault)
    return misfit is None


def _misfit(row: TableRow, belt: str, internal: bool) -> tuple[str, str, str] | None:
    """The fault in the distance between the centres of two wheels, its key, and the remedy; None if the wheels fit."""
    (r1, r2), key = row["radii"] or row["teeth"], "radii" if row["radii"] else "teeth"
    ends, of = [row.names.places[point] for point in row["centres"]], " and ".join(row["centres"])
    apart = minus(*map(exactly, ends))
    distance, _ = root(Fraction(dot(apart, apart)))
    distance_text = f"the distance {number_text(float(distance))} of the centres {of}"
    if not distance:
        return "centres", f"the centres {of} coincide", "centres that lie apart"
    if internal and r1 >= r2:
        sizes = f"{number_text(r1)} and {number_text(r2)}"
        return key, f"the ring, which is the second, is no larger than the gear in it: {sizes}", "a ring that is larger"
    if belt:
        least, limit = (r1 + r2, "r_1 + r_2") if belt == "crossed" else (abs(r1 - r2), "the difference of the radii")
        limit = f"{distance_text} is no more than {limit} = {number_text(least)}: the belt cannot be laid"
        return (key, limit, "centres further apart") if key == "radii" and distance <= least else None
    whole, limit = (r2 - r1, "difference") if internal else (r1 + r2, "sum")
    slack = LENGTH_TOL * max(r1 + r2,
                             distance) + PLACE_TOL * max(abs(coordinate) for end in ends for coordinate in exactly(end))
    if key == "teeth" or abs(distance - whole) <= slack:
        return None
    far, near = distinct_texts(distance, whole)
    return (key, f"the distance {far} of the centres {of} is not the {limit} {near} of the radii",
            f"radii whose {limit} is the distance, or teeth")


def _pressure(item: SceneItem, names: SceneNames) -> Number | None:
    """The tangent of an angle in degrees, which is irrational."""
    degrees = item.number()
    if degrees is None or not 0 <= degrees < 90:
        return None if degrees is None else item.fault(f"the pressure angle {number_text(degrees)}",
                                                       "an angle from 0 to less than 90 degrees")
    cosine, sine, exact = FLOAT_RECKONING.heading(degrees)
    if not exact and not names.tables.keys().isdisjoint(LOADS):
        names.irrational.append(f"{item.where}: pressure angle")
    return sine if exact else float(sine / cosine)


_DEGREES = Kind("degrees", _pressure, {"type": "number", "minimum": 0, "exclusiveMaximum": 90})
_TANGENT = Table("its tangent", (Field("tangent", "its tangent", AMOUNT, "the tangent, such as { tangent = 0.364 }"),),
                 lambda row: row["tangent"])
_PRESSURE = Field("pressure_angle", "the angle in degrees by which the flanks are inclined, or its tangent; 0 for "
                  "friction wheels",
                  Either((_DEGREES, _TANGENT), lambda item: _TANGENT if isinstance(item.value, dict) else _DEGREES),
                  default=20)
_WHEELS = (
    Field("links", "the two links", TWO_LINKS, 'the two links, such as links = ["2", "3"]'),
    Field("centres", "the centre of each pitch circle: a point of that link", CENTRES,
          'the centre of each pitch circle, such as centres = ["B", "C"]'),
    Field("teeth", "the numbers of teeth", TEETH),
    Field("radii", "the radii of the pitch circles; of two gears their sum is the distance of the centres, of a ring "
          "their difference", RADII),
)
FIELD = Field("gears", "two links that roll on each other without slipping: gears, friction wheels, racks, belts",
              Rows(Either((Table("a pair of gears", (
    *_WHEELS,
    Field("internal", "whether the second is a ring and the first runs inside it", FLAG, default=False),
    _PRESSURE,
), _read_wheels), Table("a belt or chain", (
    *_WHEELS,
    Field("belt", "open: the pulleys turn the same way; crossed: opposite ways", choice("open", "crossed")),
), _read_wheels), Table("a gear on a rack", (
    Field("links", "the gear and the rack", TWO_LINKS, 'the gear and the rack, such as links = ["2", "4"]'),
    Field("centres", "the gear's centre, a point of it", CENTRES, 'the gear\'s centre, such as centres = ["B"]'),
    Field("radius", "the radius of the pitch circle", DISTANCE, "the gear's radius, such as radius = 30"),
    Field("direction", "the direction of the pitch line, with the gear on its left: a vector, an angle in degrees, or "
          "two points", GUIDE, "the direction of the pitch line, such as direction = [1, 0]"),
    _PRESSURE,
), _read_rack))), remedy="one about two centres", once=lambda gear: (
    (frozenset(gear.links), frozenset(gear.centres)), "gear between links {} and {}".format(*gear.links))))
