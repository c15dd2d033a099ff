"""Claims about exports: read by their own program or by a reader, they say what `steps` and `solve` say."""

from __future__ import annotations

import ctypes
import io
import json
import math
import re
import shutil
import subprocess
from collections import Counter
from functools import cache
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
import shapely
import tikz_reader
from claim import claim
from face import Got, got, ran
from geogebra_reader import Ray, Round, opened, read
from inked_sheet import NS, InkedSheet, said
from live_browser import browser
from PIL import Image

import graphplan as gp

VALUE = re.compile(r'"([va])_\{?(\w+)\}? = " \+ \((\S+) \* Length\[(\S+)\]\)')
KIND = {"v": "velocity", "a": "acceleration"}


@cache
def exported(name: str, ending: str) -> bytes:
    """The file that `export` writes of a scene; of a sheet its first page."""
    with TemporaryDirectory() as folder:
        done = ran("export", name, "-q", "-o", file := Path(folder, f"file.{ending}"))
        assert done.status == 0, done.err
        return file.read_bytes()


@cache
def sheet(name: str) -> InkedSheet:
    """The sheet of a scene."""
    return InkedSheet.of(exported(name, "svg").decode())


@cache
def size(name: str) -> tuple[float, float]:
    """The width and height of the sheet: exports count from its lower edge, steps and SVG from the upper one."""
    _, _, wide, high = map(float, sheet(name).root.get("viewBox", "").split())
    return wide, high


def points(name: str, kind: str = "point") -> dict[int, complex]:
    """Where the points of the construction lie on paper, from the lower left corner, by their place among the steps."""
    return {k: complex(step["paper"][0], size(name)[1] - step["paper"][1])
            for k, step in enumerate(got(name).steps["steps"]) if step["kind"] == kind}


def apart(places: Any, found: Any) -> float:
    """How far the farthest of some places is from all that are found, relative to how far out it lies."""
    tree = shapely.STRtree([shapely.Point(z.real, z.imag) for z in found if np.isfinite(z)])
    spots = [shapely.Point(z.real, z.imag) for z in places]
    nearest = tree.query_nearest(spots, return_distance=True, all_matches=False)[1]
    return float(max(gap / max(100.0, abs(z)) for gap, z in zip(nearest, places, strict=True)))


@cache
def figure(name: str) -> Any:
    """The document of a scene's GeoGebra file."""
    return opened(exported(name, "ggb"))


@claim()
def geogebra_has_every_mark_where_the_sheet_has_it(got: Got) -> None:
    """Each point, line and circle that a step makes is an object of the file, by commands that are known."""
    values = [*read(figure(got.name)).values()]
    assert apart([*points(got.name).values()], [value for value in values if isinstance(value, complex)]) < 1e-8
    lines = [value for value in values if isinstance(value, Ray)]
    rounds = [value for value in values if isinstance(value, Round)]
    high = size(got.name)[1]
    for step in got.steps["steps"]:
        if step["kind"] == "line":
            a, b, c = step["paper"]
            normal, offset = complex(a, -b), c + b * high
            assert min(abs((normal.conjugate() * (line.along / abs(line.along))).real)
                       + abs((normal.conjugate() * line.at).real + offset) / max(100.0, abs(line.at))
                       for line in lines) < 1e-7, step["sentence"]
        elif step["kind"] == "circle":
            x, y, radius = step["paper"]
            assert min(abs(one.at - complex(x, high - y)) + abs(one.radius - radius) for one in rounds) < 1e-6


