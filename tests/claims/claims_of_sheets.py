"""Claims about construction sheets: what the SVG has on paper, beside the results and the list of steps.

Lengths are mm of paper. What is drawn has coordinates of a hundredth, what is printed four digits.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator
from itertools import combinations

import shapely
from claim import claim
from face import Got
from inked_sheet import GREY, NS, WRITTEN, InkedSheet, Vector, number, said
from svg2 import faults as faults_of_svg

OFF = 0.01  # of a mark, beside where the list of steps has it
MEASURED = 0.03  # of a vector: both its ends are written to a hundredth
PRINTED = 6e-4  # of a number: it is printed in four digits
WAYS = (), ("--plan", "polar"), ("--set", "sheet.frame=gost"), ("--numbers",)
PLANS = {"orthogonal": (), "polar": ("--plan", "polar")}
FORCES = "load", "reaction", "part", "balance"
LETTERS = {"velocity": "v", "acceleration": "a", "omega": "ω", "alpha": "α"}
FACT = re.compile(r"^(.+?) = (−?[\d.]+(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?) ?([^∠±]*)(?:∠ (\S+)°)?\s*(?:± (\S+) %)?$")


# ---- paper and letters -----------------------------------------------------------------------------------------------


@claim()
def nothing_leaves_the_frame_and_no_lettering_covers_other(got: Got) -> None:
    """Each stroke, symbol and letter of each page lies in the frame, and off other letters, however it is drawn."""
    for way in WAYS:
        for page in got.sheets(*way):
            assert page.outside == [], way
            assert page.letters_on_letters == [], way


@claim()
def letters_stand_at_their_marks(got: Got) -> None:
    """Letters are nearest to their own marks or tied to them by a line, short but for one in a hundred, and no line
    runs through them."""
    for way in (), ("--plan", "polar"):
        sheet = got.sheets(*way)[0]
        assert sheet.lines_through_labels == []
        assert sheet.labels_nearer_to_others == []
        assert len(sheet.long_leaders) <= len(sheet.labels) / 100


@claim(cheap=True)
def letters_can_be_read(got: Got) -> None:
    """Capitals of the plans' page are 1.8 mm high at least, and so are those of subscripts; no vector is a mere dot."""
    assert got.sheet.smallest_letters >= 1.8 - WRITTEN
    assert got.sheet.smallest_subscripts >= 1.8 - WRITTEN
    assert all(vector.line.length > 0.3 for vector in got.sheet.vectors if vector.name)


@claim(cheap=True)
def panels_lie_apart_and_take_most_of_the_page(got: Got) -> None:
    """Each plan has a panel in the frame, off the others and wide enough for its heading; all take half of the page."""
    panels = got.sheet.panels
    assert {*panels} == {step["plan"] for step in got.steps["steps"]}
    assert all(got.sheet.frame.buffer(WRITTEN).contains(panel) for panel in panels.values())
    assert not [pair for pair in combinations(panels, 2)
                if panels[pair[0]].intersection(panels[pair[1]]).area > WRITTEN]
    assert all(panel.bounds[2] - panel.bounds[0] > 20 for panel in panels.values())
    assert got.sheet.plans_of_page > 0.5


@claim(cheap=True)
def what_is_constructed_stays_on_its_panel(got: Got) -> None:
    """Each stroke of a step lies on one panel, also where its mark lies far outside."""
    panels = [panel.buffer(WRITTEN) for panel in got.sheet.panels.values()]
    assert not [stroke.key for stroke in got.sheet.strokes
                if stroke.key.isdigit() and not any(panel.contains(stroke.line) for panel in panels)]


@claim(cheap=True)
def each_point_and_link_has_its_letter_once(got: Got) -> None:
    """Points are lettered and links numbered once on the plan of the mechanism, or in a detail of it."""
    found = [Counter[str](), Counter[str]()]
    for one in got.sheet.labels:
        if one.key == "layer-letters" or one.key == "0" or one.key == "layer-enlarged":
            found[one.key == "layer-enlarged"].update(re.split(", | ≡ ", one.text))
    names = {name.replace("_", "") for name in (*got.scene.points, *got.scene.moving)}
    assert not names - found[0].keys() - found[1].keys() - {one.text for one in got.sheet.labels}
    assert not [name for name in got.scene.points if found[0][name] > 1 or found[1][name] > 1]


