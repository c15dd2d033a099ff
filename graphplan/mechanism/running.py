"""The machine over its cycle, as a scene asks for it: how evenly it is to run, and how far a run is followed."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from graphplan.mechanism.plane import Number


@dataclass(frozen=True)
class Flywheel:
    """What is asked of a flywheel: the mean `speed` of the first drive (rad/s, or lengths/s), and how even it runs.

    `unevenness` is (omega_max - omega_min) / mean, the mean being half their sum; or the `inertia` (mass * m^2) is
    given and the unevenness asked for. A constant moment on the drive `closes` the cycle, or the loads that change are
    scaled by a constant ("load").
    """

    speed: Number
    unevenness: Fraction | None = None
    inertia: Fraction | None = None
    closes: str = "drive"


@dataclass(frozen=True)
class Run:
    """How far the true motion is followed: from which `speed` of the first drive (rad/s, or lengths/s), over which
    `travel` (degrees, or lengths), and whether it is to come to rest (`stops`); None where nothing is said."""

    speed: Number | None = None
    travel: Fraction | None = None
    stops: bool = False
