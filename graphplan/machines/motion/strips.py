"""Motion strip by strip, as it is computed by hand: the time under 1/omega, and the speed by steps of a known order.

Sources: Ozols 1974, (13.31) (Baranov's step), (13.32), (13.40) and (13.41) (the first strips from rest as a parabola),
example 13-7 (Euler's step for omega^2, where loads hang on the speed).
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals
from graphplan.machines.motion.driven import DrivenMachine


class Parabola(NamedTuple):
    """omega = k phi^n over the first two strips from rest, and the time that they take."""

    n: float
    k: float
    time: float


def parabola(travel: Reals, omega: Reals) -> Parabola:
    """The parabola through the second and the third of three points, the first being at rest.

    Fails with `Refused` where it would take for ever to leave the rest, as n is 1 or more.
    """
    (x2, x3), (w2, w3) = travel[1:3] - travel[0], omega[1:3]
    n = math.log(w3 / w2) / math.log(x3 / x2)
    if not n < 1:
        raise Refused("the first strips", f"omega grows with the power {n:.3g} of the travel, and the time has no end",
                      "narrower strips (--positions)")
    k = math.exp((math.log(x3) * math.log(w2) - math.log(x2) * math.log(w3)) / (math.log(x3) - math.log(x2)))
    return Parabola(n, k, x3 ** (1 - n) / (k * (1 - n)))


def times(travel: Reals, omega: Reals) -> Reals:
    """The time at each travel: trapezoids under 1/omega, from rest two strips of a parabola first.

    Within the parabola it goes by its own law; nan from where the speed is no more than 0, or unknown.
    """
    elapsed, first = np.zeros(len(travel)), 0
    if omega[0] == 0:
        curve = parabola(travel, omega)
        elapsed[1], elapsed[2], first = curve.time * ((travel[1] - travel[0]) / (travel[2]
                                                                                 - travel[0])) ** (1 - curve.n), \
            curve.time, 2
    slowness = np.divide(1.0, omega, out=np.full(len(omega), np.nan), where=omega > 0)
    strips = (slowness[first:-1] + slowness[first + 1:]) / 2 * np.diff(travel[first:])
    elapsed[first + 1:] = elapsed[first] + np.cumsum(strips)
    return elapsed


def by_energy(machine: DrivenMachine, travel: Reals, omega: float) -> Reals:
    """The speeds with each strip's moment taken at its beginning: Euler's step for omega^2, of the first order.

    d(omega^2) = 2/I M dphi where the inertia does not change; nan from where nothing is left.
    """
    speeds = [omega]
    for start, end in pairwise(travel):
        inertia = machine.inertia(np.array([start, end]))
        moment = float(machine.moment(np.array([start]), np.array([speeds[-1]]))[0])
        square = (inertia[0] * speeds[-1] ** 2 + 2 * moment * (end - start)) / inertia[1]
        speeds.append(math.sqrt(square) if square >= 0 else math.nan)
    return np.array(speeds)


def baranov(machine: DrivenMachine, travel: Reals, omega: float) -> Reals:
    """The speeds by Baranov's step (13.31), of the first order; from rest the first strip is one of `by_energy`."""
    speeds = [omega]
    if omega == 0:
        speeds += [float(by_energy(machine, travel[:2], 0.0)[1])]
    for start, end in pairwise(travel[len(speeds) - 1:]):
        (now, then), rate = machine.inertia(np.array([start, end])), speeds[-1]
        moment = float(machine.moment(np.array([start]), np.array([rate]))[0])
        step = moment * (end - start) / (now * rate) + (3 * now - then) / (2 * now) * rate if rate > 0 else math.nan
        speeds.append(step)
    return np.array(speeds)
