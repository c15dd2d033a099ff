"""How vectors of accelerations are drawn from those of velocities, and how a false position is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphplan.kernel import compounds  # noqa: F401  (forms extend the records made there)
from graphplan.kernel.kinds import form

# ---- accelerations ------------------------------------------------------------------------------------------


def _semicircle(side: str) -> Callable[..., Any]:
    """v < KA: the velocity is a leg, KA the hypotenuse; the leg's projection on KA is v^2/KA."""

    def drawn(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
        M = s.midpoint(K, A)
        D = s.circles_meet(s.circle(M, s.opening(M, A)), s.circle(A, s.opening(m, w)), side=side)
        return s.transfer(s.foot(s.side(K, A), D), A, k)

    return drawn


def _companion(way: str) -> Callable[..., Any]:
    """v > KA: the velocity is a leg, KA its projection; the hypotenuse is v^2/KA."""

    def drawn(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
        KA = s.side(K, A)
        arc = s.circle(A, s.opening(m, w))
        D = s.line_meets_circle(s.perpendicular(KA, K), arc, way=way)
        E = s.meet(KA, s.perpendicular(s.side(A, D), D))
        return s.transfer(E, A, k)

    return drawn


@form("normal", "nothing to draw")
def _(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    return k if s.one(m, w) else None


form("normal", "semicircle")(_semicircle("left"))
form("normal", "companion")(_companion("on"))


@form("normal", "equal lengths")
def _(s: Any, K: Any, A: Any, m: Any, w: Any, k: Any) -> Any:
    return s.transfer(K, A, k) if s.equal(K, A, m, w) else None


def _laid_off_twice(s: Any, B: Any, half: Any, b: Any) -> Any:
    return s.transfer(half, B, s.transfer(half, B, b))


@form("coriolis", "nothing to draw")
def _(s: Any, P: Any, B: Any, T: Any, R: Any, b: Any) -> Any:
    return b if s.one(B, T) or s.one(B, R) else None


@form("coriolis", "at the pair")
def _(s: Any, P: Any, B: Any, T: Any, R: Any, b: Any) -> Any:
    half = s.meet(s.parallel(s.side(R, P), T), s.side(B, R), name="K")
    return _laid_off_twice(s, B, half, b)


@form("coriolis", "at another point of the guide's link")
def _(s: Any, P: Any, B: Any, T: Any, R: Any, b: Any) -> Any:
    D, T1 = s.quarter(B, P, B), s.quarter(B, T, B)
    half = s.meet(s.parallel(s.side(R, D), T1), s.side(B, R), name="K")
    return _laid_off_twice(s, B, half, b)


# ---- false position -----------------------------------------------------------------------------------------


@form("false_position", "a trial that fits")
def _(s: Any, A1: Any, A2: Any, Z1: Any, l1: Any, Z2: Any, l2: Any) -> Any:
    return A1 if s.lies_on(Z1, l1) else A2 if s.lies_on(Z2, l2) else None


@form("false_position", "errors as ordinates")
def _(s: Any, A1: Any, A2: Any, Z1: Any, l1: Any, Z2: Any, l2: Any) -> Any:
    E1, E2 = s.transfer(s.foot(l1, Z1), Z1, A1), s.transfer(s.foot(l2, Z2), Z2, A2)
    return s.meet(s.side(A1, A2), s.side(E1, E2))


@form("false_position", "errors as ordinates, turned")
def _(s: Any, A1: Any, A2: Any, Z1: Any, l1: Any, Z2: Any, l2: Any) -> Any:
    E1, E2 = s.quarter(s.foot(l1, Z1), Z1, A1), s.quarter(s.foot(l2, Z2), Z2, A2)
    return s.meet(s.side(A1, A2), s.side(E1, E2))