@claim(cheap=True)
def scales_are_round(got: Got) -> None:
    """Each plan tells its scales in its heading; all are 1, 2, 2.5, 4 or 5 times a power of ten."""
    assert got.sheet.odd_scales == []
    for plan in got.sheet.panels:
        told = " ".join(got.sheet.captions(plan))
        assert re.search(r"k[svaF] = ", told), plan
        assert ("kF = " in told) >= any(vector.name.startswith("load ") for vector in vectors_on(got.sheet, plan))
    assert got.sheet.scale("mechanism", "s") > 0


@claim(cheap=True)
def svg_is_valid_and_rounded(got: Got) -> None:
    """Each page is SVG 2 in millimetres, whose coordinates have two decimals, and radii four; none is nan or -0."""
    for page in got.files("svg"):
        assert faults_of_svg(page.decode()) == []
    text = re.sub(r"<(title|desc|text|tspan|metadata)[^>]*>[^<]*", "", got.svg)
    radii = re.findall(r'(?:\br="|\bA )([\d.]+)', text)
    assert all(len(radius.partition(".")[2]) <= 4 for radius in radii)
    text = re.sub(r'\br="[\d.]+"|\bA [\d.]+ [\d.]+', "", text)
    numbers = re.findall(r"(?<![\w#.])-?\d+\.?\d*(?:e-?\d+)?(?![\w.])", text)
    assert all(len(one.partition(".")[2]) <= 2 for one in numbers if one != "1.0")
    assert not re.search(r"\bnan\b|\binf\b|[\" ,]-0(\.0*)?[\" ,]", text)
    _, _, wide, high = got.sheet.root.get("viewBox", "").split()
    assert (got.sheet.root.get("width"), got.sheet.root.get("height")) == (f"{wide}mm", f"{high}mm")


@claim(cheap=True)
def the_scene_is_in_the_sheet(got: Got) -> None:
    """It stands there line by line, with its design and its paper among the keys of [sheet]."""
    text = got.sheet.root.findtext(f"{NS}metadata") or ""
    assert {*got.scene.text.splitlines()} <= {*text.splitlines()}
    assert f'paper = "{got.steps["pencil"]["paper"]}"' in text


# ---- marks and vectors -----------------------------------------------------------------------------------------------


@claim()
def marks_lie_where_the_steps_tell(got: Got) -> None:
    """The middle of a step's circle, and both ends of a vector that is asked for, are where `steps` has marks."""
    for options in PLANS.values():
        sheet, told = got.sheets(*options)[0], got.data("steps", "--json", *options)["steps"]
        places = {str(step["number"]): step["paper"] for step in told if step["kind"] == "point" and step["number"]}
        marks = [(key, spot) for key, spot in sheet.marks_on_plans if key != "0"]
        assert len(marks) > 3
        assert not [key for key, spot in marks if math.dist(places[key], (spot.x, spot.y)) > OFF]
        spots = shapely.STRtree([shapely.Point(step["paper"]) for step in told if step["kind"] == "point"])
        for vector in (vector for vector in sheet.vectors if vector.name.partition(" ")[0] in LETTERS):
            assert all(len(spots.query(shapely.Point(end), "dwithin", 2 * OFF)) for end in vector.line.coords)


