"""The text of a scene from a sketch: TOML, with comments on what was guessed or could not be determined."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from copy import deepcopy
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from itertools import combinations, count, islice

from graphplan.errors import Refused, SceneError, printable
from graphplan.importing.sketch import LinkageSketch, SketchDrive, drop_loads, tidy
from graphplan.importing.tolerances import LINE_TOL, PLACE_TOL
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.scene import parse
from graphplan.mechanism.scene_text import decimal_text
from graphplan.mechanism.written_scene import toml_key

COORDINATE_DIGITS = 14  # of a coordinate, counted from the size of the sketch
ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
MAX_NUMBER = 1e12
MAX_TEXT_LENGTH = 300  # characters of a comment, a title or a source


def scene(sketch: LinkageSketch, source: str) -> str:
    """A sketch as the text of a scene; `source` says where it is from."""
    points, links = named_points(sketch), named_links(sketch)
    title = sketch.title or "Imported linkage"
    lines = [f"title  = {text(title[:MAX_TEXT_LENGTH])}", f"source = {text(source[:MAX_TEXT_LENGTH])}"]
    if sketch.masses and sketch.gravity:
        lines.append("gravity = [0, -9.81]")
    if lost := remarks(sketch):
        lines += ["", "# Guessed, as the file does not have it:", *(comment(f"- {remark}") for remark in lost)]
    units = {"length": sketch.length, **sketch.units} if sketch.length else sketch.units
    if units:
        lines += ["", "[units]", *(f"{quantity} = {text(unit)}" for quantity, unit in units.items())]
    lines += ["", "[points]", *_points(sketch, points), "", "[links]", *_links(sketch, points, links)]
    for guide in sketch.guides:
        link, along, at = (text(name) for name in (links[guide.link], links[guide.along], points[guide.at]))
        ends = [points[point] for point in guide.way] if isinstance(guide.way, tuple) else []
        if guide.gear:
            lines += ["", "[[gears]]", f"links = [{link}, {along}]", f"centres = [{', '.join(map(text, ends))}]",
                      *guide.gear]
            continue
        direction = text(" ".join(ends)) if ends else _pair(sketch.vector(guide.way), sketch.extent)
        lines += ["", "[[slides]]", f"link = {link}", f"along = {along}", f"at = {at}", f"direction = {direction}"]
    for drive in sketch.drives:
        lines += ["", *_drive(drive, links)]
    return "\n".join([*lines, *_loads(sketch, points, links)]) + "\n"


def remarks(sketch: LinkageSketch) -> list[str]:
    """Return all that was guessed, corrected or left out, item by item."""
    left_out = ", ".join(f"{what} ({count})" for what, count in sketch.left_out.items() if count)
    return [*sketch.notes, *([f"left out, as a scene has no place for it: {left_out}"] if left_out else [])]


def _loads(sketch: LinkageSketch, points: Mapping[str, str], links: Mapping[str, str]) -> Iterator[str]:
    """Masses and forces, and for each drive what keeps its motion against them."""
    for key, mass in sketch.masses.items():
        yield from ("", f"[masses.{toml_key(links[key])}]", f"mass = {number(mass.mass)}",
                    f"inertia = {number(mass.inertia)}", f"centre = {text(points[mass.centre])}")
    for force in sketch.forces:
        yield from ("", "[[forces]]", f"on = {text(links[force.link])}", f"at = {text(points[force.at])}")
        if force.towards:
            magnitude = number(abs(force.value))
            yield from (f"direction = {text(f'{points[force.at]} {points[force.towards]}')}", 'over = "travel"',
                        f"values = [[0, {magnitude}], [360, {magnitude}]]")
        else:
            yield f"value = {_pair(force.value, abs(force.value))}"
    for drive in sketch.drives if _is_loaded(sketch) else ():
        link = text(links[str(drive.link)])
        yield from ("", "[[balance]]")
        guide = next((guide for guide in sketch.guides if drive.slides and guide.link == drive.link
                      and guide.along == drive.on), None)
        yield from [f"link = {link}"] if guide is None else [
            f"at = {text(points[guide.at])}", f"on = {link}",
            f"direction = {_pair(sketch.vector(guide.way), sketch.extent)}"]


def _points(sketch: LinkageSketch, names: Mapping[str, str]) -> Iterator[str]:
    for key, at in sketch.places.items():
        yield f"{toml_key(names[key])} = {_pair(at, sketch.extent)}"


def _links(sketch: LinkageSketch, points: Mapping[str, str], names: Mapping[str, str]) -> Iterator[str]:
    for key, link_points in sketch.links.items():
        yield f"{toml_key(names[key])} = {text(' '.join(points[point] for point in link_points))}"
    if sketch.fixed:
        yield f"{FRAME} = {text(' '.join(points[point] for point in sketch.fixed))}"


def _drive(drive: SketchDrive, links: Mapping[str, str]) -> list[str]:
    remark = [comment(drive.told)] if drive.told else []
    link = links[str(drive.link)]
    if drive.slides:
        return [*remark, "[[drive]]", f"slide = [{text(link)}, {text(links[drive.on])}]", drive.rate]
    relative = [] if drive.on == FRAME else [f"relative_to = {text(links[drive.on])}"]
    return [*remark, "[[drive]]", f"link = {text(link)}", *relative, drive.rate]


# ---- names -----------------------------------------------------------------------------------------------------------


def named_points(sketch: LinkageSketch) -> dict[str, str]:
    """The names of the points: the file's own where they may stand in a scene; those that are taken get numbers, as
    points of different links that coincide do (A2, A3)."""
    result: dict[str, str] = {}
    letters = (letter + (str(round) if round else "") for round in count() for letter in ALPHABET)
    wishes = {key: _name(sketch.names[key]) or _name_there(sketch, key) for key in sketch.places}
    taken = {name for name in wishes.values() if name}
    for key, name in wishes.items():
        wish = name or next(letter for letter in letters if letter not in taken)
        result[key] = _free(wish, result.values(), taken)
        taken.add(result[key])
    return result


def _name_there(sketch: LinkageSketch, key: str) -> str:
    """The name of another point in the same place."""
    return next((_name(sketch.names[neighbour]) for neighbour, at in sketch.places.items()
                 if sketch.names[neighbour] and abs(at - sketch.places[key]) <= PLACE_TOL * sketch.extent), "")


def _name(written: str) -> str:
    """A name without blanks, commas and what cannot be printed; a subscript without its braces."""
    bare = re.sub(r"[\s,\"\\]+", "", re.sub(r"_\{([^{}]*)\}", r"_\1", written))
    return bare[:20] if bare.isprintable() else ""


def _free(name: str, used: object, taken: set[str]) -> str:
    if name not in used:  # type: ignore[operator]
        return name
    return next(f"{name}{k}" for k in count(2) if f"{name}{k}" not in taken)


def named_links(sketch: LinkageSketch) -> dict[str, str]:
    """The names of the links: the file's own, or numbers; the frame is the frame."""
    result: dict[str, str] = {FRAME: FRAME}
    wishes = {key: " ".join(re.sub(r"[\"\\]", "", sketch.called[key]).split())[:30] for key in sketch.links}
    taken = {FRAME, *wishes.values()}
    numbers = (str(k) for k in count(1))
    for key, name in wishes.items():
        if not name or not name.isprintable() or name == FRAME:
            name = next(number for number in numbers if number not in taken)
        result[key] = _free(name, result.values(), taken)
        taken.add(result[key])
    return result


