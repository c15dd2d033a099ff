"""Involute wheels cut by the rack (Ozols 1974, chapter 21).

The rack is a conjugate profile whose flank is straight: its foot from P is a point of the line of action. Its corner is
round, of the radius c/(1 - sin alpha) that touches flank and tip, and cuts the fillet, a parallel curve of a trochoid,
which takes away what is undercut. Printed in (21.27) as m, the addendum is meant; teeth are pointed by (21.28), not
(21.29).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from graphplan.errors import NoMechanism
from graphplan.kernel.numbers.arrays import sign_change
from graphplan.mechanism.numbers import number_text
from graphplan.phrases import digits, said
from graphplan.synthesis.requests import GearTask
from graphplan.synthesis.sketch import Synthesis, SynthesisBoard, pair, place_of
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import ANGLE_STEP, LENGTH_TOL

FLANK_SAMPLES, FILLET_SAMPLES, ARC_SAMPLES, NEWTON_ROUNDS = 24, 24, 8, 60
RACK_POSITIONS, INVOLUTE_POINTS = 5, 6


def involute(angle: float) -> float:
    """The involute function: tan minus the angle."""
    return math.tan(angle) - angle


def inverse_involute(value: float) -> float:
    """The angle whose involute function is this, by Newton's rule from above, where it converges always."""
    angle = min((3 * value) ** (1 / 3), 1.5) if value < 2 else math.atan(value + 1.5)
    for _ in range(NEWTON_ROUNDS):
        step = (involute(angle) - value) / math.tan(angle) ** 2 if angle else 0.0
        angle -= step
        if abs(step) <= ANGLE_STEP:
            break
    return angle


