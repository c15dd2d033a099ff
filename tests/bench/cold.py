"""Cold commands: whole processes, from the shell's word to the end, against importing numpy alone."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from harness import Row, Target, alternate, compared

ROUNDS = 15
ROOT = Path(__file__).parents[2]
IMPORT = "import numpy"
COMMAND = "import sys; from graphplan.commands import main; sys.exit(main())"  # what the installed script says


def rows() -> list[Row]:
    """`graphplan solve` and `graphplan draw` of the eight-link chain."""
    with tempfile.TemporaryDirectory() as folder:
        times = alternate({
            "ours": lambda: python(COMMAND, "solve", "alt-eight-link"),
            "draw": lambda: python(COMMAND, "draw", "alt-eight-link", "-o", f"{folder}/sheet.svg"),
            IMPORT: lambda: python(IMPORT),
        }, ROUNDS)
    return [compared("graphplan solve", IMPORT, Target("at most", 2), times),
            compared("graphplan draw", IMPORT, Target("at most", 4.5), times, ours="draw")]


def python(code: str, *arguments: str) -> None:
    """One process of this Python, which may keep and use compiled modules."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    subprocess.run([sys.executable, "-c", code, *arguments], cwd=ROOT, env=kept, stdout=subprocess.DEVNULL, check=True)
