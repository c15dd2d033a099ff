"""Random loads on random linkages: masses at any point, forces, moments, gravity, and any balances that hold them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random

from linkages import FRAME, Linkage, linkage

import graphplan as gp

TRIES = 40  # sets of balances that are tried


def loaded_scenes(seed: int, orders: int = 2, made: Callable[[int], Linkage] = linkage) -> Iterator[gp.Scene]:
    """A loaded linkage, as it came and in further orders of writing; none where no balance that was tried holds it."""
    random = Random(seed)
    found = made(seed)
    found.loads += _loads(found, random)
    find = _asked(found, random)
    gravity = random.choice(("", "gravity = [0, -10]\n", "gravity = [3, -9.81]\n"))
    for _ in range(TRIES):
        held = "\n".join(_balance(found, random) for _ in found.drives)
        try:
            for number in range(orders):
                text = found.text(Random(number) if number else None)
                yield gp.parse(gravity + text.replace("[find]", f"{held}\n[find]") + find, f"random {seed}")
            return
        except gp.SceneError:
            continue


def rubbing(found: Linkage, random: Random, journals: bool) -> Iterator[str]:
    """Friction in every slide, and in some journals."""
    for one, two in found.guided:
        yield f'[[friction]]\nslide = ["{one}", "{two}"]\ncoefficient = {random.choice((0.1, 0.3))}'
    for point in _joints(found) if journals else ():
        if random.random() < 0.7:
            yield f'[[friction]]\nat = "{point}"\nradius = {random.choice((0.1, 0.5))}\ncoefficient = 0.2'


def _loads(found: Linkage, random: Random) -> Iterator[str]:
    """What acts on the moving links, in every fifth scene nothing."""
    if random.random() < 0.2:
        return
    for link, points in found.links.items():
        if link == FRAME:
            continue
        if random.random() < 0.5:
            mass, inertia = random.choice((0, 1, 2, 5)), random.choice((0, 0, 1, 0.2))
            yield f'[masses.{link}]\nmass = {mass}\ninertia = {inertia}\ncentre = "{random.choice(points)}"'
        while random.random() < 0.4:
            value = [random.randint(-99, 99), random.randint(-99, 99)]
            yield f'[[forces]]\non = "{link}"\nat = "{random.choice(points)}"\nvalue = {value}'
        if random.random() < 0.3:
            yield f'[[moments]]\non = "{link}"\nvalue = {random.randint(-20, 20)}'


def _balance(found: Linkage, random: Random) -> str:
    """A moment on any link, or a force at any of its points."""
    link = random.choice([link for link in found.links if link != FRAME])
    if random.random() < 0.6:
        return f'[[balance]]\nlink = "{link}"'
    at, way = random.choice(found.links[link]), [random.randint(-5, 5), random.choice((-3, 2))]
    return f'[[balance]]\non = "{link}"\nat = "{at}"\ndirection = {way}'


def _asked(found: Linkage, random: Random) -> str:
    """All reactions, or some by name, or none."""
    if random.random() < 0.5:
        return 'reactions = "all"\n'
    names = [*_joints(found), *(f"{one} along {two}" for one, two in found.guided)]
    chosen = random.sample(names, min(len(names), random.randint(0, 2)))
    return "reactions = [" + ", ".join(f'"{name}"' for name in chosen) + "]\n"


def _joints(found: Linkage) -> list[str]:
    return [point for point in found.points if sum(point in own for own in found.links.values()) > 1]
