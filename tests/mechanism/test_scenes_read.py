"""Scenes as they are read: each thing exactly as it is written, from wherever the text comes."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest
from face import names, ran

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases"
FAULTS = CASES / "faults"
EXACT = CASES / "exact"


def scene(name: str, *changes: tuple[str, str]) -> gp.Scene:
    """A scene of the folder of faults, which are sound as they stand, with some texts replaced."""
    text = (FAULTS / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return gp.parse(text, name)


def test_a_scene_is_read() -> None:
    """Points, links, slides and drives come out as written, in order, as fractions."""
    press = scene("press")
    assert (press.title, press.source, press.name) == ("Crank, coupler and block", "", "press")
    assert press.points == {"O": (0, 0), "A": (30, 40), "B": (60, 0), "M": (45, 20)}
    assert press.links == {"1": ("O", "A"), "2": ("A", "M", "B"), "3": ("B",), "frame": ("O",)}
    assert [slide.name for slide in press.slides] == ["3 along frame"]
    (drive,) = press.drives
    assert (drive.link, drive.on, drive.rate, drive.change) == ("1", "frame", Fraction(1, 10), 0)
    assert press.find.velocity == press.find.acceleration == ("A", "B")
    assert press.irrational == ()
    assert [press.placements[point].how for point in "OABM"] == ["given", "given", "arc-line", "on-line"]


def test_motions_and_actuators_are_read() -> None:
    """An open chain has given motions, at rest where none is written; a direction by two points names them."""
    chain, cylinder = scene("open"), scene("actuator")
    assert {point: (motion.velocity, motion.acceleration) for point, motion in chain.motions.items()} == {
        "K": ((10, 5), (3, -8)), "L": ((0, 1), (0, 0))}
    assert (chain.drives[0].rate, chain.drives[0].change, chain.find.velocity) == (-1, 2, ("A", "B"))
    assert (cylinder.slides[0].direction, cylinder.slides[0].through) == ((30, 40), ("O", "C"))
    assert (cylinder.drives[0].links, cylinder.drives[0].rate) == (("rod", "barrel"), Fraction(1, 2))
    assert cylinder.irrational == ()


def test_points_may_be_placed_from_later_ones() -> None:
    """The order of points in the text does not matter, and rounded centres that should touch do."""
    later = scene("press", ("O = [0, 0]", 'N = { distances = { A = 20, O = 30 }, side = "left" }\nO = [0, 0]'),
                  ("A = [30, 40]", 'A = { from = "O", distance = 50, angle = 37 }'), ('frame = "O"', 'frame = "O N"'))
    assert math.hypot(*later.points["N"]) == pytest.approx(30, rel=1e-12)
    assert later.irrational[0] == "points.A: polar placement"


def test_an_irrational_point_is_rounded_once() -> None:
    """It lies within one rounding of where exact arithmetic puts it."""
    far = scene("press", ("distances = { A = 50 }", "distances = { A = 5000000001 }"))
    assert far.points["B"][0] == float(30 + Fraction(math.isqrt((5000000001**2 - 1600) * 10**60), 10**30))


def test_revolutions_a_minute_are_rounded_once() -> None:
    """95 rpm is the float nearest to 95 pi / 30, and said to be irrational; none is a whole number."""
    assert scene("press", ("omega = 0.1", "rpm = 95")).drives[0].rate == 9.948376736367678
    assert scene("press", ("omega = 0.1", "rpm = 95")).irrational == ("drive.1.rpm: rpm (2 pi/60)",)
    assert scene("press", ("omega = 0.1", "rpm = 0")).irrational == ()


def test_an_actuator_along_an_irrational_length_is_named() -> None:
    """Its speed along a direction of irrational length is no fraction, unless it is none."""
    turned = "C = [30, 40]", "C = [30, 30]"
    assert scene("actuator", turned).irrational == ("drive.1: actuator along a direction of irrational length",)
    assert scene("actuator", turned, ("speed = 0.5", "speed = 0")).irrational == ()


@pytest.mark.parametrize(("question", "found"), [
    ('velocity = ["M", "A", "M"]', (("M", "A"), (), None, None)),
    ('acceleration = ["O"]', ((), ("O",), None, None)),
    ('velocity = "all"', (("A", "B", "M"), (), None, None)),
    ('links = ["3", "2", "3"]', ((), (), ("3", "2"), None)),
    ('links = "all"\nslides = "all"', ((), (), ("1", "2", "3"), ("3 along frame",))),
    ("links = []", ((), (), (), None)),
    ("", ((), (), None, None)),
])
def test_questions_keep_their_order(question: str, found: tuple[object, ...]) -> None:
    """What is asked for is kept in the order of asking, each once."""
    asked = scene("press", ("omega = 0.1", f"omega = 0.1\n[find]\n{question}")).find
    assert (asked.velocity, asked.acceleration, asked.links, asked.slides) == found


def test_a_lone_crank_is_asked_for_its_points() -> None:
    """By default, as it has no moving joint."""
    crank = gp.scene({"points": {"O": (0, 0), "P": (30, 40)}, "links": {"1": "O P", "frame": "O"},
                      "drive": [{"link": "1", "omega": 2}]}, "crank").find
    assert (crank.velocity, crank.acceleration, crank.links) == (("P",), ("P",), ("1",))


def test_units_are_kept_by_name() -> None:
    """Those left out are mm, N and kg; gravity is accepted though nothing weighs."""
    units = scene("press", ("title", 'gravity = [0, -9.81]\nunits = { length = "ft", mass = "lb" }\ntitle')).units
    assert (units.length, units.force, units.mass) == ("ft", "N", "lb")


def test_a_scene_comes_from_anywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """From a file, marked as UTF-8 or not, from standard input, or packaged; a file of that name hides it."""
    text = (FAULTS / "press.toml").read_text(encoding="utf-8")
    (tmp_path / "marked.toml").write_text("\ufeff" + text, encoding="utf-8")
    assert gp.load(tmp_path / "marked.toml").points == scene("press").points
    assert gp.load(str(tmp_path / "marked.toml"), name="short").name == "short"
    assert ran("solve", "-", given=text).out == ran("solve", tmp_path / "marked.toml").out
    monkeypatch.chdir(tmp_path)
    assert gp.load("triad").title != "Crank, coupler and block"
    (tmp_path / "triad").write_text(text, encoding="utf-8")
    assert gp.load("triad").title == "Crank, coupler and block"


def test_what_cannot_be_loaded_is_a_fault(tmp_path: Path) -> None:
    """A missing file, a directory, bytes that are no text and impossible names are faults like any other."""
    (tmp_path / "latin").write_bytes(b"title = '\xe9'")
    for source, line in [
        ("alt-eight-lnk", "file: no such file and no packaged scene; perhaps alt-eight-link or alt-eight-link-2"),
        (str(tmp_path), "file: this is a directory; a scene file"),
        (str(tmp_path / "latin"), "file: byte 10 is not UTF-8; text saved as UTF-8"),
        ("a\0b", "file: it cannot be read (embedded null byte); a readable file"),
    ]:
        done = ran("solve", source)
        assert (done.status, done.out) == (2, "")
        assert done.err.rstrip("\n").endswith(f": {line}")
        with pytest.raises(gp.SceneError) as error:
            gp.load(source)
        assert error.value.lines == (f"{source}: {line}",)


@pytest.mark.parametrize("name", names())
def test_a_pivot_left_out_of_the_frame_is_told(name: str) -> None:
    """Whichever pivot of one link is left out of a packaged scene's frame is among those that are told."""
    whole = gp.load(name)
    line = re.search(r'(?m)^frame\s*=\s*"(.*)"', whole.text)
    alone = [point for point in whole.links.get("frame", ()) if len(whole.links_of[point]) == 2]
    if line is None or whole.loads or whole.slides or len(line[1].split()) == 1:
        return
    for pivot in alone:
        rest = " ".join(point for point in line[1].split() if point != pivot)
        with pytest.raises(gp.SceneError) as error:
            gp.parse(whole.text.replace(line[0], f'frame = "{rest}"'))
        assert re.search(rf"\b{pivot}\b.* on no other link", error.value.lines[0]), error.value.lines


