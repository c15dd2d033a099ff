"""A tongue: its catalogue, and how what was said in English is said in it.

A catalogue has, in TOML, the sentences of the steps by primitive, the phrases by their English, the units, the signs
of numbers, and the titles of the packaged scenes. An entry is a text, or a table of its forms by name, of which the
first is the plain one; what is put into a text may be asked for in a form, as in `{0:dative}`.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from graphplan.errors import Refused
from graphplan.phrases import NUMBERS, TITLES, UNITS, Said, Shaped
from graphplan.words import LANGUAGES

_SYMBOL = re.compile(r"[A-Za-z°]+")
_PLAIN_PLACE = re.compile(r"\{(\d+)\}")
_ENTRY = re.compile(r'(?:"([^"]*)"|([\w-]+)) = ')

Entry = str | dict[str, str]


class Tongue:
    """What is said, in one language; English needs no catalogue."""

    def __init__(self, code: str, catalogue: Mapping[str, Mapping[str, Entry]] | None = None):
        self.code, self.catalogue = code, catalogue
        self.signs = str.maketrans({sign: str(local) for sign, local in (catalogue or {}).get(NUMBERS, {}).items()})

    def __call__(self, text: str) -> str:
        """The text in this tongue; what is no phrase, such as a title, stays as it is."""
        return str(self._in_all_forms(text))

    def title(self, title: str) -> str:
        """The title of a packaged scene in this tongue; any other as its author wrote it."""
        return str(self.catalogue[TITLES].get(title, title)) if self.catalogue else title

    def _in_all_forms(self, value: Any) -> Any:
        """The value as it is put into others: a phrase in all its forms, which are found once."""
        if self.catalogue is None or not isinstance(value, Said):
            return Shaped(value)
        if value.in_tongues is None:
            value.in_tongues = {}
        if self not in value.in_tongues:
            value.in_tongues[self] = self._translate(value)
        return value.in_tongues[self]

    def _translate(self, value: Said) -> Shaped:
        """A phrase in all its forms."""
        if value.section == UNITS:
            return Shaped(_SYMBOL.sub(self._symbol, value.key))
        if value.section == NUMBERS:
            return Shaped(value.key.translate(self.signs))
        put = [self._in_all_forms(insert) for insert in value.put]
        named = {name: self._in_all_forms(insert) for name, insert in value.named.items()}
        forms = self._forms(value)
        if not value.section:  # words one after the other are in the form that is asked of them
            names = dict.fromkeys(name for insert in put if isinstance(insert, Forms) for name in insert.forms if name)
            forms = forms | {name: _PLAIN_PLACE.sub(rf"{{\1:{name}}}", value.key) for name in names}
        if [*forms] == [""]:
            return Shaped(forms[""].format(*put, **named))
        return Forms({name: pattern.format(*put, **named) for name, pattern in forms.items()})

    def _forms(self, value: Said) -> dict[str, str]:
        """The entry of a phrase, as a table of forms; what only joins others is the same everywhere, and what a
        catalogue lacks is said in English."""
        assert self.catalogue is not None
        entry = self.catalogue[value.section].get(value.key, value.key) if value.section else value.key
        return entry if isinstance(entry, dict) else {"": entry}

    def _symbol(self, found: re.Match[str]) -> str:
        assert self.catalogue is not None
        entry = self.catalogue[UNITS].get(found[0], found[0])
        assert isinstance(entry, str)
        return entry


class Forms(Shaped):
    """Words in all their forms; as plain words they are the first."""

    forms: dict[str, str]

    def __new__(cls, forms: dict[str, str]) -> Forms:
        self = super().__new__(cls, next(iter(forms.values())))
        self.forms = forms
        return self

    def __format__(self, form: str) -> str:
        return self.forms.get(form) or super().__format__(form)


ENGLISH = Tongue("en")


@cache
def tongue(code: str) -> Tongue:
    """The tongue of a language by its code, such as de. Fails with `Refused` where there is no such catalogue."""
    if code == "en":
        return ENGLISH
    if code not in LANGUAGES:
        raise Refused(f"language {code}", "unknown language", f"choose one of {', '.join(LANGUAGES)}")
    return Tongue(code, catalogue(code))


class Section(Mapping[str, Entry]):
    """A section of a catalogue, by key; each entry has a line of its own, which is read when it is looked up."""

    def __init__(self, lines: Mapping[str, str]):
        self._lines, self._entries = lines, dict[str, Entry]()

    def __getitem__(self, key: str) -> Entry:
        if key not in self._entries:
            self._entries[key] = tomllib.loads(f"entry = {self._lines[key]}")["entry"]
        return self._entries[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._lines)

    def __len__(self) -> int:
        return len(self._lines)


def catalogue(code: str) -> dict[str, Section]:
    """The catalogue of a language, section by section."""
    sections: dict[str, dict[str, str]] = {}
    lines: dict[str, str] = {}
    for line in Path(__file__).with_name(f"{code}.toml").read_text("utf-8").splitlines():
        if entry := _ENTRY.match(line):
            lines[entry[1] or entry[2]] = line[entry.end() :]
        elif line.startswith("["):
            lines = sections[line.strip("[]")] = {}
    return {name: Section(lines) for name, lines in sections.items()}
