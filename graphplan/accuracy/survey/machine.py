"""The machine's board: time for a pose against error, of every form in every arithmetic, beside the analytic solver.

Times are told in poses that LAPACK solves in the same run, many at once; errors are the largest in some sampled poses,
beside the largest value of their kind, measured against what is true of these very binary numbers. The poses are the
scene's own, enlarged by up to a fiftieth: as good a mechanism each, and other roundings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from importlib.util import find_spec
from typing import Any

import numpy as np

from graphplan.accuracy.preference import called, led_to
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Place, Series, SubChart, grouped
from graphplan.accuracy.survey.stability import error_of
from graphplan.accuracy.survey.timing import ratios, spread
from graphplan.errors import GraphplanError, Refused
from graphplan.kernel.numbers import Domain, Fractions
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.numbers.floats import Floats
from graphplan.mechanism.model import Find, Motion, Pair, Scene, Slide
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction
from graphplan.methods.styles import MOTION_PLANS
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, INK, RED
from graphplan.solver import Rates, poses, solve

POSES = 4096  # at once
SAMPLED = 5
LARGER = 1.02
BITS = 256  # of enclosures that stand for the truth: some 70 digits
DIGITS_IN_BITS = 164  # 30 digits, with bits to spare as `solve --digits` takes

SOLVER, LAPACK, EXACT_SOLVER = "solver, one pose", "solver, LAPACK batches", "solver, fractions"
COMPILED = "loop compiled by numba"

Results = dict[str, dict[str, Any]]
Key = tuple[str, str, str]  # form, plan and arithmetic


@dataclass(frozen=True)
class Measure:
    """One form in one arithmetic: the time for a pose in LAPACK's, between quartiles, and the largest error; or why
    there is none. The solver has no form and no plan."""

    scene: str
    form: str
    plan: str
    arithmetic: str
    time: float | None
    low: float | None
    high: float | None
    error: float | None
    why: str = ""


@dataclass(frozen=True)
class Run:
    """One arithmetic at work: what is called, for how many poses, and its results in the sampled pose of a number."""

    call: Callable[[], Any]
    count: int
    read: Callable[[Any, int], Results]


class Setting:
    """A scene's motion in many poses, some of them sampled."""

    def __init__(self, scene: Scene):
        self.scene = binary(scene)
        factors = np.linspace(1.0, LARGER, POSES)
        self.points = {name: complex(*map(float, at)) * factors for name, at in self.scene.points.items()}
        self.places = [round(k) for k in np.linspace(0, POSES - 1, SAMPLED)]

    @cached_property
    def sampled(self) -> list[dict[str, complex]]:
        """The points in the sampled poses."""
        return [{name: complex(z[k]) for name, z in self.points.items()} for k in self.places]

    @cached_property
    def truths(self) -> list[Rates]:
        """What is true in the sampled poses."""
        return [truth(placed(self.scene, pose)) for pose in self.sampled]


