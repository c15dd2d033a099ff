"""What a construction has found, as facts in the field's letters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.units import Dimension
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.panels import balance_letter, pole_letter, slide_named
from graphplan.methods.results import Fact, facts, pair_forces
from graphplan.phrases import Said, arrange, coordinates, digits, join, said, unit
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.sheet.words.facts import SaidFact, direction_angle, given_facts, point_place
from graphplan.sheet.words.lengths import magnitude
from graphplan.sheet.words.rows import Deviation, Deviations, largest_size

RESULTS = said("Found")
DIGITS = 4  # of the angle of a result
MOVING = (kinds.VELOCITY, kinds.ACCELERATION, kinds.SLIDE_VELOCITY, kinds.SLIDE_ACCELERATION, kinds.OMEGA, kinds.ALPHA,
          kinds.SCREW)  # kinds that bear the letter of their dimension


def found_facts(drawing: Construction, values: Mapping[str, Mapping[str, Any]],
                pencil: Deviations | None = None) -> tuple[SaidFact, ...]:
    """Every result that is asked for, vectors by size and direction; `values` are the readings by kind and name."""
    return tuple(_ResultFacts(drawing, values, pencil or Deviations()).facts())


def drawing_facts(drawing: Construction, values: Mapping[str, Mapping[str, Any]],
                  pencil: Deviations) -> tuple[tuple[SaidFact, ...], tuple[SaidFact, ...]]:
    """What is given of a drawing, and what it has found."""
    return given_facts(drawing.mechanism), found_facts(drawing, values, pencil)


def drawing_remarks(drawing: Construction, pencil: Deviations) -> Iterator[Said]:
    """Remarks on the pose and on what is missing, and what the letters of reactions mean."""
    yield from (*([pencil.remark] if pencil.remark else []), *drawing.missing)
    if any(reading.kind in kinds.WITH_FRICTION for reading in drawing.readings):
        force = said("R_ij: the force of link i on link j")
        yield force if drawing.scene.frame_name != FRAME else join((force, said("0: the frame")), "; ")


@dataclass(frozen=True)
class _ResultFacts:
    """The results of a construction, as facts."""

    drawing: Construction
    values: Mapping[str, Mapping[str, Any]]
    pencil: Deviations

    @property
    def scene(self) -> Scene:
        return self.drawing.scene

    def facts(self) -> Iterator[SaidFact]:
        """Motion first, then places, then forces; what the scene gives is none of them, but the turning of a link that
        several drives prescribe, or one of another link, is."""
        turning = {drive.link for drive in self.scene.drives if drive.on == FRAME}
        prescribed = {(reading.kind, reading.of) for reading in self.drawing.readings if reading.given is not None
                      and (reading.of in turning or not reading.kind.turning)}
        for fact in facts(self.values):
            if not ((fact.kind, fact.of) in prescribed or self._is_superseded(fact) or self._is_of_its_point(fact)):
                yield from self._in_words(fact)
        extreme = self.scene.assembly.extreme if self.scene.assembly else None
        if extreme and extreme.time_ratio:
            yield SaidFact(RESULTS, "K", digits(extreme.time_ratio), arrange(""))

    def _in_words(self, fact: Fact) -> Iterator[SaidFact]:
        """A fact in words; nothing of what sheets tell otherwise."""
        kind, of, loads = fact.kind, fact.of, self.scene.loads
        if kind in MOVING:
            yield self._quantity(fact, self._motion_symbol(fact))
        elif kind in (kinds.POLE, kinds.POLE_HEADING, *kinds.PATHS):
            yield from self._of_places(fact)
        elif kind in kinds.REACTIONS or kind in kinds.WITH_FRICTION.values():
            yield from [] if kind.single else [self._quantity(fact, self._reaction_symbols[of])]
        elif kind.way and loads:
            yield self._quantity(fact, balance_letter(loads.named_balances[of]))

    @cached_property
    def _largest(self) -> dict[Dimension, float]:
        """The size of the largest vector of each dimension, beside which rounding is nothing."""
        largest = dict[Dimension, float]()
        for name, results in self.values.items():
            kind = kinds.kind_of(name)
            if not kind.single:
                largest[kind.dimension] = max(largest.get(kind.dimension, 0.0), largest_size(results))
        return largest

    def _is_superseded(self, fact: Fact) -> bool:
        """Whether another kind says the same of the same thing, and better: with friction, and not by the lever."""
        kind = fact.kind
        if kind in kinds.WITH_FRICTION:
            return fact.of in self.values.get(kinds.WITH_FRICTION[kind], {})
        ways = [kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER]
        return bool(kind.way) and any(
            fact.of in self.values.get(better, {}) for better in kinds.KINDS.values()
            if better.way in ways[:ways.index(kind.way)] and better.single == kind.single)

    def _is_of_its_point(self, fact: Fact) -> bool:
        """Whether a slide moves along the frame, so that its point tells the same: v_P, not v (5 along frame)."""
        of_point = {kinds.SLIDE_VELOCITY: kinds.VELOCITY, kinds.SLIDE_ACCELERATION: kinds.ACCELERATION}.get(fact.kind)
        return of_point is not None and any(
            slide.name == fact.of and slide.along == FRAME and slide.at in self.values.get(of_point, {})
            for slide in self.scene.slides)

    def _quantity(self, fact: Fact, symbol: Said | str) -> SaidFact:
        """A number with its sign, or a vector by its size and the angle at which it points."""
        kind, value, deviation = fact.kind, fact.value, self._deviation(fact)
        measure = unit(kind.dimension.sheet_unit(self.scene.units))
        if kind.single:
            return SaidFact(RESULTS, symbol, digits(value), measure, kind, fact.of, _relative(deviation, value))
        size = magnitude(*value)
        least = max(self._largest[kind.dimension], deviation.value if deviation else 0.0)
        size = size if size > ZERO_TOL * least else 0.0
        tail = arrange("{0} ∠ {1}°", measure, direction_angle(*value, count=DIGITS)) if size else measure
        return SaidFact(RESULTS, symbol, digits(size), tail, kind, fact.of, _relative(deviation, size))

    def _deviation(self, fact: Fact) -> Deviation | None:
        """How far off the pencil draws it."""
        return self.pencil.results.get(fact.kind, {}).get(fact.of)

    def _motion_symbol(self, fact: Fact) -> Said | str:
        """v_B, omega_3; of a slide its pair in brackets."""
        letter = fact.kind.dimension.letter
        if fact.kind.pair:
            slide = next(slide for slide in self.scene.slides if slide.name == fact.of)
            return arrange("{0} ({1})", letter, slide_named(slide))
        return f"{letter}_{fact.of}"

    @cached_property
    def _reaction_symbols(self) -> dict[str, Said | str]:
        """R_12 and where it acts, by the name of the reaction in results."""
        return {force.name: said("{0} at {1}", force.letter, force.point) if force.sort in ("at", "slide")
                else force.letter for force in pair_forces(self.scene)}

    def _of_places(self, fact: Fact) -> Iterator[SaidFact]:
        """Poles by their places, paths by their radii of curvature, inflection circles by their diameters."""
        kind, of, value = fact.kind, fact.of, fact.value
        length, point = unit(self.scene.units.length), of.partition(" ")[0]

        def state(symbol: str, value: Said, measure: Said = length, size: Any = None) -> SaidFact:
            return SaidFact(RESULTS, symbol, value, measure, kind, of, _relative(self._deviation(fact), size))

        def distance(symbol: str, start: tuple[Any, Any]) -> SaidFact:
            size = magnitude(value[0] - start[0], value[1] - start[1])
            return state(symbol, digits(size), size=size)

        if kind == kinds.POLE:
            yield state(pole_letter(self.scene.link_pair(of)), coordinates(value))
        elif kind == kinds.POLE_HEADING:
            angle = direction_angle(*value, count=DIGITS, turn=180)
            yield state(pole_letter(self.scene.link_pair(of)), said("at infinity, towards {0}°", angle), unit(""))
        elif kind == kinds.CENTRE:
            yield distance(f"rho_{point}", point_place(self.scene, point))
        elif kind == kinds.CUSP:
            yield state(f"rho_{point}", digits(0.0))
        elif kind == kinds.STRAIGHT:
            yield state(f"rho_{point}", said("infinite"), unit(""))
        elif kind == kinds.ACCELERATION_CENTRE:
            yield state(f"Q_{of}", coordinates(value))
        elif kind == kinds.INFLECTION and of in self.values.get(kinds.MOTION_POLE, {}):
            yield distance(f"d_{of}", self.values[kinds.MOTION_POLE][of])


def _relative(deviation: Deviation | None, size: Any) -> float | None:
    """How far off a result is drawn beside its own size; None where that is not told, or the result is nothing."""
    if deviation is None or not isinstance(size, float | int) or not size:
        return None
    return deviation.value / abs(size)
