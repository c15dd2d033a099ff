"""A design: which drawing of a scene is made, as far as the scene and the textbook leave that open.

It is chosen once, in the room `design`; what draws, tells, moves and judges reads it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Number, Scene
from graphplan.mechanism.sections import (
    FORCE_ORDERS,
    FORCE_PLANS,
    INERTIA,
    METHOD_PAIRS,
    METHODS,
    MOTION_PLANS,
    OF_PATHS,
    PLAN_STYLES,
)
from graphplan.methods.motion.time_scale import Tempo
from graphplan.methods.panels import ACCELERATION_PLAN, N_PLAN

TEXTBOOK = FORCE_ORDERS[0], 0  # what comes first of unknown forces, and where a trial begins


@dataclass(frozen=True)
class Design:
    """Which drawing is made; what is empty, or None, is open.

    `plan` names the plans of the motion (orthogonal, polar or triangles) and of the forces (lever, polygons or both);
    `method` the form of loci, rings or paths, where one is named, such as auxiliary, or those of velocities and of
    accelerations, such as auxiliary,trial; `form` is that of compounds on all plans by its own name. `ways`
    says which of several ways on is taken at each ring of links; `group_way` how groups of unknown forces are drawn:
    what comes first, and where a trial begins; with `all_by_lever` levers find all reactions, as where no polygons can
    be drawn. `inertia` is the form of inertia forces, `strict` leaves out set squares. A drawn velocity is `kappa`
    times the true one (s), an acceleration kappa squared times, a force `phi` times (lengths per unit of force).
    """

    plan: str = ""
    method: str = ""
    form: str = ""
    ways: tuple[int, ...] = ()
    group_way: tuple[str, int] | None = None
    all_by_lever: bool = False
    inertia: str = ""
    strict: bool = False
    kappa: Fraction | None = None
    phi: Number | None = None

    @property
    def words(self) -> list[str]:
        """The words of its plans."""
        return self.plan.split(",") if self.plan else []

    @property
    def motion(self) -> str:
        """The plans of the motion; empty where they are open."""
        return next((word for word in self.words if word in MOTION_PLANS), "")

    @property
    def forces(self) -> str:
        """The plans of the forces."""
        words = {*FORCE_PLANS} & {*self.words}
        return words.pop() if len(words) == 1 else "both"

    @property
    def lever(self) -> bool:
        """Whether forces are found by Zhukovsky's lever."""
        return self.forces != "polygons"

    @property
    def polygons(self) -> bool:
        """Whether forces are found by polygons."""
        return self.forces != "lever"

    @property
    def methods(self) -> tuple[str, str]:
        """The methods of velocities and of accelerations."""
        velocities, _, accelerations = self.method.partition(",")
        return velocities, accelerations or velocities

    def form_on(self, panel: Panel) -> str:
        """The form of compounds on a plan; empty where it is open."""
        return self.form or METHODS.get(self.methods[panel.whole in (N_PLAN, ACCELERATION_PLAN)], "")

    @property
    def on_polar_plans(self) -> str:
        """The plans, with those of the motion polar."""
        return ",".join(("polar", *(word for word in self.words if word not in MOTION_PLANS)))

    @property
    def keys(self) -> dict[str, Any]:
        """The keys of [sheet] that say it; of scales those that are decimal fractions."""
        has_forces = not {*FORCE_PLANS}.isdisjoint(self.words)
        wishes = {"plan": self.plan, "method": self.method, "inertia": self.inertia if has_forces else "",
                  "strict": self.strict}
        return {key: value for key, value in wishes.items() if value} | self.chosen_keys

    @property
    def chosen_keys(self) -> dict[str, Any]:
        """The keys that are chosen by the cost of a design."""
        order, place = self.group_way or TEXTBOOK
        keys = {"ways": list(self.ways), "force_way": "" if (order, place) == TEXTBOOK else f"{order} {place}",
                "kappa": self.kappa, "phi": self.phi}
        return {key: value for key, value in keys.items() if value and (
            not isinstance(value, Fraction) or Fraction(repr(float(value))) == value)}

    @property
    def tempo(self) -> Tempo:
        """The scale of rates by its kappa."""
        return Tempo(1 / (self.kappa or Fraction(1)))


OPEN = Design()


def merged_plans(plan: str, others: str) -> str:
    """Plans, with those of `others` for the motion, or for the forces, where they name none."""
    words = plan.split(",") if plan else []
    of_same = {word for kind in (MOTION_PLANS, FORCE_PLANS) if {*kind} & {*words} for word in kind}
    return ",".join([*words, *(word for word in others.split(",") if word and word not in of_same)])


def complete_wishes(scene: Scene, wishes: Design) -> Design:
    """Complete the wishes for a drawing with the keys of the scene's sheet; fails with `Refused` if a plan, a method or
    a form of inertia is unknown."""
    sheet = scene.sheet
    plan, inertia = merged_plans(wishes.plan, sheet.plan), wishes.inertia or INERTIA[0]
    method = wishes.method or sheet.method
    for what, name, choices in (*(("plan", word, PLAN_STYLES) for word in Design(plan).words),
                                ("inertia", inertia, INERTIA)):
        if name not in choices:
            unknown = "unknown method of inertia" if what == "inertia" else "unknown plan"
            raise Refused(f"{what} {name}", unknown, f"choose one of {', '.join(choices)}")
    if method not in ("", *METHODS, *METHOD_PAIRS, *OF_PATHS):
        raise Refused(f"method {method}", "unknown method", f"choose one of {', '.join(METHODS | OF_PATHS)}")
    velocities, _, accelerations = method.partition(",")
    method = velocities if accelerations == velocities else method
    form = wishes.form or OF_PATHS.get(method, "")
    return replace(wishes, plan=plan, method=method, form=form, inertia=inertia,
                   ways=wishes.ways or sheet.ways, group_way=wishes.group_way or sheet.force_way,
                   kappa=wishes.kappa or sheet.kappa, phi=wishes.phi or sheet.phi)
