"""The table [governor] as it is read and checked."""

from __future__ import annotations

from fractions import Fraction
from math import pi
from typing import Any

from graphplan.mechanism.fields import Field, Table, TableRow
from graphplan.mechanism.governor import Governor
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.springs import TWO_POINTS
from graphplan.mechanism.values import LINK, NUMBER, VECTOR, name_list


def _governor(row: TableRow) -> Any:
    axis, (low, high) = row["axis"], row["between"]
    if not row["balls"]:
        return row.items["balls"].fault("no link", 'the links that carry the balls, such as ["1"]')
    if None in axis:
        return None
    if len({*axis}) < 2 or not {*axis} <= {*row.names.links.get(FRAME, ())}:
        return row.items["axis"].fault(f"{axis[0]}, {axis[1]}", "two points of the frame")
    if not low < high:
        return row.items["between"].fault("the range has no length", "such as between = [-15, 15]")
    if "speed" in row.items and "rpm" in row.items:
        return row.item.fault("speed and rpm are both given", "either speed in rad/s or rpm")
    speed = float(row["rpm"] / 30 * Fraction(pi)) if "rpm" in row.items else row.values.get("speed")
    if speed is not None and speed <= 0:
        return row.item.fault("a speed that is not above 0", "such as rpm = 300")
    return Governor(row["balls"], axis, (low, high), speed)


GOVERNOR = Table("a centrifugal governor", (
    Field("balls", "the links whose masses revolve, all at one distance from the axis",
          name_list("link", '["1"]', lambda names: names.moving, entry=LINK), 'balls = ["1"]'),
    Field("axis", "two points of the frame on the spindle's axis", TWO_POINTS, 'such as axis = ["O", "Z"]'),
    Field("between", "its range: two travels of the first drive from the given pose, in degrees (in lengths where it "
          "slides)", VECTOR, "such as between = [-15, 15]"),
    Field("speed", "the speed of the spindle, in rad/s; without it the mean of those of the range", NUMBER),
    Field("rpm", "the same in turns a minute, instead of speed", NUMBER),
), _governor)
