"""The sheets of the packaged scenes, and how far their items reach."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

from packaged_scenes import those
from sampling import CORE

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import Pencil
from graphplan.methods.construction import Construction
from graphplan.sheet.frames.frame import BORDER, MARKS
from graphplan.sheet.handout import solution
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import layout, pages
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text

P, T = ParamSpec("P"), TypeVar("T")
SCENES = CORE
LOADED = [name for name in those(lambda scene: scene.loads is not None) if name in SCENES]


def kept(make: Callable[P, T]) -> Callable[P, T]:
    """A function that makes each thing once, whether a default is left out or not, and named or not."""
    signature, found = inspect.signature(make), dict[tuple[Any, ...], T]()

    def get(*args: P.args, **named: P.kwargs) -> T:
        bound = signature.bind(*args, **named)
        bound.apply_defaults()
        key = tuple(bound.arguments.values())
        if key not in found:
            found[key] = make(*args, **named)
        return found[key]

    return get


@kept
def drawing_of(name: str, plan: str = "orthogonal") -> Construction:
    return gp.construct(gp.load(name), plan=plan)


@kept
def composition_of(name: str, paper: str | None = None, plan: str = "orthogonal",
                   protocol: str = "auto") -> Composition:
    """The sheet as it is drawn, with its errors told on it."""
    return draft(drawing_of(name, plan), Pencil(), paper, protocol=protocol).composition


@kept
def sheet_of(name: str, paper: str | None = None, plan: str = "orthogonal") -> Sheet:
    return layout(composition_of(name, paper, plan))


@kept
def pages_of(name: str) -> list[Sheet]:
    """The sheet and the pages of its words."""
    return pages(composition_of(name))


@kept
def solved_of(name: str) -> Sheet:
    """The sheet with every mark numbered."""
    return solution(composition_of(name))[0]


def spots(item: Item) -> list[Spot]:
    """The extreme spots of an item, letters included."""
    match item:
        case Polyline() | Polygon():
            return list(item.spots)
        case Circle():
            (x, y), r = item.centre, item.radius
            return [(x - r, y - r), (x + r, y + r)]
        case Arc():
            return list(item.spots())
        case Arrow():
            return [item.start, item.end]
        case Text():
            box = item.box
            return [(box.left, box.bottom), (box.right, box.top)]
    raise TypeError(item)


def outside(sheet: Sheet) -> list[Item]:
    """What leaves the frame, but for what stands in its border."""
    return [item for item in sheet.items
            if item.layer not in (BORDER, MARKS) and not all(sheet.frame.holds(spot, 0.01) for spot in spots(item))]
