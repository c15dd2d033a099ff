"""The base of the table: what one instrument does in one movement.

Rules are arithmetic only, so floats, arrays of poses and fractions go through the same lines.
"""

from __future__ import annotations

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
    STRAIGHTEDGE,
    Movement,
    primitive,
)
from graphplan.phrases import phrase


def vector(P: Any, Q: Any) -> Any:
    """From one point to another."""
    return Q[0] - P[0], Q[1] - P[1]


def dot(u: Any, v: Any) -> Any:
    return u[0] * v[0] + u[1] * v[1]


def cross(u: Any, v: Any) -> Any:
    return u[0] * v[1] - u[1] * v[0]


def vector_size(u: Any) -> Any:
    """How large a vector is, to a factor."""
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
