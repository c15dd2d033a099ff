"""Draw, then verify: graphplan's own sheets, read back from their files, are faultless drawings."""

from __future__ import annotations

import re
from html import escape
from itertools import cycle
from pathlib import Path
from typing import Any

import pytest
from face import names, ran
from hand_drawings import steps_of
from sampling import CORE

import graphplan as gp

OTHER = ("draw dxf", "export ggb", "draw pdf")  # commands and endings
WAYS = [
    *(f"--language {code}" for code in ("de", "lv", "et", "ru", "uk")), "--strict", "--protocol apart",
    *(f"--plan {plan}" for plan in ("polar", "orthogonal", "lever", "polygons")), "--paper A2", "--paper Tabloid",
    *(f"--method {method}" for method in ("auxiliary", "trial", "poles")), "--prefer accurate",
    "--set sheet.curves=all", "--set sheet.frame=gost --language uk", "--pencil point=0.3"]


MAX_STEPS = 800  # of a sheet that is judged here: the search for mistakes grows with the square of their number


def verified(scene: str, path: Path, *options: str) -> Any:
    """What is said of a file."""
    return ran("verify", scene, path, "--json", "-q", *options).json


@pytest.mark.parametrize(("name", "other"), list(zip(names(), cycle(OTHER), strict=False)))
def test_own_sheets_are_faultless(name: str, other: str, tmp_path: Path) -> None:
    """No mark of a packaged scene's sheet is wrong or missing, as SVG and in one of the other formats in turn, and all
    points are earned."""
    for command, ending in ("draw", "svg"), other.split():
        path = tmp_path / f"sheet.{ending}"
        drawn = ran(command, name, "-o", path, "-q")
        if drawn.status or not path.is_file():  # a scene of several pages, or which has no such export
            assert ending != "svg", drawn.err
            continue
        done = ran("verify", name, path, "--json", "-q")
        if done.status:  # of what is no construction nothing can be judged
            assert done.err.count("\n") == 1
            continue
        found = done.json
        counts = {state: found["counts"][state] for state in ("wrong", "missing", "unsure") if found["counts"][state]}
        assert (ending, found["first_wrong"], counts) == (ending, None, {})
        assert found["score"]["total"] in (100, None)
        assert found["reading"] == ""


@pytest.mark.parametrize("name", CORE)
def test_own_sheets_need_not_be_told(name: str, tmp_path: Path) -> None:
    """Whatever the language, the paper, the plans and the form of a sheet: verified as the scene's, at most one mark of
    a hundred is not right. Each scene is drawn in a fifth of the ways, so that each way is tried on four."""
    number = CORE.index(name)
    for way in WAYS[number % 5::5]:  # a whole sheet by compasses alone is too long a DXF file to be read
        path = tmp_path / f"sheet.{'svg' if way == '--strict' else ('svg', 'dxf', 'pdf')[number % 3]}"
        if ran("draw", name, "-o", path, "-q", *way.split()).status or not path.is_file():
            continue  # the scene has no such sheet
        if path.suffix == ".svg" and path.read_text().count('class="step"') > MAX_STEPS:
            continue
        counts = verified(name, path)["counts"]
        assert 100 * (counts["wrong"] + counts["missing"] + counts["unsure"]) <= sum(counts.values()), way
        path.unlink()


@pytest.mark.parametrize("name", ["ozols-13-6", "ozols-10-1", "triad-loaded", "rosenauer-loaded"])
def test_sheets_without_layers_are_read_by_their_ink_and_letters(name: str, tmp_path: Path) -> None:
    """A file that does not say what its layers are, and so not where its plans lie: corners of force polygons, which
    are but the tips of arrows, too."""
    path = tmp_path / "sheet.svg"
    assert ran("draw", name, "-o", path, "-q").status == 0
    path.write_text(re.sub(r' class="[^"]*"', "", path.read_text()))
    assert verified(name, path)["score"]["total"] == 100


