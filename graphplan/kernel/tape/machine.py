"""A tape as machine code: one loop in the assembly language of LLVM, which numba brings, several poses at a time.

The statements are vector instructions already, so that LLVM has but to choose registers: numba, given the same
statements in Python, takes some thirty times as long, and its loop is then no faster than numpy's calls, as it does not
see that arrays are apart. Complex arrays are read and written where they stand. A question sets a mask; nothing leaves
the loop.
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np

from graphplan.errors import missing_package
from graphplan.kernel.tape.record import Language, Tape, Writer

LANES = 8  # poses at a time, as many as the widest registers hold; LLVM cuts vectors up where registers are narrower

Layout = tuple[int, ...]  # of arrays: 2 for the two parts of a complex one, 1 for an array by itself


class Machine:
    """The replay of a tape over arrays by machine code, made once for each layout of them; used as `Blocks` are.

    Fails with `Refused` where numba is not installed.
    """

    def __init__(self, tape: Tape, inputs: Sequence[int], outputs: Sequence[int]):
        if not (find_spec("numba") and find_spec("llvmlite")):
            raise missing_package("compiled", "numba", "numba", "leave it out")
        self.tape, self.inputs, self.outputs = tape, inputs, outputs
        self._loops: dict[tuple[Layout, Layout], Any] = {}

    def run(self, inputs: Sequence[Any], outputs: Sequence[Any]) -> Any:
        """Fill the outputs for n poses; return the places of those in which a rule fails, whose outputs are
        undefined."""
        n = len(inputs[0])
        if n < LANES:
            inputs = [np.resize(array, LANES) for array in inputs]
        read, write = _laid_out(inputs), _laid_out(outputs, n < LANES)
        failed = np.empty(max(n, LANES), np.bool_)
        self._loop(read.layout, write.layout)(read.addresses, write.addresses, _address(failed), len(failed))
        for output, array in zip(outputs, write.arrays, strict=True):
            if array is not output:
                output[:] = array[:n]
        return np.flatnonzero(failed[:n])

    def _loop(self, read: Layout, write: Layout) -> Any:
        """The compiled loop for arrays that are laid out so."""
        if (read, write) not in self._loops:
            text = assembly(self.tape, self.inputs, self.outputs, read, write)
            pointers = [ctypes.c_void_p] * 3
            self._loops[read, write] = compile_assembly(text, "poses", *pointers, ctypes.c_int64)
        return self._loops[read, write]


class LaidOut(NamedTuple):
    """Arrays as a loop takes them, in groups: all of them, how many each group has, and where each begins."""

    arrays: list[Any]
    layout: Layout
    addresses: Any


def _laid_out(arrays: Sequence[Any], short: bool = False) -> LaidOut:
    """The two parts of a complex array are one group; an array that is not contiguous is copied, and if `short` all."""
    slots, begins, layout = list[Any](), list[Any](), list[int]()
    while len(slots) < len(arrays):
        one, *two = arrays[len(slots) : len(slots) + 2]
        if not short and two and one.strides == two[0].strides == (16,) and _address(two[0]) == _address(one) + 8:
            group = [one, two[0]]
        else:
            group = [np.resize(one, LANES) if short else np.ascontiguousarray(one)]
        begins.append(group[0])
        layout.append(len(group))
        slots += group
    return LaidOut(slots, tuple(layout), (ctypes.c_void_p * len(begins))(*map(_address, begins)))


def _address(array: Any) -> int:
    """Address of an array's first number; quicker than by its `ctypes`."""
    place: int = array.__array_interface__["data"][0]
    return place


# ---- the assembly ------------------------------------------------------------------------------------------------

VECTOR, MASK, NOUGHT = f"<{LANES} x double>", f"<{LANES} x i1>", "zeroinitializer"


def _constant(value: float) -> str:
    bits = struct.pack(">d", value).hex()
    return f"<{', '.join([f'double 0x{bits}'] * LANES)}>"


def _call_function(function: str, *operands: str) -> str:
    return f"call {VECTOR} @llvm.{function}.v{LANES}f64({', '.join(f'{VECTOR} {operand}' for operand in operands)})"


def _compare(way: str, one: str, other: str) -> str:
    return f"fcmp {way} {VECTOR} {one}, {other}"


def _choose(mask: str, one: str, other: str) -> str:
    return f"select {MASK} {mask}, {VECTOR} {one}, {VECTOR} {other}"


def _statements(**texts: str) -> str:
    """Statements that give these texts their names, after that of the result; `is_` is the result itself."""
    return "\n  ".join(f"{{name}}{'' if name == 'is_' else name} = {text}" for name, text in texts.items())


COMPARED = {"part": f"fmul {VECTOR} {{2}}, {{1}}", "size": _call_function("fabs", "{0}")}
LLVM = Language(
    _constant,
    {sign: _statements(is_=f"{called} {VECTOR} {{0}}, {{1}}")
     for sign, called in {"+": "fadd", "-": "fsub", "*": "fmul", "/": "fdiv"}.items()} | {
        "neg": _statements(is_=f"fneg {VECTOR} {{0}}"),
        "sqrt": _statements(is_=_call_function("sqrt", "{0}")),
        "abs": _statements(is_=_call_function("fabs", "{0}")),
        "sign": _statements(
            **COMPARED, small=_compare("ole", "{name}size", "{name}part"), nan=_compare("uno", "{0}", "{0}"),
            one=_call_function("copysign", _constant(1.0), "{0}"), some=_choose("{name}nan", "{0}", "{name}one"),
            is_=_choose("{name}small", NOUGHT, "{name}some"))},
    "{1}",
    _statements(**COMPARED, small=_compare("ule", "{name}size", "{name}part"),
                large=_compare("ueq", "{name}size", _constant(float("inf"))),
                is_=f"or {MASK} {{name}}small, {{name}}large"),
    _statements(is_=_compare("olt", "{0}", NOUGHT)), loads=True)


