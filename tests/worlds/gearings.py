"""Random linkages with gears and contacts among their pairs, as texts of scenes: any that their drives determine.

Centres of gears are joints of a third link; profiles touch in points where they happen to. All is rational.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

import linkages
from linkages import DIRECTIONS, FRAME, Linkage


@dataclass
class Gearing(Linkage):
    """A linkage with gears and contacts, as TOML tables; all of them are in `slides`, and counted in `kinds`."""

    kinds: set[str] = field(default_factory=set)

    def contact(self, one: str, two: str, reach: int, *, rolling: bool) -> None:
        """Two profiles that touch: a curved one and a straight one, or both curved."""
        centre = self.point(reach)
        self.links[one].append(centre)
        x, y = self.points[centre]
        if self.random.random() < 0.5:
            (dx, dy), far = self.random.choice(DIRECTIONS), self.random.choice((1, 2, -1))
            touching, profile = (x - far * dy, y + far * dx), f"[{dx}, {dy}]"
        else:
            other = self.point(reach)
            self.links[two].append(other)
            (u, v), far = self.points[other], self.random.choice((2, -1, 3))
            touching, profile = (x + far * (u - x), y + far * (v - y)), f'"{other}"'
        K = f"K{len(self.points)}"
        self.points[K] = touching
        ends = self.random.choice(((f'"{one}", "{two}"', f'"{centre}", {profile}'),
                                   (f'"{two}", "{one}"', f'{profile}, "{centre}"')))
        self._write("contacts", "links = [{}]\ncentres = [{}]".format(*ends), f'at = "{K}"',
                    "rolling = true" if rolling else "")
        self.kinds.add(("rolling " if rolling else "") + ("straight" if "[" in profile else "curved"))

    def gear(self) -> None:
        """Two links that are pinned to a third one: wheels of any size, rings, belts; or a gear on a rack."""
        arms = [(B, C, i, j) for arm in self.links for B in self.links[arm] for C in self.links[arm]
                if self.points[B] != self.points[C] for i in self.links for j in self.links
                if len({arm, i, j}) == 3 and B in self.links[i] and C in self.links[j]]
        guided = [(one, two, point) for one, two in self.guided for point in self.links[one]
                  if any(point in self.links[i] for i in self.links if i not in (one, two))]
        if guided and self.random.random() < 0.6:
            self._rack(*self.random.choice(guided))
            return
        B, C, i, j = self.random.choice(arms)  # fails where there is none: then another linkage is sought
        more = self.random.choice(("", "", "internal = true", 'belt = "open"', 'belt = "crossed"'))
        sizes = sorted(self.random.sample((15, 20, 30, 45), 2))
        if "open" in more and self.random.random() < 0.3:
            sizes = [20, 20]
        self._write("gears", f'links = ["{i}", "{j}"]', f'centres = ["{B}", "{C}"]', f"teeth = {sizes}", more)
        self.kinds.add(more or "outside")

    def _rack(self, one: str, two: str, B: str) -> None:
        """A gear that is pinned to a slide at B, on a rack that the slide's guide is fixed to."""
        wheel = next(i for i in self.links if i not in (one, two) and B in self.links[i])
        table = next(text for text in self.slides if f'link = "{one}"\nalong = "{two}"' in text)
        direction = table.rpartition("direction = ")[2]
        self._write("gears", f'links = ["{wheel}", "{two}"]', f'centres = ["{B}"]', "radius = 7",
                    f"direction = {direction}")
        self.kinds.add("rack")

    def _write(self, table: str, *lines: str) -> None:
        self.slides.append("\n".join((f"[[{table}]]", *filter(None, lines))))


def gearing(seed: int) -> Gearing:
    """A mechanism of 2 to 7 moving links with one to three gears or contacts."""
    random = Random(seed)
    return linkages.movable(lambda: _attempt(random))


def _attempt(random: Random) -> Gearing | None:
    """Links, pins and slides by chance, as many as leave the drives, gears and contacts what they bind."""
    drives, singles, count = random.choice((1, 1, 1, 2)), random.choice((1, 1, 2, 2, 3)), random.randint(2, 7)
    pairs, odd = divmod(3 * count - drives - singles, 2)
    if odd or pairs < count:
        return None
    moving = [str(k + 1) for k in range(count)]
    found = Gearing(random, links={link: [] for link in (*moving, FRAME)})
    reach = random.choice((10, 40, 90))
    joined = linkages.joined(found, moving, pairs, reach, random.choice((0.0, 0.15, 0.3)))
    if joined is None:
        return None
    while singles > 0:
        rolling = singles > 1 and random.random() < 0.3
        if rolling or random.random() < 0.45:
            found.contact(*random.sample([*found.links], 2), reach, rolling=rolling)
        else:
            try:
                found.gear()
            except IndexError:
                return None
        singles -= 1 + rolling
    for _ in range(drives):
        linkages.drive(found, joined, moving)
    return found
