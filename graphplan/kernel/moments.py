"""The statics of the table: forces that balance others about a point, couples as pairs of forces.

A force is a vector of a force plan (two points there) that acts at a point of the mechanism plan. Its arm is measured
on the mechanism plan, so a moment is a product of a drawn force and a drawn length, and a force is had back by
dividing by an arm.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from graphplan.kernel.elementary import cross, dot, require_apart, vector, vector_size
from graphplan.kernel.kinds import LINE, POINT, SCALE, SET_SQUARES, STRAIGHTEDGE, Movement, Sizing, primitive
from graphplan.phrases import phrase

NO_ARM = "the two points coincide: there is no arm"


def _quarter_multiple(u: Any, part: Any, m: Any) -> Any:
    """From m a multiple of u, turned a quarter."""
    return m[0] - part * u[1], m[1] + part * u[0]


@primitive((POINT, POINT, POINT, POINT, POINT, POINT), POINT, SCALE,
           "Moments about {0}: T · {0}{1} = P · h, with P from {3} to {4} at {2}. From {5} lay off T, which acts at "
           "{1} perpendicular to {0}{1}: mark {out}.",
           claims=(("across", (5, -1), (0, 1)), ("counters", 0, 1, 2, 3, 4, 5)), fails=("points-coincide",),
           source="Ozols 1974, 10-2: tangential parts from moments", afar=((0, 1, 2), (3, 4)),
           movement=Movement.MEASURED, sizing=Sizing.MOMENTS, likewise={"": phrase(
               "Likewise about {0}, P from {3} to {4} at {2}: from {5} T at {1}, {out}.")})
def balance(d: Any, Y: Any, X: Any, C: Any, p: Any, q: Any, m: Any) -> Any:
    """The end of the force at X, perpendicular to YX and laid off from m, that balances the force pq at C about Y."""
    arm = require_apart(d, Y, X, NO_ARM)
    return _quarter_multiple(arm, -cross(vector(Y, C), vector(p, q)) / dot(arm, arm), m)


@primitive((POINT, POINT, POINT), POINT, SCALE,
           "For the couple take a pair of forces at {0} and {1}, perpendicular to {0}{1}: from {2} lay off that at "
           "{1}; mark "
           "{out}.",
           claims=(("across", (2, -1), (0, 1)), ("turns", 0, 1, 2)), fails=("points-coincide",), params=("moment",),
           source="Ozols 1974, 10-6", afar=((0, 1),), movement=Movement.MEASURED, sizing=Sizing.COUPLE)
def couple(d: Any, P: Any, R: Any, m: Any, /, *, moment: Any) -> Any:
    """The end of the force at R, perpendicular to PR and laid off from m, that with its opposite at P has a given
    moment."""
    arm = require_apart(d, P, R, NO_ARM)
    return _quarter_multiple(arm, d.lift(moment) / dot(arm, arm), m)


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SCALE,
           "For the inertia couple, by the tangential part of the acceleration from {2} to {3}, take a pair of forces "
           "at {0} and {1}, perpendicular to {0}{1}: from {4} lay off that at {1}, reversed; mark {out}.",
           claims=(("across", (4, -1), (0, 1)), ("resists", 0, 1, 2, 3, 4)), fails=("points-coincide",),
           params=("ratio",), source="Ozols 1974, 9-2, fig. 9-4", afar=((0, 1), (2, 3)),
           movement=Movement.MEASURED, sizing=Sizing.INERTIA)
def inertia_pair(d: Any, P: Any, R: Any, a: Any, b: Any, m: Any, /, *, ratio: Any) -> Any:
    """The end of the force at R, laid off from m, whose pair with P is the inertia couple; ab is R's motion about P."""
    arm = require_apart(d, P, R, NO_ARM)
    square = dot(arm, arm)
    return _quarter_multiple(arm, -d.lift(ratio) * cross(arm, vector(a, b)) / square / square, m)


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SCALE,
           "Mark {out} where a force along that from {3} to {4} touches the friction circle about {0} so "
           "that it turns against the motion that the vector from {1} to {2} shows.",
           claims=(("touches", 0, 1, 2, 3, 4),), fails=("points-coincide",), where=0, params=("radius",),
           afar=((3, 4),), source="Ozols 1974, 12-4, fig. 12-11", movement=Movement.MEASURED, sizing=Sizing.FRICTION)
