"""Placements: how the points of a scene are placed, read from their entries and carried out in order of need.

A point is a pair of fractions wherever its inputs are and its rule is exact, otherwise the nearest floats.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from itertools import chain
from typing import Any

from graphplan.errors import by_name
from graphplan.mechanism.fields import (
    DIRECTION,
    DISTANCE,
    NUMBER,
    POINT,
    TWO_POINTS,
    VECTOR,
    Either,
    Field,
    Kind,
    Misfit,
    Named,
    SceneItem,
    SceneNames,
    Table,
    Value,
    Where,
    choice,
    describe,
    points_of,
    quote_key,
    vector,
)
from graphplan.mechanism.model import Pair, Placement
from graphplan.mechanism.numbers import FLOAT_RECKONING, Reckoning, exactly, is_exact, number_text
from graphplan.mechanism.tolerances import TANGENCY_TOL


def _placement_table(how: str, says: str, *fields: Field) -> Table:
    """A way to place a point, by the data under these keys."""
    return Table(f"{how}: {says}" if how in ("polar", "compass") else says, fields,
                 lambda row: Placement(how, row.values))


def _distances(wanted: int) -> Kind:
    """Distances from so many points."""
    def read(item: SceneItem, names: SceneNames) -> dict[str, Fraction] | None:
        table = item.table()
        if table is None:
            return None
        if len(table) != wanted:
            return item.fault(f"distances from {len(table)} points", f"distances from {wanted}, as the other keys ask")
        distances = {centre: distance.positive("distance") for centre, distance in table.items()}
        for centre in distances:
            if centre not in names.points:
                item.faults.unknown(table[centre].where, "point", centre, names.points)
        return {centre: distance for centre, distance in distances.items() if distance is not None}

    return Kind(f"distances by {wanted} point{'s' * (wanted > 1)}", read, {
        "type": "object", "propertyNames": POINT.schema, "additionalProperties": DISTANCE.schema,
        "minProperties": wanted, "maxProperties": wanted})


def _coordinates(item: SceneItem, names: SceneNames) -> Placement | None:
    at = item.vector()
    return None if at is None else Placement("given", {"at": at})


_THROUGH = Kind("point or two numbers", lambda item, names: (POINT if isinstance(item.value, str) else VECTOR).read(
    item, names), {"anyOf": [VECTOR.schema, POINT.schema]})
_LINE = Table("a line", (
    Field("through", "a point of the line, [x, y] or its name", _THROUGH, "a point of the line, [x, y] or a name"),
    Field("direction", "the line's direction: a vector, an angle in degrees, or two points", DIRECTION,
          "the line's direction, such as [1, 0]"),
))
WAYS = (
    _placement_table("polar", "from a point, by distance and angle",
                     Field("from", "the point to measure from", POINT, 'the point to measure from, such as from = "O"'),
                     Field("distance", "the distance from that point", DISTANCE, "a length, such as distance = 250"),
                     Field("angle", "the direction in degrees from +x, counter-clockwise", NUMBER,
                           "degrees from +x, such as angle = 20")),
    _placement_table("compass", "where two arcs meet",
                     Field("distances", "the distances from two points: two arcs", _distances(2),
                           "the distances from two points, such as distances = { A = 730, C = 300 }"),
                     Field("side", "the side of the ray from the first to the second centre", choice("left", "right"),
                           'side = "left" or "right" of the ray from the first to the second centre')),
    _placement_table("arc-line", "where an arc meets a line",
                     Field("distances", "the distance from one point: an arc", _distances(1),
                           "the distance from one point, such as distances = { A = 730 }"),
                     Field("on", "the line that the arc meets", _LINE,
                           "the line, such as on = { through = [0, 107], direction = [1, 0] }"),
                     Field("pick", "the intersection further along the line's direction (right) or back (left)",
                           choice("left", "right"),
                           'pick = "right" (further along) or "left" (back along) the line\'s direction')),
    _placement_table("on-line", "on the line of two points",
                     Field("on", "the two points of the line", TWO_POINTS,
                           'the line\'s two points, such as on = "A B"'),
                     Field("distance", "how far from the first point towards the second", NUMBER,
                           "a length from the first point towards the second, such as distance = 340")),
)
COORDINATES = Kind("coordinates [x, y]", _coordinates, VECTOR.schema)


def _form(item: SceneItem) -> Value | None:
    """The way to place a point with the most keys present; coordinates where the entry is no table."""
    if not isinstance(item.value, dict):
        return COORDINATES
    way = max(WAYS, key=lambda way: sum(key in way.keys for key in item.value))  # type: ignore[attr-defined]
    if item.value.keys() & {*way.keys}:
        return way
    instead = 'coordinates [x, y], or a table such as { from = "O", distance = 250, angle = 20 }'
    if ends := re.fullmatch(r"([^\W\d]\d*)[\W_]*([^\W\d]\d*)", next(iter(item.value), "")):  # AB, or A-B
        length = describe(next(iter(item.value.values()))).removeprefix("the number ")
        instead = f"lengths place points: {ends[2]} = {{ distances = {{ {ends[1]} = {length}, ... }}, side = ... }}"
    return item.fault(f"{describe(item.value)} places no point", instead)


def _check_name(point: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where a point's name cannot stand in a list of points."""
    if "," in point or point.split() != [point] or not point.isprintable():
        item.fault("a point's name is empty or has blanks or commas", "a name without them, such as A2")


