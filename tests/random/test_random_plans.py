"""Whatever the mechanism, each plan of its construction can be begun anywhere: nothing is joined across plans."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import chain, count, islice

import pytest
from apart import strays
from gearings import gearing
from linkages import scenes
from loads import loaded_scenes

from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import INERTIA
from graphplan.methods.construct import construct

SCENES = 24  # of each kind
FIRST = {"gearings": (38, 93)}  # seeds of scenes in which lines were once shifted from points of another plan
ROUNDED = 1e-6  # beside a plan: flat crossings lose digits, marks of another plan are whole lengths off
STYLES = [(plan, method) for plan in ("orthogonal", "polar", "") for method in ("", "trial", "poles", "auxiliary")]
KINDS: dict[str, Callable[[int], Iterator[Scene]]] = {
    "linkages": lambda seed: scenes(seed, 1),
    "gearings": lambda seed: scenes(seed, 1, gearing),
    "loaded linkages": lambda seed: loaded_scenes(seed, 1),
    "loaded gearings": lambda seed: loaded_scenes(seed, 1, gearing),
}


@pytest.mark.parametrize("kind", KINDS)
def test_each_plan_moves_as_a_whole(kind: str) -> None:
    """As it is recorded, in fractions, and as it is drawn: where a plan is begun moves its marks and no others."""
    tried = 0
    for number, scene in enumerate(islice(drawable(kind), SCENES)):
        plan, method = STYLES[number % len(STYLES)]
        inertia = INERTIA[number % len(INERTIA)] if scene.loads else "couple"
        try:
            drawing = construct(scene, plan=plan, method=method, inertia=inertia)
            exact = strays(drawing.program, Fractions(), Fraction(scene.extent))
            drawn = strays(drawing.drawn, Floats(), float(scene.extent), ROUNDED)
        except (ConstructionError, Refused):
            continue
        assert not exact + drawn, f"{scene.title} {plan} {method} {inertia}: {exact + drawn}"
        panels = [{drawing.drawn.steps[end].panel for end in (arrow.start, arrow.end)} for arrow in drawing.arrows]
        assert all(len(both) == 1 for both in panels), f"{scene.title}: a vector from plan to plan"
        tried += 1
    assert tried > SCENES // 2


def drawable(kind: str) -> Iterator[Scene]:
    """Random scenes of a kind, one after the other."""
    for seed in chain(FIRST.get(kind, ()), count()):
        yield from KINDS[kind](seed)
