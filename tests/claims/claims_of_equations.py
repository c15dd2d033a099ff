"""Claims about the equations: links keep their lengths, are in equilibrium, rates are derivatives of the motion.

What the solver says is held against what does not depend on it: sums that are taken here, and poses that are followed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
from claim import claim
from face import Got

import graphplan as gp

METRES = {"m": Fraction(1), "cm": Fraction(1, 100), "mm": Fraction(1, 1000), "in": Fraction(254, 10000),
          "ft": Fraction(3048, 10000)}
POUND = Fraction(45359237, 10**8)
GRAVITY = Fraction(980665, 10**5)
KILOGRAMS = {"kg": Fraction(1), "g": Fraction(1, 1000), "lb": POUND}
NEWTONS = {"N": Fraction(1), "kN": Fraction(1000), "kgf": GRAVITY, "lbf": POUND * GRAVITY}
"""What a unit is, by definition."""
STEP = 1e-3  # of a turn in radians, or of the extent of the mechanism: of differences, whose error is its fourth power

RATES = "velocity", "acceleration", "omega", "alpha"
Push = tuple[str, Any, Any]
Value = Any  # a number, or a vector as a complex number or a pair
Compared = tuple[str, str, Value, Value]


def is_exact(scene: gp.Scene) -> bool:
    """Whether a scene has fractions: placed by coordinates, and without journals, whose friction has roots."""
    return not scene.irrational and not (scene.loads and scene.loads.frictions)


# ---- links keep their lengths ----------------------------------------------------------------------------------------


def stretching(scene: gp.Scene, rates: Any) -> Iterator[Any]:
    """Half of the first and of the second derivative of the square of every length within a link."""
    for names in scene.links.values():
        for p, q in combinations(names, 2):
            side, v, a = ((of[p][0] - of[q][0], of[p][1] - of[q][1])
                          for of in (scene.points, rates.velocity, rates.acceleration))
            yield side[0] * v[0] + side[1] * v[1]
            yield v[0] * v[0] + v[1] * v[1] + side[0] * a[0] + side[1] * a[1]


@claim(cheap=True, having=lambda scene: not scene.irrational)
def links_keep_their_lengths(got: Got) -> None:
    """In fractions the first and second derivative of each length within a link is 0, and floats are their rounding."""
    exact, rough = (gp.analytic.solve(got.scene, exact).rates for exact in (True, False))
    assert {*stretching(got.scene, exact)} <= {0}
    for first, second in (("velocity", "acceleration"), ("slide_velocity", "slide_acceleration"), ("omega", "alpha")):
        for kind in (first, second):
            right, found = ({name: value if isinstance(value, tuple) else (value,) for name, value in table.items()}
                            for table in (getattr(exact, kind), getattr(rough, kind)))
            assert [*found] == [*right]
            assert {type(part) for value in right.values() for part in value} <= {Fraction}
            assert {type(part) for value in found.values() for part in value} <= {float}
            size = max((abs(float(part)) for value in right.values() for part in value), default=0.0)
            close = 1e-11 * (size or max(abs(float(rate)) for rate in exact.omega.values()) ** 2)
            assert all(abs(one - part) <= close for name, value in right.items()
                       for one, part in zip(found[name], value, strict=True)), kind


# ---- each link is in equilibrium -------------------------------------------------------------------------------------


def pushes(found: Any, scene: gp.Scene, link: str) -> Iterator[Push]:
    """What the pairs, with their friction, and the balances do to a link: a point, a force there, a moment."""
    couples = getattr(found, "couples", {})
    for (p, other), value in found.joints.items():
        for sign in (other == link) * [1] + (scene.links_of[p][0] == link) * [-1]:
            yield p, (sign * value[0], sign * value[1]), sign * couples.get((p, other), 0)
    for s in scene.slides:
        value, couple = found.slides[s.name]
        for sign in (s.link == link) * [1] + (s.along == link) * [-1]:
            yield s.at, (sign * value[0], sign * value[1]), sign * couple
    for balance, held in zip(scene.loads.balances, found.balances, strict=True):
        if balance.link == link:
            yield (balance.at, held, 0) if balance.direction else (scene.links[link][0], (0, 0), held)


def burdens(found: Any, scene: gp.Scene, link: str) -> Iterator[Push]:
    """What the loads do to a link, inertia among them, in N and N m."""
    given, unit = scene.loads, NEWTONS[scene.units.force]
    yield from ((f.at, (unit * f.value[0], unit * f.value[1]), 0) for f in given.forces if f.on == link)
    yield from ((scene.links[link][0], (0, 0), unit * m.value) for m in given.moments if m.on == link)
    if link in given.masses:
        body, kilograms = given.masses[link], KILOGRAMS[scene.units.mass]
        a = (METRES[scene.units.length] * part for part in found.rates.acceleration[body.centre])
        inertia = tuple(kilograms * body.mass * (g - part) for g, part in zip(given.gravity, a, strict=True))
        yield body.centre, inertia, -kilograms * body.inertia * found.rates.alpha[link]


def left_over(found: Any, scene: gp.Scene, link: str) -> tuple[Any, Any, Any]:
    """The sums of all forces on a link and of their moments about the origin, in N and N m."""
    unit, metre = NEWTONS[scene.units.force], METRES[scene.units.length]
    acting = [(p, (unit * x, unit * y), unit * m) for p, (x, y), m in pushes(found, scene, link)]
    acting += burdens(found, scene, link)
    turning = (m + metre * (scene.points[p][0] * y - scene.points[p][1] * x) for p, (x, y), m in acting)
    return sum(x for _, (x, _), _ in acting), sum(y for _, (_, y), _ in acting), sum(turning)


def numbers_of(found: Any) -> Iterator[Any]:
    """Every number of the forces of a machine, always in the same order."""
    yield from (x for value in found.joints.values() for x in value)
    yield from (x for value, couple in found.slides.values() for x in (*value, couple))
    yield from (x for held in found.balances for x in (held if isinstance(held, tuple) else (held,)))


def has_lower_pairs_alone(scene: gp.Scene) -> bool:
    """Whether a loaded scene has joints and slides alone, each with one answer."""
    return bool(scene.loads and not scene.gears and not scene.contacts and not scene.redundant
                and not any(balance.on != "frame" for balance in scene.loads.balances if hasattr(balance, "on")))


@claim(cheap=True, having=has_lower_pairs_alone)
def links_are_in_equilibrium(got: Got) -> None:
    """Of each link the loads, what the pairs do to it and its inertia add up to 0; powers find the same balances."""
    scene, exact = got.scene, is_exact(got.scene)
    plain = gp.analytic.reactions(scene, exact)
    close = 0 if exact else 1e-9 * max(abs(float(number)) for number in numbers_of(plain)) * float(
        max(1, NEWTONS[scene.units.force]))
    rubbed = [gp.analytic.with_friction(scene)] if scene.loads.frictions else []
    for found in (plain, *rubbed):
        for link in scene.moving:
            assert max(map(abs, left_over(found, scene, link))) <= close, link
    balances = np.ravel([*map(np.ravel, plain.balances)]), np.ravel([*map(np.ravel, gp.analytic.power(scene, exact))])
    assert np.abs(np.subtract(*balances)).max(initial=0) <= close


@claim(cheap=True, having=lambda scene: scene.loads and scene.slides)
def the_force_of_a_slide_acts_where_it_is_said_to(got: Got) -> None:
    """The line of a slide's force, through the place that is told, has the moment about the pair that is told."""
    metre = float(METRES[got.scene.units.length])
    for entry in got.solved["reactions"]:
        if "acts_at" in entry:
            slide = next(slide for slide in got.scene.slides if slide.name == entry["slide"])
            x, y = (metre * (place - float(pin)) for place, pin in zip(entry["acts_at"], got.scene.points[slide.at],
                                                                       strict=True))
            f, g = entry["force"]
            assert abs(x * g - y * f - entry["moment"]) <= 1e-9 * math.hypot(f, g) * float(got.scene.extent) * metre


