"""The stepper: a construction as one page for a browser, step by step and pose by pose, that needs no network.

The page is a template with the sheet in it as SVG, a group for each layer and step, the protocol and the results in
words, and data: what each step reads and makes, and for every other pose what is otherwise there, packed with gzip.
Without a script it is the finished sheet with its protocol.
"""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from html import escape
from importlib.resources import files
from typing import Any
from xml.etree.ElementTree import tostring

from svgwrite.container import SVG

from graphplan.kernel.stages import Equation
from graphplan.output.svg import MAKE, Element, group, inked, parted
from graphplan.phrases import Said, arranged, digits, joined, said
from graphplan.sheet.cycle_frames import CycleFrame, CycleFrames
from graphplan.sheet.lettering.lettering import Runs, equation_runs, sentence_runs
from graphplan.sheet.plates.display import Item, Rect, Sheet
from graphplan.sheet.plates.pens import PAPER
from graphplan.sheet.plates.plans import Plans, around
from graphplan.sheet.words.protocol import Entry, Passage, Protocol
from graphplan.sheet.words.tables import Table
from graphplan.sheet.words.texts import Words

PACKING = 9  # how hard gzip tries
MECHANISM_LAYERS = ("plates", "ground", "links", "blocks", "drive", "pairs", "letters")
LEVELS = "{}", "<sup>{}</sup>", "<sub>{}</sub>"  # of letters: on the line, above it, and, as the last, below
WORDS = {  # what stands on the page
    "previous": said("Previous step"), "next": said("Next step"), "first": said("First step"),
    "last": said("Last step"), "play": said("Play"), "pause": said("Pause"), "step": said("Step"),
    "steps": said("Steps"), "sheet": said("Sheet"), "controls": said("Controls"), "zoom": said("Zoom to the plan"),
    "turn": said("Turn of the drive"), "reads": said("reads"), "makes": said("makes"), "results": said("Results"),
    "begin": said("The mechanism as it is given; nothing is drawn yet."),
    "old": said("This browser cannot unpack the other poses."),
    "keys": said("Keys: arrows, Page Up and Page Down for stages, Home, End, space."),
}  # fmt: skip

Groups = dict[str, Element]  # every group of a sheet, by layer or step


def stepper(found: CycleFrames) -> str:
    """The page of a construction, in the tongue of its sheet."""
    page = files(__package__).joinpath("stepper.html").read_text("utf-8")
    parts = {**{f"word:{name}": escape(_say(found, word)) for name, word in WORDS.items()}, **_parts(found)}
    return re.sub(r"\{\{([\w:]+)\}\}", lambda place: parts[place[1]], page)


def _parts(found: CycleFrames) -> dict[str, str]:
    """What the page is filled with besides words."""
    sheet, plans = found.frames[0].sheet, found.composition.plans
    poses, passages = list(_poses(found.frames)), Protocol(plans, found.composition.scales).passages
    return {
        "language": sheet.language, "title": escape(sheet.title), "source": escape(found.drawing.scene.source),
        "width": f"{sheet.width:g}", "height": f"{sheet.height:g}", "svg": _picture(found, poses),
        "list": "\n".join(_protocol(found, passages)), "results": _results(found.frames[0].plans),
        "turned": "" if len(found.frames) > 1 else "hidden", "remark": escape(_remark(found)),
        "data": _script(json.dumps(_data(found, passages), ensure_ascii=False)), "poses": _packed(found, poses),
        "scene": _script(sheet.scene),
    }  # fmt: skip


def _say(found: CycleFrames, text: str) -> str:
    return found.composition.plans.tongue(text)


def _degrees(travel: float) -> Said:
    return arranged("{0}°", digits(travel))


def _set(found: CycleFrames, text: str) -> str:
    """Words with the names of marks set as on the sheet."""
    names = tuple(step.name for step in found.drawing.drawn.steps if step.name)
    return _html(sentence_runs(_say(found, text), names))


def _html(runs: Runs) -> str:
    """Lettering as HTML."""
    return "".join(LEVELS[run.level].format(escape(run.text)) for run in runs)


def _remark(found: CycleFrames) -> str:
    """Why there is no turn, or which poses of it are left out."""
    if found.why:
        return _say(found, said("The drive cannot be turned here: {0}.", found.why))
    if found.lost:
        lost = (joined(map(_degrees, dict.fromkeys(part)), "–") for part in found.lost)
        return _say(found, said("Not drawn: {0}. There the pose is out of reach or singular, or takes other steps.",
                                joined(lost)))
    return ""


# ---- the words ---------------------------------------------------------------------------------------------------


