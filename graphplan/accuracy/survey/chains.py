"""Chains of any length: a crank and dyads, each between a pivot of the frame and the joint of the dyad before.

All rockers are of one length and stand aslant by turns to the right and to the left, so that all turn equally fast:
velocities neither die away along the chain nor grow.
"""

from __future__ import annotations

from fractions import Fraction

from graphplan.mechanism.model import FRAME, Find, Pair, Scene, TurningDrive, Units

ACROSS, UP, PITCH = 3, 4, 10  # of a rocker; from one pivot to the next


def chain(dyads: int) -> Scene:
    """A crank and so many dyads: twice as many links, and the crank and the frame. All joints are asked for."""
    points: dict[str, Pair] = {}
    links: dict[str, tuple[str, ...]] = {}
    for k in range(dyads + 1):
        across = -ACROSS if k % 2 else ACROSS
        points[f"R{k}"] = Fraction(PITCH * k), Fraction(0)
        points[f"P{k}"] = Fraction(PITCH * k + across), Fraction(UP)
        if k:
            links[f"{2 * k}"] = f"P{k - 1}", f"P{k}"
        links[f"{2 * k + 1}"] = f"R{k}", f"P{k}"
    links[FRAME] = tuple(f"R{k}" for k in range(dyads + 1))
    joints = tuple(f"P{k}" for k in range(dyads + 1))
    return Scene(
        title=f"Chain of {2 * dyads + 2} links", source="", name=f"chain of {2 * dyads + 2} links", units=Units(),
        points=points, placements={}, links=links, motions={}, find=Find(joints, joints),
        written=(TurningDrive("1", FRAME, Fraction(1), Fraction(0)),),
    )
