"""Scenes: what is read from the text, exactly, and from where the text is read."""

from __future__ import annotations

import io
import math
import sys
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest
from scene_texts import ACTUATOR, OPEN, PRESS, changed

from graphplan.errors import SceneError
from graphplan.mechanism import scene as module
from graphplan.mechanism.model import Balance, Find, Loads, Motion, Pair, SlidingDrive, TurningDrive, Units
from graphplan.mechanism.scene import load, parse


def test_a_scene_is_read() -> None:
    """Points, links, slides and drives come out as written, in order, as fractions."""
    scene = parse(PRESS, "press")
    assert (scene.title, scene.source, scene.name, scene.units) == ("Crank, coupler and block", "", "press", Units())
    assert scene.points == {"O": (0, 0), "A": (30, 40), "B": (60, 0), "M": (45, 20)}
    assert scene.links == {"1": ("O", "A"), "2": ("A", "M", "B"), "3": ("B",), "frame": ("O",)}
    assert [slide.name for slide in scene.slides] == ["3 along frame"]
    assert scene.drives == (TurningDrive("1", "frame", Fraction(1, 10), Fraction(0)),)
    assert scene.find.velocity == scene.find.acceleration == ("A", "B")
    assert scene.irrational == ()
    assert [scene.placements[p].how for p in "OABM"] == ["given", "given", "arc-line", "on-line"]


def test_given_motions() -> None:
    """An open chain has given motions and no frame; accelerations are zero where none is written."""
    scene = parse(OPEN, "open")
    assert scene.motions == {"K": Motion((10, 5), (3, -8)), "L": Motion((0, 1), (0, 0))}
    assert scene.drives == (TurningDrive("2", "frame", Fraction(-1), Fraction(2)),)
    assert scene.find.velocity == ("A", "B")


def test_an_actuator_along_two_points() -> None:
    """A direction by two points names them, and an actuator along a whole length is rational."""
    scene = parse(ACTUATOR, "actuator")
    assert (scene.slides[0].direction, scene.slides[0].through) == ((30, 40), ("O", "C"))
    assert scene.drives == (SlidingDrive("rod", "barrel", Fraction(1, 2), Fraction(0)),)
    assert scene.irrational == ()


PLACED: list[tuple[str, str, Pair]] = [
    ("polar at a right angle", '{ from = "O", distance = 2.5, angle = -270 }', (Fraction(0), Fraction(5, 2))),
    ("polar", '{ from = "O", distance = 2, angle = 30 }', (math.sqrt(3), 1.0)),
    ("compass, left", '{ distances = { O = 5, P = 5 }, side = "left" }', (Fraction(3), Fraction(4))),
    ("compass, right", '{ distances = { O = 5, P = 5 }, side = "right" }', (Fraction(3), Fraction(-4))),
    ("compass, centres exchanged", '{ distances = { P = 5, O = 5 }, side = "left" }', (Fraction(3), Fraction(-4))),
    ("compass, touching", '{ distances = { O = 4, P = 2 }, side = "left" }', (Fraction(4), Fraction(0))),
    ("compass, irrational", '{ distances = { O = 6, P = 6 }, side = "left" }', (3.0, math.sqrt(27))),
    (
        "arc and line, further along",
        '{ distances = { O = 5 }, on = { through = [0, 3], direction = [-2, 0] }, pick = "right" }',
        (Fraction(-4), Fraction(3)),
    ),
    (
        "arc and line, back along",
        '{ distances = { O = 5 }, on = { through = "P", direction = "P O" }, pick = "left" }',
        (Fraction(5), Fraction(0)),
    ),
    (
        "arc and line at an angle",
        '{ distances = { O = 2 }, on = { through = "O", direction = 225 }, pick = "left" }',
        (math.sqrt(2), math.sqrt(2)),
    ),
    ("on a line, backwards", '{ on = "Q O", distance = -5 }', (Fraction(12), Fraction(16))),
    ("on a line, irrational", '{ on = "O R", distance = 2 }', (math.sqrt(2), math.sqrt(2))),
]


def test_placements() -> None:
    """Points are fractions wherever they can be, otherwise the nearest floats; then the scene says where and how."""
    for name, entry, (x, y) in PLACED:
        points = f"X = {entry}\nP = [6, 0]\nQ = [9, 12]\nR = [7, 7]\nO = [0, 0]"
        links = '1 = "O X"\n2 = "X Q"\n3 = "Q P"\nframe = "O P R"'
        scene = parse(f"[points]\n{points}\n[links]\n{links}\n[[drive]]\nlink = '1'\nomega = 1", name)
        assert list(scene.points) == list("XPQRO")
        assert scene.points["X"] == pytest.approx((x, y), rel=1e-15, abs=1e-15), name
        assert [type(value) for value in scene.points["X"]] == [type(x), type(y)], name
        how = scene.placements["X"].how
        assert scene.irrational == (() if isinstance(x, Fraction) else (f"points.X: {how} placement",)), name


def test_points_may_be_placed_from_later_ones() -> None:
    """The order of points in the text does not matter, and rounded centres that should touch do."""
    text = changed(
        PRESS,
        ("O = [0, 0]", 'N = { distances = { A = 20, O = 30 }, side = "left" }\nO = [0, 0]'),
        ("A = [30, 40]", 'A = { from = "O", distance = 50, angle = 37 }'),
        ('frame = "O"', 'frame = "O N"'),
    )
    scene = parse(text, "later")
    assert math.hypot(*scene.points["N"]) == pytest.approx(30, rel=1e-12)
    assert scene.irrational[0] == "points.A: polar placement"


