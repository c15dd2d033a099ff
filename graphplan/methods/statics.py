"""The force planner: finds in which order the reactions of a group are found, whatever the group.

The dual of the velocity planner. A part of the group is in equilibrium: moments about the point where all its unknown
forces but one pass tell one thing of that one (a *fact*: its component square to the way there); where two of the
unknown forces have known lines that point is an auxiliary point, as Q and R are for velocities. Two forces of known
lines close a force polygon; one alone closes it whatever its line. Where nothing goes on, a force is assumed twice and
found by false position.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from graphplan.errors import Refused
from graphplan.mechanism.model import Balance, Slide
from graphplan.methods.sites import FAR, Group, Joint, Site, Span, Triple, cross, dot, equation

DEEPEST = 3  # trials within trials
MOST_FREE = 3  # forces of unknown lines on a part that tells anything
FORCES = (1, 0, 0), (0, 1, 0)
TURN = (0, 0, 1)
Part = frozenset[str]


@dataclass(frozen=True)
class AtPoint:
    """Moments about a point of the mechanism."""

    point: str


@dataclass(frozen=True)
class Along:
    """No moments: forces across the direction in which a slide's reaction acts."""

    slide: Slide


@dataclass(frozen=True)
class AlongLine:
    """No moments: forces across the known line of a site."""

    site: Site


@dataclass(frozen=True)
class Where:
    """Moments about the auxiliary point where the known lines of two sites meet."""

    one: Site
    two: Site


About = AtPoint | Along | AlongLine | Where


@dataclass(frozen=True)
class Fact:
    """The part's equilibrium about a point tells one thing of a site's force: then its line is known."""

    part: Part
    site: Site
    about: About


@dataclass(frozen=True)
class Found:
    """As a fact, of a site whose line is known: then its force is."""

    part: Part
    site: Site
    about: About


@dataclass(frozen=True)
class Polygon:
    """Two sites of known lines close the part's force polygon."""

    part: Part
    one: Site
    two: Site


@dataclass(frozen=True)
class Close:
    """One site closes the part's force polygon, and its moments."""

    part: Part
    site: Site


@dataclass(frozen=True)
class Pin:
    """The forces on the links of one joint balance: the last of them."""

    site: Joint


@dataclass(frozen=True)
class Assume:
    """False position: the force of a site is assumed on its line, twice, and the moves are drawn for both; in the end
    the force at `end` should be as the part's equilibrium about a point tells, and is not; the third time it is."""

    site: Site
    moves: tuple[StaticMove, ...]
    end: Joint
    part: Part
    about: About


StaticMove = Fact | Found | Polygon | Close | Pin | Assume

PREFERENCES = {  # what is drawn before what: by textbook, or by moments wherever there is a choice
    "polygons": ("pin", "close", "outer", "polygon", "found", "auxiliary", "inner"),
    "moments": ("pin", "close", "outer", "found", "polygon", "auxiliary", "inner"),
}


