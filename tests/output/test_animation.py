"""The construction in motion: as many pictures as poses, over again, the joints where the linkage is followed to."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, fromstring

import numpy as np
import pytest
from PIL import Image

import graphplan as gp
from graphplan.commands import main
from graphplan.cycle.turn import loop

SVG = "{http://www.w3.org/2000/svg}"
POSES = 8


@cache
def animated(folder: Path, name: str, ending: str) -> bytes:
    """The animation of a packaged scene in a few poses."""
    file = folder / f"{name}{ending}"
    assert main(["cycle", name, "--quiet", "--positions", str(POSES), "--seconds", "4", "--animate", str(file)]) == 0
    return file.read_bytes()


@pytest.fixture(scope="module")
def animation(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, str], bytes]:
    folder = tmp_path_factory.mktemp("animations")
    return lambda name, ending: animated(folder, name, ending)


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


@pytest.mark.parametrize("name", ["four-bar", "plough-lift"])
def test_joints_are_where_the_linkage_is_followed_to(animation: Any, name: str) -> None:
    """The circles of pairs, read back from the file, move as the points do, but for the scale and a shift."""
    scene = gp.load(name)
    moved = loop(scene, POSES)
    picture = fromstring(animation(name, ".svg"))
    scale = float(re.search(r"k_?s = ([\d.]+)", "".join(picture.itertext())).group(1))  # type: ignore[union-attr]
    drawn = [circles(picture, k / POSES) for k in range(POSES)]
    places = np.array([z[list(moved.order)] / scale for point, z in moved.turn.points.items() if scene.links_of[point]])
    shifts = [circle - place for circle in drawn[0] for place in places[:, 0]]
    apart = [max(abs(places[:, k, None] + shift - drawn[k]).min(axis=0).max() for k in range(POSES))
             for shift in shifts]
    assert min(map(len, drawn)) > 3
    assert min(apart) < 0.02


@pytest.mark.costly
def test_a_gif_has_a_picture_for_each_pose(animation: Any) -> None:
    """A GIF opens with a picture for each pose, repeats without end, and takes the seconds it is given."""
    with Image.open(io.BytesIO(animation("four-bar", ".gif"))) as image:
        assert (image.n_frames, image.width, image.info["loop"]) == (POSES, 900, 0)
        assert image.info["duration"] * image.n_frames == 4000


def test_a_mechanism_with_limits_goes_there_and_back() -> None:
    """Between limits each pose but the ends is gone through twice, and the given pose comes first."""
    moved = loop(gp.load("plough-lift"), POSES)
    travel = moved.turn.travel[list(moved.order)]
    assert (travel[0], len(travel), len({*moved.order})) == (0, POSES, POSES // 2 + 1)
    steps = np.sign(np.diff([*travel, travel[0]]))
    assert np.count_nonzero(steps != np.roll(steps, 1)) == 2


def test_what_moves_is_shown_still_to_those_who_ask_for_it(animation: Any) -> None:
    """Everything that moves has a copy that stands in the first pose, and one file is all: no script, nothing fetched.
    """
    text = animation("four-bar", ".svg").decode()
    assert "prefers-reduced-motion" in text
    assert not re.search(r"<script|href|url\(|@import", text)
    picture = fromstring(text)
    moving = [part for part in picture.iter() if "moving" in part.get("class", "")]
    still = [part for part in picture.iter() if part.get("class") == "still"]
    first = [part for part in moving if part.get("display") != "none"]
    assert len(still) == len(first) > 20
    assert {part.get("dur") for part in picture.iter(f"{SVG}animate")} == {"4s"}
    assert {part.get("repeatCount") for part in picture.iter(f"{SVG}animate")} == {"indefinite"}


def test_times_begin_with_the_round_and_never_go_back(animation: Any) -> None:
    """Each animation has a value for each of its times, from the beginning of the round in order."""
    for part in fromstring(animation("plough-lift", ".svg")).iter(f"{SVG}animate"):
        values, times = part.get("values", "").split(";"), part.get("keyTimes")
        if times is not None:
            numbers = [float(time) for time in times.split(";")]
            assert (len(numbers), numbers[0], numbers) == (len(values), 0, sorted(numbers))
            assert part.get("calcMode") == "discrete" or numbers[-1] == 1
        assert len({len(re.findall(r"[\d.]+", value)) for value in values}) == 1


@pytest.mark.costly
def test_the_same_scene_is_the_same_animation(animation: Any, tmp_path: Path) -> None:
    """Written again, both kinds are the same bytes."""
    for ending in (".gif", ".svg"):
        again = tmp_path / f"again{ending}"
        assert main(["cycle", "four-bar", "--quiet", "--positions", str(POSES), "--seconds", "4",
                     "--animate", str(again)]) == 0
        assert again.read_bytes() == animation("four-bar", ending)


def test_a_film_is_of_a_size_to_be_sent(animation: Any) -> None:
    """Neither kind takes more than a little room for each pose."""
    assert len(animation("four-bar", ".gif")) < 40_000 * POSES
    assert len(animation("four-bar", ".svg")) < 20_000 * POSES


@pytest.mark.parametrize("options", [
    "--animate x.png", "--animate x.gif --positions 241", "--animate x.gif --seconds 0", "--animate x.gif --width 10",
    "--seconds 3 --positions 4", "--width 300 --positions 4", "--animate x.gif --plot x.svg",
    "--animate /dev/null/x.gif",
    "--animate x.svg --plot x.svg --positions 12", "--animate x.gif --positions 240 --width 2400", "",
    "--positions 0 --animate x.svg", "--animate x.gif --from 400 --to 500"])
def test_what_no_animation_can_be_is_one_line(options: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                              capsys: pytest.CaptureFixture[str]) -> None:
    """A bad option is refused with one line, and nothing is written."""
    monkeypatch.chdir(tmp_path)
    scene = "stephenson" if "--from" in options else "open-chain" if not options else "four-bar"
    assert main(["cycle", scene, *options.split()]) == 2
    captured = capsys.readouterr()
    assert (captured.out, captured.err.count("\n")) == ("", 1)
    assert not list(tmp_path.iterdir())


def test_words_keep_their_spaces(animation: Callable[[str, str], bytes]) -> None:
    """Between an index and what follows, too, in programs that leave out spaces between elements unless told."""
    picture = fromstring(animation("four-bar", ".svg"))
    scales = ("".join(text.itertext()) for text in picture.iter(f"{SVG}text"))
    assert any(" = " in scale for scale in scales)
    assert picture.get("{http://www.w3.org/XML/1998/namespace}space") == "preserve"
