"""A synthesis for others to read: as numbers, and as a scene for solve, cycle and live."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.replaced import free_name
from graphplan.mechanism.written_scene import new_scene_text
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.paths import posed_scene
from graphplan.synthesis.sketch import Synthesis, pair, place_of
from graphplan.synthesis.stroke import SlottedLever
from graphplan.synthesis.task import SynthesisTask

WHEEL_RADII = {"r_b": "base", "r_a": "tip", "r_f": "root"}

# ---- numbers --------------------------------------------------------------------------------------------------------


def numbers(synthesis: Synthesis, check: Mapping[str, float]) -> dict[str, Any]:
    """All of it, plain data for JSON: lengths in the task's unit, angles in degrees."""
    program = synthesis.values.drawing.program
    return {"title": synthesis.task.title, "units": {"length": synthesis.task.units.length},
            "kind": synthesis.task.kind, "solutions": [solution(linkage) for linkage in synthesis.linkages],
            **synthesis.results, "check": dict(check), "steps": len(program) - program.givens}


def solution(linkage: FoundLinkage) -> dict[str, Any]:
    """The JSON of a synthesized linkage."""
    least, turned = linkage.transmission
    travel = linkage.travel
    return {"points": {name: pair(place) for name, place in linkage.points.items()}, "lengths": linkage.lengths,
            "type": linkage.type, "travel": None if travel is None else list(travel), "defects": [*linkage.defects],
            "transmission": {"least": least, "at": turned}, **linkage.further}


def asked_lengths(synthesis: Synthesis) -> dict[str, float]:
    """The lengths that a task asks for, by their names: of the links of the chosen linkage, or of wheels and arcs."""
    results = synthesis.results
    if synthesis.linkages:
        stated = stated_lengths(synthesis.task)
        return {name: size for name, size in synthesis.linkage.lengths.items() if name not in stated}
    match synthesis.task.kind:
        case "dwell" if "radius" in results:
            return {"r": results["radius"]}
        case "geneva":
            return {"OS": results["crank"], "CS": results["wheel"]}
        case "gear":
            return {f"{name}{k}": wheel[key] for k, wheel in enumerate(results["wheels"], 1)
                    for name, key in WHEEL_RADII.items()}
    return {}


def stated_lengths(task: SynthesisTask) -> set[str]:
    """The lengths of its linkage that a task states."""
    request = task.request
    match task.kind:
        case "stroke" if request.lever:
            return {"O C"}
        case "stroke" if request.rocker:
            return {"B C", "O C"} if isinstance(request.ground, float) else {"B C"}
        case "stroke":
            return {{"offset": "offset", "crank": "O A", "rod": "A B"}[request.given[0]]}
        case "guidance" if request.fixed:
            return {"O C"}
        case "function":
            return {"O C", "offset", "O A"} if request.crank else {"O C", "offset"}
    return set()


# ---- scenes ---------------------------------------------------------------------------------------------------------


def scene_text(synthesis: Synthesis) -> str:
    """The scene of what was found, as TOML."""
    return task_scene_text(synthesis.task, scene_tables(synthesis))


def task_scene_text(task: SynthesisTask, tables: Mapping[str, Any]) -> str:
    """The tables of a scene as TOML, under the title of a task."""
    return new_scene_text(task.title or "Mechanism found", task.source, task.units, tables)


def scene_tables(synthesis: Synthesis) -> dict[str, Any]:
    """The scene of the chosen linkage, or of the wheel; fails with `Refused` if there is no such scene."""
    task = synthesis.task
    if synthesis.linkages:
        return linkage_tables(synthesis.linkage)
    tables = {"dwell": dwell_tables, "geneva": geneva_tables, "gear": gear_tables}.get(task.kind)
    if tables is None or (task.kind == "dwell" and task.request.straight):
        why = {"conjugate": "a profile is no scene", "dwell": "a straight stretch adds no link"}
        chosen = "moving = [{ u = 0, root = 1 }, { u = 2, root = 1 }]"
        raise Refused(f"{task.name}: {task.kind}", why.get(task.kind, "no linkage is chosen"),
                      "the sheet or JSON" if task.kind in why else chosen)
    return tables(synthesis)


