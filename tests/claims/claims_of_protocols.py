"""Claims about the construction in words: executed on paper it leads where it says, and each sentence holds."""

from __future__ import annotations

import math
import re
from itertools import groupby, pairwise
from typing import Any

from claim import claim
from face import Got
from inked_sheet import BLACK, GREY, number, said
from speech import faults

PLANS = (), ("--plan", "polar")
TENTH = 0.051  # mm: tenths are spoken
NUMBERS = re.compile(r"^ *(\d+)(?:–(\d+))?\. ", re.MULTILINE)


@claim()
def whoever_executes_it_finds_each_mark(got: Got) -> None:
    """With ruler, set squares and compasses each mark lies where it is told, and each spoken number is true."""
    for options in PLANS:
        assert faults(got.data("steps", "--json", *options)) == [], options


@claim()
def each_step_stands_in_a_stage_with_its_reason(got: Got) -> None:
    """What is drawn is part of a stage that has a title and a law; no two stages in turn are one, and no law is told
    twice."""
    for options in PLANS:
        told = got.data("steps", "--json", *options)
        stages = [told["stages"][step["stage"]] for step in told["steps"] if step["number"]]
        assert all(stage["title"] and stage["law"] for stage in stages)
        runs = [told["stages"][stage] for stage, _ in groupby(
            step["stage"] for step in told["steps"] if step["number"])]
        assert not [one for one, two in pairwise(runs) if one == two]
        text = " ".join(got.printed("steps", *options).split())
        laws = {stage["law"] for stage in stages}
        assert not [law for law in laws if text.count(f"{law[:1].upper()}{law[1:]}. ") > 1]


@claim(cheap=True)
def no_line_is_drawn_twice(got: Got) -> None:
    """No step draws a line where one of the same plan lies already."""
    lying = dict[str, list[list[float]]]()
    for step in got.steps["steps"]:
        if step["kind"] == "line" and step["number"]:
            size = math.hypot(*step["value"][:2])
            line = [part / size for part in step["value"]]
            for old in lying.setdefault(step["plan"], []):
                apart = [max(abs(a - sign * b) for a, b in zip(line, old, strict=True)) for sign in (1, -1)]
                assert min(apart) > 1e-9 * (1 + abs(line[2])), step["sentence"]
            lying[step["plan"]].append(line)


@claim(cheap=True)
def each_step_is_listed_once(got: Got) -> None:
    """Each number is that of one entry, and stands in the protocol and on a page beside the plans."""
    steps = sorted(step["number"] for step in got.steps["steps"] if step["number"])
    assert sorted(number for entry in got.steps["entries"] for number in entry["steps"]) == steps
    listed = [(first, last or first) for first, last in NUMBERS.findall(got.protocol)]
    on_sheet = [(match[1], match[2] or match[1]) for page in got.sheets()[1:] for key, element in page.texts
                if key != "layer-results" and element.get("text-anchor") == "end"
                and (match := re.fullmatch(r"(\d+)(?:–(\d+))?", said(element)))]
    for ranges in (listed, on_sheet) if on_sheet else (listed,):
        assert {number for one, two in ranges for number in range(int(one), int(two) + 1)} >= {*steps}


@claim(cheap=True)
def what_the_scale_lays_off_is_told_in_mm(got: Got) -> None:
    """No step leaves it open how long it is what is laid off by the scale, unless it is nothing."""
    told = got.steps["steps"]
    for step in told:
        if step["instrument"] == "scale" and step["kind"] == "point" and step["number"]:
            at = [told[place]["paper"] for place in step["operands"] if told[place]["kind"] == "point"]
            nothing = any(math.dist(step["paper"], place) < 0.06 for place in at)
            assert step["lengths"] or nothing, step["sentence"]


@claim(cheap=True)
def what_is_measured_means_what_is_computed(got: Got) -> None:
    """A reading by tenths of mm gives the computed value, as near as half a tenth and four printed figures let it."""
    assert got.steps["readings"]
    for one in got.steps["readings"]:
        half = 0.5 * 10.0 ** (math.floor(math.log10(abs(one["value"]))) - 3) if one["value"] else 0.0
        assert abs(abs(one["value"]) - abs(one["computed"])) <= leeway(one) + half, one["said"]
        assert one["said"].rpartition("computed ")[2]