# ---- TOML ------------------------------------------------------------------------------------------------------------


def text(written: str) -> str:
    """A string as TOML has it, on one line."""
    return json.dumps(printable(" ".join(written.split())), ensure_ascii=False)


def comment(told: str) -> str:
    """A comment on one line, of a length that one reads."""
    return f"# {printable(' '.join(told.split()))[:MAX_TEXT_LENGTH]}"


def _pair(value: complex, size: float) -> str:
    return f"[{number(value.real, size)}, {number(value.imag, size)}]"


def number(value: float, size: float = 1.0) -> str:
    """A number as one writes it, without the digits that rounding left, which are beyond those of the size.

    Fails with `ValueError` where it is too large.
    """
    if not abs(value) < MAX_NUMBER:
        raise ValueError(f"the number {value:g} is too large")
    places = COORDINATE_DIGITS - Decimal(abs(size) or 1.0).adjusted()
    return decimal_text(Fraction(round(Decimal(repr(float(value))), min(places, 60)) + 0))


# --- a scene that moves ----------------------------------------------------------------------------------------------


MAX_PROPOSALS = 40  # proposals
GUESS = "omega = 1"


def propose_scene(sketch: LinkageSketch, path: str, source: str) -> tuple[str, list[str]]:
    """Return the text of a scene that can be read, and its remarks.

    Fails with `Refused` where nothing moves as the file has it, or it has nothing that could be a linkage.
    """
    tidy(sketch)
    if not sketch.links:
        raise Refused(path, f"no links are found in this file of {sketch.program}", "bars between points")
    error: SceneError | None = None
    for attempt in islice(_attempts(sketch), MAX_PROPOSALS):
        balanced = not _is_loaded(attempt) or all(drive.on == FRAME for drive in attempt.drives)
        for proposal in [attempt] * balanced + [_without_loads(attempt)] * _is_loaded(attempt):
            text = scene(proposal, source)
            try:
                parse(text, path)
            except SceneError as fault:
                error = error or fault
            else:
                return text, [*remarks(proposal), *(drive.told for drive in proposal.drives if drive.told)]
    if error is None:
        raise Refused(path, f"mobility {sketch.freedoms}: nothing moves", "a linkage with a degree of freedom")
    wrong = error.faults[0]
    raise Refused(path, f"as a scene it has a fault at {wrong.where}: {wrong.what}", wrong.instead)


