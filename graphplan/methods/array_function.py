"""A construction as a function of arrays of any library that speaks the array API: on a GPU, or differentiated.

numpy is one such library; CuPy computes on the GPU, and JAX compiles and differentiates what it is given.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.tape.record import array_function
from graphplan.methods.recorded import ReadableDrawing
from graphplan.methods.replay import moving_parts, replay_of

Components = Mapping[str, tuple[Any, Any]]


def function_of(drawing: ReadableDrawing, names: Collection[str], only: Collection[str] | None,
                ) -> Callable[[Components], dict[str, dict[str, Any]]]:
    """The drawing's readings, all or `only` of some kinds, as a function of where these points and guides are.

    Fails with `Refused` where a name is none that moves, where what stands still cannot be drawn, and where points
    coincide and the construction takes one for the other.
    """
    movable = {part.name: part.parts for part in moving_parts(drawing)}
    for name in names:
        if name not in movable:
            choices = f"one of {', '.join(movable)}" if movable else "a scene that gives its points, not its lengths"
            raise Refused(f"point {name}", "no drawn point or guide of this name moves", choices)
    if relied := sorted({name for pair in drawing.relied for name in pair} & {*names}):
        raise Refused(f"points {', '.join(relied)}", "the construction takes points for one that coincide in the scene",
                      "drawing.evaluate, which asks in each pose whether they do")
    free = tuple(step for name in names for steps in movable[name] for step in steps)
    replay = replay_of(drawing, free, tuple(drawing.kinds if only is None else only))
    if replay is None:
        raise Refused("the construction", "what stands still in all poses cannot be drawn", "see graphplan check")
    run = array_function(replay.tape, replay.inputs, replay.places_of_results)

    def readings(places: Components) -> dict[str, dict[str, Any]]:
        """Vectors as two arrays, numbers as one, by kind and name; nan in poses that the rules would refuse."""
        xp = _namespace([number for name in names for number in places[name]])
        arrays = [xp.asarray(places[name][axis], dtype=xp.float64)
                  for name in names for axis, steps in enumerate(movable[name]) for _ in steps]
        with np.errstate(all="ignore"):
            values, refused = run(xp, *arrays)
        blank = xp.where(refused, xp.full_like(arrays[0], xp.nan), xp.zeros_like(arrays[0]))
        return {kind: {name: tuple(blank + part for part in value) if isinstance(value, tuple) else blank + value
                       for name, value in named.items()} for kind, named in values.items()}

    return readings


def _namespace(numbers: list[Any]) -> Any:
    """The library that these arrays are of: numpy, where they say none."""
    return next((number.__array_namespace__() for number in numbers if hasattr(number, "__array_namespace__")), np)
