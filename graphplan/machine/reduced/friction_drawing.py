"""The force polygons of a machine with friction, and which of its pairs never move."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.machine.reduced.unit_motion import Rates, UnitMotion
from graphplan.machine.tolerances import DEAD_POINT_TOL
from graphplan.mechanism.model import FRAME, Find, Scene
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.forces.groups import ForceTransfer, pairs
from graphplan.methods.forces.loaded import Loaded
from graphplan.methods.motion.alternatives import ways
from graphplan.methods.motion.network import Network
from graphplan.methods.panels import JointForce
from graphplan.methods.styles import Style


def rubbed_drawing(scene: Scene, method: str = "") -> Construction:
    """The polygons of a scene with friction, drawn by the best way of its motion, by a method if one is named."""
    plans = ForceTransfer(scene)
    return next(ways(Network(scene), method, lambda planner: Loaded(
        scene, planner, Style(lever=False), plans).draw()))[0]


def with_resting_pairs(scene: Scene, motion: UnitMotion, travel: Array) -> Scene:
    """The scene with the names of the journals and slides that stand still at all of these travels."""
    assert scene.loads is not None
    slides = tuple(slide.name for slide in scene.slides)
    whole = UnitMotion(scene, motion.motion, Find((), (), (), scene.moving, slides))
    rates = whole.velocities(whole.turn(travel))
    return replace(scene, loads=replace(scene.loads, resting=frozenset(_resting(scene, motion, rates))))


def _resting(scene: Scene, motion: UnitMotion, rates: Rates) -> Iterator[str]:
    for point, link, pin in pairs(scene):
        one, other = (0.0 if name == FRAME else rates.of(kinds.OMEGA, name) for name in (link, pin))
        if np.max(np.abs(one - other), initial=0.0) <= DEAD_POINT_TOL:
            yield JointForce(point, link).name
    reach = scene.extent * motion.metres if motion.turns else 1.0
    for slide in scene.slides:
        if np.max(np.abs(rates.of(kinds.SLIDE_VELOCITY, slide.name)), initial=0.0) <= DEAD_POINT_TOL * reach:
            yield slide.name
