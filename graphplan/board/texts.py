"""The words on the board's page, by the names that its scripts have for them, in all languages."""

from __future__ import annotations

from graphplan.phrases import Said, said
from graphplan.words import LANGUAGES
from graphplan.words.tongue import tongue

WORDS: dict[str, Said] = {
    # tools
    "select": said("Select"), "point": said("Point"), "link": said("Link"), "pivot": said("Fixed pivot"),
    "slide": said("Slide"), "drive": said("Drive"), "ask": said("Ask"), "load": said("Load"), "erase": said("Erase"),
    "undo": said("Undo"), "redo": said("Redo"), "tools": said("Tools"), "drawing": said("Drawing"),
    # what each does
    "hint_select": said("Drag a point; press on an object to change its numbers; drag beside them to move the view"),
    "hint_point": said("Press where a point is to be"),
    "hint_link": said("Press on the points of a link one after another, then Enter"),
    "hint_link_end": said("Enter, or the last point once more, ends the link"),
    "hint_pivot": said("Press on a point of the frame"),
    "hint_slide": said("Press on the point of the link that slides"),
    "hint_slide_to": said("Press in the direction of the guide, or on the link that guides"),
    "hint_drive": said("Press on the link that is driven"),
    "hint_ask": said("Press on a point whose velocity and acceleration are wanted"),
    "hint_load": said("Press on a point and drag to the end of the force"),
    "hint_erase": said("Press on what is to be erased"),
    "unreadable": said("The scene's text has a fault: mend it there first"),
    # files and views
    "scenes": said("Packaged scenes"), "open": said("Open"), "save": said("Save"), "download": said("Download"),
    "saved": said("Saved"), "live": said("Live page"), "fit": said("Fit"), "grid": said("Grid"),
    "vectors": said("Vectors"), "run": said("Run"), "travel": said("Travel of the drive"), "views": said("Views"),
    "sheet": said("Sheet"), "steps": said("Steps"), "results": said("Results"), "scene": said("Scene"),
    "sheet_empty": said("The sheet and its steps come when the mechanism is complete"),
    "results_empty": said("The results come when the mechanism is complete"),
    # objects and numbers
    "name": said("Label"), "angle": said("Angle"), "mass": said("Mass"), "remove": said("Remove"), "free": said("Free"),
    "kept": said("Kept lengths"), "asked": said("Velocity and acceleration"), "velocity": said("Velocity"),
    "acceleration": said("Acceleration"), "size": said("Magnitude"), "rates": said("Rates of the links"),
    "sliding": said("Sliding"), "reactions": said("Reactions"), "balance": said("Balance"), "poles": said("Poles"),
    "checked": said("Largest relative difference from the analytic solver:"),
}


def words_in(language: str) -> dict[str, str]:
    """The words in a language; English where it is none that graphplan speaks."""
    say = tongue(language if language in LANGUAGES else "en")
    return {name: say(words) for name, words in WORDS.items()}


def page_language(wanted: str) -> str:
    """The first of the wanted languages that graphplan speaks, such as of "de-AT,de;q=0.9,en;q=0.8"; else English."""
    codes = [entry.partition(";")[0].strip()[:2].lower() for entry in wanted.split(",")]
    return next((code for code in codes if code in LANGUAGES), "en")
