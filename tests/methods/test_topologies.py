"""Linkages nobody has named: joints and slides thrown at random between links, whatever groups come of it."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from random import Random

import pytest

from graphplan.check.trusted import report
from graphplan.errors import SceneError, SingularPose
from graphplan.mechanism.model import FRAME, Find, Scene, Slide, TurningDrive, Units
from graphplan.mechanism.structure import structure

MOST_JOINTS = 4  # of one link


def thrown(seed: int, moving: int, sliding: float) -> Scene | None:
    """A linkage of mobility 1 with this many moving links, if the throw gives every link a joint."""
    random = Random(seed)
    names = [FRAME, *(str(k) for k in range(1, moving + 1))]
    links: dict[str, list[str]] = {name: [] for name in names}
    points: dict[str, tuple[Fraction, Fraction]] = {}
    slides: list[Slide] = []

    def joint(*on: str) -> str:
        point = f"J{len(points)}"
        place = Fraction(random.randint(-40, 40)), Fraction(random.randint(-40, 40))
        points[point] = place if place not in points.values() else (Fraction(50 + len(points)), Fraction(0))
        for link in on:
            links[link].append(point)
        return point

    joint(FRAME, "1")
    joined = {frozenset((FRAME, "1"))}
    for _ in range((3 * moving - 1) // 2 - 1):
        free = [(a, b) for a in names for b in names if a < b and frozenset((a, b)) not in joined
                and len(links[a]) < MOST_JOINTS and len(links[b]) < MOST_JOINTS]
        if not free:
            return None
        one, two = random.choice(free)
        joined.add(frozenset((one, two)))
        if random.random() < sliding and one != FRAME:
            direction = Fraction(random.randint(1, 9)), Fraction(random.randint(-9, 9))
            slides.append(Slide(one, two, joint(one), direction))
        else:
            joint(one, two)
    asked = tuple(p for p in points if p not in links[FRAME])
    drive = TurningDrive("1", FRAME, Fraction(1), Fraction(1))
    whole = {name: tuple(own) for name, own in links.items()}
    return Scene("thrown", "", "thrown", Units(), points, {}, whole, (*slides, drive), {}, Find(asked, asked))


@pytest.mark.parametrize(("moving", "sliding"), [(5, 0.0), (5, 0.4), (7, 0.0), (7, 0.3), (9, 0.1)])
def test_any_linkage_is_constructed(moving: int, sliding: float) -> None:
    """Whatever groups a random linkage has, up to class VI, the planner finds a construction, and it is exact."""
    groups: Counter[tuple[int, int]] = Counter()
    for seed in range(85 if moving < 9 else 120):
        scene = thrown(seed, moving, sliding)
        if scene is None or not all(scene.links.values()):
            continue
        try:
            parts = structure(scene)
            found = report(scene, exact=True)
        except (SceneError, SingularPose):
            continue
        assert set(found.results["acceleration"]) == set(scene.find.acceleration)
        assert not any(found.check.values())
        groups.update((len(group.links), group.class_) for group in parts.groups)
    assert max(size for size, _ in groups) >= 4
