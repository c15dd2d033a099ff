"""The mass centre over the cycle and what shakes the frame, each against the solver's: the independent check of
balancing.

The path is compared with the polygon of masses, velocity and acceleration of the mass centre with the solver's of all
links, the shaking force and its moment with what the frame bears by the solver's reactions.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphplan.check.compared import require_agreement
from graphplan.check.cycle import cycle
from graphplan.check.tolerances import SUM_TOL
from graphplan.check.trusted import construct
from graphplan.cycle.positions import MovingLink
from graphplan.cycle.turn import motion_and_travel, whole_motion
from graphplan.errors import Disagreement, Refused
from graphplan.machines.linkages.counterweights import (
    Counterweight,
    Dyads,
    ReplacedMass,
    add_counterweights,
    added_dyads,
    balance_along_guide,
    balance_fully,
    replaced_masses,
)
from graphplan.machines.linkages.engine import Engine, InLine, cylinders_in_line, engine
from graphplan.machines.linkages.mass_centre import MassCentre, Shaking, mass_centre, shaking, spanning_tree
from graphplan.mechanism.model import FRAME, Find, Loads, Scene
from graphplan.mechanism.numbers import times
from graphplan.mechanism.scene import parse
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.solver import poses, solve, statics

SAMPLES = 64  # of a turn, in which the forces of cylinders are added up
FULL, GUIDED, SHARED, NONE = "full", "partial", "share", "none"


@dataclass(frozen=True)
class MassMotion:
    """The mass centre of a scene in n poses and what shakes its frame; complex arrays of shape (n,), nan where a pose
    is not reached.

    `links` is the motion that they are found from; `points` are where all points are, `path`, `velocity` and
    `acceleration` are in scene units. `check` says by how much the independent results differ, relative to the largest
    of what they add up.
    """

    centre: MassCentre
    links: LinkMotion
    points: Mapping[str, Any]
    path: Any
    velocity: Any
    acceleration: Any
    shaking: Shaking
    check: Mapping[str, float]
    replaced_masses: tuple[ReplacedMass, ...]


def mass_motion(scene: Scene, positions: int, links: LinkMotion | None = None) -> MassMotion:
    """The mass centre in so many poses of the cycle, constructed and compared.

    Reads how the links move, where that is known from the same links with other masses. Fails with `Refused` where no
    link has a mass or the mechanism does not move, with `Disagreement` where they differ by more than rounding.
    """
    centre = mass_centre(scene)
    links = links or link_motion(scene, positions)
    places, *rates = links.points_motion(scene, centre.points)
    path, velocity, acceleration = (centre.position_from(vectors) for vectors in (places, *rates))
    motion = MassMotion(centre, links, {**links.points, **places}, path, velocity, acceleration,
                        shaking(centre, places, rates[1], links.alpha), {},
                        replaced_masses(scene, centre.masses))
    check = {**_solver_gaps(motion), **_replaced_gap(motion)}
    require_agreement(scene.name, check, SUM_TOL)
    return replace(motion, check=check)


@dataclass(frozen=True)
class Balancing:
    """A scene before and after it is balanced: `way` is the method, `weights` are the counterweights; `engine` if it is
    a slider-crank whose crank is driven. Without counterweights `after` is empty; `note` has the reason."""

    before: MassMotion
    method: str
    weights: tuple[Counterweight, ...]
    after: MassMotion | None
    engine: Engine | None
    check: Mapping[str, float]
    note: str = ""
    cylinders: tuple[InLine, ...] = ()


def balancing(scene: Scene, positions: int, way: str = "", keep: Sequence[str] = (),
              radii: Mapping[str, float] | None = None, share: float = 0.5) -> Balancing:
    """The mass centre over the cycle before and after counterweights are added, and compared with the solver.

    Reads how it is to be balanced: fully (the default where it can be), so that the mass centre moves along a guide
    alone, by a share of what reciprocates, or not; the links that keep their masses, and radii of counterweights.
    Fails as :func:`mass_motion` does, and with `Refused` where it cannot be balanced so.
    """
    before, crank_engine, note = mass_motion(scene, positions), engine(scene), ""
    if keep or radii:
        way = way or FULL
    try:
        weights = _counterweights(scene, way or FULL, keep, radii or {}, share, crank_engine)
    except Refused as refused:
        if way:
            raise
        weights, note = (), f"{refused.what}: {refused.why}"
    way = way or (NONE if note else FULL)
    after = mass_motion(add_counterweights(scene, weights), positions, before.links) if weights else None
    driven = crank_engine if crank_engine and crank_engine.omega else None
    cylinders, cylinders_gap = _cylinders(scene, driven)
    check = {**before.check, **cylinders_gap, **_counterweight_gap(after or before, way),
             **(_orders_gap(before, driven) if driven else {})}
    require_agreement(scene.name, check, SUM_TOL)
    return Balancing(before, way, weights, after, driven, check, note, cylinders)


def _cylinders(scene: Scene, one: Engine | None) -> tuple[tuple[InLine, ...], dict[str, float]]:
    """Resultant of the scene's cylinders, and its difference from their forces added up around a turn.

    Fails with `Refused` where there are cylinders and the scene is no driven slider-crank.
    """
    if scene.cylinders is None:
        return (), {}
    if one is None:
        raise Refused(f"{scene.name}: cylinders", "the scene is no slider-crank that a crank drives",
                      "leave them out, or the slider-crank of one cylinder")
    angles, places = (list(map(float, values)) for values in (scene.cylinders.angles, scene.cylinders.places))
    together = cylinders_in_line(one, angles, [place * float(METRES[scene.units.length]) for place in places])
    turn, cranks = np.linspace(0, 2 * np.pi, SAMPLES, endpoint=False), np.radians(angles)[:, None]
    gaps = []
    for resultant in together[1:]:
        k = resultant.order
        force = (one.order(k) * np.exp(-1j * k * (turn + cranks))).real.sum(axis=0)
        amplitude = abs(np.fft.rfft(force)[k]) * 2 / SAMPLES
        gaps.append(abs(amplitude - resultant.force) / (abs(one.order(k)) * len(angles)))
    return tuple(together), {"cylinders": float(max(gaps, default=0.0))}


def _counterweights(scene: Scene, way: str, keep: Sequence[str], radii: Mapping[str, float], share: float,
                    found: Engine | None) -> tuple[Counterweight, ...]:
    """The counterweights of one way."""
    if way == FULL:
        return balance_fully(scene, keep, radii)
    if way == GUIDED:
        return balance_along_guide(scene, keep, radii)
    if way == SHARED:
        if found is None:
            raise Refused(f"{scene.name}: counterweights", "not a slider-crank with its mass centres on the lines "
                          "of its joints", "--counterweights full or partial")
        return (found.share(scene, share, radii.get(found.crank)),)
    return ()


def _counterweight_gap(motion: MassMotion, way: str) -> dict[str, float]:
    """Motion of the mass centre that counterweights hold, or across the guide, relative to the reach of the links."""
    if way not in (FULL, GUIDED):
        return {}
    path, scene = motion.path[np.isfinite(motion.path)], motion.centre.scene
    if way == GUIDED:
        guide = next(slide for slide in scene.slides if FRAME in slide.links)
        ahead = complex(*map(float, guide.direction))
        path = (path / ahead).imag * abs(ahead)
    return {"counterweights": float(abs(path - path[0]).max()) / scene.extent}


def _orders_gap(motion: MassMotion, crank_engine: Engine) -> dict[str, float]:
    """By how much all orders together differ from the shaking force, where the crank turns evenly and is short enough
    for its orders to come to an end."""
    scene, reached = motion.centre.scene, np.isfinite(motion.path)
    if any(drive.change
           for drive in scene.drives) or not reached.all() or crank_engine.orders[-1] > len(crank_engine.series) // 2:
        return {}
    crank = motion.points[crank_engine.pin(scene)] - motion.points[crank_engine.hinge]
    force = crank_engine.force(np.angle(crank / crank_engine.ahead), crank_engine.orders) * crank_engine.ahead
    return {"orders": _gap(force, [*motion.shaking.parts.values()])}


def _solver_gaps(motion: MassMotion) -> dict[str, float]:
    """By how much the independent results differ, each relative to the largest of what it adds up."""
    centre, scene = motion.centre, motion.centre.scene
    reached = np.flatnonzero(np.isfinite(motion.path))
    points, directions = ({name: z[reached] for name, z in arrays.items()}
                          for arrays in (motion.points, motion.links.guides))
    alone = _with_inertia_loads_only(scene)
    posed = poses.scene_in_poses(alone, points, directions)
    rates = poses.solve(posed, reached.size)
    mass_shares = {link: float(mass.mass / centre.mass) for link, mass in centre.masses.items()}
    reach = max(abs(z - points[centre.base]).max() for z in points.values())
    gaps = {"path": _gap(motion.path[reached], [mass_shares[link] * points[mass.centre] for link, mass
                                                in centre.masses.items()], reach)}
    rate = _largest_rate(motion, reached)
    speed, sharp = reach * rate, reach * rate**2
    for kind, ours, theirs, least in (("velocity", motion.velocity, rates.velocity, speed),
                                      ("acceleration", motion.acceleration, rates.acceleration, sharp)):
        terms = [mass_shares[link] * _complex(theirs[mass.centre], reached.size)
                 for link, mass in centre.masses.items()]
        gaps[kind] = _gap(ours[reached], terms, least)
    reactions = _frame_reactions(alone, poses.reactions(posed, rates, reached.size), points, motion.shaking.about,
                                 reached.size)
    if reactions is not None:
        metre, weight = float(METRES[scene.units.length]), float(KILOGRAMS[scene.units.mass] * centre.mass)
        least = weight * metre * sharp
        gaps["shaking force"] = _gap(motion.shaking.force[reached], [force for force, _ in reactions], least)
        gaps["shaking moment"] = _gap(motion.shaking.moment[reached], [moment for _, moment in reactions],
                                      least * metre * reach)
    return gaps


def _replaced_gap(motion: MassMotion) -> dict[str, float]:
    """By how much masses at points differ from the links that they replace, in force and in moment."""
    centre, gaps, about = motion.centre, list[float](), motion.shaking.about
    scene, reached = centre.scene, np.isfinite(motion.path)
    metre, reach = float(METRES[scene.units.length]), scene.extent
    for one in motion.replaced_masses:
        places, _, accelerations = motion.links.points_motion(scene, (*one.pins, one.centre))
        places, accelerations = ({name: z[reached] for name, z in arrays.items()} for arrays in (places, accelerations))
        alpha, inertia = motion.links.alpha[one.link][reached], float(centre.masses[one.link].inertia)
        force = motion.shaking.parts[one.link][reached]
        couple = float(KILOGRAMS[scene.units.mass]) * inertia * alpha
        moment = metre * ((places[one.centre] - about).conjugate() * force).imag - couple
        size = sum(map(abs, (*one.static, *one.dynamic))) * metre * max(abs(a).max() for a in accelerations.values())
        for total, turning in one.load(accelerations, places, about, alpha, metre):
            gaps += [_gap(total, [force], size), _gap(turning, [moment], size * metre * reach)]
    return {"replaced masses": max(gaps)} if gaps else {}


def _largest_rate(motion: MassMotion, there: Any) -> float:
    """The largest rate of turning in these poses, in rad/s, or what a link's acceleration comes to from rest; one where
    the drives stand still: relative to it rates are compared."""
    if not any(drive.rate or drive.change for drive in motion.centre.scene.drives):
        return 1.0
    rates = [float(abs(omega[there]).max()) for omega in motion.links.omega.values()]
    rates += [math.sqrt(float(abs(alpha[there]).max())) for alpha in motion.links.alpha.values()]
    return max(rates)


def _gap(ours: Any, terms: list[Any], size: float = 0.0) -> float:
    """The largest difference from a sum, relative to the largest of its terms, or a size that is larger."""
    scale = max(size, *(float(np.max(np.abs(term))) for term in terms))
    apart = float(np.max(np.abs(ours - sum(terms))))
    return apart / scale if scale else apart


def _with_inertia_loads_only(scene: Scene) -> Scene:
    """The scene with its masses as the only loads, held by its drives: other balances hold it in some poses alone."""
    masses = scene.loads.masses if scene.loads else {}
    return replace(scene, loads=Loads((0, 0), masses, (), (), tuple(map(scene.balance_of, scene.drives))))


def _frame_reactions(scene: Scene, reactions: statics.Reactions, points: Mapping[str, Any], about: complex,
                     count: int) -> list[tuple[Any, Any]] | None:
    """Loads of the frame by the reactions of its pairs and the balances: the forces in N, each with its moment in N m;
    None if reactions are statically indeterminate."""
    newton, metre = float(NEWTONS[scene.units.force]), float(METRES[scene.units.length])

    def reaction(vector: Any, at: str, couple: Any = 0.0) -> tuple[Any, Any]:
        force = newton * _complex(vector, count)
        return force, metre * ((points[at] - about).conjugate() * force).imag + newton * couple

    bearing: list[tuple[Any, Any]] = []
    for joint in scene.revolutes:
        for link in joint.links[1:] if FRAME in joint.links else ():
            if (joint.at, link) not in reactions.joints:
                return None
            if FRAME in (link, joint.links[0]):
                bearing.append(reaction(times(1 if link == FRAME else -1, reactions.joints[joint.at, link]), joint.at))
    for slide in (slide for slide in scene.slides if FRAME in slide.links):
        if slide.name not in reactions.slides:
            return None
        force, couple = reactions.slides[slide.name]
        sign = 1 if slide.link == FRAME else -1
        bearing.append(reaction(times(sign, force), slide.at, sign * couple))
    if any(FRAME in pair.links for pair in (*scene.gears, *scene.contacts)):
        return None
    for balance, value in zip(statics.required_loads(scene).balances, reactions.balances, strict=True):
        if balance.on != FRAME:
            continue
        bearing.append(reaction(times(-1, value), balance.at) if isinstance(value, tuple)
                       else (np.zeros(count, dtype=complex), -newton * value))
    return bearing


def _complex(vector: Any, count: int) -> Any:
    """A vector of numbers or arrays as one complex array."""
    return np.broadcast_to(np.asarray(vector[0], dtype=float) + 1j * np.asarray(vector[1], dtype=float), (count,))


# ---- added dyads -----------------------------------------------------------------------------------------------------


def check_added_dyads(scene: Scene) -> tuple[Dyads, dict[str, float]]:
    """The scene with the dyads that carry its mass centre, and by how much the plans of that differ from the solver's
    velocity and acceleration of the mass centre of the scene without them.

    Fails as :func:`added_dyads` and `construct` do, with `Disagreement` where they differ by more than rounding.
    """
    centre, rates = mass_centre(scene), solve(scene)
    added = added_dyads(centre)
    construction = construct(parse(added.text, scene.name, by_drive=True))
    mass_shares = [(float(mass.mass / centre.mass), mass.centre) for mass in centre.masses.values()]
    gaps = {kind: _gap(ours[added.point], [share * complex(*map(float, theirs[point])) for share, point in mass_shares])
            for kind, ours, theirs in (("velocity", construction.velocity, rates.velocity),
                                       ("acceleration", construction.acceleration, rates.acceleration))}
    require_agreement(scene.name, {f"{quantity} of the mass centre": gap for quantity, gap in gaps.items()}, SUM_TOL,
                      "by added dyads")
    return added, gaps


# ---- the motion of all links over the cycle, constructed once and compared: so move all their points -----------------


@dataclass(frozen=True)
class LinkMotion:
    """The links of a scene in n poses of its cycle; arrays of shape (n,), nan where a pose is not reached.

    `travel` of the first drive, in the sense in which it moves, is in radians or scene lengths. Of each link `moved`
    says how it lies, `at` is the point whose `velocity` and `acceleration` were constructed, complex arrays in scene
    units by point, and `omega` and `alpha` tell its turning. `points` and `guides` are those of the turn.
    """

    travel: Any
    closes: bool
    points: Mapping[str, Any]
    guides: Mapping[str, Any]
    faults: Mapping[int, str]
    links: Mapping[str, MovingLink]
    at: Mapping[str, str]
    velocity: Mapping[str, Any]
    acceleration: Mapping[str, Any]
    omega: Mapping[str, Any]
    alpha: Mapping[str, Any]

    def points_motion(self, scene: Scene,
                      names: Iterable[str]) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Places, velocities and accelerations of points of the links, also of such as were added to the scene."""
        places, velocities, accelerations = dict[str, Any](), dict[str, Any](), dict[str, Any]()
        still = np.zeros(self.travel.shape, dtype=complex)
        for name in names:
            place, links = complex(*map(float, scene.points[name])), scene.links_of[name]
            link = FRAME if FRAME in links else links[0]
            if link == FRAME:
                places[name], velocities[name], accelerations[name] = still + place, still, still
                continue
            link_moved, pin = self.links[link], self.at[link]
            places[name] = link_moved.base + link_moved.turn * (place - link_moved.origin)
            arm = places[name] - (link_moved.base + link_moved.turn * (complex(*map(float, scene.points[pin]))
                                                                       - link_moved.origin))
            velocities[name] = self.velocity[pin] + 1j * self.omega[link] * arm
            accelerations[name] = self.acceleration[pin] + (1j * self.alpha[link] - self.omega[link] ** 2) * arm
        return places, velocities, accelerations


