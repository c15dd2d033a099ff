"""Random cam tasks, and a contact search of its own: how high an outline lifts the follower that it touches."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Sequence
from itertools import pairwise
from random import Random

import numpy as np

MOTIONS = "uniform", "parabolic", "harmonic", "sine", "trapezoid", "3-4-5"
FINE = math.radians(0.1)  # between points of an arc
Points = np.ndarray


def task_text(seed: int) -> str:
    """A task with a rise, a return and perhaps dwells or a second rise, for any follower."""
    rng = Random(seed)
    kind = rng.choice(("point", "roller", "flat", "roller", "flat"))
    moves = rng.choice(("translating", "translating", "oscillating"))
    unit = rng.choice((1.0, 1.0, 0.01, 30.0))
    lines = _law(rng, moves == "oscillating", kind == "flat", unit)
    base = rng.choice((40, 60, 100)) * unit
    lines += ["[follower]", f'moves = "{moves}"', f'contact = "{kind}"']
    if kind == "roller":
        lines.append(f"radius = {rng.choice((0.1, 0.2, 0.3)) * base!r}")
    if moves == "oscillating":
        lines.append(f"centre_distance = {rng.choice((2.2, 2.5, 3)) * base!r}")
        lines += [f"arm = {rng.uniform(1.9, 2.3) * base!r}"] if kind != "flat" else []
    if (moves == "oscillating") == (kind == "flat"):
        lines.append(f"offset = {rng.choice((0, 0, -0.1, 0.2)) * base!r}")
    size = repr(base)
    if kind == "flat" and rng.random() < 0.3:
        size = f'"convex"\nleast_radius = {rng.choice((0.05, 0.2)) * base!r}'
    lines += ["[cam]", f'turns = "{rng.choice(("clockwise", "counter-clockwise"))}"', "omega = 10", f"base = {size}",
              "pressure_angle = { rise = 80, return = 80 }"]
    return "\n".join(lines) + "\n"


def _law(rng: Random, swings: bool, flat: bool, unit: float) -> list[str]:
    """Stages of 360 degrees, which go up and come down again."""
    ups = rng.choice(((1, -1), (1, 0, -1, 0), (1, -1, 0), (0, 1, 0, -1), (1, 1, -1, 0), (1, 0, 1, -1, 0)))
    cuts = sorted(rng.sample(range(2, 35), len(ups) - 1)) if rng.random() < 0.3 else [
        round(36 * (k + 1) / len(ups)) + rng.choice((-1, 0, 0, 1)) for k in range(len(ups) - 1)]
    angles = [10 * (high - low) for low, high in pairwise((0, *cuts, 36))]
    stroke = rng.choice((4, 8, 12, 20)) * (unit if not swings else 0.7) * (0.5 if flat else 1.0)
    found = list[str]()
    for angle, way in zip(angles, ups, strict=True):
        rise = stroke if way > 0 else -stroke * sum(one > 0 for one in ups)
        motion = rng.choice(MOTIONS[1:] if rng.random() < 0.9 else MOTIONS)
        found += ["[[law]]", f"angle = {angle}", f'motion = "{motion if way else "dwell"}"']
        found += [f"stroke = {rise!r}"] if way else []
    return found


# ---- the search ------------------------------------------------------------------------------------------------------


def outline(arcs: Sequence[Sequence[float]]) -> Points:
    """Points of a closed outline of arcs, each where it starts with its bulge, close to each other, complex."""
    found = []
    starts = [complex(x, y) for x, y, _ in arcs]
    for (*_, bulge), start, after in zip(arcs, starts, (*starts[1:], starts[0]), strict=True):
        half = (after - start) / 2
        count = max(8, math.ceil(4 * math.atan(abs(bulge)) / FINE))
        if abs(bulge) < 1e-7:
            own = np.linspace(-1, 1, count, endpoint=False) + 0j
        else:
            phi = np.linspace(-1, 1, count, endpoint=False) * 2 * math.atan(bulge)
            own = ((1 + bulge**2) * np.sin(phi) + 1j * ((1 - bulge**2) - (1 + bulge**2) * np.cos(phi))) / (2 * bulge)
        found.append(start + half * (1 + own))
    return np.concatenate(found)


class Follower:
    """A cam's follower as its task gives it, and the search for where the outline holds it."""

    def __init__(self, text: str, base: float):
        tables = tomllib.loads(text)
        own, turns = tables["follower"], tables["cam"]["turns"]
        self.base, self.sense = base, 1 if turns == "counter-clockwise" else -1
        self.flat, self.swings = own["contact"] == "flat", own["moves"] == "oscillating"
        self.roller, self.offset = own.get("radius", 0.0), own.get("offset", 0.0)
        self.arm, self.distance = own.get("arm", 0.0), own.get("centre_distance", 0.0)

    def lifted(self, spots: Points, angle: float) -> float:
        """How far the cam has lifted it when it has turned by an angle in degrees; an arm radians."""
        here = spots * np.exp(1j * self.sense * math.radians(angle))
        if not self.swings:
            if self.flat:
                return float(here.imag.max()) - self.base
            off = self.sense * self.offset
            return _highest(here.real - off, here.imag, self.roller) - math.sqrt(self.base**2 - off**2)
        ways = self.distance - here  # from the spots to the pivot
        far, turned = abs(ways), -np.angle(ways)
        if self.flat:
            return float((np.arcsin(self.offset / far) + turned).max()) - math.asin(
                (self.base + self.offset) / self.distance)
        arm, distance = self.arm, self.distance
        least = math.acos((arm**2 + distance**2 - self.base**2) / (2 * arm * distance))
        if not self.roller:
            return _highest(far - arm, turned, 0.0) - least
        with np.errstate(invalid="ignore"):
            return float(np.nanmax(turned + np.arccos((arm**2 + far**2 - self.roller**2) / (2 * arm * far)))) - least


def _highest(across: Points, up: Points, roller: float) -> float:
    """How high a roller stands, or a point on the polygon, whose path is where nothing is across."""
    if roller:
        with np.errstate(invalid="ignore"):
            return float(np.nanmax(up + np.sqrt(roller**2 - across**2)))
    after, above = np.roll(across, -1), np.roll(up, -1)
    met = (across <= 0) != (after <= 0)
    part = across[met] / (across[met] - after[met])
    return float((up[met] + part * (above[met] - up[met])).max())
