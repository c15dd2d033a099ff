"""Files that would harm, and files that are none: each is refused in one clear line, in bounded time and memory, and
nothing is written."""

from __future__ import annotations

import io
import os
import random
import resource
import struct
import sys
import tracemalloc
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

import cv2
import ezdxf
import numpy as np
import pytest
from drawing_files import FORMATS
from face import ran
from hand_drawings import right, scene_file
from judged_drawings import judged

MEMORY = 2**20  # kB
WHITE = np.full((620, 877), 255, np.uint8)
CHANCE = np.random.default_rng(1)
BOMB = bytes(17 * 2**20)
KINDS = ("x.csv", "x.toml", "x.svg", "x.dxf", "x.ggb")
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm">{}</svg>'
GEOGEBRA = "<geogebra><construction>{}</construction></geogebra>"
LAUGHS = "<!DOCTYPE svg [<!ENTITY l0 'ha'>{}]><svg>&l9;</svg>".format(
    "".join(f"<!ENTITY l{i} '{f'&l{i - 1};' * 10}'>" for i in range(1, 10)))
FETCHED = '<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]><svg><text>&x;</text></svg>'
ELSEWHERE = '<!DOCTYPE svg SYSTEM "http://127.0.0.1:9/x.dtd"><svg/>'
LONG = f'<g id="a" style="{"a:b;" * 10**5}"/>' + '<use href="#a"/>' * 10**4
COPIES = "".join(f'<g id="g{i}">{f"<use href={chr(34)}#g{i - 1}{chr(34)}/>" * 10}</g>' for i in range(1, 10))


