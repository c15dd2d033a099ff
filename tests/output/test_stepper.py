"""The stepper: one whole page that needs no network; in a browser, steps, marks, keys and the turn of the drive."""

from __future__ import annotations

import base64
import gzip
import json
import math
import re
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from functools import cache
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

import graphplan as gp
from graphplan.cycle import follow
from graphplan.output.stepper import stepper
from graphplan.sheet.cycle_frames import CycleFrames, standing, turning
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.words.protocol import Protocol
from graphplan.sheet.words.texts import Words

POSES = 12
VOID = {"meta", "br", "hr", "input", "link", "img"}


@cache
def round_of(name: str) -> CycleFrames:
    """A scene in twelve poses of its cycle."""
    drawing = gp.construct(gp.load(name))
    turn = follow(drawing.scene, POSES)
    travel = [math.degrees(angle) for angle in turn.travel]
    return turning(drawing, compose(drawing, protocol="aside"), travel, turn.points, turn.guides)


@cache
def page_of(name: str) -> str:
    return stepper(round_of(name))


class Reader(HTMLParser):
    """Reads a page: whether its elements are balanced, their attributes, and the text of scripts by id."""

    def __init__(self, page: str):
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: dict[str, str] = {}
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] == "script":
            self.scripts[self.elements[-1][1].get("id") or ""] = data


def unpacked(page: str) -> Any:
    """The other poses of a page."""
    return json.loads(gzip.decompress(base64.b64decode(Reader(page).scripts["poses"])))


def test_the_page_is_whole_and_well_formed() -> None:
    """Elements are closed in order, no id is given twice, and no place of the template is left unfilled."""
    reader = Reader(page_of("slotted-link"))
    assert reader.open == []
    ids = Counter(look["id"] for _, look in reader.elements if "id" in look)
    assert max(ids.values()) == 1
    assert "{{" not in page_of("slotted-link")


def test_the_page_needs_no_network() -> None:
    """Nothing is referred to but what is in the page; of the network's addresses there is none but that of SVG."""
    page = page_of("slotted-link")
    assert set(re.findall(r"https?://[\w./]+", page)) <= {"http://www.w3.org/2000/svg"}
    looks = [look for _, look in Reader(page).elements]
    assert not [look for look in looks if {"src", "href", "xlink:href", "srcset"} & set(look)]
    assert set(re.findall(r"url\((.)", page)) <= {"#"}


def test_every_step_is_there_with_its_group_its_sentence_and_what_it_reads() -> None:
    """The list, the picture and the data have all steps of the construction."""
    found, page = round_of("slotted-link"), page_of("slotted-link")
    drawn, reader = found.drawing.drawn, Reader(page)
    data = json.loads(reader.scripts["data"])
    assert [step["reads"] for step in data["steps"]] == [list(step.args) for step in drawn.steps]
    places = [look["data-place"] for _, look in reader.elements if "data-place" in look]
    assert places == [str(drawn.number(step.index)) for step in drawn.steps[drawn.givens:]]
    names = tuple(step.name for step in drawn.steps if step.name)
    for passage in Protocol(found.composition.plans, found.composition.scales).passages:
        for entry in passage.entries:
            for one in entry.movements:
                told = "".join(run.text for run in sentence_runs(one.sentence if entry.folded else entry.told, names))
                assert unescape(re.sub("</?sub>", "", data["steps"][one.index]["told"])) == told


@pytest.mark.parametrize("name", ["four-bar", "triad-loaded"])
def test_the_page_tells_every_stage_with_its_equations_and_every_result(name: str) -> None:
    """A heading for each stage in the list, its equations below it, and a row for each point, link and reaction."""
    found = standing(drawing := gp.construct(gp.load(name)), compose(drawing))
    page = stepper(found)
    passages = Protocol(found.composition.plans, found.composition.scales).passages
    assert page.count("<h4>") == 2 * sum(passage.title is not None for passage in passages)  # in the list, in the data
    listed = page[: page.index('id="scene"')]
    assert listed.count('class="equation"') == sum(
        len(passage.stage.equations) for passage in passages if passage.stage and not passage.again)
    rows = sum(map(len, Words(found.composition.plans).result_tables()))
    assert rows
    assert listed.count("<tr>") == rows


