"""Reactions with friction: a journal's force touches its friction circle, that of a slide or a contact leans by the
friction angle, that of teeth which lose power crosses the line of centres beside the pitch point, and the normal force
of what rolls lies ahead of the point of contact.

Which way a force leans depends on the force itself, that between teeth by the pressure angle, too. So each round takes
the directions of the forces from the last and solves for all their sizes at once, which is Newton's method: it stands
after a few rounds, or there is no equilibrium and the mechanism locks itself. Friction grows in a few steps: at its
full size at once, where it is near to locking, the rounds may miss the equilibrium. The size of a journal's force is a
root: fractions have friction of slides and contacts alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from typing import Any

from graphplan.errors import SingularPose
from graphplan.mechanism.model import FRAME, Balance, Contact, Gear, Number, Pair, Scene, Slide
from graphplan.mechanism.numbers import dot, minus, plus, quarter_turn, square_root, times
from graphplan.mechanism.pairs.pair import Along, Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.units import metre
from graphplan.solver.rates import Equations, Rates
from graphplan.solver.statics import (
    Reactions,
    equilibrium,
    first_held,
    force,
    held_at,
    leaning_statements,
    radial,
    reactions,
    required_loads,
)
from graphplan.solver.tolerances import FORCE_TOL, FRICTION_TOL, POWER_TOL, SLIP_TOL

GROWING = tuple(Fraction(share, 4) for share in (1, 2, 3, 4))
MAX_FRICTION_ROUNDS = 20


@dataclass(frozen=True)
class Frictional(Reactions):
    """Reactions with friction; a slide's force has its friction in it.

    `couples`: by point and link, the friction's couple on that link, in force * m; the link that carries the pin has
    its opposite. `drags`: by slide, the friction's force on the sliding link. `efficiency`: from the powers of the
    balances; None at rest.
    """

    couples: dict[tuple[str, str], Number]
    drags: dict[str, Pair]
    efficiency: Number | None


def with_friction(scene: Scene, rounds: int = 0, exact: bool = False) -> Frictional:
    """The reactions and balances of the scene with the friction of its journals and slides.

    With `rounds` as so many rounds from those without friction have it, else as they stand; with `exact` as fractions,
    where nothing but slides rubs. Fails as `reactions` does, and with `SingularPose` where the mechanism locks itself.
    """
    plain = last = reactions(scene, exact)
    against = rubbing(scene, plain.rates)
    if rounds:
        for _ in range(rounds):
            last = next_reactions(last, against, exact)
    else:
        for share in GROWING:
            last = converge_reactions(last, against.scale_coefficients(share), exact)
    return frictional_forces(plain, last, against)


def converge_reactions(last: Reactions, against: Rubbing, exact: bool) -> Reactions:
    """The reactions that lean as they themselves say, from reactions that do nearly so."""
    close = FRICTION_TOL * last.condition
    for _ in range(MAX_FRICTION_ROUNDS):
        now = next_reactions(last, against, exact)
        if max(map(math.dist, forces(now), forces(last)), default=0.0) <= close * largest(now):
            return now
        last = now
    raise self_locking_error(last.equations.scene)


def next_reactions(last: Reactions, against: Rubbing, exact: bool) -> Reactions:
    """The reactions that lean as the last ones say."""
    scene = last.equations.scene
    try:
        least = FORCE_TOL * last.condition * largest(last)
        facts = leaning_supports(last, against, lambda size, along: sign(float(size) * math.hypot(*along), least))
        return equilibrium(Equations(scene, tuple(facts)), last.rates, exact)
    except SingularPose:
        raise self_locking_error(scene) from None


def leaning_supports(last: Reactions, against: Rubbing, acts: Sense) -> Iterator[Statement]:
    """The supports of the scene, each pair's turned aside by friction as its last force says: as that `acts`, so many
    times a direction.

    A journal's line of action touches the friction circle. The force of a slide, a contact or a gear leans; that of a
    gear that loses power crosses the line of centres beside the pitch point. That of a contact that rolls has a moment
    against the turning. Of a slide that is pressed at both edges the couple has a force along the guide.
    """
    scene, edges, root = last.equations.scene, edge_couples(last), last.equations.root
    for pair in scene.binding:
        if isinstance(pair, Revolute):
            for part in pair.states(scene):
                force, circle = last.joints[pair.at, part.link], against.journals[pair.at, part.link]
                if circle and acts(1, force):
                    part = replace(part, lever=circle / root(dot(force, force)) * dot(part.direction, force))
                yield part
        elif isinstance(pair, Slide):
            by_couple = against.guides[pair] * edges.get(pair.name, 0)
            for fact in pair.states(scene):
                if by_couple and not isinstance(fact, Along):
                    unit = by_couple / root(dot(pair.direction, pair.direction))
                    yield Along(pair.link, pair.along, pair.at, times(unit, pair.direction), fact.way, lever=1)
                elif isinstance(fact, Along) and not by_couple:
                    size = dot(fact.direction, last.slides[pair.name][0]) / dot(fact.direction, fact.direction)
                    aside = times(against.guides[pair] * acts(size, fact.direction), pair.direction)
                    yield replace(fact, direction=plus(fact.direction, aside))
                else:
                    yield fact
        elif isinstance(pair, Gear):
            along = radial(last.equations, pair) if pair.grip else first_held(last.equations, pair)
            sense = acts(last.higher[pair.name][0], along)
            efficiency, turns = against.teeth.get(pair, (1, 0))
            crossing = pair.crossing(efficiency, -turns * sense) if pair in against.teeth else 1
            yield from leaning_statements(last.equations, pair, sense, crossing)
        elif isinstance(pair, Contact):
            along = first_held(last.equations, pair)
            sense, (first, *others) = acts(last.higher[pair.name][0], along), pair.states(scene)
            if not pair.rolling:
                yield from leaning_statements(last.equations, pair, against.guides[pair] * sense)
                continue
            arm_ahead = against.rollers[pair] * sense
            yield replace(first, lever=arm_ahead * root(dot(along, along))) if arm_ahead else first
            yield from others
    for balance in required_loads(scene).balances:
        yield from balance.states(scene)


def forces(solution: Reactions) -> list[Pair]:
    """The forces in all pairs and those of the balances, and the moments as forces at the mechanism's reach."""
    scene, arm = solution.equations.scene, solution.equations.reach / metre(solution.equations.scene.units)
    moments = [moment for _, moment in solution.slides.values()]
    return [*solution.joints.values(), *(force for force, _ in solution.slides.values()),
            *(force(solution.equations, pair, solution.higher[pair.name]) for pairs in (scene.gears, scene.contacts)
              for pair in pairs if pair.name in solution.higher),
            *(balance if isinstance(balance, tuple) else (float(balance) / arm, 0) for balance in solution.balances),
            *((float(moment) / arm, 0) for moment in moments)]


