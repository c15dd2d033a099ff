"""Friction in a governor: the forces on its balls at which it moves outwards and inwards, and what it holds in between.

Without friction a force C on the balls holds a position. With it they move outwards only at C'' > C and inwards only at
C' < C; between the speeds omega'' and omega' of both the sleeve stands still, and nu = (omega'' - omega')/omega is
the degree of insensitivity. C'' and C' are those at which the force polygons with friction circles and leaning guides
give a drive that moves the governor outwards or inwards nothing to do: sought by secants, all positions at once.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 15-5, (15.35) and fig. 15-16; method A21.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.errors import Refused
from graphplan.machines.reduced.force_drawings import rubbed_drawing
from graphplan.machines.reduced.friction import FRICTION_ROUNDS, FrictionOverCycle, weights_alone, with_rounds
from graphplan.machines.reduced.pressed_slides import PressedRecordings
from graphplan.machines.reduced.reduction import Reduction
from graphplan.machines.tolerances import BALANCE_TOL
from graphplan.mechanism.model import Force, LoadTable, Scene
from graphplan.mechanism.order import named_forces
from graphplan.mechanism.travel import travel_text
from graphplan.mechanism.units import NEWTONS
from graphplan.methods import kinds
from graphplan.phrases import said

SECANT_ROUNDS = 12
FIRST_STEP = 0.02  # of C, to a second value beside it


class FrictionBand(NamedTuple):
    """The forces on all balls in N, or the speeds in rad/s, at which they move outwards and inwards: arrays of shape
    (n,)."""

    outwards: Array
    inwards: Array


@dataclass(frozen=True, eq=False)
class GovernorFriction:
    """The friction of a governor: that of its pairs while it moves in the sense of its first drive, and against it.

    `shares` has what each ball bears of C by the name of its force, and `across` the unit vectors along which.
    """

    rubbing: FrictionOverCycle
    backwards: PressedRecordings
    shares: Mapping[str, float]
    across: Mapping[str, complex]

    @property
    def scenes(self) -> tuple[Scene, Scene]:
        """The scene as it moves in the sense of the first drive, and against it."""
        return self.rubbing.scene, self.backwards.scene

    def other_loads(self, travel: Array) -> dict[str, Array]:
        """The loads that change but those on the balls, at some travels."""
        turn = self.rubbing.motion.turn(travel)
        return self.rubbing.loads(travel, turn, self.rubbing.motion.velocities(turn))

    def acting(self, others: dict[str, Array], C: Array) -> dict[str, Array]:
        """These loads and a force C in N on all balls, in the scene's units."""
        newton = float(NEWTONS[self.rubbing.scene.units.force])
        return others | {name: C * share / newton * self.across[name] for name, share in self.shares.items()}

    def force(self, travel: Array, C: Array, along: bool) -> Array:
        """The force on all balls at some travels at which they move `along` with the first drive, or against it, where
        C holds them without friction. Fails with `Refused` where friction locks the governor at any force."""
        turn, recordings = self.rubbing.motion.turn(travel), self.rubbing.recordings if along else self.backwards
        others = self.other_loads(travel)

        def moment(force: Array) -> Array:
            found = recordings.evaluate(turn, loads=self.acting(others, force))
            return self.rubbing.drive_moment(found, turn, kinds.RUBBED)

        before, force = C, C * (1 + FIRST_STEP)
        moment_before, largest = moment(before), np.zeros(C.shape)
        for _ in range(SECANT_ROUNDS):
            value = moment(force)
            largest = np.maximum(largest, np.maximum(abs(value), abs(moment_before)))
            with np.errstate(all="ignore"):
                step = value * (force - before) / (value - moment_before)
            step = np.where(np.isfinite(step), step, 0.0)
            before, moment_before, force = force, value, force - step
            if np.all(abs(step) <= BALANCE_TOL**2 * abs(C)):
                break
        if locked := np.flatnonzero(~(abs(step) <= BALANCE_TOL * abs(C))).tolist():
            at = travel_text(self.rubbing.scene, float(travel[locked[0]]))
            raise Refused("friction", said("the mechanism locks itself at a travel of {0}", at), "less friction")
        return force


def governor_friction(scene: Scene, smooth: Reduction, balls: Mapping[str, tuple[str, complex, float]]
                      ) -> GovernorFriction:
    """The friction of a scene whose `smooth` reduction has none; `balls` have by their links the centre, the direction
    away from the axis and the share of the force."""
    loads = scene.loads
    assert loads is not None
    low, high = map(float, smooth.motion.in_scene_units(np.array(smooth.ends)))
    table = LoadTable("travel", ((low, 1), (high, 1)))
    forces = {link: Force(link, centre, (away.real, away.imag), table, (away.real, away.imag))
              for link, (centre, away, _) in balls.items()}
    loads = weights_alone(scene, loads)
    loaded = replace(scene, flywheel=None, loads=replace(loads, forces=(*loads.forces, *forces.values())))
    rubbing = FrictionOverCycle(loaded, smooth.motion, smooth.ends)
    assert loaded.loads is not None
    names = {force.on: name for name, force in named_forces(loaded.loads).items() if force in forces.values()}
    opposite = rubbing.scene.with_drives(drive.driven_at(-drive.rate, 0) for drive in rubbing.scene.drives)
    return GovernorFriction(rubbing, PressedRecordings(with_rounds(opposite, FRICTION_ROUNDS), smooth.motion.motion,
                                                       rubbed_drawing),
                            {names[link]: share for link, (_, _, share) in balls.items()},
                            {names[link]: away for link, (_, away, _) in balls.items()})
