"""Random machines: a crank that turns all round, groups that it drives, masses and loads, and gravity any way."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from random import Random

Places = dict[str, complex]

GRAVITY = (0.0, 90.0, 180.0, 270.0)  # degrees: along guides or across them


class Machine:
    """A machine as it is put together: its points, links and slides, and the loads on them.

    `reach` is its characteristic length; the crank O A turns about O, and A may lie in a dead point of what it drives.
    """

    def __init__(self, seed: int):
        self.rng = rng = Random(seed)
        self.unit = rng.choice(("mm", "m"))
        self.reach = rng.choice((40, 100, 317.0)) * (1.0 if self.unit == "mm" else 1e-3)
        crank = self.reach * rng.uniform(0.2, 0.4)
        angle = math.radians(rng.choice((0.0, 90.0, 180.0, 270.0, rng.uniform(0, 360))))
        self.points: Places = {"O": 0j, "A": cmath.rect(crank, angle)}
        self.links = {"1": ["O", "A"], "frame": ["O"]}
        self.slides: list[tuple[str, str, str, complex]] = []
        self.ways: dict[str, complex] = {}
        rng.choice((self._slider, self._rocker, self._yoke, self._block))()
        if rng.random() < 0.4:
            self._slider(rng.choice([name for name in self.points if name not in (*self.links["frame"], *self.ways)]))

    def _slider(self, start: str = "A") -> None:
        """A connecting rod with a slider on the frame, beyond all that its joint can reach."""
        way = cmath.rect(1.0, math.radians(self.rng.choice((*GRAVITY, self.rng.uniform(0, 360)))))
        joint, k = self.points[start], len(self.links)
        off = self.rng.choice((0.0, self.rng.uniform(-0.1, 0.1))) * self.reach
        rod = self.reach * self.rng.uniform(2.2, 2.8)
        across = off - (joint / way).imag
        end, link = f"B{k}", str(k)
        self.points[end] = joint + way * complex(math.sqrt(rod**2 - across**2), across)
        self.links[link] = [start, end]
        self.links[str(k + 1)] = [end]
        self.slides.append((str(k + 1), "frame", end, way))
        self.ways[end] = way

    def _rocker(self) -> None:
        """A crank and rocker."""
        A, crank = self.points["A"], abs(self.points["A"])
        way = cmath.exp(1j * self.rng.uniform(0, math.tau))
        D = self.reach * way
        coupler, rocker = (self.reach * self.rng.uniform(0.75, 0.95) for _ in range(2))
        if crank + max(self.reach, coupler, rocker) >= 0.98 * (self.reach + coupler + rocker
                                                               - max(self.reach, coupler, rocker)):
            coupler = rocker = 0.9 * self.reach
        far = abs(D - A)
        along = (coupler**2 - rocker**2 + far**2) / (2 * far)
        self.points |= {"D": D, "B": A + (D - A) / far * complex(along, math.sqrt(coupler**2 - along**2))}
        self.links |= {"2": ["A", "B"], "3": ["B", "D"]}
        self.links["frame"].append("D")

    def _yoke(self) -> None:
        """A scotch yoke, whose guide lies at the crank pin or beside it."""
        way = cmath.rect(1.0, math.radians(self.rng.choice(GRAVITY)))
        aside = self.rng.choice((0.0, self.rng.uniform(0.1, 0.5) * self.reach))
        self.points["B"] = (self.points["A"] / way).real * way + aside * way
        self.links |= {"2": ["A"], "3": ["B"]}
        self.slides += [("2", "3", "A", 1j * way), ("3", "frame", "B", way)]
        self.ways["B"] = way

    def _block(self) -> None:
        """A block on the crank pin that slides along a lever, which turns all round or swings."""
        D = cmath.rect(self.reach * self.rng.choice((0.1, 0.6)), self.rng.uniform(0, math.tau))
        A = self.points["A"]
        self.points |= {"D": D, "E": D + (A - D) / abs(A - D) * self.reach}
        self.links |= {"2": ["A"], "3": ["D", "E"]}
        self.links["frame"].append("D")
        self.slides.append(("2", "3", "A", A - D))

    # ---- as a scene --------------------------------------------------------------------------------------------------

    def text(self) -> str:
        """The scene, with masses, loads, gravity and what is asked of its flywheel."""
        rng, big = self.rng, 1.0 if self.unit == "mm" else 1000.0
        yield_ = [f'[units]\nlength = "{self.unit}"', *self._masses(big)]
        yield_ += self._loads()
        points = "\n".join(f"{name} = [{z.real!r}, {z.imag!r}]" for name, z in self.points.items())
        links = "\n".join(f'{name} = "{" ".join(points)}"' for name, points in self.links.items())
        slides = "\n".join(f'[[slides]]\nlink = "{link}"\nalong = "{along}"\nat = "{at}"\n'
                           f"direction = [{way.real!r}, {way.imag!r}]" for link, along, at, way in self.slides)
        omega = rng.choice((10.0, -10.0, 31.4))
        head, *rest = yield_
        return "\n".join([self._gravity(), head, "[points]", points, "[links]", links, slides,
                          f'[[drive]]\nlink = "1"\nomega = {omega}', *rest,
                          f"[flywheel]\nspeed = {abs(omega)}\nunevenness = {rng.choice((0.01, 0.04))}"]) + "\n"

    def _gravity(self) -> str:
        way = cmath.rect(9.81, math.radians(self.rng.choice((*GRAVITY, self.rng.uniform(0, 360)))))
        if self.rng.random() < 0.7:
            way = complex(*(round(part, 2) + 0.0 for part in (way.real, way.imag)))
        return f"gravity = [{way.real!r}, {way.imag!r}]"

    def _masses(self, big: float) -> Iterator[str]:
        """Masses of some links, the first one's inertia among them; centres at joints or between them."""
        rng = self.rng
        for link, points in [*self.links.items()]:
            if link == "frame" or (link != "1" and rng.random() < 0.3):
                continue
            centre = rng.choice(points)
            if len(points) > 1 and rng.random() < 0.6:
                centre = f"S{link}"
                one, two = (self.points[name] for name in points[:2])
                self.points[centre] = one + (two - one) * complex(rng.uniform(0.2, 0.8), rng.choice((0, 0.2)))
                self.links[link].append(centre)
            inertia = rng.uniform(1e-3, 1e-2) * (self.reach * big / 100) ** 2
            yield f'[masses.{link}]\nmass = {rng.uniform(0.5, 5):.3f}\ninertia = {inertia!r}\ncentre = "{centre}"'

    def _loads(self) -> list[str]:
        """A load that changes with the travel, a constant one, or none but the weights."""
        rng, found = self.rng, list[str]()
        links = [link for link in self.links if link != "frame"]
        if rng.random() < 0.6:
            link = rng.choice(links[1:])
            values = ", ".join(f"[{k * 45}, {rng.choice((0, rng.randint(-900, 900)))}]" for k in range(8))
            found.append(f'[[forces]]\non = "{link}"\nat = "{self.links[link][-1]}"\ndirection = [{rng.randint(1, 3)}, '
                         f'{rng.randint(-2, 2)}]\nover = "travel"\nvalues = [{values}, [360, 0]]')
        if rng.random() < 0.4:
            found.append(f'[[moments]]\non = "{rng.choice(links)}"\nvalue = {rng.uniform(-5, 5):.3f}')
        return found
