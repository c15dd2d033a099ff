"""A scene as the board shows it, also one that is not yet a mechanism: its objects with their places, and its faults.

A fault names what it is about by its place in the scene, such as points.A or drive.1.link: the board shows it beside
that object, and in the text at that line.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from graphplan.errors import Fault, Refused, SceneError
from graphplan.mechanism.model import FRAME, Drive, Gear, Scene, Slide, SlidingDrive, TurningDrive
from graphplan.mechanism.numbers import Pair
from graphplan.mechanism.placements import needs
from graphplan.mechanism.scene import incomplete_scene, tables_of
from graphplan.mechanism.scene_text import entry_lines, path_parts
from graphplan.mechanism.units import Units
from graphplan.mechanism.written_scene import parse
from graphplan.words import LANGUAGES

Data = dict[str, Any]
KINDS = {"points": "point", "links": "link", "masses": "link", "motion": "point"}  # of objects that have names
ROWS = {"slides": "slide", "drive": "drive", "forces": "force", "gears": "gear", "contacts": "contact",
        "moments": "moment", "springs": "spring"}  # of objects in lists
STARTED = ("links", "points", "drive", "file", "balance")  # where something is only missing, as in any half-drawn scene


def scene_data(text: str, name: str) -> Data:
    """The objects of a scene and its faults; the objects are None where the text is no TOML."""
    faults = scene_faults(text, name)
    try:
        scene = incomplete_scene(text, name) if text.strip() else None
    except SceneError:
        return {"objects": None, "faults": [fault_data(fault, text, None) for fault in faults]}
    return {"objects": objects_data(scene), "faults": [fault_data(fault, text, scene) for fault in faults]}


def scene_faults(text: str, name: str) -> tuple[Fault, ...]:
    """The faults of a scene; an empty text, with which a drawing begins, has none."""
    try:
        if text.strip():
            parse(text, name)
    except SceneError as error:
        return error.faults
    except Refused as refused:
        return (Fault(refused.what.removeprefix(f"{name}: "), refused.why, refused.do),)
    return ()


def fault_data(fault: Fault, text: str, scene: Scene | None) -> Data:
    """A fault in the command's words, the object that it names, its line in the text, and whether something is only
    missing there, as in any drawing that is not finished."""
    place = path_parts(fault.where)
    table, *names = place or ("",)
    is_sound = scene is not None and len(names) == 1 and (
        names[0] in scene.points if table == "points" else table == "links" and bool(scene.links.get(names[0])))
    return {"text": str(fault), "object": fault_object(place), "line": fault_line(fault.where, place, text),
            "missing": table in STARTED and (not names or is_sound)}


def fault_object(place: tuple[str, ...]) -> list[str | int] | None:
    """The kind and the name, or place, of the object that a fault's place leads to."""
    table, *more = place or ("",)
    if table in KINDS and more:
        return [KINDS[table], more[0]]
    if table in ROWS and more and more[0].isdecimal():
        return [ROWS[table], int(more[0]) - 1]
    return [ROWS[table], 0] if table in ROWS else None


def fault_line(where: str, place: tuple[str, ...], text: str) -> int | None:
    """The line, counted from 1, of the longest beginning of a fault's place that stands in the text."""
    if where.startswith("line "):
        number = where.removeprefix("line ").partition(",")[0]
        return int(number) if number.isdecimal() else None
    lines, counts = dict[tuple[str, ...], int](), Counter[tuple[str, ...]]()
    for line, sort, path in entry_lines(text):
        lines.setdefault(path, line)
        if sort == "[[":
            counts[path] += 1
            lines.setdefault((*path, f"{counts[path]}"), line)
    return next((lines[place[:end]] for end in range(len(place), 0, -1) if place[:end] in lines), None)


