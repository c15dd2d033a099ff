"""One recorded program over many poses: in blocks, one by one, by many hands, always the same numbers."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from sampling import CORE

import graphplan as gp
from graphplan.accuracy.survey.growth import chain
from graphplan.errors import Refused
from graphplan.kernel.numbers import Floats
from graphplan.kernel.tape.blocks import BlockWriter
from graphplan.mechanism.model import FRAME, Scene
from graphplan.methods.motion.network import Network
from graphplan.methods.replay import Poses, moving_parts, replay_of

GUIDED = """
[points]
O = [0, 0]
P = [100, 0]
A = [30, 40]
B = [90, 60]
[links]
1 = "O A"
2 = "P B"
3 = "A"
frame = "O P"
[[slides]]
link = "3"
along = "2"
at = "A"
direction = [3, 1]
[[drive]]
link = "1"
omega = 2
[find]
velocity = ["A", "B"]
acceleration = ["A", "B"]
"""


def shaken(scene: Scene, n: int, by: float = 0.01) -> dict[str, Any]:
    """n poses in which every moving joint lies a little elsewhere."""
    reach = max(abs(float(x)) for point in scene.points.values() for x in point)
    random = np.random.default_rng(4)
    away = {name: by * reach * (random.normal(size=n) + 1j * random.normal(size=n)) for name in scene.points
            if FRAME not in scene.links_of[name]}
    away |= {name: away[at] for (at, _), name in Network(scene).coincident.items() if {name, at} <= away.keys()}
    return {name: complex(*map(float, scene.points[name])) + shift for name, shift in away.items()}


def at(poses: Poses, k: int) -> dict[str, dict[str, Any]]:
    """The results of one pose, as a single replay gives them."""
    return {kind: {name: (float(z[k].real), float(z[k].imag)) if np.iscomplexobj(z) else float(z[k])
                   for name, z in named.items()} for kind, named in poses.results.items()}


@pytest.mark.parametrize("name", CORE)
def test_many_poses_are_each_pose(name: str) -> None:
    """Over arrays, alone, and by the rules themselves every packaged scene gives the same floats, forces too."""
    drawing = gp.construct(gp.load(name))
    points = shaken(drawing.scene, 5)
    poses = drawing.evaluate(points)
    assert not poses.faults
    for k in range(5):
        pose = {point: complex(z[k]) for point, z in points.items()}
        given = {point: {"x": z.real, "y": z.imag} for point, z in pose.items()}
        drawn = {step.name for step in drawing.program.steps}
        assert drawing.replay({p: z for p, z in pose.items() if p in drawn}) == drawing.read(Floats(), given) == at(
            poses, k)


def test_a_pose_of_its_own_needs_no_points() -> None:
    """Without points the replay reads the scene's own pose."""
    drawing = gp.construct(gp.load("four-bar"))
    assert complex(*drawing.replay()["velocity"]["B"]) == drawing.velocity["B"]
    assert drawing.evaluate({}).velocity["B"][0] == drawing.velocity["B"]


def test_only_what_is_wanted_is_reckoned() -> None:
    """Asked for velocities alone, the replay gives these and nothing else; what the scene does not ask is refused."""
    drawing = gp.construct(gp.load("jaanimets-10"))
    points = shaken(drawing.scene, 4)
    poses = drawing.evaluate(points, only=("velocity",))
    assert set(poses.results) == {"velocity"}
    every = drawing.evaluate(points).velocity
    assert all(np.array_equal(z, every[name]) for name, z in poses.velocity.items())
    with pytest.raises(Refused, match="does not ask"):
        drawing.evaluate(points, only=("slide velocity",))


@pytest.mark.parametrize("singular", [0, 4095, 4096, 9999])
def test_one_singular_pose_among_many(singular: int) -> None:
    """A pose that cannot be drawn is nan and says why, wherever it stands; its neighbours are as without it."""
    drawing = gp.construct(gp.load("four-bar"))
    points = shaken(drawing.scene, 10000)
    sound = drawing.evaluate(points)
    (ax, ay), (cx, cy) = (drawing.scene.points[name] for name in "AC")
    points["A"][singular], points["B"][singular] = complex(ax, ay), complex(ax + cx, ay + cy) / 2
    poses = drawing.evaluate(points)
    others = np.arange(10000) != singular
    assert list(poses.faults) == [singular]
    assert "parallel" in poses.faults[singular]
    assert np.isnan(poses.velocity["B"][singular])
    assert np.array_equal(poses.velocity["B"][others], sound.velocity["B"][others])


def test_guides_on_moving_links_turn_with_them() -> None:
    """A guide whose direction the scene gives as a vector runs as `guides` says: all turned, the results turn too."""
    drawing = gp.construct(gp.parse(GUIDED, "guided"))
    turn = np.exp(1j * np.array([0.0, 0.3, 2.0]))
    points = {name: complex(*map(float, at)) * turn for name, at in drawing.scene.points.items()}
    poses = drawing.evaluate(points, guides={"3 along 2": (3 + 1j) * turn})
    assert poses.velocity["B"] == pytest.approx(drawing.velocity["B"] * turn)
    assert poses.results["slide velocity"]["3 along 2"] / turn == pytest.approx(
        poses.results["slide velocity"]["3 along 2"][0])


