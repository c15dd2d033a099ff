"""A header that is missing is one fault, not one for each line that follows from it."""

from __future__ import annotations

import pytest

from graphplan.errors import SceneError
from graphplan.mechanism.scene import load, packaged_names, parse


def _lines(text: str) -> tuple[str, ...]:
    with pytest.raises(SceneError) as error:
        parse(text, "scene.toml")
    return error.value.lines


@pytest.mark.parametrize("name", packaged_names()[::6])
def test_points_without_their_header_are_a_few_lines(name: str) -> None:
    """That the scene has no points says why it knows none of their names."""
    lines = _lines(load(name).text.replace("[points]\n", "", 1))
    assert not any("there is no point" in line for line in lines)
    assert sum("unknown key" in line for line in lines) <= 3


def test_many_unknown_keys_are_told_together() -> None:
    """With the first of them, and where they stand."""
    assert _lines(load("four-bar").text.replace("[points]\n", "", 1))[0] == (
        "scene.toml: file: unknown keys O, A, B, ...; the header of their table above them")


def test_a_name_is_unknown_only_where_others_are_known() -> None:
    """Where the scene has points, a name that is none of them is told."""
    assert _lines(load("four-bar").text.replace('1 = "O A"', '1 = "O Q"'))[0].startswith(
        "scene.toml: links.1: there is no point Q; one of ")
