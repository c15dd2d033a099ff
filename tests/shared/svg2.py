"""What of SVG 2 sheets are made of: elements with what may stand in them and their attributes, and what these may be.

After the W3C's Scalable Vector Graphics 2: chapters 5 (structure), 7 (coordinates), 9 (paths), 10 (shapes), 11 (text).
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator

SVG, XML = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/XML/1998/namespace}"
INKSCAPE, XLINK = "{http://www.inkscape.org/namespaces/inkscape}", "{http://www.w3.org/1999/xlink}"
NUMBER = r"-?(\d+\.?\d*|\.\d+)"
NUMBERS = rf"{NUMBER}([ ,]+{NUMBER})*"
COLOUR = r"#[0-9a-f]{6}|none"
PATH = rf"M {NUMBER} {NUMBER}( A {NUMBER} {NUMBER} 0 [01] [01] {NUMBER} {NUMBER})+"
ANY = r"(?s).*"
GLOBAL = {"id": r"[A-Za-z][-\w.]*", "class": r"[-\w ]+", "role": "img", "aria-label": ANY, f"{XML}lang": r"[a-z]{2,3}",
          "data-step": r"\d+"}
PAINT = {"fill": COLOUR, "stroke": COLOUR, "stroke-width": NUMBER, "stroke-dasharray": NUMBERS,
         "stroke-linecap": "round", "stroke-linejoin": "round"}  # fmt: skip
LETTERS = {"font-family": ANY, "font-size": NUMBER, "font-weight": "bold", "text-anchor": "middle|end", "fill": COLOUR}
DATA = {"data-step": r"\d+", "data-plan": ANY, "data-vector": r"\w+ .*", "data-from": NUMBERS, "data-to": NUMBERS}
LAYER = {f"{INKSCAPE}groupmode": "layer", f"{INKSCAPE}label": ANY}
DESCRIBED, SHAPES = {"title", "desc"}, {"rect", "polyline", "polygon", "circle", "path", "text", "image"}
ELEMENTS = {  # what may stand in each, and its attributes; in those of words stand letters
    "svg": ({*DESCRIBED, *SHAPES, "metadata", "g"}, {"width": f"{NUMBER}mm", "height": f"{NUMBER}mm",
                                                     "viewBox": rf"0 0 {NUMBER} {NUMBER}", **PAINT, **LETTERS,
                                                     f"{XML}space": "preserve"}),
    "g": ({*DESCRIBED, *SHAPES, "g"}, DATA | LAYER),
    "rect": (DESCRIBED, {**dict.fromkeys(("x", "y", "width", "height"), NUMBER), **PAINT, **DATA}),
    "polyline": (DESCRIBED, {"points": NUMBERS, **PAINT}),
    "polygon": (DESCRIBED, {"points": NUMBERS, **PAINT}),
    "circle": (DESCRIBED, {**dict.fromkeys(("cx", "cy", "r"), NUMBER), **PAINT}),
    "path": (DESCRIBED, {"d": PATH, **PAINT}),
    "text": ({*DESCRIBED, "tspan"}, {"x": NUMBER, "y": NUMBER, **LETTERS}),
    "tspan": (DESCRIBED, {"dy": NUMBER, **LETTERS}),
    "title": (set(), {}), "desc": (set(), {}), "metadata": (set(), {}),
}  # fmt: skip
WORDS = {"text", "tspan", "title", "desc", "metadata"}


def faults(text: str) -> list[str]:
    """What in a document is not of SVG 2."""
    root = ET.fromstring(text.encode())
    named = Counter(element.get("id") for element in root.iter() if element.get("id"))
    return [*(f"{name} is there {count} times" for name, count in named.items() if count > 1),
            *([] if root.tag == f"{SVG}svg" else [root.tag]), *_faults(root)]  # fmt: skip


def _faults(element: ET.Element) -> Iterator[str]:
    """What is wrong with an element and what stands in it."""
    name = element.tag.removeprefix(SVG)
    held, attributes = ELEMENTS[name]
    known = GLOBAL | attributes
    for key, value in element.attrib.items():
        if not re.fullmatch(known.get(key, "(?!)"), value):
            yield f"{name} {key}={value!r}"
    if name not in WORDS and ((element.text or "") + "".join(child.tail or "" for child in element)).strip():
        yield f"{name} has letters"
    kinds = [child.tag.removeprefix(SVG) for child in element]
    if "title" in kinds[1:]:
        yield f"{name}: its title is not the first"
    for child, kind in zip(element, kinds, strict=True):
        if kind not in held:
            yield f"{kind} in {name}"
        elif kind in ELEMENTS:
            yield from _faults(child)