@claim(having=lambda scene: scene.drives and not scene.motions)
def geogebra_shows_the_numbers_of_any_pose(got: Got) -> None:
    """With the sliders moved, the sizes written at vectors are those of `solve --at`, and points are where they go."""
    document = figure(got.name)
    slider = next(document.iter("slider"))
    low, high = (float(slider.get(end, "")) for end in ("min", "max"))
    drives = got.scene.drives
    pace = [float(abs(drive.rate) / abs(drives[0].rate)) if drives[0].rate else float(not k)
            for k, drive in enumerate(drives)]
    for share in (0.07, 0.41, 0.83):
        travel = low + (high - low) * share
        solved = ran("solve", got.name, "--at", ",".join(repr(travel * one) for one in pace))
        if solved.status:  # a singular pose, or one that is found nowhere
            continue
        values = read(document, {f"drive_{{{k}}}": travel * one for k, one in enumerate(pace, 1)})
        poses = gp.follow(got.scene, 2, (0.0, travel))
        spots = [value for value in values.values() if isinstance(value, complex)]
        assert apart(on_paper(got, [z[1] for z in poses.points.values()]), spots) < 1e-6
        texts = [*filter(None, (VALUE.match(one.get("exp", "")) for one in document.iter("expression")))]
        assert texts
        for kind, point, scale, label in (text.groups() for text in texts):
            sizes = {name: math.hypot(*rates[KIND[kind]]) for name, rates in solved.json["points"].items()
                     if rates.get(KIND[kind])}
            told = float(scale.strip("()")) * abs(values[label].z)
            assert point not in sizes or abs(told - sizes[point]) < 1e-6 * max(sizes.values()), (travel, kind, point)


def on_paper(got: Got, others: list[complex]) -> list[complex]:
    """Places on the mechanism plan, by where its given points lie on paper: shifted and enlarged."""
    places = {step["makes"]: points(got.name)[k] for k, step in enumerate(got.steps["steps"])
              if step["operation"] == "given" and step["makes"] in got.scene.points}
    given = {name: complex(*map(float, got.scene.points[name])) for name in places}
    one, two = max(combinations(places, 2), key=lambda pair: abs(given[pair[0]] - given[pair[1]]))
    scale = (places[one] - places[two]) / (given[one] - given[two])
    assert abs(scale.imag) < 1e-9 * scale.real
    return [places[one] + scale.real * (z - given[one]) for z in others]


# ---- LaTeX -----------------------------------------------------------------------------------------------------------


@claim()
def latex_has_every_mark_where_the_sheet_has_it(got: Got) -> None:
    """Computed as TeX does, the coordinates of the picture are the places of the points, each under its sentence."""
    source = exported(got.name, "tex").decode()
    spots = tikz_reader.coordinates(source)
    assert apart([z for z in points(got.name).values() if abs(z) < 1900], [*spots.values()]) < 1e-5
    at = 0
    for step in got.steps["steps"]:
        if step["number"]:
            at = source.index(f"\n% {step['number']}. ", at) + 1
    bare = re.sub(r"(?<!\\)%.*", "", source).replace(r"\{", "").replace(r"\}", "")
    assert bare.count("{") == bare.count("}")
    assert bare.isascii()
    assert bare.count(r"\begin{scope}") == len({step["plan"] for step in got.steps["steps"]})


# ---- code ------------------------------------------------------------------------------------------------------------

NODE = """
import { readFileSync } from "node:fs";
const { inputs, outputs, pose, poses } = await import(process.argv[2]);
const read = JSON.parse(readFileSync(0)).map(row => row.map(x => x ?? NaN)), n = read[0].length;
const x = read.map(row => Float64Array.from(row)), y = outputs.map(() => new Float64Array(n));
const undrawn = poses(n, x, y);
console.log(JSON.stringify({ inputs, outputs, undrawn, numbers: y.map(row => Array.from(row)), one: pose() }));
"""
POSES = 6


