"""Resistance to rolling in machines with contacts that roll, drawn and solved, and by the balance of powers."""

from __future__ import annotations

import math
from random import Random

import pytest

from graphplan.check.trusted import report
from graphplan.mechanism.scene import parse
from graphplan.solver import reactions, with_friction
from graphplan.solver.friction import delivered_power, rolling_turnings

ARM = 0.5


def machine(seed: int) -> str:
    """A wheel that rolls on a rail, drawn by a crank through a rod, under loads as they fall; some stand aslant."""
    random = Random(seed)
    x, r, slope = random.randint(120, 200), random.randint(30, 60), random.choice((0.0, 0.1, -0.2))
    long = math.hypot(1, slope)
    t, n = (1 / long, slope / long), (-slope / long, 1 / long)
    W, K = (x * t[0] + r * n[0], x * t[1] + r * n[1]), (x * t[0], x * t[1])
    angle = random.uniform(0.3, 2.6)
    A = 40 * math.cos(angle), 60 + 40 * math.sin(angle)
    points = {"O": (0, 60), "A": A, "W": W, "K": K}
    return f"""[points]
{"".join(f"{name} = [{px!r}, {py!r}]" + chr(10) for name, (px, py) in points.items())}
[links]
1 = "O A"
2 = "A W"
3 = "W"
frame = "O"
[[contacts]]
links = ["3", "frame"]
at = "K"
centres = ["W", [{t[0]!r}, {t[1]!r}]]
rolling = true
[[forces]]
on = "3"
at = "W"
value = [{random.randint(-300, 300)}, {-random.randint(500, 2000)}]
[[drive]]
link = "1"
omega = {random.choice((-5, 3))}
[balance]
link = "1"
[[friction]]
contact = ["3", "frame"]
rolling = {ARM}
[find]
velocity = ["W"]
reactions = "all"
"""


@pytest.mark.parametrize("seed", range(20))
def test_what_rolling_takes_the_balance_gives(seed: int) -> None:
    """Drawing and solver agree, and the balance gives k N |omega| more than without resistance."""
    scene = parse(machine(seed), f"wheel {seed}")
    assert report(scene).forces is not None
    rubbed, smooth = with_friction(scene), reactions(scene)
    (contact, turning), = rolling_turnings(smooth.rates)
    normal = contact.normal(scene.points)
    size = abs(float(rubbed.higher[contact.name][0])) * math.hypot(*map(float, normal))
    lost = ARM * size * abs(float(turning))
    assert float(delivered_power(rubbed) - delivered_power(smooth)) == pytest.approx(lost, rel=1e-9)