POINTS = Named(Either((COORDINATES, *WAYS), _form), POINT, _check_name, least=1)


def needs(placement: Placement) -> tuple[str, ...]:
    """The points from which a point is placed."""
    data: dict[str, Any] = placement.data
    on = data.get("on")
    line = on.values() if isinstance(on, dict) else (on,)
    return (*points_of(data.get("from")), *data.get("distances", ()), *chain.from_iterable(map(points_of, line)))


def place(placements: Mapping[str, Placement], table: SceneItem) -> dict[str, Pair]:
    """The coordinates of all points that can be placed; the others are faults of `table`, or wait for such ones."""
    points: dict[str, Pair] = {}
    for name in _in_order(placements, table):
        placement = placements[name]
        if all(centre in points for centre in needs(placement)):
            item = SceneItem(None, f"{table.where}.{quote_key(name)}", table.faults)
            try:
                points[name] = put(placement, points)
            except Misfit as misfit:
                item.fault(misfit.what, misfit.instead)
    return points


def placed_by(placements: Mapping[str, Placement], by: Reckoning) -> dict[str, Pair]:
    """The coordinates of the points of a sound scene, computed once more from what is written.

    Fails with `Misfit` where `by` sees arcs pass each other by that rounding lets touch.
    """
    points: dict[str, Pair] = {}
    for name in TopologicalSorter({name: needs(placement) for name, placement in placements.items()}).static_order():
        x, y, _ = RULES[placements[name].how](placements[name].data, points.__getitem__, False, by)
        points[name] = x, y
    return points


def put(placement: Placement, points: Mapping[str, Pair]) -> Pair:
    """Place a point by its rule, among the others."""
    rational = is_exact(*(points[name] for name in needs(placement)))
    x, y, exact = RULES[placement.how](placement.data, lambda name: exactly(points[name]), not rational,
                                       FLOAT_RECKONING)
    return (x, y) if exact and rational else (float(x), float(y))


def _in_order(placements: Mapping[str, Placement], table: SceneItem) -> list[str]:
    """The points, each after those that place it; a ring of points that place each other is a fault and left out."""
    waiting = {name: [p for p in needs(placement) if p in placements] for name, placement in placements.items()}
    while True:
        try:
            return list(TopologicalSorter(waiting).static_order())
        except CycleError as error:
            ring = sorted({*error.args[1]}, key=by_name)
            location = f"{table.where}.{quote_key(ring[0])}"
            problem = f"points {', '.join(ring)} are placed from each other" if ring[1:] else "it is placed from itself"
            table.faults.add(location, problem, "coordinates for one of them")
            waiting = {name: [p for p in on if p not in ring] for name, on in waiting.items() if name not in ring}


