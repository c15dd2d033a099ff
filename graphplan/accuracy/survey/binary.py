"""Scenes in the binary numbers that a machine holds, and what is true of their motion to the last digit.

Each coordinate, drive and direction is taken as the fraction that its float is: so every arithmetic is asked about the
very same pose, and an error is its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from importlib.util import find_spec
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism.model import Find, Motion, Pair, Scene, Slide
from graphplan.solver import Rates, solve

BITS = 256  # of enclosures that stand for the truth: some 70 digits


def binary(scene: Scene) -> Scene:
    """The motion of a scene in binary fractions: velocities and accelerations of the points asked for, or of all."""
    joints = scene.find.velocity or scene.joints
    driven = scene.with_drives(drive.driven_at(*_pair(drive.rates)) for drive in scene.drives)
    found = replace(driven, irrational=(), placements={}, loads=None,
                    find=Find(joints, scene.find.acceleration or joints),
                    motions={name: Motion(_pair(m.velocity), _pair(m.acceleration))
                             for name, m in scene.motions.items()})
    return placed(found, {})


def placed(scene: Scene, places: Mapping[str, complex]) -> Scene:
    """A binary scene with some points elsewhere; guides through two points turn with them."""
    points: dict[str, Pair] = {name: _pair(at) for name, at in scene.points.items()}
    points |= {name: (Fraction(z.real), Fraction(z.imag)) for name, z in places.items()}

    def direction(slide: Slide) -> tuple[Fraction, Fraction]:
        if slide.through is None:
            return _pair(slide.direction)
        (ax, ay), (bx, by) = (_pair(points[name]) for name in slide.through)
        return bx - ax, by - ay

    return scene.posed(points, direction)


def truth(scene: Scene) -> Rates:
    """What is true of a binary scene: in fractions, or beyond fifty digits where a root is irrational.

    Fails with `Refused` where that would need enclosures and they are not installed, with `SingularPose` as `solve`.
    """
    try:
        return solve(scene, exact=True)
    except Refused:
        if find_spec("flint") is None:
            raise
    from graphplan.check.arithmetics import bounded_rates, enclosures
    from graphplan.kernel.numbers.enclosures import precision

    with precision(BITS):
        rates = bounded_rates(scene, enclosures(BITS))
        return replace(rates, velocity=_middles(rates.velocity), acceleration=_middles(rates.acceleration))


def _middles(vectors: dict[str, Any]) -> dict[str, Pair]:
    """Enclosed vectors as the fractions in their middles."""
    return {name: (x.middle, y.middle) for name, (x, y) in vectors.items()}


def _pair(pair: Pair) -> tuple[Fraction, Fraction]:
    x, y = (Fraction(float(number)) for number in pair)
    return x, y
