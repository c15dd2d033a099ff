"""What a finished plan shows though nothing was drawn by it."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

import graphplan as gp
from graphplan.check.trusted import report
from graphplan.commands import main

CONTROLLED = {
    "rosenauer-basic": {"3", "4"}, "rosenauer-example-1": {"3"}, "rosenauer-example-2": {"6", "7"},
    "stephenson": {"3"}, "four-bar": {"2"},
}  # fmt: skip


@pytest.mark.parametrize("name", CONTROLLED)
def test_poles_lie_on_every_line(name: str) -> None:
    """The lines to the ends of a link's orthogonal velocities meet in its pole, exactly in fractions, and on the sheet
    but for rounding; links whose pole is marked have nothing left to control."""
    found = report(gp.load(name), exact=True)
    assert {control.link for control in found.drawing.controls} == CONTROLLED[name]
    for control in found.drawing.controls:
        off = control.true_deviation(found.scene.points, found.results["velocity"])
        assert isinstance(off, Fraction)
        assert off == 0
        assert control.drawn_deviation(found.drawing.values) == pytest.approx(0, abs=1e-9 * found.scene.extent**2)


def test_a_control_that_fails_is_a_broken_claim() -> None:
    """Where one velocity of three is another, by however little, the report says whose pole is missed."""
    found = report(gp.load("stephenson"), exact=True)
    x, y = found.results["velocity"]["B"]
    velocities = found.results["velocity"] | {"B": (x, y + Fraction(1, 10**30))}
    wrong = replace(found, results=found.results | {"velocity": velocities})
    assert found.agrees
    assert not wrong.agrees
    assert "link 3" in wrong.broken_claim


def test_polar_plans_and_what_is_not_asked_for_leave_no_control() -> None:
    """On a polar plan the lines are not drawn; two points of a link show its pole but nothing besides."""
    assert not gp.construct(gp.load("stephenson"), plan="polar").controls
    assert not any(gp.construct(gp.load(name)).controls for name in ("shaper", "jaanimets-10"))


def test_protocol_ends_with_the_control(capsys: pytest.CaptureFixture[str]) -> None:
    """The control closes the stage in which its last end is drawn; how far the pencil lets it miss is told, too."""
    assert main(["steps", "stephenson"]) == 0
    text = capsys.readouterr().out
    assert text.index("it meets") < text.index("Control: ") < text.index("On the N-plan")
    assert "control of link 3: ±" in text