def objects_data(scene: Scene | None) -> Data:
    """The objects of a scene, with floats for their places."""
    if scene is None:
        return {"points": {}, "links": {}, "slides": [], "drives": [], "forces": [], "masses": {}, "gears": [],
                "contacts": [], "title": "", "language": "", "units": vars(Units())}
    loads = scene.loads
    return {
        "title": scene.title, "language": written_language(scene.text),
        "units": vars(scene.units),
        "points": dict(_points(scene)), "links": dict(_links(scene)),
        "slides": [_slide(slide) for slide in scene.slides],
        "drives": [_drive(drive) for drive in scene.drives],
        "forces": [{"on": force.on, "at": force.at, "value": vector(force.value)}
                   for force in (loads.forces if loads else ())],
        "masses": {link: float(mass.mass) for link, mass in (loads.masses if loads else {}).items()},
        "gears": [_gear(gear, scene) for gear in scene.gears],
        "contacts": [{"links": [*contact.links], "at": contact.at} for contact in scene.contacts],
    }


def written_language(text: str) -> str:
    """The language that a scene's [sheet] asks for; empty where it asks for none."""
    with suppress(SceneError):
        sheet = tables_of(text, "scene").get("sheet")
        if isinstance(sheet, dict) and sheet.get("language") in LANGUAGES:
            return str(sheet["language"])
    return ""


def vector(pair: Pair | None) -> list[float] | None:
    """A pair of numbers as floats; None of one that is too large, or not known."""
    if pair is None:
        return None
    try:
        x, y = float(pair[0]), float(pair[1])
    except (OverflowError, TypeError, ValueError):
        return None
    return [x, y] if math.isfinite(x) and math.isfinite(y) else None


def _points(scene: Scene) -> Iterator[tuple[str, Data]]:
    fixed = {*scene.links.get(FRAME, ())}
    for name, pair in scene.points.items():
        at, placement = vector(pair), scene.placements.get(name)
        if at is None:
            continue
        find = scene.find
        yield name, {
            "at": at, "fixed": name in fixed, "how": placement.how if placement else "",
            "from": [*needs(placement)] if placement else [], "locked": _locked_lengths(placement),
            "asked": not find.by_default and (name in find.velocity or name in find.acceleration)}


def _locked_lengths(placement: Any) -> Data:
    """The lengths that a placement keeps, by the point to which."""
    data = placement.data if placement else {}
    lengths = dict(data.get("distances", {})) if isinstance(data.get("distances"), dict) else {}
    if "from" in data and "distance" in data:
        lengths[data["from"]] = data["distance"]
    return {name: float(length) for name, length in lengths.items()}


def _links(scene: Scene) -> Iterator[tuple[str, Data]]:
    """The links; of a faulty one those of its points that there are."""
    written = tables_of(scene.text, scene.name).get("links")
    for name, points in scene.links.items():
        shown, words = str(scene.frame_name) if name == FRAME else name, ""
        if not points and isinstance(written, dict):
            words = str(written.get(shown, ""))
        yield shown, {"points": [*points] or [word for word in words.split() if word in scene.points],
                      "frame": name == FRAME}


def _slide(slide: Slide) -> Data:
    return {"link": slide.link, "along": slide.along, "at": slide.at, "direction": vector(slide.direction),
            "through": [*slide.through] if slide.through else None}


def _drive(drive: Drive) -> Data:
    data: Data = {"link": drive.link, "on": drive.on, "slides": isinstance(drive, SlidingDrive),
                  "rate": float(drive.rate), "change": float(drive.change)}
    if isinstance(drive, TurningDrive) and drive.rpm is not None:
        data["rpm"] = float(drive.rpm)
    return data


def _gear(gear: Gear, scene: Scene) -> Data:
    return {"links": [*gear.links], "centres": [*gear.centres], "radii": _radii(gear, scene)}


def _radii(gear: Gear, scene: Scene) -> list[float]:
    """The radii of the pitch circles; none where the centres are not known."""
    places = [scene.points[centre] for centre in gear.centres if centre in scene.points]
    if len(places) < len(gear.centres):
        return []
    try:
        return [abs(radius) for radius in gear.pitch_radii(scene.points) or ()]
    except (ZeroDivisionError, OverflowError):
        return []
