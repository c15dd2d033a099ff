"""Paths of a coupler point: the other linkages that draw one, and the dwell of what follows an arc of one.

Roberts and Chebyshev: three four-bars draw one path. The book's claims about points on AB are wrong and left out: there
are three linkages there too (Ozols 1974, 22-3 with fig. 22-8; dwell: 22-1 with fig. 22-5).
"""

from __future__ import annotations

import cmath
import math
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NoReturn

import numpy as np

from graphplan.cycle.pose import at as posed
from graphplan.cycle.turn import RangeOfMotion
from graphplan.errors import NoMechanism, Refused, SceneError
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.scene import load as load_scene
from graphplan.phrases import said
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.sketch import Synthesis, SynthesisBoard, largest, pair, place_of, require_circle
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import SAME_POINT_TOL

Array = Any
PATH_SAMPLES, ZOOM_ROUNDS, ZOOM_SAMPLES = 720, 9, 41  # where an extreme is looked for, and how often more closely


@dataclass(frozen=True)
class CouplerPoint:
    """A point M of a coupler AB in a scene: its linkage carries it."""

    scene: Scene
    linkage: FoundLinkage


def coupler_point(task: SynthesisTask, scene: Scene | None = None) -> CouplerPoint:
    """The four-bar or slider-crank of a task's scene, in its pose or as it is given, with its point."""
    request, scene = task.request, scene or given_scene(task)

    def refuse(why: str, instead: str) -> NoReturn:
        raise Refused(f"{task.name}: {task.kind}.point", why, instead)

    if request.link not in scene.links or request.point not in scene.links[request.link]:
        refuse(f"the scene has no {request.point} on {request.link}", "a point of a link, such as M on 2")
    fixed, ends = {*scene.links.get(FRAME, ())}, list[tuple[str, str, str]]()
    for joint in scene.links[request.link]:
        for link in scene.moving:
            if link != request.link and joint in scene.links[link]:
                pivots = [point for point in scene.links[link] if point in fixed]
                slides = any(slide.link == link and slide.along == FRAME for slide in scene.slides)
                ends += [(joint, link, pivots[0])] if pivots else [(joint, link, "")] if slides else []
    ends.sort(key=lambda end: (not end[2], end[1] not in [drive.link for drive in scene.drives]))
    if len(ends) != 2 or not ends[0][2]:
        refuse(f"link {request.link} is not the coupler of a four-bar or a slider-crank", "a point of a coupler")
    (A, _, O), (B, rocker, C) = ends
    places = [complex(*map(float, scene.points[name])) for name in (O, A, B, request.point, *filter(None, [C]))]
    guide = next((complex(*map(float, slide.direction)) for slide in scene.slides if slide.link == rocker), 1 + 0j)
    driven = 3 if rocker in [drive.link for drive in scene.drives] else 1
    at_O, at_A, at_B, M, *at_C = places
    return CouplerPoint(scene, FoundLinkage(at_O, (at_A,), (at_B,), at_C[0] if at_C else None, guide / abs(guide),
                                            carried={"M": (M,)}, driven=driven))


# ---- cognates -------------------------------------------------------------------------------------------------------


def synthesize_cognates(task: SynthesisTask) -> Synthesis:
    """The other linkages that draw the path of a point: two of a four-bar, one of a slider-crank."""
    source = coupler_point(task)
    given, places = source.linkage, source.linkage.points
    size = largest([z - given.O for z in places.values()])
    for letter in "AB":
        if abs(places["M"] - places[letter]) <= SAME_POINT_TOL * size:
            raise NoMechanism(f"{task.name}: cognates.point", f"M is {letter}, whose path is a circle or a line",
                              "another point of the coupler")
    sketch = SynthesisBoard()
    marks = {letter: sketch.given(place, letter) for letter, place in places.items()}
    draw = draw_four_bar_cognates if "C" in places else draw_slider_cognate
    draw(sketch, **marks)
    values = sketch.values()
    at = places | {name: place_of(values, name) for name in sketch.roles}
    linkages = []
    if "C" in places:
        linkages = [FoundLinkage(at["C"], (at["B1"],), (at["A1"],), at["D"], names=("C", "B1", "A1", "D"),
                                 carried=given.carried, driven=4 - given.driven)]
    guide = given.guide * (places["M"] - places["A"]) / (places["B"] - places["A"]) if not linkages else 0j
    linkages += [FoundLinkage(at["O"], (at["A2"],), (at["B2"],), at.get("D"), guide / abs(guide) if guide else 0j,
                              ("O", "A2", "B2", "D")[:4 if "C" in places else 3], given.carried)]
    path = PathOfPoint.of_scene(source.scene, task.request.point, -TURN_DEGREES / 2, TURN_DEGREES / 2)
    return Synthesis(task, (values,) * len(linkages), tuple(linkages), given=given,
                     path=path.stretch(-TURN_DEGREES / 2, TURN_DEGREES / 2))


