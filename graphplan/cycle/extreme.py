"""Extreme positions: where a crank and the coupler on it lie in one line, and the link that they swing turns back.

The joint between the coupler and that link is then b + r (outer) or b - r (inner) from the crank's pivot: Ozols 1974,
section 5-1. Which of the crossings the mechanism comes to, the cycle says.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from graphplan.cycle.tolerances import PLACE_TOL
from graphplan.cycle.turn import follow
from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Extreme, Scene
from graphplan.mechanism.travel import sense
from graphplan.methods.motion.network import Network
from graphplan.phrases import Said, said

WAYS = {"outer": 1, "inner": -1}  # on which side of the pivot the crank lies, seen from the joint, where b > r


def extreme(scene: Scene, asked: str) -> tuple[Extreme, Fraction]:
    """The extreme position that is asked for, such as "outer" or "inner 3", and how far the first drive goes to it.

    Degrees. Fails with `Refused` where no link or more than one has such, or the mechanism does not come there.
    """
    way, _, link = asked.strip().partition(" ")
    if way not in WAYS:
        raise Refused(f"--at {asked}", "this is no position", "degrees or lengths, or outer or inner, such as outer 3")
    found = [one for one in _swung(scene, way) if link.strip() in ("", one.link)]
    if len(found) != 1:
        links = ", ".join(one.link for one in found or _swung(scene, way))
        why = (said("several links have extreme positions") if found else said("this link has no extreme position")
               if links else said("no link is swung about or along the frame by a coupler on the first drive's crank"))
        raise Refused(f"--at {asked}", why, said("one of {0}", links) if links else said("the travel of the drive"))
    one = found[0]
    travel = _travel(scene, one)
    if travel is None:
        raise Refused(f"--at {asked}", _missed(one), said("the travel of the drive"))
    other = _travel(scene, replace(one, way="inner" if way == "outer" else "outer"))
    return replace(one, time_ratio=_time_ratio(scene, travel, other)), Fraction(travel)


def _missed(one: Extreme) -> Said:
    return said("the mechanism comes to no position in which {0} and {1} lie in one line so", f"{one.pivot}{one.pin}",
                f"{one.pin}{one.joint}")


def _time_ratio(scene: Scene, travel: float, other: float | None) -> float | None:
    """Of the two turns of a uniform crank between the extreme positions the larger over the smaller; none where it
    does not go round."""
    if other is None or not follow(scene, 2).closed:
        return None
    part = (travel - other) % 360
    return max(part, 360 - part) / min(part, 360 - part) if part else None


def _swung(scene: Scene, way: str) -> Iterator[Extreme]:
    """The links that couplers on the first drive's crank swing about a point of the frame, or push along it."""
    net = Network(scene)
    weld = next((weld for weld in net.welds.values() if weld.drive == scene.drives[0]), None)
    if weld is None or weld.slide is not None or weld.to != FRAME:
        return
    free = [link for link in scene.links if link != FRAME and link not in net.welds]
    for coupler in free:
        pins = [point for point in scene.links[coupler] if point in scene.links[weld.link] and point != weld.at]
        for link in free:
            joints = [point for point in scene.links[coupler] if point in scene.links[link] and point not in pins]
            if link != coupler and pins and joints and _hold(scene, link, joints[0]) is not None:
                yield Extreme(way, link, coupler, weld.at, pins[0], joints[0])


def _hold(scene: Scene, link: str, joint: str) -> str | complex | None:
    """The point of the frame about which a link turns, or the direction in which it slides along the frame."""
    about = next((point for point in scene.links[link] if FRAME in scene.links_of[point] and point != joint), None)
    along = (complex(*map(float, slide.direction)) for slide in scene.slides
             if {*slide.links} == {link, FRAME} and slide.turns_alike and slide not in
             [scene.driven_slide(drive) for drive in scene.drives if drive.slides])
    return about or next(along, None)


def _travel(scene: Scene, one: Extreme) -> float | None:
    """How far the drive goes to an extreme position in its sense, in degrees: on from the given pose, else back; none
    where it does not come there."""
    at = {name: complex(*map(float, place)) for name, place in scene.points.items()}
    O, A, B = at[one.pivot], at[one.pin], at[one.joint]
    long = abs(B - A) + WAYS[one.way] * abs(A - O)
    if abs(long) <= PLACE_TOL * scene.extent:
        return None
    drive = scene.drives[0]
    way = sense(drive) * (1 if drive.on == FRAME else -1)
    for joint in _crossings(scene, one, O, B, abs(long), at):
        arm = WAYS[one.way] * (joint - O) / long
        turn = way * math.degrees(cmath.phase(arm / (A - O))) % 360
        for travel in (turn, turn - 360):
            found = follow(scene, 1, (travel, travel))
            if 0 not in found.faults and abs(found.points[one.joint][0] - joint) <= PLACE_TOL * scene.extent:
                return travel
    return None


def _crossings(scene: Scene, one: Extreme, O: complex, B: complex, far: float,
               at: dict[str, complex]) -> Iterator[complex]:
    """Where the joint is so far from the pivot, on its circle or its line."""
    hold = _hold(scene, one.link, one.joint)
    if isinstance(hold, str):
        C = at[hold]
        if C == O:
            return
        d, way = abs(C - O), (C - O) / abs(C - O)
        along = (far * far + d * d - abs(B - C) ** 2) / (2 * d)
        foot, up = O + along * way, 1j * way
    else:
        assert hold is not None
        up = hold / abs(hold)
        foot = B + ((O - B) * up.conjugate()).real * up
    high = far * far - abs(foot - O) ** 2
    if high > 0:
        yield from (foot + sign * math.sqrt(high) * up for sign in (1, -1))