def archive(members: dict[str, bytes]) -> bytes:
    """A ZIP archive of these members."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, content in members.items():
            packed.writestr(name, content)
    return data.getvalue()


def shrunk(data: bytes) -> bytes:
    """An archive that claims its member to be small."""
    size = struct.pack("<I", len(BOMB))
    return data.replace(size, struct.pack("<I", 100))


def ggb(inside: str) -> bytes:
    """A GeoGebra file with this construction."""
    return archive({"geogebra.xml": GEOGEBRA.format(inside).encode()})


def dxf(fill: Callable[[ezdxf.document.Drawing], object]) -> bytes:
    """A DXF file, filled."""
    document, text = ezdxf.new("R2000"), io.StringIO()
    fill(document)
    document.write(text)
    return text.getvalue().encode()


def nested(document: ezdxf.document.Drawing) -> None:
    """Blocks of ten blocks each, ten deep, with nothing in them."""
    for depth in range(10):
        block = document.blocks.new(f"B{depth}")
        for _ in range(10 * bool(depth)):
            block.add_blockref(f"B{depth - 1}", (0, 0))
    document.modelspace().add_blockref("B9", (0, 0))


def itself(document: ezdxf.document.Drawing) -> None:
    """A block that holds itself."""
    document.blocks.new("A").add_blockref("A", (0, 0))
    document.modelspace().add_blockref("A", (0, 0))


def rows(document: ezdxf.document.Drawing) -> None:
    """A block in ten thousand rows and columns."""
    document.blocks.new("A").add_line((0, 0), (1, 1))
    grid = {"row_count": 10_000, "column_count": 10_000, "row_spacing": 1, "column_spacing": 1}
    document.modelspace().add_blockref("A", (0, 0), dxfattribs=grid)


def point(x: str) -> str:
    """A point of GeoGebra."""
    return f'<element type="point" label="A"><show object="true"/><coords x="{x}" y="1" z="1"/></element>'


def term(written: str) -> str:
    """A point of GeoGebra by an expression."""
    return f'<expression label="A" exp="{written}"/><element type="point" label="A"><show object="true"/></element>'


GARBAGE = random.Random(1).randbytes(100_000)
HOSTILE = {
    "billion laughs": ("x.svg", LAUGHS.encode(), "document type of its own"),
    "external entity": ("x.svg", FETCHED.encode(), "document type of its own"),
    "entity by entity": ("x.svg", f"<!DOCTYPE svg [<!ENTITY a '{'a' * 9999}'>]><svg>{'&a;' * 10**5}</svg>".encode(),
                         "letters of entities"),
    "attributes from a document type": ("x.svg", b"<!DOCTYPE svg [<!ATTLIST svg width CDATA '9mm'>]><svg/>",
                                        "document type of its own"),
    "external document type": ("x.svg", ELSEWHERE.encode(), "document type of its own"),
    "billion laughs in an archive": ("x.ggb", archive({"geogebra.xml": LAUGHS.encode()}), "document type of its own"),
    "copies of copies": ("x.svg", SVG.format(f'<g id="g0"/>{COPIES}').encode(), "more than 30000 elements"),
    "a copy of itself": ("x.svg", SVG.format('<g id="a"><use href="#a"/></g>').encode(), "copies are nested"),
    "groups in groups": ("x.svg", SVG.format("<g>" * 90_000 + "</g>" * 90_000).encode(), "100 elements are nested"),
    "many elements": ("x.svg", SVG.format("<g/>" * 10**6).encode(), "more than 60000 elements"),
    "many lines": ("x.svg", SVG.format(f'<path stroke="#000" d="M0 0{" 9 9 0 0" * 40_000}"/>').encode(), "more than"),
    "many curves": ("x.svg", SVG.format(f'<path stroke="#000" d="M0 0{"C1 1 2 1 3 0" * 10**5}"/>').encode(), "letters"),
    "copies of a long style": ("x.svg", SVG.format(LONG).encode(), "more than 400000 letters"),
    "no numbers": ("x.svg", SVG.format('<circle r="nan" cx="1"/>').encode(), "'nan' is not a length"),
    "far away": ("x.svg", SVG.format('<circle r="1" cx="1e300"/>').encode(), "farther away than 1e"),
    "infinite scale": ("x.svg", SVG.format('<circle r="1" cx="9" transform="scale(1e308)"/>').encode(), "a transform"),
    "no path": ("x.svg", SVG.format('<path stroke="#000" d="M 0 0 L 1"/>').encode(), "'M 0 0 L 1' is not a path"),
    "other XML": ("x.svg", b"<html/>", "XML of another kind"),
    "nothing drawn": ("x.svg", SVG.format("<g/>").encode(), "it contains no point, line or circle"),
    "zip bomb": ("x.ggb", archive({"geogebra.xml": BOMB}), "unpacks to more than 16 MB"),
    "zip bomb that lies": ("x.ggb", shrunk(archive({"geogebra.xml": BOMB})), "damaged|no well-formed"),
    "paths in an archive": ("x.ggb", archive({"../geogebra.xml": b"x", "/tmp/x": b"x"}), "has no geogebra.xml"),
    "another archive": ("x.ggb", archive({"word/document.xml": b"<a/>"}), "has no geogebra.xml"),
    "no coordinate": ("x.ggb", ggb(point("1e400")), "'1e400' is not a number"),
    "undefined alone": ("x.ggb", ggb(point("NaN")), "it contains no point, line or circle"),
    "deep term": ("x.ggb", ggb(term("(" * 9000)), "it contains no point, line or circle"),
    "great power": ("x.ggb", ggb(term("9^9^9^9^9")), "it contains no point, line or circle"),
    "code": ("x.ggb", ggb(term("__import__('os').system('touch x')")), "it contains no point, line or circle"),
    "blocks of blocks": ("x.dxf", dxf(nested), "more than 40000 entities|nested"),
    "a block of itself": ("x.dxf", dxf(itself), "nested|it contains no point"),
    "rows of blocks": ("x.dxf", dxf(rows), "more than 40000 entities"),
    "many tags": ("x.dxf", b"  0\nSECTION\n" + b"  0\nLINE\n" * 400_000, "more than 300000 lines"),
    "many entities": ("x.dxf", b"  0\nSECTION\n" + b"  0\nLINE\n" * 30_000, "more than 20000 entities"),
    "infinite line": ("x.dxf", dxf(lambda d: d.modelspace().add_line((0, 0), (1e300, 0))), "farther away"),
    "a million rows": ("x.csv", b"mark,x,y\n" + b"A,1,2\n" * 10**6, "larger than 4 MB"),
    "many rows": ("x.csv", b"mark,x,y\n" + b"A,1,2\n" * 30_000, "more than 20000 lines"),
    "empty rows": ("x.csv", b"mark,x,y\n" + b",,\n" * 10**6, "more than 20000 lines"),
    "one long row": ("x.csv", b"mark,x,y\n" + b"A," * 10**6, "columns"),
    "long cell": ("x.csv", b"mark,x,y\n" + b"A" * 10**6 + b",1,2", "not a row of a table"),
    "long numeral": ("x.csv", b"mark,x,y\nA,1," + b"9" * 5000, "is not a number"),
    "lists in lists": ("x.toml", b"marks = " + b"[" * 10**5, "not TOML|nested too deeply"),
    "dots in dots": ("x.toml", b"a." * 10**5 + b"a = 1", "too many dots"),
    "many dotted names": ("x.toml", b"[marks]\n" + (b"a." * 900 + b"b = 1\n") * 250, "too many dots"),
    "huge integer": ("x.toml", b"[marks]\nA = [1, " + b"9" * 5000 + b"]", "not TOML|not a number"),
    "infinite mark": ("x.toml", b"[marks]\nA = [1, -inf]", "not a number"),
    "name of lines": ("x.toml", b'[marks]\n"A\\nB" = 3', "marks.A B: not a point"),
}  # fmt: skip


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


LOOP = pdf(b"<</Type/Catalog/Pages 2 0 R>>", b"<</Type/Pages/Count 1/Kids[2 0 R]>>")
DRAWN = '<svg xmlns="http://www.w3.org/2000/svg" {}><path stroke="#000" d="M0 0L9 9"/></svg>'
NAN = b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nnan\n20\n1\n11\n2\n21\n2\n0\nENDSEC\n0\nEOF\n"
BROKEN = {
    "a bomb": ("x.png", png(60_000, 60_000, data=zlib.compress(bytes(10**6))), "megapixels"),
    "a huge head": ("x.jpg", b"\xff\xd8\xff\xe0\x00\x04ab\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03" + bytes(40),
                    "megapixels"),
    "too few pixels": ("x.png", png(20, 20, data=zlib.compress(bytes(420))), "too few"),
    "a broken picture": ("x.png", png(1000, 1000, data=b"no"), "damaged"),
    "a head of a photo": ("x.jpg", b"\xff\xd8\xff\xe0\x00\x10JFIF", "damaged"),
    "a broken document": ("x.pdf", b"%PDF-1.7\nnothing", "damaged"),
    "words": ("x.png", b"these are words", "not a PNG"),
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
    "half an element": ("x.ggb", ggb('<element type="point">')),
    "a window of no number": ("x.svg", DRAWN.format('viewBox="0 0 nan 1"').encode()),
    "a window of nothing": ("x.svg", DRAWN.format('width="0" height="0"').encode()),
    "half a tag": ("x.svg", b"<svg"),
    "a binary file of CAD": ("x.dxf", b"AutoCAD Binary DXF\r\n\x1a\0" + bytes(100)),
    "a line of no number": ("x.dxf", NAN),
    "half a section": ("x.dxf", b"0\nSECTION"),
    "another kind": ("x.tif", b"II*\0"),
}  # fmt: skip


def refused(path: Path, capfd: pytest.CaptureFixture[str]) -> str:
    """The one line in which a file is refused; nothing else is printed, by any library."""
    done = ran("verify", "four-bar", path, "-q")
    assert (done.status, done.out) == (2, "")
    assert done.err.count("\n") == 1, done.err
    assert path.name in done.err
    assert len(done.err) < 400 + len(str(path))
    assert capfd.readouterr() == ("", "")
    return done.err


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_files_are_refused(case: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Bombs, loops, entities, paths, and numbers that are none: one clear line, and nothing else in the folder."""
    name, data, why = HOSTILE[case]
    (tmp_path / name).write_bytes(data)
    line = refused(tmp_path / name, capfd)
    assert any(part in line for part in why.split("|")), line
    assert os.listdir(tmp_path) == [name]


