"""One plan in its window: the mechanism if it is its plan, the strokes, and the letters that avoid both."""

from __future__ import annotations

from graphplan.methods.panels import MECHANISM
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import placed
from graphplan.sheet.lettering.letters import Letters
from graphplan.sheet.plates import clip
from graphplan.sheet.plates.display import Item, Spot
from graphplan.sheet.plates.linkage import Linkage
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.strokes import Strokes
from graphplan.sheet.plates.symbols import RADIUS
from graphplan.sheet.plates.view import View


def picture(plans: Plans, panel: str, window: View) -> list[Item]:
    """The items of a plan, in no order but that of drawing."""
    strokes = Strokes(plans, panel, window)
    items, wishes = list(strokes.items()), list(Letters(strokes).wishes())
    marks: list[Spot] = [spot for i, spot in strokes.spots.items() if strokes.shown(i)]
    if panel == MECHANISM:
        linkage = Linkage(plans.drawing.scene, window)
        items += [cut for item in linkage.items() for cut in clip.clipped(item, window.rect)]
        letters = [Wish(runs, (spot,), RADIUS + 0.3, label=label) for spot, (runs, label) in linkage.letters().items()]
        wishes = [*letters, *linkage.wishes(), *wishes]
        marks += list(linkage.spots.values())
    return items + placed(wishes, items, marks, window.rect)
