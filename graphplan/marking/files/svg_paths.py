"""Path data of SVG as chains of spots: straight pieces, and curves by enough spots to know them again."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from graphplan.marking.files.svg_space import NUMBER

TOKEN = re.compile(rf"[MmZzLlHhVvCcSsQqTtAa]|{NUMBER}")
FLAGS = re.compile(r"[\s,]*([01])")
COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
PARTS = 8  # a curve by so many stretches
PARTED = {n: [tuple(math.comb(n - 1, k) * (i / PARTS) ** k * (1 - i / PARTS) ** (n - 1 - k) for k in range(n))
              for i in range(PARTS + 1)] for n in (3, 4)}  # by the number of poles


@dataclass
class Chain:
    """Spots one after the other, in user units; `smooth` where curves join them."""

    smooth: bool
    spots: list[complex]


def chains(data: str) -> Iterator[Chain]:
    """The chains of a path: a new one wherever the pen is lifted, or goes over from straight pieces to curves.

    Fails with `ValueError` where the data are no path.
    """
    chain: Chain | None = None
    pen = _Pen()
    for command, numbers in _commands(data):
        lifted = command in "Mm"
        smooth, spots = pen.moved(command, numbers)
        if chain is not None and (lifted or smooth != chain.smooth):
            yield chain
            chain = None
        if not lifted and spots:
            chain = chain or Chain(smooth, [spots[0]])
            chain.spots += spots[1:]
    if chain is not None:
        yield chain


def _commands(data: str) -> Iterator[tuple[str, list[float]]]:
    """Each command with its numbers; repeated numbers repeat it, after a move as lines."""
    place, command = 0, ""
    while found := TOKEN.search(data, place):
        if not _blank(data, place, found.start()):
            raise ValueError(f"{data[place:found.start()].strip()[:20]!r} is no path")
        if found[0].isalpha():
            command, place = found[0], found.end()
        elif not command or command in "Zz":
            raise ValueError("numbers without a command are no path")
        numbers, place = _numbers(data, place, command.upper())
        yield command, numbers
        command = {"M": "L", "m": "l"}.get(command, command)
    if not _blank(data, place, len(data)):
        raise ValueError(f"{data[place:].strip()[:20]!r} is no path")


def _blank(data: str, start: int, end: int) -> bool:
    return not data[start:end].strip(" ,\t\r\n")


def _numbers(data: str, place: int, command: str) -> tuple[list[float], int]:
    """The numbers of one command, and where they end; the flags of an arc may stand without blanks."""
    numbers = []
    for i in range(COUNT[command]):
        flag = command == "A" and i in (3, 4)
        found = FLAGS.match(data, place) if flag else TOKEN.search(data, place)
        if found is None or (not flag and found[0].isalpha()):
            raise ValueError(f"{command} lacks numbers")
        numbers.append(float(found[1] if flag else found[0]))
        place = found.end()
    return numbers, place


class _Pen:
    """Where the pen is, where it was set down, and the last handle of a curve."""

    def __init__(self) -> None:
        self.at = self.begun = 0j
        self.handle: tuple[str, complex] | None = None

    def moved(self, command: str, numbers: list[float]) -> tuple[bool, list[complex]]:
        """The spots that a command goes through, the first of them where it begins, and whether it is a curve."""
        name, start = command.upper(), self.at
        base = start if command.islower() else 0j
        if name in "HV":
            here = start.imag if name == "H" else start.real
            fixed = complex(numbers[0] + base.real, here) if name == "H" else complex(here, numbers[0] + base.imag)
            ends = [fixed]
        elif name == "A":
            ends = [base + complex(*numbers[5:])]
        elif name == "Z":
            ends = [self.begun]
        else:
            ends = [base + complex(x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
        self.at = ends[-1]
        if name == "M":
            self.begun = self.at
        if name == "Z" and start == self.at:
            return False, []
        poles = self._poles(name, start, ends)
        self.handle = (name, poles[-2]) if name in "CSQT" else None
        if name == "A":
            return True, _arc(start, numbers, self.at)
        return (True, _bezier(poles)) if name in "CSQT" else (False, [start, self.at])

    def _poles(self, name: str, start: complex, ends: list[complex]) -> list[complex]:
        """The poles of a curve; that of a smooth continuation mirrors the last handle."""
        if name not in "ST":
            return [start, *ends]
        family = "CS" if name == "S" else "QT"
        last = self.handle[1] if self.handle and self.handle[0] in family else start
        return [start, 2 * start - last, *ends]


def _bezier(poles: list[complex]) -> list[complex]:
    """Spots of a Bezier curve, by Bernstein's polynomials."""
    return [sum([part * pole for part, pole in zip(parts, poles, strict=True)], 0j) for parts in PARTED[len(poles)]]


def _arc(start: complex, numbers: list[float], end: complex) -> list[complex]:
    """Spots of an elliptical arc, by its centre as the SVG standard finds it (appendix on arc parameters)."""
    rx, ry, tilt, large, left = abs(numbers[0]), abs(numbers[1]), numbers[2], numbers[3], numbers[4]
    if not rx or not ry or start == end:
        return [start, end]
    turn = cmath.exp(1j * math.radians(tilt))

    def flat(z: complex) -> complex:
        """Where the ellipse is the unit circle."""
        z = z / turn
        return complex(z.real / rx, z.imag / ry)

    a, b = flat(start), flat(end)
    half = (b - a) / 2
    stretch = max(1.0, abs(half))  # radii too small are enlarged
    rise = math.sqrt(max(0.0, stretch**2 - abs(half) ** 2)) / abs(half)
    centre = (a + b) / 2 + half * (1j if large != left else -1j) * rise
    first = cmath.phase(a - centre)
    sweep = cmath.phase((b - centre) / (a - centre))
    sweep += 2 * math.pi * ((sweep < 0) if left else -(sweep > 0))
    inner = [centre + stretch * cmath.exp(1j * (first + sweep * i / PARTS)) for i in range(1, PARTS)]
    return [start, *(turn * complex(rx * z.real, ry * z.imag) for z in inner), end]
