"""How elements of an SVG file look: by their attributes, over them the style sheet's classes, over them their style."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from xml.etree.ElementTree import Element

Look = Mapping[str, str]
RULE = re.compile(r"\.([\w-]+)\s*\{([^{}]*)\}")  # by class alone
INHERITED = ("stroke", "font-size", "text-anchor", "visibility")
KNOWN = {*INHERITED, "display", "baseline-shift"}


class Looks:
    """The looks of one document's elements."""

    def __init__(self, root: Element):
        self.rules = dict(_rules(root))

    def of(self, element: Element) -> dict[str, str]:
        """What is said of an element itself."""
        look = dict(element.attrib)
        for name in element.get("class", "").split():
            look |= self.rules.get(name, {})
        return look | _declared(element.get("style", ""))


def inherited(look: Look, above: Look) -> Look:
    """What an element hands on to those in it."""
    return {**above, **{key: value for key in INHERITED if (value := look.get(key, "inherit")) != "inherit"}}


def _rules(root: Element) -> Iterator[tuple[str, dict[str, str]]]:
    """The declarations of the document's style sheets, by class."""
    for sheet in root.iter("style"):
        for name, declared in RULE.findall(sheet.text or ""):
            yield name, _declared(declared)


def _declared(style: str) -> dict[str, str]:
    parts = [part.partition(":") for part in style.split(";")]
    named = ((name.strip(), value.strip()) for name, _, value in parts)
    return {name: value for name, value in named if name in KNOWN}
