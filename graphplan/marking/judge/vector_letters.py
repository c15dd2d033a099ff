"""What textbooks also call the ends of normal and Coriolis accelerations: by the link, as n_2, or by the points the
other way round, as n_AB; those of Coriolis by one of the two points, as k_A."""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.methods.construction import Construction

NORMAL_LETTER, CORIOLIS_LETTER = "n", "k"


def vector_letters(drawing: Construction) -> dict[str, int]:
    """The steps that make such ends, by every such name; of several of a link that which the others lead to, the last.
    """
    names = dict[str, int]()
    for step in drawing.drawn.steps:
        letter, _, of = step.name.partition("_")
        pair = next(_point_pairs(drawing, of), None) if letter in (NORMAL_LETTER, CORIOLIS_LETTER) else None
        if pair:
            points = pair if letter == CORIOLIS_LETTER else ()
            links = [name for name, link in drawing.scene.links.items()
                     if letter == NORMAL_LETTER and {*pair} <= {*link}]
            names |= {f"{letter}_{low}": step.index for low in ("".join(reversed(pair)), *points, *links)}
    return names


def _point_pairs(drawing: Construction, letters: str) -> Iterator[tuple[str, str]]:
    """The two points that some letters name one after the other."""
    points = drawing.scene.points
    return ((letters[:at], letters[at:]) for at in range(1, len(letters))
            if letters[:at] in points and letters[at:] in points)
