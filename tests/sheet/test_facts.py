"""The first page of every sheet says the problem and the answer: what is given, and what was found."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
import shapely
from inked_sheet import InkedSheet, label
from sheets import SCENES, composition_of, drawing_of, pages_of

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import Pencil
from graphplan.accuracy.survey.growth import chain
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.scene import load, parse
from graphplan.methods.kinds import VELOCITY
from graphplan.output.svg import svg
from graphplan.sheet.handout import task
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.lettering.lettering import SMALL_SHEET
from graphplan.sheet.words.facts import given_facts, machine_facts
from graphplan.sheet.words.found_facts import found_facts
from graphplan.sheet.words.rows import zero_rounding

NS = "{http://www.w3.org/2000/svg}"
FOUR_BAR = gp.load("four-bar")


@cache
def page(name: str, is_task: bool = False) -> ET.Element:
    """The first page of a scene's sheet, or of its task."""
    sheet = task(composition_of(name))[0] if is_task else pages_of(name)[0]
    return ET.fromstring(svg(sheet).encode())


def words_of(root: ET.Element, group: str) -> str:
    """All lettering of the groups of a class."""
    return " ".join("".join(text.itertext()) for element in root.iter(f"{NS}g") if element.get("class") == group
                    for text in element.iter(f"{NS}text"))


@pytest.mark.parametrize("name", SCENES)
def test_the_first_page_says_problem_and_answer(name: str) -> None:
    """Every fact stands on it, with its unit; on a task what is given alone."""
    drawing = drawing_of(name)
    given, found = words_of(page(name), "given"), words_of(page(name), "found")
    assert all(str(fact.value) in given for fact in given_facts(drawing.scene) if " " not in fact.value)
    values = zero_rounding(drawing.computed, drawing.scene.extent, drawing.kappa)
    assert all(str(fact.value) in found for fact in found_facts(drawing, values))
    assert words_of(page(name, True), "given") == given
    assert not words_of(page(name, True), "found")


