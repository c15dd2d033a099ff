"""Variants: scenes that differ in the numbers of the table [vary], and make equally good tasks on equal scales.

What the scene's own sheet has no better is no flaw of a variant, as far as it is not much worse there.

Of each number the values are drawn that are given out least, spread over its range, by a seed of which alone the draw
depends; no variant is given out twice, and none that is a scaled copy of another, before the grid of all values is
empty. A variant is kept whose sheet is without a flaw on the paper and at the scales of the class; these are the
scene's own, or where too few variants fit those, the largest that most of the first variants fit. Where all together
would reject half of them, each variant has scales of its own.
"""

from __future__ import annotations

import json
import math
import tomllib
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import product
from random import Random
from typing import Any, ClassVar, NamedTuple

import numpy as np

from graphplan.accuracy.drafted import Drafted
from graphplan.errors import ConstructionError, GraphplanError, Refused, SceneError, SingularPose
from graphplan.kernel.numbers import Floats
from graphplan.marking.classroom import measures
from graphplan.marking.tolerances import SCALE_STEP
from graphplan.mechanism.model import Scene
from graphplan.mechanism.numbers import decimal
from graphplan.mechanism.scene import parse
from graphplan.mechanism.scene_text import (
    Choices,
    Tables,
    decimal_text,
    edit_text,
    path_parts,
    with_keys,
    with_numbers,
    without_table,
)
from graphplan.methods.construction import Construction
from graphplan.methods.executors import SharedOut
from graphplan.phrases import said
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.paper import unit_lengths
from graphplan.sheet.layout.scales import Scales, round_up
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.words.tongue import Tongue

Draw = Callable[[Scene], Drafted]  # a scene on its sheet without pages of words, as the options say
Shape = tuple[float, ...]


class Flaw(NamedTuple):
    """A flaw: its kind, which many variants share, and its text for this one."""

    kind: str
    text: str


class DrawnSize(NamedTuple):
    """The mm of a vector, or between two points that give a direction, and the least that it should have."""

    mm: float
    least: float


@dataclass(frozen=True)
class Quality:
    """Measures of a sheet: the shortest of its vectors, and of the spans of its directions, by name; steps outside the
    paper; the part of letters without a good place; whether it is legible; the flattest crossing in degrees; the result
    with the largest error of a careful hand, and that error as a part of the largest; defects of a mechanism that is
    found."""

    sizes: Mapping[str, DrawnSize]
    outside: tuple[int, ...]
    poor: float
    legible: bool
    flattest: float
    worst: str = ""
    error: float = 0.0
    defects: tuple[str, ...] = ()

    @classmethod
    def of_sheet(cls, drafted: Drafted) -> Quality:
        """The quality of a sheet."""
        composition, cost = drafted.composition, drafted.cost
        sizes = dict(sorted(drawn_sizes(composition), key=lambda named: -named[1].mm / named[1].least))
        return cls(sizes, cost.off_sheet, composition.poor, composition.legible,
                   cost.flattest.degrees if cost.flattest else measures.SQUARE_DEGREES,
                   drafted.worst.label if drafted.worst else "", drafted.error)

    @property
    def short(self) -> dict[str, DrawnSize]:
        """Objects that are smaller than they should be, by name."""
        return {name: size for name, size in self.sizes.items() if size.mm < size.least}

    def find_flaw(self, own: Quality) -> Flaw | None:
        """Flaw by which it is worse than a class's sheet may be; `own` is the quality of the scene's own sheet."""
        if defects := [defect for defect in self.defects if defect not in own.defects]:
            return Flaw("its mechanism has a defect", f"it has a defect: {', '.join(defects)}")
        if self.flattest < min(measures.MIN_CROSSING_DEGREES, own.flattest / measures.MAX_WORSE_RATIO):
            return Flaw("it is nearly singular", f"lines cross at {self.flattest:.0f}°")
        for name, size in self.short.items():
            if name not in own.short or size.mm < own.short[name].mm / measures.MAX_WORSE_RATIO:
                return Flaw("vectors are too short", f"{name} has {size.mm:.2f} mm, less than {size.least:g}")
        if len(self.outside) > len(own.outside):
            return Flaw("steps are outside the paper", f"step {self.outside[0]} is outside the paper")
        if self.error > max(measures.MAX_ERROR_SHARE, measures.MAX_WORSE_RATIO * own.error):
            off = f"by {100 * self.error:.0f} %" if math.isfinite(self.error) else "without bound"
            return Flaw("its expected drawing error is too large", f"a careful hand is off {off} in {self.worst}")
        most_poor = max(measures.MAX_POOR_SHARE, measures.MAX_WORSE_RATIO * own.poor)
        if (own.legible and not self.legible) or self.poor > most_poor:
            return Flaw("the sheet is crowded", f"the sheet is crowded, {100 * self.poor:.0f} % of its letters have no "
                        "good place")
        return None


