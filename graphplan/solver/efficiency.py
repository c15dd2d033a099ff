"""The efficiency of a mechanism with friction, from the powers of its balances."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from graphplan.mechanism.model import Number
from graphplan.mechanism.plane import dot
from graphplan.mechanism.units import metre
from graphplan.solver.loads import asked
from graphplan.solver.statics import Reactions

IDLE = 1e-12  # of the power with friction: what the balances give without it is nothing but rounding


def delivered(found: Reactions) -> Number:
    """The power that the balances give, in force * length/s."""
    scene, rates = found.equations.scene, found.rates
    power: Number = Fraction(0)
    for balance, value in zip(asked(scene).balances, found.balances, strict=True):
        if isinstance(value, tuple):
            power += dot(value, rates.velocity[balance.at])
        else:
            power += value * metre(scene.units) * rates.omega[balance.link]
    return power


def efficiency(smooth: Any, rubbed: Any) -> Any:
    """The efficiency from the powers of the balances without friction and with it; None where neither gives any.

    Where the balances drive, it is the power without by the power with friction. Where the loads drive and the balances
    hold back, it is the inverse: negative where the loads alone do not overcome the friction.
    """
    if not smooth and not rubbed:
        return None
    if abs(smooth) <= IDLE * abs(rubbed):
        return 0 * rubbed
    return smooth / rubbed if smooth > 0 else rubbed / smooth
