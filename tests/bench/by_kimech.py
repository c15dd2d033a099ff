"""A scene of revolute joints as a kimech mechanism: bodies with local frames, joints, and a driver of its crank.

kimech solves the constraint equations of all bodies pose after pose, each from the one before: positions by scipy's
root finder, then velocities and accelerations by linear systems. It takes no poses, only the crank's angles.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from kimech import KinematicDriver, KinematicSolution, Link, Mechanism, Point, solve
from numpy.typing import NDArray

import graphplan as gp


class Kimech:
    """The scene's mechanism, to be solved over angles of its crank from the given pose."""

    def __init__(self, scene: gp.Scene):
        self.places = {name: np.array([float(x), float(y)]) for name, (x, y) in scene.points.items()}
        self.mechanism = Mechanism(scene.name)
        self.points: dict[tuple[str, str], Point] = {}
        self.guess: dict[Link, NDArray[np.float64]] = {}
        for link, names in scene.links.items():
            self._add(link, names, link == scene.frame)
        (self.drive,) = scene.drives
        joints = {(one, two): self.mechanism.revolute(self.points[one, p], self.points[two, p])
                  for p in scene.joints for one, two in pairwise(sorted(scene.links_of[p], key=scene.frame.__ne__))}
        self.crank = joints[scene.frame, self.drive.link]
        self.moving = {p: self.points[links[0], p] for p, links in scene.links_of.items()
                       if scene.frame not in links}

    def _add(self, link: str, names: tuple[str, ...], ground: bool) -> None:
        """One body; its frame is that of the sheet, moved to the link's first point."""
        body = self.mechanism.ground if ground else self.mechanism.add_link(link)
        start = np.zeros(2) if ground else self.places[names[0]]
        for name in names:
            self.points[link, name] = body.add_point(name, self.places[name] - start)
        if not ground:
            self.guess[body] = np.array([*start, 0.0])

    def positions(self, travel: NDArray[Any]) -> KinematicSolution:
        """The positions alone."""
        return solve(self.mechanism, drivers=KinematicDriver(self.crank, position=travel), initial_guess=self.guess)

    def motion(self, travel: NDArray[Any]) -> KinematicSolution:
        """Positions, velocities and accelerations."""
        omega, alpha = float(self.drive.rate), float(self.drive.change)
        driver = KinematicDriver(self.crank, position=travel, velocity=omega, acceleration=alpha)
        return solve(self.mechanism, drivers=driver, initial_guess=self.guess)

    def read(self, solution: KinematicSolution) -> dict[str, dict[str, NDArray[np.complex128]]]:
        """Positions, velocities and accelerations of every moving joint, as complex arrays."""
        found = {"points": solution.point_positions, "velocity": solution.point_velocities,
                 "acceleration": solution.point_accelerations}
        return {kind: {name: of(point) @ np.array([1, 1j]) for name, point in self.moving.items()}
                for kind, of in found.items()}