def draw_four_bar_cognates(sketch: SynthesisBoard, O: Any, A: Any, B: Any, C: Any, M: Any) -> None:
    """Parallelograms, a triangle like that of the coupler, and D."""
    board = sketch.board
    law = said("parallelogram C B M B_1; the triangles A B M and M B_1 A_1 are similar, and so are C A O and C A_1 D")
    with sketch.stage(said("Linkage C B_1 A_1 D"), law):
        B1 = sketch.keep("B1", board.transfer(B, M, C, name="B_1"))
        A1 = sketch.keep("A1", board.triangle(A, B, M, M, B1, name="A_1"))
        D = sketch.keep("D", board.triangle(C, A, O, C, A1, name="D"))
    with sketch.stage(said("Linkage O A_2 B_2 D"), said("parallelograms O A M A_2 and D A_1 M B_2")):
        sketch.keep("A2", board.transfer(A, M, O, name="A_2"))
        sketch.keep("B2", board.transfer(A1, M, D, name="B_2"))


def draw_slider_cognate(sketch: SynthesisBoard, O: Any, A: Any, B: Any, M: Any) -> None:
    """A parallelogram, and a triangle like that of the coupler."""
    board = sketch.board
    with sketch.stage(said("Linkage O A_2 B_2"), said("parallelogram O A M A_2; the triangles A B M and A_2 M B_2 are "
                                                      "similar")):
        A2 = sketch.keep("A2", board.transfer(A, M, O, name="A_2"))
        sketch.keep("B2", board.triangle(A, B, M, A2, M, name="B_2"))


