"""Small files of other programs, and the scene that each must give, written by hand."""

from __future__ import annotations

import cmath
import io
import math
import zipfile
from itertools import combinations
from typing import Any
from urllib.parse import quote

from graphplan.mechanism.model import Drive, Scene

FRAME = """
[points]
A = [0, 0]
B = [0, 35]
C = [100, 60]
D = [110, 0]
[links]
1 = "A B"
2 = "B C"
3 = "C D"
frame = "A D"
"""
FOUR_BAR = FRAME + '[[drive]]\nlink = "1"\n'


def geogebra(*rows: str) -> bytes:
    """A .ggb file of these rows of its construction."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("geogebra.xml", f'<geogebra format="5.0"><construction>{"".join(rows)}'
                         "</construction></geogebra>")
    return packed.getvalue()


def point(label: str, at: complex, *, fixed: bool = False, shown: bool = True) -> str:
    held = '<fixed val="true"/>' if fixed else ""
    return (f'<element type="point" label="{label}"><show object="{str(shown).lower()}" label="true"/>'
            f'<coords x="{at.real!r}" y="{at.imag!r}" z="1.0"/>{held}</element>')


def made(kind: str, label: str, command: str, *inputs: str, shown: bool = True) -> str:
    """An object by a command."""
    given = " ".join(f'a{k}="{text}"' for k, text in enumerate(inputs))
    element = f'<element type="{kind}" label="{label}"><show object="{str(shown).lower()}"/></element>'
    return f'<command name="{command}"><input {given}/><output a0="{label}"/></command>{element if kind else ""}'


def segments(*pairs: str) -> str:
    return "".join(made("segment", f"s_{k}", "Segment", *pair.split()) for k, pair in enumerate(pairs))


def crossed(start: complex, r: float, end: complex, s: float) -> complex:
    """Where two circles meet, on the left."""
    apart = abs(end - start)
    along = (apart**2 + r**2 - s**2) / (2 * apart)
    return start + complex(along, math.sqrt(r**2 - along**2)) * (end - start) / apart


def places(**points: complex) -> str:
    return "[points]\n" + "".join(f"{name} = [{at.real!r}, {at.imag!r}]\n" for name, at in points.items())


B = 2 * cmath.exp(1.2j)
C = crossed(B, 5, 6 + 0j, 4)
DRAWN = point("A", 0), point("D", 6), made("conic", "c", "Circle", "A", "2"), made("", "B", "Point", "c"), point("B", B)
CIRCLES = geogebra(*DRAWN, made("conic", "d", "Circle", "B", "5"), made("conic", "e", "Circle", "D", "4"),
                   made("", "C", "Intersect", "d", "e"), point("C", C), segments("A B", "B C", "C D"),
                   made("", "M", "Midpoint", "B", "C"), point("M", (B + C) / 2))
PIN = 2 * cmath.exp(0.7j)
END = PIN.real + math.sqrt(25 - PIN.imag**2)
TURNED, SPOKE = (geogebra(
    point("O", 0), '<element type="angle" label="α"><value val="0.7"/><slider min="0" max="6.28"/></element>',
    '<expression label="A" exp="O + (2; α)" type="point"/>', point("A", PIN), made("conic", "c", "Circle", "A", "5"),
    made("", "B", "Intersect", "c", "xAxis"), point("B", complex(END)), segments("O A", "A B", *more))
    for more in ((), ("O B",)))  # the segment from the crank's pivot to the slider is none of its links
BLOCK = 3j + 1.5 * cmath.exp(0.3j)
ARM = 6 * BLOCK / abs(BLOCK)
QUICK = geogebra(
    point("O", 3j), point("P", 0), made("conic", "c", "Circle", "O", "1.5"), made("", "A", "Point", "c"),
    point("A", BLOCK), made("ray", "r", "Ray", "P", "A", shown=False), made("conic", "d", "Circle", "P", "6"),
    made("", "B", "Intersect", "d", "r"), point("B", ARM), segments("O A", "P B"))
TRIANGLE = geogebra(*(point(name, at, fixed=name in "AD") for name, at in
                      {"A": 0j, "B": 35j, "C": 100 + 60j, "D": 110 + 0j, "E": 50 + 90j}.items()),
                    segments("A B", "C D", "B C", "C E", "E B"))

HANDLE = geogebra(
    point("A", 0), point("D", 6), point("P", 1.5 * B), made("", "B", "Intersect", "Circle[A, 2]", "Ray[A, P]"),
    point("B", B), made("", "C", "Intersect", "Circle(B, 5)", "Circle(D, 4)", "1"), point("C", C),
    segments("A B", "B C", "C D"))

ANGLE = '<element type="angle" label="β"><value val="1.2"/><slider min="0°" max="360°"/></element>'
HELPERS = geogebra(  # a rigid triangle, a midpoint, and segments that change their length
    point("A", 0), point("D", 6), ANGLE,
    '<expression label="B" exp="A + (2; β)" type="point"/>', point("B", B), made("conic", "d", "Circle", "B", "5"),
    made("conic", "e", "Circle", "D", "4"), made("", "C", "Intersect", "d", "e"), point("C", C),
    made("conic", "f", "Circle", "B", "3"), made("conic", "g", "Circle", "C", "2.5"),
    made("", "E", "Intersect", "f", "g"), point("E", crossed(B, 3, C, 2.5)), segments("A B", "C D", "A C", "E D"),
    made("polygon", "t1", "Polygon", "B", "C", "E"), made("segment", "h", "Segment", "B", "C"),
    made("", "M", "Midpoint", "h"), point("M", (B + C) / 2))

LINKAGE = """<linkage2>
 <program zoom="1" units="Millimeters"/>
 <connector anchor="true" input="true" rpm="30" x="0" y="0.000000" id="0"/><connector x="0" y="35" id="1"/>
 <connector x="100" y="60" id="2"/><connector anchor="true" x="110" y="0" id="3" layer="16"/>
 <connector x="5" y="5" id="4" layer="1"/>
 <Link id="0"><connector id="0"/><connector id="1"/></Link><Link id="1"><connector id="1"/><connector id="2"/></Link>
 <Link id="2"><connector id="2"/><connector id="3"/></Link><Link id="3"><connector id="0"/><connector id="3"/></Link>
