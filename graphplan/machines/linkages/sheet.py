"""The sheet of a balanced linkage, and its numbers as JSON and as a table.

What the sheet of a linkage's balancing says: masses, drives, principal vectors, counterweights, forces, checks.

The mechanism with principal points and vectors in the given pose, the path of the mass centre before and after, the
shaking force as a polar diagram (its hodograph), force and moment over the travel; of an engine the first two orders.

Source: Ozols 1974, 16-2 to 16-4 with figs. 16-4 to 16-12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel
from graphplan.machines.linkages.check import FULL, GUIDED, NONE, SHARED, Balancing, MassMotion
from graphplan.machines.linkages.counterweights import Counterweight
from graphplan.machines.linkages.engine import Engine
from graphplan.machines.linkages.mass_centre import as_multiple
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.numbers import minus
from graphplan.mechanism.travel import printed_travels
from graphplan.mechanism.units import KILOGRAMS, METRES
from graphplan.methods.panels import MECHANISM
from graphplan.output.graphs import (
    CURVES,
    Figures,
    Graph,
    PolarGraph,
    Span,
    lines_through,
    scale_words,
    smooth_line,
    stack_graphs,
)
from graphplan.output.panelled import Panelled, Words, check_words, divide_across, divide_down
from graphplan.output.tables import csv_text
from graphplan.output.tolerances import ZERO_TOL
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.letters import items_with_names, mechanism_wishes, place_letters
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plate, plate_of_values
from graphplan.sheet.plates.view import View, clip_item, fit_scale, view

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

    @property
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


FORCE = Panel("shaking force", said("shaking force"), said("Shaking force: its polar diagram"))
CYCLE = Panel("cycle", said("cycle"), said("Shaking force and moment over the travel"))
VECTOR, PATH = Pen(0.5, pens.BLUE, fill=pens.BLUE), Pen(0.35)
BEFORE, AFTER, FIRST, SECOND = CURVES[0], CURVES[2], CURVES[1], CURVES[4]
WEIGHT, ARM = Pen(0.35, pens.RED, fill="#e8c4c6"), Pen(0.35, pens.RED, (2.4, 1.0))
MECHANISM_MARGIN_MM = 6.0  # mm about the mechanism
HEAD_MM = 3.0  # of a principal vector
MAX_FORCE_RATIO = 8.0  # the middle size of a force: between limits what is larger may lie off its diagram
MIN_NUMBER_GAP_MM = 1.5  # mm: positions that lie nearer to each other have one number
SHARES = 0.7, 0.85, 1.0, 1.2, 1.4, 1.7, 2.0, 2.4  # of the height that forces may have, moments having 1
# numbered positions at most; mm that the radius of a drawn counterweight is at most
MAX_NUMBERED, MAX_WEIGHT_RADIUS_MM = 12, 5


@dataclass(frozen=True)
class BalanceSheet(Panelled):
    """One linkage on one paper."""

    balancing: Balancing
    document = said("Balancing of a linkage")
    told_scales = True

    @property
    def given_motion(self) -> MassMotion:
        """The linkage as it is given."""
        return self.balancing.before

    @property
    def scene(self) -> Scene:
        return self.given_motion.centre.scene

    @property
    def description(self) -> Said:
        program = self.given_motion.centre.drawing.program
        return said("Mass centre by principal vectors in {0} steps, and the shaking force over the cycle.",
                    len(program) - program.givens)

    @property
    def values(self) -> Values:
        return self.given_motion.centre.values

    @property
    def scales(self) -> Scales:
        return Scales(self.k_s, 1.0, self.scene.units.length, {}, convention=self.scene.sheet.convention)

    @property
    def scale(self) -> Said:
        return ratio(self.k_s, self.scene.units.length)

    @property
    def figures(self) -> Figures:
        return Figures(self.letters, self.tongue)

    def repeats(self, panel: Panel) -> bool:
        """Each link has its own vector: all steps are told."""
        return False

    # ---- panels ----------------------------------------------------------------------------------------------------

    def panels_in(self, room: Rect) -> dict[Panel, Rect]:
        """The mechanism above; under it the polar diagram, and beside that what changes over the travel."""
        upper, lower = divide_down(room, 1.3, 1.0)
        left, right = divide_across(lower, 1.0, 1.25)
        return {MECHANISM: upper, FORCE: left, CYCLE: right}

    def heading(self, panel: Panel) -> tuple[Said, Said | None]:
        """What a panel shows, and its scale."""
        if panel == MECHANISM:
            scale = Scales(self.k_s, 1.0, self.scene.units.length, {}, convention=self.scene.sheet.convention)
            return said("Mass centre by principal vectors"), join(scale.scale_texts(MECHANISM, set()), ",  ")
        if panel == FORCE:
            return panel.heading, scale_words("J", self.polar(self.room(panel)).k, "N", self.scene.sheet.convention)
        return panel.heading, None

    def figure(self, panel: Panel, rect: Rect) -> Iterator[Item]:
        """The mechanism, or a diagram."""
        if panel == MECHANISM:
            return self._mechanism(rect)
        return self._polar(rect) if panel == FORCE else self._cycle(rect)

    @property
    def motions(self) -> list[tuple[MassMotion, Pen]]:
        """The linkage before and after it is balanced, each with its pen."""
        after = self.balancing.after
        return [(self.given_motion, BEFORE), *([(after, AFTER)] if after else [])]

    # ---- the mechanism ---------------------------------------------------------------------------------------------

    @property
    def _box(self) -> Rect:
        """What the plan of the mechanism must hold: its points, the paths of the mass centre, and counterweights."""
        paths = [complex(z) for motion, _ in self.motions for z in motion.path[np.isfinite(motion.path)]]
        weights = [weight.place(self.scene) for weight in self.balancing.weights if weight.radius <= self.scene.extent]
        values = self.given_motion.centre.values
        ends = [point[:2] for role in values.drawing.roles for point in values.values_of_role(role)]
        places = [*((z.real, z.imag) for z in (*paths, *weights)), *ends]
        return bounding_box([*places, *((float(x), float(y)) for x, y in self.scene.points.values())])

    @property
    def k_s(self) -> float:
        """Lengths for a mm of the mechanism, in a round scale."""
        return float(round_up(fit_scale(self._box, self.room(MECHANISM).inset(*(MECHANISM_MARGIN_MM,) * 4))))

    def _mechanism(self, rect: Rect) -> Iterator[Item]:
        """The links with their counterweights, the paths of the mass centre, and the steps."""
        window = view(self._box, rect, self.k_s)
        drawn = DrawnMechanism(self.scene, window)
        ink = plate_of_values(self.values, MECHANISM, window, self.scene, self.letters)
        others = [*self._weights(window), *self._paths(window), *drawn.items(), *self._vectors(ink)]
        path = [window((float(z.real), float(z.imag))) for z in self.given_motion.path[self.places]]
        wishes = [*mechanism_wishes(drawn), *self._numbers(path, window.rect)]
        yield from items_with_names(ink, others, wishes, lambda mark: bool(mark.number))

    def _vectors(self, ink: Plate) -> Iterator[Item]:
        """The principal vectors head to tail."""
        program, base = self.values.drawing.program, self.given_motion.centre.base
        first = next(step.index for step in program.steps if step.name == base)
        for start, end in pairwise([first, *self.values.drawing.roles["ends"]]):
            tail, tip = (ink.plates.steps[mark].spot for mark in (start, end))
            yield Arrow(VECTOR, "plates", end, tail, tip, min(HEAD_MM, 0.6 * math.dist(tail, tip)))

    def _paths(self, window: View) -> Iterator[Item]:
        """The paths of the mass centre; one that stands still is a spot."""
        for motion, pen in self.motions:
            spots = [window((float(z.real), float(z.imag))) for z in motion.path]
            yield from clip_item(Polyline(pen, "links", None, tuple(self._smooth(motion, spots))), window.rect)
            yield from (Circle(pen.with_fill(pen.colour), "links", None, spots[k], 0.5) for k in self.places)

    def _weights(self, window: View) -> Iterator[Item]:
        """The counterweights where they stand, their areas as their masses, on arms from their pivots."""
        heaviest = max((weight.mass for weight in self.balancing.weights), default=1.0)
        for weight in self.balancing.weights:
            at, pivot = weight.place(self.scene), complex(*map(float, self.scene.points[weight.pivot]))
            spot, root = (window((z.real, z.imag)) for z in (at, pivot))
            yield from clip_item(Polyline(ARM, "links", None, (root, spot)), window.rect)
            if window.rect.holds(spot):
                yield Circle(WEIGHT, "links", None, spot,
                             max(1.0, MAX_WEIGHT_RADIUS_MM * (weight.mass / heaviest) ** 0.5))

    def _numbers(self, spots: Sequence[Spot], rect: Rect) -> Iterator[Wish]:
        """The numbers of positions at their spots; of such as lie on each other the first alone."""
        shown = list[Spot]()
        for number, spot in enumerate(spots):
            if rect.holds(spot) and all(math.dist(spot, other) > MIN_NUMBER_GAP_MM for other in shown):
                shown.append(spot)
                yield Wish(self._runs(str(number)), (spot,), 0.8, True, pens.FAINT)

    def _runs(self, text: str) -> Any:
        return self.figures.text((0.0, 0.0), text).runs

    @property
    def places(self) -> list[int]:
        """The positions that are numbered, by their places among all."""
        count = len(self.given_motion.links.travel)
        each = next(step for step in range(1, count + 1) if count % step == 0 and count / step <= MAX_NUMBERED)
        return [k for k in range(0, count, each) if np.isfinite(self.given_motion.path[k])]

    def _smooth(self, motion: MassMotion, spots: list[Spot]) -> list[Spot]:
        """A smooth line through spots, back to its beginning where the motion closes."""
        known = [spot for spot, z in zip(spots, motion.path, strict=True) if np.isfinite(z)]
        if not motion.links.closes or len(known) < len(spots):
            return smooth_line(known)
        count = len(spots)
        whole = smooth_line([known[-1], *known, known[0], known[1]])
        pieces = (len(whole) - 1) // (count + 2)
        return whole[pieces:-pieces]

    # ---- diagrams --------------------------------------------------------------------------------------------------

    def polar(self, rect: Rect) -> PolarGraph:
        """The polar diagram of the shaking force, before and after."""
        forces = np.concatenate([self.usual_values(self._force(motion)) for motion, _ in self.motions])
        return PolarGraph.fit_vectors(rect.inset(4.0, 4.0, 4.0, 8.0), forces.real.tolist(), forces.imag.tolist())

    def _polar(self, rect: Rect) -> Iterator[Item]:
        """The curves of the ends of the shaking force, with numbered positions."""
        polar = self.polar(rect)
        ink, ends = [*self.figures.rings(polar, "N")], list[Spot]()
        ink += self._legend(rect, [("J", BEFORE), *([("J'", AFTER)] if self.balancing.after else [])])
        for motion, pen in self.motions:
            spots = [polar.end_of(float(z.real), float(z.imag)) for z in self._force(motion)]
            ink += clip_item(Polyline(pen, "links", None, tuple(self._smooth(motion, spots))), polar.rect)
            shown = [spots[k] for k in self.places if polar.rect.holds(spots[k])]
            ink += [Circle(pen.with_fill(pen.colour), "links", None, spot, 0.5) for spot in shown]
            ends += shown
        spots = [polar.end_of(float(z.real), float(z.imag)) for z in self._force(self.given_motion)[self.places]]
        yield from (*ink, *place_letters([*self._numbers(spots, polar.rect)], ink, ends, polar.rect, self.letters))

    def _force(self, motion: MassMotion) -> Any:
        """The shaking force, zero where it is rounding alone."""
        return clear_rounding(motion.shaking.force, self.words.sizes[0])

    def usual_values(self, values: Any) -> Any:
        """The values for which a diagram must have room: all of a motion that closes; between limits, where forces grow
        beyond all bounds, those that are not many times as large as most."""
        known = values[np.isfinite(values)]
        most = MAX_FORCE_RATIO * np.median(np.abs(known))
        return known if self.given_motion.links.closes or not most else known[np.abs(known) <= most]

    def _legend(self, rect: Rect, curves: list[tuple[str, Pen]]) -> Iterator[Item]:
        """Which curve is which, in the upper left corner."""
        words = {"J": said("before"), "J'": said("balanced"), "J_1": said("first order"), "J_2": said("second order")}
        x, size = rect.left + 2.0, self.letters.text
        for name, pen in curves:
            yield Polyline(pen, "letters", None, ((x, rect.top - 2.0), (x + 6.0, rect.top - 2.0)))
            told = self.figures.text((x + 7.5, rect.top - 2.0 - 0.35 * size), words[name])
            yield told
            x = told.box.right + 6.0

    def _cycle(self, rect: Rect) -> Iterator[Item]:
        """The size of the shaking force, of an engine its parts along the guide, and the moment, over the travel."""
        force, moment = self.words.sizes
        forces = [(clear_rounding(values, force), pen) for values, pen in self._forces]
        moments = [(clear_rounding(motion.shaking.moment, moment), pen) for motion, pen in self.motions]
        slides = self.scene.drives[0].slides
        travel = self.given_motion.links.travel if slides else np.degrees(self.given_motion.links.travel)
        ends = (0.0, 360.0 * max(1, round(travel[-1] / 360))) if self.is_whole_turns else (travel[0], travel[-1])
        spans = [_span([self.usual_values(values) for values, _ in curves]) for curves in (forces, moments)]
        upper, lower = stack_diagrams(rect.inset(2.0, 2.0, 4.0, 5.0), ends, spans)
        unit_x = self.scene.units.length if slides else "°"
        yield from lines_through([upper, lower], self._uprights(travel))
        words = "s" if slides else "φ"
        convention = self.scene.sheet.convention
        yield from self.figures.axes(upper, "", scale_words("J", upper.y.unit, "N", convention), numbers=False)
        yield from self.figures.axes(lower, f"{words}, {unit_x}", scale_words("M", lower.y.unit, "N m", convention),
                                     turns=not slides)
        for graph, curves in ((upper, forces), (lower, moments)):
            for values, pen in curves:
                yield from self._curve(graph, travel, values, pen)
        named = [("J", BEFORE), *([("J'", AFTER)] if self.balancing.after else [])]
        yield from self._legend(rect, [*named, *([("J_1", FIRST), ("J_2", SECOND)] if self.balancing.engine else [])])

    @property
    def is_whole_turns(self) -> bool:
        """Whether the travel is that of whole turns."""
        return self.given_motion.links.closes and not self.scene.drives[0].slides

    def _uprights(self, travel: Any) -> list[float]:
        """The travels of the numbered positions."""
        return [float(travel[k]) for k in self.places]

    def _curve(self, graph: Graph, travel: Any, values: Any, pen: Pen) -> Iterator[Item]:
        """A smooth curve over the travel, to the end of its period."""
        if self.is_whole_turns:
            travel, values = np.append(travel, graph.x.span(graph.level)[1]), np.append(values, values[0])
        yield from graph.smooth(travel, values, pen)

    @property
    def _forces(self) -> list[tuple[Any, Pen]]:
        """What of the shaking force is drawn over the travel: of an engine along its guide, with its orders."""
        engine = self.balancing.engine
        if engine is None:
            return [(np.abs(motion.shaking.force), pen) for motion, pen in self.motions]
        crank = self.given_motion.points[engine.pin(self.scene)] - self.given_motion.points[engine.hinge]
        angle = np.angle(crank / engine.ahead)
        parts = [(np.real(motion.shaking.force / engine.ahead), pen) for motion, pen in self.motions]
        first = np.real(engine.force(angle, (1,)))
        return [*parts, (first, FIRST), (np.real(engine.order(2) * np.exp(-2j * angle)), SECOND)]

    # ---- words -----------------------------------------------------------------------------------------------------

    @property
    def words(self) -> BalanceWords:
        """What the sheet says."""
        return BalanceWords(self.balancing)

    def given_words(self) -> Iterator[Words]:
        return self.words.given_data()

    def result_words(self) -> Iterator[Words]:
        return self.words.results()


def stack_diagrams(room: Rect, x: Span, spans: Sequence[Span]) -> list[Graph]:
    """Two diagrams, each as high as its ordinates are at its round scale, in the shares in which they take most room.
    """
    tried = [stack_graphs(room, x, spans, (share, 1.0)) for share in SHARES]
    fitted = [[graph._replace(upright=(graph.upright[0], high / graph.y.unit))
               for graph, (_, high) in zip(graphs, spans, strict=True)] for graphs in tried]
    return max(fitted, key=lambda graphs: math.prod(graph.rect.height for graph in graphs))


def _span(curves: list[Any]) -> tuple[float, float]:
    """From the least of some values to the largest, and a little more; zero among them."""
    low, high = (float(end([end([0.0, *values]) for values in curves])) for end in (min, max))
    return (1.05 * low, 1.05 * high) if high > low else (-1.0, 1.0)
