"""What lies where by construction, in every pose: lines that run alike through one point are one line, and a point
from which a vector is laid off and back is itself.

A line's heading is the line that its direction was taken from, by its place, and how many quarter turns it runs ahead
of that one. A point lies on a line that was drawn through it, and on one by which it was marked.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from graphplan.kernel.kinds import LINE, POINT, Primitive

Heading = tuple[int, int]
Total = tuple[tuple[int, int], ...]  # marks by their places, each with how many times it counts


def bearing(op: Primitive, read: Sequence[Heading], place: int) -> Heading:
    """The heading of what an operation makes of marks with these headings: of a line at this place its own, but for
    one that is drawn by another line."""
    along, turns = direction_source(op)
    if along is None:
        return place, 0
    base, ahead = read[along]
    return base, (ahead + turns) % 4


@cache
def direction_source(op: Primitive) -> tuple[int | None, int]:
    """The operand whose direction a line takes, if it does, and by how many quarter turns it is ahead."""
    sources = [(place, turns) for turns, claim in enumerate(("parallel", "perpendicular"))
               for place in op.claim_operands(claim)
               if op.gives == LINE]
    return sources[0] if sources else (None, 0)


@cache
def incident(op: Primitive) -> tuple[int, ...]:
    """The points that a line is drawn through, or the lines that a point is marked by, among the operands."""
    incident_kind = {LINE: POINT, POINT: LINE}.get(op.gives, "")
    return tuple(place for place in op.claim_operands("on") if op.reads[place] == incident_kind)


def laid_off(P: Total, Q: Total, R: Total) -> Total:
    """Where the vector PQ leads that is laid off from R, as a sum of marks."""
    counts: dict[int, int] = {}
    for terms, times in ((R, 1), (Q, 1), (P, -1)):
        for mark, count in terms:
            counts[mark] = counts.get(mark, 0) + times * count
    return tuple(sorted((mark, count) for mark, count in counts.items() if count))
