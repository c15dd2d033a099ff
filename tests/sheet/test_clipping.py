"""What leaves its panel is cut there."""

from __future__ import annotations

import pytest

from graphplan.sheet.lettering.lettering import TextRun
from graphplan.sheet.plates.display import Arc, Circle, Polyline, Rect, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.view import clip_item, clip_off_letters

PANEL = Rect(0.0, 0.0, 100.0, 80.0)


@pytest.mark.parametrize("centre", [(50.0, 40.0), (95.0, 40.0), (130.0, 40.0), (50.0, -20.0)])
def test_a_large_circle_is_drawn_as_far_as_it_lies_inside(centre: tuple[float, float]) -> None:
    """Whole where it fits, else as chains inside the panel that lie on it, wherever its middle is."""
    items = list(clip_item(Circle(Pen(0.25), "steps", 1, centre, 35.0), PANEL))
    if centre == (50.0, 40.0):
        assert items == [Circle(Pen(0.25), "steps", 1, centre, 35.0)]
        return
    assert items
    for item in items:
        assert isinstance(item, Polyline)
        for x, y in item.spots:
            assert -1e-9 <= x <= 100 + 1e-9
            assert -1e-9 <= y <= 80 + 1e-9
            assert abs(((x - centre[0])**2 + (y - centre[1])**2)**0.5 - 35.0) < 0.1


def test_a_dot_is_drawn_with_its_middle_alone() -> None:
    """A dot at the edge is whole, one outside is none."""
    dots = (Circle(Pen(0.25), "steps", 1, (x, 40.0), 0.5) for x in (100.0, 100.1))
    assert [len(list(clip_item(dot, PANEL))) for dot in dots] == [1, 0]


def test_a_ring_breaks_off_at_letters() -> None:
    """What is left of a circle off letters is of the same circle, and keeps off them; off no letters it is whole."""
    ring = Circle(Pen(0.25), "enlarged", 1, (50.0, 40.0), 10.0)
    on, off = (Text(Pen(0.0), "letters", 1, (x, 40.0), (TextRun("P2"),), 3.5) for x in (58.0, 45.0))
    assert list(clip_off_letters([ring], PANEL, [off])) == [ring]
    arcs = list(clip_off_letters([ring], PANEL, [on]))
    assert sum(arc.end - arc.start for arc in arcs if isinstance(arc, Arc)) == pytest.approx(360, abs=40)
    assert {(arc.centre, arc.radius) for arc in arcs if isinstance(arc, Arc)} == {(ring.centre, ring.radius)}
    assert not any(on.box.holds(spot) for arc in arcs if isinstance(arc, Arc) for spot in arc.spots())
