"""Sizes that differ by the rounding of floats alone are equal, however large their coordinates are."""

from __future__ import annotations

import pytest
from higher import TEXTS

from graphplan.errors import SceneError
from graphplan.mechanism.scene import parse

GEARS = "[points]\nO = [0.1, 0]\nB = [0.3, 0]\n[links]\n1 = 'O'\n2 = 'B'\nframe = 'O B'\n[[drive]]\nlink = '1'\n" \
        "omega = 1\n[[gears]]\nlinks = ['1', '2']\ncentres = ['O', 'B']\n"
FAR = "[points]\nB = [1000000.3, -1000000.1]\nK = [{}, -1000000.07]\nC = [{}, -999999.65]\n[links]\n2 = 'B'\n" \
      "frame = 'C'\n[[contacts]]\nlinks = ['2', 'frame']\nat = 'K'\ncentres = ['B', 'C']\nrolling = true\n" \
      "[[drive]]\nlink = '2'\nomega = 1\n"


@pytest.mark.parametrize("sizes", ["radii = [0.1, 0.10000000000000003]", "radii = [0.1, 0.1]\nteeth = [20, 20]",
                                   "radii = [0.12, 0.08000000000000002]\nteeth = [30, 20]"])
def test_radii_fit_their_centres_and_teeth_but_for_rounding(sizes: str) -> None:
    """A sum of radii may differ from the distance of the centres, and their ratio from that of the teeth, in the last
    digits of a float."""
    assert parse(GEARS + sizes, "x").gears


def test_radii_that_do_not_fit_are_told_with_the_digits_that_show_it() -> None:
    """What is off by more is a fault, and both sizes are written so that they differ."""
    with pytest.raises(SceneError) as error:
        parse(GEARS + "radii = [0.1, 0.10000003]", "x")
    assert error.value.lines == ("x: gears.1.radii: the distance 0.2 of the centres O and B is not the sum 0.20000003 "
                                 "of the radii; radii whose sum is the distance, or teeth",)
    with pytest.raises(SceneError, match="are not as the teeth"):
        parse(GEARS + "radii = [0.12, 0.08]\nteeth = [31, 20]", "x")


def test_a_contact_far_off_lies_on_its_normal_but_for_rounding() -> None:
    """The rounding of large coordinates turns a short radius by more than one of ordinary coordinates may be off."""
    assert parse(FAR.format("1000000.3400000002", "1000000.9"), "x").contacts
    with pytest.raises(SceneError, match="K is not in line with the centres B and C"):
        parse(FAR.format("1000000.34", "1000000.90001"), "x")
    assert parse(TEXTS["wheel on a wheel"], "x").contacts