def drawn_sizes(composition: Composition) -> Iterator[tuple[str, DrawnSize]]:
    """All vectors of a sheet with their sizes there, asked for or not, and what each line through two points has for
    its direction."""
    plans, drawing = composition.plans, composition.plans.drawing
    program, places = drawing.drawn, plans.plan_of_step
    results = {tuple(program.wanted[place] for place in reading.marks): f"{reading.kind} of {reading.of}"
               for reading in drawing.readings if not reading.kind.single and len(reading.marks) == 2}
    vectors: dict[tuple[int, ...], str] = {(vector.start, vector.end): f"{vector.label} in {vector.panel}"
                                           for vector in drawing.arrows if vector.label}
    for step in program.steps:
        if step.op.claim_operands("runs"):
            vectors.setdefault(step.args[:2], "the line " + " ".join(map(str, map(program.text, step.args[:2]))))
        elif step.root is not None and step.name:
            vectors.setdefault((step.root, step.index), f"{step.name} in {places[step.index]}")
    for (start, end), name in (vectors | results).items():
        if places[start] == places[end]:
            length = math.dist(plans.spot(start), plans.spot(end)) * composition.views[places[end]].scale
            yield name, DrawnSize(length, measures.MIN_ASKED_MM if (start, end) in results else measures.MIN_DRAWN_MM)


@dataclass(frozen=True)
class FitVariant:
    """A variant without a flaw: how large its other plans are, and the `shape` of what is drawn, which its scaled
    copies have too; empty where that is not told."""

    multiples: Mapping[str, Fraction] = field(default_factory=dict)
    shape: Shape = ()


def assess(text: str, name: str, draw: Draw, own: Quality) -> Flaw | FitVariant:
    """Why a scene is no task for the class whose own scene has a sheet of this quality, or how it fits it."""
    try:
        sheet = draw(parse(text, name))
        return Quality.of_sheet(sheet).find_flaw(own) or FitVariant(sheet.composition.scales.multiples,
                                                                    drawn_shape(sheet.drawing))
    except SceneError as error:
        return Flaw("it cannot be assembled", f"{error.faults[0].where}: {error.faults[0].what}")
    except (SingularPose, ConstructionError) as error:
        return Flaw("it is singular", f"{error}".partition(";")[0])
    except Refused as error:
        return Flaw("it does not fit the scales of the class", f"{error.what}: {error.why}")
    except GraphplanError as error:
        return Flaw("it cannot be drawn", f"{error}")


def drawn_shape(drawing: Construction) -> Shape:
    """The points of a mechanism and its results, each kind relative to its largest number: a scaled copy has the same.
    """
    places = np.array([drawing.scene.points[name] for name in sorted(drawing.scene.points)], float)
    kinds = [places - places[:1], *(np.array([named[name] for name in sorted(named)], float)
                                    for named in drawing.read(Floats()).values() if named)]
    largest = [kind.flat[np.abs(kind).argmax()] for kind in kinds]
    least = ZERO_TOL * max(map(abs, largest))
    numbers = [kind / size if abs(size) > least else 0.0 * kind for kind, size in zip(kinds, largest, strict=True)]
    return tuple(number for kind in numbers for number in np.round(kind, measures.SHAPE_DECIMALS).ravel().tolist())


