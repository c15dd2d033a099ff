"""The scene's own relations on a tape: where all its points are, from its fixed pins and the travels of its drives.

Pins of the frame are free, but for those that the scene places by compasses or protractor from others. Driven links
follow their drives; plain dyads are crossed by the compass rules, on the side of the given pose; all other groups are
closed by Newton's steps, from where the undragged linkage has them at this travel (`knots`). Every link is carried
rigidly. All in mm of paper. A pose that does not exist, or to which the steps do not lead, asks for the root of a
negative number: undefined in every target.

The inputs of the tape, by name: `x O`, `y O` of a free pin; of the drive k `cos k`, `sin k`, or `shift k` in mm; of
the state i at the first drive's travel `cos state i`, `sin state i`, or `state i`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle import closure
from graphplan.cycle.closure import DriveState, LinkPose
from graphplan.cycle.dyads import PlacedLink, assemble_dyad
from graphplan.cycle.groups import ClosureGroup
from graphplan.cycle.linkage import Linkage, contact_point, pin_given_motions
from graphplan.cycle.tolerances import PIN_TOL, RELATION_TOL
from graphplan.cycle.turn import RangeOfMotion, points_under_slides, range_of_motion, travelling_contacts
from graphplan.errors import GraphplanError
from graphplan.kernel.kinds import Movement, made_by
from graphplan.kernel.tape.record import MAX_NESTING, Language, Symbol, Symbols, Writer, function
from graphplan.mechanism.fields import vector
from graphplan.mechanism.model import FRAME, Contact, Placement, Scene
from graphplan.mechanism.numbers import exactly
from graphplan.mechanism.placements import needs
from graphplan.mechanism.travel import sense_of_travel
from graphplan.sheet.plates.view import View

Spot = tuple[Any, Any]  # symbols, or numbers where nothing moves it


class Ground:
    """The frame as compass rules read a link: its points where they are dragged, all else where it was given.

    `free` are the pins that may be dragged. Points that give a guide of the frame its direction stay, and those
    that hold the wheels of a pair apart: with them the wheels would be others.
    """

    def __init__(self, domain: Symbols, scene: Scene, view: View, places: Mapping[str, complex]):
        self.domain, self.scene, self.view, self.places = domain, scene, view, places
        self.fixed = {end for slide in scene.slides if slide.along == FRAME for end in slide.through or ()}
        self.fixed |= {end for gear in scene.gears if {*gear.centres} <= {*scene.links.get(FRAME, ())}
                       for end in gear.centres}
        self.free: list[str] = []
        self.pins: dict[str, Planar] = {}
        for name in self._fixed_points():
            self.pins[name] = self._pin(name)

    def point(self, place: complex) -> Planar:
        """Present place of the frame's point that was given at `place`."""
        pin = next((name for name in self.pins if abs(self.places[name] - place) < PIN_TOL), None)
        return planar(place) if pin is None else self.pins[pin]

    def ray(self, along: complex) -> Planar:
        """Direction of a ray of the frame, as given."""
        return planar(along)

    def shifted_to(self, origin: complex, base: Any) -> PlacedLink:
        """A link that turns as the frame does, and has this point."""
        return PlacedLink(origin, base, planar(1.0))

    def _fixed_points(self) -> list[str]:
        """The points of the frame and of no link, each after those that place it; contacts touch where they touch."""
        touching = {contact.at for contact in self.scene.contacts}
        still = [name for name, links in self.scene.links_of.items()
                 if FRAME in links or not (links or name in touching)]
        ordered: list[str] = []
        while remaining := [name for name in still if name not in ordered]:
            ready = [name for name in remaining if {*self._placers(name, still)} <= {*ordered}]
            ordered += ready or remaining
        return ordered

    def _placers(self, name: str, still: Sequence[str]) -> tuple[str, ...]:
        """The points from which a point of the frame is placed, if all are of the frame themselves."""
        placement = self.scene.placements.get(name)
        on = needs(placement) if placement and name not in self.fixed else ()
        return on if {*on} <= {*still} else ()

    def _pin(self, name: str) -> Planar:
        """A point of the frame: free, or as the scene places it from others."""
        place = self.scene.placements.get(name)
        if place and self._placers(name, [*self.pins]):
            x, y = self._apply_placement(name, place,
                                         {pin_name: (pin.re, pin.im) for pin_name, pin in self.pins.items()})
            return Planar(x, y)
        if name in self.fixed:
            return planar(self.places[name])
        self.free.append(name)
        return Planar(self.domain.tape.input(f"x {name}"), self.domain.tape.input(f"y {name}"))

    def _apply_placement(self, name: str, placement: Placement, at: Mapping[str, Spot]) -> Any:
        """Place of a point by a placement with distance, angle or compasses."""
        data: dict[str, Any] = placement.data
        scale = self.view.scale
        if placement.how == "polar":
            (x, y), off = at[data["from"]], self.places[name] - self.places[data["from"]]
            return x + off.real, y + off.imag
        if placement.how == "compass":
            arcs = [(*at[centre], (scale * float(r)) ** 2) for centre, r in data["distances"].items()]
            return made_by(Movement.ARCS_MET).rule(self.domain, *arcs, side=data["side"])
        if placement.how == "on-line":
            P, Q = (planar(at[end]) for end in data["on"].split())
            at_distance = P + (Q - P) * (scale * float(data["distance"]) / ((Q - P).real**2 + (Q - P).imag**2).sqrt())
            return at_distance.re, at_distance.im
        ((centre, r),) = data["distances"].items()
        through, towards = data["on"]["through"], data["on"]["direction"]
        x, y = at[through] if isinstance(through, str) else self.view((float(through[0]), float(through[1])))
        dx, dy = self._direction(towards, at)
        line, arc = (-dy, dx, dy * x - dx * y), (*at[centre], (scale * float(r)) ** 2)
        return made_by(Movement.CUT).rule(self.domain, line, arc, way="on" if data["pick"] == "right" else "back")

    def _direction(self, way: Any, at: Mapping[str, Spot]) -> Spot:
        """A direction: of two points, or as it is given."""
        if isinstance(way, str) and len(ends := way.split()) == 2:
            (x, y), (u, v) = (at[end] for end in ends)
            return u - x, v - y
        x, y, _ = vector(way, lambda name: exactly(self.scene.points[name]))
        return float(x), float(y)


