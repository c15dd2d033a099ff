"""The independent checks of a synthesis: the given positions by loop closure in complex numbers, envelopes by numerical
differentiation, involutes by their equation; and every linkage followed by the cycle through its positions.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.tolerances import ENVELOPE_TOL, FOLLOWED_TOL, RATE_WEIGHT, STENCIL_STEP, SYNTHESIS_TOL
from graphplan.cycle.turn import RangeOfMotion
from graphplan.kernel.numbers.arrays import sign_change
from graphplan.mechanism.scene import parse
from graphplan.synthesis.conjugate import ConjugateMotion
from graphplan.synthesis.exports import linkage_tables, task_scene_text
from graphplan.synthesis.gear import GearPair, InvoluteWheel
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.paths import PathOfPoint, coupler_point
from graphplan.synthesis.sketch import Synthesis, largest, place_of
from graphplan.synthesis.stroke import SlottedLever
from graphplan.synthesis.task import SynthesisTask

PATH_POSES = 36  # at which a cognate is placed
STENCIL = (1 / 12, -2 / 3, 0.0, 2 / 3, -1 / 12)  # of five neighbours


def check_synthesis(synthesis: Synthesis) -> dict[str, float]:
    """By how much the independent results differ, relative to the largest length.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where they differ by more than
    rounding, numerical differentiation or following allows.
    """
    task = synthesis.task
    for values in {id(values): values for values in synthesis.drawings}.values():
        require_claims(task.name, values)
    check = {"guidance": _guidance, "function": _function, "stroke": _stroke, "cognates": _cognates, "dwell": _dwell,
             "geneva": _geneva, "conjugate": _conjugate, "gear": _gear}[task.kind]
    gaps = {"positions": check(synthesis)}
    most = ENVELOPE_TOL if task.kind == "conjugate" else SYNTHESIS_TOL
    require_agreement(task.name, gaps, most, by="by the independent check")
    travelled = [linkage for linkage in synthesis.linkages if linkage.travel is not None and len(linkage.A) > 1]
    if travelled:
        followed = {"cycle": max(follow_linkage(task, linkage) for linkage in travelled)}
        require_agreement(task.name, followed, FOLLOWED_TOL, by="by the cycle")
        gaps |= followed
    return gaps


def follow_linkage(task: SynthesisTask, linkage: FoundLinkage) -> float:
    """Largest distance of its points from the given positions when the cycle follows it there, relative to its size."""
    assert linkage.travel is not None
    scene = parse(task_scene_text(task, linkage_tables(linkage)), task.name)
    travel = np.radians((linkage.further.get("driver") or {"travel": linkage.travel})["travel"])
    points = RangeOfMotion(scene, 0.0, float(travel[-1]), False).turn(travel).points
    size = largest(z - linkage.O for z in (*linkage.A, *linkage.B))
    names = {linkage.names[1]: linkage.A, linkage.names[2]: linkage.B, **linkage.carried}
    if isinstance(linkage, SlottedLever):
        del names["B"]
    gaps = [abs(points[name] - np.array(places)).max() / size for name, places in names.items()]
    return float(max(gaps))


def _spread(lengths: Sequence[float]) -> float:
    return max(lengths) - min(lengths)


def _guidance(synthesis: Synthesis) -> float:
    """A and B, carried by the plane through its positions, keep their distances from O and C; the poles stand still."""
    frames = [(complex(x, y), cmath.exp(1j * math.radians(angle))) for x, y, angle in synthesis.task.request.positions]
    (m, e), worst, size = frames[0], 0.0, largest(m for m, _ in frames)
    for linkage in synthesis.linkages:
        assert linkage.C is not None
        for pivot, pin in ((linkage.O, linkage.A[0]), (linkage.C, linkage.B[0])):
            places = [n + f * (pin - m) / e for n, f in frames]
            long = max(size, *linkage.sides.values())
            worst = max(worst, _spread([abs(z - pivot) for z in places]) / long)
    for key, places in synthesis.results["poles"].items():
        if places["fixed"] is not None:
            w, at = complex(*places["moving"]), complex(*places["fixed"])
            involutes = place_of(synthesis.values, f"P{key}")
            far = max(size, abs(at))
            carried = [frames[int(k) - 1][0] + frames[int(k) - 1][1] * w for k in key]
            worst = max(worst, *(abs(z - at) / far for z in (involutes, *carried)))
    for point in synthesis.results.get("circle_points", ()):
        w, at = complex(point["u"], point["z"]), complex(*point["centre"])
        lengths = [abs(n + f * w - at) for n, f in frames]
        worst = max(worst, _spread(lengths) / max(size, *lengths))
    return worst


def _function(synthesis: Synthesis) -> float:
    """The coupler keeps its length at all pairs, and what is given is kept."""
    return max(_coupler_gap(synthesis.task, linkage) for linkage in synthesis.linkages)


def _coupler_gap(task: SynthesisTask, linkage: FoundLinkage) -> float:
    """By how much the coupler of a linkage changes its length, or the crank is not the given one, relative to its
    size."""
    request = task.request
    turned = [cmath.exp(1j * math.radians(angle - request.input[0])) for angle in request.input]
    A = [linkage.O + (linkage.A[0] - linkage.O) * turn for turn in turned]
    if request.rocker:
        C = complex(*request.rocker["pivot"])
        B = [C + (linkage.B[0] - C) * cmath.exp(1j * math.radians(angle - request.rocker["angles"][0]))
             for angle in request.rocker["angles"]]
    else:
        velocity = complex(*request.slide["direction"])
        B = [complex(*request.slide["through"]) + place * velocity / abs(velocity) for place in request.slide["at"]]
    gaps = [_spread([abs(b - a) for a, b in zip(A, B, strict=True)])]
    if request.crank:
        gaps.append(abs(linkage.A[0] - linkage.O - cmath.rect(request.crank, math.radians(request.input[0]))))
    return max(gaps) / largest([linkage.O - z for z in (*A, *B)])


def _stroke(synthesis: Synthesis) -> float:
    """Crank and coupler are in line in both positions, the ratio of the turns is K, and what is given is kept."""
    request, worst = synthesis.task.request, 0.0
    for linkage in synthesis.linkages:
        size, C = largest([*linkage.A, *linkage.B, linkage.C or 0]), linkage.C or 0
        start, two = (A - linkage.O for A in linkage.A)
        turn = math.degrees(cmath.phase(two / start)) % 360
        gaps = [math.radians(min(abs(turn - 180 - request.angle), abs(turn - 180 + request.angle))) * size]
        if isinstance(linkage, SlottedLever):
            gaps += [abs(((C - A) * A.conjugate()).real) / size for A in linkage.A]
        else:
            rods = [B - A for A, B in zip(linkage.A, linkage.B, strict=True)]
            gaps += [abs((rod * (A - linkage.O).conjugate()).imag) / abs(start)
                     for A, rod in zip(linkage.A, rods, strict=True)]
            gaps.append(_spread([*map(abs, rods)]))
        if request.stroke:
            gaps.append(abs(abs(linkage.B[1] - linkage.B[0]) - request.stroke))
            given = {"offset": abs(linkage.offset), "crank": abs(start), "rod": linkage.sides["A B"]}[request.given[0]]
            gaps.append(abs(given - abs(request.given[1])))
        if request.rocker:
            swing = cmath.phase((linkage.B[1] - C) / (linkage.B[0] - C))
            gaps += [abs(linkage.sides["B C"] - request.rocker["length"]),
                     abs(abs(swing) - math.radians(request.rocker["swing"])) * size]
        worst = max(worst, *(gap / size for gap in gaps))
    return worst


def _cognates(synthesis: Synthesis) -> float:
    """Each cognate is placed by its lengths with its point on the given path, at poses all around it."""
    task, source = synthesis.task, coupler_point(synthesis.task)
    travels = np.linspace(0, 360, PATH_POSES, endpoint=False)
    if source.scene.drives[0].slides:
        travels = np.array([0.0])
    path = PathOfPoint.of_scene(source.scene, task.request.point, -360.0, 360.0)(travels)
    worst = 0.0
    for linkage in synthesis.linkages:
        size = largest([*linkage.points.values()])
        for M in path[~np.isnan(path)]:
            worst = max(worst, _closure_gap(linkage, complex(M)) / size)
    return worst


def _closure_gap(linkage: FoundLinkage, M: complex) -> float:
    """By how much the last link of a cognate fails to close when its coupler point is at M, the better way round."""
    O, A, B, point = linkage.O, linkage.A[0], linkage.B[0], linkage.carried["M"][0]
    r, long, d = abs(A - O), abs(point - A), M - O
    x = (r * r - long * long + abs(d) ** 2) / (2 * abs(d))
    y = math.sqrt(max(0.0, r * r - x * x))
    gaps = []
    for side in (y, -y):
        pin = O + d / abs(d) * complex(x, side)
        end = pin + (M - pin) * (B - A) / (point - A)
        gaps.append(abs(((end - B) / linkage.guide).imag) if linkage.C is None
                    else abs(abs(end - linkage.C) - abs(B - linkage.C)))
    return min(gaps)


def _dwell(synthesis: Synthesis) -> float:
    """M is as far from D at the beginning, in the middle and at the end of the range."""
    if synthesis.task.request.straight:
        return 0.0
    low, high = synthesis.task.request.span
    scene, D = coupler_point(synthesis.task).scene, complex(*synthesis.results["centre"])
    path = PathOfPoint.of_scene(scene, synthesis.task.request.point, min(low, high), max(low, high))
    lengths = [float(abs(z - D)) for z in path([low, (low + high) / 2, high])]
    return _spread([*lengths, synthesis.results["radius"]]) / max(lengths)


def _geneva(synthesis: Synthesis) -> float:
    """Sizes by sine and cosine; speed and acceleration of the wheel by differentiating its angle."""
    z, a, results = synthesis.task.request.slots, synthesis.task.request.centres, synthesis.results
    R, r = a * math.sin(math.pi / z), a * math.cos(math.pi / z)

    def rates(phi: float) -> tuple[float, float]:
        angles = [cmath.phase(a - R * cmath.exp(-1j * (phi + k * STENCIL_STEP))) for k in range(-2, 3)]
        speed = sum(weight * angle for weight, angle in zip(STENCIL, angles, strict=True)) / STENCIL_STEP
        bend = sum(weight * angle for weight, angle in zip((-1, 16, -30, 16, -1), angles, strict=True))
        return abs(speed), abs(bend) / 12 / STENCIL_STEP**2

    largest_alpha = rates(math.radians(results["alpha"]["crank_at"]))[1]
    gaps = (abs(results["crank"] - R) / a, abs(results["wheel"] - r) / a,
            abs(rates(0.0)[0] / results["omega"] - 1) * RATE_WEIGHT,
            abs(largest_alpha / results["alpha"]["largest"] - 1) * RATE_WEIGHT)
    return float(max(gaps))


def _conjugate(synthesis: Synthesis) -> float:
    """The contacts against the envelope: the path of the circle's centre, or of a point of the line, in body 1 is
    differentiated, and its normal gives the contact."""
    request = synthesis.task.request
    motion, worst, profile = ConjugateMotion(request), 0.0, request.profile
    for degree, _, _, x, y in synthesis.results["contacts"]:
        phi, K = math.radians(degree), complex(x, y)

        def in_body_1(point: Sequence[float], angle: float) -> complex:
            return motion.point_at(complex(*point), angle) * cmath.exp(-1j * angle)

        def speed(point: Sequence[float], angle: float = phi) -> complex:
            return sum(weight * in_body_1(point, angle + k * STENCIL_STEP)
                       for weight, k in zip(STENCIL, range(-2, 3), strict=True)) / STENCIL_STEP

        if "point" in profile:
            gap = abs(K - in_body_1(profile["point"], phi))
        elif "circle" in profile:
            c, velocity = in_body_1(profile["circle"], phi), speed(profile["circle"])
            normal = 1j * velocity / abs(velocity)
            gap = min(abs(K - c - side * profile["radius"] * normal) for side in (1, -1))
        else:
            q, r = (in_body_1(point, phi) for point in profile["line"])
            start, two, u = speed(profile["line"][0]), speed(profile["line"][1]), (r - q) / abs(r - q)
            across = [(velocity / u).imag for velocity in (start, two)]  # the point of the line that moves along it
            share = across[0] / (across[0] - across[1]) if across[0] != across[1] else 0.0
            gap = abs(K - q - share * (r - q))
        worst = max(worst, gap / request.size)
    return worst


def _gear(synthesis: Synthesis) -> float:
    """The drawn involutes by their equation, A and B by their distances, and the contact ratio by (21.12)."""
    gears, values = GearPair(synthesis.task.request, synthesis.task.name), synthesis.values
    (start, two), a, angle = gears.wheels, gears.centres, gears.working_angle
    involutes, half, worst = values.values_of_role("involute"), len(values.values_of_role("involute")) // 2, 0.0
    for wheel, centre, points in ((start, 0.0, involutes[:half]), (two, a, involutes[half:])):
        polar = [(complex(*point) - centre) for point in points]
        # inv(alpha) at each radius is the angle from the base point, which is one for all
        starts = [cmath.phase(z) for z in polar]
        inv = [math.tan(at) - at for z in polar for at in (math.acos(min(1.0, wheel.base / abs(z))),)]
        spread = [min(abs(math.remainder((s - t) + side * (u - v), 2 * math.pi)) for side in (1, -1))
                  for (s, u), (t, v) in pairwise(zip(starts, inv, strict=True))]
        worst = max(worst, *spread)
    sign = -1 if two.ring else 1
    legs = [math.sqrt(max(0.0, wheel.tip**2 - wheel.base**2)) for wheel in gears.wheels]
    path = legs[0] + sign * (legs[1] - a * math.sin(angle))
    ratio = path / (math.pi * start.module * math.cos(start.angle))
    gaps = [_fillet_gap(wheel, z) / wheel.module for wheel in gears.wheels if not wheel.ring for z in wheel.fillet()]
    return float(max(worst, abs(ratio - synthesis.results["contact_ratio"]), *gaps))


FILLET_ROLLS = 200  # of the rack, among which the envelope is sought


def _fillet_gap(wheel: InvoluteWheel, z: complex) -> float:
    """Distance of a fillet's point from the envelope of the rack's round corner: where the distance from its centre,
    differentiated by the rolling, is stationary, it is the radius."""
    m, r, tangent = wheel.module, wheel.pitch, math.tan(wheel.angle)
    radius = wheel.corner[1]
    x = m * (math.pi / 4 - wheel.addendum * tangent) - radius * math.cos(wheel.angle)
    y = r + m * (wheel.shift - wheel.addendum) + radius * math.sin(wheel.angle)
    z = (z * cmath.rect(1.0, -math.pi / wheel.teeth)).conjugate()

    def off(turn: float) -> float:
        return abs(complex(y, x - r * turn) - z * cmath.rect(1.0, -turn))

    def slope(turn: float) -> float:
        away = complex(y, x - r * turn) - z * cmath.rect(1.0, -turn)
        return (away.conjugate() * (-1j * r + 1j * z * cmath.rect(1.0, -turn))).real

    turns = np.linspace(x - 2 * m / tangent, x + m, FILLET_ROLLS) / r
    stationary = [sign_change(slope, low, high) for low, high in pairwise(turns)
                  if (slope(low) > 0) != (slope(high) > 0)]
    return min(abs(off(turn) - radius) for turn in [*stationary, x / r])
