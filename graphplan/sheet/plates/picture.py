"""One plan in its window: the mechanism if it is its plan, the strokes, and the letters that avoid both."""

from __future__ import annotations

from graphplan.methods.panels import MECHANISM
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import placed
from graphplan.sheet.lettering.letters import Letters
from graphplan.sheet.plates.display import Item
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.plates.symbols import RADIUS


def picture(plate: Plate) -> list[Item]:
    """The items of a plan, in no order but that of drawing."""
    items, wishes = [*plate.items(), *plate.mechanism], list(Letters(plate).wishes())
    marks = [drawn.at for drawn in plate.steps if plate.shown(drawn)]
    if plate.panel == MECHANISM:
        mechanism = DrawnMechanism(plate.plates.scene, plate.view)
        letters = mechanism.letters().items()
        joints = [Wish(runs, (spot,), RADIUS + 0.3, label=label) for spot, (runs, label) in letters]
        wishes = [*joints, *mechanism.wishes(), *wishes]
        marks += list(mechanism.spots.values())
    return items + placed(wishes, items, marks, plate.view.rect)
