"""What is asked for lies on the paper: poles, centres of curvature and paths."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import Pencil
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import PLACE
from graphplan.methods.panels import MECHANISM

STRANGERS = Path(__file__).parents[1] / "cases" / "strangers" / "more"
FAR = gp.load(STRANGERS / "own-rocker-1.toml")


def places_on_paper(scene: Scene) -> list[bool]:
    """Whether each place that is asked for, and each path, lies on its panel."""
    drawing = gp.construct(scene)
    composition = draft(drawing, Pencil()).composition
    view, wanted = composition.views[MECHANISM], drawing.drawn.wanted
    marks = [wanted[mark] for reading in drawing.readings if reading.kind.dimension == PLACE for mark in reading.marks]
    assert marks
    motion = composition.plans.motion
    spots = [composition.plans.spot(mark) for mark in marks] + [*(motion.path_ends if motion else ())]
    return [view.rect.holds(view(spot), 0.01) for spot in spots]


@pytest.mark.parametrize("source", [STRANGERS / "own-poles-m.toml", STRANGERS / "own-rocker-1.toml",
                                    "inflection-circle", "instant-centres"], ids=lambda source: Path(source).stem)
def test_places_and_paths_lie_on_the_paper(source: Path | str) -> None:
    """The scale is smaller, or the paper larger, for them."""
    assert all(places_on_paper(gp.load(source)))


@pytest.mark.parametrize(("angle", "extents"), [(60, 1.6), (108, 3.8), (124, 7.9), (148, 4.1)])
def test_a_pole_is_marked_as_far_off_as_sheets_hold_it(angle: int, extents: float) -> None:
    """Up to ten times the size of the mechanism away."""
    scene = FAR.replace("points.A.angle", angle)
    at = gp.solve(scene).json()["poles"]["3 frame"]["at"]
    assert math.hypot(*at) / float(scene.extent) == pytest.approx(extents, abs=0.05)
    assert all(places_on_paper(scene))
