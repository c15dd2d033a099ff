"""Scenes that are asked for all their poles."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

from graphplan.mechanism.model import FRAME, Find, Scene


def with_all_poles(scene: Scene) -> Scene:
    """The scene, asked for the poles of all pairs of links, and for nothing else."""
    links = (*scene.moving, FRAME)
    return replace(scene, find=Find((), (), poles=tuple(map(" ".join, combinations(links, 2)))), loads=None)
