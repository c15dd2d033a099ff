"""Contacts: profiles of two links touch and slide on each other, or roll: cam and follower, a pin in a curved slot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from graphplan.mechanism.fields import (
    FLAG,
    GUIDE,
    POINT,
    TWO_LINKS,
    Field,
    Kind,
    Rows,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    Written,
    centres_on,
    describe,
)
from graphplan.mechanism.numbers import Pair, dot, exactly, minus, plus, quarter_turn, times
from graphplan.mechanism.pairs.pair import (
    ROLLING,
    TOUCHING,
    Along,
    GivenPose,
    KinematicPair,
    Rolling,
    Statement,
    Touching,
)
from graphplan.mechanism.tolerances import NORMAL_SINE_TOL, PLACE_TOL
from graphplan.phrases import phrase


@dataclass(frozen=True)
class Contact(KinematicPair):
    """Two links whose profiles touch `at` a point, which may be on no link, and slide there unless they are `rolling`.

    `centres` are those of curvature of the two profiles there, points of their links; None where a profile is straight,
    along `direction`, of any length. A profile with its centre at the very point is a corner or the end of a pin.
    `through` and `written` are as of a slide. `beyond` is the contact on the arcs that follow there, where one of the
    profiles goes on with another curvature: then accelerations jump. It is `alone` where its links touch nowhere else
    and are not geared.
    """

    symbol: ClassVar[str] = "contact"
    sentence = phrase("Contacts: {0}.")
    sides: tuple[str, str]
    at: str
    centres: tuple[str | None, str | None]
    rolling: bool = False
    direction: Pair | None = None
    through: tuple[str, str] | None = None
    written: Written = field(default=None, compare=False)
    alone: bool = True
    beyond: Contact | None = None

    @property
    def links(self) -> tuple[str, str]:
        """The two links that touch."""
        return self.sides

    @property
    def letter(self) -> str:
        """The pair's letter: R for a bar between the centres, P for a block that slides on the straight profile."""
        return "R" if self.rolling else "".join("R" if centre else "P" for centre in self.centres)

    @property
    def binds(self) -> int:
        """Rolling takes one freedom more."""
        return 2 if self.rolling else 1

    @property
    def name(self) -> str:
        """The pair's name in results, such as `2 3`, or where it is not alone `2 3 at K`."""
        return " ".join(self.sides) + ("" if self.alone else f" at {self.at}")

    @property
    def curved_side(self) -> tuple[str, str, str]:
        """A link with a centre, the other link, and that centre."""
        first, second = self.centres
        return (*self.sides, first) if first else (*reversed(self.sides), second or "")  # type: ignore[return-value]

    def normal(self, points: Mapping[str, Any]) -> Any:
        """A vector along the common normal: to the first centre from the second; of any length."""
        first, second = self.centres
        if self.direction is not None:
            return quarter_turn(self.direction)
        return minus(points[first or ""], points[second or ""])

    def foot(self, points: Mapping[str, Any]) -> Pair:
        """The point of the common normal abreast of the point of contact: that point, but for rounding."""
        normal, centre = exactly(self.normal(points)), points[self.curved_side[2]]
        share = dot(normal, minus(exactly(points[self.at]), exactly(centre))) / dot(normal, normal)
        return plus(exactly(centre), times(share, normal))

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """The one profile does not leave the other, nor slips on it where they roll."""
        (link, on, centre), points = self.curved_side, scene.points
        normal, arm, straight = self.normal(points), minus(points[centre], points[self.at]), self.direction is not None
        yield Touching(link, on, centre, normal, TOUCHING, name=self.name, arm=arm, straight=straight)
        if self.rolling and self.direction is not None:
            lever = -dot(self.direction, quarter_turn(arm))
            yield Along(link, on, centre, self.direction, ROLLING, lever=lever, name=self.name)
        elif self.rolling:
            first, second = (centre or "" for centre in self.centres)
            k1, k2 = (dot(minus(points[end], points[self.at]), normal) for end in (first, second))
            yield Rolling(link, on, first, second, minus(points[second], points[first]), (k1, -k2), self.name)


def _profiles(item: SceneItem, names: SceneNames) -> tuple[Any, ...] | None:
    """Of each profile the centre, or in its place the direction of a straight one."""
    if not isinstance(item.value, list) or len(item.value) != 2:
        return item.fault(f"{describe(item.value)} where two centres are wanted",
                          'two centres such as ["C2", "C3"], or a direction instead of one')
    profiles = [_centre(item.with_value(entry), names) for entry in item.value]
    return None if None in profiles else tuple(profiles)