def test_a_frame_needs_no_point() -> None:
    """Where pairs alone name the frame it is there, and the results are those of a frame with a point."""
    bare = gp.load(CASES / "faults" / "frames" / "trammel.toml")
    pointed = gp.parse(bare.text.replace('b = "B"', 'b = "B"\nframe = "N"').replace("B = [0", "N = [7, 7]\nB = [0"))
    assert gp.solve(bare).omega["bar"] == gp.solve(pointed).omega["bar"] == 0.5


def test_a_moving_link_may_be_called_as_others_call_the_frame() -> None:
    """Beside a frame a moving link may be called 0, and in an open chain any."""
    crank = re.sub(r"(?m)^1( *=)", r"0\1", gp.load("slider-crank").text).replace('link  = "1"', 'link  = "0"')
    assert "0" in gp.parse(crank).moving
    chain = re.sub(r"(?m)^3( *=)", r"ground\1", gp.load("open-chain").text).replace('"3"', '"ground"')
    assert "ground" in gp.parse(chain).moving


# ---- numbers in the text ---------------------------------------------------------------------------------------------


def test_values_that_vary_are_read_exactly() -> None:
    """A range has the values from its first by steps to its last; a list has its own, each once."""
    text = (FAULTS / "vary" / "four-bar.toml").read_text(encoding="utf-8")
    varied = gp.parse(text + '[vary]\n"points.A.angle" = { from = 0.1, to = 0.45, step = 0.1 }\n"drive.0.omega" = '
                      '[3, 1, 3]\n"points.B.distances.A" = { from = 2, to = 2, step = 1 }\n\'points."C".0\' = [150]')
    assert varied.vary == {
        "points.A.angle": (Fraction(1, 10), Fraction(1, 5), Fraction(3, 10), Fraction(2, 5)),
        "drive.0.omega": (3, 1), "points.B.distances.A": (2,), 'points."C".0': (150,)}
    assert (varied.points, gp.parse(text).vary) == (gp.parse(text).points, {})


