"""The sheet of a balanced linkage, and its numbers as JSON and as a table.

What the sheet of a linkage's balancing says: masses, drives, principal vectors, counterweights, forces, checks.

The mechanism with principal points and vectors in the given pose, the path of the mass centre before and after, the
shaking force as a polar diagram (its hodograph), force and moment over the travel; of an engine the first two orders.

Source: Ozols 1974, 16-2 to 16-4 with figs. 16-4 to 16-12.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.kernel.program import Panel
from graphplan.machines.linkages.check import FULL, GUIDED, NONE, SHARED, Balancing, MassMotion
from graphplan.machines.linkages.counterweights import Counterweight
from graphplan.machines.linkages.engine import Engine
from graphplan.machines.linkages.mass_centre import as_multiple
from graphplan.machines.tolerances import ZERO_TOL
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.numbers import minus
from graphplan.mechanism.travel import printed_travels
from graphplan.mechanism.units import KILOGRAMS, METRES
from graphplan.methods.panels import MECHANISM
from graphplan.output.tables import csv_text
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.diagrams import (
    CURVES,
    Diagram,
    DrawnCurve,
    Frame,
    QuantityAxis,
    Span,
    stack_frames,
    stroke_curve,
)
from graphplan.sheet.layout.scales import Scales, ratio, scale_words
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.lettering.letters import mechanism_wishes
from graphplan.sheet.panels import PanelFigure, PanelPage, PanelSheet, Words, check_words, column, fit_view, row
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plate, plate_of_values
from graphplan.sheet.plates.view import View

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
    numbers = {
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
        numbers["note"] = str(found.note)
    if found.after is not None:
        numbers["balanced"] = {**over_cycle(found.after), "principal_vectors": principal_vectors(found.after),
                            "links": links(found.after), "variant": variant(found.after)}
    if found.engine is not None:
        numbers["engine"] = engine_numbers(found.engine)
    if found.cylinders:
        numbers["cylinders"] = [{"order": one.order, "force": one.force, "couple": one.couple}
                                for one in found.cylinders]
    numbers["faults"] = {str(pose): str(why) for pose, why in motion.links.faults.items()}
    numbers["check"] = {what: float(gap) for what, gap in found.check.items()}
    return numbers


def over_cycle(motion: MassMotion) -> dict[str, Any]:
    """Quantities that change over the cycle."""
    return {
        "mass_centre": {"path": pose_rows(motion, motion.path), "velocity": pose_rows(motion, motion.velocity),
                        "acceleration": pose_rows(motion, motion.acceleration)},
        "shaking_force": pose_rows(motion, motion.shaking.force),
        "shaking_forces": {link: pose_rows(motion, part) for link, part in motion.shaking.parts.items()},
        "shaking_moment": pose_rows(motion, motion.shaking.moment)}


def links(motion: MassMotion) -> dict[str, Any]:
    """Of each link with a mass, where its centre is along the line of its joints, and how far on the left of that."""
    scene, numbers = motion.centre.scene, {}
    for link, mass in motion.centre.masses.items():
        start, end = motion.centre.tree.line(link)
        line = minus(scene.points[end], scene.points[start])
        numbers[link] = {"mass": float(KILOGRAMS[scene.units.mass] * mass.mass), "centre": mass.centre}
        if start != end:
            long = abs(complex(*line))
            s, k = as_multiple(minus(scene.points[mass.centre], scene.points[start]), line)
            numbers[link] |= {"line": [start, end], "length": long, "s": float(s) * long, "offset": float(k) * long}
    return numbers


def replaced_numbers(motion: MassMotion) -> dict[str, Any]:
    """Of each link the masses at points that replace it, in kg, and what two of them leave of its moment of inertia, in
    kg m^2, with the largest couple of that."""
    return {one.link: {"static": dict(zip(one.pins, one.static, strict=True)), "inertia_left": one.inertia_left,
                       "moment_left": float(np.nanmax(np.abs(one.inertia_left * motion.links.alpha[one.link]))),
                       "dynamic": dict(zip((one.pins[0], one.centre, one.pins[1]), one.dynamic, strict=True))}
            for one in motion.replaced_masses}


def variant(motion: MassMotion) -> str:
    """The variant of table 16-1 of a balanced four-bar linkage; empty for other linkages."""
    with_mass = [link for link in links(motion).values() if "s" in link]
    scene = motion.centre.scene
    if len(with_mass) != 3 or len(scene.moving) != 3 or scene.slides or scene.gears or scene.contacts:
        return ""
    parts = [link["s"] / link["length"] for link in with_mass]
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
    places, points = {}, motion.centre.scene.points
    for vector in motion.centre.vectors:
        start, end = (complex(*map(float, points[name])) for name in (vector.start, vector.end))
        h = complex(vector.along, vector.across) * (end - start)
        places[vector.link or f"{vector.start} {vector.end}"] = {
            "from": vector.start, "line": [vector.start, vector.end], "h": abs((end - start) * float(vector.along)),
            "offset": float(vector.across) * abs(end - start), "vector": [h.real, h.imag],
            "length": abs(h), "angle": math.degrees(math.atan2(h.imag, h.real))}
    return places


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
        linkage = links(self.given_motion)
        rows: list[list[Said | str]] = [[said("link"), arrange("m, {0}", unit("kg")), arrange("s, {0}", unit(length)),
                                         arrange("k, {0}", unit(length))]]
        for name, link in linkage.items():
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
        yield said("Principal vectors, along the links and perpendicular to them:")
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
        numbers = replaced_numbers(self.given_motion)
        heads: list[Said | str] = [said("link"), "A", "B", arrange("m_A, {0}", kg), arrange("m_B, {0}", kg)]
        if replaced:
            yield said("Two masses at points A and B of a link leave the moment of inertia I', with couples up to M':")
            yield [[*heads, arrange("I', {0}", unit("kg m²")), arrange("M', {0}", unit("N m"))],
                   *([one.link, *one.pins, *map(digits, one.static), digits(one.inertia_left),
                      digits(numbers[one.link]["moment_left"])] for one in replaced)]
        if turning := [one for one in replaced if any(one.dynamic[::2])]:
            yield said("With a third at its mass centre C they leave none:")
            yield [[*heads, arrange("m_C, {0}", kg)],
                   *([one.link, *one.pins, *(digits(one.dynamic[k]) for k in (0, 2, 1))] for one in turning)]

    @property
    def sizes(self) -> tuple[float, float]:
        """Sizes of the links' own forces, and of their moments; smaller results are rounding."""
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
            numbers = weight_numbers(self.scene, weight)
            keys = "mass_radius", "angle", "radius", "mass"
            rows.append([numbers["link"], *(digits(numbers[key], 5) for key in keys)])
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
    """A value, or zero if it is negligible relative to a size."""
    return float(clear_rounding(np.asarray(value), size))


