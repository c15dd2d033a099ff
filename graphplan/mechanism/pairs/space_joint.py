"""Joints in space, drawn in the plane: each as the plane linkage that moves as its projection does.

A Cardan joint is seen along shaft 1. The end A of the other fork's arm runs on a circle that is seen as an ellipse of
the semi-axes r, along the trace of the two circles' planes, and r cos delta; turned down about the trace it is on the
circle itself, A_2, and tan phi_1 = cos delta tan phi_2. The ellipse is drawn by a trammel: shaft 2, turned down with
its circle, carries M, at r (1 + cos delta)/2 on OA_2, about which the cross turns backwards as fast, as a wheel does
that rolls in a ring of twice its size. A block on the cross at A slides along the arm that shaft 1 has in this view.

A swash plate moves a piston, at the distance R from the shaft, by R tan alpha cos phi: as a crank of this length moves
a yoke. Of a swinging fork, whose shaft is perpendicular to the first, tan theta = tan alpha cos phi: seen from the
side, at the distance R from its pivot, the point F of such a yoke leads a block on it.

Source: Ozols (1974), 7-4, fig. 7-20, (7.10); 8-3, figs. 8-7 and 8-8, (8.23).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from fractions import Fraction

from graphplan.mechanism.fields import (
    AMOUNT,
    DISTANCE,
    GUIDE,
    NAME,
    POINT,
    TWO_LINKS,
    Either,
    Field,
    Kind,
    Rows,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
)
from graphplan.mechanism.model import Placement
from graphplan.mechanism.numbers import Number, dot, is_exact, minus, quarter_turn, root
from graphplan.mechanism.pairs.gear import Gear
from graphplan.mechanism.pairs.pair import FRAME, KinematicPair
from graphplan.mechanism.pairs.sliding import Slide
from graphplan.mechanism.placements import TURNED_DOWN, put

PlacedPoints = dict[str, Placement]
"""The points that a joint adds to the scene, and how they are placed."""
RIGHT = 90  # degrees


def _cardan(row: TableRow) -> PlacedPoints | None:
    """Trammel and block; the circle's radius is what the arm's end in its place makes it."""
    shaft, other = row["links"]
    cross, centre, arm = row["cross"], row["centre"], row["arm"]
    block, middle = f"{cross}'", f"M{cross}"
    if not _fits(row, (cross, block), middle, (shaft, other)):
        return None
    cosine = row["angle"]
    O, A = (row.names.places[point] for point in (centre, arm))
    M = _place(row, middle, _share_of_arm(row, cosine, (1 + cosine) / 2))
    radius = math.dist(*(map(float, point) for point in (row.names.places[middle], O)))
    ring = Gear((cross, FRAME), (middle, centre), (Fraction(1), Fraction(-2)),
                radii=(Fraction(radius), Fraction(2 * radius)), internal=True)
    _take(row, {other: (middle,), cross: (middle, arm), block: (arm,)}, ring, Slide(block, shaft, arm, minus(A, O)))
    return {middle: M}


def _swash_plate(row: TableRow) -> PlacedPoints | None:
    """A crank of the length R tan alpha in the direction of the arm, and a block in the yoke."""
    (shaft, piston), block, pin = row["links"], row["block"], f"P{row['block']}"
    if not _fits(row, (block,), pin, (shaft,)):
        return None
    P = _crank(row, pin, row["radius"])
    _take(row, {shaft: (pin, row["arm"]), block: (pin,)}, Slide(block, piston, pin, quarter_turn(row["trace"][0])))
    return {pin: P}


def _swinging_fork(row: TableRow) -> PlacedPoints | None:
    """Place the points of a crank with a yoke, whose point F leads a block on the fork."""
    (shaft, fork), block, names = row["links"], row["block"], row.names
    pin, led, yoke, on_fork = f"P{block}", f"F{block}", f"{block}'", f"{block}''"
    pivot, centre = row["pivot"], row["centre"]
    if not _fits(row, (block, yoke, on_fork), pin, (shaft,)):
        return None
    if led in names.points:
        return row.item.fault(f"there is a point {led} already", "another name for that point")
    unpivoted = [link for link in (fork, FRAME) if pivot not in names.links.get(link, ())]
    if unpivoted or names.places.get(pivot) is None:
        return row.items["pivot"].fault(f"{pivot} is not a point of link {(*unpivoted, fork)[0]}",
                                        "where the fork is pivoted on the frame")
    if names.places[pivot] == names.places[centre]:
        return row.items["pivot"].fault("it is the centre", "a point apart from the centre, to the side of the yoke")
    away = minus(names.places[centre], names.places[pivot])
    far, rational = root(Fraction(dot(away, away)))
    if not rational or not is_exact(away):
        names.irrational.append(f"{row.item.where}.pivot: a distance of irrational length")
    trace = quarter_turn(away)
    P = _crank(row, pin, far if rational else float(far))
    flat = _place(row, led, {"from": f"{centre} {pin}", "trace": trace, "cosine": Fraction(1), "share": Fraction(1),
                             "flat": True})
    _take(row, {shaft: (pin, row["arm"]), block: (pin,), yoke: (led,), on_fork: (led,)}, Slide(block, yoke, pin, away),
          Slide(yoke, FRAME, led, trace), Slide(on_fork, fork, led, minus(names.places[led], names.places[pivot])))
    return {pin: P, led: flat}


def _crank(row: TableRow, pin: str, radius: Number) -> Placement:
    """Take the pin of a crank of the length R tan alpha in the direction of the arm into the scene."""
    way = minus(row.names.places[row["arm"]], row.names.places[row["centre"]])
    long, rational = root(Fraction(dot(way, way)))
    if not rational or not is_exact(way):
        row.names.irrational.append(f"{row.item.where}.arm: an arm of irrational length")
    share = radius * row["angle"] / (long if rational else float(long))
    return _place(row, pin, _share_of_arm(row, Fraction(1), share))


def _share_of_arm(row: TableRow, cosine: Number, share: Number) -> dict[str, object]:
    """A share of the arm turned down about the trace."""
    trace = row.values.get("trace") or ((1, 0), None)
    return {"from": f"{row['centre']} {row['arm']}", "trace": trace[0], "cosine": cosine, "share": share}


def _place(row: TableRow, point: str, data: dict[str, object]) -> Placement:
    """Take a new point into the scene that is being read."""
    placement = Placement(TURNED_DOWN, data)
    row.names.points = (*row.names.points, point)
    row.names.places |= {point: put(placement, row.names.places)}
    return placement


def _take(row: TableRow, links: dict[str, tuple[str, ...]], *pairs: KinematicPair) -> None:
    """Take in points of links, new ones among them, and pairs."""
    before = row.names.links
    row.names.take_links(before | {link: tuple(dict.fromkeys((*before.get(link, ()), *points)))
                                   for link, points in links.items()})
    row.names.pairs = (*row.names.pairs, *pairs)


def _fits(row: TableRow, links: tuple[str, ...], point: str, shafts: tuple[str, ...]) -> bool:
    """Whether new links and a new point have names of their own, the shafts are pivoted on the frame at the centre, and
    the arm ends apart from it, on no other link."""
    names, centre, arm = row.names, row["centre"], row["arm"]
    places = [names.places.get(end) for end in (centre, arm)]
    unpivoted = [link for link in (*shafts, FRAME) if centre not in names.links.get(link, ())]
    if taken := [link for link in links if link in names.links]:
        row.item.fault(f"there is a link {taken[0]} already", "a name that no link has")
    elif point in names.points:
        row.item.fault(f"there is a point {point} already", "another name for that point")
    elif len({*row["links"], FRAME}) < 3:
        row.items["links"].fault("they are not two moving links", "a shaft, and what it moves")
    elif unpivoted:
        row.items["centre"].fault(f"{centre} is not a point of link {unpivoted[0]}", "where the shafts are pivoted "
                                  "on the frame")
    elif any(arm in points for link, points in names.links.items() if (link,) != shafts):
        row.items["arm"].fault(f"a link has the point {arm} already", "a point that no link in [links] has")
    elif "trace" in row.values and not {*(row["trace"][1] or ())} <= {*names.links[FRAME]}:
        row.items["trace"].fault("its points are not all on the frame", "a direction that stands, such as [1, 0]")
    elif None in places:
        row.item.fault("its centre or its arm has no place yet", "points with coordinates")
    elif places[0] == places[1]:
        row.items["arm"].fault("the arm ends in the centre", "a point apart from the centre")
    else:
        return True
    return False


def _angle(says: str, name: str, ratio: Callable[[float], float], most: float) -> Field:
    """An angle in degrees, read as its cosine or tangent, or this as it is written."""
    def acute(item: SceneItem, value: Number | None, below: float) -> Number | None:
        if value is None or 0 < value < below:
            return value
        return item.fault("no angle of a joint", f"more than 0 and less than {RIGHT} degrees")

    def read(item: SceneItem, names: SceneNames) -> float | None:
        degrees = acute(item, item.number(), RIGHT)
        if degrees is None:
            return None
        names.irrational.append(f"{item.where}: an angle in degrees")
        return ratio(math.radians(degrees))

    by_degrees = Kind("degrees", read, {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": RIGHT})
    by_ratio = Table(f"its {name}", (Field(name, f"its {name}", AMOUNT, f"such as {{ {name} = 0.8 }}"),),
                     lambda row: acute(row.items[name], row[name], most))
    return Field("angle", f"{says}, in degrees, or its {name}",
                 Either((by_degrees, by_ratio), lambda item: by_ratio if isinstance(item.value, dict) else by_degrees),
                 f"such as angle = 30, or angle = {{ {name} = 0.8 }}")


def _new_link(item: SceneItem, names: SceneNames) -> str | None:
    name = item.text("a name", 'the name of a link, such as cross = "3"')
    if name is not None and not re.fullmatch(NAME, name):
        return item.fault("a link's name is empty or has blanks or commas", "a name without them, such as 3")
    return name


_NEW_LINK = Kind("name", _new_link, {"type": "string", "pattern": f"^{NAME}$"})
_CENTRE = Field("centre", "where the shafts' axes stand, in the view along the first", POINT, 'such as centre = "O"')
JOINTS = Rows(Either((Table("a Cardan joint", (
    Field("links", "the shaft along which it is seen, and the other", TWO_LINKS, 'such as links = ["1", "2"]'),
    Field("cross", "the name of its cross, a link of the scene's that is not in [links]", _NEW_LINK,
          'such as cross = "3"'),
    _CENTRE,
    Field("arm", "the end of the other fork's arm, as it is seen", POINT, 'such as arm = "A"'),
    _angle("between the shafts", "cosine", math.cos, 1),
    Field("trace", "the line in which the planes of the two circles meet", GUIDE, default=[1, 0]),
), _cardan), Table("a swash plate", (
    Field("links", "the shaft, and the piston that it moves", TWO_LINKS, 'such as links = ["1", "2"]'),
    Field("block", "the name of a block between the two, which is not in [links]", _NEW_LINK, 'such as block = "3"'),
    _CENTRE,
    Field("arm", "where the plate leans to, seen from the centre along the shaft", POINT, 'such as arm = "A"'),
    _angle("of the plate's axis with the shaft", "tangent", math.tan, math.inf),
    Field("radius", "the distance of the piston from the shaft", DISTANCE, "such as radius = 60"),
    Field("trace", "the direction in which the piston slides", GUIDE, default=[1, 0]),
), _swash_plate), Table("a swinging fork", (
    Field("links", "the shaft, and the fork, whose shaft is perpendicular to it", TWO_LINKS,
          'such as links = ["1", "2"]'),
    Field("block", "the name of a block between the two, which is not in [links]", _NEW_LINK, 'such as block = "3"'),
    _CENTRE,
    Field("arm", "where the axis of the fork's bearing leans to, seen from the centre along the shaft", POINT,
          'such as arm = "A"'),
    _angle("of that axis with the shaft", "tangent", math.tan, math.inf),
    Field("pivot", "where the fork is pivoted on the frame, in the view from the side", POINT, 'such as pivot = "Q"'),
), _swinging_fork))))
