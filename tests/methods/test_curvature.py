"""Centres of curvature and inflection circles: drawn values stand against the rates, true motions and textbooks."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from jsonschema import validate

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.check.json_results import result_data
from graphplan.check.report import path_truth
from graphplan.check.trusted import report
from graphplan.commands.schema import result_schema
from graphplan.errors import SceneError
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.scene import parse
from graphplan.mechanism.sections import OF_PATHS
from graphplan.methods.construct import construct
from graphplan.methods.kinds import CENTRE, STRAIGHT
from graphplan.solver import solve

FOUR_BAR = """
title = "four-bar"
[points]
O = [0, 0]
C = [100, 0]
A = { from = "O", distance = 80, angle = 60 }
B = { distances = { A = 45, C = 75 }, side = "left" }
M = [59.905709, 98.247749]
N = [64.485014, 48.960023]
[links]
1 = "O A"
2 = "A B M N"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 10
[find]
"""
SLIDER_CRANK = """
title = "slider-crank"
[points]
O = [0, 0]
A = [24, 18]
B = [104, 10]
M = [60, 80]
P = [104, 78]
[links]
1 = "O A"
2 = "A B M P"
3 = "B"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
[[drive]]
link = "1"
omega = 10
[find]
"""
PARALLELOGRAM = """
title = "parallelogram"
[points]
O = [0, 0]
C = [100, 0]
A = [30, 40]
B = [130, 40]
M = [60, 90]
[links]
1 = "O A"
2 = "A B M"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 10
[find]
"""
SLOT = """
title = "oscillating slot"
[points]
O = [0, 0]
A = { from = "O", distance = 30, angle = 20 }
B = [80, 0]
M = [81.1236102, 20.1659231]
[links]
1 = "O A"
2 = "A M"
3 = "B"
frame = "O B"
[[slides]]
link = "3"
along = "2"
at = "B"
direction = "A B"
[[drive]]
link = "1"
omega = 10
[find]
"""
PLANET = """
title = "planet in a ring"
[points]
O = [0, 0]
A = [30, 40]
M = [54, 22]
[links]
2 = "A M"
3 = "O A"
frame = "O"
[[gears]]
links = ["2", "frame"]
centres = ["A", "O"]
teeth = [30, 80]
internal = true
[[drive]]
link = "3"
omega = 10
[find]
"""
M, ALL = 'curvature = ["M on 2"]', 'curvature = "all"\ninflection = "all"'


def solved(text: str, find: str, **how: Any) -> dict[str, Any]:
    """What `solve` prints of a scene that asks for this."""
    found: dict[str, Any] = json.loads(json.dumps(result_data(report(parse(text + find, "scene"), **how))))
    validate(found, result_schema("solve"))
    return found


@pytest.mark.parametrize("method", ["", *OF_PATHS])
def test_textbook_values(method: str) -> None:
    """Ozols 5-1: the circle through W_1, W_2 and P of a four-bar and of a slotted link, and centres on their rays."""
    bar = solved(FOUR_BAR, 'curvature = ["M on 2", "N on 2"]\ninflection = ["2"]', method=method)
    assert bar["curvature"]["M on 2"]["centre"] == pytest.approx([55.057, 87.901], abs=2e-3)
    assert bar["curvature"]["N on 2"]["centre"] == pytest.approx([44.732, -120.874], abs=2e-2)
    assert bar["inflection"]["2"]["pole"] == pytest.approx([73.622, 127.517], abs=1e-3)
    assert bar["inflection"]["2"]["diameter"] == pytest.approx(123.872, abs=1e-3)
    slot = solved(SLOT, f'{M}\ninflection = ["2"]', method=method)
    assert slot["curvature"]["M on 2"]["centre"] == pytest.approx([75.646, 8.101], abs=2e-3)
    assert slot["inflection"]["2"]["diameter"] == pytest.approx(242.273, abs=1e-3)


@pytest.mark.parametrize("method", ["", *OF_PATHS])
@pytest.mark.parametrize("text", [SLIDER_CRANK, PARALLELOGRAM, PLANET], ids=["slider-crank", "parallelogram", "planet"])
def test_every_way_gives_the_solvers_fractions(text: str, method: str) -> None:
    """All that can be asked is the solver's as a fraction, by known centres, rolling or rates, on either plan."""
    scene = parse(text + ALL, "scene")
    for plan in ("orthogonal", "polar"):
        results = construct(scene, method=method, plan=plan).read(Fractions())
        assert results == path_truth(solve(scene, exact=True), results)


@pytest.mark.parametrize("text", [FOUR_BAR, SLIDER_CRANK, SLOT, PARALLELOGRAM])
def test_true_paths_have_these_centres(text: str) -> None:
    """The circle through three points of the path that the mechanism runs through tends to the one that is drawn."""
    step = 0.02
    path = gp.cycle.follow(parse(text + M, "scene"), 3, (-step, step)).points["M"]
    z, second = (path[2] - path[0]) / 2, path[2] - 2 * path[1] + path[0]
    centre = path[1] + 1j * z * abs(z) ** 2 / (z.conjugate() * second).imag
    told = solved(text, M)["curvature"]["M on 2"]
    assert complex(*told["centre"]) == pytest.approx(complex(centre), rel=1e-5)
    assert told["radius"] == pytest.approx(abs(centre - path[1]), rel=1e-4)


