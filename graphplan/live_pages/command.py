"""Write a live page: the moving construction in a browser, in one file, without a network.

Drag the drive or a point, type an angle, or let it run: the linkage follows on its branch, the construction is redrawn,
and the numbers in sentences and tables are those of the pose. If the mechanism cannot move, the page shows the steps
alone.

examples:
  graphplan live four-bar -o four-bar.html
  graphplan live alt-eight-link --choices plans,methods,languages -o page.html
  graphplan live scene.toml --plan polar --choices none --language de -o page.html
  graphplan live guidance-moving -o plane.html     a task: its given positions are dragged, and the linkage follows
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import add_choices, add_language, add_offer, load_source
from graphplan.app.files import LIVE_ENDINGS, kind, write
from graphplan.live_pages.scene_page import live_page


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the page to write")
    add_language(command)
    add_choices(command, method=False)
    add_offer(command)


def run(options: argparse.Namespace) -> int:
    kind(options.output, LIVE_ENDINGS, "live page")
    write(page(options), options.output)
    return 0


def page(options: argparse.Namespace, shared: str = "") -> str:
    """The page of the scene that is named; with a `shared` script it leaves that out."""
    return live_page(load_source(options, "plan"), options.choices, shared=shared)
