"""Files of drawing programs: one figure in every format is the same traces, and graphplan's own files are read back."""

from __future__ import annotations

import io
import math
import re
import zipfile
from collections.abc import Iterable
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import ezdxf
import pytest

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files.drawing import circle_through, follow_leaders, word_at
from graphplan.marking.judge.lettering import name_marks
from graphplan.marking.submission import read_submission
from graphplan.marking.traces import PlanFrame, Spot, Submission, Trace, spell
from graphplan.output.dxf import dxf
from graphplan.output.exports.geogebra import geogebra
from graphplan.output.svg import svg
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Polyline, Sheet

CSV = """mark,x,y,x2,y2,r
A,20,30,,,
v_b,70.5,12.25,,,
,20,30,70.5,12.25,
,10,80,90,80,
,50,50,,,15
"""
TOML = """
[marks]
A = [20, 30]
v_b = [70.5, 12.25]
[lines]
1 = [[20, 30], [70.5, 12.25]]
2 = [[10, 80], [90, 80]]
[circles]
3 = [50, 50, 15]
"""
SVG = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 200 200">{}</svg>"""
PLAIN = SVG.format("""
<circle cx="40" cy="140" r="1"/><text x="44" y="138" font-size="6">A</text>
<circle cx="141" cy="175.5" r="1"/><text x="144" y="172" font-size="6">v<tspan dy="1.5" font-size="4">b</tspan></text>
<g stroke="black"><line x1="40" y1="140" x2="141" y2="175.5"/><path d="M20 40H180"/>
<circle cx="100" cy="100" r="30" fill="none"/></g>""")
INKSCAPE = """<?xml version="1.0"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN"
 "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="10cm" height="10cm"
 viewBox="-100 -100 400 400"><defs><circle id="dot" r="2"/></defs><style>.thin {stroke: #000; fill: none}</style>
<g style="display:none;stroke:#000"><path d="M0 0L300 300"/></g><rect x="-100" y="-100" width="400" height="400"/>
<g transform="translate(-100,300) scale(4,-4)">
<use xlink:href="#dot" transform="translate(20 30) scale(.25)"/>
<use xlink:href="#dot" x="141" y="24.5" transform="scale(.5)"/>
<g class="thin"><path d="m 20,30 50.5,-17.75"/><path transform="rotate(90 50 50)" d="M80 90 80 50 80,10"/>
<path d="M35 50a15 15 0 0130 0 15 15 0 0 1-30 0z"/></g>
<g transform="scale(1,-1)"><text><tspan x="22" y="-31" style="font-size:3">A</tspan></text>
<text x="72" y="-13.5" font-size="3">v<tspan baseline-shift="sub">b</tspan></text></g></g></svg>"""


def drawn_in_dxf() -> bytes:
    """The figure in a CAD program that draws in cm, part of it in a block."""
    document = ezdxf.new("R2010", units=ezdxf.units.CM)
    space, block = document.modelspace(), document.blocks.new("DOT")
    block.add_point((0, 0))
    block.add_line((0, 0), (0, 0))
    for x, y, name in ((2, 3, "A"), (7.05, 1.225, "v_b")):
        space.add_blockref("DOT", (x, y))
        space.add_text(name, height=0.2).set_placement((x + 0.1, y + 0.1))
    space.add_line((2, 3), (7.05, 1.225))
    space.add_lwpolyline([(1, 8), (4, 8), (9, 8)])
    space.add_circle((5, 5), 1.5)
    hidden = document.layers.add("hidden")
    hidden.off()
    space.add_line((0, 0), (9, 9), dxfattribs={"layer": "hidden"})
    text = io.StringIO()
    document.write(text)
    return text.getvalue().encode()


