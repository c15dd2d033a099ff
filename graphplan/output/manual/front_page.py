"""The front page of the site on a code host: thumbnails of the scenes by topic, each with its construction in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from graphplan.output.manual import shown_scenes
from graphplan.output.manual.chapters import TABLES, TITLES
from graphplan.output.manual.shown_scenes import ShownScene, by_topic
from graphplan.phrases import said
from graphplan.words.tongue import Tongue

README, LESSONS = "README.md", "tutorial.md"
MARK = "<!-- Written by graphplan gallery. -->"  # a page without it is another's, and stays as it is
COLUMNS, WIDTH = 3, 260  # thumbnails in a row, and the width of each in pixels


def front_page(shown: Sequence[ShownScene], moving: str, charts: Iterable[str], tongue: Tongue) -> str:
    """The page as Markdown, with the scene of the animation and the charts that are there."""
    by_name, pictures = {scene.name: scene for scene in shown}, [*charts]

    def page_lines() -> Iterator[str]:
        yield MARK
        yield f"# {tongue(said('Gallery'))}"
        yield tongue(shown_scenes.PURPOSE)
        if moving:
            yield f"![{_cell(tongue.title(by_name[moving].scene.title))}]({shown_scenes.ANIMATION})"
        yield "\n".join(f"- {tongue(words)}" for words in shown_scenes.AUDIENCES)
        yield tongue(shown_scenes.CONSTRUCTED)
        yield tongue(said("Begin with the {0}. A picture leads to its sheet, the number of steps to the construction "
                          "in words. In a browser the site begins with `index.html`.",
                          f"[{tongue(said('Tutorial'))}]({LESSONS})"))
        yield " · ".join(f"[{tongue(title)}]({TABLES}/{name}.md)" for name, title in TITLES.items())
        for topic, names in by_topic(by_name).items():
            yield f"## {tongue(topic)}"
            yield _thumbnails([_scene(by_name[name], tongue) for name in names])
        if pictures:
            yield f"## {tongue(shown_scenes.CHARTS)}"
            yield tongue(shown_scenes.MEASURED)
            yield _thumbnails([_picture(f"charts/{name}.svg", name) for name in pictures])

    return "\n\n".join(page_lines()) + "\n"


def _thumbnails(cells: Sequence[str]) -> str:
    """Cells in rows, as a table without heads."""
    cells = [*cells, *[""] * (-len(cells) % COLUMNS)]
    rows = [cells[first:first + COLUMNS] for first in range(0, len(cells), COLUMNS)]
    return "\n".join(f"| {' | '.join(row)} |" for row in ([""] * COLUMNS, ["---"] * COLUMNS, *rows))


def _scene(one: ShownScene, tongue: Tongue) -> str:
    title = tongue.title(one.scene.title)
    steps = tongue(said("{0} steps", one.steps))
    return f"{_picture(f'{one.name}.svg', title)}<br>{_cell(title)}<br>[{steps}]({one.name}.txt)"


def _picture(path: str, shows: str) -> str:
    return f'[<img src="{path}" alt="{_cell(shows)}" width="{WIDTH}">]({path})'


def _cell(text: str) -> str:
    """Words in a cell of a table in Markdown: none of them ends the cell or begins an element."""
    return escape(text).replace("|", "&#124;")
