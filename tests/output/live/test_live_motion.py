"""The live page's linkage beside Python's: the same poses, limits and results, on its branch however it is dragged.

In each scene LIVE_POSES poses are compared and LIVE_DRAGS drags are made, of which LIVE_SOLVED are solved anew; of
LIVE_LINKAGES random linkages, too.
"""

from __future__ import annotations

import json
import math
import shutil
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from itertools import combinations, pairwise
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import higher
import numpy as np
import pytest

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.check.json_results import result_data as printed
from graphplan.check.trusted import report
from graphplan.commands.new import template
from graphplan.cycle.motion_curves import centrodes
from graphplan.cycle.turn import RangeOfMotion
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.replaced import guides
from graphplan.mechanism.scene import packaged_names, parse
from graphplan.methods.construction import Construction
from graphplan.output.live.motion import motion, rolling, script

RANDOM = Path(__file__).parents[2] / "random" / "linkages.py"
POSES, DRAGS, SOLVED, LINKAGES = 6, 3, 1, 3
NINE = 1e-9
FAIR = 1e-3  # of the smallest determinant: nearer to a limit everybody loses digits
KINDS = {"points": ("velocity", "acceleration"), "links": ("omega", "alpha"),
         "slides": ("slide velocity", "slide acceleration")}
PARALLELOGRAM = """
title = "A parallelogram"
[points]
O = [0, 0]
A = [3, 4]
B = [13, 4]
C = [10, 0]
[links]
1 = "O A"
2 = "A B"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 10
[find]
velocity = "all"
acceleration = "all"
"""
LOADED = """
title = "A slider-crank with loads that change"
[points]
O = [0, 0]
A = [-30, 40]
B = [90, 0]
[links]
1 = "O A"
2 = "A B"
3 = "B"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [-2, 0]
[[drive]]
link = "1"
omega = -5
[[forces]]
on = "3"
at = "B"
direction = "A B"
over = "3 along frame"
values = [[-200, 50], [-90, 80], [-60, -10], [-60, 10], [-200, 40]]
[[forces]]
on = "2"
at = "A"
direction = [3, 4]
over = "travel"
values = [[-100, 5], [20, 70], [20, -7], [260, 5]]
[[forces]]
on = "2"
at = "B"
direction = 30
over = "speed of 3 along frame"
powers = [3, 0.2, 0.01]
[[moments]]
on = "1"
over = "speed"
values = [[0, 30], [20, 5]]
[[moments]]
on = "2"
over = "3 along frame"
values = [[-200, 1], [-60, 2], [-200, 3]]
[balance]
link = "1"
[find]
velocity = "all"
acceleration = "all"
reactions = "all"
"""
NODE = """
const found = {};
for (const [name, { data, tape, travels, drags }] of Object.entries(cases)) {
  const motion = new Motion(data, tape), seen = () => ({
    travel: motion.travel, points: motion.points(), guides: motion.guides(), results: motion.results(),
    drawn: motion.values() !== null, said: motion.said,
    poles: data.rolling.map((pair) => motion.pole(...pair, motion.knot)).map((pole) => pole && pole.at),
    determinants: Array.from(motion.knot.determinants, (value, k) => value / motion.start.determinants[k]) });
  const poses = travels.map((travel) => ((motion.travel = travel), seen()));
  if (!motion.still) motion.limited = null;
  found[name] = { poses, limits: motion.limits() };
  found[name].round = [30, 1830, -690].map((travel) => ((motion.travel = travel), motion.points()));
  found[name].hardly = [...Array(10).keys()].filter((k) => {
    motion.reset();
    motion.travel = 10 ** (-6 - k);
    return motion.stop;
  });
  found[name].stuck = Object.keys(motion.fixed).filter((pin) => {
    motion.reset();
    const [x, y] = motion.fixed[pin], far = data.linkage.reach / 2048;
    motion.drag(pin, x + far, y + far);
    return motion.stop;
  });
  motion.reset();
  motion.travel = 300;
  found[name].stopped = seen();
  motion.reset();
  found[name].drags = drags.map(([point, x, y]) => {
    motion.drag(point, x, y);
    const there = { ...seen(), toml: motion.toml() }, { knot, path } = motion;
    if (there.said || data.linkage.drives.length > 1) return there;
    const beside = [0, -0.1, 0.1].map((turn) => {
      motion.travel = there.travel + turn;
      const [u, v] = motion.points()[point];
      return Math.hypot(x - u, y - v);
    });
    motion.set(path, { knot });
    return { ...there, beside };
  });
}
process.stdout.write(JSON.stringify(found));
"""