GGB = """<geogebra format="5.0"><construction>
<element type="point" label="A"><show object="true" label="true"/><coords x="40" y="60" z="2"/></element>
<element type="point" label="C"><show object="false"/><coords x="70.5" y="12.25" z="1"/><labelMode val="3"/>
<caption val="v_{b}"/></element>
<element type="point" label="hidden_{1}"><show object="false" label="false"/><coords x="5" y="5" z="1"/></element>
<command name="Segment"><input a0="A" a1="C"/><output a0="f"/></command>
<element type="segment" label="f"><show object="true"/><coords x="17.75" y="50.5" z="-1870"/></element>
<command name="Segment"><input a0="(10, 2 * 40)" a1="(90, 80)"/><output a0="g"/></command>
<element type="segment" label="g"><show object="true"/><coords x="0" y="80" z="-6400"/></element>
<element type="conic" label="c"><show object="true"/>
<matrix A0="2" A1="2" A2="9550" A3="0" A4="-100" A5="-100"/></element>
<element type="line" label="h"><show object="false"/><coords x="1" y="1" z="0"/></element>
</construction></geogebra>"""


def packed(xml: str) -> bytes:
    """A GeoGebra file with this construction."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("geogebra.xml", xml)
    return data.getvalue()


FORMATS = {
    "sheet.csv": CSV.encode(), "sheet.toml": TOML.encode(), "plain.svg": PLAIN.encode(),
    "inkscape.svg": INKSCAPE.encode(), "cad.dxf": drawn_in_dxf(), "geogebra.ggb": packed(GGB),
}  # fmt: skip
FIGURE = [(POINT, "A", (20, 30)), (POINT, "v_b", (70.5, 12.25)), (LINE, (20, 30), (70.5, 12.25)),
          (LINE, (10, 80), (90, 80)), (CIRCLE, (50, 50), 15)]


def submission(folder: Path, name: str, data: bytes, frames: dict[str, PlanFrame] | None = None) -> Submission:
    """The data as a file, read."""
    path = folder / name
    path.write_bytes(data)
    return read_submission(path, (), frames or {})


def lying(trace: Trace) -> list[float]:
    """Where a thing lies, however it was drawn: a line by its ends in their order, a circle by centre and radius."""
    if trace.kind == CIRCLE:
        found = circle_through(*trace.spots[:3])
        assert found is not None
        return [*found[0], found[1]]
    return [part for spot in sorted(trace.spots) for part in spot]


@pytest.mark.parametrize("name", FORMATS)
def test_one_figure_in_every_format(tmp_path: Path, name: str) -> None:
    """The same points, lines and circle are read from every format, named alike, and what hides is not."""
    found = submission(tmp_path, name, FORMATS[name])
    traces = found.traces
    assert [trace.kind for trace in sorted(traces, key=_order)] == [POINT, POINT, LINE, LINE, CIRCLE]
    assert named(found) == {
        "A": pytest.approx((20, 30), abs=1e-6), "v_b": pytest.approx((70.5, 12.25), abs=1e-6)}
    curves = [lying(trace) for trace in sorted(traces, key=_order)[2:]]
    assert curves[0] == pytest.approx([10, 80, 90, 80], abs=1e-6)
    assert curves[1] == pytest.approx([20, 30, 70.5, 12.25], abs=1e-6)
    assert curves[2] == pytest.approx([50, 50, 15], abs=1e-6)


def named(found: Submission) -> dict[str, Spot]:
    """The points by their names: those of the file, or the letters nearest to them."""
    points = [trace for trace in found.traces if trace.kind == POINT]
    near = {word.names[0]: min(points, key=lambda point: point.figure.distance(word.box)) for word in found.letters}
    return {name: point.spots[0] for name, point in near.items()} or {point.label: point.spots[0] for point in points}


def _order(trace: Trace) -> tuple[int, list[float]]:
    return [POINT, LINE, CIRCLE].index(trace.kind), lying(trace)


def test_what_a_file_could_show(tmp_path: Path) -> None:
    """A drawing without points shows lines, so that no point is missing there."""
    assert submission(tmp_path, "x.svg", FORMATS["plain.svg"]).shows == {POINT, LINE, CIRCLE}
    assert submission(tmp_path, "y.svg", b'<svg stroke="#000"><path d="M0 0 9 9"/></svg>').shows == {LINE}


PATHS = {
    "M10 10 C 40 10 70 10 100 10": (LINE, [(10, 10), (100, 10)]),  # a straight Bezier curve
    "M10 0 C 10 5.523 5.523 10 0 10 S -10 5.523 -10 0": (CIRCLE, [(0, 0), 10]),
    "M10,0A10,10,0,0,1,0,10": (CIRCLE, [(0, 0), 10]),
    "M10 0 A10 10 0 1 1 0 10": (CIRCLE, [(10, 10), 10]),
    "M0 0A1 1 0 0 1 20 0": (CIRCLE, [(10, 0), 10]),  # its radii are too small
    "M" + " ".join(f"{9 * math.cos(i / 8)} {9 * math.sin(i / 8)}" for i in range(40)): (CIRCLE, [(0, 0), 9]),
    "M0 0 C 0 30 30 30 30 0": None,  # neither line nor circle
}


@pytest.mark.parametrize("path", PATHS)
def test_curves_known_again(tmp_path: Path, path: str) -> None:
    """A path is a line or a circle where it is one within a hundredth of its size, and else nothing."""
    group = '<g stroke="#000" transform="scale({0}) translate(50 50)"><path d="{1}"/><path d="M0 -40H40"/></g>'
    document = SVG.format(group.format(2 * 1.0, path))
    traces = submission(tmp_path, "curve.svg", document.encode()).traces
    found = [trace for trace in traces if lying(trace) != pytest.approx([50, 90, 90, 90])]
    if PATHS[path] is None:
        assert not found
        return
    kind, (at, other) = PATHS[path]
    assert [trace.kind for trace in found] == [kind]
    place = [50 + at[0], 50 - at[1]]
    assert lying(found[0])[:2] == pytest.approx(place, abs=0.02)
    assert lying(found[0])[2] == pytest.approx(other if kind == CIRCLE else 50 + other[0], abs=0.02)


def test_arcs_bulges_and_endless_lines_of_cad(tmp_path: Path) -> None:
    """Arcs end where they were drawn, also mirrored ones; bulges are arcs; a construction line goes as far as the rest.
    """
    document = ezdxf.new("R2010", units=ezdxf.units.MM)
    space = document.modelspace()
    space.add_arc((50, 50), 10, 0, 90)
    space.add_arc((-50, 20), 10, 0, 90, dxfattribs={"extrusion": (0, 0, -1)})
    space.add_lwpolyline([(0, 0, 0, 0, 0), (10, 0, 0, 0, 1), (10, 20, 0, 0, 0)])
    space.add_xline((0, 30), (1, 0))
    text = io.StringIO()
    document.write(text)
    traces = submission(tmp_path, "a.dxf", text.getvalue().encode()).traces
    ends = sorted(sorted((trace.spots[0], trace.spots[-1])) for trace in traces)
    wanted = [[(0, 0), (10, 0)], [(0, 30), (60, 30)], [(10, 0), (10, 20)], [(40, 20), (50, 30)], [(50, 60), (60, 50)]]
    assert ends == [[pytest.approx(spot, abs=1e-9) for spot in pair] for pair in wanted]


def test_parts_of_the_view(tmp_path: Path) -> None:
    """Percentages are parts of the view that an element stands in: its width, its height, or for a radius both."""
    inside = ('<g stroke="#000"><line x1="10%" y1="20%" x2="90%" y2="20%"/><circle cx="50%" cy="50%" r="15%"/>'
              '<svg x="50%" width="50%" height="100%" viewBox="0 0 10 20"><line y1="75%" x2="100%" y2="15"/></svg></g>')
    found = sorted(submission(tmp_path, "x.svg", SVG.format(inside).encode()).traces, key=_order)
    assert [lying(trace) for trace in found] == [
        pytest.approx([10, 80, 90, 80]), pytest.approx([50, 25, 100, 25]), pytest.approx([50, 50, 15])]


@lru_cache(maxsize=3)
def own(scene: str) -> tuple[Composition, Sheet, dict[str, Spot]]:
    """A scene's sheet, as it is composed and as it is laid out, and where its lettered points lie."""
    drawing = gp.construct(gp.load(scene))
    composition = compose(drawing, None, None)
    found = composition.plates
    points = [mark for mark in found.all_marks if mark.kind == POINT and mark.view.rect.holds(mark.spot)]
    named = {spell(point.name): point.spot for point in points if point.name and not CORNER.fullmatch(point.name)}
    return composition, layout(composition), named


