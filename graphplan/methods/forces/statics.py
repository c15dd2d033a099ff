"""The force planner: finds in which order the reactions of a group are found, whatever the group.

The dual of the velocity planner. A part of the group is in equilibrium: moments about the point where all its unknown
forces but one pass tell one thing of that one (a *fact*: its component perpendicular to the way there); where two of
the unknown forces have known lines that point is an auxiliary point, as Q and R are for velocities. Two forces of known
lines close a force polygon; one alone closes it whatever its line. Where nothing goes on, a force is assumed twice and
found by false position.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

from graphplan.errors import Refused
from graphplan.mechanism.model import Balance, Slide
from graphplan.methods.forces.unknown_forces import FAR, ForceGroup, Position, Span, UnknownForce, equation, has_line
from graphplan.methods.motion.facts import Triple, cross, dot
from graphplan.methods.panels import JointForce

MAX_NESTED_TRIALS = 3  # trials within trials
MOST_FREE = 3  # forces of unknown lines on a part that tells anything
FORCES = (1, 0, 0), (0, 1, 0)
TURN = (0, 0, 1)
Part = frozenset[str]


class AtPoint(NamedTuple):
    """Moments about a point of the mechanism."""

    point: str


class AcrossSlide(NamedTuple):
    """No moments: forces across the direction in which a slide's reaction acts."""

    slide: Slide


class AcrossLine(NamedTuple):
    """No moments: forces across the known line of a site."""

    site: UnknownForce


class AtCrossing(NamedTuple):
    """Moments about the auxiliary point where the known lines of two sites meet."""

    one: UnknownForce
    two: UnknownForce


About = AtPoint | AcrossSlide | AcrossLine | AtCrossing


class LineFact(NamedTuple):
    """The part's equilibrium about a point tells one thing of a site's force: then its line is known."""

    part: Part
    site: UnknownForce
    about: About


class ForceFact(NamedTuple):
    """As a fact, of a site whose line is known: then its force is."""

    part: Part
    site: UnknownForce
    about: About


class ClosePolygon(NamedTuple):
    """Two sites of known lines close the part's force polygon."""

    part: Part
    one: UnknownForce
    two: UnknownForce


class Close(NamedTuple):
    """One site closes the part's force polygon, and its moments."""

    part: Part
    site: UnknownForce


class PinBalance(NamedTuple):
    """The forces on the links of one joint balance: the last of them."""

    site: JointForce


class Assume(NamedTuple):
    """False position: the force of a site is assumed on its line, twice, and the moves are drawn for both; in the end
    the force at `end` should be as the part's equilibrium about a point tells, and is not; the third time it is."""

    site: UnknownForce
    moves: tuple[StaticMove, ...]
    end: JointForce
    part: Part
    about: About


StaticMove = LineFact | ForceFact | ClosePolygon | Close | PinBalance | Assume

PREFERENCES = {  # what is drawn before what: by textbook, or by moments wherever there is a choice
    "polygons": ("pin", "close", "outer", "polygon", "found", "auxiliary", "inner"),
    "moments": ("pin", "close", "outer", "found", "polygon", "auxiliary", "inner"),
}


