"""Growth: the exponent of the time over the number of links, from 200 to 1,000, of what must be linear."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import quantiles
from tempfile import TemporaryDirectory

import numpy as np
from cold import COMMAND, IMPORT, IMPORT_NUMPY, python
from harness import Row, Target, alternate, compared, duration

import graphplan as gp
from graphplan.bench.growth import POSITIONS, TRAVEL, chain

LINKS = (200, 400, 700, 1000)
LINEAR, ROUNDS = Target("at most", 1.25), 5
AT_MOST = Target("at most", 12)  # times import numpy, the longest chain


def rows() -> list[Row]:
    """Solver, construction, positions and the whole command, of chains of dyads in turns."""
    scenes = {str(links): chain(links // 2 - 1) for links in LINKS}
    with TemporaryDirectory() as folder:
        files = {name: Path(folder) / f"{name}.toml" for name in scenes}
        for name, file in files.items():
            file.write_text(written(scenes[name]))
        works: dict[str, Callable[[str], object]] = {
            "solver": lambda name: gp.analytic.solve(scenes[name]),
            "construct": lambda name: gp.construct(scenes[name]),
            "follow": lambda name: gp.cycle.follow(scenes[name], POSITIONS, TRAVEL),
            "graphplan solve": lambda name: python(*COMMAND, "solve", str(files[name]), "-q")}
        times = {what: alternate({name: partial(work, name) for name in scenes}, ROUNDS)
                 for what, work in works.items()}
        longest = partial(works["graphplan solve"], str(LINKS[-1]))
        cold = alternate({"ours": longest, IMPORT: lambda: python(*IMPORT_NUMPY)}, ROUNDS)
    return [*(_exponent(what, spent) for what, spent in times.items()),
            compared(f"graphplan solve, {LINKS[-1]:,} links", IMPORT, AT_MOST, cold)]


def _exponent(what: str, times: dict[str, list[float]]) -> Row:
    """The power that fits each round's times, on logarithms."""
    exponents = [float(np.polyfit(np.log(LINKS), np.log(spent), 1)[0]) for spent in zip(*times.values(), strict=True)]
    low, middle, high = quantiles(exponents, n=4)
    ends = ", ".join(duration(quantiles(times[str(links)], n=4)[1]) for links in (LINKS[0], LINKS[-1]))
    return Row(f"{what}, {LINKS[0]} to {LINKS[-1]:,} links", "exponent", str(LINEAR), f"{middle:.3g}",
               f"{low:.3g} to {high:.3g}", LINEAR.verdict(middle), ends)


def written(scene: gp.Scene) -> str:
    """A scene of joints and one crank as a file says it."""
    points = [f"{name} = [{x}, {y}]" for name, (x, y) in scene.points.items()]
    links = [f'{name} = "{" ".join(names)}"' for name, names in scene.links.items()]
    drive = f'[[drive]]\nlink = "{scene.drives[0].link}"\nomega = {float(scene.drives[0].rate)}'
    return "\n".join([f'title = "{scene.title}"', "[points]", *points, "[links]", *links, drive, ""])
