"""Velocities in proportion to the mechanism: how fast it truly moves is known when it is drawn, not before.

The prescribed velocities say little where a mechanism multiplies them. A drawn velocity longer than its link takes v²/r
off the link, and the semicircle off the paper.
"""

from __future__ import annotations

from graphplan.errors import ConstructionError
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, OMEGA, VELOCITY
from graphplan.methods.motion.time_scale import LONGEST, Tempo, round_down

MAX_VELOCITY = 0.8  # of the mechanism's extent: how long the largest velocity may be drawn
MAX_TURNING = 1.5  # times as long as its arm a relative velocity may be drawn, where its square over that is drawn
MAX_TURNING_OF_CRANK = 3.0  # the same where the crank's velocity ends in its pivot, as books draw it
GOOD_TURNING = 1.2  # the same where it is chosen: the less, the smaller accelerations are beside the mechanism


def slower_tempo(drawing: Construction) -> Tempo | None:
    """The tempo at which velocities are in proportion, where they are drawn too long and the scene gives no scales."""
    if drawing.scene.sheet.kappa:
        return None
    try:
        results = drawing.computed
    except ConstructionError:
        return None
    kappa = float(drawing.tempo.kappa)
    longest = kappa * max((abs(complex(*v)) for v in results.get(VELOCITY, {}).values()), default=0.0)
    driven = {drive.link for drive in drawing.scene.drives}
    rates = {link: abs(rate) for link, rate in results.get(OMEGA, {}).items() if link not in driven}
    turning = kappa * max(rates.values(), default=0.0) if results.get(ACCELERATION) else 0.0
    most = MAX_TURNING_OF_CRANK if drawing.ends_in_pose else MAX_TURNING
    if longest <= MAX_VELOCITY * drawing.scene.extent and turning <= most:
        return None
    lengthwise = LONGEST * drawing.scene.extent / longest if longest else 1.0
    return Tempo(1 / round_down(kappa * min(lengthwise, GOOD_TURNING / turning if turning else 1.0)))
