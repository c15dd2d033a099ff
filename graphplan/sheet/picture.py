"""One plan in its window: the mechanism if it is its plan, the strokes, and the letters that avoid both."""

from __future__ import annotations

from graphplan.methods.panels import MECHANISM
from graphplan.sheet import clip
from graphplan.sheet.display import Item, Spot
from graphplan.sheet.labels import placed
from graphplan.sheet.letters import Letters
from graphplan.sheet.linkage import Linkage
from graphplan.sheet.places import Wish
from graphplan.sheet.planes import Planes
from graphplan.sheet.strokes import Strokes
from graphplan.sheet.symbols import RADIUS
from graphplan.sheet.view import View


def picture(planes: Planes, panel: str, window: View) -> list[Item]:
    """The items of a plan, in no order but that of drawing."""
    strokes = Strokes(planes, panel, window)
    items, wishes = list(strokes.items()), list(Letters(strokes).wishes())
    marks: list[Spot] = [spot for i, spot in strokes.spots.items() if strokes.shown(i)]
    if panel == MECHANISM:
        linkage = Linkage(planes.drawing.scene, window)
        items += [cut for item in linkage.items() for cut in clip.clipped(item, window.rect)]
        letters = [Wish(runs, (spot,), RADIUS + 0.3, label=label) for spot, (runs, label) in linkage.letters().items()]
        wishes = [*letters, *linkage.wishes(), *wishes]
        marks += list(linkage.spots.values())
    return items + placed(wishes, items, marks, window.rect)
