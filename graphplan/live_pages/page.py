"""The live page: a construction that moves in a browser, as one file that needs no network.

The page is a template (live.html) with the sheet of the given pose in it as SVG, its protocol and its results in words:
that is all it is without a script. With one it is moved (motion.js), drawn anew (picture.js) and told anew (texts.js);
what these need is in it for each way to draw the scene that may be chosen, packed with gzip.
"""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from html import escape
from importlib.resources import files
from typing import Any

from graphplan.check.report import Reasons
from graphplan.live_pages import motion as motions
from graphplan.live_pages import picture as pictures
from graphplan.live_pages.texts import PAGE_WORDS, Texts
from graphplan.mechanism.units import Units
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.output.svg import svg
from graphplan.phrases import Said, unit
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import plans_sheet
from graphplan.sheet.plates.display import Item, Rect, Sheet
from graphplan.sheet.plates.plans import bounding_box
from graphplan.words.tongue import Tongue, tongue

PACKING = 5  # how hard gzip tries: more takes up to twice as long for three hundredths
SCRIPTS = ("texts.js", "base.js", "page.js", "viewing.js", "stepping.js", "moving.js", "tracing.js", "asked.js",
           "choosing.js")
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline' 'unsafe-eval'"
SHARED = " 'self' file:"  # where a script that pages share may come from
BACK = '<a href="../index.html" data-word="further">{}</a>'  # to the site on which pages share a script
LANGUAGES = {"en": "English", "de": "Deutsch", "lv": "latviešu", "et": "eesti", "ru": "русский", "uk": "українська"}

Data = dict[str, Any]  # of JSON


@dataclass(frozen=True)
class PageVariant:
    """One way to draw a scene: its plan and method, and on one sheet the constructions that serve its poses, the given
    pose's first; `missing` says by printed key and name why some of what is asked is not known."""

    plan: str
    method: str
    compositions: tuple[Composition, ...]
    missing: Reasons = field(default_factory=dict)

    @property
    def drawing(self) -> Construction:
        return self.compositions[0].plans.drawing


@dataclass(frozen=True)
class LivePage:
    """A live page of the ways to draw one scene, in some languages, of each the page's own first; `title` is the
    scene's own."""

    variants: Sequence[PageVariant]
    languages: Sequence[str]
    title: str

    @property
    def _own_composition(self) -> Composition:
        return self.variants[0].compositions[0]

    def html(self, shared: str = "") -> str:
        """The page; its script stands in it, or, `shared` with other pages, in a file of that name beside it."""
        template = resource("live.html")
        say = tongue(self.languages[0])
        packs = [self._pack(number) for number in range(len(self.variants))]
        composition = _in_tongue(self._own_composition, say)
        first = self._plans_sheet(composition, [item for plan in composition.pictures.values() for item in plan.items])
        fields = {
            **{f"word:{name}": escape(say(word)) for name, word in PAGE_WORDS.items()},
            "language": say.code, "title": escape(say.title(self.title)), "style": resource("page.css"),
            "walk": resource("walk.html"), "told": resource("told.html"),
            "source": escape(self._own_composition.plans.drawing.scene.source),
            "back": BACK.format(escape(say(PAGE_WORDS["further"]))) if shared else "",
            "policy": POLICY + (SHARED if shared else ""),
            "width": f"{first.width:g}", "height": f"{first.height:g}", "svg": svg_in_page(first),
            **{name: packs[0]["own"]["programs"][0][name] for name in ("list", "readings", "tables", "forms")},
            "data": escape_for_script(json.dumps(self._data(), ensure_ascii=False, separators=(",", ":"))),
            "packs": "\n".join(f'<script type="application/octet-stream" id="pack-{number}">{pack_data(pack)}</script>'
                               for number, pack in enumerate(packs)),
            "scene": escape_for_script(first.scene),
            "script": f'<script src="{escape(shared)}"></script>' if shared else f"<script>\n{script()}</script>",
        }  # fmt: skip
        return fill_template(template, fields)

    def _data(self) -> Data:
        """Data of the page that are read before any is unpacked."""
        first = self.variants[0]
        return {
            "variants": [{"plan": variant.plan, "method": variant.method} for variant in self.variants],
            "languages": {code: LANGUAGES[code] for code in self.languages},
            "words": {code: {name: tongue(code)(word) for name, word in PAGE_WORDS.items()} for code in self.languages},
            "signs": {code: {chr(sign): mark for sign, mark in tongue(code).signs.items()} for code in self.languages},
            "units": {code: {name: tongue(code)(unit(text)) for name, text in _units(first.drawing.scene.units)}
                      for code in self.languages},
            "curves": list(first.drawing.scene.sheet.curves), "centrodes": list(first.drawing.scene.sheet.centrodes),
        }  # fmt: skip

    def _pack(self, number: int) -> Data:
        """All of a variant: what moves, draws and tells it; in other languages than the first only what differs."""
        variant = self.variants[number]
        data, tape = motions.motion([composition.plans.drawing for composition in variant.compositions],
                                    variant.missing)
        texts = [Texts(composition.plans, composition.scales) for composition in variant.compositions]
        drawn = [pictures.PictureData(composition) for composition in variant.compositions]

        def spoken_steps(code: str) -> Data:
            say = tongue(code)
            composition = _in_tongue(variant.compositions[0], say)
            sheet = self._plans_sheet(composition)
            return {
                "title": say.title(self.title), "svg": svg_in_page(sheet),
                "captions": pictures.captions_by_step(composition, sheet),
                "pictures": [picture.picture_in(say) for picture in drawn],
                "programs": [text.texts_in(say, in_pose=not (number or k)) for k, text in enumerate(texts)],
                "said": {text: say(text) for text in sayings(data)},
            }  # fmt: skip

        first, *translations = map(spoken_steps, self.languages)
        return {
            "motion": data, "tape": tape, "texts": [text.javascript() for text in texts],
            "programs": [program_data(composition) for composition in variant.compositions],
            "language": self.languages[0], "own": first,
            "others": {code: difference(first, translation)
                       for code, translation in zip(self.languages[1:], translations, strict=True)},
        }  # fmt: skip

    def _plans_sheet(self, composition: Composition, items: Iterable[Item] = ()) -> Sheet:
        """The plans of a composition with these items, called by the page's title in its tongue."""
        return replace(plans_sheet(composition, items), title=composition.plans.tongue.title(self.title))


