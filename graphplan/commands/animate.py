"""The animation that `cycle` writes: its options, its bounds, and the construction in the poses of its loop."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from graphplan.commands.choices import count, on_paper
from graphplan.commands.output import Messages, kind, write
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.cycle.loop import Loop
    from graphplan.methods.construction import Construction
    from graphplan.output.animation import Film
    from graphplan.sheet.layout.composition import Composition

ENDINGS = (".gif", ".svg")
POSES, MOST_POSES = 48, 240
SECONDS, LONGEST = 6, 120
WIDTH, LEAST_WIDTH, MOST_WIDTH = 900, 200, 2400  # pixels
MOST = 2e8  # pixels of all pictures of a .gif, were they square: about as many bytes of memory


def options(add: Callable[..., Any]) -> None:
    add("--animate", metavar="FILE.gif", help="the construction in motion: .gif, or an animated .svg")
    add("--seconds", type=count("--seconds", 1, LONGEST), metavar="S",
        help=f"how long an animation takes until it begins again ({SECONDS})")
    add("--width", type=count("--width", LEAST_WIDTH, MOST_WIDTH), metavar="W",
        help=f"how many pixels wide an animation is ({WIDTH})")


def asked(options: argparse.Namespace) -> None:
    """Refuse what an animation cannot be, before any work is done."""
    ending = kind(options.animate, ENDINGS, "animation", "--animate")
    for name in ("seconds", "width"):
        if getattr(options, name) and not options.animate:
            raise Refused(f"--{name}", "there is no animation", "add --animate FILE.gif, or leave it out")
    if options.positions is None and (options.output or options.plot or not options.animate):
        raise Refused("--positions", "it is not said how many poses are wanted", "such as --positions 36")
    poses, width = options.positions or POSES, options.width or WIDTH
    if options.animate and poses > MOST_POSES:
        raise Refused(f"--positions {poses}", "no animation is so long", f"at most {MOST_POSES}")
    if ending == ".gif" and options.animate and poses * width**2 > MOST:
        raise Refused(f"--animate {options.animate}", f"{poses} pictures of {width} pixels in width are too many",
                      f"--width {int((MOST / poses) ** 0.5)}, fewer --positions, or an .svg")


def run(options: argparse.Namespace, span: tuple[float, float] | None) -> None:
    """Write the animation that is asked for."""
    from graphplan.cycle.loop import loop
    from graphplan.output.animation import gif, svg

    options.protocol = "none"  # there is no time to read it
    on_sheet, messages = on_paper(options), Messages(options.quiet)
    moved = loop(on_sheet.drawing.scene, options.positions or POSES, span)
    film = _film(on_sheet.drawing, on_sheet.composition, moved, options.seconds or SECONDS, messages)
    width = options.width or WIDTH
    written = (svg if kind(options.animate, ENDINGS, "animation") == ".svg" else gif)(film, width)
    write(written, options.animate)


def _film(drawing: Construction, composition: Composition, moved: Loop, seconds: int, messages: Messages) -> Film:
    """The sheets of a loop, in its order; where nothing can be drawn, which is told, the mechanism alone."""
    from graphplan.accuracy.reach import constructions
    from graphplan.check.poses import checked
    from graphplan.cycle.travel import told, travel_unit
    from graphplan.output.animation import Film
    from graphplan.phrases import arranged, digits, unit
    from graphplan.sheet.cycle_frames import turning, undrawn

    turn, guides = moved.turn, _from_given(moved.turn.guides)
    (_, points), *others = [(one, _from_given(checked(one, turn.points, turn.guides)))
                            for one in constructions(drawing)]
    found = turning(drawing, composition, [0.0, *turn.travel.tolist()], points, guides, others)
    sheets = {frame.travel: frame.sheet for frame in found.frames[1:]}
    travel = {k: float(turn.travel[k]) for k in moved.order if k not in turn.faults}
    if not travel:
        raise Refused("--animate", "no pose of the range is reached", "another range")
    if lost := [there for there in travel.values() if there not in sheets]:
        messages.remark(f"the mechanism alone at {', '.join(told(drawing.scene, there, 4) for there in lost)}")
    for k, there in travel.items():
        if there in lost:
            here, ways = ({name: complex(z[k]) for name, z in arrays.items()} for arrays in (turn.points, turn.guides))
            sheets[there] = undrawn(found.composition, here, ways)
    shown = [travel[k] for k in moved.order if k in travel]
    each, name = travel_unit(drawing.scene)
    pattern = "{0}°" if name == "degrees" else "{0} {1}"
    words = (arranged(pattern, digits(there / each), unit(name)) for there in shown)
    return Film([sheets[there] for there in shown], [composition.plans.tongue(told) for told in words], seconds)


def _from_given(arrays: Mapping[str, Any]) -> dict[str, Any]:
    """Places in some poses, after a first one that stands for the given pose."""
    return {name: [z[0], *z] for name, z in arrays.items()}
