"""A reader of the part of TikZ that exports use: every coordinate from its command, with the digits of \\fpeval."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable
from typing import Any

UNITS = re.compile(r"pt\b|\\graphplanmm|\\fpeval")
PART = re.compile(r"\\([pxyn])(?:\{(\w+)\}|(\d))")
NAMED = re.compile(r"(?<!\w)\(([A-Za-z]\w*)\)")
BETWEEN = re.compile(r"(C\['\w+'\])!([^!]+)!(C\['\w+'\])")
MEETING = re.compile(r"\(intersection of (\w+)--(\w+) and (\w+)--(\w+)\)")
LET = re.compile(r"\\([pn])\{?(\w+)\}?=")
MADE = re.compile(r"coordinate ?\((\w+)\) at ")
COMMAND = re.compile(r"^\\(?:coordinate|path(?: let (?P<let>.*?) in)?\s+coordinate).*?;$", re.MULTILINE | re.DOTALL)


class Spots(ast.NodeTransformer):
    """Two numbers in brackets are a point."""

    def visit_Tuple(self, node: ast.Tuple) -> ast.AST:
        self.generic_visit(node)
        return ast.Call(ast.Name("complex", ast.Load()), node.elts, [])


def coordinates(source: str) -> dict[str, complex]:
    """The coordinates of a picture in mm, by name; each is read after it is made, and made once."""
    body = re.sub(r"(?m)(?<!\\)%.*$", "", source[source.index(r"\begin{tikzpicture}"):])
    found: dict[str, complex] = {}
    for command in COMMAND.finditer(body):
        lets: dict[str, Any] = {}
        _, *parts = LET.split(command["let"] or "")
        for kind, name, text in zip(parts[::3], parts[1::3], parts[2::3], strict=True):
            lets[kind + name] = evaluated(text.strip().removesuffix(","), found, lets)
        own = {name: evaluated(text, found, lets) for name, text in made(command[0])}
        assert not own.keys() & found.keys()
        found |= own
    return found


def made(command: str) -> list[tuple[str, str]]:
    """The coordinates that a command makes, each with the text that says where."""
    places = [*MADE.finditer(command)]
    ends = [place.start() for place in places[1:]] + [len(command) - 1]
    return [(place[1], command[place.end():end].strip()) for place, end in zip(places, ends, strict=True)]


def evaluated(text: str, found: dict[str, complex], lets: dict[str, Any]) -> Any:
    """What a text of calc says."""
    if ends := MEETING.match(text):
        P, Q, R, S = (found[name] for name in ends.groups())
        return P + cross(R - P, S - R) / cross(Q - P, S - R) * (Q - P)
    text = UNITS.sub(lambda unit: "1" if "mm" in unit[0] else "", text)
    text = PART.sub(lambda part: f"L({part[1]!r},{(part[2] or part[3])!r})", text)
    text = text.replace("$", "").replace("{", "(").replace("}", ")").replace("^", "**")
    text = text.replace("<=", ">").replace("?0:", " and ")  # a sign that rounding alone gives is none
    text = BETWEEN.sub(r"(\1+\2*(\3-\1))", NAMED.sub(r"C['\1']", text))
    tree = ast.fix_missing_locations(Spots().visit(ast.parse(text.strip(), mode="eval")))
    read: Callable[[str, str], Any] = lambda part, name: {  # noqa: E731
        "p": lambda: lets["p" + name], "n": lambda: lets["n" + name],
        "x": lambda: lets["p" + name].real, "y": lambda: lets["p" + name].imag}[part]()
    known = {"sqrt": math.sqrt, "abs": abs, "complex": complex, "max": max, "min": min,
             "sign": lambda number: math.copysign(1.0, number)}
    return eval(compile(tree, "<tikz>", "eval"), {"C": found, "L": read, **known})


def cross(u: complex, v: complex) -> float:
    return (u.conjugate() * v).imag
