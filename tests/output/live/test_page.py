"""The live page: whole and offline; in a browser, steps, keys, drags, numbers, choices, print, and what scripts see."""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from pages import Reader, chromium, opened, page_of

import graphplan as gp
from graphplan.accuracy.reach import constructions
from graphplan.commands import main
from graphplan.cycle import follow
from graphplan.kernel.program import Step
from graphplan.mechanism.scene import packaged_names
from graphplan.public.pages import plans_over_travel, turn_over_travel
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.screen import compose_for_screen
from graphplan.sheet.lettering import letters
from graphplan.sheet.lettering.letters import LetteredPlate, letter_plate
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.words import protocol
from graphplan.sheet.words.protocol import Passage, Protocol, SpokenStep
from graphplan.sheet.words.texts import SheetWords

NAME = "slider-crank"
USED = "handout", NAME, "--choices", "plans,de"
Page = Any


@cache
def composition_of(name: str) -> Composition:
    """The plans of a scene as its page lays them out."""
    drawing, *others = constructions(gp.construct(gp.load(name)))
    return compose_for_screen(plans_over_travel(drawing, others, turn_over_travel(drawing.scene)))


@cache
def text_of(*arguments: str) -> str:
    return page_of(*arguments).read_text("utf-8")


# ---- the file --------------------------------------------------------------------------------------------------------


def test_the_page_is_whole_and_well_formed() -> None:
    """Elements are closed in order, no id is given twice, and no place of the template is left unfilled."""
    reader = Reader(text_of(*USED))
    assert reader.open == []
    ids = Counter(look["id"] for _, look in reader.elements if "id" in look)
    assert max(ids.values()) == 1
    assert "{{" not in text_of(*USED)


def test_the_page_needs_no_network() -> None:
    """Its policy forbids all fetching, and nothing is referred to but what is in the page."""
    page = text_of(*USED)
    assert "default-src 'none'" in page
    assert {re.split("/+", address)[1] for address in re.findall(r"https?://[\w./]+", page)} <= {"www.w3.org"}
    looks = [look for _, look in Reader(page).elements]
    assert not [look for look in looks if {"src", "href", "xlink:href", "srcset"} & set(look)]
    assert set(re.findall(r"url\((.)", page)) <= {"#"}


@pytest.mark.parametrize("name", [NAME, "triad-loaded"])
def test_every_step_stage_and_result_stands_in_the_page_without_a_script(name: str) -> None:
    """All movements by their numbers, a heading for each stage, its equations, a row for each result."""
    composition, page = composition_of(name), text_of("live", name, "--choices", "none")
    drawn, listed = composition.plans.drawing.drawn, page[: page.index('id="scene"')]
    places = re.findall(r'data-place="(\d+)"', listed)
    assert places == [str(drawn.number(step.index)) for step in drawn.steps[drawn.givens:]]
    passages = Protocol(composition.plans, composition.scales).passages
    assert listed.count("<h4>") == sum(passage.title is not None and not passage.likewise for passage in passages)
    assert listed.count('class="equation"') == sum(
        len(passage.stage.equations) for passage in passages if passage.stage and not passage.again)
    assert listed.count("<tr>") == sum(map(len, SheetWords(composition.plans).result_tables())) > 0
    steps = set(re.findall(r'<g class="step" data-step="(\d+)"', listed))
    assert steps
    assert steps <= {"0", *places}


def test_the_scene_is_in_the_page_once() -> None:
    """The scene as it was written stands in a script of its own; what would end that is turned back by the reader."""
    from graphplan.output.live.page import escape_for_script

    page, scene = text_of(*USED), gp.load(NAME)
    assert Reader(page).scripts["scene"].replace("<\\", "<") == scene.text
    text = 'title = "</script><!-- <b>"'
    assert "</" not in escape_for_script(text)
    assert "<!--" not in escape_for_script(text)
    assert escape_for_script(text).replace("<\\", "<") == text


