"""graphplan: the graphical analysis of planar mechanisms, constructed on the drawing board and checked.

>>> import graphplan as gp
>>> scene = gp.load("four-bar")
>>> drawing = gp.construct(scene)
>>> abs(drawing.velocity["B"] - complex(*gp.analytic.solve(scene).velocity["B"])) < 1e-9
True
"""

from __future__ import annotations

from graphplan import sheet
from graphplan import solver as analytic
from graphplan.errors import ConstructionError, GraphplanError, Refused, SceneError, SingularPose
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load, parse
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction

__version__ = "0.1.0"

__all__ = [
    "Construction", "ConstructionError", "GraphplanError", "Refused", "Scene", "SceneError", "SingularPose",
    "analytic", "construct", "load", "parse", "sheet",
]
