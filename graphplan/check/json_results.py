"""What `graphplan solve` prints: the results of a report as plain data, after the contract."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from graphplan.check.compared import Compared, Results
from graphplan.check.report import Report
from graphplan.errors import ConstructionError
from graphplan.mechanism import numerals
from graphplan.mechanism.model import Scene, Slide
from graphplan.methods import kinds
from graphplan.methods.panels import JointForce
from graphplan.methods.results import balances

if TYPE_CHECKING:
    from graphplan.check.forces import Forces

OPPOSITE = "pole", "inflection_pole"  # of an inflection circle


def data(found: Report, each: bool = False) -> dict[str, Any]:
    """What `graphplan solve` prints, with the bound of each number where that is asked for."""
    scene = found.scene
    return {
        "title": scene.title,
        "units": {"length": scene.units.length, "force": scene.units.force, "mass": scene.units.mass},
        **_pose(found),
        "points": _merged(found, scene.points, velocity=kinds.VELOCITY, acceleration=kinds.ACCELERATION),
        "links": _merged(found, scene.moving, omega=kinds.OMEGA, alpha=kinds.ALPHA),
        "slides": _merged(found, (s.name for s in scene.slides), velocity=kinds.SLIDE_VELOCITY,
                          acceleration=kinds.SLIDE_ACCELERATION),
        **_poles(found),
        **_paths(found),
        **({"redundant": scene.redundant_pairs} if scene.redundant else {}),
        **_forces(found),
        **_protocol(found, each),
    }


def _poles(found: Report) -> dict[str, Any]:
    """The instant centres, if any are asked for: each where it is, or which way it lies at infinity; none of links that
    do not move relative to each other."""
    asked = found.scene.find.poles
    poles = _merged(found, asked, at=kinds.POLE, direction=kinds.POLE_HEADING)
    return {"poles": {name: poles.get(name, {"at": None}) for name in asked}} if asked else {}


def _pose(found: Report) -> dict[str, Any]:
    """The travel of a constructed pose, of each drive where there are several, and where its points are."""
    if found.scene.assembly is None:
        return {}
    travels = [float(travel) for travel in found.scene.assembly.travels]
    points = {name: [_number(part) for part in map(float, at)] for name, at in found.scene.points.items()}
    extreme = found.scene.assembly.extreme
    told = {} if extreme is None else {"extreme": extreme.way, "link": extreme.link, "time_ratio": extreme.time_ratio}
    return {"pose": {"travel": travels[0] if len(travels) == 1 else travels, **told, "points": points}}


def _paths(found: Report) -> dict[str, Any]:
    """Centres of curvature and inflection circles, where they are asked for."""
    find, results = found.scene.find, found.results
    told = {
        "curvature": {name: _curvature(found, name, found.scene.points[point])
                      for name, (point, _) in find.traced.items()},
        "inflection": {link: _inflection(results, link, found.exact) for link in find.inflection},
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
    return {"centre": _number(centre), **_lengths("radius", centre, at, found.exact)}


def _inflection(results: Results, link: str, exact: bool) -> dict[str, Any]:
    """The pole, the inflection pole and the diameter between them; none where the link does not turn."""
    if link in results.get(kinds.TRANSLATION, {}):
        return dict.fromkeys((*OPPOSITE, "diameter"))
    two = results[kinds.MOTION_POLE][link], results[kinds.INFLECTION][link]
    return dict(zip(OPPOSITE, map(_number, two), strict=True)) | _lengths("diameter", *two, exact)


def _lengths(key: str, one: Any, two: Any, exact: bool) -> dict[str, Any]:
    """A distance; in fractions its square, too, and the distance itself only where it is rational."""
    square = sum((p - q) * (p - q) for p, q in zip(one, two, strict=True))
    if not exact:
        root = getattr(square, "root", None)  # of enclosures a number, of symbols what makes it
        return {key: math.sqrt(square) if root is None else root() if callable(root) else root}
    root, rational = numerals.root(square)
    return {**({key: _number(root)} if rational else {}), f"{key}_squared": _number(square)}


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
    return {"method": found.drawing.method, **proof, "steps": steps}


def _plain(values: dict[Any, Any]) -> dict[Any, Any]:
    return {kind: _number(value) if value else 0 for kind, value in values.items()}


def _each(found: Report) -> dict[str, Any]:
    """The bounds of all printed numbers, by kind and name; those of a vector's components as a list."""
    def bounds(value: Any, vector: tuple[Compared, ...]) -> Any:
        told = list(_plain(dict(enumerate(number.beside("bound") for number in vector))).values())
        return told if isinstance(value, tuple) else told[0]

    return {part: {name: bounds(value, found.numbers[part][name]) for name, value in named.items()}
            for part, named in found.results.items() if part in found.numbers}


