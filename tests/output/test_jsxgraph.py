"""The JSXGraph page in a browser: marks are where the program has them, wherever the linkage is dragged."""

from __future__ import annotations

import math
import os
import re
import shutil
from collections.abc import Callable, Iterator
from functools import cache
from itertools import combinations
from pathlib import Path
from random import Random
from typing import Any

import pytest
from laid_out import laid_out
from objects import NAMES, PLACES, Place, drafted_plates, farthest, gap, loose, programs
from tiers import sample

from graphplan.cycle.turn import follow, under
from graphplan.mechanism.scene import packaged
from graphplan.output.exports.jsxgraph import LIBRARY, jsxgraph, ways
from graphplan.output.exports.walk import identifiers
from graphplan.sheet.cycle_frames import posed
from graphplan.sheet.plates.plate import Plates

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FOLDERS = [*os.environ.get("NODE_PATH", "").split(os.pathsep), "/usr/local/lib/node_modules", "/usr/lib/node_modules"]
DRAGS = 9  # of each scene
SCENES = sample(["five-bar"], packaged())
CLOSE = 1e-6  # of the paper
SEEN = "figure.board.objectsList.filter(one => one.evalVisProp('visible') === true).length"
MARKS = """kinds => Object.fromEntries(Object.entries(kinds).map(([id, kind]) => {
  const mark = figure.marks[id];
  if (kind === "point") return [id, [mark.X(), mark.Y()]];
  if (kind === "opening") return [id, [mark()]];
  if (kind === "circle") return [id, [mark.center.X(), mark.center.Y(), mark.Radius()]];
  const [c, a, b] = mark.stdform, n = a * a + b * b;
  return [id, [-a * c / n, -b * c / n, b, -a]];
}))"""
DRAG = """([name, x, y]) => {
  figure.drag(name, x, y);
  const {points, guides} = {points: figure.motion.points(), guides: figure.motion.guides()};
  return {points, guides, program: figure.program, serves: figure.serves, stopped: Boolean(figure.motion.stop)};
}"""


