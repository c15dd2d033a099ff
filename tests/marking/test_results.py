"""Result tables: components or size and angle, units of every make, and what is wrong with a table."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from each import each

from graphplan.errors import Refused
from graphplan.marking.files.quantities import in_scene_units
from graphplan.marking.submission import read_submission
from graphplan.marking.traces import StudentNumber
from graphplan.mechanism.model import Units
from graphplan.methods.kinds import KINDS
from graphplan.methods.recorded import READERS


def numbers(folder: Path, text: str) -> tuple[StudentNumber, ...]:
    """The numbers of a table."""
    path = folder / "results.csv"
    path.write_text(text, encoding="utf-8")
    return read_submission(path, (), {}).numbers


def test_quantities_are_those_of_constructions() -> None:
    """Whatever a construction gives can stand in a table, as a vector or as one number."""
    assert {kind.dimension for kind in KINDS.values()} == READERS.keys()


def test_vectors_and_single_numbers(tmp_path: Path) -> None:
    """Vectors are written by x and y or by size and angle, others by value; rows not filled in are left out."""
    table = ("quantity;of;x;y;size;angle;value;unit\nvelocity;A;1,5;-2;;;;m/s\nAcceleration;B;;;2;90;;\n"
             "angular velocity;3;;;;;-4,5;rad/s\nreaction;2 at  B;;;;;;N\nbalance moment;1;;;;;29;N·m\n")
    a, b, omega, moment = numbers(tmp_path, table)
    assert a == StudentNumber("velocity", "A", (1.5, -2.0), "m/s")
    assert (b.kind, b.of, b.unit) == ("acceleration", "B", "")
    assert b.value == pytest.approx((0, 2))
    assert omega == StudentNumber("omega", "3", (-4.5,), "rad/s")
    assert moment == StudentNumber("balance moment", "1", (29.0,), "N·m")


SYMBOLS = {"vA": ("velocity", "A"), "v_A": ("velocity", "A"), "a_B": ("acceleration", "B"), "aB": ("acceleration", "B"),
           "v(B)": ("velocity", "B"), "ω2": ("omega", "2"), "ω₂": ("omega", "2"), "omega 2": ("omega", "2"),
           "omega_2": ("omega", "2"), "α3": ("alpha", "3"), "epsilon 3": ("alpha", "3"), "v_A3": ("velocity", "A3")}


@each("written", SYMBOLS)
def test_symbols_are_read_as_quantities(tmp_path: Path, written: str) -> None:
    """Where no thing is named beside it, a letter with an index says both."""
    kind, of = SYMBOLS[written]
    columns, value = ("value", "3") if KINDS[kind].single else ("x,y", "3,4")
    found, = numbers(tmp_path, f"quantity,of,{columns}\n{written},,{value}\n")
    assert (found.kind, found.of) == (kind, of)


@each(("written", "value", "rounding"), [
    ("12.5", 12.5, 0.1), ('"12,5"', 12.5, 0.1), ("12", 12.0, 1.0), ("1.25e3", 1250.0, 10.0),
    ('"1,25·10^3"', 1250.0, 10.0), ("1.25×10³", 1250.0, 10.0), ("−0.50", -0.5, 0.01)])
def test_numbers_as_students_write_them(tmp_path: Path, written: str, value: float, rounding: float) -> None:
    """With decimal commas and powers of ten; the digits tell how far they were rounded."""
    found, = numbers(tmp_path, f"quantity,of,value\nomega,3,{written}\n")
    assert found.value == pytest.approx((value,))
    assert found.rounding == pytest.approx(rounding / math.sqrt(12))


MILLIMETRES, INCHES = Units(), Units("in", "lbf", "lb")
CONVERTED = [
    ("velocity", "m/s", MILLIMETRES, 1000), ("velocity", "mm/s", MILLIMETRES, 1),
    ("velocity", "cm s^-1", MILLIMETRES, 10),
    ("velocity", "in/s", INCHES, 1), ("velocity", "ft/s", INCHES, 12), ("velocity", "m/min", MILLIMETRES, 1000 / 60),
    ("velocity", "km/h", Units("m"), 1 / 3.6), ("acceleration", "m/s²", MILLIMETRES, 1000),
    ("acceleration", "mm/s^2", MILLIMETRES, 1), ("acceleration", "m/s2", MILLIMETRES, 1000),
    ("acceleration", "m·s⁻²", MILLIMETRES, 1000), ("acceleration", "m/s/s", MILLIMETRES, 1000),
    ("acceleration", "ft/s^2", INCHES, 12), ("omega", "rad/s", MILLIMETRES, 1), ("omega", "1/s", MILLIMETRES, 1),
    ("omega", "s^-1", MILLIMETRES, 1), ("omega", "rpm", MILLIMETRES, math.pi / 30),
    ("omega", "rev/min", MILLIMETRES, math.pi / 30), ("omega", "°/s", MILLIMETRES, math.pi / 180),
    ("alpha", "rad/s^2", MILLIMETRES, 1), ("alpha", "1/s²", MILLIMETRES, 1), ("reaction", "kN", MILLIMETRES, 1000),
    ("reaction", "N", Units(force="kN"), 0.001), ("reaction", "kgf", MILLIMETRES, 9.80665),
    ("reaction", "kg·m/s^2", MILLIMETRES, 1), ("reaction", "N", INCHES, 1 / 4.4482216152605),
    ("balance moment", "N·m", MILLIMETRES, 1), ("balance moment", "N mm", MILLIMETRES, 0.001),
    ("balance moment", "kN*m", MILLIMETRES, 1000), ("balance moment", "lbf·ft", INCHES, 0.3048),
    ("slide arm", "cm", MILLIMETRES, 10), ("velocity", "", INCHES, 1), ("velocity", "м/с", MILLIMETRES, 1000),
    ("acceleration", "мм/с²", MILLIMETRES, 1), ("omega", "рад/с", MILLIMETRES, 1),
    ("balance moment", "Nm", MILLIMETRES, 1), ("balance moment", "kNm", MILLIMETRES, 1000),
    ("balance moment", "Nmm", MILLIMETRES, 0.001), ("velocity", "10^3 mm/s", MILLIMETRES, 1000),
    ("velocity", "·10³ mm/s", MILLIMETRES, 1000), ("omega", "s-1", MILLIMETRES, 1),
    ("balance moment", "Н·м", MILLIMETRES, 1), ("balance moment", "Нм", MILLIMETRES, 1),
    ("reaction", "кН", MILLIMETRES, 1000),
]  # fmt: skip


@each(("kind", "unit", "units", "factor"), CONVERTED)
def test_units_become_the_scenes(kind: str, unit: str, units: Units, factor: float) -> None:
    """A number in any unit is converted to what the scene's results come in."""
    value = (3.0,) if KINDS[kind].single else (3.0, -2.0)
    assert in_scene_units(StudentNumber(kind, "A", value, unit),
                          units) == pytest.approx([factor * part for part in value])


