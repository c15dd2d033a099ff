"""Passes over a program: freezing a board and pruning. Each gives a new program, numbered afresh."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from graphplan.kernel.program import Board, Mark, Program, Step


def freeze(board: Board, wanted: Iterable[Mark]) -> Program:
    """The steps that the wanted marks need, renumbered in drawing order: what nothing needs is not drawn."""
    return pruned(Program(tuple(board.steps), tuple(mark.step.index for mark in wanted)))


def needed_steps(board: Board, wanted: Iterable[Mark]) -> set[int]:
    """The steps, by index, that the wanted marks need."""
    return _needed(board.steps, (mark.step.index for mark in wanted))


def _needed(steps: Sequence[Step], wanted: Iterable[int]) -> set[int]:
    needed = set(wanted)
    for step in reversed(steps):
        if step.index in needed:
            needed.update(step.args)
    return needed


def pruned(program: Program) -> Program:
    """The same program without the steps that no wanted mark needs."""
    needed = _needed(program.steps, program.wanted)
    place: dict[int, int] = {}
    steps: list[Step] = []
    for step in program.steps:
        if step.index in needed:
            place[step.index] = len(steps)
            steps.append(replace(step, index=len(steps), args=tuple(place[arg] for arg in step.args)))
    return Program(tuple(steps), tuple(place[index] for index in program.wanted))


def gathered(program: Program) -> tuple[Program, list[int]]:
    """The same steps, plan by plan as far as they allow, and the old place of each: the pencil wanders less."""
    order: list[int] = []
    left = list(range(len(program)))
    done = [False] * len(program)
    while left:
        panel = program.steps[left[0]].panel
        later = []
        for index in left:
            step = program.steps[index]
            if step.panel == panel and all(done[arg] for arg in step.args):
                done[index] = True
                order.append(index)
            else:
                later.append(index)
        left = later
    place = {index: position for position, index in enumerate(order)}
    old = [program.steps[index] for index in order]
    steps = [replace(s, index=place[s.index], args=tuple(place[arg] for arg in s.args)) for s in old]
    return Program(tuple(steps), tuple(place[index] for index in program.wanted)), order