def moved(text: str, letters: str, spot: tuple[float, float], by: tuple[float, float], *, with_letters: bool) -> str:
    """An SVG sheet on which a dot lies elsewhere, and its letters if they follow it, and nothing else."""
    def shift(found: re.Match[str]) -> str:
        x, y = (float(found[k]) + far for k, far in zip((2, 4), by, strict=True))
        return f"{found[1]}{x:.2f}{found[3]}{y:.2f}{found[5]}"

    x, y = (re.escape(f"{round(coordinate, 2):g}") for coordinate in spot)
    name, _, low = letters.partition("_")
    written = rf"<tspan>{name}</tspan><tspan [^>]*>{low}<" if low else f"{name}<"
    for pattern in (rf'(<circle cx=")({x})(" cy=")({y})(")',
                    rf'(<text [^>]*x=")([\d.]+)(" y=")([\d.]+)(">{written})')[: 1 + with_letters]:
        text, count = re.subn(pattern, shift, text)
        assert count == 1
    return text


@pytest.mark.parametrize(("letters", "plan", "with_letters"), [
    ("v_m", "", True), ("A_1", "", True), ("p", "polar", True), ("v_m", "", False), ("p", "polar", False)])
def test_a_mark_that_was_moved_is_told(letters: str, plan: str, with_letters: bool, tmp_path: Path) -> None:
    """A dot with its letters, or without them, 6 mm off where strokes still cross and the arrow ends: the mark is
    wrong, by so much; and so is the beginning of a plan where strokes no longer begin."""
    options = ("--plan", plan) if plan else ()
    step, = (step for step in steps_of("four-bar", *options) if step["makes"] == letters)
    path = tmp_path / "sheet.svg"
    assert ran("draw", "four-bar", "-o", path, "-q", *options).status == 0
    path.write_text(moved(path.read_text(), letters, tuple(step["paper"]), (3.6, -4.8), with_letters=with_letters))
    found = verified("four-bar", path, *options)
    assert [(one["mark"], round(one["off_mm"], 1)) for one in found["steps"] if one["verdict"] == "wrong"] == [
        (letters, 6.0)]


def test_a_scene_in_the_file_of_a_stranger_is_not_believed(tmp_path: Path) -> None:
    """One of another mechanism, of the same with more to it, far too long, or a million openings without an end: the
    sheet is judged as one that says nothing."""
    path = tmp_path / "sheet.svg"
    assert ran("draw", "four-bar", "--paper", "A2", "-o", path, "-q").status == 0
    text = path.read_text()
    own = re.search(r'<metadata id="scene">(.*?)</metadata>', text, re.DOTALL)
    assert own
    others = [escape(gp.load("rosenauer-example-2").text), own[1].replace("[points]", "[points]\nZ = [1, 2]"),
              own[1] + "# more\n" * 30_000, "x = " + "[" * 50_000, '<metadata id="scene">' * 2, ""]
    found = []
    for other in others:
        path.write_text(text.replace(own[1], other) if "<" not in other else f"{text}{other}")
        done = ran("verify", "four-bar", path, "--json", "-q")
        found.append(done.json["score"] if done.status == 0 else done.err.count("\n"))
    assert [one for one in found if one != found[-1] and one != 1] == []


@pytest.mark.parametrize(("name", "travel"), [("four-bar", 60), ("triad", 45), ("jaanimets-10", 205),
                                              ("stephenson", -18)])
def test_points_tell_the_pose(name: str, travel: int, tmp_path: Path) -> None:
    """Measured points of a drawing in another pose than the task's are judged as of that, and it is told."""
    rows = [f"{step['makes']},{step['paper'][0]:.2f},{250 - step['paper'][1]:.2f},\"{step['plan']}\""
            for step in steps_of(name, f"--at={travel}") if step["kind"] == "point" and " " not in step["makes"]]
    (path := tmp_path / "points.csv").write_text("\n".join(["mark,x,y,panel", *rows]) + "\n")
    assert verified(name, path)["pose"] == f"{travel}"
    assert verified(name, path, f"--at={travel}")["pose"] is None
