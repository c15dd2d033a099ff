"""`solve --digits`: proven digits of every number, an independent opinion, and the truth where there are none."""

from __future__ import annotations

import io
import json
import sys
from dataclasses import replace
from decimal import Decimal, localcontext
from fractions import Fraction
from typing import Any

import pytest
from command_line import run
from four_bars import four_bar

from graphplan.check.certified import certify
from graphplan.check.trusted import report
from graphplan.errors import Refused
from graphplan.kernel import TABLE
from graphplan.mechanism.model import Friction, Scene
from graphplan.mechanism.scene import load, packaged_names, parse

PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899")

BY_COMPASSES = '{ distances = { A = 110, C = 90 }, side = "left" }'
FOUR_BAR = four_bar("rpm = 95", B=BY_COMPASSES)

APART = """
T = [90, 20.0000000000000000000000000000000000000001]
B = { distances = { T = 50 }, on = { through = "T", direction = "A C" }, pick = "right" }
"""
NEARLY = FOUR_BAR.replace(f"\nB = {BY_COMPASSES}", APART)

ACTUATOR = """
[points]
O = [0, 0]
A = { from = "O", distance = 70, angle = 25 }
[links]
2 = "A"
frame = "O"
[[slides]]
link = "2"
along = "frame"
at = "A"
direction = 25
[[drive]]
slide = ["2", "frame"]
speed = 3
"""

LOADS = """
[[forces]]
on = "3"
at = "B"
value = [-150, 20]
[balance]
at = "A"
on = "1"
direction = 130
"""


def numbers(value: Any) -> list[Any]:
    """All numbers of nested results, in their order; names of links and points are none."""
    if isinstance(value, dict):
        return [number for key, part in value.items() if key not in ("link", "at") for number in numbers(part)]
    return [number for part in value for number in numbers(part)] if isinstance(value, tuple | list) else [value]


# Kinds of results that are measured alike, and what their bounds are called.
ALIKE = (("velocity", "slide velocity"), ("omega",), ("acceleration", "slide acceleration"), ("alpha",),
         ("reaction", "slide reaction", "balance", "lever", "balance with friction"), ("slide arm",),
         ("slide moment", "balance moment", "lever moment", "balance moment with friction"))

BESIDE = {"omega": "velocity", "alpha": "acceleration"}  # a turning that is nothing counts beside what others make


@pytest.mark.parametrize("name", packaged_names())
def test_packaged_scenes_are_certified(name: str) -> None:
    """Every packaged scene has 30 proven digits, which agree with the floats to rounding, and hold exact fractions; but
    one whose loads are known to a float's digits, which has 15 and is refused more."""
    scene = load(name)
    digits = 15 if any("its value in this pose" in why for why in scene.irrational) else 30
    if digits < 30:
        with pytest.raises(Refused, match="to the digits of a float"):
            certify(scene, 30)
    found, rounded = certify(scene, digits), report(scene).results
    assert found.agrees
    assert all(Fraction(gap) <= Fraction(1, 10**digits) for gap in found.data["check"].values())
    for kinds in ALIKE:
        pairs = [pair for kind in kinds for pair in zip(numbers(found.results.get(kind, {})),
                                                        numbers(rounded.get(kind, {})), strict=True)]
        beside = numbers(rounded.get(BESIDE.get(kinds[0], ""), {}))
        fastest = max(map(abs, rounded.get("omega", {}).values()), default=0.0) ** 2 if kinds == ("alpha",) else 0.0
        largest = max([fastest, *(abs(near) for _, near in pairs), *(abs(near) / scene.extent for near in beside)])
        largest = largest or scene.extent  # arms that are all nothing count beside the mechanism
        for number, near in pairs:
            assert number.error <= Fraction(largest) / 10**digits
            assert abs(float(number) - near) <= 1e-10 * largest
    if not scene.irrational:
        exact = report(scene, exact=True).results
        for number, value in zip(numbers(found.results), numbers(exact), strict=True):
            assert abs(number.middle - value) <= number.error


