"""Forces on the sheet: their lengths, letters, scales and tables, of every packaged scene with loads."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import replace

import pytest
from sheets import LOADED, composition_of, drawing_of, outside, sheet_of

import graphplan as gp
from graphplan.kernel.numbers import Floats
from graphplan.methods.panels import ForcePlan, LeverPlan
from graphplan.output.text import steps
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Polyline, Sheet, Text
from graphplan.sheet.plates.lever_arms import lever_arms
from graphplan.sheet.plates.plans import MECHANISM
from graphplan.sheet.plates.plate import MIN_LOAD_MM, SHORT
from graphplan.sheet.words.force_tables import ForceTables


def tables_of(name: str) -> ForceTables:
    drawing = drawing_of(name)
    return ForceTables(drawing, drawing.read(Floats()))


def told(table: list[list[tuple[object, ...]]]) -> dict[str, list[str]]:
    """A table as text, by the first cell of each row."""
    return {plain(row[0]): [plain(cell) for cell in row[1:]] for row in table}  # type: ignore[arg-type]


def drawn(sheet: Sheet, kind: str, label: str) -> Iterator[tuple[str, float]]:
    """Every arrow of a force: on which panel it stands, and what it measures in units of force."""
    for item in sheet.items:
        if isinstance(item, Arrow) and item.label == f"{kind} {label}":
            panel = next(name for name, rect in sheet.panels.items() if rect.holds(item.start) and rect.holds(item.end))
            yield panel, math.dist(item.start, item.end) * sheet.scales.force(panel)


def lettered(sheet: Sheet, panel: str) -> set[str]:
    """The letters of marks and vectors on a panel."""
    labels = (item.label for item in sheet.items if isinstance(item, Text) and sheet.panels[panel].holds(item.at))
    return {name for label in labels for name in (*label.split(","), *label.split())}


@pytest.mark.parametrize("name", LOADED)
def test_every_force_is_drawn_phi_lengths_long(name: str) -> None:
    """An arrow measures what its marks are apart, at the scale of lengths times the multiple of its plan."""
    drawing, sheet = drawing_of(name), sheet_of(name)
    for vector in (vector for vector in drawing.arrows if vector.kind in pens.FORCES):
        (x, y), (u, v) = (drawing.values[mark] for mark in (vector.start, vector.end))
        true = math.hypot(u - x, v - y) / sheet.scales.lengths_per_mm(vector.panel)
        arrows = [item for item in sheet.items if isinstance(item, Arrow) and item.step == max(vector.start, vector.end)
                  and item.label == f"{vector.kind} {vector.point}"]  # fmt: skip
        assert bool(arrows) == (true >= (MIN_LOAD_MM if vector.panel == MECHANISM else SHORT))
        assert all(math.dist(arrow.start, arrow.end) == pytest.approx(true) for arrow in arrows)


@pytest.mark.parametrize("name", LOADED)
def test_given_forces_measure_what_the_scene_gives(name: str) -> None:
    """Millimetres times k_F are the newtons of the scene, on the force plan, on the lever and where the force acts."""
    scene, sheet = gp.load(name), sheet_of(name)
    counts: dict[str, int] = {}
    for force in scene.loads.forces if scene.loads else ():
        counts[force.on] = counts.get(force.on, -1) + 1
        arrows = list(drawn(sheet, "load", f"P_{force.on}" + "'" * counts[force.on]))
        assert arrows
        for _, size in arrows:
            assert size == pytest.approx(math.hypot(*map(float, force.value)))


@pytest.mark.parametrize("name", LOADED)
def test_reactions_measure_what_the_tables_tell(name: str) -> None:
    """Each row of the tables has the letter of an arrow on the force plans, and the newtons that it measures: of those
    with friction in the last round."""
    sheet = sheet_of(name)
    labels = {v.label.replace("_", "") for v in drawing_of(name).arrows if v.kind == "reaction"}
    for table, rubbed in zip(tables_of(name).reactions(), (False, True), strict=False):
        for row, (_, _, size, *_) in told(table[1:]).items():
            letter = row.partition(" at ")[0]
            assert letter in labels
            arrows = drawn(sheet, "reaction", letter.replace("R", "R_"))
            sizes = [force for panel, force in arrows if ("with friction" in panel) == rubbed][-1 if rubbed else 0:]
            assert sizes == [pytest.approx(float(size), rel=1e-3)] * len(sizes)


@pytest.mark.parametrize("name", LOADED)
def test_every_force_has_its_letter_on_its_plan(name: str) -> None:
    """Each arrow of a force is lettered on its panel, those that lie on each other together."""
    sheet = sheet_of(name)
    for vector in (vector for vector in drawing_of(name).arrows if vector.kind in pens.FORCES):
        if vector.panel in {panel for panel, _ in drawn(sheet, vector.kind, vector.label)}:
            assert vector.label in lettered(sheet, vector.panel)


@pytest.mark.parametrize("name", LOADED)
def test_captions_tell_the_scale_of_forces(name: str) -> None:
    """Every panel with a force has k_F in its heading of up to three large lines; the lever has k_v, too."""
    sheet, drawing = sheet_of(name), drawing_of(name)
    lines = {panel: " ".join(plain(text.runs) for text in sheet.items if isinstance(text, Text) and text.step is None
                             and text.layer == "text" and rect.holds(text.at) and text.at[1] > rect.top - 15)
             for panel, rect in sheet.panels.items()}  # fmt: skip
    for panel in {vector.panel for vector in drawing.arrows if vector.kind in pens.FORCES}:
        assert "kF = " in lines[panel]
    assert "kv = " in lines["lever"]
    assert lines["lever"].startswith("Zhukovsky's lever")


def test_the_table_of_reactions_has_slides_and_their_moments() -> None:
    """Ozols' compressor: reactions by the letters of the force plan, and the slide's with moment and place."""
    tables = tables_of("ozols-10-1")
    rows = told(next(tables.reactions()))
    assert rows["reaction"] == ["Rx", "Ry", "|R| N", "M N·m"]
    assert rows["R12 at B"] == ["2388", "−1304", "2721", ""]
    assert rows["R01 at O"] == ["2388", "−813.9", "2523", ""]
    assert rows["R32 at C"] == ["−58.68", "−203.3", "211.6", "−189.1"]
    assert list(tables.seats()) == ["The reaction of the slide 2 along 3 acts at (1.143, −0.1856) m."]


def test_the_balance_is_told_by_each_way_side_by_side() -> None:
    """A moment in one row, a force in three; one column for each way that was drawn."""
    assert told(tables_of("ozols-10-2").balance()) == {
        "balance": ["by force plans", "by the lever"], "T1 N·m": ["−283.2", "−283.2"]}  # fmt: skip
    assert told(tables_of("jaanimets-10").balance()) == {
        "balance": ["by force plans", "by the lever"], "F2x N": ["−130.5", "−130.5"], "F2y N": ["97.88", "97.88"],
        "|F2| N": ["163.1", "163.1"]}  # fmt: skip
    assert told(tables_of("kinytskyi").balance())["balance"] == ["by force plans", "with friction", "by the lever"]


@pytest.mark.parametrize("name", LOADED)
def test_a_balancing_moment_has_its_arm_on_the_crank(name: str) -> None:
    """From the centre of a balanced link a lettered arm is square to the force; no couple hangs from its polygon."""
    drawing = drawing_of(name)
    balances = drawing.scene.loads.balances if drawing.scene.loads else ()
    arms = [arrow for arrow in drawing.arrows if arrow.kind == "arm"]
    assert bool(arms) == any(not balance.at for balance in balances)
    assert not [arrow for arrow in drawing.arrows if isinstance(arrow.panel, ForcePlan) and arrow.label[0] == "T"
                and arrow.kind == "balance"]
    for arm in arms:
        line = drawing.values[drawing.drawn.steps[arm.end].args[0]]
        (x, y), (u, v) = (drawing.values[mark] for mark in (arm.start, arm.end))
        assert arm.panel == MECHANISM
        assert arm.label in lettered(sheet_of(name), MECHANISM)
        assert (u - x) * line[1] - (v - y) * line[0] == pytest.approx(0.0, abs=1e-9 * drawing.scene.extent**2)
        assert any(isinstance(item, Polyline) and item.layer == "vectors" for item in sheet_of(name).items)


def test_a_balancing_moment_is_told_as_force_times_arm() -> None:
    """By the letters of a force and its arm, of those with friction, and of the lever's force at the crank pin."""
    readings = steps(composition_of("kinytskyi"))["readings"]
    told_by = [reading["said"] for reading in readings if "moment" in reading["kind"]]
    assert ["R_21·h =" in told_by[0], "R_21·h' =" in told_by[1], "T_1·OA =" in told_by[2]] == [True] * 3


