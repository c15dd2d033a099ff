"""The sheet of a linkage's balancing."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from linkages_with_masses import four_bar

from graphplan.check.balance import balancing
from graphplan.commands import main
from graphplan.mechanism.scene import load
from graphplan.output.panelled import pages
from graphplan.output.subjects.balance_sheet import BalanceSheet
from graphplan.sheet.plates.display import Arrow, Sheet

LINKAGE = four_bar([(2, 0.06, 0.02), (3, 0.2, -0.03), (4, 0.12, 0.01)])


@pytest.fixture(scope="module")
def sheet() -> Sheet:
    """The sheet of a four-bar linkage."""
    result = balancing(LINKAGE, 24)
    found = pages(lambda paper: BalanceSheet(paper, result))
    assert len(found) == 1
    return found[0]


def test_panels(sheet: Sheet) -> None:
    """The sheet has the mechanism, the polar diagram, and the diagrams over the travel."""
    assert [*sheet.panels] == ["mechanism", "shaking force", "cycle"]
    assert sheet.sentences[-1].startswith("From S_2 lay off the vector from B to H_3: mark S.")


def test_vectors_are_true_to_scale(sheet: Sheet) -> None:
    """The principal vectors stand head to tail, as long as they are by the scale of the plan."""
    vectors = [item for item in sheet.items if isinstance(item, Arrow) and item.layer == "plates"]
    assert [one.end for one in vectors[:-1]] == [two.start for two in vectors[1:]]
    long = [math.dist(one.start, one.end) * 0.005 for one in vectors]
    wanted = (0.0911111, 0.04 / 9), (2 / 9, 0.01), (0.16 / 3, 0.04 / 9)
    assert long == pytest.approx([math.hypot(*parts) for parts in wanted], rel=1e-6)


def test_scales_are_round() -> None:
    """The scales of the plan and of the polar diagram are round."""
    found = BalanceSheet("A3", balancing(load("ozols-16-1"), 24))
    assert found.k_s == 4.0
    assert found.polar(found.room([*found.panels][1])).k in (400.0, 500.0)


@pytest.mark.parametrize("ending", [".svg", ".pdf", ".dxf", ".tex"])
def test_files(ending: str, tmp_path: Path) -> None:
    """`graphplan balance` draws the sheet in every format, in the language asked for."""
    file = tmp_path / f"sheet{ending}"
    assert main(["balance", "ozols-16-1", "-q", "--positions", "12", "--paper", "A2", "-o", str(file)]) == 0
    assert file.stat().st_size > 5000
