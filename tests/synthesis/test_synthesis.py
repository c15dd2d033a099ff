"""Syntheses: textbook values, given positions that are kept, and what is refused."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from tasks import PLANES, SCENES, TASKS, THREE

import graphplan as gp
from graphplan.check.synthesis import check_synthesis
from graphplan.commands import main
from graphplan.errors import NoMechanism, SceneError
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names
from graphplan.mechanism.scene import parse as parse_scene
from graphplan.synthesis.exports import numbers, scene_text
from graphplan.synthesis.find import find_mechanism
from graphplan.synthesis.sketch import Synthesis
from graphplan.synthesis.task import parse


def find(text: str) -> Synthesis:
    return find_mechanism(parse(text, "task"))


@pytest.mark.parametrize("name", TASKS)
def test_every_kind_agrees_with_its_check(name: str) -> None:
    """What is drawn agrees with the independent check, and linkages come to their positions."""
    assert max(check_synthesis(find(TASKS[name])).values()) < 1e-9


@pytest.mark.parametrize("name", SCENES)
def test_what_is_found_is_a_scene(name: str) -> None:
    """What is found can be solved as a scene."""
    assert gp.analytic.solve(parse_scene(scene_text(find(TASKS[name])), "scene")).velocity


@pytest.mark.parametrize("name", ["four positions", "crank-rocker", "slide", "cognates", "geneva", "conjugate", "gear"])
def test_sheets_have_their_steps(name: str, tmp_path: Path) -> None:
    """The sheet has a group for the drawn steps, and JSON as many."""
    task = tmp_path / "task.toml"
    task.write_text(TASKS[name])
    assert main(["synthesize", str(task), "-q", "-o", str(tmp_path / "sheet.svg")]) == 0
    assert main(["synthesize", str(task), "-q", "-o", str(tmp_path / "numbers.json")]) == 0
    steps = json.loads((tmp_path / "numbers.json").read_text())["steps"]
    sheet = (tmp_path / "sheet.svg").read_text()
    assert f'data-step="{steps}"' in sheet
    assert 'class="given"' in sheet
    assert 'class="found"' in sheet


@pytest.mark.parametrize("name", ["guidance-fixed", "cognates-four-bar"])
def test_a_task_sheet_shows_what_is_given_alone(name: str, tmp_path: Path) -> None:
    """The sheet of a task has the marks of the solution that are given, where they lie there, and no step."""
    sheets = [tmp_path / "task.svg", tmp_path / "solution.svg"]
    for sheet, option in zip(sheets, (["--task"], []), strict=True):
        assert main(["synthesize", name, *option, "-q", "-o", str(sheet)]) == 0
    task, solution = (sheet.read_text() for sheet in sheets)
    assert 'data-step="1"' in solution
    assert 'data-step="1"' not in task
    dots = [set(re.findall(r'<circle [^>]*cx="([^"]+)" cy="([^"]+)"', sheet)) | set(
        re.findall(r'<circle cx="([^"]+)" cy="([^"]+)"', sheet)) for sheet in (task, solution)]
    assert dots[0]
    assert dots[0] < dots[1]


@pytest.mark.parametrize("name", packaged_names(TASK_FOLDER))
def test_packaged_tasks_are_synthesized_by_name(name: str) -> None:
    """A packaged task is found by its name without a defect of a linkage, and no scene has the name."""
    result = gp.synthesize(name).json()
    assert max(result["check"].values()) < 1e-9
    assert all(not solution["defects"] for solution in result["solutions"])
    with pytest.raises(SceneError, match=f"graphplan synthesize {name}"):
        gp.load(name)


def test_packaged_tasks_are_listed_and_copied(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`list` has them, and `new --from` writes one's own file of one."""
    assert main(["list", "tasks", "--json"]) == 0
    listed = {task["name"]: task["finds"] for task in json.loads(capsys.readouterr().out)}
    assert listed["guidance-22-8"] == "guidance"
    assert [*listed] == packaged_names(TASK_FOLDER)
    assert main(["new", str(tmp_path / "mine.toml"), "--from", "gear-21-1", "-q"]) == 0
    assert gp.synthesize(tmp_path / "mine.toml").json()["kind"] == "gear"


