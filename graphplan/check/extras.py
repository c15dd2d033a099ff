"""What is asked for beside the motion and the forces: instant centres, centres of curvature, inflection circles.

None of these takes anything else with it. One that does not exist in a pose, or that cannot be drawn there, is left
out with its reason, and the rest is found without it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Generic, TypeVar

from graphplan.check.paths import NOTHING_MOVES
from graphplan.errors import ConstructionError, GraphplanError, Refused, SingularPose
from graphplan.mechanism.model import Scene
from graphplan.solver import solve
from graphplan.solver.instant_centres import relative

EXTRAS = "poles", "curvature", "inflection"

Item = tuple[str, str]  # which of these, and of what
Reasons = dict[str, dict[str, str]]
Answer = TypeVar("Answer")


def answered(scene: Scene, attempt: Callable[[Scene], Answer]) -> tuple[Answer, Reasons]:
    """What `attempt` gives of a scene, and why any of its extras are left out, by kind and name.

    Fails as `attempt` does of the scene without extras, or where these are all that is asked for and none is left.
    """
    try:
        return attempt(scene), {}
    except (ConstructionError, Refused, SingularPose) as fault:
        every = extras(scene)
        if not every:
            raise
        if resting := at_rest(scene):
            moving = without(scene, resting)
            if not (extras(moving) or asks_more(scene)):
                raise
            answer, reasons = answered(moving, attempt)
            return answer, joined(resting, reasons)
        search = _Search(scene, attempt)
        if asks_more(scene):
            search.answer = attempt(asking(scene, ()))
        search.add(every, fault)
        if search.answer is None:
            raise
        return search.answer, search.reasons


def extras(scene: Scene) -> list[Item]:
    """The extras that are asked for."""
    return [(kind, name) for kind in EXTRAS for name in getattr(scene.find, kind)]


def without(scene: Scene, reasons: Mapping[str, Mapping[str, str]]) -> Scene:
    """The scene without the extras that these reasons are of."""
    return asking(scene, [(kind, name) for kind, name in extras(scene) if name not in reasons.get(kind, ())])


def joined(one: Reasons, other: Reasons) -> Reasons:
    """Both reasons, by kind and name."""
    return {kind: one.get(kind, {}) | other.get(kind, {}) for kind in (*one, *other)}


def at_rest(scene: Scene) -> Reasons:
    """Why poles of links that do not move relative to each other, and circles of links at rest, do not exist."""
    reasons: Reasons = {}
    if scene.irrational:
        return reasons
    with suppress(SingularPose):
        rates = solve(scene, exact=True)
        for name in scene.find.poles:
            try:
                relative(rates, *scene.link_pair(name))
            except SingularPose as singular:
                reasons.setdefault("poles", {})[name] = singular.why
        for link in scene.find.inflection:
            if not rates.omega[link] and not any(any(rates.velocity[point]) for point in scene.links[link]):
                reasons.setdefault("inflection", {})[link] = NOTHING_MOVES.format(link)
    return reasons


def asking(scene: Scene, items: Sequence[Item]) -> Scene:
    """The scene with no extras but these."""
    kept: dict[str, Any] = {kind: tuple(name for own, name in items if own == kind) for kind in EXTRAS}
    return replace(scene, find=replace(scene.find, **kept))


def asks_more(scene: Scene) -> bool:
    """Whether anything but extras is asked for."""
    find = scene.find
    return scene.loads is not None or any((find.velocity, find.acceleration, find.links, find.slides))


class _Search(Generic[Answer]):
    """The extras that can be answered together, halved until those that cannot are left alone."""

    def __init__(self, scene: Scene, attempt: Callable[[Scene], Answer]):
        self.scene, self.attempt = scene, attempt
        self.answer: Answer | None = None
        self.kept: list[Item] = []
        self.reasons: Reasons = {}

    def add(self, items: Sequence[Item], fault: GraphplanError) -> None:
        """Keep those of `items`, which together fail with `fault`, that do not."""
        if len(items) == 1:
            (kind, name), = items
            self.reasons.setdefault(kind, {})[name] = reason(fault)
            return
        for half in (items[:len(items) // 2], items[len(items) // 2:]):
            try:
                self.answer = self.attempt(asking(self.scene, [*self.kept, *half]))
                self.kept += half
            except (ConstructionError, Refused, SingularPose) as smaller:
                self.add(half, smaller)


def reason(fault: GraphplanError) -> str:
    """Why there is no answer, without what to do about it."""
    match fault:
        case ConstructionError():
            return f"{fault.drawing}: {fault.why}"
        case Refused() | SingularPose():
            return fault.why
    return str(fault)
