"""The frame of a linkage on paper: its free pins, and the points that the scene places from those by compasses,
protractor or scale."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from graphplan.cycle.dyads import PlacedLink
from graphplan.cycle.tolerances import PIN_TOL
from graphplan.kernel.kinds import Movement, made_by
from graphplan.kernel.tape.record import Symbol, Symbols
from graphplan.mechanism.fields import vector
from graphplan.mechanism.model import FRAME, Placement, Scene
from graphplan.mechanism.numbers import exactly
from graphplan.mechanism.placements import needs
from graphplan.sheet.plates.view import View

Spot = tuple[Any, Any]  # symbols, or numbers where nothing moves it


class Ground:
    """The frame as compass rules read a link: its points where they are dragged, all else where it was given.

    `free` are the pins that may be dragged. Points that give a guide of the frame its direction stay, and those
    that hold the wheels of a pair apart: with them the wheels would be others.
    """

    def __init__(self, domain: Symbols, scene: Scene, view: View, places: Mapping[str, complex]):
        self.domain, self.scene, self.view, self.places = domain, scene, view, places
        self.fixed = {end for slide in scene.slides if slide.along == FRAME for end in slide.through or ()}
        self.fixed |= {end for gear in scene.gears if {*gear.centres} <= {*scene.links.get(FRAME, ())}
                       for end in gear.centres}
        self.free: list[str] = []
        self.pins: dict[str, Planar] = {}
        for name in self._fixed_points():
            self.pins[name] = self._pin(name)

    def point(self, place: complex) -> Planar:
        """Where the frame's point is that was given at this place."""
        pin = next((name for name in self.pins if abs(self.places[name] - place) < PIN_TOL), None)
        return planar(place) if pin is None else self.pins[pin]

    def ray(self, along: complex) -> Planar:
        """Where a direction points that was given so."""
        return planar(along)

    def shifted_to(self, origin: complex, base: Any) -> PlacedLink:
        """A link that turns as the frame does, and has this point."""
        return PlacedLink(origin, base, planar(1.0))

    def _fixed_points(self) -> list[str]:
        """The points of the frame and of no link, each after those that place it; contacts touch where they touch."""
        touching = {contact.at for contact in self.scene.contacts}
        still = [name for name, links in self.scene.links_of.items()
                 if FRAME in links or not (links or name in touching)]
        ordered: list[str] = []
        while remaining := [name for name in still if name not in ordered]:
            ready = [name for name in remaining if {*self._placers(name, still)} <= {*ordered}]
            ordered += ready or remaining
        return ordered

    def _placers(self, name: str, still: Sequence[str]) -> tuple[str, ...]:
        """The points from which a point of the frame is placed, if all are of the frame themselves."""
        placement = self.scene.placements.get(name)
        on = needs(placement) if placement and name not in self.fixed else ()
        return on if {*on} <= {*still} else ()

    def _pin(self, name: str) -> Planar:
        """A point of the frame: free, or as the scene places it from others."""
        place = self.scene.placements.get(name)
        if place and self._placers(name, [*self.pins]):
            x, y = self._apply_placement(name, place,
                                         {pin_name: (pin.re, pin.im) for pin_name, pin in self.pins.items()})
            return Planar(x, y)
        if name in self.fixed:
            return planar(self.places[name])
        self.free.append(name)
        return Planar(self.domain.tape.input(f"x {name}"), self.domain.tape.input(f"y {name}"))

    def _apply_placement(self, name: str, placement: Placement, at: Mapping[str, Spot]) -> Any:
        """Where a placement by distance, angle or compasses puts a point."""
        data: dict[str, Any] = placement.data
        scale = self.view.scale
        if placement.how == "polar":
            (x, y), off = at[data["from"]], self.places[name] - self.places[data["from"]]
            return x + off.real, y + off.imag
        if placement.how == "compass":
            arcs = [(*at[centre], (scale * float(r)) ** 2) for centre, r in data["distances"].items()]
            return made_by(Movement.ARCS_MET).rule(self.domain, *arcs, side=data["side"])
        if placement.how == "on-line":
            P, Q = (planar(at[end]) for end in data["on"].split())
            at_distance = P + (Q - P) * (scale * float(data["distance"]) / ((Q - P).real**2 + (Q - P).imag**2).sqrt())
            return at_distance.re, at_distance.im
        ((centre, r),) = data["distances"].items()
        through, towards = data["on"]["through"], data["on"]["direction"]
        x, y = at[through] if isinstance(through, str) else self.view((float(through[0]), float(through[1])))
        dx, dy = self._direction(towards, at)
        line, arc = (-dy, dx, dy * x - dx * y), (*at[centre], (scale * float(r)) ** 2)
        return made_by(Movement.CUT).rule(self.domain, line, arc, way="on" if data["pick"] == "right" else "back")

    def _direction(self, way: Any, at: Mapping[str, Spot]) -> Spot:
        """A direction: of two points, or as it is given."""
        if isinstance(way, str) and len(ends := way.split()) == 2:
            (x, y), (u, v) = (at[end] for end in ends)
            return u - x, v - y
        x, y, _ = vector(way, lambda name: exactly(self.scene.points[name]))
        return float(x), float(y)


# ---- complex numbers of a tape: the compass rules are recorded as they stand -----------------------------------------


class Planar:
    """A complex number of symbols, as the compass rules compute with it."""

    __slots__ = ("im", "re")

    def __init__(self, re: Any, im: Any = 0.0):
        self.re, self.im = re, im

    @property
    def real(self) -> Planar:
        return Planar(self.re)

    @property
    def imag(self) -> Planar:
        return Planar(self.im)

    def conj(self) -> Planar:
        return Planar(self.re, -self.im)

    def sqrt(self) -> Planar:
        """The square root of a real number: numpy asks for it by this name."""
        return Planar(self.re.tape.sqrt(self.re.place) if isinstance(self.re, Symbol) else math.sqrt(self.re))

    def __add__(self, other: Any) -> Planar:
        other = planar(other)
        return Planar(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Any) -> Planar:
        return self + -planar(other)

    def __rsub__(self, other: Any) -> Planar:
        return planar(other) + -self

    def __neg__(self) -> Planar:
        return Planar(-self.re, -self.im)

    def __mul__(self, other: Any) -> Planar:
        other = planar(other)
        return Planar(_product(self.re, other.re) - _product(self.im, other.im),
                      _product(self.re, other.im) + _product(self.im, other.re))

    def __truediv__(self, other: Any) -> Planar:
        other = planar(other)
        if _is_zero(other.im):
            return Planar(self.re / other.re, 0.0 if _is_zero(self.im) else self.im / other.re)
        square = other.re * other.re + other.im * other.im
        product = self * other.conj()
        return Planar(product.re / square, product.im / square)

    def __pow__(self, power: int) -> Planar:
        assert power == 2
        return self * self

    def __rtruediv__(self, other: Any) -> Planar:
        return planar(other) / self

    __radd__, __rmul__ = __add__, __mul__


def _is_zero(number: Any) -> bool:
    return not isinstance(number, Symbol) and number == 0


def _product(one: Any, two: Any) -> Any:
    return 0.0 if _is_zero(one) or _is_zero(two) else one * two


def planar(number: Any) -> Planar:
    """Any number, or pair of them, as a complex one."""
    if isinstance(number, Planar):
        return number
    return Planar(*number) if isinstance(number, tuple) else Planar(float(number.real), float(number.imag))
