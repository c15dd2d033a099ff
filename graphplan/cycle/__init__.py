"""How it goes round: the positions of a mechanism over the travel of its drive."""

from graphplan.cycle.turn import Turn, follow

__all__ = ["Turn", "follow"]
