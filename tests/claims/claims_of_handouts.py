"""Claims about handouts: the task and its guided version lie over the solution and give none of it away."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterable, Iterator

import shapely
from claim import claim
from face import Got
from handed_out import handed_out
from inked_sheet import NEAR, NS, WRITTEN, InkedSheet, said, stroked

PLACES = "pole", "slide arm", "centre"  # kinds of results that are two coordinates
MECHANISM = "layer-plates", "layer-links", "layer-blocks", "layer-pairs", "layer-ground"
LINE = 5.0  # mm: of a page of words


@claim()
def the_first_page_lies_over_the_solution(got: Got) -> None:
    """It has the paper, frame and panels of that; pages of words are A4; nothing covers letters or leaves a frame."""
    task, guided, solution = handed_out(got.name)
    for first, *others in (task, guided):
        assert first.root.get("viewBox") == solution[0].root.get("viewBox")
        assert first.frame.equals(solution[0].frame)
        assert {plan: panel.wkt for plan, panel in first.panels.items()} == {
            plan: panel.wkt for plan, panel in solution[0].panels.items()}
        assert all(sorted(page.root.get("viewBox", "").split()[2:]) == ["210", "297"] for page in others)
        for page in (first, *others):
            assert page.outside == []
            assert page.letters_on_letters == []
            boxes = [shapely.Polygon(line) for box in boxes_of(page) for line in stroked(box)]
            assert not [one.text for one in page.lettering for box in boxes
                        if box.exterior.intersects(one.box.buffer(-NEAR))]


@claim()
def a_task_has_the_mechanism_and_where_plans_begin(got: Got) -> None:
    """Of the steps it has only the marks where plans begin; the mechanism is that of the solution."""
    task, _, solution = handed_out(got.name)
    begins = {str(step["number"]) for step in got.steps["steps"] if step["operation"] in ("begin", "pole")}
    assert {key for key, _ in task[0].elements if key.isdigit()} <= begins | {"0"}
    drawn = shapely.union_all([stroke.line for stroke in task[0].strokes]).buffer(2 * WRITTEN)
    assert not [stroke.key for stroke in solution[0].strokes
                if stroke.key in MECHANISM and not drawn.covers(stroke.line)]
    assert "layer-motion" not in {key for key, _ in task[0].elements}


@claim()
def each_number_that_is_asked_has_an_empty_box(got: Got) -> None:
    """A box for each component and size of a result, on the task and on the guided version."""
    asked = sum(1 if not isinstance(value, tuple) else 2 if any(place in kind for place in PLACES) else 3
                for kind, named in got.drawing.computed.items() for value in named.values())
    for pages in handed_out(got.name)[:2]:
        assert sum(1 for page in pages for _ in boxes_of(page)) == asked > 0


@claim()
def guided_steps_are_all_there_with_a_box_to_tick(got: Got) -> None:
    """Each step stands once in the guided version, by its number, with one box."""
    guided = handed_out(got.name)[1]
    steps = {str(step["number"]) for step in got.steps["steps"] if step["number"]}
    ticks = Counter(key for page in guided for key, element in page.elements
                    if key.isdigit() and element.tag == f"{NS}polygon" and element.get("fill") == "none")
    assert ticks == dict.fromkeys(steps, 1)
    listed = Counter(said(element) for page in guided for key, element in page.texts
                     if key.isdigit() and element.get("text-anchor") == "end")
    assert {step for step in steps if listed[step] != 1} == set()


@claim()
def a_task_gives_no_result_away(got: Got) -> None:
    """What is given is that of the solution; what was found, and the numbers of its tables, stand on no task."""
    task, _, solution = handed_out(got.name)
    assert texts(task[:1], "given") == texts(solution[:1], "given") or not texts(solution[:1], "given")
    assert texts(task, "found") == texts(task, "layer-results") == []
    figures = {text for text in texts(solution, "layer-results") if text.lstrip("−").replace(".", "").isdigit()
               and len(text) > 4}
    given = " ".join(text for text in (*texts(task, "layer-text"), *texts(task, "given"), *texts(task, "layer-drive")))
    told = {said(element) for page in task for _, element in page.texts}
    assert not [figure for figure in figures & told if figure not in given]


@claim()
def a_task_says_what_is_asked_and_at_which_scales(got: Got) -> None:
    """Its words name all points and links that are asked for, give no coordinates of points of links, and tell each
    plan's scale once more than its heading; its dimensions are facts that are given."""
    task = handed_out(got.name)[0]
    words = " ".join(said(element) for page in task for key, element in page.texts if key == "layer-text")
    assert all(name.replace("_", "") in words for name in (*(got.scene.find.velocity or ()),
                                                           *(got.scene.find.acceleration or ())))
    assert {"Name", "Group", "Date", "Variant"} <= {said(element) for _, element in task[0].texts}
    assert "graphplan" not in {said(element) for page in task for _, element in page.texts}
    for plan in task[0].panels:
        scale = " ".join(task[0].captions(plan)).rpartition(" = ")[2].strip()
        assert words.count(scale) >= 2, plan
    if len(task) > 1:
        named = " ".join(said(element) for key, element in task[1].texts)
        assert all(f"about {centre}" in named for gear in got.scene.gears for centre in gear.centres)
        assert all(f"at {contact.at}" in named for contact in got.scene.contacts)
    facts = " ".join(texts(task, "given"))
    dimensions = texts(task[:1], "layer-dimensions")
    assert not [one for one in dimensions if one.rpartition(" = ")[0] not in facts]


@claim()
def no_page_of_words_is_nearly_blank(got: Got) -> None:
    """In the columns of each page of words but the last a fifth of the lines at least has letters or boxes."""
    for pages in handed_out(got.name)[:2]:
        for page in pages[1:-1]:
            middle, top = page.frame.centroid.x, page.frame.bounds[3] - page.frame.bounds[1]
            spots = [one.box.bounds[:2] for one in page.lettering]
            spots += [line.bounds[:2] for box in boxes_of(page) for line in stroked(box)]
            assert len({(x > middle, int(y // LINE)) for x, y in spots}) > 2 * top / LINE / 5


def boxes_of(page: InkedSheet) -> Iterator[ET.Element]:
    """The boxes for numbers on a page."""
    return (element for key, element in page.elements if key == "layer-blanks")


def texts(pages: Iterable[InkedSheet], key: str) -> list[str]:
    """What is written in a layer of some pages."""
    return [said(element) for page in pages for own, element in page.texts if own == key]
