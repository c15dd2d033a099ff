"""Arrays: rates of all joints of four mechanisms, for many poses given by coordinates, by ours and every rival.

All runs of a mechanism take turns in one process. Their times beside LAPACK, with their errors, are the rows that the
chart of the machine takes beside its own: `run.py --rivals FILE.csv` writes them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache, partial
from typing import Any

from harness import ROUNDS, Measured, Row, Target, alternate, compared, peer
from problems import SCENES, N, problem, run

from graphplan.bench.problem import ARITHMETICS, COMPILED, LAPACK, MANY, SOLVERS, Problem, TimedRun
from graphplan.bench.rows import spent
from graphplan.design.decide import construct

HAND, JAX = "numba by hand", "JAX"
CASADI, FUNCTION_MAP = "CasADi, C", "CasADi, map"  # the faster of its two ways to solve
LARGE = SCENES[2:]  # where elimination costs
WRITTEN = SCENES[:3]  # by hand
CALLED = {LAPACK: "LAPACK", MANY: "numpy", COMPILED: "compiled"}


def rows() -> list[Row]:
    """The aims for each mechanism."""
    return [row for name in SCENES for row in _aims(name)]


def _aims(name: str) -> list[Row]:
    found = measured(name)
    faster, slower = partial(Target, "at least"), partial(Target, "at most")
    aims = [(MANY, LAPACK, faster(25 if name in LARGE else 10)), (COMPILED, MANY, faster(3)),
            *([(COMPILED, HAND, slower(3))] if name in WRITTEN else []), (COMPILED, CASADI, faster(1)),
            (MANY, FUNCTION_MAP, faster(1)), (MANY, JAX, faster(1))]
    return [replace(compared(f"{name}, {CALLED[ours]}", rival, target, found.times, ours=ours, over=N,
                             errors=found.errors), rival=CALLED.get(rival, rival)) for ours, rival, target in aims]


@cache
def measured(name: str, n: int = N, rounds: int = ROUNDS) -> Measured:
    """The runs of a packaged scene, all in turns."""
    of = problem(name, n)
    runs = {who: made(of) for who, made in runners(name).items()}
    errors = {who: of.error(run, run.call()) for who, run in runs.items()}
    return Measured(alternate({who: run.call for who, run in runs.items()}, rounds), errors)


def runners(name: str) -> dict[str, Callable[[Problem], TimedRun]]:
    """Everything that solves a packaged scene: what is not installed is not among them."""
    runs: dict[str, Callable[[Problem], TimedRun]] = {LAPACK: SOLVERS[LAPACK], MANY: partial(_ours, MANY)}
    if (loops := peer("by_hand_numba")) is not None:
        runs[COMPILED] = partial(_ours, COMPILED)
        if name in WRITTEN:
            runs[HAND] = partial(_by_hand, loops.LOOPS[name])
    if (casadi := peer("by_casadi")) is not None:
        runs[FUNCTION_MAP] = partial(_faster, casadi.mapped)
        if casadi.COMPILER:
            runs[CASADI] = partial(_faster, casadi.compiled)
    if (jax := peer("by_jax")) is not None:
        runs[JAX] = jax.many_poses
    return runs


def _ours(arithmetic: str, of: Problem) -> TimedRun:
    return ARITHMETICS[arithmetic](of, construct(of.scene))


def _faster(way: Callable[[Problem, bool], TimedRun], of: Problem) -> TimedRun:
    """Of the two ways in which CasADi solves the one that is faster on this problem."""
    ways = [way(of, expanded) for expanded in (True, False)]
    for one in ways:
        one.call()
    return min(ways, key=lambda one: spent(one.call))


def _by_hand(loop: Callable[..., tuple[object, object]], of: Problem) -> TimedRun:
    """A loop of numba's, which gives two arrays."""
    return run(of, lambda: loop(*of.points.values()), lambda found, k: [*found[0][:, k], *found[1][:, k]])


def measures() -> Iterator[Any]:
    """The rivals' rows for the chart of the machine."""
    for name in SCENES:
        yield from measured(name).beside(name, {who: who for who in (HAND, CASADI, FUNCTION_MAP, JAX)})
