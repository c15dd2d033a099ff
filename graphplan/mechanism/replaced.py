"""The lower pairs that stand for gears and contacts in a construction.

A contact becomes a bar between the centres of curvature of the two profiles, or where one profile is straight a block
that slides along it. Two links that roll on each other have in their pitch point velocities and accelerations that
agree perpendicular to the line of centres, also where that turns: a *rolling guide*, which passes on this line and no
more. Where the line of centres has its length, which other pairs see to, the velocities agree wholly.

Source: Ozols (1974), 5-2 and 5-7 (replacement of higher pairs), 7-3 (the pitch point as relative pole).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from fractions import Fraction
from typing import Any

from graphplan.mechanism.model import FRAME, Contact, Gear, Number, Pair, Scene
from graphplan.mechanism.numbers import dot, is_exact, minus, plus, quarter_turn, root, times
from graphplan.mechanism.order import by_name
from graphplan.mechanism.pairs.pair import LINE, ROLLING, TOUCHING, TURNING
from graphplan.mechanism.pairs.sliding import Slide

Higher = Gear | Contact


@dataclass(frozen=True)
class StandIn(Slide):
    """The lower pair instead of a gear or contact; for a straight profile the block that slides along it."""

    given_pair: Any = field(default=None, compare=False)

    @property
    def given_links(self) -> tuple[str, ...]:
        """The links of the gear or contact; of a straight profile the one that touches it first."""
        return (straight(self.given_pair) or self.given_pair).links


@dataclass(frozen=True)
class RollingGuide(StandIn):
    """The remaining freedom of the contact point `at` of two rolling links: it may move along the line of centres.

    The line runs `through` the centres; where there is but one, perpendicular to the straight profile or pitch line,
    `rail`. The point is drawn from the centre `base`: by a `ratio` of the distance of the centres, or by a `length` to
    the left of the rail. Only on a rail along which no length can be laid off in fractions is it given, and there is no
    base.
    """

    letter = ""
    binds = 1
    passes = (LINE,)
    base: str = ""
    ratio: Number | None = None
    rail: Slide | None = None
    length: Number | None = None

    @property
    def guiding(self) -> tuple[str, ...]:
        """Rolling has no Coriolis acceleration."""
        return ()

    @property
    def name(self) -> str:
        """A name that no other pair has."""
        return f"{self.link} rolling on {self.along} at {self.at}"

    @property
    def other_centre(self) -> str:
        """The centre that the point is drawn towards."""
        return next(centre for centre in self.through or () if centre != self.base)


@dataclass(frozen=True)
class EqualTurning(StandIn):
    """A belt around equal wheels: they turn alike, whatever their line of centres does."""

    letter = ""
    binds = 1
    passes = (TURNING,)


@dataclass(frozen=True)
class ReplacedScene(Scene):
    """A scene with lower pairs instead of its higher ones, and the contacts by the links that stand for them."""

    bars: Mapping[str, Contact] = field(default_factory=dict)


def with_lower_pairs(scene: Scene) -> Scene:
    """Replace the gears and contacts of a scene by lower pairs; a scene without them is returned as it is.

    Bars and blocks are links named 0, pitch points are named P with the numbers of the links; neither takes a name that
    the scene has. Pairs that special geometry makes redundant are left out: others say what they would.
    """
    higher = sorted((pair for pair in scene.written if isinstance(pair, Higher)), key=_order)
    if not higher:
        return scene
    lost = {condition.pair for condition in scene.redundant}
    stand_ins = _StandIns(scene)
    for pair in higher:
        if isinstance(pair, Contact):
            stand_ins.contact(pair)
        elif pair.name not in lost:
            stand_ins.gear(pair)
    points, links = scene.points | stand_ins.points, {**stand_ins.links, **stand_ins.bars}
    values = {attribute.name: getattr(scene, attribute.name) for attribute in fields(Scene)}
    values |= {"points": points, "links": links, "written": (*scene.written, *stand_ins.pairs)}
    return ReplacedScene(**values, bars=stand_ins.contacts)


def scene_beyond(scene: Scene) -> Scene | None:
    """The scene just beyond the points where profiles continue with another curvature; None if no profile does, and at
    another travel, where others touch."""
    if scene.assembly is not None:
        return None
    written = tuple(replace(pair.beyond, alone=pair.alone) if isinstance(pair, Contact) and pair.beyond else pair
                    for pair in scene.written)
    return replace(scene, written=written) if written != scene.written else None


def rolling_guides(scene: Scene) -> tuple[RollingGuide, ...]:
    """The rolling guides of a scene that is replaced, each with the gear or contact that it stands for."""
    return tuple(pair for pair in scene.written if isinstance(pair, RollingGuide))


def guides(scene: Scene) -> dict[str, Slide]:
    """All pairs of a scene that have a direction: its slides, straight profiles and racks, each by its own name.

    A profile or rack is as a slide of its two links, at the centre of what touches it there.
    """
    higher = {pair.name: straight(pair) for pair in scene.written if isinstance(pair, Higher)}
    return {slide.name: slide for slide in scene.slides} | {name: slide for name, slide in higher.items() if slide}


def straight(pair: Higher) -> Slide | None:
    """The straight profile of a contact or the pitch line of a rack, as a slide of what touches it; None of others."""
    if pair.direction is None:
        return None
    (link, along), centre = pair.links, pair.centres[0]
    if centre is None:
        (along, link), centre = pair.links, pair.centres[1]
    assert centre is not None
    return Slide(link, along, centre, pair.direction, pair.through, pair.written)


def bars(scene: Scene) -> Mapping[str, Contact]:
    """The bars and blocks of a scene that is replaced, by their names, with the contacts that they stand for."""
    return scene.bars if isinstance(scene, ReplacedScene) else {}


class _StandIns:
    """Collects what stands for the higher pairs of a scene: points, links with their points, bars, and pairs."""

    def __init__(self, scene: Scene):
        self.scene = scene
        self.points: dict[str, Pair] = {}
        self.links = dict(scene.links)
        self.bars: dict[str, tuple[str, ...]] = {}
        self.contacts: dict[str, Contact] = {}
        self.pairs: list[Slide] = []

    def gear(self, gear: Gear) -> None:
        """A rolling guide at the pitch point; around equal wheels a belt only makes them turn alike."""
        B, *other_centres = gear.centres
        if not other_centres:
            self._rack(gear, B)
            return
        (C,), (first, two) = other_centres, gear.factors
        if first + two == 0:
            self.pairs.append(EqualTurning(*gear.links, B, (1, 0), given_pair=gear))
            return
        ratio, direction = first / (first + two), minus(self._place_of(C), self._place_of(B))
        point = self._new_point(gear, plus(self._place_of(B), times(_fraction(ratio), direction)))
        self._roll(gear, point, direction, (B, C), base=B, ratio=ratio)

    def _rack(self, gear: Gear, B: str) -> None:
        """The pitch point of a rack: the foot of the gear's centre on the pitch line, to the right of that."""
        rail, length = straight(gear), -gear.radius
        assert rail is not None
        square = quarter_turn(_fractions(rail.direction))
        whole, _ = root(_fraction(dot(square, square)))
        point = self._new_point(gear, plus(self._place_of(B), times(_fraction(length) / whole, square)))
        self._roll(gear, point, square, base=B, rail=rail, length=length)

    def contact(self, contact: Contact) -> None:
        """A bar between the centres of curvature, or a block on the straight profile."""
        name, rail = free_name("0", {*self.links, *self.bars}), straight(contact)
        needed = {TOUCHING, ROLLING} - {c.way for c in self.scene.redundant if c.pair == contact.name}
        if TOUCHING in needed:
            self.contacts[name] = contact
            self.bars[name] = tuple(filter(None, contact.centres))
        if TOUCHING in needed and rail:
            self.pairs.append(StandIn(name, rail.along, rail.at, rail.direction, rail.through, rail.written, contact))
        if ROLLING in needed and contact.rolling:
            self._rolling(contact, rail)

    def _rolling(self, contact: Contact, rail: Slide | None) -> None:
        """A rolling guide where a contact touches: in a point of no link, as it wanders on both."""
        free = not self.scene.links_of[contact.at]
        point = contact.at if free else self._new_point(contact, self._place_of(contact.at))
        base, *other_centres = filter(None, contact.centres)
        arm = minus(self._place_of(contact.at), self._place_of(base))
        if rail is None:
            direction = minus(self._place_of(other_centres[0]), self._place_of(base))
            share = dot(arm, direction) / dot(direction, direction)
            self._roll(contact, point, direction, (base, other_centres[0]), base=base, ratio=share)
            return
        square = quarter_turn(_fractions(rail.direction))
        long, exact = root(_fraction(dot(square, square)))
        length = dot(arm, square) / long
        drawable = exact or not is_exact(rail.direction, self.scene.points[base])
        self._roll(contact, point, square, base=base if drawable else "", rail=rail, length=length)

    def _roll(self, pair: Higher, at: str, direction: Pair, through: tuple[str, str] | None = None, *, base: str,
              ratio: Number | None = None, rail: Slide | None = None, length: Number | None = None) -> None:
        """A rolling guide; the point is one of the link that moves, of two such the first."""
        link, along = sorted(pair.links, key=_rank)
        self.links[link] = tuple(dict.fromkeys((*self.links[link], at)))
        self.pairs.append(RollingGuide(link, along, at, direction, through, None, pair, base, ratio, rail, length))

    def _new_point(self, pair: Higher, place: Pair) -> str:
        """A new point, named after the links that it belongs to: it is their relative pole."""
        numbers = ["0" if link == FRAME else link for link in sorted(pair.links, key=_rank)]
        plain = all(len(number) == 1 and number.isalnum() for number in numbers)
        name = free_name("P_" + "".join(numbers) if plain else "P", {*self.scene.points, *self.points})
        self.points[name] = place
        return name

    def _place_of(self, point: str) -> tuple[Fraction, Fraction]:
        return _fractions(self.scene.points[point])


def _order(pair: Higher) -> tuple[Any, ...]:
    """The order in which stand-ins are named, whatever the order of writing."""
    return *sorted(map(by_name, pair.links)), isinstance(pair, Contact), *map(by_name, filter(None, pair.centres))


def _rank(link: str) -> tuple[Any, ...]:
    return link == FRAME, by_name(link)


def free_name(name: str, taken: Iterable[str]) -> str:
    """The name, with as many primes as make it unique."""
    while name in taken:
        name += "'"
    return name


def _fractions(pair: Pair) -> tuple[Fraction, Fraction]:
    """A point or vector in fractions, so that what is in line with others is so exactly."""
    return _fraction(pair[0]), _fraction(pair[1])


def _fraction(number: Number) -> Fraction:
    """A number in fractions; of one with bounds the middle, as a stand-in's place is drawn from its centres."""
    return number if isinstance(number, Fraction) else Fraction(float(number))