</linkage2>"""
SLOTTED = """<linkage2>
 <connector x="0" y="0" id="0"/><connector x="70" y="64" id="1"/><connector x="250" y="0" id="2"/>
 <connector anchor="true" x="85" y="0" id="3" slider="true"><slidelimit id="0"/><slidelimit id="2"/></connector>
 <connector anchor="true" x="175" y="0" id="4" slider="true"><slidelimit id="0"/><slidelimit id="2"/></connector>
 <connector anchor="true" input="true" rpm="-15" x="340" y="30" id="5"/><connector x="360" y="75" id="6"/>
 <Link id="0"><connector id="0"/><connector id="1"/><connector id="2"/></Link>
 <Link id="1"><connector id="3"/></Link><Link id="2"><connector id="4"/></Link>
 <Link id="3"><connector id="5"/><connector id="6"/></Link><Link id="4"><connector id="1"/><connector id="6"/></Link>
</linkage2>"""
ACTUATOR = """<linkage2>
 <connector anchor="true" x="0" y="0" id="0"/><connector x="60" y="80" id="1"/>
 <connector anchor="true" x="100" y="0" id="2"/>
 <Link id="0" actuator="true" throw="20" cpm="15"><connector id="0"/><connector id="1"/></Link>
 <Link id="1" name="boom"><connector id="2"/><connector id="1"/></Link>
 <Link id="2" gear="true"><connector id="2"/></Link>
 <ratios><ratio type="gears"><link id="1" size="1"/><link id="2" size="2"/></ratio></ratios>
