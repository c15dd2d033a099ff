"""A figure far off zero is drawn about a place of its own: no digit of it is lost for lying there."""

from __future__ import annotations

import math
from fractions import Fraction

from graphplan.check.cycle import cycle
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.kernel.origin import origin
from graphplan.kernel.program import about_origin, evaluate
from graphplan.mechanism.scene import load, parse
from graphplan.methods.construct import construct

FAR = 10**6


def _moved(name: str) -> str:
    """A packaged scene whose only coordinates are those of its [points], moved far off."""
    lines = load(name).text.splitlines()
    start = lines.index("[points]") + 1
    for number, line in enumerate(lines[start:], start):
        key, equals, at = line.partition("= [")
        if line.startswith("["):
            break
        if equals:
            x, y = at.partition("]")[0].split(",")
            lines[number] = f"{key}= [{Fraction(x) + FAR}, {Fraction(y) - FAR}]"
    return "\n".join(lines)


def test_a_place_is_taken_within_points_that_lie_far_off() -> None:
    """Round beside their extent; none where they lie about zero, or all in one place."""
    far = origin([(FAR, 0.5), (FAR + 3, 7.25)])
    assert far is not None
    assert abs(far.x - FAR) <= 8
    assert abs(far.y) <= 16
    assert origin([(0, 0), (3, 7)]) is origin([(FAR, FAR)]) is origin([]) is None


def test_marks_lie_where_they_are_though_they_are_drawn_about_that_place() -> None:
    """In fractions every mark of the moved pose is that of the pose, moved, on the plan of its points alone."""
    here, there = (construct(parse(text, "x")).program for text in (load("jaanimets-10").text, _moved("jaanimets-10")))
    moved = {POINT: lambda v: (v[0] + FAR, v[1] - FAR), CIRCLE: lambda v: (v[0] + FAR, v[1] - FAR, v[2]),
             LINE: lambda v: (v[0], v[1], v[2] - v[0] * FAR + v[1] * FAR)}
    posed = here.steps[0].panel
    values = evaluate(here, Fractions()), evaluate(there, Fractions())
    assert there.origin is not None
    assert len(values[0]) == len(values[1])
    for step, one, two in zip(here.steps, *values, strict=True):
        assert two == (moved[step.op.gives](one) if step.panel == posed and step.op.gives in moved else one), step.name


def test_no_digit_is_lost_far_off() -> None:
    """About their place floats give the pose's marks to rounding, and around the cycle construction and solver agree
    as well as at zero."""
    scene = parse(_moved("triad"), "x")
    program, at_home = construct(scene).program, construct(load("triad")).program
    assert program.origin is not None
    shift = float(program.origin.x) - FAR, float(program.origin.y) + FAR
    marks = about_origin(program, Floats()), evaluate(at_home, Floats())
    for step, far, near in zip(program.steps, *marks, strict=True):
        if step.op.gives == POINT and step.panel == program.steps[0].panel:
            assert math.dist((far[0] + shift[0], far[1] + shift[1]), near) < 1e-11 * scene.extent, step.name
    found = cycle(scene, 12)
    assert found.wrong == ()
    assert max(found.check.values()) < 1e-13
