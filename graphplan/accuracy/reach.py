"""Constructions that hold over the reach of drags: a form that suits its pose may vanish in the next one.

The linkage is led around its cycle, and its pins are dragged a little; in all poses at once the drawn steps are
compared with what the rules say. Where they fail, the same program is drawn out in forms for such a pose; a short list
then serves wherever the rules do. A compound whose form fails somewhere is told of, too: an export may have its mark by
the rule itself, which holds everywhere.

Cost, beside construct: a replay of the drawn steps over some sixty poses (milliseconds), the tape of the linkage (0.02
to 0.5 s) and for each further construction its drawing out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from random import Random
from typing import Any, NamedTuple

import numpy as np

from graphplan.accuracy.tolerances import MIN_SIZE
from graphplan.cycle.relations import Relations, relations
from graphplan.design.decide import construct
from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.numbers import Floats
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.passes import Compound
from graphplan.kernel.program import Program, evaluate
from graphplan.mechanism.travel import paces
from graphplan.methods.construction import Construction
from graphplan.sheet.cycle_frames import inputs_in_pose, scene_in
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.view import View
from graphplan.sheet.tolerances import MARK_TOL

POSES_AROUND, DRAGS_PER_PIN = 48, 4
DRAG_REACH = 0.03  # of the linkage's extent
MAX_CONSTRUCTIONS = 12  # constructions that are drawn out at most
UNIT_VIEW = View(Rect(0.0, 0.0, 1.0, 1.0), 1.0, (0.0, 0.0))
Array = Any


class ReachablePoses(NamedTuple):
    """Poses to which drags lead, the given one first: points and guides, complex arrays of shape (n,)."""

    points: Mapping[str, Array]
    guides: Mapping[str, Array]

    def __len__(self) -> int:
        return len(next(iter(self.points.values())))

    def pose(self, k: int) -> tuple[dict[str, complex], dict[str, complex]]:
        """Points and guides of pose k, by name."""
        return ({name: complex(z[k]) for name, z in self.points.items()},
                {name: complex(z[k]) for name, z in self.guides.items()})


def reachable_poses(drawing: Construction) -> ReachablePoses | None:
    """Poses around the cycle and with pins dragged a little; None if the scene cannot be followed."""
    try:
        linkage = relations(drawing.scene, UNIT_VIEW)
        drags = (linkage.pose(pins, travels) for pins, travels in _drags(linkage)) if linkage else ()
        poses = [pose for pose in drags if pose is not None]
    except Refused:
        return None
    if not poses:
        return None
    points, guides = ({name: np.array([complex(*pose[kind][name]) for pose in poses]) for name in poses[0][kind]}
                      for kind in (0, 1))
    return ReachablePoses(points, guides)


def _drags(found: Relations) -> list[tuple[dict[str, tuple[float, float]], list[float]]]:
    """Places of dragged pins and travels of drives."""
    scene, rng = found.scene, Random(1)
    rates = paces(scene) if scene.drives else ()
    low, high = found.limits if scene.drives else (0.0, 0.0)
    fraction: Array = (1 - np.cos(np.linspace(0.0, np.pi, POSES_AROUND))) / 2 if scene.drives else []
    drags: list[tuple[dict[str, tuple[float, float]], list[float]]] = [({}, [0.0] * len(rates))]
    drags += [({}, [rate * (low + (high - low) * p) for rate in rates]) for p in fraction]
    for name in found.free * DRAGS_PER_PIN:
        x, y = found.places[name].real, found.places[name].imag
        dx, dy = (DRAG_REACH * scene.extent * rng.uniform(-1, 1) for _ in range(2))
        drags.append(({name: (x + dx, y + dy)}, [rate * rng.uniform(low, high) for rate in rates]))
    return drags


def constructions(drawing: Construction, most: int = MAX_CONSTRUCTIONS,
                  poses: ReachablePoses | None = None) -> list[Construction]:
    """The given construction, then others, at `most` so many in all, that draw what it cannot in poses that the linkage
    reaches; these are found where they are not given.

    Each other one is drawn in such a pose: its scene is the scene there.
    """
    poses = poses or reachable_poses(drawing)
    if poses is None:
        return [drawing]
    drawings, served = [drawing], [poses_drawn_right(drawing, poses)]
    open = ~served[0] & _regular_poses(drawing, poses)
    while open.any() and len(drawings) < most:
        places = np.flatnonzero(open)
        k = int(places[len(places) // 2])
        open[k] = False
        candidate = _construction_for_pose(drawing, *poses.pose(k))
        if candidate is not None and (holds := poses_drawn_right(candidate, poses))[k]:
            drawings.append(candidate)
            served.append(holds)
            open &= ~holds
    return _fewest(drawings, served)


def _fewest(found: list[Construction], held: list[Array]) -> list[Construction]:
    """Without those whose poses others draw as well; the first one stays."""
    needed = list(range(len(found)))
    for k in range(1, len(found)):
        rest_of_them = [held[i] for i in needed if i != k]
        if not (held[k] & ~np.any(rest_of_them, axis=0)).any():
            needed.remove(k)
    return [found[k] for k in needed]


def _regular_poses(drawing: Construction, poses: ReachablePoses) -> Array:
    """The poses in which the rules give every point that is wanted, shape (n,)."""
    points = _wanted_points(drawing.program, poses, drawing.program.wanted)
    return np.all([np.isfinite(x) & np.isfinite(y) for x, y in points], axis=0) if points else np.ones(len(poses), bool)


def poses_drawn_right(drawing: Construction, poses: ReachablePoses) -> Array:
    """The poses in which the drawn steps give the points that the rules do, shape (n,)."""
    with np.errstate(all="ignore"):
        return _poses_with_true_marks(drawing, poses, evaluate(drawing.drawn, Arrays(), _inputs(drawing.drawn, poses)))


def _poses_with_true_marks(drawing: Construction, poses: ReachablePoses, values: list[Any]) -> Array:
    """Whether the drawn steps give true marks in each pose, by their values."""
    movements, program, full = drawing.drawn, drawing.program, np.zeros(len(poses))
    pairs = [(i, j) for i, j in zip(movements.wanted, program.wanted, strict=True)
             if movements.steps[i].op.gives == POINT]
    if not pairs:
        return np.ones(len(poses), dtype=bool)
    ours = [(values[i][0] + full, values[i][1] + full) for i, _ in pairs]
    truth = _wanted_points(program, poses, [j for _, j in pairs])
    scale = np.max([np.hypot(x, y) for x, y in truth], axis=0)
    gaps = [np.hypot(x - u, y - v) for (x, y), (u, v) in zip(ours, truth, strict=True)]
    return np.max(gaps, axis=0) <= MARK_TOL * scale  # nan is not


def _wanted_points(program: Program, poses: ReachablePoses, places: Any) -> list[tuple[Array, Array]]:
    """Coordinates of the steps at `places` that make points, in all poses: pairs of arrays of shape (n,)."""
    with np.errstate(all="ignore"):
        values = evaluate(program, Arrays(), _inputs(program, poses))
    full = np.zeros(len(poses))
    return [(values[i][0] + full, values[i][1] + full) for i in places if program.steps[i].op.gives == POINT]


def _inputs(program: Program, poses: ReachablePoses) -> dict[Any, dict[str, Any]]:
    return inputs_in_pose(program, poses.points, poses.guides)


def _construction_for_pose(drawing: Construction, points: dict[str, complex],
                           guides: dict[str, complex]) -> Construction | None:
    """Draw the program out for a pose; if that fails, plan anew for the pose."""
    inputs, scene = inputs_in_pose(drawing.program, points, guides), scene_in(drawing.scene, points, guides)
    steps = tuple([step.but(params=step.parameters(inputs)) for step in drawing.program.steps])
    redrawn = replace(drawing, scene=scene, program=replace(drawing.program, steps=steps))
    for anew in (False, True) if drawing.scene.loads is None else (False,):
        try:
            candidate = construct(scene, replace(drawing.design, method="", ways=())) if anew else redrawn
            if candidate.values:
                return candidate
        except (ConstructionError, Refused):
            continue
    return None


# ---- compounds that their forms do not hold everywhere ---------------------------------------------------------------


class FailingCompound(NamedTuple):
    """A compound whose drawn form fails in some poses, and whether its line is drawn against the rule's way."""

    compound: Compound
    against: bool


