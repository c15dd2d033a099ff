"""What sentences say, held to what is printed: lengths to a ruler, sums and products to their own numbers.

Sentences are those of `graphplan steps SCENE --json` in English. A number holds within half a unit of its last digit.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import groupby, pairwise
from typing import Any

from inked_sheet import POWERS, number
from reader import Mark, Reader, laid

NUMBER = re.compile(r"−?\d+(?:\.\d+)?(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?")
LENGTH = re.compile(rf"(?<![\w.·−²/])({NUMBER.pattern}) mm(?![\w/²·]| [:·] )")  # not a value
# what stands before it is no part of an expression
CLAUSE = re.compile(r"(?<! ): |\.\) |; |, |(?<=[^\d]) = |\. ")
TOKEN = re.compile(rf"{NUMBER.pattern}|[()²/:·+−-]")
UNITS = re.compile(r"(?<=[\d)⁰¹²³⁴⁵⁶⁷⁸⁹]) (?:(?:mm|cm|m|in|ft|N|kN|kgf|lbf|kg|g|t|lb|rad|s|min)"
                   r"[²³]?(?:[/·](?:mm|cm|m|in|ft|s|min|kg)[²³]?)*)(?![\w.])")
COMPONENTS = re.compile(r"\(x (−?[\d.]+), y (−?[\d.]+) mm\)")
TENTHS = 0.051  # mm: of what is told in tenths
LETTER = re.compile(r"[^\W\d_⁰¹²³⁴⁵⁶⁷⁸⁹]")
LEAST = 0.01  # mm: what lies within it is one
LARGEST = 10.0
ENLARGED, SAME = "times as large", 1e-3  # of a factor: what differs by less is one
SIDES = {"A4": 297, "A3": 420, "A2": 594, "A1": 841, "A0": 1189}


def last_digit(text: str) -> float:
    """What one of the last printed digit is."""
    mantissa, _, power = text.partition("·10")
    return 10.0 ** (int(power.translate(POWERS) or 0) - len(mantissa.partition(".")[2]))


def value(expression: str) -> float:
    """What an expression of printed numbers comes to: · : / + −, squares and brackets."""
    tokens = TOKEN.findall(expression)
    if re.sub(r"\s", "", expression) != "".join(tokens):
        raise ValueError(f"no expression: {expression!r}")
    written = " ".join(repr(number(t)) if NUMBER.fullmatch(t) and t != "−" else
                       {"·": "*", ":": "/", "²": "**2", "−": "-"}.get(t, t) for t in tokens)
    return float(eval(written, {"__builtins__": {}}))


def sums(sentence: str) -> Iterator[tuple[str, str]]:
    """The expressions of a sentence that it says the value of, each with that value as printed."""
    bare = UNITS.sub("", sentence)
    parts = re.split(r" = ", bare)
    for left, right in pairwise(parts):
        expression = CLAUSE.split(LETTER.split(left)[-1])[-1].strip()
        printed = NUMBER.match(right)
        if printed and re.search(r"[·:/+−²] ?|²", expression[1:]) and not LETTER.search(expression):
            yield expression, printed.group()


def false_sums(sentence: str) -> Iterator[str]:
    """The sums of a sentence that do not hold as printed."""
    for expression, printed in sums(sentence):
        try:
            off = abs(value(expression) - number(printed))
        except (ValueError, SyntaxError, ZeroDivisionError) as fault:
            yield f"{expression} = {printed}: {fault}"
            continue
        if not off <= 0.5001 * last_digit(printed):
            yield f"{expression} = {value(expression):.6g}, told {printed}"


def factors(sentence: str) -> Iterator[float]:
    """By what lengths are multiplied to give lengths, as it is said."""
    for times in re.findall(rf" mm · ({NUMBER.pattern}) = {NUMBER.pattern} mm(?![\w/²·])", sentence):
        yield number(times)


def spoken_wrong(told: Mapping[str, Any], measure: Callable[[Sequence[int]], float], longest: float) -> Iterator[str]:
    """What is wrong in one entry of a protocol: `measure` is a ruler between marks, `longest` the side of the paper."""
    sentence = told.get("sentence") or told.get("said", "")
    if re.search(r"\b(nan|inf|NaN)\b|\(\)", sentence):
        yield f"no number: {sentence}"
    if re.search(r"\d [+−]\d", sentence):
        yield f"no blank behind a sign: {sentence}"
    lengths = [(length["mm"], measure(length["marks"])) for length in told["lengths"]]
    yield from (f"{mm:.4g} mm measures {found:.4g}: {sentence}" for mm, found in lengths if abs(mm - found) > LEAST)
    for text in LENGTH.findall(sentence):
        spoken = abs(number(text))
        measured = any(abs(spoken - mm) <= 0.501 * last_digit(text) + 1e-4 for pair in lengths for mm in pair)
        if lengths and not measured and all(text != printed for _, printed in sums(sentence)):
            yield f"{text} mm is none of its lengths: {sentence}"
        if spoken > longest:
            yield f"{text} mm is longer than the paper: {sentence}"
    yield from (f"{sum_}: {sentence}" for sum_ in false_sums(sentence))
    if "sentence" in told:  # in a reading it is a scale
        yield from (f"{factor:.4g} times as large: {sentence}" for factor in factors(sentence) if factor > LARGEST)


def components_wrong(told: Mapping[str, Any], marks: Sequence[Mark]) -> Iterator[str]:
    """The components of a vector of which a sentence speaks that are not those between its marks."""
    for parts in COMPONENTS.findall(told["sentence"]):
        start, end = (marks[mark] for mark in told["lengths"][-1]["marks"])
        if isinstance(start, complex) and isinstance(end, complex):
            vector = end - start
            off = [abs(number(part) - mm) for part, mm in zip(parts, (vector.real, vector.imag), strict=True)]
            if max(off) > TENTHS:
                yield f"the vector is {vector:.1f} mm: {told['sentence']}"


def reasoned_wrong(entries: Sequence[Mapping[str, Any]], steps: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """What is wrong in the order of entries and in their reasons: a stage in pieces, what is told twice, and factors
    between plans that none explains."""
    told = [stage for stage, _ in groupby(entry["stage"] for entry in entries) if stage is not None]
    yield from (f"stage {stage} is told in pieces" for stage in {*told} if told.count(stage) > 1)
    sentences = [entry["sentence"] for entry in entries]
    yield from (f"told twice: {sentence}" for sentence in {*sentences} if sentences.count(sentence) > 1)
    reasons = [reason for entry in entries for reason in entry["why"].split("; ") if ENLARGED in reason]
    yield from (f"told twice: {reason}" for reason in {*reasons} if reasons.count(reason) > 1)
    plans = {step["plan"] for step in steps
             if abs((step["factor"] or 1.0) - 1.0) > SAME and " mm · " in step["sentence"]}
    if entries and not reasons:
        yield from (f"no reason for the factor on the plan {plan}" for plan in plans)


READ = re.compile(rf"(?:=|the moment is) ({NUMBER.pattern})[^=]*; computed")


def misread(reading: Mapping[str, Any]) -> Iterator[str]:
    """What a reading says that is not its value."""
    printed = READ.search(reading["said"])
    if printed is None:
        yield f"nothing is read: {reading['said']}"
    elif not math.isclose(number(printed.group(1)), reading["value"], abs_tol=0.501 * last_digit(printed.group(1))):
        yield f"{reading['value']:.6g} is read: {reading['said']}"


def side(paper: str) -> float:
    """The longer side of a sheet in mm."""
    return float(SIDES[paper.split()[0]])


# ---- protocols as a whole --------------------------------------------------------------------------------------------


def faults(protocol: Mapping[str, Any], paper: str = "") -> list[str]:
    """All that is wrong in the data of a protocol: executed on paper, its sentences held to a ruler and to their own
    numbers; `paper` is the sheet where the data do not say it."""
    reader = Reader.of(protocol["steps"])
    longest = side(paper or protocol["pencil"]["paper"])
    by_set_squares = any(step["instrument"] == "set squares" for step in protocol["steps"])
    # by compasses alone the same arcs serve several stages, which then read each other
    reasons = reasoned_wrong(protocol["entries"], protocol["steps"]) if by_set_squares else ()
    return [*reader.faults, *_spoken(protocol, reader, longest), *reasons]


def _spoken(protocol: Mapping[str, Any], reader: Reader, longest: float) -> Iterator[str]:
    """What its sentences say wrong."""
    for told in (*protocol["steps"], *protocol["entries"]):
        yield from spoken_wrong(told, reader.measure, longest)
        yield from components_wrong(told, reader.marks)
    for reading in protocol["readings"]:
        yield from spoken_wrong(reading, reader.measure, longest)
        yield from misread(reading)


def misspoken(protocol: Mapping[str, Any]) -> list[str]:
    """What the sentences of a protocol say wrong, of marks that lie where it tells."""
    reader = Reader(protocol["steps"], [laid(step["paper"], step["kind"]) for step in protocol["steps"]])
    return [*_spoken(protocol, reader, side(protocol["pencil"]["paper"]))]
