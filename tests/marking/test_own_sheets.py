"""Draw, then verify: graphplan's own sheets, read back from their files, are faultless drawings."""

from __future__ import annotations

from pathlib import Path

import pytest

import graphplan as gp
from graphplan.accuracy.pencil import Pencil
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.score import score
from graphplan.marking.judge.verdict import MISSING, WRONG
from graphplan.marking.submission import read
from graphplan.marking.traces import PlanFrame
from graphplan.output.svg import svg
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout

COSTLY = {"kinytskyi", "rosenauer-loaded", "walschaerts-loaded"}  # as much as the half of all others together
SCENES = sorted({path.stem for path in (Path(gp.__file__).parent / "scenes").glob("*.toml")} - COSTLY)


@pytest.mark.parametrize("name", SCENES)
def test_own_sheets_are_faultless(name: str, tmp_path: Path) -> None:
    """No mark of a packaged scene's sheet is wrong or missing, and all points are earned."""
    composition, path = compose(gp.construct(gp.load(name))), tmp_path / "sheet.svg"
    drawing, arrangement = composition.plans.drawing, composition.arrangement
    path.write_text(svg(layout(drawing, composition=composition)), encoding="utf-8")
    frames = {panel: PlanFrame(complex(*view.origin), view.scale) for panel, view in composition.views.items()}
    submission = read(path, list(composition.views), frames, size=(arrangement.width, arrangement.height))
    found = judge(drawing, composition, submission, Pencil())
    assert not [(drawing.drawn.text(verdict.step), verdict.state) for verdict in found.verdicts
                if verdict.state in (WRONG, MISSING)]
    assert score(found).total == 100
