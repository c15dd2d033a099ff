"""`graphplan cycle`: every pose constructed, checked, tabled and plotted, and none silently left out."""

from __future__ import annotations

import csv
import io
import json
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from packaged_scenes import those

import graphplan as gp
from graphplan.check.cycle import curves, cycle, quantities, scene_asking_for
from graphplan.commands import main
from graphplan.methods.construction import Construction

TURNING = those(lambda scene: scene.drives and not scene.motions and scene.name not in ("plough-lift", "ozols-5-3"))


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Any:
    """The command: its exit status, standard output and standard error."""

    def run(*arguments: str) -> tuple[int, str, str]:
        status = main(["cycle", *arguments])
        return status, *capsys.readouterr()

    return run


@pytest.mark.parametrize("name", TURNING)
def test_every_pose_agrees_or_says_why_not(name: str) -> None:
    """Around the turn of every packaged scene, forces among it, each pose agrees with the solver, or has a fault."""
    found = cycle(gp.load(name), 24)
    assert found.wrong == ()
    for k in range(24):
        told = [bool(np.isfinite(z[k])) for named in found.results.values() for z in named.values()]
        assert all(told) == (k not in found.faults)  # of a pose that is singular in part some is known
    assert all(gap <= 1e-10 for gap in found.check.values())


def test_one_pose_of_the_cycle_is_that_pose_alone() -> None:
    """What a pose of the cycle gives is what the same program gives for it alone, to the last bit."""
    found = cycle(gp.load("jaanimets-10"), 7)
    for k in range(7):
        alone = found.drawing.replay({name: complex(z[k]) for name, z in found.turn.points.items()
                                      if any(step.name == name for step in found.drawing.program.steps)})
        for kind, named in alone.items():
            for name, value in named.items():
                z = found.results[kind][name][k]
                assert (complex(*value) if isinstance(value, tuple) else value) == z


def test_the_table_has_a_line_for_each_pose(run: Any) -> None:
    """Comma-separated text: a heading with units, then one line for each pose, its first that of the scene."""
    status, out, err = run("four-bar", "--positions", "8")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert status == 0
    assert [row["pose"] for row in rows] == [str(k) for k in range(8)]
    assert float(rows[0]["B.vx [mm/s]"]) == pytest.approx(gp.construct(gp.load("four-bar")).velocity["B"].real)
    assert float(rows[2]["travel [deg]"]) == pytest.approx(90)
    assert "8 of 8 poses" in err


