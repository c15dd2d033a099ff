"""Files of strangers, read with bounds on their size and depth; and the scene that a file of graphplan's own carries.

Nothing is fetched or written, nothing of a file is run, and no name inside it is used as a path.

In a .ggb it is a member of the archive, in DXF comments, in a page a script that is none, in SVG metadata, in PDF a
file attached to it. GeoGebra and CAD programs drop that when they save such a file anew.
"""

from __future__ import annotations

import io
import math
import re
import subprocess
import sys
import zipfile
import zlib
from contextlib import suppress
from html import unescape
from pathlib import Path
from typing import NoReturn
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from graphplan.errors import Refused
from graphplan.marking.files import measures

MB = 2**20
NUMERAL = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
SVG_DOCTYPE = "-//W3C//DTD SVG"  # the public name under which older programs declare SVG; nothing is looked up by it

READ_PAGES = """
import sys
import pypdfium2
path, first, end = sys.argv[1], *map(int, sys.argv[2:])
try:
    document = pypdfium2.PdfDocument(path)
    for page in map(document.__getitem__, range(first, min(end, len(document)))):
        page.render(scale=50 / max(page.get_size()))
except Exception:
    pass  # whoever reads the pages next says what is wrong
"""


def contents(path: Path, most: int) -> bytes:
    """The bytes of a file, if they are at most so many."""
    try:
        if path.is_dir():
            raise Refused(f"{path}", "this is a directory", "give one drawing")
        if not path.exists():
            raise Refused(f"{path}", "no such file", "the path of a drawing")
        if not path.is_file():
            raise Refused(f"{path}", "not a regular file", "give a drawing")
        with path.open("rb") as file:
            data = file.read(most + 1)
    except (OSError, ValueError) as error:  # ValueError: a path that no file system has
        why = f"it cannot be read ({getattr(error, 'strerror', None) or error})"
        raise Refused(f"{path}", why, "a readable file") from None
    if len(data) > most:
        raise Refused(f"{path}", f"it is larger than {most / MB:g} MB", "a file of the drawing alone")
    if not data.strip():
        raise Refused(f"{path}", "it is empty", "give a drawing")
    return data


def text(path: Path, most: int) -> str:
    """The text of a file: UTF-8, or UTF-16 where it says so, as spreadsheets do."""
    data = contents(path, most)
    try:
        return data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError as error:
        raise Refused(f"{path}", f"byte {error.start + 1} is not text", "save it as text in UTF-8") from None


def require_readable_pages(path: Path, first: int, end: int) -> None:
    """Refuse a PDF of which these pages, counted from 0, are not read in bounded time, or end whoever reads them.

    Forms that draw each other twice make a page of a few kB endless, and pdfium cannot be stopped: a process of its own
    reads them first.
    """
    command = [sys.executable, "-P", "-c", READ_PAGES, str(path), str(first), str(end)]
    try:
        ended = subprocess.run(command, capture_output=True, timeout=measures.MAX_PDF_SECONDS, check=False).returncode
    except subprocess.TimeoutExpired:
        why = f"its pages take more than {measures.MAX_PDF_SECONDS:g} s to read"
        raise Refused(f"{path}", why, "print the drawing to PDF anew, or hand in a PNG") from None
    if ended:
        raise Refused(f"{path}", "the document is damaged", "print the drawing to PDF anew, or hand in a PNG")


