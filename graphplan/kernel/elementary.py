"""The elementary constructions: one movement with set squares or dividers, several with compasses and straightedge.

A compound's `forms` are the ways to draw it, in the order in which a textbook would try them; `s` is the board. A form
that needs a branch (which crossing of an arc, which side) stands once for each: the pose decides which of them gives
the right value. A form that is not for this pose gives nothing; where a vector has no length, nothing is drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from graphplan.kernel.kinds import COMPASSES, DIVIDERS, LINE, POINT, SCALE, SET_SQUARES, Movement, Sizing, primitive
from graphplan.kernel.primitives import dot, require_apart, vector
from graphplan.phrases import phrase

# ---- parallel and perpendicular: from a point that the line is known to pass through, or from any --------------------


def _known_points(s: Any, l: Any, P: Any) -> Any:
    return s.clear_of(P, s.points_on(l))


def _arbitrary_point(s: Any, l: Any, P: Any) -> Any:
    distance = s.clear_of(P)
    return None if distance is None else s.pick(l, P, distance, P, distance, ratio=0.25)


STARTS = (("", _known_points), (", from any point", _arbitrary_point))


def _erect_perpendicular(s: Any, l: Any, P: Any, X: Any, *, left: bool = True) -> Any:
    """The perpendicular through P, by the arc about P through X, a point of the line."""
    arc = s.circle(P, s.opening(P, X))
    D, E = s.line_meets_circle(l, arc, way="on"), s.line_meets_circle(l, arc, way="back")
    o = s.opening(D, E)
    d, e = s.circle(D, o), s.circle(E, o)
    ends = [s.circles_meet(e, d, side=side) for side in ("right", "left")]
    return s.line(*ends) if left else s.line(*reversed(ends))


def _arcs(start: Callable[..., Any], s: Any, l: Any, P: Any) -> Any:
    X = start(s, l, P)
    return None if X is None else _erect_perpendicular(s, l, P, X)


def _perpendicular_by_mirror(side: str, s: Any, l: Any, P: Any) -> Any:
    """The perpendicular through P and its mirror image, by arcs through P about two points of the line: they meet in P
    and, on the other side, in the image."""
    points = [] if s.side_of_line(l, P) == side or s.lies_on(P, l) else s.points_on(l)
    if len(points) < 2 or s.points_coincide(points[0], points[-1]):
        return None
    one, two = (s.circle(X, s.opening(X, P)) for X in (points[0], points[-1]))
    image = s.circles_meet(one, two, side=side)
    return s.line(image, P) if side == "right" else s.line(P, image)


def _rhombus(start: Callable[..., Any], side: str, s: Any, l: Any, P: Any) -> Any:
    """The rhombus on X and P, its fourth corner on the same side of the way from P as P is of the line."""
    X = start(s, l, P) if s.side_of_line(l, P) == side and not s.lies_on(P, l) else None
    if X is None:
        return None
    o = s.opening(X, P)
    Y = s.line_meets_circle(l, s.circle(X, o), way="on")
    return s.line(P, s.circles_meet(s.circle(P, o), s.circle(Y, o), side=side))


def _two_perpendiculars(s: Any, l: Any, P: Any) -> Any:
    across = s.perpendicular(l, P)
    X = _known_points(s, across, P)
    X = _arbitrary_point(s, across, P) if X is None else X
    return None if X is None else _erect_perpendicular(s, across, P, X, left=False)


@primitive((LINE, POINT), LINE, SET_SQUARES, "Through {1} draw {out} parallel to {0}.",
           claims=(("on", 1), ("parallel", 0)), movement=Movement.PARALLEL, afar=((0,),),
           described="the parallel to {0} through {1}",
           likewise={"": phrase("Likewise {out} through {1}, parallel to {0}.")}, forms={
               "the line itself": lambda s, l, P: l if s.lies_on(P, l) else None,
               **{f"rhombus on the {side}{words}": partial(_rhombus, start, side)
                  for words, start in STARTS for side in ("left", "right")},
               "two perpendiculars": _two_perpendiculars})
def parallel(d: Any, l: Any, P: Any) -> Any:
    """The parallel to a line through a point, running the same way."""
    return l[0], l[1], -(l[0] * P[0] + l[1] * P[1])


@primitive((LINE, POINT), LINE, SET_SQUARES, "Through {1} draw {out} perpendicular to {0}.",
           claims=(("on", 1), ("perpendicular", 0)), movement=Movement.PERPENDICULAR, afar=((0,),),
           described="the perpendicular to {0} through {1}",
           likewise={"": phrase("Likewise {out} through {1}, perpendicular to {0}.")}, forms={
               **{f"mirror image on the {side}": partial(_perpendicular_by_mirror, side) for side in ("right", "left")},
               **{"arcs" + words: partial(_arcs, start) for words, start in STARTS}})
def perpendicular(d: Any, l: Any, P: Any) -> Any:
    """The perpendicular to a line through a point, running a quarter turn counter-clockwise of it."""
    return -l[1], l[0], l[1] * P[0] - l[0] * P[1]


# ---- halves and feet -------------------------------------------------------------------------------------------------


def _draw_bisector(s: Any, P: Any, Q: Any) -> Any:
    o = s.opening(P, Q)
    p, q = s.circle(P, o), s.circle(Q, o)
    return s.line(s.circles_meet(p, q, side="right"), s.circles_meet(p, q, side="left"))


@primitive((POINT, POINT), LINE, COMPASSES, "Draw {out}, the perpendicular bisector of {0}{1}.",
           claims=(("halfway", 0, 1),), fails=("points-coincide",), movement=Movement.BISECTED,
           forms={"arcs": _draw_bisector})
def bisector(d: Any, P: Any, Q: Any) -> Any:
    """The perpendicular bisector of two points, running a quarter turn counter-clockwise of the first to the second."""
    u = require_apart(d, P, Q)
    return -u[0], -u[1], (u[0] * (P[0] + Q[0]) + u[1] * (P[1] + Q[1])) / 2


@primitive((POINT, POINT), POINT, COMPASSES, "Halve the distance from {0} to {1}: mark {out}.",
           claims=(("same", (0, -1), (-1, 1)),), movement=Movement.HALVED, forms={
               "one point": lambda s, P, Q: P if s.points_coincide(P, Q) else None,
               "arcs": lambda s, P, Q: s.meet(s.line(P, Q), s.bisector(P, Q))})
def midpoint(d: Any, P: Any, Q: Any) -> Any:
    """The point halfway between two points."""
    return (P[0] + Q[0]) / 2, (P[1] + Q[1]) / 2


@primitive((LINE, POINT), POINT, SET_SQUARES, "From {1} drop the perpendicular on {0}: mark its foot {out}.",
           claims=(("on", 0), ("upright", 0, 1)), movement=Movement.DROPPED, forms={
               "the point itself": lambda s, l, P: P if s.lies_on(P, l) else None,
               "perpendicular": lambda s, l, P: s.meet(l, s.perpendicular(l, P))})
def foot(d: Any, l: Any, P: Any) -> Any:
    """The foot of the perpendicular from a point to a line."""
    off = (l[0] * P[0] + l[1] * P[1] + l[2]) / (l[0] * l[0] + l[1] * l[1])
    return P[0] - l[0] * off, P[1] - l[1] * off


# ---- vectors and lines carried over ----------------------------------------------------------------------------------


def _with_dividers(turn: str) -> Callable[..., Any]:
    """The length taken along the parallel or the perpendicular to PQ."""
    return lambda s, P, Q, R: s.line_meets_circle(
        getattr(s, turn)(s.line(P, Q), R), s.circle(R, s.opening(P, Q)), way="on")


def _fourth_corner(side: str) -> Callable[..., Any]:
    """The parallelogram on PQ and PR by two arcs."""
    return lambda s, P, Q, R: s.circles_meet(s.circle(R, s.opening(P, Q)), s.circle(Q, s.opening(P, R)), side=side)


@primitive((POINT, POINT, POINT), POINT, DIVIDERS, "From {2} lay off the vector from {0} to {1}: mark {out}.",
           claims=(("same", (0, 1), (2, -1)),), movement=Movement.LAID_OFF, afar=((0, 1),),
           likewise={"": phrase("Likewise from {2}, {0} to {1}: {out}.")}, forms={
               "nothing to draw": lambda s, P, Q, R: R if s.points_coincide(P, Q) else Q if s.points_coincide(P, R)
               else None,
               "dividers": _with_dividers("parallel"),
               "parallelogram": lambda s, P, Q, R: s.meet(s.parallel(s.line(P, Q), R), s.parallel(s.line(P, R), Q)),
               "two arcs, left": _fourth_corner("left"),
               "two arcs, right": _fourth_corner("right")})
def transfer(d: Any, P: Any, Q: Any, R: Any) -> Any:
    """The vector PQ laid off from R."""
    return R[0] + (Q[0] - P[0]), R[1] + (Q[1] - P[1])


@primitive((POINT, POINT, POINT), POINT, DIVIDERS, "From {2} lay off the vector from {0} to {1}, turned a quarter "
           "counter-clockwise: mark {out}.", claims=(("quarter", (0, 1), (2, -1)),), movement=Movement.TURNED,
           afar=((0, 1),), forms={
               "nothing to turn": lambda s, P, Q, R: R if s.points_coincide(P, Q) else None,
               "dividers": _with_dividers("perpendicular")})
def quarter(d: Any, P: Any, Q: Any, R: Any) -> Any:
    """The vector PQ, turned a quarter counter-clockwise, laid off from R."""
    return R[0] - (Q[1] - P[1]), R[1] + (Q[0] - P[0])


def _through_a_point(s: Any, l: Any, P: Any, Q: Any) -> Any:
    """The vector laid off from a point of the line: from the foot of its start, if that is on the line's plan."""
    X = s.foot(l, P) if s.share_plan(l, P) else next(iter(s.points_on(l)), None)
    return None if X is None else s.parallel(l, s.transfer(P, Q, X))