class Code:
    """A scene's code with poses near the given one, one all in a place, one unknown, and what Python makes of them."""

    def __init__(self, name: str):
        self.got = got(name)
        self.head = self.got.printed("export", "--format", "c", "-o", "-").partition("#include")[0]
        self.inputs, dice = self.names("in"), np.random.default_rng(7)
        read = {name.split()[1] for name in self.inputs if name.startswith("point")}
        given = {name: complex(*map(float, self.got.scene.points[name])) for name in self.got.scene.points}
        far = 0.01 * max(map(abs, given.values()))
        moved = {given[name]: np.array([*(given[name] + far * dice.normal(size=(POSES, 2)) @ [1, 1j]), 0, math.nan])
                 for name in read}  # what lies together stays together
        self.points = {name: moved.get(z, np.full(POSES + 2, z)) for name, z in given.items()}
        driven = any(name.startswith("guide") for name in self.inputs)
        guides = gp.follow(self.got.scene, 2).turn.guides if driven else {}
        self.guides = {name: np.array([z[0]] * (POSES + 1) + [math.nan]) for name, z in guides.items()}
        self.motion = self.got.drawing.evaluate(points=self.points, guides=self.guides)

    def names(self, way: str) -> list[str]:
        """What the head says that is read or given, without units."""
        return [line.rpartition(",")[0] for line in re.findall(rf"//   {way}\[\d+\]  (.*)", self.head)]

    @property
    def numbers(self) -> Any:
        """The inputs, a row each."""
        rows = []
        for name in self.inputs:
            kind, of, part = re.fullmatch(r"(point|guide) (.+) (x|y)(?:, of whatever length)?", name).groups()
            z = (self.points if kind == "point" else self.guides)[of]
            rows.append(z.real if part == "x" else z.imag)
        return np.array(rows)

    @property
    def right(self) -> dict[str, Any]:
        """The results of Python by the names that code gives them."""
        named = {f"{kind} {of}": z for kind, all_of in self.motion.results.items() for of, z in all_of.items()}
        parts = {name: {" x": z.real, " y": z.imag} if np.iscomplexobj(z) else {"": z} for name, z in named.items()}
        return {name + part: values for name, own in parts.items() for part, values in own.items()}


@claim()
def code_gives_the_numbers_of_python_to_the_last_bit(got: Got) -> None:
    """Compiled as its head says, C gives what Python computes of any pose, in the order of its head, nan where a pose
    is unknown; so does JavaScript, whose default pose is that of the scene."""
    code = Code(got.name)
    right = np.array([code.right[name] for name in code.names("out")])
    lost = sorted({*code.motion.faults, *np.flatnonzero(np.isnan(right).any(axis=0))})
    assert POSES + 1 in lost
    right[:, lost] = math.nan
    for numbers, undrawn in (by_c(code), by_node(code)):
        assert np.array_equal(numbers, right, equal_nan=True)
        assert undrawn == len(lost)


def by_c(code: Code) -> tuple[Any, int]:
    compiler = shutil.which("cc") or pytest.skip("no C compiler is at hand")
    options = re.search(r"cc (-.*) -c FILE\.c", code.head)[1].split()
    with TemporaryDirectory() as folder:
        source, library = Path(folder, "plan.c"), Path(folder, "plan.so")
        source.write_bytes(exported(code.got.name, "c"))
        strict = ("-std=c99", "-Wall", "-Werror", "-shared", "-fPIC")
        subprocess.run([compiler, *options, *strict, str(source), "-o", str(library), "-lm"], check=True)
        function = ctypes.CDLL(str(library)).graphplan_poses
    function.restype = ctypes.c_size_t
    read, found = np.ascontiguousarray(code.numbers), np.empty((len(code.names("out")), POSES + 2))
    arrays = [(ctypes.c_void_p * len(rows))(*(row.ctypes.data for row in rows)) for rows in (read, found)]
    return found, function(ctypes.c_size_t(POSES + 2), *arrays)