def unpack(path: Path, data: bytes, name: str, most: int) -> bytes:
    """One member of a ZIP archive, if it has at most so many bytes; the others are not looked at."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            member = archive.getinfo(name)
            if member.file_size > most:
                raise Refused(f"{path}", f"its {name} unpacks to more than {most / MB:g} MB", "save the drawing anew")
            if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                raise Refused(f"{path}", f"its {name} is packed in an unusual way", "save the drawing anew")
            with archive.open(member) as file:
                return file.read(most)
    except KeyError:
        raise Refused(f"{path}", f"the archive has no {name}", "save the drawing anew") from None
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, ValueError, OSError) as error:
        raise Refused(f"{path}", f"the archive is damaged ({error})", "save the drawing anew") from None


def tree(path: Path, data: bytes) -> Element:
    """The elements of an XML document, with the plain texts that its entities stand for; names are without their
    namespaces."""
    try:
        return _TreeReader(path).read(data)
    except (expat.ExpatError, LookupError, ValueError) as error:
        raise Refused(f"{path}", f"not well-formed XML ({error})", "save the drawing anew") from None


class _TreeReader:
    """Builds the tree while it counts."""

    def __init__(self, path: Path):
        self.path, self.builder, self.budget = path, TreeBuilder(), Budget(path, measures.MAX_XML_ELEMENTS, "elements")
        self.depth = 0
        self.parser = expat.ParserCreate(namespace_separator="}")
        self.parser.buffer_text = True
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.EntityDeclHandler = self._entity
        self.parser.AttlistDeclHandler = self._refuse
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self.builder.data

    def read(self, data: bytes) -> Element:
        self.entities = Budget(self.path, measures.MAX_XML_TEXT // len(data) + 1, "letters of entities for its size")
        self.parser.Parse(data, True)
        return self.builder.close()

    def _doctype(self, name: str, system: str | None, public: str | None, subset: int) -> None:
        if system is not None and not (public or "").startswith(SVG_DOCTYPE):
            self._refuse()

    def _refuse(self, *_: object) -> NoReturn:
        raise Refused(f"{self.path}", "it declares a document type of its own, which is not read",
                      "save the drawing without <!DOCTYPE ...>")

    def _entity(self, name: str, parameter: bool, value: str | None, *_: object) -> None:
        """An entity is a plain text: one that stands elsewhere, or is made of others, is not read."""
        if parameter or value is None or set("&<%") & set(value):
            self._refuse()
        self.entities.spend(len(value))

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        self.budget.spend()
        self.depth += 1
        if self.depth > measures.MAX_XML_DEPTH:
            raise Refused(f"{self.path}", f"more than {measures.MAX_XML_DEPTH} elements are nested",
                          "ungroup the drawing")
        self.builder.start(_bare(name), {_bare(key): value for key, value in attributes.items()})

    def _end(self, name: str) -> None:
        self.depth -= 1
        self.builder.end(_bare(name))


def _bare(name: str) -> str:
    return name.rpartition("}")[2]


class Budget:
    """Counts things, and refuses the file when they are too many."""

    def __init__(self, path: Path, most: int, things: str):
        self.path, self.most, self.things, self.spent = path, most, things, 0

    def spend(self, count: int = 1) -> None:
        self.spent += count
        if self.spent > self.most:
            raise Refused(f"{self.path}", f"it has more than {self.most} {self.things}", "a file of the drawing alone")


def number(written: str) -> float:
    """The number that a numeral says.

    Fails with `ValueError` where it is none, or of no use.
    """
    bare = written.strip().replace("−", "-")
    if len(bare) > measures.MAX_NUMERAL_CHARS or not NUMERAL.fullmatch(bare) or not math.isfinite(float(bare)):
        raise ValueError(f"{bare[:measures.MAX_NUMERAL_CHARS]!r} is not a number" if bare else "a number is missing")
    return float(bare)


def on_paper(*lengths: float) -> bool:
    """Whether lengths in mm, or coordinates, are numbers and fall on a conceivable sheet."""
    return all(abs(length) <= measures.MAX_DISTANCE_MM for length in lengths)


MAX_BYTES = 16 * MB
ATTACHED = re.compile(rb"/Type /EmbeddedFile [^<>]{0,100}/Length (\d{1,9}) >>\nstream\n")
SCENE = "scene.toml"  # the member of an archive
COMMENT = re.compile(rb"^ *999\r?\nscene: ?([^\r\n]*)", re.MULTILINE)
SCRIPT = re.compile(r'<(script|metadata)\b(?=[^<>]{0,200}\bid="scene")[^<>]{0,200}>')


def embedded_scene(path: Path, data: bytes) -> str:
    """The scene that one of graphplan's own files carries."""
    found = ""
    with suppress(Refused, UnicodeDecodeError):
        if data.startswith(b"PK"):
            found = unpack(path, data, SCENE, MAX_BYTES).decode()
        elif data.startswith(b"%PDF-"):
            if attached := ATTACHED.search(data):
                found = data[attached.end():attached.end() + int(attached[1])].decode()
        elif lines := COMMENT.findall(data):
            found = b"\n".join(lines).decode() + "\n"
        elif data.lstrip()[:1] == b"<" and (opening := SCRIPT.search(text := data.decode())):
            found, closing, _ = text[opening.end():].partition(f"</{opening[1]}>")
            found = (unescape(found) if opening[1] == "metadata" else found) if closing else ""
    return found
