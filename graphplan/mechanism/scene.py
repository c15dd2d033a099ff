"""Scenes: a mechanism read from TOML text, checked as a whole, with all its faults at once.

Points that nothing uses, joints of a link that coincide, links that hang on nothing, gears without an arm, and a motion
that the drives determine twice or not at all. What a scene may well say, and is more often a slip of the pen, is asked.
"""

from __future__ import annotations

import math
import os
import re
import sys
import tomllib
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from errno import EBADF, EFBIG
from fractions import Fraction
from itertools import combinations, islice
from typing import Any, BinaryIO

from graphplan.errors import Fault, Refused, SceneError, by_name
from graphplan.mechanism.equations import PRIME, Elimination, System
from graphplan.mechanism.fields import (
    BODY,
    TEXT,
    VECTOR,
    Faults,
    Field,
    SceneItem,
    SceneNames,
    Table,
    points_of,
    quote_key,
    suggestion,
)
from graphplan.mechanism.load_fields import BALANCE, FORCES, FRICTION, GOVERNOR, MASSES, MOMENTS, loads_of
from graphplan.mechanism.load_values import SPRINGS, filled_in, with_strokes
from graphplan.mechanism.model import (
    CYLINDERS,
    FRAME,
    TOLERANCES,
    Contact,
    Drive,
    Find,
    Frozen,
    Gear,
    Pair,
    Presentation,
    Scene,
    Slide,
)
from graphplan.mechanism.numbers import decimal, exactly, is_exact, number_text
from graphplan.mechanism.order import ordered_links
from graphplan.mechanism.pairs import fields
from graphplan.mechanism.pairs.gear import LOADS
from graphplan.mechanism.pairs.pair import FrameName, KinematicPair
from graphplan.mechanism.pairs.space_joint import JOINTS
from graphplan.mechanism.placements import POINTS, TURNED_DOWN, needs, place
from graphplan.mechanism.scene_text import VARY, with_rows
from graphplan.mechanism.sections import FIND, FLYWHEEL, LINKS, MOTIONS, RUN, SHEET, UNITS
from graphplan.mechanism.structure import Bracing, bracing, mobility
from graphplan.mechanism.tolerances import COINCIDENCE_TOL
from graphplan.mechanism.units import METRES

MAX_PIVOT_SETS, MAX_PIVOT_SUGGESTIONS = 200, 3  # sets of points, in a scene with many loose ends


def check_use(scene: Scene, elsewhere: Collection[str], faults: Faults) -> None:
    """Every point is a point of a link, or serves to place a point or to give a direction."""
    for point, links in scene.links_of.items():
        if not links and point not in elsewhere:
            faults.add(f"points.{quote_key(point)}", "no link has this point", "name it in a link, or remove it")


def check_joints(scene: Scene, placed: Mapping[str, Pair], faults: Faults) -> None:
    """The joints of a moving link lie apart."""
    joints, links = set(scene.joints) & placed.keys(), ordered_links(scene)
    for link in scene.moving:
        for a, b in combinations([point for point in links[link] if point in joints], 2):
            if _coincide(placed[a], placed[b]):
                instead = "joints that lie apart, or one name for both"
                faults.add(f"links.{quote_key(link)}", f"the joints {a} and {b} coincide", instead)


def _coincide(a: Pair, b: Pair) -> bool:
    if is_exact(a, b):
        return a == b
    (ax, ay), (bx, by) = exactly(a), exactly(b)
    return max(abs(ax - bx), abs(ay - by)) <= COINCIDENCE_TOL * max(abs(ax), abs(ay), abs(bx), abs(by))


def check_frame(scene: Scene, faults: Faults) -> None:
    """Check that a link stands still: either one is called frame, or the scene is an open chain that its drives and
    given motions determine.

    An open chain that its drives and given motions determine may call its links as it likes.
    """
    if FRAME in scene.links or (scene.motions and mobility(scene) == len(scene.drives) + 2 * len(scene.motions)):
        return
    from graphplan.mechanism.slips import is_frame_synonym  # few scenes have no frame

    for link, points in scene.links.items():
        if is_frame_synonym(link):
            faults.add(f"links.{quote_key(link)}", f"link {link} would move: the fixed link is called frame",
                       f'frame = "{" ".join(points)}"')


