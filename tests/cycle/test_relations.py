"""The relations of a scene: in every pose that the drives and dragged pins lead to, each point is where the linkage has
it."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from dragged_linkages import DraggedLinkage
from face import names

import graphplan as gp
from graphplan.cycle.relations import Relations, relations
from graphplan.cycle.turn import points_under_slides
from graphplan.mechanism.travel import paces
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.view import View

VIEW = View(Rect(0, 0, 200, 200), 0.5, (30.0, 40.0))
DRAGS, FAR = 3, 0.05  # of each scene; how far a pin goes, of the linkage's extent


def relations_of(name: str) -> Relations:
    found = relations(gp.load(name), VIEW)
    assert found is not None
    return found


def travels(found: Relations, rng: Random) -> list[float]:
    """Travels of all drives, in radians and scene lengths; drives on a moving base go each their own way."""
    scene = found.scene
    if not scene.drives:
        return []
    first = rng.uniform(*found.limits) / (VIEW.scale if scene.drives[0].slides else 1.0)
    return [pace * first for pace in paces(scene)]


def dragged(found: Relations, rng: Random) -> tuple[dict[str, complex], list[float]]:
    """A pin somewhere near, if one is free, and the drives anywhere."""
    if not found.free:  # all its pins hold wheels apart
        return {}, travels(found, rng)
    name = rng.choice(found.free)
    x, y = (float(part) for part in found.scene.points[name])
    far = FAR * found.scene.extent
    return {name: complex(x + rng.uniform(-far, far), y + rng.uniform(-far, far))}, travels(found, rng)


def placed_from(found: Relations, pins: dict[str, complex]) -> dict[str, complex]:
    """The pins of the frame that the scene lays off from a dragged one: they go as far as that."""
    placements, at = found.scene.placements, found.scene.points
    froms = {name: placements[name].data["from"] for name in found.scene.links.get("frame", ())
             if name in placements and placements[name].how == "polar"}
    return {name: pins[start] + complex(*map(float, at[name])) - complex(*map(float, at[start]))
            for name, start in froms.items() if start in pins}


@pytest.mark.parametrize("name", names())
def test_the_linkage_follows(name: str) -> None:
    """Wherever a linkage can be led by its drives and a dragged pin, its relations put every point there."""
    found, scene, rng = relations_of(name), gp.load(name), Random(name)
    linkage, led = DraggedLinkage(found.scene), 0
    for _ in range(DRAGS):
        pins, drives = dragged(found, rng)
        truth = linkage.dragged(pins | placed_from(found, pins), drives)
        if truth is None:
            continue
        led += 1
        truth |= {one: truth[at] for one, at in points_under_slides(found.scene).items()}
        on_paper = [VIEW.scale * t if d.slides else t for d, t in zip(scene.drives, drives, strict=True)]
        told = found.pose({one: VIEW((z.real, z.imag)) for one, z in pins.items()}, on_paper)
        assert told is not None
        for point, z in truth.items():
            assert abs(complex(*told[0][point]) - complex(*VIEW((z.real, z.imag)))) < 1e-6 * scene.extent * VIEW.scale
    assert led


def test_beyond_a_limit_there_is_nothing() -> None:
    """Where a linkage cannot be put together there is no pose, and it comes back with the pin."""
    for found in map(relations_of, ("triad", "four-bar")):
        assert found.pose({}, [0.0]) is not None
        assert found.pose({"O": (900.0, 900.0)}, [0.0]) is None


def test_slides_go_by_their_stroke() -> None:
    """On the paper a slider goes from its inner to its outer position, on either side of the given one."""
    (low, high), = relations_of("slider-crank").slide_ranges.values()
    assert high - low == pytest.approx(VIEW.scale * 2 * abs(90 + 80j), rel=1e-2)
    assert low < 0 < high


def test_points_that_the_scene_places_from_pins() -> None:
    """A pin that is placed by compasses from others keeps its distances when those are dragged."""
    scene = gp.load(Path(__file__).parents[1] / "cases" / "cycle" / "placed.toml")
    found = relations(scene, VIEW)
    assert found is not None
    assert "P" not in found.free
    told = found.pose({"O": (40.0, 52.0)}, [1.0])
    assert told is not None
    far = [abs(complex(*told[0]["P"]) - complex(*told[0][centre])) for centre in "OC"]
    assert far == pytest.approx([100.0, 105.0])
