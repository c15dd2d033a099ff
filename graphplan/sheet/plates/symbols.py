"""The symbols of a mechanism, as a textbook draws them: pairs, ground, blocks, links, and higher pairs.

Lower pairs, ground and blocks are of a fixed size in millimetres on paper, whatever the scale. Pitch circles and lines,
belts and profiles are as large as they are, in the scale of the mechanism; only how far a profile goes on from where it
touches is a matter of the paper. What a profile looks like elsewhere a scene does not say.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from graphplan.mechanism.model import Contact, Scene
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Circle, Item, Polygon, Polyline, Spot
from graphplan.sheet.tolerances import ARC_TOL, SPOT_TOL

RADIUS = 1.2  # of a revolute pair's circle
STAND, FOOT, GROUND = 4.6, 2.6, 4.4  # the triangle under a fixed pivot: height, half its base, half the ground line
HATCH, PITCH = 1.7, 1.25
LONG, HIGH, GUIDE = 4.4, 2.3, 13.0  # half the length and height of a block, half the length of its guide
ELBOW = 2.6
MAX_SHADED_MM = 9.0  # of the sides of a plate, at its hatched corner
DRIVE_RADIUS, DRIVE_ANGLE, DRIVE_SWEEP = 7.0, 41.0, 54.0  # the arrow of a drive: mm; degrees off the crank; how long
NEAR = 0.05  # spots closer than this are one
FLAT_PARTS = 0.15  # of its length: a link no wider is drawn as a rod
GROUND_COS = 0.35  # the cosine of the angle within which it would run into the ground

Vector = tuple[float, float]


def offset(spot: Spot, along: Vector, t: float, u: float = 0.0) -> Spot:
    """t along a direction and u to its left."""
    return spot[0] + t * along[0] - u * along[1], spot[1] + t * along[1] + u * along[0]


def unit_vector(start: Spot, end: Spot) -> Vector:
    """The direction from one spot to another; to the right if they coincide."""
    length = math.dist(start, end)
    return ((end[0] - start[0]) / length, (end[1] - start[1]) / length) if length > SPOT_TOL else (1.0, 0.0)


def revolute(at: Spot) -> Item:
    """A turning pair; several links at one joint still have one circle."""
    return Circle(pens.PAIR, "pairs", None, at, RADIUS)


def tracer(at: Spot) -> Item:
    """A point of a link that is no pair."""
    return Circle(pens.DOT, "pairs", None, at, RADIUS / 2)


def ground_line(start: Spot, end: Spot, side: float) -> Iterator[Item]:
    """A line of the frame with short strokes under it; `side` is +1 for the left of the line and -1 for its right."""
    yield Polyline(pens.GROUND, "ground", None, (start, end))
    along, long = unit_vector(start, end), math.dist(start, end)
    count = max(1, int(long / PITCH))
    for i in range(count):
        root = offset(start, along, (i + 0.75) * long / count)
        yield Polyline(pens.HATCH, "ground", None, (root, offset(root, along, -0.6 * HATCH, side * 0.8 * HATCH)))


def pivot(at: Spot, down: Vector) -> Iterator[Item]:
    """A fixed pivot without its circle: a triangle on hatched ground; `down` is the direction to the ground."""
    left, right = offset(at, down, STAND, -FOOT), offset(at, down, STAND, FOOT)
    start, end = offset(at, down, STAND, -GROUND), offset(at, down, STAND, GROUND)
    yield Polygon(pens.GROUND_FILL, "ground", None, (at, left, right))
    yield from ground_line(start, end, -1.0)


def guideway(at: Spot, along: Vector, side: float, way: tuple[float, float] = (0.0, 0.0)) -> Iterator[Item]:
    """A fixed guide under a block that goes so far back and on along it: its line, hatched on the outer side."""
    low, high = way[0] - GUIDE, way[1] + GUIDE
    start, end = offset(at, along, low, side * HIGH), offset(at, along, high, side * HIGH)
    yield from ground_line(start, end, side)
    yield Polyline(pens.PRODUCED, "ground", None, (offset(at, along, low), offset(at, along, high)))


def block(at: Spot, along: Vector) -> Item:
    """A sliding block, turned to its guide."""
    corners = tuple(offset(at, along, t * LONG, u * HIGH) for t, u in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return Polygon(pens.BLOCK, "blocks", None, corners)


PAIRS = {"block": block}
"""The symbols of the pairs with a guide, by the names that their records have."""


def bar(spots: Sequence[Spot]) -> Iterator[Item]:
    """A link whose points lie on one line, in their order along it; inner joints do not cut it."""
    yield Polyline(pens.BAR, "links", None, tuple(spots))
    yield Polyline(pens.HOLLOW, "links", None, tuple(spots))


def elbow(at: Spot, along: Vector, side: float) -> Item:
    """The half disc that says a bar goes through at an inner joint, on one side of the bar."""
    start = math.degrees(math.atan2(along[1], along[0])) + (0.0 if side > 0 else 180.0)
    arc = Arc(pens.LINK, "links", None, at, ELBOW, start, start + 180.0)
    return Polygon(pens.SOLID, "links", None, arc.spots(15.0))


def plate(spots: Sequence[Spot]) -> Iterator[Item]:
    """A link of three or more points: its hull, tinted, one corner hatched, with strokes to any point inside."""
    corners = hull(spots)
    yield Polygon(pens.PLATE, "plates", None, corners)
    yield from rigid(corners)
    yield Polyline(pens.LINK, "links", None, (*corners, corners[0]))
    for inner in (spot for spot in spots if spot not in corners):
        nearest = min(corners, key=lambda corner: (math.dist(corner, inner), corner))
        yield Polyline(pens.LINK, "links", None, (nearest, inner))


def rigid(corners: Sequence[Spot]) -> Iterator[Item]:
    """The mark of a rigid link: the widest of its corners hatched at 45 degrees, for at most a third of the sides."""

    def opening(i: int) -> float:
        (x, y), (u, v) = unit_vector(corners[i], corners[i - 1]), unit_vector(corners[i], corners[i + 1 - len(corners)])
        return round(x * u + y * v, 9)

    i = min(range(len(corners)), key=opening)
    corner, sides = corners[i], (corners[i - 1], corners[i + 1 - len(corners)])
    ends = [offset(corner, unit_vector(corner, side), min(MAX_SHADED_MM, math.dist(corner, side) / 3))
            for side in sides]
    yield from _shading((corner, *ends))


def _shading(corners: Sequence[Spot]) -> Iterator[Item]:
    """Strokes at 45 degrees over a triangle."""
    import shapely  # where nothing is drawn, as for a list of steps, it is not needed

    triangle, levels, xs = shapely.Polygon(corners), [y - x for x, y in corners], [x for x, _ in corners]
    low, high = min(levels), max(levels)
    count = int((high - low) / (PITCH * math.sqrt(2)))
    for k in range(count):
        level = low + (k + 0.5) * (high - low) / count
        stroke = shapely.LineString([(x, x + level) for x in (min(xs), max(xs))]).intersection(triangle)
        yield Polyline(pens.HATCH, "plates", None, tuple(stroke.coords))


def hull(spots: Sequence[Spot]) -> tuple[Spot, ...]:
    """The corners of the convex hull, counter-clockwise from the leftmost."""
    import shapely

    rim = shapely.normalize(shapely.MultiPoint(spots).convex_hull).exterior.coords[:0:-1]
    return tuple(b for a, b, c in zip((rim[-1], *rim), rim, (*rim[1:], rim[0]), strict=False)
                 if turn(a, b, c) > SPOT_TOL * math.dist(a, c))


def turn(a: Spot, b: Spot, c: Spot) -> float:
    """Twice the area of a triangle, positive counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def distinct_spots(spots: Iterable[Spot]) -> list[Spot]:
    """The spots in order, coincident ones once."""
    distinct: list[Spot] = []
    for spot in spots:
        if all(math.dist(spot, known) > NEAR for known in distinct):
            distinct.append(spot)
    return distinct


