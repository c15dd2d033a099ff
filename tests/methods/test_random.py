"""Random mechanisms: cranks with up to five groups added, in random poses."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from random_mechanisms import GROUPS, mechanism

from graphplan.check.report import Report
from graphplan.check.trusted import report
from graphplan.errors import ConstructionError, SceneError, SingularPose
from graphplan.mechanism.model import Scene
from graphplan.mechanism.structure import structure

CHOICES: list[dict[str, str]] = [{}, *({"method": m} for m in ("trial", "poles", "auxiliary")), {"plan": "polar"}]
ROUNDING = 100 * 2.0**-52

mechanisms = st.builds(
    mechanism,
    st.lists(st.sampled_from(sorted(GROUPS)), min_size=1, max_size=5),
    st.integers(0, 10**6),
)


def sound(scene: Scene) -> Scene:
    """The scene, unless chance has braced one part of it and loosened another."""
    try:
        structure(scene)
    except SceneError:
        assume(False)
    return scene


def exactly(scene: Scene, **choices: str) -> Report:
    """The exact report, unless chance has made the pose singular, or the bars of a pole asked for by name parallel."""
    try:
        return report(sound(scene), exact=True, **choices)
    except SingularPose:
        assume(False)
        raise
    except ConstructionError as error:
        assert choices.get("method") == "poles"
        assert error.code == "lines-parallel"
        return report(scene, exact=True)


@settings(max_examples=26, deadline=None, suppress_health_check=list(HealthCheck))
@given(mechanisms, st.sampled_from(CHOICES))
def test_construction_equals_solver_in_fractions(scene: Scene, choices: dict[str, str]) -> None:
    """Whatever the mechanism, form and plan, construction and solver agree to the last digit."""
    found = exactly(scene, **choices)
    assert set(found.results["velocity"]) == set(scene.find.velocity)
    assert set(found.results["acceleration"]) == set(scene.find.acceleration)
    assert all(difference == 0 for difference in found.check.values())


@settings(max_examples=18, deadline=None, suppress_health_check=list(HealthCheck))
@given(mechanisms)
def test_rounding_is_what_the_mechanism_allows(scene: Scene) -> None:
    """In floats the construction is within 1e-12, or within 100 roundings of the mechanism's own condition."""
    exactly(scene)
    found = report(scene)
    assert max(found.check.values()) <= max(1e-12, ROUNDING * found.rates.condition)


@pytest.mark.parametrize("group", sorted(GROUPS))
@pytest.mark.parametrize("choices", CHOICES, ids=str)
def test_every_group_is_constructed_in_every_way(group: str, choices: dict[str, str]) -> None:
    """Each kind of group, hung on a crank, is constructed exactly by every method and plan."""
    checked = 0
    for seed in range(4):
        scene = mechanism([group], seed)
        try:
            structure(scene)
            found = report(scene, exact=True, **choices)
        except (SceneError, SingularPose):
            continue
        assert not any(found.check.values())
        checked += 1
    assert checked >= 1


@pytest.mark.parametrize("group", sorted(GROUPS))
def test_every_group_is_drawn_out_in_single_movements(group: str) -> None:
    """The drawn steps of each group give what its compounds give."""
    for seed in range(3):
        scene = mechanism([group], seed)
        try:
            structure(scene)
            drawing = report(scene).drawing
        except (SceneError, SingularPose):
            continue
        for wanted, index in zip(drawing.program.wanted, drawing.drawn.wanted, strict=True):
            size = 1 + max(abs(number) for number in drawing.truth[wanted])
            pairs = zip(drawing.truth[wanted], drawing.values[index], strict=True)
            assert all(abs(p - q) <= 1e-5 * size for p, q in pairs)
