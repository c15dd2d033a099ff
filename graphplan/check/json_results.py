"""What `graphplan solve` prints: the results of a report as plain data, after the contract."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from graphplan.check.compared import ComparedNumber, Results
from graphplan.check.report import Reasons, Report
from graphplan.errors import ConstructionError
from graphplan.mechanism.model import Find, Scene, Slide
from graphplan.mechanism.numbers import dot
from graphplan.mechanism.numbers import root as exact_root
from graphplan.methods import kinds
from graphplan.methods.results import PairForce, pair_forces

if TYPE_CHECKING:
    from graphplan.check.forces import Forces

AT_REST = "the links do not move relative to each other: any point is a pole"
TRANSLATES = "the link does not turn: its pole is at infinity"
OPPOSITE = "pole", "inflection_pole"  # of an inflection circle


def result_data(report: Report, each: bool = False) -> dict[str, Any]:
    """The JSON of `graphplan solve`, with the bound of each number if asked for."""
    scene = report.given_scene
    return {
        "title": scene.title,
        "units": {"length": scene.units.length, "force": scene.units.force, "mass": scene.units.mass},
        **_pose(report),
        "points": _facts_by_name(report, "points", scene.points),
        "links": _facts_by_name(report, "links", scene.moving),
        "slides": _facts_by_name(report, "slides", (slide.name for slide in scene.slides)),
        **_poles(report),
        **_paths(report),
        **({"redundant": scene.redundant_pairs} if scene.redundant else {}),
        **force_data(report),
        **({"reasons": missing} if (missing := reasons(report)) else {}),
        **_protocol(report, each),
    }


def reasons(report: Report) -> Reasons:
    """Why what is asked for is null, by the printed key and the name of the thing."""
    results, find = report.results, report.scene.find
    poles_drawn = {name for kind in (kinds.POLE, kinds.POLE_HEADING) for name in results.get(kind, {})}
    named_reasons = {
        "poles": {name: AT_REST for name in find.poles if name not in poles_drawn},
        "inflection": {link: TRANSLATES for link in find.inflection if link in results.get(kinds.TRANSLATION, {})},
        **force_reasons(report),
    }
    keys = dict.fromkeys((*report.missing, *named_reasons))
    every = {key: {**named_reasons.get(key, {}), **report.missing.get(key, {})} for key in keys}
    return {key: named for key, named in every.items() if named}


def _poles(report: Report) -> dict[str, Any]:
    """The instant centres, if any are asked for: each with its place, or its direction at infinity; null for links
    without relative motion."""
    requested = report.given_scene.find.poles
    poles = _facts_by_name(report, "poles", requested)
    return {"poles": {name: poles.get(name, {"at": None}) for name in requested}} if requested else {}


def _pose(report: Report) -> dict[str, Any]:
    """The travel of a constructed pose, of each drive where there are several, and where its points are."""
    if report.scene.assembly is None:
        return {}
    travels = [float(travel) for travel in report.scene.assembly.travels]
    points = {name: [json_number(coordinate) for coordinate in map(float, at)]
              for name, at in report.scene.points.items()}
    extreme = report.scene.assembly.extreme
    extreme_data = {} if extreme is None else {"extreme": extreme.way, "link": extreme.link,
                                               "time_ratio": extreme.time_ratio}
    return {"pose": {"travel": travels[0] if len(travels) == 1 else travels, **extreme_data, "points": points}}


def _paths(report: Report) -> dict[str, Any]:
    """Centres of curvature, inflection circles and acceleration centres, where they are asked for."""
    find, results, missing = report.given_scene.find, report.results, report.missing
    tables = {
        "curvature": {name: None if name in missing.get("curvature", {})
                      else _curvature(report, name, report.scene.points[point])
                      for name, (point, _) in find.curvature_points.items()},
        "inflection": {link: None if link in missing.get("inflection", {}) else _inflection(results, link, report.exact)
                       for link in find.inflection},
        "acceleration_centres": {
            link: {"at": json_number(results.get(kinds.ACCELERATION_CENTRE, {}).get(link))}
            for link in find.acceleration_centres},
    }
    return {key: named for key, named in tables.items() if named}


def _curvature(report: Report, name: str, point: Any) -> dict[str, Any]:
    """The centre and the radius of curvature; null for a straight path, the point itself at a cusp."""
    results = report.results
    at = tuple(coordinate if report.exact or not isinstance(coordinate, Fraction) else float(coordinate)
               for coordinate in point)
    centre = at if name in results.get(kinds.CUSP, {}) else results.get(kinds.CENTRE, {}).get(name)
    if centre is None:
        x, y = results[kinds.STRAIGHT][name]
        square = x * x + y * y
        numbers = report.numbers.get(kinds.STRAIGHT, {}).get(name, ())
        if all(abs(number.value) <= number.bound for number in numbers):
            return {"centre": None, "radius": None}
        centre = at[0] + x / square, at[1] + y / square
    return {"centre": json_number(centre), **_lengths("radius", centre, at, report.exact)}


def _inflection(results: Results, link: str, exact: bool) -> dict[str, Any]:
    """The pole, the inflection pole and the diameter between them; null if the link does not turn."""
    if link in results.get(kinds.TRANSLATION, {}):
        return dict.fromkeys((*OPPOSITE, "diameter"))
    two = results[kinds.MOTION_POLE][link], results[kinds.INFLECTION][link]
    return dict(zip(OPPOSITE, map(json_number, two), strict=True)) | _lengths("diameter", *two, exact)


def _lengths(key: str, one: Any, two: Any, exact: bool) -> dict[str, Any]:
    """A distance; in fractions its square, too, and the distance itself only where it is rational."""
    square = sum((p - q) * (p - q) for p, q in zip(one, two, strict=True))
    if not exact:
        root = getattr(square, "root", None)  # of enclosures a number, of symbols what makes it
        return {key: math.sqrt(square) if root is None else root() if callable(root) else root}
    root, rational = exact_root(square)
    return {**({key: json_number(root)} if rational else {}), f"{key}_squared": json_number(square)}


def _protocol(report: Report, each: bool) -> dict[str, Any]:
    """The methods, the differences from the solver and the number of steps; without methods if no pencil could draw the
    construction."""
    bounds = _plain(report.bounds) | ({"each": _number_bounds(report)} if each else {})
    proof = {"check": _plain(report.check), "bounds": bounds, "arithmetic": report.arithmetic}
    if report.fault is not None:
        why = f"analytic solver alone, as nothing can be drawn in this pose: {report.fault.why}"
        return {"method": {kind: [why] for kind in report.bounds}, **proof, "check": {}}
    try:
        steps = len(report.drawing.drawn) - report.drawing.drawn.givens
    except ConstructionError:
        return proof
    method = report.drawing.method
    if more := solver_only_notes(report):
        method = method | {kinds.FORCES: [*method.get(kinds.FORCES, ()), *more]}
    return {"method": method, **proof, "steps": steps}


def _plain(values: dict[Any, Any]) -> dict[Any, Any]:
    return {kind: json_number(value) if value else 0 for kind, value in values.items()}


def _number_bounds(report: Report) -> dict[str, Any]:
    """The bounds of all printed numbers, by kind and name; those of a vector's components as a list."""
    def bounds(value: Any, vector: tuple[ComparedNumber, ...]) -> Any:
        relative_bounds = list(_plain(dict(enumerate(number.relative("bound") for number in vector))).values())
        return relative_bounds if isinstance(value, tuple) else relative_bounds[0]

    by_kind: dict[str, dict[str, Any]] = {}
    for fact in report.facts:
        if fact.compared:
            by_kind.setdefault(fact.kind, {})[fact.of] = bounds(fact.value, fact.compared)
    return by_kind


