"""What `graphplan solve` prints: the results of a report as plain data, after the contract."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from graphplan.check import json_forces
from graphplan.check.compared import Compared, Results
from graphplan.check.json_numbers import number
from graphplan.check.report import Report
from graphplan.errors import ConstructionError
from graphplan.mechanism import numerals
from graphplan.methods import kinds

AT_REST = "the links do not move relative to each other: any point is a pole"
TRANSLATES = "the link does not turn: its pole is at infinity"
OPPOSITE = "pole", "inflection_pole"  # of an inflection circle


def data(found: Report, each: bool = False) -> dict[str, Any]:
    """What `graphplan solve` prints, with the bound of each number where that is asked for."""
    scene = found.asked
    return {
        "title": scene.title,
        "units": {"length": scene.units.length, "force": scene.units.force, "mass": scene.units.mass},
        **_pose(found),
        "points": _merged(found, "points", scene.points, velocity=kinds.VELOCITY, acceleration=kinds.ACCELERATION),
        "links": _merged(found, "links", scene.moving, omega=kinds.OMEGA, alpha=kinds.ALPHA),
        "slides": _merged(found, "slides", (s.name for s in scene.slides), velocity=kinds.SLIDE_VELOCITY,
                          acceleration=kinds.SLIDE_ACCELERATION),
        **_poles(found),
        **_paths(found),
        **({"redundant": scene.redundant_pairs} if scene.redundant else {}),
        **json_forces.forces(found),
        **({"reasons": missing} if (missing := reasons(found)) else {}),
        **_protocol(found, each),
    }


def reasons(found: Report) -> json_forces.Reasons:
    """Why what is asked for is null, by the printed key and the name of the thing."""
    results, find = found.results, found.scene.find
    drawn = {name for kind in (kinds.POLE, kinds.POLE_HEADING) for name in results.get(kind, {})}
    told = {
        "poles": {name: AT_REST for name in find.poles if name not in drawn},
        "inflection": {link: TRANSLATES for link in find.inflection if link in results.get(kinds.TRANSLATION, {})},
        **json_forces.reasons(found),
    }
    keys = dict.fromkeys((*found.missing, *told))
    every = {key: {**told.get(key, {}), **found.missing.get(key, {})} for key in keys}
    return {key: named for key, named in every.items() if named}


def _poles(found: Report) -> dict[str, Any]:
    """The instant centres, if any are asked for: each where it is, or which way it lies at infinity; none of links that
    do not move relative to each other."""
    asked = found.asked.find.poles
    poles = _merged(found, "", asked, at=kinds.POLE, direction=kinds.POLE_HEADING)
    return {"poles": {name: poles.get(name, {"at": None}) for name in asked}} if asked else {}


def _pose(found: Report) -> dict[str, Any]:
    """The travel of a constructed pose, of each drive where there are several, and where its points are."""
    if found.scene.assembly is None:
        return {}
    travels = [float(travel) for travel in found.scene.assembly.travels]
    points = {name: [number(part) for part in map(float, at)] for name, at in found.scene.points.items()}
    extreme = found.scene.assembly.extreme
    told = {} if extreme is None else {"extreme": extreme.way, "link": extreme.link, "time_ratio": extreme.time_ratio}
    return {"pose": {"travel": travels[0] if len(travels) == 1 else travels, **told, "points": points}}


def _paths(found: Report) -> dict[str, Any]:
    """Centres of curvature and inflection circles, where they are asked for."""
    find, results, missing = found.asked.find, found.results, found.missing
    told = {
        "curvature": {name: None if name in missing.get("curvature", {})
                      else _curvature(found, name, found.scene.points[point])
                      for name, (point, _) in find.traced.items()},
        "inflection": {link: None if link in missing.get("inflection", {}) else _inflection(results, link, found.exact)
                       for link in find.inflection},
    }
    return {key: named for key, named in told.items() if named}


def _curvature(found: Report, name: str, point: Any) -> dict[str, Any]:
    """The centre and the radius of curvature; none where the path is straight, the point itself at a cusp."""
    results = found.results
    at = tuple(part if found.exact or not isinstance(part, Fraction) else float(part) for part in point)
    centre = at if name in results.get(kinds.CUSP, {}) else results.get(kinds.CENTRE, {}).get(name)
    if centre is None:
        x, y = results[kinds.STRAIGHT][name]
        square = x * x + y * y
        numbers = found.numbers.get(kinds.STRAIGHT, {}).get(name, ())
        if all(abs(number.value) <= number.bound for number in numbers):
            return {"centre": None, "radius": None}
        centre = at[0] + x / square, at[1] + y / square
    return {"centre": number(centre), **_lengths("radius", centre, at, found.exact)}


def _inflection(results: Results, link: str, exact: bool) -> dict[str, Any]:
    """The pole, the inflection pole and the diameter between them; none where the link does not turn."""
    if link in results.get(kinds.TRANSLATION, {}):
        return dict.fromkeys((*OPPOSITE, "diameter"))
    two = results[kinds.MOTION_POLE][link], results[kinds.INFLECTION][link]
    return dict(zip(OPPOSITE, map(number, two), strict=True)) | _lengths("diameter", *two, exact)


def _lengths(key: str, one: Any, two: Any, exact: bool) -> dict[str, Any]:
    """A distance; in fractions its square, too, and the distance itself only where it is rational."""
    square = sum((p - q) * (p - q) for p, q in zip(one, two, strict=True))
    if not exact:
        root = getattr(square, "root", None)  # of enclosures a number, of symbols what makes it
        return {key: math.sqrt(square) if root is None else root() if callable(root) else root}
    root, rational = numerals.root(square)
    return {**({key: number(root)} if rational else {}), f"{key}_squared": number(square)}


def _protocol(found: Report, each: bool) -> dict[str, Any]:
    """How it is drawn, how well that agrees, and in how many steps; only how well where no pencil could draw it."""
    bounds = _plain(found.bounds) | ({"each": _each(found)} if each else {})
    proof = {"check": _plain(found.check), "bounds": bounds, "arithmetic": found.arithmetic}
    if found.fault is not None:
        why = f"analytic solver alone, as nothing can be drawn in this pose: {found.fault.why}"
        return {"method": {kind: [why] for kind in found.bounds}, **proof, "check": {}}
    try:
        steps = len(found.drawing.drawn) - found.drawing.drawn.givens
    except ConstructionError:
        return proof
    method = found.drawing.method
    if more := json_forces.alone(found):
        method = method | {kinds.FORCES: [*method.get(kinds.FORCES, ()), *more]}
    return {"method": method, **proof, "steps": steps}


def _plain(values: dict[Any, Any]) -> dict[Any, Any]:
    return {kind: number(value) if value else 0 for kind, value in values.items()}


def _each(found: Report) -> dict[str, Any]:
    """The bounds of all printed numbers, by kind and name; those of a vector's components as a list."""
    def bounds(value: Any, vector: tuple[Compared, ...]) -> Any:
        told = list(_plain(dict(enumerate(number.beside("bound") for number in vector))).values())
        return told if isinstance(value, tuple) else told[0]

    return {part: {name: bounds(value, found.numbers[part][name]) for name, value in named.items()}
            for part, named in found.results.items() if part in found.numbers}


def _merged(found: Report, key: str, names: Iterable[str], **kinds: str) -> dict[str, Any]:
    """Readings of several kinds by name, as JSON takes them; null what is asked for and missing under this key."""
    table, missing, find = {}, found.missing.get(key, {}), found.asked.find
    for name in names:
        entry = {k: number(found.results[kind][name]) for k, kind in kinds.items()
                 if name in found.results.get(kind, {})}
        if name in missing:
            entry = dict.fromkeys(k for k in kinds if key != "points" or name in getattr(find, k))
        if entry:
            table[name] = entry
    return table
