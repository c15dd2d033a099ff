"""A command sums arrays in one thread, if the user has not said in how many."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from graphplan.threads import THREAD_COUNT_VARIABLES

COMMAND = f"""
import os, sys
from graphplan.commands import main
early = "numpy" in sys.modules
main()
print(early, "numpy" in sys.modules, *map(os.environ.get, {THREAD_COUNT_VARIABLES}), file=sys.stderr)
"""


@pytest.mark.parametrize(("by_user", "then"), [({}, "1 1 1"), ({"OMP_NUM_THREADS": "3"}, "None 3 None")])
def test_a_command_takes_one_thread_unless_told(by_user: dict[str, str], then: str) -> None:
    """The number is in the environment before a command loads numpy, which reads it then; the user's own stands."""
    environment = {name: value for name, value in os.environ.items() if name not in THREAD_COUNT_VARIABLES} | by_user
    done = subprocess.run([sys.executable, "-c", COMMAND, "solve", "jaanimets-10"], capture_output=True, text=True,
                          check=True, env=environment)
    assert done.stderr == f"False True {then}\n"
