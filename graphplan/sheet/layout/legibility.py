"""Whether plans can be read at their scales: by their marks and the places of their letters, and by how these stand."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from graphplan.mechanism.papers import iso_size
from graphplan.sheet.lettering.letters import wishes_inside, wishes_on
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.view import View
from graphplan.sheet.tolerances import AREA_TOL

MIN_LINK_MM = 4.5  # mm: a link shorter than this has no room for letters
MIN_AREA_PER_MARK = 90.0  # mm^2 of a plan for each of its marks: with less, the letters hide the lines
MIN_AREA_ON_LARGE_SHEETS = {"A2": 60.0, "A1": 0.0, "A0": 0.0}  # the same where the next sheet is not taken readily
MAX_POOR_SHARE = {"A4": 0.08, "A3": 0.1, "A2": 0.13, "A1": 1.0, "A0": 1.0}  # of all letters may find no good place
MAX_POOR_SHARE_ON_NAMED = 0.6  # of them, on paper that is named, or that is usual
USUAL_PAPERS = ("A3", 7, 6), ("A2", math.inf, 8), ("A1", math.inf, math.inf)  # up to so many moving links and plans
NEAR_MM, MAX_NEIGHBOURS = 5.0, 1.5  # mm: a letter with more others so near finds no good place


def is_legible(plans: Plans, views: Mapping[str, View], paper: str) -> bool:
    """Whether the links are long enough for letters, and no plan is crowded; large sheets are soon good enough."""
    for panel, window in views.items():
        spots = [spot for spot in (window(plans.spot(i)) for i in plans.points(panel)) if window.rect.holds(spot)]
        box = bounding_box(spots or [(0.0, 0.0)])
        size = max(box.area, (box.width**2 + box.height**2) / 4)
        needed = MIN_AREA_ON_LARGE_SHEETS.get(paper, MIN_AREA_PER_MARK) * len(spots)
        if AREA_TOL < size < needed:  # marks that all coincide are nowhere apart
            return False
    return paper in MIN_AREA_ON_LARGE_SHEETS or _shortest_link(plans) * views[plans.panels[0]].scale >= MIN_LINK_MM


def _shortest_link(plans: Plans) -> float:
    """The shortest distance of two joints of a link."""
    links = plans.drawing.scene.links.values()
    apart = (math.dist(plans.place(p), plans.place(q)) for names in links for p in names for q in names)
    return min((distance for distance in apart if distance > 0), default=math.inf)


def max_poor_share(plans: Plans, paper: str, is_given: bool) -> float:
    """The part of the letters that may find no good place on paper that is given, or not."""
    size, moving, count = iso_size(paper), len(plans.drawing.scene.moving), len(plans.panels)
    usual = next(size for size, most, most_plans in USUAL_PAPERS if moving <= most and count <= most_plans)
    return max(MAX_POOR_SHARE[size], MAX_POOR_SHARE_ON_NAMED if is_given or size <= usual else 0.0)


def is_crowded(plates: Plates) -> bool:
    """Whether letters will hardly be read, by how many are to stand near each other: before they have places."""
    neighbours, count = 0, 0
    for plate in plates:
        wishes = wishes_inside(wishes_on(plate), plate.view.rect)
        spots = np.array([wish.spots[0] for wish in wishes]).reshape(-1, 2)
        apart = np.hypot(*(spots[:, None] - spots).transpose(2, 0, 1))
        neighbours, count = neighbours + int((apart < NEAR_MM).sum()) - len(spots), count + len(spots)
    return neighbours > MAX_NEIGHBOURS * count
