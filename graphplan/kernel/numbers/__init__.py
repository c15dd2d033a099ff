"""Number domains: what a rule may ask of its numbers beyond + - * / and abs.

A domain lifts scene numbers, takes square roots and decides what is zero. Rules are written once and serve floats,
arrays of poses and exact fractions alike.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any


class Domain(ABC):
    """The four questions a rule may ask, and one that is asked of its answer."""

    def lift(self, value: Any) -> Any:
        """The scene's number in this domain."""
        return float(value)

    @abstractmethod
    def sqrt(self, value: Any, code: str, why: str) -> Any:
        """The square root, or the failure `code` where `value` is negative."""

    @abstractmethod
    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        """`value`, or the failure `code` where it is zero beside `scale`, the size of what it was made from."""

    @abstractmethod
    def sign(self, value: Any, scale: Any) -> Any:
        """1, -1, or 0 where `value` is zero beside `scale`: the sense of a motion, and whether there is one."""

    def whole(self, value: Any) -> Any:
        """A rule's answer, nothing of it left for poses that it could not draw."""
        return value
