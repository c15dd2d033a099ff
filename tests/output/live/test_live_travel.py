"""Live pages over the whole travel: they hold still, say what is so, and are dragged by the mouse to every pose."""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pages import chromium, opened, page_of

import graphplan as gp
from graphplan.commands import main
from graphplan.cycle.turn import points_under_slides
from graphplan.mechanism.scene import packaged_names
from graphplan.mechanism.travel import travel_unit

POSES = 13
SCENES = packaged_names()
STRANGERS = Path(__file__).parents[2] / "cases" / "strangers"
OTHERS = [str(STRANGERS / name) for name in ("poses/sixbar.toml", "more/lo-own-dead.toml")]
SHORT = 0.51  # mm: a shorter vector is not drawn, and ends are told in hundredths
TURN = 1e-4  # degrees or lengths: half of the step of differences
SEEN = """travel => {
  graphplan.travel = travel;
  const panels = [...document.querySelectorAll('rect.panel')]
    .map(rect => ['x', 'y', 'width', 'height'].map(key => Number(rect.getAttribute(key))));
  const vectors = [...document.querySelectorAll('g.vector[data-vector]:not([display=none])')];
  const outside = vectors.flatMap(one => [...one.querySelectorAll(':is(polyline, polygon):not([display=none])')])
    .flatMap(one => one.getAttribute('points').split(' ').map(spot => spot.split(',').map(Number)))
    .filter(([x, y]) => !panels.some(([left, top, wide, high]) =>
      x > left - 0.1 && x < left + wide + 0.1 && y > top - 0.1 && y < top + high + 0.1));
  const drawn = vectors.map(({dataset: {vector, from, to}}) => {
    const [[x, y], [u, v]] = [from, to].map(spot => spot.split(' ').map(Number));
    return [vector, Math.hypot(u - x, v - y)];
  });
  const {left, top, right, bottom} = document.querySelector('rect.panel').getBoundingClientRect();
  return {travel: graphplan.travel, points: graphplan.points(), results: graphplan.results(), outside: outside.length,
    drawn: Object.fromEntries(drawn), said: graphplan.said, panel: [left, top, right, bottom],
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


def sizes(pose: Any) -> dict[str, float]:
    """The velocities and accelerations of points that are known in a pose, by the names of their vectors."""
    points = (pose["results"] or {"points": {}})["points"]
    return {f"{kind} {point}": math.hypot(*rate) for point, rates in points.items() for kind, rate in rates.items()
            if rate is not None}


@pytest.mark.parametrize("name", [*SCENES, *OTHERS], ids=lambda name: Path(name).stem)
def test_whatever_is_known_is_drawn_in_its_place(browser: Any, name: str) -> None:
    """In 13 poses over the travel every vector that is known is drawn, as far as it is long enough, inside its panel;
    points of the frame are where they were, all points, and so their paths, on the mechanism plan. Where there are no
    results, the page says why."""
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
        poses = [page.evaluate(SEEN, travel) for travel in travels(page) or [0.0]]
    scales = [{vector.split()[0]: pose["drawn"][vector] / size for vector, size in sizes(pose).items()
               if size and vector in pose["drawn"]} for pose in poses]
    finest = {kind: max(scale.get(kind, 0.0) for scale in scales) for kind in ("velocity", "acceleration")}
    for pose, scale in zip(poses, scales, strict=True):
        assert [vector for vector, size in sizes(pose).items() if vector not in pose["drawn"]
                and size * (finest | scale)[vector.split()[0]] >= SHORT] == []
        assert pose["results"] or pose["said"]
        assert pose["outside"] == 0
        left, top, right, bottom = pose["panel"]
        assert all(left < x < right and top < y < bottom for x, y in pose["screen"].values())
        for point, place in pose["points"].items():
            if all(other["points"][point] == place for other in poses):
                assert pose["screen"][point] == pytest.approx(poses[0]["screen"][point], abs=1e-6)
    assert any(pose["drawn"] for pose in poses) or not any(map(sizes, poses))


def pace_of(scene: gp.Scene) -> float:
    """How far the travel goes in a second; 0 where that says nothing of all drives, as some of them speed up."""
    if not scene.drives or any(drive.change for drive in scene.drives):
        return 0.0
    return abs(float(scene.drives[0].rate)) / travel_unit(scene)[0]


def sense_at(scene: gp.Scene, travel: float) -> float:
    """Whether a drive that slides away from a point moves as its travel counts: beyond that point it moves back, and in
    it in no direction."""
    drive = scene.drives[0]
    through = scene.driven_slide(drive).through if drive.slides else None
    if not through:
        return 1.0
    way = math.copysign(travel, travel * drive.rate)
    distance = math.dist(*([*map(float, scene.points[name])] for name in through)) + way
    return math.copysign(abs(distance) > 2 * TURN, distance)


def compare_with_differences(page: Any, scene: gp.Scene, travel: float) -> int:
    """Velocities and accelerations of a pose are what points go by small steps of the travel; how many were compared.

    What only marks the place under a point that slides or touches is carried by no link.
    """
    back, here, on = (page.evaluate(SEEN, travel + turn) for turn in (-TURN, 0, TURN))
    sense = sense_at(scene, travel)
    if not all(pose["results"] for pose in (back, here, on)) or on["travel"] - back["travel"] < 1.9 * TURN or not sense:
        return 0
    before, now, after = (pose["results"]["points"] for pose in (back, here, on))
    time, marks = sense * TURN / pace_of(scene), points_under_slides(scene)
    carried = [name for name in now if scene.links_of[name] and name not in marks and now[name].get("velocity")]
    for kind, of in (("velocity", None), ("acceleration", "velocity")):
        found = {name: (complex(*now[name][kind]), (complex(*(after[name][of] if of else on["points"][name]))
                 - complex(*(before[name][of] if of else back["points"][name]))) / (2 * time))
                 for name in carried
                 if now[name].get(kind) and (not of or (before[name].get(of) and after[name].get(of)))}
        largest = max((abs(rate) for rate, _ in found.values()), default=0.0)
        for rate, difference in found.values():
            assert rate == pytest.approx(difference, abs=2e-4 * largest)
    return len(carried)


@pytest.mark.parametrize("name", dict.fromkeys(("alt-eight-link", "geneva", "slider-crank", *SCENES[::3])))
def test_rates_are_those_of_the_page_s_own_positions(browser: Any, name: str) -> None:
    """Over the travel, and with a pin of the frame moved, velocities and accelerations are what points go in a time."""
    scene = gp.load(name)
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
        ends = travels(page)
        if not pace_of(scene) or not ends:
            return
        count = sum(compare_with_differences(page, scene, travel) for travel in ends[::3])
        assert count or name not in ("alt-eight-link", "geneva", "slider-crank")
        page.evaluate("travel => { graphplan.travel = travel; }", ends[POSES // 2])
        first, last = page.evaluate(SEEN, ends[POSES // 2]), page.evaluate(SEEN, ends[POSES // 2] + 1)
        pins = [point for point, place in first["points"].items() if last["points"][point] == place]
        x, y = first["points"][pins[0]]
        reach = max(math.dist(one, other) for one in first["points"].values() for other in first["points"].values())
        page.evaluate("([name, x, y]) => graphplan.drag(name, x, y)", [pins[0], x + 0.02 * reach, y])
        low, high = (end if end is not None else far
                     for end, far in zip(page.evaluate("graphplan.limits()"), (-180, 180), strict=True))
        travel = page.evaluate("graphplan.travel")
        if min(travel - low, high - travel) > 1:
            compare_with_differences(page, scene, travel)


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


@pytest.mark.parametrize(("name", "point"), [("alt-eight-link", "F"), ("alt-eight-link", "C"), ("shaper", "B"),
                                             *((name, "") for name in SCENES[1::3])])
def test_a_steady_drag_goes_steadily_and_comes_back(browser: Any, name: str, point: str) -> None:
    """Dragged along its path by the mouse, and back, a point stays within 3 pixels of the pointer."""
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
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


def test_gears_that_are_never_back_are_dragged_to_every_pose(browser: Any) -> None:
    """A point of a wheel that takes ninety turns to be back is found where it stood in this turn or another."""
    with opened(browser, page_of("live", "gear-linkage", "--choices", "none")) as page:
        goal = page.evaluate(SEEN, 172.8)
        for travel in (-14.4, -172.8, 1000.0):
            page.evaluate("travel => { graphplan.travel = travel; }", travel)
            page.evaluate("([name, x, y]) => graphplan.drag(name, x, y)", ["M", *goal["points"]["M"]])
            assert math.dist(page.evaluate("graphplan.screen('M')"), goal["screen"]["M"]) < 3


def test_where_a_guide_has_no_direction_nothing_is_told(browser: Any) -> None:
    """Where the two points of a guide come together there are no results, and the page says why."""
    with opened(browser, page_of("live", "ozols-5-3", "--choices", "none")) as page:
        page.evaluate("(([from, to]) => { graphplan.travel = (from + to) / 2; })(graphplan.limits())")
        assert page.evaluate("graphplan.results()") is None
        assert "direction coincide" in page.evaluate("graphplan.said")
        page.evaluate("graphplan.travel += 0.01")
        assert page.evaluate("graphplan.results()") is not None
        assert page.evaluate("graphplan.said") == ""


def walked_by_mouse(page: Any, point: str, path: list[Any]) -> Iterator[tuple[float, float]]:
    """How far from the pointer a point is, in pixels, as the mouse drags it along places on the screen."""
    page.mouse.move(*page.evaluate(f"graphplan.screen('{point}')"))
    page.mouse.down()
    for x, y in path:
        page.mouse.move(x, y)
        page.evaluate("new Promise(requestAnimationFrame)")
        page.evaluate("new Promise(requestAnimationFrame)")
        u, v = page.evaluate(f"graphplan.screen('{point}')")
        yield u - x, v - y
    page.mouse.up()


def nearest_in_reach(goal: complex, discs: list[tuple[complex, float]]) -> complex:
    """The place nearest to a goal that lies in each of two discs, given by their centres and radii."""
    (P, p), (Q, q) = discs
    along = (abs(Q - P) ** 2 + p**2 - q**2) / (2 * abs(Q - P))
    corners = [P + (Q - P) / abs(Q - P) * complex(along, side * math.sqrt(p**2 - along**2)) for side in (-1, 1)]
    edges = [centre + (goal - centre) / abs(goal - centre) * radius for centre, radius in discs]
    places = [place for place in (goal, *edges, *corners)
              if all(abs(place - centre) <= radius * (1 + 1e-9) for centre, radius in discs)]
    return min(places, key=lambda place: abs(place - goal))


def test_a_point_of_several_drives_follows_the_mouse(browser: Any) -> None:
    """It goes wherever both drives take it, else to the nearest place in reach; a crank turns its drive alone."""
    places = {name: complex(*map(float, at)) for name, at in gp.load("five-bar").points.items()}
    with opened(browser, page_of("live", "five-bar", "--choices", "none")) as page:
        O, P, C, A = (complex(*page.evaluate(f"graphplan.screen('{name}')")) for name in "OPCA")
        pixels = abs(P - O) / abs(places["P"] - places["O"])
        discs = [(centre, pixels * sum(abs(places[one] - places[other]) for one, other in arms))
                 for centre, arms in ((O, ("OA", "AC")), (P, ("PB", "BC")))]
        path = [C - 40 + cmath.rect(40, k / 5) for k in range(32)]
        gaps = [complex(*gap) for gap in walked_by_mouse(page, "C", [(goal.real, goal.imag) for goal in path])]
        outside = [goal for goal in path if nearest_in_reach(goal, discs) != goal]
        assert 5 < len(outside) < len(path) - 5
        for goal, gap in zip(path, gaps, strict=True):
            assert abs(goal + gap - nearest_in_reach(goal, discs)) < 3
        first, second = page.evaluate("graphplan.drives()")
        assert abs(first - second) > 1
        page.evaluate("document.getElementById('home').click()")
        turned = [O + (A - O) * cmath.rect(1, k / 9) for k in range(7)]
        gaps = [complex(*gap) for gap in walked_by_mouse(page, "A", [(goal.real, goal.imag) for goal in turned])]
        assert max(map(abs, gaps)) < 3
        first, second = page.evaluate("graphplan.drives()")
        assert abs(first) > 30
        assert second == 0


def test_each_of_several_drives_has_a_slider(browser: Any, capsys: pytest.CaptureFixture[str]) -> None:
    """It moves its drive alone; results are those of the scene solved with that travel, and the graph follows."""
    with opened(browser, page_of("live", "five-bar", "--choices", "none")) as page:
        page.wait_for_function("document.querySelector('#graph .curve')?.getAttribute('d').split('L').length > 170")
        before = page.evaluate("document.querySelector('#graph .curve').getAttribute('d')")
        slider = page.locator("#drives input").nth(1)
        slider.evaluate("node => { node.value = 40; node.dispatchEvent(new Event('input', {bubbles: true})); }")
        slider.evaluate("node => node.dispatchEvent(new Event('change', {bubbles: true}))")
        assert page.evaluate("graphplan.drives()") == pytest.approx([0, 40])
        capsys.readouterr()
        assert main(["solve", "five-bar", "--at", "0,40"]) == 0
        found, expected = page.evaluate("graphplan.results()"), json.loads(capsys.readouterr().out)
        for name, rates in expected["points"].items():
            for kind, rate in rates.items():
                assert found["points"][name][kind] == pytest.approx(rate, rel=1e-9, abs=1e-9)
        page.wait_for_function("before => (d => d.split('L').length > 170 && d !== before)"
                               "(document.querySelector('#graph .curve').getAttribute('d'))", arg=before)


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link", "shaper"])
def test_a_pin_that_goes_too_far_is_said_and_comes_back(browser: Any, name: str) -> None:
    """A pin of the frame goes as far as the linkage follows; what is unknown there is null; back, all is as it was."""
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
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
