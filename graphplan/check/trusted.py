"""The construction that agrees with the solver: the first of all ways, and shortcuts where nothing can disagree.

For the middle A of a link BC whose ends have the loci beta and gamma, Rosenauer (No. 16) draws the bisector of the
angle between beta and gamma where the median of the trial triangles belongs, and lets alpha, the locus of A, begin at
a itself, without the normal acceleration of A. Both suit a pencil in some poses; here is by how much they miss.

The static replacement of a link by masses at two joints is a third. Masses in the inverse proportion of their distances
keep the link's mass and its centre, so the inertia force has the right size and direction; but the moment of inertia
becomes m a b instead of I: the couple is wrong by ab/i^2 - 1, whatever the motion (Ozols 1974, 9-2, example 9-1).

Construction and solver are computed in floats with proven bounds. Where these do not prove nine digits of each number,
or the two differ by more than rounding, they are computed once more: as fractions where the scene is rational, else in
enclosures. A construction that is proven to differ is given up for one that goes another way.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, islice
from typing import Any, TypeVar

from graphplan.check.answerable import answer_what_exists
from graphplan.check.arithmetics import FLOATS, Arithmetic, Exact, decide_friction, enclosures
from graphplan.check.compared import Readings, compare, printed_results, round_fractions
from graphplan.check.report import ReferenceSolution, Report, reference_solution
from graphplan.check.tolerances import COLLINEAR_TOL
from graphplan.design.decide import decide, general_construction
from graphplan.errors import ConstructionError, Refused, SingularPose, by_name
from graphplan.kernel.faithful import has_flint
from graphplan.kernel.kinds import Movement, Primitive
from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.program import Step
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import metre
from graphplan.methods.construction import Construction
from graphplan.methods.design import OPEN, Design
from graphplan.methods.draw import draw
from graphplan.methods.kinds import PATHS, TRANSLATION
from graphplan.methods.panels import N_PLAN
from graphplan.methods.ways import Plan
from graphplan.solver import solve

Line = tuple[float, float, float]


@dataclass(frozen=True)
class Shortcuts:
    """Errors of two shortcuts for the acceleration of a link's middle.

    `angle` is between bisector and median, in degrees; `bisector` and `dropped` are the misses of the middle's end,
    by the bisector and by dropping its normal acceleration, as parts of its acceleration.
    """

    middle: str
    angle: float
    bisector: float
    dropped: float

    def __str__(self) -> str:
        return (f"shortcuts for {self.middle}, the middle of its link: the bisector is {self.angle:.2g} degrees off "
                f"the median and misses a_{self.middle} by {100 * self.bisector:.2g} %; dropping its normal "
                f"acceleration misses it by {100 * self.dropped:.2g} %")


def shortcuts(drawing: Construction) -> list[Shortcuts]:
    """The shortcuts wherever a drawing has a link with three loci on the N-plan, one of them of its middle."""
    return [shortcut for step in drawing.program.steps if step.op.claim_operands("locus") and step.panel.whole == N_PLAN
            for shortcut in _shortcuts_at(drawing, step)]


def _shortcuts_at(drawing: Construction, carry: Step) -> Iterator[Shortcuts]:
    """The link whose loci this step carries together, if one of its three points halves the other two, whose loci meet.
    """
    steps, values = drawing.program.steps, drawing.truth
    requested = {reading.of for reading in drawing.readings if reading.kind == "acceleration"}
    for step in steps:
        if step.op.movement is Movement.MET and carry.index in step.args:
            A, alpha, B, beta, C = carry.args
            (gamma,) = (arg for arg in step.args if arg != carry.index)
            three = [(A, alpha), (B, beta), (C, gamma)]
            for middle in three:
                first, second = (joint for joint in three if joint is not middle)
                halves = (complex(*values[first[0]]) + complex(*values[second[0]])) / 2
                beta, gamma, name = values[first[1]], values[second[1]], steps[middle[0]].name
                near = abs(halves - complex(*values[middle[0]])) < COLLINEAR_TOL * abs(halves)
                if near and name in requested and _sine_between(beta, gamma):
                    yield _cost(drawing, name, values[middle[1]], beta, gamma)


def _cost(drawing: Construction, name: str, alpha: Line, beta: Line, gamma: Line) -> Shortcuts:
    """Draw both shortcuts and compare them with the exact end of the middle."""
    arrow = next(r for r in drawing.readings if r.kind == "acceleration" and r.of == name)
    a, end = (complex(*drawing.truth[drawing.program.wanted[mark]]) for mark in arrow.marks)
    corner = _meet(beta, gamma)
    median = end - corner
    first, second = (complex(line[1], -line[0]) / math.hypot(*line[:2]) for line in (beta, gamma))
    bisector = min((first + second, first - second), key=lambda way: _angle(way, median))
    by_bisector = _meet(_line_through(corner, bisector), alpha)
    short = _meet(_line_through(corner, median), _line_through(a, complex(alpha[1], -alpha[0])))
    length = abs(end - a)
    return Shortcuts(name, math.degrees(_angle(bisector, median)), abs(by_bisector - end) / length,
                     abs(short - end) / length)


def _line_through(point: complex, way: complex) -> Line:
    return -way.imag, way.real, way.imag * point.real - way.real * point.imag


def _meet(k: Line, l: Line) -> complex:
    w = _sine_between(k, l)
    return complex((k[1] * l[2] - l[1] * k[2]) / w, (k[2] * l[0] - l[2] * k[0]) / w)


def _sine_between(k: Line, l: Line) -> float:
    """Twice the area between the normals of two lines: zero if they are parallel."""
    return k[0] * l[1] - l[0] * k[1]


def _angle(one: complex, two: complex) -> float:
    """The angle between two lines of these directions."""
    turn = abs(cmath.phase(one / two))
    return min(turn, math.pi - turn)


@dataclass(frozen=True)
class Replacement:
    """A link, the joints that its mass would go to, and the error of the inertia couple as a part of it."""

    link: str
    joints: tuple[str, str]
    error: float

    def __str__(self) -> str:
        A, B = self.joints
        return (f"static replacement: masses at {A} and {B} for link {self.link} would miss its inertia couple by "
                f"{100 * self.error:.3g} %")


def replacements(scene: Scene) -> Iterator[Replacement]:
    """For each link with mass and inertia whose centre lies between two of its joints, what replacing it would cost."""
    places = {name: (float(x), float(y)) for name, (x, y) in scene.points.items()}
    for link, mass in (scene.loads.masses if scene.loads else {}).items():
        if not mass.mass or not mass.inertia:
            continue
        radius2 = float(mass.inertia / mass.mass * metre(scene.units) ** 2)
        joints = [point for point in scene.links[link] if point in scene.joints and point != mass.centre]
        for A, B in combinations(joints, 2):
            a, b = (math.dist(places[mass.centre], places[joint]) for joint in (A, B))
            if a + b <= math.dist(places[A], places[B]) * (1 + COLLINEAR_TOL):
                yield Replacement(link, (A, B), a * b / radius2 - 1)


MAX_CONSTRUCTIONS = 24  # constructions that are tried at most


class Bench:
    """Verifier of the constructions of a scene, each in as good an arithmetic as it needs."""

    def __init__(self, scene: Scene, wishes: Design, exact: bool, locks: str = ""):
        self.scene, self.wishes, self.exact, self.locks = scene, wishes, exact, locks
        self._references: dict[str, ReferenceSolution] = {}

    def judge(self, drawing: Construction) -> Report:
        """A construction against the solver, in the first arithmetic that proves the digits or a difference.

        Where none does, the last word is that of floats, with bounds as large as they are.
        """
        last: Report | None = None
        fault: ConstructionError | None = None
        for by in self._arithmetics():
            try:
                with by.working():
                    judged = self._judge_in(drawing, by)
            except ConstructionError as error:
                fault = error
                continue
            except by.doubt:
                continue
            if judged.proven or judged.wrong:
                return judged
            last, fault = judged, None
        regular = self._references.keys() - {FLOATS.name}  # as better arithmetic has found: then another way may serve
        if last is None and (fault is None or (self._singular is not None and not regular)):
            raise self._unproven(drawing)
        if fault is not None:
            raise fault
        assert last is not None
        return last

    def solver_report(self, drawing: Construction, fault: ConstructionError) -> Report:
        """The report by the solver alone of a construction that has no numbers in this pose."""
        solved: Report | None = None
        for by in self._arithmetics():
            with suppress(by.doubt), by.working():
                if isinstance(by, Exact) or (solved is not None and solved.proven):
                    break
                ours = solver_results(drawing, self._reference(by, drawing))
                if by is FLOATS:
                    ours = {kind: {name: _middle(value) for name, value in named.items()}
                            for kind, named in ours.items()}
                solved = replace(self._report(drawing, by, ours), fault=fault)
        if solved is None:
            raise fault
        return solved

    def _arithmetics(self) -> Iterator[Arithmetic]:
        """Floats, and what is asked where these do not decide; only fractions can tell of a singular pose that it is.
        """
        frictions = self.scene.loads.frictions if self.scene.loads else ()
        if not self.exact:
            yield FLOATS
        if self.exact or not (self.scene.irrational or any(friction.at for friction in frictions)):
            yield Exact()
        elif has_flint():
            yield enclosures()

    def _judge_in(self, drawing: Construction, by: Arithmetic) -> Report:
        """A construction against the solver in one arithmetic; fails with its doubt where that cannot tell."""
        posed_scene, domain = self._reference(by, drawing).scene, by.domain()
        sharp = self._same_construction(posed_scene, drawing) if self.scene.irrational and by is not FLOATS else drawing
        if sharp is None:
            raise by.doubt
        try:
            return self._report(drawing, by, sharp.read(domain))
        except ConstructionError:
            if getattr(domain, "undecided", False):
                raise by.doubt from None
            raise

    def _reference(self, by: Arithmetic, drawing: Construction | None = None) -> ReferenceSolution:
        """The solver's results in one arithmetic, found once; a singular pose is proven by fractions."""
        try:
            if by.name not in self._references:
                self._references[by.name] = reference_solution(self.scene, by)
        except SingularPose as singular:
            if isinstance(by, Exact):
                raise SingularPose(singular.why, singular.links, self._lines_that_miss(drawing, by.domain())) from None
            raise
        return self._references[by.name]

    @cached_property
    def _singular(self) -> SingularPose | None:
        """Why floats hold the pose for singular, where they do."""
        if self.exact or FLOATS.name in self._references:
            return None
        try:
            solve(self.scene)
            if self.scene.loads is not None:
                from graphplan.solver.statics import reactions

                reactions(self.scene)
        except SingularPose as singular:
            return singular
        return None

    def _unproven(self, drawing: Construction | None = None) -> SingularPose | Refused:
        """The error where no arithmetic at hand tells anything: what floats say of it."""
        if self._singular is not None:
            return SingularPose(self._singular.why, self._singular.links, self._lines_that_miss(drawing, Floats()))
        return Refused("the pose", "it is too close to a singular pose for floats",
                       "pip install 'graphplan[certified]', or give its points as coordinates")

    def _lines_that_miss(self, drawing: Construction | None, domain: Domain) -> str:
        """The lines of a construction, or of the first way, that should meet and do not; empty if no construction is
        planned."""
        with suppress(Refused):
            return missed_crossing(drawing or general_construction(self.scene, self.wishes), domain)
        return ""

    def _same_construction(self, known: Scene, drawing: Construction) -> Construction | None:
        """Draw the same steps for the scene in enclosures; None if the steps differ."""
        def steps(construction: Construction) -> list[tuple[Primitive, tuple[int, ...]]]:
            return [(step.op, step.args) for step in construction.program.steps]

        design, plan = drawing.design, Plan(known, drawing.design.method)
        with suppress(Refused):
            same = draw(plan, plan.way_by(design.ways), design)
            return same if steps(same) == steps(drawing) else None
        return None

    def _report(self, drawing: Construction, by: Arithmetic, ours: Readings) -> Report:
        """The comparison in one arithmetic; fractions that are not asked for are printed as floats."""
        reference = self._references[by.name]
        truth = reference.truth(ours, drawing.rounds)
        for kind, named in reference.undrawn_forces(drawing, ours, truth).items():
            ours = ours | {kind: ours.get(kind, {}) | {
                name: _middle(value) if by is FLOATS else value for name, value in named.items()}}
        numbers = compare(drawing, ours | reference.power_readings, truth)
        if isinstance(by, Exact) and not self.exact:
            numbers = round_fractions(numbers)
        results = printed_results(ours, numbers, (lambda number: number) if self.exact else float)
        forces = reference.drawn_forces(drawing, results, self.locks, self.exact)
        return Report(drawing, reference.rates, results, self.exact, forces, by.name, numbers)


