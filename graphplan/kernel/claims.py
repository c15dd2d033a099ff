"""What a drawn thing must satisfy, tested on numbers and without its rule.

Each record of the table claims something of what it draws: that it lies on a line, runs parallel to another, stands on
the left. A claim names operands by place, -1 being the drawn thing; a pair of places is the vector between two points.
A residual is 0 where the claim holds; it has no unit: lengths are measured by the size of what the step was made from,
directions as sines. It knows no rule, so a wrong rule shows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from graphplan.kernel.drawn import (
    CURVATURE_CLAIMS,
    Drawn,
    Vector,
    component_along,
    cross,
    cross3,
    dot,
    roundings,
    short,
    sideways,
    unit,
)
from graphplan.kernel.images import close_group, cubic_direction, cubic_point
from graphplan.kernel.kinds import LINE, POINT, Claim
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Program, Step
from graphplan.kernel.tolerances import CLAIM_TOL, MIN_MEASURE, STANDSTILL_TOL

SPREAD = 8  # times its rounding that a number may be off


# ---- lying on, running along, in proportion ------------------------------------------------------------------------


def _distance_off(d: Drawn, k: int) -> float:
    curve, point = (k, -1) if d.kinds[-1] == POINT else (-1, k)
    return d.distance_off(curve, d[point]) / d.size


def _halfway(d: Drawn, i: int, j: int) -> float:
    """Two points of the line are as far from one as from the other, and it turns left of the way between them."""
    midpoint, along_line = (d[i] + d[j]) / 2, d.direction(-1)
    midpoint -= d.distance_off(-1, midpoint) * 1j * along_line
    second_point = midpoint + along_line * d.size
    apart = [abs(X - d[i]) - abs(X - d[j]) for X in (midpoint, second_point)]
    return max(map(abs, apart)) / d.size + abs(along_line - 1j * unit(d[j] - d[i]))


def _proportion(d: Drawn, A: int, B: int, C: int, P: int, Q: int) -> float:
    whole, PQ = d[B] - d[A], d[Q] - d[P]
    part = component_along(d[C] - d[A], whole) / abs(whole)
    return (component_along(d[-1] - d[P], PQ) - part * abs(PQ)) / d.size


# ---- images of a link ----------------------------------------------------------------------------------------------


def _likeness(d: Drawn, A: int, B: int, C: int, a: int, b: int) -> float:
    """The sides of the image are in the proportion of the link's."""
    AB, AC = d.vector((A, B)), d.vector((A, C))
    ab, ac = (component_along(d.vector((a, k)), d.turn_to_image(v)) for k, v in ((b, AB), (-1, AC)))
    return (ac * abs(AB) - ab * abs(AC)) / abs(AB) / d.size


def _misshapen(d: Drawn, A: int, B: int, C: int, a: int, b: int) -> float:
    """The triangle on ab is like ABC, with the same sense of turning."""
    AB, AC = d[B] - d[A], d[C] - d[A]
    return abs((d[-1] - d[a]) * AB - (d[b] - d[a]) * AC) / abs(AB) / d.size


def _image_off_locus(d: Drawn, C: int, A: int, B: int, c: int, beta: int) -> float:
    """The figure on c and the drawn image of A has its image of B on the other locus."""
    CA, CB = d.turn_to_image(d[A] - d[C]), d.turn_to_image(d[B] - d[C])
    if not CA:
        return 0.0
    grown = component_along(d[-1] - d[c], CA) / abs(CA)
    return d.distance_off(beta, d[c] + grown * CB) / d.size / max(1.0, abs(CB) / abs(CA))


def _locus(d: Drawn, A: int, alpha: int, B: int, beta: int, C: int) -> float:
    """Two trial figures A'B'C', fitted between both loci, have C' on the drawn line.

    Unknown are the place of C' and the figure's size: the loci of A' and B' are two equations for three numbers.
    """
    reach = abs(d[A] - d[C]) + abs(d[B] - d[C]) or 1.0
    rows, right = [], []
    for point, line in ((A, alpha), (B, beta)):
        normal, side = 1j * d.direction(line), d.turn_to_image(d[point] - d[C]) / reach
        rows.append((normal.real, normal.imag, dot(normal, side)))
        right.append(-d.distance_off(line, 0j))
    free = cross3(*rows)
    determinacy = math.hypot(*free)
    one, two = cross3(rows[1], free), cross3(free, rows[0])
    fitted = [(right[0] * p + right[1] * q) / determinacy**2 for p, q in zip(one, two, strict=True)]
    trials = [[p + k * d.size * q / determinacy for p, q in zip(fitted, free, strict=True)] for k in (-1, 1)]
    return determinacy * max(abs(d.distance_off(-1, complex(x, y))) / (d.size + math.hypot(x, y)) for x, y, _ in trials)


