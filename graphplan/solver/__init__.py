"""The second opinion, apart from every construction: each link's rates from one linear system, the forces from another.

The power equation gives a third on the balances.
"""

from graphplan.solver.friction import Frictional, with_friction
from graphplan.solver.power import power
from graphplan.solver.rates import Rates, solve
from graphplan.solver.reactions import Reactions, reactions

__all__ = ["Frictional", "Rates", "Reactions", "power", "reactions", "solve", "with_friction"]
