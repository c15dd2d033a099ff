"""What all syntheses share: the board on which a construction is recorded, and what was found."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import combinations, pairwise
from typing import Any

from graphplan.errors import NoMechanism
from graphplan.kernel.passes import Values, record_drawing
from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.phrases import Said, digits, said
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import COLLINEAR_TOL, SAME_POINT_TOL

FIRST_THREE = 0, 1, 2  # of more points through which a circle goes: those by which its centre is drawn
PLAN = Panel("synthesis", said("synthesis"), said("The mechanism found"))


@dataclass(frozen=True)
class Synthesis:
    """Result of a synthesis: linkages, best first, or a wheel or profile; the drawing of each, and further `results`.

    Of a path `given` is the linkage that draws it, `path` the path as far as it goes, `stretch` the part that is asked
    for.
    """

    task: SynthesisTask
    drawings: tuple[Values, ...]
    linkages: tuple[FoundLinkage, ...] = ()
    results: Mapping[str, Any] = field(default_factory=dict)
    chosen: int = 0
    given: FoundLinkage | None = None
    path: tuple[complex, ...] = ()
    stretch: tuple[complex, ...] = ()

    @property
    def values(self) -> Values:
        """The drawing of the chosen solution."""
        return self.drawings[self.chosen]

    @property
    def linkage(self) -> FoundLinkage:
        """The chosen linkage."""
        return self.linkages[self.chosen]


class SynthesisBoard:
    """A construction as it is recorded, stage by stage; marks are kept by their roles."""

    def __init__(self) -> None:
        self.board, self.roles = Board(), dict[str, list[Mark]]()

    @contextmanager
    def stage(self, title: Said, law: Said) -> Iterator[None]:
        """Draw what stands inside as one stage."""
        with self.board.on(PLAN, stage=Stage(title, law)):
            yield

    def given(self, point: complex, name: str = "", role: str = "") -> Mark:
        """A given point."""
        with self.board.on(PLAN):
            return self.keep(role or name, self.board.given(x=point.real, y=point.imag, name=name))

    def keep(self, role: str, mark: Mark) -> Mark:
        """Remember a mark by its role: it is drawn, and its value can be read."""
        self.roles.setdefault(role, []).append(mark)
        return mark

    def ray(self, P: Mark, degrees: float, **notes: Any) -> Mark:
        """The line through a point at an angle."""
        return self.board.inclined(P, angle=spoken_angle(degrees), **notes)

    def circle_through(self, points: Sequence[Mark], name: str, role: str = "", three: Sequence[int] = FIRST_THREE
                       ) -> Mark:
        """The centre of the circle through points, by two bisectors of three of them; those of the rest go through it
        too."""
        P, Q, R = (points[k] for k in three)
        bisectors = [self.keep("bisector", self.board.bisector(*ends)) for ends in ((P, Q), (Q, R))]
        centre = self.keep(role or name, self.board.meet(*bisectors, name=name))
        for ends in pairwise(points[2:]):
            self.keep("bisector", self.board.bisector(*ends))
        return centre

    def values(self) -> Values:
        """The finished drawing with its values."""
        return record_drawing(self.board, self.roles).mark_values()


def spoken_angle(degrees: float) -> Angle:
    """An angle in degrees as steps have it."""
    u = direction(degrees)
    return Angle(digits(degrees, 6), u.real, u.imag)


def direction(degrees: float) -> complex:
    """The unit vector at an angle, exact at quarters of a turn."""
    quarters, remainder = divmod(degrees, 90)
    return cmath.rect(1.0, math.radians(remainder)) * (1, 1j, -1, -1j)[int(quarters) % 4]


def place_of(values: Values, role: str, k: int = 0) -> complex:
    """Place of the mark of a role."""
    return complex(*values.values_of_role(role)[k])


def require_circle(where: str, names: str, points: Iterable[complex], size: float, instead: str) -> None:
    """Fail with `NoMechanism` where points coincide or lie in a line, so that no circle goes through them."""
    P, Q, R = points
    for (start, X), (end, Y) in combinations(zip(names.split(), (P, Q, R), strict=True), 2):
        if abs(Y - X) <= SAME_POINT_TOL * size:
            raise NoMechanism(where, f"{start} and {end} coincide, so that no circle is determined", "another point")
    if abs(((R - P) / (Q - P)).imag) * abs(Q - P) <= COLLINEAR_TOL * abs(R - P):
        raise NoMechanism(where, f"{', '.join(names.split())} lie in a line", instead)


def require_lengths(linkage: FoundLinkage, where: str, size: float, instead: str) -> FoundLinkage:
    """The linkage; fails with `NoMechanism` where a link of it has no length."""
    if min(linkage.sides.values()) <= SAME_POINT_TOL * size:
        raise NoMechanism(where, "a link of the linkage has no length", instead)
    return linkage


def pair(z: complex) -> list[float]:
    """A point as JSON has it."""
    return [z.real + 0.0, z.imag + 0.0]


def largest(values: Iterable[complex]) -> float:
    """The size of a task: of its largest number; 1 if all are 0, so that it can be a divisor."""
    return max([abs(value) for value in values], default=0.0) or 1.0
