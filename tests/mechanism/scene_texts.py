"""Small scenes that the tests read, and spoil."""

from __future__ import annotations

PRESS = """
title = "Crank, coupler and block"

[points]
O = [0, 0]
A = [30, 40]
B = { distances = { A = 50 }, on = { through = "O", direction = [1, 0] }, pick = "right" }
M = { on = "A B", distance = 25 }

[links]
1 = "O A"
2 = "A M B"
3 = "B"
frame = "O"

[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]

[[drive]]
link = "1"
omega = 0.1
"""

OPEN = """
[points]
K = [0, 0]
A = [1, 0]
B = [2, 1]
L = [3, 0]
[links]
1 = "K A"
2 = "A B"
3 = "B L"
[motion.K]
velocity = [10, 5]
acceleration = [3, -8]
[motion.L]
velocity = [0, 1]
[[drive]]
link = "2"
alpha = 2
omega = -1
"""

ACTUATOR = """
[points]
O = [0, 0]
C = [30, 40]
D = [30, 40]
A = [60, 80]
E = [100, 0]
[links]
boom = "E A"
barrel = "O C"
rod = "D A"
frame = "O E"
[[slides]]
link = "rod"
along = "barrel"
at = "D"
direction = "O C"
[[drive]]
slide = ["rod", "barrel"]
speed = 0.5
"""


FIVE_BAR = """
[points]
O = [0, 0]
A = [-5, 90]
C = [100, 290]
B = [230, 70]
P = [190, 0]
[links]
1 = "O A"
2 = "A C"
3 = "C B"
4 = "P B"
frame = "O P"
[[drive]]
link = "1"
omega = 10
[[drive]]
link = "4"
omega = -10
[[forces]]
on = "3"
at = "C"
value = [0, -80]
"""
"""Two drives, a load, and no balance yet."""

LOADED = f"""gravity = [0, -9.81]
{PRESS}
[masses.2]
mass = 2.5
inertia = 0.01
centre = "M"

[masses.3]
mass = 4
centre = "B"

[[forces]]
on = "3"
at = "B"
value = [-150, 0.5]

[[moments]]
on = "2"
value = 0.3

[balance]
link = "1"

[[friction]]
at = "A"
radius = 5
coefficient = 0.1

[[friction]]
slide = ["3", "frame"]
coefficient = 0.08

[find]
velocity = ["B"]
reactions = ["A", "3 along frame"]
"""


def changed(text: str, *changes: tuple[str, str]) -> str:
    """The text with each first string, which must be there, replaced by the second."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text
