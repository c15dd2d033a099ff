"""The motion of a live page: a linkage that is followed in the browser, and its construction's numbers in any pose.

What is computed is written from tapes, as functions of JavaScript: Newton's step of each group, the marks of the drawn
steps, and the results by the rules. What walks, guards and drags is `motion.js`, with the data that is made here.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.resources import files
from itertools import combinations
from typing import Any

from graphplan.check.report import Reasons
from graphplan.cycle import closure, groups, positions
from graphplan.cycle.closure import GroupLayout
from graphplan.cycle.groups import ClosureGroup
from graphplan.cycle.linkage import Linkage, contact_fraction, pin_given_motions
from graphplan.cycle.positions import Limit
from graphplan.cycle.tolerances import (
    CLOSURE_TOL,
    CORRECTION_TOL,
    CROSSING_STEP,
    DETERMINANT_TOL,
    LONGER_MISS,
    MIN_GOAL_STEP,
    MIN_STEP,
    SHORTER_MISS,
    SINGULAR_TOL,
)
from graphplan.cycle.travel import check_drives
from graphplan.cycle.turn import RangeOfMotion, limit_reason, points_under_slides, range_of_motion
from graphplan.errors import Refused
from graphplan.kernel.kinds import FAILURES
from graphplan.kernel.tape.record import JAVASCRIPT, Writer
from graphplan.live_pages.tapes import Data, PosedTapes, arrow
from graphplan.mechanism.load_values import guide_origin
from graphplan.mechanism.model import FRAME, Force, Scene, Slide
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.placements import TURNED_DOWN
from graphplan.mechanism.replaced import guides
from graphplan.mechanism.tolerances import TABLE_END_TOL
from graphplan.mechanism.travel import TURN, paces, sense_of_travel, travel_unit
from graphplan.mechanism.units import inertia, metre, weight
from graphplan.methods.construction import Construction
from graphplan.methods.replay import coincidence_fault
from graphplan.phrases import said
from graphplan.sheet.tolerances import MARK_TOL

SPAN = 3.0
"""How far a sliding drive is followed either way, in reaches of the linkage."""


def motion(drawings: Sequence[Construction], missing: Reasons | None = None) -> tuple[Data, str]:
    """Data that `motion.js` moves, for JSON, and the tapes, an expression of JavaScript.

    Reads constructions of one scene, the best first, and why some of what is asked is not known. Texts are phrases.
    """
    scene = drawings[0].scene
    first = PosedTapes(drawings[0], missing or {})
    programs = [first, *(PosedTapes(drawing, first.missing, first) for drawing in drawings[1:])]
    linkage, steps = _linkage(scene)
    data = {
        "points": {name: [*map(float, at)] for name, at in scene.points.items()},
        "guides": {name: [*map(float, guide.direction)] for name, guide in guides(scene).items()},
        "touching": [*_touching(scene)],
        "under": points_under_slides(scene),
        "shared": [[point, at, coincidence_fault(point, at)]
                   for point, at in drawings[0].coincident_points.items()],
        "lined": [[one, other_guide,
                   said("guides {0} and {1} are drawn as one line, and turn apart here", one, other_guide)]
                  for one, other_guide in _coinciding_guides(scene)],
        "guiding": [[*guide.through, FAILURES["points-coincide"][0]]
                    for guide in guides(scene).values() if guide.through],
        "scene": _plain(_scene_for_all_poses(tomllib.loads(scene.text))), "placed": [*_required_points(scene)],
        "lines": [balance.direction and [*map(float, balance.direction)] for balance in scene.loads.balances]
        if scene.loads else [], "same": MARK_TOL, "linkage": linkage,
        "programs": [program.data for program in programs],
        "rolling": [*rolling(scene)],
    }  # fmt: skip
    rules = list(dict.fromkeys(program.rules for program in programs))
    for program in programs:
        program.data["rules"] = rules.index(program.rules)
    tapes = {"steps": steps, "drawn": [program.drawn for program in programs], "rules": rules}
    return data, "{" + ",\n".join(f"{name}: [{', '.join(texts)}]" for name, texts in tapes.items()) + "}"


def _coinciding_guides(scene: Scene) -> Iterator[tuple[str, str]]:
    """The guides that are one line in the given pose, and ride on two links."""
    straight = ((name, guide) for name, guide in guides(scene).items() if guide.through is None)
    for (name, slide), (another, other_slide) in combinations(straight, 2):
        if (slide.at == other_slide.at and slide.direction == other_slide.direction
                and other_slide.along not in scene.turning_alike(slide.along)):
            yield name, another


def _required_points(scene: Scene) -> Iterator[str]:
    """The points that a scene must have whose points are given by coordinates: others only served to place them, or are
    those of a joint in space, which adds them."""
    needed = {name for guide in guides(scene).values() for name in guide.through or ()}
    needed |= {contact.at for contact in scene.contacts}
    added = {name for name, placement in scene.placements.items() if placement.how == TURNED_DOWN}
    return (name for name, links in scene.links_of.items() if (links or name in needed) and name not in added)


def rolling(scene: Scene) -> Iterator[tuple[str, str]]:
    """The links, each with one that it moves on, whose centrodes may be shown: all that the frame neither pins nor
    guides, and those that the sheet asks for."""
    bound = {link for pair in scene.binding if pair.binds > 1 and FRAME in pair.links for link in pair.links}
    free = [f"{link} {scene.frame}" for link in scene.moving if link not in bound]
    return (scene.link_pair(names) for names in dict.fromkeys([*free, *scene.sheet.centrodes]))


def script() -> str:
    """Script that moves the page: the class `Motion`, with all that it needs."""
    texts = (files(__package__).joinpath(f"{name}.js").read_text("utf-8")
             for name in ("linkage", "opinion", "loads", "toml", "motion"))
    return "\n".join(['const Motion = (() => {\n"use strict";', *texts, "return Motion;\n})();\n"])


def _scene_for_all_poses(told: Data) -> Data:
    """Data of a scene that hold in all poses: without the next arc of a profile, which belongs to its own pose
    alone."""
    return told | ({"contacts": [{key: value for key, value in contact.items() if key != "next"}
                                 for contact in told["contacts"]]} if "contacts" in told else {})


def _plain(value: Any) -> Any:
    """A TOML value as JSON has it."""
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value if isinstance(value, str | bool | int | float) else str(value)


# ---- the linkage -----------------------------------------------------------------------------------------------------


RULES = {
    "longest": positions.MAX_STEP_TURNS * TURN, "first": positions.FIRST_STEP,
         "back": positions.PREDICTOR_KNOTS,
    "beside": positions.INTERPOLATION_KNOTS, "finest": MIN_STEP, "short": MIN_GOAL_STEP,
         "slack": positions.LIMIT_SLACK,
    "easy": LONGER_MISS, "hard": SHORTER_MISS, "singular": SINGULAR_TOL,
    "across": CROSSING_STEP, "nothing": DETERMINANT_TOL, "near": groups.MAX_FIRST_CORRECTION,
         "shrinking": groups.MAX_CORRECTION_RATIO,
    "settled": CORRECTION_TOL, "closed": CLOSURE_TOL,
}  # fmt: skip
"""By what the path is guarded: the constants of `cycle`."""


def _linkage(scene: Scene) -> tuple[Data, list[str]]:
    """The linkage with its limits, and Newton's step of each structure of groups; without a drive the reason."""
    pinned = pin_given_motions(scene)
    linkage, groups = _linkage_groups(pinned, tuple(1.0 for _ in scene.drives))
    _, other_groups = _linkage_groups(pinned, tuple(float(k + 1) for k in range(len(scene.drives))))
    layouts = list(dict.fromkeys(group.layout for group in groups))
    moving = {link: k for k, link in enumerate(linkage.links)}
    return {
        "rules": RULES, "reach": linkage.reach, "origin": _pair(linkage.origins[FRAME]), **_drive_ranges(scene),
        "groups": [_group(group, other_group, moving, layouts)
                   for group, other_group in zip(groups, other_groups, strict=True)],
        "counted": _angle_counts(groups, other_groups, moving) if linkage.counts_angles else None,
        "links": moving, "opinion": _opinion(scene, moving), "changing": [*_changing(scene, moving)],
        "bases": [_pair(linkage.origins[link] - linkage.origins[FRAME], linkage.reach) for link in linkage.links],
        "owned": dict(_points_by_link(linkage)), "guided": dict(_riding_guides(scene, moving)),
        "ways": list(_written_directions(scene)), "anchors": list(_anchors(linkage, groups)),
        "locked": said("the links move by their special geometry alone") if scene.redundant else "",
        "held": {**{name: said("point {0} belongs to gears or profiles of the frame", name)
                    for name in _distance_keeping_points(scene)},
                 **{name: said("point {0} belongs to the fork", name) for name in _fork_pins(scene)}},
    }, [_step(layout) for layout in layouts]  # fmt: skip


