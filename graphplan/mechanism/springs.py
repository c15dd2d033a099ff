"""Springs between two points of different links: along their line, in every pose, as strong as they are stretched.

A spring is a pair of opposite forces over the distance of its ends, so all that reads loads that change reads springs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from graphplan.mechanism.fields import Field, Kind, Rows, SceneNames, Table, TableRow
from graphplan.mechanism.items import SceneItem, describe
from graphplan.mechanism.loads import LoadTable
from graphplan.mechanism.model import FRAME, Force, Number
from graphplan.mechanism.values import AMOUNT, DISTANCE, POINT, TWO_LINKS


@dataclass(frozen=True)
class Spring:
    """A spring: its ends, the links that they are points of, its stiffness (force / length), its length without force.

    The first end is on a link that moves.
    """

    ends: tuple[str, str]
    links: tuple[str, str]
    stiffness: Number
    free: Number
    where: str = ""

    @property
    def law(self) -> LoadTable:
        """Its pull by the distance l of its ends: c (l - l_0), as powers -c l_0 and c."""
        name = "distance of {} and {}".format(*self.ends)
        return LoadTable(name, powers=(-self.stiffness * self.free, self.stiffness), where=self.where, span=self.ends)


def spring_forces(springs: Iterable[Spring]) -> Iterator[Force]:
    """What springs do to the links that move: each end is pulled towards the other."""
    for spring in springs:
        for (near, far), link in zip((spring.ends, spring.ends[::-1]), spring.links, strict=True):
            if link != FRAME:
                yield Force(link, near, (Fraction(0), Fraction(0)), spring.law, (Fraction(1), Fraction(0)), (near, far))


def spring_laws(forces: Iterable[Force]) -> Iterator[LoadTable]:
    """The laws of the springs among these forces, each spring once."""
    return (force.table for force in forces if force.table and force.table.span and force.at == force.table.span[0])


def spring_numbers(law: LoadTable) -> tuple[Number, Number]:
    """The stiffness and the length without force of a spring with this law."""
    constant, stiffness = law.powers
    return stiffness, -constant / stiffness


def _read_ends(item: SceneItem, names: SceneNames) -> tuple[str | None, ...] | None:
    if not isinstance(item.value, list) or len(item.value) != 2:
        return item.fault(f"{describe(item.value)} where two points are wanted", 'two points such as ["A", "F"]')
    return tuple(POINT.read(item.with_value(name), names) for name in item.value)


def _spring(row: TableRow) -> Spring | None:
    """A spring, its links named where its ends leave a choice."""
    ends, item, names = row["ends"], row.items["ends"], row.names
    if None in ends:
        return None
    if ends[0] == ends[1]:
        return item.fault("both ends are one point", "two points of different links")
    links = row.values.get("on") or tuple(_only_link(item, end, ends, names) for end in ends)
    if None in links:
        return None
    for end, link in zip(ends, links, strict=True):
        if end not in names.links.get(link, ()):
            return item.fault(f"{end} is not a point of link {link}", "on with a link that has the point")
    if links[0] == links[1]:
        return item.fault(f"both ends are on link {links[0]}, so its length never changes", "points of different links")
    order = slice(None, None, -1 if links[0] == FRAME else 1)
    return Spring(ends[order], links[order], row["stiffness"], row["free"], row.item.where)


def _only_link(item: SceneItem, end: str, ends: Iterable[str], names: SceneNames) -> str | None:
    """The link that has a point; a fault where none or several do."""
    links = [link for link, points in names.links.items() if end in points]
    if len(links) == 1 or not item.faults.none_in("links"):
        return links[0] if links else None
    if not links:
        return item.fault(f"no link has the point {end}", "points of links")
    on = ", ".join(f'"{next((link for link, points in names.links.items() if name in points), FRAME)}"'
                   for name in ends)
    problem = f"{end} is on several links: {', '.join(links)}"
    return item.fault(problem, f"the links of the two ends, such as on = [{on}]")


TWO_POINTS = Kind("two points", _read_ends, {"type": "array", "items": POINT.schema, "minItems": 2, "maxItems": 2})
STIFFNESS = Kind("number above 0", lambda item, names: item.positive("stiffness"), DISTANCE.schema)
SPRINGS = Rows(Table("a spring", (
    Field("ends", "its two ends, points of different links",
          TWO_POINTS,
          'its two ends, such as ends = ["A", "F"]'),
    Field("on", "the links that the ends are on, where a point is on several", TWO_LINKS),
    Field("stiffness", "its stiffness, force / length", STIFFNESS, "its stiffness, such as stiffness = 2.5"),
    Field("free", "its length without force", AMOUNT, "its length without force, such as free = 80"),
), _spring))
