"""The words of a task: what is given, what is to be found, a table to fill; and of its guided version, the steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import zip_longest
from typing import Any

from graphplan.kernel.kinds import COMPASSES, DIVIDERS, PROTRACTOR, SCALE, SET_SQUARES, STRAIGHTEDGE
from graphplan.mechanism.load_values import spring_laws, spring_numbers
from graphplan.mechanism.model import Balance, Contact, Drive, Force, Friction, Gear, Loads, Moment, Pair, Scene
from graphplan.mechanism.order import named_forces, named_moments
from graphplan.methods.kinds import (
    ACCELERATION_CENTRE,
    CENTRE,
    CUSP,
    INFLECTION,
    POLE,
    POLE_HEADING,
    REACTIONS,
    STRAIGHT,
    TRANSLATION,
    kind_of,
)
from graphplan.methods.panels import link_named, list_links, pair_text, pole_letter, reactions_named, slide_named
from graphplan.methods.results import pair_forces
from graphplan.phrases import Said, arrange, coordinates, digits, join, phrase, said, unit
from graphplan.sheet.frames.title import GUIDED, TASK
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.lettering.lettering import name_runs, sentence_runs
from graphplan.sheet.plates.annotations import rate_letters
from graphplan.sheet.words.facts import GIVEN_DIGITS, dimensions, given_number, reduced_coefficient, spring_pull, topics
from graphplan.sheet.words.rows import (
    TICKED_INDENT,
    Deviations,
    Table,
    TextRow,
    answer_rows,
    boxes_fit,
    join_tables,
    table_rows,
    with_tick_box,
)
from graphplan.sheet.words.texts import SheetWords

INSTRUMENTS = {
    SET_SQUARES: phrase("set squares"), STRAIGHTEDGE: phrase("straightedge"), COMPASSES: phrase("compasses"),
    DIVIDERS: phrase("dividers"), PROTRACTOR: phrase("protractor"), SCALE: phrase("scale"),
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class TaskWords(SheetWords):
    """All that is said on a task sheet, or where it is `guided`, on the sheet of a student who is told the steps."""

    composition: Composition = field(kw_only=True)
    indent = TICKED_INDENT
    unfolded = True

    def lines(self, wide: float, guided: bool) -> list[TextRow]:
        """Everything, for a column of this width."""
        head, steps = (GUIDED, self._steps(wide, self.composition.scales)) if guided else (TASK, iter(()))
        wishes = self.drawing.scene.sheet.task
        return [self._heading(head, gap=0.0), *(self.paragraph(wishes, wide) if wishes else ()),
                *self._given_rows(wide), *self._plans(wide), *steps, *self._answers(wide),
                *(() if guided else self._hints(wide))]

    def _given_rows(self, wide: float) -> Iterator[TextRow]:
        scene = self.drawing.scene
        yield from self.paragraph(scene.source, wide) if scene.source else ()
        yield self._heading(said("Given"))
        for sentence in data(scene, dimensioned=bool(self.composition.arrangement.facts)):
            yield from self._hanging_rows(sentence_runs(self.plans.tongue(sentence)), wide)  # alpha_1 is no locus alpha
        yield from table_rows(self._masses())
        questions = list(question(scene, self.values))
        yield from [self._heading(said("To find"))] if questions else []
        for sentence in questions:
            yield from self.paragraph(sentence, wide)

    def _masses(self) -> Table:
        """The masses of the links, as a table."""
        loads, say, mass = self.drawing.scene.loads, self.plans.tongue, self.drawing.scene.units.mass
        if not loads or not loads.masses:
            return []
        heads = (said("link"), arrange("m {0}", unit(mass)), arrange("J {0}", unit(f"{mass}·m²")),
                 said("mass centre"))
        table = [[sentence_runs(say(head)) for head in heads]]
        for link, body in loads.masses.items():
            cells = (link, given_number(body.mass), given_number(body.inertia))
            table.append([*(sentence_runs(say(cell)) for cell in cells), name_runs(body.centre)])
        return table

    def _plans(self, wide: float) -> Iterator[TextRow]:
        """The scale of each plan, and where it begins."""
        yield self._heading(said("Scales"))
        for plate in self.composition.plates:
            texts = self.composition.scales.scale_texts(plate.panel, self.plans.kinds(plate.panel))
            texts += [said("origin {0}", mark.name) for mark in plate.beginnings if mark.name]
            yield from self.paragraph(arrange("{0:capital}: {1}.", plate.panel.words, join(texts)), wide)

    def _row_with_number(self, row: TextRow) -> TextRow:
        """The row with a box to tick before its number."""
        return with_tick_box(row)

    def _hints(self, wide: float) -> Iterator[TextRow]:
        """Yield the hints: instruments, and the number of steps."""
        program = self.drawing.drawn
        steps = program.steps[program.givens:]
        used = {step.op.instrument for step in steps}
        yield self._heading(said("Hints"))
        named = join(name() for instrument, name in INSTRUMENTS.items() if instrument in used)
        yield from self.paragraph(said("Instruments: {0}.", named), wide)
        yield from self.paragraph(said("Steps of the solution: {0}.", len(steps)), wide)

    # ---- the table to fill -----------------------------------------------------------------------------------------

    def _answers(self, wide: float) -> Iterator[TextRow]:
        """A box for every number that the construction gives, in the order of the solution."""
        pairs = [pair for pair in self._pairs() if any(pair)]
        yield from [self._heading(said("Results"))] if pairs else []
        for first, second in pairs:
            for table in join_tables(first, second, partial(boxes_fit, wide=wide)):
                yield from answer_rows(table, wide)

    def _pairs(self) -> Iterator[tuple[Table, Table]]:
        """The tables of the solution, two by two as they stand side by side."""
        yield from self._motion(Deviations())
        if self.drawing.scene.loads:
            tables = self._force_tables(Deviations())
            yield from zip_longest(tables.reactions(), [self._seats()], fillvalue=[])
            yield tables.balance(), []

    def _seats(self) -> Table:
        """Points of application of slides' reactions, as a table."""
        say, slides = self.plans.tongue, {slide.name: slide_named(slide) for slide in self.drawing.scene.slides}
        arms = self.values.get("slide arm", {})
        heads = [sentence_runs(say(text)) for text in (said("line of action of"), "x",
                                                       join(("y", unit(self.drawing.scene.units.length)), " "))]
        box = sentence_runs("0")  # stands for a number
        return [heads, *([sentence_runs(say(slides[name])), box, box] for name in arms)] if arms else []


