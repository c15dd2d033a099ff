"""The kinds of reading by name: what a construction gives, in words."""

from __future__ import annotations

from graphplan.methods.panels import acting, sliding
from graphplan.phrases import Said, phrase

KINDS = {
    "velocity": phrase("velocity"), "acceleration": phrase("acceleration"), "omega": phrase("omega"),
    "alpha": phrase("alpha"), "slide velocity": phrase("slide velocity"), "force": phrase("force"),
    "slide acceleration": phrase("slide acceleration"), "reaction": phrase("reaction"),
    "slide reaction": phrase("slide reaction"), "slide moment": phrase("slide moment"),
    "slide arm": phrase("slide arm"), "balance": phrase("balance"), "balance moment": phrase("balance moment"),
    "balance with friction": phrase("balance with friction"),
    "balance moment with friction": phrase("balance moment with friction"), "lever": phrase("lever"),
    "lever moment": phrase("lever moment"), "curves": phrase("curves"),
}  # fmt: skip


def kind_named(kind: str) -> Said:
    """A kind of reading in words."""
    return KINDS[kind]()


def thing_named(kind: str, of: str) -> str:
    """What a reading of a kind is of, in words: a slide, a link at a joint, else a point, link or number as it is."""
    if kind.startswith("slide "):
        return sliding(of)
    return acting(of) if kind == "reaction" else of