# ---- accelerations, false position ---------------------------------------------------------------------------------


def _off_mean_proportional(d: Drawn, K: int, A: int, m: int, w: int, k: int) -> float:
    """The velocity is the mean proportional of the distance and the acceleration."""
    KA, v, a = abs(d[A] - d[K]), abs(d[w] - d[m]), abs(d[-1] - d[k])
    return (a * KA - v * v) / KA / d.size


def _coriolis(d: Drawn, P: int, B: int, T: int, R: int, b: int) -> float:
    """Twice omega times v, a quarter turned: omega from the orthogonal velocity BT of B about P, v from BR."""
    omega = ((d[T] - d[B]) / 1j / (d[B] - d[P]) / 1j).real
    v = (d[R] - d[B]) / 1j
    return abs(d[-1] - (d[b] - 2j * omega * v)) / d.size


def _trial_error(d: Drawn, A1: int, A2: int, Z1: int, l1: int, Z2: int, l2: int) -> float:
    """Error of the trial at the drawn point: between the trials it is linear, and zero there."""
    span = d[A2] - d[A1]
    part = component_along(d[-1] - d[A1], span) / (abs(span) or 1.0)
    first, second = d.distance_off(l1, d[Z1]), math.copysign(1.0, dot(d.direction(l1),
                                                                      d.direction(l2))) * d.distance_off(l2, d[Z2])
    return ((1 - part) * first + part * second) / d.size / (1 + abs(part))


# ---- moments -------------------------------------------------------------------------------------------------------


def _counters(d: Drawn, Y: int, X: int, C: int, p: int, q: int, m: int) -> float:
    """The drawn force at X and the given one at C have no moment about Y."""
    arm, reach = d[X] - d[Y], d[C] - d[Y]
    return (cross(arm, d[-1] - d[m]) + cross(reach, d[q] - d[p])) / (abs(arm) + abs(reach)) / d.size


def _counters_afar(d: Drawn, y: int, z: int, X: int, C: int, p: int, q: int, m: int) -> float:
    """Forces along the two lines hold the given force and the drawn one, which is the least that does at X.

    A force is its two components and its moment about X: three that are held by two lines have no determinant.
    """
    directions = d.direction(y), d.direction(z)
    lines = [(u.real, u.imag, d.distance_off(k, d[X]) / d.size) for k, u in zip((y, z), directions, strict=True)]
    pole = cross3(*lines)  # the flatter the lines cross, the less they tell
    force, load = d[-1] - d[m], d[q] - d[p]
    resultant = force + load
    lever = pole[0] * resultant.real + pole[1] * resultant.imag + pole[2] * cross(d[C] - d[X], load) / d.size
    free = cross(complex(pole[0], pole[1]), force)  # a part of the force along the way to the pole holds nothing
    return (abs(lever) + abs(free)) / d.size / (1 + abs(force) / d.size)


def _concurrent(d: Drawn, y: int, z: int) -> float:
    """The drawn line and the two others pass through one point, or are parallel."""
    rows = [(u.real, u.imag, d.distance_off(k, 0j) / d.size) for k in (y, z, -1) for u in (d.direction(k),)]
    return sum(a * b for a, b in zip(cross3(rows[0], rows[1]), rows[2], strict=True))


def _turns(d: Drawn, P: int, R: int, m: int) -> float:
    arm = d[R] - d[P]
    return (cross(arm, d[-1] - d[m]) - d.number("moment")) / abs(arm) / d.size


def _resists(d: Drawn, P: int, R: int, a: int, b: int, m: int) -> float:
    """The couple is against the angular acceleration, `ratio` times as large."""
    arm = d[R] - d[P]
    turning = component_along(d[b] - d[a], 1j * arm) / abs(arm)
    return (cross(arm, d[-1] - d[m]) + d.number("ratio") * turning) / abs(arm) / d.size


def _takes_couple(d: Drawn, C: int, p: int, q: int, P: int, R: int, a: int, b: int) -> float:
    """At the drawn point the force has the pair's moment about C."""
    force, couple = d[q] - d[p], cross(d[R] - d[P], d[b] - d[a])
    return (cross(d[-1] - d[C], force) - couple) / abs(force) / (d.size + abs(d[-1] - d[C]))


