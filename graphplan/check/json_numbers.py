"""Numbers as JSON takes them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any


def number(value: Any) -> Any:
    """A number or a vector: floats as they are, fractions as a string p/q, none as null."""
    if isinstance(value, tuple):
        return [number(part) for part in value]
    return str(value) if isinstance(value, Fraction) else None if value is None else value + 0.0
