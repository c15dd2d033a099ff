"""Names of marks, spelled as programs have them, whichever way a student or his drawing program writes them.

`v_b` is v with a subscript, Greek letters have their names, primes stand at the end.
"""

from __future__ import annotations

import re

from graphplan.sheet.lettering.lettering import GREEK

NAMES = {letter: name for name, letter in GREEK.items()} | {"ϵ": "epsilon", "ϕ": "phi", "ϑ": "theta"}
SPELLED = {letter.upper(): name.capitalize() for letter, name in NAMES.items()} | NAMES
LOW = str.maketrans("₀₁₂₃₄₅₆₇₈₉ₐₑₕₖₗₘₙₒₚₛₜₓ", "0123456789aehklmnopstx")
PRIMES = str.maketrans({"′": "'", "’": "'", "`": "'", "″": "''", "”": "''", '"': "''", "‴": "'''"})
STEM = "|".join([*sorted(GREEK, key=len, reverse=True), "[A-Z]?[a-z][0-9]{0,2}", "[0-9]{1,3}"])
MARK = re.compile(rf"(?:{STEM})(?:_[A-Z0-9,]{{1,6}})?(?:\([A-Z0-9]{{1,3}}\))?'*", re.IGNORECASE)


def spelled(name: str) -> str:
    """A name as it is compared: v_{b}, A₁′, α and P_25_1 become v_b, A_1', alpha and P_25,1."""
    text = re.sub(r"[{}$\\]", "", name.strip()).translate(PRIMES)
    if low := re.search(r"[₀-₉ₐ-ₜ]+", text):
        text = f"{text[: low.start()]}_{low[0].translate(LOW)}{text[low.end() :]}"
    text = "".join([SPELLED.get(char, char) for char in text])
    stem, _, index = text.replace("'", "").partition("_")
    index = re.sub(r"(?<=\d)_(?=\d)", ",", index).replace("_", "")
    return stem + (f"_{index}" if index else "") + "'" * text.count("'")


def bare(name: str) -> str:
    """A name without what spellings differ in: A_3, a3 and "link A3" are one."""
    return re.sub(r"^(link|point)\s+|[\s_]", "", spelled(name).casefold())


def mark(name: str) -> str:
    """The name spelled, if it reads as that of a mark; else nothing."""
    found = spelled(name)
    return found if MARK.fullmatch(found) else ""


def greek(name: str) -> bool:
    """Whether the name is a Greek letter's, as those of lines are."""
    return name.rstrip("'").partition("_")[0].lower() in GREEK


def lined(name: str) -> bool:
    """Whether a name may stand beside a line: a Greek letter's or a number."""
    return greek(name) or name.isdigit()