def _protocol(found: CycleFrames, passages: Iterable[Passage]) -> Iterator[str]:
    """The stages with their entries, and in these their movements, as items of an ordered list."""
    plan = ""
    for passage in passages:
        if passage.plan != plan:
            plan = passage.plan
            yield f"<li><h3>{_set(found, arranged('{0:capital}', passage.plan.words))}</h3></li>"
        yield f'<li class="stage">{_head(found, passage)}<ol>{"".join(_entries(found, passage.entries))}</ol></li>'


def _head(found: CycleFrames, passage: Passage) -> str:
    """A stage's title, its equations with what is known in them underlined, and its law."""
    if passage.stage is None or passage.title is None:
        return ""
    equations = () if passage.again else passage.stage.equations
    told = [f"<h4>{_set(found, arranged('{0:capital}', passage.title))}</h4>"]
    told += [f'<p class="equation">{_equation(equation)}</p>' for equation in equations]
    told += [f"<p>{_set(found, arranged('{0:capital}.', passage.law))}</p>"] if passage.law else []
    return "".join(told)


def _equation(equation: Equation) -> str:
    """An equation whose vectors are underlined as often as numbers of them are known."""
    told, done = "", 0
    for start, end, times in equation.underlined:
        told += _html(equation_runs(equation.text[done:start]))
        told += f'<span class="known-{times}">{_html(equation_runs(equation.text[start:end]))}</span>'
        done = end
    return told + _html(equation_runs(equation.text[done:]))


def _entries(found: CycleFrames, entries: Iterable[Entry]) -> Iterator[str]:
    """Entries as items of a list; one of several movements has a list of these."""
    for entry in entries:
        told = f'<b>{entry.number}</b> <span>{_set(found, entry.told)}</span>'
        last = entry.movements[-1].number
        if not entry.folded:
            yield f'<li><button type="button" data-place="{last}">{told}</button></li>'
            continue
        parts = "".join(f'<li><button type="button" data-place="{one.number}"><b>{one.number}</b> '
                        f'<span>{_set(found, one.sentence)}</span></button></li>' for one in entry.movements)
        yield f'<li><button type="button" class="whole" data-until="{last}">{told}</button><ol>{parts}</ol></li>'


def _results(plans: Plans) -> str:
    """What is read when all is drawn, as tables."""
    return "".join(f"<table>{''.join(_rows(table))}</table>" for table in Words(plans).result_tables())


def _rows(table: Table) -> Iterator[str]:
    """The rows of a table, its head first."""
    for number, row in enumerate(table):
        cell = "th" if number == 0 else "td"
        yield f"<tr><th>{_html(row[0])}</th>{''.join(f'<{cell}>{_html(runs)}</{cell}>' for runs in row[1:])}</tr>"


# ---- the data ----------------------------------------------------------------------------------------------------


def _data(found: CycleFrames, passages: Sequence[Passage]) -> dict[str, Any]:
    """What the page needs to know of the steps, their marks and the panels, with y down as in SVG."""
    drawn, plans, sheet = found.drawing.drawn, found.composition.plans, found.frames[0].sheet
    panels = list(sheet.panels)
    parts = {one.index: (stage, entry.movements[-1].number if entry.folded else 0,
                         one.sentence if entry.folded else entry.told)
             for stage, passage in enumerate(passages) for entry in passage.entries for one in entry.movements}
    steps = []
    for step in drawn.steps:
        stage, whole, told = parts.get(step.index, (None, 0, ""))
        steps.append({
            "name": _set(found, drawn.text(step.index)), "told": _set(found, told), "stage": stage, "whole": whole,
            "plan": panels.index(plans.plan_of_step[step.index]), "reads": list(step.args),
            "span": list(step.args) if step.op.spans else [],
        })  # fmt: skip
    return {
        "givens": drawn.givens, "steps": steps, "words": {name: _say(found, word) for name, word in WORDS.items()},
        "stages": [_head(found, passage) for passage in passages],
        "panels": [_box(sheet, rect) for rect in sheet.panels.values()],
        "plans": _box(sheet, around([spot for rect in sheet.panels.values() for spot in rect.corners])),
        "spots": _spots(found.frames[0]),
        "travels": [_say(found, _degrees(frame.travel)) for frame in found.frames],
    }  # fmt: skip


def _sentences(found: CycleFrames, frame: CycleFrame) -> tuple[dict[int, str], dict[int, str]]:
    """What is told of a pose, whose lengths are its own: of each movement, and of what takes several, by the last."""
    each, whole = dict[int, str](), dict[int, str]()
    for passage in Protocol(frame.plans, found.composition.scales).passages:
        for entry in passage.entries:
            for one in entry.movements:
                each[one.number] = _set(found, one.sentence if entry.folded else entry.told)
            if entry.folded:
                whole[entry.movements[-1].number] = _set(found, entry.told)
    return each, whole


