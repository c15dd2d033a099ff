"""The motion of a mechanism on its plan: the paths of points, centrodes, and where its links stand on the way."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphplan.mechanism.model import FRAME, Scene
from graphplan.phrases import Said, said
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Spot
from graphplan.sheet.plates.symbols import are_collinear, distinct_spots, farthest_pair, hull, offset, unit_vector
from graphplan.sheet.tolerances import EXTENT_TOL

View = Callable[[Spot], Spot]
LAYER = "motion"
PATH_TOL_MM = 0.01  # mm by which what is drawn of a path may be off
SAME_WAY_MM = 0.05  # mm: a path that goes back so near to itself is drawn once
STOP_MM, DOT_RADIUS_MM = 1.5, 0.35  # mm: half of the stroke across the end of a path; the radius of the dots on it


@dataclass(frozen=True)
class PointPath:
    """The path of a point, spot by spot in lengths of the scene, and whether the motion stops at its two ends."""

    point: str
    spots: tuple[Spot, ...]
    stops: tuple[bool, bool]

    def chain(self, view: View) -> tuple[Spot, ...]:
        """The path on paper."""
        return simplify_chain([view(spot) for spot in self.spots])


@dataclass(frozen=True)
class Centrode:
    """The fixed or the moving centrode of `links` (such as `2 frame`, the first of which moves on the other), branch by
    branch, spot by spot in lengths of the scene; one that is a mere point is one spot.

    It rides on the link `on`: it has a point of that, and turns as two points do, if any. `given` are their places.
    """

    links: tuple[str, str]
    moving: bool
    branches: tuple[tuple[Spot, ...], ...]
    on: str
    given: tuple[tuple[str, Spot], ...] = ()

    @property
    def words(self) -> Said:
        """Words beside the curve."""
        link, on = self.links
        if str(on) == FRAME:
            return said("moving centrode of {0}", link) if self.moving else said("fixed centrode of {0}", link)
        return (said("moving centrode of {0} on {1}", link, on) if self.moving
                else said("fixed centrode of {0} on {1}", link, on))

    @property
    def pen(self) -> pens.Pen:
        """Pen of the curve."""
        return pens.MOVING_CENTRODE if self.moving else pens.FIXED_CENTRODE

    def items(self, view: View, scene: Scene) -> Iterator[Item]:
        """Yield its branches in the pose of a scene; the moving one has dashes."""
        carried = self._carry(scene)
        for branch in self.branches:
            spots = [view(carried(spot)) for spot in branch]
            if len(spots) > 1:
                yield Polyline(self.pen, LAYER, None, simplify_chain(spots))
            else:
                yield Circle(pens.PATH_DOT, LAYER, None, spots[0], 2 * DOT_RADIUS_MM)

    def _carry(self, scene: Scene) -> Callable[[Spot], Spot]:
        """The motion of its link, as a function of a spot."""
        if not self.given:
            return lambda spot: spot
        was = [complex(*at) for _, at in self.given]
        now = [complex(*map(float, scene.points[name])) for name, _ in self.given]
        turn = (now[-1] - now[-2]) / (was[-1] - was[-2]) if len(was) > 1 else 1.0

        def carry_spot(spot: Spot) -> Spot:
            place = now[0] + turn * (complex(*spot) - was[0])
            return place.real, place.imag

        return carry_spot


class StationaryCurve(Centrode):
    """The points of a link that keep the curvature of their paths in one pose (`moving`), or their centres; empty in
    other poses."""

    @property
    def words(self) -> Said:
        """Words beside the curve."""
        link, _ = self.links
        return said("circling points of {0}", link) if self.moving else said("centre points of {0}", link)

    @property
    def pen(self) -> pens.Pen:
        """Pen of the curve."""
        return pens.CIRCLING_POINTS if self.moving else pens.CENTRE_POINTS

    def items(self, view: View, scene: Scene) -> Iterator[Item]:
        """Yield its branches in its own pose."""
        least = EXTENT_TOL * scene.extent
        if all(math.dist(at, tuple(map(float, scene.points[name]))) <= least for name, at in self.given):
            yield from super().items(view, scene)


@dataclass(frozen=True)
class TracedMotion:
    """Paths of points, centrodes, and positions of the mechanism: the places of all points in each."""

    paths: tuple[PointPath, ...]
    positions: tuple[Mapping[str, Spot], ...]
    centrodes: tuple[Centrode, ...] = ()

    @property
    def path_ends(self) -> tuple[Spot, ...]:
        """The corners of the box of all paths."""
        return _corners([spot for path in self.paths for spot in path.spots])

    @property
    def centrode_ends(self) -> tuple[Spot, ...]:
        """The corners of the box of all centrodes."""
        return _corners([spot for centrode in self.centrodes for branch in centrode.branches for spot in branch])

    @property
    def position_ends(self) -> tuple[Spot, ...]:
        """The corners of the box of all positions."""
        return _corners([spot for position in self.positions for spot in position.values()])

    def faint(self, scene: Scene, view: View) -> Iterator[Polyline]:
        """The links in all positions."""
        for position in self.positions:
            for link in scene.moving:
                spots = [view(position[name]) for name in scene.links[link]]
                yield from (Polyline(pens.POSITION, LAYER, None, chain) for chain in outline(spots))

    def items(self, view: View, scene: Scene) -> Iterator[Item]:
        """The centrodes in the pose of a scene, and what stays where it is."""
        for centrode in self.centrodes:
            yield from centrode.items(view, scene)
        yield from self.path_items(view)

    def path_items(self, view: View) -> Iterator[Item]:
        """The paths, a dot on them for each position, and a stroke across their ends where the motion stops."""
        for path in self.paths:
            chain = path.chain(view)
            yield Polyline(pens.PATH, LAYER, None, chain)
            for stopped, end in zip(path.stops, (chain, chain[::-1]), strict=True):
                if stopped:
                    yield _stop(end)
        for point in dict.fromkeys(path.point for path in self.paths):
            dots = (view(position[point]) for position in self.positions)
            yield from (Circle(pens.PATH_DOT, LAYER, None, dot, DOT_RADIUS_MM) for dot in dots)


def _corners(spots: Sequence[Spot]) -> tuple[Spot, ...]:
    """The lower left and the upper right of a box around some spots; empty without spots."""
    xs, ys = [x for x, _ in spots], [y for _, y in spots]
    return ((min(xs), min(ys)), (max(xs), max(ys))) if spots else ()


def outline(spots: Sequence[Spot]) -> Iterator[tuple[Spot, ...]]:
    """Yield the lines of a link: one through all its points, or its hull; no line if its points are at one place."""
    apart = distinct_spots(spots)
    if len(apart) > 1 and are_collinear(apart):
        yield farthest_pair(apart)
    elif len(apart) > 1:
        corners = hull(apart)
        yield (*corners, corners[0])


def simplify_chain(spots: Sequence[Spot]) -> tuple[Spot, ...]:
    """A chain with as few spots as the tolerance allows; one that returns along itself is drawn once."""
    import shapely  # where nothing is drawn, as for a list of steps, it is not needed

    if math.dist(spots[0], spots[-1]) < SAME_WAY_MM:
        ring = [spot for spot, after in pairwise(spots) if spot != after]
        turns = _turning_places(np.array(ring).reshape(-1, 2))
        if len(turns) == 2:
            (first, last), ring = turns, ring + ring
            halves = [shapely.LineString(ring[a : b + 1]) for a, b in ((first, last), (last, first + len(ring) // 2))]
            if shapely.hausdorff_distance(*halves) < SAME_WAY_MM:
                return tuple(halves[0].simplify(PATH_TOL_MM).coords)
    return tuple(shapely.LineString(spots).simplify(PATH_TOL_MM).coords)


def _turning_places(ring: NDArray[np.float64]) -> list[int]:
    """Places where a closed chain reverses its direction."""
    onwards = np.roll(ring, -1, axis=0) - ring
    return [*np.flatnonzero((np.roll(onwards, 1, axis=0) * onwards).sum(axis=1) < 0).tolist()]


def _stop(spots: Sequence[Spot]) -> Item:
    """The stroke across the first end of a chain."""
    direction = next((unit_vector(p, q) for p, q in pairwise(spots) if math.dist(p, q) > PATH_TOL_MM), (1.0, 0.0))
    return Polyline(pens.PATH_END, LAYER, None,
                    (offset(spots[0], direction, 0.0, STOP_MM), offset(spots[0], direction, 0.0, -STOP_MM)))
