"""Images and loci: similar figures, and where the end of a point's vector must lie.

An image is parallel to its link on a plan of orthogonal velocities, a quarter turned on the plans of accelerations and
of true velocities: `turn` says which, "parallel" or "perpendicular". A rule is one line of thought that holds in every
pose; how the same thing is drawn is the matter of its forms. Names such as "Q" are letters that a recipe may give.

The value is that of Newton's method from where the linkage is known to be, with the matrix of that pose: the residues
are reckoned in whatever numbers there are, so each round leaves as many digits more as the matrix has.

On one side that is a circle, where a bar holds it; else the path of a point of a linkage that is driven by one of its
bars: plans of it are drawn in positions near the one that is looked for, and a curve through the places of the joint.
Its value is the crossing of the true paths; the curve through four plans is off that by a known, small vector.

Source: Ozols 1974, section 5-2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import product
from typing import Any, NamedTuple, Self

from graphplan.errors import Undrawable
from graphplan.kernel.elementary import cross, dot, require_apart, vector, vector_size
from graphplan.kernel.kinds import (
    CIRCLE,
    COMPASSES,
    LINE,
    PENCIL,
    POINT,
    SET_SQUARES,
    STRAIGHTEDGE,
    TABLE,
    Form,
    Movement,
    Variant,
    primitive,
)
from graphplan.kernel.numbers import Floats
from graphplan.kernel.positions import Angle
from graphplan.kernel.tolerances import CLOSURE_TOL, LOCUS_STEP, LOCUS_TOL
from graphplan.phrases import digits, phrase, said


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


KNOWN, AT_REST = Variant("auxiliary point", "that is known"), Variant("auxiliary point", "at rest")
TRIAL_LAWS = {
    "trial figure": said("similar figures with sides of these directions and two corners on the loci have their third "
                         "corners on one line; where the loci meet the figure is a point"),
    **dict.fromkeys(("two trial figures", "two trial figures further out"), said(
        "similar figures with sides of these directions and two corners on the loci have their third corners on one "
        "line"))}


def _line_of_image(s: Any, alpha: Any, A: Any, turn: str) -> Any:
    """The line of the link through A whose image is alpha: drawn already if alpha was made from it."""
    op, args = s.made_by(alpha)
    if op == turn:
        op_home, through = s.made_by(args[0])
        if op_home == "line" and any(P is A for P in through):
            return args[0]
    return getattr(s, turn)(alpha, A)


def _auxiliary_point(known: bool, at_rest: bool = False) -> Form:
    """By an auxiliary point that is a new one or known, or one whose end is itself: the pole of the link."""

    def draw_locus(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
        y, z = s.name_mark(_line_of_image(s, alpha, A, turn), "y"), s.name_mark(_line_of_image(s, beta, B, turn), "z")
        Q = s.meet(y, z, name="Q")
        is_known = not s.is_new(Q)
        q = s.meet(alpha, beta)
        if (is_known, q.step.index == Q.step.index) != (known, at_rest):
            return None
        return getattr(s, turn)(s.side(Q, C), q if at_rest else s.name_mark(q, "q"))

    return draw_locus


def _trial_start(s: Any, A: Any, alpha: Any, B: Any) -> tuple[Any, Any] | None:
    """The place on a locus where a trial figure begins, and its size: the link's, or on another plan that of the drawn
    figure; None if no mark of that plan lies on the locus."""
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


def _one_trial(ratio: float) -> Form:
    """A trial figure, and that of no size where the loci meet: the trial is so far from there that it is drawn well."""

    def draw_locus(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
        U = s.meet(alpha, beta, name="U")
        far = s.clear_of(U) if s.on_sheet(U) else None
        start = _trial_start(s, A, alpha, B) if far is None else (U, far)
        if start is None:
            return None
        return s.line(_trial(s, start, A, alpha, B, beta, C, turn, ratio, "'"), U)  # as true as the nearer of them

    return draw_locus


def _two_trials(*ratios: float) -> Form:
    """Two trial figures, which need no crossing of the loci."""

    def draw_locus(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
        if (start := _trial_start(s, A, alpha, B)) is None:
            return None
        return s.side(*(_trial(s, start, A, alpha, B, beta, C, turn, ratio, "'" * n)
                        for n, ratio in enumerate(ratios, 1)))

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
               AT_REST: _auxiliary_point(known=False, at_rest=True),
               KNOWN: _auxiliary_point(known=True),
               "auxiliary point": _auxiliary_point(known=False),
               "trial figure": _one_trial(0.35),
               Variant("trial figure", "on the other side"): _one_trial(-0.35),
               "two trial figures": _two_trials(0.3, -0.3),
               "two trial figures further out": _two_trials(0.7, 0.2)},
           by_form={
               "auxiliary point": phrase("{Q} is where {y} meets {z}: mark {q} where {1} meets {3}, through it draw "
                                         "{out}, {turn} to {Q}{4}."),
               KNOWN: phrase("Mark {q} where {1} meets {3}, through it draw {out}, {turn} to {Q}{4}."),
               AT_REST: phrase("Mark {Q} where {y} meets {z}: the pole of the link, at rest. Draw {out}."),
               "trial figure": phrase("Mark {U} where {1} meets {3}. Trial figure, its corners {A'} on {1} and {B'} on "
                                      "{3}, its sides {turn} to the link's: through {U} and its third corner {C'} draw "
                                      "{out}."),
               **dict.fromkeys(("two trial figures", "two trial figures further out"), phrase(
                   "Two trial figures, their corners {A'} and {A''} on {1}, {B'} and {B''} on {3}, their sides {turn} "
                   "to the link's: through their third corners {C'} and {C''} draw {out}."))},
           likewise={"auxiliary point": phrase("Likewise {Q}, where {y} meets {z}, {q}, where {1} meets {3}, through "
                                               "it {out}, {turn} to {Q}{4}."),
                     KNOWN: phrase("Likewise {q}, where {1} meets {3}, through it {out}, {turn} to {Q}{4}."),
                     AT_REST: phrase("Likewise {Q}, where {y} meets {z}, at rest, and {out}.")},
           reasons=TRIAL_LAWS)
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
    gap = d.nonzero(e1 - e2, abs(e1) + abs(e2), "trials-agree", "both trial figures have the same error")
    return A1[0] + e1 / gap * u[0], A1[1] + e1 / gap * u[1]


Vector = tuple[Any, Any]


class PlacedPin(NamedTuple):
    """A point of a body, by its place in the body's figure, lies in an outer joint, by its number."""

    body: int
    at: Vector
    joint: int


