"""The loads that change, in many poses: each table read where the drive, or its slide, stands and moves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from graphplan.cycle.linkage import Array, number
from graphplan.cycle.positions import MovingLink
from graphplan.cycle.tolerances import LOOK_AHEAD
from graphplan.mechanism.load_values import guide_origin, onward
from graphplan.mechanism.loads import SPEED, LoadTable
from graphplan.mechanism.model import Force, Scene, Slide
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.tolerances import DEAD_POINT_TOL
from graphplan.mechanism.travel import travel_unit

Motion = Callable[[Array], Mapping[str, MovingLink]]
"""Gives how every link lies and moves at some travels."""


def loads_at(scene: Scene, travel: Array, points: Mapping[str, Array], guides: Mapping[str, Array],
             motion: Motion) -> dict[str, Array]:
    """The loads of a scene that change, by their letters, at these travels (radians or lengths), shape (n,): forces as
    complex numbers, moments as real ones, nan where the pose is not reached.

    `points` and `guides` are where they are there.
    """
    loads: dict[str, Array] = {}
    for name, load in changing_loads(scene.loads).items():
        assert load.table is not None
        values = _table_values(scene, load.table, travel, points, guides, motion)
        loads[name] = values * _force_direction(load, points) if isinstance(load, Force) else values
    return loads


def _force_direction(force: Force, points: Mapping[str, Array]) -> Any:
    """The unit vector along which a force acts."""
    return _unit(points[force.through[1]] - points[force.through[0]] if force.through
                 else number(*force.direction or (1, 0)))


def _table_values(scene: Scene, table: LoadTable, travel: Array, points: Mapping[str, Array],
                  guides: Mapping[str, Array],
                  motion: Motion) -> Array:
    """Loads of a table at these travels."""
    if table.over == SPEED:
        return table.values_at(np.full(travel.shape, abs(float(scene.drives[0].rate)))) + 0 * travel
    if table.span:
        A, B = (points[point] for point in table.span)
        return table.values_at(np.abs(B - A) + 0 * travel)
    if not table.slide:
        reached = np.isfinite(np.sum(list(points.values()), axis=0))
        return table.values_at(np.where(reached, travel / travel_unit(scene)[0], np.nan))
    slide = next(slide for slide in scene.slides if slide.name == table.slide)
    direction = guide_direction(slide, points, guides)
    speeds = slide_rate(slide, motion(travel), points[slide.at], direction)
    if table.over_speed:
        return table.values_at(speeds * abs(float(scene.drives[0].rate)))
    places = slide_position(scene, slide, points, direction)
    senses = _stroke_senses(slide, motion, travel, speeds * onward(scene), scene, points, guides)
    return table.values_at(places, np.where(senses, senses, next(iter(table.strokes))))


def guide_direction(slide: Slide, points: Mapping[str, Array], guides: Mapping[str, Array]) -> Any:
    """The unit vector of a slide's guide."""
    if slide.through:
        return _unit(points[slide.through[1]] - points[slide.through[0]])
    return _unit(guides.get(slide.name, number(*slide.direction)))


def _unit(along: Any) -> Any:
    with np.errstate(invalid="ignore", divide="ignore"):
        return along / np.abs(along)


def slide_position(scene: Scene, slide: Slide, points: Mapping[str, Array], way: Any) -> Array:
    """The position of a slide along its guide."""
    origin = guide_origin(scene, slide)
    away = points[slide.at] - (points[origin] if origin else 0.0)
    return np.asarray((away * np.conj(way)).real)


def slide_rate(slide: Slide, links: Mapping[str, MovingLink], at: Array, way: Any) -> Array:
    """Rate of a slide's position by the first drive's travel."""
    apart = links[slide.link].velocity_at(at) - links[slide.along].velocity_at(at)
    return np.asarray((apart * np.conj(way)).real)


def _stroke_senses(slide: Slide, motion: Motion, travel: Array, speeds: Array, scene: Scene,
                   points: Mapping[str, Array],
                   guides: Mapping[str, Array]) -> Array:
    """The sense in which a slide moves, 1 or -1, or at a dead point begins to; 0 where neither can be told."""
    first = scene.drives[0]
    reach = 1.0 if first.slides else scene.extent
    senses = np.sign(np.where(np.abs(speeds) > DEAD_POINT_TOL * reach, speeds, 0.0))
    dead = np.flatnonzero((senses == 0) & np.isfinite(speeds))
    if dead.size:
        guides_there = {name: z[dead] for name, z in guides.items()}
        points_there = {name: z[dead] for name, z in points.items()}
        for ahead in (1.0, -1.0):  # at the end of the way what it came by, turned
            step = ahead * onward(scene) * LOOK_AHEAD * (scene.extent if first.slides else 1.0)
            links = motion(travel[dead] + step)
            rates = ahead * onward(scene) * slide_rate(slide, links, points_there[slide.at],
                                                       guide_direction(slide, points_there, guides_there))
            rate_senses = np.sign(np.where(np.isfinite(rates), rates, 0.0))
            senses[dead] = np.where(senses[dead] == 0, rate_senses, senses[dead])
    return senses
