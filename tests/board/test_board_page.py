"""The board in Chromium, by mouse and keys alone: mechanisms from nothing, saved and solved; edits, faults, words."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from drawn_board import Page, Server, board, served
from wild import WildHand

import graphplan as gp

O, P, A, B, C = (0, 180), (0, 0), (-120, 180), (-200, 300), (-350, 340)  # of a shaper


@pytest.fixture(scope="module")
def saving(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Server, Path]]:
    """A board with a file, which is not there yet."""
    path = tmp_path_factory.mktemp("board") / "drawn.toml"
    with served(path) as server:
        yield server, path


@pytest.fixture
def page(saving: tuple[Server, Path]) -> Iterator[Page]:
    """An empty board."""
    with board(saving[0]) as found:
        yield found


def four_bar(page: Page) -> None:
    """Draws the packaged four-bar, without its coupler point."""
    page.tool("Point")
    page.press((0, 0), (20, 110), (135, 225), (310, 0))
    page.tool("Link")
    page.link((0, 0), (20, 110))
    page.link((20, 110), (135, 225))
    page.link((135, 225), (310, 0))
    page.tool("Fixed pivot")
    page.press((0, 0), (310, 0))
    page.tool("Drive")
    page.press((10, 55))
    page.tool("Ask")
    page.press((135, 225))


def saved(page: Page, path: Path) -> gp.Scene:
    """The scene that the page saves."""
    page.tool("Save")
    page.page.get_by_text("Saved").wait_for()
    return gp.load(path)


def test_a_four_bar_from_nothing(page: Page, saving: tuple[Server, Path]) -> None:
    """Points, links, pivots, drive and question by the mouse; the saved file gives the numbers of the packaged one."""
    four_bar(page)
    shown, results = page.results(), gp.solve(saved(page, saving[1]))
    assert shown == results.json()
    expected = gp.solve(gp.load("four-bar"))
    assert results.velocity["C"] == pytest.approx(expected.velocity["B"])
    assert results.acceleration["C"] == pytest.approx(expected.acceleration["B"])
    assert page.faults() == []


def test_a_shaper_from_nothing(page: Page, saving: tuple[Server, Path]) -> None:
    """A quick-return with two sliding pairs, along a link and along the frame: the ram's numbers are those of the same
    scene as text."""
    page.tool("Point")
    page.press(O, P, A, B, C)
    page.tool("Link")
    for link in ((O, A), (A,), (P, B), (B, C), (C,)):
        page.link(*link)
    page.tool("Fixed pivot")
    page.press(O, P)
    page.tool("Slide")
    page.press(A, (-100, 150))  # along the rocker
    page.press(C, (-250, 340))  # along the frame
    page.tool("Drive")
    page.press((-60, 180))
    page.tool("Ask")
    page.press(C)
    page.settle()
    written = gp.scene({
        "points": {"O": O, "P": P, "A": A, "B": B, "C": C},
        "links": {"1": "O A", "2": "A", "3": "P B", "4": "B C", "5": "C", "frame": "O P"},
        "slides": [{"link": "2", "along": "3", "at": "A", "direction": "P B"},
                   {"link": "5", "along": "frame", "at": "C", "direction": [1, 0]}],
        "drive": [{"link": "1", "omega": 10}], "find": {"velocity": ["C"], "acceleration": ["C"]}})
    results, expected = gp.solve(saved(page, saving[1])), gp.solve(written)
    assert results.velocity["E"] == pytest.approx(expected.velocity["C"])
    assert results.acceleration["E"] == pytest.approx(expected.acceleration["C"])


def test_a_crank_from_nothing_by_keys_alone(page: Page) -> None:
    """Tools by their keys; arrows lead the place, space presses, Enter ends a link."""
    keys = page.page.keyboard
    page.page.locator("#drawing").focus()
    right, left = ["ArrowRight"] * 4, ["ArrowLeft"] * 4
    for key in ("p", "ArrowUp", " ", *right, " ", "l", " ", *left, " ", "Enter", "f", " ", "d", " "):
        keys.press(key)
        page.settle()
    assert len(page.scene().split("\n[")) == 3
    assert [*page.results()["points"]]
    keys.press("Escape")
    keys.press("Control+z")
    assert "drive" not in page.scene()


def test_undo_goes_back_over_everything(page: Page) -> None:
    """Drawing, dragging, erasing, loading and typing are undone one by one, to nothing, and done again."""
    states = [page.scene()]

    def act(deed: Any, *arguments: Any) -> None:
        deed(*arguments)
        states.append(page.scene())

    page.tool("Point")
    act(page.press, (0, 0))
    act(page.press, (100, 50))
    page.tool("Select")
    act(page.drag, (100, 50), (60, 90))
    act(page.load, gp.load("four-bar").text)
    page.page.get_by_role("tab", name="Scene").click()
    act(page.page.locator("#text").fill, "# typed\n" + states[-1])
    page.tool("Erase")
    act(page.press, (-20, 280))
    assert len({*states}) == len(states)
    for state in reversed(states[:-1]):
        page.tool("Undo")
        assert page.scene() == state
    assert page.page.get_by_role("button", name="Undo").is_disabled()
    for state in states[1:]:
        page.tool("Redo")
        assert page.scene() == state


def test_the_text_is_edited_both_ways(page: Page) -> None:
    """What is typed is drawn; what is drawn is written in the text, where comments stay."""
    text = "# mine\n[points]\nA = [0, 0]  # the pin\n"
    page.page.get_by_role("tab", name="Scene").click()
    page.page.locator("#text").fill(text)
    page.tool("Point")
    page.press((50, 50))
    assert page.scene() == text + "B = [50, 50]\n"
    assert page.page.locator("#text").input_value() == text + "B = [50, 50]\n"
    assert page.page.get_by_label("Point B").count() == 1


def test_typed_lengths_hold_while_points_are_dragged(page: Page) -> None:
    """A length that is typed at a link is kept when its points are dragged by the mouse."""
    four_bar(page)
    page.tool("Select")
    page.press((10, 55))
    page.page.get_by_role("textbox", name="AB mm").fill("100")
    page.page.keyboard.press("Enter")
    before = gp.parse(page.scene()).points["B"]
    page.drag(tuple(map(float, before)), (90, 20))
    place = complex(*map(float, gp.parse(page.scene()).points["B"]))
    assert abs(place) == pytest.approx(100)
    assert place.real > 80


def test_a_force_is_drawn(page: Page) -> None:
    """A press on a point and a release make a force, and the reactions and the balance come."""
    four_bar(page)
    page.tool("Load")
    page.drag((135, 225), (185, 205))
    assert gp.parse(page.scene()).loads.forces[0].value == (50, -20)
    assert {"balance", "reactions"} <= {*page.results()}


def test_a_fault_stands_beside_its_object(page: Page) -> None:
    """What is missing is said in the command's words, in the list and on the drawing; the next right word ends it."""
    page.load('[points]\nA = [0, 0]\nB = [50, 0]\n[links]\n1 = "A B X"\n')
    with pytest.raises(gp.SceneError) as refused:
        gp.parse(page.scene())
    assert page.faults() == [line.removeprefix("scene: ") for line in refused.value.lines]
    assert page.results() is None
    drawn = page.page.locator("#drawing .layer-faults title").all_text_contents()
    assert any("there is no point X" in text for text in drawn)
    page.load(gp.load("four-bar").text)
    assert page.faults() == []
    assert page.page.locator("#faults").is_hidden()


