"""Linkages with masses, in metres, for the tests of mass centres and balancing."""

from __future__ import annotations

import math
from collections.abc import Sequence

from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse

Masses = Sequence[tuple[float, float, float]]  # of each link: its mass, s along it from its first joint, k left of it

HEAD = '[units]\nlength = "m"\n[points]\n'
DRIVE = '[[drive]]\nlink = "1"\nomega = 10\n[balance]\nlink = "1"\n'


def four_bar(masses: Masses, angle: float = 0.3, lengths: Sequence[float] = (0.1, 0.35, 0.3, 0.4)) -> Scene:
    """The four-bar linkage O-A-B-D of some lengths, its crank at an angle in radians."""
    l, a, b, d = lengths
    O, D, A = 0j, complex(d), l * complex(math.cos(angle), math.sin(angle))
    far = abs(D - A)
    along = (a * a - b * b + far * far) / (2 * far)
    B = A + (D - A) / far * complex(along, math.sqrt(a * a - along * along))
    places = {"O": O, "D": D, "A": A, "B": B} | centres([(O, A), (A, B), (B, D)], masses)
    links = {"1": "O A S1", "2": "A B S2", "3": "B D S3", "frame": "O D"}
    return scene(places, links, masses, "")


def slider_crank(masses: Masses, angle: float = 0.3, lengths: Sequence[float] = (0.1, 0.4), offset: float = 0.03,
                 ) -> Scene:
    """The slider-crank mechanism O-A-B whose guide is `offset` above its crank's hinge, in metres."""
    l, a = lengths
    A = l * complex(math.cos(angle), math.sin(angle))
    B = complex(A.real + math.sqrt(a * a - (offset - A.imag) ** 2), offset)
    places = {"O": 0j, "A": A, "B": B} | centres([(0j, A), (A, B), (B, B + 1)], masses)
    links = {"1": "O A S1", "2": "A B S2", "3": "B S3", "frame": "O"}
    return scene(places, links, masses, '[[slides]]\nlink = "3"\nalong = "frame"\nat = "B"\ndirection = [1, 0]\n')


def centres(lines: Sequence[tuple[complex, complex]], masses: Masses) -> dict[str, complex]:
    """The mass centres of links along these lines."""
    rays = [(end - start) / abs(end - start) for start, end in lines]
    return {f"S{k}": start + ray * complex(s, side)
            for k, ((start, _), ray, (_, s, side)) in enumerate(zip(lines, rays, masses, strict=True), 1)}


def scene(places: dict[str, complex], links: dict[str, str], masses: Masses, more: str, tail: str = DRIVE) -> Scene:
    """A scene of these points, links and masses."""
    text = [HEAD, *(f"{name} = [{z.real!r}, {z.imag!r}]\n" for name, z in places.items()), "[links]\n",
            *(f'{name} = "{points}"\n' for name, points in links.items()), more, tail]
    text += [f'[masses.{k}]\nmass = {m!r}\ninertia = {0.01 * k}\ncentre = "S{k}"\n'
             for k, (m, _, _) in enumerate(masses, 1)]
    return parse("".join(text), "linkage")
