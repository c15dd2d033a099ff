"""A four-bar as the text of a scene, in the words that a test needs."""

from __future__ import annotations

FOUR_BAR = """{head}[points]
O = [0, 0]
A = {A}
B = {B}
C = {C}
[links]
1 = "O A"
2 = "A B"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
{drive}
{more}"""


def four_bar(drive: str = "omega = 2.0", *, head: str = "", A: str = "[30, 40]", B: str = "[130, 90]",
             C: str = "[150, 0]", more: str = "") -> str:
    """The four-bar O A B C, driven at the crank 1: what stands before it, where its joints are, what it is loaded by.
    """
    return FOUR_BAR.format(drive=drive, head=head, A=A, B=B, C=C, more=more)


SMALL = four_bar("omega = 2.0\nalpha = 3", A="[20, 10]", B="[70, 40]", C="[80, 0]")
