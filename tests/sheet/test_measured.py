"""The measure of sheets finds what is wrong with one."""

from __future__ import annotations

from pathlib import Path

import measured
import pytest
from face import Got, got
from inked_sheet import InkedSheet, significand
from measured import Measure, findings, held
from sampling import CORE

TABLE = Path(__file__).parents[2] / "gallery" / "charts" / "sheets.md"
HEAD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><desc>k_s = 2.5 mm/mm, k_v = 3</desc>
<g class="layer-paper"><rect class="panel" data-plan="N-plan" x="0" y="0" width="80" height="50"/></g>"""


def sheet(*groups: str) -> InkedSheet:
    """A sheet of one panel, with a group for each step from 1."""
    steps = "".join(f'<g class="step" data-step="{k}">{group}</g>' for k, group in enumerate(groups, 1))
    return InkedSheet.of(f"{HEAD}{steps}</svg>")


def letters(text: str, x: float, y: float) -> str:
    """A text of 2.5 mm."""
    return f'<text x="{x}" y="{y}" font-size="2.5">{text}</text>'


def mark(x: float, y: float) -> str:
    """The circle of a marked point."""
    return f'<circle cx="{x}" cy="{y}" r="0.5" stroke="#000000"/>'


def vector(length: float, y: float = 10) -> str:
    """A velocity that is asked for."""
    return f'<g class="vector" data-vector="velocity A" data-from="10 {y}" data-to="{10 + length} {y}"/>'


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
    assert not sheet(mark(10, 10) + letters("to B", 18, 10), mark(20, 10)).labels_nearer_to_others


def test_a_leader_ties_letters_to_their_mark() -> None:
    """Letters that the thinnest line joins to their mark may be nearer to another; other lines do not join."""
    for width, found in (("0.13", []), ("0.18", ["A"])):
        leader = f'<polyline points="10,10 18,10" stroke="#555555" stroke-width="{width}"/>'
        assert sheet(mark(10, 10) + leader + letters("A", 18, 10), mark(20, 10)).labels_nearer_to_others == found


def test_a_letter_beside_a_ring_is_of_the_mark_in_it() -> None:
    """What a detail shows once more has its letter on the plan, or has it there with a leader."""
    detail = ('<g class="layer-enlarged"><circle cx="10" cy="10" r="3" stroke="#4a2c0a"/>'
              '<circle data-step="1" cx="50" cy="30" r="0.5" stroke="#000000"/></g>')
    steps = (f'<g class="step" data-step="{k}">{drawn}</g>'
             for k, drawn in ((1, mark(10, 10) + letters("a", 14, 11)), (2, mark(22, 10))))
    assert not InkedSheet.of(f"{HEAD}{''.join(steps)}{detail}</svg>").labels_nearer_to_others


def test_leaders_that_are_too_long_are_found() -> None:
    """The thinnest line that ties letters to their mark is at most 8 mm long."""
    for end, found in ((18, []), (19, ["9.0 mm"])):
        leader = f'<polyline points="10,10 {end},10" stroke="#555555" stroke-width="0.13"/>'
        assert sheet(mark(10, 10) + leader + letters("A", end, 10)).long_leaders == found


def test_vectors_that_cannot_be_measured_are_found() -> None:
    """A vector of 3 mm is too short, but not beside one of 200 mm."""
    assert sheet(vector(3), vector(100)).short_vectors == [("velocity A", 3)]
    assert not sheet(vector(3), vector(200)).short_vectors


def test_space_is_measured() -> None:
    """A panel takes its part of the page, and ink its part of the panel."""
    found = sheet('<polyline points="0,0 40,25" stroke="#555555"/>')
    assert (found.plans_of_page, found.ink_of_panels) == (0.4, 0.25)


def test_odd_scales_are_found() -> None:
    """A scale that no ruler has is a fault, and a plan drawn twice as large as by its scale."""
    caption = '</g><g class="layer-text"><text x="5" y="5" font-size="3">N-plan, ×2</text>'
    assert sheet(caption).odd_scales == ["k_v = 3", "×2"]
    assert [significand(scale) for scale in (0.025, 4000, 12.5)] == [2.5, 4, 1.25]


def test_letters_and_subscripts_are_measured_apart() -> None:
    """The smallest capitals are those of the smallest letters; subscripts count for themselves."""
    found = sheet(letters('A<tspan font-size="1.8">2</tspan>', 10, 10), letters("B", 30, 10))
    assert (found.smallest_letters, found.smallest_subscripts) == pytest.approx((0.729 * 2.5, 0.729 * 1.8))


def test_marks_that_cannot_be_told_apart_are_found() -> None:
    """Two marks half a millimetre apart are a fault; two at one place are one."""
    assert sheet(mark(10, 10), mark(10.5, 10), mark(10, 10)).marks_too_near == [("1", "2"), ("2", "3")]
    assert not sheet(mark(10, 10), mark(12, 10)).marks_too_near


def test_vectors_upon_others_are_found() -> None:
    """Vectors are measured where they lie upon each other or on a link, not where they cross or only touch."""
    link = '</g><g class="layer-links"><polyline points="5,10 25,10" stroke="#000000"/><polyline points="12,0 12,20"/>'
    assert sheet(vector(30), vector(20)).vectors_on_vectors == 20
    assert sheet(vector(30), vector(20, y=12)).vectors_on_vectors == 0
    assert sheet(vector(30), link).vectors_on_links == 15


def test_a_stroke_that_leaves_its_panel_says_where_it_goes(tmp_path: Path) -> None:
    """As a line does, so does the stroke along which a point beyond the panel is laid off."""
    (_, scene), = measured.random_scenes(1, 7127)
    path = tmp_path / "random.toml"
    path.write_text(scene.text, encoding="utf-8")
    assert Got(path).sheet.cut_lines == ["to point 21"]


def test_lines_that_are_cut_off_and_facts_in_pieces_are_found() -> None:
    """What is written where a line leaves its panel, a line that leaves it without a word, and headings of facts beyond
    one each."""
    cut, whole = (f'<polyline points="10,{y} 40,25" stroke="#555555"/>' for y in (0.4, 2))
    assert sheet(cut + letters("to point 31", 10, 10), cut).cut_lines == ["to point 31"]
    assert sheet(letters("to point 31", 60, 10), cut, whole).cut_lines == ["to point 31", "step 2"]
    assert sheet(letters("Given", 10, 10), letters("Found", 10, 20), letters("Found", 10, 30)).facts_in_pieces == 1


def test_coloured_letters_are_of_vectors() -> None:
    """The letter of a step's vector may be nearer to the mark of another step."""
    vector_letter = letters("a", 18, 10).replace("<text", '<text fill="#a3151b"')
    assert not sheet(mark(10, 10) + vector_letter, mark(20, 10)).labels_nearer_to_others


