"""Live pages dragged by the mouse, limits and several drives: every pose is reached, links keep their lengths."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from functools import cache
from itertools import combinations
from pathlib import Path
from random import Random
from typing import Any

import pytest
from claims_of_live_pages import POSES, SEEN, agree, travels
from face import got, names, ran
from live_browser import live

import graphplan as gp

CASES = Path(__file__).parents[2] / "cases"
STRANGERS = [str(CASES / "strangers" / name) for name in ("poses/sixbar.toml", "more/lo-own-dead.toml")]
OWN = [str(CASES / "pages" / name) for name in ("loaded.toml", "parallelogram.toml", "sprung.toml")]
DRAGGED = [*names()[::4], "ozols-13-6", "gear-linkage", OWN[1], *STRANGERS]
FINE = 1e-9
DRAGS = 3


@cache
def scene(name: str) -> gp.Scene:
    """A packaged scene, or one that lies among the cases."""
    return got(name).scene


def limits(page: Any, otherwise: float = 180.0) -> tuple[float, float]:
    """From where to where the travel goes; as far as is asked where it has no limit."""
    low, high = page.evaluate("graphplan.limits()")
    return (-otherwise if low is None else low), (otherwise if high is None else high)


def on_guides(name: str) -> set[str]:
    """The points that only mark a place under a sliding point or a contact."""
    own = scene(name)
    slides = {own.points[slide.at] for slide in own.slides}
    return {point for point, place in own.points.items() if place in slides or not own.links_of[point] or own.contacts}


@pytest.mark.parametrize("name", DRAGGED, ids=lambda name: Path(name).stem)
def test_however_it_is_dragged_links_keep_their_lengths(name: str) -> None:
    """Dragged anywhere, links keep their lengths and the frame its places but for a pin that is dragged; what is copied
    as a scene gives, solved anew, the results that the page shows; no drag leaves a number that is none."""
    dice, own = Random(Path(name).stem), scene(name)
    given = {point: complex(*map(float, place)) for point, place in own.points.items()}
    moving = [point for point in given if own.links_of[point]]
    far, solved = 0.15 * own.extent, 0
    with live(name) as page:
        for point in dice.choices(moving, k=DRAGS):
            goal = given[point] + complex(dice.uniform(-far, far), dice.uniform(-far, far))
            page.evaluate("([name, x, y]) => graphplan.drag(name, x, y)", [point, goal.real, goal.imag])
            at = {name: complex(*place) for name, place in page.evaluate("graphplan.points()").items()}
            assert all(map(cmath.isfinite, at.values()))
            for link in own.moving:
                for one, two in combinations([p for p in own.links[link] if p not in on_guides(name)], 2):
                    gap = abs(abs(at[one] - at[two]) - abs(given[one] - given[two]))
                    assert gap <= FINE * own.extent, (point, link, one, two)
            results = page.evaluate("graphplan.results()")
            assert results or page.evaluate("graphplan.said")
            solved += agrees_with_its_copy(page, results)
    without = "geneva-slide", "parallel-links", "lo-own-dead"
    assert solved or not own.drives or own.motions or Path(name).stem in without


def agrees_with_its_copy(page: Any, results: Any) -> bool:
    """Whether the pose's copy as a scene can be solved; its results are then those of the page."""
    if not results or page.evaluate("graphplan.said") or "reasons" in results or \
            max(results["check"].values(), default=0.0) > FINE:  # near a limit everybody loses digits
        return False
    page.evaluate("navigator.clipboard.writeText = () => Promise.reject(new Error('no')); 0")
    page.click("#copy")
    page.wait_for_function("document.querySelector('#toml')?.value")
    done = ran("solve", "-", given=page.input_value("#toml"))
    page.click("#close")
    if done.status:
        return False
    agree(results, done.json, 1e-6)
    return True


@pytest.mark.parametrize(("name", "point"), [("alt-eight-link", "F"), ("alt-eight-link", "C"), ("shaper", "B"),
                                             *((name, "") for name in names()[1::5])])
