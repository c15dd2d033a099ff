"""A pivot that is missing from the frame is told before further drives are asked for; names come in one order."""

from __future__ import annotations

import random
import re

import pytest

from graphplan.errors import SceneError
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.scene import load, packaged_names, parse

FOUR_BAR = {"links": {"1": "O A", "2": "A B M", "3": "B C", "frame": "O C"},
            "points": {"O": (0, 0), "A": (30, 40), "B": (130, 90), "C": (150, 0), "M": (60, 120)}}
SIX_BAR = {"links": {"1": "O A", "2": "A B", "3": "B C D", "4": "D E", "5": "E G", "frame": "O C G"},
           "points": {"O": (0, 0), "A": (30, 40), "B": (130, 90), "C": (150, 0), "D": (170, 80), "E": (250, 90),
                      "G": (240, 0)}}


def text(linkage: dict[str, dict[str, object]], *left_out: str, shuffled: random.Random | None = None) -> str:
    """A scene of a linkage, the points `left_out` not on its frame; in an order of chance if that is `shuffled`."""
    links = {link: str(points).split() for link, points in linkage["links"].items()}
    links[FRAME] = [point for point in links[FRAME] if point not in left_out]
    rows = [("points", [f"{name} = {list(at)}" for name, at in linkage["points"].items()]),  # type: ignore[call-overload]
            ("links", [(name, points) for name, points in links.items() if points])]
    if shuffled:
        for _, entries in rows:
            shuffled.shuffle(entries)
        for points in links.values():
            shuffled.shuffle(points)
    lines = [f"[{table}]\n" + "\n".join(e if isinstance(e, str) else f'{e[0]} = "{" ".join(e[1])}"' for e in entries)
             for table, entries in rows]
    return "\n".join([*lines, '[[drive]]\nlink = "1"\nomega = 2\n'])


def told(scene: str) -> list[str]:
    """The faults of a scene."""
    with pytest.raises(SceneError) as error:
        parse(scene, "scene")
    return list(error.value.lines)


@pytest.mark.parametrize(("linkage", "left_out", "what", "frames"), [
    (FOUR_BAR, "C", "mobility 3 but 1 drive, and C is", ["O C"]),
    (FOUR_BAR, "O", "mobility 3 but 1 drive, and O is", ["C O"]),  # M is a point of a link with more points
    (FOUR_BAR, "OC", "no link is the frame, and C and O are", ["C O"]),
    (SIX_BAR, "G", "mobility 3 but 1 drive, and G is", ["O C G"]),
    (SIX_BAR, "OG", "mobility 5 but 1 drive, and G and O are", ["C G O"]),
])
def test_a_missing_pivot_is_named(linkage: dict[str, dict[str, object]], left_out: str, what: str,
                                  frames: list[str]) -> None:
    """The points are named that would hold the links if they were on the frame, and only they."""
    more = 2 * len(left_out)
    drives = [] if what.startswith("no link") else [f"{more} more [[drive]]"]
    instead = " or ".join([*(f'frame = "{points}"' for points in frames), *drives])
    assert told(text(linkage, *left_out)) == [f"scene: links.frame: {what} on no other link; {instead}"]


def test_several_candidates_are_all_named() -> None:
    """Where one of several points may be meant each is named."""
    both = {"links": {**FOUR_BAR["links"], "3": "B C D"}, "points": {**FOUR_BAR["points"], "D": (180, 40)}}
    (line,) = told(text(both, "C"))
    assert line == ("scene: links.frame: mobility 3 but 1 drive, and C, or D is on no other link; "
                    'frame = "O C" or frame = "O D" or 2 more [[drive]]')


def test_a_missing_drive_is_none() -> None:
    """Where one drive is missing no pivot is."""
    (line,) = told(text({"links": {**FOUR_BAR["links"], "3": "B D", "4": "D C"},
                         "points": {**FOUR_BAR["points"], "D": (180, 40)}}))
    assert line == "scene: drive: mobility 2 but 1 drive; 1 more [[drive]], since links 2 3 4 can still move"


@pytest.mark.parametrize("name", packaged_names())
def test_every_pivot_of_a_packaged_scene_is_missed(name: str) -> None:
    """Whichever pivot of one link is left out of a packaged scene's frame is among those that are told."""
    scene = load(name)
    line = re.search(r'(?m)^frame\s*=\s*"(.*)"', scene.text)
    alone = [p for p in scene.links.get(FRAME, ()) if len(scene.links_of[p]) == 2]
    if line is None or scene.loads or scene.slides:
        return
    for pivot in alone:
        rest = " ".join(p for p in line[1].split() if p != pivot)
        if rest:
            lines = told(scene.text.replace(line[0], f'frame = "{rest}"'))
            assert re.search(rf"\b{pivot}\b.* on no other link", lines[0]), lines


@pytest.mark.parametrize("left_out", ["C", "O", "OC"])
def test_names_come_in_one_order(left_out: str) -> None:
    """However links and points are written, what is told names them in the same order."""
    loose = {"links": {**SIX_BAR["links"], "10": "E H", "9": "H I"},
             "points": {**SIX_BAR["points"], "H": (300, 300), "I": (310, 380)}}
    chance = random.Random(5)
    for linkage in (FOUR_BAR, loose):
        found = {tuple(re.sub(r'frame = "[^"]*"', "frame", line) for line in told(text(linkage, *left_out,
                 shuffled=chance))) for _ in range(12)}
        assert len(found) == 1, found
