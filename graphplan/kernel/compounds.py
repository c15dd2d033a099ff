"""The compounds of the table: what a draughtsman does in several movements, each with the rule for its value.

A rule is one line of thought that holds in every pose; how the same thing is drawn is the matter of `forms`.
"Image" means the figure of the ends of a link's vectors: parallel to the link on a plan of orthogonal velocities,
a quarter turned on the plans of accelerations and of true velocities. `turn` says which: "parallel" or "perpendicular".
"""

from __future__ import annotations

from typing import Any

from graphplan.kernel.kinds import COMPASSES, DIVIDERS, LINE, POINT, SET_SQUARES, STRAIGHTEDGE, Movement, primitive


def _vector(P: Any, Q: Any) -> Any:
    return Q[0] - P[0], Q[1] - P[1]


def _dot(u: Any, v: Any) -> Any:
    return u[0] * v[0] + u[1] * v[1]


def _size(u: Any) -> Any:
    return abs(u[0]) + abs(u[1])


def _apart(d: Any, P: Any, Q: Any, why: str = "the two points coincide") -> Any:
    """The vector of two points that must not coincide."""
    u = _vector(P, Q)
    d.nonzero(_size(u), _size(P) + _size(Q), "points-coincide", why)
    return u


def _turned(u: Any, turn: str) -> Any:
    return u if turn == "parallel" else (-u[1], u[0])


@primitive((POINT, POINT), LINE, COMPASSES, "Draw {out}, the perpendicular bisector of {0}{1}.",
           claims=(("halfway", 0, 1),), fails=("points-coincide",),
           movement=Movement.BISECTED)
def bisector(d: Any, P: Any, Q: Any) -> Any:
    """The perpendicular bisector of two points, running a quarter turn counter-clockwise of the first to the second."""
    u = _apart(d, P, Q)
    return -u[0], -u[1], (u[0] * (P[0] + Q[0]) + u[1] * (P[1] + Q[1])) / 2


@primitive((POINT, POINT), POINT, COMPASSES, "Halve the distance from {0} to {1}: mark {out}.",
           claims=(("same", (0, -1), (-1, 1)),),
           movement=Movement.HALVED)
def midpoint(d: Any, P: Any, Q: Any) -> Any:
    """The point halfway between two points."""
    return (P[0] + Q[0]) / 2, (P[1] + Q[1]) / 2


@primitive((LINE, POINT), POINT, SET_SQUARES, "From {1} drop the perpendicular on {0}: mark its foot {out}.",
           claims=(("on", 0), ("upright", 0, 1)),
           movement=Movement.DROPPED)
def foot(d: Any, l: Any, P: Any) -> Any:
    """The foot of the perpendicular from a point to a line."""
    off = (l[0] * P[0] + l[1] * P[1] + l[2]) / (l[0] * l[0] + l[1] * l[1])
    return P[0] - l[0] * off, P[1] - l[1] * off


@primitive((POINT, POINT, POINT), POINT, DIVIDERS, "From {2} lay off the vector from {0} to {1}: mark {out}.",
           claims=(("same", (0, 1), (2, -1)),),
           movement=Movement.LAID_OFF, afar=(0, 1))
def transfer(d: Any, P: Any, Q: Any, R: Any) -> Any:
    """The vector PQ laid off from R."""
    return R[0] + (Q[0] - P[0]), R[1] + (Q[1] - P[1])


@primitive((POINT, POINT, POINT), POINT, DIVIDERS, "From {2} lay off the vector from {0} to {1}, turned a quarter "
           "counter-clockwise: mark {out}.", claims=(("quarter", (0, 1), (2, -1)),),
           movement=Movement.TURNED, afar=(0, 1))
def quarter(d: Any, P: Any, Q: Any, R: Any) -> Any:
    """The vector PQ, turned a quarter counter-clockwise, laid off from R."""
    return R[0] - (Q[1] - P[1]), R[1] + (Q[0] - P[0])


