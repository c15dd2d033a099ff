"""The random mechanisms are those on which the constructions are tested."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "methods"))
