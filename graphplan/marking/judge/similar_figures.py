"""Marks by the similar figure: on every plan the ends of the vectors of a link's points form a figure similar to the
link's. So a mark is right as well if it makes that figure with the student's own marks of two other points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.mechanism.model import FRAME
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, VELOCITY
from graphplan.methods.panels import MECHANISM


@dataclass(frozen=True)
class SimilarFigures:
    """The figures of the links of a construction: `plan_of_step` is the plan of every step."""

    drawing: Construction
    plan_of_step: Sequence[str]

    def values(self, index: int, own: Sequence[Any], seen: set[int]) -> Iterator[Any]:
        """Where a mark would be by the similar figures of links of which two other points have marks that are `seen`;
        `own` are the student's marks so far. A given point makes no figure, though it may be the end of its vector."""
        for ends in self._ends if index >= self.drawing.drawn.givens else ():
            point = next((name for name, end in ends.items() if end == index), None)
            for link in self._links if point else ():
                others = [name for name in link if name != point and ends.get(name, index) in seen]
                if point in link and len(others) > 1:
                    P, U, V = (own[self._places[name]] for name in (point, *others[:2]))
                    value = _similar_point((P, U, V), own[ends[others[0]]], own[ends[others[1]]])
                    if value:
                        yield value

    @cached_property
    def _places(self) -> Mapping[str, int]:
        """The steps of the points of the pose: of those that lie together one is drawn."""
        points, drawn = self.drawing.scene.points, self.drawing.drawn
        steps = {points[step.name]: step.index for step in drawn.steps[:drawn.givens] if step.name in points}
        return {name: steps[place] for name, place in points.items() if place in steps}

    @cached_property
    def link_points(self) -> list[list[int]]:
        """The steps of the points of each link."""
        return [[self._places[name] for name in names] for names in self._links]

    @cached_property
    def _links(self) -> list[list[str]]:
        """The points of each link that are drawn."""
        return [[name for name in points if name in self._places] for points in self.drawing.scene.links.values()]

    @cached_property
    def _ends(self) -> list[dict[str, int]]:
        """The ends of velocities, and of accelerations, by their points: those of points of the frame are the pole."""
        wanted, figures = self.drawing.drawn.wanted, list[dict[str, int]]()
        for kind in (VELOCITY, ACCELERATION):
            marks = {reading.of: (wanted[reading.marks[-2]], wanted[reading.marks[-1]])
                     for reading in self.drawing.readings if reading.kind == kind}
            ends = {of: end for of, (_, end) in marks.items()}
            starts = {start for start, _ in marks.values()}
            if len(starts) == 1 and (pole := next(iter(starts))) >= self.drawing.drawn.givens:
                ends |= dict.fromkeys(self._fixed_points, pole)
            elif kind == VELOCITY and all(self.plan_of_step[end] == MECHANISM for end in ends.values()):
                ends = self._turned_velocities | ends | {name: self._places[name] for name in self._fixed_points}
            figures.append(ends)
        return figures

    @property
    def _turned_velocities(self) -> dict[str, int]:
        """The ends of turned velocities on the mechanism, as they are called, asked for or not."""
        called = {f"v_{name.casefold()}": name for name in self._places}
        return {called[step.name]: step.index for step in self.drawing.drawn.steps
                if step.name in called and self.plan_of_step[step.index] == MECHANISM}

    @property
    def _fixed_points(self) -> list[str]:
        """The points of the frame."""
        return [name for name in self.drawing.scene.links.get(FRAME, ()) if name in self._places]


def _similar_point(corners: Sequence[Any], u: Any, v: Any) -> tuple[Any, Any] | None:
    """The image of the first of three corners, where the others have the images u and v."""
    P, U, V = corners
    (a, b), (c, d) = (P[0] - U[0], P[1] - U[1]), (V[0] - U[0], V[1] - U[1])
    square = c * c + d * d
    if not float(getattr(square, "value", square)):
        return None
    x, y = (a * c + b * d) / square, (b * c - a * d) / square
    p, q = v[0] - u[0], v[1] - u[1]
    return u[0] + x * p - y * q, u[1] + y * p + x * q
