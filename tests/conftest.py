"""The part of the suite that runs: a sample by default, with --all everything, with --rest all that it leaves out.

The sample tries a claim about all packaged scenes on a few of them, all variants of a test marked `small`, the first
and last of any other, and leaves out what is marked `costly`. A test that is named with its brackets always runs.
"""

from __future__ import annotations

import faulthandler
import gc
import os
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from itertools import count
from math import ceil
from pathlib import Path

import pytest
from face import names
from hypothesis import settings
from sampling import A_CLAIM, scenes, spread

from graphplan.commands import GC_THRESHOLD

PACKAGED = frozenset(names())
settings.register_profile("suite", max_examples=20, deadline=None, derandomize=True)
settings.load_profile("suite")
LISTED = 8  # scenes that a test names itself, for a reason, at the most: these are variants as any others
A_PLAN = 3  # scenes at the least on which each variant of a claim is tried, such as each plan
A_TEST = 2  # variants of any other test
HANGS = 3600.0  # seconds after which a test is taken to hang: hundreds of times what the longest takes
SWEPT = 40  # tests after which garbage is looked for
ENDED = count(1)  # tests of this process
TESTS = Path(__file__).parent
STDERR = pytest.StashKey[int]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds --all and --rest."""
    group = parser.getgroup("graphplan")
    group.addoption("--all", action="store_true", help="run the whole suite, not a sample of it")
    group.addoption("--rest", action="store_true", help="run what the sample leaves out")


def pytest_configure(config: pytest.Config) -> None:
    """Names the marker, and keeps where standard error went."""
    config.addinivalue_line("markers", "costly: not in the sample, because another test covers most of it for less")
    config.addinivalue_line("markers", "small: each variant takes a moment, and all are in the sample")
    config.stash[STDERR] = os.dup(2)  # before pytest captures it


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselects what was not asked for."""
    if config.getoption("--all") or any("[" in argument for argument in config.args):
        return
    functions = defaultdict[str, list[pytest.Item]](list)
    for item in items:
        functions[item.nodeid.partition("[")[0]].append(item)
    sample = {item for function, variants in functions.items() for item in share(function, variants)}
    chosen = [item for item in items if (item in sample) != config.getoption("--rest")]
    config.hook.pytest_deselected(items=[*{*items} - {*chosen}])
    items[:] = chosen


def pytest_collection_finish() -> None:
    """Collected tests stay to the end, so garbage is looked for only in what tests make, and as seldom as by a command.

    That leaves pictures in memory until there are many objects: see SWEPT.
    """
    gc.freeze()
    gc.set_threshold(GC_THRESHOLD)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Ends the process, with a traceback, where a test hangs; looks for garbage now and then."""
    faulthandler.dump_traceback_later(HANGS, exit=True, file=item.config.stash[STDERR])
    try:
        return (yield)
    finally:
        faulthandler.cancel_dump_traceback_later()
        if next(ENDED) % SWEPT == 0:
            gc.collect()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Prints the seconds of each folder, over all processes, where more than the sample runs."""
    if not (config.getoption("--all") or config.getoption("--rest")):
        return
    seconds = Counter[str]()
    for reports in terminalreporter.stats.values():
        for report in reports:
            if isinstance(report, pytest.TestReport):
                folder = (config.rootpath / report.fspath).relative_to(TESTS).parts[0]
                seconds[folder] += report.duration
    terminalreporter.section("seconds of each folder")
    for folder, spent in seconds.most_common():
        terminalreporter.line(f"{spent:7.0f}  {folder}")
    terminalreporter.line(f"{seconds.total():7.0f}  in all")


def share(function: str, variants: Sequence[pytest.Item]) -> Iterator[pytest.Item]:
    """The variants of a test that are in the sample."""
    variants = [item for item in variants if not item.get_closest_marker("costly")]
    if any(item.get_closest_marker("small") for item in variants):
        yield from variants
        return
    scene_of = {item: scene(item) for item in variants}
    if len({*scene_of.values()} - {""}) <= LISTED:
        yield from spread(variants, A_TEST)
        return
    plans = defaultdict[str, list[pytest.Item]](list)
    for item in variants:
        plans[item.nodeid.replace(scene_of[item], "", 1)].append(item)
    for plan, own in plans.items():
        chosen = scenes(plan, [scene_of[item] for item in own], max(A_PLAN, ceil(A_CLAIM / len(plans))))
        yield from (item for item in own if scene_of[item] in chosen)


def scene(item: pytest.Item) -> str:
    """The packaged scene that a test is made for; none where it is not made for one."""
    values = item.callspec.params.values() if hasattr(item, "callspec") else ()
    return next((value for value in values if isinstance(value, str) and value in PACKAGED), "")
