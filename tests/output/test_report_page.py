"""The pages of judged drawings: everything of a student's file is escaped, nothing is fetched or run, tables are whole.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from face import got, ran
from html_reader import Reader

HOSTILE = "<img src=x onerror=alert(1)>\"'&"
WRONG = "v_b"


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> tuple[Reader, Any]:
    """The report of a four-bar of which the points are measured, the first crossing wrongly, in a file of a hostile
    name; and the same as data."""
    folder = tmp_path_factory.mktemp("report")
    rows = ["mark,x,y"]
    for step in got("four-bar").steps["steps"]:
        if step["kind"] == "point" and step["makes"][0].isalpha() and not step["makes"].startswith("point"):
            x, y = step["paper"][0] + 12 * (step["makes"] == WRONG), 210 - step["paper"][1]
            rows.append(f'"{step["makes"]}",{x:.2f},{y:.2f}')
    table = folder / f"{HOSTILE}.csv"
    table.write_text("\n".join(rows) + "\n", encoding="utf-8")
    done = ran("verify", "four-bar", table, "--json", "--report", folder / "report.html")
    assert done.status == 0, done.err
    return Reader((folder / "report.html").read_text("utf-8")), done.json


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Reader:
    """The list of a class of two, one with a hostile name, with a hostile note."""
    folder = tmp_path_factory.mktemp("class")
    name = HOSTILE.replace('"', "").replace("'", "")
    (folder / "names.csv").write_text(f"name\n{name}\nBert\n", encoding="utf-8")
    (folder / "table.csv").write_text(f"student,quantity,of,x,y,value,unit\n{name},velocity,A,-1100,200,,mm/s\n"
                                      "Bert,velocity,A,1,2,,mm/s\n", encoding="utf-8")
    assert ran("variants", "four-bar", "-n", "2", "--names", folder / "names.csv", "-q", "--jobs", "1", "-o",
               folder / "class").status == 0
    done = ran("verify", folder / "class", folder / "table.csv", "-q", "--note", "Bert=<script>alert(2)</script>",
               "-o", folder / "results")
    assert done.status == 0, done.err
    return Reader((folder / "results" / "results.html").read_text("utf-8"))


def test_what_students_write_is_told_and_never_run(report: tuple[Reader, Any], results: Reader) -> None:
    """Hostile names stand on the page as text: there is no script, no picture, no handler, nothing to be fetched."""
    for found in (report[0], results):
        assert "<img src=x onerror=alert(1)>" in found.text
        names = {tag for tag, _ in found.tags}
        assert not names & {"script", "img", "iframe", "object", "image", "use", "foreignobject"}
        attributes = {name for _, held in found.tags for name in held}
        assert not {name for name in attributes if name.startswith("on")} | attributes & {"src", "xlink:href"}
        assert not re.search(r"url\(|@import", found.page)
        assert not [held["href"] for held in found.all("a") if "//" in (held["href"] or "")]
    assert "<script>alert(2)</script>" in results.text


def test_the_page_forbids_what_could_be_fetched(report: tuple[Reader, Any]) -> None:
    """Its policy allows the style that stands in it, and nothing else."""
    policy = [held["content"] for held in report[0].all("meta") if "http-equiv" in held]
    assert policy == ["default-src 'none'; style-src 'unsafe-inline'"]


def test_every_step_has_a_row(report: tuple[Reader, Any]) -> None:
    """All steps stand in the table, with their verdict as class."""
    page, data = report
    looks = [held["class"] for held in page.all("tr") if held.get("class")]
    verdicts = [step["verdict"] for step in data["steps"]]
    assert len(looks) >= len(verdicts) > 30
    assert looks.count("wrong") == verdicts.count("wrong") == 1
    assert looks.count("right") == verdicts.count("right") > 5


def test_tables_can_be_heard(report: tuple[Reader, Any], results: Reader) -> None:
    """Each table has a caption, heads for its columns, and a head in each row."""
    for found in (report[0], results):
        tables = len(found.all("table"))
        assert tables == len(found.all("caption")) == len(found.all("thead")) > 0
        scopes = [held.get("scope") for held in found.all("th")]
        assert scopes.count("row") == len(found.all("tr")) - tables
        assert None not in scopes


def test_the_overlay_is_in_the_page_and_says_what_is_wrong(report: tuple[Reader, Any]) -> None:
    """The sheet stands in it as a picture that says what matters most."""
    page, data = report
    picture, *_ = [held for held in page.all("svg") if held.get("role") == "img"]
    step = next(step for step in data["steps"] if step["verdict"] == "wrong")
    assert (picture["aria-label"] or "").startswith(f"First wrong is {step['mark']} (step ")
    assert step["mark"] == WRONG


def test_a_wrong_point_of_the_pose_is_told_by_its_letter(tmp_path: Path) -> None:
    """It has no step, and so no number."""
    rows = [f'"{step["makes"]}",{step["paper"][0] + 15 * (step["makes"] == "M"):.2f},{210 - step["paper"][1]:.2f}'
            for step in got("four-bar").steps["steps"] if step["operation"] == "given"]
    (tmp_path / "given.csv").write_text("\n".join(["mark,x,y", *rows]) + "\n", encoding="utf-8")
    done = ran("verify", "four-bar", tmp_path / "given.csv")
    assert "M" in done.out.splitlines()[0]
    assert "step" not in done.out.splitlines()[0].partition(":")[0]
