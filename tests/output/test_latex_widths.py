"""Pictures in LaTeX in a column of text: their labels stand apart at the printed width."""

from __future__ import annotations

import re
from itertools import cycle

import pytest
from printed_labels import clashes

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import pencil
from graphplan.mechanism.scene import packaged_names
from graphplan.output.exports.tikz import LINE_MM, tikz
from graphplan.sheet.layout.screen import compose_for_column

WIDTHS = 0.8, 0.5, 1.0, 60, 88, 150  # of \\linewidth, or mm


@pytest.mark.parametrize(("name", "width"), zip(packaged_names()[::2], cycle(WIDTHS), strict=False))
def test_labels_stand_apart_at_the_printed_width(name: str, width: float) -> None:
    """No label of a picture reaches into another one at its final width, in the type that the file sets it in."""
    labels, pairs = clashes(gp.load(name), width)
    assert labels > 3
    assert pairs == 0


def test_plans_are_as_large_as_there_is_room_where_no_scales_are_told() -> None:
    """A picture as wide as a part of a line needs no round scales: fewer of its labels find no good place."""
    lines, mm = 0.0, 0.0
    for name in ("inflection-circle", "cardan-circles", "arc-cam"):
        plans = draft(gp.construct(gp.load(name)), pencil("")).composition.plans
        lines += compose_for_column(plans, 0.8 * LINE_MM, scales_told=False).poor
        mm += compose_for_column(plans, 0.8 * LINE_MM).poor
    assert lines < mm


def test_scales_are_told_where_they_are_known() -> None:
    """A picture so many mm wide tells the scales at which it is printed; one as wide as a line, none."""
    sheet = draft(gp.construct(gp.load("four-bar")), pencil("")).composition
    source = tikz(sheet, width=60)
    reduction = float(re.findall(r"graphplan=60mm/([\d.]+)", source)[0]) / 60
    ends = [float(x) for x in re.findall(r"\\coordinate \([OC]\) at \(([-\d.]+),", source)][:2]
    k_s = float(re.findall(r"\$k_\{s\}\$ = ([\d.]+)", source)[0])
    scene = gp.load("four-bar")
    assert reduction > 1
    apart = abs(float(scene.points["O"][0] - scene.points["C"][0]))
    assert k_s * abs(ends[1] - ends[0]) / reduction == pytest.approx(apart)
    assert "k_{s}" not in tikz(sheet, width=0.5)
