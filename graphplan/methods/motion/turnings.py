"""How links turn beside each other: as slides hold them and drives prescribe, whatever the pose.

A slide makes two links turn alike, a turning drive by a given difference.
"""

from __future__ import annotations

from typing import NamedTuple

from graphplan.mechanism.model import FRAME, Number, Scene
from graphplan.mechanism.order import ordered_slides, turning_drives


class AngularRates(NamedTuple):
    """An angular velocity and an angular acceleration."""

    omega: Number
    alpha: Number


class Turnings:
    """How the links of a scene turn beside each other; asked link by link."""

    def __init__(self, scene: Scene):
        self._beside: dict[str, list[tuple[str, AngularRates]]] = {}
        self._found: dict[str, dict[str, AngularRates]] = {}
        for slide in ordered_slides(scene):
            if slide.turns_alike:
                self._join(*slide.links, AngularRates(0, 0))
        for drive in turning_drives(scene):
            self._join(*drive.links, AngularRates(*drive.rates))

    def _join(self, link: str, other: str, more: AngularRates) -> None:
        self._beside.setdefault(link, []).append((other, more))
        self._beside.setdefault(other, []).append((link, AngularRates(-more.omega, -more.alpha)))

    def alike(self, link: str) -> dict[str, AngularRates]:
        """The links whose turning differs from this one's by given rates, and by how much this link exceeds each."""
        if link not in self._found:
            found = self._found[link] = {link: AngularRates(0, 0)}
            waiting = [link]
            for here in waiting:
                for other, more in self._beside.get(here, ()):
                    if other not in found:
                        found[other] = AngularRates(found[here].omega + more.omega, found[here].alpha + more.alpha)
                        waiting.append(other)
        return self._found[link]

    def given(self, link: str) -> AngularRates | None:
        """The rates that the drives prescribe for a link: by how much it exceeds the frame."""
        return self.alike(link).get(FRAME)
