"""Placements: how the points of a scene are placed, read from their entries and carried out in order of need.

A point is a pair of fractions wherever its inputs are and its rule is exact, otherwise the nearest floats.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from typing import Any

from graphplan.errors import by_name
from graphplan.mechanism.arcs import RULES
from graphplan.mechanism.directions import Misfit, points_of, read_direction
from graphplan.mechanism.items import Item, Vector, described, quoted
from graphplan.mechanism.model import Pair, Placement
from graphplan.mechanism.numerals import TO_A_FLOAT, Reckoning

_FORMS: dict[str, dict[str, str]] = {
    "polar": {
        "from": 'the point to measure from, such as from = "O"',
        "distance": "a length, such as distance = 250",
        "angle": "degrees from +x, such as angle = 20",
    },
    "compass": {
        "distances": "the distances from two points, such as distances = { A = 730, C = 300 }",
        "side": 'side = "left" or "right" of the ray from the first to the second centre',
    },
    "arc-line": {
        "distances": "the distance from one point, such as distances = { A = 730 }",
        "on": "the line, such as on = { through = [0, 107], direction = [1, 0] }",
        "pick": 'pick = "right" (further along) or "left" (back along) the line\'s direction',
    },
    "on-line": {
        "on": 'the line\'s two points, such as on = "A B"',
        "distance": "a length from the first point towards the second, such as distance = 340",
    },
}


def read_placement(item: Item, points: Collection[str]) -> Placement | None:
    """How one point is placed, with its numbers exact; coordinates are data `at`."""
    if not isinstance(item.value, dict):
        at = item.vector()
        return None if at is None else Placement("given", {"at": at})
    how = max(_FORMS, key=lambda form: len(_FORMS[form].keys() & item.value.keys()))  # type: ignore[attr-defined]
    if not _FORMS[how].keys() & item.value.keys():
        item.fault(
            f"{described(item.value)} places no point",
            'coordinates [x, y], or a table such as { from = "O", distance = 250, angle = 20 }',
        )
        return None
    fields = item.fields(_FORMS[how], _FORMS[how])
    if fields is None:
        return None
    data = {key: _read_field(how, key, field, points) for key, field in fields.items()}
    return None if None in data.values() else Placement(how, data)


def _read_field(how: str, key: str, item: Item, points: Collection[str]) -> object:
    if key == "from":
        return item.name_of("point", points)
    if key == "distances":
        return _read_distances(item, points, wanted=2 if how == "compass" else 1)
    if key in ("side", "pick"):
        return item.choice(("left", "right"))
    if key == "on":
        return _read_line(item, points) if how == "arc-line" else _read_point_pair(item, points)
    return item.positive() if how == "polar" and key == "distance" else item.number()


def _read_distances(item: Item, points: Collection[str], wanted: int) -> dict[str, Fraction] | None:
    table = item.table()
    if table is None:
        return None
    if len(table) != wanted:
        item.fault(f"distances from {len(table)} points", f"distances from {wanted}, as the other keys ask")
        return None
    distances = {centre: distance.positive() for centre, distance in table.items()}
    for centre in distances:
        if centre not in points:
            item.faults.unknown(table[centre].where, "point", centre, points)
    known = {centre: d for centre, d in distances.items() if d is not None and centre in points}
    return known if len(known) == wanted else None


def _read_line(item: Item, points: Collection[str]) -> dict[str, object] | None:
    required = {"through": "a point of the line, [x, y] or a name", "direction": "the line's direction, such as [1, 0]"}
    fields = item.fields(required, required)
    if fields is None:
        return None
    base = fields["through"]
    through = base.name_of("point", points) if isinstance(base.value, str) else base.vector()
    direction = read_direction(fields["direction"], points)
    return None if through is None or direction is None else {"through": through, "direction": direction}


def _read_point_pair(item: Item, points: Collection[str]) -> str | None:
    names = item.points(points)
    if names is not None and len(names) != 2:
        item.fault(f"{described(item.value)} where two points are wanted", 'two points such as "A B"')
        return None
    return None if names is None else " ".join(names)


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
    """The coordinates of the points of a sound scene, reckoned once more from what is written.

    Fails with `Misfit` where `by` sees arcs pass each other by that rounding lets touch.
    """
    points: dict[str, Pair] = {}
    for name in TopologicalSorter({name: needs(placement) for name, placement in placements.items()}).static_order():
        x, y, _ = RULES[placements[name].how](placements[name].data, points.__getitem__, False, by)
        points[name] = x, y
    return points


def exactly(point: Pair) -> Vector:
    """A point's coordinates as fractions: a float is taken as the binary fraction that it is."""
    return Fraction(point[0]), Fraction(point[1])


def is_exact(*points: Pair) -> bool:
    """Whether all these are given by fractions."""
    return all(isinstance(x, Fraction) for point in points for x in point)


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
