"""The tutorial: a first plan in ten minutes, a class in twenty. Its commands are data, which a test runs in order."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from html import escape
from textwrap import indent
from typing import NamedTuple

from graphplan.mechanism.scene import load
from graphplan.output.manual.chapters import TUTORIAL, Sight, SitePage
from graphplan.phrases import Said, said
from graphplan.words.tongue import Tongue

SCENE = "four-bar"
FILE = f"{SCENE}.toml"
NAMES, CLASS = "class.csv", "name,group\nStudent 1,A\nStudent 2,A\nStudent 3,B\n"


class Lesson(NamedTuple):
    """A part of a tutorial: words, then what is written to a file or typed, and the picture that it gives."""

    words: Said
    commands: tuple[str, ...] = ()
    writes: tuple[str, str] = "", ""
    picture: str = ""


def first_plan() -> list[Lesson]:
    """A first plan in ten minutes."""
    return [
        Lesson(said("A scene is a mechanism in one pose: points with their coordinates, links as lists of points, a "
                    "drive, and what is asked for. Save this as `{0}`. A point that two links name is a revolute "
                    "joint of the two; `frame` is the fixed link.", FILE), writes=(FILE, load(SCENE).text)),
        Lesson(said("Draw it. The planner finds the construction, compares its numbers with the analytic solver, and "
                    "chooses paper and scales."), (f"graphplan draw {FILE} -o sheet.svg",), picture=f"{SCENE}.svg"),
        Lesson(said("Read it as you would draw it: each stage has its vector equation and its law, each step one "
                    "movement of the hand with its length in mm of this sheet."), (f"graphplan steps {FILE}",)),
        Lesson(said("The numbers, with a proven bound of each; and the construction beside the solver, number by "
                    "number."), (f"graphplan solve {FILE}", f"graphplan check {FILE}")),
        Lesson(said("The same with a polar plan in the place of orthogonal velocities, and in German."),
               (f"graphplan draw {FILE} --plan polar --language de -o polar.svg",)),
        Lesson(said("Let it move: open the page in a browser, drag the crank or a pin, go through the steps in any "
                    "pose."), (f"graphplan live {FILE} -o moving.html",)),
        Lesson(said("A machine of your own begins with a scene in which every section is explained; or with one from "
                    "another program."), ("graphplan new machine.toml",)),
    ]


def a_class() -> list[Lesson]:
    """A class in twenty minutes."""
    return [
        Lesson(said("One handout for all: the task, the construction with boxes to tick, the solution, which lie "
                    "exactly over each other."), (f"graphplan handout {FILE} -o handout.pdf",)),
        Lesson(said("Or a task for each student. The table `[vary]` at the end of the scene says which numbers differ, "
                    "by their paths. Save the names of the class as `{0}`, a table with a column `name`.", NAMES),
               writes=(NAMES, CLASS)),
        Lesson(said("What cannot be assembled, is near a singular pose or gives vectors that a ruler cannot read is "
                    "drawn anew. The folder has a booklet to print, whose sheets have coded corners, and the key."),
               (f"graphplan variants {FILE} --names {NAMES} -o tasks",)),
        Lesson(said("Scan what is handed in, in any order, into a folder or one PDF file, such as `scans.pdf`. Each "
                    "sheet is judged by the scene that its corners name: score, first wrong step, kind of mistake; "
                    "corrected sheets to hand back stand in `tasks/results`. Type `graphplan verify tasks "
                    "scans.pdf`.")),
        Lesson(said("One drawing alone, also measured points or a CAD file, is judged by "
                    "`graphplan verify SCENE DRAWING`; `--report` draws the findings over it.")),
    ]


TUTORIALS = {said("A first plan in ten minutes"): first_plan, said("A class in twenty minutes"): a_class}


def tutorial(pictures: Collection[str], tongue: Tongue) -> str:
    """The page of both, with those pictures that the site has."""
    page = SitePage(tongue, TUTORIAL)

    def body() -> Iterator[str]:
        for title, lessons in TUTORIALS.items():
            yield f"<h2>{page.say(title)}</h2>"
            yield "<ol>"
            for lesson in lessons():
                yield f"<li>{page.paragraph(lesson.words)}"
                name, text = lesson.writes
                if name:
                    yield f"<pre>{escape(text.strip())}</pre>"
                if lesson.commands:
                    yield f"<pre>{escape(chr(10).join(lesson.commands))}</pre>"
                if lesson.picture in pictures:
                    yield Sight(lesson.picture, page.tongue(title), lesson.picture).figure
                yield "</li>"
            yield "</ol>"

    return page.page(tongue(said("Tutorial")), body())


def markdown(pictures: Collection[str], tongue: Tongue) -> str:
    """Both as Markdown, for a code host."""
    def page_lines() -> Iterator[str]:
        yield f"# {tongue(said('Tutorial'))}"
        for title, lessons in TUTORIALS.items():
            yield f"## {tongue(title)}"
            for number, lesson in enumerate(lessons(), 1):
                blocks = [lesson.writes[1].strip()] if lesson.writes[0] else []
                blocks += ["\n".join(lesson.commands)] if lesson.commands else []
                item = [tongue(lesson.words), *(f"```\n{block}\n```" for block in blocks)]
                item += [f"![{tongue(title)}]({lesson.picture})"] if lesson.picture in pictures else []
                yield f"{number}. " + indent("\n\n".join(item), "   ").lstrip()

    return "\n\n".join(page_lines()) + "\n"
