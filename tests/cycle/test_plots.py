"""Plain diagrams of `graphplan cycle --plot`: what stands in the table stands where it should in the picture."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from face import ran

import graphplan as gp

SVG = "{http://www.w3.org/2000/svg}"


class Plot:
    """The curves of a plot as they lie on paper, and the readings of its first panel."""

    def __init__(self, file: Path):
        self.root = ElementTree.parse(file).getroot()
        self.text = " ".join("".join(text.itertext()) for text in self.root.iter(f"{SVG}text"))
        self.curves = {group.get("id"): self._spots(group) for group in self.root.iter(f"{SVG}g")
                       if str(group.get("id")).startswith("curve-")}

    def _spots(self, group: Any) -> Any:
        path = next(group.iter(f"{SVG}path")).get("d")
        return np.array(re.findall(r"[ML] (\S+) (\S+)", path), dtype=float)

    def readings(self, axis: str) -> tuple[list[float], list[float]]:
        """The readings of an axis of the first panel, with their places on paper."""
        panel = next(group for group in self.root.iter(f"{SVG}g") if group.get("id") == "axes_1")
        numbers, places = list[float](), list[float]()
        for tick in panel.iter(f"{SVG}g"):
            if str(tick.get("id")).startswith(f"{axis}tick_"):
                mark = next(use for use in tick.iter(f"{SVG}use"))
                places.append(float(mark.get(axis) or 0.0))
                numbers.append(float("".join(next(tick.iter(f"{SVG}text")).itertext()).replace("−", "-")))
        return numbers, places

    def values(self, curve: str) -> Any:
        """The numbers of a curve of the first panel, read by the axes' readings."""
        scales = [np.polyfit(places, numbers, 1) for numbers, places in map(self.readings, "xy")]
        return np.column_stack([np.polyval(scale, spots) for scale, spots in zip(
            scales, self.curves[curve].T, strict=True)])


def plotted(tmp_path: Path, scene: str, *options: str) -> Plot:
    """The plot of a scene's cycle of 36 poses."""
    done = ran("cycle", scene, "--positions", "36", "-q", "--plot", tmp_path / "plot.svg", *options)
    assert done.status == 0, done.err
    return Plot(tmp_path / "plot.svg")


def json_table(tmp_path: Path, scene: str, *options: str) -> dict[str, Any]:
    """The table of a scene's cycle of 36 poses, as JSON has it."""
    assert ran("cycle", scene, "--positions", "36", "-q", "-o", tmp_path / "turn.json", *options).status == 0
    data: dict[str, Any] = json.loads((tmp_path / "turn.json").read_text(encoding="utf-8"))
    return data


def test_a_curve_lies_where_the_table_has_it(tmp_path: Path) -> None:
    """The size of a joint's force over the drive's travel, read by the axes, is that of the table, and a turn closes.
    """
    plot = plotted(tmp_path, "kinytskyi", "--of", "reaction C")
    data = json_table(tmp_path, "kinytskyi")
    travel, size = plot.values("curve-1").T
    assert travel == pytest.approx([*data["travel"], 360], abs=0.01)
    sizes = data["size"]["frame at C"]
    assert size == pytest.approx([*sizes, sizes[0]], abs=1e-4 * max(sizes))
    assert f"largest {max(sizes):.4g} N at {data['largest']['frame at C']['travel']:g}°" in plot.text


def test_sizes_and_directions_are_those_of_the_vectors(tmp_path: Path) -> None:
    """Every force has its size and direction, the largest its place; the efficiency is that of `solve`."""
    data = json_table(tmp_path, "kinytskyi")
    for name, vectors in data["reaction with friction"].items():
        z = np.array(vectors) @ [1, 1j]
        assert data["size"][name] == pytest.approx(abs(z))
        assert data["direction"][name] == pytest.approx(np.degrees(np.angle(z)))
        largest = data["largest"][name]
        assert largest["size"] == max(data["size"][name]) == data["size"][name][largest["pose"]]
        assert largest["travel"] == data["travel"][largest["pose"]]
        assert largest["rms"] == pytest.approx(np.sqrt(np.mean(abs(z) ** 2)))
    moments, largest = data["balance moment with friction"]["1"], data["largest"]["balance 1"]
    assert abs(largest["value"]) == max(map(abs, moments))
    assert largest["value"] == moments[largest["pose"]]
    assert largest["rms"] == pytest.approx(np.sqrt(np.mean(np.square(moments))))
    assert data["efficiency"][0] == pytest.approx(ran("solve", "kinytskyi").json["friction"]["efficiency"], rel=1e-9)


