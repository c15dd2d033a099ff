"""The JSXGraph page in a headless browser: marks are where the program has them, also when a point is dragged."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest
from objects import NAMES, PLACES, drafted_plates, farthest, gap, loose, moved, programs

from graphplan.kernel.program import Panel
from graphplan.output.exports.jsxgraph import LIBRARY, jsxgraph
from graphplan.output.exports.walk import identifiers

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


@PLACES
def test_every_operation(place: Callable[[int], Panel]) -> None:
    """Every operation of the table gives what its rule gives, wherever its operands lie."""
    drawn = [loose(*next(programs(name)), place) for name in NAMES]
    names = [identifiers(plates.drawn) for plates in drawn]
    pages = [{"html": jsxgraph(plates, library()), "marks": {called[mark]: mark.kind for mark in plates.drawn}}
             for plates, called in zip(drawn, names, strict=True)]
    for plates, called, answer in zip(drawn, names, opened(pages), strict=True):
        for mark in plates.drawn:
            assert gap(mark, answer["given"][called[mark]]) < 1e-9, mark.step.op.name


@pytest.mark.parametrize(("scene", "strict"), [("rosenauer-basic", False), ("jaanimets-10", False), ("four-bar", True)])
def test_marks_and_dragging(scene: str, strict: bool) -> None:
    """Every point is where the program has it, in the given pose and after a drag; steps come and go."""
    drawing, plates, _ = drafted_plates(scene, strict)
    free, (x, y), values = moved(drawing, plates)
    names = identifiers(plates.drawn)
    marks = {names[mark]: mark.kind for mark in plates.drawn if mark.kind == "point"}
    page = {"html": jsxgraph(plates, library()), "marks": marks, "drag": {"id": names[free], "x": x, "y": y}}
    [answer] = opened([page])
    for found, truth in ((answer["given"], drawing.values), (answer["dragged"], values)):
        points = {mark: complex(*found[names[mark]]) for mark in plates.drawn if names[mark] in marks}
        assert farthest(plates, points, truth) < 1e-6
    steps = [mark for mark in plates.drawn if mark.number]
    assert answer["number"] == f"{len(steps) - 1} / {len(steps)}"
    assert answer["last"] == steps[-2].sentence
    assert answer["none"] > answer["hidden"]


def test_what_the_page_says_without_the_library() -> None:
    """Without the library inside, the page names the file beside it, and tells in words when it is missing."""
    page = jsxgraph(drafted_plates("four-bar")[1])
    assert f'<script src="{LIBRARY}">' in page
    [answer] = opened([{"html": page, "marks": {}}])
    assert f"needs the file {LIBRARY} beside it" in answer["text"]


def test_a_script_inside_cannot_end_the_page() -> None:
    """A library that speaks of the end of a script stays whole, and so do titles with brackets."""
    page = jsxgraph(drafted_plates("four-bar")[1], "let end = '</script>';")
    assert page.count("</script>") == 2
    assert "'<\\/script>'" in page


def test_parents_and_same_text() -> None:
    """Elements name the elements that they depend on; the same plates is the same text."""
    _, plates, _ = drafted_plates("rosenauer-basic")
    page = jsxgraph(plates)
    assert re.search(r'M\.Q = seen\(\d+, board\.create\("intersection", \[M\.\w+, M\.\w+, 0\]', page)
    assert page == jsxgraph(plates)
