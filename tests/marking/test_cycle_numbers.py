"""Numbers over a machine's cycle: they are in the key of variants, and judged as a student hands them in."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from graphplan.commands import main
from graphplan.mechanism.scene import load

SCENE = "ozols-13-6"
VARY = '\n[vary]\n"flywheel.unevenness" = [0.03, 0.04]\n"forces.0.values.0.1" = [1000, 1100]\n'


@pytest.fixture(scope="module")
def key(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class of one."""
    folder = tmp_path_factory.mktemp("class")
    (folder / "yoke.toml").write_text(load(SCENE).text + VARY)
    assert main(["variants", str(folder / "yoke.toml"), "-n", "1", "-q", "-o", str(folder / "class")]) == 0
    return folder / "class"


def judged(scene: str, rows: list[tuple[str, ...]], folder: Path, capsys: pytest.CaptureFixture[str]) -> Any:
    """What is said of a table of results: quantity, what it is of, value and unit."""
    with (folder / "results.csv").open("w", newline="") as file:
        csv.writer(file).writerows([("quantity", "of", "value", "unit"), *rows])
    assert main(["verify", scene, str(folder / "results.csv"), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.costly
def test_the_key_of_a_variant_is_right(key: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Moment and inertia of each plan, closing moment and flywheel are in the key, whose rows earn all points."""
    rows = [*csv.DictReader((key / "key.csv").read_text(encoding="utf-8").splitlines())]
    named = [row["quantity"] for row in rows]
    assert {"reduced moment at 30", "reduced inertia at 345", "closing moment", "flywheel"} <= {*named}
    with (tmp_path / "results.csv").open("w", newline="") as file:
        table = csv.DictWriter(file, ["quantity", "of", "x", "y", "value", "unit"], extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)
    assert main(["verify", str(key / "variant-01.toml"), str(tmp_path / "results.csv"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["score"]["total"] == 100


def test_numbers_are_judged_within_what_a_drawing_allows(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The textbook's flywheel and closing moment are right, in other units too; the area method's is wrong, and so are
    a moment of the wrong sign and an inertia ten times too large, which are told; other travels are not asked for."""
    found = judged(SCENE, [
        ("flywheel", "", "49.4", "kg m^2"), ("closing moment", "", "0.1273", "kN m"),
        ("reduced moment", "30", "200", "N m"), ("reduced inertia at 15", "", "137.3", "kg*m^2"),
        ("reduced inertia at 37.5", "", "13.94", "kg m2"), ("reduced moment at 400", "", "1", "N m"),
    ], tmp_path, capsys)
    told = [(one["kind"], one["of"], one["verdict"], one["mistake"]) for one in found["numbers"]]
    assert told == [
        ("flywheel", "", "right", None), ("closing moment", "", "right", None),
        ("reduced moment", "30", "wrong", "the sign is reversed"),
        ("reduced inertia", "15", "wrong", "the number is 10 times as large as it should be"),
        ("reduced inertia", "37.5", "right", None)]
    assert found["not_asked"] == [{"kind": "reduced moment", "of": "400"}]
    wrong = judged(SCENE, [("flywheel", "", "11.23", "kg m2"), ("reduced inertia", "0", "13", "")], tmp_path, capsys)
    assert [one["verdict"] for one in wrong["numbers"]] == ["wrong", "right"]


def test_an_inertia_is_no_moment(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A number in a unit of another quantity is refused in one line."""
    (tmp_path / "results.csv").write_text("quantity,of,value,unit\nreduced inertia,0,13,N m\n")
    assert main(["verify", SCENE, str(tmp_path / "results.csv")]) == 2
    assert "not a unit such as kg·m^2" in capsys.readouterr().err
