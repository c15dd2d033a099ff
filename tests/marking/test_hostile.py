"""Files that would harm: each is refused in one clear line, in bounded time and memory, and nothing is written."""

from __future__ import annotations

import io
import os
import random
import struct
import tracemalloc
import zipfile
from collections.abc import Callable
from pathlib import Path

import ezdxf
import pytest

from graphplan.errors import Refused
from graphplan.marking.files.safe import MB
from graphplan.marking.submission import read_submission

BOMB = bytes(17 * MB)
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


def refused(path: Path) -> str:
    """The one line in which a file is refused."""
    with pytest.raises(Refused) as told:
        read_submission(path, ("N-plan",), {})
    assert told.value.status == 2
    (line,) = told.value.lines
    assert line.startswith(str(path))
    assert "\n" not in line
    assert len(line) < 400 + len(str(path))
    return line


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_files_are_refused(tmp_path: Path, case: str) -> None:
    """Bombs, loops, entities, paths, and numbers that are none: one clear line, and nothing else in the folder."""
    name, data, why = HOSTILE[case]
    path = tmp_path / name
    path.write_bytes(data)
    line = refused(path)
    assert any(part in line for part in why.split("|")), line
    assert os.listdir(tmp_path) == [name]


def test_entities_of_plain_text_are_read(tmp_path: Path) -> None:
    """What older programs declare, names for namespaces and the like, is put in; the document type is not fetched."""
    path = tmp_path / "x.svg"
    path.write_text('<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://127.0.0.1:9/svg11.dtd" ['
                    '<!ENTITY ns_svg "http://www.w3.org/2000/svg"><!ENTITY ink "stroke:black">]>'
                    '<svg xmlns="&ns_svg;" width="90mm" height="90mm" viewBox="0 0 90 90">'
                    '<line x1="10" y1="10" x2="60" y2="10" style="&ink;"/></svg>')
    (trace,) = read_submission(path, ("N-plan",), {}).traces
    assert trace.spots == (pytest.approx((10.0, 80.0)), pytest.approx((60.0, 80.0)))


@pytest.mark.parametrize("name", KINDS)
def test_files_that_are_none(tmp_path: Path, name: str) -> None:
    """Empty files, directories, garbage, missing files and pipes are refused, whatever their suffix says."""
    path = tmp_path / name
    assert "no such file" in refused(path)
    path.write_bytes(b"  \n")
    assert "it is empty" in refused(path)
    path.write_bytes(GARBAGE)
    refused(path)
    path.unlink()
    path.mkdir()
    assert "this is a directory" in refused(path)
    path.rmdir()
    os.mkfifo(path)
    assert "not a regular file" in refused(path)


SEEN = point("3") + point("4").replace('"A"', '"B"')
RULED = "".join(f'<element type="line" label="{label}"><show object="false"/><coords x="1" y="{y}" z="0"/></element>'
                for label, y in (("f", 1), ("g", 2)))
ABSURD = {"(1,2) &lt; (3,4)": "point", "Line(f,g)": "line", "Circle(f,3)": "conic", "Vector(f)": "vector",
          "Midpoint(f,g)": "point", "Center(f)": "point", "(-8)^0.5": "point"}  # fmt: skip


@pytest.mark.parametrize("written", ABSURD)
def test_terms_of_wrong_kinds_have_no_value(tmp_path: Path, written: str) -> None:
    """Points compared, lines through lines: what is made of things of another kind is not there, the rest is read."""
    path, made = tmp_path / "x.ggb", f'<element type="{ABSURD[written]}" label="C"><show object="true"/></element>'
    path.write_bytes(ggb(f'{SEEN}{RULED}<expression label="C" exp="{written}"/>{made}'))
    assert [trace.label for trace in read_submission(path, (), {}).traces] == ["A", "B"]


@pytest.mark.parametrize("name", KINDS)
def test_huge_files_are_not_read(tmp_path: Path, name: str) -> None:
    """Of a file of gigabytes no more is read than a drawing may have."""
    path = tmp_path / name
    with path.open("wb") as file:
        file.truncate(8 * 1024 * MB)
    tracemalloc.start()
    try:
        assert "larger than" in refused(path)
        assert tracemalloc.get_traced_memory()[1] < 64 * MB
    finally:
        tracemalloc.stop()


SOUND = {
    "x.svg": SVG.format('<g><path stroke="#000" d="M0 0L9 9"/></g>').encode(),
    "x.ggb": ggb(point("3")),
    "x.dxf": dxf(lambda document: document.modelspace().add_line((0, 0), (9, 9))),
}


@pytest.mark.parametrize("name", SOUND)
def test_truncated_files(tmp_path: Path, name: str) -> None:
    """A file that ends too early is refused or, where what is left is sound, read; nothing else happens."""
    path = tmp_path / name
    for part in range(1, 8):
        path.write_bytes(SOUND[name][: len(SOUND[name]) * part // 8])
        try:
            assert read_submission(path, (), {}).traces
        except Refused as error:
            assert str(path) in str(error)
    path.write_bytes(SOUND[name])
    assert read_submission(path, (), {}).traces


def test_one_changed_byte(tmp_path: Path) -> None:
    """Whatever byte of a sound file is another, the file is read or refused."""
    chance = random.Random(7)
    for name, data in SOUND.items():
        path = tmp_path / name
        for _ in range(10 if name == "x.dxf" else 100):
            place = chance.randrange(len(data))
            path.write_bytes(data[:place] + chance.randbytes(1) + data[place + 1 :])
            try:
                read_submission(path, (), {})
            except Refused as error:
                assert "\n" not in str(error)


def test_other_members_of_an_archive_are_left_alone(tmp_path: Path) -> None:
    """A construction is read although paths and a bomb lie beside it: these are neither unpacked nor written."""
    path = tmp_path / "x.ggb"
    members = {"../../evil": b"x", "bomb": BOMB, "geogebra.xml": GEOGEBRA.format(point("3")).encode()}
    path.write_bytes(archive(members))
    assert read_submission(path, (), {}).traces[0].spots == ((3, 1),)
    assert os.listdir(tmp_path) == ["x.ggb"]


def test_other_suffixes(tmp_path: Path) -> None:
    """A file of another kind is refused with the kinds that are read."""
    assert "(.exe) are not read; give one of .csv .toml .svg .dxf .ggb .png" in refused(tmp_path / "x.exe")
    assert "beside the sheet that was printed" in refused(tmp_path / "x.png")
