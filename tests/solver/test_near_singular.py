"""Poses that come near a special one, 1e-2 to 1e-14 from it: `near_singular.toml` has them, this is what holds of them.

Nine digits of all that is printed are right, by whatever way it is drawn; asked for twelve, twelve; as fractions, all;
many poses at once are what each is alone, and lose no more digits than floats must. In the special pose itself no
number is printed that does not exist. All through `import graphplan`: however the numbers are found, these hold.
"""

from __future__ import annotations

import tomllib
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from claims_of_equations import wrong

import graphplan as gp

HERE = Path(__file__).parent
FAMILIES: list[dict[str, Any]] = tomllib.loads((HERE / "near_singular.toml").read_text(), parse_float=Decimal)["family"]
each_family = pytest.mark.parametrize("family", FAMILIES, ids=[family["name"] for family in FAMILIES])


def text(name: str) -> str:
    """A scene beside this file, or one that is packaged."""
    path = HERE / "scenes" / f"{name}.toml"
    return path.read_text() if path.exists() else str(gp.load(name).text)


def at(ends: list[list[Any]], distance: Decimal) -> list[Decimal]:
    """Where a point is, or how a guide runs, at a distance from the special pose."""
    return [Decimal(start) + distance * Decimal(way) for start, way in zip(*ends, strict=True)]


def posed(family: dict[str, Any], distance: Decimal) -> gp.WrittenScene:
    """The scene at a distance from its special pose; of its motion all joints are asked for."""
    tables = {key: table for key, table in tomllib.loads(text(family["scene"]), parse_float=Decimal).items()
              if key not in ("vary", "sheet")}
    for name, ends in family.get("moved", {}).items():
        tables["points"][name] = at(ends, distance)
    if "guide" in family:
        tables["slides"][0]["direction"] = at(family["guide"], distance)
    if "drive" in family:
        tables["drive"] = [family["drive"]]
    names = [name for points in tables["links"].values() for name in points.split()]
    joints = [name for name in dict.fromkeys(names) if names.count(name) > 1]
    return gp.scene(tables | {"find": tables.get("find", {}) | {"velocity": joints, "acceleration": joints}})


@each_family
def test_nine_digits_are_right_by_every_way(family: dict[str, Any]) -> None:
    """At each distance the pose is solved, in turn as it is drawn by itself and by the ways that are asked for."""
    for power in range(2, 15):
        scene = posed(family, Decimal(10) ** -power)
        way = [{}, *family["ways"]][power % 3]
        assert wrong(scene, gp.solve(scene, **way), 1e-9, tuple(family.get("cancel", ()))) == [], (power, way)


@each_family
@pytest.mark.parametrize("power", [4, 13])
def test_twelve_digits_are_right_where_they_are_asked_for(family: dict[str, Any], power: int) -> None:
    """With `digits` each number of a vector has them itself, whatever cancels in it."""
    pytest.importorskip("flint")
    scene = posed(family, Decimal(10) ** -power)
    assert wrong(scene, gp.solve(scene, digits=12), 5e-12, alone=True) == []


@each_family
def test_exact_numbers_are_those_of_the_solver(family: dict[str, Any]) -> None:
    """With `exact` construction and solver are the same fractions."""
    scene = posed(family, Decimal("1e-7"))
    found = gp.solve(scene, exact=True)
    assert wrong(scene, found, 0.0) == []
    assert not any(found.check.values())


def many(family: dict[str, Any], distances: list[Decimal]) -> dict[str, Any]:
    """The poses as `evaluate` takes them."""
    def places(ends: list[list[Any]]) -> Any:
        return np.array([complex(*map(float, at(ends, distance))) for distance in distances])

    return {"points": {name: places(ends) for name, ends in family.get("moved", {}).items()},
            "guides": {"2 along 3": places(family["guide"])} if "guide" in family else None}


@each_family
@pytest.mark.parametrize("compiled", [False, True])
def test_many_poses_are_what_each_is_alone(family: dict[str, Any], compiled: bool) -> None:
    """All distances and the special pose at once, by machine code or not: the last bit is that of each by itself."""
    if compiled:
        pytest.importorskip("numba")
    distances = [*(Decimal(10) ** -power for power in range(1, 15)), Decimal(0)]
    drawing = gp.construct(posed(family, distances[0]))
    together = drawing.evaluate(**many(family, distances), compiled=compiled)
    assert {*together.results} >= {"velocity", "acceleration"}
    for place, distance in enumerate(distances):
        alone = drawing.evaluate(**many(family, [distance]))
        for kind, named in together.results.items():
            for name, z in named.items():
                assert np.array_equal(z[place:place + 1], alone.results[kind][name], equal_nan=True), (kind, name)
        assert (place in together.faults) == (0 in alone.faults)
    assert together.faults.keys() <= {12, 13, 14}


@each_family
def test_floats_lose_no_more_digits_than_they_must(family: dict[str, Any]) -> None:
    """The drawing steps in plain floats keep their digits, or lose them in proportion to the distance."""
    distances = [Decimal(10) ** -power for power in range(1, 12)]
    found = gp.construct(posed(family, distances[0])).evaluate(**many(family, distances))
    for place, distance in enumerate(distances):
        rates = gp.analytic.solve(posed(family, distance), exact=True)
        for kind in ("velocity", "acceleration"):
            right = {name: complex(*map(float, value)) for name, value in getattr(rates, kind).items()}
            allowed = max(map(abs, right.values())) * (1e-12 if family.get("keeps") else 1e-12 / float(distance))
            for name, z in getattr(found, kind).items():
                assert abs(z[place] - right[name]) <= allowed, (kind, name, distance)


@each_family
def test_in_the_special_pose_nothing_is_printed_that_does_not_exist(family: dict[str, Any]) -> None:
    """What the mechanism has is told, and is right; of the rest it is said why there is none, and of which links."""
    if family.get("refused"):
        with pytest.raises(gp.SceneError, match=family["refused"]):
            posed(family, Decimal(0))
        return
    scene = posed(family, Decimal(0))
    links = family.get("singular")
    if not links:
        assert wrong(scene, gp.solve(scene), 1e-9) == []
        return
    for exact in (False, True):
        with pytest.raises(gp.SingularPose) as caught:
            (gp.analytic.reactions if scene.loads else gp.analytic.solve)(scene, exact)
        assert [*caught.value.links] == links
    try:
        found = gp.solve(scene)
    except gp.SingularPose as error:  # nothing that is asked for exists
        assert [*error.links] == links
        return
    assert found.reasons
    for kind, key in (("velocity", "points"), ("acceleration", "points"), ("omega", "links"), ("alpha", "links")):
        missing = found.reasons.get(key, {})
        for name, value in getattr(found, kind).items():
            assert (value != value) == (name in missing), (kind, name)