class Hinge(NamedTuple):
    """Points of two bodies are one."""

    body: int
    at: Vector
    other: int
    there: Vector


class PlacedGuide(NamedTuple):
    """A point of another body slides along the line of a body through a place, and the two turn alike; `there` is the
    point, and `ray` the guide's direction, in the other body's figure."""

    body: int
    at: Vector
    way: Vector
    other: int
    there: Vector
    ray: Vector


class Attitude(NamedTuple):
    """Position of a body: its figure's origin, and the cosine and sine of its turn."""

    x: Any
    y: Any
    cos: Any
    sin: Any

    def turn_vector(self, u: Vector) -> Vector:
        return self.cos * u[0] - self.sin * u[1], self.sin * u[0] + self.cos * u[1]

    def place_point(self, p: Vector) -> Vector:
        u, v = self.turn_vector(p)
        return self.x + u, self.y + v


class Closure(str):
    """The pairs of a group of bodies, and the pose in which it is known to close, named by its links.

    `joints` are by name the body of a joint and its place there.
    """

    pairs: tuple[PlacedPin | Hinge | PlacedGuide, ...]
    start: tuple[Attitude, ...]
    joints: dict[str, tuple[int, Vector]]
    _inverse: list[list[float]]

    def __new__(cls, links: str, pairs: Sequence[PlacedPin | Hinge | PlacedGuide], start: Sequence[Attitude],
                joints: dict[str, tuple[int, Vector]]) -> Self:
        self = super().__new__(cls, links)
        self.pairs, self.start, self.joints = tuple(pairs), tuple(start), joints
        self._inverse = []
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Closure, (str(self), self.pairs, self.start, self.joints)

    @property
    def square(self) -> bool:
        """Whether its pairs state as much as its bodies have ways to move."""
        return 2 * len(self.pairs) == 3 * len(self.start)

    @property
    def inverse(self) -> list[list[float]]:
        """The matrix that turns residuals into corrections (x, y and turn of each body), for the known pose; raises
        ZeroDivisionError if that is singular."""
        if not self._inverse:
            self._inverse = inverse_matrix([row for pair in self.pairs for row in _rows(pair, self.start)])
        return self._inverse

    def residues(self, pose: Sequence[Attitude], joints: Sequence[Vector], lift: Any) -> list[Any]:
        """Residuals of the pairs in a pose."""
        return [residue for pair in self.pairs for residue in _residuals(pair, pose, joints, lift)]