def _touches(d: Drawn, P: int, R: int, w: int, p: int, q: int) -> float:
    """The force passes at the radius of the friction circle, and turns against the motion."""
    arm, turned, force = d[R] - d[P], component_along(d[w] - d[R], d[R] - d[P]), d[q] - d[p]
    full = d.number("radius") * math.copysign(1.0, turned) * unit(force) / 1j if force else 0j
    still = abs(turned) <= STANDSTILL_TOL * d.size or abs(force) <= STANDSTILL_TOL * d.size
    return min(abs(d[-1] - d[P] - off) for off in (full, 0j if still else full)) / (d.size + abs(arm))


def _leans(d: Drawn, l: int, B: int, w: int, p: int, q: int) -> float:
    """The guide is turned by the friction angle: the force perpendicular to it is against the sliding."""
    slip, force, guide = (d[w] - d[B]) / 1j, dot(d[q] - d[p], 1j * d.direction(l)), d.direction(l)
    full = d.number("coefficient") * math.copysign(1.0, dot(slip, guide)) * math.copysign(1.0, force)
    still = abs(dot(slip, guide)) <= STANDSTILL_TOL * d.size or abs(force) <= STANDSTILL_TOL * d.size
    return min(abs(d.direction(-1) - unit(guide * (1 + 1j * lean))) for lean in (full, 0.0 if still else full))


def _leans_by_pressure_angle(d: Drawn, P: int, B: int, p: int, q: int) -> float:
    """The line leans from the force pq, which is perpendicular to the radius, towards the wheel's centre."""
    inwards = d[B] - d[P]
    part = cross(inwards, d[q] - d[p])
    full = 1j * math.copysign(1.0, part) + d.number("coefficient")
    still = abs(part) <= STANDSTILL_TOL * d.size * abs(inwards)
    return min(abs(cross(d.direction(-1), unit(inwards * way))) for way in (full, 1j if still else full))


# ---- positions of links ---------------------------------------------------------------------------------------------


def _angle(d: Drawn) -> complex:
    """The vector that an angle is given by."""
    return complex(float(d.params["angle"].x), float(d.params["angle"].y))


def _figure(d: Drawn) -> tuple[complex, complex]:
    """Two vectors of a link's figure: that to the point, and that beside which it lies."""
    return complex(d.number("dx"), d.number("dy")), complex(d.number("ux"), d.number("uy"))


def _dissimilarity(d: Drawn, P: int, Q: int) -> float:
    """The triangle of the three points is like the figure's."""
    v, u = _figure(d)
    return abs((d[-1] - d[P]) * u - (d[Q] - d[P]) * v) / d.size / (abs(u) + abs(v))


def _set_off(d: Drawn, l: int, P: int) -> float:
    """Relative error of the claim that the vector from P is as long as in the link's figure and at the same angle to
    the line."""
    v, u = _figure(d)
    return abs(d[-1] - d[P] - v * unit(u).conjugate() * d.direction(l)) / (d.size + abs(v))


def _sight_error(d: Drawn, P: int, Q: int) -> float:
    """The line passes P as far off, and on the same side, as in the figure, and Q lies the right way along it."""
    v, u = _figure(d)
    ahead = short(dot(d.direction(-1), d[Q] - d[P]), d.params["way"] == "on")
    return abs(d.distance_off(-1, d[P]) + cross(unit(u), v)) / (d.size + abs(v)) + ahead / d.size


def _closes(d: Drawn) -> float:
    """The group's links close on the outer joints, and the drawn joint is theirs."""
    group, joints = d.params["group"], [(z.real, z.imag) for z in (d[k] for k in range(len(d.numbers) - 1))]
    pose = close_group(Floats(), joints, group)
    body, at = group.joints[d.params["joint"]]
    open_still = max(map(abs, group.residues(pose, joints, float)), default=0.0)
    return (open_still + abs(complex(*pose[body].place_point((float(at[0]), float(at[1])))) - d[-1])) / d.size


def _fair(d: Drawn, which: int) -> float:
    """The point lies on a curve through four others, but for what the true path is known to be off there."""
    curve, plans = d.params["curve"], [(d[k].real, d[k].imag) for k in range(4 * which, 4 * which + 4)]
    u, X = curve.at[which], d[-1] - complex(*curve.off[which])
    for _ in range(8):
        way = complex(*cubic_direction(plans, u))
        u -= dot(way, complex(*cubic_point(Floats(), plans, u)) - X) / (abs(way) ** 2 or 1.0)
    return abs(complex(*cubic_point(Floats(), plans, u)) - X) / d.size


