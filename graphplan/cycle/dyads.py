"""The compass rules: whether and where each of the five dyads can be assembled on links that are placed already.

The outer joints are called A and C, the inner one B; any of them may be a slide instead. On which side of a line a
point lies, or which way along it, is read once from the given pose: it stays so on the whole path, since it can only
change at a limit.

Where all groups are such, the poses on the path are assembled so; of those that it does not reach this says what
prevents them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from graphplan.cycle.closure import LinkPose
from graphplan.cycle.groups import ClosureGroup
from graphplan.cycle.linkage import Array, Linkage, unit_direction
from graphplan.kernel.tolerances import ROUNDOFF_TOL
from graphplan.mechanism.model import FRAME, Contact, Gear, Slide


class Failure(NamedTuple):
    """A part that could not be placed, and why."""

    links: tuple[str, ...]
    why: str


class PlacedLink(NamedTuple):
    """A link in n poses: its turn, and where one point is, which was given at `origin`; complex arrays."""

    origin: complex
    base: Array
    turn: Array

    def point(self, place: complex) -> Array:
        """Present place of the point that was given at `place`."""
        return self.base + self.turn * (place - self.origin)

    def ray(self, along: complex) -> Array:
        """Present direction of a ray that was given along `along`."""
        return self.turn * along

    def shifted_to(self, origin: complex, base: Array) -> PlacedLink:
        """Another link that turns as this one does, and has this point."""
        return PlacedLink(origin, base, self.turn)


class DyadPair(NamedTuple):
    """One pair of a dyad: its letter, name and given place; a slide with its direction.

    `at` is where it is on the link placed before, `on`; an inner pair is on none.
    """

    letter: str
    name: str
    place: complex
    along: complex
    on: PlacedLink
    carrier: str

    @property
    def carrier_point(self) -> Array:
        """The pair's point on the link that was placed before."""
        return self.on.point(self.place)

    @property
    def ray(self) -> Array:
        """Direction of the guide."""
        return self.on.ray(self.along)


def assemble(linkage: Linkage, groups: Sequence[ClosureGroup],
             travel: Array) -> tuple[dict[str, PlacedLink], list[tuple[Failure, Array]]]:
    """The links that can be placed at n travels without the path; and each dyad with the mask of poses that prevent it.
    """
    links_placed = {FRAME: PlacedLink(linkage.origins[FRAME], np.full(travel.shape, linkage.origins[FRAME]),
                                      np.ones(travel.shape, dtype=complex))}
    prevented = []
    with np.errstate(all="ignore"):
        for group in groups:
            if linkage.is_special(group.part) or not {*group.carriers} <= links_placed.keys():
                continue
            if not group.unknowns:
                links_placed.update(_place_driven(linkage, group, travel, links_placed))
            elif found_dyad := assemble_dyad(linkage, group, links_placed):
                links, why = found_dyad
                before = sum(links_placed[link].base for link in (FRAME, *group.carriers))
                missing = ~np.isfinite(sum(link.base + link.turn for link in links)) & np.isfinite(before)
                prevented.append((Failure(group.part, why), missing))
                links_placed.update(zip(group.part, links, strict=True))
    return links_placed, prevented


def _place_driven(linkage: Linkage, group: ClosureGroup, travel: Array,
                  placed: Mapping[str, PlacedLink]) -> Iterator[tuple[str, PlacedLink]]:
    """The links of a group that has no unknowns."""
    frame = linkage.origins[FRAME]
    carriers = [closure_pose(linkage, link, placed[link]) for link in (FRAME, *group.carriers)]
    for link, body in zip(group.links, group.link_poses(carriers, travel, ()), strict=True):
        (x, y), (cos, sin) = body.base, body.turn or (1.0, 0.0)
        yield link, PlacedLink(linkage.origins[link], frame + linkage.reach * (x + 1j * y), cos + 1j * sin)


def closure_pose(linkage: Linkage, link: str, placed: PlacedLink) -> LinkPose:
    """A placed link as closures read it: its base from that of the frame, in reaches, and its turn."""
    base = (placed.point(linkage.origins[link]) - linkage.origins[FRAME]) / linkage.reach
    return LinkPose((base.real, base.imag), (placed.turn.real, placed.turn.imag))


def assemble_dyad(linkage: Linkage, group: ClosureGroup,
                  placed: Mapping[str, PlacedLink]) -> tuple[tuple[PlacedLink, PlacedLink], str] | None:
    """Place both links of a plain dyad, and give the reason why they may be unreachable; None for any other group.

    The places and turns of links are arrays, or any numbers that compute as complex ones.
    """
    links, before = group.part, (FRAME, *group.carriers)
    pairs = (pair for link in links for pair in linkage.pairs(link, (*before, *links)))
    if len(links) != 2 or any(isinstance(pair, Gear | Contact) for pair in pairs):
        return None
    outer = [_dyad_pairs(linkage, link, before, placed) for link in links]
    inner = [hinge for hinge in _dyad_pairs(linkage, links[0], links[1:], placed)
             if (hinge.letter, hinge.name) not in {(hinge.letter, hinge.name) for hinge in outer[0]}]
    if [len(hinges) for hinges in (*outer, inner)] != [1, 1, 1]:
        return None
    (start,), (end,), (middle,) = *outer, inner
    swapped = start.letter + end.letter == "PR"
    rule = COMPASS_RULES.get(start.letter + middle.letter + end.letter if not swapped else "R" + middle.letter + "P")
    if rule is None:
        return None
    first, second, why = rule(end, middle, start) if swapped else rule(start, middle, end)
    return (second, first) if swapped else (first, second), why