def contact_forces(solution: Reactions) -> dict[str, Pair]:
    """The forces in slides, gears and contacts, each on its first link, with what leans in them."""
    scene, facts, forces_on_first_links = solution.equations.scene, iter(solution.equations.facts), dict[str, Pair]()
    for pair in scene.binding:
        pair_facts = [next(facts) for _ in pair.states(scene)]
        if isinstance(pair, Slide) and pair.name in solution.slides:
            normal, (force, moment) = quarter_turn(pair.direction), solution.slides[pair.name]
            sizes = {"across": dot(normal, force) / dot(normal, normal), "turn": moment * metre(scene.units)}
            parts = (times(sizes[fact.way], fact.direction) for fact in pair_facts if isinstance(fact, Along))
            forces_on_first_links[pair.name] = reduce(plus, parts)
        elif isinstance(pair, Gear | Contact) and pair.name in solution.higher:
            total: Pair = (0, 0)
            for fact, size in zip(pair_facts, solution.higher[pair.name], strict=True):
                x, y, _ = held_at(solution.equations, fact)
                total = plus(total, times(size if fact.link == pair.links[0] else -size, (x, y)))
            forces_on_first_links[pair.name] = total
    return forces_on_first_links


def largest(solution: Reactions) -> float:
    """The largest force of a solution; rounding is compared with it."""
    return max((math.hypot(*force) for force in forces(solution)), default=0.0)


def self_locking_error(scene: Scene) -> SingularPose:
    """The error that no balance keeps the motion up, with the links that rub."""
    rubbed = {link for f in required_loads(scene).frictions for link in f.links or scene.links_of[f.at]}
    why = "self-locking: with this friction no balance keeps up the motion"
    return SingularPose(why, tuple(link for link in scene.moving if link in rubbed))


