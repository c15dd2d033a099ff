"""The texts of a live page, filled in by its JavaScript: word for word what Python tells of the same pose."""

from __future__ import annotations

import json
import math
import random
import shutil
import subprocess
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import Any

import pytest

import graphplan as gp
from graphplan.cycle import follow
from graphplan.kernel.numbers import Floats
from graphplan.output.live.texts import Telling, Texts
from graphplan.phrases import Said, Unknown, arrange, digits, in_any_case, tenths
from graphplan.sheet.cycle_frames import construction_in_pose
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.protocol import Protocol
from graphplan.words.tongue import tongue

NODE = shutil.which("node")
pytestmark = pytest.mark.skipif(NODE is None, reason="no node is installed")
SCRIPT = files("graphplan.output.live").joinpath("texts.js").read_text("utf-8")


def run(code: str, data: Any) -> Any:
    """What JavaScript makes of some data."""
    assert NODE
    program = f'"use strict";\n{SCRIPT}\nconst data = JSON.parse(require("fs").readFileSync(0));\n{code}'
    done = subprocess.run([NODE, "-e", program], input=json.dumps(data), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def numbers() -> Iterator[float]:
    """Numbers of all sizes, many of which lie half a unit of a last figure from two others."""
    source = random.Random(5)
    yield from (0.0, 0.05, 0.25, 0.35, 0.75, 2.5, 1471.5, 12345.0, 12355.0, 99995.0, 999950.0, 9999500.0, 1e-5, 1e12)
    for _ in range(3000):
        size = 10.0 ** source.uniform(-9, 12)
        yield source.uniform(-size, size)
        yield source.choice((-1, 1)) * source.randrange(10**5) / 2 ** source.randrange(7)
        yield round(source.uniform(-1, 1), source.randrange(6)) * 10 ** source.randrange(5)


def test_numbers_are_written_as_python_writes_them() -> None:
    """In four and in six figures and in tenths, thousands of numbers are told by the same letters."""
    told = list(numbers())
    wanted = [[digits(value), digits(value, 6), digits(value, 2), tenths(value)] for value in told]
    found = run("console.log(JSON.stringify(data.map(x => [4, 6, 2, 0].map(n => Numbers.written(x, n)))))", told)
    assert [row for row in zip(told, found, wanted, strict=True) if row[1] != row[2]] == []


def test_arithmetic_beyond_the_four_operations_is_python_s() -> None:
    """The length of a vector and what a ruler makes of it are those of Python to the last bit."""
    source = random.Random(7)
    pairs = [(source.uniform(-1, 1) * 10 ** source.uniform(-6, 6), source.uniform(-1, 1) * 10 ** source.uniform(-6, 6))
             for _ in range(4000)] + [(0.0, 0.0), (3.0, 4.0), (1e-200, 1e-200), (0.0, -2.5)]
    wanted = [[math.hypot(x, y), round(x, 1)] for x, y in pairs]
    assert run("console.log(JSON.stringify(data.map(([x, y]) => [Numbers.hypot(x, y), Numbers.tenths(x)])))",
               pairs) == wanted


def test_what_hangs_on_a_number_is_told_of_both_cases() -> None:
    """A question about an unknown number opens a choice in the text, also within another; a known one does not."""
    texts = Texts(*parts(composition_of("four-bar")))
    later = texts.later
    x, y = later.input("v[0]"), later.input("v[1]")

    def told() -> Said:
        if x < 0:
            return arrange("below")
        return arrange("{0} of {1}", digits(x + y), "two" if y > 1 else "one")

    template = in_any_case(told)
    assert in_any_case(lambda: arrange("same", x > 0)) == "same"
    assert later.outputs
    poses = [[-1, 5], [2, 5], [2, 0.5]]
    found = run(f"const f = {later.javascript()}; const t = new Template(data.template, {{'.': ','}});"
                "console.log(JSON.stringify(data.poses.map(v => t.fill(f(v, [], Numbers)))))",
                {"template": template, "poses": poses})
    assert found == ["below", "7 of two", "2,5 of one"]
    assert isinstance(x, Unknown)
    with pytest.raises(TypeError):
        float(x)  # type: ignore[arg-type]


@pytest.mark.costly
def test_unknown_numbers_change_no_reading() -> None:
    """What is read of the drawn marks is what the rules read, given vectors and rates along guides too."""
    for name in ("four-bar", "shaper", "slotted-link", "triad-loaded", "open-chain"):
        drawing = composition_of(name).plans.drawing
        found = drawing.results_from_marks([drawing.values[mark] for mark in drawing.drawn.wanted], Floats())
        for kind, named in drawing.read(Floats()).items():
            for of, value in named.items():
                assert found[kind][of] == pytest.approx(value, rel=1e-6, abs=1e-6), (name, kind, of)


@cache
def composition_of(name: str) -> Composition:
    return compose(gp.construct(gp.load(name)), protocol="none")


def parts(composition: Composition) -> tuple[Plans, Any]:
    return composition.plans, composition.scales


def in_words(plans: Plans, scales: Any) -> list[str]:
    """What hangs on the pose, in the pose of these plans."""
    telling = Telling(plans, Protocol(plans, scales))
    for _ in (*telling.protocol(), *telling.readings(), telling.results()):
        pass
    return telling.parts


@pytest.mark.parametrize(("name", "language"), [
    ("slider-crank", "de"), ("slotted-link", "lv"), ("triad-loaded", "ru"), ("walschaerts-loaded", "en"),
    ("alt-eight-link", "et"), ("stephenson", "uk")])
def test_filled_in_they_are_the_texts_of_that_pose(name: str, language: str) -> None:
    """Sentences, lengths, readings and tables in other poses are, letter by letter, those of Python's own."""
    composition, say = composition_of(name), tongue(language)
    drawing, scales = composition.plans.drawing, composition.scales
    texts = Texts(composition.plans, scales)
    told = texts.texts_in(say)
    turn = follow(drawing.scene, 7, (0.0, 12.0))
    places = [[{name: complex(z[k]) for name, z in arrays.items()} for arrays in (turn.points, turn.guides)]
              for k in range(1, 7) if all(math.isfinite(abs(z[k])) for z in turn.points.values())]
    found = [pose for place in places if (pose := construction_in_pose(drawing, *place)) is not None]
    assert len(found) > 2
    wanted = [in_words(Plans(one, say), scales) for one in found]
    filled = run(f"const f = {texts.javascript()};"
                 "const all = Object.entries(data.templates).map(([k, text]) => [k, new Template(text, data.signs)]);"
                 "const told = numbers => Object.fromEntries(all.map(([k, text]) => [k, text.fill(numbers)]));"
                 "console.log(JSON.stringify(data.poses.map(values => told(f(values, Array(9).fill(1), Numbers)))))",
                 {"templates": told["templates"], "poses": [one.values for one in found],
                  "signs": {chr(sign): own for sign, own in say.signs.items()}})
    given = in_words(Plans(drawing, say), scales)
    for pose, words in zip(filled, wanted, strict=True):
        assert [pose.get(str(part), text) for part, text in enumerate(given)] == words
    assert any(words != given for words in wanted)
