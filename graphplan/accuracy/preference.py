"""Which form to draw: every form that there is, drawn and weighed by its operations and by its pencil error."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any

from graphplan.accuracy import PREFERENCES
from graphplan.accuracy.drafted import Drafted, drafted, percent
from graphplan.accuracy.pencil import Pencil
from graphplan.errors import ConstructionError, GraphplanError, Refused
from graphplan.kernel.kinds import FAILURES, plain
from graphplan.kernel.program import Program
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct as unchecked
from graphplan.methods.construction import Construction
from graphplan.methods.styles import METHODS
from graphplan.phrases import Phrase, Said, arranged, joined, phrase, said
from graphplan.sheet.layout.paper import sheet_size

Constructing = Callable[..., Construction]
Sheets = Callable[[Construction, Pencil, str | None], Drafted]

FORMS = ("", *METHODS)  # first the one that the pose chooses
NAMES = {"": phrase("pose's own"), "auxiliary": phrase("auxiliary"), "trial": phrase("trial"), "poles": phrase("poles")}


def plans_alone(drawing: Construction, pencil: Pencil, paper: str | None = None) -> Drafted:
    """A construction on its paper without words or letters: forms are weighed by their plans."""
    return drafted(drawing, pencil, paper, protocol="none", lettered=False)


def called(methods: Sequence[str]) -> Said:
    """What the form is called to which these methods lead."""
    return said("every method") if tuple(methods) == FORMS else joined(NAMES[method]() for method in methods)


def reason(refusal: GraphplanError) -> str:
    """Why a form cannot be drawn, without what to do about it: there are other forms."""
    match refusal:
        case ConstructionError():
            return said("step {0}: {1}", refusal.step, FAILURES[refusal.code][0])
        case Refused():
            return joined((refusal.what, refusal.why), ": ")
    return str(refusal)


@dataclass(frozen=True)
class Form:
    """One drawing, by all the methods that lead to it; or a method that does not, and why."""

    methods: tuple[str, ...]
    drafted: Drafted | None
    refusal: GraphplanError | None = None

    @property
    def name(self) -> Said:
        """What it is called."""
        return called(self.methods)

    @property
    def told(self) -> Said:
        """What speaks for it, or against it, in words."""
        if self.drafted is None:
            assert self.refusal is not None
            return said("{0}: cannot be drawn: {1}", self.name, reason(self.refusal))
        told = said("{0}: {1} operations, error {2}", self.name, self.drafted.operations, percent(self.drafted.error))
        return arranged("{0} ({1})", told, self.drafted.worst.named) if self.drafted.worst else told


@dataclass(frozen=True)
class Preference:
    """The form preferred, by the name of its method, and what is told of the choice: a line each."""

    method: str
    told: tuple[Said, ...] = ()


def forms(scene: Scene, pencil: Pencil, *, plan: str = "", strict: bool = False, inertia: str = "couple",
          paper: str | None = None, construct: Constructing = unchecked, sheets: Sheets | None = None) -> list[Form]:
    """Every form of a scene's construction, each on its sheet; those that cannot be drawn with their reason."""
    on_sheet = sheets or drafted

    def made(methods: list[str], one: Construction | GraphplanError) -> list[Form]:
        try:
            if isinstance(one, GraphplanError):
                raise one
            return [Form(tuple(methods), on_sheet(one, pencil, paper))]
        except GraphplanError as refusal:
            return [Form((method,), None, refusal) for method in methods]

    ways = constructions(scene, plan=plan, strict=strict, inertia=inertia, construct=construct)
    return sorted([form for way in ways for form in made(*way)], key=lambda form: FORMS.index(form.methods[0]))


def constructions(scene: Scene, *, construct: Constructing = unchecked,
                  **how: Any) -> list[tuple[list[str], Construction | GraphplanError]]:
    """Every construction of a scene with the methods that lead to it; or why they lead to none."""
    return led_to(partial(_drawn_once, scene, how, construct, {}), lambda drawing: drawing.drawn)


