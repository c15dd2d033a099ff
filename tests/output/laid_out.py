"""Figures of packaged scenes whose plans simply stand side by side: no sheet is composed for them."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import graphplan as gp
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.symbols import reach
from graphplan.sheet.plates.view import view

SIDE = 150.0  # mm of paper for each plan


@lru_cache(maxsize=64)
def laid_out(name: str, strict: bool = False, times: float = 1.0) -> tuple[Construction, Plates]:
    """A packaged scene constructed, and as it is drawn; its plans are so many `times` too large for their windows."""
    drawing = gp.construct(gp.load(name), strict=strict)
    plans = Plans(drawing)
    wheels = {MECHANISM: [*reach(drawing.scene)]}
    boxes = {panel: bounding_box([*wheels.get(panel, ()), *(plans.spot(index) for index in plans.points(panel))])
             for panel in plans.panels}
    views: dict[str, Any] = {}
    for place, (panel, box) in enumerate(boxes.items()):
        rect = Rect(SIDE * place + 5, 5, SIDE * (place + 1) - 5, SIDE - 5)
        views[panel] = view(box, rect, (max(box.width, box.height) / (SIDE - 20) or 1.0) / times)
    return drawing, Plates(plans, views)
