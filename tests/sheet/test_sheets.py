"""Particular sheets, as their SVG has them: borders, papers, plans, details, machines, and what students are handed."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from collections import Counter
from itertools import pairwise
from pathlib import Path

import pytest
import shapely
from face import Got, got, names, ran
from handed_out import handed_out
from inked_sheet import CAPITALS, NS, InkedSheet, said

import graphplan as gp

FIELDS = {"A4": (6, 4), "A3": (8, 6), "A2": (12, 8), "A1": (16, 12), "A0": (24, 16)}  # ISO 5457, table 2
SUMS = {  # of polar plans: chains of vectors that begin at the pole, and the whole vector
    "four-bar": [(["normal BC", "tangential BC"], "acceleration B"),
                 (["acceleration A", "normal BA", "tangential BA"], "acceleration B"),
                 (["normal AO"], "acceleration A"), (["velocity A", "relative BA"], "velocity B")],
    "slotted-link": [(["normal A3P", "tangential A3P"], "acceleration A3"),
                     (["acceleration A", "coriolis A3", "sliding A3"], "acceleration A3"),
                     (["velocity A", "relative A3A"], "velocity A3")],
    "triad": [(["acceleration A", "normal EA", "tangential EA"], "acceleration E")],
}
STRANGERS = Path(__file__).parents[1] / "cases" / "strangers" / "more"
SAME_MM = 0.03
MAX_WORDS = 1215  # and numbers of the steps of Rosenauer's own example, with all equations and lengths


def border(sheet: InkedSheet) -> list[tuple[str, float, float]]:
    """The lettering of the border, with its places."""
    return [(said(text), float(text.get("x", 0)), float(text.get("y", 0))) for group in sheet.root.findall(f"{NS}g")
            if group.get("class") == "layer-border" for text in group.iter(f"{NS}text")]


# ---- paper -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("paper", FIELDS)
def test_fields_are_those_of_iso_5457(paper: str) -> None:
    """Fields are as many as in the standard's table, named on both sides, on A4 on one, without I and O; the frame is
    20 mm from the left edge and 10 mm from the others."""
    sheet = got("four-bar").sheets("--paper", paper)[0]
    across, upwards = FIELDS[paper]
    fields = [*"ABCDEFGHJKLMNPQRSTUVWXYZ"[:upwards], *map(str, range(1, across + 1))]
    assert Counter(text for text, _, _ in border(sheet)) == dict.fromkeys(fields, 1 if paper == "A4" else 2)
    _, _, wide, high = map(float, sheet.root.get("viewBox", "").split())
    assert sheet.frame.bounds == (20, 10, wide - 10, high - 10)
    down = sorted((y, text) for text, x, y in border(sheet) if text.isalpha() and x > wide / 2)
    assert [text for _, text in down] == fields[:upwards]


def test_the_frame_of_gost_is_as_wide_as_its_forms() -> None:
    """The frame is 20 mm from the left edge and 5 mm from the others; form 1 is 185 mm wide and 55 mm high."""
    sheet = got("four-bar").sheets("--paper", "A3", "--set", "sheet.frame=gost")[0]
    assert sheet.frame.bounds == (20, 5, 415, 292)
    lines = [[tuple(map(float, spot.split(","))) for spot in line.get("points", "").split()]
             for group in sheet.root.findall(f"{NS}g") if group.get("class") == "layer-paper"
             for line in group.iter(f"{NS}polyline")]
    upright = sorted({line[0][0] for line in lines if line[0][0] == line[1][0]})
    assert [round(b - a, 2) for a, b in pairwise((*upright, 415.0))] == [7, 10, 23, 15, 10, 70, 5, 5, 5, 5, 12, 18]


@pytest.mark.parametrize(("paper", "mark", "text"), [("A4", 2.5, 1.8), ("A3", 2.5, 1.8), ("A2", 3.5, 1.8)])
def test_letters_grow_with_the_paper(paper: str, mark: float, text: float) -> None:
    """Capitals of marks are as high as is told for the paper, those of words high enough to be read."""
    first, *others = got("four-bar").sheets("--paper", paper, "--set", "sheet.protocol=pages")
    sizes = [float(element.get("font-size", 0)) * CAPITALS for key, element in first.texts
             if key == "layer-letters" and said(element) in "OABCM"]
    assert sizes == pytest.approx([mark] * 5, abs=0.03)
    assert min(page.smallest_letters for page in (first, *others)) >= text


@pytest.mark.parametrize(("name", "paper"), [("rosenauer-basic", "A3"), ("four-bar", "A4"), ("slider-crank", "A4")])
def test_paper_serves_the_worst_result(name: str, paper: str) -> None:
    """Where a result would be more than a tenth off, the paper is as large as is usual for so many links, no larger."""
    pencil = got(name).steps["pencil"]
    assert pencil["paper"] == paper
    assert pencil["worst result"]["relative"] <= 0.1


@pytest.mark.parametrize(("source", "angle", "extents"), [("own-rocker-1", angle, far) for angle, far in (
    (60, 1.6), (108, 3.8), (124, 7.9), (148, 4.1))] + [("own-poles-m", None, 0)])
def test_poles_that_are_asked_for_lie_on_the_paper(source: str, angle: int | None, extents: float) -> None:
    """Up to ten times the size of the mechanism away a pole is marked on its panel, at a smaller scale or on larger
    paper."""
    at = ["--set", f"points.A.angle={angle}"] if angle else []
    one = Got(STRANGERS / f"{source}.toml")
    if angle:
        away = math.hypot(*one.data("solve", *at)["poles"]["3 frame"]["at"])
        assert away / float(one.scene.replace("points.A.angle", angle).extent) == pytest.approx(extents, abs=0.05)
    told, sheet = one.data("steps", "--json", *at), one.sheets(*at)[0]
    panel = sheet.panels["mechanism"].buffer(SAME_MM)
    poles = [step["paper"] for step in told["steps"] if step["makes"].startswith("P_") and step["kind"] == "point"]
    assert poles
    assert all(panel.contains(shapely.Point(pole)) for pole in poles)


def test_python_draws_what_the_command_does_every_time() -> None:
    """A sheet of `gp.sheet.svg` is that of `draw` byte for byte, in another process with other hashes too, and in a
    notebook."""
    code = "import sys, graphplan as gp; sys.stdout.write(gp.sheet.svg(gp.construct(gp.load('slotted-link'))))"
    env = {"PYTHONHASHSEED": "7", "PYTHONPATH": ":".join(sys.path)}
    run = subprocess.run([sys.executable, "-X", "utf8", "-c", code], env=env, capture_output=True, check=True)
    drawn = ran("draw", "slotted-link").out
    assert run.stdout.decode() == drawn == gp.construct(gp.load("slotted-link"))._repr_svg_()
    polar = gp.sheet.svg(gp.construct(gp.load("four-bar"), plan="polar"))
    assert polar == ran("draw", "four-bar", "--plan", "polar").out


@pytest.mark.parametrize("how", ["--paper A2 --set sheet.frame=gost --language de --plan polar",
                                 "--strict --by sheet --prefer quick",
                                 "--set sheet.curves=all --set sheet.positions=4"])
def test_steps_speak_of_the_sheet_that_the_same_options_draw(how: str) -> None:
    """`steps --json` takes the options of `draw` that change the sheet, and tells where that has each mark."""
    one, options = got("five-bar"), how.split()
    sheet = one.sheets(*options)[0]
    told = one.data("steps", "--json", *[word for word in options if word not in ("--by", "sheet")])["steps"]
    places = {str(step["number"]): step["paper"] for step in told if step["kind"] == "point" and step["number"]}
    marks = [(key, spot) for key, spot in sheet.marks_on_plans if key != "0"]
    assert len(marks) > 3
    assert not [key for key, spot in marks if math.dist(places[key], (spot.x, spot.y)) > SAME_MM]


# ---- plans -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SUMS)
def test_vectors_of_polar_plans_stand_head_to_tail(name: str) -> None:
    """Each part begins where the one before it ends, the first at the pole; the last ends where their sum does."""
    ends = {vector.name: vector.line.coords for vector in got(name).sheets("--plan", "polar")[0].vectors}
    for chain, whole in SUMS[name]:
        assert all(math.dist(ends[one][1], ends[two][0]) < SAME_MM for one, two in pairwise(chain)), chain
        assert math.dist(ends[chain[0]][0], ends[whole][0]) < SAME_MM, chain
        assert math.dist(ends[chain[-1]][1], ends[whole][1]) < SAME_MM, chain


def test_kinds_of_vectors_are_told_apart_without_colour() -> None:
    """Velocities, accelerations, loads and reactions differ in their shafts or heads."""
    looks = dict[str, set[tuple[object, ...]]]()
    for group in got("jaanimets-10").sheet.root.iter(f"{NS}g"):
        if kind := (group.get("data-vector") or "").partition(" ")[0]:
            lines, heads = group.findall(f"{NS}polyline"), group.findall(f"{NS}polygon")
            shaft = [(line.get("stroke-width"), line.get("stroke-dasharray")) for line in lines[:1]]
            looks.setdefault(kind, set()).add((*shaft, len(heads), heads[-1].get("fill") == "#ffffff"))
    kinds = [looks[kind] for kind in ("velocity", "acceleration", "load", "reaction")]
    assert all(len(kind) == 1 for kind in kinds)
    assert len(set().union(*kinds)) == 4


def test_friction_circles_are_seen() -> None:
    """A circle that a pin would cover has a detail, where the force touches it."""
    group = next(group for group in got("kinytskyi").sheet.root if group.get("class") == "layer-details")
    circles = [circle for circle in group.findall(f"{NS}circle") if float(circle.get("r", 0)) > 1]
    forces = [force for force in group.findall(f"{NS}g") if force.get("class") == "vector"]
    assert len(circles) == len(forces) == 7
    for circle, force in zip(circles, forces, strict=True):
        start, end = (complex(*map(float, (force.get(key) or "").split())) for key in ("data-from", "data-to"))
        centre = complex(float(circle.get("cx", 0)), float(circle.get("cy", 0)))
        arm = abs(((centre - start).conjugate() * (end - start)).imag) / abs(end - start)
        assert arm == pytest.approx(float(circle.get("r", 0)), abs=0.02)


def test_a_crank_that_its_pins_cover_has_a_detail() -> None:
    """Its pins are as many times as far apart in the window as the caption says, and all in the window is of it."""
    one = Got(STRANGERS.parents[1] / "accuracy" / "short-crank.toml")
    sheet = one.sheet
    (caption,) = (text for key, element in sheet.texts if "Detail" in (text := said(element)))
    times = float(caption.split()[2])
    detail = [element for group in sheet.root if group.get("class") == "layer-enlarged" for element in group]
    pins = [complex(float(e.get("cx", 0)), float(e.get("cy", 0))) for element in detail for e in element.iter(
        f"{NS}circle") if 0.7 < float(e.get("r", 0)) < 2]
    on_plan = math.hypot(2, 2.2) / sheet.scale("mechanism", "s")
    assert len(pins) >= 2
    assert max(abs(p - q) for p in pins for q in pins) == pytest.approx(times * on_plan, abs=0.05)
    texts = {said(e) for element in detail for e in element.iter(f"{NS}text")}
    assert {"O", "A"} <= texts


@pytest.mark.parametrize(("name", "strokes"), [("planetary", 3), ("biplanetary", 3), ("racks", 2), ("geneva", 2),
                                               ("slotted-link", 2), ("arc-cam", 1), ("four-bar", 0)])
def test_a_machine_is_drawn_whole_under_its_mechanism(name: str, strokes: int) -> None:
    """Teeth, slots, Geneva wheels and cams lie in the panel and end nowhere at its edge; a linkage of bars has none."""
    sheet = got(name).sheet
    lines = [stroke.line for stroke in sheet.strokes if stroke.key == "layer-machine"]
    assert (len(lines) >= strokes) if strokes else not lines
    if name != "racks":
        edge = sheet.panels["mechanism"].exterior
        assert not [line for line in lines if line.distance(edge) < 0.05]


@pytest.mark.parametrize("name", ["planetary", "gear-linkage"])
def test_teeth_stand_in_gaps(name: str) -> None:
    """Flanks of two wheels touch and do not run along or through each other."""
    lines = [stroke.line for stroke in got(name).sheet.strokes
             if stroke.key == "layer-machine" and stroke.line.length > 20]
    assert lines
    assert all(one.intersection(two).length < 0.5 for k, one in enumerate(lines) for two in lines[:k])


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "plough-lift"])
def test_the_motion_leaves_letters_free_and_is_whole(name: str) -> None:
    """No path and no position goes through letters; letters stand where they stand without positions."""
    curves = ",".join((*got(name).scene.points,)[1:2])
    options = ("--set", f'sheet.curves=["{curves}"]', "--set", "sheet.positions=8")
    sheet = got(name).sheets(*options)[0]
    moving = [stroke for stroke in sheet.strokes if stroke.key == "layer-motion"]
    assert len(moving) > 8
    assert sheet.lines_through_labels == []
    edge = sheet.panels["mechanism"].buffer(SAME_MM)
    assert all(edge.covers(stroke.line) for stroke in moving)


def test_a_stage_is_grey_before_its_steps() -> None:
    """With `--steps A-B` what was drawn before them is paler, and stands where it stands on the sheet."""
    part, until = got("four-bar").sheets("--steps", "5-9")[0], got("four-bar").sheets("--steps", "1-9")[0]
    assert [key for key, _ in part.elements] == [key for key, _ in until.elements]
    for (key, one), (_, two) in zip(part.elements, until.elements, strict=True):
        assert one.get("points") == two.get("points")
        paler = {key for key in ("stroke", "fill") if one.get(key) != two.get(key)}
        assert not paler or (key.isdigit() and int(key) < 5)


def test_pages_of_stages_and_strips_are_apart_and_show_each_step() -> None:
    """Strips and pages of stages keep letters apart and in the frame; a picture a step has every number."""
    for options in (("--strip",), ("--strip", "step"), ("--by", "stages")):
        pages = got("four-bar").sheets(*options)
        assert all(page.letters_on_letters == page.outside == [] for page in pages)
        told = [said(element) for page in pages for _, element in page.texts]
        runs = [tuple(map(int, text.split("–"))) for text in told if re.fullmatch(r"\d+(–\d+)?", text)]
        assert {number for run in runs for number in range(run[0], run[-1] + 1)} >= {*range(1, 38)}


# ---- words -----------------------------------------------------------------------------------------------------------


def test_likes_are_told_briefly() -> None:
    """What is done as before is told in few words, and what goes on under a title has no second one."""
    protocol = got("rosenauer-basic").protocol
    steps = protocol.partition("On the mechanism plan:")[2].partition("Measured")[0]
    assert sum(bool(re.search(r"\w", word)) for word in steps.split()) <= MAX_WORDS
    assert protocol.count("Likewise") > 10
    assert "continued" not in protocol
    for title in ("Velocity of M, N, L, K", "Locus of v_d, v_e, v_b, v_a", "Normal acceleration of C about D"):
        assert protocol.count(title) == 1
    russian = got("rosenauer-basic").printed("steps", "--language", "ru")
    assert "Скорости точек D, E, A, B" in russian
    assert "Скорость точки C" in russian


@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_a_plan_is_told_in_one_go(plan: str) -> None:
    """Where links read each other in a ring, too: all but the mechanism's plan are left when they are done."""
    told = got("class-four-loaded").printed("steps", "--plan", plan)
    plans = re.findall(r"^On the (.+):$", told, re.MULTILINE)
    others = [one for one in plans if one != "mechanism plan"]
    assert len(others) == len(set(others)) >= 4


