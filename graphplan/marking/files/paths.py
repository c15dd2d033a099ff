"""Paths of pieces that are straight or curved, as SVG and PDF have them: the chains of spots and what these show."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Any

from svgelements import Close, Line, Matrix, Move, Path

from graphplan.marking.files import measures
from graphplan.marking.files.drawing import chain_traces, recognize_curve
from graphplan.marking.files.svg_view import spot
from graphplan.marking.traces import Spot, Trace


def chains(drawn: Path, onto: Matrix) -> Iterator[tuple[bool, list[Spot]]]:
    """The chains of a path on paper, and whether curves join their spots: a new one wherever the pen is lifted, or goes
    over from straight pieces to curves."""
    segments_drawn = (segment for segment in drawn if not isinstance(segment, Close) or segment.start != segment.end)
    for smooth, group in groupby(segments_drawn, key=_is_curve):
        chain = list(group)
        if smooth is not None:
            count = measures.CURVE_PARTS
            ends = [segment.point(i / count) if i < count else segment.end
                    for segment in chain for i in range(1 if smooth else count, count + 1)]
            yield smooth, [spot(onto, end) for end in (chain[0].start, *ends)]


def _is_curve(segment: Any) -> bool | None:
    return None if isinstance(segment, Move) else not isinstance(segment, Line | Close)


def traces_of_chain(smooth: bool, spots: Sequence[Spot]) -> Iterable[Trace]:
    """Traces of a chain: its straight pieces, or the line, circle, arc or dot that its curves are, if they are one."""
    return filter(None, [recognize_curve(spots)]) if smooth else chain_traces(spots, measures.MIN_LINE_MM)