def apart(traces: Iterable[Trace], trace: Trace) -> float:
    """How far the nearest trace of the same kind is from where a thing lies, in mm."""
    others = [lying(other) for other in traces if other.kind == trace.kind]
    return min(max(abs(a - b) for a, b in zip(lying(trace), other, strict=True)) for other in others)


def shown(sheet: Sheet) -> Iterable[Trace]:
    """What the construction draws on a sheet: strokes, arcs, dots and the shafts of vectors."""
    for item in sheet.items:
        if item.layer not in ("construction", "links", "vectors", "pairs"):
            continue
        match item:
            case Polyline(spots=(start, end)) if math.dist(start, end) > 0.6:
                yield Trace(LINE, (start, end))
            case Circle():
                yield Trace(POINT, (item.centre,))
            case Arc():
                yield Trace(CIRCLE, (item.spot_at(item.start), item.spot_at((item.start + item.end) / 2),
                                     item.spot_at(item.end)))
            case Arrow() if math.dist(item.start, item.end) > item.head + 0.6:
                yield from (Trace(LINE, (start, end)) for start, end in item.shaft)


SCENES = ("four-bar", "alt-eight-link", "rosenauer-loaded")
CORNER = re.compile("[IVX]+")  # of a force polygon, which has no dot


@pytest.mark.parametrize("scene", SCENES)
def test_own_sheets_are_read_back(tmp_path: Path, scene: str) -> None:
    """Everything drawn on a sheet is found in its DXF to 0.001 mm, in its SVG to the hundredths it is written in, and
    letters name their points, also where leaders take them past others."""
    composition, sheet, named = own(scene)
    files = ("own.dxf", dxf([sheet], composition.plates), 1e-3), ("own.svg", svg(sheet).encode(), 5.1e-3)
    for name, data, far in files:
        found = submission(tmp_path, name, data, {"N-plan": PlanFrame(0j, 1 + 0j)})
        rims = [Trace(POINT, (spot,)) for trace in found.traces if trace.kind == CIRCLE for spot in trace.spots]
        for trace in shown(sheet):
            if trace.kind == CIRCLE:
                assert max(apart(rims, Trace(POINT, (spot,))) for spot in (trace.spots[0], trace.spots[-1])) < far
            else:
                assert apart(found.traces, trace) < far
        told = name_marks(composition.plans.drawing, composition, found, Pencil())
        points = {trace.label: trace.spots[0] for trace in told.traces if trace.kind == POINT}
        assert not [label for label, at in named.items() if math.dist(points.get(label, (0.0, 0.0)), at) > 2 * far]
        assert found.frames


