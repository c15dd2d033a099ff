"""Readers of other programs' files, chosen by the content of a file.

What kind of file it is, its suffix and its content tell. A reader a format makes a sketch (sketch.py), which is tidied
alike for all; written.py says it as a scene and sees to it that the scene moves, or that a comment or the refusal says
why not.

A file that graphplan wrote itself carries its scene as text: in a .ggb as a member of the archive, in DXF as comments,
in a page as a script that is none, in SVG as metadata, in PDF as a file attached to it. GeoGebra and CAD programs drop
that when they save such a file anew, and then the drawing is read.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from graphplan.errors import Refused, SceneError, missing_package
from graphplan.importing import linkage2, pmks
from graphplan.importing.sketch import LinkageSketch
from graphplan.importing.written import propose_scene
from graphplan.marking.files.safe import MAX_BYTES, embedded_scene
from graphplan.marking.files.safe import contents as read_contents
from graphplan.mechanism.scene import parse

KINDS = ".ggb (GeoGebra), .dxf, .linkage2 (Linkage), or a .csv, .pmks or address of PMKS+"


def import_scene(path: Path) -> tuple[str, list[str]]:
    """Return the scene in a file, as TOML, and what was guessed, corrected or left out, item by item.

    Fails with `Refused` where the file is of no kind that is known, is damaged, or nothing in it moves.
    """
    data = read_contents(path, MAX_BYTES)
    if carried := embedded_scene(path, data):
        try:
            parse(carried, f"{path}")
        except SceneError as error:
            wrong = error.faults[0]
            raise Refused(f"{path}", f"the scene in it has a fault at {wrong.where}: {wrong.what}",
                          wrong.instead) from None
        return carried, []
    sketch = _reader(path, data)()
    if not sketch.title:
        sketch.title = path.stem
    contents = ": " * any(sketch.contents.values()) + ", ".join(
        f"{count} {kind}" for kind, count in sketch.contents.items() if count)
    return propose_scene(sketch, f"{path}", f"imported from {path.name} ({sketch.program}{contents})")


def _reader(path: Path, data: bytes) -> Callable[[], LinkageSketch]:
    """Return the reader of a file."""
    start = data[:4096].lstrip(b"\xef\xbb\xbf \t\r\n")
    if data.startswith(b"PK"):
        from graphplan.importing import geogebra

        return lambda: geogebra.read(path, data)
    if start.startswith(b"<") and (b"<linkage2" in start or path.suffix.lower() == ".linkage2"):
        return lambda: linkage2.read(path, data)
    if data.startswith(b"AutoCAD Binary DXF") or (b"SECTION" in start and re.match(rb"\d+\r?\n", start)):
        return lambda: _dxf(path, data)
    with suppress(UnicodeDecodeError):
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
        if pmks.knows(text):
            return lambda: pmks.read(path, text)
    raise Refused(f"{path}", "not a linkage file of a known program", f"a file of these: {KINDS}")


def _dxf(path: Path, data: bytes) -> LinkageSketch:
    try:
        from graphplan.importing import dxf
    except ModuleNotFoundError as missing:
        raise missing_package(f"{path}", missing.name, "dxf") from None
    return dxf.read(path, data)
