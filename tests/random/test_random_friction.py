"""Friction of journals, slides and contacts in random machines, against an iteration of the tests' own.

`TESTS=thorough` tries 300 machines, else there are a few.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from random import Random
from typing import Any

import pytest
from gearings import Gearing, gearing
from linkages import linkage
from loads import loaded_scenes
from rubbing_by_hand import Machine

from graphplan.check import decided_friction, trusted
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SingularPose
from graphplan.mechanism.model import Find, Scene
from graphplan.mechanism.scene import parse
from graphplan.solver import reactions

MACHINES = 30
PLANS = "", "lever", "polygons", "polar", "polar,lever"


def toothed(seed: int) -> Gearing:
    """A mechanism whose gears have flanks of a rational pressure angle, and no belts."""
    found = gearing(seed)
    found.slides = [text.replace('\nbelt = "open"', "").replace('\nbelt = "crossed"', "") for text in found.slides]
    found.slides = [f"{text}\npressure_angle = {{ tangent = 0.36 }}" if "[[gears]]" in text else text
                    for text in found.slides]
    return found


def rubbing(scene: Scene, random: Random) -> str:
    """Friction in most pairs."""
    tables = [f'at = "{point}"\nradius = {random.choice((1, 3, 5))}' for point in scene.joints]
    tables += [f'slide = ["{slide.link}", "{slide.along}"]' for slide in scene.slides]
    contacts = (pair for pair in scene.contacts if not pair.rolling and pair.alone)
    tables += ['contact = ["{}", "{}"]'.format(*pair.links) for pair in contacts]
    return "\n".join(f"[[friction]]\n{table}\ncoefficient = {random.choice((0.02, 0.05, 0.1))}"
                     for table in tables if random.random() < 0.8)


def rough_scenes(count: int) -> Iterator[tuple[int, Scene, dict[str, float]]]:
    """Rational machines with friction, of which the tests' own iteration comes to an end, and what it comes to."""
    seed = 0
    while count:
        seed += 1
        smooth = next(loaded_scenes(seed, 1, (linkage, toothed)[seed % 2]), None)
        if smooth is None or smooth.irrational or smooth.repeating or not any(d.rate for d in smooth.drives):
            continue
        friction = rubbing(smooth, Random(seed))
        try:
            reactions(smooth, exact=True)
            scene = parse(smooth.text.replace("[find]", f"{friction}\n[find]"), f"rough {seed}")
            scene = kept_by_its_drives(scene) if seed % 4 < 2 else scene
            reactions(scene, exact=True)
            right = Machine(scene).results()
        except (SingularPose, TypeError, ValueError):
            continue
        if friction and right is not None:
            count -= 1
            yield seed, replace(scene, find=Find((), (), None)), right


def kept_by_its_drives(scene: Scene) -> Scene:
    """The scene with what its drives do as balances, some of them between two moving links."""
    assert scene.loads is not None
    return replace(scene, loads=replace(scene.loads, balances=tuple(map(scene.balance_of, scene.drives))))


def printed(found: dict[str, Any]) -> dict[str, float]:
    """The balances and the sizes of journals' forces, by name."""
    balances = found["balance"] if isinstance(found["balance"], list) else [found["balance"]]
    told = {f"{one['on']} at {one['at']}": abs(complex(*one["force"])) for one in found["reactions"] if "at" in one}
    for one in balances:
        told[f"balance {one['link']}"] = one["moment"] if "moment" in one else one["force"]
    return told


def compare(seed: int, scene: Scene, right: dict[str, float], plan: str) -> str:
    """What differs; nothing where nothing does."""
    found = printed(result_data(report(scene, plan=plan)))
    assert scene.loads is not None
    names = scene.loads.named_balances
    largest = max(map(abs, right.values()), default=0.0)
    for name, value in right.items():
        if name.startswith("balance "):
            balance = names[name.removeprefix("balance ")]
            own = found.get(f"balance {balance.link}")
            if len([one for one in names.values() if one.link == balance.link]) > 1:
                continue
            if balance.direction is not None and own is not None:
                dx, dy = map(float, balance.direction)
                own, value = own[0] * dx + own[1] * dy, value * (dx * dx + dy * dy)
        else:
            own = found.get(name)
        if own is None or abs(own - value) > 1e-8 * max(largest, abs(value)):
            return f"{seed} {plan}: {name} is {own}, should be {value}"
    return ""


@pytest.mark.parametrize("certified", [True, False])
def test_friction_is_that_of_an_iteration(certified: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Balances and reactions of rubbing machines, by every plan, with python-flint and without it."""
    if not certified:
        for module in trusted, decided_friction:
            monkeypatch.setattr(module, "has_flint", lambda: False)
    wrong = [compare(seed, scene, right, PLANS[seed % len(PLANS)]) for seed, scene, right in rough_scenes(MACHINES)]
    assert not [*filter(None, wrong)]
