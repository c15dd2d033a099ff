"""What is true of sampled poses: rates by elimination in fractions, positions to 50 digits by Newton on all lengths."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from typing import Any

import mpmath
import numpy as np
from numpy.typing import NDArray

import graphplan as gp

DIGITS = 50
SAMPLES = 20

Pair = tuple[Fraction, Fraction]
Points = Mapping[str, NDArray[np.complex128]]
Motion = Mapping[str, Points]  # complex arrays over poses by kind (points, velocity, acceleration) and point
Truth = dict[str, dict[str, Pair]]  # of one pose: fractions by kind and point


def sample(n: int) -> list[int]:
    """The places of the poses that are looked at, of n."""
    return sorted({round(k) for k in np.linspace(0, n - 1, SAMPLES)})


def of_poses(scene: gp.Scene, points: Points) -> dict[int, Truth]:
    """What is true of poses given by coordinates, which are taken as the binary numbers they are."""
    places = sample(len(next(iter(points.values()))))
    return {i: rates(scene, {name: (Fraction(z[i].real), Fraction(z[i].imag)) for name, z in points.items()})
            for i in places}


def of_travel(scene: gp.Scene, travel: NDArray[Any], near: Points) -> dict[int, Truth]:
    """What is true where the crank has turned by these angles and the rest is assembled, near some floats."""
    return {i: rates(scene, assembled(scene, travel[i], {name: z[i] for name, z in near.items()}))
            for i in sample(len(travel))}


def rates(scene: gp.Scene, points: Mapping[str, Pair]) -> Truth:
    """The rates in one pose, without any rounding."""
    found = gp.analytic.solve(replace(scene, points={**scene.points, **points}), exact=True)
    return {"points": dict(points), "velocity": found.velocity, "acceleration": found.acceleration}


def assembled(scene: gp.Scene, travel: float, near: Mapping[str, complex]) -> dict[str, Pair]:
    """The pose of a linkage of revolute joints, its crank turned by `travel`, in decimals of 50 digits."""
    with mpmath.workdps(DIGITS):
        given = {name: mpmath.mpc(*(mpmath.mpf(x.numerator) / x.denominator for x in map(Fraction, at)))
                 for name, at in scene.points.items()}
        crank = scene.links[scene.drives[0].link]
        (O,) = (name for name in crank if name in scene.links[scene.frame])
        placed = {name: given[name] for name in scene.links[scene.frame]}
        placed |= {name: given[O] + (given[name] - given[O]) * mpmath.expj(travel) for name in crank}
        free = [name for name in scene.points if name not in placed]
        sides = [pair for link in scene.links.values() for pair in combinations(link, 2) if set(pair) & set(free)]

        def misfits(*parts: Any) -> list[Any]:
            at = placed | {name: mpmath.mpc(*parts[2 * k : 2 * k + 2]) for k, name in enumerate(free)}
            return [square(at[p] - at[q]) - square(given[p] - given[q]) for p, q in sides]

        start = [part for name in free for part in (near[name].real, near[name].imag)]
        found = iter(mpmath.findroot(misfits, start))
        placed |= {name: mpmath.mpc(next(found), next(found)) for name in free}
        return {name: (fraction(z.real), fraction(z.imag)) for name, z in placed.items() if name in near}


def square(z: Any) -> Any:
    """The square of a length."""
    return z.real**2 + z.imag**2


def fraction(x: Any) -> Fraction:
    """A long decimal number as a fraction."""
    return Fraction(mpmath.nstr(x, DIGITS))


def error(motion: Motion, truths: Mapping[int, Truth]) -> float:
    """The largest error of the sampled poses, relative to the largest value of its kind in the pose."""
    return max(missed(z[i], truth[kind][name]) / largest(truth[kind])
               for i, truth in truths.items() for kind, found in motion.items() for name, z in found.items())


def missed(z: complex, true: Pair) -> float:
    """How far a complex number is from two fractions."""
    return abs(complex(float(Fraction(z.real) - true[0]), float(Fraction(z.imag) - true[1])))


def largest(vectors: Mapping[str, Pair]) -> float:
    """The length of the longest of these vectors."""
    return max(abs(complex(*map(float, vector))) for vector in vectors.values())
