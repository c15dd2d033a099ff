"""The stages of forces: the equilibrium of free bodies, joint by joint, levers, friction.

What is told of moves is worked out when it is asked for: `forms` are those of their compounds, which say nothing here.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import replace
from functools import partial

from graphplan.kernel.stages import Equation, Knowledge, Stage, Teller, Vector
from graphplan.mechanism.model import Gear, Slide
from graphplan.mechanism.replaced import StandIn
from graphplan.methods.motion.moves import FalsePosition
from graphplan.methods.motion.stages import LAWS
from graphplan.methods.panels import LeverPlan, link_named, list_links, pair_text, slide_named
from graphplan.phrases import Said, arrange, join, said

CHAIN = said("the known forces on a link are laid off one after the other, each from the head of the last")
DIRECTED = said("the line on which the force acts is given by its point and direction")
MOMENTS = said("the moments of all forces on a body in equilibrium balance, about any point")
CLOSED = said("the forces on a body in equilibrium close their polygon")
ACROSS = said("the parts of all forces in any one direction balance: across the unknown forces the others do")
JOINT = said("the forces on the links of a joint balance")
INERTIA = said("the inertia force is against the acceleration of the mass centre, the inertia couple against the "
               "angular acceleration")
JOURNAL = said("the force of a journal touches its friction circle, on the side that is against the turning")
GUIDE = said("the force of a slide leans from the normal of the guide by the friction angle, against the sliding")
TEETH = said("a tooth force that loses power crosses the line of centres beside the pitch point, on the side that is "
             "against the turning of the wheels on each other")
ROLLING = said("the normal force of a contact that rolls lies beside the point of contact by the arm of the resistance "
               "to rolling, on the side that is against the turning")
COUPLE = said("a couple is a pair of equal and opposite forces, with any arm")
PRESSURE = said("each wheel pushes its mate away: the tooth force leans from the circumferential one by the pressure "
                "angle, and the bearings at both centres bear its radial component")
EDGES = said("both edges press on opposite sides of the guide, and their forces lean by the friction angle: their "
             "lines meet in a point through which their resultant passes")
SCREW = said("the developed thread is an inclined plane: the force leans from its normal by the friction angle, "
             "against the sliding, and its part around the axis acts at the mean radius")
STRANDS = said("the pull of the belt is that of its two strands, which meet in the pole; where it is about to slip, "
               "their tensions are as S_1/S_2 = e^(mu alpha)")
SEAT = said("a force and a couple are one force, shifted by the couple over the force")
POWERS = said("moments about the pole balance, since powers do")


def in_round(number: int, stage: Teller) -> Teller:
    """Return the stage as it is told in a round of friction."""
    return partial(_with_title, said("round {0}", number) if number > 1 else said("with friction"), stage)


def in_trial(number: int, retell: Callable[[Teller], Teller] | None, stage: Teller) -> Teller:
    """Return the stage as it is told in a trial, which may be one of a round of friction."""
    trial = partial(_with_title, said("trial {0}", number), stage)
    return retell(trial) if retell else trial


def _with_title(which: Said, teller: Teller, forms: Collection[str]) -> Stage:
    stage = teller(forms)
    return stage if which in stage.title else replace(stage, title=arrange("{1}, {0}", which, stage.title))


def known_forces(link: str) -> Stage:
    """The known forces on a link."""
    return Stage(said("Known forces on {0}", link_named(link)), CHAIN)


def line_of_action(letter: str) -> Stage:
    """The line of a force of known direction."""
    return Stage(said("Line of action of {0}", letter), DIRECTED)


def moments(letter: str, links: Sequence[str], about: str, forces: Iterable[Vector], couples: Iterable[str],
            forms: Collection[str] = ()) -> Stage:
    """A force from moments of some links about a point, those of forces and of couples."""
    title = arrange("{0}: {1}", letter, said("moments of {0} about {1}", list_links(links), about))
    return Stage(title, MOMENTS, (Equation.moments(forces, "Q" if isinstance(about, Said) else about, couples),))


def component_stage(letter: str, links: Sequence[str], forms: Collection[str] = ()) -> Stage:
    """A force from the equilibrium of some links in one direction."""
    return Stage(_equilibrium(letter, links), ACROSS)


def polygon_stage(letter: str, links: Sequence[str], forces: tuple[Vector, ...], forms: Collection[str] = ()) -> Stage:
    """Forces that close the polygon of some links."""
    return Stage(_equilibrium(letter, links), CLOSED, (Equation.zero_sum(forces),))


def _equilibrium(letter: str, links: Sequence[str]) -> Said:
    return said("{0}: equilibrium of {1}", letter, list_links(links))


def joint(point: str, forces: tuple[Vector, ...] = ()) -> Stage:
    """The last force of a joint from those of its other links."""
    return Stage(said("Forces at the joint {0}", point), JOINT, (Equation.zero_sum(forces),) if forces else ())


def false_position(letter: str) -> Stage:
    """A force that is assumed, twice."""
    return Stage(arrange("{0:capital}", said("false position of {0}", letter)), LAWS[FalsePosition])


def inertia(link: str) -> Stage:
    """Stage of a link's inertia force: its line of action."""
    return Stage(said("Inertia force of {0}", link_named(link)), INERTIA)


def arm() -> Stage:
    """A point beside another, where couples need an arm."""
    return Stage(arrange("{0:capital}", said("an arm for couples")), COUPLE)


def journal(why: Said) -> Stage:
    """Stage of a journal with friction: the line of its force."""
    return Stage(arrange("{0:capital}", why), JOURNAL)


def guide(why: Said) -> Stage:
    """Stage of a slide with friction: the inclination of its force."""
    return Stage(arrange("{0:capital}", why), GUIDE)


def teeth(why: Said) -> Stage:
    """Stage of a gear with losses: the crossing of its tooth force with the line of centres."""
    return Stage(arrange("{0:capital}", why), TEETH)


def rolling(why: Said) -> Stage:
    """Stage of a rolling contact: the line of its force."""
    return Stage(arrange("{0:capital}", why), ROLLING)


def edges(slide: Slide) -> Stage:
    """Stage of a slide that is pressed at both edges: a point of its reaction."""
    return Stage(said("Edges of the slide {0}", slide_named(slide)), EDGES)


def screw(slide: Slide) -> Stage:
    """The moment on a screw."""
    return Stage(said("Screw of the slide {0}", slide_named(slide)), SCREW)


def strands(gear: Gear) -> Stage:
    """Stage of a belt: the pull of each strand."""
    return Stage(said("Tensions of the belt: {0}", pair_text(gear.links)), STRANDS)


def pressure(guide: Slide) -> Stage:
    """The tooth force from its circumferential part, or the pull of a belt."""
    if isinstance(guide, StandIn) and guide.given_pair.grip:
        return strands(guide.given_pair)
    return Stage(said("Tooth force at {0}, of {1} and {2}", guide.at, *map(link_named, guide.links)), PRESSURE)


def seat(slide: Slide) -> Stage:
    """Stage of a slide: the line of its reaction."""
    return Stage(said("Line of action of the reaction of the slide {0}", slide_named(slide)), SEAT)


def lever(panel: LeverPlan, letter: str, loads: Iterable[str], forms: Collection[str] = ()) -> Stage:
    """A lever, which tells one force from its loads."""
    forces = [*map(Vector, dict.fromkeys(loads)), Vector(letter, Knowledge.DIRECTION)]
    return Stage(join((panel.heading, letter), ": "), POWERS, (Equation.moments(forces, "o"),))
