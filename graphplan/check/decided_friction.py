"""Which pairs stand still, so that nothing rubs in them, and whether friction can be had: it may lock the mechanism."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from graphplan.check.arithmetics import FLOATS, bounded_rates, enclose_scene, enclosures
from graphplan.errors import GraphplanError, SingularPose
from graphplan.kernel.faithful import has_flint
from graphplan.mechanism.model import Scene
from graphplan.mechanism.numbers import dot
from graphplan.solver import solve
from graphplan.solver.rates import reach

ROOTS = "fractions do not hold friction in journals: the size of a reaction is a root; leave out --exact"
TEETH = "fractions do not hold the losses of teeth as they are drawn, by a circle; leave out --exact"
NORMALS = "fractions do not hold the resistance to rolling {0}: the length of its normal is a root; leave out --exact"
REPEATING = "statically indeterminate: friction depends on forces that equilibrium does not tell"


def decide_friction(scene: Scene, exact: bool = False) -> tuple[Scene, str]:
    """The scene with the names of its pairs that stand still, where some could rub. Where its forces with friction
    cannot be had, the scene without its friction, and the reason."""
    loads = scene.loads
    if loads is None or not loads.frictions or not any(drive.rate for drive in scene.drives):
        return scene, ""
    from graphplan.solver.friction import pressed_slides, with_friction
    from graphplan.solver.statics import required_loads

    smooth = replace(scene, loads=replace(loads, frictions=()))
    if exact and any(friction.at and friction.coefficient * friction.radius for friction in loads.frictions):
        return smooth, ROOTS if _journals_bear(smooth, {friction.at for friction in loads.frictions}) else ""
    if exact and any(friction.gear and friction.coefficient for friction in loads.frictions):
        return smooth, TEETH
    rolling = {frozenset(friction.links) for friction in loads.frictions if friction.rolling and friction.coefficient}
    for contact in scene.contacts if exact else ():
        normal = contact.normal(scene.points)
        if frozenset(contact.links) in rolling and isinstance(reach(dot(normal, normal)), float):
            return smooth, NORMALS.format(contact.name)
    if scene.repeating:
        return smooth, REPEATING
    with suppress(GraphplanError, ArithmeticError):
        scene = replace(scene, loads=replace(loads, resting=_resting_pairs(scene)))
    try:
        standing = with_friction(scene, loads.rounds, exact)
    except SingularPose as singular:
        return smooth, singular.why
    return replace(scene, loads=replace(required_loads(scene), pressed=pressed_slides(standing))), ""


def _journals_bear(smooth: Scene, journals: set[str]) -> bool:
    """Whether any of these joints bears a force without friction; where none does, friction makes none."""
    from graphplan.solver.statics import reactions

    try:
        forces = reactions(smooth, exact=True)
    except SingularPose:
        return True
    return any(any(force) for (point, _), force in forces.joints.items() if point in journals)


def _resting_pairs(scene: Scene) -> frozenset[str]:
    """The names of the pairs that stand still."""
    from graphplan.solver.friction import resting

    if not scene.irrational:
        return resting(solve(scene, exact=True), lambda speed: not speed)
    by = enclosures() if has_flint() else FLOATS
    with by.working():
        return resting(bounded_rates(enclose_scene(scene, by), by), lambda speed: by.lift(speed).overlaps(by.lift(0)))