def check_connections(scene: Scene, faults: Faults) -> None:
    """Every link hangs together with the frame, or with a point whose motion is given."""
    joined: dict[str, set[str]] = {}
    for pair in scene.binding:
        for link in pair.links:
            joined.setdefault(link, set()).update(pair.links)
    grounded = {FRAME} & {*scene.links} | {link for point in scene.motions for link in scene.links_of[point]}
    reached = [*grounded]
    while reached:
        reached += (further := joined.get(reached.pop(), set()) - grounded)
        grounded |= further
    for link in scene.moving:
        if grounded and link not in grounded:
            lonely = "shares no joint or slide with any other"
            fault = "is connected to neither the frame nor a given motion" if link in joined else lonely
            instead = "a point that it shares with another link, or a slide"
            faults.add(f"links.{quote_key(link)}", f"link {link} {fault}", instead)


def check_gears(scene: Scene, faults: Faults) -> None:
    """Without the gears, too, their centres are held apart, and that of a gear on a rack at its pitch line.

    An arm does so in any position, so that a motion by chance keeps what a bar between the centres would.
    """
    free = replace(scene, written=tuple(pair for pair in scene.written if not isinstance(pair, Gear | Drive)))
    system = System(free)
    columns = {unknown: j for j, unknown in enumerate(system.unknowns)}
    rows = [{columns[unknown]: c for unknown, c in equation.terms.items()} for equation in system.pairs]
    motion = Elimination(rows, len(columns), PRIME).random_motion
    for number, gear in enumerate(scene.gears, 1):
        bar, of = _bar(gear), " and ".join(gear.centres)
        if gear.direction is None:
            terms = system.terms(next(bar.states(system.posed_scene)))
            if not sum(c * motion[columns[unknown]] for unknown, c in terms.items()) % PRIME:
                continue
            problem, instead = f"nothing holds the centres {of} apart", "an arm: a link with a joint at each"
        else:
            problem, instead = f"{of} can leave the pitch line", "a pin, or a slide along it"
        if not _held_in_its_pose(free, bar):
            faults.add(f"gears.{number}.centres", problem, instead)


def _bar(gear: Gear) -> Contact:
    """A bar between the centres of a gear, or a slide of its centre along the pitch line."""
    first, second = gear.centres[0], gear.centres[1] if gear.direction is None else None
    return Contact(gear.links, first, (first, second), False, gear.direction, gear.through, gear.written)


def _held_in_its_pose(free: Scene, bar: Contact) -> bool:
    """Whether the links do what a bar would do by special geometry, and not for their velocities alone."""
    from graphplan.mechanism.equations import special  # few scenes need it

    before, after = special(free), special(replace(free, written=(*free.written, bar)))
    return before.freedoms == after.freedoms and after.moves


def check_mobility(scene: Scene, faults: Faults) -> Scene:
    """The scene, with what special geometry makes redundant in it.

    A fault unless it has as many drives and given motions as degrees of freedom, and each link is held just once.
    """
    counted = Faults()
    checked = _check_freedoms(scene, counted)
    loose = Faults()
    if scene.gears and faults.none_in("points") and counted.none_in("links"):  # a missing pivot tells more
        check_gears(scene, loose)
    for fault in loose if len(loose) else counted:
        faults.add(fault.where, fault.what, fault.instead)
    return checked


def _check_freedoms(scene: Scene, faults: Faults) -> Scene:
    """Check the count of freedoms against the drives, with the pairs that special geometry makes redundant."""
    freedoms, drives, motions = mobility(scene), len(scene.drives), len(scene.motions)
    prescribed = drives + 2 * motions
    drives_text = _count(drives, "drive") + (f" and {_count(motions, 'given motion')} (two degrees each)" if motions
                                             else "")
    problem = f"mobility {freedoms} but {drives_text}"
    hold = bracing(scene)
    loose, twice = _links_text(hold.loose), _links_text(hold.overbraced)
    if freedoms < prescribed and not hold.loose and (special_scene := _in_its_pose(scene, prescribed, drives_text,
                                                                                   faults)):
        return special_scene
    if freedoms < prescribed:
        pairs = "joints and slides" if not (scene.gears or scene.contacts) else "pairs, or gears whose ratios agree"
        instead = f"fewer drives, or fewer {pairs}" if freedoms > 0 else f"a chain with fewer {pairs}"
        faults.add("drive", problem, instead)
    elif freedoms > prescribed and (choices := missing_pivots(scene, freedoms - prescribed)):
        points = ", or ".join(" and ".join(pivots) for pivots in choices)
        on_none = f"{points} {'is' if len(choices[0]) == 1 else 'are'} on no other link"
        entries, more = [frame_entry(scene, pivots) for pivots in choices], f"{freedoms - prescribed} more [[drive]]"
        if FRAME in scene.links:
            entries.append(more)
        else:
            problem = "no link is the frame"
        faults.add(f"links.{quote_key(scene.frame)}", f"{problem}, and {on_none}", " or ".join(entries))
    elif freedoms == prescribed + 1 and (ends := _missing_link(scene)):
        number = 1 + max((int(link) for link in scene.links if link.isdecimal()), default=0)
        faults.add("links", f"{problem}, and {' and '.join(ends)} belong to one link each",
                   f'perhaps a link is missing, such as {number} = "{" ".join(ends)}"; or 1 more [[drive]]')
    elif rollers := _idle_rollers(scene, hold.loose):
        faults.add("contacts", f"{loose} can turn idly: a passive freedom, that moves nothing else",
                   f"rolling = true in the contact of {' and of '.join(rollers)}")
    elif freedoms > prescribed:
        faults.add("drive", problem, f"{freedoms - prescribed} more [[drive]], since {loose} can still move")
    elif not hold.sound:
        problem = f"{twice} {_are(hold.overbraced)} overbraced while {loose} {_are(hold.loose)} loose"
        faults.add("links", problem, "joints, slides and drives that hold each link just once")
    return scene