class Case(NamedTuple):
    """A scene, where it is taken, its limits by Python, and what the page says: of poses, limits and drags."""

    drawing: Construction
    travels: list[float]
    drags: list[tuple[str, float, float]]
    limits: list[float | None]
    unit: float
    found: dict[str, Any]

    @property
    def scene(self) -> gp.Scene:
        return self.drawing.scene


def moved(drawing: Construction) -> tuple[Case, str]:
    """What is to be done with a scene, and the page's data; where nothing drives it it is dragged alone."""
    scene, random = drawing.scene, Random(drawing.scene.name)
    data, tape = motion([drawing])
    unit = data["linkage"]["unit"]
    limits = [limit and limit["travel"] / unit for limit in data["linkage"]["limits"]]
    low, high = (end / unit if limit is None else limit * (1 - 1e-4)
                 for limit, end in zip(limits, data["linkage"]["span"], strict=True))
    travels = [random.uniform(low, high) for _ in range(POSES)] if low < high else []
    drags, far = [], 0.15 * scene.extent
    for name in random.choices([name for name in scene.points if scene.links_of[name]], k=DRAGS):
        x, y = map(float, scene.points[name])
        drags.append((name, x + random.uniform(-far, far), y + random.uniform(-far, far)))
    case = Case(drawing, travels, drags, limits, unit, {})
    return case, f"{{data: {json.dumps(data)}, tape: {tape}, travels: {travels}, drags: {json.dumps(drags)}}}"


@cache
def random_linkages() -> Any:
    """The module that makes them."""
    spec = spec_from_file_location("random_linkages", RANDOM)
    assert spec is not None
    assert spec.loader is not None
    sys.modules[spec.name] = module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def constructions() -> Iterator[Construction]:
    """Those of some packaged scenes, and of random linkages that can be drawn in the given pose."""
    for name in sorted({*packaged_names()[::5], "ozols-13-6", "gear-linkage"}):
        yield gp.construct(gp.load(name), checked=False)
    yield gp.construct(parse(PARALLELOGRAM, "parallelogram"), checked=False)
    yield gp.construct(parse(LOADED, "loaded"), checked=False)
    yield gp.construct(parse(template("joints"), "joints"), checked=False)
    for name, text in higher.TEXTS.items():
        yield gp.construct(parse(text, name), checked=False)
    for seed in range(LINKAGES):
        try:
            drawing = gp.construct(parse(random_linkages().linkage(seed).text(), f"random {seed}"), checked=False)
            drawing.values  # noqa: B018
        except GraphplanError:
            continue
        yield drawing


@cache
def cases() -> dict[str, Case]:
    """All scenes that can be followed, taken round by one process of node."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed")
    made = [*map(moved, constructions())]
    texts = ",\n".join(f"{json.dumps(case.scene.name)}: {text}" for case, text in made)
    done = subprocess.run([node, "-"], input=f"{script()}\nconst cases = {{{texts}}};\n{NODE}", capture_output=True,
                          text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    return {case.scene.name: case._replace(found=found[case.scene.name]) for case, _ in made}


def apart(ours: Any, theirs: Any) -> float:
    """The difference of numbers or vectors."""
    return math.dist(np.atleast_1d(ours), np.atleast_1d(theirs))


def test_poses() -> None:
    """In poses taken in any order points and results are Python's, to nine digits."""
    for name, case in cases().items():
        if not case.travels:
            continue
        ends = min(0.0, *case.travels) * case.unit, max(0.0, *case.travels) * case.unit
        turn = RangeOfMotion(case.scene, *ends, False).turn(np.array(case.travels) * case.unit)
        together = {point: turn.points[at] for point, at in case.drawing.coincident_points.items()}
        if any(np.abs(z - turn.points[point]).max() > NINE for point, z in together.items()):
            assert not any(pose["results"] for pose in case.found["poses"]), name  # one mark cannot serve both
            continue
        try:
            poses = case.drawing.evaluate(turn.points | together, turn.guides, loads=turn.loads)
        except Refused:  # two guides are one line in the given pose
            continue
        for k, pose in enumerate(case.found["poses"]):
            assert pose["said"] == "", (name, case.travels[k])
            for point, z in turn.points.items():
                gap = abs(complex(*pose["points"][point]) - z[k])
                assert gap <= NINE * case.scene.extent, (name, case.travels[k], point, gap)
            for part, kinds in KINDS.items():
                for kind in kinds if k not in poses.faults else ():
                    key, named = kind.split()[-1], {of: z[k] for of, z in poses.results_of_kind(kind).items()}
                    size = max(least(case.scene)[key], *map(abs, named.values()), 0.0)
                    for of, true in named.items():
                        value = pose["results"][part][of][key]
                        gap = abs((complex(*value) if isinstance(value, list) else value) - true)
                        assert gap <= NINE * size, (name, case.travels[k], kind, of)