Values = Mapping[str, Fraction]  # by the paths of the numbers
Keys = Mapping[str, str]  # of [sheet], as TOML
Progress = Callable[[int, int], None]  # how many are done, of how many
COORDINATE_NAMES = {"0": "x", "1": "y", "2": "phi"}  # of a point or a position, by their places
PLACES = frozenset({"points", "positions", "moving", "fixed", "pivot", "circle", "through", "gravity"})  # have such


@dataclass(frozen=True)
class ClassVariant:
    """A scene of the class: its number, what was drawn for it, and its text."""

    number: int
    values: Values
    text: str

    @property
    def named_values(self) -> dict[str, str]:
        """Drawn values, by readable names: `A x` for `points.A.0`."""
        return {_path_words(path): decimal_text(value) for path, value in self.values.items()}


@dataclass(frozen=True)
class VariantSeries:
    """The variants of a class, with what was drawn anew on the way: each draw with its flaw."""

    variants: tuple[ClassVariant, ...]
    drawn_anew: tuple[tuple[int, Values, Flaw], ...]
    repeated: int  # variants whose numbers another has, too
    copies: int  # variants that are scaled copies of another
    remark: str  # on their scales, if they have no common ones
    short: Mapping[str, DrawnSize]  # what is too short on the scene's own sheet, and may be so on theirs

    @property
    def lines(self) -> Iterator[str]:
        """Yield the remarks on the drawing of variants."""
        kinds = Counter(flaw.kind for _, _, flaw in self.drawn_anew)
        for kind, count in kinds.most_common():
            number, values, flaw = next(draw for draw in self.drawn_anew if draw[2].kind == kind)
            yield f"drawn anew {count} times, as {kind}: such as variant {number}: {values_text(values)}: {flaw.text}"
        if self.short:
            sizes = ", ".join(f"{name} has {size.mm:.1f} mm" for name, size in self.short.items())
            yield f"too short on the scene's own sheet, and allowed to be so on others: {sizes}"
        if self.remark:
            yield self.remark
        if self.copies:
            yield (f"[vary] has too few values: {self.copies} variants are scaled copies of others; "
                   "let an angle or a length vary more")
        if self.repeated:
            yield f"[vary] has too few good values: {self.repeated} variants have the numbers of another"


def _path_words(path: str) -> str:
    """The number at a path: a coordinate by its point, else what it is of, of things in a list counted from 1."""
    table, *keys = path.split(".")
    words = [str(int(key) + 1) if key.isdigit() else key for key in keys]
    if not PLACES.isdisjoint((table, *keys)):
        words[-1] = COORDINATE_NAMES.get(keys[-1], keys[-1])
    return " ".join(words if table == "points" else (table, *words))


def values_text(values: Values) -> str:
    """Drawn values, by their paths in the scene."""
    return ", ".join(f"{path} = {decimal_text(value)}" for path, value in values.items())


class Draws:
    """Draws of values without repetition, until the grid is empty: of each number that value which is kept least, then
    drawn least, then the next of a walk that spreads over the range from its first steps on.

    Source: the walks are those of M. Roberts, The unreasonable effectiveness of quasirandom sequences (2018).
    """

    def __init__(self, choices: Choices, seed: int):
        self.choices = choices
        self.count = math.prod(map(len, choices.values()))
        self._drawn_places = set[tuple[int, ...]]()
        self._kept = {path: Counter[Fraction]() for path in choices}
        self._drawn = {path: Counter[Fraction]() for path in choices}
        random = Random(seed).random  # of which Python promises the same numbers for ever
        golden = 1.0  # the root of x^(n + 1) = x + 1, for n numbers: the golden ratio for one
        for _ in range(measures.GOLDEN_ITERATIONS):
            golden = (1.0 + golden) ** (1.0 / (len(choices) + 1))
        self._walks = {path: _walk(len(values), random(), golden**-power)
                       for power, (path, values) in enumerate(choices.items(), 1)}

    def next_values(self, count: int) -> list[Values]:
        """So many draws, or as many as the grid still has."""
        return [self._draw_values() for _ in range(min(count, self.count - len(self._drawn_places)))]

    def _draw_values(self) -> Values:
        places = next(places for places in product(*map(self._ordered_places, self.choices))
                      if places not in self._drawn_places)
        self._drawn_places.add(places)
        values = {path: values[place] for (path, values), place in zip(self.choices.items(), places, strict=True)}
        for path, value in values.items():
            self._drawn[path][value] += 1
        return values

    def _ordered_places(self, path: str) -> list[int]:
        """The places of a number's values, the next first; a value that is often rejected counts as given out."""
        values, uses, draws = self.choices[path], self._kept[path], self._drawn[path]

        def rank(place: int) -> tuple[int, int]:
            value = values[place]
            return uses[value] + (draws[value] - uses[value]) // measures.REJECTIONS_PER_USE, draws[value]

        return sorted(self._walks[path], key=rank)

    @property
    def is_empty(self) -> bool:
        """Whether all values of the grid are drawn."""
        return len(self._drawn_places) == self.count

    def keep(self, values: Values) -> None:
        """Note values as given out."""
        for path, value in values.items():
            self._kept[path][value] += 1


