"""A scene between proven bounds: what fractions cannot hold of it, reckoned once more from what is written."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, TypeVar

from graphplan.check.arithmetics import Arithmetic
from graphplan.errors import Refused
from graphplan.mechanism.directions import Misfit, vector
from graphplan.mechanism.model import Balance, Drive, Pair, Scene, Slide, TurningDrive
from graphplan.mechanism.numerals import is_exact
from graphplan.mechanism.placements import placed_by

Directed = TypeVar("Directed", Slide, Balance)


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
        scene, loads = self.given, self.given.loads
        try:
            points = self._points()
            slides = tuple(self._directed(slide, points) for slide in scene.slides)
            balances = tuple(self._directed(balance, points) for balance in loads.balances) if loads else ()
        except Misfit as misfit:
            raise Refused(f"{scene.name}: points", misfit.what, misfit.instead) from None
        if loads:
            loads = replace(self._known(loads), balances=self._known(balances))
        return replace(scene, points=self._known(points), slides=self._known(slides), loads=loads,
                       drives=tuple(map(self._drive, scene.drives)), motions=self._known(scene.motions))

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

    def _directed(self, thing: Directed, points: dict[str, Pair]) -> Directed:
        """A slide or balance along its direction as written."""
        if thing.written is None:
            return thing
        x, y, _ = vector(thing.written, points.__getitem__, self.by.reckoning)
        return replace(thing, direction=(x, y))

    def _drive(self, drive: Drive) -> Drive:
        if isinstance(drive, TurningDrive) and drive.rpm:
            omega: Any = self.by.pi() * drive.rpm / 30
            return replace(drive, omega=omega, alpha=self._known(drive.alpha))
        known: Drive = self._known(drive)
        return known

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