def test_a_steady_drag_goes_steadily_and_comes_back(name: str, point: str) -> None:
    """Dragged along its path by the mouse, and back, a point stays within 3 pixels of the pointer."""
    with live(name) as page:
        ends = travels(page)
        if not ends:
            return
        middle, end = ends[POSES // 2], ends[-3]
        if not point:
            last, first = (page.evaluate(SEEN, travel) for travel in (end, middle))
            alone = [name for name, place in first["screen"].items()
                     if sum(math.dist(place, other) < 5 for other in first["screen"].values()) == 1]
            point = max(alone, key=lambda name: math.dist(first["points"][name], last["points"][name]))
        path = [page.evaluate(SEEN, middle + (end - middle) * k / 15) for k in range(16)]
        page.evaluate("travel => { graphplan.travel = travel; }", path[0]["travel"])
        goals = [tuple(pose["screen"][point]) for way in (path, path[::-1]) for pose in way]
        assert max(map(abs, followed_by_mouse(page, point, goals))) < 3


def followed_by_mouse(page: Any, point: str, path: list[Any]) -> Iterator[complex]:
    """How far from the pointer a point is, in pixels, as the mouse drags it along places on the screen."""
    page.mouse.move(*page.evaluate(f"graphplan.screen('{point}')"))
    page.mouse.down()
    for x, y in path:
        page.mouse.move(x, y)
        page.evaluate("new Promise(requestAnimationFrame)")
        page.evaluate("new Promise(requestAnimationFrame)")
        yield complex(*page.evaluate(f"graphplan.screen('{point}')")) - complex(x, y)
    page.mouse.up()


def test_points_that_lie_together_have_the_handle_of_the_one_that_moves() -> None:
    """Geneva's pin is taken by the mouse."""
    with live("geneva") as page:
        for point in page.evaluate("Object.keys(graphplan.points())"):
            x, y = page.evaluate(f"graphplan.screen('{point}')")
            near = page.evaluate("([x, y]) => document.elementFromPoint(x, y)?.dataset.point", [x, y])
            assert near is not None


def test_gears_that_are_never_back_are_dragged_to_every_pose() -> None:
    """A point of a wheel that takes ninety turns to be back is found where it stood in this turn or another."""
    with live("gear-linkage") as page:
        goal = page.evaluate(SEEN, 172.8)
        for travel in (-14.4, -172.8, 1000.0):
            page.evaluate("travel => { graphplan.travel = travel; }", travel)
            page.evaluate("([name, x, y]) => graphplan.drag(name, x, y)", ["M", *goal["points"]["M"]])
            assert math.dist(page.evaluate("graphplan.screen('M')"), goal["screen"]["M"]) < 3


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link", "shaper"])
def test_a_pin_that_goes_too_far_is_said_and_comes_back(name: str) -> None:
    """A pin of the frame goes as far as the linkage follows; what is unknown there is null; back, all is as it was."""
    with live(name) as page:
        first, later = page.evaluate(SEEN, 0)["points"], page.evaluate(SEEN, 20)["points"]
        page.evaluate("graphplan.travel = 0")
        reach = max(math.dist(one, other) for one in first.values() for other in first.values())
        for pin in (point for point, place in first.items() if later[point] == place):
            x, y = first[pin]
            page.evaluate("([name, x, y]) => graphplan.drag(name, x, y)", [pin, x + 5 * reach, y])
            there, results = page.evaluate("graphplan.points()"), page.evaluate("graphplan.results()")
            if math.dist(there[pin], first[pin]) < 5 * reach * (1 - 1e-9):
                assert page.evaluate("graphplan.said")
                assert any(rates["velocity"] is None for rates in results["points"].values())
            page.evaluate("([name, x, y]) => graphplan.drag(name, x, y)", [pin, *first[pin]])
            assert page.evaluate("graphplan.said") == ""
            for point, place in page.evaluate("graphplan.points()").items():
                assert place == pytest.approx(first[point], abs=1e-9 * reach)
            page.evaluate("document.getElementById('home').click()")


# ---- over the travel -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [*names()[::4], "ozols-13-6", "gear-linkage", *OWN, *STRANGERS],
                         ids=lambda name: Path(name).stem)
