"""Joints in space, drawn in the plane: each as the plane linkage that moves as its projection does.

A Cardan joint is seen along shaft 1. The end A of the other fork's arm runs on a circle that is seen as an ellipse of
the semi-axes r, along the trace of the two circles' planes, and r cos delta; turned down about the trace it is on the
circle itself, A_2, and tan phi_1 = cos delta tan phi_2. The ellipse is drawn by a trammel: shaft 2, turned down with
its circle, carries M, at r (1 + cos delta)/2 on OA_2, about which the cross turns backwards as fast, as a wheel does
that rolls in a ring of twice its size. A block on the cross at A slides along the arm that shaft 1 has in this view.

A swash plate moves a piston, at the distance R from the shaft, by R tan alpha cos phi: as a crank of this length moves
a yoke.

Source: Ozols (1974), 7-4, fig. 7-20, (7.10); 8-3, fig. 8-7, (8.23).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import NamedTuple

from graphplan.mechanism.fields import Either, Field, Kind, Rows, SceneNames, Table, TableRow
from graphplan.mechanism.items import SceneItem
from graphplan.mechanism.model import Placement
from graphplan.mechanism.numbers import Number, dot, is_exact, minus, quarter_turn, root
from graphplan.mechanism.pairs.gear import Gear
from graphplan.mechanism.pairs.pair import FRAME, KinematicPair
from graphplan.mechanism.pairs.sliding import Slide
from graphplan.mechanism.placements import TURNED_DOWN, put
from graphplan.mechanism.values import AMOUNT, DISTANCE, GUIDE, NAME, POINT, TWO_LINKS


class PlaneLinkage(NamedTuple):
    """What a joint adds to the scene: a point, links with their points, new ones among them, and pairs."""

    point: str
    placement: Placement
    links: dict[str, tuple[str, ...]]
    pairs: tuple[KinematicPair, ...]


def take_linkages(names: SceneNames, linkages: tuple[PlaneLinkage, ...]) -> dict[str, Placement]:
    """Add to a scene that is being read what stands for its joints in space; where its new points are placed."""
    for point, placement, links, pairs in linkages:
        names.points = (*names.points, point)
        names.places |= {point: put(placement, names.places)}
        names.take_links(names.links | {link: tuple(dict.fromkeys((*names.links.get(link, ()), *more)))
                                        for link, more in links.items()})
        names.pairs = (*names.pairs, *pairs)
    return {linkage.point: linkage.placement for linkage in linkages}


def _cardan(row: TableRow) -> PlaneLinkage | None:
    """Trammel and block; the circle's radius is what the arm's end in its place makes it."""
    shaft, other = row["links"]
    cross, centre, arm = row["cross"], row["centre"], row["arm"]
    block, middle = f"{cross}'", f"M{cross}"
    cosine = row["angle"]
    if not 0 < cosine < 1:
        return row.items["angle"].fault("no angle between the shafts", "a cosine between 0 and 1")
    if not _are_new(row, (cross, block), middle) or not _stand_apart(row):
        return None
    O, A = (row.names.places[point] for point in (centre, arm))
    placement = _placement(row, cosine, (1 + cosine) / 2)
    radius = math.dist(*(map(float, point) for point in (put(placement, row.names.places), O)))
    ring = Gear((cross, FRAME), (middle, centre), (Fraction(1), Fraction(-2)),
                radii=(Fraction(radius), Fraction(2 * radius)), internal=True)
    return PlaneLinkage(middle, placement, {other: (middle,), cross: (middle, arm), block: (arm,)},
                        (ring, Slide(block, shaft, arm, minus(A, O))))


def _swash_plate(row: TableRow) -> PlaneLinkage | None:
    """A crank of the length R tan alpha in the direction of the arm, and a block in the yoke."""
    (shaft, piston), block, pin = row["links"], row["block"], f"P{row['block']}"
    if not _are_new(row, (block,), pin) or not _stand_apart(row):
        return None
    way = minus(row.names.places[row["arm"]], row.names.places[row["centre"]])
    long, rational = root(Fraction(dot(way, way)))
    if not rational or not is_exact(way):
        row.names.irrational.append(f"{row.item.where}.arm: an arm of irrational length")
    share = row["radius"] * row["angle"] / (long if rational else float(long))
    return PlaneLinkage(pin, _placement(row, Fraction(1), share), {shaft: (pin, row["arm"]), block: (pin,)},
                        (Slide(block, piston, pin, quarter_turn(row["trace"][0])),))


def _placement(row: TableRow, cosine: Number, share: Number) -> Placement:
    """The arm turned down about the trace, and the share of it that is a crank."""
    return Placement(TURNED_DOWN, {"from": f"{row['centre']} {row['arm']}", "trace": row["trace"][0], "cosine": cosine,
                                   "share": share})


def _are_new(row: TableRow, links: tuple[str, ...], point: str) -> bool:
    """Whether the scene has no links and no point of these names yet."""
    for name in links:
        if name in row.names.links:
            return bool(row.item.fault(f"there is a link {name} already", "a name that no link has"))
    if point in row.names.points:
        return bool(row.item.fault(f"there is a point {point} already", "another name for that point"))
    return True


def _stand_apart(row: TableRow) -> bool:
    """Whether centre and arm have places, and different ones."""
    places = [row.names.places.get(row[key]) for key in ("centre", "arm")]
    if None in places:
        return bool(row.item.fault("its centre or its arm has no place yet", "points with coordinates"))
    if places[0] == places[1]:
        return bool(row.items["arm"].fault("the arm ends in the centre", "a point apart from the centre"))
    return True


def _angle(says: str, name: str, ratio: Callable[[float], float]) -> Field:
    """An angle in degrees, read as its cosine or tangent, or this as it is written."""
    def read(item: SceneItem, names: SceneNames) -> float | None:
        degrees = item.number()
        if degrees is None or not 0 < degrees < RIGHT:
            return item.fault("no angle of a joint", "more than 0 and less than 90 degrees")
        names.irrational.append(f"{item.where}: an angle in degrees")
        return ratio(math.radians(degrees))

    by_degrees = Kind("degrees", read, {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": RIGHT})
    by_ratio = Table(f"its {name}", (Field(name, f"its {name}", AMOUNT, f"such as {{ {name} = 0.8 }}"),),
                     lambda row: row[name])
    return Field("angle", f"{says}, in degrees, or its {name}",
                 Either((by_degrees, by_ratio), lambda item: by_ratio if isinstance(item.value, dict) else by_degrees),
                 f"such as angle = 30, or angle = {{ {name} = 0.8 }}")


RIGHT = 90
_NEW_LINK = Kind("name", lambda item, names: item.text("a name", "the name of a link, such as cross = \"3\""),
                 {"type": "string", "pattern": f"^{NAME}$"})
_CENTRE = Field("centre", "where the shafts' axes stand, in the view along the first", POINT, 'such as centre = "O"')
JOINTS = Rows(Either((Table("a Cardan joint", (
    Field("links", "the shaft along which it is seen, and the other", TWO_LINKS, 'such as links = ["1", "2"]'),
    Field("cross", "the name of its cross, a link of the scene's that is not in [links]", _NEW_LINK,
          'such as cross = "3"'),
    _CENTRE,
    Field("arm", "the end of the other fork's arm, as it is seen", POINT, 'such as arm = "A"'),
    _angle("between the shafts", "cosine", math.cos),
    Field("trace", "the line in which the planes of the two circles meet", GUIDE, default=[1, 0]),
), _cardan), Table("a swash plate", (
    Field("links", "the shaft, and the piston that it moves", TWO_LINKS, 'such as links = ["1", "2"]'),
    Field("block", "the name of a block between the two, which is not in [links]", _NEW_LINK, 'such as block = "3"'),
    _CENTRE,
    Field("arm", "where the plate leans to, seen from the centre along the shaft", POINT, 'such as arm = "A"'),
    _angle("of the plate's axis with the shaft", "tangent", math.tan),
    Field("radius", "the distance of the piston from the shaft", DISTANCE, "such as radius = 60"),
    Field("trace", "the direction in which the piston slides", GUIDE, default=[1, 0]),
), _swash_plate))))
