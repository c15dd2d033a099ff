"""Stages tell what textbooks do: of every step why it is drawn, and equations that can be solved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import permutations
from random import Random

import pytest
from random_loads import loaded
from random_mechanisms import GROUPS, mechanism
from sampling import CORE

import graphplan as gp
from graphplan.design.decide import construct
from graphplan.kernel.kinds import Movement
from graphplan.kernel.program import Program
from graphplan.kernel.stages import Equation, Knowledge, Stage
from graphplan.mechanism.model import Find
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.solver import solve as solve_rates

WITHOUT_COMPOUNDS = "arc-cam", "ozols-16-1", "roller-cam"  # whose relative normal accelerations are computed
FREE = {Knowledge.WHOLLY: 0, Knowledge.DIRECTION: 1, Knowledge.LOCUS: 1, Knowledge.NOTHING: 2}
TEXTBOOK = {  # scenes with some of their equations, as they are found by hand
    "slider-crank": ["v_B = v_A + v_BA", "a^n_BA = v_BA²/BA", "a_A = a^n_AO", "a_B = a_A + a^n_BA + a^t_BA"],
    "slotted-link": ["v_A3 = v_A + v_A3A", "a^C_A3A = 2 ω_3 v_A3A", "a_A3 = a_A + a^C_A3A + a^r_A3A"],
    "four-bar": ["a^n_AB = -a^n_BA = v_AB²/AB", "a_B = a_A + a^n_BA + a^t_BA"],
    "alt-eight-link": ["v_B = v_F + v_BF", "v_C = v_Q + v_CQ", "v_E = v_C + v_EC"],
    "jaanimets-10": ["M_B(P_3) + M_B(T_23) = 0", "P_3 + P_4 + T_23 + T_04 + N_23 + N_04 = 0", "R_32 + R_02 + F_2 = 0"],
}


@cache
def drawing_of(name: str) -> Construction:
    return construct(gp.load(name))


def program(name: str) -> Program:
    return drawing_of(name).drawn


@pytest.mark.parametrize("name", TEXTBOOK)
def test_equations_are_those_of_the_textbook(name: str) -> None:
    """The stages of a scene solve the vector equations that its textbook writes."""
    written = {equation.text for stage, _ in program(name).stages for equation in stage.equations}
    assert set(TEXTBOOK[name]) - written == set()


def test_a_form_is_named_in_the_title() -> None:
    """A stage whose compound is drawn in a form of its own is called by it, and has the letters of the sheet."""
    titles = {str(stage.title) for stage, _ in program("alt-eight-link").stages}
    assert {"Normal acceleration of C about E, by the semicircle", "Auxiliary point Q of link 3, locus of v_c",
            "Normal acceleration of B about F, by the right triangle", "Velocity of C"} <= titles
    trial = construct(gp.load("alt-eight-link"), Design(method="trial")).drawn
    assert "Trial figure of link 3, locus of v_c" in {str(stage.title) for stage, _ in trial.stages}


def test_forces_alone_speak_of_no_velocity() -> None:
    """Where reactions alone are asked for, and no load needs the motion, no stage is of velocities or of a lever; a
    plan that is asked for is drawn all the same."""
    scene = replace(gp.load("jaanimets-10"), find=Find((), ()))
    titles = {design.plan: [str(stage.title) for stage, _ in construct(scene, design).drawn.stages]
              for design in (Design(), Design(plan="lever"))}
    assert "R_23, R_04: equilibrium of links 3 and 4" in titles[""]
    assert [title for title in titles[""] if "elocity" in title or "lever" in title] == []
    assert [title for title in titles["lever"] if "lever" in title] != []


def test_a_couple_follows_a_force_in_one_step() -> None:
    """The moment of a couple with the arm of the force sought is added by its opposite, not by a product."""
    steps = next(steps for stage, steps in program("jaanimets-10").stages if str(stage.title).startswith("T_04"))
    assert [step.op.name for step in steps] == ["balance", "transfer"]


def test_no_mark_is_drawn_for_the_size_of_a_trial_alone() -> None:
    """What a trial is in proportion to is drawn for another purpose, on its plan or on that of the mechanism."""
    drawn = construct(gp.load("class-four-loaded")).drawn
    picked = [step for step in drawn.steps if step.op.movement is Movement.PICKED]
    others = {arg for step in drawn.steps if step.op.movement is not Movement.PICKED for arg in step.args}
    assert picked
    assert {arg for step in picked for arg in step.args} <= others | {*range(drawn.givens), *drawn.wanted}


def test_compounds_are_told_as_one_step() -> None:
    """What takes several movements is told in one sentence, in the letters and numbers of its movements; of what is
    drawn on two plans the part on the first has words of its own."""
    drawing = construct(gp.load("slider-crank"), Design("orthogonal"))
    told = {str(one.sentence): one for one in drawing.compounds}
    normal = told["Construct the relative normal acceleration of A about B by the relative velocity from point 9 to "
                  "v_b; from a lay it off: mark b."]
    assert [drawing.drawn.number(step.index) for step in normal.movements] == [10, 11, 12, 13, 14, 15, 16, 17]
    assert normal.sentence_before == (
        "On AB draw the semicircle; about B strike the arc through it with the opening from point 9 to v_b: point 15. "
        "From there drop the perpendicular on AB: foot point 16.")
    auxiliary = [str(one.sentence) for one in drawing_of("alt-eight-link").compounds if one.form == "auxiliary point"]
    assert auxiliary[0] == ("Q is where FB meets AN: mark v_q where line 6 meets AN, through it draw "
                            "line 10, parallel to QC.")


@pytest.mark.parametrize("name", CORE)
def test_a_compound_stands_in_one_stage(name: str) -> None:
    """The movements of a compound are of one stage, and none is a part of two compounds."""
    compounds = [compound.movements for compound in drawing_of(name).compounds]
    assert bool(compounds) == (name not in WITHOUT_COMPOUNDS) or not gp.load(name).find.acceleration
    assert all(len({step.stage for step in steps}) == 1 for steps in compounds)
    assert len({step.index for steps in compounds for step in steps}) == sum(map(len, compounds))


@pytest.mark.parametrize("name", CORE)
def test_a_stage_leaves_no_more_open_than_it_solves(name: str) -> None:
    """A vector equation finds two numbers, one of moments one: no stage that finds a vector or a force has more open.
    """
    found = [stage for stage, _ in program(name).stages if stage.equations and "locus" not in stage.title.lower()]
    assert len(found) > 2
    assert [stage for stage in found if not _solved(stage)] == []


@pytest.mark.parametrize("name", CORE)
def test_tangential_velocities_stand_square(name: str) -> None:
    """Where of one point's velocity about another's the direction alone is known, it is perpendicular to their line."""
    scene = gp.load(name)
    speed = {point: complex(*rate) for point, rate in solve_rates(scene).velocity.items()}
    told = {vector for stage, _ in program(name).stages for vector, known in stage.vectors.items()
            if known is Knowledge.DIRECTION}
    pairs = [(X, K) for X, K in permutations(speed, 2) if f"v_{X}{K}" in told and scene.points[X] != scene.points[K]]
    for X, K in pairs:
        arm = complex(*map(float, scene.points[X])) - complex(*map(float, scene.points[K]))
        along = (arm.conjugate() * (speed[X] - speed[K])).real
        assert abs(along) <= 1e-9 * abs(arm) * (abs(speed[X]) + abs(speed[K])), (X, K)
    assert pairs or name in ("open-chain", "ozols-10-1", "ozols-10-2", "ozols-13-7", "ozols-5-6")  # drives


def _solved(stage: Stage) -> bool:
    return sum(FREE[known] for known in stage.vectors.values()) <= sum(map(_rows, stage.equations))


def _rows(equation: Equation) -> int:
    return 1 if "M_" in equation.text and "(" in equation.text else 2


def scenes(seed: int) -> Iterator[gp.Scene]:
    """Two groups on a crank, at random, without loads and with them."""
    random = Random(seed)
    found = mechanism([random.choice([*GROUPS]) for _ in range(2)], seed)
    yield from (found, loaded(found, seed))


@pytest.mark.parametrize("seed", range(8))
def test_all_that_is_recorded_stands_in_stages(seed: int) -> None:
    """Whatever the mechanism and its loads, every step that is not given is a part of a stage with a title and a law.
    """
    for scene in scenes(seed):
        try:
            recorded = construct(scene).program
        except gp.GraphplanError:
            continue
        assert [step.op.name for step in recorded.steps[recorded.givens :] if not step.stage] == []
        assert all(stage.title and stage.law for stage, _ in recorded.stages)
