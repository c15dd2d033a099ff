"""The packaged scenes, each read once in a process, for what is tried on those that have something."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load, packaged_names


@cache
def read(name: str) -> Scene:
    """A packaged scene."""
    return load(name)


def those(have: Callable[[Scene], object]) -> list[str]:
    """The names of the packaged scenes that have something."""
    return [name for name in packaged_names() if have(read(name))]
