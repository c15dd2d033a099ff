"""Functions of travel as polynomials between their breaks: integrals, roots and extremes to rounding.

A function is sampled at the nodes of Gauss and Legendre in panels between breaks, many nodes in one call; a panel is
halved until the last terms of its Legendre series, or what they add to the integral, are rounding alone. From then on
nothing is constructed any more: the series is integrated term by term and evaluated anywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial.legendre import leggauss, legint, legval, legvander

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals, bisect, distinct_values
from graphplan.machines.tolerances import COUNT_TOL, SERIES_TOL, SIGN_TOL

NODES = 16  # of a panel: a full turn of a linkage takes one to four dozen panels
MIN_PANELS = 8  # panels at least in the whole range, that no wave passes between the nodes
MAX_PANELS, MAX_HALVINGS = 4096, 64  # panels, and times that one is halved: what needs more has no limit somewhere
TAIL_TERMS = 3  # terms at the end of a series that tell how far it is from settled
SIGN_SAMPLES = 24  # places in a panel between which a sign is seen to change


@dataclass(frozen=True, eq=False)
class Piecewise:
    """A function of travel, or several of the same panels: series of Legendre polynomials between edges.

    `edges` have the shape (p+1,), `terms` (..., p, n): where there are several functions, iterating gives each.
    """

    edges: Reals
    terms: Reals

    def __iter__(self) -> Iterator[Piecewise]:
        return (replace(self, terms=terms) for terms in self.terms)

    def __add__(self, other: Piecewise | float) -> Piecewise:
        """The sum with another of the same panels, or with a constant."""
        if isinstance(other, Piecewise):
            more, own_terms = sorted((self.terms, other.terms), key=lambda terms: -terms.shape[-1])
            terms = more.copy()
            terms[..., :own_terms.shape[-1]] += own_terms
        else:
            terms = self.terms.copy()
            terms[..., 0] += other
        return replace(self, terms=terms)

    def __mul__(self, factor: float) -> Piecewise:
        return replace(self, terms=self.terms * factor)

    def at(self, travel: npt.ArrayLike, side: int = 1) -> Reals:
        """The values at travels, shape (..., n); at an edge those from the right, or from the left with `side` -1."""
        x = np.asarray(travel, dtype=float)
        panel = np.searchsorted(self.edges, x, side="right" if side > 0 else "left") - 1
        return self._in_panel(np.clip(panel, 0, len(self.edges) - 2), x)

    def _in_panel(self, panel: Any, travel: Reals) -> Reals:
        """The values at travels by the series of these panels."""
        low, high = self.edges[panel], self.edges[panel + 1]
        places, terms = (2 * travel - low - high) / (high - low), np.moveaxis(self.terms[..., panel, :], -1, 0)
        values: Reals = legval(places, terms, tensor=False)
        return values

    def without_rounding(self, size: npt.ArrayLike) -> Piecewise:
        """Return the functions, each zero if it is rounding relative to a size, shape () or (k,)."""
        largest = np.abs(self.terms).max(axis=(-2, -1), initial=0.0)
        is_kept = (largest > SERIES_TOL * np.asarray(size))[..., None, None]
        return replace(self, terms=np.where(is_kept, self.terms, 0.0))

    @property
    def total_integral(self) -> Reals:
        """The integral over the whole range, shape (...)."""
        integral: Reals = self.terms[..., 0] @ np.diff(self.edges)
        return integral

    def integral(self) -> Piecewise:
        """The integral from the first edge on, of the same panels."""
        terms = legint(self.terms, lbnd=-1, axis=-1) * np.diff(self.edges)[:, None] / 2
        terms[..., 1:, 0] += np.cumsum(terms.sum(axis=-1), axis=-1)[..., :-1]  # all polynomials are 1 at the right end
        return replace(self, terms=terms)

    def roots(self) -> Reals:
        """The travels at which it changes its sign, those of jumps too, in their order; of one function."""
        grid, panels = np.linspace(-1, 1, SIGN_SAMPLES + 1), len(self.edges) - 1
        low, high = self.edges[:-1, None], self.edges[1:, None]
        places, values = ((low + high) / 2 + (high - low) / 2 * grid).ravel(), legval(grid, self.terms.T).ravel()
        signs = np.where(np.abs(values) > SIGN_TOL * np.abs(values).max(), np.sign(values), 0.0)
        nonzero = np.flatnonzero(signs)
        changed = signs[nonzero[:-1]] != signs[nonzero[1:]]
        first, last = nonzero[:-1][changed], nonzero[1:][changed]
        panel = np.repeat(np.arange(panels), SIGN_SAMPLES + 1)
        inside = (last == first + 1) & (panel[first] == panel[last])
        roots: Reals = places[np.minimum(first + 1, last)]  # where it jumps, or is 0 between the two
        k, before = panel[first[inside]], signs[first[inside]] > 0
        roots[inside], _ = bisect(lambda travel: (self._in_panel(k, travel) > 0) == before, places[first[inside]],
                                  places[last[inside]])
        return roots

    def extremes(self, slope: Piecewise) -> tuple[tuple[float, float], tuple[float, float]]:
        """The least and the largest value, each with its travel, the first of equals; `slope` is the derivative."""
        places = distinct_values(np.concatenate([slope.roots(), self.edges]))
        left, right = self.at(places, -1), self.at(places, 1)
        least, most = np.minimum(left, right), np.maximum(left, right)
        close = SIGN_TOL * max(most.max(), -least.min())
        down, up = np.argmax(least <= least.min() + close), np.argmax(most >= most.max() - close)
        return (float(places[down]), float(least.min())), (float(places[up]), float(most.max()))


def fit_piecewise(function: Callable[[Reals], Reals], breaks: Sequence[float], size: npt.ArrayLike = 0.0) -> Piecewise:
    """A function of travel as polynomials between breaks, to rounding of its largest value, or of `size`.

    Reads a function of travels of shape (n,), which gives (n,) or, of several functions at once, (k, n); two or more
    breaks that grow, between which it is smooth (corners that are not named cost panels and not accuracy); and, of a
    function in which larger numbers cancel, how large these are, shape () or (k,): what is rounding beside them is 0.
    Fails with `Refused` where the values have no limit, or are none.
    """
    waiting = first_panels(breaks)
    whole, fitted, count = float(waiting[-1, 1] - waiting[0, 0]), list[tuple[Reals, Reals]](), 0
    for _ in range(MAX_HALVINGS):
        terms = panel_series(function, waiting)
        if not fitted:
            limit = SERIES_TOL * np.maximum(size, np.abs(terms).max(axis=(-2, -1)))[..., None]
        tail, widths = np.abs(terms[..., -TAIL_TERMS:]).max(axis=-1), (waiting[:, 1] - waiting[:, 0]) / whole
        fine = ((tail <= limit) | (tail * widths <= limit / 16)).reshape(-1, len(waiting)).all(axis=0)
        fitted.append((waiting[fine], terms[..., fine, :]))
        count, rough = count + len(waiting), waiting[~fine]
        if not len(rough):
            return join_panels(fitted).without_rounding(size)
        if count > MAX_PANELS:
            break
        waiting = halve_panels(rough)
    raise Refused(f"travel {rough[0].mean():.6g}", "the reduced moment or inertia diverges there (limit position)",
                  "a range without a limit position")


def first_panels(breaks: Sequence[float]) -> Reals:
    """The first panels, shape (p, 2)."""
    edges = distinct_values(np.asarray(breaks, dtype=float))
    counts = np.ceil(np.diff(edges) / (edges[-1] - edges[0]) * MIN_PANELS - COUNT_TOL).astype(int)
    rows = [np.linspace(low, high, count + 1) for low, high, count in zip(edges, edges[1:], counts, strict=False)]
    return np.concatenate([np.stack([row[:-1], row[1:]], axis=1) for row in rows])


def halve_panels(panels: Reals) -> Reals:
    """Panels halved."""
    middles = panels.mean(axis=1)
    return np.concatenate([np.stack([panels[:, 0], middles], axis=1), np.stack([middles, panels[:, 1]], axis=1)])


def panel_series(function: Callable[[Reals], Reals], panels: Reals) -> Reals:
    """The terms of the function's series in panels, shape (..., p, n)."""
    nodes, matrix = gauss_rule()
    places = panels.mean(axis=1)[:, None] + (panels[:, 1] - panels[:, 0])[:, None] / 2 * nodes
    values = np.asarray(function(places.ravel()), dtype=float)
    if not np.isfinite(values).all():
        bad = places.ravel()[~np.isfinite(values).reshape(-1, places.size).all(axis=0)][0]
        raise Refused(f"travel {bad:.6g}", "the reduced moment or inertia is unknown there",
                      "a range that can be reached")
    series: Reals = values.reshape(*values.shape[:-1], *places.shape) @ matrix
    return series


def join_panels(kept: Sequence[tuple[Reals, Reals]]) -> Piecewise:
    """The panels in the order of travel."""
    panels = np.concatenate([panels for panels, _ in kept])
    terms, order = np.concatenate([terms for _, terms in kept], axis=-2), np.argsort(panels[:, 0])
    panels = panels[order]
    return Piecewise(np.append(panels[:, 0], panels[-1, 1]), terms[..., order, :])


def gauss_rule() -> tuple[Reals, Reals]:
    """The nodes of a panel, and what makes the terms of a series of the values there."""
    nodes, weights = leggauss(NODES)
    return nodes, weights[:, None] * legvander(nodes, NODES - 1) * (np.arange(NODES) + 0.5)