QUESTIONS = {  # how kinds of results are asked for, and how those that have them are told
    "velocity": (phrase("Velocities: {0}."), ", ".join), "acceleration": (phrase("Accelerations: {0}."), ", ".join),
    "omega": (phrase("Angular velocities: {0}."), list_links),
    "alpha": (phrase("Angular accelerations: {0}."), list_links),
}  # fmt: skip


# ---- what is given and to be found, in the words of a problem book --------------------------------------------------


def data(scene: Scene, dimensioned: bool = False) -> Iterator[Said]:
    """The mechanism in its pose, what drives it and what loads it, a sentence each.

    Where it is `dimensioned` elsewhere, its dimensions are left out. A pose that is to be constructed is so from the
    points of another.
    """
    if scene.assembly is not None:
        yield said("Points, in {0}: {1}.", unit(scene.units.length),
                   join(join((name, _pair(at)), " ") for name, at in scene.assembly.given_scene.points.items()))
    elif not dimensioned:
        yield from (arrange("{0}: {1}.", topic, text) for topic, text in topics(dimensions(scene)))
    loose = {} if scene.assembly else {name: at for name, at in scene.points.items() if not scene.links_of[name]}
    if loose:  # of no link, such as where two links touch: no length says where it is
        yield said("Points, in {0}: {1}.", unit(scene.units.length),
                   join(join((name, _pair(at)), " ") for name, at in loose.items()))
    yield said("Links: {0}.", join(join((link_named(link), f"({' '.join(names)})"), " ")
                                   for link, names in scene.links.items()))
    for kind in dict.fromkeys(type(slide) for slide in scene.slides):
        yield kind.sentence(join(join((slide_named(slide), said("at {0}", slide.at)), " ")
                                 for slide in scene.slides if type(slide) is kind))
    if scene.gears:
        yield Gear.sentence(join(map(_gear_text, scene.gears), "; "))
    if scene.contacts:
        yield Contact.sentence(join(map(_touching, scene.contacts), "; "))
    yield from _motion(scene)
    extreme = scene.assembly.extreme if scene.assembly else None
    if extreme and extreme.coupler:
        yield said("Construct the outer extreme position of {0}, with crank and coupler in one line."
                   if extreme.way == "outer" else
                   "Construct the inner extreme position of {0}, with crank and coupler in one line.",
                   link_named(extreme.link))
    elif scene.assembly is not None:
        if extreme:
            yield said("{0:capital} is at a turning point (dead centre).", link_named(extreme.link))
        for drive, travel in zip(scene.drives, scene.assembly.travels, strict=False):
            yield _moved_on(drive, travel, scene.units.length)
    if scene.loads:
        yield from _loads(scene, scene.loads)


