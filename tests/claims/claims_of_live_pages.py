"""Claims about live pages, in a browser: what is known in a pose is drawn and told, and is what `solve --at` says."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import pytest
from claim import claim
from face import Got, ran
from live_browser import live

import graphplan as gp

POSES = 13
SHORT = 0.51  # mm: a shorter vector is not drawn, and ends are told in hundredths
TURN = 1e-4  # degrees or lengths: half of the step of differences
KINDS = "velocity", "acceleration", "omega", "alpha"
SEEN = """travel => {
  graphplan.travel = travel;
  const panels = [...document.querySelectorAll('rect.panel')]
    .map(rect => ['x', 'y', 'width', 'height'].map(key => Number(rect.getAttribute(key))));
  const vectors = [...document.querySelectorAll('g.vector[data-vector]:not([display=none])')];
  const outside = vectors.flatMap(one => [...one.querySelectorAll(':is(polyline, polygon):not([display=none])')])
    .flatMap(one => one.getAttribute('points').split(' ').map(spot => spot.split(',').map(Number)))
    .filter(([x, y]) => !panels.some(([left, top, wide, high]) =>
      x > left - 0.1 && x < left + wide + 0.1 && y > top - 0.1 && y < top + high + 0.1));
  const drawn = vectors.map(({dataset: {vector, from, to}}) => {
    const [[x, y], [u, v]] = [from, to].map(spot => spot.split(' ').map(Number));
    return [vector, [u - x, y - v]];
  });
  const {left, top, right, bottom} = document.querySelector('rect.panel').getBoundingClientRect();
  return {travel: graphplan.travel, points: graphplan.points(), results: graphplan.results(), outside: outside.length,
    drawn: Object.fromEntries(drawn), said: graphplan.said, panel: [left, top, right, bottom],
    told: document.querySelector('#tables').textContent,
    screen: Object.fromEntries(Object.keys(graphplan.points()).map(name => [name, graphplan.screen(name)]))};
}"""


def travels(page: Any) -> list[float]:
    """Where the mechanism is looked at, from one end of its travel to the other."""
    low, high = (limit if limit is not None else end
                 for limit, end in zip(page.evaluate("graphplan.limits()"), (-180, 180), strict=True))
    return [low + (high - low) * (k + 0.5) / POSES for k in range(POSES)] if low < high else []


@cache
def seen(name: str) -> list[Any]:
    """What the page of a scene shows in poses over its travel."""
    with live(name) as page:
        return [page.evaluate(SEEN, travel) for travel in travels(page) or [0.0]]


def unknown(value: Any) -> list[str]:
    """The keys of what results do not know."""
    parts = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [str(key) for key, part in parts if part is None] + [one for _, part in parts for one in unknown(part)]


def vectors(pose: Any) -> dict[str, complex]:
    """The velocities and accelerations of points that are known in a pose, by the names of their vectors."""
    points = (pose["results"] or {"points": {}})["points"]
    return {f"{kind} {point}": complex(*rate) for point, rates in points.items() for kind, rate in rates.items()
            if rate is not None}


@claim()
def whatever_is_known_is_drawn_in_its_place(got: Got) -> None:
    """Over the travel every vector that is known is drawn, where it is long enough, at one scale and one turn a kind,
    inside its panel; the frame stands still and all points lie on the mechanism plan. Where there are no results, or
    some are missing, the page says why, and it says nothing on the console."""
    poses = seen(got.name)
    scales = [{name.split()[0]: abs(complex(*pose["drawn"][name])) / abs(rate)  # of the longest vector of each kind
               for name, rate in sorted(vectors(pose).items(), key=lambda vector: abs(vector[1]))
               if rate and name in pose["drawn"]} for pose in poses]
    finest = {kind: max(scale.get(kind, 0.0) for scale in scales) for kind in KINDS}
    for pose, scale in zip(poses, scales, strict=True):
        known = vectors(pose)
        assert [name for name, rate in known.items() if name not in pose["drawn"]
                and abs(rate) * (finest | scale)[name.split()[0]] >= SHORT] == []
        for name in known.keys() & pose["drawn"].keys():
            arrow, kind = complex(*pose["drawn"][name]), name.split()[0]
            turn = min((1, 1j, -1j), key=lambda turn: abs(arrow - scale[kind] * turn * known[name]))
            assert abs(arrow - scale[kind] * turn * known[name]) < 0.05 + 2e-3 * abs(arrow), (pose["travel"], name)
        assert pose["said"] or (pose["results"] and not unknown(pose["results"]))
        assert pose["outside"] == 0
        left, top, right, bottom = pose["panel"]
        assert all(left < x < right and top < y < bottom for x, y in pose["screen"].values())
        for point, place in pose["points"].items():
            if all(other["points"][point] == place for other in poses):
                assert pose["screen"][point] == pytest.approx(poses[0]["screen"][point], abs=1e-6)
    assert any(pose["drawn"] for pose in poses) or not any(map(vectors, poses))


def drives_one_way(scene: gp.Scene) -> bool:
    """Whether a scene is driven, and not by a slide that moves from a point, beyond which it moves back."""
    return bool(scene.drives) and not scene.motions and not any(
        drive.slides and scene.driven_slide(drive).through for drive in scene.drives)


@claim(having=drives_one_way)
def numbers_are_those_of_solve_in_every_pose(got: Got) -> None:
    """Rates, balances, reactions and the other results of a pose are those of `solve --at`, within 1e-9 of the largest
    of their kind; sizes stand in the page's table in four figures."""
    drives = got.scene.drives
    for pose in seen(got.name)[::3]:
        pace = [abs(float(drive.rate / drives[0].rate)) if drives[0].rate else float(not k)
                for k, drive in enumerate(drives)]
        solved = ran("solve", got.name, "--at", ",".join(repr(pose["travel"] * one) for one in pace))
        if solved.status or not pose["results"]:
            assert solved.status or pose["said"]
            continue
        agree(pose["results"], solved.json, 1e-8)
        told = pose["told"].replace("\u2212", "-").replace("\u00a0", "")
        for rates in solved.json["points"].values():
            if rates.get("velocity") and 1 < (speed := math.hypot(*rates["velocity"])) < 9999:
                assert f"{speed:.4g}" in told, (pose["travel"], speed)


