"""The kinds of mark, what a record of the table holds, and the choice among the forms of a compound.

| kind    | value                                                                                     |
|---------|-------------------------------------------------------------------------------------------|
| point   | (x, y)                                                                                    |
| line    | (a, b, c), the points with a x + b y + c = 0; it runs along (b, -a)                       |
| opening | (r2,), the square of a distance between the compasses' points                             |
| circle  | (x, y, r2), centre and squared radius: so that everything but a compass meeting is rational |
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple, Self

from graphplan.phrases import Phrase, Said, digits, join, said, sentence

POINT, LINE, OPENING, CIRCLE = "point", "line", "opening", "circle"

SCALE, STRAIGHTEDGE, SET_SQUARES = "scale", "straightedge", "set squares"
COMPASSES, DIVIDERS, PENCIL, PROTRACTOR = "compasses", "dividers", "pencil", "protractor"

Claim = tuple[Any, ...]


class Quantity(NamedTuple):
    """The quantity for which a length is drawn: its text, such as P_3 or ω·OA, and the kind of its scale.

    One that is `changing` has another value in other poses, so that nothing else may be drawn by the same step.
    """

    written: str
    kind: str  # length, velocity, acceleration or force
    changing: bool = False

    @property
    def sharing_key(self) -> tuple[Quantity, ...]:
        """Key that prevents another quantity of the same length in this pose from sharing the step."""
        return (self,) if self.changing else ()


Form = Callable[..., Any]  # what it draws on the board from its operands; nothing where it is not for the pose


class Variant(str):
    """The name of a form that is another, drawn otherwise: what counts as that `form` counts as this one."""

    form: str

    def __new__(cls, form: str, otherwise: str) -> Self:
        self = super().__new__(cls, f"{form} {otherwise}")
        self.form = form
        return self


def plain(form: str) -> str:
    """The form that a form is, or is a variant of."""
    return form.form if isinstance(form, Variant) else form


class Movement(Enum):
    """A movement of the hand: primitives of one movement with the same operands draw the same."""

    GIVEN = "a point of the pose is marked"
    BEGUN = "a plan is begun where there is room"
    PICKED = "a point of a line is chosen"
    GUIDED = "a line is drawn in a given direction"
    INCLINED = "a line is drawn at a given angle"
    RULED = "a line is drawn through two points"
    PARALLEL = "a parallel is drawn"
    PERPENDICULAR = "a perpendicular is drawn"
    BISECTED = "the bisector of two points is drawn"
    MET = "two lines cross"
    CUT = "a line crosses an arc"
    ARCS_MET = "two arcs cross"
    OPENED = "a distance is taken between the compasses' points"
    STRUCK = "an arc is struck"
    TRACED = "a curve through points crosses an arc"
    TRACES_MET = "two curves through points cross"
    HALVED = "a distance is halved"
    DROPPED = "a perpendicular is dropped"
    LAID_OFF = "a vector is laid off, or a multiple of it"
    TURNED = "a vector is laid off, turned a quarter, or a multiple of it"
    LAID_ALONG = "a length is laid off along a line"
    LAID_BY_COMPONENTS = "a given vector is laid off"
    MEASURED = "what is laid off is worked out from lengths that are measured"
    OTHER = "a movement of its own; of a compound several"


class Sizing(Enum):
    """The rule by which an operation computes the length that it lays off, rather than measuring it."""

    MOMENTS = "a force in mm times its arm about 0, from 2, over the distance of 0 and 1"
    COUPLE = "a given couple over the distance of 0 and 1"
    INERTIA = "what the tangential part from 2 to 3 makes of a moment of inertia, over the distance of 0 and 1"
    FRICTION = "the given radius of a friction circle about 0"
    SHIFT = "the couple of the force from 5 to 6 at 4 about 3, over the force from 1 to 2 at 0"
    SQUARE = "the square of the velocity from 2 to 3 over the distance of 0 and 1, laid off from 4"
    QUOTIENT = "the square of the velocity from 2 to 3 over the distance of 0 and 1, computed, laid off from 4"
    PROPORTION = "the vector from 3 to 4, by the ratio of the distance of 0 and 2 to that of 0 and 1"
    DOUBLE = "twice a vector that is found beforehand, laid off from 4"


LAID = frozenset({Movement.DROPPED, Movement.LAID_OFF, Movement.TURNED, Movement.LAID_ALONG,
                  Movement.LAID_BY_COMPONENTS, Movement.MEASURED})
OPPOSITE = {"left": "right", "right": "left", "on": "back", "back": "on"}


@dataclass(frozen=True, eq=False)
class Primitive:
    """One operation of the drawing board: everything that graphplan knows of it.

    | field | what it says |
    |---|---|
    | `name` | the verb of the board, and the key of its sentence in the catalogues |
    | `reads`, `gives` | the kinds of its operands and of what it makes |
    | `instrument` | what is taken in hand |
    | `sentence` | how it is spoken: operands {0}, {1}, ..., what is made {out}, parameters by name |
    | `rule` | `rule(domain, *values, **params)` gives the value; its docstring says what that is |
    | `claims` | what the drawn thing must satisfy, whatever the rule: see :mod:`graphplan.kernel.claims` |
    | `fails` | the codes of what may go wrong |
    | `params` | the names of what it is given beside its operands |
    | `source` | author, year and section |
    | `where` | the operand on whose plan it is drawn (-1: the last), with all that lie on no other |
    | `symmetric` | whether the order of its operands does not matter |
    | `movement` | what the hand does |
    | `afar` | operands that may lie on other plans, each group on one: vectors, openings and directions |
    | `reversal` | the parameter that turns round where the first operand runs the other way, or curves change places |
    | `described` | how a line is spoken of where its number says nothing |
    | `forms` | the ways to draw a compound from other operations, by name, the textbook's first |
    | `by_form` | how it is spoken as one step where it is drawn in these forms, with their inner marks by name |
    | `before` | how in these forms that part is spoken which is drawn before the rest, as on another plan |
    | `reasons` | why it is drawn, in these forms, instead of what a recipe says |
    | `likewise` | how it is spoken briefly after another one, by form; "" is that of a single movement |
    | `weighed` | whether the choice of its form is told, with its reason |
    | `sizing` | how long it is what it lays off, where that is worked out |
    | `method` | what it is called where the ways are listed in which forces are found |
    """

    name: str
    reads: tuple[str, ...]
    gives: str
    instrument: str
    sentence: str
    rule: Callable[..., Any] = field(repr=False)
    claims: tuple[Claim, ...] = ()
    fails: tuple[str, ...] = ()
    params: tuple[str, ...] = ()
    source: str = ""
    where: int = -1
    symmetric: bool = False
    movement: Movement = Movement.OTHER
    afar: tuple[tuple[int, ...], ...] = ()
    reversal: str = ""
    described: str = ""
    weighed: bool = False
    sizing: Sizing | None = None
    method: str = ""
    forms: dict[str, Form] = field(default_factory=dict, repr=False)
    by_form: dict[str, Phrase] = field(default_factory=dict, repr=False)
    before: dict[str, Phrase] = field(default_factory=dict, repr=False)
    likewise: dict[str, Phrase] = field(default_factory=dict, repr=False)
    reasons: dict[str, Said] = field(default_factory=dict, repr=False)

    def __reduce__(self) -> tuple[Callable[[str], Primitive], tuple[str]]:
        """Pickled by name; the table is a singleton."""
        return primitive_named, (self.name,)

    @property
    def compound(self) -> bool:
        """Whether it can be drawn from other primitives."""
        return bool(self.forms)

    @property
    def free(self) -> bool:
        """Whether it stands where it is put, made from no mark: a point of the pose, or the beginning of a plan."""
        return self.gives == POINT and not self.reads

    @cached_property
    def same_plan_operands(self) -> tuple[int, ...]:
        """The operands that lie on the plan on which it is drawn: all but vectors, openings and directions."""
        return tuple(place for place in range(len(self.reads)) if not any(place in group for group in self.afar))

    @cached_property
    def root(self) -> int | None:
        """The operand that a point is laid off from, if it is: a stroke joins the two."""
        return self.where % len(self.reads) if self.movement in LAID else None

    @property
    def has_size(self) -> bool:
        """Whether what is laid off has a given size."""
        return self.root is not None and self.instrument == SCALE and self.movement is not Movement.MEASURED

    @cached_property
    def crossing(self) -> bool:
        """Whether it marks where the two curves that it reads cross: the angle between them matters."""
        return self.gives == POINT and self.claim_operands("on") == [0, 1] and len(self.reads) == 2

    @property
    def spans(self) -> bool:
        """Whether its mark lies between the two points that it reads."""
        return self.movement in (Movement.RULED, Movement.OPENED)

    def sentence_of(self, read: Iterable[Any], **named: Any) -> Said:
        """The operation's sentence with its operands, its result `out` and its parameters in words."""
        return sentence(self.name, self.sentence, read, named)

    def claim_operands(self, kind: str) -> list[Any]:
        """The first operands of the claims of a kind: those that it lies `on`, that it runs `parallel` to."""
        return [claim[1] for claim in self.claims if claim[0] == kind]

    def reverse_parameters(self, params: Mapping[str, Any]) -> dict[str, Any]:
        """The parameters with that of its reversal turned round: to the other side, or negative."""
        given = params[self.reversal]
        return {**params, self.reversal: OPPOSITE[given] if isinstance(given, str) else -given}


