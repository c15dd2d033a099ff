"""The live page: whole and offline; in a browser, steps, keys, drags, choices, print, and what scripts see."""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

import pytest
from face import got
from html_reader import Reader
from live_browser import browser, live, opened, page_of

import graphplan as gp

NAME = "slider-crank"
USED = "handout", NAME, "--choices", "plans,de"
Page = Any


@cache
def text_of(*arguments: str) -> str:
    return page_of(*arguments).read_text("utf-8")


def drawn(name: str = NAME) -> list[Any]:
    """The steps that are drawn; what is given has no number."""
    return [step for step in got(name).steps["steps"] if step["number"]]


# ---- the file --------------------------------------------------------------------------------------------------------


def test_the_page_is_whole_and_well_formed() -> None:
    """Elements are closed in order, no id is given twice, and no place of the template is left unfilled."""
    reader = Reader(text_of(*USED))
    assert reader.open == []
    ids = Counter(look["id"] for _, look in reader.tags if "id" in look)
    assert max(ids.values()) == 1
    assert "{{" not in text_of(*USED)


def test_the_page_needs_no_network() -> None:
    """Its policy forbids all fetching, and nothing is referred to but what is in the page."""
    page = text_of(*USED)
    assert "default-src 'none'" in page
    assert {re.split("/+", address)[1] for address in re.findall(r"https?://[\w./]+", page)} <= {"www.w3.org"}
    looks = [look for _, look in Reader(page).tags]
    assert not [look for look in looks if {"src", "href", "xlink:href", "srcset"} & set(look)]
    assert set(re.findall(r"url\((.)", page)) <= {"#"}


@pytest.mark.parametrize("name", [NAME, "triad-loaded"])
def test_every_step_stage_and_result_stands_in_the_page_without_a_script(name: str) -> None:
    """All movements by their numbers, a heading for each stage that is drawn, a row for each point and link asked."""
    page, steps = text_of("live", name, "--choices", "none"), got(name).steps
    listed = page[: page.index('id="scene"')]
    places = re.findall(r'data-place="(\d+)"', listed)
    assert places == [str(step["number"]) for step in drawn(name)]
    headings = [*groupby(entry["stage"] for entry in steps["entries"])]
    assert len(headings) / 2 < listed.count("<h4>") <= len(headings)  # what is likewise drawn shares one
    assert listed.count('class="equation"') >= len({stage["equation"] for stage in steps["stages"]} - {""}) > 0
    assert listed.count("<tr>") >= len(got(name).solved["points"])
    seen = set(re.findall(r'<g class="step" data-step="(\d+)"', listed))
    assert seen
    assert seen <= {"0", *places}


def test_the_scene_is_in_the_page_once() -> None:
    """The scene as it was written stands in a script of its own; what would end that is turned back by the reader."""
    assert Reader(text_of(*USED)).scripts["scene"].replace("<\\", "<") == gp.load(NAME).text
    hostile = Reader(text_of("live", NAME, "--choices", "none", "--set", "title=</script><!-- <b>&"))
    assert "</script><!-- <b>&" in hostile.scripts["scene"].replace("<\\", "<")


def test_it_is_the_same_every_time() -> None:
    """The same scene is the same bytes."""
    path = page_of("live", "four-bar", "--choices", "none")
    before = path.read_bytes()
    page_of.cache_clear()
    assert page_of("live", "four-bar", "--choices", "none").read_bytes() == before


# ---- in a browser ----------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def steps() -> Iterator[Page]:
    """The handout of a slider-crank."""
    with opened(page_of(*USED)) as page:
        yield page


@pytest.fixture(autouse=True)
def fresh(request: pytest.FixtureRequest) -> None:
    """Each test finds the page in the given pose, at the first step."""
    if "steps" in request.fixturenames:
        page = request.getfixturevalue("steps")
        page.set_viewport_size({"width": 1280, "height": 800})
        page.emulate_media(media="screen")
        page.evaluate("document.activeElement.blur(); document.getElementById('home').click(); graphplan.step = 0;"
                      "document.querySelector('#zoom[aria-pressed=true]')?.click()")


def shown_steps(page: Page) -> set[int]:
    """The drawn steps whose groups can be seen."""
    return set(page.eval_on_selector_all("g.step", "all => all.filter(g => getComputedStyle(g).display != 'none')"
                                         ".map(g => Number(g.dataset.step))")) - {0}


