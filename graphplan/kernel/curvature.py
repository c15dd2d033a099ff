"""Normal and Coriolis accelerations; curvature of paths, after Euler and Savary, Bobillier, Hartmann.

P is the pole of the motion, A a moving point and A_0 the centre of curvature of its path, both on a ray through P; W_0
is the inflection pole, opposite P on the inflection circle. A path is known from two points of the plane and their
centres.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from graphplan.kernel.elementary import cross, dot, require_apart, vector
from graphplan.kernel.kinds import COMPASSES, POINT, SCALE, SET_SQUARES, Movement, Sizing, primitive
from graphplan.phrases import phrase

EULER = "Euler-Savary"


def _third_by_semicircle(s: Any, K: Any, A: Any, m: Any, w: Any) -> Any:
    """mw < KA: it is a leg, KA the hypotenuse; the leg's projection on KA is the third proportional."""
    M = s.midpoint(K, A)
    D = s.circles_meet(s.circle(M, s.opening(M, A)), s.circle(K, s.opening(m, w)), side="left", name="D")
    return s.foot(s.side(K, A), D)


def _third_by_right_triangle(s: Any, K: Any, A: Any, m: Any, w: Any) -> Any:
    """mw > KA: it is a leg, KA its projection; the hypotenuse is the third proportional."""
    KA, arc = s.side(K, A), s.circle(K, s.opening(m, w))
    D = s.line_meets_circle(s.perpendicular(KA, A), arc, way="on", name="D")
    return s.meet(KA, s.perpendicular(s.side(K, D), D))


@primitive((POINT, POINT, POINT, POINT), POINT, COMPASSES,
           "On the ray from {0} through {1} mark {out}, so that the length from {2} to {3} is the mean proportional of "
           "{0}{1} and the way from {0} to {out}.",
           claims=(("along", (0, -1), (0, 1)), ("away", (0, -1), (0, 1)), ("third", 0, 1, 2, 3)),
           fails=("points-coincide",), afar=((2, 3),), where=0, source="Ozols 1974, 5-1, (5.3)", forms={
               "no length": lambda s, K, A, m, w: K if s.points_coincide(m, w) else None,
               "equal lengths": lambda s, K, A, m, w: A if s.equal(K, A, m, w) else None,
               "semicircle": _third_by_semicircle,
               "right triangle": _third_by_right_triangle})
def third(d: Any, K: Any, A: Any, m: Any, w: Any) -> Any:
    """The third proportional to KA and the length mw, laid off from K towards A."""
    u, v = require_apart(d, K, A, "the two points coincide, so the third proportional is at infinity"), vector(m, w)
    s = dot(v, v) / dot(u, u)
    return K[0] + s * u[0], K[1] + s * u[1]


def _third_on_the_ray(s: Any, P: Any, M: Any, W0: Any) -> Any:
    """PM is the mean proportional of MW and the radius (Ozols 1974, (5.3))."""
    W = s.foot(s.side(P, M), W0, name="W")
    return s.third(M, W, M, P)


def _parallel_to_the_diameter(s: Any, P: Any, M: Any, W0: Any) -> Any:
    """Draw the centre of curvature by similar triangles: W_0 is seen from M in Q over P, C from Q along the
    diameter."""
    PM = s.side(P, M)
    Q = s.meet(s.perpendicular(PM, P), s.side(M, W0), name="Q")
    return s.meet(PM, s.parallel(s.side(P, W0), Q))


@primitive((POINT, POINT, POINT), POINT, SET_SQUARES,
           "From the pole {0} and the inflection pole {2} mark {out} on the ray {0}{1}, the centre of curvature of the "
           "path of {1}.",
           claims=(("along", (1, -1), (1, 0)), ("curved", 0, 1, 2)), fails=("points-coincide", "straight-path"),
           source="Euler 1765, Savary 1845; Ozols 1974, 5-1", weighed=True, where=1, forms={
               "the pole itself": lambda s, P, M, W0: P if s.points_coincide(P, W0) else None,
               "parallel to the diameter": _parallel_to_the_diameter,
               EULER: _third_on_the_ray},
           by_form={
               EULER: phrase("Drop the perpendicular from {2} on the ray {0}{1}: {W}, on the inflection circle. {0}{1} "
                             "is the mean proportional of {1}{W} and the radius of curvature: mark {out}."),
               "parallel to the diameter": phrase(
                   "Draw the perpendicular to {0}{1} in {0}; it meets the line from {1} to {2} in {Q}. Through {Q} "
                   "draw the parallel to {0}{2}: it meets {0}{1} in {out}.")})
