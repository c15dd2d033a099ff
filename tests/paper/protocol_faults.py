"""Protocols judged as a whole: executed on paper, their sentences held to a ruler and to their own numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from reader import Reader
from speech import misread, reasoned_wrong, side, spoken_wrong


def faults(protocol: Mapping[str, Any], paper: str = "") -> list[str]:
    """All that is wrong in the data of a protocol, drawn on this paper."""
    reader = Reader.of(protocol["steps"])
    longest = side(paper or protocol["pencil"]["paper"])
    by_set_squares = any(step["instrument"] == "set squares" for step in protocol["steps"])
    # by compasses alone the same arcs serve several stages, which then read each other
    reasons = reasoned_wrong(protocol["entries"], protocol["steps"]) if by_set_squares else ()
    return [*reader.faults, *_spoken(protocol, reader, longest), *reasons]


def _spoken(protocol: Mapping[str, Any], reader: Reader, longest: float) -> Iterator[str]:
    """What its sentences say wrong."""
    for told in (*protocol["steps"], *protocol["entries"]):
        yield from spoken_wrong(told, reader.measure, longest)
    for reading in protocol["readings"]:
        yield from spoken_wrong(reading, reader.measure, longest)
        yield from misread(reading)
