"""The scene `four-bar` as a pylinkage linkage, run by its loop compiled with numba (`step_fast`), its fastest way.

The crank steps on by a fixed angle from where it stands: the first pose is one step from the scene's, the last is it.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

import numba  # noqa: F401  pylinkage falls back to plain Python without it, which is not what is measured
import numpy as np
from numpy.typing import NDArray
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import FixedDyad, RRRDyad
from pylinkage.simulation import Linkage

import graphplan as gp


class Pylinkage:
    """Crank OA, dyad ABC and coupler point M, to be run over one turn in n equal steps."""

    def __init__(self, scene: gp.Scene, n: int):
        O, A, B, C, M = (complex(*map(float, scene.points[name])) for name in "OABCM")
        (drive,) = scene.drives
        pivot, rest = Ground(O.real, O.imag, name="O"), Ground(C.real, C.imag, name="C")
        crank = Crank(pivot, abs(A - O), angular_velocity=2 * math.pi / n, initial_angle=cmath.phase(A - O), name="A")
        dyad = RRRDyad(crank.output, rest, abs(B - A), abs(B - C), x=B.real, y=B.imag, name="B")
        coupler = FixedDyad(crank.output, dyad, abs(M - A), cmath.phase((M - A) / (B - A)), name="M")
        self.n, self.linkage = n, Linkage([pivot, rest, crank, dyad, coupler], name=scene.name)
        self.linkage.set_input_velocity(crank, float(drive.rate), float(drive.change))
        self.linkage.compile()
        self.start: Any = self.linkage.get_coords()

    def positions(self) -> tuple[NDArray[np.float64]]:
        """The positions of O, C, A, B, M, of shape (n, 5, 2)."""
        self.linkage.set_coords(self.start)
        return (self.linkage.step_fast(self.n),)

    def motion(self) -> tuple[NDArray[np.float64], ...]:
        """Positions, velocities and accelerations, each of shape (n, 5, 2)."""
        self.linkage.set_coords(self.start)
        return self.linkage.step_fast_with_kinematics(self.n)

    def read(self, found: tuple[NDArray[np.float64], ...]) -> dict[str, dict[str, NDArray[np.complex128]]]:
        """What these gave as complex arrays by kind and point, the scene's own pose first."""
        plane = np.array([1, 1j])
        return {kind: {name: np.roll(values[:, k] @ plane, 1) for k, name in enumerate("ABM", start=2)}
                for kind, values in zip(("points", "velocity", "acceleration"), found, strict=False)}
