"""The mechanism plan itself: how its points are laid out, where the scene places them by compasses or protractor.

The pose of a construction is given; this is a program of its own that draws the pose from the scene's placements, for
those who begin with an empty sheet.
"""

from __future__ import annotations

from graphlib import TopologicalSorter
from typing import Any

from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, Mark, Program
from graphplan.mechanism.fields import vector
from graphplan.mechanism.model import Placement, Scene
from graphplan.mechanism.numbers import exactly
from graphplan.mechanism.placements import needs
from graphplan.phrases import digits, said


def layout(scene: Scene) -> Program:
    """The steps that put every point of the scene in its place, each after those it is measured from; where the pose is
    constructed, those that stand still."""
    board = Board()
    marks: dict[str, Mark] = {}
    waiting = {name: [p for p in needs(placement) if p in scene.placements] for name, placement in
               scene.placements.items()}
    order = list(TopologicalSorter(waiting).static_order())
    for name, placement in scene.placements.items():
        line: Any = placement.data.get("on")
        if placement.how == "arc-line" and not isinstance(line["through"], str):
            x, y = line["through"]
            marks[name + "_0"] = board.given(x=x, y=y, name=name + "_0")
    for name in sorted(order, key=lambda point: scene.placements[point].how != "given"):
        marks[name] = board.give_name(_draw_point(board, scene, name, scene.placements[name], marks), name)
    return freeze(board, [marks[name] for name in scene.points if name in marks])


def _draw_point(board: Board, scene: Scene, name: str, placement: Placement, marks: dict[str, Mark]) -> Mark:
    """One point, by the instruments that its placement names."""
    data: dict[str, Any] = placement.data
    match placement.how:
        case "polar":
            start = scene.points[data["from"]]
            dx, dy = (p - q for p, q in zip(scene.points[name], start, strict=True))
            distance, angle = (digits(float(data[key]), 6) for key in ("distance", "angle"))
            why = said("{0} long, at {1} degrees from +x", distance, angle)
            return board.lay_off(marks[data["from"]], dx=dx, dy=dy, why=why)
        case "compass":
            one, two = (_arc(board, marks[centre], r) for centre, r in data["distances"].items())
            return board.circles_meet(one, two, side=data["side"])
        case "arc-line":
            ((centre, r),) = data["distances"].items()
            way = "on" if data["pick"] == "right" else "back"
            guide = _guide(board, scene, name, data["on"], marks)
            return board.line_meets_circle(guide, _arc(board, marks[centre], r), way=way)
        case "on-line":
            one, two = (marks[end] for end in data["on"].split())
            if not data["distance"]:
                return one
            way = "on" if data["distance"] > 0 else "back"
            return board.line_meets_circle(board.line(one, two), _arc(board, one, abs(data["distance"])), way=way)
        case "turned down":
            centre, arm = (marks[end] for end in data["from"].split())
            return _turned_down(board, centre, arm, data)
    x, y = scene.points[name]
    return board.given(x=x, y=y)


def _arc(board: Board, centre: Mark, radius: Any) -> Mark:
    return board.circle(centre, board.radius(length=radius))


def _turned_down(board: Board, centre: Mark, arm: Mark, data: dict[str, Any]) -> Mark:
    """The end of a joint's arm turned down into the plane of drawing about the trace, and a share of the arm there."""
    dx, dy = data["trace"]
    if data.get("flat"):
        return board.foot(board.guide(centre, dx=dx, dy=dy), arm)
    if data["cosine"] != 1:
        foot = board.foot(board.guide(centre, dx=dx, dy=dy), arm)
        arm = board.step_off(foot, arm, foot, ratio=1 / data["cosine"], why=said(
            "the circle turned down about the trace: heights over it grow as 1 : cos delta, {0}",
            digits(float(data["cosine"]), 6)))
    return board.step_off(centre, arm, centre, ratio=data["share"],
                          why=said("the crank that moves as the joint in space does, seen in the plane"))


def _guide(board: Board, scene: Scene, name: str, on: dict[str, Any], marks: dict[str, Mark]) -> Mark:
    """The line of an arc-and-line placement."""
    through = marks[on["through"]] if isinstance(on["through"], str) else marks[name + "_0"]
    dx, dy, _ = vector(on["direction"], lambda point: exactly(scene.points[point]))
    return board.guide(through, dx=dx, dy=dy)
