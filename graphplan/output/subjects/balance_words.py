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
from graphplan.output.panelled import Words, check_words
from graphplan.output.subjects.balance_numbers import links, principal_vectors, variant, weight_numbers
from graphplan.output.tolerances import ZERO_TOL
from graphplan.phrases import Said, arrange, digits, said, unit

WAYS = {FULL: said("fully: the mass centre stands still"),
        GUIDED: said("partly: the mass centre moves along the guide"),
        SHARED: said("partly: what rotates, and a share of what reciprocates"), NONE: said("not")}


@dataclass(frozen=True)
class BalanceWords:
    """The words of one sheet."""

    balancing: Balancing

    @property
    def given_motion(self) -> MassMotion:
        """The linkage as it is given."""
        return self.balancing.before

    @property
    def scene(self) -> Scene:
        return self.given_motion.centre.scene

    def given_data(self) -> Iterator[Words]:
        """The masses, and where their centres are."""
        length = self.scene.units.length
        told = links(self.given_motion)
        rows: list[list[Said | str]] = [[said("link"), arrange("m, {0}", unit("kg")), arrange("s, {0}", unit(length)),
                                         arrange("k, {0}", unit(length))]]
        for name, link in told.items():
            rows.append([name, digits(link["mass"]),
                         *(digits(clear_rounding_of(link.get(key, 0.0), link.get("length", 1.0)))
                           for key in ("s", "offset"))])
        yield said("Masses of the links, and their centres: s along the link from its first joint, k to its left:")
        yield rows
        for drive in self.scene.drives:
            rate = arrange("{0} {1}", digits(float(drive.rate)), unit(f"{length}/s" if drive.slides else "rad/s"))
            yield said("Drive of link {0}: {1}", drive.link, rate)

    def results(self) -> Iterator[Words]:
        """Principal vectors, counterweights, the largest forces before and after, and the checks."""
        scene, length = self.scene, unit(self.scene.units.length)
        mass = digits(float(KILOGRAMS[scene.units.mass] * self.given_motion.centre.mass))
        yield said("Mass of the moving links: {0} {1}", mass, unit("kg"))
        for letter, z, per in (("v", self.given_motion.velocity, "/s"), ("a", self.given_motion.acceleration, "/s²")):
            if self.given_pose is not None:
                x, y = (digits(float(part), 5) for part in (z[self.given_pose].real, z[self.given_pose].imag))
                yield arrange("{0}_S = ({1}, {2}) {3}", letter, x, y, unit(f"{scene.units.length}{per}"))
        heads: list[Said | str] = [said("link"), arrange("h, {0}", length), arrange("ξ, {0}", length)]
        rows = [[name, digits(one["h"], 5), digits(clear_rounding_of(one["offset"], one["length"]), 4)]
                for name, one in principal_vectors(self.given_motion).items()]
        yield said("Principal vectors, along the links and square to them:")
        yield [heads, *rows]
        yield arrange("{0}: {1}", said("Balanced"), WAYS[self.balancing.method])
        if self.balancing.note:
            yield self.balancing.note
        yield from self.counterweight_table()
        yield from self.largest_forces()
        if self.balancing.engine:
            yield from engine_text(self.balancing.engine)
        yield check_words(self.balancing.check)

    @cached_property
    def sizes(self) -> tuple[float, float]:
        """The size of the links' own forces, and of their moments: what is nothing beside them is rounding."""
        metre, scene = float(METRES[self.scene.units.length]), self.scene
        least = ZERO_TOL * float(KILOGRAMS[scene.units.mass] * self.given_motion.centre.mass) * scene.extent * metre
        force = max(least, *(float(np.nanmax(np.abs(part))) for part in self.given_motion.shaking.parts.values()))
        return force, force * scene.extent * metre

    @property
    def given_pose(self) -> int | None:
        """The place of the given pose among the positions."""
        there = np.flatnonzero(self.given_motion.links.travel == 0)
        return int(there[0]) if there.size and np.isfinite(self.given_motion.path[there[0]]) else None

    def counterweight_table(self) -> Iterator[Words]:
        """The counterweights in a table, and which variant they make."""
        if not self.balancing.weights:
            return
        rows: list[list[Said | str]] = [[said("link"), arrange("m r, {0}", unit("kg m")), "°", arrange(
            "r, {0}", unit(self.scene.units.length)), arrange("m, {0}", unit("kg"))]]
        for weight in self.balancing.weights:
            one = weight_numbers(self.scene, weight)
            rows.append([one["link"], *(digits(one[key], 5) for key in ("mass_radius", "angle", "radius", "mass"))])
        yield said("Counterweights, where they stand in this pose:")
        yield rows
        if self.balancing.after is not None and (name := variant(self.balancing.after)):
            yield said("Variant {0} of table 16-1", name)

    def largest_forces(self) -> Iterator[Words]:
        """The largest shaking force and moment."""
        rows: list[list[Said | str]] = [["", arrange("J, {0}", unit("N")), arrange("M, {0}", unit("N m"))]]
        for words, motion in ((said("before"), self.given_motion), (said("balanced"), self.balancing.after)):
            if motion is not None:
                found = zip((motion.shaking.force, motion.shaking.moment), self.sizes, strict=True)
                largest = (clear_rounding_of(float(np.nanmax(np.abs(values))), size) for values, size in found)
                rows.append([words, *(digits(one, 5) for one in largest)])
        base = self.given_motion.centre.base
        about = base if FRAME in self.scene.links_of[base] else "(0, 0)"
        yield said("Largest shaking force, and moment about {0}:", about)
        yield rows


def engine_text(engine: Engine) -> Iterator[Words]:
    """The reduced masses and the forces of an engine."""
    kg, newtons = unit("kg"), unit("N")
    yield said("Engine: rotating mass {0} {2}, reciprocating mass {1} {2}", digits(engine.rotating),
               digits(engine.reciprocating), kg)
    forces = [digits(abs(force)) for force in (engine.centrifugal, engine.order(1), engine.order(2))]
    yield said("Inertia force of what rotates: {0} {3}; of the first order: {1} {3}; of the second: {2} {3}", *forces,
               newtons)


def clear_rounding_of(value: float, size: float) -> float:
    """A value, or zero where it is nothing beside a size."""
    return float(clear_rounding(np.asarray(value), size))


def clear_rounding(values: Any, size: float) -> Any:
    """Values, zero where they are nothing beside a size."""
    return np.where(np.abs(values) < ZERO_TOL * size, 0.0, values)
