"""Three small scenes that the tests read, and spoil."""

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


def changed(text: str, *changes: tuple[str, str]) -> str:
    """The text with each first string, which must be there, replaced by the second."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text
