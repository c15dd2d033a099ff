"""DXF of a sheet, read back: the mechanism 1:1 with its dimensions, the pages on layouts, layers by steps, whole texts,
the same bytes every time."""

from __future__ import annotations

import io
import math
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.image import imread

import graphplan as gp
from graphplan.output.png import png
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.layout import pages
from graphplan.sheet.lettering.lettering import CAPS, plain
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polyline, Sheet, Text

ezdxf = pytest.importorskip("ezdxf")
NAME, BYLAYER, FULL_SIZE = "GRAPHPLAN", 256, "MECHANISM 1-1"
SCENES = ("four-bar", "jaanimets-10", "ozols-9-1")  # with loads, so that there is every kind of line; and in metres
ALL = sorted(path.stem for path in (Path(gp.__file__).parent / "scenes").glob("*.toml"))
PX = 4  # pixels in a mm
UNITS = {"mm": (4, 1.0), "m": (6, 0.001)}  # how the header calls them, and a millimetre


@cache
def composed(name: str) -> Composition:
    return compose(gp.construct(gp.load(name)))


@cache
def sheets_of(name: str) -> list[Sheet]:
    return pages(composed(name))


@cache
def read(name: str) -> Any:
    from graphplan.output.dxf import dxf

    return ezdxf.read(io.StringIO(dxf(sheets_of(name), composed(name).plates).decode()))


def millimetre(name: str) -> float:
    return UNITS[gp.load(name).units.length][1]


def corner(name: str) -> tuple[float, float]:
    """Where the first page lies in model space."""
    x, y = read(name).header["$LIMMIN"]
    return float(x), float(y)


def items(name: str, kind: type[Item]) -> list[Any]:
    return [item for sheet in sheets_of(name) for item in sheet.items if isinstance(item, kind)]


def drawn(name: str, kinds: str) -> list[Any]:
    """The entities of the sheet, without those of the mechanism beside it."""
    return [one for one in read(name).modelspace().query(kinds) if not one.dxf.layer.startswith(FULL_SIZE)]


@pytest.mark.parametrize("name", SCENES)
def test_it_is_sound_and_in_the_units_of_the_scene(name: str) -> None:
    """An audit finds nothing, the header has the scene's unit and its title, and the limits are those of page one."""
    document, sheet = read(name), sheets_of(name)[0]
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    unit, millimetre = UNITS[gp.load(name).units.length]
    assert document.header["$INSUNITS"] == unit
    assert document.header.custom_vars.get("Title") == sheet.title
    (left, bottom), (right, top) = (document.header[key] for key in ("$LIMMIN", "$LIMMAX"))
    assert (right - left, top - bottom) == pytest.approx((millimetre * sheet.width, millimetre * sheet.height))


@pytest.mark.parametrize("name", SCENES)
def test_the_mechanism_is_in_model_space_in_its_own_size(name: str) -> None:
    """Every point of the scene is a point at its own coordinates, and each moving link a line through its points."""
    space, scene = read(name).modelspace(), gp.load(name)
    places = {point: (float(x), float(y)) for point, (x, y) in scene.points.items()}
    points = [tuple(point.dxf.location)[:2] for point in space.query("POINT")]
    assert all(min(math.dist(place, point) for point in points) == 0 for place in places.values())
    for link in scene.moving:
        chains = [[tuple(spot)[:2] for spot in (line.vertices() if line.dxftype() == "LWPOLYLINE"
                                                else (line.dxf.start, line.dxf.end))]
                  for line in space.query(f'LINE LWPOLYLINE[layer=="{FULL_SIZE} link {link}"]')]
        apart = {places[point] for point in scene.links[link]}
        assert bool(chains) == (len(apart) > 1)
        ends = {spot for chain in chains for spot in chain}
        assert all(min(math.dist(spot, place) for place in apart) < 1e-12 * scene.extent for spot in ends)


