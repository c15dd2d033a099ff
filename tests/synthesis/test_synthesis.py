"""Syntheses by `graphplan synthesize`: given positions are kept, what is found is a scene, limits are limits, and the
construction is on the sheet, in exports and handouts."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from face import names, ran
from inked_sheet import NS, InkedSheet
from tasks import SCENES, TASKS, written

import graphplan as gp

PACKAGED = names("tasks")
CASES = Path(__file__).parents[1] / "cases" / "synthesis"


def drawn(folder: Path, *words: str | Path) -> list[InkedSheet]:
    """The sheets that a command draws."""
    done = ran(*words, "-q", "-o", folder / "sheet.svg")
    assert done.status == 0, done.err
    return [InkedSheet.of(file.read_text("utf-8")) for file in sorted(folder.glob("sheet*.svg"), key=lambda one: len(
        one.name))]


def found(text: str, folder: Path) -> Any:
    """What is found for a task, as JSON."""
    done = ran("synthesize", written(folder / "task.toml", text), "-q")
    assert done.status == 0, done.err
    return done.json


@pytest.mark.parametrize("name", TASKS)
def test_what_is_found_keeps_what_is_given(name: str, tmp_path: Path) -> None:
    """What is drawn agrees with the independent check; a linkage is a scene whose lengths and motion are those told."""
    record = found(TASKS[name], tmp_path)
    assert max(record["check"].values()) < 1e-9
    if name not in SCENES:
        return
    done = ran("synthesize", tmp_path / "task.toml", "-q", "-o", tmp_path / "found.toml")
    assert done.status == 0, done.err
    scene = gp.load(tmp_path / "found.toml")
    assert gp.solve(scene).velocity
    for solution in record["solutions"][:1]:
        for points, length in solution["lengths"].items():
            if len(ends := points.split()) == 2:
                assert math.dist(*(solution["points"][end] for end in ends)) == pytest.approx(length, rel=1e-9)
        for point, place in solution["points"].items():
            assert point not in scene.points or [*map(float, scene.points[point])] == pytest.approx(place, abs=1e-9)


def test_five_pairs_of_a_linkage_give_it_back(tmp_path: Path) -> None:
    """Five pairs of angles of a known four-bar, by loop closure: it is one of the solutions, and each keeps its coupler
    at all five when it is turned back."""
    crank, coupler, rocker, inputs = 0.4, 0.9, 0.7, (40, 70, 115, 160, 200)
    outputs = list[float]()
    for turn in map(math.radians, inputs):
        way = 1 - crank * np.exp(1j * turn)
        inner = (abs(way) ** 2 + rocker**2 - coupler**2) / (2 * abs(way) * rocker)
        outputs.append(math.degrees(np.angle(-way) - math.acos(inner)))
    record = found(f"[function]\npivot = [0, 0]\ninput = {[*inputs]}\n"
                   f"rocker = {{ pivot = [1, 0], angles = {outputs} }}", tmp_path)
    lengths = [[one["lengths"][name] for name in ("O A", "A B", "B C")] for one in record["solutions"]]
    assert any(one == pytest.approx([crank, coupler, rocker], rel=1e-9) for one in lengths)
    for one in record["solutions"]:
        O, A, B, C = (complex(*one["points"][name]) for name in "OABC")
        back = [C + (O + (A - O) * np.exp(1j * math.radians(phi - inputs[0])) - C) * np.exp(
            -1j * math.radians(psi - outputs[0])) for phi, psi in zip(inputs, outputs, strict=True)]
        assert [abs(B - place) for place in back] == pytest.approx([one["lengths"]["A B"]] * 5, rel=1e-9)


@pytest.mark.parametrize("name", PACKAGED)
def test_packaged_tasks_are_right_wherever_they_are_written(name: str, tmp_path: Path) -> None:
    """A packaged task is found without a defect, and no scene has its name. Sheet and GeoGebra file, handed in as a
    drawing, have a hundred points; LaTeX has the given points at their distances on the sheet."""
    record = ran("synthesize", name, "-q").json
    assert max(record["check"].values()) < 1e-9
    assert all(not solution["defects"] for solution in record["solutions"])
    assert f"graphplan synthesize {name}" in ran("solve", name).err
    for command, ending in (("synthesize", "svg"), ("export", "ggb")):
        file = tmp_path / f"{ending}.{ending}"
        assert ran(command, name, "-q", "-o", file).status == 0
        verdict = gp.verify(name, file).json()
        assert (verdict["score"]["total"], verdict["first_wrong"]) == (100, None), ending
    assert ran("export", name, "-q", "-o", tmp_path / "task.tex").status == 0
    number = r"(-?[0-9.]+)"
    source = (tmp_path / "task.tex").read_text("utf-8")
    spots = [complex(float(x), float(y))
             for x, y in re.findall(rf"\\coordinate \(\w+\) at \({number},\s*{number}\)", source)]
    steps = ran("synthesize", name, "-q", "--steps").json["protocol"]["steps"]
    given = [complex(*step["value"][:2]) for step in steps if not step["number"] and step["kind"] == "point"]
    scale = [abs(b - a) / abs(w - v) for a, v in zip(spots, given, strict=False)
             for b, w in zip(spots, given, strict=False) if v != w]
    assert max(scale, default=1) == pytest.approx(min(scale, default=1), rel=1e-3)


@pytest.mark.parametrize("name", ["four positions", "crank-rocker", "slide", "cognates", "geneva", "conjugate", "gear"])
def test_sheets_have_their_steps(name: str, tmp_path: Path) -> None:
    """The sheet has a group for the last drawn step, what is given and what is found; a task what is given alone."""
    steps = found(TASKS[name], tmp_path)["steps"]
    root = drawn(tmp_path, "synthesize", tmp_path / "task.toml")[0].root
    classes = {group.get("class") for group in root.iter(f"{NS}g")}
    assert classes >= {"given", "found", "step"}
    assert max(int(group.get("data-step", 0)) for group in root.iter(f"{NS}g")) == steps


@pytest.mark.parametrize("name", ["guidance-fixed", "cognates-four-bar", "stroke-crank-rocker", "gear-21-1"])
def test_a_task_can_be_laid_over_its_solution(name: str, tmp_path: Path) -> None:
    """The sheet of a task has the paper, the panels and the given marks of the solution, where they lie there, and no
    step."""
    (task, *_), (solution, *_) = (drawn(tmp_path, "synthesize", name, *option) for option in (["--task"], []))
    assert task.root.get("viewBox") == solution.root.get("viewBox")
    assert {plan: panel.bounds for plan, panel in task.panels.items()} == {
        plan: panel.bounds for plan, panel in solution.panels.items()}
    dots = [{(one.get("cx"), one.get("cy")) for one in sheet.root.iter(f"{NS}circle")} for sheet in (task, solution)]
    assert dots[0]
    assert dots[0] <= dots[1]
    assert not [key for key, _ in task.elements if key == "1"]


def test_a_driving_crank_swings_the_plane_between_its_first_and_last_position(tmp_path: Path) -> None:
    """Over its turn OA goes as far as the given positions and no farther, and the times of both ways have the ratio."""
    record = ran("synthesize", CASES / "driven.toml", "-q").json
    solution, = record["solutions"]
    assert record["check"]["cycle"] < 1e-9
    going = solution["driver"]["travel"][-1]
    assert going / (360 - going) == pytest.approx(1.25, rel=1e-12)
    assert ran("synthesize", CASES / "driven.toml", "-q", "-o", tmp_path / "found.toml").status == 0
    poses = gp.follow(gp.load(tmp_path / "found.toml"), 720)
    turned = np.unwrap(np.angle(poses.points["A"] - complex(*solution["points"]["O"])), period=2 * math.pi)
    assert np.ptp(turned) == pytest.approx(math.radians(solution["travel"][-1]), abs=1e-4)
    assert not np.isnan(turned).any()


@pytest.mark.parametrize(("key", "value"), [("offset", 900), ("crank", 60), ("rod", 20), ("rod", 400)])
def test_the_limit_that_is_told_is_the_limit(key: str, value: float, tmp_path: Path) -> None:
    """Just within the limits of a reason there is a mechanism, just beyond them there is none."""
    def at(number: float) -> Any:
        text = f"[stroke]\nratio = 1.2\nstroke = 100\n{key} = {number}\n"
        return ran("synthesize", written(tmp_path / "task.toml", text), "-q")

    missing = at(value)
    assert missing.status == 3
    low, high = map(float, re.findall(r"than ([\d.]+)", missing.err)[-2:])
    assert [at(low + place * (high - low)).status for place in (0.001, 0.999, 1.001)] == [0, 0, 3]


def test_the_grounds_that_are_told_have_crank_rockers(tmp_path: Path) -> None:
    """A ground that does not do is answered by the ranges that do."""
    text = "[stroke]\nratio = 1.2\nrocker = { length = 80, swing = 60 }\nground = "
    missing = ran("synthesize", written(tmp_path / "task.toml", f"{text}900\n"), "-q")
    ranges = re.findall(r"from ([\d.]+) to ([\d.]+)", missing.err)
    assert missing.status == 3
    assert ranges
    for low, high in ranges:
        assert found(f"{text}{(float(low) + float(high)) / 2}\n", tmp_path)["solutions"]


def test_python_has_what_the_commands_write(tmp_path: Path) -> None:
    """`gp.synthesize` gives what the command prints, and its files are those of the commands, byte for byte."""
    task = written(tmp_path / "task.toml", TASKS["three positions"])
    result = gp.synthesize(task)
    assert result.json() == ran("synthesize", task, "-q").json
    result.save(tmp_path / "python.toml")
    assert ran("synthesize", task, "-q", "-o", tmp_path / "command.toml").status == 0
    assert (tmp_path / "python.toml").read_bytes() == (tmp_path / "command.toml").read_bytes()


# ---- handouts and variants -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("arguments", [[], ["--only", "guided", "--language", "lv"], ["--paper", "A2"]])
def test_the_command_hands_out_what_python_hands_out(arguments: list[str], tmp_path: Path) -> None:
    """`graphplan handout TASK` and `gp.handout` of what is found write the same file, byte for byte."""
    by_command, by_python, by_method = (tmp_path / f"{way}.pdf" for way in ("command", "python", "method"))
    assert ran("handout", "function-slide", "-q", *arguments, "-o", by_command).status == 0
    options = {key.removeprefix("--"): value for key, value in zip(arguments[::2], arguments[1::2], strict=True)}
    gp.handout(gp.synthesize("function-slide"), by_python, **options)
    gp.synthesize("function-slide").handout(by_method, **options)
    assert by_command.read_bytes() == by_python.read_bytes() == by_method.read_bytes()


def test_a_guided_version_tells_each_step_and_no_result(tmp_path: Path) -> None:
    """All steps are told, none is drawn, and the length that is found stands on the solution alone."""
    pypdfium2 = pytest.importorskip("pypdfium2")
    texts = {}
    for part in ("task", "guided", "solution"):
        assert ran("handout", "guidance-moving", "-q", "--only", part, "-o", tmp_path / "part.pdf").status == 0
        pages = pypdfium2.PdfDocument((tmp_path / "part.pdf").read_bytes())
        texts[part] = " ".join(" ".join(page.get_textpage().get_text_range() for page in pages).split())
    assert "the perpendicular bisector of" in texts["guided"]
    assert "the perpendicular bisector of" not in texts["task"]
    length = f"{ran('synthesize', 'guidance-moving', '-q').json['solutions'][0]['lengths']['O A']:.4g}"
    assert [length in texts[part] for part in ("task", "guided", "solution")] == [False, False, True]


VARIED = {
    "three": '"guidance.positions.1.0" = { from = 5, to = 6, step = 0.1 }',
    "offset": '"stroke.ratio" = [1.1, 1.2, 1.5, 2]\n"stroke.offset" = { from = 5, to = 400, step = 5 }',
    "dwelling": '"dwell.to" = { from = 60, to = 90, step = 5 }', "wheel": '"geneva.slots" = [4, 5, 6, 8]',
    "teeth": '"gear.teeth.0" = { from = 12, to = 24, step = 1 }',
}


def class_of(name: str, folder: Path, *options: str) -> Path:
    """The folder of a class's variants of a task."""
    own = (CASES / f"{name}.toml").read_text("utf-8")
    task = written(folder / f"{name}.toml", f"{own}\n\n[vary]\n{VARIED[name]}\n")
    done = ran("variants", task, "-q", "--jobs", "1", "-o", folder / "class", *options)
    assert done.status == 0, done.err
    return folder / "class"


