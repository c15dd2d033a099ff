"""The board on which hand drawings are made, and the one table of the mistakes that are made on it.

A drawing has the marks that a textbook names, each from the student's own earlier marks: nothing here knows graphplan's
writers, programs or solver. Every place in which a mistake can be made is a method of the board: a mark is put, a
vector laid off, a locus drawn, a start chosen, a figure made similar. A seed gives the same drawing.
"""

from __future__ import annotations

import cmath
import math
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

Points = dict[str, complex]
WOBBLE_MM, FLATTEST_DEG, LEAST_MM, HEAD_MM = 0.08, 25.0, 5.0, 3.0
NORMAL = re.compile(r"n_([A-Z]\d?)([A-Z])")


class Unfit(Exception):
    """A drawing that no teacher would set, or in which a mistake would not be seen."""


@dataclass(frozen=True)
class Fault:
    """What a student did: a kind, the mark at which he did it, and by which number."""

    kind: str
    mark: str
    by: complex = 1.0


@dataclass
class Board:
    """A drawing in the making, in mm: its marks by their plan and letter, and the strokes between them."""

    chance: random.Random
    fault: Fault | None = None
    marks: dict[tuple[str, str], complex] = field(default_factory=dict)
    strokes: list[tuple[complex, complex]] = field(default_factory=list)
    arcs: list[tuple[complex, complex, complex]] = field(default_factory=list)  # centre, and ends counterclockwise
    arrows: list[tuple[complex, complex]] = field(default_factory=list)  # the strokes that have a head
    forms: Callable[[Board, str, complex], None] | None = None  # draws the figure in which a vector is found
    done: bool = False  # whether the mistake was made

    def is_made_at(self, name: str, *at: str) -> bool:
        """Whether the mistake is made here, where such mistakes are made."""
        self.done |= (made := bool(self.fault and self.fault.mark == name and MISTAKES[self.fault.kind].at in at))
        return made

    def put(self, plan: str, letter: str, at: complex, *, stroke_from: complex | None = None, head: bool = False
            ) -> complex:
        """Mark a point, with the wobble of a hand, and the mistake if it is made here."""
        if self.fault and self.is_made_at(letter, "slips"):
            at += self.fault.by
        at += complex(self.chance.gauss(0, WOBBLE_MM), self.chance.gauss(0, WOBBLE_MM))
        if plan:
            self.marks[plan, letter] = at
        if stroke_from is not None:
            self.strokes.append((stroke_from, at))
            self.arrows += [(stroke_from, at)] * head
        return at

    def vector(self, name: str, right: complex) -> complex:
        """A vector of this name as the student lays it off, found by a figure of its own where he has one."""
        if self.forms:
            self.forms(self, name, right)
        return right * self.fault.by if self.fault and self.is_made_at(name, "vectors", "radii") else right

    def along(self, name: str, right: complex, others: dict[str, complex]) -> complex:
        """The direction of a locus as the student draws it: turned by a right angle, or that of another side."""
        if self.fault and self.is_made_at(name, "loci"):
            if self.fault.kind == "right angle":
                return right * 1j
            if others:
                return others[sorted(others)[int(self.fault.by.real) % len(others)]]
            self.done = False
        return right

    def start(self, name: str, right: complex, other: complex) -> complex:
        """Where a vector is laid off from, or a locus is drawn through."""
        return other if self.is_made_at(name, "starts") else right

    def ratio(self, name: str, right: complex) -> complex:
        """The place of a third point in the figure of two, seen from the first: mirrored by mistake."""
        return right.conjugate() if self.is_made_at(name, "figures") else right


def meet(P: complex, u: complex, Q: complex, w: complex) -> complex:
    """Where the line through P along u meets that through Q along w."""
    sine = (u.conjugate() * w).imag
    if abs(sine) < math.sin(math.radians(FLATTEST_DEG)) * abs(u) * abs(w):
        raise Unfit("flat")
    return P + u * ((Q - P).conjugate() * w).imag / sine


