"""The tutorial in six lessons, from the board to a machine over its cycle. Its commands are data, which a test runs.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from html import escape
from textwrap import indent
from typing import NamedTuple

from graphplan.mechanism.scene import source_text
from graphplan.phrases import Said, said
from graphplan.site.chapters import TUTORIAL, Sight, SitePage, preformatted_block
from graphplan.words.tongue import Tongue

FILE = "four-bar.toml"
NAMES, CLASS = "class.csv", "name,group\nStudent 1,A\nStudent 2,A\nStudent 3,B\n"


class Lesson(NamedTuple):
    """A part of a tutorial: words, then what is typed or written to a file, and the picture that it gives."""

    words: Said
    commands: str = ""
    writes: tuple[str, str] = "", ""
    picture: str = ""


TUTORIALS = {
    said("A mechanism on the board"): (
        Lesson(said("Begin with the mouse: `graphplan board {0}` opens a page. Point puts down four points, Link joins "
                    "two at a time (Enter ends a link), Fixed pivot holds the first and the last, Drive turns the "
                    "first link, Ask wants a point's motion. Sheet, steps and numbers follow, and Save writes the "
                    "file.", FILE)),
        Lesson(said("Select drags a point, and a click on an object shows its numbers; a length that is typed is kept. "
                    "The tab Scene has the same mechanism as text: what is typed there is drawn.")),
    ),
    said("A first plan in ten minutes"): (
        Lesson(said("A scene is a mechanism in one pose: points with their coordinates, links as lists of points, a "
                    "drive, and what is asked for. Save this as `{0}`. A point that two links name is a revolute "
                    "joint of the two; `frame` is the fixed link.", FILE),
               writes=(FILE, source_text("four-bar", FILE))),
        Lesson(said("Draw it. The planner finds the construction, compares its numbers with the analytic solver, and "
                    "chooses paper and scales."), "graphplan draw four-bar.toml -o sheet.svg", picture="four-bar.svg"),
        Lesson(said("Read it as you would draw it: each stage has its vector equation and its law, each step one "
                    "movement of the hand with its length in mm of this sheet."), "graphplan steps four-bar.toml"),
        Lesson(said("The numbers, with a proven bound of each; and the construction beside the solver, number by "
                    "number."), "graphplan solve four-bar.toml\ngraphplan check four-bar.toml"),
        Lesson(said("The same with a polar plan instead of orthogonal velocities, and in German."),
               "graphplan draw four-bar.toml --plan polar --language de -o polar.svg"),
        Lesson(said("Let it move: open the page in a browser, drag the crank or a pin, go through the steps in any "
                    "pose."), "graphplan live four-bar.toml -o moving.html"),
        Lesson(said("A machine of your own begins with a scene in which every section is explained; or with one from "
                    "another program."), "graphplan new machine.toml"),
    ),
    said("Accelerations"): (
        Lesson(said("The plan of relative normal accelerations has for each link v²/r, from the plan of velocities by "
                    "the semicircle. Perpendiculars through its ends are loci: where two of them meet, an end lies."),
               "graphplan steps four-bar\ngraphplan draw four-bar -o accelerations.svg", picture="four-bar.svg"),
        Lesson(said("On a polar plan all begin in one pole, normal and tangential parts head to tail."),
               "graphplan draw four-bar --plan polar -o polar.svg"),
        Lesson(said("The numbers say which way the vectors point: true velocities and accelerations, not turned."),
               "graphplan solve four-bar"),
        Lesson(said("The block 2 slides along link 3, which turns. Points that lie together have names of their own: A "
                    "on the block, A3 on the slotted link."), "graphplan new slotted.toml --from slotted-link"),
        Lesson(said("The sliding and the turning of the guide give the acceleration of Coriolis, 2·ω·v. It is one more "
                    "vector of the plan, and its construction stands among the steps."),
               "graphplan draw slotted.toml -o slotted.svg\ngraphplan steps slotted.toml",
               picture="slotted-link.svg"),
        Lesson(said("The same where the crank has gone 60° farther."),
               "graphplan draw slotted.toml --at 60 -o later.svg"),
    ),
    said("Forces and the lever"): (
        Lesson(said("Loads stand in the scene, and the unknown that keeps the prescribed motion under `[balance]`."),
               "graphplan new loaded.toml --from jaanimets-10"),
        Lesson(said("Draw it: force polygons group by group, and Zhukovsky's lever, on which moments about the pole "
                    "give the balancing force without any reaction."), "graphplan draw loaded.toml -o forces.svg",
               picture="jaanimets-10.svg"),
        Lesson(said("The balancing force and all reactions in numbers."), "graphplan solve loaded.toml"),
    ),
    said("A class in twenty minutes"): (
        Lesson(said("One handout for all: the task, the construction with boxes to tick, the solution, which lie "
                    "exactly over each other."), "graphplan handout four-bar.toml -o handout.pdf"),
        Lesson(said("Or a task for each student. The table `[vary]` at the end of the scene says which numbers differ, "
                    "by their paths. Save the names of the class as `{0}`, a table with a column `name`.", NAMES),
               writes=(NAMES, CLASS)),
        Lesson(said("What cannot be assembled, is near a singular pose or gives vectors that a ruler cannot read is "
                    "drawn anew. The folder has a booklet to print, whose sheets have coded corners, and the key."),
               "graphplan variants four-bar.toml --names class.csv -o tasks"),
        Lesson(said("Scan what is handed in, in any order, into a folder or one PDF file, such as `scans.pdf`. Each "
                    "sheet is judged by the scene that its corners name: score, first wrong step, kind of mistake; "
                    "corrected sheets to hand back stand in `tasks/results`. Type `graphplan verify tasks "
                    "scans.pdf`.")),
        Lesson(said("One drawing alone, also measured points or a CAD file, is judged by "
                    "`graphplan verify SCENE DRAWING`; `--report` draws the findings over it.")),
    ),
    said("A machine over its cycle"): (
        Lesson(said("Every pose of a turn is constructed and checked: a table, diagrams, an animation."),
               "graphplan cycle slider-crank --positions 24 -o cycle.csv --plot cycle.svg --of B.x\n"
               "graphplan cycle slider-crank --animate cycle.gif --positions 12"),
        Lesson(said("The flywheel that keeps the unevenness of a machine small, by Wittenbauer's diagram."),
               "graphplan flywheel ozols-13-6 -o flywheel.svg", picture="ozols-13-6.svg"),
        Lesson(said("How the machine runs under its loads: speed and time over the travel."),
               "graphplan motion ozols-13-6"),
    ),
}


def lesson_links(tongue: Tongue) -> str:
    """The titles of all lessons as a list that leads to them."""
    links = (f'<li><a href="{TUTORIAL}#lesson-{number}">{escape(tongue(title))}</a></li>'
             for number, title in enumerate(TUTORIALS, 1))
    return f"<ol>{''.join(links)}</ol>"


def tutorial(pictures: Collection[str], tongue: Tongue) -> str:
    """The page of all, with those pictures that the site has."""
    page = SitePage(tongue, TUTORIAL)

    def body() -> Iterator[str]:
        yield lesson_links(tongue)
        for number, (title, lessons) in enumerate(TUTORIALS.items(), 1):
            yield f'<h2 id="lesson-{number}">{number}. {page.say(title)}</h2>'
            yield "<ol>"
            for lesson in lessons:
                yield f"<li>{page.paragraph(lesson.words)}"
                yield from (preformatted_block(text) for text in (lesson.writes[1].strip(), lesson.commands) if text)
                if lesson.picture in pictures:
                    yield Sight(lesson.picture, page.tongue(title), lesson.picture).figure
                yield "</li>"
            yield "</ol>"

    return page.page(tongue(said("Tutorial")), body())


def markdown(pictures: Collection[str], tongue: Tongue) -> str:
    """All as Markdown, for a code host."""
    def page_lines() -> Iterator[str]:
        yield f"# {tongue(said('Tutorial'))}"
        for title, lessons in TUTORIALS.items():
            yield f"## {tongue(title)}"
            for number, lesson in enumerate(lessons, 1):
                blocks = lesson.writes[1].strip(), lesson.commands
                item = [tongue(lesson.words), *(f"```\n{block}\n```" for block in blocks if block)]
                item += [f"![{tongue(title)}]({lesson.picture})"] if lesson.picture in pictures else []
                yield f"{number}. " + indent("\n\n".join(item), "   ").lstrip()

    return "\n\n".join(page_lines()) + "\n"
