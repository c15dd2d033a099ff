"""Make a scene of a linkage drawn in another program: GeoGebra, DXF, Linkage or PMKS+.

Missing data, such as units, speeds, or the driving link, are guessed so that the scene moves. Each guess, and each item
of the file that a scene cannot have, is a remark and a comment in the scene. Coordinates are those of the file. A file
that graphplan exported gives back its scene.

formats:
  .ggb         GeoGebra: segments and polygons are links; how points depend tells what moves
  .dxf         lines are bars, closed polylines links, circles pins; layers `ground`, `slide`, `drive`, `link 3`
  .linkage2    Linkage, by David Rector: connectors, links, sliders, inputs, actuators
  .csv .pmks   PMKS and PMKS+; also a text file with the address of a linkage of PMKS+

examples:
  graphplan import crank.ggb -o crank.toml
  graphplan import mechanism.linkage2 -o - | graphplan solve -
  graphplan import walker.csv -o walker.toml && graphplan draw walker.toml -o walker.svg
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import Messages
from graphplan.app.files import STANDARD, kind, refuse_same_output, write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="a file of GeoGebra, Linkage or PMKS+, or a DXF")
    command.add_argument("-o", "--output", metavar="FILE", default=STANDARD,
                         help="the scene to write, such as scene.toml; without it standard output")


def run(options: argparse.Namespace) -> int:
    from pathlib import Path

    from graphplan.importing.readers import import_scene

    kind(options.output, (".toml",), "scene")
    refuse_same_output(options.file, options.output)
    text, remarks = import_scene(Path(options.file))
    write(text, options.output)
    for remark in remarks:
        Messages(options.quiet).remark(f"{options.file}: {remark}")
    return 0