def _varied(poses: Iterable[dict[int, str]]) -> dict[int, list[str]]:
    """What is not the same in all poses, pose by pose."""
    rows = [*poses]
    return {key: told for key in rows[0] if len(set(told := [row[key] for row in rows])) > 1}


def _spots(frame: CycleFrame) -> dict[int, tuple[float, float]]:
    """Where marks lie on the picture."""
    return {index: (round(x, 2), round(frame.sheet.height - y, 2)) for index, (x, y) in frame.spots.items()}


def _box(sheet: Sheet, rect: Rect) -> list[float]:
    """A rectangle as left, top, width and height."""
    return [round(n, 2) for n in (rect.left, sheet.height - rect.top, rect.width, rect.height)]


# ---- the picture -------------------------------------------------------------------------------------------------


def _poses(frames: Iterable[CycleFrame]) -> Iterator[Groups]:
    """The groups of each sheet. What is drawn alike in two poses that follow each other is one group."""
    drawn: dict[str, tuple[list[Item], Element]] = {}
    for frame in frames:
        before, drawn = drawn, {}
        for key, items in parted(frame.sheet):
            was = before.get(str(key))
            drawn[str(key)] = was if was and was[0] == items else (items, inked(frame.sheet, key, items))
        yield {key: element for key, (_, element) in drawn.items()}


def _picture(found: CycleFrames, poses: list[Groups]) -> str:
    """The sheet of the given pose, with a group for whatever is drawn in any pose."""
    sheet, plans = found.frames[0].sheet, found.composition.plans
    panels, size = list(sheet.panels), f"0 0 {sheet.width:g} {sheet.height:g}"
    picture = SVG(id="picture", viewBox=size, role="img", aria_label=sheet.title, debug=False)
    picture.set_desc(desc=sheet.description)
    for number, rect in enumerate(sheet.panels.values()):
        left, top, wide, high = _box(sheet, rect)
        clip = picture.defs.add(MAKE.clipPath(id=f"panel-{number}"))
        clip.add(MAKE.rect((left, top), (wide, high)))
    picture.add(MAKE.rect((0, 0), (sheet.width, sheet.height), fill=PAPER))
    for key in sorted(dict.fromkeys(key for pose in poses for key in pose), key=_place):
        panel = panels.index(plans.plan_of_step[int(key)]) if key.isdigit() else 0
        picture.add(_marked(key, poses[0].get(key) or _empty(key, sheet), panel))
    return str(picture.tostring())


def _place(key: str) -> tuple[int, int]:
    """From back to front: paper and links, the halos of marks, steps, pairs and letters, words."""
    back, front = ("paper", "plates", "ground", "links"), ("blocks", "drive", "pairs", "letters", "text")
    if key.isdigit():
        return 1, int(key)
    return (0, back.index(key)) if key in back else (2, front.index(key) if key in front else len(front))


def _empty(key: str, sheet: Sheet) -> Element:
    """The group of what is not there in the given pose."""
    return group(int(key), sheet.sentences[int(key)]) if key.isdigit() else group(key, "")


def _marked(key: str, group: Element, panel: int) -> Element:
    """A group of the picture with its key, cut off where its plan ends."""
    group["data-key"] = key
    if key.isdigit() or key in MECHANISM_LAYERS:
        group["clip-path"] = f"url(#panel-{panel})"
    return group


# ---- the poses ---------------------------------------------------------------------------------------------------


def _packed(found: CycleFrames, poses: list[Groups]) -> str:
    """The groups that are not the same in all poses, with the places of marks, packed; nothing for one pose.

    The poses of a group stand in a row, as they are alike.
    """
    if len(poses) < 2:
        return ""
    inside = cache(_inside)
    insides = [{key: inside(group) for key, group in pose.items()} for pose in poses]
    keys = dict.fromkeys(key for pose in poses for key in pose)
    varied = {key: [pose.get(key, "") for pose in insides] for key in keys}
    each, wholes = zip(*(_sentences(found, frame) for frame in found.frames), strict=True)
    data = {
        "told": _varied(each), "wholes": _varied(wholes), "spots": list(map(_spots, found.frames)),
        "groups": {key: drawn for key, drawn in varied.items() if len(set(drawn)) > 1},
        "results": [_results(frame.plans) for frame in found.frames],
    }  # fmt: skip
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    return base64.b64encode(gzip.compress(text.encode(), PACKING, mtime=0)).decode("ascii")


def _inside(group: Element) -> str:
    """What a group holds, without its title."""
    return "".join(tostring(child.get_xml(), encoding="unicode") for child in group.elements
                   if child.elementname != "title")


def _script(text: str) -> str:
    """Text that cannot end the script it stands in; JSON and TOML read \\u003C as what it was."""
    return re.sub(r"<(?=/script|!--)", r"\\u003C", text, flags=re.IGNORECASE)