class Equilibrium:
    """Plans one group. `order` names a preference; `pick` says where a trial begins, counted from the first choice."""

    def __init__(self, group: Group, order: str = "polygons", pick: int = 0):
        self.group, self.order, self.pick = group, PREFERENCES[order], pick
        self.used = Span()
        self.rank: dict[Site, int] = {}
        self.lines: dict[Site, Triple] = {}
        self.through: dict[Site, About] = {}
        self.moves: list[StaticMove] = []
        self.assumed = 0
        self.options = 1
        whole = [site for part in group.parts for site, _ in group.boundary(part)]
        for site in dict.fromkeys(whole):
            self.rank[site] = int(isinstance(site, Balance))
            if isinstance(site, Balance):
                self.lines[site] = group.line(site)
                self.through[site] = AtPoint(site.at)

    def plan(self) -> list[StaticMove]:
        """The moves, in order, that give the force of every site; refuses by name what no move reaches."""
        while any(rank < 2 for rank in self.rank.values()):
            move = self._next()
            if move is not None:
                self._enter(move)
            elif not self._assume():
                loose = dict.fromkeys(link for link in self.group.links)
                raise Refused(f"reactions of links {', '.join(loose)}", "no construction known here reaches them",
                              "ask for the balance alone, with --plan lever")
        return self.moves

    # ---- moves that tell something new -------------------------------------------------------------------------

    def _next(self) -> StaticMove | None:
        """The first new move of the most preferred kind."""
        best: tuple[int, StaticMove] | None = None
        for kind, move in self._candidates():
            rank = self.order.index(kind)
            if (best is None or rank < best[0]) and self._new(move):
                best = rank, move
                if rank == 0:
                    break
        return best[1] if best else None

    def _candidates(self) -> Iterator[tuple[str, StaticMove]]:
        yield from (("pin", Pin(site)) for site in self._last_at_pins())
        for part in self.group.parts:
            unknown = self._unknown(part)
            if sum(not self.rank[site] for site in unknown) > MOST_FREE:
                continue  # no point is passed by so many forces of unknown lines
            for site in unknown:
                others = [other for other in unknown if other != site]
                if all(self.lines.get(other) == FAR for other in others) and not self._twofold(site, others):
                    yield "close", Close(part, site)
                for about in self._abouts(site, others):
                    if self.rank[site]:
                        yield "found", Found(part, site, about)
                    else:
                        kind = "auxiliary" if isinstance(about, Where) else "inner"
                        yield "outer" if self.group.outer(site) else kind, Fact(part, site, about)
            if len(unknown) == 2:
                yield "polygon", Polygon(part, *unknown)

    def _twofold(self, site: Site, others: list[Site]) -> bool:
        """Whether a couple is unknown besides, so that forces alone do not tell a slide's reaction or a couple."""
        return bool(others) and (self.lines.get(site) == FAR or (isinstance(site, Slide) and self.rank[site] == 0))

    def _unknown(self, part: Part) -> list[Site]:
        return [site for site, _ in self.group.boundary(part) if self.rank[site] < 2]

    def _last_at_pins(self) -> Iterator[Joint]:
        """The site that is left over at a joint within the group, where the others are known."""
        for point in self.group.points:
            sites = [site for site in self.rank if isinstance(site, Joint) and site.point == point]
            left = [site for site in sites if self.rank[site] < 2]
            if len(left) == 1 and len(sites) == len(self.group.members(point)) > 2 and not self.group.rest(point):
                yield left[0]

    def _abouts(self, site: Site, others: list[Site]) -> list[About]:
        """The point that all others' forces pass, if there is one."""
        free = [other for other in others if not self.rank[other]]
        known = [other for other in others if self.rank[other]]
        options: list[About] = []
        if free:
            options = [self._pencil(free[0])]
        elif len(known) > 1:
            options = [self._meeting(*pair) for pair in combinations(known[:3], 2)][:1]
        elif known and self.lines[known[0]] != FAR:
            options = [self.through[known[0]]] if not isinstance(known[0], Joint) else [AtPoint(known[0].point)]
        elif not known and self.lines.get(site) == FAR:
            options = []
        return [about for about in options if self._passed(about, free, known) and self._tells(site, about)]

    def _pencil(self, site: Site) -> About:
        assert isinstance(site, Joint | Slide)
        return AtPoint(site.point) if isinstance(site, Joint) else Along(site)

    def _meeting(self, one: Site, two: Site) -> About:
        """Where two known lines meet; a couple's line is far away."""
        if self.lines[one] == FAR or self.lines[two] == FAR:
            return AlongLine(two if self.lines[one] == FAR else one)
        return Where(one, two)

    def point(self, about: About) -> Triple:
        """A point in general position."""
        match about:
            case AtPoint(point):
                return self.group.finite(Joint(point, ""))
            case Along(slide):
                pencil = self.group.pencil(slide)
                assert pencil is not None
                return pencil
            case AlongLine(site):
                return cross(self.lines[site], FAR)
            case Where(one, two):
                return cross(self.lines[one], self.lines[two])

    def _passed(self, about: About, free: list[Site], known: list[Site]) -> bool:
        """Whether all these forces pass a point."""
        Y = self.point(about)
        pencils = [self.group.pencil(site) for site in free]
        return any(Y) and not any(pencil is None or any(cross(pencil, Y)) for pencil in pencils) and not any(
            dot(self.lines[site], Y) for site in known)

    def _tells(self, site: Site, about: About) -> bool:
        """Whether moments about a point tell anything of a site's force."""
        Y = self.point(about)
        if self.rank[site] == 1:
            return bool(dot(self.lines[site], Y))
        pencil = self.group.pencil(site)
        return pencil is not None and any(cross(pencil, Y))

    def _equations(self, move: StaticMove) -> tuple[list[dict[tuple[str, int], int]], int]:
        """The equilibrium equations that a move uses, and how many of them have to be new."""
        match move:
            case Fact(part, _, about) | Found(part, _, about):
                return [equation(part, self.point(about))], 1
            case Polygon(part, one, two):
                if not (self.rank[one] and self.rank[two]) or not any(cross(cross(self.lines[one], FAR),
                                                                            cross(self.lines[two], FAR))):
                    return [], 1
                return [equation(part, way) for way in FORCES], 2
            case Close(part, site):
                alone = self._unknown(part) == [site]  # else a couple is unknown besides, and moments tell nothing
                turn = (TURN,) if alone and isinstance(site, Slide | Balance) else ()
                return [equation(part, way) for way in (*FORCES, *turn)], 2 - self.rank[site]
        return [], 0

    def _new(self, move: StaticMove) -> bool:
        rows, needed = self._equations(move)
        span = self.used.copy()
        return sum([span.adds(row) for row in rows]) >= needed

    def _enter(self, move: StaticMove) -> None:
        """Take a move: what it uses, and what is known after it."""
        for row in self._equations(move)[0]:
            self.used.adds(row)
        self.moves.append(move)
        match move:
            case Fact(_, site, about):
                pencil = self.group.pencil(site)
                assert pencil is not None
                self.rank[site], self.through[site] = 1, about
                line = cross(pencil, self.point(about))
                self.lines[site] = FAR if not any(line[:2]) else line
            case Found(_, site, _) | Close(_, site) | Pin(site):
                self.rank[site] = 2
            case Polygon(_, one, two):
                self.rank[one] = self.rank[two] = 2

    # ---- trials ------------------------------------------------------------------------------------------------

    def _assume(self) -> bool:
        """Assume a force on its known line, go on until a part's equilibrium is hurt, and find it from that."""
        sites = [site for site, rank in self.rank.items() if rank == 1 and self.lines[site] != FAR]
        if not sites or self.assumed >= DEEPEST:
            return False
        self.options = max(self.options, len(sites))
        site = sites[self.pick % len(sites)]
        before, self.moves = self.moves, []
        self.rank[site] = 2
        self.assumed += 1
        while (closing := self._closing()) is None:
            move = self._next()
            if move is not None:
                self._enter(move)
            elif not self._assume():
                return False
        end, part, about = closing
        self.used.adds(equation(part, self.point(about)))
        self.assumed -= 1
        self.moves = [*before, Assume(site, tuple(self.moves), end, part, about)]
        return True

    def _closing(self) -> tuple[Joint, Part, About] | None:
        """A part whose equilibrium tells of a force that is known already."""
        for part in self.group.parts:
            unknown = self._unknown(part)
            if sum(2 - self.rank[site] for site in unknown) > 2:
                continue
            for site, _ in self.group.boundary(part):
                if isinstance(site, Joint) and self.rank[site] == 2:
                    abouts = self._abouts(site, unknown) if unknown else self._anywhere(part, site)
                    for about in abouts:
                        known_line = cross(self.group.finite(site), self.point(about))
                        if any(known_line) and self.used.copy().adds(equation(part, self.point(about))):
                            return site, part, about
        return None

    def _anywhere(self, part: Part, site: Joint) -> list[About]:
        """Other points of the part."""
        names = [p for link in self.group.links if link in part for p in self.group.scene.links[link]]
        return [AtPoint(name) for name in dict.fromkeys(names) if name != site.point]
