"""The JSON Schemas of what `graphplan solve`, `graphplan steps --json` and `graphplan verify --json` print."""

from __future__ import annotations

from collections.abc import Collection

from graphplan.kernel import CIRCLE, LINE, OPENING, POINT, TABLE
from graphplan.marking.judge.verdict import STATES
from graphplan.mechanism import fields
from graphplan.mechanism.fields import Fragment
from graphplan.mechanism.schema import DRAFT, listed, table
from graphplan.mechanism.schema import described as told
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS

TEXT, NUMBER, FROM_0 = fields.TEXT.schema, fields.NUMBER.schema, fields.AMOUNT.schema
COUNT: Fragment = {"type": "integer", "minimum": 0}
EXACT: Fragment = {"type": "string", "pattern": r"^-?\d+(/\d+)?$"}
DECIMAL: Fragment = {"type": "string", "pattern": r"^-?\d+(\.\d+)?(e[+-]?\d+)?$"}
TEXTS = listed(TEXT)
PERCENT: Fragment = {"type": "number", "minimum": 0, "maximum": 100}
VERDICT = told("follows is right after an earlier slip; unseen is of a kind that the drawing does not show",
               {"enum": [*STATES]})
STEP = told("the number of the step, 0 for what is given", COUNT)
MARKED = {"step": STEP, "mark": told("its letter, or what it is", TEXT)}


def _value() -> Fragment:
    """A number of a result."""
    return {"anyOf": [NUMBER, told("a fraction p/q, with --exact", EXACT),
                      told("proven digits, with --digits", DECIMAL)]}


def _vector() -> Fragment:
    """Two of them."""
    return {"type": "array", "items": _value(), "minItems": 2, "maxItems": 2}


def _by_name(entry: Fragment) -> Fragment:
    """Entries by the names of the scene."""
    return {"type": "object", "additionalProperties": entry}


def _some(keys: dict[str, Fragment]) -> Fragment:
    """A table of some of these keys."""
    return {**table(keys, required=()), "minProperties": 1}


def _by_kind(entry: Fragment) -> Fragment:
    """Of velocities, accelerations and forces, those that there are."""
    return table({"velocity": entry, "acceleration": entry, "force": entry}, required=())


def _bounds() -> Fragment:
    """The bounds by kind, with --bounds those of each number besides."""
    entry = {"anyOf": [FROM_0, DECIMAL]}
    each = _by_name(_by_name({"anyOf": [FROM_0, listed(FROM_0)]}))
    return table({"velocity": entry, "acceleration": entry, "force": entry, "each": told("with --bounds", each)},
                 required=())


def _whole(title: str, keys: dict[str, Fragment], optional: Collection[str]) -> Fragment:
    """A schema with its draft and title."""
    required = [key for key in keys if key not in optional]
    return {"$schema": DRAFT, "title": title, **table(keys, required=required)}


# --- solve ---------------------------------------------------------------------------------------------------------


def _units() -> Fragment:
    return table({"length": {"enum": [*METRES]}, "force": {"enum": [*NEWTONS]}, "mass": {"enum": [*KILOGRAMS]}})


def _balance() -> Fragment:
    """The moment or the force that keeps the motion."""
    link = told("the link that it acts on", TEXT)
    return {"oneOf": [table({"moment": told("in force * m, counter-clockwise positive", _value()), "link": link}),
                      table({"force": told("its components", _vector()), "link": link,
                             "at": told("the point of the link where it acts", TEXT)})]}


def _reactions() -> Fragment:
    """The reactions in joints and slides."""
    links = {"on": told("the link that the reaction acts on", TEXT), "from": told("the link that it comes from", TEXT)}
    joint = table({"at": told("the joint", TEXT), **links, "force": _vector()})
    slide = table({
        "slide": told("the slide, such as 3 along 2", TEXT), **links, "force": _vector(),
        "moment": told("about the slide's point, in force * m", _value()),
        "acts_at": told("a point of the reaction's line, where that lies near", _vector()),
    }, required=["slide", *links, "force", "moment"])
    return listed({"anyOf": [joint, slide]})


def _friction() -> Fragment:
    """Balances and efficiency with friction."""
    keys = {"balance": listed(_balance()), "efficiency": told("the instantaneous efficiency", _value())}
    stands = told("where further rounds stand", table(keys))
    rounds = told("how many rounds of friction are drawn", COUNT)
    return table({**keys, "rounds": rounds, "stands": stands}, required=[*keys, "rounds"])


