"""Passes over a program: freezing a board and pruning. Each gives a new program, numbered afresh."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from graphplan.kernel.program import Board, Mark, Program


def freeze(board: Board, wanted: Iterable[Mark]) -> Program:
    """The steps that the wanted marks need, renumbered in drawing order: what nothing needs is not drawn."""
    return pruned(Program(tuple(board.steps), tuple(mark.step.index for mark in wanted)))


def pruned(program: Program) -> Program:
    """The same program without the steps that no wanted mark needs."""
    needed = [False] * len(program)
    for index in program.wanted:
        needed[index] = True
    for step in reversed(program.steps):
        if needed[step.index]:
            for arg in step.args:
                needed[arg] = True
    place, steps = {}, []
    for step in program.steps:
        if needed[step.index]:
            place[step.index] = len(steps)
            steps.append(replace(step, index=len(steps), args=tuple(place[arg] for arg in step.args)))
    return Program(tuple(steps), tuple(place[index] for index in program.wanted))