def leeway(one: dict[str, Any]) -> float:
    """How far off a reading may be by what tenths of mm leave open."""
    mm, marks = ([length[key] for length in one["lengths"]] for key in ("mm", "marks"))
    size = max(abs(one["value"]), abs(one["computed"]))
    if one["kind"] == "omega" and len(marks[0]) == 2:
        times = re.search(r"/[\d.]+\) · (\S+) =", one["said"])
        return TENTH / mm[1] * (1 + mm[0] / mm[1]) * number(times[1] if times else "1")
    if len(mm) > 2:  # a moment of several forces
        pairs = list(zip(mm[::2], mm[1::2], strict=True))
        return sum(TENTH * (a + b) for a, b in pairs) / min(a * b for a, b in pairs) * size * len(mm)
    return sum(TENTH / length for length in mm if length) * size * 1.01


@claim(cheap=True)
def the_pose_is_told_in_mm_of_paper(got: Got) -> None:
    """A point of the pose lies on the mechanism plan where the scene has it, at the plan's scale, to a tenth."""
    text, k_s = " ".join(got.protocol.split()), got.sheet.scale("mechanism", "s")
    told = re.search(r"Mechanism plan, in mm of paper: (.*?)\.(?= [A-Z0-9]|$)", text)
    for name, x, y in re.findall(r"(\w+) \((−?[\d.]+), (−?[\d.]+)\)", told[1] if told else ""):
        if name not in got.scene.points:
            continue  # the corner of an arc
        place = [float(coordinate) / k_s for coordinate in got.scene.points[name]]
        factor = {"cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}.get(got.scene.units.length, 1.0)
        assert all(min(abs(number(one) - mm), abs(number(one) - mm * factor)) < TENTH
                   for one, mm in zip((x, y), place, strict=True)), name
        assert all(len(one.partition(".")[2]) <= 1 for one in (x, y))


@claim(cheap=True)
def costs_and_errors_add_up(got: Got) -> None:
    """Operations are the sum of those of each instrument; the parts of an error come to all of it, and the worst result
    and step are those that are worst; each error is told in words."""
    cost, pencil = got.steps["cost"], got.steps["pencil"]
    assert sum(map(int, re.findall(r"\d+", cost["said"].partition(":")[2]))) == cost["operations"]
    assert all(0 < crossing["degrees"] <= 90 for crossing in cost["crossings"])
    relative = {(kind, of): one["relative"] for kind, named in pencil["results"].items() for of, one in named.items()}
    sizes = [size for size in relative.values() if size is not None]
    if worst := pencil["worst result"]:
        assert worst["relative"] == max(sizes) == relative[worst["kind"], worst["of"]]
        assert math.isclose(sum(share["share"] for share in worst["shares"]), 1, rel_tol=1e-9)
        best = max(worst["shares"], key=lambda share: share["share"])
        assert (pencil["worst step"]["number"], pencil["worst step"]["makes"]) == (best["number"], best["makes"])
    told = got.protocol.partition("Drawing errors on")[2]
    assert told.count("±") >= len(relative)
    mms = [number(mm) for mm in re.findall(r"±\S+\s+\(([^)]+)\)", told) if mm != "–"]
    for named in pencil["results"].values():
        assert all(one["mm"] is None or any(math.isclose(one["mm"], mm, rel_tol=0.06, abs_tol=1e-9) for mm in mms)
                   for one in named.values())


@claim()
def a_vector_has_one_letter(got: Got) -> None:
    """What a plan of velocities or accelerations calls a vector, an equation or a reading calls it, too."""
    for options in PLANS:
        sheet, told = got.sheets(*options)[0], got.data("steps", "--json", *options)
        known = {flat(vector) for stage in told["stages"] for vector in stage["vectors"]}
        known |= {flat(reading["said"].partition(":")[0].partition(" =")[0]) for reading in told["readings"]}
        plans = [panel for plan, panel in sheet.panels.items() if plan in (
            "N-plan", "velocity plan", "acceleration plan")]
        for one in sheet.labels:
            if one.key.isdigit() and one.colour not in (BLACK, GREY) and any(map(one.box.within, plans)):
                for letters in one.text.split(", "):  # parts of similar figures stand in no equation
                    assert flat(letters) in known or letters[1:2] in ("n", "t"), letters


def flat(letters: str) -> str:
    """Letters without what lowers or raises them."""
    return re.sub(r"[_^,\s]", "", letters).replace("'", "′")


@claim(cheap=True)
def no_letter_runs_into_a_number(got: Got) -> None:
    """No sentence runs a letter and a numbered mark together, as in `Epoint 65`, and nothing is no number."""
    sentences = [step["sentence"] for step in got.steps["steps"]]
    assert not [told for told in sentences if re.search(r"\w(point|line|opening|arc) \d", told)]
    assert not re.search(r"\b(nan|inf)\b", got.protocol)