def _facts_by_name(report: Report, table: str, names: Iterable[str]) -> dict[str, Any]:
    """The facts of a table by name; null what is asked for and missing there."""
    entries: dict[str, dict[str, Any]] = {name: {} for name in names}
    keys = [kind.key for kind in kinds.KINDS.values() if kind.table == table]
    for fact in report.facts:
        if fact.kind.table == table and fact.of in entries:
            entries[fact.of][fact.kind.key] = json_number(fact.value)
    for name in entries.keys() & report.missing.get(table, {}).keys():
        entries[name] = {key: None for key in keys if _is_requested(report.given_scene.find, f"{table}.{key}", name)}
    return {name: {key: entry[key] for key in keys if key in entry} for name, entry in entries.items() if entry}


def _is_requested(find: Find, path: str, name: str) -> bool:
    """Whether a result is asked for and exists; a pole that does not exist has no direction."""
    match path:
        case "points.velocity" | "points.acceleration":
            return name in getattr(find, path.removeprefix("points."))
        case "links.alpha":
            return name in (find.links or ())
    return path != "poles.direction"


# ---- numbers as JSON takes them --------------------------------------------------------------------------------------


def json_number(value: Any) -> Any:
    """Convert a number or a vector to JSON: floats as they are, fractions as a string p/q, None as null."""
    if isinstance(value, tuple):
        return [json_number(component) for component in value]
    return str(value) if isinstance(value, Fraction) else None if value is None else value + 0.0


