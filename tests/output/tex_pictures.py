"""Pictures in LaTeX: compiled, rendered, and laid over the sheet as graphplan's own back end renders it."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.image import imread

from graphplan.output.exports.walk import extent
from graphplan.output.png import png
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import back_to_front, captions, layout
from graphplan.sheet.plates.display import Rect, Text, move_item

ENGINES = "pdflatex", "lualatex", "xelatex"
DPI, DARK = 127, 200  # five dots a millimetre; what is darker than this is ink
HIDDEN = r"\tikzset{every node/.append style={opacity=0, text opacity=0}}"
COMPLAINTS = re.compile(r"^(!.*|.*Warning:.*|Missing character.*|(?:Ov|Und)erfull.*)$", re.MULTILINE)
Ink = np.ndarray[Any, np.dtype[np.bool_]]


def lacking(engine: str, *files: str) -> str:
    """What is not at hand of what a picture needs, in a word."""
    programs = [name for name in (engine, "kpsewhich", "pdftoppm") if shutil.which(name) is None]
    told = "" if programs else subprocess.run(["kpsewhich", *files], capture_output=True, text=True, check=False).stdout
    return ", ".join(programs or [name for name in files if f"/{name}\n" not in told])


def compiled(source: str, engine: str, folder: Path) -> list[str]:
    """What an engine complains of; the document is figure.pdf in a folder."""
    (folder / "figure.tex").write_text(source, encoding="utf-8")
    run = [engine, "-interaction=nonstopmode", "-halt-on-error", "figure.tex"]
    subprocess.run(run, cwd=folder, capture_output=True, timeout=1800, check=False)
    return COMPLAINTS.findall((folder / "figure.log").read_text(errors="replace"))


def rendered(folder: Path) -> Ink:
    """The ink of figure.pdf."""
    run = ["pdftoppm", "-r", str(DPI), "-gray", "-singlefile", "figure.pdf", "figure"]
    subprocess.run(run, cwd=folder, check=True, timeout=1200)
    _, size, _, data = (folder / "figure.pgm").read_bytes().split(b"\n", 3)
    wide, high = map(int, size.split())
    return np.frombuffer(data, np.uint8).reshape(high, wide) < DARK


def paper(composition: Composition) -> Rect:
    """What of the sheet a picture shows, with the border of the document about it."""
    drawn = (item for picture in composition.pictures.values() for item in picture.items)
    return extent([*drawn, *captions(composition)]).inset(-2.0, -2.0, -2.0, -2.0)


def strokes(composition: Composition) -> Ink:
    """The ink of the sheet's plans without letters."""
    box = paper(composition)
    items = [item for picture in composition.pictures.values() for item in picture.items if not isinstance(item, Text)]
    sheet = layout(composition)
    sheet = replace(sheet, width=box.width, height=box.height,
                    items=tuple(move_item(item, -box.left, -box.bottom) for item in back_to_front(items)))  # fmt: skip
    return imread(io.BytesIO(png(sheet, DPI)))[..., 0] * 255 < DARK


def lettered(composition: Composition) -> list[tuple[slice, slice]]:
    """Where the sheet has letters, with half a millimetre about them, and captions, which other fonts make longer."""
    heads = [text.box.inset(0.0, -4.0, -0.4 * text.box.width, 0.0) for text in captions(composition)]
    boxes = [item.box for picture in composition.pictures.values() for item in picture.items if isinstance(item, Text)]
    page, mm = paper(composition), DPI / 25.4
    return [(slice(max(0, int((page.top - box.top - 0.5) * mm)), int((page.top - box.bottom + 0.5) * mm)),
             slice(max(0, int((box.left - page.left - 0.5) * mm)), int((box.right - page.left + 0.5) * mm)))
            for box in (*heads, *boxes)]  # fmt: skip


def uncovered(one: Ink, other: Ink, mm: float = 0.5) -> float:
    """The part of some ink that has no other ink within so many mm."""
    high, wide, reach = min(len(one), len(other)), min(one.shape[1], other.shape[1]), round(mm * DPI / 25.4)
    one, other = one[:high, :wide], other[:high, :wide]
    near = np.zeros_like(other)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            if dx * dx + dy * dy <= reach * reach:
                near |= np.roll(other, (dy, dx), (0, 1))
    return float((one & ~near).sum() / max(1, one.sum()))
