"""Facts that travel along joints: what is known of each place of a mechanism, who said so, and what follows.

Each body has three unknowns, each place two. A body with two facts gives every other place of it one (a locus), with
three facts two (the end itself). All of it happens on the mechanism's graph; the pose is not looked at.

A fact is filed at its place under its source, so that a body never takes its own word for news.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

from graphplan.mechanism.model import Slide
from graphplan.mechanism.order import by_name
from graphplan.methods.moves import Carry, Figure, Guide, Locus, Meet, Move, Rest, Seed, Settle, Slip, Swing
from graphplan.methods.network import Network, Place

TRIAL = "trial"  # the source of what is only assumed


class Facts:
    """What is known of one network, and the moves that made it known."""

    def __init__(self, network: Network):
        self.net = network
        self.moves: list[Move] = []
        self.facts: dict[Place, dict[str, int]] = {}
        self.drawn: set[Place] = set()
        self.places = {body: network.places_of(body) for body in network.members}
        self.bodies = {place: network.bodies_at(place) for body in self.places for place in self.places[body]}
        self.told: dict[tuple[str, Place], int] = {}
        self.turning: dict[str, str] = {}
        self.passed: set[str] = set()
        self.retired: set[str] = set()
        self.waiting: deque[str | Slide] = deque()
        self.queued: set[str | Slide] = set()

    def _overheard(self, body: str, count: int) -> None:
        """A body has heard this many facts, three being enough: a planner with an open trial may close it here."""

    # ---- travelling -----------------------------------------------------------------------------------------

    def _seed(self) -> None:
        ground = self.net.ground
        if ground:
            self.turning[self.net.classes[ground]] = ground
            for place in self.places[ground]:
                self._rest(place)
            self._wake_class(ground)
        for point in sorted(map(self.net.name, self.net.scene.motions), key=by_name):
            self.moves.append(Seed((point, "")))
            self._file((point, ""), "motion", 2)
        self._queue(*[b for b in self.places if b != ground], *self.net.slides)

    def _rest(self, place: Place) -> None:
        self.moves.append(Rest(place))
        self._file(place, self.net.ground, 2)

    def _queue(self, *nodes: str | Slide) -> None:
        for node in nodes:
            if node not in self.queued:
                self.queued.add(node)
                self.waiting.append(node)

    def _travel(self) -> None:
        while self.waiting:
            node = self.waiting.popleft()
            self.queued.discard(node)
            if isinstance(node, Slide):
                self._through_slide(node)
            elif node in self.retired:
                self._turning_known(node)
            elif node != self.net.ground:
                self._through_body(node)

    def _file(self, place: Place, source: str, rank: int, *, marked: bool = False) -> None:
        """Enter a fact; where a place then knows enough, its end is marked, and the neighbours are told."""
        here = self.facts.setdefault(place, {})
        here[source] = max(rank, here.get(source, 0))
        if marked:
            self.drawn.add(place)
        elif place not in self.drawn and sum(here.values()) >= 2:
            if max(here.values()) < 2:
                one, two = list(here)[:2]
                self.moves.append(Meet(place, (one, two)))
            self.drawn.add(place)
        self._tell(place)

    def _tell(self, place: Place) -> None:
        for body in self._at(place):
            self._queue(body, *self.net.slides_of.get(body, ()))

    def _at(self, place: Place) -> list[str]:
        if place not in self.bodies:
            self.bodies[place] = self.net.bodies_at(place)
        return self.bodies[place]

    def _heard(self, place: Place, body: str) -> int:
        """What a place knows that this body did not tell it."""
        return min(2, sum(rank for source, rank in self.facts.get(place, {}).items() if source != body))

    def _loci(self, body: str, but: Place = ("", "")) -> Iterator[Locus]:
        """Loci of the body's places from other sources, one a spot, none at the spot of `but`."""
        seen = {self.net.spot(but[0])}
        for place in self.places[body]:
            spot = self.net.spot(place[0])
            if spot not in seen and (locus := self._locus_of(place, body)):
                seen.add(spot)
                yield locus

    def _locus_of(self, place: Place, body: str) -> Locus | None:
        """A locus of a place that another source than this body gives."""
        for source, rank in self.facts.get(place, {}).items():
            if source != body and rank == 1 and not source.startswith(TRIAL):
                return place, source
        return None

    def _like(self, body: str) -> str:
        """The body by whose turning this one's is known, if any."""
        source = self.turning.get(self.net.classes[body], "")
        return "" if source == body else source

    def _count(self, body: str, but: Place | None = None) -> int:
        """How many facts a body has, but for those of one place: a spot has two at most, whatever places are there."""
        told: dict[str, int] = {}
        for place in self.places[body]:
            if place != but:
                spot = self.net.spot(place[0])
                told[spot] = min(2, told.get(spot, 0) + self._heard(place, body))
        return sum(told.values()) + bool(self._like(body))

    def _known(self, body: str) -> bool:
        return body == self.net.ground or body in self.retired or self._count(body) >= 3

    def _through_body(self, body: str) -> None:
        count = self._count(body)
        if count > 3:
            self._overheard(body, count)
        for place in list(self.places[body]):
            if place not in self.drawn:
                rest = self._count(body, place)
                here = max((self._heard(other, body) for other in self._together(body, place)), default=0)
                rank = 2 if rest >= 3 or here == 2 else 1 if rest == 2 or here == 1 else 0
                if rank > self.told.get((body, place), 0):
                    self._emit(body, place, rank)
        if count >= 3:
            self._turning_known(body)

    def _together(self, body: str, X: Place) -> list[Place]:
        """The other places of a body that lie in one spot with X: they move alike, however the body turns."""
        spot = self.net.spot(X[0])
        return [place for place in self.places[body] if place != X and self.net.spot(place[0]) == spot]

    def _ends(self, body: str, but: Place = ("", "")) -> list[Place]:
        """The body's places whose ends are drawn, but for those in the spot of one place."""
        spot = self.net.spot(but[0])
        return [place for place in self.places[body] if place in self.drawn and self.net.spot(place[0]) != spot]

    def _emit(self, body: str, X: Place, rank: int) -> None:
        """Tell a place what the body knows of it, unless others have told the same: special geometry repeats it."""
        if (body, X) in self.net.repeating:
            return
        figure = self._figure(body, X) if rank == 2 else None
        if rank == 2 and figure is None and not self.told.get((body, X)):
            if begun := self._begun(body, X):
                self.moves += begun
                self.told[body, X] = rank
                self._file(X, body, rank)
                return
            rank = 1  # known wholly, but no end is drawn yet to begin a figure at
        whole = rank == 1 and (self._settle(body, X) or self._beside(body, X))
        move = figure or whole or (self._line(body, X) if rank == 1 else None)
        if move is None:
            return
        if isinstance(whole, (Settle, Figure)):
            self.moves.append(Swing(body, whole.K, X))  # a locus that others may ask for; pruned if nobody does
        self.moves.append(move)
        self.told[body, X] = rank
        self._file(X, body, rank, marked=bool(whole))

    def _line(self, body: str, X: Place) -> Move | None:
        """One fact for X: from an end that the body knows, from two loci, or from a locus and the turning."""
        here = next(filter(None, (self._locus_of(place, body) for place in self._together(body, X))), None)
        if here:
            return Slip(body, here, X, "")
        known = self._ends(body, X)
        if known:
            return Swing(body, max(known, key=lambda place: self._heard(place, body)), X)
        loci, like = list(self._loci(body, X)), self._like(body)
        if loci and like:
            return Slip(body, loci[0], X, like)
        return Carry(body, loci[0], loci[1], X) if len(loci) > 1 else None

    def _settle(self, body: str, X: Place) -> Settle | None:
        """The end of X, in a body with three loci: from an end found by them, and the two others."""
        own, loci = self._locus_of(X, body), list(self._loci(body, X))
        known = [place for place, _ in loci if place in self.drawn]
        if len(loci) < 2 or not own or not known:
            return None
        K = known[0]
        return Settle(body, K, own, next(locus for locus in loci if locus[0] != K))

    def _beside(self, body: str, X: Place) -> Figure | None:
        """The end of X, which has a locus of its own, in a body of which an end and the turning are known."""
        known, like = self._ends(body, X), self._like(body)
        return Figure(body, known[0], X, like=like) if known and like and self.facts.get(X) else None

    def _figure(self, body: str, X: Place) -> Move | None:
        """The end of X from the whole body, or from an end in the same spot."""
        here = next((place for place in self._together(body, X) if place in self.drawn), None)
        if here:
            return Figure(body, here, X)
        known = self._ends(body, X)
        pair = next((R for R in known[1:] if self.net.spot(R[0]) != self.net.spot(known[0][0])), None)
        if pair:
            return Figure(body, known[0], X, R=pair)
        if known and (like := self._like(body)):
            return Figure(body, known[0], X, like=like)
        return None

    def _crossed(self, body: str, X: Place) -> tuple[list[Move], Meet] | None:
        """The end of X from loci elsewhere in the body: two of them and its turning, or three; None of fewer."""
        loci, like = list(self._loci(body, X)), self._like(body)
        names = f"{body} once", f"{body} again"
        lines: list[Move] = []
        if like and len(loci) >= 2:
            lines += [Slip(body, locus, X, like, name) for locus, name in zip(loci, names, strict=False)]
        elif len(loci) >= 3:
            pairs = (loci[0], loci[1]), (loci[0], loci[2])
            lines += [Carry(body, A, B, X, name) for (A, B), name in zip(pairs, names, strict=True)]
        return (lines, Meet(X, names)) if lines else None

    def _begun(self, body: str, X: Place) -> list[Move]:
        """Moves for the end of X in a body that is known by loci elsewhere; without them X waits for other facts."""
        return []

    def _turning_known(self, body: str) -> None:
        if self.net.classes[body] not in self.turning and len({self.net.spot(X[0]) for X in self._ends(body)}) > 1:
            self.turning[self.net.classes[body]] = body
            self._wake_class(body)

    def _wake_class(self, body: str) -> None:
        if body in self.net.slides_of or self.net.turning:
            self._queue(*[b for b, c in self.net.classes.items() if c == self.net.classes[body] and b != body])

    # ---- sliding pairs --------------------------------------------------------------------------------------

    def _through_slide(self, slide: Slide) -> None:
        """A known end in one link's plane gives the other link one locus, once."""
        for known, new in ((slide.link, slide.along), (slide.along, slide.link)):
            if known in self.net.passive or slide.name in self.net.unguided:
                continue
            if slide.name not in self.passed and (point := self._seen(slide, known, new)):
                target = self.net.place(point, new)
                self.passed.add(slide.name)
                self._add_place(self.net.body[new], target)
                self.moves.append(Guide(slide, point, known, new))
                self._file(target, slide.name, 1)

    def _seen(self, slide: Slide, known: str, new: str) -> str:
        """A point whose end is known in the plane of `known`, not by way of this slide."""
        if self.net.body[new] == self.net.ground:
            return ""
        if self.net.body[known] == self.net.ground:
            own, at = self.net.links[new], self.net.name(slide.at)
            joints = [p for p in own if len(self.net.links_of[p]) > 1]
            return at if at in own else (joints or list(own) or [slide.at])[0]
        for place in self.places[self.net.body[known]]:
            told = sum(rank for source, rank in self.facts.get(place, {}).items() if source != slide.name)
            if place in self.drawn and told >= 2 and self.net.has(known, place):
                return place[0]
        return ""

    def _add_place(self, body: str, place: Place) -> None:
        if place not in self.places[body]:
            self.places[body].append(place)
