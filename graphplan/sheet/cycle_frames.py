"""A construction around its cycle, pose by pose on one sheet: the same steps, panels and scales, letters placed anew.

Only the windows slide over their plans, by as little as it takes to hold the mechanism and its vectors in other poses.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from graphplan.errors import ConstructionError
from graphplan.kernel.drawing import Values
from graphplan.kernel.kinds import POINT, Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Program, evaluate
from graphplan.mechanism.model import Pair, Scene, Slide
from graphplan.mechanism.order import with_values
from graphplan.methods.construction import Construction
from graphplan.methods.forces.loading import given_loads
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.frames.title import CONSTRUCTION
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import back_to_front, captions, sheet
from graphplan.sheet.layout.paper import MARGIN
from graphplan.sheet.lettering.labels import place_letters
from graphplan.sheet.lettering.letters import mechanism_wishes, wishes_inside
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import EDGE_SLACK_MM, Arrow, Item, Outline, Polyline, Rect, Sheet, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.plans import Plans, bounding_box, extend_box
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.plates.view import View, clip_item, interpolate
from graphplan.sheet.tolerances import MARK_TOL

Given = dict[Any, dict[str, float]]
Places = Mapping[str, Any]  # arrays: of points, of the directions of guides or of loads, in each pose


def construction_in_pose(construction: Construction, points: Mapping[str, complex], guides: Mapping[str, complex],
                         loads: Mapping[str, Any] | None = None) -> Construction | None:
    """The construction with its points, and the guides that ride on links, elsewhere, and other loads that change.

    None where the pose is singular, its drawing takes other forms than that of the given pose, or points lie apart on
    whose coincidence it relies.
    """
    if any(points[first] != points[second] for first, second in construction.relied):
        return None
    scene, phi = construction.scene, construction.phi
    given_drawn, given = (inputs_in_pose(steps, points, guides) | given_loads(steps, scene, phi, loads or {})
                          for steps in (construction.drawn, construction.program))
    try:
        values = construction.drawn_out.drawing.mark_values(given=given_drawn)
        truth = evaluate(construction.program, Floats(), given)
    except ConstructionError:
        return None
    if not _marks_agree(construction, values, truth):
        return None
    return construction.with_values(values, construction.read(Floats(), given),
                                    scene_in(construction.scene, points, guides, loads))


def _marks_agree(construction: Construction, values: Values, truth: Sequence[Any]) -> bool:
    """Whether the drawn steps give the points that the rules do."""
    pairs_of_steps = zip(construction.drawn.wanted, construction.program.wanted, strict=True)
    pairs = [(values[i], truth[j]) for i, j in pairs_of_steps if construction.drawn.steps[i].op.gives == POINT]
    scale = max((math.hypot(*true) for _, true in pairs), default=0.0)
    return all(math.dist(*pair) <= MARK_TOL * scale for pair in pairs)


def inputs_in_pose(program: Program, points: Mapping[str, complex], guides: Mapping[str, complex]) -> Given:
    """What is given to the steps of a program in a pose."""
    marked = {step.name for step in program.steps[: program.givens]}
    inputs: Given = {name: {"x": z.real, "y": z.imag} for name, z in points.items() if name in marked}
    for step in program.steps:
        name = " along ".join(step.links)
        if step.op.movement is Movement.GUIDED and name in guides:
            inputs[step.index] = {"dx": guides[name].real, "dy": guides[name].imag}
    return inputs


def scene_in(scene: Scene, points: Mapping[str, complex], guides: Mapping[str, complex],
             loads: Mapping[str, Any] | None = None) -> Scene:
    """The scene in another pose, and with other loads that change, by their letters."""

    def direction(slide: Any) -> Pair:
        z: complex | None = None
        if isinstance(slide, Slide) and slide.through:
            z = points[slide.through[1]] - points[slide.through[0]]
        elif isinstance(slide, Slide):
            z = guides.get(slide.name)
        return slide.direction if z is None else (z.real, z.imag)

    if scene.loads and loads:
        vectors = {name: (z.real, z.imag) if isinstance(z, complex) else z for name, z in loads.items()}
        scene = replace(scene, loads=with_values(scene.loads, vectors))
    return scene.with_pose({name: (points[name].real, points[name].imag) for name in scene.points}, direction)


def sheets(composition: Composition, ways: Sequence[tuple[Construction, Places]], points: Places,
           guides: Places, loads: Places | None = None) -> Iterator[tuple[Sheet, bool]]:
    """The plans of each pose as a sheet, and whether the construction is on them: else the mechanism alone.

    Reads a composed construction; constructions of its scene, each with where the points are in the poses in which it
    is sound, of which the first that can be drawn in a pose is; where points and guides are, and the loads that change,
    in every pose.
    """
    count = len(next(iter(points.values())))
    poses = [next(filter(None, (_drawing_at(drawing, composition, places, guides, loads or {}, k)
                                for drawing, places in ways)), None) for k in range(count)]
    rows = replace(composition.arrangement, rows=())
    links = [bounding_box([(z.real, z.imag) for z in spots.values()]) for k in range(count)
             if all(map(cmath.isfinite, (spots := _pose_at(k, points)[0]).values()))]
    wide = _enlarge_mechanism_panel(replace(composition, arrangement=rows),
                                    bounding_box([spot for box in links for spot in box.corners]))
    base = _slide_windows(wide, links, [Plans(drawing) for drawing in poses if drawing])
    for k, drawing in enumerate(poses):
        if drawing:
            composition_there = replace(base, plans=replace(base.plans, drawing=drawing))
            yield _sheet(composition_there, [*_clipped_items(composition_there)]), True
        else:
            yield _sheet(base, _mechanism_alone(base, *_pose_at(k, points, guides))), False


def _sheet(composition: Composition, items: Iterable[Item]) -> Sheet:
    """The plans with these items, without frame, title block and words."""
    panels = composition.arrangement.panels
    outlines = (Outline(pens.BORDER, "paper", None, rect.corners, panel) for panel, rect in panels.items())
    whole = sheet(composition, (), CONSTRUCTION)
    return replace(whole, items=tuple(back_to_front([*outlines, *captions(composition), *items])))


def _drawing_at(drawing: Construction, composition: Composition, points: Places, guides: Places, loads: Places,
                k: int) -> Construction | None:
    """A construction in the pose at a place of these arrays, where it can be drawn on these plans."""
    places, directions, acting = _pose_at(k, points, guides, loads)
    finite = all(map(cmath.isfinite, places.values()))
    posed = construction_in_pose(drawing, places, directions, acting) if finite else None
    return posed if posed and composition.views.keys() >= {*Plans(posed).panels} else None


def _pose_at(k: int, *arrays: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The pose at a place of arrays."""
    return [{name: z[k].item() for name, z in array_of.items()} for array_of in arrays]


