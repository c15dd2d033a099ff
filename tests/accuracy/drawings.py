"""The packaged scenes as they are drawn, and a pencil for them."""

from __future__ import annotations

from functools import cache

import graphplan as gp
from graphplan.accuracy.drafted import Drafted, draft
from graphplan.design.hand import Pencil
from graphplan.mechanism.scene import packaged_names
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.scales import Scales

SCENES = packaged_names()


@cache
def drawing_of(name: str) -> Construction:
    return gp.construct(gp.load(name))


@cache
def drafted_of(name: str) -> Drafted:
    return draft(drawing_of(name), Pencil())


def scales_of(drawing: Construction, size: float = 200.0) -> Scales:
    """The scales at which the mechanism is so many mm large, and all its plans are as large as they come."""
    units = drawing.scene.units
    return Scales(drawing.scene.extent / size, drawing.kappa, units.length, {}, float(drawing.phi), units.force)
