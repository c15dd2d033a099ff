"""A machine that does not turn is moved within its span, wherever travel is counted from."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from graphplan.errors import Refused
from graphplan.machine.motion.true_motion import require_within_span


def machine(begin: float, period: float) -> Any:
    """A machine that does not turn and is known over a period from its beginning."""
    return SimpleNamespace(closed=False, begin=begin, period=period, travel_text=str)


@pytest.mark.parametrize("begin", [-200.0, -100.0, 0.0, 300.0])
def test_a_travel_to_the_end_of_the_span_is_within_it(begin: float) -> None:
    """The last travel is reached where it is below zero, zero or above, and rounding beyond it as well."""
    require_within_span(machine(begin, 100.0), begin + 20.0, begin + 100.0)
    require_within_span(machine(begin, 100.0), begin + 20.0, begin + 100.0 + 5e-11)


@pytest.mark.parametrize("begin", [-200.0, -100.0, 0.0])
def test_a_travel_beyond_the_span_is_refused(begin: float) -> None:
    """What goes on by more than rounding is refused."""
    with pytest.raises(Refused):
        require_within_span(machine(begin, 100.0), begin + 20.0, begin + 100.0 + 1e-8)
