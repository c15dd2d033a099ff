"""Sheets of mechanisms as they fall, whose poses nobody chose: paper of a usual size, velocities in proportion."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import dist

import pytest
from protocols import random_scenes

from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import Pencil
from graphplan.check.trusted import report
from graphplan.errors import GraphplanError
from graphplan.kernel.kinds import POINT
from graphplan.mechanism.scene import load, parse
from graphplan.methods.construct import construct
from graphplan.methods.kinds import ACCELERATION, VELOCITY
from graphplan.methods.panels import N_PLAN
from graphplan.sheet.layout.composition import compose

STEPHENSON = """
[points]
P1 = [0, 0]
P2 = [-25.94, -0.33]
P3 = [10.66, 19.98]
P4 = [-37.06, 77.52]
P5 = [58.72, -85.12]
P6 = [15.86, -1.02]
P7 = [14.20, -58.15]
[links]
1 = "P1 P2 P3"
2 = "P2 P4"
3 = "P3 P5"
4 = "P4 P5 P6"
5 = "P6 P7"
frame = "P1 P7"
[[drive]]
link = "1"
omega = 1.7
alpha = -0.6
"""
CLASS_IV = """
[points]
P1 = [0.00, 0.00]
P2 = [13.53, 18.29]
P3 = [-41.59, -43.54]
P4 = [0.01, -23.36]
P5 = [-19.16, 78.16]
P6 = [43.71, 4.91]
P7 = [-29.14, -34.73]
[links]
1 = "P1 P2"
2 = "P2 P3 P4"
3 = "P3 P5"
4 = "P4 P6"
5 = "P5 P6 P7"
frame = "P1 P7"
[[drive]]
link = "1"
omega = 1.7
alpha = -0.6
"""
SEEDS = range(12)
MIN_SHARE = 0.85  # of scenes on paper as usual: near a singular pose it may be larger
USUAL = {"A4": 7, "A3": 7, "A2": 12}  # the largest number of moving links
MAX_VELOCITY = 0.8  # of the mechanism


STARTING = """
[points]
P0 = [4, 25]
P1 = [-16, 23]
P2 = [-31, 9]
P3 = [-30, -34]
P4 = [27, -21]
P5 = [6, 36]
[links]
1 = "P0 P2"
2 = "P1 P3"
3 = "P2 P3 P4"
frame = "P1 P5"
[[slides]]
link = "1"
along = "frame"
at = "P0"
direction = [-4, 3]
[[drive]]
slide = ["1", "frame"]
speed = 0
acceleration = 0.25
[find]
acceleration = "all"
"""


def test_velocities_are_in_proportion() -> None:
    """They are drawn no longer than the mechanism, and relative ones hardly longer than their links."""
    drawing = construct(parse(STEPHENSON, "stephenson"))
    kappa, extent = drawing.kappa, drawing.scene.extent
    assert max(map(abs, drawing.velocity.values())) * kappa <= MAX_VELOCITY * extent
    assert max(abs(rate) * kappa for link, rate in drawing.omega.items() if link != "1") <= 1.5


def test_accelerations_are_in_proportion() -> None:
    """Near a singular pose, too, their plan is drawn no more than ten times as small as the mechanism."""
    composition = draft(construct(parse(CLASS_IV, "class IV")), Pencil(), lettered=False).composition
    assert composition.scales.multiples["N-plan"] >= Fraction(1, 10)


@pytest.mark.parametrize(("name", "paper"), [("rosenauer-basic", "A3"), ("four-bar", "A4")])
def test_paper_serves_the_worst_result(name: str, paper: str) -> None:
    """Where a result would be more than a tenth off, the paper is as large as is usual for so many links, no larger."""
    drafted = draft(report(load(name)).drawing, Pencil())
    assert drafted.paper == paper
    assert drafted.error <= 0.1


def test_given_scales_are_kept() -> None:
    """Where the scene's sheet gives both scales, they say how long velocities are."""
    given = construct(parse(f"{STEPHENSON}\n[sheet]\nk_s = 1\nk_v = 1\n", "stephenson"))
    assert given.kappa == 1.0


