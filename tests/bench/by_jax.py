"""Many poses by JAX: the rate equations of one pose, mapped over all and compiled, in double precision."""

from __future__ import annotations

from typing import Any

import jax
import numpy as np
from jax import numpy as jnp
from jax.scipy.linalg import lu_factor, lu_solve
from problems import KINDS, equations, run

from graphplan.bench.problem import Problem, TimedRun
from graphplan.solver.rates import read

jax.config.update("jax_enable_x64", True)


def many_poses(problem: Problem) -> TimedRun:
    """A run of the compiled function; the coordinates are where JAX wants them."""
    names = list(problem.points)

    def rates(places: Any) -> Any:
        of = equations(problem.scene, {name: (places[k, 0], places[k, 1]) for k, name in enumerate(names)}, jnp.sqrt)
        matrix = jnp.array([[row.get(j, 0.0) for j in range(of.width)] for row in of.rows], float)
        factors = lu_factor(matrix)
        first = of.rates(list(lu_solve(factors, jnp.array(of.velocities, float))), 0.0)
        second = of.rates(list(lu_solve(factors, jnp.array(of.accelerations(first), float))), 0.0)
        told = read(of, first, second)
        return jnp.array([[part for name in names for part in getattr(told, kind)[name]] for kind in KINDS], float)

    many = jax.jit(jax.vmap(rates))
    given = jnp.array(np.stack([np.stack([z.real, z.imag], axis=1) for z in problem.points.values()], axis=1))
    return run(problem, lambda: many(given).block_until_ready(),
               lambda found, k: np.array(found[k]).ravel().view(complex))