@claim()
def vectors_measure_what_is_printed(got: Got) -> None:
    """Each velocity and acceleration, measured and times the scale of its plan, is the result; no long one is left out.

    On orthogonal plans velocities are turned by a quarter."""
    for plan, options in PLANS.items():
        sheet, seen = got.sheets(*options)[0], set()
        asked = {(kind, name): complex(*point[kind]) for name, point in got.solved["points"].items()
                 for kind in ("velocity", "acceleration") if point.get(kind) is not None}
        for vector in sheet.vectors:
            kind, _, point = vector.name.partition(" ")
            if kind in ("velocity", "acceleration"):
                drawn = measured(vector)
                scale = sheet.scale(sheet.plan_at(*vector.line.coords), kind[0])
                true = asked[kind, point] * (1j if kind == "velocity" and plan == "orthogonal" else 1)
                assert abs(drawn * scale - true) < MEASURED * scale + PRINTED * abs(true), vector.name
                seen.add((kind, point))
        largest = {kind: max(abs(value) for (one, _), value in asked.items() if one == kind) for kind, _ in asked}
        assert {key for key, value in asked.items() if abs(value) > 0.05 * largest[key[0]]} <= seen


@claim(cheap=True)
def steps_have_groups_in_their_order(got: Got) -> None:
    """The ink of a step is a group with its number, titled with its sentence; only openings and lines leave none."""
    told = {step["number"]: step for step in got.steps["steps"]}
    groups = {int(group.get("data-step", -1)): group for group in got.sheet.root if group.get("class") == "step"}
    assert [*groups] == sorted(groups)
    for step, group in groups.items():
        if step:
            title = group.findtext(f"{NS}title") or ""
            assert title.startswith(told[step]["sentence"].rstrip(".")), step
    enlarged = {int(element.get("data-step", -1)) for group in got.sheet.root for element in group}
    inkless = told.keys() - groups.keys() - enlarged - {0}
    assert not [step for step in inkless if told[step]["kind"] not in ("opening", "line")
                and not got.scene.loads]  # a force may be too small for an arrow


@claim()
def each_mark_may_bear_its_number(got: Got) -> None:
    """With `--numbers` each marked point has the number of its step once, and the words stay as they are."""
    sheet, *words = got.sheets("--numbers")
    numbers = [[step for one in sheet.labels if one.colour == GREY and (one.key == "layer-enlarged") == enlarged
                for step in one.text.split(", ") if step.isdigit() and one.key.isdigit()] for enlarged in (False, True)]
    assert not [step for step, count in Counter(numbers[0]).items() if count > 2]  # on the plan, and in its detail
    assert {key for key, _ in sheet.marks if key != "0"} <= {*numbers[0], *numbers[1]}
    assert [[one.text for one in page.lettering] for page in words] == [
        [one.text for one in page.lettering] for page in got.sheets()[1:]]


@claim()
def a_step_shows_what_is_drawn_by_then(got: Got) -> None:
    """With `--steps 1-N` there is all that it and the steps before have drawn, and no result."""
    last = max(step["number"] for step in got.steps["steps"]) // 2
    shown = got.sheets("--steps", f"1-{last}")[0]
    drawn, whole = ({key for key, _ in sheet.elements if key.isdigit()} for sheet in (shown, got.sheet))
    assert drawn == {key for key in whole if int(key) <= last}
    assert not {"found", "layer-results"} & {key for key, _ in shown.texts}


# ---- what is given and found -----------------------------------------------------------------------------------------


@claim(cheap=True)
def problem_and_answer_stand_under_one_heading_each(got: Got) -> None:
    """What is given and what was found has one heading each, and of results there is one a line."""
    texts = [(key, said(element)) for page in got.sheets() for key, element in page.texts]
    assert [[text for _, text in texts].count(heading) for heading in ("Given", "Found")] == [1, 1]
    given = [text for key, text in texts if key == "given"]
    assert not [line for line in given if line.endswith("=") or line[0] in "=−0123456789" or "\u00a0" in line]
    assert [text for key, text in texts if key == "found" and text != "Found"]


