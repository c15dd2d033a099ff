"""Redraw a scene whenever its file is saved, until Ctrl-C.

If the scene has faults they are listed, and the sheet stays as it was. The editor may overwrite the file or replace it.

examples:
  graphplan watch scene.toml                     scene.svg in the same folder
  graphplan watch scene.toml -o sheet.svg --set sheet.plan=polar
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from pathlib import Path

from graphplan.app.choices import Messages, add_settings, error, load_scene
from graphplan.app.files import listening
from graphplan.app.pages import save_sheet, sheet_format
from graphplan.errors import GraphplanError, Refused

PERIOD = 0.3  # seconds between two looks at the file


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("scene", metavar="SCENE", help="a scene file")
    command.add_argument("-o", "--output", metavar="FILE", help="the sheet, without it SCENE.svg; as draw has it")
    add_settings(command)


def run(options: argparse.Namespace) -> int:
    path = Path(options.scene)
    if not path.is_file():
        raise Refused(f"{path}: watch", "no such file", f"graphplan new {path} makes one")
    options.output = options.output or str(path.with_suffix(".svg"))
    sheet_format(options.output)  # what no save would mend is refused at once
    for _ in _saves(path):
        try:
            with listening(lambda name: None):  # of all pages at once
                save_sheet(load_scene(options), options.output)
        except GraphplanError as fault:
            for line in fault.lines:
                error(line)
        else:
            Messages(options.quiet).remark(f"{options.output}: drawn at {time.strftime('%H:%M:%S')}")
    return 0


def _saves(path: Path) -> Iterator[None]:
    """Comes at once, and after every change of the file, which is missing or empty while it is being replaced.

    It is the text that is compared: scenes are small, and times of change are too coarse for two saves in a moment.
    """
    last_text = b""
    while True:
        try:
            text = path.read_bytes()
        except OSError:
            text = b""
        if text and text != last_text:
            last_text = text
            yield
        time.sleep(PERIOD)
