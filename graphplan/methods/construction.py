"""The construction of a scene: the recorded program, what is read from it, and its drawn form."""

from __future__ import annotations

from dataclasses import dataclass

VELOCITY, ACCELERATION = "velocity", "acceleration"


@dataclass(frozen=True)
class Arrow:
    """A vector on the sheet: from one mark to another of the drawn program (indices), on a panel.

    `kind` is velocity, acceleration, normal or relative; `point` is the point of the mechanism it belongs to; `label`
    is the letter that stands at it (such as `v_c` or `j_c`), possibly empty.
    """

    kind: str
    point: str
    label: str
    panel: str
    start: int
    end: int
