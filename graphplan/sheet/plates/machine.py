"""The machine on a plate: bodies, guides and toothed wheels as they look.

Wheels that mesh have one module: that of their numbers of teeth, or where a scene gives radii alone, one that suits the
paper. At a pitch point a tooth of the one wheel stands in a gap of the other.

Only what a scene's pairs tell is drawn. A link in whose straight slot the pin of a crank runs has a slot as long as the
pin's way in it. It is a Geneva wheel if crank and wheel turn about fixed pivots as far apart as the pin needs to enter
the slots of a whole number without shock, and the pin is in its slot within the rim (Ozols, section 19-4).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from graphplan.mechanism.load_values import spring_laws
from graphplan.mechanism.model import FRAME, Contact, Gear, Scene, Slide
from graphplan.sheet.plates import pens, symbols
from graphplan.sheet.plates.display import Polygon, Polyline, Rect, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.symbols import HALF_RACK, HIGH, LONG, NEAR, RADIUS, Vector, offset, unit_vector
from graphplan.sheet.plates.view import View
from graphplan.sheet.tolerances import SLOTS_TOL

USUAL_PITCH_MM, MIN_PITCH_MM = 4.5, 1.2  # mm between teeth: of wheels without numbers of teeth; the least that is drawn
MIN_TEETH = 12  # of a wheel that has teeth: fewer are undercut, or only tell a ratio
TEETH_PER_SIDE = 3  # at a pitch point
ADDENDUM, DEDENDUM = 1.0, 1.25  # in modules, as ISO 53 has them
FLANK = 0.0, 0.25, 0.5, 0.75, 1.0  # of a tooth's height, where its flank is drawn through

Chain = tuple[Spot, ...]


@dataclass(frozen=True)
class ToothedWheel:
    """A wheel on paper: its teeth are a `module` (mm) large, and the middle of one is at the angle `tooth`."""

    centre: Spot
    radius: float
    module: float
    pressure: float
    ring: bool
    tooth: float = 0.0

    @property
    def pitch(self) -> float:
        """The angle from tooth to tooth."""
        return self.module / self.radius * math.pi

    @property
    def tip(self) -> float:
        """The radius of the circle through the tips."""
        return self.radius + (-1 if self.ring else 1) * ADDENDUM * self.module

    def spot(self, radius: float, angle: float) -> Spot:
        """The spot at a distance from the centre, in a direction."""
        return self.centre[0] + radius * math.cos(angle), self.centre[1] + radius * math.sin(angle)

    def phase(self, towards: float) -> float:
        """Angle of a direction from the middle of a tooth, in teeth."""
        return (towards - self.tooth) / self.pitch

    def outline(self, directions: list[float]) -> Iterator[Chain]:
        """Yield its teeth about these directions, and its tip circle in between."""
        half = min(math.pi, (TEETH_PER_SIDE + 0.5) * self.pitch)
        ranges = list[tuple[float, float]]()
        for towards in sorted(direction % math.tau for direction in directions):
            if ranges and towards - half <= ranges[-1][1]:
                ranges[-1] = ranges[-1][0], towards + half
            else:
                ranges.append((towards - half, towards + half))
        first, last = ranges[0][0] + math.tau, ranges[-1][1]
        if last >= first and len(ranges) > 1:  # the last goes on into the first
            ranges = [(ranges[-1][0] - math.tau, ranges[0][1]), *ranges[1:-1]]
        for low, high in ranges:
            yield self._teeth(low, min(high, low + math.tau))
        for (_, end), (start, _) in pairwise([*ranges, (ranges[0][0] + math.tau, 0.0)]):
            if start > end:
                count = max(2, math.ceil((start - end) / math.radians(3)))
                yield tuple(self.spot(self.tip, end + (start - end) * k / count) for k in range(count + 1))

    def _teeth(self, low: float, high: float) -> Chain:
        """The teeth with their middles between two angles; of a ring the gaps, which have the same shape."""
        shift = 0.5 if self.ring else 0.0
        first, end = math.ceil(self.phase(low) - shift), math.ceil(self.phase(high) - shift)
        return tuple(spot for k in range(first, end) for spot in self._tooth(self.tooth + (k + shift) * self.pitch))

    def _tooth(self, middle: float) -> Iterator[Spot]:
        """A tooth from root to tip and back to the root."""
        outwards, inwards = (DEDENDUM, ADDENDUM) if self.ring else (ADDENDUM, DEDENDUM)
        low, high = self.radius - inwards * self.module, self.radius + outwards * self.module
        radii = [low + (high - low) * t for t in FLANK]
        yield from (self.spot(radius, middle - self._half_width(radius)) for radius in radii)
        yield from (self.spot(radius, middle + self._half_width(radius)) for radius in reversed(radii))

    def _half_width(self, radius: float) -> float:
        """Half the angle that a tooth takes up at a radius: an involute outside of the base circle, radial within."""
        base = self.radius * math.cos(self.pressure)
        return max(0.0, self.pitch / 4 + _involute(self.pressure) - _involute(math.acos(base / max(base, radius))))


def _involute(angle: float) -> float:
    return math.tan(angle) - angle


@dataclass(frozen=True)
class _Mesh:
    """A gear pair as it lies on paper: its pitch point, and the direction there from each wheel's centre."""

    gear: Gear
    keys: tuple[tuple[str, str, float], ...]
    wheels: tuple[ToothedWheel, ...]
    pole: Spot
    directions: tuple[float, ...]


