"""The JSON Schemas that `graphplan schema` prints, against what the loader takes and what the commands print."""

from __future__ import annotations

import copy
import json
import re
import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from face import got, names, ran
from jsonschema import Draft202012Validator
from test_cases import changed

CASES = Path(__file__).parents[1] / "cases"
KINDS = re.findall(r"\{([a-z,-]+)\}", ran("new", "--help").out)[0].split(",")
STRANGER = "zzzzzz"


@cache
def schema(of: str) -> Any:
    """A schema, as it is printed."""
    return ran("schema", of).json


def errors(of: str, data: object) -> list[str]:
    """What a schema has against data."""
    return [f"{error.json_path}: {error.message}" for error in Draft202012Validator(schema(of)).iter_errors(data)]


def template(kind: str) -> str:
    """A new scene."""
    return ran("new", "-", "--kind", kind).out


def whole(kind: str) -> str:
    """A new scene with all that is optional in it."""
    return re.sub(r"(?m)^#(?=\S)", "", template(kind))


@pytest.mark.parametrize("of", ["scene", "solve", "steps", "verify", "flywheel", "motion", "cam", "synthesize",
                                "rotor"])
def test_schemas_are_sound(of: str) -> None:
    """What `graphplan schema` prints is a JSON Schema of the draft it names."""
    Draft202012Validator.check_schema(schema(of))
    assert schema(of)["$schema"] == Draft202012Validator.META_SCHEMA["$id"]


@pytest.mark.parametrize("name", names())
def test_scenes_and_what_is_printed_of_them_are_valid(name: str) -> None:
    """Every packaged scene is valid after the schema of scenes, and so are the results and the steps of it."""
    assert errors("scene", tomllib.loads(got(name).scene.text)) == []
    assert errors("solve", got(name).solved) == []
    assert errors("steps", got(name).data("steps", "--json", "--set", "sheet.protocol=none")) == []


@pytest.mark.parametrize("kind", KINDS)
def test_new_scenes_are_valid(kind: str) -> None:
    """A new scene is valid after the schema, with and without what is optional."""
    assert errors("scene", tomllib.loads(template(kind))) == []
    assert errors("scene", tomllib.loads(whole(kind))) == []


REFUSED = tomllib.loads((CASES / "schema" / "refused.case.toml").read_text(encoding="utf-8"))["case"]


@pytest.mark.parametrize("case", REFUSED, ids=lambda case: case["of"])
def test_what_the_loader_refuses_is_invalid(case: dict[str, Any]) -> None:
    """What it refuses for its keys, kinds of value and words, the schema refuses too: all that the cases have."""
    text = (CASES / "schema" / case["of"]).read_text(encoding="utf-8")
    assert errors("scene", tomllib.loads(text)) == []
    for *changes, _ in case["faults"]:
        spoilt = changed(text, case["of"], [*zip(changes[::2], changes[1::2], strict=True)])
        assert errors("scene", tomllib.loads(spoilt)), changes


def forms(fragment: Mapping[str, Any]) -> Iterator[frozenset[str]]:
    """The keys of the tables that a schema allows."""
    if "properties" in fragment:
        yield frozenset(fragment["properties"])
    inner = [*fragment.get("properties", {}).values(), *fragment.get("anyOf", ())]
    inner += [part for key in ("items", "additionalProperties") if isinstance(part := fragment.get(key), dict)]
    for part in inner:
        yield from forms(part)


@pytest.mark.parametrize("kind", KINDS)
def test_schema_and_loader_know_the_same_keys(kind: str) -> None:
    """In each table of a new scene a stranger is refused with the keys that there are: those of the schema."""
    text, tried = whole(kind), 0
    for place in re.finditer(r"(?m)^\[+([a-z]+)(?:\.[^\]]*)?\]+.*\n|(?<=\{ )", text):
        line = text[: place.end()].count("\n")
        inner = place[1] is None
        spoilt = f"{text[:place.end()]}{STRANGER} = 1{', ' if inner else chr(10)}{text[place.end():]}"
        told = re.search(rf"{STRANGER}: unknown key; one of (.*)", ran("check", "-", given=spoilt).err)
        if told is None:  # where any key may stand, such as a point's name
            continue
        known = {*told[1].split(", ")}
        if "..." in told[1]:
            known.remove("...")
        section = re.findall(r"(?m)^\[+([a-z]+)", text[: place.end()])[-1]
        allowed = [*forms(schema("scene")["properties"][section])]
        assert any(known == {*keys} or ("..." in told[1] and known <= keys) for keys in allowed), (line, known, allowed)
        tried += 1
    assert tried


def test_everything_in_a_scene_is_described() -> None:
    """Every key of a scene has words in the schema that an editor shows; its units are those that a fault names."""
    def bare(fragment: Mapping[str, Any]) -> Iterator[str]:
        for key, part in fragment.get("properties", {}).items():
            if not part.get("description"):
                yield key
        for part in (*fragment.get("properties", {}).values(), *fragment.get("anyOf", ()), fragment.get("items"),
                     fragment.get("additionalProperties")):
            if isinstance(part, dict):
                yield from bare(part)

    assert list(bare(schema("scene"))) == []
    for name, unit in schema("scene")["properties"]["units"]["properties"].items():
        told = ran("solve", "four-bar", "--set", f"units.{name}=3").err
        assert told.rstrip("\n").endswith(f"; one of {', '.join(unit['enum'])}"), told


@pytest.mark.parametrize("line", [
    "solve jaanimets-10 --exact", "solve jaanimets-10 --digits 20", "solve four-bar --pencil point=0.2",
    "solve five-bar --at 20", "steps four-bar --json --strict", "flywheel ozols-13-6", "motion ozols-13-7",
    "verify four-bar cases/verify/good.csv --json", "verify four-bar cases/verify/wrong.csv --json --note n",
    "verify four-bar cases/verify/class --json --score b=71",
])
def test_other_results_are_valid(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fractions, proven digits, a pencil, another pose, strict steps, machines, a drawing and a class."""
    monkeypatch.chdir(CASES.parent)
    if "--digits" in line:
        pytest.importorskip("flint")
    assert errors(line.split()[0], ran(*line.split()).json) == []


@pytest.mark.parametrize(("of", "path", "value"), [
    ("solve", ["points", "A", "velocity"], [1.0]),
    ("solve", ["points", "A", "velocity", 0], "fast"),
    ("solve", ["points", "A", "speed"], [1.0, 2.0]),
    ("solve", ["check", "velocity"], None),
    ("solve", ["units", "length"], "furlong"),
    ("steps", ["steps", 3, "kind"], "curve"),
    ("steps", ["steps", 3, "operation"], "guess"),
    ("steps", ["steps", 3, "number"], -1),
    ("steps", ["cost", "operations"], 1.5),
    ("steps", ["pencil", "results", "velocity", "A", "value"], "small"),
])
def test_results_of_another_shape_are_invalid(of: str, path: list[str | int], value: object) -> None:
    """A schema refuses what no command prints."""
    spoilt = copy.deepcopy(json.loads(got("four-bar").printed(of, *(["--json"] if of == "steps" else []))))
    place = spoilt
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    assert errors(of, spoilt)
