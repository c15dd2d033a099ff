"""Worlds: random scenes of every kind, each the text that one seed gives.

Mechanisms are grown by `linkages` (any graph of pins and slides), `gearings` (gears and contacts among them) and
`random_mechanisms` (known groups on a crank), loads by `loads` and `random_loads`, whole machines by `machines`, tasks
of cams by `cams`. Here they are put together, with friction, and asked for all that they can tell.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from random import Random

from gearings import Gearing, gearing
from linkages import linkage
from loads import loaded_scenes
from machines import Machine
from random_loads import loaded
from random_mechanisms import GROUPS, mechanism, mechanism_text

import graphplan as gp

FAR = 100_000  # beyond any place
LOAD = re.compile(r'\[\[(forces|moments)\]\]\non = "(.+)"\n(?:at = "(.+)"\n)?value = .*')
PRESSED = "\npressure_angle = { tangent = 0.36 }"  # rational, so that forces are fractions


def flanked(seed: int, belts: bool = True) -> Gearing:
    """A mechanism whose gears have flanks that push apart; without belts all of them do."""
    found = gearing(seed)
    for number, text in enumerate(found.slides):
        if "[[gears]]" in text:
            text = text if belts else text.replace('\nbelt = "open"', "").replace('\nbelt = "crossed"', "")
            found.slides[number] = text + ("" if "belt" in text else PRESSED)
    return found


def groups(seed: int) -> str:
    """Up to four groups on a crank."""
    random = Random(seed)
    return mechanism_text(random.choices(sorted(GROUPS), k=random.randint(1, 4)), seed)


def loaded_groups(seed: int) -> str:
    """One to three groups on a crank, with loads."""
    random = Random(seed)
    return loaded(mechanism(random.choices(sorted(GROUPS), k=random.randint(1, 2)), seed), seed).text


def loaded_linkage(seed: int) -> str:
    return _first(loaded_scenes(seed, 1))


def loaded_gearing(seed: int) -> str:
    return _first(loaded_scenes(seed, 1, flanked))


def rubbing(seed: int) -> str:
    """A loaded linkage or gearing with friction in most journals, slides and contacts that slide."""
    random, made = Random(seed), (linkage, lambda seed: flanked(seed, belts=False))[seed % 2]
    scene = gp.parse(_first(loaded_scenes(seed, 1, made)))
    pairs = [f'at = "{point}"\nradius = {random.choice((1, 3, 5))}' for point in scene.joints]
    pairs += [f'slide = ["{slide.link}", "{slide.along}"]' for slide in scene.slides]
    pairs += ['contact = ["{}", "{}"]'.format(*pair.links) for pair in scene.contacts
              if not pair.rolling and sum({*pair.links} == {*other.links} for other in scene.contacts) == 1]
    return _rough(scene.text, [f"{pair}\ncoefficient = {random.choice((0.02, 0.05, 0.1))}" for pair in pairs
                               if random.random() < 0.8])


def rubbing_slides(seed: int) -> str:
    """Some groups with slides on a crank, with loads and friction in all slides: forces are fractions."""
    random = Random(seed)
    scene = loaded(mechanism(random.choices(["rrp", "rpr", "rpp", "prp"], k=random.randint(1, 2)), seed), seed)
    return _rough(scene.text, [f'slide = ["{slide.link}", "{slide.along}"]\ncoefficient = 0.1'
                               for slide in scene.slides])


def lossy(seed: int) -> str:
    """A loaded gearing whose teeth lose power."""
    scene = gp.parse(_first(loaded_scenes(seed, 1, lambda seed: flanked(seed, belts=False))))
    share = Random(seed).choice(("0.9", "0.97"))
    return _rough(scene.text, ['gear = ["{}", "{}"]\nefficiency = {}'.format(*gear.links, share)
                               for gear in scene.gears])


def changing(seed: int) -> str:
    """A loaded linkage with a table, powers of a speed or a spring instead of each load."""
    random = Random(seed)
    scene = gp.parse(loaded_linkage(seed))
    slides = [slide.name for slide in scene.slides]
    places = [*{place: point for point, place in scene.points.items()}.values()]

    def table(found: re.Match[str]) -> str:
        kind, on, at = found.groups()
        anchors = [(point, link) for link, points in scene.links.items() for point in points
                   if link != on and at and scene.points[point] != scene.points[at]]
        if anchors and random.random() < 0.3:
            point, link = random.choice(anchors)
            return (f'[[springs]]\nends = ["{at}", "{point}"]\non = ["{on}", "{link}"]\n'
                    f"stiffness = {random.choice((0.5, 2))}\nfree = {random.choice((0, 3))}")
        over = random.choice(["travel", "speed", *slides, *(f"speed of {slide}" for slide in slides)])
        one, two, three, four = (random.randint(-90, 90) for _ in range(4))
        back = f", [{-FAR}, {one}]" if over in slides else ""
        said = f"values = [[{-FAR}, {one}], [0, {two}], [0, {three}], [{FAR}, {four}]{back}]"
        if over.startswith("speed") and random.random() < 0.5:
            said = "powers = [2, 0.5, 0.01]"
        ends = f'"{" ".join(random.sample(places, 2))}"' if len(places) > 1 else "[1, 0]"
        way = random.choice(("[3, -4]", "30", ends))
        point = f'at = "{at}"\ndirection = {way}\n' if at else ""
        return f'[[{kind}]]\non = "{on}"\n{point}over = "{over}"\n{said}'

    if not LOAD.search(scene.text) or not scene.drives[0].rate:
        raise LookupError("no load, or it leads no others")
    return LOAD.sub(table, scene.text)


def _first(scenes: Iterator[gp.Scene]) -> str:
    for scene in scenes:
        return scene.text
    raise LookupError("no balance holds it")


def _rough(text: str, pairs: list[str]) -> str:
    if not pairs:
        raise LookupError("nothing rubs")
    return text.replace("[find]", "".join(f"[[friction]]\n{pair}\n" for pair in pairs) + "[find]")


# ---- small machines of a crank, each with one pair that loses power ------------------------------------------------


def rolling(seed: int) -> str:
    """A wheel that rolls on a rail, level or aslant, with a resistance, drawn by a crank through a rod."""
    random = Random(seed)
    x, r, slope = random.randint(120, 200), random.randint(30, 60), random.choice((0.0, 0.1, -0.2))
    rail = complex(1, slope) / abs(complex(1, slope))
    angle = random.uniform(0.3, 2.6)
    points = {"O": 60j, "A": complex(40 * math.cos(angle), 60 + 40 * math.sin(angle)), "W": (x + 1j * r) * rail,
              "K": x * rail}
    pair = (f'[[contacts]]\nlinks = ["3", "frame"]\nat = "K"\ncentres = ["W", [{rail.real!r}, {rail.imag!r}]]\n'
            'rolling = true\n[[friction]]\ncontact = ["3", "frame"]\nrolling = 0.5\n')
    force = [random.randint(-300, 300), -random.randint(500, 2000)]
    return _driven(random, points, {"1": "O A", "2": "A W", "3": "W"}, pair, "W", force)


def sleeve(seed: int) -> str:
    """A crank-slider whose slider bears on a length, under a load beside it; a journal rubs, too."""
    random = Random(seed)
    angle, length = random.uniform(0.3, 2.8), random.randint(30, 60)
    A = 40 * complex(math.cos(angle), math.sin(angle))
    x = A.real + math.sqrt(110**2 - A.imag**2)
    points = {"O": 0j, "A": A, "B": complex(x), "L": complex(x + 20, random.choice((-60, 10, 80)))}
    pair = ('[[slides]]\nlink = "3"\nalong = "frame"\nat = "B"\ndirection = [3, 0]\n[[friction]]\n'
            f'slide = ["3", "frame"]\ncoefficient = 0.1\nlength = {length}\n'
            '[[friction]]\nat = "A"\nradius = 4\ncoefficient = 0.1\n')
    force = [random.randint(-300, 300), random.randint(-80, 80)]
    return _driven(random, points, {"1": "O A", "2": "A B", "3": "B L"}, pair, "L", force)


def _driven(random: Random, points: dict[str, complex], links: dict[str, str], pair: str, at: str,
            force: list[int]) -> str:
    """A machine of three links on the frame, its first one driven, its third one loaded."""
    places = "".join(f"{name} = [{z.real!r}, {z.imag!r}]\n" for name, z in points.items())
    bodies = "".join(f'{link} = "{own}"\n' for link, own in links.items())
    return (f'title = "random"\n[points]\n{places}[links]\n{bodies}frame = "O"\n{pair}'
            f'[[forces]]\non = "3"\nat = "{at}"\nvalue = {force}\n[[drive]]\nlink = "1"\n'
            f'omega = {random.choice((-5, 3))}\n[balance]\nlink = "1"\n[find]\nreactions = "all"\n')


# ---- all of them -----------------------------------------------------------------------------------------------------

MOVING: dict[str, Callable[[int], str]] = {
    "linkage": lambda seed: linkage(seed).text(), "gearing": lambda seed: gearing(seed).text(), "groups": groups}
LOADED: dict[str, Callable[[int], str]] = {
    "loaded linkage": loaded_linkage, "loaded gearing": loaded_gearing, "loaded groups": loaded_groups}
RUBBING: dict[str, Callable[[int], str]] = {
    "rubbing": rubbing, "rubbing slides": rubbing_slides, "lossy": lossy, "rolling": rolling, "sleeve": sleeve}
WORLDS = MOVING | LOADED | RUBBING | {
    "machine": lambda seed: Machine(seed).text(), "changing loads": changing}


def texts(kind: str, seeds: range) -> Iterator[tuple[int, str]]:
    """The scenes of a kind that these seeds give."""
    for seed in seeds:
        try:
            yield seed, WORLDS[kind](seed)
        except LookupError:
            continue


def scenes(kind: str, seeds: range) -> Iterator[tuple[int, gp.Scene]]:
    """The same, read."""
    for seed, text in texts(kind, seeds):
        yield seed, gp.parse(text, f"{kind} {seed}", by_drive=kind == "machine")


def asking(scene: gp.Scene, **find: object) -> gp.Scene:
    """The scene with another question; without one it asks for the motion of all its parts, and for all reactions."""
    names = {"velocity": "all", "acceleration": "all", "links": [*scene.moving],
             "slides": [slide.name for slide in scene.slides], **({"reactions": "all"} if scene.loads else {})}
    lines = [f"{key} = {value!r}".replace("'", '"') for key, value in (find or names).items()]
    return gp.parse("\n".join([scene.text.partition("[find]")[0] + "[find]", *lines]) + "\n", scene.name)
