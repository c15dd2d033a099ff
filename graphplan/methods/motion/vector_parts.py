"""The parts of which velocities and accelerations are the sums: drawn head to tail they are what polar plans show."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from graphplan.kernel.program import Mark
from graphplan.methods.motion.network import BodyPoint

Vector = tuple[Mark, Mark]
RELATIVE, NORMAL, TANGENTIAL, CORIOLIS, SLIDING = "relative", "normal", "tangential", "coriolis", "sliding"


class VectorPart(NamedTuple):
    """A part of a vector: its kind, the points that it is of (`BA`), its letter, and its marks.

    One that ends where the whole vector does has the place of that; it is drawn when the place's end is known.
    """

    kind: str
    of: str
    letter: str
    start: Mark
    end: Mark | BodyPoint


def drawn_parts(parts: Iterable[VectorPart], ends: Mapping[BodyPoint, Mark]) -> Iterator[tuple[VectorPart, Vector]]:
    """Each part once, with its two marks, that has an end which stands apart from its beginning."""
    for part in dict.fromkeys(parts):
        end = part.end if isinstance(part.end, Mark) else ends.get(part.end)
        if end is not None and end is not part.start:
            yield part, (part.start, end)
