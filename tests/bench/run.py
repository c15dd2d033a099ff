"""Measures every figure and prints one table: `python tests/bench/run.py [-o FILE.md] [FIGURE ...]`."""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
from datetime import date
from importlib import import_module
from pathlib import Path

from graphplan.threads import THREAD_COUNT_VARIABLES

FIGURES = ("arrays", "one_pose", "follow", "cycle_kimech", "cycle_pylinkage", "cold", "growth")
RIVALS = ("arrays", "cycle_kimech", "cycle_pylinkage")  # which measure other programs' motions

# One core for all, and before numpy is imported: its BLAS reads this once.
ONE_THREAD = dict.fromkeys((*THREAD_COUNT_VARIABLES, "NUMBA_NUM_THREADS"), "1")
ONE_THREAD["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"


def main() -> None:
    """Measure the figures asked for, or all."""
    parser = argparse.ArgumentParser(description="Measure graphplan against its rivals.")
    parser.add_argument("figures", nargs="*", metavar="FIGURE", help=f"of {', '.join(FIGURES)}; default all")
    parser.add_argument("--rivals", type=Path, metavar="FILE.csv",
                        help="write other programs as rows for graphplan chart machine --beside here")
    parser.add_argument("-o", dest="file", type=Path, help="write the table here too")
    asked = parser.parse_args()
    if unknown := set(asked.figures) - set(FIGURES):
        parser.error(f"no figure {', '.join(sorted(unknown))}; one of {', '.join(FIGURES)}")
    os.environ |= ONE_THREAD
    text = measured(asked.figures or FIGURES)
    print(text, end="")
    if asked.file:
        asked.file.write_text(text)
    if asked.rivals:
        asked.rivals.write_text(rivals())


def rivals() -> str:
    """The other programs as rows of the chart of the machine, as they were measured."""
    from harness import rivals as told

    return told(row for figure in RIVALS for row in import_module(figure).measures())


def measured(figures: tuple[str, ...]) -> str:
    """The table of these figures, under what they were measured with."""
    from harness import table

    rows = []
    for figure in figures:
        print(f"measuring {figure} ...", file=sys.stderr)
        rows += import_module(figure).rows()
    return (f"{stamp()}; {platform.python_implementation()} {platform.python_version()}, {versions()}\n\n"
            f"{table(rows)}")


def stamp() -> str:
    """Of which commit the figures are, with changes that it has not, and of which day."""
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=Path(__file__).parent, capture_output=True,
                            text=True, check=False).stdout.strip()
    return f"{date.today()}, commit {commit or 'unknown'}"


def versions() -> str:
    """The packages that take part, and their versions."""
    from importlib.metadata import PackageNotFoundError, version

    found = []
    for package in ("numpy", "numba", "casadi", "jax", "kimech", "pylinkage"):
        try:
            found.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            found.append(f"{package} not installed")
    return ", ".join(found)


if __name__ == "__main__":
    main()