@pytest.mark.parametrize(("name", "values"), [
    ("triad-loaded", ["ω1 = 10 rad/s", "P4 = 161.6 N", "M5 = 4 N·m"]), ("five-bar", ["ω1 = 10 rad/s", "ω4 = 10 rad/s"]),
    ("open-chain", ["vK = 80 mm/s", "ω21 = 0.8 rad/s"]),
])
def test_a_task_shows_what_drives_and_loads_the_mechanism(name: str, values: list[str]) -> None:
    """Each drive, given motion, force and moment has its value on the panel of the mechanism."""
    page = handed_out(name)[0][0]
    panel = page.panels["mechanism"]
    assert {*values} <= {one.text for one in page.lettering if panel.intersects(one.box)}


def test_every_page_of_a_task_bears_marks_of_its_own() -> None:
    """The marks in the corners of pages, and of other scenes and papers, differ."""
    marks = []
    for pages in (handed_out("alt-eight-link")[0], handed_out("four-bar")[0], handed_out("slider-crank")[0]):
        marks += [tuple(element.get("points") for key, element in page.elements if key == "layer-corner marks")
                  for page in pages[:2]]
    assert all(marks)
    assert len({*marks}) == len(marks)


def test_a_teacher_has_a_word_on_the_task() -> None:
    """`[sheet] task` stands at the head of the task; a length stands once in words, and once in the figure."""
    wish = "Find the velocity of M, then check the rocker."
    words = " ".join(one.text for page in handed_out("four-bar", ("sheet.task", wish))[0] for one in page.lettering)
    assert wish in words
    assert words.count("162.63") == 2


@pytest.mark.parametrize("name", names("tasks"))
def test_sheets_of_syntheses_can_be_read(name: str) -> None:
    """No letter lies on another or is nearer to another mark, none is too small, no line runs through, scales are
    round, and panels are not sparse."""
    sheet = InkedSheet.of(gp.synthesize(name)._repr_svg_())
    assert (sheet.labels_on_labels, sheet.labels_nearer_to_others, sheet.odd_scales) == ([], [], [])
    assert (sheet.lines_through_labels, sheet.long_leaders) == ([], [])
    assert sheet.smallest_letters >= 1.8
    assert sheet.ink_of_panels >= 0.2 - 0.02