# By how much a claim fails, and what the drawn thing is that breaks it; {0}, {1}, ... are its operands.
CLAIMS: dict[str, tuple[Callable[..., float], str]] = {
    "stands": (lambda d: abs(d[-1] - complex(d.number("x"), d.number("y"))) / d.size, "not where it is given"),
    "on": (_distance_off, "not on {0}"),
    "heads": (lambda d: abs(d.direction(-1) - unit(complex(d.number("dx"), d.number("dy")))),
              "not in the given direction"),
    "runs": (lambda d, i, j: abs(d.direction(-1) - unit(d[j] - d[i])), "not directed from {0} to {1}"),
    "parallel": (lambda d, l: abs(d.direction(-1) - d.direction(l)), "not parallel to {0}, or it runs the other way"),
    "perpendicular": (lambda d, l: abs(d.direction(-1) - 1j * d.direction(l)),
                      "not perpendicular to {0}, or it runs the other way"),
    "alike": (lambda d, k, l: cross(d.direction(k), d.direction(l)), "not parallel to {0}"),
    "halfway": (_halfway, "not as far from {0} as from {1}, or it runs the other way"),
    "shifted": (lambda d, l, i, j: (d.distance_off(-1, d[j]) - d.distance_off(l, d[i])) / d.size,
                "{2} does not lie to it as {1} lies to {0}"),
    "span": (lambda d, i, j: (d.radius(-1) - abs(d[j] - d[i])) / d.size, "not as wide as {0} is from {1}"),
    "measures": (lambda d: (d.radius(-1) - abs(d.number("length"))) / d.size, "not of the given length"),
    "centre": (lambda d, i: abs(d[-1] - d[i]) / d.size, "not centred at {0}"),
    "opened": (lambda d, o: (d.radius(-1) - d.radius(o)) / d.size, "not of the radius {0}"),
    "way": (lambda d, l, c: short(dot(d.direction(l), d[-1] - d[c]), d.params["way"] == "on") / d.size,
            "the other intersection of {0} with {1}"),
    "side": (lambda d, i, j: short(cross(unit(d[j] - d[i]), d[-1] - d[i]), d.params["side"] == "left") / d.size,
             "on the other side of the line from {0} to {1}"),
    "ahead": (lambda d, l, i: short(dot(d.direction(l), d[-1] - d[i]), d.number("ratio") > 0) / d.size,
              "on the other side of {1} along {0}"),
    "upright": (lambda d, l, i: dot(d.direction(l), d[i] - d[-1]) / d.size, "not perpendicular to {0} from {1}"),
    "same": (lambda d, u, v: abs(d.vector(u) - d.vector(v)) / d.size, "{1} is not the vector {0}"),
    "quarter": (lambda d, u, v: abs(1j * d.vector(u) - d.vector(v)) / d.size, "{1} is not {0}, turned by 90°"),
    "moved": (lambda d, u: abs(d.vector(u) - complex(d.number("dx"), d.number("dy"))) / d.size,
              "{0} is not the given vector"),
    "laid": (lambda d, l, i: abs(d[-1] - d[i] - d.number("length") * d.direction(l)) / d.size,
             "not at the given distance from {1} along {0}"),
    "along": (lambda d, u, v: sideways(d.vector(u), d.vector(v)) / d.size, "{0} is not parallel to {1}"),
    "across": (lambda d, u, v: sideways(d.vector(u), 1j * d.vector(v)) / d.size, "{0} is not perpendicular to {1}"),
    "away": (lambda d, u, v: short(component_along(d.vector(u), d.vector(v)), True) / d.size, "{0} points against {1}"),
    "times": (lambda d, u, v: abs(d.vector(u) - d.number("ratio") * d.vector(v)) / d.size,
              "{0} is not the given multiple of {1}"),
    "times across": (lambda d, u, v: abs(d.vector(u) - d.number("ratio") * 1j * d.vector(v)) / d.size,
                     "{0} is not the given multiple of {1}, turned by 90°"),
    "proportion": (_proportion, "it does not divide {3}{4} as {2} divides {0}{1}"),
    "image": (lambda d, i, j, m, n: sideways(d.vector((m, n)), d.turn_to_image(d.vector((i, j)))) / d.size,
              "{2}{3} is no side of the image of {0}{1}"),
    "likeness": (_likeness, "not similar to {0}{1}{2}"),
    "shaped": (_misshapen, "the triangle on {3}{4} is not similar to {0}{1}{2}"),
    "carried": (_image_off_locus, "no similar figure has its other end on {4}"),
    "locus": (_locus, "trial figures have their third ends off it"),
    "mean": (_off_mean_proportional, "not the normal acceleration of {1} about {0}"),
    "coriolis": (_coriolis, "not the Coriolis acceleration of {1}"),
    "balanced": (_trial_error, "not where the error of the trials vanishes"),
    "counters": (_counters, "its moment about {0} does not balance the given force's"),
    "counters afar": (_counters_afar, "it does not balance the given force with forces along {0} and {1}"),
    "concurrent": (_concurrent, "not concurrent with {0} and {1}"),
    "turns": (_turns, "not the given moment"),
    "resists": (_resists, "not the moment against the angular acceleration"),
    "takes couple": (_takes_couple, "the force there has not the couple's moment"),
    "touches": (_touches, "the force there does not touch the friction circle"),
    "leans": (_leans, "not turned by the friction angle"),
    "presses": (_leans_by_pressure_angle, "not inclined by the pressure angle"),


    "spans": (lambda d: (d.radius(-1) - abs(complex(d.number("dx"), d.number("dy")))) / d.size,
              "not of the given length"),
    "inclined": (lambda d: abs(d.direction(-1) - unit(_angle(d))), "not at the given angle"),
    "laid at": (lambda d: abs(d[-1] - d[0] - _angle(d)) / (d.size + abs(_angle(d))), "not at the given angle"),
    "cornered": (_dissimilarity, "no corner of the link's figure on {0}{1}"),
    "set off": (_set_off, "not where the link has it from {1}"),
    "fair": (_fair, "not on the curve"),
    "closes": (_closes, "no joint of links whose lengths close"),
    "sighted": (_sight_error, "it passes {0} at another distance"),
    **CURVATURE_CLAIMS,
}