def test_leaders_of_own_sheets_are_of_the_letters_at_which_they_aim() -> None:
    """Not of those beside which they end, and that cut them: there they may go on beyond. The longer of two is of the
    letters at which both aim."""
    words = [word_at("f", (50.0, 60.0), 5.0), word_at("s6_o", (53.0, 60.0), 5.0), word_at("L_1", (70.0, 75.0), 5.0),
             word_at("VI", (20.0, 60.0), 5.0), word_at("703", (26.4, 62.0), 3.5),
             word_at("v_p7'", (25.0, 29.2), 5.0), word_at("P0", (34.3, 31.3), 5.0)]
    marks = {"f": (55.5, 55.8), "s6_o": (47.4, 53.0), "L_1": (55.0, 60.0), "703": (18.8, 62.8), "VI": (12.4, 61.3),
             "v_p7'": (55.0, 30.0)}
    ends = [("f", (53.7, 57.34)), ("s6_o", (52.2, 57.41)), ("703", (19.4, 62.8)), ("VI", (19.4, 61.3)),
            ("v_p7'", (40.8, 30.0)), ("L_1", (58.0, 62.63))]
    leaders = [Trace(LINE, (marks[name], end)) for name, end in ends] + [Trace(LINE, ((64.0, 67.89), (69.0, 72.27)))]
    led_words, traces = follow_leaders(words, [], leaders)
    assert ({word.text: word.leads for word in led_words if word.leads}, traces) == (marks, [])