def _meshes(scene: Scene, view: View) -> Iterator[_Mesh]:
    """Yield the gears with teeth, those with their numbers first; belts, friction wheels and wheels of too few teeth,
    which are pitch circles alone, are left out."""
    for gear in sorted(scene.gears, key=lambda gear: gear.teeth is None):
        if gear.belt or not gear.tangent or (gear.teeth and min(gear.teeth) < MIN_TEETH):
            continue
        x, y = gear.pitch_point(scene.points)
        pole, radii = view((float(x), float(y))), gear.pitch_radii(scene.points) or ()
        keys = tuple((link, centre, float(f"{radius:.9g}"))
                     for link, centre, radius in zip(gear.links, gear.centres, radii, strict=False))
        centres = [view((float(x), float(y))) for x, y in (scene.points[centre] for centre in gear.centres)]
        size = min(radii) * view.scale
        count = float(gear.teeth[0]) if gear.teeth else max(MIN_TEETH, round(math.tau * size / USUAL_PITCH_MM))
        module = 2 * (radii[0] * view.scale if gear.teeth else size) / count
        wheels = tuple(ToothedWheel(centre, radius * view.scale, module, math.atan(float(gear.tangent)),
                                    gear.internal and k == 1)
                       for k, (centre, radius) in enumerate(zip(centres, radii, strict=True)))
        yield _Mesh(gear, keys, wheels, pole,
                    tuple(math.atan2(pole[1] - y, pole[0] - x) for x, y in centres))


def teeth(scene: Scene, view: View) -> Iterator[Chain]:
    """The teeth of all gears and racks whose pitch can be seen, as chains of spots on paper."""
    waiting, placed = list(_meshes(scene, view)), dict[tuple[str, str, float], ToothedWheel]()
    directions: dict[tuple[str, str, float], list[float]] = {}
    while waiting:
        mesh = next((mesh for mesh in waiting if not placed.keys().isdisjoint(mesh.keys)), waiting[0])
        waiting.remove(mesh)
        _place(mesh, placed)
        for key, towards in zip(mesh.keys, mesh.directions, strict=True):
            directions.setdefault(key, []).append(towards)
        if mesh.gear.direction is not None:
            wheel = placed[mesh.keys[0]]
            if wheel.pitch * wheel.radius >= MIN_PITCH_MM:
                x, y = map(float, mesh.gear.direction)
                yield _rack(wheel, mesh.pole, (x / math.hypot(x, y), y / math.hypot(x, y)), mesh.directions[0])
    for key, wheel in placed.items():
        if wheel.pitch * wheel.radius >= MIN_PITCH_MM:
            yield from wheel.outline(directions[key])


def _place(mesh: _Mesh, placed: dict[tuple[str, str, float], ToothedWheel]) -> None:
    """Place the wheels of a pair so that they mesh with each other, and with those that are placed before."""
    first = next((k for k, key in enumerate(mesh.keys) if key in placed), 0)
    leader = placed.setdefault(mesh.keys[first], replace(mesh.wheels[first], tooth=mesh.directions[first]))
    for k, (key, wheel) in enumerate(zip(mesh.keys, mesh.wheels, strict=True)):
        if k == first or key in placed:
            continue
        phase, wheel = leader.phase(mesh.directions[first]), replace(wheel, module=leader.module)
        turns = phase - 0.5 if mesh.gear.internal else -phase - 0.5
        placed[key] = replace(wheel, tooth=mesh.directions[k] - turns * wheel.pitch)


