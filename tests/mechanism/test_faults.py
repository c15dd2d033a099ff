"""Faults: what is said about text that is no scene; and that nothing else ever happens to it."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scene_texts import ACTUATOR, FIVE_BAR, LOADED, OPEN, PRESS, changed

from graphplan.errors import SceneError
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse


def faults(text: str) -> list[str]:
    """The fault lines of a text, without the name of the file."""
    with pytest.raises(SceneError) as error:
        parse(text, "f.toml")
    assert all(line.startswith("f.toml: ") for line in error.value.lines)
    return [line.removeprefix("f.toml: ") for line in error.value.lines]


def balanced(balance: str) -> str:
    """The loaded scene with these lines for its balance."""
    return changed(LOADED, ('[balance]\nlink = "1"', f"[balance]\n{balance}"))


BALANCE = '[balance] with link = "1" for a moment, or with at, on and direction for a force'

ROLLER = """
[points]
O = [0, 0]
C = [30, 16]
A = [-6, 43]
K = [2, 37]
[links]
1 = "O C"
2 = "A"
3 = "A"
frame = "O"
[[contacts]]
links = ["1", "3"]
at = "K"
centres = ["C", "A"]
[[slides]]
link = "2"
along = "frame"
at = "A"
direction = [0, 1]
[[drive]]
link = "1"
omega = 10
"""

FAULTS: list[tuple[str, str]] = [
    # the text
    ("", "file: it is empty; a scene with [points], [links] and [[drive]]"),
    ("a = ", "end of file: not TOML: Invalid value; text that follows toml.io"),
    (
        "\n a b",
        "line 2, column 4: not TOML: Expected '=' after a key in a key/value pair; text that follows toml.io",
    ),
    ("[points]\nAα = [1, 2]", 'line 2, column 2: the name Aα has letters other than A to Z, so it is quoted; "Aα"'),
    ("[links.β]", 'line 1, column 8: the name β has letters other than A to Z, so it is quoted; "β"'),
    ("a = " + "[" * 9999, "file: tables or lists are nested too deeply; a scene as the manual shows it"),
    ("[points]\n[links]", "points: the scene has no points; [points] with entries such as A = [0, 0]"),
    ("[points]\n[links]", 'links: the scene has no links; [links] with entries such as 1 = "O A"'),
    ("points = 3", "points: the number 3 where a table is wanted; a table of keys and values"),
    # keys
    (PRESS + "[point]", "point: unknown key; perhaps points"),
    (changed(PRESS, ("omega", "omga")), "drive.1.omga: unknown key; perhaps omega"),
    (changed(PRESS, ("pick =", "pik =")), "points.B.pik: unknown key; perhaps pick"),
    (changed(PRESS, ("through", "trough")), "points.B.on.trough: unknown key; perhaps through"),
    (changed(PRESS, ("at = ", "att = ")), "slides.1.att: unknown key; perhaps at"),
    (PRESS + "[find]\nvelocities = 'all'", "find.velocities: unknown key; perhaps velocity"),
    (changed(OPEN, ("velocity", "speed")), "motion.K.speed: unknown key; one of velocity, acceleration"),
    (PRESS + "[units]\nlenght = 'm'", "units.lenght: unknown key; perhaps length"),
    (PRESS + "[units]\nlength = 'km'", 'units.length: the string "km" is not known here; perhaps m'),
    (PRESS + "[units]\nlength = 3", "units.length: the number 3 is not known here; one of mm, cm, m, in, ft"),
    ("title = 3" + PRESS.replace("title", "source"), "title: the number 3 where a text is wanted; a text in quotes"),
    (
        "gravity = 9.81" + PRESS,
        "gravity: the number 9.81 where two numbers are wanted; two numbers such as [10, 5]",
    ),
    # points
    (changed(PRESS, ("O = [0, 0]", "O = [0, true]")), "points.O: true where a number is wanted; a number such as 12.5"),
    (
        changed(PRESS, ("O = [0, 0]", 'O = [0, "1"]')),
        'points.O: the string "1" where a number is wanted; a number such as 12.5',
    ),
    (
        changed(PRESS, ("O = [0, 0]", "O = [0, nan]")),
        "points.O: nan is not a usable number; a finite number between 1e-60 and 1e60 in size",
    ),
    (
        changed(PRESS, ("O = [0, 0]", "O = [0, -1e999999999]")),
        "points.O: -1e999999999 is not a usable number; a finite number between 1e-60 and 1e60 in size",
    ),
    (
        changed(PRESS, ("O = [0, 0]", f"O = [0, {'9' * 4000}]")),
        "points.O: an integer that is too large is not a usable number; a finite number between 1e-60 and 1e60 in size",
    ),
    (
        changed(PRESS, ("O = [0, 0]", "O = [0, 1, 2]")),
        "points.O: a list of 3 where two numbers are wanted; two numbers such as [10, 5]",
    ),
    (
        changed(PRESS, ("O = [0, 0]", "O.x = 0\nO.y = 0")),
        "points.O: a table with the keys x, y places no point; "
        'coordinates [x, y], or a table such as { from = "O", distance = 250, angle = 20 }',
    ),
    (
        changed(PRESS, ("M = {", '"M 1" = [0, 0]\nM = {')),
        'points."M 1": a point\'s name is empty or has blanks or commas; a name without them, such as A2',
    ),
    (
        changed(PRESS, ("distance = 25", "distance = 25, form = 'A'")),
        "points.M.form: unknown key; one of on, distance",
    ),
    (
        changed(PRESS, (', pick = "right"', "")),
        'points.B: pick is missing; pick = "right" (further along) or "left" (back along) the line\'s direction',
    ),
    (changed(PRESS, ('"right"', '"rigth"')), 'points.B.pick: the string "rigth" is not known here; perhaps right'),
    (
        changed(PRESS, ("{ A = 50 }", "{ A = 50, O = 3 }")),
        "points.B.distances: distances from 2 points; distances from 1, as the other keys ask",
    ),
    (
        changed(PRESS, ("{ A = 50 }", "{ A = 0 }")),
        "points.B.distances.A: the distance 0 is not positive; a distance above 0",
    ),
    (changed(PRESS, ("{ A = 50 }", "{ AA = 50 }")), "points.B.distances.AA: there is no point AA; perhaps A"),
    (
        changed(PRESS, ("{ A = 50 }", "{ A = 39.5 }")),
        "points.B: the arc around A (radius 39.5) does not meet the line, which is 40 away; a radius of at least 40",
    ),
    (
        changed(PRESS, ("direction = [1, 0] }", "direction = [0, 0] }")),
        "points.B.on.direction: the direction is zero; a vector that is not [0, 0]",
    ),
    (
        changed(PRESS, ("M = {", 'A2 = { distances = { O = 730, A = 30 }, side = "left" }\nM = {')),
        "points.A2: compass arcs around O (radius 730) and A (radius 30) do not meet, the centres are 50 apart; "
        "radii that differ by at most 50",
    ),
    (
        changed(PRESS, ("M = {", 'A2 = { distances = { O = 20, A = 29 }, side = "left" }\nM = {')),
        "points.A2: compass arcs around O (radius 20) and A (radius 29) do not meet, the centres are 50 apart; "
        "radii whose sum is at least 50",
    ),
    (
        changed(PRESS, ("M = {", 'O2 = [0, 0]\nA2 = { distances = { O = 2, O2 = 2 }, side = "left" }\nM = {')),
        "points.A2: the compass centres O and O2 coincide; centres that lie apart",
    ),
    (
        changed(PRESS, ('on = "A B"', 'on = "A O2"'), ("M = {", "O2 = [30, 40]\nM = {")),
        "points.M: the points A O2 coincide and give no direction; two points that lie apart",
    ),
    (
        changed(PRESS, ('on = "A B"', 'on = "A B O"')),
        'points.M.on: the string "A B O" where two points are wanted; two points such as "A B"',
    ),
    (
        changed(PRESS, ("A = [30, 40]", 'A = { from = "M", distance = 1, angle = 0 }')),
        "points.A: points A, B, M are placed from each other; coordinates for one of them",
    ),
    (
        changed(PRESS, ("A = [30, 40]", 'A = { from = "A", distance = 1, angle = 0 }')),
        "points.A: it is placed from itself; coordinates for one of them",
    ),
    (
        changed(PRESS, ("M = {", "Z = [1, 1]\nM = {")),
        "points.Z: no link has this point; name it in a link, or remove it",
    ),
    # links
    (
        changed(PRESS, ('"O A"', '"O, A"')),
        'links.1: commas between points; points separated by blanks alone, such as "A B"',
    ),
    (
        changed(PRESS, ('"O A"', '["O", "A"]')),
        'links.1: a list of 2 where a string of points is wanted; points separated by blanks, such as "A B"',
    ),
    (changed(PRESS, ('"O A"', '"O A O"')), "links.1: point O is named twice; each point once"),
    (changed(PRESS, ('"O A"', '"O a"')), "links.1: there is no point a; perhaps A"),
    (changed(PRESS, ('3 = "B"', '3 = " "')), 'links.3: a link without points; its points, such as "A B"'),
    (
        changed(PRESS, ('3 = "B"', "3 = 'B'\n4 = 'M'\n5 = 'N'"), ("M = {", "N = [5, 5]\nM = {")),
        "links.5: link 5 shares no joint or slide with any other; a point that it shares with another link, or a slide",
    ),
    (
        changed(PRESS, ('3 = "B"', "3 = 'B'\n4 = 'N P'\n5 = 'N'"), ("M = {", "N = [5, 5]\nP = [0, 9]\nM = {")),
        "links.4: link 4 is connected to neither the frame nor a given motion; "
        "a point that it shares with another link, or a slide",
    ),
    (
        changed(PRESS, ("A = [30, 40]", "A = [0, 0]")),
        "links.1: the joints O and A coincide; joints that lie apart, or one name for both",
    ),
    ('[points]\nA = [0, 0]\n[links]\nframe = "A"', 'links: no link moves; a link besides the frame, such as 1 = "O A"'),
    # slides
    (
        changed(PRESS, ("[[slides]]", "[slides]")),
        "slides: a table with the keys link, along, at, direction where a list of tables is wanted; "
        "[[slides]], in double brackets",
    ),
    (
        changed(PRESS, ('link = "3"', "link = 3")),
        'slides.1.link: the number 3 where the name of a link is wanted; a name in quotes, such as "3"',
    ),
    (changed(PRESS, ('link = "3"', 'link = "5"')), "slides.1.link: there is no link 5; one of 1, 2, 3, frame"),
    (changed(PRESS, ('along = "frame"', 'along = "3"')), "slides.1: link 3 slides along itself; two different links"),
    (changed(PRESS, ('at = "B"', 'at = "A"')), "slides.1.at: A is not a point of the sliding link 3; one of B"),
    (
        changed(PRESS, ("direction = [1, 0]\n\n", 'direction = "O"\n\n')),
        'slides.1.direction: the string "O" where two points are wanted; two points such as "O A"',
    ),
    (
        changed(PRESS, ("direction = [1, 0]\n\n", "direction = [0, 0.0]\n\n")),
        "slides.1.direction: the direction is zero; a vector that is not [0, 0]",
    ),
    (
        changed(PRESS, ("direction = [1, 0]\n\n", 'direction = ["O", "A"]\n\n')),
        'slides.1.direction: a list of points; both points in one string, such as "O A"',
    ),
    (
        changed(PRESS, ("direction = [1, 0]\n\n", "direction = true\n\n")),
        "slides.1.direction: true where a number is wanted; a number such as 12.5",
    ),
    (
        PRESS + '[[slides]]\nlink = "frame"\nalong = "3"\nat = "O"\ndirection = [1, 0]',
        "slides.2: a second slide between links frame and 3; one slide between two links, as a guide in line "
        "with it only repeats it",
    ),
    (
        ROLLER,
        "contacts: link 3 can turn idly: a passive freedom, that moves nothing else; rolling = true in the "
        "contact of 1 3",
    ),
    # drives
    (
        PRESS[: PRESS.index("[[drive]]")],
        "drive: mobility 1 but no drives; 1 more [[drive]], since links 1 2 3 can still move",
    ),
    (
        PRESS + '[[drive]]\nlink = "2"\nomega = 1',
        "drive: mobility 1 but 2 drives; fewer drives, or fewer joints and slides",
    ),
    (
        PRESS + '[[drive]]\nlink = "1"\nomega = 1',
        "drive.2: a second drive between links 1 and frame; one drive between two links",
    ),
    (
        changed(PRESS, ('2 = "A M B"', '2 = "A"\n4 = "M B"')),
        "drive: mobility 4 but 1 drive; 3 more [[drive]], since links 2 3 4 can still move",
    ),
    (
        changed(OPEN, ("[motion.L]\nvelocity = [0, 1]", "")),
        "drive: mobility 5 but 1 drive and 1 given motion (two degrees each); "
        "2 more [[drive]], since links 1 2 3 can still move",
    ),
    (changed(PRESS, ('link = "1"', 'link = "frame"')), "drive.1.link: the frame is driven; a moving link"),
    (
        PRESS + 'relative_to = "1"',
        "drive.1: link 1 is driven relative to itself; another link, or no relative_to for the frame",
    ),
    (PRESS + "rpm = 3", "drive.1: omega and rpm are both given; either omega in rad/s or rpm"),
    (changed(PRESS, ("omega = 0.1", "")), "drive.1: omega is missing; either omega in rad/s or rpm"),
    (changed(PRESS, ('link = "1"\nomega', "omega")), 'drive.1: link is missing; the driven link, such as link = "1"'),
    (
        changed(PRESS, ("omega = 0.1", "omega = 1979-05-27")),
        "drive.1.omega: a date or time where a number is wanted; a number such as 12.5",
    ),
    (
        changed(ACTUATOR, ('["rod", "barrel"]', '["barrel", "rod"]')),
        'drive.1.slide: no slide of link barrel along link rod; perhaps slide = ["rod", "barrel"]',
    ),
    (
        changed(ACTUATOR, ('["rod", "barrel"]', '["boom", "rod"]')),
        'drive.1.slide: no slide of link boom along link rod; one of slide = ["rod", "barrel"]',
    ),
    (
        changed(ACTUATOR, ('["rod", "barrel"]', '"rod"')),
        'drive.1.slide: the string "rod" where two links are wanted; two links such as ["3", "2"]',
    ),
    (changed(ACTUATOR, ("speed = 0.5", "")), "drive.1: speed is missing; a length per second, such as speed = 0.5"),
    # motions and questions
    (
        PRESS + "[motion.O]\nvelocity = [1, 1]",
        "motion.O: O is a point of the frame, which stands still; a point of moving links only",
    ),
    (changed(OPEN, ("motion.L", "motion.l")), "motion.l: there is no point l; perhaps L"),
    (
        changed(OPEN, ("[0, 1]", "1")),
        "motion.L.velocity: the number 1 where two numbers are wanted; two numbers such as [10, 5]",
    ),
    (PRESS + '[find]\nvelocity = ["C"]', "find.velocity: there is no point C; one of A, B, M, O"),
    (
        PRESS + '[find]\nvelocity = "A"',
        'find.velocity: the string "A" where a list of points is wanted; a list such as ["A", "C"], or "all"',
    ),
    (PRESS + '[find]\nlinks = ["4"]', "find.links: there is no link 4; one of 1, 2, 3"),
    (PRESS + '[find]\nlinks = ["frame"]', "find.links: the frame stands still; a moving link"),
    (
        PRESS + "[find]\nlinks = 3",
        'find.links: the number 3 where a list of links is wanted; a list such as ["2", "3"], or "all"',
    ),
    (PRESS + '[find]\nslides = ["3 on frame"]', "find.slides: there is no slide 3 on frame; perhaps 3 along frame"),
    (
        PRESS + '[find]\nslides = "3 along frame"',
        'find.slides: the string "3 along frame" where a list of slides is wanted; '
        'a list such as ["3 along 2"], or "all"',
    ),
    (
        changed(PRESS, ("M = {", "Z = [9, 9]\nM = {")) + '[find]\nacceleration = ["Z"]',
        "find.acceleration: no link has the point Z, so it has no motion; a point of a link",
    ),
    # loads
    ("masses = 3\n" + PRESS, "masses: the number 3 where a table is wanted; a table of keys and values"),
    (
        PRESS + "[forces]",
        "forces: an empty table where a list of tables is wanted; [[forces]], in double brackets",
    ),
    (
        changed(LOADED, ("[[moments]]", "[moments]")),
        "moments: a table with the keys on, value where a list of tables is wanted; [[moments]], in double brackets",
    ),
    (
        PRESS + "[friction]\nat = 'A'",
        "friction: a table with the keys at where a list of tables is wanted; [[friction]], in double brackets",
    ),
    ("forces = [3]\n" + PRESS, "forces.1: the number 3 where a table is wanted; a table of keys and values"),
    ("balance = 3\n" + PRESS, "balance: the number 3 where a table is wanted; a table of keys and values"),
    (changed(LOADED, ("[balance]", "[balanc]")), "balanc: unknown key; perhaps balance"),
    # masses
    (PRESS + "[masses]\n2 = 3", "masses.2: the number 3 where a table is wanted; a table of keys and values"),
    (changed(LOADED, ("mass = 2.5\n", "")), "masses.2: mass is missing; a mass, such as mass = 10"),
    (
        changed(LOADED, ('centre = "M"\n', "")),
        'masses.2: centre is missing; a point of the link, such as centre = "S"',
    ),
    (changed(LOADED, ('centre = "M"', 'center = "M"')), "masses.2.center: unknown key; perhaps centre"),
    (changed(LOADED, ("[masses.2]", "[masses.5]")), "masses.5: there is no link 5; one of 1, 2, 3, frame"),
    (changed(LOADED, ("[masses.2]", "[masses.frame]")), "masses.frame: the frame is given a mass; a moving link"),
    (
        changed(LOADED, ("mass = 2.5", "mass = -2.5")),
        "masses.2.mass: the mass -2.5 is negative; a number of 0 or more",
    ),
    (
        changed(LOADED, ("mass = 2.5", 'mass = "2.5 kg"')),
        'masses.2.mass: "2.5 kg" has a unit in it; 2.5, with mass = "kg" in [units]',
    ),
    (
        changed(LOADED, ("inertia = 0.01", "inertia = inf")),
        "masses.2.inertia: inf is not a usable number; a finite number between 1e-60 and 1e60 in size",
    ),
    (changed(LOADED, ('centre = "M"', 'centre = "S"')), "masses.2.centre: there is no point S; one of A, B, M, O"),
    (changed(LOADED, ('centre = "M"', 'centre = "O"')), "masses.2.centre: O is not a point of link 2; one of A, B, M"),
    (
        changed(LOADED, ('centre = "M"', "centre = [45, 20]")),
        'masses.2.centre: a list of 2 where the name of a point is wanted; a name in quotes, such as "3"',
    ),
    # forces and moments
    (changed(LOADED, ('on = "3"\n', "")), 'forces.1: on is missing; the loaded link, such as on = "2"'),
    (
        changed(LOADED, ('at = "B"\nvalue', "value")),
        'forces.1: at is missing; a point of that link, such as at = "C"',
    ),
    (
        changed(LOADED, ("value = [-150, 0.5]", "")),
        "forces.1: value is missing; two components, such as value = [-150, 0], or over and a table",
    ),
    (changed(LOADED, ("value = [-150", "vale = [-150")), "forces.1.vale: unknown key; perhaps value or values"),
    (changed(LOADED, ('on = "3"', 'on = "5"')), "forces.1.on: there is no link 5; one of 1, 2, 3, frame"),
    (changed(LOADED, ('on = "3"', 'on = "frame"')), "forces.1.on: a load on the frame moves nothing; a moving link"),
    (changed(LOADED, ('at = "B"\nvalue', 'at = "C"\nvalue')), "forces.1.at: there is no point C; one of A, B, M, O"),
    (changed(LOADED, ('on = "3"', 'on = "1"')), "forces.1.at: B is not a point of link 1; one of A, O"),
    (
        changed(LOADED, ("[-150, 0.5]", "-150")),
        "forces.1.value: the number -150 where two numbers are wanted; two numbers such as [10, 5]",
    ),
    (changed(LOADED, ('on = "2"\n', "")), 'moments.1: on is missing; the loaded link, such as on = "3"'),
    (changed(LOADED, ("value = 0.3", "")),
     "moments.1: value is missing; a moment, such as value = 12.0, or over and a table"),
    (changed(LOADED, ("value = 0.3", 'at = "M"\nvalue = 0.3')),
     "moments.1.at: unknown key; one of on, value, over, values, file, powers, during, beyond"),
    (changed(LOADED, ('on = "2"', 'on = "5"')), "moments.1.on: there is no link 5; one of 1, 2, 3, frame"),
    (changed(LOADED, ('on = "2"', 'on = "frame"')), "moments.1.on: a load on the frame moves nothing; a moving link"),
    (
        changed(LOADED, ("value = 0.3", "value = [0, 0.3]")),
        "moments.1.value: a list of 2 where a number is wanted; a number such as 12.5",
    ),
    # balance
    (PRESS + "[balance]", 'balance: link is missing; the link on which a moment acts, such as link = "1"'),
    (balanced('lnk = "1"'), "balance.lnk: unknown key; perhaps link"),
    (balanced('link = "5"'), "balance.link: there is no link 5; one of 1, 2, 3, frame"),
    (
        balanced('link = "frame"'),
        "balance.link: a balance on the frame, which does not move, keeps no motion; a moving link",
    ),
    (
        balanced('at = "O"\non = "frame"\ndirection = [0, 1]'),
        "balance.on: a balance on the frame, which does not move, keeps no motion; a moving link",
    ),
    (balanced('link = "1"\nat = "A"'), "balance.link: unknown key; one of at, on, direction"),
    (
        balanced('on = "1"\ndirection = [0, 1]'),
        'balance: at is missing; the point where a force acts, such as at = "B"',
    ),
    (
        balanced('at = "A"\ndirection = [0, 1]'),
        'balance: on is missing; the link on which it acts, such as on = "1"',
    ),
    (
        balanced('at = "A"\non = "1"'),
        "balance: direction is missing; the force's direction: a vector, an angle in degrees, or two points",
    ),
    (balanced('at = "B"\non = "1"\ndirection = [0, 1]'), "balance.at: B is not a point of link 1; one of A, O"),
    (
        balanced('at = "A"\non = "1"\ndirection = [0, 0]'),
        "balance.direction: the direction is zero; a vector that is not [0, 0]",
    ),
    (
        balanced('at = "A"\non = "1"\ndirection = "A"'),
        'balance.direction: the string "A" where two points are wanted; two points such as "O A"',
    ),
    *[
        (text, f"balance: {what}: nothing keeps the prescribed motion; {BALANCE}")
        for text, what in (
            (PRESS + "[masses]", "no balances for 1 drive"),
            ("balance = []\n" + PRESS, "no balances for 1 drive"),
            (changed(LOADED, ('[balance]\nlink = "1"', "")), "no balances for 1 drive"),
            (FIVE_BAR, "no balances for 2 drives"),
            (FIVE_BAR + '[balance]\nlink = "1"', "1 balance for 2 drives"),
        )
    ],
    (
        changed(LOADED, ("[balance]", '[[balance]]\nlink = "2"\n[[balance]]')),
        "balance: 2 balances for 1 drive: statically indeterminate; one balance for each drive",
    ),
    (
        FIVE_BAR + "".join(f"[[balance]]\nlink = '{link}'\n" for link in "124"),
        "balance: 3 balances for 2 drives: statically indeterminate; one balance for each drive",
    ),
    *[
        (
            text,
            f"balance: it does not hold {loose}, and link {twice} is statically indeterminate; "
            "a moment or a force that works when the drive moves the mechanism",
        )
        for text, loose, twice in (
            (balanced('link = "3"'), "links 1 2 3", "3"),  # the block only translates
            (balanced('at = "O"\non = "1"\ndirection = [0, 1]'), "links 1 2 3", "1"),  # O stands still
            (FIVE_BAR + "[[balance]]\nlink = '1'\n" * 2, "links 2 3 4", "1"),
        )
    ],
    (
        OPEN + '[[forces]]\non = "2"\nat = "A"\nvalue = [0, -1]\n[balance]\nlink = "2"',
        "motion: these points are moved by no link, so the force on them is unknown; "
        "drives, where forces are asked for",
    ),
    (
        changed(LOADED, ("inertia = ", "inertia = -")),
        "masses.2.inertia: the inertia -0.01 is negative; a number of 0 or more",
    ),
    # friction
    (
        LOADED.replace("[find]", '[[friction]]\nat = "A"\nradius = 6\ncoefficient = 0.1\n\n[find]'),
        "friction.3: a second friction of joint A; one for each joint, slide or contact",
    ),
    (changed(LOADED, ("radius = 5\n", "")), "friction.1: radius is missing; the journal's radius"),
    (
        changed(LOADED, ('at = "A"\nradius = 5\n', "")),
        'friction.1: at is missing; a joint, such as at = "B", or slide = ["3", "2"]',
    ),
    *[
        (
            changed(LOADED, (f"coefficient = {number}\n", "")),
            f"friction.{row}: coefficient is missing; the coefficient of friction, such as coefficient = 0.1",
        )
        for row, number in enumerate(("0.1", "0.08"), 1)
    ],
    (
        changed(LOADED, ("radius = 5", "radius = -5")),
        "friction.1.radius: the radius -5 is negative; a number of 0 or more",
    ),
    (
        changed(LOADED, ("coefficient = 0.1", "coefficient = -0.1")),
        "friction.1.coefficient: the coefficient -0.1 is negative; a number of 0 or more",
    ),
    (
        changed(LOADED, ('at = "A"\nradius', 'at = "C"\nradius')),
        "friction.1.at: there is no point C; one of A, B, M, O",
    ),
    (
        changed(LOADED, ('at = "A"\nradius', 'at = "M"\nradius')),
        "friction.1.at: M is not a joint of two links; a joint",
    ),
    (
        changed(LOADED, ("coefficient = 0.08", "coefficient = 0.08\nradius = 2")),
        "friction.2.radius: unknown key; one of slide, coefficient, wedge, length",
    ),
    (
        changed(LOADED, ('slide = ["3", "frame"]', 'slide = "3 along frame"')),
        'friction.2.slide: the string "3 along frame" where two links are wanted; two links such as ["3", "2"]',
    ),
    (
        changed(LOADED, ('slide = ["3", "frame"]', 'slide = ["5", "frame"]')),
        "friction.2.slide: there is no link 5; one of 1, 2, 3, frame",
    ),
    (
        changed(LOADED, ('slide = ["3", "frame"]', 'slide = ["frame", "3"]')),
        'friction.2.slide: no slide of link frame along link 3; perhaps slide = ["3", "frame"]',
    ),
    (
        FIVE_BAR + '[[friction]]\nslide = ["2", "1"]\ncoefficient = 0.1',
        "friction.1.slide: no slide of link 2 along link 1; a joint and its radius",
    ),
    # reactions
    (
        PRESS + '[find]\nreactions = ["A"]',
        "find.reactions: reactions are asked for, but no load is given; [[forces]] or [masses]",
    ),
    (
        changed(LOADED, ('"3 along frame"]\n', '"3 along 2"]\n')),
        "find.reactions: there is no joint, slide, gear or contact 3 along 2; perhaps 3 along frame",
    ),
    (
        changed(LOADED, ('reactions = ["A"', 'reactions = ["M"')),
        "find.reactions: there is no joint, slide, gear or contact M; one of 3 along frame, A, B, O",
    ),
    (
        changed(LOADED, ('reactions = ["A"', "reactions = [3")),
        "find.reactions: the number 3 where the name of a joint, slide, gear or contact is wanted; a name in quotes, "
        'such as "3"',
    ),
    (
        changed(LOADED, ('reactions = ["A", "3 along frame"]', 'reactions = "A"')),
        'find.reactions: the string "A" where a list of joints, slides, gears and contacts is wanted; '
        'a list such as ["A", "3 along 2"], or "all"',
    ),
    # bracing
    (
        changed(PRESS, ('3 = "B"', '3 = "B"\n4 = "O A"\n5 = "M N"'), ("M = {", "N = [5, 5]\nM = {")),
        "links: links 1 4 are overbraced while link 5 is loose; "
        "joints, slides and drives that hold each link just once",
    ),
    (
        changed(PRESS, ('3 = "B"', '3 = "B"\n4 = "O M"\n5 = "A N"'), ("M = {", "N = [5, 5]\nM = {")),
        "links: links 1 2 3 4 are overbraced while link 5 is loose; "
        "joints, slides and drives that hold each link just once",
    ),
]


def test_faults() -> None:
    """Every fault has its one line: where it stands, what is wrong, what would be right."""
    for text, line in FAULTS:
        assert line in faults(text), text


def test_all_faults_are_told_at_once() -> None:
    """Faults that do not follow from each other are gathered, each once, none invented."""
    text = changed(
        PRESS, ("O = [0, 0]", "O = [0]"), ('"O A"', '"O AA AA"'), ("omega", "omega = 1\nrpm"), ("title", "titel")
    )
    assert [line.split(":")[0] for line in faults(text)] == ["titel", "points.O", "links.1", "drive.1"]
    text = changed(ACTUATOR, ("C = [30, 40]", "C = [30]"), ("A = [60, 80]", 'A = "far"'))
    assert [line.split(":")[0] for line in faults(text)] == ["points.C", "points.A"]
    text = changed(ACTUATOR, ('at = "D"', 'at = "C"'))
    assert [line.split(":")[0] for line in faults(text)] == ["slides.1.at"]
    text = changed(LOADED, ('centre = "M"', 'centre = "O"'), ('on = "3"', 'on = "5"'), ("radius = 5", "radius = -5"))
    assert [line.split(":")[0] for line in faults(text)] == ["forces.1.on", "friction.1.radius", "masses.2.centre"]
    text = changed(LOADED, ("O = [0, 0]", "O = [0]"), ('[balance]\nlink = "1"', ""))
    assert [line.split(":")[0] for line in faults(text)] == ["points.O", "balance"]
    text = changed(LOADED, ("omega", "omga"), ('[balance]\nlink = "1"', ""))
    assert [line.split(":")[0] for line in faults(text)] == ["drive.1.omga", "drive.1"]


def test_faults_are_full_lines() -> None:
    """Whatever stands in a scene, a fault is one printable line with a place, a reason and a remedy."""
    for line in faults(PRESS + '[motion."a\\nb"]\n[find]\nvelocity = ["\\u0007"]'):
        assert line.isprintable()
        assert line.count(": ") >= 1
        assert "; " in line


PIECES = st.sampled_from(
    [
        *"[]{}=\"',.\n# -019",
        *("nan", "1e400", "true", "1979-05-27", "0x" + "f" * 5000, "9" * 5000, "\\u0000", "\ud7ff", "\x00"),
        *("[[drive]]\n", "[points]\n", "[find]\n", "[[", "1 = ", "angle = ", "frame", "slides", "motion.A", "A B"),
        *("[masses.2]\n", "[[forces]]\n", "balance", "[[friction]]\n", "reactions = "),
    ]
)


@settings(max_examples=150, deadline=None)
@given(
    st.sampled_from([PRESS, OPEN, ACTUATOR, LOADED]),
    st.lists(st.tuples(st.integers(0, 1000), st.integers(0, 30), PIECES), max_size=5),
)
@example("a = " + "9" * 5000, [])
@example("a" + ".a" * 5000 + " = 1", [])
def test_any_text_is_a_scene_or_a_scene_error(text: str, edits: list[tuple[int, int, str]]) -> None:
    """However a scene's text is spoilt, nothing but a SceneError comes out, each line printable."""
    for place, length, piece in edits:
        text = text[:place] + piece + text[place + length :]
    try:
        assert isinstance(parse(text, "fuzz"), Scene)
    except SceneError as error:
        assert error.lines
        assert all(line.isprintable() for line in error.lines)


