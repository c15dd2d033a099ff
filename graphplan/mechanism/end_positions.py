"""The end positions of a slide over the motion, which only the cycle knows: the front door names who finds them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene, Slide

find: Callable[[Scene, Slide], tuple[float, float]]
