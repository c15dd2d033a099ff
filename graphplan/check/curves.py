"""Curves of a cycle: the motion of a link, of a slide or of a point's coordinate, with its rates from the plans."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np

from graphplan.check.cycle import Cycle
from graphplan.cycle.curves import Curve, followed
from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Scene, Slide
from graphplan.methods.panels import slide_named
from graphplan.phrases import Said, said

TURN = 2 * np.pi
MOST = 4  # diagrams that stand side by side


@dataclass(frozen=True)
class Quantity:
    """What is to be plotted: how it is called, its unit, and the points whose rates tell it."""

    name: str
    label: Said
    unit: str
    points: tuple[str, ...]
    slide: Slide | None = None


def quantities(scene: Scene, names: Sequence[str] = ()) -> tuple[Quantity, ...]:
    """What these names mean: links, slides, coordinates such as `B.x`; without names what the mechanism drives.

    Fails with `Refused` where a name means nothing, where there are too many, or where the first drive has no constant
    rate, so that nothing can be told over time.
    """
    drive = scene.drives[0] if scene.drives else None
    if drive is None or not drive.rate or drive.change:
        raise Refused("diagrams", "the first drive has no constant rate: nothing can be told over time",
                      "a [[drive]] with a rate and without acceleration")
    names = names or _driven(scene)
    if len(names) > MOST:
        raise Refused("diagrams", f"{len(names)} are too many for one sheet", f"at most {MOST}")
    return tuple(_quantity(scene, name) for name in names)


def asking(scene: Scene, wanted: Sequence[Quantity]) -> Scene:
    """The scene, asking also for what these quantities are told by."""
    find = scene.find
    points = [point for quantity in wanted for point in quantity.points]
    velocity, acceleration = (tuple(p for p in scene.points if p in {*asked, *points})
                              for asked in (find.velocity, find.acceleration))
    names = [quantity.name for quantity in wanted]
    links, slides = (None if asked is None else tuple(name for name in known if name in {*asked, *names})
                     for asked, known in ((find.links, scene.moving), (find.slides, [s.name for s in scene.slides])))
    return replace(scene, find=replace(find, velocity=velocity, acceleration=acceleration, links=links, slides=slides))


def curves(found: Cycle, wanted: Sequence[Quantity]) -> list[Curve]:
    """The curves of these quantities over the cycle, which was asked for them."""
    drive = found.scene.drives[0]
    period = TURN if found.closed and not found.faults else None
    unit = found.scene.units.length if drive.slides else "rad"
    return [followed(quantity.label, quantity.unit, found.turn.travel, float(drive.rate), *_ordinates(found, quantity),
                     period=period, travel_unit=unit) for quantity in wanted]


def _driven(scene: Scene) -> list[str]:
    """The slides on the frame, and the links that turn on it, that no drive moves."""
    driven = {drive.links[0] for drive in scene.drives}
    outputs = [s.name for s in scene.slides if FRAME in (s.along, s.link) and s.link not in driven]
    fixed = set(scene.links.get(FRAME, ()))
    outputs += [link for link in scene.moving if link not in driven and fixed & set(scene.links[link])]
    return outputs[:MOST] or [link for link in scene.moving if link not in driven and len(scene.links[link]) > 1][:1]


def _quantity(scene: Scene, name: str) -> Quantity:
    length = scene.units.length
    slide = next((s for s in scene.slides if s.name == name), None)
    point, _, axis = name.rpartition(".")
    if slide is not None:
        return Quantity(name, said("slide {0}", slide_named(slide)), length, (slide.at,), slide)
    if len(scene.links.get(name, ())) > 1 and name != FRAME:
        return Quantity(name, said("angle of link {0}", name), "rad", _side(scene, name))
    if point in scene.points and axis in ("x", "y"):
        return Quantity(name, said("{0} of {1}", axis, point), length, (point,))
    links = [link for link in scene.moving if len(scene.links[link]) > 1]
    known = [*links, *(s.name for s in scene.slides), *(f"{p}.x" for p in scene.points)]
    raise Refused(f"diagram of {name}", "the scene has no such thing", f"one of {', '.join(known)}")


def _side(scene: Scene, link: str) -> tuple[str, str]:
    """The two points of a link that lie furthest apart."""
    places = {name: complex(*map(float, scene.points[name])) for name in scene.links[link]}
    return max(combinations(places, 2), key=lambda pair: abs(places[pair[0]] - places[pair[1]]))


def _ordinates(found: Cycle, quantity: Quantity) -> tuple[Any, Any, Any]:
    """The quantity, its rate, and the rate's rate in each pose."""
    points, results = found.turn.points, found.results
    if quantity.slide is not None:
        return _slid(found, quantity.slide)
    if quantity.unit == "rad":
        P, R = quantity.points
        return np.angle(points[R] - points[P]), results["omega"][quantity.name], results["alpha"][quantity.name]
    (point,) = quantity.points
    vectors = points[point], results["velocity"][point], results["acceleration"][point]
    s, v, a = (z.real if quantity.name.endswith(".x") else z.imag for z in vectors)
    return s, v, a


def _slid(found: Cycle, slide: Slide) -> tuple[Any, Any, Any]:
    """How far a slide's point has slid along its guide from the given pose, with its rates there."""
    points, guides, results = found.turn.points, found.turn.guides, found.results
    if slide.through:
        along = points[slide.through[1]] - points[slide.through[0]]
    else:
        along = guides.get(slide.name, complex(*map(float, slide.direction)))
    along = along / np.abs(along)
    carrier = next(iter(found.scene.links.get(slide.along, ())), "")
    seat = points[slide.at] - (points[carrier] if carrier else 0.0)
    vectors = seat, results["slide velocity"][slide.name], results["slide acceleration"][slide.name]
    s, v, a = ((z / along).real for z in vectors)
    return s - s[0], v, a