def test_loads_that_change() -> None:
    """Loads follow the pose: balances are those of the cycle, on either stroke, and copied poses have them."""
    strokes = set()
    for name in ("ozols-13-6", "loaded"):
        case = cases()[name]
        ends = min(0.0, *case.travels) * case.unit, max(0.0, *case.travels) * case.unit
        turn = RangeOfMotion(case.scene, *ends, False).turn(np.array(case.travels) * case.unit)
        poses = case.drawing.evaluate(turn.points, turn.guides, loads=turn.loads)
        moments = poses.results_of_kind("balance moment")["1"]
        strokes |= {int(np.sign(turn.loads["P_3"].real[k])) for k in range(len(moments))}
        for pose, moment in zip(case.found["poses"], moments, strict=True):
            assert pose["results"]["balance"]["moment"] == pytest.approx(moment, rel=NINE), name
            assert pose["results"]["check"]["force"] < NINE, name
        for drag in case.found["drags"]:
            if drag["results"]:
                told = printed(report(parse(drag["toml"], "drag")))["balance"]["moment"]
                assert drag["results"]["balance"]["moment"] == pytest.approx(told, rel=1e-7), name
    assert strokes >= {-1, 1}


def test_poles() -> None:
    """The poles of a page's centrodes are those of the cycle, to nine digits of how far off they are."""
    for name, case in cases().items():
        pairs = list(rolling(case.scene))
        if not case.travels or not pairs:
            continue
        travel = np.array(case.travels) * case.unit
        links = RangeOfMotion(case.scene, min(0.0, travel.min()), max(0.0, travel.max()), False).links_at(travel)
        for i, (link, on) in enumerate(pairs):
            one, found = links[link], centrodes(links, link, on)
            poles = one.base + (found.moving - one.origin) * one.turn
            for k, pose in enumerate(case.found["poses"]):
                if abs(poles[k]) < 100 * case.scene.extent:
                    gap = abs(complex(*pose["poles"][i]) - poles[k])
                    assert gap <= 100 * NINE * case.scene.extent, (name, link, on)


def least(scene: gp.Scene) -> dict[str, float]:
    """What drives as fast as these give at least to something: beside less, rounding is no difference."""
    long = {True: scene.extent, False: 1.0}
    pace = max((max(abs(float(drive.rate)), math.sqrt(abs(float(drive.change)))) / long[drive.slides]
                for drive in scene.drives), default=0.0)
    return {"velocity": pace * scene.extent, "acceleration": pace * pace * scene.extent, "omega": pace,
            "alpha": pace * pace}


def test_limits() -> None:
    """The page finds the limits that `cycle` finds, each within what a limit is known to."""
    for name, case in cases().items():
        for ours, theirs in zip(case.found["limits"], case.limits, strict=True):
            assert (ours is None) == (theirs is None), name
            near = 1e-7 if name in packaged_names() else 1e-5  # by chance a limit is one in several ways, and is worse
            assert ours is None or abs(ours - theirs) <= near * max(1.0, abs(theirs)), (name, ours, theirs)


def test_turns() -> None:
    """After any number of turns, either way, every point is back where it was; gears take their time to be."""
    turning = [case for name, case in cases().items() if name in packaged_names() and case.limits == [None, None]
               and not case.scene.gears and not any(contact.rolling for contact in case.scene.contacts)]
    assert len(turning) > 3
    for case in turning:
        first, *others = case.found["round"]
        for points in others:
            gap = max(math.dist(points[name], first[name]) for name in first)
            assert gap <= NINE * case.scene.extent, case.scene.name


def test_change_points() -> None:
    """A parallelogram stops where its links lie in one line, with the reason, and knows the drive's rate alone."""
    found = cases()["parallelogram"].found
    assert found["limits"] == pytest.approx([-math.degrees(math.atan2(4, 3)), 180 - math.degrees(math.atan2(4, 3))])
    assert found["stopped"]["said"] == "links 2 and 3 are in a change point: the drive does not say how they move on"
    assert [rates["omega"] for rates in found["stopped"]["results"]["links"].values()] == [10, None, None]


