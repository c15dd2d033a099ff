"""The scene that a file of graphplan's own carries as text.

In a .ggb it is a member of the archive, in DXF comments, in a page a script that is none, in SVG metadata, in PDF a
file attached to it. GeoGebra and CAD programs drop that when they save such a file anew.
"""

from __future__ import annotations

import re
from contextlib import suppress
from html import unescape
from pathlib import Path

from graphplan.errors import Refused
from graphplan.marking.files.safe import MB, unpack

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
