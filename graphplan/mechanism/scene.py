"""Scenes: a mechanism read from TOML text, checked as a whole, with all its faults at once."""

from __future__ import annotations

import os
import re
import sys
import tomllib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from errno import EBADF
from fractions import Fraction

from graphplan.errors import Fault, Refused, SceneError, by_name
from graphplan.mechanism.checks import (
    check_connections,
    check_frame,
    check_joints,
    check_loads,
    check_mobility,
    check_use,
)
from graphplan.mechanism.cylinders import CYLINDERS
from graphplan.mechanism.dimensions import TOLERANCES
from graphplan.mechanism.fields import Field, SceneNames, Table
from graphplan.mechanism.frame_name import FrameName
from graphplan.mechanism.friction_fields import FRICTION
from graphplan.mechanism.frozen import Frozen
from graphplan.mechanism.governor_fields import GOVERNOR
from graphplan.mechanism.items import Faults, SceneItem, quote_key, suggestion
from graphplan.mechanism.load_fields import BALANCE, FORCES, MASSES, MOMENTS, loads_of
from graphplan.mechanism.load_values import filled_in, with_strokes
from graphplan.mechanism.model import FRAME, Contact, Find, Gear, Pair, Presentation, Scene, Slide
from graphplan.mechanism.numbers import decimal, is_exact
from graphplan.mechanism.pairs import fields
from graphplan.mechanism.pairs.gear import LOADS
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.mechanism.pairs.space_joint import JOINTS
from graphplan.mechanism.placements import POINTS, TURNED_DOWN, needs, place
from graphplan.mechanism.scene_text import with_rows
from graphplan.mechanism.sections import FIND, FLYWHEEL, LINKS, MOTIONS, RUN, SHEET, UNITS
from graphplan.mechanism.springs import SPRINGS
from graphplan.mechanism.values import BODY, TEXT, VECTOR, points_of
from graphplan.mechanism.variation import VARY

FOLDER = os.path.join(os.path.dirname(os.path.dirname(__file__)), "scenes")
TASK_FOLDER = os.path.join(FOLDER, "tasks")
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
        return sys.stdin.buffer.read()
    for folder in () if os.path.exists(source) else (FOLDER, TASK_FOLDER):
        if source in packaged_names(folder):
            source = os.path.join(folder, f"{source}.toml")
    with open(source, "rb") as file:
        return file.read()


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
    """The same of a text whose tables are read already, which are not changed."""
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
    scene = _check_whole(replace(scene, irrational=(*rounded, *names.irrational)), names.places, faults, by_drive)
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
    """The scene; where motion alone is asked for and no balance given, without the loads, which nothing needs then."""
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
    """The points on whose coordinates results depend: others place points, or are points of links that nothing uses.

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
    """What is asked for where nothing is said: velocity and acceleration of every joint that can move, or where there
    is none of every point that can, and the rates of every link."""
    at = {pair.at for pair in names.pairs if isinstance(pair, Slide)}
    moving = tuple(p for p in names.movable if names.link_counts[p] > 1 or p in at) or names.movable
    return Find(moving, moving, links=names.moving, by_default=True)


def _check_whole(scene: Scene, placed: dict[str, Pair], faults: Faults, by_drive: bool) -> Scene:
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
