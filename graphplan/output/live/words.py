"""What stands on a live page besides the words of the sheet."""

from __future__ import annotations

from graphplan.phrases import Said, said

WORDS: dict[str, Said] = {
    "previous": said("Previous step"), "next": said("Next step"), "first": said("First step"),
    "last": said("Last step"), "play": said("Play"), "pause": said("Pause"), "step": said("Step"),
    "steps": said("Steps"), "sheet": said("Sheet"), "controls": said("Controls"), "zoom": said("Zoom to the plan"),
    "reads": said("reads"), "makes": said("makes"), "results": said("Results"),
    "begin": said("The mechanism as it is given; nothing is drawn yet."),
    "old": said("This browser cannot unpack the page: it shows the given pose alone."),
    "pace": said("Speed of the motion"), "values": said("Values"), "more": said("More"),
    "further": said("Further scenes"),
    "graph": said("{0} over the travel", "%"),
    "keys": said("Keys: arrows, Page Up and Page Down for stages, Home, End, space for the steps; R runs the "
                 "mechanism, comma and point turn its drive, 0 brings the given pose back."),
    "pose": said("Pose"), "turn": said("Turn of the drive"), "travel": said("Travel of the drive"),
    "back": said("Given pose"), "plan": said("Plan"),
    "method": said("Method"), "language": said("Language"), "own": said("chosen for the pose"),
    "orthogonal": said("orthogonal velocities"), "polar": said("polar plans"),
    "triangles": said("velocity triangles"),
    "auxiliary": said("auxiliary points"), "trial": said("trial figures"), "poles": said("poles"),
    "print": said("Print"), "copy": said("Copy as a scene"), "copied": said("The scene is copied."),
    "take": said("The scene in this pose, to be copied from here:"), "close": said("Close"),
    "curves": said("Paths and hodographs"), "path": said("Path of {0}", "%"),
    "centrodes": said("Centrodes of {0}", "%"),
    "hodograph": said("Hodograph of {0}", "%"), "ends": said("Ends of {0}", "%"),
    "readings": said("Measured on the sheet"), "forms": said("Method and forms"),
    "limits": said("from {0} to {1}", "%1", "%2"), "round": said("all around"),
    "points": said("Points of the mechanism"),
    "handle": said("Point {0}: drag it, or move it by the arrow keys", "%"),
    "undrawn": said("In this pose the construction cannot be drawn: {0}", "%"),
    "formless": said("In this pose the construction takes other forms than those that are drawn here."),
    "singular": said("In this pose there are no results."),
    "differs": said("Construction and second opinion differ in this pose."),
}  # fmt: skip

TASK_WORDS = WORDS | {
    "given": said("Given"), "found": said("Found"), "construction": said("Construction"),
    "home": said("The task as it is given"), "type": said("Type"), "travel": said("The crank turns by"),
    "transmission": said("Least transmission angle"),
    "hint": said("What is given can be dragged or typed: construction, linkage and numbers follow."),
    "none": said("Nothing is found here: {0}.", "%"), "coincide": said("{0} coincide", "%1"),
    "line": said("{0} lie in a line, and no circle goes through them", "%1"),
    "length": said("a link has no length"), "roots": said("the curve of circle points has no such point"),
    "five": said("the two points that have their five positions on circles do not exist here"),
    "limits": said("{0} must be more than {1} and less than {2}", "%1", "%2", "%3"),
    "undrawn": said("the construction cannot be drawn"),
    "crank": said("no crank swings the rocker with these numbers"),
}  # fmt: skip
