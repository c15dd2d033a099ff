"""What graphplan says to its readers: in English, remembering what was put where, so that it can be said in any tongue.

A phrase stands where it is needed, as `said("Control: {0} and {1} meet", a, c)`; its English is its key in the
catalogues of `words`. The sentence of a drawing step has its primitive for a key.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

PHRASES, STEPS, UNITS, TITLES, NUMBERS = "phrases", "steps", "units", "titles", "numbers"  # sections of a catalogue
NO_NAMED_PARTS: dict[str, Any] = {}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Said(str):
    """English words that know their key in a section of the catalogues and what is put into them, by place and name;
    and as what they were put into others in a tongue, so that it is found once."""

    section: str
    key: str
    put: tuple[Any, ...]
    named: dict[str, Any]
    in_tongues: dict[Any, Shaped] | None = None  # of most none: many are made to be told in English alone

    def __new__(cls, english: str, section: str, key: str, put: tuple[Any, ...] = (),
                named: dict[str, Any] | None = None) -> Said:
        self = super().__new__(cls, english)
        self.section, self.key, self.put, self.named = section, key, put, named or NO_NAMED_PARTS
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Said, (str(self), self.section, self.key, self.put, self.named)


class Shaped(str):
    """Words that can be put into others in one of their forms: a grammatical case, or with a `capital`.

    A mark's letter, such as v_b, and a Greek one keep their size.
    """

    def __format__(self, form: str) -> str:
        if form == "capital" and self[1:2] != "_" and not "α" <= self[:1] <= "ω":
            return self[:1].upper() + self[1:]
        return str(self)


def said(english: str, /, *put: Any, **named: Any) -> Said:
    """A phrase with what is put into it: other phrases, names or numbers."""
    return Said(_fill(english, put, named), PHRASES, english, put, named)


@dataclass(frozen=True)
class Phrase:
    """A phrase that is filled in later."""

    english: str

    def __call__(self, *put: Any, **named: Any) -> Said:
        return said(self.english, *put, **named)

    def says(self, words: str) -> bool:
        """Whether these words are this phrase, filled in with whatever."""
        return isinstance(words, Said) and words.key == self.english


def phrase(english: str) -> Phrase:
    """A phrase, to be filled in when it is said."""
    return Phrase(english)


def sentence(op: str, english: str, put: Iterable[Any], named: dict[str, Any]) -> Said:
    """The sentence of a drawing step, by its operation."""
    put = tuple(put)
    return Said(_fill(english, put, named), STEPS, op, put, named)


def unit(symbol: str) -> Said:
    """A unit of measure, such as mm/s²."""
    return Said(symbol, UNITS, symbol)


def figures(written: str) -> Said:
    """Numbers as they are written in English: other tongues have other signs for their decimals, and between them."""
    return Said(written, NUMBERS, written)


class Unknown(ABC):
    """A number that is known later, such as in other poses: in a text a place is left for it."""

    @abstractmethod
    def place(self, count: int) -> str:
        """What stands for it in so many significant digits, or where that is 0 in tenths."""

    @abstractmethod
    def level(self, kinds: str, numbers: Sequence[Any]) -> Any:
        """The level of rounding at which a sum of numbers of these kinds holds as printed (sheet/words/sums.py)."""

    @abstractmethod
    def result(self, kinds: str, numbers: Sequence[Any]) -> Any:
        """The result of such a sum as it is printed at this level."""

    @abstractmethod
    def printed_number(self, number: Any, kind: str) -> Said:
        """A number of a sum at this level, by its kind."""

    @abstractmethod
    def hypot(self, other: Any) -> Any:
        """The length of a vector of which it is a component, and what other number is the other."""


class UndecidedText(Exception, ABC):
    """What was asked of an unknown number hangs on its value."""

    @abstractmethod
    def say_both(self, tell: Callable[[], Said]) -> Said:
        """What is told by the one answer and by the other."""


def in_any_case(tell: Callable[[], Said]) -> Said:
    """What is told; of unknown numbers, whatever they turn out to be."""
    try:
        return tell()
    except UndecidedText as asked:
        return asked.say_both(tell)


def tenths(value: float) -> Said:
    """A number of mm as it is read off a ruler: in tenths, half of one in hundredths."""
    if isinstance(value, Unknown):
        return figures(value.place(0))
    return decimals(value, 2 if abs(value) * 4 % 2 == 1 else 1)


def decimals(value: float, count: int) -> Said:
    """A number with so many decimals."""
    return figures(f"{value:z.{count}f}".replace("-", "−"))


def digits(value: float, count: int = 4) -> Said:
    """A number in at most `count` significant digits, with a power of ten only where it is very large or small."""
    if isinstance(value, Unknown):
        return figures(value.place(count))
    text = f"{value + 0.0:.{count}g}"
    mantissa, _, power = text.partition("e")
    if power and not 0 < int(power) < 7:
        return figures(f"{mantissa.replace('-', '−')}·10{str(int(power)).translate(SUPERSCRIPTS)}")
    return figures((f"{float(text):.0f}" if power else text).replace("-", "−"))


def coordinates(values: Iterable[float], count: int = 4) -> Said:
    """The coordinates of a point, or the components of a vector, in brackets."""
    return figures(f"({', '.join(digits(value, count) for value in values)})")


def arrange(pattern: str, /, *put: Any) -> Said:
    """Phrases in an order, with points and brackets, that is the same in every tongue."""
    return Said(_fill(pattern, put, {}), "", pattern, put)


def join(parts: Iterable[Any], between: str = ", ") -> Said:
    """Phrases one after the other."""
    put = tuple(parts)
    return arrange(between.join(f"{{{i}}}" for i in range(len(put))), *put)


def list_differences(texts: Sequence[Said]) -> Said:
    """Texts of one pattern as one, which lists in each place of it what differs there; others one after the other."""
    if len({text.key for text in texts}) > 1:
        return join(texts)
    first, put = texts[0], tuple([join(dict.fromkeys(place)) for place in zip(*(text.put for text in texts),
                                                                              strict=True)])
    return Said(_fill(first.key, put, first.named), first.section, first.key, put, first.named)


def _fill(pattern: str, put: tuple[Any, ...], named: dict[str, Any]) -> str:
    if ":" not in pattern:  # no word is wanted in a form
        return pattern.format(*put, **named)
    return pattern.format(*map(_shape, put), **{name: _shape(value) for name, value in named.items()})


def _shape(value: Any) -> Any:
    return Shaped(value) if isinstance(value, str) else value
