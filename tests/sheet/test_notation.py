"""A vector has one letter, on the sheet and in words."""

from __future__ import annotations

import pytest
from sheets import drawing_of

from graphplan.sheet.lettering.lettering import equation_runs, name_runs, sentence_runs


@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "triad"])
def test_a_vector_bears_on_the_sheet_the_letter_that_its_equation_has(name: str, plan: str) -> None:
    """v_B, a_B and a^n_BA are so called on plates, in what is measured and in equations."""
    drawing = drawing_of(name, plan)
    letters = {vector.label for vector in drawing.arrows if vector.label}
    stages = [step.stage(()) for step in drawing.program.steps if step.stage]
    measured = {f"{reading.kind.dimension.letter}_{reading.of}" for reading in drawing.readings}
    assert letters <= measured | {vector for stage in stages for vector in stage.vectors}


@pytest.mark.parametrize("name", ["P_2", "P_2'", "W_3''"])
def test_a_prime_stands_where_it_does_on_the_sheet(name: str) -> None:
    """The second force on a link is written alike on plates, in sentences and in equations."""
    assert name_runs(name) == sentence_runs(name) == equation_runs(name)


@pytest.mark.parametrize("name", ["omega_crank", "α_Kurbel", "T_кривошип", "R_crank,0"])
def test_a_link_that_has_a_word_for_its_name_is_a_subscript_too(name: str) -> None:
    """Quantities of links called crank or Kurbel are set as those of link 2."""
    assert name_runs(name) == sentence_runs(name)


def test_equations_have_greek_letters() -> None:
    """Of one point, of two, and with the link that a point is of; and so have the letters of vectors on the plans."""
    for text, runs in (("a^n_etakappa = v_psi(2) + v_BA", "anηκ = vψ(2) + vBA"), ("v_eta,psi0²/etapsi", "vηψ0²/ηψ"),
                       ("ω_crank,0 = omega_2", "ωcrank,0 = ω2")):
        assert "".join(run.text for run in equation_runs(text)) == runs
    assert equation_runs("a^t_eta,psi") == name_runs("a^t_eta,psi")
    assert equation_runs("v_eta,psi") == name_runs("v_eta,psi") == sentence_runs("v_eta,psi")
