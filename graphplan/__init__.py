"""graphplan: the graphical analysis of planar mechanisms, constructed on the drawing board and checked.

>>> import graphplan as gp
>>> scene = gp.load("four-bar")
>>> drawing = gp.construct(scene)
>>> abs(drawing.velocity["B"] - gp.solve(scene).velocity["B"]) < 1e-9
True
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from graphplan import cycle, sheet
    from graphplan.check.stream import Summary
    from graphplan.cycle.pose import at
    from graphplan.errors import (
        ConstructionError,
        Disagreement,
        GraphplanError,
        NoMechanism,
        Refused,
        SceneError,
        SingularPose,
    )
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.written_scene import WrittenScene, load, parse, scene
    from graphplan.methods.construction import Construction
    from graphplan.public import analytic
    from graphplan.public.construction import MotionSeries, MotionStream, PoseSeries, WorkingDrawing, construct, follow
    from graphplan.public.machine import balance, flywheel, motion
    from graphplan.public.pages import handout, live
    from graphplan.public.results import Results, solve
    from graphplan.public.subjects import Subject, cam, position_errors
    from graphplan.public.synthesis import SynthesisResults, synthesize
    from graphplan.public.variants import variants
    from graphplan.public.verifying import Findings, verify

__version__ = "1.0.0"

# The module of every public name, imported when the name is first used: a command loads no more than it needs.
MODULES = {"analytic": "graphplan.public.analytic", "cycle": "graphplan.cycle", "sheet": "graphplan.sheet"}
NAMES = {
    "graphplan.check.stream": "Summary",
    "graphplan.cycle.pose": "at",
    "graphplan.errors": "ConstructionError Disagreement GraphplanError NoMechanism Refused SceneError SingularPose",
    "graphplan.mechanism.model": "Scene",
    "graphplan.mechanism.written_scene": "WrittenScene load parse scene",
    "graphplan.methods.construction": "Construction",
    "graphplan.public.construction": "MotionSeries MotionStream PoseSeries WorkingDrawing construct follow",
    "graphplan.public.machine": "balance flywheel motion",
    "graphplan.public.pages": "handout live",
    "graphplan.public.results": "Results solve",
    "graphplan.public.subjects": "Subject cam position_errors",
    "graphplan.public.synthesis": "SynthesisResults synthesize",
    "graphplan.public.variants": "variants",
    "graphplan.public.verifying": "Findings verify",
}
HOMES = {name: module for module, names in NAMES.items() for name in names.split()}

__all__ = [
    "Construction", "ConstructionError", "Disagreement", "Findings", "GraphplanError", "MotionSeries", "MotionStream",
    "NoMechanism", "PoseSeries", "Refused", "Results", "Scene", "SceneError", "SingularPose", "Subject", "Summary",
    "SynthesisResults", "WorkingDrawing", "WrittenScene",
    "analytic", "at", "balance", "cam", "construct", "cycle", "flywheel", "follow", "handout", "live", "load", "motion",
    "parse", "position_errors", "scene", "sheet", "solve", "synthesize", "variants", "verify",
]


if not TYPE_CHECKING:  # who checks types knows the names above alone

    def __getattr__(name: str) -> object:
        """A public name, from where it stands; the next time it is here."""
        if name in MODULES:
            value = import_module(MODULES[name])
        elif name in HOMES:
            value = getattr(import_module(HOMES[name]), name)
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    """What stands here and what will, when it is asked for."""
    return sorted({*globals(), *__all__})
