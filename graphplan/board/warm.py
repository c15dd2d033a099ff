"""The answers with all that they need already loaded, as new processes have it: the first drawing is as fast as others.
"""

from __future__ import annotations

from graphplan.board.answers import ANSWERS
from graphplan.mechanism.scene import source_text
from graphplan.threads import prefer_one_thread

__all__ = ["ANSWERS"]

prefer_one_thread()
_SCENE = source_text("four-bar", "four-bar")
ANSWERS["edit"](text=_SCENE, name="scene", operations=[])
ANSWERS["numbers"](text=_SCENE, name="scene")
ANSWERS["sheet"](text=_SCENE, name="scene", language="en")
