"""The construction in motion: as many pictures as poses, over again, the joints where the linkage is followed to."""

from __future__ import annotations

import io
import re
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree.ElementTree import Element, fromstring

import numpy as np
import pytest
from claims_of_exports import exported
from face import ran
from PIL import Image

import graphplan as gp

SVG = "{http://www.w3.org/2000/svg}"
POSES = 8


@cache
def animated(name: str, ending: str) -> bytes:
    """The animation of a packaged scene in a few poses."""
    with TemporaryDirectory() as folder:
        file = Path(folder, f"{name}{ending}")
        assert ran("cycle", name, "-q", "--positions", str(POSES), "--animate", file).status == 0
        return file.read_bytes()


def at(element: Element, name: str, time: float) -> str:
    """An attribute at a part of the round; of a number what lies between the values before and after."""
    for part in element.iter(f"{SVG}animate"):
        if part.get("attributeName") == name:
            values = part.get("values", "").split(";")
            times = list(map(float, part.get("keyTimes", "").split(";"))) if part.get("keyTimes") else (
                np.linspace(0, 1, len(values)))
            if part.get("calcMode") == "discrete":
                return values[max(i for i, start in enumerate(times) if start <= time + 1e-4)]
            return str(np.interp(time, times, list(map(float, values))))
    return element.get(name, "")


def circles(picture: Element, time: float) -> Any:
    """Where the circles of pairs are at a part of the round, in mm with y up."""
    group = next(part for part in picture.iter(f"{SVG}g") if part.get("class") == "layer-pairs")
    shown = [one for one in group.iter(f"{SVG}circle")
             if "still" not in one.get("class", "") and at(one, "display", time) != "none"]
    return np.array([float(at(one, "cx", time)) - 1j * float(at(one, "cy", time)) for one in shown])


def test_joints_are_where_the_linkage_is_followed_to() -> None:
    """The circles of pairs, read back from the file, move as the points do, but for the scale and a shift."""
    picture, scene = fromstring(animated("four-bar", ".svg")), gp.load("four-bar")
    scale = float(re.search(r"k_?s = ([\d.]+)", "".join(picture.itertext()))[1])
    drawn = [circles(picture, k / POSES) for k in range(POSES)]
    points = gp.follow(scene, POSES).points
    places = np.array([z / scale for name, z in points.items() if scene.links_of[name]])
    shifts = [circle - place for circle in drawn[0] for place in places[:, 0]]
    apart = [max(abs(places[:, k, None] + shift - drawn[k]).min(axis=0).max() for k in range(POSES))
             for shift in shifts]
    assert min(map(len, drawn)) > 3
    assert min(apart) < 0.02


def test_a_mechanism_with_limits_goes_there_and_back() -> None:
    """Between limits each pose but the ends is gone through twice, by links of the lengths that they have."""
    picture = fromstring(animated("plough-lift", ".svg"))
    drawn = [circles(picture, k / POSES) for k in range(POSES)]
    poses = {tuple(np.round(spots, 2)) for spots in drawn}
    assert len(poses) == POSES // 2 + 1
    turns = [k for k in range(POSES) if np.allclose(drawn[k - 1], drawn[(k + 1) % POSES], atol=0.02)]
    assert len(turns) == 2
    assert abs(turns[1] - turns[0]) == POSES // 2


@pytest.mark.costly
def test_a_gif_has_a_picture_for_each_pose() -> None:
    """A GIF opens with a picture for each pose, repeats without end, and takes six seconds."""
    with Image.open(io.BytesIO(animated("four-bar", ".gif"))) as image:
        assert (image.n_frames, image.width, image.info["loop"]) == (POSES, 900, 0)
        assert image.info["duration"] * image.n_frames == 6000


def test_what_moves_is_shown_still_to_those_who_ask_for_it() -> None:
    """Everything that moves has a copy that stands in the first pose, and one file is all: no script, nothing fetched.
    """
    text = animated("four-bar", ".svg").decode()
    assert "prefers-reduced-motion" in text
    assert not re.search(r"<script|href|url\(|@import", text)
    picture = fromstring(text)
    moving = [part for part in picture.iter() if "moving" in part.get("class", "")]
    still = [part for part in picture.iter() if part.get("class") == "still"]
    first = [part for part in moving if part.get("display") != "none"]
    assert len(still) == len(first) > 20
    assert {part.get("dur") for part in picture.iter(f"{SVG}animate")} == {"6s"}
    assert {part.get("repeatCount") for part in picture.iter(f"{SVG}animate")} == {"indefinite"}


def test_times_begin_with_the_round_and_never_go_back() -> None:
    """Each animation has a value for each of its times, from the beginning of the round in order."""
    for part in fromstring(animated("plough-lift", ".svg")).iter(f"{SVG}animate"):
        values, times = part.get("values", "").split(";"), part.get("keyTimes")
        if times is not None:
            numbers = [float(time) for time in times.split(";")]
            assert (len(numbers), numbers[0], numbers) == (len(values), 0, sorted(numbers))
            assert part.get("calcMode") == "discrete" or numbers[-1] == 1
        assert len({len(re.findall(r"[\d.]+", value)) for value in values}) == 1


@pytest.mark.costly
@pytest.mark.parametrize("ending", [".gif", ".svg"])
def test_the_same_scene_is_the_same_animation_of_a_size_to_be_sent(ending: str) -> None:
    """Written again, both kinds are the same bytes, and take a little room for each pose."""
    before = animated("four-bar", ending)
    animated.cache_clear()
    assert animated("four-bar", ending) == before
    assert len(before) < {".gif": 40_000, ".svg": 20_000}[ending] * POSES


def test_layers_and_steps_are_those_of_the_sheet() -> None:
    """From back to front the groups are those of the sheet of the given pose, each step's under its number."""
    orders = [[group.get("data-step") or group.get("class") for group in fromstring(svg).findall(f"{SVG}g")]
              for svg in (animated("four-bar", ".svg"), exported("four-bar", "svg"))]
    steps = [[key for key in order if key.isdigit()] for order in orders]
    assert {*steps[0]} == {*steps[1]}
    firsts = [list(dict.fromkeys(key for key in order if key in {*orders[0]} & {*orders[1]})) for order in orders]
    assert firsts[0] == firsts[1]


def test_words_keep_their_spaces() -> None:
    """Between an index and what follows, too, in programs that leave out spaces between elements unless told."""
    picture = fromstring(animated("four-bar", ".svg"))
    assert any(" = " in "".join(text.itertext()) for text in picture.iter(f"{SVG}text"))
    assert picture.get("{http://www.w3.org/XML/1998/namespace}space") == "preserve"
