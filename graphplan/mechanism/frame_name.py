"""The name of the fixed link."""

from __future__ import annotations

FRAME = "frame"


class FrameName(str):
    """The name of a fixed link that the scene calls otherwise, such as 1: written so, and equal to FRAME."""

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        return str.__eq__(self if isinstance(other, FrameName) else FRAME, other) is True

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(FRAME)
