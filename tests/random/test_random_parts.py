"""The parts of accelerations and velocities on polar plans are the solver's, head to tail."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from itertools import permutations, product

import pytest
from gearings import gearing
from linkages import linkage, scenes
from sampling import CORE

import graphplan as gp
from graphplan.errors import ConstructionError, Refused, SingularPose
from graphplan.mechanism.model import FRAME, Scene, Slide
from graphplan.methods.construction import Construction, PartArrow
from graphplan.solver import Rates, solve

ROUNDED, TINY = 1e-7, 1e-12  # of the largest vector, and in scene units
OF_SLIDES = "relative", "coriolis", "sliding"  # the kinds of parts that slides have
IN_NO_WAY = Refused, SingularPose, ConstructionError  # what is raised where a pose cannot be drawn
SEEDS = 20


def parts_of(drawing: Construction) -> Iterator[tuple[PartArrow, complex]]:
    """The parts that are drawn, each with its vector in scene units."""
    for part in drawing.part_arrows:
        start, end = (complex(*drawing.truth[drawing.program.wanted[mark]][:2]) for mark in part.marks)
        yield part, (end - start) / drawing.kappa ** (1 if part.kind == "relative" else 2)


def spellings(point: str, link: str) -> list[str]:
    """A point, or that of a link's plane which coincides with it, as parts are named after them."""
    name, number = point.replace("_", ""), "0" if link == FRAME else link
    return [name, f"{name}{number}", f"{name}({link})"]


def truths(scene: Scene, rates: Rates, part: PartArrow) -> list[complex]:
    """What the solver makes of a part; several, where its name is that of points of several links or slides."""
    at = {name: complex(*map(float, place)) for name, place in scene.points.items()}
    values, higher = list[complex](), scene.gears or scene.contacts
    for link in scene.links:
        places = [name for name in scene.points if not higher or name in scene.links[link]]
        spelled = {name: point for point in places for name in spellings(point, link)}
        spelled |= {name.replace("_", ""): name for name in places}
        for X, K in (pair for pair in permutations(spelled, 2) if part.of in ("".join(pair), ",".join(pair))):
            arm = at[spelled[X]] - at[spelled[K]]
            omega, alpha = float(rates.omega.get(link, 0)), float(rates.alpha.get(link, 0))
            values.append({"relative": 1j * omega * arm, "normal": -omega**2 * arm,
                           "tangential": 1j * alpha * arm}.get(part.kind, complex("nan")))
    for slide in scene.slides if part.kind in OF_SLIDES else ():
        values += [sign * of_slide(slide, rates, part.kind) for sign in (1, -1)]
    return values


def of_slide(slide: Slide, rates: Rates, kind: str) -> complex:
    """The sliding of a pair, or the Coriolis acceleration that it makes."""
    velocity = complex(*map(float, rates.slide_velocity[slide.name]))
    if kind == "coriolis":
        return 2j * float(rates.omega.get(slide.along, 0)) * velocity
    return velocity if kind == "relative" else complex(*map(float, rates.slide_acceleration[slide.name]))


def judge(scene: Scene) -> set[str]:
    """The parts of a scene's polar plans are right; of which kinds they are."""
    drawing, rates = gp.construct(scene, plan="polar"), solve(scene)
    vectors = list(parts_of(drawing))
    largest = max((abs(vector) for _, vector in vectors), default=0.0)
    for part, vector in vectors:
        known = truths(scene, rates, part)
        if (scene.gears or scene.contacts) and (not known or part.kind in OF_SLIDES):
            continue  # of the lower pairs that stand for higher ones the solver knows nothing
        assert known, part
        assert min(abs(vector - value) for value in known) <= ROUNDED * largest + TINY, (part, vector, known)
    return {part.kind for part, _ in vectors}


@pytest.mark.parametrize("name", CORE)
def test_parts_are_what_the_solver_makes_of_them(name: str) -> None:
    """Normal: omega squared times the arm; tangential: alpha times it; Coriolis: twice omega times the sliding."""
    scene = gp.load(name)
    with suppress(*IN_NO_WAY):
        judge(scene)


def test_parts_of_random_linkages_are_what_the_solver_makes_of_them() -> None:
    """So they are of linkages with pins, slides and drives of all arrangements, and with gears and contacts; every kind
    of part is drawn."""
    seen = set[str]()
    for seed, made in product(range(SEEDS), (linkage, gearing)):
        for scene in scenes(seed, 1, made):
            with suppress(*IN_NO_WAY):
                seen |= judge(scene)
    assert seen == {"relative", "normal", "tangential", "coriolis", "sliding"}


def test_what_forces_alone_ask_for_is_drawn_in_parts() -> None:
    """The acceleration of the mass centre of a crank that a drive speeds up, and its couple."""
    scene = gp.parse("""
[points]
O = [0, 0]
S = [40, 30]
[links]
1 = "O S"
frame = "O"
[[drive]]
link = "1"
omega = 2
alpha = 3
[masses.1]
mass = 2
inertia = 0.01
centre = "S"
[[balance]]
link = "1"
[find]
reactions = "all"
""", "a crank")
    assert {part.kind for part, _ in parts_of(gp.construct(scene, plan="polar"))} >= {"normal", "tangential"}