@claim(cheap=True)
def what_is_found_is_what_was_asked(got: Got) -> None:
    """Each velocity, acceleration and rate that nothing prescribes is told with its size, direction and error."""
    facts, errors = dict(found(got)), got.steps["pencil"]["results"]
    driven = {drive.link for drive in got.scene.drives if hasattr(drive, "link")} | {*got.scene.motions}
    for kind, name, value in results(got):
        symbol, size = f"{LETTERS[kind]}{name.replace('_', '')}", abs(value)
        assert symbol in facts or name in driven, symbol
        if symbol not in facts:
            continue
        told, angle, error = facts[symbol]
        largest = max(abs(other) for one, _, other in results(got) if one == kind)
        if size < 1e-9 * largest or told == 0:
            assert told == 0
            assert size < 1e-7 * max(largest, 1)
            continue
        assert math.isclose(told, size if isinstance(value, complex) else value, rel_tol=PRINTED), symbol
        if isinstance(value, complex):
            off = math.degrees(math.atan2(value.imag, value.real)) - (angle or 0.0)
            assert abs((off + 180) % 360 - 180) < 0.06, symbol
        relative = (errors[kind][name]["value"] or 0.0) / size
        assert bool(error) == (relative > 0.01)
        assert not error or error == ">99" or math.isclose(number(error), 100 * relative, rel_tol=0.06), symbol


@claim(cheap=True)
def lengths_are_given_by_the_points(got: Got) -> None:
    """A length under what is given is that between the scene's points."""
    given = " ".join(said(element) for page in got.sheets() for key, element in page.texts if key == "given")
    points = {name: complex(*map(float, place)) for name, place in got.scene.points.items()}
    lengths = re.search(r"Links: (.*?) (?:mm|cm|m|in|ft)\b", given)
    for pair, told in re.findall(r"(\w+) = ([\d.]+)", lengths[1] if lengths else ""):
        ends = next((pair[:k], pair[k:]) for k in range(1, len(pair)) if pair[:k] in points and pair[k:] in points)
        assert math.isclose(abs(points[ends[1]] - points[ends[0]]), float(told), rel_tol=PRINTED), pair


def found(got: Got) -> Iterator[tuple[str, tuple[float, float | None, str]]]:
    """The results on the sheet, by symbol: size, angle and error in per cent."""
    for page in got.sheets():
        for key, element in page.texts:
            if key == "found" and (fact := FACT.match(said(element))):
                yield fact[1], (number(fact[2]), number(fact[4]) if fact[4] else None, fact[5] or "")


def results(got: Got) -> Iterator[tuple[str, str, complex | float]]:
    """The velocities, accelerations and rates that `solve` prints."""
    for name, point in got.solved["points"].items():
        yield from ((kind, name, complex(*value)) for kind, value in point.items() if kind in LETTERS and value)
    for name, link in got.solved["links"].items():
        yield from ((kind, name, value) for kind, value in link.items() if kind in LETTERS and value is not None)


# ---- forces ----------------------------------------------------------------------------------------------------------


@claim(cheap=True, having=lambda scene: scene.loads)
def given_forces_measure_what_the_scene_gives(got: Got) -> None:
    """Millimetres times the scale of a plan are the newtons of the scene, wherever the force is drawn."""
    counts = Counter[str]()
    for force in got.scene.loads.forces if got.scene.loads else ():
        name = f"load P_{force.on}" + "'" * counts[force.on]
        counts[force.on] += 1
        arrows = [vector for vector in got.sheet.vectors if vector.name == name]
        assert arrows, name
        for vector in arrows:
            scale = got.sheet.scale(got.sheet.plan_at(*vector.line.coords), "F")
            size = math.hypot(*map(float, force.value))
            assert abs(vector.line.length * scale - size) < MEASURED * scale + PRINTED * size, name


@claim(cheap=True, having=lambda scene: scene.loads)
def reactions_measure_what_is_told(got: Got) -> None:
    """A reaction under what was found has its arrows, on plans with friction the last ones, of that many newtons."""
    frictional = {plan for plan in got.sheet.panels if "with friction" in plan}
    for symbol, (size, _, _) in found(got):
        if not symbol.startswith("R"):
            continue
        names = {symbol.partition(" at ")[0], swapped(symbol.partition(" at ")[0])}
        told = []
        for vector in got.sheet.vectors:
            kind, _, letter = vector.name.partition(" ")
            if kind == "reaction" and letter.replace("_", "") in names:
                plan = got.sheet.plan_at(*vector.line.coords)
                scale = got.sheet.scale(plan, "F")
                if bool(frictional) <= (plan in frictional):
                    told.append(abs(vector.line.length * scale - size) < MEASURED * scale + PRINTED * size)
        assert told == [] or (any if frictional else all)(told), symbol


