"""Tasks of each kind of synthesis, and random ones."""

from __future__ import annotations

import math
from random import Random

PLANES = "[0, 0, 90], [5.6, 6.4, 0], [13.45, 7.6, -60], [22.25, 2.95, -120]"  # Ozols 1974, example 22-8
THREE = PLANES.rpartition(", [")[0]
FUNCTION = "[function]\npivot = [0, 0]\n"
ROCKER = "rocker = { pivot = [1, 0], angles = [82.33128341, 91.9182118, 116.20502946] }"
TASKS = {
    "three positions": f"[guidance]\npositions = [{THREE}]\nmoving = [[1, 0.5], [4, -2]]",
    "fixed pivots": f"[guidance]\npositions = [{THREE}]\nfixed = [[0, 0], [9, -2]]",
    "two positions": "[guidance]\npositions = [[0, 0, 90], [5.6, 6.4, 0]]\nmoving = [[1, 0.5], [4, -2]]\n"
                     "turns = [50, -40]",
    "four positions": f"[guidance]\npositions = [{PLANES}]\n"
                      "moving = [{ u = 0, root = 1 }, { u = 8.641, root = 2 }]\ntable = [1.5, 2, 5]",
    "rocker": f"{FUNCTION}input = [40, 70, 115]\ncrank = 0.4\n{ROCKER}\ncompare = [[40, 82.3], [60, 88]]",
    "slide": f"{FUNCTION}input = [35, 65, 110]\nslide = {{ through = [0, -0.3], direction = [1, 0], "
             "at = [3.37392487, 2.83815578, 2.05655489] }",
    "slider-crank": "[stroke]\nratio = 1.2\nstroke = 0.1\noffset = 0.03",
    "crank-rocker": "[stroke]\nratio = 1.2\nrocker = { length = 80, swing = 60 }\nground = 150",
    "best": '[stroke]\nratio = 1.2\nrocker = { length = 80, swing = 60 }\nground = "best"',
    "lever": "[stroke]\nratio = 1.61\nlever = { ground = 200 }",
    "cognates": '[cognates]\nscene = "four-bar"\npoint = "M on 2"',
    "slider's cognate": '[cognates]\nscene = "slider-crank"\npoint = "S on 2"',
    "dwell": '[dwell]\nscene = "dwell"\npoint = "M on 2"\nfrom = 10\nto = 80\npivot = [50, 65]',
    "straight": '[dwell]\nscene = "dwell"\npoint = "M on 2"\nfrom = 10\nto = 30\nstraight = true',
    "geneva": "[geneva]\nslots = 6\ncentres = 100",
    "conjugate": "[conjugate]\ncentres = 100\nratio = -0.5\nfrom = -60\nto = 60\n"
                 "profile = { circle = [70, 0], radius = 8 }",
    "gear": "[gear]\nmodule = 5\nteeth = [17, 30]",
    "ring": "[gear]\nmodule = 5\nteeth = [17, 40]\ninternal = true",
}
SCENES = [name for name in TASKS if name not in ("straight", "conjugate")]


def random_task(seed: int) -> str:
    """A task by chance: positions, pairs of angles from a linkage, or a stroke."""
    rng = Random(seed)

    def position() -> str:
        return f"[{rng.uniform(-5, 5)}, {rng.uniform(-5, 5)}, {rng.uniform(-170, 170)}]"

    def point() -> str:
        return f"[{rng.uniform(-5, 5)}, {rng.uniform(-5, 5)}]"

    kind = seed % 6
    if kind < 3:
        listed = ", ".join(position() for _ in range((3, 3, 5)[kind]))
        more = (f"moving = [{point()}, {point()}]", f"fixed = [{point()}, {point()}]", "")[kind]
        return f"[guidance]\npositions = [{listed}]\n{more}"
    if kind == 3:
        inputs = sorted(rng.uniform(0, 300) for _ in range(3))
        angles = [rng.uniform(0, 120) for _ in inputs]
        return (f"{FUNCTION}input = {inputs}\ncrank = {rng.uniform(0.2, 1)}\n"
                f"rocker = {{ pivot = {point()}, angles = {angles} }}")
    angle, stroke = rng.uniform(5, 60), rng.uniform(10, 100)
    most = stroke / 2 / math.tan(math.radians(angle) / 2)
    if kind == 4:
        return f"[stroke]\nangle = {angle}\nstroke = {stroke}\noffset = {rng.uniform(0.05, 0.95) * most}"
    return (f"[stroke]\nangle = {rng.uniform(2, 30)}\nrocker = {{ length = {stroke}, swing = {rng.uniform(20, 70)} }}\n"
            'ground = "best"')
