"""How each compound is drawn: its forms, in the order in which a textbook would try them.

A form that needs a branch (which crossing of an arc, which side) stands once for each; the pose decides which of them
gives the right value. A form that is not for this pose gives nothing: where a vector has no length, nothing is drawn.
`s` is the board; names such as "Q" are letters that the recipe may have given for them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphplan.kernel import compounds, primitives  # noqa: F401  (forms extend the records made there)
from graphplan.kernel.kinds import form

# ---- straightedge and compasses -----------------------------------------------------------------------------


@form("bisector", "arcs")
def _(s: Any, P: Any, Q: Any) -> Any:
    o = s.opening(P, Q)
    p, q = s.circle(P, o), s.circle(Q, o)
    return s.line(s.circles_meet(p, q, side="right"), s.circles_meet(p, q, side="left"))


@form("midpoint", "one point")
def _(s: Any, P: Any, Q: Any) -> Any:
    return P if s.one(P, Q) else None


@form("midpoint", "arcs")
def _(s: Any, P: Any, Q: Any) -> Any:
    return s.meet(s.line(P, Q), s.bisector(P, Q))


@form("foot", "the point itself")
def _(s: Any, l: Any, P: Any) -> Any:
    return P if s.lies_on(P, l) else None


@form("foot", "perpendicular")
def _(s: Any, l: Any, P: Any) -> Any:
    return s.meet(l, s.perpendicular(l, P))


@form("transfer", "nothing to draw")
def _(s: Any, P: Any, Q: Any, R: Any) -> Any:
    return R if s.one(P, Q) else Q if s.one(P, R) else None


@form("transfer", "dividers")
def _(s: Any, P: Any, Q: Any, R: Any) -> Any:
    along = s.parallel(s.line(P, Q), R)
    return s.line_meets_circle(along, s.circle(R, s.opening(P, Q)), way="on")


@form("transfer", "parallelogram")
def _(s: Any, P: Any, Q: Any, R: Any) -> Any:
    return s.meet(s.parallel(s.line(P, Q), R), s.parallel(s.line(P, R), Q))


def _fourth_corner(side: str) -> Callable[..., Any]:
    """The parallelogram on PQ and PR by two arcs."""

    def drawn(s: Any, P: Any, Q: Any, R: Any) -> Any:
        return s.circles_meet(s.circle(R, s.opening(P, Q)), s.circle(Q, s.opening(P, R)), side=side)

    return drawn


form("transfer", "two arcs, left")(_fourth_corner("left"))
form("transfer", "two arcs, right")(_fourth_corner("right"))


@form("quarter", "nothing to turn")
def _(s: Any, P: Any, Q: Any, R: Any) -> Any:
    return R if s.one(P, Q) else None


@form("quarter", "dividers")
def _(s: Any, P: Any, Q: Any, R: Any) -> Any:
    across = s.perpendicular(s.line(P, Q), R)
    return s.line_meets_circle(across, s.circle(R, s.opening(P, Q)), way="on")


# ---- perpendicular and parallel: from a point that the line is known to pass through, or from any --------------


def _known(s: Any, l: Any, P: Any) -> Any:
    return s.clear_of(P, s.points_on(l))


def _any(s: Any, l: Any, P: Any) -> Any:
    size = s.clear_of(P)
    return None if size is None else s.pick(l, P, size, ratio=0.5)


STARTS = (("", _known), (", from any point", _any))


def _erected(s: Any, l: Any, P: Any, X: Any, *, left: bool) -> Any:
    """The perpendicular through P, by the arc about P through X, a point of the line."""
    arc = s.circle(P, s.opening(P, X))
    D, E = s.line_meets_circle(l, arc, way="on"), s.line_meets_circle(l, arc, way="back")
    o = s.opening(D, E)
    d, e = s.circle(D, o), s.circle(E, o)
    ends = [s.circles_meet(e, d, side=side) for side in ("right", "left")]
    return s.line(*ends) if left else s.line(*reversed(ends))


def _arcs(start: Callable[..., Any]) -> Callable[..., Any]:
    def drawn(s: Any, l: Any, P: Any) -> Any:
        X = start(s, l, P)
        return None if X is None else _erected(s, l, P, X, left=True)

    return drawn


def _mirrored(side: str) -> Callable[..., Any]:
    """The perpendicular through P and its mirror image, by arcs through P about two points of the line."""

    def drawn(s: Any, l: Any, P: Any) -> Any:
        points = s.points_on(l)
        if s.lies_on(P, l) or len(points) < 2 or s.one(points[0], points[-1]):
            return None
        one, two = (s.circle(X, s.opening(X, P)) for X in (points[0], points[-1]))
        image = s.circles_meet(one, two, side=side)
        return s.line(image, P) if side == "right" else s.line(P, image)

    return drawn


def _rhombus(start: Callable[..., Any], side: str) -> Callable[..., Any]:
    def drawn(s: Any, l: Any, P: Any) -> Any:
        X = start(s, l, P)
        if X is None or s.lies_on(P, l):
            return None
        o = s.opening(X, P)
        Y = s.line_meets_circle(l, s.circle(X, o), way="on")
        return s.line(P, s.circles_meet(s.circle(P, o), s.circle(Y, o), side=side))

    return drawn


form("perpendicular", "mirror image on the right")(_mirrored("right"))
form("perpendicular", "mirror image on the left")(_mirrored("left"))
for _words, _start in STARTS:
    form("perpendicular", "arcs" + _words)(_arcs(_start))


@form("parallel", "the line itself")
def _(s: Any, l: Any, P: Any) -> Any:
    return l if s.lies_on(P, l) else None


for _words, _start in STARTS:
    for _side in ("left", "right"):
        form("parallel", f"rhombus on the {_side}{_words}")(_rhombus(_start, _side))


@form("parallel", "two perpendiculars")
def _(s: Any, l: Any, P: Any) -> Any:
    across = s.perpendicular(l, P)
    X = _known(s, across, P)
    X = _any(s, across, P) if X is None else X
    return None if X is None else _erected(s, across, P, X, left=False)


# ---- figures in proportion ----------------------------------------------------------------------------------


def _ray(way: str) -> Callable[..., Any]:
    """Intercept theorem on a ray of its own, square to PQ, as A, B and C may lie along PQ (Ozols 1974, 5-2)."""

    def drawn(s: Any, A: Any, B: Any, C: Any, P: Any, Q: Any) -> Any:
        if s.way(A, B, C) != way:
            return None
        PQ = s.side(P, Q)
        ray = s.perpendicular(PQ, P)
        B1 = s.line_meets_circle(ray, s.circle(P, s.opening(A, B)), way="on")
        C1 = s.line_meets_circle(ray, s.circle(P, s.opening(A, C)), way=way)
        return s.meet(s.parallel(s.side(B1, Q), C1), PQ)

    return drawn


@form("divide", "at an end")
def _(s: Any, A: Any, B: Any, C: Any, P: Any, Q: Any) -> Any:
    return P if s.one(A, C) or s.one(P, Q) else Q if s.one(B, C) else None


form("divide", "ray")(_ray("on"))
form("divide", "ray, beyond")(_ray("back"))


def _on_the_link(way: str) -> Callable[..., Any]:
    """On AB itself, with PQ laid off square to it: nothing longer than AB or PQ is drawn."""

    def drawn(s: Any, A: Any, B: Any, C: Any, P: Any, Q: Any) -> Any:
        if s.way(A, B, C) != way:
            return None
        ray = s.perpendicular(s.side(A, B), A)
        Q1 = s.line_meets_circle(ray, s.circle(A, s.opening(P, Q)), way="on")
        P1 = s.meet(s.parallel(s.side(B, Q1), C), ray)
        return s.line_meets_circle(s.line(P, Q), s.circle(P, s.opening(A, P1)), way=way)

    return drawn


form("divide", "on the link")(_on_the_link("on"))
form("divide", "on the link, beyond")(_on_the_link("back"))


@form("similar", "at a corner")
def _(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any, *, turn: str) -> Any:
    return a if s.one(A, C) or s.one(a, b) else b if s.one(B, C) else None


@form("similar", "sides")
def _(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any, *, turn: str) -> Any:
    side = getattr(s, turn)
    return s.meet(side(s.side(A, C), a), side(s.side(B, C), b))


@form("similar", "centre of similitude")
def _(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any, *, turn: str) -> Any:
    S = s.meet(s.side(A, a), s.side(B, b))
    return s.meet(s.side(S, C), s.side(a, b))


@form("similar", "foot and side")
def _(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any, *, turn: str) -> Any:
    f = s.divide(A, B, s.foot(s.side(A, B), C), a, b)
    return s.meet(s.perpendicular(s.side(a, b), f), getattr(s, turn)(s.side(B, C), b))


@form("similar", "ray")
def _(s: Any, A: Any, B: Any, C: Any, a: Any, b: Any, *, turn: str) -> Any:
    return s.divide(A, B, C, a, b)


@form("shift", "nothing to draw")
def _(s: Any, l: Any, P: Any, Q: Any) -> Any:
    return l if s.one(P, Q) else None


@form("shift", "through the end")
def _(s: Any, l: Any, P: Any, Q: Any) -> Any:
    return s.parallel(l, Q)


@form("shift", "foot")
def _(s: Any, l: Any, P: Any, Q: Any) -> Any:
    return s.parallel(l, s.transfer(P, Q, s.foot(l, P)))


# ---- loci of a link with two facts --------------------------------------------------------------------------


def _home(s: Any, alpha: Any, A: Any, turn: str) -> Any:
    """The line of the link through A whose image is alpha: drawn already if alpha was made from it."""
    op, args = s.made_by(alpha)
    if op == turn:
        op_home, through = s.made_by(args[0])
        if op_home == "line" and any(P is A for P in through):
            return args[0]
    return getattr(s, turn)(alpha, A)


@form("carry", "the same point")
def _(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
    return alpha if s.one(A, C) else beta if s.one(B, C) else None


@form("carry", "auxiliary point")
def _(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
    Q = s.meet(_home(s, alpha, A, turn), _home(s, beta, B, turn), name="Q")
    q = s.meet(alpha, beta, name="q")
    return getattr(s, turn)(s.side(Q, C), q)


def _trial(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, turn: str, ratio: float, mark: str) -> Any:
    """The image of C in one trial figure, its side A'B' fitted between the loci."""
    a = s.pick(alpha, A, B, ratio=ratio, name="A" + mark)
    b = s.meet(getattr(s, turn)(s.side(A, B), a), beta, name="B" + mark)
    return s.similar(A, B, C, a, b, turn=turn, name="C" + mark)


def _one_trial(ratio: float) -> Callable[..., Any]:
    def drawn(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
        c = _trial(s, A, alpha, B, beta, C, turn, ratio, "'")
        return s.side(s.meet(alpha, beta, name="U"), c)

    return drawn


def _two_trials(one: float, two: float) -> Callable[..., Any]:
    def drawn(s: Any, A: Any, alpha: Any, B: Any, beta: Any, C: Any, *, turn: str) -> Any:
        c = _trial(s, A, alpha, B, beta, C, turn, one, "'")
        return s.side(c, _trial(s, A, alpha, B, beta, C, turn, two, "''"))

    return drawn


for _name, _at in (("", 0.35), (" on the other side", -0.35)):
    form("carry", "trial figure" + _name)(_one_trial(_at))
for _name, _pair in (("", (0.3, -0.3)), (" further out", (0.7, 0.2))):
    form("carry", "two trial figures" + _name)(_two_trials(*_pair))


@form("settle", "the same point")
def _(s: Any, C: Any, c: Any, A: Any, alpha: Any, B: Any, beta: Any, *, turn: str) -> Any:
    return c if s.one(C, A) else None


@form("settle", "its own locus")
def _(s: Any, C: Any, c: Any, A: Any, alpha: Any, B: Any, beta: Any, *, turn: str) -> Any:
    return s.meet(getattr(s, turn)(s.side(C, A), c), alpha)


@form("settle", "the other locus")
def _(s: Any, C: Any, c: Any, A: Any, alpha: Any, B: Any, beta: Any, *, turn: str) -> Any:
    b = s.meet(getattr(s, turn)(s.side(C, B), c), beta)
    return s.similar(C, B, A, c, b, turn=turn)
