"""Leaves: the rooms of one subject each, which import the core, and which the core finds here.

A leaf is a folder beside this file with a module `leaf`, whose LEAF says by name what the leaf adds: commands, public
names, formats and kinds of tasks, each in a module that is imported when it is used. Nothing else in the core knows of
a leaf: a subject is added with its folder, and goes with it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from graphplan.phrases import Said


class Command(NamedTuple):
    """A subcommand: the group of the help that lists it, its module, and whether it takes a scene first of all."""

    group: str
    module: str
    takes_scene: bool = True


class Format(NamedTuple):
    """A format: how its files end, what it is in a line, and the back end: its module, what it is called and reads.

    Without a module what is read is written as it is. `extra` is what installs a library that it needs and that does
    not come with graphplan.
    """

    suffix: str
    told: Said
    module: str
    function: str
    reads: str
    extra: str = ""


class TaskKind(NamedTuple):
    """A kind of task, a TOML file that is no scene: it is known by one of its `tables`, and a `command` takes it.

    `keys` is the title of the page of its keys. `module` has its table TASK, and reads it by `load` and `parse`. Where
    what is found for it can stand instead of a scene, as in handouts, `find` of the module `finder` finds it.
    """

    tables: tuple[str, ...]
    command: str
    keys: Said
    module: str
    finder: str = ""
    packaged: bool = False


@dataclass(frozen=True)
class Leaf:
    """Record of a leaf: its commands, formats and kinds of tasks by name, its public `names` by their module.

    By ending, `pages` has the module that writes handouts, `sheets` that which writes any sheet; `results` are the
    commands whose JSON its file results.toml describes.
    """

    commands: Mapping[str, Command] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    formats: Mapping[str, Format] = field(default_factory=dict)
    tasks: Mapping[str, TaskKind] = field(default_factory=dict)
    pages: Mapping[str, str] = field(default_factory=dict)
    sheets: Mapping[str, str] = field(default_factory=dict)
    results: tuple[str, ...] = ()


@cache
def leaves() -> Mapping[str, Leaf]:
    """The leaves that are there, by the package of each."""
    folders = sorted(folder.name for folder in Path(__file__).parent.iterdir()
                     if folder.is_dir() and folder.joinpath("leaf.py").is_file())
    return {f"{__package__}.{name}": import_module(f"{__package__}.{name}.leaf").LEAF for name in folders}


def module(name: str) -> Any:
    """A module of a leaf, by its name."""
    return import_module(name)


def tasks() -> dict[str, TaskKind]:
    """The kinds of tasks, by name."""
    return {name: kind for leaf in leaves().values() for name, kind in leaf.tasks.items()}


def kind_of_task(tables: Iterable[str]) -> TaskKind | None:
    """The kind of task that a file with these tables is, or None for a scene."""
    return next((kind for kind in tasks().values() if not {*kind.tables}.isdisjoint(tables)), None)
