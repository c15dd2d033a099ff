"""The construction as a GCLC source, read back with the arithmetic of that engine."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from each import each
from gcl import Reader
from laid_out import laid_out
from objects import NAMES, PLACES, Place, coordinates, drafted_plates, farthest, loose, moved, programs

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.mechanism.scene import packaged_names
from graphplan.output.exports.gclc import decimal, gclc, move_to_corner
from graphplan.output.exports.walk import extent, identifiers
from graphplan.sheet.lettering.letters import letter_plates
from graphplan.sheet.plates.display import Text
from graphplan.sheet.plates.drawn_step import DrawnStep


def off(mark: DrawnStep, found: tuple[float, ...]) -> float:
    """How far an mark is read from where it lies, beside its distance from the corner of the paper."""
    there = coordinates(mark)
    if mark.kind == LINE:
        (a, b, c), (x, y, dx, dy) = found, there
        off, turn = abs(a * x + b * y + c), abs(a * dx + b * dy) / math.hypot(dx, dy)
        return (off / (1.0 + math.hypot(x, y)) + turn) / math.hypot(a, b)
    return math.dist(found, there) / (1.0 + math.hypot(*there))


@pytest.mark.parametrize("name", packaged_names())
def test_every_mark_is_read_where_it_lies(name: str) -> None:
    """Every point, line, opening and circle of every packaged scene is recovered from the commands alone."""
    plates = move_to_corner(laid_out(name)[1])
    read, names = Reader().read(gclc(plates)), identifiers(plates.all_marks)
    assert max(off(mark, read.objects[names[mark]][1:]) for mark in plates.all_marks) < 1e-6


def test_compasses_alone_are_read_too() -> None:
    """The construction with compasses and straightedge alone, with its marks between plans, is recovered as well."""
    plates = move_to_corner(laid_out("slider-crank", strict=True)[1])
    read, names = Reader().read(gclc(plates)), identifiers(plates.all_marks)
    points = [mark for mark in plates.all_marks if mark.kind in (POINT, CIRCLE)]
    assert max(off(mark, read.objects[names[mark]][1:]) for mark in points) < 1e-6


@pytest.mark.parametrize("name", ["rosenauer-basic", "slider-crank", "kinytskyi"])
def test_a_moved_point_moves_the_construction(name: str) -> None:
    """Another place for one point of the pose gives the construction in that pose, on the same branches."""
    drawing, plates, _ = drafted_plates(name)
    plates = move_to_corner(plates)
    point, at, values = moved(drawing, plates)
    names = identifiers(plates.all_marks)
    put = f"point {names[point]} {' '.join(map(decimal, at))}"
    source = re.sub(rf"(?m)^point {names[point]} .*$", put, gclc(plates))
    read = Reader().read(source)
    marks = {mark: complex(*read.objects[names[mark]][1:]) for mark in plates.all_marks if mark.kind == POINT}
    assert farthest(plates, marks | {point: complex(*at)}, values) < 1e-6


@PLACES
@each("name", NAMES)
def test_every_operation_is_translated(name: str, place: Place) -> None:
    """Each operation of the table becomes commands that give its value, wherever its operands lie."""
    for program, values in programs(name):
        plates = move_to_corner(loose(program, values, place))
        read = Reader().read(gclc(plates))
        last = plates.steps[-1]
        assert off(last, read.objects[identifiers(plates.all_marks)[last]][1:]) < 1e-6


def test_every_step_is_said_with_its_conditions() -> None:
    """Each drawn step stands under its sentence, and under what would make it impossible; the drawing follows."""
    _, plates = laid_out("four-bar")
    source = gclc(plates)
    places = [source.index(f"\n% {mark.number}. {mark.sentence}\n") for mark in plates.all_marks if mark.number]
    assert places == sorted(places)
    assert places[-1] < source.index("% drawing: ")
    meet = next(mark for mark in plates.steps if mark.step.op.name == "meet")
    made = f"intersec {identifiers(plates.all_marks)[meet]}"
    assert f"{meet.sentence}\n% drawable unless two lines that should meet are parallel\n{made}" in source
    assert all(f"% plan: {plate.caption}\n" in source for plate in plates)


@pytest.mark.parametrize("name", ["double-butterfly", "shaper"])
def test_the_picture_is_full_and_its_letters_stand_as_on_the_sheet(name: str) -> None:
    """The page ends where the drawing does, plates are filled, and every letter stands where it stood."""
    _, plates, _ = drafted_plates(name)
    read, moved = Reader().read(gclc(plates)), move_to_corner(plates)
    wide, high = next(map(float, texts) for command, *texts in read.drawn if command == "dim")
    ink = extent(item for panel in letter_plates(moved).values() for item in panel.items)
    assert min(ink.left, ink.bottom, wide - ink.right, high - ink.top) >= 0
    assert max(ink.left, ink.bottom, wide - ink.right, high - ink.top) < 10.0
    filled = {frozenset(texts) for command, *texts in read.drawn if command == "filltriangle"}
    names = identifiers(moved.all_marks)
    plates_of_links = [{names[moved.pose[point]] for point in points} for link, points in moved.scene.links.items()
                       if link in moved.scene.moving and len(points) == 3 and name == "double-butterfly"]
    assert all(corners in filled for corners in plates_of_links)
    stood = [text.box.centre for panel in letter_plates(moved).values() for text in panel.items
             if isinstance(text, Text)]
    stand = [read.objects[texts[0]][1:] for command, *texts in read.drawn if command == "printat"]
    assert len(stand) == len(stood)
    assert all(min(math.dist(one, other) for other in stand) < 0.8 for one in stood)


def test_what_the_sheet_shows_is_drawn() -> None:
    """Links, vectors and letters are drawn: each link side, each vector, and a letter for each lettered mark."""
    _, plates = laid_out("four-bar")
    source = gclc(plates)
    drawn = Reader().read(source).drawn
    links, names = plates.scene.links, identifiers(plates.all_marks)
    ends = [{names[plates.pose[point]] for point in links[link][:2]} for link in plates.scene.moving]
    segments = [set(texts) for command, *texts in drawn if command == "drawsegment"]
    assert all(pair in segments for pair in ends)
    vectors = [vector for plate in plates for vector in plate.vectors]
    assert all(f"call vector {{ {names[one.start]} {names[one.end]} }}" in source for one in vectors)
    assert vectors
    assert {"v_{b}", "M_{1}", r"\beta"} <= {texts[-1] for command, *texts in drawn if command.startswith("printat")}


def test_numbers_have_no_exponents() -> None:
    """The engine loses the sign of an exponent, so there is none; and the same plates gives the same text."""
    _, plates = laid_out("jaanimets-10")
    source = gclc(plates)
    assert decimal(-1.5e-7) == "-0.00000015"
    assert not re.search(r"\d[eE][-+]?\d", re.sub(r"%.*", "", source))
    assert gclc(plates) == source


def test_gclc_itself_draws_it(tmp_path: Path) -> None:
    """The program reads a source without an error, and draws as many filled triangles and letters as it has."""
    if shutil.which("gclc") is None:
        pytest.skip("there is no gclc")
    source = gclc(laid_out("double-butterfly")[1])
    (tmp_path / "figure.gcl").write_text(source, encoding="utf-8")
    run = ["gclc", "figure.gcl", "figure.svg", "-svg"]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    assert "successfully processed" in done.stdout
    drawn = (tmp_path / "figure.svg").read_text(encoding="utf-8")
    assert drawn.count("<!-- Filling triangle") == source.count("\nfilltriangle ")
    assert drawn.count("<text") >= source.count("\nprintat ")