def test_keys_go_through_the_steps(steps: Page) -> None:
    """Arrows, Home and End move; the live region says the step, the list marks it, later steps are hidden."""
    assert shown_steps(steps) == set()
    for key, place in (("ArrowRight", 1), ("ArrowDown", 2), ("ArrowLeft", 1), ("End", len(drawn()))):
        steps.keyboard.press(key)
        assert steps.evaluate("graphplan.step") == place
        assert steps.inner_text("#sentence").startswith(f"Step {place}/")
        assert steps.get_attribute("#sentence", "aria-live") == "polite"
        assert max(shown_steps(steps)) <= place
        current = steps.eval_on_selector_all(
            "button[data-place]", "all => all.map(one => one.getAttribute('aria-current'))")
        assert [i for i, marked in enumerate(current, 1) if marked == "step"] == [place]
        assert steps.input_value("#place") == str(place)
    steps.keyboard.press("Home")
    assert steps.query_selector("[aria-current]") is None


def test_marks_that_a_step_reads_and_makes_are_told_apart(steps: Page) -> None:
    """A crossing lights up the two lines it reads and the point it makes: by colour, width, dashes and words."""
    step = next(step for step in drawn() if step["operation"] == "meet")
    steps.click(f"button[data-place='{step['number']}']")
    read = sorted({got(NAME).steps["steps"][operand]["number"] for operand in step["operands"]} - {0})
    for role, numbers in (("read", read), ("made", [step["number"]])):
        assert steps.eval_on_selector_all(f"g.step.{role}", "all => all.map(g => Number(g.dataset.step))") == numbers
    looks = [steps.eval_on_selector(f"#halos .{role} > *", "g => [getComputedStyle(g).stroke, "
                                    "getComputedStyle(g).strokeWidth, getComputedStyle(g).strokeDasharray]")
             for role in ("read", "made")]
    assert all(one != other for one, other in zip(*looks, strict=True))
    assert steps.inner_text("#makes b") == step["makes"].replace("_", "")
    assert steps.inner_text("#reads b").split(", ") == step["reads"]


def test_page_keys_go_from_stage_to_stage(steps: Page) -> None:
    """Page Down stands on the first step of each stage in turn, Page Up goes back the same way."""
    stages = groupby(got(NAME).steps["entries"], key=lambda entry: entry["stage"])
    firsts = [next(entries)["steps"][0] for _, entries in stages]
    seen = []
    for _ in firsts:
        steps.keyboard.press("PageDown")
        seen.append(int(steps.input_value("#place")))
    assert seen == firsts
    for number in reversed(firsts[:-1]):
        steps.keyboard.press("PageUp")
        assert int(steps.input_value("#place")) == number


def test_play_runs_and_space_stops_it(steps: Page) -> None:
    """Space plays, and space again rests; at the end it rests by itself."""
    steps.keyboard.press("End")
    steps.keyboard.press("ArrowLeft")
    steps.keyboard.press(" ")
    assert steps.inner_text("#run") == "Pause"
    steps.keyboard.press(" ")
    assert steps.inner_text("#run") == "Play"
    steps.keyboard.press(" ")
    steps.wait_for_function("document.getElementById('next').disabled")
    assert steps.inner_text("#run") == "Play"


def test_zoom_follows_the_plan_of_the_step(steps: Page) -> None:
    """Zoomed, the window is the panel of the current step's plan, and the whole sheet again when let go."""
    whole = steps.get_attribute("#picture", "viewBox")
    steps.click("#zoom")
    for place in (1, len(drawn())):
        steps.click(f"button[data-place='{place}']")
        panels = steps.eval_on_selector_all("rect.panel", "all => all.map(one => [one.dataset.plan, ...['x', 'y', "
                                            "'width', 'height'].map(key => Number(one.getAttribute(key)))])")
        rect = next(rect for plan, *rect in panels if plan == drawn()[place - 1]["plan"])
        box = [float(part) for part in steps.get_attribute("#picture", "viewBox").split()]
        assert box == pytest.approx(rect, abs=0.01)
    assert steps.get_attribute("#zoom", "aria-pressed") == "true"
    steps.click("#zoom")
    assert steps.get_attribute("#picture", "viewBox") == whole


