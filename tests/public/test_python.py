"""Python as users have it: scenes, results and poses by name, each file byte for byte that of its command."""

from __future__ import annotations

import csv
import json
import pickle
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from face import ran

import graphplan as gp

SCENE = gp.load("four-bar")
DRAWING = gp.construct(SCENE)
HERE = Path(__file__).parents[1] / "cases" / "python"
FOUR_BAR: dict[str, Any] = {
    "title": 'A "four-bar"',
    "points": {"O": (0, 0), "A": np.array([20.0, 110.0]), "B": 135 + 225j, "C": [310, 0],
               "Mα": {"from": "A", "distance": np.float64(170.5), "angle": 100}},
    "links": {1: "O A", "2": "A B Mα", "3": "B C", "frame": "O C"},
    "drive": [{"link": "1", "omega": 10}],
    "find": {"velocity": ["B"], "acceleration": ["B"]},
}
USE = """
import graphplan as gp

scene = gp.at(gp.load("four-bar"), 10)
written: str = scene.toml()
results = gp.solve(scene)
velocity: complex = results.velocity["B"]
rate: float = results.omega["2"]
drawn: complex = gp.construct(scene).velocity["B"]
solved: complex = gp.analytic.solve(scene).velocity["B"]
wrong: float = results.velocity["B"]  # wrong
gp.solev  # wrong
"""


# ---- scenes ----------------------------------------------------------------------------------------------------------


def test_a_mapping_is_a_scene() -> None:
    """Vectors may be tuples, arrays or complex numbers, and the scene's file says the same."""
    scene = gp.scene(FOUR_BAR)
    assert scene.points["B"] == (135, 225)
    assert gp.parse(scene.toml()) == scene
    assert gp.solve(scene).velocity["B"] == gp.solve(SCENE).velocity["B"]


@pytest.mark.parametrize("tables", [{}, {"points": {"O": object()}}, {"points": {"O": float("nan")}},
                                    {**FOUR_BAR, "links": {"1": "O Z"}}])
def test_a_faulty_mapping_is_an_error(tables: dict[str, Any]) -> None:
    """What a file could not say, or says wrongly, is one of graphplan's own errors."""
    with pytest.raises(gp.GraphplanError):
        gp.scene(tables)


@pytest.mark.parametrize(("path", "value", "line"), [
    ("points.A.0", 25, "A = [25, 110]"), ("points.A.0", np.float64(0.1), "A = [0.1, 110]"),
    ("drive.0.omega", Fraction(1, 4), "omega = 0.25"), ("points.A", (1, 2), "A = [1, 2]"),
    ("points.A", 1 + 2j, "A = [1.0, 2.0]"), ("find.velocity", ["M"], 'velocity = ["M"]'),
    ("title", "Mine", 'title = "Mine"'), ("sheet.frame", "gost", 'frame = "gost"'),
    ("gravity", [0, -9.81], "gravity = [0, -9.81]"),
])
def test_a_value_is_replaced_by_its_path(path: str, value: Any, line: str) -> None:
    """Numbers, vectors, lists and texts, decimals as written; comments stay beside numbers, and the scene as it was."""
    before, text = SCENE.toml(), SCENE.replace(path, value).toml()
    assert line in [" ".join(row.split()) for row in text.splitlines()]
    assert SCENE.toml() == before
    assert "# the coupler curve" in text or path in ("points.A", "gravity")  # whose text is written anew


@pytest.mark.parametrize("path", ["points.Z.0", "points.A.5", "pionts.A.0", "points.A.0.1", ""])
def test_a_path_that_leads_nowhere_is_refused(path: str) -> None:
    """Nothing is made up where no value stands."""
    with pytest.raises(gp.GraphplanError):
        SCENE.replace(path, 1)


def test_several_values_are_replaced_at_once() -> None:
    """A mapping of values by paths gives what one after the other gives."""
    values = {"points.A.0": 25, "points.B": (140, 220), "drive.0.omega": 8.5, "title": "Mine"}
    in_turn = SCENE
    for path, value in values.items():
        in_turn = in_turn.replace(path, value)
    assert SCENE.replace(values) == in_turn == gp.parse(in_turn.toml(), "four-bar")


