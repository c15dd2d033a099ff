"""The JSON Schemas against the loader, the packaged scenes, and what the commands print."""

from __future__ import annotations

import copy
import json
import re
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import graphplan
from graphplan.commands import main
from graphplan.commands.new import KINDS, template
from graphplan.commands.schema import result_schema as schema_of
from graphplan.errors import SceneError
from graphplan.mechanism.items import SceneItem
from graphplan.mechanism.scene import load, packaged_names, parse
from graphplan.mechanism.schema import scene
from graphplan.mechanism.units import BY_QUANTITY

SCENES = Path(graphplan.__file__).parent / "scenes"
Form = tuple[str, frozenset[str], frozenset[str]]  # a section, the keys of one of its tables, and those it requires


def whole(kind: str) -> str:
    """A start with all that is optional in it."""
    return re.sub(r"(?m)^#(?=\S)", "", template(kind))


def errors(schema: dict[str, Any], data: object) -> list[str]:
    """What a schema has against data."""
    return [f"{error.json_path}: {error.message}" for error in Draft202012Validator(schema).iter_errors(data)]


def printed(capsys: pytest.CaptureFixture[str], *arguments: str) -> Any:
    """The JSON that a command prints."""
    assert main(arguments) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("of", ["scene", "solve", "steps", "verify"])
def test_schemas_are_sound(of: str, capsys: pytest.CaptureFixture[str]) -> None:
    """What `graphplan schema` prints is a JSON Schema of the draft it names."""
    schema = printed(capsys, "schema", of)
    Draft202012Validator.check_schema(schema)
    assert schema["$schema"] == Draft202012Validator.META_SCHEMA["$id"]


@pytest.mark.parametrize("name", packaged_names())
def test_packaged_scenes_are_valid(name: str) -> None:
    """Every packaged scene is valid after the schema of scenes."""
    text = (SCENES / f"{name}.toml").read_text(encoding="utf-8")
    assert errors(scene(), tomllib.loads(text)) == []


@pytest.mark.parametrize("kind", KINDS)
def test_starts_are_valid(kind: str) -> None:
    """A new scene is valid after the schema, with and without what is optional."""
    assert errors(scene(), tomllib.loads(template(kind))) == []
    assert errors(scene(), tomllib.loads(whole(kind))) == []


BAD = [  # a start, what replaces what in it
    ("four-bar", "[points]", "[point]"),
    ("four-bar", "omega = 2", "omga = 2"),
    ("four-bar", "omega = 2", "omega = 2\nrpm = 3"),
    ("four-bar", "omega = 2", ""),
    ("four-bar", "omega = 2", 'omega = "2"'),
    ("four-bar", "omega = 2", "omega = true"),
    ("four-bar", "omega = 2", "omega = 1979-05-27"),
    ("four-bar", 'length = "mm"', 'length = "km"'),
    ("four-bar", 'length = "mm"', "length = 3"),
    ("four-bar", "gravity = [0, -9.81]", "gravity = 9.81"),
    ("four-bar", 'title = "', 'title = 3 # "'),
    ("four-bar", "O = [0, 0]", "O = [0, 0, 0]"),
    ("four-bar", "O = [0, 0]", 'O = [0, "1"]'),
    ("four-bar", "O = [0, 0]", "O = { x = 0, y = 0 }"),
    ("four-bar", "O = [0, 0]", 'O = [0, 0]\n"M 1" = [0, 0]'),
    ("four-bar", "angle = 60", "angel = 60"),
    ("four-bar", "distance = 50", "distance = 0"),
    ("four-bar", "{ A = 120, C = 90 }", "{ A = 120 }"),
    ("four-bar", '"left"', '"lefft"'),
    ("four-bar", 'on = "A B"', 'on = "A B C"'),
    ("four-bar", '1 = "O A"', '1 = "O, A"'),
    ("four-bar", '1 = "O A"', '1 = ["O", "A"]'),
    ("four-bar", '1 = "O A"', '1 = " "'),
    ("four-bar", "[[drive]]", "[drive]"),
    ("four-bar", 'velocity = ["B", "M"]', 'velocity = "B"'),
    ("four-bar", "velocity = [", "velocities = ["),
    ("four-bar", "mass = 1.5", "mass = -1.5"),
    ("four-bar", "inertia = 0.002", 'inertia = "0.002"'),
    ("four-bar", 'centre = "M"', 'center = "M"'),
    ("four-bar", "value = [0, -100]", "value = 100"),
    ("four-bar", "value = 2.5", "value = [2.5, 0]"),
    ("four-bar", "[[moments]]", "[moments]"),
    ("four-bar", '[balance]\nlink = "1"', '[balance]\nat = "A"'),
    ("four-bar", "radius = 5", ""),
    ("slider-crank", "direction = [1, 0] }", "direction = [1] }"),
    ("slider-crank", "through", "trough"),
    ("slider-crank", ', pick = "right"', ""),
    ("slider-crank", 'along = "frame"', "along = 0"),
    ("cylinder", 'slide = ["rod", "barrel"]', 'slide = "rod"'),
    ("cylinder", "speed = 20", ""),
    ("open-chain", "velocity = [100, 50]", "velocity = 100"),
    ("open-chain", "velocity = [100, 50]", ""),
]


