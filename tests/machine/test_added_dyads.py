"""Added dyads: the mass centre as a joint of a linkage, whose plans find how it moves."""

from __future__ import annotations

from pathlib import Path

import pytest
from linkages_with_masses import four_bar, slider_crank

from graphplan.check.balance import check_added_dyads, mass_motion
from graphplan.commands import main
from graphplan.cycle import follow
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load, parse

MASSES = [(2, 0.06, 0.02), (3, 0.2, -0.03), (4, 0.12, 0.01)]


@pytest.mark.parametrize(("scene", "count"), [
    (four_bar(MASSES), 3), (four_bar([(m, s, 0) for m, s, _ in MASSES]), 3), (slider_crank(MASSES), 1),
    (load("ozols-16-1"), 1), (load("rosenauer-loaded"), 1)], ids=["four-bar", "straight", "slider", "engine", "eight"])
def test_plans_of_added_dyads(scene: Scene, count: int) -> None:
    """A slider-crank takes one dyad, a four-bar three; the plans find velocity and acceleration of the mass centre."""
    added, check = check_added_dyads(scene)
    assert added.count == count
    assert max(check.values()) < 1e-12


def test_the_joint_goes_with_the_mass_centre() -> None:
    """In other poses, too, the joint of the added dyads moves as the mass centre does."""
    given = four_bar(MASSES)
    moved = follow(parse(check_added_dyads(given)[0].text, "dyads"), 8, (0.0, 20.0))
    whole = mass_motion(given, 36)
    assert moved.points["S"][0] == pytest.approx(whole.path[0])
    assert moved.points["S"][-1] == pytest.approx(whole.path[2])


def test_other_linkages_are_refused(tmp_path: Path) -> None:
    """Where the vectors make no chain there are no such dyads; else the command writes the scene."""
    with pytest.raises(Refused, match="make no chain"):
        check_added_dyads(load("walschaerts-loaded"))
    file = tmp_path / "dyads.toml"
    assert main(["balance", "ozols-16-1", "-q", "-o", str(file)]) == 0
    assert main(["solve", str(file), "-q"]) == 0
