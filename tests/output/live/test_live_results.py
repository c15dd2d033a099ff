"""What a live page shows of its results: sizes at vectors, a graph over the travel, on a phone too."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import pytest
from live_browser import live

GRAPH = """() => {
  const [line, dot] = ['.cursor', 'circle'].map(one => document.querySelector(`#graph ${one}`));
  const {left, top, width, height} = document.getElementById('graph').getBoundingClientRect();
  return {x: Number(line.getAttribute('x1')), y: Number(dot.getAttribute('cy')), left, top, width, height,
    curve: document.querySelector('#graph .curve').getAttribute('d').slice(1).split('L')
      .map(at => at.split(' ').map(Number))};
}"""
WHOLE = "document.querySelector('#graph .curve')?.getAttribute('d').split('L').length > 180"
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


@pytest.fixture(scope="module")
def page() -> Iterator[Any]:
    with live("four-bar") as shown:
        yield shown


def test_the_graph_is_that_of_a_result_that_changes_and_leads_to_its_poses(page: Any) -> None:
    """Of a four-bar it begins with v_B; its cursor is on the curve, and a click goes to the pose of that place."""
    page.wait_for_function(WHOLE)
    page.wait_for_function("document.querySelector('#strip [aria-pressed=true] sub').textContent === 'B'")
    graph = page.evaluate(GRAPH)
    places = [x for x, _ in graph["curve"]]
    assert places == sorted(places)
    for fraction in (0.3, 0.8):
        x = places[0] + fraction * (places[-1] - places[0])
        page.mouse.click(graph["left"] + x, graph["top"] + graph["height"] / 2)
        assert page.evaluate("graphplan.travel") % 360 == pytest.approx(360 * fraction, abs=1.5)
        shown = page.evaluate(GRAPH)
        nearest = min(shown["curve"], key=lambda spot: abs(spot[0] - shown["x"]))
        assert math.dist(nearest, (shown["x"], shown["y"])) < 3


def test_each_result_has_its_graph_and_none_again(page: Any) -> None:
    """A click on a result shows its graph, another one puts it away."""
    page.click("#strip button:nth-of-type(4)")
    chosen, head = page.inner_text("#strip [aria-pressed=true]"), page.text_content("#graph text[font-weight]")
    assert chosen[:2] == head[:2] == "aA"
    page.click("#strip [aria-pressed=true]")
    assert not page.is_visible("#graph")
    page.click("#strip button")
    assert page.is_visible("#graph")


def test_sizes_stand_at_vectors(page: Any) -> None:
    """The sizes of velocities and accelerations that are drawn stand on the picture, of those steps that are there."""
    page.evaluate("graphplan.travel = 25; graphplan.step = graphplan.steps")
    results = page.evaluate("graphplan.results()")["points"]
    sizes = {f"{math.hypot(*vector):.4g}" for rates in results.values() for vector in rates.values()}
    told = page.eval_on_selector_all(".size:not([display]) text", "all => all.map(one => one.textContent)")
    assert len(told) > 3
    assert {f"{float(size):.4g}" for size in told} <= sizes
    page.evaluate("graphplan.step = 4")
    assert page.locator(".size:visible").count() < len(told)
    page.click("#values")
    assert page.locator(".size:visible").count() == 0
    page.click("#values")


def dragged_by_touch(page: Any, point: str, far: int) -> None:
    """A finger takes a point so many pixels to the right, in moves of five."""
    x, y = page.evaluate(f"graphplan.screen('{point}')")
    hand = page.context.new_cdp_session(page)
    for kind, step in (("touchStart", 0), *(("touchMove", step) for step in range(5, far + 1, 5)), ("touchEnd", far)):
        spots = [{"x": x + step, "y": y}] if kind != "touchEnd" else []
        hand.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": spots})
        page.wait_for_timeout(20)


def test_a_phone_has_one_row_of_controls_and_drags_by_touch() -> None:
    """The plan in use is as wide as the screen, the controls are one row until more are asked for, a finger drags."""
    with live("four-bar", **PHONE) as page:
        rows = "[...document.querySelectorAll('#controls :is(button, input, select)')].map(one => " \
            "one.getBoundingClientRect()).filter(({width}) => width).map(({top, height}) => top + height / 2)"
        middles = page.evaluate(rows)
        assert max(middles) - min(middles) < 4
        page.click("#more")
        assert len(page.evaluate(rows)) > len(middles)
        page.click("#more")
        panel = page.locator("rect.panel").first.bounding_box()
        assert panel["width"] > 0.9 * 390
        dragged_by_touch(page, "A", 60)
        assert abs(page.evaluate("graphplan.travel")) > 30
        assert page.evaluate("scrollY") == 0


def test_it_runs_at_the_speed_that_is_chosen() -> None:
    """At a tenth of the speed a turn takes ten times as long."""
    with live("four-bar", reduced_motion="no-preference") as page:
        page.select_option("#pace", "0.1")
        page.click("#run")
        page.wait_for_timeout(700)
        slow = page.evaluate("graphplan.travel")
        page.select_option("#pace", "4")
        page.wait_for_timeout(700)
        page.click("#run")
        assert page.evaluate("graphplan.travel") - slow > 4 * slow > 0