@primitive((LINE, POINT, POINT), LINE, SET_SQUARES, "Shift {0} by the vector from {1} to {2}: draw {out}.",
           claims=(("parallel", 0), ("shifted", 0, 1, 2)), where=0, afar=((1, 2),), forms={
               "nothing to draw": lambda s, l, P, Q: l if s.points_coincide(P, Q) else None,
               "through the end": lambda s, l, P, Q: s.parallel(l, Q),
               "foot": _through_a_point})
def shift(d: Any, l: Any, P: Any, Q: Any) -> Any:
    """A line moved by the vector PQ."""
    return l[0], l[1], l[2] - (l[0] * (Q[0] - P[0]) + l[1] * (Q[1] - P[1]))


# ---- parts in proportion ---------------------------------------------------------------------------------------------


def _ray(way: str, s: Any, A: Any, B: Any, C: Any, P: Any, Q: Any) -> Any:
    """Intercept theorem on a ray of its own, square to PQ, as A, B and C may lie along PQ (Ozols 1974, 5-2)."""
    if s.sense_along(A, B, C) != way:
        return None
    PQ = s.side(P, Q)
    ray = s.perpendicular(PQ, P)
    B1 = s.line_meets_circle(ray, s.circle(P, s.opening(A, B)), way="on")
    C1 = s.line_meets_circle(ray, s.circle(P, s.opening(A, C)), way=way)
    return s.meet(s.parallel(s.side(B1, Q), C1), PQ)


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SCALE,
           "Divide {3}{4} in {out} as {2} divides {0}{1}.",
           claims=(("along", (0, 2), (0, 1)), ("along", (3, -1), (3, 4)), ("proportion", 0, 1, 2, 3, 4)),
           fails=("points-coincide",), where=3, afar=((0, 1, 2),), movement=Movement.MEASURED,
           sizing=Sizing.PROPORTION, forms={
               "at an end": lambda s, A, B, C, P, Q:
                   P if s.points_coincide(A, C) or s.points_coincide(P, Q) else Q if s.points_coincide(B, C) else None,
               "ray": partial(_ray, "on"),
               "ray, beyond": partial(_ray, "back")})
def divide(d: Any, A: Any, B: Any, C: Any, P: Any, Q: Any) -> Any:
    """The point of PQ that divides it as C divides AB; A, B, C lie on one line."""
    u = require_apart(d, A, B)
    t = dot(vector(A, C), u) / dot(u, u)
    return P[0] + t * (Q[0] - P[0]), P[1] + t * (Q[1] - P[1])
