"""What a task says: lengths and angles in the place of coordinates, and what the teacher has added."""

from __future__ import annotations

import re

import pytest

import graphplan as gp
from graphplan.mechanism.scene import packaged_names
from graphplan.methods.construct import construct
from graphplan.sheet.handout import task
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.plates.display import Text
from graphplan.sheet.words.task import data

WISH = "Find the velocity of M, then check the rocker."


def words(scene: gp.Scene) -> str:
    """All that stands on the sheets of a scene's task."""
    texts = [item for sheet in task(compose(construct(scene))) for item in sheet.items if isinstance(item, Text)]
    return " ".join("".join(run.text for run in text.runs) for text in texts)


@pytest.mark.parametrize("name", packaged_names())
def test_a_task_gives_lengths_and_no_coordinates_of_points(name: str) -> None:
    """Of links the distances of their points, of the frame where its points lie from the first; where points lie that
    are of no link, as where two links touch, no length says."""
    scene = gp.load(name)
    told = [str(sentence) for sentence in data(scene) if str(sentence).startswith("Points")]
    loose = [point for point in scene.points if not scene.links_of[point]]
    assert len(told) == bool(loose)
    assert all(f"{point} (" in sentence for sentence in told for point in loose)
    assert sum(sentence.count("(") for sentence in told) == len(loose)


def test_dimensions_and_angles_are_told() -> None:
    """The sides of the links, the frame, and where the crank stands; once on the page."""
    told = " ".join(map(str, data(gp.load("four-bar"))))
    assert "Links: OA = 111.8, AB = 162.63" in told
    assert "Frame: OC = (310, 0) mm" in told
    assert "Drive: phi_1 = 79.695°" in told
    assert len(re.findall("162.63", words(gp.load("four-bar")))) == 1


def test_a_pose_to_be_constructed_is_so_from_points() -> None:
    """Lengths and the angle of the pose would say what is to be found."""
    assert "Points, in mm" in next(iter(data(gp.at(gp.load("four-bar"), 30))))


def test_the_teacher_has_a_word_on_the_task_and_on_the_method() -> None:
    """`task` stands at its head, `method` is drawn where none is named."""
    text = gp.load("alt-eight-link").text
    scene = gp.parse(f'{text}\n[sheet]\ntask = "{WISH}"\nmethod = "trial"\n', "scene")
    assert WISH in words(scene)
    assert construct(scene).prefer == construct(gp.load("alt-eight-link"), method="trial").prefer
    assert construct(scene, method="auxiliary").prefer == "auxiliary point"
