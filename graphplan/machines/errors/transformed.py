"""Errors of position by transformed mechanisms: how far a driven link is off where a dimension is.

The drives are held. In the place of one dimension stands a pair that changes it: a slide along a distance or across a
guide, a hinge at the vertex of an angle. What this mechanism moves with a unit of velocity is the coefficient of the
partial error: small displacements go in the directions of velocities, and are drawn as these.

Source: Ozols 1974, 18-3, (18.1), figs. 18-4 and 18-5.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Contact, Find, Gear, NamedDimension, Scene, Slide, dimension
from graphplan.mechanism.numbers import Pair, dot, minus, quarter_turn
from graphplan.mechanism.pairs.drives import Drive, SlidingDrive, TurningDrive
from graphplan.mechanism.pairs.pair import KinematicPair

DEGREE = math.pi / 180
ONE, NONE = Fraction(1), Fraction(0)
Transformed = tuple[dict[str, tuple[str, ...]], list[KinematicPair], Drive]  # links, pairs, what changes the dimension


@dataclass(frozen=True)
class DrivenPosition:
    """What is off: the position of a slide along its guide, or the angle of a link."""

    name: str
    slide: Slide | None = None
    link: str = ""


def asked_positions(scene: Scene) -> list[DrivenPosition]:
    """The slides and links that [find] asks for, a point of a slide as its slide; else the last link."""
    slides = {slide.name: slide for slide in scene.slides}
    find = Find((), ()) if scene.find.by_default else scene.find
    points = {*find.velocity, *find.acceleration}
    names = dict.fromkeys([*(find.slides or ()), *(slide.name for slide in scene.slides if slide.at in points)])
    positions = [_slide_position(slides[name]) for name in names] + [_link_angle(link) for link in find.links or ()]
    if not positions:
        last = scene.moving[-1]
        sliding = [_slide_position(slide) for slide in scene.slides if slide.link == last]
        positions = sliding[:1] or [_link_angle(last)]
    return positions


def _slide_position(slide: Slide) -> DrivenPosition:
    return DrivenPosition(f"{slide.at} along {slide.along}", slide)


def _link_angle(link: str) -> DrivenPosition:
    return DrivenPosition(f"angle {link}", None, link)


def dimensions(scene: Scene) -> list[NamedDimension]:
    """The dimensions that have tolerances, in the scene's order. Fails with `Refused` where there are none."""
    every = [dimension(name, scene.links, scene.written) for name in scene.tolerances]
    if not every:
        raise Refused(scene.name, "no dimension has a tolerance", 'a table [tolerances] with dimensions, such as '
                      '"O A" = 0.05')
    if not scene.drives:
        raise Refused(scene.name, "nothing is driven, so no position is held", "a scene with a [[drive]]")
    return [dimension for dimension in every if dimension]


def transform_mechanism(scene: Scene, dimension: NamedDimension, positions: list[DrivenPosition]) -> Scene:
    """The mechanism in which the drives are held and one dimension grows by a unit (a degree) a second.

    Asked for are the velocities that tell those of the positions. Fails with `Refused` where
    gears or contacts hold both ends of the dimension.
    """
    links, pairs, mover = _with_offset(scene, dimension) if dimension.slide else _split_link(scene, dimension)
    still_drives = [drive.driven_at(NONE, NONE) for drive in scene.drives]
    slides = {(slide.link, slide.at): slide.name for slide in pairs if isinstance(slide, Slide)}
    guided = [position.slide for position in positions if position.slide]
    find = Find(tuple(slide.at for slide in guided if slide.along == FRAME), (), links=(),
                slides=tuple(slides[slide.link, slide.at] for slide in guided if slide.along != FRAME),
                omega=tuple(position.link for position in positions if position.link))
    points = scene.points | _guide_seat(scene, dimension)
    return replace(scene, title=dimension.name, points=points, links=links, find=find,
                   written=(*pairs, mover, *still_drives), motions={}, loads=None, flywheel=None, run=None, text="",
                   vary={}, assembly=None)


def _with_offset(scene: Scene, dimension: NamedDimension) -> Transformed:
    """A guide on a link of its own, which slides across its direction on the link that had it."""
    slide, guide = dimension.slide, _new_name("guide", scene.links)
    assert slide is not None
    double, = _guide_seat(scene, dimension)
    pairs = [replace(slide, along=guide, through=None) if pair is slide else pair
             for pair in scene.written if not isinstance(pair, Drive)]
    across = Slide(guide, slide.along, double, quarter_turn(slide.direction))
    return {**scene.links, guide: (double,)}, [*pairs, across], SlidingDrive(guide, slide.along, ONE, NONE)


def _guide_seat(scene: Scene, dimension: NamedDimension) -> dict[str, Pair]:
    """The point of a guide under the point that slides on it."""
    if dimension.slide is None:
        return {}
    at = dimension.slide.at
    return {_new_name(at + "0", scene.points): scene.points[at]}


def _split_link(scene: Scene, dimension: NamedDimension) -> Transformed:
    """A link in two parts: the end of the dimension, and all else."""
    link, own = dimension.link, scene.links[dimension.link]
    end, *others = _free_end_first(scene, dimension)
    part, pivot = _new_name(link + "0", scene.links), others[0]
    pairs = [pair for pair in scene.written if not isinstance(pair, Drive)]
    left = tuple(point for point in own if point != end)
    if dimension.is_angle:
        vertex, far = others
        arm, side = (minus(scene.points[P], scene.points[vertex]) for P in (far, end))
        sense = 1 if dot(quarter_turn(arm), side) > 0 else -1
        return {**scene.links, link: left, part: (vertex, end)}, pairs, TurningDrive(part, link, sense * DEGREE, 0.0)
    direction = minus(scene.points[end], scene.points[pivot])
    return ({**scene.links, link: left, part: (end,)}, [*pairs, Slide(part, link, end, direction)],
            SlidingDrive(part, link, ONE, NONE))


def _free_end_first(scene: Scene, dimension: NamedDimension) -> tuple[str, ...]:
    """The points of a dimension: the end that can be parted from its link, the vertex of an angle, the other end."""
    points, bound = dimension.points, {*_bound_points(scene, dimension.link)}
    for order in (points[::-1], points):
        if order[0] not in bound:
            return order
    raise Refused(f"tolerances.{dimension.name}", "slides, gears or contacts of the link bear on both its ends",
                  "a dimension with an end that is a joint alone")


def _bound_points(scene: Scene, link: str) -> Iterator[str]:
    """The points of a link that its slides, gears and contacts are about."""
    for pair in scene.written:
        if isinstance(pair, Slide):
            yield from (pair.at,) if pair.link == link else pair.through or () if pair.along == link else ()
        elif isinstance(pair, Gear | Contact) and link in pair.links:
            yield from (centre for centre in pair.centres if isinstance(centre, str))


def _new_name(name: str, taken: Container[str]) -> str:
    """A name that is not taken yet."""
    while name in taken:
        name += "0"
    return name
