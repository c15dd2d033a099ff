"""One reading, one verdict: every report of a drawing says the same, on the page, on the sheet and of a class."""

from __future__ import annotations

import json
import re
from collections import Counter
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from face import ran
from hand_drawings import mistaken, right, scene_file, task_of
from inked_sheet import InkedSheet
from judged_drawings import Judged, judged, written

NAME, SEEDS = "four-bar, polar", (1, 2, 3)


def plain(text: str) -> str:
    """What is read of a page or a sheet, without blanks and low letters."""
    return re.sub(r"\s+|_", "", re.sub(r"<[^>]*>", "", text)).replace("'", "′")


def reported(one: Judged, path: Path, ending: str) -> str:
    """A report of a drawing, as text."""
    report = path.with_name(f"report.{ending}")
    done = ran("verify", scene_file(one.drawing.task), path, "-q", "--report", report, *one.drawing.task.options)
    assert done.status == 0, done.err
    return report.read_text()


@pytest.mark.parametrize("seed", SEEDS)
def test_all_reports_name_the_same_mistake(seed: int, tmp_path: Path) -> None:
    """What is printed, the data, the page and the overlaid sheet, on which the step's sentence stands in a box."""
    drawing = mistaken(NAME, seed)
    one = judged(drawing, path := written(drawing, "csv", tmp_path))
    assert one.first
    printed = ran("verify", scene_file(drawing.task), path, "-q", *drawing.task.options).out
    opened = printed.splitlines()[1 if printed.startswith("Read as") else 0]
    assert opened.startswith("First wrong is ")
    place = opened.removeprefix("First wrong is ").partition(":")[0]
    assert json.loads(reported(one, path, "json"))["first_wrong"] == one.first
    page, sheet = reported(one, path, "html"), reported(one, path, "svg")
    assert plain(f"First wrong is {place}: ")[:-1] in plain(page)
    if one.first["mistake"]:
        assert plain(one.first["mistake"]) in plain(page)
        assert plain(one.first["mistake"]) in plain(sheet)
    assert f"{one.score:.0f}" in plain(page)
    assert InkedSheet.of(sheet).panels


def test_a_right_drawing_lies_on_the_true_one(tmp_path: Path) -> None:
    """On its report nothing is called out, and the page says that no step is wrong."""
    drawing = right(NAME, 1)
    one = judged(drawing, path := written(drawing, "csv", tmp_path))
    assert "No step is wrong" in reported(one, path, "html")
    assert "First wrong" not in reported(one, path, "svg")


def class_of(folder: Path) -> tuple[list[Judged], Any, str]:
    """Four drawings of one task, one of them right, and one file that cannot be read: each judged alone, and all as a
    class."""
    from drawing_board import Fault
    from hand_drawings import finish

    task = task_of(NAME, 1)
    faults = [None, Fault("reversed", "n_BA", -1), Fault("omitted", "n_BC", 0), Fault("reversed", "n_BC", -1)]
    (drawings := folder / "drawings").mkdir()
    alone = []
    for number, fault in enumerate(faults):
        drawing = finish(task, 1, fault)
        path = written(drawing, "csv", drawings)
        alone.append(judged(drawing, path.rename(drawings / f"{number}.csv")))
    (drawings / "9.csv").write_text("")
    options = [scene_file(task), drawings, "-q", *task.options]
    return alone, ran("verify", *options, "--json").json, ran("verify", *options).out


def test_a_class_is_told_as_its_drawings_are(tmp_path: Path) -> None:
    """A line for each drawing, the mean of what could be judged, the most frequent mistake and first wrong step, and
    what could not be read."""
    alone, data, printed = class_of(tmp_path)
    assert [(one["file"], one["first_wrong"], one["score"]) for one in data["drawings"]] == [
        (f"{number}.csv", one.first.get("step"), pytest.approx(one.score)) for number, one in enumerate(alone)]
    assert data["mean_score"] == pytest.approx(sum(one.score for one in alone) / len(alone))
    kinds = Counter(one.first["kind"] for one in alone if one.first)
    assert data["mistakes"] == dict(kinds)
    assert data["most_frequent_mistake"] == "normal acceleration reversed" == kinds.most_common(1)[0][0]
    steps = Counter(one.first["step"] for one in alone if one.first)
    assert steps[data["most_frequent_first_wrong"]] == max(steps.values())
    assert [one["file"] for one in data["not_judged"]] == ["9.csv"]
    assert "it is empty" in data["not_judged"][0]["why"]
    lines = printed.splitlines()
    assert [line[:6] for line in islice((line for line in lines if ".csv: " in line), 4)] == [
        f"{number}.csv:" for number in range(4)]
    assert "Drawings: 4; without a wrong step: 1." in lines
    assert "Not judged: 1." in lines


def test_a_teacher_scores_drawings_of_a_folder(tmp_path: Path) -> None:
    """His score and note stand in the data in place of the judge's, whose own is kept beside."""
    alone, _, _ = class_of(tmp_path)
    task = alone[0].drawing.task
    done = ran("verify", scene_file(task), tmp_path / "drawings", "-q", "--json", "--score", "1.csv=85", "--note",
               "1.csv=Well drawn.", *task.options)
    row = next(one for one in done.json["drawings"] if one["file"] == "1.csv")
    assert (row["score"], row["note"]) == (85.0, "Well drawn.")
    assert row["judged_score"] == pytest.approx(alone[1].score)
