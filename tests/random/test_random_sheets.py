"""Sheets of random linkages: what is nothing is not drawn large, and what is little on no large paper."""

from __future__ import annotations

import math
import re

import pytest
from linkages import linkage, scenes

import graphplan as gp
from graphplan.mechanism.scene import parse
from graphplan.methods.kinds import ACCELERATION
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import pages
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import Text
from graphplan.sheet.plates.plans import Plans

GREEK_NAMES = "kappa", "eta", "psi", "theta", "lambda", "zeta"
AT_REST = (309, 311, 321)  # no link has a normal acceleration beside another: their plan holds rounding alone


@pytest.mark.parametrize("seed", AT_REST)
def test_a_plan_of_rounding_is_a_spot(seed: int) -> None:
    """Marks that differ by rounding alone are one spot, so that no scale is chosen by them."""
    plans = Plans(gp.construct(next(scenes(seed))))
    sizes = {panel: max(extent.core.width, extent.core.height)
             for panel in plans.panels for extent in [plans.extent(panel)]}
    assert sizes["N-plan"] == 0 < sizes["mechanism"]
    assert all(abs(x) + abs(y) > 1e-6 for x, y in plans.extent("N-plan").extra)


@pytest.mark.parametrize("seed", [7064, 7074])
def test_two_marks_take_no_larger_paper(seed: int) -> None:
    """Letters have room around two marks, however near these are to each other; a few links stand on A4."""
    assert compose(gp.construct(next(scenes(seed)))).arrangement.paper == "A4"


def test_accelerations_from_rest_are_in_proportion() -> None:
    """Where nothing moves yet accelerations on the mechanism plan are drawn about as long as velocities would be."""
    drawing = gp.construct(next(scenes(7074)))
    a = float(drawing.tempo.kappa) ** 2 * math.hypot(*drawing.computed[ACCELERATION]["P0"])
    assert 0.05 <= a / drawing.scene.extent <= 0.5


def test_nothing_is_told_under_no_heading() -> None:
    """A link that turns about its only point has no marks, results or methods: no words stand for them."""
    page = pages(compose(gp.construct(next(scenes(7062)))))[0]
    told = {plain(item.runs) for item in page.items if isinstance(item, Text)}
    assert "Mechanism plan" in told
    assert not told & {"Construction", "Results", "Method and forms"}


def test_points_with_greek_names_have_greek_letters() -> None:
    """On the plans, as ends of sides under what is given, and in results; no letter of a locus is a part of a name."""
    text = linkage(7060).text()
    for number, name in enumerate(GREEK_NAMES):
        text = text.replace(f"P{number}", name)
    scene = gp.at(parse(text, "greek"), 5)
    sheet = pages(compose(gp.construct(scene, plan="polar"), protocol="pages"))
    told = [plain(item.runs) for page in sheet for item in page.items if isinstance(item, Text)]
    assert not re.findall("|".join(GREEK_NAMES), " ".join(told), re.IGNORECASE)
    assert "κ" in "".join(told)