@each("unit", ["furlong/s", "mm", "N", "m/s^2", "m//s", "m/s^99", "m" * 1000])
def test_other_units_are_refused(tmp_path: Path, unit: str) -> None:
    """A unit that is unknown, or of another quantity, is a fault with its line and such a unit as would be right."""
    with pytest.raises(Refused, match=r"line 2: .*; .*such as mm/s$"):
        numbers(tmp_path, f"quantity,of,x,y,unit\nvelocity,A,1,2,{unit}\n")


WRONG = {
    "quantity,of,x,y\nspeed,A,1,2": "line 2: 'speed' is not a quantity; one of velocity, acceleration",
    "quantity,of,value\nvelocity,A,3": "line 2: velocity is a vector; x and y",
    "quantity,of,x,y\nomega,3,1,2": "line 2: omega is one number; value",
    "quantity,of,x,y,value\nomega,3,1,2,3": "line 2: the result is given twice",
    "quantity,of,x,y\nvelocity,A,1e99,2": "line 2: a number is too large",
    "quantity,of,x,y\nvelocity,A,,2": "line 2: x: a number is missing",
}


@each("text", WRONG, ids=WRONG.get)
def test_a_wrong_row_is_told(tmp_path: Path, text: str) -> None:
    """A row that says no result is refused with its line."""
    with pytest.raises(Refused, match=WRONG[text]):
        numbers(tmp_path, text)