def farthest_pair(spots: Sequence[Spot]) -> tuple[Spot, Spot]:
    """The two spots farthest from each other."""
    return max(((p, q) for p in spots for q in spots), key=lambda ends: math.dist(*ends))


def are_collinear(spots: Sequence[Spot]) -> bool:
    """Whether spots lie on one line, to a quarter of a pen's width."""
    if not spots:
        return True
    long = math.dist(*(ends := farthest_pair(spots)))
    p, q = ends
    return long < SPOT_TOL or all(abs(turn(p, q, r)) / long < FLAT_PARTS for r in spots)


def drive(at: Spot, towards: Vector, sign: float, ground: Vector | None = None) -> Iterator[Item]:
    """The sense of a driving crank: an arc about its pivot with an arrowhead, ahead of the crank or, where the ground
    is, behind it."""
    middle, side = math.atan2(towards[1], towards[0]), sign * math.radians(DRIVE_ANGLE)
    if ground and ground[0] * math.cos(middle + side) + ground[1] * math.sin(middle + side) > GROUND_COS:
        side = -side
    centre = math.degrees(middle + side)
    start, end = centre - DRIVE_SWEEP / 2, centre + DRIVE_SWEEP / 2
    arc = Arc(pens.DRIVE, "drive", None, at, DRIVE_RADIUS, start, end)
    yield arc
    tip = arc.spot_at(end if sign > 0 else start)
    back = offset(tip, unit_vector(at, tip), 0.0, -sign * 2.2)
    across = unit_vector(at, tip)
    yield Polygon(pens.SOLID, "drive", None, (tip, offset(back, across, 0.75), offset(back, across, -0.35)))


