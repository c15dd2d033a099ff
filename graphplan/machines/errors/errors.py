"""Position errors by transformed mechanisms: for each dimension a pair in its place, whose motion is the error.

The drives are held. Instead of one dimension stands a pair that changes it: a slide along a distance or across a
guide, a hinge at the vertex of an angle. What this mechanism moves with a unit of velocity is the coefficient of the
partial error: small displacements go in the directions of velocities, and are drawn as these.

Source: Ozols 1974, 18-3, (18.1), figs. 18-4 and 18-5.

The construction is compared with the analytic solver, as every other; and the coefficient with differences of the
closure: the same mechanism followed a little to both sides, which knows nothing of velocities.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from graphplan.check.report import Report
from graphplan.check.tolerances import DIFFERENCE_STEPS, DIFFERENCE_TOL
from graphplan.check.trusted import report
from graphplan.cycle.loads import guide_direction, slide_position
from graphplan.cycle.turn import follow
from graphplan.errors import Disagreement, Refused
from graphplan.mechanism.model import FRAME, Contact, Find, Gear, NamedDimension, Scene, Slide, dimension
from graphplan.mechanism.numbers import Pair, dot, minus, quarter_turn
from graphplan.mechanism.pairs.drives import Drive, SlidingDrive, TurningDrive
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.methods import kinds

DEGREE = math.pi / 180
ONE, NONE = Fraction(1), Fraction(0)
Transformed = tuple[dict[str, tuple[str, ...]], list[KinematicPair], Drive]  # links, pairs, what changes the dimension


@dataclass(frozen=True)
class DrivenPosition:
    """A position with an error: of a slide along its guide, or the angle of a link."""

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
    """The dimensions with tolerances, in the scene's order; fails with `Refused` if there is no tolerance. Fails with
    `Refused` where there are none."""
    every = [dimension(name, scene.links, scene.written) for name in scene.tolerances]
    if not every:
        raise Refused(scene.name, "no dimension has a tolerance", 'a table [tolerances] with dimensions, such as '
                      '"O A" = 0.05')
    if not scene.drives:
        raise Refused(scene.name, "without a drive no position is held", "a scene with a [[drive]]")
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


@dataclass(frozen=True)
class PartialError:
    """Effect of one dimension's error: the coefficient of each position by its name, in the position's unit (rad of an
    angle) for one of the dimension's (degrees of an angle), and the construction that it was read off."""

    dimension: NamedDimension
    tolerance: float
    coefficients: Mapping[str, float]
    report: Report

    def error(self, position: str) -> float:
        """The error of a position, without a sign."""
        return abs(self.coefficients[position]) * self.tolerance


@dataclass(frozen=True)
class PositionErrors:
    """The errors of some positions of a scene's mechanism, partial error by partial error; `differences` says how far
    off the differences of the closure are, beside the largest coefficient; None where the pose cannot be left."""

    scene: Scene
    positions: tuple[DrivenPosition, ...]
    parts: tuple[PartialError, ...]
    differences: float | None

    def largest(self, position: str) -> float:
        """The error where all partial errors add up."""
        return sum(part.error(position) for part in self.parts)

    def probable(self, position: str) -> float:
        """The probable error: the root of the sum of the squares."""
        return math.hypot(*(part.error(position) for part in self.parts))

    @property
    def data(self) -> dict[str, Any]:
        """The JSON of `graphplan errors`."""
        units = self.scene.units
        errors = {position.name: {
            "parts": {part.dimension.name: {"coefficient": part.coefficients[position.name],
                                            "error": part.error(position.name)} for part in self.parts},
            "sum": self.largest(position.name), "probable": self.probable(position.name),
        } for position in self.positions}
        constructed = max(float(value) for part in self.parts for value in part.report.check.values())
        return {"title": self.scene.title, "units": {"length": units.length}, "errors": errors,
                "check": {"construction": constructed, "differences": self.differences}}