def _drive_ranges(scene: Scene) -> Data:
    """The drives, how far they are followed and the limits there; or why they are not."""
    try:
        check_drives(scene)
        rates, why = paces(scene), ""
        unit, ends = travel_unit(scene)[0], _span(scene)
        path = RangeOfMotion(scene, *ends, False).path
        limits = [_limit(path.lower), _limit(path.upper)]
    except Refused as refused:
        rates, why = tuple(0.0 for _ in scene.drives), refused.why
        unit, ends, limits = 1.0, (0.0, 0.0), [{"travel": 0.0}, {"travel": 0.0}]
    drives = [{"slides": drive.slides, "pace": pace, "rate": float(drive.rate), "change": float(drive.change),
               "link": drive.link,               "slide": scene.driven_slide(drive).name if drive.slides else ""}
              for drive, pace in zip(scene.drives, rates, strict=True)]
    return {"still": why, "drives": drives, "sense": sense_of_travel(scene), "unit": unit, "span": [*ends],
            "limits": limits, "turns": 1 if why or not scene.gears else _turns_until_return(scene)}


def _turns_until_return(scene: Scene) -> int:
    """The turns of the first drive after which all is back; 0 where these are too many to be looked for."""
    motion = range_of_motion(scene)
    returns = motion.goes_round or motion.path.lower or motion.path.upper
    return max(1, round(motion.path.travel[-1] / TURN)) if returns else 0