def _in_its_pose(scene: Scene, given: int, told: str, faults: Faults) -> Scene | None:
    """The scene with its redundant conditions, where special geometry makes it move; None where it does not."""
    from graphplan.mechanism.equations import special  # few scenes need it

    geometry = special(scene)
    links = _links_text(geometry.links)
    if geometry.freedoms < given:
        return None
    if geometry.freedoms > given:
        problem = f"{links} have mobility {geometry.freedoms} in this pose alone but {told}"
        faults.add("links", problem, "another pose, in which they have fewer degrees of freedom")
    elif not geometry.moves:
        problem = f"{links} can shake in this pose but not move"
        faults.add("links", problem, "lengths with which they move, or fewer joints and slides")
    return replace(scene, repetitions=geometry.repetitions)


def _idle_rollers(scene: Scene, loose: tuple[str, ...]) -> list[str]:
    """Names of the contacts of rollers that turn freely on their pins (passive freedoms), if no other link is free."""
    idle = {link: contact.name for contact in scene.contacts if not contact.rolling
            for link, centre in zip(contact.links, contact.centres, strict=True)
            if link in loose and centre in scene.joints and len(scene.links[link]) == 1}
    return list(idle.values()) if len(idle) == len(loose) else []


def check_loads(scene: Scene, faults: Faults, by_drive: bool) -> None:
    """Check the loads against the whole scene; held `by_drive` they need no balance."""
    loads = scene.loads
    if loads is None:
        if scene.find.reactions:
            faults.add("find.reactions", "reactions are asked for, but no load is given", "[[forces]] or [masses]")
        return
    counts = f"{_count(len(loads.balances), 'balance')} for {_count(len(scene.drives), 'drive')}"
    if scene.motions:
        faults.add("motion", "these points are moved by no link, so the force on them is unknown",
                   "drives, where forces are asked for")
    elif by_drive and scene.drives and not loads.balances:
        return
    elif len(loads.balances) < len(scene.drives):
        faults.add("balance", f"{counts}: nothing keeps the prescribed motion",
                   '[balance] with link = "1" for a moment, or with at, on and direction for a force')
    elif len(loads.balances) > len(scene.drives):
        faults.add("balance", f"{counts}: statically indeterminate", "one balance for each drive")
    else:
        _check_balance(scene, faults)


def _check_balance(scene: Scene, faults: Faults) -> None:
    """With the balances instead of the drives each link is held just once: then statics determines all forces."""
    hold: Bracing = bracing(scene, balanced=True)
    if not hold.sound:
        loose, twice = _links_text(hold.loose), _links_text(hold.overbraced)
        problem = f"it does not hold {loose}, and {twice} {_are(hold.overbraced)} statically indeterminate"
        faults.add("balance", problem, "a moment or a force that works when the drive moves the mechanism")


def _count(number: int, noun: str) -> str:
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"


def _links_text(links: tuple[str, ...]) -> str:
    more = f" and {len(links) - 12} more" if len(links) > 12 else ""
    return f"link{'s' if len(links) > 1 else ''} {' '.join(links[:12])}{more}"


def _are(links: tuple[str, ...]) -> str:
    return "are" if len(links) > 1 else "is"