def _gear_text(gear: Gear) -> Said:
    """Two links that roll on each other: about which centres, and by what sizes."""
    if gear.direction is not None:
        return said("{0} about {1} on {2} as a rack, r = {3}", link_named(gear.links[0]), gear.centres[0],
                    link_named(gear.links[1]), given_number(gear.radius))
    sizes = phrase("{0} : {1} teeth") if gear.teeth else phrase("radii {0} and {1}")
    form = {(False, "open"): [said("open belt")], (False, "crossed"): [said("crossed belt")],
            (True, ""): [said("the second a ring")]}.get((gear.internal, gear.belt), [])
    return join((said("{0} about {1} and {2} about {3}", link_named(gear.links[0]), gear.centres[0],
                      link_named(gear.links[1]), gear.centres[1]),
                 sizes(*map(given_number, gear.teeth or gear.radii or ())), *form))


def _touching(contact: Contact) -> Said:
    """Two links that touch: where, and how each is curved there."""
    links = [said("{0} with the centre of curvature {1}", link_named(link), centre) if centre
             else said("{0} straight along {1}", link_named(link), _pair(contact.direction or (0, 0)))
             for link, centre in zip(contact.links, contact.centres, strict=True)]
    return join((said("at {0}", contact.at), *links, *([said("without slipping")] if contact.rolling else [])))


def _moved_on(drive: Drive, travel: Fraction, length: str) -> Said:
    """Travel of a drive to the pose that is to be constructed, in words."""
    distance = join((given_number(travel), unit(length)), " ") if drive.slides else said("{0}°", given_number(travel))
    return said("Construct the pose in which {0} has gone on by {1} relative to {2}.", link_named(drive.link), distance,
                link_named(drive.on))


def _motion(scene: Scene) -> Iterator[Said]:
    """The drives and the given motions of points."""
    length = scene.units.length
    for drive in scene.drives:
        of = length if drive.slides else "rad"
        rates = map(_with_unit, rate_letters(drive), drive.rates, (f"{of}/s", f"{of}/s²"))
        turns = [] if drive.rpm is None else [_with_unit("n", drive.rpm, "1/min")]
        does = phrase("{0:capital} slides along {1}: {2}." if drive.slides
                      else "{0:capital} turns relative to {1}: {2}.")
        yield does(*map(link_named, drive.links), join((*turns, *rates)))
    for name, motion in scene.motions.items():
        velocity = join((f"v_{name} =", _pair(motion.velocity), unit(f"{length}/s")), " ")
        acceleration = join((f"a_{name} =", _pair(motion.acceleration), unit(f"{length}/s²")), " ")
        yield said("Motion of {0}: {1}.", name, join((velocity, acceleration)))


def _loads(scene: Scene, loads: Loads) -> Iterator[Said]:
    """Gravity, forces, moments and friction."""
    units = scene.units
    if any(loads.gravity):
        yield said("Gravity: {0}.", join(("g =", _pair(loads.gravity), unit("m/s²")), " "))
    for law in spring_laws(loads.forces):
        stiffness, free = spring_numbers(law)
        name = "".join(law.span or ())
        yield said("Spring {0}: stiffness {1}, length without force {2}.", name,
                   _with_unit(f"c_{name}", stiffness, f"{units.force}/{units.length}"),
                   _with_unit(f"l_0{name}", free, units.length))
    for letter, force in named_forces(loads).items():
        pull, at = spring_pull(force), said("at {0}", force.at)
        value = join((f"{letter} =", *((pull,) if pull else (_pair(force.value), unit(units.force))), at), " ")
        yield said("Force on {0}: {1}.", link_named(force.on), value if pull else _value_text(value, force))
    for letter, moment in named_moments(loads).items():
        value = _with_unit(letter, moment.value, f"{units.force}·m")
        yield said("Moment on {0}: {1}.", link_named(moment.on), _value_text(value, moment))
    slides = {(slide.link, slide.along): slide for slide in scene.slides}
    for friction in (*loads.frictions, *(gear.grip.friction for gear in scene.gears if gear.grip)):
        if friction.gear:
            share = given_number(1 - friction.coefficient)
            yield said("Losses of the gear {0}: efficiency {1}.", " ".join(friction.gear), share)
            continue
        place = (slide_named(slides[friction.slide]) if friction.slide
                 else pair_text(friction.links) if friction.links else said("at {0}", friction.at))
        radius = [] if friction.links else [_with_unit("r", friction.radius, units.length)]
        radius += [_with_unit("l", friction.length, units.length)] if friction.length else []
        if friction.rolling:
            yield said("Resistance to rolling {0}: {1}.", place, _with_unit("k", friction.coefficient, units.length))
            continue
        yield said("Friction {0}: {1}.", place, join((*_coefficients(friction), *radius)))
    for screw in loads.screws:
        numbers = [_with_unit("h", screw.lead, units.length), _with_unit("r", screw.radius, units.length)]
        if screw.thread:
            numbers.append(said("thread {0}°", given_number(screw.thread.degrees)))
        yield said("Screw of the slide {0}: {1}.", slide_named(slides[screw.links]), join((*numbers, arrange(
            "mu = {0}", given_number((screw.thread or screw).coefficient)))))


