"""Dimensions of links, as tolerances name them: a distance, the offset of a guide, an angle.

`"O A"` is the distance of two points of a link, `"3 along frame"` how far the guide of that slide lies to the left of
where it is, `"A B C"` the angle at B between BA and BC, of three points of a link, in degrees.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from graphplan.mechanism.fields import Named, SceneNames
from graphplan.mechanism.items import SceneItem
from graphplan.mechanism.model import Slide
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.mechanism.values import AMOUNT, TEXT


@dataclass(frozen=True)
class NamedDimension:
    """A dimension by its name: of `link` between two or three of its `points`, or the offset of the guide of a `slide`.
    """

    name: str
    link: str
    points: tuple[str, ...] = ()
    slide: Slide | None = None

    @property
    def is_angle(self) -> bool:
        """Whether it is an angle, in degrees."""
        return len(self.points) == 3


def dimension(name: str, links: Mapping[str, tuple[str, ...]], pairs: Iterable[KinematicPair]) -> NamedDimension | None:
    """The dimension of this name among links and pairs; None where there is none."""
    for pair in pairs:
        if isinstance(pair, Slide) and pair.name == name:
            return NamedDimension(name, pair.along, slide=pair)
    points = tuple(name.split())
    links_with = [link for link, own in links.items() if {*points} <= {*own}]
    exists = links_with and len({*points}) == len(points) in (2, 3)
    return NamedDimension(name, links_with[0], points) if exists else None


def _check_dimension(name: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where a name is that of no dimension."""
    if item.faults.none_in("links", "slides") and dimension(name, names.links, names.pairs) is None:
        item.fault(f"{name} is no dimension of a link", 'two points of a link, such as "O A", three for the angle at '
                   'the second, or a slide, such as "3 along frame", for the offset of its guide')


TOLERANCES = Named(AMOUNT, TEXT, _check_dimension)
