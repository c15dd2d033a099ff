"""Sliding pairs: one link slides along a guide that is fixed to another, and turns as that does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, ClassVar

from graphplan.mechanism.pairs.pair import Along, KinematicPair, Statement, Turning
from graphplan.mechanism.plane import Pair, turned

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene

Written = tuple[Fraction, Fraction] | Fraction | str | None


@dataclass(frozen=True)
class Slide(KinematicPair):
    """A sliding pair: `link` slides along the guide fixed to `along`; `at` is a point of `link` on the guide line.

    `direction` is the guide's direction in this pose, of any length. `through` names the two points that give it,
    where the scene gives it so: then it turns with them in other poses. `written` is the direction as the scene
    writes it: a vector, an angle in degrees, or two points. Its links turn alike; those of other pairs with a guide
    need not.
    """

    letter = "P"
    turns_alike: ClassVar[bool] = True
    link: str
    along: str
    at: str
    direction: Pair
    through: tuple[str, str] | None = None
    written: Written = field(default=None, compare=False)

    @property
    def links(self) -> tuple[str, str]:
        """The sliding link, and that of the guide."""
        return self.link, self.along

    @property
    def name(self) -> str:
        """The pair's name in results, such as `3 along 2`."""
        return f"{self.link} along {self.along}"

    def states(self, scene: Scene) -> Iterator[Statement]:
        """A link that slides along another neither turns on it nor leaves the guide."""
        if self.turns_alike:
            yield Turning(self.link, self.along)
        yield Along(self.link, self.along, self.at, turned(self.direction), "across")