def test_friction_circles_are_seen() -> None:
    """A circle that a pin would cover has a detail, where the force touches it; nothing else stands there."""
    sheet = sheet_of("kinytskyi")
    details = [item for item in sheet.items if item.layer == "details"]
    circles = [item for item in details if isinstance(item, Circle) and item.radius > 1]
    forces = [item for item in details if isinstance(item, Arrow)]
    others = [item.box for item in sheet.items if isinstance(item, Text) and item.layer != "details"]
    assert len(circles) == len(forces) == 7
    for circle, force in zip(circles, forces, strict=True):
        (x, y), (u, v) = force.start, force.direction
        assert abs((circle.centre[0] - x) * v - (circle.centre[1] - y) * u) == pytest.approx(circle.radius)
    assert not any(item.box.meets(box) for item in details if isinstance(item, Text) for box in others)


def test_no_forces_no_tables() -> None:
    """Reactions that are not asked for are not told; a scene without loads has neither table."""
    assert [*tables_of("ozols-10-2").reactions()] == []
    assert [*tables_of("four-bar").reactions()] == tables_of("four-bar").balance() == []


@pytest.mark.parametrize("name", LOADED)
def test_corners_are_told_from_the_numbers_of_steps(name: str) -> None:
    """The corners of force polygons have bold black numerals and no dot; marks without a letter have faint figures."""
    drawing, sheet = drawing_of(name), sheet_of(name)
    corners = {step.index for step in drawing.drawn.steps if re.fullmatch("[IVXLC]+'*", step.name)
               and isinstance(step.panel, ForcePlan)}
    texts = [item for item in sheet.items if isinstance(item, Text) and item.layer == "letters"]
    assert corners
    assert all(text.bold == (text.step in corners) for text in texts if text.pen == pens.LETTERS and text.step)
    assert not any(text.bold for text in texts if text.pen == pens.FAINT)
    assert not any(isinstance(item, Circle) and item.step in corners for item in sheet.items)