def _tables(points: Mapping[str, complex], links: Mapping[str, str], drives: Mapping[str, float], moving: Sequence[str],
            slides: Sequence[tuple[str, str, str, complex | str]] = (), **pairs: Any) -> dict[str, Any]:
    """A scene: slides as link, guide's link, point and direction, drives as link and omega, what else is a pair, and
    the points whose velocities it asks for."""
    keys = "link", "along", "at", "direction"
    return {"points": {name: place + 0j for name, place in points.items()}, "links": links,
            "slides": [dict(zip(keys, slide, strict=True)) for slide in slides], **pairs,
            "drive": [{"link": link, "omega": omega} for link, omega in drives.items()], "find": {"velocity": moving}}


def linkage_tables(linkage: FoundLinkage) -> dict[str, Any]:
    """A four-bar, a slider-crank or a slotted lever."""
    points, carried, drives = linkage.points, [*linkage.carried], {str(linkage.driven): float(linkage.sense)}
    if isinstance(linkage, SlottedLever):
        return _tables(points, {"1": "O A", "2": "A", "3": "C B", FRAME: "O C"}, drives, ["A", "B"],
                       [("2", "3", "A", "C B")])
    O, A, B, *C = linkage.names
    links = {"1": f"{O} {A}", "2": " ".join((A, B, *carried)), "3": f"{B} {C[0]}" if C else B,
             FRAME: f"{O} {C[0]}" if C else O}
    if crank := linkage.further.get("driver"):
        points = points | {name: complex(*place) for name, place in crank["points"].items()}
        links |= {"4": "D K", "5": f"K {A}", FRAME: f"{links[FRAME]} D"}
        drives = {"4": float(crank["sense"])}
    path = {"sheet": {"curves": carried[:1]}} if carried else {}  # of M, through the given positions
    return path | _tables(points, links, drives, [A, B, *carried], [] if C else [("3", FRAME, B, linkage.guide + 0j)])


def dwell_tables(synthesis: Synthesis) -> dict[str, Any]:
    """The scene of the task at the beginning of the range, with the dyad M D E."""
    task, scene = synthesis.task, posed_scene(synthesis.task)
    if len(scene.slides) + len(scene.drives) != len(scene.written):
        raise Refused(f"{task.name}: dwell.scene", "it has gears, contacts or other pairs",
                      "a scene of joints and slides")
    points = {name: complex(*map(float, place)) for name, place in scene.points.items()}
    D, E = (free_name(name, points) for name in "DE")
    points |= {D: place_of(synthesis.values, "D"), E: complex(*task.request.pivot)}
    links = {link: " ".join(names) for link, names in scene.links.items()}
    links[free_name("4", links)] = f"{task.request.point} {D}"
    links |= {free_name("5", links): f"{D} {E}", FRAME: f"{links.get(FRAME, '')} {E}".strip()}
    slides = [(slide.link, slide.along, slide.at, complex(*map(float, slide.direction)) + 0j) for slide in scene.slides]
    fixed = links[FRAME].split()
    moving = [name for name in points if name not in fixed and any(name in names.split() for names in links.values())]
    return _tables(points, links, {drive.link: float(drive.rates[0]) for drive in scene.drives}, moving, slides)


def geneva_tables(synthesis: Synthesis) -> dict[str, Any]:
    """The wheel at entry, its block in the slot."""
    S, C = place_of(synthesis.values, "S"), complex(synthesis.task.request.centres)
    return _tables({"O": 0j, "C": C, "S": S, "S3": S}, {"1": "O S", "2": "S", "3": "C S3", FRAME: "O C"}, {"1": 1.0},
                   ["S", "S3"], [("2", "3", "S", "S3 C")])


def gear_tables(synthesis: Synthesis) -> dict[str, Any]:
    """Make both wheels with their pitch circles in mesh, and a point of each on them."""
    gears = GearPair(synthesis.task.request, synthesis.task.name)
    P, O2 = gears.line["P"], complex(gears.centres)
    mesh = {"links": ["1", "2"], "centres": ["O1", "O2"], "teeth": [*gears.request.teeth],
            **({"internal": True} if gears.request.internal else {})}
    return _tables({"O1": 0j, "O2": O2, "P1": P, "P2": P}, {"1": "O1 P1", "2": "O2 P2", FRAME: "O1 O2"}, {"1": 1.0},
                   ["P1", "P2"], gears=[mesh])
