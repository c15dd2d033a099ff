"""The stages of curvature: what textbooks tell of inflection circles and centres of curvature."""

from __future__ import annotations

from collections.abc import Collection

from graphplan.kernel.stages import Equation, Stage
from graphplan.methods.panels import link_named
from graphplan.phrases import said

EULER = said("by Euler and Savary the way from a point to the pole is the mean proportional of its ways to the "
             "inflection circle and to its centre of curvature, which lie on one side of it")
NORMALS = said("the normals of the paths of a link's points pass through its pole")
LAWS = {
    "Bobillier": said("the tangent of the centrodes makes with one ray the angle that the axis of collineation of two "
                      "points makes with the other ray"),
    "Hartmann": said("the ends of a point's velocity and of the part of the pole's own velocity along it lie on one "
                     "line with the centre of curvature"),
}
RATES = said("the acceleration towards the pole is omega squared times the way to the inflection circle, as the "
             "velocity is omega times the way to the pole")
ROLLING = said("the pole is where the wheel touches, and the inflection pole lies on the line of centres: the centre "
               "of a wheel on a rail, of a wheel on a wheel by Euler and Savary")
MIRRORED = said("the pole and the inflection pole are opposite points of the inflection circle; the return circle is "
                "its mirror image in the pole")
NORMAL = said("the radius of curvature is the third proportional to the normal acceleration and the velocity")


def pole_of(link: str) -> Stage:
    """The pole of a link from the paths of two points."""
    return Stage(said("Pole of {0}", link_named(link)), NORMALS)


def by_centres(link: str) -> Stage:
    """The inflection circle of a link from two points with known centres of curvature."""
    return Stage(said("Inflection circle of {0}", link_named(link)), EULER, (Equation("MP² = MW · MC", ()),))


def by_rolling(link: str) -> Stage:
    """The inflection circle of a wheel that rolls on another, or on a rail."""
    return Stage(said("Inflection circle of {0}, which rolls", link_named(link)), ROLLING,
                 (Equation("BP² = BW_0 · BC", ()),))


def by_rates(link: str) -> Stage:
    """The inflection circle of a link from the velocities and accelerations of two points."""
    return Stage(said("Inflection circle of {0}, from velocities and accelerations", link_named(link)), RATES,
                 (Equation("a_n = ω² · MW, v = ω · MP", ()),))


def circle_of(link: str) -> Stage:
    """The circles themselves."""
    return Stage(said("Inflection circle and return circle of {0}", link_named(link)), MIRRORED)


def centre_of(point: str, forms: Collection[str]) -> Stage:
    """The centre of curvature of a point's path, by its link's circle or by known centres."""
    for form in LAWS.keys() & {*forms}:
        return Stage(said("Centre of curvature of the path of {0}, after {1}", point, said(form)), LAWS[form])
    return Stage(said("Centre of curvature of the path of {0}", point), EULER,
                 (Equation("MP² = MW · MC".replace("M", point), ()),))


def centre_by_rates(point: str) -> Stage:
    """The centre of curvature of a point's path, by its velocity and its normal acceleration."""
    return Stage(said("Centre of curvature of the path of {0}, from its normal acceleration", point), NORMAL,
                 (Equation(f"ρ_{point} = v_{point}² / a^n_{point}", ()),))
