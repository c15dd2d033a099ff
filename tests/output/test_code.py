"""Every reading of a tape gives the numbers of the rules to the last bit, over every packaged scene."""

from __future__ import annotations

import ctypes
import json
import math
import shutil
import subprocess
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import graphplan as gp
from graphplan.errors import Undrawable
from graphplan.kernel.numbers import Floats
from graphplan.kernel.tape.blocks import Blocks
from graphplan.kernel.tape.machine import LANES, Machine
from graphplan.kernel.tape.written import places
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.scene import packaged_names
from graphplan.methods.construction import Construction
from graphplan.output.exports.code import Code, c, javascript

POSES = 2 * LANES + 3
LOST = 11  # a pose in which nothing is known; in the first poses all that moves lies in one pivot of the frame


class Case(NamedTuple):
    """A scene's code, poses as its inputs, and what the rules say: nan in all outputs where they refuse a pose."""

    drawing: Construction
    code: Code
    inputs: Any
    told: Any


def pivots(scene: gp.Scene) -> list[list[float]]:
    """The points that stand still, or any."""
    return [[*map(float, scene.points[name])] for name in (scene.links.get(FRAME) or [*scene.points])[:3]]


@cache
def case(name: str) -> Case:
    drawing = gp.construct(gp.load(name), checked=False)
    code = Code(drawing)
    at = np.array([float(number) for item in code.moving for number in item.at])
    inputs = at[:, None] + 0.01 * np.max(np.abs(at)) * np.random.default_rng(7).normal(size=(len(at), POSES))
    for pose, at in enumerate(pivots(drawing.scene)):
        inputs[:, pose] = at * len(code.moving)
    inputs[:, LOST] = math.nan
    return Case(drawing, code, inputs, np.array([by_rules(drawing, code, pose) for pose in inputs.T.tolist()]).T)


def by_rules(drawing: Construction, code: Code, pose: Any) -> list[float]:
    given: dict[Any, dict[str, float]] = {}
    numbers = iter(pose)
    for item in code.moving:
        for part in item.parts:
            number = next(numbers)
            for key, parameter in part:
                given.setdefault(key, {})[parameter] = number
    try:
        found = drawing.read(Floats(), given)
    except (Undrawable, gp.errors.ConstructionError, ZeroDivisionError):
        return [math.nan] * len(code.outputs)
    return [number for named in found.values() for value in named.values()
            for number in (value if isinstance(value, tuple) else (value,))]


def by_python(case: Case, tmp_path: Path) -> Any:
    found = []
    for pose in case.inputs.T.tolist():
        try:
            told = case.code.replay.function(*(pose[k] for k in spread(case.code)))
        except ZeroDivisionError:
            told = None
        found.append([math.nan] * len(case.code.outputs) if told is None else [
            number for named in told.values() for value in named.values()
            for number in (value if isinstance(value, tuple) else (value,))])
    return np.array(found).T


def spread(code: Code) -> list[int]:
    """The input of each number that the replay reads: a guide may be drawn by several steps."""
    return [k for k, number in enumerate(code.inputs) for _ in number.places]


def by_blocks(case: Case, tmp_path: Path) -> Any:
    return on_arrays(Blocks(case.code.replay.tape, case.code.replay.inputs, outputs(case.code)), case)


def by_machine(case: Case, tmp_path: Path) -> Any:
    pytest.importorskip("numba")
    return on_arrays(Machine(case.code.replay.tape, case.code.replay.inputs, outputs(case.code)), case)


def outputs(code: Code) -> list[int]:
    return list(places(code.replay.places_of_results))


def on_arrays(reading: Blocks | Machine, case: Case) -> Any:
    found = np.empty((len(case.code.outputs), POSES))
    left = reading.run([case.inputs[k] for k in spread(case.code)], list(found))
    found[:, left] = math.nan
    return found


