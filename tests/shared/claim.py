"""Claims: what holds of all that a user gets, each a function of one scene's; `tests/claims` has them, by subjects."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

from face import Got, got, names
from sampling import CORE

import graphplan as gp


class Claim(NamedTuple):
    """A claim about scenes: those of the core, or all where it is `cheap`, that have the feature it speaks of."""

    holds: Callable[[Got], None]
    cheap: bool
    having: Callable[[gp.Scene], object]

    def scenes(self) -> Iterator[str]:
        """The packaged scenes that it is tried on."""
        return (name for name in (names() if self.cheap else CORE) if self.having(got(name).scene))


CLAIMS: list[Claim] = []


def claim(*, cheap: bool = False, having: Callable[[gp.Scene], object] = lambda scene: True) -> Callable[
        [Callable[[Got], None]], Callable[[Got], None]]:
    """Makes a function a claim: about all scenes if it is cheap, and about those that have something."""
    def put(holds: Callable[[Got], None]) -> Callable[[Got], None]:
        CLAIMS.append(Claim(holds, cheap, having))
        return holds

    return put