@pytest.mark.parametrize("name", SCENES)
def test_dimensions_measure_the_links(name: str) -> None:
    """Each moving link of two points has one dimension, which measures it; all measure distances of points, off them.
    """
    scene, space = gp.load(name), read(name).modelspace()
    places = {point: complex(float(x), float(y)) for point, (x, y) in scene.points.items()}
    measured = [(one.get_measurement(), one.dxf.defpoint2, one.dxf.defpoint3, one.dxf.defpoint)
                for one in space.query("DIMENSION")]
    assert measured
    for length, start, end, line in measured:
        ends = [complex(spot.x, spot.y) for spot in (start, end)]
        assert all(min(abs(end - place) for place in places.values()) < 1e-9 * scene.extent for end in ends)
        assert length == pytest.approx(abs(ends[1] - ends[0]))
        assert min(abs(complex(line.x, line.y) - end) for end in ends) > 0.01 * scene.extent
    for names in scene.links.values():
        if len(names) == 2 and (length := abs(places[names[0]] - places[names[1]])) > 0:
            assert any(found == pytest.approx(length) for found, *_ in measured)


@pytest.mark.parametrize("name", SCENES)
def test_every_page_has_a_layout_that_prints_it_in_true_size(name: str) -> None:
    """The paper of a layout is that of its page, and its viewport shows the page where it lies in model space 1:1."""
    document, mm = read(name), millimetre(name)
    names = document.layouts.names_in_taborder()[1:]
    assert len(names) == len(sheets_of(name))
    left, bottom = corner(name)
    for layout, sheet in zip(map(document.layouts.get, names), sheets_of(name), strict=True):
        assert (layout.dxf.paper_width, layout.dxf.paper_height) == (sheet.width, sheet.height)
        (view,) = [one for one in layout.viewports() if one.dxf.id > 1]
        assert (view.dxf.width, view.dxf.height) == (sheet.width, sheet.height)
        assert view.dxf.view_height == pytest.approx(mm * sheet.height)
        middle = view.dxf.view_center_point
        assert (middle.x, middle.y) == pytest.approx((left + mm * sheet.width / 2, bottom + mm * sheet.height / 2))
        left += mm * (sheet.width + 30)


@pytest.mark.parametrize("name", SCENES)
def test_every_step_is_a_layer_in_its_stage(name: str) -> None:
    """Layers of steps are called by stage and number and bear the sentence; all of a step is on its layer."""
    composition, document = composed(name), read(name)
    program, sheet = composition.plans.drawing.drawn, sheets_of(name)[0]
    inked = {item.step for item in sheet.items if item.step is not None and item.step >= program.givens}
    layers = {layer.dxf.name.partition(" - STEP ")[2]: layer for layer in document.layers}
    titles = {step.index: str(stage.title) for stage, steps in program.stages for step in steps}
    assert len(inked) > 0.6 * (len(program) - program.givens)
    for step in inked:
        layer = layers[f"{program.number(step):03}"]
        assert layer.description == composition.plans.sentences[step]
        stage = layer.dxf.name.partition(" - STEP ")[0]
        assert stage.startswith("STAGE ")
        assert step not in titles or stage[9:] == titles[step].replace(":", " -")
        count = sum(1 for one in drawn(name, "*") if one.dxf.layer == layer.dxf.name)
        assert count >= sum(1 for item in sheet.items if item.step == step)


@pytest.mark.parametrize("name", SCENES)
def test_line_types_have_the_dashes_of_the_pens_and_names_that_programs_know(name: str) -> None:
    """Every dashed pen has a line type with its dashes in mm; LibreCAD draws those whose names it knows."""
    dashes = {item.pen.dash for sheet in sheets_of(name) for item in sheet.items if item.pen.dash}
    made = {tuple(abs(tag.value) for tag in kind.pattern_tags.tags if tag.code == 49): kind.dxf.name
            for kind in read(name).linetypes}  # fmt: skip
    assert dashes
    for dash in dashes:
        assert made[dash].rstrip("2") in ("DASHED", "HIDDEN", "DASHDOT", "DIVIDE")


def look(document: Any, entity: Any) -> tuple[str, int, tuple[float, ...]]:
    """Colour, weight and dashes of an entity: its own, or else those of its layer."""
    layer, own = document.layers.get(entity.dxf.layer).dxf, entity.dxf
    colour = own if own.color != BYLAYER else layer
    kind = document.linetypes.get(own.linetype if own.linetype != "BYLAYER" else layer.linetype)
    return (f"#{colour.true_color:06x}" if colour.hasattr("true_color") else pens.INK,
            own.lineweight if own.lineweight >= 0 else layer.lineweight,
            tuple(abs(tag.value) for tag in kind.pattern_tags.tags if tag.code == 49))  # fmt: skip


