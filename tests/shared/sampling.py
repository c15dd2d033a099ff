"""The packaged scenes on which a claim about all of them is tried where only a sample runs: a block design.

CORE has 21 scenes and BLOCK is a perfect difference set of 21, so that a claim gets five scenes of the core, each of
these serves a quarter of the claims, and claims share one scene of the core, unless they share all five, as those of
one file do, where sheets and constructions are kept. One more comes from the other scenes in turn, so that each scene
is in some claim. `tests/conftest.py` does this for tests that are parametrised by scenes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar
from zlib import crc32

from face import names

T = TypeVar("T")

CORE = (
    "alt-eight-link", "arc-cam", "cardan-circles", "class-four", "class-four-loaded", "dwell", "geneva",
    "inflection-circle", "jaanimets-10", "kinytskyi", "ozols-10-1", "ozols-13-6", "ozols-13-7", "ozols-16-1",
    "ozols-5-1", "ozols-5-3", "parallel-links", "racks", "roller-cam", "stephenson", "walschaerts-loaded",
)  # fmt: skip
"""Scenes that together run 99.7 % of the lines that any packaged scene runs; the newest are among them."""
BLOCK = 0, 1, 4, 14, 16  # each distance round a ring of 21 lies between one pair of these alone
A_CLAIM = 6  # scenes on which a claim is tried


def spread(variants: Sequence[T], count: int) -> list[T]:
    """So many of all variants, from the first to the last at equal distances."""
    count = min(count, len(variants))
    return [variants[k * (len(variants) - 1) // max(count - 1, 1)] for k in range(count)]


def scenes(claim: str, among: Sequence[str] = (), count: int = A_CLAIM) -> list[str]:
    """The packaged scenes, or of these ones those, on which a claim is tried."""
    among = among or names()
    tried = [name for name in ranked(claim) if name in among][:count]
    return [name for name in among if name in tried]


def ranked(claim: str) -> list[str]:
    """All packaged scenes, those first on which a claim is tried: the block of its file with another among it."""
    turn, row = crc32(claim.encode()), crc32(claim.partition("::")[0].encode())
    core = [CORE[(row + step) % len(CORE)] for step in BLOCK]
    others = [name for name in names() if name not in CORE]
    others = others[(at := turn % len(others)):] + others[:at]
    first = [*core[:2], others[0], *core[2:]]
    return [*first, *(name for name in (*others, *CORE) if name not in first)]