def _in_tongue(composition: Composition, say: Tongue) -> Composition:
    """A composition that speaks a language; its drawing is the same."""
    if say.code == composition.plans.tongue.code:
        return composition
    return replace(composition, plans=replace(composition.plans, tongue=say))


def live(variants: Sequence[PageVariant], languages: Sequence[str], title: str, *, shared: str = "") -> str:
    """The live page of these ways to draw one scene; with a name of a `shared` script it leaves that out."""
    return LivePage(variants, languages, title).html(shared)


def script() -> str:
    """The JavaScript of all live pages."""
    sources = map(resource, SCRIPTS)
    return "\n".join(['"use strict";', "(() => {", motions.script(), pictures.scripts(), *sources, "})();", ""])


def resource(name: str) -> str:
    """The text of a file beside this one."""
    return files(__package__).joinpath(name).read_text("utf-8")


def fill_template(template: str, fields: Mapping[str, str]) -> str:
    """A template with its fields, such as {{title}}, filled in."""
    return re.sub(r"\{\{([\w:]+)\}\}", lambda place: fields[place[1]], template)


def _units(units: Units) -> Iterator[tuple[str, str]]:
    """Yield the quantities with their units."""
    length, force = units.length, units.force
    yield from {"length": length, "speed": f"{length}/s", "acceleration": f"{length}/s²", "turning": "rad/s",
                "bending": "rad/s²", "force": force, "moment": f"{force}·m"}.items()


def svg_in_page(page: Sheet) -> str:
    """A sheet as SVG for the page, which has the scene elsewhere."""
    text = svg(replace(page, scene=""), alone=False, id="picture", role="img", aria_label=page.title)
    return text[text.index("<svg") :].strip()


def program_data(composition: Composition) -> Data:
    """What the page needs to know of a construction's steps, and of its windows, with y down as in SVG."""
    plans, high = composition.plans, composition.arrangement.height
    drawing, panels, rects = plans.drawing, list(plans.panels), composition.arrangement.panels
    return {
        "givens": drawing.drawn.givens,
        "steps": [{"reads": list(step.args), "span": list(step.args) if step.op.spans else [],
                   "plan": panels.index(plans.plan_of_step[step.index]),
                   "number": max(0, drawing.drawn.number(step.index))} for step in drawing.drawn.steps],
        "panels": [_box(rects[panel], high) for panel in panels],
        "plans": _box(bounding_box([spot for rect in rects.values() for spot in rect.corners]), high),
        "vectors": [{"name": vector.label, "panel": panels.index(plans.plan_of_step[vector.end]), "end": vector.end,
                     "start": vector.start} for vector in drawing.arrows
                    if vector.kind in (kinds.VELOCITY, kinds.ACCELERATION)],
        "turned": drawing.turned,
    }  # fmt: skip


def _box(rect: Rect, high: float) -> list[float]:
    """A rectangle as left, top, width and height."""
    return [round(n, 2) for n in (rect.left, high - rect.top, rect.width, rect.height)]


def on_one_sheet(first: Composition, others: Sequence[Construction]) -> tuple[Composition, ...]:
    """A composition, and in its windows, at its scales, other constructions of the scene; those of other plans are
    left out."""
    compositions = [first]
    for drawing in others:
        plans = replace(first.plans, drawing=drawing)
        if plans.panels == first.plans.panels:
            compositions.append(replace(first, plans=plans))
    return tuple(compositions)


def sayings(data: Any) -> Iterator[Said]:
    """Yield the phrases in nested data."""
    if isinstance(data, Said):
        yield data
    elif isinstance(data, Mapping | list | tuple):
        for item in data.values() if isinstance(data, Mapping) else data:
            yield from sayings(item)


# ---- data in a page --------------------------------------------------------------------------------------------------


def escape_for_script(text: str) -> str:
    """Text that cannot end the script it stands in: `</` and `<!--` have a backslash after their first sign."""
    return re.sub(r"<(?=/|!--)", r"<\\", text)


def pack_data(data: Data) -> str:
    """Data as a page has them: JSON, by gzip, in letters of base 64."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    return base64.b64encode(gzip.compress(text.encode(), PACKING, mtime=0)).decode("ascii")


def difference(one: Any, other: Any) -> Any:
    """Difference of two values: a list of the other alone, or, by key or place, the differences of its parts."""
    if isinstance(one, Mapping) and isinstance(other, Mapping) and one.keys() == other.keys():
        return {key: difference(one[key], other[key]) for key in one if one[key] != other[key]}
    if isinstance(one, list | tuple) and isinstance(other, list | tuple) and len(one) == len(other):
        return {str(i): difference(a, b) for i, (a, b) in enumerate(zip(one, other, strict=True)) if a != b}
    return [other]