def _limit(limit: Limit | None) -> Data | None:
    """A limit, if there is one."""
    return limit and {"travel": limit.travel, "slack": limit.slack}


def _span(scene: Scene) -> tuple[float, float]:
    """Range of the first drive in both senses: a turn, or so many reaches."""
    places = [complex(*map(float, at)) for at in scene.points.values()]
    most = SPAN * max(abs(place - places[0]) for place in places) if scene.drives[0].slides else TURN
    return -most, most


def _pair(z: complex, unit: float = 1.0) -> list[float]:
    return [z.real / unit, z.imag / unit]


def _opinion(scene: Scene, moving: Mapping[str, int]) -> Data:
    """Data of the linkage's rates, and loads of the links: forces, and moments in force times length."""
    long, loads = float(metre(scene.units)), scene.loads
    weigh, resist, couple = float(weight(scene.units)), float(inertia(scene.units)), float(weight(scene.units)) * long
    pull = [weigh * float(component) for component in loads.gravity] if loads else [0.0, 0.0]
    return {
        "points": {name: moving[links[0]] for name, links in scene.links_of.items() if links}, 
        "slides": [_slide(slide, moving) for slide in scene.slides],
        "acting": [*({"link": moving[force.on], "at": force.at, "force": [*map(float, force.value)]}
                     for force in (loads.forces if loads else ()) if not force.table),
                   *({"link": moving[moment.on], "moment": long * float(moment.value)}
                     for moment in (loads.moments if loads else ()) if not moment.table)],
        "masses": [{"link": moving[link], "at": mass.centre, "mass": resist * float(mass.mass),
                    "inertia": couple * float(mass.inertia), "weight": [float(mass.mass) * part for part in pull]}
                   for link, mass in (loads.masses.items() if loads else ())],
        "metre": long,
    }  # fmt: skip


def _slide(slide: Slide, moving: Mapping[str, int]) -> Data:
    """A slide by the places of its links."""
    return {"name": slide.name, "link": moving[slide.link], "along": moving[slide.along], "at": slide.at,
            "direction": [*map(float, slide.direction)], "through": slide.through}


