"""What the sheets of scenes measure: whether they can be read, measured with a ruler, and drawn by; and their marks.

`python tests/sheet/measured.py [-o FILE.md] [-v] [SCENE ...]` measures all packaged scenes, or those named, by what
`draw` and `steps` give; `--random N --seed K` measures the linkages of N seeds from K on. With -v each finding is told.
The table in the gallery is made by `python tests/sheet/measured.py -o gallery/charts/sheets.md`.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

sys.path += [str(Path(__file__).parents[1] / folder) for folder in ("shared", "worlds")]  # as a program

from face import Got, got, names, ran
from inked_sheet import InkedSheet, number, said
from speech import misspoken

import graphplan as gp

SAME = 1e-9  # of a line, beside its distance from the origin
MECHANISM = "mechanism"
LONG_ENOUGH, WIDE_ENOUGH = 60.0, 35.0  # mm of A4: of the mechanism, and of each plan's panel either way
POOR_RESULT, SMALL_IN_PANEL, SPARSE_INK = 0.1, 0.3, 0.4  # of a result its error; of a panel's longer way; of its area
WELL_DRAWN = 0.01  # of a result: what is off by less is not told
USUAL_PAPER = (5, 4), (8, 3), (13, 2), (np.inf, 1)  # links, the frame among them, and the A-size that they have
SLACK = 0.02  # of a bound: sizes of letters and of panels are written to a hundredth
FACT = re.compile(r"([^\s=,;]+(?: \([^)]*\)| at \w+)?) = [^=]*?(?=(?:[^\s=,;]+(?: \([^)]*\)| at \w+)?) = |$)")
LETTERS = {"velocity of ": "v", "acceleration of ": "a", "omega of link ": "ω", "alpha of link ": "α"}

Step = dict[str, Any]


@dataclass(frozen=True)
class DrawnScene:
    """A scene as it is drawn: on its sheet, and step by step; fails where `graphplan draw` does."""

    got: Got

    @cached_property
    def relative_errors(self) -> dict[str, float]:
        """By how much of its own size the pencil is off each result that is told, by its symbol, as the sheet has it: 1
        is all of it, and what is not told less than a hundredth. Those are left out of which the sheet says that they
        are shorter than a point of the pencil is off."""
        lines = [said(element) for page in self.pages for key, element in page.texts if key == "found"]
        errors = dict[str, float]()
        for line in lines:
            for fact in FACT.finditer(line):
                told = re.search(r"± (\S+) %", fact[0])
                if " = 0 " in f"{fact[0]} ":
                    continue  # of no size
                errors[fact[1]] = min(1.0, number(told[1].replace(">99", "100")) / 100) if told else WELL_DRAWN
        return {symbol: error for symbol, error in errors.items() if symbol not in self.too_short}

    @property
    def too_short(self) -> set[str]:
        """The symbols of the results that are drawn shorter than a point of the pencil is off."""
        remark = re.search(r"Shorter on paper than [^:]*: (.*?)\.(?=\s|$)", " ".join(self.got.protocol.split()))
        return {letter + label.removeprefix(words) for label in (remark[1].split(", ") if remark else ())
                for words, letter in LETTERS.items() if label.startswith(words)}

    @property
    def poor_results(self) -> list[str]:
        """The results that are not drawn to a tenth of themselves."""
        return [symbol for symbol, error in self.relative_errors.items() if error >= POOR_RESULT]

    @property
    def sizes_too_large(self) -> int:
        """By how many sizes the paper is larger than that for so many links."""
        usual = next(size for links, size in USUAL_PAPER if len(self.got.scene.links) <= links)
        return max(0, usual - int(self.got.steps["pencil"]["paper"][1]))

    @property
    def mechanism_in_panel(self) -> float:
        """How much of the longer way of its panel the mechanism takes, wheels and all; all of it where it is a point.
        """
        size, (low_x, low_y, high_x, high_y) = size_of_mechanism(self.sheet), self.sheet.panels[MECHANISM].bounds
        return size / max(high_x - low_x, high_y - low_y) if size else 1.0

    @property
    def mark(self) -> float:
        """A mark from 1 to 5, by what can be measured of what a teacher sees."""
        sheet, results = self.sheet, max(1, len(self.relative_errors))
        illegible = sheet.labels_on_labels, sheet.lines_through_labels, sheet.labels_nearer_to_others
        lost = (1.5 * len(self.poor_results) / results, 0.5 * (1.0 in self.relative_errors.values()),
                0.75 * self.sizes_too_large, 0.5 * bool(sheet.cut_lines),
                0.5 * (self.mechanism_in_panel < SMALL_IN_PANEL),
                0.5 * (sheet.ink_of_panels < SPARSE_INK), min(0.5, 0.1 * len(sheet.marks_too_near)),
                0.25 * bool(sheet.facts_in_pieces), 1.0 * any(illegible))
        return max(1.0, round(5.0 - sum(lost), 1))

    @property
    def pages(self) -> list[InkedSheet]:
        """The pages of the sheet."""
        return self.got.sheets()

    @property
    def sheet(self) -> InkedSheet:
        """The first page, with the plans."""
        return self.got.sheet

    @property
    def steps(self) -> list[Step]:
        """The list of steps."""
        return list(self.got.steps["steps"])

    @property
    def task_on_a4(self) -> bool:
        """Whether a student can draw on A4: the mechanism, wheels and all, is long enough, and no plan is a mere strip.
        """
        if ran("draw", self.got.name, "--paper", "A4").status:
            return False
        sheet = self.got.sheets("--paper", "A4")[0]
        sides = [side for low_x, low_y, high_x, high_y in (panel.bounds for panel in sheet.panels.values())
                 for side in (high_x - low_x, high_y - low_y)]
        return size_of_mechanism(sheet) >= LONG_ENOUGH - SLACK and min(sides) >= WIDE_ENOUGH - SLACK


def size_of_mechanism(sheet: InkedSheet) -> float:
    """The longer way of the mechanism on paper, in mm: its links, wheels and pins, without the ground."""
    lines = [stroke.line for stroke in sheet.strokes if stroke.key in ("layer-links", "layer-wheels", "layer-plates",
                                                                               "layer-machine")
             and sheet.panels[MECHANISM].intersects(stroke.line)]
    low_x, low_y, high_x, high_y = shapely.union_all([*lines, *sheet.pins]).bounds
    return float(max(high_x - low_x, high_y - low_y))


# ---- the list of steps -----------------------------------------------------------------------------------------------


def without_reason(steps: Iterable[Step]) -> list[int]:
    """The numbers of the steps that neither say why they are drawn nor stand in a stage."""
    return [step["number"] for step in steps if step["number"] and not step["why"] and step.get("stage") is None]


def drawn_twice(steps: Iterable[Step]) -> list[int]:
    """The numbers of the steps that draw a line where one of the same plan lies already."""
    found, lying = list[int](), dict[str, list[NDArray[np.float64]]]()
    for step in steps:
        if step["kind"] != "line" or not step["number"]:
            continue
        line = np.array(step["value"], float) / np.hypot(*step["value"][:2])
        before = lying.setdefault(step["plan"], [])
        if any(min(np.abs(line - old).max(), np.abs(line + old).max()) <= SAME * (1 + abs(line[2])) for old in before):
            found.append(step["number"])
        before.append(line)
    return found


# ---- what must hold --------------------------------------------------------------------------------------------------

Findings = Sequence[object]


@dataclass(frozen=True)
class Measure:
    """What is measured of a drawn scene, and between which bounds it must lie: findings are counted.

    Of a `typical` one that is asked of the median over all scenes, of any other of each scene.
    """

    head: str
    of: Callable[[DrawnScene], Findings | float]
    least: float = -np.inf
    most: float = np.inf
    form: str = ".0f"
    typical: bool = False

    def holds(self, value: Findings | float) -> bool:
        """Whether a value lies between the bounds."""
        return self.least - SLACK <= counted(value) <= self.most + SLACK

    def told(self, value: Findings | float) -> str:
        """A value in words."""
        return format(counted(value), self.form)

    @property
    def must(self) -> str:
        """The bound in words."""
        bounds = [f"{sign} {self.told(bound)}" for sign, bound in (("≥", self.least), ("≤", self.most))
                  if np.isfinite(bound)]
        return ", ".join(bounds) or "-"


MEASURES = (
    Measure("labels on labels", lambda one: one.sheet.labels_on_labels, most=0),
    Measure("lines through labels", lambda one: one.sheet.lines_through_labels, most=0),
    Measure("labels nearer to others", lambda one: one.sheet.labels_nearer_to_others, most=0),
    Measure("leaders too long", lambda one: one.sheet.long_leaders, most=0),
    Measure("smallest letters mm", lambda one: min(page.smallest_letters for page in one.pages), least=1.8, form=".2f"),
    Measure("smallest subscripts mm", lambda one: min(page.smallest_subscripts for page in one.pages), least=1.8,
            form=".2f"),
    Measure("vectors too short", lambda one: one.sheet.short_vectors, most=0),
    Measure("vectors on vectors mm", lambda one: one.sheet.vectors_on_vectors),
    Measure("vectors on links mm", lambda one: one.sheet.vectors_on_links),
    Measure("marks too near", lambda one: one.sheet.marks_too_near),
    Measure("plans of page", lambda one: one.sheet.plans_of_page, least=0.6, form=".0%", typical=True),
    Measure("ink of panels", lambda one: one.sheet.ink_of_panels, least=0.4, form=".0%", typical=True),
    Measure("odd scales", lambda one: one.sheet.odd_scales, most=0),
    Measure("lengths spoken wrong", lambda one: misspoken(one.got.steps), most=0),
    Measure("steps without a reason", lambda one: without_reason(one.steps), most=0),
    Measure("lines drawn twice", lambda one: drawn_twice(one.steps), most=0),
    Measure("results off by a tenth", lambda one: one.poor_results),
    Measure("median error", lambda one: median(one.relative_errors.values() or [0.0]), most=0.1, form=".1%",
            typical=True),
    Measure("sizes too large", lambda one: one.sizes_too_large),
    Measure("lines cut off", lambda one: one.sheet.cut_lines),
    Measure("mechanism in panel", lambda one: one.mechanism_in_panel, least=0.4, form=".0%", typical=True),
    Measure("mark", lambda one: one.mark, least=4.0, form=".1f", typical=True),
    Measure("task on A4", lambda one: float(one.task_on_a4), least=1),
)

Row = dict[str, Findings | float]


def counted(value: Findings | float) -> float:
    """A value as a number: findings by their count."""
    return float(len(value)) if isinstance(value, Sequence) else float(value)


def row(one: DrawnScene) -> Row:
    """What a drawn scene measures, by the heads of the measures."""
    return {measure.head: measure.of(one) for measure in MEASURES}


def cells(name: str, values: Row) -> tuple[str, ...]:
    """A row in words."""
    return (name, *(measure.told(values[measure.head]) for measure in MEASURES))


def held(measure: Measure, rows: Iterable[Row]) -> str:
    """The median of a measure where that counts, else in how many scenes it holds."""
    values = [row[measure.head] for row in rows]
    if measure.typical:
        return measure.told(median(map(counted, values)))
    return f"{sum(map(measure.holds, values))} of {len(values)}" if measure.must != "-" else "-"


def table(rows: dict[str, Row]) -> str:
    """The rows of scenes in Markdown, with what must hold and in how many scenes it does."""
    heads = ("scene", *(measure.head for measure in MEASURES))
    ends = [("must be", *(measure.must for measure in MEASURES)),
            ("is", *(held(measure, rows.values()) for measure in MEASURES))]
    lines = [heads, ("---", *("--:" for _ in MEASURES)), *(cells(name, row) for name, row in rows.items()), *ends]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def findings(rows: dict[str, Row]) -> Iterator[str]:
    """Every finding of every scene, a line for each scene and measure."""
    for name, row in rows.items():
        yield from (f"{name}: {head}: {', '.join(map(str, value))}" for head, value in row.items()
                    if isinstance(value, Sequence) and value)


# ---- scenes ----------------------------------------------------------------------------------------------------------


def random_scenes(count: int, seed: int) -> Iterator[tuple[str, gp.Scene]]:
    """The linkages of so many seeds, every other one under load where a balance holds it."""
    from linkages import scenes
    from loads import loaded_scenes

    for k in range(seed, seed + count):
        loaded = next(loaded_scenes(k, orders=1), None) if k % 2 else None
        yield f"random {k}", loaded or next(scenes(k, orders=1))


def measured(scenes: Iterable[tuple[str, Got]]) -> Iterator[tuple[str, Row]]:
    """The rows of those scenes that can be drawn; what is wrong with the others goes to standard error."""
    for name, one in scenes:
        if (done := ran("draw", one.name, "-q")).status:
            print(f"{name}: {done.err.strip()}", file=sys.stderr)
        else:
            yield name, row(DrawnScene(one))


def measured_at_random(count: int, seed: int) -> Iterator[tuple[str, Row]]:
    """The rows of random linkages."""
    with TemporaryDirectory() as folder:
        for name, scene in random_scenes(count, seed):
            path = Path(folder, f"{name}.toml")
            path.write_text(scene.text, encoding="utf-8")
            yield from measured([(name, Got(path))])


def main() -> None:
    """Measure the scenes asked for, or all."""
    parser = argparse.ArgumentParser(description="Measure the sheets of scenes.")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("-o", dest="file", type=Path, help="write the table here")
    parser.add_argument("-v", dest="told", action="store_true", help="tell each finding")
    parser.add_argument("--random", type=int, metavar="N", help="so many random linkages instead of scenes")
    parser.add_argument("--seed", type=int, default=0, metavar="K", help="the seed of the first of them")
    asked = parser.parse_args()
    rows = dict(measured_at_random(asked.random, asked.seed) if asked.random
                else measured((name, got(name)) for name in asked.scenes or names()))
    text = table(rows)
    if asked.file:
        asked.file.write_text(text)
    else:
        print(text, end="")
    if asked.told:
        print("\n".join(["", *findings(rows)]))


if __name__ == "__main__":
    main()
