"""Kinematic pairs: one file a kind, each with all that is said of it."""

from __future__ import annotations

import os
from importlib import import_module
from typing import Any

KINDS = sorted(name[:-3] for name in os.listdir(os.path.dirname(__file__)) if name[0] != "_" and name.endswith(".py"))
"""The kinds of pairs: every file here is one, but for what they are made of."""


def fields() -> list[Any]:
    """The tables of a scene in which pairs are written, each a field; what drives pairs comes last."""
    modules = [import_module(f"{__name__}.{kind}") for kind in KINDS]
    pair_fields = [module.FIELD for module in modules if hasattr(module, "FIELD")]
    return sorted(pair_fields, key=lambda field: field.name == "drive")
