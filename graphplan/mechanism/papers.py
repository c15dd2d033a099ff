"""The sheets of paper by name, lying, in mm: ISO 216, and those of North America."""

from __future__ import annotations

ISO_SIZES = {"A4": (297.0, 210.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0),
             "A0": (1189.0, 841.0)}
SIZES = {**ISO_SIZES, "Letter": (279.4, 215.9), "Legal": (355.6, 215.9), "Tabloid": (431.8, 279.4)}
AS_LARGE_AS = {"Letter": "A4", "Legal": "A4", "Tabloid": "A3"}  # the ISO paper beside which others are judged
PAPERS = tuple(f"{size}{way}" for size in SIZES for way in ("", " portrait"))


def iso_size(paper: str) -> str:
    """The ISO size that a sheet such as `A4 portrait` or `Letter` has, or is about as large as."""
    name = paper.partition(" ")[0]
    return AS_LARGE_AS.get(name, name)