def test_packaged_scenes_vary() -> None:
    """Some packaged scenes can be given to a class as they are."""
    assert {"four-bar", "ozols-5-1"} <= {name for name in names() if gp.load(name).vary}


@pytest.mark.parametrize(("value", "written"), [(20, "20"), (12.5, "12.5"), (1e-7, "0.0000001"), (-3, "-3"),
                                                (1e20, "1" + 20 * "0"), (Fraction(777, 100), "7.77")])
def test_numbers_are_written_as_one_writes_them(value: float, written: str) -> None:
    """Whole numbers have no point, others no digit too many and no power of ten."""
    text = (CASES / "text" / "numbers.toml").read_text(encoding="utf-8")
    assert gp.parse(text).replace("drive.0.alpha", value).text == text.replace("alpha = 0.5", f"alpha = {written}")


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_a_number_is_changed_at_its_place_alone(ends: str) -> None:
    """Whatever keys, strings, comments and long lists look like it; all else of the text stays."""
    text = (CASES / "text" / "numbers.toml").read_text(encoding="utf-8").replace("\n", ends)
    whole = gp.parse(text)
    for path, old, new in [
        ("points.O.1", "O = [0, -0.5]", "O = [0, 7.77]"), ("points.A1.angle", "+60", "7.77"),
        ("points.A1.distance", "50.25", "7.77"), ("points.1.0", "[1_000,", "[7.77,"), ("points.1.1", "2e1]", "7.77]"),
        ("masses.2.mass", "mass = 2\n", "mass = 7.77\n"), ("moments.0.values.1.1", "-1200", "7.77"),
        ("moments.0.values.1.0", "[30,", "[7.77,"), ("moments.0.values.2.0", "[360,", "[777,"),
    ]:
        value = Fraction(new.strip("[],\n").removeprefix("mass = ").removeprefix("O = [0, "))
        assert whole.replace(path, value).text == text.replace(old.replace("\n", ends), new.replace("\n", ends)), path


def test_keys_are_set_in_their_table() -> None:
    """A key that is there has another value, and keeps its comment; a new one stands first in its table."""
    whole = gp.load(CASES / "text" / "numbers.toml")
    changed = whole.replace("sheet.paper", "A3").replace("sheet.k_s", 2.5).replace("title", "Other")
    assert changed.text.endswith('[sheet]  # here\nk_s = 2.5\ncurves = ["B"]   # the curve\npaper = "A3"\n')
    assert changed.text.splitlines()[1] == 'title = "Other"   # said once'
    asking = whole.replace("find.links", "all")
    assert (asking.text, asking.find.links) == (f'{whole.text.rstrip()}\n\n[find]\nlinks = "all"\n', ("1", "2", "3"))
    with pytest.raises(gp.Refused, match="nothing stands at P"):
        whole.replace("points.P.0", 1)