def test_nobody_changes_a_scene() -> None:
    """Neither its fields nor its points; a copy in another process is equal."""
    with pytest.raises(TypeError, match="cannot be changed"):
        SCENE.points["A"] = (0, 0)
    with pytest.raises(AttributeError):
        SCENE.title = "Mine"
    assert pickle.loads(pickle.dumps(SCENE)) == SCENE
    assert len(repr(SCENE)) < 100


# ---- results ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("results", [gp.solve(SCENE), DRAWING, DRAWING.evaluate(gp.follow(SCENE, 4))], ids=type)
def test_fixed_points_stand_still_and_others_must_be_asked_for(results: Any) -> None:
    """Of a fixed point the velocity is 0; a point that was not asked for is a KeyError that says which were."""
    assert np.all(results.velocity["O"] == 0)
    assert np.all(results.acceleration["C"] == 0)
    for name in ("Q", "a"):
        with pytest.raises(KeyError, match=f"velocity of {name} was not asked for, but of A, B, M"):
            results.velocity[name]
    with pytest.raises(KeyError, match="angular velocity of 9 was not asked for"):
        results.omega["9"]
    with pytest.raises(TypeError):
        results.velocity["A"] = 0
    assert "\n" not in repr(results)


def test_three_ways_agree() -> None:
    """Vectors are complex numbers; with exact=True pairs of fractions; balances and reactions have names."""
    results, solved, exact = gp.solve(SCENE), gp.analytic.solve(SCENE), gp.solve(SCENE, exact=True)
    assert results.velocity["M"] == DRAWING.velocity["M"]
    assert results.acceleration["M"] == pytest.approx(solved.acceleration["M"])
    assert results.omega["3"] == 2.25
    assert exact.velocity["A"] == (Fraction(-1100), Fraction(200))
    assert exact.omega["2"] == Fraction(exact.json()["links"]["2"]["omega"])
    loaded = gp.load("jaanimets-10")
    results, drawing = gp.solve(loaded), gp.construct(loaded)
    assert results.balance == pytest.approx(drawing.balances[0])
    assert {*results.reactions} >= {"frame at O", "3 at A"}
    for name, force in results.reactions.items():
        assert force == pytest.approx(drawing.reactions[name])


@pytest.mark.parametrize(("name", "options", "words"), [
    ("four-bar", {}, []), ("four-bar", {"exact": True}, ["--exact"]), ("four-bar", {"bounds": True}, ["--bounds"]),
    ("jaanimets-10", {"plan": "lever", "inertia": "shifted"}, ["--plan", "lever", "--inertia", "shifted"]),
    ("alt-eight-link", {"method": "trial"}, ["--method", "trial"]),
])
def test_solve_prints_what_python_has(name: str, options: dict[str, Any], words: list[str], tmp_path: Path) -> None:
    """The JSON of the command is that of the results, and saved it is the same text."""
    results, printed = gp.solve(gp.load(name), **options), ran("solve", name, *words)
    assert printed.json == results.json()
    results.save(str(tmp_path / "results.json"))
    assert (tmp_path / "results.json").read_text(encoding="utf-8") == printed.out


def test_what_was_not_asked_for_is_not_had() -> None:
    """`[find] omega` needs no plan of accelerations; poles that can be had are complex numbers."""
    results = gp.solve(SCENE.replace("find", {"omega": ["3"]}), exact=True)
    assert results.omega["3"] == Fraction(9, 4)
    assert "acceleration" not in results.check
    assert results.json()["links"] == {"3": {"omega": "9/4"}}
    with pytest.raises(KeyError):
        results.alpha["3"]
    poles = gp.solve(gp.load("alt-eight-link").replace("find.poles", "all")).poles
    assert all(isinstance(place, complex) for place in poles.values())


@pytest.mark.parametrize("wrong", [{"plan": "nonsense"}, {"papper": "A3"}, {"pencil": "nib=2"}])
def test_wrong_options_are_refused(wrong: dict[str, str]) -> None:
    """A misspelt option or value is one of graphplan's own errors."""
    with pytest.raises(gp.Refused):
        gp.solve(SCENE, **wrong)


# ---- over poses ------------------------------------------------------------------------------------------------------


