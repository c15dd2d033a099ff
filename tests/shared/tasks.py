"""Tasks of each kind of synthesis, and random ones."""

from __future__ import annotations

import math
import re
from pathlib import Path
from random import Random

PLANES = "[0, 0, 90], [5.6, 6.4, 0], [13.45, 7.6, -60], [22.25, 2.95, -120]"  # Ozols 1974, example 22-8
THREE = PLANES.rpartition(", [")[0]
FUNCTION = "[function]\npivot = [0, 0]\n"
ROCKER = "rocker = { pivot = [1, 0], angles = [82.33128341, 91.9182118, 116.20502946] }"
TASKS = {
    "three positions": f"[guidance]\npositions = [{THREE}]\nmoving = [[1, 0.5], [4, -2]]",
    "driver": f"[guidance]\npositions = [{THREE}]\nmoving = [[1, 0.5], [4, -2]]\ndriver = {{ ratio = 1.2 }}",
    "fixed pivots": f"[guidance]\npositions = [{THREE}]\nfixed = [[0, 0], [9, -2]]",
    "two positions": "[guidance]\npositions = [[0, 0, 90], [5.6, 6.4, 0]]\nmoving = [[1, 0.5], [4, -2]]\n"
                     "turns = [50, -40]",
    "four positions": f"[guidance]\npositions = [{PLANES}]\n"
                      "moving = [{ u = 0, root = 1 }, { u = 8.641, root = 2 }]\ntable = [1.5, 2, 5]",
    "rocker": f"{FUNCTION}input = [40, 70, 115]\ncrank = 0.4\n{ROCKER}\ncompare = [[40, 82.3], [60, 88]]",
    "five pairs": f"{FUNCTION}input = [40, 70, 115, 160, 200]\n"
                  "rocker = { pivot = [1, 0], angles = [82.331, 91.918, 116.205, 139.638, 152] }",
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


def written(path: Path, text: str) -> Path:
    """A file with a task."""
    path.write_text(text, encoding="utf-8")
    return path


class RandomTasks:
    """Tasks by chance, of each kind in turn; scenes of paths are written into a folder."""

    def __init__(self, seed: int, folder: Path):
        self.rng, self.seed, self.folder = Random(seed), seed, folder

    @property
    def text(self) -> str:
        """The task of this seed."""
        kinds = (self.moving, self.fixed, self.five, self.rocker, self.slider_crank, self.crank_rocker, self.turns,
                 self.four, self.slide, self.two_angles, self.lever, self.cognates, self.dwell, self.geneva,
                 self.conjugate, self.gear, self.driven, self.five_angles)
        return kinds[self.seed % len(kinds)]()

    def number(self, low: float, high: float) -> float:
        return self.rng.uniform(low, high)

    def positions(self, count: int) -> str:
        listed = [[self.number(-5, 5), self.number(-5, 5), self.number(-170, 170)] for _ in range(count)]
        return f"[guidance]\npositions = {listed}\n"

    def points(self, count: int = 2) -> list[list[float]]:
        return [[self.number(-5, 5), self.number(-5, 5)] for _ in range(count)]

    def moving(self) -> str:
        return f"{self.positions(3)}moving = {self.points()}"

    def driven(self) -> str:
        return f"{self.moving()}\ndriver = {{ ratio = {self.number(1, 2)} }}"

    def fixed(self) -> str:
        return f"{self.positions(3)}fixed = {self.points()}"

    def five(self) -> str:
        return self.positions(5)

    def turns(self) -> str:
        return f"{self.positions(2)}moving = {self.points()}\nturns = {[self.number(-90, 90), self.number(-90, 90)]}"

    def four(self) -> str:
        u, v = self.number(-4, 0), self.number(0.1, 4)
        return f"{self.positions(4)}moving = [{{ u = {u}, root = 1 }}, {{ u = {v}, root = 1 }}]"

    def rocker(self, count: int = 3) -> str:
        inputs = sorted(self.number(0, 300) for _ in range(count))
        angles = [self.number(0, 120) for _ in inputs]
        return (f"{FUNCTION}input = {inputs}\ncrank = {self.number(0.2, 1)}\n"
                f"rocker = {{ pivot = {self.points(1)[0]}, angles = {angles} }}")

    def five_angles(self) -> str:
        return re.sub("crank = .*\n", "", self.rocker(5))

    def two_angles(self) -> str:
        return self.rocker(2)

    def slide(self) -> str:
        inputs = sorted(self.number(0, 300) for _ in range(3))
        return (f"{FUNCTION}input = {inputs}\nslide = {{ through = {self.points(1)[0]}, "
                f"direction = {self.points(1)[0]}, at = {[self.number(0, 4) for _ in inputs]} }}")

    def slider_crank(self) -> str:
        angle, stroke = self.number(5, 60), self.number(10, 100)
        most = stroke / 2 / math.tan(math.radians(angle) / 2)
        return f"[stroke]\nangle = {angle}\nstroke = {stroke}\noffset = {self.number(0.05, 0.95) * most}"

    def crank_rocker(self) -> str:
        return (f"[stroke]\nangle = {self.number(2, 30)}\nrocker = {{ length = {self.number(10, 100)}, "
                f'swing = {self.number(20, 70)} }}\nground = "best"')

    def lever(self) -> str:
        return f"[stroke]\nangle = {self.number(2, 150)}\nlever = {{ ground = {self.number(10, 300)} }}"

    def scene(self) -> str:
        """A crank-rocker with a point M, by its lengths."""
        r, d = self.number(0.5, 1), self.number(3, 4)
        b, c = self.number(2.5, 3.5), self.number(2.5, 3.5)
        A, C = r * 1j, complex(d)
        far = abs(C - A)
        x = (b * b - c * c + far * far) / (2 * far)
        B = A + (C - A) / far * complex(x, math.sqrt(b * b - x * x))
        M = A + (B - A) * complex(self.number(-1, 2), self.number(-1, 1))
        places = "".join(f"{name} = [{z.real}, {z.imag}]\n" for name, z in zip("OABCM", (0j, A, B, C, M), strict=True))
        (self.folder / "scene.toml").write_text(
            f'[points]\n{places}[links]\n1 = "O A"\n2 = "A B M"\n3 = "B C"\nframe = "O C"\n[[drive]]\nlink = "1"\n'
            "omega = 1\n")
        return f'scene = "{self.folder / "scene.toml"}"\npoint = "M on 2"'

    def cognates(self) -> str:
        return f"[cognates]\n{self.scene()}"

    def dwell(self) -> str:
        start = self.number(-180, 180)
        return (f"[dwell]\n{self.scene()}\nfrom = {start}\nto = {start + self.number(20, 80)}\n"
                f"pivot = {self.points(1)[0]}")

    def geneva(self) -> str:
        return f"[geneva]\nslots = {self.rng.randrange(3, 16)}\ncentres = {self.number(10, 200)}"

    def conjugate(self) -> str:
        return (f"[conjugate]\ncentres = 100\nratio = {-self.number(0.2, 2)}\nfrom = {-self.number(5, 60)}\n"
                f"to = {self.number(5, 60)}\nprofile = {{ circle = [{self.number(55, 90)}, {self.number(-10, 10)}], "
                f"radius = {self.number(1, 8)} }}")

    def gear(self) -> str:
        return (f"[gear]\nmodule = {self.number(1, 10)}\nteeth = [{self.rng.randrange(12, 40)}, "
                f"{self.rng.randrange(12, 90)}]\nshift = {[self.number(0, 0.4), self.number(-0.2, 0.4)]}")