def curved(d: Any, P: Any, M: Any, W0: Any) -> Any:
    """The centre of curvature C of the path of M: MC = PM^2 / MW, W being the foot of W_0 on PM."""
    u, w = require_apart(d, M, P, "the point is the pole: its path has a cusp"), vector(M, W0)
    part = d.nonzero(dot(u, w), abs(u[0] * w[0]) + abs(u[1] * w[1]), "straight-path",
                     "the point lies on the inflection circle")
    s = dot(u, u) / part
    return M[0] + s * u[0], M[1] + s * u[1]


# ---- from two points and their centres -------------------------------------------------------------------------------


def _by_circle(s: Any, P: Any, A: Any, A0: Any, B: Any, B0: Any, M: Any) -> Any:
    """W_0 by the points of the inflection circle on the two rays, then Euler and Savary once more."""
    W1, W2 = s.third(A, A0, A, P, name="W_1"), s.third(B, B0, B, P, name="W_2")
    W0 = s.meet(s.perpendicular(s.side(A, A0), W1), s.perpendicular(s.side(B, B0), W2), name="W_0")
    return s.curved(P, M, W0)


def _other_side(s: Any, P: Any, r: Any, X: Any, q: Any) -> Any:
    """The line that makes with the ray q the angle that PX makes with r: perpendicular to the line of the feet of X."""
    return s.perpendicular(s.side(s.foot(r, X), s.foot(q, X)), P)


def _bobillier(s: Any, P: Any, A: Any, A0: Any, B: Any, B0: Any, M: Any) -> Any:
    """The tangent of the centrodes makes with one ray the angle that the axis of collineation makes with the other."""
    a, b, m = s.side(A, A0), s.side(B, B0), s.side(P, M)
    Q = s.meet(s.side(A, B), s.side(A0, B0), name="Q")
    t = s.name_mark(_other_side(s, P, a, Q, b), "t")
    T = s.foot(t, A)
    axis = _other_side(s, P, a, T, m)
    R = s.meet(s.side(A, M), axis, name="R")
    return s.meet(s.side(A0, R), m)


def _hartmann(s: Any, P: Any, A: Any, A0: Any, B: Any, B0: Any, M: Any) -> Any:
    """The pole's own velocity u: its part along each point's velocity is seen from that point's centre under it."""
    a, b, m = s.side(A, A0), s.side(B, B0), s.side(P, M)
    parallels = [s.parallel(ray, s.meet(s.side(X0, s.quarter(P, X, X)), s.perpendicular(ray, P)))
                 for ray, X, X0 in ((a, A, A0), (b, B, B0))]
    U = s.meet(*parallels, name="U")
    part = s.meet(s.perpendicular(m, P), s.parallel(m, U))
    return s.meet(s.side(s.quarter(P, M, M), part), m)


@primitive((POINT, POINT, POINT, POINT, POINT, POINT), POINT, SET_SQUARES,
           "From the pole {0}, the points {1} and {3} and the centres of curvature {2} and {4} of their paths mark "
           "{out}, the centre of curvature of the path of {5}.",
           claims=(("along", (5, -1), (5, 0)), ("conjugate", 0, 1, 2, 3, 4, 5)),
           fails=("points-coincide", "lines-parallel", "straight-path"), weighed=True,
           source="Bobillier 1830; Hartmann 1893; Ozols 1974, 5-1", forms={
               EULER: _by_circle,
               "Bobillier": _bobillier,
               "Hartmann": _hartmann},
           by_form={
               EULER: phrase("On the rays {1}{2} and {3}{4} mark {W_1} and {W_2} of the inflection circle, by third "
                             "proportionals; the perpendiculars to the rays there meet in {W_0}. By Euler and Savary "
                             "mark {out} on the ray {0}{5}."),
               "Bobillier": phrase("Bobillier: mark {Q} where {1}{3} meets {2}{4}; {0}{Q} makes with one ray the angle "
                                   "that {t}, the tangent of the centrodes, makes with the other. So find the axis "
                                   "of {1} and {5}; it meets {1}{5} in {R}, and {2}{R} meets the ray {0}{5} in {out}."),
               "Hartmann": phrase("Hartmann: lay off the velocities of {1} and {3}, turning about {0}; the lines from "
                                  "their ends to {2} and {4} cut off at {0} the parts of the pole's own velocity, "
                                  "its end {U}. Its part along the velocity of {5} gives {out} in the same way.")})
