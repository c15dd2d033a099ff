"""How long velocities, accelerations and forces are drawn, so that they are in proportion to the mechanism.

The prescribed velocities say little where a mechanism multiplies them or makes them small. A drawn velocity longer than
its link takes v²/r off the link, and the semicircle off the paper; of one that is short beside the mechanism a pencil's
slips are a large part, and v²/r is next to nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from graphplan.errors import ConstructionError
from graphplan.mechanism.model import Number
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, OMEGA, VELOCITY
from graphplan.methods.motion.time_scale import LONGEST, SHORTEST, round_down, round_length
from graphplan.methods.panels import MECHANISM


class Sizes(NamedTuple):
    """Sizes of rates: the longest velocity and acceleration relative to the mechanism's extent, the longest relative
    velocity relative to its arm."""

    velocity: float
    acceleration: float
    turning: float

    def are_within(self, limits: Sizes, times: float = 1.0) -> bool:
        """Whether they are no larger than some limits where velocities are so many times as long."""
        return (times * self.velocity <= limits.velocity and times * self.turning <= limits.turning
                and (times**2 * self.acceleration <= limits.acceleration or not self.velocity))


LARGEST = Sizes(0.8, 10.0, 1.5)  # rates that are drawn as they are
MAX_TURNING_OF_CRANK = 3.0  # the same where the crank's velocity ends in its pivot, as books draw it
LARGEST_TRIED = Sizes(1.0, 10.0, MAX_TURNING_OF_CRANK)  # where other lengths are tried
GOOD = Sizes(0.4, 8.0, 1.2)  # as large rates are drawn where others are chosen
MIN_GAIN = 1.6  # times as long velocities become at least where they are made longer
LOST = 0.01  # of the extent: what moves less beside its drive is at rest, or nearly so
MAX_LOAD, GOOD_LOAD = 1.5, 0.5  # of the extent: how long the largest load may be drawn, and is if made shorter
OTHER_LENGTHS = 0.5, 2.5  # times as long velocities are tried at most: by one round number shorter or longer


def sizes(drawing: Construction) -> Sizes:
    """Sizes of a construction's rates; fails if it has no numbers."""
    results, kappa, extent = drawing.computed, drawing.kappa, drawing.scene.extent
    longest, largest = (max((math.hypot(*vector) for vector in results.get(kind, {}).values()), default=0.0)
                        for kind in (VELOCITY, ACCELERATION))
    driven = {drive.link for drive in drawing.scene.drives}
    rates = [abs(rate) for link, rate in results.get(OMEGA, {}).items() if link not in driven]
    turning = kappa * max(rates, default=0.0) if results.get(ACCELERATION) else 0.0
    return Sizes(kappa * longest / extent, kappa**2 * largest / extent, turning)


def better_kappa(drawing: Construction) -> Fraction | None:
    """The kappa at which velocities, or from rest accelerations on the mechanism plan, are in proportion, where they
    are drawn too long or too short."""
    longest, larger, turning = lengths = sizes(drawing)
    kappa, most = drawing.kappa, MAX_TURNING_OF_CRANK if drawing.ends_in_pose else LARGEST.turning
    if not longest and larger and _has_one_plan(drawing) and not SHORTEST <= larger <= LARGEST.velocity:
        return round_down(kappa * math.sqrt(GOOD.velocity / larger))
    if lengths.are_within(LARGEST._replace(turning=most)):
        if drawing.ends_in_pose or longest < LOST:
            return None
        longer = min(GOOD.velocity / longest, 1.0 / turning if turning else math.inf,
                     math.sqrt(GOOD.acceleration / larger) if larger else math.inf)
        faster = round_down(kappa * longer)
        return faster if faster >= MIN_GAIN * kappa else None
    lengthwise = LONGEST / longest if longest else 1.0
    slower = math.sqrt(GOOD.acceleration / larger) if larger > LARGEST.acceleration else 1.0
    slower = max(slower, min(1.0, SHORTEST / longest)) if longest else 1.0
    return round_down(kappa * min(lengthwise, GOOD.turning / turning if turning else 1.0, slower))


def _has_one_plan(drawing: Construction) -> bool:
    """Whether accelerations lie on the mechanism plan, at a scale that must be round beside that of velocities."""
    program = drawing.program
    return any(program.steps[program.wanted[reading.marks[-1]]].panel == MECHANISM
               for reading in drawing.readings if reading.kind == ACCELERATION and reading.marks)


def better_phi(drawing: Construction) -> Number | None:
    """Drawn length of a unit of force if loads would be much longer than the mechanism, as inertia forces near a limit
    position; else None."""
    program, truth = drawing.program, drawing.truth
    ends = [[truth[program.wanted[mark]][:2] for mark in arrow.marks] for arrow in drawing.force_arrows
            if arrow.kind == "load" and program.steps[program.wanted[arrow.marks[-1]]].panel == MECHANISM]
    longest = max((math.dist(*span) for span in ends), default=0.0) / drawing.scene.extent
    return round_length(float(drawing.phi) * GOOD_LOAD / longest, drawing.scene) if longest > MAX_LOAD else None


def other_kappas(drawing: Construction) -> Iterator[Fraction]:
    """Yield other lengths of velocities within proportion, shorter ones first."""
    try:
        lengths = sizes(drawing)
    except ConstructionError:
        return
    for times in OTHER_LENGTHS:
        kappa = round_down(times * drawing.kappa)
        if times < 1 or lengths.are_within(LARGEST_TRIED, float(kappa) / drawing.kappa):
            yield kappa
