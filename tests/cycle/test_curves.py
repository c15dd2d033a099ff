"""Paths, centrodes and cubics of stationary curvature: in JSON, and as they are drawn."""

from __future__ import annotations

import json
import math
import re
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from face import ran

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "cycle"
READ = 0.03  # mm of paper: a point of a drawn curve is read so well


@cache
def drawn(scene: str, *settings: str) -> tuple[list[Any], float]:
    """The lines of the motion on a sheet, in lengths of the scene, and how long a mm of paper is."""
    said = [part for value in settings for part in ("--set", value)]
    with TemporaryDirectory() as folder:
        sheet = Path(folder) / "sheet.svg"
        assert ran("draw", scene, "-q", "-o", sheet, *said).status == 0
        svg = sheet.read_text()
    given = [step for step in ran("steps", scene, "-q", "--json", *said).json["steps"] if step["operation"] == "given"]
    (z, p), (w, q) = ((complex(*step["value"]), complex(*step["paper"]).conjugate()) for step in given[:2])
    factor = (w - z) / (q - p)
    layer = re.findall(r'<g class="layer-motion".*?</g>', svg, re.DOTALL)
    lines = [np.array([complex(*map(float, spot.split(","))) for spot in points.split()]).conjugate()
             for points in re.findall(r'<poly\w+[^>]* points="([^"]*)"', "".join(layer))]
    return [z + (line - p) * factor for line in lines], abs(factor)


def gap(line: Any, spots: Any) -> Any:
    """How far spots are from a drawn line."""
    starts, ways = line[:-1, None], np.diff(line)[:, None]
    along = ((spots - starts) / np.where(ways == 0, 1, ways)).real.clip(0, 1)
    return np.abs(starts + along * ways - spots).min(axis=0)


def table(scene: str, *options: str) -> Any:
    """What `graphplan cycle` has in JSON."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "cycle.json"
        told = ran("cycle", scene, "-q", "-o", file, *options)
        assert told.status == 0, told.err
        return json.loads(file.read_text())


def places(rows: Any) -> Any:
    """Points over the poses as complex numbers, nan where there is none."""
    return np.array([complex(*row) if row else complex(math.nan, math.nan) for row in rows])


# ---- paths -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "point"), [("four-bar", "M"), ("five-bar", "C"), ("triad", "A")])
def test_paths_are_where_the_cycle_leads(name: str, point: str) -> None:
    """All poses of the cycle lie on the drawn path, the given one too; it closes where the crank goes round."""
    scene = gp.load(name)
    point = point if point in scene.points else next(p for p in scene.links[scene.moving[0]]
                                                     if p not in scene.links["frame"])
    lines, mm = drawn(name, f'sheet.curves=["{point}"]')
    turn = gp.cycle.follow(scene, 48)
    spots = turn.points[point][~np.isnan(turn.points[point])]
    path = min(lines, key=lambda line: gap(line, spots).max())
    assert gap(path, spots).max() < 5 * READ * mm
    assert gap(path, np.array([complex(*map(float, scene.points[point]))]))[0] < READ * mm
    assert (abs(path[0] - path[-1]) < READ * mm) == turn.closed


@pytest.mark.parametrize(("name", "point"), [(str(CASES / "rocker.toml"), "A"), ("plough-lift", "B")])
def test_a_path_ends_where_the_motion_stops(name: str, point: str) -> None:
    """Between two dead centres a path has two ends, coupler and rocker in line in both; a cylinder has no turn, and its
    pistons' points go from limit to limit."""
    (path, *_), mm = drawn(name, f'sheet.curves=["{point}"]')
    assert abs(path[0] - path[-1]) > 10 * mm
    if name != "plough-lift":
        assert [abs(end - 60) for end in (path[0], path[-1])] == pytest.approx([85, 85], abs=READ * mm)


def test_positions_stand_at_equal_travels() -> None:
    """Twelve positions of a crank that goes round are thirty degrees apart, the given one first."""
    lines, mm = drawn("four-bar", 'sheet.curves=["A"]', "sheet.positions=12")
    ends = np.concatenate(lines)
    given = 20 + 110j
    for k in range(12):
        assert np.abs(ends - given * np.exp(1j * math.pi / 6 * k)).min() < 2 * READ * mm
    assert not drawn("five-bar")[0]