def solver_results(drawing: Construction, solved: ReferenceSolution) -> Readings:
    """The solver's values of all results of a construction, by kind and name."""
    paths: dict[str, Any] = {kind: {r.of: None for r in drawing.readings if r.kind == kind}
                             for kind in (*PATHS, TRANSLATION)}
    truth = solved.truth(paths)
    return {kind: {r.of: truth[kind][r.of] for r in drawing.readings if r.kind == kind}
            for kind in drawing.kinds if kind in truth}


def _middle(value: Any) -> Any:
    """A number with bounds, or a vector of them, as floats."""
    return tuple(map(float, value)) if isinstance(value, tuple) else float(value)


def missed_crossing(drawing: Construction, domain: Domain) -> str:
    """The lines that should meet and do not: where the construction stops, or where its lines cross flattest."""
    try:
        drawing.read(domain)
    except ConstructionError as error:
        return f"{error.drawing}: {error.why}"
    try:
        flattest = min((step for step in drawing.program.steps if step.op.movement is Movement.MET),
                       key=lambda step: _sine(drawing, step.args), default=None)
    except ConstructionError:
        return ""
    if flattest is None:
        return ""
    first, second = (drawing.program.text_off_sheet(arg) for arg in flattest.args)
    step = drawing.program.text(flattest.index)
    return f"{step}, where {first} should meet {second}: the two lines are all but parallel"


