"""How a mechanism swings over its cycle: where links turn back and their time ratio, its transmission angle, its type.

A link that turns about the frame, or slides along it, turns back where its rate changes sign. Between its two extreme
positions a uniform crank turns through two angles: the larger over the smaller is the time ratio K of a quick return.
At one end it may dwell: it turns back several times within a small part of its stroke, which counts to neither.
The transmission angle is that between a coupler and the link which it moves, or the normal of its guide: Ozols 1974,
section 5-1. A four-bar linkage is called after Grashof.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from graphplan.cycle.loads import guide_direction, slide_position
from graphplan.cycle.positions import MovingLink
from graphplan.cycle.tolerances import DWELL_TOL, LENGTH_TOL, REST_RATE
from graphplan.cycle.travel import check_drives
from graphplan.cycle.turn import RangeOfMotion, whole_motion
from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Extreme, Scene, Slide
from graphplan.mechanism.travel import TURN
from graphplan.methods.motion.network import Network

SAMPLES = 721  # over the motion: between two of them a rate changes its sign once at most
ANGLE_DIGITS = 3  # of degrees that are told: where crank and coupler come in line the least angle is 0
TRUE_DIGITS = 9  # of degrees: those of a travel that rounding leaves
ROUNDS, CUTS = 8, 33  # of narrowing down, and samples in each


@dataclass(frozen=True)
class Oscillation:
    """A link that swings about the frame, or slides along it, between two extreme positions.

    `outer` is the travel, in degrees, of the one furthest counter-clockwise, or along the guide; `inner` of the other.
    `stroke` is how far it goes between them, in degrees or lengths. `time_ratio` is none where the crank does not go
    round. `dwells` are its rests at an end, as travels from and to.
    """

    link: str
    outer: float
    inner: float
    stroke: float
    time_ratio: float | None
    dwells: tuple[tuple[float, float], ...] = ()

    def travel(self, way: str) -> float:
        """The travel to its outer or inner extreme position."""
        return self.outer if way == "outer" else self.inner


@dataclass(frozen=True)
class Transmission:
    """The least transmission angle of a coupler and the link that it moves, and at which travel; both in degrees."""

    coupler: str
    link: str
    least: float
    travel: float


def time_ratio(one: float, other: float) -> float | None:
    """Of the two turns of a uniform crank between two travels in degrees the larger over the smaller."""
    degrees = (one - other) % 360
    return max(degrees, 360 - degrees) / min(degrees, 360 - degrees) if degrees else None


def time_ratio_of_strokes(outer: tuple[float, float], inner: tuple[float, float]) -> float | None:
    """The same between two rests, each from and to a travel."""
    strokes = (outer[0] - inner[1]) % 360, (inner[0] - outer[1]) % 360
    return max(strokes) / min(strokes) if all(strokes) else None


def swings(scene: Scene) -> list[Oscillation]:
    """The links that turn back as the first drive, a crank, goes on from the given pose.

    Fails with `Refused` where the mechanism does not move.
    """
    check_drives(scene)
    if scene.drives[0].slides:
        return []
    led = {link for pair in (*scene.drives, *scene.contacts) for link in pair.links}  # a contact is left in other poses
    motion = whole_motion(scene)
    travel = np.linspace(*motion.ends, SAMPLES)
    moving = motion.links_at(travel)
    holds = ((link, pivot_or_guide(scene, link)) for link in scene.moving if link not in led)
    results = (_swing(motion, travel, moving[link], link, hold) for link, hold in holds if hold is not None)
    return [swing for swing in results if swing]


def _swing(motion: RangeOfMotion, travel: Any, moving: MovingLink, link: str,
           hold: str | complex) -> Oscillation | None:
    """The swing of a link between the outermost and the innermost of its turning positions; None if it does not turn
    back, or turns round."""
    rates, gone, round_and_back = _rate(moving, hold), _link_travel(moving, hold), motion.goes_round
    if not np.isfinite(rates).all() or np.abs(rates).max() <= REST_RATE:
        return None
    if round_and_back and isinstance(hold, str) and abs(gone[-1] - gone[0]) > math.pi:
        return None
    turning = np.flatnonzero((rates[:-1] * rates[1:] < 0) | (rates[:-1] == 0))
    if round_and_back and rates[-1] * rates[0] < 0:  # in the given pose itself, but for rounding
        turning = np.append(turning, 0)
    if len(turning) < 2:
        return None
    outer, inner = turning[gone[turning].argmax()], turning[gone[turning].argmin()]
    roots = [_root(lambda at: _rate(motion.links_at(at)[link], hold), *travel[k : k + 2]) for k in (outer, inner)]
    there = _link_travel(motion.links_at(np.array(roots))[link], hold)
    stroke = float(gone[outer] - gone[inner] + np.subtract(*_small(there - gone[[outer, inner]])))
    outermost, innermost = map(math.degrees, roots)
    one_turn = round_and_back and motion.ends[1] - motion.ends[0] <= TURN
    rests = [_dwell(motion, travel, gone, turning, end, lambda at: _link_travel(motion.links_at(at)[link], hold))
             if one_turn else None for end in (outer, inner)]
    ratio = time_ratio(outermost, innermost) if one_turn else None
    if any(rests):
        ends = zip(rests, (outermost, innermost), strict=True)
        ratio = time_ratio_of_strokes(*(rest or (at, at) for rest, at in ends))
    return Oscillation(link, outermost, innermost, math.degrees(stroke) if isinstance(hold, str) else stroke, ratio,
                       tuple(rest for rest in rests if rest))


def _dwell(motion: RangeOfMotion, travel: Any, gone: Any, turning: Any, end: int,
           travel_of_link: Callable[[Any], Any]) -> tuple[float, float] | None:
    """From and to which travel, in degrees, a link rests at one end of its stroke, where it turns back there several
    times: as long as it is no further off than it comes in between."""
    off, stroke = np.abs(gone[:-1] - gone[end]), np.ptp(gone)
    near = off <= DWELL_TOL * stroke
    start, stop = _run(near, end)
    inside = [k for k in turning if (k - start) % len(off) <= (stop - start) % len(off)]
    if len(inside) < 2 or near.all():
        return None
    ripple = max(off[place % len(off)] for k in inside for place in (k, k + 1))
    start, stop = _run(off <= ripple, end)
    step = travel[1] - travel[0]

    def excess(at: Any) -> Any:
        return np.abs(_small(travel_of_link(at) - gone[end])) - ripple

    first, last = (_root(excess, at, at + step) for at in (travel[(start - 1) % len(off)], travel[stop]))
    return math.degrees(first) % 360, math.degrees(last) % 360


def _run(holds: Any, at: int) -> tuple[int, int]:
    """The first and the last place, around a cycle, of those without a gap that are like the one at `at`."""
    count, start, stop = len(holds), at % len(holds), at % len(holds)
    while holds[start - 1] and (stop - start) % count < count - 1:
        start = (start - 1) % count
    while holds[(stop + 1) % count] and (stop - start) % count < count - 1:
        stop = (stop + 1) % count
    return start, stop


def _small(gaps: Any) -> Any:
    """Differences that are small, of angles but for whole turns."""
    return gaps - TURN * np.round(gaps / TURN)


def _rate(moving: MovingLink, hold: str | complex) -> Any:
    """Rate of a link about its pivot, or along its guide."""
    return moving.spin if isinstance(hold, str) else (moving.velocity * hold.conjugate()).real / abs(hold)


def _root(rate: Callable[[Any], Any], low: float, high: float) -> float:
    """Find the place where a rate changes its sign."""
    for _ in range(ROUNDS):
        at = np.linspace(low, high, CUTS)
        rates = rate(at)
        k = next((k for k in range(CUTS - 1) if rates[k] * rates[k + 1] <= 0), 0)
        low, high = at[k], at[k + 1]
    return float((low + high) / 2)


def _link_travel(moving: MovingLink, hold: str | complex) -> Any:
    """Travel of a link, an angle or a length, in successive poses."""
    return np.unwrap(np.angle(moving.turn)) if isinstance(hold, str) else (
        moving.base * hold.conjugate()).real / abs(hold)


def pivot_or_guide(scene: Scene, link: str, joint: str = "") -> str | complex | None:
    """The point of the frame, other than a joint, about which a link turns, or the direction in which it slides along
    the frame."""
    about = next((point for point in scene.links[link] if FRAME in scene.links_of[point] and point != joint), None)
    driven = [scene.driven_slide(drive) for drive in scene.drives if drive.slides]
    along = (complex(*map(float, slide.direction)) for slide in scene.slides
             if isinstance(slide, Slide) and {*slide.links} == {link, FRAME} and slide.turns_alike
             and slide not in driven)
    return about or next(along, None)


def slide_ends(scene: Scene, slide: Slide) -> tuple[float, float]:
    """The positions of a slide along its guide between which it moves, the smaller first.

    Fails with `Refused` where it does not move.
    """
    check_drives(scene)
    motion = whole_motion(scene)

    def position(travel: Any) -> Any:
        turn = motion.turn(travel)
        return slide_position(scene, slide, turn.points, guide_direction(slide, turn.points, turn.guides))

    least, most = -_largest(lambda travel: -position(travel), motion.ends)[1], _largest(position, motion.ends)[1]
    if most - least <= REST_RATE * scene.extent:
        raise Refused(f"slides: {slide.name}", "it has no stroke, as it stands still", "a load over the travel")
    return least, most


def _largest(values: Callable[[Any], Any], ends: tuple[float, float]) -> tuple[float, float]:
    """The travel between the ends at which a quantity is largest, and its value there."""
    low, high = ends
    for _ in range(ROUNDS):
        travel = np.linspace(low, high, SAMPLES)
        sizes = values(travel)
        k = int(np.nanargmax(sizes))
        low, high = travel[max(k - 1, 0)], travel[min(k + 1, SAMPLES - 1)]
    return float(travel[k]), float(sizes[k])


# ---- cranks and their couplers ---------------------------------------------------------------------------------------


def coupled_links(scene: Scene, way: str = "outer") -> Iterator[Extreme]:
    """The links that couplers on the first drive's crank swing about a point of the frame, or push along it."""
    net = Network(scene)
    weld = next((weld for weld in net.welds.values() if weld.drive == scene.drives[0]), None)
    if weld is None or weld.slide is not None or weld.to != FRAME:
        return
    free = [link for link in scene.links if link != FRAME and link not in net.welds]
    for coupler in free:
        pins = [point for point in scene.links[coupler] if point in scene.links[weld.link] and point != weld.at]
        for link in free:
            joints = [point for point in scene.links[coupler] if point in scene.links[link] and point not in pins]
            if link != coupler and pins and joints and pivot_or_guide(scene, link, joints[0]) is not None:
                yield Extreme(way, link, coupler, weld.at, pins[0], joints[0])


