"""A governor against the potential energy: the force of its balls is how that grows with their distance.

No velocity is used: positions alone, differences of weights' heights and springs' lengths over differences of r. Loads
without a potential energy, what else the reduction says, and the forces with friction are compared with the solver.
"""

from __future__ import annotations

import numpy as np

from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.stream import PoseBatch, single_pose
from graphplan.check.tolerances import ENVELOPE_TOL, FRICTION_TOL, STENCIL_STEP
from graphplan.cycle.linkage import Array
from graphplan.machines.governor.governor import GovernorDrawing, GovernorResult
from graphplan.machines.reduced.check import check_lever, check_reduction
from graphplan.machines.reduced.reduced_loads import LoadOnLink
from graphplan.mechanism.load_values import spring_laws, spring_numbers
from graphplan.mechanism.units import METRES, NEWTONS
from graphplan.solver import with_friction
from graphplan.solver.friction import delivered_power


def check_governor(drawing: GovernorDrawing) -> dict[str, float]:
    """By how much independent results differ: of the reduction and the lever in each drawn position, and of the
    characteristic from the potential energy, relative to its largest value; with friction also of C'' and C'.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where they differ.
    """
    result = drawing.result
    require_claims(result.scene.name, drawing.values)
    travel = result.drawn_states.travel
    gaps = {"motion": check_reduction(result.reduction, travel)["moment"],
            "lever": max(check_lever(result.reduction, float(one))[1] for one in travel)}
    if all(map(_has_potential, result.reduction.acting)):
        low, high = result.reduction.ends
        step = STENCIL_STEP * (high - low)
        inner = np.clip(travel, low + 2 * step, high - 2 * step)
        rises, moves = (sum(weight * values for weight, values in zip((1, -8, 8, -1), rows, strict=True))
                        for rows in zip(*(_energy_and_distance(result, inner + k * step) for k in (-2, -1, 1, 2)),
                                        strict=True))
        C = result.states(inner).C
        gaps["energy"] = float(np.max(abs(rises / moves - C)) / np.max(abs(C)))
        require_agreement(result.scene.name, {"energy": gaps["energy"]}, ENVELOPE_TOL, by="by the potential energy")
    if result.friction:
        gaps["friction"] = band_gap(result)
    return gaps


def band_gap(result: GovernorResult) -> float:
    """By how much the drive has to help in the drawn positions where the balls have C'' or C', by the solver, whose
    reactions lean of themselves: its power relative to that of C.

    Fails with `Disagreement` where that is more than rounding.
    """
    friction, states = result.friction, result.drawn_states
    assert friction
    turn, others = friction.rubbing.motion.turn(states.travel), friction.other_loads(states.travel)
    senses = friction.scenes if result.curve.travel[-1] > result.curve.travel[0] else friction.scenes[::-1]
    gap, rates = 0.0, result.outward_rate(states.travel)
    for scene, C in zip(senses, result.drawn_band, strict=True):
        batch = PoseBatch(scene, np.arange(states.travel.size), turn.points, turn.guides, friction.acting(others, C))
        for k in range(states.travel.size):
            reference = with_friction(single_pose(batch.select(k).posed_scene))
            help_of_drive = float(delivered_power(reference, rubs=True)) * friction.rubbing.power
            size = max(abs(float(C[k])), abs(float(states.C[k]))) * abs(float(rates[k]))
            gap = max(gap, abs(help_of_drive) / size)
    require_agreement(result.scene.name, {"friction": gap}, FRICTION_TOL, by="by the solver")
    return gap


def _has_potential(load: LoadOnLink) -> bool:
    """Whether a load is a force that is constant, or of a spring."""
    return bool(load.at) and (load.table is None or bool(load.table.span))


def _energy_and_distance(result: GovernorResult, travel: Array) -> tuple[Array, Array]:
    return potential_energy(result, travel), abs(result.distance(travel)[0])


def potential_energy(result: GovernorResult, travel: Array) -> Array:
    """The potential energy of weights, constant forces and springs, in J."""
    reduction, units = result.reduction, result.scene.units
    points, metre = reduction.motion.turn(travel).points, float(METRES[units.length])
    energy = np.zeros(travel.shape)
    for load in reduction.acting:
        if load.table is None:
            energy -= metre * (np.conj(load.value) * points[load.at]).real
    for law in spring_laws(reduction.loads.forces):
        stiffness, free = map(float, spring_numbers(law))
        assert law.span
        length = abs(points[law.span[0]] - points[law.span[1]]) - free
        energy += float(NEWTONS[units.force]) * metre * stiffness * length**2 / 2
    return energy
