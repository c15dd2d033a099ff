"""The table of how hand drawings are judged: `python tests/bench/judging [KIND ...] [--seeds FROM-TO]`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from judging.table import KINDS, head, measure, rows


def run() -> None:
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)}; all without any")
    asked.add_argument("--seeds", default="1-40", help="from-to; a half of them are of faultless drawings")
    asked.add_argument("--keep", type=Path, metavar="FOLDER", help="where what was judged wrongly is kept")
    options = asked.parse_args()
    low, high = map(int, options.seeds.split("-"))
    print("\n".join(head(options.seeds)), flush=True)
    for kind in options.kinds or KINDS:
        keep = options.keep and options.keep / kind.replace(", ", "-").replace(" ", "-")
        print(*rows({kind: measure(kind, range(low, high), keep)}), flush=True)


run()
