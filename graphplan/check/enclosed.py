"""A scene between proven bounds: what fractions cannot hold of it, reckoned once more from what is written."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from fractions import Fraction
from typing import Any, TypeVar

from graphplan.errors import Refused
from graphplan.kernel.numbers.enclosures import Enclosure, Undecided, heading, pi
from graphplan.mechanism.directions import Misfit, vector
from graphplan.mechanism.model import Balance, Drive, Pair, Scene, Slide, TurningDrive
from graphplan.mechanism.numerals import TO_A_FLOAT, Reckoning
from graphplan.mechanism.placements import is_exact, placed_by

Directed = TypeVar("Directed", Slide, Balance)


def enclosed(scene: Scene) -> Scene:
    """The scene at the working precision: placements, angles and rpm as written, any other float as it is.

    Points that the scene's floats hold for one, and that cannot be told apart, are one. Fails with `Refused` where
    arcs miss each other that touch to a float's digits, and with `Undecided` where that cannot be told.
    """
    try:
        points = _points(scene)
        slides = tuple(_directed(slide, points) for slide in scene.slides)
        balances = tuple(_directed(balance, points) for balance in scene.loads.balances) if scene.loads else ()
    except Misfit as misfit:
        raise Refused(f"{scene.name}: points", misfit.what, misfit.instead) from None
    except Undecided:
        raise Undecided("whether the arcs of its points meet cannot be told") from None
    loads = replace(_known(scene.loads), balances=_known(balances)) if scene.loads else None
    return replace(scene, points=_known(points), slides=_known(slides), drives=tuple(map(_drive, scene.drives)),
                   motions=_known(scene.motions), loads=loads)


def _points(scene: Scene) -> dict[str, Pair]:
    """Every point where its placement puts it; coinciding ones are the very same."""
    placed = placed_by(scene.placements, SHARPLY)
    first: dict[Pair, Pair] = {}
    points: dict[str, Pair] = {}
    for name, at in scene.points.items():
        here = at if is_exact(at) else placed.get(name, at)
        other = first.setdefault(at, here)
        same = all(Enclosure(p).overlaps(Enclosure(q)) for p, q in zip(here, other, strict=True))
        points[name] = other if same else here
    return points


def _directed(thing: Directed, points: dict[str, Pair]) -> Directed:
    """A slide or balance along its direction as written."""
    if thing.written is None:
        return thing
    x, y, _ = vector(thing.written, points.__getitem__, SHARPLY)
    return replace(thing, direction=(x, y))


def _drive(drive: Drive) -> Drive:
    if isinstance(drive, TurningDrive) and drive.rpm:
        omega: Any = pi() * drive.rpm / 30
        return replace(drive, omega=omega, alpha=_known(drive.alpha))
    known: Drive = _known(drive)
    return known


def _known(thing: Any) -> Any:
    """The same with every float in it as the binary fraction that it is."""
    if isinstance(thing, float):
        return Enclosure(thing)
    if isinstance(thing, tuple):
        return tuple(map(_known, thing))
    if isinstance(thing, dict):
        return {name: _known(part) for name, part in thing.items()}
    if is_dataclass(thing) and not isinstance(thing, type):
        return replace(thing, **{part.name: _known(getattr(thing, part.name)) for part in fields(thing)})
    return thing


def _root(square: Any) -> tuple[Any, bool]:
    """The square root, as a fraction where it is one."""
    if isinstance(square, Fraction):
        root, exact = TO_A_FLOAT.root(square)
        if exact:
            return root, True
    return Enclosure(square).root, False


def _heading(degrees: Fraction) -> tuple[Any, Any, bool]:
    """Cosine and sine, as fractions where they are."""
    return TO_A_FLOAT.heading(degrees) if degrees % 90 == 0 else (*heading(degrees), False)


SHARPLY = Reckoning(_root, _heading)