def _walk(count: int, start: float, share: float) -> list[int]:
    """The places of so many values in the order in which steps of a share of the range come to them from a start."""
    turns = (start + share * np.arange(count)) % 1.0
    order: list[int] = np.argsort(np.argsort(turns)).tolist()
    return order


@dataclass(frozen=True)
class Wording:
    """Wording of a class's scenes: the text, their title, their common keys of [sheet], their language, and a remark on
    their scales, if they have no common ones."""

    text: str
    title: str
    keys: Keys
    tongue: Tongue
    remark: str = ""

    def variant(self, number: int, values: Values) -> ClassVariant:
        """The scene with these numbers, as a teacher would write it: without [vary], its comments kept."""
        title = self.tongue(said("{0}, variant {1}", self.title, number) if self.title else said("Variant {0}", number))

        def edit(text: str) -> str:
            text = without_table(with_numbers(text, values), "vary")
            return with_keys(with_keys(text, "sheet", self.keys), "", {"title": json.dumps(title, ensure_ascii=False)})

        def edit_tables(tables: Tables) -> None:
            for path, value in values.items():
                _set_path(tables, path_parts(path), value)
            tables.pop("vary", None)
            tables["title"] = title
            sheet_table = tomllib.loads("\n".join(f"{key} = {value}" for key, value in self.keys.items()),
                                        parse_float=decimal)
            tables["sheet"] = tables.get("sheet", {}) | sheet_table

        return ClassVariant(number, values, edit_text(self.text, edit, edit_tables))


def _set_path(tables: Any, path: Sequence[str], value: Fraction) -> None:
    for key in path[:-1]:
        tables = tables[int(key) if isinstance(tables, list) else key]
    tables[int(path[-1]) if isinstance(tables, list) else path[-1]] = value


def sheet_keys(scene: Scene, scales: Scales | None, paper: str, *, multiples: bool = True) -> Keys:
    """Keys of [sheet] that give this paper and these scales, if there are any; existing ones are left out."""
    sheet = scene.sheet
    keys = {"paper": json.dumps(paper), "language": json.dumps(sheet.language)}
    if scales is None:
        return keys
    rates = bool(scene.drives or scene.motions)
    keys |= {} if sheet.k_s else {"k_s": _short_decimal(scales.k_s)}
    keys |= {} if sheet.k_v or not rates else {"k_v": _short_decimal(scales.k_s / scales.kappa)}
    keys |= {} if sheet.k_F or not scene.loads else {"k_F": _short_decimal(scales.k_s / scales.phi)}
    if multiples and scales.multiples and not sheet.multiples:
        plans = {panel.whole.twin: multiple for panel, multiple in scales.multiples.items()}  # type: ignore[attr-defined]
        entries = ", ".join(f"{json.dumps(str(plan))} = {_short_decimal(multiple)}" for plan, multiple in plans.items())
        keys["multiples"] = f"{{ {entries} }}"
    return keys


def _short_decimal(value: Fraction | float) -> str:
    return decimal_text(Fraction(f"{float(value):.12g}"))


