"""Edits of a scene's text by the mouse: what each writes, and that comments, order and layout stay."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import pytest

import graphplan as gp
from graphplan.board.answers import edit_scene
from graphplan.board.edit import apply_operations
from graphplan.errors import Refused
from graphplan.mechanism.scene import packaged_names

COMMENTED = """\
# a crank and its rod
title = "Slider-crank"   # of a pump

[points]
A = [0, 0]      # the shaft
B = [30, 40]
# the piston
C = [150, 0]

[links]
1 = "A B"       # the crank
2 = "B C"
3 = "C"
frame = "A"

[[slides]]
link = "3"
along = "frame"   # the cylinder
at = "C"
direction = [1, 0]

[[drive]]
link = "1"
omega = 10   # rad/s
"""


def after(text: str, *operations: dict[str, Any]) -> str:
    """The text after operations."""
    return apply_operations(text, "scene", operations)[0]


def tables(text: str) -> dict[str, Any]:
    return tomllib.loads(text)


def places(text: str) -> dict[str, complex]:
    return {name: complex(*map(float, place)) for name, place in gp.parse(text).points.items()}


FOUR_BAR = [{"do": "point", "at": at} for at in ([0, 0], [20, 110], [135, 225], [310, 0])] + [
    {"do": "link", "points": [*ends]} for ends in ("AB", "BC", "CD")] + [
    {"do": "fix", "point": "A"}, {"do": "fix", "point": "D"}, {"do": "drive", "link": "1"}]


def test_a_drawing_from_nothing_is_a_scene() -> None:
    """Points are A, B, C ..., links 1, 2, 3 ..., the drive turns at 10 rad/s."""
    text = after("", *FOUR_BAR, {"do": "ask", "point": "C"})
    assert tables(text) == {
        "points": {"A": [0, 0], "B": [20, 110], "C": [135, 225], "D": [310, 0]},
        "links": {"1": "A B", "2": "B C", "3": "C D", "frame": "A D"}, "drive": [{"link": "1", "omega": 10}],
        "find": {"velocity": ["C"], "acceleration": ["C"]}}
    assert gp.solve(gp.parse(text)).velocity["C"] == pytest.approx(gp.solve(gp.load("four-bar")).velocity["B"])


def test_the_alphabet_ends_and_goes_on_with_numbers() -> None:
    """After Z comes A1; the letter O is one as any other, and one that is free again is taken."""
    text = after("", *[{"do": "point", "at": [k, 0]} for k in range(28)])
    assert [*tables(text)["points"]][13:16] + [*tables(text)["points"]][25:] == ["N", "O", "P", "Z", "A1", "B1"]
    assert "D" in tables(after(after(text, {"do": "erase", "kind": "point", "name": "D"}),
                               {"do": "point", "at": [0, 9]}))["points"]


def test_comments_order_and_layout_stay() -> None:
    """An edit changes its own line and no other."""
    edits = {"B = [30, 40]": ({"do": "move", "point": "B", "to": [24, 32]}, "B = [24, 32]"),
             'frame = "A"': ({"do": "fix", "point": "C"}, 'frame = "A C"'),
             "omega = 10   # rad/s": ({"do": "value", "path": ["drive", 0, "omega"], "value": 12},
                                      "omega = 12   # rad/s"),
             "A = [0, 0]      # the shaft": ({"do": "move", "point": "A", "to": [1, 2.5]},
                                             "A = [1, 2.5]      # the shaft")}
    for old, (operation, new) in edits.items():
        assert after(COMMENTED, operation) == COMMENTED.replace(old, new)


def test_a_comment_stays_above_its_own_table() -> None:
    """Added keys and tables stand above the comment of the next table; an erased table takes its own comment along."""
    text = COMMENTED.replace("[[slides]]", "# the pair\n[[slides]]").replace("[[drive]]", "# the motor\n[[drive]]")
    added = after(text, {"do": "link", "points": ["A", "C"]}, {"do": "slide", "point": "B", "direction": [0, 1]})
    assert "\n\n# the pair\n[[slides]]\nlink = \"3\"" in added
    assert "\n\n# the motor\n[[drive]]" in added
    erased = after(text, {"do": "erase", "kind": "slide", "name": 0})
    assert "# the pair" not in erased
    assert "\n\n# the motor\n[[drive]]" in erased


@pytest.mark.parametrize("name", packaged_names())
def test_what_is_added_goes_again(name: str) -> None:
    """In every packaged scene a point that is added and erased, and one that is moved there and back, leave the text;
    comments and all."""
    text = gp.load(name).text
    with_point = after(text, {"do": "point", "at": [1, 2]})
    added = ({*tables(with_point)["points"]} - {*tables(text)["points"]}).pop()
    assert after(with_point, {"do": "erase", "kind": "point", "name": added}) == text
    for point, place in tables(text)["points"].items():
        if isinstance(place, list):
            there = after(text, {"do": "move", "point": point, "to": [9.5, 7]})
            assert after(there, {"do": "move", "point": point, "to": place}).split() == text.split()
            break


def test_a_block_is_made_where_a_rod_would_be_stuck() -> None:
    """The end of a connecting rod slides on a block that is made for it; a block that is there is taken."""
    text = after("", *FOUR_BAR[:3], *FOUR_BAR[4:6], {"do": "fix", "point": "A"}, {"do": "drive", "link": "1"},
                 {"do": "slide", "point": "C", "direction": [1, 0]})
    assert tables(text)["links"] == {"1": "A B", "2": "B C", "frame": "A", "3": "C"}
    assert tables(text)["slides"] == [{"link": "3", "along": "frame", "at": "C", "direction": [1, 0]}]
    assert gp.solve(gp.parse(text)).velocity["C"].imag == 0
    own = after("", *FOUR_BAR[:6], {"do": "link", "points": ["C"]}, {"do": "slide", "point": "C", "direction": [1, 0]})
    assert tables(own)["slides"][0]["link"] == "3"


def test_a_block_slides_along_the_line_of_the_link_that_is_nearest() -> None:
    """The guide of a link is the line of two of its points on which the sliding point lies."""
    text = after("", *[{"do": "point", "at": at} for at in ([0, 0], [60, 0], [0, 80], [30, 40])],
                 {"do": "link", "points": ["A", "B", "C"]}, {"do": "link", "points": ["D"]},
                 {"do": "slide", "point": "D", "along": "1"})
    assert tables(text)["slides"] == [{"link": "2", "along": "1", "at": "D", "direction": "B C"}]


def test_a_force_is_balanced_by_the_drive() -> None:
    """A force that is drawn has a balance, where a drive is there or comes; with the last force it goes."""
    load = {"do": "load", "point": "C", "value": [-50, 20]}
    for operations in ([*FOUR_BAR, load], [*FOUR_BAR[:-1], load, FOUR_BAR[-1]]):
        text = after("", *operations)
        assert tables(text)["forces"] == [{"on": "2", "at": "C", "value": [-50, 20]}]
        assert tables(text)["balance"] == {"link": "1"}
        assert gp.solve(gp.parse(text)).balance
    assert {"forces", "balance"}.isdisjoint(tables(after(text, {"do": "erase", "kind": "force", "name": 0})))


# ---- lengths ---------------------------------------------------------------------------------------------------------


def locked() -> str:
    """A four-bar all of whose lengths are typed."""
    return after("", *FOUR_BAR, {"do": "length", "ends": ["A", "B"], "length": 100},
                 {"do": "length", "ends": ["B", "C"], "length": 180},
                 {"do": "length", "ends": ["C", "D"], "length": 270})


def test_a_typed_length_is_kept_while_other_points_are_dragged() -> None:
    """Whichever point is dragged, and wherever, the typed lengths hold and the frame stands still."""
    for point, to in (("B", [-90, 30]), ("C", [60, 260]), ("C", [2000, 90]), ("B", [0, -50]), ("C", [150, 210])):
        at = places(after(locked(), {"do": "move", "point": point, "to": to}))
        lengths = [abs(at[b] - at[a]) for a, b in ("AB", "BC", "CD")]
        assert lengths == pytest.approx([100, 180, 270])
        assert (at["A"], at["D"]) == (0, 310)


def test_a_dragged_joint_comes_as_near_as_its_lengths_let_it() -> None:
    """The joint of coupler and rocker follows the mouse along its arc, and turns the crank."""
    goal = 310 + 270 * complex(math.cos(2.2), math.sin(2.2))
    at = places(after(locked(), {"do": "move", "point": "C", "to": [goal.real, goal.imag]}))
    assert abs(at["C"] - goal) < 0.1


def test_an_angle_is_typed_at_the_drive() -> None:
    """The driven link turns to the angle, and keeps its length."""
    for text in (after("", *FOUR_BAR), locked()):
        before, at = places(text), places(after(text, {"do": "angle", "ends": ["A", "B"], "angle": 60}))
        assert math.degrees(math.atan2(at["B"].imag, at["B"].real)) == pytest.approx(60)
        assert abs(at["B"]) == pytest.approx(abs(before["B"]))


def test_a_third_length_is_refused_until_one_is_freed() -> None:
    """A point is placed by two lengths at most; a freed one stays where it is."""
    braced = after("", *FOUR_BAR[:4], {"do": "link", "points": ["A", "B", "C"]},
                   {"do": "length", "ends": ["A", "B"], "length": 100},
                   {"do": "length", "ends": ["A", "C"], "length": 200},
                   {"do": "length", "ends": ["B", "C"], "length": 150})
    assert tables(braced)["points"]["C"] == {"distances": {"A": 200, "B": 150}, "side": "right"}
    with pytest.raises(Refused, match="placed by other lengths"):
        after(braced, {"do": "length", "ends": ["D", "C"], "length": 150},
              {"do": "length", "ends": ["D", "B"], "length": 150}, {"do": "length", "ends": ["D", "A"], "length": 150})
    free = after(braced, {"do": "free", "point": "B"})
    at, braced_at = (edit_scene(text=text, name="scene", operations=[])["objects"]["points"] for text in (free, braced))
    assert at["B"]["at"] == pytest.approx(braced_at["B"]["at"])


@pytest.mark.small
@pytest.mark.parametrize(("name", "operation"), [
    ("gear-linkage", {"do": "free", "point": "B"}), ("biplanetary", {"do": "length", "ends": ["O", "A"], "length": 50}),
    ("roller-cam", {"do": "length", "ends": ["O", "C"], "length": 34})])
def test_a_point_that_is_placed_anew_stays(name: str, operation: dict[str, Any]) -> None:
    """A point that is freed, or gets the length that it has, stays where it is: wheels and profiles still touch."""
    text = after(gp.load(name).text, operation)
    assert text != gp.load(name).text
    assert places(text) == pytest.approx(places(gp.load(name).text))


# ---- erased and renamed ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", packaged_names())
def test_what_is_erased_takes_along_what_needs_it(name: str) -> None:
    """In every packaged scene each point and each link can be erased: nothing then names what is gone."""
    scene = gp.load(name)
    for kind, names in (("point", scene.points), ("link", scene.moving)):
        for erased in [*names][:4]:
            answer = edit_scene(text=scene.text, name="scene", operations=[
                {"do": "erase", "kind": kind, "name": erased}])
            assert [fault["text"] for fault in answer["faults"] if "there is no" in fault["text"]] == []
            assert erased not in answer["objects"][f"{kind}s"]


def test_varied_numbers_follow_their_tables() -> None:
    """Paths of [vary] follow a list that is shortened; those of numbers that are gone go."""
    vary = '[vary]\n"drive.1.omega" = [1, 2]\n"drive.0.omega" = [3]\n"points.B.0" = [4]\n'
    text = COMMENTED + '\n[[drive]]\nlink = "2"\nomega = 7\n' + vary
    erased = tables(after(text, {"do": "erase", "kind": "drive", "name": 0}))
    assert erased["vary"] == {"drive.0.omega": [1, 2], "points.B.0": [4]}
    assert erased["drive"] == [{"link": "2", "omega": 7}]
    locked = after(text, {"do": "length", "ends": ["A", "B"], "length": 50})
    assert [*tables(locked)["vary"]] == ["drive.1.omega", "drive.0.omega"]


def test_a_slide_is_erased_by_its_whole_name() -> None:
    """A load over "13 along frame" stays when the slide "3 along frame" is erased; one over the latter goes."""
    load = '\n[[forces]]\non = "2"\nat = "B"\ndirection = [1, 0]\nover = "{} along frame"\nvalues = [[0, 1], [9, 1]]\n'
    text = after(COMMENTED + load.format("13") + load.format("3"), {"do": "erase", "kind": "slide", "name": 0})
    assert [force["over"] for force in tables(text)["forces"]] == ["13 along frame"]


def test_comments_within_a_question_stay() -> None:
    """A point that is asked for, or not any more, is a word more or less in the list; one in a text too."""
    find = '\n[find]\nvelocity = [  # all\n  "B",  # the pin\n]\nacceleration = "B"\n'
    asked = after(COMMENTED + find, {"do": "ask", "point": "C"})
    assert "# all" in asked
    assert "# the pin" in asked
    assert tables(asked)["find"] == {"velocity": ["B", "C"], "acceleration": ["B", "C"]}
    assert "find" not in tables(after(COMMENTED + find, {"do": "ask", "point": "B", "wanted": False}))


def test_a_joint_that_is_none_any_more_has_no_reaction() -> None:
    """With one of its two links a joint goes from the reactions that are asked for."""
    text = COMMENTED + '\n[find]\nreactions = ["A", "B"]\n'
    assert tables(after(text, {"do": "erase", "kind": "link", "name": "2"}))["find"] == {"reactions": ["A"]}


@pytest.mark.parametrize("name", packaged_names())
def test_another_name_changes_no_number(name: str) -> None:
    """In every packaged scene a point or a link under another name gives the same results under that name."""
    scene = gp.load(name)
    point, link = [*scene.points][-1], scene.moving[-1]
    text = after(scene.text, {"do": "rename", "kind": "point", "old": point, "new": "Ω9"},
                 {"do": "rename", "kind": "link", "old": link, "new": "L99"})
    renamed = gp.parse(text)
    assert {"Ω9" if one == point else one for one in scene.points} == {*renamed.points}
    assert {"L99" if one == link else one for one in scene.moving} == {*renamed.moving}
    assert gp.analytic.solve(renamed).velocity.get("Ω9") == gp.analytic.solve(scene).velocity.get(point)


@pytest.mark.parametrize(("old", "new"), [("A", "B"), ("A", ""), ("A", "a b"), ("Q", "R"), ("A", "x\ny")])
def test_a_name_that_cannot_be_is_refused(old: str, new: str) -> None:
    """A name that is taken, empty or none is refused, and the text stays."""
    operations = [{"do": "rename", "kind": "point", "old": old, "new": new}]
    answer = edit_scene(text=COMMENTED, name="scene", operations=operations)
    assert answer["refused"]
    assert answer["text"] == COMMENTED


# ---- faults ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("number", "line", "about"), [
    (6, 'B = { from = "Q", distance = 3, angle = 4 }', ["point", "B"]), (12, '2 = "B X"', ["link", "2"]),
    (19, 'at = "B"', ["slide", 0]), (23, 'link = "9"', ["drive", 0]),
])
def test_a_fault_names_its_object_and_its_line(number: int, line: str, about: list[Any]) -> None:
    """A fault is about the object that its place in the scene leads to, at the line where that stands."""
    lines = COMMENTED.splitlines()
    lines[number - 1] = line
    faults = edit_scene(text="\n".join(lines), name="scene", operations=[])["faults"]
    assert (about, number) in [(fault["object"], fault["line"]) for fault in faults]


def test_a_fault_of_toml_names_its_line() -> None:
    """A text that is no TOML has one fault, at its line, and no objects."""
    answer = edit_scene(text=COMMENTED.replace("B = [30, 40]", "B = [30, 40"), name="scene", operations=[])
    assert answer["objects"] is None
    assert [fault["line"] for fault in answer["faults"]] == [8]
