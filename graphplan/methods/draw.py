"""From a plan, a way through it and a design to a construction: no design is chosen here, and nothing is drawn again.

A lever's assumed motion goes the first way that can be drawn; forms of compounds are those that serve in the pose.
"""

from __future__ import annotations

from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.motion.planner import Planner
from graphplan.methods.ways import Plan


def draw(plan: Plan, way: Planner, design: Design) -> Construction:
    """Draw the construction by one way and design, even if it has no numbers in this pose.

    Fails with `Refused` where what is asked, or a force, is not reached.
    """
    if plan.forces is None:
        return Draughtsman(plan.scene, way, design).draw()
    from graphplan.methods.forces.loaded import Loaded

    return Loaded(plan.scene, way, design, plan.forces).draw()
