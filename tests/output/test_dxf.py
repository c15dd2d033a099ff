"""DXF of a sheet, read back: in millimetres, on layers, with the steps as groups, the same bytes every time."""

from __future__ import annotations

import io
import math
import subprocess
import sys
from functools import cache
from typing import Any

import pytest

import graphplan as gp
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.lettering.lettering import CAPS, DROP, lowered
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polyline, Sheet, Text

ezdxf = pytest.importorskip("ezdxf")
NAME, BYLAYER = "GRAPHPLAN", 256
SCENES = ("four-bar", "jaanimets-10")  # one with loads, so that there is every kind of line and vector


@cache
def sheet_of(name: str) -> Sheet:
    return layout(gp.construct(gp.load(name)))


@cache
def read(name: str) -> Any:
    from graphplan.output.dxf import dxf

    return ezdxf.read(io.StringIO(dxf(sheet_of(name)).decode()))


def items(name: str, kind: type[Item]) -> list[Any]:
    return [item for item in sheet_of(name).items if isinstance(item, kind)]


@pytest.mark.parametrize("name", SCENES)
def test_it_is_sound_and_in_millimetres(name: str) -> None:
    """An audit finds nothing, the units are mm, and the extents are those of the sheet."""
    document, sheet = read(name), sheet_of(name)
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    assert document.units == ezdxf.units.MM
    assert document.header.custom_vars.get("Title") == sheet.title
    assert tuple(document.header["$EXTMAX"])[:2] == pytest.approx((sheet.width, sheet.height))


@pytest.mark.parametrize("name", SCENES)
def test_layers_and_line_types_are_those_of_the_pens(name: str) -> None:
    """Vectors have a layer for each kind, with its pen; every dashed pen has a line type with its dashes in mm."""
    document = read(name)
    for arrow in items(name, Arrow):
        if arrow.label:
            layer = document.layers.get(f"vectors-{arrow.label.partition(' ')[0]}")
            assert layer.dxf.lineweight == 100 * arrow.pen.width
            assert layer.dxf.true_color == int(arrow.pen.colour[1:], 16)
    dashes = {item.pen.dash for item in sheet_of(name).items if item.pen.dash}
    made = {tuple(abs(tag.value) for tag in kind.pattern_tags.tags if tag.code == 49) for kind in document.linetypes}
    assert dashes
    assert dashes <= made


def look(document: Any, entity: Any) -> tuple[str, int, str]:
    """Colour, weight and line type of an entity: its own, or else those of its layer."""
    layer, own = document.layers.get(entity.dxf.layer).dxf, entity.dxf
    colour = own if own.color != BYLAYER else layer
    return (f"#{colour.true_color:06x}" if colour.hasattr("true_color") else pens.INK,
            own.lineweight if own.lineweight >= 0 else layer.lineweight,
            own.linetype if own.linetype != "BYLAYER" else layer.linetype)  # fmt: skip


@pytest.mark.parametrize("name", [*SCENES, "slider-crank"])
def test_strokes_look_as_their_pens_say(name: str) -> None:
    """Colour, weight and line type of every line, circle and arc, its own or its layer's, are those of its pen."""
    document = read(name)
    thin = [line for line in items(name, Polyline) if len(line.spots) == 2 and line.pen.width <= 1]
    strokes = {"LINE": thin, "CIRCLE": items(name, Circle), "ARC": items(name, Arc)}
    for kind, drawn in strokes.items():
        found = [look(document, entity) for entity in document.modelspace().query(kind) if not entity.has_xdata(NAME)]
        dashes = ["-".join(["DASH", *(f"{part:g}" for part in item.pen.dash)]) for item in drawn]
        assert found == [(item.pen.colour, round(100 * item.pen.width), dash if item.pen.dash else "Continuous")
                         for item, dash in zip(drawn, dashes, strict=True)]  # fmt: skip