def test_special_points() -> None:
    """A point in the slide has a straight path, the pole a cusp; of a link that does not turn all paths are alike."""
    found = solved(SLIDER_CRANK, 'curvature = ["B on 2", "P on 2"]')
    assert found["curvature"] == {"B on 2": {"centre": None, "radius": None},
                                  "P on 2": {"centre": [104.0, 78.0], "radius": 0.0}}
    found = solved(PARALLELOGRAM, 'curvature = ["M on 2"]\ninflection = ["2"]')
    assert found["curvature"]["M on 2"] == {"centre": [30.0, 50.0], "radius": 50.0}
    assert found["inflection"]["2"] == {"pole": None, "inflection_pole": None, "diameter": None}


def test_fractions_print_squares_of_irrational_lengths() -> None:
    """With exact numbers a radius that is no fraction is told by its square."""
    found = solved(SLIDER_CRANK, 'curvature = ["M on 2", "A on 1"]\ninflection = ["2"]', exact=True)
    assert found["curvature"]["M on 2"] == {
        "centre": ["162816/2927", "234742/2927"], "radius_squared": "164281140/8567329"}
    assert found["curvature"]["A on 1"]["radius"] == "30"
    assert found["inflection"]["2"]["diameter_squared"] == "2208400/9"
    assert found["check"] == {"curvature": 0}


def test_other_poses_by_the_same_steps() -> None:
    """The construction of one pose is replayed in others, as the solver has them there."""
    scene = parse(FOUR_BAR + M, "scene")
    turn = gp.cycle.follow(scene, 5, (-40, 10))
    poses = gp.construct(scene).evaluate(turn.points)
    for k in np.flatnonzero(np.isfinite(turn.points["M"])):
        there = replace(scene, points={name: (z[k].real, z[k].imag) for name, z in turn.points.items()}, irrational=())
        assert poses.results_of_kind("centre of curvature")["M on 2"][k] == pytest.approx(
            complex(*path_truth(solve(there), {"centre of curvature": ["M on 2"]})["centre of curvature"]["M on 2"]))


@pytest.mark.parametrize(("find", "fault"), [
    ('curvature = ["B on 1"]', "B is not a point of link 1; one of A, O"),
    ('curvature = ["O on 1"]', "O is a point of the frame, which stands still"),
    ('curvature = ["M on frame"]', "M is a point of the frame, which stands still"),
    ('curvature = ["M"]', "point on a link"),
    ('inflection = ["frame"]', "the frame stands still"),
])
def test_what_cannot_be_asked(find: str, fault: str) -> None:
    """Points off their link and points of the frame are faults, each with a remedy."""
    with pytest.raises(SceneError) as caught:
        parse(SLIDER_CRANK + find, "scene")
    assert fault in str(caught.value)


def test_acceleration_centre_has_no_acceleration() -> None:
    """At Q of a turning link a_A + (i alpha - omega^2) AQ vanishes; Q of a link with a pivot is that pivot."""
    scene = parse(FOUR_BAR + 'acceleration = ["A"]\nlinks = ["2"]\nacceleration_centres = ["1", "2"]', "q.toml")
    data = result_data(report(scene))
    validate(data, result_schema("solve"))
    A, a_A = complex(*map(float, scene.points["A"])), complex(*data["points"]["A"]["acceleration"])
    omega, alpha = data["links"]["2"]["omega"], data["links"]["2"]["alpha"]
    Q = complex(*data["acceleration_centres"]["2"]["at"])
    assert abs(a_A + (1j * alpha - omega**2) * (Q - A)) < 1e-9 * abs(a_A)
    assert data["acceleration_centres"]["1"]["at"] == [0, 0]


def test_acceleration_centre_of_a_link_that_shifts_is_null() -> None:
    """A coupler that moves parallel to itself has no acceleration centre, and the reason says so."""
    scene = parse("""
[points]
O = [0, 0]
C = [4, 0]
A = [1, 2]
B = [5, 2]
[links]
1 = "O A"
2 = "A B"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 1
[find]
velocity = ["A"]
acceleration_centres = ["2"]
""", "shift.toml")
    data = result_data(report(scene))
    assert data["acceleration_centres"] == {"2": {"at": None}}
    assert "2" in data["reasons"]["acceleration_centres"]


RESTING = """title = "A crank beside two braced links and a slide at rest"
[points]
O = [0, 0]
A = [0, 30]
E = [60, 0]
F = [120, 0]
G = [100, 50]
S = [160, 40]
[links]
frame = "O E F"
1 = "O A"
2 = "E G"
3 = "F G"
4 = "G S"
5 = "S"
[[slides]]
link = "5"
along = "frame"
at = "S"
direction = [1, 0]
[[drive]]
link = "1"
omega = 1
[find]
velocity = "all"
curvature = ["A on 1", "G on 2", "S on 5"]
"""


def test_a_point_at_rest_has_its_pivot_as_centre_in_all_poses() -> None:
    """Around the cycle, too, a link that is braced to rest turns its points about its pivot, as in the given pose; a
    point on a guide has a straight path."""
    over_cycle = cycle(parse(RESTING, "resting"), 5)
    assert (over_cycle.wrong, over_cycle.faults) == ((), {})
    assert all(over_cycle.results[CENTRE]["G on 2"] == 60)
    assert not any(over_cycle.results[STRAIGHT]["S on 5"])
