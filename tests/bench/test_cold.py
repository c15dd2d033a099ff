"""Cold commands beside `import numpy`, in processor time, so that what else the machine does counts little.

More of them with TESTS=thorough.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from cold import COMMAND, IMPORT
from run import ONE_THREAD
from tiers import sample

NOISE = 1.5  # times the ratio that was measured, up to which a run may come
ROUNDS = 3
RATIOS: dict[str, float] = {  # as measured, of processor time
    "--help": 1.8, "solve four-bar": 1.8, "solve alt-eight-link": 2.0, "steps alt-eight-link": 4.6,
    "steps walschaerts-loaded": 18, "draw alt-eight-link -o {folder}/sheet.svg": 6.0,
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
@pytest.mark.parametrize("command", sample(["--help", "solve four-bar"], [*RATIOS]))
def test_cold_commands_take_no_longer_than_measured(command: str, tmp_path: Path) -> None:
    """Each takes at most so many times as long as `import numpy`, and half as much again for noise."""
    words = command.format(folder=tmp_path).split()
    rounds = [(processor_time(COMMAND, *words), processor_time(IMPORT)) for _ in range(ROUNDS)]
    assert min(ours for ours, _ in rounds) <= NOISE * RATIOS[command] * min(rival for _, rival in rounds)