def conjugate(d: Any, P: Any, A: Any, A0: Any, B: Any, B0: Any, M: Any) -> Any:
    """The centre of curvature of the path of M, from two points with the centres of theirs, all on rays through P."""
    a, b = (require_apart(d, P, X, "a point with a known centre is the pole") for X in (A, B))
    one, two = (dot(ray, vector(P, third(d, X, X0, P, X))) for ray, X, X0 in ((a, A, A0), (b, B, B0)))
    sine = d.nonzero(cross(a, b), abs(a[0] * b[1]) + abs(a[1] * b[0]), "lines-parallel", "the two rays are one line")
    W0 = P[0] + (one * b[1] - two * a[1]) / sine, P[1] + (two * a[0] - one * b[0]) / sine
    return curved(d, P, M, W0)


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SCALE,
           "Measure {0}{1} and v, from {2} to {3}, and compute v²/{0}{1}; from {4} lay it off the way from {0} to {1}: "
           "mark {out}.",
           claims=(("along", (4, -1), (0, 1)), ("away", (4, -1), (0, 1)), ("mean", 0, 1, 2, 3, 4)),
           fails=("points-coincide",), afar=((0, 1), (2, 3)), movement=Movement.MEASURED, sizing=Sizing.QUOTIENT,
           source="Ozols 1974, 5-3: a^n = v²/l", likewise={"": phrase(
               "Likewise v²/{0}{1}, v from {2} to {3}: from {4}, the way from {0} to {1}, {out}.")})
def computed_normal(d: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    """The end a of the vector ka = v^2/KA the way from K to A, laid off as it is computed from KA and v, the length mw.
    """
    u, v = require_apart(d, K, A, "the two joints coincide"), vector(m, w)
    s = dot(v, v) / dot(u, u)
    return k[0] + s * u[0], k[1] + s * u[1]


def _normal_by_computing(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    """v far shorter or longer than KA: v^2/KA, as long as it would be on the link, cannot be drawn there."""
    drawable = s.drawable(A, s.distance(m, w) ** 2 / s.distance(K, A))
    return None if drawable else s.computed_normal(K, A, m, w, k)


def _normal_by_semicircle(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
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
               "equal lengths": lambda s, K, A, m, w, k: s.transfer(K, A, k) if s.equal(K, A, m, w) else None,
               "computed": _normal_by_computing,
               "semicircle": _normal_by_semicircle,
               "companion": _companion},
           before={
               "semicircle": phrase("On {0}{1} draw the semicircle; about {1} strike the arc through it with the "
                                    "opening from {2} to {3}: {D}. From there drop the perpendicular on {0}{1}: "
                                    "foot {E}."),
               "companion": phrase("At {0} draw the perpendicular to {0}{1}; about {1} strike the arc through it with "
                                   "the opening from {2} to {3}: {D}. At {D} draw the perpendicular to the line "
                                   "through {1} and {D}: it meets {0}{1} in {E}.")},
           likewise=dict.fromkeys(("semicircle", "companion"), phrase(
               "Likewise on {0}{1}, about {1} with the opening from {2} to {3}: {D}, {E}; from {4}, {E} to {1}: "
               "{out}.")))
def normal(d: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    """The end a of the vector ka = v^2/KA, parallel to KA and away from k, v being the length mw.

    So the vector from k to a is the relative normal acceleration of K about A; that of A about K runs back.
    """
    return computed_normal(d, K, A, m, w, k)


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
