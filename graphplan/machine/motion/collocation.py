"""One stretch of a motion: energy and time as polynomials that satisfy the energy equation at the nodes of Gauss.

The energy E grows by dE/dphi = M(phi, omega), and omega^2 = 2E/I(phi): a collocation of as many nodes is a Runge-Kutta
method of twice that order, which no steep characteristic of a motor makes unstable. Where a machine is at rest omega
grows with the root of the travel, so that 1/omega has no bound: there the travel goes with the square of s, and all is
smooth in s. A machine that comes to rest passes such a stretch backwards.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple, Protocol

import numpy as np

from graphplan.machine.integrals import Reals
from graphplan.machine.tolerances import ENERGY_TOL, RATE_STEP, SERIES_TOL

NODES = 16
ROUNDS = 30  # of Newton's method: it takes three to six
TAIL = 3  # terms at the end of a series that tell how far it is from settled


class Machine(Protocol):
    """What moves: its inertia over the travel, and at travels its moments as a function of the rates there."""

    def inertia(self, travel: Reals) -> Reals: ...

    def moments(self, travel: Reals) -> Callable[[Reals], Reals]: ...


@dataclass(frozen=True, eq=False)
class Stretch:
    """Energy and time as Legendre series in s from 0 to 1, where the travel is `start` + `way` s^`power`."""

    start: float
    way: float
    power: int
    energy: Reals
    time: Reals

    def place(self, travel: Reals) -> Reals:
        """Where in the series these travels are, from -1 to 1."""
        s = np.clip((travel - self.start) / self.way, 0.0, 1.0)
        return 2 * (np.sqrt(s) if self.power == 2 else s) - 1


def stretch(machine: Machine, start: float, way: float, energy: float, elapsed: float,
            at_rest: bool = False) -> Stretch | None:
    """The motion from a travel on; None where no polynomial follows it to rounding, or it comes to rest.

    Reads the energy and the time elapsed at the start. With `at_rest` there is no energy, and `way` may lead back.
    """
    rule, power = _rule(), 2 if at_rest else 1
    travel, pace = start + way * rule.nodes**power, way * power * rule.nodes**(power - 1)
    inertia, moments, still = machine.inertia(travel), machine.moments(travel), np.zeros(NODES)
    energies = moments(still) * (travel - start) if at_rest else np.full(NODES, energy)
    for _ in range(ROUNDS):
        if not (energies > 0).all():
            return None
        rate = np.sqrt(2 * energies / inertia)
        moment = moments(rate)
        step = RATE_STEP * rate
        slope = (moments(rate + step) - moment) / step / (inertia * rate)
        miss = energies - energy - rule.integral @ (pace * moment)
        change = np.linalg.solve(np.eye(NODES) - rule.integral * (pace * slope), miss)
        if not np.isfinite(change).all():
            return None
        energies = energies - change
        if abs(change).max() <= ENERGY_TOL * energies.max():
            break
    else:
        return None
    if not (energies > 0).all():
        return None
    grown, hurried = pace * moment, pace / np.sqrt(2 * energies / inertia)
    if not (_fine(grown, max(energies.max(), energy)) and _fine(hurried, elapsed + abs(hurried).mean())):
        return None
    return Stretch(start, way, power, rule.summed(grown, energy), rule.summed(hurried, elapsed))


def _fine(values: Reals, size: float) -> bool:
    """Whether the last terms of the series are rounding beside a size, or beside the values."""
    tail = abs(values @ _rule().series[:, -TAIL:]).max()
    return bool(tail <= SERIES_TOL * max(size, abs(values).max()))


class _Rule(NamedTuple):
    """The nodes of Gauss from 0 to 1; what makes of the values there the terms of a series, those of its integral, and
    the integral at the nodes."""

    nodes: Reals
    series: Reals
    terms: Reals
    integral: Reals

    def summed(self, values: Reals, first: float) -> Reals:
        """The terms of the integral, which begins at `first`."""
        found: Reals = values @ self.terms
        found[0] += first
        return found


@cache
def _rule() -> _Rule:
    from numpy.polynomial.legendre import leggauss, legint, legvander

    nodes, weights = leggauss(NODES)
    series = weights[:, None] * legvander(nodes, NODES - 1) * (np.arange(NODES) + 0.5)
    terms = legint(series, lbnd=-1, axis=1) / 2
    return _Rule((nodes + 1) / 2, series, terms, legvander(nodes, NODES) @ terms.T)