def transmissions(scene: Scene) -> list[Transmission]:
    """The least transmission angle of each coupler on the crank, over as much of the motion as there is.

    Fails with `Refused` where the mechanism does not move.
    """
    coupled = [*coupled_links(scene)]
    if not coupled:
        return []
    motion = whole_motion(scene)
    return [_least_transmission(motion, at, pivot_or_guide(scene, at.link, at.joint)) for at in coupled]


def _least_transmission(motion: RangeOfMotion, at: Extreme, hold: str | complex | None) -> Transmission:
    """The least angle of a coupler and its link."""
    def sines(travel: Any) -> Any:
        points = motion.turn(travel).points
        along = points[at.joint] - points[at.pin]
        link = points[at.joint] - points[hold] if isinstance(hold, str) else 1j * (hold or 1)
        return np.abs((along * np.conj(link)).imag) / np.abs(along) / np.abs(link)

    travel, most = _largest(lambda travel: -sines(travel), motion.ends)
    return Transmission(at.coupler, at.link, math.degrees(math.asin(min(-most, 1.0))), math.degrees(travel))


# ---- four-bar linkages after Grashof ---------------------------------------------------------------------------------


def grashof(scene: Scene) -> str:
    """The type of a four-bar linkage by its lengths; empty of what is no four-bar linkage."""
    sides = _four_sides(scene)
    if sides is None:
        return ""
    _, coupler, _, frame = sides
    shortest, *others, longest = sorted(sides)
    excess = shortest + longest - sum(others)
    if abs(excess) <= LENGTH_TOL * longest:
        return "change point linkage (Grashof's limit)"
    if excess > 0:
        return "double rocker (not of Grashof's kind)"
    if shortest == frame:
        return "double crank (Grashof)"
    return "double rocker (Grashof)" if shortest == coupler else "crank and rocker (Grashof)"


