"""The picture of a mechanism: its links, pairs and ground, from the scene and a window."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cached_property

from graphplan.mechanism.model import FRAME, Contact, Drive, Gear, Scene, Slide
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import TextRun, sentence_runs, width
from graphplan.sheet.plates import pens, symbols
from graphplan.sheet.plates.display import Item, Spot
from graphplan.sheet.plates.symbols import LONG, NEAR, Vector, distinct_spots, offset, turn, unit_vector
from graphplan.sheet.plates.view import View, interpolate
from graphplan.sheet.tolerances import LEAN_TOL

RAIL = LONG + 3.0  # mm that a rail goes on to both sides of the middle of its block
CROWDED_COS = 0.6  # the cosine of the angle to a line within which a ground symbol is crowded
MAX_RINGED_EMS = 1.4  # the width of a link's name in a circle, beside the size of its letters: longer ones have none
DOWN, LEFT, RIGHT, UP = (0.0, -1.0), (-1.0, 0.0), (1.0, 0.0), (0.0, 1.0)


@dataclass(frozen=True)
class Figure:
    """Items that move as one: with a `link`, turning with the guide of a `slide`, or upright.

    Each of its spots goes with that of the points `at` which is nearest to it.
    """

    items: tuple[Item, ...]
    at: tuple[str, ...]
    link: str = ""
    slide: Slide | None = None


@dataclass(frozen=True)
class FixedGuide:
    """The fixed guide of a block that stands at the point `seat`, or its ground: hatched on one side."""

    slide: Slide
    seat: str
    side: float
    items: tuple[Item, ...]


@dataclass(frozen=True)
class Rail:
    """The part of a moving link that guides the block at the point `seat`, tied to the link's point `end`."""

    slide: Slide
    seat: str
    end: str
    items: tuple[Item, ...]