def frictional_forces(plain: Reactions, last: Reactions, against: Rubbing) -> Frictional:
    """The last round's forces with what friction is in them: a slide's is along its guide."""
    unit, couples, drags = metre(plain.equations.scene.units), dict[tuple[str, str], Number](), dict[str, Pair]()
    for name, circle in against.journals.items():
        couples[name] = circle * math.hypot(*last.joints[name]) / unit if circle else circle
    edges = edge_couples(last)
    for slide in plain.equations.scene.slides:
        across, (force, moment) = quarter_turn(slide.direction), last.slides[slide.name]
        size = dot(across, force) / dot(across, across)
        rubbed = max(size, -size)
        if slide.name in edges:
            long = last.equations.root(dot(slide.direction, slide.direction))
            rubbed = edges[slide.name] * moment * unit / long
        drags[slide.name] = times(against.guides[slide] * rubbed, slide.direction)
    slides = {name: (plus(force, drags[name]), moment) for name, (force, moment) in last.slides.items()}
    return Frictional(last.equations, last.joints, slides, last.higher, last.balances, last.rates, couples,
                      drags, efficiency(delivered_power(plain), delivered_power(last, rubs=True)))


def edge_couples(solution: Reactions) -> dict[str, Number]:
    """Of each slide that is pressed at both edges, by name, the sum of their forces by its couple, as large as that is.

    They are so where the reaction lies beyond the length on which the slide bears (Ozols 1974, 12-2, fig. 12-7).
    """
    scene, edges = solution.equations.scene, dict[str, Number]()
    loads, slides = required_loads(scene), {frozenset(slide.links): slide for slide in scene.slides}
    for friction in (friction for friction in loads.frictions if friction.length):
        slide = slides[frozenset(friction.links)]
        force, couple = solution.slides[slide.name]
        beyond = 2 * couple * metre(scene.units) / friction.length
        if slide.name in loads.pressed if loads.pressed is not None else beyond * beyond > dot(force, force):
            edges[slide.name] = Fraction(2 * sign(float(couple), 0)) / friction.length
    return edges


def pressed_slides(standing: Frictional) -> dict[str, int]:
    """The slides that are pressed at both edges, as the loads of a scene say it: in a standing solution."""
    edges, against = edge_couples(standing), rubbing(standing.equations.scene, standing.rates).guides
    sides = {slide.name: -sign(float(against.get(slide, 0) * edges[slide.name]), 0)
             for slide in standing.equations.scene.slides if slide.name in edges}
    return {name: side for name, side in sides.items() if side}


# --- which way friction acts: against the turning in each journal and the slip in each slide -----------------------


Teeth = dict[Gear, tuple[Number, int]]
Sense = Callable[[Any, Any], int]


@dataclass(frozen=True)
class Rubbing:
    """Effect of friction on reactions, negative where it opposes a positive motion.

    `journals`: by point and link, the radius of the friction circle. `guides`: by slide or contact, the coefficient of
    friction. `teeth`: by gear that loses power, its efficiency and the sense of the first wheel's turning on the arm.
    `rollers`: by contact that rolls, the arm of its normal force.
    """

    journals: dict[tuple[str, str], Number]
    guides: dict[Slide | Contact, Number]
    teeth: Teeth
    rollers: dict[Contact, Number]

    def scale_coefficients(self, share: Number) -> Rubbing:
        """Return the frictions with all coefficients scaled."""
        journals = {name: share * circle for name, circle in self.journals.items()}
        teeth: Teeth = {gear: (1 - share * (1 - efficiency), turns) for gear, (efficiency, turns) in self.teeth.items()}
        guides = {pair: share * coefficient for pair, coefficient in self.guides.items()}
        return Rubbing(journals, guides, teeth, {pair: share * arm for pair, arm in self.rollers.items()})