</linkage2>"""
ORBIT = """<linkage2>
 <connector id="2" x="-40" y="0" anchor="true"/><connector id="4" x="0" y="0" anchor="true" input="true" rpm="3"/>
 <connector id="6" x="90" y="0"/><connector id="0" x="135" y="0"/><connector id="1" x="135" y="40"/>
 <connector id="7" x="160" y="10" fastenlink="2"/>
 <Link id="0" gear="true"><connector id="6"/></Link><Link id="1" fastenlink="2" gear="true"><connector id="0"/></Link>
 <Link id="4" fastenconnector="2" gear="true"><connector id="4"/></Link><Link id="3"><connector id="2"/></Link>
 <Link id="5"><connector id="4"/><connector id="6"/><connector id="0"/></Link>
 <Link id="2"><connector id="0"/><connector id="1"/></Link>
 <ratios><ratio type="gears"><link id="0" size="8.000000"/><link id="1" size="1.000000"/></ratio>
 <ratio type="chain" sizeassize="true"><link id="4" size="25"/><link id="0" size="25"/></ratio></ratios>
</linkage2>"""
PLANETARY = """mech=
ground,sun,R,0,0,0.0,tfft
sun,planet,G,20,0,0.0,tfff
planet,arm,R,50,0,0,tfff
planet,R,60,10,0,tfff
arm,ground,R,0,0,0,tfff
planet,ground,G,80,0,0,tfff"""
OLD_PMKS = """mech=
ground,input,R,0,0,0.0,tfft
input,rod,R,0,35,0,tfff
rod,out,R,100,60,0,tfff
out,ground,R,110,0,0,tfff"""
TABLE = """joints
id,x,y,links,type,ground,angle,input
A,0,0,AB,R,true,Null,true
B,0,35,"AB,BC",R,false,Null,false
C,80,0,"BC,CD",R,false,Null,false
D,80,0,CD,P,true,0,false

links
id,type
AB,R

settings
speed,cw,gravity,unit
10,true,false,cm
"""
ADDRESS = ("https://pmksplus.mech.website/?j=A,0,0,AB,R,t,0,0.1,t,%0AB,0,35,AB%7CBC,R,f,0,0.1,f,%0A"
           "C,100,60,BC%7CCD,R,f,0,0.1,f,%0AD,110,0,CD,R,t,0,0.1,f,%0A&l=AB,1,1,1,1,A%7CB,,l%0A"
           "&f=&pp=&tp=&s=10,false,false,m")
LATE = """--- j ---
Joint ID,Joint Name,X Position,Y Position,Joint Type,Angle,Grounded?,Is Input?,Input Speed,Is Welded?
0,A,0,0,1,0,true,true,-10,false
1,B,0,35,1,0,false,false,10,false
2,C,80,0,0,0,false,false,10,false

