"""The idea of each plan: what is drawn on it and how, in a sentence or two that stand over its stages."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphplan.kernel.program import Panel
from graphplan.mechanism.order import turning_drives
from graphplan.methods.panels import ACCELERATION_PLAN, N_PLAN, VELOCITY_PLAN, ForcePlan, LeverPlan, TrianglePlan
from graphplan.phrases import Said, digits, join, phrase, said
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.tolerances import LENGTH_TOL

TURNED = said("velocities are drawn from their points, turned by 90°: the ends of a link's points form its image, with "
              "parallel sides")
TRIANGLES = said("each velocity is drawn from its point, its parts head to tail")
IDEAS = {
    N_PLAN: said("the vector from b to a is the normal acceleration of A about B; from its own mark the acceleration "
                 "of each point is laid off"),
    VELOCITY_PLAN: said("all velocities are laid off from the pole; the ends of a link's points form its image, turned "
                        "by 90°"),
    ACCELERATION_PLAN: said("all accelerations are laid off from the pole, their parts head to tail"),
}
FORCES = said("forces are laid off head to tail; in equilibrium they close")
LEVER = said("a lever that turns about the pole: forces at the ends of their points balance, as their powers do")
ENLARGED = phrase("the {0} is drawn {1} times as large, for clearness")
REDUCED = phrase("the {0} is drawn {1} times as large, to fit the paper")
BESIDE_ANOTHER = phrase("the {0} is drawn {1} times as large as the {2}")
FIRST_END = phrase("{0} ends in {1}: k_v = omega_{2} · k_s")
FIRST_ENDS = phrase("{0} end in {1}: k_v = omega_{2} · k_s")


def plan_idea(plans: Plans, plan: Panel) -> Iterator[Said]:
    """What a plan is for; of orthogonal velocities also where those of the drive end."""
    match plan.whole:
        case ForcePlan():
            yield FORCES
        case LeverPlan():
            yield LEVER
        case TrianglePlan():
            yield TRIANGLES
        case whole if whole in IDEAS:
            yield IDEAS[whole]
        case whole if plans.drawing.turned and "velocity" in plans.kinds(whole):
            yield TURNED
            yield from _first_ends(plans)


def factor_reasons(scales: Scales, pairs: Iterable[tuple[Panel, Panel]]) -> tuple[Said, ...]:
    """Return why the second plan of each pair is drawn larger or smaller than the first, where it is."""
    reasons = list[Said]()
    for other, plan in pairs:
        times = scales.lengths_per_mm(other) / scales.lengths_per_mm(plan)
        if abs(times - 1) > LENGTH_TOL:
            words = BESIDE_ANOTHER if other in scales.multiples else ENLARGED if times > 1 else REDUCED
            reasons.append(words(plan.words, digits(times), other.words))
    return tuple(reasons)


def _first_ends(plans: Plans) -> Iterator[Said]:
    """The velocities that end in a point of the pose, as a crank's do in its pivot, and the scale that makes them."""
    drawing = plans.drawing
    links = [drive.link for drive in turning_drives(drawing.scene) if abs(drive.rate) == drawing.tempo.unit]
    vectors_of = dict[str, list[str]]()
    for vector, end in drawing.ends_in_pose if links else ():
        vectors_of.setdefault(end, []).append(vector)
    for end, vectors in vectors_of.items():
        yield (FIRST_ENDS if len(vectors) > 1 else FIRST_END)(join(vectors), end, links[0])
