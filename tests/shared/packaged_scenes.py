"""The packaged scenes, each read once in a process, for what is tried on those that have something."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from face import names

import graphplan as gp


@cache
def read(name: str) -> gp.Scene:
    """A packaged scene."""
    return gp.load(name)


def those(have: Callable[[gp.Scene], object]) -> list[str]:
    """The names of the packaged scenes that have something."""
    return [name for name in names() if have(read(name))]
