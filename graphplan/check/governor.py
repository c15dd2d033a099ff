"""A governor against the potential energy: the force of its balls is how that grows with their distance.

No velocity is used: positions alone, differences of weights' heights and springs' lengths over differences of r. Loads
without a potential energy, and what else the reduction says, are compared with the solver.
"""

from __future__ import annotations

import numpy as np

from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.reduction import check_lever, check_reduction
from graphplan.check.tolerances import ENVELOPE_TOL, STENCIL_STEP
from graphplan.cycle.linkage import Array
from graphplan.machine.governor import GovernorDrawing, GovernorResult
from graphplan.machine.reduced.reduced_loads import LoadOnLink
from graphplan.mechanism.springs import spring_laws, spring_numbers
from graphplan.mechanism.units import METRES, NEWTONS


def check_governor(drawing: GovernorDrawing) -> dict[str, float]:
    """By how much independent results differ: of the reduction and the lever in each drawn position, and of the
    characteristic from the potential energy, relative to its largest value.

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
    return gaps


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
