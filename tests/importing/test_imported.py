"""Linkages of other programs as scenes: what each file must give, what is refused, what comes back of own exports."""

from __future__ import annotations

import cmath
import re
import zipfile
from pathlib import Path
from typing import Any

import pytest
from packaged_scenes import read, those
from samples import SAMPLES, as_address, as_drawing, as_linkage, as_pmks, geogebra, packed, point, segments, turning

import graphplan as gp
from graphplan.commands import main
from graphplan.importing import import_scene
from graphplan.importing.lz_string import unpack
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.scene import parse


def taken(data: bytes, name: str, folder: Path) -> str:
    """The scene of a file."""
    path = folder / name
    path.write_bytes(data)
    return import_scene(path)[0]


def at(scene: Scene, point: str) -> tuple[float, float]:
    x, y = map(float, scene.points[point])
    return round(x, 9) + 0.0, round(y, 9) + 0.0


def linked(scene: Scene) -> dict[frozenset[tuple[float, float]], int]:
    """The moving links by where their points are, each with how many there are of them; and the frame's points."""
    found: dict[Any, int] = {}
    for link, points in scene.links.items():
        key = frozenset({at(scene, name) for name in points} | ({(9e9, 9e9)} if link == FRAME else set()))
        found[key] = found.get(key, 0) + 1
    return found


def moved(scene: Scene) -> dict[tuple[float, float], list[complex]]:
    """The velocity and acceleration of each point, by where it is."""
    rates = gp.analytic.solve(scene)
    found: dict[tuple[float, float], list[complex]] = {}
    for name in scene.points:
        if name in rates.velocity:
            found.setdefault(at(scene, name), []).append(rates.velocity[name])
    return found


@pytest.mark.parametrize("name", SAMPLES)
def test_a_file_gives_the_scene_that_is_written_by_hand(name: str, tmp_path: Path) -> None:
    """Points, links and units are the same, and so are the velocities."""
    data, text = SAMPLES[name]
    scene = parse(taken(data, name, tmp_path), name)
    meant = parse("\n".join(line.strip() for line in text.splitlines()), name)
    assert linked(scene) == linked(meant)
    assert scene.units == meant.units
    found, wanted = moved(scene), moved(meant)
    assert found.keys() == wanted.keys()
    for place, velocities in wanted.items():
        assert found[place] == pytest.approx(velocities, rel=1e-9, abs=1e-9), place


TRUE = '"true"'
TURNING = those(lambda scene: turning(scene) and not scene.gears + scene.contacts)
REVOLUTE = [name for name in TURNING if not read(name).slides]


@pytest.mark.parametrize("name", TURNING)
def test_packaged_scenes_come_back_from_every_format_that_can_carry_them(name: str, tmp_path: Path) -> None:
    """Points, links up to their names, and velocities; of drawings, which know no speed, those of the same crank."""
    scene = gp.load(name)
    forms = {"a.txt": as_pmks} if len(scene.drives) == 1 else {}
    forms |= {"a.linkage2": as_linkage, "a.ggb": as_drawing} if name in REVOLUTE else {}
    for file, form in forms.items():
        found = parse(taken(form(scene), file, tmp_path), file)
        assert linked(found) == linked(scene), file
        if file != "a.ggb":
            wanted = moved(scene)
            for place, velocities in moved(found).items():
                assert sorted(velocities, key=abs) == pytest.approx(sorted(wanted[place], key=abs), rel=1e-7, abs=1e-7)


ADDRESSED = those(lambda scene: turning(scene) and not scene.gears + scene.contacts and as_address(scene))


@pytest.mark.parametrize("name", ADDRESSED)
def test_packaged_scenes_come_back_from_addresses(name: str, tmp_path: Path) -> None:
    """Slots on the frame and on links, blocks, own speeds: every point has its velocity."""
    scene = gp.load(name)
    found, wanted = moved(parse(taken(as_address(scene), "a.txt", tmp_path), "a")), moved(scene)
    for place, velocities in wanted.items():
        assert sorted(map(abs, found[place])) == pytest.approx(sorted(map(abs, velocities)), rel=1e-7, abs=1e-7), place


