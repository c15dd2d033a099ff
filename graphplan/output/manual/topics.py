"""Topics: under which head of the gallery each packaged scene or task stands, and in which order."""

from __future__ import annotations

from collections.abc import Iterable

from graphplan.phrases import Said, said

TOPICS: dict[Said, tuple[str, ...]] = {
    said("Linkages with pin joints"): ("four-bar", "five-bar", "open-chain", "stephenson"),
    said("Slides and slotted links"): (
        "slider-crank", "ozols-5-1", "slotted-link", "shaper", "ozols-5-2", "ozols-5-3", "ozols-5-4", "ozols-5-5",
        "plough-lift", "geneva-slide"),
    said("Groups of higher class, rings of links"): (
        "triad", "class-four", "parallel-links", "rosenauer-basic", "rosenauer-example-1", "rosenauer-example-2",
        "alt-eight-link", "alt-eight-link-2", "alt-ten-link", "alt-ten-link-2", "double-butterfly"),
    said("Gears"): ("planetary", "biplanetary", "david", "gear-linkage", "geared-five-bar", "racks"),
    said("Cams and contacts"): ("arc-cam", "roller-cam", "ozols-5-6", "geneva", "wheel-on-rail"),
    said("Instant centres and curvature"): ("instant-centres", "inflection-circle", "cardan-circles", "dwell"),
    said("Forces and friction"): (
        "jaanimets-10", "jaanimets-11", "ozols-9-1", "ozols-10-1", "ozols-10-2", "kinytskyi", "triad-loaded",
        "class-four-loaded", "rosenauer-loaded", "walschaerts-loaded"),
    said("Machines over their cycle"): ("ozols-13-6", "ozols-13-7", "ozols-16-1"),
    said("Mechanisms that are found"): (
        "guidance-moving", "guidance-fixed", "guidance-22-8", "function-rocker", "function-slide",
        "stroke-slider-crank", "stroke-crank-rocker", "stroke-lever", "cognates-four-bar", "dwell-output",
        "geneva-19-1", "conjugate-pin", "gear-21-1"),
}


def by_topic(names: Iterable[str]) -> dict[Said, list[str]]:
    """The names under their topics, in the order of these; what is no packaged scene comes last."""
    requested = [*names]
    sorted_names = {topic: [name for name in scenes if name in requested] for topic, scenes in TOPICS.items()}
    in_topics = {name for scenes in TOPICS.values() for name in scenes}
    sorted_names[said("Further scenes")] = [name for name in requested if name not in in_topics]
    return {topic: scenes for topic, scenes in sorted_names.items() if scenes}
