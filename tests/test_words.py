"""The catalogues: every phrase of the sources in every language, none that nobody says, and all of them can be said."""

from __future__ import annotations

import ast
import json
import re
import tomllib
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from itertools import cycle
from pathlib import Path
from string import Formatter

import pytest
from matplotlib import get_data_path
from matplotlib.ft2font import FT2Font, LoadFlags

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.preference import Form, choose_form
from graphplan.commands import main
from graphplan.cycle import follow
from graphplan.design.hand import Pencil
from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.kinds import TABLE
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import KINDS
from graphplan.methods.panels import MECHANISM, JointForce, LeverPlan
from graphplan.methods.results import thing_named
from graphplan.phrases import UNITS, Said, arrange, said
from graphplan.sheet import handout
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.lettering.lettering import ADVANCE, plain
from graphplan.sheet.plates.display import Text
from graphplan.synthesis.task import load as load_task
from graphplan.words import LANGUAGES
from graphplan.words.tongue import Entry, catalogue, tongue

SAYING = {"said", "phrase"}
OTHERS = [code for code in LANGUAGES if code != "en"]


@cache
def phrases() -> frozenset[str]:
    """Every phrase that a source says, and the forms of which the choice is told."""
    sources = (path.read_text(encoding="utf-8") for path in Path(gp.__file__).parent.rglob("*.py"))
    found = {text for source in sources for text in _said(ast.parse(source))}
    weighed = {form for op in TABLE.values() if op.weighed for form in op.forms}
    methods = {op.method for op in TABLE.values()} - {""}
    return frozenset(found | weighed | methods | {form.partition(" on ")[0] for form in weighed})


@cache
def drawing_of(name: str) -> Construction:
    return gp.construct(gp.load(name))


