"""Files of drawing programs: however a stroke, a dot, an arc or a letter is written, the drawing is judged the same."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from drawing_files import dxf_points, geogebra, inkscape, svg
from face import ran
from hand_drawings import Drawing, by_mixed_forms, scene_file

STROKE = re.compile(r'<line x1="(\S+)" y1="(\S+)" x2="(\S+)" y2="(\S+)" stroke="black" stroke-width=".25"/>')
DOT = re.compile(r'<circle cx="(\S+)" cy="(\S+)" r=".5"/>')
LETTER = re.compile(r'<text x="(\S+)" y="(\S+)" font-size="3.5">([^<]*)</text>')
ARC = re.compile(r'<path d="M (\S+) (\S+) A (\S+) \S+ 0 0 0 (\S+) (\S+)" fill="none" stroke="black" '
                 r'stroke-width=".25"/>')


@cache
def drawing() -> Drawing:
    """A four-bar with normal accelerations by semicircles, so that it has arcs."""
    made = (by_mixed_forms("four-bar, orthogonal", seed) for seed in range(20))
    return next(one for one in made if len(one.board.arcs) > 1)


def verdicts(folder: Path, name: str, data: bytes) -> dict[str, Any]:
    """What is said of the drawing in a file: the score, and of each step the verdict, and how far off it is."""
    (folder / name).write_bytes(data)
    found = ran("verify", scene_file(drawing().task), folder / name, "--json", "-q").json
    return {"score": found["score"]["total"], "wrong": found["first_wrong"], "spare": found["not_needed"],
            "steps": [(one["verdict"], one["off_mm"] and pytest.approx(one["off_mm"], abs=0.02))
                      for one in found["steps"]]}


@cache
def plain() -> str:
    return svg(drawing()).decode()


def rewritten(pattern: re.Pattern[str], becomes: str) -> str:
    """The plain drawing with each stroke, dot, letter or arc written in another way."""
    text, count = pattern.subn(becomes, plain())
    assert count
    return text


def between(inside: str, more: str = "") -> str:
    """The plain drawing with something at its beginning, or around all of it."""
    head, _, body = plain().partition(">")
    body = body.removesuffix("</svg>\n")
    return f"{head}>{inside.format(body) if '{}' in inside else inside + body}{more}</svg>\n"


INK = 'fill="none" stroke="black" stroke-width=".25"'
WAYS: dict[str, Callable[[], str]] = {
    "strokes as paths": lambda: rewritten(STROKE, rf'<path d="M\1,\2L\3,\4" {INK}/>'),
    "strokes as straight curves": lambda: rewritten(STROKE, rf'<path d="M \1 \2 C \1 \2 \3 \4 \3 \4" {INK}/>'),
    "strokes as polylines": lambda: rewritten(STROKE, rf'<polyline points="\1,\2 \3,\4" {INK}/>'),
    "strokes by a style": lambda: rewritten(STROKE, r'<path class="thin" d="M\1 \2L\3 \4"/>').replace(
        "viewBox=", 'data-x="1" viewBox=').replace(">", "><style>.thin {stroke: #000; fill: none}</style>", 1),
    "strokes turned by a transform": lambda: rewritten(
        STROKE, rf'<path transform="rotate(180 \1 \2)" d="M\1 \2" {INK}/><g transform="scale(.1)">'
                rf'<path transform="scale(10)" d="M\1 \2 L\3 \4" {INK}/></g>'),
    "strokes by entities": lambda: '<!DOCTYPE svg [<!ENTITY ink "stroke:black;fill:none">]>' + rewritten(
        STROKE, r'<line x1="\1" y1="\2" x2="\3" y2="\4" style="&ink;"/>'),
    "dots by use": lambda: rewritten(DOT, r'<use href="#dot" x="\1" y="\2"/>').replace(
        ">", '><defs><circle id="dot" r=".5"/></defs>', 1),
    "dots by use and transform": lambda: rewritten(DOT, r'<use href="#dot" transform="translate(\1 \2) scale(.25)"/>'
                                                   ).replace(">", '><defs><circle id="dot" r="2"/></defs>', 1),
    "dots as ellipses": lambda: rewritten(DOT, r'<ellipse cx="\1" cy="\2" rx=".5" ry=".5"/>'),
    "letters in pieces": lambda: rewritten(
        LETTER, r'<text font-size="3.5"><tspan x="\1" y="\2" style="font-size:3.5px">\3</tspan></text>'),
    "letters placed by a matrix": lambda: rewritten(
        LETTER, r'<text transform="matrix(1 0 0 1 \1 \2)" font-size="3.5">\3</text>'),
    "arcs in two pieces of a path": lambda: rewritten(ARC, rf'<path d="M\1,\2A\3,\3,0,0,0,\4,\5" {INK}/>'),
    "all in a group that is moved": lambda: between('<g transform="translate(-30,40)"><g '
                                                    'transform="translate(30,-40)">{}</g></g>'),
    "all in a sheet of its own": lambda: between('<svg x="0%" width="100%" height="100%" viewBox="0 0 420 297">{}'
                                                 '</svg>'),
    "what is hidden beside it": lambda: between(
        f'<g style="display:none"><path d="M0 0L300 290" {INK}/><path d="M9 290L300 9" {INK}/></g>'
        '<rect x="0" y="0" width="420" height="297" fill="white"/>'),
}


@pytest.mark.parametrize("way", WAYS)
def test_a_drawing_is_the_same_however_it_is_written(way: str, tmp_path: Path) -> None:
    """Paths, copies, transforms, styles, entities, nested views, and what is hidden: each step is judged as it was."""
    assert (whole := verdicts(tmp_path, "plain.svg", plain().encode()))["wrong"] is None
    assert verdicts(tmp_path, "other.svg", WAYS[way]().encode()) == whole


def in_dxf(change: Callable[[ezdxf.document.Drawing], object]) -> bytes:
    """The drawing in a CAD file, changed."""
    document = ezdxf.read(io.StringIO(dxf_points(drawing()).decode()))
    change(document)
    document.write(text := io.StringIO())
    return document.encode(text.getvalue())


def hide(document: ezdxf.document.Drawing) -> None:
    """Lines across all on a layer that is off."""
    document.layers.add("hidden").off()
    for x in (50, 150, 250):
        document.modelspace().add_line((x, 0), (400 - x, 290), dxfattribs={"layer": "hidden"})


def mirror(document: ezdxf.document.Drawing) -> None:
    """Arcs seen from behind."""
    space = document.modelspace()
    for arc in [*space.query("ARC")]:
        x, y, _ = arc.dxf.center
        space.add_arc((-x, y), arc.dxf.radius, 180 - arc.dxf.end_angle, 180 - arc.dxf.start_angle,
                      dxfattribs={"extrusion": (0, 0, -1)})
        space.delete_entity(arc)


def bulge(document: ezdxf.document.Drawing) -> None:
    """Arcs as polylines with bulges, whose ends are theirs."""
    space = document.modelspace()
    for arc in [*space.query("ARC")]:
        path = ezdxf.path.make_path(arc)
        ezdxf.path.render_lwpolylines(space, [path], segments=1, distance=1e-6)
        space.delete_entity(arc)


def shrink(document: ezdxf.document.Drawing) -> None:
    """All of it in cm, and said so."""
    for entity in document.modelspace():
        entity.transform(ezdxf.math.Matrix44.scale(0.1, 0.1, 0.1))
    document.units = ezdxf.units.CM


@pytest.mark.parametrize("change", [hide, mirror, bulge, shrink])
def test_a_drawing_is_the_same_in_any_cad_file(change: Callable[[ezdxf.document.Drawing], object], tmp_path: Path
                                               ) -> None:
    """With layers that are off, arcs from behind or by bulges, and in units of its own."""
    whole = verdicts(tmp_path, "plain.dxf", in_dxf(lambda document: None))
    assert whole["wrong"] is None
    assert verdicts(tmp_path, "other.dxf", in_dxf(change)) == whole


HIDDEN, SEEN = ("false", "false"), ("true", "true")
SHOWN = '<element type="{}" label="{}"><show object="{}" label="{}"/>{}</element>'
BESIDE = {  # what is added to a construction of GeoGebra, and does not count
    "hidden points and lines": SHOWN.format("point", "hidden_{1}", *HIDDEN, '<coords x="5" y="5" z="1"/>')
    + SHOWN.format("line", "h", *HIDDEN, '<coords x="1" y="1" z="0"/>'),
    "points compared": '<expression label="Z" exp="(1,2) &lt; (3,4)"/>' + SHOWN.format("point", "Z", *SEEN, ""),
    "a line through lines": '<expression label="Z" exp="Line(s_{1},s_{2})"/>' + SHOWN.format(
        "line", "Z", *SEEN, ""),
    "a circle about a line": '<expression label="Z" exp="Circle(s_{1},3)"/>' + SHOWN.format(
        "conic", "Z", *SEEN, ""),
    "a vector of a line": '<expression label="Z" exp="Vector(s_{1})"/>' + SHOWN.format("vector", "Z", *SEEN, ""),
    "a root of a negative number": '<expression label="Z" exp="(-8)^0.5"/>' + SHOWN.format(
        "point", "Z", *SEEN, ""),
    "a point that is undefined": SHOWN.format("point", "Z", *SEEN, '<coords x="NaN" y="1" z="1"/>'),
}


def repacked(change: Callable[[str], str]) -> bytes:
    """The drawing in a file of GeoGebra, its construction changed."""
    with zipfile.ZipFile(io.BytesIO(geogebra(drawing()))) as archive:
        xml = archive.read("geogebra.xml").decode()
    with zipfile.ZipFile(data := io.BytesIO(), "w") as archive:
        archive.writestr("geogebra.xml", change(xml))
    return data.getvalue()


@pytest.mark.parametrize("what", BESIDE)
def test_what_has_no_value_in_geogebra_is_not_there(what: str, tmp_path: Path) -> None:
    """Hidden things and terms of wrong kinds change nothing."""
    whole = verdicts(tmp_path, "plain.ggb", geogebra(drawing()))
    assert whole["wrong"] is None
    assert verdicts(tmp_path, "other.ggb",
                    repacked(lambda xml: xml.replace("</construction>", BESIDE[what] + "</construction>"))) == whole


def test_coordinates_of_geogebra_are_homogeneous(tmp_path: Path) -> None:
    """Points at twice their coordinates, of which the third says so."""
    def doubled(found: re.Match[str]) -> str:
        return f'<coords x="{2 * float(found[1])!r}" y="{2 * float(found[2])!r}" z="2.0"/>'

    whole = verdicts(tmp_path, "plain.ggb", geogebra(drawing()))
    assert verdicts(tmp_path, "other.ggb",
                    repacked(lambda xml: re.sub(r'<coords x="(\S+)" y="(\S+)" z="1.0"/>', doubled, xml))) == whole


def test_other_programs_agree(tmp_path: Path) -> None:
    """The same drawing from Inkscape, a CAD program and GeoGebra: no step is wrong, none is missing."""
    for name, write in (("a.svg", inkscape), ("a.dxf", dxf_points), ("a.ggb", geogebra)):
        found = verdicts(tmp_path, name, write(drawing()))
        assert (found["wrong"], found["score"]) == (None, 100.0)
