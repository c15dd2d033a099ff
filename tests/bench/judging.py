"""How well hand drawings are judged: `python tests/bench/judging.py [-n 60] [--seed 9000] [KIND ...]`.

Printed are, for every kind, the shares of so many right drawings and as many with a mistake. The drawings of the tests
and of tuning have seeds below 9000.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

for folder in ("shared", "marking"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))

from judged_drawings import KINDS  # noqa: E402


def main() -> None:
    """Draw, judge and print."""
    parser = argparse.ArgumentParser(description="Judge generated hand drawings.")
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)}; default all")
    parser.add_argument("-n", type=int, default=60, help="how many drawings of each kind, right and wrong")
    parser.add_argument("--seed", type=int, default=9000, help="where the seeds begin")
    asked = parser.parse_args()
    with TemporaryDirectory() as folder:
        for kind in asked.kinds or KINDS:
            shares = KINDS[kind].shares(asked.n, asked.seed, Path(folder))
            print(f"{kind}: " + ", ".join(f"{name} {100 * share:.0f} %" for name, share in shares.items()), flush=True)


if __name__ == "__main__":
    main()
