"""`graphplan variants`: the tasks of a class, whole or not at all."""

from __future__ import annotations

import csv
import json
import math
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from graphplan.commands import main
from graphplan.marking.classroom.register import ClassRegister, load_register
from graphplan.mechanism.scene import load as load_scene
from graphplan.public.class_files import MAX_VARIANTS

CLASS = "name,group\nStudent 1,MX-31\nStudent 2,MX-32\nStudent 1,\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class of three and a spare sheet."""
    place = tmp_path_factory.mktemp("school")
    (place / "names.csv").write_text(CLASS)
    assert main(["variants", "four-bar", "--names", str(place / "names.csv"), "--spare", "1", "--seed", "3", "-q",
                 "-o", str(place / "class")]) == 0
    return place / "class"


@pytest.fixture(scope="module")
def register(folder: Path) -> ClassRegister:
    """Its register."""
    return load_register(folder)


def key(folder: Path) -> list[dict[str, str]]:
    """The rows of the key."""
    return [*csv.DictReader((folder / "key.csv").read_text(encoding="utf-8").splitlines())]


def test_each_student_has_a_task(folder: Path, register: ClassRegister) -> None:
    """Each name is on one sheet, equal names are told apart, spare sheets are nobody's; the key has the same names."""
    assert [sheet.student for sheet in register.sheets] == ["Student 1", "Student 2", "Student 1 (2)", ""]
    assert [sheet.variant for sheet in register.sheets] == [1, 2, 3, 4]
    assert {(row["variant"], row["student"]) for row in key(folder)} == {
        (str(sheet.variant), sheet.student) for sheet in register.sheets}
    assert sorted(path.name for path in folder.iterdir()) == [
        "booklet.pdf", "class.json", "key.csv", "key.pdf", *(f"variant-0{k}.toml" for k in (1, 2, 3, 4))]


def test_variants_differ_in_what_varies_alone(folder: Path, register: ClassRegister) -> None:
    """Each scene has values of the ranges and no table [vary]; they differ, and all have the same paper and scales."""
    own = load_scene("four-bar")
    sheets, drawn = set[str](), set[tuple[Any, ...]]()
    for sheet in register.sheets:
        text = (folder / sheet.scene).read_text(encoding="utf-8")
        tables = tomllib.loads(text)
        points, omega = tables["points"], tables["drive"][0]["omega"]
        found = points["A"][0], points["A"][1], points["B"][0], points["M"][0], omega
        assert all(value in choices for value, choices in zip(found, own.vary.values(), strict=True))
        assert "vary" not in text
        assert "# the coupler curve" in text
        assert tables["title"] == f"{own.title}, variant {sheet.variant}"
        sheets.add(json.dumps(tables["sheet"]))
        drawn.add(found)
    assert len(drawn) == len(register.sheets)
    assert len(sheets) == 1
    assert {"paper", "k_s", "k_v", "multiples"} <= {*json.loads(sheets.pop())}


