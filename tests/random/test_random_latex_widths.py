"""Pictures of random linkages in a column of text: their labels stand apart at the printed width."""

from __future__ import annotations

from contextlib import suppress

import pytest
from linkages import scenes
from printed_labels import clashes

from graphplan.errors import Refused


@pytest.mark.parametrize("seed", range(4))
def test_labels_of_random_linkages_stand_apart(seed: int) -> None:
    """No label reaches into another one where a picture is half a line wide."""
    with suppress(Refused):
        assert clashes(next(scenes(seed)), 0.5)[1] == 0