# ---- centrodes -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("link", "on", "points"), [("2", "frame", "AB"), ("3", "1", "CB"), ("1", "3", "OA")])
def test_centrodes_roll_on_each_other(link: str, on: str, points: str) -> None:
    """In every pose both lie in the pole, which both links carry along alike, and go on from there alike: they touch
    and do not slip."""
    scene, data = gp.load("four-bar"), table("four-bar", "--positions", "3600", "--centrodes", f"{link} {on}")
    turn = gp.cycle.follow(scene, 3600)
    given = {name: complex(*map(float, at)) for name, at in scene.points.items()}

    def carried(of: str, ends: str, spots: Any) -> Any:
        """Where spots of a link are in each pose."""
        if of == "frame":
            return spots
        p, q = ends
        turned = (turn.points[q] - turn.points[p]) / (given[q] - given[p])
        return turn.points[p] + (spots - given[p]) * turned

    base = {"frame": "OC", "1": "OA", "3": "CB"}[on]
    fixed, moving = (places(data["points"][f"{which} centrode {link} {on}"]) for which in ("fixed", "moving"))
    pole, other = carried(on, base, fixed), carried(link, points, moving)
    near = np.abs(pole) < 1e3
    assert near.sum() > 1800
    assert np.abs(pole - other)[near].max() < 1e-8
    steady = near[1:-1] & near[2:] & near[:-2]
    before, after = slice(None, -2), slice(2, None)
    of = {"frame": np.ones(3600), "1": (turn.points["A"] - turn.points["O"]) / given["A"],
          "2": (turn.points["B"] - turn.points["A"]) / (given["B"] - given["A"]),
          "3": (turn.points["B"] - turn.points["C"]) / (given["B"] - given["C"])}
    rolled = (fixed[after] - fixed[before]) * of[on][1:-1]
    rolling = (moving[after] - moving[before]) * of[link][1:-1]
    assert (np.abs(rolled - rolling)[steady] <= 1e-3 * (1 + np.abs(rolled)[steady])).all()


def test_a_bar_on_two_guides_has_cardan_circles() -> None:
    """A bar whose ends slide on two guides perpendicular to each other rolls with a circle over it in one of twice the
    size.
    """
    data = table(str(CASES / "trammel.toml"), "--positions", "31", "--from", "-50", "--to", "34", "--centrodes",
                 "2 frame")
    fixed, moving = (places(data["points"][f"{which} centrode 2 frame"]) for which in ("fixed", "moving"))
    assert np.abs(np.abs(fixed) - 50).max() < 1e-12 * 50
    assert np.abs(np.abs(moving - (15 + 20j)) - 25).max() < 1e-12 * 50


def test_branches_are_not_joined_through_infinity() -> None:
    """A coupler that twice turns as the frame does has centrodes of two branches, one cut where the travel begins, and
    no line joins them; a pin of two links is a centrode of one spot."""
    lines, mm = drawn("four-bar", 'sheet.centrodes=["2 frame"]')
    assert len(lines) >= 4
    assert max(np.abs(np.diff(line)).max() for line in lines) < 60 * mm
    data = table("four-bar", "--positions", "12", "--centrodes", "3 2")
    moving = places(data["points"]["fixed centrode 3 2"])
    assert np.abs(moving - (135 + 225j)).max() < 1e-9


# ---- stationary curvature --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["coupler", "rod"])
def test_the_cubic_of_stationary_curvature(name: str) -> None:
    """Points whose paths are circles or straight lines lie on the drawn cubic, their centres on the other curve; and
    over a small travel the curvature of its points' paths hardly changes, beside that of points near the curve."""
    scene, (lines, mm) = gp.load(CASES / f"{name}.toml"), drawn(str(CASES / f"{name}.toml"))
    pins = np.array([24 + 32j, 80 + 80j])
    circling = [line for line in lines if gap(line, pins).min() < 2 * READ * mm]
    assert all(min(gap(line, pins[k:k + 1])[0] for line in circling) < 2 * READ * mm for k in (0, 1))
    if name == "coupler":
        centres = [line for line in lines if not any(line is one for one in circling)] if len(lines) > 2 else lines
        assert min(gap(line, np.array([0j]))[0] for line in centres) < 2 * READ * mm
        assert min(gap(line, np.array([100 + 0j]))[0] for line in centres) < 2 * READ * mm

    def changed(place: complex) -> float:
        """By how much the curvature of a point's path changes a little before and after the given pose."""
        z = gp.cycle.follow(scene.replace("points.M", [place.real, place.imag]), 41, (-0.2, 0.2)).points["M"]
        v, a = (z[2:] - z[:-2]) / 2, z[2:] - 2 * z[1:-1] + z[:-2]
        curvature = (v.conj() * a).imag / np.abs(v)**3
        return abs(float(curvature[-1] - curvature[0]))

    near = np.concatenate(circling)
    near = near[np.abs(near - (50 + 50j)) < 60]
    for spot in near[:: max(1, near.size // 5)]:
        place = complex(spot)
        assert changed(place) < 3e-2 * changed(place + 3 + 2j)