class Equilibrium:
    """Plans one group. `order` names a preference; `pick` says where a trial begins, counted from the first choice.

    What a move tells it has to tell in all `positions`; what forces have in common they have in the first. A part is
    looked at anew only where more is known of a force on it: what told nothing new before tells nothing new now.
    """

    def __init__(self, group: ForceGroup, positions: Sequence[Position], order: str = "polygons", pick: int = 0):
        self.group, self.positions, self.order, self.pick = group, positions, PREFERENCES[order], pick
        self.used = [Span() for _ in positions]
        self.rank: dict[UnknownForce, int] = {}
        self.lines: dict[UnknownForce, tuple[Triple, ...]] = {}
        self.through: dict[UnknownForce, About] = {}
        self.moves: list[StaticMove] = []
        self.assumed = 0
        self.options = 1
        self._choices: dict[Part, list[tuple[str, StaticMove]]] = {}
        self._open: set[Part] = set()  # parts of which nothing is told that is known already
        whole = [site for part in group.connected_parts for site, _ in group.boundary(part)]
        for site in dict.fromkeys(whole):
            self.rank[site] = int(has_line(site))
            if has_line(site):
                self.lines[site] = tuple(position.line(site) for position in positions)
                self.through[site] = AtPoint(site.at)
        self._parts_of: dict[UnknownForce, list[Part]] = {site: [] for site in self.rank}
        for part in group.connected_parts:
            for site, _ in group.boundary(part):
                self._parts_of[site].append(part)

    def plan(self) -> list[StaticMove]:
        """The moves, in order, that give the force of every site; refuses by name what no move reaches."""
        while any(rank < 2 for rank in self.rank.values()):
            move = self._next_move()
            if move is not None:
                self._enter(move)
            elif not self._assume():
                loose = dict.fromkeys(link for link in self.group.links)
                raise Refused(f"reactions of links {', '.join(loose)}", "no known construction determines them",
                              "ask for the balance alone, with --plan lever")
        return self.moves

    # ---- moves that tell something new -------------------------------------------------------------------------

    def _next_move(self) -> StaticMove | None:
        """The first new move of the most preferred kind."""
        for kind in self.order:
            for part in self.group.connected_parts if kind != "pin" else ():
                choices = self._choices_of(part)
                for choice in [choice for choice in choices if choice[0] == kind]:
                    if self._new(choice[1]):
                        return choice[1]
                    choices.remove(choice)
            if kind == "pin" and (site := next(self._last_at_pins(), None)) is not None:
                return PinBalance(site)
        return None

    def _choices_of(self, part: Part) -> list[tuple[str, StaticMove]]:
        """The moves that a part allows and that may be new, each with its kind."""
        if part not in self._choices:
            self._choices[part] = [*self._candidates(part)]
        return self._choices[part]

    def _candidates(self, part: Part) -> Iterator[tuple[str, StaticMove]]:
        unknown = self._unknown(part)
        if sum(not self.rank[site] for site in unknown) > MOST_FREE:
            return  # no point is passed by so many forces of unknown lines
        for site in unknown:
            others = [other for other in unknown if other != site]
            if all(self._is_couple(other) for other in others) and not self._twofold(site, others):
                yield "close", Close(part, site)
            for about in self._abouts(site, others):
                if self.rank[site]:
                    yield "found", ForceFact(part, site, about)
                else:
                    kind = "auxiliary" if isinstance(about, AtCrossing) else "inner"
                    yield "outer" if self.group.is_outer(site) else kind, LineFact(part, site, about)
        if len(unknown) == 2:
            yield "polygon", ClosePolygon(part, *unknown)

    def _know(self, site: UnknownForce, rank: int) -> None:
        """Know more of a force: the parts on which it acts are to be looked at anew."""
        self.rank[site] = rank
        for part in self._parts_of[site]:
            self._choices.pop(part, None)
            self._open.discard(part)

    def _twofold(self, site: UnknownForce, others: list[UnknownForce]) -> bool:
        """Whether a couple is unknown besides, so that forces alone do not tell a slide's reaction or a couple."""
        return bool(others) and (self._is_couple(site) or (isinstance(site, Slide) and self.rank[site] == 0))

    def _is_couple(self, site: UnknownForce) -> bool:
        return site in self.lines and self.lines[site][0] == FAR

    def _unknown(self, part: Part) -> list[UnknownForce]:
        return [site for site, _ in self.group.boundary(part) if self.rank[site] < 2]

    def _last_at_pins(self) -> Iterator[JointForce]:
        """The site that is left over at a joint within the group, where the others are known."""
        for point in self.group.points:
            sites = [site for site in self.rank if isinstance(site, JointForce) and site.point == point]
            left = [site for site in sites if self.rank[site] < 2]
            whole = len(sites) == len(self.group.members(point)) > 2 and not self.group.remaining_links(point)
            if len(left) == 1 and whole:
                yield left[0]

    def _abouts(self, site: UnknownForce, others: list[UnknownForce]) -> list[About]:
        """The point that all others' forces pass, if there is one."""
        free = [other for other in others if not self.rank[other]]
        known = [other for other in others if self.rank[other]]
        options: list[About] = []
        if free:
            pair = free[0]
            assert isinstance(pair, JointForce | Slide)
            options = [AtPoint(pair.point) if isinstance(pair, JointForce) else AcrossSlide(pair)]
        elif len(known) > 1:
            options = [self._meeting(*pair) for pair in combinations(known[:3], 2)][:1]
        elif known and not self._is_couple(known[0]):
            options = [self.through[known[0]]] if not isinstance(known[0], JointForce) else [AtPoint(known[0].point)]
        return [about for about in options if self._all_pass(about, free, known) and self._tells(site, about)]

    def _meeting(self, one: UnknownForce, two: UnknownForce) -> About:
        """Intersection of two known lines; a couple's line is at infinity."""
        if self._is_couple(one) or self._is_couple(two):
            return AcrossLine(two if self._is_couple(one) else one)
        return AtCrossing(one, two)

    def points(self, about: About) -> list[Triple]:
        """A point in every position."""
        return [self._point(about, n) for n in range(len(self.positions))]

    def _point(self, about: About, n: int) -> Triple:
        match about:
            case AtPoint(point):
                return self.positions[n].points[point]
            case AcrossSlide(slide):
                return self.positions[n].ways[slide]
            case AcrossLine(site):
                return cross(self.lines[site][n], FAR)
            case AtCrossing(one, two):
                return cross(self.lines[one][n], self.lines[two][n])

    def _all_pass(self, about: About, free: list[UnknownForce], known: list[UnknownForce]) -> bool:
        """Whether all these forces pass a point in any position."""
        Y = self._point(about, 0)
        pencils = [self.positions[0].pencil(site) for site in free]
        return any(Y) and not any(pencil is None or any(cross(pencil, Y)) for pencil in pencils) and not any(
            dot(self.lines[site][0], Y) for site in known)

    def _tells(self, site: UnknownForce, about: About) -> bool:
        """Whether moments about a point tell anything of a site's force, in general and in the pose."""
        ends = enumerate(self.points(about))
        if self.rank[site] == 1:
            return all(dot(self.lines[site][n], Y) for n, Y in ends)
        pencils = [position.pencil(site) for position in self.positions]
        return all(pencil is not None and any(cross(pencil, Y)) for pencil, (_, Y) in zip(pencils, ends, strict=True))

    def _cross(self, one: UnknownForce, two: UnknownForce, n: int) -> bool:
        """Whether the lines of two forces run different ways."""
        return any(cross(cross(self.lines[one][n], FAR), cross(self.lines[two][n], FAR)))

    def _equations(self, move: StaticMove, n: int) -> tuple[list[dict[tuple[str, int], int]], int]:
        """The equilibrium equations that a move uses in one position, and how many of them have to be new."""
        match move:
            case LineFact(part, _, about) | ForceFact(part, _, about):
                return [equation(part, self._point(about, n))], 1
            case ClosePolygon(part, one, two):
                if not (self.rank[one] and self.rank[two]) or not self._cross(one, two, n):
                    return [], 1
                return [equation(part, way) for way in FORCES], 2
            case Close(part, site):
                alone = self._unknown(part) == [site]  # else a couple is unknown besides, and moments tell nothing
                turn = (TURN,) if alone and isinstance(site, Slide | Balance) else ()
                return [equation(part, way) for way in (*FORCES, *turn)], 2 - self.rank[site]
        return [], 0

    def _new(self, move: StaticMove) -> bool:
        """Whether a move says something new, in general and in the pose."""
        for n, used in enumerate(self.used):
            rows, needed = self._equations(move, n)
            span = used.copy()
            if sum([span.adds(row) for row in rows]) < needed:
                return False
        return True

    def _enter(self, move: StaticMove) -> None:
        """Take a move: what it uses, and what is known after it."""
        for n, span in enumerate(self.used):
            for row in self._equations(move, n)[0]:
                span.adds(row)
        self.moves.append(move)
        match move:
            case LineFact(_, site, about):
                self.through[site] = about
                self.lines[site] = tuple(self._line(position.pencil(site), Y) for position, Y in
                                         zip(self.positions, self.points(about), strict=True))
                self._know(site, 1)
            case ForceFact(_, site, _) | Close(_, site) | PinBalance(site):
                self._know(site, 2)
            case ClosePolygon(_, one, two):
                self._know(one, 2)
                self._know(two, 2)

    @staticmethod
    def _line(pencil: Triple | None, Y: Triple) -> Triple:
        assert pencil is not None
        line = cross(pencil, Y)
        return line if any(line[:2]) else FAR

    # ---- trials ------------------------------------------------------------------------------------------------

    def _assume(self) -> bool:
        """Assume a force on its known line, go on until a part's equilibrium is hurt, and find it from that."""
        sites = [site for site, rank in self.rank.items() if rank == 1 and not self._is_couple(site)]
        if not sites or self.assumed >= MAX_NESTED_TRIALS:
            return False
        self.options = max(self.options, len(sites))
        site = sites[self.pick % len(sites)]
        before, self.moves = self.moves, []
        self._know(site, 2)
        self.assumed += 1
        while (closing := self._closing()) is None:
            move = self._next_move()
            if move is not None:
                self._enter(move)
            elif not self._assume():
                return False
        end, part, about = closing
        for span, Y in zip(self.used, self.points(about), strict=True):
            span.adds(equation(part, Y))
        self.assumed -= 1
        self.moves = [*before, Assume(site, tuple(self.moves), end, part, about)]
        return True

    def _closing(self) -> tuple[JointForce, Part, About] | None:
        """A part whose equilibrium tells of a force that is known already."""
        for part in self.group.connected_parts:
            if part in self._open:
                continue
            unknown = self._unknown(part)
            if sum(2 - self.rank[site] for site in unknown) > 2:
                continue
            for site, _ in self.group.boundary(part):
                if isinstance(site, JointForce) and self.rank[site] == 2:
                    abouts = self._abouts(site, unknown) if unknown else self._other_points(part, site)
                    for about in abouts:
                        if self._closes(part, site, about):
                            return site, part, about
            self._open.add(part)
        return None

    def _closes(self, part: Part, site: JointForce, about: About) -> bool:
        """Whether the equilibrium of a part about a point tells of a site's force, and was not used."""
        return all(any(cross(position.finite(site), Y)) and span.copy().adds(equation(part, Y))
                   for position, span, Y in zip(self.positions, self.used, self.points(about), strict=True))

    def _other_points(self, part: Part, site: JointForce) -> list[About]:
        """Other points of the part."""
        names = [p for link in self.group.links if link in part for p in self.group.scene.links[link]]
        return [AtPoint(name) for name in dict.fromkeys(names) if name != site.point]
