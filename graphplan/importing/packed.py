"""Text unpacked that was packed by LZ-string, as pages put it into their addresses.

A Lempel-Ziv code of 1978: a stream of bits, six in each letter, first bit first, each code with its lowest bit first
and as wide as the dictionary has grown. Codes 0 and 1 bring a new character of 8 or 16 bits, 2 ends the text, others
are pieces of it that came before.

Source: P. Jeney, lz-string; Ziv and Lempel, IEEE Trans. Inf. Theory 24 (1978).
"""

from __future__ import annotations

from collections.abc import Iterator

ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-$"
BYTE, WORD, END = 0, 1, 2


def unpacked(packed: str, most: int) -> str:
    """The text that was packed.

    Fails with `ValueError` where it was not, or it is longer than `most`.
    """
    places = {letter: place for place, letter in enumerate(ALPHABET)}
    bits = _bits([places.get(letter, -1) for letter in packed.replace(" ", "+").rstrip("=")])
    pieces: list[str] = ["", "", ""]
    found: list[str] = []
    long, before, width, room = 0, "", 2, 4
    while True:
        code = _number(bits, width)
        if code == END:
            return "".join(found)
        piece = ""
        if code in (BYTE, WORD):
            piece = chr(_number(bits, 16 if code == WORD else 8))
            pieces.append(piece)
            room -= 1 if before else 0
            width, room = _grown(width, room) if before else (3, room)
        elif code < len(pieces):
            piece = pieces[code]
        elif code == len(pieces) and before:
            piece = before + before[0]
        else:
            raise ValueError("a code that was not packed")
        if before:
            pieces.append(before + piece[0])
            room -= 1
            width, room = _grown(width, room)
        found.append(piece)
        before, long = piece, long + len(piece)
        if long > most:
            raise ValueError("it is too long")


def _grown(width: int, room: int) -> tuple[int, int]:
    """The width of a code, and how many pieces there are until it grows."""
    return (width, room) if room else (width + 1, 2**width)


def _bits(letters: list[int]) -> Iterator[int]:
    for letter in letters:
        if letter < 0:
            raise ValueError("a letter that is not packed text")
        yield from (letter >> place & 1 for place in reversed(range(6)))


def _number(bits: Iterator[int], width: int) -> int:
    """The next number, of so many bits."""
    found = 0
    for place in range(width):
        bit = next(bits, None)
        if bit is None:
            raise ValueError("its end is missing")
        found |= bit << place
    return found