def solve() -> Fragment:
    """What `graphplan solve` prints."""
    return _whole("graphplan solve", {
        "title": TEXT,
        "units": told("the units of the scene, which the results are in", _units()),
        "points": told("of every point that is asked for", _by_name(_some({
            "velocity": told("in length/s", _vector()), "acceleration": told("in length/s^2", _vector())}))),
        "links": told("of every link that is asked for, or of which two points are", _by_name(_some({
            "omega": told("in rad/s, counter-clockwise positive", _value()), "alpha": told("in rad/s^2", _value())}))),
        "slides": told("of the point `at` relative to the guide, along it, in fixed axes", _by_name(_some({
            "velocity": told("in length/s", _vector()), "acceleration": told("in length/s^2", _vector())}))),
        "redundant": told("the pairs that special geometry makes redundant, such as 4 at D", TEXTS),
        "balance": told("what keeps the motion: a list where there are several drives",
                        {"anyOf": [_balance(), listed(_balance())]}),
        "reactions": told("the forces of links on each other", _reactions()),
        "indeterminate": told("the pairs whose reactions equilibrium does not tell, such as 4 at D", TEXTS),
        "friction": told("the balance with friction", _friction()),
        "method": told("how it is drawn", _by_kind(TEXTS)),
        "check": told("the largest difference from the analytic solver, beside what cancels in the number",
                      _by_kind(_value())),
        "steps": told("how many steps the drawing takes", COUNT),
        "digits": told("how many digits are proven, with --digits", COUNT),
        "bounds": told("proven: the most that a number of each kind may be off, beside itself and what cancels in it; "
                       "with --digits in units", _bounds()),
        "arithmetic": told("in which this is proven: floats, enclosures of so many digits, or fractions", TEXT),
        "pencil": told("how far off each result is drawn, with --pencil", _pencil()),
    }, optional=("redundant", "balance", "reactions", "indeterminate", "friction", "method", "steps", "digits",
                 "pencil"))


# --- steps ---------------------------------------------------------------------------------------------------------


def _step() -> Fragment:
    """One step of the construction."""
    return table({
        "number": STEP,
        "makes": told("the name of what it makes", TEXT),
        "kind": told("what it makes", {"enum": [POINT, LINE, OPENING, CIRCLE]}),
        "operation": told("the primitive of the table", {"enum": [*TABLE]}),
        "instrument": told("what it is drawn with", {"enum": sorted({op.instrument for op in TABLE.values()})}),
        "reads": told("the names of what it is drawn from", TEXTS),
        "plan": told("the plan that it stands on", TEXT),
        "sentence": told("the step in words", TEXT),
        "why": told("the law that it is drawn by", TEXT),
        "form": told("the form that was chosen, of several", TEXT),
        "reason": told("why it was chosen", TEXT),
        "links": told("the links that it is about", TEXTS),
        "value": told("point: x, y; line: a, b, c with a x + b y + c = 0; opening: its square; "
                      "circle: x, y and the square of its radius", listed(NUMBER)),
    })


def _cost() -> Fragment:
    """What drawing costs."""
    strict = {"anyOf": [COUNT, {"type": "null"}]}
    crossing = table({"step": COUNT, "mark": TEXT, "degrees": told("the angle between the curves", FROM_0)})
    return table({
        "said": told("in words", TEXT), "steps": COUNT, "operations": COUNT, "lines": COUNT, "arcs": COUNT,
        "scale": COUNT, "set squares": COUNT, "dividers": COUNT, "instrument changes": COUNT,
        "simplicity": told("after Lemoine, with --strict", strict),
        "exactitude": told("after Lemoine, with --strict", strict),
        "crossings": listed(crossing),
        "off the sheet": told("the steps that leave the paper of their plans", listed(COUNT)),
    })


