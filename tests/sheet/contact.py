"""All sheets on one picture, to look at: `python tests/sheet/contact.py OUT.png [SCENE ...]`."""

from __future__ import annotations

import io
import sys

from PIL import Image

import graphplan as gp
from graphplan.mechanism.scene import packaged_names

WIDE, ACROSS = 1000, 3  # dots of a sheet, and how many stand beside each other


def main(out: str, *names: str) -> None:
    """Draw the first pages of the scenes named, or of all, beside and below each other."""
    pages = [Image.open(io.BytesIO(gp.sheet.png(gp.construct(gp.load(name)), dpi=100))) for name in names
             or packaged_names()]
    small = [page.convert("RGB").resize((WIDE, WIDE * page.height // page.width)) for page in pages]
    rows = [small[k : k + ACROSS] for k in range(0, len(small), ACROSS)]
    picture = Image.new("RGB", (WIDE * ACROSS, sum(max(page.height for page in row) for row in rows)), "white")
    top = 0
    for row in rows:
        for k, page in enumerate(row):
            picture.paste(page, (k * WIDE, top))
        top += max(page.height for page in row)
    picture.save(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