@pytest.mark.parametrize("name", [*SCENES, "open-chain", "ozols-5-2"])
def test_what_is_found_is_what_was_asked(name: str) -> None:
    """Each velocity, acceleration and rate of the results that the scene does not prescribe is told, and as it is."""
    drawing = drawing_of(name)
    facts = {(fact.kind, fact.of): fact for fact in found_facts(drawing, drawing.computed)}
    prescribed = {(reading.kind, reading.of) for reading in drawing.readings if reading.given is not None
                  and reading.of in {drive.link for drive in drawing.scene.drives if drive.on == FRAME}}
    for kind in ("velocity", "acceleration", "omega", "alpha"):
        for of, value in drawing.computed.get(kind, {}).items():
            if (kind, of) not in prescribed:
                size = math.hypot(*value) if isinstance(value, tuple) else value
                told = str(facts[kind, of].value).replace("−", "-").replace("·10", "e").translate(
                    str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
                assert float(told) == pytest.approx(size, rel=6e-4, abs=1e-9)


@pytest.mark.parametrize("name", [*SCENES, "rosenauer-loaded"])
def test_given_and_found_have_one_heading_each(name: str) -> None:
    """Neither is split, however little room plans leave."""
    assert [words_of(page(name), group).split().count(heading) for group, heading in (
        ("given", "Given"), ("found", "Found"))] == [1, 1]


@pytest.mark.parametrize("name", SCENES)
def test_facts_lie_on_nothing(name: str) -> None:
    """No line runs through them and no letters stand on them."""
    sheet = InkedSheet(page(name))
    facts = [label for label in sheet.labels if label.key in ("given", "found")]
    others = [label.box for label in sheet.labels if label not in facts]
    assert not [fact.text for fact in facts for box in others if fact.box.intersection(box).area > 0.02]
    assert not [fact.text for fact in facts for stroke in sheet.strokes if fact.box.crosses(stroke.line)]


@pytest.mark.parametrize("name", SCENES)
def test_facts_lie_inside_the_frame(name: str) -> None:
    """With the errors told, too, no line of them is longer than its column."""
    sheet = InkedSheet(ET.fromstring(svg(layout(composition_of(name))).encode()))
    (frame,) = (rect for rect in sheet.root.iter(f"{NS}rect") if rect.get("class") == "frame")
    x, y, wide, high = (float(frame.get(key, 0)) for key in ("x", "y", "width", "height"))
    inside = shapely.box(x, y, x + wide, y + high)
    facts = [label(key, element) for key, element in sheet.texts if key in ("given", "found")]
    assert facts
    assert not [fact.text for fact in facts if not inside.contains(fact.box)]


@pytest.mark.parametrize("name", ["class-four-loaded", "four-bar", "plough-lift", "slotted-link"])
def test_what_is_given_is_read_before_what_was_found(name: str) -> None:
    """Where there is room for that: what was found stands below it, or to the right."""
    givens, results = ([column for place in composition_of(name).arrangement.facts if layer in place.layers
                        for column in place.columns] for layer in FACTS)
    assert givens
    assert results
    assert all(above is column or above.bottom >= column.top or above.right <= column.left
               for above in givens for column in results)  # in one column they stand in this order


@pytest.mark.parametrize("name", ["jaanimets-11", "ozols-13-7"])
def test_no_column_has_one_or_two_results(name: str) -> None:
    """What was found has three results at least in each column, also under its heading."""
    texts = [text for element in page(name).iter(f"{NS}g") if element.get("class") == "found"
             for text in element.iter(f"{NS}text") if "".join(text.itertext()) != "Found"]
    columns = Counter(text.get("x") or text.get("transform") for text in texts)
    assert min(columns.values()) >= 3


@pytest.mark.parametrize(("name", "is_larger"), [("gear-linkage", True), ("geneva", True), ("rosenauer-basic", False)])
def test_facts_have_larger_letters_where_there_is_room(name: str, is_larger: bool) -> None:
    """They are set in the letters of the marks, else in those of the words."""
    sizes = {float(text.get("font-size", 0)) for element in page(name).iter(f"{NS}g") if element.get("class") == "found"
             for text in element.iter(f"{NS}text")}
    assert (max(sizes) > SMALL_SHEET.text) == is_larger


def test_facts_that_have_no_room_stand_with_the_words() -> None:
    """On named paper that is full at a given scale they begin the pages of words, with or without a protocol there."""
    scene = gp.load("alt-ten-link")
    drawing = gp.construct(replace(scene, sheet=replace(scene.sheet, k_s=Fraction(10, 3))))
    for protocol in ("auto", "none"):
        composition = compose(drawing, "A4", protocol=protocol)
        assert not composition.arrangement.facts
        layers = [row.layer for _, rows in composition.protocol for row, _, _ in rows]
        assert layers[0] == "given"
        assert "found" in layers
        assert ("text" in layers) == (protocol == "auto")


def test_on_the_largest_sheet_facts_stand_with_the_words_too() -> None:
    """What is given and found of many links has no room beside their plans on A0, and is not refused for that."""
    composition = compose(gp.construct(chain(39)))
    assert (composition.arrangement.paper, composition.arrangement.facts) == ("A0", ())
    assert "found" in [row.layer for _, rows in composition.protocol for row, _, _ in rows]


def test_links_are_given_by_their_lengths() -> None:
    """Of a four-bar: the sides of its links, the frame, angle and rate of its crank, and no coordinates of joints."""
    facts = {str(fact.symbol): str(fact.value) for fact in given_facts(FOUR_BAR)}
    assert facts == {"OA": "111.8", "AB": "162.63", "AM": "174.64", "BM": "164.47", "BC": "285.04", "OC": "(310, 0)",
                     "phi_1": "79.695°", "omega_1": "10"}


def test_the_second_wheel_of_a_link_has_a_prime() -> None:
    """Of David's gear both wheels of the planet are told apart; a wheel in two meshes is told once."""
    teeth = {name: [(str(fact.symbol), str(fact.value)) for fact in given_facts(gp.load(name))
                    if str(fact.symbol).startswith("z")] for name in ("david", "planetary")}
    assert teeth["david"] == [("z_1", "100"), ("z_2", "101"), ("z_2'", "100"), ("z_0", "99")]
    assert teeth["planetary"] == [("z_1", "20"), ("z_2", "30"), ("z_0", "80")]


def test_what_a_pencil_is_off_is_told_from_one_percent_on() -> None:
    """A result that is drawn well bears no error; one that is not, one relative to its own size."""
    drawing = drawing_of("rosenauer-basic")
    drafted = draft(drawing, Pencil())
    facts = found_facts(drawing, drawing.computed, drafted.deviations)
    errors = {(result.kind, result.of): result.deviation.value for result in drafted.results}
    assert all(("±" in fact.text) == (fact.relative is not None and fact.relative > 0.01) for fact in facts)
    (fact,) = (fact for fact in facts if (fact.kind, fact.of) == ("acceleration", "D"))
    size = math.hypot(*drawing.computed["acceleration"]["D"])
    assert fact.relative == pytest.approx(errors["acceleration", "D"] / size)
    assert str(fact.text).endswith(f"± {100 * fact.relative:.2g} %")


def test_facts_are_told_in_the_language_of_the_sheet() -> None:
    """Topics, units and decimals are those of the tongue."""
    text = words_of(ET.fromstring(gp.sheet.svg(drawing_of("four-bar"), language="ru").encode()), "given")
    assert text.startswith("Дано Звенья: OA = 111,8, AB = 162,63")
    assert "рад/с" in text


def test_no_line_is_broken_inside_a_fact() -> None:
    """Letter, value and unit stand on one line, and so do both coordinates of a place."""
    lines = ["".join(text.itertext()) for name in ("class-four-loaded", "five-bar", "rosenauer-loaded")
             for element in page(name).iter(f"{NS}g") if element.get("class") == "given"
             for text in element.iter(f"{NS}text")]
    assert not [line for line in lines if line.endswith("=") or line[0] in "=−0123456789" or "\u00a0" in line]


def test_a_spring_is_given_by_its_law() -> None:
    """Its stiffness, its length without force and the formula of its pull at both ends; no computed force."""
    scene = gp.scene({"title": "spring", "points": {"O": (0, 0), "A": (24, 18), "F": (0, 90)},
                      "links": {"1": "O A", "frame": "O F"}, "drive": [{"link": "1", "omega": 2}],
                      "springs": [{"ends": ["A", "F"], "stiffness": 2.5, "free": 20}], "balance": {"link": "1"}})
    loads = [str(fact.quantity) for fact in given_facts(scene)][-3:]
    assert loads == ["c_AF = 2.5 N/mm", "l_0AF = 20 mm", "P_1 = c_AF (AF − l_0AF)"]
    root = ET.fromstring(gp.sheet.svg(gp.construct(scene)).encode())
    zigzags = [line for element in root.iter(f"{NS}g") if element.get("class") == "layer-machine"
               for line in element.iter(f"{NS}polyline")]
    assert any(len(line.get("points", "").split()) > 10 for line in zigzags)


def test_rounding_is_no_result() -> None:
    """Where a link turns back its points stand still: what is rounding beside the largest of its kind is 0."""
    drawing = gp.construct(gp.at(gp.load("shaper"), "outer 3"))
    values = zero_rounding(drawing.computed, drawing.scene.extent, drawing.kappa)
    facts = {str(fact.symbol): fact for fact in found_facts(drawing, values)}
    assert str(facts["v_B"].value) == str(facts["v_T"].value) == "0"
    assert str(facts["K"].value) == "2.735"
    assert not any("10⁻" in fact.value for fact in facts.values())


def test_an_angle_that_is_rounding_is_nothing() -> None:
    """A vector along the x-axis, but for rounding, points at 0 or at 180 degrees, whichever way that is off."""
    drawing = gp.construct(gp.load("four-bar"))
    ways = [(5.0, 1e-14), (5.0, -1e-14), (-5.0, 1e-14), (-5.0, -1e-14), (5.0, 0.01)]
    angles = [found_facts(drawing, {VELOCITY: {"B": way}})[0].unit.partition("∠ ")[2] for way in ways]
    assert angles == ["0°", "0°", "180°", "180°", "0.1146°"]


def test_loads_that_change_are_given_by_their_laws_over_the_cycle() -> None:
    """A flywheel's sheet tells the rows of a load, a plate what it is in its pose."""
    law, force = (str(facts(load("ozols-13-6"))[-1].text) for facts in (machine_facts, given_facts))
    assert law == "P_3 = a load over 3 along frame, in 4 rows: (0.6; 1000), (0.2; 1000), (0.2; −1000), (0.6; −1000) N"
    assert force.startswith("P_3 at ")


@pytest.mark.parametrize(("powers", "law"), [
    ("[100]", "100"), ("[0, -100]", "−100 v"), ("[5, 0, -0.5]", "5 − 0.5 v |v|"), ("[-5, 2, 1]", "−5 + 2 v + 1 v |v|"),
    ("[0, 0]", "0"),
])
def test_loads_by_powers_of_a_speed_are_sums(powers: str, law: str) -> None:
    """With the signs of their terms, and without those that are nothing."""
    text = load("ozols-13-6").text
    rows = re.compile(r'over *= "3 along frame"\nvalues .*')
    assert rows.search(text)
    scene = parse(rows.sub(f'over = "speed of 3 along frame"\npowers = {powers}', text), "powers")
    assert str(machine_facts(scene)[-1].text) == f"P_3 = {law} (v: speed of 3 along frame) N"