@dataclass(frozen=True)
class DrawnMechanism:
    """A mechanism seen through a window, or some `links` and further `points` of it alone."""

    scene: Scene
    view: View
    links: Collection[str] | None = None
    points: Collection[str] = ()

    @cached_property
    def spots(self) -> dict[str, Spot]:
        return {name: self.view((float(x), float(y))) for name, (x, y) in self.scene.points.items()}

    @property
    def visible_points(self) -> dict[str, Spot]:
        """The points that are shown."""
        if self.links is None:
            return self.spots
        names = {name for link in self.links for name in self.scene.links[link]}.union(self.points)
        return {name: spot for name, spot in self.spots.items() if name in names}

    @property
    def _moving(self) -> list[str]:
        """The moving links that are shown."""
        return [link for link in self.scene.moving if self.links is None or link in self.links]

    @property
    def _shown_links(self) -> frozenset[str]:
        """The links that are shown, and the frame."""
        return frozenset((*self._moving, FRAME))

    @property
    def _slides(self) -> list[Slide]:
        """The sliding pairs that are shown."""
        return [slide for slide in self.scene.slides if not {slide.link, slide.along}.isdisjoint(self._moving)]

    def items(self) -> Iterator[Item]:
        """Everything, from the ground up."""
        for figure in self.figures():
            yield from figure.items
        yield from self._pairs()

    def figures(self) -> Iterator[Figure | FixedGuide | Rail]:
        """The figures of all but the turning pairs, each with the link or points that it moves with."""
        for name in self._pivots:
            yield Figure(tuple(symbols.pivot(self.spots[name], self._ground(name))), (name,))
        for slide in self._slides:
            if FRAME in (slide.along, slide.link):
                yield self._guide(slide)
        yield from self._wheels()
        for link in self._moving:
            yield from self._link(link)
        for contact in self.scene.contacts:
            yield from self._profiles(contact)
        for slide in self._slides:
            block = symbols.PAIRS[slide.symbol](self.seat(slide), self.direction(slide))
            yield Figure((block,), (self._seat(slide),), slide=slide)
        for drive in self.scene.drives:
            if not drive.slides and drive.rate and drive.link in self._moving:
                yield Figure(tuple(self.drive_symbol(drive)), self.scene.links[drive.link], drive.link)

    @property
    def pairs(self) -> list[str]:
        """The points with a circle: joints and driven points."""
        return [name for name in (*self.scene.joints, *self.scene.motions) if name in self.visible_points]

    def _pairs(self) -> Iterator[Item]:
        """A circle for each joint and each driven point; a dot for a point that only traces."""
        pairs = [self.visible_points[name] for name in self.pairs]
        for spot in distinct_spots([*pairs, *self.visible_points.values()]):
            yield symbols.revolute(spot) if spot in pairs else symbols.tracer(spot)

    # ---- ground ----------------------------------------------------------------------------------------------------

    @property
    def _pivots(self) -> list[str]:
        """The turning pairs with the frame."""
        return [name for name in self.scene.joints if name in self.visible_points
                and FRAME in self.scene.links_of[name]]

    def neighbours(self, name: str) -> list[Spot]:
        """The other ends of the moving links at a point."""
        links = [link for link in self.scene.links_of[name] if link != FRAME]
        own_spot = self.spots[name]
        spots = [self.spots[p] for link in links for p in self.scene.links[link]]
        return [spot for spot in spots if math.dist(spot, own_spot) > NEAR]

    def _link_ends_around(self, at: Spot) -> list[Spot]:
        """The other ends of the moving links at all the points of a place."""
        return [end for name in self._names_at(at) for end in self.neighbours(name)]

    def _names_at(self, at: Spot) -> list[str]:
        """The points of a place."""
        return [name for name, spot in self.spots.items() if math.dist(spot, at) < NEAR]

    def _is_shared(self, at: Spot) -> bool:
        """Whether several links have points at a place."""
        return len({link for name in self._names_at(at) for link in self.scene.links_of[name]}) > 1

    def _ground(self, name: str) -> Vector:
        """The direction to the ground under a pivot: downwards, unless a link goes there."""
        pivot = self.spots[name]
        directions = [unit_vector(pivot, end) for end in self.neighbours(name)]

        def cost(choice: tuple[int, Vector]) -> float:
            rank, (x, y) = choice
            closest = max((x * u + y * v for u, v in directions), default=-1.0)
            return 0.3 * rank + (2.0 + closest if closest > CROWDED_COS else 0.0)

        return min(enumerate((DOWN, LEFT, RIGHT, UP)), key=cost)[1]

    def _guide(self, slide: Slide) -> FixedGuide:
        """The fixed guide of a slide on the frame, or the ground of a fixed block; hatched away from the mechanism."""
        at, along = self.seat(slide), self.direction(slide)
        side = self._free_guide_side(slide, at, along)
        return FixedGuide(slide, self._seat(slide), side, tuple(symbols.guideway(at, along, side)))

    def _free_guide_side(self, slide: Slide, at: Spot, along: Vector) -> float:
        """The side of a guide that the mechanism leaves free."""
        lean = sum(turn(at, offset(at, along, 1.0), end) for end in self._link_ends_around(at))
        if abs(lean) > LEAN_TOL:
            return -1.0 if lean > 0 else 1.0
        return -1.0 if along[0] > 0 or (along[0] == 0 and along[1] < 0) else 1.0

    # ---- higher pairs ----------------------------------------------------------------------------------------------

    def _wheels(self) -> Iterator[Figure]:
        """The pitch circles, each once, the pitch lines of racks, and belts."""
        for (link, centre, radius), gears in symbols.wheels(self.scene).items():
            if link in self._shown_links:
                middle, r = self.spots[centre], radius * self.view.scale
                yield Figure(symbols.circle(pens.WHEEL, middle, r), (centre,), "" if link == FRAME else link)
                fringes = (self._fringe(self.scene.gears[i], middle, r) for i in gears if link == FRAME)
                yield from (Figure(tuple(items), (centre,)) for items in fringes)
        for gear in self.scene.gears:
            if not self._shown_links.isdisjoint(gear.links):
                yield from self._rack_or_belt(gear)

    def _fringe(self, gear: Gear, middle: Spot, radius: float) -> Iterator[Item]:
        """The hatching of a wheel that is fixed to the frame, beside its pitch point; outside of a ring."""
        pole = gear.pitch_point(self.scene.points)
        if pole is None or gear.belt:
            return iter(())
        outwards = 1.0 if gear.internal and gear.links[1] == FRAME else -1.0
        return symbols.fringe(middle, radius, self.view((float(pole[0]), float(pole[1]))), outwards)

    def _rack_or_belt(self, gear: Gear) -> Iterator[Figure]:
        points = self.scene.points
        if gear.direction is not None:
            x, y = gear.pitch_point(points)
            at, link = self.view((float(x), float(y))), gear.links[1]
            items = symbols.rack(at, self.direction(gear), self._nearest_point(link, at))
            yield Figure(tuple(items), self.scene.links[link] or gear.centres, "" if link == FRAME else link)
        elif gear.belt and (radii := gear.pitch_radii(points)):
            first, second = (self.spots[centre] for centre in gear.centres)
            r, s = (radius * self.view.scale for radius in radii)
            yield Figure(tuple(symbols.belt(first, r, second, s, gear.belt == "crossed")), gear.centres)

    def _profiles(self, contact: Contact) -> Iterator[Figure]:
        """Yield both profiles of a contact, each with its link."""
        at, along = self.spots[contact.at], self.direction(contact)
        for link, centre in zip(contact.links, contact.centres, strict=True):
            if link not in self._shown_links:
                continue
            names, rides, seat = self.scene.links[link], "" if link == FRAME else link, self._nearest_point(link, at)
            if centre:
                disc = bool(symbols.disc(self.scene, contact, centre))
                items = symbols.profile(at, self.spots[centre], disc and centre in self.scene.joints, disc)
                yield Figure(tuple(items), (centre,), rides)
            elif seat is not None:
                yield Figure(tuple(symbols.face(at, along, seat)), names, rides)
            else:
                side = -1.0 if turn(at, offset(at, along, 1.0), self.spots[contact.curved_side[2]]) > 0 else 1.0
                yield Figure(tuple(symbols.rail(at, along, side)), names or (contact.at,))
        if contact.beyond:
            yield from self._following_arcs(contact.beyond, set(contact.centres))

    def _following_arcs(self, contact: Contact, known: set[str | None]) -> Iterator[Figure]:
        """The thin circle of an arc that follows where two arcs of a profile meet."""
        for link, centre in zip(contact.links, contact.centres, strict=True):
            if centre and centre not in known and link in self._shown_links:
                radius = symbols.disc(self.scene, contact, centre) * self.view.scale
                items = symbols.circle(pens.PRODUCED, self.spots[centre], radius) if radius else ()
                yield Figure(tuple(items), (centre,), "" if link == FRAME else link)

    def _nearest_point(self, link: str, at: Spot) -> Spot | None:
        """The place of a link's point that is nearest to a spot; None for the frame's."""
        spots = [] if link == FRAME else self._distinct(link)
        return min(spots, key=lambda spot: (math.dist(spot, at), spot), default=None)

    # ---- links -----------------------------------------------------------------------------------------------------

    def direction(self, pair: Slide | Gear | Contact) -> Vector:
        """The direction of a slide's guide, of a rack's pitch line or of a straight profile."""
        x, y = (float(component) for component in pair.direction or (1, 0))
        return unit_vector((0.0, 0.0), (x, y))

    def seat(self, slide: Slide) -> Spot:
        """The spot of the block."""
        return self.spots[self._seat(slide)]

    def _seat(self, slide: Slide) -> str:
        """The point where the block is: the pair's, or where the guiding link is itself the block."""
        at = self.spots[slide.at]
        guide = self._distinct(slide.along) if slide.along != FRAME else []
        rod = len(self._distinct(slide.link)) > 1 or slide.link == FRAME
        if rod and len(guide) == 1 and abs(turn(at, offset(at, self.direction(slide), 1.0), guide[0])) < NEAR:
            return self.scene.links[slide.along][0]
        return slide.at

    def _distinct(self, link: str) -> list[Spot]:
        """The places of a link's points, coincident ones once."""
        return distinct_spots(self.spots[name] for name in self.scene.links[link])

    def middle(self, link: str) -> Spot:
        """The middle of a link's points."""
        spots = self._distinct(link)
        return sum(x for x, _ in spots) / len(spots), sum(y for _, y in spots) / len(spots)

    def _link(self, link: str) -> Iterator[Figure | Rail]:
        spots, names = self._distinct(link), self.scene.links[link]
        for slide in self.scene.slides:
            seated = self.seat(slide) == self.spots[slide.at]
            guides = slide.along == link and (len(spots) > 1 or seated)
            if guides or (slide.link == link and not seated):
                yield from self._rail(slide, names)
        if len(spots) < 2:
            return
        if not symbols.are_collinear(spots):
            yield Figure(tuple(symbols.plate(spots)), names, link)
            return
        along = unit_vector(spots[0], max(spots, key=lambda s: (math.dist(s, spots[0]), s)))
        spots.sort(key=lambda s: s[0] * along[0] + s[1] * along[1])
        inner = filter(self._is_shared, spots[1:-1])
        elbows = (symbols.elbow(spot, along, self._free_side(spot, along)) for spot in inner)
        yield Figure((*symbols.bar(spots), *elbows), names, link)

    def _rail(self, slide: Slide, names: tuple[str, ...]) -> Iterator[Rail]:
        """The part of a moving link that guides: through the block and a little beyond, tied to the link's points."""
        seat, along = self.seat(slide), self.direction(slide)
        reach = [offset(seat, along, -RAIL), offset(seat, along, RAIL)]
        if not names:
            return
        end = min(names, key=lambda name: (math.dist(self.spots[name], seat), self.spots[name]))
        nearest = self.spots[end]
        t = (nearest[0] - seat[0]) * along[0] + (nearest[1] - seat[1]) * along[1]
        foot = offset(seat, along, t)
        line = sorted([*reach, foot], key=lambda s: s[0] * along[0] + s[1] * along[1])
        tie = symbols.bar((foot, nearest)) if math.dist(foot, nearest) > NEAR else ()
        yield Rail(slide, self._seat(slide), end, (*symbols.bar((line[0], line[-1])), *tie))

    def _free_side(self, inner: Spot, along: Vector) -> float:
        """The side of a bar that the other links at an inner joint leave free."""
        ahead = offset(inner, along, 1.0)
        lean = sum(turn(inner, ahead, end) / math.dist(inner, end) for end in self._link_ends_around(inner))
        return -1.0 if lean > 0 else 1.0

    def drive_symbol(self, drive: Drive) -> Iterator[Item]:
        """The sense of turning, about the pair of the driving link."""
        pairs = [p for p in self.scene.links[drive.link] if p in self.scene.links.get(drive.on, ())]
        ends = [p for p in self.scene.links[drive.link] if p not in pairs]
        if pairs and ends:
            pivot = self.spots[pairs[0]]
            ground = self._ground(pairs[0]) if pairs[0] in self._pivots else None
            sign = 1.0 if drive.rate > 0 else -1.0
            yield from symbols.drive(pivot, unit_vector(pivot, self.spots[ends[0]]), sign, ground)

    # ---- letters ---------------------------------------------------------------------------------------------------

    def wishes(self) -> Iterator[Wish]:
        """The numbers of the links, beside their middles."""
        for link in self._moving:
            spots = self._distinct(link)
            runs = sentence_runs(link)
            number = Wish(runs, (), minor=True, label=f"link {link}", balloon=width(runs, 1.0) <= MAX_RINGED_EMS)
            if len(spots) == 1:
                yield number._replace(spots=(spots[0],), clear=LONG)
            elif symbols.are_collinear(spots):
                ends = max(((p, q) for p in spots for q in spots), key=lambda pair: math.dist(*pair))
                middles = tuple(interpolate(*ends, t) for t in (0.5, 0.4, 0.6, 0.3, 0.7))
                yield number._replace(spots=middles, clear=0.8, free=True)
            else:
                centre = self.middle(link)
                inside = [interpolate(centre, spot, t) for t in (0.0, 0.25, 0.45) for spot in spots]
                yield number._replace(spots=tuple(dict.fromkeys(inside)), clear=-2.0, free=True)

    def letters(self) -> dict[Spot, tuple[tuple[TextRun, ...], str]]:
        """Letters at each joint: one name, or all the names of coincident points."""
        names_at: dict[Spot, list[str]] = {}
        for name, spot in self.visible_points.items():
            key = next((known for known in names_at if math.dist(known, spot) < NEAR), spot)
            names_at.setdefault(key, []).append(name)
        runs = {spot: sentence_runs(" ≡ ".join(names), tuple(names)) for spot, names in names_at.items()}
        return {spot: (runs[spot], ",".join(names)) for spot, names in names_at.items()}
