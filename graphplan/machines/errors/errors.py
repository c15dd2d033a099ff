"""Errors of position, each partial error as drawn by its transformed mechanism and compared.

The construction is compared with the analytic solver, as every other; and the coefficient with differences of the
closure: the same mechanism followed a little to both sides, which knows nothing of velocities.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.check.report import Report
from graphplan.check.tolerances import DIFFERENCE_STEPS, DIFFERENCE_TOL
from graphplan.check.trusted import report
from graphplan.cycle.loads import guide_direction, slide_position
from graphplan.cycle.turn import follow
from graphplan.errors import Disagreement
from graphplan.machines.errors.transformed import (
    DEGREE,
    DrivenPosition,
    asked_positions,
    dimensions,
    transform_mechanism,
)
from graphplan.mechanism.model import FRAME, NamedDimension, Scene, Slide
from graphplan.methods import kinds


@dataclass(frozen=True)
class PartialError:
    """What the error of one dimension does: the coefficient of each position by its name, in the position's unit (rad
    of an angle) for one of the dimension's (degrees of an angle), and the construction that it was read off."""

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
        """What `graphplan errors` prints."""
        units = self.scene.units
        errors = {position.name: {
            "parts": {part.dimension.name: {"coefficient": part.coefficients[position.name],
                                            "error": part.error(position.name)} for part in self.parts},
            "sum": self.largest(position.name), "probable": self.probable(position.name),
        } for position in self.positions}
        constructed = max(float(value) for part in self.parts for value in part.report.check.values())
        return {"title": self.scene.title, "units": {"length": units.length}, "errors": errors,
                "check": {"construction": constructed, "differences": self.differences}}


def position_errors(scene: Scene, **how: Any) -> PositionErrors:
    """The errors of the positions that a scene asks for, its dimensions being off by their tolerances.

    `how` the plans are drawn is as for `report`. Fails with `Refused` where nothing has a tolerance, with
    `SingularPose` where a dimension can move the mechanism no way, and with `Disagreement` where the differences of the
    closure tell another coefficient.
    """
    positions, gaps, parts = asked_positions(scene), list[float](), list[PartialError]()
    for dimension in dimensions(scene):
        moved = transform_mechanism(scene, dimension, positions)
        result = report(moved, **how)
        coefficients = {position.name: _coefficient(moved, position, result) for position in positions}
        parts.append(PartialError(dimension, float(scene.tolerances[dimension.name]), coefficients, result))
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
    """How far a coefficient and the differences of the closure are apart, beside its size, at the first step at which
    they agree; None where the pose is a limit position."""
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
