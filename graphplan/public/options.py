"""How a scene is drawn and what its sheet looks like, as far as it is said beside the scene itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, TypedDict

from graphplan.errors import Refused
from graphplan.mechanism.items import suggestion

if TYPE_CHECKING:
    from graphplan.accuracy.hand import Pencil


@dataclass(frozen=True)
class Options:
    """How a scene is drawn, and what its sheet looks like: what is empty is left to [sheet], and else to graphplan.

    `method`, `plan`, `inertia`, `strict`: as `construct` has them; `rounds` of friction are drawn. `prefer` weighs all
    forms: simple, accurate or balanced, by a `pencil` of some accuracy. `paper`, `frame`, `language`: of the sheet;
    `protocol`: where its words stand; `curves` and `centrodes`: names of points and of pairs of links, with commas
    between them, or all; `positions` of the mechanism are drawn in faint lines. Scene keys have the same names and
    meanings.
    """

    method: str = ""
    plan: str = ""
    inertia: str = ""
    rounds: int | None = None
    strict: bool = False
    prefer: str = ""
    pencil: Pencil | None = None
    paper: str = ""
    frame: str = ""
    language: str = ""
    protocol: str = ""
    curves: str = ""
    centrodes: str = ""
    positions: int | None = None


class SheetKeywords(TypedDict, total=False):
    """What any sheet looks like, as keywords of functions; the pencil may be its text, such as "point=0.2"."""

    pencil: Pencil | str | None
    paper: str
    frame: str
    language: str


class Keywords(SheetKeywords, total=False):
    """The same, and how a construction is drawn."""

    method: str
    plan: str
    inertia: str
    rounds: int | None
    strict: bool
    prefer: str
    protocol: str
    curves: str
    centrodes: str
    positions: int | None


NAMES = tuple(field.name for field in fields(Options))


def options_of(keywords: Mapping[str, object]) -> Options:
    """The options that keywords say, a pencil as its text; fails with `Refused` where there is no such option."""
    for name in keywords:
        if name not in NAMES:
            raise Refused(f"option {name}", "there is no such option", suggestion(name, NAMES, "option"))
    values: dict[str, Any] = {name: value for name, value in keywords.items() if value is not None}
    if isinstance(values.get("pencil"), str):
        from graphplan.accuracy.hand import pencil

        values["pencil"] = pencil(values["pencil"])
    return Options(**values)
