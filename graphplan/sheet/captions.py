"""What stands over each plan: what it is, and its scales."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from graphplan.mechanism.model import FRAME
from graphplan.sheet import pens
from graphplan.sheet.display import Rect, Text
from graphplan.sheet.lettering import SIZE, Runs, sentence_runs, wrap
from graphplan.sheet.planes import FRICTION, LEVER, MECHANISM, Planes
from graphplan.sheet.scales import Scales, times

HEAD, LINE = 3.0, 3.7  # mm: the size of a plan's name, from base line to base line
FORCE_PLAN = "force plan "
ORTHOGONAL, LOADS = "velocity", "load"  # the kinds of vector that the mechanism's caption speaks of


def captions(rect: Rect, panel: str, planes: Planes, scales: Scales) -> Iterator[Text]:
    """Over a plan what it is, and its scales."""
    kinds, multiple = planes.kinds(panel), scales.multiples.get(panel, Fraction(1))
    head = caption(panel, kinds) + (f", {times(multiple)}" if multiple != 1 else "")
    heads = wrap(sentence_runs(head), HEAD, rect.width - 5, bold=True)
    lines: list[Runs] = [*heads, *wrap(sentence_runs(",  ".join(scales.said(panel, kinds))), SIZE, rect.width - 5)]
    for i, runs in enumerate(lines[:3]):
        bold = i < len(heads)
        yield Text(pens.LETTERS, "text", None, (rect.left + 2.5, rect.top - 4.6 - LINE * i), runs,
                   HEAD if bold else SIZE, bold=bold)  # fmt: skip


def caption(panel: str, kinds: set[str]) -> str:
    """What a plan is; `kinds` are the kinds of vector drawn on it."""
    if panel == MECHANISM:
        borne = [name for kind, name in ((ORTHOGONAL, "orthogonal velocities"), (LOADS, "loads")) if kind in kinds]
        return "Mechanism plan" + (f" with {' and '.join(borne)}" if borne else "")
    if panel == "N-plan":
        return "N-plan: relative normal accelerations"
    if panel.startswith(FORCE_PLAN):
        links = listed(panel.removeprefix(FORCE_PLAN).removesuffix(FRICTION).split(", "))
        return f"Force plan{FRICTION if panel.endswith(FRICTION) else ''}: {links}"
    if panel == LEVER or panel.startswith(f"{LEVER} "):
        return "Zhukovsky's lever" + _served(panel.removeprefix(LEVER).strip())
    return panel[0].upper() + panel[1:]


def spoken(panel: str) -> str:
    """How a plan is spoken of among the steps."""
    if panel == MECHANISM:
        return "mechanism plan"
    if panel.startswith(FORCE_PLAN):
        return caption(panel, set()).replace(": ", " of ").replace("Force", "force")
    return panel


def _served(what: str) -> str:
    """Which lever of several: that of a balance, by number, or of a reaction, such as `2 at B, x`."""
    if " at " not in what:
        return f" {what}" if what else ""
    link, _, place = what.partition(" at ")
    point, _, axis = place.rpartition(", ")
    return f": the force on {'the frame' if link == FRAME else f'link {link}'} at {point}, along {axis}"


def listed(links: Sequence[str]) -> str:
    """Links by name: link 1; links 2 and 3; links 2, 3 and 5; links 4 to 9."""
    if len(links) == 1:
        return f"link {links[0]}"
    if len(links) > 2 and all(link.isdigit() for link in links):
        numbers = [int(link) for link in links]
        if numbers == list(range(numbers[0], numbers[0] + len(links))):
            return f"links {links[0]} to {links[-1]}"
    return f"links {', '.join(links[:-1])} and {links[-1]}"
