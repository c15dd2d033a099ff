"""The reference of the Python interface, from the docstrings of what `import graphplan` offers."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import graphplan

HEAD = """\
# Python reference

What `import graphplan as gp` offers, from its docstrings; `python -m graphplan.site.api_reference` writes this
chapter. [Python](python.md) shows how it is used, [What is stable](stable.md) what stays as it is. Lengths, forces and
masses are in the scene's units, angles and travels in degrees, rates in rad/s; vectors are complex numbers.
"""
GROUPS = {
    "Scenes": "scene load parse at Scene WrittenScene",
    "Constructions and results": "construct solve Construction WorkingDrawing Results",
    "Poses": "follow PoseSeries MotionSeries MotionStream Summary",
    "Machines and cams": "flywheel motion balance cam synthesize position_errors Subject SynthesisResults",
    "Teaching and sharing": "handout live variants verify Findings",
    "Modules": "analytic cycle sheet",
    "Errors": "GraphplanError SceneError Refused SingularPose NoMechanism Disagreement ConstructionError",
}


def api_reference() -> str:
    """All public names in their groups, as Markdown; those of no group stand at the end."""
    grouped = " ".join(GROUPS.values()).split()
    groups = {**GROUPS, "More": " ".join(name for name in graphplan.__all__ if name not in grouped)}
    sections = (f"## {title}\n\n" + "\n".join(map(_entry, names.split())) for title, names in groups.items() if names)
    return "\n".join([HEAD, *sections])


def _entry(name: str) -> str:
    """A public name: how it is called, and what its docstring says; of a class and a module what it has, too."""
    thing = getattr(graphplan, name)
    if isinstance(thing, ModuleType):
        public = [inner for inner in getattr(thing, "__all__", ()) or vars(thing) if _is_function(thing, inner)]
        members = [_member(f"gp.{name}.{inner}", getattr(thing, inner)) for inner in public]
        return "\n".join([f"### gp.{name}\n", f"{_text(thing)}\n", *members])
    if not inspect.isclass(thing):
        return f"### gp.{name}\n\n```python\ngp.{name}{_signature(thing)}\n```\n\n{_text(thing)}\n"
    members = [_member(inner, value) for inner, value in _public_members(thing)]
    return "\n".join([f"### class gp.{name}\n", f"{_text(thing)}\n", *members, *([""] if members else [])])


def _is_function(module: ModuleType, name: str) -> bool:
    thing = getattr(module, name)
    return not name.startswith("_") and inspect.isfunction(thing) and (
        name in getattr(module, "__all__", ()) or thing.__module__ == module.__name__)


def _public_members(kind: type) -> Iterator[tuple[str, Any]]:
    """The methods and properties of a class and of those of graphplan that it extends."""
    names: dict[str, Any] = {}
    for base in reversed(kind.__mro__):
        if base.__module__.startswith("graphplan.") and not issubclass(base, Exception):
            names |= {name: value for name, value in vars(base).items() if not name.startswith("_")}
    for name, value in names.items():
        inner = getattr(value, "fget", None) or getattr(value, "func", None) or value
        if inspect.isfunction(inner) and inner.__doc__:
            yield (f"{name}{_signature(inner)}" if inspect.isfunction(value) else name), inner


def _member(call: str, thing: Any) -> str:
    """A line of a list: how it is called, and the first sentences of what is said of it."""
    first = " ".join((inspect.getdoc(thing) or "").split("\n\n")[0].split())
    call = call if "(" in call or not call.startswith("gp.") else f"{call}{_signature(thing)}"
    return f"- `{call}`: {_markdown(first)}"


def _signature(thing: Any) -> str:
    """Parameters with their types and defaults, without the module of a name."""
    signature = inspect.signature(thing)
    own = [parameter for name, parameter in signature.parameters.items() if name != "self"]
    text = re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(signature.replace(parameters=own)))
    return re.sub(r"\b(?:typing|os|collections\.abc)\.", "", re.sub(r"<function .*? at 0x[0-9a-f]+>", "...", text))


def _text(thing: Any) -> str:
    return _markdown(inspect.getdoc(thing) or "")


def _markdown(text: str) -> str:
    """A docstring in Markdown: other names of graphplan as code."""
    return re.sub(r":(?:class|func|meth):`([^`]+)`", r"`\1`", text)


if __name__ == "__main__":
    from pathlib import Path

    Path(__file__).with_name("chapters").joinpath("api.md").write_text(api_reference(), encoding="utf-8", newline="\n")
