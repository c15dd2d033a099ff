"""What a live page looks like: plans fill their panels, letters and sizes stand apart, wheel, clicks and fingers choose
the window, and all that is told over the travel has one cursor.
"""

from __future__ import annotations

import math
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import pytest
from claims_of_live_pages import KINDS, SEEN, numbers, size, travels, unknown, vectors
from face import ran
from linkages import with_points_in_line
from live_browser import live
from test_live_results import PHONE

SCENES = "four-bar", "shaper", "kinytskyi", "geared-five-bar", "class-four"
TEXTS = """() => [...document.querySelectorAll('#picture g.step text, #picture g.layer-letters text')]
  .filter(text => text.checkVisibility() && text.textContent)
  .map(text => [text.textContent, Boolean(text.closest('.size')), text.getBoundingClientRect()])
  .map(([words, size, {left, top, right, bottom}]) => [words, size, left, top, right, bottom])"""
ENDS = """() => [...document.querySelectorAll('g.vector[data-vector]:not([display=none])')]
  .map(one => ['from', 'to'].map(end => one.dataset[end].split(' ').map(Number)))"""
PANELS = """() => [...document.querySelectorAll('rect.panel')].map(one => ['x', 'y', 'width', 'height']
  .map(key => Number(one.getAttribute(key))))"""
SHORT_SHARE = 0.05  # of the longest vector of a kind: one so short need not be drawn
MORE_PX = 1.5, 5.0  # a browser's box of a text is so much higher than its letters
BOX = "document.getElementById('picture').getAttribute('viewBox').split(' ').map(Number)"


@pytest.mark.parametrize("seed", range(12))
def test_a_page_knows_and_draws_what_is_known_of_points_in_line(seed: int, tmp_path: Path) -> None:
    """Over the travel of a random linkage with points in line each number that `solve` knows of the pose is on the
    page, each vector that is not too short is drawn, and where something is missing the page says why."""
    path = tmp_path / f"in-line-{seed}.toml"
    path.write_text(with_points_in_line(seed).text())
    with live(str(path)) as page:
        page.evaluate("navigator.clipboard.writeText = text => { window.copied = text; return Promise.resolve(); }; 0")
        for travel in travels(page):
            pose = page.evaluate(SEEN, travel)
            known, page_says = vectors(pose), bool(pose["said"])
            assert page_says or (pose["results"] and not unknown(pose["results"]))
            longest = {kind: max([abs(rate) for name, rate in known.items() if name.startswith(kind)], default=0)
                       for kind in KINDS}
            lost = [name for name, rate in known.items() if name not in pose["drawn"]
                    and abs(rate) > max(SHORT_SHARE * longest[name.split()[0]], 1e-9)]
            assert page_says or not lost, travel
            page.click("#copy")
            solved = ran("solve", "-", given=page.evaluate("copied"))
            if solved.status or page_says:
                continue
            pairs = [*numbers(pose["results"], solved.json)]
            largest = {key: max(size(right) for _, kind, _, right in pairs if kind == key) for _, key, _, _ in pairs}
            for path_of_number, key, ours, right in pairs:
                assert ours is not None, path_of_number
                gap = math.dist(ours, right) if isinstance(right, list) else abs(ours - right)
                assert gap <= 1e-6 * max(largest[key], 1e-6), (travel, path_of_number)


@pytest.mark.parametrize("name", SCENES)
def test_plans_fill_their_panels_and_letters_stand_apart(name: str) -> None:
    """In all poses, but for a dwell, the vectors of the plan beside the mechanism's reach over a fifth of its panel; no
    size covers a letter or another size; the strip of results is whole, and nothing is drawn at first."""
    with live(name) as page:
        assert page.evaluate("graphplan.step") == 0
        strip = page.evaluate("(({scrollHeight, clientHeight}) => [scrollHeight, clientHeight])"
                              "(document.getElementById('strip'))")
        assert strip[0] <= strip[1]
        page.click("#last")
        assert page.evaluate("graphplan.step === graphplan.steps")
        left, top, wide, high = page.evaluate(PANELS)[1]
        for travel in travels(page)[::4]:
            page.evaluate("travel => { graphplan.travel = travel; }", travel)
            page.wait_for_timeout(400)  # letters settle
            ends = page.evaluate(ENDS)
            own = [(x / wide, y / high) for pair in ends for x, y in pair
                   if left <= x <= left + wide and top <= y <= top + high]
            assert name == "kinytskyi" or max(max(one) - min(one) for one in zip(*own, strict=True)) > 0.2, travel
            texts = page.evaluate(TEXTS)
            covered = [(one[0], two[0]) for one, two in combinations(texts, 2) if (one[1] or two[1]) and all(
                min(one[k + 2], two[k + 2]) - max(one[k], two[k]) > MORE_PX[k - 2] for k in (2, 3))]
            assert covered == [], travel
            assert sum(size for _, size, *_ in texts) > 0
        page.click("#last")
        assert page.evaluate("graphplan.step") == 0