def test_a_singular_pose_is_said(page: Page) -> None:
    """Where there are no results the reason is a fault, in the command's words."""
    page.load('[points]\nO = [0, 0]\nA = [100, 0]\nB = [300, 0]\nC = [200, 0]\n[links]\n1 = "O A"\n2 = "A B"\n'
              '3 = "B C"\nframe = "O C"\n[[drive]]\nlink = "1"\nomega = 1\n')
    with pytest.raises(gp.GraphplanError) as singular:
        gp.solve(gp.parse(page.scene()))
    assert page.faults() == [line.removeprefix("scene: ") for line in singular.value.lines]


HOSTILE = '<img src=x onerror="window.hacked=1"><script>window.hacked=1</script>'


def test_text_of_a_scene_is_never_executed(page: Page) -> None:
    """A title, a name and a fault with markup stand as text, on the page and on the sheet."""
    name = "<b>x</b>"
    text = gp.load("four-bar").text.replace("Four-bar linkage with a coupler point", json.dumps(HOSTILE)[1:-1])
    page.load(text.replace('["A", "B", "M"]', f'["A", "{name}", "M"]').replace("B = ", f'"{name}" = ', 1)
              .replace('"A B M"', f'"A {name} M"').replace('"B C"', f'"{name} C"').split("[vary]")[0])
    for tab in ("Sheet", "Steps", "Results", "Scene"):
        page.page.get_by_role("tab", name=tab).click()
        page.settle()
    assert name in page.results()["points"]
    page.load(f"[points]\nA = [0, 0]\n[links]\n1 = {json.dumps(HOSTILE)}\n")
    assert page.faults()
    assert page.page.evaluate("window.hacked") is None
    assert page.page.locator("#faults img, #faults script, h1 b").count() == 0