def best_construction(drawing: Construction) -> tuple[Construction, dict[int, FailingCompound]]:
    """The first of the constructions that serves in all poses if its missed compounds are put right, else that which
    serves in most; and those compounds, by the mark that they make.
    """
    if (poses := reachable_poses(drawing)) is None:
        return drawing, {}
    wrong, served = failing_compounds(drawing, poses)
    open = _regular_poses(drawing, poses) & ~served
    if not open.any():
        return drawing, wrong
    candidates = [(drawing, wrong, served)]
    candidates += [(other, *failing_compounds(other, poses)) for other in constructions(drawing, poses=poses)[1:]]
    best, failing, _ = max(candidates, key=lambda candidate: int(candidate[2].sum()))
    return best, failing


def failing_compounds(drawing: Construction, poses: ReachablePoses) -> tuple[dict[int, FailingCompound], Array]:
    """The compounds whose form fails in some pose although their rule does not, by the mark that they make; and the
    poses in which all that is wanted is right if they are put right, shape (n,).

    Each is read from marks that are put right, where others before it fail.
    """
    movements, inputs, domain = drawing.drawn, _inputs(drawing.drawn, poses), Arrays()
    compounds = {compound.step.index: compound for compound in drawing.compounds
                 if max(compound.step.args) < compound.step.index}  # its form may do without a mark that comes later
    values, failing = list[Any](), dict[int, FailingCompound]()
    with np.errstate(all="ignore"):
        for step in movements.steps:
            value = step.value(domain, values, inputs)
            compound = compounds.get(step.index)  # one that reads its own mark, as lines are drawn once, tells nothing
            if compound is not None and step.index not in compound.step.args and (sign := _sense(drawing, compound)):
                args, truth = [values[arg] for arg in compound.step.args], compound.step.value(domain, values, {})
                truth = tuple(sign * number for number in truth) if step.op.gives == LINE else truth
                if (np.isfinite(truth[0]) & ~_coincide(step.op.gives, value, truth, args)).any():
                    failing[step.index], value = FailingCompound(compound, sign < 0), truth
            values.append(value)
    return failing, _poses_with_true_marks(drawing, poses, values)