def test_tab_stops_once_in_the_list_of_steps(steps: Page) -> None:
    """Whatever the number of steps, Tab stops at the current one alone, after the points and the controls."""
    steps.keyboard.press("ArrowRight")
    steps.keyboard.press("ArrowRight")
    results = steps.locator("#strip button").count()
    controls = ["variant", "language", "summary", "print", "copy", *["button"] * results, *"OABS", "run", "pace",
                "home", "drive", "travel", "zoom", "values", "fold", "first", "previous", "next", "last", "place",
                "told", "2"]
    stops = ["variant"]
    steps.focus("#variant")
    for _ in controls[1:]:
        steps.keyboard.press("Tab")
        stops.append(steps.evaluate("document.activeElement.id || document.activeElement.dataset.place || "
                                    "document.activeElement.dataset.point || document.activeElement.localName"))
    assert stops == controls


def test_the_drive_moves_by_keys_and_the_step_stays(steps: Page) -> None:
    """The slider, a number that is typed, and comma and point turn the drive; 0 brings the given pose back."""
    steps.evaluate("graphplan.step = 7")
    before, seen = steps.inner_html("#picture"), shown_steps(steps)
    steps.fill("#travel", "30")
    steps.keyboard.press("Enter")
    assert steps.evaluate("graphplan.travel") == pytest.approx(30, abs=1e-9)
    assert steps.get_attribute("#drive", "aria-valuetext") == "30°"
    assert steps.evaluate("graphplan.step") == 7
    assert shown_steps(steps) <= seen
    assert steps.inner_html("#picture") != before
    steps.focus("#run")
    steps.keyboard.press(".")
    assert steps.evaluate("graphplan.travel") == pytest.approx(31, abs=1e-9)
    steps.focus("#drive")
    steps.keyboard.press("ArrowRight")
    assert steps.evaluate("graphplan.travel") > 31.5
    steps.focus("#run")
    steps.keyboard.press("0")
    assert steps.evaluate("graphplan.travel") == 0
    assert steps.evaluate("graphplan.step") == 7


def test_a_hand_that_comes_back_leaves_no_rounding(steps: Page) -> None:
    """A travel that is rounding alone is told as nothing; the slider leads to its place in the turn of the drive."""
    steps.evaluate("graphplan.travel = -1.2e-9")
    assert steps.input_value("#travel") == "0"
    steps.evaluate("graphplan.travel = 0")
    steps.eval_on_selector("#drive", "drive => { drive.value = 300; drive.dispatchEvent(new Event('input')); }")
    assert steps.evaluate("graphplan.travel") == 300


def test_it_runs_and_rests(steps: Page) -> None:
    """R lets the mechanism run, and R again stops it."""
    steps.keyboard.press("r")
    steps.wait_for_function("graphplan.travel > 5")
    assert steps.inner_text("#run") == "Pause"
    steps.keyboard.press("r")
    assert steps.inner_text("#run") == "Play"


def test_points_are_dragged_by_the_mouse(steps: Page) -> None:
    """Pressed at its place on the screen, the crank pin follows the mouse on its circle; pins move the frame."""
    start, (ox, oy) = steps.evaluate("[graphplan.points().A, graphplan.screen('O')]")
    radius = math.hypot(*start)
    x, y = steps.evaluate("graphplan.screen('A')")
    steps.mouse.move(x, y)
    steps.mouse.down()
    turn = math.atan2(oy - y, x - ox) + 0.6
    steps.mouse.move(ox + 90 * math.cos(turn), oy - 90 * math.sin(turn), steps=4)
    steps.mouse.up()
    found = steps.evaluate("graphplan.points().A")
    assert math.hypot(*found) == pytest.approx(radius, rel=1e-9)
    assert math.degrees(math.atan2(found[1], found[0])) == pytest.approx(math.degrees(turn), abs=2)
    assert steps.evaluate("graphplan.travel") == pytest.approx(math.degrees(0.6), abs=2)
    x, y = steps.evaluate("graphplan.screen('O')")
    steps.mouse.move(x, y)
    steps.mouse.down()
    steps.mouse.move(x - 12, y - 8, steps=3)
    steps.mouse.up()
    (px, py), (qx, qy) = steps.evaluate("[graphplan.points().O, graphplan.points().A]")
    assert px < 0 < py
    assert math.hypot(qx - px, qy - py) == pytest.approx(radius, rel=1e-9)