@pytest.mark.parametrize(("language", "word"), [("de", "Auswählen"), ("uk", "Точка"), ("et", "Lüli")])
def test_the_page_speaks_the_browsers_language(saving: tuple[Server, Path], language: str, word: str) -> None:
    """Buttons have the words of the browser's language, and then those of the scene's."""
    with board(saving[0], locale=language) as page:
        page.page.get_by_role("button", name=word, exact=True).wait_for()
        page.load(gp.load("four-bar").text.replace("[sheet]", '[sheet]\nlanguage = "ru"'))
        page.page.get_by_role("button", name="Звено", exact=True).wait_for()


def test_a_file_is_dropped(page: Page, tmp_path: Path) -> None:
    """A scene, or a file of another program, that is opened takes the place of the drawing."""
    from graphplan.commands import main

    assert main(["export", "four-bar", "-q", "-o", str(tmp_path / "linkage.ggb")]) == 0
    page.page.locator("#file").set_input_files(tmp_path / "linkage.ggb")
    page.page.get_by_text("Four-bar linkage").first.wait_for()
    assert page.scene() == gp.load("four-bar").text


def test_the_mechanism_runs(page: Page) -> None:
    """A slider takes the mechanism around its travel; the given pose and the text stay."""
    page.load(gp.load("four-bar").text)
    places = [page.page.locator("[data-object='point A'] circle").first.get_attribute("cx")]
    for travel in ("30", "0"):
        page.page.locator("#travel").fill(travel)
        page.settle()
        places.append(page.page.locator("[data-object='point A'] circle").first.get_attribute("cx"))
    assert places[0] == places[2] != places[1]
    assert page.scene() == gp.load("four-bar").text


def test_it_can_be_used_with_a_finger(saving: tuple[Server, Path]) -> None:
    """On a phone taps draw, and a second tap on the last point ends a link."""
    with board(saving[0], viewport={"width": 390, "height": 844}, has_touch=True) as page:
        def tap(place: tuple[float, float]) -> None:
            page.page.touchscreen.tap(*page.at(place))

        page.tool("Point")
        for place in ((-100, 0), (100, 100)):
            tap(place)
        page.tool("Link")
        for place in ((-100, 0), (100, 100), (100, 100)):
            tap(place)
        assert gp.parse(page.scene() + '[[drive]]\nlink = "1"\nomega = 1\n[motion.A]\nvelocity = [1, 0]\n').links


def test_nothing_at_random_breaks_it(saving: tuple[Server, Path]) -> None:
    """After presses, drags, keys, undos and malformed text at random the page has no error, and draws as ever."""
    with board(saving[0]) as page:
        hand = WildHand(page, int(os.environ.get("GRAPHPLAN_SEED", "4")))
        for _ in range(100):
            hand.act()
        page.load("")
        four_bar(page)
        assert page.results()["points"]


def test_every_control_has_a_name_and_is_readable(page: Page) -> None:
    """axe finds nothing serious: names, roles, contrast, in light and dark, with a mechanism and with faults."""
    axe = pytest.importorskip("axe_core_python.sync_playwright").Axe()
    whole, begun = gp.load("four-bar").text, "[points]\nA = [0, 0]\n"
    for look, text, tab in (("light", whole, "Results"), ("light", begun, "Scene"), ("dark", whole, "Steps"),
                            ("dark", begun, "Results")):
        page.page.emulate_media(color_scheme=look)
        page.load(text)
        page.press((0, 0))
        page.page.get_by_role("tab", name=tab).click()
        page.settle()
        found = axe.run(page.page)["violations"]
        assert [(one["id"], [node["html"] for node in one["nodes"]]) for one in found
                if one["impact"] in ("serious", "critical")] == []
