"""The table speaks for itself: every record is documented, spoken and claimed."""

from __future__ import annotations

import re
from string import Formatter

import pytest
from figures import NAMES

from graphplan.kernel import FAILURES, TABLE, Primitive
from graphplan.kernel.claims import RESIDUALS


@pytest.fixture(params=NAMES)
def op(request: pytest.FixtureRequest) -> Primitive:
    return TABLE[request.param]


def test_sentence_speaks_of_everything(op: Primitive) -> None:
    """A sentence uses every argument, what is made, and every parameter."""
    used = {field for _, field, _, _ in Formatter().parse(op.sentence) if field is not None}
    assert used == {*map(str, range(len(op.reads))), "out", *op.params}


def test_doc_is_one_line(op: Primitive) -> None:
    """What a primitive gives is told in one line that ends with a full stop."""
    assert re.fullmatch(r"[A-Z].*\.", op.doc)


def test_failure_codes_are_explained(op: Primitive) -> None:
    """Every failure code says what it means and what to do."""
    assert all(all(FAILURES[code]) for code in op.fails)


def test_every_failure_code_is_used() -> None:
    """No failure code is left over: each is a primitive's, or the fractions' own."""
    assert set(FAILURES) == {code for op in TABLE.values() for code in op.fails} | {"not-rational"}


def test_something_is_claimed(op: Primitive) -> None:
    """Every primitive claims something of what it makes, by claims that can be tested."""
    assert op.claims
    assert {claim[0] for claim in op.claims} <= set(RESIDUALS)


def test_every_claim_is_made() -> None:
    """No test of a claim is left over."""
    assert set(RESIDUALS) == {claim[0] for op in TABLE.values() for claim in op.claims}


def test_methods_name_their_source(op: Primitive) -> None:
    """A source is given as author and year or as the name of the method."""
    assert not op.source or re.search(r"\d{4}", op.source)


def test_operands_exist(op: Primitive) -> None:
    """Claims speak of operands that there are, and a step is drawn at one that it reads."""
    places = [k for claim in op.claims for part in claim[1:] for k in (part if isinstance(part, tuple) else (part,))]
    assert all(-1 <= k < len(op.reads) for k in places)
    assert -1 <= op.where < max(1, len(op.reads))
