"""One recorded program over many poses: in blocks, one by one, by many hands, and as a function of arrays."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sampling import CORE

import graphplan as gp

GUIDED = Path(__file__).parents[1] / "cases" / "rates" / "guided.toml"
STRETCH = 20_000  # poses: more than one hand takes at a time


def shaken(drawing: gp.WorkingDrawing, n: int, by: float = 0.01) -> dict[str, Any]:
    """n poses in which every moving joint lies a little elsewhere."""
    scene, random = drawing.scene, np.random.default_rng(4)
    reach = max(abs(float(x)) for point in scene.points.values() for x in point)
    away = {name: by * reach * (random.normal(size=n) + 1j * random.normal(size=n)) for name in scene.points
            if "frame" not in scene.links_of[name]}
    away |= {name: away[at] for name, at in drawing.coincident_points.items() if {name, at} <= away.keys()}
    return {name: complex(*map(float, scene.points[name])) + shift for name, shift in away.items()}


@pytest.mark.parametrize("name", CORE)
def test_many_poses_are_each_pose(name: str) -> None:
    """Over arrays and alone every packaged scene gives the same floats, forces too."""
    drawing = gp.construct(gp.load(name))
    points, known = shaken(drawing, 5), {step.name for step in drawing.program.steps}
    poses = drawing.evaluate(points)
    assert not poses.faults
    for k in range(5):
        alone = drawing.replay({point: complex(z[k]) for point, z in points.items() if point in known})
        assert alone == {kind: {of: (z[k].real, z[k].imag) if np.iscomplexobj(z) else z[k] for of, z in named.items()}
                         for kind, named in poses.results.items()}


def test_a_pose_of_its_own_needs_no_points() -> None:
    """Without points the scene's own pose is read, and only what is wanted is given."""
    drawing = gp.construct(gp.load("jaanimets-10"))
    own = drawing.evaluate({}, only=("velocity",))
    assert set(own.results) == {"velocity"}
    assert all(z[0] == drawing.velocity[name] for name, z in own.velocity.items())
    with pytest.raises(gp.Refused, match="does not ask"):
        drawing.evaluate({}, only=("slide velocity",))


@pytest.mark.parametrize("singular", [0, 4095, 4096, 9999])
def test_one_singular_pose_among_many(singular: int) -> None:
    """A pose that cannot be drawn is nan and says why, wherever it stands; its neighbours are as without it."""
    drawing = gp.construct(gp.load("four-bar"))
    points = shaken(drawing, 10000)
    sound = drawing.evaluate(points)
    A, C = (complex(*map(float, drawing.scene.points[name])) for name in "AC")
    points["A"][singular], points["B"][singular] = A, (A + C) / 2
    poses = drawing.evaluate(points)
    others = np.arange(10000) != singular
    assert list(poses.faults) == [singular]
    assert "parallel" in poses.faults[singular]
    assert np.isnan(poses.velocity["B"][singular])
    assert np.array_equal(poses.velocity["B"][others], sound.velocity["B"][others])


def test_guides_on_moving_links_turn_with_them() -> None:
    """A guide whose direction the scene gives as a vector runs as `guides` says: all turned, the results turn too;
    others take no direction, nor do two that are one line in this pose alone."""
    drawing = gp.construct(gp.load(GUIDED))
    turn = np.exp(1j * np.array([0.0, 0.3, 2.0]))
    points = {name: complex(*map(float, at)) * turn for name, at in drawing.scene.points.items()}
    poses = drawing.evaluate(points, guides={"3 along 2": (3 + 1j) * turn})
    assert poses.velocity["B"] == pytest.approx(drawing.velocity["B"] * turn)
    slips = poses.sliding_velocity["3 along 2"] / turn
    assert slips == pytest.approx(slips[0])
    for guide, why in (("3 along frame", "no guide"), ("9 along 2", "one of 3 along 2")):
        with pytest.raises(gp.Refused, match=why):
            drawing.evaluate({"A": [30 + 40j]}, guides={guide: [1j]})
    slide = '[[slides]]\nlink = "4"\nalong = "5"\nat = "A"\ndirection = [3, 1]\n[[drive]]'
    text = drawing.scene.text.replace('3 = "A"', '3 = "A"\n4 = "A"\n5 = "Q"').replace('"O P"', '"O P Q"')
    two = gp.parse(text.replace("B = ", "Q = [80, 10]\nB = ").replace("[[drive]]", slide))
    with pytest.raises(gp.Refused, match="turn differently"):
        gp.construct(two).evaluate({}, guides={"3 along 2": [3 + 1j]})


def test_a_point_of_contact_that_is_left_behind_is_refused() -> None:
    """On a rail of irrational length the point of contact is given: where the wheel moves it must be told, too."""
    rail = gp.scene({
        "points": {"O": [0, 0], "B": [30, 40], "M": [75, 20], "K": [10, 20]}, "links": {"2": "B M", "frame": "O"},
        "contacts": [{"links": ["frame", "2"], "at": "K", "centres": [[-4, 4], "B"], "rolling": True}],
        "drive": [{"link": "2", "omega": 2, "alpha": 3}]})
    with pytest.raises(gp.Refused, match="point K"):
        gp.construct(rail).evaluate(points={"B": np.array([31 + 40j])})


