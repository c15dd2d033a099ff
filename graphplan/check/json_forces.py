"""What `graphplan solve` prints of forces: those of the machine as it is, with the friction that the scene gives it.

What is asked for and not drawn is the solver's; what nobody can tell is null, with the reason.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from graphplan.check.json_numbers import number
from graphplan.check.report import Report
from graphplan.mechanism.model import Scene, Slide
from graphplan.methods import kinds
from graphplan.methods.panels import JointForce

if TYPE_CHECKING:
    from graphplan.check.forces import Forces

Reasons = dict[str, dict[str, str]]
INDETERMINATE = "statically indeterminate: more holds these links than their equilibrium can tell"


def forces(found: Report) -> dict[str, Any]:
    """Balances and reactions, and where something rubs those without friction; nothing where there are no loads."""
    if found.asked.loads is None:
        return {}
    smooth, indeterminate = _Printed(found, found.forces, False), _indeterminate(found.asked)
    if found.forces is None or not found.forces.rubs:
        return {**smooth.data, **indeterminate}
    rough = _Printed(found, found.forces, True)
    return {**rough.data, **indeterminate, "without_friction": smooth.data, **_friction(found, found.forces)}


def reasons(found: Report) -> Reasons:
    """Why balances and reactions are null, by their names."""
    if found.forces is None:
        return {}
    printed = _Printed(found, found.forces, found.forces.rubs)
    balances = dict(printed.missing_balances)
    reactions = dict(printed.missing_reactions)
    return {key: named for key, named in (("balance", balances), ("reactions", reactions)) if named}


def alone(found: Report) -> list[str]:
    """The forces that are the analytic solver's alone, as they are not drawn."""
    if found.forces is None:
        return []
    names = found.forces.alone
    return [f"analytic solver alone: {', '.join(names)}"] if names else []


@dataclass(frozen=True)
class _Printed:
    """The forces of a report with friction or without it."""

    found: Report
    forces: Forces | None
    rubs: bool

    @property
    def data(self) -> dict[str, Any]:
        """Balances, one alone as it is, and reactions."""
        told = [self.balance(name, self._value(f"balance {name}", "balance", name)) for name in self._balances]
        kept = {"balance": told[0] if len(told) == 1 else told} if told else {}
        return {**kept, "reactions": list(self._reactions())}

    @property
    def missing_balances(self) -> Iterator[tuple[str, str]]:
        """The balances that nobody tells, each with the reason."""
        locks = self.forces.locks if self.forces else ""
        return ((name, locks) for name in self._balances if locks and self._values.get(f"balance {name}") is None)

    @property
    def missing_reactions(self) -> Iterator[tuple[str, str]]:
        """The same of reactions."""
        why = (self.forces.locks if self.forces else "") or INDETERMINATE
        return ((name, why) for name, _ in self._asked if self._values.get(name) is None)

    @property
    def _balances(self) -> list[str]:
        """The names of the balances."""
        loads = self.found.asked.loads
        return [*loads.named_balances] if loads else []

    @cached_property
    def _values(self) -> Mapping[str, Any]:
        """The numbers, by the names of pairs and balances."""
        return self.forces.values(self.rubs) if self.forces else {}

    def _value(self, name: str, key: str = "reactions", of: str = "") -> Any:
        """A number; none where it is missing."""
        return None if (of or name) in self.found.missing.get(key, {}) else self._values.get(name)

    def balance(self, name: str, value: Any) -> dict[str, Any]:
        """A balance: a moment on a link, or a force at a point of it."""
        assert self.found.asked.loads is not None
        balance = self.found.asked.loads.named_balances[name]
        key = "force" if balance.at else "moment"
        return {key: number(value), "link": balance.link, **({"at": balance.at} if balance.at else {})}

    def _reactions(self) -> Iterator[dict[str, Any]]:
        for name, entry in self._asked:
            yield {**entry, "force": number(self._value(name)), **self._more(name)}

    @cached_property
    def _asked(self) -> list[tuple[str, dict[str, str]]]:
        """The reactions that are asked for: their names, and between which links they act."""
        scene, asked = self.found.asked, self.found.asked.find.reactions
        return [(name, entry) for pair, name, entry in _entries(scene) if asked is None or pair in asked]

    def _more(self, name: str) -> dict[str, Any]:
        """Of a slide's reaction its moment, and a point of its line where that lies near."""
        slide = next((slide for slide in self.found.asked.slides if slide.name == name), None)
        if slide is None:
            return {}
        moment = None if self._value(name) is None else self._value(f"moment {name}")
        return {"moment": number(moment), **self._acts_at(slide, self._value(name), moment)}

    def _acts_at(self, slide: Slide, force: Any, moment: Any) -> dict[str, Any]:
        """Where a slide's reaction crosses its guide."""
        arm = self.found.results.get(kinds.SLIDE_ARM, {}).get(slide.name)
        if arm is None or force is None or self.forces is None:
            return {}
        if self.rubs and self.forces.reactions is None:  # of symbols
            return {}
        if self.rubs:
            arm = self.forces.arm(slide, force, moment)
        x, y = self.found.scene.points[slide.at]
        return {"acts_at": number((x + arm[0], y + arm[1]))} if arm is not None else {}


def _entries(scene: Scene) -> Iterator[tuple[str, str, dict[str, str]]]:
    """Every reaction: the pair as it is asked for, the name of the force, and between which links it acts."""
    for joint in scene.revolutes:
        pin, *others = joint.links
        for link in others:
            yield joint.at, JointForce(joint.at, link).name, {"at": joint.at, "on": link, "from": pin}
    for slide in scene.slides:
        yield slide.name, slide.name, {"slide": slide.name, "on": slide.link, "from": slide.along}
    for sort, pairs in (("gear", scene.gears), ("contact", scene.contacts)):
        for pair in pairs:
            yield pair.name, pair.name, {sort: pair.name, "on": pair.links[0], "from": pair.links[1]}


def _indeterminate(scene: Scene) -> dict[str, Any]:
    """The pairs whose reactions are asked for, though equilibrium does not tell them."""
    asked = scene.find.reactions
    of_joint = {JointForce(point, link).name: point for point in scene.joints for link in scene.links_of[point]}
    names = [name for name in scene.indeterminate_pairs
             if asked is None or name in asked or of_joint.get(name) in asked]
    return {"indeterminate": names} if names else {}


def _friction(found: Report, forces: Forces) -> dict[str, Any]:
    """The efficiency with friction, in how many rounds it is drawn, and where further rounds stand."""
    if forces.locks:
        return {}
    told = {"efficiency": number(forces.efficiency), "rounds": forces.rounds}
    if not forces.bounded:
        printed, standing = _Printed(found, forces, True), forces.named(forces.standing.balances)
        balances = [printed.balance(name, value) for name, value in standing.items()]
        told["stands"] = {"balance": balances, "efficiency": number(forces.standing.efficiency)}
    return {"friction": told}
