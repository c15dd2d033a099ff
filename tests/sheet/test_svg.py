"""The SVG text of a sheet: valid, in millimetres, the same every time, and measurable."""

from __future__ import annotations

import math
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import cache

import pytest
from command_line import run
from sheets import SCENES, drawing_of, pages_of, sheet_of
from svg2 import INKSCAPE, faults

import graphplan as gp
from graphplan.kernel.kinds import LINE, OPENING
from graphplan.output.svg import svg

NS = "{http://www.w3.org/2000/svg}"
ROUNDED = 0.03  # mm: coordinates are rounded to hundredths


@cache
def svg_of(name: str) -> str:
    return gp.sheet.svg(gp.construct(gp.load(name)))


def test_it_is_valid_xml_in_millimetres() -> None:
    """The root has its size in mm and a viewBox of as many units, a title and a description."""
    root = ET.fromstring(svg_of("four-bar").encode())
    assert root.tag == f"{NS}svg"
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("297mm", "210mm", "0 0 297 210")
    assert root.findtext(f"{NS}title") == gp.load("four-bar").title
    assert "k_s" in (root.findtext(f"{NS}desc") or "")


@pytest.mark.parametrize("name", SCENES)
def test_every_page_is_svg_2(name: str) -> None:
    """No page has an element, an attribute or a value that SVG 2 does not have there, nor two things of one name."""
    for page in pages_of(name):
        assert not faults(svg(page))


def test_layers_have_names_in_the_language_of_the_sheet() -> None:
    """Inkscape lists each layer and each step by a name and an identifier; a part of a web page has neither."""
    sheet = replace(sheet_of("four-bar"), language="de")
    drawn, within = (ET.fromstring(svg(sheet, alone=alone).encode()) for alone in (True, False))
    found = {group.get("id"): group.get(f"{INKSCAPE}label") for group in drawn.findall(f"{NS}g")}
    assert (found["step-3"], found["step-0"]) == ("Schritt 3", "Gegeben")
    assert "layer-links" in found
    assert all(group.get(f"{INKSCAPE}groupmode") == "layer" for group in drawn.findall(f"{NS}g"))
    assert not [element for element in within.iter() if element.get("id", "scene") != "scene"]


