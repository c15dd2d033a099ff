"""Names by which textbooks and other programs call the fixed link, which a scene calls frame."""

from __future__ import annotations

from collections.abc import Collection

FRAME = "frame"
SYNONYMS = frozenset((
    "0", "frame", "ground", "base", "fixed", "fixed link", "chassis", "bed",  # English
    "gestell", "rahmen", "grund", "boden", "statnis", "balsts", "rāmis", "pamatne",  # German, Latvian
    "alus", "kere", "kinnislüli", "raam",  # Estonian
    "стойка", "станина", "основание", "рама", "стояк", "основа",  # Russian, Ukrainian
    "bâti", "bati", "bâtis", "telaio", "bastidor", "rám", "podstawa", "ostoja",
))
"""In small letters."""


def is_frame_synonym(name: str) -> bool:
    """Whether a name is one that the fixed link often has, and not frame itself."""
    return name != FRAME and name.strip().lower() in SYNONYMS


def with_frame(text: str, known: Collection[str]) -> str:
    """A link, or several such as `3 along ground`, with frame for each such name that is not known; or nothing where
    the scene knows no such link either."""
    words = [FRAME if is_frame_synonym(word) and word not in known else word for word in text.split()]
    meant = " ".join(words)
    return meant if meant != text and meant in known else ""
