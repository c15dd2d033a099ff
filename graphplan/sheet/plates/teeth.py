"""The teeth of gears and racks as a picture shows them: a few on either side of each pitch point, with involute flanks.

Wheels that mesh have one module: that of their numbers of teeth, or where a scene gives radii alone, one that suits the
paper. At a pitch point a tooth of the one wheel stands in a gap of the other.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from graphplan.mechanism.model import Gear, Scene
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.symbols import HALF_RACK, Vector, offset
from graphplan.sheet.plates.view import View

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
        """How far a direction is beyond the middle of a tooth, in teeth."""
        return (towards - self.tooth) / self.pitch

    def outline(self, directions: list[float]) -> Iterator[Chain]:
        """Its teeth about these directions, and its tip circle in between."""
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
    """The gears that have teeth, those with their numbers before the others; belts, friction wheels and wheels of too
    few teeth, which are pitch circles alone, have none."""
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