def third(P: complex, r: float, Q: complex, s: float, side: int) -> complex:
    """The corner of a triangle over PQ."""
    d = abs(Q - P)
    x = (d * d + r * r - s * s) / (2 * d)
    if r * r - x * x < (0.3 * min(r, s)) ** 2:
        raise Unfit("no triangle")
    return P + (Q - P) / d * complex(x, side * math.sqrt(r * r - x * x))


@dataclass(frozen=True)
class Task:
    """A mechanism in lengths of its scene: its file, its points, and how it is drawn in mm, by its plan."""

    kind: str
    scene: str  # the text of its file, or the name of a packaged one
    points: Points
    omega: float
    draw: Callable[[Task, Board, Places], None]
    plan: str
    vectors: tuple[str, ...]  # the names at which vectors are laid off
    loci: tuple[str, ...]
    figures: tuple[str, ...]
    pairs: tuple[tuple[str, str], ...]  # letters that are exchanged
    slips: tuple[str, ...]
    whole: tuple[str, ...]  # plans that may be wrong as a whole

    @property
    def options(self) -> tuple[str, ...]:
        """How the sheet of the task is asked for."""
        return ("--plan", self.plan) if self.plan in ("polar", "polygons", "lever") else ()

    def radius_ratios(self, name: str) -> list[float]:
        """How many times as long a normal acceleration is that is computed with the length of another link."""
        ends = NORMAL.fullmatch(name)
        sides = re.findall(r'= "(\w+) (\w+)', self.scene)
        if not ends:
            return []
        own, *others = (abs(self.points[one] - self.points[other]) for one, other in (ends.groups(), *sides)
                        if one in self.points and other in self.points)
        return [own / side for side in others if abs(math.log(own / side)) > 0.15]


@dataclass(frozen=True)
class Places:
    """Where the plans lie, and mm for a unit: of lengths, of speeds, of accelerations or forces."""

    mechanism: complex
    first: complex
    second: complex
    k: float
    kv: float
    ka: float


# ---- mistakes --------------------------------------------------------------------------------------------------------


By = Callable[[random.Random, Task, str], complex | None]  # by which number, at this mark of a task; none: not there


@dataclass(frozen=True)
class Mistake:
    """What is done to a drawing, at which of its places, by which number, and what the judge must say of it."""

    at: str
    by: By
    told: str  # a regular expression; of a slip of the hand nothing need be told

    def marks(self, task: Task) -> Iterator[str]:
        """Where it can be made in the drawing of a task."""
        places = {"starts": task.vectors, "radii": task.vectors, "pairs": tuple(map("+".join, task.pairs))}
        yield from places.get(self.at) or getattr(task, self.at, ())


def one_of(*factors: complex) -> By:
    return lambda chance, task, mark: chance.choice(factors)


def radius(chance: random.Random, task: Task, mark: str) -> complex | None:
    return chance.choice(ratios) if (ratios := task.radius_ratios(mark)) else None


def once(chance: random.Random, task: Task, mark: str) -> complex:
    return 1.0