def test_other_poses_have_the_groups_of_the_given_one() -> None:
    """Each varied group has its inside for every pose, the first as it stands on the page; its lines are elsewhere."""
    page, found = page_of("slotted-link"), round_of("slotted-link")
    poses = unpacked(page)
    shown = {look["data-key"] for _, look in Reader(page).elements if "data-key" in look}
    assert set(poses["groups"]) <= shown
    assert {len(insides) for insides in poses["groups"].values()} == {len(found.frames)}
    assert {"links", "pairs"} <= set(poses["groups"])
    assert "paper" not in poses["groups"]
    assert len(set(poses["results"])) == len(found.frames)
    assert any(len(set(told)) > 1 and "mm" in told[0] for told in poses["told"].values())  # lengths are of each pose
    assert len(poses["spots"]) == len(found.frames)


def test_the_scene_is_in_the_page_once() -> None:
    """The scene as it was written stands in a script of its own; text that would end the script is escaped."""
    page, scene = page_of("slotted-link"), gp.load("slotted-link")
    assert Reader(page).scripts["scene"] == scene.text
    assert page.count(scene.text) == 1
    text = scene.text.replace('"Swinging', '"</script><!--', 1)
    drawing = gp.construct(gp.parse(text, "scene"))
    reader = Reader(stepper(standing(drawing, compose(drawing, protocol="aside"))))
    assert gp.parse(reader.scripts["scene"], "scene").title.startswith("</script><!--")


def test_without_a_turn_the_page_says_why() -> None:
    """An open chain has no slider, and a line that says why; nothing is packed."""
    drawing = gp.construct(gp.load("open-chain"))
    reader = Reader(stepper(standing(drawing, compose(drawing, protocol="aside"), "nothing drives it")))
    assert ("div", {"class": "slider", "hidden": None}) in reader.elements
    assert reader.scripts.get("poses", "") == ""
    assert "nothing drives it" in stepper(standing(drawing, compose(drawing, protocol="aside"), "nothing drives it"))


def test_it_is_the_same_every_time() -> None:
    """The same scene is the same bytes."""
    round_of.cache_clear()
    assert stepper(round_of("four-bar")) == page_of("four-bar")


