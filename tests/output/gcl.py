"""A reader of the part of the GCLC language that exports use, with that engine's own arithmetic and tolerances."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

EPS = 0.00001  # what the engine takes for nothing
PI = 3.1415925  # as the engine has it
Value = tuple[Any, ...]


class Wrong(Exception):
    """The engine would stop here."""


@dataclass
class Reader:
    """The objects of a source, by name: ("point", x, y), ("line", a, b, c), ("circle", x, y, r), ("number", n)."""

    objects: dict[str, Value] = field(default_factory=dict)
    procedures: dict[str, tuple[list[str], str]] = field(default_factory=dict)
    drawn: list[tuple[str, ...]] = field(default_factory=list)

    def read(self, source: str) -> Reader:
        tokens = iter(list(split(source)))
        for command in tokens:
            self.obey(command, lambda: next(tokens))
        return self

    # ---- arguments ---------------------------------------------------------------------------------------------

    def get(self, kind: str, name: str) -> Value:
        value = self.objects.get(name)
        if value is None or value[0] != kind:
            raise Wrong(f"{name} is no {kind} here but {value}")
        return value[1:]

    def number(self, text: str) -> float:
        return convert(text) if re.fullmatch(r"-?[\d.]+([eE]-?\d+)?", text) else self.get("number", text)[0]

    def value(self, expression: str) -> float:
        read = re.findall(r"(?<![\w.])[A-Za-z]\w*\b(?!\s*\()", expression)
        names = {name: self.get("number", name)[0] for name in read}
        functions = {"sqrt": math.sqrt, "abs": abs, "max": max, "ite": lambda test, yes, no: yes if test else no}
        return float(eval(expression.strip(), {"__builtins__": {}}, {**names, **functions}))

    # ---- commands ----------------------------------------------------------------------------------------------

    def obey(self, command: str, take: Callable[[], str]) -> None:
        rule = getattr(self, f"do_{command}", None)
        if rule is not None:
            rule(take)
        elif command in SHAPES:
            (*read, make), name = SHAPES[command], take()
            given = [self.number(take()) if kind == "number" else self.get(kind, take()) for kind in read]
            self.objects[name] = make(*given)
        elif command in DRAWN or re.fullmatch(r"printat(_[lrtb]{1,2})?", command):
            kinds = DRAWN.get(command, ("point", "text"))
            texts = [take() for _ in kinds]
            for kind, text in zip(kinds, texts, strict=True):
                if kind in ("point", "circle"):
                    self.get(kind, text)
                elif kind == "number":
                    self.number(text)
            self.drawn.append((command, *texts))
        else:
            raise Wrong(f"no command {command}")

    def do_expression(self, take: Callable[[], str]) -> None:
        name = take()
        self.objects[name] = ("number", self.value(take()))

    def do_set_equal(self, take: Callable[[], str]) -> None:
        name = take()
        self.objects[name] = self.objects[take()]

    def do_intersec2(self, take: Callable[[], str]) -> None:
        names, (one, other) = (take(), take()), sorted((self.objects[take()], self.objects[take()]), key=lambda v: v[0])
        found = struck(one[1:], other[1:]) if other[0] == "circle" else crossings(other[1:], one[1:])
        self.objects.update(zip(names, found, strict=True))

    def do_if_then_else(self, take: Callable[[], str]) -> None:
        test, yes, no = take(), take(), take()
        self.read(yes if self.value(test) else no)

    def do_procedure(self, take: Callable[[], str]) -> None:
        name = take()
        self.procedures[name] = take().split(), take()

    def do_call(self, take: Callable[[], str]) -> None:
        """Arguments go in by name and come back changed; nothing else of the caller is seen inside."""
        formal, block = self.procedures[take()]
        given = take().split()
        constant = [re.fullmatch(r"-?[\d.]+", text) is not None for text in given]
        inside = Reader(procedures=self.procedures, drawn=self.drawn)
        for name, text, fixed in zip(formal, given, constant, strict=True):
            inside.objects[name] = ("number", convert(text)) if fixed else self.objects.get(text, ("number", 0.0))
        inside.read(block)
        for name, text, fixed in zip(formal, given, constant, strict=True):
            if not fixed:
                self.objects[text] = inside.objects[name]


def split(source: str) -> Iterator[str]:
    """Words, and the texts between braces; a comment runs to the end of its line."""
    place = 0
    while found := re.compile(r"\s*(?:(%[^\n]*)|(\{)|([^\s{%]+))").match(source, place):
        place = found.end()
        if found[2]:
            start, depth = place, 1
            while depth:
                depth += {"{": 1, "}": -1}.get(source[place], 0)
                place += 1
            yield source[start : place - 1]
        elif found[3]:
            yield found[3]
    if source[place:].strip():
        raise Wrong(source[place:][:40])


def convert(text: str) -> float:
    """The engine's reading of a number: it loses the sign of one with an exponent."""
    return abs(float(text)) if "e" in text.lower() else float(text)


def line(P: Value, Q: Value) -> Value:
    (x, y), (u, v) = P, Q
    if abs(x - u) <= EPS and abs(y - v) <= EPS:
        raise Wrong("bad line")
    if abs(x - u) <= EPS:
        return "line", 1.0, 0.0, -x
    if abs(y - v) <= EPS:
        return "line", 0.0, 1.0, -y
    k = (u - x) / (y - v)
    return "line", 1.0, k, -(x + k * y)


