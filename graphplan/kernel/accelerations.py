"""Vectors of accelerations, drawn from those of velocities."""

from __future__ import annotations

from functools import partial
from typing import Any

from graphplan.kernel.kinds import COMPASSES, POINT, SET_SQUARES, Sizing, primitive
from graphplan.kernel.primitives import dot, require_apart, vector
from graphplan.phrases import phrase


def _semicircle(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    """v < KA: the velocity is a leg, KA the hypotenuse; the leg's projection on KA is v^2/KA."""
    M = s.midpoint(K, A)
    D = s.circles_meet(s.circle(M, s.opening(M, A)), s.circle(A, s.opening(m, w)), side="left", name="D")
    return s.transfer(s.foot(s.side(K, A), D, name="E"), A, k)


def _companion(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    """v > KA: the velocity is a leg, KA its projection; the hypotenuse is v^2/KA."""
    KA, arc = s.side(K, A), s.circle(A, s.opening(m, w))
    D = s.line_meets_circle(s.perpendicular(KA, K), arc, way="on", name="D")
    E = s.meet(KA, s.perpendicular(s.side(A, D), D), name="E")
    return s.transfer(E, A, k)


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, COMPASSES,
           "Construct the relative normal acceleration of {0} about {1} by the relative velocity from {2} to {3}; "
           "from {4} lay it off: mark {out}.",
           claims=(("along", (4, -1), (0, 1)), ("away", (4, -1), (0, 1)), ("mean", 0, 1, 2, 3, 4)),
           fails=("points-coincide",), afar=((0, 1), (2, 3)), sizing=Sizing.SQUARE,
           source="Rosenauer 1939, No. 14; Ozols 1974, 5-3, fig. 5-22", forms={
               "nothing to draw": lambda s, K, A, m, w, k: k if s.points_coincide(m, w) else None,
               "semicircle": _semicircle,
               "companion": _companion,
               "equal lengths": lambda s, K, A, m, w, k: s.transfer(K, A, k) if s.equal(K, A, m, w) else None},
           before={
               "semicircle": phrase("On {0}{1} draw the semicircle; about {1} strike the arc through it with the "
                                    "opening from {2} to {3}: {D}. From {D} drop the perpendicular on {0}{1}: foot "
                                    "{E}."),
               "companion": phrase("At {0} draw the perpendicular to {0}{1}; about {1} strike the arc through it with "
                                   "the opening from {2} to {3}: {D}. At {D} draw the perpendicular to the line "
                                   "through {1} and {D}: it meets {0}{1} in {E}.")})
def normal(d: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    """The end a of the vector ka = v^2/KA, parallel to KA and away from k, v being the length mw.

    So the vector from k to a is the relative normal acceleration of K about A; that of A about K runs back.
    """
    u, v = require_apart(d, K, A, "the two joints coincide"), vector(m, w)
    s = dot(v, v) / dot(u, u)
    return k[0] + s * u[0], k[1] + s * u[1]


def _half(s: Any, P: Any, B: Any, T: Any, R: Any, b: Any, *, turned: bool) -> Any:
    """Half the vector by similar triangles, on the way to the pole or, `turned`, to another point of the link."""
    D, T1 = (s.quarter(B, P, B), s.quarter(B, T, B)) if turned else (P, T)
    half = s.meet(s.parallel(s.side(R, D), T1), s.side(B, R), name="K")
    return s.transfer(half, B, s.transfer(half, B, b))


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SET_SQUARES,
           "Construct half the Coriolis vector at {1} from the orthogonal relative velocity, from {1} to {3}, and "
           "that of the guide's turning about {0}, from {1} to {2}; from {4} lay it off twice, reversed: mark {out}.",
           claims=(("along", (1, 2), (1, 0)), ("coriolis", 0, 1, 2, 3, 4)), fails=("points-coincide",),
           afar=((0, 1, 2, 3),), source="Ozols 1974, 5-3, fig. 5-24", weighed=True, sizing=Sizing.DOUBLE, forms={
               "nothing to draw": lambda s, P, B, T, R, b: b if s.points_coincide(B, T) or s.points_coincide(B, R)
               else None,
               "at the pair": partial(_half, turned=False),
               "at another point of the guide's link": partial(_half, turned=True)},
           by_form=dict.fromkeys(("at the pair", "at another point of the guide's link"), phrase(
               "From {4} lay off the vector from {K} to {1}, half the Coriolis vector, twice: mark {out}.")),
           before={"at the pair": phrase("Similar triangles: through {2} draw the parallel to the line through {3} "
                                         "and {0}; it meets the line through {1} and {3} in {K}.")})
def coriolis(d: Any, P: Any, B: Any, T: Any, R: Any, b: Any) -> Any:
    """The point b less the Coriolis vector: BT/BP is the guide's turning, BR the orthogonal relative velocity."""
    u = require_apart(d, B, P, "the pole of the guide lies in the pair")
    s = 2 * dot(vector(B, T), u) / dot(u, u)
    return b[0] - s * (R[0] - B[0]), b[1] - s * (R[1] - B[1])