# ---- in a browser ------------------------------------------------------------------------------------------------

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A browser without a window."""
    api = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None:
        pytest.skip("no Chromium is installed")
    with api.sync_playwright() as play:
        running = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield running
        running.close()


@pytest.fixture
def page(browser: Any, tmp_path: Path) -> Iterator[Any]:
    """The page of a slider-crank, opened; it may say nothing on the console and ask nothing of the network."""
    file = tmp_path / "steps.html"
    file.write_text(page_of("slider-crank"), encoding="utf-8")
    found = browser.new_page(viewport={"width": 1280, "height": 800}, reduced_motion="reduce")
    complaints: list[str] = []
    found.on("console", lambda message: complaints.append(message.text))
    found.on("pageerror", lambda error: complaints.append(str(error)))
    found.on("request", lambda request: None if request.url == file.as_uri() else complaints.append(request.url))
    found.goto(file.as_uri())
    found.wait_for_selector("#turn:enabled")
    yield found
    found.close()
    assert complaints == []


def shown_steps(page: Any) -> set[int]:
    """The steps whose groups can be seen."""
    return set(page.eval_on_selector_all("g.step", "all => all.filter(g => getComputedStyle(g).display != 'none')"
                                                   ".map(g => Number(g.dataset.step))"))


def test_keys_go_through_the_steps(page: Any) -> None:
    """Arrows, Home and End move; the live region says the step, the list marks it, later steps are hidden."""
    drawn = round_of("slider-crank").drawing.drawn
    assert {step for step in shown_steps(page) if step >= drawn.givens} == set()
    for key, place in (("ArrowRight", 1), ("ArrowDown", 2), ("ArrowLeft", 1), ("End", len(drawn) - drawn.givens)):
        page.keyboard.press(key)
        last = place - 1 + drawn.givens
        told = page.inner_text("#sentence")
        assert told.startswith(f"Step {place}/")
        assert page.get_attribute("#sentence", "aria-live") == "polite"
        assert max(shown_steps(page)) <= last
        current = page.eval_on_selector_all(
            "button[data-place]", "all => all.map(one => one.getAttribute('aria-current'))")
        assert [i for i, marked in enumerate(current, 1) if marked == "step"] == [place]
        assert page.input_value("#place") == str(place)
    page.keyboard.press("Home")
    assert page.query_selector("[aria-current]") is None


def test_marks_that_a_step_reads_and_makes_are_told_apart(page: Any) -> None:
    """A crossing lights up the two lines it reads and the point it makes: by colour, width, dashes and words."""
    drawn = round_of("slider-crank").drawing.drawn
    step = next(step for step in drawn.steps if step.op.name == "meet")
    page.click(f"button[data-place='{drawn.number(step.index)}']")
    assert page.eval_on_selector_all("g.step.read", "all => all.map(g => Number(g.dataset.step))") == sorted(step.args)
    assert page.eval_on_selector_all("g.step.made", "all => all.map(g => Number(g.dataset.step))") == [step.index]
    looks = [page.eval_on_selector(f"#halos .{role} > *", "g => [getComputedStyle(g).stroke, "
                                   "getComputedStyle(g).strokeWidth, getComputedStyle(g).strokeDasharray]")
             for role in ("read", "made")]
    assert all(one != other for one, other in zip(*looks, strict=True))
    assert page.inner_text("#makes b") == drawn.text(step.index).replace("_", "")
    assert page.inner_text("#reads b").split(", ") == [drawn.text(arg) for arg in step.args]


def test_the_turn_changes_the_drawing_and_keeps_the_step(page: Any) -> None:
    """The slider of the drive redraws links and steps; the step stays, and back at 0° all is as it was."""
    page.keyboard.press("End")
    for _ in range(3):
        page.keyboard.press("ArrowLeft")
    step, before = page.input_value("#place"), page.inner_html("#picture")
    seen = shown_steps(page)
    page.focus("#turn")
    page.keyboard.press("ArrowRight")
    assert page.inner_text("#travel") == "30°"
    assert page.get_attribute("#turn", "aria-valuetext") == "30°"
    assert page.input_value("#place") == step
    assert shown_steps(page) == seen
    there = page.inner_html("#picture")
    assert there != before
    page.keyboard.press("Home")
    assert page.inner_text("#travel") == "0°"
    assert page.inner_html("#picture") == before


def test_zoom_follows_the_plan_of_the_step(page: Any) -> None:
    """Zoomed, the window is the panel of the current step's plan, and the whole sheet again when let go."""
    found = round_of("slider-crank")
    sheet, plans = found.frames[0].sheet, found.composition.plans
    whole = page.get_attribute("#picture", "viewBox")
    page.click("#zoom")
    for place in (1, len(found.drawing.drawn) - found.drawing.drawn.givens):
        page.click(f"button[data-place='{place}']")
        rect = sheet.panels[plans.plan_of_step[place - 1 + found.drawing.drawn.givens]]
        box = [float(part) for part in page.get_attribute("#picture", "viewBox").split()]
        assert box == pytest.approx([rect.left, sheet.height - rect.top, rect.width, rect.height], abs=0.01)
    assert page.get_attribute("#zoom", "aria-pressed") == "true"
    page.click("#zoom")
    assert page.get_attribute("#picture", "viewBox") == whole