def missing_pivots(scene: Scene, freedoms: int) -> list[tuple[str, ...]]:
    """The points that would take so many freedoms from a scene if they were on the frame too, in each of a few ways.

    They are on no other link, and with them the drives determine the motion. A pivot takes two freedoms. First come
    those of the links with the fewest points, which have no other use.
    """
    if freedoms % 2 or scene.motions:  # of an open chain it is a motion that is missing
        return []
    fixed = scene.links.get(FRAME, ())
    lone = {point: links[0] for point, links in scene.links_of.items() if len(links) == 1}
    ends = sorted(lone.keys() - {*fixed}, key=lambda p: (len(scene.links[lone[p]]), by_name(p)))
    choices = islice(combinations(ends, freedoms // 2), MAX_PIVOT_SETS)
    sound = (pivots for pivots in choices
             if bracing(replace(scene, links={**scene.links, FRAME: (*fixed, *pivots)})).sound)
    chosen = list(islice(sound, MAX_PIVOT_SUGGESTIONS))
    most = [max(len(scene.links[lone[p]]) for p in pivots) for pivots in chosen]
    return [pivots for pivots, points in zip(chosen, most, strict=True) if points == most[0]]


def _missing_link(scene: Scene) -> tuple[str, ...]:
    """The two points, each of one link alone, between which a bar would give the scene the right mobility; empty if no
    such pair exists.

    A distance by which one is placed from the other is such a bar before all.
    """
    if scene.motions:
        return ()
    lone = sorted((point for point, links in scene.links_of.items() if len(links) == 1), key=by_name)
    placed = {frozenset((point, centre)) for point in lone if point in scene.placements
              for centre in scene.placements[point].data.get("distances", ())}  # type: ignore[attr-defined]
    pairs = sorted(combinations(lone, 2), key=lambda ends: frozenset(ends) not in placed)
    ends = (ends for ends in islice(pairs, MAX_PIVOT_SETS) if scene.links_of[ends[0]] != scene.links_of[ends[1]]
            and bracing(replace(scene, links={**scene.links, " ".join(ends): ends})).sound)
    return tuple(sorted(next(ends, ()), key=lambda point: FRAME not in scene.links_of[point]))


def frame_entry(scene: Scene, way: tuple[str, ...]) -> str:
    """The frame with these points, as it is written."""
    return f'{quote_key(scene.frame)} = "{" ".join((*scene.links.get(FRAME, ()), *way))}"'


MAX_FRICTION_COEFFICIENT = 2
"""A coefficient of friction: no dry surfaces of machines rub more, and no flanks of a wedge do."""
MAX_GYRATION = 10  # times a link's length: no link has a larger radius of gyration


def questions(scene: Scene) -> Iterator[Fault]:
    """Doubtful entries, each with its place and the probable intention."""
    loads = scene.loads
    for table in scene.unused_loads:
        yield Fault(table, "not used, as motion alone is asked for", 'with [balance], such as link = "{}", forces are '
                    "found too".format(scene.drives[0].link if scene.drives else "1"))
    yield from _sizes_of_slips(scene)
    for screw in loads.screws if loads else ():
        if loads and not any(loads.screw_of(balance) == screw for balance in loads.balances):
            yield Fault("friction", "no balance acts through the screw of {} along {}".format(*screw.links),
                        "no [balance] at all, so that the drive of this slide is it")
    for number, friction in enumerate(loads.frictions if loads else (), 1):
        coefficient = (friction.wedge or friction).coefficient
        if coefficient > MAX_FRICTION_COEFFICIENT and not friction.rolling:
            yield Fault(f"friction.{number}.coefficient", f"{number_text(coefficient)} is more than dry surfaces have",
                        f"perhaps {number_text(coefficient / 100)}, if that is in percent")


def _sizes_of_slips(scene: Scene) -> Iterator[Fault]:
    """Angles that look like radians, a mechanism in the wrong unit of length, an inertia in that of the drawing."""
    angles: dict[str, Any] = {f"points.{quote_key(point)}.angle": placement.data["angle"]
                              for point, placement in scene.placements.items() if "angle" in placement.data}
    angles |= {f"slides.{number}.direction": slide.written for number, slide in enumerate(scene.slides, 1)
               if isinstance(slide.written, Fraction)}
    for where, angle in angles.items():
        if abs(angle) <= math.tau and (10 * angle).denominator > 1:
            yield Fault(where, f"{number_text(angle)} degrees is a small angle",
                        f"perhaps {math.degrees(angle):.5g}, if that is in radians")
    metres = METRES[scene.units.length]
    if scene.points and scene.extent * metres * 1000 < 1:
        yield Fault("units.length", f"the mechanism is {scene.extent:.4g} {scene.units.length} wide",
                    'perhaps length = "m"')
    for link, mass in scene.loads.masses.items() if scene.loads else ():
        ends = [tuple(map(float, scene.points[point])) for point in scene.links[link]]
        size = float(metres) * max((math.dist(*two) for two in combinations(ends, 2)), default=0.0)
        if size and mass.mass and (radius := math.sqrt(mass.inertia / mass.mass)) > MAX_GYRATION * size:
            yield Fault(f"masses.{quote_key(link)}.inertia", f"a radius of gyration of {radius:.4g} m, in a link of "
                        f"{size:.4g} m", f"perhaps {float(mass.inertia * metres**2):.4g}, if that is in "
                        f"{scene.units.mass} {scene.units.length}²")


FOLDER = os.path.join(os.path.dirname(os.path.dirname(__file__)), "scenes")
TASK_FOLDER = os.path.join(FOLDER, "tasks")
MAX_BYTES = 16 << 20  # of a scene: more is another file
ACTING = "forces", "moments", "springs"
PAIRS = fields()
PAIR_KEYS = tuple(field.name for field in PAIRS)
SCENE = Table("a planar mechanism in one pose, what drives it, what loads it and what is asked of it", (
    Field("title", "what the mechanism is", TEXT),
    Field("source", "where it comes from: author, title, year, figure", TEXT),
    Field("gravity", "the acceleration of gravity in m/s^2, where forces are asked for", VECTOR, default=[0, 0]),
    Field("frame", "which of [links] is the fixed link; without it that which is called frame", BODY),
    Field("units", "the units of the scene and of its results", UNITS),
    Field("points", "every named point, in this pose of the mechanism", POINTS,
          "[points] with entries such as A = [0, 0]"),
    Field("links", "a link is the list of its points; a point that several links name is a revolute joint there",
          LINKS, '[links] with entries such as 1 = "O A"'),
    Field("joints", "a joint of two shafts in space, drawn in the plane", JOINTS),
    *PAIRS,
    Field("motion", "the given motion of a point, for open chains", MOTIONS),
    Field("find", "what is asked for; without it the velocity and acceleration of every joint, and the rates of every "
          "link", FIND),
    Field("sheet", "how the sheet should look; the command line has the last word", SHEET),
    Field("masses", "the mass of a link", MASSES),
    Field("forces", "a force on a link", FORCES),
    Field("moments", "a moment on a link", MOMENTS),
    Field("springs", "a spring between two points of different links, along their line, in every pose", SPRINGS),
    Field("balance", "the unknown that keeps the motion, one for each drive: a moment, or a force along a line",
          BALANCE),
    Field("friction", "friction in a joint or in a slide", FRICTION),
    Field("flywheel", "how evenly the machine is to run over its cycle, for graphplan flywheel",
          FLYWHEEL),
    Field("run", "how far the machine's true motion is followed, for graphplan motion", RUN),
    Field("cylinders", "equal cylinders in line on one shaft, for graphplan balance of a slider-crank", CYLINDERS),
    Field("governor", "the balls, the axis and the range of a centrifugal governor, for graphplan balance", GOVERNOR),
    Field("tolerances", 'by how much a dimension may be off, for graphplan errors: of a distance such as "O A", the '
          'offset of a guide such as "3 along frame", in lengths; of an angle such as "A B C", in degrees', TOLERANCES),
    Field("vary", "numbers that differ from student to student, by their paths, such as points.A.angle or "
          "drive.0.omega, for graphplan variants", VARY),
))
ORDER = ("points", "links", "frame", "joints", *PAIR_KEYS, "motion", "units", "title", "source", "find", "gravity",
         *LOADS, "flywheel", "run", "cylinders", "governor", "sheet", "tolerances", "vary")
"""In which sections are read: what others speak of comes first."""


def load(source: str | os.PathLike[str], name: str | None = None) -> Scene:
    """The scene in a file, on standard input (`-`), or packaged under this name.

    Fails with a :class:`SceneError` that has one line for each fault.
    """
    written = os.fspath(source)
    name = written if name is None else name
    return parse(source_text(written, name), name)


def source_text(source: str, name: str) -> str:
    """The text of a file, of standard input (`-`) or of a packaged scene; fails as :func:`load` does."""
    try:
        return _bytes(source).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        fault = Fault("file", f"byte {error.start + 1} is not UTF-8", "text saved as UTF-8")
    except IsADirectoryError:
        fault = Fault("file", "this is a directory", "a scene file")
    except FileNotFoundError:
        fault = Fault("file", "no such file and no packaged scene", suggestion(source, packaged_names(), "scene"))
    except (OSError, ValueError) as error:  # ValueError: a path that no file system has
        fault = Fault("file", f"it cannot be read ({getattr(error, 'strerror', None) or error})", "a readable file")
    raise SceneError(name, (fault,))


def _bytes(source: str) -> bytes:
    if source == "-":
        if sys.stdin is None:
            raise OSError(EBADF, "standard input is closed")
        return _read_all(sys.stdin.buffer)
    for folder in () if os.path.exists(source) else (FOLDER, TASK_FOLDER):
        if source in packaged_names(folder):
            source = os.path.join(folder, f"{source}.toml")
    with open(source, "rb") as file:
        return _read_all(file)


def _read_all(file: BinaryIO) -> bytes:
    """All that is in a file; a device may have no end."""
    data = file.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise OSError(EFBIG, f"more than {MAX_BYTES >> 20} MB")
    return data


def packaged_names(folder: str = FOLDER) -> list[str]:
    """The names of the packaged scenes, in alphabetical order; of the tasks of `graphplan synthesize` in TASK_FOLDER.
    """
    return sorted(name.removesuffix(".toml") for name in os.listdir(folder) if name.endswith(".toml"))


def parse(text: str, name: str = "scene", by_drive: bool = False) -> Scene:
    """The scene that a TOML text says; `name` stands in error lines, and files that it names are beside it.

    Loads that no balance holds are a fault, unless they are held `by_drive`.
    Its own text has the rows of such files in their stead, so that it holds wherever it is taken.
    """
    return scene_of_tables(tables_of(text, name), text, name, by_drive)


def scene_of_tables(tables: dict[str, object], text: str, name: str, by_drive: bool) -> Scene:
    """Make a scene of tables that are read already; the tables are not changed."""
    faults = Faults()
    folder = FOLDER if name in packaged_names() and not os.path.exists(name) else os.path.dirname(name)
    scene, files = _read(tables, name, faults, folder, by_drive)
    if len(faults):
        from graphplan.leaves import kind_of_task, tasks

        if kind := kind_of_task(tables):
            key = next(key for key in kind.tables if key in tables)
            raise SceneError(name, (Fault(key, "this is a task, not a scene", f"graphplan {kind.command} {name}"),))
        if "points" not in tables:
            known = [key for kind in tasks().values() for key in kind.tables]
            for key in sorted(tables.keys() - {*SCENE.keys}):
                if (task := suggestion(key, known, "key")).startswith("perhaps"):
                    raise SceneError(name, (Fault(key, "unknown key", task),))
        from graphplan.mechanism.slips import is_frame_synonym, slips_in_vectors  # few scenes have faults

        if not faults.none_in("links", "drive") and not any(map(is_frame_synonym, scene.links)):
            for link in _possible_frames(tables, scene):
                fixed = Faults()
                _read({**tables, "frame": link}, name, fixed, folder, by_drive)
                if not len(fixed):
                    raise SceneError(name, (Fault("links", "no link is the frame", f'frame = "{link}" above all '
                                                  f"tables, or link {link} called frame"),))
        for slip in slips_in_vectors(text):
            faults.add(*slip)
        raise SceneError(name, tuple(faults))
    return replace(scene, points=Frozen(scene.points), links=Frozen(scene.links), motions=Frozen(scene.motions),
                   text=with_rows(text, files) if files else text)


def incomplete_scene(text: str, name: str = "scene") -> Scene:
    """Return the scene of a text as far as it can be read, to be looked at: without what is faulty, and with the points
    alone that can be placed. Fails with :class:`SceneError` where the text is no TOML."""
    scene, _ = _read(tables_of(text, name), name, Faults(), "", by_drive=True)
    placed = place(scene.placements, SceneItem({}, "points", Faults()))
    return replace(scene, points={point: placed[point] for point in scene.points if point in placed}, text=text)


def _possible_frames(tables: Mapping[str, object], scene: Scene) -> list[str]:
    """The links of a scene that names no frame, in the order of their names."""
    return [] if "frame" in tables or FRAME in scene.links else sorted(scene.links, key=by_name)


def tables_of(text: str, name: str) -> dict[str, object]:
    """The text's tables, its decimals as exact numbers."""
    if not text.strip():
        raise SceneError(name, (Fault("file", "it is empty", "a scene with [points], [links] and [[drive]]"),))
    try:
        return tomllib.loads(text, parse_float=decimal)
    except RecursionError:
        fault = Fault("file", "tables or lists are nested too deeply", "a scene as the manual shows it")
    except ValueError as error:
        fault = _no_toml(text, str(error))
    raise SceneError(name, (fault,))


def _no_toml(text: str, message: str) -> Fault:
    """The fault of a text that TOML refuses: a slip of the pen, a duplicate key, or TOML's own message."""
    from graphplan.mechanism.scene_text import doubled_key  # few scenes have faults
    from graphplan.mechanism.slips import bare_name, quote_slip, slip_in_line

    # a numeral that Python refuses to read has no place of its own
    match = re.fullmatch(r"(.*) \(at (.*)\)", message, re.DOTALL)
    problem, location = (match[1], match[2].replace("end of document", "end of file")) if match else (message, "file")
    line = re.match(r"line (\d+), column (\d+)", location)
    if line and (doubled := doubled_key(text, problem, int(line[1]))):
        return Fault(*doubled)
    written = text.splitlines()[int(line[1]) - 1] if line else ""
    slip = slip_in_line(written) or quote_slip(written) or (bare_name(written, int(line[2])) if line else None)
    return Fault(location, *(slip or (f"not TOML: {problem}", "text that follows toml.io")))


def _read(tables: dict[str, object], name: str, faults: Faults,
          folder: str, by_drive: bool) -> tuple[Scene, Mapping[str, Sequence[Pair]]]:
    """The whole scene, and the rows of the files that it names in a folder.

    Where something is faulty the scene is patched up, and only good for finding more faults.
    """
    items = SceneItem(tables, "", faults).fields(SCENE.keys, {}) or {}
    for field in SCENE.fields:
        if field.wanted and not (field.name in items and items[field.name].value):
            faults.add(field.name, f"the scene has no {field.name}", field.wanted)
    points = items.get("points", SceneItem({}, "points", faults))
    names = SceneNames(dict.fromkeys(points.value) if isinstance(points.value, dict) else {}, tables=tables,
                       folder=folder)
    kinds, read = {field.name: field.kind for field in SCENE.fields}, {}
    for key in ORDER:
        if key in items and (value := kinds[key].read(items[key], names)) is not None:
            read[key] = value
        if key == "points":
            placements = read.get(key, {})
            names.places = place(placements, points)
        elif key == "links" and key in read:
            names.take_links(_with_frame(read[key], tables, faults))
        elif key == "joints" and key in read:
            placements = placements | {name: put for added in read[key] for name, put in added.items()}
        elif key == "units" and key in read:
            names.units = read[key]
        elif key in PAIR_KEYS:
            names.pairs = _name_higher_pairs((*names.pairs, *read.get(key, ())))
    scene = Scene(
        title=read.get("title", ""), source=read.get("source", ""), name=name, units=names.units,
        points={point: names.places.get(point, (Fraction(0), Fraction(0))) for point in names.points},
        placements=placements, links=names.links, written=names.pairs, motions=read.get("motion", {}),
        find=read.get("find") or _default_find(names), loads=loads_of(read), flywheel=read.get("flywheel"),
        cylinders=read.get("cylinders"), governor=read.get("governor"),
        run=read.get("run"), sheet=read.get("sheet") or Presentation(), vary=read.get("vary", {}),
        tolerances=read.get("tolerances", {}), frame_name=str(names.frame))
    scene = scene if len(faults) else _touching_on_normals(scene)
    by_own_drive = by_drive or scene.flywheel or scene.run or scene.governor or (scene.loads and scene.loads.screws)
    scene = _kept_by_its_drive(scene) if by_own_drive else _without_unasked_loads(scene, tables)
    counting = _counting(scene)
    rounded = [f"points.{quote_key(point)}: {placements[point].how} placement" for point in placements
               if point in names.places and point in counting and not is_exact(names.places[point])
               and placements[point].how != TURNED_DOWN]  # its joint says why
    scene = _check_read_all(replace(scene, irrational=(*rounded, *names.irrational)), names.places, faults, by_drive)
    if not len(faults):
        try:
            scene = filled_in(with_strokes(scene))
        except Refused as refused:
            faults.add(refused.what.removeprefix(f"{name}: "), refused.why, refused.do)
    return scene, names.files


def _with_frame(links: dict[str, tuple[str, ...]], tables: Mapping[str, object],
                faults: Faults) -> dict[str, tuple[str, ...]]:
    """The links, with the fixed one known by its name; where a pair is on the frame and no point is, as that of an
    ellipsograph, with a frame without points."""
    frame = tables.get("frame", FRAME)
    if not isinstance(frame, str):
        return links  # a fault of its own
    if frame != FRAME and FRAME in links:
        faults.add(f"links.{FRAME}", f"link {frame} is the frame",
                   f'another name of this link, or no frame = "{frame}"')
        return links
    fixed = FRAME if frame == FRAME else FrameName(frame)
    links = {fixed if link == frame else link: points for link, points in links.items()}
    rows = [row for key in PAIR_KEYS for row in _list(tables.get(key)) if isinstance(row, dict)]
    named = [name for row in rows for key in ("link", "along", "links", "slide") for name in _list(row.get(key))]
    return links if FRAME in links or frame not in named else {**links, fixed: ()}


def _list(value: object) -> list[object]:
    """A list as it is, anything else as one that holds it alone."""
    return value if isinstance(value, list) else [value]


def _touching_on_normals(scene: Scene) -> Scene:
    """The scene with its points of contact on the common normals, off which rounding may have them: a contact pushes
    along one line. Points of links stay where they are, and those of several contacts, which have no one normal."""
    often = Counter(contact.at for contact in scene.contacts)
    feet = {contact.at: contact.foot(scene.points) for contact in scene.contacts
            if often[contact.at] == 1 and not scene.links_of.get(contact.at)
            and all(is_exact(scene.points[point]) for point in (contact.at, *filter(None, contact.centres)))}
    return replace(scene, points={**scene.points, **feet})


def _kept_by_its_drive(scene: Scene) -> Scene:
    """The scene; where it has no balance, that is what each of its drives does."""
    loads = scene.loads
    if not loads or loads.balances:
        return scene
    return replace(scene, loads=replace(loads, balances=tuple(map(scene.balance_of, scene.drives))))


def _without_unasked_loads(scene: Scene, tables: Mapping[str, object]) -> Scene:
    """Remove the loads from a scene that asks for motion alone and has no balance."""
    find = tables.get("find")
    motion = isinstance(find, dict) and bool(find) and not find.get("reactions")
    if not (motion and scene.loads and not scene.loads.balances):
        return scene
    return replace(scene, loads=None, unused_loads=tuple(key for key in ACTING if key in tables))


def _name_higher_pairs(pairs: tuple[KinematicPair, ...]) -> tuple[KinematicPair, ...]:
    """The pairs, with several gears and contacts of the same two links named by where they are."""
    between = Counter(frozenset(pair.links) for pair in pairs if isinstance(pair, Gear | Contact))
    return tuple(replace(pair, alone=between[frozenset(pair.links)] < 2) if isinstance(pair, Gear | Contact) else pair
                 for pair in pairs)


def _counting(scene: Scene) -> set[str]:
    """The points on whose coordinates results depend: others place points, or are unused points of links.

    Loads may be laid off from any point of a link.
    """
    loads = scene.loads
    find = scene.find
    points = {*scene.joints, *scene.motions, *find.velocity, *find.acceleration,
              *(p for p, _ in find.curvature_points.values())}
    for pair in scene.directed_pairs:
        points |= {point for fact in pair.states(scene) for _, point in fact.ends} | {*(pair.through or ())}
    points |= {contact.at for contact in scene.contacts if contact.rolling}
    if loads is not None:
        points |= {point for points in scene.links.values() for point in points}
        points |= {point for balance in loads.balances for point in points_of(balance.written)}
    return points


def _default_find(names: SceneNames) -> Find:
    """The default results: velocity and acceleration of every moving joint, or of every moving point in a scene without
    one, and the rates of every link."""
    at = {pair.at for pair in names.pairs if isinstance(pair, Slide)}
    moving = tuple(p for p in names.movable if names.link_counts[p] > 1 or p in at) or names.movable
    return Find(moving, moving, links=names.moving, by_default=True)


def _check_read_all(scene: Scene, placed: dict[str, Pair], faults: Faults, by_drive: bool) -> Scene:
    """The scene after the checks of the whole, each where what it rests on has no faults of its own."""
    if not faults.none_in("links"):
        return scene
    guides = {point for pair in scene.directed_pairs for point in pair.through or ()} | {pair.at
                                                                                         for pair in scene.contacts}
    centres = {point for placement in scene.placements.values() for point in needs(placement)}
    if faults.none_in("points", "joints", *PAIR_KEYS[:-1]):
        check_use(scene, guides | centres, faults)
    if not scene.moving:
        faults.add("links", "no link moves", 'a link besides the frame, such as 1 = "O A"')
    elif faults.none_in("links", "frame", "joints", *PAIR_KEYS, "motion"):
        check_frame(scene, faults)
        if faults.none_in("links"):
            check_connections(scene, faults)
        if faults.none_in("links"):
            scene = check_mobility(scene, faults)
        if faults.none_in("links", "gears", "drive", *LOADS):
            check_loads(scene, faults, by_drive)
    check_joints(scene, placed, faults)
    return scene