def link_motion(scene: Scene, positions: int) -> LinkMotion:
    """The motion of all links in so many poses of the cycle.

    Fails with `Refused` where the mechanism does not move, with `Disagreement` where construction and solver differ.
    """
    span, closed = _span(scene, positions)
    at = {hanging.link: hanging.at for hanging in spanning_tree(scene).hangings}
    pins = tuple(dict.fromkeys(at.values()))
    bare = replace(scene, loads=None, find=Find(pins, pins, links=scene.moving))
    over_cycle = cycle(bare, positions, span)
    if len(over_cycle.faults) == positions:
        raise Refused(f"{scene.name}: the cycle", next(iter(over_cycle.faults.values())), "another pose")
    if over_cycle.wrong:
        raise Disagreement(scene.name, "motion", f"otherwise in pose {over_cycle.wrong[0]}", "by the solver", math.nan)
    motion, travel = motion_and_travel(bare, positions, span)
    lost = np.isnan(over_cycle.gaps["velocity"])
    links_moved = {link: link_moved._replace(base=np.where(lost, np.nan, link_moved.base))
                   for link, link_moved in motion.links_at(travel).items()}
    still, results = np.zeros(positions, dtype=complex), over_cycle.results
    velocity, acceleration = ({name: results[kind].get(name, still) for name in pins}
                              for kind in ("velocity", "acceleration"))
    return LinkMotion(travel, closed, over_cycle.turn.points, over_cycle.turn.guides, over_cycle.faults, links_moved,
                      at,
                      velocity, acceleration, results["omega"], results["alpha"])


def _span(scene: Scene, positions: int) -> tuple[tuple[float, float], bool]:
    """The span of travel that the mechanism goes through in the sense of its drive, and whether it closes.

    Between limits it keeps half a step off each: at the limit itself there are no velocities.
    """
    motion = whole_motion(scene)
    low, high = motion.ends
    if not scene.drives[0].slides:
        low, high = (round(math.degrees(end), 12) for end in (low, high))
    step = (high - low) / positions
    ends = (low, high - step) if motion.goes_round else (low + step / 2, high - step / 2)
    return ends, motion.goes_round
