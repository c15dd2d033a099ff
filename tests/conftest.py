"""What runs by default of tests with many variants: of claims about all packaged scenes a few scenes each, and of what
costs much a few variants; see `shared/tiers.py`.
"""

from __future__ import annotations

import gc
import tomllib
from collections import defaultdict
from collections.abc import Iterator, Sequence
from math import ceil
from pathlib import Path

import pytest
from hypothesis import settings
from tiers import A_CLAIM, THOROUGH, sample, scenes, spread

from graphplan.commands import GC_THRESHOLD
from graphplan.mechanism.scene import packaged_names

PACKAGED = frozenset(packaged_names())
settings.register_profile("default", max_examples=sample(20, 100), deadline=None, derandomize=not THOROUGH)
settings.load_profile("default")
LISTED = 8  # scenes that a test names itself, for a reason, at the most: all of these are tried
A_PLAN = 3  # scenes at the least on which each variant of a claim is tried, such as each plan
COSTLY = tomllib.loads((Path(__file__).parent / "shared" / "costly.toml").read_text(encoding="utf-8"))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leaves each test its share; what is named with its brackets runs whatever its share."""
    if THOROUGH or any("[" in argument for argument in config.args):
        return
    functions = defaultdict[str, list[pytest.Item]](list)
    for item in items:
        functions[item.nodeid.partition("[")[0]].append(item)
    tried = {item for function, made in functions.items() for item in share(function, made)}
    config.hook.pytest_deselected(items=[item for item in items if item not in tried])
    items[:] = [item for item in items if item in tried]


def pytest_collection_finish() -> None:
    """What is collected stays to the end: garbage is looked for in what the tests make alone, and as by a command."""
    gc.freeze()
    gc.set_threshold(GC_THRESHOLD)


def share(function: str, made: Sequence[pytest.Item]) -> Iterator[pytest.Item]:
    """Those variants of a test that are tried by default."""
    file, _, name = function.rpartition("::")
    count = COSTLY.get(file, {}).get(name)
    scene_of = {item: scene(item) for item in made}
    if len({*scene_of.values()} - {""}) > LISTED:
        variants = defaultdict[str, list[pytest.Item]](list)
        for item in made:
            variants[item.nodeid.replace(scene_of[item], "", 1)].append(item)
        each = max(A_PLAN, ceil(A_CLAIM / len(variants))) if count is None else ceil(count / len(variants))
        for variant, own in spread([*variants.items()], len(variants) if count is None else count):
            chosen = scenes(variant, [scene_of[item] for item in own], each)
            yield from (item for item in own if scene_of[item] in chosen)
    else:
        yield from made if count is None else spread(made, count)


def scene(item: pytest.Item) -> str:
    """The packaged scene that a test is made for; none where it is not made for one."""
    values = item.callspec.params.values() if hasattr(item, "callspec") else ()
    return next((value for value in values if isinstance(value, str) and value in PACKAGED), "")
