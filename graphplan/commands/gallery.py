"""Draw every packaged scene, and an index page.

examples:
  graphplan gallery gallery            write the sheets, protocols and index into the folder
  graphplan gallery gallery --check    only say what would differ there; exit status 1 if anything does
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from html import escape
from pathlib import Path

from graphplan.commands.messages import Messages, error
from graphplan.commands.output import folder_at, write

HANDOUTS = {".pdf": "handout", ".html": "step by step"}  # what stands in the folder handouts, and how it is linked


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("folder", metavar="FOLDER", type=Path, help="where the gallery stands")
    command.add_argument("--check", action="store_true", help="write nothing; compare with what is there")


def run(options: argparse.Namespace) -> int:
    folder_at(options.folder)
    stale = 0
    written = set()
    for name, text in _pages(options.folder, Messages(options.quiet)):
        path = options.folder / name
        written.add(name)
        if options.check:
            stale += _differs(path, text)
        else:
            write(text, str(path))
    for path in sorted(options.folder.iterdir()):
        if path.is_file() and path.name not in written:
            stale += 1
            error(f"{path}: no packaged scene makes this file")
    return 1 if stale else 0


def _differs(path: Path, text: str) -> bool:
    same = path.is_file() and path.read_text(encoding="utf-8") == text
    if not same:
        error(f"{path}: differs from what the scene gives now; run graphplan gallery {path.parent}")
    return not same


def _pages(folder: Path, messages: Messages) -> Iterator[tuple[str, str]]:
    """Every file of the gallery: a sheet and a protocol for each scene, and the index, with the charts and handouts
    that are there."""
    from graphplan import sheet
    from graphplan.accuracy.drafted import drafted
    from graphplan.accuracy.pencil import Pencil
    from graphplan.check.json_results import data
    from graphplan.check.trusted import report
    from graphplan.mechanism.scene import load, packaged
    from graphplan.mechanism.structure import structure
    from graphplan.output.text import protocol

    entries = []
    names = packaged()
    for count, name in enumerate(names, 1):
        messages.progress(f"{count}/{len(names)} {name}")
        found = report(load(name))
        scene = found.scene
        errors = drafted(found.drawing, Pencil(), check=found.check)
        yield f"{name}.svg", sheet.svg(found.drawing, composition=errors.composition)
        yield f"{name}.txt", protocol(found.drawing, structure(scene).lines(), errors.lines())
        handouts = [suffix for suffix in HANDOUTS if (folder / "handouts" / f"{name}{suffix}").is_file()]
        entries.append(_entry(name, scene.title, scene.source, data(found)["steps"], handouts))
    messages.progress("")
    charts = [_chart(path.stem) for path in sorted((folder / "charts").glob("*.svg"))]
    yield "index.html", INDEX.format(entries="\n".join(entries), charts="\n".join(charts))


def _chart(name: str) -> str:
    return f'<figure><a href="charts/{name}.svg"><img src="charts/{name}.svg" alt="{name}" loading="lazy"></a></figure>'


def _entry(name: str, title: str, source: str, steps: int, handouts: Iterable[str]) -> str:
    links = "".join(f' · <a href="handouts/{name}{suffix}">{HANDOUTS[suffix]}</a>' for suffix in handouts)
    return (f'<figure><a href="{name}.svg"><img src="{name}.svg" alt="{escape(title)}" loading="lazy"></a>'
            f"<figcaption><b>{escape(title)}</b><br>{escape(source)}<br>"
            f'<code>graphplan draw {name}</code> · <a href="{name}.txt">{steps} steps</a>{links}</figcaption></figure>')


INDEX = """<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>graphplan: gallery</title>
<style>
body {{ font: 16px/1.4 sans-serif; margin: 2rem; color: #222; }}
main {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(24rem, 1fr)); gap: 2rem; }}
figure {{ margin: 0; }}
img {{ width: 100%; border: 1px solid #bbb; background: #fff; }}
</style>
<h1>Gallery</h1>
<p>Every packaged scene as graphplan constructs it: the sheet, and the construction in words.</p>
<main>
{entries}
</main>
<h2>Measured and followed round</h2>
<p>Speed against accuracy (<code>graphplan chart</code>) and kinematic diagrams (<code>graphplan cycle</code>); times
are ratios within one run.</p>
<main>
{charts}
</main>
</html>
"""