def test_it_is_the_same_every_time() -> None:
    """The same scene is the same bytes."""
    path = page_of("live", "four-bar", "--choices", "none")
    before = path.read_bytes()
    page_of.cache_clear()
    assert page_of("live", "four-bar", "--choices", "none").read_bytes() == before


def test_letters_are_placed_and_steps_told_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The letters of the picture that is seen first are placed, no others; the steps of each construction are told for
    the given pose and for all, its stages for all alone but where they are seen first, whatever the languages."""
    drawings = [gp.construct(gp.load("four-bar"), plan=plan) for plan in ("", "polar")]
    own, other = (len(Protocol(Plans(drawing)).passages) for drawing in drawings)
    lettered, told, staged = list[str](), list[int](), list[Passage]()

    def place(plate: Plate, *more: Any) -> LetteredPlate:
        lettered.append(plate.panel)
        return letter_plate(plate, *more)

    def tell(step: Step, *more: Any) -> SpokenStep:
        told.append(step.index)
        return SpokenStep(step, *more)

    def stage(*more: Any, **named: Any) -> Passage:
        staged.append(Passage(*more, **named))
        return staged[-1]

    monkeypatch.setattr(letters, "letter_plate", place)
    monkeypatch.setattr(protocol, "Passage", stage)
    monkeypatch.setattr(protocol, "SpokenStep", tell)
    assert main(["live", "four-bar", "--choices", "plans,de,lv", "-o", str(tmp_path / "page.html")]) == 0
    assert lettered == composition_of("four-bar").plans.panels
    assert len(told) == 2 * sum(len(drawing.drawn) - drawing.drawn.givens for drawing in drawings)
    assert len(staged) == 2 * own + other


def test_bad_input_is_refused(tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    """An ending, a choice or a plan that there is not is one line, exit 2; nothing is written."""
    for wrong in (["-o", "page.svg"], ["-o", "page.html", "--choices", "colours"], ["-o", "page.html", "--plan", "x"]):
        wrong[1] = str(tmp_path / wrong[1])
        assert main(["live", "four-bar", *wrong]) == 2
        assert len(capsys.readouterr().err.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_pages_may_share_their_script() -> None:
    """With a shared script the page refers to that, and has none of its own."""
    from graphplan.output.live.page import script

    page = shared_page()
    assert '<script src="graphplan-live.js"></script>' in page
    assert "class Motion" in script()
    assert "class Motion" not in page


def test_a_page_of_the_site_leads_back_to_it() -> None:
    """What shares a script with other pages has a link to where they begin; a page by itself has none."""
    assert '<a href="../index.html"' in shared_page()
    assert "../index.html" not in text_of(*USED)


@cache
def shared_page() -> str:
    from graphplan.output.live.page import PageVariant, live

    composition = composition_of("four-bar")
    return live([PageVariant("orthogonal", "", (composition,))], ["en"], "Four-bar", shared="graphplan-live.js")


# ---- in a browser ----------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as running:
        yield running


@pytest.fixture(scope="module")
def steps(browser: Any) -> Iterator[Page]:
    """The handout of a slider-crank."""
    with opened(browser, page_of(*USED)) as page:
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


def count_of(name: str) -> int:
    drawn = composition_of(name).plans.drawing.drawn
    return len(drawn) - drawn.givens


def test_keys_go_through_the_steps(steps: Page) -> None:
    """Arrows, Home and End move; the live region says the step, the list marks it, later steps are hidden."""
    assert shown_steps(steps) == set()
    for key, place in (("ArrowRight", 1), ("ArrowDown", 2), ("ArrowLeft", 1), ("End", count_of(NAME))):
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
    drawn = composition_of(NAME).plans.drawing.drawn
    step = next(step for step in drawn.steps if step.op.name == "meet")
    steps.click(f"button[data-place='{drawn.number(step.index)}']")
    read = sorted({drawn.number(arg) for arg in step.args} - {0})
    assert steps.eval_on_selector_all("g.step.read", "all => all.map(g => Number(g.dataset.step))") == read
    assert steps.eval_on_selector_all("g.step.made", "all => all.map(g => Number(g.dataset.step))") == [
        drawn.number(step.index)]
    looks = [steps.eval_on_selector(f"#halos .{role} > *", "g => [getComputedStyle(g).stroke, "
                                    "getComputedStyle(g).strokeWidth, getComputedStyle(g).strokeDasharray]")
             for role in ("read", "made")]
    assert all(one != other for one, other in zip(*looks, strict=True))
    assert steps.inner_text("#makes b") == drawn.text(step.index).replace("_", "")
    assert steps.inner_text("#reads b").split(", ") == [drawn.text(arg) for arg in step.args]


def test_page_keys_go_from_stage_to_stage(steps: Page) -> None:
    """Page Down stands on the first step of each stage in turn, Page Up goes back the same way."""
    composition = composition_of(NAME)
    firsts = [passage.entries[0].movements[0].number
              for passage in Protocol(composition.plans, composition.scales).passages]
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
    composition = composition_of(NAME)
    drawn, plans, high = composition.plans.drawing.drawn, composition.plans, composition.arrangement.height
    whole = steps.get_attribute("#picture", "viewBox")
    steps.click("#zoom")
    for place in (1, count_of(NAME)):
        steps.click(f"button[data-place='{place}']")
        rect = composition.arrangement.panels[plans.plan_of_step[place - 1 + drawn.givens]]
        box = [float(part) for part in steps.get_attribute("#picture", "viewBox").split()]
        assert box == pytest.approx([rect.left, high - rect.top, rect.width, rect.height], abs=0.01)
    assert steps.get_attribute("#zoom", "aria-pressed") == "true"
    steps.click("#zoom")
    assert steps.get_attribute("#picture", "viewBox") == whole


def test_tab_stops_once_in_the_list_of_steps(steps: Page) -> None:
    """Whatever the number of steps, Tab stops at the current one alone, after the points and the controls."""
    steps.keyboard.press("ArrowRight")
    steps.keyboard.press("ArrowRight")
    results = steps.locator("#strip button").count()
    controls = ["variant", "language", "summary", "print", "copy", *"OABS", *["button"] * results, "told", "run",
                "pace", "home", "drive", "travel", "first", "previous", "next", "last", "place", "zoom", "values",
                "fold", "2"]
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
    steps.emulate_media(media="print")
    assert len(shown_steps(steps)) > 20
    assert steps.is_visible("#list")
    wide = composition_of(NAME).arrangement.width
    assert steps.locator("#picture").bounding_box()["width"] == pytest.approx(wide * 96 / 25.4, abs=1)
    for part in ("#controls", "#told", "#halos", "#handles"):
        assert steps.eval_on_selector(part, "part => getComputedStyle(part).display") == "none"


def test_without_a_script_it_is_the_sheet_with_its_protocol(browser: Any) -> None:
    """All that is drawn can be seen, the protocol stands beside it, and nothing that would do nothing."""
    context = browser.new_context(java_script_enabled=False)
    found = context.new_page()
    found.goto(page_of(*USED).as_uri())
    assert found.locator("g.step").count() == found.locator("g.step:not(.later)").count() > 0
    assert found.is_visible("#list")
    assert found.is_visible("#tables table")
    assert not found.is_visible("#controls")
    context.close()


def test_results_and_words_are_python_s_in_other_poses(browser: Any) -> None:
    """Over a burst of poses, results within 1e-9 of Python's, and the tables told by the same numbers."""
    drawing = composition_of("four-bar").plans.drawing
    turn = follow(drawing.scene, 9)
    poses = drawing.evaluate(turn.points)
    with opened(browser, page_of("live", "four-bar", "--choices", "none")) as page:
        assert page.evaluate("[graphplan.step === graphplan.steps, graphplan.said]") == [True, ""]
        found = page.evaluate("Array.from({length: 9}, (_, k) => { graphplan.travel = 40 * k; "
                              "const told = document.querySelector('#tables').textContent; "
                              "return [graphplan.results(), graphplan.points(), told]; })")
        for k, (results, points, told) in enumerate(found):
            for name, z in turn.points.items():
                assert complex(*points[name]) == pytest.approx(complex(z[k]), abs=1e-9 * 500)
            for name, rates in results["points"].items():
                for kind, named in (("velocity", poses.velocity), ("acceleration", poses.acceleration)):
                    wanted = complex(named[name][k])
                    assert complex(*rates[kind]) == pytest.approx(wanted, abs=1e-9 * max(abs(wanted), 100))
            speed = gp.phrases.digits(abs(complex(poses.velocity["M"][k])))
            assert speed in unescape(told)