def test_a_six_link_mechanism_fits_on_a3() -> None:
    """Its mechanism takes three tenths of the way up the plan, and no line of it is cut off."""
    composition = draft(construct(parse(STEPHENSON, "stephenson")), Pencil()).composition
    assert composition.arrangement.paper[:2] in ("A4", "A3")
    view, core = composition.views["mechanism"], composition.plans.extents["mechanism"].core
    assert all(map(view.rect.holds, map(view, core.corners)))
    places = [composition.plans.place(point) for point in composition.plans.drawing.scene.points]
    high = max(y for _, y in places) - min(y for _, y in places)
    assert high * view.scale >= 0.3 * view.rect.height


def test_random_mechanisms_have_usual_paper() -> None:
    """Up to eight links on A3, up to twelve on A2, but where a pose is nearly singular."""
    papers = []
    for seed in SEEDS:
        for scene in (scene for scene in random_scenes(seed) if not scene.loads):
            try:
                papers.append((len(scene.moving), compose(report(scene).drawing).arrangement.paper[:2]))
            except GraphplanError:
                continue
    usual = [moving <= USUAL.get(paper, 0) for moving, paper in papers]
    assert sum(usual) >= MIN_SHARE * len(usual), papers


def test_velocities_that_come_out_short_are_drawn_longer() -> None:
    """A loader that moves slowly beside its drive is drawn with velocities of a fifth of the mechanism at least."""
    drawing = construct(load("ozols-13-7"))
    longest = max(abs(complex(*vector)) for vector in drawing.computed[VELOCITY].values()) * drawing.kappa
    assert 0.2 * drawing.scene.extent <= longest <= 0.5 * drawing.scene.extent


def test_what_a_drive_prescribes_is_laid_off_on_the_n_plan() -> None:
    """The crank's normal acceleration is laid off at the scale of the N-plan, not taken from the crank and enlarged."""
    drawing = construct(load("roller-cam"))
    normal = next(step for step in drawing.drawn.steps if step.quantity and step.quantity.written == "ω²·OC")
    assert (normal.panel, normal.name) == (N_PLAN, "C_1")


def test_ratios_of_links_are_no_marks_of_the_n_plan() -> None:
    """Where a link's point divides its length, that of its ends is divided on the link: the N-plan has no mark that is
    further than its vectors are long."""
    drawing = construct(load("ozols-5-1"))
    marks = [step for step in drawing.drawn.steps if step.panel == N_PLAN and step.op.gives == POINT]
    longest = max(abs(value) for value in drawing.acceleration.values()) * drawing.kappa**2
    assert max(dist(*pair) for pair in combinations([drawing.values[mark.index] for mark in marks], 2)) < 1.1 * longest


def test_the_acceleration_of_a_driven_slide_is_laid_off_on_the_n_plan() -> None:
    """A slide's prescribed acceleration is laid off once, on the N-plan, and read there: it may dwarf the mechanism."""
    drawing = construct(parse("""points = { B = [0, 0], A = [40, 30], O = [60, 0] }
links = { 1 = "B", 2 = "A B", 3 = "O A", frame = "O" }
slides = [{ link = "1", along = "frame", at = "B", direction = [1, 0] }]
drive = [{ slide = ["1", "frame"], speed = 1, acceleration = -20 }]
find = { acceleration = "all" }"""))
    laid = [step for step in drawing.drawn.steps if step.quantity and step.quantity.written == "a_r"]
    assert [step.panel for step in laid] == [N_PLAN]


def test_a_machine_without_arcs_takes_a_scale_of_its_own_size() -> None:
    """A crank of a few millimetres, or of metres, is drawn as large as its paper allows."""
    for length in (0.004, 4.0):
        scene = parse(f"""points = {{ O = [0, 0], A = [{length}, 0] }}
links = {{ 1 = "O A", frame = "O" }}
drive = [{{ link = "1", omega = 1 }}]
find = {{ omega = ["1"] }}""")
        assert 50 <= length / compose(construct(scene)).scales.k_s <= 297


def test_rates_are_drawn_as_long_as_leaves_results_good() -> None:
    """Accelerations of a slow start are no dots: a pencil draws each to a tenth of itself."""
    drafted = draft(report(parse(STARTING)).drawing, Pencil(), protocol="none", lettered=False)
    sizes = {name: abs(value) for name, value in drafted.drawing.acceleration.items()}
    errors = {result.of: result.deviation.value for result in drafted.results if result.kind == ACCELERATION}
    assert errors.keys() & sizes.keys()
    assert all(errors[name] < 0.1 * sizes[name] for name in errors.keys() & sizes.keys())
