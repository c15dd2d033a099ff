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
    power, power_with_friction = (sum(_power(scene, rates, named[name], values[name][batch.places], rubs)
                                      for name in named) for values, rubs in ((smooth, False), (rubbed, True)))
    ratio = np.full(len(turn.travel), np.nan)
    ratio[batch.places] = _ratio(power, power_with_friction)
    return ratio


def _power(scene: Scene, rates: Rates, balance: Balance, value: Any, rubs: bool) -> Any:
    """Return the power that a balance gives, in force * length/s; with the friction of its screw where it `rubs`."""
    driven, counter = balance.links
    if not np.iscomplexobj(value):
        omega = {**rates.omega, FRAME: 0.0}
        return value * float(metre(scene.units)) * (omega[driven] - omega[counter])
    (vx, vy), (ux, uy) = (moved_with(rates, link, balance.at) for link in (driven, counter))
    share = _screw_share(scene, rates, balance, value) if rubs else 1.0
    return share * (value.real * (vx - ux) + value.imag * (vy - uy))


def _screw_share(scene: Scene, rates: Rates, balance: Balance, value: Any) -> Any:
    """Return by how many times friction makes the moment on a screw larger through which a balance acts."""
    screw = scene.loads.screw_of(balance) if scene.loads else None
    if screw is None or scene.loads is None:
        return 1.0
    slide = next(slide for slide in rates.equations.scene.slides if {*slide.links} == {*balance.links})
    (dx, dy), (sx, sy) = slide.direction, rates.slide_velocity[slide.name]
    still = 0 if slide.name in scene.loads.resting else 1 if balance.link == slide.link else -1
    slip: Any = sx * dx + sy * dy
    sense = still * np.sign(slip) * np.sign(value.real * dx + value.imag * dy)
    shares = {turn: float(screw.circumferential(turn) / screw.slope) for turn in (-1, 0, 1)}
    return np.select([sense == turn for turn in shares], [*shares.values()], np.nan)


def _ratio(smooth: Any, rubbed: Any) -> Any:
    """Return the efficiency from powers without friction and with it; nan where neither gives any."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(smooth > 0, smooth / rubbed, rubbed / smooth)
    ratio = np.where(np.abs(smooth) <= POWER_TOL * np.abs(rubbed), 0.0, ratio)
    return np.where((smooth >= 0) & (rubbed == 0), np.nan, ratio)