def _rack(wheel: ToothedWheel, pole: Spot, along: Vector, towards: float) -> Chain:
    """The teeth of a rack, whose wheel is on its left: straight flanks, a gap where the wheel has a tooth."""
    pitch, module, lean = math.pi * wheel.module, wheel.module, math.tan(wheel.pressure)
    start = (0.5 - wheel.phase(towards) % 1.0) * pitch
    count = int((HALF_RACK - pitch) / pitch)
    profile = ((-DEDENDUM, -1), (ADDENDUM, -1), (ADDENDUM, 1), (-DEDENDUM, 1))
    return tuple(offset(pole, along, start + k * pitch + side * (pitch / 4 - height * module * lean), height * module)
                 for k in range(-count, count + 1) for height, side in profile)


LAYER = "machine"
WALL_MM, HUB_MM = 1.6, 3.4  # beside a slot; the radius of a cam's shaft
ARC_STEP, FLANK_ANGLE, NOSE_ANGLE = 4.0, 60.0, 120.0  # degrees: between spots; of the arcs of a cam about its contact
MIN_SLOTS, MAX_SLOTS = 3, 12  # of a Geneva wheel
SPRING_END, SPRING_WIDTH, SPRING_PITCH = 0.15, 2.2, 2.5  # of its length without coils; mm: half as wide, a coil
UNIT_SHEET = 100.0  # mm: the extent of a scene of which only shapes are asked
LOCK = 0.88  # of the crank, less half a slot: the radius of the disc that locks a Geneva wheel


def machine_items(mechanism: DrawnMechanism) -> Iterator[Polyline | Polygon]:
    """Yield the items of the machine, from the bodies up: tints, then lines."""
    bodies = list(_bodies(mechanism))
    for body in bodies:
        yield Polygon(pens.BODY, LAYER, None, body)
    for body in bodies:
        yield Polyline(pens.MACHINE, LAYER, None, (*body, body[0]))
    for chain in (*teeth(mechanism.scene, mechanism.view), *_lines(mechanism)):
        if len(chain) > 1:
            yield Polyline(pens.MACHINE, LAYER, None, chain)


def wheel_reach(scene: Scene) -> tuple[Spot, ...]:
    """Reach of Geneva wheels and the discs that lock them, in the scene's lengths: corners of squares about them."""
    if not scene.points:
        return ()
    window = View(Rect(0.0, 0.0, 0.0, 0.0), UNIT_SHEET / scene.extent, (0.0, 0.0))
    circles = (circle for slot in _slots(DrawnMechanism(scene, window)) for circle in slot.rims)
    return tuple(window.to_plan((x + side * radius, y + side * radius))
                 for (x, y), radius in circles for side in (-1, 1))


def _bodies(mechanism: DrawnMechanism) -> Iterator[tuple[Spot, ...]]:
    """The outlines of cams, of slotted links and of Geneva wheels."""
    for contact in mechanism.scene.contacts:
        yield from _cams(mechanism, contact)
    for slot in _slots(mechanism):
        yield slot.geneva_wheel or slot.outline(slot.half + WALL_MM)


def _lines(mechanism: DrawnMechanism) -> Iterator[tuple[Spot, ...]]:
    """The insides of slots, the locking discs of cranks, belts on their pulleys, and springs."""
    for slot in _slots(mechanism):
        if slot.geneva_wheel:
            yield slot.locking_disc
        else:
            inside = slot.outline(slot.half)
            yield (*inside, inside[0])
    for gear in mechanism.scene.gears:
        if gear.belt and (radii := gear.pitch_radii(mechanism.scene.points)):
            ends = [mechanism.spots[centre] for centre in gear.centres]
            yield from _wraps(ends, [radius * mechanism.view.scale for radius in radii], gear.belt == "crossed")
    for span in spring_ends(mechanism.scene):
        yield _coils(*(mechanism.spots[name] for name in span))


def spring_ends(scene: Scene) -> Iterator[tuple[str, str]]:
    """The points between which springs are."""
    return (law.span for law in spring_laws(scene.loads.forces if scene.loads else ()) if law.span)


def coil_count(start: Spot, end: Spot) -> int:
    """Number of coils of a spring between two spots."""
    return max(2, round((1 - 2 * SPRING_END) * math.dist(start, end) / SPRING_PITCH))


def _coils(start: Spot, end: Spot) -> tuple[Spot, ...]:
    """A spring as a zigzag between two straight ends."""
    along, long, count = unit_vector(start, end), math.dist(start, end), 2 * coil_count(start, end)
    ways = (long * (SPRING_END + (1 - 2 * SPRING_END) * k / count) for k in range(count + 1))
    sides = (SPRING_WIDTH * math.sin(math.pi * k / 2) for k in range(count + 1))
    return (start, *(offset(start, along, way, side) for way, side in zip(ways, sides, strict=True)), end)