# ---- rates are derivatives of the motion -----------------------------------------------------------------------------


def derivatives(z: Any, step: float) -> tuple[Any, Any]:
    """First and second derivative in the middle of five values, by differences of the fourth order."""
    far, back, here, ahead, beyond = z
    return ((far - 8 * back + 8 * ahead - beyond) / (12 * step),
            (-far + 16 * back - 30 * here + 16 * ahead - beyond) / (12 * step**2))


def goes_round(scene: gp.Scene) -> bool:
    """Whether one drive moves a scene, whose motion breaks nowhere here."""
    return len(scene.drives) == 1 and not scene.motions and scene.drives[0].rate != 0 and not any(
        contact.beyond for contact in scene.contacts)


@claim(cheap=True, having=goes_round)
def rates_are_derivatives_of_the_motion(got: Got) -> None:
    """Velocities and accelerations are what differences of the followed places make of them."""
    assert_derivatives(got.scene)


def assert_derivatives(scene: gp.Scene) -> None:
    """Follows a scene a little to both sides, and compares; a point under the pin of a slide is followed as the pin."""
    (drive,) = scene.drives
    step = STEP * float(scene.extent) if drive.slides else STEP
    told = step if drive.slides else math.degrees(step)
    poses = gp.follow(scene, 5, (-2 * told, 2 * told))
    assert not poses.faults
    rates, rate, change = gp.analytic.solve(scene).rates, float(drive.rate), float(drive.change)
    sense = math.copysign(1.0, rate)
    moved, places = {}, [*scene.points.values()]
    for name in (name for name, at in scene.points.items() if places.count(at) == 1):
        z = poses.points[name]
        by_travel, twice = derivatives(z, step * sense)
        moved[name] = by_travel * rate, twice * rate**2 + by_travel * change
    speed, most = (max(abs(complex(*value)) for value in table.values()) for table in (rates.velocity,
                                                                                       rates.acceleration))
    for name, (velocity, acceleration) in moved.items():
        if name in rates.velocity:
            assert abs(velocity - complex(*rates.velocity[name])) <= 1e-7 * speed, name
            gap = abs(acceleration - complex(*rates.acceleration[name]))
            assert gap <= 1e-5 * max(most, speed**2 / float(scene.extent)), name


