"""The mechanism as a network of bodies that meet in places: what the planner walks on, never a coordinate.

A *body* is a link, together with the links whose motion relative to it a drive prescribes (they share its unknowns).
A *place* is a point of the mechanism as the bodies there see it: (X, "") for the joint or point X itself, (X, link) for
the point of another link's plane that coincides with X, which sliding pairs need. Points of one link that coincide are
one place, under one name.

Links, points, slides and drives are taken in an order of their own, so that the order of writing changes no plan.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import NamedTuple

from graphplan.mechanism.model import FRAME, Drive, Number, Scene, Slide
from graphplan.mechanism.order import StructuralOrder
from graphplan.mechanism.pairs.pair import LINE
from graphplan.mechanism.replaced import bars, rolling_guides, with_lower_pairs

BodyPoint = tuple[str, str]
POLE = "pole"  # the link of a place that is a relative pole


class DrivenPair(NamedTuple):
    """A drive between two links that share a pair: `link` moves as `to` does, but for what the drive prescribes.

    `at` is the common joint of a turning drive; a sliding drive has its slide instead.
    """

    link: str
    to: str
    drive: Drive
    sign: int
    at: str = ""
    slide: Slide | None = None


class AngularRates(NamedTuple):
    """An angular velocity and an angular acceleration."""

    omega: Number
    alpha: Number


class Turnings:
    """Relative turning of a scene's links, independent of the pose; computed link by link.

    A slide makes two links turn alike, a turning drive by a given difference.
    """

    def __init__(self, slides: Iterable[Slide], drives: Iterable[Drive]):
        self._beside: dict[str, list[tuple[str, AngularRates]]] = {}
        self._found: dict[str, dict[str, AngularRates]] = {}
        for slide in slides:
            if slide.turns_alike:
                self._join(*slide.links, AngularRates(0, 0))
        for drive in drives:
            if not drive.slides:
                self._join(*drive.links, AngularRates(*drive.rates))

    def _join(self, link: str, other: str, more: AngularRates) -> None:
        self._beside.setdefault(link, []).append((other, more))
        self._beside.setdefault(other, []).append((link, AngularRates(-more.omega, -more.alpha)))

    def links_turning_with(self, link: str) -> dict[str, AngularRates]:
        """The links whose turning differs from this one's by given rates, and by how much this link exceeds each."""
        if link not in self._found:
            found = self._found[link] = {link: AngularRates(0, 0)}
            waiting = [link]
            for here in waiting:
                for other, more in self._beside.get(here, ()):
                    if other not in found:
                        found[other] = AngularRates(found[here].omega + more.omega, found[here].alpha + more.alpha)
                        waiting.append(other)
        return self._found[link]

    def prescribed_rates(self, link: str) -> AngularRates | None:
        """The rates that the drives prescribe for a link: by how much it exceeds the frame."""
        return self.links_turning_with(link).get(FRAME)