def _enlarge_mechanism_panel(composition: Composition, links: Rect) -> Composition:
    """The composition with so large a panel for the mechanism that its links have room in all poses; the panels on its
    right and below it make way."""
    window, panels = composition.views[MECHANISM], composition.arrangement.panels
    needed, panel_rect = links.times(window.scale), panels[MECHANISM]
    wider = max(0.0, needed.width + 2 * MARGIN - window.rect.width)
    higher = max(0.0, needed.height + 2 * MARGIN - window.rect.height)

    def larger(rect: Rect) -> Rect:
        return replace(rect, right=rect.right + wider, bottom=rect.bottom - higher)

    views, rects = {str(MECHANISM): replace(window, rect=larger(window.rect))}, {str(MECHANISM): larger(panel_rect)}
    for panel in panels.keys() - {MECHANISM}:
        right = wider if panels[panel].left >= panel_rect.right - EDGE_SLACK_MM else 0.0
        down = higher if panels[panel].top <= panel_rect.bottom + EDGE_SLACK_MM else 0.0
        view = composition.views[panel]
        views[panel] = replace(view, rect=view.rect.inset(right, -down, -right, down),
                               origin=(view.origin[0] + right, view.origin[1] - down))
        rects[panel] = panels[panel].inset(right, -down, -right, down)
    return replace(composition, views={panel: views[panel] for panel in composition.views},
                   arrangement=replace(composition.arrangement, panels={panel: rects[panel] for panel in panels}))


