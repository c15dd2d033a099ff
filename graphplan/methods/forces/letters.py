"""The letters of reactions: R_12 is the force of link 1 on link 2, and 0 is the frame."""

from __future__ import annotations

from graphplan.mechanism.model import FRAME, Scene


def pair_letter(one: str, other: str) -> str:
    """The letter of the force of one link on another."""
    names = ["0" if name == FRAME else name for name in (one, other)]
    return "R_" + ("" if all(len(name) == 1 for name in names) else ",").join(names)


def reaction_letter(scene: Scene, point: str, link: str) -> str:
    """The letter of the force on a link at a joint: from the other link there, or from the pin of several."""
    pin, *others = scene.links_of[point]
    return pair_letter(others[0] if link == pin and len(others) == 1 else pin if link != pin else point, link)
