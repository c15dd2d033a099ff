"""All claims, on the scenes of the core or on all: see `claim.py`."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import pytest
from claim import CLAIMS, Claim
from face import got, names

for path in sorted((Path(__file__).parent / "claims").glob("claims_of_*.py")):
    import_module(path.stem)

SCENES = {claim: frozenset(claim.scenes()) for claim in CLAIMS}
PAIRS = [pytest.param(claim, name, id=f"{claim.holds.__module__}.{claim.holds.__name__}-{name}")
         for name in names() for claim, scenes in SCENES.items() if name in scenes]


@pytest.mark.parametrize(("claim", "name"), PAIRS)
def test_claim(claim: Claim, name: str) -> None:
    """A claim holds for the data, sheet, protocol and files of a scene."""
    claim.holds(got(name))