def test_sixty_digits_by_hand() -> None:
    """Compasses and rpm: a four-bar's rates are those worked out by hand, right to the last of 60 digits."""
    with localcontext() as context:
        context.prec = 90
        along = Decimal(16000 + 110**2 - 90**2) / 32000
        across = (Decimal(110**2) / 16000 - along**2).sqrt()
        ux, uy = 120 * along + 40 * across, 120 * across - 40 * along
        wx, wy, crank = ux - 120, uy + 40, 95 * PI / 30
        omega = crank * (30 * uy - 40 * ux) / (wx * uy - wy * ux)
        found = certify(parse(FOUR_BAR, "four-bar"), 60).data
        told = [Decimal(x) for x in (found["links"]["3"]["omega"], *found["points"]["B"]["velocity"])]
        for ours, truth in zip(told, (omega, -wy * omega, wx * omega), strict=True):
            assert len(ours.as_tuple().digits) == 60
            assert abs(ours - truth) <= Decimal((0, (5, 1), ours.as_tuple().exponent - 2))


def test_precision_is_raised_until_the_digits_are_there() -> None:
    """Bars that are parallel to 1e-40, in a pose of irrational coordinates, get their 30 digits from more bits."""
    found = certify(parse(NEARLY, "nearly"), 30)
    assert found.agrees
    assert found.bits > certify(parse(FOUR_BAR, "four-bar"), 30).bits
    assert float(found.data["links"]["3"]["omega"]) > 1e40
    assert all(len(Decimal(x).as_tuple().digits) == 30 for x in found.data["points"]["B"]["velocity"])
    assert "method" not in found.data  # no pencil could draw it


