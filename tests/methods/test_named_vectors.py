"""What a sentence says that a vector is, the vector is: normal and Coriolis accelerations, with sign and order."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from sampling import CORE

import graphplan as gp
from graphplan.kernel.program import Step
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.replaced import with_lower_pairs
from graphplan.methods.construction import Construction
from graphplan.methods.forces.free_bodies import roman
from graphplan.methods.motion.acceleration import CORIOLIS, GREEK, NORMAL
from graphplan.phrases import Phrase
from graphplan.solver import solve as solve_rates

PLANS = "orthogonal", "polar"


def told(drawing: Construction, phrase: Phrase) -> Iterator[tuple[Step, tuple[str, str]]]:
    """The drawn steps that say so, each with the two points that it names."""
    for step in drawing.drawn.steps:
        if phrase.says(step.why):
            one, two = step.why.put  # type: ignore[attr-defined]
            yield step, (one, two)


class Motion:
    """The motion of a scene by the solver, read by the names that sentences use: B2 and B(2) are B of link 2."""

    def __init__(self, scene: Scene):
        self.scene, self.rates = with_lower_pairs(scene), solve_rates(scene)

    def place(self, name: str) -> tuple[complex, complex, set[str]]:
        """Where a named point lies, its velocity, and its links."""
        found = re.fullmatch(r"(\w+)\((\w+)\)", name) or re.fullmatch(r"(\D+)(\d+)", name)
        if name in self.scene.points or not found:
            links = set(self.scene.links_of[name])
            if name not in self.rates.velocity and (own := sorted(links & self.rates.omega.keys())):
                return (*self.place(f"{name}({own[0]})")[:2], links)  # a pitch point
            return self._at(name), complex(*self.rates.velocity.get(name, (0.0, 0.0))), links
        at, link = self._at(found[1]), FRAME if found[2] == "0" else found[2]
        base = self.scene.links[link][0]
        turned = 1j * float(self.rates.omega.get(link, 0.0)) * (at - self._at(base))
        return at, complex(*self.rates.velocity.get(base, (0.0, 0.0))) + turned, {link}

    def _at(self, name: str) -> complex:
        return complex(*map(float, self.scene.points[name]))

    def normal(self, K: str, X: str) -> complex:
        """The normal acceleration of K about X, points of one link."""
        (k, v, one), (x, w, two) = self.place(K), self.place(X)
        if not one & two & self.rates.omega.keys():  # a bar that stands for a contact turns as its ends go
            return abs((v - w) / (k - x)) ** 2 * (x - k)
        (link,) = one & two & self.rates.omega.keys()
        return float(self.rates.omega[link]) ** 2 * (x - k)

    def coriolis(self, B: str, on: str) -> list[complex]:
        """The Coriolis acceleration of B relative to the point under it, as either of their links turns."""
        (_, v, one), (_, w, two) = self.place(B), self.place(on)
        return [2j * float(self.rates.omega.get(link, 0.0)) * (v - w) for link in one ^ two]


@pytest.mark.parametrize("plan", PLANS)
def test_a_vector_is_the_acceleration_that_its_sentence_names(plan: str) -> None:
    """From the mark that it is laid off from to the new one runs the normal acceleration of the first named point about
    the second, or its Coriolis acceleration relative to it, as the solver has them."""
    normals = slides = 0
    for name in CORE:
        drawing = gp.construct(gp.load(name), plan=plan)
        motion, values = Motion(drawing.scene), drawing.values
        least = 1e-9 * drawing.scene.extent
        for step, points in told(drawing, NORMAL):
            assert step.root is not None
            drawn = complex(*values[step.index]) - complex(*values[step.root])
            true = drawing.kappa**2 * motion.normal(*points)
            assert abs(drawn - true) <= max(1e-6 * abs(true), least), (name, step.why)
            normals += 1
        for step, points in told(drawing, CORIOLIS):
            assert step.root is not None
            half = complex(*values[step.index]) - complex(*values[step.root])  # it is laid off twice
            true = [drawing.kappa**2 * vector / 2 for vector in motion.coriolis(*points)]
            assert any(abs(half - vector) <= max(1e-6 * abs(vector), least) for vector in true), (name, step.why)
            slides += 1
    assert normals > 8
    assert slides > 0


def test_letters_are_those_of_one_thing() -> None:
    """No two points' loci have one letter; corners of polygons have numerals, as figures are those of links."""
    assert len(set(GREEK.values())) == len(GREEK)
    assert [roman(number) for number in (1, 4, 9, 14, 40, 49, 90, 148)] == [
        "I", "IV", "IX", "XIV", "XL", "XLIX", "XC", "CXLVIII"]
    assert not [step.name for step in gp.construct(gp.load("jaanimets-10")).drawn.steps if step.name.isdigit()]
