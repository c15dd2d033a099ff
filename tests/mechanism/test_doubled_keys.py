"""A scene that says a thing twice is told which, and in which lines."""

from __future__ import annotations

import pytest

from graphplan.errors import SceneError
from graphplan.mechanism.scene import parse

DOUBLED = {
    "[points]\nA = [0, 0]\nB = [1, 1]\nA = [2, 2]\n": "line 4: points.A is given twice, first in line 2",
    "[points]\nA = [0,\n1]\nB = [1, 1]\nA = [\n2,\n2]\n": "line 5: points.A is given twice, first in line 2",
    "[points]\n'A' = [0, 0]\n\"A\" = [2, 2] # [points]\n": "line 3: points.A is given twice, first in line 2",
    "[points]\nA = [0, 0]\n[links]\n[points]\nB = [1, 1]\n": "line 4: points is given twice, first in line 1",
    "[points]\nA = [0, 0]\n[points.A]\nfrom = 'O'\n": "line 3: points.A is given twice, first in line 2",
    "[points]\nA.from = 'O'\nA = [1, 1]\n": "line 3: points.A is given twice, first in line 2",
    "[points]\nA = { distance = 1, distance = 2 }\n": "line 2: the key distance is given twice in one table",
    "title = '''\ntitle = 1\n'''\ntitle = 'b'\n": "line 4: title is given twice, first in line 1",
    "[[drive]]\nlink = 1\n[[drive]]\nlink = 1\nlink = 2\n": "line 5: drive.2.link is given twice, first in line 4",
    "[masses.2]\nmass = 1\n[masses.2]\nmass = 3\n": "line 3: masses.2 is given twice, first in line 1",
    "[drive]\nlink = '1'\n[[drive]]\nlink = '2'\n": "line 1: drive is a list of tables, but not here",
    "[[drive]]\nlink = '1'\n[drive]\nlink = '2'\n": "line 3: drive is a list of tables, but not here",
}


@pytest.mark.parametrize("text", DOUBLED)
def test_what_is_given_twice_is_named_with_both_lines(text: str) -> None:
    """One fault, with the key's whole name, the line where it stands again and the line where it stood first."""
    with pytest.raises(SceneError) as error:
        parse(text, "scene.toml")
    (line,) = error.value.lines
    assert line.startswith(f"scene.toml: {DOUBLED[text]}; ")