# ---- higher pairs ----------------------------------------------------------------------------------------------------

LAYER = "wheels"
HALF_RACK, RACK_DEPTH = 22.0, 2.4  # mm: half the length of a rack's drawn part, and how deep its bar is
PROFILE, FACE = 26.0, 14.0  # mm that a drawn arc, and half of a straight face, goes on from where it touches
MAX_PROFILE_ANGLE = 100.0  # degrees of an arc on either side
FRINGE = 40.0  # degrees of a wheel that stands still, hatched on either side of its pitch point


def circle(pen: pens.Pen, centre: Spot, radius: float) -> tuple[Item, Item]:
    """A whole circle, in two halves: many programs drop an arc that ends where it begins."""
    return (Arc(pen, LAYER, None, centre, radius, 0.0, 180.0), Arc(pen, LAYER, None, centre, radius, 180.0, 360.0))


def fringe(centre: Spot, radius: float, towards: Spot, outwards: float) -> Iterator[Item]:
    """The mark of a fixed wheel: its rim hatched on both sides of a spot, `outwards` (+1) or inwards (-1)."""
    step = math.degrees(PITCH / radius)
    middle = math.degrees(math.atan2(towards[1] - centre[1], towards[0] - centre[0]))
    count = int(FRINGE / step)
    for k in range(-count, count + 1):
        angle = math.radians(middle + k * step)
        ray = math.cos(angle), math.sin(angle)
        root = offset(centre, ray, radius)
        yield Polyline(pens.HATCH, "ground", None, (root, offset(root, ray, outwards * 0.8 * HATCH, 0.6 * HATCH)))


def rack(at: Spot, along: Vector, seat: Spot | None) -> Iterator[Item]:
    """A bar below the pitch line of a rack, its gear on the left, tied to a point of its link; or the hatched ground.
    """
    if seat is None:
        yield from rail(at, along, -1.0)
        return
    start, end, tie = _tied_line(at, along, HALF_RACK, seat)
    yield from tie
    yield Polygon(pens.BLOCK, LAYER, None,
                  (start, end, offset(end, along, 0.0, -RACK_DEPTH), offset(start, along, 0.0, -RACK_DEPTH)))


def rail(at: Spot, along: Vector, side: float) -> Iterator[Item]:
    """A straight pitch line or profile of the frame, hatched on its left (+1) or right (-1)."""
    start, end = offset(at, along, -HALF_RACK), offset(at, along, HALF_RACK)
    yield from ground_line(start, end, side)


