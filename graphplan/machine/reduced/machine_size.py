"""How large a machine is: its inertia and the moments that its loads could have, beside which a number may be zero.

Rounding is no measure of itself: the moment of a weight that moves across gravity is some 1e-16 of what the weight
could do, and the work of that moment, over a cycle, is as much of itself as it happens to be.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from graphplan.mechanism.model import Force, Moment, Scene
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS


class MachineSize(NamedTuple):
    """The reduced inertia (kg m^2) and moment (N m) if all masses and loads moved as fast as the mechanism's reach, and
    the inertia's change by a unit of travel; of a sliding drive in kg and N."""

    inertia: float
    moment: float
    slope: float


def machine_size(scene: Scene) -> MachineSize:
    """The size of a scene's machine."""
    loads, units, turns = scene.loads, scene.units, not scene.drives[0].slides
    assert loads is not None
    metres = float(METRES[units.length])
    unit = 1.0 if turns else metres  # of travel, in SI
    arm = scene.extent * metres if turns else 1.0
    masses = [float(m.mass) * arm**2 + float(m.inertia) / unit**2 for m in loads.masses.values()]
    weights = [float(m.mass) * math.hypot(*map(float, loads.gravity)) * arm for m in loads.masses.values()]
    forces = [_largest(load) * arm for load in loads.forces] + [_largest(load) / unit for load in loads.moments]
    kilogram, newton = float(KILOGRAMS[units.mass]), float(NEWTONS[units.force])
    inertia = kilogram * sum(masses)
    return MachineSize(inertia, kilogram * sum(weights) + newton * sum(forces), inertia / unit)


def _largest(load: Force | Moment) -> float:
    """The largest value of a load: of a table that of its rows."""
    here = math.hypot(*map(float, load.value)) if isinstance(load, Force) else abs(float(load.value))
    rows = load.table.rows if load.table else ()
    return max([here, *(abs(float(value)) for _, value in rows)])