def circle(P: Value, Q: Value) -> Value:
    if math.dist(P, Q) <= EPS:
        raise Wrong("bad circle")
    return "circle", *P, math.dist(P, Q)


def meet(k: Value, m: Value) -> Value:
    det = k[0] * m[1] - m[0] * k[1]
    if abs(det) <= EPS:
        raise Wrong("bad intersection")
    return "point", (k[1] * m[2] - m[1] * k[2]) / det, (m[0] * k[2] - k[0] * m[2]) / det


def perpendicular(P: Value, k: Value) -> Value:
    (x, y), (a, b, _) = P, k
    if abs(b) > EPS:
        return "line", 1.0, a / -b, (x * b - y * a) / -b
    return "line", -b / a, 1.0, (x * b - y * a) / a


def bisector(P: Value, Q: Value) -> Value:
    (x, y), (u, v) = P, Q
    c = x * x + y * y - u * u - v * v
    if abs(2 * u - 2 * x) > EPS:
        return "line", 1.0, (v - y) / (u - x), c / (2 * (u - x))
    return "line", (u - x) / (v - y), 1.0, c / (2 * (v - y))


def crossings(one: Value, other: Value) -> tuple[Value, Value]:
    """Of a line and a circle the one with the larger y first, or x where they are level."""
    (a, b, c), (x, y, r) = one, other
    across = abs(a) > EPS
    p, q = (a, b) if across else (b, a)
    c += a * x + b * y
    square = (a * a + b * b) * r * r - p * p * c * c
    if square < 0:
        raise Wrong("bad intersection")
    found = []
    for sign in (1, -1):
        second = (-q * c + sign * abs(p) * math.sqrt(square)) / (a * a + b * b)
        first = -(c + q * second) / p
        found.append(("point", x + first, y + second) if across else ("point", x + second, y + first))
    return found[0], found[1]


def struck(k: Value, m: Value) -> tuple[Value, Value]:
    """Of two circles the crossing with the smaller y first, or x where the centres stand over each other."""
    (x1, y1, r1), (x2, y2, r2) = k, m
    if not abs(r1 - r2) <= math.dist((x1, y1), (x2, y2)) <= r1 + r2 or math.dist((x1, y1), (x2, y2)) ** 2 < EPS:
        raise Wrong("bad intersection")
    level = abs(x1 - x2) >= EPS
    (p1, q1), (p2, q2) = ((x1, y1), (x2, y2)) if level else ((y1, x1), (y2, x2))
    d = r1 * r1 - r2 * r2 + x2 * x2 + y2 * y2 - x1 * x1 - y1 * y1
    e, f = d / (2 * (p2 - p1)), (q1 - q2) / (p2 - p1)
    a, b, c = 1 + f * f, 2 * e * f - 2 * q1 - 2 * f * p1, e * e - 2 * e * p1 + x1 * x1 + y1 * y1 - r1 * r1
    found = []
    for sign in (-1, 1):
        q = (-b + sign * math.sqrt(b * b - 4 * a * c)) / (2 * a)
        found.append(("point", e + f * q, q) if level else ("point", q, e + f * q))
    return found[0], found[1]


def turned(C: Value, angle: float, P: Value) -> Value:
    sin, cos = math.sin(2 * PI * angle / 360), math.cos(2 * PI * angle / 360)
    x, y = P[0] - C[0], P[1] - C[1]
    return "point", x * cos - y * sin + C[0], y * cos + x * sin + C[1]


P, N, L, C = "point", "number", "line", "circle"
SHAPES: dict[str, tuple[Any, ...]] = {
    "number": (N, lambda n: (N, n)),
    "point": (N, N, lambda x, y: (P, x, y)),
    "line": (P, P, line),
    "circle": (P, P, circle),
    "intersec": (L, L, meet),
    "midpoint": (P, P, lambda A, B: (P, (A[0] + B[0]) / 2, (A[1] + B[1]) / 2)),
    "med": (P, P, bisector),
    "perp": (P, L, perpendicular),
    "parallel": (P, L, lambda A, l: (L, l[0], l[1], -l[0] * A[0] - l[1] * A[1])),
    "foot": (P, L, lambda A, l: meet(l, perpendicular(A, l)[1:])),
    "getcenter": (C, lambda k: (P, k[0], k[1])),
    "translate": (P, P, P, lambda A, B, X: (P, X[0] + B[0] - A[0], X[1] + B[1] - A[1])),
    "rotate": (P, N, P, turned),
    "towards": (P, P, N, lambda A, B, t: (P, A[0] + t * (B[0] - A[0]), A[1] + t * (B[1] - A[1]))),
    "distance": (P, P, lambda A, B: (N, math.dist(A, B))),
    "getx": (P, lambda A: (N, A[0])),
    "gety": (P, lambda A: (N, A[1])),
}
DRAWN = {
    "dim": (N, N), "color": (N, N, N), "linethickness": (N,), "arrowstyle": (N, N, N), "fontsize": (N,), "cmark": (P,),
    "filltriangle": (P, P, P), "fillcircle": (C,), "drawcircle": (C,),
    "drawsegment": (P, P), "drawdashsegment": (P, P), "drawarrow": (P, P, N), "drawarc": (P, P, N),
}  # fmt: skip