def _given(drawing: Construction, lift: Callable[[Any], Any], pose: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The coordinates of a pose, or of arrays of poses, as a construction is given them."""
    names = {step.name for step in drawing.program.steps[:drawing.program.givens]}
    return {name: {"x": lift(z.real), "y": lift(z.imag)} for name, z in pose.items() if name in names}


def measures(scene: Scene, compiled: bool = True) -> Iterator[Measure]:
    """Every form of a scene in every arithmetic, and the solver; without `compiled` numba is left out, and says so."""
    setting = Setting(scene)
    runs, errors = dict[Key, Run](), dict[Key, float]()
    for key, made in _offered(setting, compiled):
        try:
            run = made()
            found = run.call()
            errors[key] = max(error_of(run.read(found, j), true) for j, true in enumerate(setting.truths))
            runs[key] = run
        except GraphplanError as refusal:
            yield Measure(scene.name, *key, None, None, None, None, refusal.lines[0])
    times = ratios({key: (run.call, run.count) for key, run in runs.items()}, ("", "", LAPACK))
    for key, (low, middle, high) in times.items():
        yield Measure(scene.name, *key, middle, low, high, errors[key])


def _offered(setting: Setting, compiled: bool) -> Iterator[tuple[Key, Callable[[], Run]]]:
    """Everything that is measured: the solver's runs, then those of every form."""
    for name, solver in SOLVERS.items():
        yield ("", "", name), partial(solver, setting)
    for form, plan, drawn in forms(setting.scene):
        for name, arithmetic in ARITHMETICS.items():
            left_out = name == COMPILED and not compiled
            yield (form, plan, name), partial(_drawn, partial(arithmetic, setting), drawn, left_out)


def _drawn(arithmetic: Callable[[Construction], Run], drawn: Construction | GraphplanError, left_out: bool) -> Run:
    """An arithmetic at work on a form; fails where the form is refused, and where it takes too long."""
    if isinstance(drawn, GraphplanError):
        raise drawn
    if left_out:
        raise Refused(COMPILED, "compiling takes seconds a form", "name the scene with --scenes")
    return arithmetic(drawn)


def forms(scene: Scene) -> Iterator[tuple[str, str, Construction | GraphplanError]]:
    """The programs to which all methods lead, on both kinds of plan, by the methods' names; or why there is none."""
    for plan in MOTION_PLANS:
        for names, one in led_to(partial(construct, scene, plan=plan), lambda drawing: drawing.program):
            yield called(names), plan, one


# ---- scenes in the binary numbers that a machine holds: each float is taken as the fraction that it is ----------


def binary(scene: Scene) -> Scene:
    """The motion of a scene in binary fractions: velocities and accelerations of the points asked for, or of all."""
    joints = scene.find.velocity or scene.joints
    driven = scene.with_drives(drive.driven_at(*_pair(drive.rates)) for drive in scene.drives)
    found = replace(driven, irrational=(), placements={}, loads=None,
                    find=Find(joints, scene.find.acceleration or joints),
                    motions={name: Motion(_pair(m.velocity), _pair(m.acceleration))
                             for name, m in scene.motions.items()})
    return placed(found, {})


def placed(scene: Scene, places: Mapping[str, complex]) -> Scene:
    """A binary scene with some points elsewhere; guides through two points turn with them."""
    points: dict[str, Pair] = {name: _pair(at) for name, at in scene.points.items()}
    points |= {name: (Fraction(z.real), Fraction(z.imag)) for name, z in places.items()}

    def direction(slide: Slide) -> tuple[Fraction, Fraction]:
        if slide.through is None:
            return _pair(slide.direction)
        (ax, ay), (bx, by) = (_pair(points[name]) for name in slide.through)
        return bx - ax, by - ay

    return scene.posed(points, direction)


def truth(scene: Scene) -> Rates:
    """What is true of a binary scene: in fractions, or beyond fifty digits where a root is irrational.

    Fails with `Refused` where that would need enclosures and they are not installed, with `SingularPose` as `solve`.
    """
    try:
        return solve(scene, exact=True)
    except Refused:
        if find_spec("flint") is None:
            raise
    from graphplan.check.arithmetics import bounded_rates, enclosures
    from graphplan.kernel.numbers.enclosures import precision

    with precision(BITS):
        rates = bounded_rates(scene, enclosures(BITS))
        return replace(rates, velocity=_middles(rates.velocity), acceleration=_middles(rates.acceleration))


def _middles(vectors: dict[str, Any]) -> dict[str, Pair]:
    """Enclosed vectors as the fractions in their middles."""
    return {name: (x.middle, y.middle) for name, (x, y) in vectors.items()}


def _pair(pair: Pair) -> tuple[Fraction, Fraction]:
    x, y = (Fraction(float(number)) for number in pair)
    return x, y


# ---- the construction's arithmetics ----------------------------------------------------------------------------


def _each(one: Callable[[Any], Any], poses: Sequence[Any], read: Callable[[Any], Results] = lambda found: found) -> Run:
    """One sampled pose after the other."""
    return Run(lambda: [one(pose) for pose in poses], SAMPLED, lambda found, j: read(found[j]))


def _walked(domain: Callable[[], Domain], lift: Callable[[float], Any], setting: Setting, drawing: Construction) -> Run:
    """The rules, one pose after the other."""
    return _each(lambda pose: drawing.read(domain(), pose), [_given(drawing, lift, pose) for pose in setting.sampled])


def _replayed(setting: Setting, drawing: Construction) -> Run:
    """The replay that was written down from the tape, one pose after the other."""
    return _each(drawing.replay, setting.sampled)


def _by_rules(setting: Setting, drawing: Construction) -> Run:
    """The rules, on arrays of all poses."""
    given = _given(drawing, np.copy, setting.points)
    return Run(lambda: drawing.read(Arrays(), given), POSES, partial(_pairs_at, setting))


def _pairs_at(setting: Setting, found: Results, j: int) -> Results:
    """The vectors of one pose from pairs of arrays, or of numbers that are the same in all poses."""
    k = setting.places[j]
    return {kind: {name: tuple(float(np.broadcast_to(x, POSES)[k]) for x in found[kind][name])
                   for name in found.get(kind, {})} for kind in ("velocity", "acceleration")}


def _in_blocks(machine: bool, setting: Setting, drawing: Construction) -> Run:
    """The tape on blocks of poses, by numpy or compiled."""
    def read(found: Results, j: int) -> Results:
        parts = {kind: {name: (z.real, z.imag) for name, z in found.get(kind, {}).items()}
                 for kind in ("velocity", "acceleration")}
        return _pairs_at(setting, parts, j)

    return Run(lambda: drawing.evaluate(setting.points, machine=machine).results, POSES, read)


def _enclosed(setting: Setting, drawing: Construction) -> Run:
    """The rules between proven bounds; the error is that of the farther bound."""
    if find_spec("flint") is None:
        raise Refused("enclosures", "python-flint is not installed", "pip install 'graphplan[certified]'")
    from graphplan.kernel.numbers.enclosures import Enclosures, precision

    given = [_given(drawing, Fraction, pose) for pose in setting.sampled]

    def call() -> list[Results]:
        with precision(DIGITS_IN_BITS):
            return [drawing.read(Enclosures(), numbers) for numbers in given]

    return Run(call, SAMPLED, lambda found, j: _farthest(found[j], setting.truths[j]))


def _farthest(found: Results, true: Rates) -> Results:
    """The bounds of all vectors that are farther from the truth."""
    return {kind: {name: tuple(x.middle + (x.error if x.middle >= t else -x.error)
                               for x, t in zip(value, getattr(true, kind)[name], strict=True))
                   for name, value in found.get(kind, {}).items()} for kind in ("velocity", "acceleration")}


ARITHMETICS: dict[str, Callable[[Setting, Construction], Run]] = {
    "rules, floats": partial(_walked, Floats, float),
    "replay, floats": _replayed,
    "rules, arrays": _by_rules,
    "replay, arrays in blocks": partial(_in_blocks, False),
    COMPILED: partial(_in_blocks, True),
    "rules, enclosures of 30 digits": _enclosed,
    "rules, fractions": partial(_walked, Fractions, Fraction),
}


# ---- the solver's -----------------------------------------------------------------------------------------------


def _rates(setting: Setting, rates: Rates) -> Results:
    """The solver's answer for what is asked."""
    find = setting.scene.find
    return {"velocity": {name: rates.velocity[name] for name in find.velocity},
            "acceleration": {name: rates.acceleration[name] for name in find.acceleration}}


def _solved(setting: Setting) -> Run:
    return _each(solve, [poses.posed(setting.scene, pose, {}) for pose in setting.sampled], partial(_rates, setting))


def _solved_at_once(setting: Setting) -> Run:
    scene = poses.posed(setting.scene, setting.points, {})
    return Run(lambda: poses.solve(scene, POSES), POSES,
               lambda found, j: _pairs_at(setting, _rates(setting, found), j))


def _solved_exactly(setting: Setting) -> Run:
    return _each(partial(solve, exact=True), [placed(setting.scene, pose) for pose in setting.sampled],
                 partial(_rates, setting))


SOLVERS: dict[str, Callable[[Setting], Run]] = {
    SOLVER: _solved, LAPACK: _solved_at_once, EXACT_SOLVER: _solved_exactly}

# ---- the picture ------------------------------------------------------------------------------------------------

SHOWN = ("alt-eight-link", "class-four", "shaper")  # by themselves, where they are among the scenes
PROVEN = 1e-20  # errors below this are those of enclosures
MARKERS = dict(zip((*ARITHMETICS, SOLVER, LAPACK, EXACT_SOLVER), (
    "circle", "square", "up", "diamond", "star", "plus", "cross", "down", "left", "right"), strict=True))
COLOURS = {"": GREY, "pose's own": INK, "every method": INK, "auxiliary": BLUE, "trial": RED, "poles": GREEN}
TIME = Axis("time for a pose, in poses solved by LAPACK in batches")
ERROR = Axis("largest error, relative", before=(("exact", "exact"), ("proven", "proven")))
REMARKS = (
    "Each mark is one form in one arithmetic; the solver's are grey. Times are medians within one run, in the "
    "time that LAPACK takes for a pose of the same scene in batches. Errors are the largest of any velocity or "
    "acceleration in five poses, beside the largest of its kind, against fractions. The last picture has the "
    "medians over all scenes, with the quartiles, of the form that the pose chooses."
)


def picture(rows: Sequence[Measure]) -> Chart:
    """The chart of these measures."""
    scenes = grouped(rows, "scene")
    shown = [scene for scene in scenes if scene in SHOWN] or list(scenes)[:1]
    panels = [SubChart(scene, TIME, ERROR, tuple(
        Series(look(row), ((row.time, _level(row.error)),)) for row in scenes[scene]
        if row.time is not None and row.error is not None)) for scene in shown]
    if len(scenes) > 1:
        panels.append(SubChart(f"median of {len(scenes)} scenes", TIME, ERROR, tuple(_median(rows))))
    return Chart("The machine: time against error", REMARKS, tuple(panels), 2, (140.0, 85.0), tuple(_key()))


def _median(rows: Sequence[Measure]) -> Iterable[Series]:
    """Each arithmetic by its median over the scenes, with the quartiles."""
    groups: dict[tuple[str, str], list[Measure]] = {}
    for row in rows:
        if row.time is not None and row.form.split(", ")[0] in ("", "pose's own", "every method"):
            groups.setdefault((row.plan, row.arithmetic), []).append(row)
    scenes = {row.scene for row in rows}
    for group in groups.values():
        if 2 * len(group) <= len(scenes):  # what was measured of few scenes is no median of all
            continue
        left, x, right = spread([row.time for row in group if row.time is not None])
        low, y, high = spread([row.error for row in group if row.error is not None])
        corners = (left, _level(low)), (right, _level(high))
        yield Series(look(group[0]), ((x, _level(y)),), (corners,))


def _level(error: float) -> Place:
    return "exact" if error == 0 else "proven" if error < PROVEN else error


def look(row: Measure) -> Look:
    """A measure's look: its arithmetic by the marker, its method by the colour, polar plans hollow."""
    return Look(COLOURS[row.form.split(", ")[0]], MARKERS[row.arithmetic], hollow=row.plan == "polar", size=2.2)


def _key() -> Iterable[tuple[str, Look]]:
    yield from ((name, Look(GREY if name.startswith("solver") else INK, marker, size=2.2))
                for name, marker in MARKERS.items())
    yield "form of the pose or of every method", Look(INK, area=True)
    yield from ((name, Look(COLOURS[name], area=True)) for name in ("auxiliary", "trial", "poles"))
    yield "hollow: polar plans", Look(INK, "circle", hollow=True, size=2.2)
