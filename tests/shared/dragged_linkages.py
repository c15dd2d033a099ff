"""A linkage that is dragged, by a method of its own: every link's place and angle, led from the given pose in small
steps, so that it stays on its branch; where it cannot be led there, the pose does not exist on it.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from graphplan.mechanism.model import FRAME, Contact, Scene
from graphplan.mechanism.replaced import guides

STAGES, A_RADIAN, CORRECTIONS = 20, 40, 6  # stages of any drag, and for each radian of travel or length of the linkage


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
        now, point = found
        places = {name: point(name) for name in self.places}
        for contact in self.scene.contacts:
            if not self.scene.links_of[contact.at]:
                places[contact.at] = self._touching(contact, now, places)
        return places

    def _touching(self, contact: Contact, now: Any, places: Mapping[str, complex]) -> complex:
        """Where two profiles touch."""
        one, other = contact.centres
        if one and other:
            return places[one] + self._share(contact) * (places[other] - places[one])
        guide = guides(self.scene)[contact.name]
        turn = 0.0 if guide.along == FRAME else now[3 * self.links[guide.along] + 2]
        return places[guide.at] + (self.places[contact.at] - self.places[guide.at]) * cmath.exp(1j * turn)

    def _share(self, contact: Contact) -> float:
        """At which part of the way from centre to centre two arcs touch."""
        at, one, other = (self.places[name or ""] for name in (contact.at, *contact.centres))
        return ((at - one) / (other - one)).real

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
        self.turned = dict[str, float]()  # how far lines of centres have turned in all
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

        def geared(name: str, links: Sequence[str], centres: Sequence[Any], factors: Sequence[float]) -> None:
            (b, db), (c, dc) = (self._on(now, at, *end) for end in zip(links, centres, strict=True))
            line, last = (c - b) / (self.places[centres[1]] - self.places[centres[0]]), self.turned.get(name, 0.0)
            self.turned[name] = last + cmath.phase(line * cmath.exp(-1j * last))
            ends = *map(angle, links), (self.turned[name], ((dc - db) / (c - b)).imag)
            weights = *factors, -sum(factors)
            whole = self.size / max(map(abs, weights))
            rows.append((whole * sum(w * a for w, (a, _) in zip(weights, ends, strict=True)),
                         whole * sum(w * da for w, (_, da) in zip(weights, ends, strict=True))))

        def rolling(guide: Any, lever: float) -> None:
            along(guide, 0.0, 1.0)
            (gone, rate), (a, da), (b, db) = rows.pop(), angle(guide.link), angle(guide.along)
            rows.append((gone + lever * (a - b), rate + lever * (da - db)))

        straight = guides(self.scene)
        for gear in self.scene.gears:
            if gear.name in straight:
                rolling(straight[gear.name], float(gear.radius))
            else:
                geared(gear.name, gear.links, gear.centres, [*map(float, gear.factors)])
        for contact in self.scene.contacts:
            if contact.name in straight:
                guide = straight[contact.name]
                along(guide, 0.0, 1j)
                ray = complex(*map(float, guide.direction))
                arm = (self.places[contact.at] - self.places[guide.at]) / (ray / abs(ray))
                if contact.rolling:
                    rolling(guide, -arm.imag)
                continue
            (b, db), (c, dc) = (self._on(now, at, *end) for end in zip(contact.links, contact.centres, strict=True))
            given = abs(self.places[contact.centres[1] or ""] - self.places[contact.centres[0] or ""])
            rows.append((abs(c - b) - given, ((dc - db) * (c - b).conjugate()).real / abs(c - b)))
            if contact.rolling:
                part = self._share(contact)
                geared(contact.name, contact.links, contact.centres, (part, 1 - part))
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
