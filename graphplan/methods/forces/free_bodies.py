"""What acts on a part of a group: its links' loads in one chain, what solved groups pass on, what is found by now.

R_12 is the force of link 1 on link 2, and 0 is the frame.

A balancing moment is forces times arms, M = R h, with each arm h drawn on the mechanism plan: the perpendicular from
the centre of the turning link on the line of action of a force; forces through the centre have none (Ozols 1974, 10-2).
The moment is read from the forces where they act, so that it stands in poses, too, in which one of them vanishes and
shows no line.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from math import dist
from typing import Any, NamedTuple

from graphplan.errors import ConstructionError
from graphplan.kernel.elementary import cross, vector
from graphplan.kernel.program import Board, Mark
from graphplan.kernel.stages import Knowledge as Told
from graphplan.kernel.stages import Teller, Vector
from graphplan.mechanism.model import FRAME, Balance, Gear, Scene, Slide
from graphplan.methods.assembly import Pose
from graphplan.methods.forces.loading import Acting, Loading
from graphplan.methods.forces.stages import joint, known_forces, line_of_action
from graphplan.methods.forces.unknown_forces import ForceGroup, Part, UnknownForce, has_line
from graphplan.methods.motion.stages import beginning_stage
from graphplan.methods.panels import MECHANISM, ForcePlan, JointForce, balance_letter, pair_letter
from graphplan.methods.tolerances import DIRECTION_SHARE
from graphplan.phrases import said

Span = tuple[Mark, Mark]
Pair = tuple[Acting, Acting]
ROMAN = {"C": 100, "XC": 90, "L": 50, "XL": 40, "X": 10, "IX": 9, "V": 5, "IV": 4, "I": 1}
Values = Callable[[Sequence[Mark]], list[Any]]


class CentreMoment(NamedTuple):
    """A balancing moment about the centre of a link: that of these forces, which oppose those on the link.

    `couples` names those that stand perpendicular to the way from the centre, so that this is their arm; `stage` tells
    the moment.
    """

    link: str
    centre: Mark
    forces: tuple[Acting, ...]
    couples: Collection[str]
    stage: Teller

    def arms(self, board: Board, values: Values, letter: str, shortest: float) -> Iterator[tuple[str, Acting, Mark]]:
        """The forces that show a direction and have an arm, each with the letter of its arm and where that ends."""
        try:
            spots = values([mark for force in self.forces for mark in (force.tail, force.head, force.at, self.centre)])
        except ConstructionError:  # whoever reads the numbers is told
            return
        ends = list(zip(self.forces, *(spots[place::4] for place in range(4)), strict=True))
        least = max([shortest, *(DIRECTION_SHARE * dist(tail, head) for _, tail, head, *_ in ends)])
        directed = [force for force, tail, head, at, centre in ends if (size := dist(tail, head)) > least
                    and abs(cross(vector(tail, head), vector(centre, at))) > shortest * size]
        for number, force in enumerate(directed, 1):
            own = f"{letter}_{number}" if len(directed) > 1 else letter
            yield own, force, force.at if force.name in self.couples else self._foot(board, own, force)

    def _foot(self, board: Board, letter: str, force: Acting) -> Mark:
        """The mark where the line of action of a force is nearest to the centre."""
        with board.on(MECHANISM, (self.link,), self.stage):
            line = board.parallel(board.side(force.tail, force.head), force.at)
            return board.foot(line, self.centre, why=said("the arm {0} of {1}", letter, force.name))


def roman(number: int) -> str:
    """The numeral of a polygon's corner: figures are those of links and steps."""
    numeral = ""
    for sign, value in ROMAN.items():
        numeral += number // value * sign
        number %= value
    return numeral


def with_sign(span: Span, sign: int) -> Span:
    """A force as (tail, head), or its answer."""
    return span if sign > 0 else (span[1], span[0])


