"""What the tests of hand drawings share can be imported beside the benchmarks, once this is."""

import sys
from pathlib import Path

TESTS = Path(__file__).parent.parent
sys.path[:0] = [str(TESTS / folder) for folder in ("marking",)]