def residuals(step: Step, values: Sequence[Any], least: float = 0.0) -> list[tuple[Claim, float]]:
    """Each claim of a step with its residual; `values` are those of the whole program."""
    drawn_step = Drawn(step, values, least)
    return [(claim, _residual(claim, drawn_step)) for claim in step.op.claims]


def _residual(claim: Claim, drawn: Drawn) -> float:
    return abs(CLAIMS[claim[0]][0](drawn, *claim[1:]))


def unmet(step: Step, values: Sequence[Any], tolerance: float = CLAIM_TOL,
          extent: float = 0.0, blur: float = 1.0) -> list[tuple[Claim, float]]:
    """The claims that a step breaks, with their residuals; one that is not a number breaks its claim.

    In a figure of an `extent` what is smaller than a thousandth of it counts beside that. What the rounding of the
    numbers alone, which are known `blur` times worse, makes of a residual breaks nothing, as where two points all but
    coincide.
    """
    least = MIN_MEASURE * extent
    return [(claim, residual) for claim, residual in residuals(step, values, least) if not residual <= tolerance
            and not residual <= SPREAD * blur * _rounding(Drawn(step, values, least), claim, extent)]


def _rounding(drawn: Drawn, claim: Claim, extent: float) -> float:
    """By how much a residual changes, all in all, where each number of a step is off by its rounding."""
    residual, change = _residual(claim, drawn), 0.0
    for place, (kind, numbers) in enumerate(zip(drawn.kinds, [*drawn.numbers], strict=True)):
        for k, off in enumerate(roundings(kind, numbers, extent)):
            drawn.numbers[place] = (*numbers[:k], numbers[k] + off, *numbers[k + 1:])
            change += abs(_residual(claim, drawn) - residual)
        drawn.numbers[place] = numbers
    return change


def broken_claims(program: Program, values: Sequence[Any], tolerance: float = CLAIM_TOL, extent: float = 0.0,
                  blur: float = 1.0) -> Iterator[str]:
    """All claims that a program breaks in one pose, in the letters of the sheet, the first step's first."""
    for step in program.steps:
        for claim, residual in unmet(step, values, tolerance, extent, blur):
            read = ", ".join(map(program.text, step.args))
            yield (f"step {program.number(step.index)} ({program.text(step.index)} = {step.op.name}({read})): "
                   f"{_broken_claim_text(program, step, claim)}; by {residual:.1e} of its size")


def _broken_claim_text(program: Program, step: Step, claim: Claim) -> str:
    """Describe a broken claim in the letters of the sheet."""
    def operand_name(operand: int | Vector) -> str:
        if isinstance(operand, tuple):
            return " ".join(map(operand_name, operand))
        return program.text((*step.args, step.index)[operand])

    kind, *operands = claim
    through = kind == "on" and step.op.gives == LINE
    return ("not through {0}" if through else CLAIMS[kind][1]).format(*map(operand_name, operands))
