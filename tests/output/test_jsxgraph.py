"""The JSXGraph page in a headless browser: marks are where the program has them, also when a point is dragged."""

from __future__ import annotations

import json
import re
import subprocess
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest
from objects import NAMES, all_operations, drafted_figure, farthest, gap, moved

from graphplan.output.exports.jsxgraph import LIBRARY, jsxgraph

READER = Path(__file__).parent / "jsxgraph_reader.cjs"


@lru_cache
def library() -> str:
    """The text of JSXGraph where Node finds it with jsdom; else the test is skipped."""
    code = "require('jsdom'); console.log(require.resolve.paths('x').join('\\n'))"
    try:
        told = subprocess.run(["node", "-e", code], capture_output=True, text=True, check=True).stdout.splitlines()
    except (OSError, subprocess.CalledProcessError):
        told = []
    places = [Path(folder) / "jsxgraph" / "distrib" / LIBRARY for folder in told]
    found = next((place for place in places if place.is_file()), None)
    return found.read_text(encoding="utf-8") if found else ""


def opened(pages: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """What the browser says of some pages."""
    if not library():
        pytest.skip("needs Node with jsxgraph and jsdom: npm install jsxgraph jsdom, with NODE_PATH naming the folder")
    done = subprocess.run(["node", str(READER)], input=json.dumps(pages), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    answers: list[dict[str, Any]] = json.loads(done.stdout)
    assert [answer["problems"] for answer in answers] == [[]] * len(pages)
    return answers


@pytest.mark.parametrize("apart", [False, True], ids=["one plan", "several plans"])
def test_every_operation(apart: bool) -> None:
    """Every operation of the table gives what its rule gives, wherever its operands lie."""
    figure = all_operations(apart)
    marks = {object.id: object.kind for object in figure.objects}
    [answer] = opened([{"html": jsxgraph(figure, library()), "marks": marks}])
    assert {object.step.op.name for object in figure.objects} >= set(NAMES)
    for object in figure.objects:
        assert gap(object, answer["given"][object.id]) < 1e-9, object.step.op.name


@pytest.mark.parametrize(("scene", "strict"), [("rosenauer-basic", False), ("jaanimets-10", False), ("four-bar", True)])
def test_marks_and_dragging(scene: str, strict: bool) -> None:
    """Every point is where the program has it, in the given pose and after a drag; steps come and go."""
    drawing, figure, _ = drafted_figure(scene, strict)
    free, (x, y), values = moved(drawing, figure)
    marks = {object.id: object.kind for object in figure.objects if object.kind == "point"}
    page = {"html": jsxgraph(figure, library()), "marks": marks, "drag": {"id": free.id, "x": x, "y": y}}
    [answer] = opened([page])
    for found, truth in ((answer["given"], drawing.values), (answer["dragged"], values)):
        points = {object: complex(*found[object.id]) for object in figure.objects if object.id in marks}
        assert farthest(figure, points, truth) < 1e-6
    steps = figure.steps
    assert answer["number"] == f"{len(steps) - 1} / {len(steps)}"
    assert answer["last"] == steps[-2].sentence
    assert answer["none"] > answer["hidden"]


def test_what_the_page_says_without_the_library() -> None:
    """Without the library inside, the page names the file beside it, and tells in words when it is missing."""
    page = jsxgraph(drafted_figure("four-bar")[1])
    assert f'<script src="{LIBRARY}">' in page
    [answer] = opened([{"html": page, "marks": {}}])
    assert f"needs the file {LIBRARY} beside it" in answer["text"]


def test_a_script_inside_cannot_end_the_page() -> None:
    """A library that speaks of the end of a script stays whole, and so do titles with brackets."""
    page = jsxgraph(drafted_figure("four-bar")[1], "let end = '</script>';")
    assert page.count("</script>") == 2
    assert "'<\\/script>'" in page


def test_parents_and_same_text() -> None:
    """Elements name the elements that they depend on; the same figure is the same text."""
    _, figure, _ = drafted_figure("rosenauer-basic")
    page = jsxgraph(figure)
    assert re.search(r'M\.Q = seen\(\d+, board\.create\("intersection", \[M\.\w+, M\.\w+, 0\]', page)
    assert page == jsxgraph(figure)
