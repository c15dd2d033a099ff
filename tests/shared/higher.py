"""Scenes with gears and contacts: the shortest ones of each kind."""

from __future__ import annotations

import graphplan as gp

ARM_DRIVE = "[[drive]]\nlink = '3'\nomega = -1.5\nalpha = 1\n"
DRIVE = "[[drive]]\nlink = '{}'\nomega = 2\nalpha = 3\n"


def gear(links: str, centres: str, sizes: str) -> str:
    """A pair of gears."""
    return f"[[gears]]\nlinks = {links.split()}\ncentres = {centres.split()}\n{sizes}\n"


def contact(links: str, at: str, centres: str, more: str = "") -> str:
    """A contact."""
    return f"[[contacts]]\nlinks = {links.split()}\nat = '{at}'\ncentres = {centres}\n{more}\n"


def slide(link: str, at: str, direction: str) -> str:
    """A link that slides along the frame."""
    return f"[[slides]]\nlink = '{link}'\nalong = 'frame'\nat = '{at}'\ndirection = {direction}\n"


POINTS = {"O": (0, 0), "B": (30, 40), "M": (75, 20), "C": (90, 120), "A": (-7, 24), "S": (40, 9), "K": (12, 16)}
ARM = {"2": "B M", "3": "O B", "frame": "O"}
"""A planet about B, on an arm about O."""


def text(links: dict[str, str], *pairs: str) -> str:
    """A scene with the points that its links and pairs speak of."""
    names = "".join(f"'{link}' = '{points}'\n" for link, points in links.items())
    said = names + "".join(pairs)
    places = "".join(f"{name} = {[*at]}\n" for name, at in POINTS.items() if f"{name}'" in said or f"{name} " in said)
    return f"[points]\n{places}[links]\n{names}{''.join(pairs)}"


def two_wheels(sizes: str, moment: object, centre: str = "[60, 80]") -> str:
    """Wheels 1 and 2 on a frame: a moment loads the second, the first is driven, and balances it."""
    return (f"[points]\nO = [0, 0]\nC = {centre}\n[links]\n1 = 'O'\n2 = 'C'\nframe = 'O C'\n"
            f"{gear('1 2', 'O C', sizes)}[[moments]]\non = '2'\nvalue = {moment}\n"
            "[[drive]]\nlink = '1'\nomega = 5\n[balance]\nlink = '1'\n")


TEXTS = {
    "planet": text({"1": "O", **ARM}, gear("1 2", "O B", "teeth = [30, 20]"), ARM_DRIVE, DRIVE.format("1")),
    "sun that stands still": text(ARM, gear("2 frame", "B O", "radii = [20, 30]"), DRIVE.format("3")),
    "ring": text({"1": "O", **ARM}, gear("1 2", "O B", "radii = [30, 20]"),
                 gear("2 frame", "B O", "radii = [20, 70]\ninternal = true"), DRIVE.format("1")),
    "belt": text({"1": "O", **ARM}, gear("1 2", "O B", "radii = [7, 20]\nbelt = 'open'"), ARM_DRIVE,
                 DRIVE.format("1")),
    "crossed belt": text({"1": "O", **ARM}, gear("1 2", "O B", "radii = [7, 20]\nbelt = 'crossed'"), ARM_DRIVE,
                         DRIVE.format("1")),
    "rack": text({"2": "B M", "3": "S", "4": "B", "frame": "O"}, slide("3", "S", "[4, 3]"), slide("4", "B", "[4, 3]"),
                 "[[gears]]\nlinks = ['2', '3']\ncentres = ['B']\nradius = 43\ndirection = [4, 3]\n",
                 DRIVE.format("2"), "[[drive]]\nslide = ['3', 'frame']\nspeed = 20\nacceleration = 5\n"),
    "cam": text({"1": "A B", "2": "C M", "frame": "A M"}, contact("1 2", "K", '["B", "C"]'), DRIVE.format("1")),
    "flat follower": text({"1": "A B", "2": "M", "frame": "A"}, slide("2", "M", "[3, 4]"),
                          contact("2 1", "K", '[[4, -3], "B"]'), DRIVE.format("1")),
    "turning flat follower": text({"1": "A B", "2": "K M", "frame": "A M"}, contact("1 2", "K", '["B", [4, -3]]'),
                                  DRIVE.format("1")),
    "wheel on a wheel": text({"2": "B M", "frame": "O"}, contact("2 frame", "K", '["B", "O"]', "rolling = true"),
                             DRIVE.format("2")),
    "wheel in a ring": text({"2": "B M", "frame": "C"}, contact("2 frame", "K", '["B", "C"]', "rolling = true"),
                            DRIVE.format("2")),
    "wheel on a rail": text({"2": "B M", "frame": "O"}, contact("frame 2", "K", '[[-4, 3], "B"]', "rolling = true"),
                            DRIVE.format("2")),
    "rail on a wheel": text({"2": "O M", "frame": "B"}, contact("2 frame", "K", '[[-4, 3], "B"]', "rolling = true"),
                            DRIVE.format("2")),
}


ARC_CAM = """[points]
O = [0, 0]
C = { from = "O", distance = 30, angle = 28.64788975654116 }
A = { distances = { C = 45 }, on = { through = [10, 0], direction = [0, 1] }, pick = "right" }
D = { on = "A C", distance = 30 }
K = { on = "A C", distance = 10 }
[links]
1 = "O C D"
2 = "A"
frame = "O"
[[drive]]
link = "1"
omega = 10
""" + contact("1 2", "K", '["C", "A"]', 'next = ["D", "A"]') + slide("2", "A", "[0, 1]")
"""Ozols 1974, fig. 5-33: at K the arc about C is followed by one about D."""


def scenes() -> dict[str, gp.Scene]:
    """The scenes by their names."""
    return {name: gp.parse(text, name) for name, text in TEXTS.items()}