class Planar:
    """A complex number of symbols, as the compass rules compute with it."""

    __slots__ = ("im", "re")

    def __init__(self, re: Any, im: Any = 0.0):
        self.re, self.im = re, im

    @property
    def real(self) -> Planar:
        return Planar(self.re)

    @property
    def imag(self) -> Planar:
        return Planar(self.im)

    def conj(self) -> Planar:
        return Planar(self.re, -self.im)

    def sqrt(self) -> Planar:
        """The square root of a real number: numpy asks for it by this name."""
        return Planar(self.re.tape.sqrt(self.re.place) if isinstance(self.re, Symbol) else math.sqrt(self.re))

    def __add__(self, other: Any) -> Planar:
        other = planar(other)
        return Planar(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Any) -> Planar:
        return self + -planar(other)

    def __rsub__(self, other: Any) -> Planar:
        return planar(other) + -self

    def __neg__(self) -> Planar:
        return Planar(-self.re, -self.im)

    def __mul__(self, other: Any) -> Planar:
        other = planar(other)
        return Planar(_product(self.re, other.re) - _product(self.im, other.im),
                      _product(self.re, other.im) + _product(self.im, other.re))

    def __truediv__(self, other: Any) -> Planar:
        other = planar(other)
        if _is_zero(other.im):
            return Planar(self.re / other.re, 0.0 if _is_zero(self.im) else self.im / other.re)
        square = other.re * other.re + other.im * other.im
        product = self * other.conj()
        return Planar(product.re / square, product.im / square)

    def __pow__(self, power: int) -> Planar:
        assert power == 2
        return self * self

    def __rtruediv__(self, other: Any) -> Planar:
        return planar(other) / self

    __radd__, __rmul__ = __add__, __mul__


def _is_zero(number: Any) -> bool:
    return not isinstance(number, Symbol) and number == 0


