"""The motion of a live page: a linkage that is followed in the browser, and its construction's numbers in any pose.

What is computed is written from tapes, as functions of JavaScript: Newton's step of each group, the marks of the drawn
steps, and the results by the rules. What walks, guards and drags is `motion.js`, with the data that is made here.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, NamedTuple, cast

from graphplan.check.forces import Forces
from graphplan.check.json_results import data as as_solved
from graphplan.check.report import Report
from graphplan.cycle import continuation, groups, newton
from graphplan.cycle.closure import Layout
from graphplan.cycle.continuation import Limit
from graphplan.cycle.groups import Group
from graphplan.cycle.linkage import Linkage, grounded
from graphplan.cycle.travel import TURN, check_drives, paces, travel_unit
from graphplan.cycle.turn import RangeOfMotion, stopped, under
from graphplan.errors import Refused, Undrawable
from graphplan.kernel.kinds import POINT, Movement
from graphplan.kernel.program import Program, Step, error_at, evaluate
from graphplan.kernel.tape.record import Symbol, Symbols, Tape
from graphplan.kernel.tape.written import JAVASCRIPT, Writer, asked_of
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.units import inertia, metre, weight
from graphplan.methods.construction import Construction
from graphplan.phrases import said
from graphplan.sheet.cycle_frames import SAME

SPAN = 3.0
"""How far a sliding drive is followed either way, in reaches of the linkage."""

SOLVED = ("check", "bounds", "arithmetic", "method", "steps")
"""What of the solver's report is another in each pose."""

Data = dict[str, Any]


def motion(drawings: Sequence[Construction]) -> tuple[Data, str]:
    """What `motion.js` moves: the data, for JSON, and the tapes, an expression of JavaScript.

    Reads constructions of one scene, in the order of preference.
    """
    scene = drawings[0].scene
    programs = [_Posed(drawing) for drawing in drawings]
    linkage, steps = _linkage(scene)
    data = {
        "points": {name: [*map(float, at)] for name, at in scene.points.items()},
        "guides": {slide.name: [*map(float, slide.direction)] for slide in scene.slides},
        "under": under(scene), "shared": [[point, at, str(said(
            "points {0} and {1} coincide in the scene and lie apart here: one mark cannot serve both", point, at))]
            for point, at in drawings[0].shared.items()],
        "scene": _plain(tomllib.loads(scene.text)), "placed": [*_placed(scene)],
        "lines": [balance.direction and [*map(float, balance.direction)] for balance in scene.loads.balances]
        if scene.loads else [], "same": SAME, "linkage": linkage, "programs": [program.data for program in programs],
    }  # fmt: skip
    tapes = {"steps": steps, "drawn": [program.drawn for program in programs],
             "rules": [program.rules for program in programs]}
    return data, "{" + ",\n".join(f"{name}: [{', '.join(texts)}]" for name, texts in tapes.items()) + "}"


def _placed(scene: Scene) -> Iterator[str]:
    """The points that a scene must have whose points are given by coordinates: others only served to place them."""
    through = {name for slide in scene.slides for name in slide.through or ()}
    return (name for name, links in scene.links_of.items() if links or name in through)


SCRIPTS = "linkage.js", "opinion.js", "motion.js"


def script() -> str:
    """What moves it: the classes `Linkage`, `Path`, `Opinion` and `Motion`."""
    return "\n".join(files(__package__).joinpath(name).read_text("utf-8") for name in SCRIPTS)


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


# ---- tapes as functions ----------------------------------------------------------------------------------------------


def _step(layout: Layout) -> str:
    """Newton's step as a function `(x, y)`: it reads x and writes corrections, rates, the determinant and lies to y."""
    tape, inputs, found = newton.recorded(layout)
    outputs = [*found.corrections, *found.rates, found.determinant, *(number for lies in found.lies for number in lies)]
    writer = Writer(tape, JAVASCRIPT, {place: f"x[{k}]" for k, place in enumerate(inputs)})
    body = [*writer.statements(outputs), *(f"y[{k}] = {writer.text[place]};" for k, place in enumerate(outputs))]
    return _arrow("(x, y)", body)


def _arrow(parameters: str, body: Iterable[str]) -> str:
    return "\n".join([f"{parameters} => {{", *body, "}"])


