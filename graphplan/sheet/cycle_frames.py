"""A construction around its cycle, pose by pose on one sheet: the same steps, panels and scales, letters placed anew.

Only the windows slide over their plans, by as little as it takes to hold the mechanism and its vectors in other poses.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from graphplan.errors import ConstructionError
from graphplan.kernel.kinds import POINT, Movement
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Program, evaluate
from graphplan.mechanism.model import Pair, Scene, Slide
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.frames.title import CONSTRUCTION
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.divisions import MARGIN
from graphplan.sheet.layout.layout import captions, framed, layout, sheet
from graphplan.sheet.lettering.labels import placed
from graphplan.sheet.lettering.letters import inside, of_mechanism
from graphplan.sheet.plates import clip
from graphplan.sheet.plates.display import Rect, Sheet, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.plans import Plans, around, grown
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.plates.view import View

SAME = 1e-6  # of the largest mark: by more a drawn mark does not differ from what the rules say, unless its form fails
Given = dict[Any, dict[str, float]]
Places = Mapping[str, Sequence[complex]]  # of points, or the directions of guides, in each pose


class Posed(Construction):
    """A construction in another pose: its drawn steps with other values, as a sheet reads it."""

    def __init__(self, construction: Construction, scene: Scene, values: list[Any], given: Given):
        self.__dict__ |= {**construction.__getstate__(), "scene": scene, "_gathered": (construction.drawn, values),
                          "compounds": construction.compounds}
        self.given = given

    def read(self, domain: Domain, *_: Any) -> dict[str, dict[str, Any]]:
        """All readings in this pose."""
        return super().read(domain, self.given)


def posed(construction: Construction, points: Mapping[str, complex], guides: Mapping[str, complex]) -> Posed | None:
    """The construction with its points, and the guides that ride on links, elsewhere.

    None where the pose is singular, or its drawing takes other forms than that of the given pose.
    """
    drawn, program = (given_in(steps, points, guides) for steps in (construction.drawn, construction.program))
    try:
        values = evaluate(construction.drawn, Floats(), drawn)
        truth = evaluate(construction.program, Floats(), program)
    except ConstructionError:
        return None
    if not _alike(construction, values, truth):
        return None
    return Posed(construction, scene_in(construction.scene, points, guides), values, program)


def _alike(construction: Construction, values: Sequence[Any], truth: Sequence[Any]) -> bool:
    """Whether the drawn steps give the points that the rules do."""
    wanted = zip(construction.drawn.wanted, construction.program.wanted, strict=True)
    pairs = [(values[i], truth[j]) for i, j in wanted if construction.drawn.steps[i].op.gives == POINT]
    size = max((math.hypot(*true) for _, true in pairs), default=0.0)
    return all(math.dist(*pair) <= SAME * size for pair in pairs)


def given_in(program: Program, points: Mapping[str, complex], guides: Mapping[str, complex]) -> Given:
    """What is given to the steps of a program in a pose."""
    marked = {step.name for step in program.steps[: program.givens]}
    given: Given = {name: {"x": z.real, "y": z.imag} for name, z in points.items() if name in marked}
    for step in program.steps:
        name = " along ".join(step.links)
        if step.op.movement is Movement.GUIDED and name in guides:
            given[step.index] = {"dx": guides[name].real, "dy": guides[name].imag}
    return given


def scene_in(scene: Scene, points: Mapping[str, complex], guides: Mapping[str, complex]) -> Scene:
    """The scene in another pose."""

    def direction(slide: Any) -> Pair:
        z: complex | None = None
        if isinstance(slide, Slide) and slide.through:
            z = points[slide.through[1]] - points[slide.through[0]]
        elif isinstance(slide, Slide):
            z = guides.get(slide.name)
        return slide.direction if z is None else (z.real, z.imag)

    return scene.posed({name: (points[name].real, points[name].imag) for name in scene.points}, direction)


@dataclass(frozen=True)
class CycleFrame:
    """One pose of the round on paper: how far the drive has gone, in degrees, the sheet without its words, and where
    its marks lie."""

    travel: float
    plans: Plans
    sheet: Sheet
    spots: dict[int, Spot]


@dataclass(frozen=True)
class CycleFrames:
    """The poses of a cycle that are drawn alike, the given one first; `lost` are the stretches of travel, ends
    included, with those that are not."""

    drawing: Construction
    composition: Composition
    frames: tuple[CycleFrame, ...]
    lost: tuple[tuple[float, float], ...] = ()


def turning(drawing: Construction, composition: Composition, travel: Sequence[float],
            points: Places, guides: Places, others: Sequence[tuple[Construction, Places]] = ()) -> CycleFrames:
    """The construction in the poses of a turn, the first of which is the given pose.

    Reads a composed construction, the drive's travel in degrees, and where points and guides are; nan where nowhere.
    `others` are constructions of the scene that take other forms, with where points are in poses that they serve: of
    all that can be drawn in a pose on this sheet the first one is.
    """
    poses: dict[float, Posed] = {}
    lost: list[list[int]] = []
    for k in range(1, len(travel)):
        drawn = (_drawn(one, places, guides, k) for one, places in ((drawing, points), *others))
        if found := next((one for one in drawn if one and composition.views.keys() >= {*Plans(one).panels}), None):
            poses[travel[k]] = found
        elif lost and lost[-1][-1] == k - 1:
            lost[-1].append(k)
        else:
            lost.append([k])
    base = _roomy(composition, [Plans(found) for found in poses.values()])
    frames = (_frame(travel, replace(base, plans=replace(base.plans, drawing=found)))
              for travel, found in poses.items())
    ends = tuple((travel[part[0]], travel[part[-1]]) for part in lost)
    return CycleFrames(drawing, base, (_frame(0.0, base), *frames), ends)


def _drawn(drawing: Construction, points: Places, guides: Places, k: int) -> Posed | None:
    """A construction in the pose at a place of these arrays."""
    here, directions = ({name: complex(z[k]) for name, z in arrays.items()} for arrays in (points, guides))
    return posed(drawing, here, directions) if all(map(cmath.isfinite, here.values())) else None


def _roomy(composition: Composition, poses: Sequence[Plans]) -> Composition:
    """The composition with its windows slid so that they hold the mechanism and the vectors of as many poses as can be.

    What the given pose has on paper stays on it.
    """
    views = dict(composition.views)
    for plate in composition.plates:
        panel, window = plate.panel, plate.view
        boxes = sorted((plans.extent(panel).core for plans in poses), key=_extent)
        if panel == MECHANISM:
            links = (around([plans.place(name) for name in plans.drawing.scene.points]) for plans in poses)
            boxes = [*sorted(links, key=_extent), *boxes]
        kept = [window.back(spot) for spot in _shown(plate)]
        views[panel] = slid(window, _gathered([around(kept), *boxes] if kept else boxes, window)) if boxes else window
    return replace(composition, views=views)


def _shown(plate: Plate) -> Iterator[Spot]:
    """What of a plan must be on paper for its steps to be seen: its marks, and of lines the middle of what is drawn."""
    yield from (drawn.at for drawn in plate.steps if plate.shown(drawn))
    yield from (clip.between(*stretch.ends, 0.5) for stretch in plate.stretches.values())


def _extent(box: Rect) -> float:
    return box.width + box.height


def _gathered(boxes: Sequence[Rect], window: View) -> Rect:
    """One box around as many boxes, the first ones first, as find room in a window."""
    rect, whole = window.rect, boxes[0]
    for box in boxes[1:]:
        larger = grown(grown(whole, (box.left, box.bottom)), (box.right, box.top))
        if larger.width * window.scale <= rect.width and larger.height * window.scale <= rect.height:
            whole = larger
    return whole


def _frame(travel: float, composition: Composition) -> CycleFrame:
    """A composed construction on its sheet."""
    bare = replace(composition, arrangement=replace(composition.arrangement, rows=()))
    spots = {drawn.index: drawn.at for drawn in bare.plates.steps if drawn.kind == POINT}
    return CycleFrame(travel, bare.plans, layout(bare.plans.drawing, composition=bare), spots)


def undrawn(composition: Composition, points: Mapping[str, complex], guides: Mapping[str, complex]) -> Sheet:
    """The sheet of a pose in which nothing can be constructed: the mechanism alone."""
    bare = replace(composition, arrangement=replace(composition.arrangement, rows=()))
    window, motion = bare.views[MECHANISM], bare.plans.motion
    mechanism = DrawnMechanism(scene_in(bare.plans.drawing.scene, points, guides), window)
    shown = [*(motion.items(window) if motion else ()), *mechanism.items()]
    items = [cut for item in shown for cut in clip.clipped(item, window.rect)]
    letters = placed([*inside(of_mechanism(mechanism), window.rect)], items, [*mechanism.shown.values()], window.rect,
                     bare.arrangement.letters)
    return sheet(bare, [*framed(bare), *captions(bare), *items, *letters], CONSTRUCTION)


def slid(view: View, box: Rect) -> View:
    """The window slid over its plan by the least that brings a box into it, with room for letters as far as there is.
    """
    rect, low, high = view.rect, view((box.left, box.bottom)), view((box.right, box.top))
    dx, dy = _shift(low[0], high[0], rect.left, rect.right), _shift(low[1], high[1], rect.bottom, rect.top)
    return replace(view, origin=(view.origin[0] + dx, view.origin[1] + dy))


def _shift(low: float, high: float, least: float, most: float) -> float:
    """The least way that takes one stretch into another, off its ends; to its middle where it is tight."""
    margin = min(MARGIN, (most - least - (high - low)) / 2)
    return max(least + margin - low, 0.0) + min(most - margin - high, 0.0)
