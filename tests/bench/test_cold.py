"""Cold commands beside `import numpy`, in processor time, so that what else the machine does counts little."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from cold import COMMAND, COMMANDS, IMPORT
from run import ONE_THREAD

NOISE = 1.5  # times the ratio that was measured, up to which a run may come
ROUNDS = 3  # of which the best counts
RATIOS = {  # as measured, of processor time
    "help": 1.1, "solve, four-bar": 1.7, "solve": 2.1, "steps, gears": 5.1, "draw": 6.3, "draw, PDF": 7.2,
    "live, four-bar": 8.0, "handout, PDF": 8.3, "handout, HTML": 18.0, "cost, four-bar": 9.8, "flywheel": 7.5,
}


def processor_time(code: str, *words: str) -> float:
    """The seconds of processor that one process of this Python takes."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"} | ONE_THREAD
    process = subprocess.Popen([sys.executable, "-c", code, *words], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, env=kept)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return usage.ru_utime + usage.ru_stime


@pytest.mark.skipif(not hasattr(os, "wait4"), reason="the system tells no child's processor time")
@pytest.mark.parametrize("name", COMMANDS)
def test_cold_commands_take_no_longer_than_measured(name: str, tmp_path: Path) -> None:
    """Each takes at most so many times as long as `import numpy`, and half as much again for noise."""
    words = [word.format(folder=tmp_path) for word in COMMANDS[name][1:]]
    ours, rival, most = float("inf"), float("inf"), NOISE * RATIOS[name]
    for _ in range(ROUNDS):
        ours, rival = min(ours, processor_time(COMMAND, *words)), min(rival, processor_time(IMPORT))
        if ours <= most * rival:
            return
    assert ours <= most * rival
