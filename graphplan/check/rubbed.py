"""The second opinion on friction as it is drawn: so many rounds, in numbers with bounds."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphplan.check.arithmetics import Arithmetic
from graphplan.check.certified_solver import bounded_reactions
from graphplan.mechanism.model import FRAME, Number, Pair, Slide
from graphplan.mechanism.pairs.pair import Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.plane import dot
from graphplan.solver.friction import leaning
from graphplan.solver.loads import asked
from graphplan.solver.statics import Reactions


def rubbed(smooth: Reactions, rounds: int, by: Arithmetic) -> Reactions:
    """The reactions and balances after so many rounds from those without friction."""
    last = smooth
    for _ in range(rounds):
        last = bounded_reactions(smooth.equations.scene, smooth.rates, by, _leaning(last, by))
    return last


def _leaning(last: Reactions, by: Arithmetic) -> Iterator[Statement]:
    """What holds the links, each pair's force against its turning or sliding as its last force says."""
    scene, rates = last.equations.scene, last.rates
    omega: dict[str, Any] = rates.omega | {FRAME: by.lift(0)}
    journals = {f.at: f.radius * f.coefficient for f in asked(scene).frictions if f.at}
    guides = {f.slide: f.coefficient for f in asked(scene).frictions if f.slide}

    def arm(joint: Revolute, link: str, force: Pair) -> Any:
        square = by.lift(dot(force, force))
        circle = journals.get(joint.at, 0) * -_sense(omega[link] - omega[joint.links[0]], by)
        return circle / square.root if circle and _sense(square, by) else 0

    def lean(slide: Slide, pressure: Any) -> Number:
        slip = _sense(dot(rates.slide_velocity[slide.name], slide.direction), by)
        return guides.get(slide.links, 0) * -slip * _sense(pressure, by)

    return leaning(last, arm, lean)


def _sense(number: Any, by: Arithmetic) -> int:
    """1 or -1; 0 where a number cannot be told from nothing: then a pair stands still, or bears no force."""
    lifted = by.lift(number)
    return 0 if lifted.overlaps(by.lift(0)) else 1 if float(lifted) > 0 else -1