# ---- printed values (Ozols 1974) ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("u", "root", "centre", "radius"), [
    (5.0, 1, (9.8745, -1.0032), 8.4519), (4.2, 1, (10.7477, 0.4055), 3.9132), (1.5, 1, (13.0726, -0.3153), 6.0060),
    (0.0, 1, (13.8461, -2.8962), 9.2887), (0.0, 2, (13.2647, -5.1927), 11.5712), (8.641, 2, (6.5096, 1.0517), 7.7396),
])
def test_circle_points_of_example_22_8(u: float, root: int, centre: tuple[float, float], radius: float) -> None:
    """Table 22-2 has these centres."""
    points = find(f"[guidance]\npositions = [{PLANES}]\ntable = [{u}]").results["circle_points"]
    assert points[root - 1]["centre"] == pytest.approx(centre, abs=1e-3)
    assert points[root - 1]["radius"] == pytest.approx(radius, abs=1e-3)


def test_ball_and_return_points_of_example_22_8() -> None:
    """Ball's point and the return point, the printed ones corrected."""
    results = find(f"[guidance]\npositions = [{PLANES}]\ntable = [0]").results
    assert results["ball"] == pytest.approx((4.15251, -3.61473), abs=1e-5)
    assert results["return_point"] == pytest.approx((9.12245, -2.51087), abs=1e-5)
    assert results["inflection"]["123"]["radius"] == pytest.approx(2.3648, abs=1e-4)


@pytest.mark.parametrize(("slots", "omega", "entry", "largest", "crank_at"), [
    (3, 6.46, 1.73, 31.40, 4 + 45 / 60), (4, 2.41, 1.00, 5.41, 11 + 28 / 60), (6, 1.00, 0.58, 1.35, 22 + 54 / 60),
    (12, 0.35, 0.27, 0.35, 44.0)])
def test_table_19_1(slots: int, omega: float, entry: float, largest: float, crank_at: float) -> None:
    """The Geneva wheels of table 19-1, the angle of three slots corrected."""
    results = find(f"[geneva]\nslots = {slots}\ncentres = 1").results
    alpha = results["alpha"]
    assert (results["omega"], alpha["entry"], alpha["largest"]) == pytest.approx((omega, entry, largest), abs=0.01)
    assert alpha["crank_at"] == pytest.approx(crank_at, abs=0.02)


@pytest.mark.parametrize(("teeth", "ratio"), [((12, 12), 1.42), ((13, 16), 1.47), ((14, 26), 1.54), ((15, 45), 1.61),
                                              ((16, 101), 1.68)])
def test_table_21_1(teeth: tuple[int, int], ratio: float) -> None:
    """The contact ratios of table 21-1."""
    assert find(f"[gear]\nmodule = 1\nteeth = {[*teeth]}").results["contact_ratio"] == pytest.approx(ratio, abs=0.01)


def test_an_offset_slider_crank_of_a_ratio() -> None:
    """K = 1.2, a stroke of 0.1 and an offset of 0.03 give r and b."""
    lengths = find(TASKS["slider-crank"]).linkage.lengths
    assert (lengths["O A"], lengths["A B"]) == pytest.approx((0.0477947, 0.1137222), abs=1e-7)


@pytest.mark.parametrize("size", ["crank = 45", "rod = 120"])
def test_a_slider_crank_is_drawn_from_what_is_given(size: str) -> None:
    """By crank or rod no step lays off the offset, which is asked: compasses take twice the length that is given."""
    synthesis = find(f"[stroke]\nratio = 1.3\nstroke = 100\n{size}")
    drawing = synthesis.values.drawing
    given = [number for step in drawing.program.steps for key, number in step.params.items() if key == "length"]
    name, _, length = size.partition(" = ")
    assert given == [2 * float(length)]
    assert synthesis.linkage.lengths["O A" if name == "crank" else "A B"] == pytest.approx(float(length), rel=1e-12)


# ---- a driving crank -----------------------------------------------------------------------------------------------


DRIVEN = "[guidance]\npositions = [[0, 0, 30], [40, 22, 5], [85, 20, -25]]\nmoving = [[0, -35], [55, -20]]\n"


def test_a_driving_crank_swings_the_plane_between_its_first_and_last_position() -> None:
    """Over its turn OA goes as far as the given positions and no farther, and the times of both ways have the ratio."""
    synthesis = find(f"{DRIVEN}driver = {{ ratio = 1.25 }}")
    assert check_synthesis(synthesis)["cycle"] < 1e-9
    crank, linkage = synthesis.linkage.further["driver"], synthesis.linkage
    going = crank["travel"][-1]
    assert going / (360 - going) == pytest.approx(1.25, rel=1e-12)
    poses = gp.follow(gp.parse(scene_text(synthesis)), 720)
    turned = np.unwrap(np.angle(poses.points["A"] - linkage.O), period=2 * math.pi)
    assert np.ptp(turned) == pytest.approx(math.radians(linkage.travel[-1]), abs=1e-4)
    assert not np.isnan(turned).any()


