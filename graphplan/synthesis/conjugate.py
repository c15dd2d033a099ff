"""Conjugate profiles by Willis' normal: body 1 as the envelope of body 2 (Ozols 1974, 19-1, 19-2 with fig. 19-6).

Body 2 is turned about O1 against phi while body 1 stands still; it touches where the normal from the relative pole P
meets its profile. P lies on the line of centres, O1P : O2P = omega 2 : omega 1; of a body that shifts it lies
perpendicular to the shift.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.errors import NoMechanism
from graphplan.kernel.numbers.arrays import sign_change
from graphplan.kernel.program import Mark
from graphplan.phrases import arrange, digits, said
from graphplan.synthesis.requests import ConjugateTask
from graphplan.synthesis.sketch import Synthesis, SynthesisBoard, pair
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import LENGTH_TOL, SAME_POINT_TOL

CUSP_SAMPLES, CUSP_STEP = 1440, 1e-3  # the step in radians
STENCIL = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}  # the derivative by four neighbours


class Spline:
    """The cubic spline through points, its third derivative continuous at the last but one; with its derivatives."""

    def __init__(self, rows: Sequence[tuple[float, float]]):
        x, y = (np.array(column, float) for column in zip(*rows, strict=True))
        self.x, n = x, len(x)
        h, slope = np.diff(x), np.diff(y) / np.diff(x)
        table, right = np.zeros((n, n)), np.zeros(n)
        for k in range(1, n - 1):
            table[k, k - 1:k + 2] = h[k - 1], 2 * (h[k - 1] + h[k]), h[k]
            right[k] = 6 * (slope[k] - slope[k - 1])
        if n == 2:
            table[:] = np.eye(2)
        elif n == 3:
            table[0, :2], table[2, 1:] = (1, -1), (1, -1)
        else:
            table[0, :3] = h[1], -h[0] - h[1], h[0]
            table[-1, -3:] = h[-1], -h[-2] - h[-1], h[-2]
        bend = np.linalg.solve(table, right)
        rate = slope - h * (2 * bend[:-1] + bend[1:]) / 6
        self.pieces = np.stack([np.diff(bend) / (6 * h), bend[:-1] / 2, rate, y[:-1]])

    def __call__(self, at: float, order: int = 0) -> float:
        """The value at a place, or a derivative there."""
        k = min(max(int(np.searchsorted(self.x, at, "right")) - 1, 0), len(self.x) - 2)
        polynomial = np.poly1d(self.pieces[:, k])
        return float((polynomial.deriv(order) if order else polynomial)(at - self.x[k]))


@dataclass(frozen=True)
class ConjugateMotion:
    """Motion of body 2 by body 1, angles in radians: psi (or the shift) and its derivatives, pole and profile."""

    request: ConjugateTask

    @cached_property
    def _law(self) -> Spline | None:
        return Spline(self.request.law) if self.request.law else None

    def psi(self, phi: float, order: int = 0) -> float:
        """The turn of body 2 in radians, or its shift, or the derivative by phi in radians."""
        if self._law is None:
            return self.request.ratio if order else self.request.ratio * phi
        value = self._law(math.degrees(phi), order) - (self._law(0.0) if order == 0 else 0.0)
        return math.radians(value) * math.degrees(1.0) ** order

    def pole(self, phi: float) -> complex:
        """P, where both bodies have one velocity."""
        rate = self.psi(phi, 1)
        if self.request.translating:
            return complex(rate)
        if abs(rate - 1) <= LENGTH_TOL:
            raise NoMechanism("conjugate.law", f"at {math.degrees(phi):g} degrees both bodies turn alike, so that "
                              "there is no pole", "a law whose slope is not 1")
        return complex(self.request.centres * rate / (rate - 1))

    def point_at(self, z: complex, phi: float) -> complex:
        """Place of a point of body 2."""
        return self._moved_by(z, self.psi(phi))

    def _moved_by(self, z: complex, psi: float) -> complex:
        if self.request.translating:
            return z + 1j * psi
        O2 = self.request.centres
        return O2 + (z - O2) * cmath.exp(1j * psi)

    def in_body_1(self, z: complex, phi: float) -> complex:
        """A point of the fixed plane as a point of body 1 at phi = 0."""
        return z * cmath.exp(-1j * phi)

    def in_body_2(self, z: complex, phi: float) -> complex:
        """Place of a point relative to body 2."""
        return self._moved_by(z, -self.psi(phi))

    # ---- touching --------------------------------------------------------------------------------------------------

    def contact(self, phi: float, side: int | None = None) -> complex:
        """Contact point of the profiles; of a circle on this side of its centre, else on that nearer to O1."""
        profile, P = self.request.profile, self.pole(phi)
        if "point" in profile:
            return self.point_at(complex(*profile["point"]), phi)
        if "line" in profile:
            q, r = (self.point_at(complex(*point), phi) for point in profile["line"])
            u = (r - q) / abs(r - q)
            return q + u * ((P - q) / u).real
        c = self.point_at(complex(*profile["circle"]), phi)
        return c + (side or self.side(phi)) * float(profile["radius"]) * (P - c) / abs(P - c)

    def side(self, phi: float) -> int:
        """Crossing of the normal with a circle that is nearer to O1: 1 towards P, or -1; of a line 1."""
        if "circle" not in self.request.profile:
            return 1
        c = self.point_at(complex(*self.request.profile["circle"]), phi)
        return 1 if (c.conjugate() * (self.pole(phi) - c)).real <= 0 else -1

    def creeping(self, phi: float) -> float:
        """Rate of the contact along the profile of body 1, by phi, by differences; 0 at a cusp."""
        profile, side = self.request.profile, self.side(phi)
        speed = sum(weight * self.in_body_1(self.contact(phi + k * CUSP_STEP, side), phi + k * CUSP_STEP)
                    for k, weight in STENCIL.items()) / CUSP_STEP
        first, last = (self.point_at(complex(*point), phi) for point in profile.get("line") or 2 * [profile["circle"]])
        along = last - first or 1j * (self.contact(phi) - first)
        return (speed / self.in_body_1(along / abs(along), phi)).real

    def cusps(self) -> list[float]:
        """The angles at which the profile of body 1 has cusps."""
        low, high = map(math.radians, self.request.span)
        angles = [low + (high - low) * k / CUSP_SAMPLES for k in range(CUSP_SAMPLES + 1)]
        if "point" in self.request.profile:  # where it passes through the pole
            off = [abs(self.contact(phi) - self.pole(phi)) for phi in angles]
            return [phi for phi, d in zip(angles, off, strict=True) if d <= SAME_POINT_TOL * self.request.size]
        values = [self.creeping(phi) for phi in angles]
        sides = [*map(self.side, angles)]
        return [sign_change(self.creeping, angles[k], angles[k + 1]) for k in range(CUSP_SAMPLES)
                if (values[k] > 0) != (values[k + 1] > 0) and sides[k] == sides[k + 1]]


def synthesize_conjugate(task: SynthesisTask) -> Synthesis:
    """The profile of body 1 by points, with centrodes and cusps."""
    motion = ConjugateMotion(task.request)
    low, high = task.request.span
    divisions = task.request.divisions
    degrees = [low + (high - low) * k / divisions for k in range(divisions + 1)]
    angles = [math.radians(degree) for degree in degrees]
    drawing = ConjugateSketch(task, motion, angles)
    values = drawing.sketch.values()
    contacts = [complex(*at) for at in values.values_of_role("K")]  # in body 1, which stands still
    rows = [[degree, *pair(z * cmath.exp(1j * phi)), *pair(z)]
            for degree, phi, z in zip(degrees, angles, contacts, strict=True)]
    poles = [motion.pole(phi) for phi in angles]
    centrodes = {body: [pair(in_body(P, phi)) for P, phi in zip(poles, angles, strict=True)]
                 for body, in_body in (("1", motion.in_body_1), ("2", motion.in_body_2))}
    cusps = [[math.degrees(phi), *pair(motion.contact(phi)), *pair(motion.in_body_1(motion.contact(phi), phi))]
             for phi in motion.cusps()]
    return Synthesis(task, (values,), (), {"contacts": rows, "centrodes": centrodes, "cusps": cusps})


class ConjugateSketch:
    """The inversion: body 1 stands still, and line of centres and body 2 go round O1 against phi."""

    def __init__(self, task: SynthesisTask, motion: ConjugateMotion, angles: Sequence[float]):
        self.task, self.motion, self.sketch = task, motion, SynthesisBoard()
        request, board = task.request, self.sketch.board
        self.O1 = self.sketch.given(0j, "O_1")
        O2 = None if request.translating else self.sketch.given(complex(request.centres), "O_2")
        profile = request.profile
        self.marks = [self.sketch.given(complex(*point), name)
                      for point, name in zip(self._points(), "QR" if "line" in profile else "B", strict=True)]
        with self.sketch.stage(said("Inversion"), said("body 1 stands still; the line of centres turns against it, and "
                                                       "body 2 on it as far as it has turned or shifted")):
            self.radius = board.radius(length=profile["radius"]) if "circle" in profile else None
            self.centres = board.circle(self.O1, board.opening(self.O1, O2)) if O2 is not None else None
            for k, phi in enumerate(angles):
                self._division(k, phi)

    def _division(self, k: int, phi: float) -> None:
        """Body 2 and the pole at one division, and where the normal through the pole meets the profile."""
        motion, sketch, board = self.motion, self.sketch, self.sketch.board
        why = arrange("{0} = {1}°", "φ", digits(math.degrees(phi)))
        axis = sketch.keep("ray", sketch.ray(self.O1, -math.degrees(phi), why=why))
        pole = motion.pole(phi)
        P = self.O1 if abs(pole) <= LENGTH_TOL * self.task.request.size else board.lay_along(
            axis, self.O1, length=pole.real, name=f"P_{k}")
        places = [self._turn_back_point(mark, complex(*point), phi, k) for mark, point in zip(
            self.marks, self._points(), strict=True)]
        sketch.keep("P", P)
        if len(places) == 2:
            face = sketch.keep("profile", board.line(*places))
            sketch.keep("K", board.foot(face, P, name=f"K_{k}"))
        elif self.radius is None:
            sketch.keep("K", places[0])
        else:
            centre = motion.point_at(complex(*self.task.request.profile["circle"]), phi)
            if abs(centre - pole) <= SAME_POINT_TOL * self.task.request.size:
                raise NoMechanism(f"{self.task.name}: conjugate.profile", f"at {math.degrees(phi):g} degrees the "
                                  "centre of the circle is the pole P, so that no normal is determined",
                                  "another circle, or another range")
            circle = sketch.keep("profile", board.circle(places[0], self.radius))
            normal = board.line(places[0], P)
            heading = "on" if motion.side(phi) > 0 else "back"
            sketch.keep("K", board.line_meets_circle(normal, circle, way=heading, name=f"K_{k}"))

    def _points(self) -> list[Any]:
        profile = self.task.request.profile
        return list(profile["line"]) if "line" in profile else [profile.get("circle", profile.get("point"))]

    def _turn_back_point(self, mark: Mark, point: complex, phi: float, k: int) -> Mark:
        """A point of body 2 as it lies when body 1 is turned back: on its line of centres, or shifted."""
        board, sketch, motion = self.sketch.board, self.sketch, self.motion
        axis = sketch.ray(self.O1, -math.degrees(phi))
        if self.task.request.translating:
            frame, origin, w = axis, self.O1, motion.point_at(point, phi)
        else:
            origin = board.line_meets_circle(axis, self.centres, way="on", name=f"O_2,{k}")
            frame = sketch.ray(origin, math.degrees(motion.psi(phi) - phi), why=arrange(
                "{0} = {1}°", "ψ", digits(math.degrees(motion.psi(phi)))))
            w = point - self.task.request.centres
        return sketch.keep("B", board.set_off(frame, origin, dx=w.real, dy=w.imag, ux=1, uy=0))
