"""Instant centres: every pole of a linkage by construction, beside the rates of the solver."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest
from polar import with_all_poles

import graphplan as gp
from graphplan.check.cycle import OtherWays, cycle
from graphplan.check.json_results import result_data
from graphplan.check.report import Report
from graphplan.check.trusted import report
from graphplan.kernel.kinds import LINE
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.scene import FOLDER, parse
from graphplan.methods.construct import construct
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.kinds import POLE, POLE_HEADING
from graphplan.methods.motion.circle_diagram import CircleDiagram

FOUR_BAR = """
points = { O = [0, 0], C = [100, 0], A = [20, 30], B = [90, 60] }
links = { 1 = "O A", 2 = "A B", 3 = "B C", frame = "O C" }
drive = [{ link = "1", omega = 2 }]
find = { poles = %s }
"""


def poles(found: Report) -> dict[str, tuple[str, Fraction, Fraction]]:
    """Every pole, at infinity or not, by its two links."""
    return {name: (kind, *value) for kind in (POLE, POLE_HEADING)
            for name, value in found.results.get(kind, {}).items()}


def test_poles_of_a_four_bar_lie_where_its_sides_meet() -> None:
    """The pole of the coupler is where crank and rocker meet, that of crank and rocker where coupler and frame do."""
    found = result_data(report(parse(FOUR_BAR % '["2 frame", "3 1"]', "four-bar"), exact=True))
    assert found["poles"] == {"2 frame": {"at": ["80", "120"]}, "3 1": {"at": ["-50", "0"]}}
    assert found["check"] == {"poles": 0}


@pytest.mark.parametrize("name", ["slider-crank", "slotted-link", "shaper", "five-bar", "open-chain", "triad",
                                  "double-butterfly", "rosenauer-basic", "alt-ten-link", "planetary", "racks",
                                  "wheel-on-rail", "roller-cam"])
def test_all_poles_are_those_of_the_solver(name: str) -> None:
    """Every pole of every pair of links is exactly where the solver's rates have it, however the scene is ordered."""
    scene = with_all_poles(gp.load(name))
    found = report(scene, exact=True)
    assert found.agrees
    assert len(poles(found)) == len(scene.links) * (len(scene.links) - 1) // 2 or FRAME not in scene.links
    chance = Random(1974)
    links, pairs = [*scene.links.items()], [*scene.written]
    chance.shuffle(links)
    chance.shuffle(pairs)
    assert poles(report(replace(scene, links=dict(links), written=tuple(pairs)), exact=True)) == poles(found)


@pytest.mark.parametrize("name", ["instant-centres", "inflection-circle"])
def test_the_order_of_links_changes_no_step(name: str) -> None:
    """A scene with its links and their points written the other way round: the same names, by the same steps."""
    text = Path(FOLDER, f"{name}.toml").read_text("utf-8")
    links = re.search(r"(?<=\[links\]\n)(?:.+\n)+", text)[0].splitlines()
    turned = "\n".join(re.sub(r'"(.*)"', lambda found: f'"{" ".join(reversed(found[1].split()))}"', line)
                       for line in reversed(links))
    one, other = (report(parse(written, name)) for written in (text, text.replace("\n".join(links), turned)))
    assert [*one.scene.links] == [*reversed(other.scene.links)]
    assert poles(one).keys() == poles(other).keys()
    assert one.drawing.sentences() == other.drawing.sentences()


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "stephenson", "triad"])
def test_velocities_are_drawn_by_poles(name: str) -> None:
    """Asked for poles, ends of velocities lie on the lines to the poles of their links; accelerations do not."""
    scene = gp.load(name)
    found = report(scene, exact=True, method="poles")
    assert found.drawing.method["velocity"][-1].startswith("poles of link")
    assert not any(way.startswith("poles") for way in found.drawing.method["acceleration"])
    assert found.results == report(scene, exact=True).results


@pytest.mark.parametrize(("name", "links"), [("four-bar", 4), ("slider-crank", 4), ("triad", 6),
                                             ("double-butterfly", 8)])
def test_a_circle_diagram_has_a_side_for_each_pole(name: str, links: int) -> None:
    """Of n links there are n(n - 1)/2 poles; of four all n(n - 1)(n - 2)/6 pole lines are drawn (Ozols 1974, 5-2)."""
    drawing = gp.construct(with_all_poles(gp.load(name)))
    assert drawing.circle is not None
    assert len(drawing.circle.links) == links
    assert len(drawing.circle.sides) == links * (links - 1) // 2
    numbers = [side.number for side in drawing.circle.sides if side.number]
    assert numbers == [*range(1, len(numbers) + 1)]
    if name == "four-bar":
        assert sum(step.op.gives == LINE for step in drawing.program.steps) == links * (links - 1) * (links - 2) // 6


def test_poles_that_hang_on_the_drives_are_found_by_velocities() -> None:
    """Kennedy's theorem gives the pole of no coupler of a five-bar: velocities give one, and by that it has the others.
    """
    told = gp.construct(with_all_poles(gp.load("five-bar"))).method["poles"]
    assert told == ["Kennedy's theorem, in the order of the circle diagram", "P_30 by velocities"]