def test_a_linkage_with_a_defect_has_no_driving_crank() -> None:
    """A linkage that does not go through its positions is told with its defect, and without a crank."""
    synthesis = find(f"[guidance]\npositions = [{THREE}]\nfixed = [[0, 0], [9, -2]]\ndriver = {{ ratio = 1.2 }}")
    assert synthesis.linkage.defects
    assert numbers(synthesis, {})["solutions"][0]["driver"] is None


def test_a_crank_that_does_not_exist_is_refused() -> None:
    """Where no crank swings OA so far in that ratio the reason says what would do."""
    with pytest.raises(NoMechanism, match=r"guidance\.driver: .*; a smaller ratio"):
        find(f"{DRIVEN}driver = {{ ratio = 9 }}")


# ---- what is refused ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("text", "fault"), [
    ("[gear]\nmodule = 0\nteeth = [17, 30]", "gear.module"), ("[geneva]\nslots = 2\ncentres = 1", "geneva.slots"),
    ("[stroke]\nratio = 0.5\nstroke = 3\noffset = 1", "stroke.ratio"), ("title = 'x'", "file"),
    (f"[guidance]\npositions = [{THREE}]\nmoving = [[1, 1], [1, 1]]", "guidance.moving"),
    ("[guidance]\npositions = [[0, 0, 0], [0, 0, 360]]", "guidance.positions")])
def test_faulty_tasks_are_told(text: str, fault: str) -> None:
    """A faulty task has a line a fault, which begins with the key."""
    with pytest.raises(SceneError) as faults:
        parse(text, "task")
    assert any(line.startswith(f"task: {fault}: ") for line in faults.value.lines)


@pytest.mark.parametrize(("text", "named"), [
    ("[guidance]\npositions = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\nmoving = [[1, 1], [2, 2]]", "A_1, A_2, A_3"),
    ("[stroke]\nratio = 1.2\nstroke = 100\noffset = 900", "347.758"),
    ("[stroke]\nratio = 1.2\nstroke = 100\ncrank = 60", "less than 50")])
def test_what_does_not_exist_is_refused_with_the_limit(text: str, named: str, tmp_path: Path,
                                                       capsys: pytest.CaptureFixture[str]) -> None:
    """Where the construction does not exist the exit status is 3, one line names points or limit, nothing is written.
    """
    task, sheet = tmp_path / "task.toml", tmp_path / "sheet.svg"
    task.write_text(text)
    assert main(["synthesize", str(task), "-o", str(sheet)]) == 3
    assert named in capsys.readouterr().err
    assert not sheet.exists()


@pytest.mark.parametrize(("key", "value"), [("offset", 900), ("crank", 60), ("rod", 20), ("rod", 400)])
def test_the_limit_that_is_told_is_the_limit(key: str, value: float) -> None:
    """Just within the limits of a reason there is a mechanism, just beyond them there is none."""
    text = "[stroke]\nratio = 1.2\nstroke = 100\n"
    with pytest.raises(NoMechanism) as missing:
        find(f"{text}{key} = {value}")
    low, high = map(float, re.findall(r"than ([\d.]+)", str(missing.value))[-2:])
    for place in (0.001, 0.999):
        assert find(f"{text}{key} = {low + place * (high - low)}").linkages
    with pytest.raises(NoMechanism):
        find(f"{text}{key} = {high + 0.001 * (high - low)}")


def test_the_grounds_that_are_told_have_crank_rockers() -> None:
    """A ground that does not do is answered by the ranges that do."""
    text = "[stroke]\nratio = 1.2\nrocker = { length = 80, swing = 60 }\n"
    with pytest.raises(NoMechanism) as missing:
        find(f"{text}ground = 900")
    ranges = re.findall(r"from ([\d.]+) to ([\d.]+)", str(missing.value))
    assert ranges
    for low, high in ranges:
        assert find(f"{text}ground = {(float(low) + float(high)) / 2}").linkages


def test_python_has_it(tmp_path: Path) -> None:
    """`gp.synthesize` gives what the command prints, and saves what it writes."""
    task = tmp_path / "task.toml"
    task.write_text(TASKS["three positions"])
    found = gp.synthesize(task)
    assert found.json()["kind"] == "guidance"
    found.save(tmp_path / "found.toml")
    assert math.hypot(*map(float, gp.load(str(tmp_path / "found.toml")).points["O"])) > 1
