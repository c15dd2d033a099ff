"""A tape as one loop over poses for numba, where that is installed: worth its compiling for millions of poses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.tape.record import Tape
from graphplan.kernel.tape.source import compiled, spoken, statements


def loop(tape: Tape, inputs: Sequence[int], outputs: Sequence[int]) -> Callable[..., bool]:
    """A machine-code `block(inputs, outputs, registers)`, as :mod:`graphplan.kernel.tape.blocks` calls it."""
    try:
        from numba import njit
    except ImportError:
        raise Refused("compiled", "numba is not installed", "pip install 'graphplan[numba]', or leave it out") from None
    reads = [f"v{place} = I[{k}][k]" for k, place in enumerate(inputs)]
    tells = [f"O[{k}][k] = {spoken(tape, place)}" for k, place in enumerate(outputs)]
    body = "\n        ".join([*reads, *statements(tape, outputs, "return False"), *tells])
    size = "I[0].size" if inputs else "O[0].size"
    text = f"def block(I, O, R):\n    for k in range({size}):\n        {body}\n    return True"
    made = njit(error_model="numpy")(compiled(text, "block"))

    def block(I: Sequence[Any], O: Sequence[Any], R: Sequence[Any]) -> bool:
        return bool(made(tuple(I), tuple(O), ()))

    return block