# What stands in a sentence for a choice that a step is given.
CHOICES: dict[str, Said] = {str(word): word for word in (
    said("on"), said("back"), said("left"), said("right"), said("parallel"), said("perpendicular"))}


def parameter_text(value: Any) -> str:
    """A parameter as a reader wants it: a plan in words, a short decimal, a plain fraction such as 2/3, six digits."""
    if isinstance(value, str):
        return CHOICES.get(value, getattr(value, "words", value))
    if isinstance(value, Fraction) and value.denominator <= 16 and 1000 % value.denominator:
        return str(value)
    return digits(float(value), 6) if isinstance(value, Fraction | float) else str(value)


TABLE: dict[str, Primitive] = {}


def primitive_named(name: str) -> Primitive:
    """The operation of this name."""
    return TABLE[name]


def made_by(movement: Movement) -> Primitive:
    """The operation of a movement, the plainest where there are several."""
    return next(op for op in TABLE.values() if op.movement is movement)


FAILURES: dict[str, tuple[Said, Said]] = {
    "points-coincide": (said("two points that should give a direction coincide"),
                        said("move one of them, or ask for less")),
    "lines-parallel": (said("two lines that should meet are parallel"),
                       said("--method trial, or let the form be chosen")),
    "no-direction": (said("a given direction has no length"), said("give another direction")),
    "circles-miss": (said("two circles do not meet"), said("check the lengths")),
    "circles-concentric": (said("two circles have the same centre"), said("check the centres")),
    "line-misses-circle": (said("the line does not meet the circle"), said("check the lengths")),
    "locus-undetermined": (said("the link's pole lies in the point, so its loci do not determine it"),
                           said("another pose: this one is singular")),
    "couple-alone": (said("a force is zero, so it cannot take up a couple"),
                     said("leave the couple beside it (--inertia couple)")),
    "trials-agree": (said("both trial figures have the same error"), said("another pose: this one is singular")),
    "straight-path": (said("the path is straight to second order, so it has no centre of curvature"),
                      said("another pose, or another point")),
    "not-rational": (said("a root is irrational"), said("leave out --exact")),
}