@pytest.mark.parametrize("name", packaged_names()[2::6])
def test_pages_of_packaged_scenes_move(browser: Any, name: str) -> None:
    """Between its limits a mechanism moves and its points are dragged, and nobody complains."""
    with opened(browser, page_of("live", name, "--choices", "none")) as page:
        low, high = (limit if limit is not None else end
                     for limit, end in zip(page.evaluate("graphplan.limits()"), (-170, 170), strict=True))
        for k in range(1, 8):
            travel = low + (high - low) * k / 8
            page.evaluate(f"graphplan.travel = {travel}")
            assert page.evaluate("graphplan.travel") == pytest.approx(travel, abs=1e-9)
            assert page.evaluate("graphplan.said") or page.evaluate("graphplan.results()")
        page.evaluate("for (const [name, [x, y]] of Object.entries(graphplan.points())) graphplan.drag(name, x + 1, y)")
        assert all(math.isfinite(one) for place in page.evaluate("graphplan.points()").values() for one in place)


def test_a_shared_script_serves_from_the_disk(browser: Any, tmp_path: Path) -> None:
    """A page whose script stands beside it moves as others do."""
    from graphplan.output.live.page import script

    page = tmp_path / "page.html"
    page.write_text(shared_page(), "utf-8")
    (tmp_path / "graphplan-live.js").write_text(script(), "utf-8")
    found = browser.new_page()
    found.goto(page.as_uri())
    found.evaluate("graphplan.ready")
    assert found.evaluate("graphplan.travel = 12; graphplan.results().points.A.velocity.length") == 2
    found.close()