def _coefficients(friction: Friction) -> Iterator[Said]:
    """The coefficient of a friction, and how that of a wedge comes of the flanks'."""
    wedge = friction.wedge
    yield arrange("mu = {0}", given_number((wedge or friction).coefficient))
    if wedge:
        yield said("a V-groove of {0}°", given_number(wedge.degrees))
        yield arrange("mu' = {0}", reduced_coefficient(wedge, friction))


def _value_text(value: Said, load: Force | Moment) -> Said:
    """The value of a load, and whether it changes over the cycle."""
    return said("{0} in this pose; it changes over the cycle", value) if load.table else value


def question(scene: Scene, values: Mapping[str, Mapping[str, Any]]) -> Iterator[Said]:
    """Yield the task of a construction: `values` are its readings by kind and name."""
    for kind, (ask, enumerated) in QUESTIONS.items():
        if values.get(kind):
            yield ask(enumerated([*values[kind]]))
    slides = {slide.name: slide_named(slide) for slide in scene.slides}
    if values.get("slide velocity") or values.get("slide acceleration"):
        moving = dict.fromkeys((*values.get("slide velocity", ()), *values.get("slide acceleration", ())))
        yield said("Sliding velocities and accelerations: {0}.", join(slides[name] for name in moving))
    if poles := [pole_letter(scene.link_pair(name)) for kind in (POLE, POLE_HEADING) for name in values.get(kind, ())]:
        yield said("Instant centres: {0}.", ", ".join(poles))
    if traced := [name for kind in (CENTRE, STRAIGHT, CUSP) for name in values.get(kind, ())]:
        yield said("Centres of curvature of the paths of: {0}.", ", ".join(traced))
    if circles := [name for kind in (INFLECTION, TRANSLATION) for name in values.get(kind, ())]:
        yield said("Inflection circles of: {0}.", list_links(circles))
    if links := [*values.get(ACCELERATION_CENTRE, ())]:
        yield said("Acceleration centres of: {0}.", list_links(links))
    known = {name for kind in REACTIONS for name in values.get(kind, ())}
    if forces := [force for force in pair_forces(scene) if force.name in known]:
        words = reactions_named(scene)
        reactions = dict.fromkeys(words.get(force.pair, force.pair) for force in forces)
        yield said("Reactions: {0}.", join(reactions))
    if scene.loads and any(kind_of(kind).way for kind in values):
        yield from map(_keeping, scene.loads.balances)
    if wish := scene.flywheel:
        speed = digits(float(wish.speed)), unit(f"{scene.units.length}/s" if scene.drives[0].slides else "rad/s")
        yield said("Reduced moment and reduced inertia over the cycle, and the moment that closes it.")
        yield (said("The unevenness at a mean speed of {0} {1} with the flywheel {2}.", *speed,
                    _with_unit("I", wish.inertia, f"{scene.units.mass}·m²"))
               if wish.inertia is not None else
               said("The flywheel for an unevenness of {2} at a mean speed of {0} {1}.", *speed,
                    digits(float(wish.unevenness or 0))))


def _keeping(balance: Balance) -> Said:
    """The question for the unknown that keeps the motion."""
    if balance.at:
        return said("The force on {0} at {1} that keeps this motion.", link_named(balance.link), balance.at)
    return said("The moment on {0} that keeps this motion.", link_named(balance.link))


def _with_unit(letter: str, value: Any, symbol: str) -> Said:
    return join((letter, "=", given_number(value), unit(symbol)), " ")


def _pair(pair: Pair) -> Said:
    return coordinates(map(float, pair), GIVEN_DIGITS)
