"""Claims about numbers: those of the construction, beside those of the solver."""

from __future__ import annotations

from claim import claim
from face import Got

import graphplan as gp


@claim(cheap=True)
def what_is_asked_is_answered(got: Got) -> None:
    """Each point and link that is asked for has its value."""
    for kind in ("velocity", "acceleration"):
        assert all(got.solved["points"][name][kind] is not None for name in getattr(got.scene.find, kind) or ())
    assert all(got.solved["links"][name]["omega"] is not None for name in got.scene.find.omega)


@claim()
def the_construction_agrees_with_the_solver(got: Got) -> None:
    """Every velocity and acceleration that is drawn is that of the solver, to rounding."""
    solved = gp.solve(got.scene)
    for kind in ("velocity", "acceleration"):
        drawn, right = getattr(got.drawing, kind), getattr(solved, kind)
        size = max(map(abs, right.values()), default=0)
        assert all(abs(drawn[name] - right[name]) <= 1e-9 * size for name in drawn)