class SeriesDesign(ABC):
    """Choice of the variants of a class, for any `source`: a scene or a task with its name and its table [vary], on a
    sheet of `own_quality`. `find_flaw` gives the flaw of a variant's text, or what is no flaw."""

    find_flaw: ClassVar[Callable[..., Any]]
    draw: Callable[[Any], Any]
    shared_out: SharedOut

    @property
    @abstractmethod
    def source(self) -> Any:
        """Source of the variants."""

    @property
    @abstractmethod
    def own_quality(self) -> Quality:
        """The quality of its own sheet."""

    @abstractmethod
    def common_wording(self, pilots: Sequence[Values], number: int) -> tuple[Wording, Sequence[Any]]:
        """Wording of all, so that enough of the first ones may be good, and what was found for these as variants of
        that number, if anything."""

    def assess(self, wording: Wording, number: int, variants: Iterable[Values]) -> Iterable[Any]:
        """The flaw of each variant, which has this number in its title, or whatever is no flaw."""
        return self.shared_out(partial(self.find_flaw, name=self.source.name, draw=self.draw, own=self.own_quality),
                               (wording.variant(number, values).text for values in variants))

    def series(self, count: int, seed: int, progress: Progress) -> VariantSeries:
        """So many variants, no two alike, and no scaled copies, before all others of the grid are given out; fails with
        `Refused` where hardly any that is drawn is without a flaw."""
        choices = self.source.vary
        pilots = Draws(choices, seed).next_values(min(measures.PILOT_VARIANTS, count + 2))
        wording, known = self.common_wording(pilots, count)
        draws, shapes = Draws(choices, seed), set[Shape]()
        good_values, copies, drawn_anew = list[Values](), list[Values](), list[tuple[int, Values, Flaw]]()
        while (missing := count - len(good_values)) and (batch := draws.next_values(missing)):
            outcomes = [*known[:len(batch)], *self.assess(wording, count, batch[len(known):])]
            known = ()  # the first draws are the pilots'
            for values, outcome in zip(batch, outcomes, strict=True):
                if isinstance(outcome, Flaw):
                    drawn_anew.append((len(good_values) + 1, values, outcome))
                elif outcome.shape and outcome.shape in shapes:
                    copies.append(values)
                else:
                    shapes.add(outcome.shape)
                    draws.keep(values)
                    good_values.append(values)
                progress(len(good_values), count)
            are_copies_alone = missing == count - len(good_values) and len(copies) >= missing
            if are_copies_alone or (
                    len(drawn_anew) > measures.MIN_DRAWS + measures.DRAWS_PER_VARIANT * len(good_values)):
                break
        given_out = (good_values + copies)[:count]
        if len(given_out) < count and not (given_out and draws.is_empty):
            raise self._too_wide(wording, count, good_values, drawn_anew)
        variants = (wording.variant(number, given_out[(number - 1) % len(given_out)])
                    for number in range(1, count + 1))
        return VariantSeries(tuple(variants), tuple(drawn_anew), count - len(given_out),
                             len(given_out) - len(good_values), wording.remark, self.own_quality.short)

    def _too_wide(self, wording: Wording, count: int, good_values: Sequence[Values],
                  drawn_anew: Sequence[tuple[int, Values, Flaw]]) -> Refused:
        """The refusal of ranges in which too little is good: of one whose end is not, with all else as it is written.
        """
        few = f"of {len(good_values) + len(drawn_anew)} variants drawn {len(good_values)} are good, {count} are wanted"
        ends = [{path: values[end]} for path, values in self.source.vary.items() for end in (0, -1)]
        for values, wrong in zip(ends, self.assess(wording, count, ends), strict=True):
            if isinstance(wrong, Flaw):
                (path, value), = values.items()
                return Refused(f'{self.source.name}: vary."{path}"',
                               f"{few}; already at {decimal_text(value)} {wrong.text}",
                               "a narrower range, or a larger --paper")
        kind = Counter(wrong.kind for _, _, wrong in drawn_anew).most_common(1)[0][0]
        return Refused(f"{self.source.name}: vary", f"{few}; mostly {kind}", "narrower ranges, or a larger --paper")