def test_hardly_moved() -> None:
    """However little the drives turn, what rounding does to that is no limit."""
    assert not {name: case.found["hardly"] for name, case in cases().items() if case.found["hardly"]}


def test_pins() -> None:
    """Every pin of the frame goes where it is dragged, also where gears turn on what it carries."""
    assert not {name: case.found["stuck"] for name, case in cases().items() if case.found["stuck"]}


def test_drags() -> None:
    """However it is dragged, links keep their lengths and the linkage its branch."""
    for name, case in cases().items():
        given = {point: complex(*map(float, at)) for point, at in case.scene.points.items()}
        for drag, pose in zip(case.drags, case.found["drags"], strict=True):
            assert min(pose["determinants"], default=1.0) > 0, (name, drag)
            at = {point: complex(*place) for point, place in pose["points"].items()}
            for link, points in case.scene.links.items():
                for one, two in combinations([point for point in points if not moves_on_guide(case, link, point)], 2):
                    gap = abs(abs(at[one] - at[two]) - abs(given[one] - given[two])) if link != FRAME else 0.0
                    assert gap <= NINE * case.scene.extent, (name, drag, link, one, two)


def test_nearest() -> None:
    """A point that is dragged is as near as it comes: a little to either side it is no nearer.

    Where a drive would have to turn more than it does in one drag, as a gear reduces much, the point is on its way.
    """
    for name, case in cases().items():
        travels = [0.0, *(pose["travel"] for pose in case.found["drags"])]
        for drag, pose, (before, after) in zip(case.drags, case.found["drags"], pairwise(travels), strict=True):
            here, *others = pose.get("beside", (0.0, 0.0))
            near = here <= min(others) + NINE * case.scene.extent
            assert near or abs(after - before) > 360, (name, drag, pose["beside"])


def moves_on_guide(case: Case, link: str, point: str) -> bool:
    """Whether a point of a guide's link only marks the place under the sliding point."""
    return any(slide.along == link and case.scene.points[slide.at] == case.scene.points[point]
               for slide in guides(case.scene).values())


def test_dragged_scenes() -> None:
    """What is copied as a scene gives, solved anew, the results that the page shows."""
    for name, case in cases().items():
        fair = [pose for pose in case.found["drags"] if pose["results"] and min(pose["determinants"], default=1) > FAIR
                and (name in packaged_names() or max(pose["results"]["check"].values(), default=0) < 1e-5)]
        for pose in fair[-SOLVED:]:
            truth = printed(report(parse(pose["toml"], name)))
            size = {key: max(least(case.scene).get(key, 0.0), largest(truth, key)) for key in KEYS}
            for path, key, ours, theirs in numbers(pose["results"], truth):
                assert apart(ours, theirs) <= NINE * size[key], (name, path, ours, theirs)


KEYS = "velocity", "acceleration", "omega", "alpha", "force", "moment", "acts_at", "efficiency"


def numbers(ours: Any, theirs: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, str, Any, Any]]:
    """The numbers of results beside those of others, by their keys."""
    parts = theirs.items() if isinstance(theirs, dict) else enumerate(theirs)
    for key, value in parts:
        if key in KEYS and not isinstance(value, str | dict):
            yield (*path, key), str(key), ours[key], value
        elif isinstance(value, dict | list) and key not in ("check", "bounds", "method", "stands"):
            yield from numbers(ours[key], value, (*path, key))


def largest(truth: Any, key: str) -> float:
    """The largest number or vector of a key."""
    return max((math.hypot(*np.atleast_1d(value)) for _, one, value, _ in numbers(truth, truth) if one == key),
               default=0.0)


def test_second_opinion() -> None:
    """The linkage's own rates and powers agree with the construction, wherever the solver does."""
    for name, case in cases().items():
        for drag, pose in zip(case.drags, case.found["drags"], strict=True):
            check = pose["results"]["check"] if pose["results"] and name in packaged_names() else {}
            assert max(check.values(), default=0.0) <= 1e-5, (name, drag, check)
        checks = {pose["travel"]: pose["results"]["check"] for pose in case.found["poses"] if pose["results"]}
        told = sum("acceleration" in check for check in checks.values())
        assert told >= 0.8 * len(checks) or name not in packaged_names(), name  # chance links hardly move
        doubted = [travel for travel, check in checks.items() if max(check.values()) > 1e-5]
        assert name not in packaged_names() or not doubted, (name, doubted)
        for travel in doubted[:1]:  # then the solver says so, too
            assert max(cycle(case.scene, 1, (travel, travel)).check.values()) > 1e-5, (name, travel)
