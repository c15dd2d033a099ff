"""Growth: the time of planning and recording a construction, from 50 to 1,000 links."""

from __future__ import annotations

from functools import partial
from statistics import quantiles

import numpy as np
from harness import Row, alternate, duration

import graphplan as gp
from graphplan.accuracy.survey.growth import chain

LINKS = (50, 100, 200, 400, 700, 1000)
LINEAR = 1.1  # the exponent up to which growth counts as linear


def rows() -> list[Row]:
    """The exponent of the time over the number of links, fitted on logarithms, in each round."""
    scenes = {str(links): chain(links // 2 - 1) for links in LINKS}
    times = alternate({name: partial(gp.construct, scene) for name, scene in scenes.items()})
    sizes = np.log([len(scene.links) for scene in scenes.values()])
    exponents = [float(np.polyfit(sizes, np.log(spent), 1)[0]) for spent in zip(*times.values(), strict=True)]
    low, middle, high = quantiles(exponents, n=4)
    spent = ", ".join(duration(quantiles(times[str(links)], n=4)[1]) for links in (LINKS[0], LINKS[-1]))
    met = "yes" if middle <= LINEAR else "no"
    return [Row(f"planning, {LINKS[0]} to {LINKS[-1]:,} links", "exponent", f"≤ {LINEAR}", f"{middle:.3g}",
                f"{low:.3g} to {high:.3g}", met, spent)]
