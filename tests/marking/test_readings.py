"""What a drawing is meant as: scale, sense and pole of its velocities are read from what its letters agree on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hands import draw, frames, points
from test_judge import PENCIL, composed

from graphplan.kernel.kinds import POINT
from graphplan.marking.judge.judge import judge_any_method
from graphplan.marking.judge.verdict import RIGHT, WRONG, Judgement
from graphplan.marking.traces import Submission, Trace

Change = Callable[[complex, complex], complex]  # where the end of a velocity is drawn, by its point and its true end


def drawn(change: Change, *, only: str = "", spoiled: str = "", scene: str = "four-bar") -> Judgement:
    """The judgement of a drawing whose velocities, or only one of them, are changed, and one is spoiled; those of their
    plan alone."""
    task, sheet = composed(scene)
    whole = points(draw(task, frames(task, sheet), PENCIL, 1))
    spots = {trace.label: complex(*trace.spots[0]) for trace in whole.traces}

    def changed(trace: Trace) -> Trace:
        if not trace.label.startswith("v_") or only not in ("", trace.label):
            return trace
        spot = change(spots[trace.label[2:].upper()], spots[trace.label])
        return replace(trace, spots=((spot.real + 9.0 * (trace.label == spoiled), spot.imag),))

    kept = [changed(trace) for trace in whole.traces if trace.panel == "mechanism" and not trace.label.isdigit()]
    return judge_any_method(task, sheet, Submission("x.csv", tuple(kept), shows=whole.shows), PENCIL)


def wrong(found: Judgement) -> list[str]:
    return [found.drawing.drawn.steps[one.step].name for one in found.verdicts if one.state == WRONG]


@pytest.mark.parametrize(("change", "told"), [
    (lambda at, end: at + 0.5 * (end - at), "k_v = "),
    (lambda at, end: at - (end - at), "velocities turned clockwise"),
    (lambda at, end: at - 1j * (end - at), "true velocities at their points"),
])
def test_velocities_that_all_differ_alike_are_right_and_said_so(change: Change, told: str) -> None:
    """Half as long, turned the other way, or not turned at all: as the student chose to draw them."""
    found = drawn(change)
    assert not wrong(found)
    assert told in found.reading


def test_a_single_vector_of_another_scale_is_wrong() -> None:
    """Where the others are as the task's sheet has them, no scale excuses one."""
    found = drawn(lambda at, end: at + 0.5 * (end - at), only="v_b")
    assert wrong(found) == ["v_b"]
    assert not found.reading


@pytest.mark.costly
def test_a_mistake_in_a_drawing_of_another_scale_is_found() -> None:
    """Velocities are half as long, and the one that is drawn last is 9 mm off."""
    task, _ = composed("stephenson")
    last = [step.name for step in task.drawn.steps if step.name.startswith("v_")][-1]
    halved = drawn(lambda at, end: at + 0.5 * (end - at), scene="stephenson")
    spoiled = drawn(lambda at, end: at + 0.5 * (end - at), scene="stephenson", spoiled=last)
    assert not wrong(halved)
    assert wrong(spoiled) == [last]
    assert "k_v" in spoiled.reading


@pytest.mark.parametrize("plan", ["", "polar"])
@pytest.mark.parametrize(("turn", "right"), [(1, True), (1j, False)])
def test_a_polar_plan_has_its_own_place_and_scale_but_not_its_own_direction(turn: complex, right: bool,
                                                                            plan: str) -> None:
    """True velocities from a pole are square to what is drawn of the mechanism, whatever plan the task has."""
    task, sheet = composed("four-bar", "", plan)
    given = [trace for trace in points(draw(task, frames(task, sheet), PENCIL, 1)).traces
             if trace.label in task.scene.points]
    long = 50.0 / max(map(abs, task.velocity.values()))
    spots = {"p": 0j, **{name.lower(): long * turn * v for name, v in task.velocity.items()}}
    plan = [Trace(POINT, ((300 + z.real, 100 + z.imag),), name) for name, z in spots.items()]
    found = judge_any_method(task, sheet, Submission("x.csv", (*given, *plan), shows=frozenset({POINT})), PENCIL)
    states = {found.drawing.drawn.text(verdict.step): verdict.state for verdict in found.verdicts}
    assert (states["b" if "p" in states else "v_b"] == RIGHT) == right


def test_a_mirrored_sheet_is_read_so() -> None:
    """Coordinates measured downward are those of a mirrored sheet."""
    task, sheet = composed("four-bar")
    whole = points(draw(task, frames(task, sheet), PENCIL, 1))
    turned = tuple(replace(trace, spots=tuple((x, -y) for x, y in trace.spots)) for trace in whole.traces)
    found = judge_any_method(task, sheet, replace(whole, traces=turned), PENCIL)
    assert not wrong(found)
    assert "mirrored" in found.reading