@dataclass(frozen=True)
class InvoluteWheel:
    """One wheel: `shift` in modules, outwards; `ring` has its teeth inside."""

    module: float
    teeth: int
    angle: float  # of the rack, in radians
    shift: float
    addendum: float
    clearance: float
    ring: bool = False

    @property
    def pitch(self) -> float:
        return self.module * self.teeth / 2

    @property
    def base(self) -> float:
        return self.pitch * math.cos(self.angle)

    @property
    def _outwards(self) -> int:
        return -1 if self.ring else 1

    @property
    def tip(self) -> float:
        return self.pitch + self.module * (self._outwards * self.addendum + self.shift)

    @property
    def root(self) -> float:
        return self.pitch - self.module * (self._outwards * (self.addendum + self.clearance) - self.shift)

    @property
    def thickness(self) -> float:
        """The arc of a tooth on the pitch circle."""
        return self.module * (math.pi / 2 + self._outwards * 2 * self.shift * math.tan(self.angle))

    @property
    def least_shift(self) -> float:
        """The shift of the rack below which it undercuts, in modules; it may be negative."""
        return self.addendum - self.teeth * math.sin(self.angle) ** 2 / 2

    @property
    def undercut(self) -> bool:
        return not self.ring and self.shift < self.least_shift - LENGTH_TOL

    def half_angle(self, radius: float) -> float:
        """Half the angle under which a tooth is seen from the centre at a radius; negative beyond its point."""
        at = math.acos(min(1.0, self.base / radius))
        return self.thickness / (2 * self.pitch) + self._outwards * (involute(self.angle) - involute(at))

    @property
    def is_pointed(self) -> bool:
        """Whether its flanks meet below the tip circle."""
        return self.half_angle(max(self.tip, self.base)) <= 0

    @property
    def numbers(self) -> dict[str, Any]:
        """Dimensions of the wheel by name, for JSON."""
        names = "pitch", "base", "tip", "root", "thickness", "undercut", "least_shift"
        return {name: getattr(self, name) for name in names} | {"pointed": self.is_pointed}

    @property
    def corner(self) -> tuple[complex, float]:
        """The rack's round corner: its centre, along the rack from the middle of a tooth and outwards from the pitch
        circle, and its radius."""
        half = math.pi / 4 - self.addendum * math.tan(self.angle)  # of the tooth where its flank ends
        radius = self.module * min(self.clearance / (1 - math.sin(self.angle)), max(half, 0.0) / math.cos(self.angle))
        ends = self.module * complex(half, self.shift - self.addendum)
        return ends - radius * cmath.rect(1.0, -self.angle), radius

    def fillet_point(self, roll: float) -> complex:
        """The point of the fillet that is cut when the rack has rolled so far from the middle of the gap: on the normal
        through the pole."""
        centre, radius = self.corner
        arm = centre - roll
        touched = centre - math.copysign(radius, arm.imag) * arm / abs(arm) if radius and arm else centre
        cut = (self.pitch + touched.imag + 1j * (touched.real - roll)) * cmath.rect(1.0, roll / self.pitch)
        return cut.conjugate() * cmath.rect(1.0, math.pi / self.teeth)

    def fillet(self) -> list[complex]:
        """The fillet from the root to the flank: where the tooth is undercut, to where it cuts the involute off."""
        centre, _ = self.corner
        rolls = _even(centre.real, centre.real + centre.imag / math.tan(self.angle), FILLET_SAMPLES)
        points = [self.fillet_point(roll) for roll in rolls]
        within = [k for k, z in enumerate(points) if self._cuts_involute(z)] if self.undercut else []
        if not within or within[-1] == FILLET_SAMPLES:
            return points
        end = sign_change(lambda roll: self._cuts_involute(self.fillet_point(roll)), *rolls[within[-1]:within[-1] + 2])
        return [*points[:within[-1] + 1], self.fillet_point(end)]

    def _cuts_involute(self, z: complex) -> bool:
        """Whether a point of the fillet lies within the tooth that the involutes bound."""
        return abs(z) < self.base or cmath.phase(z) < self.half_angle(abs(z))

    def flank(self) -> Iterator[complex]:
        """The flank of a tooth about +x from the root, over the fillet, to the tip or to its point; of a ring, whose
        root no rack cuts, the involute alone."""
        fillet = [] if self.ring else self.fillet()
        ends = sorted((max(abs(fillet[-1]) if fillet else self.root, self.base), max(self.tip, self.base)))
        if self.is_pointed and not self.ring:
            ends[1] = self.base / math.cos(inverse_involute(involute(self.angle) + self.thickness / (2 * self.pitch)))
        low, high = (math.sqrt(max(0.0, end**2 - self.base**2)) for end in ends)
        radii = [math.hypot(self.base, s) for s in _even(low, high, FLANK_SAMPLES)]
        if self.ring:
            radii.reverse()
        yield from fillet[:-1]
        yield from (cmath.rect(radius, self.half_angle(radius)) for radius in radii)

    def tooth(self) -> list[complex]:
        """The outline of one tooth about +x, clockwise: from the middle of a gap to that of the next."""
        flank, gap = list(self.flank()), math.pi / self.teeth
        start, end = cmath.phase(flank[0]), cmath.phase(flank[-1])
        root = [cmath.rect(abs(flank[0]), angle) for angle in _even(gap, start, ARC_SAMPLES)]
        tip = [cmath.rect(abs(flank[-1]), angle) for angle in _even(end, 0.0, ARC_SAMPLES)]
        half = [*root[:-1], *flank, *tip[1:]]
        return [*half, *(z.conjugate() for z in reversed(half[:-1]))]


def _even(low: float, high: float, count: int) -> list[float]:
    return [low + (high - low) * k / count for k in range(count + 1)]


