"""The choice of a design: which drawing of a scene is made, by what each costs.

The textbook's design comes first: velocities on the mechanism plan, the first way through each ring of links, what is
drawn in proportion to the mechanism. Where it costs too much others are looked at: forces by other ways, other ways
through the rings, velocities of other lengths. What is asked for, or given by the scene's sheet, stays.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, product

from graphplan.design.cost import UNDRAWABLE, DesignCost, cost
from graphplan.design.hand import Pencil
from graphplan.design.proportion import better_kappa, better_phi, other_kappas
from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.numbers import Fractions
from graphplan.kernel.program import evaluate
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import FORCE_ORDERS, FORCE_PLANS
from graphplan.methods.construction import Construction
from graphplan.methods.design import OPEN, TEXTBOOK, Design, complete_wishes
from graphplan.methods.draw import draw
from graphplan.methods.ways import Plan
from graphplan.phrases import Said, join, said

MAX_COST = 9.0  # percent: a design that costs no more is taken, and no other is looked at
MOST_WEIGHED = 5  # through the rings that are weighed, if one of them can be drawn
PICKS = 4  # at how many places a trial of forces may begin
UNEVEN = 200.0  # times the shortest side of a link: beside longer ones its vectors are too short to draw


@dataclass(frozen=True)
class Candidate:
    """A design that was looked at: its construction and what it costs."""

    drawing: Construction
    cost: DesignCost

    @property
    def design(self) -> Design:
        """The design, complete."""
        return self.drawing.design

    @property
    def percent(self) -> float:
        """The cost as one number; infinite if it cannot be drawn."""
        return self.cost.percent

    @property
    def is_drawable(self) -> bool:
        """Whether it can be drawn in this pose."""
        return self.percent < UNDRAWABLE.percent


def decide(scene: Scene, wishes: Design = OPEN) -> Iterator[Construction]:
    """The constructions of what a scene asks for, each with its design, the one that costs least first.

    Those of a method that is asked for come first, then such without it, which say so. Numbers are not looked at beyond
    that, so a singular pose shows when they are read. Fails with `Refused` where a wish has no such name, and where no
    move of the planner reaches what is asked.
    """
    wishes = complete_wishes(scene, wishes)
    try:
        yield from Alternatives(scene, wishes).in_order()
    except Refused:
        if not wishes.method:
            raise
    if wishes.method:
        note = said("the chosen method cannot be drawn in this pose; another is drawn")
        for drawing in Alternatives(scene, replace(wishes, method="", form="")).in_order():
            yield replace(drawing, notes=[*drawing.notes, note])


def construct(scene: Scene, wishes: Design = OPEN) -> Construction:
    """The construction with the lowest cost, not checked; see `decide`."""
    return next(decide(scene, wishes))


def candidates(scene: Scene, wishes: Design = OPEN) -> list[Candidate]:
    """The designs that are looked at before one is taken, the one that costs least first."""
    return Alternatives(scene, complete_wishes(scene, wishes)).by_cost()


def general_construction(scene: Scene, wishes: Design = OPEN) -> Construction:
    """The construction by the first way that is valid in most poses, even if it has no numbers in this one; of forces
    the polygons alone."""
    alternatives = Alternatives(scene, complete_wishes(scene, wishes))
    plan, design = alternatives.plan, alternatives.first
    if scene.loads is None:
        return draw(plan, plan.general_way, design)
    return draw(plan, plan.way_by(), replace(design, plan=f"{design.motion},polygons"))


def _rings_close(drawing: Construction) -> bool:
    """Whether trials differ in fractions, too: in floats equal ones may differ by rounding and close a ring wrongly."""
    try:
        evaluate(drawing.program, Fractions())
    except ConstructionError as error:  # an irrational length is no fault of a trial
        return error.code != "trials-agree"
    return True


class Alternatives:
    """The designs of a scene that can be chosen among, each drawn and weighed once; `first` is the textbook's.

    All are weighed as they are drawn with set squares, so that a strict drawing has the same design.
    """

    def __init__(self, scene: Scene, wishes: Design):
        self.scene, self.wishes, self.plan = scene, wishes, Plan(scene, wishes.method)
        self.first = replace(wishes, plan=",".join(_plans(scene, wishes)), strict=False)
        self.pencil, self.in_proportion = Pencil(), False
        self.faults: dict[str, Said | str] = {}  # why forces cannot be drawn, by the plans of them

    def by_cost(self) -> list[Candidate]:
        """The designs that are looked at until one costs little enough, the one that costs least first."""
        looked_at = list[Candidate]()
        for designs in (self._textbook_design, self._group_ways, self._other_forces, self._other_plans,
                        self._other_kappas, self._other_ways):
            best = min(looked_at, key=lambda candidate: candidate.percent, default=None)
            for design in designs(best):
                if candidate := self._look_at(design, departs=bool(looked_at)):
                    looked_at.append(candidate)
                    if candidate.percent <= MAX_COST:
                        return sorted(looked_at, key=lambda candidate: candidate.percent)
        return sorted(looked_at, key=lambda candidate: candidate.percent)

    def in_order(self) -> Iterator[Construction]:
        """Their constructions, the one that costs least first; further ways are sought as they are asked for."""
        looked_at = self.by_cost()
        drawable = [candidate for candidate in looked_at if candidate.is_drawable]
        yield from (self._with_notes(candidate, len(looked_at)) for candidate in drawable)
        ways_looked_at = {candidate.design.ways for candidate in looked_at}
        are_open = not self.wishes.ways and all(candidate.drawing.planned for candidate in looked_at)
        for way in self.plan.all_ways() if are_open else ():
            if way.choices not in ways_looked_at and (further := self._look_at(replace(self.first, ways=way.choices))):
                looked_at.append(further)
                if further.is_drawable:
                    yield self._with_notes(further, len(looked_at))
        for candidate in looked_at:  # whoever reads the numbers is told
            if not candidate.is_drawable:
                yield self._with_notes(candidate, len(looked_at))
        if not looked_at:  # it will say which lines do not meet here
            if self.wishes.ways:
                self.plan.way_by(self.wishes.ways)  # fails by name where there are no such ways
            yield self._with_notes(Candidate(draw(self.plan, self.plan.general_way, self.first), UNDRAWABLE), 1)

    def _look_at(self, design: Design, departs: bool = True) -> Candidate | None:
        """A design drawn and weighed; None where it is refused. By the first one with numbers it is decided how long
        vectors are that are in proportion."""
        try:
            way = self.plan.way_by(design.ways)
            drawing = draw(self.plan, way, design)
        except Refused as refused:
            self.faults.setdefault(design.forces, refused.why)
            return None
        if not self.in_proportion and drawing.has_numbers:
            self.in_proportion, design = True, self._proportional_design(drawing)
            self.first = replace(self.first, kappa=design.kappa, phi=design.phi)
            if design != drawing.design:
                drawing = draw(self.plan, way, design)
        if drawing.fault:
            self.faults.setdefault(design.forces, drawing.fault.why)
        closes = not design.ways or not drawing.has_numbers or _rings_close(drawing)
        return Candidate(drawing, cost(drawing, self.pencil, departs) if closes else UNDRAWABLE)

    def _proportional_design(self, drawing: Construction) -> Design:
        """The design of a construction with vectors in proportion, as far as they are not given."""
        kappa = None if self.wishes.kappa else better_kappa(drawing)
        phi = None if self.wishes.phi else better_phi(drawing)
        return replace(drawing.design, kappa=kappa or drawing.design.kappa, phi=phi or drawing.design.phi)

    # ---- what else can be chosen, beside the best so far -----------------------------------------------------

    def _textbook_design(self, best: Candidate | None) -> Iterator[Design]:
        """The textbook's design."""
        yield self.first

    def _group_ways(self, best: Candidate | None) -> Iterator[Design]:
        """Force plans in other ways: what comes first, and where a trial begins."""
        design = best.design if best else self.first
        if self.plan.forces and design.polygons and not self.wishes.group_way:
            for way in product(FORCE_ORDERS, range(min(PICKS, self.plan.forces.options))):
                if way != TEXTBOOK:
                    yield replace(design, group_way=way)

    def _other_forces(self, best: Candidate | None) -> Iterator[Design]:
        """Forces by polygons or by levers alone, where they cannot be drawn as is asked."""
        if self.plan.forces and (best is None or not best.is_drawable):
            if self.first.lever:
                yield replace(self.first, plan=f"{self.first.motion},polygons")
            if self.first.polygons:
                yield replace(self.first, plan=f"{self.first.motion},lever", all_by_lever=True)

    def _other_plans(self, best: Candidate | None) -> Iterator[Design]:
        """The other plans of the motion, where it cannot be drawn on those that the lengths of the links suggest."""
        if (best is None or not best.is_drawable) and not self.wishes.motion and self.first.motion == "polar":
            yield replace(self.first, plan=self.first.plan.replace("polar", "orthogonal"))

    def _other_ways(self, best: Candidate | None) -> Iterator[Design]:
        """Yield other ways through the rings of links: more of them if no way can be drawn."""
        if self.wishes.ways or (best and not best.drawing.planned):
            return
        design, drawable = (best.design, best.is_drawable) if best else (self.first, False)
        for count, way in enumerate(self.plan.all_ways()):
            if drawable and count == MOST_WEIGHED:
                return
            if way.choices != design.ways:
                yield replace(design, ways=way.choices)

    def _other_kappas(self, best: Candidate | None) -> Iterator[Design]:
        """Yield other lengths of velocities, unless kappa is given."""
        if best and best.is_drawable and best.drawing.planned and not self.wishes.kappa:
            yield from (replace(best.design, kappa=kappa) for kappa in other_kappas(best.drawing))

    # ---- what is told of the choice --------------------------------------------------------------------------

    def _with_notes(self, candidate: Candidate, among: int) -> Construction:
        """The construction of a candidate, as strict as is asked; it says what of its design is not as usual."""
        drawing, design = candidate.drawing, candidate.design
        drawing.notes.extend(self._notes(design))
        if among > 1 and drawing.ways:
            drawing.notes.append(said("rings of links: {0}; the best of {1} designs", join(drawing.ways), among))
        return replace(drawing, design=replace(design, strict=True)) if self.wishes.strict else drawing

    def _notes(self, design: Design) -> Iterator[Said]:
        """Yield the requests that a design leaves out, with the reason, and its additions."""
        if not self.wishes.motion and design.motion == "polar":
            yield said("polar plans, as links differ so much in length")
        if self.plan.forces is None:
            return
        if self.first.lever and not design.lever:
            yield said("no lever: {0}", self.faults.get(self.first.forces, ""))
        elif self.first.polygons and not design.polygons:
            yield said("no force polygons: {0}", self.faults.get("polygons", ""))
        if design.polygons and not self.wishes.polygons:
            yield said("friction: force polygons alone have it, so they are drawn, too")


def _plans(scene: Scene, wishes: Design) -> Iterator[str]:
    """The plans of the textbook's design: friction needs polygons, and forces alone no plan of velocities for a lever.
    """
    yield wishes.motion or ("polar" if is_uneven(scene) else "orthogonal")
    if scene.loads is not None:
        from graphplan.methods.forces.loaded import needs_motion, rubs

        by_polygons = {*FORCE_PLANS}.isdisjoint(wishes.words) and not needs_motion(scene)
        yield "polygons" if by_polygons else "both" if rubs(scene) and not wishes.polygons else wishes.forces


def is_uneven(scene: Scene) -> bool:
    """Whether the sides of the moving links differ too much in length for one drawing: orthogonal velocities end on the
    mechanism plan, and where that reaches far beyond the vectors their ends tell little."""
    places = {name: complex(*map(float, at)) for name, at in scene.points.items()}
    sides = [abs(places[p] - places[q]) for link in scene.moving for p, q in combinations(scene.links[link], 2)]
    return max(sides, default=0.0) > UNEVEN * min((side for side in sides if side), default=1.0)
