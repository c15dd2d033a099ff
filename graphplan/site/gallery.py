"""Make a site of scenes, offline: sheets, constructions in words, moving pages, files, a tutorial and the manual.

Without scenes the site has all packaged ones. With --brief it has sheets, words, tutorial, manual and reference, but no
moving pages and no files for other programs. Charts in FOLDER/charts are shown. README.md, tutorial.md and
tables/ are for readers on a code host. The manual's chapters need markdown-it-py: pip install 'graphplan[manual]'.

examples:
  graphplan gallery gallery --brief            write the site of the packaged scenes into the folder
  graphplan gallery gallery --brief --check    only say what would differ there; exit status 1 if anything does
  graphplan gallery site four-bar mine.toml --language de
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.app.choices import Messages, add_language, error
from graphplan.app.files import folder_at, write_all
from graphplan.errors import Refused
from graphplan.exports.command import export
from graphplan.live_pages.command import page
from graphplan.output import formats

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.mechanism.model import Scene
    from graphplan.site.scene_pages import ShownScene
    from graphplan.words.tongue import Tongue

FILES = ("ggb", "tikz", "dxf")  # formats of other programs, each in a folder of its own
LIVE, SCRIPT = "live", "graphplan-live.js"  # the folder of the moving pages, and the script that they share
FOLDERS = (*FILES, LIVE, "manual", "tables")  # of the site
MOVING = "four-bar"  # the scene that the start page shows in motion, if the site has it
RESERVED = ("index", "scenes", "tutorial", "reference", "moving", *FOLDERS)


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("folder", metavar="FOLDER", type=Path, help="where the site stands")
    command.add_argument("scenes", metavar="SCENE", nargs="*", help="scene files, or packaged scenes (all of these)")
    command.add_argument("--brief", action="store_true", help="no moving pages, and no files for other programs")
    command.add_argument("--check", action="store_true", help="write nothing; compare with what is there")
    add_language(command)


def run(options: argparse.Namespace) -> int:
    folder_at(options.folder)
    _refuse_foreign_readme(options.folder)
    site = dict(_Site(options).files())
    if options.check:
        return _report_differences(options.folder, site)
    write_all([(str(options.folder / name), content) for name, content in site.items()])
    return 0


def _refuse_foreign_readme(folder: Path) -> None:
    """Refuse a folder whose front page is not the site's: it would be lost."""
    from graphplan.site.scene_pages import MARK, README

    page = folder / README
    if page.is_file() and not page.read_bytes().startswith(MARK.encode()):
        raise Refused(f"{page}", "graphplan gallery would replace this file, which it did not write",
                      "choose another folder")


def _report_differences(folder: Path, site: Mapping[str, str | bytes]) -> int:
    """Report the files in the folder that differ from the site, and those that are no part of it."""
    stale = [f"{folder / name}: differs from what the scene gives now; run graphplan gallery {folder}"
             for name, content in site.items() if not _is(folder / name, content)]
    files = (path for subfolder in ("", *FOLDERS) for path in (folder / subfolder).glob("*") if path.is_file())
    stale += [f"{path}: no scene makes this file" for path in sorted({*files})
              if path.relative_to(folder).as_posix() not in site]
    for line in stale:
        error(line)
    return 1 if stale else 0


def _is(path: Path, content: str | bytes) -> bool:
    return path.is_file() and path.read_bytes() == (content.encode() if isinstance(content, str) else content)


