"""Sheets of subjects as their SVG has them: flywheels, motion, balancing and tasks in panels, with steps and words."""

from __future__ import annotations

import io
import json
import math
import re
from functools import cache
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
import shapely
from face import ran
from inked_sheet import NS, InkedSheet, label, said

YOKE = "flywheel", "ozols-13-6"
SHEETS = (
    YOKE, (*YOKE, "--by", "gutjahr"), (*YOKE, "--by", "areas"), (*YOKE, "--set", "sheet.paper=A1"),
    (*YOKE, "--set", "sheet.paper=A3"), (*YOKE, "--by", "areas", "--set", "sheet.paper=A3"),
    ("motion", "ozols-13-7"), ("balance", "ozols-16-1"),
    ("synthesize", "guidance-22-8"), ("synthesize", "gear-21-1"),
)
PANELS = {"flywheel": ["mechanism", "lever", "levers", "flywheel"], "balance": ["mechanism", "shaking force", "cycle"]}
LOAD = '[[moments]]\non = "1"\nover = "travel"\nvalues = [[0, 50], [40, 50], [40, -50], [360, 50]]\n'


@cache
def pages(*words: str) -> list[InkedSheet]:
    """The sheets that a command draws, the first with the plans."""
    with TemporaryDirectory() as folder:
        done = ran(*words, "-q", "-o", Path(folder, "file.svg"))
        assert done.status == 0, done.err
        files = sorted(Path(folder).iterdir(), key=lambda path: (len(path.name), path.name))
        return [InkedSheet.of(file.read_text("utf-8")) for file in files]


@cache
def numbers(*words: str) -> Any:
    """The numbers that a command writes."""
    with TemporaryDirectory() as folder:
        assert ran(*words, "-q", "-o", Path(folder, "file.json")).status == 0
        return json.loads(Path(folder, "file.json").read_text("utf-8"))


def words_of(sheets: list[InkedSheet]) -> list[str]:
    """All lines of letters."""
    return [said(text) for sheet in sheets for text in sheet.root.iter(f"{NS}text")]


@pytest.mark.parametrize("words", SHEETS, ids=" ".join)
def test_no_letters_meet_and_no_ink_leaves_its_panel(words: tuple[str, ...]) -> None:
    """No two words or letters stand on each other, on any paper, and what is drawn lies inside its panel."""
    sheet = pages(*words)[0]
    boxes = [(one.text, one.box.buffer(-0.05)) for one in (label(*text) for text in sheet.texts) if one.text.strip()]
    tree = shapely.STRtree([box for _, box in boxes])
    met = [(boxes[i][0], boxes[k][0]) for i, (_, box) in enumerate(boxes) for k in tree.query(box, "intersects")
           if i < k and box.intersection(boxes[k][1]).area > 0.02]
    assert met == []
    panels = [panel.buffer(0.3) for panel in sheet.panels.values()]
    drawn = [stroke.line for stroke in sheet.strokes if stroke.key in ("layer-plates", "layer-links", "layer-ruling")]
    assert drawn
    assert [line for line in drawn if not any(panel.contains(line) for panel in panels)] == []
    assert [*sheet.panels][:4] == PANELS.get(words[0], [*sheet.panels])[:4]


@pytest.mark.parametrize("words", [YOKE, ("motion", "ozols-13-7")], ids=" ".join)
def test_every_step_is_drawn_and_told(words: tuple[str, ...]) -> None:
    """Steps are numbered one after another, nearly each has its ink, and the words speak of mm of paper."""
    sheets = pages(*words)
    inked = {int(key) for key, _ in sheets[0].elements if key.isdigit()} - {0}
    told = words_of(sheets)
    assert len(inked) > 0.9 * max(inked) > 10
    assert any(re.search(r"\d\.\d mm", line) for line in told)


def test_words_have_the_numbers() -> None:
    """The closing moment, the flywheel by each method, and a row for each position stand on the sheet."""
    found, lines = numbers(*YOKE), words_of(pages(*YOKE))
    text = " ".join(lines)
    assert f"Closing moment: {found['closing_moment']:.4g} N m" in text
    told = [float(number) for number in re.findall(r"\d+\.?\d*", text)]
    for one in (found["flywheel"], *found.get("methods", {}).values()):
        assert any(math.isclose(abs(one["inertia"]), number, rel_tol=6e-4) for number in told)
    positions = len(found["reduced_inertia"]) - 1
    assert all(str(k) in lines for k in range(positions + 1))


