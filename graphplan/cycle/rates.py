"""How links lie and move in many poses: their rates by the drive's travel, from the closures of their groups."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle import closure, newton
from graphplan.cycle.closure import TRAVEL, Body, Drive, Layout, Vector
from graphplan.cycle.groups import Group
from graphplan.cycle.linkage import Array, Linkage
from graphplan.mechanism.model import FRAME


class Moved(NamedTuple):
    """A link in n poses: its base, which was given at `origin`, and its turn; how both change with the drive's travel,
    the turn as an angle. All are arrays of shape (n,), complex but for the last."""

    origin: complex
    base: Array
    turn: Array
    velocity: Array
    spin: Array

    def carried_back(self, places: Array) -> Array:
        """Where places of the plane were on the link as it was given."""
        return self.origin + (places - self.base) * self.turn.conj()

    def velocity_at(self, places: Array) -> Array:
        """How its points at some places of the plane move."""
        return self.velocity + 1j * self.spin * (places - self.base)


def moved(linkage: Linkage, groups: Sequence[Group], travel: Array, points: Mapping[str, Array],
          turns: Mapping[str, Array]) -> dict[str, Moved]:
    """How every link lies and moves where its points and turns are so; nan where they are, and where it is singular."""
    frame, reach, still = linkage.origins[FRAME], linkage.reach, np.zeros(travel.shape)
    bodies = {FRAME: Body()}
    turns = {**turns, **dict(_turned_arms(linkage, points))}
    for link in linkage.links[1:]:
        origin, pin = linkage.origins[link], next(iter(linkage.points(link)), "")
        at = points[pin] + turns[link] * (origin - linkage.places[pin]) if pin else points[linkage.lines.arms[link].at]
        bodies[link] = Body(_pair((at - frame) / reach), _pair(turns[link]))
    for group in groups:
        _move(group, bodies, travel)
    found = {FRAME: Moved(frame, still + frame, still + 1.0, still + 0j, still)}
    for link in linkage.links[1:]:
        body = bodies[link]
        (x, y), spin = body.moves.get(TRAVEL, (0.0, 0.0)), body.spin.get(TRAVEL, 0.0)
        found[link] = Moved(linkage.origins[link], frame + reach * _complex(body.base), turns[link],
                            reach * _complex((x, y)) + still, spin + still)
    return found


def _turned_arms(linkage: Linkage, points: Mapping[str, Array]) -> Iterator[tuple[str, Array]]:
    """How the arms turn that are thought in."""
    for name, gear in linkage.lines.arms.items():
        line, given = points[gear.other] - points[gear.at], linkage.places[gear.other] - linkage.places[gear.at]
        yield name, line / np.abs(line) / (given / abs(given))


def _move(group: Group, bodies: dict[str, Body], travel: Array) -> None:
    """Enter how the links of a group move."""
    known = [bodies[link] for link in (FRAME, *group.carriers)]
    drives = [Drive(drive.at, rate) for drive, (_, rate) in zip(group.read(travel, ())[0], group.drives, strict=True)]
    state = _state(group.layout, [*known, *(bodies[link] for link in group.links)], group.arms)
    links = closure.bodies(group.layout, known, group.arms, drives, state)
    with np.errstate(all="ignore"):
        rows = closure.left_open(group.layout, links, group.arms, drives)
        rates = newton.step(rows, group.unknowns, np.sqrt).rates
    for link, body in zip(group.links, links[len(known):], strict=True):
        *velocity, spin = newton.rates_of(body, rates)
        bodies[link] = Body(bodies[link].base, bodies[link].turn, {TRAVEL: tuple(velocity)}, {TRAVEL: spin})


def _state(layout: Layout, links: Sequence[Body], arms: Sequence[Vector]) -> list[Any]:
    """The unknowns of a group where its links lie so: cosine and sine of the angles, then displacements."""
    found: list[Any] = [links[spin.link].turn for spin in layout.spins if spin.on is None]
    for seat in layout.seats:
        base = _complex(links[seat.link].base)
        if seat.on is None:
            away = base - (complex(*arms[seat.arm]) if seat.arm is not None else 0.0)
            found += _pair(away)
        elif seat.way is not None and seat.guide is not None and seat.drive is None:
            on, guide = links[seat.on], links[seat.guide]
            arm = _turned(on, arms[seat.arm]) if seat.arm is not None else 0.0
            ray = _turned(guide, arms[seat.way])
            found.append(((base - _complex(on.base) - arm) * np.conj(ray)).real)
    return found


def _turned(body: Body, vector: Vector) -> Any:
    return _complex(closure.rotated(body.turn, vector))


def _complex(vector: Any) -> Any:
    return vector[0] + 1j * vector[1]


def _pair(z: Any) -> tuple[Any, Any]:
    return z.real, z.imag
