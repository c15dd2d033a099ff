"""The pose on the board: the given points, the guides, and the letters that are free."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import MutableMapping

from graphplan.kernel.program import Board, Mark, Panel
from graphplan.mechanism.model import Slide
from graphplan.mechanism.replaced import RollingGuide, rolling_guides
from graphplan.methods.assembly import Assembler
from graphplan.methods.motion.network import BodyPoint, Network
from graphplan.methods.motion.stages import pitch_point, pitch_point_text
from graphplan.methods.panels import MECHANISM


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
        self._letters: dict[str, str] = {}
        self._free = [c for c in "QRSTUVWXYZHIJ" if c not in scene.points]

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
        """The line through the centres of two wheels, or square to the pitch line of a rack through that of its gear.
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
        """The letter of a body's auxiliary point: Q, R, S, ... in the order of asking."""
        if body not in self._letters:
            number = len(self._letters)
            self._letters[body] = self._free[number] if number < len(self._free) else f"Q_{number + 1}"
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