def _four_sides(scene: Scene) -> tuple[float, ...] | None:
    """The lengths of crank, coupler, rocker and frame of a four-bar linkage."""
    moving = scene.moving
    if len(moving) != 3 or scene.slides or scene.gears or scene.contacts or len(scene.drives) != 1:
        return None
    if scene.drives[0].slides:
        return None
    crank = scene.drives[0].link
    fixed = {*scene.links[FRAME]}
    rocker = next((link for link in moving if link != crank and fixed & {*scene.links[link]}), None)
    coupler = next((link for link in moving if link not in (crank, rocker)), None)
    if rocker is None or coupler is None:
        return None
    points = [fixed & {*scene.links[crank]}, {*scene.links[crank]} & {*scene.links[coupler]},
              {*scene.links[coupler]} & {*scene.links[rocker]}, {*scene.links[rocker]} & fixed]
    if any(len(shared) != 1 for shared in points):
        return None
    O, A, B, C = (scene.points[next(iter(shared))] for shared in points)
    return tuple(math.dist(map(float, p), map(float, q)) for p, q in ((O, A), (A, B), (B, C), (O, C)))


# ---- what a cycle tells ----------------------------------------------------------------------------------------------


def motion_results(scene: Scene) -> dict[str, Any]:
    """Kinematic results of a mechanism over its cycle, those that it has: the `type` of a four-bar linkage; of links
    that turn back the `swings`, with their travels, stroke and time ratio; of couplers and links, such as `2 3`, the
    least `transmission` angle. In degrees, strokes along guides in lengths."""
    try:
        turning, angles = swings(scene), transmissions(scene)
    except Refused:
        turning, angles = [], []
    results = {"type": grashof(scene), "swings": {swing.link: _without_name(swing) for swing in turning},
               "transmission": {f"{angle.coupler} {angle.link}": _without_name(angle) for angle in angles}}
    return {key: value for key, value in results.items() if value}