def _drawn_once(scene: Scene, how: dict[str, Any], construct: Constructing, known: dict[Any, Construction],
                method: str) -> Construction:
    """The construction to which a method leads: one that is `known` where it is the same program, drawn in such forms.
    """
    key: Any = None
    with suppress(GraphplanError):
        steps = unchecked(scene, method=method, **how).program.steps
        wished = {plain(form) for step in steps for form in step.op.forms} & {METHODS.get(method)}
        key = tuple([step.key for step in steps]), *wished
    if key is None or key not in known:
        known[key] = construct(scene, method=method, **how)
    return known[key]


def led_to(draw: Constructing,
           program: Callable[[Construction], Program]) -> list[tuple[list[str], Construction | GraphplanError]]:
    """The constructions of different programs to which methods lead, each with these; or why they lead to none."""
    found: dict[Any, tuple[list[str], Construction | GraphplanError]] = {}
    for method in FORMS:
        one: Construction | GraphplanError
        try:
            one = draw(method=method)
            key: Any = tuple([step.key for step in program(one).steps])
        except GraphplanError as refusal:
            one, key = refusal, str(refusal)
        found.setdefault(key, ([], one))[0].append(method)
    return list(found.values())


def preferred(scene: Scene, prefer: str, pencil: Pencil, *, method: str = "", plan: str = "",
              strict: bool = False, inertia: str = "couple", paper: str | None = None,
              construct: Constructing = unchecked) -> Preference:
    """The form that is quickest, most accurate or, by the product of both beside the best of each, balanced.

    Fails with `Refused` where a method is named as well, and as the pose's own form does where none can be drawn.
    """
    if prefer not in WEIGHED:
        raise Refused(f"--prefer {prefer}", "nothing is weighed so", f"one of {', '.join(WEIGHED)}")
    if method:
        raise Refused(f"--prefer {prefer}", f"--method {method} names the form already", "leave out one of the two")
    found = _on_one_paper(forms(scene, pencil, plan=plan, strict=strict, inertia=inertia, paper=paper,
                                construct=construct, sheets=plans_alone))
    if found[0].refusal is not None and all(form.refusal for form in found):
        raise found[0].refusal
    return weighed(found, prefer)


def weighed(found: Sequence[Form], prefer: str) -> Preference:
    """The best of some forms, of which one at least is drawn; of equals the first."""
    drawn = [(form, form.drafted) for form in found if form.drafted is not None]
    word, weigh = WEIGHED[prefer]
    best, on = min(drawn, key=lambda pair: weigh(pair[1]))
    head = said("{0} form preferred: {1}; compared on {2}:", word(), best.name, on.paper)
    return Preference(best.methods[0], (head, *(form.told for form in found)))


def _on_one_paper(found: list[Form]) -> list[Form]:
    """The same forms, all on the largest of their sheets: a larger one would make any form more accurate."""
    papers = [form.drafted.paper for form in found if form.drafted is not None]
    largest = max(papers, key=lambda paper: sheet_size(paper)[0] * sheet_size(paper)[1], default="")
    return [_moved(form, form.drafted, largest) if form.drafted is not None else form for form in found]


def _moved(form: Form, one: Drafted, paper: str) -> Form:
    """A form drawn on another sheet, or why it cannot be."""
    if one.paper == paper:
        return form
    try:
        return Form(form.methods, plans_alone(one.drawing, one.pencil, paper))
    except Refused as refusal:
        return Form(form.methods, None, refusal)


WEIGHED: dict[str, tuple[Phrase, Callable[[Drafted], tuple[float, ...]]]] = dict(zip(PREFERENCES, (
    (phrase("quick"), lambda one: (one.operations, one.error)),  # fewest operations first
    (phrase("accurate"), lambda one: (one.error, one.operations)),  # smallest pencil error first
    (phrase("balanced"), lambda one: (one.operations * one.error, one.operations)),  # each beside the best of its kind
), strict=True))
