"""The course: which poses the path leads to, and what is to be said of the others.

A pose is reached if the mechanism comes there from its given pose without being taken apart: forwards up to the first
limit and, where the cycle is closed or the span goes there, backwards up to another. What lies between is not reached,
even where the links could be put together again. A pose at a limit is taken where the path ends, a hair before it.
"""

from __future__ import annotations

import numpy as np

from graphplan.cycle.continuation import Limit, Path
from graphplan.cycle.linkage import Array
from graphplan.cycle.positions import Failure
from graphplan.cycle.travel import TURN, told
from graphplan.mechanism.model import Scene


class Course:
    """Travels sorted by a path: `at` is the travel by which a pose is placed, `reached` whether the path leads there,
    and `knots` whether it is a knot of the path: the given pose, or one at a limit.

    Where the cycle is closed, a pose beyond the upper limit is reached backwards, a full turn earlier.
    """

    def __init__(self, scene: Scene, path: Path, travel: Array, closed: bool):
        self.scene, self.travel, self.round = scene, travel, TURN if closed else 0.0
        low = path.lower.travel - path.lower.slack if path.lower else path.knots.travel[0]
        high = path.upper.travel + path.upper.slack if path.upper else path.knots.travel[-1]
        self.at, above = travel.copy(), np.flatnonzero(travel > high)
        self.at[above[travel[above] - self.round >= low]] -= self.round
        self.reached = (self.at >= low) & (self.at <= high)
        self.limits = [limit for limit in (path.lower, path.upper) if limit]
        self.stops: dict[int, Limit] = {}
        for limit in self.limits:
            there = np.abs(self.at - limit.travel) <= limit.slack
            self.at[there] = limit.travel
            self.stops |= dict.fromkeys(map(int, np.flatnonzero(there)), limit)
        self.knots = self.at == 0
        self.knots[list(self.stops)] = True

    def faults(self, failures: dict[int, Failure]) -> dict[int, str]:
        """One line for each pose that is not reached, or is a limit, by its place; `failures` could not be placed."""
        beyond = map(int, np.flatnonzero(~self.reached))
        lines = {i: self._stopped(limit) for i, limit in self.stops.items()}
        lines |= {i: f"{_links(failure.part)} cannot be assembled: {failure.why}" for i, failure in failures.items()}
        lines |= {i: self._beyond(i, lines.get(i)) for i in beyond}
        return {i: f"at {told(self.scene, self.travel[i])}: {lines[i]}" for i in sorted(lines)}

    def _stopped(self, limit: Limit) -> str:
        """What is to be said of a pose at a limit."""
        lost = "the drive does not say how they move on" if limit.change else "they have no velocities"
        return f"{_links(limit.part)} {'are' if len(limit.part) > 1 else 'is'} in a {limit.kind}: {lost}"

    def _beyond(self, i: int, reason: str | None) -> str:
        """What is to be said of a pose beyond a limit: the nearer one, if there are two."""
        places = {limit: limit.travel + (self.round if limit.travel < 0 else 0.0) for limit in self.limits}
        limit = min(self.limits, key=lambda one: abs(places[one] - self.travel[i]))
        reason = reason or f"{_links(limit.part)} cannot come there from the given pose"
        return f"{reason} ({limit.kind} near {told(self.scene, places[limit], 4)})"


def _links(names: tuple[str, ...]) -> str:
    """Links in words."""
    *first, last = names
    return f"links {', '.join(first)} and {last}" if first else f"link {last}"
