"""Scenes that were once wrong, refused or a traceback: each gives what is right, in fractions and by itself."""

from __future__ import annotations

import json
import tomllib
from itertools import cycle
from pathlib import Path
from typing import Any

import pytest

from graphplan.check.trusted import report
from graphplan.commands import main
from graphplan.mechanism.scene import load

HERE = Path(__file__).parent
RIGHT: dict[str, dict[str, Any]] = tomllib.loads((HERE / "right.toml").read_text())
NINE = 1e-9
PLANS = "orthogonal", "polar"


def solved(capsys: pytest.CaptureFixture[str], name: str, *options: str) -> Any:
    """What `solve` prints of a scene; it must be done without complaint."""
    status = main(["solve", str(HERE / f"{name}.toml"), *RIGHT[name].get("options", ()), *options])
    told = capsys.readouterr()
    assert status == 0, told.err
    return json.loads(told.out)


def found(data: Any, path: str) -> Any:
    """What stands at a path of the printed results."""
    for key in path.split("."):
        data = data[int(key)] if isinstance(data, list) else data[key]
    return data


def values(name: str) -> dict[str, Any]:
    return {path: value for path, value in RIGHT[name].items() if path != "options"}


def test_every_scene_has_its_right_values() -> None:
    """No scene of the folder is left out, and none is missing."""
    assert {path.stem for path in HERE.glob("*.toml")} == {"right", *RIGHT}


@pytest.mark.parametrize("name", RIGHT)
def test_exact_results_are_right(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """In fractions each result is the right one."""
    data = solved(capsys, name, "--exact")
    assert {path: found(data, path) for path in values(name)} == values(name)


@pytest.mark.parametrize("name", RIGHT)
def test_results_are_right_to_nine_digits(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Without a word about arithmetic each result has nine digits."""
    data, exact = solved(capsys, name), solved(capsys, name, "--exact")
    for path, value in leaves(exact):
        if path[0] in ("points", "links", "slides", "balance", "reactions"):
            assert float(found(data, ".".join(path))) == pytest.approx(fraction(value), rel=NINE, abs=NINE), path


@pytest.mark.parametrize(("name", "plan"), list(zip(RIGHT, cycle(PLANS), strict=False)))
def test_each_draws_its_steps(name: str, plan: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Each scene has its protocol, on either plan: on one of them as it lies on the sheet."""
    other, = set(PLANS) - {plan}
    assert report(load(HERE / f"{name}.toml"), plan=other).drawing.sentences()
    words = ["steps", str(HERE / f"{name}.toml"), "--plan", plan, "--set", "sheet.protocol=none"]
    assert main(words) == 0, capsys.readouterr().err


def leaves(data: Any, path: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], Any]]:
    """Each number of the results, as a text, with its path."""
    if isinstance(data, dict | list):
        parts = data.items() if isinstance(data, dict) else enumerate(data)
        return [leaf for key, part in parts for leaf in leaves(part, (*path, str(key)))]
    return [(path, data)] if isinstance(data, str) and fraction(data) is not None else []


def fraction(text: str) -> float | None:
    """A text p/q as a number; None of any other text."""
    over, _, under = text.partition("/")
    if not over.lstrip("-").isdigit() or not (under or "1").isdigit():
        return None
    return int(over) / int(under or "1")
