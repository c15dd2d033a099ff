"""Mechanisms of the program Linkage (.linkage2): connectors, links, slots, inputs, actuators.

A connector that is an anchor is fixed; one that is an input turns its links by its rpm, clockwise positive. A slider
runs between two others, which are of one link, or anchors. An actuator is a link of two connectors whose length
grows and shrinks by its throw, cpm times a minute. A gear turns about its connector; a ratio ties two of them, by
teeth or by a chain; their sizes are a ratio, so that the radii of gears follow from the distance of their centres. What
is fastened to a link or a connector is a part of it: to an anchor, of the frame. Coordinates are in units of the
program's own, 96 to an inch on its screen, y upwards. What is on the drawing layer moves nothing.

Source: D. Rector's Linkage, its reader and writer of files (`CLinkageDoc`) and its simulator.
"""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path
from xml.etree.ElementTree import Element

from graphplan.errors import Refused
from graphplan.importing.sketch import LinkageSketch, SketchDrive, SketchGuide, Slot, absorb
from graphplan.importing.tolerances import SLOT_TOL
from graphplan.importing.written import number
from graphplan.marking.files.safe import number as read_number
from graphplan.marking.files.safe import tree
from graphplan.mechanism.model import FRAME

DRAWING = 0xF  # the layers of what only is drawn
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
MAX_TEETH = 1000  # of the second wheel
READ = {"connector": "id x y name anchor input rpm slider slideradius fastenlink fasten",
        "Link": "id name actuator throw cpm gear fastenlink fastenconnector", "ratio": "type sizeassize",
        "link": "id size", "slidelimit": "id", "ratios": "", "linkage2": ""}  # elements, and their attributes
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
        for element in root.iter():
            columns = READ.get(element.tag.replace("element", "Link"))
            self.sketch.left_out[f"element {element.tag}"] += columns is None
            for name, value in element.items():
                if name not in (columns or "").split() or value == "false":
                    self.sketch.left_out[f"{name} of {element.tag}"] += 1
        elements = [connector for connector in root.iter("connector") if "x" in connector.attrib and _moves(connector)]
        connectors = {connector.get("id", ""): connector for connector in elements}
        if len(connectors) < len(elements) or "" in connectors:
            raise ValueError("a connector has no id of its own")
        for key, connector in connectors.items():
            self.add_connector(key, connector)
        links = [link for link in root if link.tag in ("Link", "element") and _moves(link)]
        self.sketch.contents.update({"connectors": len(connectors), "links": len(links), "attributes": sum(
            len(element.attrib) for element in root.iter())})
        self.links, self.centres = dict[str, str](), dict[str, str]()
        for link in links:
            self.add_link(link)
        for link in links:
            self.fasten_link(link)
        for ratio in root.iter("ratio"):
            self.add_gears(ratio)
        for key, connector in connectors.items():
            if whole := self.links.get(connector.get("fastenlink") or connector.get("fasten") or "none"):
                if whole == FRAME:
                    self.sketch.fixed[key] = None
                else:
                    self.sketch.hold(whole, key)
            if _true(connector, "slider"):
                self.add_slider(key, connector)
            if _true(connector, "input"):
                self.add_drives(key, connector)

    def add_connector(self, key: str, connector: Element) -> None:
        at = complex(read_number(connector.get("x", "")), read_number(connector.get("y", "")))
        self.sketch.point(key, at, connector.get("name", "").strip() or _letter(key))
        if _true(connector, "anchor"):
            self.sketch.fixed[key] = None

    def add_link(self, link: Element) -> None:
        points = [point for point in (element.get("id", "") for element in link if element.tag == "connector")
                  if point in self.sketch.places]
        name = link.get("name", "").strip()
        self.sketch.left_out["connectors of links that only are drawn, or are missing"] += len(link) - len(points)
        if not points:
            self.sketch.left_out["links without connectors"] += 1
            return
        if _true(link, "actuator") and len(points) == 2:
            self.add_actuator(link, points, name)
        else:
            key = link.get("id", "")
            self.links[key], self.centres[key] = self.sketch.link(points, name=name), points[0]

    def fasten_link(self, link: Element) -> None:
        """A link that is a part of another, or of what has a connector."""
        key, whole = (self.links.get(link.get(name) or "none") for name in ("id", "fastenlink"))
        holders = [holder for holder in self.sketch.holders(link.get("fastenconnector", "")) if holder != key]
        if len(holders) == 1 or FRAME in holders:
            whole = holders[-1]
        if key and whole and key != whole:
            absorb(self.sketch, key, whole)
            self.links = {name: whole if part == key else part for name, part in self.links.items()}

    def add_gears(self, ratio: Element) -> None:
        """Two gears, or two wheels of a chain, each about the first connector of its link."""
        kind, ids = ratio.get("type", "gears"), [wheel.get("id", "") for wheel in ratio]
        sizes = [read_number(wheel.get("size") or "0") for wheel in ratio]
        ends = [self.centres[key] for key in ids if key in self.links]
        if len({self.sketch.places[end] for end in ends}) != 2 or not min(sizes) > 0:
            return self.sketch.note(f"{kind} between the links of id {' and '.join(ids)}, "
                                    f"sizes {' : '.join(map(number, sizes))}: left out")
        first, second = (self.links[key] for key in ids)
        if kind == "gears":
            apart = abs(self.sketch.places[ends[0]] - self.sketch.places[ends[1]])
            gear: tuple[str, ...] = (f"radii = [{', '.join(number(apart * size / sum(sizes)) for size in sizes)}]",)
        elif kind == "chain" and _true(ratio, "sizeassize"):
            gear = f"radii = {sizes}", 'belt = "open"'
        elif kind == "chain":
            teeth = [*Fraction(sizes[0] / sizes[1]).limit_denominator(MAX_TEETH).as_integer_ratio()]
            self.sketch.note(f"a chain, {' : '.join(map(number, sizes))}: its numbers of teeth are a guess")
            gear = f"teeth = {teeth}", 'belt = "open"'
        else:
            return self.sketch.note(f"a ratio of the type {kind!r}: left out")
        return self.sketch.guides.append(SketchGuide(first, second, ends[0], (ends[0], ends[1]), gear))

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
        if len(limits) != 2 or len({sketch.places[limit] for limit in limits if limit in sketch.places}) != 2:
            return sketch.note(f"{name} slides, but the file does not tell along what: left out")
        along = next((link for link, points in sketch.links.items() if {*limits} <= {*points}), FRAME)
        if along == FRAME and not {*limits} <= sketch.fixed.keys():
            return sketch.note(f"{name} slides between connectors that are on no one link: left out")
        if radius := read_number(connector.get("slideradius", "0") or "0"):
            return self.add_curved_slot(key, along, limits, radius)
        return sketch.slots.append(Slot(key, along, (limits[0], limits[1])))

    def add_curved_slot(self, key: str, along: str, limits: list[str], radius: float) -> None:
        """A slot along an arc from one limit to the other, its centre to the left of that way where the radius is
        positive: the pin's distance from it stays, so that a link ties the pin to the centre."""
        sketch, (start, end) = self.sketch, (self.sketch.places[limit] for limit in limits)
        name, half = sketch.names[key], abs(end - start) / 2
        high = math.copysign(math.sqrt(max(0.0, radius**2 - half**2)), radius)
        middle, up = (start + end) / 2, 1j * (end - start) / (2 * half)
        missed = {centre: abs(abs(sketch.places[key] - centre) - max(abs(radius), half))
                  for centre in (middle + high * up, middle - high * up)}
        centre = min(missed, key=lambda spot: missed[spot] > SLOT_TOL * abs(radius))
        if missed[centre] > SLOT_TOL * abs(radius) or not [one for one in sketch.holders(key) if one != along]:
            return sketch.note(f"{name} slides in a curved slot, of radius {number(abs(radius))}, but is not in it, or "
                               "no link has it: left out")
        pivot = sketch.point(f"centre of {key}", centre)
        if along == FRAME:
            sketch.fixed[pivot] = None
        else:
            sketch.hold(along, pivot)
        sketch.link([pivot, key], name=f"slot of {name}")
        return sketch.note(f"{name} slides in a curved slot, of radius {number(abs(radius))}: a link from the slot's "
                           "centre stands for it")

    def add_drives(self, key: str, connector: Element) -> None:
        """An anchored input turns each of its links."""
        sketch, written = self.sketch, connector.get("rpm", "")
        geared = {link for guide in sketch.guides for link in (guide.link, guide.along)}
        links = [link for link, points in sketch.links.items() if key in points and (len(points) > 1 or link in geared)]
        if not _true(connector, "anchor"):
            return sketch.note(f"{sketch.names[key]} is an input that is no anchor, rpm {written}: left out")
        speed = -read_number(written) if written else 0.0
        remark = "" if speed else "The file tells no speed: 1 rad/s is a guess."
        rate = f"rpm = {number(speed)}" if speed else "omega = 1"
        return sketch.drives.extend(SketchDrive(link, rate, remark) for link in links)


def _true(element: Element, name: str) -> bool:
    return element.get(name) == "true"


def _moves(element: Element) -> bool:
    """Whether the element is on a layer of the mechanism, and is not a measurement."""
    layer = element.get("layer", "")
    is_drawing = layer.isdecimal() and 0 < int(layer[:9]) <= DRAWING
    return not is_drawing and not _true(element, "measurementelement")


def _letter(key: str) -> str:
    """The letter by which Linkage shows a connector without a name."""
    place = int(key) if key.isdecimal() and len(key) < 7 else 0
    return LETTERS[place % 52] + (str(place // 52) if place >= 52 else "")