@pytest.mark.parametrize("name", [*SCENES, "slider-crank"])
def test_strokes_look_as_their_pens_say(name: str) -> None:
    """Colour, weight and dashes of every line, circle and arc, its own or its layer's, are those of its pen."""
    document = read(name)
    thin = [line for line in items(name, Polyline) if len(line.spots) == 2 and line.pen.width <= 1]
    strokes = {"LINE": thin, "CIRCLE": items(name, Circle), "ARC": items(name, Arc)}
    for kind, pencilled in strokes.items():
        found = [look(document, entity) for entity in drawn(name, kind)
                 if not (entity.has_xdata(NAME) and len(entity.get_xdata(NAME)) > 1)]
        assert found == [(item.pen.colour, round(100 * item.pen.width), item.pen.dash) for item in pencilled]


def test_bars_are_as_wide_as_on_the_sheet() -> None:
    """A bar has its width in the drawing itself, wherever no line weights are shown."""
    bars = [line.dxf.const_width for line in drawn("four-bar", "LWPOLYLINE") if line.dxf.const_width]
    assert bars
    assert bars == [line.pen.width for line in items("four-bar", Polyline) if line.pen in (pens.BAR, pens.HOLLOW)]


@pytest.mark.parametrize("name", SCENES)
def test_vectors_are_those_of_the_display_list(name: str) -> None:
    """Each head ends where its vector does, and bears what it is and its true ends."""
    (left, bottom), mm = corner(name), millimetre(name)
    heads = [(entity.dxf.vtx0, entity.get_xdata(NAME)) for entity in drawn(name, "SOLID")]
    found = [(data[0].value, *((spot[0], spot[1]) for spot in (data[1].value, data[2].value, tip)))
             for tip, data in heads]  # fmt: skip
    vectors = [(arrow.label, *((left + mm * x, bottom + mm * y) for x, y in (arrow.start, arrow.end, arrow.end)))
               for arrow in items(name, Arrow)]  # fmt: skip
    assert list(dict.fromkeys(found)) == vectors


@pytest.mark.parametrize("name", SCENES)
def test_texts_are_whole_and_where_they_are_on_the_sheet(name: str) -> None:
    """Each line of letters is one text, as high as on the sheet and in its place; subscripts are stacked in it."""
    (left, bottom), mm = corner(name), millimetre(name)
    found = []
    for entity in drawn(name, "TEXT MTEXT"):
        if entity.dxftype() == "MTEXT":
            high, at = entity.dxf.char_height, entity.dxf.insert
            found.append((entity.plain_text().replace("^", ""), high, at.x, at.y - high))
        else:
            _, first, second = entity.get_placement()
            at = first if second is None or entity.get_align_enum().name == "FIT" else second
            found.append((entity.plain_text(), entity.dxf.height, at.x, at.y))
    texts = [item for item in sheets_of(name)[0].items if isinstance(item, Text)]
    assert len(texts) > 40
    for (words, *place), text in zip(found[: len(texts)], texts, strict=True):
        fitted = set(plain(text.runs)) & set("āēģīķļņū")  # into the room that is measured for it
        x, y = text.box.left if fitted else text.at[0], text.at[1]
        assert words.replace(" ", "") == plain(text.runs).replace(" ", "")
        assert place == pytest.approx((mm * CAPS * text.size, left + mm * x, bottom + mm * y))


