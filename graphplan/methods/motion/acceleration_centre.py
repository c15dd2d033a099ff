"""Acceleration centres: the point Q of a link that has no acceleration in this pose.

The ends of the accelerations of a link's points, laid off from one pole pi, form a figure similar to the link's, and
with its sense. So Q is to A and B as pi is to the ends of a_A and a_B: the triangle on AB that is similar to a'b'pi has
its third corner in Q. A link with a fixed pivot has Q in it.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.program import Board, Mark
from graphplan.kernel.stages import Stage
from graphplan.mechanism.model import FRAME
from graphplan.methods.assembly import Pose
from graphplan.methods.motion.curvature import point_pairs
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.panels import MECHANISM, link_named
from graphplan.phrases import said

SIMILAR_FIGURE = said("the ends of the accelerations of a link's points, from one pole, form a figure similar to the "
                      "link's: its point without acceleration lies as the pole does")


def draw_acceleration_centre(board: Board, pose: Pose, accelerations: Callable[[], MotionPlan], link: str) -> Mark:
    """The acceleration centre of a link, on the mechanism plan.

    Fails with `Refused` where all points of the link have the same acceleration: it shifts, and there is no centre.
    Source: Ozols 1974, 9-2, fig. 9-4d.
    """
    scene = pose.scene
    if pivot := next((point for point in scene.links[link] if FRAME in scene.links_of[point]), ""):
        return pose.points[pivot]
    for A, B in point_pairs(scene, link):
        with suppress(ConstructionError):
            return _similar_triangle(board, pose, accelerations(), link, (A, B))
    raise Refused(link_named(link), said("all its points have the same acceleration"), "a link that turns")


def _similar_triangle(board: Board, pose: Pose, plan: MotionPlan, link: str, points: tuple[str, str]) -> Mark:
    """Q over two points of the link, as the pole lies to the ends of their accelerations."""
    A, B = (pose.points[name] for name in points)
    stage = Stage(said("Acceleration centre of {0}", link_named(link)), SIMILAR_FIGURE)
    with board.on(plan.panel, (link,), stage):
        (pi, a), (start, end) = (plan.vector(link, name) for name in points)
        b = end if start is pi else board.transfer(start, end, pi, name=f"{points[1]}'")
    with board.on(MECHANISM, (link,), stage):
        return board.triangle(a, b, pi, A, B, name=f"Q_{link}")