def test_poses_are_those_of_python_in_whatever_order(name: str) -> None:
    """Points lie where `follow` has them to nine digits, limits are where the cycle has them, turns come back."""
    own = scene(name)
    if own.motions or not own.drives:
        return
    with live(name) as page:
        low, high = limits(page)
        for share in (0.9, 0.1, 0.6, 0.3):
            travel = low + share * (high - low)
            try:
                poses = gp.follow(own, 2, (0.0, travel))
            except gp.GraphplanError:
                return
            page.evaluate("travel => { graphplan.travel = travel; }", travel)
            at = page.evaluate("graphplan.points()")
            for point, z in poses.points.items():
                assert abs(complex(*at[point]) - z[1]) <= FINE * own.extent, (travel, point)
        if page.evaluate("graphplan.limits()") == [None, None] and not own.gears and not own.contacts:
            rounds = [page.evaluate(SEEN, travel)["points"] for travel in (30, 1830, -690)]
            for points in rounds[1:]:
                assert all(math.dist(points[point], rounds[0][point]) <= FINE * own.extent for point in points)
        for k in range(10):
            page.evaluate("document.getElementById('home').click()")
            page.evaluate("travel => { graphplan.travel = travel; }", 10.0 ** (-6 - k))
            assert not page.evaluate("graphplan.said") or low == 0 or high == 0, f"stopped after 1e-{6 + k}"


def test_change_points() -> None:
    """A parallelogram stops where its links lie in one line, with the reason, and knows the drive's rate alone."""
    with live(OWN[1]) as page:
        start = math.degrees(math.atan2(4, 3))
        assert page.evaluate("graphplan.limits()") == pytest.approx([-start, 180 - start])
        page.evaluate("graphplan.travel = 300")
        assert page.evaluate("graphplan.said") == \
            "links 2 and 3 are in a change point: the drive does not say how they move on"
        assert [rates["omega"] for rates in page.evaluate("graphplan.results().links").values()] == [10, None, None]


def test_loads_that_change_follow_the_pose() -> None:
    """Balances of the page are those of `solve --at` on either stroke, where loads depend on travel, speed or slide."""
    with live(OWN[0]) as page:
        low, high = limits(page)
        strokes = set()
        for share in (0.13, 0.37, 0.61, 0.88):
            travel = low + share * (high - low)
            results = page.evaluate(SEEN, travel)["results"]
            right = ran("solve", OWN[0], "--at", repr(travel)).json
            assert results["balance"]["moment"] == pytest.approx(right["balance"]["moment"], rel=1e-9)
            assert results["check"]["force"] < FINE
            strokes.add(results["points"]["B"]["velocity"][0] > 0)
        assert strokes == {True, False}


def test_springs_follow_their_ends() -> None:
    """A spring is a zigzag of as many coils in every pose, between its ends."""
    zigzag = "document.querySelector('.layer-machine polyline').getAttribute('points').split(' ').length"
    with live(OWN[2]) as page:
        coils = page.evaluate(zigzag)
        assert coils > 5
        for travel in (30, 90, 200):
            page.evaluate("travel => { graphplan.travel = travel; }", travel)
            assert page.evaluate(zigzag) == coils


def test_what_a_limit_leaves_unknown_is_null_and_a_dash() -> None:
    """At a limit the driven points keep their velocities; others are null, and a dash in the table."""
    with live("alt-eight-link") as page:
        page.evaluate("graphplan.step = graphplan.steps; graphplan.travel = graphplan.limits()[1]; "
                      "graphplan.travel = 1000")
        points = page.evaluate("graphplan.results().points")
        assert math.hypot(*points["F"]["velocity"]) > 0
        assert points["C"]["velocity"] is None
        assert "–" in page.inner_text("#tables")
        assert "\u00b710" not in page.inner_text("#tables") + page.inner_text("#list")
        assert page.evaluate("graphplan.step === graphplan.steps")


def test_where_a_guide_has_no_direction_nothing_is_told() -> None:
    """Where the two points of a guide come together there are no results, and the page says why."""
    with live("ozols-5-3") as page:
        page.evaluate("(([from, to]) => { graphplan.travel = (from + to) / 2; })(graphplan.limits())")
        assert page.evaluate("graphplan.results()") is None
        assert "direction coincide" in page.evaluate("graphplan.said")
        page.evaluate("graphplan.travel += 0.01")
        assert page.evaluate("graphplan.results()") is not None
        assert page.evaluate("graphplan.said") == ""


