"""Slides that bear on a length, over the cycle: in which poses both edges press, decided pose by pose.

A slide is pressed at both edges where its reaction lies beyond the length on which it bears: where the couple by half
the length is larger than the force square to the guide. Then its force passes where the friction angles of both edges
meet, which changes the couple in turn; so each pose is drawn as the last round says, until nothing changes (Ozols 1974,
12-2, figs. 12-6 and 12-7; methods A37 and A38).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.loads import guide_direction
from graphplan.cycle.turn import RangeOfMotion, Turn
from graphplan.errors import Refused
from graphplan.machines.reduced.unit_motion import Draw, Recordings, Results
from graphplan.machines.tolerances import EDGE_TOL
from graphplan.mechanism.model import Number, Scene, Slide
from graphplan.mechanism.units import METRES
from graphplan.methods import kinds
from graphplan.phrases import said

FORCE, MOMENT = (kinds.WITH_FRICTION[kind] for kind in (kinds.SLIDE_REACTION, kinds.SLIDE_MOMENT))
PRESSED_ROUNDS = 8


class PressedRecordings(Recordings):
    """The constructions of a scene over its motion, drawn as its slides are pressed in each pose: `by_state` those in
    which some are pressed at both edges, by the side of each slide."""

    def __init__(self, scene: Scene, motion: RangeOfMotion, draw: Draw, compiled: bool = False):
        super().__init__(scene, motion, draw, compiled)
        self.by_state: dict[tuple[int, ...], Recordings] = {}

    def evaluate(self, turn: Turn, wanted: Collection[str] | None = None, gaps: bool = False,
                 **given: Mapping[str, Array]) -> Results:
        """The results in the poses of a turn, as :meth:`Recordings.evaluate` gives them.

        Fails with `Refused` where it cannot be decided which edges press.
        """
        sleeves = [*pressable_slides(self.scene)]
        results = super().evaluate(turn, wanted, gaps, **given)
        if not sleeves:
            return results
        drawn = np.zeros((len(sleeves), len(turn.travel)), dtype=int)
        for _ in range(PRESSED_ROUNDS):
            sides = np.array([self._sides(slide, length, results, turn, before)
                              for (slide, length), before in zip(sleeves, drawn, strict=True)])
            changed = np.flatnonzero((sides != drawn).any(axis=0))
            if not changed.size:
                return results
            for state in np.unique(sides[:, changed], axis=1).T.tolist():
                here = changed[np.all(np.equal(sides[:, changed].T, state), axis=1)]
                self._redraw(state, here, results, turn, wanted, gaps, given)
            drawn = sides
        raise Refused("friction", said("it cannot be decided which edges of its slides press"),
                      "[[friction]] without length")

    def _redraw(self, state: list[int], here: Array, results: Results, turn: Turn, wanted: Collection[str] | None,
                gaps: bool, given: Mapping[str, Mapping[str, Array]]) -> None:
        """Take the results of some poses from the constructions of a state."""
        names = [slide.name for slide, _ in pressable_slides(self.scene)]
        assert self.scene.loads is not None
        loads = replace(self.scene.loads, pressed={name: side for name, side in zip(names, state, strict=True) if side})
        recordings = self.by_state.setdefault(tuple(state), Recordings(replace(self.scene, loads=loads), self.motion,
                                                                      self.draw, self.compiled))
        part = replace(turn, travel=turn.travel[here], points={name: z[here] for name, z in turn.points.items()},
                       guides={name: z[here] for name, z in turn.guides.items()}, faults={})
        more = {name: {key: z[here] for key, z in values.items()} for name, values in given.items()}
        for kind, named in recordings.evaluate(part, wanted, gaps, **more).items():
            for name, z in named.items():
                results[kind][name][here] = z

    def _sides(self, slide: Slide, length: Number, results: Results, turn: Turn, before: Array) -> Array:
        """On which side of the guide the friction angles meet, in each pose; 0 where one side bears the slide. Where
        the reaction passes through an edge itself both are the same, and it stays as it was `before`."""
        couple, normal = couple_and_normal(self.scene, slide, length, results, turn)
        back = np.conj(guide_direction(slide, turn.points, turn.guides))
        slip = (back * results[kinds.SLIDE_VELOCITY][slide.name]).real
        edge = np.abs(normal) * np.where(before, 1 - EDGE_TOL, 1 + EDGE_TOL)
        return np.where(np.abs(couple) > edge, np.sign(slip * couple), 0).astype(int)


def pressable_slides(scene: Scene) -> Iterator[tuple[Slide, Number]]:
    """The slides that bear on a length, each with it."""
    lengths = {frozenset(friction.links): friction.length for friction in scene.loads.frictions
               if friction.length and friction.coefficient} if scene.loads else {}
    for slide in scene.slides:
        if length := lengths.get(frozenset(slide.links)):
            yield slide, length


def couple_and_normal(scene: Scene, slide: Slide, length: Number, found: Results, turn: Turn) -> tuple[Array, Array]:
    """The couple of a slide by half the length on which it bears, and its force square to the guide, in forces of the
    scene."""
    back = np.conj(guide_direction(slide, turn.points, turn.guides))
    couple = found[MOMENT][slide.name] * 2 / (float(length) * float(METRES[scene.units.length]))
    return couple, (back * found[FORCE][slide.name]).imag
