"""Images of a link: the figures of the ends of a link's vectors.

An image is parallel to its link on a plan of orthogonal velocities, a quarter turned on the plans of accelerations and
of true velocities: `turn` says which, "parallel" or "perpendicular". A rule is one line of thought that holds in every
pose; how the same thing is drawn is the matter of its forms. Names such as "Q" are letters that a recipe may give.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from graphplan.kernel.kinds import COMPASSES, LINE, POINT, SET_SQUARES, STRAIGHTEDGE, Form, Variant, primitive
from graphplan.kernel.primitives import cross, dot, require_apart, vector, vector_size
from graphplan.phrases import phrase


def _image_direction(u: Any, turn: str) -> Any:
    return u if turn == "parallel" else (-u[1], u[0])


def _sides(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any, *, turn: str) -> Any:
    side = getattr(s, turn)
    return None if s.in_line(A, B, C) else s.meet(side(s.side(A, C), a), side(s.side(B, C), b))


def _foot_and_side(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any, *, turn: str) -> Any:
    if s.in_line(A, B, C):
        return None
    f = s.divide(A, B, s.foot(s.side(A, B), C), a, b)
    return s.meet(s.perpendicular(s.side(a, b), f), getattr(s, turn)(s.side(B, C), b))


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, SET_SQUARES,
           "On {3}{4} draw the figure similar to {0}{1}{2}, its sides {turn}: mark {out}.",
           claims=(("image", 0, 1, 3, 4), ("image", 0, 2, 3, -1), ("image", 1, 2, 4, -1), ("likeness", 0, 1, 2, 3, 4)),
           fails=("points-coincide",), params=("turn",), afar=((0, 1, 2),),
           source="Rosenauer 1939, No. 14; Ozols 1974, 5-2", forms={
               "at a corner": lambda s, A, B, C, a, b, turn:
                   a if s.points_coincide(A, C) or s.points_coincide(a, b) else b if s.points_coincide(B, C) else None,
               "sides": _sides,
               "foot and side": _foot_and_side,
               "ratio": lambda s, A, B, C, a, b, turn: s.divide(A, B, C, a, b) if s.in_line(A, B, C) else None},
           by_form={
               "sides": phrase("Through {3} and {4} draw the lines {turn} to {0}{2} and {1}{2}: they meet in {out}.")},
           likewise={"sides": phrase("Likewise {out}, through {3} and {4} {turn} to {0}{2} and {1}{2}.")})
def similar(d: Any, A: Any, B: Any, C: Any, a: Any, b: Any, /, *, turn: str) -> Any:
    """The image of a third point of a link of which two points' images are known."""
    u = require_apart(d, A, B)
    s = dot(vector(a, b), _image_direction(u, turn)) / dot(u, u)
    w = _image_direction(vector(A, C), turn)
    return a[0] + s * w[0], a[1] + s * w[1]


def _scaled_on_the_link(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any) -> Any:
    """The side ab is laid off on AB, and the figure there cut down to it; its sides are taken back by the compasses."""
    E = s.line_meets_circle(s.side(A, B), s.circle(A, s.opening(a, b)), way="on", name="E")
    F = s.meet(s.parallel(s.side(B, C), E), s.side(A, C), name="F")
    arcs = s.circle(a, s.opening(A, F)), s.circle(b, s.opening(E, F))
    return s.circles_meet(*arcs, side=s.side_of(A, B, C))


def _scaled_on_the_plan(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any) -> Any:
    """The link's triangle is drawn on the ray ab by the compasses, and grown or cut down to ab by a parallel."""
    E = s.line_meets_circle(s.side(a, b), s.circle(a, s.opening(A, B)), way="on", name="E")
    arcs = s.circle(a, s.opening(A, C)), s.circle(E, s.opening(B, C))
    F = s.circles_meet(*arcs, side=s.side_of(A, B, C), name="F")
    return s.meet(s.parallel(s.side(E, F), b), s.side(a, F))


