"""The pens: line widths and types after ISO 128-2, chosen to be told apart in black and white.

Widths go in the steps of the standard (0.18, 0.25, 0.35, 0.5, 0.7 mm): links are wide, vectors middling, everything
constructed is thin. Velocities have filled heads, accelerations open ones and forces white ones; loci have long
dashes, lines produced dots between them. Colours only help.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

INK, GREY, BLUE, RED, GREEN, TINT = "#000000", "#555555", "#0b3c8c", "#a3151b", "#1c6b3a", "#e9eef2"
BROWN, VIOLET = "#4a2c0a", "#6a1b8a"
ROSE, SKY = "#c4575c", "#4f74bd"  # of the parts of accelerations and velocities: lighter than their sums
PAPER = "#ffffff"
FILLED, OPEN, WHITE = "filled", "open", "white"  # heads of vectors: of velocities, accelerations and forces


@dataclass(frozen=True)
class Pen:
    """Appearance of a stroke: its width in mm, colour, dashes in mm, the fill of a closed figure, and the tip of a
    vector."""

    width: float
    colour: str = INK
    dash: tuple[float, ...] = ()
    fill: str = "none"
    tip: str = FILLED

    def with_fill(self, fill: str) -> Pen:
        """Return the pen with a filling."""
        return replace(self, fill=fill)


# paper
FRAME = Pen(0.7)
BORDER = Pen(0.25)
LETTERS = Pen(0.0, fill=INK)
FAINT = Pen(0.0, GREY, fill=GREY)

# the mechanism
LINK = Pen(0.7)
BAR, HOLLOW = Pen(2.0), Pen(1.3, TINT)  # a bar is drawn as two lines, so that vectors along it show
PLATE = Pen(0.0, fill=TINT)
PAIR = Pen(0.35, fill=PAPER)
BLOCK = Pen(0.5, fill=PAPER)
GROUND = Pen(0.5)
GROUND_FILL = Pen(0.35, fill=PAPER)
SOLID = Pen(0.0, fill=INK)
HATCH = Pen(0.18)
WHEEL = Pen(0.25, INK, (6.0, 0.9, 0.5, 0.9))  # of pitch circles, as ISO 128 has them
BALLOON = Pen(0.18, GREY, fill=PAPER)
DRIVE = Pen(0.35)
DIMENSION = Pen(0.18, fill=INK)  # of lengths and angles on the figure of a task
PATH = Pen(0.18, INK, (6.0, 0.9, 0.4, 0.9, 0.4, 0.9))  # of a moving point, as ISO 128 has what moves
FIXED_CENTRODE, MOVING_CENTRODE = Pen(0.25, BROWN), Pen(0.25, BROWN, (2.4, 1.0))
CIRCLING_POINTS, CENTRE_POINTS = Pen(0.25, VIOLET, (2.4, 1.0)), Pen(0.25, VIOLET)
PATH_END, PATH_DOT = Pen(0.35), Pen(0.0, fill=INK)
POSITION = Pen(0.13, "#9a9a9a")
MACHINE, BODY = Pen(0.18, "#8a8a8a"), Pen(0.0, fill="#f1f4f6")  # of the machine that a mechanism is of, and its bodies

# what is constructed
THIN = Pen(0.18, GREY)
PRODUCED = Pen(0.18, GREY, (4.0, 0.9, 0.5, 0.9))
NORMAL = Pen(0.35)
LOCUS = Pen(0.25, GREEN, (5.0, 1.0))
ARC = Pen(0.18, GREY)
SIDE = Pen(0.18, ROSE, (1.2, 0.8))  # of a figure on a polar plan that is similar to a link's
DOT = Pen(0.2, fill=PAPER)
ORIGIN = Pen(0.2, fill=INK)
LEADER = Pen(0.13, GREY)
RING = Pen(0.25, BROWN)  # about what is enlarged in a detail, and about that

ACCELERATION_PARTS = "normal", "tangential", "coriolis", "sliding"
VECTORS = {
    "velocity": Pen(0.5, BLUE, fill=BLUE),
    "acceleration": Pen(0.5, RED, fill=RED, tip=OPEN),
    **dict.fromkeys(ACCELERATION_PARTS, Pen(0.25, ROSE, fill=ROSE, tip=OPEN)),
    "relative": Pen(0.25, SKY, fill=SKY),
    "load": Pen(0.7, BROWN, fill=BROWN, tip=WHITE),
    "reaction": Pen(0.35, VIOLET, fill=VIOLET, tip=WHITE),
    "part": Pen(0.25, VIOLET, (2.0, 1.0), fill=VIOLET, tip=WHITE),
    "arm": Pen(0.25, GREEN, (2.0, 1.0)),
    "balance": Pen(1.0, GREEN, fill=GREEN, tip=WHITE),
}
FORCES = frozenset({"load", "reaction", "part", "balance"})  # the kinds of vector that are forces
GIVEN = {"velocity": Pen(0.35, BLUE, fill=BLUE), "acceleration": Pen(0.35, RED, fill=RED, tip=OPEN)}
HEADS = {
    "velocity": 4.0, "acceleration": 4.0, "relative": 2.4,
    **dict.fromkeys(ACCELERATION_PARTS, 2.4),
    "load": 5.0, "reaction": 4.0, "part": 2.4, "arm": 0.0, "balance": 6.5,
}  # fmt: skip


def pale(pen: Pen) -> Pen:
    """The pen for what was drawn before: the same strokes, half way to the paper."""
    return replace(pen, colour=_lighter(pen.colour), fill=_lighter(pen.fill))


def firm(pen: Pen, least: float) -> Pen:
    """The pen for what is new: no line thinner than this, and in ink where it is grey."""
    return replace(pen, colour=INK if pen.colour == GREY else pen.colour, width=max(pen.width, least))


def rgb(colour: str) -> tuple[int, int, int]:
    """Red, green and blue of a colour, 0..255."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def _lighter(colour: str) -> str:
    if not colour.startswith("#"):
        return colour
    return "#" + "".join(f"{255 - (255 - channel) // 2:02x}" for channel in rgb(colour))