@pytest.mark.parametrize("has_dot", [True, False])
def test_where_a_leader_ends_is_the_mark_of_its_letters(has_dot: bool, tmp_path: Path) -> None:
    """Though another dot is beside it, where the mark should be, and though it has no dot itself."""
    composition, sheet, named = own("four-bar")
    found = submission(tmp_path, "own.svg", svg(sheet).encode(), {"N-plan": PlanFrame(0j, 1 + 0j)})
    x, y = named["v_b"]
    leads = x + 0.6, y
    letters = tuple(replace(word, leads=leads) if "v_b" in word.names else word for word in found.letters)
    traces = (*found.traces, *[Trace(POINT, (leads,))] * has_dot)
    told = name_marks(composition.plans.drawing, composition, replace(found, letters=letters, traces=traces), Pencil())
    assert [trace.spots[0] for trace in told.traces if trace.label == "v_b"] == [leads]


@pytest.mark.parametrize("kind", ["dxf", "svg"])
def test_own_sheets_of_other_paper(tmp_path: Path, kind: str) -> None:
    """Plans lie where their frames say on a sheet of the size that is asked for, and anywhere on another."""
    (composition, sheet, _), path, frames = own("four-bar"), tmp_path / f"own.{kind}", {"N-plan": PlanFrame(0j, 1 + 0j)}
    path.write_bytes(dxf([sheet], composition.plates) if kind == "dxf" else svg(sheet).encode())
    assert read_submission(path, (), frames, size=(sheet.width, sheet.height)).frames == frames
    assert read_submission(path, (), frames, size=(sheet.height, sheet.width)).frames == {}


@pytest.mark.parametrize("scene", SCENES)
def test_own_geogebra_files_are_read_back(tmp_path: Path, scene: str) -> None:
    """Points by their labels, strokes and arcs by the commands that make them, all to 0.001 mm, without coordinates."""
    composition, sheet, named = own(scene)
    drawn = composition.plates
    traces = submission(tmp_path, "own.ggb", geogebra(drawn)).traces
    points = {trace.label: trace.spots[0] for trace in traces if trace.kind == POINT}
    assert max(math.dist(points[label], at) for label, at in named.items()) < 1e-3
    arcs = [trace for trace in shown(sheet) if trace.kind == CIRCLE]
    assert max((apart(traces, trace) for trace in arcs), default=0.0) < 1e-3
    strokes = [trace.spots for trace in traces if trace.kind == LINE]
    for line in (stretch.of.line for plate in drawn for stretch in plate.stretches.values()):
        assert min(max(off(line, spot) for spot in ends) for ends in strokes) < 1e-3


def off(line: tuple[float, float, float], spot: Spot) -> float:
    """How far a spot is from a line, in mm."""
    a, b, c = line
    return abs(a * spot[0] + b * spot[1] + c) / math.hypot(a, b)


@pytest.mark.parametrize(("kind", "package"), [("dxf", "ezdxf"), ("svg", "svgelements")])
def test_drawings_need_their_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, package: str) -> None:
    """Without the package that reads it, a file is refused with what to install."""
    monkeypatch.setitem(__import__("sys").modules, package, None)
    with pytest.raises(Refused, match=rf"needs {package}; pip install 'graphplan\[{kind}\]'"):
        submission(tmp_path, f"a.{kind}", FORMATS["plain.svg"])
