"""Linkages of PMKS and PMKS+: files, and the addresses that the programs keep them in.

| form                          | what it looks like                                                          |
|-------------------------------|-----------------------------------------------------------------------------|
| PMKS text                     | `mech=`, a line for each joint: its links, its type, x, y, angle in degrees |
| PMKS file (.pmks)             | JSON with `Joints`                                                          |
| PMKS+ table (.csv) or address | `joints`, `links`, `forces`, `settings`; `?j=...&l=...&f=...&s=...`         |
| PMKS+ short address           | `?0P.TY.K,0.101.MA,A,0mv,0VU,0.` in letters of base 64, then its checks     |
| PMKS+ of 2025                 | `--- j ---` in tables; `?data=...` packed JSON                              |

Joints are revolute (R), sliding (P), pins in a slot (RP), or where two gears touch (G); the guide or the slot is of
the ground or of another link. A piston of PMKS+ is a link of a revolute joint and a sliding one in the same place.
A field, a section or a version that is not known is refused by its name.

Sources: M. Campbell, PMKS file format 1.0 (2019), and the joints of PMKS; PMKS+, its writers and readers of addresses
and tables (2022, 2023, 2025, 2026).
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections import Counter
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from graphplan.errors import Refused
from graphplan.importing.pmks_records import Joint, Read, reading
from graphplan.importing.pmks_short import read_short_address
from graphplan.importing.pmks_tables import read_long_address, read_packed, read_sections, read_tables
from graphplan.importing.sketch import (
    LinkageSketch,
    SketchDrive,
    SketchForce,
    SketchGuide,
    SketchMass,
    Slot,
    Way,
    absorb,
)
from graphplan.importing.tolerances import LINE_TOL, PISTON_TOL
from graphplan.importing.written import number as number_text
from graphplan.marking.files.safe import Budget, number
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.units import METRES

MAX_JOINTS = 600
ADDRESS = re.compile(r"https?://[^\s?]*\?(\S+)")
STARTS = re.compile(r"^---\s*\w+\s*---|^joints\b|^mech\s*=|^\s*[\w ]+,[\w ]+,\s*(R|P|RP)\s*,", re.MULTILINE)
MASSES = {"in": "lb", "cm": "g"}  # what the program measures masses in beside a length; else kg
INERTIAS = {"in": METRES["in"] ** 2, "cm": 1000 * METRES["cm"] ** 2}  # lb in², and kg cm² beside g; else kg m²


def knows(text: str) -> bool:
    """Whether a text looks like one of the forms."""
    start = text.lstrip()[:2000]
    address = start[:1] != "<" and ADDRESS.search(text)
    return bool(address or STARTS.search(start) or (start[:1] == "{" and '"Joints"' in text))


def read(path: Path, text: str) -> LinkageSketch:
    """The linkage of a file.

    Fails with `Refused` where it is damaged, or has what is not known.
    """
    try:
        linkage = _read(text)
        Budget(path, MAX_JOINTS, "joints").spend(len(linkage.joints))
        return _sketch(linkage)
    except (ValueError, LookupError, TypeError, AttributeError, csv.Error, RecursionError) as error:
        cause = f"{error}" if isinstance(error, ValueError) else "it is incomplete"
        cause = f"{error} is missing" if isinstance(error, KeyError) else " ".join(cause.split())[:160]
        raise Refused(f"{path}", cause, "an address or a file as PMKS or PMKS+ writes it") from None


def _read(text: str) -> Read:
    if address := ADDRESS.search(text):
        linkage = _address(unquote(address[1]))
        linkage.left_out["letters beside the address"] += len("".join(text.split())) - len(address[0])
        return linkage
    start = text.lstrip()
    if start.startswith("{"):
        return _file(json.loads(text))
    if start.startswith("---"):
        return read_sections(text)
    return read_tables(text) if start.startswith("joints") else _lines(text)


def _address(query: str) -> Read:
    if query.startswith("data="):
        return read_packed(query[len("data="):])
    if version := re.match(r"[a-z]+\d+:", query):
        raise ValueError(f"the version {version[0]!r} of addresses is not known")
    return read_long_address(query) if re.search(r"(^|&)j=", query) else read_short_address(query)


# ---- PMKS ------------------------------------------------------------------------------------------------------------


def _file(data: Any) -> Read:
    """A .pmks file: JSON; the driving joint is between two links, or the first that has the ground."""
    keys, joint_keys = {"Name", "Joints", "DrivingIndex", "InputSpeed"}, {"Name", "X", "Y", "TypeOfJoint", "Links",
                                                                          "Angle"}
    driving = int(data.get("DrivingIndex", 0))
    joints = [_old_joint(place, [str(link) for link in joint["Links"]], str(joint["TypeOfJoint"]),
                         complex(float(joint["X"]), float(joint["Y"])), float(joint.get("Angle") or 0),
                         place == driving, str(joint.get("Name", ""))) for place, joint in enumerate(data["Joints"])]
    unread = [*(data.keys() - keys), *(key for joint in data["Joints"] for key in joint.keys() - joint_keys)]
    return Read(joints, rate=f"omega = {number_text(float(data.get('InputSpeed', 0)))}",
                title=str(data.get("Name", "")), left_out=Counter(sorted(unread)))


def _lines(text: str) -> Read:
    """The text of PMKS: a joint a line, or between bars; angles in degrees."""
    joints, settings, left_out = list[Joint](), dict[str, str](), Counter[str]()
    for line in re.split(r"[\n|]", text):
        key, equals, value = line.partition("=")
        if equals:
            settings[key.strip()] = value.strip()
        elif words := [word for word in re.split(r"[,\s]+", line.strip()) if word]:
            with reading(f"joint {len(joints) + 1}"):
                joints.append(_line(len(joints), words, left_out))
    driving, speed = int(settings.pop("d", -1)), settings.pop("s", "")
    if not any(joint.input for joint in joints):
        joints[max(driving, 0)].input = driving >= 0
    title = settings.pop("name", "")
    left_out.update(f"the setting {key}={value}" for key, value in settings.items())
    return Read(joints, rate=f"omega = {number_text(number(speed))}" if speed else "", title=title, left_out=left_out)


def _line(place: int, words: list[str], left_out: Counter[str]) -> Joint:
    """A joint by its words: its links, its kind, two coordinates, an angle in degrees, what is shown and driven."""
    place_of_kind = next((at for at, word in enumerate(words) if word.upper() in ("R", "P", "RP", "G")), 0)
    if not place_of_kind:
        raise ValueError(f"{' '.join(words)!r} tells no links and kind")
    links, kind, numbers = words[:place_of_kind], words[place_of_kind].upper(), words[place_of_kind + 1 :]
    marks = numbers.pop() if numbers and re.fullmatch("[tf]{1,4}", numbers[-1]) else ""
    left_out["marks of what is shown"] += bool(marks)
    left_out["angles of joints that do not slide"] += len(numbers) > 2 and kind not in ("P", "RP")
    if not 2 + (kind in ("P", "RP")) <= len(numbers) <= 3:
        raise ValueError(f"{' '.join(words)!r} has {len(numbers)} numbers; x, y and an angle are known")
    x, y, angle = map(number, [*numbers, "0"][:3])
    return _old_joint(place, links, kind, complex(x, y), math.radians(angle), marks[3:] == "t")


def _old_joint(place: int, links: list[str], kind: str, at: complex, angle: float, is_input: bool,
               name: str = "") -> Joint:
    """A joint of PMKS: the guide of a sliding one, or the slot of a pin, is of the first of its links."""
    kind = kind.upper()
    along, *riders = links if kind in ("P", "RP") and len(links) > 1 else ["", *links]
    if kind == "P" and _is_ground(riders):  # the guide of the first link is what stands still
        along, riders = "", [along]
    return Joint(str(place), name, at, kind, riders, angle, input=is_input, turns=kind == "RP" or len(links) < 2,
                 guide="" if _is_ground([along]) else along)


# ---- what they have in common ----------------------------------------------------------------------------------------


def _sketch(linkage: Read) -> LinkageSketch:
    sketch = LinkageSketch("PMKS", title=linkage.title, length=linkage.unit, gravity=linkage.gravity)
    sketch.left_out, sketch.notes = linkage.left_out, linkage.notes
    if not linkage.unit:
        sketch.note("the unit of length: mm is a guess")
    twins = {joint.key: twin for joint in linkage.joints if joint.kind == "P"
             and (twin := _twin(joint, linkage.joints))}
    for joint in linkage.joints:
        if joint.key in twins and joint.name not in ("", twins[joint.key].name):
            sketch.left_out[f"name {joint.name} of a sliding joint"] += 1
        if joint.key not in twins and joint.kind != "G":
            sketch.point(joint.key, joint.at, joint.name)
            if joint.kind == "R" and (joint.ground or _is_ground(joint.links)):
                sketch.fixed[joint.key] = None
    names = dict.fromkeys(link for joint in linkage.joints for link in [*joint.links, joint.guide]
                          if link and not _is_ground([link]))
    for name in names:
        points = [twins.get(joint.key, joint).key for joint in linkage.joints if name in joint.links
                  and joint.kind != "G"]
        sketch.link(points, name, name)
    for joint in linkage.joints:
        if joint.kind == "G":
            _gear(sketch, joint, linkage.joints)
        elif joint.kind != "R":
            _sliding(sketch, linkage, joint, twins.get(joint.key))
        elif joint.input:
            _turning(sketch, linkage, joint)
    for link, (mass, inertia, centre) in linkage.masses.items():
        if mass or inertia:
            inertia *= float(INERTIAS.get(linkage.unit, 1))
            sketch.masses[link] = SketchMass(mass, inertia, sketch.spot(link, centre, f"S_{link}"))
    for load in linkage.loads:
        if load.link not in sketch.links:
            raise ValueError(f"the force {load.name}: the link {load.link!r} is missing")
        at = sketch.spot(load.link, load.start, load.name)
        end = load.start + load.vector * load.local
        towards = sketch.spot(load.link, end, f"{load.name}_end") if end != load.start else ""
        sketch.forces.append(SketchForce(load.link, at, load.vector, towards))
    if sketch.masses or sketch.forces:
        if not linkage.unit:
            sketch.note("the units of force and mass: N and kg are a guess")
        sketch.units = {"force": "lbf" if linkage.unit == "in" else "N", "mass": MASSES.get(linkage.unit, "kg")}
    elif linkage.gravity:
        sketch.note("gravity: left out, as no link has a mass")
    weld_at = [[link for link in twin.links if link in sketch.links] for twin in twins.values() if twin.welded]
    for weld in [*linkage.welds, *weld_at]:
        first, *merged = [link for link in weld if link in sketch.links] or [""]
        for link in merged:
            absorb(sketch, link, first)
    return sketch


def _twin(joint: Joint, joints: Sequence[Joint]) -> Joint | None:
    """The revolute joint of a piston, in the same place as its sliding joint."""
    least = PISTON_TOL * max(max(abs(candidate.at), abs(candidate.at - joint.at)) for candidate in joints)
    return next((candidate for candidate in joints if candidate.kind == "R" and {*candidate.links} & {*joint.links}
                 and abs(candidate.at - joint.at) <= least), None)


def _is_ground(links: Sequence[str]) -> bool:
    return any(link.lower() == "ground" for link in links)


def _sliding(sketch: LinkageSketch, linkage: Read, joint: Joint, twin: Joint | None) -> None:
    """A link that slides along a guide, or a pin in a slot, with the drive of it."""
    along, at = joint.guide or FRAME, twin.key if twin else joint.key
    way: Way = joint.slot or sketch.heading(joint.angle, f"the guide of {sketch.names[at] or joint.name or 'a joint'}")
    if joint.turns and not twin and not (joint.input or joint.mass):
        if _is_ground(joint.links):
            sketch.fixed[joint.key] = None
        return sketch.slots.append(Slot(joint.key, along, way))
    if twin:
        link = next(link for link in joint.links if link in twin.links)
    else:
        link = sketch.link([joint.key])
        linkage.welds += [] if joint.turns else [[*joint.links, link]]
    if joint.mass:
        linkage.masses[link] = joint.mass, 0.0, joint.at
    sketch.guides.append(SketchGuide(link, along, at, way))
    if joint.input:
        speed = joint.speed or linkage.speed
        sketch.drives.append(SketchDrive(link, f"speed = {number_text(speed or 1.0)}", "" if speed else
                                         "A sliding input: its speed is a guess.", along, True))
    return None


def _gear(sketch: LinkageSketch, joint: Joint, joints: Sequence[Joint]) -> None:
    """Two gears touch in a joint: each turns about a pin on the line through it."""
    pins = [[pin for pin in joints if pin.kind == "R" and link in pin.links] for link in joint.links[:2]]
    for first, second in product(*pins):
        line = second.at - first.at
        share = (joint.at - first.at) / line if line else 1j
        if abs(share.imag) > LINE_TOL:
            continue
        sizes, inner = (abs(share.real * line), abs((1 - share.real) * line)), not 0 < share.real < 1
        links = [FRAME if _is_ground([link]) else link for link in joint.links]
        wheels = [*zip(sizes, links, (first.key, second.key), strict=False)]
        (radius, link, at), (ring, on, far) = sorted(wheels) if inner else wheels
        radii = f"radii = [{number_text(radius, sketch.extent)}, {number_text(ring, sketch.extent)}]"
        return sketch.guides.append(SketchGuide(link, on, at, (at, far), (radii, *["internal = true"] * inner)))
    return sketch.note(f"a gear joint at ({joint.at.real:g}, {joint.at.imag:g}) of {' '.join(joint.links)}: left out")


def _turning(sketch: LinkageSketch, linkage: Read, joint: Joint) -> None:
    """The drives of a revolute joint that is an input."""
    links = [link for link in joint.links if link in sketch.links]
    rate = f"rpm = {number_text(joint.speed)}" if joint.speed else linkage.rate
    guess = "" if rate and rate != "omega = 0" else "The file tells no speed: 1 rad/s is a guess."
    rate = "omega = 1" if guess else rate
    if joint.ground or _is_ground(joint.links):
        sketch.drives += [SketchDrive(link, rate, guess) for link in links]
    elif len(links) == 2:
        sketch.drives.append(SketchDrive(links[1], rate, guess, links[0]))
    else:
        sketch.note(f"the input at {joint.name or 'a joint'} between {len(links)} links: left out")
