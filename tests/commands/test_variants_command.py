"""`graphplan variants`: the tasks of a class, whole or not at all."""

from __future__ import annotations

import csv
import json
import math
import tomllib
from pathlib import Path
from typing import Any

import pytest
from face import ran

import graphplan as gp

CLASS = "name,group\nStudent 1,MX-31\nStudent 2,MX-32\nStudent 1,\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class of three and a spare sheet."""
    place = tmp_path_factory.mktemp("school")
    (place / "names.csv").write_text(CLASS)
    done = ran("variants", "four-bar", "--names", place / "names.csv", "-n", "4", "--seed", "3", "-q", "-o",
               place / "class")
    assert done.status == 0, done.err
    return place / "class"


def sheets(folder: Path) -> list[dict[str, Any]]:
    """The sheets of the register, in `class.json`."""
    return list(json.loads((folder / "class.json").read_text(encoding="utf-8"))["sheets"])


def key(folder: Path) -> list[dict[str, str]]:
    """The rows of the key."""
    return [*csv.DictReader((folder / "key.csv").read_text(encoding="utf-8").splitlines())]


def test_each_student_has_a_task(folder: Path) -> None:
    """Each name is on one sheet, equal names are told apart, spare sheets are nobody's; the key has the same names."""
    assert [sheet["student"] for sheet in sheets(folder)] == ["Student 1", "Student 2", "Student 1 (2)", ""]
    assert [sheet["variant"] for sheet in sheets(folder)] == [1, 2, 3, 4]
    assert {(row["variant"], row["student"]) for row in key(folder)} == {
        (str(sheet["variant"]), sheet["student"]) for sheet in sheets(folder)}
    assert sorted(path.name for path in folder.iterdir()) == [
        "booklet.pdf", "class.json", "key.csv", "key.pdf", *(f"variant-0{k}.toml" for k in (1, 2, 3, 4))]


def test_variants_differ_in_what_varies_alone(folder: Path) -> None:
    """Each scene has values of the ranges and no table [vary]; they differ, and all have the same paper and scales."""
    own = gp.load("four-bar")
    papers, drawn = set[str](), set[tuple[Any, ...]]()
    for number in (1, 2, 3, 4):
        text = (folder / f"variant-0{number}.toml").read_text(encoding="utf-8")
        tables = tomllib.loads(text)
        points, omega = tables["points"], tables["drive"][0]["omega"]
        found = points["A"][0], points["A"][1], points["B"][0], points["M"][0], omega
        assert all(value in choices for value, choices in zip(found, own.vary.values(), strict=True))
        assert "vary" not in text
        assert "# the coupler curve" in text
        assert tables["title"] == f"{own.title}, variant {number}"
        papers.add(json.dumps(tables["sheet"]))
        drawn.add(found)
    assert (len(drawn), len(papers)) == (4, 1)
    assert {"paper", "k_s", "k_v", "multiples"} <= {*json.loads(papers.pop())}


def test_the_key_is_right(folder: Path, tmp_path: Path) -> None:
    """A student who hands in the key's own rows of the variant has everything right."""
    for number in (1, 2):
        rows = [row for row in key(folder) if row["variant"] == str(number)]
        with (tmp_path / "results.csv").open("w", newline="") as file:
            table = csv.DictWriter(file, ["quantity", "of", "x", "y", "value", "unit"], extrasaction="ignore")
            table.writeheader()
            table.writerows(rows)
        words = folder / f"variant-0{number}.toml", tmp_path / "results.csv", "--json"
        assert ran("verify", *words).json["score"]["total"] == 100


def test_the_same_seed_gives_the_same_bytes(folder: Path, tmp_path: Path) -> None:
    """The same seed gives the same files, in one process or two."""
    words = "--names", folder.parent / "names.csv", "-n", "4", "--seed", "3", "-q", "--jobs", "2"
    assert ran("variants", "four-bar", *words, "-o", tmp_path / "again").status == 0
    assert {path.name: path.read_bytes() for path in (tmp_path / "again").iterdir()} == {
        path.name: path.read_bytes() for path in folder.iterdir()}


def test_names_stand_on_the_sheets(folder: Path) -> None:
    """On each page of the booklet stands its student; the pages of the register are those of the booklet. The key
    begins with who has which variant and what the answers are, a line each."""
    pdfium = pytest.importorskip("pypdfium2")
    pages = pdfium.PdfDocument(str(folder / "booklet.pdf"))
    lines = [" ".join(line.split()) for line in
             pdfium.PdfDocument(str(folder / "key.pdf"))[0].get_textpage().get_text_range().splitlines()]
    for sheet in sheets(folder)[:3]:
        words = " ".join(pages[sheet["page"] - 1].get_textpage().get_text_range().split())
        student, group, variant = (sheet.get(name, "") for name in ("student", "group", "variant"))
        assert all(word in words for word in (student, f"variant {variant}", group))
        line = next(line for line in lines if line.startswith(f"{variant} {student} ({group})" if group
                                                              else f"{variant} {student}"))
        rows = {row["of"]: row for row in key(folder) if row["variant"] == str(variant)
                and row["quantity"] == "velocity"}
        size = math.hypot(float(rows["B"]["x"]), float(rows["B"]["y"]))
        assert f" {size:.4g} ∠ " in line


def test_an_empty_folder_is_taken_and_a_full_one_refused(tmp_path: Path) -> None:
    """What is in a folder stays there; nothing is written beside it."""
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("mine")
    for name, told in (("full", "it is there already, and not empty"), ("full/mine.txt", "cannot be written"),
                       ("a\0b", "cannot be written"), ("x" * 300, "cannot be written")):
        done = ran("variants", "four-bar", "-n", "1", "-o", tmp_path / name)
        assert (done.status, told in done.err) == (2, True), done.err
    (tmp_path / "empty").mkdir()
    assert ran("variants", "four-bar", "-n", "1", "-q", "-o", tmp_path / "empty").status == 0
    assert (tmp_path / "empty" / "class.json").exists()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty", "full"]
