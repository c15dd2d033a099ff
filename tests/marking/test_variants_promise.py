"""What is promised of variants, over random ranges of random scenes, measured on the sheets that are printed."""

from __future__ import annotations

import math
import random
import re
from fractions import Fraction

import pytest

import graphplan as gp
from graphplan.accuracy.drafted import Drafted
from graphplan.errors import Refused
from graphplan.marking.classroom.variants import Design
from graphplan.mechanism.scene import load, parse, tables_of
from graphplan.mechanism.variation import numbers
from graphplan.output.svg import svg
from graphplan.public.drafting import Options
from graphplan.public.variants import draft_scene
from graphplan.sheet.handout import solution

SCENES = ("four-bar", "slider-crank", "ozols-5-1", "slotted-link", "rosenauer-basic", "triad", "five-bar",
          "jaanimets-11")
COUNT = 4
VECTOR = re.compile(r'data-from="(\S+) (\S+)" data-to="(\S+) (\S+)" data-vector="([^"]+)"')


def draw(scene: gp.Scene) -> Drafted:
    """A scene on its sheet."""
    return draft_scene(Options(), scene)


def vectors(drafted: Drafted) -> dict[str, float]:
    """The mm of each vector on the printed solution, as its SVG says."""
    text = svg(solution(drafted.composition)[0])
    return {name: math.dist((float(x), float(y)), (float(u), float(v))) for x, y, u, v, name in VECTOR.findall(text)}


def ranges(name: str, seed: int) -> str:
    """A scene with one or two numbers varied at random, by up to 40 % of what they are."""
    dice, scene = random.Random(seed), load(name)
    text = re.sub(r"(?s)\n\[vary\].*?(?=\n\[|$)", "\n", scene.text)
    paths = [(keys, value) for keys, value in numbers(tables_of(text, name))
             if keys[0] in ("points", "drive") and value]
    lines = ["", "[vary]"]
    for keys, value in dice.sample(paths, dice.choice((1, 2))):
        values = sorted({Fraction(round(float(value) * (1 + dice.uniform(-0.4, 0.4)), 1)).limit_denominator(10)
                         for _ in range(dice.choice((3, 8)))})
        lines.append(f'"{".".join(keys)}" = [{", ".join(f"{float(one):g}" for one in values if one)}]')
    return text + "\n".join(lines) + "\n"


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("name", SCENES)
def test_vectors_are_long_enough_and_tasks_differ(name: str, seed: int) -> None:
    """Asked vectors have 8 mm, all others 3, unless the scene's own sheet has no more; tasks differ as far as the grid
    has good ones."""
    text = ranges(name, seed)
    own = draw(parse(text, name))
    design = Design(own, draw, map)
    try:
        series = design.series(COUNT, seed, lambda done, of: None)
    except Refused:
        return
    scales, own_sizes = set[str](), vectors(own)
    for variant in series.variants:
        drafted = draw(parse(variant.text, name))
        scales.add(str(drafted.composition.scales))
        for vector, mm in vectors(drafted).items():
            least = 8.0 if vector.startswith(("velocity", "acceleration")) else 3.0
            assert mm >= min(least, own_sizes.get(vector, least) / 1.25) - 0.01, (vector, mm)
        assert drafted.composition.poor <= max(0.15, 1.25 * own.composition.poor)
    grid = math.prod(map(len, design.scene.vary.values()))
    different = {variant.numbers_text for variant in series.variants}
    assert len(scales) == 1
    assert len(different) == COUNT - series.repeated
    if series.repeated:
        assert len(different) + len(series.drawn_anew) == grid
