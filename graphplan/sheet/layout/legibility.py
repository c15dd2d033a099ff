"""How well plans can be read at their scales: by their size, their marks, and the places of their letters."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from graphplan.errors import Refused
from graphplan.mechanism.units import iso_size
from graphplan.phrases import digits
from graphplan.sheet.layout.paper import room_for_marks
from graphplan.sheet.layout.plan_scales import unit_lengths
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.letters import wishes_inside, wishes_on
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.view import View, fit_scale, whole_plan_scale
from graphplan.sheet.tolerances import AREA_TOL, MIN_VECTOR, SCALE_TOL

MIN_LINK_MM = 4.5  # mm: a link shorter than this has no room for letters
MIN_ENLARGED_LINK_MM = 1.2  # mm: the same on paper that is usual, where a detail shows it enlarged
MIN_AREA_PER_MARK = 85.0  # mm^2 of a plan for each of its marks: with less, the letters hide the lines
MIN_AREA_ON_USUAL = 60.0  # mm^2: the same of the mechanism on paper that is usual; a small plan gets a detail
MIN_AREA_ON_LARGE_SHEETS = {"A2": 60.0, "A1": 0.0, "A0": 0.0}  # the same where the next sheet is not taken readily
MAX_POOR_SHARE = {"A4": 0.08, "A3": 0.1, "A2": 0.13, "A1": 1.0, "A0": 1.0}  # of all letters may find no good place
MAX_POOR_SHARE_ON_NAMED = 0.7  # of them, on paper that is named, or that is usual
MAX_POOR_SHARE_ON_A4 = 0.25  # the same on A4 where that is usual
USUAL_PAPERS = (  # up to so many moving links and plans
    ("A4", 3, 5), ("A3", 7, 8), ("A2", math.inf, 12), ("A1", math.inf, math.inf))
LARGER_FOR_ACCURACY = ("A4", 3), ("A3", 7), ("A2", math.inf)  # up to so many moving links
NEAR_MM = 5.0  # mm: from another letter
MAX_NEIGHBOURS = 1.5  # so near: with more letters can hardly be read
MIN_VECTOR_MM = 5.0  # mm: the shortest vector that can be measured
SHORT_VECTOR_PRICE = 0.2  # by so much smaller, as a logarithm, a plan may be for a vector that can be measured


class PlansOnPaper:
    """Plans in their windows at their scales, as far as these are judged."""

    plans: Plans
    views: dict[str, View]
    scales: Scales

    @property
    def score(self) -> float:
        """How large the plans are: the mechanism counts most, each other plan one half or, of more than two, as many of
        their marks as it has. What cannot be measured counts against it."""
        first = self.plans.panels[0]
        marks = {panel: count for panel, count in self.plans.point_counts.items() if panel != first}
        weights = {panel: count / sum(marks.values()) if len(marks) > 2 else 0.5 for panel, count in marks.items()}
        weights[first] = 1.0
        large = sum(weight * math.log(self._scale(panel)) for panel, weight in weights.items())
        return round(large - SHORT_VECTOR_PRICE * len(self.short), 9)

    @property
    def short(self) -> list[float]:
        """The mm of vectors that are too short for a ruler, without what is next to nothing beside its kind."""
        vectors = [(kind, length * self.views[panel].scale) for kind, panel, length in self.plans.lengths]
        largest = dict(sorted(vectors))
        return [length for kind, length in vectors if MIN_VECTOR * largest[kind] <= length < MIN_VECTOR_MM]

    @property
    def oversize_factors(self) -> dict[str, float]:
        """The plans that do not fit their panels at a given scale, and by how much they are too large."""
        much = {panel: fit_scale(self.plans.extents[panel].core, room_for_marks(window.rect)) * window.scale
                for panel, window in self.views.items()}
        return {panel: times for panel, times in much.items() if times > 1 + SCALE_TOL}

    def _scale(self, panel: str) -> float:
        """How large a plan is; one of which marks are cut off counts no larger than all of it would be."""
        view = self.views[panel]
        whole = whole_plan_scale(self.plans.extents[panel], room_for_marks(view.rect))
        return view.scale if panel == self.plans.panels[0] else min(view.scale, whole)


def is_legible(plans: Plans, views: Mapping[str, View], paper: str, share: float = 1.0) -> bool:
    """Whether the links are long enough for letters, and no plan is crowded; large sheets are soon good enough.

    With a `share` each mark needs only so much of its area.
    """
    first, grows = plans.panels[0], may_be_larger(plans, paper)
    for panel, window in views.items():
        spots = [spot for spot in (window(plans.spot(i)) for i in plans.points(panel)) if window.rect.holds(spot)]
        area = MIN_AREA_PER_MARK if grows else MIN_AREA_ON_USUAL if panel == first else 0.0
        each = share * MIN_AREA_ON_LARGE_SHEETS.get(paper, area)
        if _area_of_marks(spots, each) < each * len(spots):
            return False
    least = MIN_LINK_MM if grows else MIN_ENLARGED_LINK_MM
    return paper in MIN_AREA_ON_LARGE_SHEETS or shortest_link(plans) * views[first].scale >= least


def _area_of_marks(spots: Sequence[Spot], each: float) -> float:
    """The area of some marks, a slim figure as one half as wide as it is long, with the margin around it that is theirs
    where each mark is in the middle of its own area; that of as many where they all coincide and are nowhere apart."""
    box, margin = bounding_box(spots or [(0.0, 0.0)]), math.sqrt(each)
    size = max(box.area, (box.width**2 + box.height**2) / 4)
    whole = size + margin * (box.width + box.height) + each
    return whole if size > AREA_TOL else each * len(spots)


def shortest_link(plans: Plans) -> float:
    """The shortest distance of two joints of a link."""
    links = plans.drawing.scene.links.values()
    apart = (math.dist(plans.place(p), plans.place(q)) for names in links for p in names for q in names)
    return min((distance for distance in apart if distance > 0), default=math.inf)


def max_poor_share(plans: Plans, paper: str, is_given: bool) -> float:
    """The part of the letters that may find no good place on paper that is given, or not."""
    size, moving, count = iso_size(paper), len(plans.drawing.scene.moving), len(plans.panels)
    usual = next(size for size, most, most_plans in USUAL_PAPERS if moving <= most and count <= most_plans)
    if is_given:
        return MAX_POOR_SHARE_ON_NAMED
    on_usual = MAX_POOR_SHARE_ON_A4 if size == "A4" else MAX_POOR_SHARE_ON_NAMED
    return max(MAX_POOR_SHARE[size], on_usual if size <= usual else 0.0)


def may_be_larger(plans: Plans, paper: str) -> bool:
    """Whether paper is smaller than it may be for so many links where results would be too far off."""
    moving = len(plans.drawing.scene.moving)
    return iso_size(paper) > next(size for size, most in LARGER_FOR_ACCURACY if moving <= most)


def crowding(plates: Plates) -> float:
    """How many other letters a letter has near it, before they have places."""
    neighbours, count = 0, 0
    for plate in plates:
        wishes = wishes_inside(wishes_on(plate), plate.view.rect)
        spots = np.array([wish.spots[0] for wish in wishes]).reshape(-1, 2)
        apart = np.hypot(*(spots[:, None] - spots).transpose(2, 0, 1))
        neighbours, count = neighbours + int((apart < NEAR_MM).sum()) - len(spots), count + len(spots)
    return neighbours / max(1, count)


def too_large_refusal(tried: PlansOnPaper, paper: str) -> Refused:
    """The refusal of given scales at which plans do not fit a paper, with the largest that do."""
    scales, oversized, first = tried.scales, tried.oversize_factors, tried.plans.panels[0]
    if first in oversized:
        k_s = float(round_up(scales.k_s * oversized[first], unit_lengths(tried.plans, first)[:1]))
        most = f"{ratio(k_s, scales.length)} (k_s = {digits(k_s)}) or smaller"
        return Refused(f"sheet: the scale {ratio(scales.k_s, scales.length)}", f"the mechanism does not fit on {paper}",
                       f"{most}, or a larger sheet")  # fmt: skip
    panel, times = max(oversized.items(), key=lambda item: item[1])
    multiple = scales.multiples[panel]
    most = f"×{1 / float(round_up(times / float(multiple))):g} or less in [sheet.multiples]"
    return Refused(f"sheet: the {panel} ×{multiple}", f"it does not fit on {paper}",
                   f"{most}, or a larger sheet")  # fmt: skip