# ---- forces of the machine as it is, with the friction that the scene gives it ---------------------------------------
# What is asked for and not drawn is the solver's; what nobody can tell is null, with the reason.


INDETERMINATE = "statically indeterminate: more unknown reactions than equilibrium equations"


def force_data(report: Report) -> dict[str, Any]:
    """Balances and reactions, and with friction those without it; empty for a scene without loads."""
    if report.given_scene.loads is None:
        return {}
    smooth, indeterminate = _ForceTable(report, report.forces, False), _indeterminate(report.given_scene)
    if report.forces is None or not report.forces.has_friction:
        return {**smooth.data, **indeterminate, **smooth.belts, **screw_data(report)}
    rough = _ForceTable(report, report.forces, True)
    without = {"without_friction": smooth.data, **_friction(report, report.forces)}
    return {**rough.data, **indeterminate, **rough.belts, **screw_data(report), **without}


def screw_data(report: Report) -> dict[str, Any]:
    """The moment on each screw, how much of the power it passes on, and whether a load along its axis turns it."""
    moments, loads = report.results.get(kinds.SCREW, {}), report.given_scene.loads
    screws = {"{} along {}".format(*screw.links): screw for screw in (loads.screws if loads else ())}
    table = {name: {"moment": json_number(moments[name]), "lead_angle": math.degrees(math.atan(screw.slope)),
                    "efficiency": float(screw.slope / screw.circumferential(1)),
                    "efficiency_of_load": float(screw.circumferential(-1) / screw.slope),
                    "self_locking": screw.circumferential(-1) <= 0}
             for name, screw in screws.items() if name in moments}
    return {"screws": table} if table else {}


def force_reasons(report: Report) -> Reasons:
    """Why balances and reactions are null, by their names."""
    if report.forces is None:
        return {}
    printed = _ForceTable(report, report.forces, report.forces.has_friction)
    balances = dict(printed.missing_balances)
    reactions = dict(printed.missing_reactions)
    return {key: named for key, named in (("balance", balances), ("reactions", reactions)) if named}


def solver_only_notes(report: Report) -> list[str]:
    """The forces that are the analytic solver's alone, as they are not drawn."""
    if report.forces is None:
        return []
    names = report.forces.alone
    return [f"analytic solver alone: {', '.join(names)}"] if names else []


