"""The table [vary]: numbers by their paths, with the values that they may have."""

from __future__ import annotations

from fractions import Fraction

import pytest

from graphplan.commands.new import template
from graphplan.errors import SceneError
from graphplan.mechanism.scene import load, packaged_names, parse
from graphplan.mechanism.variation import MAX_VALUES

SCENE = template("four-bar")


def varied(lines: str) -> str:
    """A scene with these lines in its table [vary]."""
    return f"{SCENE}\n[vary]\n{lines}\n"


def test_values_are_read_exactly() -> None:
    """A range has the values from its first by steps to its last; a list has its own, each once."""
    scene = parse(varied('"points.A.angle" = { from = 0.1, to = 0.45, step = 0.1 }\n"drive.0.omega" = [3, 1, 3]\n'
                         '"points.B.distances.A" = { from = 2, to = 2, step = 1 }\n\'points."C".0\' = [150]'), "scene")
    assert scene.vary == {
        "points.A.angle": (Fraction(1, 10), Fraction(1, 5), Fraction(3, 10), Fraction(2, 5)),
        "drive.0.omega": (3, 1), "points.B.distances.A": (2,), 'points."C".0': (150,)}


FAULTS = {
    '"points.A.angel" = [1]': 'vary."points.A.angel": there is no number points.A.angel; perhaps points.A.angle',
    '"drive.1.omega" = [1]': 'vary."drive.1.omega": there is no number drive.1.omega; perhaps drive.0.omega',
    '"drive.omega" = [1]': 'vary."drive.omega": there is no number drive.omega; perhaps drive.0.omega',
    '"points.A.from" = [1]': 'vary."points.A.from": the string "O" is not a number; the path of a number',
    '"points.O" = [1]': 'vary."points.O": a list of 2 is not a number; the path of a number, such as '
                        'points.O.0',
    '"sheet.k_s" = [1]': 'vary."sheet.k_s": this is the same for all variants; the path of a number of the mechanism',
    '"" = [1]': 'vary."": a table with',
    '"drive.0.omega" = 5': 'vary."drive.0.omega": the number 5 where a range is wanted; { from = 20',
    '"drive.0.omega" = []': 'vary."drive.0.omega": an empty list; { from = 20',
    '"drive.0.omega" = ["5"]': 'vary."drive.0.omega": the string "5" where a number is wanted',
    '"drive.0.omega" = { from = 3, to = 2, step = 1 }': 'vary."drive.0.omega".to: 2 is less than from, 3; at least 3',
    '"drive.0.omega" = { from = 1, to = 2, step = 0 }': 'vary."drive.0.omega".step: the step 0 is not positive; a step',
    '"drive.0.omega" = { from = 1, to = 2 }': 'vary."drive.0.omega": step is missing; how far apart',
    '"drive.0.omega" = { from = 1, too = 2, step = 1 }': 'vary."drive.0.omega".too: unknown key; perhaps to',
    '"drive.0.omega" = { from = 0, to = 1, step = 1e-9 }': 'vary."drive.0.omega".step: 1e-09 makes 1000000001 values; '
                                                           f"a larger step: at most {MAX_VALUES} values",
}


@pytest.mark.parametrize("line", FAULTS)
def test_each_fault_is_one_line(line: str) -> None:
    """What is wrong with an entry is told with its path, and what would be right."""
    with pytest.raises(SceneError) as told:
        parse(varied(line), "scene")
    assert told.value.lines[0].startswith(f"scene: {FAULTS[line]}")


def test_other_commands_do_not_see_it() -> None:
    """A scene with a table [vary] is the scene without it."""
    one, other = parse(varied('"points.A.angle" = [1, 2]'), "scene"), parse(SCENE, "scene")
    assert (one.points, one.written) == (other.points, other.written)
    assert other.vary == {}


def test_packaged_scenes_vary() -> None:
    """Some packaged scenes can be given to a class as they are."""
    assert {"four-bar", "ozols-5-1"} <= {name for name in packaged_names() if load(name).vary}
