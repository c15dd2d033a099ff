"""LZ-string, in which addresses of PMKS+ are packed.

Sources: P. Jeney, lz-string; Ziv and Lempel, IEEE Trans. Inf. Theory 24 (1978).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-$"
BYTE, WORD, END = 0, 1, 2


def unpack(packed: str, max_length: int) -> str:
    """The text that LZ-string packed into an address.

    Lempel and Ziv's code of 1978: a stream of bits, six in each letter, first bit first, each code with its lowest bit
    first and as wide as the dictionary has grown. Codes 0 and 1 bring a new character of 8 or 16 bits, 2 ends the text,
    others are pieces of it that came before. Fails with `ValueError` where it is no such text, or one that is too long.
    """
    letters = packed.replace(" ", "+").rstrip("=")
    if not {*letters} <= {*ALPHABET}:
        raise ValueError("a letter that is not packed text")
    bits = (ALPHABET.index(letter) >> place & 1 for letter in letters for place in reversed(range(6)))
    pieces = ["", "", ""]
    text, last = "", ""
    while (code := _next_number(bits, len(pieces).bit_length())) != END:
        if code in (BYTE, WORD):
            piece = chr(_next_number(bits, 16 if code == WORD else 8))
            pieces.append(piece)
        elif code < len(pieces):
            piece = pieces[code]
        elif code == len(pieces) and last:
            piece = last + last[0]
        else:
            raise ValueError("a code that was not packed")
        if last:
            pieces.append(last + piece[0])
        text, last = text + piece, piece
        if len(text) > max_length:
            raise ValueError("it is too long")
    return text


def _next_number(bits: Iterator[int], width: int) -> int:
    """The next number, of so many bits."""
    digits = [*islice(bits, width)]
    if len(digits) < width:
        raise ValueError("its end is missing")
    return sum(bit << place for place, bit in enumerate(digits))
