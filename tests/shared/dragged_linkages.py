"""A linkage that is dragged, by a method of its own: every link's place and angle, led from the given pose in small
steps, so that it stays on its branch; where it cannot be led there, the pose does not exist on it.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from graphplan.mechanism.model import FRAME, Scene

STAGES, A_RADIAN, CORRECTIONS = 20, 40, 4  # stages of any drag, and for each radian of travel or length of the linkage


class DraggedLinkage:
    """A scene with fixed pins (scene units) and travels of its drives (radians or lengths) elsewhere."""

    def __init__(self, scene: Scene):
        self.scene = scene
        self.places = {name: complex(float(x), float(y)) for name, (x, y) in scene.points.items()}
        self.still = {name for name, links in scene.links_of.items()
                      if not links or FRAME in links or name in scene.motions}
        self.links = {link: k for k, link in enumerate(scene.moving)}
        self.size = scene.extent

    def dragged(self, pins: Mapping[str, complex], travels: Sequence[float]) -> dict[str, complex] | None:
        """Where all points are, or none where they cannot be brought there."""
        found = self.led(pins, travels)
        if found is None:
            return None
        return {name: found[1](name) for name in self.places}

    def guides(self, pins: Mapping[str, complex], travels: Sequence[float]) -> dict[str, complex]:
        """Where the guides point that ride on links, in a pose that can be reached."""
        found = self.led(pins, travels)
        assert found is not None
        angles = {link: found[0][3 * k + 2] for link, k in self.links.items()}
        return {slide.name: complex(*map(float, slide.direction)) * cmath.exp(1j * angles[slide.along])
                for slide in self.scene.slides if slide.through is None and slide.along != FRAME}

    def led(self, pins: Mapping[str, complex], travels: Sequence[float]) -> tuple[Any, Any] | None:
        """The poses of the links, and where any point is."""
        now = np.zeros(3 * len(self.links))
        sign = 0.0
        far = max((abs(t) / (self.size if drive.slides else 1.0) for t, drive in zip(travels, self.scene.drives,
                                                                                     strict=True)), default=0.0)
        stages = STAGES + int(A_RADIAN * far)
        for stage in range(stages + 1):
            part = stage / stages
            at = {name: self.places[name] + part * (z - self.places[name]) for name, z in pins.items()}
            goal = [part * travel for travel in travels]
            for _ in range(CORRECTIONS):
                left, slope = self._left(now, at, goal)
                step = np.linalg.solve(slope, left)
                now = now - step
                if not np.isfinite(now).all() or abs(step).max() > 0.5:
                    return None
            turned = np.sign(np.linalg.det(slope))
            if abs(step).max() > 1e-8 or (sign and turned != sign):
                return None
            sign = turned
        return now, lambda name: self._point(now, at, name)[0]

    def _on(self, now: Any, at: Mapping[str, complex], link: str, name: str) -> tuple[complex, Any]:
        """A point of a link, with its derivatives."""
        rate = np.zeros(3 * len(self.links), dtype=complex)
        if link == FRAME or (name in self.scene.motions and link == ""):
            return at.get(name, self.places[name]), rate
        k = 3 * self.links[link]
        x, y, angle = now[k : k + 3]
        arm = self.places[name] * cmath.exp(1j * angle)
        rate[k : k + 3] = self.size, 1j * self.size, 1j * arm
        return self.size * complex(x, y) + arm, rate

    def _point(self, now: Any, at: Mapping[str, complex], name: str) -> tuple[complex, Any]:
        links = self.scene.links_of[name]
        return self._on(now, at, FRAME if name in self.still else links[0], name)

    def _left(self, now: Any, at: Mapping[str, complex], goal: Sequence[float]) -> tuple[Any, Any]:
        """What is left open, and its derivatives."""
        rows: list[tuple[float, Any]] = []

        def angle(link: str) -> tuple[float, Any]:
            rate = np.zeros(3 * len(self.links))
            if link == FRAME:
                return 0.0, rate
            rate[3 * self.links[link] + 2] = 1.0
            return now[3 * self.links[link] + 2], rate

        for name, links in self.scene.links_of.items():
            here = [FRAME, *(link for link in links if link != FRAME)] if name in self.still else [*links]
            for other in here[1:]:
                (p, dp), (q, dq) = self._on(now, at, here[0], name), self._on(now, at, other, name)
                rows += [((p - q).real, (dp - dq).real), ((p - q).imag, (dp - dq).imag)]

        def along(slide: Any, travel: float, way: complex) -> None:
            (p, dp), (a, da) = self._on(now, at, slide.link, slide.at), angle(slide.along)
            rest, dr = (self.places[slide.at], 0 * dp) if slide.along == FRAME else self._on(now, at, slide.along,
                                                                                             slide.at)
            ray = way * complex(*map(float, slide.direction))
            ray *= cmath.exp(1j * a) / abs(ray)
            gap = (p - rest) * ray.conjugate()
            rows.append((gap.real - travel, ((dp - dr) * ray.conjugate() - 1j * gap * da).real))

        for slide in self.scene.slides:
            (a, da), (b, db) = angle(slide.link), angle(slide.along)
            rows.append((self.size * (a - b), self.size * (da - db)))
            along(slide, 0.0, 1j)
        for drive, travel in zip(self.scene.drives, goal, strict=True):
            if drive.slides:
                along(self.scene.driven_slide(drive), travel, 1.0)
                continue
            (a, da), (b, db) = angle(drive.link), angle(drive.on)
            rows.append((self.size * (a - b - travel), self.size * (da - db)))
        return np.array([left for left, _ in rows]), np.array([rate for _, rate in rows])