@pytest.mark.parametrize(("kind", "old", "new"), BAD)
def test_bad_scenes_are_invalid(kind: str, old: str, new: str) -> None:
    """What the loader refuses for its keys, kinds of value and words, the schema refuses too."""
    text = re.sub(r" +# .*", "", whole(kind))
    assert old in text
    spoilt = text.replace(old, new, 1)
    with pytest.raises(SceneError):
        parse(spoilt, "spoilt.toml")
    assert errors(scene(), tomllib.loads(spoilt))


def forms(fragment: Mapping[str, Any], section: str) -> Iterator[Form]:
    """The tables that a schema allows in a section."""
    if "properties" in fragment:
        yield section, frozenset(fragment["properties"]), frozenset(fragment["required"])
    inner = [*fragment.get("properties", {}).values(), *fragment.get("anyOf", ())]
    inner += [part for key in ("items", "additionalProperties") if isinstance(part := fragment.get(key), dict)]
    for part in inner:
        yield from forms(part, section)


def test_schema_and_loader_know_the_same_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every table that the loader reads is in the schema with the same keys and requirements, and the reverse."""
    read: set[Form] = set()
    fields = SceneItem.fields

    def recorded(item: SceneItem, known: Any, required: Mapping[str, str]) -> Any:
        read.add((item.where.split(".")[0], frozenset(known), frozenset(required)))
        return fields(item, known, required)

    monkeypatch.setattr(SceneItem, "fields", recorded)
    for name in packaged_names():
        load(name)
    for kind in KINDS:
        parse(whole(kind), kind)
    top = {form for form in read if form[0] == ""}
    assert {form[1] for form in top} == {frozenset(scene()["properties"])}
    told = {form for name, part in scene()["properties"].items() for form in forms(part, name)}
    assert read - top == told


def test_schema_and_loader_know_the_same_units() -> None:
    """The units of the schema are those of the loader."""
    units = scene()["properties"]["units"]["properties"]
    assert {name: unit["enum"] for name, unit in units.items()} == {name: [*of] for name, of in BY_QUANTITY.items()}


def test_everything_in_a_scene_is_described() -> None:
    """Every key of a scene has words in the schema that an editor shows."""
    def bare(fragment: Mapping[str, Any]) -> Iterator[str]:
        for key, part in fragment.get("properties", {}).items():
            if not part.get("description"):
                yield key
        for part in (*fragment.get("properties", {}).values(), *fragment.get("anyOf", ()), fragment.get("items"),
                     fragment.get("additionalProperties")):
            if isinstance(part, dict):
                yield from bare(part)

    assert list(bare(scene())) == []


@pytest.mark.parametrize("name", packaged_names())
def test_printed_results_are_valid(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """What `solve` prints of every packaged scene is valid after its schema."""
    assert errors(schema_of("solve"), printed(capsys, "solve", name)) == []


@pytest.mark.parametrize("how", [["jaanimets-10", "--exact"], ["jaanimets-10", "--digits", "20"],
                                 ["four-bar", "--pencil", "point=0.2"], ["five-bar", "--at", "20"]], ids=" ".join)
def test_other_numbers_are_valid(how: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """So is what it prints as fractions, with proven digits, with a pencil, and of another pose."""
    if "--digits" in how:
        pytest.importorskip("flint")
    assert errors(schema_of("solve"), printed(capsys, "solve", *how)) == []


@pytest.mark.parametrize("name", packaged_names())
def test_printed_steps_are_valid(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """What `steps --json` prints of every packaged scene is valid after its schema."""
    assert errors(schema_of("steps"), printed(capsys, "steps", name, "--json", "--set", "sheet.protocol=none")) == []


def test_strict_steps_are_valid(capsys: pytest.CaptureFixture[str]) -> None:
    """So are the steps with compasses and straightedge alone."""
    assert errors(schema_of("steps"), printed(capsys, "steps", "four-bar", "--json", "--strict")) == []


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
def test_other_results_are_invalid(of: str, path: list[str | int], value: object,
                                   capsys: pytest.CaptureFixture[str]) -> None:
    """Results of another shape are not valid."""
    spoilt = copy.deepcopy(printed(capsys, of, "four-bar", *(["--json"] if of == "steps" else [])))
    place = spoilt
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    assert errors(schema_of(of), spoilt)
