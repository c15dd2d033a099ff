"""Pivots that the frame was meant to have: points of one link alone that would hold a mechanism."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, islice

from graphplan.errors import by_name
from graphplan.mechanism.bracing import bracing
from graphplan.mechanism.model import FRAME, Scene

TRIED, TOLD = 200, 3  # sets of points, in a scene with many loose ends


def missing_pivots(scene: Scene, freedoms: int) -> list[tuple[str, ...]]:
    """The points that would take so many freedoms from a scene if they were on the frame too, in each of a few ways.

    They are on no other link, and with them the drives determine the motion. A pivot takes two freedoms. First come
    those of the links with the fewest points, which have no other use.
    """
    if freedoms % 2 or scene.motions:  # of an open chain it is a motion that is missing
        return []
    fixed = scene.links.get(FRAME, ())
    lone = {point: links[0] for point, links in scene.links_of.items() if len(links) == 1}
    ends = sorted(lone.keys() - {*fixed}, key=lambda p: (len(scene.links[lone[p]]), by_name(p)))
    ways = islice(combinations(ends, freedoms // 2), TRIED)
    held = (way for way in ways if bracing(replace(scene, links={**scene.links, FRAME: (*fixed, *way)})).sound)
    return list(islice(held, TOLD))


def framed(scene: Scene, way: tuple[str, ...]) -> str:
    """The frame with these points, as it is written."""
    return f'frame = "{" ".join((*scene.links.get(FRAME, ()), *way))}"'