def touch(d: Any, P: Any, R: Any, w: Any, p: Any, q: Any, /, *, radius: Any) -> Any:
    """The point of the friction circle of a journal at P through which its force acts, as its last one pq says.

    Rw is the orthogonal velocity of R against the other link, which runs with PR where the link turns clockwise. Where
    the two links stand still on each other, and where there is no force, it is P.
    """
    arm, force, slip = require_apart(d, P, R, NO_ARM), vector(p, q), vector(R, w)
    sense = d.sign(arm[0] * slip[0] + arm[1] * slip[1], dot(arm, arm)) * d.lift(radius)
    acts = d.sign(vector_size(force), vector_size(p) + vector_size(q))
    long = d.sqrt(dot(force, force) + (1 - acts), "not-rational", "the size of the reaction is irrational")
    return P[0] + acts * sense * force[1] / long, P[1] - acts * sense * force[0] / long


@primitive((LINE, POINT, POINT, POINT, POINT), LINE, SET_SQUARES,
           "Through {1} draw {out}, which leans from {0} by the friction angle, of tangent {coefficient}: a force "
           "perpendicular to it, on the side of that from {3} to {4}, is against the sliding that the vector from "
           "{1} to {2} "
           "shows.",
           claims=(("on", 1), ("leans", 0, 1, 2, 3, 4)), where=1, params=("coefficient",), afar=((3, 4),),
           source="Ozols 1974, 12-1")
def lean(d: Any, l: Any, B: Any, w: Any, p: Any, q: Any, /, *, coefficient: Any) -> Any:
    """A guide turned by the friction angle: the slide's reaction is perpendicular to it.

    pq is its last reaction; Bw is the orthogonal velocity along the guide. Where the two links stand still on each
    other, and where there is no force, it does not lean.
    """
    slip, force = vector(B, w), vector(p, q)
    moves = d.sign(slip[0] * l[0] + slip[1] * l[1], (vector_size(B) + vector_size(w)) * vector_size(l))
    side = d.sign(force[0] * l[0] + force[1] * l[1], (vector_size(p) + vector_size(q)) * vector_size(l))
    k = moves * side * d.lift(coefficient)
    a, b = l[0] - k * l[1], l[1] + k * l[0]
    return a, b, -(a * B[0] + b * B[1])


@primitive((POINT, POINT, POINT, POINT), LINE, SET_SQUARES,
           "Through {0} draw {out}, the line of pressure: it leans from the force that runs from {2} to {3}, towards "
           "{1}, by the pressure angle, of tangent {coefficient}.",
           claims=(("on", 0), ("presses", 0, 1, 2, 3)), fails=("points-coincide",), where=0, params=("coefficient",),
           afar=((2, 3),), source="Ozols 1974, 11-2, figs. 11-3 to 11-5")
def pressure_line(d: Any, P: Any, B: Any, p: Any, q: Any, /, *, coefficient: Any) -> Any:
    """The line of the tooth force at the pitch point P on the wheel with the centre B; pq is its circumferential part.

    Each wheel is pushed away from its mate, whichever way pq runs. Where it is nothing, the line does not lean.
    """
    arm, force = require_apart(d, P, B, "the wheel has no radius"), vector(p, q)
    k = d.sign(cross(arm, force), (vector_size(p) + vector_size(q)) * vector_size(arm)) * d.lift(coefficient)
    a, b = arm[0] + k * arm[1], arm[1] - k * arm[0]
    return a, b, -(a * P[0] + b * P[1])


@primitive((POINT, POINT, POINT, POINT), LINE, SET_SQUARES,
           "Through {0} draw {out}, the line of the belt's pull: it leans from the part perpendicular to {0}{1}, "
           "which runs "
           "from {2} to {3}, by an angle of tangent {coefficient} (positive towards {1}).",
           claims=(("on", 0), ("presses", 0, 1, 2, 3)), fails=("points-coincide",), where=0, params=("coefficient",),
           afar=((2, 3),), source="Ozols 1974, 12-1, fig. 12-2")
def pull_line(d: Any, P: Any, B: Any, p: Any, q: Any, /, *, coefficient: Any) -> Any:
    """The line of what both strands of a belt pull, through the pole P; pq is the part that turns the pulley about B.

    Both strands pull the pulley towards its mate, whichever is the tight one. Without a force it does not lean.
    """
    line: Any = pressure_line(d, P, B, p, q, coefficient=coefficient)
    return line


@primitive((POINT, POINT, POINT, POINT, POINT, POINT, POINT), POINT, SCALE,
           "The force from {1} to {2} at {0} and the couple of the force from {5} to {6} at {4}, with its answer at "
           "{3}, are one force, shifted by the couple over the force: mark {out}, a point of its line.",
           claims=(("across", (0, -1), (1, 2)), ("takes couple", 0, 1, 2, 3, 4, 5, 6)), fails=("couple-alone",),
           where=0, source="Ozols 1974, 10-2: arms of slider reactions", movement=Movement.MEASURED,
           afar=((1, 2), (3, 4), (5, 6)), sizing=Sizing.SHIFT)