def clear_rounding(values: Any, size: float) -> Any:
    """Values, zero where negligible relative to a size."""
    return np.where(np.abs(values) < ZERO_TOL * size, 0.0, values)


FORCE = Panel("shaking force", said("shaking force"), said("Shaking force: its polar diagram"))
CYCLE = Panel("cycle", said("cycle"), said("Shaking force and moment over the travel"))
VECTOR = Pen(0.5, pens.BLUE, fill=pens.BLUE)
BEFORE, AFTER, FIRST, SECOND = CURVES[0], CURVES[2], CURVES[1], CURVES[4]
WEIGHT, ARM = Pen(0.35, pens.RED, fill="#e8c4c6"), Pen(0.35, pens.RED, (2.4, 1.0))
MECHANISM_MARGIN_MM = 6.0  # mm about the mechanism
HEAD_MM = 3.0  # of a principal vector
MAX_FORCE_RATIO = 8.0  # the middle size of a force: between limits what is larger may lie off its diagram
MIN_NUMBER_GAP_MM = 1.5  # mm: positions that lie nearer to each other have one number
SHARES = 0.7, 0.85, 1.0, 1.2, 1.4, 1.7, 2.0, 2.4  # of the height that forces may have, moments having 1
# positions with numbers at most, and the radius in mm of the heaviest counterweight
MAX_NUMBERED, MAX_WEIGHT_RADIUS_MM = 12, 5
LEGEND = {"J": said("before"), "J'": said("balanced"), "J_1": said("first order"), "J_2": said("second order")}


