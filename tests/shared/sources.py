"""The package's source files, each parsed once in a process."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

import graphplan

PACKAGE = Path(graphplan.__file__).parent
FILES = sorted(PACKAGE.rglob("*.py"))


@cache
def parsed(path: Path) -> ast.Module:
    """The syntax of a file."""
    return ast.parse(path.read_text(encoding="utf-8"))
