"""Verify the answers to a rotor's task: each number by the true one, as far as a pencil allows."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphplan.commands.choices import pencil
from graphplan.commands.output import as_json, write
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.machine.rotors.rotor_balance import Answer
    from graphplan.marking.answers import AnswerVerdict, Expected
    from graphplan.output.subjects.rotor_sheet import RotorSheet


def of_rotor(options: argparse.Namespace, text: str) -> int:
    """Judge the answers to the task of a rotor."""
    from graphplan.check.rotors import check_rotor
    from graphplan.machine.rotors.rotor import parse
    from graphplan.machine.rotors.rotor_balance import balanced
    from graphplan.output.subjects.rotor_sheet import one_sheet

    found = balanced(parse(text, options.scene))
    sheet = one_sheet(found, check_rotor(found), pencil(options))
    return _judge(options, [_expected(sheet, answer) for answer in found.answers], found.task.sheet.language)


def _judge(options: argparse.Namespace, choices: Sequence[Sequence[Expected]], language: str) -> int:
    """Judge a table of answers, or each in a folder, by the nearest of the choices, and print the verdicts."""
    from graphplan.words.tongue import tongue

    if options.report:
        raise Refused(f"--report {options.report}", "there is no report of answers", "--json")
    path = Path(options.drawing)
    files = sorted(path.glob("*.csv")) if path.is_dir() else [path]
    if not files:
        raise Refused(f"{path}", "it contains no table of answers", "files that end in .csv")
    verdicts = {file.name: _judged(choices, file) for file in files}
    if options.json:
        write(as_json([_record(name, each) for name, each in verdicts.items()] if path.is_dir() else
                      _record(path.name, verdicts[path.name]), rows=True))
        return 0
    say, lines = tongue(options.language or language), []
    for name, each in verdicts.items():
        lines += [name] if path.is_dir() else []
        lines += [str(say(one.told)) for one in each]
    write("".join(f"{line}\n" for line in lines))
    return 0


def _judged(choices: Sequence[Sequence[Expected]], path: Path) -> list[AnswerVerdict]:
    """The verdicts on one table, by the choice that it is nearest to."""
    from graphplan.marking.answers import judged, right
    from graphplan.marking.tables.reader import read_answers

    answers = read_answers(path)
    for given in answers:
        if not any(one.matches(given) for one in choices[0]):
            known = ", ".join(f"{one.quantity},{one.of}" for one in choices[0])
            raise Refused(given.where, f"{given.quantity!r} of {given.of!r} is not asked for", f"one of {known}")
    try:
        return max((judged(choice, answers) for choice in choices), key=right)
    except ValueError as error:
        raise Refused(f"{path}", str(error), f"a unit such as {choices[0][0].written}") from None


def _expected(sheet: RotorSheet, answer: Answer) -> list[Expected]:
    """The true numbers of a rotor: corrections plane by plane, the static unbalance and the moment about plane I."""
    from graphplan.marking.answers import Expected
    from graphplan.mechanism.units import Dimension

    task, sums, found = sheet.balanced.task, sheet.balanced.sums, list[Expected]()
    mass, length, kg_m, metres = task.units.mass, task.units.length, float(task.kg_m), float(task.metres)
    unbalance, moment = Dimension(0, 2, 1, "U", "kg*m"), Dimension(1, 2, 1, "U", "kg*m^2")
    for one, error in zip(answer, sheet.errors, strict=True):
        found.append(Expected("correction", one.letter, one.mass_radius * kg_m, 2 * error.mass_radius * kg_m,
                              f"{mass}·{length}", kg_m, unbalance))
        if one.mass_radius:
            found.append(Expected("angle", one.letter, one.angle, 2 * error.angle, "°"))
    off = 2 * kg_m * sheet.errors[0].mass_radius  # the sum of m·r is drawn as well as what balances it
    found.append(Expected("static unbalance", "", sums.static * kg_m, off, f"{mass}·{length}", kg_m, unbalance))
    if task.rotor.dynamic:
        off = 2 * kg_m * metres * sheet.errors[1].mass_radius * float(task.rotor.between)
        found.append(Expected("moment", "", sums.dynamic * kg_m * metres, off, f"{mass}·{length}²", kg_m * metres,
                              moment))
    return found


def _record(name: str, verdicts: Sequence[AnswerVerdict]) -> dict[str, Any]:
    """The verdicts on one table as data."""
    from graphplan.marking.answers import right

    return {"name": name, "right": right(verdicts), "of": len(verdicts), "answers": [one.record for one in verdicts]}