WORDS = st.sampled_from(
    ["O", "A", "B", "M", "1", "2", "3", "frame", "O A", "A B", "B M", "left", "all", "velocity", "on", ""]
)
VALUES = st.recursive(
    st.one_of(
        WORDS.map(lambda word: f'"{word}"'),
        st.sampled_from(["0", "1", "-2.5", "1e60", "90", "inf", "true", "07:32:00"]),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3).map(lambda items: f"[{', '.join(items)}]"),
        st.dictionaries(
            st.sampled_from(["from", "distance", "angle", "distances", "on", "side", "pick", "A", "O"]),
            inner,
            max_size=3,
        ).map(lambda table: "{" + ", ".join(f"{key} = {value}" for key, value in table.items()) + "}"),
    ),
    max_leaves=6,
)


@settings(max_examples=150, deadline=None)
@given(st.sampled_from([PRESS, OPEN, ACTUATOR, LOADED]), st.integers(0, 60), VALUES)
def test_any_value_anywhere_is_a_scene_or_a_scene_error(text: str, line: int, value: str) -> None:
    """Whatever value stands behind any key, nothing but a SceneError comes out."""
    lines = text.splitlines()
    rows = [i for i, row in enumerate(lines) if "=" in row]
    row = rows[line % len(rows)]
    lines[row] = f"{lines[row].split('=')[0]} = {value}"
    try:
        parse("\n".join(lines), "fuzz")
    except SceneError as error:
        assert error.lines
