"""Reductions of any loaded linkage: the solver's rates agree, and its reactions balance the energy over the way."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from loads import loaded_scenes

from graphplan.check.reduction import check_reduction
from graphplan.cycle.turn import RangeOfMotion
from graphplan.errors import GraphplanError, Refused
from graphplan.machine.integrals import fit_piecewise
from graphplan.machine.reduced.reduction import Reduction, reduction
from graphplan.mechanism.model import Scene
from graphplan.solver import poses
from graphplan.solver.friction import delivered_power

LINKAGES = 8
TOGETHER = 5
FAR = 0.4  # of the way to a limit: beyond it rates grow without bound
NOTHING = 1e-6  # J: loads are some newtons at arms of millimetres


def reductions(seeds: range) -> Iterator[tuple[int, Scene, Reduction]]:
    """The loaded linkages that can be followed, each over a span that ends well before its limits."""
    for seed in seeds:
        scene = next(loaded_scenes(seed, orders=1), None)
        if scene is None or not scene.loads or not (scene.loads.masses or scene.loads.forces or scene.loads.moments):
            continue
        try:
            reach = scene.extent / 4 if scene.drives[0].slides else 1.0
            path = RangeOfMotion(scene, -reach, reach, closed=False).path
        except Refused:  # its first drive stands still, and leads no others
            continue
        low, high = FAR * float(path.travel[0]), FAR * float(path.travel[-1])
        unit = 1.0 if scene.drives[0].slides else math.degrees(1.0)
        if low < high:
            yield seed, scene, reduction(scene, (low * unit, high * unit))


def delivered_by_balances(scene: Scene, found: Reduction, travel: np.ndarray) -> np.ndarray:
    """The power of the balances that keep the drives at constant rates, by the solver's reactions; in N m/s."""
    turn = found.motion.turn(travel)
    even = scene.with_drives(drive.driven_at(drive.rate, 0) for drive in scene.drives)
    posed = poses.scene_in_poses(even, turn.points, turn.guides)
    held = poses.reactions(posed, poses.solve(posed, travel.size), travel.size)
    return np.asarray(delivered_power(held), float) * found.motion.metres


@pytest.mark.parametrize("first", range(0, LINKAGES, TOGETHER))
def test_reductions_agree_with_the_solver_and_close_the_energy_balance(first: int) -> None:
    """In every pose inertia, moment and slope are the solver's; over the way the work of loads and balances is the
    change of kinetic energy, to 1e-9 of what they do."""
    closed = 0
    for seed, scene, found in reductions(range(first, first + TOGETHER)):
        low, high = found.ends
        check_reduction(found, np.linspace(low, high, 7))
        rate = abs(float(scene.drives[0].rate)) * found.unit
        if not rate:
            continue

        def powers(travel: np.ndarray, scene: Scene = scene, found: Reduction = found) -> np.ndarray:
            done = delivered_by_balances(scene, found, travel) / (abs(float(scene.drives[0].rate)) or 1.0)
            return np.array([done, found.reduce_at(travel).moment * found.unit])

        try:
            if not np.isfinite(powers(np.linspace(low, high, 9))).all():  # the balances cannot hold it in some pose
                continue
            works = fit_piecewise(powers, (low, high), size=NOTHING).total_integral
        except GraphplanError:
            continue
        energy = rate**2 / 2 * found.reduce_at(found.ends).inertia
        size = max(abs(works).sum() + energy.sum(), NOTHING)
        assert abs(works.sum() - (energy[1] - energy[0])) <= 1e-9 * size, f"linkage {seed}"
        closed += 1
    assert closed > TOGETHER / 4