def _residuals(pair: PlacedPin | Hinge | PlacedGuide, pose: Sequence[Attitude], joints: Sequence[Vector],
               lift: Any) -> Iterator[Any]:
    def lift_vector(u: Vector) -> Vector:
        return lift(u[0]), lift(u[1])

    x, y = pose[pair.body].place_point(lift_vector(pair.at))
    if isinstance(pair, PlacedPin):
        u, v = joints[pair.joint]
        yield from (x - u, y - v)
        return
    u, v = pose[pair.other].place_point(lift_vector(pair.there))
    if isinstance(pair, Hinge):
        yield from (x - u, y - v)
        return
    a, b = pose[pair.body].turn_vector(lift_vector(pair.way))
    c, d = pose[pair.other].turn_vector(lift_vector(pair.ray))
    yield a * (v - y) - b * (u - x)
    yield a * d - b * c


def _rows(pair: PlacedPin | Hinge | PlacedGuide, pose: Sequence[Attitude]) -> Iterator[dict[int, float]]:
    """The derivatives of what a pair leaves open by x, y and turn of the bodies, in floats."""
    def plain(u: Vector) -> tuple[float, float]:
        return float(u[0]), float(u[1])

    i = 3 * pair.body
    p = pose[pair.body].turn_vector(plain(pair.at))
    rows = [{i: 1.0, i + 2: -p[1]}, {i + 1: 1.0, i + 2: p[0]}]
    if isinstance(pair, PlacedPin):
        yield from rows
        return
    j = 3 * pair.other
    q = pose[pair.other].turn_vector(plain(pair.there))
    others = [{j: 1.0, j + 2: -q[1]}, {j + 1: 1.0, j + 2: q[0]}]
    if isinstance(pair, Hinge):
        yield from ({**one, **{k: -w for k, w in two.items()}} for one, two in zip(rows, others, strict=True))
        return
    a, b = pose[pair.body].turn_vector(plain(pair.way))
    c, d = pose[pair.other].turn_vector(plain(pair.ray))
    (x, y), (u, v) = pose[pair.body].place_point(plain(pair.at)), pose[pair.other].place_point(plain(pair.there))
    across = {j: -b, j + 1: a, j + 2: a * q[0] + b * q[1], i: b, i + 1: -a}
    yield {**across, i + 2: -a * p[0] - b * p[1] - b * (v - y) - a * (u - x)}
    yield {i + 2: -b * d - a * c, j + 2: a * c + b * d}


def inverse_matrix(rows: Sequence[dict[int, float]]) -> list[list[float]]:
    """The inverse of a square matrix, its rows given sparsely; raises ZeroDivisionError if it is singular."""
    n = len(rows)
    table = [[row.get(k, 0.0) for k in range(n)] + [float(k == i) for k in range(n)] for i, row in enumerate(rows)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(table[i][k]))
        table[k], table[best] = table[best], table[k]
        head = [value / table[k][k] for value in table[k]]
        table[k] = head
        for i in range(n):
            if i != k and table[i][k]:
                factor = table[i][k]
                table[i] = [value - factor * top for value, top in zip(table[i], head, strict=True)]
    return [row[n:] for row in table]


