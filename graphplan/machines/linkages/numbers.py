"""A balanced linkage as numbers: mass centre and shaking force over the cycle, principal vectors, and what is checked.

What the sheet of a linkage's balancing says: masses, drives, principal vectors, counterweights, forces, checks.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.machines.linkages.check import FULL, GUIDED, NONE, SHARED, Balancing, MassMotion
from graphplan.machines.linkages.counterweights import Counterweight
from graphplan.machines.linkages.engine import Engine
from graphplan.machines.linkages.mass_centre import as_multiple
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.numbers import minus
from graphplan.mechanism.travel import printed_travels
from graphplan.mechanism.units import KILOGRAMS, METRES
from graphplan.output.panelled import Words, check_words
from graphplan.output.tables import csv_text
from graphplan.output.tolerances import ZERO_TOL
from graphplan.phrases import Said, arrange, digits, said, unit

HEADINGS = ("S.x", "S.y", "S.vx", "S.vy", "S.ax", "S.ay", "J.x [N]", "J.y [N]", "M [N*m]", "fault")


BELOW, WITHIN, BEYOND = (-math.inf, 0), (0, 1), (1, math.inf)  # the parts of a link's length
VARIANTS = {  # table 16-1: where on its length, or beyond, each link of a balanced four-bar has its mass centre
    "a": (WITHIN, BEYOND, BEYOND), "b": (BEYOND, BEYOND, BEYOND), "c": (BELOW, WITHIN, BEYOND),
    "d": (BELOW, BELOW, WITHIN), "e": (BELOW, BELOW, BELOW)}


def numbers(found: Balancing) -> dict[str, Any]:
    """All of it, plain data for JSON: points and rates in scene lengths and s, masses in kg, moments of mass in kg m,
    forces in N, moments in N m, angles and travels in degrees; null where a pose is not reached."""
    motion = found.before
    scene = motion.centre.scene
    about, mass = motion.shaking.about, float(KILOGRAMS[scene.units.mass] * motion.centre.mass)
    told = {
        "title": scene.title,
        "units": {"length": scene.units.length, "travel": scene.units.length if scene.drives[0].slides else "deg",
                  "mass": "kg", "mass_radius": "kg m", "force": "N", "moment": "N m"},
        "mass": mass, **over_cycle(motion),
        "moment_about": [about.real, about.imag],
        "principal_vectors": principal_vectors(motion), "links": links(motion),
        "replaced_masses": replaced_numbers(motion),
        "balancing": found.method, "counterweights": [weight_numbers(scene, weight) for weight in found.weights],
    }
    if found.note:
        told["note"] = str(found.note)
    if found.after is not None:
        told["balanced"] = {**over_cycle(found.after), "principal_vectors": principal_vectors(found.after),
                            "links": links(found.after), "variant": variant(found.after)}
    if found.engine is not None:
        told["engine"] = engine_numbers(found.engine)
    if found.cylinders:
        told["cylinders"] = [{"order": one.order, "force": one.force, "couple": one.couple} for one in found.cylinders]
    told["faults"] = {str(pose): str(why) for pose, why in motion.links.faults.items()}
    told["check"] = {what: float(gap) for what, gap in found.check.items()}
    return told


def over_cycle(motion: MassMotion) -> dict[str, Any]:
    """What changes over the cycle."""
    return {
        "mass_centre": {"path": pose_rows(motion, motion.path), "velocity": pose_rows(motion, motion.velocity),
                        "acceleration": pose_rows(motion, motion.acceleration)},
        "shaking_force": pose_rows(motion, motion.shaking.force),
        "shaking_forces": {link: pose_rows(motion, part) for link, part in motion.shaking.parts.items()},
        "shaking_moment": pose_rows(motion, motion.shaking.moment)}


def links(motion: MassMotion) -> dict[str, Any]:
    """Of each link with a mass, where its centre is along the line of its joints, and how far on the left of that."""
    scene, told = motion.centre.scene, {}
    for link, mass in motion.centre.masses.items():
        start, end = motion.centre.tree.line(link)
        line = minus(scene.points[end], scene.points[start])
        told[link] = {"mass": float(KILOGRAMS[scene.units.mass] * mass.mass), "centre": mass.centre}
        if start != end:
            long = abs(complex(*line))
            s, k = as_multiple(minus(scene.points[mass.centre], scene.points[start]), line)
            told[link] |= {"line": [start, end], "length": long, "s": float(s) * long, "offset": float(k) * long}
    return told


def replaced_numbers(motion: MassMotion) -> dict[str, Any]:
    """Of each link the masses at points that replace it, in kg, and what two of them leave of its moment of inertia, in
    kg m^2, with the largest couple of that."""
    return {one.link: {"static": dict(zip(one.pins, one.static, strict=True)), "inertia_left": one.inertia_left,
                       "moment_left": float(np.nanmax(np.abs(one.inertia_left * motion.links.alpha[one.link]))),
                       "dynamic": dict(zip((one.pins[0], one.centre, one.pins[1]), one.dynamic, strict=True))}
            for one in motion.replaced_masses}


def variant(motion: MassMotion) -> str:
    """Which variant of table 16-1 a balanced four-bar linkage is; nothing of other linkages."""
    found = [link for link in links(motion).values() if "s" in link]
    scene = motion.centre.scene
    if len(found) != 3 or len(scene.moving) != 3 or scene.slides or scene.gears or scene.contacts:
        return ""
    parts = [link["s"] / link["length"] for link in found]
    return next((name for name, spans in VARIANTS.items()
                 if all(low < part < high for part, (low, high) in zip(parts, spans, strict=True))), "")


def weight_numbers(scene: Scene, weight: Counterweight) -> dict[str, Any]:
    """A counterweight: its moment of mass in kg m, which way it stands in the given pose, in degrees, radius and mass.
    """
    there = weight.place(scene)
    return {"link": weight.link, "pivot": weight.pivot,
            "mass_radius": abs(weight.moment) * float(KILOGRAMS[scene.units.mass] * METRES[scene.units.length]),
            "angle": math.degrees(math.atan2(weight.moment.imag, weight.moment.real)), "radius": weight.radius,
            "mass": weight.mass * float(KILOGRAMS[scene.units.mass]), "at": [there.real, there.imag]}


def engine_numbers(engine: Engine) -> dict[str, Any]:
    """The masses and orders of an engine, and what would balance them."""
    first, second = engine.counter_rotating
    phases = {k: engine.order(k) for k in engine.orders if k <= 4}
    return {
        "links": [engine.crank, engine.rod, engine.piston], "lambda": engine.ratio,
        "offset": engine.offset, "rotating_mass": engine.rotating, "reciprocating_mass": engine.reciprocating,
        "coefficients": {f"A_{k}": abs(engine.series[k]) * (1 if engine.series[k].real > 0 else -1)
                         for k in phases if k > 1},
        "centrifugal": engine.centrifugal,
        "orders": [{"order": k, "cos": force.real, "sin": force.imag} for k, force in phases.items()],
        "main_counterweight": {"mass_radius": engine.rotating * engine.radius},
        "additional_counterweight": {"mass_radius": engine.reciprocating * engine.radius},
        "counter_rotating": [{"speed": k, "mass_radius": float(moment)} for k, moment in (first, second)]}


def principal_vectors(motion: MassMotion) -> dict[str, Any]:
    """The vectors in the given pose by link: which length, from where, and how they are directed; of several hinges
    those to the further ones by the points that they lead from and to."""
    found, points = {}, motion.centre.scene.points
    for vector in motion.centre.vectors:
        start, end = (complex(*map(float, points[name])) for name in (vector.start, vector.end))
        h = complex(vector.along, vector.across) * (end - start)
        found[vector.link or f"{vector.start} {vector.end}"] = {
            "from": vector.start, "line": [vector.start, vector.end], "h": abs((end - start) * float(vector.along)),
            "offset": float(vector.across) * abs(end - start), "vector": [h.real, h.imag],
            "length": abs(h), "angle": math.degrees(math.atan2(h.imag, h.real))}
    return found


def pose_rows(motion: MassMotion, values: Any) -> list[list[float | None]]:
    """The travel of each pose with a number or the two components of a vector."""
    columns = [_travel(motion), *((values.real, values.imag) if np.iscomplexobj(values) else (values,))]
    return [[None if math.isnan(number) else number + 0.0 for number in row] for row in np.stack(columns, 1).tolist()]


def table(motion: MassMotion) -> str:
    """Comma-separated text: a heading, then a line for each pose."""
    units = motion.centre.scene.units
    travel = f"travel [{units.length if motion.centre.scene.drives[0].slides else 'deg'}]"
    own = (f"{units.length}{rate}" for rate in ("", "", "/s", "/s", "/s^2", "/s^2"))
    headings = [travel, *(f"{name} [{unit}]" for name, unit in zip(HEADINGS, own, strict=False)), *HEADINGS[6:]]
    vectors = (motion.path, motion.velocity, motion.acceleration, motion.shaking.force)
    columns = [_travel(motion), *(part for z in vectors for part in (z.real, z.imag)), motion.shaking.moment]
    rows = np.stack(columns, 1).tolist()
    return csv_text(headings, ((*row, motion.links.faults.get(pose, "")) for pose, row in enumerate(rows)))


def _travel(motion: MassMotion) -> Any:
    """The travel in degrees, or lengths of a drive that slides."""
    return printed_travels(motion.centre.scene, motion.links.travel)


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
        yield from self.replaced_masses()
        yield arrange("{0}: {1}", said("Balanced"), WAYS[self.balancing.method])
        if self.balancing.note:
            yield self.balancing.note
        yield from self.counterweight_table()
        yield from self.largest_forces()
        if self.balancing.engine:
            yield from engine_text(self.balancing.engine)
        yield check_words(self.balancing.check)

    def replaced_masses(self) -> Iterator[Words]:
        """The masses at points that replace the links: two with what they leave, and three."""
        replaced, kg = self.given_motion.replaced_masses, unit("kg")
        told = replaced_numbers(self.given_motion)
        heads: list[Said | str] = [said("link"), "A", "B", arrange("m_A, {0}", kg), arrange("m_B, {0}", kg)]
        if replaced:
            yield said("Two masses at points A and B of a link leave the moment of inertia I', with couples up to M':")
            yield [[*heads, arrange("I', {0}", unit("kg m²")), arrange("M', {0}", unit("N m"))],
                   *([one.link, *one.pins, *map(digits, one.static), digits(one.inertia_left),
                      digits(told[one.link]["moment_left"])] for one in replaced)]
        if turning := [one for one in replaced if any(one.dynamic[::2])]:
            yield said("With a third at its mass centre C they leave none:")
            yield [[*heads, arrange("m_C, {0}", kg)],
                   *([one.link, *one.pins, *(digits(one.dynamic[k]) for k in (0, 2, 1))] for one in turning)]

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
