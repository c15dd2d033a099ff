"""Random linkages of pins alone as L. Henneberg (1911) grows them: bars that two joints carry, or that part a bar."""

from __future__ import annotations

from random import Random

from transformations import Transformation, tables_of, text_of

REACH = 400  # of whole coordinates on either side


def henneberg_text(links: int, seed: int, parted: float) -> str:
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
    joints = ", ".join(f'"{name}"' for name in points if name not in ("O", "C"))
    return "\n".join([
        "[points]", *(f"{name} = {[*place]}" for name, place in points.items()), '[links]\n1 = "O A"',
        *(f'{number} = "{one} {two}"' for number, (one, two) in enumerate(bars, 2)), 'frame = "O C"',
        '[[drive]]\nlink = "1"\nomega = 1', f"[find]\nvelocity = [{joints}]\nacceleration = [{joints}]"]) + "\n"


def under_other_names(text: str, seed: int) -> str:
    """The same linkage with all names exchanged, and written in another order."""
    random, tables = Random(seed), tables_of(text)
    points, links = [*tables["points"]], [link for link in tables["links"] if link != "frame"]
    exchanged = (dict(zip(names, random.sample(names, len(names)), strict=True)) for names in (points, links))
    return text_of(Transformation(points=next(exchanged), links=next(exchanged), order=seed).scene(tables))


def _place(random: Random) -> tuple[int, int]:
    return random.randint(-REACH, REACH), random.randint(-REACH, REACH)