def test_play_runs_and_space_stops_it(page: Any) -> None:
    """Space plays, and space again rests; at the end it rests by itself."""
    page.keyboard.press("End")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press(" ")
    assert page.inner_text("#play") == "Pause"
    page.keyboard.press(" ")
    assert page.inner_text("#play") == "Play"
    page.keyboard.press(" ")
    page.wait_for_function("document.getElementById('next').disabled")
    assert page.inner_text("#play") == "Play"


def test_a_phone_shows_it_without_sideways_scrolling(page: Any) -> None:
    """At 400 pixels nothing is wider than the screen, and every control is on it."""
    page.set_viewport_size({"width": 400, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 400
    for box in (control.bounding_box() for control in page.query_selector_all("#controls button, #controls input")):
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 400


def test_page_keys_go_from_stage_to_stage(page: Any) -> None:
    """Page Down stands on the first step of each stage in turn, Page Up goes back the same way."""
    found = round_of("slider-crank")
    firsts = [passage.entries[0].movements[0].number
              for passage in Protocol(found.composition.plans, found.composition.scales).passages]
    seen = []
    for _ in firsts:
        page.keyboard.press("PageDown")
        seen.append(int(page.input_value("#place")))
    assert seen == firsts
    for number in reversed(firsts[:-1]):
        page.keyboard.press("PageUp")
        assert int(page.input_value("#place")) == number


def test_tab_goes_through_the_controls_and_stops_once_in_the_list(page: Any) -> None:
    """Whatever the number of steps, Tab stops at the current one alone, after the controls."""
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    stops = []
    for _ in range(9):
        page.keyboard.press("Tab")
        stops.append(page.evaluate("document.activeElement.id || document.activeElement.dataset.place"))
    assert stops == ["first", "previous", "next", "last", "play", "zoom", "place", "turn", "2"]


def test_without_a_script_it_is_the_sheet_with_its_protocol(browser: Any, tmp_path: Path) -> None:
    """All that is drawn can be seen, the protocol stands beside it, and nothing that would do nothing."""
    file = tmp_path / "steps.html"
    file.write_text(page_of("slider-crank"), encoding="utf-8")
    context = browser.new_context(java_script_enabled=False)
    found = context.new_page()
    found.goto(file.as_uri())
    assert found.locator("g.step").count() == found.locator("g.step:not(.later)").count() > 0
    assert found.is_visible("#list")
    assert found.is_visible("#tables table")
    assert not found.is_visible("#controls")
    context.close()


def test_printed_it_is_the_solution_and_the_protocol(page: Any) -> None:
    """In print every step is there, nothing is lit up, and the controls are gone."""
    page.keyboard.press("ArrowRight")
    page.emulate_media(media="print")
    groups = set(page.eval_on_selector_all("g.step", "all => all.map(g => Number(g.dataset.step))"))
    assert shown_steps(page) == groups
    assert page.is_visible("#list")
    for part in ("#controls", "#told", "#halos"):
        assert page.eval_on_selector(part, "part => getComputedStyle(part).display") == "none"


def test_the_bytes_are_the_same_whatever_the_hashes() -> None:
    """Two processes with other hashes write the same page."""
    code = ("import sys, graphplan as gp; from graphplan.output.stepper import stepper; "
            "from graphplan.sheet.cycle_frames import standing; "
            "from graphplan.sheet.layout.composition import compose; "
            "drawing = gp.construct(gp.load('slider-crank')); "
            "sys.stdout.write(stepper(standing(drawing, compose(drawing, protocol='aside'))))")
    pages = {subprocess.run([sys.executable, "-c", code], capture_output=True, check=True,
                            env={"PYTHONHASHSEED": seed, "PYTHONPATH": ":".join(sys.path)}).stdout for seed in "12345"}
    assert len(pages) == 1
