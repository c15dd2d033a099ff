"""How far gears turn links: what the drives of a train give it, each link laid off as if it were driven.

The turns obey the same ratios as their rates, as long as the centres keep apart: exact in fractions.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from graphplan.errors import Refused
from graphplan.mechanism.elimination import Elimination
from graphplan.mechanism.model import FRAME, Gear, Number, Scene
from graphplan.mechanism.numerals import is_exact
from graphplan.mechanism.pairs.drives import TurningDrive
from graphplan.phrases import said

Row = dict[str, Fraction]  # what links' turns are multiplied by in a sum, which is the value of ""


def driven_by_gears(scene: Scene, shifts: tuple[Fraction, ...]) -> tuple[Scene, tuple[Fraction, ...]]:
    """The scene with drives in the place of its gears, and how far all drives go, counter-clockwise or along.

    Fails with `Refused` where that is not so: of a rack, and of gears whose line of centres no train alone turns.
    """
    if not scene.gears and not scene.contacts:
        return scene, shifts
    rows = [_row((drive.link, 1), (drive.on, -1), turn=shift)
            for drive, shift in zip(scene.drives, shifts, strict=True) if not drive.slides]
    rows += [row for gear in scene.gears if (row := _ratio(scene, gear))]
    turns = _determined(rows) | {FRAME: Fraction(0)}
    more, led = _led(scene, turns)
    plain = not scene.contacts and all(_ratio(scene, gear) and {*gear.links} <= led for gear in scene.gears)
    if not plain or any(name and name not in turns for row in rows for name in row):
        raise Refused(f"{scene.name}: the pose", said("no steps are known that find where these gears or contacts go"),
                      "the pose as it is given")
    others = replace(scene, written=tuple(pair for pair in scene.written if pair not in scene.gears), redundant=(),
                     repeating=())
    return (others.with_drives((*scene.drives, *more)),
            (*shifts, *(turns[drive.link] - turns[drive.on] for drive in more)))


def _led(scene: Scene, turns: Row) -> tuple[list[TurningDrive], set[str]]:
    """Drives for links whose turns are known, each about a joint with another such, and all links so driven."""
    led, more = {FRAME: True}, list[TurningDrive]()
    ends = [ends for drive in scene.drives for ends in (drive.links, drive.links[::-1])]
    while True:
        driven = next((link for link, on in ends if on in led and link not in led), None)
        about = next(((link, on) for link in turns for on in led if link not in led and on in turns
                      and {*scene.links[link]} & {*scene.links.get(on, ())}), None)
        if driven is not None:
            led[driven] = True
        elif about is not None:
            more.append(TurningDrive(*about, 0, 0))
            led[about[0]] = True
        else:
            return more, {*led}


def _ratio(scene: Scene, gear: Gear) -> Row | None:
    """What a gear says of the turns of its links and of the arm that holds its centres; None of one without arm."""
    arm = next((link for link, points in scene.links.items() if {*gear.centres} <= {*points}), None)
    if len(gear.centres) < 2 or arm is None or not is_exact(gear.factors):
        return None
    one, two = gear.factors
    return _row((gear.links[0], one), (gear.links[1], two), (arm, -one - two))


def _row(*terms: tuple[str, Number], turn: Number = 0) -> Row:
    """The sum of links' turns, each times its factor."""
    row = {"": Fraction(turn)}
    for link, factor in terms:
        if link != FRAME:
            row[link] = row.get(link, Fraction(0)) + Fraction(factor)
    return row


def _determined(rows: list[Row]) -> Row:
    """The turns that follow from the rows, as far as these bind them."""
    links = [*dict.fromkeys(name for row in rows for name in row if name)]
    system = Elimination([{k: row[link] for k, link in enumerate(links) if link in row} for row in rows], len(links))
    turns, free = system.solve([row[""] for row in rows]) or [], system.free
    return {link: turn for k, (link, turn) in enumerate(zip(links, turns, strict=False)) if k not in free}
