"""Which way friction acts: against the turning in each journal and the slip in each slide."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from graphplan.mechanism.model import FRAME, Number, Scene, Slide
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.plane import dot
from graphplan.solver.loads import asked
from graphplan.solver.rates import Rates

ROUNDING = 8 * 2.0**-52  # times the condition of the rates: what moves more slowly beside the rest stands still


@dataclass(frozen=True)
class Rubbing:
    """What friction makes of a reaction, negative where it opposes a positive motion.

    `journals`: by point and link, the radius of the friction circle. `guides`: by slide, the coefficient of friction.
    """

    journals: dict[tuple[str, str], Number]
    guides: dict[str, Number]

    def part(self, share: Number) -> Rubbing:
        """The same with all coefficients smaller."""
        journals = {name: share * circle for name, circle in self.journals.items()}
        return Rubbing(journals, {name: share * coefficient for name, coefficient in self.guides.items()})


def rubbing(scene: Scene, rates: Rates) -> Rubbing:
    """The frictions of the scene, with the senses of these rates; nothing where a pair does not move."""
    return Rubbing(
        {(joint.at, k): -circle(scene, joint.at) * turning(joint, k, rates)
         for joint in scene.revolutes for k in joint.links[1:]},
        {slide.name: -coefficient(scene, slide) * slipping(slide, rates) for slide in scene.slides},
    )


def circle(scene: Scene, point: str) -> Number:
    """The radius of the friction circle of a joint."""
    return sum((f.radius * f.coefficient for f in asked(scene).frictions if f.at == point), Fraction(0))


def coefficient(scene: Scene, slide: Slide) -> Number:
    """The coefficient of friction of a slide."""
    found = (f.coefficient for f in asked(scene).frictions if f.slide == slide.links)
    return sum(found, Fraction(0))


def turning(joint: Revolute, link: str, rates: Rates) -> int:
    """The sense in which a link turns on the one that carries the pin: 1, -1, or 0 where it does not."""
    omega = {**rates.omega, FRAME: 0}
    return sense(float(omega[link] - omega[joint.links[0]]) * rates.equations.reach, rates)


def slipping(slide: Slide, rates: Rates) -> int:
    """The sense in which a link slides along its guide's direction."""
    length = math.hypot(*slide.direction)
    return sense(float(dot(rates.slide_velocity[slide.name], slide.direction)) / length, rates)


def sense(speed: float, rates: Rates) -> int:
    """The sign of a speed, in length/s; 0 where rounding could make it of what moves fastest."""
    points = (abs(float(x)) for v in (rates.velocity, rates.slide_velocity) for pair in v.values() for x in pair)
    turnings = (abs(float(omega)) * rates.equations.reach for omega in rates.omega.values())
    fastest = max(*points, *turnings, 0.0)
    return sign(speed, ROUNDING * rates.condition * fastest)


def sign(value: float, least: float) -> int:
    """1 or -1, or 0 where a number is no larger than what is nothing."""
    return (value > least) - (value < -least)
