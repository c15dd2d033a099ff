"""Friction on the drawing board: what the reactions of a plan without friction rub, as loads of a second plan.

In a journal the reaction touches the friction circle, against the turning; in a slide it leans by the friction angle,
against the sliding. Both follow from the reaction, so the plan is drawn without friction first, and then again (Ozols
1974, 9-1 and 12-4). The balances of the two plans give the instantaneous efficiency.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Friction, Slide
from graphplan.methods.forces import reaction_on
from graphplan.methods.loading import Acting, Lay, Loading
from graphplan.methods.panels import MECHANISM, link_named, slide_named
from graphplan.methods.reactions import Forces
from graphplan.methods.velocity import Velocity
from graphplan.phrases import said


class Rubbed:
    """The friction of a scene's pairs under known reactions."""

    def __init__(self, board: Board, velocity: Velocity, loading: Loading, forces: Forces):
        self.board, self.velocity, self.loading, self.forces = board, velocity, loading, forces
        self.scene, self.points = loading.scene, loading.pose.points
        self.slides = {(slide.link, slide.along): slide for slide in self.scene.slides}

    def drags(self, link: str) -> Iterator[tuple[str, Lay]]:
        """The friction forces of the slides of a link."""
        for friction in self.loading.loads.frictions:
            if friction.slide and link in friction.slide and friction.coefficient:
                slide = self.slides[friction.slide]
                yield slide.at, partial(self._drag, slide, friction, slide.link == link)

    def _drag(self, slide: Slide, friction: Friction, same: bool, start: Mark) -> Acting:
        """The friction force of a slide on the sliding link, or its answer on the guide's."""
        with self.board.on(MECHANISM, (slide.link, slide.along)):
            slip = self.velocity.slip(slide.along, slide.link, slide.at)
        why = said("{0}, the friction of the slide {1}", f"F_{slide.link}", slide_named(slide))
        tip = self.board.drag(self.points[slide.at], slip, *self.forces.slides[slide], start,
                              coefficient=friction.coefficient, why=why)
        if not same:
            tip = self.board.transfer(tip, start, start)
        return Acting(self.points[slide.at], start, tip, f"F_{slide.link}")

    def couples(self, link: str, start: Mark) -> Iterator[tuple[Acting, Acting]]:
        """The friction couples of the journals of a link, as pairs of forces; each pair's links have it opposite."""
        for friction in self.loading.loads.frictions:
            if not friction.at or not friction.radius * friction.coefficient:
                continue
            pin, *others = self.scene.links_of[friction.at]
            for other in others:
                if link == other:
                    yield self._couple(friction, other, pin, start)
                elif link == pin:
                    force, answer = self._couple(friction, other, pin, start)
                    yield force.reversed, answer.reversed

    def _couple(self, friction: Friction, link: str, pin: str, start: Mark) -> tuple[Acting, Acting]:
        name = self._arm(friction.at, link if link != FRAME else pin)
        P, R = self.points[friction.at], self.points[name]
        with self.board.on(MECHANISM, (link, pin)):
            slip = self.velocity.slip(pin, link, name)
        why = said("the friction of the journal {0}, of {1} in {2}", friction.at, *map(link_named, (link, pin)))
        radius = friction.radius * friction.coefficient
        reaction = reaction_on(self.scene, self.forces, self.board, friction.at, link)
        tip = self.board.journal(P, R, slip, *reaction, start, radius=radius, why=why)
        letter = f"M_{friction.at}"
        return Acting(R, start, tip, letter), Acting(P, tip, start, letter)

    def _arm(self, point: str, link: str) -> str:
        """Another point of a link than the journal."""
        one, two = self.loading.arm_points(link)
        return two if one == point else one
