"""The fixed link is called frame; who calls it otherwise is told so, in one line that names the link."""

from __future__ import annotations

import re

import pytest

import graphplan as gp
from graphplan.errors import SceneError
from graphplan.mechanism.scene import load, parse

NAMES = ("ground", "0", "Frame", "base", "Gestell", "стойка", "alus")


def _lines(text: str) -> tuple[str, ...]:
    with pytest.raises(SceneError) as error:
        parse(text, "scene.toml")
    return error.value.lines


@pytest.mark.parametrize("name", NAMES)
def test_a_fixed_link_of_another_name_is_named(name: str) -> None:
    """One fault at that link, with the line as it should be, and nothing about freedoms that it only seems to have."""
    text = re.sub(r"(?m)^frame( *=)", rf'"{name}"\1', load("slider-crank").text).replace('"frame"', f'"{name}"')
    place = name if name.isascii() else f'"{name}"'
    assert _lines(text) in {(f'scene.toml: links.{where}: link {name} would move: the fixed link is called frame; '
                             'frame = "O"',) for where in (name, place)}


@pytest.mark.parametrize("name", NAMES)
def test_a_reference_to_it_by_another_name_says_frame(name: str) -> None:
    """Where a slide or a pole speaks of the fixed link by another name, frame is what was probably meant."""
    text = load("slider-crank").text.replace('along = "frame"', f'along = "{name}"')
    assert f"there is no link {name}; perhaps frame" in "\n".join(_lines(text))
    asking = load("slider-crank").text.replace("[find]", f'[find]\npoles = ["2 {name}"]')
    assert f"there is no pair of links 2 {name}; perhaps 2 frame" in "\n".join(_lines(asking))


def test_a_moving_link_may_have_such_a_name() -> None:
    """Beside a frame a moving link may be called 0, and in an open chain any."""
    text = re.sub(r"(?m)^1( *=)", r"0\1", load("slider-crank").text)
    assert "0" in parse(text.replace('link  = "1"', 'link  = "0"'), "x").moving
    chain = re.sub(r"(?m)^3( *=)", r"ground\1", load("open-chain").text).replace('"3"', '"ground"')
    assert "ground" in parse(chain, "x").moving


TRAMMEL = """
[points]
A = [3, 0]
B = [0, 4]
[links]
bar = "A B"
a = "A"
b = "B"
[[slides]]
link = "a"
along = "frame"
at = "A"
direction = 0
[[slides]]
link = "b"
along = "frame"
at = "B"
direction = 90
[[drive]]
slide = ["a", "frame"]
speed = 2
"""


def test_a_frame_needs_no_point() -> None:
    """Where pairs alone name the frame it is there, and the results are those of a frame with a point."""
    bare = gp.solve(gp.parse(TRAMMEL))
    assert bare.omega["bar"] == gp.solve(gp.parse(TRAMMEL.replace('b = "B"', 'b = "B"\nframe = "N"')
                                                  .replace("B = [0", "N = [7, 7]\nB = [0"))).omega["bar"] == 0.5
