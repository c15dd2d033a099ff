"""Positions of links: how points are found from the lengths of links, by protractor, compasses and straightedge.

A link's own figure is given by vectors between its points, in any one pose: only lengths and angles of it count. As
vectors they are rational where coordinates are, so that nothing is lost by a root that is squared again.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any, Self

from graphplan.kernel.elementary import cross, dot, require_apart, vector_size
from graphplan.kernel.kinds import COMPASSES, LINE, OPENING, POINT, PROTRACTOR, SCALE, Movement, primitive
from graphplan.kernel.tolerances import COLLINEAR_TOL
from graphplan.phrases import Said


class Angle(str):
    """An angle from the x-axis, spoken in degrees: the direction of a vector (x, y)."""

    words: Said
    x: Any
    y: Any

    def __new__(cls, words: Said, x: Any, y: Any) -> Self:
        self = super().__new__(cls, words)
        self.words, self.x, self.y = words, x, y
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Angle, (self.words, self.x, self.y)


@primitive((), OPENING, SCALE, "Open the compasses to the length of the link: {out}.", claims=(("spans",),),
           params=("dx", "dy"))
def link_length(d: Any, /, *, dx: Any, dy: Any) -> Any:
    """The length of a given vector, in the compasses."""
    u = d.lift(dx), d.lift(dy)
    return (dot(u, u),)


@primitive((POINT,), LINE, PROTRACTOR, "Through {0} draw {out} at {angle}° to the x-axis.",
           claims=(("on", 0), ("inclined",)), fails=("no-direction",), params=("angle",), movement=Movement.INCLINED,
           described="the line through {0} at its angle")
def inclined(d: Any, P: Any, /, *, angle: Angle) -> Any:
    """The line through a point at a given angle from the x-axis."""
    a, b = -d.lift(angle.y), d.lift(angle.x)
    d.nonzero(abs(a) + abs(b), 0, "no-direction", "the direction has no length")
    return a, b, -(a * P[0] + b * P[1])


def _by_protractor(s: Any, P: Any, *, angle: Angle) -> Any:
    return s.line_meets_circle(s.inclined(P, angle=angle), s.circle(P, s.link_length(dx=angle.x, dy=angle.y)), way="on")


def _by_chord(way: str, s: Any, P: Any, *, angle: Angle) -> Any:
    """The chord under the angle, from where the circle meets the axis."""
    x, y = float(angle.x), float(angle.y)
    arm, axis = s.circle(P, s.link_length(dx=angle.x, dy=angle.y)), s.guide(P, dx=1, dy=0)
    E = s.line_meets_circle(axis, arm, way=way)
    reach = math.hypot(x, y) if way == "on" else -math.hypot(x, y)
    if y == 0:
        return E if (x > 0) == (reach > 0) else None
    ends = arm, s.circle(E, s.link_length(dx=x - reach, dy=y))
    return s.circles_meet(*ends, side="left" if (y > 0) == (reach > 0) else "right")


@primitive((POINT,), POINT, PROTRACTOR, "From {0} lay off the driving link at {angle}° to the x-axis: mark {out}.",
           claims=(("laid at",),), fails=("no-direction",), params=("angle",), forms={
               "protractor": _by_protractor, "chord": partial(_by_chord, "on"),
               "chord from the other side": partial(_by_chord, "back")})
def crank(d: Any, P: Any, /, *, angle: Angle) -> Any:
    """The end of a link of given length and direction."""
    x, y = d.lift(angle.x), d.lift(angle.y)
    d.nonzero(abs(x) + abs(y), 0, "no-direction", "the direction has no length")
    return P[0] + x, P[1] + y


# ---- further points of a link --------------------------------------------------------------------------------------


def _sides(dx: Any, dy: Any, ux: Any, uy: Any) -> tuple[float, float, float]:
    """Of a vector beside another as floats: their inner and outer product, and the product of their lengths."""
    v, u = (float(dx), float(dy)), (float(ux), float(uy))
    return dot(u, v), cross(u, v), math.hypot(*u) * math.hypot(*v)


def _on_side(s: Any, P: Any, Q: Any, *, dx: Any, dy: Any, ux: Any, uy: Any) -> Any:
    """A point of the line itself."""
    along, across, whole = _sides(dx, dy, ux, uy)
    if abs(across) > COLLINEAR_TOL * whole:
        return None
    if not whole:
        return P
    arc, way = s.circle(P, s.link_length(dx=dx, dy=dy)), "on" if along > 0 else "back"
    return s.line_meets_circle(s.line(P, Q), arc, way=way)


def _two_arcs(s: Any, P: Any, Q: Any, *, dx: Any, dy: Any, ux: Any, uy: Any) -> Any:
    across = _sides(dx, dy, ux, uy)[1]
    one, two = s.circle(P, s.link_length(dx=dx, dy=dy)), s.circle(Q, s.link_length(dx=dx - ux, dy=dy - uy))
    return s.circles_meet(one, two, side="left" if across > 0 else "right")


def _by_ordinates(s: Any, P: Any, Q: Any, *, dx: Any, dy: Any, ux: Any, uy: Any) -> Any:
    """Along the side, and perpendicular to it."""
    along, across, _ = _sides(dx, dy, ux, uy)
    side, base = s.line(P, Q), math.hypot(float(ux), float(uy))
    D = s.lay_along(side, P, length=along / base)
    return s.lay_along(s.perpendicular(side, D), D, length=across / base)


@primitive((POINT, POINT), POINT, COMPASSES, "From {0} and {1} mark {out}, a further point of their link.",
           claims=(("cornered", 0, 1),), fails=("points-coincide",), params=("dx", "dy", "ux", "uy"), where=0, forms={
               "on the line": _on_side, "two arcs": _two_arcs, "ordinates": _by_ordinates})
def corner(d: Any, P: Any, Q: Any, /, *, dx: Any, dy: Any, ux: Any, uy: Any) -> Any:
    """The point of a link that lies from P as (dx, dy) does where Q lies as (ux, uy) does."""
    v, u, PQ = (d.lift(dx), d.lift(dy)), (d.lift(ux), d.lift(uy)), require_apart(d, P, Q)
    whole = d.nonzero(dot(u, u), 0, "points-coincide", "two points of the link coincide")
    along, across = dot(u, v) / whole, cross(u, v) / whole
    return P[0] + along * PQ[0] - across * PQ[1], P[1] + along * PQ[1] + across * PQ[0]


def _laid_by_ordinates(s: Any, l: Any, P: Any, *, dx: Any, dy: Any, ux: Any, uy: Any) -> Any:
    along, across, whole = _sides(dx, dy, ux, uy)
    base = math.hypot(float(ux), float(uy))
    if not (whole and base):
        return P if base else None
    D = P if abs(along) <= COLLINEAR_TOL * whole else s.lay_along(s.parallel(l, P), P, length=along / base)
    return D if abs(across) <= COLLINEAR_TOL * whole else s.lay_along(s.perpendicular(l, D), D, length=across / base)


@primitive((LINE, POINT), POINT, SCALE,
           "From {1} lay off the vector to a further point of the link, which turns as {0} does: mark {out}.",
           claims=(("set off", 0, 1),), fails=("no-direction",), params=("dx", "dy", "ux", "uy"),
           afar=((0,),), forms={"ordinates": _laid_by_ordinates})
def set_off(d: Any, l: Any, P: Any, /, *, dx: Any, dy: Any, ux: Any, uy: Any) -> Any:
    """The point of a link that lies from P as (dx, dy) does where the line runs as (ux, uy) does."""
    v, u, ray = (d.lift(dx), d.lift(dy)), (d.lift(ux), d.lift(uy)), (l[1], -l[0])
    square = d.nonzero(dot(u, u), 0, "no-direction", "the direction has no length") * dot(ray, ray)
    whole = d.sqrt(square, "not-rational", "a vector turned with this line is irrational")
    along, across = dot(u, v) / whole, cross(u, v) / whole
    return P[0] + along * ray[0] - across * ray[1], P[1] + along * ray[1] + across * ray[0]


# ---- a guide that passes a point -----------------------------------------------------------------------------------


def _through_both(s: Any, P: Any, Q: Any, *, dx: Any, dy: Any, ux: Any, uy: Any, way: str) -> Any:
    _, across, whole = _sides(dx, dy, ux, uy)
    if abs(across) > COLLINEAR_TOL * whole:
        return None
    return s.line(P, Q) if way == "on" else s.line(Q, P)


def _tangent(s: Any, P: Any, Q: Any, *, dx: Any, dy: Any, ux: Any, uy: Any, way: str) -> Any:
    """By Thales' circle over PQ: from P the foot lies at the given distance."""
    across = _sides(dx, dy, ux, uy)[1]
    if not across:
        return None
    off, M = across / math.hypot(float(ux), float(uy)), s.midpoint(P, Q)
    arc = s.circle(P, s.radius(length=abs(off)))
    F = s.circles_meet(arc, s.circle(M, s.opening(M, P)), side="left" if (off > 0) == (way == "on") else "right")
    return s.line(F, Q) if way == "on" else s.line(Q, F)