def _centre(item: SceneItem, names: SceneNames) -> Any:
    """The name of a point, or a direction."""
    if isinstance(item.value, str) and len(item.value.split()) < 2:
        return item.name_of("point", names.points)
    return GUIDE.read(item, names)


PROFILES = Kind("two centres, or a direction instead of one", _profiles,
                {"type": "array", "minItems": 2, "maxItems": 2, "items": {"anyOf": [POINT.schema, GUIDE.schema]}})


def _read(row: TableRow) -> Contact | None:
    """A contact whose parts fit each other, before the point and, where `next` is given, beyond it."""
    contact = _read_contact(row, "centres")
    if not contact or row.values.get("next") is None:
        return contact
    beyond = _read_contact(row, "next")
    if beyond and beyond.centres == contact.centres and beyond.direction == contact.direction:
        return row.items["next"].fault("the arcs that follow are those before", "another centre, or no next")
    return beyond and replace(contact, beyond=beyond)


def _read_contact(row: TableRow, key: str) -> Contact | None:
    """The contact of the profiles under a key."""
    links, profiles = row["links"], row[key]
    straight = [first for first in profiles if not isinstance(first, str)]
    if links[0] == links[1]:
        return row.item.fault(f"link {links[0]} touches itself", "two different links")
    if len(straight) > 1:
        return row.items[key].fault("both profiles are straight", "[[slides]] for two lines that slide")
    if not centres_on(row, *((profiles[k], link) for k, link in enumerate(links) if isinstance(profiles[k], str))):
        return None
    direction, through, written = straight[0] if straight else (None, None, None)
    profile, second = (end if isinstance(end, str) else None for end in profiles)
    contact = Contact(links, row["at"], (profile, second), row["rolling"], direction, through, written)
    return contact if _check_normal(contact, row, key) else None


def _check_normal(contact: Contact, row: TableRow, key: str) -> bool:
    """Whether the point and the centres are on one normal, and the curvatures differ."""
    named = [point for point in contact.centres if point]
    if any(point not in row.names.places for point in (*named, contact.at, *(contact.through or ()))):
        return True  # the point has its own fault
    points = {name: exactly(at) for name, at in row.names.places.items()}
    normal = exactly(contact.normal(points))
    item = row.items[key]
    rounding = PLACE_TOL * max(abs(coordinate) for name in (*named, contact.at) for coordinate in points[name])
    if not any(normal):
        cause = "two corners" if points[contact.at] == points[named[0]] else "two profiles of the same curvature"
        item.fault(f"the centres {' and '.join(named)} coincide: {cause}", "centres that lie apart")
        return False
    for point in named:
        arm = minus(points[point], points[contact.at])
        if contact.rolling and arm == (0, 0):
            item.fault(f"{point} is the centre and the point of contact: a corner does not roll", "rolling = false")
            return False
        square, long = dot(normal, normal), dot(arm, arm)
        if dot(normal, quarter_turn(arm)) ** 2 > NORMAL_SINE_TOL**2 * square * long + 2 * rounding**2 * (square + long):
            fault = ("not perpendicular to the direction" if contact.direction is not None
                     else "not in line with the centres")
            problem = (f"{contact.at} and {point} are {fault}" if contact.direction is not None
                       else f"{contact.at} is {fault} {' and '.join(named)}")
            such = f'such as {contact.at} = {{ on = "{" ".join(named)}", distance = ... }}' if len(named) > 1 else ""
            row.items["at"].fault(problem, f"a point of contact on the common normal{such and ', '}{such}")
            return False
    return True


FIELD = Field("contacts", "two links touch and slide: cam and follower, a pin in a curved slot, a wheel on a rail",
              Rows(Table("a contact", (
    Field("links", "the two links", TWO_LINKS, 'the two links, such as links = ["2", "3"]'),
    Field("at", "the point where they touch in this pose; it may be on no link", POINT,
          'the point where they touch, such as at = "K"'),
    Field("centres", "the centres of curvature of the two profiles, points of the links on the normal; instead of "
          "one the direction of a straight profile", PROFILES,
          'the centres of curvature, such as centres = ["C2", "C3"]'),
    Field("next", "the same of the arcs that follow, where one of the profiles goes on there with another curvature",
          PROFILES, default=None),
    Field("rolling", "whether they roll without slipping", FLAG, default=False),
), _read), remedy="one where two links touch", once=lambda contact: (
    (frozenset(contact.links), contact.at), "contact of links {} and {} at {}".format(*contact.links, contact.at))))
