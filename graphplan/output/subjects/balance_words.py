"""What the sheet of a linkage's balancing says: masses, drives, principal vectors, counterweights, forces, checks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.check.balance import FULL, GUIDED, NONE, SHARED, Balancing, MassMotion
from graphplan.machine.linkages.engine import Engine
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.units import KILOGRAMS, METRES
from graphplan.output.panelled import Words
from graphplan.output.subjects.balance_numbers import links, principal_vectors, variant, weight_told
from graphplan.output.tolerances import ZERO_TOL
from graphplan.phrases import Said, arrange, digits, join, said, unit

WAYS = {FULL: said("fully: the mass centre stands still"),
        GUIDED: said("partly: the mass centre moves along the guide"),
        SHARED: said("partly: what rotates, and a share of what reciprocates"), NONE: said("not")}
OPINIONS = {"path": said("path"), "velocity": said("velocity"), "acceleration": said("acceleration"),
            "shaking force": said("shaking force"), "shaking moment": said("shaking moment"),
            "counterweights": said("counterweights"), "orders": said("orders")}


@dataclass(frozen=True)
class BalanceWords:
    """The words of one sheet."""

    balancing: Balancing

    @property
    def before(self) -> MassMotion:
        """The linkage as it is given."""
        return self.balancing.before

    @property
    def scene(self) -> Scene:
        return self.before.centre.scene

    def given(self) -> Iterator[Words]:
        """The masses, and where their centres are."""
        length = self.scene.units.length
        told = links(self.before)
        rows: list[list[Said | str]] = [[said("link"), arrange("m, {0}", unit("kg")), arrange("s, {0}", unit(length)),
                                         arrange("k, {0}", unit(length))]]
        for name, link in told.items():
            rows.append([name, digits(link["mass"]), *(digits(clean(link.get(key, 0.0), link.get("length", 1.0)))
                                                       for key in ("s", "offset"))])
        yield said("Masses of the links, and their centres: s along the link from its first joint, k to its left:")
        yield rows
        for drive in self.scene.drives:
            rate = arrange("{0} {1}", digits(float(drive.rate)), unit(f"{length}/s" if drive.slides else "rad/s"))
            yield said("Drive of link {0}: {1}", drive.link, rate)

    def found(self) -> Iterator[Words]:
        """Principal vectors, counterweights, the largest forces before and after, and the checks."""
        scene, length = self.scene, unit(self.scene.units.length)
        mass = digits(float(KILOGRAMS[scene.units.mass] * self.before.centre.mass))
        yield said("Mass of the moving links: {0} {1}", mass, unit("kg"))
        for letter, z, per in (("v", self.before.velocity, "/s"), ("a", self.before.acceleration, "/s²")):
            if self._posed is not None:
                x, y = (digits(float(part), 5) for part in (z[self._posed].real, z[self._posed].imag))
                yield arrange("{0}_S = ({1}, {2}) {3}", letter, x, y, unit(f"{scene.units.length}{per}"))
        heads: list[Said | str] = [said("link"), arrange("h, {0}", length), arrange("ξ, {0}", length)]
        rows = [[name, digits(one["h"], 5), digits(clean(one["offset"], one["length"]), 4)]
                for name, one in principal_vectors(self.before).items()]
        yield said("Principal vectors, along the links and square to them:")
        yield [heads, *rows]
        yield arrange("{0}: {1}", said("Balanced"), WAYS[self.balancing.method])
        if self.balancing.note:
            yield self.balancing.note
        yield from self._weights_told()
        yield from self._largest()
        if self.balancing.engine:
            yield from _engine_told(self.balancing.engine)
        parts = [join((OPINIONS[name], digits(size, 2)), " ") for name, size in self.balancing.check.items()]
        yield said("Second opinions differ by: {0}", join(parts))

    @cached_property
    def sizes(self) -> tuple[float, float]:
        """The size of the links' own forces, and of their moments: what is nothing beside them is rounding."""
        metre, scene = float(METRES[self.scene.units.length]), self.scene
        least = ZERO_TOL * float(KILOGRAMS[scene.units.mass] * self.before.centre.mass) * scene.extent * metre
        force = max(least, *(float(np.nanmax(np.abs(part))) for part in self.before.shaking.parts.values()))
        return force, force * scene.extent * metre

    @property
    def _posed(self) -> int | None:
        """The place of the given pose among the positions."""
        there = np.flatnonzero(self.before.travel == 0)
        return int(there[0]) if there.size and np.isfinite(self.before.path[there[0]]) else None

    def _weights_told(self) -> Iterator[Words]:
        """The counterweights in a table, and which variant they make."""
        if not self.balancing.weights:
            return
        rows: list[list[Said | str]] = [[said("link"), arrange("m r, {0}", unit("kg m")), "°", arrange(
            "r, {0}", unit(self.scene.units.length)), arrange("m, {0}", unit("kg"))]]
        for weight in self.balancing.weights:
            one = weight_told(self.scene, weight)
            rows.append([one["link"], *(digits(one[key], 5) for key in ("mass_radius", "angle", "radius", "mass"))])
        yield said("Counterweights, where they stand in this pose:")
        yield rows
        if self.balancing.after is not None and (name := variant(self.balancing.after)):
            yield said("Variant {0} of table 16-1", name)

    def _largest(self) -> Iterator[Words]:
        """The largest shaking force and moment."""
        rows: list[list[Said | str]] = [["", arrange("J, {0}", unit("N")), arrange("M, {0}", unit("N m"))]]
        for words, motion in ((said("before"), self.before), (said("balanced"), self.balancing.after)):
            if motion is not None:
                found = zip((motion.shaking.force, motion.shaking.moment), self.sizes, strict=True)
                largest = (clean(float(np.nanmax(np.abs(values))), size) for values, size in found)
                rows.append([words, *(digits(one, 5) for one in largest)])
        base = self.before.centre.base
        about = base if FRAME in self.scene.links_of[base] else "(0, 0)"
        yield said("Largest shaking force, and moment about {0}:", about)
        yield rows


def _engine_told(engine: Engine) -> Iterator[Words]:
    """The reduced masses and the forces of an engine."""
    kg, newtons = unit("kg"), unit("N")
    yield said("Engine: rotating mass {0} {2}, reciprocating mass {1} {2}", digits(engine.rotating),
               digits(engine.reciprocating), kg)
    forces = [digits(abs(force)) for force in (engine.centrifugal, engine.order(1), engine.order(2))]
    yield said("Inertia force of what rotates: {0} {3}; of the first order: {1} {3}; of the second: {2} {3}", *forces,
               newtons)


def clean(value: float, size: float) -> float:
    """A value, or zero where it is nothing beside a size."""
    return float(cleaned(np.asarray(value), size))


def cleaned(values: Any, size: float) -> Any:
    """Values, zero where they are nothing beside a size."""
    return np.where(np.abs(values) < ZERO_TOL * size, 0.0, values)
