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

from graphplan.cycle import continuation, groups, newton
from graphplan.cycle.closure import Layout
from graphplan.cycle.continuation import Limit
from graphplan.cycle.groups import Group
from graphplan.cycle.linkage import Linkage, grounded
from graphplan.cycle.travel import TURN, check_drives, paces, travel_unit
from graphplan.cycle.turn import RangeOfMotion, stopped, under
from graphplan.errors import Refused
from graphplan.kernel.tape.written import JAVASCRIPT, Writer
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.units import inertia, metre, weight
from graphplan.methods.batch import apart
from graphplan.methods.construction import Construction
from graphplan.output.live.tapes import Data, PosedTapes, arrow
from graphplan.phrases import said
from graphplan.sheet.cycle_frames import SAME

SPAN = 3.0
"""How far a sliding drive is followed either way, in reaches of the linkage."""


def motion(drawings: Sequence[Construction]) -> tuple[Data, str]:
    """What `motion.js` moves: the data, for JSON, and the tapes, an expression of JavaScript.

    Reads constructions of one scene, in the order of preference. Texts in the data are phrases, for any tongue.
    """
    scene = drawings[0].scene
    programs = [PosedTapes(drawing) for drawing in drawings]
    linkage, steps = _linkage(scene)
    data = {
        "points": {name: [*map(float, at)] for name, at in scene.points.items()},
        "guides": {slide.name: [*map(float, slide.direction)] for slide in scene.slides},
        "under": under(scene), "shared": [[point, at, apart(point, at)] for point, at in drawings[0].shared.items()],
        "lined": [[one, other, said("guides {0} and {1} are drawn as one line, and turn apart here", one, other)]
                  for one, other in _lined(scene)],
        "scene": _plain(tomllib.loads(scene.text)), "placed": [*_placed(scene)],
        "lines": [balance.direction and [*map(float, balance.direction)] for balance in scene.loads.balances]
        if scene.loads else [], "same": SAME, "linkage": linkage, "programs": [program.data for program in programs],
        "rolling": [*rolling(scene)],
    }  # fmt: skip
    rules = list(dict.fromkeys(program.rules for program in programs))  # other forms of one program share them
    for program in programs:
        program.data["rules"] = rules.index(program.rules)
    tapes = {"steps": steps, "drawn": [program.drawn for program in programs], "rules": rules}
    return data, "{" + ",\n".join(f"{name}: [{', '.join(texts)}]" for name, texts in tapes.items()) + "}"


def _lined(scene: Scene) -> Iterator[tuple[str, str]]:
    """The guides that are one line in the given pose, and ride on two links."""
    for one, other in combinations([slide for slide in scene.slides if slide.through is None], 2):
        if one.at == other.at and one.direction == other.direction and one.along != other.along:
            yield one.name, other.name


def _placed(scene: Scene) -> Iterator[str]:
    """The points that a scene must have whose points are given by coordinates: others only served to place them."""
    through = {name for slide in scene.slides for name in slide.through or ()}
    return (name for name, links in scene.links_of.items() if links or name in through)


def rolling(scene: Scene) -> Iterator[list[str]]:
    """The links, each with one that it moves on, whose centrodes may be shown: all that the frame neither pins nor
    guides, and those that the sheet asks for."""
    bound = {link for pair in scene.binding if pair.binds > 1 and FRAME in pair.links for link in pair.links}
    free = [f"{link} {FRAME}" for link in scene.moving if link not in bound]
    return (names.split() for names in dict.fromkeys([*free, *scene.sheet.centrodes]))


def script() -> str:
    """What moves it: the class `Motion`, all else it needs being its own."""
    texts = (files(__package__).joinpath(f"{name}.js").read_text("utf-8") for name in ("linkage", "opinion", "motion"))
    return "\n".join(['const Motion = (() => {\n"use strict";', *texts, "return Motion;\n})();\n"])


def _plain(value: Any) -> Any:
    """A TOML value as JSON has it."""
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_plain(part) for part in value]
    return value if isinstance(value, str | bool | int | float) else str(value)


# ---- the linkage -----------------------------------------------------------------------------------------------------


RULES = {
    "longest": continuation.LONGEST * TURN, "first": continuation.FIRST, "back": continuation.BACK,
    "beside": continuation.BESIDE, "finest": continuation.FINEST, "slack": continuation.SLACK,
    "easy": continuation.EASY, "hard": continuation.HARD, "singular": continuation.SINGULAR,
    "across": continuation.ACROSS, "nothing": newton.NOTHING, "near": groups.NEAR, "shrinking": groups.SHRINKING,
    "settled": groups.SETTLED, "closed": groups.CLOSED,
}  # fmt: skip
"""By what the path is guarded: the constants of `cycle`."""


def _linkage(scene: Scene) -> tuple[Data, list[str]]:
    """The linkage with its limits, and Newton's step of each structure of groups; where nothing drives it, why."""
    found = grounded(scene)
    linkage, parts = _parts(found, tuple(1.0 for _ in scene.drives))
    _, others = _parts(found, tuple(float(k + 1) for k in range(len(scene.drives))))
    layouts = list(dict.fromkeys(group.layout for group in parts))
    moving = {link: k for k, link in enumerate(linkage.links)}
    return {
        "rules": RULES, "reach": linkage.reach, "origin": _pair(linkage.origins[FRAME]), **_followed(scene),
        "groups": [_group(group, other, moving, layouts) for group, other in zip(parts, others, strict=True)],
        "links": moving, "opinion": _opinion(scene, moving),
        "bases": [_pair(linkage.origins[link] - linkage.origins[FRAME], linkage.reach) for link in linkage.links],
        "owned": dict(_owned(linkage)), "guided": dict(_guided(scene, moving)),
        "anchors": list(_anchors(linkage, parts)),
        "locked": said("the links move by their special geometry alone") if scene.redundant else "",
    }, [_step(layout) for layout in layouts]  # fmt: skip


