"""What is promised of the tasks of a class, over random ranges of some scenes, measured on their sheets."""

from __future__ import annotations

import math
import random
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pypdfium2
import pytest
from face import ran
from handed_out import handed_out
from inked_sheet import said

import graphplan as gp

COUNT = 3
VECTOR = re.compile(r'data-from="(\S+) (\S+)" data-to="(\S+) (\S+)" data-vector="([^"]+)"')


def vectors(scene: Path, folder: Path) -> dict[str, float]:
    """The mm of each vector on the sheet, as its SVG says."""
    done = ran("draw", scene, "-o", folder / "sheet.svg", "-q")
    assert done.status == 0, done.err
    return {name: math.dist((float(x), float(y)), (float(u), float(v)))
            for x, y, u, v, name in VECTOR.findall((folder / "sheet.svg").read_text())}


def numbers(table: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """The numbers of a scene, by their paths."""
    if isinstance(table, bool | str):
        return
    if isinstance(table, int | float):
        yield path, float(table)
        return
    for key, value in table.items() if isinstance(table, dict) else enumerate(table):
        yield from numbers(value, f"{path}.{key}".lstrip("."))


def with_ranges(name: str, seed: int) -> str:
    """A scene with one or two numbers varied at random, by up to 40 % of what they are."""
    dice, text = random.Random(seed), re.sub(r"(?s)\n\[vary\].*?(?=\n\[|$)", "\n", gp.load(name).text)
    whole = tomllib.loads(text)
    paths = [(path, value) for key in ("points", "drive") for path, value in numbers(whole[key], key) if value]
    lines = ["", "[vary]"]
    for path, value in dice.sample(paths, dice.choice((1, 2))):
        values = sorted({round(value * (1 + dice.uniform(-0.4, 0.4)), 1) for _ in range(dice.choice((3, 8)))})
        lines.append(f'"{path}" = [{", ".join(f"{one:g}" for one in values if one)}]')
    return text + "\n".join(lines) + "\n"


@pytest.mark.parametrize(("name", "seed"), [("four-bar", 0), ("slider-crank", 1), ("slotted-link", 0)])
def test_vectors_are_long_enough_and_tasks_differ(name: str, seed: int, tmp_path: Path) -> None:
    """Asked vectors have 8 mm, all others 3, unless the scene's own sheet has no more; all have the same scales, the
    same seed makes the same tasks, and they differ as far as the grid has good ones."""
    (scene := tmp_path / "scene.toml").write_text(with_ranges(name, seed))
    for folder in ("class", "again"):
        done = ran("variants", scene, "-n", f"{COUNT}", "--seed", f"{seed}", "--jobs", "1", "-o", tmp_path / folder)
        if done.status:
            assert (done.status, (tmp_path / folder).exists()) == (2, False)
            return
    own_sizes, texts, scales = vectors(scene, tmp_path), [], set()
    for path in sorted((tmp_path / "class").glob("variant-*.toml")):
        assert path.read_bytes() == (tmp_path / "again" / path.name).read_bytes()
        texts.append(re.sub("variant [0-9]+", "", path.read_text()))
        scales.add(str({key: value for key, value in tomllib.loads(path.read_text())["sheet"].items()
                        if key.startswith("k_")}))
        for vector, mm in vectors(path, tmp_path).items():
            least = 8.0 if vector.startswith(("velocity", "acceleration")) else 3.0
            assert mm >= min(least, own_sizes.get(vector, least) / 1.25) - 0.01, (vector, mm)
    repeated = re.search(r"(\d+) variants have the numbers of another", done.err)
    assert len(scales) == 1
    assert len({*texts}) == COUNT - int(repeated[1] if repeated else 0)


def test_the_key_of_a_machine_is_right(tmp_path: Path) -> None:
    """Moment and inertia of each plan, closing moment and flywheel are in the key, whose rows earn all points."""
    text = gp.load("ozols-13-6").text + '\n[vary]\n"flywheel.unevenness" = [0.03, 0.04]\n'
    (tmp_path / "yoke.toml").write_text(text)
    assert ran("variants", tmp_path / "yoke.toml", "-n", "1", "-q", "--jobs", "1", "-o", tmp_path / "class").status == 0
    key = (tmp_path / "class" / "key.csv").read_text(encoding="utf-8")
    for quantity in ("reduced moment at 30", "reduced inertia at 345", "closing moment", "flywheel"):
        assert quantity in key
    variant, = (tmp_path / "class").glob("variant-*.toml")
    rows = [row.split(",", 2)[2] for row in key.splitlines()]
    (tmp_path / "results.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    assert ran("verify", variant, tmp_path / "results.csv", "--json").json["score"]["total"] == 100


def class_of(folder: Path, vary: str, count: int) -> tuple[str, list[dict[str, Any]], list[str]]:
    """A class of a slider-crank: what is said on standard error, its scenes, and the lines of its printed key."""
    text = re.sub(r"(?s)\n\[vary\].*?(?=\n\[|$)", "\n", gp.load("ozols-5-1").text)
    (scene := folder / "scene.toml").write_text(f"{text}\n[vary]\n{vary}\n")
    done = ran("variants", scene, "-n", f"{count}", "--jobs", "1", "-o", folder / "class")
    assert done.status == 0, done.err
    with pypdfium2.PdfDocument(folder / "class" / "key.pdf") as key:
        lines = key[0].get_textpage().get_text_range().splitlines()
    scenes = [tomllib.loads(path.read_text()) for path in sorted((folder / "class").glob("variant-*.toml"))]
    return done.err, scenes, lines


def test_values_are_spread_and_the_key_is_a_table(tmp_path: Path) -> None:
    """Eight tasks have eight of nine angles, whatever else varies; the key has a line a task and a column a result."""
    told, scenes, key = class_of(tmp_path, '"points.A.angle" = { from = 20, to = 52, step = 4 }\n'
                                 '"drive.0.omega" = [8, 10, 12]', 8)
    angles = [scene["points"]["A"]["angle"] for scene in scenes]
    assert len({*angles}) == 8
    assert {scene["drive"][0]["omega"] for scene in scenes} == {8, 10, 12}
    assert "scaled copies" not in told
    first = next(number for number, line in enumerate(key) if "mm/s" in line)
    assert all(f"{number} {angle:g}" in " ".join(line.split()) and line.count("∠") == key[first].count("mm/s")
               for number, (angle, line) in enumerate(zip(angles, key[first + 1:first + 9], strict=True), 1))


def test_scaled_copies_are_told(tmp_path: Path) -> None:
    """Tasks that differ in the speed of the drive alone are copies of one another, at another scale."""
    told, scenes, _ = class_of(tmp_path, '"drive.0.omega" = [8, 10, 12]', 3)
    assert {scene["drive"][0]["omega"] for scene in scenes} == {8, 10, 12}
    assert "2 variants are scaled copies of others" in told


def test_tasks_have_scales_of_their_own_where_common_ones_reject_half(tmp_path: Path) -> None:
    """Cranks of very different lengths do not fit one scale: it is said, and their sheets name none."""
    told, scenes, _ = class_of(tmp_path, '"points.A.distance" = [60, 90, 140, 220, 340]', 3)
    assert "each has scales of its own" in told
    assert not any("k_s" in scene["sheet"] for scene in scenes)


@pytest.mark.parametrize("scene", ["four-bar", "ozols-5-1", "shaper", "stephenson"])
def test_the_figure_of_a_task_has_every_length_that_is_given(scene: str) -> None:
    """Beside its link, with a dimension line where there is room."""
    page = handed_out(scene)[0][0]
    given, figure = (" ".join(said(element) for key, element in page.texts if key == layer)
                     for layer in ("given", "layer-dimensions"))
    lengths = re.findall(r"(\w+ = [\d.]+)", re.findall(r"Links: (.*?) mm", given)[0])
    assert len(lengths) > 3
    assert [length for length in lengths if length not in figure] == []
