"""The board as a form of a compound sees it: what it draws with, and what it may ask of the drawn pose."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import Movement, Primitive
from graphplan.kernel.panel import EVERYWHERE
from graphplan.kernel.program import Mark, Verbs
from graphplan.kernel.tolerances import COINCIDENCE_TOL


class FormBoard(Verbs):
    """The board as a form sees it: the same verbs, compounds inside drawn out in turn; `letters` are marks it names."""

    def __init__(self, expander: Any):
        self._expander = expander  # of whose board it is the face
        self.letters: list[tuple[Mark, str]] = []

    def draw(self, op: Primitive, args: tuple[Mark, ...], name: str = "", **params: Any) -> Mark:
        if op.movement is Movement.RULED and self._nothing(self.distance(*args), *args):
            raise Undrawable("points-coincide", "the two points coincide but for rounding")
        mark = self._expander.draw(op, args, params, tried=True)
        return self.name_mark(mark, name) if name else mark

    def name_mark(self, mark: Mark, name: str) -> Mark:
        """A mark that the form has a name for."""
        self.letters.append((mark, name))
        return mark

    def made_by(self, mark: Mark) -> tuple[str, tuple[Mark, ...]]:
        """How a mark was drawn: the operation, as a compound if it was one, and what it read."""
        drawn = mark.step.op.name, tuple(self._expander.board.marks[arg] for arg in mark.step.args)
        made: dict[int, tuple[str, tuple[Mark, ...]]] = self._expander.made
        return made.get(mark.step.index, drawn)

    def place(self, P: Mark) -> tuple[float, float]:
        """Where a point lies."""
        x, y = self._expander.value(P)
        return x, y

    # What a draughtsman sees on the sheet, by which a form that is not for this pose gives nothing.

    def share_plan(self, *marks: Mark) -> bool:
        """Whether marks lie on one plan, so that they may be joined."""
        return self._expander.board.coplanar or len({mark.panel for mark in marks}) == 1

    def points_coincide(self, P: Mark, Q: Mark) -> bool:
        """Whether two points of a plan fall on one place."""
        return self.share_plan(P, Q) and self._nothing(self.distance(P, Q), P, Q)

    def equal(self, P: Mark, Q: Mark, R: Mark, S: Mark) -> bool:
        """Whether PQ is as long as RS."""
        return self._nothing(self.distance(P, Q) - self.distance(R, S), P, Q, R, S)

    def lies_on(self, P: Mark, l: Mark) -> bool:
        """Whether a point lies on a line of its plan."""
        (x, y), (a, b, c) = self._expander.value(P), self._expander.value(l)
        return self.share_plan(P, l) and self._nothing((a * x + b * y + c) / math.hypot(a, b), P, l)

    def lines_coincide(self, l: Mark, m: Mark) -> bool:
        """Whether two lines of a plan fall together."""
        (a, b, c), (u, v, w) = self._expander.value(l), self._expander.value(m)
        way, reach = complex(-b, a) / math.hypot(a, b), max(self._expander.reach[mark.step.index] for mark in (l, m))
        ends = (complex(-a * c, -b * c) / (a * a + b * b) + sign * reach * way for sign in (1, -1))
        return self.share_plan(l, m) and all(
            self._nothing((u * end.real + v * end.imag + w) / math.hypot(u, v), l, m) for end in ends)

    def in_line(self, P: Mark, Q: Mark, R: Mark) -> bool:
        """Whether R lies on the line of P and Q."""
        p, q, r = [complex(*self._expander.value(X)) for X in (P, Q, R)]
        return self._nothing(((q - p).conjugate() * (r - p)).imag / (abs(q - p) or 1.0), P)

    def sense_along(self, P: Mark, Q: Mark, R: Mark) -> str:
        """How R lies from P on the line PQ: further `on`, where Q is, or `back`."""
        p, q, r = (complex(*self._expander.value(X)) for X in (P, Q, R))
        return "on" if ((q - p).conjugate() * (r - p)).real >= 0 else "back"

    def side_of(self, P: Mark, Q: Mark, R: Mark) -> str:
        """On which side of the way from P to Q a point R lies."""
        p, q, r = (complex(*self._expander.value(X)) for X in (P, Q, R))
        return "left" if ((q - p).conjugate() * (r - p)).imag >= 0 else "right"

    def side_of_line(self, l: Mark, P: Mark) -> str:
        """On which side of a line, the way it runs, a point of its plan lies."""
        (x, y), (a, b, c) = self._expander.value(P), self._expander.value(l)
        return "left" if a * x + b * y + c >= 0 else "right"

    def distance(self, P: Mark, Q: Mark) -> float:
        return math.dist(self._expander.value(P), self._expander.value(Q))

    def _nothing(self, length: float, *marks: Mark) -> bool:
        """Whether a length is nothing beside the numbers that these marks were made from."""
        reach: list[float] = self._expander.reach
        return abs(length) <= COINCIDENCE_TOL * max([reach[mark.step.index] for mark in marks])

    def points_on(self, l: Mark) -> list[Mark]:
        """The points that a line was drawn through or that were drawn on it, the way it runs."""
        (a, b, _), values, marks = self._expander.value(l), self._expander.values, self._expander.board.marks
        through = (l.step.args[place] for place in l.step.op.claim_operands("on"))
        on = *through, *self._expander.points.on_curve(l.step.index)
        return [marks[k] for k in sorted(on, key=lambda k: values[k][0] * b - values[k][1] * a)]

    def on_sheet(self, P: Mark) -> bool:
        """Whether a point lies on the sheet of its plan."""
        return bool(self._expander.windows.get(P.panel, EVERYWHERE).holds(self._expander.value(P)))

    def drawable(self, P: Mark, length: float) -> bool:
        """Whether a length can be drawn on the plan of P; with compasses and straightedge alone nothing is computed."""
        return bool(self._expander.board.coplanar or self._expander.windows.get(P.panel, EVERYWHERE).shows(length))

    def clear_of(self, P: Mark, among: Sequence[Mark] | None = None) -> Mark | None:
        """The point furthest from P, of some or of all, on its plan if there is one; on the sheet, if there is one."""
        points = self._expander.points
        if among is None:
            places = points.on_plan(P.panel, True) or points.on_plan(P.panel, False)
        else:
            near = [X for X in among if X.panel == P.panel] or list(among)
            places = [X.step.index for X in [*filter(self.on_sheet, near)] or near]
        if not places:
            return None
        far = self._expander.board.marks[points.furthest(self._expander.value(P), places)]
        return None if self.points_coincide(P, far) else far