def _tied_line(at: Spot, along: Vector, half: float, seat: Spot) -> tuple[Spot, Spot, tuple[Item, ...]]:
    """The ends of a line through a spot that goes on beside a seat, and the bar to the seat."""
    foot = offset(at, along, (seat[0] - at[0]) * along[0] + (seat[1] - at[1]) * along[1])
    line = offset(at, along, -half), offset(at, along, half), foot
    start, _, end = sorted(line, key=lambda spot: spot[0] * along[0] + spot[1] * along[1])
    return start, end, tuple(bar((foot, seat))) if math.dist(foot, seat) > NEAR else ()


def belt(one: Spot, r: float, two: Spot, s: float, crossed: bool) -> Iterator[Item]:
    """The two straight parts of a belt or chain about two wheels."""
    direction, far = unit_vector(one, two), math.dist(one, two)
    lean = (r + s if crossed else r - s) / far
    if abs(lean) >= 1.0:
        return
    for side in (1.0, -1.0):
        normal = (lean * direction[0] - side * math.sqrt(1 - lean * lean) * direction[1],
                  lean * direction[1] + side * math.sqrt(1 - lean * lean) * direction[0])  # fmt: skip
        ends = offset(one, normal, r), offset(two, normal, -s if crossed else s)
        yield Polyline(pens.LINK, LAYER, None, ends)


def profile(at: Spot, centre: Spot, whole: bool, disc: bool) -> Iterator[Item]:
    """A profile on both sides of where it touches, and thin the rest of its disc; or all of a roller; of a pin its rim.
    """
    radius = math.dist(at, centre)
    if whole or radius < NEAR:
        yield from circle(pens.LINK, centre, max(radius, RADIUS))
        return
    middle = math.degrees(math.atan2(at[1] - centre[1], at[0] - centre[0]))
    half = min(MAX_PROFILE_ANGLE, math.degrees(PROFILE / radius))
    if disc:
        yield from circle(pens.PRODUCED, centre, radius)
    yield Arc(pens.LINK, LAYER, None, centre, radius, middle - half, middle + half)


def face(at: Spot, along: Vector, seat: Spot) -> Iterator[Item]:
    """A straight profile on both sides of where it touches, tied to a point of its link."""
    start, end, tie = _tied_line(at, along, FACE, seat)
    yield from tie
    yield Polyline(pens.LINK, LAYER, None, (start, end))


def wheels(scene: Scene) -> dict[tuple[str, str, float], tuple[int, ...]]:
    """Each pitch circle once, by its link, its centre and its radius in the scene's lengths: the places of its gears.
    """
    gears_of: dict[tuple[str, str, float], tuple[int, ...]] = {}
    for i, gear in enumerate(scene.gears):
        for link, centre, radius in zip(gear.links, gear.centres, gear.pitch_radii(scene.points) or (), strict=False):
            key = link, centre, float(f"{radius:.9g}")
            gears_of[key] = (*gears_of.get(key, ()), i)
    return gears_of


def disc(scene: Scene, contact: Contact, centre: str) -> float:
    """The radius of a profile that bulges and is no larger than the mechanism, in the scene's lengths; else 0."""
    other_centre = contact.centres[contact.centres[0] == centre]
    (kx, ky), (x, y) = (map(float, scene.points[name]) for name in (contact.at, centre))
    radius = math.hypot(x - kx, y - ky)
    if other_centre is not None:
        u, v = map(float, scene.points[other_centre])
        if (x - kx) * (u - kx) + (y - ky) * (v - ky) > ARC_TOL * radius * radius:
            return 0.0
    return radius if radius <= scene.extent else 0.0


def reach(scene: Scene) -> Iterator[Spot]:
    """Reach of pitch circles and discs, in the scene's lengths: the corners of the squares about them."""
    circles = [(centre, radius) for _, centre, radius in wheels(scene)]
    circles += [(centre, disc(scene, pair, centre)) for contact in scene.contacts for pair in (contact, contact.beyond)
                if pair for centre in filter(None, pair.centres)]
    for centre, radius in circles:
        x, y = map(float, scene.points[centre])
        yield from ((x - radius, y - radius), (x + radius, y + radius))