@primitive((POINT, POINT), LINE, COMPASSES,
           "Through {1} draw the guide {out}, which passes {0} at its distance; {1} lies further {way} along it.",
           claims=(("on", 1), ("sighted", 0, 1)), fails=("points-coincide", "circles-miss"),
           params=("dx", "dy", "ux", "uy", "way"), described="the guide through {1}", forms={
               "line of both": _through_both, "Thales' circle": _tangent})
def sight(d: Any, P: Any, Q: Any, /, *, dx: Any, dy: Any, ux: Any, uy: Any, way: str) -> Any:
    """The line through Q that passes P as one along (ux, uy) does where Q lies from P at (dx, dy).

    Q lies further `on` or `back` along it.
    """
    v, u, PQ = (d.lift(dx), d.lift(dy)), (d.lift(ux), d.lift(uy)), require_apart(d, P, Q)
    across, left = cross(u, v), dot(PQ, PQ) * dot(u, u)
    along = d.sqrt(left - across * across, "circles-miss", "the guide's distance exceeds that of the points")
    t = along if way == "on" else -along
    dx, dy = t * PQ[0] + across * PQ[1], t * PQ[1] - across * PQ[0]
    d.nonzero(vector_size((dx, dy)), 0, "points-coincide", "the guide has no direction")
    return -dy, dx, dy * Q[0] - dx * Q[1]
