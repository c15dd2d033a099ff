"""Scenes: a mechanism read from TOML text, checked as a whole, all its faults told at once."""

from __future__ import annotations

import os
import re
import sys
import tomllib
from collections import Counter
from dataclasses import replace
from errno import EBADF
from fractions import Fraction

from graphplan.errors import Fault, SceneError
from graphplan.mechanism.checks import check_connections, check_joints, check_mobility, check_use
from graphplan.mechanism.directions import points_of
from graphplan.mechanism.faults import Faults, perhaps
from graphplan.mechanism.items import Item, quoted
from graphplan.mechanism.loads import TABLES as LOADS
from graphplan.mechanism.loads import check_loads, read_loads, read_reactions
from graphplan.mechanism.model import FRAME, Find, Pair, Placement, Presentation, Scene, Slide, Units
from graphplan.mechanism.numerals import decimal
from graphplan.mechanism.placements import is_exact, needs, place, read_placement
from graphplan.mechanism.sections import (
    Names,
    moving_links,
    read_asked,
    read_drives,
    read_links,
    read_motions,
    read_question,
    read_slides,
    read_units,
)

_TABLES = ("title", "source", "gravity", "units", "points", "links", "slides", "drive", "motion", "find", "sheet")


def load(source: str | os.PathLike[str], name: str | None = None) -> Scene:
    """The scene in a file, on standard input (`-`), or packaged under this name.

    Fails with a :class:`SceneError` that has one line for each fault.
    """
    written = os.fspath(source)
    name = written if name is None else name
    try:
        return parse(_bytes(written).decode("utf-8-sig"), name)
    except UnicodeDecodeError as error:
        fault = Fault("file", f"byte {error.start + 1} is not UTF-8", "text saved as UTF-8")
    except IsADirectoryError:
        fault = Fault("file", "this is a directory", "a scene file")
    except FileNotFoundError:
        packaged = [entry.name.removesuffix(".toml") for entry in _packaged()]
        instead = (
            perhaps(written, packaged, "scene") if packaged else "the path of a scene file, or - for standard input"
        )
        fault = Fault("file", "no such file and no packaged scene", instead)
    except (OSError, ValueError) as error:  # ValueError: a path that no file system has
        fault = Fault("file", f"it cannot be read ({getattr(error, 'strerror', None) or error})", "a readable file")
    raise SceneError(name, (fault,))


def _bytes(source: str) -> bytes:
    if source == "-":
        if sys.stdin is None:
            raise OSError(EBADF, "standard input is closed")
        return sys.stdin.buffer.read()
    for entry in _packaged():
        if entry.name == f"{source}.toml" and not os.path.exists(source):
            source = os.fspath(entry)
            break
    with open(source, "rb") as file:
        return file.read()


def packaged() -> list[str]:
    """The names of the packaged scenes, in alphabetical order."""
    return sorted(entry.name.removesuffix(".toml") for entry in _packaged())


def _packaged() -> list[os.DirEntry[str]]:
    folder = os.path.join(os.path.dirname(os.path.dirname(__file__)), "scenes")
    return [entry for entry in os.scandir(folder) if entry.name.endswith(".toml")]


def parse(text: str, name: str) -> Scene:
    """The scene that a TOML text says; `name` stands in error lines."""
    faults = Faults()
    scene = _read(_toml(text, name), name, faults)
    if len(faults):
        from graphplan.mechanism.slips import slips_in_vectors  # few scenes have faults

        for slip in slips_in_vectors(text):
            faults.add(*slip)
        raise SceneError(name, faults.found)
    return replace(scene, text=text)


def _toml(text: str, name: str) -> dict[str, object]:
    """The text's tables, its decimals as exact numbers."""
    if not text.strip():
        raise SceneError(name, (Fault("file", "it is empty", "a scene with [points], [links] and [[drive]]"),))
    try:
        return tomllib.loads(text, parse_float=decimal)
    except RecursionError:
        fault = Fault("file", "tables or lists are nested too deeply", "a scene as the manual shows it")
    except ValueError as error:
        from graphplan.mechanism.slips import slip_in_line  # few scenes have faults

        # a numeral that Python refuses to read has no place of its own
        told = re.fullmatch(r"(.*) \(at (.*)\)", str(error), re.DOTALL)
        what, where = (told[1], told[2].replace("end of document", "end of file")) if told else (str(error), "file")
        line = re.match(r"line (\d+)", where)
        slip = slip_in_line(text.splitlines()[int(line[1]) - 1]) if line else None
        fault = Fault(where, *(slip or (f"this is no TOML: {what}", "text that follows toml.io")))
    raise SceneError(name, (fault,))