def close_group(d: Any, joints: Sequence[Vector], group: Closure) -> list[Attitude]:
    """The pose in which a group closes on these outer joints, near the one that is known."""
    try:
        inverse = [[d.lift(value) for value in row] for row in group.inverse]
    except ZeroDivisionError:
        nothing = d.nonzero(0 * joints[0][0], d.lift(1), "circles-miss", "the group's links are in a limit position")
        return [Attitude(nothing, nothing, nothing, nothing) for _ in group.start]
    pose = [_normalize_turn(d, Attitude(*map(d.lift, lies))) for lies in group.start]
    corrections: list[Any] = []
    for _ in range(d.rounds):
        pose = [_normalize_turn(d, Attitude(*map(d.middle, lies))) for lies in pose]
        left = group.residues(pose, joints, d.lift)
        corrections = [dot_all(row, left) for row in inverse]
        pose = [_apply_correction(lies, *corrections[3 * i:3 * i + 3]) for i, lies in enumerate(pose)]
    size = sum((abs(x) + abs(y) for x, y in joints), d.lift(0))
    last = sum((abs(one) for one in corrections), d.lift(0))
    d.sqrt(size * d.lift(CLOSURE_TOL) - last, "circles-miss", "the lengths of the group's links do not close")
    return pose


def dot_all(row: Sequence[Any], left: Sequence[Any]) -> Any:
    """The sum of the products of two rows, added in order: from Python 3.12 on `sum` rounds otherwise than arrays."""
    total = row[0] * left[0]
    for one, two in zip(row[1:], left[1:], strict=True):
        total = total + one * two
    return total


def _normalize_turn(d: Any, lies: Attitude) -> Attitude:
    """A body as it is known to lie, its turn no longer and no shorter than 1 in better numbers."""
    x, y, cos, sin = lies
    length = d.sqrt(cos * cos + sin * sin, "not-rational", "the turn of a link is irrational")
    return Attitude(x, y, cos / length, sin / length)


def _apply_correction(lies: Attitude, x: Any, y: Any, turn: Any) -> Attitude:
    """Correct a body: turn it back by an angle, by the half-angle formula to third order, so that its lengths stay."""
    t = turn / 2
    whole = 1 + t * t
    c, s = (1 - t * t) / whole, (2 * t) / whole
    return Attitude(lies.x - x, lies.y - y, lies.cos * c + lies.sin * s, lies.sin * c - lies.cos * s)


SPACING = 12.0, 8.0, 4.0, 2.0, 1.0  # degrees between plans, the widest first that serves
NODES = -1.0, 0.0, 1.0, 2.0  # of the parameter, at the plans
FLOATS = Floats()


class Curve(str):
    """A curve through four points: the parameters of its crossings, and the error of the cubic there; `slopes` turn
    residuals into corrections."""

    at: tuple[float, ...]
    off: tuple[Vector, ...]
    slopes: tuple[tuple[float, ...], ...]

    def __new__(cls, name: str, at: Sequence[float], off: Sequence[Vector], slopes: Sequence[Sequence[float]]) -> Self:
        self = super().__new__(cls, name)
        self.at, self.off, self.slopes = tuple(at), tuple(off), tuple(map(tuple, slopes))
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Curve, (str(self), self.at, self.off, self.slopes)


def cubic_point(d: Any, plans: Sequence[Any], u: Any) -> Vector:
    """The place at a parameter on the cubic through four points."""
    weights = []
    for k, node in enumerate(NODES):
        weight = d.lift(1)
        for other in NODES[:k] + NODES[k + 1:]:
            weight = weight * (u - d.lift(other)) / d.lift(node - other)
        weights.append(weight)
    return dot_all(weights, [P[0] for P in plans]), dot_all(weights, [P[1] for P in plans])


def cubic_direction(plans: Sequence[Any], u: float) -> Vector:
    """Direction of the cubic at a parameter."""
    (x, y), (v, w) = (cubic_point(FLOATS, plans, u + off) for off in (-LOCUS_STEP, LOCUS_STEP))
    return (v - x) / (2 * LOCUS_STEP), (w - y) / (2 * LOCUS_STEP)