def _is_loaded(sketch: LinkageSketch) -> bool:
    return bool(sketch.masses or sketch.forces)


def _without_loads(sketch: LinkageSketch) -> LinkageSketch:
    """The sketch without its masses and forces, where no scene balances them."""
    names = named_links(sketch)
    items = [f"mass {number(mass.mass)} and inertia {number(mass.inertia)} of {names[key]}"
             for key, mass in sketch.masses.items()]
    items += [f"force {_pair(force.value, 1.0)} on {names[force.link]}" for force in sketch.forces]
    note = f"left out, as no moment or force of the frame balances such a drive: {', '.join(items)}"
    return replace(sketch, masses={}, forces=[], units={}, notes=[*sketch.notes, note])


def _attempts(sketch: LinkageSketch) -> Iterator[LinkageSketch]:
    """The sketch as it is, and in the ways in which its drives may match its mobility."""
    if not sketch.fixed and all(guide.along != FRAME for guide in sketch.guides):
        for framed in _with_frames(sketch):
            yield from _with_drives(framed)
        return
    yield from _with_drives(sketch)


def _with_drives(sketch: LinkageSketch) -> Iterator[LinkageSketch]:
    missing = sketch.freedoms - len(sketch.drives)
    if sketch.drives:
        yield sketch
    if missing > 0:
        if sketch.drives and not missing % 2:
            yield from _with_fixed_ends(sketch, missing // 2)
        yield from _with_more_drives(sketch, missing)
    elif missing < 0 < sketch.freedoms:
        yield from _with_fewer_drives(sketch, sketch.freedoms)
    elif sketch.freedoms < 1 and not sketch.drives:  # special geometry may move all the same
        yield from _with_more_drives(sketch, 1)


def _with_more_drives(sketch: LinkageSketch, missing: int) -> Iterator[LinkageSketch]:
    """With drives on cranks, the shortest first, or else on what slides on the frame."""
    names = named_links(sketch)
    have = {drive.link for drive in sketch.drives}
    cranks = sorted((key for key, points in sketch.links.items() if key not in have and {*points} & {*sketch.fixed}),
                    key=lambda key: _reach(sketch, key))
    remarks = {key: f"Link {names[key]} drives: a guess, and so is the speed." for key in sketch.links}
    turning = [SketchDrive(key, GUESS, remarks[key]) for key in cranks if len(sketch.links[key]) > 1]
    sliding = [SketchDrive(guide.link, "speed = 1", remarks[guide.link], FRAME, True) for guide in sketch.guides
               if guide.along == FRAME and not guide.gear]
    floating = [SketchDrive(key, GUESS, remarks[key]) for key in sketch.links if key not in {*cranks} | have]
    for more in combinations([*turning, *sliding, *floating], missing):
        drives_text = f"the file tells {len(sketch.drives) or 'no'} drive{'' if len(sketch.drives) == 1 else 's'}"
        yield _with_note(sketch, [*sketch.drives, *more],
                         f"which link drives: mobility {sketch.freedoms}, and {drives_text}")


def _with_fewer_drives(sketch: LinkageSketch, wanted: int) -> Iterator[LinkageSketch]:
    names = named_links(sketch)
    for chosen in combinations(sketch.drives, wanted):
        omitted = [f"link {names[str(drive.link)]} ({drive.rate})" for drive in sketch.drives if drive not in chosen]
        yield _with_note(sketch, [*chosen], f"mobility {wanted}, so of its drives were left out: {', '.join(omitted)}")


def _with_note(sketch: LinkageSketch, drives: list[SketchDrive], note: str) -> LinkageSketch:
    return replace(sketch, drives=drives, notes=[*sketch.notes, note])


def _reach(sketch: LinkageSketch, link: str) -> float:
    """Largest distance of a link's points from its pin on the frame."""
    points = sketch.links[link]
    pins = [point for point in points if point in sketch.fixed]
    return max(abs(sketch.places[point] - sketch.places[pin]) for pin in pins for point in points)


# ---- a frame, where the file tells none ------------------------------------------------------------------------------


def _with_frames(sketch: LinkageSketch) -> Iterator[LinkageSketch]:
    """With the ends of the chain on the frame; of a closed chain with a link as frame: one that lies level, the longest
    first."""
    names = named_points(sketch)
    for freedoms in (1, 2):
        if sketch.freedoms > freedoms and not (sketch.freedoms - freedoms) % 2:
            yield from _with_fixed_ends(sketch, (sketch.freedoms - freedoms) // 2)
    closed = [key for key, points in sketch.links.items() if len(points) > 1]
    for key in sorted(closed, key=lambda key: _level(sketch, key)):
        proposal = deepcopy(sketch)
        points = proposal.links.pop(key)
        proposal.fixed = dict.fromkeys(points)
        proposal.guides = [replace(guide, link=FRAME if guide.link == key else guide.link,
                                   along=FRAME if guide.along == key else guide.along) for guide in proposal.guides]
        proposal.guides = [replace(guide, link=guide.along, along=FRAME)
                           if guide.link == FRAME and not guide.gear else guide
                           for guide in proposal.guides]
        proposal.drives = [drive for drive in proposal.drives if drive.link != key]
        drop_loads(proposal)
        points_text = " ".join(names[point] for point in points)
        proposal.note(f"what is fixed: that the link {points_text} is the frame is a guess")
        yield proposal


def _with_fixed_ends(sketch: LinkageSketch, many: int) -> Iterator[LinkageSketch]:
    """With so many points on the frame that are on one link alone, first those of links with few points."""
    names = named_points(sketch)
    holders = {point: sketch.holders(point) for point in sketch.places}
    ends = sorted((point for point, keys in holders.items() if len(keys) == 1 and keys != [FRAME]), key=lambda point: (
        len(sketch.links[holders[point][0]]), names[point]))
    for chosen in combinations(ends, many):
        proposal = deepcopy(sketch)
        proposal.fixed |= dict.fromkeys(chosen)
        points_text = " and ".join(names[point] for point in chosen)
        proposal.note(f"what is fixed: {points_text} on the frame is a guess, as the chain ends there")
        yield proposal


def _level(sketch: LinkageSketch, link: str) -> tuple[bool, float]:
    start, end = (sketch.places[point] for point in sketch.links[link][:2])
    return abs((end - start).imag) > LINE_TOL * sketch.extent, -abs(end - start)