def test_rounded_once() -> None:
    """An irrational point lies within one rounding of where exact arithmetic puts it."""
    text = changed(PRESS, ("distances = { A = 50 }", "distances = { A = 5000000001 }"))
    x = parse(text, "x").points["B"][0]
    exact = 30 + Fraction(math.isqrt((5000000001**2 - 1600) * 10**60), 10**30)
    assert x == float(exact)


IRRATIONAL = [
    (changed(PRESS, ("omega = 0.1", "rpm = 95")), ("drive.1.rpm: rpm (2 pi/60)",)),
    (changed(PRESS, ("omega = 0.1", "rpm = 0")), ()),
    (changed(PRESS, ("direction = [1, 0]\n\n", "direction = 30\n\n")), ("slides.1.direction: angle",)),
    (changed(PRESS, ("direction = [1, 0]\n\n", "direction = 135\n\n")), ()),
    (
        changed(ACTUATOR, ("C = [30, 40]", "C = [30, 30]")),
        ("drive.1: actuator along a direction of irrational length",),
    ),
    (changed(ACTUATOR, ("C = [30, 40]", "C = [30, 30]"), ("speed = 0.5", "speed = 0")), ()),
]


def test_irrational_values_are_named() -> None:
    """Each value that fractions cannot hold has one entry that says where it stands and why."""
    for text, entries in IRRATIONAL:
        assert parse(text, "x").irrational == entries
    assert parse(IRRATIONAL[0][0], "x").drives[0] == TurningDrive("1", "frame", 9.948376736367678, Fraction(0))


QUESTIONS = [
    ('[find]\nvelocity = ["M", "A", "M"]', ("M", "A"), ()),
    ('[find]\nacceleration = ["O"]', (), ("O",)),
    ('[find]\nvelocity = "all"', ("A", "B", "M"), ()),
    ("[find]", (), ()),
    ("", ("A", "B"), ("A", "B")),
]
RATES = [
    ('[find]\nlinks = ["3", "2", "3"]', ("3", "2"), None),
    ('[find]\nlinks = "all"\nslides = "all"', ("1", "2", "3"), ("3 along frame",)),
    ('[find]\nslides = ["3 along frame"]', None, ("3 along frame",)),
    ("[find]\nlinks = []", (), None),
    ("[find]", None, None),
    ("", ("1", "2", "3"), None),
]


def test_questions() -> None:
    """What is asked for comes in the order of asking; "all" are the points of moving links; by default the joints."""
    for find, velocity, acceleration in QUESTIONS:
        asked = parse(PRESS + find, "x").find
        assert (asked.velocity, asked.acceleration) == (velocity, acceleration), find


def test_questions_of_links_and_slides() -> None:
    """Links and slides are asked for by name; by default the rates of every link, beside a question none by name."""
    for find, links, slides in RATES:
        asked = parse(PRESS + find, "x").find
        assert (asked.links, asked.slides) == (links, slides), find


def test_a_mechanism_without_moving_joints_is_asked_for_its_points() -> None:
    """Of a lone crank by default the velocities of its points are asked for."""
    crank = '[points]\nO = [0, 0]\nP = [30, 40]\n[links]\n1 = "O P"\nframe = "O"\n[[drive]]\nlink = "1"\nomega = 2'
    assert parse(crank, "crank").find == Find(("P",), ("P",), links=("1",))


def test_balances_are_named_by_their_links() -> None:
    """A balance has its link's name; where several act on one link, a force its point's too, and its direction."""
    moment, other, force = Balance("1"), Balance("2"), Balance("1", "A", (Fraction(1), Fraction(-2)))
    upwards = Balance("1", "A", (Fraction(0), Fraction(1)))
    for balances, names in [
        ([moment, other], ["1", "2"]), ([force], ["1"]), ([moment, force], ["1", "1 at A"]),
        ([upwards, force], ["1 at A along (0, 1)", "1 at A along (1, -2)"]),
    ]:
        loads = Loads((Fraction(0), Fraction(0)), {}, (), (), tuple(balances))
        assert loads.named_balances == dict(zip(names, balances, strict=True))


def test_units_and_gravity() -> None:
    """The scene's units are kept by name; gravity is accepted, though a scene without loads has no use for it."""
    scene = parse('gravity = [0, -9.81]\nunits = { length = "ft", mass = "lb" }\n' + PRESS, "x")
    assert scene.units == Units("ft", "N", "lb")


def test_load(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A scene comes from a file, from standard input, or from the package, whose names a file of that name hides."""
    (tmp_path / "press.toml").write_text("\ufeff" + PRESS, encoding="utf-8")
    assert load(tmp_path / "press.toml").points == parse(PRESS, "x").points
    assert load(str(tmp_path / "press.toml"), name="short").name == "short"
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(PRESS.encode())))
    assert load("-").name == "-"
    monkeypatch.setattr(module, "FOLDER", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    assert load("press").title == "Crank, coupler and block"
    (tmp_path / "press").write_text(PRESS.replace("Crank,", "My crank,"))
    assert load("press").title == "My crank, coupler and block"


def test_what_cannot_be_loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A missing file, a directory, bytes that are no text and impossible names are faults like any other."""
    (tmp_path / "alt-eight-link.toml").touch()
    monkeypatch.setattr(module, "FOLDER", str(tmp_path))
    (tmp_path / "latin").write_bytes(b"title = '\xe9'")
    for source, line in [
        ("alt-eight-lnk", "file: no such file and no packaged scene; perhaps alt-eight-link or alt-eight-link-2"),
        (str(tmp_path), "file: this is a directory; a scene file"),
        (str(tmp_path / "latin"), "file: byte 10 is not UTF-8; text saved as UTF-8"),
        ("a\0b", "file: it cannot be read (embedded null byte); a readable file"),
    ]:
        with pytest.raises(SceneError) as error:
            load(source)
        assert error.value.lines == (f"{source}: {line}",)
