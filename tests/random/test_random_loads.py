"""Any loads on any linkage: forces are the solver's to the last digit, whatever the plan, the inertia and the order."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

import pytest
from linkages import linkage
from loads import loaded_scenes, rubbing

from graphplan.check.trusted import report
from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.methods.construct import construct
from graphplan.methods.forces.groups import pairs
from graphplan.methods.panels import INERTIA, JointForce
from graphplan.solver import Reactions, reactions, with_friction

LINKAGES = 12
TOGETHER = 6  # linkages to a test
STYLES = [(plan, inertia) for plan in ("", "lever", "polygons", "polar", "polar,lever", "polar,polygons")
          for inertia in INERTIA]


def truth(scene: Scene) -> Reactions | None:
    """The solver's forces, as fractions; None where the pose is singular."""
    try:
        return reactions(scene, exact=True)
    except SingularPose:
        return None


def forces(found: Reactions) -> dict[str, object]:
    """The solver's forces by the names of the readings."""
    scene = found.equations.scene
    joints = {JointForce(point, link).name: found.joints[point, link] for point, link, _ in pairs(scene)}
    slides = {name: force for name, (force, _) in found.slides.items()}
    moments = {f"moment {name}": moment for name, (_, moment) in found.slides.items()}
    return joints | slides | moments | named(found)


def named(found: Reactions) -> dict[str, object]:
    """The solver's balances by their names."""
    loads = found.equations.scene.loads
    return dict(zip(loads.named_balances, found.balances, strict=True)) if loads else {}


def drawn(results: dict[str, dict[str, object]]) -> Iterator[tuple[str, object]]:
    """What is read of reactions and balances, by the same names."""
    for kind in ("reaction", "slide reaction", "balance", "balance moment", "lever", "lever moment"):
        yield from results.get(kind, {}).items()
    yield from ((f"moment {name}", moment) for name, moment in results.get("slide moment", {}).items())


def asked(scene: Scene, plan: str) -> set[str]:
    """The joints and slides whose reactions are wanted."""
    if scene.find.reactions is None:
        return set() if "lever" in plan else {*scene.joints, *(slide.name for slide in scene.slides)}
    return set(scene.find.reactions)


@pytest.mark.parametrize("first", range(0, LINKAGES, TOGETHER))
def test_forces_are_constructed_exactly(first: int) -> None:
    """Reactions and balances of all loads, as fractions, by every plan and in every form of inertia."""
    for seed in range(first, first + TOGETHER):
        for number, scene in enumerate(loaded_scenes(seed)):
            if (right := truth(scene)) is None:
                break
            exact = forces(right)
            for plan, inertia in Random(2 * seed + number).sample(STYLES, 3):
                results = construct(scene, plan=plan, inertia=inertia).read(Fractions())
                found = dict(drawn(results))
                wrong = {name for name, value in found.items() if value != exact[name]}
                assert not wrong, f"linkage {seed}, order {number}, {plan} {inertia}: {wrong}"
                sites = {name.rpartition(" at ")[2] for name in results.get("reaction", {})}
                assert sites | results.get("slide reaction", {}).keys() >= asked(scene, plan), (seed, plan)
                assert found.keys() >= named(right).keys(), (seed, plan)


@pytest.mark.parametrize("journals", [False, True])
def test_friction_is_drawn_until_it_stands(journals: bool) -> None:
    """The balances with friction are the solver's, which goes on to the end; exactly, where only slides rub."""
    rounds = set()
    for seed in range(LINKAGES // 2):
        linked = linkage(seed)
        linked_scene = next(loaded_scenes(seed, orders=1), None)
        friction = "\n".join(rubbing(linked, Random(seed), journals))
        if linked_scene is None or not friction or truth(linked_scene) is None:
            continue
        scene = parse(linked_scene.text.replace("[find]", f"{friction}\n[find]"), f"rough {seed}")
        try:
            standing = with_friction(scene, exact=not journals)
        except SingularPose:
            continue
        found = report(scene, exact=not journals, plan="polygons")
        rounds.add(found.drawing.rounds)
        assert found.forces is not None
        for name, value in found.forces.friction_balances.items():
            right = named(standing)[name]
            assert value == (right if not journals else pytest.approx(right, rel=1e-8, abs=1e-9)), seed
    assert 1 in rounds
    assert journals <= (max(rounds) > 1)
