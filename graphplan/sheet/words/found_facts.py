"""What a construction has found, as facts in the field's letters."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.units import Dimension
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ResultKind
from graphplan.methods.panels import JointForce, pole_letter, slide_named
from graphplan.phrases import Said, arrange, coordinates, digits, said, unit
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.sheet.words.facts import Fact, given_facts, point_place
from graphplan.sheet.words.lengths import magnitude
from graphplan.sheet.words.rows import Deviation, Deviations, largest_size

RESULTS = said("Found")
AS_FACTS = {  # the letter of each kind of vector and of each kind of number
    kinds.VELOCITY: "v", kinds.ACCELERATION: "a", kinds.SLIDE_VELOCITY: "v", kinds.SLIDE_ACCELERATION: "a",
    kinds.OMEGA: "omega", kinds.ALPHA: "alpha", kinds.SCREW: "M",
}  # fmt: skip


def found_facts(drawing: Construction, values: Mapping[str, Mapping[str, Any]],
                pencil: Deviations | None = None) -> tuple[Fact, ...]:
    """Every result that is asked for, vectors by size and direction; `values` are the readings by kind and name."""
    return tuple(_ResultFacts(drawing, values, pencil or Deviations()).facts())


def drawing_facts(drawing: Construction, values: Mapping[str, Mapping[str, Any]],
                  pencil: Deviations) -> tuple[tuple[Fact, ...], tuple[Fact, ...]]:
    """What is given of a drawing, and what it has found."""
    return given_facts(drawing.scene), found_facts(drawing, values, pencil)


@dataclass(frozen=True)
class _ResultFacts:
    """The results of a construction, as facts."""

    drawing: Construction
    values: Mapping[str, Mapping[str, Any]]
    pencil: Deviations

    @property
    def scene(self) -> Scene:
        return self.drawing.scene

    def facts(self) -> Iterator[Fact]:
        """Motion first, then places, then forces; what the scene gives is none of them."""
        prescribed = {(reading.kind, reading.of) for reading in self.drawing.readings if reading.given is not None}
        for name, results in self.values.items():
            kind = kinds.kind_of(name)
            for of, value in results.items():
                if (kind, of) in prescribed or self._is_superseded(kind, of) or self._is_of_its_point(kind, of):
                    continue
                if kind in AS_FACTS:
                    yield self._quantity(kind, of, self._motion_symbol(kind, of), value)
                elif kind in (kinds.POLE, kinds.POLE_HEADING, *kinds.PATHS):
                    yield from self._of_places(kind, of, value)
                elif kind in kinds.REACTIONS or kind in kinds.WITH_FRICTION.values():
                    if not kind.single:
                        yield self._quantity(kind, of, self._reaction_symbols[of], value)
                elif kind.way and self.scene.loads:
                    link = self.scene.loads.named_balances[of].link
                    yield self._quantity(kind, of, f"{'T' if kind.single else 'F'}_{link}", value)
        extreme = self.scene.assembly.extreme if self.scene.assembly else None
        if extreme and extreme.time_ratio:
            yield Fact(RESULTS, "K", digits(extreme.time_ratio), arrange(""))

    @cached_property
    def _largest(self) -> dict[Dimension, float]:
        """The size of the largest vector of each dimension, beside which rounding is nothing."""
        largest = dict[Dimension, float]()
        for name, results in self.values.items():
            kind = kinds.kind_of(name)
            if not kind.single:
                largest[kind.dimension] = max(largest.get(kind.dimension, 0.0), largest_size(results))
        return largest

    def _is_superseded(self, kind: ResultKind, of: str) -> bool:
        """Whether another kind says the same of the same thing, and better: with friction, and not by the lever."""
        if kind in kinds.WITH_FRICTION:
            return of in self.values.get(kinds.WITH_FRICTION[kind], {})
        ways = [kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER]
        return bool(kind.way) and any(
            of in self.values.get(better, {}) for better in kinds.KINDS.values()
            if better.way in ways[:ways.index(kind.way)] and better.single == kind.single)

    def _is_of_its_point(self, kind: ResultKind, of: str) -> bool:
        """Whether a slide moves along the frame, so that its point tells the same: v_P, not v (5 along frame)."""
        of_point = {kinds.SLIDE_VELOCITY: kinds.VELOCITY, kinds.SLIDE_ACCELERATION: kinds.ACCELERATION}.get(kind)
        return of_point is not None and any(
            slide.name == of and slide.along == FRAME and slide.at in self.values.get(of_point, {})
            for slide in self.scene.slides)

    def _quantity(self, kind: ResultKind, of: str, symbol: Said | str, value: Any) -> Fact:
        """A number with its sign, or a vector by its size and the angle at which it points."""
        symbol_of_unit = unit(kind.dimension.unit(self.scene.units).replace("^2", "²").replace("*", "·"))
        deviation = self.pencil.results.get(kind, {}).get(of)
        if kind.single:
            return Fact(RESULTS, symbol, digits(value), symbol_of_unit, kind, of, _relative(deviation, value))
        size = magnitude(*value)
        least = max(self._largest[kind.dimension], deviation.value if deviation else 0.0)
        size = size if size > ZERO_TOL * least else 0.0
        tail = arrange("{0} ∠ {1}°", symbol_of_unit, digits(math.degrees(math.atan2(value[1], value[0])) % 360)) \
            if size else symbol_of_unit
        return Fact(RESULTS, symbol, digits(size), tail, kind, of, _relative(deviation, size))

    def _motion_symbol(self, kind: ResultKind, of: str) -> Said | str:
        """v_B, omega_3; of a slide its pair in brackets."""
        if kind.pair:
            slide = next(slide for slide in self.scene.slides if slide.name == of)
            return arrange("{0} ({1})", AS_FACTS[kind], slide_named(slide))
        return f"{AS_FACTS[kind]}_{of}"

    @cached_property
    def _reaction_symbols(self) -> dict[str, Said | str]:
        """R_12 and where it acts, by the name of the reaction in results: the force on the first-named link."""
        from graphplan.methods.forces.free_bodies import pair_letter, strand_letters  # most scenes have no loads
        from graphplan.methods.forces.groups import pairs

        scene = self.scene
        joints = {JointForce(point, link).name: said("{0} at {1}", pair_letter(pin, link), point)
                  for point, link, pin in pairs(scene)}
        slides = {slide.name: said("{0} at {1}", pair_letter(slide.along, slide.link), slide.at)
                  for slide in scene.slides}
        contacts = {pair.name: pair_letter(*pair.links[::-1]) for pair in scene.contacts}
        gears = {gear.name: pair_letter(*gear.links[::-1]) for gear in scene.gears}
        strands = {strand: letter for gear in scene.gears for strand, letter in strand_letters(gear).items()}
        return {**joints, **slides, **contacts, **gears, **strands}

    def _of_places(self, kind: ResultKind, of: str, value: Any) -> Iterator[Fact]:
        """Poles by their places, paths by their radii of curvature, inflection circles by their diameters."""
        length = unit(self.scene.units.length)
        deviation = self.pencil.results.get(kind, {}).get(of)
        if kind in (kinds.POLE, kinds.POLE_HEADING):
            letter = pole_letter(self.scene.link_pair(of))
            if kind == kinds.POLE:
                yield Fact(RESULTS, letter, coordinates(value), length, kind, of)
            else:
                angle = digits(math.degrees(math.atan2(value[1], value[0])) % 180)
                yield Fact(RESULTS, letter, said("at infinity, towards {0}°", angle), unit(""), kind, of)
        elif kind == kinds.CENTRE:
            x, y = point_place(self.scene, of.partition(" ")[0])
            radius = magnitude(value[0] - x, value[1] - y)
            yield Fact(RESULTS, f"rho_{of.partition(' ')[0]}", digits(radius), length, kind, of,
                       _relative(deviation, radius))
        elif kind in (kinds.STRAIGHT, kinds.CUSP):
            yield Fact(RESULTS, f"rho_{of.partition(' ')[0]}", digits(0.0) if kind == kinds.CUSP else said("infinite"),
                       length if kind == kinds.CUSP else unit(""), kind, of)
        elif kind == kinds.ACCELERATION_CENTRE:
            yield Fact(RESULTS, f"Q_{of}", coordinates(value), length, kind, of)
        elif kind == kinds.INFLECTION and of in self.values.get(kinds.MOTION_POLE, {}):
            u, v = self.values[kinds.MOTION_POLE][of]
            diameter = magnitude(value[0] - u, value[1] - v)
            yield Fact(RESULTS, f"d_{of}", digits(diameter), length, kind, of, _relative(deviation, diameter))


def _relative(deviation: Deviation | None, size: Any) -> float | None:
    """How far off a result is drawn beside its own size; None where that is not told, or the result is nothing."""
    if deviation is None or not isinstance(size, float | int) or not size:
        return None
    return deviation.value / abs(size)
