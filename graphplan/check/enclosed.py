"""A scene between proven bounds: what fractions cannot hold of it, reckoned once more from what is written."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from graphplan.check.arithmetics import Arithmetic
from graphplan.errors import Refused
from graphplan.mechanism.directions import Misfit, vector
from graphplan.mechanism.model import Balance, Drive, Pair, Scene, Slide, TurningDrive
from graphplan.mechanism.numerals import is_exact
from graphplan.mechanism.placements import placed_by


def enclosed(scene: Scene, by: Arithmetic) -> Scene:
    """The scene in numbers with bounds: placements, angles and rpm as written, any other float as it is.

    Points that the scene's floats hold for one, and that cannot be told apart, are one. Fails with `Refused` where
    arcs miss each other that touch to a float's digits.
    """
    return _Enclosing(scene, by).scene()


@dataclass(frozen=True)
class _Enclosing:
    """A scene as it is taken over into other numbers."""

    given: Scene
    by: Arithmetic

    def scene(self) -> Scene:
        """The same scene in these numbers."""
        scene = self.given
        try:
            points = self._points()
            found = scene.posed(points, lambda one: self._direction(one, points))
        except Misfit as misfit:
            raise Refused(f"{scene.name}: points", misfit.what, misfit.instead) from None
        driven = found.with_drives(map(self._turning, found.drives))
        return replace(driven, **{part: self._known(getattr(driven, part))
                                  for part in ("points", "written", "loads", "motions")})

    def _points(self) -> dict[str, Pair]:
        """Every point where its placement puts it; coinciding ones are the very same."""
        scene, lift = self.given, self.by.lift
        if not scene.irrational:
            return scene.points
        placed = placed_by(scene.placements, self.by.reckoning)
        first: dict[Pair, Pair] = {}
        points: dict[str, Pair] = {}
        for name, at in scene.points.items():
            here = at if is_exact(at) else placed.get(name, at)
            other = first.setdefault(at, here)
            same = all(lift(p).overlaps(lift(q)) for p, q in zip(here, other, strict=True))
            points[name] = other if same else here
        return points

    def _direction(self, thing: Slide | Balance, points: dict[str, Pair]) -> Any:
        """The direction of a slide or balance as it is written."""
        if thing.written is None:
            return thing.direction
        return vector(thing.written, points.__getitem__, self.by.reckoning)[:2]

    def _turning(self, drive: Drive) -> Drive:
        """A drive whose turns a minute are written."""
        if isinstance(drive, TurningDrive) and drive.rpm:
            return drive.driven_at(self.by.pi() * drive.rpm / 30, drive.alpha)
        return drive

    def _known(self, thing: Any) -> Any:
        """The same with every float in it as the binary fraction that it is."""
        if isinstance(thing, float):
            return self.by.lift(thing)
        if isinstance(thing, tuple):
            return tuple(map(self._known, thing))
        if isinstance(thing, dict):
            return {name: self._known(part) for name, part in thing.items()}
        if is_dataclass(thing) and not isinstance(thing, type):
            return replace(thing, **{part.name: self._known(getattr(thing, part.name)) for part in fields(thing)})
        return thing
