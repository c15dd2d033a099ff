"""The measure of sheets finds what is wrong with one."""

from __future__ import annotations

import pytest
from measured import MeasuredSheet, drawn_twice, significand, without_reason

HEAD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><desc>k_s = 2.5 mm/mm, k_v = 3</desc>
<g class="layer-paper"><rect class="panel" data-plan="N-plan" x="0" y="0" width="80" height="50"/></g>"""


def sheet(*groups: str) -> MeasuredSheet:
    """A sheet of one panel, with a group for each step from 1."""
    steps = "".join(f'<g class="step" data-step="{k}">{group}</g>' for k, group in enumerate(groups, 1))
    return MeasuredSheet.of(f"{HEAD}{steps}</svg>")


def letters(text: str, x: float, y: float) -> str:
    """A text of 2.5 mm."""
    return f'<text x="{x}" y="{y}" font-size="2.5">{text}</text>'


def mark(x: float, y: float) -> str:
    """The circle of a marked point."""
    return f'<circle cx="{x}" cy="{y}" r="0.5" stroke="#000000"/>'


def vector(length: float) -> str:
    """A velocity that is asked for."""
    return f'<g data-vector="velocity A" data-from="10 10" data-to="{10 + length} 10"/>'


def test_labels_on_labels_are_found() -> None:
    """Two letters at one place are a fault, two beside each other none."""
    assert sheet(letters("A", 10, 10), letters("B", 11, 10)).labels_on_labels == [("A", "B")]
    assert not sheet(letters("A", 10, 10), letters("B", 12, 10)).labels_on_labels


def test_lines_through_labels_are_found() -> None:
    """A line of another step through a letter is a fault, one of its own step is none."""
    line = '<polyline points="5,9 20,9" stroke="#555555"/>'
    assert sheet(letters("A", 10, 10), line).lines_through_labels == [("A", "2")]
    assert not sheet(letters("A", 10, 10) + line).lines_through_labels


@pytest.mark.parametrize("large", [0, 1])
def test_arcs_are_where_they_are_drawn(large: int) -> None:
    """A half circle from right to left goes over the top of the paper."""
    arc = f'<path d="M 30 25 A 10 10 0 {large} 0 10 25" stroke="#555555"/>'
    assert sheet(letters("A", 19, 16), arc).lines_through_labels == [("A", "2")]
    assert not sheet(letters("A", 19, 36), arc).lines_through_labels


def test_labels_nearer_to_others_are_found() -> None:
    """A letter stands at its own mark."""
    assert sheet(mark(10, 10) + letters("A", 18, 10), mark(20, 10)).labels_nearer_to_others == ["A"]
    assert not sheet(mark(10, 10) + letters("A", 11, 10), mark(20, 10)).labels_nearer_to_others


def test_vectors_that_cannot_be_measured_are_found() -> None:
    """A vector of 3 mm is too short, but not beside one of 200 mm."""
    assert sheet(vector(3), vector(100)).short_vectors == [("velocity A", 3)]
    assert not sheet(vector(3), vector(200)).short_vectors


def test_space_is_measured() -> None:
    """A panel takes its part of the page, and ink its part of the panel."""
    found = sheet('<polyline points="0,0 40,25" stroke="#555555"/>')
    assert (found.plans_of_page, found.ink_of_panels) == (0.4, [0.25])
    assert (found.odd_scales, significand(0.025)) == (["k_v = 3"], 2.5)


def test_the_list_of_steps_is_measured() -> None:
    """A line where one lies already, and a step that does not say why."""
    lines = ([1, 2, 3], [2, 4, 6], [1, 2, 4])
    steps = [{"number": k, "kind": "line", "plan": "N-plan", "value": value, "why": "so" if k == 1 else ""}
             for k, value in enumerate(lines, 1)]
    assert (drawn_twice(steps), without_reason(steps)) == ([2], [2, 3])