@pytest.mark.parametrize(("middle", "certain"), [('{ on = "A C", distance = 50 }', False), ("[90, 20]", True)])
def test_a_singular_pose_is_singular_as_far_as_can_be_told(
    middle: str, certain: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Bars in line give status 3 and one line with the links, the lines that miss, and how far that is known."""
    text = FOUR_BAR.replace(BY_COMPASSES, middle).replace("rpm = 95", "omega = 2")
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
    assert run("solve", "-", "--digits", "30") == 3
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.count("\n") == 1
    assert "links 2, 3" in streams.err
    assert "should meet" in streams.err
    assert ("bits can tell" in streams.err) is not certain


MUTANTS = [("jaanimets-10", op) for op in ("given", "line", "parallel", "perpendicular", "meet", "similar", "normal",
                                           "transfer", "lay_off", "balance", "couple")]
MUTANTS += [("alt-eight-link", "carry"), ("alt-eight-link", "settle"), ("class-four-loaded", "false_position"),
            ("class-four-loaded", "weigh"), ("ozols-5-3", "coriolis"), ("ozols-5-3", "lay_along"),
            ("kinytskyi", "touch"), ("kinytskyi", "inertia_pair")]


@pytest.mark.parametrize(("name", "op"), MUTANTS)
def test_a_rule_that_is_wrong_in_the_25th_digit_is_caught(name: str, op: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One rule off by 1e-25 of its first number, and the enclosures of construction and solver part."""
    rule = TABLE[op].rule

    def off(domain: Any, *values: Any, **params: Any) -> Any:
        first, *others = rule(domain, *values, **params)
        return first + (first + first * first) * Fraction(1, 10**25), *others  # no affine map: statics would not see it

    monkeypatch.setitem(TABLE, op, replace(TABLE[op], rule=off))
    found = certify(load(name), 30)
    assert not found.agrees
    assert max(float(gap) for gap in found.data["check"].values()) > 1e-29


@pytest.mark.parametrize("direction", ["25", '"O A"'])
def test_directions_are_as_written(direction: str) -> None:
    """An actuator along an angle, or towards a polar point, moves by the cosine and sine of the exact degrees."""
    found = certify(parse(ACTUATOR.replace("direction = 25", f"direction = {direction}"), "actuator"), 40).data
    with localcontext() as context:
        context.prec = 60
        c, s = (Decimal(text) / 3 for text in found["points"]["A"]["velocity"])
        cosine_of_75 = (Decimal(6).sqrt() - Decimal(2).sqrt()) / 4
        assert abs(c * c + s * s - 1) < Decimal("1e-39")
        assert abs(4 * c**3 - 3 * c - cosine_of_75) < Decimal("1e-38")


@pytest.mark.parametrize(("plan", "inertia"), [("polar", "couple"), ("lever", "points"), ("polygons", "shifted")])
def test_every_way_of_drawing_is_certified(plan: str, inertia: str) -> None:
    """Whatever plans draw it, the printed digits of a loaded mechanism are the same."""
    plain, other = (certify(load("ozols-10-1"), 30, plan=p, inertia=i).data
                    for p, i in (("orthogonal", "couple"), (plan, inertia)))
    assert other["balance"] == plain["balance"]
    assert other["points"] == plain["points"]


def rough(scene: Scene) -> Scene:
    """The scene with friction in its slides besides."""
    assert scene.loads is not None
    slides = tuple(Friction("", (s.link, s.along), Fraction(0), Fraction(1, 10)) for s in scene.slides)
    return replace(scene, loads=replace(scene.loads, frictions=slides))


def test_friction_has_an_opinion_of_its_own() -> None:
    """Slides that rub, and a balance along an angle: the drawn round and the efficiency have 30 proven digits."""
    scene = rough(load("ozols-9-1"))
    found, rounded = certify(scene, 30), report(scene)
    assert found.agrees
    assert rounded.forces is not None
    told = found.data["friction"]
    assert float(told["efficiency"]) == pytest.approx(rounded.forces.efficiency, rel=1e-12)
    assert "stands" not in told
    assert certify(parse(FOUR_BAR + LOADS, "loaded"), 30).agrees


def test_solve_prints_decimal_strings(capsys: pytest.CaptureFixture[str]) -> None:
    """Every number of the output is a string of 30 digits, or 0; digits and bounds are told."""
    assert run("solve", "kinytskyi", "--digits", "30") == 0
    table = json.loads(capsys.readouterr().out)
    assert table["digits"] == 30
    assert set(table["bounds"]) == set(table["check"]) == {"velocity", "acceleration", "force"}
    assert table["friction"].pop("rounds") == 2
    for part in ("points", "links", "balance", "friction"):
        assert all(len(Decimal(text).as_tuple().digits) == 30 for text in numbers(table[part]))
    assert all(text == "0" or len(Decimal(text).as_tuple().digits) == 30
               for entry in table["reactions"] for text in entry["force"])


def test_thousands_of_digits(capsys: pytest.CaptureFixture[str]) -> None:
    """Ten thousand digits are no other matter than thirty."""
    assert run("solve", "ozols-5-5", "--digits", "10000") == 0
    velocity = json.loads(capsys.readouterr().out)["points"]["B"]["velocity"][0]
    thirty = certify(load("ozols-5-5"), 30).data["points"]["B"]["velocity"][0]
    assert len(Decimal(velocity).as_tuple().digits) == 10000
    assert velocity.startswith(thirty[:-1])


@pytest.mark.parametrize(("extra", "said"), [
    (("--digits", "0"), "1 to 10000"), (("--digits", "10001"), "1 to 10000"), (("--digits", "9", "--exact"), "--exact"),
])
def test_what_cannot_be_asked(extra: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Digits out of range, or besides --exact, are refused in one line with status 2."""
    assert run("solve", "four-bar", *extra) == 2
    streams = capsys.readouterr()
    assert (streams.out, streams.err.count("\n")) == ("", 1)
    assert said in streams.err


def test_without_flint_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch,
                                                     capsys: pytest.CaptureFixture[str]) -> None:
    """Where python-flint is missing, --digits is refused with the name of the extra that brings it."""
    monkeypatch.setitem(sys.modules, "graphplan.kernel.numbers.enclosures", None)  # as where it cannot be loaded
    assert run("solve", "four-bar", "--digits", "30") == 2
    streams = capsys.readouterr()
    assert streams.err.count("\n") == 1
    assert "graphplan[certified]" in streams.err


def test_arcs_that_only_rounding_lets_touch() -> None:
    """Where the pose as written does not exist, no digits of it are told."""
    touching = FOUR_BAR.replace("{ A = 110, C = 90 }", "{ A0 = 60, C = 60 }").replace(
        "A = [30, 40]", 'A = [30, 40]\nA0 = { from = "C", distance = 120, angle = 31 }')
    with pytest.raises(Refused, match="arcs of its points meet cannot be told"):
        certify(parse(touching, "touching"), 30)
