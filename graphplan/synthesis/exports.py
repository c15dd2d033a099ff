"""A synthesis for others to read: as numbers, and as a scene for solve, cycle and live."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.paths import posed_scene
from graphplan.synthesis.sketch import Synthesis, pair, place_of
from graphplan.synthesis.stroke import SlottedLever
from graphplan.synthesis.task import SynthesisTask

# ---- numbers --------------------------------------------------------------------------------------------------------


def numbers(synthesis: Synthesis, check: Mapping[str, float]) -> dict[str, Any]:
    """All of it, plain data for JSON: lengths in the task's unit, angles in degrees."""
    program = synthesis.values.drawing.program
    return {"title": synthesis.task.title, "units": {"length": synthesis.task.units.length},
            "kind": synthesis.task.kind, "solutions": [solution(linkage) for linkage in synthesis.linkages],
            **synthesis.results, "check": dict(check), "steps": len(program) - program.givens}


def solution(linkage: FoundLinkage) -> dict[str, Any]:
    """One linkage."""
    least, turned = linkage.transmission
    travel = linkage.travel
    return {"points": {name: pair(place) for name, place in linkage.points.items()}, "lengths": linkage.lengths,
            "type": linkage.type, "travel": None if travel is None else list(travel), "defects": [*linkage.defects],
            "transmission": {"least": least, "at": turned}, **linkage.further}


# ---- scenes ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SceneParts:
    """What a scene is written from: slides as link, guide's link, point and direction, drives as link and omega."""

    points: Mapping[str, complex]
    links: Mapping[str, str]
    drives: Sequence[tuple[str, float]]
    slides: Sequence[tuple[str, str, str, str]] = ()
    gears: Sequence[str] = ()
    moving: Sequence[str] = field(default_factory=tuple)

    def text(self, task: SynthesisTask) -> str:
        """The scene as TOML."""
        return "\n".join(self._lines(task)) + "\n"

    def _lines(self, task: SynthesisTask) -> Iterator[str]:
        yield f"title = {_quoted(task.title or 'Mechanism found')}"
        if task.source:
            yield f"source = {_quoted(task.source)}"
        yield from ("", "[units]", f'length = "{task.units.length}"', "", "[points]")
        yield from (f"{name} = {_vector(place)}" for name, place in self.points.items())
        yield from ("", "[links]", *(f'{link} = "{points}"' for link, points in self.links.items()))
        for link, along, at, way in self.slides:
            yield from ("", "[[slides]]", f'link = "{link}"', f'along = "{along}"', f'at = "{at}"',
                        f"direction = {way}")
        yield from self.gears
        for link, omega in self.drives:
            yield from ("", "[[drive]]", f'link = "{link}"', f"omega = {omega!r}")
        yield from ("", "[find]", f"velocity = [{', '.join(map(_quoted, self.moving))}]")


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _vector(z: complex) -> str:
    return f"[{z.real + 0.0!r}, {z.imag + 0.0!r}]"


def scene_text(synthesis: Synthesis) -> str:
    """The scene of what was found, as TOML."""
    return scene_parts(synthesis).text(synthesis.task)


def scene_parts(synthesis: Synthesis) -> SceneParts:
    """The scene of the chosen linkage, or of the wheel; fails with `Refused` where there is none."""
    task = synthesis.task
    if synthesis.linkages:
        return linkage_parts(synthesis.linkage)
    parts = {"dwell": dwell_parts, "geneva": geneva_parts, "gear": gear_parts}.get(task.kind)
    if parts is None or (task.kind == "dwell" and task.request.straight):
        why = {"conjugate": "a profile is no scene", "dwell": "a straight stretch adds no link"}
        chosen = "moving = [{ u = 0, root = 1 }, { u = 2, root = 1 }]"
        raise Refused(f"{task.name}: {task.kind}", why.get(task.kind, "no linkage is chosen"),
                      "the sheet or JSON" if task.kind in why else chosen)
    return parts(synthesis)


def linkage_parts(linkage: FoundLinkage) -> SceneParts:
    """A four-bar, a slider-crank or a slotted lever."""
    points, carried = linkage.points, [*linkage.carried]
    drives = [(str(linkage.driven), float(linkage.sense))]
    if isinstance(linkage, SlottedLever):
        return SceneParts(points, {"1": "O A", "2": "A", "3": "C B", FRAME: "O C"}, drives,
                          [("2", "3", "A", '"C B"')], moving=["A", "B"])
    O, A, B, *C = linkage.names
    links = {"1": f"{O} {A}", "2": " ".join((A, B, *carried)), "3": f"{B} {C[0]}" if C else B,
             FRAME: f"{O} {C[0]}" if C else O}
    slides = [] if C else [("3", FRAME, B, _vector(linkage.guide))]
    return SceneParts(points, links, drives, slides, moving=[A, B, *carried])


def dwell_parts(synthesis: Synthesis) -> SceneParts:
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
    slides = [(slide.link, slide.along, slide.at, _vector(complex(*map(float, slide.direction))))
              for slide in scene.slides]
    fixed = links[FRAME].split()
    moving = [name for name in points if name not in fixed and any(name in names.split() for names in links.values())]
    drives = [(drive.link, float(drive.rates[0])) for drive in scene.drives]
    return SceneParts(points, links, drives, slides, moving=moving)


def free_name(name: str, taken: Iterable[str]) -> str:
    """A name that is not taken: numbers are counted on, letters get one."""
    letter, number = ("", int(name)) if name.isdigit() else (name, 0)
    while name in taken:
        number += 1
        name = f"{letter}{number}"
    return name


def geneva_parts(synthesis: Synthesis) -> SceneParts:
    """The wheel at entry, its block in the slot."""
    S, C = place_of(synthesis.values, "S"), complex(synthesis.task.request.centres)
    return SceneParts({"O": 0j, "C": C, "S": S, "S3": S}, {"1": "O S", "2": "S", "3": "C S3", FRAME: "O C"},
                      [("1", 1.0)], [("2", "3", "S", '"S3 C"')], moving=["S", "S3"])


def gear_parts(synthesis: Synthesis) -> SceneParts:
    """Both wheels with their pitch circles in mesh, and a point of each on them."""
    gears = GearPair(synthesis.task.request, synthesis.task.name)
    P, O2 = gears.line["P"], complex(gears.centres)
    internal = ["internal = true"] if gears.request.internal else []
    rows = ["", "[[gears]]", 'links = ["1", "2"]', 'centres = ["O1", "O2"]', f"teeth = {[*gears.request.teeth]}",
            *internal]
    points = {"O1": 0j, "O2": O2, "P1": P, "P2": P}
    return SceneParts(points, {"1": "O1 P1", "2": "O2 P2", FRAME: "O1 O2"}, [("1", 1.0)], gears=rows,
                      moving=["P1", "P2"])
