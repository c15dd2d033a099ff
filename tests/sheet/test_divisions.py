"""How plans share a page: every panel has the shape of its plan, and the title block its corner."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sheets import SCENES, composition_of

from graphplan.sheet.layout.division import FACTS, Demand, divide_among_plans
from graphplan.sheet.layout.plan_scales import divide_region
from graphplan.sheet.plates.display import Rect

PAGE, BLOCK = Rect(20.0, 10.0, 410.0, 287.0), Rect(310.0, 10.0, 410.0, 40.0)
SIDES = st.floats(1e-3, 1e3)
DEMANDS = st.lists(st.builds(Demand, SIDES, SIDES, st.integers(1, 60), st.just((1,)), st.floats(0.0, 60.0)),
                   min_size=1, max_size=9)


def division(demands: list[Demand], block: Rect | None = None, page: Rect = PAGE) -> dict[str, Rect] | None:
    """The panels of plans that are called by their numbers; none is a twin."""
    named = {str(k): demand for k, demand in enumerate(demands)}
    return divide_among_plans(page, block, named, {name: name for name in named})


@given(DEMANDS, st.booleans())
def test_each_plan_has_a_panel_that_holds_it(demands: list[Demand], blocked: bool) -> None:
    """Panels lie apart, in the page, off the title block, and as wide as their captions."""
    found = division(demands, BLOCK if blocked else None)
    assert found is not None
    rects = [*found.values(), *([BLOCK] if blocked else [])]
    assert not any(one.meets(other) for i, one in enumerate(rects) for other in rects[:i])
    assert all(PAGE.holds(corner, 1e-6) for rect in rects for corner in rect.corners)
    assert {*found} == {str(k) for k in range(len(demands))}  # neighbours may have changed places
    assert all(found[str(k)].width >= demand.caption - 1e-6 for k, demand in enumerate(demands))


def test_a_region_is_divided_anew_for_other_scales() -> None:
    """A division is remembered for the scales that were given: at a larger one the same plan has a larger panel."""
    plans = replace(composition_of("four-bar").plans)
    wants = [dict.fromkeys(plans.panels, Demand(300.0, 200.0, 9, (1,), 0.0, scale)) for scale in (4.0, 1.0)]
    assert divide_region(wants[:1], plans, "A3", PAGE, BLOCK) is not None
    assert divide_region(wants[1:], plans, "A3", PAGE, BLOCK) is None


@given(DEMANDS)
def test_the_first_plan_is_the_first_that_is_read(demands: list[Demand]) -> None:
    """It has the upper left corner, and the last the lower right one."""
    first, *_, last = [*(found := division(demands) or {}).values()] * 2
    assert (len(found), first.left, first.top) == (len(demands), PAGE.left, PAGE.top)
    assert (last.right, last.bottom) == (PAGE.right, PAGE.bottom)


def test_panels_have_the_shapes_of_their_plans() -> None:
    """A long plan stands over or under a second of its kind, a high one beside it."""
    long, high = Demand(300.0, 40.0, 9, (1,), 0.0), Demand(40.0, 300.0, 9, (1,), 0.0)
    square = Rect(0.0, 0.0, 200.0, 200.0)
    over, beside = division([long, long], page=square), division([high, high], page=square)
    assert over
    assert beside
    assert over["0"].bottom == over["1"].top
    assert beside["0"].right == beside["1"].left


def test_crowded_plans_are_larger() -> None:
    """Of two plans of one shape the one with more marks is drawn at the larger scale or the same."""
    few, many = Demand(100.0, 100.0, 4, (1,), 0.0), Demand(100.0, 100.0, 60, (1,), 0.0)
    found = division([few, many])
    assert found
    assert found["1"].area > found["0"].area


def test_a_crowded_plan_takes_room_from_plans_of_few_marks() -> None:
    """Of three plans that just have room the crowded one is finer where the others are coarser for it."""
    page, few, many = Rect(0.0, 0.0, 240.0, 160.0), *(Demand(100.0, 100.0, marks, (1,), 0.0) for marks in (4, 60))
    found = division([many, few, few], page=page)
    assert found
    assert many.panel(Fraction(1))[0] <= found["0"].width
    assert max(found["1"].width, found["2"].width) < few.panel(Fraction(1))[0]


def test_facts_have_a_part_of_the_page_that_holds_them_in_one_of_their_shapes() -> None:
    """Beside plans of one shape facts lie in a part that is at least as wide and high as one of the sizes they have."""
    plans = {name: Demand(100.0, 100.0, 20, (1,), 0.0) for name in "ab"}
    sizes = [(60.0, 90.0), (120.0, 50.0), (200.0, 30.0)]
    found = divide_among_plans(PAGE, BLOCK, plans, {name: name for name in plans}, sizes)
    assert found
    facts = found.pop(FACTS)
    assert any(facts.width >= wide and facts.height >= high for wide, high in sizes)
    assert not any(facts.meets(rect) for rect in (*found.values(), BLOCK))


def test_a_given_scale_is_kept_or_the_plan_has_no_room() -> None:
    """At a given scale a plan that is too large for the page has no panel; a smaller one has one."""
    assert division([Demand(300.0, 100.0, 4, (1,), 0.0, given=0.5)]) is None
    assert division([Demand(300.0, 100.0, 4, (1,), 0.0, given=1.0)])
    assert Demand(300.0, 100.0, 4, (1,), 0.0, given=0.5).scale(1.0) == Fraction(1, 2)


@pytest.mark.parametrize("name", SCENES)
def test_plans_take_most_of_the_first_page(name: str) -> None:
    """Panels are more than half of the page, and none is so slim that its caption is cut off."""
    arrangement = composition_of(name).arrangement
    assert arrangement.share > 0.5
    assert min(rect.width for rect in arrangement.panels.values()) > 20