def test_the_key_is_right(folder: Path, register: ClassRegister, tmp_path: Path,
                          capsys: pytest.CaptureFixture[str]) -> None:
    """A student who hands in the key's own rows of the variant has everything right."""
    for sheet in register.sheets[:2]:
        rows = [row for row in key(folder) if row["variant"] == str(sheet.variant)]
        with (tmp_path / "results.csv").open("w", newline="") as file:
            table = csv.DictWriter(file, ["quantity", "of", "x", "y", "value", "unit"], extrasaction="ignore")
            table.writeheader()
            table.writerows(rows)
        assert main(["verify", str(folder / sheet.scene), str(tmp_path / "results.csv"), "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["score"]["total"] == 100


@pytest.mark.costly
def test_the_same_seed_gives_the_same_bytes(folder: Path, tmp_path: Path) -> None:
    """The same seed gives the same files, in one process or two."""
    again = tmp_path / "again"
    names = str(folder.parent / "names.csv")
    assert main(["variants", "four-bar", "--names", names, "--spare", "1", "--seed", "3", "-q", "--jobs", "2",
                 "-o", str(again)]) == 0
    assert {path.name: path.read_bytes() for path in again.iterdir()} == {
        path.name: path.read_bytes() for path in folder.iterdir()}


def test_names_stand_on_the_sheets(folder: Path, register: ClassRegister) -> None:
    """On each page of the booklet stands its student; the pages of the register are those of the booklet. The key
    begins with who has which variant, and what the answers are."""
    pdfium = pytest.importorskip("pypdfium2")
    pages = pdfium.PdfDocument(str(folder / "booklet.pdf"))
    told = [pages[place].get_textpage().get_text_range() for place in range(len(pages))]
    for sheet in register.sheets[:3]:
        words = " ".join(told[sheet.page - 1].split())
        assert sheet.student in words
        assert f"variant {sheet.variant}" in words
        assert sheet.group in words
    first = " ".join(pdfium.PdfDocument(str(folder / "key.pdf"))[0].get_textpage().get_text_range().split())
    for sheet in register.sheets[:3]:
        who = f"{sheet.student} ({sheet.group})" if sheet.group else sheet.student
        line = first.partition(f"{sheet.variant} {who}: A x = ")[2]
        rows = {row["of"]: row for row in key(folder) if row["variant"] == str(sheet.variant)
                and row["quantity"] == "velocity"}
        size = math.hypot(float(rows["B"]["x"]), float(rows["B"]["y"]))
        assert re.search(rf"v ?B = {size:.4g} mm/s", line)


@pytest.mark.costly
def test_an_empty_folder_is_taken_and_a_full_one_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is in a folder stays there; nothing is written beside it."""
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("mine")
    for name, told in (("full", "it is there already, and not empty"), ("full/mine.txt", "cannot be written"),
                       ("a\0b", "cannot be written"), ("x" * 300, "cannot be written")):
        assert main(["variants", "four-bar", "-n", "1", "-o", str(tmp_path / name)]) == 2
        assert told in capsys.readouterr().err
    (tmp_path / "empty").mkdir()
    assert main(["variants", "four-bar", "-n", "1", "-q", "-o", str(tmp_path / "empty")]) == 0
    assert (tmp_path / "empty" / "class.json").exists()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty", "full"]


def refusals(tmp_path: Path) -> Iterator[tuple[list[str], str]]:
    """What is refused: the arguments, and what is told."""
    (tmp_path / "names.csv").write_text(CLASS)
    yield ["four-bar"], "-n: the number of tasks is missing; -n 30, or --names CLASS.csv"
    yield ["slider-crank", "-n", "2"], "slider-crank: vary: the scene does not say what varies; a table"
    yield ["four-bar", "-n", "2", "--names", str(tmp_path / "names.csv")], "-n 2: there are 3 names in .*; -n 3, or no"
    (tmp_path / "far.csv").write_text("name\n学生\n", encoding="utf-8")
    yield ["four-bar", "--names", str(tmp_path / "far.csv")], "far.csv: 学生: the font of the sheets has no 学 生; the"
    yield ["four-bar", "-n", "2", "-o", "-"], "-o -: a folder cannot go to standard output; the name of a folder"
    yield ["four-bar", "-n", str(MAX_VARIANTS + 1)], f"-n: {MAX_VARIANTS + 1}; give 1 to {MAX_VARIANTS}"
    scene = tmp_path / "wide.toml"
    scene.write_text(re.sub(r"(?s)\[vary\].*", '[vary]\n"points.A.angle" = { from = 45, to = 135, step = 1 }\n',
                            load_scene("ozols-5-1").text).replace("A = 730", "A = 280"))
    told = r"of \d+ variants drawn 0 are good, 5 are wanted; already at 45 points.B: the arc .* does not meet the line"
    yield [str(scene), "-n", "5"], f'wide.toml: vary."points.A.angle": {told}, .*; a narrower range, or a larger'


def test_what_cannot_be_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each refusal is one line with what would be right, and no folder is made."""
    for arguments, told in refusals(tmp_path):
        assert main(["variants", "-q", "-o", str(tmp_path / "class"), *arguments]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert re.search(told, line), line
        assert not (tmp_path / "class").exists()