# ---- the sheet -------------------------------------------------------------------------------------------------------


def sheet(lines: str, units: str = "mm") -> object:
    """What a scene with these lines in its table [sheet] wishes."""
    table = f'omega = 0.1\n[units]\nlength = "{units}"\n[sheet]\n{lines}'
    return scene("press", ("omega = 0.1", table)).sheet


def test_every_wish_for_the_sheet_is_read() -> None:
    """All keys of the table arrive, numbers exactly as written; without the table, or with empty texts, all is open."""
    wished = gp.load(CASES / "text" / "sheet.toml").sheet
    for key, value in {
        "paper": "A4 portrait", "frame": "gost", "owner": "Chair of Mechanisms", "number": "TMM-01",
        "date": "1939-05-01", "drawn_by": "N. N.", "approved_by": "M. M.", "language": "lv", "plan": "polar",
        "method": "trial", "inertia": "shifted", "rounds": 3, "strict": True, "prefer": "quick",
        "pencil": "point=0.2", "protocol": "aside", "task": "Find the velocity of M.", "k_s": Fraction(5, 2),
        "k_v": 10, "k_a": 40, "k_F": 4, "multiples": {"N-plan": 2, "force plan 2, 3": Fraction(1, 2)},
        "convention": "drawn", "curves": ("A", "M"), "centrodes": ("2 frame", "3 2"), "cubics": ("2",), "positions": 12,
    }.items():
        assert getattr(wished, key) == value, key
    assert scene("press").sheet == sheet('owner = ""')


@pytest.mark.parametrize(("length", "scale", "k_s"), [
    ("mm", "1:2", Fraction(2)), ("mm", " 2.5 : 1 ", Fraction(2, 5)), ("m", "1:50", Fraction(1, 20)),
    ("in", "1:1", Fraction(5, 127)),
])
def test_a_ratio_is_a_scale(length: str, scale: str, k_s: Fraction) -> None:
    """A ratio of paper to scene gives the scene's lengths in a millimetre, whatever their unit."""
    assert sheet(f'scale = "{scale}"', length).k_s == k_s


def test_two_scales_tie_how_long_vectors_are_drawn() -> None:
    """kappa follows from the scale of velocities and one other, phi from that of forces."""
    assert sheet("k_s = 2\nk_v = 8").kappa == sheet("k_v = 8\nk_a = 32").kappa == Fraction(1, 4)
    assert sheet("k_s = 2\nk_F = 8").phi == Fraction(1, 4)
    assert (sheet("k_v = 8").kappa, sheet("k_F = 8").phi) == (None, None)


# ---- structure -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(8))
def test_what_is_built_of_dyads_falls_apart_into_them(seed: int) -> None:
    """Dyads hung one after another on any points of what moves already, or of the frame, are found again."""
    chance = Random(seed)
    points = {"O": (0, 0), "T": (13, 40)}
    links, fixed, moving, dyads = {"1": "O T"}, ["O"], ["T"], set()
    for k in range(chance.randrange(1, 12)):
        first, other = chance.choice(moving), chance.choice([f"P{k}", f"P{k}", *moving])
        if other in (f"P{k}", first):
            other, _ = f"P{k}", fixed.append(f"P{k}")
        for name in {f"Q{k}", f"E{k}", other} - {*points}:
            points[name] = chance.randrange(-900, 900), chance.randrange(-900, 900)
        links |= {f"b{k}": f"Q{k} {other} E{k}", f"a{k}": f"{first} Q{k}"}
        moving += [f"Q{k}", f"E{k}"]
        dyads.add(frozenset({f"a{k}", f"b{k}"}))
    written = dict(sorted(links.items(), key=lambda item: chance.random())) | {"frame": " ".join(fixed)}
    chain = gp.scene({"points": points, "links": written, "drive": [{"link": "1", "omega": 1}],
                      "find": {"velocity": ["T"]}})
    lines = ran("check", "-", "--json", given=chain.text).json["structure"]
    found = [re.search(r"links (\S+) (\S+) \(dyad RRR", line) for line in lines if "group" in line]
    assert {frozenset(match.groups()) for match in found if match} == dyads
    assert len(found) == len(dyads)
