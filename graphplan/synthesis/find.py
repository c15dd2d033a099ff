"""The synthesis of a task, by its kind."""

from __future__ import annotations

from dataclasses import replace

from graphplan.errors import Refused
from graphplan.synthesis.conjugate import synthesize_conjugate
from graphplan.synthesis.function import synthesize_function
from graphplan.synthesis.gear import synthesize_gear
from graphplan.synthesis.geneva import synthesize_geneva
from graphplan.synthesis.guidance import synthesize_guidance
from graphplan.synthesis.paths import synthesize_cognates, synthesize_dwell
from graphplan.synthesis.sketch import Synthesis
from graphplan.synthesis.stroke import synthesize_stroke
from graphplan.synthesis.task import SynthesisTask

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