def signed_pair(pair: Pair, sign: int) -> Pair:
    """A couple as a pair of forces, or its answer."""
    return pair if sign > 0 else (pair[0].answer, pair[1].answer)


class KnownForce(NamedTuple):
    """Drawn marks of a force: `part`, the component across its line if there is one, as (tail, head); its line of
    action through the mark `at`; and `pair`, the known couple besides. A couple has no line."""

    part: Span | None
    line: Mark | None
    at: Mark | None
    pair: Pair | None = None

    @property
    def acting(self) -> Mark:
        """Line of action of the force."""
        assert self.line is not None
        return self.line


class Shown(NamedTuple):
    """A force that is drawn as an arrow: load, reaction, balance, part (of a reaction); or an arm. With its letter.

    It is drawn where its head is needed; or, if it only repeats another force, where the head `of` that one is.
    """

    kind: str
    label: str
    tail: Mark
    head: Mark
    of: Mark | None = None


def draw_load(board: Board, force: Acting) -> Shown:
    """A load drawn where it acts, on the mechanism plan."""
    with board.on(MECHANISM):
        why = said("{0}, where it acts", force.name)
        head = board.transfer(force.tail, force.head, force.at, why=why)
        return Shown("load", force.name, force.at, head, force.head)


class DrawnForces:
    """Reactions drawn so far, of all groups: for each joint and link, each slide, each balance; and all arrows.

    `number` is that of the round of friction, 0 without; `before` are the forces of the round before.
    """

    def __init__(self, scene: Scene, before: DrawnForces | None = None) -> None:
        self.scene = scene
        self.shown: list[Shown] = []
        self.corners: int = before.corners if before else 0
        self.number: int = before.number + 1 if before else 0
        self.joints: dict[tuple[str, str], Span] = {}
        self.slides: dict[Slide, Span] = {}
        self.pairs: dict[Slide, Pair | None] = {}
        self.seats: dict[Slide, Mark] = {}
        self.teeth: dict[Gear, Span] = {}
        self.strands: dict[str, Span] = {}
        self.edges: dict[str, Mark] = {}
        self.balances: dict[Balance, Span] = {}
        self.moments: dict[Balance, Pair | None] = {}
        self.about_centres: dict[Balance, CentreMoment] = {}

    def replace_by_whole(self, span: Span, whole: Span) -> None:
        """A reaction that is part of a larger one is drawn as such, and the whole in its place."""
        for place, one in enumerate(self.shown):
            ahead = one.tail is span[0] and one.head is span[1]
            if one.kind == "reaction" and (ahead or (one.tail is span[1] and one.head is span[0])):
                self.shown[place] = one._replace(kind="part", label="T" + one.label[1:])
                self.shown.append(Shown("reaction", one.label, *with_sign(whole, 1 if ahead else -1)))
                return


def reaction_on(forces: DrawnForces, board: Board, point: str, link: str) -> Span:
    """The force on a link, the frame among them, at a joint."""
    if (point, link) in forces.joints:
        return forces.joints[point, link]
    spans = [forces.joints[point, other][::-1] for other in forces.scene.links_of[point] if other != link]
    first, mark = spans[0]
    with board.on(stage=joint(point)):
        for tail, head in spans[1:]:
            mark = board.transfer(tail, head, mark)
    return first, mark


def reaction_letter(scene: Scene, point: str, link: str) -> str:
    """The letter of the force on a link at a joint: from the other link there, or from the pin of several."""
    pin, *others = scene.links_of[point]
    return pair_letter(others[0] if link == pin and len(others) == 1 else pin if link != pin else point, link)


