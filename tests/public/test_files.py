"""What Python saves is what the command writes, byte for byte, and what it has as JSON is what is printed."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import graphplan as gp
from graphplan.commands import main

CAM = """\
[[law]]
angle = 120
motion = "harmonic"
stroke = 25
[[law]]
angle = 60
motion = "dwell"
[[law]]
angle = 90
motion = "sine"
stroke = -25
[[law]]
angle = 90
motion = "dwell"
[follower]
moves = "translating"
contact = "roller"
radius = 8
offset = 6
[cam]
turns = "clockwise"
rpm = 300
base = 40
"""
ROTOR = """\
[rotor]
planes = [0, 600]
masses = [{ mass = 0.5, radius = 100, angle = 0, at = 200 }, { mass = 0.3, radius = 80, angle = 120, at = 400 }]
"""


def both(save: Callable[[str], object], words: list[str], folder: Path, name: str) -> None:
    """Compare what Python saves with what the command writes, all pages of it."""
    places = {by: folder / by for by in ("python", "command")}
    save(str(places["python"] / name))
    assert main([*words, "-o", str(places["command"] / name)]) == 0
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
    drawing = gp.construct(gp.load("four-bar"))
    both(lambda path: drawing.save(path, **options), ["draw", "four-bar", *words], tmp_path, name)


def test_the_way_of_drawing_is_kept(tmp_path: Path) -> None:
    """A construction is saved as it was constructed."""
    drawing = gp.construct(gp.load("four-bar"), plan="polar")
    both(drawing.save, ["draw", "four-bar", "--plan", "polar"], tmp_path, "sheet.svg")


def test_a_value_is_set_as_it_is_replaced(tmp_path: Path) -> None:
    """`--set` is `scene.replace`."""
    scene = gp.load("four-bar").replace("points.A.0", 25).replace("sheet.frame", "gost")
    both(gp.construct(scene).save,
         ["draw", "four-bar", "--set", "points.A.0=25", "--set", "sheet.frame=gost"], tmp_path, "sheet.svg")


@pytest.mark.parametrize("name", ["task.pdf", "steps.html"])
def test_handouts(name: str, tmp_path: Path) -> None:
    """`gp.handout` is `handout -o`."""
    scene = gp.load("slider-crank")
    both(lambda path: gp.handout(scene, path, choices="none"), ["handout", "slider-crank", "--choices", "none"],
         tmp_path, name)


def test_live_pages(tmp_path: Path) -> None:
    """`gp.live` is `live -o`."""
    scene = gp.load("slider-crank")
    both(lambda path: gp.live(scene, path, choices="none", plan="polar"),
         ["live", "slider-crank", "--choices", "none", "--plan", "polar"], tmp_path, "page.html")


def test_classes(tmp_path: Path) -> None:
    """`gp.variants` is `variants -o`."""
    scene = gp.load("four-bar")
    both(lambda path: gp.variants(scene, path, n=1, seed=3), ["variants", "four-bar", "-n", "1", "--seed", "3"],
         tmp_path, "class")


@pytest.mark.parametrize(("find", "source", "words"), [
    (lambda path: gp.flywheel(gp.load("ozols-13-6"), positions=12), "ozols-13-6",
     ["flywheel", "ozols-13-6", "--positions", "12"]),
    (lambda path: gp.motion("ozols-13-7", positions=8), "ozols-13-7", ["motion", "ozols-13-7", "--positions", "8"]),
    (lambda path: gp.balance(gp.load("ozols-16-1"), positions=8), "", ["balance", "ozols-16-1", "--positions", "8"]),
    (gp.balance, ROTOR, ["balance", "{path}"]), (gp.cam, CAM, ["cam", "{path}"]),
], ids=["flywheel", "motion", "balance", "rotor", "cam"])
def test_subjects(find: Callable[[str], gp.Subject], source: str, words: list[str], tmp_path: Path) -> None:
    """Sheets, tables and JSON of a subject are those of its command; its JSON is what is printed."""
    task = tmp_path / "task.toml"
    task.write_text(source, encoding="utf-8")
    subject, words = find(str(task)), [word.replace("{path}", str(task)) for word in words]
    for name in ("numbers.json", "sheet.svg", "sheet.toml" if "cam" in words else "table.csv"):
        (tmp_path / name).mkdir()
        both(subject.save, words, tmp_path / name, name)
    assert subject.json() == json.loads((tmp_path / "numbers.json" / "command" / "numbers.json").read_text())
    assert "\n" not in repr(subject)


def test_verdicts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`gp.verify` is `verify`: JSON, words and report."""
    table, report = tmp_path / "student.csv", tmp_path / "report.html"
    table.write_text("quantity,of,x,y,value,unit\nvelocity,A,-1100,200,,mm/s\nomega,2,,,-5.2,rad/s\n")
    findings = gp.verify(gp.load("four-bar"), table)
    assert main(["verify", "four-bar", str(table), "--json", "--report", str(report)]) == 0
    assert json.loads(capsys.readouterr().out) == findings.json()
    findings.save(tmp_path / "again.html")
    assert (tmp_path / "again.html").read_bytes() == report.read_bytes()