--- l ---
Link ID,Link Name,Mass,Color,Center of Mass X,Center of Mass Y,Joint IDs
0,AB,0,#fff,0,0,0|1
1,BC,0,#fff,0,0,1|2
"""
SLIDER_CRANK = """
[points]
A = [0, 0]
B = [0, 35]
C = [80, 0]
[links]
AB = "A B"
BC = "B C"
block = "C"
frame = "A"
[[slides]]
link = "block"
along = "frame"
at = "C"
direction = [1, 0]
[[drive]]
link = "AB"
rpm = -10
"""

SAMPLES: dict[str, tuple[bytes, str]] = {
    "circles.ggb": (CIRCLES, places(A=0j, B=B, C=C, D=6 + 0j, M=(B + C) / 2) + """
        [links]
        1 = "A B"
        2 = "B C M"
        3 = "C D"
        frame = "A D"
        [[drive]]
        link = "1"
        omega = 1"""),
    "handle.ggb": (HANDLE, places(A=0j, B=B, C=C, D=6 + 0j) + FOUR_BAR[FOUR_BAR.index("[links]"):] + "omega = 1"),
    "helpers.ggb": (HELPERS, places(A=0j, B=B, C=C, D=6 + 0j, E=crossed(B, 3, C, 2.5), M=(B + C) / 2) + """
        [links]
        1 = "A B"
        2 = "B C E M"
        3 = "C D"
        frame = "A D"
        [[drive]]
        link = "1"
        omega = 1"""),
    "turned.ggb": (TURNED, places(O=0j, A=PIN, B=complex(END)) + """
        [links]
        1 = "O A"
        2 = "A B"
        3 = "B"
        frame = "O"
        [[slides]]
        link = "3"
        along = "frame"
        at = "B"
        direction = [1, 0]
        [[drive]]
        link = "1"
        omega = 1"""),
    "spoke.ggb": (SPOKE, places(O=0j, A=PIN, B=complex(END)) + """
        [links]
        1 = "O A"
        2 = "A B"
        3 = "B"
        frame = "O"
        [[slides]]
        link = "3"
        along = "frame"
        at = "B"
        direction = [1, 0]
        [[drive]]
        link = "1"
        omega = 1"""),
    "quick.ggb": (QUICK, places(O=3j, P=0j, A=BLOCK, B=ARM) + """
        [links]
        1 = "O A"
        2 = "A"
        3 = "P B"
        frame = "O P"
        [[slides]]
        link = "2"
        along = "3"
        at = "A"
        direction = "P B"
        [[drive]]
        link = "1"
        omega = 1"""),
    "triangle.ggb": (TRIANGLE, FRAME.replace("D =", "E = [50, 90]\nD =").replace('"B C"', '"B C E"')
                     + '[[drive]]\nlink = "1"\nomega = 1'),
    "four-bar.linkage2": (LINKAGE.encode(), FOUR_BAR + "rpm = -30"),
    "slotted.linkage2": (SLOTTED.encode(), """
        [points]
        A = [0, 0]
        B = [70, 64]
        C = [250, 0]
        F = [340, 30]
        G = [360, 75]
        [links]
        1 = "A B C"
        2 = "F G"
        3 = "B G"
        frame = "F"
        [[slides]]
        link = "1"
        along = "frame"
        at = "A"
        direction = [1, 0]
        [[drive]]
        link = "2"
        rpm = 15"""),
    "actuator.linkage2": (ACTUATOR.encode(), """
        [points]
        A = [0, 0]
        B = [60, 80]
        C = [100, 0]
        [links]
        barrel = "A"
        rod = "B"
        boom = "C B"
        frame = "A C"
        [[slides]]
        link = "rod"
        along = "barrel"
        at = "B"
        direction = "A B"
        [[drive]]
        slide = ["rod", "barrel"]
        speed = 10"""),
    "orbit.linkage2": (ORBIT.encode(), """
        [points]
        A = [0, 0]
        B = [90, 0]
        C = [135, 0]
        D = [135, 40]
        E = [160, 10]
        [links]
        1 = "A B C"
        2 = "B"
        3 = "C D E"
        frame = "A"
        [[gears]]
        links = ["2", "3"]
        centres = ["B", "C"]
        teeth = [8, 1]
        [[gears]]
        links = ["frame", "2"]
        centres = ["A", "B"]
        teeth = [25, 25]
        belt = "open"
        [[drive]]
        link = "1"
        rpm = -3"""),
    "planetary.txt": (PLANETARY.encode(), """
        [points]
        A = [0, 0]
        A2 = [0, 0]
        B = [50, 0]
        C = [60, 10]
        [links]
        sun = "A"
        planet = "B C"
        arm = "B A2"
        frame = "A A2"
        [[gears]]
        links = ["sun", "planet"]
        centres = ["A", "B"]
        radii = [20, 30]
        [[gears]]
        links = ["planet", "frame"]
        centres = ["B", "A"]
        teeth = [3, 8]
        internal = true
        [[drive]]
        link = "sun"
        omega = 1"""),
    "old.txt": (OLD_PMKS.encode(), FOUR_BAR + "omega = 1"),
    "table.csv": (TABLE.encode(), "[units]\nlength = 'cm'" + SLIDER_CRANK),
    "late.csv": (LATE.encode(), SLIDER_CRANK),
    "address.txt": (ADDRESS.encode(), "[units]\nlength = 'm'" + FOUR_BAR.replace('"A B"', '"A B S"').replace(
        "[links]", "S = [1, 1]\n[links]") + "rpm = 10\n[masses.1]\nmass = 1\ncentre = 'S'\n[balance]\nlink = '1'"),
}

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"


def _based(number: int) -> str:
    letters = ""
    rest = abs(number)
    while rest or not letters:
        letters, rest = DIGITS[rest % 64] + letters, rest // 64
    return "0" + letters if number < 0 else letters


def short(joints: dict[str, tuple[int, complex]], links: dict[str, str], rpm: int) -> bytes:
    """A short address of PMKS+: joints with their flags and places, links with their joints, clockwise."""
    rows = [DIGITS[flags] + ",".join([name, name, *(_based(round(1000 * part)) for part in (at.real, at.imag)), "0"])
            for name, (flags, at) in joints.items()]
    bars = ["Y" + ("P" if name.startswith("P") else "R") + ",".join([name, name, *"0000", "", *held, "", ""])
            for name, held in links.items()]
    whole = ".".join(["01", "TY", f"{_based(rpm)},0", "101", *rows, "", *bars, "", "", "N_"])
    return f"https://app.pmksplus.com/?{whole}{DIGITS[len(whole) % 62]}".encode()


def stamped(whole: str) -> str:
    """What an address says, with the letter of its length and the digest after it."""
    checked, digest = whole + DIGITS[len(whole) % 62], 2166136261
    for letter in checked:
        digest = (digest ^ ord(letter)) * 16777619 % 2**32
    return f"{checked}*{''.join(DIGITS[digest // 62**power % 62] for power in range(5, -1, -1))}"


def packed(text: str) -> str:
    """A text packed by LZ-string, though no shorter: of what came before single characters alone are used."""
    bits: list[int] = []
    codes: dict[str, int] = {}
    size, width, room = 3, 2, 4

    def put(number: int, wide: int) -> None:
        bits.extend(number >> place & 1 for place in range(wide))

    def grow(many: int) -> None:
        nonlocal size, width, room
        for _ in range(many):
            size, room = size + 1, room - 1
            if not room:
                width, room = width + 1, 2**width

    for place, letter in enumerate(text):
        if letter in codes:
            put(codes[letter], width)
        else:
            put(0, width)
            put(ord(letter), 8)
            codes[letter] = size
            if place:
                grow(1)
            else:
                size, width = size + 1, 3
        if place:
            grow(1)
    put(2, width)
    bits.extend([0] * (-len(bits) % 6))
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-"
    return "".join(letters[sum(bit << 5 - k for k, bit in enumerate(bits[i : i + 6]))] for i in range(0, len(bits), 6))


SAMPLES["short.txt"] = (short({"A": (22, 0j), "B": (16, 35j), "C": (16, 80 + 0j), "D": (21, 80 + 0j)},
                              {"AB": "AB", "BC": "BC", "PCD": "CD"}, 10), "[units]\nlength = 'cm'" + SLIDER_CRANK)
DATA = ('{"j":[["0~A~0~0~1~0~y~y~-a~n~n~n~n--1~B~0~23~1~0~n~n~a~n~n~n~n--2~C~50~0~0~0~n~n~a~n~n~n~n"]]_"l":'
        '[["0~AB~0~#7"_-2.5_1.5_"0|1~~n"_2.5_78.6]_["1~BC~0~#2"_0.2_1.7_"1|2~~n"_5.7_"0"]]_"c":"~t":"~f":"~p":""}')
SAMPLES["data.txt"] = (f"https://app.pmksplus.com/?data={packed(DATA)}".encode(), SLIDER_CRANK)


# ---- scenes in the formats of others ---------------------------------------------------------------------------------


def turning(scene: Scene) -> bool:
    """Whether cranks on the frame drive it."""
    return bool(scene.drives) and not scene.motions and all(
        drive.on == "frame" and not drive.slides and {*scene.links[drive.link]} & {*scene.links.get("frame", ())}
        for drive in scene.drives)


def rpm(drive: Drive) -> float:
    return float(drive.rate) * 30 / math.pi


def as_linkage(scene: Scene) -> bytes:
    """A scene of revolute pairs alone as a file of Linkage."""
    keys = {name: str(place) for place, name in enumerate(scene.points)}
    fixed = {*scene.links["frame"]}
    inputs = {next(name for name in scene.links[drive.link] if name in fixed): drive for drive in scene.drives}
    rows = [f'<connector id="{keys[name]}" name="{name}" x="{float(x)!r}" y="{float(y)!r}"'
            + (' anchor="true"' if name in fixed else "")
            + (f' input="true" rpm="{-rpm(inputs[name])!r}"' if name in inputs else "") + "/>"
            for name, (x, y) in scene.points.items()]
    rows += ["<Link>" + "".join(f'<connector id="{keys[name]}"/>' for name in points) + "</Link>"
             for link, points in scene.links.items() if link != "frame"]
    return f"<linkage2>{''.join(rows)}</linkage2>".encode()


def as_pmks(scene: Scene) -> bytes:
    """A scene with one drive as a text of PMKS."""
    drive = scene.drives[0]
    lines = []
    for name, links in ((name, links) for name, links in scene.links_of.items() if links):
        held = ["ground" if link == "frame" else f"L{link}" for link in links]
        driver = drive.link in links and "frame" in links and not any(line.endswith("tfft") for line in lines)
        x, y = map(float, scene.points[name])
        lines.append(f"{','.join(held)},R,{x!r},{y!r},0.0,tff{'t' if driver else 'f'}")
    for slide in scene.slides:
        x, y = map(float, scene.points[slide.at])
        angle = math.degrees(math.atan2(*map(float, reversed(slide.direction))))
        along, link = ("ground" if name == "frame" else f"L{name}" for name in (slide.along, slide.link))
        lines.append(f"{along},{link},P,{x!r},{y!r},{angle!r},tfff")
    return "\n".join([*lines, f"s={float(drive.rate)!r}"]).encode()


def as_address(scene: Scene) -> bytes:
    """A scene as an address of PMKS+ of 2026: slots on links, own speeds, numbers in full, a digest.

    Empty of one with a guide that is through no two points of its link.
    """
    keys = {name: f"p{place}" for place, name in enumerate(scene.links_of)}
    held = {link: [keys[name] for name in points if name in keys] for link, points in scene.links.items()}
    inputs = {next(name for name in scene.links[drive.link] if name in scene.links["frame"]): drive
              for drive in scene.drives}
    joints, precise = [], []

    def joint(key: str, flags: int, at: tuple[Any, Any], angle: float, *cells: str, speed: float = 0) -> None:
        numbers = {0: float(at[0]), 1: float(at[1]), 2: angle, 3: speed}
        precise.extend(f"PJ{key}~{place}~{number!r}" for place, number in numbers.items() if number)
        joints.append(",".join([f"{DIGITS[flags]}{key}", key, *(_based(round(1000 * numbers[k])) for k in range(3)), *(
            [*(cells or [""] * 3), _based(round(1000 * speed))] if speed else cells)]))

    for name, key in keys.items():
        joint(key, 4 * ("frame" in scene.links_of[name]) + 2 * (name in inputs), scene.points[name], 0.0,
              speed=rpm(inputs[name]) if name in inputs else 0)
    for place, slide in enumerate(scene.slides):
        way = complex(*map(float, slide.direction))
        ends = [pair for pair in combinations(scene.links.get(slide.along, ()), 2) if abs((way.conjugate() * (
            complex(*map(float, scene.points[pair[1]])) - complex(*map(float, scene.points[pair[0]])))).imag) < 1e-9]
        if slide.along == "frame":
            joint(f"s{place}", 13, scene.points[slide.at], cmath.phase(way))
        elif ends:
            joint(f"s{place}", 9, scene.points[slide.at], 0.0, slide.along, *(keys[end] for end in ends[0]))
        else:
            return b""
        held[slide.link].append(f"s{place}")
    links = ["Y" + ("P" if len(scene.links[link]) == 1 else "R") + ",".join([link, link, *"0000", "", *points, "", ""])
             for link, points in held.items() if link != "frame"]
    whole = ".".join(["00", "RE,1E8", "A,0", "2111", *joints, "", *links, "", "", "N_", ",".join(precise)])
    return f"https://app.pmksplus.com/?{quote(stamped(whole), safe='*,')}".encode()


def as_drawing(scene: Scene) -> bytes:
    """A scene of revolute pairs alone as a drawing in GeoGebra: bars between all points of a link, pins made fixed."""
    fixed = {*scene.links["frame"]}
    points = [point(name, complex(*map(float, at)), fixed=name in fixed) for name, at in scene.points.items()]
    bars = [f"{one} {other}" for link, held in scene.links.items() if link != "frame"
            for one, other in combinations(held, 2)]
    return geogebra(*points, segments(*bars))
