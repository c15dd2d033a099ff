"""Words and symbols that give way: rows closer to each other, a drive's arrow beside its ground, one plane for all."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from sheets import composition_of

import graphplan as gp
from graphplan.errors import Refused
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.layout.paper import COLUMN, paginate, paginate_tightly
from graphplan.sheet.lettering.lettering import TextRun, plain, sentence_runs
from graphplan.sheet.plates import symbols
from graphplan.sheet.plates.display import Arc, Rect
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.rows import BOX_HEIGHT, TIGHT_BOX_HEIGHT, Cell, TextRow, tighten
from graphplan.sheet.words.task import TaskWords


@pytest.mark.parametrize(("name", "saved"), [("shaper", True), ("class-four", False)])
def test_rows_come_closer_where_that_saves_a_page(name: str, saved: bool) -> None:
    """A guided handout whose last table would need a page of its own is set closer; any other is not."""
    composition = composition_of(name)
    arrangement = composition.arrangement
    rows = TaskWords(composition.plans, composition=composition).lines(COLUMN, guided=True)
    loose, found = list(paginate(rows, arrangement)), paginate_tightly(rows, arrangement)
    assert len(found) == len(loose) - saved
    assert (found == loose) != saved
    assert sum(map(len, found)) == len(rows)


def test_a_page_ends_after_any_row_and_holds_no_row_that_is_higher() -> None:
    """In a column that holds one row the first stands alone; a row that is higher than any page is refused."""
    arrangement = composition_of("four-bar", protocol="aside").arrangement
    narrow = replace(arrangement, columns=arrangement.columns[:1])
    high = TextRow((Cell(0.0, (TextRun("A"),)),), tall=0.6 * (narrow.columns[0].top - narrow.columns[0].bottom))
    first, *others = paginate([high, high, high], narrow)
    assert (len(first), sum(map(len, others))) == (1, 2)
    with pytest.raises(Refused, match="does not fit on a page"):
        list(paginate([replace(high, tall=1e4), high], narrow))


def test_a_box_for_a_number_gets_lower_but_not_narrower() -> None:
    """Closer rows keep their words and the widths of their boxes."""
    blank = TextRow((Cell(0.0, (TextRun("A"),)),), gap=1.0, tall=BOX_HEIGHT, boxes=(Rect(10.0, 0.0, 30.0, BOX_HEIGHT),))
    tight = tighten(blank)
    assert (tight.cells, tight.gap, tight.height) == (blank.cells, 0.5, TIGHT_BOX_HEIGHT)
    assert tight.boxes == (Rect(10.0, 0.0, 30.0, TIGHT_BOX_HEIGHT),)
    assert tighten(TextRow(blank.cells, gap=2.0)) == TextRow(blank.cells, gap=1.0)


def test_the_coefficient_of_friction_is_a_greek_letter() -> None:
    """The mu of a task is set as a textbook sets it, but not the letters mu in a word."""
    assert plain(sentence_runs("Friction at B: mu = 0.1.")) == "Friction at B: μ = 0.1."
    assert plain(sentence_runs("mud")) == "mud"


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("angle", range(0, 360, 30))
def test_the_arrow_of_a_drive_stays_off_the_ground(angle: int, sign: float) -> None:
    """The arrow lies beside its crank, ahead or behind, and nowhere over the ground, however the crank stands."""
    turn = math.radians(angle)
    if math.sin(turn) < -0.6:
        return  # there the ground itself goes elsewhere
    arc, _ = symbols.drive((0.0, 0.0), (math.cos(turn), math.sin(turn)), sign, (0.0, -1.0))
    assert isinstance(arc, Arc)
    assert not any(abs(x) < symbols.GROUND and y < 0 for x, y in arc.spots())
    assert min(abs((end - angle + 180) % 360 - 180) for end in (arc.start, arc.end)) == pytest.approx(14.0)


def test_plans_that_lie_as_one_say_so() -> None:
    """Over a strict drawing stands that mechanism, velocities and accelerations have one plane; forces too."""
    plans = Plans(gp.construct(gp.load("four-bar"), strict=True))
    assert plans.panels == ["mechanism"]
    told = MECHANISM.caption(plans.kinds(MECHANISM))
    assert told == "Mechanism, velocities and accelerations in one plane"
    loaded = {"acceleration", "load", "part", "reaction"}
    assert MECHANISM.caption(loaded) == "Mechanism, velocities, accelerations and forces in one plane"