# --- rules -----------------------------------------------------------------------------------------------------------
# They put a point with compasses, rule and protractor. Every rule computes in fractions, or in any numbers that compute
# with them, and gives x, y and whether they are exact. Roots and angles it takes from the reckoning `sharp`; an
# irrational root is good to far more than a float's digits, so a point is rounded once, at the end. `rounded` says that
# some centre is itself a rounded point.


Put = tuple[Any, Any, bool]
TURNED_DOWN = "turned down"  # a point of a joint in space, whose circle is turned down about its trace


def _place_given(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    return *data["at"], True


def _place_polar(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    (x, y), (c, s, exact) = at(data["from"]), sharp.heading(data["angle"])
    return x + data["distance"] * c, y + data["distance"] * s, exact


def _place_compass(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    (a, p), (b, q) = data["distances"].items()
    (ax, ay), (bx, by) = at(a), at(b)
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    if square == 0:
        raise Misfit(f"the compass centres {a} and {b} coincide", "centres that lie apart")
    along = (p * p - q * q + square) / (2 * square)
    across, exact = _half_chord(p * p / square - along * along, p * p / square, rounded, sharp)
    if across is None:
        apart = number_text(float(sharp.root(square)[0]))
        raise Misfit(f"compass arcs around {a} (radius {number_text(p)}) and {b} (radius {number_text(q)}) do not "
                     f"meet, the centres are {apart} apart",
                     f"radii {'whose sum is at least' if (p + q) ** 2 < square else 'that differ by at most'} {apart}")
    turned = across if data["side"] == "left" else -across
    return ax + along * dx - turned * dy, ay + along * dy + turned * dx, exact


def _place_arc_line(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    ((centre, radius),) = data["distances"].items()
    through, direction = data["on"]["through"], data["on"]["direction"]
    (cx, cy), (tx, ty) = at(centre), at(through) if isinstance(through, str) else through
    ux, uy, straight = vector(direction, at, sharp)
    square = ux * ux + uy * uy
    foot = (ux * (cx - tx) + uy * (cy - ty)) / square
    gap = (ux * (cy - ty) - uy * (cx - tx)) ** 2 / square
    half, exact = _half_chord((radius**2 - gap) / square, radius**2 / square, rounded, sharp)
    if half is None:
        away = number_text(float(sharp.root(gap)[0]))
        raise Misfit(f"the arc around {centre} (radius {number_text(radius)}) does not meet the line, "
                     f"which is {away} away", f"a radius of at least {away}")
    step = foot + (half if data["pick"] == "right" else -half)
    return tx + step * ux, ty + step * uy, exact and straight


def _place_on_line(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    first = data["on"].split()[0]
    (x, y), (ux, uy, _) = at(first), vector(data["on"], at, sharp)
    length, exact = sharp.root(ux * ux + uy * uy)
    return x + data["distance"] * ux / length, y + data["distance"] * uy / length, exact or not data["distance"]


def _place_turned_down(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    """A `share` of the arm from a centre, with the part of this across the `trace` divided by a cosine, or left out."""
    (ox, oy), (ax, ay) = map(at, data["from"].split())
    (tx, ty), dx, dy = data["trace"], ax - ox, ay - oy
    grown = 0 if data.get("flat") else 1 / data["cosine"]
    height = (tx * dy - ty * dx) / (tx * tx + ty * ty) * (grown - 1)
    share = data["share"]
    return ox + share * (dx - height * ty), oy + share * (dy + height * tx), is_exact((data["cosine"], share))


def _half_chord(square: Any, radius_square: Any, rounded: bool, sharp: Reckoning) -> tuple[Any, bool]:
    """Half the chord that two curves cut out, from its square, and whether it is exact; None if they do not meet."""
    if square >= 0:
        return sharp.root(square)
    return (Fraction(0) if rounded and square >= -TANGENCY_TOL * radius_square else None), False


RULES: dict[str, Callable[[dict[str, Any], Where, bool, Reckoning], Put]] = {
    "given": _place_given, "polar": _place_polar, "compass": _place_compass, "arc-line": _place_arc_line,
    "on-line": _place_on_line, TURNED_DOWN: _place_turned_down}