# ---- printed numbers are right: fractions of the solver are another way than what is drawn ---------------------------


def compared(scene: gp.Scene, found: gp.Results) -> Iterator[Compared]:
    """Each printed number with its kind, its name, and what the solver makes of it in fractions."""
    rates = gp.analytic.solve(scene, exact=True)
    for kind in RATES:
        for name, value in getattr(found, kind).items():
            yield kind, name, value, getattr(rates, kind)[name]
    if scene.loads is not None:
        held = gp.analytic.reactions(scene, exact=True)
        for (point, link), value in held.joints.items():
            if (name := f"{link} at {point}") in found.reactions:
                yield "reaction", name, found.reactions[name], value
        for number, value in enumerate(held.balances):
            yield "balance", str(number), found.balances[number], value


def parts(value: Value) -> list[Fraction]:
    """A number alone, or both of a vector, exactly."""
    if isinstance(value, complex):
        return [Fraction(value.real), Fraction(value.imag)]
    return [*map(Fraction, value)] if isinstance(value, tuple) else [Fraction(value)]


def wrong(scene: gp.Scene, found: gp.Results, share: float, cancel: tuple[str, ...] = (),
          alone: bool = False) -> list[Compared]:
    """The numbers that are off by more than a share of their vector, or of the largest of a kind that cancels; `alone`
    of themselves, but that what has none of the twelve digits of the largest of its kind may be 0."""
    numbers = [*compared(scene, found)]
    assert numbers
    largest: dict[str, Fraction] = {}
    for kind, *_, right in numbers:
        largest[kind] = max(largest.get(kind, Fraction(0)), *map(abs, parts(right)))

    def off(kind: str, value: Value, right: Value) -> bool:
        whole = largest[kind] if kind in cancel else max(map(abs, parts(right)))
        return any(abs(one - true) > Fraction(share) * (abs(true) if alone else whole)
                   and not (alone and one == 0 and abs(true) * 10**11 <= largest[kind])
                   for one, true in zip(parts(value), parts(right), strict=True))

    return [(kind, name, value, right) for kind, name, value, right in numbers if off(kind, value, right)]


@claim(cheap=True, having=lambda scene: is_exact(scene) and not scene.redundant)
def nine_digits_are_right(got: Got) -> None:
    """Each printed number has nine digits of its vector."""
    assert wrong(got.scene, gp.Results(got.scene, got.printed("solve")), 1e-9) == []
