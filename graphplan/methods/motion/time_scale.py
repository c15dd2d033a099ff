"""How long a drawn velocity is: the time that scales rates to lengths on the plan.

A drawn velocity is kappa times the true one, a drawn acceleration kappa squared times. kappa is round, so that every
plan has a round scale. With one over the crank's angular velocity the orthogonal velocities of the crank reach its
pivot, as with Rosenauer, and every drawn ratio is a plain ratio of rates: it is taken where it is round, and the drawn
velocities are neither lost in the mechanism nor larger than it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from graphplan.mechanism.model import Drive, Number, Scene
from graphplan.mechanism.order import turning_drives

USUAL = 0.25  # of the mechanism's extent: how long the fastest velocity that the scene prescribes is drawn
SERIES = 1, 2, 5  # leading figures of round numbers: beside these most scales of lengths leave those of rates round
SHORTEST, LONGEST = 0.1, 0.5  # the same, where kappa is one over an angular velocity


class Tempo(NamedTuple):
    """The angular velocity that is drawn as one; kappa is its inverse."""

    unit: Number

    @property
    def kappa(self) -> Number:
        return 1 / self.unit

    def rate(self, rate: Number) -> Number:
        """Drawn length of a speed, or drawn ratio of an angular velocity."""
        return rate / self.unit

    def change(self, change: Number) -> Number:
        """Drawn length of an acceleration, or drawn ratio of an angular one."""
        return change / self.unit / self.unit


def tempo(scene: Scene) -> Tempo:
    """The scene's tempo: that of the scales its sheet names; else that of a turning drive, if velocities are then drawn
    well; else the fastest velocity that is prescribed is drawn a quarter of the mechanism."""
    if scene.sheet.kappa:
        return Tempo(1 / scene.sheet.kappa)
    fastest = max(_prescribed_speeds(scene), default=0.0)
    for drive in turning_drives(scene):
        unit = drive.rate if drive.rate > 0 else -drive.rate
        if unit and _is_round(1 / unit) and SHORTEST <= fastest / float(unit) / scene.extent <= LONGEST:
            return Tempo(unit)
    return Tempo(1 / round_number(USUAL * scene.extent / fastest) if fastest else Fraction(1))


def _prescribed_speeds(scene: Scene) -> Iterator[float]:
    """The speeds that the scene prescribes: of drives, and of points with a given motion."""
    for drive in scene.drives:
        yield abs(float(drive.rate)) * (1.0 if drive.slides else _reach(scene, drive))
    for motion in scene.motions.values():
        yield from (abs(float(speed)) for speed in motion.velocity)


def _reach(scene: Scene, drive: Drive) -> float:
    """Largest distance of the points of a turning link, and of slides on it, from the joint about which it turns."""
    own = [*scene.links[drive.link], *(slide.at for slide in scene.slides if drive.link in slide.links)]
    joints = [point for point in own if point in scene.links.get(drive.on, ())] or own
    places = {point: tuple(map(float, scene.points[point])) for point in own}
    return max((math.dist(places[P], places[R]) for P in joints for R in own), default=0.0)


def point_distance(scene: Scene, P: str, R: str) -> float:
    """Distance of two points, the larger of its components."""
    return max(abs(float(p - q)) for p, q in zip(scene.points[P], scene.points[R], strict=True))


def round_number(number: float) -> Fraction:
    """A round number nearby, of the series 1, 2, 5, exactly."""
    digits = f"{number:.0e}"
    lead, power = int(digits[0]), int(digits[2:])
    return Fraction(min((*SERIES, 10), key=lambda step: abs(step - lead))) * Fraction(10) ** power


def round_length(length: float, scene: Scene) -> Fraction:
    """A length nearby that is a round number, as the scales of lengths are; of mm of paper, where the scene gives the
    scale of lengths."""
    unit = scene.sheet.k_s or 1
    return round_number(length / float(unit)) * unit


def round_down(number: float) -> Fraction:
    """The largest number of that series which is no larger, exactly."""
    power = Fraction(10) ** math.floor(math.log10(number))
    power = power if power <= number else power / 10  # a logarithm may be rounded up
    return max(step * power for step in SERIES if step * power <= number)


def _is_round(number: Number) -> bool:
    """Whether a number is of that series."""
    return number == round_number(float(number))
