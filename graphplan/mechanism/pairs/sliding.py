"""Sliding pairs: one link slides along a guide that is fixed to another, and turns as that does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

from graphplan.mechanism.fields import GUIDE, LINK, POINT, Field, Rows, Table, TableRow, Written, is_on_link
from graphplan.mechanism.numbers import Pair, quarter_turn
from graphplan.mechanism.pairs.pair import LINE, TURNING, Along, GivenPose, KinematicPair, Statement, Turning
from graphplan.phrases import phrase


@dataclass(frozen=True)
class Slide(KinematicPair):
    """A sliding pair: `link` slides along the guide fixed to `along`; `at` is a point of `link` on the guide line.

    `direction` is the guide's direction in this pose, of any length. `through` names the two points that give it,
    where the scene gives it so: then it turns with them in other poses. `written` is the direction as the scene
    writes it: a vector, an angle in degrees, or two points. Other pairs with a guide may pass on less.
    """

    letter: ClassVar[str] = "P"
    passes: ClassVar[tuple[str, ...]] = (LINE, TURNING)
    symbol: ClassVar[str] = "block"
    sentence = phrase("Sliding pairs: {0}.")
    link: str
    along: str
    at: str
    direction: Pair
    through: tuple[str, str] | None = None
    written: Written = field(default=None, compare=False)

    def __hash__(self) -> int:
        return hash((self.link, self.along, self.at))  # fractions take long

    @property
    def links(self) -> tuple[str, str]:
        """The sliding link, and that of the guide."""
        return self.link, self.along

    @property
    def given_links(self) -> tuple[str, ...]:
        """The links of the pair that the scene gives: its own, but where it stands for another."""
        return self.links

    @property
    def turns_alike(self) -> bool:
        """Whether its links turn alike, so that any points of theirs show the sliding."""
        return TURNING in self.passes

    @property
    def guiding(self) -> tuple[str, ...]:
        """The links whose turning is that of the guide."""
        return self.links if self.turns_alike else (self.along,)

    @property
    def name(self) -> str:
        """The pair's name in results, such as `3 along 2`."""
        return f"{self.link} along {self.along}"

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """A link that slides along another neither turns on it nor leaves the guide."""
        if self.turns_alike:
            yield Turning(self.link, self.along)
        yield Along(self.link, self.along, self.at, quarter_turn(self.direction), "across")


def _read(row: TableRow) -> Slide | None:
    """A sliding pair; the direction's length stays as written."""
    link, along = row["link"], row["along"]
    if link == along:
        return row.item.fault(f"link {link} slides along itself", "two different links")
    if not is_on_link(row, "at", row["at"], link, "the sliding link"):
        return None
    return Slide(link, along, row["at"], *row["direction"])


FIELD = Field("slides", "a sliding pair: one link slides along another", Rows(Table("a sliding pair", (
    Field("link", "the sliding link", LINK, 'the sliding link, such as link = "3"'),
    Field("along", "the link with the guide", LINK, 'the link with the guide, such as along = "2"'),
    Field("at", "a point of the sliding link on the guide line", POINT,
          'a point of the sliding link on the guide line, such as at = "B"'),
    Field("direction", "the guide's direction: a vector, an angle in degrees, or two points", GUIDE,
          'the guide\'s direction: a vector, an angle in degrees, or two points "O A"'),
), _read), remedy="one slide between two links, as a guide in line with it only repeats it", once=lambda slide: (
    frozenset(slide.links), "slide between links {} and {}".format(*slide.links))))


def has_slide(row: TableRow, otherwise: str, few: str = "", key: str = "slide") -> Slide | None:
    """Return the slide that a key of a row names; add a fault if it does not exist, unless slides have their own."""
    item, (link, along) = row.items[key], row[key]
    guides = {slide.links: slide for slide in row.names.pairs if isinstance(slide, Slide)}
    if (link, along) in guides or not item.faults.none_in("slides", "links"):
        return guides.get((link, along))
    choices = [f'{key} = ["{slider}", "{guide}"]' for slider, guide in sorted(guides)]
    instead = few + ", ".join(choices) if choices else otherwise
    suggestion = f'perhaps {key} = ["{along}", "{link}"]' if (along, link) in guides else instead
    return item.fault(f"no slide of link {link} along link {along}", suggestion)