@pytest.mark.parametrize("form", ["ggb", "dxf", "svg", "pdf"])
@pytest.mark.parametrize("name", ["slotted-link", "jaanimets-10"])
def test_own_files_give_back_their_scene(name: str, form: str, tmp_path: Path) -> None:
    """Letter by letter, with its questions, loads and comments."""
    if form == "dxf":
        pytest.importorskip("ezdxf")
    made, back = tmp_path / f"a.{form}", tmp_path / "b.toml"
    assert main(["export", name, "-o", str(made)]) == 0
    assert main(["import", str(made), "-o", str(back)]) == 0
    assert back.read_text(encoding="utf-8") == gp.load(name).text


@pytest.mark.parametrize("form", ["ggb", "dxf"])
def test_own_files_that_were_saved_anew_are_read_as_drawings(form: str, tmp_path: Path) -> None:
    """Without the scene that they carry the links have the same points, by name, and the frame is the same."""
    if form == "dxf":
        pytest.importorskip("ezdxf")
    path, meant = tmp_path / f"a.{form}", gp.load("stephenson")
    assert main(["export", "stephenson", "-o", str(path)]) == 0
    if form == "ggb":
        with zipfile.ZipFile(path) as archive:
            drawing = archive.read("geogebra.xml")
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("geogebra.xml", drawing)
    else:
        path.write_bytes(re.sub(rb"999\nscene: [^\n]*\n", b"", path.read_bytes()))
    found = parse(import_scene(path)[0], "saved anew")
    assert {frozenset(points) for points in found.links.values()} == {frozenset(points) for points in
                                                                      meant.links.values()}


# ---- DXF -------------------------------------------------------------------------------------------------------------


def drawn(path: Path, unit: int, bars: dict[str, list[tuple[float, float]]], ground: tuple[float, float] | None = None,
          letters: dict[str, tuple[float, float]] | None = None) -> Scene:
    """The scene of a DXF drawing of these lines and closed polylines by layer, one layer name to each."""
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new("R2010", units=unit)
    space = document.modelspace()
    for layer, corners in bars.items():
        space.add_lwpolyline(corners, close=len(corners) > 2, dxfattribs={"layer": layer.strip("'")})
        space.add_circle(corners[0], 1, dxfattribs={"layer": "0"})
    if ground:
        space.add_circle(ground, 1, dxfattribs={"layer": "ground"})
    for letter, (x, y) in (letters or {}).items():
        space.add_text(letter, height=4, dxfattribs={"insert": (x + 2, y + 2)})
    document.saveas(path)
    return parse(import_scene(path)[0], "drawing")


def test_lines_of_dxf_are_bars_and_polylines_links(tmp_path: Path) -> None:
    """Ends that nearly meet are one joint, texts are names, the unit is the drawing's, and ends of the chain the frame.
    """
    bars = {"x": [(0, 0), (0, 35)], "y": [(0.001, 35), (100, 60), (50, 90)], "z": [(100, 60), (110, 0)]}
    letters = {"A": (0, 0), "B": (0, 35), "C": (100, 60), "D": (110, 0), "E": (50, 90)}
    found = drawn(tmp_path / "a.dxf", 5, bars, letters=letters)  # type: ignore[arg-type]
    assert found.units.length == "cm"
    assert {frozenset(points) for points in found.links.values()} == {*map(frozenset, ("AB", "BCE", "CD", "AD"))}
    assert [drive.link for drive in found.drives] == [next(link for link, held in found.links.items() if "B" in held
                                                           and "A" in held)]


def test_layers_of_dxf_tell_the_frame_the_guide_and_the_drive(tmp_path: Path) -> None:
    """What is on them is fixed, lets slide, and drives."""
    bars = {"crank": [(0, 0), (20, 30)], "0": [(20, 30), (90, 0)], "guide": [(60, 0), (120, 0)]}
    found = drawn(tmp_path / "a.dxf", 1, bars, ground=(0, 0))  # type: ignore[arg-type]
    assert found.units.length == "in"
    assert [slide.along for slide in found.slides] == [FRAME]
    assert [at(found, point) for point in found.links[found.drives[0].link]] == [(0, 0), (20, 30)]


def test_a_guide_along_a_bar_is_on_its_link(tmp_path: Path) -> None:
    """A pin on it slides along the link, and is no joint of it."""
    bars = {"crank": [(0, 30), (20, 30)], "0": [(0, 0), (40, 60)], "guide": [(10, 15), (30, 45)]}
    found = drawn(tmp_path / "a.dxf", 4, bars, ground=(0, 0))  # type: ignore[arg-type]
    assert [{at(found, point) for point in found.links[slide.along]} for slide in found.slides] == [{(0, 0), (40, 60)}]