def _pencil() -> Fragment:
    """How far off the pencil is."""
    step = {"number": STEP, "makes": TEXT, "sentence": TEXT}
    part = {"anyOf": [NUMBER, {"type": "null"}]}
    result = table({"mm": told("on paper", part), "value": told("in the scene's units", NUMBER),
                    "relative": told("beside the largest of its kind", part), "worst step": table(step)})
    worst = table({"kind": TEXT, "of": TEXT, "relative": part, "shares": listed(table({**step, "share": NUMBER}))})
    return table({
        "model": told("standard deviations: mm of paper, and degrees", _by_name(FROM_0)),
        "paper": told("the sheet, such as A3", TEXT),
        "results": told("expected errors by kind and name", _by_name(_by_name(result))),
        "worst result": {"anyOf": [worst, {"type": "null"}]},
        "worst step": {"anyOf": [table(step), {"type": "null"}]},
    })


def steps() -> Fragment:
    """What `graphplan steps --json` prints."""
    return _whole("graphplan steps", {
        "title": TEXT, "source": TEXT,
        "structure": told("the Assur groups", TEXTS),
        "kappa": told("the seconds that velocities are drawn long", NUMBER),
        "method": told("how it is drawn", _by_kind(TEXTS)),
        "forms": told("the forms chosen for this pose, and why", TEXTS),
        "cost": told("what drawing costs", _cost()),
        "steps": told("the pose, then every step in order", listed(_step())),
        "pencil": told("how far off the pencil is", _pencil()),
    }, optional=())


# --- verify --------------------------------------------------------------------------------------------------------


def _or_none(entry: Fragment) -> Fragment:
    """An entry, or null where there is none."""
    return {"anyOf": [entry, {"type": "null"}]}


def _judged() -> Fragment:
    """One step as it was judged."""
    return table({
        **MARKED,
        "verdict": VERDICT,
        "off_mm": told("how far off the student's own earlier marks ask for it; null where it is not seen",
                       _or_none(FROM_0)),
        "tolerance_mm": told("how far off a pencil may be there", _or_none(FROM_0)),
        "astray_mm": told("how far from the true drawing", _or_none(FROM_0)),
        "mistake": told("what was probably done", _or_none(TEXT)),
    })


def _first_wrong() -> Fragment:
    """The first wrong step."""
    return table({
        **MARKED, "sentence": told("the step in words", TEXT), "off_mm": _or_none(FROM_0),
        "tolerance_mm": _or_none(FROM_0), "mistake": _or_none(TEXT),
        "kind": told("the kind of mistake", _or_none(TEXT)),
        "guilty": told("the earlier step, not to be seen itself, that is probably to blame", _or_none(table(MARKED))),
    })


def _quantity() -> Fragment:
    """One number of the result table, in the scene's units."""
    return table({
        "kind": TEXT, "of": TEXT, "value": listed(NUMBER), "unit": told("as it was written", TEXT),
        "verdict": VERDICT, "true": listed(NUMBER), "off": _or_none(FROM_0), "tolerance": _or_none(FROM_0),
        "mistake": _or_none(TEXT),
    })


def _drawing() -> dict[str, Fragment]:
    """What is found of one drawing."""
    return {
        "title": TEXT,
        "drawing": told("the name of the file", TEXT),
        "first_wrong": told("null where no step is wrong", _or_none(_first_wrong())),
        "steps": listed(_judged()),
        "numbers": listed(_quantity()),
        "not_needed": told("marks that no step asks for", COUNT),
        "score": told("out of 100: in all, and by kind of step", _by_name(_or_none(PERCENT))),
        "counts": told("how many steps there are of each verdict", table(dict.fromkeys(STATES, COUNT))),
    }


def _class() -> dict[str, Fragment]:
    """What is found of a folder of drawings."""
    row = {"file": TEXT, "score": _or_none(PERCENT), "first_wrong": _or_none(STEP), "mistake": _or_none(TEXT)}
    return {
        "title": TEXT,
        "drawings": listed(table(row)),
        "not_judged": listed(table({"file": TEXT, "why": TEXT})),
        "mean_score": _or_none(PERCENT),
        "most_frequent_mistake": told("its kind", _or_none(TEXT)),
        "most_frequent_first_wrong": _or_none(STEP),
        "mistakes": told("how many drawings first go wrong by each kind of mistake", _by_name(COUNT)),
        "first_wrong_steps": listed(table({**MARKED, "drawings": COUNT})),
    }


def verify() -> Fragment:
    """What `graphplan verify --json` prints: of one drawing, or of a folder of them."""
    return {"$schema": DRAFT, "title": "graphplan verify", "oneOf": [table(_drawing()), table(_class())]}
