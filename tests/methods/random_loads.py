"""Random loads on a mechanism: masses, forces, moments and a balance, all small whole numbers."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from random import Random

from graphplan.mechanism.model import Balance, Find, Force, Loads, Mass, Moment, Scene


def loaded(scene: Scene, seed: int, balance: Balance | None = None) -> Scene:
    """The scene with loads on its links; its driving link is balanced unless another balance is given."""
    random = Random(seed)

    def number() -> Fraction:
        return Fraction(random.randint(-9, 9))

    masses = {link: Mass(Fraction(random.randint(1, 5)), Fraction(random.randint(0, 3)),
                         random.choice(scene.links[link]))
              for link in scene.moving if random.random() < 0.6}
    forces = tuple(Force(link, random.choice(scene.links[link]), (number(), number()))
                   for link in scene.moving if random.random() < 0.5)
    moments = tuple(Moment(link, number()) for link in scene.moving if random.random() < 0.4)
    gravity = Fraction(0), Fraction(-981, 100)
    balances = (balance or Balance(scene.drives[0].link),)
    return replace(scene, loads=Loads(gravity, masses, forces, moments, balances), find=Find((), ()))
