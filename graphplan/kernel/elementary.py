"""The elementary steps: line, parallel, perpendicular, circle, opening, and where lines and circles meet.

A line's heading is the line that its direction was taken from, by its place, and how many quarter turns it runs ahead
of that one. A point lies on a line that was drawn through it, and on one by which it was marked.

A compound's `forms` are the ways to draw it, in the order in which a textbook would try them; `s` is the board. A form
that needs a branch (which crossing of an arc, which side) stands once for each: the pose decides which of them gives
the right value. A form that is not for this pose gives nothing; where a vector has no length, nothing is drawn.

Rules are arithmetic only, so floats, arrays of poses and fractions go through the same lines.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, partial
from typing import Any

from graphplan.kernel.kinds import (
    CIRCLE,
    COMPASSES,
    DIVIDERS,
    LINE,
    OPENING,
    PENCIL,
    POINT,
    SCALE,
    SET_SQUARES,
    STRAIGHTEDGE,
    Movement,
    Primitive,
    Sizing,
    primitive,
)
from graphplan.phrases import phrase

Heading = tuple[int, int]
Total = tuple[tuple[int, int], ...]  # marks by their places, each with how many times it counts


def bearing(op: Primitive, read: Sequence[Heading], place: int) -> Heading:
    """The heading of what an operation makes of marks with these headings: of a line at this place its own, but for
    one that is drawn by another line."""
    along, turns = direction_source(op)
    if along is None:
        return place, 0
    base, ahead = read[along]
    return base, (ahead + turns) % 4


@cache
def direction_source(op: Primitive) -> tuple[int | None, int]:
    """The operand whose direction a line takes, if it does, and by how many quarter turns it is ahead."""
    sources = [(place, turns) for turns, claim in enumerate(("parallel", "perpendicular"))
               for place in op.claim_operands(claim)
               if op.gives == LINE]
    return sources[0] if sources else (None, 0)


@cache
def incident(op: Primitive) -> tuple[int, ...]:
    """The points that a line is drawn through, or the lines that a point is marked by, among the operands."""
    incident_kind = {LINE: POINT, POINT: LINE}.get(op.gives, "")
    return tuple(place for place in op.claim_operands("on") if op.reads[place] == incident_kind)


def laid_off(P: Total, Q: Total, R: Total) -> Total:
    """End of the vector PQ laid off from R, as a sum of marks."""
    counts: dict[int, int] = {}
    for terms, times in ((R, 1), (Q, 1), (P, -1)):
        for mark, count in terms:
            counts[mark] = counts.get(mark, 0) + times * count
    return tuple(sorted((mark, count) for mark, count in counts.items() if count))


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
               "two arcs, left": _fourth_corner("left"),
               "two arcs, right": _fourth_corner("right"),
               "dividers": _with_dividers("parallel"),
               "parallelogram": lambda s, P, Q, R: s.meet(s.parallel(s.line(P, Q), R), s.parallel(s.line(P, R), Q))})
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


def _ray(way: str, s: Any, A: Any, B: Any, C: Any, P: Any, Q: Any) -> Any:
    """Intercept theorem on a ray of its own, perpendicular to PQ, as A, B and C may lie along PQ (Ozols 1974, 5-2)."""
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


def vector(P: Any, Q: Any) -> Any:
    """From one point to another."""
    return Q[0] - P[0], Q[1] - P[1]


def dot(u: Any, v: Any) -> Any:
    return u[0] * v[0] + u[1] * v[1]


def cross(u: Any, v: Any) -> Any:
    return u[0] * v[1] - u[1] * v[0]


def vector_size(u: Any) -> Any:
    """Size of a vector, to a factor."""
    return abs(u[0]) + abs(u[1])


def require_apart(d: Any, P: Any, Q: Any, why: str = "the two points coincide") -> Any:
    """The vector of two points that must not coincide."""
    u = vector(P, Q)
    d.nonzero(vector_size(u), vector_size(P) + vector_size(Q), "points-coincide", why)
    return u


@primitive((), POINT, SCALE, "Mark {out} at ({x}, {y}), given by the pose.", claims=(("stands",),), params=("x", "y"),
           movement=Movement.GIVEN)
def given(d: Any, /, *, x: Any, y: Any) -> Any:
    """A point of the pose."""
    return d.lift(x), d.lift(y)


@primitive((), POINT, PENCIL, "Choose the origin {out} of the {plan}.",
           claims=(("stands",),), params=("plan",), movement=Movement.BEGUN)
def begin(d: Any, /, *, plan: Any) -> Any:
    """The place where a plan, or a part of one, begins: its origin."""
    return d.lift(0), d.lift(0)


@primitive((), POINT, PENCIL, "Choose the pole {out} of the {plan}.",
           claims=(("stands",),), params=("plan",), movement=Movement.BEGUN)
def pole(d: Any, /, *, plan: Any) -> Any:
    """The place from which all vectors of a plan are laid off."""
    return begin(d, plan=plan)


@primitive((POINT,), LINE, SCALE, "Through {0} draw the guide {out} in the given direction ({dx}, {dy}).",
           claims=(("on", 0), ("heads",)), fails=("no-direction",), params=("dx", "dy"),
           movement=Movement.GUIDED, described="the guide through {0}")
def guide(d: Any, P: Any, /, *, dx: Any, dy: Any) -> Any:
    """The line through a point in a direction that the scene gives."""
    a, b = -d.lift(dy), d.lift(dx)
    d.nonzero(abs(a) + abs(b), 0, "no-direction", "the direction has no length")
    return a, b, -(a * P[0] + b * P[1])


@primitive((POINT, POINT), LINE, STRAIGHTEDGE, "Draw {out} through {0} and {1}.",
           claims=(("on", 0), ("on", 1), ("runs", 0, 1)), fails=("points-coincide",), movement=Movement.RULED)
def line(d: Any, P: Any, Q: Any) -> Any:
    """The line through two points, running from the first to the second."""
    dx, dy = require_apart(d, P, Q)
    return -dy, dx, dy * P[0] - dx * P[1]


@primitive((LINE, LINE), POINT, PENCIL, "Mark {out} where {0} meets {1}.",
           claims=(("on", 0), ("on", 1)), fails=("lines-parallel",), symmetric=True, movement=Movement.MET)
def meet(d: Any, k: Any, l: Any) -> Any:
    """The intersection of two lines."""
    one, two = k[0] * l[1], l[0] * k[1]
    w = d.nonzero(one - two, abs(one) + abs(two), "lines-parallel", "the two lines are parallel")
    return (k[1] * l[2] - l[1] * k[2]) / w, (k[2] * l[0] - l[2] * k[0]) / w


@primitive((POINT, POINT), OPENING, DIVIDERS, "Open the compasses from {0} to {1}: {out}.",
           claims=(("span", 0, 1),), movement=Movement.OPENED)
def opening(d: Any, P: Any, Q: Any) -> Any:
    """The distance of two points, in the compasses."""
    u = vector(P, Q)
    return (dot(u, u),)


@primitive((), OPENING, SCALE, "Open the compasses to the given length: {out}.", claims=(("measures",),),
           params=("length",))
def radius(d: Any, /, *, length: Any) -> Any:
    """A given length, in the compasses."""
    r = d.lift(length)
    return (r * r,)


@primitive((POINT, OPENING), CIRCLE, COMPASSES, "About {0} strike {out} with {1}.",
           claims=(("centre", 0), ("opened", 1)), where=0, movement=Movement.STRUCK, afar=((1,),))
def circle(d: Any, C: Any, o: Any) -> Any:
    """The circle about a centre with an opening."""
    return C[0], C[1], o[0]


@primitive((LINE, CIRCLE), POINT, PENCIL, "Mark {out} where {0} meets {1}, the crossing further {way} along it.",
           claims=(("on", 0), ("on", 1), ("way", 0, 1)), fails=("line-misses-circle",), params=("way",),
           movement=Movement.CUT, reversal="way")
def line_meets_circle(d: Any, l: Any, c: Any, /, *, way: str) -> Any:
    """One of the two intersections of a line with a circle: further `on` or further `back` along the line."""
    n2 = dot(l, l)
    off = (dot(l, c) + l[2]) / n2
    t = d.sqrt(c[2] / n2 - off * off, "line-misses-circle", "the line does not meet the circle")
    t = t if way == "on" else -t
    return c[0] - l[0] * off + t * l[1], c[1] - l[1] * off - t * l[0]


@primitive((CIRCLE, CIRCLE), POINT, PENCIL, "Mark {out} where {0} meets {1}, on the {side} of the line of centres.",
           claims=(("on", 0), ("on", 1), ("side", 0, 1)), fails=("circles-miss", "circles-concentric"),
           params=("side",), movement=Movement.ARCS_MET, reversal="side")
def circles_meet(d: Any, k: Any, m: Any, /, *, side: str) -> Any:
    """One of the two intersections of two circles: left or right of the ray from the first centre to the second.

    The height over the line of centres is taken from both circles, each weighed by the other: the small one tells it
    well where the large one cannot.
    """
    dx, dy = u = vector(k, m)
    d2 = d.nonzero(dot(u, u), k[2] + m[2], "circles-concentric", "the two circles have the same centre")
    squared_radii = d.nonzero(k[2] + m[2], d2, "circles-miss", "the two circles do not meet")
    t, s = (d2 + k[2] - m[2]) / (2 * d2), (d2 + m[2] - k[2]) / (2 * d2)
    h2 = (m[2] * (k[2] / d2 - t * t) + k[2] * (m[2] / d2 - s * s)) / squared_radii
    h = d.sqrt(h2, "circles-miss", "the two circles do not meet")
    h = h if side == "left" else -h
    return k[0] + t * dx - h * dy, k[1] + t * dy + h * dx


@primitive((POINT, POINT, POINT), POINT, SCALE,
           "From {2} lay off in the direction from {0} to {1}: mark {out}.",
           claims=(("along", (2, -1), (0, 1)), ("times", (2, -1), (0, 1))), params=("ratio",),
           movement=Movement.LAID_OFF, afar=((0, 1),))
def step_off(d: Any, P: Any, Q: Any, R: Any, /, *, ratio: Any) -> Any:
    """A given multiple of the vector PQ laid off from R."""
    r = d.lift(ratio)
    return R[0] + r * (Q[0] - P[0]), R[1] + r * (Q[1] - P[1])


@primitive((POINT, POINT, POINT), POINT, SCALE,
           "From {2} lay off in the direction from {0} to {1}, turned a quarter counter-clockwise: mark {out}.",
           claims=(("across", (2, -1), (0, 1)), ("times across", (2, -1), (0, 1))), params=("ratio",),
           movement=Movement.TURNED, afar=((0, 1),))
def step_across(d: Any, P: Any, Q: Any, R: Any, /, *, ratio: Any) -> Any:
    """A given multiple of the vector PQ, turned a quarter counter-clockwise, laid off from R."""
    r = d.lift(ratio)
    return R[0] - r * (Q[1] - P[1]), R[1] + r * (Q[0] - P[0])


@primitive((LINE, POINT), POINT, SCALE, "From {1} lay off the given length along {0}: mark {out}.",
           claims=(("laid", 0, 1),), params=("length",), movement=Movement.LAID_ALONG, afar=((0,),),
           reversal="length")
def lay_along(d: Any, l: Any, P: Any, /, *, length: Any) -> Any:
    """A given length laid off from a point the way a line runs."""
    unit = d.sqrt(dot(l, l), "not-rational", "a length along this line is irrational")
    r = d.lift(length) / unit
    return P[0] + r * l[1], P[1] - r * l[0]


@primitive((POINT,), POINT, SCALE, "From {0} lay off the given vector: mark {out}.",
           claims=(("moved", (0, -1)),), params=("dx", "dy"), movement=Movement.LAID_BY_COMPONENTS,
           likewise={"": phrase("Likewise from {0}: {out}.")})
def lay_off(d: Any, P: Any, /, *, dx: Any, dy: Any) -> Any:
    """A vector given by its components, laid off from a point."""
    return P[0] + d.lift(dx), P[1] + d.lift(dy)


@primitive((LINE, POINT, POINT, POINT, POINT), POINT, PENCIL,
           "Mark {out} anywhere on {0}, as a trial.",
           claims=(("on", 0), ("ahead", 0, 1)), params=("ratio",), where=0, movement=Movement.PICKED, reversal="ratio",
           afar=((3, 4),))
def pick(d: Any, l: Any, P: Any, Q: Any, K: Any, A: Any, /, *, ratio: Any) -> Any:
    """Any point of a line, for a trial: from the foot of P, about `ratio` times PQ and KA together the way it runs."""
    n2 = dot(l, l)
    off = (dot(l, P) + l[2]) / n2
    (x, y), (u, v) = vector(P, Q), vector(K, A)
    t = d.lift(ratio) * vector_size((x + u, y + v)) / vector_size(l)
    return P[0] - l[0] * off + t * l[1], P[1] - l[1] * off - t * l[0]
