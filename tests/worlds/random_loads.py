"""Random loads on a mechanism: masses, forces, moments and a balance, all small whole numbers."""

from __future__ import annotations

from random import Random

import graphplan as gp

GRAVITY = "gravity = [0, -9.81]\n"


def loaded(scene: gp.Scene, seed: int, balance: str = "") -> gp.Scene:
    """The scene with loads on its links, which asks for all reactions and for no motion; its driving link is balanced
    unless another table of a balance is given."""
    random = Random(seed)

    def number() -> int:
        return random.randint(-9, 9)

    tables = [f'[masses.{link}]\nmass = {random.randint(1, 5)}\ninertia = {random.randint(0, 3)}\n'
              f'centre = "{random.choice(scene.links[link])}"' for link in scene.moving if random.random() < 0.6]
    tables += [f'[[forces]]\non = "{link}"\nat = "{random.choice(scene.links[link])}"\nvalue = {[number(), number()]}'
               for link in scene.moving if random.random() < 0.5]
    tables += [f'[[moments]]\non = "{link}"\nvalue = {number()}' for link in scene.moving if random.random() < 0.4]
    tables.append(balance or f'[balance]\nlink = "{scene.drives[0].link}"')
    given = scene.text.partition("[find]")[0]
    return gp.parse("\n".join([GRAVITY + given, *tables, '[find]\nreactions = "all"\n']), "random")
