"""The planner: finds the order of construction, whatever the mechanism.

Facts travel along joints until nothing moves. Where they run in a ring of links, a relative pole, an auxiliary point or
a trial is put in, and they travel on. A body that hears four facts has one too many: in a trial that is the closing
condition.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import chain, combinations, islice, pairwise, zip_longest
from typing import NamedTuple

from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Pair
from graphplan.methods.motion import moves
from graphplan.methods.motion.facts import ANYWHERE, Facts, Two, line, meet, parallel
from graphplan.methods.motion.moves import Carry, FalsePosition, Locus, Meet, Move
from graphplan.methods.motion.network import POLE, BodyPoint, Network

MOST_TRIALS = 6  # at how many places a trial may begin
MAX_NESTED_TRIALS = 3  # trials within trials
MOST_FIGURES = 3  # by which one locus may close a trial
Bar = tuple[str, BodyPoint, BodyPoint]
# What a trial's error is seen by: the moves that draw an end, and a locus on which it should lie.
Closing = tuple[tuple[Move, ...], BodyPoint, Locus]


class Choices(NamedTuple):
    """Number of ways on at one place of a plan; `rare` ones matter only if the first is not valid."""

    ways: int
    rare: bool = False


class Planner(Facts):
    """Plans one network.

    Where facts run in rings there are several ways on, and rare ones elsewhere: to close a trial, to begin a figure.
    `choice` says, place by place, which is taken (the first where it says nothing), and `options` then tells how many
    there were. `method` leaves out ways: "trial" all but trials. `centres` are where bodies have their poles relative
    to the frame, as far as they are to be used.
    """

    def __init__(self, network: Network, method: str = "", choice: tuple[int, ...] = (), general: bool = False,
                 common: bool = False, centres: Mapping[str, Pair] | None = None):
        super().__init__(network, general, common)
        self.centres = centres or {}
        self.method, self.choice = method, choice
        self.options: list[Choices] = []
        self.spent: dict[str, int] = {}
        self.joined: set[frozenset[str]] = set()
        self.of_velocities = self  # which plans the velocities, where they have a method of their own
        self.velocity_moves: list[Move] | None = None  # of velocities alone, once a draughtsman has planned them
        self.open: list[tuple[Locus, int]] = []  # trials: where assumed, and where their moves begin

    @property
    def choices(self) -> tuple[int, ...]:
        """Numbers of the ways taken, place by place."""
        return (*self.choice, *[0] * (len(self.options) - len(self.choice)))

    def plan(self) -> list[Move]:
        """The moves, in order, that give the end of every place; refuses by name what no move reaches."""
        self._seed()
        for body, spot in self.centres.items():
            self._centre(body, spot)
        while True:
            self._travel()
            if self._begin():
                continue
            loose = [body for body in self.places if not self._is_known(body)]
            if not loose and not self.open:
                self._order_auxiliary_points()
                return self.moves
            if not self._break(loose):
                stuck = loose or [body for (place, _), _ in self.open for body in self._bodies_at(place)]
                raise Refused(f"links {', '.join(stuck)}", "no known construction determines them",
                              "check the drives, or ask for points of other links")

    def _order_auxiliary_points(self) -> None:
        """Put the loci by auxiliary points that the sheet names in its order, where none waits for one that then comes
        later."""
        order = [*self.net.auxiliary]
        named = sorted((move for move in self.moves if isinstance(move, Carry) and move.body in order),
                       key=lambda move: order.index(move.body))
        for place, move in enumerate(named):
            start, locus = self.moves.index(move), (move.X, move.source or move.body)
            end = max(self.moves.index(other) for other in named[: place + 1])
            if not any(_reads(other, locus) for other in self.moves[start : end + 1]):
                self.moves.insert(end, self.moves.pop(start))

    def _centre(self, body: str, spot: Pair) -> None:
        """Take the pole of a body for a point of it that is at rest, as a pin on the frame is."""
        place = (f"pole of {body}", FRAME)
        self.spots[place[0]] = self._direction_of(spot)
        self._add_place(body, place)
        self.bodies[place] = [body]
        self.moves.append(moves.Centre(body, place))
        self._file(place, self.net.ground, None)

    # ---- rings ----------------------------------------------------------------------------------------------

    def _break(self, loose: list[str]) -> bool:
        """Facts have stopped travelling: put in a relative pole, an auxiliary point or a trial."""
        if self.common:
            return False  # what it knows twice would close a trial that is not true
        ways: list[Callable[[], None]] = []
        if self.method != "trial":
            ways += [partial(self._join, pair, bars) for pair, bars in self._pairs(loose)]
        if self.method != "poles" or not ways:
            if self.method != "trial":
                ways += [partial(self._cross, body, one, two) for body, one, two in self._crossings(loose)]
            ways += [partial(self._try, locus) for locus in self._trials(loose)[:MOST_TRIALS]]
        if not ways:
            return False
        ways[self._choose(Choices(len(ways)))]()
        return True

    def _choose(self, options: Choices) -> int:
        """Take one of several ways on by its wished number."""
        asked = len(self.options)
        self.options.append(options)
        taken = self.choice[asked] if asked < len(self.choice) else 0
        if taken >= options.ways:
            raise Refused(f"ways {', '.join(map(str, self.choice))}", f"number {asked + 1} has {options.ways} ways on",
                          f"0 to {options.ways - 1}")
        return taken

    def _crossings(self, loose: list[str]) -> Iterator[tuple[str, Locus, Locus]]:
        """Bodies with two loci and a slide that could pass on what their crossing, an auxiliary point, tells."""
        for body in loose:
            slides = [s for s in self.net.slides_of.get(body, ()) if s.name not in self.passed]
            loci = list(self._loci(body))
            crossing = len(loci) == 2 and not parallel(*map(self._normal, loci))
            if slides and crossing and not self._ends(body) and self._count(body) == 2:
                yield body, loci[0], loci[1]

    def _cross(self, body: str, one: Locus, two: Locus) -> None:
        """Mark the auxiliary point: each line through a locus's place runs as the locus does."""
        place = (f"auxiliary point of {body}", self.net.link_at(body, one[0]))
        spot = meet(*(line(self._normal(locus), self._spot(locus[0])) for locus in (one, two)))
        assert spot is not None
        self.spots[place[0]] = spot
        self._add_place(body, place)
        self.bodies[place] = [body]
        self.moves.append(moves.Auxiliary(body, one, two, place))
        self._file(place, body, None)

    # ---- relative poles -------------------------------------------------------------------------------------

    def _pairs(self, loose: list[str]) -> Iterator[tuple[frozenset[str], list[Bar]]]:
        """Pairs of single links with two facts each, joined by two bars: their relative pole serves as a joint."""
        bars: dict[frozenset[str], list[Bar]] = {}
        for body in loose:
            ends = self.places[body]
            rigid = len(self.net.members[body]) == 1 and len({self.net.spot(end[0]) for end in ends}) == 2
            if rigid and len(ends) == 2 and all(len(self._bodies_at(place)) == 2 for place in ends):
                neighbours = ((next(b for b in self._bodies_at(end) if b != body), end) for end in ends)
                (one, D), (two, G) = sorted(neighbours, key=lambda pair: self.net.order.link(pair[0]))
                bars.setdefault(frozenset((one, two)), []).append((body, D, G))
        for pair, found in bars.items():
            single = all(self._count(body) == 2 and len(self.net.members[body]) == 1 for body in pair)
            if single and len(found) == 2 and pair not in self.joined and self._pole_spot(found):
                yield pair, found

    def _pole_spot(self, bars: list[Bar]) -> Two | None:
        """Place of the relative pole; None if the bars are parallel."""
        return meet(*(line(self._circle_normal(D, G), self._spot(D)) for _, D, G in bars))

    def _join(self, pair: frozenset[str], bars: list[Bar]) -> None:
        one, two = sorted(pair, key=self.net.order.link)
        place = (f"pole of {one} and {two}", POLE)
        spot = self._pole_spot(bars)
        assert spot is not None
        self.spots[place[0]] = spot
        self.bodies[place] = [one, two]
        for body in (one, two):
            self._add_place(body, place)
        self.retired |= {bar[0] for bar in bars}
        self.joined.add(pair)
        self.moves.append(moves.Pole((one, two), (bars[0], bars[1]), place))
        self._notify_listeners(place)

    # ---- trials ---------------------------------------------------------------------------------------------

    def _trials(self, loose: list[str]) -> list[Locus]:
        """Places with one locus, where an end may be assumed."""
        if len(self.open) >= MAX_NESTED_TRIALS:
            return []
        loci = [(place, source) for body in loose for place in self.places[body] if place not in self.drawn
                for source, fact in self.facts.get(place, {}).items() if fact is not None]
        return list(dict.fromkeys(loci))

    def _try(self, at: Locus) -> None:
        """Assume the end of a place on its locus; the closing condition will tell how far off that was."""
        self.open.append((at, len(self.moves)))
        self.spent |= {body: max(self._excess(body), self.spent.get(body, 0)) for body in self.places}
        self._file(at[0], f"trial {len(self.open)}", ANYWHERE, marked=True)

    def _on_redundant_fact(self, body: str) -> None:
        """A body has heard one fact too many: the innermost trial ends where two of its words can be compared."""
        if not self.open or self._excess(body) <= self.spent.get(body, 0):
            return
        closings = list(self._closings(body))
        if not closings:
            return
        taken = self._choose(Choices(len(closings) + 1, rare=True))
        if taken == 1:
            return  # another body may close it
        drawn, end, locus = closings[max(taken - 1, 0)]
        at, start = self.open.pop()
        self.moves[start:] = [moves.FalsePosition(at, (*self.moves[start:], *drawn), end, locus)]
        self.spent[body] = self.spent.get(body, 0) + 1
        self._queue(*self.places)

    def _closings(self, body: str) -> Iterator[Closing]:
        """Yield independent ends and loci of a body that has too many facts; uncertain ones last."""
        told = {place: self._count_from_others(place, body) for place in self._ends(body)}
        whole = [place for place, rank in told.items() if rank == 2]
        own = f"{body} trial"  # a source of its own: what the body told before stands
        for X in whole:
            if line := self._independent(body, X, whole, own):
                yield (line,), X, (X, own)
        for K in whole:
            for (R, _), (X, source) in pairwise(self._loci(body, K)):
                if R in told:
                    copy = (X[0], own)
                    yield (moves.SimilarFigure(body, K, X, R=R, copy=copy),), copy, (X, source)
        if closing := self._three_loci(body):
            yield closing
        loci = [locus for place in self.places[body] if (locus := self._locus_of(place, body))]
        ways = (chain(self._by_one(body, X), self._by_turning(body, X), self._by_two(body, X)) for X, _ in loci)
        for figures in zip_longest(*(islice(way, MOST_FIGURES) for way in ways)):
            for (X, source), figure in zip(loci, figures, strict=True):
                if figure:
                    copy = (X[0], own)
                    yield (figure._replace(copy=copy),), copy, (X, source)
        for K, X in combinations(told, 2):
            if self.net.spot(K[0]) != self.net.spot(X[0]) and not told[K] == told[X] == 2:
                yield (moves.Swing(body, K, X, own),), X, (X, own)

    def _three_loci(self, body: str) -> Closing | None:
        """An end found by all loci of a body but one, beside that one."""
        loci = list(self._loci(body))
        crossed = self._meet_of_loci(body, loci[0][0]) if loci else None
        if crossed is None:
            return None
        lines, meet = crossed
        copy = (meet.place[0], f"{body} trial")
        return (*lines, meet._replace(copy=copy)), copy, loci[0]

    def _begin(self) -> bool:
        """Begin the figure of a body that is known by loci alone, if there is one whose points have no end."""
        for body in self.places:
            if body != self.net.ground and body not in self.retired and self._count(body) == 3:
                for X in self.places[body]:
                    crossed = self._meet_of_loci(body, X) if X not in self.drawn else None
                    if crossed and not self._ends(body):
                        self._tell_fact(body, X, [*crossed[0], crossed[1]], None)
                        return True
        return False

    def _independent(self, body: str, X: BodyPoint, ends: list[BodyPoint], own: str) -> Move | None:
        """A locus for X by what the body heard elsewhere."""
        others = [place for place in ends if self.net.spot(place[0]) != self.net.spot(X[0])]
        if others:
            return moves.Swing(body, others[0], X, own)
        loci, like = list(self._loci(body, X)), self._like(body)
        if loci and like:
            return moves.Slip(body, loci[0], X, like, own)
        return moves.Carry(body, loci[0], loci[1], X, own) if len(loci) > 1 else None


def _reads(move: Move, locus: Locus) -> bool:
    """Whether a move may need a locus."""
    match move:
        case Meet(place, sources):
            return place == locus[0] and locus[1] in sources
        case FalsePosition():
            return True
    return locus in move