def _wraps(ends: list[Spot], radii: list[float], crossed: bool) -> Iterator[tuple[Spot, ...]]:
    """The parts of a belt that lie on its pulleys."""
    (one, two), (r, s) = ends, radii
    lean = (r + s if crossed else r - s) / math.dist(one, two)
    if abs(lean) < 1.0:
        half, (x, y) = math.degrees(math.acos(lean)), unit_vector(one, two)
        line = math.degrees(math.atan2(y, x))
        yield arc(one, r, line + half, line + 360.0 - half)
        away = half if crossed else 180.0 - half
        yield arc(two, s, line + 180.0 + away, line + 540.0 - away)


def arc(centre: Spot, radius: float, start: float, end: float) -> tuple[Spot, ...]:
    """An arc as a chain of spots, in degrees counter-clockwise."""
    count = max(1, math.ceil(abs(end - start) / ARC_STEP))
    angles = (math.radians(start + (end - start) * k / count) for k in range(count + 1))
    return tuple((centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)) for angle in angles)


def _cams(mechanism: DrawnMechanism, contact: Contact) -> Iterator[tuple[Spot, ...]]:
    """The bodies of those links of a contact that turn about a fixed pivot and bulge: the hull of profile and shaft.

    Where an arc follows another, the first is on the side of the contact that has passed the follower.
    """
    scene, at = mechanism.scene, mechanism.spots[contact.at]
    for k, (link, centre) in enumerate(zip(contact.links, contact.centres, strict=True)):
        pivot = _pivot(scene, link)
        follows = contact.beyond.centres[k] if contact.beyond else None
        if not centre or centre == pivot or pivot is None or math.dist(at, mechanism.spots[centre]) < NEAR:
            continue
        if not symbols.disc(scene, contact, centre):
            continue
        spots = [*arc(mechanism.spots[pivot], HUB_MM, 0.0, 360.0)]
        if follows is None or follows == centre:
            spots += arc(mechanism.spots[centre], math.dist(at, mechanism.spots[centre]), 0.0, 360.0)
        else:
            sign = next((math.copysign(1.0, drive.rate) for drive in scene.drives if drive.link == link), 1.0)
            for name, sweep in ((centre, sign * FLANK_ANGLE), (follows, -sign * NOSE_ANGLE)):
                x, y = unit_vector(mechanism.spots[name], at)
                start = math.degrees(math.atan2(y, x))
                spots += arc(mechanism.spots[name], math.dist(at, mechanism.spots[name]), start, start + sweep)
        yield symbols.hull(spots)


def _pivot(scene: Scene, link: str) -> str | None:
    """The joint of a link with the frame."""
    return next((name for name in scene.links[link] if name in scene.joints and FRAME in scene.links_of[name]), None)