@primitive((LINE, POINT, POINT), LINE, SET_SQUARES, "Shift {0} by the vector from {1} to {2}: draw {out}.",
           claims=(("parallel", 0), ("shifted", 0, 1, 2)), where=0)
def shift(d: Any, l: Any, P: Any, Q: Any) -> Any:
    """A line moved by the vector PQ."""
    return l[0], l[1], l[2] - (l[0] * (Q[0] - P[0]) + l[1] * (Q[1] - P[1]))


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SET_SQUARES,
           "Divide {3}{4} in {out} as {2} divides {0}{1}.",
           claims=(("along", (0, 2), (0, 1)), ("along", (3, -1), (3, 4)), ("proportion", 0, 1, 2, 3, 4)),
           fails=("points-coincide",))
def divide(d: Any, A: Any, B: Any, C: Any, P: Any, Q: Any) -> Any:
    """The point of PQ that divides it as C divides AB; A, B, C lie on one line."""
    u = _apart(d, A, B)
    t = _dot(_vector(A, C), u) / _dot(u, u)
    return P[0] + t * (Q[0] - P[0]), P[1] + t * (Q[1] - P[1])


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SET_SQUARES,
           "On {3}{4} draw the figure similar to {0}{1}{2}, its sides {turn}: mark {out}.",
           claims=(("image", 0, 1, 3, 4), ("image", 0, 2, 3, -1), ("image", 1, 2, 4, -1), ("likeness", 0, 1, 2, 3, 4)),
           fails=("points-coincide",), params=("turn",),
           source="Rosenauer 1939, No. 14; Ozols 1974, 5-2")
def similar(d: Any, A: Any, B: Any, C: Any, a: Any, b: Any, /, *, turn: str) -> Any:
    """The image of a third point of a link of which two points' images are known."""
    u = _apart(d, A, B)
    s = _dot(_vector(a, b), _turned(u, turn)) / _dot(u, u)
    w = _turned(_vector(A, C), turn)
    return a[0] + s * w[0], a[1] + s * w[1]


@primitive((POINT, LINE, POINT, LINE, POINT), LINE, STRAIGHTEDGE,
           "From the loci {1} of {0} and {3} of {2}, draw the locus {out} of the image of {4}, a "
           "point of their link, the image's sides {turn}.",
           claims=(("locus", 0, 1, 2, 3, 4),), fails=("locus-undetermined",), params=("turn",),
           source="Rosenauer 1939, No. 14: auxiliary points Q, R and trial triangle", where=1,
           weighed=True, described="the locus of the end of {4}")
def carry(d: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, /, *, turn: str) -> Any:
    """The locus of a third point's image, where the images of two points of the link lie on known lines.

    Image C' = A' + s CA (turned): eliminating s from both incidences leaves a line of the pencil of alpha and beta.
    No intersection is formed, so it holds where the auxiliary point is far away or nowhere.
    """
    u, v = _turned(_vector(C, A), turn), _turned(_vector(C, B), turn)
    one, two = alpha[0] * u[0] + alpha[1] * u[1], beta[0] * v[0] + beta[1] * v[1]
    a, b, c = (two * p - one * q for p, q in zip(alpha, beta, strict=True))
    reach = (_size(alpha) * _size(beta)) * (_size(u) + _size(v))
    size = d.nonzero(abs(a) + abs(b), reach, "locus-undetermined", "the pole of the link lies in the point itself")
    return a / size, b / size, c / size


@primitive((POINT, POINT, POINT, LINE, POINT, LINE), POINT, SET_SQUARES,
           "From {1}, the image of {0}, and the loci {3} of {2} and {5} of {4}, mark {out}, the image of {2}, "
           "the image's sides {turn}.",
           claims=(("on", 3), ("image", 0, 2, 1, -1), ("carried", 0, 2, 4, 1, 5)),
           fails=("lines-parallel",), params=("turn",))
