"""Placements: how the points of a scene are placed, read from their entries and carried out in order of need.

A point is a pair of fractions wherever its inputs are and its rule is exact, otherwise the nearest floats.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from typing import Any

from graphplan.errors import by_name
from graphplan.mechanism.arcs import RULES
from graphplan.mechanism.directions import DIRECTION, TWO_POINTS, Misfit, points_of
from graphplan.mechanism.fields import (
    DISTANCE,
    NUMBER,
    POINT,
    VECTOR,
    Either,
    Field,
    Kind,
    Named,
    Names,
    Table,
    Value,
    choice,
)
from graphplan.mechanism.items import Item, described, quoted
from graphplan.mechanism.model import Pair, Placement
from graphplan.mechanism.numerals import TO_A_FLOAT, Reckoning, exactly, is_exact


def _way(how: str, says: str, *fields: Field) -> Table:
    """A way to place a point, by the data under these keys."""
    return Table(f"{how}: {says}" if how in ("polar", "compass") else says, fields,
                 lambda row: Placement(how, row.values))


def _distances(wanted: int) -> Kind:
    """Distances from so many points."""
    def read(item: Item, names: Names) -> dict[str, Fraction] | None:
        table = item.table()
        if table is None:
            return None
        if len(table) != wanted:
            item.fault(f"distances from {len(table)} points", f"distances from {wanted}, as the other keys ask")
            return None
        distances = {centre: distance.positive("distance") for centre, distance in table.items()}
        for centre in distances:
            if centre not in names.points:
                item.faults.unknown(table[centre].where, "point", centre, names.points)
        return {centre: distance for centre, distance in distances.items() if distance is not None}

    return Kind(f"distances by {wanted} point{'s' * (wanted > 1)}", read, {
        "type": "object", "propertyNames": POINT.schema, "additionalProperties": DISTANCE.schema,
        "minProperties": wanted, "maxProperties": wanted})


def _coordinates(item: Item, names: Names) -> Placement | None:
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
    _way("polar", "from a point, by distance and angle",
         Field("from", "the point to measure from", POINT, 'the point to measure from, such as from = "O"'),
         Field("distance", "the distance from that point", DISTANCE, "a length, such as distance = 250"),
         Field("angle", "the direction in degrees from +x, counter-clockwise", NUMBER,
               "degrees from +x, such as angle = 20")),
    _way("compass", "where two arcs meet",
         Field("distances", "the distances from two points: two arcs", _distances(2),
               "the distances from two points, such as distances = { A = 730, C = 300 }"),
         Field("side", "the side of the ray from the first to the second centre", choice("left", "right"),
               'side = "left" or "right" of the ray from the first to the second centre')),
    _way("arc-line", "where an arc meets a line",
         Field("distances", "the distance from one point: an arc", _distances(1),
               "the distance from one point, such as distances = { A = 730 }"),
         Field("on", "the line that the arc meets", _LINE,
               "the line, such as on = { through = [0, 107], direction = [1, 0] }"),
         Field("pick", "the intersection further along the line's direction (right) or back (left)",
               choice("left", "right"),
               'pick = "right" (further along) or "left" (back along) the line\'s direction')),
    _way("on-line", "on the line of two points",
         Field("on", "the two points of the line", TWO_POINTS, 'the line\'s two points, such as on = "A B"'),
         Field("distance", "how far from the first point towards the second", NUMBER,
               "a length from the first point towards the second, such as distance = 340")),
)
COORDINATES = Kind("coordinates [x, y]", _coordinates, VECTOR.schema)


def _form(item: Item) -> Value | None:
    """The way to place a point of which the most keys are there; coordinates where it is no table."""
    if not isinstance(item.value, dict):
        return COORDINATES
    way = max(WAYS, key=lambda way: sum(key in way.keys for key in item.value))  # type: ignore[attr-defined]
    if item.value.keys() & {*way.keys}:
        return way
    item.fault(f"{described(item.value)} places no point",
               'coordinates [x, y], or a table such as { from = "O", distance = 250, angle = 20 }')
    return None


def _named(point: str, item: Item, names: Names) -> None:
    """A fault where a point's name cannot stand in a list of points."""
    if "," in point or point.split() != [point] or not point.isprintable():
        item.fault("a point's name is empty or has blanks or commas", "a name without them, such as A2")


POINTS = Named(Either((COORDINATES, *WAYS), _form), POINT, _named, least=1)


def needs(placement: Placement) -> tuple[str, ...]:
    """The points from which a point is placed."""
    data: dict[str, Any] = placement.data
    match placement.how:
        case "polar":
            return (data["from"],)
        case "compass":
            return tuple(data["distances"])
        case "arc-line":
            through = data["on"]["through"]
            named = (through,) if isinstance(through, str) else ()
            return (*data["distances"], *named, *points_of(data["on"]["direction"]))
        case "on-line":
            return tuple(data["on"].split())
    return ()


def place(placements: Mapping[str, Placement], table: Item) -> dict[str, Pair]:
    """The coordinates of all points that can be placed; the others are faults of `table`, or wait for such ones."""
    points: dict[str, Pair] = {}
    for name in _in_order(placements, table):
        placement = placements[name]
        if all(centre in points for centre in needs(placement)):
            item = Item(None, f"{table.where}.{quoted(name)}", table.faults)
            try:
                points[name] = _put(placement, points)
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


def _put(placement: Placement, points: Mapping[str, Pair]) -> Pair:
    rational = is_exact(*(points[name] for name in needs(placement)))
    x, y, exact = RULES[placement.how](placement.data, lambda name: exactly(points[name]), not rational, TO_A_FLOAT)
    return (x, y) if exact and rational else (float(x), float(y))


def _in_order(placements: Mapping[str, Placement], table: Item) -> list[str]:
    """The points, each after those that place it; a ring of points that place each other is a fault and left out."""
    waiting = {name: [p for p in needs(placement) if p in placements] for name, placement in placements.items()}
    while True:
        try:
            return list(TopologicalSorter(waiting).static_order())
        except CycleError as error:
            ring = sorted({*error.args[1]}, key=by_name)
            where = f"{table.where}.{quoted(ring[0])}"
            told = f"points {', '.join(ring)} are placed from each other" if ring[1:] else "it is placed from itself"
            table.faults.add(where, told, "coordinates for one of them")
            waiting = {name: [p for p in on if p not in ring] for name, on in waiting.items() if name not in ring}
