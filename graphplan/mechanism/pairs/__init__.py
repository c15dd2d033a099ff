"""Kinematic pairs: one file a kind, each with all that is said of it."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

KINDS = sorted(path.stem for path in Path(__file__).parent.glob("[a-z]*.py"))
"""The kinds of pairs: every file here is one, but for what they are made of."""


def fields() -> list[Any]:
    """The tables of a scene in which pairs are written, each a field; what drives pairs comes last."""
    modules = [import_module(f"{__name__}.{kind}") for kind in KINDS]
    found = [module.FIELD for module in modules if hasattr(module, "FIELD")]
    return sorted(found, key=lambda field: field.name == "drive")