def settle(d: Any, C: Any, c: Any, A: Any, alpha: Any, B: Any, beta: Any, /, *, turn: str) -> Any:
    """The image of A, where the image of C is known and both A and B of the same link have a locus.

    Either locus alone would do; weighing both by what they can tell keeps the value good where one of them cannot.
    """
    u, v = _turned(_vector(C, A), turn), _turned(_vector(C, B), turn)
    m, n = alpha[0] * alpha[0] + alpha[1] * alpha[1], beta[0] * beta[0] + beta[1] * beta[1]
    p, q = alpha[0] * u[0] + alpha[1] * u[1], beta[0] * v[0] + beta[1] * v[1]
    e, f = alpha[0] * c[0] + alpha[1] * c[1] + alpha[2], beta[0] * c[0] + beta[1] * c[1] + beta[2]
    told = abs(p) / _size(alpha) + abs(q) / _size(beta)
    d.nonzero(told, _size(u) + _size(v), "lines-parallel", "neither locus meets the line through the known image")
    s = -(p * e / m + q * f / n) / (p * p / m + q * q / n)
    return c[0] + s * u[0], c[1] + s * u[1]


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, COMPASSES,
           "Construct the relative normal acceleration of {1} about {0} by the relative velocity from {2} to {3}; "
           "from {4} lay it off: mark {out}.",
           claims=(("along", (4, -1), (0, 1)), ("away", (4, -1), (0, 1)), ("mean", 0, 1, 2, 3, 4)),
           fails=("points-coincide",), source="Rosenauer 1939, No. 14; Ozols 1974, 5-3, fig. 5-22")
def normal(d: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    """The end a of the vector ka = v^2/KA, parallel to KA and away from k, v being the length mw.

    The relative normal acceleration of A about K is then the vector from a to k.
    """
    u, v = _apart(d, K, A, "the two joints coincide"), _vector(m, w)
    s = _dot(v, v) / _dot(u, u)
    return k[0] + s * u[0], k[1] + s * u[1]


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SET_SQUARES,
           "Construct half the Coriolis vector at {1} from the orthogonal relative velocity, from {1} to {3}, and "
           "that of the guide's turning about {0}, from {1} to {2}; from {4} lay it off twice, reversed: mark {out}.",
           claims=(("along", (1, 2), (1, 0)), ("coriolis", 0, 1, 2, 3, 4)), fails=("points-coincide",),
           source="Ozols 1974, 5-3, fig. 5-24",
           weighed=True)
def coriolis(d: Any, P: Any, B: Any, T: Any, R: Any, b: Any) -> Any:
    """The point b less the Coriolis vector: BT/BP is the guide's turning, BR the orthogonal relative velocity."""
    u = _apart(d, B, P, "the pole of the guide lies in the pair")
    s = 2 * _dot(_vector(B, T), u) / _dot(u, u)
    return b[0] - s * (R[0] - B[0]), b[1] - s * (R[1] - B[1])


@primitive((POINT, POINT, POINT, LINE, POINT, LINE), POINT, STRAIGHTEDGE,
           "Trial {0} leaves {2} off {3}, trial {1} leaves {4} off {5}: by false position mark {out}, which leaves "
           "nothing.", claims=(("alike", 3, 5), ("along", (0, -1), (0, 1)), ("balanced", 0, 1, 2, 3, 4, 5)),
           fails=("points-coincide", "trials-agree"), source="false position; Rosenauer 1939, No. 14", where=0,
           method="false position")
def false_position(d: Any, A1: Any, A2: Any, Z1: Any, l1: Any, Z2: Any, l2: Any) -> Any:
    """The point of A1A2 for which Z falls on its line, from the errors of two trials; both lines are parallel."""
    u = _apart(d, A1, A2, "both trials begin in one point")
    scale = (l1[0] * l2[0] + l1[1] * l2[1]) / (l2[0] * l2[0] + l2[1] * l2[1])
    e1 = l1[0] * Z1[0] + l1[1] * Z1[1] + l1[2]
    e2 = (l2[0] * Z2[0] + l2[1] * Z2[1] + l2[2]) * scale
    gap = d.nonzero(e1 - e2, abs(e1) + abs(e2), "trials-agree", "both trial figures miss by the same amount")
    return A1[0] + e1 / gap * u[0], A1[1] + e1 / gap * u[1]