@primitive((POINT, POINT, POINT, POINT, POINT), POINT, COMPASSES,
           "On the way from {3} to {4} draw the triangle similar to {0}{1}{2}, with the same sense: mark {out}.",
           claims=(("shaped", 0, 1, 2, 3, 4),), fails=("points-coincide",), afar=((0, 1, 2),),
           source="Jaanimets 1966, section 11", forms={
               "at a corner": lambda s, A, B, C, a, b:
                   a if s.points_coincide(A, C) or s.points_coincide(a, b) else b if s.points_coincide(B, C) else None,
               "on the link": _scaled_on_the_link,
               "on the plan": _scaled_on_the_plan,
               "ratio": lambda s, A, B, C, a, b: s.divide(A, B, C, a, b) if s.in_line(A, B, C) else None},
           by_form={
               "on the link": phrase("With the openings from {0} to {F} and from {E} to {F} strike arcs about {3} and "
                                     "{4}: they meet in {out}."),
               "on the plan": phrase("From {3} lay off {0}{1} towards {4}: {E}; with the openings {0}{2} and {1}{2} "
                                     "strike arcs about {3} and {E}: they meet in {F}. Through {4} draw the parallel "
                                     "to {E}{F}: it meets the line through {3} and {F} in {out}.")},
           before={"on the link": phrase("On {0}{1} lay off from {0} the distance of {3} and {4}: {E}; through {E} "
                                         "draw the parallel to {1}{2}: it meets {0}{2} in {F}.")})
def triangle(d: Any, A: Any, B: Any, C: Any, a: Any, b: Any) -> Any:
    """The third corner of the triangle on ab that is similar to ABC and has its sense."""
    u, v, w = require_apart(d, A, B), vector(A, C), vector(a, b)
    square = dot(u, u)
    along, aside = dot(u, v) / square, cross(u, v) / square
    return a[0] + along * w[0] - aside * w[1], a[1] + along * w[1] + aside * w[0]


# ---- loci of a link with two facts -----------------------------------------------------------------------------------


def _line_of_image(s: Any, alpha: Any, A: Any, turn: str) -> Any:
    """The line of the link through A whose image is alpha: drawn already if alpha was made from it."""
    op, args = s.made_by(alpha)
    if op == turn:
        op_home, through = s.made_by(args[0])
        if op_home == "line" and any(P is A for P in through):
            return args[0]
    return getattr(s, turn)(alpha, A)


