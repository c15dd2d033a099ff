"""The instantaneous efficiency of a machine in many poses: from the powers of its balances without and with friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from graphplan.check.stream import PoseBatch
from graphplan.cycle.turn import Turn
from graphplan.mechanism.loads import Balance
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.units import metre
from graphplan.methods.kinds import RUBBED
from graphplan.methods.results import balances
from graphplan.solver import Rates, poses
from graphplan.solver.friction import moved_with
from graphplan.solver.tolerances import POWER_TOL


def efficiency_in_poses(scene: Scene, turn: Turn, results: Mapping[str, Mapping[str, Any]]) -> Any:
    """Return the efficiency in each pose of a turn, nan where there is none; None of a machine without friction.

    Where the balances drive, it is the power without by the power with friction. Where the loads drive and the balances
    hold back, it is the inverse: negative where the loads alone do not overcome the friction. Source: Ozols 1974, 14.
    """
    smooth, rubbed = balances(scene, results), balances(scene, results, (RUBBED,))
    if scene.loads is None or not rubbed or smooth.keys() != rubbed.keys():
        return None
    batch = PoseBatch.of_reached(replace(scene, loads=None), turn.points, turn.guides)
    rates = poses.solve(batch.posed_scene, batch.places.size)
    named = scene.loads.named_balances
    power, power_with_friction = (sum(_power(scene, rates, named[name], values[name][batch.places]) for name in named)
                                  for values in (smooth, rubbed))
    ratio = np.full(len(turn.travel), np.nan)
    ratio[batch.places] = _ratio(power, power_with_friction)
    return ratio


def _power(scene: Scene, rates: Rates, balance: Balance, value: Any) -> Any:
    """Return the power that a balance gives, in force * length/s."""
    driven, counter = balance.links
    if not np.iscomplexobj(value):
        omega = {**rates.omega, FRAME: 0.0}
        return value * float(metre(scene.units)) * (omega[driven] - omega[counter])
    (vx, vy), (ux, uy) = (moved_with(rates, link, balance.at) for link in (driven, counter))
    return value.real * (vx - ux) + value.imag * (vy - uy)


def _ratio(smooth: Any, rubbed: Any) -> Any:
    """Return the efficiency from powers without friction and with it; nan where neither gives any."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(smooth > 0, smooth / rubbed, rubbed / smooth)
    ratio = np.where(np.abs(smooth) <= POWER_TOL * np.abs(rubbed), 0.0, ratio)
    return np.where((smooth >= 0) & (rubbed == 0), np.nan, ratio)
