"""The second opinion: each link's rates from one linear system, apart from every construction."""

from graphplan.solver.rates import Rates, solve

__all__ = ["Rates", "solve"]