def _said(tree: ast.AST) -> Iterator[str]:
    """The literal phrases of a module, conditional ones included."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in SAYING and node.args:
            first = node.args[0]
            parts = [first.body, first.orelse] if isinstance(first, ast.IfExp) else [first]
            yield from (part.value for part in parts if isinstance(part, ast.Constant) and isinstance(part.value, str))


def fields(pattern: str) -> set[str]:
    """What is put into a pattern, by place or name."""
    return {name for _, name, _, _ in Formatter().parse(pattern) if name is not None}


def forms(entry: Entry) -> dict[str, str]:
    """An entry as a table of forms."""
    return entry if isinstance(entry, dict) else {"": entry}


def entries(code: str) -> Iterator[tuple[str, str, str]]:
    """Every text of a catalogue with the English that it says: section, English, text."""
    found = catalogue(code)
    for name, entry in found["steps"].items():
        yield from (("steps", TABLE[name].sentence, text) for text in forms(entry).values())
    for english, entry in found["phrases"].items():
        yield from (("phrases", english, text) for text in forms(entry).values())


@pytest.mark.parametrize("code", OTHERS)
def test_every_packaged_scene_has_a_title(code: str) -> None:
    """The titles of the packaged scenes, all and no others, stand in every catalogue, each in words of its own."""
    titles = catalogue(code)["titles"]
    tasks = {load_task(name).title for name in packaged_names(TASK_FOLDER)}
    assert set(titles) == {gp.load(name).title for name in packaged_names()} | tasks
    assert len(set(titles.values())) == len(titles)
    assert not set(titles) & set(titles.values())


@pytest.mark.parametrize("code", OTHERS)
def test_a_catalogue_is_toml(code: str) -> None:
    """What is read of a catalogue line by line is what TOML says that it holds."""
    text = files("graphplan.words").joinpath(f"{code}.toml").read_text("utf-8")
    assert {name: dict(section) for name, section in catalogue(code).items()} == tomllib.loads(text)


@pytest.mark.parametrize("code", OTHERS)
def test_no_key_is_missing_or_unused(code: str) -> None:
    """A catalogue has the sentence of every primitive and every phrase of the sources, and no others."""
    found = catalogue(code)
    assert set(found["steps"]) ^ set(TABLE) == set()
    assert set(found["phrases"]) ^ phrases() == set()


@pytest.mark.parametrize("code", OTHERS)
def test_every_text_uses_what_is_put_into_it(code: str) -> None:
    """A translation has the places of its English, each at least once."""
    assert [(english, text) for _, english, text in entries(code) if fields(text) != fields(english)] == []


@pytest.mark.parametrize("code", OTHERS)
def test_every_form_that_is_asked_for_is_there(code: str) -> None:
    """All tables of cases of a language have the same forms, those of headings one of one and one of many things, and
    no text asks for another."""
    tables = {frozenset(entry) for section in ("steps", "phrases") for entry in catalogue(code)[section].values()
              if isinstance(entry, dict)}
    assert len(tables - {frozenset({"one", "many"})}) <= 1
    known = {"", "capital", *(name for table in tables for name in table)}
    asked = {form for _, _, text in entries(code) for _, _, form, _ in Formatter().parse(text) if form}
    assert asked <= known


@pytest.mark.parametrize("code", OTHERS)
def test_every_letter_is_measured(code: str) -> None:
    """The lettering knows the advance of each character of a catalogue."""
    used = {char for section in catalogue(code).values() for entry in section.values()
            for text in forms(entry).values() for char in text}
    assert used - set(ADVANCE) == set()


def test_advances_are_those_of_the_font() -> None:
    """The widths of all letters are those of DejaVu Sans, as the plotting library ships it."""
    font = FT2Font(str(Path(get_data_path(), "fonts", "ttf", "DejaVuSans.ttf")))
    font.set_size(1000.0, 72)
    wide = {char: font.load_char(ord(char), flags=LoadFlags.NO_HINTING).linearHoriAdvance / 65536 for char in ADVANCE}
    assert max(abs(wide[char] - 1000 * ADVANCE[char]) for char in ADVANCE) < 1.0


@pytest.mark.parametrize("code", OTHERS)
@pytest.mark.parametrize("name", packaged_names())
def test_every_scene_can_be_said(name: str, code: str) -> None:
    """Steps, stages, forms and methods of every scene come out in the language: no English phrase is left among them.
    """
    drawing, say = drawing_of(name), tongue(code)
    told = [*drawing.sentences(), *drawing.forms, *(way for ways in drawing.method.values() for way in ways),
            *(words for stage, _ in drawing.drawn.stages for words in (stage.title, stage.law))]
    assert all(isinstance(text, Said) for text in told)
    assert all(say(text) and "{" not in say(text) for text in told)


@pytest.mark.parametrize(("name", "code"), list(zip(packaged_names()[::3], cycle(OTHERS), strict=False)))
def test_numbers_and_units_are_written_as_the_language_has_them(name: str, code: str) -> None:
    """No number of a solution or a guided handout has a decimal point, but in the source, which is as it is printed;
    and no unit is in Latin letters where the language has others."""
    composition = compose(drawing_of(name), tongue=tongue(code))
    sheets = [*handout.solution(composition), *handout.guided_task(composition)]
    told = " ".join(plain(item.runs) for sheet in sheets for item in sheet.items if isinstance(item, Text))
    told = f"{told} {sheets[0].description}".replace(drawing_of(name).scene.source, "")
    assert re.findall(r"\S*\d\.\d\S*", told) == []
    if catalogue(code)[UNITS]:
        assert re.findall(r"\b(?:mm|cm|kg|rad|N·m)\b|/s\b|\bN/", told) == []


def test_data_are_the_same_in_every_language(capsys: pytest.CaptureFixture[str]) -> None:
    """The values and names of the steps as data have points and no words: a decimal comma changes none of them."""
    told = {}
    for code in ("en", "ru"):
        assert main(["steps", "four-bar", "--json", "--language", code]) == 0
        steps = json.loads(capsys.readouterr().out)["steps"]
        told[code] = [(step["number"], step["value"], step["operation"], step["plan"]) for step in steps]
    assert told["ru"] == told["en"]
    assert any(number % 1 for _, value, *_ in told["en"] for number in value)


def test_a_number_stands_before_words_that_have_forms() -> None:
    """As in the headings of pictures: whatever form is asked of the words, the number stays as it is."""
    heading = arrange("{0}. {1}", 3, MECHANISM.words)
    assert tongue("ru")(heading) == f"3. {tongue('ru')(MECHANISM.words)}"
    assert tongue("ru")(said("all of the {0} is reversed", heading)).startswith("3. ")


@pytest.mark.parametrize(("kind", "of", "told"), [
    ("slide velocity", "3 along frame", "3 auf Gestell"), ("reaction", "frame at O", "Gestell in O"),
    ("slide reaction", "3 along frame", "3 auf Gestell"), ("velocity", "A", "A"), ("omega", "3", "3"),
])
def test_results_are_named_in_the_language(kind: str, of: str, told: str) -> None:
    """The names of results come out in the language: slides, and reactions at joints."""
    assert tongue("de")(thing_named(gp.load("slider-crank"), KINDS[kind], of)) == told


def test_levers_are_named_in_the_language() -> None:
    """A lever is spoken of by what it serves: a balance by number, or a reaction at a joint."""
    assert tongue("de")(LeverPlan.of_part(2).words) == "Hebelplan 2"
    assert tongue("de")(LeverPlan.of_part(JointForce("B", "frame"), "x").words) == "Hebelplan Gestell in B, x"


@pytest.mark.parametrize("code", OTHERS)
def test_a_preference_is_told_in_the_language(code: str) -> None:
    """What speaks for the forms, and why one cannot be drawn, has no English word left."""
    refused = [ConstructionError("lines-parallel", 3, "q", "why", "do"),
               Refused(said("point {0}", "A"), said("no known construction determines it"), "do")]
    told = choose_form([Form(("", "auxiliary", "poles"), draft(drawing_of("four-bar"), Pencil())),
                        *(Form(("trial",), None, refusal) for refusal in refused)], "balanced").remarks
    english = {"pose", "own", "auxiliary", "trial", "poles", "preferred", "drawn", "step", "lines", "point", "balanced"}
    assert english.isdisjoint(re.findall(r"\w+", " ".join(map(tongue(code), told)).lower()))


@pytest.mark.parametrize("scene", ["open-chain", "ozols-5-3"])
def test_a_drive_that_cannot_turn_is_told_in_the_language(scene: str) -> None:
    """Why there is no turn of the drive, as the page for a browser tells it, is a phrase."""
    with pytest.raises(Refused) as refused:
        follow(gp.load(scene), 4)
    assert tongue("ru")(refused.value.why) != str(refused.value.why)