# ---- what cannot be told, and what is refused ------------------------------------------------------------------------


def test_guesses_are_comments(tmp_path: Path) -> None:
    """A frame and a drive that a drawing does not tell are proposed, with a comment each."""
    bars = geogebra(*(point(name, at) for name, at in {"A": 0j, "B": 1 + 2j, "C": 5 + 3j, "D": 6 + 0j}.items()),
                    segments("A B", "B C", "C D"))
    text = taken(bars, "plain.ggb", tmp_path)
    assert "# - what is fixed: A and D on the frame is a guess, as the chain ends there" in text
    assert "# - which link drives: mobility 1" in text
    assert 'frame = "A D"' in text


def test_too_many_drives_are_left_out(tmp_path: Path) -> None:
    """Two inputs of a mechanism of mobility one: the first stays, and a comment tells of the other."""
    text = taken(SAMPLES["four-bar.linkage2"][0].replace(b'anchor="true" x="110"',
                                                         b'anchor="true" input="true" rpm="5" x="110"'), "a.linkage2",
                 tmp_path)
    assert text.count("[[drive]]") == 1
    assert "so of its drives were left out: link 3 (rpm = -5)" in text


def test_gears_about_one_centre_are_comments(tmp_path: Path) -> None:
    """What a scene cannot have is told, and the rest comes through."""
    text = taken(SAMPLES["actuator.linkage2"][0], "a.linkage2", tmp_path)
    assert "gears between the links of id 1 and 2, sizes 1 : 2: left out" in text


def curved(pin: complex, radius: float, ends: tuple[complex, complex], along: bool) -> bytes:
    """A four-bar as Linkage has it whose rocker is a curved slot, of the frame, or of a link that stands still."""
    held = 'anchor="true" ' if not along else ""
    places = {"0": 0j, "1": 35j, "2": pin, "3": ends[0], "4": ends[1], "5": 130 - 20j, "6": 150 + 10j}
    looks = {"0": 'anchor="true" input="true" rpm="30"', "3": held, "4": held, "5": 'anchor="true"',
             "6": 'anchor="true"', "2": f'slider="true" slideradius="{radius}"'}
    limits = '<slidelimit id="3"/><slidelimit id="4"/>'
    rows = "".join(f'<connector id="{key}" x="{at.real!r}" y="{at.imag!r}" {looks.get(key, "")}>'
                   f'{limits if key == "2" else ""}</connector>' for key, at in places.items())
    links = ["01", "12", *(["34", "3456"] if along else [])]
    return ("<linkage2>" + rows + "".join(
        "<Link>" + "".join(f'<connector id="{key}"/>' for key in link) + "</Link>" for link in links) + "</linkage2>"
    ).encode()


@pytest.mark.parametrize("along", [False, True])
@pytest.mark.parametrize("turned", [1, -1])
def test_a_pin_in_a_curved_slot_goes_as_at_the_end_of_a_link(tmp_path: Path, turned: int, along: bool) -> None:
    """The slot's centre carries a link that ends in the pin: it moves as the four-bar's, in slots bent either way."""
    centre, pin = 110 + 0j, 100 + 60j
    ends = [centre + (pin - centre) * cmath.rect(1, turn) for turn in (-0.3, 0.4)]
    first, last = ends[::turned]
    data = curved(pin, turned * abs(pin - centre), (first, last), along)
    text = taken(data, "a.linkage2", tmp_path)
    assert "a link from the slot's centre stands for it" in text
    found, four_bar = parse(text, "a"), parse(taken(SAMPLES["four-bar.linkage2"][0], "b.linkage2", tmp_path), "b")
    assert found.links_of["C"] == ("2", "slot of C")
    there, expected = gp.solve(found), gp.solve(four_bar)
    assert there.velocity["C"] == pytest.approx(expected.velocity["C"])
    assert there.acceleration["C"] == pytest.approx(expected.acceleration["C"])


def test_a_curved_slot_that_its_pin_is_not_in_is_named(tmp_path: Path) -> None:
    """One line says which pin, and that it was left out."""
    text = taken(curved(100 + 60j, 90.0, (80 + 70j, 120 + 70j), False), "a.linkage2", tmp_path)
    assert "C slides in a curved slot, of radius 90, but is not in it, or no link has it: left out" in text
    text = taken(curved(100 + 60j, 90.0, (80 + 70j, 80 + 70j), False), "a.linkage2", tmp_path)
    assert "C slides, but the file does not tell along what: left out" in text