def _product(one: Any, two: Any) -> Any:
    return 0.0 if _is_zero(one) or _is_zero(two) else one * two


def planar(number: Any) -> Planar:
    """Convert a number, or a pair of coordinates, to `Planar`."""
    if isinstance(number, Planar):
        return number
    return Planar(*number) if isinstance(number, tuple) else Planar(float(number.real), float(number.imag))


NEWTON_STEPS = 6  # of Newton: enough for pins that are dragged by a tenth of the linkage
KNOT_SPANS = 180  # between the knots of a state


class _OnPaper(Linkage):
    """The linkage in mm; each drive has its number as its pace, so that what it drives tells which one it was."""

    reach = 1.0

    def __init__(self, scene: Scene):
        super().__init__(scene, tuple(float(k + 1) for k in range(len(scene.drives))))
        places = self.places.values()
        self.origins[FRAME] = complex(min(z.real for z in places) - 7.0, min(z.imag for z in places) - 5.0)  # no pin


class Knots(NamedTuple):
    """States of the undragged linkage from one travel of its first drive to another (radians, or mm).

    Each of the `states` is told in equal steps of arccos(1 - 2 p), where p is the part of the travel that is done: near
    a limit, where states change with the root of the travel, the knots are as much denser.
    """

    low: float
    high: float
    states: tuple[tuple[float, ...], ...]

    def states_at(self, travel: float) -> list[float]:
        """The states at a travel, straight between the knots."""
        fraction = min(max((travel - self.low) / (self.high - self.low), 0.0), 1.0)
        far = math.acos(1.0 - 2.0 * fraction) / math.pi * KNOT_SPANS
        k = min(int(far), KNOT_SPANS - 1)
        return [row[k] + (far - k) * (row[k + 1] - row[k]) for row in self.states]


class WrittenRelations(NamedTuple):
    """Relations in a language: terms by name, each after those it reads; x and y of points in mm, cosine and sine of
    the turns of links, and directions of guides."""

    terms: tuple[tuple[str, str], ...]
    points: Mapping[str, tuple[str, str]]
    turns: Mapping[str, tuple[str, str]]
    guides: Mapping[str, tuple[str, str]]


def relations(scene: Scene, view: View) -> Relations | None:
    """The relations of a scene on paper; None if it cannot be followed: then its points only stay in their pose."""
    if not scene.links:
        return None
    try:
        scene_relations = Relations(scene, view)
        if scene.drives:
            _ = scene_relations.motion
    except GraphplanError:
        return None
    return scene_relations