def test_a_limit_stops_it_with_its_reason(browser: Any) -> None:
    """A rocker that runs reaches its limit, rests and says why, and runs back the next time."""
    path = page_of("live", "triad-loaded", "--choices", "none")
    with opened(browser, path, reduced_motion="no-preference") as page:
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


def test_what_cannot_be_moved_says_why(browser: Any) -> None:
    """An open chain with given motions has the steps, controls that are off, and the reason."""
    with opened(browser, page_of("live", "open-chain", "--choices", "none")) as page:
        assert "the motion of points is given" in page.evaluate("graphplan.said")
        assert page.is_disabled("#drive")
        page.keyboard.press("Home")
        page.keyboard.press("ArrowRight")
        assert page.evaluate("graphplan.step") == 1
        assert page.evaluate("graphplan.limits()") == [0, 0]
        assert json.dumps(page.evaluate("graphplan.results()"))


def test_a_script_that_asks_for_what_there_is_not_is_told(browser: Any) -> None:
    """A name that is no point's, and places that are no numbers, are refused in words; the pose stays."""
    with opened(browser, page_of("live", "four-bar", "--choices", "none")) as page:
        before = page.evaluate("graphplan.points()")
        for asked in "screen('Z')", "drag('Z', 1, 2)", "drag('A', NaN, 2)", "drag('A')":
            told = page.evaluate(f"(() => {{try {{graphplan.{asked};}} catch (error) {{return String(error);}}}})()")
            assert told.startswith("RangeError: "), asked
            assert "undefined" not in told.partition(", not to")[0], asked
            assert page.evaluate("graphplan.points()") == before, asked
