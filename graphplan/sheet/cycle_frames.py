"""A construction around its cycle, pose by pose on one sheet: the same steps, windows and scales; letters placed anew.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from graphplan.errors import ConstructionError
from graphplan.kernel.kinds import POINT, Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import Values
from graphplan.kernel.program import Program, evaluate
from graphplan.mechanism.model import Pair, Scene, Slide
from graphplan.mechanism.order import with_values
from graphplan.methods.construction import Construction
from graphplan.methods.forces.loading import given_loads
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import plans_sheet
from graphplan.sheet.lettering.letters import mechanism_wishes, place_letters, wishes_inside
from graphplan.sheet.plates.display import Arrow, Item, Polyline, Sheet
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.view import clip_item
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
    """Parameters of a program's steps in a pose."""
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
    for k, drawing in enumerate(poses):
        if drawing:
            composition_there = windows_in_pose(composition, replace(composition.plans, drawing=drawing))
            yield plans_sheet(composition_there, _clipped_items(composition_there)), True
        else:
            yield plans_sheet(composition, _mechanism_alone(composition, *_pose_at(k, points, guides))), False


def windows_in_pose(composition: Composition, plans: Plans) -> Composition:
    """The composition of these plans in another pose: the window of each but the mechanism's goes with its first mark.
    """
    views = dict(composition.views)
    for panel, view in composition.views.items():
        mark = next(iter([*composition.plans.ends(panel)] or composition.plans.points(panel)), None)
        other_mark = next(iter([*plans.ends(panel)] or plans.points(panel)), None)
        if panel != MECHANISM and mark is not None and other_mark is not None:
            (x, y), (u, v) = view(composition.plans.spot(mark)), view(plans.spot(other_mark))
            views[panel] = replace(view, origin=(view.origin[0] + x - u, view.origin[1] + y - v))
    return replace(composition, plans=plans, views=views)


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


def _clipped_items(composition: Composition) -> Iterator[Item]:
    """Yield the items of all plans; a vector that leaves its panel has no head."""
    for plate, picture in zip(composition.plates, composition.pictures.values(), strict=True):
        for item in picture.items:
            if isinstance(item, Arrow) and not (plate.view.rect.holds(item.start) and plate.view.rect.holds(item.end)):
                line = Polyline(item.pen, item.layer, item.step, (item.start, item.end))
                yield from clip_item(line, plate.view.rect)
            else:
                yield item


def _mechanism_alone(composition: Composition, points: Mapping[str, complex],
                     guides: Mapping[str, complex]) -> list[Item]:
    """Draw a pose without a construction: the mechanism alone."""
    window, motion = composition.views[MECHANISM], composition.plans.motion
    scene = scene_in(composition.plans.drawing.scene, points, guides)
    mechanism = DrawnMechanism(scene, window)
    uncut = [*(motion.items(window, scene) if motion else ()), *mechanism.items()]
    items = [cut for item in uncut for cut in clip_item(item, window.rect)]
    letters = place_letters([*wishes_inside(mechanism_wishes(mechanism), window.rect)], items,
                            [*mechanism.visible_points.values()], window.rect,
                            composition.arrangement.letters)
    return [*items, *letters]