def primitive(reads: tuple[str, ...], gives: str, instrument: str, sentence: str,
              **more: Any) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Enter the decorated rule in the table under its own name, with the fields of :class:`Primitive`."""

    def enter(rule: Callable[..., Any]) -> Callable[..., Any]:
        name = rule.__name__
        if name in TABLE:
            raise ValueError(f"the table already has {name}")
        TABLE[name] = Primitive(name, reads, gives, instrument, sentence, rule, **more)
        return rule

    return enter


# ---- the choice of a form: how well each can be drawn in the pose ----------------------------------------------------
#
# Where no form serves, crossings below one degree are for want of better; of the others, one on the sheet beats one off
# it, crossings above 15 degrees beat flatter ones, and then the fewest movements win.


SHARP = math.sin(math.radians(15))
BLUNT = math.sin(math.radians(1))


@dataclass(frozen=True)
class Rating:
    """Rating of one form in this pose: its movements, whether it is on the sheet, its flattest crossing as a sine."""

    form: str
    movements: int
    on_sheet: bool = True
    sharpest: float = 1.0
    undrawn: int = 0

    @property
    def serves(self) -> bool:
        """Whether all of it can be drawn, on the sheet, with crossings that tell where they are."""
        return not self.undrawn and self.on_sheet and self.sharpest >= SHARP

    @property
    def rank(self) -> tuple[int, bool, bool, bool, int]:
        return self.undrawn, self.sharpest < BLUNT, not self.on_sheet, self.sharpest < SHARP, self.movements

    @property
    def text(self) -> Said:
        """Reason for the form, in words."""
        angle = math.degrees(math.asin(min(1.0, self.sharpest)))
        place = said("on the sheet") if self.on_sheet else said("off the sheet")
        return said("{0} ({1} steps, {2}, flattest crossing {3}°)", said(self.form), self.movements, place,
                    f"{angle:.0f}")


@dataclass(frozen=True)
class Choice:
    """The form in which a compound is drawn, and those that were passed over, as they do not serve in this pose."""

    compound: Primitive
    best: Rating
    passed: tuple[Rating, ...] = ()

    @property
    def form(self) -> str:
        """The form that is drawn, or of which it is a variant."""
        return plain(self.best.form)

    def __str__(self) -> str:
        return f"{self.compound.name}: {self.best.form}"

    def reason(self) -> Said:
        """Why this form, beside those that were passed over."""
        if not self.passed:
            return self.best.text
        return said("{0} rather than {1}", self.best.text, join(other.text for other in self.passed))