def _sine(drawing: Construction, lines: tuple[int, ...]) -> float:
    (a, b, _), (c, d, _) = (drawing.truth[line] for line in lines)
    return float(abs(a * d - b * c) / ((a * a + b * b) * (c * c + d * d)) ** 0.5)


Judged = TypeVar("Judged", bound=Report)


def construct(scene: Scene, wishes: Design = OPEN, *, checked: bool = True) -> Construction:
    """The construction of what the scene asks for, compared with the analytic solver unless `checked` is False.

    What the wishes leave open is as the scene's sheet has it, and else what costs least. A construction that has no
    numbers in this pose shows that when they are read, and may have some in others.
    Fails with `Disagreement` where every way to draw it differs from the solver, with `SingularPose` where there are
    numbers and what is asked does not exist, and with `Refused` where no move of the planner reaches it.
    """
    if not checked:
        return next(decide(scene, wishes))
    try:
        return report(scene, wishes).drawing
    except (SingularPose, ConstructionError):
        drawing = unjudged_construction(scene, wishes)
        if drawing.has_numbers:
            raise
        return drawing


def unjudged_construction(scene: Scene, wishes: Design) -> Construction:
    """The construction if no way agrees: by the first way if the pose is singular, as no other is better there."""
    try:
        solve(scene)
    except SingularPose as singular:
        try:
            return general_construction(scene, wishes)
        except Refused:
            raise singular from None
    return next(decide(scene, wishes))


