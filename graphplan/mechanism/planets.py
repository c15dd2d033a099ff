"""Planets of a planetary gear: how many, equally spaced, can be assembled and have room.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 21-13: (21.46), in which z2 is misprinted for z3, and
(21.47).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import count, product, takewhile

from graphplan.mechanism.model import Scene
from graphplan.mechanism.pairs.gear import Gear
from graphplan.phrases import Said, join, said


def planet_counts(sun: Fraction, planet: Fraction, ring: Fraction) -> list[int]:
    """Return the possible numbers k of equal planets between a sun and a ring, by their numbers of teeth: (z1 + z3)/k
    is whole, so that they can be assembled, and sin(pi/k) > (z2 + 2)/(z1 + z2), so that neighbours do not touch."""
    room = float((planet + 2) / (sun + planet))
    return [1, *(k for k in takewhile(lambda k: math.sin(math.pi / k) > room, count(2)) if (sun + ring) % k == 0)]


def planet_remarks(scene: Scene) -> Iterator[Said]:
    """Yield for each planet between a sun and a ring about one centre how many of them there may be."""
    for outer, ring in product(scene.gears, repeat=2):
        if teeth := _teeth_of_set(outer, ring):
            yield said("possible numbers of planets like {0}, equally spaced: {1} (assembly and room, Ozols 1974, "
                       "(21.46), (21.47))", ring.wheels[0], join(planet_counts(*teeth)))


def _teeth_of_set(outer: Gear, ring: Gear) -> tuple[Fraction, Fraction, Fraction] | None:
    """Return the teeth of sun, planet and ring, where the planet of a ring meshes with a sun about the ring's centre.
    """
    if not (outer.teeth and ring.teeth and ring.internal) or outer.internal or outer.belt or (
            ring.wheels[0] not in outer.wheels):
        return None
    place = outer.wheels.index(ring.wheels[0])
    is_set = (outer.centres[place], outer.centres[1 - place]) == ring.centres and outer.teeth[place] == ring.teeth[0]
    return (outer.teeth[1 - place], ring.teeth[0], ring.teeth[1]) if is_set else None