# ---- dwell ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class PathOfPoint:
    """The path of the point of a scene over the travel of its drive, in degrees or lengths."""

    scene: Scene
    point: str
    motion: RangeOfMotion
    unit: float

    @classmethod
    def of_scene(cls, scene: Scene, point: str, low: float, high: float) -> PathOfPoint:
        """The path between two travels, followed from the given pose."""
        unit = 1.0 if scene.drives[0].slides else math.pi / 180
        return cls(scene, point, RangeOfMotion(scene, min(low, 0.0) * unit, max(high, 0.0) * unit, False), unit)

    def __call__(self, travels: Array) -> Array:
        """Place of the point; nan where the scene does not reach the travel."""
        return self.motion.turn(np.asarray(travels, float) * self.unit).points[self.point]

    def stretch(self, low: float, high: float) -> tuple[complex, ...]:
        """The path between two travels, as it is drawn."""
        return tuple(complex(z) for z in self(np.linspace(low, high, PATH_SAMPLES // 4 + 1)))


def extreme(function: Callable[[Array], Array], low: float, high: float) -> tuple[float, float]:
    """Largest value of a function, and its place."""
    travels = np.linspace(low, high, PATH_SAMPLES + 1)
    for _ in range(ZOOM_ROUNDS):
        values = np.where(np.isnan(values := function(travels)), -np.inf, values)
        k = int(values.argmax())
        best = float(travels[k]), float(values[k])
        travels = np.linspace(travels[max(k - 1, 0)], travels[min(k + 1, len(travels) - 1)], ZOOM_SAMPLES)
    return best


def synthesize_dwell(task: SynthesisTask) -> Synthesis:
    """The circle that a stretch of a path is nearest to, and what a dyad on it makes of the motion; or its line."""
    request = task.request
    source = coupler_point(task)
    scene, (low, high) = source.scene, request.span
    path = PathOfPoint.of_scene(scene, request.point, min(low, high), max(low, high))
    M = [complex(z) for z in path([low, (low + high) / 2, high])]
    if any(map(cmath.isnan, M)):
        raise NoMechanism(f"{task.name}: dwell.from", "the scene does not come from there to the end of the range",
                          "a range that graphplan cycle reaches")
    whole = PathOfPoint.of_scene(scene, request.point, low - TURN_DEGREES, high + TURN_DEGREES)
    shown: dict[str, Any] = {"given": coupler_point(task, posed_scene(task)).linkage,
                             "path": whole.stretch(low, low + TURN_DEGREES), "stretch": path.stretch(low, high)}
    sketch = SynthesisBoard()
    marks = [sketch.given(z, f"M_{k}", "M") for k, z in enumerate(M, 1)]
    for name, z in shown["given"].points.items():
        if name != "M":
            sketch.given(z, name, "joint")
    if request.straight:
        with sketch.stage(said("Line"), said("through M at the beginning and at the end of the range")):
            sketch.keep("line", sketch.board.line(marks[0], marks[2]))
        u = (M[2] - M[0]) / abs(M[2] - M[0])
        deviation = extreme(lambda t: abs(((path(t) - M[0]) / u).imag), min(low, high), max(low, high))[1]
        return Synthesis(task, (sketch.values(),), (), {"deviation": deviation}, **shown)
    size = largest([z - M[0] for z in source.linkage.points.values()])
    require_circle(f"{task.name}: dwell", "M_1 M_2 M_3", M, size, "straight = true, or another range")
    E = sketch.given(complex(*request.pivot), "E")
    with sketch.stage(said("Centre D"), said("it lies on the perpendicular bisectors of the positions of {0}", "M")):
        D = sketch.circle_through(marks, "D")
        sketch.keep("arc", sketch.board.circle(D, sketch.board.opening(D, marks[0])))
    with sketch.stage(said("Output"), said("the dyad M D E: D stands still while M runs on the arc")):
        sketch.keep("output", sketch.board.line(D, E))
    values = sketch.values()
    centre = place_of(values, "D")
    radius = abs(M[0] - centre)
    deviation = extreme(lambda t: abs(abs(path(t) - centre) - radius), min(low, high), max(low, high))[1]
    results = {"centre": pair(centre), "radius": radius, "deviation": deviation,
               "output": output_motion(task, path, whole, centre, radius)}
    return Synthesis(task, (values,), (), results, **shown)


def output_motion(task: SynthesisTask, path: PathOfPoint, whole: PathOfPoint, D: complex,
                  radius: float) -> dict[str, float]:
    """By how much the output turns within the range, and over the whole turn of the drive, as far as both go."""
    low, high = sorted(task.request.span)
    E = complex(*task.request.pivot)
    arm = abs(D - E)
    if arm <= SAME_POINT_TOL * radius:
        raise NoMechanism(f"{task.name}: dwell.pivot", "the pivot is the centre D of the arc", "another pivot")
    side = math.copysign(1.0, ((D - E) / (complex(path([low])[0]) - E)).imag)

    def angle(travels: Array) -> Array:
        """The angle of the output from where it dwells; nan where the dyad does not close."""
        M = whole(travels) - E
        with np.errstate(invalid="ignore", divide="ignore"):
            cosine = (arm * arm + abs(M) ** 2 - radius**2) / (2 * arm * abs(M))
            cosine = np.where(abs(cosine) <= 1, cosine, np.nan)
            return np.degrees(np.angle(M / abs(M) * np.exp(1j * side * np.arccos(cosine)) * arm / (D - E)))

    first, last = reached_span(angle, low, high)
    swing = extreme(angle, first, last)[1] + extreme(lambda t: -angle(t), first, last)[1]
    dwell = extreme(angle, low, high)[1] + extreme(lambda t: -angle(t), low, high)[1]
    return {"dwell": dwell, "swing": swing}


TURN_DEGREES = 360.0


def reached_span(angle: Callable[[Array], Array], low: float, high: float) -> tuple[float, float]:
    """The range of travel, at most one turn, around `low` to `high` in which the dyad closes."""
    travels = np.linspace(low - TURN_DEGREES, high + TURN_DEGREES, 4 * PATH_SAMPLES + 1)
    broken = np.isnan(angle(travels))
    before, after = travels[broken & (travels < low)], travels[broken & (travels > high)]
    if not len(before) and not len(after):
        return low, low + TURN_DEGREES
    step = travels[1] - travels[0]
    return (float(before[-1] + step) if len(before) else low - TURN_DEGREES,
            float(after[0] - step) if len(after) else high + TURN_DEGREES)


def scene_of(task: SynthesisTask) -> str:
    """Path of the scene that a task names: beside the task's file if it exists there, else as named."""
    beside = os.path.join(os.path.dirname(task.name), task.request.scene)
    return beside if os.path.exists(beside) else task.request.scene


def given_scene(task: SynthesisTask) -> Scene:
    """The scene that a task names; its faults are the task's where there is no such scene."""
    name = scene_of(task)
    try:
        return load_scene(name)
    except SceneError as error:
        if os.path.exists(name):
            raise
        faults = (replace(fault, where=f"{task.kind}.scene", what=f"{name}: {fault.what}") for fault in error.faults)
        raise SceneError(task.name, tuple(faults)) from None


def posed_scene(task: SynthesisTask) -> Scene:
    """The scene of a dwell at the beginning of its range."""
    scene = given_scene(task)
    return posed(scene, task.request.span[0]) if task.request.span[0] else scene