def test_arrows_step_after_a_drag_by_the_mouse(steps: Page) -> None:
    """The mouse leaves the keys to the steps, whatever had the focus before."""
    steps.focus("#travel")
    x, y = steps.evaluate("graphplan.screen('A')")
    steps.mouse.move(x, y)
    steps.mouse.down()
    steps.mouse.move(x - 30, y + 9, steps=3)
    steps.mouse.up()
    before = steps.evaluate("graphplan.travel")
    assert before != 0
    steps.keyboard.press("ArrowRight")
    assert steps.evaluate("graphplan.step") == 1
    assert steps.evaluate("graphplan.travel") == before


def test_points_are_moved_by_keys(steps: Page) -> None:
    """A point that has the focus goes by arrow keys; its name is told."""
    assert "A" in steps.get_attribute("[data-point=A]", "aria-label")
    steps.focus("[data-point=A]")
    before = steps.evaluate("graphplan.travel")
    for _ in range(3):
        steps.keyboard.press("ArrowLeft")
    assert steps.evaluate("graphplan.travel") > before + 0.5
    assert steps.evaluate("graphplan.step") == 0


def test_a_place_on_the_screen_is_that_of_the_scene(steps: Page) -> None:
    """A point's place in CSS pixels is its joint's own, zoomed and scrolled too."""
    for prepare in ("", "document.getElementById('zoom').click()", "graphplan.travel = 70"):
        steps.evaluate(prepare)
        for name in "OAB":
            x, y = steps.evaluate(f"graphplan.screen('{name}')")
            box = steps.locator(f"[data-point={name}]").bounding_box()
            assert (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2) == pytest.approx((x, y), abs=0.6)


def test_choices_of_plan_and_language_keep_the_pose(steps: Page) -> None:
    """Another plan or language is drawn and told in the pose that the mechanism has."""
    steps.evaluate("graphplan.travel = 25; graphplan.step = graphplan.steps")
    before = steps.evaluate("graphplan.results().points")
    steps.select_option("#variant", label="polar plans")
    steps.wait_for_function("document.querySelector('#forms').textContent.includes('polar')")
    assert steps.evaluate("graphplan.travel") == pytest.approx(25, abs=1e-9)
    after = steps.evaluate("graphplan.results().points")
    for name, found in before.items():
        assert after[name]["velocity"] == pytest.approx(found["velocity"], rel=1e-9, abs=1e-9)
    steps.select_option("#language", "de")
    steps.wait_for_function("document.documentElement.lang === 'de'")
    assert steps.inner_text("#steps") == "Schritte"
    assert steps.get_attribute("main", "aria-label") == "Blatt"
    assert "Markiere O" in steps.evaluate("document.querySelector('#picture [data-step] title').textContent")
    assert "," in steps.inner_text("#tables")
    assert steps.evaluate("graphplan.travel") == pytest.approx(25, abs=1e-9)
    steps.select_option("#language", "en")
    steps.select_option("#variant", label="orthogonal velocities")
    steps.wait_for_function("document.querySelector('#forms').textContent.includes('parallels')")


def test_paths_are_traced(steps: Page) -> None:
    """The path of a coupler point goes once around, through the point where it is."""
    steps.click("#curves summary")
    steps.check("label:has-text('Path of S') input")
    steps.wait_for_function("document.querySelector('#traces path')?.getAttribute('d').match(/L/g)?.length >= 180")
    first = steps.eval_on_selector("#traces path", "path => [path.getPointAtLength(0).x, path.getPointAtLength(0).y]")
    at = [float(steps.get_attribute("[data-point=S]", key)) for key in ("cx", "cy")]
    assert first == pytest.approx(at, abs=0.02)
    steps.uncheck("label:has-text('Path of S') input")
    steps.click("#curves summary")
    assert steps.locator("#traces path").count() == 0


def test_the_pose_is_copied_as_a_scene(steps: Page) -> None:
    """What is copied, or where the clipboard is refused shown, is a scene in this pose."""
    steps.evaluate("graphplan.travel = 20; navigator.clipboard.writeText = () => Promise.reject(new Error('no')); 0")
    steps.click("#copy")
    scene = gp.parse(steps.input_value("#toml"), "scene")
    x, y = steps.evaluate("graphplan.points().A")
    assert (float(scene.points["A"][0]), float(scene.points["A"][1])) == pytest.approx((x, y), rel=1e-12)
    steps.click("#close")


@pytest.mark.parametrize("width", [375, 700, 1280])
def test_no_screen_needs_sideways_scrolling(steps: Page, width: int) -> None:
    """From 375 pixels on, nothing is wider than the screen, and every control is on it."""
    steps.set_viewport_size({"width": width, "height": 750})
    assert steps.evaluate("document.documentElement.scrollWidth") <= width
    controls = steps.query_selector_all(".row :is(button, input, select, summary):not([hidden])")
    for box in filter(None, (control.bounding_box() for control in controls)):
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= width


