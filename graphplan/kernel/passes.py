"""Passes over a program: each gives a new one, numbered afresh."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from heapq import heapify, heappop, heapreplace

from graphplan.kernel.program import Board, Mark, Program, Step


def freeze(board: Board, wanted: Iterable[Mark]) -> Program:
    """The steps that the wanted marks need, renumbered in drawing order: what nothing needs is not drawn."""
    places = [mark.step.index for mark in wanted]
    return _renumber(board.steps, places, sorted(steps_behind(board.steps, places)))


def needed_steps(board: Board, wanted: Iterable[Mark], known: Collection[int] = ()) -> set[int]:
    """The steps, by index, that the wanted marks need, but for known ones and what those need."""
    return steps_behind(board.steps, (mark.step.index for mark in wanted), known)


def steps_behind(steps: Sequence[Step], wanted: Iterable[int], known: Collection[int] = ()) -> set[int]:
    """The same for steps, by index."""
    needed, waiting = set[int](), [*wanted]
    while waiting:
        index = waiting.pop()
        if index not in needed and index not in known:
            needed.add(index)
            waiting.extend(steps[index].args)
    return needed


def prune(program: Program) -> Program:
    """The same program without the steps that no wanted mark needs."""
    return _renumber(program.steps, program.wanted, sorted(steps_behind(program.steps, program.wanted)))


def _renumber(steps: Sequence[Step], wanted: Sequence[int], order: Sequence[int]) -> Program:
    """The program of these steps in this order."""
    place = {index: position for position, index in enumerate(order)}
    renumbered = [step.but(index=place[step.index], args=tuple([place[arg] for arg in step.args]))
                  for step in map(steps.__getitem__, order)]
    return Program(tuple(renumbered), tuple(place[index] for index in wanted))


def put_together(programs: Sequence[Program]) -> tuple[Program, list[list[int]]]:
    """One program of several, drawn one after the other, and the new places of the steps of each.

    What is given in any comes first; letters that are taken get a prime. All marks are wanted that were.
    """
    order = sorted(((k, step.index) for k, program in enumerate(programs) for step in program.steps),
                   key=lambda at: (at[1] >= programs[at[0]].givens, at))
    place, steps, names = {at: position for position, at in enumerate(order)}, list[Step](), set[str]()
    for k, index in order:
        step = programs[k].steps[index]
        name = step.name
        while name and name in names:
            name += "'"
        names.add(name)
        steps.append(step.but(index=len(steps), name=name, args=tuple([place[k, arg] for arg in step.args])))
    places = [[place[k, step.index] for step in program.steps] for k, program in enumerate(programs)]
    wanted_places = tuple(places[k][index] for k, program in enumerate(programs) for index in program.wanted)
    return Program(tuple(steps), wanted_places), places


def gather_by_plan(program: Program) -> tuple[Program, list[int]]:
    """The same steps, plan by plan as far as they allow, and the old place of each: the pencil wanders less."""
    drawn: dict[int, None] = {}
    steps_by_plan: dict[str, list[Step]] = {}
    for step in program.steps:
        steps_by_plan.setdefault(step.panel.whole, []).append(step)
    # the plan whose next step comes first is next
    queue = [(steps[0].index, steps) for steps in steps_by_plan.values()]
    heapify(queue)
    while queue:
        _, steps = queue[0]
        for step in steps:
            if all(arg in drawn for arg in step.args):
                drawn[step.index] = None
        waiting = [step for step in steps if step.index not in drawn]
        heapreplace(queue, (waiting[0].index, waiting)) if waiting else heappop(queue)
    return _renumber(program.steps, program.wanted, list(drawn)), list(drawn)