def _literal(value: Any, text: Mapping[int, str]) -> str:
    """Nested values, symbols among them, as JavaScript."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)}: {_literal(part, text)}" for key, part in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_literal(part, text) for part in value) + "]"
    return text[value.place] if isinstance(value, Symbol) else json.dumps(value)


def _symbols(value: Any) -> Iterator[int]:
    """The places of all symbols in nested values."""
    if isinstance(value, dict | list | tuple):
        for part in value.values() if isinstance(value, dict) else value:
            yield from _symbols(part)
    elif isinstance(value, Symbol):
        yield value.place


class _Asking(Symbols):
    """Symbols that keep why a question was asked, by the step that asked it."""

    def __init__(self) -> None:
        super().__init__()
        self.reasons: list[tuple[str, str]] = []

    def sqrt(self, value: Any, code: str, why: str) -> Any:
        return self._noted(super().sqrt(value, code, why), code, why)

    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        return self._noted(super().nonzero(value, scale, code, why), code, why)

    def _noted(self, found: Any, code: str, why: str) -> Any:
        self.reasons += [(code, why)] * (len(self.tape.questions) - len(self.reasons))
        return found


class _Answering(Writer):
    """Writes questions that give the number of the one that fails."""

    def __init__(self, tape: Tape, inputs: Mapping[int, str]):
        nonzero, root = (text.replace("null", "{name}") for text in (JAVASCRIPT.nonzero, JAVASCRIPT.root))
        super().__init__(tape, JAVASCRIPT._replace(nonzero=nonzero, root=root), inputs)
        self.numbers = {asked_of(question): k for k, question in enumerate(tape.questions)}

    def _question(self, places: tuple[int, ...], name: str) -> str:
        return super()._question(places, str(self.numbers[places]))


class _Told(NamedTuple):
    """A program on a tape: the domain, the value of each step, and which step asked each question."""

    domain: _Asking
    values: list[Any]
    asked: list[Step]


class _Posed:
    """One construction in any pose: two functions of what moves, and what is to be known of them.

    Both read an array and give the number of a question that fails, or: `drawn` the values of all marks, `rules` the
    wanted points and the results.
    """

    def __init__(self, drawing: Construction):
        self.drawing, scene = drawing, drawing.scene
        given = {step.name for program in (drawing.drawn, drawing.program) for step in program.steps[:program.givens]}
        self.points = [name for name in scene.points if name in given]
        self.guides = [slide.name for slide in scene.slides if slide.through is None and slide.along != FRAME]
        drawn, rules = self._told(drawing.drawn), self._told(drawing.program)
        self.wanted = [(i, j) for i, j in zip(drawing.drawn.wanted, drawing.program.wanted, strict=True)
                       if drawing.drawn.steps[i].op.gives == POINT]
        self.drawn = self._function(drawn, tuple(drawn.values))
        points = tuple(rules.values[j] for _, j in self.wanted)
        self.rules = self._function(rules, {"points": points, "results": self._results(rules)})
        steps = len(drawing.drawn) - drawing.drawn.givens
        self.data = {
            "points": self.points, "guides": self.guides, "wanted": [i for i, _ in self.wanted],
            "asked": {"drawn": self._reasons(drawing.drawn, drawn), "rules": self._reasons(drawing.program, rules)},
            "title": scene.title, "method": drawing.method, "steps": steps,
        }  # fmt: skip

    def _told(self, program: Program) -> _Told:
        """A program on a tape of its own."""
        domain, asked = _Asking(), list[Step]()
        number = domain.tape.input
        given: dict[Any, Any] = {name: {part: number(f"{name}.{part}") for part in "xy"} for name in self.points}
        for name in self.guides:
            way = {part: number(f"{name}.{part}") for part in ("dx", "dy")}
            given |= {step.index: way for step in program.steps
                      if step.op.movement is Movement.GUIDED and " along ".join(step.links) == name}
        values = evaluate(program, domain, given,
                          lambda step: asked.extend([step] * (len(domain.tape.questions) - len(asked))))
        return _Told(domain, values, asked)

    def _reasons(self, program: Program, told: _Told) -> list[str]:
        """Why each question's step cannot be drawn where its answer is no."""
        reasons = zip(told.asked, told.domain.reasons, strict=False)
        return [str(error_at(program, step, Undrawable(*reason))) for step, reason in reasons]

    def _results(self, told: _Told) -> Data:
        """What `solve` prints, of symbols."""
        domain, program = told.domain, self.drawing.program
        results = self.drawing.told([told.values[index] for index in program.wanted], domain)
        at = {name: (domain.tape.input(f"{name}.x"), domain.tape.input(f"{name}.y")) for name in self.points}
        scene = self.drawing.scene.posed({**self.drawing.scene.points, **at}, lambda one: one.direction)
        forces = _Forces(scene, results, cast(Any, None), rounds=self.drawing.rounds, bounded=True)
        found = as_solved(_Report(self.drawing, cast(Any, None), results, False, forces if scene.loads else None,
                                  posed=scene))
        return {key: part for key, part in found.items() if key not in SOLVED}

    def _function(self, told: _Told, wanted: Any) -> str:
        """A function of the points' coordinates and the guides' directions to what is wanted."""
        tape = told.domain.tape
        names = [f"{name}.{part}" for name in self.points for part in "xy"]
        names += [f"{name}.{part}" for name in self.guides for part in ("dx", "dy")]
        inputs = {tape.input(name).place: f"x[{k}]" for k, name in enumerate(names)}
        writer = _Answering(tape, inputs)
        body = writer.statements([*_symbols(wanted)], tape.questions)
        return _arrow("(x)", [*body, f"return {_literal(wanted, writer.text)};"])


class _Forces(Forces):
    """Forces of symbols; their efficiency is left to the page, which knows the powers."""

    efficiency = None


@dataclass(frozen=True)
class _Report(Report):
    """A report in another pose."""

    posed: Scene | None = None

    @property
    def scene(self) -> Scene:
        return self.posed or self.drawing.scene