def test_moved_and_back_it_is_the_sheet_that_was_written() -> None:
    """Back home after a turn every stroke, arc, mark and vector stands where it stood; letters stay where they went."""
    seen = """() => [...document.querySelectorAll('g.step')].map(group => [group.dataset.step,
      [...group.querySelectorAll('polyline, circle, path')].filter(one => !one.closest('[display=none], [transform]'))
      .map(one => [one.localName, [...one.attributes]
        .filter(({name}) => ['points', 'd', 'cx', 'cy', 'r'].includes(name))
        .flatMap(({value}) => value.match(/-?[\\d.]+/g).map(Number))])])"""
    for name in ("jaanimets-11", "stephenson", "roller-cam"):
        with live(name) as page:
            before = page.evaluate(seen)
            page.evaluate("graphplan.travel = 20; 0")
            assert page.evaluate(seen) != before
            page.evaluate("document.getElementById('home').click()")
            after = page.evaluate(seen)
            assert [step for step, _ in after] == [step for step, _ in before]
            for (step, one), (_, two) in zip(before, after, strict=True):
                assert len(one) == len(two), (name, step)
                for (tag, first), (other, second) in zip(one, two, strict=True):
                    assert tag == other
                    assert first == pytest.approx(second, abs=0.0101), (name, step)


# ---- several drives --------------------------------------------------------------------------------------------------


def nearest_in_reach(goal: complex, discs: list[tuple[complex, float]]) -> complex:
    """The place nearest to a goal that lies in each of two discs, given by their centres and radii."""
    (P, p), (Q, q) = discs
    along = (abs(Q - P) ** 2 + p**2 - q**2) / (2 * abs(Q - P))
    corners = [P + (Q - P) / abs(Q - P) * complex(along, side * math.sqrt(p**2 - along**2)) for side in (-1, 1)]
    edges = [centre + (goal - centre) / abs(goal - centre) * radius for centre, radius in discs]
    places = [place for place in (goal, *edges, *corners)
              if all(abs(place - centre) <= radius * (1 + 1e-9) for centre, radius in discs)]
    return min(places, key=lambda place: abs(place - goal))


def test_a_point_of_several_drives_follows_the_mouse() -> None:
    """It goes wherever both drives take it, else to the nearest place in reach; a crank turns its drive alone."""
    places = {name: complex(*map(float, at)) for name, at in scene("five-bar").points.items()}
    with live("five-bar") as page:
        O, P, C, A = (complex(*page.evaluate(f"graphplan.screen('{name}')")) for name in "OPCA")
        pixels = abs(P - O) / abs(places["P"] - places["O"])
        discs = [(centre, pixels * sum(abs(places[one] - places[other]) for one, other in arms))
                 for centre, arms in ((O, ("OA", "AC")), (P, ("PB", "BC")))]
        path = [C - 40 + cmath.rect(40, k / 5) for k in range(32)]
        gaps = [*followed_by_mouse(page, "C", [(goal.real, goal.imag) for goal in path])]
        outside = [goal for goal in path if nearest_in_reach(goal, discs) != goal]
        assert 5 < len(outside) < len(path) - 5
        for goal, gap in zip(path, gaps, strict=True):
            assert abs(goal + gap - nearest_in_reach(goal, discs)) < 3
        first, second = page.evaluate("graphplan.drives()")
        assert abs(first - second) > 1
        page.evaluate("document.getElementById('home').click()")
        turned = [O + (A - O) * cmath.rect(1, k / 9) for k in range(7)]
        assert max(map(abs, followed_by_mouse(page, "A", [(goal.real, goal.imag) for goal in turned]))) < 3
        first, second = page.evaluate("graphplan.drives()")
        assert abs(first) > 30
        assert second == 0


def test_each_of_several_drives_has_a_slider() -> None:
    """It moves its drive alone; results are those of the scene solved with that travel, and the graph follows."""
    with live("five-bar") as page:
        page.wait_for_function("document.querySelector('#graph .curve')?.getAttribute('d').split('L').length > 170")
        before = page.evaluate("document.querySelector('#graph .curve').getAttribute('d')")
        slider = page.locator("#drives input").nth(1)
        slider.evaluate("node => { node.value = 40; node.dispatchEvent(new Event('input', {bubbles: true})); }")
        slider.evaluate("node => node.dispatchEvent(new Event('change', {bubbles: true}))")
        assert page.evaluate("graphplan.drives()") == pytest.approx([0, 40])
        found, expected = page.evaluate("graphplan.results()"), ran("solve", "five-bar", "--at", "0,40").json
        for name, rates in expected["points"].items():
            for kind, rate in rates.items():
                assert found["points"][name][kind] == pytest.approx(rate, rel=1e-9, abs=1e-9)
        page.wait_for_function("before => (d => d.split('L').length > 170 && d !== before)"
                               "(document.querySelector('#graph .curve').getAttribute('d'))", arg=before)
