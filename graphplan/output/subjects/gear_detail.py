"""The mesh of two wheels enlarged, where it is too small on the sheet for its letters: the line of action with the path
of contact, in free room of the figure.
"""

from __future__ import annotations

from collections.abc import Sequence

from graphplan.output.subjects.synthesis_figure import TOOTH, WHOLE, wheel_outlines
from graphplan.sheet.layout.free_room import FreeRoom
from graphplan.sheet.layout.scales import ratio
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import place_letters
from graphplan.sheet.lettering.lettering import LetterSizes, name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.view import View, clip_item, view
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.sketch import Synthesis
from graphplan.words.tongue import tongue

DETAIL, ACTION, PATH_OF_CONTACT = "details", Pen(0.25), Pen(0.6, pens.RED)
SMALL_MM, ENLARGEMENTS = 60.0, (5, 4, 3, 2)  # of a line of action that is enlarged; so many times, as there is room
MARGIN_MM, CAPTION_MM, DOT_MM = 14.0, 5.0, 0.5  # about the line of action; below the detail; of a mark


def mesh_detail(synthesis: Synthesis, figure: View, items: Sequence[Item], letters: LetterSizes) -> list[Item]:
    """The detail of a figure on which these items lie; none where the mesh is large enough, or there is no room."""
    box = bounding_box([*synthesis.results["line"].values()])
    if max(box.width, box.height) * figure.scale > SMALL_MM:
        return []
    room = FreeRoom(figure.rect, items)
    for scale in (times * figure.scale for times in ENLARGEMENTS):
        wide, high = (length * scale + 2 * MARGIN_MM for length in (box.width, box.height))
        if window := room.window(wide, high + CAPTION_MM, from_above=True):
            caption = tongue(synthesis.task.sheet.language)(ratio(1 / scale, synthesis.task.units.length))
            return [Text(pens.LETTERS, DETAIL, None, (window.left, window.bottom), name_runs(caption), letters.text),
                    *_mesh(synthesis, view(box, window.inset(0.0, CAPTION_MM, 0.0, 0.0), 1 / scale), letters)]
    return []


def _mesh(synthesis: Synthesis, detail: View, letters: LetterSizes) -> list[Item]:
    """Teeth, circles, the line of action, and on it the path of contact, with letters."""
    gears, line = GearPair(synthesis.task.request, synthesis.task.name), synthesis.results["line"]
    strokes: list[Item] = [Polyline(TOOTH, DETAIL, None, tuple(detail((z.real, z.imag)) for z in (*teeth, teeth[0])))
                           for teeth in wheel_outlines(gears)]
    for centre, wheel in zip((0.0, gears.centres), gears.wheels, strict=True):
        strokes += [Circle(WHOLE[f"{name} circle"], DETAIL, None, detail((centre, 0.0)),
                           getattr(wheel, name) * detail.scale) for name in ("pitch", "base", "tip")]
    strokes += [Polyline(pen, DETAIL, None, tuple(detail(line[end]) for end in ends))
                for pen, ends in ((ACTION, ("N1", "N2")), (PATH_OF_CONTACT, "AB"))]
    spots = {"_".join(name): detail(at) for name, at in line.items()}
    ink = [piece for stroke in strokes for piece in clip_item(stroke, detail.rect)]
    ink += [Circle(pens.DOT, DETAIL, None, at, DOT_MM) for at in spots.values()]
    names = [Wish(name_runs(name), (at,), DOT_MM + 0.3, layer=DETAIL) for name, at in spots.items()]
    corners = detail.rect.corners
    return [*ink, Polyline(pens.ARC, DETAIL, None, (*corners, corners[0])),
            *place_letters(names, ink, [*spots.values()], detail.rect, letters)]
