"""How long a drawn velocity is: the time that scales rates to lengths on the plan.

A drawn velocity is kappa times the true one, a drawn acceleration kappa squared times. With one crank kappa is one over
its angular velocity (the orthogonal velocities of the crank then reach its pivot, as with Rosenauer), so that every
drawn ratio is a plain ratio of rates.
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from graphplan.mechanism.model import Number, Scene
from graphplan.mechanism.order import turning_drives


class Tempo(NamedTuple):
    """The angular velocity that is drawn as one; kappa is its inverse."""

    unit: Number

    @property
    def kappa(self) -> Number:
        return 1 / self.unit

    def rate(self, rate: Number) -> Number:
        """What is drawn of a speed, as a length, or of an angular velocity, as a ratio to the distance."""
        return rate / self.unit

    def change(self, change: Number) -> Number:
        """What is drawn of an acceleration, as a length, or of an angular one, as a ratio to the distance."""
        return change / self.unit / self.unit


def tempo(scene: Scene) -> Tempo:
    """The scene's tempo: that of the scales its sheet names, or of its first turning drive; else the fastest speed is
    drawn a fifth of the mechanism."""
    if scene.sheet.kappa:
        return Tempo(1 / scene.sheet.kappa)
    for drive in turning_drives(scene):
        if drive.rate:
            return Tempo(drive.rate if drive.rate > 0 else -drive.rate)
    speeds = [drive.rate for drive in scene.drives if drive.slides]
    speeds += [v for motion in scene.motions.values() for v in motion.velocity]
    fastest = max((abs(float(speed)) for speed in speeds), default=0.0)
    return Tempo(round_number(5 * fastest / scene.extent) if fastest else Fraction(1))


def apart(scene: Scene, P: str, R: str) -> float:
    """How far apart two points are."""
    return max(abs(float(p - q)) for p, q in zip(scene.points[P], scene.points[R], strict=True))


def round_number(number: float) -> Fraction:
    """A round number nearby, of the series 1, 2, 5, exactly."""
    digits = f"{number:.0e}"
    lead, power = int(digits[0]), int(digits[2:])
    return Fraction(min((1, 2, 5, 10), key=lambda step: abs(step - lead))) * Fraction(10) ** power
