"""In which pose of its cycle a mechanism was drawn, by the points that bear its letters.

In the pose that is meant they fit a similar figure of the scene's points, whatever its place, direction and size. Where
that of the task does not fit them and another of the cycle does, another one was drawn.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from typing import Any

import numpy as np

from graphplan.cycle.turn import follow
from graphplan.errors import GraphplanError
from graphplan.kernel.kinds import POINT
from graphplan.marking.judge.verdict import Judgement
from graphplan.mechanism.model import Scene
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.plates.plans import Plans

MIN_POINTS = 4  # two points fit any figure, and a third is where some pose has it
COARSE_POSES, FINE_POSES = 721, 41  # over the cycle, and about the best of these
FITS_MM, MISFITS_MM = 2.0, 4.0  # how far off a point may be in the pose that was drawn, and is in the task's
ROUND_TRAVELS, ROUNDING_MM = (5.0, 1.0, 0.1), 0.3  # degrees, of which the first that fits as well is meant; so well


def other_pose(judgement: Judgement) -> str:
    """The pose that was drawn in the place of the task's, as `--at` takes it, if it is told by the points; else empty.
    """
    scene, spots = judgement.drawing.scene, _lettered_spots(judgement)
    if len(set(spots.values())) < MIN_POINTS:
        return ""
    if _misfit({name: np.array([complex(*map(float, scene.points[name]))]) for name in spots}, spots)[0] < MISFITS_MM:
        return ""
    given_scene = scene.assembly.given_scene if scene.assembly else scene
    misfit_at = partial(_misfit_at, given_scene, spots)
    with suppress(GraphplanError):  # nothing drives it, or its drive slides, so that no turn closes its travel
        best, step = _best_travel(given_scene, spots, None), 360 / COARSE_POSES
        if np.isnan(misfit_at(best)):  # where no full turn is made, it is reached backwards
            best -= 360
        for _ in range(2):
            best, step = _best_travel(given_scene, spots, (best - step, best + step)), 2 * step / FINE_POSES
        if (least := misfit_at(best)) < FITS_MM:
            round_travels = (round(best / unit) * unit for unit in ROUND_TRAVELS)
            travel = next((near for near in round_travels if misfit_at(near) < least + ROUNDING_MM), best)
            return f"{travel:.4g}"
    return ""


def _lettered_spots(judgement: Judgement) -> dict[str, complex]:
    """Where the points of the scene are on the sheet, in mm, as far as they have letters."""
    steps, plan_of_step = judgement.drawing.drawn.steps, Plans(judgement.drawing).plan_of_step
    return {step.name: complex(*verdict.trace.spots[0]) for verdict in judgement.verdicts
            if verdict.trace and verdict.trace.label and (step := steps[verdict.step]).op.gives == POINT
            and plan_of_step[step.index] == MECHANISM and step.name in judgement.drawing.scene.points}


def _best_travel(scene: Scene, spots: Mapping[str, complex], span: tuple[float, float] | None) -> float:
    """The travel, in degrees, of the pose in which the points fit best; over the whole turn or a span."""
    turn = follow(scene, FINE_POSES if span else COARSE_POSES, span)
    return float(np.degrees(turn.travel[np.argmin(np.nan_to_num(_misfit(turn.points, spots), nan=np.inf))]))


def _misfit_at(scene: Scene, spots: Mapping[str, complex], travel: float) -> float:
    """How far off a point is at most at one travel; nan where it is not reached."""
    return float(_misfit(follow(scene, 1, (travel, travel)).points, spots)[0])


def _misfit(points: Mapping[str, Any], spots: Mapping[str, complex]) -> Any:
    """How far off the spots are at most from a figure similar to the points, in mm, in each of n poses; nan where one
    is not reached."""
    sheet = np.array(list(spots.values()))
    figures = np.stack([points[name] for name in spots])  # points by poses
    sheet, figures = sheet - sheet.mean(), figures - figures.mean(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        units = (figures.conj() * sheet[:, None]).sum(axis=0) / (abs(figures) ** 2).sum(axis=0)
        return abs(sheet[:, None] - units * figures).max(axis=0)