def _dwell_text(swing: Oscillation) -> str:
    """From and to where a link rests; empty where it does not."""
    rests = " and ".join(f"from {first:.5g}° to {last:.5g}°" for first, last in swing.dwells)
    return f"; it dwells {rests}" if rests else ""


def _without_name(result: Oscillation | Transmission) -> dict[str, float | None]:
    """The numbers of a result, to the digits that are true; never -0."""
    values = asdict(result)
    dwells = [[round(at, TRUE_DIGITS) + 0.0 for at in ends] for ends in values.pop("dwells", ())]
    return {key: None if value is None else round(value, TRUE_DIGITS) + 0.0 for key, value in values.items()
            if key not in ("link", "coupler")} | ({"dwells": dwells} if dwells else {})


def motion_remarks(scene: Scene) -> Iterator[str]:
    """Yield the remarks of a cycle: the mechanism's type, strokes with time ratios, and transmission angles."""
    if kind := grashof(scene):
        yield f"four-bar linkage: {kind}"
    try:
        turning, angles = swings(scene), transmissions(scene)
    except Refused:
        return
    for swing in turning:
        unit = "°" if isinstance(pivot_or_guide(scene, swing.link), str) else f" {scene.units.length}"
        ratio = "" if swing.time_ratio is None else f"; time ratio K = {swing.time_ratio:.4g}"
        yield (f"link {swing.link} turns back at {round(swing.inner, TRUE_DIGITS) + 0.0:.5g}° and "
               f"{round(swing.outer, TRUE_DIGITS) + 0.0:.5g}°, "
               f"stroke {swing.stroke:.5g}{unit}{ratio}{_dwell_text(swing)}")
    for angle in angles:
        yield (f"transmission angle of coupler {angle.coupler} and link {angle.link}: "
               f"at least {round(angle.least, ANGLE_DIGITS):.4g}°, at {round(angle.travel, TRUE_DIGITS):.5g}°")
