"""What acts on the links besides each other: the given forces and moments, the weights and the inertia forces."""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Force, Loads, Mass, Moment, Number, Scene
from graphplan.mechanism.pairs.pair import Along, Rate
from graphplan.mechanism.plane import less, times
from graphplan.mechanism.units import inertia, metre, weight
from graphplan.solver.equations import Equations
from graphplan.solver.rates import Rates

Load = Force | Moment


def asked(scene: Scene) -> Loads:
    """The loads of the scene; fails with `Refused` where it has none."""
    if scene.loads is None:
        raise Refused("reactions", "the scene has no loads", "give it [[forces]], [[moments]] or [masses]")
    return scene.loads


def acting(scene: Scene, rates: Rates) -> tuple[Load, ...]:
    """Every load on a link, in the scene's units of force and force * m."""
    loads = asked(scene)
    own = (load for link, mass in loads.masses.items() for load in carried(scene, link, mass, rates))
    return (*loads.forces, *loads.moments, *own)


def carried(scene: Scene, link: str, mass: Mass, rates: Rates) -> Iterator[Load]:
    """By d'Alembert: weight and inertia force m g - m a_S at the centre of mass S, and the couple -I alpha."""
    weigh = times(weight(scene.units), asked(scene).gravity)
    resist = times(inertia(scene.units), rates.acceleration[mass.centre])
    yield Force(link, mass.centre, times(mass.mass, less(weigh, resist)))
    yield Moment(link, -weight(scene.units) * mass.inertia * rates.alpha[link])


def resultants(equations: Equations, loads: tuple[Load, ...]) -> list[Number]:
    """Of each moving link: its forces (x, y) added up and, in force * length, the moments about its base."""
    sums: list[Number] = [0] * equations.width
    for load in loads:
        k = equations.columns[load.on]
        sums[k : k + 3] = [a + b for a, b in zip(sums[k : k + 3], weights(equations, load), strict=True)]
    return sums


def weights(equations: Equations, load: Load) -> Rate:
    """A load's force (x, y) and, in force * length, its moment about its link's base: what each rate gives of power."""
    if isinstance(load, Moment):
        return Rate(0, 0, load.value * metre(equations.scene.units))
    return Along(load.on, FRAME, load.at, load.value, "held").weights(equations.arm(load.on, load.at))
