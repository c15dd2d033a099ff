"""Many tiny tests as one: a test of its own costs pytest ten times what a rule's value or a file's imports do."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Sequence
from functools import wraps
from typing import Any

import pytest

Test = Callable[..., None]
Label = Callable[[Any], object]


def each(names: str | Sequence[str], values: Iterable[Any], ids: Label | None = None) -> Callable[[Test], Test]:
    """As `pytest.mark.parametrize`, but in a loop within one test, which in the end names all values that it fails for.

    All of them share what the test asks pytest for; what was exchanged by `monkeypatch` is put back after each.
    """
    values = [*values]

    def over(test: Test) -> Test:
        signature = inspect.signature(test)
        asked = [names] if isinstance(names, str) else [*names]

        @wraps(test)
        def looped(**given: Any) -> None:
            failures, skips = [], []
            for value in values:
                try:
                    test(**given, **dict(zip(asked, [value] if isinstance(names, str) else value, strict=True)))
                except pytest.skip.Exception as skip:
                    skips.append(skip)
                except (Exception, pytest.fail.Exception) as failure:
                    failure.add_note(f"for {label(value)}")
                    failures.append(failure)
                if "monkeypatch" in given:
                    given["monkeypatch"].undo()
            if failures:
                offenders = ", ".join(failure.__notes__[-1].removeprefix("for ") for failure in failures)
                raise BaseExceptionGroup(f"{len(failures)} of {len(values)}: {offenders}", failures)
            if skips and len(skips) == len(values):
                raise skips[0]

        kept = [parameter for parameter in signature.parameters.values() if parameter.name not in asked]
        looped.__signature__ = signature.replace(parameters=kept)  # type: ignore[attr-defined]
        return looped

    def label(value: Any) -> object:
        return ids(value) if ids else getattr(value, "__name__", value)

    return over
