"""Linkages with masses, in metres, for the tests of mass centres and balancing."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from typing import Any

import graphplan as gp

Masses = Sequence[tuple[float, float, float]]  # of each link: its mass, s along it from its first joint, k left of it


def four_bar(masses: Masses, angle: float = 0.3, lengths: Sequence[float] = (0.1, 0.35, 0.3, 0.4), **more: Any,
             ) -> gp.Scene:
    """The four-bar linkage O-A-B-D of some lengths, its crank at an angle in radians."""
    l, a, b, d = lengths
    O, D, A = 0j, complex(d), cmath.rect(l, angle)
    far = abs(D - A)
    along = (a * a - b * b + far * far) / (2 * far)
    B = A + (D - A) / far * complex(along, (a * a - along * along) ** 0.5)
    places = {"O": O, "D": D, "A": A, "B": B} | centres([(O, A), (A, B), (B, D)], masses)
    return scene(places, {"1": "O A S1", "2": "A B S2", "3": "B D S3", "frame": "O D"}, masses, **more)


def slider_crank(masses: Masses, angle: float = 0.3, lengths: Sequence[float] = (0.1, 0.4), offset: float = 0.03,
                 **more: Any) -> gp.Scene:
    """The slider-crank mechanism O-A-B whose guide is `offset` above its crank's hinge, in metres."""
    l, a = lengths
    A = cmath.rect(l, angle)
    B = complex(A.real + (a * a - (offset - A.imag) ** 2) ** 0.5, offset)
    places = {"O": 0j, "A": A, "B": B} | centres([(0j, A), (A, B), (B, B + 1)], masses)
    guide = {"link": "3", "along": "frame", "at": "B", "direction": [1, 0]}
    return scene(places, {"1": "O A S1", "2": "A B S2", "3": "B S3", "frame": "O"}, masses, slides=[guide], **more)


def centres(lines: Sequence[tuple[complex, complex]], masses: Masses) -> dict[str, complex]:
    """The mass centres of links along these lines."""
    rays = [(end - start) / abs(end - start) for start, end in lines]
    return {f"S{k}": start + ray * complex(s, side)
            for k, ((start, _), ray, (_, s, side)) in enumerate(zip(lines, rays, masses, strict=True), 1)}


def scene(places: dict[str, complex], links: dict[str, str], masses: Masses, omega: float = 10, **more: Any,
          ) -> gp.Scene:
    """A scene of these points, links and masses, and more tables."""
    return gp.scene({
        "units": {"length": "m"}, "points": {name: [z.real, z.imag] for name, z in places.items()}, "links": links,
        "drive": [{"link": "1", "omega": omega}], "balance": {"link": "1"}, **more,
        "masses": {f"{k}": {"mass": m, "inertia": k / 100, "centre": f"S{k}"} for k, (m, _, _) in enumerate(masses, 1)},
    })