def corrected_values(drawing: Construction, poses: ReachablePoses, wrong: Mapping[int, FailingCompound]) -> list[Any]:
    """The drawn steps' values in all poses, the marks of some compounds by their rule."""
    movements, inputs, domain, values = drawing.drawn, _inputs(drawing.drawn, poses), Arrays(), list[Any]()
    with np.errstate(all="ignore"):
        for step in movements.steps:
            failing = wrong.get(step.index)
            value = (failing.compound.step if failing else step).value(domain, values, inputs)
            values.append(tuple(-number for number in value) if failing and failing.against else value)
    return values


def _sense(drawing: Construction, compound: Compound) -> int:
    """Whether a compound's rule gives its drawn mark in the given pose: 1, or -1 for a line that runs against it."""
    step = compound.step
    try:
        truth = step.op.rule(Floats(), *[drawing.values[arg] for arg in step.args], **step.params)
    except (ConstructionError, ZeroDivisionError, ValueError):
        return 0
    value, args = drawing.values[step.index], [drawing.values[arg] for arg in step.args]
    for sign in (1, -1) if step.op.gives == LINE else (1,):
        signed = tuple(sign * number for number in truth) if step.op.gives == LINE else truth
        if bool(np.all(_coincide(step.op.gives, value, signed, args))):
            return sign
    return 0


def _coincide(kind: str, value: Any, truth: Any, args: Any) -> Array:
    """Whether two marks coincide, relative to the marks that they were made from."""
    scale: Array = MIN_SIZE
    for arg in args:
        if len(arg) == 2:
            scale = np.maximum(scale, np.hypot(arg[0], arg[1]))
    if kind == LINE:
        (a, b, c), (u, v, w) = value, truth
        n, m = np.hypot(a, b), np.hypot(u, v)
        return (np.hypot(a / n - u / m, b / n - v / m) <= MARK_TOL) & (np.abs(c / n - w / m) <= MARK_TOL * scale)
    if kind == POINT:
        scale = np.maximum(scale, np.hypot(truth[0], truth[1]))
        return np.hypot(value[0] - truth[0], value[1] - truth[1]) <= MARK_TOL * scale
    return np.all([np.abs(p - q) <= MARK_TOL * np.maximum(MIN_SIZE, np.abs(q))
                   for p, q in zip(value, truth, strict=True)], axis=0)
