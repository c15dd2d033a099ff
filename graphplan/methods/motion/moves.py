"""The moves of a plan: facts that travel through links and joints, and rings that are drawn by trial figures.

A move names bodies and places, not marks; the plans (velocity, acceleration) draw it. A locus is known by the place
whose end it carries and by its source: the body, slide or seed that gives it, or a name that the move itself gives.
"""

from __future__ import annotations

from collections.abc import Iterable
from copy import copy
from fractions import Fraction
from typing import NamedTuple, Protocol

from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import Slide
from graphplan.methods.motion.network import BodyPoint

Locus = tuple[BodyPoint, str]


class Rest(NamedTuple):
    """A point of the frame or of a link that a drive ties to it: its end is known."""

    place: BodyPoint


class Seed(NamedTuple):
    """A point whose motion the scene gives."""

    place: BodyPoint


class Swing(NamedTuple):
    """The body knows the end of K: the end of X lies on a line."""

    body: str
    K: BodyPoint
    X: BodyPoint
    source: str = ""


class Slip(NamedTuple):
    """The body's turning is known (that of `like`) and A has a locus: the end of X lies on the shifted locus."""

    body: str
    A: Locus
    X: BodyPoint
    like: str
    source: str = ""


class Carry(NamedTuple):
    """A and B of the body have loci: the end of X lies on a line, found by an auxiliary point or a trial figure."""

    body: str
    A: Locus
    B: Locus
    X: BodyPoint
    source: str = ""


class Settle(NamedTuple):
    """The body knows K, and X and B have loci: the end of X."""

    body: str
    K: BodyPoint
    X: Locus
    B: Locus


class SimilarFigure(NamedTuple):
    """The body is known, by the ends of K and R, or of K and the turning of `like`: the end of X.

    With `copy` it is entered there, to be compared with what else is known of X.
    """

    body: str
    K: BodyPoint
    X: BodyPoint
    R: BodyPoint | None = None
    like: str = ""
    copy: BodyPoint | None = None


class GuideLocus(NamedTuple):
    """The end of X is known in the plane of `known`: in the plane of `new` it lies on a line set by the guide."""

    slide: Slide
    point: str
    known: str
    new: str


class Roll(GuideLocus):
    """Locus by a rolling of two links on each other at X: the line of centres is the guide."""


class Common(NamedTuple):
    """Two links roll on each other at X: its end in the plane of `known` is its end in that of `new`."""

    slide: Slide
    point: str
    known: str
    new: str


class Meet(NamedTuple):
    """Two loci of one place meet in its end; with `copy` it is entered there, to be compared with a third."""

    place: BodyPoint
    sources: tuple[str, str]
    copy: BodyPoint | None = None


class Auxiliary(NamedTuple):
    """A and B of the body have loci: the auxiliary point where they cross, taken as a point of the body."""

    body: str
    A: Locus
    B: Locus
    place: BodyPoint


class Pole(NamedTuple):
    """Two bodies joined by two bars: the bars' intersection is a joint of both (Aronhold-Kennedy)."""

    bodies: tuple[str, str]
    bars: tuple[tuple[str, BodyPoint, BodyPoint], tuple[str, BodyPoint, BodyPoint]]
    place: BodyPoint


class Centre(NamedTuple):
    """The pole of a body relative to the frame, by the circle diagram: as a point of the body it is at rest."""

    body: str
    place: BodyPoint


class FalsePosition(NamedTuple):
    """False position: the end of a place is assumed on its locus, twice, and the moves are drawn for both; in the end
    `end` should lie on `locus` and does not; the third time it does."""

    at: Locus
    moves: tuple[Move, ...]
    end: BodyPoint
    locus: Locus


Move = (Rest | Seed | Swing | Slip | Carry | Settle | SimilarFigure | GuideLocus | Common | Meet | Auxiliary | Pole
        | Centre | FalsePosition)


STATE = "ends", "loci", "known", "_told", "pole_vectors", "parts"  # of a plan: what a trial figure may not pass on
TRIAL_RATIOS = Fraction(3, 10), Fraction(-2, 5)  # where trial figures stand on their locus, in lengths of a link


class TrialPlan(Protocol):
    """A plan as far as trial figures are concerned."""

    board: Board
    prime: str
    ends: dict[BodyPoint, Mark]
    loci: dict[Locus, Mark]

    def plan_origin(self, place: BodyPoint) -> Mark: ...
    def assume(self, place: BodyPoint, locus: Mark, ratio: Fraction) -> Mark: ...
    def end_name(self, place: BodyPoint) -> str: ...
    def know(self, place: BodyPoint, mark: Mark) -> None: ...
    def draw(self, planned: Iterable[Move]) -> None: ...


def draw_false_position(plan: TrialPlan, move: FalsePosition) -> None:
    """Two trial figures, the false position, then the true figure by the same moves."""
    place, locus = move.at[0], plan.loci[move.at]
    trials, outer = list[Mark](), plan.prime
    before = {name: getattr(plan, name) for name in STATE}
    for prime, ratio in zip(("'", "''"), TRIAL_RATIOS, strict=True):
        for name, drawn in before.items():
            setattr(plan, name, copy(drawn))  # nothing of another trial serves
        plan.prime = outer + prime
        start = plan.assume(place, locus, ratio)
        plan.know(place, plan.board.give_name(start, plan.end_name(place) + plan.prime))
        plan.draw(move.moves)
        trials += [start, plan.ends[move.end], plan.loci[move.locus]]
    plan.prime = outer
    for name, drawn in before.items():
        setattr(plan, name, drawn)
    A1, Z1, l1, A2, Z2, l2 = trials
    true = plan.board.false_position(A1, A2, Z1, l1, Z2, l2, name=plan.end_name(place) + plan.prime)
    plan.know(place, true)
    plan.draw(move.moves)
