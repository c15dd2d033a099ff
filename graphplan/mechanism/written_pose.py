"""The pose of a scene as it is written: in the words that `--at` takes, and as the first line of a sheet's scene.

The text of a scene has its mechanism in the given pose. Drawn in another one, it says so in a comment above all keys.
"""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene_text import decimal_text

EXACT_TRAVEL = r"-?\d{1,80}(?:[./]\d{1,80})?"  # no exponents: a short text may not be a number that fills the memory
POSE_LINE = re.compile(rf"# drawn with --at ({EXACT_TRAVEL}(?:,{EXACT_TRAVEL})*|(?:outer|inner)[^\n]{{0,100}})\n")
MAX_TRAVEL = 36_000  # degrees or lengths: a hundred turns, which are all followed [0.4 s; 100,000 turns: > 40 s]
GIVEN_POSE = "0"


def pose_text(scene: Scene) -> str:
    """The pose as `--at` takes it: the travel of each drive, exact, or an extreme position; empty if it is the given
    one."""
    if scene.assembly is None:
        return ""
    if extreme := scene.assembly.extreme:
        return f"{extreme.way} {extreme.link}".strip()
    return ",".join(decimal if Fraction(decimal := decimal_text(travel)) == travel else str(travel)
                    for travel in scene.assembly.travels)


def with_pose(text: str, scene: Scene) -> str:
    """The text of a scene with the line that says its pose, if that is not the given one; of no text none."""
    if line := POSE_LINE.match(text):  # a sheet's own text says the pose that it was drawn in then
        text = text[line.end():]
    pose = pose_text(scene)
    return f"# drawn with --at {pose}\n{text}" if text and pose else text


def written_pose(text: str) -> str:
    """The pose that the first line of a text says; empty where it says none, or one that is refused as too far."""
    if line := POSE_LINE.match(text):
        with suppress(Refused):
            parse_pose(line[1])
            return line[1].strip()
    return ""


def parse_pose(text: str) -> list[Fraction] | str:
    """The travel of each drive, or of the first alone, or the words for an extreme position.

    Fails with `Refused` where a text is neither, or a travel is so far that to follow it would take too long.
    """
    if text.strip()[:1].isalpha():
        return text
    try:
        travels = [Fraction(travel.strip()) for travel in text.split(",")]
        sum(map(float, travels))  # OverflowError: a travel that is larger than any float
    except (ValueError, ZeroDivisionError, OverflowError):
        raise Refused(f"--at {text}", "not a travel", "degrees or lengths, such as 60, or 60,-30") from None
    if max(map(abs, travels)) > MAX_TRAVEL:
        raise Refused(f"--at {text}", "too far: every turn is followed", f"at most {MAX_TRAVEL} degrees or lengths")
    return travels
