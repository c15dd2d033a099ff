"""The front page of the site on a code host: thumbnails of the scenes by topic, each with its construction in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from graphplan.output.manual.chapters import TABLES, TITLES
from graphplan.output.manual.scenes import CHARTS, CONSTRUCTED, MEASURED, ShownScene
from graphplan.output.manual.topics import by_topic
from graphplan.phrases import said
from graphplan.words.tongue import Tongue

README, LESSONS = "README.md", "tutorial.md"
MARK = "<!-- Written by graphplan gallery. -->"  # a page without it is another's, and stays as it is
COLUMNS, WIDTH = 3, 260  # thumbnails in a row, and the width of each in pixels


def front_page(shown: Sequence[ShownScene], charts: Iterable[str], tongue: Tongue) -> str:
    """The page as Markdown, with the charts that are there."""
    by_name, pictures = {scene.name: scene for scene in shown}, [*charts]

    def page_lines() -> Iterator[str]:
        yield MARK
        yield f"# {tongue(said('Gallery'))}"
        yield tongue(CONSTRUCTED())
        yield tongue(said("Begin with the {0}. A picture leads to its sheet, the number of steps to the construction "
                          "in words. In a browser the site begins with `index.html`.",
                          f"[{tongue(said('Tutorial'))}]({LESSONS})"))
        yield " · ".join(f"[{tongue(title)}]({TABLES}/{name}.md)" for name, title in TITLES.items())
        for topic, names in by_topic(by_name).items():
            yield f"## {tongue(topic)}"
            yield _thumbnails([_scene(by_name[name], tongue) for name in names])
        if pictures:
            yield f"## {tongue(CHARTS())}"
            yield tongue(MEASURED())
            yield _thumbnails([_picture(f"charts/{name}.svg", name) for name in pictures])

    return "\n\n".join(page_lines()) + "\n"


def _thumbnails(cells: Sequence[str]) -> str:
    """Cells in rows, as a table without heads."""
    columns = min(COLUMNS, len(cells))
    rows = [[*cells[first:first + columns]] for first in range(0, len(cells), columns)]
    rows[-1] += [""] * (columns - len(rows[-1]))
    lines = [" | ".join(row) for row in ([""] * columns, ["---"] * columns, *rows)]
    return "\n".join(f"| {line} |" for line in lines)


def _scene(one: ShownScene, tongue: Tongue) -> str:
    title = tongue.title(one.scene.title)
    steps = tongue(said("{0} steps", one.steps))
    return f"{_picture(f'{one.name}.svg', title)}<br>{_cell(title)}<br>[{steps}]({one.name}.txt)"


def _picture(path: str, shows: str) -> str:
    return f'[<img src="{path}" alt="{_cell(shows)}" width="{WIDTH}">]({path})'


def _cell(text: str) -> str:
    """Words in a cell of a table in Markdown: none of them ends the cell or begins an element."""
    return escape(text).replace("|", "&#124;")