def test_printed_it_is_the_sheet_of_the_pose_with_its_words(steps: Page) -> None:
    """In print every step is there in true size, nothing is lit up, and the controls are gone."""
    steps.evaluate("graphplan.travel = 15")
    steps.keyboard.press("ArrowRight")
    steps.evaluate("dispatchEvent(new Event('beforeprint')); 0")
    steps.emulate_media(media="print")
    assert len(shown_steps(steps)) > 20
    assert steps.is_visible("#list")
    panel = steps.locator("rect.panel").first
    assert panel.bounding_box()["width"] == pytest.approx(float(panel.get_attribute("width")) * 96 / 25.4, abs=1)
    for part in ("#controls", "#told", "#halos", "#handles"):
        assert steps.eval_on_selector(part, "part => getComputedStyle(part).display") == "none"


def test_without_a_script_it_is_the_sheet_with_its_protocol() -> None:
    """All that is drawn can be seen, the protocol stands beside it, and nothing that would do nothing."""
    context = browser().new_context(java_script_enabled=False)
    found = context.new_page()
    found.goto(page_of(*USED).as_uri())
    assert found.locator("g.step").count() == found.locator("g.step:not(.later)").count() > 0
    assert found.is_visible("#list")
    assert found.is_visible("#tables table")
    assert not found.is_visible("#controls")
    context.close()


def test_a_limit_stops_it_with_its_reason() -> None:
    """A rocker that runs reaches its limit, rests and says why, and runs back the next time."""
    with live("triad-loaded", reduced_motion="no-preference") as page:
        low, high = page.evaluate("graphplan.limits()")
        end = high if high is not None else low
        page.evaluate(f"graphplan.travel = {end} - Math.sign({end}) * 0.5")
        page.evaluate(f"graphplan.travel = {end} * 1.5")
        assert "limit position" in page.evaluate("graphplan.said")
        assert page.inner_text("#said") == page.evaluate("graphplan.said")
        there = page.evaluate("graphplan.travel")
        assert there == pytest.approx(end, abs=1e-3)
        page.keyboard.press("r")
        page.wait_for_function(f"Math.abs(graphplan.travel - {there}) > 3")
        assert abs(page.evaluate("graphplan.travel")) < abs(there)


def test_what_cannot_be_moved_says_why() -> None:
    """An open chain with given motions has the steps, controls that are off, and the reason."""
    with live("open-chain") as page:
        assert "the motion of points is given" in page.evaluate("graphplan.said")
        assert page.is_disabled("#drive")
        page.keyboard.press("Home")
        page.keyboard.press("ArrowRight")
        assert page.evaluate("graphplan.step") == 1
        assert page.evaluate("graphplan.limits()") == [0, 0]
        assert json.dumps(page.evaluate("graphplan.results()"))


def test_a_script_that_asks_for_what_there_is_not_is_told() -> None:
    """A name that is no point's, and places that are no numbers, are refused in words; the pose stays."""
    with live("four-bar") as page:
        before = page.evaluate("graphplan.points()")
        for asked in "screen('Z')", "drag('Z', 1, 2)", "drag('A', NaN, 2)", "drag('A')":
            told = page.evaluate(f"(() => {{try {{graphplan.{asked};}} catch (error) {{return String(error);}}}})()")
            assert told.startswith("RangeError: "), asked
            assert "undefined" not in told.partition(", not to")[0], asked
            assert page.evaluate("graphplan.points()") == before, asked


@pytest.mark.parametrize("travel", [25, 120])
def test_words_of_a_pose_are_those_of_its_own_page(travel: float, tmp_path: Path) -> None:
    """Moved to a pose the page tells the construction in the words in which the page of that pose tells it."""
    (tmp_path / "posed.toml").write_text(gp.at(gp.load(NAME), travel).toml(), encoding="utf-8")
    told = []
    for name, gone in ((NAME, travel), (str(tmp_path / "posed.toml"), 0)):
        with live(name) as page:
            page.evaluate("travel => { graphplan.travel = travel; }", gone)
            told.append([re.sub(r"[\d.,·: =−-]+", "#", line) for line in page.inner_text("#list").splitlines()])
    assert len(told[0]) > 50
    assert told[0] == told[1]
