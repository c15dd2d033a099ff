"""Questions: what a scene may well say, and what is more often a slip of the pen."""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.errors import Fault
from graphplan.mechanism.model import Scene
from graphplan.mechanism.numerals import shown

ROUGHEST = 2
"""A coefficient of friction: no dry surfaces of machines rub more, and a wedge-shaped slide seldom seems to."""


def questions(scene: Scene) -> Iterator[Fault]:
    """What is to be looked at again, each with where it stands and what was perhaps meant."""
    for number, friction in enumerate(scene.loads.frictions if scene.loads else (), 1):
        if (coefficient := friction.coefficient) > ROUGHEST:
            yield Fault(f"friction.{number}.coefficient", f"{shown(coefficient)} is more than dry surfaces have",
                        f"perhaps {shown(coefficient / 100)}, if that is in percent")