@pytest.mark.parametrize("name", VARIED)
def test_variants_are_good_tasks(name: str, tmp_path: Path) -> None:
    """Each variant differs and is found, without a defect that the task itself has not."""
    own, texts = ran("synthesize", CASES / f"{name}.toml", "-q").json, set()
    defects = {*own.get("defects", []), *(one for solution in own["solutions"] for one in solution["defects"])}
    for path in sorted(class_of(name, tmp_path, "-n", "3", "--seed", "7").glob("variant-*.toml")):
        record = ran("synthesize", path, "-q").json
        texts.add(path.read_text("utf-8").partition("\n")[2])
        assert {*record.get("defects", [])} <= defects
        assert {one for solution in record["solutions"][:1] for one in solution["defects"]} <= defects
    assert len(texts) == 3


def test_the_key_has_all_answers(tmp_path: Path) -> None:
    """The table has lengths and points of each student's mechanism; the register says whose sheet is whose."""
    register = written(tmp_path / "names.csv", "name\nAda\nBert\n")
    folder = class_of("offset", tmp_path, "--names", str(register))
    head, *rows = [line.split(",") for line in (folder / "key.csv").read_text("utf-8-sig").replace(
        '"', "").splitlines()]
    for student, number in (("Ada", 1), ("Bert", 2)):
        solution = ran("synthesize", folder / f"variant-{number:02}.toml", "-q").json["solutions"][0]
        own = [dict(zip(head, row, strict=True)) for row in rows if student in row]
        key = {(row["quantity"], row["of"]): row for row in own}
        assert float(key["length", "A B"]["value"]) == pytest.approx(solution["lengths"]["A B"], rel=1e-5)
        assert math.dist((float(key["point", "B"]["x"]), float(key["point", "B"]["y"])), solution["points"]["B"]) < 1e-3
    sheets = json.loads((folder / "class.json").read_text())["sheets"]
    assert [(sheet["student"], sheet["scene"]) for sheet in sheets] == [("Ada", "variant-01.toml"),
                                                                        ("Bert", "variant-02.toml")]


def test_the_same_seed_gives_the_same_files(tmp_path: Path) -> None:
    """Command and Python write the same class, byte for byte; its folder can be moved with the scene of its path."""
    (tmp_path / "scene.toml").write_text(gp.load("dwell").toml(), encoding="utf-8")
    text = (CASES / "dwelling.toml").read_text("utf-8").replace('"dwell"', '"scene.toml"')
    task = written(tmp_path / "task.toml", f"{text}\n\n[vary]\n{VARIED['dwelling']}\n")
    folders = [tmp_path / name for name in ("command", "python", "method")]
    assert ran("variants", task, "-q", "-n", "2", "--seed", "5", "--jobs", "1", "-o", folders[0]).status == 0
    gp.variants(gp.synthesize(task), folders[1], 2, seed=5, jobs=1)
    gp.synthesize(task).variants(folders[2], 2, seed=5)
    files = [{path.name: path.read_bytes() for path in folder.iterdir()} for folder in folders]
    assert files[0] == files[1] == files[2]
    (tmp_path / "scene.toml").unlink()
    folders[0].rename(tmp_path / "moved")
    assert ran("synthesize", tmp_path / "moved" / "variant-02.toml", "-q").json["radius"] > 0