def report(scene: Scene, wishes: Design = OPEN, *, exact: bool = False, refuse: bool = True,
           alone: bool = False) -> Report:
    """The first construction that agrees with the solver, with its numbers; `exact` asks for fractions.

    Where friction cannot be had, as where the mechanism locks itself or where journals rub in exact numbers, all is
    without it, and the forces say why. Fails as `construct` does, with `SingularPose` naming the links and the lines
    that should meet, and with `Refused` where `exact` meets an irrational scene; unless `refuse` says otherwise, with
    `Disagreement` where no way agrees: else that is the report's to tell.
    With `alone` it is the solver's own numbers where no way can be drawn though the pose is regular. Poles and
    curvatures that are asked for and do not exist here are left out: the report has the reasons.
    """
    if exact and scene.irrational:
        irrational = ", ".join(sorted(scene.irrational, key=by_name))
        raise Refused(f"{scene.name}: {irrational}", "fractions cannot hold this", "leave out --exact")
    scene, locks = decide_friction(scene, exact)
    answer, reasons = answer_what_exists(scene, lambda asked: _first_trusted(Bench(asked, wishes, exact, locks), alone))
    if refuse and not answer.agrees:
        raise answer.disagreement
    return replace(answer, whole=scene, missing=reasons) if reasons else answer


def _first_trusted(bench: Bench, alone: bool) -> Report:
    """The first construction that agrees with the solver, else the first that is drawn; as `report` gives it."""
    try:
        first = first_sound(bench.scene, bench.wishes, bench.judge)
    except Refused:
        solve(bench.scene, exact=not bench.scene.irrational)  # fails where no way is found as the pose is singular
        raise
    if isinstance(first, Report):
        return first
    if alone and not bench.exact:
        return bench.solver_report(*first)
    raise first[1]


def first_sound(scene: Scene, wishes: Design, judged: Callable[[Construction], Judged],
                ) -> Judged | tuple[Construction, ConstructionError]:
    """The first construction that is judged to agree with the solver, else the first that is drawn.

    Where none can be drawn in this pose, the first with its error; fails with `Refused` where there is none at all.
    """
    wrong: Judged | None = None
    undrawn: tuple[Construction, ConstructionError] | None = None
    try:
        for drawing in islice(decide(scene, wishes), MAX_CONSTRUCTIONS):
            try:
                judgement = judged(drawing)
            except ConstructionError as error:
                undrawn = undrawn or (drawing, error)
                continue
            if judgement.agrees:
                return judgement
            wrong = wrong or judgement
    except Refused as refused:
        if wrong is None and undrawn is None:
            raise _of_scene(scene, refused) from None
    found_or_not = wrong or undrawn
    assert found_or_not is not None
    return found_or_not


def _of_scene(scene: Scene, refused: Refused) -> Refused:
    """Name the scene in a refusal."""
    return Refused(f"{scene.name}: {refused.what}", refused.why, refused.do)
