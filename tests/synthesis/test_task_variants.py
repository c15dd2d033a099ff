"""Variants of tasks of synthesis: solvable, without new defects, long enough on their paper, the same by the same seed.
"""

from __future__ import annotations

import csv
import json
import math
import shutil
from pathlib import Path

import pytest
from tasks import TASKS

import graphplan as gp
from graphplan.commands import main
from graphplan.synthesis.exports import asked_lengths

VARIED = {
    "moving": ("[guidance]\npositions = [[0, 0, 30], [40, 22, 5], [85, 20, -25]]\nmoving = [[0, -35], [55, -20]]",
               '"guidance.positions.1.0" = { from = 30, to = 50, step = 2 }\n"guidance.moving.0.1" = [-45, -35, -25]'),
    "four": (f"[units]\nlength = 'cm'\n{TASKS['four positions']}",
             '"guidance.positions.3.2" = { from = -121, to = -119, step = 0.1 }'),
    "slide": ("[function]\npivot = [0, 0]\ninput = [35, 65, 110]\n"
              "slide = { through = [0, -15], direction = [1, 0], at = [168.7, 141.9, 102.8] }",
              '"function.input.1" = { from = 55, to = 75, step = 1 }'),
    "stroke": ("[stroke]\nratio = 1.2\nstroke = 100\noffset = 30",
               '"stroke.ratio" = [1.1, 1.2, 1.5, 2]\n"stroke.offset" = { from = 5, to = 400, step = 5 }'),
    "rocker": ('[stroke]\nratio = 1.2\nrocker = { length = 80, swing = 60 }\nground = "best"',
               '"stroke.rocker.swing" = { from = 40, to = 70, step = 5 }'),
    "dwell": ('[dwell]\nscene = "dwell"\npoint = "M on 2"\nfrom = 10\nto = 80\npivot = [50, 65]',
              '"dwell.to" = { from = 60, to = 90, step = 5 }'),
    "geneva": ("[geneva]\nslots = 6\ncentres = 100", '"geneva.slots" = [4, 5, 6, 8]'),
    "gear": ("[gear]\nmodule = 8\nteeth = [20, 30]", '"gear.teeth.0" = { from = 12, to = 24, step = 1 }'),
}
COUNT = 3


@pytest.mark.parametrize("kind", VARIED)
def test_variants_are_good_tasks(kind: str, tmp_path: Path) -> None:
    """Each variant is found, has no defect that the task itself has not, and what is asked for has 8 mm on its paper
    where the task's own has."""
    task = tmp_path / "task.toml"
    task.write_text("{}\n\n[vary]\n{}\n".format(*VARIED[kind]))
    own = gp.synthesize(task)
    gp.variants(own, tmp_path / "class", COUNT, seed=7, jobs=1)
    defects = {defect for solution in own.json()["solutions"][:1] for defect in solution["defects"]}
    texts = set()
    for number in range(1, COUNT + 1):
        path = tmp_path / "class" / f"variant-{number:02}.toml"
        texts.add(path.read_text().partition("\n")[2])
        found = gp.synthesize(path)
        assert {defect for solution in found.json()["solutions"][:1] for defect in solution["defects"]} <= defects
        assert found.json().get("defects", []) == []
        least = min(8.0, *(size / own.drawn.sheet.k_s / 1.25 for size in asked_lengths(own.synthesis).values()))
        assert all(size / found.drawn.sheet.k_s >= least for size in asked_lengths(found.synthesis).values())
    assert len(texts) == COUNT


def test_the_key_has_all_answers(tmp_path: Path) -> None:
    """The table has lengths and points of each student's mechanism; the register says whose sheet is whose."""
    names, task = tmp_path / "names.csv", tmp_path / "task.toml"
    names.write_text("name\nAda\nBert\n")
    task.write_text("{}\n\n[vary]\n{}\n".format(*VARIED["stroke"]))
    assert main(["variants", str(task), "-q", "--names", str(names), "--jobs", "1", "-o", str(tmp_path / "class")]) == 0
    with (tmp_path / "class" / "key.csv").open(encoding="utf-8-sig", newline="") as file:
        rows = [*csv.DictReader(file)]
    for student, number in (("Ada", 1), ("Bert", 2)):
        solution = gp.synthesize(tmp_path / "class" / f"variant-{number:02}.toml").json()["solutions"][0]
        key = {(row["quantity"], row["of"]): row for row in rows if row["student"] == student}
        assert float(key["length", "A B"]["value"]) == pytest.approx(solution["lengths"]["A B"], rel=1e-5)
        assert math.dist((float(key["point", "B"]["x"]), float(key["point", "B"]["y"])), solution["points"]["B"]) < 1e-3
    sheets = json.loads((tmp_path / "class" / "class.json").read_text())["sheets"]
    assert [(sheet["student"], sheet["scene"]) for sheet in sheets] == [("Ada", "variant-01.toml"),
                                                                        ("Bert", "variant-02.toml")]


def test_the_same_seed_gives_the_same_files(tmp_path: Path) -> None:
    """Command and Python write the same class, byte for byte."""
    task = tmp_path / "task.toml"
    task.write_text("{}\n\n[vary]\n{}\n".format(*VARIED["slide"]))
    folders = [tmp_path / name for name in ("command", "python", "method")]
    assert main(["variants", str(task), "-q", "-n", "2", "--seed", "5", "--jobs", "1", "-o", str(folders[0])]) == 0
    gp.variants(gp.synthesize(task), folders[1], 2, seed=5, jobs=1)
    gp.synthesize(task).variants(folders[2], 2, seed=5)
    files = [{path.name: path.read_bytes() for path in folder.iterdir()} for folder in folders]
    assert files[0] == files[1] == files[2]


def test_variants_have_the_scene_that_their_task_names(tmp_path: Path) -> None:
    """The scene of a task's path is copied beside its variants: their folder can be moved."""
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "path.toml").write_text(gp.load("dwell").toml())
    task = tmp_path / "task.toml"
    task.write_text(VARIED["dwell"][0].replace('"dwell"', '"mine/path.toml"') + f"\n\n[vary]\n{VARIED['dwell'][1]}\n")
    gp.synthesize(task).variants(tmp_path / "class", 2)
    shutil.rmtree(tmp_path / "mine")
    (tmp_path / "class").rename(tmp_path / "moved")
    assert gp.synthesize(tmp_path / "moved" / "variant-02.toml").json()["radius"] > 0


@pytest.mark.parametrize(("vary", "fault"), [
    ("", "vary: the task does not say what varies"), ('"stroke.rod" = [1, 2]', 'vary."stroke.rod"'),
    ('"stroke.offset" = { from = 500, to = 900, step = 1 }', 'vary."stroke.offset": of 101 variants drawn 0 are good')])
def test_what_cannot_vary_is_told(vary: str, fault: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without [vary], with an unknown number, or where no value has a mechanism: one line, and nothing is written."""
    task = tmp_path / "task.toml"
    task.write_text(VARIED["stroke"][0] + (f"\n\n[vary]\n{vary}\n" if vary else ""))
    assert main(["variants", str(task), "-n", "2", "--jobs", "1", "-o", str(tmp_path / "class")]) == 2
    line, = capsys.readouterr().err.splitlines()
    assert line.startswith(f"{task}: {fault}")
    assert not (tmp_path / "class").exists()