@pytest.mark.parametrize(("name", "plan"), [("four-bar", "polar"), ("ozols-10-1", "")])
def test_the_sheet_of_python_is_that_of_the_command(name: str, plan: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Byte for byte: with the drawing errors told, and as many pages in the title block."""
    assert run("draw", name, *(("--plan", plan) if plan else ())) == 0
    assert gp.sheet.svg(gp.construct(gp.load(name), plan=plan)) == capsys.readouterr().out


def test_it_is_the_same_every_time() -> None:
    """A second run, in another process with other hashes, gives the same bytes."""
    code = "import sys, graphplan as gp; sys.stdout.write(gp.sheet.svg(gp.construct(gp.load('slotted-link'))))"
    env = {"PYTHONHASHSEED": "7", "PYTHONPATH": ":".join(sys.path)}
    run = subprocess.run([sys.executable, "-X", "utf8", "-c", code], env=env, capture_output=True, check=True)
    assert run.stdout.decode() == svg_of("slotted-link")


@pytest.mark.parametrize("name", ["four-bar", "triad-loaded"])
def test_every_drawn_step_has_its_group_by_its_number(name: str) -> None:
    """There is one group for each step that leaves ink, in order, titled with its sentence; the given points are 0.

    What leaves none is an opening, or a line that lies already.
    """
    drawing, first, *words = drawing_of(name), *map(svg, pages_of(name))
    groups = [[g for g in ET.fromstring(page.encode()) if g.get("class") == "step"] for page in (first, *words)]
    numbers = [[int(g.get("data-step", -1)) for g in page] for page in groups]
    assert all(page == sorted(set(page)) for page in numbers)
    sentences = pages_of(name)[0].sentences[drawing.drawn.givens - 1:]
    inkless = set(range(1, len(sentences))) - {number for page in numbers for number in page}
    drawn = drawing.drawn
    assert {drawn.steps[drawn.givens + number - 1].op.gives for number in inkless} <= {OPENING, LINE}
    assert [g.findtext(f"{NS}title") for g in groups[0] if g.get("data-step") != "0"] == [
        sentences[number] for number in numbers[0] if number]


def test_a_velocity_can_be_measured() -> None:
    """With nothing but the SVG text: a vector's ends, turned back and times the k_v that it tells, are the velocity."""
    drawing = gp.construct(gp.load("four-bar"))
    root = ET.fromstring(svg_of("four-bar").encode())
    found = re.search(r"mechanism plan: k_s = (\S+) mm/mm, k_v = (\S+) mm/s", root.findtext(f"{NS}desc") or "")
    assert found is not None
    k_v = float(found[2])
    arrows = {g.get("data-vector"): g for g in root.iter(f"{NS}g")}
    for point, velocity in drawing.velocity.items():
        assert abs(measured(arrows[f"velocity {point}"]) / 1j * k_v - velocity) < ROUNDED * k_v


def measured(arrow: ET.Element) -> complex:
    """A vector as it is drawn, in mm, y upwards."""
    (x, y), (u, v) = (map(float, (arrow.get(key) or "").split()) for key in ("data-from", "data-to"))
    return complex(u - x, y - v)


@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
@pytest.mark.parametrize("name", SCENES)
def test_everything_drawn_measures_what_is_printed(name: str, plan: str) -> None:
    """Every velocity and acceleration on a sheet, measured in the SVG and times its plan's scale, is the result."""
    drawing, sheet = drawing_of(name, plan), sheet_of(name, plan=plan)
    seen = set()
    for arrow in ET.fromstring(svg(sheet).encode()).iter(f"{NS}g"):
        kind, _, point = (arrow.get("data-vector") or "").partition(" ")
        if kind in ("velocity", "acceleration"):
            x, y = map(float, (arrow.get("data-from") or "").split())
            panel = next(panel for panel, rect in sheet.panels.items() if rect.holds((x, sheet.height - y)))
            turned = 1j if kind == "velocity" and plan == "orthogonal" else 1.0
            scale = sheet.scales.speed(panel) if kind == "velocity" else sheet.scales.acceleration(panel)
            value = (drawing.velocity if kind == "velocity" else drawing.acceleration)[point]
            assert abs(measured(arrow) / turned * scale - value) < ROUNDED * scale, (kind, point)
            seen.add((kind, point))
    asked = {("velocity", p): v for p, v in drawing.velocity.items()}
    asked |= {("acceleration", p): v for p, v in drawing.acceleration.items()}
    largest = {kind: max((abs(v) for (k, _), v in asked.items() if k == kind), default=0.0) for kind, _ in asked}
    assert {key for key, value in asked.items() if abs(value) > 0.05 * largest[key[0]]} <= seen


@pytest.mark.parametrize("name", ["four-bar", "slotted-link"])
def test_numbers_are_rounded_and_finite(name: str) -> None:
    """No coordinate has more than two decimals and no radius more than four; none is nan or minus zero."""
    text = re.sub(r"<(title|desc|text|tspan)[^>]*>[^<]*", "", svg_of(name))
    radii = re.findall(r'(?:\br="|\bA )([\d.]+)', text)
    assert radii
    assert all(len(r.partition(".")[2]) <= 4 for r in radii)
    text = re.sub(r'\br="[\d.]+"|\bA [\d.]+ [\d.]+', "", text)
    numbers = re.findall(r"(?<![\w#.])-?\d+\.?\d*(?:e-?\d+)?(?![\w.])", text)
    assert all(len(n.partition(".")[2]) <= 2 for n in numbers if n != "1.0")
    assert not re.search(r"\bnan\b|\binf\b|[\" ,]-0(\.0*)?[\" ,]", text)


def test_subscripts_are_shifted_and_shifted_back() -> None:
    """Subscripts are tspans with dy, undone by the next run, as baseline-shift is not portable."""
    assert "baseline-shift" not in svg_of("four-bar")
    for text in ET.fromstring(svg_of("four-bar").encode()).iter(f"{NS}text"):
        shifts = [float(span.get("dy", 0)) for span in text]
        assert not shifts or abs(math.fsum(shifts)) < 1e-9 or text[-1].get("font-size")


@pytest.mark.costly
def test_solving_imports_no_drawing_library() -> None:
    """A construction's numbers and its sheet come without matplotlib."""
    code = """
import sys, graphplan as gp
drawing = gp.construct(gp.load('four-bar')); drawing.velocity
assert 'matplotlib' not in sys.modules, 'numbers'
gp.sheet.svg(drawing)
assert 'matplotlib' not in sys.modules, 'sheet'
"""
    subprocess.run([sys.executable, "-c", code], env={"PYTHONPATH": ":".join(sys.path)}, check=True)


def test_the_scene_is_embedded_once() -> None:
    """The text of the scene stands in the sheet, whole and once, so that a sheet can be drawn anew."""
    root = ET.fromstring(svg_of("four-bar").encode())
    texts = [element.text or "" for element in root.iter(f"{NS}metadata")]
    assert [gp.parse(text, "four-bar") for text in texts] == [gp.load("four-bar")]
    assert svg_of("four-bar").count("[points]") == 1


@pytest.mark.parametrize("name", ["four-bar", "triad-loaded"])
def test_the_frame_and_the_panel_of_each_plan_are_named(name: str) -> None:
    """A program finds each plan's panel by the name that the plan has in the list of steps."""
    drawing = drawing_of(name)
    rects = ET.fromstring(svg_of(name).encode()).iter(f"{NS}rect")
    named = [(rect.get("class"), rect.get("data-plan")) for rect in rects if rect.get("class")]
    assert named[0] == ("frame", None)
    assert {plan for _, plan in named[1:]} == {step.panel for step in drawing.drawn.steps}