def _count_good(outcomes: Iterable[Any]) -> int:
    """How many variants have no flaw."""
    return sum(not isinstance(outcome, Flaw) for outcome in outcomes)


@dataclass(frozen=True)
class SceneDesign(SeriesDesign):
    """The scene of a class on its own sheet, and how variants of it are drawn."""

    drafted: Drafted
    draw: Draw
    shared_out: SharedOut
    find_flaw = staticmethod(assess)

    @property
    def scene(self) -> Scene:
        """The scene, in the language of the class."""
        return self.drafted.drawing.scene

    source = scene

    def common_wording(self, pilots: Sequence[Values], number: int) -> tuple[Wording, Sequence[Any]]:
        """The class's paper and scales; or its paper alone, where scales for all would reject half of the first
        variants, and scales of their own fewer."""
        common, found = self._common_scales(pilots, number)
        if 2 * _count_good(found) < len(pilots):
            free = self.wording(sheet_keys(self.scene, None, self.drafted.composition.arrangement.paper))
            found_so = [*self.assess(free, number, pilots)]
            good, good_so = _count_good(found), _count_good(found_so)
            if good_so > good:
                remark = (f"each has scales of its own: of {len(pilots)} variants {good_so} are good so, and {good} at "
                          "the same scales")
                return replace(free, remark=remark), found_so
        return common, found

    @property
    def own_quality(self) -> Quality:
        """The quality of the scene's own sheet."""
        return Quality.of_sheet(self.drafted)

    @property
    def tongue(self) -> Tongue:
        """The language of the class."""
        return self.drafted.composition.plans.tongue

    def wording(self, keys: Keys) -> Wording:
        """The scene's words with these keys in [sheet]."""
        return Wording(self.scene.text, self.scene.title, keys, self.tongue)

    def _common_scales(self, pilots: Sequence[Values], number: int) -> tuple[Wording, Sequence[Any]]:
        """The wording with the scales of the class, and what is found for the first variants: the first of some that
        enough fit, else what most fit."""
        tried = list[tuple[Wording, Sequence[Any]]]()
        for wording in map(self.wording, self._proposals(pilots, number)):
            if all(wording != earlier for earlier, _ in tried):
                tried.append((wording, [*self.assess(wording, number, pilots)]))
            if _count_good(tried[-1][1]) >= measures.MIN_FITTING_SHARE * len(pilots):
                break
        return max(tried, key=lambda one: _count_good(one[1]))

    def _proposals(self, pilots: Sequence[Values], number: int) -> Iterator[Keys]:
        """The scales of the scene's own sheet; then by how large the other plans of most good variants are drawn at its
        scale of lengths, and at the next coarser one."""
        composition, sheet = self.drafted.composition, self.scene.sheet
        scales_of_scene, paper = composition.scales, composition.arrangement.paper
        yield sheet_keys(self.scene, scales_of_scene, paper)
        lengths = unit_lengths(composition.plans, composition.plans.panels[0])
        coarser = round_up(scales_of_scene.k_s * (1 + SCALE_STEP), lengths)
        for k_s in dict.fromkeys((scales_of_scene.k_s,
                                  scales_of_scene.k_s if sheet.k_s or sheet.k_v or sheet.k_F else float(coarser))):
            scales = replace(scales_of_scene, k_s=k_s)
            free = self.wording(sheet_keys(self.scene, scales, paper, multiples=False))
            variant_multiples = [fit.multiples for fit in self.assess(free, number, pilots)
                                 if isinstance(fit, FitVariant)]
            plans = [plan
                     for plan in scales_of_scene.multiples if all(plan in multiples for multiples in variant_multiples)]
            ordered = {plan: sorted(multiples[plan] for multiples in variant_multiples)
                       for plan in plans if variant_multiples}
            fitted = [{plan: sizes[int(share * len(sizes))] for plan, sizes in ordered.items()}
                      for share in measures.SMALLER_SHARES]
            yield from (sheet_keys(self.scene, replace(scales, multiples=sizes), paper) for sizes in fitted if sizes)
