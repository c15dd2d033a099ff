"""The pencil: what it is by default, and how it is spoken of on the command line."""

from __future__ import annotations

import math

import pytest

from graphplan.accuracy.hand import Pencil, pencil
from graphplan.errors import Refused

FAULTS = [
    ("width=0.2", "no such error"), ("point", "not a size"), ("point=", "not a size"), ("point=thick", "not a size"),
    ("point=-0.1", "not a size"), ("edge=nan", "not a size"), ("opening=inf", "not a size"), ("angle=60", "not a size"),
    ("point=0.1,point=0.2", "given twice"), ("=0.1", "no such error"),
]


def test_points_are_mostly_within_a_narrow_line() -> None:
    """Nineteen of twenty points fall within a quarter of a millimetre."""
    assert 1 - math.exp(-((0.25 / Pencil().point) ** 2) / 2) == pytest.approx(0.95, abs=0.01)


def test_a_pencil_is_what_it_is_told_to_be() -> None:
    """Sizes that are told count; the others stay, and none told is the default."""
    assert pencil("point=0.2, angle=0.1") == Pencil(point=0.2, angle=0.1)
    assert pencil("") == Pencil()


@pytest.mark.parametrize(("text", "why"), FAULTS)
def test_a_pencil_that_makes_no_sense_is_refused(text: str, why: str) -> None:
    """A size that is none, or of no known error, is refused in one line that names it."""
    with pytest.raises(Refused, match=why) as refused:
        pencil(text)
    assert refused.value.what.startswith("--pencil")
    assert "\n" not in str(refused.value)
