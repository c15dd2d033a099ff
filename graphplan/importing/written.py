"""The text of a scene from a sketch: TOML, with comments on what was guessed and what could not be told."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from fractions import Fraction
from itertools import count

from graphplan.errors import printable
from graphplan.importing.sketch import Driven, Sketch
from graphplan.importing.tolerances import PLACE_TOL
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.scene_text import written

BARE = re.compile(r"[A-Za-z0-9_-]+")
DIGITS = 14  # of a coordinate, counted from the size of the sketch
ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
LARGEST = 1e12
LONGEST = 300  # characters of a comment, a title or a source


def scene(sketch: Sketch, source: str) -> str:
    """A sketch as the text of a scene; `source` says where it is from."""
    points, links = named_points(sketch), named_links(sketch)
    title = sketch.title or "Imported linkage"
    lines = [f"title  = {text(title[:LONGEST])}", f"source = {text(source[:LONGEST])}"]
    if sketch.notes:
        lines += ["", "# What could not be told from the file:", *(comment(f"- {note}") for note in sketch.notes)]
    if sketch.length:
        lines += ["", "[units]", f"length = {text(sketch.length)}"]
    lines += ["", "[points]", *_points(sketch, points), "", "[links]", *_links(sketch, points, links)]
    for guide in sketch.guides:
        way = guide.way
        direction = text(f"{points[way[0]]} {points[way[1]]}") if isinstance(way, tuple) else _pair(way, sketch.size)
        lines += ["", "[[slides]]", f"link = {text(links[guide.link])}", f"along = {text(links[guide.along])}",
                  f"at = {text(points[guide.at])}", f"direction = {direction}"]
    for drive in sketch.drives:
        lines += ["", *_drive(drive, links)]
    return "\n".join(lines) + "\n"


def _points(sketch: Sketch, names: Mapping[str, str]) -> Iterator[str]:
    for key, at in sketch.places.items():
        yield f"{_key(names[key])} = {_pair(at, sketch.size)}"


def _links(sketch: Sketch, points: Mapping[str, str], names: Mapping[str, str]) -> Iterator[str]:
    for key, held in sketch.links.items():
        yield f"{_key(names[key])} = {text(' '.join(points[point] for point in held))}"
    if sketch.fixed:
        yield f"{FRAME} = {text(' '.join(points[point] for point in sketch.fixed))}"


def _drive(drive: Driven, links: Mapping[str, str]) -> list[str]:
    told = [comment(drive.told)] if drive.told else []
    link = links[str(drive.link)]
    if drive.slides:
        return [*told, "[[drive]]", f"slide = [{text(link)}, {text(links[drive.on])}]", drive.rate]
    relative = [] if drive.on == FRAME else [f"relative_to = {text(links[drive.on])}"]
    return [*told, "[[drive]]", f"link = {text(link)}", *relative, drive.rate]


# ---- names -----------------------------------------------------------------------------------------------------------


def named_points(sketch: Sketch) -> dict[str, str]:
    """The names of the points: the file's own where they may stand in a scene; those that are taken get numbers, as
    points of different links that coincide do (A2, A3)."""
    found: dict[str, str] = {}
    letters = (letter + (str(round) if round else "") for round in count() for letter in ALPHABET)
    wanted = {key: _name(sketch.names[key]) or _name_there(sketch, key) for key in sketch.places}
    taken = {name for name in wanted.values() if name}
    for key, name in wanted.items():
        own = name or next(letter for letter in letters if letter not in taken)
        found[key] = _free(own, found.values(), taken)
        taken.add(found[key])
    return found


def _name_there(sketch: Sketch, key: str) -> str:
    """The name of another point in the same place."""
    return next((_name(sketch.names[other]) for other, at in sketch.places.items()
                 if sketch.names[other] and abs(at - sketch.places[key]) <= PLACE_TOL * sketch.size), "")


def _name(written: str) -> str:
    """A name without blanks, commas and what cannot be printed; a subscript without its braces."""
    bare = re.sub(r"[\s,\"\\]+", "", re.sub(r"_\{([^{}]*)\}", r"_\1", written))
    return bare[:20] if bare.isprintable() else ""


def _free(name: str, used: object, taken: set[str]) -> str:
    if name not in used:  # type: ignore[operator]
        return name
    return next(f"{name}{k}" for k in count(2) if f"{name}{k}" not in taken)


def named_links(sketch: Sketch) -> dict[str, str]:
    """The names of the links: the file's own, or numbers; the frame is the frame."""
    found: dict[str, str] = {FRAME: FRAME}
    own = {key: " ".join(re.sub(r"[\"\\]", "", sketch.called[key]).split())[:30] for key in sketch.links}
    taken = {FRAME, *own.values()}
    numbers = (str(k) for k in count(1))
    for key, name in own.items():
        if not name or not name.isprintable() or name == FRAME:
            name = next(number for number in numbers if number not in taken)
        found[key] = _free(name, found.values(), taken)
        taken.add(found[key])
    return found


# ---- TOML ------------------------------------------------------------------------------------------------------------


def text(written: str) -> str:
    """A string as TOML has it, on one line."""
    return json.dumps(printable(" ".join(written.split())), ensure_ascii=False)


def comment(told: str) -> str:
    """A comment on one line, of a length that one reads."""
    return f"# {printable(' '.join(told.split()))[:LONGEST]}"


def _key(name: str) -> str:
    return name if BARE.fullmatch(name) else text(name)


def _pair(value: complex, size: float) -> str:
    return f"[{number(value.real, size)}, {number(value.imag, size)}]"


def number(value: float, size: float = 1.0) -> str:
    """A number as one writes it, without the digits that rounding left, which are beyond those of the size.

    Fails with `ValueError` where it is too large.
    """
    if not abs(value) < LARGEST:
        raise ValueError(f"the number {value:g} is too large")
    places = DIGITS - Decimal(abs(size) or 1.0).adjusted()
    return written(Fraction(round(Decimal(repr(float(value))), min(places, 60)) + 0))