@pytest.mark.parametrize(("guide", "why"), [("3 along frame", "no guide"), ("9 along 2", "one of 3 along 2")])
def test_guides_that_nothing_turns_are_refused(guide: str, why: str) -> None:
    """Only a guide on a moving link, given as a vector, takes a direction."""
    drawing = gp.construct(gp.parse(GUIDED, "guided"))
    with pytest.raises(Refused, match=why):
        drawing.evaluate({"A": [30 + 40j]}, guides={guide: [1j]})


def test_guides_that_are_one_line_only_in_this_pose_are_refused() -> None:
    """Two guides drawn as one line on different links turn differently: the second is asked for by points."""
    other = '[[slides]]\nlink = "4"\nalong = "5"\nat = "A"\ndirection = [3, 1]\n'
    text = GUIDED.replace('3 = "A"', '3 = "A"\n4 = "A"\n5 = "Q"').replace('"O P"', '"O P Q"')
    text = text.replace("B = ", "Q = [80, 10]\nB = ")
    scene = gp.parse(text.replace("[[drive]]", other + "[[drive]]"), "one-line")
    with pytest.raises(Refused, match="turn differently"):
        gp.construct(scene).evaluate({}, guides={"3 along 2": [3 + 1j]})


def test_a_construction_can_be_sent_elsewhere() -> None:
    """Pickled, a construction draws the same elsewhere, and brings no table of its own along."""
    drawing = gp.construct(gp.load("jaanimets-10"))
    there = pickle.loads(pickle.dumps(drawing))
    assert there.velocity == drawing.velocity
    assert there.program.steps[-1].op is drawing.program.steps[-1].op


def test_many_hands_give_what_one_gives(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two threads share the poses out and give the same results and faults, in the same order; no process is begun."""
    from graphplan.methods import replay

    monkeypatch.setattr(replay, "STRETCH", 40)
    monkeypatch.setattr(replay, "worker_pool", None)
    drawing = gp.construct(gp.load("four-bar"))
    points = shaken(drawing.scene, 100)
    points["B"][70] = points["A"][70]
    told: list[tuple[int, int]] = []
    one = drawing.evaluate(points)
    two = drawing.evaluate(points, workers=2, progress=lambda done, of: told.append((done, of)))
    assert np.array_equal(one.velocity["B"], two.velocity["B"], equal_nan=True)
    assert one.faults == two.faults
    assert list(one.faults) == [70]
    assert told == [(40, 100), (80, 100), (100, 100)]


@pytest.mark.costly
def test_a_dask_cluster_gives_what_one_gives() -> None:
    """The same call on a local dask cluster, by the address of its scheduler, gives the same results."""
    distributed = pytest.importorskip("distributed")
    drawing = gp.construct(gp.load("four-bar"))
    points = shaken(drawing.scene, 100)
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as crew:
        poses = drawing.evaluate(points, workers=crew.scheduler_address)
    assert np.array_equal(poses.velocity["B"], drawing.evaluate(points).velocity["B"])


@pytest.mark.parametrize("workers", [0, -3, "tcp://127.0.0.1:9"])
def test_no_workers_are_refused(workers: int | str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without anyone to do the work one line says so."""
    from graphplan.methods import executors

    monkeypatch.setattr(executors, "PATIENCE", "0.5s")
    with pytest.raises(Refused, match="workers"):
        gp.construct(gp.load("four-bar")).evaluate({"B": [1j]}, workers=workers)


@pytest.mark.parametrize("name", ["slider-crank", "jaanimets-10"])
def test_machine_code_gives_what_numpy_gives(name: str) -> None:
    """Where numba is installed, the compiled replay gives the same results and faults, forces too."""
    pytest.importorskip("numba")
    drawing = gp.construct(gp.load(name))
    points = shaken(drawing.scene, 20)
    for z in points.values():
        z[7] = 0
    compiled, ours = drawing.evaluate(points, compiled=True), drawing.evaluate(points)
    assert list(ours.faults) == [7]
    assert compiled.faults == ours.faults
    for kind, named in ours.results.items():
        assert all(np.array_equal(z, compiled.results[kind][of], equal_nan=True) for of, z in named.items())


def test_a_long_chain_needs_no_more_registers() -> None:
    """Velocity and acceleration of a joint stand together, so that a block keeps as few numbers for sixty links as for
    twenty: a pose's time is linear in its steps."""
    def registers(links: int) -> int:
        drawing = gp.construct(chain(links // 2 - 1), checked=False)
        free = tuple(key for item in moving_parts(drawing) for part in item.parts for key in part)
        reading = replay_of(drawing, free, ("velocity", "acceleration"))
        assert reading is not None
        return BlockWriter(reading.tape, reading.inputs, reading.outputs).registers

    assert registers(20) == registers(60) < 30
