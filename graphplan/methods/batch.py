"""One program over many poses: the recorded steps replayed on arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.evaluate import error_at
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.program import Step
from graphplan.methods.network import Network

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction


@dataclass(frozen=True)
class Poses:
    """Results over n poses: complex arrays of shape (n,) in scene units by point; links' rates as real arrays.

    Where a pose is singular its results are nan, and `faults` says why, by the pose's place.
    """

    velocity: dict[str, Any]
    acceleration: dict[str, Any]
    omega: dict[str, Any]
    alpha: dict[str, Any]
    faults: dict[int, str]


def batch(construction: Construction, points: Mapping[str, Any]) -> Poses:
    """The construction replayed over the poses in `points`."""
    n, given = _coordinates(construction, points)
    domain, program = Arrays(), construction.program
    faults: dict[int, str] = {}

    def note(step: Step) -> None:
        for code, why, bad in domain.faults:
            for pose in np.flatnonzero(np.broadcast_to(bad, (n,))):
                faults.setdefault(int(pose), str(error_at(program, step, Undrawable(code, why))))
        domain.faults.clear()

    with np.errstate(all="ignore"):
        results = construction.read(domain, given, note)
    pairs = {kind: {name: _complex(pair, n) for name, pair in results.get(kind, {}).items()}
             for kind in ("velocity", "acceleration")}
    rates = {kind: {name: np.broadcast_to(value, (n,)).copy() for name, value in results.get(kind, {}).items()}
             for kind in ("omega", "alpha")}
    return Poses(**pairs, **rates, faults=dict(sorted(faults.items())))


def _coordinates(construction: Construction, points: Mapping[str, Any]) -> tuple[int, dict[str, dict[str, Any]]]:
    """The number of poses, and the given points as pairs of real arrays."""
    arrays = {name: np.atleast_1d(np.asarray(z, dtype=complex)) for name, z in points.items()}
    for name in arrays:
        if name not in construction.scene.points:
            known = ", ".join(construction.scene.points)
            raise Refused(f"point {name}", "the scene has no such point", f"one of {known}")
    shapes = {array.shape for array in arrays.values()} or {(1,)}
    if len(shapes) > 1 or len(next(iter(shapes))) != 1:
        raise Refused("poses", f"the arrays have the shapes {sorted(shapes)}", "one array of shape (n,) a point")
    for (at, _), name in Network(construction.scene).coincident.items():  # one mark serves both
        if name in arrays and not np.array_equal(arrays.setdefault(at, arrays[name]), arrays[name]):
            why = "they coincide in the scene and differ here"
            raise Refused(f"points {at} and {name}", why, "the same array for both")
    return next(iter(shapes))[0], {name: {"x": z.real, "y": z.imag} for name, z in arrays.items()}


def _complex(pair: Any, n: int) -> Any:
    return np.broadcast_to(pair[0] + 1j * pair[1], (n,)).copy()