@pytest.mark.parametrize("name", ALL[::6])
def test_its_layouts_look_like_the_sheet(name: str) -> None:
    """Of the dark pixels of the page of plans, 99 % are within 0.5 mm of ink of its layout, and the other way round.

    Both are lettered in the font by which the sheet is measured; stacked text, of which ezdxf has a way of its own, is
    left out, and dashed lines are made whole.
    """
    from graphplan.output.dxf import dxf

    sheets = sheets_of(name)[:1]
    document = ezdxf.read(io.StringIO(dxf(sheets, composed(name).plates).decode()))
    space = document.modelspace()
    for text in space.query("MTEXT"):
        space.delete_entity(text)
    for entity in document.entitydb.values():  # each program begins dashes where it pleases
        if entity.dxf.is_supported("linetype"):
            entity.dxf.discard("linetype")
    for layer in document.layers:
        layer.dxf.linetype = "Continuous"
    for style in document.styles:
        style.dxf.font = "DejaVuSans-Bold.ttf" if style.dxf.font == "arialbd.ttf" else "DejaVuSans.ttf"
    for layout, sheet in zip(document.layouts.names_in_taborder()[1:], sheets, strict=True):
        kept = [item if isinstance(item, Text) else replace(item, pen=replace(item.pen, dash=()))
                for item in sheet.items
                if not isinstance(item, Text) or (len(item.runs) == 1 and not item.runs[0].level)]
        ours = imread(io.BytesIO(png(replace(sheet, items=tuple(kept)), dpi=25.4 * PX)))
        theirs = rendered(document, layout, sheet)
        high, wide = (min(sides) for sides in zip(ours.shape[:2], theirs.shape[:2], strict=True))
        light = [picture[-high:, :wide, :3].min(axis=2) for picture in (ours, theirs)]
        for one, other in (light, reversed(light)):
            dark = one < 0.6
            assert (dark & near(other < 0.9)).sum() > 0.99 * dark.sum() > 5_000  # thin lines are faint in one of them


def rendered(document: Any, layout: str, sheet: Sheet) -> Any:
    """A layout as ezdxf draws it, row by row from its upper edge."""
    from ezdxf.addons.drawing import Frontend, RenderContext
    from ezdxf.addons.drawing.config import BackgroundPolicy, Configuration, LineweightPolicy
    from ezdxf.addons.drawing.matplotlib import MatplotlibBackend
    from matplotlib.figure import Figure

    figure, written = Figure(figsize=(sheet.width / 25.4, sheet.height / 25.4)), io.BytesIO()
    axes = figure.add_axes((0, 0, 1, 1))
    look = Configuration(background_policy=BackgroundPolicy.WHITE, lineweight_policy=LineweightPolicy.ABSOLUTE)
    Frontend(RenderContext(document), MatplotlibBackend(axes, adjust_figure=False), config=look).draw_layout(
        document.layouts.get(layout))
    axes.set(xlim=(0, sheet.width), ylim=(0, sheet.height), aspect="auto")
    axes.set_position((0, 0, 1, 1))
    figure.savefig(written, dpi=25.4 * PX, format="png")
    return imread(io.BytesIO(written.getvalue()))


def near(ink: Any) -> Any:
    """Where ink is at most 0.5 mm away."""
    reach, found = int(PX / 2), np.zeros_like(ink)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            if dx * dx + dy * dy <= reach * reach:
                found |= np.roll(ink, (dy, dx), (0, 1))
    return found


def test_hollow_marks_cover_what_lies_behind() -> None:
    """Each circle with a paper filling has a wipeout of its size beneath it, and tints are solid hatches."""
    left, bottom = corner("four-bar")
    hollow = [item for item in sheets_of("four-bar")[0].items if isinstance(item, Circle)
              and item.pen.fill == pens.PAPER]  # fmt: skip
    centres = [tuple(sum(spot[axis] for spot in corners) / len(corners) for axis in (0, 1))
               for corners in (list(cover.boundary_path_wcs())[:-1] for cover in drawn("four-bar", "WIPEOUT"))]
    for x, y in (item.centre for item in hollow):
        assert min(math.dist((left + x, bottom + y), centre) for centre in centres) < 1e-6
    assert all(hatch.dxf.solid_fill for hatch in read("four-bar").modelspace().query("HATCH"))


@pytest.mark.costly
def test_the_bytes_are_the_same_every_time() -> None:
    """A second run, in another process with other hashes, gives the same bytes; ezdxf's settings stay as they are."""
    from graphplan.output.dxf import dxf

    code = ("import sys, graphplan as gp; from graphplan.sheet.layout.composition import compose; "
            "from graphplan.sheet.layout.layout import pages; from graphplan.output.dxf import dxf; "
            "sheet = compose(gp.construct(gp.load('four-bar'))); "
            "sys.stdout.buffer.write(dxf(pages(sheet), sheet.plates))")
    env = {"PYTHONHASHSEED": "7", "PYTHONPATH": ":".join(sys.path)}
    run = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, check=True)
    assert run.stdout == dxf(sheets_of("four-bar"), composed("four-bar").plates)
    assert not ezdxf.options.write_fixed_meta_data_for_testing
