"""Screws on the drawing board: the developed thread is an inclined plane, on which the axial force leans.

The thread rises by the lead on the circumference of its mean radius, so it is inclined by the lead angle alpha. The
force of the screw leans from its normal by the friction angle phi against the sliding: its part around the axis is
Q tan(alpha + phi) where the screw drives, Q tan(alpha - phi) where the load does, and acts at the mean radius (Ozols
1974, 12-3, figs. 12-9 and 12-10). A positive moment drives the first link along the guide's direction.
"""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.methods import kinds
from graphplan.methods.forces import stages
from graphplan.methods.forces.free_bodies import DrawnForces, Shown, with_sign
from graphplan.methods.forces.groups import Result, moment_marks
from graphplan.methods.forces.loading import Acting, Loading
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import MECHANISM, slide_named
from graphplan.phrases import said


def screw_moments(velocity: Velocity, loading: Loading, forces: DrawnForces) -> Iterator[Result]:
    """The moments on the screws through which balances act, drawn from these."""
    board, pose = loading.board, loading.pose
    for balance, span in forces.balances.items():
        screw = loading.loads.screw_of(balance)
        if screw is None:
            continue
        slide = next(slide for slide in loading.scene.slides if slide.links == screw.links)
        tail, head = with_sign(span, 1 if balance.link == slide.link else -1)
        stage, why = stages.screw(slide), said("the mean radius of the thread")
        rise, rubs = said("the thread rises by tan alpha"), said("the friction of the screw {0}", slide_named(slide))
        with board.on(MECHANISM, slide.links, stage):
            B, axis = pose.points[slide.at], pose.guide(slide, run=True)
            A = board.lay_along(axis, B, length=screw.radius, why=why)
            around = board.perpendicular(axis, B)
            T = board.step_off(B, A, board.quarter(B, A, B), ratio=-screw.slope, why=rise)
            slip = velocity.slip(slide.along, slide.link, slide.at)
            leaning = board.lean(board.line(B, T), B, slip, tail, head, coefficient=screw.coefficient, why=rubs)
        with board.on(links=slide.links, stage=stage):
            tip = board.meet(board.perpendicular(leaning, tail), board.parallel(around, head))
        forces.shown.append(Shown("part", f"H_{slide.link}", head, tip))
        yield kinds.SCREW, slide.name, moment_marks(B, [Acting(A, head, tip)])
