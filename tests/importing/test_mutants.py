"""Nothing of a file is lost silently: a mutant changes the scene or the remarks, or is refused in one line."""

from __future__ import annotations

from pathlib import Path

import pytest
from mutants import FORMS, mutant

from graphplan.commands import main

MUTANTS = 20  # of each format


def imported(path: Path, data: bytes, capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    """The exit status, the scene and the remarks of a file."""
    path.write_bytes(data)
    out = path.with_suffix(".toml")
    out.unlink(missing_ok=True)
    status = main(["import", str(path), "-o", str(out)])
    return status, out.read_text(encoding="utf-8") if out.exists() else "", capsys.readouterr().err


@pytest.mark.parametrize("number", range(MUTANTS))
@pytest.mark.parametrize("form", FORMS)
def test_a_mutant_is_told_from_its_file(form: str, number: int, tmp_path: Path,
                                        capsys: pytest.CaptureFixture[str]) -> None:
    """Its scene, its remarks, or one line that names what is not understood; the file as it was is imported."""
    if form == "dxf":
        pytest.importorskip("ezdxf")
    name, data, (done, changed, seen) = mutant(form, number)
    path = tmp_path / name
    status, scene, remarks = imported(path, data, capsys)
    assert status == 0, remarks
    new_status, new_scene, new_remarks = imported(path, changed, capsys)
    if new_status:
        assert new_status == 2
        assert new_scene == ""
        assert len(new_remarks.splitlines()) == 1
        assert new_remarks.startswith(f"{path}: ")
    elif seen:
        assert (new_scene, new_remarks) != (scene, remarks), f"{name}: {done}"
