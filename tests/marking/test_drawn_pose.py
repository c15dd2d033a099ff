"""Drawings of the task's mechanism in another pose: own sheets carry theirs, of others the lettered points tell it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from judged import judgement

import graphplan as gp
from graphplan.importing import embedded_scene
from graphplan.marking.judge.findings import reading_lines
from graphplan.marking.judge.score import Weights
from graphplan.marking.judge.verdict import Judgement
from graphplan.mechanism.written_pose import parse_pose, pose_text, with_pose, written_pose
from graphplan.methods.panels import MECHANISM
from graphplan.public.desk import Desk
from graphplan.public.drafting import Options
from graphplan.public.drawn_pose import other_pose
from graphplan.public.verifying import desk_for

POSES = [("four-bar", "60"), ("four-bar", "outer 3"), ("four-bar", "-12.5"), ("five-bar", "12,-5.5"),
         ("jaanimets-10", "40")]


def desk_of(name: str, pose: str = "") -> Desk:
    scene = gp.load(name)
    return desk_for(gp.at(scene, parse_pose(pose)) if pose else scene, Weights(), Options(), {})


@pytest.mark.parametrize(("name", "pose"), POSES)
def test_a_pose_is_written_as_it_is_asked_for(name: str, pose: str) -> None:
    """Above the keys of a scene stands the one pose that it is in, exactly; nothing stands above those of the given."""
    scene = gp.load(name)
    posed = gp.at(scene, parse_pose(pose))
    text = with_pose(with_pose(scene.text, gp.at(scene, 30)), posed)
    assert (written_pose(text), text.partition("\n")[2], with_pose(text, scene)) == (pose, scene.text, scene.text)
    assert gp.at(scene, parse_pose(pose_text(posed))).points == posed.points


@pytest.mark.parametrize("line", ["# drawn with --at 1e9999999\n", "# drawn with --at nowhere\n", "# --at 60\n",
                                  "# drawn with --at 5,-36000001/1000\n"])
def test_no_other_comment_is_a_pose(line: str) -> None:
    """Least of all a number that would fill the memory, or a travel that would take minutes to follow."""
    assert written_pose(f"{line}title = 'x'\n") == ""


@pytest.mark.parametrize("kind", ["svg", "dxf", "pdf"])
@pytest.mark.parametrize(("name", "pose"), POSES)
def test_own_sheets_carry_their_pose(name: str, pose: str, kind: str, tmp_path: Path) -> None:
    """A sheet in another pose than the task's, and one in the scene's own pose of a task in another, earn all points
    without being told, and the pose is told."""
    gp.construct(gp.at(gp.load(name), parse_pose(pose))).save(path := tmp_path / f"sheet.{kind}", by="sheet")
    assert written_pose(embedded_scene(path, path.read_bytes())) == pose
    for task, told in (("", pose), (pose, "")):
        judged = desk_of(name, task).judge_file(path)
        assert (judged.score.total, judged.judgement.other_pose) == (100, told)
    assert [str(line) for line in reading_lines(replace(judged.judgement, other_pose=pose))] == [
        f"Drawn in another pose than the task's: as with --at {pose}."]


def drawn_at(name: str, travel: float, beside: str = "") -> Judgement:
    """A drawing with the points of a scene where they are at this travel, one of them 20 mm beside it."""
    judged = judgement(name)
    turn, frame = gp.follow(judged.drawing.scene, 1, (travel, travel)), judged.frames[MECHANISM]

    def trace(index: int, old: object) -> object:
        point = judged.drawing.drawn.steps[index].name
        if point not in turn.points or index >= judged.drawing.drawn.givens:
            return old
        spot = frame.to_sheet(complex(turn.points[point][0])) + 20 * (point == beside)
        return replace(old, spots=((spot.real, spot.imag),), label=point)

    return replace(judged, verdicts=tuple(replace(verdict, trace=trace(verdict.step, verdict.trace))
                                          for verdict in judged.verdicts))


@pytest.mark.parametrize(("name", "travel"), [("four-bar", 60), ("triad", 45), ("jaanimets-10", 205), ("dwell", 17),
                                              ("stephenson", -18)])
def test_points_tell_the_pose(name: str, travel: float) -> None:
    """On a sheet that lies and is scaled as it likes, as a round number; where no full turn is made, as the mechanism
    comes there."""
    assert other_pose(drawn_at(name, travel)) == f"{travel}"


@pytest.mark.parametrize(("name", "beside"), [("four-bar", "A"), ("four-bar", "M"), ("four-bar", ""), ("triad", "E")])
def test_a_point_beside_its_place_is_no_pose(name: str, beside: str) -> None:
    """A single slip, or none, in the task's pose."""
    assert other_pose(drawn_at(name, 0, beside)) == ""


def test_points_that_no_pose_has_are_none() -> None:
    """In another pose, and one of too few points beside its place there."""
    assert other_pose(drawn_at("four-bar", 60, "M")) == ""
