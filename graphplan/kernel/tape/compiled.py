"""Assembly of LLVM compiled for this machine, and kept on disk: in the user's cache folder, as XDG says.

What is kept is found again by its text, the version of LLVM and the machine. A file is written whole or not at all, and
read only if it is whole; where nothing can be kept, nothing is.
"""

from __future__ import annotations

import ctypes
import os
import tempfile
from collections.abc import Callable
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from llvmlite import binding as llvm

KEPT = 256  # files: the oldest go
LONG = 1_000_000  # characters: from there on choosing registers well takes longer and longer, and saves a tenth


@lru_cache(maxsize=256)
def compile_c(text: str, name: str, *arguments: Any) -> Callable[..., None]:
    """The function of this name, which takes these arguments of `ctypes`; the same text is compiled once."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    triple, cpu, features = llvm.get_process_triple(), llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()
    machine = llvm.Target.from_triple(triple).create_target_machine(cpu, features, opt=int(len(text) < LONG), jit=True)
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(text), machine)
    key = "\n".join([str(llvm.llvm_version_info), triple, cpu, features, text])
    file = _folder() / f"{sha256(key.encode()).hexdigest()}.o"
    engine.set_object_cache(lambda _, made: _keep(file, made), lambda _: _cached_code(file))
    engine.finalize_object()
    made: Any = ctypes.CFUNCTYPE(None, *arguments)(engine.get_function_address(name))
    made.engine = engine  # holds the code
    function: Callable[..., None] = made
    return function


def _folder() -> Path:
    """Where graphplan keeps machine code."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    return Path(base if os.path.isabs(base) else os.path.expanduser("~/.cache"), "graphplan", "tapes")


def _cached_code(file: Path) -> bytes | None:
    """The code in a file; none where there is no such file, or it is not whole."""
    try:
        told, made = (content := file.read_bytes())[:32], content[32:]
        return made if sha256(made).digest() == told else None
    except OSError:
        return None


def _keep(file: Path, made: bytes) -> None:
    """Keep code in a file, under another name until it is whole."""
    if not file.is_absolute():  # nobody's home
        return
    try:
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, other = tempfile.mkstemp(dir=file.parent)
        with os.fdopen(handle, "wb") as stream:
            stream.write(sha256(made).digest() + made)
        os.replace(other, file)
        for old in sorted(file.parent.glob("*.o"), key=os.path.getmtime)[:-KEPT]:
            old.unlink(missing_ok=True)
    except OSError:
        return