class Network:
    """Bodies, places, slides and classes of equal turning of a scene, lower pairs instead of its higher ones."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene = with_lower_pairs(scene)
        self.bars = bars(scene)
        self.wandering = {guide.at for guide in rolling_guides(scene)}
        self.welds: dict[str, DrivenPair] = {}
        self.turning: list[Drive] = []
        self.order = StructuralOrder(scene)
        own = self.order.links()
        first: dict[object, str] = {}
        self._spots = {point: first.setdefault(scene.points[point], point) for point in self.order.points()}
        self.relied: dict[tuple[str, str], None] = {}
        self.names = self._names(own)
        self.links = {link: tuple(dict.fromkeys(map(self.name, points))) for link, points in own.items()}
        if any(not drive.slides and drive.links[1] == FRAME for drive in scene.drives):
            self.links.setdefault(FRAME, ())  # an open chain may still be driven against the ground
        self.links_of: dict[str, tuple[str, ...]] = {}
        for link, points in self.links.items():
            for point in points:
                self.links_of[point] = (*self.links_of.get(point, ()), link)
        self.body = {link: link for link in self.links}
        self.members = {link: [link] for link in self.links}
        driven = [scene.driven_slide(drive) for drive in scene.drives if drive.slides]
        self.all_slides = [slide for slide in self.order.slides() if LINE in slide.passes]
        self.slides = [slide for slide in self.all_slides if slide not in driven]
        self.coincident = self._coincident_points()
        for drive in self.order.drives():
            self._weld(drive)
        self.ground = self.body.get(FRAME, "")
        self.classes = self._turning_classes()
        self.auxiliary = {self.body[held.link]: (letter, tuple(self.name(point) for point in held.points))
                          for letter, links in scene.sheet.auxiliary.items() for held in links}
        self.turnings = Turnings(self.order.slides(), self.order.drives())
        self.slides_of: dict[str, list[Slide]] = {}
        for slide in self.slides:
            for link in slide.links:
                self.slides_of.setdefault(self.body[link], []).append(slide)

    def _names(self, links: dict[str, tuple[str, ...]]) -> dict[str, str]:
        """The one name of points that lie in one place of one link, for each point that goes by another's name.

        A pitch point wanders on its links: it is where another one is in this pose alone.
        """
        names: dict[str, str] = {}
        for points in links.values():
            first: dict[str, str] = {}
            for point in (p for p in points if p not in self.wandering):
                _unite(names, first.setdefault(self.spot(point), point), point)
        return {point: _root_name(names, point) for point in names}

    def name(self, point: str) -> str:
        """The name under which a point is known here."""
        return self.names.get(point, point)

    def spot(self, point: str) -> str:
        """The first of all points that lie where this one does in this pose; an auxiliary point is its own."""
        return self._spots.get(point, point)

    def coincide(self, one: str, other: str) -> bool:
        """Whether two points lie in one spot; what is drawn by that holds in no pose in which they lie apart."""
        if self.spot(one) != self.spot(other):
            return False
        if self.name(one) != self.name(other):
            self.relied[one, other] = None
        return True

    @property
    def shared_marks(self) -> dict[str, str]:
        """The points that another's mark serves, each with that point: they lie in one place."""
        pairs = dict(self.names)
        for (at, _), name in self.coincident.items():
            _unite(pairs, at, name)
        return {point: _root_name(pairs, point) for point in pairs}

    def _coincident_points(self) -> dict[tuple[str, str], str]:
        """Points of a guide's link that mark the place under a sliding point: A3 on link 3 under A, under A2 on 2, or
        under A1 of a block that is pinned on 1.

        The names say so. What lies there by chance in this pose is a point of its own.
        """
        found = {}
        for slide in (slide for slide in self.all_slides if slide.at not in self.wandering):
            at = self.name(slide.at)
            marks = {f"{slide.at}{slide.along}", self.coincident_name(slide.at, slide.along)}
            for name in self.links[slide.along]:
                if name in marks and name != at and self.spot(name) == self.spot(at):
                    found[at, slide.along] = name
        return found

    def coincident_name(self, point: str, link: str) -> str:
        """The name of the point of a link under one that is called after its own link: A3 under A1; empty of others."""
        letters = (point.removesuffix(own) for own in self.links_of.get(self.name(point), ()) if point.endswith(own))
        return next((f"{letter}{link}" for letter in letters if letter.isalpha()), "")

    def _weld(self, drive: Drive) -> None:
        """Join the two links of a drive into one body, if they share the pair that it drives."""
        link, other = drive.links
        if drive.slides:
            self._join(link, other, drive, "", self.scene.driven_slide(drive))
            return
        common = [p for p in self.links[link] if p in self.links.get(other, ())]
        if common:
            self._join(link, other, drive, common[0], None)
        else:
            self.turning.append(drive)

    def _join(self, link: str, to: str, drive: Drive, at: str, slide: Slide | None) -> None:
        """Hang the body of one link under the other's; the frame's body stays on top."""
        sign = 1
        if self.body[link] == self.body.get(FRAME):
            link, to, sign = to, link, -1
        top, under = self.body[to], self.body[link]
        if top == under:
            return
        self._rehang(link)
        self.welds[link] = DrivenPair(link, to, drive, sign, at, slide)
        for member in self.members.pop(under):
            self.body[member] = top
            self.members[top].append(member)

    def _rehang(self, link: str) -> None:
        """Turn the welds above `link` about, so that it becomes the top of its body."""
        chain = []
        while link in self.welds:
            chain.append(self.welds.pop(link))
            link = chain[-1].to
        for weld in chain:
            self.welds[weld.to] = DrivenPair(weld.to, weld.link, weld.drive, -weld.sign, weld.at, weld.slide)

    def _turning_classes(self) -> dict[str, str]:
        """Bodies that turn alike, or by a known difference: joined by slides, or by a drive without a common pair."""
        top: dict[str, str] = {}
        alike = (s.links for s in self.order.slides() if s.turns_alike)
        for one, two in [*alike, *(drive.links for drive in self.turning)]:
            _unite(top, *sorted((_root_name(top, self.body[link]) for link in (one, two)), key=self.order.link))
        return {body: _root_name(top, body) for body in self.members}

    @cached_property
    def turning_alike(self) -> dict[str, list[str]]:
        """The bodies of each such class."""
        bodies = dict[str, list[str]]()
        for body, one in self.classes.items():
            bodies.setdefault(one, []).append(body)
        return bodies

    def told_by(self, source: str) -> list[str]:
        """The links of the slide or body that is the source of a fact."""
        slide = next((slide for slide in self.slides if slide.name == source), None)
        return [*slide.links] if slide else self.members.get(source, [])

    def given_links(self, links: Iterable[str]) -> tuple[str, ...]:
        """The moving links of the scene among these: for a bar, the links that touch there."""
        given = (one for link in links for one in (self.bars[link].links if link in self.bars else (link,)))
        return tuple(dict.fromkeys(link for link in given if link != FRAME))

    def never_turns(self, link: str) -> bool:
        """Whether a link is known never to turn: it slides on the frame, or on what slides there."""
        body = self.body[link]
        if not self.ground or self.classes[body] != self.classes[self.ground] or link in self.welds:
            return False
        return not self.excess(body, self.ground).omega

    def turns(self, slide: Slide) -> bool:
        """Whether the guide of a slide turns, so that what slides on it has a Coriolis acceleration."""
        return bool(slide.guiding) and not any(link == FRAME or self.never_turns(link) for link in slide.guiding)

    def place(self, point: str, link: str) -> BodyPoint:
        """The place of a point in a link's plane."""
        point = self.name(point)
        point = self.coincident.get((point, link), point)
        return (point, "") if point in self.links[link] else (point, link)

    def bodies_at(self, place: BodyPoint) -> list[str]:
        """The bodies that meet in a place."""
        point, link = place
        links = (link,) if link else self.links_of[point]
        return list(dict.fromkeys(self.body[name] for name in links))

    def link_at(self, body: str, place: BodyPoint) -> str:
        """The link of a body to which a place belongs."""
        point, link = place
        return link or next(m for m in self.members[body] if point in self.links[m])

    def has(self, link: str, place: BodyPoint) -> bool:
        """Whether a place belongs to a link."""
        return place[1] == link or (not place[1] and place[0] in self.links[link])

    def common_link(self, body: str, *places: BodyPoint) -> str:
        """The link of a body to which all these points of the scene belong; empty if there is no such link."""
        links = (link for link in self.members.get(body, ()) if all(self.has(link, place) for place in places))
        return next(links, "") if all(point in self.scene.points for point, _ in places) else ""

    @cached_property
    def repeating(self) -> frozenset[tuple[str, BodyPoint]]:
        """The places whose facts from a body are not new: its pair there is redundant, or the body passive."""
        lost = {(c.link, c.on) for c in self.scene.redundant if c.way in ("x", "y")}
        idle = {(link, p) for link in self.passive for p in self.links[link] if len(self.scene.links_of[p]) > 1}
        return frozenset((self.body[link], (point, "")) for link, point in lost | idle)

    @cached_property
    def silent_slides(self) -> frozenset[str]:
        """The slides whose condition on their links' places is redundant."""
        return frozenset(c.pair for c in self.scene.redundant if c.way == "across")

    @cached_property
    def passive(self) -> frozenset[str]:
        """The links that pass no fact on: their pairs and drives, without redundant ones, only determine their own
        motion."""
        redundant = [(c.link,) if c.way in ("x", "y") else (c.link, c.on) for c in self.scene.redundant]

        def count_statements(link: str) -> int:
            joints = sum(len(self.scene.links_of[p]) > 1 or p in self.scene.motions for p in self.links[link])
            others = sum(pair.binds for pair in self.scene.written if link in pair.links)
            return 2 * joints + others - sum(link in pair for pair in redundant)

        touched = {link for pair in redundant for link in pair} - {FRAME}
        return frozenset(link for link in touched if count_statements(link) <= 3)

    def places_of(self, body: str) -> list[BodyPoint]:
        """The places of the body's own points, joints first."""
        names = dict.fromkeys(p for m in self.members[body] for p in self.links[m])
        return sorted(((p, "") for p in names), key=lambda place: len(self.bodies_at(place)) < 2)

    def chain(self, link: str) -> list[DrivenPair]:
        """The welds from a link up to the top of its body."""
        welds = []
        while link in self.welds:
            welds.append(self.welds[link])
            link = welds[-1].to
        return welds

    def excess(self, body: str, like: str) -> AngularRates:
        """By how much the turning of one body's top link exceeds another's, as the drives prescribe."""
        return self.turnings.links_turning_with(body)[like]


def _root_name(names: dict[str, str], name: str) -> str:
    """The name under which all that go by it are known."""
    while name in names:
        name = names[name]
    return name


def _unite(names: dict[str, str], one: str, two: str) -> None:
    """Know two, and all that go by their names, under the name of the first."""
    one, two = _root_name(names, one), _root_name(names, two)
    if one != two:
        names[two] = one