@primitive((POINT, POINT, POINT, POINT, CIRCLE), POINT, PENCIL,
           "Draw {curve} through {0}, {1}, {2} and {3}: it meets {4} in {out}.", claims=(("on", 4), ("fair", 0)),
           params=("curve",), movement=Movement.TRACED)
def curve_meets_circle(d: Any, P: Any, Q: Any, R: Any, S: Any, c: Any, /, *, curve: Curve) -> Any:
    """Intersection of a curve through four points with a circle near a known place, to first order."""
    u, (dx, dy) = d.lift(curve.at[0]), map(d.lift, curve.off[0])
    x, y = cubic_point(d, (P, Q, R, S), u)
    arm = (x + dx - c[0], y + dy - c[1])
    x, y = cubic_point(d, (P, Q, R, S), u - d.lift(curve.slopes[0][0]) * (dot(arm, arm) - c[2]))
    return x + dx, y + dy


@primitive((POINT,) * 8, POINT, PENCIL,
           "Draw {curve} through {0}, {1}, {2} and {3}, and one through {4}, {5}, {6} and {7}: they cross in {out}.",
           claims=(("fair", 0), ("fair", 1)), params=("curve",), movement=Movement.TRACES_MET)
def curves_meet(d: Any, *plans: Any, curve: Curve) -> Any:
    """Intersection of two curves near a known place, each through four points, to first order."""
    u, w = map(d.lift, curve.at)
    (a, b), (e, f) = (tuple(map(d.lift, off)) for off in curve.off)
    i, j = map(d.lift, curve.slopes[0])
    (x, y), (v, z) = cubic_point(d, plans[:4], u), cubic_point(d, plans[4:], w)
    gap = x + a - v - e, y + b - z - f
    x, y = cubic_point(d, plans[:4], u - i * gap[0] - j * gap[1])
    return x + a, y + b


class Side(NamedTuple):
    """One side of a group whose joint is freed: its bodies, and the joint's place on one of them."""

    bodies: tuple[int, ...]
    body: int
    at: Vector


def sides(group: Closure, joint: str) -> list[Side]:
    """The two parts into which a group falls when a joint is freed, each with one degree of freedom; empty if it does
    not."""
    freed, at = group.joints[joint]
    others = [(h.other, h.there) if (h.body, h.at) == (freed, at) else (h.body, h.at) for h in group.pairs
              if isinstance(h, Hinge) and ((h.body, h.at) == (freed, at) or (h.other, h.there) == (freed, at))]
    if len(others) != 1 or any(not isinstance(pair, PlacedPin | Hinge) for pair in group.pairs):
        return []
    found = [_side(group, freed, at, joint), _side(group, *others[0], joint)]
    apart = not {*found[0].bodies} & {*found[1].bodies}
    return found if apart and all(_mobility(group, side, joint) == 1 for side in found) else []


def _mobility(group: Closure, side: Side, joint: str) -> int:
    """In how many ways a side can move on the outer joints."""
    freed = group.joints[joint]
    pairs = sum(pair.body in side.bodies for pair in group.pairs
                if isinstance(pair, PlacedPin) or freed not in ((pair.body, pair.at), (pair.other, pair.there)))
    return 3 * len(side.bodies) - 2 * pairs


def _side(group: Closure, body: int, at: Vector, joint: str) -> Side:
    """All that hangs together with a body but by the joint."""
    freed, place = group.joints[joint]
    bodies = {body}
    hinges = [h for h in group.pairs if isinstance(h, Hinge)
              and (freed, place) not in ((h.body, h.at), (h.other, h.there))]
    while more := {end for h in hinges for end in (h.body, h.other) if {h.body, h.other} & bodies} - bodies:
        bodies |= more
    return Side(tuple(sorted(bodies)), body, at)


class Sketch:
    """A board without drawing: its marks are their values."""

    def __getattr__(self, verb: str) -> Any:
        return partial(TABLE[verb].rule, FLOATS)

    def place(self, P: Any) -> Any:
        return P


