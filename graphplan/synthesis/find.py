"""Geneva wheel: its slots, its crank and its motion (Ozols 1974, 19-4 with fig. 19-12; (19.8) to (19.17)).

The pin enters a slot along it, so that the angle O S C is right. Printed in (19.11) as r, the crank's own shaft is
bound by R; table 19-1 has 4°15' for 4°45' at three slots.

The synthesis of a task, by its kind.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from graphplan.errors import Refused
from graphplan.phrases import said
from graphplan.synthesis.conjugate import synthesize_conjugate
from graphplan.synthesis.function import synthesize_function
from graphplan.synthesis.gear import synthesize_gear
from graphplan.synthesis.guidance import synthesize_guidance
from graphplan.synthesis.paths import synthesize_cognates, synthesize_dwell
from graphplan.synthesis.sketch import Synthesis, SynthesisBoard, place_of
from graphplan.synthesis.stroke import synthesize_stroke
from graphplan.synthesis.task import SynthesisTask

DIAGRAM_ANGLES = 24  # of the working angle at which the wheel's angle is drawn


def synthesize_geneva(task: SynthesisTask) -> Synthesis:
    """The Geneva wheel of a task."""
    request, sketch = task.request, SynthesisBoard()
    half = 180 / request.slots
    board = sketch.board
    O, C = sketch.given(0j, "O"), sketch.given(complex(request.centres), "C")
    with sketch.stage(said("Slots"), said("their axes are inclined to the line of centres by 180°/z")):
        axes = [sketch.keep("slot", sketch.ray(C, 180 + way * half)) for way in (1, -1)]
    with sketch.stage(said("Entry and exit"), said("the pin enters along the slot: O S is square to C S")):
        S = sketch.keep("S", board.foot(axes[0], O, name="S"))
        sketch.keep("T", board.foot(axes[1], O, name="T"))
        sketch.keep("crank circle", board.circle(O, board.opening(O, S)))
        sketch.keep("wheel circle", board.circle(C, board.opening(C, S)))
    with sketch.stage(said("Wheel"), said("the pin leads the slot; the angle of the wheel is that of C A")):
        working = 180 - 2 * half
        circle = sketch.roles["crank circle"][0]
        for k in range(1, DIAGRAM_ANGLES):
            ray = sketch.ray(O, -working / 2 + working * k / DIAGRAM_ANGLES)
            A = sketch.keep("A", board.line_meets_circle(ray, circle, way="on"))
            sketch.keep("axis", board.line(C, A))
    values = sketch.values()
    at = place_of(values, "S")
    R, r = abs(at), abs(request.centres - at)
    return Synthesis(task, (values,), (), geneva_numbers(request.slots, R, r, request.centres))


def geneva_numbers(z: int, R: float, r: float, a: float) -> dict[str, Any]:
    """Angles, largest speed and accelerations, for omega 1 of the crank."""
    ratio = R / a
    crank_at = math.degrees(math.acos(extreme_cosine(ratio)))
    cos, sin = math.cos(math.radians(crank_at)), math.sin(math.radians(crank_at))
    square = 1 - 2 * ratio * cos + ratio**2
    return {"crank": R, "wheel": r, "working": 180 - 360 / z, "idle": 180 + 360 / z, "ratio": (z - 2) / (z + 2),
            "omega": ratio / (1 - ratio),
            "alpha": {"entry": R / r, "largest": ratio * (1 - ratio**2) * sin / square**2, "crank_at": crank_at,
                      "wheel_at": math.degrees(math.atan2(ratio * sin, 1 - ratio * cos))}}


def extreme_cosine(ratio: float) -> float:
    """The cosine of the crank's angle at which the wheel's acceleration is largest."""
    q = (1 + ratio**2) / (4 * ratio)
    return math.sqrt(q * q + 2) - q


BY_KIND = {"guidance": synthesize_guidance, "function": synthesize_function, "stroke": synthesize_stroke,
           "cognates": synthesize_cognates, "dwell": synthesize_dwell, "geneva": synthesize_geneva,
           "conjugate": synthesize_conjugate, "gear": synthesize_gear}


def find_mechanism(task: SynthesisTask, number: int = 1) -> Synthesis:
    """What a task asks for, with the solution of this number chosen.

    Fails with `NoMechanism` where there is none, and with `Refused` where there are fewer.
    """
    synthesis = BY_KIND[task.kind](task)
    count = max(1, len(synthesis.linkages))
    if number > count:
        raise Refused(f"--solution {number}", f"the task has {count}", f"a number from 1 to {count}")
    return replace(synthesis, chosen=number - 1 if synthesis.linkages else 0)
