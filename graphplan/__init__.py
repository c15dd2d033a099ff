"""graphplan: the graphical analysis of planar mechanisms, constructed on the drawing board and checked.

>>> import graphplan as gp
>>> scene = gp.load("four-bar")
>>> drawing = gp.construct(scene)
>>> abs(drawing.velocity["B"] - gp.solve(scene).velocity["B"]) < 1e-9
True
"""

from __future__ import annotations

from importlib import import_module

__version__ = "1.0.0"

MODULES = {"analytic": "graphplan.app.analytic", "cycle": "graphplan.cycle", "sheet": "graphplan.sheet"}
NAMES = {  # of the core, by their modules; a name is imported when it is first used, as a command loads what it needs
    "graphplan.check.stream": "Summary",
    "graphplan.cycle.pose": "at",
    "graphplan.errors": "ConstructionError Disagreement GraphplanError NoMechanism Refused SceneError SingularPose",
    "graphplan.mechanism.model": "Scene",
    "graphplan.mechanism.written_scene": "WrittenScene load parse scene",
    "graphplan.methods.construction": "Construction",
    "graphplan.app.construction": "MotionSeries MotionStream PoseSeries WorkingDrawing construct follow",
    "graphplan.app.pages": "handout",
    "graphplan.app.report": "report",
    "graphplan.app.results": "Results solve",
    "graphplan.app.subjects": "Subject",
}
HOMES = {name: module for module, names in NAMES.items() for name in names.split()}


def __getattr__(name: str) -> object:
    """A public name, from where it stands; the next time it is here."""
    if name in MODULES:
        value: object = import_module(MODULES[name])
    elif name == "__all__":
        value = sorted({*MODULES, *HOMES, *_homes_in_leaves()}, key=lambda name: (name.islower(), name))
    elif home := HOMES.get(name) or (not name.startswith("_") and _homes_in_leaves().get(name)):
        value = getattr(import_module(home), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def _homes_in_leaves() -> dict[str, str]:
    """The modules of the public names that leaves add."""
    from graphplan.leaves import leaves

    modules = {module: names for leaf in leaves().values() for module, names in leaf.names.items()}
    return {name: module for module, names in modules.items() for name in names.split()}


def __dir__() -> list[str]:
    """What stands here and what will, when it is asked for."""
    return sorted({*globals(), *__getattr__("__all__")})