def test_opposite_forces_are_lettered_near_their_heads() -> None:
    """Where a force and its answer lie on one line, each letter stands on its own half."""
    sheet = sheet_of("triad-loaded")
    arrows = {item.label: item for item in sheet.items if isinstance(item, Arrow)}
    for letter in ("R_01", "R_21"):
        arrow = arrows[f"reaction {letter}"]
        (text,) = [item for item in sheet.items if isinstance(item, Text) and item.label == letter]
        assert math.dist(text.at, arrow.end) < math.dist(text.at, arrow.start)


def test_plans_with_and_without_friction_have_one_scale() -> None:
    """The force polygons that differ by friction alone can be compared with dividers."""
    multiples = sheet_of("kinytskyi").scales.multiples
    twins = [panel for panel in multiples if panel.endswith(" with friction")]
    assert len(twins) == 3
    assert all(multiples[panel] == multiples[panel.removesuffix(" with friction")] for panel in twins)


@pytest.mark.parametrize("name", LOADED)
def test_the_lever_is_whole(name: str) -> None:
    """The pole and the end of every velocity of the lever are on its panel, and lettered."""
    sheet, drawing = sheet_of(name), drawing_of(name)
    letters = lettered(sheet, "lever")
    names = {step.name for step in drawing.drawn.steps if step.panel == "lever" and step.name}
    assert "o" in names
    assert names <= letters


def test_a_lever_with_assumed_velocities_has_no_scale_of_them() -> None:
    """At rest the lever's velocities are of any size, and only the forces have a scale."""
    scene = gp.load("jaanimets-10")
    rest = scene.with_drives([replace(scene.drives[0], rate=0)])
    assert "lever: k_F = " in gp.sheet.svg(gp.construct(rest))
    assert "lever: k_v = " in gp.sheet.svg(drawing_of("jaanimets-10"))


def test_the_levers_of_a_reaction_are_named() -> None:
    """A reaction that is asked for by name has two levers, which say what they are for."""
    scene = gp.load("jaanimets-10")
    sheet = layout(compose(gp.construct(replace(scene, find=replace(scene.find, reactions=("B",))), plan="lever")))
    captions = " ".join(plain(item.runs) for item in sheet.items if isinstance(item, Text) and item.bold)
    assert all(f"Zhukovsky's lever: the force on link 4 at B, along {axis}" in captions for axis in "xy")
    assert outside(sheet) == []


@pytest.mark.parametrize("name", ["jaanimets-10", "ozols-10-2"])
def test_arms_of_a_lever_balance_it(name: str) -> None:
    """On Zhukovsky's lever every force has its arm h from the pole, with its letter; the moments P h of loads and
    balance cancel out as drawn."""
    composition = composition_of(name)
    lever = next(plate for plate in composition.plates if isinstance(plate.panel, LeverPlan))
    pole, moments = lever.beginnings[0].spot, 0.0
    forces = [vector for vector in lever.vectors if vector.kind in pens.FORCES]
    arms = [*lever_arms(pole, forces, lever.view.rect)]
    drawn = {plain(item.runs) for item in layout(composition).items
             if item.layer == "arms" and isinstance(item, Text)}
    assert drawn == {arm.letter.replace("_", "") for arm in arms}
    assert len(drawn) == len(arms) >= 2
    assert all(math.dist(*arm.ends) >= 6.0 for arm in arms)
    for force in forces:
        (x, y), (u, v) = force.ends
        moment = (x - pole[0]) * (v - y) - (y - pole[1]) * (u - x)
        moments += moment
        named = [arm for arm in arms if arm.letter.rstrip("′") == f"h_{force.letter.replace('_', '')}"]
        assert not named or abs(moment) / force.length in [pytest.approx(math.dist(*arm.ends)) for arm in named]
    assert abs(moments) < 1e-3 * sum(force.length**2 for force in forces)