def assembly(tape: Tape, inputs: Sequence[int], outputs: Sequence[int], read: Layout, write: Layout) -> str:
    """The function `poses(inputs, outputs, failed, n)`: a loop over n poses, not less than there are lanes.

    It is told where each group of arrays begins. Its last turn takes the last poses, some of them again.
    """
    loads = dict(zip(inputs, _loads(read), strict=True))
    declared = [f"declare {VECTOR} @llvm.{name}.v{LANES}f64({', '.join([VECTOR] * count)})"
                for name, count in (("fabs", 1), ("sqrt", 1), ("copysign", 2))]
    return "\n  ".join([
        "define void @poses(ptr %inputs, ptr %outputs, ptr %failed, i64 %n) {",
        f"%last = sub i64 %n, {LANES}", "br label %turn", "turn:",
        "%k1 = phi i64 [0, %0], [%next, %turn]", "%k2 = shl i64 %k1, 1",
        *_body(Writer(tape, LLVM, loads, "%v", 0), outputs, write),
        f"%further = add i64 %k1, {LANES}", "%over = icmp ugt i64 %further, %last",
        "%next = select i1 %over, i64 %last, i64 %further", "%more = icmp ult i64 %k1, %last",
        "br i1 %more, label %turn, label %end", "end:", "ret void\n}", *declared, ""])


def _place(name: str, arrays: str, j: int, count: int) -> list[str]:
    """Statements that call the place of these poses in a group of arrays `name` and `at`."""
    return [f"{name}of = getelementptr ptr, ptr {arrays}, i64 {j}", f"{name}begin = load ptr, ptr {name}of",
            f"{name}at = getelementptr double, ptr {name}begin, i64 %k{count}"]


def _shuffle(one: str, other: str, size: int, lanes: Iterable[int]) -> str:
    some = [f"i32 {lane}" for lane in lanes]
    kind = f"<{size} x double>"
    return f"shufflevector {kind} {one}, {kind} {other}, <{len(some)} x i32> <{', '.join(some)}>"


def _loads(layout: Layout) -> Iterator[str]:
    """Yield the code that loads each input: of a complex array the real parts, or the imaginary ones."""
    for j, count in enumerate(layout):
        for part in range(count):
            lines = _place("{name}", "%inputs", j, count)
            lines.append(f"{{name}}{'' if count == 1 else 'both'} = load <{count * LANES} x double>, ptr {{name}}at, "
                         "align 8")
            if count == 2:
                lines.append("{name} = " + _shuffle("{name}both", "poison", 2 * LANES, range(part, 2 * LANES, 2)))
            yield "\n  ".join(lines)


def _body(writer: Writer, outputs: Sequence[int], layout: Layout) -> Iterator[str]:
    """All numbers and questions, each output stored as soon as it is there, and the mask."""
    due, j, asked, failed = 0, 0, 0, NOUGHT

    def output_stores() -> Iterator[str]:
        """The groups of outputs that are finished."""
        nonlocal due, j
        while j < len(layout) and all(place in writer.text for place in outputs[due : due + layout[j]]):
            yield _store(j, [writer.text[place] for place in outputs[due : due + layout[j]]])
            due, j = due + layout[j], j + 1

    for name, text in writer.terms(outputs, writer.tape.questions):
        yield text
        if name:
            yield from output_stores()
        else:
            asked += 1
            yield f"%bad{asked} = or {MASK} {failed}, %vq{asked}"
            failed = f"%bad{asked}"
    yield from output_stores()
    yield f"%mask = zext {MASK} {failed} to <{LANES} x i8>"
    yield "%masked = getelementptr i8, ptr %failed, i64 %k1"
    yield f"store <{LANES} x i8> %mask, ptr %masked, align 1"


def _store(j: int, texts: Sequence[str]) -> str:
    """A group of outputs for some poses: parts of a complex array one by one in turns."""
    count, what = len(texts), texts[0]
    lines = _place(f"%o{j}", "%outputs", j, count)
    if count == 2:
        turns = (lane // 2 + lane % 2 * LANES for lane in range(2 * LANES))
        what = f"%o{j}both"
        lines.append(f"{what} = " + _shuffle(texts[0], texts[1], LANES, turns))
    return "\n  ".join([*lines, f"store <{count * LANES} x double> {what}, ptr %o{j}at, align 8"])


# ---- compiled --------------------------------------------------------------------------------------------------------

LONG = 1_000_000  # characters: from there on choosing registers well takes longer and longer, and saves a tenth


@lru_cache(maxsize=256)
def compile_assembly(text: str, name: str, *arguments: Any) -> Callable[..., None]:
    """The function of this name, which takes these arguments of `ctypes`; the same text is compiled once."""
    from llvmlite import binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_default_triple().create_target_machine(
        llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten(), opt=int(len(text) < LONG), jit=True)
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(text), machine)
    engine.finalize_object()
    made: Any = ctypes.CFUNCTYPE(None, *arguments)(engine.get_function_address(name))
    made.engine = engine  # holds the code
    function: Callable[..., None] = made
    return function
