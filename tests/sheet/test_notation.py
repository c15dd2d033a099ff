"""A vector has one letter, on the sheet and in words."""

from __future__ import annotations

import pytest
from sheets import drawing_of


@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "triad"])
def test_a_vector_bears_on_the_sheet_the_letter_that_its_equation_has(name: str, plan: str) -> None:
    """v_B and a_B are v_B and a_B on plates, in equations and in what is measured."""
    drawing = drawing_of(name, plan)
    letters = {vector.label for vector in drawing.arrows if vector.kind in ("velocity", "acceleration")}
    stages = [step.stage(()) for step in drawing.program.steps if step.stage]
    assert letters <= {vector for stage in stages for vector in stage.vectors}
