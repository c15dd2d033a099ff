"""Mechanisms of the program Linkage (.linkage2): connectors, links, slots, inputs, actuators.

A connector that is an anchor is fixed; one that is an input turns its links by its rpm, clockwise positive. A slider
runs between two others, which are of one link, or anchors. An actuator is a link of two connectors whose length
grows and shrinks by its throw, cpm times a minute. Coordinates are in units of the program's own, 96 to an inch on
its screen, y upwards. What is on the drawing layer moves nothing.

Source: D. Rector's Linkage, its reader and writer of files (`CLinkageDoc`) and its simulator.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

from graphplan.errors import Refused
from graphplan.importing.sketch import LinkageSketch, SketchDrive, SketchGuide, Slot
from graphplan.importing.written import number
from graphplan.marking.files.safe import number as read_number
from graphplan.marking.files.safe import tree
from graphplan.mechanism.model import FRAME

DRAWING = 0xF  # the layers of what only is drawn
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
STROKES_PER_CYCLE = 30  # an actuator makes its throw twice in a cycle


def read(path: Path, data: bytes) -> LinkageSketch:
    """The linkage of a file."""
    root = tree(path, data)
    if root.tag != "linkage2":
        raise Refused(f"{path}", "not a file of the program Linkage", "a file that it saved, .linkage2")
    try:
        return _Linkage(root).sketch
    except ValueError as error:
        raise Refused(f"{path}", f"the file is damaged ({error})", "save it anew") from None


class _Linkage:
    def __init__(self, root: Element):
        self.sketch = LinkageSketch("Linkage")
        self.sketch.note("the unit of length: the file's own units, 96 to an inch on Linkage's screen, are read as mm")
        connectors = {connector.get("id", ""): connector for connector in root.iter("connector") if "x" in
                      connector.attrib and _moves(connector)}
        for key, connector in connectors.items():
            self.add_connector(key, connector)
        gears = 0
        for link in root:
            if link.tag in ("Link", "element") and _moves(link):
                gears += _true(link, "gear")
                self.add_link(link)
        for key, connector in connectors.items():
            if _true(connector, "slider"):
                self.add_slider(key, connector)
            if _true(connector, "input"):
                self.add_drives(key, connector)
        if gears:
            self.sketch.note(f"{gears} gears or chain wheels were left out")
        for ratio in root.iter("ratio"):
            sizes = " : ".join(wheel.get("size", "?") for wheel in ratio)
            wheels = " and ".join(wheel.get("id", "?") for wheel in ratio)
            self.sketch.note(f"{ratio.get('type', 'gears')} between the links of id {wheels}, sizes {sizes}: left out")

    def add_connector(self, key: str, connector: Element) -> None:
        at = complex(read_number(connector.get("x", "")), read_number(connector.get("y", "")))
        self.sketch.point(key, at, connector.get("name", "").strip() or _letter(key))
        if _true(connector, "anchor"):
            self.sketch.fixed[key] = None

    def add_link(self, link: Element) -> None:
        points = [point for point in (element.get("id", "") for element in link if element.tag == "connector")
                  if point in self.sketch.places]
        name = link.get("name", "").strip()
        if _true(link, "gear") or not points:
            return
        if _true(link, "actuator") and len(points) == 2:
            self.add_actuator(link, points, name)
        else:
            self.sketch.link(points, name=name)

    def add_actuator(self, link: Element, points: list[str], name: str) -> None:
        """A barrel and a rod that slides in it."""
        sketch, (start, end) = self.sketch, points
        barrel = sketch.link([start], name=f"{name} barrel" if name else "")
        rod = sketch.link([end], name=f"{name} rod" if name else "")
        sketch.guides.append(SketchGuide(rod, barrel, end, (start, end)))
        throw, cycles = (read_number(link.get(key, "0") or "0") for key in ("throw", "cpm"))
        speed = throw * cycles / STROKES_PER_CYCLE
        motion = f"throw {number(throw)}, {number(cycles)} cycles a minute"
        remark = f"An actuator: {motion}, here at the speed of its stroke."
        if not speed:
            remark, speed = "An actuator; its speed is a guess.", 1.0
        sketch.drives.append(SketchDrive(rod, f"speed = {number(speed)}", remark, barrel, True))

    def add_slider(self, key: str, connector: Element) -> None:
        limits = [limit.get("id", "") for limit in connector if limit.tag == "slidelimit"]
        sketch = self.sketch
        name = sketch.names[key]
        if len(limits) != 2 or not {*limits} <= sketch.places.keys() or limits[0] == limits[1]:
            return sketch.note(f"{name} slides, but the file does not tell along what: left out")
        if read_number(connector.get("slideradius", "0") or "0"):
            return sketch.note(f"{name} slides in a curved slot, of radius {connector.get('slideradius')}: left out")
        along = next((link for link, points in sketch.links.items() if {*limits} <= {*points}), FRAME)
        if along == FRAME and not {*limits} <= sketch.fixed.keys():
            return sketch.note(f"{name} slides between connectors that are on no one link: left out")
        return sketch.slots.append(Slot(key, along, (limits[0], limits[1])))

    def add_drives(self, key: str, connector: Element) -> None:
        """An anchored input turns each of its links."""
        sketch, written = self.sketch, connector.get("rpm", "")
        links = [link for link, points in sketch.links.items() if key in points and len(points) > 1]
        if not _true(connector, "anchor"):
            return sketch.note(f"{sketch.names[key]} is an input that is no anchor, rpm {written}: left out")
        speed = -read_number(written) if written else 0.0
        remark = "" if speed else "The file tells no speed: 1 rad/s is a guess."
        rate = f"rpm = {number(speed)}" if speed else "omega = 1"
        return sketch.drives.extend(_drives_of(links, rate, remark))


def _drives_of(links: list[str], rate: str, told: str) -> Iterator[SketchDrive]:
    yield from (SketchDrive(link, rate, told) for link in links)


def _true(element: Element, name: str) -> bool:
    return element.get(name) == "true"


def _moves(element: Element) -> bool:
    """Whether it is on a layer of the mechanism, and measures nothing."""
    layer = element.get("layer", "")
    is_drawing = layer.isdecimal() and 0 < int(layer[:9]) <= DRAWING
    return not is_drawing and not _true(element, "measurementelement")


def _letter(key: str) -> str:
    """The letter by which Linkage shows a connector without a name."""
    place = int(key) if key.isdecimal() and len(key) < 7 else 0
    return LETTERS[place % 52] + (str(place // 52) if place >= 52 else "")