@dataclass(frozen=True)
class _Site:
    """The site that the options ask for."""

    options: argparse.Namespace

    def files(self) -> Iterator[tuple[str, str | bytes]]:
        """Every file of the site, by its name in the folder: its scenes' one after the other, then its pages."""
        from graphplan.live_pages.page import script
        from graphplan.mechanism.scene import TASK_FOLDER, load, packaged_names
        from graphplan.site import scene_pages

        messages, tasks = Messages(self.options.quiet), packaged_names(TASK_FOLDER)
        names = _names(self.options.scenes or [*packaged_names(), *tasks])
        pages = []
        for count, (name, scene) in enumerate(names.items(), 1):
            messages.progress(f"{count}/{len(names)} {name}")
            page, files = self._task_on_site(name) if scene in tasks else self._scene_on_site(load(scene), name)
            if page.live:
                yield page.live, self._live(scene)
            yield from files.items()
            yield f"{page.name}.html", scene_pages.scene_page(page, self.tongue)
            pages.append(page)
        messages.progress("")
        if not self.options.brief:
            yield f"{LIVE}/{SCRIPT}", script()
        yield from self._pages(pages)

    def _pages(self, shown: Sequence[ShownScene]) -> Iterator[tuple[str, str | bytes]]:
        """Yield the pages of the site besides those of the scenes: for a browser, and for a code host."""
        from graphplan.app.cycle import animation
        from graphplan.app.schema import tables
        from graphplan.site import chapters, scene_pages, tutorial
        from graphplan.site.chapters import INDEX, REFERENCE, SCENES, TUTORIAL, has_chapters
        from graphplan.site.reference import reference

        tongue, sheets = self.tongue, [f"{page.name}.svg" for page in shown]
        measured = [f"charts/{path.name}" for path in (self.options.folder / "charts").glob("*")]
        charts = sorted(Path(name).stem for name in measured if name.endswith(".svg"))
        moving = next((page.name for page in shown if page.name == MOVING), "")
        if moving:
            yield scene_pages.ANIMATION, animation(self._parse("cycle", moving, "--animate", scene_pages.ANIMATION))
        yield INDEX, scene_pages.start_page(shown, moving, tongue)
        yield SCENES, scene_pages.scenes_page(shown, charts, tongue)
        yield TUTORIAL, tutorial.tutorial(sheets, tongue)
        yield REFERENCE, reference(_help(), tables(), tongue)
        keys = chapters.tables(_summaries())
        yield from chapters.table_pages(keys, tongue).items()
        yield scene_pages.LESSONS, tutorial.markdown(sheets, tongue)
        yield scene_pages.README, scene_pages.front_page(shown, moving, charts, tongue)
        if has_chapters():
            words = [name for page in shown for name in (*page.files, f"{page.name}.html")]
            yield from chapters.chapter_pages(keys, {SCENES, TUTORIAL, REFERENCE, *words, *measured}, tongue)
        else:
            Messages(self.options.quiet).remark("The site has no chapters: markdown-it-py is not installed; "
                                                "pip install 'graphplan[manual]'")

    @property
    def tongue(self) -> Tongue:
        from graphplan.words.tongue import tongue

        return tongue(self.options.language or "en")

    def _scene_on_site(self, scene: Scene, name: str) -> tuple[ShownScene, dict[str, str | bytes]]:
        """A scene as the site shows it, and its files by their names."""
        from graphplan.accuracy.drafted import draft
        from graphplan.app.steps import protocol
        from graphplan.check.json_results import result_data
        from graphplan.check.trusted import report
        from graphplan.design.hand import Pencil
        from graphplan.output.svg import svg
        from graphplan.sheet.layout.layout import layout
        from graphplan.site.scene_pages import ShownScene
        from graphplan.words.tongue import tongue

        if self.options.language:
            scene = replace(scene, sheet=replace(scene.sheet, language=self.options.language))
        scene = replace(scene, title=tongue(scene.sheet.language).title(scene.title))
        result = report(scene)
        on_sheet = draft(result.drawing, Pencil(), check=result.check, tongue=tongue(scene.sheet.language))
        words = protocol(on_sheet)
        exports = {} if self.options.brief else dict(self._exports(name, on_sheet))
        captions, files = self._files(scene, name, svg(layout(on_sheet.composition)), words)
        captions |= {path: formats()[path.partition("/")[0]].told for path in exports}
        live = "" if self.options.brief else f"{LIVE}/{name}.html"
        return ShownScene(scene, name, result_data(result)["steps"], words, captions, live), files | exports

    def _files(self, scene: Scene, name: str, svg: str, words: str) -> tuple[dict[str, str], dict[str, str | bytes]]:
        """Captions of a scene's files, by their names, and their contents."""
        from graphplan.phrases import said

        captions: dict[str, str] = {f"{name}.svg": said("the sheet"), f"{name}.txt": said("the construction in words")}
        captions |= {} if self.options.brief else {f"{name}.toml": said("the scene")}
        return captions, dict(zip(captions, (svg, words, scene.text), strict=False))

    def _task_on_site(self, name: str) -> tuple[ShownScene, dict[str, str | bytes]]:
        """A packaged task as the site shows it, and its files by their names."""
        from graphplan import synthesize
        from graphplan.mechanism.scene import source_text
        from graphplan.output.executable import protocol_text
        from graphplan.site.scene_pages import ShownScene

        subject = synthesize(name, language=self.options.language)
        words, scene = protocol_text(subject.one_sheet), replace(subject.one_sheet.scene, text=source_text(name, name))
        captions, files = self._files(scene, name, subject._repr_svg_(), words)
        return ShownScene(scene, name, subject.numbers()["steps"], words, captions), files

    def _live(self, scene: str) -> str:
        """The page on which a scene moves."""
        return page(self._parse("live", scene, "-o", "page.html", "--choices", "none"), shared=SCRIPT)

    def _parse(self, *words: str) -> argparse.Namespace:
        """The options of a command whose scene is in the language of the site."""
        from graphplan.commands import parser

        language = ("--set", f"sheet.language={self.options.language}") if self.options.language else ()
        return parser(words[:1]).parse_args([*words, *language])

    def _exports(self, name: str, on_sheet: Drafted) -> Iterator[tuple[str, str | bytes]]:
        """Yield the files for other programs."""
        for kind in FILES:
            with suppress(Refused):  # its library is not installed, or the format has no place for the scene
                yield f"{kind}/{name}{formats()[kind].suffix}", export(kind, on_sheet)


def _names(scenes: Sequence[str]) -> dict[str, str]:
    """The scenes by the names of their pages. Fails with `Refused` where two have one."""
    scenes_by_name: dict[str, str] = {}
    for scene in scenes:
        name = Path(scene).stem
        if name in scenes_by_name:
            raise Refused(f"{scene}: scene", f"{scenes_by_name[name]} has the name {name}, too",
                          "another name of the file")
        if name in RESERVED:
            raise Refused(f"{scene}: scene", f"the site has a page {name} of its own", "another name of the file")
        scenes_by_name[name] = scene
    return scenes_by_name


def _help() -> dict[str, str]:
    """Help of each command."""
    return {name: command.format_help() for name, command in _commands().items()}


def _summaries() -> dict[str, str]:
    """Summary of each command, in a line."""
    return {name: command.description or "" for name, command in _commands().items()}


def _commands() -> Mapping[str, argparse.ArgumentParser]:
    from graphplan.commands import commands, parser

    return next(action.choices for action in parser(tuple(commands()))._actions if isinstance(action.choices, dict))