@dataclass(frozen=True)
class GearPair:
    """Two wheels in mesh: wheel 1 at the origin drives counter-clockwise, O2 lies on +x."""

    request: GearTask
    name: str

    @property
    def wheels(self) -> tuple[InvoluteWheel, InvoluteWheel]:
        request, angle = self.request, math.radians(self.request.pressure_angle)
        plain = [InvoluteWheel(request.module, teeth, angle, 0.0, request.addendum, request.clearance,
                               request.internal and k == 1) for k, teeth in enumerate(request.teeth)]
        least = tuple(max(0.0, 0.0 if wheel.ring else wheel.least_shift) for wheel in plain)
        shifts = request.shift if isinstance(request.shift, tuple) else least
        pinion, wheel_2 = (replace(wheel, shift=float(shift)) for wheel, shift in zip(plain, shifts, strict=True))
        return pinion, wheel_2

    @property
    def _sign(self) -> int:
        return -1 if self.request.internal else 1

    @property
    def working_angle(self) -> float:
        """The pressure angle in mesh, in radians, by the sum of the shifts (of a ring the difference)."""
        pinion, wheel_2 = self.wheels
        sum_of_teeth = wheel_2.teeth + self._sign * pinion.teeth
        shifts = wheel_2.shift + self._sign * pinion.shift
        value = involute(pinion.angle) + 2 * shifts * math.tan(pinion.angle) / sum_of_teeth
        if value <= 0:
            raise NoMechanism(f"{self.name}: gear.shift", "with these shifts the wheels mesh without play at no "
                              "distance", "larger shifts")
        return pinion.angle if value == involute(pinion.angle) else inverse_involute(value)

    @property
    def centres(self) -> float:
        pinion, wheel_2 = self.wheels
        return (wheel_2.base + self._sign * pinion.base) / math.cos(self.working_angle)

    @property
    def line(self) -> dict[str, complex]:
        """The line of action: where it touches the base circles, where contact begins and ends, and P."""
        pinion, wheel_2 = self.wheels
        radius = cmath.rect(1.0, -self.working_angle) * self._sign
        way = 1j * radius
        N1, N2 = pinion.base * radius, self.centres - self._sign * wheel_2.base * radius
        two_leg, one_leg = (math.sqrt(max(0.0, wheel.tip**2 - wheel.base**2)) for wheel in (wheel_2, pinion))
        return {"N1": N1, "A": N2 - self._sign * two_leg * way, "P": complex(self._sign * pinion.base / math.cos(
            self.working_angle)), "B": N1 + one_leg * way, "N2": N2}

    def advance(self, name: str) -> float:
        """Distance of a point of the line of action beyond N1, in the direction of contact."""
        return ((self.line[name] - self.line["N1"]) / (1j * cmath.rect(1.0, -self.working_angle) * self._sign)).real

    @property
    def contact_ratio(self) -> float:
        pitch = math.pi * self.request.module * math.cos(self.wheels[0].angle)
        return (self.advance("B") - self.advance("A")) / pitch

    @property
    def defects(self) -> list[str]:
        """Undercut, interference, and a contact ratio below 1."""
        slack = LENGTH_TOL * self.centres
        defects = [f"undercut {k}" for k, wheel in enumerate(self.wheels, 1) if wheel.undercut]
        defects += ["interference 1"] if self.advance("A") < -slack or self.wheels[1].tip < self.wheels[1].base else []
        beyond = not self.request.internal and self.advance("B") > self.advance("N2") + slack
        defects += ["interference 2"] if beyond else []
        return defects + (["contact ratio"] if self.contact_ratio < 1 else [])


def synthesize_gear(task: SynthesisTask) -> Synthesis:
    """The wheels of a gear task, and their mesh as it is drawn."""
    gears = GearPair(task.request, task.name)
    require_teeth(gears)
    sketch = draw_gears(gears)
    values = sketch.values()
    line = {name: pair(place_of(values, name)) for name in ("N1", "A", "P", "B", "N2")}
    results = {"wheels": [wheel.numbers for wheel in gears.wheels], "centres": gears.centres,
               "working_angle": math.degrees(gears.working_angle), "line": line, "contact_ratio": gears.contact_ratio,
               "defects": gears.defects, "profile": [[pair(z) for z in wheel.tooth()] for wheel in gears.wheels]}
    return Synthesis(task, (values,), (), results)


