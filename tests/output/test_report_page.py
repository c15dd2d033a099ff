"""The pages of judged drawings: everything of a student's file is escaped, nothing is fetched or run, tables are whole.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser

import pytest

import graphplan as gp
from graphplan.kernel.kinds import POINT
from graphplan.marking.classroom.results import Classroom, MarkedDrawing, Unread
from graphplan.marking.judge.overlay import overlay
from graphplan.marking.judge.score import score
from graphplan.marking.judge.verdict import RIGHT, UNSEEN, WRONG, Judgement, NumberVerdict, Verdict
from graphplan.marking.traces import PlanFrame, StudentNumber, Trace
from graphplan.output.report_page import class_list, report_page
from graphplan.phrases import said
from graphplan.sheet.layout.composition import compose
from graphplan.words.tongue import ENGLISH

HOSTILE = "<script>alert(1)</script>\"'&<img src=x onerror=alert(1)>"
VOID = {"meta", "br", "hr", "input", "link", "img"}
Tag = tuple[str, dict[str, str | None]]


class Reader(HTMLParser):
    """Reads a page: its elements, which must be closed in order, and its text."""

    def __init__(self, page: str):
        super().__init__()
        self.open: list[str] = []
        self.tags: list[Tag] = []
        self.text = ""
        self.feed(page)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data

    def all(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.tags if name == tag]


@cache
def judgement() -> Judgement:
    """A four-bar of which the points are seen, the first crossing is wrong, and every name is hostile."""
    drawing = gp.construct(gp.load("four-bar"))
    composition = compose(drawing)
    frames = {panel: PlanFrame(complex(*view.origin), view.scale) for panel, view in composition.views.items()}
    wrong = next(step.index for step in drawing.drawn.steps if step.op.name == "meet")
    verdicts = []
    for step in drawing.drawn.steps:
        if step.op.gives != POINT:
            verdicts.append(Verdict(step.index, UNSEEN))
            continue
        here = composition.views[composition.plans.plan_of_step[step.index]](composition.plans.spot(step.index))
        told = said("parallel to {0} instead of {1}", HOSTILE, HOSTILE) if step.index == wrong else None
        verdicts.append(Verdict(step.index, WRONG if told else RIGHT, 2.0, 0.5, 2.0, Trace(POINT, (here,), HOSTILE),
                                drawing.values[step.index], None, told, "wrong line" if told else ""))
    number = NumberVerdict(StudentNumber(HOSTILE, HOSTILE, (1.0, 2.0), HOSTILE), WRONG, 1.0, 0.5, (1.0, 1.0))
    spare = Trace(POINT, ((0.0, 0.0),), HOSTILE)
    return Judgement(HOSTILE, drawing, composition, frames, tuple(verdicts), (spare,), (number,))


@cache
def page() -> str:
    found = judgement()
    return report_page(found, score(found), overlay(found, score(found)))


@cache
def class_page() -> str:
    found = judgement()
    room = Classroom(HOSTILE, (MarkedDrawing(found, score(found)),), (Unread(HOSTILE, HOSTILE),))
    return class_list(room, ENGLISH)


@pytest.mark.parametrize("make", [page, class_page])
def test_what_students_write_is_told_and_never_run(make: object) -> None:
    """Hostile names stand on the page as text: there is no script, no picture, no handler, nothing to be fetched."""
    assert callable(make)
    found = Reader(make())
    assert HOSTILE in found.text
    names = {tag for tag, _ in found.tags}
    assert not names & {"script", "img", "link", "iframe", "object", "a", "image", "use", "foreignobject"}
    attributes = {name for _, held in found.tags for name in held}
    assert not {name for name in attributes if name.startswith("on")} | attributes & {"src", "href", "xlink:href"}
    assert not re.search(r"url\(|@import", make())


def test_the_page_forbids_what_could_be_fetched() -> None:
    """Its policy allows the style that stands in it, and nothing else."""
    policy = [held["content"] for held in Reader(page()).all("meta") if "http-equiv" in held]
    assert policy == ["default-src 'none'; style-src 'unsafe-inline'"]


def test_every_step_has_a_row() -> None:
    """All steps stand in the table, and what is seen of the pose, each with its verdict as class and in words."""
    found, drawn = Reader(page()), judgement().drawing.drawn
    looks = [held["class"] for held in found.all("tr") if held.get("class") in (RIGHT, UNSEEN, WRONG)]
    steps = [verdict.state for verdict in judgement().verdicts]
    assert looks == [WRONG, *steps]  # the number comes first
    assert len(steps) == len(drawn)


def test_tables_can_be_heard() -> None:
    """Each table has a caption, heads for its columns, and a head in each row."""
    found = Reader(page())
    tables = len(found.all("table"))
    assert tables == len(found.all("caption")) == len(found.all("thead")) == 3
    scopes = [held.get("scope") for held in found.all("th")]
    assert scopes.count("row") == len(found.all("tr")) - tables
    assert None not in scopes


def test_the_overlay_is_in_the_page() -> None:
    """The sheet stands in it as a picture that says what matters most."""
    picture, *_ = [held for held in Reader(page()).all("svg") if held.get("role") == "img"]
    assert (picture["aria-label"] or "").startswith("First wrong is v_b (step 4):")


def test_a_wrong_point_of_the_pose_is_told_by_its_letter() -> None:
    """It has no step, and so no number."""
    found = judgement()
    spoilt = replace(found, verdicts=(replace(found.verdicts[0], state=WRONG), *found.verdicts[1:]))
    text = class_list(Classroom("", (MarkedDrawing(spoilt, score(spoilt)),)), ENGLISH)
    letter = spoilt.drawing.drawn.text(0)
    assert f'<td class="figure">{letter}</td>' in text
    assert f'<th scope="row">the given point {letter}</th>' in text


def test_bars_are_as_long_as_their_counts() -> None:
    """The only drawing goes wrong at the only step, so the bars have their full length."""
    assert [held["style"] for held in Reader(class_page()).all("span")] == ["width: 16.00em"] * 2