def test_a_construction_can_be_sent_elsewhere() -> None:
    """Pickled, a construction draws the same elsewhere, and brings no table of its own along."""
    drawing = gp.construct(gp.load("jaanimets-10"))
    there = pickle.loads(pickle.dumps(drawing))
    assert there.velocity == drawing.velocity
    assert there.program.steps[-1].op is drawing.program.steps[-1].op


def test_many_hands_give_what_one_gives() -> None:
    """Two hands share the poses out and give the same results and faults, in the same order, and tell of progress."""
    drawing, told = gp.construct(gp.load("four-bar")), list[tuple[int, int]]()
    points = shaken(drawing, STRETCH)
    points["B"][70] = points["A"][70]
    one = drawing.evaluate(points)
    two = drawing.evaluate(points, workers=2, progress=lambda done, of: told.append((done, of)))
    assert np.array_equal(one.velocity["B"], two.velocity["B"], equal_nan=True)
    assert one.faults == two.faults
    assert list(one.faults) == [70]
    assert told == sorted(told)
    assert told[-1] == (STRETCH, STRETCH)


@pytest.mark.costly
def test_a_dask_cluster_gives_what_one_gives() -> None:
    """The same call on a local dask cluster, by the address of its scheduler, gives the same results."""
    distributed = pytest.importorskip("distributed")
    drawing = gp.construct(gp.load("four-bar"))
    points = shaken(drawing, 100)
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as crew:
        poses = drawing.evaluate(points, workers=crew.scheduler_address)
    assert np.array_equal(poses.velocity["B"], drawing.evaluate(points).velocity["B"])


@pytest.mark.parametrize("workers", [0, -3])
def test_no_workers_are_refused(workers: int) -> None:
    """Without anyone to do the work one line says so."""
    with pytest.raises(gp.Refused, match="workers"):
        gp.construct(gp.load("four-bar")).evaluate({"B": [1j]}, workers=workers)


@pytest.mark.parametrize("name", ["slider-crank", "jaanimets-10"])
def test_machine_code_gives_what_numpy_gives(name: str) -> None:
    """Where numba is installed, compiled evaluation gives the same results and faults, forces too."""
    pytest.importorskip("numba")
    drawing = gp.construct(gp.load(name))
    points = shaken(drawing, 20)
    for z in points.values():
        z[7] = 0
    compiled, ours = drawing.evaluate(points, compiled=True), drawing.evaluate(points)
    assert list(ours.faults) == [7]
    assert compiled.faults == ours.faults
    for kind, named in ours.results.items():
        assert all(np.array_equal(z, compiled.results[kind][of], equal_nan=True) for of, z in named.items())


# ---- a function of arrays --------------------------------------------------------------------------------------------


def components(z: Any, library: Any) -> tuple[Any, Any]:
    """A complex array as two real ones of a library."""
    return library.asarray(np.ascontiguousarray(z.real)), library.asarray(np.ascontiguousarray(z.imag))


@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "alt-eight-link", "geared-five-bar", "triad-loaded"])
@pytest.mark.parametrize("library", ["numpy", "array_api_strict", "jax.numpy"])
def test_arrays_of_any_library_give_the_numbers_of_evaluate(name: str, library: str) -> None:
    """To rounding of a library's own operations."""
    xp = pytest.importorskip(library)
    if library == "jax.numpy":
        pytest.importorskip("jax").config.update("jax_enable_x64", True)
    drawing, poses = gp.construct(gp.load(name)), gp.follow(gp.load(name), 40)
    fixed = gp.load(name).links.get("frame", ())
    drawn = {step.name for step in drawing.program.steps[:drawing.program.givens]}
    moving = [point for point in poses.points if point in drawn and point not in fixed]
    guides = dict(poses.turn.guides)
    reached = [k for k in range(len(poses)) if k not in poses.faults]
    places = {of: z[reached] for of, z in {**{point: poses.points[point] for point in moving}, **guides}.items()}
    results = drawing.array_function(*moving, *guides)({point: components(z, xp) for point, z in places.items()})
    expected = drawing.evaluate({point: places[point] for point in moving}, {of: places[of] for of in guides})
    for kind, named in expected.results.items():
        scale = max(np.nanmax(np.abs(z)) for z in named.values())
        for of, z in named.items():
            value = results[kind][of]
            ours = np.asarray(value[0]) + 1j * np.asarray(value[1]) if isinstance(value, tuple) else np.asarray(value)
            np.testing.assert_allclose(ours, z, rtol=1e-9, atol=1e-9 * scale, err_msg=f"{kind} {of}")


def test_a_singular_pose_is_nan_in_a_function() -> None:
    """Where the bars of a four-bar lie along each other, and there alone; names that do not move are refused."""
    scene = gp.load("four-bar")
    run = gp.construct(scene).array_function("A", "B", "M", only=["velocity"])
    xs, ys = zip(*(map(float, scene.points[name]) for name in "ABM"), strict=True)
    in_line = {name: ([x, 100.0 * (k + 1)], [y, 0.0]) for k, (name, x, y) in enumerate(zip("ABM", xs, ys, strict=True))}
    velocities = run({name: tuple(map(np.asarray, place)) for name, place in in_line.items()})["velocity"]
    assert [np.isnan(part).tolist() for part in velocities["B"]] == [[False, True]] * 2
    with pytest.raises(gp.Refused, match=r"point P99.*one of"):
        gp.construct(scene).array_function("P99")


def test_a_function_can_be_differentiated() -> None:
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
