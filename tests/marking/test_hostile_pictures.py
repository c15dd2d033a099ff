"""Pictures, documents and tables that are broken or would harm: one line, exit status 2, in bounded memory."""

from __future__ import annotations

import functools
import io
import os
import resource
import struct
import zipfile
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from graphplan.commands import main
from graphplan.marking.files import measures
from graphplan.public import verifying

MEMORY = 2**20  # kB
WHITE = np.full((620, 877), 255, np.uint8)
CHANCE = np.random.default_rng(1)


def encoded(suffix: str, picture: np.ndarray) -> bytes:
    """A picture as the bytes of a file."""
    return bytes(cv2.imencode(suffix, picture)[1])


def png(width: int, height: int, depth: int = 8, data: bytes | None = None) -> bytes:
    """A PNG that says to be so large; without `data` black."""
    def chunk(name: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
    if data is None:
        packing = zlib.compressobj(9)
        data = b"".join(packing.compress(bytes(width * depth // 8 + 1)) for _ in range(height)) + packing.flush()
    head = struct.pack(">IIBBBBB", width, height, depth, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def pdf(*objects: bytes) -> bytes:
    """A PDF of these objects, the first of them its root."""
    out, places = b"%PDF-1.4\n", []
    for number, body in enumerate(objects, 1):
        places.append(len(out))
        out += b"%d 0 obj\n%b\nendobj\n" % (number, body)
    table = b"".join(b"%010d 00000 n \n" % place for place in places)
    count = len(objects) + 1
    return (out + b"xref\n0 %d\n0000000000 65535 f \n%b" % (count, table)
            + b"trailer<</Size %d/Root 1 0 R>>\nstartxref\n%d\n%%%%EOF" % (count, len(out)))


def pages(count: int, box: bytes = b"0 0 842 595") -> bytes:
    """A PDF of so many empty pages."""
    kids = b" ".join(b"%d 0 R" % (page + 3) for page in range(count))
    page = b"<</Type/Page/Parent 2 0 R/MediaBox[%b]>>" % box
    return pdf(b"<</Type/Catalog/Pages 2 0 R>>", b"<</Type/Pages/Count %d/Kids[%b]>>" % (count, kids), *[page] * count)


def packed(content: str) -> bytes:
    """A .ggb with this construction."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("geogebra.xml", content)
    return data.getvalue()


LOOP = pdf(b"<</Type/Catalog/Pages 2 0 R>>", b"<</Type/Pages/Count 1/Kids[2 0 R]>>")
DRAWN = '<svg xmlns="http://www.w3.org/2000/svg" {}><path stroke="#000" d="M0 0L9 9"/></svg>'
NAN = b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nnan\n20\n1\n11\n2\n21\n2\n0\nENDSEC\n0\nEOF\n"
BROKEN = {
    "half a picture": ("x.png", encoded(".png", WHITE)[:600]),
    "half a photo": ("x.jpg", encoded(".jpg", CHANCE.integers(0, 255, (300, 300), np.uint8))[:3000]),
    "900 megapixels": ("x.png", png(30_000, 30_000, depth=1)),
    "a size without a picture": ("x.png", png(100_000, 100_000, data=zlib.compress(b""))),
    "as large as can be said": ("x.png", png(2**31 - 1, 2**31 - 1, data=b"")),
    "one pixel": ("x.png", png(1, 1)),
    "a strip": ("x.png", encoded(".png", np.full((9, 20_000), 255, np.uint8))),
    "nothing": ("x.png", b""),
    "no picture": ("x.png", b"hello"),
    "packed": ("x.png", zlib.compress(b"x")),
    "a beginning": ("x.jpg", b"\xff\xd8\xff\xe0"),
    "white": ("x.png", encoded(".png", WHITE)),
    "black": ("x.png", encoded(".png", 0 * WHITE)),
    "noise": ("x.jpg", encoded(".jpg", CHANCE.integers(0, 255, WHITE.shape, np.uint8))),
    "one picture called another": ("x.jpg", encoded(".png", WHITE)),
    "half a document": ("x.pdf", pages(3)[:200]),
    "a thousand pages": ("x.pdf", pages(1000)),
    "no pages": ("x.pdf", pages(0)),
    "an empty document": ("x.pdf", b""),
    "a document's head": ("x.pdf", b"%PDF-1.7\n"),
    "pages of pages": ("x.pdf", LOOP),
    "a page of five kilometres": ("x.pdf", pages(1, b"0 0 14400000 14400000")),
    "a page without size": ("x.pdf", pages(1, b"0 0 0 0")),
    "a page of no number": ("x.pdf", pages(1, b"nan nan 1 1")),
    "another encoding": ("x.csv", "mark,x,y\nA,1,2\n".encode("utf-16")),
    "no letters": ("x.csv", b"mark,x,y\nA\xff,1,2\n"),
    "a letter of no size": ("x.csv", b"mark,x,y\nA\0,1,2\n"),
    "numbers that are none": ("x.csv", b"mark,x,y\nA,nan,inf\n"),
    "numbers that are too many": ("x.csv", b"mark,x,y\nA,1e308,-1e308\nB,-1e308,1e308\n"),
    "a head alone": ("x.csv", b"mark,x,y\n"),
    "columns without marks": ("x.csv", b"x,y\n1,2\n"),
    "a mark of order": ("x.csv", b"\xef\xbb\xbf"),
    "half a line": ("x.csv", b"mark,x,y\nA,1\n"),
    "half an archive": ("x.ggb", b"PK\x03\x04"),
    "half an element": ("x.ggb", packed('<geogebra><construction><element type="point"></construction></geogebra>')),
    "a window of no number": ("x.svg", DRAWN.format('viewBox="0 0 nan 1"').encode()),
    "a window of nothing": ("x.svg", DRAWN.format('width="0" height="0"').encode()),
    "half a tag": ("x.svg", b"<svg"),
    "a binary file of CAD": ("x.dxf", b"AutoCAD Binary DXF\r\n\x1a\0" + bytes(100)),
    "a line of no number": ("x.dxf", NAN),
    "half a section": ("x.dxf", b"0\nSECTION"),
    "another kind": ("x.tif", b"II*\0"),
}  # fmt: skip


@pytest.fixture(autouse=True)
def _one_sheet(monkeypatch: pytest.MonkeyPatch) -> None:
    """The sheet is laid out once for all cases."""
    monkeypatch.setattr(verifying, "on_paper", lambda scene, options: sheet(scene.name))


@functools.cache
def sheet(scene: str) -> Any:
    from graphplan.commands import parser
    from graphplan.commands.choices import on_paper

    return on_paper(parser(("verify",)).parse_args(["verify", scene, "x"]))


def refused(path: Path, capfd: pytest.CaptureFixture[str]) -> str:
    """The one line in which a file is refused."""
    sheet("four-bar")
    assert main(["verify", "four-bar", str(path), "-q"]) == 2
    said, line = capfd.readouterr()
    assert said == ""
    assert line.count("\n") == 1, line
    assert path.name in line
    return line


@pytest.mark.parametrize("case", BROKEN)
def test_broken_files_are_refused_in_one_line(case: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Whatever is handed in: exit status 2, one line of ours alone, and no more memory than a gigabyte."""
    name, data = BROKEN[case]
    (tmp_path / name).write_bytes(data)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    refused(tmp_path / name, capfd)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MEMORY
    assert os.listdir(tmp_path) == [name]


def test_a_page_that_never_ends_is_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str],
                                           monkeypatch: pytest.MonkeyPatch) -> None:
    """A form that draws itself twice: pdfium reads on for hours, and is not waited for."""
    monkeypatch.setattr(measures, "MAX_PDF_SECONDS", 1.0)
    (tmp_path / "x.pdf").write_bytes(pdf(
        b"<</Type/Catalog/Pages 2 0 R>>", b"<</Type/Pages/Count 1/Kids[3 0 R]>>",
        b"<</Type/Page/Parent 2 0 R/MediaBox[0 0 842 595]/Contents 4 0 R/Resources<</XObject<</F 5 0 R>>>>>>",
        b"<</Length 5>>stream\n/F Do\nendstream",
        *(b"<</Type/XObject/Subtype/Form/BBox[0 0 842 595]/Resources<</XObject<</F %d 0 R>>>>/Length 11>>stream\n"
          b"/F Do /F Do\nendstream" % form for form in range(6, 40))))
    assert "its pages take more than 1 s to read" in refused(tmp_path / "x.pdf", capfd)


@pytest.mark.parametrize("name", ["x.heic", "x.HEIF", "x.jpg"])
def test_photos_of_phones_say_how_to_save_them(name: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """HEIC is told by its bytes, whatever it is called, and what to do about it."""
    (tmp_path / name).write_bytes(struct.pack(">I", 24) + b"ftypheic" + bytes(100))
    assert "this is a HEIC photo, as phones take them, which is not read; send or save it as JPEG" in refused(
        tmp_path / name, capfd)


def test_names_that_are_no_files_are_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Empty folders called as pictures are, links that lead to themselves, and what is not there."""
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "loop.png").symlink_to("loop.png")
    for name in ("folder.png", "loop.png", "missing.png"):
        refused(tmp_path / name, capfd)