def test_a_file_is_written_block_by_block(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A table in a file is, to the last letter, that on standard output, and so is what is said of its poses; of all of
    them no more than a block is there at a time."""
    told = run("class-four-loaded", "--positions", "60")
    monkeypatch.setattr("graphplan.check.cycle.MIN_BLOCK", 7)
    monkeypatch.setattr("graphplan.check.cycle.join_blocks", None)
    status, _, err = run("class-four-loaded", "--positions", "60", "-o", str(tmp_path / "turn.csv"))
    written, rest = err.split("\n", 1)
    assert (status, (tmp_path / "turn.csv").read_text(), rest) == told
    assert written.endswith("written")
    assert "poses 41 to 46 (6)" in rest, "over the end of a block"


def test_more_poses_than_memory_holds_go_to_a_file(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where standard output and diagrams are refused for their memory, tables of all kinds are written."""
    monkeypatch.setattr("graphplan.cycle.travel.memory", lambda: 2e6)
    text, document = tmp_path / "turn.csv", tmp_path / "turn.json"
    assert run("four-bar", "--positions", "2000")[0] == 2
    assert run("four-bar", "--positions", "2000", "--plot", str(tmp_path / "turn.svg"))[0] == 2
    for file in (text, document):
        assert run("four-bar", "--positions", "2000", "-o", str(file))[0] == 0
    assert len(text.read_text().splitlines()) == 2001
    assert len(json.loads(document.read_text())["travel"]) == 2000


def test_a_file_that_is_too_long_for_its_disk(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is refused in one line as the first rows tell its length, and nothing is left; one with room is written."""
    words = "four-bar", "--positions", "200", "-o", str(tmp_path / "turn.csv")
    for free, expected in ((10_000, 2), (100_000, 0)):
        monkeypatch.setattr("shutil.disk_usage", lambda folder, free=free: SimpleNamespace(free=free))
        status, _, err = run(*words)
        assert (status, "are free" in err, len([*tmp_path.iterdir()])) == (expected, expected == 2, expected == 0)
    assert run(*words[:3], "-o", "/dev/null")[0] == 0


def test_unreachable_poses_are_told_with_angle_and_reason(run: Any) -> None:
    """Poses that cannot be reached are in the table without numbers, and on standard error as one line a stretch."""
    status, out, err = run("stephenson", "--positions", "36")
    rows = list(csv.DictReader(io.StringIO(out)))
    empty = [row for row in rows if not row["A.vx [mm/s]"]]
    assert status == 0
    assert empty
    assert all("degrees" in row["fault"] for row in empty)
    assert not any(row["fault"] for row in rows if row["A.vx [mm/s]"])
    assert re.search(r"^poses \d+ to \d+ \(\d+\): at \d+ degrees: links .*limit position near", err, re.M)


def test_an_archive_of_arrays(run: Any, tmp_path: Path) -> None:
    """The .npz has travel, points and every reading as arrays, and which poses have none, and why."""
    file = tmp_path / "turn.npz"
    assert run("class-four-loaded", "--positions", "36", "-o", str(file))[0] == 0
    with np.load(file, allow_pickle=False) as arrays:
        assert arrays["travel"].shape == arrays["velocity G"].shape == (36,)
        assert {"reaction 2 at A", "balance moment 1"} <= set(arrays.files)
        faults = arrays["fault_pose"]
        assert np.array_equal(np.flatnonzero(np.isnan(arrays["velocity G"])), faults)
        assert len(arrays["fault_why"]) == len(faults)


@pytest.mark.parametrize("ending", [".json", ".npz", ".csv"])
def test_a_table_of_many_blocks_is_that_of_one(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                               ending: str) -> None:
    """Tables are the same byte for byte in however many blocks the poses come, some of which have faults, and no more
    of them than a block is ever at hand."""
    one, many, taken = tmp_path / f"one{ending}", tmp_path / f"many{ending}", list[int]()
    assert run("stephenson", "--positions", "36", "-o", str(one))[0] == 0
    monkeypatch.setattr("graphplan.check.cycle.MIN_BLOCK", 5)
    monkeypatch.setattr("graphplan.check.cycle.MAX_BLOCK", 5)
    monkeypatch.setattr("graphplan.check.cycle.join_blocks", taken.append)
    assert run("stephenson", "--positions", "36", "-o", str(many))[0] == 0
    assert many.read_bytes() == one.read_bytes()
    assert not taken


def test_a_title_of_any_characters_stands_in_json(run: Any, tmp_path: Path) -> None:
    """A document by columns is JSON whatever its texts hold, and keeps them as they are."""
    scene, file = tmp_path / "odd.toml", tmp_path / "odd.json"
    text = re.sub("^title .*$", lambda _: r'title = "\u00000\u0000"', gp.load("four-bar").text, flags=re.M)
    scene.write_text(text, encoding="utf-8")
    assert run(str(scene), "--positions", "3", "-o", str(file))[0] == 0
    assert json.loads(file.read_text())["title"] == "\x000\x00"


def test_a_range_of_a_sliding_drive(run: Any) -> None:
    """A drive that slides needs a range of lengths, and both its ends are poses."""
    status, out, _ = run("plough-lift", "--positions", "5", "--from", "0", "--to", "20")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert status == 0
    assert [float(row["travel [mm]"]) for row in rows] == [0, 5, 10, 15, 20]


def test_the_plot_shows_what_the_mechanism_drives(run: Any, tmp_path: Path) -> None:
    """The diagrams are written as SVG, the same every time, with the errors of the graphical methods."""
    one, two = tmp_path / "one.svg", tmp_path / "two.svg"
    for file in (one, two):
        assert run("slider-crank", "--positions", "24", "--plot", str(file))[0] == 0
    assert one.read_bytes() == two.read_bytes()
    assert "slide 3 along frame" in one.read_text()
    assert run("four-bar", "--positions", "24", "--plot", str(two), "--of", "3", "--of", "M.x")[0] == 0


@pytest.mark.parametrize(("name", "of"), [("four-bar", "3"), ("four-bar", "M.y"), ("slider-crank", "3 along frame"),
                                          ("slotted-link", "2 along 3"), ("shaper", "3")])
def test_curves_are_their_own_rates(name: str, of: str) -> None:
    """Displacement, velocity and acceleration of a curve are derivatives of each other, to the step's square."""
    scene = gp.load(name)
    wanted = quantities(scene, [of])
    (curve,) = curves(cycle(scene_asking_for(scene, wanted), 720), wanted)
    for below, above in (curve.s, curve.v), (curve.v, curve.a):
        slope = (below[2:] - below[:-2]) / (curve.time[2:] - curve.time[:-2])
        assert np.abs(slope - above[1:-1]).max() <= 2e-3 * np.abs(above).max()


def test_a_drive_that_runs_back_gives_the_same_curve_backwards() -> None:
    """With the crank turning clockwise the diagrams run over growing time too."""
    scene = gp.load("slider-crank")
    back = scene.with_drives([replace(scene.drives[0], rate=-10)])
    wanted = quantities(back, ["3 along frame"])
    (curve,) = curves(cycle(scene_asking_for(back, wanted), 90), wanted)
    assert (np.diff(curve.time) > 0).all()
    slope = np.gradient(curve.s, curve.time)
    assert np.abs(slope - curve.v)[1:-1].max() <= 0.01 * np.abs(curve.v).max()


FAULTS = {
    ("--positions", "0"): "at least 1",
    ("--positions", "5", "--from", "3"): "only one of --from and --to",
    ("--positions", "5", "--from", "nan", "--to", "4"): "finite",
    ("--positions", "5", "--workers", "0"): "at least 1",
    ("--positions", "5", "--plot", "x.svg", "--of", "9"): "unknown quantity",
    ("--positions", "5", "--plot", "x.svg", *["--of", "3"] * 5): "at most 4",
    ("--positions", "5", "-o", "/dev/null/table.csv"): "cannot be written",
    ("--positions", "5", "-o", "table.ods"): ".csv, .npz",
    ("--positions", "5", "--plot", "x.gif"): "no plot is written as .gif; a name in .svg",
    ("--positions", "5", "-o", "x", "--plot", "x"): "two results would be written to one file",
    ("--positions", "4", "--from", "1e18", "--to", "2e18"): "too far",
    ("--positions", "1000000000"): "1.86 TiB",
}


@pytest.mark.parametrize("arguments", FAULTS, ids=" ".join)
def test_bad_questions_get_one_line(arguments: tuple[str, ...], run: Any, tmp_path: Path,
                                    monkeypatch: pytest.MonkeyPatch) -> None:
    """What cannot be done is said in one line, with exit status 2, and nothing is written."""
    monkeypatch.chdir(tmp_path)
    status, out, err = run("four-bar", *arguments)
    assert (status, out) == (2, "")
    assert FAULTS[arguments] in err
    assert len(err.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_open_chains_have_no_cycle(run: Any) -> None:
    """A scene of given point motions has nothing that turns."""
    status, _, err = run("open-chain", "--positions", "5")
    assert status == 2
    assert "[[drive]]" in err


def test_where_one_way_fails_another_serves(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the recorded way through a ring spoilt in some poses, another form gives them, and it is noted which."""
    from graphplan.methods import replay

    scene = gp.load("class-four")
    sound = cycle(scene, 12)
    real = replay.batch

    def spoilt(construction: Any, *rest: Any, **more: Any) -> Any:
        poses = real(construction, *rest, **more)
        if construction.ways == sound.drawing.ways:
            for z in poses.velocity.values():
                z[2] += 1
        return poses

    monkeypatch.setattr(replay, "batch", spoilt)
    found = cycle(scene, 12)
    assert list(found.otherwise) == [2]
    assert "false position" in found.otherwise[2]
    assert found.wrong == ()
    assert found.results["velocity"]["E"] == pytest.approx(sound.results["velocity"]["E"], nan_ok=True)


def test_what_no_form_gives_right_is_wrong(monkeypatch: pytest.MonkeyPatch, run: Any, tmp_path: Path) -> None:
    """Where construction and solver disagree and no form agrees, the poses are told, the status is 1, nothing written.
    """
    real = Construction.evaluate

    def other(self: Construction, *where: Any, **how: Any) -> Any:
        found = real(self, *where, **how)
        found.results["velocity"]["B"] += 1e-6
        return found

    monkeypatch.setattr(Construction, "evaluate", other)
    file = tmp_path / "table.csv"
    status, out, err = run("four-bar", "--positions", "3", "-o", str(file))
    assert (status, out) == (1, "")
    assert err.count("disagree") == 3
    assert not file.exists()


def test_the_plot_speaks_the_language(run: Any, tmp_path: Path) -> None:
    """Names, heads and the key of the diagrams come in the language asked for."""
    file = tmp_path / "plot.svg"
    assert run("slider-crank", "--positions", "24", "--plot", str(file), "--set", "sheet.language=de")[0] == 0
    words = re.sub(r"\s+", " ", re.sub(r"<[^>]*>", "", file.read_text(encoding="utf-8")))
    assert all(word in words for word in ("Schubgelenk 3 auf Gestell", "Stellung", "aus den Plänen", "durch Sehnen"))
    assert not re.search(r"\b(slide|position|drive|order|chords|plans|per mm)\b", words)
