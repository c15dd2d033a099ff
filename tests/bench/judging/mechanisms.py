"""Scenes that no file has: four-bars, slider-cranks, inverted ones and six-links with numbers from a seed."""

from __future__ import annotations

import cmath
import math
import random
from pathlib import Path

from graphplan.errors import GraphplanError
from judging.task import task

FLATTEST = 25  # degrees between lines that are to cross
A3 = 420  # mm


def mechanism(seed: int, folder: Path) -> str:
    """A scene file in a folder, of a mechanism that can be drawn."""
    chance = random.Random(f"mechanism {seed}")
    while True:
        kind = chance.choice((four_bar, slider_crank, inverted, six_links))
        path = folder / f"{kind.__name__.replace('_', '-')}-of-{seed}.toml"
        try:
            path.write_text(kind(chance))
            if max(task(str(path)).size) > A3:
                raise ValueError("too large for a school's scanner")
        except (GraphplanError, ArithmeticError, ValueError):
            path.unlink(missing_ok=True)
        else:
            return str(path)


def met(one: complex, r: float, other: complex, s: float) -> complex:
    """Where two arcs meet, not too flat."""
    d = abs(other - one)
    x = (d * d + r * r - s * s) / (2 * d)
    y = math.sqrt(r * r - x * x)
    angle = math.degrees(math.acos((r * r + s * s - d * d) / (2 * r * s)))
    if not FLATTEST < angle < 180 - FLATTEST:
        raise ValueError("the arcs meet too flat")
    return one + complex(x, y) * (other - one) / d


def scene(points: dict[str, complex], links: str, asked: str, chance: random.Random, more: str = "") -> str:
    """The text of a scene."""
    turn = cmath.rect(1, math.radians(chance.uniform(-20, 20)))
    at = "".join(f"{name} = [{(z * turn).real:.0f}, {(z * turn).imag:.0f}]\n" for name, z in points.items())
    names = ", ".join(f'"{name}"' for name in asked)
    speed, growth = chance.choice((2, 4, 5, 8, 10, -6)), chance.choice((0, 0, 0, 12, -20))
    return (f'title = "Mechanism of a seed"\n[points]\n{at}[links]\n{links}\n{more}[[drive]]\nlink = "1"\n'
            f"omega = {speed}\nalpha = {growth}\n[find]\nvelocity = [{names}]\nacceleration = [{names}]\n")


def four_bar(chance: random.Random) -> str:
    crank = cmath.rect(chance.uniform(50, 90), chance.uniform(0.3, 2.6))
    base = chance.uniform(180, 260)
    B = met(crank, chance.uniform(130, 220), complex(base, 0), chance.uniform(100, 200))
    points = {"O": 0j, "A": crank, "B": B, "C": complex(base, 0)}
    if chance.random() < 0.5:
        return scene(points, '1 = "O A"\n2 = "A B"\n3 = "B C"\nframe = "O C"', "AB", chance)
    points["M"] = crank + (B - crank) * complex(chance.uniform(0.2, 0.8), chance.choice((0.5, -0.4)))
    return scene(points, '1 = "O A"\n2 = "A B M"\n3 = "B C"\nframe = "O C"', "ABM", chance)


def slider_crank(chance: random.Random) -> str:
    crank = cmath.rect(chance.uniform(50, 90), chance.uniform(0.4, 2.6))
    height, rod = chance.uniform(-25, 25), chance.uniform(180, 260)
    B = complex(crank.real + math.sqrt(rod**2 - (crank.imag - height) ** 2), height)
    slide = '[[slides]]\nlink = "3"\nalong = "frame"\nat = "B"\ndirection = [1, 0]\n'
    text = scene({"O": 0j, "A": crank, "B": B}, '1 = "O A"\n2 = "A B"\n3 = "B"\nframe = "O"', "AB",
                 random.Random(chance.random()), slide)
    return text


def inverted(chance: random.Random) -> str:
    crank = cmath.rect(chance.uniform(50, 80), chance.uniform(0.3, 2.8))
    pivot = complex(chance.uniform(-20, 20), -chance.uniform(120, 170))
    end = pivot + (crank - pivot) * 1.35
    slide = '[[slides]]\nlink = "2"\nalong = "3"\nat = "A"\ndirection = "P D"\n'
    points = {"O": 0j, "A": crank, "P": pivot, "D": end}
    return scene(points, '1 = "O A"\n2 = "A"\n3 = "P D"\nframe = "O P"', "AD", chance, slide)


def six_links(chance: random.Random) -> str:
    crank = cmath.rect(chance.uniform(45, 70), chance.uniform(0.4, 2.4))
    C = complex(chance.uniform(150, 200), 0)
    B = met(crank, chance.uniform(110, 150), C, chance.uniform(90, 130))
    D = C + (B - C) * cmath.rect(chance.uniform(1.0, 1.4), -chance.uniform(0.2, 0.6))
    F = C + chance.uniform(130, 170)
    E = met(D, chance.uniform(90, 140), F, chance.uniform(90, 140))
    points = {"O": 0j, "A": crank, "B": B, "C": C, "D": D, "E": E, "F": F}
    return scene(points, '1 = "O A"\n2 = "A B"\n3 = "B C D"\n4 = "D E"\n5 = "E F"\nframe = "O C F"', "ABDE", chance)
