"""Work that is kept: done once, many at a time, and what fails takes nothing else with it."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from graphplan.errors import Refused
from graphplan.marking.classroom.grading import FAULT_KEY, Keeper, run_jobs

CALLS = list[str]()


def work(job: str) -> dict[str, str]:
    """What comes of a job; some go wrong."""
    CALLS.append(job)
    if job == "refused":
        raise Refused("it", "is refused", "another")
    if job == "broken":
        raise ZeroDivisionError
    if job == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if job == "interrupted":
        raise KeyboardInterrupt
    return {"done": job}


def made(folder: Path, *jobs: str, processes: int = 1) -> dict[str, object]:
    """What comes of jobs, by their names."""
    return dict(run_jobs(work, {job: job for job in jobs}, Keeper(folder / "kept"), processes))


def test_only_what_is_new_is_done(tmp_path: Path) -> None:
    """What was done is kept and not done again; what failed is told, tried again, and stops nothing."""
    first = made(tmp_path, "a", "refused", "broken")
    assert first == {"a": {"done": "a"}, "refused": {FAULT_KEY: "it: is refused; another"},
                     "broken": {FAULT_KEY: "ZeroDivisionError: "}}
    CALLS.clear()
    assert made(tmp_path, "a", "b", "broken")["a"] == {"done": "a"}
    assert CALLS == ["b", "broken"]
    (tmp_path / "kept" / "a.json").write_text("{")  # it broke since
    CALLS.clear()
    assert made(tmp_path, "a") == {"a": {"done": "a"}}
    assert CALLS == ["a"]


def test_what_is_done_before_an_interruption_is_kept(tmp_path: Path) -> None:
    """Who interrupts loses nothing that was done."""
    with pytest.raises(KeyboardInterrupt):
        made(tmp_path, "a", "interrupted", "b")
    CALLS.clear()
    assert made(tmp_path, "a", "b") == {"a": {"done": "a"}, "b": {"done": "b"}}
    assert CALLS == ["b"]


def test_a_process_that_dies_takes_nothing_with_it(tmp_path: Path) -> None:
    """Of many at once, one that kills its process fails alone; all others are done."""
    found = made(tmp_path, "a", "killed", "b", "c", processes=2)
    assert found == {**{job: {"done": job} for job in "abc"},
                     "killed": {FAULT_KEY: "the process that worked on it died"}}
