"""Cold commands: whole processes, from the shell's word to the end, against importing numpy alone."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Any

from harness import Row, Target, alternate, compared

ROUNDS = 9
ROOT = Path(__file__).parents[2]
IMPORT = "import numpy"
COMMANDS: dict[str, tuple[Any, ...]] = {  # how many times `import numpy` they may take, and their words
    "help": (1.5, "--help"),
    "solve, four-bar": (2.2, "solve", "four-bar"),
    "solve": (2.2, "solve", "alt-eight-link"),
    "steps, gears": (6, "steps", "gear-linkage"),
    "draw": (4.5, "draw", "alt-eight-link", "-o", "{folder}/sheet.svg"),
    "draw, PDF": (7, "draw", "alt-eight-link", "-o", "{folder}/sheet.pdf"),
    "live, four-bar": (8, "live", "four-bar", "-o", "{folder}/page.html"),
    "handout, PDF": (10, "handout", "alt-eight-link", "-o", "{folder}/handout.pdf"),
    "handout, HTML": (15, "handout", "alt-eight-link", "-o", "{folder}/handout.html"),
    "cost, four-bar": (10, "cost", "four-bar"),
    "flywheel": (6, "flywheel", "ozols-13-6", "-o", "{folder}/flywheel.svg"),
}
COMMAND, IMPORT_NUMPY = ("-m", "graphplan"), ("-c", IMPORT)


def rows() -> list[Row]:
    """The commands of a teacher's day: the eight-link chain's, where no other scene is named."""
    with tempfile.TemporaryDirectory() as folder:
        commands = {name: partial(python, *COMMAND, *(word.format(folder=folder) for word in words))
                    for name, (_, *words) in COMMANDS.items()}
        times = alternate({**commands, IMPORT: lambda: python(*IMPORT_NUMPY)}, ROUNDS)
    return [compared(f"graphplan {name}", IMPORT, Target("at most", most), times, ours=name)
            for name, (most, *_) in COMMANDS.items()]


def python(*arguments: str) -> None:
    """One process of this Python, which may keep and use compiled modules."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    subprocess.run([sys.executable, *arguments], cwd=ROOT, env=kept, stdout=subprocess.DEVNULL, check=True)
