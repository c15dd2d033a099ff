"""Names from when the suite had two tiers, for the files that still ask for them."""

from __future__ import annotations

from typing import TypeVar

import sampling
from sampling import scenes as scenes

T = TypeVar("T")

THOROUGH: bool = sampling.everything


def sample(quick: T, thorough: T) -> T:
    """The first in a sample of the suite, the second where all of it runs."""
    return thorough if THOROUGH else quick