def position_errors(scene: Scene) -> PositionErrors:
    """The errors of the positions that a scene asks for, its dimensions being off by their tolerances.

    Fails with `Refused` where nothing has a tolerance, with `SingularPose` where a dimension can move the mechanism no
    way, and with `Disagreement` where the differences of the closure tell another coefficient.
    """
    positions, gaps, parts = asked_positions(scene), list[float](), list[PartialError]()
    for named in dimensions(scene):
        moved = transform_mechanism(scene, named, positions)
        result = report(moved)
        coefficients = {position.name: _coefficient(moved, position, result) for position in positions}
        parts.append(PartialError(named, float(scene.tolerances[named.name]), coefficients, result))
        for position in positions:
            gap = _gap(scene, moved, position, parts[-1])
            gaps += [] if gap is None else [gap]
    return PositionErrors(scene, tuple(positions), tuple(parts), max(gaps, default=None))


def _coefficient(moved: Scene, position: DrivenPosition, result: Report) -> float:
    """The velocity of a position in a transformed mechanism."""
    if position.slide is None:
        return float(result.results[kinds.OMEGA][position.link])
    slide = _slide_of(moved, position.slide)
    kind, name = ((kinds.VELOCITY, slide.at) if position.slide.along == FRAME else
                  (kinds.SLIDE_VELOCITY, slide.name))
    velocity, (dx, dy) = result.results[kind][name], map(float, slide.direction)
    return (float(velocity[0]) * dx + float(velocity[1]) * dy) / math.hypot(dx, dy)


def _unit_size(scene: Scene, position: DrivenPosition, dimension: NamedDimension) -> float:
    """The size of a coefficient where the mechanism moves as much as its dimension does at its reach."""
    by = scene.extent * DEGREE if dimension.is_angle else 1.0
    return by if position.slide else by / scene.extent


def _slide_of(moved: Scene, slide: Slide) -> Slide:
    """A slide of the scene, as the transformed mechanism has it."""
    return next(s for s in moved.slides if (s.link, s.at) == (slide.link, slide.at))


def _gap(scene: Scene, moved: Scene, position: DrivenPosition, part: PartialError) -> float | None:
    """Relative difference of a coefficient and the differences of the closure, at the first step at which they agree;
    None if the pose is a limit position."""
    drawn, gap, value = part.coefficients[position.name], None, 0.0
    size = max(abs(drawn), _unit_size(scene, position, part.dimension))
    for share in DIFFERENCE_STEPS:
        slope = _difference(moved, position, share)
        if slope is not None:
            gap, value = abs(slope - drawn) / size, slope
            if gap <= DIFFERENCE_TOL:
                return gap
    if gap is not None:
        raise Disagreement(scene.name, f"partial error of {position.name} by {part.dimension.name}",
                           f"{drawn:.10g}", f"{value:.10g}", gap)
    return None


def _difference(moved: Scene, position: DrivenPosition, share: float) -> float | None:
    """A coefficient by central differences, to the fourth order; None where the poses beside it are not reached."""
    first = moved.drives[0]
    step = share * (moved.extent if first.slides else math.degrees(1.0))
    turn = follow(moved, 5, (-2 * step, 2 * step))
    if turn.faults or turn.motion is None:
        return None
    values = _values(moved, position, turn, turn.motion.links_at(turn.travel))
    per_step = share * (moved.extent if first.slides else 1.0) / abs(float(first.rate))
    return _slope(values) / per_step


def _values(moved: Scene, position: DrivenPosition, turn: Any, links: Mapping[str, Any]) -> Any:
    """A position in the poses of a turn."""
    if position.slide is None:
        return np.unwrap(np.angle(links[position.link].turn))
    slide = _slide_of(moved, position.slide)
    return slide_position(moved, slide, turn.points, guide_direction(slide, turn.points, turn.guides))


def _slope(five: Any) -> float:
    """The change for a step in the middle of five values."""
    return float((five[0] - 8 * five[1] + 8 * five[3] - five[4]) / 12)
