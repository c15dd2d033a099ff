"""What of a scene can be answered in a pose: without missing extras, friction that locks, and singular links.

Extras are what is asked for besides the motion and the forces: instant centres, centres of curvature, inflection
circles. None of these takes anything else with it. One that does not exist in a pose, or that cannot be drawn there, is
left out with its reason, and the rest is found without it.

Friction has no sense where a pair stands still, and rounding shall not give it one. So it is decided once, from the
motion alone, for construction and solver alike: by fractions where the scene is rational, else between the narrowest
bounds that can be had.

In a pose that is singular in part, links are taken group by group, in the order of motion transfer. A group that is
singular is left out, and so is what hangs on it. Forces pass against that order: those of a pair are known where no
link that is left out loads it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Generic, TypeVar

from graphplan.check.report import NOTHING_MOVES, Reasons, Report, traces_path
from graphplan.errors import ConstructionError, GraphplanError, Refused, SingularPose
from graphplan.mechanism.equations import System, stages
from graphplan.mechanism.model import FRAME, Find, Loads, Scene
from graphplan.mechanism.structure import bracing, structure
from graphplan.methods.motion.network import Turnings
from graphplan.methods.results import pair_forces
from graphplan.solver import solve
from graphplan.solver.instant_centres import relative_motion

EXTRAS = "poles", "curvature", "inflection", "acceleration_centres"

ALIKE = "the link does not turn: all its points have the same acceleration"

Item = tuple[str, str]  # which of these, and of what
Answer = TypeVar("Answer")


def answer_what_exists(scene: Scene, attempt: Callable[[Scene], Answer]) -> tuple[Answer, Reasons]:
    """The result of `attempt` for a scene, and the reason for each of its extras that is left out, by kind and name.

    Fails as `attempt` does of the scene without extras, or where these are all that is asked for and none is left.
    """
    try:
        _refuse_curvature_at_rest(scene)
        return attempt(scene), {}
    except (ConstructionError, Refused, SingularPose) as fault:
        every = extras(scene)
        if not every:
            raise
        if resting := reasons_at_rest(scene):
            moving = drop_extras(scene, resting)
            if not (extras(moving) or asks_more(scene)):
                raise
            answer, reasons = answer_what_exists(moving, attempt)
            return answer, join_reasons(resting, reasons)
        search = _Search(scene, attempt)
        if asks_more(scene):
            search.answer = attempt(with_extras(scene, ()))
        search.add(every, fault)
        if search.answer is None:
            raise
        return search.answer, search.reasons


def _refuse_curvature_at_rest(scene: Scene) -> None:
    """Fail where a path has no curvature as its point rests: every way to draw would be tried for it in vain."""
    for why in reasons_at_rest(scene).get("curvature", {}).values() if scene.find.curvature else ():
        raise SingularPose(why)


def extras(scene: Scene) -> list[Item]:
    """The extras that are asked for."""
    return [(kind, name) for kind in EXTRAS for name in getattr(scene.find, kind)]


def drop_extras(scene: Scene, reasons: Reasons) -> Scene:
    """The scene without the extras that these reasons are of."""
    return with_extras(scene, [(kind, name) for kind, name in extras(scene) if name not in reasons.get(kind, ())])


def join_reasons(one: Reasons, other: Reasons) -> Reasons:
    """Merge two tables of reasons, by kind and name."""
    return {kind: one.get(kind, {}) | other.get(kind, {}) for kind in (*one, *other)}


def reasons_at_rest(scene: Scene) -> Reasons:
    """Why poles of links that do not move relative to each other, circles of links at rest, and centres of curvature
    of points that rest on these do not exist."""
    reasons: Reasons = {}
    turnings = Turnings(scene.slides, scene.drives)
    for link in scene.find.acceleration_centres:
        if (turning := turnings.prescribed_rates(link)) and not any(turning):
            reasons.setdefault("acceleration_centres", {})[link] = ALIKE
    if scene.irrational:
        return reasons
    with suppress(SingularPose):
        rates = solve(scene, exact=True)
        for name in scene.find.poles:
            try:
                relative_motion(rates, *scene.link_pair(name))
            except SingularPose as singular:
                reasons.setdefault("poles", {})[name] = singular.why
        for name, (point, link) in scene.find.curvature_points.items():
            if not traces_path(rates, point, link):
                reasons.setdefault("curvature", {})[name] = NOTHING_MOVES.format(name)
        for link in scene.find.inflection:
            if not rates.omega[link] and not any(any(rates.velocity[point]) for point in scene.links[link]):
                reasons.setdefault("inflection", {})[link] = NOTHING_MOVES.format(link)
        for link in scene.find.acceleration_centres:
            if not (rates.omega[link] or rates.alpha[link]):
                reasons.setdefault("acceleration_centres", {})[link] = ALIKE
    return reasons


def with_extras(scene: Scene, items: Sequence[Item]) -> Scene:
    """The scene with no extras but these."""
    finds: dict[str, Any] = {kind: tuple(name for kind_asked, name in items if kind_asked == kind) for kind in EXTRAS}
    return replace(scene, find=replace(scene.find, **finds))


def asks_more(scene: Scene) -> bool:
    """Whether anything but extras is asked for."""
    find = scene.find
    return scene.loads is not None or any((find.velocity, find.acceleration, find.turning, find.slides))


class _Search(Generic[Answer]):
    """The extras that can be answered together, halved until those that cannot are left alone."""

    def __init__(self, scene: Scene, attempt: Callable[[Scene], Answer]):
        self.scene, self.attempt = scene, attempt
        self.answer: Answer | None = None
        self.kept: list[Item] = []
        self.reasons: Reasons = {}

    def add(self, items: Sequence[Item], fault: GraphplanError) -> None:
        """Keep those of `items`, which together fail with `fault`, that do not."""
        if len(items) == 1:
            (kind, name), = items
            self.reasons.setdefault(kind, {})[name] = reason(fault)
            return
        for half in (items[:len(items) // 2], items[len(items) // 2:]):
            try:
                self.answer = self.attempt(with_extras(self.scene, [*self.kept, *half]))
                self.kept += half
            except (ConstructionError, Refused, SingularPose) as smaller:
                self.add(half, smaller)


def reason(fault: GraphplanError) -> str:
    """Why there is no answer, without what to do about it."""
    match fault:
        case ConstructionError():
            return f"{fault.drawing}: {fault.why}"
        case Refused() | SingularPose():
            return fault.why
    return str(fault)


# ---- a pose that is singular in part ---------------------------------------------------------------------------------


R = TypeVar("R", bound=Report)


def report_regular_part(scene: Scene, reported: Callable[[Scene], R]) -> R:
    """The report of a scene, or of its regular part; fails with `SingularPose` if no part is regular."""
    try:
        return reported(scene)
    except SingularPose:
        regular = regular_part(scene)
        if regular is None:
            raise
        determined, missing = regular
        partial_report = reported(determined)
        return replace(partial_report, whole=scene, missing=join_reasons(missing, partial_report.missing))


def regular_part(scene: Scene) -> tuple[Scene, Reasons] | None:
    """The links of a scene that are determined, as a scene, and the reason for each result that is not; None if no
    result is determined."""
    if scene.assembly is not None:
        return None
    dead = _singular_links(scene)
    regular_links = [link for link in scene.moving if link not in dead]
    loads, untold = _regular_loads(scene, regular_links, dead)
    bare = _scene_of_links(scene, regular_links)
    questions, missing = _regular_questions(scene, dead)
    regular_scene = replace(bare, find=questions, loads=loads)
    missing |= untold
    return (regular_scene, missing) if regular_links and _answers(scene, questions, regular_links, loads) else None


def _answers(scene: Scene, known: Find, kept: Collection[str], loads: Loads | None) -> bool:
    """Whether any result is found; if no result is asked for by name, the motion of driven links does not count."""
    findings = (known.velocity, known.acceleration, known.turning, known.slides, known.poles, known.curvature,
                known.inflection, known.acceleration_centres)
    if loads is None and scene.find.by_default:
        return not {*structure(scene).driving}.issuperset(kept)
    return any(findings) or loads is not None


def _singular_links(scene: Scene) -> dict[str, str]:
    """The links whose motion is not determined in this pose, each with the reason."""
    regular_links: list[str] = []
    dead: dict[str, str] = {}
    for stage in stages(System(scene)):
        team = [name for sort, name in stage if sort == "link"]
        partial_scene = _scene_of_links(scene, [*regular_links, *team])
        try:
            if team and not bracing(partial_scene).sound:
                dead |= dict.fromkeys(team, f"it depends on a singular part: {_links_text(dead)}")
                continue
            if team:
                solve(partial_scene, exact=not scene.irrational)
            regular_links += team
        except SingularPose as singular:
            dead |= dict.fromkeys(team, f"singular pose of {_links_text(team)}: {singular.why}")
    return dead


def _scene_of_links(scene: Scene, links: Collection[str]) -> Scene:
    """The scene with these moving links alone, and without requests."""
    own_links = {FRAME, *links}
    kept_links = {link: points for link, points in scene.links.items() if link in own_links}
    on = {point for points in kept_links.values() for point in points}
    return replace(scene, links=kept_links,
                   written=tuple(pair for pair in scene.written if own_links.issuperset(pair.links)),
                   motions={point: motion for point, motion in scene.motions.items() if point in on}, loads=None,
                   find=Find((), (), (), (), ()), repetitions={
                       last: tuple(condition for condition in others if condition.link in own_links)
                       for last, others in scene.repetitions.items() if last.link in own_links})


def _links_text(links: Collection[str]) -> str:
    return f"link{'s' if len(links) > 1 else ''} {' '.join(links)}"


# ---- what is asked ---------------------------------------------------------------------------------------------------


def _regular_questions(scene: Scene, dead: Mapping[str, str]) -> tuple[Find, Reasons]:
    """The requests for links that are determined, and the reason for each of the others."""
    find = asked_by_name(scene)
    at = {point: next((dead[link] for link in links if link in dead), "") for point, links in scene.links_of.items()
          if links and all(link in dead for link in links)}
    guided = {slide.name: slide.links for slide in scene.slides}
    of: dict[str, dict[str, tuple[str, ...]]] = {
        "links": {link: (link,) for link in find.links or ()},
        "omega": {link: (link,) for link in find.omega},
        "slides": {name: guided[name] for name in find.slides or ()},
        "poles": {name: scene.link_pair(name) for name in find.poles},
        "curvature": {name: (link,) for name, (_, link) in find.curvature_points.items()},
        "inflection": {link: (link,) for link in find.inflection},
        "acceleration_centres": {link: (link,) for link in find.acceleration_centres},
    }
    missing = {key: {name: why for name, links in named.items() if (why := _first_reason(links, dead))}
               for key, named in of.items()}
    missing["points"] = {point: at[point] for point in (*find.velocity, *find.acceleration) if point in at}
    velocity, acceleration = (tuple(point for point in points if point not in at)
                              for points in (find.velocity, find.acceleration))
    pairs = None if find.reactions is None else tuple(
        name for name in find.reactions if sum(link not in dead for link in scene.links_of.get(name, ())) > 1
        or any(pair.name == name and not _first_reason(pair.links, dead) for pair in scene.directed_pairs))
    known: dict[str, Any] = {key: tuple(name for name in names if name not in missing[key])
                             for key, names in of.items()}
    questions = Find(velocity, acceleration, pairs, **known)
    missing["links"] = missing.pop("omega") | missing["links"]
    return questions, {key: named for key, named in missing.items() if named}


def _first_reason(links: Collection[str], dead: Mapping[str, str]) -> str:
    """Reason why one of these links is not determined; empty if all are."""
    return next((dead[link] for link in links if link in dead), "")


def asked_by_name(scene: Scene) -> Find:
    """The requests of a scene, with the links and slides that are requested by default."""
    find = scene.find
    points = {*find.velocity, *find.acceleration}
    links = find.links if find.links is not None else tuple(
        link for link in scene.moving if len(points & {*scene.links[link]}) > 1)
    slides = find.slides if find.slides is not None else tuple(
        slide.name for slide in scene.slides if slide.at in points)
    return replace(find, links=links, slides=slides)


# ---- forces ----------------------------------------------------------------------------------------------------------


def _regular_loads(scene: Scene, kept: Collection[str], dead: Mapping[str, str]) -> tuple[Loads | None, Reasons]:
    """The loads of the links that are known, where their forces can be had, and why others cannot."""
    loads = scene.loads
    if loads is None:
        return None, {}
    loaded = _loaded_links(scene, dead)
    own_links = {FRAME, *kept}
    regular_loads = replace(loads, masses={link: mass for link, mass in loads.masses.items() if link in own_links},
                            forces=tuple(force for force in loads.forces if force.on in own_links),
                            moments=tuple(moment for moment in loads.moments if moment.on in own_links),
                            frictions=tuple(item for item in loads.frictions if own_links.issuperset(
                        item.links or scene.links_of[item.at])))
    why = next(iter(dead.values()), "")
    partial_scene = replace(_scene_of_links(scene, kept), loads=regular_loads)
    try:
        if any(balance.link in dead for balance in loads.balances) or not bracing(partial_scene, balanced=True).sound:
            raise SingularPose(why)
        from graphplan.solver.statics import reactions

        reactions(partial_scene)
    except SingularPose as singular:
        reason = why or singular.why
        return None, {"balance": dict.fromkeys(loads.named_balances, reason),
                      "reactions": {force.name: reason for force in pair_forces(scene)}}
    untold = {"balance": {name: why for name, item in loads.named_balances.items() if item.link in loaded},
              "reactions": {force.name: why for force in pair_forces(scene)
                            if _bears_lost_load((force.on, force.by), loaded, dead)}}
    return regular_loads, {key: named for key, named in untold.items() if named}


def _bears_lost_load(links: Collection[str], loaded: Collection[str], dead: Mapping[str, str]) -> bool:
    """Whether a pair of these links bears what a link that is left out does to them."""
    moving = [link for link in links if link != FRAME]
    return any(link in dead for link in moving) or all(link in loaded for link in moving)


def _loaded_links(scene: Scene, dead: Collection[str]) -> set[str]:
    """The links that what is left out loads, against the order of the motion: itself, and all on which it hangs."""
    order = {link: k for k, stage in enumerate(stages(System(scene, balanced=True))) for sort, link in stage
             if sort == "link"}
    near: dict[str, set[str]] = {link: set() for link in scene.moving}
    for pair in scene.binding:
        for link in pair.links:
            if link in near:
                near[link] |= {*pair.links} - {link, FRAME}
    loaded, waiting = set(dead), [*dead]
    for link in waiting:
        more = {neighbour for neighbour in near[link] if order.get(neighbour, 0) <= order.get(link, 0)} - loaded
        loaded |= more
        waiting += more
    return loaded