def balance_sheet(paper: str, balancing: Balancing) -> PanelSheet:
    """The sheet of a linkage: the mechanism above; under it the polar diagram, and beside that what changes over the
    travel."""
    given, words = balancing.before, BalanceWords(balancing)
    scene, values = given.centre.scene, given.centre.values
    page = PanelPage(paper, scene, column((1.3, MECHANISM), (1.0, row((1.0, FORCE), (1.25, CYCLE)))), True)
    figures = BalanceFigures(balancing, page, words.sizes)
    length, window = scene.units.length, figures.window
    scales = Scales(1 / window.scale, 1.0, length, {}, convention=scene.sheet.convention)
    program = values.drawing.program
    return PanelSheet(
        page, said("Balancing of a linkage"),
        said("Mass centre by principal vectors in {0} steps, and the shaking force over the cycle.",
             len(program) - program.givens),
        values, ratio(scales.k_s, length),
        {MECHANISM: figures.mechanism(scales), FORCE: figures.polar(), CYCLE: figures.cycle()}, scales,
        given=[*words.given_data()], found=[*words.results()], told_once=())  # each link has its own vector


@dataclass(frozen=True)
class BalanceFigures:
    """The figures of one sheet: `sizes` are those of the links' forces and moments, beside which there is rounding."""

    balancing: Balancing
    page: PanelPage
    sizes: tuple[float, float]

    @property
    def given_motion(self) -> MassMotion:
        """The linkage as it is given."""
        return self.balancing.before

    @property
    def scene(self) -> Scene:
        return self.page.scene

    @property
    def motions(self) -> list[tuple[MassMotion, Pen]]:
        """The linkage before and after it is balanced, each with its pen."""
        after = self.balancing.after
        return [(self.given_motion, BEFORE), *([(after, AFTER)] if after else [])]

    @cached_property
    def places(self) -> list[int]:
        """The positions that are numbered, by their places among all."""
        count = len(self.given_motion.links.travel)
        each = next(step for step in range(1, count + 1) if count % step == 0 and count / step <= MAX_NUMBERED)
        return [k for k in range(0, count, each) if np.isfinite(self.given_motion.path[k])]

    # ---- the mechanism ---------------------------------------------------------------------------------------------

    @cached_property
    def window(self) -> View:
        """The mechanism's plan, at a round scale: its points, the paths of the mass centre, and counterweights."""
        paths = [z for motion, _ in self.motions for z in motion.path[np.isfinite(motion.path)]]
        weights = [weight.place(self.scene) for weight in self.balancing.weights if weight.radius <= self.scene.extent]
        values = self.given_motion.centre.values
        ends = [point[:2] for role in values.drawing.roles for point in values.values_of_role(role)]
        places = [*((float(z.real), float(z.imag)) for z in (*paths, *weights)), *ends]
        box = bounding_box([*places, *((float(x), float(y)) for x, y in self.scene.points.values())])
        return fit_view(box, self.page.room(MECHANISM), MECHANISM_MARGIN_MM)

    def mechanism(self, scales: Scales) -> PanelFigure:
        """The links with their counterweights, the paths of the mass centre, and the steps."""
        window, values = self.window, self.given_motion.centre.values
        mechanism = DrawnMechanism(self.scene, window)
        plate = plate_of_values(values, MECHANISM, window, self.scene, self.page.letters)
        path = [window.spot(z) for z in self.given_motion.path[self.places]]
        return PanelFigure(
            window.rect, plate=plate, is_named=lambda mark: bool(mark.number),
            strokes=[*self._weights(window), *self._curves(window, [(one, one.path) for one, _ in self.motions]),
                     *mechanism.items(), *self._vectors(plate)],
            wishes=[*mechanism_wishes(mechanism), *self._numbers(path, window.rect)],
            heading=said("Mass centre by principal vectors"),
            scales=join(scales.scale_texts(MECHANISM, set()), ",  "))

    def _vectors(self, plate: Plate) -> Iterator[Item]:
        """The principal vectors head to tail."""
        drawing, base = self.given_motion.centre.values.drawing, self.given_motion.centre.base
        first = next(step.index for step in drawing.program.steps if step.name == base)
        for start, end in pairwise([first, *drawing.roles["ends"]]):
            tail, tip = (plate.plates.steps[mark].spot for mark in (start, end))
            yield Arrow(VECTOR, "plates", end, tail, tip, min(HEAD_MM, 0.6 * math.dist(tail, tip)))

    def _curves(self, window: View, curves: Iterable[tuple[MassMotion, Any]]) -> Iterator[Item]:
        """Smooth curves of vectors or points, closed where the motion closes, with dots at the numbered positions."""
        for (motion, zs), (_, pen) in zip(curves, self.motions, strict=True):
            spots, known = [*map(window.spot, zs)], np.isfinite(motion.path)
            closed = motion.links.closes and bool(known.all())
            yield from stroke_curve([spots[k] for k in np.flatnonzero(known)], window.rect, pen, True, closed)
            yield from (Circle(pen.with_fill(pen.colour), "links", None, spots[k], 0.5) for k in self.places)

    def _weights(self, window: View) -> Iterator[Item]:
        """The counterweights where they stand, their areas as their masses, on arms from their pivots."""
        heaviest = max((weight.mass for weight in self.balancing.weights), default=1.0)
        for weight in self.balancing.weights:
            spot = window.spot(weight.place(self.scene))
            root = window.spot(complex(*map(float, self.scene.points[weight.pivot])))
            yield Polyline(ARM, "links", None, (root, spot))
            if window.rect.holds(spot):
                yield Circle(WEIGHT, "links", None, spot,
                             max(1.0, MAX_WEIGHT_RADIUS_MM * (weight.mass / heaviest) ** 0.5))

    def _numbers(self, spots: Sequence[Spot], rect: Rect) -> Iterator[Wish]:
        """The numbers of positions at their spots; of such as lie on each other the first alone."""
        shown = list[Spot]()
        for number, spot in enumerate(spots):
            if rect.holds(spot) and all(math.dist(spot, other) > MIN_NUMBER_GAP_MM for other in shown):
                shown.append(spot)
                yield Wish(sentence_runs(str(number)), (spot,), 0.8, True, pens.FAINT)

    # ---- diagrams --------------------------------------------------------------------------------------------------

    def polar(self) -> PanelFigure:
        """The curves of the ends of the shaking force, with numbered positions."""
        forces = [(motion, clear_rounding(motion.shaking.force, self.sizes[0])) for motion, _ in self.motions]
        usual, rect = np.concatenate([self._usual(force) for _, force in forces]), self.page.room(FORCE)
        box = bounding_box([(0.0, 0.0), *zip(usual.real.tolist(), usual.imag.tolist(), strict=True)])
        window = fit_view(box, rect.inset(4.0, 4.0, 4.0, 8.0))
        spots = [window.spot(z) for z in forces[0][1][self.places]]
        return PanelFigure(
            rect, strokes=[*self.page.text.rings(window, "N"), *self._legend(rect, "J"),
                           *self._curves(window, forces)],
            wishes=[*self._numbers(spots, window.rect)],
            scales=scale_words("J", 1 / window.scale, "N", self.scene.sheet.convention))

    def _usual(self, values: Any) -> Any:
        """The values for which a diagram must have room: all of a motion that closes; between limits, where forces grow
        beyond all bounds, those that are not many times as large as most."""
        finite = values[np.isfinite(values)]
        most = MAX_FORCE_RATIO * np.median(np.abs(finite))
        return finite if self.given_motion.links.closes or not most else finite[np.abs(finite) <= most]

    def _legend(self, rect: Rect, *names: str) -> Iterator[Item]:
        """The curves with their names."""
        named = {"J": BEFORE, **({"J'": AFTER} if self.balancing.after else {}),
                 **({"J_1": FIRST, "J_2": SECOND} if self.balancing.engine and len(names) > 1 else {})}
        return self.page.text.legend(rect, [(LEGEND[name], pen) for name, pen in named.items()])

    def cycle(self) -> PanelFigure:
        """The size of the shaking force, of an engine its parts along the guide, and the moment, over the travel."""
        rect, slides = self.page.room(CYCLE), self.scene.drives[0].slides
        travel = _travel(self.given_motion)
        turns = self.given_motion.links.closes and not slides
        ends = (0.0, 360.0 * max(1, round(travel[-1] / 360))) if turns else (travel[0], travel[-1])
        xs, shown = (np.append(travel, ends[1]), [*range(len(travel)), 0]) if turns else (travel, slice(None))
        moments = [(motion.shaking.moment, pen) for motion, pen in self.motions]
        curves = [[(clear_rounding(values, size), pen) for values, pen in part]
                  for part, size in zip((self._forces, moments), self.sizes, strict=True)]
        frames = stack_diagrams(rect.inset(2.0, 2.0, 4.0, 5.0), ends, [
            _span([self._usual(values) for values, _ in part]) for part in curves])
        abscissa = QuantityAxis("s" if slides else "φ", self.scene.units.length if slides else "°", turns=not slides,
                        scaled=False)
        marks = [float(travel[k]) for k in self.places]
        gap = frames[0].rect.bottom - frames[1].rect.top  # the thin lines go on from one diagram to the other
        axes = ((QuantityAxis(numbers=False), QuantityAxis("J", "N")), (abscissa, QuantityAxis("M", "N m")))
        diagrams = [Diagram(frame, *pair, [DrawnCurve(xs, values[shown], pen, smooth=True) for values, pen in part],
                            uprights=marks, uprights_down=down)
                    for frame, pair, part, down in zip(frames, axes, curves, (gap, 0.0), strict=True)]
        return PanelFigure(rect, diagrams, strokes=[*self._legend(rect, "J", "J_1")])

    @property
    def _forces(self) -> list[tuple[Any, Pen]]:
        """The curves of the shaking force over the travel: of an engine along its guide, with its orders."""
        engine = self.balancing.engine
        if engine is None:
            return [(np.abs(motion.shaking.force), pen) for motion, pen in self.motions]
        crank = self.given_motion.points[engine.pin(self.scene)] - self.given_motion.points[engine.hinge]
        angle = np.angle(crank / engine.ahead)
        parts = [(np.real(motion.shaking.force / engine.ahead), pen) for motion, pen in self.motions]
        first = np.real(engine.force(angle, (1,)))
        return [*parts, (first, FIRST), (np.real(engine.order(2) * np.exp(-2j * angle)), SECOND)]


def stack_diagrams(room: Rect, x: Span, spans: Sequence[Span]) -> list[Frame]:
    """Two diagrams, each as high as its ordinates are at its round scale, in the shares in which they take most room.
    """
    fitted = [[frame._replace(upright=(frame.upright[0], high / frame.y.unit))
               for frame, (_, high) in zip(stack_frames(room, x, spans, (share, 1.0)), spans, strict=True)]
              for share in SHARES]
    return max(fitted, key=lambda frames: math.prod(frame.rect.height for frame in frames))


def _span(curves: list[Any]) -> Span:
    """From the least of some values to the largest, and a little more; zero among them."""
    low, high = (float(end([end([0.0, *values]) for values in curves])) for end in (min, max))
    return (1.05 * low, 1.05 * high) if high > low else (-1.0, 1.0)
