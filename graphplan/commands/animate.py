"""The animation that `cycle` writes: its options, its bounds, and the construction in the poses of its loop."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from graphplan.commands.choices import count, on_paper
from graphplan.commands.output import Messages, kind, write
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.cycle.turn import Loop
    from graphplan.methods.construction import Construction
    from graphplan.output.animation import Film
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet

ENDINGS = (".gif", ".svg")
POSES, MAX_POSES = 48, 240
SECONDS, LONGEST = 6, 120
WIDTH, LEAST_WIDTH, MOST_WIDTH = 900, 200, 2400  # pixels
MAX_PIXELS = 2e8  # pixels of all pictures of a .gif, were they square: about as many bytes of memory


def options(add: Callable[..., Any]) -> None:
    add("--animate", metavar="FILE.gif", help="the construction in motion: .gif, or an animated .svg")
    add("--seconds", type=count("--seconds", 1, LONGEST), metavar="S",
        help=f"how long an animation takes until it begins again ({SECONDS})")
    add("--width", type=count("--width", LEAST_WIDTH, MOST_WIDTH), metavar="W",
        help=f"how many pixels wide an animation is ({WIDTH})")


def check_options(options: argparse.Namespace) -> None:
    """Refuse what an animation cannot be, before any work is done."""
    ending = kind(options.animate, ENDINGS, "animation", "--animate")
    for name in ("seconds", "width"):
        if getattr(options, name) and not options.animate:
            raise Refused(f"--{name}", "only an animation uses it", "add --animate FILE.gif, or leave it out")
    if options.positions is None and (options.output or options.plot or not (options.animate or options.paths)):
        raise Refused("--positions", "the number of poses is missing", "such as --positions 36")
    poses, width = options.positions or POSES, options.width or WIDTH
    if options.animate and poses > MAX_POSES:
        raise Refused(f"--positions {poses}", "too many poses", f"at most {MAX_POSES}")
    if ending == ".gif" and options.animate and poses * width**2 > MAX_PIXELS:
        raise Refused(f"--animate {options.animate}", f"{poses} pictures of {width} pixels in width are too many",
                      f"--width {int((MAX_PIXELS / poses) ** 0.5)}, fewer --positions, or an .svg")


def run(options: argparse.Namespace, span: tuple[float, float] | None) -> None:
    """Write the animation that is asked for."""
    from graphplan.cycle.turn import loop
    from graphplan.output.animation import gif, svg

    options.protocol = "none"  # there is no time to read it
    on_sheet, messages = on_paper(options), Messages(options.quiet)
    motion = loop(on_sheet.drawing.scene, options.positions or POSES, span)
    film = _film(on_sheet.drawing, on_sheet.composition, motion, options.seconds or SECONDS, messages)
    width = options.width or WIDTH
    written = (svg if kind(options.animate, ENDINGS, "animation") == ".svg" else gif)(film, width)
    write(written, options.animate)


def _film(drawing: Construction, composition: Composition, moved: Loop, seconds: int, messages: Messages) -> Film:
    """The sheets of a loop, in its order; where nothing can be drawn, which is told, the mechanism alone."""
    from graphplan.accuracy.reach import constructions
    from graphplan.check.poses import points_where_sound
    from graphplan.mechanism.travel import travel_unit
    from graphplan.output.animation import Film
    from graphplan.phrases import arrange, digits, unit
    from graphplan.sheet.cycle_frames import sheets

    turn = moved.turn
    reached = [k for k in range(len(turn.travel)) if k not in turn.faults]
    if not reached:
        raise Refused("--animate", "no pose of the range is reached", "another range")
    points, guides, loads = ({name: z[reached] for name, z in arrays.items()}
                             for arrays in (turn.points, turn.guides, turn.loads))
    constructions_by_pose = [(construction, points_where_sound(construction, points, guides, loads))
                             for construction in constructions(drawing)]
    frames: dict[int, tuple[Sheet, bool]] = {}
    for k, frame in zip(reached, sheets(composition, constructions_by_pose, points, guides, loads), strict=True):
        frames[k] = frame
        messages.progress(f"drawn: {len(frames)} of {len(reached)}" if len(frames) < len(reached) else "")
    if bare := sum(not drawn for _, drawn in frames.values()):
        messages.remark(f"the mechanism alone, as nothing can be drawn there, in {bare} of {len(frames)} poses")
    poses, (each, name) = [k for k in moved.order if k in frames], travel_unit(drawing.scene)
    words = (arrange("{0}°" if name == "degrees" else "{0} {1}", digits(float(turn.travel[k]) / each), unit(name))
             for k in poses)
    return Film([frames[k][0] for k in poses], [composition.plans.tongue(caption) for caption in words], seconds)