def test_poses_are_in_degrees() -> None:
    """A full turn leaves its end out, a span has both; what was promised before still works."""
    poses = gp.follow(SCENE, 360)
    assert poses.travel.tolist() == list(range(360))
    assert gp.follow(SCENE, 3, (0, 90)).travel.tolist() == [0, 45, 90]
    assert np.array_equal(gp.cycle.follow(SCENE, 4, (0, 360)).points["M"][:1], poses.points["M"][:1])
    with pytest.raises(ValueError, match="read-only"):
        poses.points["M"][0] = 0


@pytest.mark.parametrize("compiled", [False, True])
def test_the_steps_are_replayed_over_poses(compiled: bool) -> None:
    """Each pose gives what the construction of that pose gives, in columns of equal length by name."""
    if compiled:
        pytest.importorskip("llvmlite")
    poses = gp.follow(SCENE, 12)
    motion = DRAWING.evaluate(poses, compiled=compiled)
    assert motion.velocity["M"][1] == pytest.approx(gp.construct(gp.at(SCENE, 30)).velocity["M"])
    assert not motion.faults
    for points in (dict(poses.points), gp.cycle.follow(SCENE, 12).points):
        assert np.array_equal(DRAWING.evaluate(points=points).velocity["M"], motion.velocity["M"])
    assert [*motion.table("M", "2")] == ["travel", "M.x", "M.y", "M.vx", "M.vy", "M.ax", "M.ay", "2.omega", "2.alpha"]
    assert {len(column) for column in motion.table().values()} == {12}
    assert np.array_equal(motion.table("M")["M.vy"], motion.velocity["M"].imag)
    with pytest.raises(KeyError, match="nothing of Q was asked for"):
        motion.table("Q")


def test_poses_that_are_not_reached_say_why() -> None:
    """They are nan in points and results, and their faults are told once."""
    scene = gp.load("plough-lift")
    poses = gp.follow(scene, 12, (0, 2000))
    motion, lost = gp.construct(scene).evaluate(poses), sorted(poses.faults)
    assert lost
    assert {*lost} <= motion.faults.keys()
    assert all(np.isnan(values[lost]).all() for values in motion.velocity.values())


@pytest.mark.parametrize("workers", [1, 2])
def test_a_stream_is_the_motion_in_parts(workers: int, tmp_path: Path) -> None:
    """Its blocks, joined, are all poses; its file is that of the cycle, byte for byte; a summary has extremes."""
    drawing, poses, span = gp.construct(gp.load("plough-lift")), 90, (0.0, 200.0)  # it is not lifted so far
    stream = drawing.stream(poses, span, workers=workers)
    whole, series = drawing.evaluate(gp.follow(drawing.scene, poses, span)), [*stream]
    for name, column in whole.table().items():
        joined = np.concatenate([part.table()[name] for part in series])
        assert np.array_equal(joined[reached := np.isfinite(joined)], column[reached]), name
    stream.save(tmp_path / "python.csv")
    assert ran("cycle", "plough-lift", "-q", "--positions", "90", "--from", "0", "--to", "200", "-o",
               tmp_path / "command.csv").status == 0
    assert (tmp_path / "python.csv").read_bytes() == (tmp_path / "command.csv").read_bytes()
    last = [*csv.reader((tmp_path / "python.csv").read_text().splitlines())][-1]
    assert not any(last[2:-1]), "of what is not reached there is nothing"
    omega = stream.summary().results["omega"]["4"]
    assert omega.least < omega.mean < omega.greatest
    assert 0 <= omega.least_at <= span[1]
    assert stream.summary().first_failure is not None


# ---- files -----------------------------------------------------------------------------------------------------------


def both(save: Callable[[str], object], words: list[str], folder: Path, name: str) -> None:
    """Compare what Python saves with what the command writes, all pages of it."""
    places = {by: folder / by for by in ("python", "command")}
    save(str(places["python"] / name))
    assert ran(*words, "-o", places["command"] / name).status == 0
    files = {by: {path.relative_to(place): path.read_bytes() for path in place.rglob("*") if path.is_file()}
             for by, place in places.items()}
    assert files["python"] == files["command"] != {}