class SidePositions:
    """Plans of one side in several positions: its bodies are placed from a bar that is turned."""

    def __init__(self, s: Any, joints: Sequence[Any], group: Closure, pose: Sequence[Attitude], side: Side):
        self.s, self.joints, self.group, self.pose, self.side = s, joints, group, pose, side
        self.pins = {pin.body: pin for pin in group.pairs if isinstance(pin, PlacedPin) and pin.body in side.bodies}
        self.hinges = [h for h in group.pairs if isinstance(h, Hinge) and {h.body, h.other} <= {*side.bodies}]

    def circle(self) -> Any:
        """The circle of the joint, where the side is a bar."""
        pin = self.pins[self.side.body]
        return self.s.circle(self.joints[pin.joint], self._length(pin.at, self.side.at))

    def _length(self, p: Vector, q: Vector) -> Any:
        return self.s.link_length(dx=q[0] - p[0], dy=q[1] - p[1])

    def curve(self) -> tuple[list[Any], float] | None:
        """Places of the joint in four positions near the known one, and its parameter there; None if arcs do not find
        them, or no curve through them is near enough to the path."""
        sketch = SidePositions(Sketch(), [self.s.place(mark) for mark in self.joints], self.group, self.pose, self.side)
        true = self.pose[self.side.body].place_point((float(self.side.at[0]), float(self.side.at[1])))
        for (pin, hinge), spacing in product(self._cranks(), SPACING):
            x, y = self.pose[pin.body].turn_vector((float(hinge[0] - pin.at[0]), float(hinge[1] - pin.at[1])))
            now, long = math.degrees(math.atan2(y, x)), math.hypot(x, y)
            base = math.floor(now / spacing) * spacing
            angles, u = [_angle(base + node * spacing, long) for node in NODES], (now - base) / spacing
            try:
                places = [sketch.plan(pin, hinge, angle) for angle in angles]
            except Undrawable:  # links do not reach each other
                continue
            if None not in places and math.dist(true,
                                                cubic_point(FLOATS, places, u)) <= LOCUS_TOL * math.dist(*places[1:3]):
                return [self.plan(pin, hinge, angle) for angle in angles], u
        return None

    def _cranks(self) -> Iterator[tuple[PlacedPin, Vector]]:
        """The bodies that turn about an outer joint, each with another joint of it."""
        for pin in self.pins.values():
            yield from [(pin, h.at if h.body == pin.body else h.there) for h in self.hinges
                        if pin.body in (h.body, h.other)][:1]

    def plan(self, pin: PlacedPin, hinge: Vector, angle: Angle) -> Any:
        """The joint in one position; None if arcs alone do not place it."""
        known = {pin.body: [(pin.at, self.joints[pin.joint]),
                            (hinge, self.s.crank(self.joints[pin.joint], angle=angle))]}
        while self.side.body not in known:
            if not self._place_next(known):
                return None
        return self._point(known[self.side.body], self.side.at)

    def _place_next(self, known: dict[int, list[Any]]) -> bool:
        """Place the next two bodies by arcs, or one that hangs between two that are."""
        anchors = {body: self._anchors(body, known) for body in self.side.bodies if body not in known}
        for body, found in anchors.items():
            if len(found) > 1:
                known[body] = found
                return True
        single = {body: found[0] for body, found in anchors.items() if len(found) == 1}
        for h in self.hinges:
            if h.body in single and h.other in single:
                (p, P), (q, Q) = single[h.body], single[h.other]
                ends = [self.pose[body].place_point((float(at[0]), float(at[1])))
                        for body, at in ((h.body, p), (h.other, q), (h.body, h.at))]
                (x, y), (u, v), (a, b) = ends
                side = "left" if cross((u - x, v - y), (a - x, b - y)) > 0 else "right"
                met = self.s.circles_meet(self.s.circle(P, self._length(p, h.at)),
                                          self.s.circle(Q, self._length(q, h.there)), side=side)
                known[h.body], known[h.other] = [(p, P), (h.at, met)], [(q, Q), (h.there, met)]
                return True
        return False

    def _anchors(self, body: int, known: dict[int, list[Any]]) -> list[Any]:
        """The points of a body that are placed: outer joints, and those that it shares with bodies that are."""
        pins = [(pin.at, self.joints[pin.joint]) for pin in self.group.pairs if isinstance(pin, PlacedPin)
                and pin.body == body]
        hinges = [(h.at, self._point(known[h.other], h.there)) if h.body == body
                  else (h.there, self._point(known[h.body], h.at)) for h in self.hinges
                  if body in (h.body, h.other) and {h.body, h.other} & known.keys()]
        return pins + hinges

    def _point(self, placed: list[Any], at: Vector) -> Any:
        """A point of a body of which two are placed."""
        same = next((mark for place, mark in placed if place == at), None)
        if same is not None:
            return same
        (p, P), (q, Q) = placed[:2]
        return self.s.corner(P, Q, dx=at[0] - p[0], dy=at[1] - p[1], ux=q[0] - p[0], uy=q[1] - p[1])


