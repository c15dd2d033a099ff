"""What the solver says of the curvature of paths and of inflection circles, by the kinds of readings."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from graphplan.errors import SingularPose
from graphplan.mechanism.model import FRAME
from graphplan.methods import kinds
from graphplan.solver import Rates
from graphplan.solver import curvature as solved
from graphplan.solver.instant_centres import relative

NOTHING_MOVES = "what is asked of {0} does not exist, as nothing moves there"
OF_POINTS: dict[str, Callable[[Rates, str, str], Any]] = {
    kinds.CENTRE: solved.centre,
    kinds.STRAIGHT: lambda rates, point, link: solved.curvature(rates, point),
    kinds.CUSP: solved.from_pole,
}
OF_LINKS: dict[str, Callable[[Rates, str], Any]] = {
    kinds.INFLECTION: solved.inflection_pole,
    kinds.MOTION_POLE: lambda rates, link: relative(rates, link, FRAME).centre,
    kinds.TRANSLATION: lambda rates, link: rates.omega[link],
}


def path_truth(rates: Rates, results: Mapping[str, Iterable[str]]) -> dict[str, dict[str, Any]]:
    """The solver's values by the kinds and names of results; fails with `SingularPose` where there is none."""
    traced = rates.equations.scene.find.traced
    found: dict[str, dict[str, Any]] = {}
    for kind, names in results.items():
        for name in names if kind in OF_POINTS or kind in OF_LINKS else ():
            point, link = traced.get(name, ("", name))
            try:
                value = OF_POINTS[kind](rates, point, link) if kind in OF_POINTS else OF_LINKS[kind](rates, link)
            except ZeroDivisionError:
                raise SingularPose(NOTHING_MOVES.format(name), (link,)) from None
            found.setdefault(kind, {})[name] = value
    return found