def test_wheel_mouse_and_clicks_choose_the_window() -> None:
    """The wheel makes the window smaller about the pointer, the mouse moves it, a click makes a plan the large one and
    another brings all back; the mechanism does not move."""
    with live("four-bar") as page:
        whole, place = page.evaluate(BOX), page.evaluate("graphplan.screen('M')")
        pointer, times = [*map(round, place)], math.exp(300 / 500)
        page.mouse.move(*pointer)
        page.mouse.wheel(0, -300)
        assert page.evaluate(BOX)[2] == pytest.approx(whole[2] / times, rel=1e-6)
        place = [p + (x - p) * times for x, p in zip(place, pointer, strict=True)]
        assert page.evaluate("graphplan.screen('M')") == pytest.approx(place, abs=0.1)
        page.mouse.move(500, 620)
        page.mouse.down()
        page.mouse.move(460, 600, steps=4)
        page.mouse.up()
        assert page.evaluate("graphplan.screen('M')") == pytest.approx([place[0] - 40, place[1] - 20], abs=0.5)
        page.mouse.click(500, 620)
        mechanism = page.evaluate(PANELS)[0]
        assert page.evaluate(BOX) == pytest.approx(mechanism, abs=0.02)
        page.mouse.click(500, 620)
        assert page.evaluate(BOX) == pytest.approx(whole)
        assert page.evaluate("graphplan.travel") == 0


def touched(page: Any, *paths: list[tuple[float, float]]) -> None:
    """Fingers go along paths of the screen."""
    hand = page.context.new_cdp_session(page)
    steps = list(zip(*paths, strict=True))
    for kind, spots in [("touchStart", steps[0]), *(("touchMove", step) for step in steps[1:]), ("touchEnd", ())]:
        hand.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
            {"x": x, "y": y, "id": k} for k, (x, y) in enumerate(spots)]})
        page.wait_for_timeout(20)


def test_on_a_phone_plans_are_swiped_and_pinched() -> None:
    """A finger that goes to the left brings the next plan, to the right the one before; two going apart enlarge it."""
    with live("four-bar", **PHONE) as page:
        first, second = page.evaluate(PANELS)
        assert page.evaluate(BOX) == pytest.approx(first, abs=0.02)
        touched(page, [(300 - 15 * k, 380) for k in range(10)])
        assert page.evaluate(BOX) == pytest.approx(second, abs=0.02)
        touched(page, [(100 + 15 * k, 380) for k in range(10)])
        assert page.evaluate(BOX) == pytest.approx(first, abs=0.02)
        touched(page, [(180 - 5 * k, 380) for k in range(10)], [(200 + 5 * k, 380) for k in range(10)])
        assert page.evaluate(BOX)[2] < 0.5 * first[2]


def test_paths_hodographs_and_the_graph_have_one_cursor() -> None:
    """A dot on each trace is where the pose is; a click on a hodograph leads there, and the graph's cursor follows."""
    with live("four-bar") as page:
        page.click("#curves summary")
        for box in page.locator("#paths input").all()[:6]:
            box.check()
        page.click("#curves summary")
        page.wait_for_function("document.querySelector('#traces path')?.getAttribute('d').split('L').length > 180")
        page.evaluate("graphplan.travel = 130")
        traces = page.evaluate("""() => [...document.querySelectorAll('#traces path')].map(path =>
            [...Array(721).keys()].map(k => path.getPointAtLength(path.getTotalLength() * k / 720))
                .map(({x, y}) => [x, y]))""")
        dots = page.evaluate("[...document.querySelectorAll('#traces circle')].map(dot => "
                             "['cx', 'cy'].map(key => Number(dot.getAttribute(key))))")
        assert len(dots) == len(traces) == 6
        for trace, dot in zip(traces, dots, strict=True):
            assert min(math.dist(dot, spot) for spot in trace) < 1.0
        cursor = "Number(document.querySelector('#graph .cursor').getAttribute('x1'))"
        places = []
        for share in (0.2, 0.6):
            spots = page.evaluate("""() => { const path = document.querySelector('#traces path:nth-of-type(6)');
                const {a, e, f} = document.getElementById('picture').getScreenCTM();
                return [...Array(720).keys()].map(k => path.getPointAtLength(path.getTotalLength() * k / 720))
                    .map(({x, y}) => [a * x + e, a * y + f])
                    .filter(([x, y]) => document.elementFromPoint(x, y) === path); }""")
            page.mouse.click(*spots[round(share * len(spots))])
            places.append((page.evaluate("graphplan.travel"), page.evaluate(cursor)))
        assert all(one != two for one, two in pairwise(places))
        assert places[0][0] != 130