def rubbing(scene: Scene, rates: Rates, moves: Sense | None = None) -> Rubbing:
    """The frictions of the scene, with the senses of these rates; zero for a pair at rest.

    A rate within rounding of the fastest motion counts as rest, unless `moves` decides otherwise.
    """
    loads, reach, moves = required_loads(scene), rates.equations.reach, moves or beyond_rounding(rates)
    circles = {f.at: f.radius * f.coefficient for f in loads.frictions}
    coefficients = {frozenset(f.links): f.coefficient for f in loads.frictions}
    journals, guides = dict[tuple[str, str], Number](), dict[Slide | Contact, Number]()
    for joint, link, turning in turnings(rates):
        rests = name_in_joint(joint, link) in loads.resting
        against = 0 if rests else -moves(turning, reach)
        journals[joint, link] = circles.get(joint, Fraction(0)) * against
    for pair, slip in slips(rates):
        along = pair.direction if isinstance(pair, Slide) else pair.normal(scene.points)
        against = 0 if pair.name in loads.resting else -moves(slip, 1 / math.hypot(*along))
        guides[pair] = coefficients.get(frozenset(pair.links), Fraction(0)) * against
    teeth: Teeth = {}
    for gear, turning in gear_turnings(rates):
        if frozenset(gear.links) in coefficients and gear.name not in loads.resting:
            turns = gear.arm_sense * moves(turning, reach)
            teeth[gear] = 1 - coefficients[frozenset(gear.links)], turns
    rollers: dict[Contact, Number] = {}
    for contact, turning in rolling_turnings(rates):
        against = 0 if contact.name in loads.resting else -moves(turning, reach)
        rollers[contact] = coefficients.get(frozenset(contact.links), Fraction(0)) * against
    return Rubbing(journals, guides, teeth, rollers)


def rolling_turnings(rates: Rates) -> Iterator[tuple[Contact, Number]]:
    """Yield each rolling contact with the angular velocity of the link that it holds first, relative to the other."""
    omega = {**rates.omega, FRAME: 0}
    for contact in rates.equations.scene.contacts:
        link, on, _ = contact.curved_side
        if contact.rolling:
            yield contact, omega[link] - omega[on]


def gear_turnings(rates: Rates) -> Iterator[tuple[Gear, Number]]:
    """Yield each gear with the angular velocity of its first wheel relative to the second."""
    omega = {**rates.omega, FRAME: 0}
    for gear in rates.equations.scene.gears:
        yield gear, omega[gear.links[0]] - omega[gear.links[1]]


def turnings(rates: Rates) -> Iterator[tuple[str, str, Number]]:
    """Of every journal its joint, the link in it, and how fast that turns on the link that carries the pin."""
    omega = {**rates.omega, FRAME: 0}
    for joint in rates.equations.scene.revolutes:
        for link in joint.links[1:]:
            yield joint.at, link, omega[link] - omega[joint.links[0]]


def slips(rates: Rates) -> Iterator[tuple[Slide | Contact, Number]]:
    """Yield the sliding velocity of each slide and contact, as a multiple of its direction's or its normal's length."""
    scene = rates.equations.scene
    for slide in scene.slides:
        yield slide, dot(rates.slide_velocity[slide.name], slide.direction)
    for contact in scene.contacts:
        if not contact.rolling:
            yield contact, contact_slip(rates, contact)


def resting(rates: Rates, vanishes: Callable[[Number], bool]) -> frozenset[str]:
    """The names of the pairs that stand still: those whose turning or sliding `vanishes`."""
    journals = (name_in_joint(joint, link) for joint, link, turning in turnings(rates) if vanishes(turning))
    moving = *slips(rates), *gear_turnings(rates), *rolling_turnings(rates)
    return frozenset((*journals, *(pair.name for pair, rate in moving if vanishes(rate))))


def name_in_joint(joint: str, link: str) -> str:
    """The name of a journal: of the link in the joint."""
    return f"{link} at {joint}"


def contact_slip(rates: Rates, contact: Contact) -> Number:
    """Sliding velocity of the link that the contact holds first, relative to the other, along its normal turned by a
    quarter.

    In as many times the normal's length as it has.
    """
    fact = next(contact.states(rates.equations.scene))
    slip = minus(moved_with(rates, fact.link, contact.at), moved_with(rates, fact.on, contact.at))
    return dot(slip, quarter_turn(first_held(rates.equations, contact)))


# ---- what the balances deliver ---------------------------------------------------------------------------------------


