"""Values stand in the place of texts: nothing is read out of a name, and no behaviour hangs on what words say."""

from __future__ import annotations

import ast
import json
from collections.abc import Iterator
from dataclasses import replace

import pytest
from sources import FILES, PACKAGE, parsed

import graphplan as gp
from graphplan.kernel.kinds import TABLE, Variant, plain
from graphplan.kernel.numbers import Floats
from graphplan.methods import kinds
from graphplan.methods.construct import construct
from graphplan.methods.panels import JointForce, reactions_named
from graphplan.methods.results import thing_named
from graphplan.phrases import Phrase, Said, said

CUTTING = {"startswith", "endswith", "partition", "rpartition", "removeprefix", "removesuffix", "split", "find"}
# What bears a plan, a kind of result, a law, a reason or a form, by the word that it goes by.
NAMED = {"panel", "home", "kind", "quantity", "law", "why", "reason", "form"}
OWN = {  # what is no such name, and who reads it: rows of surveys, and a dyad's form
    "accuracy/survey/draughtsman.py", "accuracy/survey/growth.py", "accuracy/survey/machine.py",
    "mechanism/structure.py",
}


def cuts(tree: ast.AST) -> Iterator[ast.AST]:
    """Where a name is cut to find what is in it, or words are compared with others."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(ast.Attribute(ast.Name(word) | ast.Attribute(attr=word), verb)) if (
                    word in NAMED and verb in CUTTING):
                yield node
            case ast.Compare(ast.Attribute(attr="why" | "reason"), comparators=[ast.Constant(str()), *_]):
                yield node
            case ast.Compare(ast.Constant(str()), [ast.In() | ast.NotIn()], [ast.Name(word) | ast.Attribute(attr=word)]
                             ) if word in NAMED:
                yield node


@pytest.mark.parametrize("text", [
    "step.panel.startswith('force plan')", "kind.split()[-1]", "'moment' in kind", "step.why == 'a law'",
    "form.partition(' on ')",
])
def test_cutting_a_name_is_seen(text: str) -> None:
    """What is looked for is found where it stands."""
    assert list(cuts(ast.parse(text)))


def test_no_name_is_cut() -> None:
    """No plan, kind of result, law or form is found by cutting its name or by comparing words."""
    found = [f"{path.relative_to(PACKAGE)}:{node.lineno}" for path in FILES  # type: ignore[attr-defined]
             if str(path.relative_to(PACKAGE)) not in OWN for node in cuts(parsed(path))]
    assert not found


def test_kinds_of_results_are_told_apart_by_what_they_are() -> None:
    """Each kind has words, a dimension and a group of its own; its name alone says nothing."""
    assert {kind.group for kind in kinds.KINDS.values()} == {"velocity", "acceleration", "force", "poles",
                                                             "curvature"}
    assert [kind for kind in kinds.KINDS.values() if kind.single] == [
        "omega", "alpha", "slide moment", "slide moment with friction", "screw moment", "translation", "balance moment",
        "balance moment with friction", "lever moment"]
    odd = kinds.ResultKind(said("moment of nothing"), kinds.VELOCITY.dimension)
    assert (odd.group, odd.single, odd.pair) == ("velocity", False, False)


def test_joints_with_the_words_of_names_are_no_riddle() -> None:
    """Links and points may be called anything: a force at a joint is spoken of by them, whatever they are called."""
    scene = gp.load("rosenauer-loaded")
    force = JointForce("A", "3 along 2")
    renamed = replace(scene, links={**scene.links, "3 along 2": ("A",)})
    assert reactions_named(renamed)[force.name] == "3 along 2 at A"
    assert thing_named(scene, kinds.VELOCITY, "2 at B") == "2 at B"


def other_words(english: str, *put: object) -> Said:
    """A phrase in words that nobody knows; different ones stay different."""
    return Said(f"{english[::-1]} {put}", "phrases", english, put)


def test_other_words_change_no_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where every phrase is said in other words, the same steps are drawn and the same numbers are read."""
    def drawn(plan: str) -> str:
        found = construct(gp.load("rosenauer-loaded"), plan=plan)
        steps = [(step.op.name, step.args, step.panel, step.links, step.name) for step in found.drawn.steps]
        return json.dumps([steps, found.read(Floats())], default=str)

    plans = "", "polar,polygons"
    before = [drawn(plan) for plan in plans]
    monkeypatch.setattr(Phrase, "__call__", lambda self, *put, **named: other_words(self.english, *put))
    for module in ("methods.motion.acceleration", "methods.forces.loading", "methods.forces.force_plan",
                   "methods.forces.friction", "methods.forces.groups", "methods.draughtsman"):
        monkeypatch.setattr(f"graphplan.{module}.said", lambda english, *put, **named: other_words(english, *put))
    assert [drawn(plan) for plan in plans] == before


def test_variants_count_as_their_form() -> None:
    """A form that is another, drawn otherwise, is preferred and told as that one."""
    forms = [form for op in TABLE.values() for form in op.forms]
    assert any(isinstance(form, Variant) for form in forms)
    assert {plain(form) for form in forms} <= set(forms)
