"""Friction over the cycle: Kinytskyi's lambda mechanism, a piston in closed form, and the solver's own friction."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.reduction import check_reduction, friction_gap
from graphplan.errors import Refused
from graphplan.machine.reduced.friction import FrictionMoments
from graphplan.machine.reduced.reduction import Reduction, reduction
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse

PISTON = gp.load("ozols-5-1").text + """
[[forces]]
on = "3"
at = "B"
value = [-1000, 0]
[balance]
link = "1"
[[friction]]
slide = ["3", "frame"]
coefficient = 0.1
"""


@pytest.fixture(scope="module")
def lambda_mechanism() -> Reduction:
    return reduction(gp.load("kinytskyi"))


def rubbed(found: Reduction, travel: np.ndarray) -> FrictionMoments:
    assert found.friction
    return found.friction.friction_at(travel)


def heavier(scene: Scene, times: int) -> Scene:
    loads = scene.loads
    assert loads
    masses = {link: replace(m, mass=times * m.mass, inertia=times * m.inertia) for link, m in loads.masses.items()}
    moments = tuple(replace(moment, value=times * moment.value) for moment in loads.moments)
    return replace(scene, loads=replace(loads, masses=masses, moments=moments))


def simple_balance(found: Reduction, travel: np.ndarray) -> np.ndarray:
    """What the journals take with the reactions that they bear without friction, N m at the crank."""
    rubbing, turn = found.friction, found.motion.turn(travel)
    assert rubbing
    assert rubbing.scene.loads
    poses = next(rubbing.recordings.constructions()).evaluate(turn.points, turn.guides)
    omega = {"frame": 0.0, **poses.omega}
    total = np.zeros(travel.shape)
    for one in rubbing.scene.loads.frictions:
        pin, *links = rubbing.scene.links_of[one.at]
        for link in links:
            force = np.abs(poses.results_of_kind("reaction")[f"{link} at {one.at}"])
            total += float(one.radius * one.coefficient) * force * np.abs(omega[link] - omega[pin]) / 10 / 1000
    return total


def test_kinytskyi_over_the_cycle(lambda_mechanism: Reduction) -> None:
    """The polygons' moment of friction is the solver's in every pose, made up of what the journals take, and near the
    power balance with the reactions without friction; the efficiency does not hang on the size of the load, and nearly
    vanishes in the dwell."""
    travel = np.radians(np.arange(0, 360, 30))
    assert friction_gap(lambda_mechanism, travel) < 1e-12
    assert max(check_reduction(lambda_mechanism, travel).values()) < 1e-13
    found = rubbed(lambda_mechanism, travel)
    assert sum(found.losses.values()) == pytest.approx(found.moment, rel=1e-10)
    assert found.moment == pytest.approx(lambda_mechanism.reduce_at(travel).by["M_F"])
    assert found.balance[[0, 4]] == pytest.approx([5.729, -6.307], abs=5e-4)
    assert found.efficiency[[0, 1, 3, 4, 8]] == pytest.approx([0.893, 0.925, 0.903, 0.849, 0.003], abs=1e-3)
    assert simple_balance(lambda_mechanism, travel)[:6] == pytest.approx([0.672, 0.416, 0.087, 0.453, 0.979, 0.676],
                                                                         abs=5e-4)
    threefold = rubbed(reduction(heavier(gp.load("kinytskyi"), 3)), travel)
    assert threefold.efficiency == pytest.approx(found.efficiency, rel=1e-9)
    assert threefold.moment == pytest.approx(3 * found.moment)


def test_losses_over_the_cycle_close_its_energy(lambda_mechanism: Reduction) -> None:
    """What the drive gives over a turn is what friction takes, as the moment on the rocker does no work there and back;
    the pairs' shares are nearly all of it."""
    losses = lambda_mechanism.losses
    assert losses.lost == pytest.approx(2.6731966584607685, rel=1e-10)
    assert losses.given == pytest.approx(losses.lost, rel=1e-9)
    assert losses.relative_gap < 1e-12
    assert losses.efficiency == pytest.approx(0, abs=1e-9)
    assert sum(losses.pairs.values()) == pytest.approx(losses.lost, rel=1e-10)
    assert [*losses.pairs] == ["O 1", "A 2", "B 3", "C 3", "D 4", "E 5", "F 5"]


@pytest.mark.parametrize("omega", ["10", "-10", "0"])
def test_a_piston_in_closed_form(omega: str) -> None:
    """A piston that is pushed against a force by a rod at the angle beta has the efficiency 1 - f |tan beta|; where the
    force drives the crank the inverse leans the other way."""
    found = reduction(parse(PISTON.replace("omega = 10", f"omega = {omega}"), "piston"))
    travel = np.radians(np.arange(5, 360, 35))
    turn = found.motion.turn(travel)
    rod = turn.points["B"] - turn.points["A"]
    rubbing = rubbed(found, travel)
    pushed = np.where(rubbing.balance > 0, 1 - 0.1 * np.abs(rod.imag / rod.real),
                      1 / (1 + 0.1 * np.abs(rod.imag / rod.real)))
    assert rubbing.efficiency == pytest.approx(pushed, rel=1e-9)
    assert friction_gap(found, travel) < 1e-11


def test_the_mean_efficiency_of_a_piston() -> None:
    """Over a turn a constant force does no work: all that the drive gives is lost; against friction alone there is no
    efficiency to speak of, and a scene without friction has no losses."""
    found = reduction(parse(PISTON, "piston"))
    slide = found.losses
    assert slide.lost > 0
    assert slide.pairs == {"3 along frame": pytest.approx(slide.lost, rel=1e-10)}
    with pytest.raises(Refused, match="friction: the scene has no friction"):
        _ = reduction(gp.load("ozols-10-1")).losses


TABLED = """
[[forces]]
on = "3"
at = "B"
direction = [1, 0]
over = "3 along frame"
values = [[-1000, 0], [1000, 0], [1000, -500], [0, -300], [-1000, -200]]
"""


def test_loads_by_tables_rub_too() -> None:
    """The moment of friction follows loads that change, jumps with them, and the pairs take all that is lost."""
    found = reduction(parse(PISTON.replace("[balance]", f"{TABLED}[balance]"), "piston"))
    assert friction_gap(found, np.linspace(0.1, 6.2, 7)) < 1e-11
    assert found.losses.relative_gap < 1e-10


def test_a_roller_rubs_on_its_pin() -> None:
    """The pin of a roller that rolls on a cam is a journal like any other, wherever the roller touches."""
    text = gp.load("roller-cam").text
    rough = '[[moments]]\non = "2"\nvalue = 3\n[balance]\nlink = "1"\n[[friction]]\nat = "A"\n' \
            "radius = 2\ncoefficient = 0.1\n[masses.2]\nmass = 3\ncentre = \"A\"\n[find]"
    found = reduction(parse(text.replace("[find]", rough), "roller-cam"))
    assert friction_gap(found, np.linspace(0.1, 6.2, 7)) < 1e-11


def test_a_mechanism_that_locks_itself_is_refused() -> None:
    """Where friction is so large that no balance keeps up the motion, it is said at which travel."""
    found = reduction(parse(PISTON.replace("coefficient = 0.1", "coefficient = 6"), "piston"))
    with pytest.raises(Refused, match="the mechanism locks itself at a travel of 250 degrees"):
        rubbed(found, np.radians([5, 250]))