LENGTH = "times as long|times as large|radius"
MISTAKES = {
    "reversed": Mistake("vectors", one_of(-1), "reversed|opposite|wrong sense"),
    "omitted": Mistake("vectors", one_of(0), "omitted"),
    "quarter turn": Mistake("vectors", one_of(1j, -1j), "turned|direction"),
    "halved": Mistake("vectors", one_of(0.5), f"halved|{LENGTH}"),
    "doubled": Mistake("vectors", one_of(2), f"doubled|{LENGTH}"),
    "wrong radius": Mistake("radii", radius, f"halved|doubled|{LENGTH}"),
    "wrong start": Mistake("starts", once, "laid off from|drawn through|start"),
    "right angle": Mistake("loci", lambda chance, task, mark: chance.randrange(2), "perpendicular|parallel"),
    "wrong side": Mistake("loci", lambda chance, task, mark: chance.randrange(2),
                          "parallel|perpendicular|drawn through"),
    "mirrored figure": Mistake("figures", once, "mirrored"),
    "letters": Mistake("pairs", once, "exchanged"),
    "slip": Mistake("slips", lambda chance, task, mark: cmath.rect(chance.uniform(6, 20), chance.uniform(0, 6.28)), ""),
    "plan reversed": Mistake("whole", one_of(-1.0), "reversed"),
    "plan turned": Mistake("whole", one_of(cmath.rect(1, math.radians(30))), "turned"),
    "plan turned back": Mistake("whole", one_of(cmath.rect(1, math.radians(-50))), "turned"),
    "plan of another scale": Mistake("whole", one_of(1.7), "times as large|k_v"),
    "sign": Mistake("numbers", one_of(-1), "the sign is reversed"),
    "turned number": Mistake("numbers", one_of(1j), "a quarter turn off"),
    "factor of ten": Mistake("numbers", one_of(10), "10 times as large as it should be"),
}
WHOLE = sorted(kind for kind, mistake in MISTAKES.items() if mistake.at == "whole")
NUMBERS = sorted(kind for kind, mistake in MISTAKES.items() if mistake.at == "numbers")
ONCE = [kind for kind in MISTAKES if kind not in (*WHOLE, *NUMBERS)]  # of which a drawing has one

SCALE_OF_TWO = {"P": ("II", "III"), "ao": ("a_o", "m_o")}  # who knows no scale cannot tell which of two is too long
SHOWS = {  # marks that show that a vector is wrong, as regular expressions
    "n_BA": (r"b'", "B_1", r"n_b\(2\)", "b", "n_2", r"(B about A|A about B)", "a_BA"),
    "n_BC": (r"b'", "B_1", r"n_c\(3\)", "c", "n_3", r"(B about C|C about B)", r"n_b\(3\)"),
    "n_ED": (r"e'", "n_4", r"(E about D|D about E)", r"n_[ed]\(4\)", "e", "E_1"),
    "n_EF": (r"e'", "n_5", r"(E about F|F about E)", r"n_[ef]\(5\)", "f", "E_1"),
    "n_A3C": (r"a3'", "n_3", r"n_c\(3\)", r"(A3 about C|C about A3)", "c", "A3_1"),
    "cor": (r"a3'", "Coriolis", "k_A", "k_A3A", "a3", "A3_1"),
    "n_EK": (r"e'", "n_4", r"(E about K|K about E)", r"n_[ek]\(4\)"),
    "P": ("II", "P_2", *SCALE_OF_TWO["P"]), "T": ("III", "T_12", "T_1", *SCALE_OF_TWO["P"]),
    "ao": SCALE_OF_TWO["ao"], "mo": SCALE_OF_TWO["ao"]}


def place_named(fault: Fault, words: str) -> bool:
    """Whether what is told names the mark at which a mistake was made, its vector, or the mark that shows it."""
    if fault.mark in SHOWS:
        return bool(re.search("|".join(f"(^|[| ]){one}($|[| ,:])" for one in (fault.mark, *SHOWS[fault.mark])), words))
    marks = fault.mark.partition(" by ")[0].split("+")
    ends = [f"{mark.rstrip(chr(39)).upper()}_1" for mark in marks if mark.endswith("'")]
    return any(re.search(rf"(^|[| ]){re.escape(form)}($|[| ,:])", words)
               for form in (*marks, *(f"v_{mark}" for mark in marks), *ends))


def cause_named(fault: Fault, mistake: object) -> bool:
    """Whether what is told of a mistake names what was done."""
    # turned by a right angle, a vector without a mark of its own lies on its locus, which is where it is without it
    also = "|omitted" if fault.kind == "quarter turn" and fault.mark == "T" else ""
    # and of two vectors that tell the scale one too long is the other too short
    of_two = fault.mark in {*SCALE_OF_TWO, "T", "mo"} and fault.kind in ("halved", "doubled")
    also += "|halved|doubled" if of_two else ""
    return bool(re.search(MISTAKES[fault.kind].told + also, str(mistake or "")))
