"""The kernel: what can be drawn, and every reading of a drawing as numbers. It knows no mechanics and no paper."""

from graphplan.kernel import curvature, elementary, images, moments, positions
from graphplan.kernel.kinds import CIRCLE, FAILURES, LINE, OPENING, POINT, TABLE, Primitive
from graphplan.kernel.program import Board, Mark, Program, Step

__all__ = ["CIRCLE", "FAILURES", "LINE", "OPENING", "POINT", "TABLE", "Board", "Mark", "Primitive", "Program", "Step",
           "curvature", "elementary", "images", "moments", "positions"]
