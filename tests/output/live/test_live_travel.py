"""Live pages over the whole travel: they hold still, say what is so, and are dragged by the mouse to every pose."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import pytest
from pages import chromium, opened, page_of
from tiers import sample

from graphplan.mechanism.scene import packaged_names

POSES = 25
SCENES = sample(["alt-eight-link", "geneva", "slider-crank"], packaged_names())
TURN = 1e-4  # degrees or lengths: half of the step of differences
SEEN = """travel => {
  graphplan.travel = travel;
  const panels = [...document.querySelectorAll('rect.panel')]
    .map(rect => ['x', 'y', 'width', 'height'].map(key => Number(rect.getAttribute(key))));
  const drawn = [...document.querySelectorAll('g.vector[data-vector] :is(polyline, polygon)')]
    .filter(one => one.checkVisibility())
    .flatMap(one => one.getAttribute('points').split(' ').map(spot => spot.split(',').map(Number)));
  const outside = drawn.filter(([x, y]) => !panels.some(([left, top, wide, high]) =>
    x > left - 0.1 && x < left + wide + 0.1 && y > top - 0.1 && y < top + high + 0.1));
  return {travel: graphplan.travel, points: graphplan.points(), results: graphplan.results(), outside: outside.length,
    screen: Object.fromEntries(Object.keys(graphplan.points()).map(name => [name, graphplan.screen(name)]))};
}"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as running:
        yield running


def travels(page: Any) -> list[float]:
    """Where the mechanism is looked at, from one end of its travel to the other."""
    low, high = (limit if limit is not None else end
                 for limit, end in zip(page.evaluate("graphplan.limits()"), (-180, 180), strict=True))
    return [low + (high - low) * (k + 0.5) / POSES for k in range(POSES)] if low < high else []


@pytest.mark.parametrize("name", SCENES)
def test_the_frame_stands_still_and_vectors_stay_on_their_plans(browser: Any, name: str) -> None:
    """In 25 poses over the travel points of the frame are where they were, and nothing of a vector leaves its panel."""
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
        poses = [page.evaluate(SEEN, travel) for travel in travels(page)]
        for pose in poses:
            assert pose["outside"] == 0
            for point, place in pose["points"].items():
                if all(other["points"][point] == place for other in poses):
                    assert pose["screen"][point] == pytest.approx(poses[0]["screen"][point], abs=1e-6)


@pytest.mark.parametrize("name", SCENES)
def test_velocities_are_those_of_the_page_s_own_positions(browser: Any, name: str) -> None:
    """Velocities are, but for one factor, what points go by small steps of the travel."""
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
        for travel in travels(page)[::4]:
            back, here, on = (page.evaluate(SEEN, travel + turn) for turn in (-TURN, 0, TURN))
            if not here["results"]:
                continue
            pairs = [(complex(*rates["velocity"]), complex(*on["points"][point]) - complex(*back["points"][point]))
                     for point, rates in here["results"]["points"].items()
                     if rates.get("velocity") and list(here["points"].values()).count(here["points"][point]) == 1]
            largest = max(pairs, key=lambda pair: abs(pair[1]), default=None)
            if largest is None or not abs(largest[1]):
                continue
            pace = abs(largest[0]) / abs(largest[1])
            for velocity, way in pairs:
                assert abs(velocity) == pytest.approx(pace * abs(way), abs=2e-4 * abs(largest[0]))


def test_what_a_limit_leaves_unknown_is_null_and_a_dash(browser: Any) -> None:
    """At a limit the driven points keep their velocities; others are null, and a dash in the table."""
    with opened(browser, page_of("live", "alt-eight-link", "--choices", "none")) as page:
        page.evaluate("graphplan.travel = graphplan.limits()[1]; graphplan.travel = 1000")
        points = page.evaluate("graphplan.results().points")
        assert math.hypot(*points["F"]["velocity"]) > 0
        assert points["C"]["velocity"] is None
        assert "–" in page.inner_text("#tables")
        assert "\u00b710" not in page.inner_text("#tables") + page.inner_text("#list")
        assert page.evaluate("graphplan.step === graphplan.steps")


@pytest.mark.parametrize(("name", "point"), [("alt-eight-link", "F"), ("alt-eight-link", "C"), ("shaper", "B")])
def test_a_steady_drag_goes_steadily_and_comes_back(browser: Any, name: str, point: str) -> None:
    """Dragged along its path by the mouse, and back, a point stays within 3 pixels of the pointer."""
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
        ends = travels(page)
        middle, end = ends[POSES // 2], ends[-4]
        path = [page.evaluate(SEEN, middle + (end - middle) * k / 15) for k in range(16)]
        page.evaluate("travel => { graphplan.travel = travel; }", path[0]["travel"])
        page.mouse.move(*path[0]["screen"][point])
        page.mouse.down()
        for way in (path, path[::-1]):
            for pose in way:
                page.mouse.move(*pose["screen"][point])
                page.evaluate("new Promise(requestAnimationFrame)")
                page.evaluate("new Promise(requestAnimationFrame)")
                assert math.dist(page.evaluate(f"graphplan.screen('{point}')"), pose["screen"][point]) < 3
        page.mouse.up()


def test_points_that_lie_together_have_the_handle_of_the_one_that_moves(browser: Any) -> None:
    """Geneva's pin is taken by the mouse."""
    with opened(browser, page_of("live", "geneva", "--choices", "none")) as page:
        for point in page.evaluate("Object.keys(graphplan.points())"):
            x, y = page.evaluate(f"graphplan.screen('{point}')")
            near = page.evaluate("([x, y]) => document.elementFromPoint(x, y)?.dataset.point", [x, y])
            assert near is not None