def resultant(d: Any, C: Any, p: Any, q: Any, P: Any, R: Any, a: Any, b: Any) -> Any:
    """The point, perpendicular to the force pq from C, where pq alone does what it does at C with a pair of forces."""
    force = vector(p, q)
    d.nonzero(vector_size(force), vector_size(p) + vector_size(q), "couple-alone", "the force is zero")
    return _quarter_multiple(force, -cross(vector(P, R), vector(a, b)) / dot(force, force), C)


def _meeting(y: Any, z: Any) -> Any:
    """Intersection of two lines, as (x, y, w): the point (x/w, y/w), at infinity if w is zero."""
    return y[1] * z[2] - z[1] * y[2], y[2] * z[0] - z[2] * y[0], y[0] * z[1] - z[0] * y[1]


def _vector_from_meet(d: Any, y: Any, z: Any, X: Any) -> Any:
    """The vector to X from where two lines meet, as long as it pleases."""
    Y = _meeting(y, z)
    u = Y[2] * X[0] - Y[0], Y[2] * X[1] - Y[1]
    reach = vector_size(y) * (vector_size(z) * vector_size(X) + abs(z[2])) + abs(y[2]) * vector_size(z)
    d.nonzero(vector_size(u), reach, "points-coincide", "the two lines meet in the point itself, or are one")
    return u


def _similar_triangles(one: float, two: float, s: Any, y: Any, z: Any, X: Any) -> Any:
    """Two similar triangles between the lines: their third corners lie on a line to where the lines meet."""
    far = s.clear_of(X)
    if far is None:
        return None
    P, R, P2 = (s.pick(line, X, far, X, far, ratio=times / 2) for line, times in ((y, one), (z, one / 3), (y, two)))
    R2 = s.meet(s.parallel(s.line(P, R), P2), z)
    return s.line(X, s.meet(s.parallel(s.line(P, X), P2), s.parallel(s.line(R, X), R2)))


@primitive((LINE, LINE, POINT), LINE, STRAIGHTEDGE, "Through {2} draw {out} to where {0} meets {1}.",
           claims=(("on", 2), ("concurrent", 0, 1)), fails=("points-coincide",),
           source="Rosenauer 1939, No. 14: the auxiliary points Q, R, for forces", method="auxiliary points", forms={
               "along one of them": lambda s, y, z, X: y if s.lies_on(X, y) else z if s.lies_on(X, z) else None,
               "auxiliary point": lambda s, y, z, X: s.line(s.meet(y, z, name="Q"), X),
               "similar triangles": partial(_similar_triangles, 0.15, 0.5),
               "similar triangles, backwards": partial(_similar_triangles, -0.15, -0.5)})
def towards(d: Any, y: Any, z: Any, X: Any) -> Any:
    """The line from the intersection of two lines through a third point; parallel to both if they are parallel."""
    u = _vector_from_meet(d, y, z, X)
    return -u[1], u[0], u[1] * X[0] - u[0] * X[1]


def _resolve_force(s: Any, y: Any, z: Any, X: Any, C: Any, p: Any, q: Any, m: Any) -> Any:
    """The part of the force towards the distant point has no moment; the part towards X is moved there.

    At X itself, or with both ways parallel, the part of the force across the way to the distant point counts.
    """
    part = s.meet(s.parallel(s.side(C, X), p), s.parallel(s.towards(y, z, C), q))
    return s.foot(s.parallel(s.towards(y, z, X), s.transfer(part, p, m)), m)


@primitive((LINE, LINE, POINT, POINT, POINT, POINT, POINT), POINT, SCALE,
           "Take moments about the point where {0} meets {1}: from {6} lay off the force at {2}, perpendicular to "
           "the way to "
           "that point, that balances the force from {4} to {5} at {3}; mark {out}.",
           claims=(("counters afar", 0, 1, 2, 3, 4, 5, 6),), fails=("points-coincide",),
           source="Rosenauer 1939, No. 14: the auxiliary points Q, R, for forces", method="auxiliary points",
           afar=((0, 1, 2, 3), (4, 5)), forms={
               "auxiliary point": lambda s, y, z, X, C, p, q, m: s.balance(s.meet(y, z, name="Q"), X, C, p, q, m),
               "resolution": _resolve_force,
               "its part across": lambda s, y, z, X, C, p, q, m:
                   s.transfer(q, s.foot(s.parallel(s.towards(y, z, X), p), q), m)})
def weigh(d: Any, y: Any, z: Any, X: Any, C: Any, p: Any, q: Any, m: Any) -> Any:
    """The end of the force at X, laid off from m, that balances pq at C about the point where two lines meet."""
    Y = _meeting(y, z)
    arm = _vector_from_meet(d, y, z, X)
    reach = Y[2] * C[0] - Y[0], Y[2] * C[1] - Y[1]
    return _quarter_multiple(arm, -cross(reach, vector(p, q)) / dot(arm, arm), m)