def draw_gears(gears: GearPair) -> SynthesisBoard:
    """Pitch circles, line of action, base circles, an involute rolled, tip circles, A and B, positions of the rack."""
    sketch = SynthesisBoard()
    board, (pinion, wheel_2), angle = sketch.board, gears.wheels, math.degrees(gears.working_angle)
    O1, O2 = sketch.given(0j, "O_1"), sketch.given(complex(gears.centres), "O_2")
    ring = gears.request.internal
    with sketch.stage(said("Pitch circles"), said("they touch in the pole P and roll on each other")):
        centres = board.line(O1, O2)
        working = [wheel.base / math.cos(gears.working_angle) for wheel in (pinion, wheel_2)]
        P = sketch.keep("P", board.lay_along(centres, O1, length=-working[0] if ring else working[0], name="P"))
        for O in (O1, O2):
            sketch.keep("pitch circle", board.circle(O, board.opening(O, P)))
    with sketch.stage(said("Line of action"), said("through P, inclined to the common tangent by the pressure angle")):
        action = sketch.keep("action", sketch.ray(P, (270 if ring else 90) - angle))
        N1, N2 = (sketch.keep(name, board.foot(action, O, name=f"N_{k}"))
                  for k, (name, O) in enumerate((("N1", O1), ("N2", O2)), 1))
        for O, N in ((O1, N1), (O2, N2)):
            sketch.keep("base circle", board.circle(O, board.opening(O, N)))
    with sketch.stage(said("Involute"), said("the line of action rolls on the base circle, and its point P draws it")):
        for k, (O, wheel) in enumerate(((O1, pinion), (O2, wheel_2))):
            at, circle = gears.line[f"N{k + 1}"], sketch.roles["base circle"][k]
            roll_line(sketch, O, circle, wheel, cmath.phase(at - k * gears.centres), abs(gears.line["P"] - at))
    with sketch.stage(said("Contact"), said("it begins at A, on the tip circle of wheel 2, and ends at B, on that of "
                                            "wheel 1")):
        for name, O, wheel, way in (("A", O2, wheel_2, "on" if ring else "back"), ("B", O1, pinion, "on")):
            circle = sketch.keep("tip circle", board.circle(O, board.radius(length=wheel.tip)))
            if wheel.tip > wheel.base:
                sketch.keep(name, board.line_meets_circle(action, circle, way=way, name=name))
            else:
                sketch.keep(name, N2 if wheel is wheel_2 else N1)
    with sketch.stage(said("Rack"), said("its flank touches the tooth where the normal through P meets it")):
        _rack(sketch, P, pinion, angle, ring)
    return sketch


def roll_line(sketch: SynthesisBoard, O: Any, circle: Any, wheel: InvoluteWheel, start: float, first: float) -> None:
    """Points of an involute: on tangents to the base circle the arc that is rolled off is laid off."""
    board = sketch.board
    for k in range(1, INVOLUTE_POINTS + 1):
        rolled = k * first / (INVOLUTE_POINTS - 2)
        turn = math.degrees(start + (rolled - first) / wheel.base)
        T = board.line_meets_circle(sketch.ray(O, turn), circle, way="on")
        tangent = board.perpendicular(sketch.ray(O, turn), T)
        sketch.keep("involute", board.lay_along(tangent, T, length=-rolled, why=said("the arc that is rolled off: {0}",
                                                                                    digits(rolled))))


def _rack(sketch: SynthesisBoard, P: Any, wheel: InvoluteWheel, angle: float, ring: bool) -> None:
    """Positions of the rack's flank, and the points in which it touches."""
    board = sketch.board
    for k in range(RACK_POSITIONS):
        shift = wheel.module * (k - RACK_POSITIONS // 2) / 2
        pitch_line = sketch.ray(P, 270 if ring else 90)
        foot = board.lay_along(pitch_line, P, length=shift, name=f"R_{k + 1}") if shift else P
        flank = sketch.keep("rack", sketch.ray(foot, (180 if ring else 0) - angle))
        sketch.keep("rack contact", board.foot(flank, P) if shift else P)


def require_teeth(gears: GearPair) -> None:
    """Fail with `NoMechanism` where a wheel has no teeth, or the wheels no mesh."""
    for k, wheel in enumerate(gears.wheels, 1):
        if wheel.thickness <= 0 or wheel.root <= 0 or (wheel.tip - wheel.root) * (-1 if wheel.ring else 1) <= 0:
            raise NoMechanism(f"{gears.name}: gear.shift", f"wheel {k} has no teeth with a shift of "
                              f"{number_text(wheel.shift)} modules", "a shift nearer to 0")