class Relations:
    """The relations of a scene on paper.

    `free` are the pins that may be dragged; `points` and `turns` (of links, as cosine and sine) and `guides` (of slides
    on moving links) are pairs of places of the tape, or of numbers. `angles` tells which states are angles.
    """

    def __init__(self, scene: Scene, view: View):
        self.scene, self.view = pin_given_motions(scene), view
        places = {name: view((float(x), float(y))) for name, (x, y) in scene.points.items()}
        self.domain = Symbols()
        self.tape = self.domain.tape
        self._on_paper = _OnPaper(self.scene.with_pose(places, lambda one: one.direction,
                                                       lambda length: view.scale * float(length)))
        self.places, self.angles = self._on_paper.places, list[bool]()
        self._ground = Ground(self.domain, self.scene, view, self.places)
        self.free = self._ground.free
        self.placed: dict[str, Any] = {FRAME: self._ground}
        self._turned: dict[str, Any] = {}  # in all, where that is counted
        self.groups = [ClosureGroup(self._on_paper, links) for links in self._on_paper.parts]
        for group in self.groups:
            self.placed.update(self._place_group(group))

    # ---- the links -------------------------------------------------------------------------------------------------

    def _place_group(self, group: ClosureGroup) -> Iterator[tuple[str, Any]]:
        """The links of a group, driven, crossed or closed."""
        counted = group.layout.counted  # the compass rules do not know how far links have turned in all
        links = assemble_dyad(self._on_paper, group, self.placed) if group.unknowns and not counted else None
        if links and not self._on_paper.is_special(group.part):
            self.angles += [i < group.layout.angles for i in range(group.unknowns)]
            yield from zip(group.part, links[0], strict=True)
            return
        carriers = [self._body(link) for link in (FRAME, *group.carriers)]
        arms, drives = self._arms(group), self._drives(group)
        if not group.unknowns:
            lies = closure.pose_links(group.layout, carriers, arms, drives, (), moving=False)
        else:
            lies = self._close_group(group, carriers, arms, drives)
        for link, body in zip(group.links, lies[len(carriers):], strict=True):
            base, self._turned[link] = planar(body.base) + self._on_paper.origins[FRAME], body.angle
            yield link, PlacedLink(self._on_paper.origins[link], base, planar(body.turn or (1.0, 0.0)))

    def _body(self, link: str) -> LinkPose:
        """A link that is placed, as the closure has it."""
        if link == FRAME:
            return LinkPose()
        placed_link = self.placed[link]
        base = placed_link.point(self._on_paper.origins[link]) - self._on_paper.origins[FRAME]
        return LinkPose((base.re, base.im), (placed_link.turn.re, placed_link.turn.im),
                        angle=self._turned.get(link, 0.0))

    def _arms(self, group: ClosureGroup) -> list[Spot]:
        """The arms of a group: those of the frame end in pins."""
        arms, frame = list[Spot](group.arms), self._on_paper.origins[FRAME]
        for k, end in enumerate(group.ends):
            if end.link == FRAME and not end.is_direction:
                spot = self._ground.point(complex(*group.arms[k]) + frame) - frame
                arms[k] = spot.re, spot.im
        return arms

    def _drives(self, group: ClosureGroup) -> list[DriveState]:
        """The drives of a group where their inputs have them."""
        return [self._drive(turns, rate, group.layout.counted) for turns, rate in group.drives]

    def _drive(self, turns: bool, rate: float, counted: bool) -> DriveState:
        """State of a drive; the size of its rate is its number, the sign its sense."""
        k = round(abs(rate)) - 1
        at = [self.tape.input(f"shift {k}")] if counted or not turns else []
        shift = [far if rate > 0 else -far for far in at]
        if not turns:
            return DriveState(shift[0], None)
        cos, sin = self.tape.input(f"cos {k}"), self.tape.input(f"sin {k}")
        return DriveState((cos, sin if rate > 0 else -sin, *shift), None)

    def _close_group(self, group: ClosureGroup, carriers: list[LinkPose], arms: Sequence[Spot],
                     drives: Sequence[DriveState]) -> list[LinkPose]:
        """A group by Newton's steps, on its branch."""
        layout, first, state = group.layout, len(self.angles), list[Any]()
        self.angles += [i < layout.angles for i in range(group.unknowns)]
        for i, angle in enumerate(self.angles[first:], first):
            kinds = ("cos ", "sin ", *([""] if layout.counted else ())) if angle else ("",)
            numbers = [self.tape.input(f"{prefix}state {i}") for prefix in kinds]
            state.append(tuple(numbers) if angle else numbers[0])
        for _ in range(NEWTON_STEPS):
            links = closure.pose_links(layout, carriers, arms, drives, state)
            step = closure.step(closure.residual_rows(layout, links, arms, drives), layout.unknowns, _root)
            state = closure.apply_corrections(layout, state, step.corrections)
        reach = super(_OnPaper, self._on_paper).reach
        far = [move if i < layout.angles else move / reach for i, move in enumerate(step.corrections)]
        sure = 0.0 * self.tape.sqrt(self.tape.place(RELATION_TOL**2 - sum(move * move for move in far)))
        sure = sure + 0.0 * self.tape.sqrt(self.tape.place(step.determinant * self._sense(group)))
        state = [(unknown[0] + sure, *unknown[1:]) if isinstance(unknown, tuple) else unknown + sure
                 for unknown in state]
        return closure.pose_links(layout, carriers, arms, drives, state, moving=False)

    def _sense(self, group: ClosureGroup) -> float:
        """The sign of the determinant in the given pose."""
        still = [LinkPose((z.real, z.imag)) for z in (self._on_paper.origins[link] - self._on_paper.origins[FRAME]
                                                      for link in (FRAME, *group.carriers))]
        drives = [DriveState((1.0, 0.0) if turns else 0.0, None) for turns, _ in group.drives]
        state = [(1.0, 0.0) if i < group.layout.angles else 0.0 for i in range(group.unknowns)]
        links = closure.pose_links(group.layout, still, group.arms, drives, state)
        open = closure.residual_rows(group.layout, links, group.arms, drives)
        return math.copysign(1.0, closure.step(open, group.unknowns, math.sqrt).determinant)

    # ---- what is made of them --------------------------------------------------------------------------------------

    @property
    def points(self) -> dict[str, Spot]:
        """Places of all points."""
        points = {}
        order = self._on_paper.order
        for name, place in self.places.items():
            links = self.scene.links_of[name]
            if not links and name not in self._ground.pins:
                continue
            carrier = min(links, key=order.__getitem__) if links else FRAME
            at = self._ground.pins[name] if carrier == FRAME else self.placed[carrier].point(place)
            points[name] = at.re, at.im
        points |= {name: points[at] for name, at in points_under_slides(self.scene).items()}
        return points | {at: self._touching(contact, points)
                         for at, contact in travelling_contacts(self.scene).items()}

    def _touching(self, contact: Contact, points: Mapping[str, Spot]) -> Spot:
        """Contact point of two profiles."""
        on = self.placed[contact.curved_side[1]]
        turn = planar(1.0) if contact.curved_side[1] == FRAME else on.turn
        at = contact_point(self._on_paper.scene, contact, {name: planar(spot) for name, spot in points.items()}, turn)
        return at.re, at.im

    @property
    def turns(self) -> dict[str, Spot]:
        """Turn of every moving link, as cosine and sine."""
        return {link: (placed_link.turn.re, placed_link.turn.im) for link, placed_link in self.placed.items()
                if link != FRAME}

    @property
    def guides(self) -> dict[str, Spot]:
        """Directions of the guides on moving links."""
        rays = {}
        for slide in self.scene.slides:
            if slide.through is None and slide.along != FRAME:
                ray = self.placed[slide.along].ray(complex(*map(float, slide.direction)))
                rays[slide.name] = ray.re, ray.im
        return rays

    # ---- how far they lead -----------------------------------------------------------------------------------------

    @cached_property
    def motion(self) -> RangeOfMotion:
        """Range of the undragged linkage: one turn, or between its limits."""
        return range_of_motion(self.scene)

    @property
    def limits(self) -> tuple[float, float]:
        """From where to where the first drive travels in its sense, in radians or mm."""
        low, high = self.motion.ends
        return low * self._travel_unit, high * self._travel_unit

    @property
    def _travel_unit(self) -> float:
        """Unit of the first drive's travel, in radians or mm."""
        return self.view.scale if self.scene.drives[0].slides else 1.0

    @property
    def slide_ranges(self) -> dict[str, Spot]:
        """Range of slides on the frame along their guides, in mm, if the scene has drives."""
        if not self.scene.drives:
            return {}
        ranges, points = {}, self.motion.turn(np.linspace(*self.motion.ends, KNOT_SPANS)).points
        for slide in self.scene.slides:
            if slide.along == FRAME:
                ray = complex(*map(float, slide.direction))
                off = points[slide.at] - complex(*map(float, self.scene.points[slide.at]))
                far = self.view.scale * (off * ray.conjugate() / abs(ray)).real
                ranges[slide.name] = float(np.nanmin(far)), float(np.nanmax(far))
        return ranges

    @cached_property
    def knots(self) -> Knots | None:
        """States along the way; None if the compass rules suffice, or the scene has no drive."""
        if not self.scene.drives or not any("state" in name for name in self.used_inputs):
            return None
        path, (low, high), unit = self.motion.path, self.limits, self._travel_unit
        if low == high:
            return None
        long = self.motion.linkage.reach * self.view.scale
        travel = low + (high - low) * (1 - np.cos(np.linspace(0.0, np.pi, KNOT_SPANS + 1))) / 2
        states, _ = path.predict_states(travel / unit)
        return Knots(low, high, tuple(tuple((row * (1.0 if angle else long)).tolist())
                                      for row, angle in zip(states, self.angles, strict=True)))

    @cached_property
    def used_inputs(self) -> dict[str, int]:
        """The inputs that are read, by name, each with its place on the tape."""
        outputs = [self.tape.place(number) for spots in (self.points, self.turns, self.guides)
                   for spot in spots.values() for number in spot]
        return {self.tape.entries[place][1]: place for place in self.tape.needed_places(outputs)
                if self.tape.entries[place][0] == "in"}

    def write_fixed_pins(self, language: Language, inputs: Mapping[str, str]) -> dict[str, tuple[str, str]]:
        """Pins of the frame that are not free, x and y in mm, in a language; `inputs` are those of the free ones."""
        places = self._tape_places({name: (pin.re, pin.im) for name, pin in self._ground.pins.items()
                                    if name not in self.free})
        writer = Writer(self.tape, language, {self.tape.input(name).place: text for name, text in inputs.items()}, "")
        _ = [*writer.terms([place for pair in places.values() for place in pair])]
        return {name: (writer.text[x], writer.text[y]) for name, (x, y) in places.items()}

    def write(self, language: Language, inputs: Mapping[str, str], prefix: str,
              deepest: float = MAX_NESTING) -> WrittenRelations:
        """All of it in a language; `inputs` says how the inputs that are `asked` are called there."""
        outputs = [self._tape_places(spots) for spots in (self.points, self.turns, self.guides)]
        writer = Writer(self.tape, language, {place: inputs[name] for name, place in self.used_inputs.items()}, prefix,
                        deepest)
        terms = tuple(writer.terms([place for places in outputs for spot in places.values() for place in spot]))
        return WrittenRelations(terms, *({name: (writer.text[x], writer.text[y]) for name, (x, y) in places.items()}
                                         for places in outputs))

    def inputs(self, pins: Mapping[str, Spot], shifts: Sequence[float]) -> dict[str, float]:
        """The inputs where some pins (mm) are elsewhere, and how far the drives have gone (radians, or mm)
        counter-clockwise or along their directions."""
        inputs: dict[str, float] = {}
        for name in self.free:
            at = self.places[name]
            inputs[f"x {name}"], inputs[f"y {name}"] = pins.get(name, (at.real, at.imag))
        for k, shift in enumerate(shifts):
            inputs |= {f"cos {k}": math.cos(shift), f"sin {k}": math.sin(shift), f"shift {k}": shift}
        travel = sense_of_travel(self.scene) * shifts[0] if shifts else 0.0
        states = self.knots.states_at(travel) if self.knots else [0.0] * len(self.angles)
        for i, state in enumerate(states):
            inputs |= {f"cos state {i}": math.cos(state), f"sin state {i}": math.sin(state), f"state {i}": state}
        return inputs

    def pose(self, pins: Mapping[str, Spot], shifts: Sequence[float]) -> tuple[dict[str, Spot], ...] | None:
        """Places of all points on paper, and directions of guides on links, for other places of some pins and of the
        drives; None if there is no such pose."""
        numbers = self.inputs(pins, shifts)
        try:
            posed: tuple[dict[str, Spot], ...] | None = self._run(*[numbers[name] for name in self.used_inputs])
        except (ValueError, ZeroDivisionError, OverflowError):
            return None
        return posed

    @cached_property
    def _run(self) -> Callable[..., Any]:
        """A function from the inputs to points and guides."""
        return function(self.tape, [*self.used_inputs.values()], (self._tape_places(self.points),
                                                                  self._tape_places(self.guides)))

    def _tape_places(self, spots: Mapping[str, Spot]) -> dict[str, Any]:
        """The places of pairs of numbers on the tape."""
        return {name: tuple(map(self.tape.place, spot)) for name, spot in spots.items()}


def _root(number: Any) -> Any:
    """The square root of a symbol, or of a number: the factors of gears are such."""
    return number.root() if isinstance(number, Symbol) else math.sqrt(number)
