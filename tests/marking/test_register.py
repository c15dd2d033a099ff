"""The register of a class: which sheet is whose."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from graphplan.errors import Refused
from graphplan.marking.classroom.register import REGISTER_FILE, ClassRegister, TaskSheet, is_class, load_register

SHEETS = (TaskSheet(0x01020304, 1, "Student 1", "variant-01.toml", 1),
          TaskSheet(0xFF0203FF, 2, "", "variant-02.toml", 2))
REGISTER = ClassRegister("Four-bar linkage", 7, {"paper": "A4", "plan": ""}, SHEETS)


def test_a_register_is_read_as_it_was_written(tmp_path: Path) -> None:
    """What is saved in a folder is what is loaded from it."""
    assert not is_class(tmp_path)
    (tmp_path / REGISTER_FILE).write_text(REGISTER.text, encoding="utf-8")
    assert is_class(tmp_path)
    assert load_register(tmp_path) == REGISTER


def test_a_sheet_is_found_by_its_student() -> None:
    """A student has one sheet; a spare sheet is nobody's."""
    assert REGISTER.sheet_of("Student 1") == SHEETS[0]
    assert REGISTER.sheet_of("") is None


ROW = SHEETS[0].__dict__
BROKEN: dict[str, Any] = {
    "no list": [], "no sheets": {"title": "", "seed": 1, "options": {}},
    "a text for a number": {**REGISTER.data, "seed": "1"},
    "an option that is not text": {**REGISTER.data, "options": {"paper": 4}},
    "a row without a code": {**REGISTER.data, "sheets": [{"variant": 1}]},
    "a row that is no table": {**REGISTER.data, "sheets": [1]},
    "a scene elsewhere": {**REGISTER.data, "sheets": [{**ROW, "scene": "../other.toml"}]},
}


TEXTS = {"empty": b"", "half": b"{", "no UTF-8": b"\xff", "deep": b"[" * 100_000,
         **{name: json.dumps(data).encode() for name, data in BROKEN.items()}}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_a_broken_register_is_refused(tmp_path: Path, text: bytes) -> None:
    """What is no register is one line that says what is wrong."""
    (tmp_path / REGISTER_FILE).write_bytes(text)
    with pytest.raises(Refused, match=r"class\.json: not .*; the class\.json that graphplan variants wrote$"):
        load_register(tmp_path)


def test_a_folder_without_a_register_is_refused(tmp_path: Path) -> None:
    """Without the file the line says that it cannot be read."""
    with pytest.raises(Refused, match="cannot be read"):
        load_register(tmp_path)
