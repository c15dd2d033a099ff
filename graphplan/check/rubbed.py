"""The second opinion on friction as it is drawn: one round, of what the frictionless reactions rub."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphplan.check.arithmetics import enclosures
from graphplan.check.opinion import bounded_reactions
from graphplan.kernel.numbers.enclosures import Enclosure, Enclosures
from graphplan.mechanism.model import FRAME, Force, Moment, Pair
from graphplan.mechanism.units import metre
from graphplan.solver.loads import Load, asked
from graphplan.solver.plane import dot, times
from graphplan.solver.statics import Reactions


def rubbed(smooth: Reactions) -> Reactions:
    """The reactions and balances in enclosures, with the friction of these reactions as loads."""
    loads = tuple(load for load in _rubs(smooth) if load.on != FRAME)
    return bounded_reactions(smooth.equations.scene, smooth.rates, enclosures(), loads)


def _rubs(smooth: Reactions) -> Iterator[Load]:
    """The friction on both links of each pair: against their turning, against their sliding."""
    scene, rates = smooth.equations.scene, smooth.rates
    omega: dict[str, Any] = rates.omega | {FRAME: Enclosure(0)}
    for friction in asked(scene).frictions:
        if friction.at:
            pin, *others = scene.links_of[friction.at]
            for link in others:
                circle = friction.radius * friction.coefficient / metre(scene.units)
                couple = -_sense(omega[link] - omega[pin]) * _length(smooth.joints[friction.at, link]) * circle
                yield Moment(link, couple)
                yield Moment(pin, -couple)
        else:
            slide = next(s for s in scene.slides if (s.link, s.along) == friction.slide)
            slip = _sense(dot(rates.slide_velocity[slide.name], slide.direction))
            lean = _length(smooth.slides[slide.name][0]) / _length(slide.direction) * friction.coefficient
            drag = times(-slip * lean, slide.direction)
            yield Force(slide.link, slide.at, drag)
            yield Force(slide.along, slide.at, times(-1, drag))


def _sense(rate: Any) -> Any:
    """Which way it goes; anything between both ways where that cannot be told."""
    return Enclosures().sign(rate, 0)


def _length(vector: Pair) -> Any:
    return Enclosure(dot(vector, vector)).root
