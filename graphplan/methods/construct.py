"""From a scene to its construction: plan the moves, draw the plans, freeze what is wanted."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from itertools import chain, combinations, count

from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import METHODS, OF_PATHS
from graphplan.methods.construction import Construction
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.motion.alternatives import (
    NetworkPlans,
    alternatives,
    better_force_scale,
    better_tempo,
    steadier_tempo,
)
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.time_scale import Tempo
from graphplan.methods.panels import Style, style
from graphplan.phrases import said

UNEVEN = 200.0  # times the shortest side of a link: beside longer ones its vectors are too short to draw


def construct(scene: Scene, *, method: str = "", plan: str = "", strict: bool = False, inertia: str = "couple",
              by_pencil: bool = True) -> Construction:
    """The construction of what the scene asks for.

    `method` names the form of loci and rings (auxiliary, trial or poles; that draws by the links' poles where nothing
    runs in rings) or of centres of curvature (euler-savary, bobillier, hartmann or accelerations); without it the
    scene's sheet does, or the pose chooses, and the construction says why. `plan` is orthogonal or polar, and for
    forces lever, polygons or both, such as "polar,lever"; without a word for the motion velocities are orthogonal,
    unless some links are too short for that beside others.
    `inertia` is the form of inertia forces: with a couple, shifted so that they need none, at two points that replace
    the link, at the centre of percussion, or statically at two pins; `strict` draws with compasses and straightedge
    alone. Unless it is drawn `by_pencil`, vectors are as long as comes first, and it is not drawn some times more to
    choose what leaves its results good. Fails with `Refused` where no move of the planner reaches what is asked;
    numbers are not looked at before they are read, so a singular pose shows then.
    """
    return next(constructions(scene, method=method, plan=plan, strict=strict, inertia=inertia, by_pencil=by_pencil))


def plain_construction(scene: Scene, *, method: str = "", plan: str = "", strict: bool = False,
                       inertia: str = "couple", by_pencil: bool = False) -> Construction:
    """The construction of a scene by the first way, whatever numbers that has in this pose, even none; see `construct`.

    No pencil chooses its tempo, whatever `by_pencil` says.
    """
    chosen, method = style(plan, inertia, scene.sheet.plan), method or scene.sheet.method
    if scene.loads is None:
        planner = Planner(Network(scene), method, general=True)
        planner.plan()
        return replace(Draughtsman(scene, planner, chosen).draw(), strict=strict)
    from graphplan.methods.forces.loaded import plainly_loaded

    return replace(plainly_loaded(scene, method, chosen), strict=strict)


def constructions(scene: Scene, *, method: str = "", plan: str = "", strict: bool = False, inertia: str = "couple",
                  by_pencil: bool = True) -> Iterator[Construction]:
    """The constructions of what the scene asks for by all ways that there are, best first; see `construct`.

    Those of the method that is asked for come first, then such of others, which say so.
    """
    forms, method = METHODS | OF_PATHS, method or scene.sheet.method
    if method not in ("", *forms):
        raise Refused(f"method {method}", "unknown method", f"choose one of {', '.join(forms)}")
    chosen, by_plans = style(plan, inertia, scene.sheet.plan), _found_once if by_pencil else _by_plans
    try:
        prefer = forms.get(method, "")
        for found in by_plans(NetworkPlans(scene, method), chosen):
            # One that is drawn out already is not drawn out again.
            yield replace(found, prefer=prefer, strict=strict) if prefer or strict else found
    except Refused:
        if not method:
            raise
    for found in by_plans(NetworkPlans(scene, ""), chosen) if method else ():
        note = said("the chosen method cannot be drawn in this pose; another is drawn")
        yield replace(found, strict=strict, notes=[*found.notes, note])


@dataclass
class FoundWays:
    """The constructions of a scene by all ways, each found once however often they are gone through."""

    further: Iterator[Construction]
    found: list[Construction] = field(default_factory=list)
    fault: GraphplanError | None = None  # what ended the search

    def __iter__(self) -> Iterator[Construction]:
        for place in count():
            if place == len(self.found) and not self._find_another():
                return
            yield self.found[place]

    def _find_another(self) -> bool:
        if self.fault:
            raise self.fault
        try:
            self.found += [another] if (another := next(self.further, None)) else []
        except GraphplanError as fault:
            self.fault = fault
            raise
        return another is not None


# By the place of a scene, which is kept as long, by method and by style.
_ways_kept: ContextVar[dict[tuple[int, str, Style], tuple[Scene, FoundWays]] | None] = ContextVar("ways", default=None)


@contextmanager
def keep_ways() -> Iterator[None]:
    """Inside, the ways of a scene are found once: drawn strictly or not, checked or not, they are the same."""
    before = _ways_kept.get()
    token = _ways_kept.set({} if before is None else before)
    try:
        yield
    finally:
        _ways_kept.reset(token)


def _found_once(plans: NetworkPlans, chosen: Style) -> Iterator[Construction]:
    """The constructions in proportion, those that are known where they are kept."""
    kept = _ways_kept.get()
    if kept is None:
        return _in_proportion(plans, chosen)
    key = id(plans.scene), plans.method, chosen
    if key not in kept:
        kept[key] = plans.scene, FoundWays(_in_proportion(plans, chosen))
    return iter(kept[key][1])


def _in_proportion(plans: NetworkPlans, chosen: Style) -> Iterator[Construction]:
    """The constructions with velocities that are neither longer than the mechanism or the links nor short beside it,
    and as long as leaves a pencil's results good, and with loads that are not much longer, as far as the scene's scales
    leave that open."""
    found = _by_plans(plans, chosen)
    first = next(found)
    tempo, phi = better_tempo(first), better_force_scale(first)
    if tempo or phi:
        chosen = replace(chosen, tempo=tempo, phi=phi)
        found = _by_plans(plans, chosen)
        first = next(found)
    tried = dict[Tempo, Iterator[Construction]]()

    def redraw(tempo: Tempo) -> Construction:
        further = _by_plans(plans, replace(chosen, tempo=tempo))
        redrawn = next(further)
        tried[tempo] = chain([redrawn], further)
        return redrawn

    steadier = steadier_tempo(first, redraw)
    yield from tried[steadier] if steadier else chain([first], found)


def _by_plans(plans: NetworkPlans, chosen: Style) -> Iterator[Construction]:
    """The constructions on the plans that are asked for, or that the lengths of the links leave: orthogonal velocities
    end on the mechanism plan, and where that reaches far beyond the vectors their ends tell little."""
    if chosen.free and _uneven(plans.scene):
        for found in _by_ways(plans, replace(chosen, polar=True)):
            found.notes.append(said("polar plans, as links differ so much in length"))
            yield found
    yield from _by_ways(plans, chosen)


def _uneven(scene: Scene) -> bool:
    """Whether the sides of the moving links differ too much in length for one drawing."""
    places = {name: complex(*map(float, at)) for name, at in scene.points.items()}
    sides = [abs(places[p] - places[q]) for link in scene.moving for p, q in combinations(scene.links[link], 2)]
    return max(sides, default=0.0) > UNEVEN * min((side for side in sides if side), default=1.0)


def _by_ways(plans: NetworkPlans, chosen: Style) -> Iterator[Construction]:
    """The constructions by all ways; what forces need is not even imported where there are no loads."""
    scene = plans.scene
    if scene.loads is None:
        found = alternatives(plans, lambda planner: Draughtsman(scene, planner, chosen).draw())
        return (construction for construction, _ in found)
    from graphplan.methods.forces.loaded import loaded_constructions

    return loaded_constructions(scene, plans.method, chosen)
