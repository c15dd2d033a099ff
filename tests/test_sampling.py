"""The sample of the suite: how claims share the packaged scenes."""

from __future__ import annotations

import subprocess
import sys
from itertools import permutations
from pathlib import Path

from face import names
from sampling import A_CLAIM, BLOCK, CORE, ranked, spread


def test_any_two_claims_share_a_scene_of_the_core() -> None:
    """Each distance round the ring of the core lies between two scenes of a block just once."""
    assert len({*CORE} & {*names()}) == len(CORE)
    assert sorted((a - b) % len(CORE) for a, b in permutations(BLOCK, 2)) == [*range(1, len(CORE))]


def test_every_scene_is_in_some_claim() -> None:
    """Where claims are four times as many as scenes, each scene is tried by some; none is left out in the end."""
    claims = [ranked(f"claim {k}") for k in range(4 * len(names()))]
    assert {name for claim in claims for name in claim[:A_CLAIM]} == {*names()}
    assert all(sorted(claim) == sorted(names()) for claim in claims)


def test_variants_are_taken_at_equal_distances() -> None:
    """From the first to the last, none twice; one is the first, and none more than there are."""
    assert spread(range(9), 3) == [0, 4, 8]
    assert spread(range(9), 1) == [0]
    assert spread(range(9), 0) == []
    assert [len({*spread(range(7), count)}) for count in range(10)] == [*range(8), 7, 7]


def test_the_sample_and_the_rest_are_all() -> None:
    """No test is in both, and none in neither."""
    def collected(*options: str) -> set[str]:
        files = "tests/test_lint.py", "tests/test_claims.py"
        command = [sys.executable, "-m", "pytest", "-q", "--collect-only", *options, *files]
        done = subprocess.run(command, cwd=Path(__file__).parents[1], capture_output=True, text=True, check=True)
        return {line for line in done.stdout.splitlines() if "::" in line}

    sample, rest, everything = collected(), collected("--rest"), collected("--all")
    assert sample
    assert rest
    assert not sample & rest
    assert sample | rest == everything