def _slide_windows(composition: Composition, links: Sequence[Rect], poses: Sequence[Plans]) -> Composition:
    """The composition with its windows slid so that they hold the links and the vectors of as many poses as can be.

    What the given pose has on paper stays on it.
    """
    views = dict(composition.views)
    for plate in composition.plates:
        panel, window = plate.panel, plate.view
        boxes = sorted((plans.extent(panel).core for plans in poses), key=_extent)
        if panel == MECHANISM:
            boxes = [*sorted(links, key=_extent), *boxes]
        visible = [window.to_plan(spot) for spot in _spots_to_keep(plate)]
        boxes = [bounding_box(visible), *boxes] if visible and boxes else boxes
        views[panel] = slide_window(window, _box_that_fits(boxes, window)) if boxes else window
    return replace(composition, views=views)


def _spots_to_keep(plate: Plate) -> Iterator[Spot]:
    """What of a plan must be on paper for its steps to be seen: its marks, and of lines the middle of what is drawn."""
    yield from (mark.spot for mark in plate.steps if plate.is_on_panel(mark))
    yield from (interpolate(*stretch.ends, 0.5) for stretch in plate.stretches.values())


def _extent(box: Rect) -> float:
    return box.width + box.height


def _box_that_fits(boxes: Sequence[Rect], window: View) -> Rect:
    """One box around as many boxes, the first ones first, as find room in a window."""
    rect, whole = window.rect, boxes[0]
    for box in boxes[1:]:
        larger = extend_box(extend_box(whole, (box.left, box.bottom)), (box.right, box.top))
        if larger.width * window.scale <= rect.width and larger.height * window.scale <= rect.height:
            whole = larger
    return whole


def _clipped_items(composition: Composition) -> Iterator[Item]:
    """What is drawn on all plans; a vector that leaves its panel has no head."""
    for plate, picture in zip(composition.plates, composition.pictures.values(), strict=True):
        for item in picture.items:
            if isinstance(item, Arrow) and not (plate.view.rect.holds(item.start) and plate.view.rect.holds(item.end)):
                line = Polyline(item.pen, item.layer, item.step, (item.start, item.end))
                yield from clip_item(line, plate.view.rect)
            else:
                yield item


def _mechanism_alone(composition: Composition, points: Mapping[str, complex],
                     guides: Mapping[str, complex]) -> list[Item]:
    """A pose in which nothing can be constructed: the mechanism alone."""
    window, motion = composition.views[MECHANISM], composition.plans.motion
    scene = scene_in(composition.plans.drawing.scene, points, guides)
    mechanism = DrawnMechanism(scene, window)
    uncut = [*(motion.items(window, scene) if motion else ()), *mechanism.items()]
    items = [cut for item in uncut for cut in clip_item(item, window.rect)]
    letters = place_letters([*wishes_inside(mechanism_wishes(mechanism), window.rect)], items,
                            [*mechanism.visible_points.values()], window.rect,
                            composition.arrangement.letters)
    return [*items, *letters]


def slide_window(view: View, box: Rect) -> View:
    """The window slid over its plan by the least that brings a box into it, with room for letters as far as there is.
    """
    rect, low, high = view.rect, view((box.left, box.bottom)), view((box.right, box.top))
    dx, dy = _shift(low[0], high[0], rect.left, rect.right), _shift(low[1], high[1], rect.bottom, rect.top)
    return replace(view, origin=(view.origin[0] + dx, view.origin[1] + dy))


def _shift(low: float, high: float, least: float, most: float) -> float:
    """The least way that takes one stretch into another, off its ends; to its middle where it is tight."""
    margin = min(MARGIN, (most - least - (high - low)) / 2)
    return max(least + margin - low, 0.0) + min(most - margin - high, 0.0)