@pytest.mark.parametrize("case", BROKEN)
def test_broken_files_are_refused(case: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Whatever is handed in: one line of ours alone, and no more memory than a gigabyte."""
    name, data, *why = BROKEN[case]
    (tmp_path / name).write_bytes(data)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    line = refused(tmp_path / name, capfd)
    assert all(part in line for part in why), line
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MEMORY
    assert os.listdir(tmp_path) == [name]


def test_a_folder_of_broken_files_is_a_class_without_drawings(tmp_path: Path) -> None:
    """Each is named with what is wrong with it, and the run ends as one in which nothing was judged."""
    for number, (name, data, *_) in enumerate(BROKEN.values()):
        (tmp_path / f"{number:02}-{name}").write_bytes(data)
    done = ran("verify", "four-bar", tmp_path, "-q")
    assert done.status == 2
    told = done.out + done.err
    assert not [path.name for path in tmp_path.iterdir() if path.suffix != ".tif" and path.name not in told]


@pytest.mark.parametrize("name", ["x.csv", "x.toml", "x.svg", "x.dxf", "x.ggb", "x.png", "x.pdf"])
def test_files_that_are_none_are_refused(name: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Missing and empty files, garbage, directories and pipes, and files of gigabytes, of which little is read."""
    path = tmp_path / name
    assert "no such file" in refused(path, capfd)
    path.write_bytes(b"  \n" if name < "x.p" or name > "x.pz" else b"")
    assert "it is empty" in refused(path, capfd)
    path.write_bytes(GARBAGE)
    refused(path, capfd)
    with path.open("wb") as file:
        file.truncate(8 * 2**30)
    tracemalloc.start()
    try:
        assert "larger than" in refused(path, capfd)
        assert tracemalloc.get_traced_memory()[1] < 128 * 2**20
    finally:
        tracemalloc.stop()
    path.unlink()
    path.mkdir()
    refused(path, capfd)
    path.rmdir()
    os.mkfifo(path)
    assert "not a regular file" in refused(path, capfd)
    path.unlink()
    path.symlink_to(name)
    refused(path, capfd)


@pytest.mark.parametrize("name", ["x.heic", "x.HEIF", "x.jpg"])
def test_photos_of_phones_say_how_to_save_them(name: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """HEIC is told by its bytes, whatever it is called, and what to do about it."""
    (tmp_path / name).write_bytes(struct.pack(">I", 24) + b"ftypheic" + bytes(100))
    assert "this is a HEIC photo, as phones take them, which is not read; send or save it as JPEG" in refused(
        tmp_path / name, capfd)


@pytest.mark.parametrize("form", ["svg", "geogebra", "dxf lines"])
def test_spoilt_files_are_judged_or_refused(form: str, tmp_path: Path) -> None:
    """A file that ends too early, or in which a byte is another: it is judged, or refused in one line."""
    chance, suffix = random.Random(7), FORMATS[form][0]
    drawing = right("four-bar, polar", 0)
    data, scene = FORMATS[form][1](drawing), scene_file(drawing.task)
    ends = [len(data) * part // 8 for part in range(1, 8)]
    spoilt = [data[:end] for end in ends] + [
        data[:place] + chance.randbytes(1) + data[place + 1 :] for place in chance.sample(range(len(data)), 12)]
    for number, content in enumerate(spoilt):
        (path := tmp_path / f"{number}{suffix}").write_bytes(content)
        done = ran("verify", scene, path, "-q", "--plan", "polar")
        assert done.status == 0 or (done.status == 2 and done.err.startswith(str(path))), done.err
        assert done.err.count("\n") <= 1


def test_other_members_of_an_archive_are_left_alone(tmp_path: Path) -> None:
    """A construction is read although paths and a bomb lie beside it: these are neither unpacked nor written."""
    drawing = right("four-bar, polar", 0)
    with zipfile.ZipFile(io.BytesIO(FORMATS["geogebra"][1](drawing))) as packed:
        own = packed.read("geogebra.xml")
    (tmp_path / "x.ggb").write_bytes(archive({"../../evil": b"x", "bomb": BOMB, "geogebra.xml": own}))
    assert judged(drawing, tmp_path / "x.ggb").score == 100
    assert os.listdir(tmp_path) == ["x.ggb"]


def test_other_suffixes_are_refused_with_those_that_are_read(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Whether or not there is such a file."""
    assert "(.exe) are not read; give one of .csv .toml .svg .dxf .ggb .png" in refused(tmp_path / "x.exe", capfd)


@pytest.mark.parametrize(("kind", "package"), [("dxf", "ezdxf"), ("svg", "svgelements")])
def test_drawings_need_their_extra(kind: str, package: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                   capfd: pytest.CaptureFixture[str]) -> None:
    """Without the package that reads it, a file is refused with what to install."""
    monkeypatch.setitem(sys.modules, package, None)
    (path := tmp_path / f"a.{kind}").write_bytes(FORMATS["svg"][1](right("four-bar, polar", 0)))
    assert f"{package} is not installed; pip install 'graphplan[{kind}]'" in refused(path, capfd)