def beyond_rounding(rates: Rates) -> Sense:
    """Return the sense of a rate; 0 if rounding could make it of what moves fastest."""
    points = (abs(float(x)) for v in (rates.velocity, rates.slide_velocity) for pair in v.values() for x in pair)
    turns = (abs(float(turn)) * rates.equations.reach for turn in rates.omega.values())
    least = SLIP_TOL * rates.condition * max(*points, *turns, 0.0)
    return lambda rate, scale: sign(float(rate) * float(scale), least)


def moved_with(rates: Rates, link: str, place: str) -> Pair:
    """The velocity of a place as a point of a link."""
    if link == FRAME:
        return 0, 0
    arm, base = rates.equations.arm(link, place), rates.equations.bases[link]
    return plus(rates.velocity[base], times(rates.omega[link], quarter_turn(arm)))


def sign(value: Any, least: Any) -> Any:
    """Sign of a number, or of each in an array: 1 or -1, or 0 if it is no larger than `least`."""
    return 1 * (value > least) - 1 * (value < -least)


def delivered_power(solution: Reactions, rubs: bool = False) -> Number:
    """The power that the balances give, in force * length/s; with the friction of screws where it `rubs`."""
    scene, rates = solution.equations.scene, solution.rates
    power: Number = Fraction(0)
    for balance, value in zip(required_loads(scene).balances, solution.balances, strict=True):
        (driven, counter), omega = balance.links, {**rates.omega, FRAME: 0}
        if isinstance(value, tuple):
            share = screw_share(solution, balance, value) if rubs else 1
            power += share * dot(value, minus(moved_with(rates, driven, balance.at),
                                              moved_with(rates, counter, balance.at)))
        else:
            power += value * metre(scene.units) * (omega[driven] - omega[counter])
    return power


def screw_share(solution: Reactions, balance: Balance, value: Pair) -> Number:
    """By how many times friction makes the moment on a screw larger through which a balance acts; 1 without one."""
    screw = required_loads(solution.equations.scene).screw_of(balance)
    return screw.circumferential(screw_sense(solution, balance, value)[1]) / screw.slope if screw else 1


def screw_sense(solution: Reactions, balance: Balance, value: Pair, sense: Sense | None = None) -> tuple[Slide, Any]:
    """The slide that a screw moves through which a balance acts; and 1 where that drives, -1 where its load does, and 0
    where it stands still."""
    scene, rates = solution.equations.scene, solution.rates
    moves, acts = (sense, sense) if sense else (beyond_rounding(rates), lambda pull, _: sign(float(pull), 0))
    slide = next(slide for slide in scene.slides if {*slide.links} == {*balance.links})
    slip, pull = (dot(v, slide.direction) for v in (rates.slide_velocity[slide.name], value))
    still = 0 if slide.name in required_loads(scene).resting else 1
    scale = 1 / square_root(dot(slide.direction, slide.direction))
    return slide, (still if balance.link == slide.link else -still) * moves(slip, scale) * acts(pull, 1)


def screw_moments(solution: Reactions, sense: Sense | None = None) -> dict[str, Number]:
    """By slide, the moment on the screw that moves it, in force * m: positive where it drives along the direction.

    `sense` gives the sense of a rate or a force; without it a rate within rounding of the fastest motion counts as
    rest.
    """
    loads, moments = required_loads(solution.equations.scene), dict[str, Number]()
    for balance, value in zip(loads.balances, solution.balances, strict=True):
        if (screw := loads.screw_of(balance)) and isinstance(value, tuple):
            slide, drives = screw_sense(solution, balance, value, sense)
            arm = screw.radius / metre(solution.equations.scene.units) * screw.circumferential(drives)
            arm /= square_root(dot(slide.direction, slide.direction))
            moments[slide.name] = (arm if balance.link == slide.link else -arm) * dot(value, slide.direction)
    return moments


def efficiency(smooth: Any, rubbed: Any) -> Any:
    """The efficiency from the powers of the balances without friction and with it; None where neither gives any.

    Where the balances drive, it is the power without by the power with friction. Where the loads drive and the balances
    hold back, it is the inverse: negative where the loads alone do not overcome the friction.
    """
    if smooth >= 0 and not rubbed:  # power that friction would not take of it is rounding
        return None
    if abs(smooth) <= POWER_TOL * abs(rubbed):
        return 0 * rubbed
    return smooth / rubbed if smooth > 0 else rubbed / smooth
