"""The forces of one pose as they are drawn: Zhukovsky's lever of a reduction, and force polygons with friction.

The moment on the driven link, or of a sliding drive the force along its guide, that keeps the lever in balance is the
opposite of the reduced one. All drives go in pace at a unit rate of the first, so one lever has the power of all
(Ozols 1974, 13-3; method A2). Without accelerations masses have their weights alone. Pairs that never move rub nowhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.kernel.program import Mark
from graphplan.machines.reduced.reduced_loads import UnitMotion, UnitRates, moving_points
from graphplan.machines.tolerances import DEAD_POINT_TOL
from graphplan.mechanism.model import FRAME, Balance, Find, Loads, Scene
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.draw import draw
from graphplan.methods.forces.free_bodies import Shown
from graphplan.methods.forces.groups import pairs
from graphplan.methods.forces.lever import Lever
from graphplan.methods.forces.loaded import force_arrows
from graphplan.methods.forces.loading import Loading, force_scale
from graphplan.methods.motion.acceleration import Normal
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import JointForce, LeverPlan, balance_letter
from graphplan.methods.ways import Plan, first_drawable


class LeverDraughtsman(Draughtsman):
    """Draws the velocities of one scene, and one lever with all its loads."""

    def finish(self, velocity: Velocity, plan: Normal | None) -> Construction:
        """The velocities with the lever, and what it tells: the balance on the first drive."""
        phi = force_scale(self.scene)
        loading = Loading(self.board, self.net, self.pose, phi, self.tempo.unit, None)
        (name, balance), = loading.loads.named_balances.items()
        lever = Lever(velocity, loading, LeverPlan.of_part(), {}, balance_letter(balance))
        marks = self.balancing_marks(lever)
        self.read(kinds.balance_kind(kinds.BY_LEVER, balance), name, *marks)
        arrows = force_arrows(self.board, self.marks, [*lever.shown, Shown("balance", lever.letter, *marks[-2:])])
        self.design = replace(self.design, phi=phi)
        return replace(super().finish(velocity, plan), force_arrows=arrows)

    def balancing_marks(self, lever: Lever) -> tuple[Mark, ...]:
        """The moment on the link that turns, or the force on the one that slides, which balances all loads."""
        drive = self.scene.drives[0]
        if not drive.slides:
            return lever.turning(*drive.links)
        slide = self.scene.driven_slide(drive)
        return lever.force_across(slide.at, *drive.links)


def lever_drawing(scene: Scene, loads: Loads) -> Construction:
    """The lever of these loads in the pose of a scene that moves at a unit rate, by the first way
    that can be drawn.

    Its velocities are those of the points at which loads act.
    """
    drive = scene.drives[0]
    slide = scene.driven_slide(drive) if drive.slides else None
    balance = Balance(drive.link, slide.at, slide.direction) if slide else Balance(drive.link)
    acting = (*(force.at for force in loads.forces), *(mass.centre for mass in loads.masses.values()))
    find = Find(moving_points(scene, acting), (), (), (), ())
    with_balance = replace(scene, loads=replace(loads, balances=(balance,), frictions=()), find=find)
    return first_drawable(Plan(with_balance), Design("orthogonal"),
                          lambda plan, way, design: LeverDraughtsman(plan.scene, way, design).draw())


# ---- force polygons with friction -----------------------------------------------------------------------------------


def rubbed_drawing(scene: Scene, method: str = "") -> Construction:
    """The polygons of a scene with friction, by the first way of its motion that can be drawn, by a method if one is
    named."""
    return first_drawable(Plan(scene, method), Design("orthogonal,polygons", inertia="couple"), draw)


def with_resting_pairs(scene: Scene, motion: UnitMotion, travel: Array) -> Scene:
    """The scene with the names of the journals and slides that stand still at all of these travels."""
    assert scene.loads is not None
    slides = tuple(slide.name for slide in scene.slides)
    whole = UnitMotion(scene, motion.motion, Find((), (), (), scene.moving, slides))
    rates = whole.velocities(whole.turn(travel))
    return replace(scene, loads=replace(scene.loads, resting=frozenset(_resting(scene, motion, rates))))


def _resting(scene: Scene, motion: UnitMotion, rates: UnitRates) -> Iterator[str]:
    for point, link, pin in pairs(scene):
        rate, pin_rate = (0.0 if name == FRAME else rates.rate(kinds.OMEGA, name) for name in (link, pin))
        if np.max(np.abs(rate - pin_rate), initial=0.0) <= DEAD_POINT_TOL:
            yield JointForce(point, link).name
    reach = scene.extent * motion.metres if motion.turns else 1.0
    for slide in scene.slides:
        if np.max(np.abs(rates.rate(kinds.SLIDE_VELOCITY, slide.name)), initial=0.0) <= DEAD_POINT_TOL * reach:
            yield slide.name