@dataclass(frozen=True)
class PinSlot:
    """The slot of a link in which the pin of a crank runs, on paper.

    The pin is `at` a spot, `half` is half the slot's width; `low` and `high` are how far from there the pin comes along
    the slot. A `wheel` is the pivot of its link, if the slot goes through that, and the slot's is then its only point.
    """

    at: Spot
    along: Vector
    half: float
    low: float
    high: float
    crank: Spot
    wheel: Spot | None = None

    def outline(self, half: float) -> tuple[Spot, ...]:
        """A slot with round ends, or its walls, so wide on either side."""
        tilt = math.degrees(math.atan2(self.along[1], self.along[0]))
        end = max(LONG - half, 0.0) if half > 2 * RADIUS else 0.0
        return (*arc(offset(self.at, self.along, self.high + end), half, tilt - 90.0, tilt + 90.0),
                *arc(offset(self.at, self.along, self.low - end), half, tilt + 90.0, tilt + 270.0))

    @property
    def slots(self) -> int:
        """The number of slots of a Geneva wheel; 0 of any other link."""
        if self.wheel is None:
            return 0
        distance, radius = math.dist(self.crank, self.wheel), math.dist(self.crank, self.at)
        if not 0 < radius < distance:
            return 0
        count = round(math.pi / math.asin(radius / distance))
        fits = abs(radius / distance - math.sin(math.pi / count)) < SLOTS_TOL
        rim = distance * math.cos(math.pi / count)
        return count if fits and MIN_SLOTS <= count <= MAX_SLOTS and math.dist(self.at, self.wheel) <= rim else 0

    @property
    def rims(self) -> tuple[tuple[Spot, float], ...]:
        """The circles about a Geneva wheel and about the disc that locks it; empty for any other link."""
        if not self.slots or self.wheel is None:
            return ()
        rim = math.dist(self.crank, self.wheel) * math.cos(math.pi / self.slots)
        return (self.wheel, rim), (self.crank, LOCK * math.dist(self.crank, self.at))

    @property
    def geneva_wheel(self) -> tuple[Spot, ...]:
        """The outline of a Geneva wheel with its slots and the hollows in which the crank's disc locks it."""
        import shapely

        count = self.slots
        if not count or self.wheel is None:
            return ()
        distance, radius = math.dist(self.crank, self.wheel), math.dist(self.crank, self.at)
        x, y = unit_vector(self.wheel, self.at)
        wheel = shapely.Polygon(arc(self.wheel, distance * math.cos(math.pi / count), 0.0, 360.0))
        for k in range(count):
            turn = math.atan2(y, x) + math.tau * k / count
            way, between = ((math.cos(t), math.sin(t)) for t in (turn, turn + math.pi / count))
            ends = offset(self.wheel, way, distance - radius), offset(self.wheel, way, distance)
            hollow = arc(offset(self.wheel, between, distance), LOCK * radius - self.half, 0.0, 360.0)
            wheel = wheel.difference(shapely.union_all([shapely.LineString(ends).buffer(self.half),
                                                        shapely.Polygon(hollow)]))
        body = max(shapely.get_parts(wheel), key=lambda part: float(part.area))
        return tuple(body.exterior.coords[:-1])

    @property
    def locking_disc(self) -> tuple[Spot, ...]:
        """The rim of the crank's disc that locks a Geneva wheel, open where the wheel turns."""
        x, y = unit_vector(self.crank, self.at)
        middle, open_half = math.degrees(math.atan2(y, x)), 90.0 - 180.0 / self.slots
        radius = LOCK * math.dist(self.crank, self.at) - self.half
        return arc(self.crank, radius, middle + open_half, middle + 360.0 - open_half)


def _slots(mechanism: DrawnMechanism) -> Iterator[PinSlot]:
    """The slots of moving links in which the pins or blocks of driven cranks run: how far others come is not known."""
    scene = mechanism.scene
    turning = [drive.link for drive in scene.drives if not drive.slides and drive.on == FRAME]
    for pin, links, guide, pair, half in _pins_in_slots(scene):
        pivots = (_pivot(scene, link) for link in links if link in turning)
        if crank := next((pivot for pivot in pivots if pivot and pivot != pin), None):
            slot = _slot(mechanism, pin, crank, guide, mechanism.direction(pair), half)
            if slot:
                yield slot


def _pins_in_slots(scene: Scene) -> Iterator[tuple[str, Iterable[str], str, Slide | Contact, float]]:
    """Pins and blocks in slots of moving links: the pin, the links that may be its crank, that of the slot, the pair,
    and half the slot's width."""
    for slide in scene.slides:
        if FRAME not in slide.links and len(scene.links[slide.link]) == 1:
            yield slide.at, scene.links_of[slide.at], slide.along, slide, HIGH
    for contact in scene.contacts:
        if contact.direction is None:
            continue
        link, guide, centre = contact.curved_side
        if guide != FRAME and scene.points[centre] == scene.points[contact.at]:
            yield centre, (link,), guide, contact, RADIUS


def _slot(mechanism: DrawnMechanism, pin: str, crank: str, guide: str, along: Vector, half: float) -> PinSlot | None:
    """A slot over all the way of a crank's pin: in a link that turns about a fixed pivot or slides along the frame."""
    scene, spots = mechanism.scene, mechanism.spots
    at, centre, pivot = spots[pin], spots[crank], _pivot(scene, guide)
    radius = math.dist(at, centre)

    def reach(spot: Spot) -> float:
        return (spot[0] - at[0]) * along[0] + (spot[1] - at[1]) * along[1]

    if pivot is None:
        slides = any({guide, FRAME} == set(slide.links) for slide in scene.slides)
        return PinSlot(at, along, half, reach(centre) - radius, reach(centre) + radius, centre) if slides else None
    wheel = spots[pivot]
    foot = reach(wheel)
    if foot > 0:
        along, foot = (-along[0], -along[1]), -foot
    aside, distance = math.sqrt(max(0.0, math.dist(at, wheel) ** 2 - foot * foot)), math.dist(centre, wheel)
    low, high = (math.sqrt(max(0.0, far * far - aside * aside)) for far in (abs(distance - radius), distance + radius))
    alone = len(mechanism.scene.links[guide]) <= 2 and aside < NEAR
    return PinSlot(at, along, half, foot + low, foot + high, centre, wheel if alone else None)
