"""Live pages of tasks in a browser: what is dragged or typed is found as Python finds it, and what does not exist is
told.
"""

from __future__ import annotations

import math
import tomllib
from pathlib import Path
from random import Random
from typing import Any

import pytest
from face import ran
from live_browser import opened
from tasks import TASKS, written

import graphplan as gp

MOVED = {name: TASKS[name] for name in ("three positions", "fixed pivots", "two positions", "four positions", "rocker",
                                        "slide", "slider-crank", "crank-rocker", "best", "lever", "cognates",
                                        "slider's cognate")} | {
    "five positions": "[guidance]\npositions = [[0, 0, 0], [1.8, 0.1, 21], [3.1, 1, 47], [4.4, 1.9, 85], "
                      "[5.7, 2.2, 115]]",
    "rod": "[stroke]\nratio = 1.3\nstroke = 100\nrod = 120",
    "crank": "[stroke]\nratio = 1.3\nstroke = 100\ncrank = 45",
}
DRAGS = 12


def page_of(text: str, folder: Path, **options: Any) -> Path:
    """The page of a task."""
    (folder / "task.toml").write_text(text)
    gp.synthesize(folder / "task.toml").live(folder / "page.html", **options)
    return folder / "page.html"


def found_by_python(kind: str, given: dict[str, Any], folder: Path) -> Any:
    """The solutions for what a page gives, as `synthesize` has them; None where nothing is found, or nothing is asked
    in earnest. What a function is compared at asks for no other linkage."""
    request = {key: value for key, value in given.items() if value not in (None, [], 0.0, "", 0) and key != "compare"}
    if kind == "stroke":
        key, size = request.pop("given")
        request |= {key: size} if key else {}
        request |= {"lever": {"ground": request["lever"]}} if "lever" in request else {}
    try:
        return gp.synthesize(written(folder, f"[{kind}]\n" + "".join(
            f"{key} = {toml(value)}\n" for key, value in request.items()))).json()["solutions"]
    except gp.GraphplanError:
        return None


