"""Losses of teeth in random gearings, planetary and with racks among them: drawn, solved, and by the balance of powers.
"""

from __future__ import annotations

from random import Random

import pytest
from loads import loaded_scenes
from test_random_friction import toothed

from graphplan.check.trusted import report
from graphplan.errors import SingularPose
from graphplan.mechanism.model import Gear, Scene
from graphplan.mechanism.scene import parse
from graphplan.solver import Frictional, reactions, with_friction
from graphplan.solver.friction import delivered_power, largest


def lossy(seed: int) -> Scene | None:
    """A machine with gears that lose power; None where this seed gives none."""
    smooth = next(loaded_scenes(seed, 1, toothed), None)
    if smooth is None or not smooth.gears or smooth.repeating or not any(drive.rate for drive in smooth.drives):
        return None
    efficiency = Random(seed).choice(("0.9", "0.97"))
    tables = "".join('[[friction]]\ngear = ["{}", "{}"]\nefficiency = {}\n'.format(*gear.links, efficiency)
                     for gear in smooth.gears)
    return parse(smooth.text.replace("[find]", f"{tables}\n[find]"), f"lossy {seed}")


def lost_power(found: Frictional, gear: Gear, efficiency: float) -> float:
    """The power that a gear loses: of what the driving wheel gives on the arm, the share that is not passed on."""
    scene, rates = found.equations.scene, found.rates
    omega = {"frame": 0.0} | {link: float(rate) for link, rate in rates.omega.items()}
    turning = omega[gear.links[0]] - omega[gear.links[1]]
    if gear.direction is None:
        k1, k2 = map(float, gear.factors)
        turning *= k2 / (k1 + k2)
    (size,), unit = found.higher[gear.name], next(gear.states(scene)).weights(((0, 0), (0, 0)), found.equations.root)[0]
    power = float(size * unit[2]) * turning  # what the force at the pitch point gives the first wheel on the arm
    k = float(gear.factors[1] / gear.factors[0]) if gear.direction is None else float("inf")
    if power < 0:
        return abs(power) * (1 - efficiency) * ((1 + k) / (1 + efficiency * k) if k != float("inf") else 1 / efficiency)
    return abs(power) * (1 - efficiency) * ((1 + k) / (efficiency + k) if k != float("inf") else 1)


@pytest.mark.parametrize("start", [0, 100])
def test_what_teeth_lose_the_balances_give(start: int) -> None:
    """Drawing and solver agree, and the balances give more by what each gear takes."""
    tried = 0
    for seed in range(start, start + 24):
        scene = lossy(seed)
        try:
            if scene is None or not (found := report(scene)).forces or found.forces.locks:
                continue
            rubbed, smooth = with_friction(scene), reactions(scene)
        except SingularPose:
            continue
        assert scene.loads
        efficiencies = {frozenset(one.links): float(1 - one.coefficient) for one in scene.loads.frictions}
        lost = [lost_power(rubbed, gear, efficiencies[frozenset(gear.links)]) for gear in scene.gears]
        if all(abs(rubbed.higher[gear.name][0]) <= 1e-9 * largest(rubbed) for gear in scene.gears):
            continue
        given = float(delivered_power(rubbed)), float(delivered_power(smooth))
        assert given[0] - given[1] == pytest.approx(sum(lost), rel=1e-7, abs=1e-9 * max(map(abs, given)))
        tried += 1
    assert tried > 1