def _changing(scene: Scene, moving: Mapping[str, int]) -> Iterator[Data]:
    """The loads that change, with their tables: rows by the sense in which the place changes."""
    slides = {slide.name: slide for slide in scene.slides}
    for name, load in changing_loads(scene.loads).items():
        assert load.table is not None
        table, slide = load.table, slides.get(load.table.slide)
        force: Data = {"at": load.at, "direction": [*map(float, load.direction or ())],
                       "through": load.through} if isinstance(load, Force) else {}
        strokes = {} if table.powers else {
            str(sense): [[*map(float, row)] for row in rows] for sense, rows in table.strokes.items()}
        yield {
            "name": name, "link": moving[load.on], "force": bool(force), **force, "strokes": strokes,
            "over": "distance" if table.span else "speed" if table.over_speed else "place",
            "span": table.span, "period": float(table.period),
            "rate": float(scene.drives[0].rate), "powers": [*map(float, table.powers)] or None,
            "slack": float(table.length * TABLE_END_TOL) if strokes else 0.0,
            "slide": slide and {**_slide(slide, moving), "origin": guide_origin(scene, slide)},
        }  # fmt: skip


def _linkage_groups(scene: Scene, rates: tuple[float, ...]) -> tuple[Linkage, list[ClosureGroup]]:
    """The linkage and its groups, whose drives have these rates.

    The frame's base lies off all its points, so that each has an arm: it may be moved.
    """
    linkage = Linkage(scene, rates)
    low = [min(coordinates) for coordinates in zip(*((z.real, z.imag) for z in linkage.places.values()), strict=True)]
    linkage.origins[FRAME] = complex(*low) - linkage.reach * (1 + 1j)
    return linkage, [ClosureGroup(linkage, part) for part in linkage.parts]


def _group(group: ClosureGroup, other: ClosureGroup, moving: Mapping[str, int], layouts: Sequence[GroupLayout]) -> Data:
    """A group in its numbers; `other` is the same with drives of other rates, which tell them apart."""
    return {
        "step": layouts.index(group.layout), "carriers": [moving[link] for link in group.carriers],
        "links": [moving[link] for link in group.links], "arms": [length for arm in group.arms for length in arm],
        "drives": [[round(two / rate) - 1, turns, rate]
                   for (turns, rate), (_, two) in zip(group.drives, other.drives, strict=True)],
        "angles": group.layout.angles, "unknowns": group.unknowns,
        "stops": [limit_reason(group.part, change) for change in (False, True)],
    }  # fmt: skip


def _angle_counts(groups: Sequence[ClosureGroup], others: Sequence[ClosureGroup],
                  moving: Mapping[str, int]) -> list[Data]:
    """Terms of each link's angle: an unknown, or the angle of the link `on`, and a drive; -1 for a missing term."""
    counts, first = [{"on": 0, "unknown": -1, "drive": -1, "rate": 0.0} for _ in moving], 0
    for group, other_group in zip(groups, others, strict=True):
        places = [moving[link] for link in (FRAME, *group.carriers, *group.links)]
        unknowns = iter(range(first, first + group.unknowns))
        for spin in group.layout.spins:
            count = counts[places[spin.link]]
            if spin.on is None:
                count["unknown"] = next(unknowns)
                continue
            count["on"] = places[spin.on]
            if spin.drive is not None:
                rate, as_told = group.drives[spin.drive][1], other_group.drives[spin.drive][1]
                count |= {"drive": round(as_told / rate) - 1, "rate": rate}
        first += group.unknowns
    return counts


def _points_by_link(linkage: Linkage) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Each moving point by its link and where that has it: its base's place, and from there."""
    for point, links in linkage.scene.links_of.items():
        if links and FRAME not in links:
            link = min(links, key=linkage.order.__getitem__)
            base = linkage.origins[link]
            lever = linkage.places[point] - base
            yield point, (linkage.order[link], lever.real, lever.imag)


def _riding_guides(scene: Scene, moving: Mapping[str, int]) -> Iterator[tuple[str, int]]:
    """The guides that ride on links in a direction of their own, each with its link."""
    return ((name, moving[guide.along]) for name, guide in guides(scene).items()
            if guide.through is None and guide.along != FRAME)


