"""The mechanism that a task asks for, by its kind, with what was asked for and which solutions are right.

The pin enters a slot along it, so that the angle O S C is right. Printed in (19.11) as r, the crank's own shaft is
bound by R; table 19-1 has 4°15' for 4°45' at three slots.

The synthesis of a task, by its kind.

Each is a task like the given one, with the letters that its marks have in that place, so that whoever draws otherwise
than the sheet is judged by what must hold, not by its steps.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import combinations, product
from typing import Any

from graphplan.errors import NoMechanism, Refused
from graphplan.kernel.passes import Drawing, Values
from graphplan.phrases import said
from graphplan.synthesis.conjugate import synthesize_conjugate
from graphplan.synthesis.function import synthesize_function
from graphplan.synthesis.gear import synthesize_gear
from graphplan.synthesis.guidance import circle_points, synthesize_guidance
from graphplan.synthesis.paths import synthesize_cognates, synthesize_dwell
from graphplan.synthesis.requests import CirclePointChoice, GuidanceTask
from graphplan.synthesis.sketch import Synthesis, SynthesisBoard, direction, place_of
from graphplan.synthesis.stroke import synthesize_stroke
from graphplan.synthesis.task import BEST, SynthesisTask

DIAGRAM_ANGLES = 24  # of the working angle at which the wheel's angle is drawn


def synthesize_geneva(task: SynthesisTask) -> Synthesis:
    """The Geneva wheel of a task."""
    request, sketch = task.request, SynthesisBoard()
    half = 180 / request.slots
    board = sketch.board
    O, C = sketch.given(0j, "O"), sketch.given(complex(request.centres), "C")
    with sketch.stage(said("Slots"), said("their axes are inclined to the line of centres by 180°/z")):
        axes = [sketch.keep("slot", sketch.ray(C, 180 + way * half)) for way in (1, -1)]
    with sketch.stage(said("Entry and exit"), said("the pin enters along the slot: O S is perpendicular to C S")):
        S = sketch.keep("S", board.foot(axes[0], O, name="S"))
        sketch.keep("T", board.foot(axes[1], O, name="T"))
        sketch.keep("crank circle", board.circle(O, board.opening(O, S)))
        sketch.keep("wheel circle", board.circle(C, board.opening(C, S)))
    with sketch.stage(said("Wheel"), said("the pin leads the slot; the angle of the wheel is that of C A")):
        working = 180 - 2 * half
        circle = sketch.roles["crank circle"][0]
        for k in range(1, DIAGRAM_ANGLES):
            ray = sketch.ray(O, -working / 2 + working * k / DIAGRAM_ANGLES)
            A = sketch.keep("A", board.line_meets_circle(ray, circle, way="on"))
            sketch.keep("axis", board.line(C, A))
    values = sketch.values()
    at = place_of(values, "S")
    R, r = abs(at), abs(request.centres - at)
    return Synthesis(task, (values,), (), geneva_numbers(request.slots, R, r, request.centres))


def geneva_numbers(z: int, R: float, r: float, a: float) -> dict[str, Any]:
    """Angles, largest speed and accelerations, for omega 1 of the crank."""
    ratio = R / a
    crank_at = math.degrees(math.acos(extreme_cosine(ratio)))
    cos, sin = math.cos(math.radians(crank_at)), math.sin(math.radians(crank_at))
    square = 1 - 2 * ratio * cos + ratio**2
    return {"crank": R, "wheel": r, "working": 180 - 360 / z, "idle": 180 + 360 / z, "ratio": (z - 2) / (z + 2),
            "omega": ratio / (1 - ratio),
            "alpha": {"entry": R / r, "largest": ratio * (1 - ratio**2) * sin / square**2, "crank_at": crank_at,
                      "wheel_at": math.degrees(math.atan2(ratio * sin, 1 - ratio * cos))}}


def extreme_cosine(ratio: float) -> float:
    """The cosine of the crank's angle at which the wheel's acceleration is largest."""
    q = (1 + ratio**2) / (4 * ratio)
    return math.sqrt(q * q + 2) - q


BY_KIND = {"guidance": synthesize_guidance, "function": synthesize_function, "stroke": synthesize_stroke,
           "cognates": synthesize_cognates, "dwell": synthesize_dwell, "geneva": synthesize_geneva,
           "conjugate": synthesize_conjugate, "gear": synthesize_gear}


def find_mechanism(task: SynthesisTask, number: int = 1) -> Synthesis:
    """Solve a task, with the solution of this number chosen.

    Fails with `NoMechanism` if there is no solution, and with `Refused` if there are fewer.
    """
    synthesis = BY_KIND[task.kind](task)
    count = max(1, len(synthesis.linkages))
    if number > count:
        raise Refused(f"--solution {number}", f"the task has {count}", f"a number from 1 to {count}")
    return replace(synthesis, chosen=number - 1 if synthesis.linkages else 0)


Places = Mapping[str, complex]  # of lettered marks, in lengths of the task
INDEX = re.compile(r"(?<=_)\d+(?!\d)")
MIRRORED_KINDS = frozenset({"stroke", "geneva", "conjugate", "gear"})  # of no given place in the plane
RESULT_ROLES = re.compile(r"[A-DK-NPST]\d?")  # of marks that a task asks for
GOOD_ENOUGH = 1.0  # degrees that a least transmission angle may be below the best
MAX_DIVISIONS = 72
CHOICES_OF_CENTRES = 4  # count: of all by which three of more points centres are drawn, those that are judged


def right_drawings(synthesis: Synthesis, letters: Iterable[str], places: Places) -> Iterator[Values]:
    """The drawings that answer a task, its own first unless a student's `letters` count other divisions; those of free
    choices are by `places` of the student's marks."""
    if synthesis.task.kind == "conjugate":
        counts = [int(number) for name in letters if name.startswith("k") for number in re.findall(r"\d+", name)]
        if 0 < max(counts, default=0) <= MAX_DIVISIONS:
            yield from find_mechanism(_with_request(synthesis.task, divisions=max(counts))).drawings
    yield from (synthesis.values, *(values for values in synthesis.drawings if values is not synthesis.values))
    for task, order in _equal_tasks(synthesis, places):
        with suppress(NoMechanism):
            yield from (_with_task_indices(values, order) for values in dict.fromkeys(find_mechanism(task).drawings))