def _forces(found: Report) -> dict[str, Any]:
    """Balance and reactions; nothing where there are no loads."""
    if found.forces is None:
        return {}
    told = _balances(found, balances(found.scene, found.results))
    entries: list[dict[str, Any]] = []
    for point, link, pin in found.forces.asked:
        force = _number(found.results[kinds.REACTION][JointForce(point, link).name])
        entries.append({"at": point, "on": link, "from": pin, "force": force})
    for slide in found.scene.slides:
        if slide.name in found.results.get(kinds.SLIDE_REACTION, {}):
            entries.append(_slide(found, slide))
    for sort, kind, pairs in (("gear", kinds.GEAR_REACTION, found.scene.gears),
                              ("contact", kinds.CONTACT_REACTION, found.scene.contacts)):
        for name, (on, by) in ((pair.name, pair.links) for pair in pairs if pair.name in found.results.get(kind, {})):
            entries.append({sort: name, "on": on, "from": by, "force": _number(found.results[kind][name])})
    kept = {"balance": told[0] if len(told) == 1 else told} if told else {}
    return {**kept, "reactions": entries, **_indeterminate(found.scene), **_friction(found, found.forces)}


def _indeterminate(scene: Scene) -> dict[str, Any]:
    """The pairs whose reactions are asked for, though equilibrium does not tell them."""
    asked = scene.find.reactions
    of_joint = {JointForce(point, link).name: point for point in scene.joints for link in scene.links_of[point]}
    names = [name for name in scene.indeterminate_pairs
             if asked is None or name in asked or of_joint.get(name) in asked]
    return {"indeterminate": names} if names else {}


def _slide(found: Report, slide: Slide) -> dict[str, Any]:
    """A slide's reaction; `acts_at` is a point of its line, where that lies near."""
    x, y = found.scene.points[slide.at]
    arm = found.results.get(kinds.SLIDE_ARM, {}).get(slide.name)
    return {
        "slide": slide.name, "on": slide.link, "from": slide.along,
        "force": _number(found.results[kinds.SLIDE_REACTION][slide.name]),
        "moment": _number(found.results[kinds.SLIDE_MOMENT][slide.name]),
        **({"acts_at": _number((x + arm[0], y + arm[1]))} if arm is not None else {}),
    }


def _friction(found: Report, forces: Forces) -> dict[str, Any]:
    """The balances with friction and the efficiency: as drawn, in so many rounds, and where further rounds stand."""
    if not forces.rubbed:
        return {}
    told = {"balance": _balances(found, forces.rubbed), "efficiency": _number(forces.efficiency),
            "rounds": forces.rounds}
    if not forces.bounded:
        told["stands"] = {"balance": _balances(found, forces.named(forces.standing.balances)),
                          "efficiency": _number(forces.standing.efficiency)}
    return {"friction": told}


def _merged(found: Report, names: Iterable[str], **kinds: str) -> dict[str, Any]:
    """Readings of several kinds by name, as JSON takes them."""
    table = {}
    for name in names:
        entry = {k: _number(found.results[kind][name]) for k, kind in kinds.items()
                 if name in found.results.get(kind, {})}
        if entry:
            table[name] = entry
    return table


def _balances(found: Report, values: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Balances by name as JSON takes them: a moment on a link, or a force at a point of it."""
    named = found.scene.loads.named_balances if found.scene.loads else {}
    return [{"force": _number(value), "link": named[name].link, "at": named[name].at} if named[name].at
            else {"moment": _number(value), "link": named[name].link} for name, value in values.items()]


def _number(value: Any) -> Any:
    """A number as JSON takes it: floats as they are, fractions as a string p/q, none as null."""
    if isinstance(value, tuple):
        return [_number(part) for part in value]
    return str(value) if isinstance(value, Fraction) else None if value is None else value + 0.0
