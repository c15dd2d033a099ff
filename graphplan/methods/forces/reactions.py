"""What force plans tell each other: the reactions found so far, their letters, and the arrows that show them.

R_12 is the force of link 1 on link 2, and 0 is the frame.
"""

from __future__ import annotations

from dataclasses import dataclass

from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Balance, Scene, Slide
from graphplan.methods.forces.loading import Acting
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import said

Span = tuple[Mark, Mark]
Pair = tuple[Acting, Acting]


def signed(span: Span, sign: int) -> Span:
    """A force as (tail, head), or its answer."""
    return span if sign > 0 else (span[1], span[0])


def signed_pair(pair: Pair, sign: int) -> Pair:
    """A couple as a pair of forces, or its answer."""
    return pair if sign > 0 else (pair[0].reversed, pair[1].reversed)


@dataclass
class Known:
    """What is drawn of a site's force: `part`, the part across its line if there is one, as (tail, head); its line of
    action through the mark `at`; and `pair`, the known couple besides. A couple has no line."""

    part: Span | None
    line: Mark | None
    at: Mark | None
    pair: Pair | None = None

    @property
    def acting(self) -> Mark:
        """Its line of action."""
        assert self.line is not None
        return self.line


@dataclass(frozen=True)
class Shown:
    """A force that is drawn as an arrow: load, reaction, balance or part (of a reaction); and its letter.

    It is drawn where its head is needed; or, if it only repeats another force, where the head `of` that one is.
    """

    kind: str
    label: str
    tail: Mark
    head: Mark
    of: Mark | None = None


def applied(board: Board, force: Acting) -> Shown:
    """A load drawn where it acts, on the mechanism plan."""
    with board.on(MECHANISM):
        why = said("{0}, where it acts", force.name)
        head = board.transfer(force.tail, force.head, force.at, why=why)
        return Shown("load", force.name, force.at, head, force.head)


class DrawnForces:
    """Reactions drawn so far, of all groups: for each joint and link, each slide, each balance; and all arrows.

    `number` is that of the round of friction, 0 without; `before` are the forces of the round before.
    """

    def __init__(self, scene: Scene, before: DrawnForces | None = None) -> None:
        self.scene = scene
        self.shown: list[Shown] = []
        self.corners: int = before.corners if before else 0
        self.number: int = before.number + 1 if before else 0
        self.joints: dict[tuple[str, str], Span] = {}
        self.slides: dict[Slide, Span] = {}
        self.pairs: dict[Slide, Pair | None] = {}
        self.seats: dict[Slide, Mark] = {}
        self.balances: dict[Balance, Span] = {}
        self.moments: dict[Balance, Pair | None] = {}


def reaction_on(forces: DrawnForces, board: Board, point: str, link: str) -> Span:
    """The force on a link, the frame among them, at a joint."""
    if (point, link) in forces.joints:
        return forces.joints[point, link]
    spans = [forces.joints[point, other][::-1] for other in forces.scene.links_of[point] if other != link]
    first, mark = spans[0]
    for tail, head in spans[1:]:
        mark = board.transfer(tail, head, mark)
    return first, mark


def pair_letter(one: str, other: str) -> str:
    """The letter of the force of one link on another."""
    names = ["0" if name == FRAME else name for name in (one, other)]
    return "R_" + ("" if all(len(name) == 1 for name in names) else ",").join(names)


def reaction_letter(scene: Scene, point: str, link: str) -> str:
    """The letter of the force on a link at a joint: from the other link there, or from the pin of several."""
    pin, *others = scene.links_of[point]
    return pair_letter(others[0] if link == pin and len(others) == 1 else pin if link != pin else point, link)
