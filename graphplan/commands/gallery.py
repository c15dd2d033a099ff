"""Draw every packaged scene, and an index page.

examples:
  graphplan gallery gallery            write the sheets, protocols and index into the folder
  graphplan gallery gallery --check    only say what would differ there; exit status 1 if anything does
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from html import escape
from importlib.resources import files
from pathlib import Path

from graphplan.commands.output import Messages, error, folder_at, write

HANDOUTS = {".pdf": "handout", ".html": "step by step"}  # what stands in the folder handouts, and how it is linked


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("folder", metavar="FOLDER", type=Path, help="where the gallery stands")
    command.add_argument("--check", action="store_true", help="write nothing; compare with what is there")


def run(options: argparse.Namespace) -> int:
    folder_at(options.folder)
    written, stale = set(), []
    for name, text in _pages(options.folder, Messages(options.quiet)):
        path = options.folder / name
        written.add(name)
        if not options.check:
            write(text, str(path))
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            stale.append(f"{path}: differs from what the scene gives now; run graphplan gallery {path.parent}")
    stale += [f"{path}: no packaged scene makes this file" for path in sorted(options.folder.iterdir())
              if path.is_file() and path.name not in written]
    for line in stale:
        error(line)
    return 1 if stale else 0


def _pages(folder: Path, messages: Messages) -> Iterator[tuple[str, str]]:
    """Every file of the gallery: a sheet and a protocol for each scene, and the index, with the charts and handouts
    that are there."""
    from graphplan import sheet
    from graphplan.accuracy.drafted import drafted
    from graphplan.accuracy.pencil import Pencil
    from graphplan.check.json_results import data
    from graphplan.check.trusted import report
    from graphplan.commands.steps import protocol
    from graphplan.mechanism.scene import load, packaged

    entries, names = [], packaged()
    for count, name in enumerate(names, 1):
        messages.progress(f"{count}/{len(names)} {name}")
        found = report(load(name))
        on_sheet = drafted(found.drawing, Pencil(), check=found.check)
        yield f"{name}.svg", sheet.svg(found.drawing, composition=on_sheet.composition)
        yield f"{name}.txt", protocol(on_sheet)
        handouts = [suffix for suffix in HANDOUTS if (folder / "handouts" / f"{name}{suffix}").is_file()]
        entries.append(_entry(name, found.scene.title, found.scene.source, data(found)["steps"], handouts))
    messages.progress("")
    charts = [_chart(path.stem) for path in sorted((folder / "charts").glob("*.svg"))]
    page = files("graphplan.output").joinpath("gallery.html").read_text(encoding="utf-8")
    yield "index.html", page.replace("{{entries}}", "\n".join(entries)).replace("{{charts}}", "\n".join(charts))


def _chart(name: str) -> str:
    return f'<figure><a href="charts/{name}.svg"><img src="charts/{name}.svg" alt="{name}" loading="lazy"></a></figure>'


def _entry(name: str, title: str, source: str, steps: int, handouts: Iterable[str]) -> str:
    links = "".join(f' · <a href="handouts/{name}{suffix}">{HANDOUTS[suffix]}</a>' for suffix in handouts)
    return (f'<figure><a href="{name}.svg"><img src="{name}.svg" alt="{escape(title)}" loading="lazy"></a>'
            f"<figcaption><b>{escape(title)}</b><br>{escape(source)}<br>"
            f'<code>graphplan draw {name}</code> · <a href="{name}.txt">{steps} steps</a>{links}</figcaption></figure>')