def test_names_are_kept_where_they_may(tmp_path: Path) -> None:
    """Blanks and commas go, a subscript loses its braces, and a name that is taken gets a number."""
    data = SAMPLES["four-bar.linkage2"][0].decode()
    for place, name in (('y="0.000000"', "A, left"), ('y="35"', "B_{12}"), ('y="60"', "B_{12}")):
        data = data.replace(place, f'{place} name="{name}"', 1)
    found = parse(taken(data.encode(), "a.linkage2", tmp_path), "a")
    assert [*found.points] == ["Aleft", "B_12", "B_122", "D"]


def test_a_link_has_all_its_points(tmp_path: Path) -> None:
    """However many they are."""
    rows = "".join(f'<connector id="{k}" x="{k}" y="{k * k % 7}"{" anchor=" * (not k)}{TRUE * (not k)}/>'
                   for k in range(120))
    link = "".join(f'<connector id="{k}"/>' for k in range(120))
    found = parse(taken(f"<linkage2>{rows}<Link>{link}</Link></linkage2>".encode(), "a.linkage2", tmp_path), "a")
    assert len(found.links["1"]) == 120


def bomb() -> bytes:
    import io

    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("geogebra.xml", b"<geogebra>" + b" " * (40 << 20) + b"</geogebra>")
    return held.getvalue()


GOOD = {name: data for name, (data, _) in SAMPLES.items()}
LAUGH = b'<!DOCTYPE l [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;">]><linkage2>&b;</linkage2>'
HOSTILE = {
    "empty.ggb": b"", "nothing.txt": b"once upon a time", "binary.dat": bytes(range(256)) * 40, "bomb.ggb": bomb(),
    "laugh.linkage2": LAUGH, "cut.ggb": GOOD["circles.ggb"][:200], "cut.linkage2": GOOD["four-bar.linkage2"][:300],
    "cut.csv": GOOD["table.csv"][:60], "cut.txt": GOOD["short.txt"][:-3], "data.txt": GOOD["data.txt"][:-9],
    "latin.linkage2": b'<linkage2><connector id="0" name="\xe9" x="1" y="2"/></linkage2>',
    "nan.linkage2": GOOD["four-bar.linkage2"].replace(b'x="100"', b'x="nan"'),
    "huge.linkage2": GOOD["four-bar.linkage2"].replace(b'x="100"', b'x="1e300"'),
    "no-links.linkage2": b"<linkage2></linkage2>", "deep.pmks": b'{"Joints": ' + b"[" * 90000,
    "rigid.linkage2": GOOD["four-bar.linkage2"].replace(b'x="100" y="60"', b'anchor="true" x="100" y="60"'),
    "words.csv": b"joints\nid,x\nA,b,c\n", "big.txt": b"x" * (17 << 20),
    "binary.dxf": b"AutoCAD Binary DXF\r\n\x1a\x00",
    "cut.dxf": b"  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n 10\n",
    "own.svg": b'<svg><metadata id="scene">title = 3</metadata></svg>',
}


@pytest.mark.parametrize("name", HOSTILE)
def test_what_is_no_linkage_is_refused_in_a_line(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit status 2, one line that names the file, and an output that was there stays."""
    if name.endswith(".dxf"):
        pytest.importorskip("ezdxf")
    path, out = tmp_path / name, tmp_path / "out.toml"
    path.write_bytes(HOSTILE[name])
    out.write_text("as it was")
    assert main(["import", str(path), "-o", str(out)]) == 2
    told = capsys.readouterr().err.strip()
    assert told.startswith(str(path)), told
    assert "\n" not in told
    assert out.read_text() == "as it was"


def test_packed_text_is_unpacked() -> None:
    """What was packed comes back; what was not has no end, or unknown letters."""
    text = '{"j": [1.5, "αβ"]} ' * 3
    assert unpack(packed(text.replace("αβ", "ab")), 1000) == text.replace("αβ", "ab")
    for wrong in ("", "N4IgViBc", "N4Ig*"):
        with pytest.raises(ValueError, match=r"missing|packed"):
            unpack(wrong, 1000)
