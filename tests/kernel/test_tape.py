"""The tape of a program gives the numbers of its rules, one pose at a time and in blocks."""

from __future__ import annotations

from functools import cached_property
from random import Random
from typing import Any

import numpy as np
import pytest
from each import each
from figures import LENGTHS, NAMES, Place, corners, drawn, extremes, figure, quarters

from graphplan.kernel import TABLE, Board, Program
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import evaluate
from graphplan.kernel.tape import blocks
from graphplan.kernel.tape.blocks import Blocks
from graphplan.kernel.tape.machine import Machine
from graphplan.kernel.tape.record import Symbols
from graphplan.kernel.tape.written import function

PLACES = each("place", [quarters, corners, extremes])


class Recorded:
    """The tape of a program whose points are free; the numbers of its last mark are told."""

    def __init__(self, program: Program):
        domain = Symbols()
        self.points = [step.name for step in program.steps if step.op.name == "given"]
        given = {name: {axis: domain.tape.input(name + axis) for axis in "xy"} for name in self.points}
        values = evaluate(program, domain, given)
        self.tape = domain.tape
        self.inputs = [given[name][axis].place for name in self.points for axis in "xy"]
        self.outputs = [self.tape.place(number) for number in values[-1]]

    @cached_property
    def written(self) -> Any:
        """The function that is written out of the tape."""
        return function(self.tape, self.inputs, tuple(self.outputs))

    def one(self, pose: list[float]) -> tuple[float, ...] | None:
        try:
            found: tuple[float, ...] | None = self.written(*pose)
        except (ZeroDivisionError, OverflowError):
            return None
        return found

    def many(self, poses: Any, machine: bool = False) -> tuple[Any, Any]:
        found = [np.full(len(poses), np.nan) for _ in self.outputs]
        reading = (Machine if machine else Blocks)(self.tape, self.inputs, self.outputs)
        left = reading.run(list(np.ascontiguousarray(poses.T)), found)
        return np.array(found).T, left


def some_poses(recorded: Recorded, r: Random, place: Place, n: int) -> list[list[float]]:
    return [[float(x) for _ in recorded.points for x in place(r)] for _ in range(n)]


def by_rules(program: Program, recorded: Recorded, pose: list[float]) -> tuple[float, ...] | None:
    pairs = zip(recorded.points, zip(pose[::2], pose[1::2], strict=True), strict=True)
    values = drawn(program, Floats(), **{name: {"x": x, "y": y} for name, (x, y) in pairs})
    return None if values is None else values[-1]


RECORDED = [name for name in NAMES if TABLE[name].reads]  # the others read no number that could change


@PLACES
@each("name", RECORDED)
def test_written_out_equals_the_rule(name: str, place: Place) -> None:
    """The written function gives the rule's floats exactly, and hands back every pose that the rule refuses."""
    r = Random(name)
    for _ in range(2):
        program = figure(name, r)
        recorded = Recorded(program)
        for pose in some_poses(recorded, r, place, 30):
            assert recorded.one(pose) == by_rules(program, recorded, pose)


@PLACES
@pytest.mark.parametrize("name", RECORDED)
def test_blocks_equal_the_rule(name: str, place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks give the rule's floats exactly, and leave to it the poses that it refuses and no others."""
    monkeypatch.setattr(blocks, "BLOCK", 8)
    r = Random(name)
    for _ in range(5):
        program = figure(name, r)
        recorded = Recorded(program)
        poses = some_poses(recorded, r, place, 43)
        found, left = recorded.many(np.array(poses))
        one_by_one = [by_rules(program, recorded, pose) for pose in poses]
        assert list(left) == [k for k, numbers in enumerate(one_by_one) if numbers is None]
        assert all(tuple(ours) == theirs for ours, theirs in zip(found, one_by_one, strict=True) if theirs is not None)


@each("name", RECORDED)
def test_blocks_are_seldom_left(name: str) -> None:
    """Poses like any others are reckoned in blocks: the bounds answer every question."""
    r = Random(name)
    program = figure(name, r)
    while drawn(program, Floats()) is None:
        program = figure(name, r)
    recorded = Recorded(program)
    start = [float(step.params[axis]) for step in program.steps if step.op.name == "given" for axis in "xy"]
    poses = np.array(start) + np.random.default_rng(1).normal(0, 1e-4, (50, len(start)))
    assert recorded.many(poses)[1].size == 0


@pytest.mark.parametrize("name", ["carry", "circles_meet", "touch", "settle"])
def test_machine_code_equals_the_rule(name: str) -> None:
    """Where numba is installed its loop gives the rule's floats exactly."""
    pytest.importorskip("numba")
    r = Random(name)
    program = figure(name, r)
    recorded = Recorded(program)
    poses = some_poses(recorded, r, quarters, 60)
    found, left = recorded.many(np.array(poses), machine=True)
    one_by_one = [by_rules(program, recorded, pose) for pose in poses]
    assert list(left) == [k for k, numbers in enumerate(one_by_one) if numbers is None]
    assert all(tuple(ours) == theirs for ours, theirs in zip(found, one_by_one, strict=True) if theirs is not None)


def test_the_same_operation_is_recorded_once() -> None:
    """A sum and its mirror image, a difference and its reverse, and signs that cancel, are one entry each."""
    tape = Symbols().tape
    x, y = tape.input("x"), tape.input("y")
    assert (x + y).place == (y + x).place
    assert (y - x).place == (-(x - y)).place
    assert ((-x) * (-y)).place == (x * y).place
    assert (x - -y).place == (x + y).place
    assert (x / -y).place == (-(x / y)).place
    assert abs(-x).place == abs(x).place
    assert [(x * 1).place, (x - 0).place, (x / 1).place] == [x.place] * 3


def test_a_rule_may_not_branch_on_a_number() -> None:
    """A symbol refuses to be true or false."""
    with pytest.raises(TypeError, match="branch"):
        bool(Symbols().tape.input("x"))


def test_what_stands_still_is_reckoned_while_recording() -> None:
    """Marks that rest on constants alone leave nothing on the tape."""
    board = Board()
    P, Q = board.given(x=1, y=2, name="P"), board.given(x=3, y=5, name="Q")
    domain = Symbols()
    evaluate(freeze(board, [board.midpoint(P, Q)]), domain)
    assert domain.tape.entries == []


def test_lengths_of_values_are_those_of_the_kinds() -> None:
    """A tape tells as many numbers of a mark as its kind has."""
    for name in RECORDED:
        assert len(Recorded(figure(name, Random(1))).outputs) == LENGTHS[TABLE[name].gives]