def by_node(code: Code) -> tuple[Any, int]:
    node = shutil.which("node") or pytest.skip("node is not at hand")
    with TemporaryDirectory() as folder:
        module, script = Path(folder, "plan.mjs"), Path(folder, "run.mjs")
        module.write_bytes(exported(code.got.name, "js"))
        script.write_text(NODE, encoding="utf-8")
        told = json.dumps([[None if math.isnan(x) else x for x in row] for row in code.numbers])
        done = subprocess.run([node, str(script), str(module)], input=told, capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert [found["inputs"], found["outputs"]] == [code.names("in"), code.names("out")]
    solved = code.got.solved["points"]
    for of, value in found["one"].get("velocity", {}).items():
        assert of not in solved or value == pytest.approx(solved[of]["velocity"], rel=1e-12, abs=1e-9)
    numbers = [[math.nan if number is None else number for number in row] for row in found["numbers"]]
    return np.array(numbers), found["undrawn"]


# ---- DXF -------------------------------------------------------------------------------------------------------------

UNITS = {"mm": (4, 1.0), "cm": (5, 0.1), "m": (6, 0.001)}  # how the header calls them, and a millimetre
FULL_SIZE, XDATA = "MECHANISM 1-1", "GRAPHPLAN"


@cache
def drawing(name: str) -> Any:
    """The DXF of a scene, as ezdxf reads it."""
    ezdxf = pytest.importorskip("ezdxf")
    return ezdxf.read(io.StringIO(exported(name, "dxf").decode()))


def on_sheet(name: str, kinds: str) -> list[Any]:
    """The entities of the sheet, without those of the mechanism beside it."""
    return [one for one in drawing(name).modelspace().query(kinds) if not one.dxf.layer.startswith(FULL_SIZE)]


@claim()
def dxf_has_the_mechanism_in_its_own_size(got: Got) -> None:
    """Every point stands at its coordinates, a link is a line through its points, and dimensions measure
    distances of points; an audit finds no fault."""
    document, scene = drawing(got.name), got.scene
    audit = document.audit()
    assert not audit.errors + audit.fixes
    assert document.header["$INSUNITS"] == UNITS[scene.units.length][0]
    assert document.header.custom_vars.get("Title") == sheet(got.name).root.findtext(f"{NS}title")
    space, places = document.modelspace(), {name: complex(*map(float, at)) for name, at in scene.points.items()}
    points = [complex(*tuple(point.dxf.location)[:2]) for point in space.query("POINT")]
    assert all(min(abs(place - point) for point in points) == 0 for place in places.values())
    for link in scene.moving:
        chains = [line for line in space.query("LINE LWPOLYLINE") if line.dxf.layer == f"{FULL_SIZE} link {link}"]
        spots = {complex(*tuple(spot)[:2]) for line in chains for spot in (
            line.vertices() if line.dxftype() == "LWPOLYLINE" else (line.dxf.start, line.dxf.end))}
        own = {places[name] for name in scene.links[link]}
        assert bool(chains) == (len(own) > 1)
        assert all(min(abs(spot - place) for place in own) < 1e-12 * scene.extent for spot in spots)
    measured = {}
    for one in space.query("DIMENSION"):
        ends = [complex(spot.x, spot.y) for spot in (one.dxf.defpoint2, one.dxf.defpoint3)]
        assert all(min(abs(end - place) for place in places.values()) < 1e-9 * scene.extent for end in ends)
        assert one.get_measurement() == pytest.approx(abs(ends[1] - ends[0]))
        measured[round(one.get_measurement() / scene.extent, 9)] = one
    for names in scene.links.values():
        if len(names) == 2 and (long := abs(places[names[0]] - places[names[1]])):
            assert round(long / scene.extent, 9) in measured


@claim()
def dxf_has_the_sheet_with_a_layer_for_each_step(got: Got) -> None:
    """Texts, vectors, dashes and bars are those of the SVG; each step's ink is on a layer that bears its sentence, and
    the page has a layout that prints it in true size."""
    document, svg = drawing(got.name), sheet(got.name)
    mm = UNITS[got.scene.units.length][1]
    wide, high = size(got.name)
    corner = complex(*document.header["$LIMMIN"][:2])
    texts = Counter(one.plain_text().replace("^", "").replace(" ", "") for one in on_sheet(got.name, "TEXT MTEXT"))
    written = Counter(said(text).replace(" ", "").replace("\u200a", "") for text in svg.root.iter(f"{NS}text"))
    assert not written - texts
    heads = [(data[0].value, *((complex(*one.value[:2]) - corner) / mm for one in data[1:3]))
             for one in on_sheet(got.name, "SOLID") if one.has_xdata(XDATA) and (data := one.get_xdata(XDATA))]
    for vector in filter(lambda vector: vector.name, svg.vectors):
        (x, y), (u, v) = vector.line.coords
        assert any(name == vector.name and abs(start - complex(x, high - y)) + abs(end - complex(u, high - v)) < 0.02
                   for name, start, end in heads), vector.name
    dashes = {tuple(map(float, re.split("[ ,]+", e.get("stroke-dasharray")))) for _, e in svg.elements
              if e.get("stroke-dasharray", "none") != "none"}
    made = {tuple(tag.value * (-1 if k % 2 else 1) for k, tag in enumerate(tags)) for tags in (
        [tag for tag in kind.pattern_tags.tags if tag.code == 49] for kind in document.linetypes)}  # gaps are negative
    assert dashes <= made
    bars = Counter(line.dxf.const_width / mm for line in on_sheet(got.name, "LWPOLYLINE") if line.dxf.const_width)
    thick = Counter(float(e.get("stroke-width", 0)) for _, e in svg.elements if e.tag == f"{NS}polyline")
    assert bars == {width: count for width, count in thick.items() if width > 1}
    layers = {layer.dxf.name.partition(" - STEP ")[2]: layer for layer in document.layers}
    sentences = {step["number"]: step["sentence"] for step in got.steps["steps"]}
    inked = {int(key) for key, _ in svg.elements if key.isdigit()} - {0}
    assert len(inked) > 0.6 * max(sentences)
    used = {one.dxf.layer for one in on_sheet(got.name, "*")}
    for number in inked:
        layer = layers[f"{number:03}"]
        assert layer.dxf.name in used
        assert sentences[number].startswith(layer.description.partition(" (")[0].rstrip("."))
    layout = document.layouts.get(document.layouts.names_in_taborder()[1])
    assert (layout.dxf.paper_width, layout.dxf.paper_height) == (wide, high)
    view, = (one for one in layout.viewports() if one.dxf.id > 1)
    middle = view.dxf.view_center_point
    assert (view.dxf.width, view.dxf.height, view.dxf.view_height) == pytest.approx((wide, high, mm * high))
    assert (middle.x, middle.y) == pytest.approx((corner.real + mm * wide / 2, corner.imag + mm * high / 2))


# ---- PDF and PNG -----------------------------------------------------------------------------------------------------


@claim()
def pdf_and_png_are_the_sheet_as_a_browser_shows_its_svg(got: Got) -> None:
    """The page has the sheet's size, title and words, and the ink of all three is within half a millimetre."""
    pdfium = pytest.importorskip("pypdfium2")
    document = pdfium.PdfDocument(exported(got.name, "pdf"))
    page, (wide, high) = document[0], size(got.name)
    assert page.get_size() == pytest.approx((wide * 72 / 25.4, high * 72 / 25.4), abs=0.01)
    about, svg = document.get_metadata_dict(), sheet(got.name)
    assert (about["Title"], about["Author"], about["CreationDate"]) == (svg.root.findtext(f"{NS}title"), "", "")
    text = "".join(page.get_textpage().get_text_range().split())
    assert not [told for _, one in svg.texts if (told := "".join(said(one).split())) not in text and len(told) > 20]
    with TemporaryDirectory() as folder:
        file = Path(folder, "file.png")
        assert ran("draw", got.name, "-q", "--dpi", "102", "-o", file).status == 0
        pictures = dark(file.read_bytes()), dark(in_browser(exported(got.name, "svg"), wide, high))
    rendered = np.asarray(page.render(scale=102 / 72).to_pil().convert("L")) < 200
    for picture in pictures:
        assert uncovered(rendered, picture) < 0.01
        assert uncovered(picture, rendered) < 0.01


def dark(png: bytes) -> Any:
    """Where a picture has ink."""
    return np.asarray(Image.open(io.BytesIO(png)).convert("L")) < 200


def in_browser(svg: bytes, wide: float, high: float) -> bytes:
    """An SVG as Chromium shows it, 102 dots an inch."""
    width, height = int(wide * 102 / 25.4), int(high * 102 / 25.4)
    page = browser().new_page(viewport={"width": width, "height": height})
    page.set_content(f"<style>body {{ margin: 0 }} svg {{ width: {width}px; height: {height}px; display: block }}"
                     f"</style>{svg[svg.index(b'<svg'):].decode()}")
    picture: bytes = page.screenshot()
    page.close()
    return picture


def uncovered(one: Any, other: Any) -> float:
    """The part of some ink that has no other ink within two pixels, half a millimetre."""
    high, wide = (min(sides) for sides in zip(one.shape, other.shape, strict=True))
    one, other = one[:high, :wide], other[:high, :wide]
    near = sum(np.roll(other, (dy, dx), (0, 1)) for dy in range(-2, 3) for dx in range(-2, 3)) > 0
    return float((one & ~near).sum() / one.sum())
