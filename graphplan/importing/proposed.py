"""A scene that moves, from a sketch: its drives, and where they do not match its mobility a proposal that does.

What is proposed is tried by reading it as a scene, in the order of what is likeliest: drives that are too many are
left out, those that are missing are put on the shortest cranks, and a frame that the file does not tell is where the
chain ends, or the link that lies level. Each proposal says in a comment that it is one.
"""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import replace
from itertools import combinations, islice

from graphplan.errors import Refused, SceneError
from graphplan.importing.sketch import Driven, Sketch, tidied
from graphplan.importing.tolerances import LINE_TOL
from graphplan.importing.written import named_links, named_points, scene
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.scene import parse

TRIED = 40  # proposals
GUESS = "omega = 1"


def proposed(sketch: Sketch, path: str, source: str) -> str:
    """The text of a scene that can be read.

    Fails with `Refused` where nothing moves as the file has it, or it has nothing that could be a linkage.
    """
    tidied(sketch)
    if not sketch.links:
        raise Refused(path, f"no links are found in this file of {sketch.program}", "bars between points")
    error: SceneError | None = None
    for attempt in islice(_attempts(sketch), TRIED):
        text = scene(attempt, source)
        try:
            parse(text, path)
        except SceneError as fault:
            error = error or fault
        else:
            return text
    if error is None:
        raise Refused(path, f"mobility {sketch.freedoms}: nothing moves", "a linkage with a degree of freedom")
    wrong = error.faults[0]
    raise Refused(path, f"as a scene it has a fault at {wrong.where}: {wrong.what}", wrong.instead)


def _attempts(sketch: Sketch) -> Iterator[Sketch]:
    """The sketch as it is, and in the ways in which its drives may match its mobility."""
    if not sketch.fixed:
        for framed in _framed(sketch):
            yield from _driven(framed)
        return
    yield from _driven(sketch)


def _driven(sketch: Sketch) -> Iterator[Sketch]:
    missing = sketch.freedoms - len(sketch.drives)
    if sketch.drives:
        yield sketch
    if missing > 0:
        if sketch.drives and not missing % 2:
            yield from _ended(sketch, missing // 2)
        yield from _more(sketch, missing)
    elif missing < 0 < sketch.freedoms:
        yield from _fewer(sketch, sketch.freedoms)
    elif sketch.freedoms < 1 and not sketch.drives:  # special geometry may move all the same
        yield from _more(sketch, 1)


def _more(sketch: Sketch, missing: int) -> Iterator[Sketch]:
    """With drives on cranks, the shortest first, or else on what slides on the frame."""
    names = named_links(sketch)
    have = {drive.link for drive in sketch.drives}
    cranks = sorted((key for key, points in sketch.links.items() if key not in have and {*points} & {*sketch.fixed}),
                    key=lambda key: _reach(sketch, key))
    told = {key: f"Link {names[key]} drives: a guess, and so is the speed." for key in sketch.links}
    turning = [Driven(key, GUESS, told[key]) for key in cranks if len(sketch.links[key]) > 1]
    sliding = [Driven(one.link, "speed = 1", told[one.link], FRAME, True) for one in sketch.guides
               if one.along == FRAME]
    others = [Driven(key, GUESS, told[key]) for key in sketch.links if key not in {*cranks} | have]
    for more in combinations([*turning, *sliding, *others], missing):
        given = f"the file tells {len(sketch.drives) or 'no'} drive{'' if len(sketch.drives) == 1 else 's'}"
        yield _with(sketch, [*sketch.drives, *more], f"which link drives: mobility {sketch.freedoms}, and {given}")


def _fewer(sketch: Sketch, wanted: int) -> Iterator[Sketch]:
    names = named_links(sketch)
    for kept in combinations(sketch.drives, wanted):
        left = [f"link {names[str(drive.link)]} ({drive.rate})" for drive in sketch.drives if drive not in kept]
        yield _with(sketch, [*kept], f"mobility {wanted}, so of its drives were left out: {', '.join(left)}")


def _with(sketch: Sketch, drives: list[Driven], note: str) -> Sketch:
    return replace(sketch, drives=drives, notes=[*sketch.notes, note])


def _reach(sketch: Sketch, link: str) -> float:
    """How far a link reaches from its pin on the frame."""
    points = sketch.links[link]
    pins = [point for point in points if point in sketch.fixed]
    return max(abs(sketch.places[one] - sketch.places[pin]) for pin in pins for one in points)


# ---- a frame, where the file tells none ------------------------------------------------------------------------------


def _framed(sketch: Sketch) -> Iterator[Sketch]:
    """With the ends of the chain on the frame; of a closed chain with a link as frame: one that lies level, the longest
    first."""
    names = named_points(sketch)
    for freedoms in (1, 2):
        if sketch.freedoms > freedoms and not (sketch.freedoms - freedoms) % 2:
            yield from _ended(sketch, (sketch.freedoms - freedoms) // 2)
    closed = [key for key, points in sketch.links.items() if len(points) > 1]
    for key in sorted(closed, key=lambda key: _level(sketch, key)):
        found = deepcopy(sketch)
        points = found.links.pop(key)
        found.fixed = dict.fromkeys(points)
        found.guides = [replace(one, link=FRAME if one.link == key else one.link,
                                along=FRAME if one.along == key else one.along) for one in found.guides]
        found.guides = [replace(one, link=one.along, along=FRAME) if one.link == FRAME else one
                        for one in found.guides]
        found.drives = [one for one in found.drives if one.link != key]
        told = " ".join(names[point] for point in points)
        found.note(f"what is fixed: that the link {told} is the frame is a guess")
        yield found


def _ended(sketch: Sketch, many: int) -> Iterator[Sketch]:
    """With so many points on the frame that are on one link alone, first those of links with few points."""
    names = named_points(sketch)
    held = {point: sketch.holders(point) for point in sketch.places}
    ends = sorted((point for point, keys in held.items() if len(keys) == 1 and keys != [FRAME]), key=lambda point: (
        len(sketch.links[held[point][0]]), names[point]))
    for way in combinations(ends, many):
        found = deepcopy(sketch)
        found.fixed |= dict.fromkeys(way)
        told = " and ".join(names[point] for point in way)
        found.note(f"what is fixed: {told} on the frame is a guess, as the chain ends there")
        yield found


def _level(sketch: Sketch, link: str) -> tuple[bool, float]:
    one, other = (sketch.places[point] for point in sketch.links[link][:2])
    return abs((other - one).imag) > LINE_TOL * sketch.size, -abs(other - one)
