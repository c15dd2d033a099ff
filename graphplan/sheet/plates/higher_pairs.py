"""The symbols of higher pairs: pitch circles and lines, belts, and profiles where they touch.

As large as they are, in the scale of the mechanism; only how far a profile goes on from where it touches is a matter
of the paper. What a profile looks like elsewhere a scene does not say.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from graphplan.mechanism.model import Contact, Scene
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Item, Polygon, Polyline, Spot
from graphplan.sheet.plates.symbols import HATCH, NEAR, PITCH, RADIUS, Vector, bar, hatching, off, unit
from graphplan.sheet.tolerances import ARC_TOL

LAYER = "wheels"
HALF_RACK, DEEP = 22.0, 2.4  # mm: half the length of a rack's drawn part, and how deep its bar is
PROFILE, FACE = 26.0, 14.0  # mm that a drawn arc, and half of a straight face, goes on from where it touches
WIDEST = 100.0  # degrees of an arc on either side
FRINGE = 40.0  # degrees of a wheel that stands still, hatched on either side of its pitch point


def circle(pen: pens.Pen, centre: Spot, radius: float) -> tuple[Item, Item]:
    """A whole circle, in two halves: an arc that ends where it begins is none to many a program."""
    return (Arc(pen, LAYER, None, centre, radius, 0.0, 180.0), Arc(pen, LAYER, None, centre, radius, 180.0, 360.0))


def fringe(centre: Spot, radius: float, towards: Spot, outwards: float) -> Iterator[Item]:
    """What says that a wheel stands still: its rim hatched on both sides of a spot, `outwards` (+1) or inwards (-1)."""
    step = math.degrees(PITCH / radius)
    middle = math.degrees(math.atan2(towards[1] - centre[1], towards[0] - centre[0]))
    count = int(FRINGE / step)
    for k in range(-count, count + 1):
        angle = math.radians(middle + k * step)
        ray = math.cos(angle), math.sin(angle)
        root = off(centre, ray, radius)
        yield Polyline(pens.HATCH, "ground", None, (root, off(root, ray, outwards * 0.8 * HATCH, 0.6 * HATCH)))


def rack(at: Spot, along: Vector, seat: Spot | None) -> Iterator[Item]:
    """A bar below the pitch line of a rack, its gear on the left, tied to a point of its link; or the hatched ground.
    """
    if seat is None:
        yield from rail(at, along, -1.0)
        return
    start, end, tie = _tied(at, along, HALF_RACK, seat)
    yield from tie
    yield Polygon(pens.BLOCK, LAYER, None, (start, end, off(end, along, 0.0, -DEEP), off(start, along, 0.0, -DEEP)))


def rail(at: Spot, along: Vector, side: float) -> Iterator[Item]:
    """A straight pitch line or profile of the frame, hatched on its left (+1) or right (-1)."""
    start, end = off(at, along, -HALF_RACK), off(at, along, HALF_RACK)
    yield Polyline(pens.GROUND, "ground", None, (start, end))
    yield from hatching(start, end, side)


def _tied(at: Spot, along: Vector, half: float, seat: Spot) -> tuple[Spot, Spot, tuple[Item, ...]]:
    """The ends of a line through a spot that goes on beside a seat, and the bar to the seat."""
    foot = off(at, along, (seat[0] - at[0]) * along[0] + (seat[1] - at[1]) * along[1])
    line = off(at, along, -half), off(at, along, half), foot
    start, _, end = sorted(line, key=lambda spot: spot[0] * along[0] + spot[1] * along[1])
    return start, end, tuple(bar((foot, seat))) if math.dist(foot, seat) > NEAR else ()


def belt(one: Spot, r: float, two: Spot, s: float, crossed: bool) -> Iterator[Item]:
    """The two straight parts of a belt or chain about two wheels."""
    way, far = unit(one, two), math.dist(one, two)
    lean = (r + s if crossed else r - s) / far
    if abs(lean) >= 1.0:
        return
    for side in (1.0, -1.0):
        normal = (lean * way[0] - side * math.sqrt(1 - lean * lean) * way[1],
                  lean * way[1] + side * math.sqrt(1 - lean * lean) * way[0])  # fmt: skip
        ends = off(one, normal, r), off(two, normal, -s if crossed else s)
        yield Polyline(pens.LINK, LAYER, None, ends)


def profile(at: Spot, centre: Spot, whole: bool, disc: bool) -> Iterator[Item]:
    """A profile on both sides of where it touches, and thin the rest of its disc; or all of a roller; of a pin its rim.
    """
    radius = math.dist(at, centre)
    if whole or radius < NEAR:
        yield from circle(pens.LINK, centre, max(radius, RADIUS))
        return
    middle = math.degrees(math.atan2(at[1] - centre[1], at[0] - centre[0]))
    half = min(WIDEST, math.degrees(PROFILE / radius))
    if disc:
        yield from circle(pens.PRODUCED, centre, radius)
    yield Arc(pens.LINK, LAYER, None, centre, radius, middle - half, middle + half)


def face(at: Spot, along: Vector, seat: Spot) -> Iterator[Item]:
    """A straight profile on both sides of where it touches, tied to a point of its link."""
    start, end, tie = _tied(at, along, FACE, seat)
    yield from tie
    yield Polyline(pens.LINK, LAYER, None, (start, end))


def wheels(scene: Scene) -> dict[tuple[str, str, float], tuple[int, ...]]:
    """Each pitch circle once, by its link, its centre and its radius in the scene's lengths: the places of its gears.
    """
    found: dict[tuple[str, str, float], tuple[int, ...]] = {}
    for i, gear in enumerate(scene.gears):
        for link, centre, radius in zip(gear.links, gear.centres, gear.pitch_radii(scene.points) or (), strict=False):
            key = link, centre, float(f"{radius:.9g}")
            found[key] = (*found.get(key, ()), i)
    return found


def disc(scene: Scene, contact: Contact, centre: str) -> float:
    """The radius of a profile that bulges and is no larger than the mechanism, in the scene's lengths; else 0."""
    other = contact.centres[contact.centres[0] == centre]
    (kx, ky), (x, y) = (map(float, scene.points[name]) for name in (contact.at, centre))
    radius = math.hypot(x - kx, y - ky)
    if other is not None:
        u, v = map(float, scene.points[other])
        if (x - kx) * (u - kx) + (y - ky) * (v - ky) > ARC_TOL * radius * radius:
            return 0.0
    return radius if radius <= scene.extent else 0.0


def reach(scene: Scene) -> Iterator[Spot]:
    """How far pitch circles and discs go, in the scene's lengths: the corners of the squares about them."""
    circles = [(centre, radius) for _, centre, radius in wheels(scene)]
    circles += [(centre, disc(scene, one, centre)) for contact in scene.contacts for one in (contact, contact.beyond)
                if one for centre in filter(None, one.centres)]
    for centre, radius in circles:
        x, y = map(float, scene.points[centre])
        yield from ((x - radius, y - radius), (x + radius, y + radius))
