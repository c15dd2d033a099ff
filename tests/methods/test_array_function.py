"""A construction as a function of arrays of any library: the numbers of `evaluate`, and what may be asked of it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import graphplan as gp
from graphplan.errors import Refused

NAMES = ("four-bar", "slotted-link", "alt-eight-link", "geared-five-bar", "triad-loaded")


def components(z: Any, library: Any) -> tuple[Any, Any]:
    """A complex array as two real ones of a library."""
    return library.asarray(np.ascontiguousarray(z.real)), library.asarray(np.ascontiguousarray(z.imag))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("library", ["numpy", "array_api_strict", "jax.numpy"])
def test_arrays_of_any_library_give_the_numbers_of_evaluate(name: str, library: str) -> None:
    """To rounding of a library's own operations, nan in the same poses."""
    xp = pytest.importorskip(library)
    if library == "jax.numpy":
        pytest.importorskip("jax").config.update("jax_enable_x64", True)
    drawing, poses = gp.construct(gp.load(name)), gp.follow(gp.load(name), 40)
    fixed = gp.load(name).links.get("frame", ())
    drawn = {step.name for step in drawing.program.steps[:drawing.program.givens]}
    moving = [point for point in poses.points if point in drawn and point not in fixed]
    guides = dict(poses.turn.guides)
    run = drawing.array_function(*moving, *guides)
    reached = [k for k in range(len(poses)) if k not in poses.faults]
    places = {of: z[reached] for of, z in {**{point: poses.points[point] for point in moving}, **guides}.items()}
    results = run({point: components(z, xp) for point, z in places.items()})
    expected = drawing.evaluate({point: places[point] for point in moving}, {of: places[of] for of in guides})
    for kind, named in expected.results.items():
        scale = max(np.nanmax(np.abs(z)) for z in named.values())
        for of, z in named.items():
            value = results[kind][of]
            ours = np.asarray(value[0]) + 1j * np.asarray(value[1]) if isinstance(value, tuple) else np.asarray(value)
            np.testing.assert_allclose(ours, z, rtol=1e-9, atol=1e-9 * scale, err_msg=f"{kind} {of}")


def test_a_singular_pose_is_nan() -> None:
    """Where the bars of a four-bar lie along each other, and there alone."""
    scene = gp.load("four-bar")
    run = gp.construct(scene).array_function("A", "B", "M", only=["velocity"])
    xs, ys = zip(*(map(float, scene.points[name]) for name in "ABM"), strict=True)
    in_line = {name: ([x, 100.0 * (k + 1)], [y, 0.0]) for k, (name, x, y) in enumerate(zip("ABM", xs, ys, strict=True))}
    velocities = run({name: tuple(map(np.asarray, place)) for name, place in in_line.items()})["velocity"]
    assert [np.isnan(part).tolist() for part in velocities["B"]] == [[False, True]] * 2


def test_it_can_be_differentiated() -> None:
    """The derivative of a velocity by a coordinate, by JAX and by differences."""
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    scene = gp.load("rosenauer-basic")
    run = gp.construct(scene).array_function("B", only=["velocity"])
    x, y = map(float, scene.points["B"])
    point = next(name for name in run({"B": (x, y)})["velocity"])

    def speed(x: Any) -> Any:
        return run({"B": (jax.numpy.asarray(x), jax.numpy.asarray(y))})["velocity"][point][0]

    h = 1e-5 * max(abs(x), abs(y))
    assert jax.grad(speed)(x) == pytest.approx(float(speed(x + h) - speed(x - h)) / (2 * h), rel=1e-6, abs=1e-6)


def test_names_that_do_not_move_are_refused() -> None:
    """A point of the frame, or none at all, with those that may be named."""
    with pytest.raises(Refused, match="point P99"):
        gp.construct(gp.load("four-bar")).array_function("P99")