def test_the_largest_forces_and_a_negative_efficiency_are_told() -> None:
    """On standard error, each with its place; a family says of which value."""
    told = ran("cycle", "kinytskyi", "--positions", "36").err
    assert "2 at A: largest 278.2 N at 120°, root mean square 143.1 N" in told
    assert "balance 1: largest 12.55 N·m at 20°, root mean square 4.285 N·m" in told
    assert "the efficiency is negative in 10 of 36 poses, such as pose 6: there the loads drive" in told


def test_a_balancing_force_has_the_efficiency_of_solve(tmp_path: Path) -> None:
    """A force at a point gives power with the velocity of that point."""
    scene = gp.load("jaanimets-10").toml() + '\n[[friction]]\nat = "A"\nradius = 8\ncoefficient = 0.1\n'
    (tmp_path / "rough.toml").write_text(scene, encoding="utf-8")
    done = ran("solve", tmp_path / "rough.toml")
    data = json_table(tmp_path, str(tmp_path / "rough.toml"))
    assert data["efficiency"][0] == pytest.approx(done.json["friction"]["efficiency"], rel=1e-9)


def test_names_are_the_same_in_every_face(tmp_path: Path) -> None:
    """Columns of the comma-separated table, arrays of .npz, JSON and Python agree on forces' sizes and efficiency."""
    data = json_table(tmp_path, "kinytskyi")
    rows = [*csv.DictReader(io.StringIO(ran("cycle", "kinytskyi", "--positions", "36", "-q").out))]
    scene = gp.load("kinytskyi")
    motion = gp.construct(scene).evaluate(gp.follow(scene, 36))
    columns = motion.table()
    assert motion.largest == {name: pytest.approx(values) for name, values in data["largest"].items()}
    assert ran("cycle", "kinytskyi", "--positions", "36", "-q", "-o", tmp_path / "turn.npz").status == 0
    with np.load(tmp_path / "turn.npz") as arrays:
        for name, sizes in data["size"].items():
            assert [float(row[f"{name}.size [N]"]) for row in rows] == sizes
            assert columns[f"{name}.size"] == pytest.approx(sizes)
            assert arrays[f"size {name}"] == pytest.approx(sizes)
        assert columns["efficiency"] == pytest.approx(data["efficiency"])
        assert arrays["efficiency"] == pytest.approx(data["efficiency"])
    assert [float(row["efficiency"]) for row in rows] == data["efficiency"]


def test_no_two_columns_have_one_heading() -> None:
    """With friction, reactions without it stand under other headings; a size is that of the components beside it."""
    rows = [*csv.reader(io.StringIO(ran("cycle", "kinytskyi", "--positions", "4", "-q").out))]
    assert len({*rows[0]}) == len(rows[0])
    x, y, size = (float(rows[1][rows[0].index(f"2 at A.{part} [N]")]) for part in ("Fx", "Fy", "size"))
    assert size == pytest.approx(math.hypot(x, y))
    assert x != float(rows[1][rows[0].index("without friction 2 at A.Fx [N]")])


def test_the_largest_are_those_of_all_blocks(tmp_path: Path) -> None:
    """A table that is written block by block has the largest of all poses, with the place among all."""
    done = ran("cycle", "jaanimets-10", "--positions", "2500", "-q", "-o", tmp_path / "turn.json")
    data = json.loads((tmp_path / "turn.json").read_text(encoding="utf-8"))
    sizes = np.array(data["size"]["3 at A"], dtype=float)
    largest = data["largest"]["3 at A"]
    assert done.status == 0
    assert largest["pose"] == np.nanargmax(sizes) > 1024
    assert largest["rms"] == pytest.approx(np.sqrt(np.nanmean(sizes**2)))


def test_a_family_has_a_curve_for_each_value(tmp_path: Path) -> None:
    """Each is the curve of the scene with that value, and says so."""
    plot = plotted(tmp_path, "kinytskyi", "--of", "balance", "--vary", "moments.0.value=10,20,40")
    assert [*plot.curves] == ["curve-1", "curve-2", "curve-3"]
    assert all(f"moments.0.value = {value}" in plot.text for value in (10, 20, 40))
    data = json_table(tmp_path, "kinytskyi", "--set", "moments.0.value=20")
    moments = data["balance moment with friction"]["1"]
    assert plot.values("curve-2")[:36, 1] == pytest.approx(moments, abs=2e-3 * max(map(abs, moments)))