def asked_marks(values: Values) -> set[int]:
    """The marks that a drawing is to have: of results, and what was turned back for them."""
    return {index for role, marks in values.drawing.roles.items() if RESULT_ROLES.fullmatch(role) for index in marks}


def _equal_tasks(synthesis: Synthesis, places: Places) -> Iterator[tuple[SynthesisTask, tuple[int, ...]]]:
    """Tasks with the same answer, and which given positions are their first, second and so on."""
    task, request = synthesis.task, synthesis.task.request
    match task.kind:
        case "guidance" if request.fixed:
            for order in _orders(len(request.positions)):
                yield _with_request(task, positions=tuple(request.positions[k] for k in order)), order
        case "guidance" if len(request.positions) > 3 and synthesis.linkages:
            points = tuple(_nearest_root(request, point, places.get(name)) for point, name in zip(
                request.moving, ("a1", "b1"), strict=False))
            circles = {letter: [letter.lower(), *(f"{name}{k}" for k in range(1, len(request.positions) + 1))]
                       for letter, name in zip("OC", "ab", strict=True)}
            for centres_by in _likely_threes(circles, places):
                yield replace(_with_request(task, moving=points), centres_by=centres_by), ()
        case "function":
            for order in _orders(len(request.input)):
                output = {key: {**table, name: tuple(table[name][k] for k in order)}
                          for key, name in (("rocker", "angles"), ("slide", "at")) if (table := getattr(request, key))}
                turned = _with_request(task, input=tuple(request.input[k] for k in order), **output)
                first, *others = (k + 1 for k in order)
                for centres_by in _likely_threes({"B": [f"b{first}", f"a{first}", *(f"a{k}'" for k in others)]},
                                                 places):
                    yield replace(turned, centres_by=centres_by), order
            if len(request.input) == 2:
                yield from _with_own_line(task, places)
        case "stroke" if request.ground == BEST and {"o", "c"} <= places.keys():
            on_ground = _with_request(task, ground=abs(places["o"] - places["c"]))
            with suppress(NoMechanism):
                linkage = find_mechanism(on_ground).linkage
                if linkage.transmission[0] > synthesis.linkages[0].transmission[0] - GOOD_ENOUGH:
                    yield on_ground, ()


