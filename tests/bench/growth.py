"""Growth: the time of planning and recording a construction, from 50 to 1,000 links."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from statistics import quantiles

import numpy as np
from harness import Row, alternate, duration

import graphplan as gp
from graphplan.mechanism.model import FRAME, Find, Scene, TurningDrive, Units

LINKS = (50, 100, 200, 400, 700, 1000)
LINEAR = 1.1  # the exponent up to which growth counts as linear


def rows() -> list[Row]:
    """The exponent of the time over the number of links, fitted on logarithms, in each round."""
    scenes = {str(links): dyads((links - 2) // 2) for links in LINKS}
    times = alternate({name: partial(gp.construct, scene) for name, scene in scenes.items()})
    sizes = np.log([len(scene.links) for scene in scenes.values()])
    exponents = [float(np.polyfit(sizes, np.log(spent), 1)[0]) for spent in zip(*times.values(), strict=True)]
    low, middle, high = quantiles(exponents, n=4)
    spent = ", ".join(duration(quantiles(times[str(links)], n=4)[1]) for links in (LINKS[0], LINKS[-1]))
    met = "yes" if middle <= LINEAR else "no"
    return [Row(f"planning, {LINKS[0]} to {LINKS[-1]:,} links", "exponent", f"≤ {LINEAR}", f"{middle:.3g}",
                f"{low:.3g} to {high:.3g}", met, spent)]


def dyads(n: int) -> Scene:
    """A crank and n dyads, each between a pivot of the frame and the last dyad's joint: 2 n + 2 links."""
    points = {"O": (0, 0), "P0": (3, 4)}
    links = {FRAME: ["O"], "1": ["O", "P0"]}
    for k in range(1, n + 1):
        points |= {f"R{k}": (10 * k, 0), f"P{k}": (10 * k + 3, 4 + k % 3)}
        links |= {f"{2 * k}": [f"P{k - 1}", f"P{k}"], f"{2 * k + 1}": [f"P{k}", f"R{k}"]}
        links[FRAME].append(f"R{k}")
    joints = tuple(f"P{k}" for k in range(n + 1))
    return Scene(
        title="chain of dyads", source="", name="dyads", units=Units(),
        points={name: (Fraction(x), Fraction(y)) for name, (x, y) in points.items()}, placements={},
        links={name: tuple(names) for name, names in links.items()}, slides=(),
        drives=(TurningDrive("1", FRAME, Fraction(1), Fraction(0)),), motions={}, find=Find(joints, joints),
    )
