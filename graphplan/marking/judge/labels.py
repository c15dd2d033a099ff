"""Which step a label on a student's sheet speaks of: the letters of the sheet, or the number of the step."""

from __future__ import annotations

from collections.abc import Sequence

from graphplan.kernel.kinds import POINT, Movement
from graphplan.kernel.program import Program
from graphplan.marking.judge import measures
from graphplan.marking.spelling import spelled
from graphplan.marking.traces import Trace
from graphplan.phrases import Said


def labelled(program: Program, plan_of_step: Sequence[str], traces: Sequence[Trace]) -> dict[int, int]:
    """For each step that a trace is labelled as, the place of that trace; of several that which says it best, or first.

    A number beside a line may be that of a link, or of the line next to it: unless the plan is named it tells nothing.
    """
    names, found, told = Names(program, plan_of_step), dict[int, int](), set[int]()
    for loosely in range(measures.MAX_LOOSENESS + 1):
        for place, trace in enumerate(traces):
            numbered = trace.kind != POINT and not trace.panel and trace.label.isdigit()
            step = names.step(trace.kind, trace.panel, trace.label, loosely) if trace.label and not numbered else None
            if step is not None and program.steps[step].op.gives == trace.kind and place not in told:
                told.add(found.setdefault(step, place))
    return found


def sure(trace: Trace) -> bool:
    """Whether a label is certainly that of its trace: beside a mark of a drawing may stand the letter of another."""
    return bool(trace.panel) or (trace.kind == POINT and not trace.beside)


class Names:
    """What the marks of a construction may be called."""

    def __init__(self, program: Program, plan_of_step: Sequence[str]):
        self._steps = _names(program, plan_of_step)

    def step(self, kind: str, panel: str, label: str, loosely: int) -> int | None:
        """The step that makes a thing of this kind and label, by the label as it stands, or more loosely read: without
        the subscript's mark, and in small letters."""
        read = spelled(label.replace(" ", ""))
        text = (read, read.replace("_", ""), read.replace("_", "").casefold())[loosely]
        return self._steps.get((kind, panel, text), self._steps.get((kind, "", text)))


def _names(program: Program, plan_of_step: Sequence[str]) -> dict[tuple[str, str, str], int]:
    """All that a mark may be called, by its kind and plan or on any plan: what is clearer comes first."""
    found: dict[tuple[str, str, str], int] = {}
    loosely: dict[tuple[str, str, str], set[int]] = {}
    for step in program.steps:
        kind, text = step.op.gives, program.text(step.index)
        letters = [spelled(step.name), "" if isinstance(text, Said) else spelled(text)]
        number = str(program.number(step.index))
        for panel in (plan_of_step[step.index], ""):
            for letter in filter(None, letters):
                found.setdefault((kind, panel, letter), step.index)
                for less in (letter.replace("_", ""), letter.replace("_", "").casefold()):
                    loosely.setdefault((kind, panel, less), set()).add(step.index)
            for called in (number, f"#{number}", f"{kind}{number}") if step.op.movement is not Movement.GIVEN else ():
                loosely.setdefault((kind, panel, called), set()).add(step.index)
    for spelling, steps in loosely.items():
        if len(steps) == 1:  # what may be said of two is said of neither
            found.setdefault(spelling, *steps)
    return found
