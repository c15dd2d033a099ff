"""Files that programs save anew, and files beyond all bounds; all else of importing is in `cases/importing`."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pytest
from face import ran

import graphplan as gp


@pytest.mark.parametrize("form", ["ggb", "dxf"])
def test_own_files_that_were_saved_anew_are_read_as_drawings(form: str, tmp_path: Path) -> None:
    """Without the scene that they carry the links have the same points, by name, and the frame is the same."""
    path, out, meant = tmp_path / f"a.{form}", tmp_path / "scene.toml", gp.load("stephenson")
    assert ran("export", "stephenson", "-o", path).status == 0
    if form == "ggb":
        with zipfile.ZipFile(path) as archive:
            drawing = archive.read("geogebra.xml")
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("geogebra.xml", drawing)
    else:
        path.write_bytes(re.sub(rb"999\nscene: [^\n]*\n", b"", path.read_bytes()))
    assert ran("import", path, "-o", out).status == 0
    assert {frozenset(points) for points in gp.load(out).links.values()} == {
        frozenset(points) for points in meant.links.values()}


@pytest.mark.parametrize(("name", "data"), [("big.txt", b"x" * (17 << 20)),
                                            ("deep.pmks", b'{"Joints": ' + b"[" * 90000)])
def test_files_beyond_all_bounds_are_refused_in_a_line(name: str, data: bytes, tmp_path: Path) -> None:
    """Exit status 2, one line that names the file, and an output that was there stays."""
    path, out = tmp_path / name, tmp_path / "out.toml"
    path.write_bytes(data)
    out.write_text("as it was")
    done = ran("import", path, "-o", out)
    assert (done.status, done.err.count("\n"), out.read_text()) == (2, 1, "as it was")
    assert done.err.startswith(str(path))