def _orders(count: int) -> Iterator[tuple[int, ...]]:
    """The orders of positions in which another is the first, in which all is turned back; of four the own one too, as
    three of them give a centre."""
    for first in range(0 if count > 3 else 1, count):
        yield first, *(k for k in range(count) if k != first)


def _likely_threes(circles: Mapping[str, Sequence[str]], places: Places) -> Iterator[dict[str, tuple[int, ...]]]:
    """By which three of the points on a circle its centre may be drawn, for each letter of a centre, likeliest first;
    `circles` has the names of the centre and of the points."""
    ranked = [sorted((_misfit([places.get(names[0]), *(places.get(names[1 + k]) for k in three)]), three)
                     for three in combinations(range(len(names) - 1), 3)) for names in circles.values()]
    for choice in sorted(product(*ranked), key=lambda choice: sum(misfit for misfit, _ in choice))[:CHOICES_OF_CENTRES]:
        yield {letter: three for letter, (_, three) in zip(circles, choice, strict=True)}


def _misfit(places: Sequence[complex | None]) -> float:
    """Squared displacement of three points, in sum, for which the circle through them has its centre at the first
    place; a displacement of one towards it shifts it along the bisector of the other two."""
    known = [place for place in places if place is not None]
    if len(known) < len(places) or len({*known}) < len(known):
        return math.inf
    z, P, Q, R = known
    across = (R - P) / (Q - P)
    if not across.imag:
        return math.inf
    centre = P + (Q - P) * across * (1 - across.conjugate()) / (2j * across.imag)
    p, q, r = ((X - centre) / abs(X - centre) for X in (P, Q, R))
    shifts = [1 / ((S - T) / abs(S - T) * 1j * (x - s).conjugate()).real
              for S, T, x, s in ((Q, R, p, q), (R, P, q, r), (P, Q, r, p))]
    return float(abs(z - centre) ** 2 / sum(shift**2 for shift in shifts))


def _nearest_root(request: GuidanceTask, chosen: CirclePointChoice, place: complex | None) -> CirclePointChoice:
    """Of a point whose u is given the z that is nearest to where it was drawn in the first position."""
    (x, y, angle), *_ = request.positions
    if place is None:
        return chosen
    positions = [(complex(u, v), direction(turn)) for u, v, turn in request.positions]
    z = ((place - complex(x, y)) / direction(angle)).imag
    gaps = [abs(w.imag - z) for w in circle_points(positions, chosen.u)]
    return CirclePointChoice(chosen.u, 1 + gaps.index(min(gaps))) if gaps else chosen


def _with_own_line(task: SynthesisTask, places: Places) -> Iterator[tuple[SynthesisTask, tuple[int, ...]]]:
    """Of two pairs the pin may lie on any line of its link: the one that it was drawn on."""
    request = task.request
    letter, pivot, angles = ("b1", request.rocker["pivot"], request.rocker["angles"]) if request.rocker else (
        "a1", request.pivot, request.input)
    if letter in places and (arm := places[letter] - complex(*pivot)):
        turned = tuple(angle - angles[0] + math.degrees(cmath.phase(arm)) for angle in angles)
        values = {"rocker": {**request.rocker, "angles": turned}} if request.rocker else {"input": turned}
        yield _with_request(task, **values), ()


def _with_request(task: SynthesisTask, **values: object) -> SynthesisTask:
    return replace(task, request=replace(task.request, **values))


def _with_task_indices(values: Values, order: tuple[int, ...]) -> Values:
    """A drawing with the indices that its positions have in the task."""
    def number(match: re.Match[str]) -> str:
        return "".join(sorted(str(order[int(digit) - 1] + 1) for digit in match[0]))

    if not order:
        return values
    drawing = values.drawing
    steps = tuple(step.but(name=INDEX.sub(number, step.name)) for step in drawing.program.steps)
    return Values(Drawing(replace(drawing.program, steps=steps), roles=drawing.roles), values.numbers)