@claim(cheap=True, having=lambda scene: scene.loads)
def each_force_has_its_letter_on_its_plan(got: Got) -> None:
    """Where a force is drawn its letter stands on the same panel, alone or with others that lie on it."""
    for plan, panel in got.sheet.panels.items():
        letters = {letter for one in got.sheet.labels if panel.intersects(one.box) for letter in one.text.split(", ")}
        for vector in vectors_on(got.sheet, plan):
            kind, _, name = vector.name.partition(" ")
            if kind in FORCES:
                assert lettered(name) in letters, (plan, vector.name)


@claim(cheap=True, having=lambda scene: scene.loads)
def the_lever_is_in_balance(got: Got) -> None:
    """About the pole of Zhukovsky's lever the moments of loads and balance cancel out as they are drawn; the lever's
    arms from the pole have their letters."""
    if "lever" not in got.sheet.panels:
        return
    assert got.sheet.captions("lever")[0].startswith("Zhukovsky's lever")
    assert got.sheet.scale("lever", "v") > 0
    pole = next(complex(*step["paper"]) for step in got.steps["steps"]
                if (step["plan"], step["makes"]) == ("lever", "o"))
    forces = [vector for vector in vectors_on(got.sheet, "lever") if vector.name.split()[0] in FORCES]
    ends = [[complex(*end) for end in vector.line.coords] for vector in forces]
    moments = [((start - pole).conjugate() * (end - start)).imag for start, end in ends]
    assert abs(sum(moments)) <= 2e-3 * sum(map(abs, moments)) + 0.1 * sum(abs(end - start) for start, end in ends)
    arms = [(key, said(element)) for key, element in got.sheet.texts if key == "layer-arms"]
    assert all(text.startswith("h") for _, text in arms)
    assert len(arms) <= len(forces)


def lettered(name: str) -> str:
    """The letters of a force as they are set: P′2 of P_2'."""
    letter, _, of = name.partition("_")
    return letter + {0: "", 1: "′", 2: "″", 3: "‴"}[of.count("'")] + of.rstrip("'")


def swapped(letter: str) -> str:
    """The letter of the opposite reaction: R12 for R21, as far as links have names of one letter."""
    links = letter[1:].split(",") if "," in letter else [letter[1:2], letter[2:]]
    return "R" + ("," if "," in letter else "").join(links[::-1])


def vectors_on(sheet: InkedSheet, plan: str) -> list[Vector]:
    """The vectors with a name on a plan."""
    panel = sheet.panels[plan].buffer(WRITTEN)
    return [vector for vector in sheet.vectors if vector.name and panel.contains(vector.line)]


def measured(vector: Vector) -> complex:
    """A vector as it is drawn, in mm, y upwards."""
    start, end = (complex(*spot) for spot in vector.line.coords)
    return (end - start).conjugate()


# ---- the mechanism ---------------------------------------------------------------------------------------------------


@claim(cheap=True)
def the_machine_lies_under_its_links(got: Got) -> None:
    """Teeth, slots and cams are a layer of their own within the plan of the mechanism, under all that is drawn."""
    layers = [group.get("class") for group in got.sheet.root if group.get("class")]
    if "layer-machine" in layers and "layer-links" in layers:
        assert layers.index("layer-machine") < layers.index("layer-links")
    panel = got.sheet.panels["mechanism"].buffer(WRITTEN)
    assert not [stroke for stroke in got.sheet.strokes
                if stroke.key in ("layer-machine", "layer-motion") and not panel.contains(stroke.line)]