@cache
def library() -> str:
    """The text of JSXGraph where Node keeps it."""
    places = (Path(folder) / "jsxgraph" / "distrib" / LIBRARY for folder in FOLDERS if folder)
    found = next((place for place in places if place.is_file()), None)
    return found.read_text(encoding="utf-8") if found else ""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A browser without a window."""
    api = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None or not library():
        pytest.skip("needs Chromium, and jsxgraph where NODE_PATH or /usr/lib/node_modules has it")
    with api.sync_playwright() as play:
        running = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield running
        running.close()


@pytest.fixture
def opened(browser: Any, tmp_path: Path) -> Iterator[Callable[[str], Any]]:
    """What opens a page with the library beside it; it may say nothing on the console and ask for nothing else."""
    (tmp_path / LIBRARY).write_text(library(), encoding="utf-8")
    file, complaints = tmp_path / "page.html", list[str]()
    page = browser.new_page(viewport={"width": 1200, "height": 900})
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda one: None if one.url.startswith(tmp_path.as_uri()) else complaints.append(one.url))

    def found(html: str) -> Any:
        file.write_text(html, encoding="utf-8")
        page.goto(file.as_uri())
        return page

    yield found
    page.close()
    assert complaints == []


def points_of(page: Any, plates: Plates) -> dict[Any, complex]:
    """Where the points of a construction are on the board."""
    names = identifiers(plates.drawn)
    found = page.evaluate(MARKS, {names[mark]: mark.kind for mark in plates.drawn if mark.kind == "point"})
    return {mark: complex(*found[names[mark]]) for mark in plates.drawn if names[mark] in found}


@PLACES
def test_every_operation(opened: Callable[[str], Any], place: Place) -> None:
    """Every operation of the table gives what its rule gives, wherever its operands lie."""
    for plates in (loose(*next(programs(name)), place) for name in NAMES):
        names = identifiers(plates.drawn)
        found = opened(jsxgraph(plates)).evaluate(MARKS, {names[mark]: mark.kind for mark in plates.drawn})
        for mark in plates.drawn:
            assert gap(mark, found[names[mark]]) < 1e-9, mark.step.op.name


@pytest.mark.parametrize("name", SCENES)
def test_a_drag_breaks_nothing(opened: Callable[[str], Any], name: str) -> None:
    """Joints dragged by chance: links stay rigid, every mark is where the program has it in that pose, and one of the
    constructions is shown where any of them can be drawn, but at limits, where nothing is to be drawn."""
    _, plates = laid_out(name)
    page, every, chance = opened(jsxgraph(plates)), ways(plates), Random(name)
    scene = plates.scene
    places = {point: complex(*map(float, at)) for point, at in scene.points.items()}
    size = max(abs(p - q) for p in places.values() for q in places.values())
    assert farthest(plates, points_of(page, plates), plates.plans.drawing.values) < CLOSE
    for _ in range(DRAGS):
        point = chance.choice([*places])
        goal = places[point] + size * chance.uniform(0, 0.1) * complex(math.cos(t := chance.uniform(0, 7)), math.sin(t))
        found = page.evaluate(DRAG, [point, goal.real, goal.imag])
        places = {point: complex(*at) for point, at in found["points"].items()}
        guides = {slide: complex(*way) for slide, way in found["guides"].items()}
        for link in scene.moving:
            for one, two in combinations(scene.links[link], 2):
                given = abs(complex(*map(float, scene.points[one])) - complex(*map(float, scene.points[two])))
                assert abs(abs(places[one] - places[two]) - given) < 1e-9 * size or {one, two} & {*under(scene)}
        drawn = posed(every[found["program"]].plans.drawing, places, guides)
        if found["serves"]:
            assert drawn
            one = every[found["program"]]
            assert farthest(one, points_of(page, one), drawn.values) < CLOSE, (point, goal)
        else:
            assert found["stopped"] or not any(posed(one.plans.drawing, places, guides) for one in every)


def test_loads_follow_the_pose(opened: Callable[[str], Any]) -> None:
    """Where a load has another value in another pose, its force and what follows from it are drawn so."""
    _, plates = laid_out("ozols-13-6")
    page = opened(jsxgraph(plates))
    turn = follow(plates.scene, 3, (100.0, 280.0))
    assert {*turn.loads["P_3"].real} == {-1000, 1000}
    for k, travel in enumerate((100, 190, 280)):
        page.evaluate(f"figure.travel = {travel}")
        points, guides, loads = ({name: z[k].item() for name, z in own.items()}
                                 for own in (turn.points, turn.guides, turn.loads))
        drawn = posed(plates.plans.drawing, points, guides, loads)
        assert drawn
        assert farthest(plates, points_of(page, plates), drawn.values) < CLOSE


def test_the_mouse_turns_the_crank(opened: Callable[[str], Any]) -> None:
    """A joint that is drawn along with the mouse takes the linkage with it; the slider and the travel say so."""
    _, plates = laid_out("slider-crank")
    page = opened(jsxgraph(plates))
    x, y = page.evaluate("(() => { const {board} = figure, P = board.select('A'), box = board.containerObj"
                         ".getBoundingClientRect(), [, x, y] = P.coords.scrCoords; return [box.x + x, box.y + y]; })()")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 25, y - 10, steps=4)
    page.mouse.up()
    travel = page.evaluate("figure.travel")
    assert 2 < abs(travel) < 60
    assert float(page.input_value("#travel")) == pytest.approx(travel % 360, abs=1e-6)
    places = {name: complex(*at) for name, at in page.evaluate("figure.motion.points()").items()}
    drawn = posed(plates.plans.drawing, places, {})
    assert drawn
    assert farthest(plates, points_of(page, plates), drawn.values) < CLOSE


def test_steps_plans_and_values_are_shown_as_asked(opened: Callable[[str], Any]) -> None:
    """Steps come and go by button and slider, plans and stages by check boxes, values at vectors by another."""
    _, plates, _ = drafted_plates("four-bar")
    page, steps = opened(jsxgraph(plates)), [mark for mark in plates.drawn if mark.number]
    whole = page.evaluate(SEEN)
    page.click("#back")
    assert page.text_content("#number") == f"{len(steps) - 1} / {len(steps)}"
    assert page.text_content("#sentence") == steps[-2].sentence
    page.evaluate("(() => { const step = document.getElementById('step'); step.value = 0; "
                  "step.dispatchEvent(new Event('input')); })()")
    assert page.evaluate(SEEN) < whole / 2
    page.evaluate("figure.show(1000)")
    assert page.evaluate(SEEN) == whole
    page.click("#plans input >> nth=1")
    assert page.evaluate(SEEN) < whole
    page.click("#plans input >> nth=1")
    page.click("#values")
    told = page.locator(".JXGtext", has_text="mm/s").all_text_contents()
    A = abs(plates.plans.drawing.velocity["A"])
    assert any(float(text.split()[0]) == pytest.approx(A, rel=1e-3) for text in told if "²" not in text)


def test_what_the_page_says_without_the_library(opened: Callable[[str], Any], tmp_path: Path) -> None:
    """Without the library inside, the page names the file beside it, and tells in words when it is missing."""
    page = jsxgraph(laid_out("four-bar")[1])
    assert f'<script src="{LIBRARY}">' in page
    (tmp_path / LIBRARY).write_text("", encoding="utf-8")
    assert f"needs the file {LIBRARY} beside it" in opened(page).text_content("[role=alert]")


def test_with_the_library_inside_it_needs_nothing_beside_it(opened: Callable[[str], Any], tmp_path: Path) -> None:
    """A page with the library inside works alone."""
    (tmp_path / LIBRARY).unlink()
    page = opened(jsxgraph(laid_out("four-bar")[1], library()))
    assert page.evaluate("figure.serves")


def test_a_script_inside_cannot_end_the_page() -> None:
    """A library that speaks of the end of a script stays whole, and so do titles with brackets."""
    bare, page = (jsxgraph(laid_out("four-bar")[1], text) for text in (None, "let end = '</script>';"))
    assert page.count("</script>") == bare.count("</script>")
    assert "'<\\/script>'" in page


def test_parents_and_same_text() -> None:
    """Elements name the elements that they depend on; the same plates is the same text."""
    _, plates = laid_out("rosenauer-basic")
    page = jsxgraph(plates)
    assert re.search(r'M\.Q = seen\(\d+, \d, -?\d+, board\.create\("intersection", \[M\.\w+, M\.\w+, 0\]', page)
    assert page == jsxgraph(plates)