def _followed(scene: Scene) -> Data:
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
               "slide": scene.driven_slide(drive).name if drive.slides else ""}
              for drive, pace in zip(scene.drives, rates, strict=True)]
    return {"still": why, "drives": drives, "unit": unit, "span": [*ends], "limits": limits}


def _limit(limit: Limit | None) -> Data | None:
    """A limit, if there is one."""
    return limit and {"travel": limit.travel, "slack": limit.slack}


def _span(scene: Scene) -> tuple[float, float]:
    """How far the first drive is followed each way: a turn, or so many reaches."""
    places = [complex(*map(float, at)) for at in scene.points.values()]
    most = SPAN * max(abs(place - places[0]) for place in places) if scene.drives[0].slides else TURN
    return -most, most


def _pair(z: complex, unit: float = 1.0) -> list[float]:
    return [z.real / unit, z.imag / unit]


def _opinion(scene: Scene, moving: Mapping[str, int]) -> Data:
    """What the linkage's own rates are told of, and what acts on the links: forces, and moments in force times length.
    """
    long, loads = float(metre(scene.units)), scene.loads
    weigh, resist, couple = float(weight(scene.units)), float(inertia(scene.units)), float(weight(scene.units)) * long
    pull = [weigh * float(part) for part in loads.gravity] if loads else [0.0, 0.0]
    return {
        "points": {name: moving[links[0]] for name, links in scene.links_of.items() if links}, 
        "slides": [{"name": slide.name, "link": moving[slide.link], "along": moving[slide.along], "at": slide.at,
                    "direction": [*map(float, slide.direction)], "through": slide.through} for slide in scene.slides],
        "acting": [*({"link": moving[force.on], "at": force.at, "force": [*map(float, force.value)]}
                     for force in (loads.forces if loads else ())),
                   *({"link": moving[moment.on], "moment": long * float(moment.value)}
                     for moment in (loads.moments if loads else ()))],
        "masses": [{"link": moving[link], "at": mass.centre, "mass": resist * float(mass.mass),
                    "inertia": couple * float(mass.inertia), "weight": [float(mass.mass) * part for part in pull]}
                   for link, mass in (loads.masses.items() if loads else ())],
        "metre": long,
    }  # fmt: skip


def _parts(scene: Scene, rates: tuple[float, ...]) -> tuple[Linkage, list[Group]]:
    """The linkage and its groups, whose drives have these rates.

    The frame's base lies off all its points, so that each has an arm: it may be moved.
    """
    linkage = Linkage(scene, rates)
    low = [min(part) for part in zip(*((z.real, z.imag) for z in linkage.places.values()), strict=True)]
    linkage.origins[FRAME] = complex(*low) - linkage.reach * (1 + 1j)
    return linkage, [Group(linkage, part) for part in linkage.parts]


def _group(group: Group, other: Group, moving: Mapping[str, int], layouts: Sequence[Layout]) -> Data:
    """A group in its numbers; `other` is the same with drives of other rates, which tell them apart."""
    return {
        "step": layouts.index(group.layout), "carriers": [moving[link] for link in group.carriers],
        "links": [moving[link] for link in group.links], "arms": [part for arm in group.arms for part in arm],
        "drives": [[round(two / one) - 1, turns, one]
                   for (turns, one), (_, two) in zip(group.drives, other.drives, strict=True)],
        "angles": group.layout.angles, "unknowns": group.unknowns,
        "stops": [stopped(group.part, change) for change in (False, True)],
    }  # fmt: skip


def _owned(linkage: Linkage) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Each moving point by its link and where that has it: its base's place, and from there."""
    for point, links in linkage.scene.links_of.items():
        if links and FRAME not in links:
            link = min(links, key=linkage.order.__getitem__)
            base = linkage.origins[link]
            lever = linkage.places[point] - base
            yield point, (linkage.order[link], lever.real, lever.imag)


def _guided(scene: Scene, moving: Mapping[str, int]) -> Iterator[tuple[str, int]]:
    """The guides that ride on links in a direction of their own, each with its link."""
    return ((slide.name, moving[slide.along]) for slide in scene.slides
            if slide.through is None and slide.along != FRAME)


def _anchors(linkage: Linkage, parts: Iterable[Group]) -> Iterator[tuple[Any, ...]]:
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
            if not end.way and end.at in fixed and not pins:
                yield g, k, end.way, end.at, "", 0.0, 0.0
            elif len(pins) == 2:
                P, Q = pins
                along = (places[Q] - places[P]) / abs(places[Q] - places[P])
                c = (complex(*arm) if end.way else places[end.at] - places[P]) / along
                yield g, k, end.way, P, Q, c.real, c.imag
            elif pins and not end.way:
                c = places[end.at] - places[pins[0]]
                yield g, k, end.way, pins[0], "", c.real, c.imag


def _step(layout: Layout) -> str:
    """Newton's step as a function `(x, y)`: it reads x and writes corrections, rates, the determinant and lies to y."""
    tape, inputs, found = newton.recorded(layout)
    outputs = [*found.corrections, *found.rates, found.determinant, *(number for lies in found.lies for number in lies)]
    writer = Writer(tape, JAVASCRIPT, {place: f"x[{k}]" for k, place in enumerate(inputs)})
    body = [*writer.statements(outputs), *(f"y[{k}] = {writer.text[place]};" for k, place in enumerate(outputs))]
    return arrow("(x, y)", body)
