"""Diagrams on paper: round divisions, shared abscissae, curves through their points."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from graphplan.output.graphs import Figures, Graph, PolarGraph, divisions, scale_words, smooth_line, stack_graphs
from graphplan.sheet.lettering.lettering import SMALL_SHEET
from graphplan.sheet.plates.display import Arrow, Rect
from graphplan.words.tongue import ENGLISH


@pytest.mark.parametrize(("low", "high", "most", "turns", "first", "step"), [
    (0, 360, 12, True, 0, 30), (0, 360, 12, False, 0, 50), (-0.013, 0.021, 8, False, -0.01, 0.005),
    (13, 88, 4, False, 20, 20), (0, 90, 5, True, 0, 30), (-700, -300, 3, False, -600, 200)])
def test_divisions_are_round(low: float, high: float, most: float, turns: bool, first: float, step: float) -> None:
    """Divisions are evenly apart by 1, 2 or 5 of a power of ten, or parts of a turn, and no more than there is room."""
    found = divisions(low, high, most, turns)
    assert found[0] == pytest.approx(first)
    assert all(b - a == pytest.approx(step) for a, b in pairwise(found))
    assert len(found) <= most + 1
    assert found[-1] <= high + 1e-9 < found[-1] + step


def test_diagrams_under_each_other_share_their_abscissae() -> None:
    """An abscissa lies at one place in all, each diagram holds its ordinates, and none meets another."""
    room = Rect(10.0, 10.0, 150.0, 200.0)
    spans = [(-300.0, 700.0), (0.0, 33.0), (-2.0, -1.0)]
    found = stack_graphs(room, (0.0, 360.0), spans, (2.0, 1.0, 1.0))
    for graph, (low, high) in zip(found, spans, strict=True):
        assert graph.spot(90.0, 0.0)[0] == pytest.approx(found[0].spot(90.0, 0.0)[0])
        low_end, high_end = graph.y.span(graph.upright)
        assert low_end == pytest.approx(low)
        assert high_end >= high
        assert all(room.holds(spot) for spot in graph.rect.corners)
    assert all(upper.rect.bottom >= lower.rect.top for upper, lower in pairwise(found))


def test_smooth_curves_pass_through_their_points() -> None:
    """A smooth curve passes through every point, and breaks off where one is not known."""
    spots = [(0.0, 1.0), (2.0, 8.0), (4.0, 3.0), (6.0, 4.0)]
    line = smooth_line(spots)
    assert all(min(math.dist(spot, other) for other in line) < 1e-12 for spot in spots)
    graph = Graph.fit_rect(Rect(0.0, 0.0, 50.0, 50.0), (0.0, 10.0), (0.0, 10.0))
    assert len(list(graph.smooth([0, 1, 2, 3, 4], [1, 2, math.nan, 3, 4]))) == 2


def test_polar_diagrams_hold_their_vectors_and_their_middle() -> None:
    """All ends and the middle lie in the window, at one scale both ways."""
    xs, ys = [300.0, 500.0, 410.0], [-20.0, 70.0, -120.0]
    polar = PolarGraph.fit_vectors(Rect(0.0, 0.0, 80.0, 60.0), xs, ys)
    assert all(polar.rect.holds(polar.end_of(x, y), 1e-9) for x, y in [*zip(xs, ys, strict=True), (0.0, 0.0)])


def test_scales_are_told_by_either_convention() -> None:
    """A scale is told as real quantity a mm, or as mm a unit."""
    assert scale_words("M", 10.0, "N m") == "k_M = 10 N m/mm"
    assert scale_words("M", 10.0, "N m", "drawn") == "mu_M = 0.1 mm/(N m)"


def test_axes_stay_at_their_diagram() -> None:
    """Where the zero of the ordinates lies far below a diagram, the abscissa is drawn at its edge."""
    graph = Graph.fit_rect(Rect(10.0, 10.0, 110.0, 60.0), (0.0, 360.0), (9500.0, 9600.0))
    paper = Figures(SMALL_SHEET, ENGLISH)
    arrows = [item for item in paper.axes(graph, "phi", "E") if isinstance(item, Arrow)]
    assert {end[1] for arrow in arrows for end in (arrow.start, arrow.end)} <= {10.0, 62.5}
