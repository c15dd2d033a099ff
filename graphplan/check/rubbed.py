"""The second opinion on friction as it is drawn: so many rounds, in numbers with bounds."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphplan.check.arithmetics import Arithmetic
from graphplan.check.certified_solver import bounded_reactions
from graphplan.mechanism.model import FRAME
from graphplan.solver.facts import Along, Fact, Turning, X, Y, held
from graphplan.solver.friction import Touching
from graphplan.solver.loads import asked
from graphplan.solver.plane import dot, plus, times, turned
from graphplan.solver.statics import Reactions


def rubbed(smooth: Reactions, rounds: int, by: Arithmetic) -> Reactions:
    """The reactions and balances after so many rounds from those without friction."""
    last = smooth
    for _ in range(rounds):
        last = bounded_reactions(smooth.equations.scene, smooth.rates, by, _leaning(last, by))
    return last


def _leaning(last: Reactions, by: Arithmetic) -> Iterator[Fact]:
    """What holds the links, each pair's force against its turning or sliding as its last force says."""
    scene, rates = last.equations.scene, last.rates
    omega: dict[str, Any] = rates.omega | {FRAME: by.lift(0)}
    journals = {f.at: f.radius * f.coefficient for f in asked(scene).frictions if f.at}
    guides = {f.slide: f.coefficient for f in asked(scene).frictions if f.slide}
    for (point, link), force in last.joints.items():
        pin, square = scene.links_of[point][0], by.lift(dot(force, force))
        circle = journals.get(point, 0) * -_sense(omega[link] - omega[pin], by)
        for axis in X, Y:
            lever = circle * dot(axis, force) / square.root if circle and _sense(square, by) else 0
            yield Touching(link, pin, point, axis, 0, 0, lever=lever)
    for slide in scene.slides:
        across, (force, _) = turned(slide.direction), last.slides[slide.name]
        slip = _sense(dot(rates.slide_velocity[slide.name], slide.direction), by)
        lean = guides.get((slide.link, slide.along), 0) * -slip * _sense(dot(across, force), by)
        yield Turning(slide.link, slide.along, 0, 0)
        yield Along(slide.link, slide.along, slide.at, plus(across, times(lean, slide.direction)), 0, 0)
    yield from map(held, asked(scene).balances)


def _sense(number: Any, by: Arithmetic) -> int:
    """1 or -1; 0 where a number cannot be told from nothing: then a pair stands still, or bears no force."""
    lifted = by.lift(number)
    return 0 if lifted.overlaps(by.lift(0)) else 1 if float(lifted) > 0 else -1