def _auxiliary_point(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
    y, z = s.name_mark(_line_of_image(s, alpha, A, turn), "y"), s.name_mark(_line_of_image(s, beta, B, turn), "z")
    Q = s.meet(y, z, name="Q")
    q = s.meet(alpha, beta, name="q")
    return getattr(s, turn)(s.side(Q, C), q)


def _trial_start(s: Any, A: Any, alpha: Any, B: Any) -> tuple[Any, Any] | None:
    """Where on a locus a trial figure begins, and how large it is: as the link, or on another plan as what is drawn;
    nowhere, where no mark of that plan lies on the locus."""
    if s.share_plan(alpha, A):
        return A, B
    points = s.points_on(alpha)
    if not points:
        return None
    start = next(filter(s.on_sheet, points), points[0])
    far = s.clear_of(start)
    return start, s.transfer(A, B, start) if far is None else far


def _trial(s: Any, start: tuple[Any, Any], A: Any, alpha: Any, B: Any, beta: Any, C: Any, turn: str, ratio: float,
           mark: str) -> Any:
    """The image of C in one trial figure, its side A'B' fitted between the loci."""
    a = s.pick(alpha, *start, *start, ratio=ratio / 2, name="A" + mark)
    b = s.meet(getattr(s, turn)(s.side(A, B), a), beta, name="B" + mark)
    return s.similar(A, B, C, a, b, turn=turn, name="C" + mark)


def _trials(*ratios: float) -> Form:
    """Two trial figures, or one and the figure of no size where the loci meet."""

    def draw_locus(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
        if (start := _trial_start(s, A, alpha, B)) is None:
            return None
        ends = [_trial(s, start, A, alpha, B, beta, C, turn, ratio, "'" * n) for n, ratio in enumerate(ratios, 1)]
        return s.side(*ends) if len(ends) == 2 else s.side(s.meet(alpha, beta, name="U"), *ends)

    return draw_locus


@primitive((POINT, LINE, POINT, LINE, POINT), LINE, STRAIGHTEDGE,
           "From the loci {1} of {0} and {3} of {2}, draw the locus {out} of the image of {4}, a "
           "point of their link, the image's sides {turn}.",
           claims=(("locus", 0, 1, 2, 3, 4),), fails=("locus-undetermined",), params=("turn",),
           source="Rosenauer 1939, No. 14: auxiliary points Q, R and trial triangle", where=1, afar=((0, 2, 4),),
           weighed=True, described="the locus of the end of {4}", forms={
               "the same point": lambda s, A, alpha, B, beta, C, turn:
                   alpha if s.points_coincide(A, C) else beta if s.points_coincide(B, C) else None,
               "the same line": lambda s, A, alpha, B, beta, C, turn:
                   alpha if s.in_line(A, B, C) and s.lines_coincide(alpha, beta) else None,
               "auxiliary point": _auxiliary_point,
               "trial figure": _trials(0.35),
               Variant("trial figure", "on the other side"): _trials(-0.35),
               "two trial figures": _trials(0.3, -0.3),
               "two trial figures further out": _trials(0.7, 0.2)},
           by_form={
               "auxiliary point": phrase("{Q} is where {y} meets {z}: mark {q} where {1} meets {3}, through it draw "
                                         "{out}, {turn} to {Q}{4}."),
               "trial figure": phrase("Mark {U} where {1} meets {3}. Trial figure, its corners {A'} on {1} and {B'} on "
                                      "{3}, its sides {turn} to the link's: through {U} and its third corner {C'} draw "
                                      "{out}."),
               **dict.fromkeys(("two trial figures", "two trial figures further out"), phrase(
                   "Two trial figures, their corners {A'} and {A''} on {1}, {B'} and {B''} on {3}, their sides {turn} "
                   "to the link's: through their third corners {C'} and {C''} draw {out}."))},
           likewise={"auxiliary point": phrase("Likewise {Q}, where {y} meets {z}, {q}, where {1} meets {3}, through "
                                               "it {out}, {turn} to {Q}{4}.")})
def carry(d: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, /, *, turn: str) -> Any:
    """The locus of a third point's image, where the images of two points of the link lie on known lines.

    Image C' = A' + s CA (turned): eliminating s from both incidences leaves a line of the pencil of alpha and beta.
    No intersection is formed, so it holds where the auxiliary point is far away or nowhere.
    """
    u, v = _image_direction(vector(C, A), turn), _image_direction(vector(C, B), turn)
    one, two = dot(alpha, u), dot(beta, v)
    a, b, c = (two * p - one * q for p, q in zip(alpha, beta, strict=True))
    reach = (vector_size(alpha) * vector_size(beta)) * (vector_size(u) + vector_size(v))
    whole = d.nonzero(abs(a) + abs(b), reach, "locus-undetermined", "the pole of the link lies in the point itself")
    return a / whole, b / whole, c / whole


def _other_locus(s: Any, C: Any, c: Any, A: Any, alpha: Any, B: Any, beta: Any, *, turn: str) -> Any:
    b = s.meet(getattr(s, turn)(s.side(C, B), c), beta, name="b")
    return s.similar(C, B, A, c, b, turn=turn)


@primitive((POINT, POINT, POINT, LINE, POINT, LINE), POINT, SET_SQUARES,
           "From {1}, the image of {0}, and the loci {3} of {2} and {5} of {4}, mark {out}, the image of {2}, "
           "the image's sides {turn}.",
           claims=(("on", 3), ("image", 0, 2, 1, -1), ("carried", 0, 2, 4, 1, 5)),
           fails=("lines-parallel",), params=("turn",), afar=((0, 2, 4),), forms={
               "the same point": lambda s, C, c, A, alpha, B, beta, turn: c if s.points_coincide(C, A) else None,
               "its own locus": lambda s, C, c, A, alpha, B, beta, turn:
                   s.meet(getattr(s, turn)(s.side(C, A), c), alpha),
               "the other locus": _other_locus},
           by_form={
               "its own locus": phrase("Through {1} draw the line {turn} to {0}{2}: it meets {3} in {out}."),
               "the other locus": phrase("Through {1} draw the line {turn} to {0}{4}: it meets {5} in {b}. From {1} to "
                                         "{b} draw the figure similar to {0}{4}{2}: mark {out}.")},
           likewise={"its own locus": phrase("Likewise through {1}, {turn} to {0}{2}: {out} on {3}.")})
def settle(d: Any, C: Any, c: Any, A: Any, alpha: Any, B: Any, beta: Any, /, *, turn: str) -> Any:
    """The image of A, where the image of C is known and both A and B of the same link have a locus.

    Either locus alone would do; weighing both by what they can tell keeps the value good where one of them cannot.
    """
    u, v = _image_direction(vector(C, A), turn), _image_direction(vector(C, B), turn)
    m, n, p, q = dot(alpha, alpha), dot(beta, beta), dot(alpha, u), dot(beta, v)
    e, f = dot(alpha, c) + alpha[2], dot(beta, c) + beta[2]
    told = abs(p) / vector_size(alpha) + abs(q) / vector_size(beta)
    d.nonzero(told, vector_size(u) + vector_size(v), "lines-parallel",
              "neither locus meets the line through the known image")
    s = -(p * e / m + q * f / n) / (p * p / m + q * q / n)
    return c[0] + s * u[0], c[1] + s * u[1]


# ---- false position --------------------------------------------------------------------------------------------------


def _ordinates(carry: str, s: Any, A1: Any, A2: Any, Z1: Any, l1: Any, Z2: Any, l2: Any) -> Any:
    """The errors of the trials, as ordinates over their points."""
    E1, E2 = (getattr(s, carry)(s.foot(l, Z), Z, A) for l, Z, A in ((l1, Z1, A1), (l2, Z2, A2)))
    return s.meet(s.side(A1, A2), s.side(E1, E2))


@primitive((POINT, POINT, POINT, LINE, POINT, LINE), POINT, STRAIGHTEDGE,
           "Trial {0} leaves {2} off {3}, trial {1} leaves {4} off {5}: by false position mark {out}, which leaves "
           "no error.", claims=(("alike", 3, 5), ("along", (0, -1), (0, 1)), ("balanced", 0, 1, 2, 3, 4, 5)),
           fails=("points-coincide", "trials-agree"), source="false position; Rosenauer 1939, No. 14", where=0,
           afar=((2, 3, 4, 5),), method="false position", forms={
               "a trial that fits": lambda s, A1, A2, Z1, l1, Z2, l2:
                   A1 if s.lies_on(Z1, l1) else A2 if s.lies_on(Z2, l2) else None,
               "errors as ordinates": partial(_ordinates, "transfer"),
               "errors as ordinates, turned": partial(_ordinates, "quarter")})
def false_position(d: Any, A1: Any, A2: Any, Z1: Any, l1: Any, Z2: Any, l2: Any) -> Any:
    """The point of A1A2 for which Z falls on its line, from the errors of two trials; both lines are parallel."""
    u = require_apart(d, A1, A2, "both trials begin in one point")
    e1 = dot(l1, Z1) + l1[2]
    e2 = (dot(l2, Z2) + l2[2]) * (dot(l1, l2) / dot(l2, l2))
    gap = d.nonzero(e1 - e2, abs(e1) + abs(e2), "trials-agree", "both trial figures miss by the same amount")
    return A1[0] + e1 / gap * u[0], A1[1] + e1 / gap * u[1]