def test_curves_are_numbered_as_the_table(tmp_path: Path) -> None:
    """Where a load has corners between plans, the numbers at the curve are still those of the table's rows."""
    assert ran("new", tmp_path / "yoke.toml", "--from", "ozols-13-6", "-q").status == 0
    scene = (tmp_path / "yoke.toml").read_text("utf-8")
    (tmp_path / "yoke.toml").write_text(f"{scene}\n{LOAD}", encoding="utf-8")
    sheet = pages("flywheel", str(tmp_path / "yoke.toml"), "--positions", "12")[0]
    panel = sheet.panels["flywheel"]
    told = [one.text for one in sheet.labels if panel.contains(one.box) and one.text.isdigit()]
    assert {*map(str, range(12))} <= {*told}
    assert max(map(int, told)) <= 360


def test_the_sheet_says_by_which_construction_it_is_drawn() -> None:
    """Of the other constructions each says its own."""
    assert "Gutjahr's curves" in " ".join(words_of(pages(*YOKE, "--by", "gutjahr")))
    assert "vectors of areas" in " ".join(words_of(pages(*YOKE, "--by", "areas")))


def test_tasks_have_what_is_given_alone() -> None:
    """A task has the panels of the solution and its scales, boxes for its numbers, and no vector or curve."""
    papers, solution = pages(*YOKE, "--task"), pages(*YOKE)
    task = papers[0]
    assert {name: panel.bounds for name, panel in task.panels.items()} == {
        name: panel.bounds for name, panel in solution[0].panels.items()}
    lines, found = words_of(papers), numbers(*YOKE)
    assert f"{found['flywheel']['inertia']:.4g}" not in " ".join(lines)
    scales = [line for line in lines if "k" in line and "/mm" in line]
    assert scales
    assert {*scales} <= {*words_of(solution)}
    assert not [vector.name for vector in task.vectors if " " in vector.name]
    assert not [one for key, one in task.elements if key == "layer-links" and one.tag == f"{NS}polyline"
                and len(one.get("points", "").split()) > 20]
    blanks = [one for paper in papers for key, one in paper.elements if key == "layer-blanks"]
    assert len(blanks) >= 4 * len(found["reduced_inertia"])


def test_principal_vectors_stand_head_to_tail_at_a_round_scale() -> None:
    """On the sheet of a balancing the vectors of the mass centre follow each other, as long as the scale says."""
    sheet = pages("balance", "ozols-16-1")[0]
    panel = sheet.panels["mechanism"]
    chain = [vector.line.coords for vector in sheet.vectors if panel.contains(vector.line)]
    joints = sum(math.dist(one[1], two[0]) < 0.02 for one, two in combinations(chain, 2))
    assert joints == len(chain) - 1 >= 1
    scales = [float(number) for line in words_of([sheet]) for number in re.findall(r"k_?s = ([\d.]+)", line)]
    assert scales
    assert all(math.isclose(scale / 10 ** math.floor(math.log10(scale)) % 0.5, 0, abs_tol=1e-9) for scale in scales)


def test_a_dxf_of_a_subject_has_a_layer_for_each_step(tmp_path: Path) -> None:
    """Steps are layers, and the wheels of a pair of gears are closed outlines in their own size."""
    ezdxf = pytest.importorskip("ezdxf")
    for words in (("balance", "ozols-16-1"), ("synthesize", "gear-21-1")):
        assert ran(*words, "-q", "-o", tmp_path / "sheet.dxf").status == 0
        document = ezdxf.read(io.StringIO((tmp_path / "sheet.dxf").read_text("utf-8")))
        assert not document.audit().errors
        if words[0] == "balance":
            used = {entity.dxf.layer for entity in document.modelspace()}
            inked = {key for key, _ in pages(*words)[0].elements if key.isdigit()} - {"0"}
            assert {f"STEP {int(key):03}" for key in inked} <= used
            continue
        wheels = [one for one in document.modelspace().query("LWPOLYLINE") if one.dxf.layer == "MECHANISM 1-1 wheel"]
        assert len(wheels) == 2
        assert all(wheel.closed for wheel in wheels)
        circles = [one for one in document.modelspace().query("CIRCLE") if one.dxf.layer.endswith("pitch circle")]
        assert sorted(one.dxf.radius for one in circles) == pytest.approx([52, 64])
