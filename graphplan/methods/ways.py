"""The plan of a scene: the ways through the links of its motion, and how its forces are passed on."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner

if TYPE_CHECKING:
    from graphplan.methods.forces.groups import ForceTransfer

MOST_PLANNED = 64  # through the rings of a scene that are planned
Choice = tuple[int, ...]  # which of several ways on is taken, place by place


class Plan:
    """In which order a scene is drawn by a method, or by those of velocities and of accelerations: the ways through the
    links of its motion, each planned once, and how its forces are passed on."""

    def __init__(self, scene: Scene, method: str = ""):
        self.scene, self.methods, self.network = scene, Design(method=method).methods, Network(scene)
        self._planned = dict[Choice, tuple[Planner, Refused | None]]()

    def way_by(self, choice: Choice = ()) -> Planner:
        """The way with these choices; fails with `Refused`, naming the links, where it does not reach them."""
        planner, refused = self._plan(choice)
        if refused:
            raise refused
        return planner

    @property
    def general_way(self) -> Planner:
        """The first way through the links as they lie in most poses, not as they happen to lie in this one."""
        way, refused = self._go((), general=True)
        if refused:
            raise refused
        return way

    @cached_property
    def forces(self) -> ForceTransfer | None:
        """Transfer of forces; None for a scene without loads, which needs no import."""
        if self.scene.loads is None:
            return None
        from graphplan.methods.forces.groups import ForceTransfer

        return ForceTransfer(self.scene)

    def all_ways(self) -> Iterator[Planner]:
        """The ways that reach all links, the first one first: each in turn gives those that differ from it at one
        place, and after them such as did not reach all."""
        first = self._plan(())
        known, waiting = {first[0].choices}, deque([first])
        if not first[1]:
            yield first[0]
        while waiting and len(known) < MOST_PLANNED:
            way, _ = waiting.popleft()
            for choice in _neighbours(way):
                planner, refused = self._plan(choice)
                if planner.choices in known:
                    continue
                known.add(planner.choices)
                waiting.append((planner, refused))
                if not refused:
                    yield planner

    def _plan(self, choice: Choice) -> tuple[Planner, Refused | None]:
        """A way as far as it comes, and why it does not come further."""
        if choice not in self._planned:
            self._planned[choice] = self._go(choice)
        return self._planned[choice]

    def _go(self, choice: Choice, *, general: bool = False) -> tuple[Planner, Refused | None]:
        """A way as it is planned: where velocities have another method than accelerations, the choices that these leave
        are theirs."""
        velocities, accelerations = self.methods
        way = Planner(self.network, accelerations, choice, general)
        try:
            way.plan()
            if velocities != accelerations:
                way.of_velocities = Planner(self.network, velocities, choice[len(way.options):], general)
                way.of_velocities.plan()
        except Refused as refused:
            return way, refused
        finally:
            if way.of_velocities is not way:
                way.options += way.of_velocities.options
        return way, None


def _neighbours(way: Planner) -> Iterator[Choice]:
    """The choices that differ from a way's at one place: the next at each place, the last place first, and so on; where
    a choice is rare last of all."""
    options, taken = way.options, way.choices
    for rare in (False, True):
        places = [place for place in reversed(range(len(options))) if options[place].rare == rare]
        for step in range(1, max((options[place].ways for place in places), default=0)):
            for place in places:
                if step < options[place].ways:
                    yield (*taken[:place], (taken[place] + step) % options[place].ways)


def first_drawable(plan: Plan, design: Design,
                   by: Callable[[Plan, Planner, Design], Construction]) -> Construction:
    """The construction by the first way that has numbers in this pose; by the first way if no way has any."""
    first = None
    for way in plan.all_ways():
        drawing = by(plan, way, design)
        first = first or drawing
        if drawing.has_numbers:
            return drawing
    return first or by(plan, plan.way_by(), design)
