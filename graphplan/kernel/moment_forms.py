"""How moments about an auxiliary point are drawn: through it; or, where it lies off the sheet, by resolving a force."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphplan.kernel import moments  # noqa: F401  (forms extend the records made there)
from graphplan.kernel.kinds import form


@form("towards", "along one of them")
def _(s: Any, y: Any, z: Any, X: Any) -> Any:
    return y if s.lies_on(X, y) else z if s.lies_on(X, z) else None


@form("towards", "auxiliary point")
def _(s: Any, y: Any, z: Any, X: Any) -> Any:
    return s.line(s.meet(y, z, name="Q"), X)


def _similar_triangles(one: float, two: float) -> Callable[..., Any]:
    """Two similar triangles between the lines: their third corners lie on a line to where the lines meet."""

    def drawn(s: Any, y: Any, z: Any, X: Any) -> Any:
        far = s.clear_of(X)
        if far is None:
            return None
        P, R, P2 = s.pick(y, X, far, ratio=one), s.pick(z, X, far, ratio=one / 3), s.pick(y, X, far, ratio=two)
        R2 = s.meet(s.parallel(s.line(P, R), P2), z)
        return s.line(X, s.meet(s.parallel(s.line(P, X), P2), s.parallel(s.line(R, X), R2)))

    return drawn


form("towards", "similar triangles")(_similar_triangles(0.15, 0.5))
form("towards", "similar triangles, backwards")(_similar_triangles(-0.15, -0.5))
form("weigh", "auxiliary point")(lambda s, y, z, X, C, p, q, m: s.balance(s.meet(y, z, name="Q"), X, C, p, q, m))


@form("weigh", "resolution")
def _(s: Any, y: Any, z: Any, X: Any, C: Any, p: Any, q: Any, m: Any) -> Any:
    """The part of the force towards the distant point has no moment; the part towards X is moved there."""
    part = s.meet(s.parallel(s.side(C, X), p), s.parallel(s.towards(y, z, C), q))
    return s.foot(s.parallel(s.towards(y, z, X), s.transfer(part, p, m)), m)


@form("weigh", "its part across")
def _(s: Any, y: Any, z: Any, X: Any, C: Any, p: Any, q: Any, m: Any) -> Any:
    """At X itself, or with both ways parallel, the part of the force across the way to the distant point counts."""
    return s.transfer(q, s.foot(s.parallel(s.towards(y, z, X), p), q), m)