def test_bars_are_as_wide_as_on_the_sheet() -> None:
    """A bar has its width in the drawing itself, wherever no line weights are shown."""
    bars = [line.dxf.const_width for line in read("four-bar").modelspace().query("LWPOLYLINE") if line.dxf.const_width]
    assert bars
    assert bars == [line.pen.width for line in items("four-bar", Polyline) if line.pen in (pens.BAR, pens.HOLLOW)]


@pytest.mark.parametrize("name", SCENES)
def test_vectors_are_those_of_the_display_list(name: str) -> None:
    """Each head ends where its vector does, and bears what it is and its true ends."""
    heads = [(entity.dxf.vtx0, entity.get_xdata(NAME)) for entity in read(name).modelspace().query("SOLID")]
    found = [(data[0].value, tuple(data[1].value), tuple(data[2].value), tuple(tip)) for tip, data in heads]
    vectors = [(arrow.label, (*arrow.start, 0.0), (*arrow.end, 0.0), (*arrow.end, 0.0)) for arrow in items(name, Arrow)]
    assert list(dict.fromkeys(found)) == vectors


@pytest.mark.parametrize("name", SCENES)
def test_every_step_is_a_group_with_its_sentence(name: str) -> None:
    """Groups are named by the numbers of steps and bear their sentences; they hold all that is drawn or said of a step.
    """
    drawn, document, sheet = gp.construct(gp.load(name)).drawn, read(name), sheet_of(name)
    inked = {item.step for item in sheet.items if item.step is not None and item.step >= drawn.givens}
    assert len(inked) > 0.6 * (len(drawn) - drawn.givens)
    for step in inked:
        group = document.groups.get(f"STEP_{drawn.number(step)}")
        assert group.dxf.description == sheet.sentences[step]
    assert sum(key.startswith("STEP_") for key, _ in document.groups) == len(inked)


def test_letters_are_as_high_as_on_the_sheet() -> None:
    """Heights are those of capitals; indices are smaller and hang below the base line."""
    found = [(entity.dxf.text, entity.dxf.height, entity.get_placement()[1].y)
             for entity in read("four-bar").modelspace().query("TEXT")]
    expected = [(run.text, CAPS * (lowered(text.size) if run.level else text.size),
                 text.at[1] + run.level * DROP * text.size)
                for text in items("four-bar", Text) for run in text.runs]  # fmt: skip
    assert [words for words, *_ in found] == [words for words, *_ in expected]
    for ours, theirs in zip(found, expected, strict=True):
        assert ours[1:] == pytest.approx(theirs[1:])


def test_hollow_marks_cover_what_lies_behind() -> None:
    """Each circle with a paper filling has a wipeout of its size beneath it, and tints are solid hatches."""
    space = read("four-bar").modelspace()
    hollow = [item for item in items("four-bar", Circle) if item.pen.fill == pens.PAPER]
    centres = [tuple(sum(spot[axis] for spot in corners) / len(corners) for axis in (0, 1))
               for corners in (list(cover.boundary_path_wcs())[:-1] for cover in space.query("WIPEOUT"))]
    assert all(min(math.dist(item.centre, centre) for centre in centres) < 1e-6 for item in hollow)
    assert all(hatch.dxf.solid_fill for hatch in space.query("HATCH"))


def test_the_bytes_are_the_same_every_time() -> None:
    """A second run, in another process with other hashes, gives the same bytes; ezdxf's settings stay as they are."""
    from graphplan.output.dxf import dxf

    code = ("import sys, graphplan as gp; from graphplan.sheet.layout.layout import layout; "
            "from graphplan.output.dxf import dxf; "
            "sys.stdout.buffer.write(dxf(layout(gp.construct(gp.load('four-bar')))))")
    env = {"PYTHONHASHSEED": "7", "PYTHONPATH": ":".join(sys.path)}
    run = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, check=True)
    assert run.stdout == dxf(sheet_of("four-bar"))
    assert not ezdxf.options.write_fixed_meta_data_for_testing