def test_poles_by_the_circle_diagram_alone_are_drawn_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither a way through rings of links nor the length of velocities matters to them; those by velocities need it.
    """
    scene, drawn = replace(gp.load("class-four-loaded"), loads=None), list[Draughtsman]()
    draw = Draughtsman.draw
    monkeypatch.setattr(Draughtsman, "draw", lambda self: (drawn.append(self), draw(self))[1])
    construction = construct(with_all_poles(scene))
    assert (len(drawn), construction.planned, construction.ways) == (1, False, ())
    assert construct(scene).planned
    assert len(drawn) > 2
    assert construct(with_all_poles(gp.load("five-bar"))).planned


@pytest.mark.parametrize("name", ["slider-crank", "triad"])
def test_poles_are_found_in_other_poses(name: str) -> None:
    """Around the cycle the same steps give the poles of every pose, as the solver has them."""
    found = cycle(with_all_poles(gp.load(name)), 8)
    assert found.check["poles"] < 1e-12
    assert not found.wrong
    assert all(len(z) == 8 for z in found.results[POLE].values())


def test_a_pole_by_velocities_is_right_in_other_poses() -> None:
    """Though in the given pose the orthogonal velocities of two points lie on one line, as elsewhere they do not."""
    found = cycle(gp.scene({
        "points": {"A": [-3, -9], "B": [1, -4], "O": [-3, 4]}, "links": {"1": "A B", "2": "O", "frame": "O"},
        "slides": [{"link": "1", "along": "frame", "at": "A", "direction": [1, 0]}],
        "drive": [{"link": "2", "omega": 1}, {"slide": ["1", "frame"], "speed": -3}], "find": {"poles": ["1 2"]},
    }), 6)  # fmt: skip
    assert not found.wrong
    assert found.results[POLE]["1 2"] == pytest.approx([-3 + 7j] * 6)


def test_steps_of_another_pose_that_give_other_results_are_not_used() -> None:
    """A pole that is at infinity in the given pose alone is another result there than in other poses."""
    text = FOUR_BAR.replace("B = [90, 60]", "B = [90, 40]").replace("C = [100, 0]", "C = [90, 0]")
    scene = parse(text.replace("A = [20, 30]", "A = [0, 20]") % '["2 frame"]', "crank parallel to rocker")
    ways = OtherWays(scene, construct(scene), "", "", "couple")
    assert ways._construct_alike(scene, "") is not None
    assert ways._construct_alike(gp.at(scene, 30), "") is None


def test_a_pole_may_be_a_joint() -> None:
    """Where crank and coupler are in line their joint with the rocker is the coupler's pole."""
    text = FOUR_BAR.replace("B = [90, 60]", "B = [60, 90]").replace("C = [100, 0]", "C = [140, 90]")
    found = result_data(report(parse(text % '["2 frame", "1 3", "2 3"]', "dead centre"), exact=True))
    assert found["poles"] == {"2 frame": {"at": ["60", "90"]}, "1 3": {"at": ["0", "0"]}, "2 3": {"at": ["60", "90"]}}


def test_links_that_turn_alike_have_their_pole_at_infinity() -> None:
    """The coupler of a parallelogram turns as the frame does: its pole lies the way of the cranks."""
    text = FOUR_BAR.replace("B = [90, 60]", "B = [120, 30]") % '["2 frame", "1 3"]'
    found = result_data(report(parse(text, "parallelogram"), exact=True))
    assert found["poles"] == {"2 frame": {"direction": ["2/5", "3/5"]}, "1 3": {"direction": ["1", "0"]}}


def test_links_that_rest_on_each_other_have_no_pole_of_their_own() -> None:
    """Any point is a pole of links that do not move relative to each other: none is given, which is said; pins are."""
    found = report(parse(FOUR_BAR.replace("omega = 2", "omega = 0") % '["2 frame", "1 2"]', "at rest"), exact=True)
    assert result_data(found)["poles"] == {"2 frame": {"at": None}, "1 2": {"at": ["20", "30"]}}
    assert any("any point is a pole" in note for note in found.drawing.notes)


def test_that_links_rest_on_each_other_is_checked() -> None:
    """A pole that is left out as if two links rested on each other is found missing where the solver has them move."""
    found = report(parse(FOUR_BAR % '["2 frame", "1 3"]', "four-bar"), exact=True)
    without = replace(found, results={POLE: {"1 3": found.results[POLE]["1 3"]}})
    assert found.agrees
    assert not without.agrees
    assert "links 2 frame" in str(without.disagreement)


@pytest.mark.parametrize("dual", [False, True])
def test_crossings_are_compared_on_the_unit_sphere(dual: bool) -> None:
    """The sine of two poles or lines hangs on no factor of theirs, is 0 of one and the same, and never above 1."""
    diagram = object.__new__(CircleDiagram)
    diagram.scene = parse(FOUR_BAR % '"all"', "four-bar")
    vectors = [(3, 4, 50), (-7, 2, 9), (120, 40, 1), (1, -1, 300)]
    for k, u in enumerate(vectors):
        assert diagram.sine(u, u, dual) == pytest.approx(0, abs=1e-12)
        for v in vectors[:k]:
            assert 0 < diagram.sine(u, v, dual) <= 1 + 1e-12
            assert diagram.sine([-6 * part for part in u], v, dual) == pytest.approx(diagram.sine(u, v, dual))
