"""graphplan: the graphical analysis of planar mechanisms, constructed on the drawing board and checked.

>>> import graphplan as gp
>>> scene = gp.load("four-bar")
>>> drawing = gp.construct(scene)
>>> abs(drawing.velocity["B"] - complex(*gp.analytic.solve(scene).velocity["B"])) < 1e-9
True
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphplan import cycle, sheet
    from graphplan import solver as analytic
    from graphplan.check.trusted import construct
    from graphplan.cycle.pose import at
    from graphplan.errors import ConstructionError, Disagreement, GraphplanError, Refused, SceneError, SingularPose
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.scene import load, parse
    from graphplan.methods.construction import Construction

__version__ = "0.1.0"

__all__ = [
    "Construction", "ConstructionError", "Disagreement", "GraphplanError", "Refused", "Scene", "SceneError",
    "SingularPose", "analytic", "at", "construct", "cycle", "load", "parse", "sheet",
]

# The module of every public name, imported when the name is first used: a command loads no more than it needs.
MODULES = {"analytic": "graphplan.solver", "cycle": "graphplan.cycle", "sheet": "graphplan.sheet"}
HOMES = {
    "Construction": "graphplan.methods.construction",
    "ConstructionError": "graphplan.errors",
    "Disagreement": "graphplan.errors",
    "GraphplanError": "graphplan.errors",
    "Refused": "graphplan.errors",
    "Scene": "graphplan.mechanism.model",
    "SceneError": "graphplan.errors",
    "SingularPose": "graphplan.errors",
    "at": "graphplan.cycle.pose",
    "construct": "graphplan.check.trusted",
    "load": "graphplan.mechanism.scene",
    "parse": "graphplan.mechanism.scene",
}


def __getattr__(name: str) -> Any:
    """A public name, from where it stands; the next time it is here."""
    if name in MODULES:
        value = import_module(MODULES[name])
    elif name in HOMES:
        value = getattr(import_module(HOMES[name]), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name == "construct":
        _illustrate()
    globals()[name] = value
    return value


def _illustrate() -> None:
    """Let notebooks show a construction as its sheet: methods know no sheets, the front door knows both."""
    import_module(HOMES["Construction"]).Construction._repr_svg_ = _picture


def _picture(drawing: Construction) -> str:
    """The sheet of a construction, drawn when a notebook asks."""
    from graphplan.sheet import svg

    return svg(drawing)


def __dir__() -> list[str]:
    """What stands here and what will, when it is asked for."""
    return sorted({*globals(), *__all__})