def agree(results: Any, right: Any, share: float) -> None:
    """The numbers of results are those that are right, within a share of the largest of their kind."""
    pairs = [*numbers(results, right)]
    largest = {key: max(size(right) for _, kind, _, right in pairs if kind == key) for _, key, _, _ in pairs}
    for path, key, ours, other in pairs:
        assert ours is not None, path
        gap = math.dist(*([one] if isinstance(one, float | int) else one for one in (ours, other)))
        assert gap <= share * max(largest[key], 1e-9), (path, ours, other)


def size(value: Any) -> float:
    """The size of a number or a vector."""
    return math.hypot(*value) if isinstance(value, list) else abs(value)


def numbers(ours: Any, right: Any, path: tuple[Any, ...] = ()) -> Any:
    """The numbers of results beside those that are right, with their paths and kinds."""
    for key, value in right.items() if isinstance(right, dict) else enumerate(right):
        if key in (*KINDS, "force", "moment", "efficiency") and not isinstance(value, str | dict | None):
            yield (*path, key), key, ours[key], value
        elif isinstance(value, dict | list) and key not in ("check", "bounds", "method", "reasons", "pose", "stands"):
            yield from numbers(ours[key], value, (*path, key))


@claim(having=lambda scene: drives_one_way(scene) and all(drive.rate and not drive.change for drive in scene.drives))
def rates_are_those_of_the_page_s_own_positions(got: Got) -> None:
    """Velocities are what points go by small steps of the travel, and accelerations what velocities change by."""
    drive = got.scene.drives[0]
    time = TURN / (abs(float(drive.rate)) * (1.0 if drive.slides else 180 / math.pi))
    compared = 0
    with live(got.name) as page:
        ends = travels(page)
        for travel in ends[1::4]:
            back, here, on = (page.evaluate(SEEN, travel + turn) for turn in (-TURN, 0, TURN))
            if not all(pose["results"] for pose in (back, here, on)) or on["travel"] - back["travel"] < 1.9 * TURN:
                continue
            before, now, after = (pose["results"]["points"] for pose in (back, here, on))
            carried = [name for name in now if got.scene.links_of[name] and now[name].get("velocity")
                       and not any(got.scene.points[slide.at] == got.scene.points[name] for slide in got.scene.slides)
                       and not got.scene.contacts]
            moved = {name: (complex(*on["points"][name]) - complex(*back["points"][name])) / (2 * time)
                     for name in carried}
            changed = {name: (complex(*after[name]["velocity"]) - complex(*before[name]["velocity"])) / (2 * time)
                       for name in carried if now[name].get("acceleration") and before[name]["velocity"]
                       and after[name]["velocity"]}
            for kind, rates in (("velocity", moved), ("acceleration", changed)):
                largest = max(map(abs, rates.values()), default=0.0)
                compared += len(rates)
                for name, rate in rates.items():
                    assert abs(complex(*now[name][kind]) - rate) < 2e-4 * largest, (travel, kind, name)
    assert compared or not ends or got.scene.contacts or got.scene.slides