def _dyad_pairs(linkage: Linkage, link: str, others: tuple[str, ...],
                placed: Mapping[str, PlacedLink]) -> list[DyadPair]:
    """The pairs of a link with some others."""
    pairs = []
    for pair in linkage.pairs(link, others):
        on = min((carrier for carrier in pair.links if carrier != link), key=linkage.order.__getitem__)
        along = unit_direction(pair) if isinstance(pair, Slide) else 0j
        pairs.append(DyadPair(pair.letter, pair.at, linkage.places[pair.at], along, placed.get(on, placed[FRAME]), on))
    return pairs


def _rrr(A: DyadPair, B: DyadPair, C: DyadPair) -> tuple[PlacedLink, PlacedLink, str]:
    """B lies on a circle about A and on a circle about C."""
    a, b, c = A.place, B.place, C.place
    side = 1 if ((c - a).conjugate() * (b - a)).imag > 0 else -1
    from_a, from_c = A.carrier_point, C.carrier_point
    AC = from_c - from_a
    span = AC.real**2 + AC.imag**2
    along = (abs(b - a) ** 2 - abs(b - c) ** 2 + span) / (2 * span)
    AB = AC * (along + 1j * side * np.sqrt(abs(b - a) ** 2 / span - along**2))
    at = from_a + AB
    return (PlacedLink(b, at, AB * (1 / (b - a))), PlacedLink(b, at, (at - from_c) * (1 / (b - c))),
            f"the circles about {A.name} and {C.name} do not meet")


def _rrp(A: DyadPair, B: DyadPair, guide: DyadPair) -> tuple[PlacedLink, PlacedLink, str]:
    """B lies on a circle about A, and on a line of the guide's link along the guide."""
    a, b, path = A.place, B.place, guide.on.point(B.place)
    sign = 1 if (guide.along.conjugate() * (b - a)).real > 0 else -1
    from_a, ray = A.carrier_point, guide.ray
    off = (from_a - path) * ray.conj()
    at = path + ray * (off.real + sign * np.sqrt(abs(b - a) ** 2 - off.imag**2))
    return (PlacedLink(b, at, (at - from_a) * (1 / (b - a))), guide.on.shifted_to(b, at),
            f"the circle about {A.name} does not meet the line of {B.name} along link {guide.carrier}")


def _rpr(A: DyadPair, guide: DyadPair, C: DyadPair) -> tuple[PlacedLink, PlacedLink, str]:
    """The guide's line through A passes C at a given distance: its angle with AC has that sine."""
    offset, AC = guide.along.conjugate() * (C.place - A.place), C.carrier_point - A.carrier_point
    along = math.copysign(1, offset.real or -1) * np.sqrt(AC.real**2 + AC.imag**2 - offset.imag**2)
    first = PlacedLink(A.place, A.carrier_point, AC / (along + 1j * offset.imag) / guide.along)
    return first, first.shifted_to(C.place, C.carrier_point), f"the guide through {A.name} passes {C.name} by"


def _prp(one: DyadPair, B: DyadPair, two: DyadPair) -> tuple[PlacedLink, PlacedLink, str]:
    """B lies on a line along either guide."""
    at = _line_crossing(one.on.point(B.place), one.ray, two.on.point(B.place), two.ray)
    return one.on.shifted_to(B.place, at), two.on.shifted_to(B.place, at), "the two guides are parallel"


def _rpp(A: DyadPair, inner: DyadPair, guide: DyadPair) -> tuple[PlacedLink, PlacedLink, str]:
    """All turn alike; the middle link's point that was at A lies on its guide through A, and on one along the outer."""
    at = _line_crossing(A.carrier_point, guide.on.ray(inner.along), guide.on.point(A.place), guide.ray)
    return guide.on.shifted_to(A.place, A.carrier_point), guide.on.shifted_to(A.place,
                                                                              at), "the two guides are parallel"


def _line_crossing(one: Array, ray: Array, other: Array, across: Array) -> Array:
    """Intersection of the lines through two points; nan if they are parallel."""
    sine = (ray.conj() * across).imag
    if isinstance(sine, np.ndarray):
        sine = np.where(np.abs(sine) > ROUNDOFF_TOL, sine, np.nan)
    return one + ray * ((other - one).conj() * across).imag / sine


COMPASS_RULES = {"RRR": _rrr, "RRP": _rrp, "RPR": _rpr, "PRP": _prp, "RPP": _rpp}