def by_c(case: Case, tmp_path: Path, *options: str) -> Any:
    compiler = shutil.which("cc") or pytest.skip("no C compiler is at hand")
    source, library = tmp_path / "plan.c", tmp_path / "plan.so"
    source.write_text(c(case.drawing))
    strict = ("-std=c99", "-Wall", "-Werror", "-ffp-contract=off", "-fno-math-errno", "-shared", "-fPIC")
    subprocess.run([compiler, *strict, *options, str(source), "-o", str(library), "-lm"], check=True)
    function = ctypes.CDLL(str(library)).graphplan_poses
    function.restype = ctypes.c_size_t
    found = np.empty((len(case.code.outputs), POSES))
    arrays = [(ctypes.c_void_p * len(rows))(*(row.ctypes.data for row in rows)) for rows in (case.inputs, found)]
    assert function(ctypes.c_size_t(POSES), *arrays) == np.isnan(case.told).all(axis=0).sum()
    return found


NODE = """
import { readFileSync } from "node:fs";
const { inputs, outputs, pose, poses } = await import(process.argv[2]);
const read = JSON.parse(readFileSync(0)).map(row => row.map(x => x ?? NaN)), n = read[0].length;
const x = read.map(row => Float64Array.from(row)), y = outputs.map(() => new Float64Array(n));
const undrawn = poses(n, x, y), one = pose();
console.log(JSON.stringify({ inputs, outputs, undrawn, numbers: y.map(row => Array.from(row)), one }));
"""


def by_javascript(case: Case, tmp_path: Path) -> Any:
    told = run_javascript(case, tmp_path)
    assert [told["inputs"], told["outputs"]] == [[n.name for n in ns] for ns in (case.code.inputs, case.code.outputs)]
    assert told["undrawn"] == np.isnan(case.told).all(axis=0).sum()
    assert told["one"] == json.loads(json.dumps(case.drawing.replay()))
    return np.array([[math.nan if number is None else number for number in row] for row in told["numbers"]])


def run_javascript(case: Case, tmp_path: Path) -> Any:
    node = shutil.which("node") or pytest.skip("node is not at hand")
    module, script = tmp_path / "plan.mjs", tmp_path / "run.mjs"
    module.write_text(javascript(case.drawing))
    script.write_text(NODE)
    read = json.dumps([[None if math.isnan(x) else x for x in row] for row in case.inputs])
    done = subprocess.run([node, str(script), str(module)], input=read, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


READINGS = {"Python": by_python, "numpy": by_blocks, "machine code": by_machine, "C": by_c, "JavaScript": by_javascript}


@pytest.mark.parametrize("name", packaged_names()[::4])
@pytest.mark.parametrize("reading", READINGS)
def test_every_reading_gives_the_numbers_of_the_rules(reading: str, name: str, tmp_path: Path) -> None:
    """To the last bit, and what they refuse it refuses: a pose all in one place, and one that nobody knows."""
    found = READINGS[reading](case(name), tmp_path)
    refused = np.isnan(case(name).told).all(axis=0)
    assert refused[LOST]
    assert 2 <= refused.sum() <= 4
    assert np.array_equal(found, case(name).told, equal_nan=True)


def test_vector_instructions_change_no_bit(tmp_path: Path) -> None:
    """As its first lines say how to compile it, the C code gives the same numbers."""
    found = by_c(case("ozols-10-1"), tmp_path, "-O3", "-march=native")
    assert np.array_equal(found, case("ozols-10-1").told, equal_nan=True)


def test_code_says_what_it_reads_and_gives() -> None:
    """The first lines have the scene, each input and output with its unit, and how to compile."""
    head = c(case("jaanimets-11").drawing).partition("#include")[0]
    assert all(line.startswith("//") for line in head.strip().splitlines())
    for text in ("Slider-crank under load", "in[0]  point A x, mm", "velocity B x, mm/s", "balance moment",
                 "N*m", "-ffp-contract=off", "nan"):
        assert text in head


def test_titles_end_no_comment() -> None:
    """A title of several lines, or one that ends in a backslash, stays a comment."""
    drawing = gp.construct(replace(gp.load("four-bar"), title="int x;\nint y; \\", source=""))
    for text in (c(drawing), javascript(drawing)):
        assert text.startswith("// int x; int y;\n//\n")
