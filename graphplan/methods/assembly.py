"""The mechanism assembled in other poses: its points by compasses, its numbers in many poses at once.

A dyad is placed on what is placed already by what its three pairs say (Ozols 1974, section 5-2: the method of arcs):
two arcs; an arc and the line of a guide; a guide that passes a point; two guides. Which way a point lies along a guide
is read from the given pose: it can only change at a limit. Of larger groups a joint is located first, by loci.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterator, MutableMapping
from itertools import combinations

from graphplan.errors import by_name
from graphplan.kernel.elementary import cross, dot
from graphplan.kernel.images import Attitude as Lies
from graphplan.kernel.images import Closure, PlacedGuide, PlacedPin, sides
from graphplan.kernel.images import Hinge as Joined
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.mechanism.model import FRAME, Assembly, Extreme, Pair, Scene, Slide
from graphplan.mechanism.numbers import minus
from graphplan.mechanism.order import ordered_points
from graphplan.mechanism.pairs.pair import LinkAttitude
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.replaced import RollingGuide, rolling_guides
from graphplan.mechanism.structure import structure
from graphplan.mechanism.travel import undone
from graphplan.methods.motion.network import BodyPoint, Network
from graphplan.methods.motion.stages import pitch_point, pitch_point_text
from graphplan.methods.panels import MECHANISM
from graphplan.methods.placing import Body, Placing, figure, runs_along
from graphplan.phrases import digits, said


class Pose:
    """Marks for the points of a scene; guides and letters on demand.

    Points that lie where another one does, in one link or under a sliding point, share its mark.
    `standing` are the points that have nothing to do with how the mechanism moves: auxiliary points and poles of its
    motion are among `points` alone.
    """

    def __init__(self, board: Board, net: Network, panel: Panel = MECHANISM):
        self.board, self.scene, self.order = board, net.scene, net.order
        scene, shared = net.scene, net.shared_marks
        self.assembled = Assembler(board, scene, scene.assembly) if scene.assembly else None
        with board.on(panel):
            self._rolling = rolling_guides(scene)
            constructed = {guide.at: guide for guide in self._rolling if guide.base}
            apart = {name: scene.points[name] for name in net.order.points() if name not in {*shared, *constructed}}
            self.standing: dict[str, Mark] = {
                name: self.assembled.mark(name) if self.assembled else board.given(x=x, y=y, name=name)
                for name, (x, y) in apart.items()}
        self.standing |= {name: self.standing[twin] for name, twin in shared.items()}
        self.points: MutableMapping[str, Mark] = ChainMap({}, self.standing)
        self.guides: dict[Slide, Mark] = {}
        for name, guide in constructed.items():
            self.standing[name] = self._pitch_point(guide)
        self._letters = {body: letter for body, (letter, _) in net.auxiliary.items()}
        self._free = [c for c in "QRSTUVWXYZHIJ" if c not in scene.points and c not in scene.sheet.auxiliary]

    def guide(self, slide: Slide, *, run: bool = False) -> Mark:
        """The guide of a sliding pair, through the pair; with `run` it runs as its direction does.

        One that leans, where there is friction.
        """
        if slide in self.guides:
            return self.guides[slide]
        if isinstance(slide, RollingGuide):
            return self._line_of_centres(slide)
        with self.board.on(MECHANISM, slide.given_links):
            if self.assembled:
                return self.assembled.guide(slide)
            if slide.through is None:
                return self.board.guide(self.points[slide.at], dx=slide.direction[0], dy=slide.direction[1])
            first, second = (self.points[name] for name in slide.through)
            along = (self.board.line if run else self.board.side)(first, second)
            return self.board.parallel(along, self.points[slide.at])

    def side(self, one: str, other: str) -> Mark:
        """The line through two points, whichever way it runs: a pitch point lies on its line of centres."""
        through = next((guide.through for guide in self._rolling if guide.through
                        and {one, other} <= {guide.at, *guide.through}), (one, other))
        return self.board.side(*(self.points[name] for name in through))

    def _line_of_centres(self, guide: RollingGuide) -> Mark:
        """The line through the centres of two wheels, or perpendicular to the pitch line of a rack through that of its
        gear.
        """
        if guide.through:
            return self.side(*guide.through)
        assert guide.rail is not None
        return self.board.perpendicular(self.guide(guide.rail, run=True), self.points[guide.rail.at])

    def _pitch_point(self, guide: RollingGuide) -> Mark:
        """The pitch point, drawn from the centres."""
        with self.board.on(MECHANISM, guide.given_links, pitch_point(guide)):
            B = self.standing[guide.base]
            if guide.through is None:
                return self.board.lay_along(self._line_of_centres(guide), B, length=guide.length, name=guide.at)
            C, why = self.standing[guide.other_centre], pitch_point_text(guide)
            return self.board.step_off(B, C, B, ratio=guide.ratio, name=guide.at, why=why)

    def letter_of_point(self, point: str) -> str:
        """The letter of a point, auxiliary points and poles among them."""
        return point if point in self.scene.points or point not in self.points else self.points[point].step.name

    def letter(self, body: str) -> str:
        """The letter of a body's auxiliary point: the sheet's, or Q, R, S, ... in the order of asking."""
        if body not in self._letters:
            self._letters[body] = self._free.pop(0) if self._free else f"Q_{len(self._letters) + 1}"
        return self._letters[body]

    def far_from(self, place: BodyPoint) -> Mark:
        """Another point of a link of this place, to take the size of a trial from."""
        point, link = place
        at = self.scene.points.get(point)
        for name in ([link] if link else sorted(self.scene.links_of[point], key=self.order.link)):
            for name_of_end in sorted(self.scene.links[name], key=self.order.point):
                if self.scene.points[name_of_end] != at:
                    return self.points[name_of_end]
        return next(mark for name, mark in self.standing.items() if self.scene.points.get(name, at) != at)


Hinge = str | Slide  # a joint by its point, or a slide
CLOSING = {2: "close_on_two", 3: "close_on_three", 4: "close_on_four"}  # verbs, by how many joints they read


class Assembler(Placing):
    """Draws a scene's points from its fixed ones and the lengths of its links."""

    def __init__(self, board: Board, scene: Scene, assembly: Assembly):
        super().__init__(board, scene, assembly)
        self.located: set[str] = set()
        if assembly.extreme and assembly.extreme.coupler:
            self._in_line(assembly.extreme)
        waiting = [body for body in self.bodies.values() if not any(body is placed for placed in self.placed)]
        while waiting:
            found = self._place_next(waiting)
            waiting = [body for body in waiting if body not in found]
        for name in ordered_points(scene):
            if name in self.given.points and name not in self.assembly.riding:
                self.mark(name)

    # ---- groups ------------------------------------------------------------------------------------------------------

    def _place_next(self, waiting: list[Body]) -> list[Body]:
        """Place the next bodies that arcs and lines can place."""
        held = [(body, [*self._hinges(body, self.placed)]) for body in waiting]
        for body, hinges in held:
            if len(hinges) > 1:
                self._place_overheld(body, hinges)
                return self._place_bodies([body])
        single = [(body, hinges[0]) for body, hinges in held if len(hinges) == 1]
        for k, (one, outer) in enumerate(single):
            for two, other in single[k + 1:]:
                inner = [*self._hinges(one, [two])]
                if len(inner) == 1:
                    self._dyad(one, outer, inner[0], two, other)
                    return self._place_bodies([one, two])
        return self._place_bodies(self._by_closing(waiting))

    def _place_bodies(self, bodies: list[Body]) -> list[Body]:
        self.placed += bodies
        return bodies

    def _by_closing(self, waiting: list[Body]) -> list[Body]:
        """Place the next group that arcs alone do not: one joint after the other, as all its lengths close."""
        part = next(part.links for part in structure(self.given).parts
                    if any({*part.links} & body.lies.keys() for body in waiting))
        bodies = [body for body in waiting if {*part} & body.lies.keys()]
        links = tuple(sorted((link for body in bodies for link in body.lies), key=by_name))
        outer = list(dict.fromkeys(h for body in bodies for h in self._hinges(body, self.placed)))
        joints = [h for h in outer if isinstance(h, str)]
        if len(joints) < len(outer) or len(joints) not in CLOSING:
            raise self._unknown(*links)
        group = self._closure(bodies, joints)
        if not group.square:
            raise self._unknown(*links)
        law = said("the lengths of all links of the group fit together: by trial, or where loci of a joint cross")
        with self.board.on(MECHANISM, links, self._stage(law, links)):
            read = [self.mark(joint) for joint in joints]
            freed = next((joint for joint in sorted(group.joints, key=lambda joint: (not sides(group, joint), joint))
                          if self._arcs_suffice({*joints, joint}, bodies)), None)
            for joint in group.joints if freed is None else (freed,):
                close = getattr(self.board, CLOSING[len(joints)])
                self.marks[joint] = close(*read, group=group, joint=joint, name=joint)
        self.located |= {freed} if freed else set()
        return [] if freed else bodies

    def _arcs_suffice(self, known: set[str], bodies: list[Body]) -> bool:
        """Whether arcs place some bodies, linked by joints alone, from these joints."""
        left = [{joint.at for joint in self.given.revolutes if {*joint.links} & body.lies.keys()} for body in bodies]
        while left:
            held = next((one for one in left if len(one & known) > 1), None)
            pairs = ((one, two) for one, two in combinations(left, 2)
                     if len(one & known) == len(two & known) == 1 and (one & two) - known)
            placed = [held] if held is not None else [*next(pairs, ())]
            if not placed:
                return False
            left = [one for one in left if not any(one is other for other in placed)]
            known = known.union(*placed)
        return True

    def _closure(self, bodies: list[Body], outer: list[str]) -> Closure:
        """The pairs of a group on its outer joints, and how it lies in this pose."""
        pairs: list[PlacedPin | Joined | PlacedGuide] = []
        place = {id(body): i for i, body in enumerate(bodies)}
        inner: dict[str, tuple[int, Pair]] = {}
        for body in bodies:
            pairs += [PlacedPin(place[id(body)], self._figure(body, joint), outer.index(joint))
                      for joint in self._hinges(body, self.placed) if isinstance(joint, str)]
        for i, one in enumerate(bodies):
            for two in bodies[i + 1:]:
                for pair in self._hinges(one, [two]):
                    if isinstance(pair, Slide):
                        u, v = (next(lies for link, lies in body.lies.items() if link in pair.links)
                                for body in (one, two))
                        here, there = ((lies.place_of(self.given.points[pair.at]), lies.turn_vector(pair.direction))
                                       for lies in (u, v))
                        pairs.append(PlacedGuide(i, *here, place[id(two)], *there))
                    elif pair not in outer:
                        pairs.append(Joined(i, at := self._figure(one, pair), place[id(two)], self._figure(two, pair)))
                        inner.setdefault(pair, (i, at))
        return Closure(", ".join(sorted((link for body in bodies for link in body.lies), key=by_name)), pairs,
                       [self._lies_now(body) for body in bodies], inner)

    def _lies_now(self, body: Body) -> Lies:
        """Position of a body in this pose, from two of its points that lie furthest apart."""
        own = [name for link in body.lies for name in self.given.links[link] if name not in self.assembly.riding]
        names = {name: complex(*map(float, self._figure(body, name))) for name in own}
        if len(names) < 2:
            raise self._unknown(*body.lies)
        P, Q = max(combinations(names, 2), key=lambda pair: abs(names[pair[0]] - names[pair[1]]))
        here = {name: complex(*map(float, self.scene.points[name])) for name in (P, Q)}
        turn = (here[Q] - here[P]) / (names[Q] - names[P])
        turn /= abs(turn)
        base = here[P] - turn * names[P]
        return Lies(base.real, base.imag, turn.real, turn.imag)

    def _hinges(self, body: Body, others: list[Body]) -> Iterator[Hinge]:
        """The joints and slides of a body with some others."""
        there = {link for other in others for link in other.lies} | ({FRAME} if self.ground in others else set())
        for pair in self.given.binding:
            if isinstance(pair, Revolute | Slide) and {*pair.links} & {*body.lies} and {*pair.links} & there:
                if isinstance(pair, Slide):
                    if pair in self.net.slides:
                        yield pair
                elif self.placed is others or pair.at not in self.marks:
                    yield pair.at
            elif self.placed is others and pair.at in self.located and {*pair.links} & {*body.lies}:
                yield pair.at

    def _place_overheld(self, body: Body, hinges: list[Hinge]) -> None:
        """A body that more pairs hold than place it: two joints do, or a joint and a guide."""
        joints, guides = [h for h in hinges if isinstance(h, str)], [h for h in hinges if isinstance(h, Slide)]
        for joint in joints:
            self.mark(joint)
        if len(joints) < 2 and guides:
            at = self._figure(body, joints[0]) if joints else self._figure(body, guides[0].at)
            body.heading = self._heads(guides[0], body), self._path(guides[0], body, at)

    def _dyad(self, one: Body, outer: Hinge, inner: Hinge, two: Body, other: Hinge) -> None:
        """Two bodies on what is placed, by their pairs there and with each other."""
        links = tuple(sorted((*one.lies, *two.lies), key=by_name))
        if isinstance(outer, Slide) and isinstance(other, str):
            one, outer, two, other = two, other, one, outer
        match outer, inner, other:
            case str(A), str(B), str(C):
                law = said("{1} lies on circles about {0} and {2}, whose radii are the lengths of the links", A, B, C)
            case str(A), str(B), _:
                law = said("{1} lies on the circle about {0}, and on the line along which it slides", A, B)
            case str(A), _, str(C):
                law = said("The guide through {0} passes {1} at the distance that the links give it", C, A)
            case _, str(B), _:
                law = said("{0} lies on two lines along which it slides", B)
            case _:
                law = said("All links turn alike: what slides along two guides lies where they meet")
        with self.board.on(MECHANISM, links, self._stage(law, links)):
            match outer, inner, other:
                case str(A), str(B), str(C):
                    arcs = self._arc(one, A, B), self._arc(two, C, B)
                    side = "left" if self._turns(A, B, C) > 0 else "right"
                    self.marks[B] = self.board.circles_meet(*arcs, side=side, name=B)
                case str(A), str(B), Slide():
                    self._draw_slide_line(two, other, B)
                    arc, ahead = self._arc(one, A, B), self._sense_along(A, B, other.direction)
                    self.marks[B] = self.board.line_meets_circle(self.lines[other.name], arc, way=ahead, name=B)
                case str(A), Slide(), str(C):
                    self._draw_shared_guide(one, A, inner, two, C)
                case Slide(), str(B), Slide():
                    self._draw_slide_line(one, outer, B)
                    self._draw_slide_line(two, other, B)
                    self.marks[B] = self.board.meet(self.lines[outer.name], self.lines[other.name], name=B)
                case str(A), Slide(), Slide():
                    self._place_equal_turning(one, A, inner, two, other)

    def _in_line(self, extreme: Extreme) -> None:
        """Place the crank, the coupler in one line with it, and the link that turns back there."""
        O, A, B = extreme.pivot, extreme.pin, extreme.joint
        coupler, swung = (self.bodies[self.net.body[link]] for link in (extreme.coupler, extreme.link))
        hold = next(h for h in self._hinges(swung, self.placed) if h not in (A, B))
        links = tuple(sorted((*coupler.lies, *swung.lies), key=by_name))
        law = said("Crank {0}{1} and coupler {1}{2} lie in one line: {2} is as far from {0} as both are long together"
                   if extreme.way == "outer" else
                   "Crank {0}{1} and coupler {1}{2} lie in one line: {2} is as far from {0} as their lengths differ",
                   O, A, B)
        if extreme.time_ratio is not None:
            law = said("{0}; the time ratio is {1}", law, digits(extreme.time_ratio, 5))
        with self.board.on(MECHANISM, links, self._stage(law, links)):
            if isinstance(hold, Slide):
                self._draw_slide_line(swung, hold, B)
                base = self.board.parallel(self.lines[hold.name], self.mark(O))
            else:
                base = self.board.line(self.mark(O), self.mark(hold))
            turns = self._arc(self.ground, O, A)
            reach = self._reach(base, turns, coupler, extreme)
            if isinstance(hold, Slide):
                way = self._sense_along(O, B, hold.direction, self.scene)
                self.marks[B] = self.board.line_meets_circle(self.lines[hold.name], reach, way=way, name=B)
            else:
                side = "left" if self._turns(O, B, hold) > 0 else "right"
                self.marks[B] = self.board.circles_meet(reach, self._arc(swung, hold, B), side=side, name=B)
            o, a, b = (self.scene.points[name] for name in (O, A, B))
            way = "on" if float(dot(minus(a, o), minus(b, o))) > 0 else "back"
            ray = self.board.line(self.mark(O), self.marks[B])
            self.marks[A] = self.board.line_meets_circle(ray, turns, way=way, name=A)
        self._place_bodies([coupler, swung])

    def _reach(self, base: Mark, turns: Mark, coupler: Body, extreme: Extreme) -> Mark:
        """The circle about the pivot on which the joint lies: the coupler is set off from the crank on a line."""
        O, A, B = extreme.pivot, extreme.pin, extreme.joint
        dx, dy = minus(self._figure(coupler, B), self._figure(coupler, A))
        E = self.board.line_meets_circle(base, turns, way="on")
        arc = self.board.circle(E, self.board.link_length(dx=dx, dy=dy, quantity=Quantity(f"{A}{B}", "length")))
        F = self.board.line_meets_circle(base, arc, way="on" if extreme.way == "outer" else "back")
        return self.board.circle(self.mark(O), self.board.opening(self.mark(O), F))

    def _arc(self, body: Body, centre: str, point: str) -> Mark:
        """The circle about a joint on which another point of its body lies."""
        dx, dy = minus(self._figure(body, point), self._figure(body, centre))
        length = Quantity(f"{centre}{point}", "length")
        return self.board.circle(self.mark(centre), self.board.link_length(dx=dx, dy=dy, quantity=length))

    def _draw_slide_line(self, body: Body, slide: Slide, point: str) -> None:
        """Draw the line along which a point of a body slides, which turns with that."""
        line = self._path(slide, body, self._figure(body, point))
        self.lines[slide.name], body.heading = line, (self._heads(slide, body), line)

    def _draw_shared_guide(self, one: Body, A: str, slide: Slide, two: Body, C: str) -> None:
        """Draw the guide of two bodies that turn about known points."""
        places = [undone(next(lies for link, lies in body.lies.items() if link in slide.links),
                         self._figure(body, point)) for body, point in ((one, A), (two, C))]
        v, u = minus(places[1], places[0]), slide.direction
        way = "on" if float(dot(u, minus(self.given.points[C], self.given.points[A]))) >= 0 else "back"
        if runs_along(v, u):
            ends = (A, C) if way == "on" else (C, A)
            line = self.board.line(*map(self.mark, ends))
        else:
            line = self.board.sight(self.mark(A), self.mark(C), **figure(v, u), way=way)
        self.lines[slide.name] = line
        one.heading, two.heading = (self._heads(slide, one), line), (self._heads(slide, two), line)

    def _place_equal_turning(self, one: Body, A: str, inner: Slide, two: Body, outer: Slide) -> None:
        """Place two bodies that turn as what is placed does: a point of the second lies on two lines."""
        own = [name for link in two.lies for name in self.given.links[link] if name not in self.assembly.riding]
        at = self._figure(two, inner.at if inner.at in own else own[0])
        line = self._path(outer, two, at)
        two.heading = self._heads(outer, two), line
        within = next(lies for link, lies in two.lies.items() if link in inner.links)
        turned = undone(LinkAttitude(0, 0, within.cos, within.sin), two.heading[0])
        one.heading = next(lies for link, lies in one.lies.items() if link in inner.links).turn_vector(turned), line
        self.mark(A)
        crossing = self.board.meet(line, self._path(inner, two, at))
        two.spots.append((at, crossing))

    # ---- the given pose ----------------------------------------------------------------------------------------------

    def _turns(self, A: str, B: str, C: str) -> float:
        """Whether B lies left of the ray from A to C in this pose: positive, or negative where it is right."""
        a, b, c = (self.scene.points[name] for name in (A, B, C))
        return float(cross(minus(c, a), minus(b, a)))

    def _sense_along(self, A: str, B: str, u: Pair, scene: Scene | None = None) -> str:
        """Sense of B from A along a direction, in the given pose or another."""
        a, b = ((scene or self.given).points[name] for name in (A, B))
        return "on" if float(dot(u, minus(b, a))) > 0 else "back"
