"""The second opinion, apart from every construction: each link's rates from one linear system, the forces from another.

The power equation gives a third on the balances. What forces need is imported when it is asked for.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from graphplan.solver.rates import Rates, solve

if TYPE_CHECKING:
    from graphplan.solver.friction import Frictional, with_friction
    from graphplan.solver.statics import Reactions, power, reactions

__all__ = ["Frictional", "Rates", "Reactions", "power", "reactions", "solve", "with_friction"]

_FORCES = {"Frictional": "friction", "with_friction": "friction", "Reactions": "statics",
           "power": "statics", "reactions": "statics"}


def __getattr__(name: str) -> Any:
    """Import what forces need from its module."""
    if name not in _FORCES:
        raise AttributeError(name)
    return getattr(import_module(f"graphplan.solver.{_FORCES[name]}"), name)