def _read(tables: dict[str, object], name: str, faults: Faults) -> Scene:
    """The whole scene; where something is faulty the scene is patched up, and only good for finding more faults."""
    items = _top(tables, faults)
    table = items["points"]
    points = table.table() or {}
    placements = _placements(points, table)
    placed = place(placements, table)
    names = Names(tuple(points), placed, read_links(items["links"], points))
    slides = read_slides(items["slides"], names)
    drives = read_drives(items["drive"], names, slides)
    motions = read_motions(items["motion"], names)
    units = read_units(items["units"])
    scene = Scene(
        title=_text(items.get("title")),
        source=_text(items.get("source")),
        name=name,
        units=units,
        points={point: placed.get(point, (Fraction(0), Fraction(0))) for point in points},
        placements={point: placements[point] for point in points if point in placements},
        links=names.links,
        slides=slides,
        drives=drives,
        motions=motions,
        find=_find(items.get("find"), names, slides),
        loads=read_loads(items, names, slides),
        sheet=_presentation(items.get("sheet"), units),
    )
    rounded = [f"points.{quoted(point)}: {placements[point].how} placement" for point in points
               if point in placed and point in _counting(scene) and not is_exact(placed[point])]
    return _checked(replace(scene, irrational=(*rounded, *names.irrational)), placed, faults)


def _counting(scene: Scene) -> set[str]:
    """The points on whose coordinates results depend: others place points, or are points of links that nothing uses.

    Loads may be laid off from any point of a link.
    """
    loads = scene.loads
    found = {*scene.joints, *scene.motions, *scene.find.velocity, *scene.find.acceleration}
    for slide in scene.slides:
        found |= {slide.at, *(slide.through or ())}
    if loads is not None:
        found |= {point for points in scene.links.values() for point in points}
        found |= {point for balance in loads.balances for point in points_of(balance.written or "")}
    return found


def _top(tables: dict[str, object], faults: Faults) -> dict[str, Item]:
    """The top-level tables; those that are left out are there and empty, except those whose absence says something."""
    empty: dict[str, object] = {"units": {}, "points": {}, "links": {}, "slides": [], "drive": [], "motion": {}}
    items = Item({**empty, **tables}, "", faults).fields((*_TABLES, *LOADS), {}) or {}
    for key, such in (("points", "A = [0, 0]"), ("links", '1 = "O A"')):
        if not items[key].value:
            items[key].fault(f"the scene has no {key}", f"[{key}] with entries such as {such}")
    return items


def _placements(points: dict[str, Item], table: Item) -> dict[str, Placement]:
    placements: dict[str, Placement] = {}
    for point, item in points.items():
        if "," in point or point.split() != [point] or not point.isprintable():
            item.fault("a point's name is empty or has blanks or commas", "a name without them, such as A2")
        placement = read_placement(item, points)
        if placement is not None:
            placements[point] = placement
    return placements


def _text(item: Item | None) -> str:
    return (item.text("a text", "a text in quotes") or "") if item else ""


def _presentation(item: Item | None, units: Units) -> Presentation:
    """How the sheet should look; few scenes say."""
    if item is None:
        return Presentation()
    from graphplan.mechanism.presentation import read_presentation

    return read_presentation(item, units)


def _find(item: Item | None, names: Names, slides: tuple[Slide, ...]) -> Find:
    """What is asked for: if nothing is said, velocity and acceleration of every joint that can move, or where there is
    none of every point that can, and the rates of every link."""
    if item is not None:
        fields = item.fields(("velocity", "acceleration", "links", "slides", "reactions"), {}) or {}
        return Find(
            read_question(fields["velocity"], names) if "velocity" in fields else (),
            read_question(fields["acceleration"], names) if "acceleration" in fields else (),
            read_reactions(fields["reactions"], names, slides) if "reactions" in fields else None,
            read_asked(fields["links"], "link", moving_links(names)) if "links" in fields else None,
            read_asked(fields["slides"], "slide", [s.name for s in slides], "slides") if "slides" in fields else None,
        )
    fixed = names.links.get(FRAME, ())
    named = Counter(point for points in names.links.values() for point in points)
    at = {slide.at for slide in slides}
    movable = [p for p in names.points if named[p] and p not in fixed]
    moving = tuple(p for p in movable if named[p] > 1 or p in at) or tuple(movable)
    return Find(moving, moving, links=moving_links(names))


def _checked(scene: Scene, placed: dict[str, Pair], faults: Faults) -> Scene:
    """The scene after the checks of the whole, each where what it rests on has no faults of its own."""
    if not faults.none_in("links"):
        return scene
    guides = {point for slide in scene.slides for point in slide.through or ()}
    centres = {point for placement in scene.placements.values() for point in needs(placement)}
    if faults.none_in("points", "slides"):
        check_use(scene, guides | centres, faults)
    if not scene.moving:
        faults.add("links", "no link moves", 'a link besides the frame, such as 1 = "O A"')
    elif faults.none_in("links", "slides", "drive", "motion"):
        check_connections(scene, faults)
        if faults.none_in("links"):
            scene = check_mobility(scene, faults)
        if faults.none_in("links", "drive", *LOADS):
            check_loads(scene, faults)
    check_joints(scene, placed, faults)
    return scene