class FreeBodies:
    """The known forces of one group, drawn on a panel of its own."""

    def __init__(self, board: Board, pose: Pose, group: ForceGroup, loading: Loading, forces: DrawnForces):
        self.board, self.pose, self.group, self.loading, self.forces = board, pose, group, loading, forces
        self.panel = ForcePlan.of_links(group.links, forces.number)
        self.known: dict[UnknownForce, KnownForce] = {}
        self.ends: dict[UnknownForce, Span] = {}
        self.pairs: dict[UnknownForce, Pair | None] = {}
        self.seats: dict[UnknownForce, Mark] = {}
        self.chains: dict[str, list[Acting]] = {}
        self.couples: dict[str, list[Pair]] = {}
        with board.on(self.panel, group.links, beginning_stage(roman(forces.corners + 1), self.panel.words)):
            self.origin = self.number_corner(board.begin(plan=self.panel))
            self._chain()
        for site in (balance for balance in loading.loads.balances if balance.at):
            if {*site.links} & {*group.links} and not group.done.intersection(site.links):
                with board.on(MECHANISM, group.links, line_of_action(self.letter(site))):
                    self.known[site] = KnownForce(None, self._line_of(site), pose.points[site.at])
        for slide in group.scene.slides:
            if has_line(slide) and not group.done.intersection(slide.links) and {*slide.links} & {*group.links}:
                with board.on(MECHANISM, group.links, line_of_action(self.letter(slide))):
                    line = board.perpendicular(pose.guide(slide), pose.points[slide.at])
                self.known[slide] = KnownForce(None, line, pose.points[slide.at])

    def _line_of(self, balance: Balance) -> Mark:
        """The line of a balancing force: between two moving links that of the guide that it drives, which leans for
        the slide's own force alone."""
        at, slides = self.pose.points[balance.at], self.group.scene.slides
        guide = next((slide for slide in slides if {*slide.links} == {*balance.links}), None)
        if balance.on != FRAME and guide is not None:
            return self.board.parallel(self.loading.pose.guide(guide), at)
        assert balance.direction is not None
        return self.board.guide(at, dx=balance.direction[0], dy=balance.direction[1])

    def number_corner(self, mark: Mark) -> Mark:
        """Give a corner of the polygon the next numeral if it has no name."""
        if not mark.step.name:
            self.forces.corners += 1
            self.board.give_name(mark, roman(self.forces.corners))
        return mark

    # ---- loads -------------------------------------------------------------------------------------------------

    def _chain(self) -> None:
        """The known forces, link after link, head to tail; couples beside them."""
        corner = self.origin
        for link in self.group.links:
            with self.board.on(stage=known_forces(link)):
                self.chains[link] = own = self._in_chain(link, corner)
                corner = own[-1].head if own else corner
                couples = list(self.loading.couples(link, corner))
                self._apply(force for pair in couples for force in pair)
            self.couples[link] = couples + list(self._couples_of_slides(link))

    def _apply(self, loads: Iterable[Acting]) -> None:
        """Draw loads where they act; once, not again with friction."""
        if not self.forces.number:
            self.forces.shown += [draw_load(self.board, force) for force in loads]

    def _in_chain(self, link: str, corner: Mark) -> list[Acting]:
        """The forces on one link: its loads, and what solved groups pass on to it."""
        own = list(self.loading.forces(link, corner))
        self.forces.shown += [Shown("load", force.name, force.tail, force.head) for force in own]
        self._apply(own)
        for force in self._passed_to(link):
            tail = own[-1].head if own else corner
            own.append(Acting(force.at, tail, self.board.transfer(force.tail, force.head, tail), force.name))
            self.forces.shown.append(Shown("reaction", force.name, tail, own[-1].head))
        for force in own:
            self.number_corner(force.head)
        return own

    def _passed_to(self, link: str) -> Iterator[Acting]:
        """The reactions of solved groups on one link alone."""
        for point in self.group.points:
            if not self.group.remaining_links(point) and self.group.members(point) == (link,):
                yield from self.from_done(point)
        for slide in self._solved_slides(link):
            one, other = (slide.along, slide.link) if slide.link == link else (slide.link, slide.along)
            span = with_sign(self.forces.slides[slide], 1 if slide.link == link else -1)
            yield Acting(self.forces.seats[slide], *span, pair_letter(one, other))
        for balance, sign in self._solved_balances(link):
            if balance.at:
                yield Acting(self.pose.points[balance.at], *with_sign(self.forces.balances[balance], sign),
                             balance_letter(balance))

    def _couples_of_slides(self, link: str) -> Iterator[Pair]:
        """The couples of the slides that join a link to solved groups."""
        for slide in self._solved_slides(link):
            pair = self.forces.pairs[slide]
            if pair is not None:
                yield signed_pair(pair, 1 if slide.link == link else -1)
        for balance, sign in self._solved_balances(link):
            pair = None if balance.at else self.forces.moments[balance]
            if pair is not None:
                yield signed_pair(pair, sign)

    def _solved_balances(self, link: str) -> list[tuple[Balance, int]]:
        """The balances between a link and one of a solved group, each with the sign in which it acts on the link."""
        return [(balance, 1 if balance.link == link else -1) for balance in self.loading.loads.balances
                if link in balance.links and {*balance.links} & self.group.done]

    def _solved_slides(self, link: str) -> list[Slide]:
        """The slides that join a link to solved groups."""
        ends = {slide: {slide.link, slide.along} for slide in self.group.scene.slides}
        return [slide for slide, pair in ends.items() if link in pair and pair & self.group.done]

    def from_done(self, point: str) -> Iterator[Acting]:
        """Yield the reactions of the links of solved groups at a joint."""
        for link in self.group.scene.links_of[point]:
            if link in self.group.done:
                tail, head = self.forces.joints[point, link]
                name = reaction_letter(self.forces.scene, point, self.group.members(point)[0])
                yield Acting(self.pose.points[point], head, tail, name)

    # ---- a part of the group -----------------------------------------------------------------------------------

    def _solved_forces(self, part: Part) -> Iterator[tuple[UnknownForce, int]]:
        """The sites of a part's boundary whose forces are found, with their signs."""
        yield from ((site, sign) for site, sign in self.group.boundary(part) if site in self.ends or site in self.pairs)

    def _vectors(self, part: Part, but: Iterable[UnknownForce] = ()) -> Iterator[Acting]:
        """The known forces that act on a part beyond its links' chains."""
        for point in self.group.passed_on(part):
            if len(self.group.members(point)) > 1:
                yield from self.from_done(point)
        for site, sign in self._solved_forces(part):
            if site in self.ends and site not in but:
                yield Acting(self.seat(site), *with_sign(self.ends[site], sign), self.letter(site, sign))

    def seat(self, site: UnknownForce) -> Mark:
        """Point of application of an unknown force."""
        if site in self.seats:
            return self.seats[site]
        return self.pose.points[site.point if isinstance(site, JointForce) else site.at]

    def letter(self, site: UnknownForce, sign: int = 1, part: str = "") -> str:
        """The letter of a site's force: that of the force of one link on another, or of the balance; or of its part."""
        if isinstance(site, JointForce):
            name = reaction_letter(self.forces.scene, site.point, site.link)
        else:
            name = pair_letter(site.along, site.link) if isinstance(site, Slide) else balance_letter(site)
        return ("-" if sign < 0 else "") + (part + name[1:] if part else name)

    def polygon(self, part: Part, extra: Iterable[Acting] = (), but: Iterable[UnknownForce] = ()) -> Span:
        """The open polygon of a part's known forces: where it starts and where it ends."""
        spans = [(self.chains[link][0].tail, self.chains[link][-1].head) for link in self.group.links
                 if link in part and self.chains[link]]
        if not spans:
            corner = self._corner(part)
            spans = [(corner, corner)]
        start, end = spans[0]
        for tail, head in (*spans[1:], *((v.tail, v.head) for v in (*self._vectors(part, but), *extra))):
            if tail is end:
                end = head
            elif head is start:
                start = tail
            else:
                end = self.board.transfer(tail, head, end)
        return start, end

    def _corner(self, part: Part) -> Mark:
        """The corner of the chain at which the loads of an unloaded part would stand."""
        corner = self.origin
        for link in self.group.links:
            if link in part:
                break
            corner = self.chains[link][-1].head if self.chains[link] else corner
        return corner

    def acting(self, part: Part, facts: Iterable[tuple[UnknownForce, int]], but: UnknownForce) -> Iterator[Acting]:
        """Every known force on a part, with couples as pairs, and the known parts of forces with known lines."""
        for link in self.group.links:
            if link in part:
                yield from self.chains[link]
                for pair in self.couples[link]:
                    yield from pair
        yield from self._vectors(part, (but,))
        for site, sign in self._solved_forces(part):
            pair_of = self.pairs.get(site)
            if pair_of is not None and site != but:
                yield from signed_pair(pair_of, sign)
        told = [*facts, (but, self.sign(part, but))] if isinstance(but, Slide) else list(facts)
        yield from self.parts_of(told)
        for site, sign in told:
            known = self.known.get(site)
            if known is not None and known.pair is not None and site not in self.ends:
                yield from signed_pair(known.pair, sign)

    def vectors(self, part: Part) -> list[Vector]:
        """The known forces on a part, by their letters; that of a force on another link is reversed."""
        chains = [force.name for link in self.group.links if link in part for force in self.chains[link]]
        passed = [force.name for point in self.group.passed_on(part) if len(self.group.members(point)) > 1
                  for force in self.from_done(point)]
        solved = [self.letter(site, sign) for site, sign in self._solved_forces(part) if site in self.ends]
        parts = [self.letter(site, sign, "T") for site, sign in self.group.boundary(part) if site not in self.ends
                 and self._is_parted(site)]
        return [Vector(name) for name in (*chains, *passed, *solved, *parts) if name]

    def _is_parted(self, site: UnknownForce) -> bool:
        """Whether the part of a force across its line is known apart."""
        known = self.known.get(site)
        return known is not None and known.part is not None and known.line is not None

    def unknown(self, part: Part, site: UnknownForce) -> Vector:
        """The unknown force of a site on a part, by its letter; what is known of it across its line is apart."""
        known = self.known.get(site)
        free = isinstance(site, JointForce) and (known is None or known.line is None)
        told = Told.NOTHING if free else Told.DIRECTION
        return Vector(self.letter(site, self.sign(part, site), "N" if self._is_parted(site) else ""), told)

    def acts_at(self, site: UnknownForce, known: KnownForce) -> Mark:
        return known.at if known.at is not None else self.seat(site)

    def sign(self, part: Part, site: UnknownForce) -> int:
        return next(sign for other, sign in self.group.boundary(part) if other == site)

    def other_forces(self, part: Part, site: UnknownForce) -> list[tuple[UnknownForce, int]]:
        return [(other, sign) for other, sign in self.group.boundary(part) if other != site]

    def parts_of(self, sites: Iterable[tuple[UnknownForce, int]]) -> Iterator[Acting]:
        """The known parts of forces whose lines are known."""
        for site, sign in sites:
            known = self.known.get(site)
            if known is not None and known.part is not None and site not in self.ends:
                yield Acting(self.acts_at(site, known), *with_sign(known.part, sign))

    def idle(self) -> bool:
        """Whether the group is free of loads, so that all its reactions are zero."""
        return not any(self.chains[link] or self.couples[link] for link in self.group.links) and not any(
            {*balance.links} & {*self.group.links} for balance in self.loading.loads.balances) and not any(
            self._passes_load_on(point) for point in self.group.points)

    def _passes_load_on(self, point: str) -> bool:
        """Whether solved groups pass anything on at a joint between links of this one."""
        return not self.group.remaining_links(point) and len(self.group.members(point)) > 1 and any(
            force.tail is not force.head for force in self.from_done(point))
