"""Many poses by CasADi: the rate equations written in its symbols, as C that it generates, or by its own map.

The C is compiled with the compiler at hand and called in a loop over arrays. CasADi solves in two ways, and which is
faster depends on the mechanism: expanded, the elimination is written out symbolically (its own default, by QR without
pivots); else its sparse QR is called in each pose.
"""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import casadi
import numpy as np
from problems import KINDS, equations, run

from graphplan.bench.problem import Problem, TimedRun
from graphplan.solver.rates import read

COMPILER = os.environ.get("CC") or next(filter(shutil.which, ("cc", "gcc", "clang")), "")
FLAGS = ("-O3", "-march=native", "-shared", "-fPIC", "-w")
LOOP = """
#include <stdlib.h>
void many(long long n, const double *given, double *found) {{
    casadi_int args, results, integers, reals;
    rates_work(&args, &results, &integers, &reals);
    const double **arg = malloc((args + 1) * sizeof *arg);
    double **res = malloc((results + 1) * sizeof *res), *w = malloc((reals + 1) * sizeof *w);
    casadi_int *iw = malloc((integers + 1) * sizeof *iw);
    for (long long i = 0; i < n; i++) {{
        arg[0] = given + i * {inputs};
        res[0] = found + i * {outputs};
        rates(arg, res, iw, w, 0);
    }}
    free(arg); free(res); free(w); free(iw);
}}
"""


def compiled(problem: Problem, expanded: bool) -> TimedRun:
    """A run of the generated C; fails where there is no compiler."""
    many, given = _many(problem, expanded), _given(problem)
    found = np.empty(given.shape[0] * 2 * given.shape[1])

    def call() -> Any:
        many(ctypes.c_longlong(problem.n), *(ctypes.c_void_p(array.ctypes.data) for array in (given, found)))
        return found.reshape(problem.n, -1).view(complex)

    return run(problem, call, lambda found, k: found[k])


def mapped(problem: Problem, expanded: bool) -> TimedRun:
    """A run of CasADi's own map of the function over all poses, which no compiler is needed for."""
    many, given = rates(problem, expanded).map(problem.n), casadi.DM(_given(problem).T)
    return run(problem, lambda: many(given), lambda found, k: np.array(found[:, k]).ravel().view(complex))


def _given(problem: Problem) -> Any:
    """The coordinates, a row a pose."""
    return np.ascontiguousarray(np.stack(list(problem.points.values()), axis=1)).view(float)


def _many(problem: Problem, expanded: bool) -> Callable[..., None]:
    """The compiled loop."""
    function = rates(problem, expanded)
    with TemporaryDirectory() as folder:
        source, library = Path(folder) / "rates.c", Path(folder) / "rates.so"
        here = Path.cwd()
        os.chdir(folder)  # CasADi writes into the working folder alone
        try:
            function.generate(source.name)
        finally:
            os.chdir(here)
        loop = LOOP.format(inputs=function.size1_in(0), outputs=function.size1_out(0))
        source.write_text(source.read_text() + loop)
        subprocess.run([COMPILER, *FLAGS, str(source), "-o", str(library), "-lm"], check=True)
        many: Callable[..., None] = ctypes.CDLL(str(library)).many
    return many


@cache
def rates(problem: Problem, expanded: bool) -> Any:
    """The function from the coordinates of a pose to its velocities and accelerations."""
    names = list(problem.points)
    places = casadi.SX.sym("places", 2 * len(names))
    of = equations(problem.scene, {name: (places[2 * k], places[2 * k + 1]) for k, name in enumerate(names)},
                   casadi.sqrt)
    matrix = casadi.SX(len(of.rows), of.width)
    for i, row in enumerate(of.rows):
        for j, value in row.items():
            matrix[i, j] = value
    unknowns = [casadi.SX.sym("first", of.width), casadi.SX.sym("second", of.width)]
    first, second = (of.rates([x[k] for k in range(of.width)], 0.0) for x in unknowns)
    told = read(of, first, second)
    vectors = _column([part for kind in KINDS for name in names for part in getattr(told, kind)[name]])
    system = casadi.Function("system", [places], [casadi.sparsify(matrix), _column(of.velocities)])
    further = casadi.Function("further", [places, unknowns[0]], [_column(of.accelerations(first))])
    outcome = casadi.Function("outcome", [places, *unknowns], [vectors])
    given = (casadi.SX if expanded else casadi.MX).sym("given", 2 * len(names))
    how = () if expanded else ("qr",)
    A, b = system(given)
    v = casadi.solve(A, b, *how)
    a = casadi.solve(A, further(given, v), *how)
    return casadi.Function("rates", [given], [outcome(given, v, a)])


def _column(numbers: Any) -> Any:
    return casadi.densify(casadi.vertcat(*map(casadi.SX, numbers)))
