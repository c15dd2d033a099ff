"""What the balances deliver: their powers, the moments on screws through which they act, and the efficiency."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from graphplan.mechanism.model import FRAME, Balance, Number, Pair, Slide
from graphplan.mechanism.numbers import dot, minus, plus, quarter_turn, square_root, times
from graphplan.mechanism.units import metre
from graphplan.solver.rates import Rates
from graphplan.solver.statics import Reactions, required_loads
from graphplan.solver.tolerances import POWER_TOL, SLIP_TOL


def standstill(rates: Rates) -> float:
    """The speed below which a pair stands still: what rounding could make of what moves fastest."""
    points = (abs(float(x)) for v in (rates.velocity, rates.slide_velocity) for pair in v.values() for x in pair)
    turns = (abs(float(turn)) * rates.equations.reach for turn in rates.omega.values())
    return SLIP_TOL * rates.condition * max(*points, *turns, 0.0)


def moved_with(rates: Rates, link: str, place: str) -> Pair:
    """The velocity of a place as a point of a link."""
    if link == FRAME:
        return 0, 0
    arm, base = rates.equations.arm(link, place), rates.equations.bases[link]
    return plus(rates.velocity[base], times(rates.omega[link], quarter_turn(arm)))


def sign(value: float, least: float) -> int:
    """1 or -1, or 0 where a number is no larger than what is nothing."""
    return (value > least) - (value < -least)


def delivered_power(solution: Reactions, rubs: bool = False) -> Number:
    """The power that the balances give, in force * length/s; with the friction of screws where it `rubs`."""
    scene, rates = solution.equations.scene, solution.rates
    power: Number = Fraction(0)
    for balance, value in zip(required_loads(scene).balances, solution.balances, strict=True):
        (driven, counter), omega = balance.links, {**rates.omega, FRAME: 0}
        if isinstance(value, tuple):
            share = screw_share(solution, balance, value) if rubs else 1
            power += share * dot(value, minus(moved_with(rates, driven, balance.at),
                                              moved_with(rates, counter, balance.at)))
        else:
            power += value * metre(scene.units) * (omega[driven] - omega[counter])
    return power


def screw_share(solution: Reactions, balance: Balance, value: Pair) -> Number:
    """By how many times friction makes the moment on a screw larger through which a balance acts; 1 without one."""
    screw = required_loads(solution.equations.scene).screw_of(balance)
    return screw.circumferential(screw_sense(solution, balance, value)[1]) / screw.slope if screw else 1


def screw_sense(solution: Reactions, balance: Balance, value: Pair) -> tuple[Slide, int]:
    """The slide that a screw moves through which a balance acts; and 1 where that drives, -1 where its load does, and 0
    where it stands still."""
    scene, rates = solution.equations.scene, solution.rates
    slide = next(slide for slide in scene.slides if {*slide.links} == {*balance.links})
    slip, pull = (float(dot(v, slide.direction)) for v in (rates.slide_velocity[slide.name], value))
    still = 0 if slide.name in required_loads(scene).resting else 1
    sense = still if balance.link == slide.link else -still
    return slide, sense * sign(slip / math.hypot(*slide.direction), standstill(rates)) * sign(pull, 0)


def screw_moments(solution: Reactions) -> dict[str, Number]:
    """By slide, the moment on the screw that moves it, in force * m: positive where it drives along the direction."""
    loads, moments = required_loads(solution.equations.scene), dict[str, Number]()
    for balance, value in zip(loads.balances, solution.balances, strict=True):
        if (screw := loads.screw_of(balance)) and isinstance(value, tuple):
            slide, sense = screw_sense(solution, balance, value)
            arm = screw.radius / metre(solution.equations.scene.units) * screw.circumferential(sense)
            arm /= square_root(dot(slide.direction, slide.direction))
            moments[slide.name] = (arm if balance.link == slide.link else -arm) * dot(value, slide.direction)
    return moments


def efficiency(smooth: Any, rubbed: Any) -> Any:
    """The efficiency from the powers of the balances without friction and with it; None where neither gives any.

    Where the balances drive, it is the power without by the power with friction. Where the loads drive and the balances
    hold back, it is the inverse: negative where the loads alone do not overcome the friction.
    """
    if smooth >= 0 and not rubbed:  # power that friction would not take of it is rounding
        return None
    if abs(smooth) <= POWER_TOL * abs(rubbed):
        return 0 * rubbed
    return smooth / rubbed if smooth > 0 else rubbed / smooth
