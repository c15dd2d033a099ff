"""The parts of accelerations and velocities on polar plans are the solver's, head to tail."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from itertools import chain, permutations
from typing import Any

import pytest
from sampling import CORE
from worlds import asking, scenes

import graphplan as gp

ROUNDED, TINY = 1e-7, 1e-12  # of the largest vector, and in scene units
OF_SLIDES = "relative", "coriolis", "sliding"  # the kinds of parts that slides have
IN_NO_WAY = gp.Refused, gp.SingularPose, gp.ConstructionError  # what is raised where a pose cannot be drawn
SEEDS = 9


def parts_of(drawing: gp.WorkingDrawing) -> Iterator[tuple[Any, complex]]:
    """The parts that are drawn, each with its vector in scene units."""
    for part in drawing.part_arrows:
        start, end = (complex(*drawing.truth[drawing.program.wanted[mark]][:2]) for mark in part.marks)
        yield part, (end - start) / drawing.kappa ** (1 if part.kind == "relative" else 2)


def spellings(point: str, link: str) -> list[str]:
    """A point, or that of a link's plane which coincides with it, as parts are named after them."""
    name, number = point.replace("_", ""), "0" if link == "frame" else link
    return [name, f"{name}{number}", f"{name}({link})"]


class Motion:
    """The rates of all links and slides, by `solve`."""

    def __init__(self, scene: gp.Scene):
        found = gp.solve(asking(gp.parse(scene.text, scene.name)))
        self.scene, self.found = scene, found
        self.omega, self.alpha = ({**dict.fromkeys(scene.links, 0.0), **rates} for rates in (found.omega, found.alpha))

    def truths(self, part: Any) -> list[complex]:
        """What a part should be; several, where its name is that of points of several links or slides."""
        at = {name: complex(*map(float, place)) for name, place in self.scene.points.items()}
        values, higher = list[complex](), self.scene.gears or self.scene.contacts
        for link in self.scene.links:
            places = [name for name in at if not higher or name in self.scene.links[link]]
            spelled = {name: point for point in places for name in spellings(point, link)}
            spelled |= {name.replace("_", ""): name for name in places}
            for X, K in (pair for pair in permutations(spelled, 2) if part.of in ("".join(pair), ",".join(pair))):
                arm, omega = at[spelled[X]] - at[spelled[K]], self.omega[link]
                values.append({"relative": 1j * omega * arm, "normal": -omega**2 * arm,
                               "tangential": 1j * self.alpha[link] * arm}.get(part.kind, complex("nan")))
        for slide in self.scene.slides if part.kind in OF_SLIDES else ():
            values += [sign * self._of_slide(slide, part.kind) for sign in (1, -1)]
        return values

    def _of_slide(self, slide: Any, kind: str) -> complex:
        """The sliding of a pair, or the Coriolis acceleration that it makes."""
        velocity = self.found.sliding_velocity[slide.name]
        if kind == "coriolis":
            return 2j * self.omega[slide.along] * velocity
        return velocity if kind == "relative" else self.found.sliding_acceleration[slide.name]


def judge(scene: gp.Scene) -> set[str]:
    """The parts of a scene's polar plans are right; of which kinds they are."""
    drawing, motion = gp.construct(scene, plan="polar"), Motion(scene)
    vectors = list(parts_of(drawing))
    largest = max((abs(vector) for _, vector in vectors), default=0.0)
    for part, vector in vectors:
        known = motion.truths(part)
        if (scene.gears or scene.contacts) and (not known or part.kind in OF_SLIDES):
            continue  # of the lower pairs that stand for higher ones the solver knows nothing
        assert known, part
        assert min(abs(vector - value) for value in known) <= ROUNDED * largest + TINY, (part, vector, known)
    return {part.kind for part, _ in vectors}


@pytest.mark.costly
def test_parts_are_what_the_solver_makes_of_them() -> None:
    """Normal: omega squared times the arm; tangential: alpha times it; Coriolis: twice omega times the sliding: in
    packaged scenes, and in random ones with pins, slides, gears, contacts and drives of all arrangements."""
    seen, packaged = set[str](), ((name, gp.load(name)) for name in CORE)
    for name, scene in chain(packaged, *(scenes(kind, range(SEEDS)) for kind in ("linkage", "gearing"))):
        with suppress(*IN_NO_WAY):
            try:
                seen |= judge(scene)
            except AssertionError as failure:
                failure.add_note(str(name))
                raise
    assert seen == {"relative", "normal", "tangential", "coriolis", "sliding"}


def test_what_forces_alone_ask_for_is_drawn_in_parts() -> None:
    """The acceleration of a mass centre is drawn in its normal and its tangential part where forces alone need it."""
    scene = asking(gp.load("ozols-9-1").replace("drive.0.alpha", 3), reactions="all")
    assert {part.kind for part, _ in parts_of(gp.construct(scene, plan="polar"))} >= {"normal", "tangential"}