def test_a_polar_diagram_closes_and_turns_with_the_force(tmp_path: Path) -> None:
    """The ends of a joint's force are drawn from one pole at their directions, and the last is the first one again."""
    plot = plotted(tmp_path, "kinytskyi", "--of", "reaction O", "--polar")
    spots = plot.curves["curve-1"]
    assert len(spots) == 37
    assert spots[0] == pytest.approx(spots[-1], abs=1e-3)
    forces = np.array(json_table(tmp_path, "kinytskyi")["reaction with friction"]["frame at O"])
    away = np.column_stack([spots[:36, 0], -spots[:36, 1]])
    for between in ((0, 9), (9, 20), (20, 33)):
        (dx, dy), (fx, fy) = (np.subtract(*(rows[k] for k in between)) for rows in (away, forces))
        assert np.angle((dx + 1j * dy) / (fx + 1j * fy)) == pytest.approx(0, abs=1e-3)


def test_all_that_the_table_has_can_be_plotted_at_once(tmp_path: Path) -> None:
    """Quantities of one unit share a panel; what the scene does not ask for is asked for."""
    names = "reaction", "A.vx", "velocity B", "omega 3"
    plot = plotted(tmp_path, "jaanimets-10", *(word for name in names for word in ("--of", name)))
    assert len(plot.curves) == 4 + 2 + 1
    groups = [str(group.get("id")) for group in plot.root.iter(f"{SVG}g")]
    assert [name for name in groups if re.fullmatch(r"axes_\d+", name)] == ["axes_1", "axes_2", "axes_3"]


@pytest.mark.parametrize("ending", ["svg", "pdf", "png"])
def test_the_same_plot_is_the_same_bytes(ending: str, tmp_path: Path) -> None:
    """In each kind of file."""
    for name in ("one", "two"):
        assert ran("cycle", "four-bar", "--positions", "12", "-q", "--of", "velocity M", "--polar", "--plot",
                   tmp_path / f"{name}.{ending}").status == 0
    assert (tmp_path / f"one.{ending}").read_bytes() == (tmp_path / f"two.{ending}").read_bytes()


@pytest.mark.parametrize(("options", "words"), [
    (["--of", "raction O"], ["'raction O': unknown quantity; reaction O"]),
    (["--of", "efficiency", "--polar"], ["efficiency: it has no direction", "leave out --polar"]),
    (["--of", "balance", "--vary", "moments.0.value"], ["--vary moments.0.value: no values are given"]),
    (["--vary", "moments.0.value=1"], ["--of: the quantity is missing"]),
    (["--of", "balance", "--vary", "moments.9.value=1"], ["moments.9"]),
    (["--of", "balance", "--vary", "moments.0.value=1", "-o", "table.csv"], ["a table is of one scene"]),
])  # fmt: skip
def test_what_cannot_be_plotted_is_refused_by_name(options: list[str], words: list[str], tmp_path: Path) -> None:
    """In one line with what was probably meant, and nothing is written."""
    done = ran("cycle", "kinytskyi", "--positions", "12", "--plot", tmp_path / "plot.svg", *options)
    assert done.status == 2
    assert len(done.err.splitlines()) == 1
    assert all(word in done.err for word in words), done.err
    assert not [*tmp_path.iterdir()]


def test_polar_and_families_are_of_plots() -> None:
    """Without --plot these options are refused."""
    for options in (["--polar"], ["--vary", "moments.0.value=1"]):
        assert "only a plot uses it" in ran("cycle", "kinytskyi", "--positions", "12", *options).err


def test_plain_plots_speak_the_language(tmp_path: Path) -> None:
    """Names, largest values and decimals come in the language that is asked for."""
    plot = plotted(tmp_path, "kinytskyi", "--of", "balance", "--of", "efficiency", "--set", "sheet.language=de")
    assert "Wirkungsgrad" in plot.text
    assert re.search(r"größter Betrag \d+,\d+", plot.text)
    assert not re.search(r"\b(largest|drive|balance|efficiency)\b", plot.text)