@pytest.mark.parametrize(("name", "options", "words"), [
    ("sheet.svg", {}, []), ("sheet.pdf", {"paper": "A3", "plan": "polar"}, ["--paper", "A3", "--plan", "polar"]),
    ("sheet.png", {"dpi": 40, "language": "de"}, ["--dpi", "40", "--language", "de"]),
    ("part.svg", {"steps": "6-12"}, ["--steps", "6-12"]),
])
def test_sheets(name: str, options: dict[str, Any], words: list[str], tmp_path: Path) -> None:
    """`drawing.save` is `draw -o`, with options as keywords."""
    both(lambda path: DRAWING.save(path, **options), ["draw", "four-bar", *words], tmp_path, name)


def test_pages_and_classes(tmp_path: Path) -> None:
    """A construction is saved as it was constructed, `--set` is `replace`, and handouts, live pages and classes of
    Python are those of the commands."""
    polar, crank = gp.construct(SCENE, plan="polar"), gp.load("slider-crank")
    moved = gp.construct(SCENE.replace("points.A.0", 25).replace("sheet.frame", "gost"))
    given = ["--set", "points.A.0=25", "--set", "sheet.frame=gost"]
    none = ["--choices", "none"]
    for name, save, words in (
        ("polar.svg", polar.save, ["draw", "four-bar", "--plan", "polar"]),
        ("moved.svg", moved.save, ["draw", "four-bar", *given]),
        ("task.pdf", lambda path: gp.handout(crank, path, choices="none"), ["handout", "slider-crank", *none]),
        ("steps.html", lambda path: gp.handout(crank, path, choices="none"), ["handout", "slider-crank", *none]),
        ("page.html", lambda path: gp.live(crank, path, choices="none", plan="polar"),
         ["live", "slider-crank", *none, "--plan", "polar"]),
        ("class", lambda path: gp.variants(SCENE, path, n=1, seed=3),
         ["variants", "four-bar", "-n", "1", "--seed", "3"]),
    ):
        both(save, words, tmp_path / name, name)


@pytest.mark.parametrize(("find", "words"), [
    (lambda: gp.flywheel(gp.load("ozols-13-6"), positions=12), ["flywheel", "ozols-13-6", "--positions", "12"]),
    (lambda: gp.motion("ozols-13-7", positions=8), ["motion", "ozols-13-7", "--positions", "8"]),
    (lambda: gp.balance(gp.load("ozols-16-1"), positions=8), ["balance", "ozols-16-1", "--positions", "8"]),
    (lambda: gp.balance(str(HERE / "rotor.toml")), ["balance", str(HERE / "rotor.toml")]),
    (lambda: gp.cam(str(HERE / "cam.toml")), ["cam", str(HERE / "cam.toml")]),
], ids=["flywheel", "motion", "balance", "rotor", "cam"])
def test_subjects(find: Callable[[], gp.Subject], words: list[str], tmp_path: Path) -> None:
    """Sheets, tables and JSON of a subject are those of its command; its JSON is what is printed."""
    subject = find()
    for name in ("numbers.json", "sheet.svg", "sheet.toml" if "cam" in words else "table.csv"):
        both(subject.save, words, tmp_path / name, name)
    assert subject.json() == json.loads((tmp_path / "numbers.json" / "command" / "numbers.json").read_text())
    assert "\n" not in repr(subject)


def test_verdicts(tmp_path: Path) -> None:
    """`gp.verify` is `verify`: JSON, words and report."""
    findings = gp.verify(SCENE, HERE / "student.csv")
    done = ran("verify", "four-bar", HERE / "student.csv", "--json", "--report", tmp_path / "report.html")
    assert done.json == findings.json()
    findings.save(tmp_path / "again.html")
    assert (tmp_path / "again.html").read_bytes() == (tmp_path / "report.html").read_bytes()


# ---- what is promised ------------------------------------------------------------------------------------------------


def test_types_are_those_of_the_values(tmp_path: Path) -> None:
    """A vector is a complex number, a name that does not exist is none, a scene that was read can be written."""
    api = pytest.importorskip("mypy.api")
    (tmp_path / "use.py").write_text(USE)
    told, _, _ = api.run(["--strict", str(tmp_path / "use.py")])
    wrong = [number for number, line in enumerate(USE.splitlines(), 1) if line.endswith("# wrong")]
    assert [int(line.split(":")[-3]) for line in told.splitlines() if ": error: " in line] == wrong, told
