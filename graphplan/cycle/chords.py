"""Graphical differentiation and integration with a pole: recipes for the drawing board.

A diagram is drawn in mm over the axis of time, the diagram of its rate under it over the same abscissas. A ray from the
rate's pole, HO left of the origin, is parallel to a chord of the upper diagram; it cuts off HO times the chord's slope
on the axis of ordinates. Read from the chord to the ordinate this differentiates, from the ordinate to the chord it
integrates, so both give rays of one kind, and with mu the units for one mm: mu_v = mu_s/(mu_t HO).

Sources: Jaanimets 1966, 10-13 (chords, ordinates to the middle of the strip, and back by integration); Ozols 1974,
fig. 15-3 and 20-2 (integration), and (5.33) of 5-6 (tangents: his text of the drawing is lost, so it is reconstructed
from the formula, the tangent being drawn parallel to the chord over the two neighbouring strips).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Generic, NamedTuple, TypeVar

from graphplan.kernel.program import Board, Mark, Panel

T = TypeVar("T")


class Ray(NamedTuple, Generic[T]):
    """One ray from the pole: the ends of the chord parallel to it, its cut on the axis, and the ordinate there."""

    start: T
    end: T
    cut: T
    ordinate: T


@dataclass(frozen=True)
class Axes:
    """The axes of one rate's diagram and its pole."""

    origin: Mark
    abscissas: Mark
    ordinates: Mark
    pole: Mark


def axes(board: Board, panel: Panel, letter: str, distance: Fraction) -> Axes:
    """The axes of the diagram of `letter`, its pole at the given distance left of the origin."""
    with board.on(panel=panel):
        O = board.begin(plan=panel, number=1, name=f"O_{letter}")
    t = board.guide(O, dx=1, dy=0, why="the axis of time")
    y = board.perpendicular(t, O, why=f"the axis of {letter}")
    H = board.lay_off(O, dx=-distance, dy=0, name=f"H_{letter}", why="the pole: its distance sets the scale")
    return Axes(O, t, y, H)


def by_chords(board: Board, points: Sequence[Mark], rate: Axes, names: Sequence[str]) -> list[Ray[Mark]]:
    """The rate in the middle of each strip, from the strip's chord.

    Reads the n points of a diagram, the rate's axes and n - 1 names. The chord's slope is the mean rate of the strip,
    which differs from the rate at its middle by the second order of its width.
    """
    return [_differentiated(board, P, Q, board.midpoint(P, Q), rate, name)
            for (P, Q), name in zip(pairwise(points), names, strict=True)]


def by_tangents(board: Board, points: Sequence[Mark], rate: Axes, names: Sequence[str]) -> list[Ray[Mark]]:
    """The rate at each inner point, the tangent there drawn parallel to the chord of its two neighbours.

    Reads the n points of a diagram, evenly divided, the rate's axes and n - 2 names.
    """
    return [_differentiated(board, P, Q, at, rate, name)
            for P, at, Q, name in zip(points, points[1:], points[2:], names, strict=False)]


def _differentiated(board: Board, P: Mark, Q: Mark, at: Mark, rate: Axes, name: str) -> Ray[Mark]:
    chord = board.line(P, Q, why="its slope is the mean rate")
    ray = board.parallel(chord, rate.pole, why="the ray of this slope")
    cut = board.meet(ray, rate.ordinates, why="HO times the slope")
    level = board.parallel(rate.abscissas, cut, why="carry the ordinate across")
    upright = board.parallel(rate.ordinates, at, why="to the abscissa where the rate is such")
    return Ray(P, Q, cut, board.meet(upright, level, name=name))


def integrate(
    board: Board, ordinates: Sequence[Mark], start: Mark, divisions: Sequence[Mark], rate: Axes, names: Sequence[str],
) -> list[Ray[Mark]]:
    """The diagram of which the rate is known: a string of chords from `start`, each parallel to its strip's ray.

    Reads the rate's ordinates at the middle of n strips, the first point, marks at the n + 1 abscissas that bound the
    strips, the rate's axes and n names.
    """
    rays, P = list[Ray[Mark]](), start
    for V, division, name in zip(ordinates, divisions[1:], names, strict=True):
        level = board.parallel(rate.abscissas, V, why="carry the mean ordinate of the strip to the axis")
        cut = board.meet(level, rate.ordinates)
        ray = board.line(rate.pole, cut, why="its slope is the ordinate by HO")
        chord = board.parallel(ray, P, why="on from the end of the chord before")
        upright = board.parallel(rate.ordinates, division, why="to the end of the strip")
        Q = board.meet(upright, chord, name=name)
        rays.append(Ray(P, Q, cut, V))
        P = Q
    return rays


def around(board: Board, points: Sequence[Mark], period: tuple[Mark, Mark], shared: int) -> list[Mark]:
    """The points of a periodic diagram with one more at either end, carried over by the vector of the period.

    `period` are the first and last point of one period; `shared` is 1 where they are points of the diagram, else 0.
    """
    first, last = period
    before = board.transfer(last, first, points[-1 - shared], why="the motion is periodic")
    after = board.transfer(first, last, points[shared], why="the motion is periodic")
    return [before, *points, after]


def feet(board: Board, points: Sequence[Mark], rate: Axes) -> list[Mark]:
    """The abscissas of the points, marked on the rate's axis of time."""
    uprights = [board.parallel(rate.ordinates, P, why="down to the axis of time") for P in points]
    return [board.meet(upright, rate.abscissas) for upright in uprights]