@dataclass(frozen=True)
class _ForceTable:
    """The forces of a report with friction or without it."""

    report: Report
    forces: Forces | None
    rubs: bool

    @property
    def data(self) -> dict[str, Any]:
        """Balances, one alone as it is, and reactions."""
        balances = [self.balance(name, self._value(f"balance {name}", "balance", name)) for name in self._balances]
        balance_data = {"balance": balances[0] if len(balances) == 1 else balances} if balances else {}
        return {**balance_data, "reactions": list(self._reactions())}

    @property
    def missing_balances(self) -> Iterator[tuple[str, str]]:
        """Yield the balances without a value, each with the reason."""
        locks = self.forces.locks if self.forces else ""
        return ((name, locks) for name in self._balances if locks and self._values.get(f"balance {name}") is None)

    @property
    def missing_reactions(self) -> Iterator[tuple[str, str]]:
        """Yield the reactions without a value, each with the reason."""
        why = (self.forces.locks if self.forces else "") or INDETERMINATE
        return ((force.name, why) for force in self._requested_reactions if self._values.get(force.name) is None)

    @property
    def _balances(self) -> list[str]:
        """The names of the balances."""
        loads = self.report.given_scene.loads
        return [*loads.named_balances] if loads else []

    @property
    def _values(self) -> Mapping[str, Any]:
        """The numbers, by the names of pairs and balances."""
        return self.forces.values(self.rubs) if self.forces else {}

    def _value(self, name: str, key: str = "reactions", of: str = "") -> Any:
        """A value; None if it is missing."""
        return None if (of or name) in self.report.missing.get(key, {}) else self._values.get(name)

    def balance(self, name: str, value: Any) -> dict[str, Any]:
        """A balance: a moment on a link, or a force at a point of it."""
        assert self.report.given_scene.loads is not None
        balance = self.report.given_scene.loads.named_balances[name]
        key = "force" if balance.at else "moment"
        return {key: json_number(value), "link": balance.link, **({"at": balance.at} if balance.at else {})}

    @property
    def belts(self) -> dict[str, Any]:
        """Of each belt that friction holds: the arc of contact in degrees where it slips first, S_1/S_2 then, and the
        least tensions of its tight and its slack strand; before it runs, each needs half their sum."""
        belts = dict[str, Any]()
        for gear in self.report.given_scene.gears:
            if gear.grip and (pull := self._value(gear.name)) is not None:
                whole = dot(pull, gear.line(self.report.scene.points))
                slack = whole * (1 / (gear.grip.ratio + 1) / gear.grip.along / gear.grip.distance)
                belts[gear.name] = {"arc": math.degrees(gear.grip.arc), "ratio": gear.grip.ratio,
                                    "tight": json_number(slack * gear.grip.ratio), "slack": json_number(slack)}
        return {"belts": belts} if belts else {}

    def _reactions(self) -> Iterator[dict[str, Any]]:
        for reaction in self._requested_reactions:
            yield {**reaction.data, "force": json_number(self._value(reaction.name)),
                   **self._slide_details(reaction.name)}

    @property
    def _requested_reactions(self) -> list[PairForce]:
        """The reactions that are asked for."""
        scene, requested = self.report.given_scene, self.report.given_scene.find.reactions
        return [force for force in pair_forces(scene) if requested is None or force.pair in requested]

    def _slide_details(self, name: str) -> dict[str, Any]:
        """Of a slide's reaction its moment, and a point of its line where that lies near."""
        slide = next((slide for slide in self.report.given_scene.slides if slide.name == name), None)
        if slide is None:
            return {}
        moment = None if self._value(name) is None else self._value(f"moment {name}")
        return {"moment": json_number(moment), **self._acts_at(slide, self._value(name), moment)}

    def _acts_at(self, slide: Slide, force: Any, moment: Any) -> dict[str, Any]:
        """The point where a slide's reaction crosses its guide."""
        arm = self.report.results.get(kinds.SLIDE_ARM, {}).get(slide.name)
        if arm is None or force is None or self.forces is None:
            return {}
        if self.rubs and self.forces.reactions is None:  # of symbols
            return {}
        if self.rubs:
            arm = self.forces.arm(slide, force, moment)
        x, y = self.report.scene.points[slide.at]
        return {"acts_at": json_number((x + arm[0], y + arm[1]))} if arm is not None else {}


def _indeterminate(scene: Scene) -> dict[str, Any]:
    """The pairs whose reactions are asked for, though equilibrium does not tell them."""
    requested = scene.find.reactions
    pair_of = {force.name: force.pair for force in pair_forces(scene)}
    names = [name for name in scene.indeterminate_pairs
             if requested is None or name in requested or pair_of[name] in requested]
    return {"indeterminate": names} if names else {}


def _friction(report: Report, forces: Forces) -> dict[str, Any]:
    """The efficiency with friction, in how many rounds it is drawn, and where further rounds stand."""
    if forces.locks:
        return {}
    friction_data = {"efficiency": json_number(forces.efficiency), "rounds": forces.rounds}
    loads = forces.scene.loads
    if loads and loads.pressed:
        reaches = {"{} along {}".format(*friction.links): friction.length / friction.coefficient / 2
                   for friction in loads.frictions if friction.length}
        friction_data["edges"] = {name: json_number(float(reaches[name])) for name in loads.pressed}
    if not forces.bounded:
        printed, standing = _ForceTable(report, forces, True), forces.by_balance(forces.standing.balances)
        balances = [printed.balance(name, value) for name, value in standing.items()]
        friction_data["stands"] = {"balance": balances, "efficiency": json_number(forces.standing.efficiency)}
    return {"friction": friction_data}
