"""What makes the tasks of all kinds that drawings by another hand are of, by their names."""

from __future__ import annotations

from advanced_boards import ADVANCED_MAKERS
from blackboard import SIMPLE_MAKERS, Makers
from mixed_plans import BOTH

MAKERS: Makers = {**SIMPLE_MAKERS, **ADVANCED_MAKERS, **BOTH}