def _written_directions(scene: Scene) -> Iterator[tuple[str, str, int, int | None]]:
    """Yield the places in the scene of directions of racks and straight profiles: by name the table, its row, and the
    centre."""
    for place, gear in enumerate(scene.gears):
        if gear.direction is not None:
            yield gear.name, "gears", place, None
    for place, contact in enumerate(scene.contacts):
        if contact.direction is not None:
            yield contact.name, "contacts", place, contact.centres.index(None)


def _distance_keeping_points(scene: Scene) -> Iterator[str]:
    """The points of the frame that keep the distance of two pitch circles, or the direction of a rack or profile."""
    fixed = {*scene.links.get(FRAME, ())}
    for gear in scene.gears:
        if gear.radii and not gear.belt and {*gear.centres} <= fixed:
            yield from gear.centres
    for pair in scene.directed_pairs:
        yield from fixed & {*(pair.through or ())} if not isinstance(pair, Slide) else ()


def _fork_pins(scene: Scene) -> Iterator[str]:
    """The centre and the pivot of each swinging fork, whose crank is as long as their distance makes it."""
    for joint in tomllib.loads(scene.text).get("joints", ()):
        if "pivot" in joint:
            yield from (joint["centre"], joint["pivot"])


def _touching(scene: Scene) -> Iterator[Data]:
    """Yield the contact points: between two centres by a share, or off one as a link turns. The point that this is in
    the given pose is `at`; if it is on a link, the place has a name of its own in other poses, `else`."""
    places = {name: complex(*map(float, at)) for name, at in scene.points.items()}
    for contact in scene.contacts:
        _, on, centre = contact.curved_side
        twin = f"{contact.at}'" if scene.links_of[contact.at] else ""
        touch: Data = {"at": contact.at, "centre": centre, "else": twin}
        if contact.direction is not None:
            yield touch | {"off": _pair(places[contact.at] - places[centre]), "on": on}
        else:
            yield touch | {"other": contact.centres[1], "share": contact_fraction(scene, contact)}


def _anchors(linkage: Linkage, parts: Iterable[ClosureGroup]) -> Iterator[tuple[Any, ...]]:
    """The arms and ways of the frame that follow its points.

    Each by its group and place; the points P and Q that it follows, none if empty; and its number c: the arm leads to
    P + c u, the way is c u, u being the direction from P to Q, or 1.
    """
    scene, places = linkage.scene, linkage.places
    fixed = set(scene.links.get(FRAME, ()))
    for g, group in enumerate(parts):
        for k, (end, arm) in enumerate(zip(group.ends, group.arms, strict=True)):
            if end.link != FRAME or not end.at:
                continue
            guides = (slide.through for slide in scene.slides if slide.along == FRAME and slide.at == end.at)
            pins = [name for name in next(guides, None) or () if name in fixed]
            if not end.is_direction and end.at in fixed and not pins:
                yield g, k, end.is_direction, end.at, "", 0.0, 0.0
            elif len(pins) == 2:
                P, Q = pins
                along = (places[Q] - places[P]) / abs(places[Q] - places[P])
                c = (complex(*arm) if end.is_direction else places[end.at] - places[P]) / along
                yield g, k, end.is_direction, P, Q, c.real, c.imag
            elif pins and not end.is_direction:
                c = places[end.at] - places[pins[0]]
                yield g, k, end.is_direction, pins[0], "", c.real, c.imag


def _step(layout: GroupLayout) -> str:
    """Newton's step as a function `(x, y)`: it reads x and writes corrections, rates, the determinant and lies to y."""
    tape, inputs, step_outputs = closure.record_step(layout)
    outputs = [*step_outputs.corrections, *step_outputs.rates, step_outputs.determinant,
               *(number for lies in step_outputs.lies for number in lies)]
    writer = Writer(tape, JAVASCRIPT, {place: f"x[{k}]" for k, place in enumerate(inputs)})
    body = [*writer.statements(outputs), *(f"y[{k}] = {writer.text[place]};" for k, place in enumerate(outputs))]
    return arrow("(x, y)", body)
