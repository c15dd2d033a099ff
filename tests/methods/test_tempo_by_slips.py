"""How far off a pencil draws results, about, before there is a sheet."""

from __future__ import annotations

import numpy as np
import pytest

from graphplan.accuracy.first_order import first_order
from graphplan.accuracy.hand import Pencil, hand
from graphplan.accuracy.survey.growth import chain
from graphplan.kernel.expand import Expander
from graphplan.mechanism.scene import load
from graphplan.methods.construct import construct
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.poles import Poles
from graphplan.methods.motion.proportion import badness
from graphplan.sheet.layout.composition import Composer


@pytest.mark.parametrize("name", ["class-four", "rosenauer-basic"])
def test_results_are_as_bad_as_on_a_usual_sheet(name: str) -> None:
    """Slips on plans that fill their panels say about what the exact errors at usual scales do."""
    drawing = construct(load(name))
    scales = Composer(drawing, None, {}, lettered=False).usual
    results = first_order(drawing, hand(drawing, scales.lengths_per_mm, Pencil()), scales)
    sizes = {(kind, of): np.linalg.norm(value) for kind, values in drawing.computed.items()
             for of, value in values.items()}
    errors = [one.deviation.value / size for one in results if (size := sizes[one.kind, one.of]) > 1e-6]
    exact = sum(error / (error + 0.1) for error in errors) / len(errors)
    assert badness(drawing) == pytest.approx(exact, abs=0.12)


@pytest.mark.parametrize("name", ["four-bar", "class-four"])
def test_what_was_weighed_is_not_drawn_out_again(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A construction whose tempo was weighed is the one that is given, with its single movements as they are."""
    programs, run = [], Expander.run
    monkeypatch.setattr(Expander, "run", lambda self: (programs.append(self.program), run(self))[1])
    drawing = construct(load(name))
    assert len(drawing.drawn) > len(drawing.program)
    assert sum(program is drawing.program for program in programs) == 1


def test_a_plan_is_made_once_however_long_its_vectors_are_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where other tempos are tried, the moves and those of velocities by poles are planned once, and so is where the
    poles are."""
    planned, plan, sought, frame_poles = [], Planner.plan, [], Poles.frame_poles
    monkeypatch.setattr(Planner, "plan", lambda planner: (planned.append(planner), plan(planner))[1])
    monkeypatch.setattr(Poles, "frame_poles", lambda poles: (sought.append(poles), frame_poles(poles))[1])
    drawn, draw = [], Draughtsman.draw
    monkeypatch.setattr(Draughtsman, "draw", lambda drawing: (drawn.append(drawing), draw(drawing))[1])
    construct(chain(7), method="poles")
    assert len(drawn) > 2
    assert (len(planned), len(sought)) == (2, 1)