def toml(value: Any) -> str:
    """A value as TOML has it."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(part)}" for key, part in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else repr(value)


def alike(one: Any, two: Any, tolerance: float) -> bool:
    """Whether two solutions have the same numbers."""
    if isinstance(one, dict):
        return all(alike(one[key], two[key], tolerance) for key in one)
    if isinstance(one, list | tuple):
        return two is not None and len(one) == len(two) and all(
            alike(p, q, tolerance) for p, q in zip(one, two, strict=True))
    return math.isclose(one, two, rel_tol=tolerance, abs_tol=tolerance) if isinstance(one, float | int) else one == two


def change(page: Any, dice: Random, share: float) -> None:
    """Something that is given is dragged, or typed where nothing can be dragged."""
    handles = page.evaluate("graphplan.points()")
    far = share * max([math.dist(p, q) for p in handles.values() for q in handles.values()], default=0)
    if handles and far:
        name, (x, y) = dice.choice(sorted(handles.items()))
        page.evaluate("([name, x, y]) => graphplan.drag(name, x, y)",
                      [name, x + dice.uniform(-far, far), y + dice.uniform(-far, far)])
        return
    path = dice.choice([cell for row in page.evaluate("graphplan.fields()") for cell in row if isinstance(cell, list)])
    value = dice.uniform(1.02, 1.5) if path == ["ratio"] else dice.uniform(0.7, 1.4) * page.evaluate(
        "path => path.reduce((inner, key) => inner[key], graphplan.given())", path)
    page.evaluate("([path, value]) => graphplan.set(path, value)", [path, value])


@pytest.mark.parametrize("name", MOVED)
def test_what_is_moved_is_found_as_python_finds_it(name: str, tmp_path: Path) -> None:
    """Points, lengths, type, travel, defects and angles are those of `synthesize`; where it finds nothing the page has
    nothing, dashes and a reason; so it has where a crank-rocker is found on other sides than its construction has."""
    kind = next(key for key in tomllib.loads(MOVED[name]) if key != "units")
    dice, told = Random(name), 0
    with opened(page_of(MOVED[name], tmp_path)) as page:
        for _ in range(DRAGS):
            change(page, dice, 0.03 if name == "five positions" else 0.3)
            results, given = page.evaluate("graphplan.results()"), page.evaluate("graphplan.given()")
            if kind == "cognates":
                continue
            by_python = found_by_python(kind, given, tmp_path / "python.toml")
            if results is None:
                assert page.evaluate("graphplan.said")
                assert "–" in page.inner_text("#found")
                assert not any(character.isdigit() for character in page.inner_text("#found tr:first-child td"))
                assert by_python is None or name == "five positions" or (  # found on other sides than are drawn
                    kind == "stroke" and "cannot be drawn" in page.evaluate("graphplan.said"))
                page.evaluate("graphplan.reset()")
                continue
            told += 1
            tolerance = 1e-5 if name in ("best", "five positions", "four positions") else 1e-7
            wanted = results | {"transmission": results["transmission"]["least"]}
            assert by_python
            assert any(alike(wanted, one | {"transmission": one["transmission"]["least"]}, tolerance)
                       for one in by_python), (given, results, by_python[0])
            if results["defects"]:
                assert page.evaluate("graphplan.said")
    assert told or kind == "cognates"


def test_a_hand_drags_a_position_and_the_linkage_follows(tmp_path: Path) -> None:
    """A pointer moves the handle of a position; the linkage's positions are the given ones, keys still step, and going
    home brings the task back."""
    with opened(page_of(MOVED["three positions"], tmp_path)) as page:
        before = page.evaluate("graphplan.results()")
        x, y = page.evaluate("graphplan.screen('M_2')")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 30, y - 20, steps=5)
        page.mouse.up()
        given, after = page.evaluate("graphplan.given()"), page.evaluate("graphplan.results()")
        assert given["positions"][1] != [5.6, 6.4, 0]
        assert given["positions"][0] == [0, 0, 90]
        assert after["lengths"]["O A"] != before["lengths"]["O A"]
        assert after["lengths"]["A B"] == pytest.approx(before["lengths"]["A B"])
        page.keyboard.press("Home")
        page.keyboard.press("ArrowRight")
        assert page.evaluate("[graphplan.step, graphplan.results()]") == [1, after]
        page.click("#home")
        assert page.evaluate("graphplan.results()") == before


def test_what_does_not_exist_has_dashes_and_a_reason(tmp_path: Path) -> None:
    """Positions on a line have no circle: no linkage, no number but what is given, and the points are named."""
    with opened(page_of(MOVED["three positions"], tmp_path)) as page:
        for k in range(3):
            page.evaluate("k => graphplan.set(['positions', k, 2], 0)", k)
            page.evaluate("k => graphplan.set(['positions', k, 0], 2 * k)", k)
            page.evaluate("k => graphplan.set(['positions', k, 1], k)", k)
        assert page.evaluate("graphplan.results()") is None
        assert "A_1, A_2, A_3 lie in a line" in page.evaluate("graphplan.said")
        assert not any(sign.isdigit() for sign in page.inner_text("#found"))
        assert page.is_disabled("#run")
        assert page.locator(".layer-linkage > *").count() == 0


def test_defects_are_told_for_moved_positions(tmp_path: Path) -> None:
    """A linkage that cannot go through its positions says so, and how."""
    with opened(page_of(TASKS["three positions"], tmp_path, language="de")) as page:
        page.evaluate("graphplan.drag('M_3', 1, 1.5)")
        defects = page.evaluate("graphplan.results().defects")
        assert defects
        assert page.evaluate("graphplan.results().travel") is None
        assert page.inner_text("#said").count("fehler:") == len(defects)


def test_the_page_goes_through_the_steps_in_any_language(tmp_path: Path) -> None:
    """A handout opens at the first step, and angles in sentences are those that are given now."""
    task = tmp_path / "task.toml"
    task.write_text(TASKS["rocker"])
    assert ran("handout", str(task), "-q", "--language", "lv", "-o", str(tmp_path / "page.html")).status == 0
    with opened(tmp_path / "page.html") as page:
        assert page.evaluate("graphplan.step") == 0
        steps = page.evaluate("graphplan.steps")
        assert steps == gp.synthesize(task).json()["steps"]
        for _ in range(steps):
            page.click("#next")
        assert page.evaluate("graphplan.step") == steps
        assert page.is_disabled("#next")
        page.evaluate("graphplan.set(['input', 0], 42.5)")
        assert "42,5" in page.inner_text("[data-place='1']")
        page.select_option("#language", "en")
        assert "at 42.5° to the x-axis" in page.inner_text("[data-place='1']")


def test_the_linkage_runs_through_its_positions(tmp_path: Path) -> None:
    """While it runs the crank turns, and it stops where it began."""
    with opened(page_of(MOVED["rocker"], tmp_path)) as page:
        page.evaluate("graphplan.step = graphplan.steps")
        standing = page.locator(".link").first.get_attribute("points")
        page.evaluate("""() => {  // its time goes four times as fast
            const begun = performance.now(), frame = requestAnimationFrame.bind(window);
            window.pins = [];
            window.requestAnimationFrame = tick => frame(now => {
                tick(begun + 4 * (now - begun));
                window.pins.push(document.querySelector(".link").getAttribute("points"));
            });
        }""")
        page.click("#run")
        page.get_by_role("button", name="Play").wait_for()
        assert len({*page.evaluate("window.pins")}) > 3
        assert page.locator(".link").first.get_attribute("points") == standing


def test_a_task_without_a_linkage_has_no_page(tmp_path: Path) -> None:
    """Where no linkage is chosen nothing can be dragged: the page is refused, and nothing is written."""
    with pytest.raises(gp.Refused, match="no linkage is chosen"):
        page_of(f"{TASKS['four positions'].partition('moving')[0]}table = [0, 1]", tmp_path)
    assert not (tmp_path / "page.html").exists()


def test_command_and_python_write_one_page(tmp_path: Path) -> None:
    """`graphplan live TASK` and `gp.live` of what is found write the same page."""
    assert ran("live", "guidance-moving", "-q", "-o", str(tmp_path / "command.html")).status == 0
    gp.live(found := gp.synthesize("guidance-moving"), tmp_path / "python.html")
    found.live(tmp_path / "method.html")
    assert len({(tmp_path / f"{name}.html").read_bytes() for name in ("command", "python", "method")}) == 1