def test_a_scene_has_a_mark() -> None:
    """A four-bar on its paper, drawn to a tenth, has a good one; each size of paper too large costs."""
    drawn = measured.DrawnScene(got("four-bar"))
    assert drawn.mark >= 4.5
    assert (drawn.sizes_too_large, drawn.poor_results) == (0, [])
    assert 0.3 < drawn.mechanism_in_panel <= 1.0


def test_the_list_of_steps_is_measured() -> None:
    """A line where one lies already, and a step that does not say why."""
    lines = ([1, 2, 3], [2, 4, 6], [1, 2, 4])
    steps = [{"number": k, "kind": "line", "plan": "N-plan", "value": value, "why": "so" if k == 1 else ""}
             for k, value in enumerate(lines, 1)]
    assert (measured.drawn_twice(steps), measured.without_reason(steps)) == ([2], [2, 3])


def test_measures_are_told_with_what_must_be() -> None:
    """A measure says its bound, and in how many scenes it holds or what is usual."""
    some = Measure("some", lambda one: [], most=0)
    usual = Measure("usual", lambda one: 0.0, least=0.6, form=".0%", typical=True)
    rows = [{"some": found, "usual": part} for found, part in (([], 0.5), (["A"], 0.7), ([], 0.9))]
    assert [(one.must, held(one, rows)) for one in (some, usual)] == [("≤ 0", "2 of 3"), ("≥ 60%", "70%")]


def test_a_scene_is_measured() -> None:
    """The four-bar has a row with each measure; what is found on it is told."""
    found = {"four-bar": measured.row(measured.DrawnScene(got("four-bar"))) | {"lines drawn twice": [2, 5]}}
    assert measured.table(found).splitlines()[2].startswith("| four-bar | 0 | 0 | 0 |")
    assert "four-bar: lines drawn twice: 2, 5" in findings(found)


@pytest.mark.costly
def test_random_linkages_are_measured() -> None:
    """Linkages that chance makes have rows too, by their seeds."""
    assert [name for name, _ in measured.measured_at_random(3, 6)] == ["random 6", "random 7", "random 8"]


@pytest.mark.parametrize("name", CORE[::4])
def test_the_gallery_tells_what_sheets_measure(name: str) -> None:
    """A scene's row in the gallery's table is what its sheet measures now."""
    told = " | ".join(measured.cells(name, measured.row(measured.DrawnScene(got(name)))))
    rows = TABLE.read_text(encoding="utf-8").splitlines()
    assert f"| {told} |" in rows, "run python tests/sheet/measured.py -o gallery/charts/sheets.md"
