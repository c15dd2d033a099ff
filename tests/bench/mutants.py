"""Mutants: a line of the package is changed for the worse, and the tests are to see it.

`python tests/bench/mutants.py` tries those of `mutants.toml`, drawn by lot from every room, by the tests that run by
default; with `--all` by all. `--rooms solver cycle` tries some rooms alone, `--numbers 3 17` some mutants, and
`--seconds 60` gives each that much of the processor. Tests are collected once, and a mutant is a fork of
that process in which the code of the changed functions is exchanged: it first runs the tests of its own room, then all
others, until one fails. What runs in a process of its own runs without the change.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import resource
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import CodeType, FunctionType
from typing import NamedTuple

import pytest
from _pytest.runner import runtestprotocol

import graphplan

PACKAGE, TESTS = Path(graphplan.__file__).parent, Path(__file__).parents[1]
FOLDERS = {
    "kernel": ("kernel", "textbook", "methods", "check"), "planner": ("methods", "textbook", "faults"),
    "forces": ("methods", "solver", "faults", "textbook", "machine"),
    "solver": ("solver", "check", "textbook", "worlds"), "cycle": ("cycle", "commands", "machine"),
    "sheet": ("sheet", "accuracy", "output", "marking"),
    "words": ("sheet", "paper", "test_words.py", "output", "commands"), "judge": ("marking", "faults", "bench"),
    "machines": ("machine", "commands", "output"), "cams": ("cams", "worlds", "output"),
    "synthesis": ("synthesis", "output", "commands"), "importing": ("importing", "test_cases.py"),
    "exports": ("output", "test_cases.py", "commands", "synthesis"), "live": ("output", "test_cases.py", "sheet"),
    "scenes": ("mechanism", "commands", "public", "test_cases.py", "faults", "solver", "methods")}
"""Where the tests of a room are, those first that know it best."""


class Mutant(NamedTuple):
    """A line of a file, and what becomes of it."""

    number: int
    file: str
    line: str
    becomes: str
    room: str

    def codes(self) -> dict[CodeType, CodeType]:
        """The compiled functions that it changes, and what they become."""
        path = PACKAGE / self.file
        text = path.read_text(encoding="utf-8")
        lines = [line for line in text.splitlines(keepends=True) if line.strip() == self.line]
        if len(lines) != 1:
            raise LookupError(f"{self.file} has {len(lines)} lines `{self.line}`: the table is out of date")
        changed = text.replace(lines[0], lines[0].replace(self.line, self.becomes))
        return dict(apart(*(compile(one, str(path), "exec", dont_inherit=True) for one in (text, changed))))

    def sown(self) -> None:
        """From here on this process has the change."""
        importlib.import_module(".".join(["graphplan", *Path(self.file).with_suffix("").parts]))
        gc.unfreeze()
        codes, sown = self.codes(), 0
        for function in gc.get_objects():
            if isinstance(function, FunctionType) and function.__code__ in codes:
                function.__code__ = codes[function.__code__]
                sown += 1
        if not sown:
            raise LookupError(f"{self.file}: no function has the line `{self.line}`")


def apart(one: CodeType, two: CodeType) -> Iterator[tuple[CodeType, CodeType]]:
    """What differs of two codes that are built alike, each with what it becomes."""
    if one != two:
        yield one, two
        inner = [[part for part in code.co_consts if isinstance(part, CodeType)] for code in (one, two)]
        for pair in zip(*inner, strict=True):
            yield from apart(*pair)


class Sower:
    """Instead of running the tests: each mutant by its own fork of the process that collected them."""

    def __init__(self, mutants: Sequence[Mutant], seconds: int, jobs: int):
        self.mutants, self.seconds, self.jobs = mutants, seconds, jobs
        self.told = os.fdopen(os.dup(1), "w", buffering=1)  # what tests print is caught

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        gc.collect()
        jobs = []
        for first in range(self.jobs):
            if (child := os.fork()) == 0:
                killed = [self._tried(mutant, session.items) for mutant in self.mutants[first :: self.jobs]]
                os._exit(killed.count(True))
            jobs.append(child)
        killed = sum(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in jobs)
        print(f"killed {killed} of {len(self.mutants)}", file=self.told)
        return True

    def _tried(self, mutant: Mutant, items: Sequence[pytest.Item]) -> bool:
        """Whether a mutant is killed, which is told."""
        begun = used(resource.RUSAGE_CHILDREN)
        killer = self._killer(mutant, items)
        seconds = used(resource.RUSAGE_CHILDREN) - begun
        print(f"{mutant.number:3} {mutant.room:10} {seconds:6.1f} s  {killer or 'ALIVE'}", file=self.told)
        if not killer:
            print(f"      {mutant.file}: {mutant.line}  ->  {mutant.becomes}", file=self.told)
        return bool(killer)

    def _killer(self, mutant: Mutant, items: Sequence[pytest.Item]) -> str:
        """The test that fails by a mutant alone, or nothing: those of its room come first, and first variants."""
        folders, variants = [*FOLDERS[mutant.room], ""], Counter[str]()

        def rank(item: pytest.Item) -> tuple[int, int]:
            variants[function := item.nodeid.partition("[")[0]] += 1
            return folders.index(folder if (folder := folder_of(item)) in folders else ""), variants[function]

        ranked = sorted(items, key=rank)
        while killer := self._failing(ranked, mutant):
            (item,) = [item for item in ranked if item.nodeid == killer] or [None]
            if item is None or not self._failing([item]):
                return killer
            print(f"      fails without any mutant: {killer}", file=self.told)
            ranked.remove(item)
        return ""

    def _failing(self, items: Sequence[pytest.Item], mutant: Mutant | None = None) -> str:
        """The first test that fails in a process of its own, or how that ends."""
        end, begin = os.pipe()
        if (child := os.fork()) == 0:
            try:
                os.close(end)
                resource.setrlimit(resource.RLIMIT_CPU, (2 * self.seconds, 2 * self.seconds))
                if mutant:
                    mutant.sown()
                os.write(begin, self._first(items).encode())
                os._exit(0)
            finally:
                os._exit(1)
        os.close(begin)
        with os.fdopen(end, encoding="utf-8") as told:
            failing = told.read()
        _, status = os.waitpid(child, 0)
        return failing or ("it does not end, or crashes" if status else "")

    def _first(self, items: Sequence[pytest.Item]) -> str:
        """The first of these tests that fails, as far as the time allows."""
        for item, following in zip(items, [*items[1:], None], strict=True):
            if any(report.failed for report in runtestprotocol(item, log=False, nextitem=following)):
                return item.nodeid
            if used(resource.RUSAGE_SELF) + used(resource.RUSAGE_CHILDREN) > self.seconds:
                break
        return ""


def folder_of(item: pytest.Item) -> str:
    """The folder of tests that a test is in."""
    return item.path.relative_to(TESTS).parts[0]


def used(whose: int) -> float:
    """Seconds of the processor."""
    found = resource.getrusage(whose)
    return found.ru_utime + found.ru_stime


def table() -> list[Mutant]:
    """All mutants."""
    with (Path(__file__).parent / "mutants.toml").open("rb") as file:
        return [Mutant(number, **row) for number, row in enumerate(tomllib.load(file)["mutants"], 1)]


def main() -> None:
    """Tries mutants, and tells the fate of each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rooms", nargs="*", help="folders of the package (default: all)")
    parser.add_argument("--numbers", nargs="*", type=int, help="places in the table (default: all)")
    parser.add_argument("--seconds", type=int, default=600, help="of the processor for each (default: %(default)s)")
    parser.add_argument("--tests", nargs="*", default=[str(TESTS)], help="files or folders of tests (default: all)")
    parser.add_argument("--all", action="store_true", help="by the whole suite, not by a sample of it")
    parser.add_argument("--jobs", type=int, default=1, help="mutants at a time (default: %(default)s)")
    asked = parser.parse_args()
    mutants = [one for one in table() if (not asked.rooms or one.room in asked.rooms)
               and (not asked.numbers or one.number in asked.numbers)]
    for mutant in mutants:
        mutant.codes()  # all are still to be had
    pytest.main(["-q", "-p", "no:cacheprovider", *["--all"] * asked.all, *asked.tests],
                plugins=[Sower(mutants, asked.seconds, asked.jobs)])


if __name__ == "__main__":
    main()