def _angle(degrees: float, long: float) -> Angle:
    """A direction by its angle, so long."""
    turn = math.radians(degrees)
    return Angle(digits(degrees, 6), long * math.cos(turn), long * math.sin(turn))


def _loci(s: Any, *joints: Any, group: Closure, joint: str) -> Any:
    """The crossing of the two curves."""
    pose = close_group(FLOATS, [s.place(mark) for mark in joints], group)
    plans = [SidePositions(s, joints, group, pose, side) for side in sides(group, joint)]
    if not plans:
        return None
    plans.sort(key=lambda plan: len(plan.side.bodies) == 1)
    side = plans[0].side
    true = pose[side.body].place_point((float(side.at[0]), float(side.at[1])))
    bars = [plan.circle() for plan in plans if len(plan.side.bodies) == 1]
    if len(bars) == 2:
        (x, y), (u, v) = (s.place(joints[plan.pins[plan.side.body].joint]) for plan in plans)
        left = cross((u - x, v - y), (true[0] - x, true[1] - y)) > 0
        return s.circles_meet(*bars, side="left" if left else "right")
    optional_curves = [plan.curve() for plan in plans if len(plan.side.bodies) > 1]
    if any(curve is None for curve in optional_curves):
        return None
    curves = [curve for curve in optional_curves if curve is not None]
    places = [[s.place(mark) for mark in marks] for marks, _ in curves]
    offs = [tuple(t - p for t, p in zip(true, cubic_point(FLOATS, place, u), strict=True))
            for place, (_, u) in zip(places, curves, strict=True)]
    tangents = [cubic_direction(place, u) for place, (_, u) in zip(places, curves, strict=True)]
    at = [u for _, u in curves]
    if bars:
        x, y = s.place(joints[plans[1].pins[plans[1].side.body].joint])
        slope = 2 * dot((true[0] - x, true[1] - y), tangents[0])
        return s.curve_meets_circle(*curves[0][0], bars[0], curve=Curve("a curve", at, offs, [[1 / slope]]))
    (a, b), (e, f) = tangents
    whole = b * e - a * f
    slopes = [[-f / whole, e / whole]]
    return s.curves_meet(*curves[0][0], *curves[1][0], curve=Curve("a curve", at, offs, slopes))


def _enter_primitive(count: int, name: str) -> None:
    def rule(d: Any, *joints: Any, group: Closure, joint: str) -> Any:
        """The joint of a group where the lengths of all its links close on its outer joints."""
        body, at = group.joints[joint]
        return close_group(d, joints, group)[body].place_point((d.lift(at[0]), d.lift(at[1])))

    rule.__name__ = name
    listed = ", ".join(f"{{{k}}}" for k in range(count))
    primitive((POINT,) * count, POINT, COMPASSES,
              f"On {listed} let the lengths of links {{group}} close: mark {{out}}, their joint {{joint}}.",
              claims=(("closes",),), fails=("circles-miss",), params=("group", "joint"),
              source="Ozols 1974, section 5-2: method of loci", forms={"loci": _loci}, by_form={"loci": phrase(
                  "Free {joint}, draw plans of what is left on either side in positions near this one, and through its "
                  "places the curves on which it lies: they cross in {out}.")})(rule)


for number, word in ((2, "close_on_two"), (3, "close_on_three"), (4, "close_on_four")):
    _enter_primitive(number, word)
