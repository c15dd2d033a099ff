"""Drawings spoilt by chance: whatever is handed in, verify ends with a status, and with a whole report or none."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from random import Random

import pytest
from fuzzing import complaint, spoilt

import graphplan as gp
from graphplan.commands import main

TEXTS, PACKED, PICTURES = ("svg", "dxf", "csv", "toml"), ("ggb",), ("pdf", "png")
PARTS, TRIES = 3, 30


@pytest.fixture(scope="module")
def drawings(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """A drawing of the four-bar linkage in every kind of file."""
    folder, drawing = tmp_path_factory.mktemp("drawings"), gp.construct(gp.load("four-bar"))
    for kind in ("svg", "dxf", "pdf", "png"):
        drawing.save(folder / f"sheet.{kind}", by="sheet")
    assert main(["export", "four-bar", "-q", "-o", str(folder / "sheet.ggb")]) == 0
    marks = {"O": (20, 20), "A": (30, 75), "B": (87, 132), "C": (175, 20), "v_a": (-10, 90), "v_b": (60, 150)}
    (folder / "sheet.csv").write_text("\n".join(["mark,x,y", *(f"{name},{x},{y}" for name, (x, y) in marks.items())]))
    (folder / "sheet.toml").write_text("\n".join(["[marks]", *(f"{name} = {[*at]}" for name, at in marks.items())]))
    return {path.suffix[1:]: path.read_bytes() for path in folder.iterdir()}


def spoilt_file(kind: str, data: bytes, chance: Random) -> bytes:
    """The file with its text spoilt, or with bytes changed, missing or doubled."""
    if kind in TEXTS:
        return spoilt(data.decode(), chance).encode("utf-8", "surrogatepass")
    if kind in PACKED:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = {name: archive.read(name) for name in archive.namelist()}
        with zipfile.ZipFile(out := io.BytesIO(), "w") as archive:
            for name, member in members.items():
                archive.writestr(name, spoilt_file("svg", member, chance) if name.endswith(".xml") else member)
        return out.getvalue()
    start, length = chance.randrange(len(data)), chance.choice((1, 8, 500))
    return data[:start] + chance.choice((b"", chance.randbytes(length), 2 * data[start:start + length])) + data[
        start + length:]


@pytest.mark.parametrize("part", range(PARTS))
def test_spoilt_drawings(part: int, drawings: dict[str, bytes], tmp_path: Path,
                         monkeypatch: pytest.MonkeyPatch) -> None:
    """No spoilt drawing gives a traceback, a warning, another status than 0 to 3, or half a report."""
    monkeypatch.chdir(tmp_path)
    found = {}
    for seed in range(part, TRIES, PARTS):
        chance = Random(seed)
        kind = [*TEXTS, *PACKED, *PICTURES][seed % 7]
        Path(f"drawing.{kind}").write_bytes(data := spoilt_file(kind, drawings[kind], chance))
        if wrong := complaint(["verify", "four-bar", f"drawing.{kind}", "-q", "--report", "report.html"]):
            found[seed] = f"{kind}: {wrong}\n{data[:200]!r}"
        if (report := Path("report.html")).exists():
            assert report.read_text(encoding="utf-8").rstrip().endswith("</html>"), seed
            report.unlink()
        assert {path.name for path in tmp_path.iterdir()} == {f"drawing.{kind}"}, seed
        Path(f"drawing.{kind}").unlink()
    assert not found, "\n\n".join(f"--- {seed}: {told}" for seed, told in found.items())
