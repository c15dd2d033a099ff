"""Force plans: how the moves of statics are drawn, one force polygon for each group.

The loads of a group's links stand in one chain, link after link; the reactions close it. Tangential parts come from
moments, lines of action from the mechanism plan, and the corner that is looked for is where two lines meet, as on the
drawing board (Ozols 1974, 10-2; Jaanimets 1966, 14).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from fractions import Fraction
from functools import partial

from graphplan.kernel.program import Mark
from graphplan.kernel.stages import Knowledge as Told
from graphplan.kernel.stages import Teller, Vector
from graphplan.mechanism.model import FRAME, Balance, Slide
from graphplan.methods.forces import stages, statics
from graphplan.methods.forces.free_bodies import (
    CentreMoment,
    FreeBodies,
    KnownForce,
    Pair,
    Shown,
    Span,
    reaction_letter,
    with_sign,
)
from graphplan.methods.forces.loading import Acting
from graphplan.methods.forces.unknown_forces import Part, UnknownForce
from graphplan.methods.panels import MECHANISM, JointForce, list_links
from graphplan.phrases import said

TRIAL_RATIOS = Fraction(3, 10), Fraction(-2, 5)  # how large a force is assumed, in lengths of the mechanism


class ForcePolygon(FreeBodies):
    """Draws the moves of one group on a panel of its own, and enters the reactions in `forces`."""

    # ---- moves -------------------------------------------------------------------------------------------------

    def draw(self, moves: Iterable[statics.StaticMove]) -> None:
        for move in moves:
            links = tuple(move.part) if not isinstance(move, statics.PinBalance) else (move.site.link,)
            with self.board.on(self.panel, tuple(self._in_order(links)), self._stage(move)):
                self._draw(move)

    def _stage(self, move: statics.StaticMove) -> Teller:
        """Stage of a move: the equilibrium that it uses, and what is known of its forces."""
        match move:
            case statics.LineFact(part, site, about) | statics.ForceFact(part, site, about):
                line = isinstance(move, statics.LineFact) and isinstance(site, JointForce)
                letter = self.letter(site, part="T" if line else "")
                if isinstance(about, statics.AcrossSlide | statics.AcrossLine):
                    return partial(stages.component_stage, letter, self._in_order(part))
                told = Vector(letter, Told.DIRECTION) if line else self.unknown(part, site)
                return self._moments_of(part, letter, self._moment_centre_text(about), told)
            case statics.Close(part, Balance(at="") as site):
                at = self.loading.arm_points(site.link)[0]
                return self._moments_of(part, self.letter(site), at, self.unknown(part, site))
            case statics.Close(part, site):
                return self._closing(part, site)
            case statics.ClosePolygon(part, one, two):
                return self._closing(part, one, two)
            case statics.PinBalance(site):
                others = [link for link in self.group.scene.links_of[site.point] if link != site.link]
                forces = [Vector(reaction_letter(self.forces.scene, site.point, link)) for link in others]
                return stages.joint(site.point, (*forces, Vector(self.letter(site), Told.NOTHING)))
            case statics.Assume(site=site):
                return stages.false_position(self.letter(site))

    def _moments_of(self, part: Part, letter: str, about: str, unknown: Vector) -> Teller:
        """The moments of the forces on a part, and those of couples."""
        links = self._in_order(part)
        couples = [name for link in links for pair in self.couples[link] if (name := pair[0].name)]
        return partial(stages.moments, letter, links, about, (*self.vectors(part), unknown), couples)

    def _closing(self, part: Part, *sites: UnknownForce) -> Teller:
        """The polygon that forces close."""
        forces = *self.vectors(part), *(self.unknown(part, site) for site in sites)
        return partial(stages.polygon_stage, ", ".join(map(self.letter, sites)), self._in_order(part), forces)

    def _in_order(self, part: Collection[str]) -> list[str]:
        return [link for link in self.group.links if link in part]

    def _draw(self, move: statics.StaticMove) -> None:
        match move:
            case statics.LineFact(part, site, about):
                self.known[site] = self._moment_component(part, site, about)
            case statics.ForceFact(part, site, about):
                self._draw_force_of_known_line(part, site, about)
            case statics.ClosePolygon(part, one, two):
                self._close_two(part, one, two)
            case statics.Close(part, site):
                self._close(part, site)
            case statics.PinBalance(site):
                self._pin(site)
            case statics.Assume():
                self._trial(move)

    def _moment_component(self, part: Part, site: UnknownForce, about: statics.About) -> KnownForce:
        """Component of a force that a part's equilibrium about a point determines."""
        sign = self.sign(part, site)
        if isinstance(about, statics.AcrossSlide | statics.AcrossLine):
            return self._component_across(part, site, about, sign)
        if isinstance(site, Slide):
            return self._slide_line(part, site, about, sign)
        X = self.seat(site)
        line = self._line_to(about, X)
        load = self._moments(part, site, about, X, sign)
        return KnownForce(load, line, X)

    def _line_to(self, about: statics.About, X: Mark) -> Mark:
        """The line of action through a point and the point that moments are taken about."""
        with self.board.on(MECHANISM):
            if isinstance(about, statics.AtPoint):
                return self.board.side(self.pose.points[about.point], X)
            assert isinstance(about, statics.AtCrossing)
            return self.board.towards(*self._lines(about), X, names=self._letters(about))

    def _lines(self, about: statics.AtCrossing) -> Span:
        return self.known[about.one].acting, self.known[about.two].acting

    def _letters(self, about: statics.AtCrossing) -> dict[str, str]:
        return {"Q": self.pose.letter(" ".join(sorted((about.one.link, about.two.link))))}

    def _moments(self, part: Part, site: UnknownForce, about: statics.About, X: Mark, sign: int,
                 base: Mark | None = None) -> Span | None:
        """The force at X, perpendicular to its line, that balances all known forces on the part; None if there is no
        such force.

        If the part begins the group's chain it is laid off backwards, so that it ends where the chain starts.
        """
        backwards = base is None and self.group.links[0] in part and self.group.is_outer(site) and sign > 0
        start, end = self.polygon(part) if base is None else (base, base)
        mark = first = start if backwards else end
        pole, weigh = self._weighing(about, X)
        why = said("moments of {0} about {1}", list_links(self._in_order(part)), self._moment_centre_text(about))
        for force in self.acting(part, self.other_forces(part, site), site):
            if force.at is not pole:
                span = with_sign((force.tail, force.head), -sign if backwards else sign)
                follows = mark is not first and self._is_square(part, force, pole, X)
                balance = self._opposite if follows else weigh  # a first force has the words of the moment equation
                mark = balance(force.at, *span, mark, why=why)
        if mark is first:
            return None
        return (mark, first) if backwards else (first, mark)

    def _is_square(self, part: Part, force: Acting, pole: Mark | None, X: Mark) -> bool:
        """Whether a force at X is perpendicular to its way to the pole: that of a couple with its answer there."""
        return any(force is one and one.at is X and other.at is pole for link in part
                   for pair in self.couples[link] for one, other in (pair, pair[::-1]))

    def _opposite(self, at: Mark, tail: Mark, head: Mark, base: Mark, why: str = "") -> Mark:
        """The end of the opposite of a couple's force, laid off from a mark: with the same arm it has the opposite
        moment."""
        return self.board.transfer(head, tail, base, why=said("the opposite couple has the same arm"))

    def _weighing(self, about: statics.About, X: Mark) -> tuple[Mark | None, Callable[..., Mark]]:
        """The point that moments are taken about, if it is a mark, and how a moment is weighed at X."""
        if isinstance(about, statics.AtPoint):
            pole = self.pose.points[about.point]
            return pole, partial(self.board.balance, pole, X)
        assert isinstance(about, statics.AtCrossing)
        return None, partial(self.board.weigh, *self._lines(about), X, names=self._letters(about))

    def _moment_centre_text(self, about: statics.About) -> str:
        """The point that moments are taken about, in words."""
        if isinstance(about, statics.AtPoint):
            return self.pose.letter_of_point(about.point)
        return said("the auxiliary point")

    def _slide_line(self, part: Part, slide: Slide, about: statics.About, sign: int) -> KnownForce:
        """Line of a slide's reaction: it passes through the point about which no other force has a moment but the known
        couple."""
        Y = self._mark_of(about)
        with self.board.on(MECHANISM):
            line = self.board.perpendicular(self.pose.guide(slide), Y)
        return KnownForce(None, line, Y, self._pair(part, slide, Y, sign))

    def _mark_of(self, about: statics.About) -> Mark:
        """The point that moments are taken about, as a mark."""
        if isinstance(about, statics.AtPoint):
            return self.pose.points[about.point]
        assert isinstance(about, statics.AtCrossing)
        with self.board.on(MECHANISM):
            return self.board.meet(*self._lines(about), name=self._letters(about)["Q"])

    def _pair(self, part: Part, site: UnknownForce, Y: Mark, sign: int) -> Pair | None:
        """The couple that balances all known forces on the part about a point, as a pair of forces there."""
        assert isinstance(site, Slide | Balance)
        R = self._arm_beside(site, Y)
        if isinstance(site, Balance) and FRAME in site.links and len(part) == 1:
            self._record_moment(part, site, Y, sign)
        mark = first = self.polygon(part)[1]
        for force in self.acting(part, self.other_forces(part, site), site):
            if force.at is not Y:
                follows = mark is not first and self._is_square(part, force, Y, R)
                balance = self._opposite if follows else partial(self.board.balance, Y, R)
                mark = balance(force.at, *with_sign((force.tail, force.head), sign), mark)
        return None if mark is first else (Acting(R, first, mark), Acting(Y, mark, first))

    def _record_moment(self, part: Part, site: Balance, Y: Mark, sign: int) -> None:
        """Record the forces that a balancing moment opposes, where all of them stand on this plan.

        The force of the frame has no moment about the point where it acts; a journal that rubs shifts that.
        """
        borne = [self.seat(other) for other, _ in self.group.boundary(part) if isinstance(other, JointForce)
                 and FRAME in self.group.scene.links_of[other.point]]
        Y = borne[0] if len(borne) == 1 else Y
        forces = [force for force in self.acting(part, self.other_forces(part, site), site)
                  if force.at is not Y and force.tail is not force.head]
        if forces and all(force.tail.panel == self.panel for force in forces):
            couples = [pair[0].name for pair in self.couples[site.link]]
            told = Vector(self.letter(site), Told.DIRECTION)
            names = [Vector(force.name) for force in forces if force.name and force.name not in couples]
            stage = partial(stages.moments, self.letter(site), (site.link,), Y.step.name, (*names, told),
                            couples)
            opposing = tuple(Acting(force.at, *with_sign((force.head, force.tail), sign), force.name)
                             for force in forces)
            square = couples if Y is self.loading.arm(site.link)[0] else ()
            self.forces.about_centres[site] = CentreMoment(site.link, Y, opposing, square, stage)

    def _arm_beside(self, site: Slide | Balance, Y: Mark) -> Mark:
        """A point at which a pair with Y has a good arm."""
        one, two = self.loading.arm(site.link)
        return one if two is Y or two.step.params == Y.step.params else two  # two given points may coincide

    def _component_across(self, part: Part, site: UnknownForce, about: statics.AcrossSlide | statics.AcrossLine,
                          sign: int) -> KnownForce:
        """No moments: what the forces along a direction leave unknown is told by those across it."""
        start, end = self.polygon(part, self.parts_of(self.other_forces(part, site)), (site,))
        with self.board.on(MECHANISM):
            if isinstance(about, statics.AcrossSlide):
                guide = self.pose.guide(about.slide)
                line = self.board.perpendicular(guide, self.pose.points[about.slide.at])
            else:
                line = self.known[about.site].acting
        if isinstance(site, Slide):
            return self._slide_size(site, line, start, end, sign)
        X = self.seat(site)
        with self.board.on(MECHANISM):
            through = self.board.parallel(line, X)
        return KnownForce(None if start is end else with_sign((end, start), sign), through, X)

    def _slide_size(self, slide: Slide, line: Mark, start: Mark, end: Mark, sign: int) -> KnownForce:
        """A slide's reaction closes the polygon with a force of known direction; where it acts is not told."""
        with self.board.on(MECHANISM):
            normal = self.board.perpendicular(self.pose.guide(slide), self.pose.points[slide.at])
        corner = self.board.meet(self.board.parallel(normal, end), self.board.parallel(line, start))
        return KnownForce(with_sign((end, corner), sign), None, None)

    def _draw_force_of_known_line(self, part: Part, site: UnknownForce, about: statics.About) -> None:
        """A force of known line, from moments about a point that its line does not pass; or a couple."""
        sign = self.sign(part, site)
        known = self.known.get(site)
        if isinstance(site, Balance) and not site.at:
            self.pairs[site] = self._pair(part, site, self._mark_of(about), sign)
            return
        assert known is not None
        if known.line is None:
            self._couple_found(part, site, known, self._mark_of(about))
            return
        if isinstance(about, statics.AcrossSlide | statics.AcrossLine):
            told = self._component_across(part, site, about, sign)
            if told.line is None:
                assert told.part is not None
                self._enter(site, told.part)
                return
            base = told.part[0] if told.part else self.polygon(part)[1]
            second = told.line, told.part
        else:
            base = known.part[0] if known.part else self.polygon(part)[1]
            second = self._line_to(about, self.acts_at(site, known)), self._moments(
                part, site, about, self.acts_at(site, known), sign, base)
        assert second[0] is not None
        corner = self.board.meet(self._locus(known.line, known.part, base), self._locus(second[0], second[1], base))
        self._enter(site, (base, corner))

    def _locus(self, line: Mark, part: Span | None, base: Mark) -> Mark:
        """Locus of the head of a force that is laid off from `base`: its component across the line is known."""
        head = base if part is None else part[1] if part[0] is base else self.board.transfer(*part, base)
        return self.board.parallel(line, head)

    def _tail_locus(self, line: Mark, part: Span | None, corner: Mark) -> Mark:
        """Locus of the tail of a force that ends in `corner`."""
        tail = corner if part is None else part[0] if part[1] is corner else self.board.transfer(*part[::-1], corner)
        return self.board.parallel(line, tail)

    def _enter(self, site: UnknownForce, span: Span) -> None:
        """A force is found; a slide's acts where its line says, with the pair known besides."""
        self.ends[site] = span
        for mark in span:
            self.number_corner(mark)
        known = self.known.get(site)
        if isinstance(site, Slide):
            if known is not None and known.at is not None:
                self.seats[site] = known.at
                self.pairs[site] = known.pair
            else:
                self.seats[site] = self.pose.points[site.at]

    def _close_two(self, part: Part, one: UnknownForce, two: UnknownForce) -> None:
        """The corner between two forces of known lines."""
        start, end = self.polygon(part)
        first, last = self.known[one], self.known[two]
        signs = self.sign(part, one), self.sign(part, two)
        tails = first.part and with_sign(first.part, signs[0])
        heads = last.part and with_sign(last.part, signs[1])
        corner = self.board.meet(self._tail_locus(first.acting, tails, start), self._locus(last.acting, heads, end))
        self._enter(one, with_sign((corner, start), signs[0]))
        self._enter(two, with_sign((end, corner), signs[1]))

    def _close(self, part: Part, site: UnknownForce) -> None:
        """The last force of a part closes its polygon; of a slide, and of a couple, the moment too."""
        sign = self.sign(part, site)
        known = self.known.get(site)
        if isinstance(site, Balance) and not site.at:
            one = self.loading.arm(site.link)[0]
            self.pairs[site] = self._pair(part, site, one, sign)
            return
        if known is not None and known.line is None and known.part is not None:
            assert isinstance(site, Slide)
            self._couple_found(part, site, known, self.pose.points[site.at])
            return
        start, end = self.polygon(part, self.parts_of(self.other_forces(part, site)), (site,))
        self._enter(site, with_sign((end, start), sign))
        if isinstance(site, Slide) and site not in self.pairs:
            Y = self.pose.points[site.at]
            self.pairs[site] = self._pair(part, site, Y, sign)

    def _couple_found(self, part: Part, site: UnknownForce, known: KnownForce, Y: Mark) -> None:
        """The couple of a slide's reaction of known size, which is taken to act at its point, by moments about Y."""
        assert isinstance(site, Slide)
        assert known.part is not None
        self.pairs[site] = self._pair(part, site, Y, self.sign(part, site))
        self.ends[site], self.seats[site] = known.part, self.pose.points[site.at]

    def _pin(self, site: JointForce) -> None:
        """The forces on the links of a joint balance."""
        mark = first = self.origin
        others = [link for link in self.group.members(site.point) if link != site.link]
        spans = [self.ends[JointForce(site.point, link)] for link in others]
        spans += [self.forces.joints[site.point, link] for link in self.group.scene.links_of[site.point]
                  if link in self.group.done]
        for tail, head in spans:
            mark = self.board.transfer(tail, head, mark)
        self.ends[site] = mark, first

    # ---- trials ------------------------------------------------------------------------------------------------

    def _trial(self, move: statics.Assume) -> None:
        """Two forces assumed on the known line, the false position, then the true force by the same moves."""
        known = self.known[move.site]
        base = known.part[0] if known.part else self.polygon(move.part)[1]
        locus = self._locus(known.acting, known.part, base)
        arm = self.loading.arm(self.group.links[0])
        before = dict(self.known), dict(self.ends), dict(self.pairs), dict(self.seats)
        trials: list[Mark] = []
        for number, ratio in enumerate(TRIAL_RATIOS, 1):
            with self.board.on(retell=partial(stages.in_trial, number, self.board.retell)):
                start = self.board.pick(locus, base, base, *arm, ratio=ratio)
                self._enter(move.site, (base, start))
                self.draw(move.moves)
                trials += [start, *self._trial_error(move)]
            self.known, self.ends = dict(before[0]), dict(before[1])
            self.pairs, self.seats = dict(before[2]), dict(before[3])
        A1, Z1, l1, A2, Z2, l2 = trials
        self._enter(move.site, (base, self.board.false_position(A1, A2, Z1, l1, Z2, l2)))
        self.draw(move.moves)

    def _trial_error(self, move: statics.Assume) -> Span:
        """The head of a force found by a trial, and the line on which it should lie."""
        told = self._moment_component(move.part, move.end, move.about)
        tail, head = self.ends[move.end]
        return head, self._locus(told.acting, told.part, tail)

    # ---- what is found -----------------------------------------------------------------------------------------

    def zero_reactions(self) -> None:
        """Enter all reactions as zero."""
        for part in self.group.connected_parts:
            for site, _ in self.group.boundary(part):
                self._enter(site, (self.origin, self.origin))
                self.pairs[site] = None

    def enter(self) -> None:
        """Tell the groups that follow what was found here."""
        with self.board.on(self.panel, self.group.links):
            for point in self.group.points:
                with self.board.on(stage=stages.joint(point)):
                    for link in self.group.members(point):
                        self.forces.joints[point, link] = self._at_joint(point, link)
        for site, span in self.ends.items():
            self.forces.shown.append(Shown("balance" if isinstance(site, Balance) else "reaction",
                                           self.letter(site), *span))
            part = self.known[site].part if site in self.known else None
            if part is not None and self.known[site].line is not None:
                self.forces.shown.append(Shown("part", "T" + self.letter(site)[1:], *part))
            if isinstance(site, Slide):
                self.forces.slides[site] = span
                self.forces.pairs[site], self.forces.seats[site] = self.pairs.get(site), self.seats[site]
            elif isinstance(site, Balance) and site.at:
                self.forces.balances[site] = span
        for site, pair in self.pairs.items():
            if isinstance(site, Balance) and not site.at:
                self.forces.moments[site] = pair
                if pair is not None:
                    self.forces.shown.append(Shown("balance", self.letter(site), pair[0].tail, pair[0].head))

    def _at_joint(self, point: str, link: str) -> Span:
        """The force on a link at a joint, from the pin: found, or what is left by the others there."""
        if JointForce(point, link) in self.ends:
            return self.ends[JointForce(point, link)]
        spans = [(force.tail, force.head) for force in self.from_done(point)]
        spans += [self.ends[JointForce(point, other)][::-1] for other in self.group.members(point) if other != link]
        mark = first = spans[0][0]
        for tail, head in spans:
            mark = head if tail is mark else self.board.transfer(tail, head, mark)
        return first, mark
