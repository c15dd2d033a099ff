"""The independent checks of a rotor: what its drawing gives against equilibrium in complex numbers, and what its
bearings bear.

Nothing of the polygons is used: two equations, of forces and of moments about the origin of the axis, are solved for
the corrections; then the rotor with them must be without force and moment. Trials are made again: the unbalance that
was found must give the amplitudes that were measured.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import numpy as np

from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.tolerances import SUM_TOL
from graphplan.machines.rotors.rotor import Eccentric, MarkedRuns, Rotor, ThreeRuns, TrialWeights
from graphplan.machines.rotors.rotor_balance import Answer, BalancedRotor, Correction, Effect, angle_of

Pair = tuple[tuple[Eccentric, ...], Answer]  # unbalances, and what balances them


def check_rotor(balanced: BalancedRotor) -> dict[str, float]:
    """By how much the independent results differ, relative to the sizes of what they are made of.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where they differ.
    """
    require_claims(balanced.task.name, balanced.drawing.values)
    pairs = [*zip(balanced.unbalances, balanced.answers, strict=True)]
    gaps = {"corrections": max(_correction_gap(balanced.task.rotor, *pair) for pair in pairs),
            "residual_force": max(map(_residual_force, pairs))}
    if balanced.task.rotor.dynamic:
        gaps["residual_moment"] = max(map(_residual_moment, pairs))
    if balanced.effects:
        gaps["trials"] = max(_trial_gap(one, -vector(mass)) for masses, _ in pairs
                             for one, mass in zip(balanced.effects, masses, strict=True))
    require_agreement(balanced.task.name, {quantity.replace("_", " "): gap for quantity, gap in gaps.items()}, SUM_TOL,
                      by="by the independent check")
    return gaps


def vector(unbalance: Eccentric | Correction) -> complex:
    """Mass times radius vector, from its size and angle."""
    return cmath.rect(unbalance.mass_radius, math.radians(unbalance.angle))


def axial_place(unbalance: Eccentric | Correction) -> float:
    """Place along the axis."""
    return float(unbalance.at or 0)


def _residual_force(pair: Pair) -> float:
    """The force that is left with the corrections, relative to the sum of its parts."""
    return _relative_sum([vector(unbalance) for unbalances in pair for unbalance in unbalances])


def _residual_moment(pair: Pair) -> float:
    """The moment about the middle of all places that is left, relative to the sum of its parts."""
    everything = [unbalance for unbalances in pair for unbalance in unbalances]
    middle = sum(map(axial_place, everything)) / len(everything)
    return _relative_sum([(axial_place(unbalance) - middle) * vector(unbalance) for unbalance in everything])


def _relative_sum(parts: list[complex]) -> float:
    """Remainder of a sum, relative to the sizes of its parts."""
    return abs(sum(parts)) / (sum(map(abs, parts)) or 1.0)


def equilibrium(rotor: Rotor, masses: Sequence[Eccentric]) -> list[complex]:
    """The corrections, as vectors, that two equations of equilibrium give, or one of a rotor with one plane."""
    forces, places = [*map(vector, masses)], _plane_distances(rotor, masses)
    if not rotor.dynamic:
        return [-sum(forces, 0j)]
    rows = np.array([[1.0, 1.0], [0.0, float(rotor.planes[1] - rotor.planes[0])]])
    return [*map(complex, np.linalg.solve(rows, [-sum(forces, 0j), -np.dot(places, forces)]))]


def _plane_distances(rotor: Rotor, masses: Sequence[Eccentric]) -> list[float]:
    """Distances of masses from the first plane."""
    return [float((mass.at or 0) - rotor.planes[0]) for mass in masses]


def _correction_gap(rotor: Rotor, masses: Sequence[Eccentric], answer: Answer) -> float:
    """Difference of the corrections from equilibrium's, relative to the sum of each mass's own correction."""
    wide = abs(float(rotor.planes[-1] - rotor.planes[0])) or math.inf
    scale = sum(mass.mass_radius * (1 + abs(arm) / wide) for mass, arm in zip(masses, _plane_distances(rotor, masses),
                                                                              strict=True))
    needed = equilibrium(rotor, masses)
    return max(abs(vector(correction) - needed_vector)
               for correction, needed_vector in zip(answer, needed, strict=True)) / (scale or 1.0)


def _trial_gap(effect: Effect, side: complex) -> float:
    """By how much the trial would have given other numbers, relative to the largest, if this is the correction."""
    trial, mass_radius = effect.trial, float(effect.trial.mass_radius)
    at = cmath.rect(mass_radius, math.radians(float(trial.angle)))
    if isinstance(trial, ThreeRuns):
        first, second, third = map(float, trial.amplitudes)
        grows = effect.amplitude / mass_radius
        return max(abs(abs(at - side) * grows - second), abs(abs(-at - side) * grows - third),
                   abs(abs(side) * grows - first)) / max(second, third)
    if isinstance(trial, MarkedRuns):
        before, after = (cmath.rect(float(run.amplitude), math.radians(float(run.angle)))
                         for run in (trial.first, trial.second))
        return abs(before + (after - before) / at * side) / (abs(before) + abs(after))
    assert isinstance(trial, TrialWeights)
    # least squares: what is left of the weights has no part that runs as the cosine or the sine
    angles = np.radians([angle_of(trial, k) for k in range(len(trial.weights))])
    rows = np.stack([np.ones(len(angles)), np.cos(angles), np.sin(angles)], 1)
    _, x, y = np.linalg.lstsq(rows, np.array([*map(float, trial.weights)]), rcond=None)[0]
    return abs(complex(x, y) * mass_radius - side) / (mass_radius * float(max(trial.weights)) or 1.0)


def bearing_reactions(balanced: BalancedRotor, answer: Answer = ()) -> list[complex]:
    """Loads of the bearings by the centrifugal forces, in N, turning with the rotor, with these corrections."""
    rotor = balanced.task.rotor
    unbalances: list[Eccentric | Correction] = [*balanced.masses, *answer]
    forces, places = [vector(unbalance) for unbalance in unbalances], [axial_place(unbalance)
                                                                       for unbalance in unbalances]
    rows = np.array([[1.0, 1.0], [*map(float, rotor.bearings)]])
    reactions = np.linalg.solve(rows, [sum(forces, 0j), np.dot(places, forces)])
    return [complex(unbalance) * float(balanced.task.kg_m) * rotor.omega**2 for unbalance in reactions]
