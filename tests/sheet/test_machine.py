"""The machine under a mechanism: what of it is drawn from a scene's data."""

from __future__ import annotations

import math

import pytest
import shapely
from higher import scenes
from sheets import composition_of

import graphplan as gp
from graphplan.mechanism.model import Scene
from graphplan.output.svg import svg
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Polygon, Polyline, Rect
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.machine import LAYER, PinSlot, _slots, machine_items, wheel_reach
from graphplan.sheet.plates.teeth import _meshes, teeth
from graphplan.sheet.plates.view import View

EVERYWHERE = Rect(-math.inf, -math.inf, math.inf, math.inf)


def mechanism(scene: Scene, size_mm: float = 150.0) -> DrawnMechanism:
    """A mechanism so large on paper."""
    return DrawnMechanism(scene, View(EVERYWHERE, size_mm / scene.extent, (0.0, 0.0)))


def slot_of(name: str) -> PinSlot:
    return next(_slots(mechanism(gp.load(name))))


@pytest.mark.parametrize("name", ["planetary", "biplanetary", "gear-linkage", "geared-five-bar", "racks",
                                  "cardan-circles"])
def test_teeth_mesh(name: str) -> None:
    """At every pitch point the teeth of the one wheel stand in the gaps of the other, and their flanks meet there."""
    scene = scenes().get(name) or gp.load(name)
    drawn = mechanism(scene)
    chains = [shapely.LineString(chain) for chain in teeth(scene, drawn.view)]
    for mesh in _meshes(scene, drawn.view):
        module = mesh.wheels[0].module
        about = shapely.Point(mesh.pole).buffer(1.2 * module)
        near = [chain for chain in chains if chain.intersection(about).length > module]
        assert len(near) >= 2
        for line in near[1:]:
            assert line.intersection(near[0]).length < 0.2 * module  # they touch, and none lies along the other
        sides = shapely.union_all(near[:2])
        assert sides.intersection(about).length > 2 * module


@pytest.mark.parametrize(("numbers", "toothed"), [((2, 3), False), ((9, 40), False), ((12, 18), True)])
def test_wheels_of_few_teeth_are_pitch_circles(numbers: tuple[int, int], toothed: bool) -> None:
    """Numbers such as 2 and 3 tell a ratio: no flanks are drawn for them."""
    scene = gp.scene({"points": {"O": (0, 0), "C": (100, 0), "A": (30, 20), "B": (120, 40)},
                      "links": {"1": "O A", "2": "C B", "frame": "O C"}, "drive": [{"link": "1", "omega": 10}],
                      "gears": [{"links": ["1", "2"], "centres": ["O", "C"], "teeth": numbers}]})
    assert bool([*teeth(scene, mechanism(scene).view)]) == toothed


def test_wheels_have_their_numbers_of_teeth() -> None:
    """The angle from tooth to tooth is that of the number of teeth."""
    scene = gp.load("planetary")
    for mesh in _meshes(scene, mechanism(scene).view):
        assert [round(math.tau / wheel.pitch, 6) for wheel in mesh.wheels] == list(map(float, mesh.gear.teeth or ()))


@pytest.mark.parametrize("name", ["slotted-link", "shaper", "ozols-13-6", "geneva"])
def test_a_slot_is_as_long_as_the_way_of_its_pin(name: str) -> None:
    """Over a turn of the crank the pin comes to both ends of the slot, and not beyond."""
    scene, slot = gp.load(name), slot_of(name)
    crank, radius = complex(*slot.crank), math.dist(slot.crank, slot.at)
    pins = [crank + radius * complex(math.cos(t), math.sin(t)) for t in (math.radians(k) for k in range(360))]
    if slot.wheel or name in ("slotted-link", "shaper"):
        drawn = mechanism(scene)
        pivot = complex(*(slot.wheel or drawn.spots["P"]))
        way = [abs(pin - pivot) - abs(complex(*slot.at) - pivot) for pin in pins]
    else:
        along = complex(*slot.along)
        way = [((pin - complex(*slot.at)) * along.conjugate()).real for pin in pins]
    assert (slot.low, slot.high) == pytest.approx((min(way), max(way)), abs=0.02)


@pytest.mark.parametrize(("name", "slots"), [("geneva", 4), ("geneva-slide", 4), ("slotted-link", 0), ("shaper", 0),
                                             ("ozols-13-6", 0)])
def test_a_geneva_wheel_is_known_by_its_sizes(name: str, slots: int) -> None:
    """It has so many slots; a swinging slotted link has its one."""
    assert slot_of(name).slots == slots
    assert bool(slot_of(name).geneva_wheel) == bool(slots)


def test_an_entering_pin_goes_along_its_slot() -> None:
    """The mouth of the next slot lies on the pin's circle, and there the slot is tangent to that."""
    slot = slot_of("geneva")
    assert slot.wheel is not None
    distance, radius = math.dist(slot.crank, slot.wheel), math.dist(slot.crank, slot.at)
    rim = max(math.dist(slot.wheel, spot) for spot in slot.geneva_wheel)
    assert math.hypot(rim, radius) == pytest.approx(distance, rel=5e-3)


@pytest.mark.parametrize("name", ["geneva", "geneva-slide"])
def test_a_geneva_wheel_is_whole_on_its_sheet(name: str) -> None:
    """The panel has room for it and for the crank's disc: no outline ends at the panel's edge."""
    view = next(iter(composition_of(name).views.values()))
    corners = [view(corner) for corner in wheel_reach(gp.load(name))]
    assert len(corners) == 4
    assert all(view.rect.holds(corner) for corner in corners)


def test_linkages_of_bars_have_no_machine() -> None:
    """Where pairs tell no more than joints, nothing is added."""
    assert not list(machine_items(mechanism(gp.load("four-bar"))))


@pytest.mark.parametrize("name", ["planetary", "geneva", "arc-cam"])
def test_the_machine_is_a_layer_of_its_own(name: str) -> None:
    """It lies under everything that is drawn, within its panel, and its lines keep off letters."""
    composition = composition_of(name)
    sheet = layout(composition)
    rect = next(iter(composition.views.values())).rect
    items = [item for item in sheet.items if item.layer == LAYER]
    spots = [spot for item in items if isinstance(item, Polygon | Polyline) for spot in item.spots]
    assert spots
    assert all(rect.holds(spot, 0.01) for spot in spots)
    assert {item.pen for item in items} <= {pens.MACHINE, pens.BODY}
    assert svg(sheet).index('class="layer-machine"') < svg(sheet).index('class="layer-links"')
