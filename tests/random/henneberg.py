"""Random linkages of pins alone as L. Henneberg (1911) grows them: bars that two joints carry, or that part a bar."""

from __future__ import annotations

from fractions import Fraction
from random import Random

from graphplan.mechanism.model import FRAME, Find, Scene, TurningDrive, Units

REACH = 400  # of whole coordinates on either side


def henneberg(links: int, seed: int, parted: float) -> Scene:
    """A linkage with about so many links, a crank and the frame among them; this share of steps parts a bar."""
    random = Random(seed)
    points = {name: _place(random) for name in ("O", "C", "A")}
    bars: list[tuple[str, str]] = []
    while len(bars) + 2 < links:
        joint, before = f"P{len(points)}", [*points]
        points[joint] = _place(random)
        if bars and random.random() < parted:
            one, two = bars.pop(random.randrange(len(bars)))
            third = random.choice([name for name in before if name not in (one, two)])
            bars += (one, joint), (two, joint), (third, joint)
        else:
            bars += [(end, joint) for end in random.sample(before, 2)]
    carried = {str(number): bar for number, bar in enumerate(bars, 2)}
    joints = tuple(name for name in points if name not in ("O", "C"))
    return Scene("Henneberg", "", "henneberg", Units(), points, {}, {"1": ("O", "A"), **carried, FRAME: ("O", "C")},
                 (TurningDrive("1", FRAME, Fraction(1), Fraction(0)),), {}, Find(joints, joints))


def under_other_names(scene: Scene, seed: int) -> Scene:
    """The same linkage with all names exchanged, and written in another order."""
    random = Random(seed)
    points = dict(zip(scene.points, random.sample([*scene.points], len(scene.points)), strict=True))
    moving = [*scene.moving]
    links = {FRAME: FRAME, **dict(zip(moving, random.sample(moving, len(moving)), strict=True))}
    written = [(links[link], tuple(random.sample([points[name] for name in names], len(names))))
               for link, names in scene.links.items()]
    placed = [(points[name], at) for name, at in scene.points.items()]
    random.shuffle(written)
    random.shuffle(placed)
    joints = tuple(points[name] for name in scene.find.velocity)
    (drive,) = scene.drives
    return Scene(scene.title, "", scene.name, Units(), dict(placed), {}, dict(written),
                 (TurningDrive(links[drive.links[0]], FRAME, *drive.rates),), {}, Find(joints, joints))


def _place(random: Random) -> tuple[Fraction, Fraction]:
    return Fraction(random.randint(-REACH, REACH)), Fraction(random.randint(-REACH, REACH))
