"""The one linear system for the rates of every moving link, as sparse rows over the scene's own numbers.

Three unknowns a link: the velocity (x, y) of its base, a point of it, and its angular velocity. Coordinates enter as
differences only, so the rows do not depend on where the origin is. Velocities and accelerations share the rows and
differ in the right-hand side. Transposed, with the forces that hold the facts as unknowns, they are the equilibrium
of every link. Nothing is solved here, and nothing tests a number: the same rows can be filled with arrays of poses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from graphplan.mechanism.model import FRAME, Number, Pair, Scene, Slide
from graphplan.mechanism.numerals import is_exact
from graphplan.solver.facts import Fact, Rate, Side
from graphplan.solver.plane import less

Row = dict[int, Number]


@dataclass(frozen=True)
class Equations:
    """What each row states: `rows` times the unknowns equal `velocities`, and `accelerations(...)`."""

    scene: Scene
    facts: tuple[Fact, ...]

    @cached_property
    def columns(self) -> dict[str, int]:
        """The first of the three columns of each moving link."""
        return {link: 3 * k for k, link in enumerate(self.scene.moving)}

    @property
    def width(self) -> int:
        """The number of unknowns."""
        return 3 * len(self.columns)

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """The coefficients of each fact by column; the frame has none."""
        return tuple(self._row(fact) for fact in self.facts)

    def _row(self, fact: Fact) -> Row:
        row: Row = {}
        for link, sign in (fact.link, 1), (fact.on, -1):
            if link != FRAME:
                weights = fact.weights(self.arm(link, fact.at))
                row |= {self.columns[link] + k: sign * weight for k, weight in enumerate(weights)}
        return row

    def arm(self, link: str, point: str | None) -> Pair:
        """The vector from the link's base to `point`; nothing for the frame, which does not move."""
        if point is None or link == FRAME:
            return 0, 0
        return less(self.scene.points[point], self.scene.points[self.bases[link]])

    @cached_property
    def bases(self) -> dict[str, str]:
        """The point of each moving link from which its arms are measured: the first one that is not rounded."""
        places = self.scene.points
        return {link: next((p for p in self.scene.links[link] if is_exact(places[p])), self.scene.links[link][0])
                for link in self.scene.moving}

    @cached_property
    def reach(self) -> float:
        """The characteristic length: the longest coordinate of an arm, or 1 where every arm vanishes."""
        arms = (self.arm(link, fact.at) for fact in self.facts for link in (fact.link, fact.on))
        return max((abs(float(part)) for arm in arms for part in arm), default=0.0) or 1.0

    @property
    def velocities(self) -> list[Number]:
        """The right-hand side for the velocities."""
        return [fact.rate for fact in self.facts]

    def accelerations(self, rates: dict[str, Rate]) -> list[Number]:
        """The right-hand side for the accelerations, from the velocities of every link."""
        return [fact.change + fact.left_over(*self.sides(fact, rates)) for fact in self.facts]

    def sides(self, of: Fact | Slide, rates: dict[str, Rate]) -> tuple[Side, Side]:
        """The two links of a fact or of a slide at its point, with these rates."""
        on = of.along if isinstance(of, Slide) else of.on
        return self.side(of.link, of.at, rates), self.side(on, of.at, rates)

    def side(self, link: str, point: str | None, rates: dict[str, Rate]) -> Side:
        """One link at one point, with these rates."""
        return Side(self.arm(link, point), rates[link])

    def rates(self, values: Sequence[Number], zero: Number) -> dict[str, Rate]:
        """The solved unknowns link by link, the resting frame among them."""
        moving = {link: Rate(*values[k : k + 3]) for link, k in self.columns.items()}
        return moving | {FRAME: Rate(zero, zero, zero)}
